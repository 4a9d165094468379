/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The equations of each body of the gallery, written from the arrows of its diagram before anything is eliminated: sums of
 * forces along x and y and of moments about G and about points of the body. All of them are accepted. Then slips of the
 * pen are made in them at random, a sign, a factor, a term left out, another component or force, another point; whether
 * such a line is false is decided here by the numbers of the diagram, at other states and other parameters than those of
 * --check-hand. None that is false is accepted, none that is true refused.
 *
 * Every fourth model, under a sanitizer every twelfth; with FBD_DRAWS all of them, so many times.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "document/node_edit.h"
#include "dynamics/diagram.h"
#include "dynamics/mass.h"
#include "dynamics/project.h"
#include "gallery.h"
#include "output/hand.h"
#include "output/hand_forces.h"
#include "output/random_state.h"
#include "thorough.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_written_terms = 24, most_lines = 40, states_looked_at = 12, models_looked_at = 5 };

/* One summand: a factor times a component of an arrow, or its moment about a point. */
struct summand_written {
    size_t arrow;
    enum { along_x, along_y, about_point } part;
    double factor;
};

struct written {
    int body;
    enum written_sum { sum_x, sum_y, sum_moments } sum;
    const char *point;     /* of the moments: a point of the body */
    const char *arms_from; /* that from which the arms are counted: another one by a slip */
    const char *inertia;   /* that about which the moment of inertia is */
    size_t count;
    struct summand_written terms[most_written_terms];
    const char *about; /* `about` says it, or NULL */
    int form;          /* in which it is written */
    enum slip_kind {
        no_slip,
        wrong_sign,
        wrong_factor,
        missing_term,
        wrong_reaction,
        wrong_point,
        kinds_of_slips
    } slip;
    const char *culprit; /* the force whose term it is */
    char text[8200];
};

static size_t lines_written, slips_made, slips_false, not_unique, models_written, models_seen;
static size_t slips_of[kinds_of_slips], names_of[kinds_of_slips];

/* ---- text */

static void append(char *text, size_t room, const char *format, ...)
{
    size_t length = strlen(text);
    va_list args;
    va_start(args, format);
    vsnprintf(text + length, room - length, format, args);
    va_end(args);
}

/* Which components of an arrow have names? A moment has no force, and not every force a couple. */
static bool has_name(const struct hand_forces *forces, int body, size_t arrow, enum hand_force_part part)
{
    for (size_t i = 0; i < forces->count; i++) {
        const struct hand_force *one = &forces->list[i];
        if (one->name.body == body && one->arrow == arrow && one->part == part && !one->name.letter)
            return true;
    }
    return false;
}

static void write_moment(struct written *line, const struct fbd_model *model, const char *name, bool force,
                         bool couple)
{
    const char *body = model->bodies[line->body].name, *P = line->arms_from;
    size_t room = sizeof line->text;
    append(line->text, room, "(");
    if (force)
        append(line->text, room, "(%s.at.x - %s.%s.x)*%s.y - (%s.at.y - %s.%s.y)*%s.x", name, body, P, name,
               name, body, P, name);
    if (couple) append(line->text, room, "%s%s.moment", force ? " + " : "", name);
    append(line->text, room, ")");
}

static void write_sides(struct written *line, const struct fbd_model *model, const struct arrow *arrows,
                        const struct hand_forces *forces)
{
    const char *body = model->bodies[line->body].name, *Q = line->point;
    char *text = line->text;
    const size_t room = sizeof line->text;
    text[0] = '\0';
    append(text, room, "0");
    for (size_t i = 0; i < line->count; i++) {
        const struct summand_written *term = &line->terms[i];
        const char *name = arrows[term->arrow].name;
        bool force = has_name(forces, line->body, term->arrow, hand_force_x);
        bool couple = has_name(forces, line->body, term->arrow, hand_force_couple);
        if (term->part != about_point && !force) continue;
        append(text, room, " %c ", term->factor < 0 ? '-' : '+');
        if (fabs(term->factor) != 1) append(text, room, "%.17g*", fabs(term->factor));
        if (term->part == about_point)
            write_moment(line, model, name, force, couple);
        else
            append(text, room, "%s.%c", name, term->part == along_x ? 'x' : 'y');
    }
    if (line->sum != sum_moments)
        append(text, room, " = %s.m*a_%c", body, line->sum == sum_x ? 'x' : 'y');
    else
        append(text, room,
               " = I_%s*angle_ddot + %s.m*((%s.G.x - %s.%s.x)*%s.a_y - (%s.G.y - %s.%s.y)*%s.a_x)",
               line->inertia, body, body, body, Q, Q, body, body, Q, Q);
}

