/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_geometry: the bodies of a scene, their shapes, curves and connections, and their positions in a state. The
 * rules of fbd.h apply.
 */
#ifndef FBD_GEOMETRY_H
#define FBD_GEOMETRY_H

#include "fbd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- bodies and their shapes */

/* The index of a body that stands for the ground; points of the ground are in the world. */
#define FBD_GROUND (-1)

/* Units of a model's system: "m", "N", "N*m", "J", "kg", "kg*m^2", or "ft", "lbf", ...; all NULL for NULL. */
typedef struct fbd_units {
    const char *length, *force, *moment, *energy, *mass, *inertia;
} fbd_units;

FBD_API fbd_units fbd_model_units(const fbd_model *model);

/* Mass and moments of inertia of a body, in the model's units. I_O (about the axis O) and L (distance from O
 * to the centre of mass G) are 0 except for a pivot. All are NAN past the last body. */
typedef struct fbd_inertia {
    double mass, I_G, I_O, L;
    double G[2]; /* centre of mass in the body frame */
} fbd_inertia;

FBD_API fbd_inertia fbd_model_inertia(const fbd_model *model, size_t body);

typedef enum fbd_motion_kind {
    FBD_MOTION_SLIDE,    /* along a line, without rotation */
    FBD_MOTION_PIVOT,    /* about an axis */
    FBD_MOTION_PARTICLE, /* x and y */
    FBD_MOTION_PLANAR,   /* x, y and an angle */
    FBD_MOTION_WELD,     /* fixed on its carrier */
    FBD_MOTION_TRACK,    /* along a curve */
} fbd_motion_kind;

/* A body and its joint, on the ground or on the body that carries it. */
typedef struct fbd_body {
    const char *name;
    fbd_motion_kind motion;
    int carrier;                         /* the body that it moves on, or FBD_GROUND */
    size_t coordinate, coordinate_count; /* its coordinates: see fbd_model_coordinate */
    int angle;                           /* the coordinate that is its angle, or -1 */
    double pin[2];       /* the point of the body in its joint, in its frame: that on the axis of a pivot */
    double joint[2];     /* the place of the joint, in the frame of the carrier: the axis; where x = 0; ... */
    double along[2];     /* slide: the direction of +x, in the frame of the carrier, as a unit vector */
    double normal[2];    /* slide: the direction in which its surface pushes, across `along` */
    bool surface;        /* slide: on a surface with a normal force; false where it is guided */
    bool two_sided;      /* and the surface has a second side, above the body */
    bool friction;       /* `friction` with a surface, or of a bearing, acts on it */
    double stops[2];     /* slide, pivot: least and largest value of its coordinate; NAN without a stop */
    fbd_inertia inertia; /* see fbd_model_inertia */
    size_t listed;       /* forces and moments that the file lists: the first of its diagram */
    size_t most_forces;  /* the most that its diagram can have */
    int line, column;    /* of the body in the file, */
    int motion_line, motion_column; /* and of its `motion` */
} fbd_body;

/* Body `index`; past the last one the name is NULL and the numbers are NAN or 0. */
FBD_API fbd_body fbd_model_body(const fbd_model *model, size_t index);

enum { FBD_MOST_CORNERS = 16 };

typedef enum fbd_shape_kind {
    FBD_SHAPE_DOT,     /* no size: a point mass, a rod seen from its end */
    FBD_SHAPE_BAR,     /* slender: from corners[0] to corners[1] */
    FBD_SHAPE_CIRCLE,  /* centre and radius; inner > 0 for a ring or tube */
    FBD_SHAPE_POLYGON, /* convex; corners counter-clockwise */
    FBD_SHAPE_UNKNOWN, /* the file gives only a moment of inertia */
} fbd_shape_kind;

/* A part of a body as it is seen, in the frame of the body. */
typedef struct fbd_shape {
    fbd_shape_kind kind;
    bool hole; /* of negative mass: cut out of the others */
    double center[2], radius, inner;
    size_t corner_count; /* 3 to FBD_MOST_CORNERS of a polygon, 2 of a bar, else 0 */
    double corners[FBD_MOST_CORNERS][2];
} fbd_shape;

/* The parts of a body in the order of the file; past the last one the kind is FBD_SHAPE_UNKNOWN and numbers
 * are NAN. */
FBD_API size_t fbd_model_shape_count(const fbd_model *model, size_t body);
FBD_API fbd_shape fbd_model_shape(const fbd_model *model, size_t body, size_t index);

/* Mass, centre and moment of inertia about that centre of the same part; of a body of varying mass at its start.
 * I_O and L are 0, and all are NAN past the last one. */
FBD_API fbd_inertia fbd_model_shape_inertia(const fbd_model *model, size_t body, size_t index);

