/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Applied loads on the links, as wrenches about O, and their variation. Constant forces fixed in the world
 * are in the bias already.
 */
#include "dynamics/laws.h"
#include "dynamics/tree.h"

/* A point of a link: the arm from O, its motion, and the variations of both. */
struct arm {
    struct vec r;
    struct motion_of_point at;
};

static struct arm arm_of(const struct tree_state *s, struct vec point)
{
    struct vec r = vec_turn(s->turn, point);
    return (struct arm){r, {vec_add(s->p, r), vec_add(s->v, vec_scale(s->omega, vec_perp(r)))}};
}

static struct arm arm_along(const struct tree_state *s, const struct tree_variation *d, const struct arm *arm)
{
    struct vec dr = vec_scale(d->angle, vec_perp(arm->r));
    struct vec dv = vec_add(vec_scale(d->omega, vec_perp(arm->r)), vec_scale(s->omega, vec_perp(dr)));
    return (struct arm){dr, {vec_add(d->p, dr), vec_add(d->v, dv)}};
}

static void apply(struct tree_rhs *x, struct vec arm, struct vec f)
{
    x->p.force = vec_sub(x->p.force, f);
    x->p.moment -= vec_cross(arm, f);
}

/* The variation of arm x f and of f. */
static void apply_along(struct tree_rhs *x, const struct arm *arm, const struct arm *d, struct vec f,
                        struct vec df)
{
    x->p.force = vec_sub(x->p.force, df);
    x->p.moment -= vec_cross(d->r, f) + vec_cross(arm->r, df);
}

static struct motion_of_point between(const struct motion_of_point *a, const struct motion_of_point *b)
{
    return (struct motion_of_point){vec_sub(a->p, b->p), vec_sub(a->v, b->v)};
}

/* ---- by kind */

static struct link_law law_of(const struct tree_spring *spring)
{
    return (struct link_law){{0, 0}, spring->stiffness, spring->free_length, spring->damping};
}

/* The end where the opposite of a force acts: that of a guided one is at the same place as the force. */
static struct arm second_arm(const struct tree_spring *spring, const struct tree_state *links,
                             const struct arm *first)
{
    const struct tree_state *s = &links[spring->link[1]];
    if (!spring->guided) return arm_of(s, spring->point[1]);
    const struct vec r = vec_sub(first->at.p, s->p);
    return (struct arm){r, {first->at.p, vec_add(s->v, vec_scale(s->omega, vec_perp(r)))}};
}

static void spring(const struct tree_spring *spring, const struct instant *at)
{
    if (!is_there(at->tree, spring->lifetime)) return;
    const struct tree_state *links = at->tree->links;
    struct tree_rhs *x = at->tree->x;
    struct arm first = arm_of(&links[spring->link[0]], spring->point[0]);
    struct arm second = second_arm(spring, links, &first);
    struct link_law law = law_of(spring);
    struct motion_of_point reach = between(&first.at, &second.at);
    struct vec f = !spring->actuated ? link_force(&law, reach)
                   : spring->guided  ? guided_force(formula_value(&spring->pull, at),
                                                    links[spring->link[1]].turn, spring->along)
                                     : pull_force(formula_value(&spring->pull, at), reach.p);
    apply(&x[spring->link[0]], first.r, f);
    apply(&x[spring->link[1]], second.r, vec_scale(-1, f));
}

/* The variation of the force of an actuator, and of the arm of its opposite where it is guided: the place moves with
 * the first point, not with the second body. */
static void actuator_along(const struct tree_spring *spring, const struct instant *at,
                           const struct direction *along)
{
    const struct tree_work *work = at->tree;
    if (!is_there(work, spring->lifetime)) return;
    const struct tree_state *s = &work->links[spring->link[0]], *t = &work->links[spring->link[1]];
    const struct tree_variation *dt = &work->variation[spring->link[1]];
    const struct arm first = arm_of(s, spring->point[0]);
    const struct arm d_first = arm_along(s, &work->variation[spring->link[0]], &first);
    const struct arm second = second_arm(spring, work->links, &first);
    struct arm d_second = arm_along(t, dt, &second);
    double d_value;
    const double value = formula_along(&spring->pull, at, along, &d_value);
    struct vec f, df;
    if (spring->guided) {
        const struct vec e = vec_turn(t->turn, spring->along);
        f = vec_scale(value, e);
        df = vec_add(vec_scale(d_value, e), vec_scale(dt->angle, vec_perp(f)));
        d_second.r = vec_sub(d_first.at.p, dt->p);
    } else {
        const struct vec reach = vec_sub(first.at.p, second.at.p);
        f = pull_force(value, reach);
        df = pull_variation(value, d_value, reach, vec_sub(d_first.at.p, d_second.at.p));
    }
    apply_along(&work->x[spring->link[0]], &first, &d_first, f, df);
    apply_along(&work->x[spring->link[1]], &second, &d_second, vec_scale(-1, f), vec_scale(-1, df));
}

static void spring_along(const struct tree_spring *spring, const struct tree_work *work)
{
    struct arm arm[2], d[2];
    if (!is_there(work, spring->lifetime)) return;
    for (int end = 0; end < 2; end++) {
        const struct tree_state *s = &work->links[spring->link[end]];
        arm[end] = arm_of(s, spring->point[end]);
        d[end] = arm_along(s, &work->variation[spring->link[end]], &arm[end]);
    }
    struct link_law law = law_of(spring);
    struct motion_of_point reach = between(&arm[0].at, &arm[1].at);
    struct vec f = link_force(&law, reach);
    struct vec df = link_variation(&law, reach, between(&d[0].at, &d[1].at));
    apply_along(&work->x[spring->link[0]], &arm[0], &d[0], f, df);
    apply_along(&work->x[spring->link[1]], &arm[1], &d[1], vec_scale(-1, f), vec_scale(-1, df));
}

