/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The dependent coordinates of closed loops: beginning with one pin, always the pin with the fewest unknown
 * coordinates is next; of these the two whose slopes have the largest determinant become dependent, the others
 * independent. All pins are tried as the first one (some of them in large scenes), and the order whose smallest
 * determinant is largest is taken.
 */
#include <float.h>
#include <string.h>

#include "dynamics/closed_loops.h"

static int unknown_count(const struct closed_loops *loops, const struct loop_pin *pin)
{
    int count = 0;
    for (int i = 0; i < pin->count; i++) count += !loops->known[pin->arms[i].link];
    return count;
}

/* Equal ones in the order of the scene, so that the choice depends on positions only. */
static int next_pin(const struct closed_loops *loops, int from)
{
    int best = from, fewest = unknown_count(loops, &loops->pins[from]);
    for (int k = from + 1; k < loops->pin_count; k++) {
        int count = unknown_count(loops, &loops->pins[k]);
        if (count > fewest || (count == fewest && loops->pins[k].coupling > loops->pins[best].coupling))
            continue;
        best = k;
        fewest = count;
    }
    return best;
}

static void swap_arms(struct loop_pin *pin, int i, int j)
{
    struct loop_arm arm = pin->arms[i];
    pin->arms[i] = pin->arms[j];
    pin->arms[j] = arm;
}

/* Make two unknown coordinates of the pin its dependent ones; all are known then. Returns the share of their
 * determinant, negative if there are not two. */
static double take_pin(struct closed_loops *loops, struct loop_pin *pin)
{
    int unknown = 0, best[2] = {0, 1};
    double most = -1, longest = 0;
    for (int i = 0; i < pin->count; i++) {
        double unit = loops->unit[pin->arms[i].link];
        longest = fmax(longest, unit * unit * vec_dot(pin->arms[i].slope, pin->arms[i].slope));
        if (!loops->known[pin->arms[i].link]) swap_arms(pin, i, unknown++);
    }
    if (unknown < 2) return -1;
    for (int i = 0; i < unknown; i++)
        for (int j = i + 1; j < unknown; j++) {
            const struct loop_arm *a = &pin->arms[i], *b = &pin->arms[j];
            double size = fabs(vec_cross(a->slope, b->slope)) * loops->unit[a->link] * loops->unit[b->link];
            if (size <= most) continue;
            most = size;
            best[0] = i;
            best[1] = j;
        }
    swap_arms(pin, 0, best[0]);
    swap_arms(pin, 1, best[1]);
    for (int i = 0; i < pin->count; i++) loops->known[pin->arms[i].link] = true;
    return longest > 0 ? most / longest : 0;
}

static void swap_pins(struct closed_loops *loops, int i, int j)
{
    struct loop_pin pin = loops->pins[i];
    loops->pins[i] = loops->pins[j];
    loops->pins[j] = pin;
}

/* Order the pins with this one first. Returns the smallest share, negative if there is no such order. */
static double arrange(struct closed_loops *loops, const struct coupling *start)
{
    double least = 1;
    int next = 0;
    memset(loops->known, 0, (size_t)loops->tree->joined * sizeof *loops->known);
    while (loops->pins[next].coupling != start) next++;
    for (int k = 0; k < loops->pin_count; k++) {
        swap_pins(loops, k, next);
        double share = take_pin(loops, &loops->pins[k]);
        if (share < 0) return -1;
        least = fmin(least, share);
        if (k + 1 < loops->pin_count) next = next_pin(loops, k + 1);
    }
    return least;
}

static void set_independent(struct closed_loops *loops)
{
    bool *dependent = loops->known;
    int count = 0;
    memset(dependent, 0, (size_t)loops->tree->joined * sizeof *dependent);
    for (int k = 0; k < loops->pin_count; k++)
        for (int i = 0; i < 2; i++) dependent[loops->pins[k].arms[i].link] = true;
    for (int i = 1; i < loops->tree->joined; i++)
        if (!dependent[i]) loops->independent[count++] = i;
}

void closed_loops_choose(struct closed_loops *loops)
{
    enum { most_tried = 8 };
    const struct coupling *couplings = loops->tree->couplings;
    double best = -1;
    int start = 0, step = 1 + (loops->pin_count - 1) / most_tried;
    for (int k = 0; k < loops->pin_count; k += step) {
        double share = arrange(loops, &couplings[k]);
        if (share <= best) continue;
        best = share;
        start = k;
    }
    loops->unfit = best < 0;
    if (loops->unfit) return;
    loops->share = loops->chosen = arrange(loops, &couplings[start]);
    set_independent(loops);
}
