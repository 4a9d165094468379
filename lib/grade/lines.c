/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivations of an answer, each line on the key's own mechanics.
 *
 * A line of the key is met by lines that are true and say something of the same unknown: an acceleration, or the
 * normal force. A line that is true whatever the unknowns are, as `m*a = m*a`, says nothing.
 */
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "grade/grade.h"
#include "output/hand.h"
#include "scene/node_edit.h"

enum { slips = 3 }; /* of a body's friction: back, none, forth */

/* What one equation says, and where it is true. */
struct line {
    unsigned says;
    size_t seen[slips], agreed[slips];
    bool checked;
    bool
        dynamic; /* it fails when other forces act: it says something of the forces, not of the motion alone */
    unsigned met;    /* the unknowns of the line of the key that it has met */
    bool in_numbers; /* for the values of the sheet, not for others */
};

struct lines {
    struct fbd_grade *grade;
    const struct node *root; /* the key with the answer's derivations */
    fbd_model *model;
    const struct node *pushed_root; /* the same with other forces on all bodies */
    fbd_model *pushed;
    struct document probes;
    struct hand_check check;
    gsl_rng *rng;
};

/* ---- the key's scene with the answer's derivations */

static const struct node *value_at(const struct node *map, const char *key)
{
    const struct pair *pair = node_find(map, key);
    return pair ? pair->value : NULL;
}

/* What an equation calls so is not for an answer to say. */
static bool is_taken(const char *name)
{
    static const char *const names[] = {"m",  "g",    "N",    "I_G",  "I_O",     "L",
                                        "mu", "mu_s", "mu_k", "slip", "distance"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0) return true;
    return false;
}

/* Parameters that a derivation names beside those of the sheet. */
static const struct node *with_parameters(struct arena *arena, const struct node *root,
                                          const struct node *answer)
{
    const struct node *own = value_at(root, "parameters"), *more = value_at(answer, "parameters");
    if (!more || more->kind != node_map) return root;
    const struct node *all = own && own->kind == node_map ? own : node_empty_map(arena);
    for (size_t i = 0; all && i < more->count; i++)
        if (!node_find(all, more->pairs[i].key) && !is_taken(more->pairs[i].key))
            all = node_with(arena, all, more->pairs[i].key, more->pairs[i].value);
    return all ? node_with(arena, root, "parameters", all) : NULL;
}

static const struct node *with_lines(struct arena *arena, const struct node *root, const struct node *answer)
{
    const struct node *bodies = value_at(root, "bodies"), *others = value_at(answer, "bodies"),
                      *made = bodies;
    for (size_t b = 0; made && b < bodies->count; b++) {
        const struct node *other = value_at(others, bodies->pairs[b].key);
        const struct node *hand = value_at(other, "hand");
        const struct node *body = node_with(arena, bodies->pairs[b].value, "hand", hand);
        made = body ? node_with(arena, made, bodies->pairs[b].key, body) : NULL;
    }
    return made ? node_with(arena, root, "bodies", made) : NULL;
}

/* ---- lines that cannot be read */

static bool is_behind(struct pos a, struct pos b)
{
    return a.line > b.line || (a.line == b.line && a.column > b.column);
}

struct culprit {
    const struct node *item; /* the line, or all of `hand` */
    const char *body;
};

static void consider(struct culprit *culprit, const struct node *item, const char *body, struct pos at)
{
    if (is_behind(item->at, at) || (culprit->item && is_behind(culprit->item->at, item->at))) return;
    *culprit = (struct culprit){item, body};
}

static struct culprit find_culprit(const struct node *root, struct pos at)
{
    const struct node *bodies = value_at(root, "bodies");
    struct culprit culprit = {0};
    for (size_t b = 0; b < bodies->count; b++) {
        const struct node *hand = value_at(bodies->pairs[b].value, "hand");
        if (!hand) continue;
        if (hand->kind != node_list) consider(&culprit, hand, bodies->pairs[b].key, at);
        for (size_t i = 0; hand->kind == node_list && i < hand->count; i++)
            consider(&culprit, hand->items[i], bodies->pairs[b].key, at);
    }
    return culprit;
}

