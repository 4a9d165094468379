/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The drawing page of a sheet: its bodies cut free, on which a student draws.
 */
#ifndef FBD_LIVE_DRAWING_H
#define FBD_LIVE_DRAWING_H

#include "base/text.h"
#include "fbd_view.h"

/* Append the bodies of a sheet in a state with this view as a JSON array (its members: drawing_body.c), and
 * their pictures as SVG elements for HTML. Neither contains any part of the key, as the sheet has none. Returns
 * false when memory is out. */
bool drawing_add_bodies(struct text *text, struct text *pictures, const fbd_state *state,
                        const fbd_view *view);

#endif
