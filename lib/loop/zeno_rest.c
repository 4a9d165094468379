/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Place bodies on their surfaces when their bounces are below the tolerance.
 */
#include <string.h>

#include "dynamics/contact.h"
#include "dynamics/energy.h"
#include "dynamics/impulse.h"
#include "dynamics/project.h"
#include "dynamics/tree_system.h"
#include "loop/contacts.h"
#include "loop/contacts_points.h"
#include "loop/energy_guard.h"
#include "loop/run.h"

/* Height within which corners are closed, in units of touching; and factor for displacements farther from the
 * axis of rotation. */
static const double wide = 2 * zeno_height, levers = 8;

/* The last contact pair with a summed series. */
static int last_at_rest(const struct run *run)
{
    int last = 0;
    for (int i = 0; i < run->model->tree->meeting_count; i++)
        if (run->contacts.bounces[i].rests_from < HUGE_VAL) last = i;
    return last;
}

/* The largest speed that is removed in the summed series. */
static double slow_speed(const struct run *run)
{
    double slow = 0;
    for (int i = 0; i < run->model->tree->meeting_count; i++) {
        const struct bounces *bounces = &run->contacts.bounces[i];
        if (bounces->rests_from < HUGE_VAL) slow = fmax(slow, bounces->slow);
    }
    return slow;
}

/* Open touching contacts that separate faster than `slow`, and those that approach faster: they have an impact of their own. */
static void open_fast(struct run *run, double slow)
{
    const struct tree *tree = run->model->tree;
    struct fbd_state *state = run->state;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling->kind != constraint_contact || state->tree->couplings[i].feature == no_feature) continue;
        if (fabs(state->tree->rows[coupling->first_row].g.x1) <= slow) continue;
        state->tree->couplings[i].feature = no_feature;
        state->slip[coupling->surface] = slip_plus;
    }
}

/* Is the slip so slow that friction ends it within the position tolerance, as the remaining impacts would? */
static bool stops_at_once(const struct run *run, int index, double slow)
{
    const struct coupling *coupling = &run->model->tree->couplings[index];
    const struct instant at = state_instant(run->state);
    if (run->state->tree->couplings[index].feature == no_feature) return false;
    double mu = formula_value(&run->model->plan.modes[coupling->pair].mu_k, &at);
    double v_t = run->state->tree->rows[coupling->first_row + 1].g.x1;
    return v_t * v_t <= fmin(mu, 1) * slow * slow;
}

/* The largest change of speed of a shape from one state to the other. */
static double speed_between(const struct run *run, const struct tree_work *before,
                            const struct tree_work *after)
{
    const struct tree *tree = run->model->tree;
    double most = 0;
    for (int i = 0; i < tree->meeting_count; i++)
        for (int k = 0; k < 2; k++) {
            const struct contact_shape *shape = &tree->meetings[i].shape[k];
            const struct tree_state *a = &before->links[shape->link], *b = &after->links[shape->link];
            double turning = fabs(b->omega - a->omega) * shape->radius;
            most = fmax(most, vec_norm(vec_sub(b->v, a->v)) + turning);
        }
    return most;
}

/* Does impact constraint i belong to a summed series, and separate slowly? */
static bool is_summed_up(const struct run *run, int i, double slow)
{
    const struct contacts_work *work = &run->contacts;
    const struct striker *striker = &work->strikers[i];
    return striker->contact &&
           work->bounces[run->model->tree->couplings[striker->coupling].meeting].rests_from < HUGE_VAL &&
           work->v[(ptrdiff_t)2 * i] <= slow;
}

/* The state after an impact, with summed contacts closed without friction, and separating ones open. */
static void try_to_close(struct run *run, int count, double slow, struct fbd_state *state)
{
    const struct contacts_work *work = &run->contacts;
    const struct tree *tree = run->model->tree;
    state_copy(state, run->state);
    for (int i = 0; i < count; i++) {
        const struct striker *striker = &work->strikers[i];
        const struct coupling *coupling = &tree->couplings[striker->coupling];
        bool parts = contacts_part(run, i) && !striker->stays && !is_summed_up(run, i, slow);
        if (parts) state->slip[striker->rope ? coupling->pair : coupling->surface] = slip_plus;
        if (striker->contact && coupling->pair >= 0) state->slip[coupling->pair] = slip_plus;
    }
    for (int k = 0; k < work->twin_count; k++) {
        const struct coupling *own = &tree->couplings[work->twins[k].coupling],
                              *point = &tree->couplings[work->strikers[work->twins[k].point].coupling];
        state->slip[own->surface] = state->slip[point->surface];
        if (own->pair >= 0) state->slip[own->pair] = slip_plus;
    }
    state_project_velocity(state, false);
    impulse_look(state);
}