static bool is_it(const struct node *item, const void *context)
{
    return item == context;
}

static const struct node *without(struct arena *arena, const struct node *root, const struct culprit *culprit)
{
    const struct node *bodies = value_at(root, "bodies"), *body = value_at(bodies, culprit->body);
    const struct node *hand = value_at(body, "hand");
    const struct node *left =
        hand->kind == node_list ? node_filtered(arena, hand, is_it, culprit->item) : NULL;
    body = node_with(arena, body, "hand", left);
    bodies = body ? node_with(arena, bodies, culprit->body, body) : NULL;
    return bodies ? node_with(arena, root, "bodies", bodies) : NULL;
}

/* Leave out every line that an error stands in; false when there is none. */
static bool leave_out_wrong(struct lines *lines, fbd_errors *errors)
{
    struct fbd_grade *grade = lines->grade;
    const struct node *root = lines->root;
    const struct culprit *last = NULL;
    struct culprit culprit = {0};
    const fbd_error *error;
    bool any = false;
    for (size_t i = 0; lines->root && (error = fbd_errors_get(errors, i)) != NULL; i++) {
        const struct node *before = culprit.item;
        if (error->severity != FBD_ERROR) continue;
        culprit = find_culprit(root, (struct pos){error->line, error->column});
        if (!culprit.item || culprit.item == before) continue; /* notes are in the order of their places */
        last = &culprit;
        finding_of_error(grade, FBD_FINDING_UNREADABLE, last->body,
                         culprit.item->kind == node_scalar ? culprit.item->text : "", error);
        lines->root = without(&grade->arena, lines->root, &culprit);
        any = true;
    }
    return any;
}

/* Compile `root`; the first error, if any, is a finding when `tell`. */
static fbd_model *try_root(struct lines *lines, const struct node *root, bool hands, bool tell,
                           fbd_errors *errors)
{
    struct fbd_grade *grade = lines->grade;
    fbd_model *model = root ? grade_compile(grade, root, grade->key->file, hands, errors) : NULL;
    const fbd_error *error = model ? NULL : first_error(errors);
    if (errors->out_of_memory) grade->arena.failed = true;
    if (error && tell) finding_of_error(grade, FBD_FINDING_UNREADABLE, "", "", error);
    return model;
}

/* Parameters of the answer that do not go with the sheet are left out with a word. */
static void check_parameters(struct lines *lines, const struct node *sheet)
{
    fbd_errors *errors = fbd_errors_new();
    if (!errors) lines->grade->arena.failed = true;
    if (errors) {
        fbd_model *model = try_root(lines, lines->root, false, true, errors);
        if (!model) lines->root = sheet;
        fbd_model_free(model);
    }
    fbd_errors_free(errors);
}

/* Compile until every line that is left can be read. */
static void compile_lines(struct lines *lines)
{
    while (lines->root && !lines->model && !lines->grade->arena.failed) {
        fbd_errors *errors = fbd_errors_new();
        if (!errors) {
            lines->grade->arena.failed = true;
            return;
        }
        lines->model = try_root(lines, lines->root, true, false, errors);
        if (!lines->model && !leave_out_wrong(lines, errors)) lines->root = NULL;
        fbd_errors_free(errors);
    }
}

/* ---- the same scene with other forces */

static const struct node *pushed_body(struct lines *lines, const struct node *body, const char *key)
{
    const struct node *probe = value_at(lines->probes.root, key), *forces = value_at(body, "forces");
    if (!probe || (forces && forces->kind != node_list)) return body;
    const struct node *list = node_appended(&lines->grade->arena, forces, probe);
    return list ? node_with(&lines->grade->arena, body, "forces", list) : NULL;
}

/* A push on every body, off its centre where it can turn, by a share of its weight, so that ropes stay taut; `sign`
 * chooses its sense. */
