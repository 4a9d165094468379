/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/run_record.h"

#include <stdlib.h>
#include <string.h>

/* Numbers kept in rows (8 bytes each), and in the envelope (4 bytes). */
enum { most_numbers = 4 * 1024 * 1024, least_rows = 256, least_buckets = 16, most_buckets = 2048 };

/* Default number of regular rows: enough to play the run smoothly when its steps are long. */
enum { many_coordinates = 8, regular_rows = 2000, default_intervals = 500 };

/* ---- rows */

/* Choose the number of pieces of the envelope: at most twice that of rows, and a power of two, since they are
 * joined in pairs. */
static void choose_buckets(struct record *record, size_t rows)
{
    size_t cells = most_numbers / 2 / record->column_count;
    record->bucket_count = most_buckets;
    while (record->bucket_count > least_buckets &&
           (record->bucket_count > cells || record->bucket_count > 2 * rows))
        record->bucket_count /= 2;
}

/* Mark the pieces from `first` on as empty. */
static void clear_envelope(struct record *record, size_t first)
{
    size_t columns = record->column_count;
    for (size_t i = first * columns; i < record->bucket_count * columns; i++) {
        record->envelope[2 * i] = HUGE_VALF;
        record->envelope[2 * i + 1] = -HUGE_VALF;
    }
}

static bool make_room(struct record *record, size_t rows)
{
    size_t columns = record->column_count, most = most_numbers / columns;
    record->room = most < least_rows ? least_rows : most;
    record->stride = 1;
    record->times = malloc(record->room * sizeof *record->times);
    record->rows = malloc(record->room * columns * sizeof *record->rows);
    record->kept = malloc(record->room * sizeof *record->kept);
    record->values = calloc(columns, sizeof *record->values);
    choose_buckets(record, rows);
    record->envelope = malloc(2 * record->bucket_count * columns * sizeof *record->envelope);
    if (!record->times || !record->rows || !record->kept || !record->values || !record->envelope)
        return false;
    clear_envelope(record, 0);
    return true;
}

/* Drop every second row, except those to be kept. */
static void halve(struct record *record)
{
    size_t columns = record->column_count, to = 0, turn = 0;
    bool all = record->kept_count > record->room / 2; /* too many events: thin them like other rows */
    record->kept_count = 0;
    for (size_t i = 0; i < record->count; i++) {
        bool stays = i == 0 || i + 1 == record->count || (record->kept[i] && !all) || turn++ % 2 == 0;
        if (!stays) continue;
        record->times[to] = record->times[i];
        record->kept[to] = record->kept[i] && !all;
        record->kept_count += record->kept[to];
        if (to != i)
            memcpy(record->rows + to * columns, record->rows + i * columns, columns * sizeof *record->rows);
        to++;
    }
    record->count = to;
    record->stride *= 2;
}

static void store(struct record *record, double t, bool keep)
{
    if (record->count == record->room) halve(record);
    size_t i = record->count++;
    record->times[i] = t;
    record->kept[i] = keep;
    record->kept_count += keep;
    memcpy(record->rows + i * record->column_count, record->values,
           record->column_count * sizeof *record->values);
}

/* ---- envelope */

static void join_buckets(struct record *record)
{
    size_t columns = record->column_count, half = record->bucket_count / 2;
    for (size_t k = 0; k < half; k++) {
        const float *a = record->envelope + 4 * k * columns, *b = a + 2 * columns;
        float *cell = record->envelope + 2 * k * columns;
        /* no NaN occurs: equivalent to fminf and fmaxf; measured: faster */
        for (size_t c = 0; c < 2 * columns; c += 2) {
            cell[c] = a[c] < b[c] ? a[c] : b[c];
            cell[c + 1] = a[c + 1] > b[c + 1] ? a[c + 1] : b[c + 1];
        }
    }
    clear_envelope(record, half);
    record->bucket *= 2;
}

