/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The independent assembly: maximal coordinates, dense, plain.
 *
 * Every body has three coordinates: its centre of mass G in the world and the angle of its frame. Its
 * equations are m a_G = f, I_G alpha = M_G. What joins bodies is a row g(positions, t) = 0, written as it
 * stands in a book, and nothing else: with series.h its gradient J is g along one coordinate at a time, and
 * gamma = -(g'' along the motion with a = 0). Then
 *
 *     [ M  -D ] [ a      ]   [ f     ]
 *     [ J   0 ] [ lambda ] = [ gamma ]
 *
 * with D = J^T, but for dry friction, whose force has a place of its own and, while it slips, is no unknown:
 * it is mu N, and adds to the column of N.
 */
#ifndef CROSS_ABSOLUTE_H
#define CROSS_ABSOLUTE_H

#include <stddef.h>

#include "scene.h"
#include "series.h"

enum {
    most_rows = 4 * most_bodies + 4 * most_couplings,
    most_unknowns = 3 * most_bodies + most_rows,
    most_wrenches = 24 * most_bodies,
    wrench_name_room = 2 * name_room + 12,
    most_grips = most_bodies + 2 * most_couplings,
};

enum row_kind {
    row_angle,   /* of the body in the frame that it moves on, less a constant */
    row_across,  /* slide: off its line */
    row_along,   /* slide: along its line */
    row_track,   /* off its curve */
    row_tangent, /* of the frame in the direction of its curve */
    row_pin_x,   /* pivot, weld: off the point, along x of the world */
    row_pin_y,
    row_link_pin_x, /* the same of a coupling */
    row_link_pin_y,
    row_rod,
    row_slot,         /* off its curve, on the left of it */
    row_slot_along,   /* the length along its curve */
    row_rope,         /* a piece between two places that hold it */
    row_capstan,      /* all of a rope that rubs on a drum */
    row_capstan_slip, /* half of what its second strand is longer than the first, against the drum */
    row_gear,
    row_belt_turn, /* half of what one strand is longer than the other */
    row_belt_length,
    row_rack,
    row_roll_normal,
    row_roll_along,
};

struct row {
    enum row_kind kind;
    int owner;      /* body, or coupling */
    int from, to;   /* rope: ends of the piece */
    double zero;    /* g of the start, for what is only kept */
    double side;    /* roll, rack: +1 when the circle is on the left of the line; rope: see below */
    double turn[2]; /* rope: +1 when it runs counter-clockwise round the pulley at its end; round the drum */
    const struct formula *drive; /* g is this function of time; or speed of a surface (its rate) */
    int grip;                    /* whose friction this row is when it holds, or -1 */
};

/* What holds up to a limit: a surface, and dry friction on it, in a bearing, of a rolling body or in a slot; a rope, and its
 * friction on a drum, behind it. */
enum grip_kind { grip_contact, grip_surface, grip_bearing, grip_tread, grip_rope, grip_capstan };
enum grip_mode { holds = 0, slips_plus = 1, slips_minus = -1, lets_go = 2 };

struct grip {
    enum grip_kind kind;
    int owner, load; /* body and number of its load; or coupling */
    int row, normal; /* the row that holds, and that of the normal force or -1 */
    double press;    /* N = press * lambda */
    enum grip_mode mode;
};

struct wrench {
    int body;
    char name[wrench_name_room];
    double w[3];     /* force, and moment about G */
    double doubt[3]; /* what one solution of the homogeneous equations would add */
    bool unique;     /* redundant conditions leave no doubt of it */
};

struct absolute {
    const struct scene *scene;
    int n, row_count, grip_count;
    struct mass mass[most_bodies], first_mass[most_bodies]; /* now; at the start */
    struct row row[most_rows];
    struct grip grip[most_grips];

    /* the instant */
    double t;
    double x[3 * most_bodies], v[3 * most_bodies], z[most_states];
    struct {
        struct series x, y, angle, c, s;
    } pose[most_bodies];

    /* the answer */
    bool active[most_rows];
    bool spare[most_rows]; /* says nothing that the others do not say */
    double a[3 * most_bodies], lambda[most_rows];
    double J[most_rows][3 * most_bodies], gamma[most_rows];
    double D[most_rows][3 * most_bodies]; /* what lambda does */
    int wrench_count;
    struct wrench wrench[most_wrenches];
    double force_size, acceleration_size; /* the largest terms */
    double condition;
    bool redundant, accelerations_unique, consistent;
    /* Of an integration, the first step that ended where a guide is pushed to neither side: each newton more of its normal force
     * brings so much friction that it takes it away again (Painleve). Its start and its end; INFINITY before. */
    double unpushed_from, unpushed_to;
    bool modes_in_doubt; /* redundant conditions leave open what something that holds takes */
};

/* Rows and grips of a scene, with the start that it states; rows keep what they have there. */
void absolute_start(struct absolute *absolute, const struct scene *scene);

/* Positions and velocities from the joint coordinates of the scene (order of bodies) and from time. */
void absolute_place(struct absolute *absolute, double t, const double *q, const double *v);

