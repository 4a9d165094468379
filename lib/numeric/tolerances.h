/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tolerances of numeric, integrate, model, events, record, holds, rest and section: each with its unit, meaning and reason.
 * A number of this kind elsewhere in these rooms fails a test (tests/tools/check_files). Numbers without a unit are relative
 * to the size that is named with them.
 */
#ifndef FBD_NUMERIC_TOLERANCES_H
#define FBD_NUMERIC_TOLERANCES_H

#include <float.h>

/* ---- round-off */

/* Round-off of `count` operations on numbers of this size, in the unit of the size. */
static inline double round_off(double count, double size)
{
    return count * DBL_EPSILON * size;
}

/* Roundings of a time: it is the sum of steps, and a step is placed on it by several operations. */
static const double time_roundings = 64;

/* Round-off of some hundred operations, relative to the largest number among them. */
static const double negligible_part = 1e-13;

/* The same of sums of thousands of terms, or with cancellation by a factor of ten. */
static const double negligible_sum = 1e-12;

/* Round-off of one evaluation of the motion, relative to the largest value of its kind in the run. */
static const double evaluation_rounding = 1e-14;

/* Round-off of numbers that solve the equations of motion (accelerations, forces, speeds along couplings), relative to the
 * largest of their kind: systems of some dozen rows lose six digits. */
static const double solved_rounding = 1e-10;

/* The level of the solution at a decision: a number below this part of the largest of its kind counts as zero, since the
 * integrator, interpolants of steps and the digits of a file have errors of that size. */
static const double undecided_part = 1e-9;

/* Results (velocities after an impact, forces, trials of a search) that differ by less than this part are one result. */
static const double distinct_part = 1e-6;

/* Friction on a plane: the part of a run after which a body that starts from rest has a direction (plane_friction.h). */
static const double soft_part = 1e-10;

/* The speed, relative to that after this part of a run, or to the error of the run, below which the velocity has errors of the
 * same size across its direction, which is kept there. */
static const double soft_speeds = 1e3, slow_errors = 1e2;

/* The speed, relative to the larger of both, with which a point may return without a stop: a start from rest has velocities of round-off
 * in both directions. */
static const double soft_return = 1e-3;

/* ---- files */

/* Digits of numbers in a file: directions and positions that agree in nine digits are meant to be equal. */
static const double nine_digits = 1e-9;

/* Lengths that were given with six digits. */
static const double six_digits = 2e-6;

/* Sine of the angle to the vertical of a line that counts as vertical: cos(pi/2) and its sums are round-off. */
static const double vertical_line = 1e-12;

/* ---- contacts, relative to the size of the scene */

/* Shapes touch: the round-off of positions at the other end of the scene, times a thousand operations. */
static const double contact_near = 1e-12;

/* Level heights. A bounce lower than 2e-9 ends in rest (loop/zeno_rest.c), so that smaller steps cannot be distinguished
 * from contact. The ends of a coupling that begins fit to the same. */
static const double contact_level = 1e-8;

/* ---- equilibria */

/* The scale of a length that is zero [m]. */
static const double least_length_scale = 1e-3;

/* A slope that vanishes at the equilibrium, relative to that at the start; and a state near the equilibrium, relative to the
 * distance of the start. */
static const double vanishing_slope = 1e-4, near_equilibrium = 1e-3;

/* Coordinates that move less than this part of the others are not used for a balancing force. */
static const double balancing_motion = 1e-3;

/* ---- linear algebra */

/* Damping of a projection onto the couplings, relative to the responses: rows that depend on others but for less than this are
 * left out. */
static const double projection_damping = 1e-6;

/* Rows of couplings and contacts: a shift of the diagonal, relative to the response of a row at other positions, by which
 * dependent rows have the least forces. Rows that are independent by less than some of these shifts are dependent. */
static const double shift_of_rows = 1e-8, dependent_row = 1e-7;

/* Pivoting: inequalities that are violated, relative to the largest. Accelerations of two solutions that differ. */
static const double pivoting_zero = 1e-11, pivoting_difference = 1e-8;

/* Least distance: 1 / |x|^2, below which there is no point x of a size that forces have. */
static const double least_distance_end = 1e-8;

/* ---- steps */

/* The least tolerance of parts of a step [relative]: below it an error estimate is round-off. */
static const double least_part_tolerance = 1e-12;

/* The least scale of a rate, relative to that by which its coordinate moves: for components that rest. */
static const double least_rate_scale = 1e-3;

/* The first step: a probe in which the slopes change by a time this much shorter is too long; the shortest and the usual
 * probe, relative to the longest step. */
static const double least_change_time = 1e-4, shortest_probe = 1e-9, usual_probe = 1e-3;

/* A step below which the end of the run is not reached in any number of steps, relative to the rest of the run. */
static const double least_step = 1e-30;

/* BDF: the least convergence rate of Newton's iteration that is assumed without a measurement; and a number added to the error
 * ratio, which may be zero, before its root is taken. */
static const double least_newton_rate = 1e-4, least_error_ratio = 1e-12;

/* Stiffness: the least growth of a component of the power iteration in one product, so that none becomes zero. */
static const double least_growth = 1e-20;

/* Linear systems: an excess of h rho by which a step may be longer after rounding; terms of the series of the exponential below
 * a fraction of a rounding; and, relative, below the resolution of double-double numbers, 2^-106: a term that does not change its
 * sum. */
static const double rounded_reach = 1e-9, series_end = 4e-18, negligible_dd = 0x1p-108;

/* ---- events */

/* A panel of a search is not shorter than this, relative to the step: shorter ones are sampled. */
static const double least_panel = 1e-3;

/* The largest round-off of a series, relative to its values, with which its roots are looked for. */
static const double most_series_rounding = 1e-5;

/* A quantity at rest at its switch may be short of it by the error of the step that reached it. */
static const double stop_shortfall = 1e-6;

/* A slip that has just begun: the band around zero within which the function is silent, its least size, and the time that it
 * lasts, relative to the step. */
static const double slip_band = 1e-13, least_slip_band = 1e-14, slip_beginning = 1e-9;

/* ---- works */

/* Powers: round-off of forces from a nearly singular system, and the largest tolerance of a quadrature. */
static const double singular_force_rounding = 1e-6, most_work_tolerance = 1e-7;

#endif
