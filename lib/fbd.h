/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd: free-body diagrams that run. This is the public header; fbd_workers.h is for sweeps over several
 * processes.
 *
 * Units are those of the model's system (`units: SI` or `US`), angles are in radians, times in seconds. A
 * unit returned with a name is the unit of that quantity.
 *
 * Counting and access. The elements of fbd_OBJECT_THINGS... are counted by fbd_OBJECT_THING_count and
 * returned by fbd_OBJECT_THING(object, index), with index from 0; the elements of lists by fbd_LIST_count and
 * fbd_LIST_get. Structs are returned by value; for an index past the end their texts are NULL and their
 * numbers NAN or 0. Their texts live as long as the object. Functions that compute several values fill an
 * array of the caller (at most `room` elements) and return the number of values; if the array is NULL they
 * only count.
 *
 * Ownership. The caller frees the objects made by functions with `new`, `read`, `parse`, `run`, `assemble` or
 * `linearize` in their names with the `free` function of the type, and every `char *` that is not const with
 * fbd_free. Everything else belongs to the library.
 *
 * Options are structs whose first member is their size. The default of a member is zero, except for the
 * members that the _DEFAULT macro or the _init function of the struct sets; NULL instead of the struct
 * selects all defaults. `size` is the caller's sizeof of the struct, so that a program keeps working when
 * later versions add members at the end; 0 stands for the members of version 0.1. A nonzero member that this
 * library does not have is refused (`bad-call`). A struct that is returned by value grows only with the
 * soname.
 *
 * Callbacks receive the context that is given with them and return 0 to continue; any other value ends the
 * current operation, and the results up to there are complete. They must not call functions on the object in
 * operation.
 *
 * An invalid call changes nothing and returns the error value of its function, in every build: NULL for a
 * required object, text or result pointer, an index past the end, a state of another model. Error values are
 * NULL, false, 0 for a count, NAN for a number, "" for a text that is never NULL, and FBD_FAILED,
 * FBD_SWEEP_REFUSED or -1 where a function says so; with a list of errors the note `bad-call` is added.
 * Functions that free accept NULL. The use of an object that has been freed is not detected. Options may be
 * NULL: then those of the file apply.
 */
#ifndef FBD_H
#define FBD_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define FBD_API __attribute__((visibility("default")))
#else
#define FBD_API
#endif

/* Free a text or bytes returned by a function of the library. NULL is allowed. */
FBD_API void fbd_free(void *memory);

/* ---------------------------------------------------------------- callbacks */

/* Receives a piece of text of `length` bytes, which is not terminated and lives until the callback returns. */
typedef int fbd_write(void *context, const char *text, size_t length);

/* Progress of an operation. Members that do not apply are 0 or "". */
typedef struct fbd_progress {
    const char *what;       /* "run", "sweep"; of a study "reference", "errors", "timing", "effects" */
    double share;           /* completed fraction, 0 to 1 */
    double t, until;        /* a run: simulated time reached, end time [s] */
    unsigned long steps;    /* a run: accepted steps */
    size_t events;          /* a run: events found */
    size_t written, failed; /* a sweep: rows written, and failed runs among them */
} fbd_progress;

/* Receives the progress. Does not affect the computation. */
typedef int fbd_watch(void *context, const fbd_progress *progress);

/* Called often and by any thread to decide whether to continue: must be quick. */
typedef int fbd_stop(void *context);

/* ---------------------------------------------------------------- errors */

typedef enum fbd_severity {
    FBD_ERROR,
    FBD_WARNING,
} fbd_severity;

/* An error or warning in a model file. Lines and columns are 1-based; 0 means unknown. */
typedef struct fbd_error {
    fbd_severity severity;
    const char *id;                   /* stable, for programs: "unknown-key", "wrong-dimension", ... */
    const char *message;              /* description of the error, one line, safe to print */
    const char *hint;                 /* suggested correction, or NULL */
    const char *file;                 /* path as it was given: see fbd_escape before printing it */
    int line, column;                 /* position of the error */
    int context_line, context_column; /* position of the enclosing element, 0 when that adds no information */
} fbd_error;

/* A list of errors and warnings, owned by the caller; it may be reused for further calls. A list serves one
 * thread. Every function that takes a list also accepts NULL. */
typedef struct fbd_errors fbd_errors;

/* Return an empty list, or NULL when memory is out. */
FBD_API fbd_errors *fbd_errors_new(void);
FBD_API void fbd_errors_free(fbd_errors *errors);

/* Number of notes, and number of those that are errors (not warnings). */
FBD_API size_t fbd_errors_count(const fbd_errors *errors);
FBD_API size_t fbd_errors_failed_count(const fbd_errors *errors);

/* Note `index`, in the order of position in the file. */
FBD_API fbd_error fbd_errors_get(fbd_errors *errors, size_t index);

/* File `index` that the calls with this list have read or tried to read: the model file and the data files of
 * its tables; NULL past the last. Standard input is not listed. Lives as long as the list. */
FBD_API size_t fbd_errors_file_count(const fbd_errors *errors);
FBD_API const char *fbd_errors_file(const fbd_errors *errors, size_t index);

/* Write every note as `file:line:col: error: message` and `    hint: ...`. */
FBD_API void fbd_errors_print(fbd_errors *errors, FILE *stream);

/* Make a text safe to print: characters that a terminal would execute (escape sequences), that change the
 * direction of the text or are invisible are written as `\x1b`, `\u202e`, `\U000e0001`; the rest stays.
 * Titles, paths and other texts of users should be printed so; messages and texts of the library are safe
 * already. Fills `shown` with whole characters and a final zero, as far as there is room; returns the length
 * of the complete text in bytes, without that zero. */
FBD_API size_t fbd_escape(const char *text, char *shown, size_t room);

/* ---------------------------------------------------------------- models */

/* A compiled scene: constant after it is made, and shareable by threads. */
typedef struct fbd_model fbd_model;

/* A parameter of the file set by the caller; `value` is text as in the file ("50", "50 N", "2*f0"). */
typedef struct fbd_setting {
    const char *name, *value;
} fbd_setting;

/* Read and compile a model file ("-" is standard input) or a text. Returns NULL with notes in `errors` when
 * it is wrong or cannot be read (id `cannot-read`). `name` is the name of the text in messages, or NULL. A
 * valid model may have warnings. The caller frees the model with fbd_model_free. */
FBD_API fbd_model *fbd_model_read(const char *path, const fbd_setting *settings, size_t setting_count,
                                  fbd_errors *errors);
FBD_API fbd_model *fbd_model_parse(const char *text, size_t length, const char *name,
                                   const fbd_setting *settings, size_t setting_count, fbd_errors *errors);
FBD_API void fbd_model_free(fbd_model *model);

/* The title of the file, "" when it has none. */
FBD_API const char *fbd_model_title(const fbd_model *model);

/* The text of the file as read, not terminated; lives as long as the model. */
FBD_API const char *fbd_model_source(const fbd_model *model, size_t *length);

FBD_API size_t fbd_model_body_count(const fbd_model *model);

/* The name of a body; NULL past the last one. */
FBD_API const char *fbd_model_body_name(const fbd_model *model, size_t body);

/* Mass and moments of inertia of a body, in the model's units. I_O (about the axis O) and L (distance from O
 * to the centre of mass G) are 0 except for a pivot. All are NAN past the last body. */
typedef struct fbd_inertia {
    double mass, I_G, I_O, L;
    double G[2]; /* centre of mass in the body frame */
} fbd_inertia;

FBD_API fbd_inertia fbd_model_inertia(const fbd_model *model, size_t body);

/* A coordinate of the scene: q and its rate v. Names are qualified ("block.x", "block.v"); they live as long
 * as the model, and are NULL past the last coordinate. */
