/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd: free-body diagrams that run. The public header; fbd_workers.h beside it is for sweeps over several processes.
 *
 * Units are those of the model's system (`units: SI` or `US`), angles radians, times seconds; where a name and its unit
 * are handed out together, the unit is that text.
 *
 * Counting and getting. fbd_OBJECT_THINGS... are counted by fbd_OBJECT_THING_count and got by fbd_OBJECT_THING(object,
 * index), index from 0; of what is a list itself by fbd_LIST_count and fbd_LIST_get. Structs are handed out by value;
 * past the end their texts are NULL and their numbers NAN or 0. Texts in them live as long as the object. What is
 * computed at the call goes into an array of the caller (`room` elements at most) and the answer is how many there are;
 * with the array NULL it is only counted.
 *
 * Ownership. What a function with `new`, `read`, `parse`, `run`, `assemble` or `linearize` in its name makes is freed by
 * the `free` of its type; every `char *` that is not const is freed by fbd_free. All else belongs to the library.
 *
 * Options are structs whose first member is their size. Zero is the default of every member but those that the
 * _DEFAULT macro or the _init function of the struct sets; NULL for the whole struct is all defaults. `size` is sizeof
 * the struct, as the caller knows it, so that a program goes on to work when later versions add members at the end;
 * 0 stands for the members of version 0.1. A member that is set and that this library does not know is refused
 * (`bad-call`). A struct that is handed out by value grows only with the soname.
 *
 * Callbacks are called with the context that stands beside them, and answer 0 to go on; anything else ends what is
 * under way, with what was made so far whole. They must not call what is under way.
 *
 * A call that cannot be meant changes nothing and answers with the error value of its function, whatever the
 * build: with NULL where an object, a text or a place for an answer is asked for, an index past the end, a
 * state of another model. Error values are NULL, false, 0 for what is counted, NAN for a number, "" for a
 * text that is never NULL, and FBD_FAILED, FBD_SWEEP_REFUSED or -1 where a function says so; with a list of
 * errors there is a note `bad-call`. Functions that free take NULL. Of an object that has been freed nothing
 * can be known. Options may be NULL: all is then as in the file.
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

/* Free a text or bytes that a function has handed out. NULL is allowed. */
FBD_API void fbd_free(void *memory);

/* ---------------------------------------------------------------- callbacks */

/* Takes a piece of text of `length` bytes, which is not terminated and lives until it returns. */
typedef int fbd_write(void *context, const char *text, size_t length);

/* How far something is. What does not apply is 0, or "". */
typedef struct fbd_progress {
    const char *what;       /* "run", "sweep"; of a study "reference", "errors", "timing", "effects" */
    double share;           /* how much of that is done, 0 to 1 */
    double t, until;        /* a run: simulated time reached, end time [s] */
    unsigned long steps;    /* a run: accepted */
    size_t events;          /* a run: found */
    size_t written, failed; /* a sweep: rows written, and runs among them that came to no good end */
} fbd_progress;

/* Is told how far something is. It changes nothing in what is computed. */
typedef int fbd_watch(void *context, const fbd_progress *progress);

/* Is asked by any thread, often, whether to go on: must be quick. */
typedef int fbd_stop(void *context);

/* ---------------------------------------------------------------- errors */

typedef enum fbd_severity {
    FBD_ERROR,
    FBD_WARNING,
} fbd_severity;

/* One thing that is wrong with a model file. Lines and columns are 1-based; 0 means that none is known. */
typedef struct fbd_error {
    fbd_severity severity;
    const char *id;                   /* stable, for programs: "unknown-key", "wrong-dimension", ... */
    const char *message;              /* what is wrong, one line, safe to print */
    const char *hint;                 /* what to write instead, or NULL */
    const char *file;                 /* as it was given: see fbd_escape before printing it */
    int line, column;                 /* where it is wrong */
    int context_line, context_column; /* what was being read there, 0 when that adds nothing */
} fbd_error;

/* A list of them, owned by the caller; it may be used again for further calls. One list serves one thread.
 * Every function that takes a list also takes NULL, when nobody wants to know what is wrong. */
typedef struct fbd_errors fbd_errors;

/* An empty list, or NULL when memory is out. */
FBD_API fbd_errors *fbd_errors_new(void);
FBD_API void fbd_errors_free(fbd_errors *errors);

/* How many notes there are, and how many of them are errors (not warnings). */
FBD_API size_t fbd_errors_count(const fbd_errors *errors);
FBD_API size_t fbd_errors_failed_count(const fbd_errors *errors);

/* Note `index` in the order of position in the file. */
FBD_API fbd_error fbd_errors_get(fbd_errors *errors, size_t index);

/* File `index` that the calls with this list have read or tried to, right or wrong: the model file, and the
 * data files of its tables; NULL past the last. Standard input is none. Lives as long as the list. */
FBD_API size_t fbd_errors_file_count(const fbd_errors *errors);
FBD_API const char *fbd_errors_file(const fbd_errors *errors, size_t index);

/* Write every note as `file:line:col: error: message` and `    hint: ...`. */
FBD_API void fbd_errors_print(fbd_errors *errors, FILE *stream);

/* A text for a person: what a terminal would obey (escape sequences), what turns the order of a text around
 * and what nobody sees is written as `\x1b`, `\u202e`, `\U000e0001`; the rest stays. Titles, paths and
 * whatever a user wrote should be printed so; messages and texts of the library are made so already. Fills
 * `shown` with whole characters and a final zero, as far as there is room; returns how many bytes all of it
 * has, without that zero. */
FBD_API size_t fbd_escape(const char *text, char *shown, size_t room);

/* ---------------------------------------------------------------- models */

/* A scene compiled: constant after it is made, and shareable by threads. */
typedef struct fbd_model fbd_model;

/* A parameter of the file set from outside; `value` is text as in the file ("50", "50 N", "2*f0"). */
typedef struct fbd_setting {
    const char *name, *value;
} fbd_setting;

/* Read and compile a model file ("-" is standard input) or a text. NULL with notes in `errors` when it is
 * wrong or cannot be read (id `cannot-read`); `name` is what messages call the text, or NULL; a model may
 * come with warnings. The model is the caller's, to be freed with fbd_model_free. */
FBD_API fbd_model *fbd_model_read(const char *path, const fbd_setting *settings, size_t setting_count,
                                  fbd_errors *errors);
FBD_API fbd_model *fbd_model_parse(const char *text, size_t length, const char *name,
                                   const fbd_setting *settings, size_t setting_count, fbd_errors *errors);
FBD_API void fbd_model_free(fbd_model *model);

/* The title of the file, "" when it has none. */
FBD_API const char *fbd_model_title(const fbd_model *model);

/* The text of the file as it was read, not terminated; lives as long as the model. */
FBD_API const char *fbd_model_source(const fbd_model *model, size_t *length);

FBD_API size_t fbd_model_body_count(const fbd_model *model);

/* NULL past the last body. */
FBD_API const char *fbd_model_body_name(const fbd_model *model, size_t body);

/* What a body weighs and how it turns, in the model's units; I_O and L are 0 but for a pivot (about its axis;
 * distance from the axis O to the centre of mass G). All are NAN past the last body. */
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

