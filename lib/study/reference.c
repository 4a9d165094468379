/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/reference.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "fbd_study.h"
#include "study/stopwatch.h"

enum { grid_intervals = 240, rungs = 4 };

/* Methods of different families, in the order of expected agreement. */
static const char *const candidates[] = {"rk8pd", "dop853", "rodas5p", "msadams", "bsimp"};
static const double tolerances[rungs] = {1e-11, 1e-12, 1e-13, 1e-14};

enum { candidate_count = sizeof candidates / sizeof *candidates };

struct attempt {
    struct setting setting;
    struct track track;
    bool usable;
};

struct search {
    const fbd_model *model;
    struct certified_reference *reference;
    struct arena *arena;
    fbd_errors *errors;
    struct attempt attempts[candidate_count][rungs];
};

/* ---- the runs */

/* The expected time of the next tighter run: extrapolated by the growth so far, at most tenfold. */
static double expected(const struct attempt *rung, int r)
{
    double ratio = r > 0 && rung[-1].track.seconds > 0 ? rung->track.seconds / rung[-1].track.seconds : 2;
    return rung->track.seconds * fmin(fmax(ratio, 1.2), 10);
}

static bool climb(struct search *search, int c, double seconds)
{
    struct stopwatch watch = stopwatch_start();
    for (int r = 0; r < rungs; r++) {
        struct attempt *attempt = &search->attempts[c][r];
        double left = seconds - stopwatch_seconds(&watch);
        if (r > 0 && (!attempt[-1].usable || expected(&attempt[-1], r - 1) > left)) break;
        attempt->setting =
            (struct setting){.method = candidates[c], .tolerance = tolerances[r], .automatic = true};
        if (!track_make(&attempt->track, search->model, &attempt->setting, &search->reference->grid,
                        fmax(left, 1e-3), search->arena, search->errors))
            return false;
        /* A run that ends by a violated assumption is usable up to there. */
        attempt->usable = track_ended(&attempt->track) || attempt->track.outcome == FBD_BROKEN;
    }
    return true;
}

/* ---- scales */

static bool is_angle(const fbd_model *model, size_t coordinate)
{
    return strcmp(fbd_model_coordinate(model, coordinate).unit, "rad") == 0;
}

void reference_scales(double *scale, const struct track *track, const bool *chosen, const fbd_model *model)
{
    const double least_share = 1e-6;
    size_t n = fbd_model_coordinate_count(model);
    for (size_t i = 0; i < track->size; i++) {
        scale[i] = 0;
        for (size_t k = 0; k < track->reached; k++)
            scale[i] = fmax(scale[i], fabs(track->y[k * track->size + i]));
    }
    double largest[2][2] = {{0}}; /* rate or not, angle or not */
    for (size_t i = 0; i < 2 * n; i++) {
        double *most = &largest[i >= n][is_angle(model, i < n ? i : i - n)];
        *most = fmax(*most, scale[i]);
    }
    for (size_t i = 0; i < track->size; i++) { /* user states have no minimum scale */
        double least = i < 2 * n ? least_share * largest[i >= n][is_angle(model, i < n ? i : i - n)] : 0;
        scale[i] = chosen && !chosen[i] ? 0 : fmax(scale[i], least);
    }
}

/* ---- the pair that agrees best */

static size_t common(const struct track *a, const struct track *b)
{
    return a->reached < b->reached ? a->reached : b->reached;
}

static double difference(const struct certified_reference *reference, const struct attempt *a,
                         const struct attempt *b)
{
    if (!a->usable || !b->usable || a->track.outcome != b->track.outcome) return INFINITY;
    double d = tracks_differ(&a->track, &b->track, reference->scale, 0, common(&a->track, &b->track), NULL);
    return isnan(d) ? INFINITY : d;
}

struct pair {
    const struct attempt *one, *other;
    double difference;
    size_t known; /* number of grid times up to which the difference is at most `good` */
};

static const double good = 1e-6;

static size_t known_times(const struct certified_reference *reference, const struct attempt *a,
                          const struct attempt *b)
{
    size_t count = common(&a->track, &b->track), k = 0;
    while (k < count && tracks_differ(&a->track, &b->track, reference->scale, k, k + 1, NULL) <= good) k++;
    return k;
}

/* Replace `best` if this pair agrees for longer, or for as long with a smaller difference. */
static void consider(const struct search *search, const struct attempt *one, const struct attempt *other,
                     struct pair *best)
{
    double apart = difference(search->reference, one, other);
    if (isinf(apart)) return;
    size_t known = known_times(search->reference, one, other);
    if (best->one && (known < best->known || (known == best->known && apart >= best->difference))) return;
    *best = (struct pair){one, other, apart, known};
}

