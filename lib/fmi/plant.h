/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plant: the motion of an instance of an FMU, independent of the version of the standard.
 *
 * Inputs are constant between communication points. Until one changes they are constants of the model, as in fbd-run. At the
 * first change a model is compiled whose states hold them; it serves all further changes, at each of which a new simulation
 * starts from the present state.
 *
 * A simulation takes the steps of fbd-run, beyond the communication point, and is interpolated there. So it
 * does not depend on the communication points. The saved state of a plant is the start of its simulation and
 * the present time: a restored plant repeats the same steps, with bitwise the same result.
 */
#ifndef FBD_FMI_PLANT_H
#define FBD_FMI_PLANT_H

#include "fmi/extra.h"
#include "fmi/package.h"

/* The reason where a model that holds its inputs has other numbers. */
extern const char plant_no_held_inputs[];

enum plant_step {
    plant_arrived, /* at the target */
    plant_event,   /* at an event, before or at the target */
    plant_stopped, /* at an event of the file that ends the run */
    plant_failed,  /* reason in plant->reason */
};

/* The start of a simulation. Values are those of all parameters and inputs. */
struct plant_base {
    bool of_file;    /* at the start of the file, at t = 0 */
    double until;    /* end time of the simulation */
    double *values;  /* parameter_count */
    double *works;   /* plant_work_count: up to there */
    double *numbers; /* number_count: the state (fbd_state_pack), unless of_file */
    size_t number_count;
};

struct plant {
    char *text, *path, *settings_text;
    size_t length;
    struct package_settings settings;
    fbd_model *first;     /* by the file and its settings only: source of the variables */
    struct extras extras; /* of it: variables after those */
    size_t variable_count;
    size_t parameter_count; /* number of parameters and inputs */
    double *values;         /* present values */
    char token[package_token_size];

    bool running;       /* it has been initialized */
    double start, stop; /* stop is NAN if not given */
    double t;
    double tolerance; /* requested; 0 if not given */
    struct plant_base base;
    fbd_model *model;  /* with the parameters of the base; NULL if not compiled yet */
    bool holds_inputs; /* its inputs belong to states; else they are constants, those of the base */
    /* if they are constants: a model of the same values whose states hold them, for derivatives, and the state there;
     * NULL: not needed yet */
    fbd_model *held;
    fbd_state *held_state;
    fbd_simulation *simulation;
    fbd_state *state;           /* at t */
    fbd_force_columns *columns; /* of the model; NULL: not needed yet */
    size_t column_count;
    double *shown, *pulls;    /* values in the state: variable_count; column_count ... */
    bool is_shown, is_pulled; /* ... if they have been computed */
    const char *reason;       /* reason of a failure */
    char own_reason[400];
};

/* Open the folder `resources` of an unpacked FMU, before its start. NULL with notes in `errors`. */
struct plant *plant_open(const char *resources, fbd_errors *errors);
void plant_close(struct plant *plant);

/* A part of plant_open: text and settings (plant_files.c). */
bool plant_read_files(struct plant *plant, const char *resources, fbd_errors *errors);

/* Integrate works along the simulation; and the values of all columns at the present state, with the works since the
 * start of the motion (plant_values.c). Return false with a reason. */
bool plant_follow(struct plant *plant);
bool plant_pull(struct plant *plant);

/* Return to the state after plant_open. */
void plant_reset(struct plant *plant);

/* Set a parameter or input; the value is used from the next call that needs it. */
void plant_set(struct plant *plant, size_t parameter, double value);

/* Begin at time `start`. */
void plant_begin(struct plant *plant, double start, double stop, double tolerance);

/* Make model, simulation and state consistent with t and the present values. Returns false with a reason. */
bool plant_update(struct plant *plant);

/* The options of a run with these settings. */
fbd_options plant_options(const struct plant *plant);

/* A model with these values of parameters and inputs, and states that hold inputs or not; NULL with notes in `errors`
 * (plant_files.c). */
fbd_model *plant_model(const struct plant *plant, const double *values, bool holds_inputs,
                       fbd_errors *errors);

/* The present state in a model whose states hold the inputs, after plant_update: that of the simulation, or of a model that
 * is compiled once. NULL with a reason (plant_values.c). */
fbd_state *plant_held_state(struct plant *plant);

/* The numbers of the present state as those of a model whose states hold the inputs, in place of *numbers, which is NULL or
 * on the heap. False with a reason. */
bool plant_pack(struct plant *plant, double **numbers, size_t *count);

/* Is the variable a parameter or an input, whose value is set? */
bool plant_is_given(const struct plant *plant, size_t index);

/* The number of works that belong to a base: those of all columns, or none where none is an output. */
static inline size_t plant_work_count(const struct plant *plant)
{
    return plant->extras.works ? plant->column_count : 0;
}

/* The number of all variables. */
static inline size_t plant_variable_count(const struct plant *plant)
{
    return plant->variable_count + plant->extras.count;
}

/* The value of variable `index` after plant_update; NAN of one for model exchange only. Returns false with a reason. */
bool plant_get(struct plant *plant, size_t index, double *value);

/* Advance to `target`; with `pause` at most to the first event after t. */
enum plant_step plant_step(struct plant *plant, double target, bool pause);

/* Save the plant as numbers, and restore it. `numbers` may be NULL to count only. plant_restore returns false
 * when they do not belong to such a plant, or memory is out. */
size_t plant_save(const struct plant *plant, double *numbers);
bool plant_restore(struct plant *plant, const double *numbers, size_t count);

#endif
