/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch/batch.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "batch/lanes.h"
#include "dynamics/rates_row.h"
#include "dynamics/tree_bare.h"
#include "integrate/nystrom.h"
#include "integrate/nystrom_table.h"
#include "integrate/pair8.h"

/* Evaluations of the right-hand side per step of rk8pd; for nystrom.h the number of its stages. */
enum { rk8pd_stages = 13 };

struct batch {
    unsigned count;
    lanes_function *const *go; /* by enum lane_motion */
    enum lane_motion motion;   /* of all runs in the lanes */
    struct run *runs[most_lanes];
    struct stepper_state_view view[most_lanes];
    struct lanes lanes;
};

/* ---- vector widths */

struct width {
    unsigned lanes;
    lanes_function *const *go;
};

/* The widest vectors with at most `most` lanes. */
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
    struct batch *batch = block_alloc(sizeof *batch);
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

/* ---- suitable runs */

static bool is_double_pendulum(const struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    return model->plan.n == 2 && tree_is_bare(model) && model->plan.affine_count == 0 &&
           tree->links[1].kind == motion_pivot && tree->links[2].parent == 1;
}

/* Excludes excess precision in registers (FLT_EVAL_METHOD), which vectors do not have. */
bool batch_suits(const struct fbd_model *model)
{
    const struct plan *plan = &model->plan;
    if (FLT_EVAL_METHOD != 0) return false;
    if (plan->own > 0 || plan->watch_count + plan->mode_count + plan->kink_count + plan->pole_count > 0)
        return false;
    if (tree_joins(model->tree)) return is_double_pendulum(model);
    return plan->n == 1 && plan->equations[0].known && plan->equations[0].s != 0;
}

/* True if the next step is an ordinary one: no events, restarts, projections or other tasks are due. */
static bool is_quiet(const struct run *run)
{
    return run->end.outcome == FBD_GOING && run->plain && !run->step.restart && run->step.crawl == 0 &&
           run->options.step == 0 && !run->options.apart && !run_is_exact(run) && run->poles.count == 0 &&
           !run->search.wakes && !run->contacts.due && !run->projected &&
           run->zeno_switches.end == HUGE_VAL && run->state->rest == 0;
}

/* A pendulum, with or without a damper. */
static bool is_swing(const struct run *run)
{
    const struct row *row = run->system.inner.params;
    return run->system.inner.function == scalar_row && row->s != 0 && row->c == 0 && row->c0 == 0 &&
           row->kq == 0 && row->square == 0 && row->friction == 0 && row->formula_count == 0;
}

/* The equations of motion and method of a run; `motions` if it is of none of these kinds. */
static enum lane_motion lane_motion_of(const struct run *run, const struct stepper_state_view *view)
{
    const struct row *row = run->system.inner.params;
    if (is_swing(run) && row->q == 0 && row->v == 1) {
        if (view->type == step_nystrom) return swings;
        if (view->type == step_rk8pd) return swings_damped;
    }
    if (run->system.inner.function != bare_row || view->type != step_rk8pd) return motions;
    const bool in_order = run->model->tree->links[1].coordinate == 0;
    return in_order && is_double_pendulum(run->model) ? swings_double : motions;
}

static void put_swing(const struct row *row, each_lane *c, unsigned lane)
{
    c[swing_inverse][lane] = row->inverse;
    c[swing_s][lane] = row->s;
    c[swing_kv][lane] = row->kv;
}

static void put_links(const struct run *run, const struct tree_bare *bare, each_lane *c, unsigned lane)
{
    const struct tree_link *first = &run->model->tree->links[1], *last = first + 1;
    c[first_along][lane] = first->along;
    c[first_sine][lane] = first->sine;
    c[first_cosine][lane] = first->cosine;
    c[first_I_O][lane] = first->I_O;
    c[first_g][lane] = bare[1].g;
    c[last_along][lane] = last->along;
    c[last_sine][lane] = last->sine;
    c[last_cosine][lane] = last->cosine;
    c[last_g][lane] = bare[2].g;
    c[last_at_x][lane] = last->at.x;
    c[last_at_y][lane] = last->at.y;
    c[last_moment_x][lane] = last->moment.x;
    c[last_moment_y][lane] = last->moment.y;
    c[last_force_x][lane] = last->force.x;
    c[last_force_y][lane] = last->force.y;
    c[last_D][lane] = last->inverse_I_O;
    c[last_across][lane] = last->across;
}

static void put_constants(const struct run *run, struct lanes *lanes, unsigned lane)
{
    const struct row *row = run->system.inner.params;
    if (is_swing(run))
        put_swing(row, lanes->constants, lane);
    else
        put_links(run, row->bare, lanes->constants, lane);
}

/* Copy the numbers of `from`, one for each component, to a lane; gather copies them back. */
static void spread(each_lane *to, unsigned lane, const double *from, size_t count)
{
    for (size_t c = 0; c < count; c++) to[c][lane] = from[c];
}

static void gather(double *to, each_lane *from, unsigned lane, size_t count)
{
    for (size_t c = 0; c < count; c++) to[c] = from[c][lane];
}