static struct pair best_pair(const struct search *search, int first, int last)
{
    struct pair best = {.difference = INFINITY};
    for (int c = 0; c < candidate_count; c++)
        for (int d = c + 1; d < candidate_count; d++)
            for (int r = first; r < last; r++)
                for (int s = first; s < last; s++)
                    consider(search, &search->attempts[c][r], &search->attempts[d][s], &best);
    return best;
}

/* ---- accuracy of the reference */

/* The time of tenfold growth: a line is fitted to the logarithm of the running maximum of the differences,
 * between rounding and saturation. */
static double growth(const struct certified_reference *reference, const struct pair *pair)
{
    const double least = 1e-14, most = 1e-2, least_decades = 3;
    double sum[5] = {0}, so_far = 0, low = INFINITY;
    size_t count = common(&pair->one->track, &pair->other->track);
    for (size_t k = 1; k < count; k++) {
        double now = tracks_differ(&pair->one->track, &pair->other->track, reference->scale, k, k + 1, NULL);
        so_far = fmax(so_far, now);
        if (!(so_far > least && so_far < most)) continue;
        double t = grid_time(&reference->grid, k), y = log10(so_far);
        low = fmin(low, y);
        sum[0] += 1, sum[1] += t, sum[2] += y, sum[3] += t * t, sum[4] += t * y;
    }
    double spread = sum[0] * sum[3] - sum[1] * sum[1];
    bool grows = sum[0] > 8 && spread > 0 && log10(so_far) - low >= least_decades;
    double slope = grows ? (sum[0] * sum[4] - sum[1] * sum[2]) / spread : 0;
    return slope > 0 ? 1 / slope : NAN;
}

/* Cut the grid where the difference of the pair exceeds `good`. */
static void cut_grid(struct certified_reference *reference, const struct pair *pair)
{
    const struct track *one = &pair->one->track, *other = &pair->other->track;
    struct track *track = &reference->track;
    size_t last = pair->known > 0 ? pair->known - 1 : 0;
    reference->cut = pair->known < common(one, other);
    reference->known = reference->cut ? grid_time(&reference->grid, last) : track->t_end;
    track->reached = pair->known;
    reference->floor = tracks_differ(one, other, reference->scale, 0, pair->known, NULL);
    reference->floor_end = tracks_differ(one, other, reference->scale, last, pair->known, NULL);
}

static void finish(struct certified_reference *reference, const struct search *search,
                   const struct pair *pair)
{
    struct pair loose = best_pair(search, 0, 1);
    reference->settings[0] = pair->one->setting;
    reference->settings[1] = pair->other->setting;
    reference->track = pair->one->track;
    reference->whole_floor = pair->difference;
    reference->loose_floor = loose.difference;
    cut_grid(reference, pair);
    /* Both runs have rounding errors, even if they agree to the last bit. */
    reference->floor = fmax(reference->floor, 4 * DBL_EPSILON);
    reference->floor_end = fmax(reference->floor_end, 4 * DBL_EPSILON);
    reference->tenfold = pair->difference > 1e-9 ? growth(reference, pair) : NAN;
}

/* ---- the exact solution of the file */

/* The value of quantity i at t, and its rounding error: that of t, magnified by the rate, plus that of the
 * value. Returns false when the file does not give it. */
static bool exact_value(const fbd_model *model, size_t i, double t, double *value, double *rounding)
{
    double slope;
    if (!fbd_model_exact(model, i, t, value, &slope)) return false;
    *rounding = 4 * DBL_EPSILON * (fabs(*value) + fabs(slope * t));
    return true;
}

static void check_exact(struct certified_reference *reference, size_t i, double t, double apart,
                        double rounding)
{
    double allowed = 1e-9 + 100 * (reference->floor + rounding);
    if (apart <= allowed) return;
    if (!reference->exact_differs) reference->exact_from = t;
    reference->exact_differs = true;
    if (isnan(apart)) apart = INFINITY; /* the expression is undefined there */
    if (!(apart > reference->exact_error)) return;
    reference->exact_error = apart;
    reference->exact_worst = i;
}

