/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: positions, and views of a state for drawings.
 */
#include <math.h>
#include <stdlib.h>

#include "base/api_check.h"
#include "dynamics/constraint.h"
#include "dynamics/diagram.h"
#include "dynamics/mass.h"
#include "dynamics/tree.h"
#include "fbd_view.h"
#include "output/equations.h"
#include "output/symbols.h"
#include "rest/start.h"

struct view_body {
    fbd_pose pose;
    fbd_mass mass;
    size_t force_count;
    fbd_force *forces;
};

struct view_coupling {
    fbd_coupling coupling;
    fbd_coupling_end *ends;
};

struct fbd_view {
    struct arena arena;
    size_t body_count, spring_count, coupling_count;
    struct view_body *bodies;
    fbd_spring *springs;
    struct view_coupling *couplings;
};

/* ---- bodies */

static const fbd_pose no_pose = {NAN, NAN, NAN, NAN, NAN, {NAN, NAN}, {NAN, NAN}, {NAN, NAN}};

static fbd_pose pose_of(const struct fbd_model *model, const struct model_body *body,
                        const struct instant *at)
{
    const struct pose pose = body_pose(body, at);
    const struct vec G = point_motion(body, &pose, body->inertia.G).p;
    struct vec along = {1, 0}, normal = {0, 1};
    if (body->joint->path == path_line) {
        along = pose.rotation;
        normal = vec_scale(vec_dot(body->n, vec_perp(body->e)) > 0 ? 1 : -1, vec_perp(along));
    } else if (body->joint->path == path_curve) {
        along = body_direction(body, at);
        normal = surface_normal(model, body, at);
    }
    return (fbd_pose){.x = pose.origin.x,
                      .y = pose.origin.y,
                      .angle = body_angle(body, at),
                      .cosine = pose.rotation.x,
                      .sine = pose.rotation.y,
                      .G = {G.x, G.y},
                      .along = {along.x, along.y},
                      .normal = {normal.x, normal.y}};
}

fbd_pose fbd_state_pose(fbd_state *state, size_t body)
{
    if (!state || body >= state->model->body_count) return no_pose;
    const struct instant at = state_instant(state);
    tree_move(state->model, &at);
    return pose_of(state->model, &state->model->bodies[body], &at);
}

fbd_point_motion fbd_state_point_motion(fbd_state *state, size_t body, const double point[2])
{
    if (!state || !point || body >= state->model->body_count)
        return (fbd_point_motion){{NAN, NAN}, {NAN, NAN}, {NAN, NAN}, NAN, NAN};
    state_ready(state);
    const struct instant at = state_instant(state);
    const struct model_body *of = &state->model->bodies[body];
    const struct vec place = {point[0], point[1]};
    const struct pose pose = body_pose(of, &at);
    const struct motion_of_point moved = point_motion(of, &pose, place);
    const struct vec a = point_acceleration(of, place, &at);
    return (fbd_point_motion){.position = {moved.p.x, moved.p.y},
                              .velocity = {moved.v.x, moved.v.y},
                              .acceleration = {a.x, a.y},
                              .omega = pose.omega,
                              .alpha = body_angular_acceleration(of, &at)};
}

static fbd_mass mass_of(const struct fbd_model *model, int b, const struct instant *at, struct arena *arena)
{
    const struct model_body *body = &model->bodies[b];
    const char *symbol = symbol_of_mass(model, b, arena);
    return (fbd_mass){.mass = body_mass(body, at),
                      .I_G = body_inertia(body, at).I_G,
                      .I_O = body_I_O(body, at),
                      .symbol = symbol,
                      .printed = symbol ? symbol_printed(symbol, arena) : NULL};
}

/* ---- forces */

/* Its origin, with the arrow itself and its symbol. */
static fbd_force force_of(const struct fbd_model *model, int b, const struct arrow *arrow,
                          const struct force_symbol *symbol, struct vec about, struct arena *arena)
{
    fbd_force force = {.arrow = public_arrow(arrow, about),
                       .kind = drawing_of_force(model, b, arrow->name, arrow->load),
                       .slide = -1,
                       .symbol = symbol_now(symbol),
                       .printed = symbol_printed(symbol_now(symbol), arena),
                       .moment = symbol->moment};
    if (arrow->load < 0) return force;
    const struct model_load *load = &model->loads[arrow->load];
    const enum load_kind kind = load->source->kind;
    const bool listed =
                   (size_t)arrow->load < model->listed_count, /* a coupling is no surface under the body */
        on_line = model->bodies[load->body].joint->path == path_line;
    if ((kind != load_normal && kind != load_friction) || !on_line || !listed) return force;
    force.slide = load->body;
    force.normal = kind == load_normal;
    return force;
}

