/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd: free-body diagrams that run. The one public header.
 */
#ifndef FBD_H
#define FBD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define FBD_API __attribute__((visibility("default")))
#else
#define FBD_API
#endif

/* ---------------------------------------------------------------- errors */

typedef enum fbd_severity {
    FBD_ERROR,
    FBD_WARNING,
} fbd_severity;

/* One thing that is wrong with a model file. Lines and columns are 1-based; 0 means that none is known. */
typedef struct fbd_error {
    fbd_severity severity;
    const char *id;      /* stable, for programs: "unknown-key", "wrong-dimension", ... */
    const char *message; /* what is wrong, one line */
    const char *hint;    /* what to write instead, or NULL */
    const char *file;
    int line, column;                 /* where it is wrong */
    int context_line, context_column; /* what was being read there, 0 when that adds nothing */
} fbd_error;

/* A list of them, owned by the caller. One list serves one thread. */
typedef struct fbd_errors fbd_errors;

/* An empty list, or NULL when memory is out. */
FBD_API fbd_errors *fbd_errors_new(void);
FBD_API void fbd_errors_free(fbd_errors *errors);

/* How many notes there are, and how many of them are errors (not warnings). */
FBD_API size_t fbd_errors_count(const fbd_errors *errors);
FBD_API size_t fbd_errors_failed(const fbd_errors *errors);

/* Note `index` in the order of position in the file, or NULL past the end; lives as long as the list. */
FBD_API const fbd_error *fbd_errors_get(fbd_errors *errors, size_t index);

/* Write every note as `file:line:col: error: message` and `    hint: ...`. */
FBD_API void fbd_errors_print(fbd_errors *errors, FILE *stream);

#ifdef __cplusplus
}
#endif

#endif
