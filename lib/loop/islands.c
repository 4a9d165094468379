/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/islands.h"

#include <stdlib.h>

#include "base/block_alloc.h"
#include "base/disjoint_sets.h"

/* The kinds of items in a selection. */
enum kind { of_body, of_event, of_coupling, of_constraint, of_absolute, of_branch, of_mode, of_load, kinds };

/* For the items of each kind their number and, while the bodies are joined, a body of each, then its island. */
struct items {
    size_t count[kinds];
    int *group[kinds];
};

/* ---- connected components by union-find: parent[b] is a body of the same island, finally the first one */

/* The body of a slot: of a coordinate, a rate or a world position. */
static int body_of_slot(const struct scene *scene, int slot)
{
    size_t n = scene->coordinate_count, size = scene_size(scene), index = (size_t)slot - 1;
    if (index < 2 * n) return scene->coordinates[index % n].body;
    return index < size
               ? 0
               : scene->absolutes[index - size - hand_slots].body; /* with user states there is one island */
}

/* Join the bodies whose coordinates or positions an expression reads with `body`, or with each other where
 * that is -1; returns one of them, -1 if there is none. */
static int join_read(const struct scene *scene, int *parent, const struct expr *expr, int body)
{
    const int *slots;
    size_t count = expr ? expr_variables(expr, &slots) : 0;
    for (size_t i = 0; i < count; i++) {
        int read = body_of_slot(scene, slots[i]);
        if (body >= 0) sets_join(parent, body, read);
        body = read;
    }
    return body;
}

static void join_load(const struct scene *scene, int *parent, const struct load *load, int body)
{
    struct load copy = *load;
    struct value *formulas[most_formulas_of_a_load];
    load_formulas(&copy, formulas);
    for (size_t k = 0; k < most_formulas_of_a_load; k++) join_read(scene, parent, formulas[k]->expr, body);
}

/* Join all bodies of a constraint and those in its coefficients of friction; returns one of them. */
static int join_constraint(const struct scene *scene, int *parent, const struct constraint *constraint)
{
    int body = 0;
    for (int end = 0; end < constraint->end_count; end++)
        if (constraint->body[end] != ground_body) body = constraint->body[end];
    for (int end = 0; end < constraint->end_count; end++)
        if (constraint->body[end] != ground_body) sets_join(parent, body, constraint->body[end]);
    join_read(scene, parent, constraint->mu_s.expr, body);
    join_read(scene, parent, constraint->mu_k.expr, body);
    return body;
}

/* Join the bodies in the condition at which a force or constraint begins or ends, of which `read` is one, with the
 * body that it acts on, which is returned. */
static int join_end(const struct fbd_model *model, int *parent, const struct watch *watch, int read)
{
    const int body = watch->load >= 0 ? model->loads[watch->load].body
                                      : constraint_first_body(model->tree->couplings[watch->coupling].source);
    if (read >= 0) sets_join(parent, body, read);
    return body;
}

/* The branches of a switch in a load belong to its body, those of one in a user event to a body that the event reads. */
static void find_branches(const struct plan *plan, struct items *items)
{
    size_t watch = 0;
    for (size_t i = 0; i < plan->kink_count; i++) {
        const struct kink *kink = &plan->kinks[i];
        const int first = kink->formula.branch;
        int body = kink->body >= 0 ? kink->body : 0;
        if (kink->body < 0 && kink->own < 0) { /* find the user event whose formula begins here */
            while (plan->watches[watch].left.branch != first && plan->watches[watch].right.branch != first)
                watch++;
            body = items->group[of_event][watch];
        }
        for (size_t k = 0; k < kink->count; k++) items->group[of_branch][first + (int)k] = body;
    }
}

/* Sets items->group to a body of each item except of the bodies. */
static void join_all(const struct fbd_model *model, int *parent, struct items *items)
{
    const struct scene *scene = model->scene;
    int *const *group = items->group;
    for (size_t b = 0; b < scene->body_count; b++) parent[b] = (int)b;
    for (size_t b = 0; b < scene->body_count; b++) {
        const struct body *body = &scene->bodies[b];
        if (body->motion.parent != ground_body)
            sets_join(parent, (int)b, body->motion.parent);
        else if (body->count == 0) /* a fixed body has no equations of motion */
            sets_join(parent, (int)b, 0);
        join_read(scene, parent, body->mass.expr, (int)b);
        for (size_t i = 0; scene->body_count > 1 && i < body->load_count; i++)
            join_load(scene, parent, &body->loads[i], (int)b);
    }
    /* a callback may read every number, and an input may act on every body */
    const bool whole = scene->own_count > 0 || scene_has_calls(scene) || scene_holds_inputs(scene);
    for (size_t b = 1; whole && b < scene->body_count; b++) sets_join(parent, (int)b, 0);
    for (size_t i = 0; i < scene->event_count; i++) {
        int read = join_read(scene, parent, scene->events[i].left, -1);
        read = join_read(scene, parent, scene->events[i].right, read);
        if (scene->events[i].lifetime > 0) read = join_end(model, parent, &model->plan.watches[i], read);
        group[of_event][i] = read < 0 ? 0 : read;
    }
    for (size_t i = 0; i < scene->force_coupling_count; i++) {
        const int *body = scene->force_couplings[i].body;
        group[of_coupling][i] = body[0] != ground_body ? body[0] : body[1];
        if (body[0] != ground_body && body[1] != ground_body) sets_join(parent, body[0], body[1]);
        join_load(scene, parent, &scene->force_couplings[i].load, group[of_coupling][i]);
    }
    for (size_t i = 0; i < scene->constraint_count; i++)
        group[of_constraint][i] = join_constraint(scene, parent, &scene->constraints[i]);
    for (size_t i = 0; i < scene->absolute_count; i++) group[of_absolute][i] = scene->absolutes[i].body;
    for (size_t i = 0; i < model->plan.mode_count; i++) group[of_mode][i] = model->plan.modes[i].body;
    for (size_t i = 0; i < model->load_count; i++) group[of_load][i] = model->loads[i].body;
    find_branches(&model->plan, items);
}