/* One of several ways to write the same. */
static void write_text(struct written *line, const struct fbd_model *model, const struct arrow *arrows,
                       const struct hand_forces *forces)
{
    static const char *const forms[] = {"%s = %s", "(%s)/2 = (%s)/2", "-(%s) = -(%s)", "(%s) - (%s) = 0",
                                        "0.7*(%s) = 0.7*(%s)"};
    static char left[sizeof line->text / 2], whole[sizeof line->text];
    write_sides(line, model, arrows, forces);
    char *equals = strstr(line->text, " = ");
    assert_non_null(equals);
    *equals = '\0';
    assert_true((size_t)snprintf(left, sizeof left, "%s", line->text) < sizeof left);
    append(strcpy(whole, ""), sizeof whole, forms[line->form], left, equals + strlen(" = "));
    memcpy(line->text, whole, sizeof whole);
}

/* ---- numbers */

static struct point_of {
    struct vec own;
} point_named(const struct fbd_model *model, int b, const char *name)
{
    const struct body *source = model->bodies[b].source;
    struct point_of found = {model->bodies[b].inertia.G};
    for (size_t i = 0; i < source->point_count; i++)
        if (strcmp(source->points[i].name, name) == 0) found.own = source->points[i].where;
    return found;
}

/* The share of left less right in what is added up. */
static double share_off(const struct written *line, const struct fbd_state *state, struct arrow *arrows)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[line->body];
    struct instant at = state_instant(state);
    struct pose pose = body_pose(body, &at);
    diagram_fill(model, line->body, &at, state->slots, arrows);
    struct vec G = point_motion(body, &pose, body->inertia.G).p;
    struct vec P = point_motion(body, &pose, point_named(model, line->body, line->arms_from).own).p;
    struct vec own = point_named(model, line->body, line->point).own, Q = point_motion(body, &pose, own).p;
    struct vec I = point_motion(body, &pose, point_named(model, line->body, line->inertia).own).p;
    double mass = body_mass(body, &at), sum = 0, size = 0, largest = 0;
    for (size_t i = 0; i < line->count; i++) {
        const struct summand_written *term = &line->terms[i];
        const struct arrow *arrow = &arrows[term->arrow];
        double value = term->part == along_x   ? arrow->force.x
                       : term->part == along_y ? arrow->force.y
                                               : arrow_moment(arrow, P);
        sum += term->factor * value;
        size += fabs(term->factor * value);
        double reach = term->part == about_point ? vec_norm(vec_sub(arrow->point, P)) + 1e-6 : 1;
        largest = fmax(largest, vec_norm(arrow->force) * reach);
    }
    struct vec a = mass_center_acceleration(body, &at);
    double right = line->sum == sum_x ? mass * a.x : mass * a.y;
    if (line->sum == sum_moments) {
        struct vec GI = vec_sub(G, I);
        double inertia = body_inertia(body, &at).I_G + mass * vec_dot(GI, GI);
        struct vec a_Q = point_acceleration(body, own, &at);
        right = inertia * body_angular_acceleration(body, &at) + mass * vec_cross(vec_sub(G, Q), a_Q);
    }
    return fabs(sum - right) / fmax(fmax(size, fabs(right)), fmax(largest, 1e-300));
}

/* ---- the lines of a body */

static bool turns(const struct model_body *body)
{
    if (body->kind == motion_particle) return false;
    return body->place.link > 0 || body->joint->angle >= 0;
}

