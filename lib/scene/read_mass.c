/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A varying mass: rockets, tanks, chains. The body keeps its shape; its density varies, so that its centre of
 * mass is fixed and its moment of inertia is proportional to the mass. The mass that leaves or enters has the
 * velocity of the body, unless a `thrust` defines another one (Meshchersky's equation: m dv/dt = sum of
 * forces + dm/dt u, with u the velocity of that mass relative to the body).
 */
#include <math.h>

#include "base/text.h"
#include "scene/reader.h"
#include "scene/values.h"

/* Note a dependence on rates: the rate of the mass is needed before accelerations, so it may depend on time,
 * coordinates and states only. */
static bool check_slots(struct reader *reader, const struct node *node, const struct expr *mass)
{
    const struct scene *scene = reader->scene;
    const int *slots, n = (int)scene->coordinate_count;
    size_t count = expr_variables(mass, &slots);
    for (size_t i = 0; i < count; i++) {
        if (slots[i] <= n || (slots[i] > 2 * n && slots[i] <= (int)scene_size(scene))) continue;
        diag_add(reader->errors, FBD_ERROR, "not-here", node->at,
                 "make it a state, whose rate may depend on anything: `states: {fuel: {rate: ..., initial: 2 "
                 "kg}}`",
                 "a mass may depend on the time, on coordinates and on states, not on rates or places");
        return false;
    }
    return true;
}

/* Compile 1/m: its division by zero detects a vanishing mass. */
static bool derive_inverse(struct reader *reader, const struct node *node, const struct scope *scope,
                           struct body *body)
{
    const struct expr_want want = {.any_dim = true, .what = "mass"};
    struct text text = {0};
    text_add(&text, "1/(");
    text_add_bytes(&text, node->text, node->length);
    text_add(&text, ")");
    fbd_errors *errors = fbd_errors_new(); /* the text compiled before: only memory can fail */
    if (text.failed || !errors)
        diag_out_of_memory(reader->errors);
    else
        body->inverse_mass.expr = expr_compile(reader->derived, text.data, node->at, scope, &want, errors);
    if (errors && errors->out_of_memory) diag_out_of_memory(reader->errors);
    fbd_errors_free(errors);
    text_free(&text);
    return body->inverse_mass.expr != NULL;
}

bool body_mass_read(struct reader *reader, int index)
{
    struct body *body = &reader->scene->bodies[index];
    const struct draft *draft = &reader->drafts[index];
    struct names names = {.reader = reader,
                          .place = place_event,
                          .body = draft->motion_known ? index : ground_body};
    struct scope scope = names_scope(&names);
    if (!draft->mass_varies) return true;
    const struct node *node = node_find(draft->node, "mass")->value;
    if (!value_formula(reader, node, "mass", a_mass, 0, &scope, &body->mass)) return false;
    if (body->mass.by_input) {
        diag_add(reader->errors, FBD_ERROR, "not-constant", node->at,
                 "make it a state whose rate is the input: `states: {fuel: {rate: -flow, initial: 2 kg}}`",
                 "a mass cannot depend on an input: how fast it changes would not be known");
        return false;
    }
    return check_slots(reader, node, body->mass.expr) && derive_inverse(reader, node, &scope, body);
}

/* Evaluate varying masses at the start, when all states and initial values are known. */
bool masses_start(struct reader *reader)
{
    struct scene *scene = reader->scene;
    size_t n = scene->coordinate_count;
    double *y = ARENA_ARRAY(reader->arena, scene_size(scene) + 1, double);
    bool fine = true;
    if (!y) return false;
    for (size_t i = 0; i < n; i++) y[i] = scene->coordinates[i].initial;
    for (size_t i = 0; i < scene->own_count; i++) y[2 * n + i] = scene->own[i].initial;
    for (size_t b = 0; b < scene->body_count; b++) {
        const struct body *body = &scene->bodies[b];
        if (!body->mass.expr || !body->complete) continue;
        double mass = body->parts[0].mass = expr_eval(body->mass.expr, 0, y, NULL);
        if (mass > 0 && isfinite(mass)) continue;
        scene->bodies[b].parts[0].mass = 1; /* avoids further notes */
        diag_add(reader->errors, FBD_ERROR, "out-of-range", body->mass.at,
                 "let it start with a small mass above zero",
                 "the `mass` of `%s` is %g at the start: it must be above zero", body->name, mass);
        fine = false;
    }
    return fine;
}
