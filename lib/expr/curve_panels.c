/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Panels: intervals of p on which the speed |r'|, its inverse function p(s) and the curvature are series.
 */
#include <float.h>
#include <stdlib.h>

#include "expr/curve_panel.h"

enum { order = panel_order, most_panels = 40000 };

static const double pi = 3.14159265358979323846;

double series_at(const double *c, int n, double x)
{
    double b = 0, before = 0;
    for (int k = n - 1; k > 0; k--) {
        double next = c[k] + 2 * x * b - before;
        before = b;
        b = next;
    }
    return c[0] / 2 + x * b - before;
}

void series_slopes(const double *c, int n, double *slopes)
{
    double next = 0, after = 0;
    for (int k = n - 1; k > 0; k--) {
        double slope = after + 2 * k * c[k];
        after = next;
        next = slope;
        slopes[k - 1] = slope;
    }
    slopes[n - 1] = 0;
}

static double node(int j)
{
    return -cos(pi * (j + 0.5) / order);
}

/* cos(k phi) at node j, tabulated because every fit uses it. */
struct cosines {
    double at[order][order];
};

static void fill(struct cosines *cosines)
{
    for (int k = 0; k < order; k++)
        for (int j = 0; j < order; j++) cosines->at[k][j] = cos(pi * k * (j + 0.5) / order);
}

/* The series through the values at the nodes. */
static void fit(const struct cosines *cosines, const double *f, double *c)
{
    for (int k = 0; k < order; k++) {
        double sum = 0;
        for (int j = 0; j < order; j++) sum += f[j] * cosines->at[k][j];
        c[k] = 2 * sum / order * (k % 2 == 0 ? 1 : -1);
    }
}

/* The largest of the coefficients from number `first` on. */
static double most_from(const double *c, int first)
{
    double most = 0;
    for (int k = first; k < order; k++) most = larger(most, fabs(c[k]));
    return most;
}

/* True if the last coefficients are at most `share` of `size`: the series has converged. */
static bool ends(const double *c, double share, double size)
{
    enum { looked_at = 3 };
    return most_from(c, order - looked_at) <= share * size;
}

/* A panel during its fit. */
struct draft {
    const struct curve *curve;
    const struct curve_piece *piece;
    const struct cosines *cosines;
    double from, wide;
    double speed[order],
        length[order + 1];     /* series in p: |r'|, and the length from the start of the panel */
    double x[order], y[order]; /* r' */
    double fastest;
    long *looks; /* of the whole curve: number of intervals tested by hides_something */
};

static bool fit_speed(struct draft *draft, double *bad)
{
    double speed[order], x[order], y[order];
    draft->fastest = 0;
    for (int j = 0; j < order; j++) {
        double p = draft->from + draft->wide * (1 + node(j)) / 2;
        struct curve_jet jet = curve_jet_at(draft->curve, draft->piece, p);
        speed[j] = vec_norm(jet.d);
        if (!isfinite(speed[j] + vec_norm(jet.r) + vec_norm(jet.dd))) {
            *bad = p;
            return false;
        }
        x[j] = jet.d.x;
        y[j] = jet.d.y;
        draft->fastest = fmax(draft->fastest, speed[j]);
    }
    fit(draft->cosines, speed, draft->speed);
    fit(draft->cosines, x, draft->x);
    fit(draft->cosines, y, draft->y);
    const double *c = draft->speed;
    for (int k = 1; k <= order; k++)
        draft->length[k] = (c[k - 1] - (k + 1 < order ? c[k + 1] : 0)) / (2 * k) * draft->wide / 2;
    draft->length[0] = 0;
    draft->length[0] = -2 * series_at(draft->length, order + 1, -1);
    return true;
}

/* The position in [-1, 1] at which the panel has the length s, by Newton's method. */
static double place_of(const struct draft *draft, double s, double guess)
{
    double x = guess;
    for (int i = 0; i < 50; i++) {
        double slope = series_at(draft->speed, order, x) * draft->wide / 2;
        double step = (series_at(draft->length, order + 1, x) - s) / slope;
        double next = fmin(fmax(x - step, -1), 1);
        bool near = fabs(next - x) <= 2 * DBL_EPSILON;
        x = next;
        if (near || !isfinite(x)) break;
    }
    return x;
}

/* Make the series exactly 0 at the start and 1 at the end. */
static void meet_ends(double *u)
{
    double low = series_at(u, order, -1), high = series_at(u, order, 1) - 1;
    u[0] -= low + high;
    u[1] -= (high - low) / 2;
}

static struct vec direction_at(const struct draft *draft, double x)
{
    struct vec d = {series_at(draft->x, order, x), series_at(draft->y, order, x)};
    return vec_scale(1 / vec_norm(d), d);
}

/* ---- variation between the 24 nodes
 *
 * A bend much shorter than the panel may lie between the nodes. So r' is enclosed (interval.h) over intervals
 * of the panel: one over which it varies little hides nothing; any other is compared with the series at its
 * middle, and halved. */

/* r' over p +- radius. */
static void enclose_slope(const struct draft *draft, double p, double radius, struct interval slope[2])
{
    const struct expr *const formulas[2] = {draft->curve->x, draft->curve->y};
    const int *const branches[2] = {draft->piece->branch_x, draft->piece->branch_y};
    const struct stretch stretch = stretch_between(p - radius, p + radius);
    const struct enclosure y = {{stretch.from, stretch.to}, interval_point(1), interval_point(p)};
    for (int i = 0; i < 2; i++) slope[i] = expr_enclose(formulas[i], &stretch, &y, branches[i]).rate;
}

