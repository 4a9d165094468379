/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The equations of a body. First those of its coordinates, which do not contain the reaction of its own
 * joint: of a slide the forces along it, m v_dot = sum of f_x; of a pivot the moments about its axis O. A
 * joint on another body may be accelerated, and the accelerations are then those in the world: a_x is the
 * component of a_G along x, and
 *
 *     I_O alpha = sum of moments about O - m r_OG x a_O
 *
 * Then, on request and for a body without coordinates, Newton's and Euler's equations of the body cut free,
 * including reactions: m a_G = sum of forces, I_G alpha = sum of moments about G.
 */
#include "output/equations.h"

#include <stdlib.h>
#include <string.h>

#include "dynamics/diagram.h"
#include "dynamics/mass.h"
#include "dynamics/modes.h"
#include "dynamics/tree.h"
#include "fbd_study.h"
#include "output/words.h"
#include "record/result.h"

void state_ready(struct fbd_state *state)
{
    if (state->settled)
        state_evaluate(state);
    else
        modes_settle(state, NULL);
}

/* ---- accelerations and components */

bool equation_has_coordinate(const struct model_body *body)
{
    return body->parent == ground_body && body->joint->path != path_curve && !body_is_off_center(body);
}

double equation_acceleration(const struct model_body *body, const struct instant *at, const double *a,
                             int part)
{
    if (equation_has_coordinate(body)) return a[body->first + part];
    if (coordinate_is_angle(body, part)) return body_angular_acceleration(body, at);
    struct vec a_G = mass_center_acceleration(body, at), e = body_direction(body, at);
    return part == 0 ? vec_dot(e, a_G) : vec_cross(e, a_G);
}

const char *equation_acceleration_name(const struct fbd_model *model, const struct model_body *body, int part)
{
    static const char *const in_world[] = {"a_x", "a_y", "alpha"};
    const bool on_curve = body->joint->path == path_curve;
    if (body->parent == ground_body && !on_curve) return model->labels[body->first + part].acceleration_name;
    return on_curve ? "a_s" : in_world[coordinate_is_angle(body, part) ? 2 : part];
}

double equation_term(const struct model_body *body, const struct arrow *arrow, int part, struct vec G)
{
    const bool about_G = coordinate_is_angle(body, part) && !body->joint->has_axis;
    return about_G ? arrow_moment(arrow, G) : arrow->share[part];
}

/* ---- rows */

static void add_term(struct equation *equation, const char *name, double value, int load)
{
    fbd_equation *e = &equation->public;
    ((fbd_term *)e->terms)[e->term_count] = (fbd_term){name, value};
    ((int *)equation->loads)[e->term_count++] = load;
    e->sum += value;
}

/* Append an equation with room for its terms; NULL when memory is out. */
static struct equation *add_equation(struct fbd_equations *all, const struct equation *equation, size_t most)
{
    fbd_term *terms = ARENA_ARRAY(&all->arena, most, fbd_term);
    int *loads = ARENA_ARRAY(&all->arena, most, int);
    if (!terms || !loads) return NULL;
    struct equation *added = &all->equations[all->count++];
    *added = *equation;
    added->public.terms = terms;
    added->loads = loads;
    return added;
}

