/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Module: see module.c.
 */
#ifndef FBD_LIVE_MODULE_H
#define FBD_LIVE_MODULE_H

/* Of the page: `done` of `all` is completed. */
#ifdef __wasm__
__attribute__((import_module("page"), import_name("progress")))
#endif
void page_progress(double done, double all);

/* To be called once, before the others. */
void live_begin(void);

/* The text without the effects in `off`, as it is saved; NULL if that is no model. */
char *live_text(const char *text, const char *name, const char *off);

/* {errors, controls}: the value of fbd_model_controls, or null. */
char *live_controls(const char *text, const char *name);

/* {errors, text}: the text with a pull (fbd_pull) of the body by its path, numbers divided by blanks, or null. */
char *live_pulled(const char *text, const char *name, const char *body, const char *path, double x, double y,
                  double stiffness, double from, double to);

/* {errors, data}: the value of fbd_result_page_data with at least `rows` regular rows (see fbd_recording), or
 * null without a run. */
char *live_run(const char *text, const char *name, const char *off, double rows);

/* The CSV with its ledger, for tests; NULL without a run. */
char *live_csv(const char *text, const char *name, const char *off);

/* The work-precision diagram of fbd-cost as SVG, measured within `budget` seconds; NULL if there is none. */
char *live_cost(const char *text, const char *name, const char *off, double budget);

/* {errors, hand}: {differing, text} by fbd_check_hand of the lines under `hand`, or null without a model. */
char *live_check_hand(const char *text, const char *name);

/* {errors, grade}: the value of fbd_grade_json for an answer and a key, both texts, or null without a key.
 * The drawn values are those of this student; `settings` has values from outside, NAME=VALUE, one per line. */
char *live_grade(const char *key_text, const char *settings, const char *text, const char *student,
                 double details);

/* The model language as JSON Schema (fbd_schema). */
char *live_schema(void);

/* {errors, find}: the value of fbd_find_json for a question (fbd_find_parse), or null; of the scene at rest if `statics` is
 * not 0. */
char *live_find(const char *text, const char *name, const char *question, double statics);

/* {errors, note}: the calculation note of the run as HTML, with error bars, or null without a run. */
char *live_note(const char *text, const char *name, const char *off);

#endif
