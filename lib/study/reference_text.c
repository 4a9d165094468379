/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A description of the reference, in sentences.
 */
#include <math.h>

#include "study/cost.h"

static const char *pair_says(struct arena *arena, const struct certified_reference *reference)
{
    const struct setting *a = &reference->settings[0], *b = &reference->settings[1];
    return arena_printf(arena, "%s at tolerance %.0e and %s at %.0e differ by %.1e", a->method, a->tolerance,
                        b->method, b->tolerance, reference->whole_floor);
}

static const char *exact_says(struct arena *arena, const struct certified_reference *reference,
                              const fbd_model *model)
{
    const char *quantity = quantity_name_of(model, reference->exact_worst);
    if (reference->exact_differs && isinf(reference->exact_error))
        return arena_printf(
            arena, "The solution that the file gives for %s has no value at t = %.4g s. It is not used. ",
            quantity, reference->exact_from);
    if (reference->exact_differs)
        return arena_printf(
            arena,
            "The solution that the file gives for %s is not that of the scene: it differs by %.2g "
            "(scaled) from t = %.4g s on, while two methods agree. It is not used. ",
            quantity, reference->exact_error, reference->exact_from);
    if (reference->all_exact) return "The exact solution of the file, which the runs confirm. ";
    return "The exact solution of the file where it gives one. ";
}

/* The reason why it is accurate only for a part of the run. */
static const char *cut_says(struct arena *arena, const struct certified_reference *reference)
{
    const double shrinks = 0.1;
    bool better = reference->whole_floor < shrinks * reference->loose_floor;
    const char *tenfold =
        isnan(reference->tenfold)
            ? ""
            : arena_printf(arena,
                           " Differences grow tenfold in %.3g s: the motion is sensitive to disturbances.",
                           reference->tenfold);
    const char *why = better ? "tighter tolerances still bring them nearer"
                      : isnan(reference->tenfold)
                          ? "tighter tolerances do not bring them nearer: the scene does not converge"
                          : "tighter tolerances do not bring them nearer: the motion is chaotic or unstable";
    if (!tenfold) return NULL;
    return arena_printf(arena,
                        " That is no reference for the whole run; %s.%s Up to t = %.4g s they agree to 1e-6, "
                        "and errors are taken up to there.",
                        why, tenfold, reference->known);
}

const char *reference_says(struct arena *arena, const struct certified_reference *reference,
                           const fbd_model *model)
{
    const char *exact = "", *pair = pair_says(arena, reference), *rest;
    if (reference->any_exact || reference->exact_differs) exact = exact_says(arena, reference, model);
    if (reference->cut)
        rest = cut_says(arena, reference);
    else if (!isnan(reference->tenfold))
        rest = arena_printf(arena,
                            ". Differences grow tenfold in %.3g s: the motion is sensitive to disturbances.",
                            reference->tenfold);
    else
        rest = ".";
    if (!exact || !pair || !rest) return NULL;
    return arena_printf(arena, "%sOf five methods %s%s%s", exact, pair, reference->cut ? "." : "", rest);
}