static bool take_forces(struct fbd_view *view, const struct fbd_state *state, int b, struct arrow *arrows,
                        const struct force_symbol *symbols)
{
    const struct fbd_model *model = state->model;
    const struct instant at = state_instant(state);
    const struct model_body *body = &model->bodies[b];
    const struct vec about = moment_center(body, &at);
    struct view_body *seen = &view->bodies[b];
    seen->force_count = diagram_fill(model, b, &at, state->slots, arrows);
    seen->forces = ARENA_ARRAY(&view->arena, seen->force_count + 1, fbd_force);
    if (!seen->forces) return false;
    for (size_t i = 0; i < seen->force_count; i++) {
        seen->forces[i] = force_of(model, b, &arrows[i], &symbols[i], about, &view->arena);
        if (!seen->forces[i].printed) return false;
    }
    return true;
}

static bool take_bodies(struct fbd_view *view, const struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    const struct instant at = state_instant(state);
    const struct force_symbol *const *symbols = symbols_of_forces(state, &view->arena);
    struct arrow *arrows = ARENA_ARRAY(&view->arena, diagram_most_arrows(model), struct arrow);
    view->bodies = ARENA_ARRAY(&view->arena, model->body_count, struct view_body);
    if (!symbols || !arrows || !view->bodies) return false;
    view->body_count = model->body_count;
    for (size_t b = 0; b < model->body_count; b++) {
        view->bodies[b].pose = pose_of(model, &model->bodies[b], &at);
        view->bodies[b].mass = mass_of(model, (int)b, &at, &view->arena);
        if (!view->bodies[b].mass.printed) return false;
        if (!take_forces(view, state, (int)b, arrows, symbols[b])) return false;
    }
    return true;
}

/* ---- springs and couplings */

/* With one end on a slide of the ground the other is a wall across its line. */
static bool is_seen(const struct fbd_model *model, const struct model_load *load)
{
    const struct model_body *body = &model->bodies[load->body];
    if (load->source->kind != load_spring && load->source->kind != load_damper) return false;
    return load->linked || (body->joint->path == path_line && body->parent == ground_body);
}

static bool take_springs(struct fbd_view *view, const struct fbd_model *model)
{
    view->springs = ARENA_ARRAY(&view->arena, model->load_count + 1, fbd_spring);
    for (size_t i = 0; view->springs && i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (!is_seen(model, load)) continue;
        view->springs[view->spring_count++] =
            (fbd_spring){.name = load->source->name,
                         .damper = load->source->kind == load_damper,
                         .body = load->body,
                         .partner = load->linked ? load->partner : FBD_GROUND,
                         .point = {load->point.x, load->point.y},
                         .anchor = {load->linked ? load->anchor.x : NAN,
                                    load->linked ? load->anchor.y : NAN}};
    }
    return view->springs != NULL;
}

/* Set the places from the ports of its first row, which act where its other rows do. */
static void set_places(fbd_coupling_end *seen, const struct tree_work *tree, const struct coupling *coupling,
                       int end)
{
    const struct row *row = &tree->rows[coupling->first_row];
    for (int i = 0; i < row->port_count && seen->place_count < 2; i++) {
        if (row->ports[i].end != end) continue;
        const struct vec place = vec_add(tree->links[row->ports[i].link].p, row->ports[i].arm);
        seen->places[seen->place_count][0] = place.x;
        seen->places[seen->place_count++][1] = place.y;
    }
}

static fbd_coupling_end end_of(const struct fbd_state *state, const struct coupling *coupling, int end)
{
    const struct point *source = &coupling->source->point[coupling->place + end];
    const int body = coupling->end[end].body;
    const bool at_G = body != ground_body && source->kind != point_fixed;
    const struct vec point = at_G ? state->model->bodies[body].inertia.G : source->where;
    fbd_coupling_end seen = {.body = body,
                             .point = {point.x, point.y},
                             .radius = coupling_has_circles(coupling) ? coupling->end[end].radius : 0,
                             .force = body == ground_body ? NULL : coupling->end[end].name[0]};
    set_places(&seen, state->tree, coupling, end);
    return seen;
}

