/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/zeno.h"

#include <stdlib.h>
#include <string.h>

#include "dynamics/modes.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

enum { remembered = 5 };

bool zeno_switch_init(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    struct zeno_switches *zeno_switches = &run->zeno_switches;
    zeno_switches->end = HUGE_VAL;
    if (plan->slide_count == 0) return true;
    zeno_switches->list = ARENA_ARRAY(run->memory, (size_t)plan->branches, struct passage);
    for (int i = 0; zeno_switches->list && i < plan->branches; i++) zeno_switches->list[i].left.t = -HUGE_VAL;
    zeno_switches->sticks = ARENA_ARRAY(run->memory, plan->mode_count, bool);
    return !run->memory->failed;
}

static bool may_end(const struct run *run, const struct kink *kink, int part)
{
    return run->zeno_switches.list && kink->slides && kink_watches_places(kink, part);
}

void zeno_switch_remember(struct run *run, const struct watcher *watcher)
{
    const struct kink *kink = &run->model->plan.kinks[watcher->index];
    if (!may_end(run, kink, watcher->part)) return;
    struct passage *passage = &run->zeno_switches.list[kink->formula.branch + watcher->part];
    memmove(passage->t + 1, passage->t, (remembered - 1) * sizeof *passage->t);
    passage->t[0] = run->state->t;
    passage->count++;
}

/* The largest u so far: its gradient times the largest coordinates of the run. */
static double size_of(struct run *run, const struct kink *kink, int part)
{
    struct fbd_state *state = run->state;
    const struct instant at = state_instant(state);
    size_t n = (size_t)run->model->plan.n;
    const double *most = run->recent.anchor + plan_size(&run->model->plan);
    double size = 0, *dy = run->work.sample; /* scratch */
    memset(dy, 0, plan_size(&run->model->plan) * sizeof *dy);
    for (size_t i = 0; i < n; i++) {
        dy[n + i] = 1;
        size += fabs(sliding_surface_rate(state->sliding, run->model, &at, kink, part, 0, dy)) * most[i];
        dy[n + i] = 0;
    }
    return size;
}

/* The total time of all further crossings, if they stay within 1e-9 of the scene; else HUGE_VAL. */
static double time_left(struct run *run, const struct kink *kink, int part)
{
    const double *t = run->zeno_switches.list[kink->formula.branch + part].t;
    const struct instant at = state_instant(run->state);
    double last = t[0] - t[2], before = t[2] - t[4], ratio = last / before;
    if (!(ratio > 0 && ratio < 1)) return HUGE_VAL;
    double left = last * ratio / (1 - ratio);
    double speed = fabs(sliding_surface(run->state->sliding, run->model, &at, kink, part));
    return speed * fmax(left, last) <= undecided_part * size_of(run, kink, part) ? left : HUGE_VAL;
}

void zeno_switch_end(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    double end = -HUGE_VAL;
    for (size_t k = 0; run->zeno_switches.list && k < plan->kink_count; k++) {
        const struct kink *kink = &plan->kinks[k];
        for (int part = 0; part < (int)kink->count; part++) {
            struct passage *passage = &run->zeno_switches.list[kink->formula.branch + part];
            if (!may_end(run, kink, part) || passage->count < remembered || passage->t[0] != run->state->t)
                continue;
            double left = time_left(run, kink, part);
            if (!(left < HUGE_VAL)) continue;
            run->state->sliding->ended[kink->formula.branch + part] = true;
            passage->count = 0;
            end = fmax(end, run->state->t + left);
        }
    }
    struct zeno_switches *zeno_switches = &run->zeno_switches;
    zeno_switches->now = end > -HUGE_VAL;
    if (!zeno_switches->now) return;
    zeno_switches->end = zeno_switches->end < HUGE_VAL ? fmax(zeno_switches->end, end) : end;
}

void zeno_switch_blunt(struct run *run, int branch)
{
    const double first = undecided_part, more = 100, most = 1e-5;
    struct sliding *s = run->state->sliding;
    const struct leave *left = &run->zeno_switches.list[branch].left;
    if (!(run->state->t - left->t <= run_instant(run))) return;
    double slack = fmin(fmax(more * left->slack, first), most);
    int unit = s->slides[s->slide_at[branch] - 1].unit;
    for (int j = 0; j < s->count; j++)
        if (s->slides[j].unit == unit) s->slides[j].slack = fmax(s->slides[j].slack, slack);
}

void zeno_switch_log_stick(struct run *run, int pair)
{
    bool *waits = run->zeno_switches.sticks ? &run->zeno_switches.sticks[pair] : NULL;
    if (!waits || !*waits) return;
    *waits = false;
    log_friction(run, FBD_EVENT_STICK, pair);
}

void zeno_switch_log(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    struct zeno_switches *zeno_switches = &run->zeno_switches;
    if (zeno_switches->end > run->state->t) return;
    zeno_switches->end = HUGE_VAL;
    for (int pair = 0; pair < (int)plan->mode_count; pair++) zeno_switch_log_stick(run, pair);
    for (size_t k = 0; k < plan->kink_count; k++) {
        const struct kink *kink = &plan->kinks[k];
        bool slides = false;
        for (size_t part = 0; part < kink->count; part++) {
            struct passage *passage = &zeno_switches->list[(size_t)kink->formula.branch + part];
            slides |= passage->slides;
            passage->slides = false;
        }
        if (slides) log_filippov(run, kink, FBD_EVENT_SLIDING);
    }
}
