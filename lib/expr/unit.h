/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The closed table of units, and the two coherent systems in which a model may be written.
 *
 * Numbers are in the model's own system (SI: kg, m, s; US: slug, ft, s), so that a US model with g = 32.2
 * ft/s^2 is computed with 32.2 and no conversion. Only a quantity with a unit of the other system is
 * converted, by the exact definitions (1 ft = 0.3048 m, 1 lbm = 0.45359237 kg, standard gravity 9.80665
 * m/s^2; NIST SP 811, appendix B).
 */
#ifndef FBD_EXPR_UNIT_H
#define FBD_EXPR_UNIT_H

#include "base/diag.h"
#include "expr/dim.h"

enum unit_system {
    unit_si, /* kg, m, s, N, rad */
    unit_us, /* slug, ft, s, lbf, rad */
};

/* A parsed unit: a number times `factor` is in the coherent units of the requested system. */
struct unit {
    struct dim dim;
    double factor;
    bool angle; /* contains a unit of angle: deg, rad, rev, rpm */
    bool hertz; /* contains Hz, which counts periods and is easily mistaken for an angular velocity */
};

/* Parse a unit expression such as `N*m*s/rad`, `ft/s^2`, `kg m^2`, `1/s`: names of the table joined by `*`,
 * `/`, `^` with an integer exponent, `.` or blanks for a product, and parentheses; `1` may stand as a
 * numerator. Products and quotients associate from left to right: `N/m/s` is N/(m*s). The whole of
 * `text[0..length)` must be used. False with one note in `errors` (id `unknown-unit` with the nearest name as
 * hint, or `unit-syntax`) at the right column when it is not a unit; `errors` may be NULL for a silent
 * attempt. `at` is the position of text[0]. */
bool unit_parse(const char *text, size_t length, enum unit_system system, fbd_errors *errors, struct pos at,
                struct unit *result);

/* The coherent unit in `system` of a quantity of dimension `dim`: "m/s", "N*m", "slug*ft^2"; "" for a pure
 * number. Writes at most `size` bytes with the terminating zero. A moment and an energy have the same
 * dimension: this gives "N*m" and "lbf*ft"; unit_name_energy gives "J" and "ft*lbf". */
void unit_name(struct dim dim, enum unit_system system, char *buffer, size_t size);
const char *unit_name_energy(enum unit_system system);

/* The name of a quantity of dimension `dim`: "force", "moment or energy", "pure number"; NULL if it has no
 * common name. */
const char *unit_quantity(struct dim dim);

/* Common units of dimension `dim`, as a hint: "N, kN, lbf, ..."; "" if there is none. */
void unit_examples(struct dim dim, char *buffer, size_t size);

#endif
