/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * An equation as a linear form of its unknowns, which identifies equations about the same unknowns, and
 * duplicates.
 */
#include <stdint.h>
#include <string.h>

#include "output/hand.h"
#include "output/hand_forces.h"
#include "section/section.h"

static int unknown_of_force(const struct fbd_model *model, int b, size_t arrow, int part)
{
    size_t before = 0;
    for (int other = 0; other < b; other++) before += diagram_arrows(model, other);
    return hand_unknown_force +
           (int)((3 * (before + arrow) + (size_t)part) % (hand_unknowns - hand_unknown_force));
}

/* Add a force that is named by its size, by its components. */
static void add_size(const struct fbd_model *model, int b, const struct arrow *arrow, size_t i, double slope,
                     double *form)
{
    const double size = vec_norm(arrow->force), little = 1e-9; /* round-off level of a direction */
    const double parts[] = {arrow->force.x, arrow->force.y};
    for (int k = 0; k < 2; k++)
        if (fabs(parts[k]) > little * size) form[unknown_of_force(model, b, i, k)] += slope * parts[k] / size;
    if (size == 0) form[unknown_of_force(model, b, i, 2)] += slope;
}

static void add_named(const struct fbd_state *state, const struct hand_force *force, struct arrow *arrows,
                      double slope, double *form)
{
    const int b = force->name.body;
    struct instant at = state_instant(state);
    if (force->part == hand_force_at_x || force->part == hand_force_at_y) return;
    diagram_list(state->model, b, &at, state->slots, arrows);
    if (force->part == hand_force_size)
        add_size(state->model, b, &arrows[force->arrow], force->arrow, slope, form);
    else
        form[unknown_of_force(state->model, b, force->arrow, (int)force->part)] += slope * force->sign;
}

/* The entry of a section force: N, V and M of one section have different ones. */
static int unknown_of_section(const struct absolute *absolute)
{
    const float x = (float)absolute->point.where.x; /* places that differ by rounding are one */
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const uint32_t places = (hand_unknowns - hand_unknown_force) / section_forces,
                   place = ((bits ^ bits >> 16) + (uint32_t)absolute->body) * 2654435761U >> 16;
    return hand_unknown_force + section_forces * (int)(place % places) + absolute->part;
}

/* Add N, the normal force that the body lists. */
static void add_normal(const struct fbd_state *state, int b, struct arrow *arrows, double slope, double *form)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    struct instant at = state_instant(state);
    diagram_list(model, b, &at, state->slots, arrows);
    for (int i = 0; i < body->load_count; i++)
        if (model->loads[body->first_load + i].source->kind == load_normal)
            add_size(model, b, &arrows[i], (size_t)i, slope, form);
}

void hand_form_at(const struct fbd_state *state, int b, int index, const struct hand_named *named,
                  const double *y, double form[hand_unknowns])
{
    const struct fbd_model *model = state->model;
    const struct hand *hand = &model->scene->bodies[b].hands[index];
    const int first = (int)plan_size(&model->plan);
    memset(form, 0, hand_unknowns * sizeof *form);
    for (int k = 0; k < hand_slots + (int)model->absolute_count; k++) {
        double left, right;
        const enum absolute_kind kind =
            k < hand_slots ? absolute_acceleration : model->absolutes[k - hand_slots].kind;
        if (!hand_writes(kind) || kind == absolute_inertia ||
            (k >= hand_mass && k < hand_slots && k != hand_N))
            continue;
        expr_eval_slot(hand->left, state->t, y, 1 + first + k, NULL, &left);
        expr_eval_slot(hand->right, state->t, y, 1 + first + k, NULL, &right);
        const double slope = left - right;
        if (fabs(slope) <= 1e-9 * (fabs(left) + fabs(right))) continue;
        if (kind == absolute_section)
            form[unknown_of_section(&model->scene->absolutes[k - hand_slots])] += slope;
        else if (k == hand_N)
            add_normal(state, b, named->arrows, slope, form);
        else if (kind != absolute_force)
            form[k < hand_mass ? k : most_coordinates_of_a_body] += slope;
        const struct hand_sum *sum = kind == absolute_force ? &named->of[k - hand_slots] : NULL;
        for (size_t i = 0; sum && i < sum->count; i++)
            add_named(state, sum->forces[i], named->arrows, slope * sum->signs[i], form);
    }
}
