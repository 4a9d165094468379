/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pieces of a curve: intervals of p on which its formulas keep their branches (pieces.h).
 */
#include "expr/curve_panel.h"
#include "expr/pieces.h"

static const int *keep(struct arena *arena, const struct expr *expr, const double *ends)
{
    int *branch = ARENA_ARRAY(arena, expr_switches(expr) + 1, int);
    bool kept = branch && pieces_branches(expr, 1, ends[0], ends[1], branch);
    return kept ? branch : NULL;
}

static enum curve_fault keep_all(struct curve *curve, struct arena *arena, const double *ends)
{
    for (int i = 0; i < curve->piece_count; i++) {
        struct curve_piece *piece = &curve->pieces[i];
        *piece = (struct curve_piece){.branch_x = keep(arena, curve->x, ends + i),
                                      .branch_y = keep(arena, curve->y, ends + i)};
        if (!piece->branch_x || !piece->branch_y) return curve_no_memory;
    }
    return curve_made;
}

enum curve_fault curve_cut(struct curve *curve, struct arena *arena, double **ends, double *place)
{
    enum { most_pieces = 20000 };
    const struct expr *formulas[] = {curve->x, curve->y};
    bool switched = expr_switches(curve->x) + expr_switches(curve->y) > 0;
    int room = switched ? most_pieces : 1;
    *ends = ARENA_ARRAY(arena, (size_t)room + 1, double);
    if (!*ends) return curve_no_memory;
    int pieces = pieces_cut(formulas, 2, 1, curve->from, curve->to, room, *ends);
    *place = (*ends)[pieces == pieces_too_many ? room : 0];
    if (pieces == pieces_too_many) return curve_intricate;
    curve->piece_count = pieces;
    curve->pieces = ARENA_ARRAY(arena, (size_t)pieces, struct curve_piece);
    return pieces > 0 && curve->pieces ? keep_all(curve, arena, *ends) : curve_no_memory;
}
