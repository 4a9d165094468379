/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random cams that throw their followers: r(p) = r0 + a_1 cos(k_1 p + b_1) + a_2 cos(k_2 p + b_2) about the axis of the cam,
 * which turns at a given rate, and a point above it on a vertical line. Where the point is on the cam it is at
 * H(t) = r(90 deg - W t); it comes off where H'' < -g, falls freely, and lands where its parabola meets H again, by a plastic
 * blow. All of that is followed here by short steps and halving, without the library. So are weights on a vertical line that
 * hang by ropes of length L from cranks, where H(t) = r sin(W t) - sqrt(L^2 - r^2 cos^2(W t)), as long as they do not get to
 * the upper end of that.
 *
 * FBD_CAMS=1000 FBD_CAM_SEED=1 draws that many of a seed.
 */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "gallery.h"
#include "random_numbers.h"
#include "scenes.h"
#include "thorough.h"

static const double g = 9.81, pi = 3.141592653589793;

struct cam {
    double r0, a[2], b[2], W;
    int k[2];
    double L; /* of a rope on a crank r0; 0: a cam */
};

/* The crank's rope reaches so far above and below its pin. */
static double half_chord(const struct cam *cam, double t)
{
    double x = cam->r0 * cos(cam->W * t);
    return sqrt(cam->L * cam->L - x * x);
}

static double lowest(const struct cam *cam, double t, int n)
{
    double W = cam->W, x = cam->r0 * cos(W * t), y = cam->r0 * sin(W * t), s = half_chord(cam, t);
    if (n == 0) return y - s;
    if (n == 1) return W * x - x * W * y / s;
    return -W * W * y + W * W * (y * y - x * x) / s + W * W * x * x * y * y / (s * s * s);
}

/* The derivative of order n of H. */
static double height(const struct cam *cam, double t, int n)
{
    double sum = n == 0 ? cam->r0 : 0, p = pi / 2 - cam->W * t;
    if (cam->L > 0) return lowest(cam, t, n);
    for (int i = 0; i < 2; i++) {
        double rate = -cam->k[i] * cam->W, turn = cam->k[i] * p + cam->b[i];
        double powers[] = {1, rate, rate * rate};
        sum += cam->a[i] * powers[n] * (n == 0 ? cos(turn) : n == 1 ? -sin(turn) : -cos(turn));
    }
    return sum;
}

/* Has it come off, or landed after flying with y and v at `off`? That is below zero while it is on the cam. */
static bool changes(const struct cam *cam, double t, double off, double y, double v)
{
    const double at_once = 1e-9;
    double tau = t - off;
    if (off < 0) return height(cam, t, 2) < -g;
    return tau > at_once && y + tau * (v - g * tau / 2) < height(cam, t, 0);
}

/* y and v at the end. `steps` a second; false where it comes off and lands within a few of them. */
static bool follow(const struct cam *cam, double until, double steps, double end[2])
{
    const double least = 20 / steps;
    bool flies = false, clear = true;
    double off = 0, y = 0, v = 0, changed = -1;
    for (double t = 0; t < until; t += 1 / steps) {
        double next = fmin(t + 1 / steps, until), low = t, high = next, after = next - off;
        if (cam->L > 0 && flies)
            clear &= y + after * (v - g * after / 2) < cam->r0 * sin(cam->W * next) + half_chord(cam, next);
        if (!changes(cam, next, flies ? off : -1, y, v)) continue;
        for (int i = 0; i < 60; i++) {
            double middle = (low + high) / 2;
            *(changes(cam, middle, flies ? off : -1, y, v) ? &high : &low) = middle;
        }
        if (high - changed < least) clear = false;
        changed = high;
        flies = !flies || height(cam, high, 2) < -g;
        off = high;
        y = height(cam, high, 0);
        v = height(cam, high, 1);
    }
    double tau = until - off;
    end[0] = flies ? y + tau * (v - g * tau / 2) : height(cam, until, 0);
    end[1] = flies ? v - g * tau : height(cam, until, 1);
    return clear;
}

static void draw(struct random_numbers *numbers, struct cam *cam)
{
    *cam = (struct cam){.r0 = random_between(numbers, 0.03, 0.08), .W = random_between(numbers, 5, 40)};
    for (int i = 0; i < 2; i++) {
        cam->a[i] = random_between(numbers, 0, 0.35) * cam->r0;
        cam->b[i] = random_between(numbers, 0, 2 * pi);
        cam->k[i] = 1 + (int)(random_bits(numbers) % 7);
    }
}