/* A parameter or an input of the file, as it is in this model: set from outside, or with the file's value. Texts live
 * as long as the model. */
typedef struct fbd_parameter {
    const char *name, *unit; /* coherent unit of the value; "" for a pure number, also one that takes whatever
                                dimension its use needs */
    const char *description; /* "" without */
    double value;
    bool input;       /* of `inputs`: it may change while the motion goes on */
    bool derived;     /* the file defines it by other parameters, or gravity */
    double low, high; /* from where to where a slider should move it; NAN where the file does not say */
} fbd_parameter;

/* Those of `parameters` in the order of the file, then those of `inputs`. Past the last one: without a name. */
FBD_API size_t fbd_model_parameter_count(const fbd_model *model);
FBD_API fbd_parameter fbd_model_parameter(const fbd_model *model, size_t index);

/* A state of the file's own, from `states`: its qualified name ("states.charge"), its unit and that of its rate, "1" for
 * a pure number. They live as long as the model, and are NULL past the last one. fbd_state_get and fbd_state_set know it
 * by that name. */
typedef struct fbd_own_state {
    const char *name, *unit, *rate_unit;
} fbd_own_state;

FBD_API size_t fbd_model_state_count(const fbd_model *model);
FBD_API fbd_own_state fbd_model_state(const fbd_model *model, size_t index);

/* ---------------------------------------------------------------- states and assembled equations */

/* Time, coordinates, rates and modes (stick or slip) of one run; belongs to one thread. */
typedef struct fbd_state fbd_state;

/* A state at the file's initial values and t = 0, modes settled. NULL when memory is out. */
FBD_API fbd_state *fbd_state_new(const fbd_model *model);
FBD_API void fbd_state_free(fbd_state *state);

/* Make `to` equal to `from`. False when they are not of the same model. */
FBD_API bool fbd_state_copy(fbd_state *to, const fbd_state *from);

/* All that a motion goes on from, as numbers: the time, coordinates and rates, what expressions with a memory
 * (`hysteresis`) remember, and what couplings keep of their start, for example the length of a rope. Fills at most
 * `room` of them; returns how many there are. */
FBD_API size_t fbd_state_pack(const fbd_state *state, double *numbers, size_t room);

/* Put such numbers into a state of the same model, or of a model of the same text under other settings. Modes are
 * settled anew by the next call that needs them. False, and nothing is changed, when they are not of such a state. */
FBD_API bool fbd_state_unpack(fbd_state *state, const double *numbers, size_t count);

/* Set or get "t", "body.coordinate" or "body.rate" ("block.x", "pendulum.omega"). False for an unknown name
 * or a value that is not finite. Modes are settled anew by the next call that needs them, as at the start of
 * a run. */
FBD_API bool fbd_state_set(fbd_state *state, const char *name, double value);

/* The same from text with a unit ("180 deg"); the name may leave the body out when the scene has only one.
 * False with a note in `errors`. */
FBD_API bool fbd_state_set_text(fbd_state *state, const char *name, const char *text, fbd_errors *errors);

/* The same, where a plain number is one of degrees, of the rate of an angle of degrees in a second. */
FBD_API bool fbd_state_set_text_degrees(fbd_state *state, const char *name, const char *text,
                                        fbd_errors *errors);

/* A quantity in the units of the model from text with the dimension of `unit` ("N"): "5 lbf" or "2*3[N]"; a plain number is
 * in the model's unit. `name` is what messages call it. False with a note in `errors`. */
FBD_API bool fbd_model_quantity(const fbd_model *model, const char *name, const char *text, const char *unit,
                                double *value, fbd_errors *errors);

/* From now on what is written of a state, and of its statics and linearisation, has coordinates and their rates in degrees
 * where they are angles. Equations, matrices and the numbers of structures are in radians. */
FBD_API void fbd_state_show_degrees(fbd_state *state, bool degrees);

/* Make a state one that a motion can start at: bodies with `assemble` find their place, and the others fit
 * their couplings to six digits. False with a note in `errors` of what a run would be refused for at its
 * start: `does-not-fit` (which coupling is off, and the nearest state that fits), `not-finite` (which force,
 * or other quantity), `unsettled` (no choice of stick and slip agrees with the forces), `leaves-surface` (a
 * normal force would have to pull), `masses-apart` (the forces of couplings cannot be told), `singular-start`
 * (at rest where couplings have no slope, and about to move as they do not allow), or memory is out. */
FBD_API bool fbd_state_close(fbd_state *state, fbd_errors *errors);
/* Also the mass of a body as it is there, "rocket.m". False for an unknown name. */
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

/* Assemble the equations of all coordinates at a state; of a body without any, which is welded, those of the body
 * cut free. Accelerations are those in the world: "a_x", "alpha" where the body moves on a body that moves. NULL
 * when memory is out. */
FBD_API fbd_equations *fbd_assemble(fbd_state *state);

/* With Newton's and Euler's equations of every body cut free, reactions and all: "block.G.x", "block.G.y",
 * "block.G.angle", behind those of its coordinates. On a slide that nothing joins to a body moments are not
 * balanced: it knows no rotation. */
FBD_API fbd_equations *fbd_assemble_components(fbd_state *state);
FBD_API void fbd_equations_free(fbd_equations *equations);
FBD_API size_t fbd_equations_count(const fbd_equations *equations);
/* Equation `index`, in the order of the bodies and of their coordinates. */
FBD_API fbd_equation fbd_equations_get(const fbd_equations *equations, size_t index);

/* The equation of "block.x", without a body when there is none; and the value of one of its terms, NAN when there is no such term (or
 * equation). */
FBD_API fbd_equation fbd_equations_find(const fbd_equations *equations, const char *coordinate);
FBD_API double fbd_equation_term(const fbd_equation *equation, const char *name);

/* One force or moment of a free-body diagram at a state. */
typedef struct fbd_arrow {
    const char *name;
    double fx, fy; /* force in the world */
    double x, y;   /* where it acts */
    double couple; /* a moment by itself */
    double moment; /* about the pivot's axis, else about the centre of mass */
    double power;
} fbd_arrow;

/* Fill at most `room` arrows of a body, reactions included; returns how many there are, 0 past the last body.
 * `arrows` may be NULL when only their number is asked for. */
FBD_API size_t fbd_diagram(fbd_state *state, size_t body, fbd_arrow *arrows, size_t room);

/* The rows of couplings that say nothing at the state which the rows before them do not say (parallel rods, a
 * pin in a direction that a slide keeps already): "knuckle in y". Fills at most `room` names, which live as
 * long as the model; returns how many there are. */
FBD_API size_t fbd_redundant(fbd_state *state, const char **names, size_t room);

/* ---------------------------------------------------------------- simulation */

