/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/contact.h"

#include "dynamics/constraint.h"
#include "dynamics/contact_thin.h"
#include "numeric/tolerances.h"

/* ---- points in the world */

struct moving {
    struct vec p, v;
};

static struct moving point_in_world(const struct tree_work *work, int link, struct vec own)
{
    const struct tree_state *s = &work->links[link];
    struct vec r = vec_turn(s->turn, own);
    return (struct moving){vec_add(s->p, r), vec_add(s->v, vec_scale(s->omega, vec_perp(r)))};
}

/* A side in the world, and the point above it. */
struct over {
    struct vec d, e, n; /* from the side's beginning to the point */
    struct vec v;       /* of the point, relative to the link of the side */
};

static struct over over_side(const struct tree_work *work, const struct meeting *meeting,
                             const struct touch *touch)
{
    const struct contact_shape *moving = &meeting->shape[touch->moving],
                               *still = &meeting->shape[1 - touch->moving];
    const struct tree_state *base = &work->links[still->link];
    struct moving C = point_in_world(work, moving->link, touch->point),
                  P = point_in_world(work, still->link, touch->base);
    double side = touch->side != 0 ? touch->side : work->couplings[meeting->first_coupling].side[0];
    struct over over = {.d = vec_sub(C.p, P.p), .e = vec_turn(base->turn, touch->e)};
    over.n = vec_scale(side, vec_perp(over.e));
    over.v = vec_sub(vec_sub(C.v, P.v), vec_scale(base->omega, vec_perp(over.d)));
    return over;
}

static struct gap gap_of(const struct tree_work *work, const struct meeting *meeting,
                         const struct touch *touch)
{
    if (!touch->circles) {
        struct over over = over_side(work, meeting, touch);
        return (struct gap){vec_dot(over.n, over.d) - touch->radius, vec_dot(over.n, over.v), no_feature};
    }
    struct moving A = point_in_world(work, meeting->shape[touch->moving].link, touch->point),
                  B = point_in_world(work, meeting->shape[1 - touch->moving].link, touch->base);
    struct vec d = vec_sub(A.p, B.p);
    double length = vec_norm(d), rate = length > 0 ? vec_dot(d, vec_sub(A.v, B.v)) / length : 0;
    return (struct gap){length - touch->radius - touch->base_radius, rate, no_feature};
}

/* ---- stops */

/* The distance of a joint from its stop: s (q - limit). */
static struct gap stop_gap(const struct fbd_model *model, const struct tree_work *work,
                           const struct meeting *meeting)
{
    int i = meeting->shape[0].link;
    const struct tree_link *link = &model->tree->links[i];
    const struct tree_state *own = &work->links[i], *parent = &work->links[link->parent];
    double s = meeting->stop;
    if (link_joint(link)->has_axis)
        return (struct gap){s * (own->angle - parent->angle - link->along - meeting->limit),
                            s * (own->omega - parent->omega), 0};
    struct moving at = point_in_world(work, link->parent, link->at);
    struct vec e = vec_turn(parent->turn, link->e), d = vec_sub(own->p, at.p);
    struct vec v = vec_sub(vec_sub(own->v, at.v), vec_scale(parent->omega, vec_perp(d)));
    return (struct gap){s * (vec_dot(e, d) - meeting->limit), s * vec_dot(e, v), 0};
}

struct distance meeting_distance(const struct fbd_model *model, const struct tree_work *work, int index)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    const struct contact_shape *a = &meeting->shape[0], *b = &meeting->shape[1];
    if (meeting->stop != 0) return (struct distance){-1, 0}; /* always close */
    struct moving A = point_in_world(work, a->link, a->center), B = point_in_world(work, b->link, b->center);
    struct vec d = vec_sub(A.p, B.p);
    double apart = b->kind == contact_line
                       ? fabs(vec_cross(vec_turn(work->links[b->link].turn, b->e), d)) - a->radius
                       : vec_norm(d) - a->radius - b->radius;
    return (struct distance){apart, vec_norm(vec_sub(A.v, B.v))};
}

struct gap feature_gap(const struct fbd_model *model, const struct tree_work *work, int index, int feature)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    if (meeting->stop != 0) return stop_gap(model, work, meeting);
    struct touch touch = meeting_touch(meeting, feature);
    struct gap gap = gap_of(work, meeting, &touch);
    gap.feature = feature;
    return gap;
}