static void start_line(struct written *line, int b, enum written_sum sum, const char *point, size_t count)
{
    *line = (struct written){.body = b, .point = point, .arms_from = point, .inertia = point};
    line->sum = sum;
    for (size_t i = 0; i < count && i < most_written_terms; i++) {
        struct summand_written *term = &line->terms[line->count++];
        *term = (struct summand_written){.arrow = i, .factor = 1};
        term->part = sum == sum_x ? along_x : sum == sum_y ? along_y : about_point;
    }
}

static const char *some_point(const struct fbd_model *model, int b, gsl_rng *rng)
{
    const struct body *source = model->bodies[b].source;
    size_t which = gsl_rng_uniform_int(rng, source->point_count + 1);
    return which == source->point_count || strchr(source->points[which].name, '.')
               ? "G"
               : source->points[which].name;
}

/* One slip of the pen. */
static void slip(struct written *line, const struct fbd_model *model, const struct arrow *arrows,
                 gsl_rng *rng)
{
    static const double factors[] = {2, 0.5, 1.1, 0.99, -2};
    enum { tries = 8 };
    struct summand_written *term = NULL;
    for (int k = 0; k < tries; k++) { /* mostly one that is not zero */
        term = &line->terms[gsl_rng_uniform_int(rng, line->count)];
        const struct arrow *arrow = &arrows[term->arrow];
        if (term->part == about_point ? arrow->couple != 0 || vec_norm(arrow->force) > 0
                                      : fabs(term->part == along_x ? arrow->force.x : arrow->force.y) > 1e-9)
            break;
    }
    line->culprit = arrows[term->arrow].name;
    switch (gsl_rng_uniform_int(rng, line->sum == sum_moments ? 6 : 4)) {
    case 0:
        line->slip = wrong_sign;
        term->factor = -1;
        break;
    case 1:
        line->slip = wrong_factor;
        term->factor = factors[gsl_rng_uniform_int(rng, sizeof factors / sizeof *factors)];
        break;
    case 2:
        line->slip = missing_term;
        *term = line->terms[--line->count];
        break;
    case 3:
        line->slip = wrong_reaction;
        if (gsl_rng_uniform(rng) < 0.5 && term->part != about_point)
            term->part = term->part == along_x ? along_y : along_x;
        else
            term->arrow = line->terms[gsl_rng_uniform_int(rng, line->count)].arrow;
        break;
    case 4:
        line->slip = wrong_point;
        line->arms_from = some_point(model, line->body, rng);
        break;
    default:
        line->slip = wrong_point;
        line->inertia = some_point(model, line->body, rng);
        break;
    }
}

/* ---- a model */

struct page {
    const struct fbd_model *model;
    struct written *lines;
    size_t count;
    gsl_rng *rng;
    struct arrow *arrows;
};

static fbd_state *first_state(const struct fbd_model *model)
{
    fbd_state *state = state_new(model);
    if (state && model->assembles) state_project(state, true);
    if (state && !random_admissible(state)) state_evaluate(state);
    return state;
}

static void write_lines(struct page *page, size_t slips)
{
    const struct fbd_model *model = page->model;
    struct arena arena = {0};
    struct hand_forces forces;
    fbd_state *state = first_state(model);
    assert_non_null(state);
    assert_true(hand_forces_make(model, &arena, &forces));
    for (size_t b = 0; b < model->body_count && page->count + 4 + slips < most_lines; b++) {
        struct instant at = state_instant(state);
        size_t count = diagram_fill(model, (int)b, &at, state->slots, page->arrows);
        size_t first = page->count;
        if (count > most_written_terms || model->bodies[b].varies) continue;
        const char *point = some_point(model, (int)b, page->rng);
        start_line(&page->lines[page->count++], (int)b, sum_x, "G", count);
        start_line(&page->lines[page->count++], (int)b, sum_y, "G", count);
        if (turns(&model->bodies[b])) {
            start_line(&page->lines[page->count++], (int)b, sum_moments, "G", count);
            start_line(&page->lines[page->count++], (int)b, sum_moments, point, count);
        }
        size_t right = page->count - first;
        for (size_t k = 0; k < slips && count > 0; k++) {
            struct written *line = &page->lines[page->count++];
            *line = page->lines[first + gsl_rng_uniform_int(page->rng, right)];
            slip(line, model, page->arrows, page->rng);
        }
        for (size_t i = first; i < page->count; i++)
            page->lines[i].form = (int)gsl_rng_uniform_int(page->rng, 5);
        for (size_t i = first; i < page->count; i++)
            write_text(&page->lines[i], model, page->arrows, &forces);
    }
    state_free(state);
    arena_free(&arena);
}

