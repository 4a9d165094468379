/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pairs of roots between neighbours of the scan.
 *
 * Where |f| at a trial is less than at both of its neighbours and f has one sign at all three, f may have two roots
 * between them: |f| is minimized there (Brent's method, GSL). A first value of the other sign separates the roots. A
 * minimum of zero, to the accuracy of a run, is a double root. Where neighbours are zero, as while a body sticks, the
 * interval between them is a solution, which is given by its ends.
 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <math.h>

#include "study/find.h"

struct dip {
    struct fbd_find *find;
    double sign;        /* of f at the scan */
    double zero;        /* |f| up to this is zero */
    struct trial least; /* with the least sign*f */
    bool failed;        /* memory is out, or it was stopped */
};

static double height(double p, void *context)
{
    struct dip *dip = context;
    struct trial trial;
    if (dip->failed || !find_try(dip->find, p, false, &trial)) dip->failed = true;
    if (dip->failed || !trial.known) return NAN;
    if (dip->sign * trial.f < dip->sign * dip->least.f) dip->least = trial;
    return dip->sign * trial.f;
}

/* Minimize sign*f in (a, c), where b is less than both, until it is below zero. A run without a value ends it. */
static bool minimize(struct dip *dip, const struct trial *a, const struct trial *b, const struct trial *c)
{
    enum { most_iterations = 60 };
    const double share = 1e-6, sign = dip->sign;
    gsl_function function = {height, dip};
    gsl_min_fminimizer *solver = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (!solver) return false;
    int status = gsl_min_fminimizer_set_with_values(solver, &function, b->p, sign * b->f, a->p, sign * a->f,
                                                    c->p, sign * c->f);
    for (int i = 0; status == GSL_SUCCESS && i < most_iterations && sign * dip->least.f >= -dip->zero; i++) {
        status = gsl_min_fminimizer_iterate(solver);
        const double width = gsl_min_fminimizer_x_upper(solver) - gsl_min_fminimizer_x_lower(solver);
        if (width <= share * (c->p - a->p)) break;
    }
    gsl_min_fminimizer_free(solver);
    return !dip->failed;
}

static bool have_one_sign(const struct trial *a, const struct trial *b)
{
    return a->known && b->known && a->f * b->f > 0;
}

bool find_solve_pair(struct fbd_find *find, const struct trial *a, const struct trial *b,
                     const struct trial *c)
{
    const double accuracy = 1e-9, nearest = fmin(fabs(a->f), fabs(c->f));
    if (!find_is_equation(find) || !have_one_sign(a, b) || !have_one_sign(b, c) || !(fabs(b->f) < nearest))
        return true;
    struct dip dip = {find, b->f > 0 ? 1 : -1, accuracy * nearest, *b, false};
    if (!minimize(&dip, a, b, c)) return false;
    if (dip.sign * dip.least.f < -dip.zero)
        return find_solve(find, a, &dip.least) && find_solve(find, &dip.least, c);
    /* The place of a double root is known to the root of that accuracy. */
    return fabs(dip.least.f) > dip.zero || find_add_root(find, &dip.least, sqrt(accuracy) * (c->p - a->p));
}

bool find_solve_end(struct fbd_find *find, const struct trial *end, const struct trial *inner)
{
    const double share = 1e-3;
    struct trial beside;
    if (!find_is_equation(find) || !have_one_sign(end, inner) || !(fabs(end->f) < fabs(inner->f)))
        return true;
    if (!find_try(find, end->p + share * (inner->p - end->p), false, &beside)) return false;
    return end->p < inner->p ? find_solve_pair(find, end, &beside, inner)
                             : find_solve_pair(find, inner, &beside, end);
}

/* ---- intervals in which an equation holds */

static bool is_zero(const struct trial *trial)
{
    return trial && trial->known && trial->f == 0;
}

/* The end of the interval between a zero and a trial that is none; without one, the end of the range. */
static bool add_end(struct fbd_find *find, struct trial zero, const struct trial *other)
{
    double beyond = other ? other->p : zero.p;
    while (fabs(beyond - zero.p) > find_finest(find)) {
        struct trial middle;
        if (!find_try(find, zero.p + (beyond - zero.p) / 2, false, &middle)) return false;
        if (is_zero(&middle))
            zero = middle;
        else
            beyond = middle.p;
    }
    return find_add_root(find, &zero, find_finest(find));
}

bool find_take_zero(struct fbd_find *find, const struct trial *before, const struct trial *trial,
                    const struct trial *after)
{
    double error;
    if (!find_is_equation(find) || !is_zero(trial)) return true;
    if (is_zero(before)) return is_zero(after) || add_end(find, *trial, after);
    if (is_zero(after)) {
        if (!add_end(find, *trial, before)) return false;
        find->solutions[find->solution_count - 1].above = "0 up to the next value";
        return true;
    }
    const double step = (find->to - find->from) / (double)(find->scan - 1);
    const struct trial beside = {.p = trial->p + step};
    return find_root_error(find, trial->p, find_finest(find), trial, &beside, &error) &&
           find_add_root(find, trial, error);
}