static void push(struct lines *lines, double sign)
{
    struct arena *arena = &lines->grade->arena;
    const struct node *bodies = value_at(lines->root, "bodies"), *made = bodies;
    struct text text = {0};
    fbd_errors *errors = fbd_errors_new();
    for (size_t b = 0; b < lines->model->body_count; b++) {
        const struct model_body *body = &lines->model->bodies[b];
        bool turns = body->kind == motion_pivot || body->kind == motion_planar;
        double weight = sign * 10 * body->inertia.mass * (lines->model->scene->units == unit_us ? 14.6 : 1);
        text_printf(&text, "%s: {applied: {name: fbd_probe, fx: %.17g N, fy: %.17g N%s}}\n", body->name,
                    0.17 * weight, -0.29 * weight, turns ? ", at: [0.21 m, 0.13 m]" : "");
    }
    char *kept = errors && !text.failed ? arena_text(arena, text.data, text.length) : NULL;
    document_close(&lines->probes);
    lines->probes = (struct document){.file = NULL};
    bool open = kept && document_open(&lines->probes, kept, text.length, NULL, errors);
    for (size_t b = 0; open && made && b < bodies->count; b++) {
        const struct node *body = pushed_body(lines, bodies->pairs[b].value, bodies->pairs[b].key);
        made = body ? node_with(arena, made, bodies->pairs[b].key, body) : NULL;
    }
    model_free(lines->pushed);
    lines->pushed = NULL;
    lines->pushed_root = open && made ? node_with(arena, lines->root, "bodies", made) : NULL;
    if (lines->pushed_root) lines->pushed = try_root(lines, lines->pushed_root, true, false, errors);
    if (!errors || text.failed) lines->grade->arena.failed = true;
    fbd_errors_free(errors);
    text_free(&text);
}

/* ---- one line */

static void count_samples(const struct hand_check *check, double tolerance, struct line *line)
{
    memset(line->seen, 0, sizeof line->seen);
    memset(line->agreed, 0, sizeof line->agreed);
    for (size_t i = 0; i < check->count; i++) {
        const struct hand_sample *sample = &check->samples[i];
        int slip = sample->slip + 1;
        line->seen[slip]++;
        double size = tolerance > 1e-6 ? sample->mechanics : sample->size; /* rounding, or rounded numbers */
        line->agreed[slip] += isfinite(size) && fabs(sample->lack) <= tolerance * size;
    }
}

static bool agrees_at(const struct line *line, int slip)
{
    return line->seen[slip] > 0 && line->agreed[slip] == line->seen[slip];
}

static bool agrees_somewhere(const struct line *line)
{
    return agrees_at(line, 0) || agrees_at(line, 1) || agrees_at(line, 2);
}

/* A number that was rounded, perhaps: one of two digits or more. */
static bool has_numbers(const char *text)
{
    size_t digits = 0;
    for (; *text; text++) {
        bool digit = *text >= '0' && *text <= '9';
        digits = digit ? digits + 1 : *text == '.' ? digits : 0;
        if (digits >= 2) return true;
    }
    return false;
}

/* Does it name a parameter that the sheet does not have? Those follow from others, and are not varied with them. */
static bool has_own_names(const struct lines *lines, const char *text)
{
    const struct scene *scene = lines->model->scene;
    const struct node *known = value_at(lines->grade->key->document.root, "parameters");
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (!node_find(known, scene->parameters[i].name) && strstr(text, scene->parameters[i].name))
            return true;
    return false;
}

static bool sample_line(struct lines *lines, const struct node *root, const fbd_model *model, double spread,
                        double tolerance, struct line *line)
{
    const struct document document = {.file = lines->grade->key->file, .root = root, .split_hands = true};
    lines->check.model = model;
    if (!hand_take_samples(&lines->check, &document, lines->rng, spread)) return false;
    line->says = lines->check.says;
    count_samples(&lines->check, tolerance, line);
    return true;
}

/* Does it fail under other forces? Where these leave no motion that can be, under their opposites. */
static bool look_at_pushed(struct lines *lines, double tolerance, struct line *line)
{
    line->dynamic = true;
    for (int sign = 1; sign >= -1; sign -= 2) {
        struct line pushed = {.says = 0};
        push(lines, sign);
        if (!lines->pushed) return !lines->grade->arena.failed;
        if (!sample_line(lines, lines->pushed_root, lines->pushed, 0, tolerance, &pushed)) return false;
        size_t seen = pushed.seen[0] + pushed.seen[1] + pushed.seen[2];
        line->dynamic = 2 * (pushed.agreed[0] + pushed.agreed[1] + pushed.agreed[2]) < seen;
        if (seen > 0) return true;
    }
    line->dynamic = line->says != 0;
    return true;
}

