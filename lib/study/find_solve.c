/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Solutions between two trials of the scan that differ.
 */
#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>
#include <string.h>

#include "study/find.h"

/* The width of the last bracket, a share of the range, or the rounding of the parameter. For outcomes above the
 * tolerance by which modes are decided: 1e-12 of the forces, which in a coefficient of friction of 0.03 is 3e-11 of it. */
double find_finest(const struct fbd_find *find)
{
    const double outcome = 1e-10, equation = 1e-12;
    const double range = find->to - find->from, end = fmax(fabs(find->from), fabs(find->to));
    if (find_is_equation(find)) return fmax(equation * range, 4 * DBL_EPSILON * end);
    return outcome * fmax(range, end);
}

static double scan_step(const struct fbd_find *find)
{
    return (find->to - find->from) / (double)(find->scan - 1);
}

static bool add_solution(struct fbd_find *find, const fbd_solution *solution)
{
    if (find->solution_count == find->solution_room) {
        const size_t room = find->solution_room ? 2 * find->solution_room : 16;
        fbd_solution *larger = ARENA_ARRAY(&find->arena, room, fbd_solution);
        if (!larger) return false;
        if (find->solution_count) memcpy(larger, find->solutions, find->solution_count * sizeof *larger);
        find->solutions = larger;
        find->solution_room = room;
    }
    find->solutions[find->solution_count++] = *solution;
    return solution->below && solution->above;
}

/* ---- outcomes */

/* Halve the interval in which the outcome of `low` ends; `high` receives the one after it. An unknown trial is
 * noted, and ends it with *lost. */
static bool bisect(struct fbd_find *find, struct trial *low, struct trial *high, bool *lost)
{
    while (high->p - low->p > find_finest(find)) {
        const double middle = low->p + (high->p - low->p) / 2;
        struct trial trial;
        if (!find_try(find, middle, false, &trial)) return false;
        *lost = !trial.known;
        if (*lost) return find_add_gap(find, &trial);
        if (find_differs(find, low, &trial))
            *high = trial;
        else
            *low = trial;
    }
    return true;
}

/* Does a run of smaller tolerance have the outcome of `low` at p? Returns false as find_try. */
static bool agrees(struct fbd_find *find, double p, const struct trial *low, bool *same)
{
    struct trial trial;
    if (!find_try(find, p, true, &trial)) return false;
    *same = trial.known && !find_differs(find, low, &trial);
    return true;
}

/* Widen the bracket until the outcome changes between its ends in runs of smaller tolerance, too. */
static bool widen(struct fbd_find *find, const struct trial *low, double p, double least, double *error)
{
    bool below = true, above = false;
    *error = least;
    while (*error < scan_step(find)) {
        if (p - *error >= find->from && !agrees(find, p - *error, low, &below)) return false;
        if (p + *error <= find->to && !agrees(find, p + *error, low, &above)) return false;
        if (below && !above) return true;
        *error *= 10;
    }
    *error = scan_step(find);
    return true;
}

/* Does an end of the range alone have its outcome? Without friction nothing slips, in the sense of the words. */
static bool is_end_alone(struct fbd_find *find, const struct trial *low, const struct trial *high)
{
    if (low->p == find->from) find->alone[0] = low->story;
    if (high->p == find->to) find->alone[1] = high->story;
    return low->p == find->from || high->p == find->to;
}

/* Move `high` beyond further changes that are as near as the last bracket is wide: they are one. */
static bool pass_neighbours(struct fbd_find *find, const struct trial *b, struct trial *high)
{
    enum { most_neighbours = 16 };
    for (int i = 0; i < most_neighbours && find_differs(find, high, b); i++) {
        struct trial next;
        const double p = high->p + 2 * find_finest(find);
        if (p >= b->p) return true;
        if (!find_try(find, p, false, &next)) return false;
        if (!next.known || !find_differs(find, high, &next)) return true;
        *high = next;
    }
    return true;
}

/* The stories a little beside the change, where they are those of the outcome and not of its threshold. */
static bool take_stories(struct fbd_find *find, const struct trial *low, const struct trial *high,
                         fbd_solution *solution)
{
    const double share = 1e-6, beside = share * (find->to - find->from);
    struct trial below, above;
    if (find->kind != find_event) return true;
    if (!find_try(find, fmax(find->from, low->p - beside), false, &below) ||
        !find_try(find, fmin(find->to, high->p + beside), false, &above))
        return false;
    if (below.known && !find_differs(find, low, &below)) solution->below = below.story;
    if (above.known && !find_differs(find, high, &above)) solution->above = above.story;
    return true;
}

