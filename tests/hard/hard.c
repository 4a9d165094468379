/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

#include "integrate/method.h"

/* ---- methods */

static double reachable(int order)
{
    return order >= 8 ? 1e-10 : order >= 4 ? 1e-9 : order == 3 ? 1e-8 : order == 2 ? 1e-6 : 1e-5;
}

static bool method_number(size_t index, struct hard_method *method)
{
    if (index < 2) {
        *method = (struct hard_method){NULL, 1e-10, 8, false, index == 1};
        return true;
    }
    const struct method *found = method_at(index - 2);
    if (!found) return false;
    *method =
        (struct hard_method){found->name, reachable(found->order), found->order, found->implicit, false};
    return true;
}

bool hard_method_in_turn(size_t index, size_t turn, struct hard_method *method)
{
    if (!thorough() && index > 0) index = 3 * index - 2 + turn % 3;
    return method_number(index, method);
}

void hard_each_tolerance(void (*check)(struct checks *checks, const struct hard_method *method))
{
    static const double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; method_number(i, &method); i++) {
        for (size_t k = 0; k < sizeof tolerances / sizeof *tolerances; k++) {
            method.tolerance = tolerances[k];
            if (!thorough() && k != 1) continue;
            if (method.order > 2 || method.tolerance >= 1e-8) check(&checks, &method);
        }
    }
    checks_end(&checks);
}

/* ---- runs */

void hard_start(struct trial *trial, const struct hard_method *method, double until)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = until;
    if (method) {
        options.method = method->name;
        options.tolerance = method->tolerance;
        options.no_structure = method->no_structure;
    }
    trial_start(trial, &options);
}

fbd_outcome hard_finish(struct trial *trial)
{
    double from, to;
    do trial->outcome = fbd_simulation_advance(trial->simulation);
    while (trial->outcome == FBD_GOING);
    fbd_simulation_interval(trial->simulation, &from, &to);
    assert_true(fbd_simulation_state(trial->simulation, to, trial->state));
    return trial->outcome;
}

bool hard_done(struct checks *checks, struct trial *trial)
{
    if (hard_finish(trial) == FBD_DONE) return true;
    fprintf(stderr, "# %s: %s\n", fbd_simulation_stats(trial->simulation).method,
            fbd_simulation_reason(trial->simulation));
    return check_that(checks, "the run reaches its end", false);
}

size_t hard_count(const struct trial *trial, fbd_event_kind kind)
{
    size_t count = 0;
    for (size_t i = 0; i < fbd_simulation_event_count(trial->simulation); i++)
        count += fbd_simulation_event(trial->simulation, i).kind == kind;
    return count;
}

double hard_promise(const struct trial *trial)
{
    fbd_stats stats = fbd_simulation_stats(trial->simulation);
    return 2 * stats.tolerance * (double)stats.steps;
}

/* ---- cases */

bool hard_case(struct checks *checks, const struct trial *trial, const char *name, double error,
               double tolerance)
{
    fbd_stats stats = fbd_simulation_stats(trial->simulation);
    printf("# %s (%s at %g, %lu steps): error %.2g, tolerance %.2g, ratio %.2g\n", name, stats.method,
           stats.tolerance, stats.steps, error, tolerance, error / tolerance);
    if (error <= tolerance) return true;
    fprintf(stderr, "# not within its tolerance: %s, %s\n", name, stats.method);
    checks->failed++;
    return false;
}

/* ---- references */

double hard_root(double (*function)(double t, const void *context), const void *context, double low,
                 double high)
{
    bool rising = function(low, context) < 0;
    assert_true(rising == (function(high, context) > 0));
    for (;;) {
        double middle = low + (high - low) / 2;
        if (!(middle > low && middle < high)) return middle;
        if ((function(middle, context) < 0) == rising)
            low = middle;
        else
            high = middle;
    }
}
