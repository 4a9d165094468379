/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Error scales of coupled bodies. The tolerance of a coordinate is relative to its largest size so far; in a
 * mechanism some coordinate may stay zero except for rounding (the angle of a coupler that moves without
 * turning), and then the step size would follow the rounding, near a singular position with ever more steps.
 * So the scale of each coordinate is at least a thousandth of the size of its mechanism: all bodies connected
 * by active couplings, and by joints between moving bodies. The rotation of a drum under a frictionless disc
 * is not part of that.
 */
#ifndef FBD_EVENTS_COUPLED_ERROR_SCALE_H
#define FBD_EVENTS_COUPLED_ERROR_SCALE_H

#include <stdbool.h>

#include "dynamics/state.h"

struct switcher;
struct mechanism;

struct coupled_scales {
    int *of;                   /* for each link the representative of its mechanism */
    struct mechanism *members; /* for each representative: sizes */
    double *start;             /* the coordinates at the last coupled_scales_join */
    double *given;             /* the floors set in the stepper, of coordinates and rates */
};

/* Allocate in `memory`; false when that is out. A model without couplings requires none. */
bool coupled_scales_init(struct coupled_scales *mechanisms, const struct fbd_model *model,
                         struct arena *memory);

/* Determine the mechanisms in the modes and position of a state that has been evaluated. */
void coupled_scales_join(struct coupled_scales *mechanisms, const struct fbd_state *state);

/* Set the floors of the stepper's components from the sizes of their mechanisms so far; the links must be
 * moved to the state. */
void coupled_scales_set_floors(struct coupled_scales *mechanisms, const struct fbd_state *state,
                               struct switcher *stepper);

#endif
