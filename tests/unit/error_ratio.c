/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "error_ratio.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "api/record.h"
#include "fbd_study.h"
#include "fbd_view.h"

enum { grid = 1000, late = grid - 1, most_arrows = 32, energies = 3 };

static const size_t rows_kept = grid + 1;

const char *const ratio_names[ratio_kinds] = {
    "global error", "coordinate, largest", "coordinate, at end", "event time", "force", "energy, work"};

static const double tightest = 1e-14;
static const unsigned long most_rhs_of_truth = 30000000, most_rhs = 500000;

/* ---- what a run gives */

struct track {
    size_t n, width; /* coordinates; with their rates and the file's own states */
    size_t bodies, loads, events;
    double end;
    double *y;       /* (grid + 1) x width */
    double *errors;  /* the same, estimates */
    double *largest; /* width: sizes, over all steps */
    double *t, *t_error;
    fbd_arrow *arrows, *arrow_errors; /* bodies x most_arrows */
    double *work, *work_error;        /* loads + energies */
    double estimate;
    fbd_outcome outcome;
};

static void track_free(struct track *track)
{
    free(track->y);
    free(track->t);
    free(track->arrows);
    free(track->work);
    *track = (struct track){0};
}

static bool track_make(struct track *track, const fbd_model *model)
{
    size_t n = fbd_model_coordinate_count(model), bodies = fbd_model_body_count(model);
    size_t width = 2 * n + fbd_model_state_count(model);
    *track = (struct track){.n = n, .width = width, .bodies = bodies, .loads = model->load_count};
    track->y = calloc((2 * rows_kept + 1) * width, sizeof(double));
    track->errors = track->y ? track->y + rows_kept * width : NULL;
    track->largest = track->y ? track->y + 2 * rows_kept * width : NULL;
    track->arrows = calloc(2 * bodies * most_arrows, sizeof(fbd_arrow));
    track->arrow_errors = track->arrows + bodies * most_arrows;
    track->work = calloc(2 * (track->loads + energies), sizeof(double));
    track->work_error = track->work + track->loads + energies;
    return track->y && track->arrows && track->work;
}

/* Advance to the end, reading what lies on the grid. */
static bool take_motion(struct track *track, fbd_simulation *simulation, double until, unsigned long limit)
{
    const struct ensemble *run = simulation->ensemble;
    fbd_state *state = fbd_state_new(run->model);
    int k = 0;
    bool fine = state != NULL, bars = simulation->bars;
    while (fine && fbd_simulation_advance(simulation) <= FBD_BROKEN) {
        double from, to;
        fbd_simulation_interval(simulation, &from, &to);
        const double *y = ensemble_state(simulation->ensemble)->y;
        for (size_t i = 0; i < track->width; i++) track->largest[i] = fmax(track->largest[i], fabs(y[i]));
        for (; fine && k <= grid && until * k / grid <= to; k++) {
            double t = until * k / grid;
            size_t row = (size_t)k * track->width;
            fine = fbd_simulation_state(simulation, t, state) &&
                   (!bars || fbd_simulation_errors(simulation, t, track->errors + row));
            memcpy(track->y + row, state->y, track->width * sizeof(double));
        }
        if (run->outcome != FBD_GOING) break;
        fine = fine && fbd_simulation_stats(simulation).rhs < limit;
    }
    fbd_state_free(state);
    track->outcome = run->outcome;
    track->end = run->t;
    return fine && run->outcome >= FBD_DONE && run->outcome <= FBD_BROKEN;
}

/* Run to the end with the ledger. */
static bool take_ledger(struct track *track, const fbd_model *model, fbd_simulation *simulation)
{
    fbd_result *result = fbd_simulation_run(simulation, NULL);
    if (!result) return false;
    fbd_energy energy = fbd_result_energy(result), error = fbd_result_energy_error(result);
    double *work = track->work, *work_error = track->work_error;
    for (size_t b = 0; b < track->bodies; b++) {
        fbd_diagram(fbd_result_state(result), b, track->arrows + b * most_arrows, most_arrows);
        fbd_result_force_errors(result, b, track->arrow_errors + b * most_arrows, most_arrows);
    }
    for (size_t i = 0; i < track->loads; i++) {
        const char *body = model->bodies[model->loads[i].body].name, *load = model->loads[i].source->name;
        *work++ = fbd_result_work(result, body, load);
        *work_error++ = fbd_result_work_error(result, body, load);
    }
    *work++ = energy.kinetic, *work++ = energy.potential, *work++ = energy.work;
    *work_error++ = error.kinetic, *work_error++ = error.potential, *work_error++ = error.work;
    track->events = fbd_simulation_event_count(simulation);
    track->t = calloc(2 * track->events + 1, sizeof(double));
    track->t_error = track->t + track->events;
    for (size_t i = 0; i < track->events && track->t; i++) {
        fbd_event event = fbd_simulation_event(simulation, i);
        track->t[i] = event.t;
        track->t_error[i] = event.t_error;
    }
    track->estimate = fbd_simulation_stats(simulation).error_estimate;
    fbd_result_free(result);
    return track->t != NULL;
}