static const struct node *scalar(struct arena *arena, const char *text)
{
    struct node *made = ARENA_NEW(arena, struct node);
    assert_non_null(made);
    *made = (struct node){.kind = node_scalar, .height = 1, .size = 1, .text = text, .length = strlen(text)};
    return made;
}

/* The file with these lines in the place of its own. */
static const struct node *with_lines(struct arena *arena, const struct node *root, const struct page *page)
{
    const struct node *bodies = node_find(root, "bodies")->value, *made = bodies;
    for (size_t b = 0; b < bodies->count; b++) {
        const struct node *list = NULL;
        for (size_t i = 0; i < page->count; i++)
            if (page->lines[i].body == (int)b)
                list = node_appended(arena, list, scalar(arena, page->lines[i].text));
        const struct node *body = node_with(arena, bodies->pairs[b].value, "hand", list);
        made = node_with(arena, made, bodies->pairs[b].key, body);
    }
    return node_with(arena, root, "bodies", made);
}

/* The largest share at states of this model; -1 when there is none. */
static void look(struct page *page, const struct fbd_model *model, double *off)
{
    fbd_state *start = state_new(model), *state = state_new(model);
    double *room = calloc(random_path_room(model) + 1, sizeof *room);
    assert_non_null(room);
    struct random_path path = {.start = start, .y = room};
    for (int k = 0; k < states_looked_at; k++) {
        if (!random_state(page->rng, state, &path) || !random_admissible(state)) continue;
        for (size_t i = 0; i < page->count; i++)
            off[i] = fmax(off[i], share_off(&page->lines[i], state, page->arrows));
    }
    free(room);
    state_free(start);
    state_free(state);
}

/* Is the slip named, and the force in which it is? What else explains the line at all states is as good a name for it: two
 * terms that are all of it, forces that are always equal. */
static bool is_named(const struct written *line, const char *verdict, size_t length)
{
    static const char *const words[kinds_of_slips] = {
        [wrong_sign] = "the wrong sign",     [wrong_factor] = "factor",     [missing_term] = "is missing",
        [wrong_reaction] = "wrong reaction", [wrong_point] = "wrong point",
    };
    char text[2000];
    snprintf(text, sizeof text, "%.*s", (int)(length < sizeof text ? length : sizeof text - 1), verdict);
    char *end = strstr(text, "\n  at t"); /* the state at which it is worst */
    if (end) *end = '\0';
    const bool none =
        line->slip == wrong_reaction && (strstr(text, "is missing") || strstr(text, "factor 2"));
    const bool twice = line->slip == wrong_reaction || line->slip == wrong_factor;
    const bool force = line->slip != missing_term || strstr(text, line->culprit);
    if (none || (twice && strstr(text, "one too many"))) return true; /* one of the two forces is zero */
    return strstr(text, words[line->slip]) && force;
}

