/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivatives of the equations of motion by an input of the file.
 *
 * An input is a constant of the compiled model. For the derivative by it a model is compiled in which the input
 * replaces the time and the time is a constant: the derivative by time of its dual numbers is then that by the input.
 */
#ifndef FBD_API_INPUT_SLOPES_H
#define FBD_API_INPUT_SLOPES_H

#include "dynamics/state.h"

/* True if an expression has a memory (`hysteresis`), which a model with constant time may lack. */
bool plan_remembers(const struct plan *plan);

/* The Jacobian of a copy of the state: dfdy[size x size] and dfdt[size], size = plan_size. False when memory is out. */
bool state_slopes(const fbd_state *state, double *dfdy, double *dfdt);

/* The values of a model for another reading, in `arena`: its data files, then all parameters and inputs in the order of the
 * scene. NULL when memory is out. */
struct override *model_overrides(const struct fbd_model *model, struct arena *arena, size_t *count);

/* The model in which input `input` (of the parameters of the scene) replaces the time; NULL when memory is out. */
struct fbd_model *model_by_input(const fbd_state *state, size_t input);

/* The derivatives of the rates, accelerations and rates of user states by that input, dfdu[size]; `by` is
 * model_by_input, dfdy scratch. False when the numbers of the state do not fit, or memory is out. */
bool input_slopes(const fbd_state *state, const struct fbd_model *by, size_t input, double *dfdy,
                  double *dfdu);

#endif
