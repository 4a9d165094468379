/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "events/affine.h"

#include <string.h>

#include "events/outlook.h"

/* ---- what is affine */

static bool add_term(struct affine *f, int component, double factor)
{
    if (factor == 0) return true;
    if (f->count == affine_most_terms) return false;
    f->terms[f->count].component = component;
    f->terms[f->count++].factor = factor;
    return true;
}

static bool add_terms(const struct plan *plan, const struct range *range, int slot, double factor,
                      struct affine *f)
{
    for (int i = range->first; i < range->first + range->count; i++) {
        const struct affine_term *term = &plan->affine[i];
        if (term->slot != slot) continue;
        f->constant += factor * term->c0;
        if (!add_term(f, term->coordinate, -factor * term->kq) ||
            !add_term(f, plan->n + term->coordinate, -factor * term->kv))
            return false;
    }
    return true;
}

/* Add `factor` times the sum of forces in a slot of a body of which outlook.h knows all; false when it is not affine. */
static bool add_slot(const struct plan *plan, int body, int slot, double factor, struct affine *f)
{
    const struct body_terms *terms = &plan->bodies[body];
    for (int i = terms->sine.first; i < terms->sine.first + terms->sine.count; i++)
        if (plan->sine[i].slot == slot) return false;
    for (int i = terms->square.first; i < terms->square.first + terms->square.count; i++)
        if (plan->square[i].slot == slot) return false;
    for (int i = terms->formulas.first; i < terms->formulas.first + terms->formulas.count; i++)
        if (plan->formulas[i].slot == slot) return false;
    return add_terms(plan, &terms->affine, slot, factor, f) &&
           add_terms(plan, &terms->across, slot, factor, f);
}

/* Friction one of whose coefficients is a number beside zero is never idle (friction_is_idle). */
static bool may_idle(const struct mode *mode)
{
    return (mode->mu_s.expr || mode->mu_s.constant == 0) && (mode->mu_k.expr || mode->mu_k.constant == 0);
}

static bool find_slip_stop(const struct fbd_state *state, const struct watcher *watcher, struct affine *f)
{
    const struct plan *plan = &state->model->plan;
    const struct mode *mode = &plan->modes[watcher->index];
    int slip = state->slip[watcher->index];
    if (slip == stick || mode->tie >= 0 || mode->surface_speed.expr || may_idle(mode)) return false;
    f->constant = -slip * mode->surface_speed.constant;
    return add_term(f, plan->n + mode->coordinate, slip);
}

/* The limit under a load across that is a number. */
static bool find_limit(const struct fbd_state *state, int pair, double *limit)
{
    const struct plan *plan = &state->model->plan;
    const struct mode *mode = &plan->modes[pair];
    struct affine across = {.constant = 0};
    double press = 1;
    if (mode->mu_s.expr || mode->mu_k.expr) return false;
    if (mode->normal_slot >= 0) {
        if (!add_slot(plan, mode->body, mode->normal_slot, -state->pull[pair], &across) || across.count > 0)
            return false;
        press = fmax(0, across.constant);
    }
    *limit = fmax(0, fmax(mode->mu_s.constant, mode->mu_k.constant)) * press;
    return true;
}

/* With the room for rounding that friction_rounding gives. */
static bool find_stick_limit(const struct fbd_state *state, const struct watcher *watcher, struct affine *f)
{
    const struct plan *plan = &state->model->plan;
    const struct mode *mode = &plan->modes[watcher->index];
    if (state->slip[watcher->index] != stick || !watchers_can_enclose(state->model, watcher)) return false;
    if (!find_limit(state, watcher->index, &f->limit)) return false;
    f->roundings = 8;
    f->constant = f->limit;
    return add_slot(plan, mode->body, mode->hold_slot, watcher->end == 0 ? 1 : -1, f);
}

void affine_find(const struct fbd_state *state, const struct watcher *watcher, struct affine *f)
{
    f->constant = f->limit = f->roundings = 0;
    f->count = 0;
    f->piece = 0;
    f->known = !state_sliding(state) &&
               ((watcher->kind == watch_slip_stop && find_slip_stop(state, watcher, f)) ||
                (watcher->kind == watch_stick_limit && find_stick_limit(state, watcher, f)));
}