struct place_on_side feature_foot(const struct fbd_model *model, const struct tree_work *work, int index,
                                  int feature)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    struct touch touch = meeting_touch(meeting, feature);
    if (touch.circles) return (struct place_on_side){0, 0, HUGE_VAL};
    struct over over = over_side(work, meeting, &touch);
    return (struct place_on_side){vec_dot(over.e, over.d), vec_dot(over.e, over.v), touch.length};
}

/* The size of the positions of both shapes. */
static double reach_of(const struct fbd_model *model, const struct tree_work *work, int index)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    double reach = meeting->reach;
    for (int k = 0; k < 2; k++) {
        int link = meeting->shape[k].link;
        if (link > 0) reach = fmax(reach, vec_norm(point_in_world(work, link, meeting->shape[k].center).p));
    }
    return reach;
}

double meeting_near(const struct fbd_model *model, const struct tree_work *work, int index)
{
    return contact_near * reach_of(model, work, index);
}

double meeting_rounding(const struct fbd_model *model, const struct tree_work *work, int index)
{
    return round_off(16, reach_of(model, work, index));
}

/* ---- a disc and a polygon */

/* The nearest feature of a disc and corners: inside, the side with the least depth; outside, a side below the
 * centre, or else a corner. */
static struct gap disc_at_corners(const struct fbd_model *model, const struct tree_work *work, int index,
                                  const struct contact_shape *corners)
{
    int sides = shape_sides(corners);
    struct gap side = {-HUGE_VAL, 0, no_feature}, over = side, corner = {HUGE_VAL, 0, no_feature};
    const struct meeting *meeting = &model->tree->meetings[index];
    double radius = meeting_touch(meeting, 0).radius;
    for (int i = 0; i < sides; i++) {
        struct gap gap = feature_gap(model, work, index, i);
        struct place_on_side at = feature_foot(model, work, index, i);
        if (gap.x > side.x) side = gap;
        if (gap.x > over.x && gap.x > -radius && at.foot >= 0 && at.foot <= at.length) over = gap;
    }
    if (sides > 2 && side.x <= -radius) return side;
    if (over.feature != no_feature) return over;
    for (int i = 0; i < corners->count; i++) {
        struct gap gap = feature_gap(model, work, index, sides + i);
        if (gap.x < corner.x) corner = gap;
    }
    return corner;
}

/* ---- two polygons */

/* The lowest of the corners of shape `moving` over a side of the other. */
static struct gap lowest_over(const struct fbd_model *model, const struct tree_work *work, int index,
                              int moving, int side)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    struct gap lowest = {HUGE_VAL, 0, no_feature};
    for (int i = 0; i < meeting->shape[moving].count; i++) {
        struct gap gap = feature_gap(model, work, index, meeting_feature(meeting, moving, i, side));
        bool lower = gap.x < lowest.x || (gap.x == lowest.x && gap.rate < lowest.rate);
        if (lower) lowest = gap;
    }
    return lowest;
}

/* Is the corner of a feature between the ends of its side? */
static bool is_over(const struct fbd_model *model, const struct tree_work *work, int index, int feature)
{
    const double near = negligible_sum * model->tree->meetings[index].size;
    struct place_on_side at = feature_foot(model, work, index, feature);
    return at.foot >= -near && at.foot <= at.length + near;
}

/* Corner and side of a feature of two sets of corners. */
struct pairing {
    int moving, corner, side;
};

static struct pairing pairing_of(const struct meeting *meeting, int feature)
{
    const int sides[2] = {shape_sides(&meeting->shape[0]), shape_sides(&meeting->shape[1])};
    int first = meeting->shape[0].count * sides[1];
    if (feature < first) return (struct pairing){0, feature / sides[1], feature % sides[1]};
    feature -= first;
    return (struct pairing){1, feature / sides[0], feature % sides[0]};
}

/* A corner between the ends of the side among those as low as the given one, else that one. */
static struct gap over_as_low(const struct fbd_model *model, const struct tree_work *work, int index,
                              struct gap lowest, double alike)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    if (lowest.feature == no_feature) return lowest;
    struct pairing at = pairing_of(meeting, lowest.feature);
    for (int i = 0; i < meeting->shape[at.moving].count; i++) {
        struct gap gap = feature_gap(model, work, index, meeting_feature(meeting, at.moving, i, at.side));
        if (gap.x <= lowest.x + alike && is_over(model, work, index, gap.feature)) return gap;
    }
    return lowest;
}

