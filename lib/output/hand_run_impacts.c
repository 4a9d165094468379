/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Impulses of contacts, ropes and rolling bodies in an impact of a run, and their works.
 *
 * The velocities jump by dv = sum P_j w_j; w_j are those that a unit impulse along row j gives to all bodies through every
 * joint and two-sided coupling (dynamics/impulse.h), or along a slide that they load and that has friction. The P_j follow
 * by least squares, and are the impulses if they explain all of dv. A quantity that changes along a null vector of the w_j,
 * as the share of each of two points of a face, or of a wall and of friction along one slide, is not known.
 *
 * A diagram whose multipliers are P_j has the impulses in place of the forces. With the mean of the velocities before and
 * after, its powers are the works (Thomson and Tait); of several impulses on a body only their sum is one, since the order
 * in which they act is not known.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/friction.h"
#include "dynamics/impulse.h"
#include "numeric/qr.h"
#include "numeric/tolerances.h"
#include "output/hand_run_judge.h"

struct hand_impact {
    struct hand_run *run;
    const double *before, *after; /* the velocities of all coordinates */
    int row_count, slide_count;
    int *rows, *slides, *modes;
    double *P;                         /* of each row and slide, */
    double largest;                    /* and the largest of them */
    double *open;                      /* of each absolute: how much of its value is not determined */
    double *W, *B, *answers, *columns; /* of impulse_answers; and columns[n x count] */
    bool explained;                    /* they give the jump of all velocities */
};

/* ---- the rows of what touches, is taut or rolls */

static void close_meeting(struct hand_run *run, int index)
{
    const struct tree *tree = run->model->tree;
    const double near = 1e-9 * tree->meetings[index].size;
    int features[2], next = 0;
    const int count = meeting_touching(run->model, run->state->tree, index, near, features);
    for (int i = 0; i < tree->coupling_count; i++)
        if (tree->couplings[i].meeting == index)
            run->state->tree->couplings[i].feature = next < count ? features[next++] : no_feature;
}

static bool takes_part(const struct hand_run *run, int i)
{
    const struct coupling *coupling = &run->model->tree->couplings[i];
    const struct instant at = state_instant(run->state);
    if (coupling->meeting >= 0) return run->state->tree->couplings[i].feature != no_feature;
    const int mode = coupling->kind == constraint_rope ? coupling->pair : coupling->surface;
    if (mode < 0 || (coupling->kind != constraint_rope && !coupling_takes_impulses(coupling))) return false;
    const struct one_sided now = one_sided_at(run->model, &at, mode);
    return run->state->slip[mode] == stick || fabs(now.excess) <= now.near;
}

static void find_rows(struct hand_impact *impact)
{
    struct hand_run *run = impact->run;
    const struct tree *tree = run->model->tree;
    impulse_look(run->state);
    for (int i = 0; i < tree->meeting_count; i++) close_meeting(run, i);
    impulse_look(run->state);
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (!takes_part(run, i)) continue;
        const bool slips =
            coupling->meeting < 0 || coupling->pair >= 0; /* contacts without friction have no tangent */
        impact->rows[impact->row_count++] = coupling->first_row;
        if (coupling->row_count > 1 && coupling->kind != constraint_rope && slips)
            impact->rows[impact->row_count++] = coupling->first_row + 1;
    }
}

/* The answers to the rows, and to the friction of slides that they load. */
static void find_answers(struct hand_impact *impact)
{
    const struct fbd_model *model = impact->run->model;
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++)
        if (friction_takes_impulses(model, &model->plan.modes[pair]))
            impact->slides[impact->slide_count++] = pair;
    struct impulse_lines lines = {impact->row_count, impact->slide_count, impact->rows, impact->slides};
    impulse_answers(impact->run->state, &lines, impact->modes, impact->W, impact->B, impact->answers);
    if (impulse_loaded_slides(&lines, impact->W, impact->B, impact->modes) < impact->slide_count) {
        int kept = 0;
        for (int i = 0; i < impact->slide_count; i++)
            if (impact->modes[i]) impact->slides[kept++] = impact->slides[i];
        impact->slide_count = lines.slide_count = kept;
        impulse_answers(impact->run->state, &lines, impact->modes, impact->W, impact->B, impact->answers);
    }
    impulse_look(impact->run->state);
}