static void write_cam(const struct cam *cam, double until, double tolerance, size_t size, char *text)
{
    char r[200];
    snprintf(r, sizeof r, "(%.17g + %.17g*cos(%d*p + %.17g) + %.17g*cos(%d*p + %.17g))*1[m]", cam->r0,
             cam->a[0], cam->k[0], cam->b[0], cam->a[1], cam->k[1], cam->b[1]);
    snprintf(
        text, size,
        "fbd: 1\nbodies:\n  cam: {mass: 2, inertia: 0.01, motion: {pivot: {theta: \"%.17g[rad/s]*t\"}}}\n"
        "  follower: {mass: 0.5, motion: {slide: {along: 90 deg}}, initial: {x: %.17g, v: %.17g}, "
        "forces: [gravity]}\ncouplings: [slot: {name: face, between: [follower, cam], side: right, "
        "x: \"%s*cos(p)\", y: \"%s*sin(p)\", from: 0, to: 360 deg, closed: true}]\n"
        "simulate: {until: %.17g s, tolerance: %.3g}\n",
        cam->W, height(cam, 0, 0), height(cam, 0, 1), r, r, until, tolerance);
}

static void draw_crank(struct random_numbers *numbers, struct cam *cam)
{
    *cam = (struct cam){.r0 = random_between(numbers, 0.05, 0.15),
                        .W = random_between(numbers, 5, 40),
                        .L = random_between(numbers, 0.25, 0.5)};
}

static void write_crank(const struct cam *cam, double until, double tolerance, size_t size, char *text)
{
    snprintf(text, size,
             "fbd: 1\nbodies:\n  crank: {mass: 2, inertia: 0.01, points: {P: [%.17g, 0]}, motion: {pivot: "
             "{theta: \"%.17g[rad/s]*t\"}}}\n  follower: {mass: 0.5, motion: {slide: {along: 90 deg}}, "
             "initial: {x: %.17g, v: %.17g}, forces: [gravity]}\n"
             "couplings: [rope: {name: cord, through: [crank.P, follower.G], length: %.17g}]\n"
             "simulate: {until: %.17g s, tolerance: %.3g}\n",
             cam->r0, cam->W, height(cam, 0, 0), height(cam, 0, 1), cam->L, until, tolerance);
}

/* In the place of that which stands before its forces. */
static void set_initial(char *text, const char *initial)
{
    char *from = strstr(text, "initial:"), *to = strstr(text, "forces:");
    assert_true(from && to && (size_t)(to - from) >= strlen(initial));
    memset(from, ' ', (size_t)(to - from));
    memcpy(from, initial, strlen(initial));
}

static void all_go_as_they_are_thrown(bool cranks)
{
    int count = number_of("FBD_CAMS", draws_of(12)), thrown = 0, told = 0;
    struct random_numbers numbers = {(uint64_t)number_of("FBD_CAM_SEED", 20261125)};
    struct checks checks = {0};
    for (int i = 0; i < count; i++) {
        const double until = 1;
        struct cam cam;
        char text[1600], name[40];
        double want[2], finer[2];
        (cranks ? draw_crank : draw)(&numbers, &cam);
        double tolerance = pow(10, -random_between(&numbers, 6, 11));
        (cranks ? write_crank : write_cam)(&cam, until, tolerance, sizeof text, text);
        if (height(&cam, 0, 2) < -g + 1) continue; /* it would not begin on its cam */
        bool clear = follow(&cam, until, 1e5, want) && follow(&cam, until, 1.7e5, finer);
        if (!clear || fabs(want[0] - finer[0]) > 1e-9 || fabs(want[1] - finer[1]) > 1e-7) continue;
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        size_t failed = checks.failed;
        snprintf(name, sizeof name, "%d: x", i);
        check_that(&checks, name, trial.outcome == FBD_DONE);
        check_close(&checks, name, trial_get(&trial, "follower.x"), want[0], 1e-6);
        check_close(&checks, name, trial_get(&trial, "follower.v"), want[1], 1e-4);
        if (checks.failed > failed) print_message("%s%s\n", text, fbd_simulation_reason(trial.simulation));
        told++;
        thrown += fbd_simulation_event_count(trial.simulation) > 0;
        trial_close(&trial);
    }
    print_message("# %d of %d can be told, %d throw\n", told, count, thrown);
    check_that(&checks, "many do", !thorough() || (4 * told > count && 4 * thrown > told));
    checks_end(&checks);
}

static void followers_go_as_their_cams_throw_them(void **unused)
{
    (void)unused;
    all_go_as_they_are_thrown(false);
}

static void weights_go_as_their_cranks_throw_them(void **unused)
{
    (void)unused;
    all_go_as_they_are_thrown(true);
}

