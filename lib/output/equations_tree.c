/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The equations of jointed bodies.
 *
 * First the one in which the reaction of the body's own joint does not stand: of a pivot the moments about
 * its axis O, which may accelerate itself,
 *
 *     I_O alpha = sum of moments about O - m r_OG x a_O
 *
 * of a slide the forces along it, m a_x = sum of f_x, with a_x the component of a_G. Then Newton and Euler
 * for the body cut free, reactions and all: m a_G = sum of forces, I_G alpha = sum of moments about G. The
 * accelerations are those in the world.
 */
#include "dynamics/diagram.h"
#include "dynamics/tree.h"
#include "output/equations.h"

struct row {
    const char *coordinate, *inertia_name, *acceleration_name, *side;
    double inertia, acceleration;
    bool moment;
};

static const char *unit_of(const struct fbd_model *model, bool moment, const char *const si[2],
                           const char *const us[2])
{
    return model->scene->units == unit_si ? si[moment] : us[moment];
}

/* Append an equation without terms; NULL when memory is out. */
static struct equation *add_row(struct fbd_equations *all, const struct fbd_model *model, int b,
                                const struct row *row, size_t most_terms)
{
    static const char *const forces[2] = {"N", "N*m"}, *const us_forces[2] = {"lbf", "lbf*ft"};
    static const char *const inertias[2] = {"kg", "kg*m^2"}, *const us_inertias[2] = {"slug", "slug*ft^2"};
    static const char *const rates[2] = {"m/s^2", "rad/s^2"}, *const us_rates[2] = {"ft/s^2", "rad/s^2"};
    fbd_term *terms = ARENA_ARRAY(&all->arena, most_terms + 1, fbd_term);
    int *loads = ARENA_ARRAY(&all->arena, most_terms + 1, int);
    if (!terms || !loads) return NULL;
    struct equation *equation = &all->equations[all->count++];
    *equation = (struct equation){.body = b, .jointed = true, .side = row->side, .loads = loads};
    equation->public = (fbd_equation){
        .body = model->bodies[b].name,
        .coordinate = row->coordinate,
        .inertia_name = row->inertia_name,
        .acceleration_name = row->acceleration_name,
        .unit = unit_of(model, row->moment, forces, us_forces),
        .inertia_unit = unit_of(model, row->moment, inertias, us_inertias),
        .acceleration_unit = unit_of(model, row->moment, rates, us_rates),
        .inertia = row->inertia,
        .acceleration = row->acceleration,
        .terms = terms,
    };
    return equation;
}

static void add_term(struct equation *equation, const char *name, double value, int load)
{
    fbd_equation *e = &equation->public;
    ((fbd_term *)e->terms)[e->term_count] = (fbd_term){name, value};
    ((int *)equation->loads)[e->term_count++] = load;
    e->sum += value;
}

/* The equation along the body's own coordinate. */
static void add_joint_row(struct fbd_equations *all, const struct fbd_state *state, int b,
                          const struct arrow *arrows, size_t count)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    const struct tree_state *s = &state->tree->links[body->place.link];
    struct instant at = state_instant(state);
    bool pivot = body->kind == motion_pivot;
    struct vec a_G = tree_mass_center_acceleration(body, &at);
    bool track = body->kind == motion_track;
    struct row row = {
        .coordinate = model->scene->coordinates[body->first].name,
        .inertia_name = pivot ? "I_O" : "m",
        .acceleration_name = pivot   ? "alpha"
                             : track ? "a_s"
                                     : "a_x",
        .side = pivot   ? "sum of moments about O"
                : track ? "sum of forces along the track"
                        : "sum of forces along x",
        .inertia = pivot ? body->I_O : body->inertia.mass,
        .acceleration = pivot ? tree_angular_acceleration(body, &at) : vec_dot(s->e, a_G),
        .moment = pivot,
    };
    struct equation *equation = add_row(all, model, b, &row, count + 1);
    if (!equation) return;
    for (size_t i = 0; i < count; i++) {
        if (arrows[i].name == body->reaction) continue;
        add_term(equation, arrows[i].name, arrows[i].share[0], arrows[i].load);
        if (arrows[i].load >= 0 && model->loads[arrows[i].load].source->kind == load_normal &&
            model->loads[arrows[i].load].body == b)
            equation->public.normal = vec_dot(arrows[i].force, surface_normal(model, body, &at));
    }
    if (tree_has_more(body))
        add_term(equation, track ? "turning along" : "moving axis", tree_more(body, &at), -1);
}

void equations_of_jointed(struct fbd_equations *all, const struct fbd_state *state, int b,
                          const struct arrow *arrows, size_t count)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    struct instant at = state_instant(state);
    struct pose pose = body_pose(body, &at);
    struct vec G = point_motion(body, &pose, body->inertia.G).p;
    struct vec a_G = tree_mass_center_acceleration(body, &at);
    double m = body->inertia.mass, alpha = tree_angular_acceleration(body, &at);
    const struct row rows[] = {
        {"G.x", "m", "a_Gx", "sum of forces in x", m, a_G.x, false},
        {"G.y", "m", "a_Gy", "sum of forces in y", m, a_G.y, false},
        {"G.angle", "I_G", "alpha", "sum of moments about G", body->inertia.I_G, alpha, true},
    };
    if (body->count == 1) add_joint_row(all, state, b, arrows, count);
    for (int part = 0; part < 3; part++) {
        struct equation *equation = add_row(all, model, b, &rows[part], count);
        for (size_t i = 0; equation && i < count; i++) {
            double value = part == 0   ? arrows[i].force.x
                           : part == 1 ? arrows[i].force.y
                                       : arrow_moment(&arrows[i], G);
            add_term(equation, arrows[i].name, value, arrows[i].load);
        }
    }
}
