/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_study: equilibria and their linearisation, statics, sweeps over parameters, the costs of accuracy and of effects, and how
 * accurate a run is. The rules of fbd.h apply.
 */
#ifndef FBD_STUDY_H
#define FBD_STUDY_H

#include "fbd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- equilibria */

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

/* The model that was linearized; NULL for NULL. */
FBD_API const fbd_model *fbd_linearization_model(const fbd_linearization *linearization);

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

typedef enum fbd_member_kind { FBD_MEMBER_ROD, FBD_MEMBER_ROPE, FBD_MEMBER_BODY } fbd_member_kind;

/* A rod, a rope (each piece between pulleys), or in equilibrium a body that is loaded at two points only: it carries
 * one force along their line. */
typedef struct fbd_member {
    const char *name;
    fbd_member_kind kind;
    double tension; /* below zero: compression */
} fbd_member;

FBD_API size_t fbd_statics_member_count(const fbd_statics *statics);
FBD_API fbd_member fbd_statics_member(const fbd_statics *statics, size_t index);

/* As fbd_diagram, at rest. */
FBD_API size_t fbd_statics_diagram(const fbd_statics *statics, size_t body, fbd_arrow *arrows, size_t room);

/* As text (whether it is in equilibrium, the reason if not, and a table for each body), and as one JSON
 * object; NULL when memory is out. */
FBD_API char *fbd_statics_text(const fbd_statics *statics);
FBD_API char *fbd_statics_json(const fbd_statics *statics);

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
    const char
        *find;    /* NULL, or a question (fbd_find_parse) for each run instead of outputs: the columns are the
                       * parameter of the question (its first solution), `error`, `solutions` (their number), and
                       * `runs` instead of `events` */
    bool statics; /* of the question, as in fbd_find_plan */
    size_t find_runs;
} fbd_sweep_plan;

/* Read a model file ("-" is standard input) or a text, for a sweep. NULL with notes in `errors`: those of a
 * wrong file or option (see fbd_model_read, fbd_simulation_new), and `bad-vary`, `unknown-parameter`,
 * `varied-twice`, `unknown-output`, and those of a question. The file must be valid with its own values. */
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

/* ---------------------------------------------------------------- methods of integration */

/* A method for fbd_options.method, besides "auto", which chooses among them. */
typedef struct fbd_method {
    const char *name;
    const char *description; /* one line without a full stop; NULL past the end, as the name */
    int order;               /* the highest one of a method of variable order */
    bool implicit;           /* for stiff systems: it needs the Jacobian */
    bool multistep;          /* it uses earlier steps: no steps of fixed size */
} fbd_method;

/* The methods in the order of preference, and the one of a name. Texts are constant. */
FBD_API size_t fbd_method_count(void);
FBD_API fbd_method fbd_method_get(size_t index);
FBD_API fbd_method fbd_method_find(const char *name);

/* ---------------------------------------------------------------- exact solutions */

/* The exact solution that the file gives (`exact`) at a time: the value, and its derivative by time, of quantity
 * `quantity`: coordinate `quantity`, or beyond these the rate of coordinate `quantity` minus their number. That of
 * a rate follows from its coordinate where the file does not give it. Returns false where the file gives none, and
 * where callbacks compute inputs: it holds for their constants. */
FBD_API bool fbd_model_exact(const fbd_model *model, size_t quantity, double t, double *value,
                             double *derivative);

/* ---------------------------------------------------------------- cost of accuracy */

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

/* ---------------------------------------------------------------- simplifications of a scene */

/* A sampled motion of a model: at each time one row of the coordinates, then their rates, then the user states,
 * in the order of the model (2 fbd_model_coordinate_count + fbd_model_state_count numbers). */
typedef struct fbd_motion {
    size_t count;         /* of times and rows; 0 for none */
    const double *t;      /* increasing */
    const double *values; /* row by row */
} fbd_motion;

/* A scene without one of its effects, or with a linear one in its place. */
typedef struct fbd_simplification {
    const char *body, *name; /* "block", "friction"; body "" for an effect of the whole scene */
    const char *change;      /* "left out", "linear: sin(theta) -> theta", ... */
    const char *reason;      /* why that is not possible; "" if it is */
} fbd_simplification;

typedef struct fbd_simplifications fbd_simplifications;

/* List the simplifications of a scene: each force, moment, part and coupling left out, static friction as
 * kinetic, surfaces and air at rest, laws that are not linear in the range of `motion` replaced by linear ones
 * (quadratic drag for its largest speed). `motion` is read during the call only. NULL with a note in `errors`:
 * `bad-call`, or memory is out. The model must outlive the list; texts live as long as the list, and are NULL
 * past the end. */
FBD_API fbd_simplifications *fbd_simplify(const fbd_model *model, const fbd_motion *motion,
                                          fbd_errors *errors);
FBD_API void fbd_simplifications_free(fbd_simplifications *simplifications);
FBD_API size_t fbd_simplifications_count(const fbd_simplifications *simplifications);
FBD_API fbd_simplification fbd_simplifications_get(const fbd_simplifications *simplifications, size_t index);

/* The scene with simplification `index` alone, and the parameter values of the model, to be freed with
 * fbd_model_free. NULL with notes in `errors`: `bad-call` for one that is not possible, those of a scene that is
 * wrong without the effect, or memory is out. */
FBD_API fbd_model *fbd_simplifications_model(const fbd_simplifications *simplifications, size_t index,
                                             fbd_errors *errors);

/* ---------------------------------------------------------------- cost of each effect */

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

/* ---------------------------------------------------------------- accuracy of a run, and states in it */

/* A simulation at the start that repeats the steps of another one, to evaluate states anywhere in a finished
 * run: at the tolerance that was found where an accuracy was requested, with error bars or without. NULL with
 * a note in `errors` when memory is out. The other simulation may be freed. */
FBD_API fbd_simulation *fbd_simulation_again(const fbd_simulation *simulation, bool error_bars,
                                             fbd_errors *errors);

/* Estimated errors at a time t of the last step, of each coordinate, then of each rate (in the order of
 * fbd_model_coordinate), then of each user state, in their units: twice fbd_model_coordinate_count plus
 * fbd_model_state_count numbers. INFINITY when unknown. Returns false without error bars, for another t, or
 * when memory is out.
 *
 * They are differences from a second run of the same scene with a smaller tolerance (1/5; 1/50 for methods
 * other than that of `auto`) and its own steps and events. See docs/error-bars.md. The trajectory is bitwise
 * the same with and without error bars. */
FBD_API bool fbd_simulation_errors(fbd_simulation *simulation, double t, double *errors);

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

/* Check the energy balance from the start to the end of the last step. As fbd_result_balanced without a
 * recording: works are not integrated, so the whole balance is checked for bodies whose forces all have
 * potentials, and for the others the energy lost in impacts. Intended for occasional calls while a run is
 * advanced, and at its end: a call costs about one evaluation of the right-hand side. */
FBD_API bool fbd_simulation_balanced(fbd_simulation *simulation, double *residual, double *explained);

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

/* The redundant coupling rows at the state: rows that follow from the rows before them (parallel rods, a pin
 * in a direction that a slide constrains already), as "knuckle in y". Fills at most `room` names, which live
 * as long as the model; returns their number. */
FBD_API size_t fbd_redundant(fbd_state *state, const char **names, size_t room);

#ifdef __cplusplus
}
#endif

#endif
