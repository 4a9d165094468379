/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Check that pitch circles touch, for gears whose axes are at a constant distance and for wheels at a
 * constant distance from a rack.
 *
 *     distance of the axes = r_1 + r_2, and |r_1 - r_2| of a wheel inside a ring
 *     distance of the axis from the line of the rack = r
 */
#include "model/builder.h"
#include "numeric/tolerances.h"

/* A centre in the frame in which it is at rest; for a body that turns about it, the frame of the body below. */
struct centre {
    int link;
    struct vec point;
};

static struct centre centre_of(const struct tree *tree, const struct coupling_end *end, double close)
{
    const struct tree_link *link = &tree->links[end->link];
    bool turns = end->link > 0 && link_joint(link)->has_axis && vec_norm(end->point) <= close;
    return turns ? (struct centre){link->parent, link->at} : (struct centre){end->link, end->point};
}

/* The distance of two axes if it is constant; negative otherwise. It is constant if both are at rest on the
 * same body, or one is on an arm about the axis of the other. */
static double axes_apart(const struct tree *tree, const struct coupling *coupling, double close)
{
    struct centre centre[2];
    for (int k = 0; k < 2; k++) centre[k] = centre_of(tree, &coupling->end[k], close);
    if (centre[0].link == centre[1].link) return vec_norm(vec_sub(centre[0].point, centre[1].point));
    for (int k = 0; k < 2; k++) {
        const struct tree_link *arm = &tree->links[centre[k].link];
        const struct centre *other = &centre[1 - k];
        bool about_it = centre[k].link > 0 && link_joint(arm)->has_axis && arm->parent == other->link &&
                        vec_norm(vec_sub(arm->at, other->point)) <= close;
        if (about_it) return vec_norm(centre[k].point);
    }
    return -1;
}

/* A point in the frame of a link, and the only direction in which it moves there; 0 while it is at rest. */
struct seen {
    int link;
    struct vec point, e;
};

/* Transform to the frame of the link below; false if it moves there otherwise than by slides along that one
 * direction. */
static bool climb(const struct tree *tree, struct seen *seen)
{
    const struct tree_link *link = &tree->links[seen->link];
    struct vec turn = vec_unit(link->along), e = vec_turn(turn, seen->e);
    if (link_joint(link)->path != path_line || fabs(vec_cross(link->e, e)) > six_digits) return false;
    *seen = (struct seen){link->parent, vec_add(link->at, vec_turn(turn, seen->point)), link->e};
    return true;
}

/* The distance of a wheel's axis from the line of a rack if it is constant, that is, if only slides along the
 * line are between them; negative otherwise. */
static double line_apart(const struct tree *tree, const struct coupling *coupling, double close)
{
    const struct tree_link *wheel = &tree->links[coupling->end[0].link];
    struct seen line = {coupling->end[1].link, coupling->end[1].point, coupling->e},
                axis = {wheel->parent, wheel->at, {0, 0}};
    if (!link_joint(wheel)->has_axis || vec_norm(coupling->end[0].point) > close) return -1;
    while (line.link != axis.link) /* the link below has the smaller number */
        if (!climb(tree, line.link > axis.link ? &line : &axis)) return -1;
    if (fabs(vec_cross(line.e, axis.e)) > six_digits) return -1;
    return fabs(vec_cross(line.e, vec_sub(axis.point, line.point)));
}

static void check_rack(struct builder *builder, const struct coupling *coupling)
{
    const struct fbd_model *model = builder->model;
    double R = coupling->end[0].radius, apart = line_apart(model->tree, coupling, six_digits * R);
    if (apart < 0 || fabs(apart - R) <= six_digits * R) return;
    diag_add(builder->errors, FBD_ERROR, "gear-distance", model->scene->constraints[coupling->constraint].at,
             "move the axis or the slide, change `radius`, or name a point of the rack's line, `body.P`",
             "the axis of `%s` is %.6g from the line of `%s`, where its radius is %.6g",
             model->bodies[coupling->end[0].body].name, apart, model->bodies[coupling->end[1].body].name, R);
}

static void check_gear(struct builder *builder, const struct coupling *coupling)
{
    const struct fbd_model *model = builder->model;
    double r1 = coupling->end[0].radius, r2 = coupling->end[1].radius, size = r1 + fabs(r2);
    double apart = axes_apart(model->tree, coupling, six_digits * size), needed = fabs(r1 + r2);
    if (apart < 0 || fabs(apart - needed) <= six_digits * size) return;
    diag_add(builder->errors, FBD_ERROR, "gear-distance", model->scene->constraints[coupling->constraint].at,
             r2 < 0 ? "move an axis, or change `radii`"
                    : "move an axis, or change `radii`; for a wheel inside a ring give `inside: true`",
             "the axes of `%s` and `%s` are %.6g apart, where the radii %.6g and %.6g %s %.6g",
             model->bodies[coupling->end[0].body].name, model->bodies[coupling->end[1].body].name, apart, r1,
             fabs(r2), r2 < 0 ? "differ by" : "add up to", needed);
}

/* Both strands together pull with 2 T cos(gamma) along the line of centres, independent of the transmitted
 * moment: sin(gamma) = (R_1 -+ R_2) / d. As d is constant, a spring of zero free length and length d models
 * that force. */
static void preload(struct tree *tree, const struct coupling *coupling, double apart)
{
    double rho = coupling->end[0].radius + (coupling->source->crossed ? 1 : -1) * coupling->end[1].radius;
    double along = sqrt(fmax(0, apart * apart - rho * rho)) / apart;
    tree->springs[tree->spring_count++] =
        (struct tree_spring){.link = {coupling->end[0].link, coupling->end[1].link},
                             .point = {coupling->end[0].point, coupling->end[1].point},
                             .stiffness = 2 * coupling->source->tension * along / apart};
}

static void check_belt(struct builder *builder, const struct coupling *coupling)
{
    const struct fbd_model *model = builder->model;
    double size = coupling->end[0].radius + coupling->end[1].radius,
           apart = axes_apart(model->tree, coupling, six_digits * size);
    struct pos at = model->scene->constraints[coupling->constraint].at;
    if (apart >= 0 && coupling->source->tension == 0)
        diag_add(builder->errors, FBD_ERROR, "missing-key", at,
                 "give it a `tension`, that of both strands at rest",
                 "the axes of `%s` and `%s` keep their distance, so that the motion does not determine the "
                 "tension of the belt `%s`",
                 model->bodies[coupling->end[0].body].name, model->bodies[coupling->end[1].body].name,
                 coupling->name);
    if (apart < 0 && coupling->source->tension > 0)
        diag_add(builder->errors, FBD_ERROR, "conflicting-keys", at,
                 "leave `tension` out: it follows from the forces that separate the axes",
                 "the axes of `%s` and `%s` move against each other, and the belt `%s` keeps its length",
                 model->bodies[coupling->end[0].body].name, model->bodies[coupling->end[1].body].name,
                 coupling->name);
    if (apart > 0 && coupling->source->tension > 0) preload(model->tree, coupling, apart);
}

static void (*const checks[constraint_kinds])(struct builder *builder, const struct coupling *coupling) = {
    [constraint_gear] = check_gear, [constraint_rack] = check_rack, [constraint_belt] = check_belt};

void couplings_check(struct builder *builder)
{
    const struct tree *tree = builder->model->tree;
    for (int i = 0; i < tree->coupling_count; i++)
        if (checks[tree->couplings[i].kind]) checks[tree->couplings[i].kind](builder, &tree->couplings[i]);
}
