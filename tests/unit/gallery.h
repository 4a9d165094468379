/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Trials: a model of the gallery (models/), opened with settings, put into states and run, through fbd.h
 * alone; and checks that go on after a failure and print what they saw.
 *
 * What a test cannot go on without (a model that does not open, a name that does not exist) ends it at once;
 * a number that is wrong is printed and counted, and checks_end fails the test.
 */
#ifndef FBD_TESTS_GALLERY_H
#define FBD_TESTS_GALLERY_H

#include "fbd_test.h"
#include "reference.h"

/* ---- checks */

struct checks {
    size_t failed;
    bool held[reference_count]; /* which reference numbers were looked at */
};

/* |got - want| <= tolerance; false also for NaN. */
bool check_close(struct checks *checks, const char *what, double got, double want, double tolerance);

bool check_that(struct checks *checks, const char *what, bool fact);

/* A reference number holds, within its own tolerance. */
bool check_reference(struct checks *checks, const char *name, double got);

/* The same within a tolerance of the test's own, which says why. */
bool check_reference_within(struct checks *checks, const char *name, double got, double tolerance);

/* Every reference number whose name starts with `prefix` has been looked at. */
void check_covered(struct checks *checks, const char *prefix);

/* Fail the test when anything was wrong. */
void checks_end(const struct checks *checks);

/* Set-up and clean-up of a group whose tests share what was held, and the checks of one of them, with no
 * failures yet. */
int checks_begin(void **state);
int checks_free(void **state);
struct checks *checks_of(void **state);

/* Call `test` with the path, below models/, of each model of the gallery, in the order of their names: all
 * topics but `hard`, whose cases have tests of their own (tests/hard). Returns their number. */
typedef void model_test(struct checks *checks, const char *path);
size_t each_model(struct checks *checks, model_test *test);

/* The same where a test takes long: under a sanitizer of every third model, with `turn` another third (thorough.h). Each
 * is run there by tests/cli/chapter.sh. */
size_t each_model_in_turn(struct checks *checks, size_t turn, model_test *test);

/* ---- trials */

struct trial {
    fbd_model *model;
    fbd_state *state;           /* for assembling; trial_to moves it along the run */
    fbd_simulation *simulation; /* NULL until trial_start */
    fbd_result *result;         /* NULL until trial_run */
    fbd_outcome outcome;
};

/* Settings, each "name=value", as the option --set of fbd-run takes them. */
#define SET(...) ((const char *const[]){__VA_ARGS__, NULL})

/* Open models/`path`; `settings` may be NULL. Or a model given as text. */
struct trial trial_open(const char *path, const char *const *settings);
struct trial trial_parse(const char *text);
void trial_close(struct trial *trial);

/* ---- states and what is assembled at them */

/* Of the first body, when the name has no dot: "v" is "block.v". */
void trial_set(struct trial *trial, const char *name, double value);
double trial_get(const struct trial *trial, const char *name);

/* The equation of a coordinate ("block.x") at the trial's state, kept in the trial's own structures: */
double trial_acceleration(struct trial *trial, const char *coordinate);
double trial_term(struct trial *trial, const char *coordinate, const char *term);
double trial_normal(struct trial *trial, const char *coordinate);

/* An arrow of the first body's diagram. */
fbd_arrow trial_arrow(struct trial *trial, const char *name);

/* As fbd_check_equation, to some roundings of the largest term. */
void check_equation(struct checks *checks, struct trial *trial, const fbd_expected *want);

/* ---- runs */

/* Start a simulation; NULL for the default options. */
void trial_start(struct trial *trial, const fbd_options *options);

/* Advance until the state at t is known, and take it. Times must ascend. */
void trial_to(struct trial *trial, double t);

/* Advance to the end of the run and take the last state. */
void trial_finish(struct trial *trial);

/* Start and carry through with the ledger: trial->result. A run that is done must not end beyond a limit (limits_kept.h). */
void trial_run(struct trial *trial, const fbd_options *options);
void trial_record(struct trial *trial, const fbd_options *options, const fbd_recording *recording);

/* The instant of event `index` (from 0) of this kind and name among those that have happened; NAN when there
 * is none. `name` may be NULL for any. */
double trial_event(const struct trial *trial, fbd_event_kind kind, const char *name, int index);

/* Run on until event `index` of that kind and name happens, and take the state there; NAN when it does not.
 */
double trial_to_event(struct trial *trial, fbd_event_kind kind, const char *name, int index);

/* Run on to the time of a reference number and hold a coordinate, rate or term of an equation against it. */
void hold_value(struct checks *checks, struct trial *trial, const char *reference, const char *name);
void hold_term(struct checks *checks, struct trial *trial, const char *reference, const char *coordinate,
               const char *term);

#endif
