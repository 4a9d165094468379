/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One right-hand side, as a stepper calls it, against the same equation written by hand in C behind the same
 * function pointer. Both are called in turn over the same states, in blocks; what counts is the median ratio
 * of neighbouring blocks. The values are compared first.
 *
 * The hand-written functions do what a careful person writes once for one system: constants computed
 * beforehand, one square root for a spring, no work that the equation does not need.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "claim.h"
#include "dynamics/modes.h"
#include "dynamics/rates.h"
#include "fbd.h"
#include "lagrange.h"
#include "timing.h"

enum { states = 64, calls = 4000, pairs = 3001, most_size = 8 };

static const double bound = 1.25, bound_of_trees = 1.5;

/* ---- by hand */

struct constants {
    double inverse, a, b, c, d; /* 1/m or 1/I, then what the equation needs */
};

/* m v' = f1 - m g sin(phi) - mu_k m g cos(phi) sign(v):   a = f1 - m g sin(phi), b = mu_k m g cos(phi) */
static int incline(double t, const double y[], double dydt[], void *params)
{
    const struct constants *k = params;
    (void)t;
    dydt[0] = y[1];
    dydt[1] = (k->a - (y[1] < 0 ? -k->b : k->b)) * k->inverse;
    return 0;
}

/* I theta'' = -m g L sin(theta) - c theta':   a = m g L, b = c */
static int pendulum(double t, const double y[], double dydt[], void *params)
{
    const struct constants *k = params;
    (void)t;
    dydt[0] = y[1];
    dydt[1] = (-k->a * sin(y[0]) - k->b * y[1]) * k->inverse;
    return 0;
}

/* m v' = -k1 (x - a) - k2 (x - b) - k3 x + c sin(d t), with k1, k2, k3 = 40, 60, 100 */
static int springs(double t, const double y[], double dydt[], void *params)
{
    const struct constants *k = params;
    dydt[0] = y[1];
    dydt[1] = (-40 * (y[0] - k->a) - 60 * (y[0] - k->b) - 100 * y[0] + k->c * sin(k->d * t)) * k->inverse;
    return 0;
}

/* The same in the plane, from three points of the ground, and an upward force c sin(d t). */
static int springs_in_plane(double t, const double y[], double dydt[], void *params)
{
    static const double anchor[3][2] = {{-1, 0}, {1, 0}, {0, 1.5}}, stiffness[3] = {40, 60, 100};
    const struct constants *k = params;
    double fx = 0, fy = k->c * sin(k->d * t);
    for (int i = 0; i < 3; i++) {
        double dx = y[0] - anchor[i][0], dy = y[1] - anchor[i][1], length = sqrt(dx * dx + dy * dy);
        double pull = stiffness[i] * (length - k->a) / length;
        fx -= pull * dx;
        fy -= pull * dy;
    }
    dydt[0] = y[2];
    dydt[1] = y[3];
    dydt[2] = fx * k->inverse;
    dydt[3] = fy * k->inverse;
    return 0;
}

/* ---- the scenes */

struct system {
    const char *name, *model;
    rates_function *by_hand;
    struct constants constants;
    double angle;              /* amplitude of the first coordinate */
    void (*close)(double y[]); /* makes a state of the scene of one drawn, or NULL */
    bool tree;
};

#define ROD(name, motion)                                                                                    \
    "  " name ": {shape: rod, mass: 1, from: [0, 0], to: " motion ", forces: [gravity]}\n"

