/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/language.h"
#include "scene/usual_words.h"

/* ---- body and parts */

static const struct choice shapes[] = {
    {"point", shape_point, "all mass in one point"},
    {"rod", shape_rod, "slender, along x"},
    {"sphere", shape_sphere, "solid"},
    {"cylinder", shape_cylinder, "solid, symmetric about x"},
    {"disc", shape_cylinder, "the same as cylinder"},
    {"disk", shape_cylinder, "the same as cylinder"},
    {"solid_cylinder", shape_cylinder, "the same as cylinder"},
    {"hollow_cylinder", shape_hollow_cylinder, "symmetric about x"},
    {"prism", shape_prism, "solid, sides a, b, c along x, y, z"},
    {"rectangular_prism", shape_prism, "the same as prism"},
    {"ring", shape_ring, "thin, symmetric about x"},
    {"thin_ring", shape_ring, "the same as ring"},
    {"polygon", shape_polygon, "a plate with `corners`, convex"},
};

static const struct choice axes[] = {
    {"x", 'x', "the shape's x axis faces the plane"},
    {"y", 'y', "the shape's y axis faces the plane"},
    {"z", 'z', "the shape's z axis faces the plane"},
};

static const struct field part_fields[] = {
    FIELD_NUMBER(offsetof(struct part_keys, mass), "mass", a_mass, may_vary | stored,
                 "its mass, of a body it may vary; below zero for a hole in a part"),
    FIELD_CHOICE(offsetof(struct part_keys, shape), "shape", shapes, "its form; default point"),
    FIELD_CHOICE(
        offsetof(struct part_keys, axis), "axis", axes,
        "the axis of the shape that is perpendicular to the drawing; default x for a cylinder or ring, "
        "z for the rest"),
    FIELD_NUMBER(offsetof(struct part_keys, length), "length", a_length, positive | stored,
                 "length of a rod or cylinder"),
    FIELD_NUMBER(offsetof(struct part_keys, radius), "radius", a_length, positive | stored,
                 "radius of a sphere, cylinder or ring"),
    FIELD_NUMBER(offsetof(struct part_keys, outer_radius), "outer_radius", a_length, positive,
                 "outer radius of a hollow cylinder"),
    FIELD_NUMBER(offsetof(struct part_keys, inner_radius), "inner_radius", a_length, not_negative,
                 "inner radius of a hollow cylinder"),
    FIELD_NUMBER(offsetof(struct part_keys, a), "a", a_length, positive | stored,
                 "side of a prism along its x axis"),
    FIELD_NUMBER(offsetof(struct part_keys, b), "b", a_length, positive | stored,
                 "side of a prism along its y axis"),
    FIELD_NUMBER(offsetof(struct part_keys, c), "c", a_length, positive | stored,
                 "side of a prism along its z axis"),
    FIELD_VECTOR(offsetof(struct part_keys, from), "from", a_length, "left end of a rod, in the body frame"),
    FIELD_VECTOR(offsetof(struct part_keys, to), "to", a_length, "right end of a rod, in the body frame"),
    FIELD_ENTRIES(offsetof(struct part_keys, corners), "corners", field_list, 0, each_pair, NULL,
                  "corners of a polygon, in order, in the body frame"),
    FIELD_VECTOR(offsetof(struct part_keys, center), "center", a_length,
                 "its centre of mass in the body frame; default [0, 0]"),
    FIELD_NUMBER(offsetof(struct part_keys, angle), "angle", an_angle, 0,
                 "of its x axis in the body frame; default 0"),
    FIELD_NODE(offsetof(struct part_keys, inertia), "inertia", field_any, 0, &inertia_group,
               "its moment of inertia, about its centre of mass or the point `about`"),
};

const struct group part_group = {"a part", NULL, FIELDS(part_fields), NULL, 0, "one piece of a body"};

static const struct field inertia_fields[] = {
    FIELD_NUMBER(offsetof(struct inertia_keys, value), "value", an_inertia, stored, "the moment of inertia"),
    FIELD_NUMBER(offsetof(struct inertia_keys, gyration), "radius_of_gyration", a_length, positive | stored,
                 "k, in place of its value: I = m k^2"),
    FIELD_NODE(offsetof(struct inertia_keys, about), "about", field_any, 0, NULL,
               "G, O (the pivot), a point of the body or [x, y]; default G"),
};

const struct group inertia_group = {"`inertia`", "value", FIELDS(inertia_fields),
                                    NULL,        0,       "a moment of inertia that is known"};

/* ---- motion */

#define MOTION(member) offsetof(struct motion_keys, member)
#define ON_ROW                                                                                               \
    FIELD_NODE(MOTION(on), "on", field_scalar, 0, NULL, "the body that it moves on; default the ground")

