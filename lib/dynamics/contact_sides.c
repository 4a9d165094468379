/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The sides of bars on which points and other bars start: the side of the corner; for a corner on the bar
 * itself the side of the middle of its shape or body; else its previous side, in a continued motion; else the
 * side to which it moves; at rest one of both lies on the other, pressed there by its forces.
 */
#include "dynamics/constraint.h"
#include "dynamics/contact_thin.h"
#include "dynamics/state.h"
#include "numeric/tolerances.h"

/* The shape that lies on the other: a freely moving body on a body with a slide or pivot, and that on the
 * ground; of equals the point on the bar, and the first of `between` on the second. */
static int upper_of(const struct fbd_model *model, const struct meeting *meeting)
{
    int rank[2];
    for (int k = 0; k < 2; k++) {
        int link = meeting->shape[k].link;
        const struct tree_link *root = &model->tree->links[model->tree->links[link].root];
        rank[k] = link == 0 ? 0 : root->kind == motion_planar || root->kind == motion_particle ? 2 : 1;
    }
    if (rank[0] != rank[1]) return rank[0] > rank[1] ? 0 : 1;
    return meeting->shape[1].count < meeting->shape[0].count ? 1 : 0;
}

/* The acceleration of a point on a link, from the present accelerations. */
static struct vec acceleration_of(const struct tree_work *work, int link, struct vec place)
{
    const struct tree_state *s = &work->links[link];
    if (link == 0) return (struct vec){0, 0};
    struct vec r = vec_sub(place, s->p);
    struct vec turning = vec_sub(vec_scale(s->A.alpha, vec_perp(r)), vec_scale(s->omega * s->omega, r));
    return vec_add(s->A.a, turning);
}

/* The sense along n from the lower to the upper one: opposite to the upper one's acceleration, or along the lower one's;
 * 0 without accelerations. */
static int sense_of_upper(const struct fbd_model *model, const struct tree_work *work,
                          const struct meeting *meeting, struct vec place, struct vec n)
{
    int upper = upper_of(model, meeting);
    double a[2], most = 0;
    for (int k = 0; k < 2; k++) {
        struct vec A = acceleration_of(work, meeting->shape[k].link, place);
        a[k] = vec_dot(n, A);
        most = fmax(most, vec_norm(A));
    }
    if (fabs(a[upper]) > undecided_part * most) return a[upper] < 0 ? 1 : -1;
    if (fabs(a[1 - upper]) > undecided_part * most) return a[1 - upper] > 0 ? 1 : -1;
    return 0;
}

static struct vec left_of_bar(const struct tree_work *work, const struct meeting *meeting,
                              struct thin_corner corner)
{
    const struct touch touch = meeting_touch(meeting, thin_feature(corner, thin_right));
    return vec_turn(work->links[meeting->shape[1 - corner.moving].link].turn, vec_perp(touch.e));
}

/* By the centre of mass of the body of the corner; 0 if that is at the corner, or on the bar. */
static double side_of_mass(const struct fbd_model *model, const struct tree_work *work,
                           const struct meeting *meeting, struct thin_corner corner, struct vec n)
{
    const struct contact_shape *shape = &meeting->shape[corner.moving];
    const struct tree_link *link = &model->tree->links[shape->link];
    if (shape->link == 0 || !(link->mass > 0)) return 0;
    struct vec arm = vec_sub(vec_scale(1 / link->mass, link->moment), shape->corners[corner.corner]);
    return vec_dot(n, vec_turn(work->links[shape->link].turn, arm));
}

/* Positive on the left, negative on the right; 0 if position and mass do not decide. */
static double side_by_place(const struct fbd_model *model, const struct tree_work *work, int index, int probe,
                            double near)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    struct thin_corner corner = thin_corner_of(meeting, probe);
    struct vec n = left_of_bar(work, meeting, corner);
    double left = feature_gap(model, work, index, thin_feature(corner, thin_left)).x;
    if (fabs(left) > near) return left;
    double middle = thin_middle(model, work, index, probe);
    if (fabs(middle) > near) return middle;
    double mass = side_of_mass(model, work, meeting, corner, n);
    return fabs(mass) > near ? mass : 0;
}

/* The rate at which the corner moves to the left of the bar; 0 at rest. */
static double side_by_motion(const struct fbd_model *model, const struct tree_work *work, int index,
                             int probe)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    int feature = thin_feature(thin_corner_of(meeting, probe), thin_left);
    double rate = feature_gap(model, work, index, feature).rate;
    return fabs(rate) > solved_rounding * meeting_speed(work, meeting) ? rate : 0;
}

/* Positive on the left, negative on the right; 0 if only forces decide. */
static double side_at_start(const struct fbd_model *model, const struct tree_work *work, int index, int probe,
                            double near)
{
    double side = side_by_place(model, work, index, probe, near);
    if (side != 0) return side;
    if (work->kept) return *thin_side_of(model, work, index, probe);
    return side_by_motion(model, work, index, probe);
}

/* Is the corner outside of the circle round the bar, or at its end face? */
static bool has_no_side(const struct fbd_model *model, const struct tree_work *work, int index, int probe,
                        double near)
{
    struct thin_corner corner = thin_corner_of(&model->tree->meetings[index], probe);
    return feature_gap(model, work, index, thin_feature(corner, thin_round)).x > near ||
           thin_is_in_line(model, work, index, probe, near);
}

/* By the forces; 0 without. Accelerations are those of the state. */
static int side_by_forces(const struct fbd_model *model, const struct tree_work *work, int index, int probe)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    struct thin_corner corner = thin_corner_of(meeting, probe);
    struct vec n = left_of_bar(work, meeting, corner);
    struct vec place = feature_place(model, work, index, thin_feature(corner, thin_left));
    int sense = sense_of_upper(model, work, meeting, place, n);
    return upper_of(model, meeting) == corner.moving ? sense : -sense;
}

/* Without forces the shape that lies on the other is above it. */
static int upper_side(const struct fbd_model *model, const struct tree_work *work, int index, int probe)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    struct thin_corner corner = thin_corner_of(meeting, probe);
    int up = left_of_bar(work, meeting, corner).y >= 0 ? 1 : -1;
    return upper_of(model, meeting) == corner.moving ? up : -up;
}

void thin_choose_sides(struct fbd_state *state, int index, double near)
{
    const struct fbd_model *model = state->model;
    bool evaluated = false;
    for (int probe = 0; probe < model->tree->meetings[index].probes; probe++) {
        int *side = thin_side_of(model, state->tree, index, probe);
        double start = 0;
        bool none = has_no_side(model, state->tree, index, probe, near);
        if (!none) start = side_at_start(model, state->tree, index, probe, near);
        *side = start > 0 ? 1 : start < 0 ? -1 : 0;
        if (none || start != 0) continue;
        if (!evaluated) state_evaluate_unshared(state);
        evaluated = true;
        *side = side_by_forces(model, state->tree, index, probe);
        if (*side == 0) *side = upper_side(model, state->tree, index, probe);
    }
}

bool thin_moves_against_forces(struct fbd_state *state, int index, double near)
{
    const struct fbd_model *model = state->model;
    const struct tree_work *work = state->tree;
    for (int probe = 0; probe < model->tree->meetings[index].probes; probe++) {
        if (has_no_side(model, work, index, probe, near) ||
            side_by_place(model, work, index, probe, near) != 0)
            continue;
        if (side_by_motion(model, work, index, probe) * side_by_forces(model, work, index, probe) < 0)
            return true;
    }
    return false;
}
