/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A chain of n equal uniform rods hanging from the ground, each pinned to the end of the one before, for
 * several programs that find its accelerations. y[2 n] has the angles, that of the first rod from straight
 * down and those of the others from the rod before, and then their rates.
 */
#ifndef FBD_BENCH_CHAIN_H
#define FBD_BENCH_CHAIN_H

#define CHAIN_MASS    1.0  /* kg, of a rod */
#define CHAIN_LENGTH  0.2  /* m */
#define CHAIN_GRAVITY 9.81 /* m/s^2 */

#ifdef __cplusplus
extern "C" {
#endif

/* One way to find the right-hand side dydt[2 n] from y[2 n]. */
struct chain_solver {
    const char *name;
    void *(*open)(int n); /* NULL when it cannot be had */
    void (*rates)(void *chain, const double *y, double *dydt);
    void (*close)(void *chain);
};

extern const struct chain_solver chain_by_fbd, chain_by_hand, chain_by_mujoco, chain_by_simbody;

#ifdef __cplusplus
}
#endif

#endif