static void add_of_coordinate(struct fbd_equations *all, const struct fbd_state *state, int b, int part,
                              const struct arrow *arrows, size_t count)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    const struct label *label = &model->labels[body->first + part];
    const struct instant at = state_instant(state);
    const struct vec G = mass_center(body, &at);
    const struct equation row = {
        .body = b,
        .part = part,
        .public = {.body = body->name,
                   .coordinate = model->scene->coordinates[body->first + part].name,
                   .inertia_name = body->joint->coordinates[part].inertia,
                   .acceleration_name = equation_acceleration_name(model, body, part),
                   .unit = label->force_unit,
                   .inertia_unit = label->inertia_unit,
                   .acceleration_unit = label->acceleration_unit,
                   .inertia = coordinate_inertia_at(body, part, &at),
                   .acceleration = equation_acceleration(body, &at, state->a, part)},
    };
    struct equation *equation = add_equation(all, &row, count + 1);
    for (size_t i = 0; equation && i < count; i++) {
        const struct arrow *arrow = &arrows[i];
        bool of_joint = arrow_is_of_joint(model, b, arrow);
        if (of_joint && arrow->load < 0) continue;
        add_term(equation, arrow->name, equation_term(body, arrow, part, G), arrow->load);
        if (of_joint) equation->public.normal = vec_dot(arrow->force, surface_normal(model, body, &at));
    }
    if (equation && tree_has_more(body))
        add_term(equation, body->joint->has_axis ? "moving axis" : "turning along", tree_more(body, &at), -1);
}

static void add_cut_free(struct fbd_equations *all, const struct fbd_state *state, int b,
                         const struct arrow *arrows, size_t count)
{
    static const char *const names[] = {"G.x", "G.y", "G.angle"};
    static const char *const accelerations[] = {"a_Gx", "a_Gy", "alpha"};
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    const bool si = model->scene->units == unit_si;
    const struct instant at = state_instant(state);
    const struct vec G = mass_center(body, &at), a_G = mass_center_acceleration(body, &at);
    const double acceleration[] = {a_G.x, a_G.y, body_angular_acceleration(body, &at)};
    for (int part = 0; part < (body_never_turns(body) ? 2 : 3); part++) {
        bool moment = part == 2;
        const struct equation row = {
            .body = b,
            .part = part,
            .cut_free = true,
            .public = {.body = body->name,
                       .coordinate = names[part],
                       .inertia_name = moment ? "I_G" : "m",
                       .acceleration_name = accelerations[part],
                       .unit = moment ? moment_unit(model) : force_unit(model),
                       .inertia_unit = moment ? (si ? "kg*m^2" : "slug*ft^2")
                                       : si   ? "kg"
                                              : "slug",
                       .acceleration_unit = moment ? "rad/s^2"
                                            : si   ? "m/s^2"
                                                   : "ft/s^2",
                       .inertia = moment ? body_inertia(body, &at).I_G : body_mass(body, &at),
                       .acceleration = acceleration[part]},
        };
        struct equation *equation = add_equation(all, &row, count);
        for (size_t i = 0; equation && i < count; i++) {
            const struct arrow *arrow = &arrows[i];
            const double values[] = {arrow->force.x, arrow->force.y, arrow_moment(arrow, G)};
            add_term(equation, arrow->name, values[part], arrow->load);
        }
    }
}

fbd_equations *assemble(fbd_state *state, bool components)
{
    if (!state) return NULL;
    const struct fbd_model *model = state->model;
    fbd_equations *all = calloc(1, sizeof *all);
    if (!all) return NULL;
    state_ready(state);
    struct instant at = state_instant(state);
    enum { rows_of_a_body = most_coordinates_of_a_body + 3 };
    all->equations = ARENA_ARRAY(&all->arena, rows_of_a_body * model->body_count, struct equation);
    for (size_t b = 0; all->equations && b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        struct arrow *arrows = ARENA_ARRAY(&all->arena, diagram_arrows(model, (int)b), struct arrow);
        if (!arrows) break;
        size_t count = diagram_fill(model, (int)b, &at, state->slots, arrows);
        for (int part = 0; part < body->count; part++)
            add_of_coordinate(all, state, (int)b, part, arrows, count);
        if (components || body->count == 0) add_cut_free(all, state, (int)b, arrows, count);
    }
    if (!all->arena.failed) return all;
    fbd_equations_free(all);
    return NULL;
}

fbd_equations *fbd_assemble(fbd_state *state)
{
    return assemble(state, false);
}

fbd_equations *fbd_assemble_components(fbd_state *state)
{
    return assemble(state, true);
}