/* ---- over a piece of the course */

static int power_of(const struct course *course, int component, double factor, struct affine *f)
{
    int place = course->place[component], top = place < 0 ? -1 : course_top(course, (size_t)place);
    if (top < 0) return top;
    const double *c = course_powers_of(course, (size_t)place);
    for (int k = f->top + 1; k <= top; k++) f->power[k] = 0;
    for (int k = 0; k <= top; k++) f->power[k] += factor * c[k];
    f->doubt += fabs(factor) * course->doubt[place];
    return top;
}

/* f as a polynomial of the piece. */
static void follow(struct affine *f, const struct course *course)
{
    const double roundings = 4;
    double size = 0;
    f->piece = course->piece;
    f->top = 0;
    f->power[0] = f->constant;
    f->doubt = f->bend = 0;
    for (int i = 0; i < f->count; i++) {
        int top = power_of(course, f->terms[i].component, f->terms[i].factor, f);
        if (top < 0) {
            f->top = -1;
            return;
        }
        if (top > f->top) f->top = top;
    }
    for (int k = 0; k <= f->top; k++) {
        size += fabs(f->power[k]);
        f->bend += k * (k - 1) * fabs(f->power[k]);
    }
    size += fabs(f->constant);
    f->slack = f->roundings * DBL_EPSILON * (size + f->limit);
    f->doubt += roundings * DBL_EPSILON * size;
}

static bool is_followed(struct affine *f, const struct course *course)
{
    if (!f->known || !course->exact || !(course->to > course->from)) return false;
    if (f->piece != course->piece) follow(f, course);
    return f->top >= 0;
}

static double value_at(const struct affine *f, double s, double *slope)
{
    double value = f->power[f->top], rate = 0;
    for (int k = f->top - 1; k >= 0; k--) {
        rate = value + s * rate;
        value = f->power[k] + s * value;
    }
    *slope = rate;
    return value;
}

/* With |f''| <= B: |f - f(s0) - f'(s0) x| <= B x^2/2 and |f' - f'(s0)| <= B |x|. Wider than what course.c makes of all powers of a
 * series by little where they fall like those of a step of a method, and by far less work. */
bool affine_enclose(struct affine *f, const struct course *course, const struct stretch *stretch,
                    struct enclosure *out)
{
    if (!is_followed(f, course)) return false;
    double radius = (course->to - course->from) / 2, middle = course->from + radius, slope;
    double r = stretch_radius(stretch) / radius,
           value = value_at(f, (stretch->middle - middle) / radius, &slope);
    double reach = (fabs(slope) + f->bend * r / 2) * r + f->doubt,
           steep = f->bend * r + f->doubt * course->degree;
    out->value = interval_widen(value - reach, value + reach + f->slack, 1);
    out->rate = interval_widen((slope - steep) / radius, (slope + steep) / radius, 2);
    out->middle = interval_widen(value - f->doubt, value + f->doubt + f->slack, 1);
    return true;
}

/* ---- its zero */

/* Newton, in a bracket that is halved where he leaves it. */
double affine_zero(struct affine *f, const struct course *course, double low, double high)
{
    enum { most_steps = 60 };
    if (!is_followed(f, course)) return (double)NAN;
    double radius = (course->to - course->from) / 2, middle = course->from + radius, slope;
    double a = (low - middle) / radius, b = (high - middle) / radius, s = b;
    if (!(value_at(f, a, &slope) > 0) || !(value_at(f, b, &slope) < 0)) return (double)NAN;
    for (int step = 0; step < most_steps; step++) {
        double value = value_at(f, s, &slope), next = s - value / slope;
        if (value > 0)
            a = s;
        else
            b = s;
        if (!(next > a && next < b)) next = a + (b - a) / 2;
        bool there = fabs(next - s) <= DBL_EPSILON;
        s = next;
        if (there) break;
    }
    return middle + radius * s;
}
