/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Round-off levels. A force of a diagram is a sum of products, or an unknown of a solved system: each has an
 * error of `undecided_part` times the largest force on the body. Forces are transmitted from body to body, so
 * for jointed bodies it is the largest force on any of them. The error of a moment about G is the error of
 * the force times its arm, plus the rounding of the arm, a difference of two positions in the world, times
 * the force.
 */
#include "rest/balance.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/block_alloc.h"
#include "dynamics/mass.h"
#include "dynamics/nonfinite.h"
#include "dynamics/rest_system.h"
#include "dynamics/tree.h"
#include "expr/unit.h"
#include "numeric/tolerances.h"

/* Loads and motion of one body: residuals, and the sizes of their terms. */
struct sums {
    struct vec m_a, f; /* mass times acceleration; sum of forces */
    double I_alpha, M;
    double force, moment; /* sums of the sizes of all terms */
    double reach;         /* the longest arm */
    double place;         /* rounding of arms, as a moment */
};

/* The force of a Filippov sliding mode may nearly vanish; its error is relative to the forces of both
 * branches: the size of their effect on the coordinates of the body, as forces or moments. */
static double slid_size(const struct fbd_state *state, const struct model_body *body)
{
    const struct plan *plan = &state->model->plan;
    const struct sliding *s = state_sliding(state);
    double size = 0;
    for (int unit = 0; s && body->alone && unit < s->units; unit++)
        for (int i = body->first; i < body->first + body->count; i++)
            if (plan->inverse_inertia[i] > 0)
                size += fabs(s->B[unit * plan->n + i]) / plan->inverse_inertia[i];
    return size;
}

static struct sums sums_of(const struct fbd_state *state, int b)
{
    struct arrow *arrows = state->arrows;
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    const struct instant at = state_instant(state);
    const struct pose pose = body_pose(body, &at);
    const struct vec G = point_motion(body, &pose, body->inertia.G).p;
    struct sums sums = {.m_a = vec_scale(body_mass(body, &at), mass_center_acceleration(body, &at))};
    sums.I_alpha = body_inertia(body, &at).I_G * body_angular_acceleration(body, &at);
    double slid = slid_size(state, body);
    const double arm_of_G = body_is_off_center(body) ? vec_norm(body->arm) : 0;
    /* The acceleration of a centre of mass beside O is the difference of that of O and omega^2 r. */
    sums.force = vec_norm(sums.m_a) + slid + body_mass(body, &at) * pose.omega * pose.omega * arm_of_G;
    sums.moment = fabs(sums.I_alpha) + slid;
    size_t count = diagram_list(model, b, &at, state->slots, arrows);
    for (size_t i = 0; i < count; i++) {
        const struct arrow *arrow = &arrows[i];
        double size = vec_norm(arrow->force), arm = vec_norm(vec_sub(arrow->point, G));
        sums.f = vec_add(sums.f, arrow->force);
        sums.M += arrow_moment(arrow, G);
        sums.force += size;
        sums.moment += fabs(arrow->couple) + arm * size;
        sums.reach = fmax(sums.reach, arm);
        sums.place += round_off(1, vec_norm(arrow->point) + vec_norm(G)) * size;
    }
    if (body_never_turns(body)) sums.M = sums.I_alpha = 0;
    return sums;
}

struct worst {
    int body;
    double ratio, is, sum, explained; /* residual over round-off; left and right side; round-off */
    const char *what;
    bool moment;
};

static void compare(struct worst *worst, int body, const char *what, bool moment, double is, double sum,
                    double explained)
{
    double off = fabs(is - sum);
    /* NaN passes; below the least normal number there is no relative rounding. */
    if (off <= worst->ratio * explained || off <= DBL_MIN) return;
    *worst =
        (struct worst){body, explained > 0 ? off / explained : HUGE_VAL, is, sum, explained, what, moment};
}

/* Errors of forces and moments of jointed bodies. */
struct answer_levels {
    double force, moment;
};

/* At the inflection of a curve normal force and rotation vanish; their error is relative to those of a circle
 * of the same length. */
static double turn_of_track(const struct fbd_state *state, const struct model_body *body)
{
    if (body->joint->path != path_curve) return 0;
    const struct tree_track *track = state->model->tree->links[body->place.link].track;
    return fabs(state->y[state->model->plan.n + body->first]) / track->curve->length;
}

/* The largest force on any of the jointed bodies counts, with the error of directions where bodies are small
 * compared with their distance from the origin. Accelerations are sums, too, of those of the parent bodies
 * and of the terms of their rotation, at the present speed and distance: a body without forces has m a = 0
 * only to the rounding of m times these. */
static struct answer_levels joined_level(const struct fbd_state *state)
{
    const struct tree *tree = state->model->tree;
    const struct tree_work *work = state->tree;
    double force = 0, reach = 0, away = 0, mass = 0, inertia = 0, a = 0, alpha = 0, v = 0, omega = 0, d = 0;
    for (int i = 0; i < tree->joined_count; i++) {
        const struct model_body *body = &state->model->bodies[tree->bodies[i]];
        const struct tree_state *link = &work->links[body->place.link];
        struct sums sums = sums_of(state, tree->bodies[i]);
        force = fmax(force, sums.force);
        reach = fmax(reach, sums.reach);
        away = fmax(away, vec_norm(link->p));
        mass = fmax(mass, body->inertia.mass);
        inertia = fmax(inertia, body->inertia.I_G);
        a = fmax(a, vec_norm(link->A.a));
        alpha = fmax(alpha, fabs(link->A.alpha));
        v = fmax(v, vec_norm(link->v));
        d = fmax(d, vec_norm(link->d));
        omega = fmax(omega, fmax(fabs(link->omega), turn_of_track(state, body)));
    }
    if (work->shared) force = fmax(force, work->shared_size);
    force += mass * (a + omega * v + d * (alpha + omega * omega));
    force *= undecided_part + (reach > 0 ? round_off(64, away) / reach : 0);
    double gyration = mass > 0 ? sqrt(inertia / mass) : 0;
    return (struct answer_levels){force, force * fmax(reach, gyration) +
                                             undecided_part * inertia * (alpha + omega * omega)};
}