/* For all values of the parameters, or, where it has numbers, for those of the sheet. */
static bool look_at_line(struct lines *lines, int body, int index, struct line *line)
{
    const fbd_model *model = lines->model;
    const char *text = model->scene->bodies[body].hands[index].text;
    double tolerance = 1e-9;
    *line = (struct line){.says = 0};
    lines->check.body = body;
    lines->check.index = index;
    if (diagram_arrows(model, body) >= most_terms) return true;
    line->checked = true;
    if (!sample_line(lines, lines->root, model, 0.3, tolerance, line)) return false;
    if (!agrees_somewhere(line) && (has_numbers(text) || has_own_names(lines, text))) {
        struct line general = *line;
        tolerance = 0.3 * model->scene->grading.tolerance; /* three digits */
        if (!sample_line(lines, lines->root, model, 0, tolerance, line)) return false;
        line->in_numbers = agrees_somewhere(line);
        if (!line->in_numbers) *line = general;
    }
    if (agrees_somewhere(line)) return look_at_pushed(lines, tolerance, line);
    struct line again;
    return sample_line(lines, lines->root, model, 0.3, 1e-9, &again); /* for what is said of it */
}

/* ---- what is said of it */

/* Accelerations and the normal force, or where a line names none of them, inertia and arms. */
static unsigned unknowns(unsigned says)
{
    const unsigned accelerations = (1U << hand_mass) - 1, N = 1U << hand_N;
    unsigned first = says & (accelerations | (unsigned)hand_others), second = says & N;
    return first ? first : second ? second : says;
}

static void note_student_line(struct lines *lines, int body, int index, const struct line *line)
{
    struct fbd_grade *grade = lines->grade;
    const struct body *source = &lines->model->scene->bodies[body];
    const struct hand *hand = &source->hands[index];
    bool good = agrees_somewhere(line), empty = good && (line->says == 0 || !line->dynamic);
    size_t seen = line->seen[0] + line->seen[1] + line->seen[2];
    if (good && !empty && !line->in_numbers) return;
    fbd_finding *finding = finding_add(grade, good && !empty ? FBD_FINDING_RIGHT : FBD_FINDING_DERIVATION,
                                       source->name, hand->text, hand->at);
    if (empty)
        finding_say(grade, finding, "it is true whatever the forces are: it says nothing of them");
    else if (good)
        finding_say(grade, finding, "it is right for these numbers");
    else if (!line->checked || seen == 0)
        finding_say(grade, finding, "no state was found where it claims to hold");
    else
        finding_say(grade, finding, "it does not agree with the mechanics of the sheet");
    if (good || seen == 0) return;
    struct text text = {0};
    hand_diagnose(&lines->check, line->seen[1] > 0 ? 0 : line->seen[2] > 0 ? 1 : -1, &text);
    if (text.failed) grade->arena.failed = true;
    finding_tell(grade, finding, text.data ? text.data : "");
    text_free(&text);
}

static const char *unknown_of(const struct lines *lines, int body, unsigned says)
{
    const struct body *source = &lines->model->scene->bodies[body];
    const struct coordinate *coordinates = &lines->model->scene->coordinates[source->first];
    unsigned asked = unknowns(says);
    for (int k = 0; k < source->count; k++)
        if (asked & (1U << k)) return coordinates[k].acceleration_name;
    return (asked & (1U << hand_N)) != 0 ? "N" : NULL;
}

/* One line of the answer meets one line of the key, or several about the same (for each sense of slip). */
static bool meets(const struct line *own, const struct line *key, int slip)
{
    unsigned asked = unknowns(key->says);
    return agrees_at(own, slip) && (unknowns(own->says) & asked) && (own->dynamic || !key->dynamic) &&
           (own->met == 0 || own->met == asked);
}

