/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Contacts of two points: a normal exists only where both move on one line, by slides along it.
 */
#include "model/builder.h"
#include "numeric/tolerances.h"

/* A point relative to a link below its own: its position at the start, the direction in which it moves there
 * (0 while it is at rest) and that of the x axis of its own link. */
struct seen {
    int link;
    struct vec point, e, x;
    double rate; /* at the start, along e */
};

/* Transform to the link below; false if other joints than slides along one direction are between. */
static bool climb(const struct fbd_model *model, struct seen *seen)
{
    const struct tree_link *link = &model->tree->links[seen->link];
    if (seen->link == 0 || link_joint(link)->path != path_line) return false;
    struct vec turn = vec_unit(link->along), e = vec_turn(turn, seen->e);
    const struct coordinate *q = &model->scene->coordinates[link->coordinate];
    if (fabs(vec_cross(link->e, e)) > nine_digits) return false;
    double same = vec_dot(link->e, e) < 0 ? -1 : 1;
    seen->link = link->parent;
    seen->point = vec_add(vec_add(link->at, vec_turn(turn, seen->point)), vec_scale(q->initial, link->e));
    seen->x = vec_turn(turn, seen->x);
    seen->rate = same * seen->rate + q->initial_rate;
    seen->e = link->e;
    return true;
}

static bool see_both(const struct fbd_model *model, const struct meeting *meeting, struct seen seen[2])
{
    for (int k = 0; k < 2; k++)
        seen[k] =
            (struct seen){.link = meeting->shape[k].link, .point = meeting->shape[k].corners[0], .x = {1, 0}};
    while (seen[0].link != seen[1].link) /* the link below has the smaller number */
        if (!climb(model, &seen[seen[0].link > seen[1].link ? 0 : 1])) return false;
    return true;
}

bool points_meet_on_line(const struct fbd_model *model, struct meeting *meeting)
{
    struct seen seen[2];
    if (!see_both(model, meeting, seen)) return false;
    bool moves = vec_norm(seen[0].e) > 0;
    struct vec e = moves ? seen[0].e : seen[1].e, d = vec_sub(seen[0].point, seen[1].point);
    if (fabs(vec_cross(seen[0].e, seen[1].e)) > nine_digits || vec_norm(e) == 0) return false;
    double size = fmax(vec_norm(seen[0].point), vec_norm(seen[1].point)), along = vec_dot(e, d);
    if (fabs(vec_cross(e, d)) > nine_digits * size) return false;
    double other = vec_dot(e, seen[1].e) < 0 ? -1 : 1;
    bool same_place = fabs(along) <= nine_digits * size, same_rate = seen[0].rate == other * seen[1].rate;
    if (same_place && same_rate) return false;
    struct contact_shape *line = &meeting->shape[1];
    struct vec back = {seen[1].x.x, -seen[1].x.y};
    line->kind = contact_line;
    line->center = line->corners[0];
    line->e = vec_turn(back, vec_perp(e));
    return true;
}

void contacts_check(struct builder *builder)
{
    const struct fbd_model *model = builder->model;
    for (int i = 0; i < model->tree->meeting_count; i++) {
        const struct meeting *meeting = &model->tree->meetings[i];
        const struct constraint *source = &model->scene->constraints[meeting->constraint];
        if (!meeting_is_of_points(meeting)) continue;
        bool ground = source->body[1] == ground_body;
        diag_add(
            builder->errors, FBD_ERROR, "no-shape", source->at,
            "give one of them a `shape`; points meet where both move on one line, by slides along it, "
            "and do not "
            "start in one place",
            "`%s` and %s%s%s have only a point each: the side on which one is of the other is not defined",
            model->bodies[source->body[0]].name, ground ? "a point of the ground" : "`",
            ground ? "" : model->bodies[source->body[1]].name, ground ? "" : "`");
    }
}
