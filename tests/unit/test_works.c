/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Works of random waves of force on bodies whose motion knows nothing of them - what sticks on a belt, is driven along or
 * round, or stands between forces that cancel - against their integrals in closed form, by several methods and tolerances.
 * Steps are as long as such a motion allows, and a work is an integral over them. FBD_WORKS=1000 tries so many,
 * FBD_WORKS_SEED=17 begins there, FBD_WORKS_SHOW=1 prints the models.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { most_waves = 3, room = 2000 };

enum scene_kind { on_a_belt, driven_along, driven_round, cancelled, kinds };

/* a sin(w t + p) along x */
struct wave {
    double a, w, p;
};

/* The speed of the point on which the waves act, along x: u - c q sin(q t). */
struct scene {
    enum scene_kind kind;
    struct wave wave[most_waves];
    int waves;
    double u, c, q, until;
};

/* The integral of sin(w t + p). */
static double integral_of_sine(double w, double p, double until)
{
    return w == 0 ? until * sin(p) : (cos(p) - cos(w * until + p)) / w;
}

/* sin(w t + p) sin(q t) = (cos((w - q) t + p) - cos((w + q) t + p)) / 2 */
static double work_of(const struct scene *scene, const struct wave *wave)
{
    const double quarter = acos(0), T = scene->until;
    double product = (integral_of_sine(wave->w - scene->q, wave->p + quarter, T) -
                      integral_of_sine(wave->w + scene->q, wave->p + quarter, T)) /
                     2;
    return wave->a * (scene->u * integral_of_sine(wave->w, wave->p, T) - scene->c * scene->q * product);
}

static struct scene draw(struct random_numbers *numbers, int number)
{
    struct scene scene = {.kind = (enum scene_kind)(number % kinds)};
    scene.until = random_between(numbers, 0.5, 4);
    scene.waves = 1 + (int)(random_bits(numbers) % most_waves);
    for (int i = 0; i < scene.waves; i++) {
        scene.wave[i].a = random_between(numbers, -1, 1);
        scene.wave[i].w = pow(10, random_between(numbers, -0.5, 2));
        scene.wave[i].p = random_between(numbers, -3, 3);
    }
    bool swings = scene.kind == driven_along || scene.kind == driven_round;
    if (scene.kind != driven_round) scene.u = random_between(numbers, -2, 2);
    if (swings) scene.c = random_between(numbers, 0.1, 1);
    if (swings) scene.q = random_between(numbers, 0.3, 5);
    return scene;
}

/* The body, up to its forces. */
static int write_body(const struct scene *scene, char *text)
{
    double u = scene->u, c = scene->c, q = scene->q;
    switch (scene->kind) {
    case on_a_belt: /* 3 N at most, and 0.5 m g */
        return snprintf(text, room,
                        "motion: slide, initial: {v: %.17g}, forces: [gravity, normal, friction: "
                        "{static: 0.5, kinetic: 0.4, surface_speed: %.17g}",
                        u, u);
    case driven_along:
        return snprintf(text, room, "motion: {slide: {x: '%.17g*t + %.17g*cos(%.17g*t)'}}, forces: [gravity",
                        u, c, q);
    case driven_round:
        return snprintf(
            text, room,
            "inertia: 1, center: [%.17g, 0], motion: {pivot: {theta: '%.17g*t'}}, forces: [gravity", c, q);
    case cancelled:
        return snprintf(text, room, "motion: {particle: {}}, initial: {vx: %.17g}, forces: [gravity", u);
    case kinds: break;
    }
    return 0;
}

static void write(const struct scene *scene, char *text)
{
    int length = snprintf(text, room, "fbd: 1\nbodies:\n  b: {mass: 1, ");
    length += write_body(scene, text + length);
    for (int i = 0; i < scene->waves; i++) {
        const struct wave *wave = &scene->wave[i];
        for (int side = 1; side >= (scene->kind == cancelled ? -1 : 1); side -= 2)
            length += snprintf(text + length, (size_t)(room - length),
                               ", applied: {name: %s%d, value: '%.17g*sin(%.17g*t + %.17g)', angle: 0}",
                               side > 0 ? "f" : "g", i, side * wave->a, wave->w, wave->p);
    }
    snprintf(text + length, (size_t)(room - length), "]}\nsimulate: {until: %.17g}\n", scene->until);
}

static void compare(struct checks *checks, const struct scene *scene, const fbd_options *options, int number)
{
    char text[room], label[80], name[8];
    double size = 0;
    write(scene, text);
    if (getenv("FBD_WORKS_SHOW")) puts(text);
    struct trial trial = trial_parse(text);
    trial_run(&trial, options);
    check_that(checks, "comes to its end", trial.outcome == FBD_DONE);
    for (int i = 0; i < scene->waves; i++)
        size += fabs(scene->wave[i].a) * (fabs(scene->u) + fabs(scene->c * scene->q)) * scene->until;
    for (int i = 0; i < scene->waves; i++) {
        snprintf(name, sizeof name, "f%d", i);
        snprintf(label, sizeof label, "scene %d, %s at %g, %s", number, options->method, options->tolerance,
                 name);
        /* Its rounding, and what the motion is off by: the speed of a particle by ten tolerances in each of some steps. */
        double allowed = (1e-11 + 10 * options->tolerance) * (1 + size);
        check_close(checks, label, fbd_result_work(trial.result, "b", name), work_of(scene, &scene->wave[i]),
                    allowed);
    }
    trial_close(&trial);
}

static void works_are_integrals_of_power(void **unused)
{
    static const char *const methods[] = {"auto", "dop853", "rk8pd", "rodas5p", "rk4", "msadams"};
    const int draws = number_of("FBD_WORKS", draws_of(200)), first = number_of("FBD_WORKS_SEED", 1);
    struct checks checks = {0};
    (void)unused;
    for (int i = first; i < first + draws; i++) {
        struct random_numbers numbers = {(uint64_t)i};
        fbd_options options = FBD_OPTIONS_DEFAULT;
        options.method = methods[random_bits(&numbers) % (sizeof methods / sizeof *methods)];
        options.tolerance = pow(10, random_between(&numbers, -12, -4));
        struct scene scene = draw(&numbers, i);
        compare(&checks, &scene, &options, i);
    }
    checks_end(&checks);
}

/* Half a million waves within the six steps of a run, and the same by steps that are short enough. */
static void what_cannot_be_resolved_is_said(void **unused)
{
    (void)unused;
    struct scene scene = {.kind = on_a_belt, .wave = {{1, 7000, 0}}, .waves = 1, .u = 0.5, .until = 300};
    char text[room];
    write(&scene, text);
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    assert_int_equal(trial.outcome, FBD_FAILED);
    assert_true(isnan(fbd_result_work(trial.result, "b", "f0")));
    assert_non_null(
        strstr(fbd_simulation_reason(trial.simulation), "oscillate thousands of times within a step"));
    trial_close(&trial);

    struct checks checks = {0};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = "rk4";
    options.step = 1e-3;
    scene.until = 1;
    compare(&checks, &scene, &options, 0);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(works_are_integrals_of_power),
        cmocka_unit_test(what_cannot_be_resolved_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