void fbd_equations_free(fbd_equations *equations)
{
    if (!equations) return;
    arena_free(&equations->arena);
    free(equations);
}

static const fbd_equation no_equation = {.inertia = NAN, .sum = NAN, .acceleration = NAN, .normal = NAN};

size_t fbd_equations_count(const fbd_equations *equations)
{
    if (!equations) return 0;
    return equations->count;
}

fbd_equation fbd_equations_get(const fbd_equations *equations, size_t index)
{
    return equations && index < equations->count ? equations->equations[index].public : no_equation;
}

fbd_equation fbd_equations_find(const fbd_equations *equations, const char *coordinate)
{
    if (!equations || !coordinate) return no_equation;
    const char *dot = strchr(coordinate, '.');
    for (size_t i = 0; dot && i < equations->count; i++) {
        const fbd_equation *equation = &equations->equations[i].public;
        size_t length = (size_t)(dot - coordinate);
        if (strlen(equation->body) == length && strncmp(equation->body, coordinate, length) == 0 &&
            strcmp(equation->coordinate, dot + 1) == 0)
            return *equation;
    }
    return no_equation;
}

double fbd_equation_term(const fbd_equation *equation, const char *name)
{
    if (!name) return NAN;
    for (size_t i = 0; equation && i < equation->term_count; i++)
        if (strcmp(equation->terms[i].name, name) == 0) return equation->terms[i].value;
    return NAN;
}

struct vec moment_center(const struct model_body *body, const struct instant *at)
{
    return body->joint->has_axis ? body_pose(body, at).origin : mass_center(body, at);
}

fbd_arrow public_arrow(const struct arrow *arrow, struct vec about)
{
    return (fbd_arrow){.name = arrow->name,
                       .fx = arrow->force.x,
                       .fy = arrow->force.y,
                       .x = arrow->point.x,
                       .y = arrow->point.y,
                       .couple = arrow->couple,
                       .moment = arrow_moment(arrow, about),
                       .power = arrow->power};
}

size_t fbd_diagram(fbd_state *state, size_t body, fbd_arrow *arrows, size_t room)
{
    if (!state) return 0;
    if (!arrows) room = 0;
    const struct fbd_model *model = state->model;
    if (body >= model->body_count) return 0;
    const struct model_body *b = &model->bodies[body];
    state_ready(state);
    struct instant at = state_instant(state);
    struct arrow *own = calloc(diagram_arrows(model, (int)body), sizeof *own);
    if (!own) return 0;
    size_t count = diagram_fill(model, (int)body, &at, state->slots, own);
    const struct vec about = moment_center(b, &at);
    for (size_t i = 0; i < count && i < room; i++) arrows[i] = public_arrow(&own[i], about);
    free(own);
    return count;
}

size_t fbd_result_force_errors(fbd_result *result, size_t body, fbd_arrow *arrows, size_t room)
{
    if (!result) return 0;
    if (!arrows) room = 0;
    struct bars *bars = result->simulation->bars;
    if (!bars) return 0;
    size_t count = fbd_diagram(fbd_result_state(result), body, arrows, room);
    fbd_arrow *others = calloc(room + 1, sizeof *others);
    if (!others) return 0;
    if (fbd_diagram(bars->state, body, others, room) != count) count = 0; /* memory is out */
    for (size_t i = 0; i < count && i < room; i++) {
        arrows[i].fx = bars_difference(bars, arrows[i].fx, others[i].fx);
        arrows[i].fy = bars_difference(bars, arrows[i].fy, others[i].fy);
        arrows[i].x = bars_difference(bars, arrows[i].x, others[i].x);
        arrows[i].y = bars_difference(bars, arrows[i].y, others[i].y);
        arrows[i].couple = bars_difference(bars, arrows[i].couple, others[i].couple);
        arrows[i].moment = bars_difference(bars, arrows[i].moment, others[i].moment);
        arrows[i].power = bars_difference(bars, arrows[i].power, others[i].power);
    }
    free(others);
    return count;
}
