/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_view: a scene and its states as drawing programs, graders and formats need them. The rules of fbd.h
 * apply.
 */
#ifndef FBD_VIEW_H
#define FBD_VIEW_H

#include "fbd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- variables, for exchange with other programs */

typedef enum fbd_variable_kind {
    FBD_VARIABLE_TIME,
    FBD_VARIABLE_PARAMETER,
    FBD_VARIABLE_INPUT,
    FBD_VARIABLE_COORDINATE,
    FBD_VARIABLE_RATE,
    FBD_VARIABLE_ACCELERATION, /* second derivative of a coordinate */
    FBD_VARIABLE_STATE,        /* of `states` */
    FBD_VARIABLE_POINT, /* position, velocity or acceleration of `output: {points: ...}`, in the world */
} fbd_variable_kind;

/* A variable of a scene. Texts live as long as the model. */
typedef struct fbd_variable {
    fbd_variable_kind kind;
    /* the full name is `owner.name`, "block.v_dot"; where owner is "" it is `name` */
    const char *owner, *name;
    const char *unit; /* coherent unit; "" as in fbd_parameter, "1" for a state that is a pure number */
    size_t index;     /* of the parameter, coordinate, user state or point, each counted from 0 */
    double start; /* the value of a parameter or input, the initial value of a coordinate, rate or state */
    /* the file may give any initial value, and if it gives none that is 0: not where it follows from
     * `assemble`, a track or a prescribed motion */
    bool start_free;
} fbd_variable;

/* The variables of a scene: the time "t"; the parameters and inputs in the order of fbd_model_parameter; each
 * coordinate, followed by its rate and its acceleration; the user states; x, y, vx, vy, ax, ay of each point.
 * Models of the same text have the same list. Past the last one the name is NULL, and numbers are
 * NAN. */
FBD_API size_t fbd_model_variable_count(const fbd_model *model);
FBD_API fbd_variable fbd_model_variable(const fbd_model *model, size_t index);

/* The values of all variables at a state, in their units and order; the accelerations are those of the state's
 * modes. Fills at most `room` of them; returns their number. */
FBD_API size_t fbd_state_variables(fbd_state *state, double *values, size_t room);

/* Partial derivatives of the accelerations at a state, in its modes, by `count` variables that are coordinates,
 * rates or inputs: `derivatives`, of fbd_model_coordinate_count x count numbers, row by row, in the units of
 * the acceleration divided by that of the variable. An input costs a compilation of the model. With no variables
 * it only finds out whether the scene has derivatives. Returns false with a note in `errors`: `no-derivatives`
 * for a scene with user states, a prescribed motion or `hysteresis`, or memory is out. */
FBD_API bool fbd_state_derivatives(fbd_state *state, const size_t *variables, size_t count,
                                   double *derivatives, fbd_errors *errors);

/* ---------------------------------------------------------------- the contents of a file */

/* The path or name that the model was read by, as given: see fbd_escape before printing it; NULL for a text
 * without a name. */
FBD_API const char *fbd_model_file(const fbd_model *model);

/* The text of the file as read, not terminated; lives as long as the model. */
FBD_API const char *fbd_model_source(const fbd_model *model, size_t *length);

/* A parameter or an input of the file with its value in this model: the value set by the caller, or the
 * file's. Texts live as long as the model. */
typedef struct fbd_parameter {
    /* unit: coherent unit of the value; "" for a pure number, and for a number whose dimension follows from its
     * use */
    const char *name, *unit;
    const char *description; /* "" if there is none */
    double value;
    bool input;       /* of `inputs`: it may change during the motion */
    bool derived;     /* defined in the file by other parameters, or gravity */
    double low, high; /* range of a slider; NAN where the file does not give it */
} fbd_parameter;

/* The `parameters` in the order of the file, then the `inputs`. Past the last one the name is NULL. */
FBD_API size_t fbd_model_parameter_count(const fbd_model *model);
FBD_API fbd_parameter fbd_model_parameter(const fbd_model *model, size_t index);

/* A user state, from `states` of the file: its qualified name ("states.charge"), its unit and that of its
 * rate, "1" for a pure number. The texts live as long as the model, and are NULL past the last one.
 * fbd_state_get and fbd_state_set take that name. */
typedef struct fbd_own_state {
    const char *name, *unit, *rate_unit;
} fbd_own_state;

FBD_API size_t fbd_model_state_count(const fbd_model *model);
FBD_API fbd_own_state fbd_model_state(const fbd_model *model, size_t index);

/* A data file that was read for a table of the model. The texts live as long as the model, and are NULL past
 * the last one. */