/* ---- equations */

struct search {
    struct fbd_find *find;
    struct trial last;
    bool failed; /* memory is out, or it was stopped */
};

static double difference(double p, void *context)
{
    struct search *search = context;
    if (!search->failed && !find_try(search->find, p, false, &search->last)) search->failed = true;
    return search->failed || !search->last.known ? NAN : search->last.f;
}

static bool brent(struct search *search, double from, double to, double *low, double *high, double *root)
{
    enum { most_iterations = 100 };
    gsl_function function = {difference, search};
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    int status = solver ? gsl_root_fsolver_set(solver, &function, from, to) : GSL_ENOMEM;
    const double width = find_finest(search->find);
    for (int i = 0; status == GSL_SUCCESS && i < most_iterations; i++) {
        status = gsl_root_fsolver_iterate(solver);
        *low = gsl_root_fsolver_x_lower(solver);
        *high = gsl_root_fsolver_x_upper(solver);
        *root = gsl_root_fsolver_root(solver);
        if (status == GSL_SUCCESS && *high - *low <= width) break;
    }
    if (!solver) search->failed = true;
    gsl_root_fsolver_free(solver);
    return status == GSL_SUCCESS;
}

static const char *difference_text(struct fbd_find *find, const struct trial *trial)
{
    struct text text = {0};
    text_number(&text, trial->f, 6);
    const char *unit = find->formula ? row_formula_unit(find->formula) : "";
    text_printf(&text, unit[0] ? " %s" : "%s", unit);
    const char *kept = text.failed ? NULL : arena_text(&find->arena, text.data, text.length);
    text_free(&text);
    return kept;
}

/* The error of a root: the difference of a run of smaller tolerance there, divided by the slope. Central
 * differences: beside a maximum just above zero the slope changes within little. */
bool find_root_error(struct fbd_find *find, double p, double width, const struct trial *a,
                     const struct trial *b, double *error)
{
    const double share = 1e-3, h = share * (b->p - a->p);
    struct trial tight, above, below;
    *error = width;
    if (find->plan->statics) return true;
    if (!find_try(find, p, true, &tight) || !find_try(find, fmin(p + h, find->to), true, &above) ||
        !find_try(find, fmax(p - h, find->from), true, &below))
        return false;
    const double slope = (above.f - below.f) / (above.p - below.p);
    const bool known = tight.known && isfinite(slope) && slope != 0;
    *error = known ? width + fabs(tight.f / slope) : scan_step(find);
    return true;
}

static bool solve_equation(struct fbd_find *find, const struct trial *a, const struct trial *b)
{
    struct search search = {.find = find};
    double low = a->p, high = b->p, root = a->p;
    if (!brent(&search, a->p, b->p, &low, &high, &root))
        return !search.failed && find_add_gap(find, &search.last);
    struct trial below, above;
    if (!find_try(find, low, false, &below) || !find_try(find, high, false, &above)) return false;
    /* A jump remains as the bracket shrinks; a root has a difference of a share of that between the ends, also
     * one with a vertical tangent. */
    const double share = 1e-4;
    const bool jump = high > low && fabs(above.f - below.f) > share * fabs(b->f - a->f);
    fbd_solution solution = {.kind = jump ? FBD_SOLUTION_JUMP : FBD_SOLUTION_ROOT,
                             .value = root,
                             .below = difference_text(find, jump ? &below : a),
                             .above = difference_text(find, jump ? &above : b)};
    if (jump)
        solution.error = fmax(high - low, find_finest(find));
    else if (!find_root_error(find, root, fmax(high - low, find_finest(find)), a, b, &solution.error))
        return false;
    return add_solution(find, &solution);
}

/* ---- margins of statics */

/* Where a margin is linear between two trials it vanishes at a point in closed form; else by Brent's method.
 * *found stays false where the margin does not change its sign between them, as reactions that equilibrium
 * alone does not determine. */
