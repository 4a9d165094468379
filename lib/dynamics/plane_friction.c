/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/plane_friction.h"

#include "dynamics/friction.h"
#include "dynamics/tree_system.h"
#include "numeric/tolerances.h"

/* ---- rows */

/* The relative velocity of the point, the plane carried along: r' - omega k x r with r from the origin of the plane,
 * and its rate, with variations. */
static struct jet_vec slip_of(const struct view *view, const struct coupling *coupling)
{
    const int on = coupling->end[1].link;
    const struct jet_vec r = jet_vec_sub(point_of(view, &coupling->end[0]), origin_of(view, on));
    const struct jet theta = angle_of(view, on);
    const struct jet_vec k_r = jet_perp(r);
    const struct jet turning = {theta.x1, theta.x2, 0, theta.d1, theta.d2, 0};
    const struct jet_vec v = {{r.x.x1, r.x.x2, 0, r.x.d1, r.x.d2, 0}, {r.y.x1, r.y.x2, 0, r.y.d1, r.y.d2, 0}};
    return jet_vec_sub(v, jet_vec_times(turning, k_r));
}

static void set_row(const struct view *view, const struct coupling *coupling, struct jet_vec u, struct vec e,
                    struct row *row)
{
    const struct jet_vec P = point_of(view, &coupling->end[0]);
    const struct jet_vec f = {jet_constant(e.x), jet_constant(e.y)};
    const struct jet along = jet_dot(f, u);
    start_row(row, (struct jet){0, along.x, along.x1, 0, along.d, along.d1});
    add_port(view, row, coupling, 0, P, f);
    add_port(view, row, coupling, 1, P, negative(f));
}

void plane_rows(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
                struct row *rows)
{
    const struct jet_vec u = slip_of(view, coupling);
    set_row(view, coupling, u, state->e, &rows[0]);
    set_row(view, coupling, u, vec_perp(state->e), &rows[1]);
}

/* ---- velocities */

/* A point on a plane, by positions and velocities of the links. */
struct slip_of_point {
    struct vec u, arm[2]; /* arms from the origins of both links */
    double size;          /* of the velocities of which u is the difference */
};

static struct slip_of_point slip_now(const struct coupling *coupling, const struct tree_state *links)
{
    const struct tree_state *body = &links[coupling->end[0].link], *on = &links[coupling->end[1].link];
    const struct vec own = vec_turn(body->turn, coupling->end[0].point);
    const struct vec r = vec_sub(vec_add(body->p, own), on->p);
    const struct vec v = vec_add(body->v, vec_scale(body->omega, vec_perp(own)));
    const struct vec w = vec_add(on->v, vec_scale(on->omega, vec_perp(r)));
    return (struct slip_of_point){vec_sub(v, w), {own, r}, vec_norm(v) + vec_norm(w)};
}

void plane_follow(const struct view *view, const struct coupling *coupling, struct coupling_state *state)
{
    const double rounding = solved_rounding; /* it sticks */
    const double turned = 0.5;               /* by 60 degrees */
    const struct slip_of_point now = slip_now(coupling, view->work->links);
    const double speed = vec_norm(now.u);
    if (speed <= fmax(rounding * now.size, state->slow)) return;
    state->gently = false;
    state->nu = state->soft;
    if (vec_dot(state->e, now.u) < turned * speed) state->e = vec_scale(1 / speed, now.u);
}

static bool plane_slips(const struct tree *tree, const struct instant *at, int index)
{
    const struct coupling *coupling = &tree->couplings[index];
    return coupling->kind == constraint_plane && slip_side(at->slip[coupling->pair]) != 0 &&
           !coupling_is_gone(at->tree, coupling);
}

bool planes_are_one(const struct tree *tree, int one, int other)
{
    const struct coupling *a = &tree->couplings[one], *b = &tree->couplings[other];
    return a->kind == constraint_plane && b->kind == constraint_plane && a->end[0].link == b->end[0].link &&
           a->end[1].link == b->end[1].link;
}

struct plane_speed plane_speed(const struct fbd_model *model, const struct tree_work *work, int index)
{
    const struct slip_of_point now = slip_now(&model->tree->couplings[index], work->links);
    return (struct plane_speed){vec_norm(now.u), now.size};
}

bool planes_stick(const struct tree *tree, const struct instant *at)
{
    for (int i = 0; i < tree->coupling_count; i++)
        if (tree->couplings[i].kind == constraint_plane && at->slip[tree->couplings[i].pair] == stick &&
            !coupling_is_gone(at->tree, &tree->couplings[i]))
            return true;
    return false;
}

/* ---- forces while it slips */

static double limit_of(const struct fbd_model *model, const struct instant *at, int index,
                       const struct direction *along, double *variation)
{
    const int pair = model->tree->couplings[index].pair;
    return friction_coefficient(model, pair, &model->plan.modes[pair].mu_k, at, along, variation);
}

