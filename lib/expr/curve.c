/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/curve.h"

#include <stdlib.h>
#include <string.h>

#include "expr/curve_panel.h"

struct curve_jet curve_jet_at(const struct curve *curve, const struct curve_piece *piece, double p)
{
    struct curve_jet jet;
    double same;
    jet.r.x = expr_eval_second(curve->x, 0, &p, 1, 1, piece->branch_x, &jet.d.x, &same, &jet.dd.x);
    jet.r.y = expr_eval_second(curve->y, 0, &p, 1, 1, piece->branch_y, &jet.d.y, &same, &jet.dd.y);
    return jet;
}

/* ---- construction */

static bool agree(struct vec a, struct vec b, double size)
{
    const double rounding = 1e-8;
    return vec_norm(vec_sub(a, b)) <= rounding * size;
}

/* Check continuity between a piece and the next one. */
static enum curve_fault check_joint(struct curve *curve, int piece, double p)
{
    const struct curve_piece *pieces = curve->pieces;
    struct curve_jet before = curve_jet_at(curve, &pieces[piece], p),
                     after = curve_jet_at(curve, &pieces[piece + 1], p);
    double step = vec_norm(before.d) * (curve->to - curve->from);
    struct vec e = curve_jet_direction(&before);
    if (!agree(before.r, after.r, vec_norm(before.r) + step)) return curve_jump;
    if (!agree(e, curve_jet_direction(&after), 10)) return curve_corner;
    double bend = curve_jet_bend(&before), next = curve_jet_bend(&after);
    if (fabs(next - bend) * step > 1e-6 * (1 + (fabs(bend) + fabs(next)) * step)) {
        if (!curve->kinked) curve->kink = p;
        curve->kinked = true;
    }
    return curve_made;
}

/* Fit the panels of all pieces, cut also at p = 0, so that s = 0 is exact there. */
static enum curve_fault fit_all(struct curve *curve, const double *ends, struct panel_list *list,
                                double *place)
{
    for (int i = 0; i < curve->piece_count; i++) {
        struct curve_piece *piece = &curve->pieces[i];
        double cuts[3] = {ends[i], 0, ends[i + 1]};
        bool inside = ends[i] < 0 && 0 < ends[i + 1];
        if (!inside) cuts[1] = cuts[2];
        piece->first = list->count;
        for (int k = 0; k < (inside ? 2 : 1); k++) {
            enum curve_fault fault = curve_fit(curve, piece, cuts[k], cuts[k + 1], list, place);
            if (fault != curve_made) return fault;
        }
        piece->count = list->count - piece->first;
        *place = ends[i];
        enum curve_fault fault = i > 0 ? check_joint(curve, i - 1, ends[i]) : curve_made;
        if (fault != curve_made) return fault;
    }
    return curve_made;
}

static double angle_between(struct vec a, struct vec b)
{
    return atan2(vec_cross(a, b), vec_dot(a, b));
}

/* Sum up lengths and angles of the panels, with s = 0 at p = 0. */
static enum curve_fault count_up(struct curve *curve, double *place)
{
    struct curve_panel *panels = curve->panels;
    int zero = 0;
    panels[0].angle = atan2(panels[0].e.y, panels[0].e.x);
    for (int i = 1; i < curve->panel_count; i++) {
        struct curve_panel *before = &panels[i - 1], *panel = &panels[i];
        *place = panel->p;
        if (!agree(before->end, panel->e, 10)) return curve_corner;
        panel->angle = before->angle + angle_between(before->e, panel->e);
        if (panel->p <= 0) zero = i;
    }
    if (panels[zero].p != 0) zero = 0;
    long double s = 0;
    for (int i = zero; i < curve->panel_count; i++) {
        panels[i].s = (double)s;
        s += panels[i].length;
    }
    long double end = s;
    s = 0;
    for (int i = zero - 1; i >= 0; i--) {
        s -= panels[i].length;
        panels[i].s = (double)s;
    }
    const struct curve_panel *last = &panels[curve->panel_count - 1];
    curve->start = (double)s;
    curve->length = (double)(end - s);
    curve->turning = last->angle + angle_between(last->e, last->end) - panels[0].angle;
    return curve_made;
}