/* Limits the time until the caller gets control, also if stiffness is not checked. */
static const double most_steps = 1000;

static void fill_lane(struct lanes *lanes, unsigned lane, const struct run *run,
                      const struct stepper_state_view *view)
{
    const size_t n = view->pairs;
    put_constants(run, lanes, lane);
    spread(lanes->cap, lane, view->cap, n);
    spread(lanes->noise, lane, view->noise, n);
    spread(lanes->floor, lane, view->floor, n);
    spread(lanes->y, lane, view->last, 3 * n);
    spread(lanes->before, lane, view->before, 3 * n);
    spread(lanes->rest, lane, view->rest, 2 * n);
    spread(lanes->scale, lane, view->scale, 2 * n);
    spread(lanes->most, lane, run->recent.anchor + 2 * n, 2 * n);
    lanes->until[lane] = run->options.until;
    lanes->tolerance[lane] = view->tolerance;
    lanes->pause[lane] = (double)run->roundoff.pause;
    lanes->t[lane] = run->state->t;
    lanes->h[lane] = lanes->tried[lane] = run->step.h;
    lanes->rate[lane] = lanes->tried_rate[lane] = view->rate;
    lanes->since[lane] = (double)run->roundoff.since;
    lanes->steps_left[lane] = fmin(fmin(view->steps, most_steps), (double)roundoff_steps(run));
    lanes->growth[lane] = view->growth;
    lanes->accepted[lane] = lanes->rejected[lane] = lanes->attempts[lane] = 0;
}

static bool is_empty(const struct batch *batch)
{
    for (unsigned lane = 0; lane < batch->count; lane++)
        if (batch->runs[lane]) return false;
    return true;
}

/* True if the stepper's copy of the state agrees with the run's. */
static bool agrees_with(const struct stepper_state_view *view, const struct run *run)
{
    const size_t bytes = view->pairs * sizeof(double);
    return memcmp(view->last, run->state->y, 2 * bytes) == 0 &&
           memcmp(view->last + 2 * view->pairs, run->work.f + view->pairs, bytes) == 0;
}

bool batch_put(struct batch *batch, unsigned lane, struct run *run)
{
    struct stepper_state_view *view = &batch->view[lane];
    if (!batch_suits(run->model) || !is_quiet(run)) return false;
    if (!switcher_lend(run->stepper, view) || view->pairs != (size_t)run->model->plan.n) return false;
    const enum lane_motion motion = lane_motion_of(run, view);
    if (motion == motions || !agrees_with(view, run)) return false;
    if (is_empty(batch)) batch->motion = motion;
    if (batch->motion != motion) return false;
    batch->runs[lane] = run;
    fill_lane(&batch->lanes, lane, run, view);
    return true;
}

/* Restore the run. The last step has no dense output: its interval is empty. */
static void settle_run(struct run *run, struct lanes *lanes, unsigned lane,
                       const struct stepper_state_view *view)
{
    const size_t n = view->pairs, bytes = n * sizeof(double);
    const unsigned long evaluations = view->type == step_nystrom ? nystrom_stages : rk8pd_stages;
    run->system.rhs += evaluations * (view->accepted + view->rejected);
    memcpy(run->state->y, view->last, 2 * bytes);
    memcpy(run->work.y, view->last, 2 * bytes);
    memcpy(run->work.f, view->last + n, 2 * bytes);
    state_set_moment(run->state, time_dd_at(lanes->t[lane]));
    run->step.from = run->state->t;
    run->step.from_rest = 0;
    run->step.h = lanes->h[lane];
    gather(run->recent.anchor + 2 * n, lanes->most, lane, 2 * n);
    run->roundoff.since = (unsigned long)lanes->since[lane];
    run->stale = true;
}

void batch_take(struct batch *batch, unsigned lane)
{
    struct run *run = batch->runs[lane];
    struct stepper_state_view *view = &batch->view[lane];
    struct lanes *lanes = &batch->lanes;
    const size_t n = view->pairs;
    batch->runs[lane] = NULL;
    view->accepted = (unsigned long)lanes->accepted[lane];
    view->rejected = (unsigned long)lanes->rejected[lane];
    if (view->accepted == 0) return;
    gather(view->last, lanes->y, lane, 3 * n);
    gather(view->before, lanes->before, lane, 3 * n);
    gather(view->rest, lanes->rest, lane, 2 * n);
    gather(view->scale, lanes->scale, lane, 2 * n);
    view->rate = lanes->rate[lane];
    view->growth = lanes->growth[lane];
    switcher_settle(run->stepper, view);
    settle_run(run, lanes, lane, view);
}

unsigned batch_go(struct batch *batch)
{
    unsigned active = 0;
    for (unsigned lane = 0; lane < batch->count; lane++)
        active |= (unsigned)(batch->runs[lane] != NULL) << lane;
    unsigned stops = active ? batch->go[batch->motion](&batch->lanes, active) : 0;
    for (unsigned lane = 0; lane < batch->count; lane++)
        if (stops >> lane & 1) batch_take(batch, lane);
    return stops;
}