/* A line that meets this one, if possible one about the same unknowns. */
static bool find_line(struct line *own, size_t count, const struct line *key, int slip)
{
    for (int same = 1; same >= 0; same--)
        for (size_t i = 0; i < count; i++) {
            if (!meets(&own[i], key, slip) || (same && unknowns(own[i].says) != unknowns(key->says)))
                continue;
            own[i].met = unknowns(key->says);
            return true;
        }
    return false;
}

/* Is a line of the key met, and by which share of its cases? */
static void note_key_line(struct lines *lines, int body, int index, const struct line *key, struct line *own,
                          size_t count)
{
    struct fbd_grade *grade = lines->grade;
    int seen = 0, met = 0;
    for (int slip = 0; slip < slips; slip++) {
        bool found = key->seen[slip] > 0 && find_line(own, count, key, slip);
        seen += key->seen[slip] > 0;
        met += found;
    }
    double share = seen ? (double)met / seen : 0;
    const char *name = unknown_of(lines, body, key->says);
    struct text text = {0};
    fbd_finding *finding = finding_add(grade, share > 0 ? FBD_FINDING_RIGHT : FBD_FINDING_MISSING,
                                       lines->model->bodies[body].name, "", (struct pos){0, 0});
    finding->most = grade->key->model->scene->grading.points.derivation;
    finding->points = share * finding->most;
    text_printf(&text, "%s%s%s", share > 0 ? "the equation" : "a right equation", name ? " for " : "",
                name ? name : "");
    text_add(&text, share == 1  ? " is right"
                    : share > 0 ? " is right for one direction of slip only"
                                : " is missing");
    finding_say(grade, finding, text.data ? text.data : "");
    text.length = 0;
    text_printf(&text, "the key has `%s`", grade->sheet->scene->bodies[body].hands[index].text);
    finding_tell(grade, finding, text.data ? text.data : "");
    if (text.failed) grade->arena.failed = true;
    text_free(&text);
}

static bool grade_body(struct lines *lines, struct lines *sheet, int body)
{
    const struct fbd_grade *grade = lines->grade;
    size_t count = lines->model->scene->bodies[body].hand_count;
    size_t key_count = grade->sheet->scene->bodies[body].hand_count;
    struct line *own = calloc(count + 1, sizeof *own), key;
    bool done = own != NULL;
    for (size_t i = 0; done && i < count; i++) {
        done = look_at_line(lines, body, (int)i, &own[i]);
        if (done) note_student_line(lines, body, (int)i, &own[i]);
    }
    for (size_t k = 0; done && k < key_count; k++) {
        done = look_at_line(sheet, body, (int)k, &key);
        if (done) note_key_line(lines, body, (int)k, &key, own, count);
    }
    free(own);
    return done;
}

static bool open_lines(struct lines *lines)
{
    lines->rng = gsl_rng_alloc(gsl_rng_mt19937);
    lines->check.samples = calloc(most_samples, sizeof *lines->check.samples);
    return lines->rng && lines->check.samples;
}

static void close_lines(struct lines *lines)
{
    model_free(lines->pushed);
    document_close(&lines->probes);
    free(lines->check.samples);
    if (lines->rng) gsl_rng_free(lines->rng);
}

void grade_lines(struct fbd_grade *grade, const struct node *root)
{
    struct lines lines = {.grade = grade}, sheet = {.grade = grade, .model = grade->sheet};
    const struct node *key = grade->key->document.root;
    sheet.root = key;
    bool done = open_lines(&lines) && open_lines(&sheet);
    const struct node *plain = with_lines(&grade->arena, key, root);
    lines.root = plain ? with_parameters(&grade->arena, plain, root) : NULL;
    if (done && lines.root) check_parameters(&lines, plain);
    if (done) compile_lines(&lines);
    done = done && lines.model != NULL;
    for (size_t b = 0; done && b < lines.model->body_count; b++) done = grade_body(&lines, &sheet, (int)b);
    if (!done) grade->arena.failed = true;
    fbd_model_free(lines.model);
    close_lines(&lines);
    close_lines(&sheet);
}
