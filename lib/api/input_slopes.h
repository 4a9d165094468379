/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivatives of the equations of motion by the state and by inputs of the file.
 *
 * An input that the state holds is a direction of its own (struct direction). One that is a constant of the model is held
 * by the states of another model of the same file.
 */
#ifndef FBD_API_INPUT_SLOPES_H
#define FBD_API_INPUT_SLOPES_H

#include "dynamics/state.h"

/* True if an expression has a memory (`hysteresis`). */
bool plan_remembers(const struct plan *plan);

/* The Jacobian of a copy of the state: dfdy[size x size] and dfdt[size], size = plan_size. False when memory is out. */
bool state_slopes(const fbd_state *state, double *dfdy, double *dfdt);

/* The values of a model for another reading, in `arena`: its data files, then all parameters and inputs in the order of the
 * scene. NULL when memory is out. */
struct override *model_overrides(const struct fbd_model *model, struct arena *arena, size_t *count);

/* The model whose states hold all inputs but those of callbacks; NULL when memory is out. */
struct fbd_model *model_with_held_inputs(const struct fbd_model *model);

/* The same instant as `state` in a model by model_with_held_inputs. NULL when the numbers of the state do not fit, or memory
 * is out. */
struct fbd_state *state_with_held_inputs(const fbd_state *state, const struct fbd_model *with);

/* The derivatives of the rates, accelerations and rates of user states by an input that the state holds (its index among the
 * parameters of the scene), dfdu[plan_size]. False when memory is out. */
bool input_slopes(const fbd_state *state, size_t input, double *dfdu);

#endif
