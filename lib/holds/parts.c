/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "holds/parts.h"

#include <math.h>
#include <stdlib.h>

int parts_find(int count, bool (*meet)(const void *context, int i, int j), const void *context, int *part)
{
    int parts = 0;
    for (int i = 0; i < count; i++) part[i] = -1;
    for (int first = 0; first < count; first++) {
        if (part[first] >= 0) continue;
        part[first] = parts;
        for (bool grown = true; grown;) {
            grown = false;
            for (int i = 0; i < count; i++)
                for (int j = 0; j < count && part[i] == parts; j++) {
                    if (part[j] >= 0 || !meet(context, i, j)) continue;
                    part[j] = parts;
                    grown = true;
                }
        }
        parts++;
    }
    return parts;
}

/* ---- the parts of a problem: its constraints, then its guides */

static bool bears_on(const struct hold_problem *problem, size_t guide, size_t i)
{
    const struct hold *hold = &problem->holds[i];
    bool rubs = hold->kind == hold_friction && hold->press == press_guide && hold->presses == (int)guide;
    return rubs || problem->B[guide * problem->count + i] != 0;
}

static bool presses(const struct hold *hold, size_t by)
{
    return hold->kind == hold_friction && hold->press == press_hold && hold->presses == (int)by;
}

static bool feel_each_other(const void *context, int first, int second)
{
    const struct hold_problem *problem = context;
    size_t n = problem->count, i = (size_t)first, j = (size_t)second;
    if (i >= n && j >= n) return false;
    if (i >= n) return bears_on(problem, i - n, j);
    if (j >= n) return bears_on(problem, j - n, i);
    return problem->A[i * n + j] != 0 || problem->A[j * n + i] != 0 || presses(&problem->holds[i], j) ||
           presses(&problem->holds[j], i);
}

/* Constraints and guides of one part, and their indices in it. */
struct members {
    int count, guide_count;
    int *holds, *guides, *at;
};

static void set_members(const struct hold_problem *problem, const int *part, int which,
                        struct members *members)
{
    members->count = members->guide_count = 0;
    for (int i = 0; i < (int)problem->count; i++) {
        if (part[i] != which) continue;
        members->at[i] = members->count;
        members->holds[members->count++] = i;
    }
    for (int g = 0; g < (int)problem->guide_count; g++) {
        if (part[(int)problem->count + g] != which) continue;
        members->at[(int)problem->count + g] = members->guide_count;
        members->guides[members->guide_count++] = g;
    }
}

static void take_out(const struct hold_problem *problem, const struct members *members,
                     struct hold_problem *alone)
{
    size_t n = problem->count;
    for (size_t i = 0; i < alone->count; i++) {
        size_t from = (size_t)members->holds[i];
        struct hold *hold = &alone->holds[i];
        *hold = problem->holds[from];
        if (hold->press == press_hold) hold->presses = members->at[hold->presses];
        if (hold->press == press_guide) hold->presses = members->at[(int)n + hold->presses];
        for (size_t j = 0; j < alone->count; j++)
            alone->A[i * alone->count + j] = problem->A[from * n + (size_t)members->holds[j]];
    }
    for (size_t g = 0; g < alone->guide_count; g++) {
        size_t from = (size_t)members->guides[g];
        alone->guides[g] = problem->guides[from];
        for (size_t j = 0; j < alone->count; j++)
            alone->B[g * alone->count + j] = problem->B[from * n + (size_t)members->holds[j]];
    }
}

/* Copy results only; `presses` refers to indices within the part. */
static void put_back(struct hold_problem *problem, const struct members *members,
                     const struct hold_problem *alone)
{
    for (size_t i = 0; i < alone->count; i++) {
        struct hold *hold = &problem->holds[members->holds[i]];
        hold->mode = alone->holds[i].mode;
        hold->force = alone->holds[i].force;
        hold->c = alone->holds[i].c;
    }
    for (size_t g = 0; g < alone->guide_count; g++)
        problem->guides[members->guides[g]].N = alone->guides[g].N;
}

static enum holds_found decide_apart(struct hold_problem *problem, const struct members *members,
                                     enum holds_found (*decide)(struct hold_problem *problem))
{
    struct hold_problem alone;
    if (!holds_new(&alone, (size_t)members->count, (size_t)members->guide_count)) return holds_no_memory;
    alone.beside_c = problem->beside_c;
    alone.beside_force = problem->beside_force;
    take_out(problem, members, &alone);
    enum holds_found found = decide(&alone);
    put_back(problem, members, &alone);
    holds_free(&alone);
    return found;
}

/* Round-off levels of each part are relative to the sizes of the whole. */
static void set_sizes(struct hold_problem *problem)
{
    for (size_t i = 0; i < problem->count; i++) {
        double free = fabs(problem->holds[i].free), own = problem->A[i * problem->count + i];
        problem->beside_c = fmax(problem->beside_c, holds_weight(problem, i) * free);
        if (own > 0) problem->beside_force = fmax(problem->beside_force, free / own);
    }
}

enum holds_found parts_decide(struct hold_problem *problem,
                              enum holds_found (*decide)(struct hold_problem *problem))
{
    size_t all = problem->count + problem->guide_count;
    int *part = calloc(3 * all + 1, sizeof *part);
    if (!part) return holds_no_memory;
    struct members members = {.at = part + all, .holds = part + 2 * all};
    enum holds_found found = holds_decided;
    int parts = parts_find((int)all, feel_each_other, problem, part);
    if (parts <= 1) found = decide(problem);
    if (parts > 1) set_sizes(problem);
    for (int p = 0; p < parts && parts > 1; p++) {
        members.guides = members.holds + problem->count;
        set_members(problem, part, p, &members);
        enum holds_found one = decide_apart(problem, &members, decide);
        if (one > found) found = one;
    }
    free(part);
    return found;
}
