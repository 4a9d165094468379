/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Work against precision: our default method beside C by hand, on a gallery with closed forms.
 *
 * Usage: bench_accuracy SOURCE [FILE [PROBLEM...]]; writes docs/accuracy.md (FILE, or standard output for -), with
 * PROBLEM only those whose names start so. Every program
 * climbs a ladder of tolerances; at the errors 1e-6 and 1e-9 the two rungs beside are timed, all programs in
 * turn, and the time is interpolated (log-log). Times are processor times of the whole run from nothing,
 * medians of repeats; ratios compare equal measured errors. For ours the model is read before.
 */
#include <errno.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_version.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy.h"
#include "claim.h"
#include "recommended.h"
#include "timing.h"

enum { rungs = 12, most_solvers = 12, most_repeats = 21, targets = 2 };

static const double target_errors[targets] = {1e-6, 1e-9};

struct rung {
    double error, seconds;
    bool tried, wanted;
    int repeats;
    double samples[most_repeats];
};

struct contest {
    const struct problem *problem;
    fbd_model *model;
    const struct solver *solvers[most_solvers];
    size_t count;
    struct rung rungs[most_solvers][rungs];
};

/* What an error costs a program; NAN where it does not get there. */
struct cost {
    double seconds;
    double tolerance; /* of the first rung that is as good */
};

static double tolerance_of(int rung)
{
    return pow(10, -3 - rung);
}

/* ---- ours */

static double run_ours(const struct problem *problem, const fbd_model *model, double tolerance)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = problem->times[problem->time_count - 1];
    options.tolerance = tolerance;
    fbd_state *state = fbd_state_new(model);
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    fbd_outcome outcome = FBD_GOING;
    double error = 0, from, to, y[most_size] = {0};
    for (size_t next = 0; outcome == FBD_GOING;) {
        outcome = fbd_simulation_advance(simulation);
        fbd_simulation_interval(simulation, &from, &to);
        for (; next < problem->time_count && problem->times[next] <= to; next++) {
            fbd_simulation_state(simulation, problem->times[next], state);
            for (size_t i = 0; i < problem->size; i++)
                if (!fbd_state_get(state, problem->names[i], &y[i])) exit(1);
            error = fmax(error, problem_error(problem, problem->times[next], y));
        }
    }
    fbd_simulation_free(simulation);
    fbd_state_free(state);
    fbd_errors_free(errors);
    return outcome == FBD_DONE ? error : NAN;
}

static const struct solver ours = {
    .name = "fbd, default method", .for_stiff = true, .for_others = true, .ours = true, .run = run_ours};

/* ---- a contest */

static void enter(struct contest *contest, const struct solver *solvers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if ((contest->problem->stiff ? solvers[i].for_stiff : solvers[i].for_others) &&
            !(solvers[i].smooth_only && contest->problem->kind != smooth))
            contest->solvers[contest->count++] = &solvers[i];
}

/* Once up the ladder, to the rung after the tightest target or to what takes seconds. */
static void climb(struct contest *contest, size_t s)
{
    const double enough = 2e-11, too_long = 2.5;
    for (int r = 0; r < rungs; r++) {
        struct rung *rung = &contest->rungs[s][r];
        double start = processor_seconds();
        rung->tried = true;
        rung->error = contest->solvers[s]->run(contest->problem, contest->model, tolerance_of(r));
        rung->seconds = processor_seconds() - start;
        if (rung->error <= enough || rung->seconds > too_long) break;
    }
}

/* The first rung from which on the error is met; -1 when there is none. */
static int first_that_meets(const struct rung *ladder, double error)
{
    int first = -1;
    for (int r = rungs - 1; r >= 0; r--) {
        if (!ladder[r].tried) continue;
        if (!(ladder[r].error <= error)) break;
        first = r;
    }
    return first;
}

static void want(struct contest *contest)
{
    for (size_t s = 0; s < contest->count; s++)
        for (int k = 0; k < targets; k++) {
            int r = first_that_meets(contest->rungs[s], target_errors[k]);
            if (r >= 0) contest->rungs[s][r].wanted = true;
            if (r > 0) contest->rungs[s][r - 1].wanted = true;
        }
}

