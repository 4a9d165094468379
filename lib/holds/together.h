/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Simultaneous impacts at several points: compression, then restitution by the law (impacts.h).
 */
#ifndef FBD_HOLDS_TOGETHER_H
#define FBD_HOLDS_TOGETHER_H

#include "holds/impacts.h"

/* `before`: the largest initial speed, weighted by holds_weight, the reference of round-off levels. */
enum impacts_end impacts_together(struct impacts *impacts, double before);

#endif
