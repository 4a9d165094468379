/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What an error of a coupled body counts against. The tolerance of a coordinate is relative to the size that
 * it has had; in a mechanism some coordinate may stay zero but for rounding (the angle of a coupler that
 * moves without turning), and then steps would follow the rounding, next to a singular position with ever
 * more of them: a row of two parallelograms of `planar` rods took 250,000 steps to the first line of all its
 * rods, and takes 20. So each coordinate has at least a thousandth of the size of the whole mechanism: what
 * the couplings in force, and the joints between moving bodies, join. How fast a drum turns under a smooth disc is no
 * part of that.
 */
#ifndef FBD_EVENTS_COUPLED_ERROR_SCALE_H
#define FBD_EVENTS_COUPLED_ERROR_SCALE_H

#include <stdbool.h>

#include "dynamics/state.h"

struct switcher;
struct mechanism;

struct coupled_scales {
    int *of;                   /* for each link one that stands for its mechanism */
    struct mechanism *members; /* for each link that does: sizes */
    double *start;             /* the coordinates when they were joined */
    double *given;             /* the floors that the stepper has, of coordinates and rates */
};

/* Made of `memory`; false when that is out. A model without couplings takes nothing. */
bool coupled_scales_init(struct coupled_scales *mechanisms, const struct fbd_model *model,
                         struct arena *memory);

/* Who is joined to whom in the modes and at the place of a state that has been evaluated. */
void coupled_scales_join(struct coupled_scales *mechanisms, const struct fbd_state *state);

/* Give the components of the stepper the sizes that their mechanisms have come to, links moved to the state.
 */
void coupled_scales_set_floors(struct coupled_scales *mechanisms, const struct fbd_state *state,
                               struct switcher *stepper);

#endif
