/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/pieces.h"

#include <math.h>
#include <stdlib.h>

#include "expr/interval.h"

/* The formulas, and scratch memory. */
struct substeps {
    const struct expr *const *formulas;
    size_t count;
    int slot, *branch; /* of all */
    double *y, *on;    /* slot: the variable, and its direction */
    struct enclosure *spans, *margins;
};

static size_t switches_of(const struct substeps *walk)
{
    size_t switches = 0;
    for (size_t i = 0; i < walk->count; i++) switches += expr_switches(walk->formulas[i]);
    return switches;
}

/* True if no formula depends on anything but the slot. */
static bool is_of_one(const struct substeps *walk)
{
    for (size_t i = 0; i < walk->count; i++) {
        const int *slots;
        size_t variables = expr_variables(walk->formulas[i], &slots);
        if (expr_uses_time(walk->formulas[i]) || variables > 1) return false;
        if (variables == 1 && slots[0] != walk->slot) return false;
    }
    return true;
}

static bool start(struct substeps *walk)
{
    size_t switches = switches_of(walk), slots = (size_t)walk->slot;
    walk->branch = calloc(switches + 1, sizeof *walk->branch);
    walk->margins = calloc(2 * switches + 1, sizeof *walk->margins);
    walk->y = calloc(2 * slots, sizeof *walk->y);
    walk->spans = calloc(slots, sizeof *walk->spans);
    walk->on = walk->y ? walk->y + slots : NULL;
    return walk->branch && walk->margins && walk->y && walk->spans;
}

static void end(struct substeps *walk)
{
    free(walk->branch);
    free(walk->margins);
    free(walk->y);
    free(walk->spans);
}

static void resolve(struct substeps *walk, double at)
{
    int *branch = walk->branch;
    walk->y[walk->slot - 1] = at;
    walk->on[walk->slot - 1] = 1;
    for (size_t i = 0; i < walk->count; branch += expr_switches(walk->formulas[i++]))
        if (expr_switches(walk->formulas[i]) > 0)
            expr_resolve(walk->formulas[i], time_dd_at(0), walk->y, 0, walk->on, NULL, branch);
}

/* True if enclosures prove that no switch changes between two values of the variable. */
static bool is_one(struct substeps *walk, double from, double to)
{
    const int *branch = walk->branch;
    struct stretch stretch = stretch_between(from, to);
    walk->spans[walk->slot - 1] = (struct enclosure){{from, to}, {1, 1}, interval_point(stretch.middle)};
    for (size_t i = 0; i < walk->count; i++) {
        size_t switches = expr_switches(walk->formulas[i]);
        if (switches > 0)
            expr_enclose_margins(walk->formulas[i], &stretch, walk->spans, branch, walk->margins);
        for (size_t k = 0; k < 2 * switches; k++) {
            /* A margin that is identically zero, as in mod(0*s, 1), does not change. */
            const struct interval margin = walk->margins[k].value;
            if (!(margin.low > 0 || (margin.low == 0 && margin.high == 0))) return false;
        }
        branch += switches;
    }
    return true;
}

/* The end of the piece that begins at `from`. */
static double piece_end(struct substeps *walk, double from, double to, double narrow)
{
    double low = from, wide = to - from;
    while (low < to) {
        double high = wide >= to - low ? to : low + wide;
        if (is_one(walk, low, high)) {
            low = high;
            wide *= 2;
        } else if (wide < narrow || high == low) {
            return high > low ? high : to;
        } else {
            wide = fmin(wide, to - low) / 2;
        }
    }
    return to;
}

static int cut(struct substeps *walk, double from, double to, int most, double *ends)
{
    /* Below the smallest normal number halving is inexact and ends at zero: the search would not terminate. */
    const double narrow = fmax(4 * DBL_EPSILON * fmax(fabs(from), fabs(to)), DBL_MIN);
    int pieces = 0, nothing = 0;
    ends[0] = from;
    double at = from;
    while (at < to) {
        if (pieces == most || nothing > most) return pieces_too_many;
        resolve(walk, at);
        double next = piece_end(walk, at, to, narrow);
        /* The start lies on a switch that was resolved to the other side: the interval up to it is empty.
         * Many in succession mean a function that is at its switch to rounding. */
        bool is_piece = next - at > 2 * narrow;
        nothing = is_piece ? 0 : nothing + 1;
        if (is_piece) ends[++pieces] = next;
        at = next;
    }
    if (pieces == 0) pieces = 1; /* the whole range is that narrow */
    ends[pieces] = to;
    return pieces;
}

int pieces_cut(const struct expr *const *formulas, size_t count, int slot, double from, double to, int most,
               double *ends)
{
    struct substeps walk = {.formulas = formulas, .count = count, .slot = slot};
    ends[0] = from;
    ends[1] = to;
    if (switches_of(&walk) == 0 || !is_of_one(&walk)) return 1;
    if (!isfinite(to - from)) { /* halving does not shorten it */
        ends[most] = from;
        return pieces_too_many;
    }
    int pieces = start(&walk) ? cut(&walk, from, to, most, ends) : pieces_no_memory;
    end(&walk);
    return pieces;
}

bool pieces_branches(const struct expr *formula, int slot, double from, double to, int *branch)
{
    struct substeps walk = {.formulas = &formula, .count = 1, .slot = slot};
    bool started = start(&walk);
    if (started) resolve(&walk, from + (to - from) / 2);
    for (size_t k = 0; started && k < expr_switches(formula); k++) branch[k] = walk.branch[k];
    end(&walk);
    return started;
}
