/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random discs, rods, boxes and polygons that strike two or three things at one instant, with friction: walls that make a
 * corner, a wedge or a valley, one floor with two corners, and discs that fly themselves; by all laws, together and one after
 * the other. The flights go backwards in closed form from the instant at which all touch; against impacts by sets
 * (impacts_by_sets.h), and by what holds whatever the law. FBD_BLOWS=1000 tries so many, FBD_BLOWS_SEED=17 begins there,
 * FBD_BLOWS_SHOW=1 prints the models and the impacts.
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

#include "blow_scenes.h"
#include "gallery.h"
#include "impacts_by_sets.h"
#include "moreau.h"

static const double instant = 1e-9; /* after the blow its outcome is looked at [s] */

/* ---- the same by sets */

static struct points_by_sets points_of(const struct blow_scene *scene, double *u)
{
    const double none = 1e-13;
    struct points_by_sets points = {.count = scene->touches, .in_turn = scene->in_turn};
    for (int i = 0; i < 2 * scene->touches; i++) {
        const struct blow_touch *touch = &scene->touch[i / 2];
        u[i] = blow_speed(scene, i / 2, i % 2);
        if (fabs(u[i]) < none) u[i] = 0;
        points.e[i / 2] = touch->e;
        points.mu[i / 2] = touch->mu;
        points.law[i / 2] = touch->law;
        for (int j = 0; j < 2 * scene->touches; j++)
            for (int b = 0; b < scene->bodies; b++) {
                double a[3], c[3];
                blow_row(touch, i % 2, b, a);
                blow_row(&scene->touch[j / 2], j % 2, b, c);
                points.W[i][j] +=
                    (a[0] * c[0] + a[1] * c[1]) / scene->body[b].m + a[2] * c[2] / scene->body[b].I;
            }
    }
    return points;
}

static void push(struct blow_scene *scene, const double *P)
{
    for (int i = 0; i < 2 * scene->touches; i++)
        for (int b = 0; b < scene->bodies; b++) {
            struct blow_body *body = &scene->body[b];
            double J[3];
            blow_row(&scene->touch[i / 2], i % 2, b, J);
            for (int k = 0; k < 3; k++) body->v[k] += P[i] * J[k] / (k < 2 ? body->m : body->I);
        }
}

/* ---- both */

/* Kinetic energy, and momentum in x, y and about the origin. */
static void sums_of(const struct blow_scene *scene, double sums[4])
{
    memset(sums, 0, 4 * sizeof *sums);
    for (int b = 0; b < scene->bodies; b++) {
        const struct blow_body *body = &scene->body[b];
        const double *q = body->q, *v = body->v;
        sums[0] += body->m * (v[0] * v[0] + v[1] * v[1]) / 2 + body->I * v[2] * v[2] / 2;
        sums[1] += body->m * v[0];
        sums[2] += body->m * v[1];
        sums[3] += body->m * (q[0] * v[1] - q[1] * v[0]) + body->I * v[2];
    }
}

static void read_rates(const struct blow_scene *scene, const struct trial *trial, struct blow_body *bodies)
{
    static const char *const names[] = {"vx", "vy", "omega"};
    for (int b = 0; b < scene->bodies; b++)
        for (int k = 0; k < 3; k++) {
            char name[20];
            if (b == 0)
                snprintf(name, sizeof name, "b.%s", names[k]);
            else
                snprintf(name, sizeof name, "d%d.%s", b, names[k]);
            bodies[b].v[k] = trial_get(trial, name);
        }
}

static bool complain(bool fact, const char *what, double value)
{
    if (!fact) printf("# %s: %.9g\n", what, value);
    return fact;
}

