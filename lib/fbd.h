/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd: free-body diagrams that run. This header has models, states, equations and runs; fbd_study.h the accuracy of runs and
 * studies of a model, fbd_find.h values of its parameters, fbd_section.h forces inside of bodies, fbd_grade.h derivations and
 * answers, fbd_export.h outputs, fbd_geometry.h bodies, shapes and positions, fbd_view.h all other contents of a model for
 * other programs: drawings, graders, formats; fbd_linear.h linear systems with inputs, fbd_exchange.h integration by other
 * programs, fbd_workers.h sweeps over several processes, fbd_test.h checks for unit tests.
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

/* The correction of an error as an edit: `replace`, which stands at line and column of its file, becomes `with`. */
typedef struct fbd_fix {
    int line, column;           /* from 1, counted in characters */
    const char *replace, *with; /* NULL when no edit is known */
} fbd_fix;

/* The edit that note `index` suggests, with all members 0 where none is known. It is checked against the text of
 * the model: `replace` stands at its position. Its texts live as long as the list. */
FBD_API fbd_fix fbd_errors_fix(fbd_errors *errors, size_t index);

/* File `index` that the calls with this list have read or tried to read: the model file and the data files of
 * its tables; NULL past the last. Standard input is not listed. Lives as long as the list. */
FBD_API size_t fbd_errors_file_count(const fbd_errors *errors);
FBD_API const char *fbd_errors_file(const fbd_errors *errors, size_t index);

/* The section of the guide about errors with this id, as "guide/ten-things.md, 3. The time, or the tonne"; NULL where it has
 * none. Lives for ever. */
FBD_API const char *fbd_errors_guide(const char *id);

/* Write every note as `file:line:col: error: message`, `    hint: ...`, and, at the first note of each section of the guide,
 * `    see: ...`. */
FBD_API void fbd_errors_print(fbd_errors *errors, FILE *stream);

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

/* Read a file as fbd_model_read, for a run: derivations by hand and exact solutions, which the motion does not depend on, are
 * neither read nor checked, except when the file has other errors or warnings. */
FBD_API fbd_model *fbd_model_read_motion(const char *path, const fbd_setting *settings, size_t setting_count,
                                         fbd_errors *errors);
FBD_API void fbd_model_free(fbd_model *model);

/* Computes an input at time `t` [s] and `y`: the coordinates of the model in the order of fbd_model_coordinate, their
 * rates, then the user states, at most 500 numbers in their units; `*value` in the unit of the input. Called in every
 * right-hand side, at times in any order, by the threads of all runs of its model. It must be a function of t and y,
 * smooth between the events of the file: a switch inside is not found, and costs accuracy. Any value but 0, or a
 * `*value` that is not finite, makes the forces not finite, so that the run fails. */
typedef int fbd_force_callback(void *context, double t, const double *y, double *value);

/* `function` NULL: no callback computes the input, but its value is set between steps (fbd_simulation_set_input). */
typedef struct fbd_callback {
    const char *input;
    fbd_force_callback *function;
    void *context; /* must outlive the model and all made from it */
} fbd_callback;

/* The model with the same values, in which callbacks compute some of its `inputs`, for example forces. Derivatives of a
 * callback are central differences. Error bars hold for the callback as it is, called in their second run as well. For
 * such an input fbd_parameter.value is NAN. There are no C program and no derivatives by it. An input without `function`
 * has in each state a value of its own, at first that of the file: fbd_state_set and fbd_state_get name it. NULL with notes in `errors`:
 * `unknown-input`, `bad-call`, or the notes of the file. */
FBD_API fbd_model *fbd_model_with_callbacks(const fbd_model *model, const fbd_callback *callbacks,
                                            size_t count, fbd_errors *errors);

/* The title of the file, "" when it has none. */
FBD_API const char *fbd_model_title(const fbd_model *model);

FBD_API size_t fbd_model_body_count(const fbd_model *model);

/* The name of a body; NULL past the last one. */
FBD_API const char *fbd_model_body_name(const fbd_model *model, size_t body);

/* A coordinate of the scene: q and its rate v. Names are qualified ("block.x", "block.v"); they live as long
 * as the model, and are NULL past the last coordinate. */
typedef struct fbd_coordinate {
    const char *name, *unit, *rate_name, *rate_unit;
    size_t body;
} fbd_coordinate;

FBD_API size_t fbd_model_coordinate_count(const fbd_model *model);
FBD_API fbd_coordinate fbd_model_coordinate(const fbd_model *model, size_t index);

