/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Diagnostics: everything that is wrong with a file, collected in the order of discovery and sorted by
 * position when it is shown. The public face is `fbd_errors` in fbd.h.
 */
#ifndef FBD_BASE_DIAG_H
#define FBD_BASE_DIAG_H

#include "base/arena.h"
#include "fbd.h"

/* A place in a text; line and column are 1-based, 0 means unknown. */
struct pos {
    int line, column;
};

struct diag_note {
    fbd_error error;
    struct diag_note *next;
};

struct fbd_errors {
    struct arena arena;
    struct diag_note *first, *last;
    fbd_error **sorted; /* filled by fbd_errors_get */
    size_t count, errors, limit;
    const char *file; /* file name of notes that are added now */
    bool out_of_memory;
};

/* Add a note. `id` must be a string literal; `hint` may be NULL. `format` makes the message. */
void diag_add(fbd_errors *errors, fbd_severity severity, const char *id, struct pos at, const char *hint,
              const char *format, ...) __attribute__((format(printf, 6, 7)));

/* The same, saying also what was being read (`context`), as for a YAML error far from its cause. */
void diag_add_within(fbd_errors *errors, const char *id, struct pos at, struct pos context, const char *hint,
                     const char *format, ...) __attribute__((format(printf, 6, 7)));

/* A hint built with printf that lives as long as `errors`. */
const char *diag_hint(fbd_errors *errors, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A hint "did you mean 'x'?" for the nearest of `names`, or a list of them when none is near. */
const char *diag_nearest(fbd_errors *errors, const char *wrong, const char *const *names, size_t count);

void diag_out_of_memory(fbd_errors *errors);

#endif
