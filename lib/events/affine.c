/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "events/affine.h"

#include <string.h>

#include "dynamics/contact.h"
#include "events/enclosure.h"
#include "numeric/tolerances.h"

/* ---- affine functions */

static bool add_term(struct affine *f, int component, double factor)
{
    if (factor == 0) return true;
    if (f->count == affine_most_terms) return false;
    f->terms[f->count].component = component;
    f->terms[f->count++].factor = factor;
    return true;
}

/* Add `factor` times the sum of the forces along a coordinate with a scalar equation; false when it is not affine. */
static bool add_along(const struct plan *plan, const struct mode *mode, double factor, struct affine *f)
{
    const struct scalar_equation *equation = &plan->equations[mode->coordinate];
    if (equation->s != 0 || equation->c != 0 || equation->square != 0) return false;
    if (equation->formulas.count > 0) return false;
    f->constant += factor * equation->c0;
    return add_term(f, mode->coordinate, -factor * equation->kq) &&
           add_term(f, plan->n + mode->coordinate, -factor * equation->kv);
}

/* Friction with a constant coefficient other than zero is never idle (friction_is_idle). */
static bool may_idle(const struct mode *mode)
{
    return (mode->mu_s.expr || mode->mu_s.constant == 0) && (mode->mu_k.expr || mode->mu_k.constant == 0);
}

static bool find_slip_stop(const struct fbd_state *state, const struct watcher *watcher, struct affine *f)
{
    const struct plan *plan = &state->model->plan;
    const struct mode *mode = &plan->modes[watcher->index];
    int slip = state->slip[watcher->index];
    if (slip == stick || mode->coupling >= 0 || mode->surface_speed.expr || may_idle(mode)) return false;
    f->constant = -slip * mode->surface_speed.constant;
    return add_term(f, plan->n + mode->coordinate, slip);
}

/* The friction limit under a constant normal load. */
static bool find_limit(const struct fbd_state *state, int pair, double *limit)
{
    const struct plan *plan = &state->model->plan;
    const struct mode *mode = &plan->modes[pair];
    const struct scalar_equation *equation = &plan->equations[mode->coordinate];
    double press = 1;
    if (mode_friction_varies(mode)) return false;
    if (mode->normal_slot >= 0) {
        if (equation->across_formulas.count > 0) return false;
        press = fmax(0, -state->pull[pair] * equation->across);
    }
    *limit = fmax(0, fmax(mode->mu_s.constant, mode->mu_k.constant)) * press;
    return true;
}

/* With the rounding tolerance of friction_rounding. */
static bool find_stick_limit(const struct fbd_state *state, const struct watcher *watcher, struct affine *f)
{
    const struct plan *plan = &state->model->plan;
    const struct mode *mode = &plan->modes[watcher->index];
    if (state->slip[watcher->index] != stick || !watchers_can_enclose(state->model, watcher)) return false;
    if (!find_limit(state, watcher->index, &f->limit)) return false;
    f->roundings = 8;
    f->constant = f->limit;
    return add_along(plan, mode, watcher->end == 0 ? 1 : -1, f);
}

/* Add n . p of a point of a link that moves on the ground: any point of a slider, else the origin. */
static bool add_position(const struct fbd_model *model, int index, struct vec point, struct vec n,
                         struct affine *f)
{
    const struct tree_link *link = &model->tree->links[index];
    const bool origin = point.x == 0 && point.y == 0;
    const double along = vec_dot(n, link->e), across = vec_dot(n, vec_perp(link->e));
    if (link->parent != 0) return false;
    f->constant += vec_dot(n, link->at);
    if (link->kind == motion_slide) {
        f->constant += vec_dot(n, vec_turn(link->tilt, point));
        return add_term(f, link->coordinate, along);
    }
    return (link->kind == motion_particle || link->kind == motion_planar) && origin &&
           add_term(f, link->coordinate, along) && add_term(f, link->coordinate + 1, across);
}