#define STOP_ROWS                                                                                            \
    FIELD_NODE(MOTION(low), "min", field_scalar, 0, NULL, "a stop: the least that the coordinate can be"),   \
        FIELD_NODE(MOTION(high), "max", field_scalar, 0, NULL, "a stop: the most that it can be"),           \
        FIELD_NUMBER(MOTION(restitution), "restitution", a_number, not_negative | stored,                    \
                     "e of an impact on a stop, 0 to 1; default 0")

static const struct field slide_fields[] = {
    FIELD_NUMBER(MOTION(along), "along", an_angle, stored, "direction of +x; default 0: to the right"),
    FIELD_NODE(MOTION(through), "through", field_any, 0, NULL,
               "where x = 0: [x, y] or a point of its parent; default [0, 0]"),
    FIELD_NODE(MOTION(line), "line", field_scalar, 0, NULL,
               "a line of the ground, instead of `along` and `through`"),
    FIELD_NODE(MOTION(prescribed), "x", field_scalar, 0, NULL, "prescribed: an expression of t"),
    STOP_ROWS,
    ON_ROW,
};

static const struct group slide_group = {"a slide", NULL, FIELDS(slide_fields),
                                         NULL,      0,    "one coordinate x along a line"};

static const struct field pivot_fields[] = {
    FIELD_NODE(MOTION(at), "at", field_any, 0, NULL,
               "the axis O: [x, y] or a point of its parent; default [0, 0]"),
    FIELD_NODE(MOTION(point), "point", field_any, 0, NULL,
               "the point of the body on the axis: a name or [x, y]; default the origin of the body frame"),
    FIELD_NODE(MOTION(prescribed), "theta", field_scalar, 0, NULL, "prescribed: an expression of t"),
    STOP_ROWS,
    ON_ROW,
};

static const struct group pivot_group = {"a pivot", NULL, FIELDS(pivot_fields),
                                         NULL,      0,    "one coordinate theta about an axis"};

static const struct field free_fields[] = {ON_ROW};

static const struct group particle_group = {
    "a particle", NULL, FIELDS(free_fields),
    NULL,         0,    "coordinates x, y of a body that does not turn relative to its parent"};

static const struct group planar_group = {"a planar motion",
                                          NULL,
                                          FIELDS(free_fields),
                                          NULL,
                                          0,
                                          "coordinates x, y of the frame's origin, and theta"};

static const struct field weld_fields[] = {
    FIELD_NODE(MOTION(on), "on", field_scalar, required, NULL, "the body that it is fixed on"),
    FIELD_NODE(MOTION(at), "at", field_any, 0, NULL, "where: [x, y] or a point of that body; default [0, 0]"),
    FIELD_NODE(MOTION(point), "point", field_any, 0, NULL,
               "the point of the body that sits there; default the origin of the body frame"),
    FIELD_NUMBER(MOTION(angle), "angle", an_angle, 0,
                 "of the body frame in the frame of that body; default 0"),
};

static const struct group weld_group = {"a weld", NULL, FIELDS(weld_fields),
                                        NULL,     0,    "no coordinate: fixed on another body"};

static const struct field track_fields[] = {
    FIELD_NODE(MOTION(x), "x", field_scalar, 0, NULL,
               "x of the curve as an expression of p; without it y is one of x"),
    FIELD_NODE(MOTION(y), "y", field_scalar, required, NULL, "y of the curve as an expression of p, or of x"),
    FIELD_NODE(MOTION(from), "from", field_scalar, required, NULL, "p, or x, where it begins"),
    FIELD_NODE(MOTION(to), "to", field_scalar, required, NULL, "p, or x, where it ends"),
    FIELD_FLAG(MOTION(closed), "closed", "true: its ends meet, and it is closed"),
    FIELD_FLAG(MOTION(turn), "turn",
               "false: the body keeps its direction; default: its x axis is the tangent"),
    FIELD_NODE(MOTION(at), "at", field_any, 0, NULL,
               "the origin of x and y: [x, y] or a point of its parent; default [0, 0]"),
    FIELD_NODE(MOTION(point), "point", field_any, 0, NULL,
               "the point of the body on the curve: a name or [x, y]; default the origin of the body frame"),
    FIELD_NODE(MOTION(prescribed), "s", field_scalar, 0, NULL, "prescribed: an expression of t"),
    ON_ROW,
};

static const struct group track_group = {"a track", NULL, FIELDS(track_fields),
                                         NULL,      0,    "one coordinate s, the length along a curve"};

static const struct kind motions[] = {
    {"slide", motion_slide, &slide_group, ~0u, NULL, NULL},
    {"pivot", motion_pivot, &pivot_group, ~0u, NULL, NULL},
    {"particle", motion_particle, &particle_group, ~0u, NULL, NULL},
    {"planar", motion_planar, &planar_group, ~0u, NULL, NULL},
    {"weld", motion_weld, &weld_group, ~0u, NULL, NULL},
    {"track", motion_track, &track_group, ~0u, NULL, NULL},
};

const struct kinds motion_kinds = {"motion", FIELDS(motions), usual_motions,
                                   "a body moves in one way: choose"};