static const struct system scenes[] = {
    {"incline",
     "fbd: 1\nbodies:\n  b:\n    mass: 2\n    motion: {slide: {along: 30 deg}}\n    initial: {v: 3}\n"
     "    forces:\n      - gravity\n      - normal\n      - friction: {static: 0.5, kinetic: 0.5}\n"
     "      - applied: {name: push, value: 5}\nsimulate: {until: 1}\n",
     incline,
     {.inverse = 0.5, .a = 5 - 9.81, .b = 0.84957092111253434 * 10},
     .angle = 1},
    {"pendulum with damper",
     "fbd: 1\nbodies:\n  b:\n    shape: point\n    mass: 2\n    center: [0, -0.7 m]\n    motion: {pivot: "
     "{at: [0, 0]}}\n"
     "    initial: {theta: 1 rad}\n    forces: [gravity]\n    moments: [{damper: {coefficient: 0.1}}]\n"
     "simulate: {until: 1}\n",
     pendulum,
     {.inverse = 1 / 0.98, .a = 2 * 9.81 * 0.7, .b = 0.1},
     .angle = 2},
    {"three springs and an expression",
     "fbd: 1\nbodies:\n  b:\n    mass: 2\n    motion: {slide: {along: 0 deg}}\n    forces:\n"
     "      - spring: {name: s1, stiffness: 40, neutral: 0.1}\n"
     "      - spring: {name: s2, stiffness: 60, neutral: -0.2}\n"
     "      - spring: {name: s3, stiffness: 100}\n"
     "      - applied: {name: push, value: \"3*sin(7*t)\"}\nsimulate: {until: 1}\n",
     springs,
     {.inverse = 0.5, .a = 0.1, .b = -0.2, .c = 3, .d = 7},
     .angle = 1},
    {"the same in the plane",
     "fbd: 1\nbodies:\n  b:\n    mass: 2\n    motion: {particle: {}}\n    forces:\n"
     "      - spring: {name: s1, stiffness: 40, free_length: 0.5, to: [-1, 0]}\n"
     "      - spring: {name: s2, stiffness: 60, free_length: 0.5, to: [1, 0]}\n"
     "      - spring: {name: s3, stiffness: 100, free_length: 0.5, to: [0, 1.5]}\n"
     "      - applied: {name: push, value: \"3*sin(7*t)\", angle: 90 deg}\nsimulate: {until: 1}\n",
     springs_in_plane,
     {.inverse = 0.5, .a = 0.5, .c = 3, .d = 7},
     .angle = 1},
    {"double pendulum",
     "fbd: 1\nbodies:\n" ROD("a", "[0, -1], motion: pivot")
         ROD("b", "[0, -1], motion: {pivot: {on: a, at: right, point: left}}") "simulate: {until: 1}\n",
     lagrange_double_pendulum, .angle = 2, .tree = true},
    {"cart and pole",
     "fbd: 1\nbodies:\n  cart: {mass: 0.5, motion: slide, forces: [gravity]}\n"
     "  pole: {mass: 1, center: [0, -1], motion: {pivot: {on: cart}}, forces: [gravity]}\nsimulate: {until: "
     "1}\n",
     lagrange_cart_pole, .angle = 2, .tree = true},
    {"chain of three rods",
     "fbd: 1\nbodies:\n" ROD("a", "[1, 0], motion: pivot")
         ROD("b", "[1, 0], motion: {pivot: {on: a, at: right, point: left}}")
             ROD("c", "[1, 0], motion: {pivot: {on: b, at: right, point: left}}") "simulate: {until: 1}\n",
     lagrange_three_rods, .angle = 2, .tree = true},
    {"slider-crank",
     "fbd: 1\nbodies:\n"
     "  crank: {shape: rod, mass: 1, length: 0.2, motion: {pivot: {point: left}}, initial: {theta: 30 deg},\n"
     "    forces: [gravity], moments: [applied: {name: drive, value: 5}]}\n"
     "  rod: {shape: rod, mass: 1.5, length: 0.5, motion: {pivot: {on: crank, at: right, point: left}},\n"
     "    initial: {assemble: true}, forces: [gravity]}\n"
     "  piston: {mass: 2, motion: slide, initial: {x: 0.6, assemble: true},\n"
     "    forces: [gravity, normal: {two_sided: true}]}\n"
     "couplings: [pin: {name: wrist, between: [rod.right, piston.G]}]\nsimulate: {until: 1}\n",
     lagrange_slider_crank, .angle = 2, .close = lagrange_slider_crank_close, .tree = true},
};

/* ---- measuring */

static double samples[states][most_size];

/* Seconds of `calls` evaluations; through volatile, so that neither function is inlined. */
static double time_of(rates_function *function, void *params, double *sum)
{
    rates_function *volatile called = function;
    double dydt[most_size], start = wall_seconds();
    for (int i = 0; i < calls; i++) {
        called(5e-3 * i, samples[i % states], dydt, params);
        *sum += dydt[1];
    }
    return wall_seconds() - start;
}

static bool measure(const struct system *scene)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(scene->model, strlen(scene->model), scene->name, NULL, 0, errors);
    fbd_errors_print(errors, stderr);
    if (!model) return false;
    struct fbd_state *state = fbd_state_new(model);
    size_t n = (size_t)model->plan.n;
    if (!state || 2 * n > most_size || !modes_settle(state, NULL)) return false;
    struct rates *rates = rates_new(state, rates_by_rows);
    if (!rates) return false;
    void *params;
    rates_function *ours_by_rows = rates_call(rates, &params);
    for (int i = 0; i < states; i++)
        for (size_t k = 0; k < n; k++) {
            samples[i][k] = scene->angle * cos(0.37 * i + (double)k);
            samples[i][n + k] = 1 + 0.5 * sin(0.91 * i + (double)k);
        }
    for (int i = 0; i < states && scene->close; i++) scene->close(samples[i]);
    struct constants constants = scene->constants;
    double worst = 0;
    for (int i = 0; i < states; i++) {
        double a[most_size], b[most_size];
        ours_by_rows(0.1 * i, samples[i], a, params);
        scene->by_hand(0.1 * i, samples[i], b, &constants);
        for (size_t k = 0; k < 2 * n; k++) worst = fmax(worst, fabs(a[k] - b[k]) / (1 + fabs(b[k])));
    }
    static double ours[pairs], hand[pairs], ratio[pairs];
    double sum = 0;
    for (int i = -5; i < pairs; i++) {
        double a = time_of(ours_by_rows, params, &sum), b = time_of(scene->by_hand, &constants, &sum);
        if (i < 0) continue;
        ours[i] = 1e9 * a / calls;
        hand[i] = 1e9 * b / calls;
        ratio[i] = a / b;
    }
    double middle = median(ratio, pairs), most = scene->tree ? bound_of_trees : bound;
    printf("%-32s %6.2f ns, by hand %6.2f ns, ratio %.2f (quartiles %.2f to %.2f), bound %.2f: %s; differ by "
           "%.1e\n",
           scene->name, median(ours, pairs), median(hand, pairs), middle, ratio[pairs / 4],
           ratio[3 * pairs / 4], most, middle <= most ? "met" : "NOT met", worst);
    char what[120];
    snprintf(what, sizeof what, "right-hand side: %s, beside C by hand", scene->name);
    claim_at_most(what, middle, most);
    return isfinite(sum);
}

int main(void)
{
    bool good = true;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) good = measure(&scenes[i]) && good;
    return good ? 0 : 1;
}