/* The forces of a contact with a polygon or another body turn from one side to the next. */
static bool is_lined(const struct coupling *coupling)
{
    if (coupling->kind == constraint_contact) return coupling->source->contact.line;
    return (coupling->law->surface && !coupling->law->strands) || coupling->kind == constraint_rack;
}

static bool take_couplings(struct fbd_view *view, const struct fbd_state *state)
{
    const struct tree *tree = state->model->tree;
    const int count = tree ? tree->coupling_count : 0;
    view->couplings = ARENA_ARRAY(&view->arena, (size_t)count + 1, struct view_coupling);
    for (int i = 0; view->couplings && i < count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        const struct coupling_state *start = &state->tree->couplings[i];
        if (coupling->kind == constraint_resistance) continue; /* its roll is drawn */
        struct view_coupling *seen = &view->couplings[view->coupling_count++];
        seen->coupling = (fbd_coupling){.kind = coupling->law->drawing,
                                        .name = coupling->name,
                                        .entry = (size_t)coupling->constraint,
                                        .pulls = coupling->law->length,
                                        .lined = is_lined(coupling),
                                        .end_count = (size_t)coupling->end_count,
                                        .length = coupling->reels ? 0 : start->zero,
                                        .angle = coupling->source->along,
                                        .side = start->side[0]};
        seen->ends = ARENA_ARRAY(&view->arena, seen->coupling.end_count, fbd_coupling_end);
        for (int end = 0; seen->ends && end < coupling->end_count; end++)
            seen->ends[end] = end_of(state, coupling, end);
    }
    return view->couplings != NULL;
}

/* ---- the whole */

static fbd_view *view_of(fbd_state *state, fbd_errors *errors)
{
    struct lack lack = {0};
    diag_in_file(errors, state->model->scene->file);
    state_ready(state);
    if (!start_finite(state, &lack)) {
        lack_note(&lack, errors);
        return NULL;
    }
    fbd_view *view = calloc(1, sizeof *view);
    if (view && take_bodies(view, state) && take_springs(view, state->model) && take_couplings(view, state) &&
        !view->arena.failed)
        return view;
    fbd_view_free(view);
    diag_out_of_memory(errors);
    return NULL;
}

fbd_view *fbd_view_new(fbd_state *state, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_view *view = state ? view_of(state, errors) : api_refuse(errors, "there is no state");
    diag_end(&call);
    return view;
}

void fbd_view_free(fbd_view *view)
{
    if (!view) return;
    arena_free(&view->arena);
    free(view);
}

fbd_pose fbd_view_pose(const fbd_view *view, size_t body)
{
    if (view && body < view->body_count) return view->bodies[body].pose;
    return no_pose;
}

fbd_mass fbd_view_mass(const fbd_view *view, size_t body)
{
    if (view && body < view->body_count) return view->bodies[body].mass;
    return (fbd_mass){NAN, NAN, NAN, NULL, NULL};
}

size_t fbd_view_force_count(const fbd_view *view, size_t body)
{
    return view && body < view->body_count ? view->bodies[body].force_count : 0;
}

fbd_force fbd_view_force(const fbd_view *view, size_t body, size_t index)
{
    if (index < fbd_view_force_count(view, body)) return view->bodies[body].forces[index];
    return (fbd_force){.arrow = {NULL, NAN, NAN, NAN, NAN, NAN, NAN, NAN}, .slide = -1};
}

size_t fbd_view_spring_count(const fbd_view *view)
{
    return view ? view->spring_count : 0;
}

fbd_spring fbd_view_spring(const fbd_view *view, size_t index)
{
    if (index < fbd_view_spring_count(view)) return view->springs[index];
    return (fbd_spring){.body = FBD_GROUND, .partner = FBD_GROUND, .point = {NAN, NAN}, .anchor = {NAN, NAN}};
}

size_t fbd_view_coupling_count(const fbd_view *view)
{
    return view ? view->coupling_count : 0;
}

fbd_coupling fbd_view_coupling(const fbd_view *view, size_t index)
{
    if (index < fbd_view_coupling_count(view)) return view->couplings[index].coupling;
    return (fbd_coupling){.length = NAN, .angle = NAN};
}

fbd_coupling_end fbd_view_coupling_end(const fbd_view *view, size_t index, size_t end)
{
    if (end < fbd_view_coupling(view, index).end_count) return view->couplings[index].ends[end];
    return (fbd_coupling_end){.body = FBD_GROUND, .point = {NAN, NAN}, .radius = NAN};
}
