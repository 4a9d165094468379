/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random cams that throw their followers: r(p) = r0 + a_1 cos(k_1 p + b_1) + a_2 cos(k_2 p + b_2) about the axis of the cam,
 * which turns at a given rate, and a point above it on a vertical line. Where the point is on the cam it is at
 * H(t) = r(90 deg - W t); it comes off where H'' < -g, falls freely, and lands where its parabola meets H again, by a plastic
 * blow. All of that is followed here by short steps and halving, without the library.
 *
 * FBD_CAMS=1000 FBD_CAM_SEED=1 draws that many of a seed.
 */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "gallery.h"
#include "random_numbers.h"
#include "scenes.h"
#include "thorough.h"

static const double g = 9.81, pi = 3.141592653589793;

static int number_of(const char *name, int otherwise)
{
    const char *text = getenv(name);
    return text ? (int)strtol(text, NULL, 10) : otherwise;
}

struct cam {
    double r0, a[2], b[2], W;
    int k[2];
};

/* The derivative of order n of H. */
static double height(const struct cam *cam, double t, int n)
{
    double sum = n == 0 ? cam->r0 : 0, p = pi / 2 - cam->W * t;
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
        double next = fmin(t + 1 / steps, until), low = t, high = next;
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

static void followers_go_as_their_cams_throw_them(void **unused)
{
    int count = number_of("FBD_CAMS", thorough() ? 60 : 12), thrown = 0, told = 0;
    struct random_numbers numbers = {(uint64_t)number_of("FBD_CAM_SEED", 20261125)};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < count; i++) {
        const double until = 1;
        struct cam cam;
        char text[1600], name[40];
        double want[2], finer[2];
        draw(&numbers, &cam);
        double tolerance = pow(10, -random_between(&numbers, 6, 11));
        write_cam(&cam, until, tolerance, sizeof text, text);
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
    print_message("# %d of %d cams can be told, %d throw\n", told, count, thrown);
    check_that(&checks, "many do", 3 * told > count && 3 * thrown > told);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(followers_go_as_their_cams_throw_them)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