typedef struct fbd_coordinate {
    const char *name, *unit, *rate_name, *rate_unit;
    size_t body;
} fbd_coordinate;

FBD_API size_t fbd_model_coordinate_count(const fbd_model *model);
FBD_API fbd_coordinate fbd_model_coordinate(const fbd_model *model, size_t index);

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

/* ---------------------------------------------------------------- states and assembled equations */

/* Time, coordinates, rates and modes (stick or slip) of one run; used by one thread at a time. */
typedef struct fbd_state fbd_state;

/* A state at the file's initial values and t = 0, with consistent modes. NULL when memory is out. */
FBD_API fbd_state *fbd_state_new(const fbd_model *model);
FBD_API void fbd_state_free(fbd_state *state);

/* Copy `from` into `to`. Returns false when they are not of the same model. */
FBD_API bool fbd_state_copy(fbd_state *to, const fbd_state *from);

/* Write all numbers that determine the further motion: the time, coordinates and rates, the memory of
 * expressions (`hysteresis`), and the start values that couplings keep, for example the length of a rope.
 * Fills at most `room` of them; returns their number. */
FBD_API size_t fbd_state_pack(const fbd_state *state, double *numbers, size_t room);

/* Put such numbers into a state of the same model, or of a model of the same text with other settings. The
 * next call that needs the modes determines them anew. Returns false, and changes nothing, when the numbers
 * do not fit the state. */
FBD_API bool fbd_state_unpack(fbd_state *state, const double *numbers, size_t count);

/* Set or get "t", "body.coordinate" or "body.rate" ("block.x", "pendulum.omega"). Returns false for an
 * unknown name or a value that is not finite. The next call that needs the modes determines them anew, as at
 * the start of a run. */
FBD_API bool fbd_state_set(fbd_state *state, const char *name, double value);

/* As fbd_state_set, from text with a unit ("180 deg"); the body may be omitted from the name when the scene
 * has only one. Returns false with a note in `errors`. */
FBD_API bool fbd_state_set_text(fbd_state *state, const char *name, const char *text, fbd_errors *errors);

/* As fbd_state_set_text; a plain number for an angle is in degrees, for its rate in degrees per second. */
FBD_API bool fbd_state_set_text_degrees(fbd_state *state, const char *name, const char *text,
                                        fbd_errors *errors);

/* Evaluate a text with the dimension of `unit` ("N"), "5 lbf" or "2*3[N]", in the units of the model; a plain
 * number is in the model's unit. `name` is its name in messages. Returns false with a note in `errors`. */
FBD_API bool fbd_model_quantity(const fbd_model *model, const char *name, const char *text, const char *unit,
                                double *value, fbd_errors *errors);

/* Select degrees for angles and their rates in the texts of the state, of its statics and of its
 * linearisation. Equations, matrices and the numbers of structures stay in radians. */
FBD_API void fbd_state_show_degrees(fbd_state *state, bool degrees);

/* Make a state admissible as a start: bodies with `assemble` are moved to satisfy their couplings, the others
 * must satisfy theirs to six digits. Returns false with a note in `errors` for a start that a run would
 * refuse: `does-not-fit` (names the violated coupling and the nearest state that fits), `not-finite` (names
 * the force or other quantity), `unsettled` (no choice of stick and slip is consistent with the forces),
 * `leaves-surface` (a normal force would be tensile), `masses-apart` (the coupling forces cannot be resolved,
 * because of the mass ratio), `singular-start` (at rest where the gradients of coupling equations vanish,
 * with an acceleration that violates the couplings), or memory is out. */
FBD_API bool fbd_state_close(fbd_state *state, fbd_errors *errors);
/* Also returns the present mass of a body, "rocket.m". False for an unknown name. */
FBD_API bool fbd_state_get(const fbd_state *state, const char *name, double *value);

/* One named term of an equation. */
typedef struct fbd_term {
    const char *name;
    double value; /* in the unit of the equation */
} fbd_term;

/* One assembled equation: inertia * acceleration = sum of terms. Slides, particles and planar bodies: forces
 * (for planar bodies along x and y at the centre of mass, then moments about it); pivots: moments about the
 * axis. */
typedef struct fbd_equation {
    const char *body, *coordinate; /* "block", "x" */
    const char *inertia_name;      /* "m", "I_O" or "I_G" */
    const char *acceleration_name; /* "v_dot", "omega_dot", "vx_dot", ... */
    const char *unit;              /* of terms and sum: "N", "N*m", "lbf", ... */
    const char *inertia_unit, *acceleration_unit;
    double inertia, sum, acceleration;
    size_t term_count;
    const fbd_term *terms;
    double normal; /* slide: the normal force N on the body; 0 otherwise */
} fbd_equation;

typedef struct fbd_equations fbd_equations;

/* Assemble the equations of all coordinates at a state; for a welded body, which has none, the equations of
 * the body cut free. Accelerations are absolute: "a_x", "alpha" where the body is carried by a moving body.
 * NULL when memory is out. */
FBD_API fbd_equations *fbd_assemble(fbd_state *state);

/* As fbd_assemble, with the Newton-Euler equations of every body cut free, reactions included: "block.G.x",
 * "block.G.y", "block.G.angle", after those of its coordinates. For a slide that is not joined to another
 * body there is no moment equation: it has no rotation. */
FBD_API fbd_equations *fbd_assemble_components(fbd_state *state);
FBD_API void fbd_equations_free(fbd_equations *equations);
FBD_API size_t fbd_equations_count(const fbd_equations *equations);
/* Equation `index`, in the order of the bodies and of their coordinates. */
FBD_API fbd_equation fbd_equations_get(const fbd_equations *equations, size_t index);

/* The equation of "block.x", or one with body NULL when there is none; and the value of one of its terms, NAN
 * when there is no such term or equation. */
FBD_API fbd_equation fbd_equations_find(const fbd_equations *equations, const char *coordinate);
FBD_API double fbd_equation_term(const fbd_equation *equation, const char *name);

/* One force or moment of a free-body diagram at a state. */
typedef struct fbd_arrow {
    const char *name;
    double fx, fy; /* force in the world */
    double x, y;   /* point of application */
    double couple; /* free moment (couple) */
    double moment; /* about the pivot's axis, else about the centre of mass */
    double power;
} fbd_arrow;

/* Fill at most `room` arrows of a body, reactions included; returns their number, 0 past the last body.
 * `arrows` may be NULL to count only. */
FBD_API size_t fbd_diagram(fbd_state *state, size_t body, fbd_arrow *arrows, size_t room);

/* The redundant coupling rows at the state: rows that follow from the rows before them (parallel rods, a pin
 * in a direction that a slide constrains already), as "knuckle in y". Fills at most `room` names, which live
 * as long as the model; returns their number. */
FBD_API size_t fbd_redundant(fbd_state *state, const char **names, size_t room);

/* ---------------------------------------------------------------- simulation */

typedef struct fbd_options {
    size_t size;        /* sizeof(fbd_options), or 0 */
    double until;       /* end time; NAN for the file's */
    double tolerance;   /* relative error per step; 0 for the file's, else 1e-10 */
    double step;        /* fixed step size, 0 for automatic or the file's */
    const char *method; /* NULL for the file's, else "auto" */
    bool error_bars;    /* estimate the global errors by a more accurate companion run (see below) */
    /* global accuracy that fbd_simulation_run must reach, above 0 and at most 0.1; 0 for the file's, if any.
     * Implies error bars, and excludes `tolerance` and `step` */
    double accuracy;
    /* integrate all bodies together by the general method, whatever the structure of the forces */
    bool no_structure;
} fbd_options;

/* Options that leave everything to the file, as a macro and as a function for callers that cannot use it;
 * `size` is the caller's sizeof of the struct. */