/* ---- initial values */

#define POSITION(index, key)                                                                                 \
    FIELD_NUMBER(offsetof(struct initial_keys, q[index]), key, a_length, stored, "position at t = 0")
#define SPEED(index, key)                                                                                    \
    FIELD_NUMBER(offsetof(struct initial_keys, v[index]), key, a_velocity, stored, "velocity at t = 0")
#define ANGLE(index)                                                                                         \
    FIELD_NUMBER(offsetof(struct initial_keys, q[index]), "theta", an_angle, stored, "angle at t = 0")
#define ANGLE_RATE(index)                                                                                    \
    FIELD_NUMBER(offsetof(struct initial_keys, v[index]), "omega", an_angular_velocity, stored,              \
                 "angular velocity at t = 0")

#define ASSEMBLE                                                                                             \
    FIELD_FLAG(offsetof(struct initial_keys, assemble), "assemble",                                          \
               "true: given values are guesses; couplings determine them")

static const struct field slide_initial[] = {POSITION(0, "x"), SPEED(0, "v"), ASSEMBLE};
static const struct field pivot_initial[] = {ANGLE(0), ANGLE_RATE(0), ASSEMBLE};
static const struct field particle_initial[] = {POSITION(0, "x"), POSITION(1, "y"), SPEED(0, "vx"),
                                                SPEED(1, "vy"), ASSEMBLE};
static const struct field planar_initial[] = {POSITION(0, "x"), POSITION(1, "y"), ANGLE(2), SPEED(0, "vx"),
                                              SPEED(1, "vy"),   ANGLE_RATE(2),    ASSEMBLE};
static const struct field track_initial[] = {POSITION(0, "s"), SPEED(0, "v"),
                                             FIELD_NODE(offsetof(struct initial_keys, p), "p", field_scalar,
                                                        0, NULL,
                                                        "place at t = 0 by the parameter of the curve"),
                                             FIELD_NODE(offsetof(struct initial_keys, x), "x", field_scalar,
                                                        0, NULL, "likewise, of a curve y(x)"),
                                             ASSEMBLE};

const struct group initial_groups[] = {
    [motion_slide] = {"`initial` of a slide", NULL, FIELDS(slide_initial), NULL, 0, "state at t = 0"},
    [motion_pivot] = {"`initial` of a pivot", NULL, FIELDS(pivot_initial), NULL, 0, "state at t = 0"},
    [motion_particle] = {"`initial` of a particle", NULL, FIELDS(particle_initial), NULL, 0,
                         "state at t = 0"},
    [motion_planar] = {"`initial` of a planar body", NULL, FIELDS(planar_initial), NULL, 0, "state at t = 0"},
    [motion_weld] = {"`initial` of a weld", NULL, NULL, 0, NULL, 0, "a weld has no coordinate"},
    [motion_track] = {"`initial` of a track", NULL, FIELDS(track_initial), NULL, 0, "state at t = 0"},
};

/* ---- exact solutions */

#define KNOWN(where, key, quantity)                                                                          \
    FIELD_VALUE(offsetof(struct exact_keys, where), key, quantity, 0, "as an expression of t")

static const struct field slide_exact[] = {KNOWN(q[0], "x", a_length), KNOWN(v[0], "v", a_velocity)};
static const struct field pivot_exact[] = {KNOWN(q[0], "theta", an_angle),
                                           KNOWN(v[0], "omega", an_angular_velocity)};
static const struct field particle_exact[] = {KNOWN(q[0], "x", a_length), KNOWN(q[1], "y", a_length),
                                              KNOWN(v[0], "vx", a_velocity), KNOWN(v[1], "vy", a_velocity)};
static const struct field planar_exact[] = {
    KNOWN(q[0], "x", a_length),    KNOWN(q[1], "y", a_length),    KNOWN(q[2], "theta", an_angle),
    KNOWN(v[0], "vx", a_velocity), KNOWN(v[1], "vy", a_velocity), KNOWN(v[2], "omega", an_angular_velocity)};
static const struct field track_exact[] = {KNOWN(q[0], "s", a_length), KNOWN(v[0], "v", a_velocity)};

const struct group exact_groups[] = {
    [motion_slide] = {"`exact` of a slide", NULL, FIELDS(slide_exact), NULL, 0, "the known solution"},
    [motion_pivot] = {"`exact` of a pivot", NULL, FIELDS(pivot_exact), NULL, 0, "the known solution"},
    [motion_particle] = {"`exact` of a particle", NULL, FIELDS(particle_exact), NULL, 0,
                         "the known solution"},
    [motion_planar] = {"`exact` of a planar body", NULL, FIELDS(planar_exact), NULL, 0, "the known solution"},
    [motion_weld] = {"`exact` of a weld", NULL, NULL, 0, NULL, 0, "a weld has no coordinate"},
    [motion_track] = {"`exact` of a track", NULL, FIELDS(track_exact), NULL, 0, "the known solution"},
};
