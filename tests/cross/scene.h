/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A scene as the generator makes it: what a model file says, as numbers in the units of the scene. It is
 * written as YAML for the library and read as it is by the independent assembly.
 */
#ifndef CROSS_SCENE_H
#define CROSS_SCENE_H

#include <stdbool.h>
#include <stdint.h>

enum {
    most_bodies = 10,
    most_pieces = 3,
    most_points = 8,
    most_loads = 8,
    most_couplings = 8,
    most_ends = 5,
    most_parameters = 4,
    most_summands = 8,
    most_variables = 4,
    most_lines = 3,
    most_tables = 2,
    most_states = 2,
    most_table_points = 7,
    name_room = 24,
};

struct vec2 {
    double x, y;
};

/* ---- formulas: sum of factor * function(sum of coefficient * variable + shift) */

enum function {
    f_one, /* 1: a constant */
    f_linear,
    f_sin,
    f_cos,
    f_tanh,
    f_square,
    f_bell,  /* exp(-u^2) */
    f_hyper, /* sqrt(1 + u^2) */
    f_atan,
    f_abs,
    f_step,
    f_ramp, /* max(0, u) */
    f_clamp,
    f_branch, /* if(u > 0, u^2, 0) */
    function_count,
    f_table = function_count, /* a table of the scene */
};

enum variable_kind {
    var_time,
    var_coordinate, /* of `body`, number `index`: x, theta, or x y theta */
    var_rate,
    var_place_x, /* in the world: of point `index` of `body`, or of its origin (index -1) */
    var_place_y,
    var_place_vx,
    var_place_vy,
    var_angle, /* of the frame of `body` in the world */
    var_angle_rate,
    var_state, /* number `index` of the scene */
};

struct variable {
    enum variable_kind kind;
    int body, index;
    double coefficient;
};

struct summand {
    double factor;
    int parameter; /* the factor is this parameter times `factor`; or -1 */
    enum function function;
    int table;
    int count;
    struct variable variable[most_variables];
    double shift;
};

/* A function by its points, numbers of numbers. */
enum interpolation { by_lines, by_steps, by_cubics, by_akima, by_steffen };
enum beyond { beyond_holds, beyond_is_zero, beyond_repeats };

struct table {
    enum interpolation interpolation;
    enum beyond beyond;
    int count;
    double x[most_table_points], y[most_table_points];
};

/* What a formula is: chooses the units of its literals. */
enum dimension {
    dim_number,
    dim_angle,
    dim_length,
    dim_speed,
    dim_angular_speed,
    dim_force,
    dim_moment,
    dim_energy,
    dim_mass,
    dimension_count
};

struct formula {
    enum dimension dimension;
    int count;
    struct summand summand[most_summands];
};

/* ---- bodies */

enum motion { slide, pivot, particle, planar, weld, track };

/* A plane curve, turned by `along`: a line through the origin; (p, a sin(wave p + b)); (a cos p, b sin p). */
enum path_form { path_line, path_wave, path_oval };

struct path {
    enum path_form form;
    double along, a, b, wave, from, to;
};

enum shape {
    point_shape,
    rod_shape,
    sphere_shape,
    disc_shape,
    tube_shape,
    prism_shape,
    ring_shape,
    given_inertia
};

struct piece {
    enum shape shape;
    double mass,
        size[3]; /* rod: length; round: radius (tube: outer, inner); prism: a, b; inertia: I, about */
    struct vec2 center;
    double angle;
    bool lies; /* the other axis of the shape faces the plane */
};

enum { at_origin = -3, at_G = -2, at_pair = -1 };

/* A point of a body: number of its named points, or one of the above. */
struct spot {
    int point;
    struct vec2 where;
};

enum load_kind {
    gravity,
    normal,
    friction,
    applied,
    spring,
    damper,
    drag,
    potential,
    distributed,
    thrust,
    moment_applied,
    moment_spring,
    moment_damper,
    moment_friction,
    moment_potential,
};

enum applied_form { along_slide, along_angle, components, toward_point };
enum side { left_side, right_side };

