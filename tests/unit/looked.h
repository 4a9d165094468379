/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A scene and its linearisation, with all that has to be freed.
 */
#ifndef FBD_TESTS_LOOKED_H
#define FBD_TESTS_LOOKED_H

#include "fbd_study.h"
#include "scenes.h"

struct looked {
    fbd_model *model;
    fbd_state *state;
    fbd_errors *errors;
    fbd_linearization *linear;
};

static inline struct looked look(const char *text)
{
    struct looked looked = {.model = model_from(text), .errors = fbd_errors_new()};
    looked.state = fbd_state_new(looked.model);
    looked.linear = fbd_linearize(looked.state, looked.errors);
    return looked;
}

static inline void end_look(struct looked *looked)
{
    fbd_linearization_free(looked->linear);
    fbd_errors_free(looked->errors);
    fbd_state_free(looked->state);
    fbd_model_free(looked->model);
}

#endif
