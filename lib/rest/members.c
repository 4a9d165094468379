/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/members.h"

#include <math.h>

#include "model/model.h"
#include "numeric/tolerances.h"

/* The point of a body at which forces act, and their sum. */
struct node {
    struct vec point, force;
    bool reaction;
};

/* Round-off level of forces and lengths, relative to the scales of the scene. */
static const double rest_rounding = undecided_part;

/* Add an arrow to the nodes; false if it is a couple, acts along a line, or needs a third node. */
static bool add_arrow(const struct fbd_statics *statics, const struct arrow *arrow, struct node nodes[2],
                      size_t *count)
{
    const struct fbd_model *model = statics->model;
    const double small = rest_rounding * statics->force;
    if (fabs(arrow->couple) > small * statics->length) return false;
    if (arrow->load >= 0 && model->loads[arrow->load].source->spread.length > 0) return false;
    const bool reaction = arrow_is_reaction(model, arrow);
    if (!reaction && vec_norm(arrow->force) <= small) return true;
    size_t i = 0;
    while (i < *count && vec_norm(vec_sub(nodes[i].point, arrow->point)) > rest_rounding * statics->length)
        i++;
    if (i == 2) return false;
    if (i == *count) nodes[(*count)++] = (struct node){.point = arrow->point};
    nodes[i].force = vec_add(nodes[i].force, arrow->force);
    nodes[i].reaction |= reaction;
    return true;
}

/* The tension of a body that is loaded at two points; NAN of another one. */
static double body_tension(const struct fbd_statics *statics, size_t b)
{
    const struct rest_diagram *diagram = &statics->diagrams[b];
    struct node nodes[2] = {{{0, 0}, {0, 0}, false}};
    size_t count = 0;
    if (!rest_turns(&statics->model->bodies[b])) return NAN;
    for (size_t i = 0; i < diagram->count; i++)
        if (!add_arrow(statics, &diagram->arrows[i], nodes, &count)) return NAN;
    if (count != 2 || !nodes[0].reaction || !nodes[1].reaction) return NAN;
    const struct vec along = vec_sub(nodes[1].point, nodes[0].point);
    return vec_dot(nodes[1].force, along) / vec_norm(along);
}

static void add_member(struct fbd_statics *statics, const char *name, fbd_member_kind kind, double tension)
{
    if (isnan(tension)) return;
    statics->members[statics->member_count++] = (fbd_member){name, kind, tension};
}

bool rest_find_members(struct fbd_statics *statics)
{
    const struct fbd_model *model = statics->model;
    const struct tree *tree = model->tree;
    statics->members =
        ARENA_ARRAY(&statics->arena, model->body_count + (size_t)tree->coupling_count + 1, fbd_member);
    if (!statics->members) return false;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        add_member(statics, coupling->name,
                   coupling->kind == constraint_rod ? FBD_MEMBER_ROD : FBD_MEMBER_ROPE,
                   rest_tension(statics, i));
    }
    for (size_t b = 0; fbd_statics_holds(statics) && b < model->body_count; b++)
        add_member(statics, model->bodies[b].name, FBD_MEMBER_BODY, body_tension(statics, b));
    return true;
}

size_t fbd_statics_member_count(const fbd_statics *statics)
{
    return statics ? statics->member_count : 0;
}

fbd_member fbd_statics_member(const fbd_statics *statics, size_t index)
{
    return statics && index < statics->member_count ? statics->members[index] : (fbd_member){.tension = NAN};
}
