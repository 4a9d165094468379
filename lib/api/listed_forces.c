/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: the forces on bodies with their origin.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/diagram.h"
#include "dynamics/kinematics.h"
#include "dynamics/state.h"
#include "dynamics/tree.h"
#include "fbd_view.h"
#include "output/equations.h"
#include "output/hand_forces.h"
#include "scene/language.h"
#include "scene/law.h"

fbd_scene fbd_model_scene(const fbd_model *model)
{
    if (!model) return (fbd_scene){.units = "", .gravity = {NAN, NAN}, .pressing = NAN};
    const struct scene *scene = model->scene;
    return (fbd_scene){.units = scene->units == unit_us ? "US" : "SI",
                       .gravity = {scene->gravity.x, scene->gravity.y},
                       .pressing = scene->pressing};
}

int fbd_state_slip(fbd_state *state, size_t body)
{
    if (!state || body >= state->model->body_count) return 0;
    const int friction = state->model->bodies[body].friction;
    state_ready(state);
    return friction >= 0 ? slip_side(state->slip[friction]) : 0;
}

/* ---- entries of the file */

static const char *word_of(const struct load *load)
{
    const struct kinds *const lists[] = {&force_kinds, &moment_kinds};
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < lists[k]->count; i++)
            if (lists[k]->kinds[i].value == (int)load->kind) return lists[k]->kinds[i].name;
    return "";
}

static double coefficient(const struct value *value, const fbd_state *state)
{
    if (!value->expr) return 0;
    return expr_is_constant(value->expr) ? expr_value(value->expr)
                                         : expr_eval(value->expr, state->t, state->y, NULL);
}

static void describe_load(const fbd_state *state, const struct model_body *body, const struct load *load,
                          const struct instant *at, fbd_listed_force *force)
{
    static const char *const sides[] = {[side_up] = "up", [side_left] = "left", [side_right] = "right"};
    const bool normal = load->kind == load_normal;
    const bool constant = load->value.expr && expr_is_constant(load->value.expr);
    force->law = word_of(load);
    force->placed = load->point.kind != point_absent;
    force->line = load->at.line;
    force->column = load->at.column;
    force->moment = load->kind >= moment_applied && load->kind <= moment_potential;
    force->side = normal ? sides[load->side] : "";
    force->size = constant ? expr_value(load->value.expr) : NAN;
    force->mu_s = coefficient(&load->mu_s, state);
    force->mu_k = coefficient(&load->mu_k, state);
    force->surface_speed = coefficient(&load->surface_speed, state);
    if (!normal) return;
    const struct vec across = surface_normal(state->model, body, at);
    force->along[0] = across.x;
    force->along[1] = across.y;
}

/* ---- the coupling, contact or guide that exerts a reaction */

/* The direction of the force of row `row` of a coupling at its end k; zero if it has no fixed direction. */
static struct vec direction_of(const struct coupling *coupling, int k, int row, const struct instant *at)
{
    struct vec sum = {0, 0};
    if (coupling->row_count > 1 && !coupling->law->end_names[1]) return sum; /* a pin */
    const struct row *one = &at->tree->rows[coupling->first_row + (row < coupling->row_count ? row : 0)];
    for (int i = 0; i < one->port_count; i++)
        if (one->ports[i].end == k) sum = vec_add(sum, one->ports[i].force);
    return sum;
}

static struct vec describe_joint(const fbd_model *model, int b, const char *name, const struct instant *at,
                                 fbd_listed_force *force)
{
    const struct model_body *body = &model->bodies[b];
    for (size_t c = 0; c < model->body_count;
         c++) /* on a body that carries another one: of that one's joint */
        if (name && model->bodies[c].reaction_on_parent == name) body = &model->bodies[c];
    bool joint = name && (name == body->reaction || name == body->reaction_on_parent);
    const bool guided = body->joint->path != path_none;
    force->couples = joint && !body->joint->has_axis;
    if (!joint && body->alone) joint = true; /* on the ground: `pin` or `guide` */
    force->free = joint && !guided;
    return joint && guided ? vec_perp(body_direction(body, at)) : (struct vec){0, 0};
}