#define FBD_OPTIONS_DEFAULT                                                                                  \
    {                                                                                                        \
        sizeof(fbd_options), NAN, 0, 0, NULL, false, 0, false                                                \
    }
FBD_API void fbd_options_init(fbd_options *options, size_t size);

typedef enum fbd_event_kind {
    FBD_EVENT_BREAKAWAY, /* a sticking body starts to slip */
    FBD_EVENT_STICK,     /* a slipping body comes to rest on its surface and sticks */
    FBD_EVENT_REVERSAL,  /* a slipping body stops and slips in the opposite direction at once */
    /* a normal force reaches zero: the run ends, since the scene is no longer valid */
    FBD_EVENT_CONTACT_LOST,
    FBD_EVENT_USER,       /* an event of the file */
    FBD_EVENT_ROPE_SLACK, /* the tension of a rope reaches zero */
    FBD_EVENT_ROPE_TAUT,  /* a slack rope becomes taut, with a plastic impact */
    /* the normal force of a rolling or touching body reaches zero, and it leaves its surface */
    FBD_EVENT_LIFT_OFF,
    FBD_EVENT_LANDING,      /* it returns to its surface: a plastic impact */
    FBD_EVENT_SWITCH,       /* an expression passes from one branch to another (step, abs, if, ...) */
    FBD_EVENT_IMPACT,       /* shapes of a contact pair collide */
    FBD_EVENT_CONTACT,      /* the contact pair closes */
    FBD_EVENT_REST,         /* the contact pair closes at a Zeno limit of impacts */
    FBD_EVENT_SLIDING,      /* both branches of a switch point towards it: Filippov sliding mode */
    FBD_EVENT_SLIDING_ENDS, /* the sliding mode ends, and the motion continues on one branch */
    /* no finite forces are consistent with its slip (Painleve's paradox): an impulse ends the slip */
    FBD_EVENT_JAM,
    /* several motions are consistent with the forces, or with the impact; one of them is taken */
    FBD_EVENT_SEVERAL,
    FBD_EVENT_TRACK_END, /* a body reaches an end of its track: the run ends */
} fbd_event_kind;

typedef struct fbd_event {
    double t;
    fbd_event_kind kind;
    const char *body; /* "" for a user event */
    const char *name; /* of the user event or of the load */
    const char *detail;
    double t_error; /* estimated error of t: NAN without error bars, INFINITY when it is unknown */
} fbd_event;

/* "breakaway", "stick", "reversal", "contact_lost", "user", "rope_slack", "rope_taut", "lift_off", "landing",
 * "switch", "impact", "contact", "rest", "sliding", "sliding_ends", "jam", "several", "track_end"; ""
 * for other values */
FBD_API const char *fbd_event_kind_name(fbd_event_kind kind);

typedef enum fbd_outcome {
    FBD_GOING,   /* not at the end yet */
    FBD_DONE,    /* reached the end time */
    FBD_STOPPED, /* a user event with `stop` occurred */
    FBD_BROKEN,  /* an assumption of the scene is violated: contact lost */
    FBD_FAILED,  /* step size underflow, a force that is not finite, no consistent mode, ... */
    FBD_OUT_OF_MEMORY,
    FBD_INTERRUPTED, /* the progress function of the recording ended the run */
} fbd_outcome;

typedef struct fbd_stats {
    const char *method; /* "auto" or the requested one */
    double tolerance;
    unsigned long stiff_steps; /* of these steps, number made by the stiff method of "auto" */
    unsigned long steps, rejected, rhs, jacobians, events, event_samples;
    double seconds; /* processor time of the run itself */

    /* With error bars: the estimated global error, dimensionless. For each coordinate and rate the largest
     * error over the run is divided by the largest magnitude over the run; this is the maximum over all of
     * them. NAN without error bars, INFINITY when unknown. A magnitude counts as at least 1/1000 of the
     * others of the same body and kind (lengths, angles), that of a rate also as at least 1/1000 of the
     * magnitude of its coordinate over the duration of the run. */
    double error_estimate;
    unsigned long companion_steps, companion_rhs; /* cost of the estimate */
    double accuracy;                              /* the requested accuracy, or 0 */
    unsigned long runs;                           /* number of runs made to reach it */
    double seconds_spent; /* processor time of all runs, with ledgers, output and companions */

    size_t groups;   /* islands: groups of bodies that are integrated independently */
    size_t linear;   /* of these, number that is linear with constant coefficients and propagated exactly */
    size_t constant; /* number with constant accelerations, which follow exact parabolas */
    size_t velocity_free; /* number with velocity-independent forces, integrated by a Nystrom method */
} fbd_stats;

typedef struct fbd_simulation fbd_simulation;

/* A simulation at the start of the model; NULL with notes in `errors` (ids `unknown-method`, `bad-option`,
 * `no-end-time`, ...). The model must outlive it. */
FBD_API fbd_simulation *fbd_simulation_new(const fbd_model *model, const fbd_options *options,
                                           fbd_errors *errors);
FBD_API void fbd_simulation_free(fbd_simulation *simulation);

/* A simulation at the start that repeats the steps of another one, to evaluate states anywhere in a finished
 * run: at the tolerance that was found where an accuracy was requested, with error bars or without. NULL with
 * a note in `errors` when memory is out. The other simulation may be freed. */
FBD_API fbd_simulation *fbd_simulation_again(const fbd_simulation *simulation, bool error_bars,
                                             fbd_errors *errors);

/* A simulation that starts at a state and its time; the modes (sticking, taut, closed) are determined as at
 * the start of a run. The state is copied; its model must outlive the simulation. Where the file requests an
 * accuracy, the tolerance is the first guess for that accuracy. NULL with notes in `errors`: as
 * fbd_simulation_new, and `bad-option` for error bars, an accuracy, or an end time before that of the state.
 */
FBD_API fbd_simulation *fbd_simulation_from(const fbd_state *state, const fbd_options *options,
                                            fbd_errors *errors);

/* Advance by one accepted step, or to the next event; with several islands by a step of the one that is
 * furthest behind. With options.accuracy this is a run at the first guess of the tolerance: only
 * fbd_simulation_run reaches the accuracy. */
FBD_API fbd_outcome fbd_simulation_advance(fbd_simulation *simulation);

/* The interval of the last step, and the state at a time in it (dense output; modes are those of the step).
 * Returns false for a time outside it or a state of another model. The trajectory is not affected. */
FBD_API void fbd_simulation_interval(const fbd_simulation *simulation, double *from, double *to);
FBD_API bool fbd_simulation_state(fbd_simulation *simulation, double t, fbd_state *state);

/* Estimated errors at a time t of the last step, of each coordinate, then of each rate (in the order of
 * fbd_model_coordinate), then of each user state, in their units: twice fbd_model_coordinate_count plus
 * fbd_model_state_count numbers. INFINITY when unknown. Returns false without error bars, for another t, or
 * when memory is out.
 *
 * They are differences from a second run of the same scene with a smaller tolerance (1/5; 1/50 for methods
 * other than that of `auto`) and its own steps and events. See docs/error-bars.md. The trajectory is bitwise
 * the same with and without error bars. */
FBD_API bool fbd_simulation_errors(fbd_simulation *simulation, double t, double *errors);

FBD_API size_t fbd_simulation_event_count(const fbd_simulation *simulation);
/* Event `index`, in the order of time; `name` and `detail` live as long as the simulation. */
FBD_API fbd_event fbd_simulation_event(fbd_simulation *simulation, size_t index);
FBD_API fbd_stats fbd_simulation_stats(const fbd_simulation *simulation);