/* ---- lists of the islands */

/* Replace the root of each body by the number of its island; returns the number of islands. A root comes
 * before the other bodies of its island. */
static size_t number_groups(int *parent, struct items *items)
{
    int *of_bodies = items->group[of_body], count = 0;
    for (size_t b = 0; b < items->count[of_body]; b++) {
        int root = sets_first(parent, (int)b);
        of_bodies[b] = root == (int)b ? count++ : of_bodies[root];
    }
    for (int kind = of_body + 1; kind < kinds; kind++)
        for (size_t i = 0; i < items->count[kind]; i++)
            items->group[kind][i] = of_bodies[items->group[kind][i]];
    return (size_t)count;
}

/* A list of a selection. */
struct list {
    const int **items;
    size_t *count;
};

static struct list list_of(struct selection *s, enum kind kind)
{
    switch (kind) {
    case of_body: return (struct list){&s->bodies, &s->body_count};
    case of_event: return (struct list){&s->events, &s->event_count};
    case of_coupling: return (struct list){&s->force_couplings, &s->force_coupling_count};
    case of_constraint: return (struct list){&s->constraints, &s->constraint_count};
    case of_absolute: return (struct list){&s->absolutes, &s->absolute_count};
    case of_branch: return (struct list){&s->branches, &s->branch_count};
    case of_mode: return (struct list){&s->modes, &s->mode_count};
    case of_load:
    case kinds: break;
    }
    return (struct list){&s->loads, &s->load_count};
}

/* Sort 0 ... count - 1 by island, in order within each; `next` has division->count entries. */
static void sort_by_group(const struct islands *division, const struct items *items, enum kind kind,
                          int *sorted, int *next)
{
    const int *group_of = items->group[kind];
    const size_t count = items->count[kind];
    for (size_t p = 0; p < division->count; p++) next[p] = 0;
    for (size_t i = 0; i < count; i++) next[group_of[i]]++;
    int first = 0;
    for (size_t p = 0; p < division->count; p++) {
        struct list list = list_of(&division->selections[p], kind);
        *list.items = sorted + first;
        *list.count = (size_t)next[p];
        first += next[p];
        next[p] = first - next[p];
    }
    for (size_t i = 0; i < count; i++) sorted[next[group_of[i]]++] = (int)i;
}

static void renumber(const struct scene *scene, struct selection *selection, int *moved, int *local)
{
    size_t n = scene->coordinate_count;
    int all = 0, next = 1;
    selection->moved = moved;
    selection->local = local;
    for (size_t i = 0; i < selection->body_count; i++) all += scene->bodies[selection->bodies[i]].count;
    for (size_t i = 0; i < selection->body_count; i++) {
        const struct body *body = &scene->bodies[selection->bodies[i]];
        local[selection->bodies[i]] = (int)i;
        for (int k = 0; k < body->count; k++, next++) {
            size_t slot = 1 + (size_t)body->first + (size_t)k;
            moved[slot] = next;
            moved[slot + n] = all + next;
        }
    }
    for (size_t i = 0; i < selection->absolute_count; i++)
        moved[1 + scene_size(scene) + hand_slots + (size_t)selection->absolutes[i]] =
            1 + 2 * all + (int)scene->own_count + hand_slots + (int)i;
}

static struct items items_of(const struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    return (struct items){.count = {scene->body_count, scene->event_count, scene->force_coupling_count,
                                    scene->constraint_count, scene->absolute_count,
                                    (size_t)model->plan.branches, model->plan.mode_count, model->load_count}};
}

bool islands_make(struct islands *division, const struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    const size_t bodies = scene->body_count;
    size_t slots = 1 + scene_size(scene) + hand_slots + scene->absolute_count, all = 0;
    struct items items = items_of(model);
    *division = (struct islands){0};
    for (int kind = 0; kind < kinds; kind++) all += items.count[kind];
    /* The lists remain; behind them the islands of their items, and scratch. */
    int *next = division->memory = block_alloc((3 * bodies + slots + 2 * all) * sizeof *next);
    if (!next) return false;
    int *sorted = next, *local = next + all, *moved = local + bodies, *parent = moved + slots,
        *work = parent + bodies;
    next = work + bodies;
    for (int kind = 0; kind < kinds; next += items.count[kind++]) items.group[kind] = next;
    join_all(model, parent, &items);
    division->count = number_groups(parent, &items);
    division->selections = block_alloc((division->count + 1) * sizeof *division->selections);
    if (!division->selections) return false;
    for (int kind = 0; kind < kinds; sorted += items.count[kind++])
        sort_by_group(division, &items, (enum kind)kind, sorted, work);
    for (size_t p = 0; p < division->count; p++) renumber(scene, &division->selections[p], moved, local);
    return true;
}

void islands_free(struct islands *division)
{
    free(division->selections);
    free(division->memory);
    *division = (struct islands){0};
}
