/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * No switch is lost and none is invented: the list of events of random scenes against one found by other
 * means.
 *
 * A switching function h(t) = sum_k a_k sin(w_k x(t) + p_k) - c along a motion x(t) known in closed form has
 * |h''| <= M with M from the amplitudes alone. On [m - r, m + r] it has no zero where |h(m)| > |h'(m)| r + M
 * r^2/2, and at most one where |h'(m)| > M r. Halving until one of both holds finds every zero.
 *
 * 100 scenes of each kind are run; FBD_EVENT_SCENES says how many instead (`make events`: 10,000 in all). A
 * failure prints its seed, and FBD_EVENT_SEED runs that seed alone.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "random_numbers.h"
#include "scenes.h"

enum { most_waves = 3, most_zeros = 4096, text_size = 2000 };

static const double until = 6;

/* ---- switching functions in closed form */

enum course { along_time, along_coast, along_oscillation };

struct waves {
    int count;
    double a[most_waves], w[most_waves], p[most_waves], c;
    enum course course;
    double speed; /* of the coast; of the oscillation x = cos(speed t) */
};

/* x(t), its first derivative, and bounds of the first two. */
static double place(const struct waves *h, double t, double *rate, double *first, double *second)
{
    if (h->course == along_oscillation) {
        *rate = -h->speed * sin(h->speed * t);
        *first = h->speed;
        *second = h->speed * h->speed;
        return cos(h->speed * t);
    }
    *rate = *first = h->course == along_time ? 1 : h->speed;
    *second = 0;
    return *rate * t;
}

static double value(const struct waves *h, double t, double *slope, double *most)
{
    double rate, first, second, x = place(h, t, &rate, &first, &second), sum = -h->c;
    *slope = *most = 0;
    for (int k = 0; k < h->count; k++) {
        double phase = h->w[k] * x + h->p[k], a = fabs(h->a[k]);
        sum += h->a[k] * sin(phase);
        *slope += h->a[k] * h->w[k] * cos(phase) * rate;
        *most += a * h->w[k] * (h->w[k] * first * first + second);
    }
    return sum;
}

struct zeros {
    size_t count;
    double t[most_zeros];
    bool doubtful; /* a zero that rounding does not tell from none */
};

static double bisect(const struct waves *h, double low, double high)
{
    double slope, most, sign = value(h, low, &slope, &most) < 0 ? -1 : 1;
    for (int k = 0; k < 200; k++) {
        double m = low + (high - low) / 2;
        if (!(m > low && m < high)) break;
        if (sign * value(h, m, &slope, &most) > 0)
            low = m;
        else
            high = m;
    }
    return high;
}

static void find(const struct waves *h, double low, double high, struct zeros *zeros)
{
    double r = (high - low) / 2, m = low + r, slope, most, s, b;
    double v = value(h, m, &slope, &most);
    if (fabs(v) > fabs(slope) * r + most * r * r / 2 + 1e-14) return;
    if (fabs(slope) > most * r * (1 + 1e-9)) {
        double from = value(h, low, &s, &b), to = value(h, high, &s, &b);
        zeros->doubtful |= fabs(from) < 1e-14 || fabs(to) < 1e-14;
        if ((from < 0) != (to < 0) && zeros->count < most_zeros)
            zeros->t[zeros->count++] = bisect(h, low, high);
        return;
    }
    if (r < 1e-11) {
        zeros->doubtful = true;
        return;
    }
    find(h, low, m, zeros);
    find(h, m, high, zeros);
}

/* ---- random scenes */

static double power_between(struct random_numbers *numbers, double low, double high)
{
    return low * pow(high / low, random_between(numbers, 0, 1));
}

