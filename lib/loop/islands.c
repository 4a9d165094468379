/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/islands.h"

#include <stdlib.h>

#include "base/block_alloc.h"

/* ---- connected components by union-find: parent[b] is a body of the same island, finally the first one */

static int find(int *parent, int b)
{
    while (parent[b] != b) b = parent[b] = parent[parent[b]];
    return b;
}

/* The earlier root remains, so that an island is identified by its first body. */
static void join(int *parent, int a, int b)
{
    int root_a = find(parent, a), root_b = find(parent, b);
    if (root_a < root_b)
        parent[root_b] = root_a;
    else
        parent[root_a] = root_b;
}

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
        if (body >= 0) join(parent, body, read);
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
        if (constraint->body[end] != ground_body) join(parent, body, constraint->body[end]);
    join_read(scene, parent, constraint->mu_s.expr, body);
    join_read(scene, parent, constraint->mu_k.expr, body);
    return body;
}

/* Join the bodies of the condition at which a constraint begins or ends with those of the constraint. */
static int join_end(const struct scene *scene, int *parent, const struct constraint *constraint, int read)
{
    const int body = join_constraint(scene, parent, constraint);
    if (read >= 0) join(parent, body, read);
    return body;
}

/* group_of_event, group_of_coupling, group_of_constraint and group_of_absolute contain a body of each on
 * return. */
static void join_all(const struct scene *scene, int *parent, struct islands *division)
{
    for (size_t b = 0; b < scene->body_count; b++) parent[b] = (int)b;
    for (size_t b = 0; b < scene->body_count; b++) {
        const struct body *body = &scene->bodies[b];
        if (body->motion.parent != ground_body)
            join(parent, (int)b, body->motion.parent);
        else if (body->count == 0) /* a fixed body has no equations of motion */
            join(parent, (int)b, 0);
        join_read(scene, parent, body->mass.expr, (int)b);
        for (size_t i = 0; scene->body_count > 1 && i < body->load_count; i++)
            join_load(scene, parent, &body->loads[i], (int)b);
    }
    for (size_t b = 1; scene->own_count > 0 && b < scene->body_count; b++) join(parent, (int)b, 0);
    for (size_t i = 0; i < scene->event_count; i++) {
        int read = join_read(scene, parent, scene->events[i].left, -1);
        read = join_read(scene, parent, scene->events[i].right, read);
        const int of = scene->events[i].begins + scene->events[i].ends; /* one of them is 0 */
        if (of > 0) read = join_end(scene, parent, &scene->constraints[of - 1], read);
        division->group_of_event[i] = read < 0 ? 0 : read;
    }
    for (size_t i = 0; i < scene->force_coupling_count; i++) {
        const int *body = scene->force_couplings[i].body;
        division->group_of_coupling[i] = body[0] != ground_body ? body[0] : body[1];
        if (body[0] != ground_body && body[1] != ground_body) join(parent, body[0], body[1]);
        join_load(scene, parent, &scene->force_couplings[i].load, division->group_of_coupling[i]);
    }
    for (size_t i = 0; i < scene->constraint_count; i++)
        division->group_of_constraint[i] = join_constraint(scene, parent, &scene->constraints[i]);
    for (size_t i = 0; i < scene->absolute_count; i++)
        division->group_of_absolute[i] = scene->absolutes[i].body;
}

/* ---- lists of the islands */

/* Replace the root of each body by the number of its island; returns the number of islands. A root comes
 * before the other bodies of its island. */
static size_t number_groups(const struct scene *scene, int *parent, struct islands *division)
{
    size_t count = 0;
    for (size_t b = 0; b < scene->body_count; b++) {
        int root = find(parent, (int)b);
        division->group_of_body[b] = root == (int)b ? (int)count++ : division->group_of_body[root];
    }
    for (size_t i = 0; i < scene->event_count; i++)
        division->group_of_event[i] = division->group_of_body[division->group_of_event[i]];
    for (size_t i = 0; i < scene->force_coupling_count; i++)
        division->group_of_coupling[i] = division->group_of_body[division->group_of_coupling[i]];
    for (size_t i = 0; i < scene->constraint_count; i++)
        division->group_of_constraint[i] = division->group_of_body[division->group_of_constraint[i]];
    for (size_t i = 0; i < scene->absolute_count; i++)
        division->group_of_absolute[i] = division->group_of_body[division->group_of_absolute[i]];
    return count;
}