typedef struct fbd_options {
    size_t size;        /* sizeof(fbd_options), or 0 */
    double until;       /* end time; NAN for the file's */
    double tolerance;   /* relative error per step; 0 for the file's, else 1e-10 */
    double step;        /* fixed step size, 0 for automatic or the file's */
    const char *method; /* NULL for the file's, else "auto" */
    bool error_bars;    /* estimate the global errors by a more accurate run that goes along (see below) */
    double accuracy; /* global accuracy to be delivered by fbd_simulation_run, above 0 and at most 0.1; 0 for
                        the file's, if any. Brings error bars, and excludes `tolerance` and `step` */
    bool no_structure; /* integrate all bodies together by the general method, whatever the forces are like */
} fbd_options;

/* Options that leave everything to the file, and the same for callers that cannot use a macro; `size` is that of the
 * struct as they know it. */
#define FBD_OPTIONS_DEFAULT                                                                                  \
    {                                                                                                        \
        sizeof(fbd_options), NAN, 0, 0, NULL, false, 0, false                                                \
    }
FBD_API void fbd_options_init(fbd_options *options, size_t size);

typedef enum fbd_event_kind {
    FBD_EVENT_BREAKAWAY,    /* a sticking body starts to slip */
    FBD_EVENT_STICK,        /* a slipping body comes to rest on its surface and stays */
    FBD_EVENT_REVERSAL,     /* a slipping body stops and slips back at once */
    FBD_EVENT_CONTACT_LOST, /* a normal force reaches zero: the run ends, since the scene is no longer true */
    FBD_EVENT_USER,         /* an event of the file */
    FBD_EVENT_ROPE_SLACK,   /* the tension of a rope reaches zero */
    FBD_EVENT_ROPE_TAUT,    /* a slack rope reaches its length: what that takes from the motion is a plastic
                               impact */
    FBD_EVENT_LIFT_OFF, /* the normal force of what rolls or touches reaches zero, and it leaves its surface
                         */
    FBD_EVENT_LANDING,  /* it comes back to its line: a plastic impact (`force` is what it takes) */
    FBD_EVENT_SWITCH,   /* an expression passes from one branch to another (step, abs, if, ...) */
    FBD_EVENT_IMPACT,   /* shapes of a contact strike each other */
    FBD_EVENT_CONTACT,  /* they touch from now on */
    FBD_EVENT_REST,     /* infinitely many impacts have ended: they touch from now on */
    FBD_EVENT_SLIDING,  /* both branches of a switch lead back to it: the motion slides along it (Filippov) */
    FBD_EVENT_SLIDING_ENDS, /* and goes on by one of them */
    FBD_EVENT_JAM, /* no finite forces go with its slip (Painleve's paradox): an impulse ends the slip */
    FBD_EVENT_SEVERAL, /* several motions agree with the forces from here on, or with an impact, and one is taken */
    FBD_EVENT_TRACK_END, /* a body comes to an end of its track: the run ends */
} fbd_event_kind;

typedef struct fbd_event {
    double t;
    fbd_event_kind kind;
    const char *body; /* "" for a user event */
    const char *name; /* of the user event or of the load */
    const char *detail;
    double t_error; /* estimated error of t: NAN without error bars, INFINITY when it is not known */
} fbd_event;

/* "breakaway", "stick", "reversal", "contact_lost", "user", "rope_slack", "rope_taut", "lift_off", "landing",
 * "switch", "impact", "contact", "rest", "sliding", "sliding_ends", "jam", "several"; "" for none of them */
FBD_API const char *fbd_event_kind_name(fbd_event_kind kind);

typedef enum fbd_outcome {
    FBD_GOING,   /* not at the end yet */
    FBD_DONE,    /* reached the end time */
    FBD_STOPPED, /* a user event said stop */
    FBD_BROKEN,  /* an assumption of the scene broke: contact lost */
    FBD_FAILED, /* step size underflow, a force that is not finite, forces that fight at their thresholds, ...
                 */
    FBD_OUT_OF_MEMORY,
    FBD_INTERRUPTED, /* the progress function of the recording said stop */
} fbd_outcome;

typedef struct fbd_stats {
    const char *method; /* "auto" or the one that was asked for */
    double tolerance;
    unsigned long stiff_steps; /* of these steps, how many the stiff method of "auto" has made */
    unsigned long steps, rejected, rhs, jacobians, events, event_samples;
    double seconds; /* processor time of the run itself */

    /* With error bars. The estimated global error, without a unit: of each coordinate and rate the largest
     * error, over its largest size in the run; of these the largest. NAN without error bars, INFINITY when it
     * is not known. A size counts as at least 1/1000 of the others of the same body and kind (lengths,
     * angles), that of a rate also as 1/1000 of the size of its coordinate over the duration of the run. */
    double error_estimate;
    unsigned long companion_steps, companion_rhs; /* what the estimate has cost */
    double accuracy;                              /* that was asked for, or 0 */
    unsigned long runs;                           /* made to reach it */
    double seconds_spent; /* processor time of all of them, with ledgers, output and companions */

    size_t groups;   /* independent groups of bodies, each integrated by itself */
    size_t linear;   /* of these, how many are linear with constant coefficients and are propagated exactly */
    size_t constant; /* how many have constant accelerations and follow exact parabolas */
    size_t velocity_free; /* how many have forces free of velocity and took a Nystrom method */
} fbd_stats;

typedef struct fbd_simulation fbd_simulation;

/* A simulation at the start of the model; NULL with notes in `errors` (ids `unknown-method`, `bad-option`,
 * `no-end-time`, ...). The model must outlive it. */
FBD_API fbd_simulation *fbd_simulation_new(const fbd_model *model, const fbd_options *options,
                                           fbd_errors *errors);
FBD_API void fbd_simulation_free(fbd_simulation *simulation);

/* A simulation at the start that goes through the very steps of another one, for looking anywhere in a run that
 * is over: at the tolerance that was found where an accuracy was asked for, with error bars or without. NULL
 * with a note in `errors` when memory is out. The other one is not needed any more. */
FBD_API fbd_simulation *fbd_simulation_again(const fbd_simulation *simulation, bool error_bars,
                                             fbd_errors *errors);

/* A simulation that begins at a state, at its time: what sticks, is taut or touches there is found as at the start of
 * a run. The state is copied; its model must outlive the simulation. Where the file asks for an accuracy, the
 * tolerance is the first guess for that. NULL with notes in `errors`: as fbd_simulation_new, and `bad-option` for
 * error bars, an accuracy, or an end before the state. */
FBD_API fbd_simulation *fbd_simulation_from(const fbd_state *state, const fbd_options *options,
                                            fbd_errors *errors);

/* Advance by one accepted step, or to the next event; with independent groups of bodies, by a step of the
 * group that is furthest behind. With options.accuracy this is a run at the tolerance of a first guess: only
 * fbd_simulation_run makes sure. */
FBD_API fbd_outcome fbd_simulation_advance(fbd_simulation *simulation);

/* The interval of the last step, and the state anywhere in it (dense output; modes are those of the step).
 * False for another t or a state of another model. Looking changes nothing in the trajectory. */
FBD_API void fbd_simulation_interval(const fbd_simulation *simulation, double *from, double *to);
FBD_API bool fbd_simulation_state(fbd_simulation *simulation, double t, fbd_state *state);