/* Drift of a run with couplings: the largest violation of a row at the ends of steps, in position (lengths;
 * for gears the arc) and in velocity, before the projection and after it. `share` is the largest of both
 * divided by the tolerance times the size of the motion (distances of the links from the origin, and their
 * speeds). */
typedef struct fbd_drift {
    size_t rows; /* of couplings; if 0 all members are 0 */
    double position, velocity, share;
    double left_position, left_velocity, left_share;
    const char *worst; /* the row with the largest violation, "knuckle in x"; "" if none */
} fbd_drift;

FBD_API fbd_drift fbd_simulation_drift(const fbd_simulation *simulation);

/* The reason of the end: one sentence with time, body, quantity and a suggestion; "" without an error. */
FBD_API const char *fbd_simulation_reason(const fbd_simulation *simulation);

/* Check the energy balance from the start to the end of the last step. As fbd_result_balanced without a
 * recording: works are not integrated, so the whole balance is checked for bodies whose forces all have
 * potentials, and for the others the energy lost in impacts. Intended for occasional calls while a run is
 * advanced, and at its end: a call costs about one evaluation of the right-hand side. */
FBD_API bool fbd_simulation_balanced(fbd_simulation *simulation, double *residual, double *explained);

/* If the simulation was refused at its start, for a reason of fbd_state_close, add that reason to `errors`,
 * with id and position in the file. Returns false, and adds no note, otherwise. */
FBD_API bool fbd_simulation_blame(const fbd_simulation *simulation, fbd_errors *errors);

/* ---------------------------------------------------------------- recording a whole run */

typedef struct fbd_recording {
    size_t size;    /* sizeof(fbd_recording), or 0 */
    double every;   /* output interval; 0 for the file's, else 1/500 of the run */
    bool ledger;    /* with a column for each force and its work, and for the energies */
    fbd_write *csv; /* receives the CSV, or NULL; if it returns nonzero the run fails */
    void *csv_context;
    /* do not integrate the work of forces without a potential: results that need it are NAN. Nothing else
     * changes; `ledger` and `keep` take precedence. */
    bool motion_only;
    /* keep the data of fbd_result_html and fbd_result_gnuplot: some 50 MB at most, or 256 rows where a row
     * has more than 16 000 numbers */
    bool keep;
    /* called after every step, so it must be quick; or NULL. Ending the run there gives FBD_INTERRUPTED and
     * all outputs complete up to that time */
    fbd_watch *progress;
    void *progress_context;
    bool table;      /* keep the rows of the CSV as numbers, see fbd_result_table; 8 bytes each */
    bool components; /* show also the components of forces, and moments about the centre of mass */
    /* of `keep`: at least so many at regular times; 0 for 2000, which play smoothly at any zoom */
    unsigned rows;
    /* CSV, table, report, JSON, page and plots show angles and their rates in degrees: of coordinates, of
     * values determined by `assemble`, and their errors. Equations are in radians */
    bool degrees;
} fbd_recording;

/* A column of the rows of a run: "t", "block.x", with error bars followed by "block.x ±"; and its unit. */
typedef struct fbd_column {
    const char *name, *unit;
} fbd_column;

/* The rows of a run, bitwise the values of the CSV. */
typedef struct fbd_table {
    size_t rows, columns;
    const fbd_column *heads; /* of each column */
    const double *values;    /* rows x columns, row by row; INFINITY for an unknown error */
} fbd_table;

/* Energies of the scene, in its unit of energy. work: of the forces without a potential since the start;
 * residual: change of kinetic + potential - work. */
typedef struct fbd_energy {
    double kinetic, potential, work, residual;
    double initial_kinetic, initial_potential;
} fbd_energy;

/* A run from start to end, with its ledger (except with `motion_only`). */
typedef struct fbd_result fbd_result;

/* Run a simulation from its start to its end. With options.accuracy the run is repeated with smaller
 * tolerances until the estimated global error (fbd_stats.error_estimate) is at most that, or until rounding
 * prevents further improvement: then the best run is returned, and fbd_result_accurate is false. The same
 * holds when the progress function ends the search: the best complete run is returned, or the first one as
 * far as it came. Only the returned run is recorded. NULL when memory is out, the writer returns nonzero, or
 * the simulation has been advanced already (the ledger needs every step). The simulation must outlive the
 * result. */
FBD_API fbd_result *fbd_simulation_run(fbd_simulation *simulation, const fbd_recording *recording);
FBD_API void fbd_result_free(fbd_result *result);

/* The rows of a run recorded with `table`; otherwise there are no rows and columns. Lives as long as the
 * result. */
FBD_API fbd_table fbd_result_table(const fbd_result *result);

FBD_API fbd_outcome fbd_result_outcome(const fbd_result *result);
FBD_API fbd_state *fbd_result_state(fbd_result *result); /* the last valid state; owned by the result */
FBD_API fbd_energy fbd_result_energy(fbd_result *result);

/* The largest residual of the energy [the scene's unit of energy] that tolerance and rounding explain. A
 * larger residual shows that the motion is not that of the scene, whatever the local error estimates: the
 * steps have skipped pulses much shorter than themselves (not every such error shows in the energy). INFINITY
 * for steps of fixed size, NAN with `motion_only`. */
FBD_API double fbd_result_residual_explained(fbd_result *result);

/* Check the energy balance, in every run, as far as the recording permits: at events the change of kinetic
 * energy against the work of the impacts; over the run the energy of bodies whose forces all have potentials;
 * and that of all bodies where the works of all forces are integrated. `residual` and `explained`, which may
 * be NULL, receive the residual and the largest one that tolerance and rounding explain [the scene's unit of
 * energy]. */
FBD_API bool fbd_result_balanced(fbd_result *result, double *residual, double *explained);

/* The work of a force or moment on a body since the start; NAN when there is no such name. */
FBD_API double fbd_result_work(fbd_result *result, const char *body, const char *load);

/* Estimated errors at the end of the run: of "block.x" or "block.v"; of energies (0 for the initial ones); of
 * a work. INFINITY when unknown, NAN without error bars or for an unknown name. */
FBD_API double fbd_result_error(fbd_result *result, const char *name);
FBD_API fbd_energy fbd_result_energy_error(fbd_result *result);
FBD_API double fbd_result_work_error(fbd_result *result, const char *body, const char *load);

/* As fbd_diagram at the end of the run, with the estimated errors of fx, fy, x, y, couple, moment and power.
 * 0 without error bars. */
FBD_API size_t fbd_result_force_errors(fbd_result *result, size_t body, fbd_arrow *arrows, size_t room);

/* False when the estimated global error exceeds the accuracy requested by options.accuracy or the file, or is
 * unknown because the run failed or was interrupted. */
FBD_API bool fbd_result_accurate(const fbd_result *result);

/* The result as text, to be freed with fbd_free; NULL when memory is out. For a scene of more than twelve
 * bodies the report is short: totals, events by their kinds, some of the states, the largest forces;
 * fbd_result_report_full is complete. */
FBD_API char *fbd_result_report(fbd_result *result);
FBD_API char *fbd_result_report_full(fbd_result *result);
FBD_API char *fbd_result_json(fbd_result *result);

/* Plots of a run as a script for gnuplot that carries its data. `columns`: names of the CSV's columns with
 * ledger, without units, separated by commas ("block.v,block.friction"), one plot for each unit; NULL for
 * coordinates and energies. `file` (may be NULL) chooses gnuplot's terminal by its ending, .svg, .png or
 * .pdf; the script writes to gnuplot's standard output. NULL with a note in `errors`: `unknown-column`,
 * `not-recorded`, or memory is out. */
FBD_API char *fbd_result_gnuplot(fbd_result *result, const char *file, const char *columns,
                                 fbd_errors *errors);

