/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What joints, ropes and wheels pass on: friction gives way, a surface is left and a rope goes slack where an
 * independent search says so, on a support that is moved by a sum of sines (waves.h), or under such a force.
 *
 * The acceleration of the support, less a threshold near or far from its extremes, is the function whose
 * first zero is wanted. The library knows it only as a force in a joint. 60 scenes of each kind are run;
 * FBD_EVENT_SCENES says how many instead (`make events`). A failure prints its seed, and FBD_EVENT_SEED runs
 * that seed alone.
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

#include "gallery.h"
#include "scenes.h"
#include "thorough.h"
#include "waves.h"

enum { text_size = 4000 };

static const double until = 6;

/* x(t) of the support, and its acceleration as a switching function. */
struct shaken {
    struct waves x, a;
    char text[text_size / 4];
};

static struct shaken random_shaking(struct random_numbers *numbers)
{
    struct shaken s = {.x = waves_random(numbers, along_time)};
    double size = 0;
    s.a = s.x;
    for (int k = 0; k < s.x.count; k++) {
        s.x.a[k] /= s.x.w[k] * s.x.w[k];
        s.a.a[k] = -s.x.a[k] * s.x.w[k] * s.x.w[k];
        size += fabs(s.a.a[k]);
    }
    waves_write(&s.x, "t", "1/s", s.text, sizeof s.text);
    /* One wave has its extremes at its size; gaps from 1e-12 to 1. */
    s.a.c = size * (1 - random_power(numbers, 1e-12, 0.99));
    return s;
}

static double first_zero(struct waves h, bool *doubtful)
{
    static struct zeros zeros;
    zeros.count = 0;
    zeros.doubtful = false;
    waves_find(&h, 0, until, &zeros);
    *doubtful |= zeros.doubtful;
    return zeros.count > 0 ? zeros.t[0] : HUGE_VAL;
}

static double start_of(const struct waves *h)
{
    double slope, most;
    return waves_value(h, 0, &slope, &most);
}

static struct waves opposite(struct waves h)
{
    for (int k = 0; k < h.count; k++) h.a[k] = -h.a[k];
    return h;
}

/* ---- scenes: each writes its text, and gives the time of the event; NAN to leave it out */

typedef double make_scene(struct shaken *s, char *text);

/* |a| = mu g */
static double friction_on_a_table(struct shaken *s, char *text)
{
    bool doubtful = false;
    struct waves back = opposite(s->a);
    snprintf(text, text_size,
             "  table: {mass: 1, motion: {slide: {x: \"1[m]*(%s)\"}}}\n"
             "  b: {mass: 1, motion: {slide: {on: table}}, forces: [gravity, normal, friction: %.17g]}\n",
             s->text, s->a.c);
    double t = fmin(first_zero(s->a, &doubtful), first_zero(back, &doubtful));
    return doubtful || start_of(&s->a) >= 0 || start_of(&back) >= 0 ? (double)NAN : t;
}

/* -a = g */
static double block_on_a_lift(struct shaken *s, char *text)
{
    bool doubtful = false;
    struct waves down = opposite(s->a);
    snprintf(text, text_size,
             "  lift: {mass: 1, motion: {slide: {along: 90 deg, x: \"1[m]*(%s)\"}}}\n"
             "  b: {mass: 1, motion: {slide: {on: lift, along: -90 deg}}, forces: [gravity, normal: {side: "
             "left}]}\n",
             s->text);
    double t = first_zero(down, &doubtful);
    return doubtful || start_of(&down) >= 0 ? (double)NAN : t;
}