static void force(const struct tree_force *force, const struct instant *at)
{
    if (!is_there(at->tree, force->lifetime)) return;
    const struct tree_state *s = &at->tree->links[force->link];
    struct vec d = formula_is_constant(&force->angle)
                       ? force->direction
                       : vec_unit(formula_value(&force->angle, at) + force->turn);
    if (force->body_frame) d = vec_turn(s->turn, d);
    apply(&at->tree->x[force->link], vec_turn(s->turn, force->point),
          vec_scale(formula_value(&force->value, at), d));
}

static void force_along(const struct tree_force *force, const struct instant *at,
                        const struct direction *along)
{
    const struct tree_state *s = &at->tree->links[force->link];
    const struct tree_variation *variation = &at->tree->variation[force->link];
    if (!is_there(at->tree, force->lifetime)) return;
    double d_angle, d_value, angle = formula_along(&force->angle, at, along, &d_angle);
    double value = formula_along(&force->value, at, along, &d_value);
    struct vec u = vec_unit(angle + force->turn);
    if (force->body_frame) {
        u = vec_turn(s->turn, u);
        d_angle += variation->angle;
    }
    struct vec f = vec_scale(value, u);
    struct vec df = vec_add(vec_scale(d_value, u), vec_scale(d_angle, vec_perp(f)));
    struct arm arm = arm_of(s, force->point), d = arm_along(s, variation, &arm);
    apply_along(&at->tree->x[force->link], &arm, &d, f, df);
}

static void moment(const struct tree_moment *moment, double value, const struct tree_work *work)
{
    struct tree_rhs *x = work->x;
    if (!is_there(work, moment->lifetime)) return;
    x[moment->link].p.moment -= value;
    if (moment->partner > 0) x[moment->partner].p.moment += value;
}

/* ---- all loads */

void tree_load(const struct tree *tree, const struct instant *at, const struct link_loads *loads)
{
    const struct tree_state *links = at->tree->links;
    struct tree_rhs *x = at->tree->x;
    const struct range *of = loads->of;
    if (!loads->any) return;
    for (int i = of[list_following].first; i < range_end(of[list_following]); i++) {
        const struct tree_following *f = &tree->following[i];
        x[f->link].p.force = vec_sub(x[f->link].p.force, vec_turn(links[f->link].turn, f->force));
        x[f->link].p.moment -= f->moment;
    }
    for (int i = of[list_forces].first; i < range_end(of[list_forces]); i++) force(&tree->forces[i], at);
    for (int i = of[list_moments].first; i < range_end(of[list_moments]); i++)
        moment(&tree->moments[i], formula_value(&tree->moments[i].value, at), at->tree);
    for (int i = of[list_springs].first; i < range_end(of[list_springs]); i++) spring(&tree->springs[i], at);
    for (int i = of[list_drags].first; i < range_end(of[list_drags]); i++) {
        const struct tree_drag *drag = &tree->drags[i];
        if (!is_there(at->tree, drag->lifetime)) continue;
        struct arm arm = arm_of(&links[drag->link], drag->point);
        struct drag_law law = {drag->linear, drag->quadratic};
        apply(&x[drag->link], arm.r, drag_force(&law, arm.at.v));
    }
}

void tree_load_along(const struct tree *tree, const struct instant *at, const struct direction *along,
                     const struct link_loads *loads)
{
    const struct tree_state *links = at->tree->links;
    const struct tree_variation *variation = at->tree->variation;
    struct tree_rhs *x = at->tree->x;
    const struct range *of = loads->of;
    for (int i = of[list_following].first; i < range_end(of[list_following]); i++) {
        const struct tree_following *f = &tree->following[i];
        struct vec turned = vec_perp(vec_turn(links[f->link].turn, f->force));
        x[f->link].p.force = vec_sub(x[f->link].p.force, vec_scale(variation[f->link].angle, turned));
    }
    for (int i = of[list_forces].first; i < range_end(of[list_forces]); i++)
        force_along(&tree->forces[i], at, along);
    for (int i = of[list_moments].first; i < range_end(of[list_moments]); i++) {
        double variation_of_moment;
        formula_along(&tree->moments[i].value, at, along, &variation_of_moment);
        moment(&tree->moments[i], variation_of_moment, at->tree);
    }
    for (int i = of[list_springs].first; i < range_end(of[list_springs]); i++)
        if (tree->springs[i].actuated)
            actuator_along(&tree->springs[i], at, along);
        else
            spring_along(&tree->springs[i], at->tree);
    for (int i = of[list_drags].first; i < range_end(of[list_drags]); i++) {
        const struct tree_drag *drag = &tree->drags[i];
        if (!is_there(at->tree, drag->lifetime)) continue;
        struct arm arm = arm_of(&links[drag->link], drag->point);
        struct arm d = arm_along(&links[drag->link], &variation[drag->link], &arm);
        struct drag_law law = {drag->linear, drag->quadratic};
        apply_along(&x[drag->link], &arm, &d, drag_force(&law, arm.at.v),
                    drag_variation(&law, arm.at.v, d.at.v));
    }
}