/* Joint coordinates and rates where the bodies are. */
void absolute_coordinates(const struct absolute *absolute, double *q, double *v);

/* start.c: which way the rope runs round the disc at end k that it is wound on, +1 counter-clockwise; `margin`: by how
 * much of the radius the other way is less to the side that is named. */
double wound_turn(const struct absolute *absolute, const struct coupling *coupling, int k, double *margin);

/* ropes.c: the straight pieces of a rope, where its discs are those that it is wound on. */
double straight_way(const struct absolute *absolute, const struct coupling *coupling);

/* By which angle a rope lies on its drum; between -90 and 270 degrees, and whole turns. */
double wrap_of(const struct absolute *absolute, const struct row *row);

/* kinematics.c: series of bodies and points. `seed`: a maximal coordinate that varies, or one of: */
enum { seed_motion = -1, seed_path = -2 }; /* with velocities and a = 0; with accelerations too */
void absolute_seed(struct absolute *absolute, int seed);
struct place point_of(const struct absolute *absolute, int body, struct vec2 point);
struct place direction_of(const struct absolute *absolute, int body, double angle);
/* The place of end k of a coupling: of a circle, its centre. */
struct place end_place(const struct absolute *absolute, const struct coupling *coupling, int k);

/* ropes.c */
struct series rope_value(const struct absolute *absolute, const struct row *row);
struct series capstan_value(const struct absolute *absolute, const struct row *row);
struct series belt_value(const struct absolute *absolute, const struct row *row);

/* paths.c: r(p) or a derivative of it, the foot of a place, how far it is on the left of that, the length from p = 0,
 * and p at such a length. */
struct place path_place(const struct path *path, struct series p, int derivative);
struct series path_foot(const struct path *path, struct place C);
struct series path_distance(const struct path *path, struct place C);
struct series path_length(const struct path *path, struct series p);
struct series path_parameter(const struct path *path, struct series s);

struct place tangent_of(const struct absolute *absolute,
                        int body); /* of the curve that it moves on, at its point */
struct series angle_of(const struct absolute *absolute, int body);
struct series row_value(const struct absolute *absolute, const struct row *row);
struct series coordinate_of(const struct absolute *absolute, int body, int index);
double shortest_piece(const struct absolute *absolute); /* of all ropes; INFINITY without */
size_t row_bodies(const struct absolute *absolute, const struct row *row, int *bodies);

/* Fill J, gamma and D of all rows at the instant. */
void absolute_rows(struct absolute *absolute);

/* From where any force acts to the point that it points to: the shortest way, INFINITY without. */
double shortest_pull(const struct absolute *absolute);

/* scene.c: the masses of the instant. */
void absolute_masses(struct absolute *absolute);

/* loads.c: all forces that are no unknowns into `f`, and with `list` as wrenches by name. */
void absolute_loads(struct absolute *absolute, double *f, bool list);
struct wrench *wrench_of(struct absolute *absolute, int body, const char *name);

/* reactions.c: every row as named forces; those of the null space, as doubts. */
void absolute_list(struct absolute *absolute, const double *lambda, bool doubt);

/* Limit of a grip that holds: mu_s N; of one that slips: mu_k N. 1 in place of N for a bearing. */
double grip_coefficient(const struct absolute *absolute, const struct grip *grip, bool kinetic);

/* Does a strand of a belt push? */
bool belts_push(const struct absolute *absolute);

/* Accelerations and multipliers in the modes of the grips. With `list`, all wrenches and what is unique. */
void absolute_solve(struct absolute *absolute, bool list);

/* Modes of the grips at the start: by velocity, and where that is zero by trial. False when no single choice
 * is consistent. */
bool absolute_settle(struct absolute *absolute);

/* Turn the sign of normal forces of guides where they have turned; false when nothing was to be turned. */
bool absolute_turn_guides(struct absolute *absolute);

/* Is there a guide whose normal force is of the wrong sign on either side? At the state as it is. */
bool absolute_jams(struct absolute *absolute);

/* Size of the largest violation of any limit of the grips in the present modes, over the largest force. */
double absolute_excess(const struct absolute *absolute);

/* Nearest state (in the sense of the masses) that fits: velocities, and with `positions` these before. */
bool absolute_project(struct absolute *absolute, bool positions);

/* The largest gap of a condition on positions, or in its rate. */
double absolute_gap(struct absolute *absolute, bool position);

/* Integrate to time t, the modes as they are. False where that takes too many steps, or where what a rope
 * holds comes to its pulley. */
bool absolute_integrate(struct absolute *absolute, double t, double tolerance);

/* formula.c: with `seed` a variable's number of a body's own coordinate, the derivative in it; or -1: in time
 * alone. */
struct series formula_series(const struct absolute *absolute, const struct formula *formula, int own,
                             int seed);
double formula_value(const struct absolute *absolute, const struct formula *formula);
/* How fast one changes that names no rates. */
double formula_rate(const struct absolute *absolute, const struct formula *formula);

#endif