/* ---- values */

static bool is_of_row(const struct hand_impact *impact, int coupling)
{
    for (int i = 0; i < impact->row_count; i++)
        if (impact->run->model->tree->coupling_of_row[impact->rows[i]] == coupling) return true;
    return false;
}

/* Is its impulse that of the rows? Zero where it is a coupling that does not touch. */
static bool is_known(const struct hand_impact *impact, int body, const struct arrow *arrow)
{
    const struct fbd_model *model = impact->run->model;
    struct coupling_place place;
    if (!coupling_of_force(model, body, arrow->name, &place)) return false;
    const struct coupling *coupling = &model->tree->couplings[place.coupling];
    return is_of_row(impact, place.coupling) || coupling->meeting >= 0 || coupling->kind == constraint_rope;
}

static void set_multipliers(struct hand_impact *impact, const double *P)
{
    struct tree_work *work = impact->run->state->tree;
    for (int j = 0; j < impact->run->model->tree->row_count; j++) work->rows[j].lambda = 0;
    for (int i = 0; i < impact->row_count; i++) work->rows[impact->rows[i]].lambda = P[i];
}

/* The impulses of a sum with the present multipliers, or their work: NAN where another one has a work on the body. */
static double value_of(const struct hand_impact *impact, size_t k)
{
    struct hand_run *run = impact->run;
    const struct fbd_model *model = run->model;
    const struct hand_sum *sum = &run->named.of[k];
    const struct instant at = state_instant(run->state);
    const bool work = model->absolutes[k].kind == absolute_work;
    double value = 0;
    for (size_t i = 0; i < sum->count; i++) {
        const struct hand_force *force = sum->forces[i];
        const int body = force->name.body;
        const size_t arrows = diagram_fill(model, body, &at, run->state->slots, run->named.arrows);
        if (!is_known(impact, body, &run->named.arrows[force->arrow])) continue;
        if (work)
            value += run->named.arrows[force->arrow].power;
        else
            value += sum->signs[i] * hand_force_value(model, force, &at, run->named.arrows);
        for (size_t a = 0; work && a < arrows; a++) {
            bool named = !is_known(impact, body, &run->named.arrows[a]) || run->named.arrows[a].power == 0;
            for (size_t s = 0; !named && s < sum->count; s++)
                named = sum->forces[s]->name.body == body && sum->forces[s]->arrow == a;
            if (!named) return NAN;
        }
    }
    return value;
}

/* ---- the whole */

/* How much the values change along the null vectors, which are as large as the impulses. */
static void set_open(struct hand_impact *impact, size_t count, const double *null, size_t open)
{
    const struct fbd_model *model = impact->run->model;
    memset(impact->open, 0, model->absolute_count * sizeof *impact->open);
    for (size_t v = 0; v < open; v++) {
        set_multipliers(impact, null + v * count);
        for (size_t k = 0; k < model->absolute_count; k++)
            if (is_integral(model, k)) impact->open[k] += fabs(impact->largest * value_of(impact, k));
    }
}

/* Remove from the impulses their part along the null vectors. */
static void set_least(struct hand_impact *impact, size_t count, const double *null, size_t open)
{
    for (size_t v = 0; v < open; v++) {
        double share = 0;
        for (size_t j = 0; j < count; j++) share += null[v * count + j] * impact->P[j];
        for (size_t j = 0; j < count; j++) impact->P[j] -= share * null[v * count + j];
    }
}

