/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/passages.h"

#include <stdlib.h>
#include <string.h>

#include "dynamics/modes.h"
#include "solve/run.h"

enum { remembered = 5 };

bool passages_init(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    struct passages *passages = &run->passages;
    passages->end = HUGE_VAL;
    if (plan->slide_count == 0) return true;
    passages->list = calloc((size_t)plan->branches, sizeof *passages->list);
    passages->sticks = calloc(plan->friction_count + 1, sizeof *passages->sticks);
    return passages->list && passages->sticks;
}

void passages_free(struct passages *passages)
{
    free(passages->list);
    free(passages->sticks);
}

static bool may_end(const struct run *run, const struct kink *kink, int part)
{
    return run->passages.list && kink->slides && kink_watches_places(kink, part);
}

void passages_remember(struct run *run, const struct watcher *watcher)
{
    const struct kink *kink = &run->model->plan.kinks[watcher->index];
    if (!may_end(run, kink, watcher->part)) return;
    struct passage *passage = &run->passages.list[kink->formula.branch + watcher->part];
    memmove(passage->t + 1, passage->t, (remembered - 1) * sizeof *passage->t);
    passage->t[0] = run->state->t;
    passage->count++;
}

/* The largest that u has been: its gradient, times the largest coordinates of the run. */
static double size_of(struct run *run, const struct kink *kink, int part)
{
    struct fbd_state *state = run->state;
    const struct instant at = state_instant(state);
    size_t n = (size_t)run->model->plan.n;
    const double *most = run->anchor + 2 * n;
    double size = 0, *dy = run->sample; /* scratch of 2 n */
    memset(dy, 0, 2 * n * sizeof *dy);
    for (size_t i = 0; i < n; i++) {
        dy[n + i] = 1;
        size += fabs(sliding_surface_rate(state->sliding, run->model, &at, kink, part, 0, dy)) * most[i];
        dy[n + i] = 0;
    }
    return size;
}

/* The time that all further passages take together, where they stay within what nobody sees, 1e-9 of the
 * scene; else HUGE_VAL. */
static double time_left(struct run *run, const struct kink *kink, int part)
{
    const double unseen = 1e-9;
    const double *t = run->passages.list[kink->formula.branch + part].t;
    const struct instant at = state_instant(run->state);
    double last = t[0] - t[2], before = t[2] - t[4], ratio = last / before;
    if (!(ratio > 0 && ratio < 1)) return HUGE_VAL;
    double left = last * ratio / (1 - ratio);
    double speed = fabs(sliding_surface(run->state->sliding, run->model, &at, kink, part));
    return speed * fmax(left, last) <= unseen * size_of(run, kink, part) ? left : HUGE_VAL;
}

/* Onto the switch, by the forces that it switches. Whether it is slid on from there is for the modes to settle,
 * together with others that have the same surface. */
static void put_onto(struct run *run, int index, int part)
{
    const struct kink *kink = &run->model->plan.kinks[index];
    struct sliding *s = run->state->sliding;
    int branch = kink->formula.branch + part;
    if (s->slide_at[branch] > 0) return;
    sliding_add(s, kink, index, part, s->units, 1);
    sliding_project(run->state);
    run_drop_rounding(run);
    s->slide_at[branch] = 0;
    sliding_drop(s);
}

void passages_end(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    double end = -HUGE_VAL;
    for (size_t k = 0; run->passages.list && k < plan->kink_count; k++) {
        const struct kink *kink = &plan->kinks[k];
        for (int part = 0; part < (int)kink->count; part++) {
            struct passage *passage = &run->passages.list[kink->formula.branch + part];
            if (!may_end(run, kink, part) || passage->count < remembered || passage->t[0] != run->state->t)
                continue;
            double left = time_left(run, kink, part);
            if (!(left < HUGE_VAL)) continue;
            put_onto(run, (int)k, part);
            passage->count = 0;
            end = fmax(end, run->state->t + left);
        }
    }
    if (end > -HUGE_VAL) run->passages.end = end;
}

void passages_note(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    struct passages *passages = &run->passages;
    if (passages->end > run->state->t) return;
    passages->end = HUGE_VAL;
    for (int pair = 0; pair < (int)plan->friction_count; pair++) {
        if (passages->sticks[pair]) run_note_friction(run, FBD_EVENT_STICK, pair);
        passages->sticks[pair] = false;
    }
    for (size_t k = 0; k < plan->kink_count; k++) {
        const struct kink *kink = &plan->kinks[k];
        bool slides = false;
        for (size_t part = 0; part < kink->count; part++) {
            struct passage *passage = &passages->list[(size_t)kink->formula.branch + part];
            slides |= passage->slides;
            passage->slides = false;
        }
        if (slides) run_note_slide(run, kink, FBD_EVENT_SLIDING);
    }
}
