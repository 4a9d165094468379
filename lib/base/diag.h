/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Diagnostics: all faults of a file, collected in the order of discovery and sorted by position for display.
 * The public interface is `fbd_errors` in fbd.h.
 */
#ifndef FBD_BASE_DIAG_H
#define FBD_BASE_DIAG_H

#include "base/arena.h"
#include "fbd.h"

/* A position in a text; line and column are 1-based, 0 means unknown. */
struct pos {
    int line, column;
};

struct diag_note {
    fbd_error error;
    fbd_fix fix; /* line 0 until diag_place_fixes has found it */
    struct diag_note *next;
};

/* The hint that was made last of those that replace a word. */
struct diag_replacement {
    const char *hint, *replace, *with;
};

/* A file that was read, or could not be read. */
struct diag_file {
    const char *path;
    struct diag_file *next;
};

struct fbd_errors {
    struct arena arena;
    struct diag_note *first, *last;
    struct diag_file *files;
    struct diag_note **sorted; /* filled by diag_get */
    struct diag_replacement replacement;
    size_t count, errors, limit;
    const char *file; /* file name of notes added from now on */
    bool out_of_memory;
};

/* Add a note. `id` must be a string literal; `hint` may be NULL. The message is formatted by `format`. */
void diag_add(fbd_errors *errors, fbd_severity severity, const char *id, struct pos at, const char *hint,
              const char *format, ...) __attribute__((format(printf, 6, 7)));

/* The same with the construct that was being read (`context`), as for a YAML error far from its cause. */
void diag_add_within(fbd_errors *errors, const char *id, struct pos at, struct pos context, const char *hint,
                     const char *format, ...) __attribute__((format(printf, 6, 7)));

/* A hint built with printf that lives as long as `errors`. */
const char *diag_hint(fbd_errors *errors, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same for a hint to write `with` instead of `wrong`. The note that is added next with this hint has that as its fix. */
const char *diag_replace(fbd_errors *errors, const char *wrong, const char *with, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Find the words that the fixes of notes on `file` replace in its text: at the position of the note, or behind a quote or
 * sign there. Fixes whose words are not there are dropped. */
void diag_place_fixes(fbd_errors *errors, const char *file, const char *text, size_t length);

/* A hint "did you mean 'x'?" for the nearest of `names`, which is also the fix, or a list of them when none is near. */
const char *diag_nearest(fbd_errors *errors, const char *wrong, const char *const *names, size_t count);

/* The present end of a list; the second function removes all notes added since. */
struct diag_mark {
    struct diag_note *last;
    size_t count, errors;
};
struct diag_mark diag_mark(const fbd_errors *errors);
void diag_take_back(fbd_errors *errors, struct diag_mark mark);

void diag_out_of_memory(fbd_errors *errors);

/* Notes added from now on belong to this file (NULL: to none). The name is copied: notes outlive a model. */
void diag_in_file(fbd_errors *errors, const char *file);

/* Note `index` in the order of fbd_errors_get, or NULL past the end; lives as long as the list. */
const struct diag_note *diag_note_at(fbd_errors *errors, size_t index);
const fbd_error *diag_get(fbd_errors *errors, size_t index);

/* The first note that is no warning, or NULL; needs no memory. */
const fbd_error *diag_first_error(fbd_errors *errors);

/* Add a file that is going to be read to the list of fbd_errors_file, once. */
void diag_reads(fbd_errors *errors, const char *path);

/* A call of the public interface. Within it fbd_errors_failed_count counts the errors of this call alone, so
 * that a list with earlier errors can be used again; for a caller without a list the errors are discarded. */
struct diag_call {
    fbd_errors own;     /* replaces a list that is NULL */
    fbd_errors *errors; /* the caller's list, or NULL */
    size_t earlier;     /* number of earlier errors in it */
    bool earlier_out_of_memory;
    const char *file;
};

/* The list for this call, which ends with diag_end. Calls may be nested. */
fbd_errors *diag_begin(struct diag_call *call, fbd_errors *errors);
void diag_end(struct diag_call *call);

#endif
