/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies that land, bounce, slip, stick and roll on a moving surface, seen from the surface: with `surface_speed` on an
 * inclined line, and without it in the frame of the surface, where every body has the velocity less that of the surface
 * and, where that varies, the force -m s'. Both are the same motion but for the way of the surface. And a disc whose
 * surface runs is a drum that turns. FBD_SURFACES=2000 tries so many scenes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { most_bodies = 3, text_room = 6000 };

enum what { a_particle, a_disc, a_box, a_rolling_disc, kinds };

/* A body that starts at `along` and `above` of the line. */
struct one {
    enum what what;
    double along, above, v_t, v_n, theta, omega, mu_s, mu_k, e;
    bool slips; /* a rolling disc has coefficients */
};

/* The surface has the speed s + a sin(w t) along a line that is inclined by `angle`. */
struct belt {
    double angle, s, a, w, until;
    int count;
    struct one bodies[most_bodies];
};

static struct belt draw(struct random_numbers *numbers)
{
    struct belt belt = {.angle = random_between(numbers, -0.4, 0.4),
                        .s = random_between(numbers, -2, 2),
                        .a = random_chance(numbers, 0.5) ? random_between(numbers, 0.1, 0.5) : 0,
                        .w = random_between(numbers, 1, 8),
                        .until = random_between(numbers, 0.4, 1),
                        .count = 1 + (int)(random_bits(numbers) % most_bodies)};
    for (int i = 0; i < belt.count; i++) {
        struct one *one = &belt.bodies[i];
        *one = (struct one){.what = (enum what)(random_bits(numbers) % kinds),
                            .along = 5 * i,
                            .v_t = random_between(numbers, -2, 2),
                            .v_n = random_between(numbers, -1, 1),
                            .theta = random_between(numbers, -1, 1),
                            .omega = random_between(numbers, -5, 5),
                            .mu_s = random_between(numbers, 0.3, 0.6),
                            .mu_k = random_between(numbers, 0.1, 0.3),
                            .e = random_chance(numbers, 0.5) ? random_between(numbers, 0, 0.6) : 0,
                            .slips = random_chance(numbers, 0.7)};
        const bool rolls = one->what == a_rolling_disc;
        one->above = rolls ? 0.1 : random_between(numbers, 0.15, 0.4);
        if (rolls) one->v_n = 0;
        /* without coefficients it rolls from the start */
        if (rolls && !one->slips) one->omega = -(one->v_t - belt.s) / 0.1;
    }
    return belt;
}

/* ---- writing: in the world, or from the surface */

static void write_body(FILE *out, const struct belt *belt, int i, bool from_surface)
{
    static const char *const shapes[] = {
        "motion: particle", "shape: disc, radius: 0.1 m, motion: planar",
        "shape: prism, a: 0.2 m, b: 0.1 m, c: 0.1 m, axis: z, motion: planar",
        "shape: disc, radius: 0.1 m, motion: planar"};
    const struct one *one = &belt->bodies[i];
    const double c = cos(belt->angle), s = sin(belt->angle), v = one->v_t - (from_surface ? belt->s : 0);
    fprintf(out, "  b%d: {mass: %d kg, %s, initial: {x: %.17g, y: %.17g, vx: %.17g, vy: %.17g", i, 1 + i,
            shapes[one->what], one->along * c - one->above * s, one->along * s + one->above * c,
            v * c - one->v_n * s, v * s + one->v_n * c);
    if (one->what != a_particle) fprintf(out, ", theta: %.17g, omega: %.17g", one->theta, one->omega);
    fprintf(out, "}, forces: [gravity");
    if (from_surface && belt->a != 0)
        fprintf(out, ", applied: {value: \"-m*%.17g[m/s^2]*cos(%.17g[rad/s]*t)\", angle: %.17g rad}",
                belt->a * belt->w, belt->w, belt->angle);
    fprintf(out, "]}\n");
}

static void write_speed(FILE *out, const struct belt *belt, bool from_surface)
{
    if (!from_surface)
        fprintf(out, ", surface_speed: \"%.17g[m/s] + %.17g[m/s]*sin(%.17g[rad/s]*t)\"", belt->s, belt->a,
                belt->w);
    fprintf(out, "}\n");
}

static char *text_of(const struct belt *belt, bool from_surface)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fprintf(out, "fbd: 1\nground: {lines: {belt: {through: [0, 0], along: %.17g rad}}}\nbodies:\n",
            belt->angle);
    for (int i = 0; i < belt->count; i++) write_body(out, belt, i, from_surface);
    for (int list = 0; list < 2; list++) {
        bool any = false;
        for (int i = 0; i < belt->count; i++) {
            const struct one *one = &belt->bodies[i];
            if ((one->what == a_rolling_disc) != (list == 1)) continue;
            if (!any) fprintf(out, list == 0 ? "contacts:\n" : "couplings:\n");
            any = true;
            if (list == 0)
                fprintf(out,
                        "  - {between: [b%d, ground.belt], restitution: %.17g, static: %.17g, kinetic: %.17g",
                        i, one->e, one->mu_s, one->mu_k);
            else
                fprintf(out, "  - roll: {body: b%d, on: belt", i);
            if (list == 1 && one->slips)
                fprintf(out, ", static: %.17g, kinetic: %.17g", one->mu_s, one->mu_k);
            write_speed(out, belt, from_surface);
        }
    }
    fprintf(out, "simulate: {until: %.17g}\n", belt->until);
    fclose(out);
    return text;
}