static void say(const struct fbd_state *state, const struct worst *worst, struct text *lack)
{
    const struct fbd_model *model = state->model;
    char unit[48];
    unit_name(worst->moment ? DIM_MOMENT : DIM_FORCE, model->scene->units, unit, sizeof unit);
    text_printf(
        lack,
        "at t = %.9g the forces on `%s` do not account for its motion: %s is %.9g %s, their sum %.9g %s. "
        "They differ by %.3g %s, where rounding explains %.1g %s: no forces were found that agree with the "
        "modes of its couplings and its friction",
        state->t, model->bodies[worst->body].name, worst->what, worst->is, unit, worst->sum, unit,
        fabs(worst->is - worst->sum), unit, worst->explained, unit);
}

/* Changes of the inertia force and moment of each body when each number of the state changes by one rounding,
 * which stiff springs for example amplify: the forces of two evaluations differ by that. NULL without memory.
 */
static struct answer_levels *find_answers(const struct fbd_state *state)
{
    const size_t bodies = state->model->body_count;
    struct answer_levels *answers = block_alloc((bodies + 1) * sizeof *answers);
    struct fbd_state *here = state_new(state->model), *there = state_new(state->model);
    const bool made = answers && here && there;
    if (made) {
        state_copy(here, state);
        state_evaluate(here); /* evaluated anew, like the perturbed states */
    } else {
        free(answers);
        answers = NULL;
    }
    for (size_t i = 0; made && i < plan_size(&state->model->plan); i++) {
        state_copy(there, state);
        there->y[i] += round_off(1, fabs(state->y[i]));
        state_evaluate(there);
        for (size_t b = 0; b < bodies; b++) {
            struct sums still = sums_of(here, (int)b), moved = sums_of(there, (int)b);
            double force = vec_norm(vec_sub(moved.m_a, still.m_a)),
                   moment = fabs(moved.I_alpha - still.I_alpha);
            if (isfinite(force)) answers[b].force += force;
            if (isfinite(moment)) answers[b].moment += moment;
        }
    }
    state_free(here);
    state_free(there);
    return answers;
}

/* The equation with the largest residual relative to round-off, at least `joined` for a jointed body; none if
 * all are below. `answers` may be NULL. */
static struct worst find_worst(const struct fbd_state *state, struct answer_levels joined,
                               const struct answer_levels *answers)
{
    const double roundings = 16;
    struct worst worst = {.ratio = 1};
    for (int b = 0; b < (int)state->model->body_count; b++) {
        struct sums sums = sums_of(state, b);
        double force = undecided_part * sums.force;
        bool jointed = !state->model->bodies[b].alone;
        if (jointed) force = fmax(force, joined.force);
        double moment = undecided_part * sums.moment + force * sums.reach + 64 * sums.place;
        if (jointed) moment = fmax(moment, joined.moment);
        if (answers) {
            force += roundings * answers[b].force;
            moment += roundings * (answers[b].force * sums.reach + answers[b].moment);
        }
        compare(&worst, b, "m a in x", false, sums.m_a.x, sums.f.x, force);
        compare(&worst, b, "m a in y", false, sums.m_a.y, sums.f.y, force);
        compare(&worst, b, "I alpha about G", true, sums.I_alpha, sums.M, moment);
    }
    return worst;
}

bool balance_lack(struct fbd_state *state, struct text *lack)
{
    struct unresisted motion;
    if (state_is_unresisted(state, &motion)) {
        text_printf(lack, "at t = %.9g %s: give that body a small mass, or end the run before by an event",
                    state->t, motion.text);
        return true;
    }
    struct instant at = state_instant(state);
    bool used = !state->tree->complete || (!state->tree->shared && rest_is_open(state->model, &at));
    if (used) state_evaluate(state); /* its scratch was overwritten */
    struct worst worst = find_worst(state, (struct answer_levels){0, 0}, NULL);
    if (!worst.what) return false; /* nearly always; the levels of jointed bodies are not needed */
    const struct answer_levels joined = joined_level(state);
    worst = find_worst(state, joined, NULL);
    if (!worst.what) return false;
    struct answer_levels *answers = find_answers(state);
    if (!answers) {
        lack->failed = true;
        return true;
    }
    worst = find_worst(state, joined, answers);
    free(answers);
    if (worst.what) say(state, &worst, lack);
    return worst.what != NULL;
}

double balance_size(const struct fbd_state *state)
{
    const struct instant at = state_instant(state);
    double size = 0;
    for (int b = 0; b < (int)state->model->body_count; b++) {
        const struct model_body *body = &state->model->bodies[b];
        const struct sums sums = sums_of(state, b);
        const double m = body_mass(body, &at), I_G = body_inertia(body, &at).I_G;
        if (m > 0) size = fmax(size, sums.force / m);
        if (I_G > 0) size = fmax(size, sums.moment / I_G);
    }
    return size;
}
