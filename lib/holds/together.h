/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Impacts at several points, all together: compression, then restitution by the law (impacts.h).
 */
#ifndef FBD_HOLDS_TOGETHER_H
#define FBD_HOLDS_TOGETHER_H

#include "holds/impacts.h"

/* `before`: the largest speed that there was, weighted as holds are (holds_weight), by which rounding is told. */
enum impacts_end impacts_together(struct impacts *impacts, double before);

#endif