/* Check that the ends of a closed curve meet. */
static enum curve_fault check_closed(struct curve *curve, double *place)
{
    const struct curve_piece *last = &curve->pieces[curve->piece_count - 1];
    struct curve_jet begin = curve_jet_at(curve, &curve->pieces[0], curve->from),
                     end = curve_jet_at(curve, last, curve->to);
    struct vec e = curve_jet_direction(&begin);
    *place = curve->to;
    if (!agree(begin.r, end.r, curve->length)) return curve_open;
    if (!agree(e, curve_jet_direction(&end), 10)) return curve_bent;
    double bend = curve_jet_bend(&begin), next = curve_jet_bend(&end);
    if (fabs(next - bend) * curve->length > 1e-6 * (1 + fabs(bend) * curve->length)) {
        if (!curve->kinked) curve->kink = curve->to;
        curve->kinked = true;
    }
    return curve_made;
}

/* The pieces as a table of s, whose values are s itself: only its switches are used. */
static enum curve_fault make_ends(struct curve *curve, struct arena *arena, const char *name)
{
    if (curve->closed && curve->piece_count == 1 && !curve->kinked) return curve_made;
    size_t count = (size_t)curve->piece_count + 1;
    double *x = ARENA_ARRAY(arena, count, double), *c = ARENA_ARRAY(arena, 4 * (count - 1), double);
    curve->ends = ARENA_ARRAY(arena, 1, struct table);
    if (!x || !c || !curve->ends) return curve_no_memory;
    for (size_t i = 0; i + 1 < count; i++) x[i] = curve->panels[curve->pieces[i].first].s;
    x[count - 1] = curve->start + curve->length;
    struct table table = {.name = name,
                          .x_dim = DIM_LENGTH,
                          .y_dim = DIM_LENGTH,
                          .interpolation = table_linear,
                          .beyond = curve->closed ? table_repeat : table_error};
    enum table_status status = table_make(&table, count, x, x);
    if (status != table_made) return status == table_no_memory ? curve_no_memory : curve_intricate;
    memcpy(x, table.x, count * sizeof *x);
    memcpy(c, table.c, 4 * (count - 1) * sizeof *c);
    table_drop(&table);
    table.x = x;
    table.c = c;
    *curve->ends = table;
    return curve_made;
}

static enum curve_fault make_panels(struct curve *curve, struct arena *arena, const double *ends,
                                    double *place)
{
    struct panel_list list = {0};
    enum curve_fault fault = fit_all(curve, ends, &list, place);
    if (fault == curve_made) {
        curve->panel_count = list.count;
        curve->panels = ARENA_ARRAY(arena, (size_t)list.count, struct curve_panel);
        if (curve->panels && list.panels)
            memcpy(curve->panels, list.panels, (size_t)list.count * sizeof *list.panels);
        else
            fault = curve_no_memory;
    }
    free(list.panels);
    return fault;
}

static void take_samples(struct curve *curve)
{
    for (int i = 0; i < curve->piece_count; i++)
        for (int k = 0; k < curve->pieces[i].count; k++) {
            struct curve_panel *panel = &curve->panels[curve->pieces[i].first + k];
            for (int j = 0; j <= panel_samples; j++) {
                double p = panel->p + panel->wide * j / panel_samples;
                panel->at[j] = (struct vec){expr_eval(curve->x, 0, &p, curve->pieces[i].branch_x),
                                            expr_eval(curve->y, 0, &p, curve->pieces[i].branch_y)};
            }
        }
}

enum curve_fault curve_make(struct curve *curve, struct arena *arena, const char *name, double *place)
{
    double *ends;
    enum curve_fault fault = curve_cut(curve, arena, &ends, place);
    if (fault == curve_made) fault = make_panels(curve, arena, ends, place);
    if (fault == curve_made) fault = count_up(curve, place);
    if (fault == curve_made && curve->closed) fault = check_closed(curve, place);
    if (fault == curve_made) fault = make_ends(curve, arena, name);
    if (fault == curve_made) take_samples(curve);
    return fault;
}

/* ---- evaluation */

/* Piece and panel at an arc length, s within the first round, and the distance beyond the end of the piece. */
struct spot {
    const struct curve_piece *piece;
    const struct curve_panel *panel;
    double s, beyond, rounds;
};

static int piece_of(const struct curve *curve, double s)
{
    int low = 0, high = curve->piece_count;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (curve->panels[curve->pieces[middle].first].s <= s)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double round_of(const struct curve *curve, const int *piece, double s)
{
    if (!curve->closed) return 0;
    return piece ? floor((double)*piece / curve->piece_count) : floor((s - curve->start) / curve->length);
}

static struct spot find(const struct curve *curve, const int *piece, double s)
{
    struct spot spot = {.rounds = round_of(curve, piece, s)};
    spot.s = s - spot.rounds * curve->length;
    int index = !piece          ? piece_of(curve, spot.s)
                : curve->closed ? (int)(*piece - spot.rounds * curve->piece_count)
                                : *piece;
    if (index < 0) index = 0;
    if (index >= curve->piece_count) index = curve->piece_count - 1;
    spot.piece = &curve->pieces[index];
    const struct curve_panel *first = &curve->panels[spot.piece->first],
                             *last = first + spot.piece->count - 1;
    double inside = fmin(fmax(spot.s, first->s), last->s + last->length);
    int low = 0, high = spot.piece->count;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (first[middle].s <= inside)
            low = middle;
        else
            high = middle;
    }
    spot.panel = first + low;
    spot.beyond = spot.s - inside;
    spot.s = inside;
    return spot;
}