/* Points close together separate slowly while their body rotates fast: a bounce that is below the tolerance
 * there is large elsewhere. A trial detects it: closing changes speeds by much, or does not even stop the
 * points. */
bool zeno_rest_is_harmless(struct run *run, int count)
{
    const double resolved = 0.1; /* of the separation speed */
    const struct tree *tree = run->model->tree;
    struct fbd_state *state = run->contacts.trial;
    double slow = slow_speed(run), leaving = 0, left = 0;
    for (int i = 0; i < count; i++)
        if (is_summed_up(run, i, slow)) leaving = fmax(leaving, run->contacts.v[(ptrdiff_t)2 * i]);
    if (leaving == 0) return true; /* they rest */
    try_to_close(run, count, slow, state);
    for (int i = 0; i < count; i++) {
        const struct row *row =
            &state->tree->rows[tree->couplings[run->contacts.strikers[i].coupling].first_row];
        if (is_summed_up(run, i, slow)) left = fmax(left, fabs(row->g.x1));
    }
    if (left > resolved * leaving) return false;
    return speed_between(run, run->state->tree, state->tree) <= levers * fmax(slow, levers * leaving);
}

/* The largest displacement of shapes since the state `before`. */
static double way_since(const struct run *run, const struct tree_work *before)
{
    const struct tree *tree = run->model->tree;
    double way = 0;
    for (int i = 0; i < tree->meeting_count; i++)
        for (int k = 0; k < 2; k++) {
            const struct contact_shape *shape = &tree->meetings[i].shape[k];
            const struct tree_state *a = &before->links[shape->link],
                                    *b = &run->state->tree->links[shape->link];
            double turned = fabs(b->angle - a->angle) * shape->radius;
            way = fmax(way, vec_norm(vec_sub(b->p, a->p)) + turned);
        }
    return way;
}

/* Does any closed contact overlap by more than the touching tolerance? */
static bool is_deep(const struct run *run)
{
    const struct tree *tree = run->model->tree;
    bool deep = false;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling->kind != constraint_contact || run->state->slip[coupling->surface] != stick) continue;
        deep |= run->state->tree->rows[coupling->first_row].g.x <
                -meeting_near(run->model, run->state->tree, coupling->meeting);
    }
    return deep;
}

/* Where sticking contacts prevent the projection of positions, let them move along their surfaces by as
 * little: their positions along them have no better accuracy. */
static void move_along(struct run *run)
{
    const struct tree *tree = run->model->tree;
    struct fbd_state *state = run->state;
    bool *moves = run->contacts.moves;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        moves[i] = coupling->kind == constraint_contact && coupling->pair >= 0 &&
                   state->slip[coupling->surface] == stick && state->slip[coupling->pair] == stick;
        if (moves[i]) state->slip[coupling->pair] = slip_plus;
    }
    state_project_position(state);
    impulse_look(state);
    for (int i = 0; i < tree->coupling_count; i++) {
        if (!moves[i]) continue;
        coupling_rezero(run->model, state->tree, i);
        state->slip[tree->couplings[i].pair] = stick;
    }
}

/* Project shapes onto their surfaces; with `all` also their velocities. Returns false, with the state
 * restored, when that moves any shape far, such as a body leaning flat on another while the feet of both
 * stick. */
static bool move_a_little(struct run *run)
{
    struct fbd_state *state = run->state, *before = run->contacts.trial;
    double near = 0;
    for (int i = 0; i < run->model->tree->meeting_count; i++)
        near = fmax(near, meeting_near(run->model, state->tree, i));
    state_copy(before, state);
    impulse_look(before);
    state_project_position(state);
    impulse_look(state);
    if (is_deep(run)) move_along(run);
    bool little = way_since(run, before->tree) <= levers * wide * near;
    if (!little) {
        state_copy(state, before);
        impulse_look(state);
    }
    return little;
}

/* Open the contacts that did not touch before. */
static void open_others(struct run *run, const bool *was_touching)
{
    const struct tree *tree = run->model->tree;
    struct fbd_state *state = run->state;
    for (int i = 0; i < tree->coupling_count; i++) {
        if (was_touching[i] || state->tree->couplings[i].feature == no_feature) continue;
        state->tree->couplings[i].feature = no_feature;
        state->slip[tree->couplings[i].surface] = slip_plus;
    }
}

/* Close the touching contacts; for contact pairs with a summed series within `share` of the touching
 * tolerance. */
