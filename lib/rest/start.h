/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What keeps a state from being one that a motion starts at: every question asks here, so that a run,
 * `--check`, equations and statics refuse the same starts with the same words.
 */
#ifndef FBD_REST_START_H
#define FBD_REST_START_H

#include "base/diag.h"
#include "base/text.h"
#include "dynamics/state.h"

struct lack {
    const char *id; /* `does-not-fit`, `not-finite`, `unsettled`, `leaves-surface`, `masses-apart`,
                       `singular-start`, `forces-unbalanced`; NULL when memory is out */
    struct pos at;  /* in the file; 0 where it has no place there */
    struct text text;
};

/* Bring the state onto its couplings, settle its modes, evaluate it. False when something is lacking, which
 * is said of `what`, "the start"; free lack->text. `other` is a second state of the model, which is
 * overwritten. */
bool start_ready(struct fbd_state *state, struct fbd_state *other, const char *what, struct lack *lack);

/* Its geometry alone: ropes have a way, couplings fit. Without `modes`, which may be wrong, ropes alone are
 * asked. Nothing is brought anywhere. */
bool start_fits(struct fbd_state *state, struct fbd_state *other, bool modes, const char *what,
                struct lack *lack);

/* start_ready, as a note in `errors`. */
bool start_check(struct fbd_state *state, const char *what, fbd_errors *errors);

/* Is every number of the evaluated state finite? */
bool start_finite(const struct fbd_state *state, struct lack *lack);

/* For a question about rest: does the state, `what`, fit, and is every number of it finite? Else a note in `errors`.
 */
bool start_question(struct fbd_state *state, bool modes, const char *what, fbd_errors *errors);

/* Say that the normal force N of a contact would have to pull. */
void start_contact_words(const struct fbd_model *model, const struct contact *contact, double t, double N,
                         struct text *text);

/* What is lacking, as a note in `errors`. */
void lack_note(struct lack *lack, fbd_errors *errors);

/* A coefficient of friction that is below zero at t. */
void negative_friction_words(const struct fbd_model *model, int pair, double mu, double t, struct text *text);

/* Why the holds and branches of a state do not settle, from what its last settling found. */
void unsettled_words(const struct fbd_state *state, const char *when, struct text *text);

/* What to do where no choice of stick or slip lasts. `load` is the load that goes back and forth, or -1 when
 * no one does. */
const char *unsettled_advice(const struct fbd_model *model, int load);

#endif
