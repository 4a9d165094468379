/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One right-hand side of a chain of n rods, n = 1 ... 512: ours, the same written by hand for this chain, and
 * MuJoCo and Simbody where they are installed. Each round times all of them one after the other; what is
 * printed is the median time of a rod, and the median over the rounds of the ratios.
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chain.h"
#include "claim.h"
#include "timing.h"

enum { most_rods = 512, states = 4, rounds = 101, most_solvers = 4 };

static const double a_batch = 1e-4; /* s */

/* Ours is first, the yardstick second. `bound` is what the ratio of its time to ours has to reach;
 * `agreement` how far its accelerations may be off, by the largest one: rounding of an O(n) recursion, or of
 * a mass matrix whose condition number grows as n^4. */
struct rival {
    const struct chain_solver *solver;
    double bound, agreement;
};

static const struct rival rivals[] = {
    {&chain_by_fbd, 1, 1e-10},
    {&chain_by_hand, 1 / 1.2, 1e-10},
#ifdef HAVE_MUJOCO
    {&chain_by_mujoco, 5, 1e-6},
#endif
#ifdef HAVE_SIMBODY
    {&chain_by_simbody, 10, 1e-10},
#endif
};
enum { ours, yardstick, solvers = sizeof rivals / sizeof *rivals };

struct inputs {
    double y[states][2 * most_rods];
};

struct times {
    double seconds[most_solvers][rounds], ratio[most_solvers][rounds];
};

/* Processor time of all threads: a busy machine disturbs it least. */
/* The same on every machine: a linear congruential generator, -1 to 1. */
static void fill(struct inputs *inputs)
{
    unsigned long long x = 20;
    for (int k = 0; k < states; k++) {
        for (int i = 0; i < 2 * most_rods; i++) {
            x = x * 6364136223846793005ULL + 1442695040888963407ULL;
            inputs->y[k][i] = (double)(x >> 11) * 0x1p-52 - 1;
        }
    }
}

/* The largest difference from the yardstick over the largest acceleration. */
static double disagreement(const struct chain_solver *solver, void *chain, void *reference, int n,
                           const struct inputs *inputs)
{
    double a[2 * most_rods], b[2 * most_rods], worst = 0;
    for (int k = 0; k < states; k++) {
        double most = 0, off = 0;
        solver->rates(chain, inputs->y[k], a);
        chain_by_hand.rates(reference, inputs->y[k], b);
        for (int i = n; i < 2 * n; i++) {
            most = fmax(most, fabs(b[i]));
            off = fmax(off, fabs(a[i] - b[i]));
        }
        worst = fmax(worst, off / most);
    }
    return worst;
}

/* Seconds of one right-hand side. */
static double time_of(const struct chain_solver *solver, void *chain, int calls, const struct inputs *inputs)
{
    double dydt[2 * most_rods], start = processor_seconds();
    for (int call = 0; call < calls; call++) solver->rates(chain, inputs->y[call % states], dydt);
    return (processor_seconds() - start) / calls;
}

static void measure(void **chains, const struct inputs *inputs, struct times *times)
{
    int calls[solvers];
    for (int s = 0; s < solvers; s++) { /* the first time warms up */
        time_of(rivals[s].solver, chains[s], states, inputs);
        double seconds = time_of(rivals[s].solver, chains[s], states, inputs);
        calls[s] = (int)fmin(1e5, fmax(1, a_batch / seconds));
    }
    for (int round = 0; round < rounds; round++) {
        for (int s = 0; s < solvers; s++) {
            double seconds = time_of(rivals[s].solver, chains[s], calls[s], inputs);
            times->seconds[s][round] = seconds;
            times->ratio[s][round] = seconds / times->seconds[0][round];
        }
    }
}

