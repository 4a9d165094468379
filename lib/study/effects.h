/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Effects: comparison of the scene with the same scene without one effect.
 *
 * The list of effects and the scenes without them come from fbd_simplify.
 */
#ifndef FBD_STUDY_EFFECTS_H
#define FBD_STUDY_EFFECTS_H

#include "fbd_study.h"
#include "study/reference.h"
#include "study/timing.h"

struct fbd_effects {
    struct arena arena;
    const fbd_model *model;
    fbd_effect *effects;
    size_t count;
    fbd_simplifications *simplifications; /* of the same indices */
    struct grid grid;
    struct track track, tight; /* of the complete scene */
    double *scale;
    double floor; /* difference between these two */
    double until, budget, seconds;
    struct progress progress;
    fbd_errors *errors; /* of the caller, during the study */
};

#endif