/* The gap of a stop, or of a point or a disc at a line of the ground whose normal is `side` k x e. */
static bool find_gap(const struct fbd_model *model, int index, double side, struct affine *f)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    const struct tree_link *link = &model->tree->links[meeting->shape[0].link];
    if (meeting->coupling_count > 1) return false;
    if (meeting->stop != 0) {
        f->constant = -meeting->stop * meeting->limit;
        return (link->kind == motion_slide || link->kind == motion_pivot) &&
               add_term(f, link->coordinate, meeting->stop);
    }
    if (meeting->shape[1].kind != contact_line || meeting->shape[1].link != 0) return false;
    struct touch touch = meeting_touch(meeting, 0);
    struct vec n = vec_scale(side, vec_perp(touch.e));
    f->constant = -vec_dot(n, touch.base) - touch.radius;
    return add_position(model, meeting->shape[0].link, touch.point, n, f);
}

static void clear(struct affine *f)
{
    f->constant = f->limit = f->roundings = 0;
    f->count = 0;
    f->piece = 0;
}

bool affine_mark_gap(const struct fbd_model *model, int index, bool *used)
{
    struct affine f;
    clear(&f);
    if (!find_gap(model, index, 1, &f)) return false;
    for (int i = 0; used && i < f.count; i++) used[f.terms[i].component] = true;
    return true;
}

/* Gaps are functions of the coordinates alone, in all modes. Less than meeting_rounding is added, so that the
 * shapes are not left deeper than that. */
static bool find_present_gap(const struct fbd_state *state, const struct watcher *watcher, double deep,
                             struct affine *f)
{
    const struct meeting *meeting = &state->model->tree->meetings[watcher->index];
    if (!find_gap(state->model, watcher->index, state->tree->couplings[meeting->first_coupling].side[0], f))
        return false;
    f->constant += deep + round_off(8, meeting->reach);
    return true;
}

void affine_find(const struct watchers *watchers, const struct fbd_state *state,
                 const struct watcher *watcher, struct affine *f)
{
    clear(f);
    if (watcher->kind == watch_gap)
        f->known = find_present_gap(state, watcher, watchers->deep ? watchers->deep[watcher->index] : 0, f);
    else
        f->known = !state_sliding(state) &&
                   ((watcher->kind == watch_slip_stop && find_slip_stop(state, watcher, f)) ||
                    (watcher->kind == watch_stick_limit && find_stick_limit(state, watcher, f)));
}

struct enclosure affine_over(const struct affine *f, const struct enclosure *y)
{
    struct enclosure sum = enclosure_point(f->constant);
    for (int i = 0; i < f->count; i++)
        sum = enclosure_add(sum, enclosure_scale(f->terms[i].factor, y[f->terms[i].component]));
    return sum;
}

double affine_value(const struct affine *f, const double *y, const double *dy, double *rate)
{
    double sum = 0;
    *rate = 0;
    for (int i = 0; i < f->count; i++) {
        sum += f->terms[i].factor * y[f->terms[i].component];
        *rate += f->terms[i].factor * dy[f->terms[i].component];
    }
    return f->constant + sum + round_off(f->roundings, fabs(sum) + f->limit);
}

/* ---- over a piece of the trajectory */

/* Add one component; false where it is not followed. */
static bool add_component(const struct trajectory *trajectory, int component, double factor, struct affine *f)
{
    int place = trajectory->place[component],
        top = place < 0 ? -1 : trajectory_top(trajectory, (size_t)place);
    if (top < 0) return false;
    const double *c = trajectory_powers_of(trajectory, (size_t)place);
    for (; f->top < top; f->top++) f->power[f->top + 1] = 0;
    double bend = 0, weight = 0; /* k (k - 1) */
    for (int k = 0; k <= top; k++) {
        f->power[k] += factor * c[k];
        bend += weight * fabs(c[k]);
        weight += 2 * k;
    }
    f->bend += fabs(factor) * bend;
    f->doubt += fabs(factor) * trajectory->doubt[place];
    f->extent += fabs(factor) * trajectory->extent[place];
    return true;
}