typedef struct fbd_data_file {
    const char *table, *path;
} fbd_data_file;

FBD_API size_t fbd_model_data_file_count(const fbd_model *model);
FBD_API fbd_data_file fbd_model_data_file(const fbd_model *model, size_t index);

/* The SHA-256 of the text of the model, as 64 hexadecimal digits, to be freed with fbd_free; NULL when memory is
 * out. That of the text of a data file when it was read: lives as long as the model, NULL past the last one. */
FBD_API char *fbd_model_hash(const fbd_model *model);
FBD_API const char *fbd_model_data_hash(const fbd_model *model, size_t index);

/* Set options to those of the file, as fbd_options_init where it gives none; `size` is the caller's sizeof of
 * the struct. The method lives as long as the model. */
FBD_API void fbd_model_options(const fbd_model *model, fbd_options *options, size_t size);

/* A unit: a factor times kg^mass m^length s^time A^current K^temperature. An angle is a pure number. */
typedef struct fbd_unit {
    double mass, length, time, current, temperature; /* exponents */
    double factor; /* number of coherent units of the system in one of this unit */
} fbd_unit;

/* Read a unit as in a model file, "N*m/rad"; its factor is that to the units of the model, to SI without a
 * model. Returns false for a text that is no unit. */
FBD_API bool fbd_unit_read(const fbd_model *model, const char *text, size_t length, fbd_unit *unit);

/* Evaluate a text with the dimension of `unit` ("N"), "5 lbf" or "2*3[N]", in the units of the model; a plain
 * number is in the model's unit. `name` is its name in messages. Returns false with a note in `errors`. */
FBD_API bool fbd_model_quantity(const fbd_model *model, const char *name, const char *text, const char *unit,
                                double *value, fbd_errors *errors);

/* An entry of the file for a force or moment of a body, a coupling or a contact: see fbd_model_without. */
typedef struct fbd_entry {
    const char *body; /* "" for a coupling or contact */
    const char *name;
    int line, column; /* of the entry, 1-based */
} fbd_entry;

/* The entries, those of the bodies first, without reactions. Fills at most `room` of them, whose texts live as
 * long as the model; returns their number. */
FBD_API size_t fbd_model_entries(const fbd_model *model, fbd_entry *entries, size_t room);

/* ---------------------------------------------------------------- models and outcomes of states and runs */

/* The model of a state; NULL for NULL. */
FBD_API const fbd_model *fbd_state_model(const fbd_state *state);

/* Write all numbers that determine the further motion: the time, coordinates, rates and user states, the
 * memory of expressions (`hysteresis`), and the start values that couplings keep, for example the length of a rope.
 * Fills at most `room` of them; returns their number. */
FBD_API size_t fbd_state_pack(const fbd_state *state, double *numbers, size_t room);

/* Put such numbers into a state of the same model, or of a model of the same text with other settings. The
 * next call that needs the modes determines them anew. Returns false, and changes nothing, when the numbers
 * do not fit the state. */
FBD_API bool fbd_state_unpack(fbd_state *state, const double *numbers, size_t count);

/* The outcome of a simulation so far: FBD_GOING until its end. Without any step it is another one where the
 * start is refused. */
FBD_API fbd_outcome fbd_simulation_outcome(const fbd_simulation *simulation);

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
    fbd_inertia inertia; /* see fbd_model_inertia */
    size_t listed;       /* forces and moments that the file lists: the first of its diagram */
    size_t most_forces;  /* the most that its diagram can have */
    int line, column;    /* of the body in the file, */
    int motion_line, motion_column; /* and of its `motion` */
} fbd_body;

/* Body `index`; past the last one the name is NULL and the numbers are NAN or 0. */
FBD_API fbd_body fbd_model_body(const fbd_model *model, size_t index);

typedef enum fbd_shape_kind {
    FBD_SHAPE_DOT,     /* no size: a point mass, a rod seen from its end */
    FBD_SHAPE_BAR,     /* slender: from corners[0] to corners[1] */
    FBD_SHAPE_CIRCLE,  /* centre and radius; inner > 0 for a ring or tube */
    FBD_SHAPE_POLYGON, /* four corners, counter-clockwise */
    FBD_SHAPE_UNKNOWN, /* the file gives only a moment of inertia */
} fbd_shape_kind;