/* Estimated errors at a time t of the last step, of each coordinate, then of each rate (in the order of
 * fbd_model_coordinate), then of each state of the file's own, in their units: twice fbd_model_coordinate_count and
 * fbd_model_state_count numbers. INFINITY when they are not known. False without error bars, for another t, or when
 * memory is out.
 *
 * They are differences from a second run of the same scene with a smaller tolerance (a fifth, or a fiftieth
 * for other methods than that of `auto`), and steps and events of its own. See docs/error-bars.md. The trajectory is the
 * same, bit by bit, with error bars and without. */
FBD_API bool fbd_simulation_errors(fbd_simulation *simulation, double t, double *errors);

FBD_API size_t fbd_simulation_event_count(const fbd_simulation *simulation);
/* Event `index`, in the order of time; `name` and `detail` live as long as the simulation. */
FBD_API fbd_event fbd_simulation_event(fbd_simulation *simulation, size_t index);
FBD_API fbd_stats fbd_simulation_stats(const fbd_simulation *simulation);

/* How far a run with couplings has been from them at the ends of its steps: the largest violation of a row,
 * in position (lengths; of gears the arc) and in velocity, before the step was brought back and after.
 * `share` is the largest of both over the tolerance times the size of the motion (how far the links are from
 * the origin, how fast they are). */
typedef struct fbd_drift {
    size_t rows; /* of couplings; 0 without, and then all is 0 */
    double position, velocity, share;
    double left_position, left_velocity, left_share;
    const char *worst; /* the row that was off the most, "knuckle in x"; "" without */
} fbd_drift;

FBD_API fbd_drift fbd_simulation_drift(const fbd_simulation *simulation);

/* Why it ended: one sentence with time, body, quantity and what to try; "" while all is well. */
FBD_API const char *fbd_simulation_reason(const fbd_simulation *simulation);

/* Does the energy show that the motion is that of the scene, from the start to the end of the last step? As
 * fbd_result_balanced where nothing is recorded: no works are integrated, so the whole balance is looked at for bodies whose
 * forces all have potentials, and for others what impacts take. To be asked from time to time while a run is advanced, and at
 * its end: a call costs about a right-hand side. */
FBD_API bool fbd_simulation_balanced(fbd_simulation *simulation, double *residual, double *explained);

/* When it was refused at its start, as fbd_state_close refuses it: that reason as a note in `errors`, with
 * the id and the place in the file. False, and nothing noted, when it was not. */
FBD_API bool fbd_simulation_blame(const fbd_simulation *simulation, fbd_errors *errors);

/* ---------------------------------------------------------------- recording a whole run */

typedef struct fbd_recording {
    size_t size;    /* sizeof(fbd_recording), or 0 */
    double every;   /* output interval; 0 for the file's, else 1/500 of the run */
    bool ledger;    /* with a column for each force and its work, and for the energies */
    fbd_write *csv; /* where CSV goes, or NULL; refusing it fails the run */
    void *csv_context;
    bool motion_only; /* the work of forces without a potential is not integrated: what would be asked of it
                         is NAN. Nothing else changes; `ledger` and `keep` win. */
    bool keep;        /* keep what fbd_result_html and fbd_result_gnuplot show: some 50 MB at most, or 256
                         rows where a row has more than 16 000 numbers */
    fbd_watch *progress; /* told after every step, so it must be quick; or NULL. Ending the run there gives
                            FBD_INTERRUPTED and all outputs complete up to that time */
    void *progress_context;
    bool table;      /* keep the rows that CSV has as numbers, see fbd_result_table; 8 bytes each */
    bool components; /* where forces are shown: also their components, and moments about the centre of mass */
    unsigned
        rows; /* of `keep`: at least so many at regular times; 0 for 2000, which play smoothly at any zoom */
    bool
        degrees; /* CSV, table, report, JSON, page and plots show angles and their rates in degrees: of coordinates, of
                     what `assemble` has decided, and their errors. Equations hold in radians */
} fbd_recording;

/* A column of the rows of a run: "t", "block.x", with error bars "block.x ±" beside it; and its unit. */
typedef struct fbd_column {
    const char *name, *unit;
} fbd_column;

/* The rows of a run: what CSV has, to the last bit. */
typedef struct fbd_table {
    size_t rows, columns;
    const fbd_column *heads; /* of each column */
    const double *values;    /* rows x columns, row by row; INFINITY for an error that is not known */
} fbd_table;

/* Energies of the scene, in its units of energy. work: what the forces without a potential have done since
 * the start; residual: change of kinetic + potential - work. */
typedef struct fbd_energy {
    double kinetic, potential, work, residual;
    double initial_kinetic, initial_potential;
} fbd_energy;

/* A run from start to end, with its ledger (without it where only the motion was wanted). */
typedef struct fbd_result fbd_result;

/* Carry a simulation from its start to its end. With options.accuracy the run is repeated with smaller
 * tolerances until the estimated global error (fbd_stats.error_estimate) is at most that, or until rounding
 * keeps it from getting better: then the best one stands, and fbd_result_accurate is false. So it is when the
 * progress function ends the search: the best run that came to its end stands, or the first one as far as it
 * came. Only that run is recorded. NULL when memory is out, the writer refuses, or the simulation has been
 * advanced already (the ledger has to see every step). The simulation must outlive the result. */
FBD_API fbd_result *fbd_simulation_run(fbd_simulation *simulation, const fbd_recording *recording);
FBD_API void fbd_result_free(fbd_result *result);

/* The rows of a run that was recorded with `table`; without it there are no rows and columns. Lives as long as
 * the result. */
FBD_API fbd_table fbd_result_table(const fbd_result *result);

FBD_API fbd_outcome fbd_result_outcome(const fbd_result *result);
FBD_API fbd_state *fbd_result_state(fbd_result *result); /* the last good state; owned by the result */
FBD_API fbd_energy fbd_result_energy(fbd_result *result);

/* How large a residual of the energy [the scene's unit of energy] the tolerance and rounding explain. Where it is larger
 * the motion is not that of the scene, whatever its steps say of their errors: they have gone over pulses that are much
 * shorter than they are (not all of them show there). INFINITY for steps of fixed size, NAN where only the motion was
 * wanted. */
FBD_API double fbd_result_residual_explained(fbd_result *result);

/* Does the energy show that the motion is that of the scene? Looked at in every run, whatever is wanted of it: where kinetic
 * energy changes at events, by the work of the impacts; from the start to the end of bodies whose forces all have
 * potentials; and of all bodies where the works of all forces are integrated. `residual` and `explained`, which may be
 * NULL: the residual, and the largest one that tolerance and rounding explain [the scene's unit of energy]. */
FBD_API bool fbd_result_balanced(fbd_result *result, double *residual, double *explained);

/* The work that a force or moment of a body has done since the start; NAN when there is no such name. */
FBD_API double fbd_result_work(fbd_result *result, const char *body, const char *load);

/* Estimated errors at the end of the run; INFINITY when they are not known, NAN without error bars or for a
 * name that does not exist. Of "block.x" or "block.v"; of energies (of the initial ones: 0); of a
 * work. */
FBD_API double fbd_result_error(fbd_result *result, const char *name);
FBD_API fbd_energy fbd_result_energy_error(fbd_result *result);
FBD_API double fbd_result_work_error(fbd_result *result, const char *body, const char *load);