/* What holds of any law, between before and after. */
static bool keeps_laws(const struct blow_scene *before, const struct blow_scene *after, double size)
{
    const double rounding = 1e-8; /* as what gravity does in the instant */
    double was[4], is[4];
    bool holds = true, loses = true, free = true;
    sums_of(before, was);
    sums_of(after, is);
    for (int i = 0; i < before->touches; i++) {
        double u = blow_speed(after, i, 0);
        loses &= before->touch[i].law <= steps_poisson;
        free &= before->touch[i].other > 0;
        holds &= complain(u >= -10 * rounding * size, "goes on into what it touches", u);
    }
    if (loses) holds &= complain(is[0] <= was[0] * (1 + 10 * rounding), "makes energy", is[0] - was[0]);
    for (int k = 1; free && k < 4; k++)
        holds &= complain(fabs(is[k] - was[k]) <= rounding * sqrt(was[0]) * 10, "changes momentum",
                          is[k] - was[k]);
    return holds;
}

static double size_of(const struct blow_scene *scene)
{
    double size = 0;
    for (int i = 0; i < 2 * scene->touches; i++) size = fmax(size, fabs(blow_speed(scene, i / 2, i % 2)));
    return size;
}

/* Bounces that nobody sees end at once. */
static bool has_low_bounce(const struct blow_scene *scene)
{
    const double low = 1e-3, none = 1e-9;
    for (int i = 0; i < scene->touches; i++) {
        double u = blow_speed(scene, i, 0);
        if (u > none && u < low) return true;
    }
    return false;
}

static bool compare(const struct blow_scene *expected, const struct blow_scene *found, double size)
{
    const double near = 1e-7;
    double worst = 0;
    for (int b = 0; b < expected->bodies; b++)
        for (int k = 0; k < 3; k++) {
            double off = fabs(expected->body[b].v[k] - found->body[b].v[k]);
            if (!(off <= worst)) worst = off;
        }
    double fallen = expected->falls ? 100 * blow_gravity * instant : 0;
    bool same = complain(worst <= near * size + fallen, "off impacts by sets by", worst);
    for (int b = 0; b < expected->bodies && !same; b++)
        for (int k = 0; k < 3; k++)
            printf("# body %d: %.9g, by sets %.9g\n", b, found->body[b].v[k], expected->body[b].v[k]);
    return same;
}

static void show(const struct blow_scene *scene, struct trial *trial)
{
    if (!getenv("FBD_BLOWS_SHOW")) return;
    puts(scene->text.all);
    printf("# at the blow, %.12g:\n", scene->when);
    for (int i = 0; i < scene->touches; i++)
        printf("# touch %d closes at %.9g, slips at %.9g\n", i, blow_speed(scene, i, 0),
               blow_speed(scene, i, 1));
    for (size_t k = 0; k < fbd_simulation_event_count(trial->simulation); k++) {
        fbd_event event = fbd_simulation_event(trial->simulation, k);
        printf("# run: t = %.12g: %s\n", event.t, event.detail);
    }
}

/* On until the state there is known. */
static bool go_to(struct trial *trial, double t)
{
    double from, to = -HUGE_VAL;
    while (to < t && trial->outcome == FBD_GOING) {
        trial->outcome = fbd_simulation_advance(trial->simulation);
        fbd_simulation_interval(trial->simulation, &from, &to);
    }
    return fbd_simulation_state(trial->simulation, t, trial->state);
}

/* Two corners that close as fast, one after the other: either may be the first. */
static bool is_tie(const struct blow_scene *scene)
{
    return scene->flat && scene->in_turn && fabs(blow_speed(scene, 0, 0) - blow_speed(scene, 1, 0)) < 1e-9;
}

/* The same by the law that always has a solution. */
static void write_by_stronge(const struct blow_scene *scene, struct blow_scene *other)
{
    static const char *const laws[] = {"newton", "moreau"};
    *other = *scene;
    other->text.length = 0;
    for (const char *at = scene->text.all; *at;) {
        bool law = strncmp(at, laws[0], 6) == 0 || strncmp(at, laws[1], 6) == 0;
        add(&other->text, law ? "%.0sstronge" : "%.1s", at);
        at += law ? 6 : 1;
    }
}

enum end { done, unsolvable, lost, endless, failed };