static void close_within(struct run *run, double share)
{
    const struct tree *tree = run->model->tree;
    const struct contacts_work *work = &run->contacts;
    for (int i = 0; i < tree->meeting_count; i++) {
        double near = meeting_near(run->model, run->state->tree, i);
        contacts_find_touching(run, i, work->bounces[i].rests_from < HUGE_VAL ? share * near : near);
    }
    impulse_look(run->state);
    double slow = slow_speed(run);
    open_fast(run, slow);
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling->kind != constraint_contact || coupling->pair < 0) continue;
        /* Newly closed contacts slip; sticking ones stick on. */
        if (!work->touching[i]) run->state->slip[coupling->pair] = slip_plus;
        if (run->state->slip[coupling->pair] == stick || !stops_at_once(run, i, slow)) continue;
        coupling_rezero(run->model, run->state->tree, i);
        run->state->slip[coupling->pair] = stick;
    }
}

/* Add the change of potential energy by the displacement to the work of the contact's impacts. */
static void book_place(struct run *run, int meeting, double before)
{
    const struct tree *tree = run->model->tree;
    double change = energy_of_place(run) - before;
    run->impact_work[tree->couplings[tree->meetings[meeting].first_coupling].load] += change;
    run->energy.lowered += change;
}

/* Stop all closed constraints by the impulses of the rest of the series. Returns false if no small change of the velocities does. */
static bool stop_closed(struct run *run)
{
    int count = contacts_find_strikers(run);
    for (int i = 0; i < count; i++) run->contacts.strikers[i].stays = true;
    if (!contacts_find_responses(run, count)) return true;
    zeno_apply_remaining(run, count, slow_speed(run));
    bool there = state_project_velocity(run->state, false);
    impulse_look(run->state);
    return there;
}

/* Open the contacts that separate and have no summed series of their own. Returns whether there are any. */
static bool open_separating(struct run *run)
{
    const struct tree *tree = run->model->tree;
    struct fbd_state *state = run->state;
    bool any = false;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling->kind != constraint_contact || state->tree->couplings[i].feature == no_feature ||
            run->contacts.bounces[coupling->meeting].rests_from < HUGE_VAL ||
            !(state->tree->rows[coupling->first_row].g.x1 >
              contacts_no_speed(run, &state->tree->rows[coupling->first_row])))
            continue;
        state->tree->couplings[i].feature = no_feature;
        state->slip[coupling->surface] = slip_plus;
        any = true;
    }
    return any;
}

/* Place bodies with bounces below the tolerance on their surfaces and stop them by the impulses of the rest of the series. */
int zeno_rest(struct run *run)
{
    const struct tree *tree = run->model->tree;
    struct contacts_work *work = &run->contacts;
    bool *was_touching = work->touching;
    double above = energy_of_place(run);
    for (int i = 0; i < tree->coupling_count; i++)
        was_touching[i] = run->state->tree->couplings[i].feature != no_feature;
    close_within(run, wide);
    if (!move_a_little(run)) {
        open_others(run, was_touching); /* farther ones land later */
        close_within(run, 1);
        move_a_little(run);
    }
    book_place(run, last_at_rest(run), above);
    if (!stop_closed(run) && open_separating(run)) stop_closed(run);
    int count = contacts_find_strikers(run);
    for (int i = 0; i < count; i++) {
        double *v = work->v + (ptrdiff_t)2 * i;
        v[0] = 0;
        v[1] = work->strikers[i].v_t;
    }
    return count;
}

/* Find the touching features of pairs that overlap by more than the touching tolerance, but by no more than
 * zeno_rest may move neighbours. Returns the last of these pairs, or -1. */
static int find_deep(struct run *run)
{
    struct fbd_state *state = run->state;
    const struct instant at = state_instant(state);
    int last = -1;
    for (int i = 0; i < run->model->tree->meeting_count; i++) {
        double near = meeting_near(run->model, state->tree, i), deep = meeting_depth(run->model, &at, i);
        if (!(deep > near && deep < levers * wide * near)) continue;
        contacts_find_touching(run, i, fmax(wide * near, 1.001 * deep));
        last = i;
    }
    return last;
}

/* Shapes that are moved out may overlap others, which are then moved out with them. */
bool zeno_lift_others(struct run *run)
{
    enum { most_rounds = 8 };
    const struct tree *tree = run->model->tree;
    bool *was_touching = run->contacts.touching, any = false;
    for (int i = 0; i < tree->coupling_count; i++)
        was_touching[i] = run->state->tree->couplings[i].feature != no_feature;
    for (int round = 0; round < most_rounds; round++) {
        int deep = find_deep(run);
        double below = deep >= 0 ? energy_of_place(run) : 0;
        if (deep < 0 || !move_a_little(run)) break;
        book_place(run, deep, below);
        any = true;
    }
    open_others(run, was_touching);
    return any;
}