/* Check that the model has all these columns. Returns false with notes in `errors`. */
FBD_API bool fbd_model_has_columns(const fbd_model *model, const char *columns, fbd_errors *errors);

/* The model language as JSON Schema (draft 07), for editors and other programs: keys, kinds, words and types
 * with their descriptions. To be freed with fbd_free; NULL when memory is out. */
FBD_API char *fbd_schema(void);

/* True if the library was built with the page (which needs a library for its plots). */
FBD_API bool fbd_has_html(void);

/* One self-contained HTML page (UTF-8) that plays the run, with plots, equations and ledger at every time; at
 * most some 5 MB for any length of run. NULL with a note in `errors`: `no-page` if the library was built
 * without it, `not-recorded` for a run without `keep`, or memory is out. */
FBD_API char *fbd_result_html(fbd_result *result, fbd_errors *errors);

/* The scene as one C program for GSL, without memory allocation, with the numbers of the file in a structure:
 * see docs/emit-c.md. `options` (may be NULL) gives the end time and accuracy of its `main`; only `until` and
 * `tolerance` are used. To be freed with fbd_free. NULL with notes in `errors`: `cannot-emit` for a scene
 * with unsupported elements, `no-end-time`, `bad-option`, or memory is out. */
FBD_API char *fbd_emit_c(const fbd_model *model, const fbd_options *options, fbd_errors *errors);

/* ---------------------------------------------------------------- looking at a model */

/* The assembled equations, term by term, as text. To be freed with fbd_free, as all texts below; NULL when
 * memory is out. */
FBD_API char *fbd_equations_text(fbd_state *state);
FBD_API char *fbd_equations_text_components(fbd_state *state); /* of fbd_assemble_components */

/* The equations of every body cut free in symbols of the scene, reactions included, one per line, with the
 * acceleration of G where it follows from the coordinates. */
FBD_API char *fbd_equations_symbols(fbd_state *state);

/* The equations as LaTeX (amsmath), each in symbols of the scene and with the numbers of the state; for
 * joined bodies also those cut free. */
FBD_API char *fbd_equations_latex(fbd_state *state);
FBD_API char *fbd_equations_latex_components(fbd_state *state);

/* The equations and the free-body diagrams, as one JSON object. */
FBD_API char *fbd_equations_json(fbd_state *state);
FBD_API char *fbd_equations_json_components(fbd_state *state);

/* A description of the plan: effects that are simulated, with their number and why they are conservative or
 * not; effects that are not, and the entries that would add them; the right-hand side, events, structure, the
 * method and its reason. */
FBD_API char *fbd_explain(const fbd_model *model, const fbd_options *options);

/* Linearisation about an equilibrium. */
typedef struct fbd_linearization fbd_linearization;

/* Find the equilibrium near `state` (GSL's hybrid Newton method on the accelerations, with zero rates),
 * compute the exact Jacobian and its eigenvalues. NULL with a note in `errors` when there is none nearby
 * (`no-equilibrium`), a user state never rests (`not-at-rest`), a body sticks by friction (`sticks`), a
 * motion is prescribed as a function of time or the couplings are in a singular position (`not-independent`),
 * or a contact or friction is at its limit (`at-limit`). Forces whose derivative vanishes at the equilibrium
 * are noted (`degenerate-equilibrium`, a warning); their rows of A are zero. `state` is moved to the
 * equilibrium. */
FBD_API fbd_linearization *fbd_linearize(fbd_state *state, fbd_errors *errors);
FBD_API void fbd_linearization_free(fbd_linearization *linearization);

/* The system matrix A of x' = A x, x = (q - q0, v, z - z0) with the independent coordinates q and the user
 * states z, row by row, size x size; size is twice the number of independent coordinates (without couplings:
 * of all coordinates) plus the number of user states. */
FBD_API size_t fbd_linearization_size(const fbd_linearization *linearization);
FBD_API const double *fbd_linearization_matrix(const fbd_linearization *linearization);

/* The coordinate of the model (fbd_model_coordinate) that is independent coordinate `index`; (size_t)-1 past
 * the last one. With couplings the others depend on these, to first order. */
FBD_API size_t fbd_linearization_coordinate(const fbd_linearization *linearization, size_t index);

/* One eigenvalue lambda of A. Frequency |lambda| [rad/s] and damping ratio -Re/|lambda| (NAN for lambda = 0).
 * All are NAN past the last one. */
typedef struct fbd_mode {
    double re, im, frequency, damping_ratio;
} fbd_mode;

FBD_API fbd_mode fbd_linearization_mode(const fbd_linearization *linearization, size_t index);
FBD_API char *fbd_linearization_text(const fbd_linearization *linearization);
FBD_API char *fbd_linearization_json(const fbd_linearization *linearization);

/* The eigenvalues in the complex plane, as an SVG document. */
FBD_API char *fbd_linearization_svg(const fbd_linearization *linearization);

/* Move `state` to an equilibrium: the one reached by quasi-static descent from there (steepest descent of the
 * potential in the metric of the masses, with couplings kept), or, where the descent does not end because
 * forces have no potential or the file has user states, the nearest equilibrium. All rates become zero.
 * Returns false with a note in `errors` when none was found (`no-equilibrium`), dry friction of a slide or a
 * bearing permits a range of equilibria (`sticks`), or a motion is prescribed as a function of time
 * (`not-independent`); the state is then undefined. An unstable equilibrium is noted (`unstable-equilibrium`,
 * a warning). */
FBD_API bool fbd_find_equilibrium(fbd_state *state, fbd_errors *errors);

/* The scene at rest in its present position, with every reaction. */
typedef struct fbd_statics fbd_statics;

/* Find the reactions (joints, couplings, normal forces, sticking friction, drives) that keep every body of
 * `state` at rest: sum of forces and sum of moments zero for each. Rates count as zero, friction is within
 * mu_s N where its surface does not move, normal forces are not tensile and ropes not compressed. The state
 * is not changed. Where equilibrium alone does not determine the reactions, those of least sum of squares are
 * taken (of all in joints and couplings, each once, within their limits; couples divided by the largest arm),
 * with a warning `indeterminate`. NULL with a note in `errors`: `does-not-fit` (a coupling), `unsettled`, or
 * memory is out. The model must outlive the result. */
FBD_API fbd_statics *fbd_statics_new(const fbd_state *state, fbd_errors *errors);
FBD_API void fbd_statics_free(fbd_statics *statics);

/* True in equilibrium: to 2e-6 of the largest load, and within the limits of friction, contact and ropes. */
FBD_API bool fbd_statics_holds(const fbd_statics *statics);

/* The degree of static indeterminacy (reactions in excess of equations), and the number of degrees of freedom
 * that the supports leave. */
FBD_API size_t fbd_statics_indeterminacy(const fbd_statics *statics);
FBD_API size_t fbd_statics_mobility(const fbd_statics *statics);

/* The reactions that equilibrium does not determine, "beam.pin in x"; NULL past the end. */
FBD_API size_t fbd_statics_undetermined_count(const fbd_statics *statics);
FBD_API const char *fbd_statics_undetermined(const fbd_statics *statics, size_t index);

/* A force (moment) along a coordinate that would keep a moving scene at rest. If `alone`, any one of the list
 * suffices, otherwise all are needed together. */
typedef struct fbd_unbalanced {
    const char *coordinate, *unit; /* "crank.theta", "N*m" */
    double holding;
    bool alone;
} fbd_unbalanced;

FBD_API size_t fbd_statics_unbalanced_count(const fbd_statics *statics);
FBD_API fbd_unbalanced fbd_statics_unbalanced(const fbd_statics *statics, size_t index);

