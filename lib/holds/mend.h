/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Modes that are nearly right, put right one after the other.
 */
#ifndef FBD_HOLDS_MEND_H
#define FBD_HOLDS_MEND_H

#include "holds/holds.h"

/* From the modes that there are: what breaks its law changes its mode, the first of all each time (Murty's rule, which
 * comes to an end where friction does not couple too much: Cottle, Pang and Stone, section 4.2). holds_lost where that
 * does not come to modes that agree; modes and forces are others then. */
enum holds_found holds_mend(struct hold_problem *problem);

#endif