/* Thresholds near the crest of one wave, by gaps from 1e-10 to 1, or anywhere. */
static struct waves random_waves(struct random_numbers *numbers, enum course course)
{
    struct waves h = {.course = course, .count = 1 + (int)(random_bits(numbers) % most_waves)};
    h.speed = random_between(numbers, 0.5, 4);
    for (int k = 0; k < h.count; k++) {
        h.a[k] = k == 0 ? 1 : random_between(numbers, -1, 1);
        h.w[k] = power_between(numbers, 0.5, course == along_time ? 100 : 12);
        h.p[k] = random_between(numbers, -3, 3);
    }
    double gap = power_between(numbers, 1e-10, 1);
    bool crest = h.count == 1 && course == along_time;
    h.c = crest ? (random_bits(numbers) % 2 ? 1 - gap : -1 + gap) : random_between(numbers, -1, 1);
    return h;
}

static int write_waves(const struct waves *h, const char *argument, const char *unit, char *text, size_t size)
{
    int length = 0;
    for (int k = 0; k < h->count; k++)
        length += snprintf(text + length, size - (size_t)length, "%s(%.17g)*sin(%.17g[%s]*%s + (%.17g))",
                           k ? " + " : "", h->a[k], h->w[k], unit, argument, h->p[k]);
    return length;
}

/* What is run: `kind` of switch on a body. */
struct setting {
    const char *name, *body, *load;
    enum course course;
    bool user;
};

static const struct setting settings[] = {
    {"if on a free body", "mass: 1, motion: slide",
     "applied: {name: u, value: \"if(%s > %.17g, 1[N], 0.2[N])\"}", along_time, false},
    {"max on a free body", "mass: 1, motion: slide", "applied: {name: u, value: \"1[N]*max(%s, %.17g)\"}",
     along_time, false},
    {"abs on a free body", "mass: 1, motion: slide", "applied: {name: u, value: \"1[N]*abs(%s - (%.17g))\"}",
     along_time, false},
    {"sign on a body that sticks", "mass: 1, motion: slide",
     "gravity, normal, friction: 2, applied: {name: u, value: \"1[N]*sign(%s - (%.17g))\"}", along_time,
     false},
    {"step on a pendulum at rest", "mass: 1, inertia: 1, center: [0, -1], motion: {pivot: {at: [0, 0]}}",
     "gravity], moments: [friction: 50, applied: {name: u, value: \"1[N*m]*step(%s - (%.17g))\"}", along_time,
     false},
    {"a user event of a coast", "mass: 1, motion: slide, initial: {v: %.17g}", "%s = %.17g", along_coast,
     true},
    {"a user event of an oscillation", "mass: 1, motion: slide, initial: {x: 1}", "%s = %.17g",
     along_oscillation, true},
};

static void write_scene(const struct setting *setting, const struct waves *h, double tolerance, char *text)
{
    char wave[text_size / 4], load[text_size / 2], body[text_size / 8];
    bool time = h->course == along_time;
    write_waves(h, time ? "t" : "b.x", time ? "1/s" : "1/m", wave, sizeof wave);
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    snprintf(load, sizeof load, setting->load, wave, h->c);
    snprintf(body, sizeof body, setting->body, h->speed);
#pragma GCC diagnostic pop
    char spring[text_size / 8] = "";
    if (h->course == along_oscillation)
        snprintf(spring, sizeof spring, "spring: {stiffness: %.17g}", h->speed * h->speed);
    if (setting->user)
        snprintf(text, text_size,
                 "fbd: 1\nbodies:\n  b: {%s, forces: [%s]}\nsimulate: {until: %g, tolerance: %g, events: "
                 "[{name: e, "
                 "when: \"%s\"}]}\n",
                 body, spring, until, tolerance, load);
    else
        snprintf(text, text_size,
                 "fbd: 1\nbodies:\n  b: {%s, forces: [%s]}\nsimulate: {until: %g, tolerance: %g}\n", body,
                 load, until, tolerance);
}

/* ---- the comparison */

