/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Scenes that tests/reference/engines.py has other engines compute, by programs of one form: each line of standard input is
 *
 *     SCENE h T NUMBERS...
 *
 * with the step h and the end T in seconds, and a line "= RESULTS..." is printed for it (engines print lines
 * of their own). SI units, y up, angles in radians, counter-clockwise; gravity is 9.81 m/s^2.
 *
 * SCENE    NUMBERS      results at T
 * incline  mu angle v0  place and velocity up the slope of a box of 2 kg, 0.4 m long and 0.1 m high, from 0
 * disc     mu angle     place and velocity down the slope, angular velocity of a disc of 3 kg and radius 0.2 m let go at 0
 * bounce   e height     height of the lowest point and velocity of a sphere of 0.2 kg and radius 0.05 m let go at that height
 * rope     v0           x y vx vy of a bob of 2 kg on a rope of 1 m from the origin, thrown upward from (1 m, 0)
 * fourbar               angle and rate of the crank, angle and rate of the rocker of models/couplings/four_bar.yaml
 */
#ifndef FBD_TESTS_REFERENCE_SCENES_H
#define FBD_TESTS_REFERENCE_SCENES_H

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { bars = 3 }; /* crank, coupler, rocker */

static const double gravity = 9.81;
static const double box_mass = 2, box_length = 0.4, box_height = 0.1; /* flat: it does not tip */
static const double disc_mass = 3, disc_radius = 0.2;
static const double ball_mass = 0.2, ball_radius = 0.05;
static const double bob_mass = 2, rope_length = 1;

/* The four-bar linkage: the first ends of the rods, and angles at which the loop is closed. */
static const double bar_length[bars] = {0.3, 0.9, 0.7}, bar_mass[bars] = {1, 2, 1.5};
static const double bar_angle[bars] = {1.0471975511965976, 0.5074005085420621, 1.6614783975487224};
static const double bar_pivot = 1 /* of the rocker, on the x axis */, bar_moment = 4 /* on the crank */;

/* One line of the input. */
struct scene {
    char name[16];
    double h, T, number[3];
};

/* Put the results into `result`; the number of them, or 0 where the engine cannot compute this scene. */
typedef int scene_run(const struct scene *scene, double result[4]);

static inline int scene_steps(const struct scene *scene)
{
    return (int)floor(scene->T / scene->h + 0.5);
}

static inline void bar_start(int n, double *x, double *y)
{
    *x = n == 1 ? bar_length[0] * cos(bar_angle[0]) : n == 2 ? bar_pivot : 0;
    *y = n == 1 ? bar_length[0] * sin(bar_angle[0]) : 0;
}

/* Answer every line; `runs` are in the order incline, disc, bounce, rope, fourbar. Returns the exit code. */
static inline int scene_answer(scene_run *const runs[5])
{
    static const char *const names[] = {"incline", "disc", "bounce", "rope", "fourbar"};
    char line[256];
    while (fgets(line, sizeof line, stdin)) {
        struct scene scene = {"", 0, 0, {0, 0, 0}};
        double result[4] = {0, 0, 0, 0};
        int count = 0, n = 0;
        if (sscanf(line, "%15s %lf %lf %lf %lf %lf", scene.name, &scene.h, &scene.T, &scene.number[0],
                   &scene.number[1], &scene.number[2]) < 3)
            return 2;
        while (n < 5 && strcmp(names[n], scene.name) != 0) n++;
        if (n < 5) count = runs[n](&scene, result);
        printf("=");
        for (int i = 0; i < count; i++) printf(" %.17g", result[i]);
        putchar('\n');
    }
    return 0;
}

#endif
