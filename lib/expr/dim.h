/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Physical dimensions: powers of mass, length and time, and for user states of electric current and
 * temperature.
 *
 * Plane angle has no dimension (1 rad = 1), as in the SI. Exponents are in twelfths, so that square, cube and
 * fourth roots are exact.
 */
#ifndef FBD_EXPR_DIM_H
#define FBD_EXPR_DIM_H

#include <stdbool.h>

enum { dim_unit = 12 }; /* an exponent of one */

struct dim {
    short mass, length, time, current, temperature; /* in twelfths */
};

/* Whole powers of mass, length and time: DIM_INIT initializes an object (a static one too), DIM is a value.
 */
/* clang-format off */
#define DIM_INIT(M, L, T)          DIM_ALL(M, L, T, 0, 0)
#define DIM_ALL(M, L, T, A, K)     {(M) * dim_unit, (L) * dim_unit, (T) * dim_unit, (A) * dim_unit, (K) * dim_unit}
/* clang-format on */
#define DIM(M, L, T) ((struct dim)DIM_INIT(M, L, T))

#define DIM_NONE            DIM(0, 0, 0)
#define DIM_MASS            DIM(1, 0, 0)
#define DIM_LENGTH          DIM(0, 1, 0)
#define DIM_TIME            DIM(0, 0, 1)
#define DIM_VELOCITY        DIM(0, 1, -1)
#define DIM_ACCELERATION    DIM(0, 1, -2)
#define DIM_RATE            DIM(0, 0, -1) /* rad/s */
#define DIM_FORCE           DIM(1, 1, -2)
#define DIM_MOMENT          DIM(1, 2, -2) /* also energy, and torsional stiffness (N m/rad) */
#define DIM_POWER           DIM(1, 2, -3)
#define DIM_INERTIA         DIM(1, 2, 0)
#define DIM_STIFFNESS       DIM(1, 0, -2)
#define DIM_DAMPING         DIM(1, 0, -1) /* N s/m */
#define DIM_ANGULAR_DAMPING DIM(1, 2, -1) /* N m s/rad */
#define DIM_QUADRATIC_DRAG  DIM(1, -1, 0) /* N s^2/m^2 */
#define DIM_PRESSURE        DIM(1, -1, -2)

bool dim_equal(struct dim a, struct dim b);
struct dim dim_times(struct dim a, struct dim b);
struct dim dim_over(struct dim a, struct dim b);

/* a^(numerator/denominator); false when an exponent would not be a twelfth or is out of range. */
bool dim_power(struct dim a, int numerator, int denominator, struct dim *result);

#endif
