/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calls of the public interface with memory that runs out at one allocation after the other (fail_alloc.h).
 * Include after <cmocka.h>.
 */
#ifndef FBD_TESTS_MEMORY_CALLS_H
#define FBD_TESTS_MEMORY_CALLS_H

#include "fail_alloc.h"
#include "fbd.h"
#include "thorough.h"

#include <stdlib.h>
#include <string.h>

/* A call under test: true when everything in it worked. */
typedef bool memory_call(void);

/* A model, and the list for what follows; NULL without either when there is none. */
static inline fbd_model *load(const char *scene, fbd_errors **errors)
{
    *errors = fbd_errors_new();
    if (!*errors) return NULL;
    fbd_model *model = fbd_model_parse(scene, strlen(scene), "scene", NULL, 0, *errors);
    if (!model) fbd_errors_free(*errors);
    return model;
}

/* Was there a text? It is freed. */
static inline bool some(char *string)
{
    bool there = string != NULL;
    free(string);
    return there;
}

/* The call has to notice each allocation that fails, and to work when none does. Each one with a stride of 0;
 * where there are thousands, each of the first `stride`, and then ever fewer. Under a sanitizer never all, and fewer. */
static inline void fail_each(memory_call *under_test, size_t stride)
{
    size_t n = 0;
    if (!thorough()) stride = stride ? stride / 8 : 25;
    for (;; n += 1 + (stride ? n / stride : 0)) {
        fail_alloc_at(n);
        bool done = under_test();
        if (!fail_alloc_end()) {
            assert_true(done);
            break;
        }
        if (done) fail_msg("allocation %zu failed and nobody noticed", n);
    }
    assert_true(n > 10);
}

#endif
