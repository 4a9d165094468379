/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Module: see module.c.
 */
#ifndef FBD_LIVE_MODULE_H
#define FBD_LIVE_MODULE_H

/* The text without what is off, as it is saved; NULL when it is no model. */
char *live_text(const char *text, const char *name, const char *off);

/* {errors, controls}: what fbd_model_controls says, or null. */
char *live_controls(const char *text, const char *name);

/* {errors, data}: what fbd_result_page_data says, or null where there was no run; of at least so many regular rows (see
 * fbd_recording). */
char *live_run(const char *text, const char *name, const char *off, double rows);

/* The CSV with its ledger, for tests; NULL where there was no run. */
char *live_csv(const char *text, const char *name, const char *off);

/* The work-precision diagram of fbd-cost as SVG, measured here, in so many seconds; NULL where there is none. */
char *live_cost(const char *text, const char *name, const char *off, double budget);

/* {errors, hand}: of the lines under `hand` {differing, text} as fbd_check_hand says them, or null where there is no
 * model. */
char *live_check_hand(const char *text, const char *name);

/* {errors, grade}: an answer against a key, both texts, as fbd_grade_json says it, or null where there is no key. The
 * values that the key draws are those of this student; `settings` has values from outside, NAME=VALUE, one a line. */
char *live_grade(const char *key_text, const char *settings, const char *text, const char *student,
                 double details);

#endif
