/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Determine the moment point of a line that states one.
 *
 * A sum of moments about one point is as true as that about another. The coefficients of forces in it
 * determine the point: each is the arm about that point. A line is rejected only if it is about another point
 * and not about its own: one in which reactions were eliminated determines none.
 */
#include "base/format.h"
#include "output/hand_suspects.h"

struct pointing {
    struct suspects_look look;
    size_t states;
    bool fits[most_places];
    char names[most_places][sizeof((struct hand_check *)0)->elsewhere];
};

static bool visit(void *context, struct fbd_state *state, const struct hand_named *named, double *y,
                  bool first)
{
    struct pointing *pointing = context;
    struct suspects_look *look = &pointing->look;
    if (first) suspects_close(look);
    if (!suspects_look_at(look, state, named, y)) return false;
    if (look->hand->when && expr_eval(look->hand->when, state->t, y, NULL) == 0) return true;
    for (size_t k = 0; k < look->place_count; k++) {
        if (pointing->states == 0)
            format_into(pointing->names[k], sizeof pointing->names[k], "%s", look->places[k].name);
        pointing->fits[k] = (pointing->fits[k] || pointing->states == 0) && suspects_is_about(look, k);
    }
    pointing->states++;
    return true;
}

bool hand_find_point(struct hand_check *check)
{
    const struct hand *hand = &check->model->scene->bodies[check->body].hands[check->index];
    struct pointing pointing = {.look = {.check = check}};
    if (!hand->about[0]) return true;
    gsl_rng *rng = gsl_rng_clone(check->rng);
    const bool done = rng && hand_each_state(check, rng, visit, &pointing);
    for (size_t k = 1; done && !pointing.fits[0] && k < most_places && !check->elsewhere[0]; k++)
        if (pointing.fits[k]) format_into(check->elsewhere, sizeof check->elsewhere, "%s", pointing.names[k]);
    suspects_close(&pointing.look);
    if (rng) gsl_rng_free(rng);
    return done;
}
