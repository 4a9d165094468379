/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/equations.h"

#include <stdlib.h>
#include <string.h>

#include "dynamics/diagram.h"
#include "dynamics/modes.h"

void state_ready(struct fbd_state *state)
{
    if (state->settled)
        state_evaluate(state);
    else
        modes_settle(state, NULL);
}

double equation_term(const struct model_body *body, const struct arrow *arrow, int part, struct vec G)
{
    return body->kind == motion_planar && part == 2 ? arrow_moment(arrow, G) : arrow->share[part];
}

double equation_acceleration(const struct model_body *body, const struct fbd_state *state, int part)
{
    if (body->kind == motion_planar && part < 2) {
        struct instant at = state_instant(state);
        struct vec a_G = mass_center_acceleration(body, &at, state->a);
        return part == 0 ? a_G.x : a_G.y;
    }
    return state->a[body->first + part];
}

static void fill_equation(struct fbd_equations *all, const struct fbd_state *state, int b, int part,
                          const struct arrow *arrows, size_t arrow_count)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    const struct label *label = &model->labels[body->first + part];
    struct instant at = state_instant(state);
    struct pose pose = body_pose(body, &at);
    struct vec G = point_motion(body, &pose, body->inertia.G).p;
    bool moment = body->kind == motion_pivot || part == 2;
    fbd_term *terms = ARENA_ARRAY(&all->arena, arrow_count, fbd_term);
    struct equation *equation = &all->equations[all->count++];
    *equation = (struct equation){.body = b, .part = part};
    fbd_equation *public = &equation->public;
    *public = (fbd_equation){
        .body = body->name,
        .coordinate = model->scene->coordinates[body->first + part].name,
        .inertia_name = body->kind == motion_pivot ? "I_O"
                        : moment                   ? "I_G"
                                                   : "m",
        .acceleration_name = label->acceleration_name,
        .unit = label->force_unit,
        .inertia_unit = label->inertia_unit,
        .acceleration_unit = label->acceleration_unit,
        .inertia = body->kind == motion_pivot ? body->I_O
                   : moment                   ? body->inertia.I_G
                                              : body->inertia.mass,
        .acceleration = equation_acceleration(body, state, part),
        .terms = terms,
    };
    for (size_t i = 0; terms && i < arrow_count; i++) {
        if (arrows[i].load < 0) continue; /* reactions of the guide do not act along the motion */
        double value = equation_term(body, &arrows[i], part, G);
        terms[public->term_count++] = (fbd_term){arrows[i].name, value};
        public->sum += value;
        if (model->loads[arrows[i].load].source->kind == load_normal)
        public->normal = vec_dot(arrows[i].force, body->n);
    }
}

fbd_equations *fbd_assemble(fbd_state *state)
{
    if (!state) return NULL;
    const struct fbd_model *model = state->model;
    fbd_equations *all = calloc(1, sizeof *all);
    if (!all) return NULL;
    state_ready(state);
    struct instant at = state_instant(state);
    enum { rows_of_a_body = most_coordinates_of_a_body + 1 };
    all->equations = ARENA_ARRAY(&all->arena, rows_of_a_body * model->body_count, struct equation);
    for (size_t b = 0; all->equations && b < model->body_count; b++) {
        struct arrow *arrows = ARENA_ARRAY(&all->arena, diagram_arrows(model, (int)b), struct arrow);
        if (!arrows) break;
        size_t count = diagram_fill(model, (int)b, &at, state->a, state->slots, arrows);
        if (model->bodies[b].place.link > 0) {
            equations_of_jointed(all, state, (int)b, arrows, count);
            continue;
        }
        for (int part = 0; part < model->bodies[b].count; part++)
            fill_equation(all, state, (int)b, part, arrows, count);
    }
    if (!all->arena.failed) return all;
    fbd_equations_free(all);
    return NULL;
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
    size_t count = diagram_fill(model, (int)body, &at, state->a, state->slots, own);
    struct pose pose = body_pose(b, &at);
    struct vec about = b->kind == motion_pivot ? pose.origin : point_motion(b, &pose, b->inertia.G).p;
    for (size_t i = 0; i < count && i < room; i++) arrows[i] = public_arrow(&own[i], about);
    free(own);
    return count;
}
