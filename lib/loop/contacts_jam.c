/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Jams: dry friction and normal forces that increase each other without limit.
 *
 * The friction of a slipping point is -mu N sign(v_t), and the normal acceleration may respond to N with the
 * wrong sign: then no finite forces are consistent with the slip (Painleve's paradox). The behaviour follows
 * from the limit of stiff bodies and from time stepping: the forces grow without limit in a vanishing time,
 * an impulse that ends the slip at once without an approach (a tangential impact, or impact without
 * collision: Genot and Brogliato, European Journal of Mechanics A 18, 1999; Stewart, SIAM Review 42, 2000).
 *
 * So touching contacts get the velocities after a short time without contact forces, and a plastic impact.
 * Without a jam the impulses would be proportional to that time. They are linear in it in the same modes, so
 * the solutions for that time and for twice as long are extrapolated to zero.
 */
#include <string.h>

#include "dynamics/impulse.h"
#include "dynamics/tree_system.h"
#include "loop/contacts.h"
#include "loop/run.h"

/* Change of velocities in the short time, relative to the fastest slip. */
static const double hint = 1e-7;

/* The accelerations along normal and tangent of impact constraint i without contact forces, from work->trial. */
static void free_accelerations(const struct run *run, int i, double c[2])
{
    const struct striker *striker = &run->contacts.strikers[i];
    const struct row *rows =
        &run->contacts.trial->tree->rows[run->model->tree->couplings[striker->coupling].first_row];
    c[0] = striker->rope ? -rows[0].g.x2 : rows[0].g.x2;
    c[1] = striker->rubs ? rows[1].g.x2 : 0;
}

static void let_go(struct run *run, int count)
{
    struct fbd_state *trial = run->contacts.trial;
    state_copy(trial, run->state);
    for (int i = 0; i < count; i++) {
        const struct striker *striker = &run->contacts.strikers[i];
        const struct coupling *coupling = &run->model->tree->couplings[striker->coupling];
        trial->slip[striker->rope ? coupling->pair : coupling->surface] = slip_plus;
    }
    for (int k = 0; k < run->contacts.twin_count; k++)
        trial->slip[run->model->tree->couplings[run->contacts.twins[k].coupling].surface] = slip_plus;
    state_evaluate(trial);
}

/* A time that is short for the slips; 0 without slip. */
static double short_moment(const struct run *run, int count)
{
    const struct striker *strikers = run->contacts.strikers;
    double speed = 0, most = 0, c[2];
    for (int i = 0; i < count; i++) {
        free_accelerations(run, i, c);
        speed = fmax(speed, fabs(strikers[i].v_t));
        most = fmax(most, fmax(fabs(c[0]), fabs(c[1])));
    }
    return most > 0 ? hint * speed / most : 0;
}

static bool solve_after(struct run *run, int count, double moment)
{
    struct striker *strikers = run->contacts.strikers;
    double c[2];
    contacts_find_strikers(run);
    for (int i = 0; i < count; i++) {
        free_accelerations(run, i, c);
        strikers[i].v_n += moment * c[0];
        strikers[i].v_t += moment * c[1];
    }
    return contacts_solve_impact(run, count);
}

/* Extrapolate impulses and velocities to zero time. */
static bool solve_jam(struct run *run, int count, double moment)
{
    struct contacts_work *work = &run->contacts;
    size_t size = 2 * (size_t)count;
    if (!solve_after(run, count, 2 * moment)) return false;
    memcpy(work->later, work->v, size * sizeof *work->v);
    memcpy(work->later + size, work->P, size * sizeof *work->P);
    if (!solve_after(run, count, moment)) return false;
    for (size_t i = 0; i < size; i++) {
        work->v[i] = 2 * work->v[i] - work->later[i];
        work->P[i] = 2 * work->P[i] - work->later[size + i];
    }
    return true;
}

static void note_jam(struct run *run, int i, bool jams)
{
    const struct contacts_work *work = &run->contacts;
    const struct striker *striker = &work->strikers[i];
    const struct coupling *coupling = &run->model->tree->couplings[striker->coupling];
    const double *v = work->v + (ptrdiff_t)2 * i, *P = work->P + (ptrdiff_t)2 * i;
    double taken = striker_taken(striker, v, P);
    run->impact_work[coupling->load] += taken;
    if (striker->rope || !jams) return;
    struct run_event *event = log_event(run, FBD_EVENT_JAM, coupling->end[0].body, coupling->load, -1);
    if (!event) return;
    event->impact = (struct impact_record){
        .p = P[0], .tau = P[1], .work = taken, .v_n = {striker->v_n, v[0]}, .v_t = {striker->v_t, v[1]}};
}

/* An upper bound of the impulses that the short time itself causes. */
static double least_impulse(const struct run *run, int count, double moment)
{
    const double far = 1e3;
    const struct contacts_work *work = &run->contacts;
    double least = 0, c[2];
    for (int i = 0; i < count; i++) {
        double own = work->W[(size_t)(2 * i) * (size_t)(2 * count + 1)];
        free_accelerations(run, i, c);
        if (own > 0) least = fmax(least, far * moment * fabs(c[0]) / own);
    }
    return least;
}

/* Find impulses and velocities of a jam; returns the bound below which impulses are negligible, negative
 * without a jam. A jam that ends a slow slip has small impulses; with a time that is short only for a fast
 * slip they would be below the bound, so shorter times are tried. */
static double find_jam(struct run *run, int count)
{
    enum { shorter = 32, most_moments = 3 };
    double moment = short_moment(run, count);
    for (int k = 0; k < most_moments && moment > 0; k++) {
        run->contacts.plastic = true;
        bool solved = solve_jam(run, count, moment);
        run->contacts.plastic = false;
        double least = solved ? least_impulse(run, count, moment) : 0;
        for (size_t i = 0; solved && i < (size_t)count; i++)
            if (run->contacts.P[2 * i] > least) return least;
        moment /= shorter;
    }
    return -1;
}

bool run_jam(struct run *run)
{
    struct contacts_work *work = &run->contacts;
    if (!run->model->tree || run->model->tree->meeting_count == 0) return false;
    impulse_look(run->state);
    int count = contacts_find_strikers(run);
    let_go(run, count);
    double least = find_jam(run, count);
    if (least < 0) return false;
    contacts_find_strikers(run); /* with the velocities before */
    contacts_apply_impulses(run, count);
    for (size_t i = 0; i < (size_t)count; i++) note_jam(run, (int)i, work->P[2 * i] > least);
    impulse_look(run->state);
    contacts_open_or_close(run, count, true);
    for (int i = 0; i < count; i++) {
        int pair = run->model->tree->couplings[work->strikers[i].coupling].pair;
        if (pair >= 0) run->decided.slips[pair] = false;
    }
    for (int k = 0; k < work->twin_count; k++) {
        int pair = run->model->tree->couplings[work->twins[k].coupling].pair;
        if (pair >= 0) run->decided.slips[pair] = false;
    }
    return true;
}

/* The contact that slips with friction and has the largest normal force; -1 without one. */
static int pressed_most(const struct run *run, const struct fbd_state *state)
{
    const struct tree *tree = run->model->tree;
    const struct instant at = state_instant(state);
    double most = -1;
    int found = -1;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        double N = fabs(state->tree->rows[coupling->first_row].lambda);
        if (coupling->kind != constraint_contact ||
            tree_rubbing_share(run->model, &at, (int)(coupling - run->model->tree->couplings)) == 0)
            continue;
        if (N <= most) continue;
        most = N;
        found = i;
    }
    return found;
}