static void time_once(struct contest *contest, size_t s, int r)
{
    const double least = 500e-6;
    struct rung *rung = &contest->rungs[s][r];
    int turns = (int)fmin(ceil(least / fmax(rung->seconds, 1e-7)), 200);
    double start = processor_seconds();
    for (int i = 0; i < turns; i++)
        contest->solvers[s]->run(contest->problem, contest->model, tolerance_of(r));
    rung->samples[rung->repeats++] = (processor_seconds() - start) / turns;
}

static void time_in_turn(struct contest *contest)
{
    const double most = 1.5; /* seconds for one rung */
    for (int round = 0; round < most_repeats; round++)
        for (size_t s = 0; s < contest->count; s++)
            for (int r = 0; r < rungs; r++) {
                const struct rung *rung = &contest->rungs[s][r];
                if (rung->wanted && (round < 2 || round * rung->seconds < most)) time_once(contest, s, r);
            }
    for (size_t s = 0; s < contest->count; s++)
        for (int r = 0; r < rungs; r++) {
            struct rung *rung = &contest->rungs[s][r];
            if (rung->repeats == 0) continue;
            rung->seconds = median(rung->samples, (size_t)rung->repeats);
        }
}

static struct cost cost_of(const struct contest *contest, size_t s, double error)
{
    const struct rung *ladder = contest->rungs[s];
    int r = first_that_meets(ladder, error);
    if (r < 0) return (struct cost){NAN, NAN};
    struct cost cost = {ladder[r].seconds, tolerance_of(r)};
    if (r > 0 && ladder[r - 1].error > error && ladder[r].error > 0) {
        double share = log(ladder[r - 1].error / error) / log(ladder[r - 1].error / ladder[r].error);
        cost.seconds = ladder[r - 1].seconds * pow(ladder[r].seconds / ladder[r - 1].seconds, share);
    }
    return cost;
}

/* ---- the document */

static void cell(FILE *out, double seconds, double ratio)
{
    if (isnan(seconds))
        fprintf(out, " not reached | |");
    else if (isnan(ratio))
        fprintf(out, " %.3f ms | |", 1e3 * seconds);
    else
        fprintf(out, " %.3f ms | %.2f |", 1e3 * seconds, ratio);
}

static void write_contest(FILE *out, const struct contest *contest)
{
    const struct problem *problem = contest->problem;
    fprintf(out, "\n### %s\n\n`fbd-cost %s%s%s`\n\n", problem->name, problem->options,
            problem->options[0] ? " " : "", problem->model);
    fprintf(out,
            "| program | 1e-6 | fbd / program | 1e-9 | fbd / program |\n| --- | --- | --- | --- | --- |\n");
    for (size_t s = 0; s < contest->count; s++) {
        fprintf(out, "| %s |", contest->solvers[s]->name);
        for (int k = 0; k < targets; k++) {
            struct cost own = cost_of(contest, 0, target_errors[k]),
                        other = cost_of(contest, s, target_errors[k]);
            cell(out, other.seconds, s == 0 ? NAN : own.seconds / other.seconds);
        }
        fprintf(out, "\n");
    }
    for (int k = 0; k < targets; k++) {
        struct cost own = cost_of(contest, 0, target_errors[k]);
        if (!isnan(own.seconds))
            fprintf(out, "%s%.0e: `fbd-run --tolerance %.0e %s%s%s`", k ? "; " : "\n", target_errors[k],
                    own.tolerance, problem->options, problem->options[0] ? " " : "", problem->model);
    }
    fprintf(out, "\n");
}

static double ratio_to(const struct contest *contest, const char *name, double error)
{
    for (size_t s = 0; s < contest->count; s++)
        if (strcmp(contest->solvers[s]->name, name) == 0)
            return cost_of(contest, 0, error).seconds / cost_of(contest, s, error).seconds;
    return NAN;
}

