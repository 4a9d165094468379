/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Conditions for a state to be the start of a motion. All commands use them, so that a run, `--check`,
 * equations and statics refuse the same starts with the same messages.
 */
#ifndef FBD_REST_START_H
#define FBD_REST_START_H

#include "base/diag.h"
#include "base/text.h"
#include "dynamics/state.h"

struct lack {
    const char *id; /* `does-not-fit`, `not-finite`, `unsettled`, `leaves-surface`, `masses-apart`,
                       `singular-start`, `forces-unbalanced`; NULL when memory is out */
    struct pos at;  /* in the file; 0 without a position there */
    struct text text;
};

/* Project the state onto its couplings, settle its modes, evaluate it. Returns false, with the reason, when a
 * condition is violated; the message names the state by `what`, for example "the start". Free lack->text.
 * `other` is a second state of the model, which is overwritten. */
bool start_ready(struct fbd_state *state, struct fbd_state *other, const char *what, struct lack *lack);

/* Its geometry alone: ropes have a path, couplings are satisfied. Without `modes`, which may be wrong, only
 * ropes are checked. The state is not changed. */
bool start_fits(struct fbd_state *state, struct fbd_state *other, bool modes, const char *what,
                struct lack *lack);

/* start_ready, with the reason as a note in `errors`. */
bool start_check(struct fbd_state *state, const char *what, fbd_errors *errors);

/* Is every number of the evaluated state finite? */
bool start_finite(const struct fbd_state *state, struct lack *lack);

/* For statics: does the state, named `what`, satisfy the couplings, with all numbers finite? Otherwise adds a
 * note to `errors`. */
bool start_question(struct fbd_state *state, bool modes, const char *what, fbd_errors *errors);

/* Report that the normal force N of a contact would have to pull. */
void start_contact_words(const struct fbd_model *model, const struct contact *contact, double t, double N,
                         struct text *text);

/* Add the reason as a note to `errors`. */
void lack_note(struct lack *lack, fbd_errors *errors);

/* Report a coefficient of friction that is negative at t. */
void negative_friction_words(const struct fbd_model *model, int pair, double mu, double t, struct text *text);

/* Report why the modes and branches of a state do not settle, from the result of the last settling. */
void unsettled_words(const struct fbd_state *state, const char *when, struct text *text);

/* Advice where no choice of stick or slip is consistent. `load` is the load that alternates, or -1 if none. */
const char *unsettled_advice(const struct fbd_model *model, int load);

#endif