/* ---------------------------------------------------------------- states and assembled equations */

/* Time, coordinates, rates and modes (stick or slip) of one run; used by one thread at a time. */
typedef struct fbd_state fbd_state;

/* A state at the file's initial values and t = 0, with consistent modes. NULL when memory is out. */
FBD_API fbd_state *fbd_state_new(const fbd_model *model);
FBD_API void fbd_state_free(fbd_state *state);

/* Copy `from` into `to`. Returns false when they are not of the same model. */
FBD_API bool fbd_state_copy(fbd_state *to, const fbd_state *from);

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

/* ---------------------------------------------------------------- simulation */

typedef struct fbd_options {
    size_t size;        /* sizeof(fbd_options), or 0 */
    double until;       /* end time; NAN for the file's */
    double tolerance;   /* relative error per step; 0 for the file's, else 1e-10 */
    double step;        /* fixed step size, 0 for automatic or the file's */
    const char *method; /* NULL for the file's, else "auto" */
    bool error_bars;    /* estimate the global errors by a more accurate companion run: fbd_study.h */
    /* global accuracy that fbd_simulation_run must reach, above 0 and at most 0.1; 0 for the file's, if any.
     * Implies error bars, and excludes `tolerance` and `step` */
    double accuracy;
    /* integrate all bodies together by the general method, whatever the structure of the forces */
    bool no_structure;
    bool automatic_step; /* automatic steps even where the file gives a size; `step` takes precedence */
} fbd_options;

/* Options that leave everything to the file, as a macro and as a function for callers that cannot use it;
 * `size` is the caller's sizeof of the struct. */
#define FBD_OPTIONS_DEFAULT                                                                                  \
    {                                                                                                        \
        sizeof(fbd_options), NAN, 0, 0, NULL, false, 0, false, false                                         \
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
    FBD_EVENT_TRACK_END,     /* a body reaches an end of its track: the run ends */
    FBD_EVENT_COUPLING_ENDS, /* the condition of its `until` becomes true */
    /* the condition of its `from` becomes true: a plastic impact, if its ends move relative to each other */
    FBD_EVENT_COUPLING_BEGINS,
    FBD_EVENT_FORCE_ENDS, /* the same of a force or moment */
    FBD_EVENT_FORCE_BEGINS,
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
 * "switch", "impact", "contact", "rest", "sliding", "sliding_ends", "jam", "several", "track_end",
 * "coupling_ends", "coupling_begins", "force_ends", "force_begins"; "" for other values */
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

/* Set an input, from the time `t` of the last step on, to a value in its unit. The integration begins anew at the state of
 * that time: events after it are forgotten, friction, ropes and contacts are decided as at a start, error bars end, and
 * the simulation can be advanced, but not recorded or repeated (fbd_simulation_run, fbd_simulation_again). Statistics are
 * sums, and fbd_simulation_balanced is of the worst part. The value that the input has already changes nothing. The input
 * is one without `function` of fbd_model_with_callbacks; the file is not compiled. Returns false with notes in `errors`
 * and no change: `unknown-input`; `fixed-input` for a constant of the model, or one that a callback computes; `bad-call`
 * for a value that is not finite, a time outside the last step, or a motion that has ended; or the id of
 * fbd_state_close, where no motion continues with this value. */
FBD_API bool fbd_simulation_set_input(fbd_simulation *simulation, double t, const char *name, double value,
                                      fbd_errors *errors);

FBD_API size_t fbd_simulation_event_count(const fbd_simulation *simulation);
/* Event `index`, in the order of time; `name` and `detail` live as long as the simulation. */
FBD_API fbd_event fbd_simulation_event(fbd_simulation *simulation, size_t index);
FBD_API fbd_stats fbd_simulation_stats(const fbd_simulation *simulation);

/* The reason of the end: one sentence with time, body, quantity and a suggestion; "" without an error. */
FBD_API const char *fbd_simulation_reason(const fbd_simulation *simulation);

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

FBD_API fbd_outcome fbd_result_outcome(const fbd_result *result);
FBD_API fbd_state *fbd_result_state(fbd_result *result); /* the last valid state; owned by the result */
FBD_API fbd_energy fbd_result_energy(fbd_result *result);

/* The work of a force or moment on a body since the start; NAN when there is no such name. */
FBD_API double fbd_result_work(fbd_result *result, const char *body, const char *load);

FBD_API const char *fbd_version(void);

#ifdef __cplusplus
}
#endif

#endif
