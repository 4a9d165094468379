/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Numbers with units as engineers write them: 10.15 kN, 4.8 mm, 9.81 m/s², 2.6·10⁻¹⁶.
 */
#ifndef FBD_BASE_ENGINEERING_H
#define FBD_BASE_ENGINEERING_H

#include "base/text.h"

/* A unit and its size in the coherent unit. */
struct scaled_unit {
    char name[32]; /* as printed: kN·m */
    double size;
};

/* The unit in which a value of this size is written: with k or M, in US units as kip, for forces, moments, energies and
 * stiffnesses of 10,000 and more, mm below a centimetre; degrees where `degrees`. */
struct scaled_unit unit_for(const char *unit, double size, bool degrees);

/* A number with so many significant digits; beyond 1e-4 to 1e6 with a power of ten. A number that is not finite is "?". */
void number_write(struct text *text, double value, int digits);

/* The number and its unit. */
void value_write(struct text *text, double value, const char *unit, int digits, bool degrees);

/* A value at the round-off level of others, or within its error, is zero. */
double rounded_off(double value, double error, double size);

#endif
