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
    bool in_numbers; /* for the values of the sheet, not for others */
};

struct lines {
    struct fbd_grade *grade;
    const struct node *root; /* the key with the answer's derivations */
    fbd_model *model;
    struct hand_check check;
    gsl_rng *rng;
};

/* ---- the key's scene with the answer's derivations */

static const struct node *value_at(const struct node *map, const char *key)
{
    const struct pair *pair = node_find(map, key);
    return pair ? pair->value : NULL;
}

/* Parameters that a derivation names beside those of the sheet. */
static const struct node *with_parameters(struct arena *arena, const struct node *root,
                                          const struct node *answer)
{
    const struct node *own = value_at(root, "parameters"), *more = value_at(answer, "parameters");
    if (!more || more->kind != node_map) return root;
    const struct node *all = own && own->kind == node_map ? own : node_empty_map(arena);
    for (size_t i = 0; all && i < more->count; i++)
        if (!node_find(all, more->pairs[i].key))
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

/* Compile until every line that is left can be read. */
static void compile_lines(struct lines *lines)
{
    struct fbd_grade *grade = lines->grade;
    while (lines->root && !lines->model && !grade->arena.failed) {
        fbd_errors *errors = fbd_errors_new();
        if (!errors) {
            grade->arena.failed = true;
            return;
        }
        lines->model = grade_compile(grade, lines->root, grade->file, true, errors);
        const fbd_error *error = lines->model ? NULL : first_error(errors);
        if (errors->out_of_memory) grade->arena.failed = true;
        struct culprit culprit = {0};
        if (error) culprit = find_culprit(lines->root, (struct pos){error->line, error->column});
        if (culprit.item)
            finding_of_error(grade, FBD_FINDING_UNREADABLE, culprit.body,
                             culprit.item->kind == node_scalar ? culprit.item->text : "", error);
        if (!lines->model) lines->root = culprit.item ? without(&grade->arena, lines->root, &culprit) : NULL;
        fbd_errors_free(errors);
    }
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
        line->agreed[slip] += isfinite(sample->size) && fabs(sample->lack) <= tolerance * sample->size;
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

/* For all values of the parameters, or else for those of the sheet. */
static bool look_at_line(struct lines *lines, const struct node *root, const fbd_model *model, int body,
                         int index, struct line *line)
{
    const struct document document = {.file = lines->grade->file, .root = root, .split_hands = true};
    struct hand_check *check = &lines->check;
    *line = (struct line){.says = 0};
    check->model = model;
    check->body = body;
    check->index = index;
    if (diagram_arrows(model, body) > most_terms) return true;
    line->checked = true;
    if (!hand_take_samples(check, &document, lines->rng, 0.3)) return false;
    line->says = check->says;
    count_samples(check, 1e-9, line);
    if (agrees_somewhere(line)) return true;
    struct line general = *line;
    if (!hand_take_samples(check, &document, lines->rng, 0)) return false;
    count_samples(check, model->scene->grading.tolerance, line);
    line->in_numbers = agrees_somewhere(line);
    if (!line->in_numbers) *line = general;
    return line->in_numbers || hand_take_samples(check, &document, lines->rng, 0.3);
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
    bool good = agrees_somewhere(line), empty = good && line->says == 0;
    size_t seen = line->seen[0] + line->seen[1] + line->seen[2];
    if (good && !empty && !line->in_numbers) return;
    fbd_finding *finding = finding_add(grade, good && !empty ? FBD_FINDING_RIGHT : FBD_FINDING_DERIVATION,
                                       source->name, hand->text, hand->at);
    if (empty)
        finding_say(grade, finding, "it is true whatever the forces are: it says nothing");
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

/* Is a line of the key met, and by which share of its cases? */
static void note_key_line(struct lines *lines, int body, int index, const struct line *key,
                          const struct line *own, size_t count)
{
    struct fbd_grade *grade = lines->grade;
    int seen = 0, met = 0;
    for (int slip = 0; slip < slips; slip++) {
        bool found = false;
        for (size_t i = 0; i < count; i++)
            found = found || (agrees_at(&own[i], slip) && (unknowns(own[i].says) & unknowns(key->says)));
        seen += key->seen[slip] > 0;
        met += key->seen[slip] > 0 && found;
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

static bool grade_body(struct lines *lines, int body)
{
    const struct fbd_grade *grade = lines->grade;
    size_t count = lines->model->scene->bodies[body].hand_count;
    size_t key_count = grade->sheet->scene->bodies[body].hand_count;
    struct line *own = calloc(count + 1, sizeof *own), key;
    bool done = own != NULL;
    for (size_t i = 0; done && i < count; i++) {
        done = look_at_line(lines, lines->root, lines->model, body, (int)i, &own[i]);
        if (done) note_student_line(lines, body, (int)i, &own[i]);
    }
    for (size_t k = 0; done && k < key_count; k++) {
        done = look_at_line(lines, grade->key->document.root, grade->sheet, body, (int)k, &key);
        if (done) note_key_line(lines, body, (int)k, &key, own, count);
    }
    free(own);
    return done;
}

void grade_lines(struct fbd_grade *grade, const struct node *root)
{
    struct lines lines = {.grade = grade, .rng = gsl_rng_alloc(gsl_rng_mt19937)};
    lines.check.samples = calloc(most_samples, sizeof *lines.check.samples);
    lines.root = with_lines(&grade->arena, grade->key->document.root, root);
    if (lines.root) lines.root = with_parameters(&grade->arena, lines.root, root);
    if (lines.rng && lines.check.samples) compile_lines(&lines);
    bool done = lines.model != NULL;
    for (size_t b = 0; done && b < lines.model->body_count; b++) done = grade_body(&lines, (int)b);
    if (!done) grade->arena.failed = true;
    fbd_model_free(lines.model);
    free(lines.check.samples);
    if (lines.rng) gsl_rng_free(lines.rng);
}