static void widen_envelope(struct record *record, double t)
{
    if (!(record->bucket > 0)) return;
    while (t > record->bucket * (double)record->bucket_count) join_buckets(record);
    size_t k = (size_t)(t / record->bucket), columns = record->column_count;
    if (k >= record->bucket_count) k = record->bucket_count - 1;
    float *cell = record->envelope + 2 * k * columns;
    for (size_t c = 0; c < columns; c++) {
        double value = record->values[c];
        struct record_column *column = &record->columns[c];
        if (value < cell[2 * c]) cell[2 * c] = (float)value;
        if (value > cell[2 * c + 1]) cell[2 * c + 1] = (float)value;
        if (value < column->least) column->least = value;
        if (value > column->greatest) column->greatest = value;
    }
}

static void find_odd(struct record *record, double t)
{
    for (size_t c = 0; c < record->column_count && !record->odd; c++) {
        if (isfinite(record->values[c])) continue;
        record->odd = record->columns[c].name;
        record->odd_time = t;
    }
}

/* Take the row of a state; record->work holds the work integrals up to there. */
static void take(struct record *record, struct fbd_state *state, bool keep)
{
    bool stored = keep || record->seen++ % record->stride == 0;
    record_fill(record, state, stored || !record->costly);
    if (stored) find_odd(record, state->t);
    widen_envelope(record, state->t);
    if (stored) store(record, state->t, keep);
}

/* ---- a run */

/* The interval of regular rows, a fraction or multiple of that of the CSV, so that their times coincide. */
static double choose_interval(const struct ensemble *run, double every, double rows)
{
    double length = run->options.until - run->t;
    if (!(every > 0)) every = run->model->scene->simulate.every;
    if (!(every > 0)) every = length / default_intervals;
    double count = length / every;
    if (count > rows) return every * ceil(count / rows);
    return count > 0 ? every / ceil(rows / fmax(count, 1)) : 0;
}

static void remember_start(struct record *record, const struct fbd_state *state)
{
    size_t n = (size_t)record->model->plan.n;
    memcpy(record->turning, state->y + n, n * sizeof *record->turning);
    memcpy(record->turning + n, state->a, n * sizeof *record->turning);
}

bool record_begin(struct record *record, struct ensemble *run, struct ledger *ledger,
                  const fbd_recording *recording)
{
    const struct fbd_model *model = run->model;
    struct fbd_state *start = ensemble_state(run);
    size_t loads = model->load_count, n = (size_t)model->plan.n;
    *record =
        (struct record){.model = model, .ledger = ledger, .next = 1, .components = recording->components};
    record->probe = state_new(model);
    record->arrows = calloc(diagram_most_arrows(model), sizeof *record->arrows);
    record->work = calloc(loads + 1, sizeof *record->work);
    record->turning = calloc(2 * n + 1, sizeof *record->turning);
    if (!record->probe || !record->arrows || !record->work || !record->turning) return false;
    for (size_t i = 0; i < loads; i++)
        record->costly |= model->loads[i].potential_kind == potential_quadrature;
    size_t rows = recording->rows > 0 ? recording->rows : regular_rows;
    if (!record_define(record, start) || !make_room(record, rows)) return false;
    record->every = choose_interval(run, recording->every, (double)rows);
    /* The envelope starts with very short pieces, which are joined during the run, since the run may end
     * early. */
    double length = run->options.until - run->t;
    record->bucket = length / (double)record->bucket_count / 1024;
    take(record, start, true);
    remember_start(record, start);
    return true;
}

/* Take the row of record->probe, a state at t within the last step. */
static bool take_probe(struct record *record, struct ensemble *run, double t, bool keep)
{
    if (!ledger_within(record->ledger, run, t, record->work)) return false;
    take(record, record->probe, keep);
    return true;
}

/* Update the envelope by a state that is not stored as a row. */
static bool look_at(struct record *record, struct ensemble *run, double t)
{
    if (!ensemble_look(run, t, record->probe)) return false;
    record_fill(record, record->probe, false);
    widen_envelope(record, t);
    return true;
}

