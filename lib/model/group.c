/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/group.h"

#include <stdlib.h>

#include "model/builder.h"

/* Source and destination of a copy. */
struct copy {
    const struct scene *from;
    struct scene *to;
    const struct selection *selection;
};

static void renumber(const struct copy *copy, const struct expr **expr)
{
    if (*expr && !(*expr = expr_renumbered(&copy->to->arena, *expr, copy->selection->moved)))
        copy->to->arena.failed = true;
}

static bool reads_coordinates(struct load *load)
{
    struct value *formulas[most_formulas_of_a_load];
    const int *slots;
    load_formulas(load, formulas);
    for (size_t k = 0; k < most_formulas_of_a_load; k++)
        if (formulas[k]->expr && expr_variables(formulas[k]->expr, &slots) > 0) return true;
    return false;
}

/* Loads without variables are those of the whole. */
static void copy_loads(const struct copy *copy, struct body *body)
{
    struct load *from = body->loads;
    bool reads = false;
    for (size_t i = 0; i < body->load_count; i++) reads |= reads_coordinates(&from[i]);
    if (!reads) return;
    body->loads = ARENA_ARRAY(&copy->to->arena, body->load_count, struct load);
    if (!body->loads) return;
    for (size_t i = 0; i < body->load_count; i++) {
        struct load *load = &body->loads[i];
        *load = from[i];
        struct value *formulas[most_formulas_of_a_load];
        load_formulas(load, formulas);
        for (size_t k = 0; k < most_formulas_of_a_load; k++) renumber(copy, &formulas[k]->expr);
    }
}

static void copy_body(const struct copy *copy, const struct body *from)
{
    struct scene *to = copy->to;
    struct body *body = &to->bodies[to->body_count];
    *body = *from;
    body->hand_count = 0;
    body->hands = NULL;
    body->first = (int)to->coordinate_count;
    if (body->motion.parent != ground_body) body->motion.parent = copy->selection->local[body->motion.parent];
    for (int k = 0; k < body->count; k++) {
        struct coordinate *coordinate = &to->coordinates[to->coordinate_count++];
        *coordinate = copy->from->coordinates[from->first + k];
        coordinate->body = (int)to->body_count;
    }
    to->body_count++;
    renumber(copy, &body->mass.expr);
    renumber(copy, &body->inverse_mass.expr);
    copy_loads(copy, body);
}

static void copy_event(const struct copy *copy, const struct user_event *from)
{
    struct user_event *event = &copy->to->events[copy->to->event_count++];
    *event = *from;
    renumber(copy, &event->left);
    renumber(copy, &event->right);
}

static void copy_coupling(const struct copy *copy, const struct force_coupling *from)
{
    struct force_coupling *coupling = &copy->to->force_couplings[copy->to->force_coupling_count++];
    *coupling = *from;
    for (int end = 0; end < 2; end++)
        if (from->body[end] != ground_body) coupling->body[end] = copy->selection->local[from->body[end]];
    struct value *formulas[most_formulas_of_a_load];
    load_formulas(&coupling->load, formulas);
    for (size_t k = 0; k < most_formulas_of_a_load; k++) renumber(copy, &formulas[k]->expr);
}

static void copy_constraint(const struct copy *copy, const struct constraint *from)
{
    struct constraint *constraint = &copy->to->constraints[copy->to->constraint_count++];
    *constraint = *from;
    for (int end = 0; end < from->end_count; end++)
        if (from->body[end] != ground_body) constraint->body[end] = copy->selection->local[from->body[end]];
    renumber(copy, &constraint->mu_s.expr);
    renumber(copy, &constraint->mu_k.expr);
    renumber(copy, &constraint->contact.restitution.expr);
}

static void copy_absolute(const struct copy *copy, const struct absolute *from)
{
    struct absolute *absolute = &copy->to->absolutes[copy->to->absolute_count++];
    *absolute = *from;
    absolute->body = copy->selection->local[from->body];
    for (size_t i = 0; from->roll > 0 && i < copy->selection->constraint_count; i++)
        if (copy->selection->constraints[i] == from->roll - 1) absolute->roll = 1 + (int)i;
}