typedef enum fbd_limit_kind {
    FBD_LIMIT_NORMAL,   /* needed >= 0: a normal force is not tensile */
    FBD_LIMIT_FRICTION, /* needed <= limit = mu_s N, or the static moment of a bearing */
    FBD_LIMIT_ROPE,     /* needed >= 0: a rope is not compressed */
} fbd_limit_kind;

/* The required force of a surface, a friction or a rope, and whether it is within the limit. */
typedef struct fbd_limit {
    const char *name, *unit; /* "block.friction", "N" */
    fbd_limit_kind kind;
    double needed, limit;
    bool holds;
} fbd_limit;

FBD_API size_t fbd_statics_limit_count(const fbd_statics *statics);
FBD_API fbd_limit fbd_statics_limit(const fbd_statics *statics, size_t index);

/* As fbd_diagram, at rest. */
FBD_API size_t fbd_statics_diagram(const fbd_statics *statics, size_t body, fbd_arrow *arrows, size_t room);

/* As text (whether it is in equilibrium, the reason if not, and a table for each body), and as one JSON
 * object; NULL when memory is out. */
FBD_API char *fbd_statics_text(const fbd_statics *statics);
FBD_API char *fbd_statics_json(const fbd_statics *statics);

/* Compare every `hand:` derivation of the model with the assembly at many random admissible states (and
 * parameters; the seed is printed), and lines of energy and momentum with one run of the model. Returns a
 * text that confirms each one or shows the differing terms; *differing (may be NULL) is the number of
 * equations that differ. NULL when memory is out. */
FBD_API char *fbd_check_hand(const fbd_model *model, unsigned seed, size_t *differing);

/* ---------------------------------------------------------------- sweeps */

/* One model with many values of its parameters. */
typedef struct fbd_sweep fbd_sweep;

/* The parameters that vary, and the outputs of each run.
 *
 * A text of `vary` is NAME=VALUES or several of them with `;` between, which vary in parallel. VALUES is a
 * grid "0.1:0.6:51" (start, stop, number; with ":log" appended the ratio of successive values is constant), a
 * list "1,2,5" or random draws "uniform(1,2):100", "normal(3,0.1):100", "loguniform(1,100):100"; a number may
 * have a unit, which applies to all of them: "0:90 deg:10". The texts are combined, each value with each, the
 * last varying fastest; with `zip` all vary in parallel.
 *
 * A text of `outputs` holds names with commas between: t, coordinates and rates ("block.x") at the end of the
 * run; min(block.x), max(block.x); time(NAME) and count(NAME) of an event of the file, a kind of event or
 * BODY.KIND; energy.kinetic etc.; block.friction.work; steps, rhs; and the groups final, times, energy.
 * Default: final, times. */
typedef struct fbd_sweep_plan {
    size_t size; /* sizeof(fbd_sweep_plan), or 0 */
    const char *const *vary;
    size_t vary_count;
    bool zip;
    unsigned long seed; /* of the draws: draw i of a parameter depends only on the seed, its name and i */
    const fbd_setting *settings; /* parameters that are set and do not vary */
    size_t setting_count;
    const char *const *outputs;
    size_t output_count;
    const fbd_options *run; /* NULL for the file's; without error bars and accuracy: a row is one run */
    bool degrees;           /* outputs of angles and their rates are in degrees; varied values are as given */
} fbd_sweep_plan;

/* Read a model file ("-" is standard input) or a text, for a sweep. NULL with notes in `errors`: those of a
 * wrong file or option (see fbd_model_read, fbd_simulation_new), and `bad-vary`, `unknown-parameter`,
 * `varied-twice`, `unknown-output`. The file must be valid with its own values. */
FBD_API fbd_sweep *fbd_sweep_read(const char *path, const fbd_sweep_plan *plan, fbd_errors *errors);
FBD_API fbd_sweep *fbd_sweep_parse(const char *text, size_t length, const char *name,
                                   const fbd_sweep_plan *plan, fbd_errors *errors);
FBD_API void fbd_sweep_free(fbd_sweep *sweep);

/* The number of runs. */
FBD_API size_t fbd_sweep_run_count(const fbd_sweep *sweep);

/* The header line of its table, and a text of everything that determines the rows: two sweeps with equal keys
 * have equal rows. Both live as long as the sweep. */
FBD_API const char *fbd_sweep_header(const fbd_sweep *sweep);
FBD_API const char *fbd_sweep_key(const fbd_sweep *sweep);

/* The text of the model file, for another process. */
FBD_API const char *fbd_sweep_source(const fbd_sweep *sweep, size_t *length);

/* Progress of a sweep. */
typedef struct fbd_sweep_counts {
    size_t written; /* rows written by this call */
    size_t failed;  /* failed runs among them */
} fbd_sweep_counts;

/* How the rows of the runs `first` (from 0) to before `end` are made. Rows have the columns of the header;
 * the first is the number of the run, from 1; the last three are the number of events, the status (done,
 * stopped, broken, failed, or wrong: invalid parameter values) and the reason. A field without a value is
 * empty. Rows are written in order, whole lines, and do not depend on the number of workers. Memory does not
 * grow with the number of runs. */
typedef struct fbd_sweep_work {
    size_t size; /* sizeof(fbd_sweep_work), or 0 */
    size_t first, end;
    size_t jobs;      /* threads; 0: the number of processors */
    fbd_write *write; /* receives the rows; called by one thread at a time, as is `progress` */
    void *write_context;
    fbd_watch *progress; /* called when rows have been written; or NULL */
    void *progress_context;
    fbd_stop *stop; /* called by every thread in each step; or NULL */
    void *stop_context;
} fbd_sweep_work;

typedef enum fbd_sweep_end {
    FBD_SWEEP_DONE,
    FBD_SWEEP_STOPPED, /* `stop` or `progress` returned nonzero; whole rows up to some run were written */
    FBD_SWEEP_REFUSED, /* `write` returned nonzero, or is NULL */
    FBD_SWEEP_OUT_OF_MEMORY,
} fbd_sweep_end;

/* Make the rows and wait until they are complete. *counts (may be NULL) receives their numbers. */
FBD_API fbd_sweep_end fbd_sweep_run(const fbd_sweep *sweep, const fbd_sweep_work *work,
                                    fbd_sweep_counts *counts);

/* ---------------------------------------------------------------- what accuracy costs */

typedef struct fbd_cost_options {
    size_t size;   /* sizeof(fbd_cost_options), or 0 */
    double until;  /* end of the run; NAN for the file's */
    double budget; /* total seconds allowed, of processor time if other processes use it too; 0: 6 s */
    const char *const *methods; /* names; NULL for all */
    size_t method_count;
    const char *const *quantities; /* coordinates and rates whose error counts, qualified; NULL for all */
    size_t quantity_count;
    bool fixed_steps;    /* ladders of fixed steps (one-step methods) instead of tolerances */
    fbd_watch *progress; /* called occasionally, or NULL; nonzero ends the study with the note `stopped` */
    void *progress_context;
} fbd_cost_options;

#define FBD_COST_OPTIONS_DEFAULT                                                                             \
    {                                                                                                        \
        sizeof(fbd_cost_options), NAN, 0, NULL, 0, NULL, 0, false, NULL, NULL                                \
    }
FBD_API void fbd_cost_options_init(fbd_cost_options *options, size_t size);

typedef enum fbd_point_state {
    FBD_POINT_MEASURED,
    FBD_POINT_FAILED,  /* the run failed, or ended differently from the reference; see `reason` */
    FBD_POINT_SKIPPED, /* it would take too long for the budget */
} fbd_point_state;

