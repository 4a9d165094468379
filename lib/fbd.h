/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd: free-body diagrams that run. The one public header.
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

/* ---------------------------------------------------------------- errors */

typedef enum fbd_severity {
    FBD_ERROR,
    FBD_WARNING,
} fbd_severity;

/* One thing that is wrong with a model file. Lines and columns are 1-based; 0 means that none is known. */
typedef struct fbd_error {
    fbd_severity severity;
    const char *id;      /* stable, for programs: "unknown-key", "wrong-dimension", ... */
    const char *message; /* what is wrong, one line */
    const char *hint;    /* what to write instead, or NULL */
    const char *file;
    int line, column;                 /* where it is wrong */
    int context_line, context_column; /* what was being read there, 0 when that adds nothing */
} fbd_error;

/* A list of them, owned by the caller. One list serves one thread. */
typedef struct fbd_errors fbd_errors;

/* An empty list, or NULL when memory is out. */
FBD_API fbd_errors *fbd_errors_new(void);
FBD_API void fbd_errors_free(fbd_errors *errors);

/* How many notes there are, and how many of them are errors (not warnings). */
FBD_API size_t fbd_errors_count(const fbd_errors *errors);
FBD_API size_t fbd_errors_failed(const fbd_errors *errors);

/* Note `index` in the order of position in the file, or NULL past the end; lives as long as the list. */
FBD_API const fbd_error *fbd_errors_get(fbd_errors *errors, size_t index);

/* Write every note as `file:line:col: error: message` and `    hint: ...`. */
FBD_API void fbd_errors_print(fbd_errors *errors, FILE *stream);

/* ---------------------------------------------------------------- models */

/* A scene compiled: constant after it is made, and shareable by threads. */
typedef struct fbd_model fbd_model;

/* A parameter of the file set from outside; `value` is text as in the file ("50", "50 N", "2*f0"). */
typedef struct fbd_setting {
    const char *name, *value;
} fbd_setting;

/* Read and compile a model file ("-" is standard input) or a text. NULL with notes in `errors` when it is
 * wrong or cannot be read (id `cannot-read`); a model may come with warnings. The model is the caller's, to
 * be freed with fbd_model_free. */
FBD_API fbd_model *fbd_model_read(const char *path, const fbd_setting *settings, size_t setting_count,
                                  fbd_errors *errors);
FBD_API fbd_model *fbd_model_parse(const char *text, size_t length, const char *name,
                                   const fbd_setting *settings, size_t setting_count, fbd_errors *errors);
FBD_API void fbd_model_free(fbd_model *model);

/* The title of the file, "" when it has none. */
FBD_API const char *fbd_model_title(const fbd_model *model);

FBD_API size_t fbd_model_bodies(const fbd_model *model);
FBD_API const char *fbd_model_body_name(const fbd_model *model, size_t body);

/* What a body weighs and how it turns, in the model's units; I_O and L are 0 but for a pivot (about its axis;
 * distance from the axis O to the centre of mass G). */
typedef struct fbd_inertia {
    double mass, I_G, I_O, L;
    double G[2]; /* centre of mass in the body frame */
} fbd_inertia;

FBD_API fbd_inertia fbd_model_inertia(const fbd_model *model, size_t body);

/* A coordinate of the scene: q and its rate v. Names are qualified ("block.x", "block.v"); they live as long
 * as the model. */
typedef struct fbd_coordinate {
    const char *name, *unit, *rate_name, *rate_unit;
    size_t body;
} fbd_coordinate;

FBD_API size_t fbd_model_coordinates(const fbd_model *model);
FBD_API fbd_coordinate fbd_model_coordinate(const fbd_model *model, size_t index);

/* ---------------------------------------------------------------- states and assembled equations */

/* Time, coordinates, rates and modes (stick or slip) of one run; belongs to one thread. */
typedef struct fbd_state fbd_state;

/* A state at the file's initial values and t = 0, modes settled. NULL when memory is out. */
FBD_API fbd_state *fbd_state_new(const fbd_model *model);
FBD_API void fbd_state_free(fbd_state *state);

/* Set or get "t", "body.coordinate" or "body.rate" ("block.x", "pendulum.omega"). False for an unknown name
 * or a value that is not finite. Modes are settled anew by the next call that needs them, as at the start of
 * a run. */
FBD_API bool fbd_state_set(fbd_state *state, const char *name, double value);
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