static double fallen(double y, double v, double time)
{
    return y + time * (v - g * time / 2);
}

/* Of a weight at height y from the pin of its crank. */
static double distance(const struct cam *cam, double t, double y)
{
    return hypot(cam->r0 * cos(cam->W * t), cam->r0 * sin(cam->W * t) - y);
}

/* A weight falls into its rope, is thrown up and comes to the end of it above its crank, within one step of a run that has nothing to
 * integrate: that second jerk was missed at this tolerance. */
static void a_jerk_within_a_long_step_is_seen(void **unused)
{
    const struct cam cam = {.r0 = 0.110049, .W = 33.9774, .L = 0.29854};
    char text[1000], start[60];
    double off = 0, y = -0.238832, v = 0;
    struct checks checks = {0};
    (void)unused;
    write_crank(&cam, 1, 1e-11, sizeof text, text);
    snprintf(start, sizeof start, "initial: {x: %.17g}, ", y);
    set_initial(text, start);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    for (int k = 0; k < 2; k++) {
        double t = off;
        while (t <= off + 1e-6 || distance(&cam, t, fallen(y, v, t - off)) < cam.L) t += 1e-6;
        double low = t - 1e-6;
        for (int i = 0; i < 40; i++) {
            double middle = (low + t) / 2;
            *(distance(&cam, middle, fallen(y, v, middle - off)) < cam.L ? &low : &t) = middle;
        }
        check_close(&checks, "when", trial_event(&trial, FBD_EVENT_ROPE_TAUT, NULL, k), t, 1e-9);
        off = t;
        y = height(&cam, t, 0);
        v = height(&cam, t, 1);
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* What presses a weight against its guide holds it by friction, where a slow cam or crank has lifted it to: it goes on up
 * to the highest place and stays there, while the cam recedes and the rope goes slack. The work of its blows is shared by
 * what drives and the friction on the guide. */
static void what_has_been_lifted_is_held(void **unused)
{
    struct random_numbers numbers = {20261126};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws_of(12); i++) {
        struct cam cam;
        char text[1600], held[120], name[40];
        const double until = 3;
        double highest = -HUGE_VAL, by = random_between(&numbers, 1e-4, 5e-3);
        (i % 2 ? draw_crank : draw)(&numbers, &cam);
        cam.W = random_between(&numbers, 2.2, 4) / cam.k[i % 2 ? 1 : 0];
        if (i % 2) cam.W = random_between(&numbers, 2.2, 4);
        double tolerance = pow(10, -random_between(&numbers, 7, 11));
        (i % 2 ? write_crank : write_cam)(&cam, until, tolerance, sizeof text, text);
        snprintf(held, sizeof held, "initial: {x: %.17g}, ", height(&cam, 0, 0) + by);
        set_initial(text, held);
        char *forces = strstr(text, "forces: [gravity]");
        static const char more[] =
            "forces: [gravity, normal: {two_sided: true}, friction: 0.2, applied: {value: [60 N, 0 N]}]";
        size_t rest = strlen(forces + 17) + 1;
        assert_true(strlen(text) + sizeof more < sizeof text);
        memmove(forces + sizeof more - 1, forces + 17, rest);
        memcpy(forces, more, sizeof more - 1);
        double when = 0, start = height(&cam, 0, 0) + by;
        for (int k = 0; k <= 300000; k++) {
            double t = k * until / 300000, H = height(&cam, t, 0);
            if (H > highest) highest = H, when = t;
        }
        struct trial trial = trial_parse(text);
        const fbd_recording recording = {.size = sizeof recording, .ledger = true};
        trial_record(&trial, NULL, &recording);
        size_t failed = checks.failed;
        snprintf(name, sizeof name, "%d", i);
        check_that(&checks, name, trial.outcome == FBD_DONE);
        check_close(&checks, name, trial_get(&trial, "follower.x"), fmax(highest, start), 1e-8);
        if (when < until - 1e-3) check_close(&checks, name, trial_get(&trial, "follower.v"), 0, 1e-12);
        check_close(&checks, name, fbd_result_energy(trial.result).residual, 0, 1e-8);
        bool stays = highest < start || when > until - 1e-3;
        check_that(&checks, name, stays || isfinite(trial_event(&trial, FBD_EVENT_STICK, NULL, 0)));
        if (checks.failed > failed) print_message("%s%s\n", text, fbd_simulation_reason(trial.simulation));
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(followers_go_as_their_cams_throw_them),
        cmocka_unit_test(weights_go_as_their_cranks_throw_them),
        cmocka_unit_test(a_jerk_within_a_long_step_is_seen),
        cmocka_unit_test(what_has_been_lifted_is_held),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
