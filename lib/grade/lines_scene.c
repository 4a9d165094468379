/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The scenes in which derivations are evaluated: each alone, with other forces, and the motion of the sheet.
 */
#include <string.h>

#include "base/text.h"
#include "document/node_edit.h"
#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/lines.h"

/* A scene with only one equation, so that the others are not compiled again for each change of a parameter. */
const struct node *lines_alone(struct lines *lines, const struct node *root, int body, int index)
{
    struct arena *arena = &lines->grade->arena;
    const char *name = fbd_model_body_name(lines->model, (size_t)body);
    const struct node *bodies = lines_value(root, "bodies"), *made = bodies;
    const struct node *hand = lines_value(lines_value(bodies, name), "hand");
    if (hand->kind == node_list) hand = node_appended(arena, NULL, hand->items[index]);
    for (size_t b = 0; made && hand && b < bodies->count; b++) {
        const char *other = bodies->pairs[b].key;
        const struct node *value = bodies->pairs[b].value;
        if (!node_find(value, "hand")) continue;
        const struct node *one = node_with(arena, value, "hand", strcmp(other, name) == 0 ? hand : NULL);
        made = one ? node_with(arena, made, other, one) : NULL;
    }
    return made && hand ? node_with(arena, root, "bodies", made) : NULL;
}

/* ---- the same scene with other forces */

static const struct node *pushed_body(struct arena *arena, const struct node *probes, const struct pair *body)
{
    const struct node *probe = lines_value(probes, body->key), *forces = lines_value(body->value, "forces");
    if (!probe || (forces && forces->kind != node_list)) return body->value;
    const struct node *list = node_appended(arena, forces, probe);
    return list ? node_with(arena, body->value, "forces", list) : NULL;
}

/* A force on every body, off its centre if it can turn, proportional to its weight so that ropes stay taut.
 * No line is perpendicular to both. */
static const struct vec shares[lines_pushes] = {{1.7, -2.9}, {-3.1, 0.8}};

static void write_pushes(const fbd_model *model, struct vec share, struct text *text)
{
    double pounds = strcmp(fbd_model_scene(model).units, "US") == 0 ? 14.6 : 1;
    for (size_t b = 0; b < fbd_model_body_count(model); b++) {
        const fbd_body body = fbd_model_body(model, b);
        bool turns = body.motion == FBD_MOTION_PIVOT || body.motion == FBD_MOTION_PLANAR;
        double mass = body.inertia.mass * pounds;
        text_printf(text, "%s: {applied: {name: fbd_probe, fx: %.17g N, fy: %.17g N%s}}\n", body.name,
                    share.x * mass, share.y * mass, turns ? ", at: [0.21 m, 0.13 m]" : "");
    }
}

void lines_push(struct lines *lines, int k)
{
    struct pushed *pushed = &lines->pushed[k];
    struct arena *arena = &lines->grade->arena;
    const struct node *bodies = lines_value(lines->root, "bodies"), *made = bodies;
    struct text text = {0};
    if (pushed->made) return;
    fbd_errors *errors = fbd_errors_new();
    pushed->made = true;
    write_pushes(lines->model, shares[k], &text);
    char *kept = errors && !text.failed ? arena_text(arena, text.data, text.length) : NULL;
    const struct node *probes = kept ? node_open(arena, kept, text.length, errors) : NULL;
    for (size_t b = 0; probes && made && b < bodies->count; b++) {
        const struct node *body = pushed_body(arena, probes, &bodies->pairs[b]);
        made = body ? node_with(arena, made, bodies->pairs[b].key, body) : NULL;
    }
    pushed->root = probes && made ? node_with(arena, lines->root, "bodies", made) : NULL;
    if (pushed->root) pushed->model = lines_try(lines, pushed->root, true, false, errors);
    if (!errors || text.failed) lines->grade->arena.failed = true;
    fbd_errors_free(errors);
    text_free(&text);
}

/* ---- the motion of the sheet */

/* For each body: the senses in which its friction slips in the run of the sheet, bit k for slip k - 1; all of
 * them if it does not slip. */
unsigned *lines_slips(struct fbd_grade *grade)
{
    enum { most_steps = 400 };
    const fbd_model *model = grade->sheet;
    const size_t bodies = fbd_model_body_count(model);
    unsigned *found = ARENA_ARRAY(&grade->arena, bodies + 1, unsigned);
    fbd_errors *errors = fbd_errors_new();
    fbd_simulation *run = found && errors ? fbd_simulation_new(model, NULL, errors) : NULL;
    fbd_state *state = run ? fbd_state_new(model) : NULL;
    bool rubs = false;
    for (size_t b = 0; b < bodies; b++) rubs = rubs || fbd_model_body(model, b).friction;
    for (int step = 0; state && rubs && step < most_steps; step++) {
        double from, to;
        if (fbd_simulation_advance(run) != FBD_GOING) break;
        fbd_simulation_interval(run, &from, &to);
        if (!fbd_simulation_state(run, from + 0.5 * (to - from), state)) continue;
        for (size_t b = 0; b < bodies; b++) {
            int slip = fbd_state_slip(state, b);
            if (slip != 0) found[b] |= 1U << (slip + 1);
        }
    }
    for (size_t b = 0; found && b < bodies; b++) found[b] = found[b] ? found[b] | 2U : 7U;
    fbd_state_free(state);
    fbd_simulation_free(run);
    fbd_errors_free(errors);
    return errors ? found : NULL;
}
