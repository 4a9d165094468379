/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Options of a run: those given by the caller, else those of the file, else defaults.
 */
#ifndef FBD_LOOP_OPTIONS_H
#define FBD_LOOP_OPTIONS_H

#include "loop/run.h"

/* False with notes in `errors`: `unknown-method`, `no-end-time`, `bad-option`. */
bool options_choose(const struct fbd_model *model, const fbd_options *given, struct run_options *chosen,
                    fbd_errors *errors);

/* "auto", or the name of the method. */
const char *options_method(const struct run_options *options);

#endif