/* The largest extent of the parts of a body from a point in a direction (a unit vector), both in the frame of
 * the body; -INFINITY when it has no parts. */
FBD_API double fbd_model_extent(const fbd_model *model, size_t body, const double from[2],
                                const double along[2]);

/* A named point of a body, of the file or of its shapes, in its frame. The name is NULL past the last one. */
typedef struct fbd_named_point {
    const char *name;
    double x, y;
} fbd_named_point;

FBD_API size_t fbd_model_point_count(const fbd_model *model, size_t body);
FBD_API fbd_named_point fbd_model_point(const fbd_model *model, size_t body, size_t index);

/* The curve of a body with FBD_MOTION_TRACK: its arc length from `start` to `start + length`. Closed curves
 * continue beyond. NAN for other bodies. */
typedef struct fbd_track {
    double start, length;
    bool closed;
} fbd_track;

FBD_API fbd_track fbd_model_track(const fbd_model *model, size_t body);

/* A point of a curve in the frame of the carrier: position, unit tangent in the sense of growing s, and
 * curvature, positive to the left. NAN for bodies without a track. */
typedef struct fbd_track_place {
    double x, y, tangent[2], curvature;
} fbd_track_place;

FBD_API fbd_track_place fbd_model_track_place(const fbd_model *model, size_t body, double s);

/* ---------------------------------------------------------------- positions */

/* Position of a body: its point `pin` is at (x, y) in the world, and a point r of its frame at (x, y) +
 * R(angle) (r - pin). NAN past the last body. */
typedef struct fbd_pose {
    double x, y, angle;
    double cosine, sine;
    double G[2]; /* the centre of mass, in the world */
    /* the direction of +x or s of a slide or track in the world, and the direction in which its surface pushes;
     * (1, 0) and (0, 1) for other bodies */
    double along[2], normal[2];
} fbd_pose;

FBD_API fbd_pose fbd_state_pose(fbd_state *state, size_t body);

/* The motion of a point of a body, of its frame, in the world: position, velocity and acceleration in the modes of
 * the state; and the angular velocity and acceleration of the body. NAN past the last body. */
typedef struct fbd_point_motion {
    double position[2], velocity[2], acceleration[2];
    double omega, alpha;
} fbd_point_motion;

FBD_API fbd_point_motion fbd_state_point_motion(fbd_state *state, size_t body, const double point[2]);

/* ---------------------------------------------------------------- connections, as a file gives them */

/* An end of a connection, or a point that a rope passes over. */
typedef struct fbd_connection_end {
    int body;        /* or FBD_GROUND */
    bool whole;      /* contact: no point of it, but all of its surface */
    bool center;     /* its centre of mass; `point` is 0 */
    double point[2]; /* in the frame of the body */
    double radius;   /* of the circle there; 0 without, negative for the inside of a ring gear */
    /* rope: it is wound on a drum there, which it leaves to the left (1), right (2), above (3) or below (4); else 0 */
    int wound;
    double spare; /* and so much is wound up at the start; INFINITY: no limit */
} fbd_connection_end;

enum { FBD_CONNECTION_ENDS = 8 };

/* A coupling or contact, or a spring or damper between two bodies. Texts live as long as the model, and are NULL past the
 * last one. */
typedef struct fbd_connection {
    const char *kind; /* as of fbd_coupling, or "spring", "damper", "actuator" */
    const char *name;
    int line, column;
    bool friction;                              /* slot, rope: with friction */
    double length;                              /* of a rod or rope, where the file gives it; else NAN */
    double stiffness, coefficient, free_length; /* of a spring, of a damper, of a spring */
    size_t end_count;
    fbd_connection_end ends[FBD_CONNECTION_ENDS];
} fbd_connection;

/* The couplings and contacts in the order of the file, then the springs and dampers. */
FBD_API size_t fbd_model_connection_count(const fbd_model *model);
FBD_API fbd_connection fbd_model_connection(const fbd_model *model, size_t index);

/* The line of a connection on the body of its second end: the polygon of the ground of a contact, the curve of a slot, or
 * its straight line if that is limited. Curves are divided into short straight pieces. */
typedef struct fbd_path {
    size_t point_count; /* 0 for other connections */
    bool closed;        /* the first point follows on the last one */
    int side; /* of a slot: its point stays to the left (1) or right (-1) of the sense of the points; 0: on the line */
} fbd_path;

FBD_API fbd_path fbd_model_path(const fbd_model *model, size_t connection);

/* Set a point of that line, in the frame of the body. Returns false, and NAN, past the last one. */
FBD_API bool fbd_model_path_point(const fbd_model *model, size_t connection, size_t index, double point[2]);

#ifdef __cplusplus
}
#endif

#endif