/* One method with one setting on the scene: its error and its cost. */
typedef struct fbd_point {
    const char *method;
    double tolerance, step; /* one of the two; the other is 0 */
    fbd_point_state state;
    const char *reason; /* "" when measured */

    /* True global errors: the largest |error| / scale over all selected quantities; over the run (at 241
     * times) and at its end. The scale of a quantity is its largest magnitude over the run. */
    double error, error_end;
    const char *worst;  /* the quantity of `error` */
    bool floor;         /* at most the uncertainty of the reference */
    double event_error; /* largest error of an event's time; NAN without events, or if the events differ */
    bool same_events;   /* as many as in the reference, of the same kinds, in the same order */

    double seconds, low, high; /* of one run without output: median and quartiles */
    unsigned repeats;
    fbd_stats stats;
    bool front; /* no other point is both more accurate and cheaper */
} fbd_point;

/* The reference that errors are relative to: see lib/study/reference.h. */
typedef struct fbd_reference {
    const char *says;          /* one or more sentences */
    const char *method[2];     /* the two runs that agree best, ... */
    double tolerance[2];       /* ... and their tolerances */
    bool exact, exact_differs; /* from `exact:` of the file; `exact:` is not the solution of the scene */
    double floor, floor_end;   /* uncertainty of the reference (scaled) */
    double until, known;       /* end of the run; time up to which the reference is accurate to 1e-6 */
    bool complete;             /* accurate up to the end */
    double tenfold;            /* time in which differences grow tenfold, or NAN */
} fbd_reference;

/* All points of one method. */
typedef struct fbd_series {
    const char *method;
    bool fixed;          /* a ladder of steps, not of tolerances */
    size_t first, count; /* its points, from loose to tight */
    double order;        /* p in error ~ (mean step)^p by least squares; NAN with too few points */
} fbd_series;

typedef struct fbd_cost fbd_cost;

/* Run every method at every tolerance of a ladder on the scene and measure true error against time. NULL with
 * notes in `errors` (those of fbd_simulation_new, `unknown-quantity`, `no-reference`, `stopped`). The model must outlive
 * the result. */
FBD_API fbd_cost *fbd_cost_new(const fbd_model *model, const fbd_cost_options *options, fbd_errors *errors);
FBD_API void fbd_cost_free(fbd_cost *cost);

FBD_API fbd_reference fbd_cost_reference(const fbd_cost *cost);
FBD_API size_t fbd_cost_series_count(const fbd_cost *cost);
FBD_API fbd_series fbd_cost_series(const fbd_cost *cost, size_t index);
FBD_API size_t fbd_cost_point_count(const fbd_cost *cost);
FBD_API fbd_point fbd_cost_point(const fbd_cost *cost, size_t index);

/* The cheapest point whose error over the run is at most `error`, and remains so at all tighter settings of
 * its method; without a method when there is none. Among points whose costs agree to 3 %, the default method
 * is preferred. */
FBD_API fbd_point fbd_cost_cheapest(const fbd_cost *cost, double error);

/* As text, to be freed with fbd_free; NULL when memory is out. fbd_cost_svg is the work-precision diagram. */
FBD_API char *fbd_cost_text(const fbd_cost *cost);
FBD_API char *fbd_cost_csv(const fbd_cost *cost);
FBD_API char *fbd_cost_json(const fbd_cost *cost);
FBD_API char *fbd_cost_svg(const fbd_cost *cost);

/* ---------------------------------------------------------------- what each effect costs */

/* The scene with one effect left out, compared with the complete scene. */
typedef struct fbd_effect {
    const char *body, *name;       /* "block", "friction"; body "" for an effect of the whole scene */
    const char *change;            /* "left out", "linear: sin(theta) -> theta", ... */
    const char *reason;            /* why the effect cannot be left out; "" if it can */
    double change_end, change_max; /* of the result: |difference| / scale, at the end and over the run */
    const char *worst;             /* the quantity with the largest change */
    bool noise;                    /* not larger than the differences between runs of the scene itself */
    double time;                   /* run time without it / run time of the scene; NAN when not measured */
    long events;                   /* of the run without it, minus those of the scene */
} fbd_effect;

typedef struct fbd_effects fbd_effects;

/* Leave out each effect separately. The options `methods`, `quantities` and `fixed_steps` are not used. */
FBD_API fbd_effects *fbd_effects_new(const fbd_model *model, const fbd_cost_options *options,
                                     fbd_errors *errors);
FBD_API void fbd_effects_free(fbd_effects *effects);
FBD_API size_t fbd_effects_count(const fbd_effects *effects);
FBD_API fbd_effect fbd_effects_get(const fbd_effects *effects, size_t index);
FBD_API char *fbd_effects_text(const fbd_effects *effects);
FBD_API char *fbd_effects_csv(const fbd_effects *effects);
FBD_API char *fbd_effects_json(const fbd_effects *effects);

/* ---------------------------------------------------------------- drawings */

typedef struct fbd_drawing {
    size_t size;      /* sizeof(fbd_drawing), or 0 */
    const char *body; /* only this body; NULL for all */
    bool components;  /* with the components of each force: along x and y, on a slide along and across it */
    bool supports;    /* with the ground, surfaces and bearings that the bodies are cut free from */
    bool symbols;     /* arrows labelled by symbols, m g, N, T_1, instead of names and values */
    bool worksheet;   /* the bodies cut free and no arrows, with lines to write on */
    bool solution;    /* of that worksheet: arrows by symbols, and the value of each symbol on its line */
    /* the force, in the scene's unit, that corresponds to 10 mm; 0: a round one that suits all bodies */
    double scale;
} fbd_drawing;

/* The free-body diagrams of a state as an SVG 1.1 document in millimetres, to be freed with fbd_free. `drawing`
 * may be NULL. Ids are `BODY` for a diagram, `BODY-FORCE` for an arrow (`BODY-FORCE-x`, `-y`, `-n` for
 * components). NULL with a note in `errors` (`unknown-body`, or memory is out). */
FBD_API char *fbd_diagram_svg(fbd_state *state, const fbd_drawing *drawing, fbd_errors *errors);

/* ---------------------------------------------------------------- grading */

/* A teacher's model with which answers are compared: its forces, moments and derivations are the correct
 * ones, its `grading` gives their marks. */
typedef struct fbd_key fbd_key;

/* Read a key. NULL with notes in `errors`: those of a wrong model file, and `nothing-to-grade`. */
FBD_API fbd_key *fbd_key_read(const char *path, fbd_errors *errors);

/* As fbd_key_read with parameter values from outside, for example of a learning platform that draws its own:
 * in sheets and answers they replace those of the file, and those drawn by `grading: {draw: ...}`. */
FBD_API fbd_key *fbd_key_read_set(const char *path, const fbd_setting *settings, size_t setting_count,
                                  fbd_errors *errors);

/* As fbd_key_read_set, from a text; `name` is its name in messages, or NULL. */
FBD_API fbd_key *fbd_key_parse(const char *text, size_t length, const char *name, const fbd_setting *settings,
                               size_t setting_count, fbd_errors *errors);
FBD_API void fbd_key_free(fbd_key *key);

/* If the file of a model has `grading`, check it as a key: the notes of fbd_key_read about marks
 * (`key-differs`, `nothing-to-grade`) go to `errors`. True for a key that can be graded, and for every model
 * without `grading`; false with a note. */
FBD_API bool fbd_model_check_key(const fbd_model *model, fbd_errors *errors);

/* The sheet for a student, as a model file: the scene without forces, moments, derivations and comments, with
 * the values that `grading: {draw: ...}` draws for the name of this student. To be freed with fbd_free; NULL
 * with a note in `errors` when memory is out. */
FBD_API char *fbd_key_handout(const fbd_key *key, const char *student, fbd_errors *errors);

/* The same sheet with the solution: the entries of the key, its derivations, the required reactions with
 * their values at the start, and the equations of all bodies in comments. As an answer it gets all points. */
FBD_API char *fbd_key_solution(const fbd_key *key, const char *student, fbd_errors *errors);

