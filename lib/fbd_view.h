/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_view: a scene and its states as drawing programs, graders and formats need them. The rules of fbd.h
 * apply.
 */
#ifndef FBD_VIEW_H
#define FBD_VIEW_H

#include "fbd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- the contents of a file */

/* The path or name that the model was read by, as given: see fbd_escape before printing it; NULL for a text
 * without a name. */
FBD_API const char *fbd_model_file(const fbd_model *model);

/* Set options to those of the file, as fbd_options_init where it gives none; `size` is the caller's sizeof of
 * the struct. The method lives as long as the model. */
FBD_API void fbd_model_options(const fbd_model *model, fbd_options *options, size_t size);

#ifdef __cplusplus
}
#endif

#endif