static double within(const struct spot *spot)
{
    return 2 * (spot->s - spot->panel->s) / spot->panel->length - 1;
}

static double parameter_of(const struct spot *spot)
{
    return spot->panel->p + spot->panel->wide * series_at(spot->panel->u, panel_order, within(spot));
}

/* Continue along the circle of curvature. */
static void go_beyond(struct curve_place *place, double ds)
{
    double turn = place->bend * ds;
    struct vec way = fabs(turn) < 1e-4 ? (struct vec){ds * (1 - turn * turn / 6), ds * turn / 2}
                                       : (struct vec){sin(turn) / place->bend, (1 - cos(turn)) / place->bend};
    place->r = vec_add(place->r, vec_turn(place->e, way));
    place->e = vec_turn(place->e, vec_cos_sin(turn));
    place->angle += turn;
    place->slope = 0;
}

struct curve_place curve_at(const struct curve *curve, const int *piece, double s)
{
    struct spot spot = find(curve, piece, s);
    struct curve_jet jet = curve_jet_at(curve, spot.piece, parameter_of(&spot));
    double slopes[panel_order];
    series_slopes(spot.panel->bend, panel_order, slopes);
    struct curve_place place = {.r = jet.r, .e = curve_jet_direction(&jet), .bend = curve_jet_bend(&jet)};
    place.angle = spot.panel->angle + angle_between(spot.panel->e, place.e) + spot.rounds * curve->turning;
    place.slope = series_at(slopes, panel_order, within(&spot)) * 2 / spot.panel->length;
    if (spot.beyond != 0) go_beyond(&place, spot.beyond);
    return place;
}

double curve_slope_rate(const struct curve *curve, const int *piece, double s)
{
    struct spot spot = find(curve, piece, s);
    if (spot.beyond != 0) return 0;
    double slopes[panel_order], rates[panel_order], per = 2 / spot.panel->length;
    series_slopes(spot.panel->bend, panel_order, slopes);
    series_slopes(slopes, panel_order, rates);
    return series_at(rates, panel_order, within(&spot)) * per * per;
}

double curve_parameter(const struct curve *curve, double s)
{
    struct spot spot = find(curve, NULL, s);
    return parameter_of(&spot);
}

double curve_length_at(const struct curve *curve, double p)
{
    int low = 0, high = curve->panel_count;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (curve->panels[middle].p <= p)
            low = middle;
        else
            high = middle;
    }
    const struct curve_panel *panel = &curve->panels[low];
    double wanted = (p - panel->p) / panel->wide, x = 2 * wanted - 1, slopes[panel_order];
    series_slopes(panel->u, panel_order, slopes);
    for (int i = 0; i < 50; i++) {
        double step = (series_at(panel->u, panel_order, x) - wanted) / series_at(slopes, panel_order, x);
        x = fmin(fmax(x - step, -1), 1);
        if (!(fabs(step) > 4e-16)) break;
    }
    return wanted == 0 ? panel->s : panel->s + panel->length * (1 + x) / 2;
}

/* A panel is skipped by its length, which bounds the distance between any two of its points. */
double curve_nearer(const struct curve *curve, struct vec r, double distance)
{
    double nearest = (double)NAN;
    for (int k = 0; k < curve->panel_count; k++) {
        const struct curve_panel *panel = &curve->panels[k];
        if (!(vec_norm(vec_sub(panel->at[panel_samples / 2], r)) < distance + panel->length)) continue;
        for (int j = 0; j <= panel_samples; j++) {
            double away = vec_norm(vec_sub(panel->at[j], r));
            if (away < distance) distance = away, nearest = panel->p + panel->wide * j / panel_samples;
        }
    }
    return isnan(nearest) ? nearest : curve_length_at(curve, nearest);
}

double curve_near(const struct curve *curve, struct vec r)
{
    double s = curve_nearer(curve, r, HUGE_VAL);
    return isnan(s) ? curve_length_at(curve, curve->from) : s;
}
