/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * No switch is lost and none is invented: the list of events of random scenes against one found by other
 * means.
 *
 * Scenes are made of switching functions whose zeros are all found by bounds of their second derivative
 * (waves.h). 60 scenes of each kind are run; FBD_EVENT_SCENES says how many instead (`make events`). A
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

#include "scenes.h"
#include "thorough.h"
#include "waves.h"

enum { most_levels = 64, text_size = 4000 };

static const double until = 6;

/* ---- random scenes */

/* What is run, and where events are to be: h passes one of the levels, of which its own c is the first. */
struct scene {
    struct waves h;
    double levels[most_levels];
    size_t level_count;
    bool user;
    double tolerance;
    char body[text_size], load[text_size], simulate[text_size];
};

typedef void make_scene(struct random_numbers *numbers, struct scene *scene);

static void on_a_free_body(struct scene *scene)
{
    snprintf(scene->body, text_size, "mass: 1, motion: slide, forces: [");
}

/* The wave as it is written, with an argument of its course. */
static const char *wave_of(const struct scene *scene)
{
    static char text[text_size / 4];
    bool time = scene->h.trajectory == along_time;
    waves_write(&scene->h, time ? "t" : "b.x", time ? "1/s" : "1/m", text, sizeof text);
    return text;
}

static void one_level(struct scene *scene)
{
    scene->levels[0] = scene->h.c;
    scene->level_count = 1;
}

static void if_on_a_free_body(struct random_numbers *numbers, struct scene *scene)
{
    scene->h = waves_random(numbers, along_time);
    one_level(scene);
    on_a_free_body(scene);
    snprintf(scene->load, text_size, "applied: {name: u, value: \"if(%s > %.17g, 1[N], 0.2[N])\"}",
             wave_of(scene), scene->h.c);
}

static void max_of_a_force_of_any_step(struct random_numbers *numbers, struct scene *scene)
{
    scene->h = waves_random(numbers, along_time);
    one_level(scene);
    on_a_free_body(scene);
    snprintf(scene->load, text_size, "applied: {name: u, value: \"1[N]*max(%s, %.17g)\"}", wave_of(scene),
             scene->h.c);
    snprintf(scene->simulate, text_size, ", method: rk4, step: %g", random_power(numbers, 1e-3, 3));
}

static void abs_by_every_method(struct random_numbers *numbers, struct scene *scene)
{
    static const char *const methods[] = {"dop853", "rk8pd", "rkf45", "rkck", "rk4", "rodas5p", "bsimp"};
    scene->h = waves_random(numbers, along_time);
    one_level(scene);
    on_a_free_body(scene);
    snprintf(scene->load, text_size, "applied: {name: u, value: \"1[N]*abs(%s - (%.17g))\"}", wave_of(scene),
             scene->h.c);
    snprintf(scene->simulate, text_size, ", method: %s",
             methods[random_bits(numbers) % (sizeof methods / sizeof *methods)]);
}

static void sign_on_a_body_that_sticks(struct random_numbers *numbers, struct scene *scene)
{
    scene->h = waves_random(numbers, along_time);
    one_level(scene);
    on_a_free_body(scene);
    snprintf(scene->load, text_size,
             "gravity, normal, friction: 2, applied: {name: u, value: \"1[N]*sign(%s - (%.17g))\"}",
             wave_of(scene), scene->h.c);
}

static void step_on_a_pendulum_at_rest(struct random_numbers *numbers, struct scene *scene)
{
    scene->h = waves_random(numbers, along_time);
    one_level(scene);
    snprintf(
        scene->body, text_size,
        "mass: 1, inertia: 1, center: [0, -1], motion: {pivot: {at: [0, 0]}}, forces: [gravity], moments: "
        "[friction: 50, ");
    snprintf(scene->load, text_size, "applied: {name: u, value: \"1[N*m]*step(%s - (%.17g))\"}",
             wave_of(scene), scene->h.c);
}

/* All whole multiples of a step that h can reach. */
static double many_levels(struct random_numbers *numbers, struct scene *scene)
{
    double size = 0, step = random_between(numbers, 0.1, 0.7);
    for (int k = 0; k < scene->h.count; k++) size += fabs(scene->h.a[k]);
    for (double n = ceil(-size / step); n * step <= size && scene->level_count < most_levels; n++)
        scene->levels[scene->level_count++] = n * step;
    return step;
}

static void floor_of_a_wave(struct random_numbers *numbers, struct scene *scene)
{
    scene->h = waves_random(numbers, along_time);
    double step = many_levels(numbers, scene);
    on_a_free_body(scene);
    snprintf(scene->load, text_size, "applied: {name: u, value: \"1[N]*floor((%s)/%.17g)\"}", wave_of(scene),
             step);
}

static void mod_of_a_wave(struct random_numbers *numbers, struct scene *scene)
{
    scene->h = waves_random(numbers, along_time);
    double step = many_levels(numbers, scene);
    on_a_free_body(scene);
    snprintf(scene->load, text_size, "applied: {name: u, value: \"1[N]*mod(%s, %.17g)\"}", wave_of(scene),
             step);
}

