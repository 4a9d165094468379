/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scenes.h"
#include "notes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

const struct named_scene all_scenes[] = {
    {"slide with everything that acts along or across it",
     "fbd: 1\n"
     "parameters: {mu: 0.3}\n"
     "bodies:\n"
     "  block:\n"
     "    mass: 2 kg\n"
     "    motion: {slide: {along: 25 deg, through: [0.3, -0.2]}}\n"
     "    initial: {x: 0.4, v: 1.5 m/s}\n"
     "    forces:\n"
     "      - gravity\n"
     "      - normal\n"
     "      - friction: {static: mu, kinetic: 0.7*mu}\n"
     "      - applied: {name: push, value: '3[N] + 0.2[N/m]*x + 0.5[N]*sin(2[1/s]*t)'}\n"
     "      - applied: {name: tilted, conservative: true, value: 1.5 N, angle: 40 deg}\n"
     "      - applied: {name: swinging, value: 0.8 N, angle: '0.3[1/s]*t + 0.1*x/1[m]'}\n"
     "      - applied: {name: pair, value: [0.4 N, '-0.3[N*s/m]*v']}\n"
     "      - spring: {stiffness: 12 N/m, neutral: 0.1 m}\n"
     "      - spring: {name: slanted, stiffness: 7 N/m, free_length: 0.5 m, to: [1, 2]}\n"
     "      - damper: {coefficient: 0.4 N*s/m}\n"
     "      - damper: {name: dashpot, coefficient: 0.3 N*s/m, to: [-1, 1]}\n"
     "      - drag: {linear: 0.1 N*s/m, quadratic: 0.05 N*s^2/m^2}\n"
     "      - potential: {V: '0.5*3[N/m]*x^2 + 0.25*2[N/m^3]*x^4 - 0.1[N]*x*cos(t/1[s])'}\n"
     "simulate: {until: 1 s}\n"},
    {"masses that vary, of bodies on each other, with thrusts",
     "fbd: 1\n"
     "bodies:\n"
     "  hull:\n"
     "    mass: '3[kg] + 0.5[kg]*sin(hull.x/1[m] + t/1[s])'\n"
     "    shape: rod\n"
     "    length: 1 m\n"
     "    motion: planar\n"
     "    forces:\n"
     "      - gravity\n"
     "      - thrust: {exhaust: '3[m/s] + 0.2*vx', angle: 20 deg, frame: body, at: left}\n"
     "  arm:\n"
     "    mass: '1[kg] + 0.2[kg]*cos(theta)*hull.x/1[m]'\n"
     "    shape: rod\n"
     "    length: 0.6 m\n"
     "    motion: {pivot: {on: hull, at: right, point: left}}\n"
     "    forces:\n"
     "      - gravity\n"
     "      - thrust: {velocity: [1 m/s, '0.3*hull.vx'], at: right}\n"
     "    moments: [damper: 0.1 N*m*s]\n"
     "simulate: {until: 1 s}\n"},
    {"pivot with forces off the axis and moments",
     "fbd: 1\n"
     "gravity: [0.5, -9.7]\n"
     "bodies:\n"
     "  arm:\n"
     "    motion: {pivot: {at: [0.2, 0.1], point: [-0.1, 0.05]}}\n"
     "    parts:\n"
     "      rod: {shape: rod, mass: 1.2 kg, from: [0, 0], to: [0.3, -0.9]}\n"
     "      disc: {shape: disc, mass: 2 kg, radius: 0.2 m, center: [0.3, -0.9]}\n"
     "      hole: {shape: disc, mass: -0.5 kg, radius: 0.1 m, center: [0.3, -0.9]}\n"
     "    points: {P: [0.3, -0.4]}\n"
     "    initial: {theta: 50 deg, omega: -1.1 rad/s}\n"
     "    forces:\n"
     "      - gravity\n"
     "      - applied: {name: world, conservative: true, value: 2 N, angle: 70 deg, at: P}\n"
     "      - applied: {name: follower, value: 1.3 N, angle: 20 deg, frame: body, at: P}\n"
     "      - applied: {name: pulsing, value: '1[N]*cos(3[1/s]*t)', angle: 10 deg, at: P}\n"
     "      - applied: {name: jet, value: '0.3[N*s/rad]*omega', angle: 90 deg, frame: body, at: P}\n"
     "      - spring: {stiffness: 9 N/m, free_length: 0.4 m, at: P, to: [1.5, 0]}\n"
     "      - damper: {coefficient: 0.2 N*s/m, at: P, to: [1.5, 0]}\n"
     "      - drag: {linear: 0.1 N*s/m, quadratic: 0.2 N*s^2/m^2, at: P}\n"
     "    moments:\n"
     "      - applied: {name: motor, value: '0.7[N*m] - 0.2[N*m]*theta'}\n"
     "      - spring: {stiffness: 1.1 N*m/rad, neutral: 10 deg}\n"
     "      - damper: {coefficient: 0.15 N*m*s/rad}\n"
     "      - friction: {static: 0.3 N*m, kinetic: 0.2 N*m}\n"
     "      - potential: {V: '0.4[N*m]*sin(theta)^2'}\n"
     "simulate: {until: 1 s}\n"},
    {"particle in the plane",
     "fbd: 1\n"
     "bodies:\n"
     "  ball:\n"
     "    mass: 0.5 kg\n"
     "    motion: particle\n"
     "    initial: {x: 0.7, y: 0.3, vx: 2, vy: -1}\n"
     "    forces:\n"
     "      - gravity\n"
     "      - applied: {name: wind, value: ['0.3[N]*sin(t/1[s])', '0.1[N/m]*x']}\n"
     "      - applied: {name: thrust, value: '0.6[N] + 0.1[N*s/m]*vx', angle: '0.5*y/1[m]'}\n"
     "      - spring: {stiffness: 20 N/m, free_length: 0.5 m, to: [0, 0]}\n"
     "      - damper: {coefficient: 0.3 N*s/m, to: [0, 0]}\n"
     "      - drag: {linear: 0.05 N*s/m, quadratic: 0.02 N*s^2/m^2}\n"
     "      - potential: {V: '0.5*4[N/m]*x^2*(1 + y/1[m])'}\n"
     "simulate: {until: 1 s}\n"},
    {"planar body whose frame is not at its centre of mass",
     "fbd: 1\n"
     "bodies:\n"
     "  plate:\n"
     "    motion: planar\n"
     "    parts:\n"
     "      a: {shape: prism, mass: 2 kg, a: 0.5 m, b: 0.2 m, center: [0.2, 0.1]}\n"
     "      b: {shape: sphere, mass: 1 kg, radius: 0.1 m, center: [0.6, -0.1]}\n"
     "    points: {P: [0.5, 0.2]}\n"
     "    initial: {x: 0.1, y: 0.2, theta: 30 deg, vx: 1, vy: 2, omega: 3 rad/s}\n"
     "    forces:\n"
     "      - gravity\n"
     "      - applied: {name: world, conservative: true, value: 2 N, angle: 70 deg, at: P}\n"
     "      - applied: {name: follower, value: 1.3 N, angle: 20 deg, frame: body, at: P}\n"
     "      - applied: {name: pulsing, value: '1[N]*cos(3[1/s]*t)', angle: 10 deg, frame: body, at: P}\n"
     "      - spring: {stiffness: 9 N/m, free_length: 0.4 m, at: P, to: [1.5, 0]}\n"
     "      - damper: {coefficient: 0.2 N*s/m, at: P, to: [1.5, 0]}\n"
     "      - drag: {linear: 0.1 N*s/m, quadratic: 0.2 N*s^2/m^2, at: P}\n"
     "    moments:\n"
     "      - applied: {name: motor, conservative: true, value: 0.7 N*m}\n"
     "      - spring: {stiffness: 1.1 N*m/rad, neutral: 10 deg}\n"
     "      - damper: {coefficient: 0.15 N*m*s/rad}\n"
     "simulate: {until: 1 s}\n"},
    {"two bodies that feel each other through expressions",
     "fbd: 1\n"
     "bodies:\n"
     "  a:\n"
     "    mass: 1 kg\n"
     "    motion: slide\n"
     "    initial: {x: 0.2, v: 0.5}\n"
     "    forces:\n"
     "      - gravity\n"
     "      - normal\n"
     "      - friction: {static: 0.2, kinetic: 0.15, surface_speed: '0.3[m/s]*sin(2[1/s]*t)'}\n"
     "      - applied: {name: link, value: '-8[N/m]*(x - b.x) - 0.3[N*s/m]*(v - b.v)'}\n"
     "  b:\n"
     "    mass: 3 kg\n"
     "    motion: slide\n"
     "    initial: {x: -0.1, v: -0.5}\n"
     "    forces:\n"
     "      - applied: {name: link, value: '-8[N/m]*(x - a.x) - 0.3[N*s/m]*(v - a.v)'}\n"
     "simulate: {until: 1 s}\n"},
    {"body that feels the place of a chain of pivots",
     "fbd: 1\n"
     "bodies:\n"
     "  a:\n"
     "    {shape: rod, length: 1 m, mass: 1 kg, motion: {pivot: {at: [0, 0], point: left}}, forces: "
     "[gravity]}\n"
     "  b:\n"
     "    shape: rod\n"
     "    length: 1 m\n"
     "    mass: 1 kg\n"
     "    motion: {pivot: {on: a, at: right, point: left}}\n"
     "    initial: {theta: 40 deg}\n"
     "    forces: [gravity]\n"
     "  c:\n"
     "    mass: 1 kg\n"
     "    motion: {particle: {}}\n"
     "    initial: {x: 2}\n"
     "    forces:\n"
     "      - applied: {name: link, fx: '-8[N/m]*(x - b.right.x)', fy: 3*b.angle}\n"
     "simulate: {until: 1 s}\n"},
};

const size_t all_scenes_count = sizeof all_scenes / sizeof *all_scenes;

fbd_model *model_from(const char *text)
{
    fbd_errors *errors = fbd_errors_new();
    assert_non_null(errors);
    fbd_model *model = fbd_model_parse(text, strlen(text), "scene", NULL, 0, errors);
    if (!model || count_other_notes(errors) > 0) fbd_errors_print(errors, stderr);
    assert_non_null(model);
    assert_int_equal(count_other_notes(errors), 0);
    fbd_errors_free(errors);
    return model;
}
