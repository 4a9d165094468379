/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The parts of a scene (scene.h): values, points, inertia, motions and loads.
 */
#ifndef FBD_SCENE_LOADS_H
#define FBD_SCENE_LOADS_H

#include "base/diag.h"
#include "base/vec.h"
#include "expr/curve.h"
#include "expr/expr.h"
#include "fbd_geometry.h"
#include "scene/tables.h"

enum { most_coordinates_of_a_body = 3 };

/* A number or an expression; `expr` is NULL when the file does not give it. */
struct value {
    const struct expr *expr;
    struct pos at;
    bool by_input; /* it names an input */
};

/* A point of a body (in its frame) or of the ground. */
struct point {
    enum point_kind {
        point_absent, /* not given */
        point_fixed,  /* `where` */
        point_G,      /* the centre of mass, computed by the model */
    } kind;
    struct vec where;
    struct pos at;
};

struct named_point {
    const char *name;
    struct vec where;
};

/* ---- inertia */

enum shape_kind {
    shape_point,
    shape_rod,             /* slender, along x */
    shape_sphere,          /* solid */
    shape_cylinder,        /* solid cylinder or disc, symmetric about x */
    shape_hollow_cylinder, /* symmetric about x */
    shape_prism,           /* sides a, b, c along x, y, z */
    shape_ring,            /* thin, symmetric about x */
    shape_polygon,         /* a plate with these corners */
    shape_given,           /* moment of inertia stated in the file */
};

/* One part of a body. `axis` ('x', 'y', 'z') is the axis of the shape that faces the plane, i.e. is
 * perpendicular to the drawing. */
struct part {
    const char *name; /* NULL for a body that is its own part */
    struct pos at;
    enum shape_kind shape;
    char axis;
    double mass;         /* negative for a hole */
    double length;       /* rod, cylinders; 0 if not given */
    double radius;       /* sphere, disc, ring; outer radius of a hollow cylinder */
    double inner_radius; /* hollow cylinder */
    double side[3];      /* prism: a, b, c */
    size_t corner_count; /* polygon: at most FBD_MOST_CORNERS ... */
    struct vec *corners; /* ... counter-clockwise, in the body frame */
    struct vec center;   /* its centre of mass in the body frame */
    double angle;        /* of the shape's x axis in the body frame [rad] */
    double gyration;     /* shape_given: radius of gyration; 0 if not given */
    double inertia;      /* shape_given: moment of inertia, where that is 0 ... */
    struct point about;  /* ... about this point (point_G: about its own centre) */
    bool about_pivot;    /* ... or about the point on the pivot */
    double rim;          /* shape_given that rolls: its radius, for drawings, about `hub`; else 0 */
    struct vec hub;      /* centre of the rim */
};

/* ---- motion */

enum motion_kind {
    motion_slide,    /* x along one line */
    motion_pivot,    /* theta about a fixed axis */
    motion_particle, /* x, y */
    motion_planar,   /* x, y, theta */
    motion_weld,     /* none: fixed on another body */
    motion_track,    /* s along a curve */
};

enum { motion_kinds_count = motion_track + 1 };

enum { ground_body = -1 };

struct motion {
    enum motion_kind kind;
    struct pos at;
    int parent;   /* parent body, or ground_body */
    double along; /* slide: direction of +x in the parent frame; weld: angle of the body frame [rad] */
    struct vec
        through; /* slide: where x = 0; pivot: axis O; weld: the joint; track: origin of the curve; in the parent frame */
    struct value
        prescribed;   /* slide, pivot, track: the coordinate as a function of t; expr NULL when it is free */
    struct vec point; /* pivot, weld, track: the point of the body at the joint, in the body frame */
    const struct curve *curve; /* track: in the parent frame, from `through` */
    bool turns;                /* track: the x axis of the body frame is its tangent */
};

/* ---- loads */

struct node;

/* The begin and the end of a force, moment or constraint during a run. A constraint and its rolling resistance, and a
 * force and its reaction on another body, have the same number. */
struct lifetime {
    int number;                       /* from 1 on (struct scene: lifetime_count); 0: it is always there */
    const struct node *since, *until; /* its conditions, while the file is read; NULL without them */
    bool begins, ends; /* it has them: events of the scene have its number (struct user_event) */
};