/* The zero of the cubic with values a, b of different signs and slopes p, q (times the interval) at 0 and 1:
 * by bisection, to 1/4096; the error of the extreme is of the order of the square of that. */
static double cubic_root(double a, double b, double p, double q)
{
    double low = 0, high = 1;
    for (int i = 0; i < 12; i++) {
        double u = (low + high) / 2;
        double value = a + u * (p + u * (3 * (b - a) - 2 * p - q + u * (2 * (a - b) + p + q)));
        if (value * a > 0)
            low = u;
        else
            high = u;
    }
    return (low + high) / 2;
}

/* The first time after t in the step at which a rate or an acceleration changes its sign, interpolated from
 * the values at the ends: rates with the accelerations as slopes, accelerations linearly. */
static double next_turning(const struct record *record, const struct fbd_state *end, double from, double t)
{
    size_t n = (size_t)record->model->plan.n;
    const double *rate = record->turning, *acceleration = record->turning + n;
    double first = HUGE_VAL, h = end->t - from;
    for (size_t i = 0; i < 2 * n; i++) {
        double a = i < n ? rate[i] : acceleration[i - n], b = i < n ? end->y[n + i] : end->a[i - n];
        if (!(a * b < 0)) continue;
        double u = i < n ? cubic_root(a, b, h * acceleration[i], h * end->a[i]) : a / (a - b);
        double when = from + h * u;
        if (when > t && when < first && when < end->t) first = when;
    }
    return first;
}

/* Take rows at regular times, and sample turning points, before the end of the step, in order. */
static bool take_inside(struct record *record, struct ensemble *run, double from)
{
    const struct fbd_state *state = ensemble_state(run);
    const int most_turnings = record->model->plan.n > many_coordinates ? 1 : 4;
    double end = run->t, near = 1e-9 * record->every, t = from;
    for (int turnings = 0;;) {
        double regular = record->every > 0 ? (double)record->next * record->every : HUGE_VAL;
        if (regular >= end - near) regular = HUGE_VAL;
        double turning = turnings < most_turnings ? next_turning(record, state, from, t) : HUGE_VAL;
        t = fmin(regular, turning);
        if (t >= end) return true;
        if (t == turning) turnings++;
        if (t == turning && t != regular) {
            if (!look_at(record, run, t)) return false;
            continue;
        }
        record->next++;
        if (!ensemble_look(run, t, record->probe) || !take_probe(record, run, t, false)) return false;
    }
}

bool record_step(struct record *record, struct ensemble *run, double from, bool event)
{
    double end = run->t, near = 1e-9 * record->every;
    bool last = run->outcome != FBD_GOING;
    /* An interval at round-off level gets no row. */
    if (!(end - from > near) && !event && !last) return true;
    if (!take_inside(record, run, from)) return false;
    if (record->every > 0 && fabs((double)record->next * record->every - end) <= near) record->next++;
    if (event && (!ensemble_look_before(run, end, record->probe) || !take_probe(record, run, end, true)))
        return false;
    if (!ledger_at(record->ledger, run, record->work)) return false;
    take(record, ensemble_state(run), event || last);
    remember_start(record, ensemble_state(run));
    return true;
}

/* ---- afterwards */

void record_thin(struct record *record, size_t rows, size_t buckets)
{
    while (record->count > rows && record->count > least_rows) {
        size_t before = record->count;
        halve(record);
        if (record->count == before) return;
    }
    while (record->bucket_count > buckets && record->bucket_count > least_buckets) {
        join_buckets(record);
        record->bucket_count /= 2;
    }
}

bool record_is_thinned(const struct record *record)
{
    return record->stride > 1;
}

void record_free(struct record *record)
{
    free(record->times);
    free(record->rows);
    free(record->kept);
    free(record->envelope);
    free(record->values);
    free(record->turning);
    free(record->work);
    free(record->arrows);
    state_free(record->probe);
    run_columns_free(&record->all);
    *record = (struct record){0};
}