/* A table of three straight pieces. */
static void clamp_of_a_wave(struct random_numbers *numbers, struct scene *scene)
{
    scene->h = waves_random(numbers, along_time);
    scene->levels[0] = -0.3;
    scene->levels[1] = random_between(numbers, 0, 1);
    scene->level_count = 2;
    on_a_free_body(scene);
    snprintf(scene->load, text_size, "applied: {name: u, value: \"1[N]*clamp(%s, -0.3, %.17g)\"}",
             wave_of(scene), scene->levels[1]);
}

/* min(f, g) passes where f - g does. */
static void min_of_two_waves(struct random_numbers *numbers, struct scene *scene)
{
    char first[text_size / 4];
    struct waves f = waves_random(numbers, along_time);
    scene->h = f;
    snprintf(first, sizeof first, "%s", wave_of(scene));
    scene->h = waves_random(numbers, along_time);
    on_a_free_body(scene);
    snprintf(scene->load, text_size, "applied: {name: u, value: \"1[N]*min(%s, %s)\"}", first,
             wave_of(scene));
    for (int k = 0; k < f.count; k++) {
        int to = scene->h.count++;
        scene->h.a[to] = -f.a[k], scene->h.w[to] = f.w[k], scene->h.p[to] = f.p[k];
    }
    scene->h.c = 0;
    one_level(scene);
}

/* sin a sin b = (cos(a - b) - cos(a + b))/2 */
static void product_of_two_waves(struct random_numbers *numbers, struct scene *scene)
{
    const double quarter = acos(0);
    struct waves f = waves_random(numbers, along_time), *h = &scene->h;
    double v = random_power(numbers, 0.5, 100), q = random_between(numbers, -3, 3);
    *h = (struct waves){.trajectory = along_time, .count = 2, .c = random_between(numbers, -1, 1)};
    h->a[0] = 0.5, h->w[0] = f.w[0] - v, h->p[0] = f.p[0] - q + quarter;
    h->a[1] = -0.5, h->w[1] = f.w[0] + v, h->p[1] = f.p[0] + q + quarter;
    one_level(scene);
    on_a_free_body(scene);
    snprintf(
        scene->load, text_size,
        "applied: {name: u, value: \"if(sin(%.17g[1/s]*t + (%.17g))*sin(%.17g[1/s]*t + (%.17g)) > %.17g, "
        "1[N], 0.2[N])\"}",
        f.w[0], f.p[0], v, q, h->c);
}

/* ---- with user events */

static void oscillate(struct scene *scene)
{
    snprintf(scene->body, text_size,
             "mass: 1, motion: slide, initial: {x: 1}, forces: [spring: {stiffness: %.17g}",
             scene->h.speed * scene->h.speed);
    scene->user = true;
}

static void when(struct scene *scene, const char *what)
{
    snprintf(scene->simulate, text_size, ", events: [{name: e, when: \"%s = %.17g\"}]", what, scene->h.c);
    one_level(scene);
}

static void place_in_a_coast(struct random_numbers *numbers, struct scene *scene)
{
    scene->h = waves_random(numbers, along_coast);
    scene->user = true;
    snprintf(scene->body, text_size, "mass: 1, motion: slide, initial: {v: %.17g}, forces: [",
             scene->h.speed);
    when(scene, wave_of(scene));
}

static void place_in_an_oscillation(struct random_numbers *numbers, struct scene *scene)
{
    scene->h = waves_random(numbers, along_oscillation);
    oscillate(scene);
    when(scene, wave_of(scene));
}

/* v = -s sin(s t) */
static void speed_in_an_oscillation(struct random_numbers *numbers, struct scene *scene)
{
    double s = random_between(numbers, 0.5, 4), gap = random_power(numbers, 1e-3, 1);
    scene->h = (struct waves){
        .trajectory = along_time, .count = 1, .a = {-s}, .w = {s}, .c = s * (1 - gap), .speed = s};
    oscillate(scene);
    when(scene, "b.v/1[m/s]");
}

/* v^2/2 = s^2/4 (1 - cos(2 s t)) */
static void energy_of_an_oscillation(struct random_numbers *numbers, struct scene *scene)
{
    double s = random_between(numbers, 0.5, 4), q = s * s / 4;
    struct waves *h = &scene->h;
    *h = (struct waves){
        .trajectory = along_time, .count = 1, .a = {-q}, .w = {2 * s}, .p = {acos(0)}, .speed = s};
    h->c = random_between(numbers, 0.05, 1.95) * q;
    oscillate(scene);
    when(scene, "0.5*b.v^2/1[m^2/s^2]");
    h->c -= q;
    one_level(scene);
}