enum load_kind {
    load_gravity,
    load_normal,
    load_friction,
    load_applied,
    load_spring,
    load_damper,
    load_drag,
    load_potential,
    moment_applied,
    moment_spring,
    moment_damper,
    moment_friction,
    moment_potential,
    load_drive,    /* not listed: the force of a prescribed motion */
    load_rope,     /* not listed: a rope under `couplings`, see struct constraint */
    load_contact,  /* not listed: a contact, likewise */
    load_belt,     /* not listed: a belt, likewise */
    load_carried,  /* not listed: no force, but the energy carried by a varying mass */
    load_actuator, /* not listed: a given force between two bodies, under `couplings` */
};

/* A distributed load along a line, a force per length w(s). */
struct spread {
    double length, center; /* of the line; distance of the resultant from its start */
    double force;          /* the integral of w */
    struct vec from, to;   /* ends of the line, points of the body */
    const struct expr *w;  /* of s in slot 1; NULL for a trapezoid */
    double ends[2];        /* and its values at both ends */
};

struct law;

/* One entry of `forces` or `moments`. Fields that a kind does not use are zero. */
struct load {
    enum load_kind kind;
    const struct law *law; /* its law; NULL: see load_law */
    const char *name;      /* unique within the body */
    struct pos at;

    /* applied force: either `value` along `angle` (or along the slide when no angle is given), or components.
     * Moment: `value`. */
    struct value value, angle, fx, fy;
    bool body_frame;    /* angle and components turn with the body */
    struct point point; /* point of application; absent: G */

    /* Applied force: offset of the point of application from `point` along the axes of the world, which do
     * not turn with the body (expr NULL: none), and the resulting moment about `point`. */
    struct value offset_x, offset_y, couple;
    bool conservative; /* applied force or moment: its work is potential energy, if it has a potential */
    const char
        *toward; /* the point that it is directed to, as in the file, which determines `angle`; or NULL */
    struct spread spread;      /* of a distributed load, whose resultant this is; else length 0 */
    bool reaction;             /* reaction to a force of another body: `NAME.force` of body NAME */
    int target;                /* while the file is read: the body that it is directed to, or ground_body */
    struct point end;          /* point of that body */
    struct value return_angle; /* direction of the reaction */

    /* spring, damper: toward `anchor`, a point of the ground; without one, along the body's own coordinate */
    struct point anchor;
    double stiffness;   /* N/m or N m/rad */
    double free_length; /* spring with an anchor; neutral coordinate without */
    double coefficient; /* damper: N s/m or N m s/rad */

    /* actuator: along the line of its points, where `zero_distance`, a length over their distance, has its pole;
     * or where `guided`, in a direction of the body at the other end */
    struct value zero_distance;
    bool guided;
    double along;

    bool reels; /* rope: its length varies with time, which does work */

    double linear, quadratic; /* drag: N s/m, N s^2/m^2 */
    /* The wind, if any. The resulting force is in `fx` and `fy`: for linear drag the difference to the drag
     * in still air, c w; for any other the whole drag, -(c + k |v - w|) (v - w). */
    struct value wind_x, wind_y;

    /* friction: coefficients (force) or limits in N m (moment); of a journal bearing, where the moment is in
     * proportion to the reaction of the pin, both are the radius of its friction circle, mu r */
    struct value mu_s, mu_k;
    bool journal;
    struct value
        surface_speed; /* velocity of the surface along +x (moment: angular velocity of the bearing) */

    struct value potential; /* V as a function of the body's coordinates (and t) */

    struct lifetime lifetime;

    enum normal_side {
        side_up,
        side_left,
        side_right
    } side;         /* normal: side of +x to which the surface pushes */
    bool two_sided; /* normal: a guide that also pulls */
};

static inline bool load_is_placed(const struct load *load)
{
    return load->offset_x.expr != NULL;
}

static inline bool load_has_wind(const struct load *load)
{
    return load->wind_x.expr != NULL;
}

/* True if it has a term of drag in still air: without wind, or if linear. */
static inline bool load_drags_still_air(const struct load *load)
{
    return !load_has_wind(load) || load->quadratic == 0;
}

/* All formulas of a load; each may be absent. */
enum { most_formulas_of_a_load = 12 };

static inline void load_formulas(struct load *load, struct value *formulas[static most_formulas_of_a_load])
{
    struct value *all[] = {&load->value,    &load->angle,    &load->fx,        &load->fy,
                           &load->mu_s,     &load->mu_k,     &load->potential, &load->surface_speed,
                           &load->offset_x, &load->offset_y, &load->couple,    &load->zero_distance};
    for (int i = 0; i < most_formulas_of_a_load; i++) formulas[i] = all[i];
}

#endif