void plane_begin(const struct fbd_model *model, const struct instant *at, int index, struct vec e)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    struct coupling_state *state = &at->tree->couplings[index];
    const struct slip_of_point now = slip_now(coupling, at->tree->links);
    const double soft = limit_of(model, at, index, NULL, NULL) * coupling->soft,
                 error = at->tree->tolerance * now.size;
    state->e = e;
    state->nu = state->soft = soft;
    state->slow = fmax(soft_speeds * soft, slow_errors * error);
    state->across = round_off(16, now.size);
    state->gently = false;
}

void plane_aim(const struct fbd_model *model, const struct instant *at, int index)
{
    const struct vec u = slip_now(&model->tree->couplings[index], at->tree->links).u;
    if (vec_norm(u) > 0) plane_begin(model, at, index, vec_scale(1 / vec_norm(u), u));
}

/* u + nu e, without a part across e that is round-off. */
static struct vec softened(struct vec u, const struct coupling_state *state)
{
    const double along = vec_dot(state->e, u) + state->nu, across = vec_cross(state->e, u);
    return vec_turn(state->e, (struct vec){along, fabs(across) <= state->across ? 0 : across});
}

/* The direction of friction, -s w / |w|. */
static struct vec against(struct vec w, struct vec e)
{
    const double speed = vec_norm(w);
    if (speed == 0) return vec_scale(-1, e);
    return vec_scale(vec_dot(w, e) < 0 ? 1 / speed : -1 / speed, w);
}

static void push(struct tree_rhs *x, struct vec arm, struct vec f)
{
    x->p.force = vec_sub(x->p.force, f);
    x->p.moment -= vec_cross(arm, f);
}

/* Their direction is kept: where e . u is round-off, another evaluation of the velocity could have the other sign. */
void planes_load(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int i = 0; i < tree->coupling_count; i++) {
        if (!plane_slips(tree, at, i)) continue;
        const struct coupling *coupling = &tree->couplings[i];
        const struct slip_of_point now = slip_now(coupling, work->links);
        struct coupling_state *state = &work->couplings[i];
        state->n = against(softened(now.u, state), state->e);
        const struct vec f = vec_scale(limit_of(model, at, i, NULL, NULL), state->n);
        push(&work->x[coupling->end[0].link], now.arm[0], f);
        push(&work->x[coupling->end[1].link], now.arm[1], vec_scale(-1, f));
    }
}

/* Of n along e and k x e. */
static struct vec direction_of(const struct coupling_state *state)
{
    return (struct vec){vec_dot(state->e, state->n), vec_cross(state->e, state->n)};
}

void planes_take_multipliers(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    for (int i = 0; i < tree->coupling_count; i++) {
        if (!plane_slips(tree, at, i)) continue;
        struct row *rows = &at->tree->rows[tree->couplings[i].first_row];
        const struct vec n = direction_of(&at->tree->couplings[i]);
        const double limit = limit_of(model, at, i, NULL, NULL);
        rows[0].lambda = limit * n.x;
        rows[1].lambda = limit * n.y;
    }
}

/* n = -s w / |w| turns with the rate n x (-s dw) / |w|. */
static void force_along(const struct fbd_model *model, const struct instant *at, int index,
                        const struct direction *along, double lambda[2])
{
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct row *rows = &at->tree->rows[coupling->first_row];
    const struct vec n = direction_of(&at->tree->couplings[index]);
    double d_limit;
    const double limit = limit_of(model, at, index, along, &d_limit);
    const struct vec w = {rows[0].g.x1 + at->tree->couplings[index].nu, rows[1].g.x1};
    const struct vec dw = {rows[0].g.d1, rows[1].g.d1};
    const double forward = vec_dot(w, n), turned = forward != 0 ? limit * vec_cross(n, dw) / forward : 0;
    lambda[0] = d_limit * n.x - turned * n.y;
    lambda[1] = d_limit * n.y + turned * n.x;
}

void planes_apply_variations(const struct fbd_model *model, const struct instant *at,
                             const struct direction *along)
{
    const struct tree *tree = model->tree;
    for (int i = 0; i < tree->coupling_count; i++) {
        double lambda[2];
        if (!plane_slips(tree, at, i)) continue;
        force_along(model, at, i, along, lambda);
        for (int k = 0; k < 2; k++)
            row_apply(&at->tree->rows[tree->couplings[i].first_row + k], lambda[k], at->tree->x);
    }
}

void planes_take_variations(const struct fbd_model *model, const struct instant *at,
                            const struct direction *along)
{
    const struct tree *tree = model->tree;
    for (int i = 0; i < tree->coupling_count; i++)
        if (plane_slips(tree, at, i))
            force_along(model, at, i, along, &at->tree->z[tree->couplings[i].first_row]);
}