static bool refine(struct fbd_find *find, const struct trial *a, const struct trial *b, const char *limit,
                   fbd_solution *solution, bool *found)
{
    const double rounding = 1e-12;
    const enum find_kind kind = find->kind;
    struct trial ends[2], middle;
    find->kind = find_limit;
    find->limit = limit;
    bool made = find_try(find, a->p, false, &ends[0]) && find_try(find, b->p, false, &ends[1]) &&
                find_try(find, (a->p + b->p) / 2, false, &middle);
    const double f0 = ends[0].f, f1 = ends[1].f, size = fmax(fabs(f0), fabs(f1));
    if (made && find_differs(find, &ends[0], &ends[1]) && isfinite(f0) && isfinite(f1)) {
        solution->value = a->p + (b->p - a->p) * (f0 / (f0 - f1));
        solution->error = find_finest(find);
        solution->closed_form = fabs(middle.f - (f0 + f1) / 2) <= rounding * size;
        *found = true;
    }
    if (made && *found && !solution->closed_form) {
        struct search search = {.find = find};
        double low = a->p, high = b->p;
        *found = brent(&search, a->p, b->p, &low, &high, &solution->value);
        solution->error = fmax(high - low, find_finest(find));
        made = !search.failed;
    }
    find->kind = kind;
    return made;
}

/* Statics decide equilibrium to 2e-6 of the largest load (fbd_statics_holds). */
static double equilibrium_error(const struct fbd_find *find)
{
    const double share = 4e-6;
    return share * fmax(fabs(find->from), fabs(find->to));
}

/* The same for a change of equilibrium that bisection has found: unless another
 * limit than `limit` is reached there. */
static bool refine_change(struct fbd_find *find, const struct trial *a, const struct trial *b,
                          const char *limit, fbd_solution *solution)
{
    const double share = 1e-4;
    fbd_solution refined = *solution;
    bool found = false;
    if (!refine(find, a, b, limit, &refined, &found)) return false;
    if (found && fabs(refined.value - solution->value) <= share * (b->p - a->p)) *solution = refined;
    return true;
}

/* ---- all of them */

static bool solve_outcome(struct fbd_find *find, const struct trial *a, const struct trial *b)
{
    enum { most_changes = 64 };
    struct trial low = *a;
    for (int i = 0; find_differs(find, &low, b); i++) {
        struct trial high = *b;
        bool lost = false;
        if (i == most_changes) {
            low.reason = "more changes of the outcome between two runs of the scan than are listed";
            low.failed = true;
            return find_add_gap(find, &low);
        }
        const struct trial first = low;
        if (!bisect(find, &low, &high, &lost)) return false;
        if (lost) return true;
        if (is_end_alone(find, &low, &high)) {
            low = high;
            continue;
        }
        if (!pass_neighbours(find, b, &high)) return false;
        fbd_solution solution = {.kind = FBD_SOLUTION_CHANGE,
                                 .value = (low.p + high.p) / 2,
                                 .error = equilibrium_error(find),
                                 .below = low.story,
                                 .above = high.story};
        const bool determinate = first.determinate && b->determinate;
        const char *broken = first.broken ? first.broken : b->broken;
        if (broken && determinate && !refine_change(find, &first, b, broken, &solution)) return false;
        if (find->plan->statics) {
            solution.below = first.story;
            if (!find_differs(find, &high, b)) solution.above = b->story;
        } else if (!take_stories(find, &low, &high, &solution)) {
            return false;
        }
        if (!find->plan->statics && !widen(find, &low, solution.value, high.p - low.p, &solution.error))
            return false;
        if (!add_solution(find, &solution)) return false;
        low = high;
    }
    return true;
}

bool find_solve(struct fbd_find *find, const struct trial *a, const struct trial *b)
{
    if (!a->known || !b->known || !find_differs(find, a, b)) return true;
    if (!find_is_equation(find)) return solve_outcome(find, a, b);
    if (find->kind == find_equation) return solve_equation(find, a, b);
    fbd_solution solution = {.kind = FBD_SOLUTION_ROOT,
                             .below = difference_text(find, a),
                             .above = difference_text(find, b)};
    bool found = false;
    return refine(find, a, b, find->limit, &solution, &found) && (!found || add_solution(find, &solution));
}

bool find_add_root(struct fbd_find *find, const struct trial *trial, double error)
{
    const fbd_solution solution = {.kind = FBD_SOLUTION_ROOT,
                                   .value = trial->p,
                                   .error = error,
                                   .below = difference_text(find, trial),
                                   .above = difference_text(find, trial)};
    return add_solution(find, &solution);
}
