/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Jams: where dry friction and normal forces grow on each other beyond all bounds.
 *
 * While a point slips its friction is -mu N sign(v_t), and an acceleration of its normal force may answer to that with
 * the wrong sign: then no finite forces go with the slip (Painleve's paradox). What rigid bodies do there is known from
 * the limit of stiff ones and from time stepping: the forces rise without bound while hardly any time passes, an impulse
 * that ends the slip at once though nothing approaches (a tangential impact, or impact without collision: Genot and
 * Brogliato, European Journal of Mechanics A 18, 1999; Stewart, SIAM Review 42, 2000). So all that touches has a plastic
 * impact with an approach that is a hint, and what comes of it does not depend on its size: without a jam it would be as
 * small as the hint is.
 */
#include "dynamics/impulse.h"
#include "solve/contacts.h"
#include "solve/run.h"

static const struct tree *tree_of(const struct run *run)
{
    return run->model->tree;
}

/* Of the fastest slip. */
static const double hint = 1e-10;

static void note_jam(struct run *run, int i, double least)
{
    const struct contacts_work *work = &run->contacts;
    const struct striker *striker = &work->strikers[i];
    const struct tie *tie = &tree_of(run)->ties[striker->tie];
    const double *v = work->v + (ptrdiff_t)2 * i, *P = work->P + (ptrdiff_t)2 * i;
    double taken = (P[0] * (striker->v_n + v[0]) + P[1] * (striker->v_t + v[1])) / 2;
    run->impact_work[tie->load] += taken;
    if (striker->rope || P[0] <= least) return;
    struct run_event *event = run_note(run, FBD_EVENT_JAM, tie->end[0].body, tie->load, -1);
    if (!event) return;
    event->impact =
        (struct impact_record){P[0], P[1], taken, {striker->v_n, v[0]}, {striker->v_t, v[1]}, false};
}

/* Impulses that are more than the hint needs. */
static double least_impulse(const struct run *run, int count, double speed)
{
    const double far = 1e4;
    const struct contacts_work *work = &run->contacts;
    double least = 0;
    for (int i = 0; i < count; i++) {
        double own = work->W[(size_t)(2 * i) * (size_t)(2 * count + 1)];
        if (own > 0) least = fmax(least, far * hint * speed / own);
    }
    return least;
}

bool run_jam(struct run *run)
{
    struct contacts_work *work = &run->contacts;
    bool any = false;
    double speed = 0;
    if (!run->model->tree || run->model->tree->meeting_count == 0) return false;
    impulse_look(run->state);
    int count = contacts_find_strikers(run);
    for (int i = 0; i < count; i++) speed = fmax(speed, fabs(work->strikers[i].v_t));
    if (speed == 0) return false;
    for (int i = 0; i < count; i++) work->strikers[i].v_n -= hint * speed;
    work->plastic = true;
    bool struck = contacts_strike(run, count);
    work->plastic = false;
    if (!struck) return false;
    double least = least_impulse(run, count, speed);
    for (int i = 0; i < count; i++) {
        work->strikers[i].v_n += hint * speed;
        any |= work->P[2 * i] > least;
        note_jam(run, i, least);
    }
    impulse_look(run->state);
    contacts_open_or_close(run, count, true);
    for (int i = 0; i < count; i++) {
        int pair = tree_of(run)->ties[work->strikers[i].tie].pair;
        if (pair >= 0) run->decided.slips[pair] = false;
    }
    return any;
}
