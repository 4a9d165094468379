/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/usual_words.h"

const char kinds_in_list[] = "make a list of them: start each with `- `";

static const char a_weight[] = "the weight is `gravity`, of the mass of the body",
                  a_push[] = "a given force is `applied: {value: 5 N, angle: 30 deg}`",
                  a_torque[] = "a given moment belongs under `moments`: `applied: 3 N*m`",
                  a_couple[] = "a given moment is `applied: 3 N*m`",
                  joins[] = "it joins two ends: write it under `couplings`",
                  a_rope[] = "it is a `rope`, under `couplings`";

const struct usual_word usual_forces[] = {
    {"weight", a_weight},
    {"mg", a_weight},
    {"g", a_weight},
    {"force", a_push},
    {"push", a_push},
    {"pull", a_push},
    {"load", a_push},
    {"moment", a_torque},
    {"torque", a_torque},
    {"couple", a_torque},
    {"tension", "a tension comes with its `rope` or `rod`, under `couplings`"},
    {"rope", joins},
    {"rod", joins},
    {"string", a_rope},
    {"cable", a_rope},
    {"reaction", "reactions of joints and couplings are found, not given"},
    {"N", "it is `normal`, of a slide; of shapes that touch it comes with `contacts`"},
    {"normal_force", "it is `normal`, of a slide; of shapes that touch it comes with `contacts`"},
    {"contact", "contacts are listed under `contacts`, beside `bodies`"},
    {"air", "it is `drag`"},
    {"air_resistance", "it is `drag`"},
    {"resistance", "it is `drag`"},
    {"wind", "moving air is the `wind` of a `drag`: `drag: {linear: 0.4 N*s/m, wind: [2 m/s, 0]}`"},
    {"dashpot", "it is a `damper`"},
    {"viscous", "it is a `damper`"},
    {"motor", a_push},
    {NULL, NULL},
};

const struct usual_word usual_moments[] = {
    {"moment", a_couple},
    {"torque", a_couple},
    {"couple", a_couple},
    {"motor", a_couple},
    {"force", "forces belong under `forces`; their moments about the axis are computed"},
    {"gravity", "it belongs under `forces`; its moment about the axis is computed"},
    {"torsion", "it is a `spring`"},
    {NULL, NULL},
};

const struct usual_word usual_couplings[] = {
    {"string", "it is a `rope`"},
    {"cable", "it is a `rope`"},
    {"cord", "it is a `rope`"},
    {"bar", "it is a `rod`"},
    {"link", "it is a `rod`"},
    {"strut", "it is a `rod`"},
    {"hinge", "it is a `pin`"},
    {"joint", "it is a `pin`"},
    {"chain", "it is a `belt`"},
    {"rolling", "it is a `roll`"},
    {"cam", "it is a `slot` with a closed curve and a `side`"},
    {"groove", "it is a `slot`"},
    {"guide", "it is a `slot`"},
    {"capstan", "it is a `rope` with `around`"},
    {"drum", "it is a `rope` with `wound`"},
    {"winch", "it is a `rope` with `wound`, or with a `length` of t"},
    {"rack_and_pinion", "it is a `rack`"},
    {NULL, NULL},
};

static const char a_slide[] = "along a line it is a `slide`", a_pivot[] = "about an axis it is a `pivot`",
                  a_point[] = "without turning it is a `particle`",
                  a_curve[] = "along a curve it is a `track`: `{track: {y: ..., from: ..., to: ...}}`";
const struct usual_word usual_motions[] = {
    {"free", "in the plane it is `planar`"},
    {"fixed", "to another body it is a `weld`; what never moves is the ground"},
    {"rigid", "to another body it is a `weld`; what never moves is the ground"},
    {"hinge", a_pivot},
    {"pin", a_pivot},
    {"revolute", a_pivot},
    {"rotation", a_pivot},
    {"translation", a_slide},
    {"prismatic", a_slide},
    {"linear", a_slide},
    {"point", a_point},
    {"ball", a_point},
    {"curve", a_curve},
    {"wire", a_curve},
    {"rail", a_curve},
    {"roll", "it is `planar`, and rolls by a `roll` under `couplings`"},
    {"rolling", "it is `planar`, and rolls by a `roll` under `couplings`"},
    {NULL, NULL},
};