static size_t list_of(const char *text, bool user, double *t)
{
    fbd_model *model = model_from(text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    assert_non_null(simulation);
    while (fbd_simulation_advance(simulation) == FBD_GOING) {
    }
    size_t count = 0, events = fbd_simulation_events(simulation);
    for (size_t i = 0; i < events; i++) {
        fbd_event event = fbd_simulation_event(simulation, i);
        bool counts = event.kind == (user ? FBD_EVENT_USER : FBD_EVENT_SWITCH);
        if (counts && count < most_zeros) t[count++] = event.t;
    }
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return count;
}

/* The zeros of h, and of h moved up and down by the width of the band within which the errors of a method
 * decide (watchers.h). */
struct expected {
    struct zeros at, above, below;
};

static bool find_expected(struct waves h, double room, struct expected *expected)
{
    struct zeros *all[] = {&expected->at, &expected->above, &expected->below};
    double shift[] = {0, room, -room}, c = h.c;
    for (int k = 0; k < 3; k++) {
        all[k]->count = 0;
        all[k]->doubtful = false;
        h.c = c + shift[k];
        find(&h, 0, until, all[k]);
        if (all[k]->doubtful || all[k]->count != expected->at.count) return false;
    }
    return true;
}

/* A zero is as good as the function is, over its slope. */
static bool same(const struct waves *h, double got, const struct expected *expected, size_t i)
{
    const double rounding = 1e-13;
    double slope, most, want = expected->at.t[i];
    value(h, want, &slope, &most);
    double near = fmin(rounding / fabs(slope), sqrt(rounding / most));
    double band = fmax(fabs(expected->above.t[i] - want), fabs(expected->below.t[i] - want));
    return fabs(got - want) <= 64 * near + 64 * DBL_EPSILON * want + band;
}

static bool scene_agrees(const struct setting *setting, uint64_t seed)
{
    static struct expected expected;
    static double got[most_zeros];
    const double bands = 25; /* in tolerances: 10 of them, and the error of the method */
    struct random_numbers numbers = {seed};
    char text[text_size];
    struct waves h = random_waves(&numbers, setting->course);
    double tolerance = power_between(&numbers, 1e-13, 1e-4), size = fabs(h.c);
    for (int k = 0; k < h.count; k++) size += fabs(h.a[k]);
    if (!find_expected(h, setting->user ? bands * tolerance * size : 0, &expected)) return true;
    write_scene(setting, &h, tolerance, text);
    size_t count = list_of(text, setting->user, got), first = 0, wanted = expected.at.count;
    while (first < count && first < wanted && same(&h, got[first], &expected, first)) first++;
    if (first == count && count == wanted) return true;
    print_error("seed %llu: %s: %zu events instead of %zu; number %zu at %.17g instead of %.17g\n%s",
                (unsigned long long)seed, setting->name, count, wanted, first,
                first < count ? got[first] : (double)NAN, first < wanted ? expected.at.t[first] : (double)NAN,
                text);
    return false;
}

static uint64_t number_from(const char *name, uint64_t otherwise)
{
    const char *text = getenv(name);
    return text ? strtoull(text, NULL, 10) : otherwise;
}

static void lists_of_switches_are_those_of_an_independent_search(void **unused)
{
    (void)unused;
    uint64_t scenes = number_from("FBD_EVENT_SCENES", 100), only = number_from("FBD_EVENT_SEED", 0);
    size_t wrong = 0;
    for (size_t k = 0; k < sizeof settings / sizeof *settings; k++)
        for (uint64_t seed = 1; seed <= scenes; seed++)
            if (only == 0 || seed == only) wrong += !scene_agrees(&settings[k], seed);
    assert_int_equal(wrong, 0);
}

/* ---- what was lost before */

static double velocity_at_end(const char *text)
{
    fbd_model *model = model_from(text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    assert_non_null(simulation);
    fbd_recording recording = {0};
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    double v;
    assert_true(fbd_state_get(fbd_result_state(result), "b.v", &v));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return v;
}

/* A rectified sine gives 2/w in each of its half waves. */
static void no_pulse_of_a_rectified_sine_is_lost(void **unused)
{
    (void)unused;
    for (int w = 5; w <= 72; w++) {
        char text[text_size];
        snprintf(
            text, sizeof text,
            "fbd: 1\nbodies:\n  b: {mass: 1, motion: slide, forces: [applied: {name: u, value: \"max(0[N], "
            "1[N]*sin(%d[rad/s]*t))\"}]}\nsimulate: {until: 10 s}\n",
            w);
        double turn = 2 * acos(-1), turns = floor(10 * w / turn), rest = 10 * w - turns * turn;
        double last = rest > turn / 2 ? 2 : 1 - cos(rest), v = (2 * turns + last) / w;
        if (!(fabs(velocity_at_end(text) - v) <= 1e-11)) fail_msg("w = %d: %.17g", w, velocity_at_end(text));
    }
}

static const char narrow_peak[] =
    "fbd: 1\nbodies:\n  b: {mass: 1, motion: slide, forces: [gravity, normal, friction: {static: 0.5, "
    "kinetic: "
    "0.5}, applied: {name: u, value: \"4.921274779[N]*sin(19.303110999236644[rad/s]*t + 0.697)\"}]}\n"
    "simulate: {until: 5 s}\n";
/* The same push on a block that lies on another one. */
static const char joined_peak[] =
    "fbd: 1\nbodies:\n  a: {mass: 1, motion: {slide: {along: 0}}, forces: [gravity, normal, friction: 2]}\n"
    "  b: {mass: 1, motion: {slide: {on: a, along: 0}}, forces: [gravity, normal, friction: {static: 0.5, "
    "kinetic: 0.5}, applied: {name: u, value: \"4.921274779[N]*sin(19.303110999236644[rad/s]*t + "
    "0.697)\"}]}\n"
    "simulate: {until: 5 s}\n";
static const char branch_in_force[] =
    "fbd: 1\nbodies:\n  b: {mass: 1, motion: slide, forces: [gravity, normal, friction: {static: 0.5, "
    "kinetic: "
    "0.3}, applied: {name: u, value: \"if(sin(40.86053500086608[rad/s]*t) > 0.3, 1.665538212719631[N/s]*t, "
    "1.665538212719631[N/s]*t + 0.2[N])\"}]}\nsimulate: {until: 3.19 s}\n";

static double first_breakaway(const char *text)
{
    fbd_model *model = model_from(text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    double t = NAN;
    assert_non_null(simulation);
    while (isnan(t) && fbd_simulation_advance(simulation) == FBD_GOING)
        for (size_t i = 0; isnan(t) && i < fbd_simulation_events(simulation); i++) {
            fbd_event event = fbd_simulation_event(simulation, i);
            if (event.kind == FBD_EVENT_BREAKAWAY) t = event.t;
        }
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return t;
}

static void friction_gives_way_where_its_limit_is_passed(void **unused)
{
    (void)unused;
    const double limit = 0.5 * 9.81;
    double peak = (asin(limit / 4.921274779) - 0.697) / 19.303110999236644;
    assert_true(fabs(first_breakaway(narrow_peak) - peak) <= 1e-12);
    assert_true(fabs(first_breakaway(joined_peak) - peak) <= 1e-12);
    /* The branch with 0.2 N more comes back where sin(w t) falls to 0.3: the 19th wave. */
    double turn = 2 * acos(-1), change = (18 * turn + turn / 2 - asin(0.3)) / 40.86053500086608;
    assert_true(1.665538212719631 * change + 0.2 > limit && 1.665538212719631 * change < limit);
    assert_true(fabs(first_breakaway(branch_in_force) - change) <= 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_of_switches_are_those_of_an_independent_search),
        cmocka_unit_test(no_pulse_of_a_rectified_sine_is_lost),
        cmocka_unit_test(friction_gives_way_where_its_limit_is_passed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
