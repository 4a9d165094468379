/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "windows.h"

static const double pi = 3.14159265358979323846, g = 9.81;

/* Couplers stay level: their angles are zero all the time, but for rounding. */
static void add_planar(FILE *out, const struct row_of_windows *row)
{
    const char *pin = "  - pin: {name: %s%d, between: [%s%d.%s, %s%d.%s]}\n";
    fprintf(out, "ground: {points: {");
    for (int i = 0; i <= row->windows; i++)
        fprintf(out, "%sO%d: [%.17g, 0]", i > 0 ? ", " : "", i, i * row->L);
    fprintf(out, "}}\nbodies:\n");
    for (int i = 0; i <= row->windows; i++) {
        fprintf(out, "  v%d: {shape: rod, mass: 1, length: %.17g, motion: planar, forces: [gravity], ", i,
                row->a);
        fprintf(out, "initial: {x: %.17g, y: %.17g, theta: 90 deg, vx: %.17g, omega: %.17g}}\n", i * row->L,
                row->a / 2, row->omega * row->a / 2, -row->omega);
        if (i == row->windows) break;
        fprintf(out, "  h%d: {shape: rod, mass: 1, length: %.17g, motion: planar, forces: [gravity], ", i,
                row->L);
        fprintf(out, "initial: {x: %.17g, y: %.17g, vx: %.17g}}\n", (i + 0.5) * row->L, row->a,
                row->omega * row->a);
    }
    fprintf(out, "couplings:\n");
    for (int i = 0; i <= row->windows; i++)
        fprintf(out, "  - pin: {name: o%d, between: [v%d.left, ground.O%d]}\n", i, i, i);
    for (int i = 0; i < row->windows; i++) {
        fprintf(out, pin, "l", i, "v", i, "right", "h", i, "left");
        fprintf(out, pin, "r", i, "v", i + 1, "right", "h", i, "right");
    }
}

static void add_jointed(FILE *out, const struct row_of_windows *row)
{
    fprintf(out, "bodies:\n");
    for (int i = 0; i <= row->windows; i++) {
        fprintf(out, "  v%d: {shape: rod, mass: 1, length: %.17g, motion: {pivot: {at: [%.17g, %.17g], ", i,
                row->a, i * row->L * cos(row->phi), i * row->L * sin(row->phi));
        fprintf(out, "point: left}}, initial: {theta: %.17g rad, omega: %.17g}, forces: [gravity]}\n", pi / 2,
                -row->omega);
        if (i == row->windows) break;
        fprintf(out, "  h%d: {shape: rod, mass: 1, length: %.17g, motion: {pivot: {on: v%d, at: right, ", i,
                row->L, i);
        fprintf(out, "point: left}}, initial: {theta: %.17g rad, omega: %.17g}, forces: [gravity]}\n",
                row->phi - pi / 2, row->omega);
    }
    fprintf(out, "couplings:\n");
    for (int i = 0; i < row->windows; i++)
        fprintf(out, "  - pin: {name: p%d, between: [h%d.right, v%d.right]}\n", i, i, i + 1);
}

char *windows_text(const struct row_of_windows *row)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    fprintf(out, "fbd: 1\n");
    if (row->planar)
        add_planar(out, row);
    else
        add_jointed(out, row);
    fprintf(out, "simulate: {until: 10 s}\n");
    fclose(out);
    return text;
}

/* Cranks count with a/2 for their weight and a^2/3 for their inertia, couplers with a and a^2. */
static double stiffness(const struct row_of_windows *row)
{
    double cranks = row->windows + 1, couplers = row->windows;
    return g * (cranks / 2 + couplers) / (row->a * (cranks / 3 + couplers));
}

double windows_speed_off(const struct trial *trial, const struct row_of_windows *row)
{
    double theta = trial_get(trial, "v0.theta"), K = stiffness(row);
    double omega = -sqrt(row->omega * row->omega + 2 * K * (1 - sin(theta)));
    return fabs(trial_get(trial, "v0.omega") / omega - 1);
}

struct worst {
    double gap, speed; /* how far pins are apart; how far crank 0 is off its speed by the energy */
};

static void look(const struct trial *trial, const struct row_of_windows *row, struct worst *worst)
{
    for (int i = 0; i < row->windows; i++) {
        char v[24], h[24], next[24];
        snprintf(v, sizeof v, "v%d.theta", i);
        snprintf(h, sizeof h, "h%d.theta", i);
        snprintf(next, sizeof next, "v%d.theta", i + 1);
        double a = trial_get(trial, v), b = (row->planar ? 0 : a) + trial_get(trial, h),
               c = trial_get(trial, next);
        double x = row->a * (cos(a) - cos(c)) + row->L * (cos(b) - cos(row->phi));
        double y = row->a * (sin(a) - sin(c)) + row->L * (sin(b) - sin(row->phi));
        worst->gap = fmax(worst->gap, hypot(x, y));
    }
    worst->speed = fmax(worst->speed, windows_speed_off(trial, row));
}

/* Outputs lie in steps as well as at their ends; not for bsimp, whose steps are as long as a turn and whose
 * curve through them is right to 1e-5 in any mechanism. */
void windows_turn(struct checks *checks, const struct row_of_windows *row, const struct hard_method *method)
{
    int outputs = method->name && strcmp(method->name, "bsimp") == 0 ? 1 : 250;
    char *text = windows_text(row);
    assert_non_null(text);
    struct trial trial = trial_parse(text);
    hard_start(&trial, method, NAN);
    struct worst worst = {0, 0};
    for (int k = 1; k <= outputs; k++) {
        trial_to(&trial, 10.0 * k / outputs);
        look(&trial, row, &worst);
    }
    check_that(checks, "it goes round and round", trial_get(&trial, "v0.theta") < -8 * pi);
    hard_case(checks, &trial, "gap of the pins", worst.gap, method->tolerance);
    /* The promise is that of errors that nothing magnifies. Next to the line of all rods a method sees
     * forces that are off by what the state is off, over the slope of the row; and nearer to it than the root
     * of rounding, positions do not tell the branches apart. */
    const double magnified = 100;
    hard_case(checks, &trial, "speed", worst.speed,
              magnified * fmax(hard_promise(&trial), sqrt(DBL_EPSILON)));
    /* Nor does a coordinate that stays zero but for rounding set the pace. */
    if (!method->name) check_that(checks, "few steps", fbd_simulation_stats(trial.simulation).steps < 20000);
    trial_close(&trial);
    free(text);
}