struct load {
    enum load_kind kind;
    char name[name_room];
    enum applied_form form;
    bool follows;
    struct formula value, second; /* applied: size and angle, or fx and fy; friction: mu_s, mu_k; V */
    struct formula surface;       /* speed of the surface */
    bool to_ground;               /* spring, damper: to `to`; else along the slide */
    struct vec2 to;
    struct spot at;
    int target;      /* toward: this body, or -1 for `to` on the ground; */
    struct spot end; /* its point, by name or G; */
    int power;       /* the size is `value` times (reach / distance)^power */
    double reach;
    bool placed; /* applied: beside `at`, along the axes of the world */
    struct formula offset[2];
    bool windy; /* drag */
    struct formula wind[2];
    double per_length
        [2];     /* distributed, from `at` to `end`, `value` times: at both ends, straight between them; */
    bool curved; /* or [0] + [1] s^2 */
    bool
        enters; /* thrust: of the velocity (value, second) in the world, or along the slide; else an exhaust */
    double stiffness, neutral, coefficient, quadratic;
    enum side side;
    bool two_sided;
};

struct body {
    char name[name_room];
    enum motion motion;
    int on; /* the body that it moves on, or -1 */
    double along;
    struct spot at;    /* on `on`: the axis, zero of the slide, or place of the weld */
    struct spot point; /* of its own, that sits there */
    struct path path;  /* track: from `at`, in the frame of `on` */
    bool keeps_direction;
    bool driven;
    struct formula drive;
    bool mass_varies; /* it has one piece then, */
    struct formula mass;
    int piece_count;
    struct piece piece[most_pieces];
    int point_count;
    struct vec2 points[most_points];
    double q[3], v[3];
    int load_count;
    struct load load[most_loads];
};

/* ---- couplings */

enum coupling_kind { spring_of_two, damper_of_two, pin, rod, rope, gear, rack, roll, belt, slot };

enum wound_side { wound_left, wound_right, wound_top, wound_bottom };

struct end {
    int body; /* or -1: `at` is then a pair, as a named point of the ground */
    struct spot at;
    bool pulley;
    bool wound;    /* the rope ends here round a disc (which is a pulley), */
    double radius; /* of this radius; 0: that of the shape */
    enum wound_side side;
};

struct coupling {
    enum coupling_kind kind;
    char name[name_room];
    int count;
    struct end end[most_ends];
    double stiffness, free_length, coefficient;
    double radius[2]; /* 0: that of the shape */
    double length;    /* 0: as at the start */
    bool reels;       /* rope: its length is */
    struct formula reel;
    bool rubs; /* rope: on a drum of radius[0], the second of its three ends, with mu_s and mu_k; */
    int turns; /* whole turns beside what the ends tell */
    bool held; /* and does not slip at the start; slot: nor does its pin */
    bool inside;
    bool crossed;   /* belt */
    double tension; /* belt on axes that keep their distance: of both strands while it drives nothing; or 0 */
    bool centered;  /* roll: about end[0].at, not about the round part */
    struct path
        path; /* slot: from end[1], on which the place end[0] stays, or a circle of radius[0] about it */
    bool one_sided;
    enum side side;
    int line; /* roll: of the ground, or -1 for the x axis of end[1] */
    bool has_friction;
    struct formula mu_s, mu_k;
};

struct line {
    struct vec2 through;
    double along;
};

/* An equation of first order, z' = rate. */
struct state {
    struct formula rate;
    double initial;
};

struct scene {
    uint64_t seed;
    bool us;
    struct vec2 gravity;
    int parameter_count;
    double parameter[most_parameters];
    int body_count, coupling_count, line_count, table_count, state_count;
    struct table table[most_tables];
    struct state state[most_states];
    struct body body[most_bodies];
    struct coupling coupling[most_couplings];
    struct line line[most_lines];
};

/* ---- what follows from it at once */

struct mass {
    double m, I_G;
    struct vec2 G;
};

int coordinate_count(enum motion motion);
struct mass mass_of(const struct body *body);
struct vec2 spot_of(const struct body *body, const struct spot *spot);
const struct piece *round_piece(const struct body *body);

/* Radius and centre of the circle at end k of a gear, belt, rack, roll or pulley. */
double circle_of(const struct scene *scene, const struct coupling *coupling, int k, struct vec2 *centre);

/* tables.c: the function, its slope and its second derivative. */
void value_by_table(const struct table *table, double u, double f[3]);

struct formula constant_formula(enum dimension dimension, double value);
bool formula_is_constant(const struct formula *formula);

#endif