typedef enum fbd_finding_kind {
    FBD_FINDING_RIGHT,
    FBD_FINDING_MISSING,     /* a force or moment, or a derivation, is missing */
    FBD_FINDING_SUPERFLUOUS, /* a listed force or moment does not act on the body */
    FBD_FINDING_PLACE,       /* wrong line of action */
    FBD_FINDING_DIRECTION,
    FBD_FINDING_SENSE, /* it points the opposite way */
    FBD_FINDING_MAGNITUDE,
    FBD_FINDING_UNIT,            /* its magnitude is wrong by a factor between units */
    FBD_FINDING_COEFFICIENT,     /* of friction */
    FBD_FINDING_INERTIA,         /* mass, centre of mass or moment of inertia */
    FBD_FINDING_REFERENCE_POINT, /* a moment of inertia is about another point */
    FBD_FINDING_MOTION,          /* a body has another kind of motion */
    FBD_FINDING_BODY,            /* a body is missing, or superfluous */
    FBD_FINDING_UNREADABLE,      /* an entry cannot be read */
    FBD_FINDING_DERIVATION,      /* it contradicts mechanics, or holds for any forces */
    FBD_FINDING_NO_SUBMISSION,
} fbd_finding_kind;

/* "right", "missing", "superfluous", "place", "direction", "sense", "magnitude", "unit", "coefficient",
 * "inertia", "reference_point", "motion", "body", "unreadable", "derivation", "no_submission"; "" for other
 * values */
FBD_API const char *fbd_finding_kind_name(fbd_finding_kind kind);

/* One part of an answer. `message` names only things that the student wrote, and may be shown; `detail` names
 * the key's. */
typedef struct fbd_finding {
    fbd_finding_kind kind;
    const char *body, *name; /* "" where there is none */
    int line, column;        /* in the answer, 0 if there is no position */
    double points, most;     /* points given (negative: subtracted), and the maximum */
    const char *message, *detail;
} fbd_finding;

typedef struct fbd_grade fbd_grade;

/* Compare an answer with a key by mechanics. `student` determines the drawn values; NULL takes the name of
 * the file, without folders and `.yaml`. A missing answer, or one that is no model, has no points. NULL with
 * a note in `errors`: the file exists but cannot be read (`cannot-read`), or memory is out. The key must
 * outlive the grade. */
FBD_API fbd_grade *fbd_grade_new(const fbd_key *key, const char *path, const char *student,
                                 fbd_errors *errors);

/* As fbd_grade_new, for an answer given as text. `student` is its name in the output. */
FBD_API fbd_grade *fbd_grade_parse(const fbd_key *key, const char *text, size_t length, const char *student,
                                   fbd_errors *errors);
FBD_API void fbd_grade_free(fbd_grade *grade);

/* Points of the answer, at least 0, and the maximum. */
FBD_API double fbd_grade_points(const fbd_grade *grade);
FBD_API double fbd_grade_most(const fbd_grade *grade);

/* True if there is an answer and its points suffice. */
FBD_API bool fbd_grade_passed(const fbd_grade *grade);

FBD_API size_t fbd_grade_finding_count(const fbd_grade *grade);
FBD_API fbd_finding fbd_grade_finding(const fbd_grade *grade, size_t index);

/* As text, and as one JSON object (docs/grading.md); with `details` also the findings that name the key's
 * forces. To be freed with fbd_free; NULL when memory is out. */
FBD_API char *fbd_grade_text(const fbd_grade *grade, bool details);
FBD_API char *fbd_grade_json(const fbd_grade *grade, bool details);

/* ---------------------------------------------------------------- pages that run */

/* The sheet of a student as one HTML file to draw on: the bodies cut free; forces and moments are drawn by
 * mouse, finger or keyboard, derivations are typed. The drawing is saved as the answer that fbd_grade_new
 * reads. With `exam` the page contains nothing of the key; without it, it contains the key and the library,
 * and grades. To be freed with fbd_free; NULL with a note in `errors`: `no-sheet` (the key without its
 * solution is no model), `not-finite`, `no-live` (without `exam`: not fbd_has_live()), `no-page` (built
 * without pages), or memory is out. */
FBD_API char *fbd_key_page(const fbd_key *key, const char *student, bool exam, fbd_errors *errors);

/* The values of the file that a slider can change and the effects that can be switched off, with their
 * positions in the text, as one JSON object (its format: lib/live/controls.c). To be freed with fbd_free;
 * NULL with a note in `errors` when memory is out. */
FBD_API char *fbd_model_controls(const fbd_model *model, fbd_errors *errors);

/* The text of the file without some of the effects that it lists: "block.friction", or the name of a coupling
 * or contact. An entry on lines of its own becomes a comment; so do derivations by hand of the bodies
 * concerned. To be freed with fbd_free; NULL with a note in `errors`: `unknown-effect`, or memory is out. */
FBD_API char *fbd_model_without(const fbd_model *model, const char *const *effects, size_t count,
                                fbd_errors *errors);

/* The notes of a list, as one JSON list of {severity, id, message, hint, line, column}. To be freed with
 * fbd_free; NULL when memory is out. */
FBD_API char *fbd_errors_json(fbd_errors *errors);

/* The data of a page of --html about a run, as one JSON object (its format: lib/draw/page_data.c), for a run
 * recorded with `keep`. To be freed with fbd_free; NULL with a note in `errors`: `not-recorded`, or memory is
 * out. */
FBD_API char *fbd_result_page_data(fbd_result *result, fbd_errors *errors);

/* True if the library was built with the parts of live pages: itself as WebAssembly (`make live`). */
FBD_API bool fbd_has_live(void);

/* The initial settings of the page, beside the file: how the model was read and run; all may be omitted. */
typedef struct fbd_live_options {
    size_t size; /* sizeof(fbd_live_options), or 0 */
    const fbd_setting *settings;
    size_t setting_count;
    const fbd_options *run; /* until, method and tolerance; NULL for the file's */
} fbd_live_options;

/* As fbd_result_html, with the library and the text of the model included: the page has sliders, an editor
 * and checkboxes, and repeats the run after every change. At most 2 MB. NULL with a note in `errors`:
 * `no-live` where the library was built without it, `cannot-read` for the data file of a table, and those of
 * fbd_result_html. */
FBD_API char *fbd_result_live_html(fbd_result *result, const fbd_live_options *options, fbd_errors *errors);

/* ---------------------------------------------------------------- models for other simulators */

/* A model as a Functional Mock-up Unit (fmi-standard.org): docs/fmi.md. */
typedef struct fbd_fmu_options {
    size_t size;                 /* sizeof(fbd_fmu_options), or 0 */
    int version;                 /* of FMI: 3, or 2 for tools that do not support 3; 0 is 3 */
    const char *library;         /* the binary to include, of this version of fbd, contained in fbd-run ... */
    size_t library_length;       /* ... and its length in bytes */
    const char *name;            /* of the FMU; NULL for that of the model file */
    const fbd_setting *settings; /* those that the model was read with: they become its start values */
    size_t setting_count;
    const fbd_options *run; /* NULL for the file's; without error bars and accuracy */
} fbd_fmu_options;

/* The FMU for co-simulation with that binary, as bytes of a zip archive, to be freed with fbd_free; *length
 * is their number. NULL with notes in `errors`: those of wrong options (see fbd_simulation_new), of an
 * inadmissible start (see fbd_state_close), `cannot-read` for the data file of a table, `bad-call`, or memory
 * is out. */
FBD_API char *fbd_fmu(const fbd_model *model, const fbd_fmu_options *options, size_t *length,
                      fbd_errors *errors);

FBD_API const char *fbd_version(void);

#ifdef __cplusplus
}
#endif

#endif