/* As fbd_diagram at the end of the run, with the estimated errors of fx, fy, x, y, couple, moment and power.
 * 0 without error bars. */
FBD_API size_t fbd_result_force_errors(fbd_result *result, size_t body, fbd_arrow *arrows, size_t room);

/* False when options.accuracy, or the file, asked for an accuracy that the estimated global error exceeds, or
 * that nothing can be said of because the run failed or was interrupted. */
FBD_API bool fbd_result_accurate(const fbd_result *result);

/* The same as text, to be freed with fbd_free; NULL when memory is out. Of a scene of more than twelve bodies the report
 * is short: totals, events by their kinds, some of the states, the largest forces; fbd_result_report_full has all. */
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

/* Does the model have all these columns? False with notes in `errors`. */
FBD_API bool fbd_model_has_columns(const fbd_model *model, const char *columns, fbd_errors *errors);

/* The model language as JSON Schema (draft 07), for editors and other programs: keys, kinds, words and types with what
 * they mean. To be freed with fbd_free; NULL when memory is out. */
FBD_API char *fbd_schema(void);

/* Was the library built with the page (it needs a library for its plots)? */
FBD_API bool fbd_has_html(void);

/* One self-contained HTML page (UTF-8) that plays the run, with plots, equations and ledger at every time; at
 * most some 5 MB however long the run is. NULL with a note in `errors`: `no-page` where the library was built
 * without it, `not-recorded` for a run without `keep`, or memory is out. */
FBD_API char *fbd_result_html(fbd_result *result, fbd_errors *errors);

/* The scene as one C program for GSL, without allocation of its own and with the file's numbers in a structure: what
 * docs/emit-c.md says. Until when and how accurately its `main` integrates is in `options` (may be NULL; only `until`
 * and `tolerance` are used). To be freed with fbd_free. NULL with notes in `errors`: `cannot-emit` for what it cannot
 * write, `no-end-time`, `bad-option`, or memory is out. */
FBD_API char *fbd_emit_c(const fbd_model *model, const fbd_options *options, fbd_errors *errors);

/* ---------------------------------------------------------------- looking at a model */

/* The assembled equations, term by term, as text. To be freed with fbd_free, as all texts below; NULL when
 * memory is out. */
FBD_API char *fbd_equations_text(fbd_state *state);
FBD_API char *fbd_equations_text_components(fbd_state *state); /* of fbd_assemble_components */

/* The equations of every body cut free in symbols of the scene, reactions and all, a line each, with the acceleration of G where
 * that follows from the coordinates. */
FBD_API char *fbd_equations_symbols(fbd_state *state);

/* The same as LaTeX (amsmath), each equation in symbols of the scene and with the state's numbers; of joined bodies also those
 * cut free. */
FBD_API char *fbd_equations_latex(fbd_state *state);
FBD_API char *fbd_equations_latex_components(fbd_state *state);

/* The same, and the free-body diagrams, as one JSON object. */
FBD_API char *fbd_equations_json(fbd_state *state);
FBD_API char *fbd_equations_json_components(fbd_state *state);

/* The plan in words: effects that are simulated, with their number and why they are conservative or not,
 * those that are not and what would have to be listed, the right-hand side, events, structure, the method and
 * why. */
FBD_API char *fbd_explain(const fbd_model *model, const fbd_options *options);

/* Linearisation about an equilibrium. */
typedef struct fbd_linearization fbd_linearization;

/* Find the equilibrium near `state` (GSL's hybrid Newton method on the accelerations, rates zero), take the
 * exact Jacobian and its eigenvalues. NULL with a note in `errors` when there is none near
 * (`no-equilibrium`), a user state never rests (`not-at-rest`), friction holds a body (`sticks`), a motion is
 * prescribed as a function of the time or the couplings are in a singular position (`not-independent`), or a
 * contact or friction is at its limit (`at-limit`). Forces whose slope vanishes at the equilibrium are noted
 * (`degenerate-equilibrium`, a warning); their rows of A are zero. `state` is moved to the equilibrium. */
FBD_API fbd_linearization *fbd_linearize(fbd_state *state, fbd_errors *errors);
FBD_API void fbd_linearization_free(fbd_linearization *linearization);

/* The system matrix A of x' = A x, x = (q - q0, v, z - z0) of the independent coordinates q and the states z of the
 * file's own, row by row, size x size; size is twice the number of the former, which without couplings is that of all
 * coordinates, and once that of the latter. */
FBD_API size_t fbd_linearization_size(const fbd_linearization *linearization);
FBD_API const double *fbd_linearization_matrix(const fbd_linearization *linearization);

/* Which coordinate of the model (fbd_model_coordinate) is independent coordinate `index`; (size_t)-1 past the
 * last one. With couplings the others follow these, to the first order. */
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

/* Move `state` to an equilibrium: to where the scene comes to rest when it is let down slowly from there
 * (downhill in the sense of the masses, couplings kept), or, where that has no end because forces have no
 * potential or the file has states of its own, to the balance nearest to it. Rates become zero, those of states too. False with a note in `errors` when none was
 * found (`no-equilibrium`), dry friction of a slide or a bearing holds in a range of places (`sticks`), or a
 * motion is prescribed as a function of the time (`not-independent`); the state is then anywhere. An unstable one is
 * noted (`unstable-equilibrium`, a warning). */
FBD_API bool fbd_find_equilibrium(fbd_state *state, fbd_errors *errors);

/* The scene at rest where it is, with every reaction. */
typedef struct fbd_statics fbd_statics;

/* Find the reactions (joints, couplings, normal forces, friction that sticks, drives) that hold every body of
 * `state` at rest: sum of forces and sum of moments zero for each; rates count as zero, friction is within
 * mu_s N where its surface does not move, normal forces and ropes do not pull and push. The state is not
 * changed. Where equilibrium alone does not determine the reactions, those of the least sum of squares are
 * taken (of all in joints and couplings, each once, within their limits; couples over the largest arm), with
 * a warning `indeterminate`. NULL with a note in `errors`: `does-not-fit` (a coupling), `unsettled`, or
 * memory is out. The model must outlive the result. */
FBD_API fbd_statics *fbd_statics_new(const fbd_state *state, fbd_errors *errors);
FBD_API void fbd_statics_free(fbd_statics *statics);

/* Is it in equilibrium: to 2e-6 of the largest load, and within the limits of friction, contact and ropes? */
FBD_API bool fbd_statics_holds(const fbd_statics *statics);

/* How many reactions more than equations there are, and how many ways to move the supports leave. */
FBD_API size_t fbd_statics_indeterminacy(const fbd_statics *statics);
FBD_API size_t fbd_statics_mobility(const fbd_statics *statics);

/* The reactions that equilibrium does not determine, "beam.pin in x"; NULL past the end. */
FBD_API size_t fbd_statics_undetermined_count(const fbd_statics *statics);
FBD_API const char *fbd_statics_undetermined(const fbd_statics *statics, size_t index);

/* What would hold a scene that moves: a force (moment) along a coordinate. With `alone` any one of them does,
 * else they do together. */