static double load_on_a_rope(struct shaken *s, char *text)
{
    bool doubtful = false;
    double speed, most, place;
    struct waves down = opposite(s->a), x = s->x;
    x.c = 0;
    place = waves_value(&x, 0, &speed, &most);
    snprintf(
        text, text_size,
        "  lift: {mass: 1, motion: {slide: {along: 90 deg, x: \"1[m]*(%s)\"}}}\n"
        "  b: {mass: 1, motion: {slide: {along: 90 deg}}, initial: {x: %.17g, v: %.17g}, forces: [gravity]}\n"
        "couplings:\n  - rope: {name: r, through: [lift.G, b.G]}\n",
        s->text, place - 10, speed);
    double t = first_zero(down, &doubtful);
    return doubtful || start_of(&down) >= 0 ? (double)NAN : t;
}

/* A disc that a force F at its centre rolls needs the friction F/3: |F/3| = mu g. */
static double rolling_disc(struct shaken *s, char *text)
{
    bool doubtful = false;
    char force[text_size / 4];
    struct waves back = opposite(s->a);
    waves_write(&s->a, "t", "1/s", force, sizeof force);
    snprintf(
        text, text_size,
        "  b: {mass: 1, shape: disc, radius: 1, motion: planar, initial: {y: 1}, forces: [gravity, applied: "
        "{name: u, fx: \"3[N]*(%s)\", fy: 0}]}\n"
        "ground: {lines: {floor: {through: [0, 0], along: 0 deg}}}\n"
        "couplings:\n  - roll: {name: tread, body: b, on: floor, static: %.17g, kinetic: %.17g}\n",
        force, s->a.c, s->a.c);
    double t = fmin(first_zero(s->a, &doubtful), first_zero(back, &doubtful));
    return doubtful || start_of(&s->a) >= 0 || start_of(&back) >= 0 ? (double)NAN : t;
}

static const struct {
    const char *name;
    make_scene *make;
    fbd_event_kind kind;
    bool by_gravity; /* the threshold is g, else g is 1 */
} kinds[] = {
    {"friction on a table", friction_on_a_table, FBD_EVENT_BREAKAWAY, false},
    {"a block on a lift", block_on_a_lift, FBD_EVENT_CONTACT_LOST, true},
    {"a disc that rolls", rolling_disc, FBD_EVENT_BREAKAWAY, false},
    {"a load on a rope", load_on_a_rope, FBD_EVENT_ROPE_SLACK, true},
};

/* ---- the comparison */