static enum end end_of(const struct trial *trial)
{
    const char *reason = fbd_simulation_reason(trial->simulation);
    if (trial->outcome == FBD_DONE) return done;
    if (strstr(reason, "have no solution by their law")) return unsolvable;
    if (strstr(reason, "below the round-off level")) return lost;
    if (strstr(reason, "without end: try `simulate: {impacts: simultaneous}`")) return endless;
    printf("# %s\n", reason);
    return failed;
}

/* The velocities right after the blow, and how the run ends. */
static enum end run_scene(const struct blow_scene *scene, struct blow_scene *found, bool *struck)
{
    struct trial trial = trial_parse(scene->text.all);
    trial_start(&trial, NULL);
    *struck = go_to(&trial, scene->when + instant);
    if (*struck) read_rates(scene, &trial, found->body);
    while (trial.outcome == FBD_GOING) trial.outcome = fbd_simulation_advance(trial.simulation);
    show(scene, &trial);
    enum end end = end_of(&trial);
    trial_close(&trial);
    return end;
}

/* Laws of velocities may contradict each other, and impacts one after the other go on for ever, where there is no one answer
 * by sets; impulses that are hundreds of times as large as what would stop a point are refused where there is one. */
static bool may_end(const struct blow_scene *scene, enum end end, bool struck, bool known)
{
    bool by_velocity = false;
    for (int i = 0; i < scene->touches; i++) by_velocity |= scene->touch[i].law > steps_poisson;
    if (end == unsolvable) return by_velocity && (struck || !known);
    if (end == endless) return scene->in_turn && (struck || !known);
    return end == done || end == lost;
}

static bool agrees(uint64_t seed, bool *unknown)
{
    const double on = 0.3;
    static struct blow_scene scene, after, found;
    double u[sets_rows] = {0}, P[sets_rows] = {0};
    blow_draw(seed, &scene);
    add(&scene.text, "simulate: {until: %.17g, tolerance: 1e-11, impacts: %s}\n", scene.when + on,
        scene.in_turn ? "propagate" : "simultaneous");
    after = found = scene;
    struct points_by_sets points = points_of(&scene, u);
    double size = size_of(&scene);
    bool known = impacts_by_sets(&points, u, P) && !is_tie(&scene), struck;
    if (known) push(&after, P);
    size = fmax(size, size_of(&after));
    enum end end = run_scene(&scene, &found, &struck);
    bool right = complain(may_end(&scene, end, struck, known), "ends by", end);
    if (struck) right &= keeps_laws(&scene, &found, size);
    if (struck && known && !(scene.falls && has_low_bounce(&after))) right &= compare(&after, &found, size);
    *unknown = !known || !struck;
    if (end == unsolvable && !struck) { /* as it says */
        write_by_stronge(&scene, &after);
        end = run_scene(&after, &found, &struck);
        right &= complain(struck, "by stronge ends by", end) && keeps_laws(&scene, &found, size_of(&scene));
    }
    if (!right)
        printf("# seed %llu%s\n%s\n", (unsigned long long)seed, known ? "" : ", no one answer",
               scene.text.all);
    return right;
}

static void impacts_by_sets_say_the_same(void **unused)
{
    (void)unused;
    moreau_compare("FBD_BLOWS", 600, 5, agrees);
}

/* A rod that slides along a wall is struck by a disc that presses it there no longer: with what rounding leaves of its
 * speed off the wall it could neither stay nor go. */
static void a_blow_that_leaves_a_rod_at_rest(void **unused)
{
    bool unknown;
    (void)unused;
    assert_true(agrees(307047, &unknown));
}

/* Modes that have no forces, but for some give that makes them as large as 1/give: beside these the speeds themselves count
 * for rounding, and the modes for a solution. Those that are one were not looked for any more. */
static void forces_without_bound_are_no_solution(void **unused)
{
    static const uint64_t seeds[] = {162013, 305693};
    bool unknown;
    (void)unused;
    for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
        assert_true(agrees(seeds[i], &unknown));
        assert_false(unknown);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(impacts_by_sets_say_the_same),
        cmocka_unit_test(forces_without_bound_are_no_solution),
        cmocka_unit_test(a_blow_that_leaves_a_rod_at_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
