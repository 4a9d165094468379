/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the files of test_bad_calls share.
 */
#ifndef FBD_TESTS_BAD_CALLS_H
#define FBD_TESTS_BAD_CALLS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fbd.h"

/* A small model as text; two of it, and a list of errors, while the tests run. */
extern const char bad_calls_scene[];
extern fbd_model *model, *other;
extern fbd_errors *errors;

static const size_t past = SIZE_MAX;

static inline bool is_nan(double value)
{
    return value != value;
}

/* This function has been called. */
void note(const char *name);

/* The function is called in this expression, which is true when it answers as it should. */
#define ANSWERS(function, expression)                                                                        \
    do {                                                                                                     \
        (void)function;                                                                                      \
        note(#function);                                                                                     \
        if (!(expression)) fail_msg("%s", #expression);                                                      \
    } while (0)

/* The same, with a note for the list. */
#define REFUSES(function, expression)                                                                        \
    do {                                                                                                     \
        size_t before_ = fbd_errors_count(errors);                                                           \
        ANSWERS(function, expression);                                                                       \
        assert_int_equal(fbd_errors_count(errors), before_ + 1);                                             \
        assert_string_equal(fbd_errors_get(errors, before_).id, "bad-call");                                 \
    } while (0)

/* The same for what answers nothing. */
#define ENDURES(function, statement)                                                                         \
    do {                                                                                                     \
        (void)function;                                                                                      \
        note(#function);                                                                                     \
        statement;                                                                                           \
    } while (0)

/* bad_calls_studies.c */
int bad_calls_count(void *context, const char *rows, size_t length);
void sweeps_that_cannot_be_made(void **context);
void searches(void **context);
void fits(void **context);
void sweeps(void **context);
void studies(void **context);
void sections(void **context);
void methods_and_simplifications(void **context);
void grades(void **context);
void a_key_without_an_answer(void **context);

/* bad_calls_exchange.c */
void exchanges(void **context);

/* bad_calls_contents.c */
void contents(void **context);

/* bad_calls_view.c */
void views(void **context);

/* bad_calls_derivations.c */
void derivations(void **context);

/* bad_calls_bodies.c */
void bodies_and_forces(void **context);
void states_for_comparison(void **context);

/* bad_calls_options.c */
void options_have_a_size(void **context);
void options_are_filled_with_defaults(void **context);
void progress_ends_what_is_under_way(void **context);

#endif