typedef struct fbd_unbalanced {
    const char *coordinate, *unit; /* "crank.theta", "N*m" */
    double holding;
    bool alone;
} fbd_unbalanced;

FBD_API size_t fbd_statics_unbalanced_count(const fbd_statics *statics);
FBD_API fbd_unbalanced fbd_statics_unbalanced(const fbd_statics *statics, size_t index);

typedef enum fbd_limit_kind {
    FBD_LIMIT_NORMAL,   /* needed >= 0: a surface does not pull */
    FBD_LIMIT_FRICTION, /* needed <= limit = mu_s N, or the static moment of a bearing */
    FBD_LIMIT_ROPE,     /* needed >= 0: a rope does not push */
} fbd_limit_kind;

/* What a surface, a friction or a rope has to bear, and whether it does. */
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

/* As text (what holds, or why not, and a table for each body), and as one JSON object; NULL when memory is
 * out. */
FBD_API char *fbd_statics_text(const fbd_statics *statics);
FBD_API char *fbd_statics_json(const fbd_statics *statics);

/* Hold every `hand:` derivation of the model against the assembly at many random admissible states (and
 * parameters; the seed is printed), lines of energy and momentum against one run of the model. A text that says yes, or by how much and in which term each differs; *differing
 * (may be NULL) is the number of equations that do. NULL when memory is out. */
FBD_API char *fbd_check_hand(const fbd_model *model, unsigned seed, size_t *differing);

/* ---------------------------------------------------------------- sweeps */

/* One model under many values of its parameters. */
typedef struct fbd_sweep fbd_sweep;

/* What varies, and what is noted of each run.
 *
 * A text of `vary` is NAME=VALUES or several of them with `;` between, which go side by side. VALUES is a
 * grid "0.1:0.6:51" (start, stop, how many; with ":log" behind it each is the same multiple of the one
 * before), a list "1,2,5" or random draws "uniform(1,2):100", "normal(3,0.1):100", "loguniform(1,100):100"; a
 * number may have a unit, which holds for all of them: "0:90 deg:10". The texts are combined, each value with
 * each, the last changing fastest; with `zip` all go side by side.
 *
 * A text of `outputs` holds names with commas between: t, coordinates and rates ("block.x") at the end of the
 * run; min(block.x), max(block.x); time(NAME) and count(NAME) of an event of the file, a kind of event or
 * BODY.KIND; energy.kinetic and its like; block.friction.work; steps, rhs; and the groups final, times,
 * energy. Without any: final, times. */
typedef struct fbd_sweep_plan {
    size_t size; /* sizeof(fbd_sweep_plan), or 0 */
    const char *const *vary;
    size_t vary_count;
    bool zip;
    unsigned long seed; /* of the draws: draw i of a parameter depends on the seed, its name and i alone */
    const fbd_setting *settings; /* parameters that are set and do not vary */
    size_t setting_count;
    const char *const *outputs;
    size_t output_count;
    const fbd_options *run; /* NULL for the file's; without error bars and accuracy: a row is one run */
    bool degrees; /* what is noted of angles and their rates is in degrees; what varies is as given */
} fbd_sweep_plan;

/* Read a model file ("-" is standard input) or a text, for a sweep. NULL with notes in `errors`: those of a
 * wrong file or option (see fbd_model_read, fbd_simulation_new), and `bad-vary`, `unknown-parameter`,
 * `varied-twice`, `unknown-output`. The file must be right with its own values. */
FBD_API fbd_sweep *fbd_sweep_read(const char *path, const fbd_sweep_plan *plan, fbd_errors *errors);
FBD_API fbd_sweep *fbd_sweep_parse(const char *text, size_t length, const char *name,
                                   const fbd_sweep_plan *plan, fbd_errors *errors);
FBD_API void fbd_sweep_free(fbd_sweep *sweep);

/* How many runs it has. */
FBD_API size_t fbd_sweep_run_count(const fbd_sweep *sweep);

/* The header line of its table, and a text that says all that the rows depend on: two sweeps with equal keys
 * have equal rows. Both live as long as the sweep. */
FBD_API const char *fbd_sweep_header(const fbd_sweep *sweep);
FBD_API const char *fbd_sweep_key(const fbd_sweep *sweep);

/* The text of the model file, for another process. */
FBD_API const char *fbd_sweep_source(const fbd_sweep *sweep, size_t *length);

/* How far it is. */
typedef struct fbd_sweep_counts {
    size_t written; /* rows written by this call */
    size_t failed;  /* runs among them that came to no good end */
} fbd_sweep_counts;

/* How the rows of the runs `first` (from 0) to before `end` are made. Rows have the columns of the header;
 * the first is the number of the run, from 1; the last three are the number of events, the status (done,
 * stopped, broken, failed, or wrong: a scene that cannot be) and the reason. A field without a value is
 * empty. Rows are written in order, whole lines, and do not depend on the number of workers. Memory does not
 * grow with the number of runs. */
typedef struct fbd_sweep_work {
    size_t size; /* sizeof(fbd_sweep_work), or 0 */
    size_t first, end;
    size_t jobs;      /* threads; 0: as many as there are processors */
    fbd_write *write; /* takes the rows; called by one thread at a time, as is `progress` */
    void *write_context;
    fbd_watch *progress; /* told when rows have been written; or NULL */
    void *progress_context;
    fbd_stop *stop; /* asked by every thread in each step; or NULL */
    void *stop_context;
} fbd_sweep_work;

typedef enum fbd_sweep_end {
    FBD_SWEEP_DONE,
    FBD_SWEEP_STOPPED, /* `stop` or `progress` said so; whole rows up to some run were written */
    FBD_SWEEP_REFUSED, /* `write` said so, or is not there */
    FBD_SWEEP_OUT_OF_MEMORY,
} fbd_sweep_end;

/* Make the rows and wait for them. *counts (may be NULL) is how many. */
FBD_API fbd_sweep_end fbd_sweep_run(const fbd_sweep *sweep, const fbd_sweep_work *work,
                                    fbd_sweep_counts *counts);

/* ---------------------------------------------------------------- what accuracy costs */

typedef struct fbd_cost_options {
    size_t size;   /* sizeof(fbd_cost_options), or 0 */
    double until;  /* end of the run; NAN for the file's */
    double budget; /* seconds that all may take, of processor time where others use it too; 0: 6 s */
    const char *const *methods; /* names; NULL for all */
    size_t method_count;
    const char *const *quantities; /* coordinates and rates whose error counts, qualified; NULL for all */
    size_t quantity_count;
    bool fixed_steps;    /* ladders of fixed steps (one-step methods) in place of tolerances */
    fbd_watch *progress; /* told now and then, or NULL; ends the study with the note `stopped` */
    void *progress_context;
} fbd_cost_options;

#define FBD_COST_OPTIONS_DEFAULT                                                                             \
    {                                                                                                        \
        sizeof(fbd_cost_options), NAN, 0, NULL, 0, NULL, 0, false, NULL, NULL                                \
    }
FBD_API void fbd_cost_options_init(fbd_cost_options *options, size_t size);

