/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Late in a run nothing is lost: pulses as short as one likes, and switches whose phase has few digits left,
 * on bodies whose motion is known in closed form. FBD_LATE_SCENES says how many random scenes of each kind; a
 * failure prints its seed.
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
#include "thorough.h"

enum { text_size = 1000 };

struct end {
    double x, v, work, residual;
};

static struct end end_of(const char *text)
{
    fbd_model *model = model_from(text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    assert_non_null(simulation);
    fbd_recording recording = {.ledger = true};
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    struct end end = {.work = fbd_result_work(result, "b", "u"),
                      .residual = fbd_result_energy(result).residual};
    if (fbd_result_outcome(result) != FBD_DONE)
        print_error("%s\n%s", fbd_simulation_reason(simulation), text);
    assert_true(fbd_state_get(fbd_result_state(result), "b.x", &end.x));
    assert_true(fbd_state_get(fbd_result_state(result), "b.v", &end.v));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return end;
}

static double power_between(struct random_numbers *numbers, double low, double high)
{
    return low * pow(high / low, random_between(numbers, 0, 1));
}

static bool near(const char *what, double got, double want, double most, const char *text)
{
    if (fabs(got - want) <= most) return true;
    print_error("%s: %.17g instead of %.17g (%.1e; allowed are %.1e)\n%s", what, got, want, got - want, most,
                text);
    return false;
}

/* ---- pulses: an impulse of 1 N s, however short, makes 1/m of velocity */

static const char *const forms[] = {
    "pulse(t, start, width)",
    "if(t > start and t - start < width, 1, 0)",
    "if(t > start and t < start + width, 1, 0)",
    "(step(t - start) - step((t - start)/width - 1))",
    "if(abs((t - start)/width - 0.5) < 0.5, 1, 0)",
};

enum bodies { block, oscillator, dragged, body_kinds };

/* A block, exact parabolas; an oscillator, exact linear steps; a block with drag, which is integrated. */
static const char *const loads[] = {"", ", spring: {stiffness: 2}", ", drag: {quadratic: 2}"};

static struct end pulsed(enum bodies kind, double after, double width)
{
    /* m = 2: v = 1/2, x'' = -x for the spring, v' = -v^2 for the drag. The mean place of a pulse is its
     * middle. */
    const double v = 0.5, s = after + width / 2;
    switch (kind) {
    case block: return (struct end){.x = v * s, .v = v};
    case oscillator: {
        double half = width / 2, sinc = half > 1e-4 ? sin(half) / half : 1 - half * half / 6;
        return (struct end){.x = v * sinc * sin(s), .v = v * sinc * cos(s)};
    }
    default: return (struct end){.x = log1p(v * s), .v = v / (1 + v * s)};
    }
}

static bool a_pulse_is_whole(uint64_t seed)
{
    const double latest = 1e6;
    struct random_numbers numbers = {seed};
    enum bodies kind = (enum bodies)(random_bits(&numbers) % body_kinds);
    const char *form = forms[random_bits(&numbers) % (sizeof forms / sizeof *forms)];
    double start = power_between(&numbers, 1, kind == oscillator ? 1e4 : latest),
           after = random_between(&numbers, 1, 20);
    /* With drag what is lost while the pulse is on goes with its width. */
    double width = power_between(&numbers, 1e-15, kind == dragged ? 1e-9 : 0.1);
    double until = start + after;
    after = (until - start) - width;
    char text[text_size];
    snprintf(
        text, sizeof text,
        "fbd: 1\nparameters: {start: %.17g s, width: %.17g s}\nbodies:\n  b: {mass: 2, motion: slide, "
        "forces: "
        "[applied: {name: u, value: \"1[N*s]/width*%s\"}%s]}\nsimulate: {until: %.17g s, tolerance: 1e-12}\n",
        start, width, form, loads[kind], until);
    struct end got = end_of(text), want = pulsed(kind, after, width);
    double room = kind == dragged ? 1e-10 : 8 * DBL_EPSILON * (1 + after), work = 0.25;
    bool good = near("v", got.v, want.v, room + 2 * DBL_EPSILON, text);
    good = near("x", got.x, want.x, 8 * room, text) && good;
    /* Half of the work is done in the second half of the pulse: looked at with its own digits. */
    return near("work", got.work, work, (kind == oscillator ? width * width : 1e-8) + 1e-13, text) && good;
}

static uint64_t number_from(const char *name, uint64_t otherwise)
{
    const char *text = getenv(name);
    return text ? strtoull(text, NULL, 10) : otherwise;
}

static void short_pulses_are_whole_late_in_a_run(void **unused)
{
    (void)unused;
    size_t wrong = 0;
    for (uint64_t seed = 1; seed <= number_from("FBD_LATE_SCENES", (uint64_t)draws_of(200)); seed++)
        if (!a_pulse_is_whole(seed)) print_error("seed %llu\n", (unsigned long long)seed), wrong++;
    assert_int_equal(wrong, 0);
}

/* ---- phases: a force that is on while a wave is high, seen late only. Its time is summed up in long
 * doubles. */

static bool a_wave_keeps_its_phase(uint64_t seed)
{
    struct random_numbers numbers = {seed};
    const double late = floor(power_between(&numbers, 1e3, 1e6)), span = 5,
                 w = random_between(&numbers, 3, 30);
    const long double pi = acosl(-1), c = random_between(&numbers, -0.9, 0.9);
    int kind = (int)(random_bits(&numbers) % 3);
    char wave[200], text[text_size];
    long double period, first, length; /* on from `first` + k period for `length` */
    if (kind == 0) {                   /* sin(w t) > c */
        snprintf(wave, sizeof wave, "if(sin(%.17g[rad/s]*t) > %.17g, 1, 0)", w, (double)c);
        period = 2 * pi / (long double)w, first = asinl(c) / (long double)w,
        length = (pi - 2 * asinl(c)) / (long double)w;
    } else if (kind == 1) {
        snprintf(wave, sizeof wave, "if(cos(2*pi*t/%.17g[s]) > 0, 1, 0)", 1 / w);
        period = (long double)(1 / w), first = -period / 4, length = period / 2;
    } else {
        snprintf(wave, sizeof wave, "if(mod(t, %.17g[s]) < %.17g[s], 1, 0)", 1 / w, 0.25 / w);
        period = (long double)(1 / w), first = 0, length = (long double)(0.25 / w);
    }
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n  b: {mass: 1, motion: slide, forces: [applied: {name: u, value: "
             "\"if(t > %.17g[s], 1[N]*%s, 0[N])\"}]}\nsimulate: {until: %.17g s}\n",
             late, wave, late + span);
    long double v = 0, x = 0, from = (long double)late, to = from + span;
    for (long double k = floorl((from - first) / period) - 1; first + k * period < to; k++) {
        long double a = fmaxl(first + k * period, from), b = fminl(first + k * period + length, to);
        if (b > a) v += b - a, x += (b - a) * (to - (a + b) / 2);
    }
    struct end got = end_of(text);
    /* A switching function rounds by eps, and with it each of its zeros; a long double has 64 bits for
     * `late`. */
    double room =
        3 * w * (8 * DBL_EPSILON / sqrt(1 - (double)(c * c)) / w + 2 * (double)LDBL_EPSILON * late) +
        64 * DBL_EPSILON;
    bool speed = near("v", got.v, (double)v, room, text);
    return near("x", got.x, (double)x, room * span, text) && speed;
}

static void waves_keep_their_phase_late_in_a_run(void **unused)
{
    (void)unused;
    size_t wrong = 0;
    if (LDBL_MANT_DIG < 64) skip();
    for (uint64_t seed = 1; seed <= number_from("FBD_LATE_SCENES", (uint64_t)draws_of(200)); seed++)
        if (!a_wave_keeps_its_phase(seed)) print_error("seed %llu\n", (unsigned long long)seed), wrong++;
    assert_int_equal(wrong, 0);
}

/* ---- many switches: FBD_MANY_SWITCHES of them (`make late-times`: a million) */

/* Up and down by a square wave, v = a p or a (T - p), in each period of which x grows by a T^2/4. */
static void a_block_is_where_many_switches_have_brought_it(void **unused)
{
    (void)unused;
    const long double T = (long double)0.7, a = (long double)1.1 / 3;
    double until = (double)number_from("FBD_MANY_SWITCHES", 20000) * 0.35 + 0.1;
    char text[text_size];
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n  b: {mass: 3, motion: slide, forces: [applied: {name: u, value: "
             "\"1.1[N]*square(t/0.7[s])\"}]}\nsimulate: {until: %.17g s}\n",
             until);
    long double n = floorl((long double)until / T), p = (long double)until - n * T, rest = T - p;
    bool rises = p < T / 2;
    long double x = n * a * T * T / 4 + (rises ? a * p * p / 2 : a * T * T / 4 - a * rest * rest / 2);
    struct end got = end_of(text);
    assert_true(near("v", got.v, (double)(rises ? a * p : a * rest), 1e-12, text));
    assert_true(near("x", got.x, (double)x, 1e-12 * (double)x, text));
}

/* Each half period of the wave turns the state about +1 or -1 by half a radian. */
static void an_oscillator_is_where_many_switches_have_brought_it(void **unused)
{
    (void)unused;
    uint64_t switches = number_from("FBD_MANY_SWITCHES", 20000);
    char text[text_size];
    snprintf(
        text, sizeof text,
        "fbd: 1\nbodies:\n  b: {mass: 1, motion: slide, forces: [spring: {stiffness: 1}, applied: {name: u, "
        "value: \"1[N]*square(t/1[s])\"}]}\nsimulate: {until: %.17g s}\n",
        0.5 * (double)switches);
    const long double c = cosl(0.5L), s = sinl(0.5L);
    long double x = 0, v = 0, F = 1;
    for (uint64_t k = 0; k < switches; k++, F = -F) {
        long double d = x - F;
        x = F + d * c + v * s;
        v = v * c - d * s;
    }
    struct end got = end_of(text);
    bool place = near("x", got.x, (double)x, 1e-12, text);
    assert_true(near("v", got.v, (double)v, 1e-12, text) && place);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(short_pulses_are_whole_late_in_a_run),
        cmocka_unit_test(waves_keep_their_phase_late_in_a_run),
        cmocka_unit_test(a_block_is_where_many_switches_have_brought_it),
        cmocka_unit_test(an_oscillator_is_where_many_switches_have_brought_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