static bool track_run(struct track *track, const fbd_model *model, const fbd_options *options,
                      unsigned long limit)
{
    bool fine = track_make(track, model);
    fbd_errors *errors = fbd_errors_new();
    for (int pass = 0; pass < 2 && fine; pass++) {
        fbd_simulation *simulation = fbd_simulation_new(model, options, errors);
        double until = simulation ? simulation->ensemble->options.until : 0;
        fine = simulation && (pass == 0 ? take_motion(track, simulation, until, limit)
                                        : take_ledger(track, model, simulation));
        fbd_simulation_free(simulation);
    }
    fbd_errors_free(errors);
    if (!fine) track_free(track);
    return fine;
}

/* ---- the truth */

struct truth {
    const fbd_model *model;
    double until;
    struct track a, b;
    double *scale; /* of each number, as fbd_stats says */
};

static double *row(const struct track *track, int k)
{
    return track->y + (size_t)k * track->width;
}

static void take_scales(struct truth *truth)
{
    const double share = 1e-3;
    size_t n = truth->a.n;
    double *scale = truth->scale, *raw = truth->a.largest;
    const struct coordinate *c = truth->model->scene->coordinates;
    for (size_t i = 0; i < truth->a.width; i++) {
        scale[i] = raw[i];
        for (size_t k = 0; k < n && i < 2 * n; k++)
            if (c[k].body == c[i % n].body && c[k].angle == c[i % n].angle)
                scale[i] = fmax(scale[i], share * raw[i < n ? k : n + k]);
        if (i >= n && i < 2 * n) scale[i] = fmax(scale[i], share * raw[i - n] / truth->until);
    }
}

struct truth *truth_new(const fbd_model *model, exact_motion *exact)
{
    static const char *const methods[] = {"dop853", "rk8pd"};
    struct truth *truth = calloc(1, sizeof *truth);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = tightest;
    if (!truth) return NULL;
    truth->model = model;
    truth->scale =
        calloc(2 * fbd_model_coordinate_count(model) + fbd_model_state_count(model) + 1, sizeof(double));
    for (int i = 0; i < 2; i++) {
        options.method = methods[i];
        if (track_run(i == 0 ? &truth->a : &truth->b, model, &options, most_rhs_of_truth)) continue;
        truth_free(truth);
        return NULL;
    }
    truth->until = expr_value(model->scene->simulate.until.expr);
    take_scales(truth);
    for (int k = 0; k <= grid && exact; k++) exact(truth->until * k / grid, row(&truth->a, k));
    return truth;
}

void truth_free(struct truth *truth)
{
    if (!truth) return;
    track_free(&truth->a);
    track_free(&truth->b);
    free(truth->scale);
    free(truth);
}

/* Rows that all of them have; `track` may be NULL. */
static int rows_of(const struct truth *truth, const struct track *track)
{
    double share = fmin(truth->a.end, truth->b.end) / truth->until;
    if (track) share = fmin(share, track->end / truth->until);
    return share >= 1 ? grid + 1 : (int)(0.999 * share * grid) + 1;
}

double truth_floor(const struct truth *truth)
{
    double worst = 0;
    for (int k = 0; k < rows_of(truth, NULL); k++)
        for (size_t i = 0; i < truth->a.width; i++)
            if (truth->scale[i] > 0)
                worst = fmax(worst, fabs(row(&truth->a, k)[i] - row(&truth->b, k)[i]) / truth->scale[i]);
    return worst;
}

/* ---- ratios */

static unsigned long total(const struct ratio_counts *c)
{
    return c->low + c->good + c->high + c->floor + c->over;
}

double ratio_share(const struct ratio_counts *c)
{
    return total(c) > 0 ? (double)(c->good + c->floor) / (double)total(c) : NAN;
}

unsigned long ratio_determined(const struct ratio_counts *c)
{
    return c->low + c->good + c->high;
}

double ratio_determined_share(const struct ratio_counts *c)
{
    unsigned long all = ratio_determined(c);
    return all > 0 ? (double)c->good / (double)all : NAN;
}

struct trial_name {
    const char *method;
    double tolerance;
};

/* `uncertain`: how well the truth is known; `size`: of the quantity. */
static void count(struct ratio_table *table, enum ratio_kind kind, const struct trial_name *name,
                  const char *what, double estimate, double error, double uncertain, double size)
{
    const double low = 0.3, high = 10, clear = 4;
    struct ratio_counts *c = &table->counts[kind];
    double floor = clear * fmax(uncertain, 4 * DBL_EPSILON * size);
    bool bad = false;
    if (error > 0 && error >= floor) {
        double ratio = estimate / error; /* error > 0 */
        bad = !(ratio >= low && ratio <= high);
        (ratio < low ? &c->low : ratio <= high ? &c->good : &c->high)[0]++;
    } else {
        bad = !(estimate <= high * floor);
        (bad ? &c->over : &c->floor)[0]++;
    }
    if (bad && table->verbose)
        printf("#   %s at %g: %s, %s: estimate %.3g, error %.3g, floor %.3g\n", name->method, name->tolerance,
               ratio_names[kind], what, estimate, error, floor);
}

