/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The figure of the system: the bodies joined, as a problem of a textbook shows them.
 */
#ifndef FBD_DRAW_SYSTEM_SVG_H
#define FBD_DRAW_SYSTEM_SVG_H

#include "fbd_export.h"

/* The document, to be freed with fbd_free; NULL with a note in `errors`: `not-finite`, or memory is out. */
char *system_svg(fbd_state *state, const fbd_drawing *given, fbd_errors *errors);

#endif
