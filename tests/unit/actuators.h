/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random bodies on slides with friction, stops and winches, which motors, controllers, relays, tables, winds, loads along lines
 * and masses that vary drive, as models and for the time stepping of moreau.h.
 */
#ifndef FBD_TESTS_ACTUATORS_H
#define FBD_TESTS_ACTUATORS_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "moreau.h"
#include "random_numbers.h"
#include "stepped.h"
#include "written.h"

enum { act_most = 3, act_most_bodies = 3, act_points = 7 };
static const double act_g = 10; /* m/s^2 */

enum act_kind {
    act_wave,    /* A sin(w t + phase) */
    act_motor,   /* k i, i' = (U - R i - k v)/L; U is square */
    act_control, /* clamp(kp e + ki z - kd v, -F, F), z' = e where z is within bounds; e = r - x */
    act_timed,   /* a table of the time */
    act_placed,  /* a table of the place */
    act_relay,   /* F hysteresis(x, low, high) */
    act_bumper,  /* if(x > a, -k (x - a) - c v, 0) */
    act_drag,    /* through a wind */
    act_load,    /* along a line of the body */
    act_sliding, /* -F sign(x - r + T v) */
    act_joined,  /* a spring and a damper to the next body */
    act_kinds
};

enum act_interpolation { act_linear, act_step, act_cubic };
enum act_beyond { act_hold, act_zero, act_repeat };

struct act_table {
    enum act_interpolation interpolation;
    enum act_beyond beyond;
    double x[act_points], y[act_points], bend[act_points];
};

struct act {
    enum act_kind kind;
    double p[8];
    struct act_table table;
    int state;   /* its slot; -1: none */
    double side; /* of a relay */
};

struct act_body {
    double m, along, x, v;
    double flow,
        jet; /* of its mass [kg/s]; what comes has the velocity `jet` along the slide, what leaves goes by it against +x */
    bool comes;
    double mu, stribeck, scale, pulse,
        pulse_w; /* coefficient (mu + stribeck exp(-slip/scale)) (1 + pulse sin(pulse_w t)) */
    double belt, belt_shaken, belt_w;
    bool has_stop[2];
    double stop[2], e;
    bool has_rope;
    double anchor, length, haul,
        haul_w; /* a rope to x = anchor of its line; its length is length + haul sin(haul_w t) */
    int acts;
    struct act act[act_most];
    double press; /* |N|, at the middle of the step */
    double slip_mu;
};

struct act_scene {
    int count, states;
    struct act_body body[act_most_bodies];
    double until;
    struct act_body *live; /* its bodies, for what a step remembers */
};

/* Of a struct act_scene, as stepped.h takes them. */
void act_draw(uint64_t seed, void *scene);
void act_write(const void *scene, struct written *text);

/* By time stepping, with coordinates and rates as the model names them. */
struct stepped_values act_step_to(void *scene, int steps);

#endif