static int beside(const struct contact_shape *shape, int corner, int step)
{
    return (corner + step + shape->count) % shape->count;
}

/* Is the corner of a feature, or the adjacent part of its side, in the interior of a body or of the ground?
 * At the joint of two tiles their common surface is in contact, not the sides at which they join. */
static bool is_inner(const struct fbd_model *model, const struct tree_work *work, int index, int feature)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    struct pairing at = pairing_of(meeting, feature);
    const struct contact_shape *with = &meeting->shape[at.moving], *on = &meeting->shape[1 - at.moving];
    struct place_on_side place = feature_foot(model, work, index, feature);
    bool begins = place.foot < place.length / 2;
    int end = begins ? at.side : beside(on, at.side, 1);
    if (with->inner && (with->inner[at.corner] & inner_flat)) return true;
    return on->inner && (on->inner[end] & (begins ? inner_begin : inner_end));
}

/* The best separating side, by its lowest corner. Of sides equal within rounding one on the surface is
 * preferred, then one with the corner between its ends: sides that lie flat on each other also have corners
 * beyond their ends, which do not touch. Then, for a corner on a corner, the side with the largest rate:
 * along it the shapes will separate. */
static struct gap separation(const struct fbd_model *model, const struct tree_work *work, int index)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    const double alike = contact_near * meeting->reach;
    struct gap best = {-HUGE_VAL, 0, no_feature};
    for (int moving = 0; moving < 2; moving++)
        for (int side = 0; side < shape_sides(&meeting->shape[1 - moving]); side++) {
            struct gap gap = lowest_over(model, work, index, moving, side);
            bool better = gap.x > best.x + alike;
            if (!better && gap.x > best.x - alike) {
                gap = over_as_low(model, work, index, gap, alike);
                best = over_as_low(model, work, index, best, alike);
                bool over = is_over(model, work, index, gap.feature),
                     other = is_over(model, work, index, best.feature);
                bool inner = is_inner(model, work, index, gap.feature),
                     others_inner = is_inner(model, work, index, best.feature);
                better = inner != others_inner ? others_inner : over != other ? over : gap.rate > best.rate;
            }
            if (better) best = gap;
        }
    return best;
}

/* ---- probes */

static int closed_couplings(const struct fbd_model *model, const struct instant *at, int index, int *coupling)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    int count = 0;
    for (int k = 0; k < meeting->coupling_count; k++) {
        if (!coupling_is_closed(model, at, meeting->first_coupling + k)) continue;
        *coupling = meeting->first_coupling + k;
        count++;
    }
    return count;
}

double contact_slack(const struct fbd_model *model, int coupling)
{
    double mass = 0;
    for (int k = 0; k < 2; k++) {
        int link = model->tree->couplings[coupling].end[k].link;
        if (link > 0) mass += model->tree->links[link].mass;
    }
    return negligible_sum * mass * vec_norm(model->scene->gravity);
}

bool coupling_is_closed(const struct fbd_model *model, const struct instant *at, int coupling)
{
    return at->slip[model->tree->couplings[coupling].surface] == stick;
}

bool meeting_is_closed(const struct fbd_model *model, const struct instant *at, int index)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    int coupling;
    return meeting_is_gone(at->tree, meeting) ||
           closed_couplings(model, at, index, &coupling) == meeting->coupling_count;
}

static const struct gap nothing = {HUGE_VAL, 0, no_feature};

/* Without a closed feature: the separation. With a corner on a side: the gaps of its neighbours at that side. */
static struct gap probe_corners(const struct fbd_model *model, const struct instant *at, int index, int probe,
                                int closed, int coupling)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    if (closed == 0) return probe == 0 ? separation(model, at->tree, index) : nothing;
    if (closed > 1 || probe == 0) return nothing;
    struct pairing pairing = pairing_of(meeting, at->tree->couplings[coupling].feature);
    const struct contact_shape *with = &meeting->shape[pairing.moving];
    if (with->count < 2 || (with->count == 2 && probe == 2)) return nothing;
    int corner = beside(with, pairing.corner, probe == 1 ? 1 : -1);
    return feature_gap(model, at->tree, index,
                       meeting_feature(meeting, pairing.moving, corner, pairing.side));
}