/* True if r' differs from its series at p. */
static bool differs(const struct draft *draft, double p)
{
    const double seen = 1e-6;
    struct curve_jet jet = curve_jet_at(draft->curve, draft->piece, p);
    double x = 2 * (p - draft->from) / draft->wide - 1;
    struct vec series = {series_at(draft->x, order, x), series_at(draft->y, order, x)};
    return !(vec_norm(vec_sub(jet.d, series)) <= seen * draft->fastest);
}

/* True if the series of r' misses some variation. Intervals are processed from the left, with right halves on
 * the stack, one of each depth. Where enclosures stay wide, as next to a root, the test ends after `most`
 * intervals without a result, and the panel is accepted. */
static bool hides_something(const struct draft *draft)
{
    enum { deepest = 40, most = 2000 };
    const double little = 0.05;
    struct {
        double p, radius;
    } stack[deepest + 2] = {{draft->from + draft->wide / 2, draft->wide / 2}};
    const double least = ldexp(draft->wide, -deepest);
    int waiting = 1;
    for (int count = 0; waiting > 0 && count < most; count++, ++*draft->looks) {
        double p = stack[--waiting].p, radius = stack[waiting].radius;
        struct interval slope[2];
        enclose_slope(draft, p, radius, slope);
        double width = fmax(interval_width(slope[0]), interval_width(slope[1]));
        if (width <= little * draft->fastest || radius <= least) continue;
        if (differs(draft, p)) return true;
        stack[waiting].p = p + radius / 2;
        stack[waiting++].radius = radius / 2;
        stack[waiting].p = p - radius / 2;
        stack[waiting++].radius = radius / 2;
    }
    return false;
}

/* ---- panels */

/* Fit a panel; false if a series has not converged. `share` is the attainable relative accuracy. */
static bool fit_panel(const struct draft *draft, double share, struct curve_panel *panel)
{
    const double lost = 1e4; /* accuracy lost by second derivatives */
    const double most_turn = 1.5;
    double u[order], bend[order], fastest = draft->fastest, x = -1;
    *panel = (struct curve_panel){.p = draft->from, .wide = draft->wide};
    panel->length = series_at(draft->length, order + 1, 1);
    panel->e = direction_at(draft, -1);
    panel->end = direction_at(draft, 1);
    if (!ends(draft->speed, share, fastest) || !ends(draft->x, share, fastest) ||
        !ends(draft->y, share, fastest) || !(panel->length > 0))
        return false;
    for (int j = 0; j < order; j++) {
        x = place_of(draft, panel->length * (1 + node(j)) / 2, x);
        u[j] = (1 + x) / 2;
        struct curve_jet jet = curve_jet_at(draft->curve, draft->piece, draft->from + draft->wide * u[j]);
        bend[j] = curve_jet_bend(&jet);
    }
    fit(draft->cosines, u, panel->u);
    meet_ends(panel->u);
    fit(draft->cosines, bend, panel->bend);
    double turn = most_from(panel->bend, 0) * panel->length;
    return ends(panel->u, share, 1) && turn <= most_turn &&
           ends(panel->bend, lost * share, fmax(turn, 1e-3) / panel->length) && !hides_something(draft);
}

static bool add(struct panel_list *list, const struct curve_panel *panel)
{
    if (list->count == list->room) {
        int room = list->room > 0 ? 2 * list->room : 64;
        struct curve_panel *panels = realloc(list->panels, (size_t)room * sizeof *panels);
        if (!panels) return false;
        list->panels = panels;
        list->room = room;
    }
    list->panels[list->count++] = *panel;
    return true;
}

enum curve_fault curve_fit(const struct curve *curve, const struct curve_piece *piece, double from, double to,
                           struct panel_list *list, double *place)
{
    const double first_share = 8, digits = 1e-14, narrowest = 1e-9, still = 1e-3;
    const long most_looks = 2000000; /* twice the number for spirals of so many panels */
    double range = curve->to - curve->from, wide = range / first_share, fastest = 0;
    double size = fmax(fabs(from), fabs(to));
    struct cosines cosines;
    fill(&cosines);
    while (from < to) {
        struct draft draft = {.curve = curve,
                              .piece = piece,
                              .cosines = &cosines,
                              .from = from,
                              .wide = fmin(wide, to - from),
                              .looks = &list->looks};
        struct curve_panel panel;
        *place = from;
        if (list->looks > most_looks) return curve_intricate;
        if (!fit_speed(&draft, place)) return curve_not_finite;
        if (draft.fastest == 0) return curve_stands_still;
        fastest = fmax(fastest, draft.fastest);
        if (fit_panel(&draft, digits + 16 * DBL_EPSILON * size / draft.wide, &panel)) {
            if (list->count == most_panels) return curve_intricate;
            if (!add(list, &panel)) return curve_no_memory;
            bool last = draft.wide >= to - from;
            from += draft.wide;
            if (last) break;
            wide = fmin(2 * draft.wide, range / first_share);
            continue;
        }
        wide = draft.wide / 2;
        if (wide < narrowest * range)
            return draft.fastest <= still * fastest ? curve_stands_still : curve_rough;
    }
    return curve_made;
}