static const char *name_of(const fbd_model *model, size_t i)
{
    size_t n = fbd_model_coordinate_count(model);
    if (i >= 2 * n) return fbd_model_state(model, i - 2 * n).name;
    fbd_coordinate c = fbd_model_coordinate(model, i % n);
    return i < n ? c.name : c.rate_name;
}

static void count_motion(struct ratio_table *table, const struct truth *truth, const struct track *track,
                         const struct trial_name *name)
{
    double global = 0, uncertain = 0;
    int rows = rows_of(truth, track);
    for (size_t i = 0; i < track->width; i++) {
        double estimate = 0, error = 0, doubt = 0, scale = truth->scale[i];
        const char *what = name_of(truth->model, i);
        for (int k = 0; k < rows; k++) {
            double e = track->errors[(size_t)k * track->width + i], a = row(&truth->a, k)[i],
                   b = row(&truth->b, k)[i], d = fabs(row(track, k)[i] - a);
            estimate = fmax(estimate, e);
            error = fmax(error, d);
            doubt = fmax(doubt, fabs(a - b));
            if (k == (rows > late ? late : rows - 1))
                count(table, ratio_end, name, what, e, d, fabs(a - b), scale);
        }
        count(table, ratio_largest, name, what, estimate, error, doubt, scale);
        if (scale > 0) {
            global = fmax(global, error / scale);
            uncertain = fmax(uncertain, doubt / scale);
        }
    }
    count(table, ratio_global, name, "", track->estimate, global, uncertain, 1);
}

static void count_events(struct ratio_table *table, const struct truth *truth, const struct track *track,
                         const struct trial_name *name)
{
    double estimate = 0, error = 0, doubt = 0;
    const struct track *a = &truth->a, *b = &truth->b;
    if (track->events == 0 || a->events != track->events || b->events != track->events) return;
    for (size_t i = 0; i < track->events; i++) {
        estimate = fmax(estimate, track->t_error[i]);
        error = fmax(error, fabs(track->t[i] - a->t[i]));
        doubt = fmax(doubt, fabs(a->t[i] - b->t[i]));
    }
    count(table, ratio_event, name, "", estimate, error, doubt, track->end);
}

static void count_force(struct ratio_table *table, const struct trial_name *name, const fbd_arrow *got,
                        const fbd_arrow *error, const fbd_arrow *a, const fbd_arrow *b)
{
    double size = fmax(hypot(a->fx, a->fy), fabs(a->couple));
    count(table, ratio_force, name, got->name, error->fx, fabs(got->fx - a->fx), fabs(a->fx - b->fx), size);
    count(table, ratio_force, name, got->name, error->fy, fabs(got->fy - a->fy), fabs(a->fy - b->fy), size);
    if (a->moment != 0)
        count(table, ratio_force, name, got->name, error->moment, fabs(got->moment - a->moment),
              fabs(a->moment - b->moment), fmax(fabs(a->moment), size));
}

/* At the end, where all runs end at the same time. */
static void count_ledger(struct ratio_table *table, const struct truth *truth, const struct track *track,
                         const struct trial_name *name)
{
    const struct track *a = &truth->a, *b = &truth->b;
    if (track->outcome != FBD_DONE || a->outcome != FBD_DONE) return;
    for (size_t i = 0; i < track->bodies * most_arrows; i++)
        if (track->arrows[i].name)
            count_force(table, name, &track->arrows[i], &track->arrow_errors[i], &a->arrows[i],
                        &b->arrows[i]);
    double size = 0;
    for (size_t i = 0; i < track->loads + energies; i++) size = fmax(size, fabs(a->work[i]));
    for (size_t i = 0; i < track->loads + energies; i++) {
        const char *what = i < track->loads ? truth->model->loads[i].source->name : "energy";
        count(table, ratio_energy, name, what, track->work_error[i], fabs(track->work[i] - a->work[i]),
              fabs(a->work[i] - b->work[i]), size);
    }
}

bool ratio_add(struct ratio_table *table, const struct truth *truth, const char *method, double tolerance,
               double step)
{
    struct track track;
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = method;
    options.tolerance = tolerance;
    options.step = step;
    options.error_bars = true;
    if (!track_run(&track, truth->model, &options, most_rhs)) return false;
    struct trial_name name = {method, tolerance > 0 ? tolerance : step};
    if (track.outcome == truth->a.outcome) {
        count_motion(table, truth, &track, &name);
        count_events(table, truth, &track, &name);
        count_ledger(table, truth, &track, &name);
    }
    track_free(&track);
    return true;
}