/* Omit the highest powers, and sum up their part of |f''|. */
static void set_rough(struct affine *f)
{
    const double negligible = 1.0 / 1024;
    f->rest = 0;
    for (f->rough = f->top; f->rough > 1; f->rough--) {
        double rest = f->rest + f->rough * (f->rough - 1) * fabs(f->power[f->rough]);
        if (rest > negligible * f->bend) break;
        f->rest = rest;
    }
}

/* f as a polynomial of the piece. */
static void follow(struct affine *f, const struct trajectory *trajectory)
{
    const double roundings = 4;
    double radius = (trajectory->to - trajectory->from) / 2;
    f->piece = trajectory->piece;
    f->middle = trajectory->from + radius;
    f->per = 1 / radius;
    f->top = 0;
    f->power[0] = f->constant;
    f->doubt = f->bend = 0;
    f->extent = fabs(f->constant);
    for (int i = 0; i < f->count; i++) {
        if (add_component(trajectory, f->terms[i].component, f->terms[i].factor, f)) continue;
        f->top = -1;
        return;
    }
    f->slack = round_off(f->roundings, f->extent + f->limit);
    f->doubt += round_off(roundings, f->extent);
    set_rough(f);
}

static bool is_followed(struct affine *f, const struct trajectory *trajectory)
{
    if (!f->known || !trajectory->exact || !(trajectory->to > trajectory->from)) return false;
    if (f->piece != trajectory->piece) follow(f, trajectory);
    return f->top >= 0;
}

/* Sum of the powers up to `top`. */
static double value_at(const struct affine *f, int top, double s, double *slope)
{
    double value = f->power[top], rate = 0;
    for (int k = top - 1; k >= 0; k--) {
        rate = value + s * rate;
        value = f->power[k] + s * value;
    }
    *slope = rate;
    return value;
}

/* With |f''| <= B: |f - f(s0) - f'(s0) x| <= B x^2/2 and |f' - f'(s0)| <= B |x|. The bounds are slightly
 * wider than those of trajectory_poly.c from all powers if these fall like those of a step of a method, and
 * cost far less. Over long stretches B is so large that the high powers do not matter. */
bool affine_enclose(struct affine *f, const struct trajectory *trajectory, const struct stretch *stretch,
                    struct enclosure *out)
{
    const double is_long = 1.0 / 8;
    if (!is_followed(f, trajectory)) return false;
    double r = stretch_radius(stretch) * f->per, s = (stretch->middle - f->middle) * f->per, slope;
    bool rough = r >= is_long;
    double value = value_at(f, rough ? f->rough : f->top, s, &slope), rest = rough ? f->rest : 0;
    double reach = (fabs(slope) + f->bend * r / 2) * r + rest + f->doubt,
           steep = f->bend * r + rest + f->doubt * trajectory->degree;
    out->value = interval_widen(value - reach, value + reach + f->slack, 1);
    out->rate = interval_widen((slope - steep) * f->per, (slope + steep) * f->per, 3);
    out->middle =
        interval_widen(value - f->doubt, value + f->doubt + f->slack, 1); /* width: its round-off level */
    return true;
}

/* ---- zero */

/* Newton's method, in a bracket that is halved where an iterate leaves it. A step d leaves an error of f''
 * d^2/(2 f'). */
double affine_zero(struct affine *f, const struct trajectory *trajectory, double low, double high)
{
    enum { most_steps = 60 };
    if (!is_followed(f, trajectory)) return (double)NAN;
    double a = (low - f->middle) * f->per, b = (high - f->middle) * f->per, slope;
    double above = value_at(f, f->top, a, &slope), below = value_at(f, f->top, b, &slope);
    if (!(above > 0) || !(below < 0)) return (double)NAN;
    double s = a + (b - a) * (above / (above - below));
    for (int step = 0; step < most_steps; step++) {
        double value = value_at(f, f->top, s, &slope), d = -value / slope;
        if (value > 0)
            a = s;
        else
            b = s;
        bool there = f->bend * d * d <= round_off(1, fabs(slope)) || b - a <= round_off(1, 1);
        if (there) return f->middle + (s + d) / f->per;
        s = s + d > a && s + d < b ? s + d : a + (b - a) / 2;
    }
    return f->middle + s / f->per;
}