static double first_event(const char *text, fbd_event_kind kind)
{
    fbd_model *model = model_from(text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    double t = HUGE_VAL;
    assert_non_null(simulation);
    for (bool going = true; going && t == HUGE_VAL;) {
        going = fbd_simulation_advance(simulation) == FBD_GOING;
        for (size_t i = 0; t == HUGE_VAL && i < fbd_simulation_event_count(simulation); i++)
            if (fbd_simulation_event(simulation, i).kind == kind) t = fbd_simulation_event(simulation, i).t;
    }
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return t;
}

/* A zero is as good as the forces are, over the slope; where a threshold is so near an extreme that this is
 * more than the time between zeros, none may be there. */
static bool same(const struct waves *a, double got, double want)
{
    const double rounding = 1e-13;
    double slope, most, size = fabs(a->c);
    if (want == HUGE_VAL || got == HUGE_VAL) return got == want;
    waves_value(a, want, &slope, &most);
    double near = fmin(rounding * size / fabs(slope), sqrt(rounding * size / most));
    return fabs(got - want) <= 256 * near + 64 * DBL_EPSILON * want;
}

static bool scene_agrees(size_t kind, uint64_t seed, size_t *compared)
{
    char scene[text_size], text[2 * text_size];
    struct random_numbers numbers = {seed};
    struct shaken s = random_shaking(&numbers);
    double tolerance = random_power(&numbers, 1e-12, 1e-4);
    double want = kinds[kind].make(&s, scene);
    if (isnan(want) || !(s.a.c > 1e-3)) return true;
    snprintf(text, sizeof text, "fbd: 1\ngravity: %.17g\nbodies:\n%ssimulate: {until: %g, tolerance: %g}\n",
             kinds[kind].by_gravity ? s.a.c : 1, scene, until, tolerance);
    ++*compared;
    double got = first_event(text, kinds[kind].kind);
    if (same(&s.a, got, want)) return true;
    print_error("seed %llu: %s: at %.17g instead of %.17g\n%s", (unsigned long long)seed, kinds[kind].name,
                got, want, text);
    return false;
}

static uint64_t number_from(const char *name, uint64_t otherwise)
{
    const char *text = getenv(name);
    return text ? strtoull(text, NULL, 10) : otherwise;
}

static void the_first_event_is_that_of_an_independent_search(void **unused)
{
    (void)unused;
    uint64_t scenes = number_from("FBD_EVENT_SCENES", (uint64_t)draws_of(60)),
             only = number_from("FBD_EVENT_SEED", 0);
    size_t wrong = 0, compared = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (uint64_t seed = 1; seed <= scenes; seed++)
            if (only == 0 || seed == only) wrong += !scene_agrees(k, seed, &compared);
    print_message("%zu scenes compared, %zu wrong\n", compared, wrong);
    assert_int_equal(wrong, 0);
}

/* A cart that stands still is pushed to where its rope is fixed, without weight; a disc rolls on it. The rope
 * goes slack at once, though all that its speed is measured against is the rounding of the start's
 * projection, and the disc stays on the cart, though nothing presses it there but rounding. Its friction
 * takes m/3 of it along: F = (M + m/3) a. */
static bool light_cart_agrees(uint64_t seed)
{
    struct random_numbers numbers = {seed};
    char text[text_size];
    double phi = random_between(&numbers, -3, 3), r = random_power(&numbers, 0.01, 1);
    double s = random_between(&numbers, -1, 1), v = random_between(&numbers, -2, 2);
    double M = random_power(&numbers, 0.1, 10), m = random_power(&numbers, 0.1, 10);
    double F = random_between(&numbers, 0.1, 5), theta = random_between(&numbers, -3, 3);
    snprintf(text, sizeof text,
             "fbd: 1\ngravity: 0\nground: {points: {Q: [%.17g, %.17g]}}\nbodies:\n"
             "  cart:\n    mass: %.17g\n    shape: point\n    motion: {slide: {along: %.17g}}\n"
             "    initial: {x: 0, v: 0}\n    forces: [applied: {name: push, value: %.17g}]\n"
             "  disc:\n    mass: %.17g\n    shape: disc\n    radius: %.17g\n    motion: {planar: {}}\n"
             "    initial: {x: %.17g, y: %.17g, theta: %.17g, vx: %.17g, vy: %.17g, omega: %.17g}\n"
             "couplings:\n  - rope: {name: rope, through: [cart, ground.Q]}\n"
             "  - roll: {name: roll, body: disc, on: cart}\nsimulate: {until: 0.5}\n",
             40 * cos(phi), 40 * sin(phi), M, phi, F, m, r, s * cos(phi) - r * sin(phi),
             s * sin(phi) + r * cos(phi), theta, v * cos(phi), v * sin(phi), -v / r);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double x = trial_get(&trial, "cart.x"), want = F / (M + m / 3) / 8;
    bool agrees = trial.outcome == FBD_DONE && fbd_simulation_event_count(trial.simulation) == 0 &&
                  fabs(x - want) < 1e-9 * want;
    if (!agrees)
        print_error("seed %llu: outcome %d, %zu events, x = %.17g instead of %.17g\n%s",
                    (unsigned long long)seed, (int)trial.outcome,
                    fbd_simulation_event_count(trial.simulation), x, want, text);
    trial_close(&trial);
    return agrees;
}

static void without_weight_rounding_holds_and_lifts_nothing(void **unused)
{
    (void)unused;
    uint64_t wrong = 0;
    for (uint64_t seed = 1; seed <= (uint64_t)draws_of(300); seed++) wrong += !light_cart_agrees(seed);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_event_is_that_of_an_independent_search),
        cmocka_unit_test(without_weight_rounding_holds_and_lifts_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
