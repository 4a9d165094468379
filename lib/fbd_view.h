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

/* A data file that was read for a table of the model. The texts live as long as the model, and are NULL past
 * the last one. */
typedef struct fbd_data_file {
    const char *table, *path;
} fbd_data_file;

FBD_API size_t fbd_model_data_file_count(const fbd_model *model);
FBD_API fbd_data_file fbd_model_data_file(const fbd_model *model, size_t index);

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

/* The outcome of a simulation so far: FBD_GOING until its end. Without any step it is another one where the
 * start is refused. */
FBD_API fbd_outcome fbd_simulation_outcome(const fbd_simulation *simulation);

#ifdef __cplusplus
}
#endif

#endif
