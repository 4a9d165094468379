/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * In the place of accuracy_sundials.c where SUNDIALS is not installed.
 */
#include "accuracy.h"

const char sundials_version[] = "";
const struct solver sundials_solvers[1];
const size_t sundials_solver_count = 0;