static void describe_reaction(const fbd_model *model, int b, const struct instant *at,
                              fbd_listed_force *force)
{
    const char *name = force->arrow.name;
    struct vec along = describe_joint(model, b, name, at, force);
    for (int i = 0, found = 0; !found && i < model->tree->coupling_count; i++) {
        const struct coupling *coupling = &model->tree->couplings[i];
        for (int k = 0; !found && k < coupling->end_count; k++)
            for (int row = 0; !found && row < 2; row++) {
                if (coupling->end[k].body != b || coupling->end[k].name[row] != name) continue;
                const bool rope = coupling->kind == constraint_rope || coupling->law->strands;
                force->one_sided = rope || (coupling_presses(coupling) && row == 0);
                if (coupling->kind == constraint_contact) force->contact = coupling->constraint;
                along = direction_of(coupling, k, row, at);
                force->free = coupling->row_count > 1 && !coupling->law->end_names[1];
                force->couples = coupling_has_couple(coupling);
                found = 1;
            }
    }
    force->along[0] = along.x;
    force->along[1] = along.y;
}

/* ---- forces */

/* The arrows of a body at a state, with their number; NULL when memory is out. */
static struct arrow *arrows_of(fbd_state *state, int b, size_t *count)
{
    const struct fbd_model *model = state->model;
    state_ready(state);
    const struct instant at = state_instant(state);
    struct arrow *arrows = calloc(diagram_arrows(model, b) + 1, sizeof *arrows);
    *count = arrows ? diagram_fill(model, b, &at, state->slots, arrows) : 0;
    return arrows;
}

size_t fbd_state_forces(fbd_state *state, size_t body, fbd_listed_force *forces, size_t room)
{
    if (!state || body >= state->model->body_count) return 0;
    const struct fbd_model *model = state->model;
    const struct model_body *b = &model->bodies[body];
    size_t count;
    struct arrow *arrows = arrows_of(state, (int)body, &count);
    const struct instant at = state_instant(state);
    const struct vec about = moment_center(b, &at);
    for (size_t i = 0; forces && i < count && i < room; i++) {
        forces[i] =
            (fbd_listed_force){.arrow = public_arrow(&arrows[i], about), .law = "", .side = "", .size = NAN};
        forces[i].reaction = arrow_is_reaction(model, &arrows[i]);
        forces[i].contact = -1;
        if (i < b->source->load_count)
            describe_load(state, b, model->loads[arrows[i].load].source, &at, &forces[i]);
        else
            describe_reaction(model, (int)body, &at, &forces[i]);
    }
    free(arrows);
    return arrows ? count : SIZE_MAX;
}

static const struct hand_force *find_name(const struct hand_forces *forces, size_t body, const char *name)
{
    for (int letter = 0; letter < 2; letter++)
        for (size_t i = 0; i < forces->count; i++) {
            const struct force_name *one = &forces->list[i].name;
            if (one->body == (int)body && one->letter == (letter == 1) && strcmp(one->name, name) == 0)
                return &forces->list[i];
        }
    return NULL;
}

bool fbd_state_named_force(fbd_state *state, size_t body, const char *name, fbd_named_force *found)
{
    if (!state || body >= state->model->body_count || !name || !found) return false;
    struct arena arena = {0};
    struct hand_forces forces = {0};
    size_t count;
    struct arrow *arrows = arrows_of(state, (int)body, &count);
    const struct instant at = state_instant(state);
    const bool listed = arrows && hand_forces_make(state->model, &arena, &forces);
    const struct hand_force *one = listed ? find_name(&forces, body, name) : NULL;
    *found = (fbd_named_force){.force = SIZE_MAX, .value = NAN};
    if (one)
        *found = (fbd_named_force){.force = one->arrow,
                                   .moment = one->symbol->moment,
                                   .value = hand_force_value(state->model, one, &at, arrows)};
    free(arrows);
    arena_free(&arena);
    return one || !listed;
}