/* Is the determinant of the system of multipliers negative? Without friction the system is positive definite.
 * Slipping friction may change the sign; there may be solutions on both sides, but at the change the forces
 * are infinite. */
static bool has_turned(const struct fbd_state *state)
{
    const struct tree_work *work = state->tree;
    int negative = 0;
    for (int r = 0; r < work->count; r++) negative += work->inverse[r] < 0;
    return negative % 2 == 1;
}

void run_note_sign(struct run *run)
{
    if (!tree_has_contacts(run->model->tree)) return;
    run->contacts.turned = false;
    if (pressed_most(run, run->during) < 0) return;
    state_evaluate_unshared(run->during);
    run->contacts.turned = has_turned(run->during);
}

void run_check_jam(struct run *run, bool evaluated)
{
    const struct fbd_model *model = run->model;
    if (!tree_has_contacts(run->model->tree) || run->end.outcome != FBD_GOING ||
        pressed_most(run, run->state) < 0)
        return;
    if (!evaluated) state_evaluate_unshared(run->state);
    if (has_turned(run->state) == run->contacts.turned) return;
    int worst = pressed_most(run, run->state);
    const struct coupling *coupling = &model->tree->couplings[worst];
    run_fail(run, FBD_FAILED,
             "at t = %.9g the normal force of `%s` on `%s` has become infinite within a step: the friction "
             "of the slipping point increases its own normal force (Painleve's paradox). Reduce the "
             "friction, or end the run earlier by an event",
             run_time(run), model->loads[coupling->load].source->name,
             model->bodies[coupling->end[0].body].name);
}