/* Assemble all equations at a state; NULL when memory is out. */
FBD_API fbd_equations *fbd_assemble(fbd_state *state);
FBD_API void fbd_equations_free(fbd_equations *equations);
FBD_API size_t fbd_equations_count(const fbd_equations *equations);
FBD_API const fbd_equation *fbd_equations_get(const fbd_equations *equations, size_t index);

/* The equation of "block.x", or NULL; and the value of one of its terms, NAN when there is no such term. */
FBD_API const fbd_equation *fbd_equations_find(const fbd_equations *equations, const char *coordinate);
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

/* Fill at most `room` arrows of a body, reactions included; returns how many there are. */
FBD_API size_t fbd_diagram(fbd_state *state, size_t body, fbd_arrow *arrows, size_t room);

/* ---------------------------------------------------------------- simulation */

typedef struct fbd_options {
    double until;       /* end time; NAN for the file's */
    double tolerance;   /* relative error per step; 0 for the file's, else 1e-9 */
    double step;        /* fixed step size, 0 for automatic or the file's */
    const char *method; /* NULL for the file's, else "dop853" */
} fbd_options;

/* Options that leave everything to the file. */
#define FBD_OPTIONS_DEFAULT                                                                                  \
    {                                                                                                        \
        NAN, 0, 0, NULL                                                                                      \
    }

typedef enum fbd_event_kind {
    FBD_EVENT_BREAKAWAY,    /* a sticking body starts to slip */
    FBD_EVENT_STICK,        /* a slipping body comes to rest on its surface and stays */
    FBD_EVENT_REVERSAL,     /* a slipping body stops and slips back at once */
    FBD_EVENT_CONTACT_LOST, /* a normal force reaches zero: the run ends, since the scene is no longer true */
    FBD_EVENT_USER,         /* an event of the file */
    FBD_EVENT_SWITCH,       /* an expression passes from one branch to another (step, abs, if, ...) */
} fbd_event_kind;

typedef struct fbd_event {
    double t;
    fbd_event_kind kind;
    const char *body; /* "" for a user event */
    const char *name; /* of the user event or of the load */
    const char *detail;
} fbd_event;

/* "breakaway", "stick", "reversal", "contact_lost", "user", "switch" */
FBD_API const char *fbd_event_kind_name(fbd_event_kind kind);

typedef enum fbd_outcome {
    FBD_GOING,   /* not at the end yet */
    FBD_DONE,    /* reached the end time */
    FBD_STOPPED, /* a user event said stop */
    FBD_BROKEN,  /* an assumption of the scene broke: contact lost */
    FBD_FAILED, /* step size underflow, a force that is not finite, forces that fight at their thresholds, ...
                 */
    FBD_OUT_OF_MEMORY,
} fbd_outcome;

typedef struct fbd_stats {
    const char *method;
    double tolerance;
    unsigned long steps, rejected, rhs, jacobians, events, event_samples;
    double seconds; /* processor time of the run itself */
} fbd_stats;

typedef struct fbd_simulation fbd_simulation;

/* A simulation at the start of the model; NULL with notes in `errors` (ids `unknown-method`, `bad-option`,
 * `no-end-time`, ...). The model must outlive it. */
FBD_API fbd_simulation *fbd_simulation_new(const fbd_model *model, const fbd_options *options,
                                           fbd_errors *errors);
FBD_API void fbd_simulation_free(fbd_simulation *simulation);

/* Advance by one accepted step, or to the next event. */
FBD_API fbd_outcome fbd_simulation_advance(fbd_simulation *simulation);

/* The interval of the last step, and the state anywhere in it (dense output; modes are those of the step).
 * The state must belong to the same model. Looking changes nothing in the trajectory. */
FBD_API void fbd_simulation_interval(const fbd_simulation *simulation, double *from, double *to);
FBD_API bool fbd_simulation_state(fbd_simulation *simulation, double t, fbd_state *state);

FBD_API size_t fbd_simulation_events(const fbd_simulation *simulation);
FBD_API fbd_event fbd_simulation_event(const fbd_simulation *simulation, size_t index);
FBD_API fbd_stats fbd_simulation_stats(const fbd_simulation *simulation);

/* Why it ended: one sentence with time, body, quantity and what to try; "" while all is well. */
FBD_API const char *fbd_simulation_reason(const fbd_simulation *simulation);

#ifdef __cplusplus
}
#endif

#endif
