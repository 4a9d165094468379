/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Small trees by hand: Lagrange's equations, written once for each system as a careful person does, with sines and
 * cosines of differences from those of the angles, no work that the equation does not need, and the coordinates of
 * fbd (angles from the link before). g = 9.81; masses and lengths are 1 unless said. `params` is not used.
 */
#ifndef FBD_BENCH_LAGRANGE_H
#define FBD_BENCH_LAGRANGE_H

/* Two uniform rods, the first from straight down: y = [theta_1, theta_2, and their rates].
 *
 *     (4/3) a1 + (1/2) cos(d) a2 = -(1/2) sin(d) w2^2 - (3/2) g sin(th1)        d = th1 - th2
 *     (1/2) cos(d) a1 + (1/3) a2 =  (1/2) sin(d) w1^2 - (1/2) g sin(th2) */
int lagrange_double_pendulum(double t, const double y[], double dydt[], void *params);

/* Three uniform rods, the first from the x axis: with phi_i the angles from there and C = (7/3, 3/2, 1/2; 4/3, 1/2; 1/3)
 *
 *     sum_j C_ij cos(phi_i - phi_j) phi_j'' = -sum_j C_ij sin(phi_i - phi_j) phi_j'^2 - (5/2, 3/2, 1/2)_i g cos(phi_i) */
int lagrange_three_rods(double t, const double y[], double dydt[], void *params);

/* A cart of 1/2 kg and a point of 1 kg on a rod without mass, hanging at 0: y = [x, theta, v, omega].
 *
 *     (m + M sin^2) x'' = M sin(theta) (omega^2 + g cos(theta)),   theta'' = -(g sin(theta) + cos(theta) x'') */
int lagrange_cart_pole(double t, const double y[], double dydt[], void *params);

/* A slider-crank of one coordinate, the angle of the crank (r = 0.2 m, 1 kg; rod l = 0.5 m, 1.5 kg; piston 2 kg; a moment
 * of 5 N m on the crank). y and dydt have 6 numbers, as fbd's have: theta, the angle of the rod from the crank and the
 * place of the piston. With T = J(theta) theta'^2 / 2 and V(theta): J theta'' = M - V' - J' theta'^2 / 2. */
int lagrange_slider_crank(double t, const double y[], double dydt[], void *params);

/* The other coordinates and rates from those of the crank, y[0] and y[3]. */
void lagrange_slider_crank_close(double y[]);

#endif