struct gap meeting_probe(const struct fbd_model *model, const struct instant *at, int index, int probe)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    const struct contact_shape *a = &meeting->shape[0], *b = &meeting->shape[1];
    int coupling = -1, closed = closed_couplings(model, at, index, &coupling);
    if (meeting_is_gone(at->tree, meeting) || closed == meeting->coupling_count) return nothing;
    if (meeting->stop != 0) return feature_gap(model, at->tree, index, 0);
    if (b->kind == contact_line) {
        if (closed > 0 && at->tree->couplings[coupling].feature == probe) return nothing;
        return feature_gap(model, at->tree, index, probe);
    }
    if (meeting->thin) return thin_probe(model, at, index, probe);
    if (a->kind == contact_disc && b->kind == contact_disc) return feature_gap(model, at->tree, index, 0);
    if (a->kind == contact_disc) return disc_at_corners(model, at->tree, index, b);
    if (b->kind == contact_disc) return disc_at_corners(model, at->tree, index, a);
    return probe_corners(model, at, index, probe, closed, coupling);
}

double meeting_depth(const struct fbd_model *model, const struct instant *at, int index)
{
    double least = 0;
    for (int probe = 0; probe < model->tree->meetings[index].probes; probe++)
        least = fmin(least, meeting_probe(model, at, index, probe).x);
    return -least;
}

/* ---- touching features */

/* The outermost two of features at the positions `foot`. */
struct outermost {
    int count, features[2];
    double foot[2];
};

static void consider(struct outermost *found, int feature, double foot)
{
    if (found->count == 0 || foot < found->foot[0]) {
        found->features[0] = feature;
        found->foot[0] = foot;
    }
    if (found->count == 0 || foot > found->foot[1]) {
        found->features[1] = feature;
        found->foot[1] = foot;
    }
    found->count++;
}

/* A point at an end of a side that moves off it is not on the side. */
static bool is_on_side(const struct fbd_model *model, const struct tree_work *work, int index,
                       const struct place_on_side *at, double near)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    double speed = meeting_speed(work, meeting);
    if (at->foot < -near || at->foot > at->length + near) return false;
    if (at->foot <= near && at->rate < -solved_rounding * speed) return false;
    return !(at->foot >= at->length - near && at->rate > solved_rounding * speed);
}

/* Corners of shape `moving` that lie on a side of the other. */
static void corners_on_side(const struct fbd_model *model, const struct tree_work *work, int index,
                            int moving, int side, double near, struct outermost *found)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    for (int i = 0; i < meeting->shape[moving].count; i++) {
        int feature = meeting_feature(meeting, moving, i, side);
        struct gap gap = feature_gap(model, work, index, feature);
        struct place_on_side at = feature_foot(model, work, index, feature);
        if (fabs(gap.x) <= near && is_on_side(model, work, index, &at, near))
            consider(found, feature, at.foot);
    }
}

static bool is_found(const struct outermost *found, double foot, double near)
{
    for (int k = 0; k < 2 && found->count > 0; k++)
        if (fabs(found->foot[k] - foot) <= 4 * near) return true;
    return false;
}

/* Do a side of the other shape and a side of `moving` face each other? Of the two sides of a bar that lies on
 * a side one does. */
static bool face_each_other(const struct tree_work *work, const struct meeting *meeting, int moving, int side,
                            int own)
{
    struct touch on_other = meeting_touch(meeting, meeting_feature(meeting, moving, 0, side)),
                 on_own = meeting_touch(meeting, meeting_feature(meeting, 1 - moving, 0, own));
    return vec_dot(over_side(work, meeting, &on_other).n, over_side(work, meeting, &on_own).n) < 0;
}

/* Where two corners of `moving` lie on the line of a side, that side lies on one of theirs, and its own ends
 * may be between them; or at a corner, which leaves the side over its end as this end comes onto the side of
 * the corners. */
static void ends_of_side(const struct fbd_model *model, const struct tree_work *work, int index, int moving,
                         int side, double near, struct outermost *found)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    const struct contact_shape *with = &meeting->shape[moving], *on = &meeting->shape[1 - moving];
    double length = meeting_touch(meeting, meeting_feature(meeting, moving, 0, side)).length;
    for (int i = 0; i < shape_sides(with); i++) {
        int ends[2] = {meeting_feature(meeting, moving, i, side),
                       meeting_feature(meeting, moving, beside(with, i, 1), side)};
        bool flat = face_each_other(work, meeting, moving, side, i);
        for (int k = 0; k < 2; k++) flat &= fabs(feature_gap(model, work, index, ends[k]).x) <= near;
        for (int k = 0; flat && k < 2; k++) {
            int corner = k == 0 ? side : beside(on, side, 1);
            int feature = meeting_feature(meeting, 1 - moving, corner, i);
            struct place_on_side at = feature_foot(model, work, index, feature);
            double foot = k == 0 ? 0 : length;
            bool inside = at.foot > near && at.foot < at.length - near;
            if (inside || (!is_found(found, foot, near) && is_on_side(model, work, index, &at, near)))
                consider(found, feature, foot);
        }
    }
}