/* Allocate the arrays of the copy. */
static void prepare(const struct copy *copy, const struct arena *memory)
{
    struct scene *to = copy->to;
    const struct selection *selection = copy->selection;
    size_t coordinates = 0;
    to->arena = *memory; /* lent until the copy is complete */
    to->body_count = to->event_count = to->coordinate_count = 0;
    to->force_coupling_count = to->constraint_count = to->absolute_count = 0;
    for (size_t i = 0; i < selection->body_count; i++)
        coordinates += (size_t)copy->from->bodies[selection->bodies[i]].count;
    to->bodies = ARENA_ARRAY(&to->arena, selection->body_count, struct body);
    to->coordinates = ARENA_ARRAY(&to->arena, coordinates, struct coordinate);
    to->events = ARENA_ARRAY(&to->arena, selection->event_count, struct user_event);
    to->force_couplings = ARENA_ARRAY(&to->arena, selection->force_coupling_count, struct force_coupling);
    to->constraints = ARENA_ARRAY(&to->arena, selection->constraint_count, struct constraint);
    to->absolutes = ARENA_ARRAY(&to->arena, selection->absolute_count, struct absolute);
}

static struct scene *copy_scene(const struct scene *from, const struct selection *selection,
                                struct arena *memory)
{
    struct scene *to = calloc(1, sizeof *to);
    if (!to) return NULL;
    *to = *from;
    to->tables = NULL; /* owned by the whole, which outlives its groups */
    to->table_count = 0;
    to->output_point_count = 0; /* written for the whole only */
    struct copy copy = {from, to, selection};
    prepare(&copy, memory);
    for (size_t i = 0; !to->arena.failed && i < selection->body_count; i++)
        copy_body(&copy, &from->bodies[selection->bodies[i]]);
    for (size_t i = 0; !to->arena.failed && i < selection->event_count; i++)
        copy_event(&copy, &from->events[selection->events[i]]);
    for (size_t i = 0; !to->arena.failed && i < selection->force_coupling_count; i++)
        copy_coupling(&copy, &from->force_couplings[selection->force_couplings[i]]);
    for (size_t i = 0; !to->arena.failed && i < selection->constraint_count; i++)
        copy_constraint(&copy, &from->constraints[selection->constraints[i]]);
    for (size_t i = 0; !to->arena.failed && i < selection->absolute_count; i++)
        copy_absolute(&copy, &from->absolutes[selection->absolutes[i]]);
    *memory = to->arena;
    to->arena = (struct arena){0};
    if (!memory->failed) return to;
    scene_free(to);
    return NULL;
}

/* Copy those of the whole, so that messages of a group name things as the file does. */
static bool copy_labels(struct fbd_model *model, const struct fbd_model *whole,
                        const struct selection *selection, struct arena *memory)
{
    struct label *labels = ARENA_ARRAY(memory, (size_t)model->plan.n, struct label);
    if (!labels) return false;
    struct label *next = labels;
    for (size_t i = 0; i < selection->body_count; i++) {
        const struct model_body *body = &whole->bodies[selection->bodies[i]];
        for (int k = 0; k < body->count; k++) *next++ = whole->labels[body->first + k];
    }
    model->labels = labels;
    return true;
}

struct fbd_model *model_group(const struct fbd_model *whole, const struct selection *selection,
                              struct arena *memory)
{
    fbd_errors *errors = fbd_errors_new();
    struct scene *scene = errors ? copy_scene(whole->scene, selection, memory) : NULL;
    struct fbd_model *model = scene ? model_compile_group(scene, memory, errors) : NULL;
    fbd_errors_free(errors);
    if (!model || copy_labels(model, whole, selection, memory)) return model;
    model_free(model);
    return NULL;
}
