/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces, moments, couplings and contacts in the letters and units of the file.
 */
#ifndef FBD_NOTE_GIVEN_H
#define FBD_NOTE_GIVEN_H

#include "note/note.h"

struct given;

/* Read the file; lives as long as the document. NULL when memory is out. */
const struct given *given_open(struct making *making);

/* A table of the forces and moments that have keys: "static 0.4, kinetic mu". */
void given_forces(struct making *making, const struct given *given);

/* Write the keys of the motion of a body: ", along phi". */
void given_motion(const struct given *given, const char *body, struct text *text);

/* Write the keys of a coupling or contact with their values. */
void given_connection(const struct given *given, const char *name, struct text *text);

#endif
