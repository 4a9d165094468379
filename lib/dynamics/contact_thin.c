/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/contact_thin.h"

#include "dynamics/constraint.h"
#include "numeric/tolerances.h"

static const struct meeting *meeting_of(const struct fbd_model *model, int index)
{
    return &model->tree->meetings[index];
}

int *thin_side_of(const struct fbd_model *model, const struct tree_work *work, int index, int probe)
{
    return &work->couplings[meeting_of(model, index)->first_coupling + probe / 2].side[probe % 2];
}

static struct gap gap_at(const struct fbd_model *model, const struct tree_work *work, int index, int probe,
                         enum thin_side side)
{
    struct thin_corner corner = thin_corner_of(meeting_of(model, index), probe);
    return feature_gap(model, work, index, thin_feature(corner, side));
}

/* From the bar, on the side on which the corner is. */
static struct gap gap_at_side(const struct fbd_model *model, const struct tree_work *work, int index,
                              int probe)
{
    bool left = *thin_side_of(model, work, index, probe) > 0;
    return gap_at(model, work, index, probe, left ? thin_left : thin_right);
}

/* From the circle round the bar. */
static struct gap gap_at_circle(const struct fbd_model *model, const struct tree_work *work, int index,
                                int probe)
{
    return gap_at(model, work, index, probe, thin_round);
}

/* The distance beyond the nearer end; negative over the bar. */
static struct gap gap_at_ends(const struct fbd_model *model, const struct tree_work *work, int index,
                              int probe)
{
    struct gap begin = gap_at(model, work, index, probe, thin_begin),
               end = gap_at(model, work, index, probe, thin_end);
    return begin.x > end.x ? begin : end;
}

static struct vec place_of(const struct fbd_model *model, const struct tree_work *work, int index, int probe)
{
    return feature_place(model, work, index,
                         thin_feature(thin_corner_of(meeting_of(model, index), probe), thin_left));
}

/* Is the corner in a closed contact, its own or that of an end of the bar at its position? */
static bool is_closed(const struct fbd_model *model, const struct instant *at, int index, int probe)
{
    const struct meeting *meeting = meeting_of(model, index);
    const double near = 4 * meeting_near(model, at->tree, index);
    for (int k = 0; k < meeting->coupling_count; k++) {
        int coupling = meeting->first_coupling + k;
        if (!coupling_is_closed(model, at, coupling)) continue;
        struct vec place = feature_place(model, at->tree, index, at->tree->couplings[coupling].feature);
        if (vec_norm(vec_sub(place_of(model, at->tree, index, probe), place)) <= near) return true;
    }
    return false;
}

/* The circle is smaller by the touching distance, so that an end reached to rounding counts as touched. */
struct gap thin_probe(const struct fbd_model *model, const struct instant *at, int index, int probe)
{
    if (is_closed(model, at, index, probe)) return (struct gap){HUGE_VAL, 0, no_feature};
    struct gap circle = gap_at_circle(model, at->tree, index, probe);
    circle.x -= meeting_near(model, at->tree, index);
    if (*thin_side_of(model, at->tree, index, probe) == 0) return circle;
    struct gap side = gap_at_side(model, at->tree, index, probe);
    return circle.x > side.x ? circle : side;
}

/* ---- touching features */

/* The other corner of the probe's shape; -1 for a point. */
static int beside(const struct meeting *meeting, int probe)
{
    return meeting->shape[thin_corner_of(meeting, probe).moving].count > 1 ? probe ^ 1 : -1;
}

/* Does the corner's own bar lie along the line of the other, beyond the end at which the corner is? */
bool thin_is_in_line(const struct fbd_model *model, const struct tree_work *work, int index, int probe,
                     double near)
{
    int other = beside(meeting_of(model, index), probe);
    return other >= 0 && fabs(gap_at_ends(model, work, index, probe).x) <= near &&
           fabs(gap_at_side(model, work, index, other).x) <= near &&
           gap_at_ends(model, work, index, other).x > near;
}

/* Does a corner at an end of the bar touch the end face, as it approaches or lies along the bar's line? */
static bool meets_end_face(const struct fbd_model *model, const struct tree_work *work, int index, int probe,
                           double near)
{
    struct gap side = gap_at_side(model, work, index, probe), ends = gap_at_ends(model, work, index, probe);
    if (fabs(ends.x) > near) return false;
    if (fabs(side.rate) < fabs(ends.rate)) return ends.rate < 0;
    return thin_is_in_line(model, work, index, probe, near);
}