static const struct {
    const char *name;
    make_scene *make;
} kinds[] = {
    {"if on a free body", if_on_a_free_body},
    {"max with a fixed step", max_of_a_force_of_any_step},
    {"abs by every method", abs_by_every_method},
    {"sign on a body that sticks", sign_on_a_body_that_sticks},
    {"step on a pendulum at rest", step_on_a_pendulum_at_rest},
    {"floor", floor_of_a_wave},
    {"mod", mod_of_a_wave},
    {"clamp", clamp_of_a_wave},
    {"min", min_of_two_waves},
    {"product", product_of_two_waves},
    {"place in a coast", place_in_a_coast},
    {"place in an oscillation", place_in_an_oscillation},
    {"speed in an oscillation", speed_in_an_oscillation},
    {"energy of an oscillation", energy_of_an_oscillation},
};

/* ---- the comparison */

static size_t list_of(const char *text, bool user, double *t)
{
    fbd_model *model = model_from(text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    assert_non_null(simulation);
    while (fbd_simulation_advance(simulation) == FBD_GOING) {
    }
    size_t count = 0, events = fbd_simulation_event_count(simulation);
    for (size_t i = 0; i < events; i++) {
        fbd_event event = fbd_simulation_event(simulation, i);
        bool counts = event.kind == (user ? FBD_EVENT_USER : FBD_EVENT_SWITCH);
        if (counts && count < most_zeros) t[count++] = event.t;
    }
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return count;
}

/* An event, and by how much its time may be off. */
struct expected {
    double t, room;
};

static int by_time(const void *a, const void *b)
{
    const struct expected *first = a, *second = b;
    return first->t < second->t ? -1 : first->t > second->t;
}

/* The zeros of h at one level, and of h moved up and down by the width of the band within which the errors of
 * a method decide (watchers.h): false where their number differs. A zero is as good as the function is, over
 * its slope. */
static bool add_level(struct waves h, double level, double band, struct expected *expected, size_t *count)
{
    static struct zeros all[3];
    const double rounding = 1e-13, shift[] = {0, band, -band};
    for (int k = 0; k < 3; k++) {
        all[k] = (struct zeros){.count = 0};
        h.c = level + shift[k];
        waves_find(&h, 0, until, &all[k]);
        if (all[k].doubtful || all[k].count != all[0].count) return false;
    }
    for (size_t i = 0; i < all[0].count && *count < most_zeros; i++) {
        double slope, most, t = all[0].t[i];
        h.c = level;
        waves_value(&h, t, &slope, &most);
        double near = fmin(rounding / fabs(slope), sqrt(rounding / most));
        double late = fmax(fabs(all[1].t[i] - t), fabs(all[2].t[i] - t));
        expected[(*count)++] = (struct expected){t, 64 * near + 64 * DBL_EPSILON * t + late};
    }
    return true;
}

static void write_scene(const struct scene *scene, char *text)
{
    bool inner = scene->load[0] != 0;
    snprintf(text, 4 * text_size, "fbd: 1\nbodies:\n  b: {%s%s]}\nsimulate: {until: %g, tolerance: %g%s}\n",
             scene->body, inner ? scene->load : "", until, scene->tolerance, scene->simulate);
}

static bool scene_agrees(size_t kind, uint64_t seed, size_t *compared)
{
    static struct expected expected[most_zeros];
    static double got[most_zeros];
    static struct scene scene;
    static char text[4 * text_size];
    const double bands = 25; /* in tolerances: 10 of them, and the error of the method */
    struct random_numbers numbers = {seed};
    scene = (struct scene){.tolerance = 0};
    kinds[kind].make(&numbers, &scene);
    scene.tolerance = random_power(&numbers, 1e-13, 1e-4);
    double size = fabs(scene.h.c), band = 0;
    for (int k = 0; k < scene.h.count; k++) size += fabs(scene.h.a[k]);
    if (scene.user) band = bands * scene.tolerance * size;
    size_t wanted = 0, first = 0;
    for (size_t k = 0; k < scene.level_count; k++)
        if (!add_level(scene.h, scene.levels[k], band, expected, &wanted)) return true;
    qsort(expected, wanted, sizeof *expected, by_time);
    write_scene(&scene, text);
    ++*compared;
    size_t count = list_of(text, scene.user, got);
    while (first < count && first < wanted && fabs(got[first] - expected[first].t) <= expected[first].room)
        first++;
    if (first == count && count == wanted) return true;
    print_error("seed %llu: %s: %zu events instead of %zu; number %zu at %.17g instead of %.17g\n%s",
                (unsigned long long)seed, kinds[kind].name, count, wanted, first,
                first < count ? got[first] : (double)NAN, first < wanted ? expected[first].t : (double)NAN,
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
    uint64_t scenes = number_from("FBD_EVENT_SCENES", (uint64_t)draws_of(60)),
             only = number_from("FBD_EVENT_SEED", 0);
    size_t wrong = 0, compared = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (uint64_t seed = 1; seed <= scenes; seed++)
            if (only == 0 || seed == only) wrong += !scene_agrees(k, seed, &compared);
    print_message("%zu scenes compared, %zu wrong\n", compared, wrong);
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
        for (size_t i = 0; isnan(t) && i < fbd_simulation_event_count(simulation); i++) {
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
