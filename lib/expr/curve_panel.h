/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The parts of a curve (curve.h).
 */
#ifndef FBD_EXPR_CURVE_PANEL_H
#define FBD_EXPR_CURVE_PANEL_H

#include "expr/curve.h"

enum { panel_order = 24, panel_samples = 16 };

struct curve_panel {
    double p, wide;        /* from p to p + wide */
    double s, length;      /* from s to s + length */
    double angle;          /* of the direction at its start, continuous from panel to panel */
    struct vec e, end;     /* directions at its start and end */
    double u[panel_order]; /* (p(s) - p) / wide as a series in s */
    double bend[panel_order];
    struct vec at[panel_samples + 1]; /* points, equidistant in p, for the search of the nearest one */
};

struct curve_piece {
    int first, count; /* panels */
    const int *branch_x, *branch_y;
};

/* Values and derivatives of the formulas at p. */
struct curve_jet {
    struct vec r, d, dd;
};
struct curve_jet curve_jet_at(const struct curve *curve, const struct curve_piece *piece, double p);

static inline double curve_jet_bend(const struct curve_jet *jet)
{
    double speed = vec_norm(jet->d);
    return vec_cross(jet->d, jet->dd) / (speed * speed * speed);
}

static inline struct vec curve_jet_direction(const struct curve_jet *jet)
{
    return vec_scale(1 / vec_norm(jet->d), jet->d);
}

/* The sum of c_k T_k(x), with half of c_0. */
double series_at(const double *c, int n, double x);
/* The coefficients of its derivative. */
void series_slopes(const double *c, int n, double *slopes);

/* Find the pieces of a curve, between the switches of its formulas (curve_pieces.c). *ends receives their
 * ends in p, one more than there are pieces. */
enum curve_fault curve_cut(struct curve *curve, struct arena *arena, double **ends, double *place);

/* Cut one piece into panels (curve_panels.c). */
struct panel_list {
    struct curve_panel *panels;
    int count, room;
    long looks; /* number of intervals tested for hidden variation; too many make a curve intricate */
};
enum curve_fault curve_fit(const struct curve *curve, const struct curve_piece *piece, double from, double to,
                           struct panel_list *list, double *place);

#endif
