/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_exchange: models within other simulators: integration by another program; forces, energies and works as columns. The
 * rules of fbd.h apply.
 */
#ifndef FBD_EXCHANGE_H
#define FBD_EXCHANGE_H

#include "fbd_view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- integration by another program */

/* A motion whose steps another program makes, by its own method. It sets time and numbers, reads their derivatives and the
 * indicators, and finds the events, at which an indicator becomes negative; the library makes the transitions. */
typedef struct fbd_exchange fbd_exchange;

/* Can it be had? False with a note in `errors`, `no-exchange`, for a scene with events that are no zeros of indicators: a
 * slot with ends, a rope on a drum or over pulleys or points; and for friction on a horizontal plane. */
FBD_API bool fbd_model_exchanges(const fbd_model *model, fbd_errors *errors);

/* A motion from the time and values of a state; at t = 0 from the start of the file. The model of the state must outlive
 * it. Of the options the tolerance is used: up to it couplings may drift, and the end time: up to it events of time alone
 * are found in advance. NULL with notes in `errors`: as fbd_simulation_from and fbd_model_exchanges. */
FBD_API fbd_exchange *fbd_exchange_new(const fbd_state *state, const fbd_options *options,
                                       fbd_errors *errors);
FBD_API void fbd_exchange_free(fbd_exchange *exchange);

/* The numbers of the motion: the coordinates of the model in the order of fbd_model_coordinate, their rates, then the user
 * states; and the indicators. */
FBD_API size_t fbd_exchange_number_count(const fbd_exchange *exchange);
FBD_API size_t fbd_exchange_indicator_count(const fbd_exchange *exchange);

/* Set and get time and numbers. They are not checked: at one that is not finite the derivatives are not, either. */
FBD_API void fbd_exchange_set(fbd_exchange *exchange, double t, const double *numbers);
FBD_API void fbd_exchange_get(const fbd_exchange *exchange, double *t, double *numbers);

/* Set an input, in coherent units, from the present time on: of a model in which the input has no callback function
 * (fbd_model_with_callbacks). False with a note in `errors`: `unknown-input`, `fixed-input`, or `bad-call` for a value that is
 * not finite. */
FBD_API bool fbd_exchange_set_input(fbd_exchange *exchange, const char *name, double value,
                                    fbd_errors *errors);

/* The derivatives of the numbers by time, and the indicators, in the present modes. False when a derivative is not
 * finite. */
FBD_API bool fbd_exchange_derivatives(fbd_exchange *exchange, double *derivatives);
FBD_API void fbd_exchange_indicators(fbd_exchange *exchange, double *indicators);

/* A step of the other program is complete: returns whether fbd_exchange_update should follow, to close couplings. */
FBD_API bool fbd_exchange_complete(fbd_exchange *exchange);

/* Make the transitions of all events up to the present time, which is not changed; numbers may jump. Call it also after an
 * input has jumped. `*next` is the time of the next event that depends on time alone, at which it should be called again, or
 * NAN. The outcome is FBD_GOING, or the end of the motion. */
FBD_API fbd_outcome fbd_exchange_update(fbd_exchange *exchange, double *next);
FBD_API fbd_outcome fbd_exchange_outcome(const fbd_exchange *exchange);
FBD_API const char *fbd_exchange_reason(const fbd_exchange *exchange);

/* Copy the present values and modes into a state of the same model. False for another one. */
FBD_API bool fbd_exchange_state(fbd_exchange *exchange, fbd_state *state);

/* ---------------------------------------------------------------- forces, energies and works as columns */

/* Columns of a CSV with ledger, by their names: forces, moments and reactions ("block.friction", "bob.pin.x"), energies
 * ("energy.kinetic") and works ("block.friction.work"). */
typedef struct fbd_force_columns fbd_force_columns;

typedef enum {
    FBD_COLUMN_FORCE,  /* a force, moment or reaction, at a state in its modes */
    FBD_COLUMN_ENERGY, /* kinetic or potential, at a state */
    FBD_COLUMN_WORK    /* a work, or the residual of the energy: since the start of a simulation */
} fbd_column_kind;

/* NULL when memory is out. The model must outlive them. */
FBD_API fbd_force_columns *fbd_force_columns_new(const fbd_model *model);
FBD_API void fbd_force_columns_free(fbd_force_columns *columns);
FBD_API size_t fbd_force_columns_count(const fbd_force_columns *columns);

/* Name and unit of a column; live as long as the columns, NULL past the last one. */
FBD_API const char *fbd_force_columns_name(const fbd_force_columns *columns, size_t index);
FBD_API const char *fbd_force_columns_unit(const fbd_force_columns *columns, size_t index);
FBD_API fbd_column_kind fbd_force_columns_kind(const fbd_force_columns *columns, size_t index);

/* Integrate works along a simulation that has made no step: from then on its last step has them. The columns are freed
 * before it; its steps are made by fbd_simulation_advance, without fbd_simulation_set_input. False when memory is out, or
 * for another simulation. */
FBD_API bool fbd_force_columns_follow(fbd_force_columns *columns, fbd_simulation *simulation);

/* Their values at a state. Works are those up to its time, if that lies in the last step of the simulation, and otherwise
 * NAN. False when the state is not of the model, or memory is out. */
FBD_API bool fbd_force_columns_values(fbd_force_columns *columns, fbd_state *state, double *values);

#ifdef __cplusplus
}
#endif

#endif