/* A line of the document, and of the table of `make bench`. */
static void bound(FILE *out, const char *measure, double ratio, double most)
{
    fprintf(out, "| %s | at most %.3g | ", measure, most);
    if (isnan(ratio))
        fprintf(out, "not measured | |\n");
    else
        fprintf(out, "%.3f | %s |\n", ratio, ratio <= most ? "met" : "**not met**");
    if (out != stdout) claim_at_most(measure, ratio, most);
}

/* The largest ratio to a program by hand, which is the ratio to the quickest of them. */
static double ratio_to_hand(const struct contest *contest, double error)
{
    double own = cost_of(contest, 0, error).seconds, least = NAN;
    for (size_t s = 1; s < contest->count; s++)
        if (strncmp(contest->solvers[s]->name, "C by hand", 9) == 0)
            least = fmin(least, cost_of(contest, s, error).seconds);
    return own / least;
}

static void bounds_of_runs(FILE *out, const struct contest *contests)
{
    static const struct {
        const char *starts;
        double most;
    } runs[] = {
        {"pendulum, 100 s", 1.5}, {"double pendulum", 1.5}, {"cart-pole", 1.5}, {"light cart-pole", 1.5},
        {"three rods", 1.5},      {"slider-crank", 1.5},    {"belt", 1}};
    for (size_t i = 0; i < problem_count; i++)
        for (size_t k = 0; k < sizeof runs / sizeof *runs; k++) {
            const char *name = contests[i].problem->name;
            if (strncmp(name, runs[k].starts, strlen(runs[k].starts)) != 0) continue;
            for (int e = 0; e < targets; e++) {
                char what[200];
                snprintf(what, sizeof what, "whole run: %s, error %.0e, beside the quickest C by hand", name,
                         target_errors[e]);
                bound(out, what, ratio_to_hand(&contests[i], target_errors[e]), runs[k].most);
            }
        }
}

static void write_bounds(FILE *out, const struct contest *contests, const struct recommended *recommended)
{
    fprintf(out, "\n## Bounds\n\nRatios of times, fbd / program, at equal measured error.\n\n"
                 "| measure | bound | measured | |\n| --- | --- | --- | --- |\n");
    bounds_of_runs(out, contests);
    bound(out, "pendulum 100 s, 1e-9, beside rk8pd by hand",
          ratio_to(&contests[0], "C by hand, GSL rk8pd", 1e-9), 1);
    bound(out, "the same beside CVODE Adams", ratio_to(&contests[0], "CVODE Adams", 1e-9), 1.0 / 15);
    bound(out, "belt 200 s, 1e-9, beside rk8pd by hand with event location",
          ratio_to(&contests[1], "C by hand, GSL rk8pd", 1e-9), 1.2);
    bound(out, "stiff oscillator c = 2e3, 1e-6, beside CVODE BDF", ratio_to(&contests[2], "CVODE BDF", 1e-6),
          1);
    bound(out, "stiff oscillator c = 1e4, the same", ratio_to(&contests[3], "CVODE BDF", 1e-6), 1);
    bound(out, "stiff oscillator c = 1e5, the same", ratio_to(&contests[4], "CVODE BDF", 1e-6), 1);
    if (!recommended) return;
    bound(out, "`fbd-cost` on the compound pendulum, default ladder, seconds", recommended->seconds, 10);
    bound(out, "its answers again, largest change of a time", recommended->repeat, 0.1);
    bound(out, "the recommended method over the gallery, time / best of a second table, largest",
          recommended->worst_ratio, 1.2);
}

/* The machine: what a reader needs to compare, and no names. */
static void write_machine(FILE *out)
{
    char line[400];
    FILE *info = fopen("/proc/cpuinfo", "r");
    fprintf(out, "\n## Machine\n\n");
    while (info && fgets(line, sizeof line, info)) {
        char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || !colon) continue;
        fprintf(out, "- processor: %s", colon + 2);
        break;
    }
    if (info) fclose(info);
    fprintf(out, "- compiler: %s %s, as the build has it (`-O2` by default)\n",
#ifdef __clang__
            "clang", __clang_version__
#else
            "gcc", __VERSION__
#endif
    );
    fprintf(out, "- fbd %s, GSL %s%s%s\n", fbd_version(), gsl_version,
            sundials_version[0] ? ", SUNDIALS " : ", without SUNDIALS", sundials_version);
}