typedef enum fbd_point_state {
    FBD_POINT_MEASURED,
    FBD_POINT_FAILED,  /* the run failed, or ended otherwise than the reference; `reason` says how */
    FBD_POINT_SKIPPED, /* it would take too long for the budget */
} fbd_point_state;

/* One method with one setting on the scene: what error is left, and what it costs. */
typedef struct fbd_point {
    const char *method;
    double tolerance, step; /* one of the two; the other is 0 */
    fbd_point_state state;
    const char *reason; /* "" when measured */

    /* True global errors: the largest |error| / scale over all quantities that count; over the run (at 241
     * times) and at its end. The scale of a quantity is its largest magnitude over the run. */
    double error, error_end;
    const char *worst;  /* the quantity of `error` */
    bool floor;         /* no more than what the reference itself is in doubt by */
    double event_error; /* largest error of an event's time; NAN without events, or with others */
    bool same_events;   /* as many as the reference has, of the same kinds, in the same order */

    double seconds, low, high; /* of one run without output: median and quartiles */
    unsigned repeats;
    fbd_stats stats;
    bool front; /* no other point is both more accurate and cheaper */
} fbd_point;

/* What the errors are measured against: lib/study/reference.h. */
typedef struct fbd_reference {
    const char *says;          /* one or more sentences */
    const char *method[2];     /* the pair of runs that agree best, ... */
    double tolerance[2];       /* ... and their tolerances */
    bool exact, exact_differs; /* from `exact:` of the file; that is not the solution of the scene */
    double floor, floor_end;   /* what the reference is in doubt by (scaled) */
    double until, known;       /* the end of the run; up to when the reference is known to 1e-6 */
    bool complete;             /* it is known to the end */
    double tenfold;            /* time in which differences grow tenfold, or NAN */
} fbd_reference;

/* All points of one method. */
typedef struct fbd_series {
    const char *method;
    bool fixed;          /* a ladder of steps, not of tolerances */
    size_t first, count; /* its points, from loose to tight */
    double order;        /* p in error ~ (mean step)^p by least squares; NAN when too few points tell */
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

/* The cheapest point whose error over the run is at most `error`, and stays so at all tighter settings of its
 * method; without a method when there is none. Of points that cost the same to 3 %, the default method is taken. */
FBD_API fbd_point fbd_cost_cheapest(const fbd_cost *cost, double error);

/* As text, to be freed with fbd_free; NULL when memory is out. fbd_cost_svg is the work-precision diagram. */
FBD_API char *fbd_cost_text(const fbd_cost *cost);
FBD_API char *fbd_cost_csv(const fbd_cost *cost);
FBD_API char *fbd_cost_json(const fbd_cost *cost);
FBD_API char *fbd_cost_svg(const fbd_cost *cost);

/* ---------------------------------------------------------------- what each effect costs */

/* The scene with one effect left out, beside the scene itself. */
typedef struct fbd_effect {
    const char *body, *name;       /* "block", "friction"; body "" for what is of the whole scene */
    const char *change;            /* "left out", "linear: sin(theta) -> theta", ... */
    const char *reason;            /* why there is no number: what cannot be left out; "" otherwise */
    double change_end, change_max; /* of the answer: |difference| / scale, at the end and over the run */
    const char *worst;             /* the quantity that changes most */
    bool noise;                    /* no more than runs of the scene itself differ by */
    double time;                   /* run time without it / run time of the scene; NAN when not measured */
    long events;                   /* of the run without it, less those of the scene */
} fbd_effect;

typedef struct fbd_effects fbd_effects;

/* Leave out each effect in turn. Of the options `methods`, `quantities` and `fixed_steps` are not used. */
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
    const char *body; /* this body alone; NULL for all */
    bool components;  /* with the components of each force: along x and y, on a slide along and across it */
    bool supports;    /* with the ground, surfaces and bearings that the bodies are cut free from */
    bool symbols;     /* arrows labelled by symbols, m g, N, T_1, instead of names and values */
    bool worksheet;   /* the bodies cut free and no arrows, with lines to write on */
    bool solution;    /* of that worksheet: arrows by symbols, and each symbol's value on its line */
    double
        scale; /* the force, in the scene's unit, that 10 mm stand for; 0: a round one that suits all bodies */
} fbd_drawing;

/* The free-body diagrams of a state as an SVG 1.1 document in millimetres, to be freed with fbd_free. `drawing`
 * may be NULL. Ids are `BODY` for a diagram, `BODY-FORCE` for an arrow (`BODY-FORCE-x`, `-y`, `-n` for
 * components). NULL with a note in `errors` (`unknown-body`, or memory is out). */
FBD_API char *fbd_diagram_svg(fbd_state *state, const fbd_drawing *drawing, fbd_errors *errors);

/* ---------------------------------------------------------------- grading */

/* A teacher's model that answers are held against: its forces, moments and derivations are the right ones, its
 * `grading` says what they are worth. */
typedef struct fbd_key fbd_key;

/* Read a key. NULL with notes in `errors`: those of a wrong model file, and `nothing-to-grade`. */
FBD_API fbd_key *fbd_key_read(const char *path, fbd_errors *errors);

/* The same with values from outside, as of a learning platform that draws its own: they stand in sheets and answers in
 * the place of those of the file, and of what `grading: {draw: ...}` draws. */
FBD_API fbd_key *fbd_key_read_set(const char *path, const fbd_setting *settings, size_t setting_count,
                                  fbd_errors *errors);

/* The same of a text; `name` is what messages call it, or NULL. */
FBD_API fbd_key *fbd_key_parse(const char *text, size_t length, const char *name, const fbd_setting *settings,
                               size_t setting_count, fbd_errors *errors);
FBD_API void fbd_key_free(fbd_key *key);

/* Check a model whose file says `grading` as the key that it is: the notes of fbd_key_read about marks (`key-differs`,
 * `nothing-to-grade`) go to `errors`. True for a key that can be graded, and for every other model; false with a note. */
FBD_API bool fbd_model_check_key(const fbd_model *model, fbd_errors *errors);

/* What a student gets of it, as a model file: the scene without forces, moments, derivations and comments, with the
 * values that `grading: {draw: ...}` draws for the name of this student. To be freed with fbd_free; NULL with a note in
 * `errors` when memory is out. */
FBD_API char *fbd_key_handout(const fbd_key *key, const char *student, fbd_errors *errors);

/* The same sheet filled in: what the key lists, its derivations, the reactions that have to be drawn by their values at the
 * start, and in comments the equations of all bodies. As an answer it gets all points. */
FBD_API char *fbd_key_solution(const fbd_key *key, const char *student, fbd_errors *errors);