/* Open a chain for each solver; they have to find the same accelerations. */
static void open_all(int n, const struct inputs *inputs, void **chains)
{
    for (int s = 0; s < solvers; s++) {
        chains[s] = rivals[s].solver->open(n);
        if (chains[s]) continue;
        fprintf(stderr, "%s: no chain of %d rods\n", rivals[s].solver->name, n);
        exit(1);
    }
    for (int s = 0; s < solvers; s++) {
        double off = disagreement(rivals[s].solver, chains[s], chains[yardstick], n, inputs);
        if (off <= rivals[s].agreement) continue;
        fprintf(stderr, "%s: accelerations of %d rods are off by %.2g\n", rivals[s].solver->name, n, off);
        exit(1);
    }
}

/* One line of the table. The time of a rod in ours, and whether all bounds are met. */
static double compare(int n, const struct inputs *inputs, bool *met)
{
    static struct times times;
    void *chains[solvers];
    open_all(n, inputs, chains);
    measure(chains, inputs, &times);
    double a_rod = 0, to_hand = NAN;
    printf("%5d", n);
    for (int s = 0; s < solvers; s++) {
        double ns = 1e9 * median(times.seconds[s], rounds) / n, ratio = median(times.ratio[s], rounds);
        if (s == ours) {
            a_rod = ns;
            printf("  %8.1f", ns);
        } else {
            bool enough = ratio >= rivals[s].bound;
            *met = *met && enough;
            if (s == yardstick) to_hand = 1 / ratio;
            printf("  %8.1f %7.2f %-7s", ns, s == yardstick ? 1 / ratio : ratio, enough ? "met" : "NOT MET");
        }
        rivals[s].solver->close(chains[s]);
    }
    putchar('\n');
    char what[120];
    snprintf(what, sizeof what, "right-hand side: chain of %d rods, beside the recursion by hand", n);
    claim_at_most(what, to_hand, 1 / rivals[yardstick].bound);
    return a_rod;
}

static void heading(void)
{
    printf("one right-hand side of a chain of n rods: ns a rod, medians of %d rounds, and ratios\n    n",
           rounds);
    for (int s = 0; s < solvers; s++)
        printf(s == ours ? "  %8s" : "  %8s                ", rivals[s].solver->name);
    printf("\n               ");
    for (int s = 1; s < solvers; s++) {
        if (s == yardstick) printf("  ours / it <= %-9.3g ", 1 / rivals[s].bound);
        if (s != yardstick) printf("  it / ours >= %-9.3g ", rivals[s].bound);
    }
    putchar('\n');
}

/* For `make verify`: how far the accelerations of each program are from ours, for a chain of ten. */
static int say_agreement(const struct inputs *inputs)
{
    const int n = 10;
    void *chain = rivals[ours].solver->open(n), *hand = rivals[yardstick].solver->open(n);
    if (!chain || !hand) return 1;
    printf("%s %.2g\n", rivals[ours].solver->name, disagreement(rivals[ours].solver, chain, hand, n, inputs));
    for (int s = yardstick + 1; s < solvers; s++) {
        void *other = rivals[s].solver->open(n);
        if (!other) return 1;
        printf("%s %.2g\n", rivals[s].solver->name, disagreement(rivals[s].solver, other, hand, n, inputs));
        rivals[s].solver->close(other);
    }
    rivals[ours].solver->close(chain);
    rivals[yardstick].solver->close(hand);
    return 0;
}

int main(int argc, char **argv)
{
    static struct inputs inputs;
    gsl_set_error_handler_off();
    fill(&inputs);
    if (argc > 1 && strcmp(argv[1], "--agreement") == 0) return say_agreement(&inputs);
    heading();
    bool met = true;
    double least = HUGE_VAL, most = 0;
    for (int n = 1; n <= most_rods; n *= 2) {
        double ns = compare(n, &inputs, &met);
        if (n >= 8) { /* before, what a right-hand side costs without rods shows */
            least = fmin(least, ns);
            most = fmax(most, ns);
        }
    }
    printf("from 8 to %d rods the time of a rod stays within a factor of %.2f\n", most_rods, most / least);
    printf("%s\n", met ? "all bounds are met" : "a bound is NOT MET");
    return 0;
}