static void write_document(FILE *out, const struct contest *contests, const struct recommended *recommended)
{
    fprintf(
        out,
        "# Accuracy against time, measured\n\n"
        "Written by `make bench` (tests/bench/bench_accuracy.c), the command that reproduces every "
        "figure\n"
        "here; times are those of one machine, so compare the ratios. Every program runs at a ladder of "
        "tolerances, "
        "1e-3 to\n1e-14, and its true error is known, from a closed form (trees and slider-crank: from a "
        "handwritten program at 1e-15); a time at the error 1e-6 or 1e-9 is "
        "interpolated between neighbouring\ntolerances. Times are medians of repeats taken in turn, of the "
        "whole "
        "run "
        "with its set-up (for fbd: after the model was read).\n"
        "Errors are those of coordinate and rate at the end (stiff oscillators: at four times), divided by "
        "their "
        "size.\n`fbd-cost` shows the same for every method of fbd, on any scene.\n");
    write_bounds(out, contests, recommended);
    fprintf(out,
            "\n## Beside C by hand\n\nC by hand has only the right-hand side and the exact Jacobian in C, "
            "and for the belt its own event location\n(tests/bench/accuracy_*.c). A ratio below 1 means "
            "that fbd is faster.\n");
    for (size_t i = 0; i < problem_count; i++)
        if (contests[i].count > 0) write_contest(out, &contests[i]);
    if (recommended) recommended_write(out, recommended);
    write_machine(out);
}

/* ---- the whole */

static fbd_model *read_model(const char *source, const struct problem *problem)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", source, problem->model);
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_read(path, problem->settings, problem->setting_count, errors);
    fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    if (!model) exit(1);
    return model;
}

static void hold(struct contest *contest, const struct problem *problem, const char *source)
{
    *contest = (struct contest){.problem = problem, .model = read_model(source, problem)};
    fprintf(stderr, "%s\n", problem->name);
    enter(contest, &ours, 1);
    enter(contest, gsl_solvers, gsl_solver_count);
    if (problem->kind != bounce) enter(contest, sundials_solvers, sundials_solver_count);
    for (size_t s = 0; s < contest->count; s++) climb(contest, s);
    want(contest);
    time_in_turn(contest);
}

/* Whether the command line names it, or none. */
static bool asked_for(const struct problem *problem, char **names, int count)
{
    for (int i = 0; i < count; i++)
        if (strncmp(problem->name, names[i], strlen(names[i])) == 0) return true;
    return count == 0;
}

static int write_to(const char *path, const struct contest *contests, const struct recommended *recommended)
{
    bool to_file = path && strcmp(path, "-") != 0;
    FILE *out = to_file ? fopen(path, "w") : stdout;
    if (out)
        write_document(out, contests, recommended);
    else
        fprintf(stderr, "cannot write `%s`: %s\n", path, strerror(errno));
    if (to_file && out) fclose(out);
    return out ? 0 : 1;
}

int main(int argc, char **argv)
{
    gsl_set_error_handler_off();
    if (argc < 2) return 2;
    struct contest *contests = calloc(problem_count, sizeof *contests);
    if (!contests) return 1;
    for (size_t i = 0; i < problem_count; i++)
        if (asked_for(&problems[i], argv + 3, argc - 3))
            hold(&contests[i], &problems[i], argv[1]);
        else
            contests[i].problem = &problems[i];
    struct recommended recommended;
    if (argc <= 3) recommended_measure(&recommended, argv[1]);
    int status = write_to(argc > 2 ? argv[2] : NULL, contests, argc <= 3 ? &recommended : NULL);
    for (size_t i = 0; i < problem_count; i++) fbd_model_free(contests[i].model);
    free(contests);
    return status;
}
