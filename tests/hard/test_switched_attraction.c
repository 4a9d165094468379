/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A constant force towards the origin, which is passed ever slower and ever more often.
 *
 * What makes it hard: at each passage the switch is zero to rounding, and the way back to it is short.
 *
 * Reference: on one side, with v > 0 away from the origin and m = 1, v = (v0 + F/c) e^(-ct) - F/c and x = (v0
 * + F/c)(1 - e^(-ct))/c - F t/c. The time of return is the second zero of x, and what is left of v0 there
 * starts the other side.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

#include <stdlib.h>
#include <string.h>

struct side {
    double F, c, x0, v0;
};

/* Towards the origin counts negative. */
static double speed(const struct side *side, double t)
{
    return side->v0 * exp(-side->c * t) + side->F / side->c * expm1(-side->c * t);
}

static double place(double t, const void *context)
{
    const struct side *side = context;
    double c = side->c, terminal = side->F / c;
    return side->x0 - (side->v0 + terminal) * expm1(-c * t) / c - terminal * t;
}

/* The next time at the origin, beyond the turning point. The way back takes longer than the way out, not
 * eight times. */
static double arrival(const struct side *side)
{
    double turn = log1p(side->v0 * side->c / side->F) / side->c;
    double low = side->x0 > 0 ? 0 : turn, high = 8 * turn + 8 * sqrt(side->x0 / side->F);
    return hard_root(place, side, low, high);
}

/* The speed at the end, and how often the origin has been passed. */
static double reference(double F, double c, double until, size_t *passages)
{
    struct side side = {F, c, 1, 0};
    double t = 0, sign = 1;
    for (*passages = 0;; ++*passages) {
        double next = arrival(&side);
        if (t + next > until) return sign * speed(&side, until - t);
        t += next;
        side = (struct side){F, c, 0, -speed(&side, next)};
        sign = -sign;
    }
}

/* An error dv of the speed at a passage moves each later one by 2 dv/F more, so that half of their number
 * counts on average, and the speed at a given time by 2 F times that. A step errs by the tolerance times 1.6
 * m/s at most. Methods below order 4 and multistep methods, which start at order 1 after each passage, are
 * off by more than the time between the last ones. */
static void no_passage_is_missed(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    static const char *const forces[] = {"F=1",   "F=1.35", "F=1.8", "F=2",
                                         "F=2.5", "F=3.15", "F=3.5", "F=3.9"};
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        if (method.order < 4 || (method.name && strncmp(method.name, "ms", 2) == 0)) continue;
        for (size_t k = 0; k < sizeof forces / sizeof *forces; k++) {
            if (!is_in_turn(k, i)) continue;
            size_t passages;
            struct trial trial = trial_open("hard/switched_attraction.yaml", SET(forces[k]));
            hard_start(&trial, &method, NAN);
            if (hard_done(&checks, &trial)) {
                double v = reference(strtod(forces[k] + 2, NULL), 0.5, 30, &passages);
                check_that(&checks, "all passages", hard_count(&trial, FBD_EVENT_SWITCH) == passages);
                hard_case(&checks, &trial, "speed after hundreds of passages",
                          fabs(trial_get(&trial, "v") - v),
                          4 * 1.6 * hard_promise(&trial) * (double)passages / 2);
            }
            trial_close(&trial);
        }
    }
    checks_end(&checks);
}

/* Twelve times as strong a damper leaves 1e-9 m/s after 10 s, and 1e9 passages in each second: nobody waits
 * for that, and the run must say so. */
static void what_never_gets_done_is_refused(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("hard/switched_attraction.yaml", SET("c=6"));
    hard_start(&trial, NULL, NAN);
    check_that(&checks, "the run fails", hard_finish(&trial) == FBD_FAILED);
    check_that(&checks, "as events chatter about the pull",
               strstr(fbd_simulation_reason(trial.simulation), "events chatter: `pull`"));
    hard_case(&checks, &trial, "place where it gives up", fabs(trial_get(&trial, "x")), 1e-6);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_passage_is_missed),
        cmocka_unit_test(what_never_gets_done_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
