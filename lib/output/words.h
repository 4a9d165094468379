/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Descriptions of events, and the units of a scene.
 */
#ifndef FBD_OUTPUT_WORDS_H
#define FBD_OUTPUT_WORDS_H

#include "loop/run.h"

/* Describe an event briefly: "friction +4.81 N holds, limit 8.496 N". Writes at most `size` bytes. */
enum { event_detail_size = 320 };

void event_detail(const struct fbd_model *model, const struct run_event *event, char *detail, size_t size);

const char *event_body(const struct fbd_model *model, const struct run_event *event);
const char *event_name(const struct fbd_model *model, const struct run_event *event);

/* Units of the scene's system. */
const char *length_unit(const struct fbd_model *model);
const char *force_unit(const struct fbd_model *model);
const char *moment_unit(const struct fbd_model *model);
const char *energy_unit(const struct fbd_model *model);

#endif
