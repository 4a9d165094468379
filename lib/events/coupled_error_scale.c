/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "events/coupled_error_scale.h"

#include <math.h>
#include <string.h>

#include "base/disjoint_sets.h"
#include "dynamics/constraint.h"
#include "dynamics/tree_system.h"
#include "integrate/switcher.h"
#include "numeric/tolerances.h"

struct mechanism {
    bool coupled; /* a constraint row belongs to it */
    double arm;   /* [m] largest distance from a joint to a carried joint or coupling point */
    double speed; /* [m/s] largest speed of a link, or angular speed times arm */
    double way;   /* [m] largest displacement of a coordinate since the join, or rotation times arm */
};

bool coupled_scales_init(struct coupled_scales *mechanisms, const struct fbd_model *model,
                         struct arena *memory)
{
    *mechanisms = (struct coupled_scales){0};
    if (model->tree->coupling_count == 0) return true;
    size_t links = (size_t)model->tree->count, n = (size_t)model->plan.n;
    mechanisms->of = ARENA_ARRAY(memory, links, int);
    mechanisms->members = ARENA_ARRAY(memory, links, struct mechanism);
    mechanisms->start = ARENA_ARRAY(memory, 3 * n, double);
    if (memory->failed) return false;
    mechanisms->given = mechanisms->start + n;
    return true;
}

/* After all unions, when `of` holds the representatives. */
static struct mechanism *mechanism_of(const struct coupled_scales *mechanisms, int link)
{
    return &mechanisms->members[mechanisms->of[link]];
}

/* Join the links of a row, except the ground. */
static void join_row(struct coupled_scales *mechanisms, const struct row *row)
{
    int first = 0;
    for (int k = 0; k < row->port_count; k++) {
        int link = row->ports[k].link;
        if (link > 0 && first > 0) sets_join(mechanisms->of, first, link);
        if (link > 0) first = link;
    }
}

static void measure_row(const struct coupled_scales *mechanisms, const struct row *row)
{
    for (int k = 0; k < row->port_count; k++) {
        const struct port *port = &row->ports[k];
        if (port->link == 0) continue;
        struct mechanism *mechanism = mechanism_of(mechanisms, port->link);
        mechanism->coupled = true;
        if (port_turns(port)) mechanism->arm = fmax(mechanism->arm, vec_norm(port->arm));
    }
}

void coupled_scales_join(struct coupled_scales *mechanisms, const struct fbd_state *state)
{
    if (!mechanisms->of) return;
    const struct tree *tree = state->model->tree;
    const struct instant at = state_instant(state);
    for (int i = 0; i < tree->joined; i++) {
        mechanisms->of[i] = i;
        mechanisms->members[i] = (struct mechanism){0};
    }
    for (int i = 1; i < tree->joined; i++)
        if (tree->links[i].parent > 0) sets_join(mechanisms->of, i, tree->links[i].parent);
    for (int j = 0; j < tree->row_count; j++)
        if (tree_takes_part(tree, &at, j)) join_row(mechanisms, &state->tree->rows[j]);
    for (int i = 1; i < tree->joined; i++) mechanisms->of[i] = sets_first(mechanisms->of, i);
    for (int j = 0; j < tree->row_count; j++)
        if (tree_takes_part(tree, &at, j)) measure_row(mechanisms, &state->tree->rows[j]);
    for (int i = 1; i < tree->joined; i++) {
        struct mechanism *mechanism = mechanism_of(mechanisms, i);
        if (tree->links[i].parent > 0)
            mechanism->arm = fmax(mechanism->arm, vec_norm(state->tree->links[i].d));
    }
    memcpy(mechanisms->start, state->y, (size_t)state->model->plan.n * sizeof *state->y);
}

static void measure_link(const struct coupled_scales *mechanisms, const struct fbd_state *state, int link)
{
    const struct tree_link *joint = &state->model->tree->links[link];
    const struct tree_state *s = &state->tree->links[link];
    const struct coordinate *coordinates = state->model->scene->coordinates;
    struct mechanism *mechanism = mechanism_of(mechanisms, link);
    mechanism->speed = larger(mechanism->speed, vec_norm(s->v) + fabs(s->omega) * mechanism->arm);
    int end = joint->coordinate + joint_freedom(joint->kind);
    for (int i = joint->coordinate; i < end; i++) {
        double moved = fabs(state->y[i] - mechanisms->start[i]);
        mechanism->way = larger(mechanism->way, coordinates[i].angle ? moved * mechanism->arm : moved);
    }
}

/* The stepper keeps a floor permanently. */
static void raise_floor(double *given, struct switcher *stepper, size_t i, double floor)
{
    if (!(floor > given[i])) return;
    given[i] = floor;
    switcher_set_floor(stepper, i, floor);
}

static void give_floors(const struct coupled_scales *mechanisms, const struct mechanism *mechanism,
                        const struct fbd_state *state, int link, struct switcher *stepper)
{
    const double share = least_rate_scale;
    const struct tree_link *joint = &state->model->tree->links[link];
    const struct coordinate *coordinates = state->model->scene->coordinates;
    size_t n = (size_t)state->model->plan.n;
    size_t first = (size_t)joint->coordinate, end = first + (size_t)joint_freedom(joint->kind);
    for (size_t i = first; i < end; i++) {
        double per = coordinates[i].angle ? mechanism->arm : 1;
        if (!(per > 0)) continue; /* particles on rods have no rotation */
        double way = coordinates[i].angle ? fmin(1, mechanism->way / per) : mechanism->way;
        raise_floor(mechanisms->given, stepper, i, share * way);
        raise_floor(mechanisms->given, stepper, n + i, share * mechanism->speed / per);
    }
}

void coupled_scales_set_floors(struct coupled_scales *mechanisms, const struct fbd_state *state,
                               struct switcher *stepper)
{
    if (!mechanisms->of) return;
    for (int i = 1; i < state->model->tree->joined; i++)
        if (mechanism_of(mechanisms, i)->coupled) measure_link(mechanisms, state, i);
    for (int i = 1; i < state->model->tree->joined; i++) {
        const struct mechanism *mechanism = mechanism_of(mechanisms, i);
        if (mechanism->coupled) give_floors(mechanisms, mechanism, state, i, stepper);
    }
}