/* The gap by the feature at which the corner of a probe touches, if it does. */
static struct gap touching_at(const struct fbd_model *model, const struct tree_work *work, int index,
                              int probe, double near)
{
    const struct gap none = {HUGE_VAL, 0, no_feature};
    double speed = solved_rounding * meeting_speed(work, meeting_of(model, index));
    struct gap side = gap_at_side(model, work, index, probe), ends = gap_at_ends(model, work, index, probe);
    if (fabs(side.x) > near || ends.x > near) return none;
    if (meets_end_face(model, work, index, probe, near)) return ends;
    return ends.x >= -near && ends.rate > speed ? none : side; /* it leaves over the end */
}

/* Of corners at one place the one that closes fastest, and the outermost two. */
int thin_touching(const struct fbd_model *model, const struct tree_work *work, int index, double near,
                  int features[2])
{
    const struct meeting *meeting = meeting_of(model, index);
    const struct contact_shape *bar = &meeting->shape[shape_sides(&meeting->shape[1]) > 0 ? 1 : 0];
    struct vec e = vec_turn(work->links[bar->link].turn, vec_sub(bar->corners[1], bar->corners[0]));
    double size = vec_norm(e), foot[2] = {HUGE_VAL, -HUGE_VAL}, rate[2] = {0, 0};
    for (int probe = 0; probe < meeting->probes; probe++) {
        struct gap gap = touching_at(model, work, index, probe, near);
        if (gap.feature == no_feature) continue;
        double here = vec_dot(e, place_of(model, work, index, probe)) / size;
        for (int k = 0; k < 2; k++) {
            double beyond = k == 0 ? foot[k] - here : here - foot[k];
            if (beyond < -4 * near || (beyond <= 4 * near && gap.rate >= rate[k])) continue;
            foot[k] = here;
            rate[k] = gap.rate;
            features[k] = gap.feature;
        }
    }
    if (foot[0] > foot[1]) return 0;
    return foot[1] - foot[0] > 4 * near && meeting->coupling_count > 1 ? 2 : 1;
}

double thin_crossing(const struct fbd_model *model, const struct tree_work *work, int index)
{
    const struct meeting *meeting = meeting_of(model, index);
    double least = HUGE_VAL;
    if (meeting->probes < 4) return 0;
    for (int k = 0; k < 2; k++) {
        double from = gap_at(model, work, index, 2 * k, thin_left).x,
               to = gap_at(model, work, index, 2 * k + 1, thin_left).x;
        if ((from < 0) == (to < 0)) return 0;
        least = fmin(least, fmin(fabs(from), fabs(to)));
    }
    return least;
}

/* ---- sides */

double thin_middle(const struct fbd_model *model, const struct tree_work *work, int index, int probe)
{
    int other = beside(meeting_of(model, index), probe);
    double left = gap_at(model, work, index, probe, thin_left).x;
    return other < 0 ? 0 : (left + gap_at(model, work, index, other, thin_left).x) / 2;
}

/* The side of a corner that touches, by its feature. */
static bool touches(const struct meeting *meeting, const struct tree_work *work, struct thin_corner corner,
                    int *side)
{
    for (int k = 0; k < meeting->coupling_count; k++) {
        int feature = work->couplings[meeting->first_coupling + k].feature;
        if (feature == thin_feature(corner, thin_left)) *side = 1;
        if (feature == thin_feature(corner, thin_right)) *side = -1;
        if (feature >= thin_feature(corner, thin_right) && feature <= thin_feature(corner, thin_round))
            return true;
    }
    return false;
}

/* Of a corner at the circle, or in it without a side. */
static int side_now(const struct fbd_model *model, const struct tree_work *work, int index, int probe,
                    double near)
{
    double left = gap_at(model, work, index, probe, thin_left).x;
    int side = *thin_side_of(model, work, index, probe);
    if (fabs(left) > near) return left > 0 ? 1 : -1;
    if (meets_end_face(model, work, index, probe, near)) return 0;
    double middle = thin_middle(model, work, index, probe);
    if (fabs(middle) > near) return middle > 0 ? 1 : -1;
    return side != 0 ? side : left >= 0 ? 1 : -1;
}

void meeting_turn_sides(const struct fbd_model *model, struct tree_work *work, int index, double near)
{
    const struct meeting *meeting = meeting_of(model, index);
    for (int probe = 0; meeting->thin && probe < meeting->probes; probe++) {
        int *side = thin_side_of(model, work, index, probe);
        double circle = gap_at_circle(model, work, index, probe).x;
        if (touches(meeting, work, thin_corner_of(meeting, probe), side)) continue;
        if (circle > 4 * near)
            *side = 0;
        else if (circle >= -4 * near || *side == 0)
            *side = side_now(model, work, index, probe, near);
    }
}