int meeting_touching(const struct fbd_model *model, const struct tree_work *work, int index, double near,
                     int features[2])
{
    const struct meeting *meeting = &model->tree->meetings[index];
    const struct contact_shape *a = &meeting->shape[0], *b = &meeting->shape[1];
    struct outermost found = {0};
    if (meeting_is_gone(work, meeting)) return 0;
    if (meeting->thin) return thin_touching(model, work, index, near, features);
    if (meeting->stop != 0) {
        if (fabs(feature_gap(model, work, index, 0).x) <= near) consider(&found, 0, 0);
    } else if (b->kind == contact_line && a->kind == contact_corners) {
        for (int i = 0; i < a->count; i++)
            if (fabs(feature_gap(model, work, index, i).x) <= near)
                consider(&found, i, feature_foot(model, work, index, i).foot);
    } else if (a->kind == contact_corners && b->kind == contact_corners) {
        struct gap gap = separation(model, work, index);
        if (fabs(gap.x) > near || gap.feature == no_feature) return 0;
        struct pairing best = pairing_of(meeting, gap.feature);
        corners_on_side(model, work, index, best.moving, best.side, near, &found);
        ends_of_side(model, work, index, best.moving, best.side, near, &found);
    } else {
        struct gap gap = b->kind != contact_corners && a->kind == contact_disc
                             ? feature_gap(model, work, index, 0)
                             : disc_at_corners(model, work, index, a->kind == contact_disc ? b : a);
        if (fabs(gap.x) <= near) consider(&found, gap.feature, 0);
    }
    features[0] = found.features[0];
    features[1] = found.features[1];
    return found.count > 1 && meeting->coupling_count > 1 ? 2 : found.count > 0 ? 1 : 0;
}

/* ---- the ends of a feature */

/* A circle at a corner reaches the side that begins there (end 1), or the one that ends there (end 0). */
static struct gap over_next_side(const struct fbd_model *model, const struct tree_work *work, int index,
                                 int feature, int end)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    const struct contact_shape *corners = &meeting->shape[meeting->shape[0].kind == contact_disc ? 1 : 0];
    int sides = shape_sides(corners), corner = feature - sides;
    if (corners->kind != contact_corners || sides == 0) return nothing;
    int side = end == 1 ? corner : beside(corners, corner, -1);
    struct place_on_side at = feature_foot(model, work, index, side);
    if (end == 1) return (struct gap){-at.foot, -at.rate, side};
    return (struct gap){at.foot - at.length, at.rate, side};
}

struct gap feature_end(const struct fbd_model *model, const struct tree_work *work, int index, int feature,
                       int end)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    if (feature == no_feature || meeting->stop != 0 || meeting->shape[1].kind == contact_line) return nothing;
    if (meeting_touch(meeting, feature).circles) return over_next_side(model, work, index, feature, end);
    struct place_on_side at = feature_foot(model, work, index, feature);
    if (end == 0) return (struct gap){at.foot, at.rate, no_feature};
    return (struct gap){at.length - at.foot, -at.rate, no_feature};
}

/* ---- positions */

struct vec feature_place(const struct fbd_model *model, const struct tree_work *work, int index, int feature)
{
    const struct meeting *meeting = &model->tree->meetings[index];
    if (meeting->stop != 0) return work->links[meeting->shape[0].link].p;
    struct touch touch = meeting_touch(meeting, feature);
    struct vec C = point_in_world(work, meeting->shape[touch.moving].link, touch.point).p;
    if (!touch.circles) {
        struct over over = over_side(work, meeting, &touch);
        return vec_sub(C, vec_scale(touch.radius, over.n));
    }
    struct vec d = vec_sub(C, point_in_world(work, meeting->shape[1 - touch.moving].link, touch.base).p);
    return vec_sub(C, vec_scale(touch.radius / vec_norm(d), d));
}