typedef enum fbd_finding_kind {
    FBD_FINDING_RIGHT,
    FBD_FINDING_MISSING,     /* a force or moment, or a derivation, is not there */
    FBD_FINDING_SUPERFLUOUS, /* a force or moment is there that nothing exerts */
    FBD_FINDING_PLACE,       /* its line of action is another one */
    FBD_FINDING_DIRECTION,
    FBD_FINDING_SENSE, /* it points the opposite way */
    FBD_FINDING_MAGNITUDE,
    FBD_FINDING_UNIT,            /* its magnitude is off by a factor between units */
    FBD_FINDING_COEFFICIENT,     /* of friction */
    FBD_FINDING_INERTIA,         /* mass, centre of mass or moment of inertia */
    FBD_FINDING_REFERENCE_POINT, /* a moment of inertia is that about another point */
    FBD_FINDING_MOTION,          /* a body moves in another way */
    FBD_FINDING_BODY,            /* a body is not there, or should not be */
    FBD_FINDING_UNREADABLE,      /* something cannot be read */
    FBD_FINDING_DERIVATION,      /* it does not agree with mechanics, or says nothing */
    FBD_FINDING_NO_SUBMISSION,
} fbd_finding_kind;

/* "right", "missing", "superfluous", "place", "direction", "sense", "magnitude", "unit", "coefficient", "inertia",
 * "reference_point", "motion", "body", "unreadable", "derivation", "no_submission"; "" for none of them */
FBD_API const char *fbd_finding_kind_name(fbd_finding_kind kind);

/* One part of an answer. `message` names only what the student wrote, and may be shown; `detail` names the key's. */
typedef struct fbd_finding {
    fbd_finding_kind kind;
    const char *body, *name; /* "" where there is none */
    int line, column;        /* in the answer, 0 when it is not there */
    double points, most;     /* got (below zero: taken off), and to be had */
    const char *message, *detail;
} fbd_finding;

typedef struct fbd_grade fbd_grade;

/* Hold an answer against a key by mechanics. `student` chooses the values that are drawn; NULL takes the name of the
 * file, without folders and `.yaml`. An answer that is not there, or is no model, has no points. NULL with a note in
 * `errors`: a file that is there cannot be read (`cannot-read`), or memory is out. The key must outlive it. */
FBD_API fbd_grade *fbd_grade_new(const fbd_key *key, const char *path, const char *student,
                                 fbd_errors *errors);

/* The same of an answer that is a text. `student` names it in what is written of it. */
FBD_API fbd_grade *fbd_grade_parse(const fbd_key *key, const char *text, size_t length, const char *student,
                                   fbd_errors *errors);
FBD_API void fbd_grade_free(fbd_grade *grade);

/* What was got, at least 0, and what is to be had. */
FBD_API double fbd_grade_points(const fbd_grade *grade);
FBD_API double fbd_grade_most(const fbd_grade *grade);

/* Is there an answer, and are its points enough? */
FBD_API bool fbd_grade_passed(const fbd_grade *grade);

FBD_API size_t fbd_grade_finding_count(const fbd_grade *grade);
FBD_API fbd_finding fbd_grade_finding(const fbd_grade *grade, size_t index);

/* As text, and as one JSON object (docs/grading.md); with `details` those that name the key's forces. To be freed with
 * free(); NULL when memory is out. */
FBD_API char *fbd_grade_text(const fbd_grade *grade, bool details);
FBD_API char *fbd_grade_json(const fbd_grade *grade, bool details);

/* ---------------------------------------------------------------- pages that run */

/* The sheet of a student as one HTML file to draw on: the bodies cut free, forces and moments drawn by mouse, finger or
 * keyboard, derivations as they are typed. What is drawn is saved as the answer that fbd_grade_new reads. With `exam` the
 * page has nothing of the key; without it, it has the key and the library, and grades. To be freed with fbd_free; NULL
 * with a note in `errors`: `no-sheet` (what is left of the key is no model), `not-finite`, `no-live` (without `exam`: not
 * fbd_has_live()), `no-page` (built without pages), or memory is out. */
FBD_API char *fbd_key_page(const fbd_key *key, const char *student, bool exam, fbd_errors *errors);

/* What of the file can be moved by a slider or switched off, and where it stands in the text, as one JSON object
 * (lib/live/controls.c says what is in it). To be freed with fbd_free; NULL with a note in `errors` when memory is out. */
FBD_API char *fbd_model_controls(const fbd_model *model, fbd_errors *errors);

/* The text of the file without some of the effects that it lists: "block.friction", or the name of a coupling or contact.
 * What stands on lines of its own becomes a comment there; so do derivations by hand of the bodies concerned. To be
 * freed with fbd_free; NULL with a note in `errors`: `unknown-effect`, or memory is out. */
FBD_API char *fbd_model_without(const fbd_model *model, const char *const *effects, size_t count,
                                fbd_errors *errors);

/* The notes of a list, as one JSON list of {severity, id, message, hint, line, column}. To be freed with fbd_free; NULL when
 * memory is out. */
FBD_API char *fbd_errors_json(fbd_errors *errors);

/* What a page of --html knows of a run, as one JSON object (lib/draw/page_data.c says what is in it), for a run that was
 * recorded with `keep`. To be freed with fbd_free; NULL with a note in `errors`: `not-recorded`, or memory is out. */
FBD_API char *fbd_result_page_data(fbd_result *result, fbd_errors *errors);

/* Was the library built with what makes a page live: itself as WebAssembly (`make live`)? */
FBD_API bool fbd_has_live(void);

/* What the page begins with, beside the file: how the model was read and run; all may be left out. */
typedef struct fbd_live_options {
    size_t size; /* sizeof(fbd_live_options), or 0 */
    const fbd_setting *settings;
    size_t setting_count;
    const fbd_options *run; /* until, method and tolerance; NULL for the file's */
} fbd_live_options;

/* As fbd_result_html, with the library itself and the text of the model in it: the page has sliders, an editor and
 * checkboxes, and runs anew whenever something moves. At most 2 MB. NULL with a note in `errors`: `no-live` where the
 * library was built without it, `cannot-read` for the data file of a table, and those of fbd_result_html. */
FBD_API char *fbd_result_live_html(fbd_result *result, const fbd_live_options *options, fbd_errors *errors);

/* ---------------------------------------------------------------- models for other simulators */

/* A model as a Functional Mock-up Unit (fmi-standard.org): docs/fmi.md. */
typedef struct fbd_fmu_options {
    size_t size;           /* sizeof(fbd_fmu_options), or 0 */
    int version;           /* of FMI: 3, or 2 for tools that do not know that; 0 is 3 */
    const char *library;   /* the binary that goes in, of this version of fbd, which fbd-run carries ... */
    size_t library_length; /* ... and how many bytes it has */
    const char *name;      /* of the FMU; NULL for that of the model file */
    const fbd_setting *settings; /* those that the model was read with: they become its start values */
    size_t setting_count;
    const fbd_options *run; /* NULL for the file's; without error bars and accuracy */
} fbd_fmu_options;

/* The FMU for co-simulation by that binary as bytes of a zip archive, to be freed with fbd_free; *length is their number.
 * NULL with notes in `errors`: those of wrong options (see fbd_simulation_new), of a start that no motion begins at (see
 * fbd_state_close), `cannot-read` for the data file of a table, `bad-call`, or memory is out. */
FBD_API char *fbd_fmu(const fbd_model *model, const fbd_fmu_options *options, size_t *length,
                      fbd_errors *errors);

FBD_API const char *fbd_version(void);

#ifdef __cplusplus
}
#endif

#endif
