/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Statics and linearisation of scenes that are brought to rest: a force and a couple on every body take what would
 * accelerate it, by the independent assembly.
 */
#ifndef CROSS_REST_H
#define CROSS_REST_H

#include "compare.h"

/* `balanced` is the scene at rest, in equilibrium with all that holds; `absolute` is solved there. False where there is
 * something that moves whatever is done (drives, masses that vary) or where what holds does so by many ways. */
bool scene_balance(const struct scene *scene, struct scene *balanced, struct absolute *absolute);

/* The same without couplings that hold, friction and surfaces, whose equilibrium moves freely: what is linearised. */
bool scene_balance_freely(const struct scene *scene, struct scene *balanced, struct absolute *absolute);

/* False where there is nothing to compare. */
bool scene_compare_statics(const struct scene *balanced, struct absolute *absolute, struct outcome *outcome);
bool scene_compare_linear(const struct scene *balanced, struct absolute *absolute, struct outcome *outcome);

#endif
