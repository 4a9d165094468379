/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pieces: stretches of p on which the formulas of a curve keep their branches, found with proof by enclosures of their
 * margins (expr.h): a stretch that is not proved to be one is halved.
 */
#include <stdlib.h>
#include <string.h>

#include "expr/curve_panel.h"

/* One of the two formulas, with its branches at hand. */
struct walk {
    const struct expr *expr;
    size_t switches;
    int *branch;
    struct enclosure *margins;
};

static bool start(struct walk *walk, const struct expr *expr)
{
    *walk = (struct walk){.expr = expr, .switches = expr_switches(expr)};
    walk->branch = calloc(walk->switches + 1, sizeof *walk->branch);
    walk->margins = calloc(2 * walk->switches + 1, sizeof *walk->margins);
    return walk->branch && walk->margins;
}

static void end(struct walk *walk)
{
    free(walk->branch);
    free(walk->margins);
}

static void resolve(struct walk *walk, double p)
{
    const double on = 1;
    if (walk->switches > 0) expr_resolve(walk->expr, moment_at(0), &p, 0, &on, NULL, walk->branch);
}

/* Does no switch turn between two values of p, for sure? */
static bool is_one(struct walk *walk, double from, double to)
{
    if (walk->switches == 0) return true;
    struct stretch stretch = stretch_between(from, to);
    struct enclosure p = {{from, to}, {1, 1}, interval_point(stretch.middle)};
    expr_enclose_margins(walk->expr, &stretch, &p, walk->branch, walk->margins);
    for (size_t i = 0; i < 2 * walk->switches; i++)
        if (!(walk->margins[i].value.low > 0)) return false;
    return true;
}

/* The end of the piece that begins at `from`. */
static double piece_end(struct walk walks[2], double from, double to, double narrow)
{
    double low = from, wide = to - from;
    while (low < to) {
        double high = wide >= to - low ? to : low + wide;
        if (is_one(&walks[0], low, high) && is_one(&walks[1], low, high)) {
            low = high;
            wide *= 2;
        } else if (wide < narrow) {
            return high;
        } else {
            wide = fmin(wide, to - low) / 2;
        }
    }
    return to;
}

static const int *keep(struct arena *arena, const struct walk *walk)
{
    int *branch = ARENA_ARRAY(arena, walk->switches + 1, int);
    if (branch) memcpy(branch, walk->branch, walk->switches * sizeof *branch);
    return branch;
}

static enum curve_fault cut(struct curve *curve, struct arena *arena, struct walk walks[2], double *ends,
                            double *place)
{
    enum { most_pieces = 20000 };
    const double narrow = 1e-13 * (curve->to - curve->from);
    double p = curve->from;
    ends[0] = p;
    curve->piece_count = 0;
    while (p < curve->to) {
        *place = p;
        if (curve->piece_count == most_pieces) return curve_intricate;
        for (int k = 0; k < 2; k++) resolve(&walks[k], p);
        struct curve_piece *piece = &curve->pieces[curve->piece_count];
        *piece = (struct curve_piece){.branch_x = keep(arena, &walks[0]), .branch_y = keep(arena, &walks[1])};
        if (arena->failed) return curve_no_memory;
        double next = piece_end(walks, p, curve->to, narrow);
        /* The start lies on a switch that was taken for the other side: the stretch up to it is nothing. */
        if (next - p > 2 * narrow) ends[++curve->piece_count] = next;
        p = next;
    }
    return curve_made;
}

enum curve_fault curve_cut(struct curve *curve, struct arena *arena, double **ends, double *place)
{
    enum { most_pieces = 20000 };
    struct walk walks[2];
    bool first = start(&walks[0], curve->x), second = start(&walks[1], curve->y);
    bool switched = first && second && walks[0].switches + walks[1].switches > 0;
    size_t room = switched ? most_pieces : 1;
    curve->pieces = ARENA_ARRAY(arena, room, struct curve_piece);
    *ends = ARENA_ARRAY(arena, room + 1, double);
    enum curve_fault fault = curve_no_memory;
    if (first && second && !arena->failed) fault = cut(curve, arena, walks, *ends, place);
    end(&walks[0]);
    end(&walks[1]);
    return fault;
}