/* A list of a selection. */
struct list {
    const int **items;
    size_t *count;
};

typedef struct list list_of(struct selection *selection);

static struct list bodies_of(struct selection *selection)
{
    return (struct list){&selection->bodies, &selection->body_count};
}

static struct list events_of(struct selection *selection)
{
    return (struct list){&selection->events, &selection->event_count};
}

static struct list couplings_of(struct selection *selection)
{
    return (struct list){&selection->force_couplings, &selection->force_coupling_count};
}

static struct list constraints_of(struct selection *selection)
{
    return (struct list){&selection->constraints, &selection->constraint_count};
}

static struct list absolutes_of(struct selection *selection)
{
    return (struct list){&selection->absolutes, &selection->absolute_count};
}

/* Sort 0 ... count - 1 by island, in order within each; `next` has division->count entries. */
static void sort_by_group(const struct islands *division, const int *group_of, size_t count, int *sorted,
                          int *next, list_of *of)
{
    for (size_t p = 0; p < division->count; p++) next[p] = 0;
    for (size_t i = 0; i < count; i++) next[group_of[i]]++;
    int first = 0;
    for (size_t p = 0; p < division->count; p++) {
        struct list list = of(&division->selections[p]);
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

/* One block for all lists; `sorted` and the following ones are behind those of the division. */
static bool allocate(struct islands *division, const struct scene *scene, int **sorted)
{
    size_t bodies = scene->body_count, events = scene->event_count, couplings = scene->force_coupling_count,
           constraints = scene->constraint_count, absolutes = scene->absolute_count;
    size_t slots = 1 + scene_size(scene) + hand_slots + absolutes;
    size_t things = bodies + events + couplings + constraints + absolutes;
    division->memory = block_alloc((3 * bodies + slots + 2 * things) * sizeof *division->memory);
    if (!division->memory) return false;
    division->group_of_body = division->memory;
    division->group_of_event = division->group_of_body + bodies;
    division->group_of_coupling = division->group_of_event + events;
    division->group_of_constraint = division->group_of_coupling + couplings;
    division->group_of_absolute = division->group_of_constraint + constraints;
    *sorted = division->memory + things;
    return true;
}

bool islands_make(struct islands *division, const struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    size_t bodies = scene->body_count, events = scene->event_count, couplings = scene->force_coupling_count;
    int *sorted;
    *division = (struct islands){0};
    if (!allocate(division, scene, &sorted)) return false;
    int *sorted_events = sorted + bodies, *sorted_couplings = sorted_events + events,
        *sorted_constraints = sorted_couplings + couplings,
        *sorted_absolutes = sorted_constraints + scene->constraint_count,
        *parent = sorted_absolutes + scene->absolute_count, *local = parent + bodies, *next = local + bodies,
        *moved = next + bodies;
    join_all(scene, parent, division);
    division->count = number_groups(scene, parent, division);
    division->selections = block_alloc((division->count + 1) * sizeof *division->selections);
    if (!division->selections) return false;
    sort_by_group(division, division->group_of_body, bodies, sorted, next, bodies_of);
    sort_by_group(division, division->group_of_event, events, sorted_events, next, events_of);
    sort_by_group(division, division->group_of_coupling, couplings, sorted_couplings, next, couplings_of);
    sort_by_group(division, division->group_of_constraint, scene->constraint_count, sorted_constraints, next,
                  constraints_of);
    sort_by_group(division, division->group_of_absolute, scene->absolute_count, sorted_absolutes, next,
                  absolutes_of);
    for (size_t p = 0; p < division->count; p++) renumber(scene, &division->selections[p], moved, local);
    return true;
}

void islands_free(struct islands *division)
{
    free(division->selections);
    free(division->memory);
    *division = (struct islands){0};
}