static void judge(struct checks *checks, const char *path, const struct page *page, const double *off,
                  const char *verdicts)
{
    for (size_t i = 0; i < page->count; i++) {
        const struct written *line = &page->lines[i];
        const char *next = strchr(verdicts, '\n'); /* behind the line itself */
        assert_non_null(next);
        next += strlen("\n  ");
        for (verdicts = next; verdicts[0] != '\n' || verdicts[1] == ' '; verdicts++)
            assert_int_not_equal(*verdicts, 0);
        verdicts++;
        if (strncmp(next, "not checked", 11) == 0 || off[i] < 0) continue;
        const bool accepted = strncmp(next, "agrees", 6) == 0;
        const bool open = strncmp(next, "not unique", 10) == 0;
        lines_written += !line->slip;
        slips_made += line->slip != no_slip;
        not_unique += open;
        slips_false += line->slip && off[i] > 1e-7;
        bool fine = off[i] > 1e-7 ? !accepted : off[i] > 1e-10 || accepted || (open && line->slip);
        if (line->slip && off[i] > 1e-7 && !open) {
            const bool says = is_named(line, next, (size_t)(verdicts - next));
            slips_of[line->slip]++;
            names_of[line->slip] += says;
            if (!says && getenv("FBD_SHOW"))
                print_message("%d %s\n%s: %s\n%.*s\n", (int)line->slip, path, line->culprit, line->text,
                              (int)(verdicts - next), next);
        }
        if (fine) continue;
        print_error("%s: %s is off by %.2e:\n%.300s\n", path, line->text, off[i], next);
        check_that(checks, path, false);
    }
}

static size_t draws(void)
{
    const char *text = getenv("FBD_DRAWS");
    return text && atoi(text) > 0 ? (size_t)atoi(text) : 1;
}

static void check_model(struct checks *checks, const char *path)
{
    static struct written lines[most_lines];
    const size_t every = thorough() ? 4 : 12;
    if (models_seen++ % every != 2 && !getenv("FBD_DRAWS")) return;
    struct trial trial = trial_open(path, NULL);
    struct fbd_model *model = trial.model;
    struct page page = {.model = model, .lines = lines, .rng = gsl_rng_alloc(gsl_rng_mt19937)};
    page.arrows = calloc(diagram_most_arrows(model) + 1, sizeof *page.arrows);
    fbd_errors *errors = fbd_errors_new();
    struct document document;
    assert_true(document_open(&document, model->source, model->source_length, model->scene->file, errors));
    const struct node *root = document.root;
    document.like = model->scene;
    for (size_t draw = 0; draw < draws() && model->body_count <= 12; draw++) {
        struct text text = {0};
        double off[most_lines];
        size_t differing = 0;
        gsl_rng_set(page.rng, 17 + draw);
        page.count = 0;
        write_lines(&page, 2);
        if (page.count == 0) break;
        document.root = with_lines(&document.arena, root, &page);
        for (size_t i = 0; i < page.count; i++) off[i] = -1;
        fbd_model *read = hands_compile(&document, NULL, 0, errors);
        if (!check_that(checks, path, read != NULL)) {
            fbd_errors_print(errors, stderr);
            break;
        }
        fbd_model_free(read);
        for (int k = 0; k < models_looked_at; k++) {
            fbd_model *other = NULL;
            document.without_hands = true;
            assert_true(random_model(&document, model, page.rng, k == 0 ? 0 : 0.25, &other));
            document.without_hands = false;
            if (other) look(&page, other, off);
            fbd_model_free(other);
        }
        assert_true(hand_check_document(model, &document, (unsigned)(1 + draw), &text, &differing));
        judge(checks, path, &page, off, text.data);
        text_free(&text);
        models_written++;
    }
    document_close(&document);
    fbd_errors_free(errors);
    free(page.arrows);
    gsl_rng_free(page.rng);
    trial_close(&trial);
}

static void systems_of_the_gallery(void **state)
{
    struct checks *checks = checks_of(state);
    each_model(checks, check_model);
    print_message("%zu models, %zu right lines; %zu with slips, %zu of them false; %zu not unique\n",
                  models_written, lines_written, slips_made, slips_false, not_unique);
    assert_true(slips_false > slips_made / 5);
    size_t all_made = 0, all_named = 0;
    for (int k = 1; k < kinds_of_slips; k++) {
        static const char *const kinds[] = {"", "sign", "factor", "missing term", "reaction", "point"};
        print_message("%s: %zu of %zu named\n", kinds[k], names_of[k], slips_of[k]);
        all_made += slips_of[k];
        all_named += names_of[k];
    }
    assert_true(100 * all_named >= 95 * all_made);
    checks_end(checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(systems_of_the_gallery, checks_begin, checks_free),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
