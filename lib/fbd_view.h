/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_view: the variables and forces of a scene and its states, as drawing programs, graders and formats need them;
 * the shapes and positions of its bodies are in fbd_geometry.h. The rules of fbd.h apply.
 */
#ifndef FBD_VIEW_H
#define FBD_VIEW_H

#include "fbd_geometry.h"

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
    FBD_VARIABLE_POINT, /* of `output: {points: ...}`: position, velocity, acceleration in the world; proper acceleration */
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
 * the acceleration divided by that of the variable. Inputs that are constants of the model cost one compilation of
 * it; those that states hold (fbd_model_with_callbacks) cost none. With no variables it only finds out whether the
 * scene has derivatives. Returns false with a note in `errors`: `no-derivatives` for a scene with user states, a
 * prescribed motion, `hysteresis` or an input that a callback computes, or memory is out. */
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

/* ---------------------------------------------------------------- bodies and forces, for comparison of scenes */

typedef struct fbd_scene {
    const char *units; /* "SI" or "US"; "" without a model */
    double gravity[2]; /* acceleration, in the world */
    double pressing;   /* acceleration of gravity into the plane, where that is horizontal; else 0 */
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

/* Let all forces and moments of the file act at a state, also those that begin later (`from`) or have ended (`until`):
 * scenes are compared with all of them. The next call that needs the modes determines them anew. */
FBD_API void fbd_state_let_forces_act(fbd_state *state);

/* The accelerations at a state, in its modes: of each coordinate, in the order of fbd_model_coordinate and in the
 * unit of its rate per second. Fills at most `room` of them; returns their number. */
FBD_API size_t fbd_state_accelerations(fbd_state *state, double *accelerations, size_t room);

/* A state at the start of the motion: as fbd_state_new, where bodies with `assemble` are moved to satisfy their
 * couplings, and settled as by fbd_state_settle. Also for a start that a run would refuse. NULL when memory is
 * out. */
FBD_API fbd_state *fbd_state_new_start(const fbd_model *model);

/* Random states of a model with all its forces (fbd_state_let_forces_act), always the same sequence. The model must
 * outlive it. */
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