/* A part of a body as it is seen, in the frame of the body. */
typedef struct fbd_shape {
    fbd_shape_kind kind;
    bool hole; /* of negative mass: cut out of the others */
    double center[2], radius, inner;
    size_t corner_count; /* 4 of a polygon, 2 of a bar, else 0 */
    double corners[4][2];
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

/* ---------------------------------------------------------------- drawings: a state */

/* The positions, forces and couplings of a state, computed once; independent of the state from then on, but
 * not of the model. */
typedef struct fbd_view fbd_view;

/* NULL with a note in `errors`: `not-finite` where a position or a force is not finite, or memory is out. */
FBD_API fbd_view *fbd_view_new(fbd_state *state, fbd_errors *errors);
FBD_API void fbd_view_free(fbd_view *view);

FBD_API fbd_pose fbd_view_pose(const fbd_view *view, size_t body);

/* The mass of a body in the state, its moments of inertia as in fbd_inertia, and the symbol of the mass: "m",
 * "m_2", or a parameter of the file, and as printed: "m₂". NULL and NAN past the last body. */
typedef struct fbd_mass {
    double mass, I_G, I_O;
    const char *symbol, *printed;
} fbd_mass;

FBD_API fbd_mass fbd_view_mass(const fbd_view *view, size_t body);

/* A force or moment of a free-body diagram, as fbd_diagram, with its origin and its textbook symbol. Texts
 * live as long as the view. */
typedef struct fbd_force {
    fbd_arrow arrow;
    /* "gravity", "applied", "spring", "damper", "potential", "friction" or "reaction", of a surface, joint or
     * coupling; NULL past the last one */
    const char *kind;
    int slide;   /* the force is that of the surface under this sliding body, or its opposite; else -1 */
    bool normal; /* and it is its normal force */
    const char *symbol;  /* "m g", "N_1", "mu_k N": factors, indices after `_`, Greek letters by name */
    const char *printed; /* "mg", "N₁", "μₖN" */
    bool moment;         /* it is a pure moment at all times */
} fbd_force;

/* The forces of a body, in the order of fbd_diagram. */
FBD_API size_t fbd_view_force_count(const fbd_view *view, size_t body);
FBD_API fbd_force fbd_view_force(const fbd_view *view, size_t body, size_t index);

/* A spring or damper between a point of a body and a point of another body or of the ground. */
typedef struct fbd_spring {
    const char *name;
    bool damper;
    int body, partner; /* or FBD_GROUND */
    double point[2];   /* in the frame of the body */
    double anchor[2];  /* in that of the partner; NAN for a wall without a position in the file */
} fbd_spring;

/* The springs and dampers, those of the bodies first; past the last one the name is NULL. */
FBD_API size_t fbd_view_spring_count(const fbd_view *view);
FBD_API fbd_spring fbd_view_spring(const fbd_view *view, size_t index);

/* A coupling or contact: pins, rods, gears, ... A rope has one for each piece between its ends and the pulleys
 * that move, a contact one for each of its points that can touch at once. Past the last one the texts are NULL.
 */
typedef struct fbd_coupling {
    /* "pin", "weld", "rod", "gear", "rack", "ratio", "roll", "slot", "belt", "rope", "plane" or "contact" */
    const char *kind;
    const char *name;
    size_t entry; /* the number in the file of the coupling or contact that it belongs to, from 0 */
    size_t end_count;
    double length; /* of a rod, rope or belt at the start; 0 where a drum changes it */
    bool pulls;    /* rod, rope: the force at a point without a circle is along the line to the next point */
    bool lined;    /* its forces are along and across a line: of a roll, rack, or contact with a line */
    double angle;  /* of that line, or of a slot, in the frame of end 1 [rad] */
    int side;      /* the body is to the left (+1) or to the right (-1) of the line */
} fbd_coupling;

FBD_API size_t fbd_view_coupling_count(const fbd_view *view);
FBD_API fbd_coupling fbd_view_coupling(const fbd_view *view, size_t index);

/* An end of a coupling, or a point that a rope passes over. */
typedef struct fbd_coupling_end {
    int body;          /* or FBD_GROUND */
    double point[2];   /* in the frame of the body; the centre of a circle */
    double radius;     /* of the circle there, else 0 */
    const char *force; /* the name of its force in the diagram of the body; NULL on the ground */
    /* where the coupling acts on it, in the world: nowhere for an open contact, at two places where a rope
     * passes over it */
    size_t place_count;
    double places[2][2];
} fbd_coupling_end;

/* End `end` of a coupling; past the last one its numbers are NAN. */
FBD_API fbd_coupling_end fbd_view_coupling_end(const fbd_view *view, size_t index, size_t end);

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

/* ---------------------------------------------------------------- bodies and forces, for comparison of scenes */

typedef struct fbd_scene {
    const char *units; /* "SI" or "US"; "" without a model */
    double gravity[2]; /* acceleration, in the world */
} fbd_scene;

FBD_API fbd_scene fbd_model_scene(const fbd_model *model);

/* The sense in which the friction of a body slips: 1 along +x of its motion, -1 against it; 0 while it sticks,
 * and without friction. */
FBD_API int fbd_state_slip(fbd_state *state, size_t body);

/* A force or moment of a diagram with its origin; its symbol is in fbd_force. Texts live as long as the model. */
typedef struct fbd_listed_force {
    fbd_arrow arrow; /* as of fbd_diagram; its name is NULL where there is no force */
    /* of an entry of the file, from here on: the key of its law, "gravity", "spring"; of a law that is
     * computed as an applied force or moment "applied". "" for other forces, as those of couplings */
    const char *law;
    int line, column;
    bool moment;                      /* it is listed under `moments` */
    const char *side;                 /* of a normal force: "up", "left", "right"; else "" */
    double size;                      /* value of an applied force or moment that is constant, else NAN */
    double mu_s, mu_k, surface_speed; /* of friction, at the state; else 0 */
    /* of any force */
    bool reaction; /* it follows from the other forces: of a surface, friction, a joint, a coupling */
    /* of a reaction that the file does not list */
    bool one_sided;  /* it only pulls, as a rope, or only presses, as a contact */
    bool couples;    /* it may be a force with a moment, as of a weld or guide */
    bool free;       /* its direction is not given by the scene, as of a pin */
    int contact;     /* the contact that it is part of, numbered from 0, or -1 */
    double along[2]; /* vector along its line where that is given, outward for a normal force; else 0 */
    bool placed;     /* the entry has `at` */
} fbd_listed_force;

/* Fill at most `room` forces of a body at a state, in the order of fbd_diagram; returns their number, 0 past
 * the last body, SIZE_MAX when memory is out. `forces` may be NULL to count only. */
FBD_API size_t fbd_state_forces(fbd_state *state, size_t body, fbd_listed_force *forces, size_t room);

/* A force by the name that derivations (`hand`) use for it. */
typedef struct fbd_named_force {
    size_t force; /* index in the diagram; SIZE_MAX when memory is out */
    bool moment;  /* it is a pure moment */
    double value; /* of the name at the state, with its sign, in the unit of the force or moment */
} fbd_named_force;

/* Find a force on a body by the name or letter by which derivations of the body refer to its magnitude, to a
 * component or to its couple: `cord`, `T_1`, `wrist.x`, `clamp.moment`. Returns false if there is no such name. */
FBD_API bool fbd_state_named_force(fbd_state *state, size_t body, const char *name, fbd_named_force *found);

/* ---------------------------------------------------------------- states at which scenes are compared */

/* Determine the modes at the present time, coordinates and rates, and evaluate the forces. Returns true if the
 * motion is admissible there: all accelerations are finite, no normal force is tensile, rolling bodies roll,
 * and closed contacts are closed. Forces that do not depend on the modes are known in any case. */
FBD_API bool fbd_state_settle(fbd_state *state);

/* The accelerations at a state, in its modes: of each coordinate, in the order of fbd_model_coordinate and in the
 * unit of its rate per second. Fills at most `room` of them; returns their number. */
FBD_API size_t fbd_state_accelerations(fbd_state *state, double *accelerations, size_t room);

/* A state at the start of the motion: as fbd_state_new, where bodies with `assemble` are moved to satisfy their
 * couplings, and settled as by fbd_state_settle. Also for a start that a run would refuse. NULL when memory is
 * out. */
FBD_API fbd_state *fbd_state_new_start(const fbd_model *model);

/* Random states of a model, always the same sequence. The model must outlive it. */
typedef struct fbd_sampler fbd_sampler;

/* NULL when memory is out. */
FBD_API fbd_sampler *fbd_sampler_new(const fbd_model *model);
FBD_API void fbd_sampler_free(fbd_sampler *sampler);

/* Put a state of the model to the initial values of the file, at t = 0 or, with `any_time`, at a random time of
 * the run, and settle it. Returns false if it is not admissible, or with `any_time` for prescribed motions. */
FBD_API bool fbd_sampler_start(fbd_sampler *sampler, fbd_state *state, bool any_time);

/* Put a state of the model to a random time, with coordinates and rates of the size of the initial ones and
 * angles in the full circle, and settle it; with couplings and contacts it is near the start: loops stay
 * assembled, closed contacts closed and open ones open. Returns false if none of so many tries is admissible. */
FBD_API bool fbd_sampler_draw(fbd_sampler *sampler, fbd_state *state, unsigned tries);

#ifdef __cplusplus
}
#endif

#endif
