/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch/batch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/zeroed.h"
#include "batch/lanes.h"
#include "dynamics/rates_row.h"
#include "integrate/nystrom.h"
#include "integrate/nystrom_table.h"

struct batch {
    unsigned count;
    lanes_function *go;
    struct run *runs[most_lanes];
    struct lent lent[most_lanes];
    struct lanes lanes;
};

/* ---- which vectors */

struct width {
    unsigned lanes;
    lanes_function *go;
};

/* The widest of at most so many lanes. */
static struct width width_of(unsigned most)
{
#if defined(__x86_64__)
    if (most >= 8 && __builtin_cpu_supports("avx512f")) return (struct width){8, lanes_by_eight};
    if (most >= 4 && __builtin_cpu_supports("avx2")) return (struct width){4, lanes_by_four};
#endif
    (void)most;
    return (struct width){2, lanes_by_two};
}

unsigned batch_lanes(const struct batch *batch)
{
    return batch->count;
}

struct batch *batch_new(unsigned most)
{
    struct batch *batch = zeroed(sizeof *batch);
    if (!batch) return NULL;
    const struct width width = width_of(most);
    batch->count = width.lanes;
    batch->go = width.go;
    return batch;
}

void batch_free(struct batch *batch)
{
    free(batch);
}

/* ---- what is put into lanes */

bool batch_suits(const struct fbd_model *model)
{
    const struct plan *plan = &model->plan;
    return plan->n == 1 && plan->own == 0 && !model->tree && plan->watch_count == 0 &&
           plan->mode_count == 0 && plan->kink_count == 0 && plan->pole_count == 0 && plan->sine_count == 1;
}

/* Is there nothing that any step is to look after? */
static bool is_quiet(const struct run *run)
{
    return run->end.outcome == FBD_GOING && run->plain && !run->step.restart && run->step.crawl == 0 &&
           run->options.step == 0 && !run->options.apart && run->kind == structure_velocity_free &&
           run->poles.count == 0 && !run->search.wakes && !run->contacts.due && !run->projected &&
           run->passages.end == HUGE_VAL && run->state->rest == 0;
}

/* The row of a pendulum, where that is all that moves. */
static const struct row *row_of(const struct run *run)
{
    const struct row *row = run->system.inner.params;
    return run->system.inner.function == swing_row && row->q == 0 && row->v == 1 && row->kv == 0 ? row : NULL;
}

bool batch_put(struct batch *batch, unsigned lane, struct run *run)
{
    struct lent *lent = &batch->lent[lane];
    struct lanes *lanes = &batch->lanes;
    if (!batch_suits(run->model) || !is_quiet(run)) return false;
    const struct row *row = row_of(run);
    const double *y = run->state->y;
    if (!row || !switcher_lend(run->stepper, lent) || lent->type != step_nystrom) return false;
    if (lent->last.q != y[0] || lent->last.v != y[1] || lent->last.a != run->work.f[1]) return false;
    batch->runs[lane] = run;
    lanes->until[lane] = run->options.until;
    lanes->tolerance[lane] = lent->tolerance;
    lanes->cap[lane] = lent->cap;
    lanes->noise[lane] = lent->noise;
    lanes->floor[lane] = lent->floor;
    lanes->inverse[lane] = row->inverse;
    lanes->s[lane] = row->s;
    lanes->kv[lane] = row->kv;
    lanes->pause[lane] = (double)run->grain.pause;
    lanes->t[lane] = run->state->t;
    lanes->h[lane] = lanes->tried[lane] = run->step.h;
    lanes->q[lane] = y[0];
    lanes->v[lane] = y[1];
    lanes->a[lane] = run->work.f[1];
    lanes->q0[lane] = lent->before.q;
    lanes->v0[lane] = lent->before.v;
    lanes->a0[lane] = lent->before.a;
    lanes->scale_q[lane] = lent->scale_q;
    lanes->scale_v[lane] = lent->scale_v;
    lanes->most_q[lane] = run->recent.anchor[2];
    lanes->most_v[lane] = run->recent.anchor[3];
    lanes->since[lane] = (double)run->grain.since;
    lanes->steps_left[lane] = lent->steps;
    lanes->growth[lane] = lent->growth;
    lanes->accepted[lane] = lanes->rejected[lane] = lanes->attempts[lane] = 0;
    return true;
}

/* The last step has no inside: it goes from its end to its end. */
static void settle_run(struct run *run, const struct lanes *lanes, unsigned lane, const struct lent *lent)
{
    const unsigned long evaluations = nystrom_stages * (lent->accepted + lent->rejected);
    run->system.rhs += evaluations;
    run->state->y[0] = run->work.y[0] = lanes->q[lane];
    run->state->y[1] = run->work.y[1] = lanes->v[lane];
    run->work.f[0] = lanes->v[lane];
    run->work.f[1] = lanes->a[lane];
    state_set_moment(run->state, moment_at(lanes->t[lane]));
    run->step.from = run->state->t;
    run->step.from_rest = 0;
    run->step.h = lanes->h[lane];
    run->recent.anchor[2] = lanes->most_q[lane];
    run->recent.anchor[3] = lanes->most_v[lane];
    run->grain.since = (unsigned long)lanes->since[lane];
    run->stale = true;
}

void batch_take(struct batch *batch, unsigned lane)
{
    struct run *run = batch->runs[lane];
    struct lent *lent = &batch->lent[lane];
    const struct lanes *lanes = &batch->lanes;
    batch->runs[lane] = NULL;
    lent->accepted = (unsigned long)lanes->accepted[lane];
    lent->rejected = (unsigned long)lanes->rejected[lane];
    if (lent->accepted == 0) return;
    lent->last = (struct lent_state){lanes->q[lane], lanes->v[lane], lanes->a[lane]};
    lent->before = (struct lent_state){lanes->q0[lane], lanes->v0[lane], lanes->a0[lane]};
    lent->scale_q = lanes->scale_q[lane];
    lent->scale_v = lanes->scale_v[lane];
    lent->growth = lanes->growth[lane];
    switcher_settle(run->stepper, lent);
    settle_run(run, lanes, lane, lent);
}

unsigned batch_go(struct batch *batch)
{
    unsigned active = 0;
    for (unsigned lane = 0; lane < batch->count; lane++)
        active |= (unsigned)(batch->runs[lane] != NULL) << lane;
    unsigned stops = active ? batch->go(&batch->lanes, active) : 0;
    for (unsigned lane = 0; lane < batch->count; lane++)
        if (stops >> lane & 1) batch_take(batch, lane);
    return stops;
}
