/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Contacts at the start of the scene or of a continued motion: the side of a line on which a body is, the
 * touching contacts at rest, and penetrations.
 */
#include <float.h>

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/contact_thin.h"
#include "dynamics/project.h"
#include "numeric/tolerances.h"

static struct vec in_world(const struct tree_work *work, int link, struct vec own)
{
    return vec_add(work->links[link].p, vec_turn(work->links[link].turn, own));
}

/* Numbers of a start have the accuracy of a file: the level of surfaces. */
static const double start_share = contact_level / contact_near;

/* The largest overlap of shapes in a run; a larger one is due to a missed impact. */
static const double run_share = 1e3;

/* Choose the side of a line on which a body stays: the given one, or that of its shape's middle. A point on
 * the line up to rounding in the file, within a share of its distance from the centre of mass, is on the side
 * of that centre: a body placed on the line must not be on its other side by a rounding; nor must a particle,
 * which has no other point. */
static void choose_side(const struct fbd_model *model, struct tree_work *work, int index)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    const struct contact_shape *body = &meeting->shape[0], *line = &meeting->shape[1];
    if (line->kind != contact_line || work->kept) return;
    const struct tree_link *link = &model->tree->links[body->link];
    struct vec n = vec_turn(work->links[line->link].turn, vec_perp(line->e));
    struct vec at = in_world(work, line->link, line->center), G = vec_scale(1 / link->mass, link->moment);
    struct vec middle = vec_sub(in_world(work, body->link, body->center), at);
    struct vec mass = vec_sub(in_world(work, body->link, G), at);
    double side = vec_dot(n, middle);
    int told = model->scene->constraints[meeting->constraint].contact.side;
    if (fabs(side) <= six_digits * vec_norm(vec_sub(mass, middle))) side = vec_dot(n, mass);
    bool on = fabs(side) <= start_share * meeting_near(model, work, index);
    if (on) side = n.y >= 0 ? 1 : -1; /* a point on the line is above it */
    if (told != 0) side = told;
    for (int k = 0; k < meeting->coupling_count; k++)
        work->couplings[meeting->first_coupling + k].side[0] = side < 0 ? -1 : 1;
}

/* Is the feature at rest, within the rounding of speeds? */
static bool rests(const struct fbd_model *model, const struct tree_work *work, int index, int feature)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    return fabs(feature_gap(model, work, index, feature).rate) <=
           solved_rounding * meeting_speed(work, meeting);
}

static void open_meeting(struct fbd_state *state, int index)
{
    const struct tree *tree = state->model->tree;
    const struct meeting *meeting = &tree->meetings[index];
    for (int k = 0; k < meeting->coupling_count; k++) {
        state->slip[tree->couplings[meeting->first_coupling + k].surface] = slip_plus;
        state->tree->couplings[meeting->first_coupling + k].feature = no_feature;
    }
}

static void start_meeting(struct fbd_state *state, int index)
{
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    const struct meeting *meeting = &tree->meetings[index];
    double near = start_share * meeting_near(model, state->tree, index);
    if (meeting->thin)
        thin_choose_sides(state, index, near);
    else
        choose_side(model, state->tree, index);
    int features[2], count = meeting_touching(model, state->tree, index, near, features);
    const struct instant at = state_instant(state);
    for (int k = 0; k < count; k++) {
        if (!rests(model, state->tree, index, features[k])) continue;
        coupling_set_feature(model, &at, meeting->first_coupling + k, features[k]);
        state->slip[tree->couplings[meeting->first_coupling + k].surface] = stick;
    }
}

int contacts_side_in_doubt(struct fbd_state *state)
{
    const struct tree *tree = state->model->tree;
    for (int i = 0; i < tree->meeting_count; i++)
        if (tree->meetings[i].thin &&
            thin_moves_against_forces(state, i, start_share * meeting_near(state->model, state->tree, i)))
            return i;
    return -1;
}

void contacts_start(struct fbd_state *state)
{
    const struct tree *tree = state->model->tree;
    if (tree->meeting_count == 0) return;
    struct instant at = state_instant(state);
    tree_move(state->model, &at);
    for (int i = 0; i < tree->meeting_count; i++) open_meeting(state, i);
    for (int i = 0; i < tree->meeting_count; i++) start_meeting(state, i);
}

/* Close penetrating features, and those that touch: their positions are constraints of the projection. */
static void close_for_lifting(struct fbd_state *state, int index)
{
    const struct fbd_model *model = state->model;
    const struct meeting *meeting = &model->tree->meetings[index];
    double near = meeting_near(model, state->tree, index);
    int features[2], count = meeting_touching(model, state->tree, index, start_share * near, features);
    const struct instant at = state_instant(state);
    for (int k = 0; k < meeting->coupling_count; k++) {
        if (k >= count || feature_gap(model, state->tree, index, features[k]).x > near) continue;
        coupling_set_feature(model, &at, meeting->first_coupling + k, features[k]);
        state->slip[model->tree->couplings[meeting->first_coupling + k].surface] = stick;
    }
}

static void open_all(struct fbd_state *state)
{
    const struct instant at = state_instant(state);
    tree_move(state->model, &at);
    for (int i = 0; i < state->model->tree->meeting_count; i++) open_meeting(state, i);
}

bool contacts_are_deep(struct fbd_state *state)
{
    const struct tree *tree = state->model->tree;
    const struct instant at = state_instant(state);
    bool deep = false;
    if (tree->meeting_count == 0) return false;
    open_all(state);
    for (int i = 0; i < tree->meeting_count; i++)
        deep |= meeting_depth(state->model, &at, i) > meeting_near(state->model, state->tree, i);
    contacts_start(state);
    return deep;
}

void contacts_lift_out(struct fbd_state *state)
{
    open_all(state);
    for (int i = 0; i < state->model->tree->meeting_count; i++) close_for_lifting(state, i);
    state_project_position(state);
    contacts_start(state);
}

int contacts_overlap(struct fbd_state *state, double *depth)
{
    const struct tree *tree = state->model->tree;
    int worst = -1;
    *depth = 0;
    if (tree->meeting_count == 0) return -1;
    struct instant at = state_instant(state);
    tree_move(state->model, &at);
    for (int i = 0; i < tree->meeting_count; i++) {
        double deep = meeting_depth(state->model, &at, i);
        if (tree->meetings[i].thin) deep = fmax(deep, thin_crossing(state->model, state->tree, i));
        if (deep <= run_share * meeting_near(state->model, state->tree, i) || deep <= *depth) continue;
        *depth = deep;
        worst = i;
    }
    return worst;
}
