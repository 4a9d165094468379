/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Walking in time from kink to kink, as a simulation does, along expressions of t alone.
 */
#include "expr_scope.h"

#include <float.h>

enum { most_switches = 16 };

struct substeps {
    const struct expr *expr;
    int branch[most_switches];
    double t;
};

static double margin_at(const struct substeps *walk, double t, size_t index)
{
    double margins[2 * most_switches];
    expr_margins(walk->expr, time_dd_at(t), NULL, 1, NULL, walk->branch, margins, NULL, NULL);
    return margins[index];
}

/* The first double at which margin `index`, negative at `high`, is negative. */
static double find_end(const struct substeps *walk, double low, double high, size_t index)
{
    for (;;) {
        double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) return high;
        if (margin_at(walk, middle, index) < 0)
            high = middle;
        else
            low = middle;
    }
}

/* Go on to the next event, or to `until`, in strides of at most `stride`; false at `until`. */
static bool next_event(struct substeps *walk, double stride, double until)
{
    while (walk->t < until) {
        double high = fmin(walk->t + stride, until), first = HUGE_VAL;
        size_t count = expr_switches(walk->expr), found = 2 * count;
        for (size_t i = 0; i < 2 * count; i++) {
            if (!(margin_at(walk, high, i) < 0)) continue;
            double end = find_end(walk, walk->t, high, i);
            if (end < first) {
                first = end;
                found = i;
            }
        }
        if (found == 2 * count) {
            walk->t = high;
            continue;
        }
        bool keep[most_switches] = {false};
        size_t index = found / 2;
        walk->t = first;
        walk->branch[index] = expr_branch_beyond(walk->expr, index, (int)(found % 2), walk->branch[index]);
        keep[index] = true;
        expr_resolve(walk->expr, time_dd_at(walk->t), NULL, 1, NULL, keep, walk->branch);
        return true;
    }
    return false;
}

/* The instants at which the value jumps, and the values between them: `instant(k)` for k = 1, 2, ...,
 * `value(k)` for the piece behind it. */
struct script {
    const char *text;
    double until;
    int pieces; /* with the first one, which starts at 0 */
    double (*instant)(int k);
    double (*value)(int k);
};

static void follow(const struct script *script, double stride)
{
    struct trial trial = must_compile(script->text);
    struct substeps walk = {.expr = trial.expr, .t = 0};
    int piece = 0, events = 0;
    expr_resolve(trial.expr, time_dd_at(0), NULL, 1, NULL, NULL, walk.branch);
    double value = expr_eval(trial.expr, 0, NULL, walk.branch);
    assert_true(value == script->value(0));
    while (next_event(&walk, stride, script->until)) {
        /* At most every switch ends once at an instant that matters. */
        if (++events > 4 * script->pieces + 100)
            fail_msg("`%s` does not get on at t = %.17g", script->text, walk.t);
        double after = expr_eval(trial.expr, walk.t, NULL, walk.branch);
        if (after == value) continue;
        value = after;
        piece++;
        /* Located to the last bits of t and of the numbers in the text. */
        double wanted = script->instant(piece), allowed = 8 * DBL_EPSILON * fmax(walk.t, 1);
        if (fabs(walk.t - wanted) > allowed || value != script->value(piece))
            fail_msg("`%s`, piece %d: %.17g from t = %.17g on, wanted %.17g from %.17g on", script->text,
                     piece, value, walk.t, script->value(piece), wanted);
    }
    assert_int_equal(piece + 1, script->pieces);
    end_trial(&trial);
}

static double half_periods_of_0_7(int k)
{
    return k * 0.35;
}

static double ten_or_minus_ten(int k)
{
    return k % 2 ? -10 : 10;
}

static double plus_or_minus(int k)
{
    return k % 2 ? -1 : 1;
}

static double around_500(int k)
{
    return k == 1 ? 500 : 500.001;
}

static double around_0_3(int k)
{
    return k == 1 ? 0.3 : 0.47;
}

static double one_between(int k)
{
    return k == 1;
}

static double ten_between(int k)
{
    return k == 1 ? 10 : 0;
}

static double multiples_of_pi(int k)
{
    return k * 3.14159265358979323846;
}

static double tenths(int k)
{
    return k * 0.1;
}

static double counted(int k)
{
    return k;
}

static double three_at_0_3(int k)
{
    return k ? 3 : 0;
}

static const struct script scripts[] = {
    {"if(mod(t, 0.7) < 0.35, 10, -10)", 700 - 1e-3, 2000, half_periods_of_0_7, ten_or_minus_ten},
    {"if(not mod(t, 0.7) >= 0.35, 10, -10)", 700 - 1e-3, 2000, half_periods_of_0_7, ten_or_minus_ten},
    {"10*square(t/0.7[s])", 700 - 1e-3, 2000, half_periods_of_0_7, ten_or_minus_ten},
    {"if(sawtooth(t/0.7[s]) < 0.5, 10, -10)", 700 - 1e-3, 2000, half_periods_of_0_7, ten_or_minus_ten},
    {"pulse(t, 500, 0.001)", 1000, 3, around_500, one_between},
    {"10*(step(t - 0.3) - step(t - 0.47))", 1000, 3, around_0_3, ten_between},
    {"if(t > 0.3 and t < 0.47, 10, 0)", 1000, 3, around_0_3, ten_between},
    {"if(t > 0.3, if(t < 0.47, 10, 0), 0)", 1000, 3, around_0_3, ten_between},
    {"sign(sin(t/1[s]))", 1000 * 3.14159265358979323846 - 1e-3, 1000, multiples_of_pi, plus_or_minus},
    {"floor(t/0.1[s])", 100 - 1e-3, 1000, tenths, counted},
    {"round(t/0.1[s] - 0.5)", 100 - 1e-3, 1000, tenths, counted},
    {"ceil(t/0.1[s]) - 1", 100 - 1e-3, 1000, tenths, counted},
    /* One instant, rounded in three ways: a single event. */
    {"step(t - 0.3) + step(3*t - 0.9) + step(t/0.3[s] - 1)", 1, 2, around_0_3, three_at_0_3},
};

static void a_walk_meets_every_kink_once_whatever_its_stride(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scripts / sizeof scripts[0]; i++) {
        follow(&scripts[i], 0.05);
        follow(&scripts[i], 0.0137);
    }
}

/* The margins of a branch are smooth beyond its end, so a stride over many kinks still finds the first. A
 * sine, whose margin comes back, is the exception, as for any search by sign. */
static void a_long_stride_does_not_miss_a_kink(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scripts / sizeof scripts[0]; i++)
        if (!strstr(scripts[i].text, "sin")) follow(&scripts[i], 100);
}

static void coinciding_kinks_are_crossed_together(void **state)
{
    (void)state;
    struct trial trial =
        must_compile("step(t - 0.3) + step(3*t - 0.9) + step(t/0.3[s] - 1) + abs(t - 0.3)/1[s]");
    struct substeps walk = {.expr = trial.expr, .t = 0};
    int events = 0;
    expr_resolve(trial.expr, time_dd_at(0), NULL, 1, NULL, NULL, walk.branch);
    while (next_event(&walk, 0.1, 1)) events++;
    assert_int_equal(events, 1);
    end_trial(&trial);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_walk_meets_every_kink_once_whatever_its_stride),
        cmocka_unit_test(a_long_stride_does_not_miss_a_kink),
        cmocka_unit_test(coinciding_kinks_are_crossed_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