/* Replace computed quantities by the exact solution of the file. */
static void take_exact(struct certified_reference *reference, const fbd_model *model)
{
    struct track *track = &reference->track;
    double floor = 0, floor_end = 0;
    reference->all_exact = true;
    for (size_t i = 0; i < track->size; i++) {
        double scale = reference->scale[i];
        for (size_t k = 0; k < track->reached; k++) {
            double t = grid_time(&reference->grid, k), value, rounding;
            if (!exact_value(model, i, t, &value, &rounding)) break;
            reference->exact[i] = true;
            if (!(scale > 0)) continue;
            check_exact(reference, i, t, fabs(value - track->y[k * track->size + i]) / scale,
                        rounding / scale);
            floor = fmax(floor, rounding / scale);
            floor_end = rounding / scale;
        }
        if (!(scale > 0)) continue;
        if (reference->exact[i]) reference->any_exact = true;
        if (!reference->exact[i]) reference->all_exact = false;
    }
    reference->all_exact = reference->all_exact && reference->any_exact;
    if (reference->exact_differs || !reference->any_exact) return;
    for (size_t i = 0; i < track->size; i++)
        for (size_t k = 0; reference->exact[i] && k < track->reached; k++) {
            double rounding;
            exact_value(model, i, grid_time(&reference->grid, k), &track->y[k * track->size + i], &rounding);
        }
    if (!reference->all_exact) return;
    reference->floor = fmax(floor, 4 * DBL_EPSILON);
    reference->floor_end = fmax(floor_end, 4 * DBL_EPSILON);
}

/* ---- the whole */

static bool no_reference(const struct search *search)
{
    const char *why = "";
    for (int c = 0; c < candidate_count && !why[0]; c++)
        if (search->attempts[c][0].track.reason) why = search->attempts[c][0].track.reason;
    diag_add(search->errors, FBD_ERROR, "no-reference", (struct pos){0, 0},
             "shorten the run (--until) or give it more time (--budget)",
             "there is no reference for the errors: no two methods reach the end of the run at a tight "
             "tolerance%s%s",
             why[0] ? ": " : "", why);
    return false;
}

bool reference_make(struct certified_reference *reference, const fbd_model *model, double until,
                    const bool *chosen, double seconds, struct arena *arena, fbd_errors *errors)
{
    size_t size = quantity_count(model);
    *reference =
        (struct certified_reference){.grid = {.until = until, .count = grid_intervals + 1}, .tenfold = NAN};
    reference->scale = ARENA_ARRAY(arena, size + 1, double);
    reference->exact = ARENA_ARRAY(arena, size + 1, bool);
    struct search *search = ARENA_NEW(arena, struct search);
    if (!search || !reference->scale || !reference->exact) {
        diag_out_of_memory(errors);
        return false;
    }
    *search = (struct search){.model = model, .reference = reference, .arena = arena, .errors = errors};
    struct stopwatch watch = stopwatch_start();
    const struct track *first = NULL;
    for (int c = 0; c < candidate_count; c++) {
        double left = seconds - stopwatch_seconds(&watch);
        if (!climb(search, c, left / (candidate_count - c))) return false;
        for (int r = 0; r < rungs && !first; r++)
            if (search->attempts[c][r].usable) first = &search->attempts[c][r].track;
    }
    if (!first) return no_reference(search);
    reference_scales(reference->scale, first, chosen, model);
    struct pair pair = best_pair(search, 0, rungs);
    if (!pair.one) return no_reference(search);
    finish(reference, search, &pair);
    take_exact(reference, model);
    return true;
}

/* ---- errors */

static void compare_events(const struct certified_reference *reference, const struct track *track,
                           struct errors_of_a_run *errors)
{
    const struct track *known = &reference->track;
    errors->same_events = true;
    errors->event = NAN;
    for (size_t i = 0; i < known->event_count && known->events[i].t <= reference->known; i++) {
        const struct track_event *want = &known->events[i], *got = &track->events[i];
        bool same = i < track->event_count && got->kind == want->kind && strcmp(got->body, want->body) == 0 &&
                    strcmp(got->name, want->name) == 0;
        errors->same_events = errors->same_events && same;
        if (!errors->same_events) break;
        errors->event = fmax(fabs(got->t - want->t), isnan(errors->event) ? 0 : errors->event);
    }
    if (!reference->cut && track->event_count != known->event_count) errors->same_events = false;
    if (!errors->same_events) errors->event = NAN;
}

struct errors_of_a_run reference_errors(const struct certified_reference *reference,
                                        const struct track *track)
{
    struct errors_of_a_run errors = {.max = NAN, .end = NAN};
    size_t count = reference->track.reached, seen = common(&reference->track, track);
    compare_events(reference, track, &errors);
    if (count == 0 || seen + 1 < count) return errors;
    errors.max = tracks_differ(&reference->track, track, reference->scale, 0, seen, &errors.worst);
    errors.end = tracks_differ(&reference->track, track, reference->scale, seen - 1, seen, NULL);
    return errors;
}