/* ---- comparing */

static void compare_body(struct checks *checks, const struct belt *belt, int i, const struct trial *world,
                         const struct trial *surface)
{
    static const char *const names[] = {"x", "y", "vx", "vy", "theta", "omega"};
    /* Impacts multiply the errors of a tolerance of 1e-11. */
    const double same = 1e-7;
    const double t = belt->until, c = cos(belt->angle), s = sin(belt->angle);
    const double way = belt->s * t + belt->a / belt->w * (1 - cos(belt->w * t));
    const double speed = belt->s + belt->a * sin(belt->w * t);
    const double shift[] = {way * c, way * s, speed * c, speed * s, 0, 0};
    for (int k = 0; k < (belt->bodies[i].what == a_particle ? 4 : 6); k++) {
        char name[20];
        snprintf(name, sizeof name, "b%d.%s", i, names[k]);
        const double want = trial_get(surface, name) + shift[k];
        check_close(checks, name, trial_get(world, name), want, same * (1 + fabs(want)));
    }
}

static void check_energy(struct checks *checks, struct trial *trial)
{
    const fbd_energy energy = fbd_result_energy(trial->result);
    const double size = 1 + fabs(energy.kinetic) + fabs(energy.potential) + fabs(energy.work);
    check_close(checks, "energy", energy.residual / size, 0, 1e-8);
}

static size_t seeds(void)
{
    const char *given = getenv("FBD_SURFACES");
    return given ? (size_t)strtoul(given, NULL, 10) : (size_t)draws_of(200);
}

static void a_moving_surface_is_a_moving_observer(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = 1e-11;
    for (uint64_t seed = 1; seed <= seeds(); seed++) {
        const size_t before = checks.failed;
        struct random_numbers numbers = {seed};
        const struct belt belt = draw(&numbers);
        char *texts[2] = {text_of(&belt, false), text_of(&belt, true)};
        struct trial world = trial_parse(texts[0]), surface = trial_parse(texts[1]);
        trial_run(&world, &options);
        trial_run(&surface, &options);
        check_that(&checks, "both end alike", world.outcome == FBD_DONE && surface.outcome == FBD_DONE);
        for (int i = 0; i < belt.count; i++) compare_body(&checks, &belt, i, &world, &surface);
        check_energy(&checks, &world);
        if (checks.failed > before) print_error("seed %d:\n%s\n%s\n", (int)seed, texts[0], texts[1]);
        trial_close(&world);
        trial_close(&surface);
        for (int k = 0; k < 2; k++) free(texts[k]);
    }
    checks_end(&checks);
}

/* A disc falls on a drum, beside its top, bounces, slips and rolls off. */
static void a_running_surface_is_a_turning_drum(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = 1e-11;
    for (uint64_t seed = 1; seed <= (uint64_t)draws_of(60); seed++) {
        struct random_numbers numbers = {seed};
        const double omega = random_between(&numbers, -8, 8), x = random_between(&numbers, -0.1, 0.1);
        const double e = random_between(&numbers, 0, 0.5), mu = random_between(&numbers, 0.1, 0.5);
        const double spin = random_between(&numbers, -9, 9);
        struct trial trials[2];
        for (int k = 0; k < 2; k++) {
            char text[text_room];
            snprintf(
                text, sizeof text,
                "fbd: 1\nbodies:\n  drum: {mass: 20, shape: disc, radius: 0.3, motion: {pivot: {theta: "
                "\"%.17g[rad/s]*t\"}}}\n  ball: {mass: 1, shape: disc, radius: 0.1, motion: planar, initial: "
                "{x: "
                "%.17g, y: 0.45, omega: %.17g}, forces: [gravity]}\ncontacts:\n  - {between: [ball, drum], "
                "restitution: %.17g, kinetic: %.17g, surface_speed: %.17g}\nsimulate: {until: 0.45}\n",
                k == 0 ? 0 : omega, x, spin, e, mu, k == 0 ? 0.3 * omega : 0.0);
            trials[k] = trial_parse(text);
            trial_run(&trials[k], &options);
        }
        static const char *const names[] = {"ball.x",  "ball.y",  "ball.theta",
                                            "ball.vx", "ball.vy", "ball.omega"};
        check_that(&checks, "both end alike", trials[0].outcome == trials[1].outcome);
        for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
            const double want = trial_get(&trials[1], names[k]);
            check_close(&checks, names[k], trial_get(&trials[0], names[k]), want, 1e-6 * (1 + fabs(want)));
        }
        check_energy(&checks, &trials[0]);
        for (int k = 0; k < 2; k++) trial_close(&trials[k]);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_moving_surface_is_a_moving_observer),
        cmocka_unit_test(a_running_surface_is_a_turning_drum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