/* The least impulses that give the jump. False when memory is out. */
static bool solve(struct hand_impact *impact)
{
    const double rounding = 1e-9;
    const size_t n = (size_t)impact->run->model->plan.n,
                 count = (size_t)impact->row_count + (size_t)impact->slide_count;
    double *jump = impact->answers + count * n, *used = calloc(n + count * count + 1, sizeof *used);
    double *null = used + n, size = 0;
    struct qr qr = {0};
    for (size_t i = 0; i < n; i++) {
        jump[i] = impact->after[i] - impact->before[i];
        size = fmax(size, fabs(impact->after[i]) + fabs(impact->before[i]));
        for (size_t j = 0; j < count; j++) impact->columns[i * count + j] = impact->answers[j * n + i];
    }
    const bool done = used && qr_decompose(&qr, n, count, impact->columns, solved_rounding);
    memset(impact->P, 0, count * sizeof *impact->P);
    if (done) {
        memcpy(used, jump, n * sizeof *used);
        qr_add_solution(&qr, used, impact->P);
        qr_set_orthonormal_null(&qr, null);
        set_least(impact, count, null, count - qr.rank);
    }
    impact->largest = 0;
    for (size_t j = 0; j < count; j++) impact->largest = fmax(impact->largest, fabs(impact->P[j]));
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < count; j++) jump[i] -= impact->columns[i * count + j] * impact->P[j];
        impact->explained = impact->explained && fabs(jump[i]) <= rounding * size;
    }
    if (done) set_open(impact, count, null, count - qr.rank);
    qr_free(&qr);
    free(used);
    return done;
}

static bool has_jumped(const struct hand_impact *impact, int index)
{
    const struct model_body *body = &impact->run->model->bodies[index];
    return memcmp(impact->before + body->first, impact->after + body->first,
                  (size_t)body->count * sizeof *impact->before) != 0;
}

/* Add what the impulses of one sum are; NAN where they are not known. */
static void add_to(struct hand_impact *impact, size_t k)
{
    struct hand_run *run = impact->run;
    const struct hand_sum *sum = &run->named.of[k];
    const double rounding = 1e-9;
    bool known = impact->explained, any = false;
    for (size_t i = 0; i < sum->count; i++) {
        const int body = sum->forces[i]->name.body;
        const struct arrow *arrow = hand_run_arrow(run, sum->forces[i]);
        if (!hand_run_is_impulsive(run->model, arrow->load) || !has_jumped(impact, body)) continue;
        any = true;
        known = known && is_known(impact, body, arrow);
    }
    if (!any) return;
    const double value = known ? value_of(impact, k) : NAN;
    known = known && impact->open[k] <= rounding * fmax(fabs(value), impact->largest);
    run->integrals[k] += known ? value : NAN;
}

/* Room for all impacts of a run; NULL when memory is out. */
static struct hand_impact *impact_new(struct hand_run *run)
{
    const struct fbd_model *model = run->model;
    const size_t n = (size_t)model->plan.n, slides = model->plan.mode_count,
                 rows = 2 * (size_t)model->tree->coupling_count, all = rows + slides;
    struct hand_impact *impact = ARENA_NEW(&run->arena, struct hand_impact);
    if (!impact) return NULL;
    *impact = (struct hand_impact){.run = run,
                                   .rows = ARENA_ARRAY(&run->arena, rows + 1, int),
                                   .slides = ARENA_ARRAY(&run->arena, slides + 1, int),
                                   .modes = ARENA_ARRAY(&run->arena, slides + 1, int),
                                   .P = ARENA_ARRAY(&run->arena, all + 1, double),
                                   .open = ARENA_ARRAY(&run->arena, model->absolute_count + 1, double),
                                   .W = ARENA_ARRAY(&run->arena, all * all + 1, double),
                                   .B = ARENA_ARRAY(&run->arena, slides * all + 1, double),
                                   .answers = ARENA_ARRAY(&run->arena, (all + 1) * n, double),
                                   .columns = ARENA_ARRAY(&run->arena, all * n + 1, double)};
    return run->arena.failed ? NULL : impact;
}

bool hand_run_add_impact(struct hand_run *run, const double *before, const double *after)
{
    const struct fbd_model *model = run->model;
    const size_t n = (size_t)model->plan.n;
    if (!run->impact) run->impact = impact_new(run);
    struct hand_impact *impact = run->impact;
    if (!impact) return false;
    impact->before = before;
    impact->after = after;
    impact->row_count = impact->slide_count = 0;
    if (tree_joins(model->tree)) {
        for (size_t i = 0; i < n; i++) run->state->y[n + i] = (before[i] + after[i]) / 2;
        find_rows(impact);
    }
    impact->explained = impact->row_count > 0;
    if (impact->row_count > 0) {
        find_answers(impact);
        if (!solve(impact)) return false;
        set_multipliers(impact, impact->P);
    }
    for (size_t k = 0; k < model->absolute_count; k++)
        if (is_integral(model, k) && !run->by_ledger[k]) add_to(impact, k);
    return true;
}
