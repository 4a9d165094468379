/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A chain of equal uniform rods hanging from the ground, each pinned to the end of the one before, for
 * several programs that find its accelerations. q[0] is the angle of the first rod from straight down, q[i]
 * that of rod i from the rod before; v are their rates.
 */
#ifndef FBD_BENCH_CHAIN_H
#define FBD_BENCH_CHAIN_H

#define CHAIN_MASS    1.0  /* kg, of a rod */
#define CHAIN_LENGTH  0.2  /* m */
#define CHAIN_GRAVITY 9.81 /* m/s^2 */

#ifdef __cplusplus
extern "C" {
#endif

/* One way to find a[n] from q[n] and v[n]. */
struct chain_solver {
    const char *name;
    void *(*open)(int n); /* NULL when it cannot be had */
    void (*accelerations)(void *chain, const double *q, const double *v, double *a);
    void (*close)(void *chain);
};

extern const struct chain_solver chain_by_fbd, chain_by_hand, chain_by_mujoco, chain_by_simbody;

#ifdef __cplusplus
}
#endif

#endif
