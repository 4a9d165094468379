/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Layout of a state vector of second-order systems.
 *
 * y = [q_0 ... q_(n-1), v_0 ... v_(n-1), x_0 ... x_(m-1)] with q' = v exactly, n = pairs, m = extra. The x
 * are any further states of first order (accumulated work, for instance). A system that is not of this form
 * has pairs = 0. The structure is used for accuracy: dense output of two orders more, and error scales for
 * components that are still zero.
 */
#ifndef FBD_INTEGRATE_LAYOUT_H
#define FBD_INTEGRATE_LAYOUT_H

#include <stdbool.h>
#include <stddef.h>

struct layout {
    size_t pairs, extra;
    const bool
        *angle; /* for each pair: q is an angle [rad]; NULL: none is. Read only by the alloc functions. */
};

static inline size_t layout_size(const struct layout *layout)
{
    return 2 * layout->pairs + layout->extra;
}

#endif
