/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/constraint_view.h"

#include "dynamics/plane_friction.h"
#include "expr/curve.h"
#include "numeric/tolerances.h"

bool port_turns(const struct port *port)
{
    double arm = vec_norm(port->arm), force = vec_norm(port->force);
    double d_arm = vec_norm(port->d_arm), d_force = vec_norm(port->d_force);
    double moment = vec_cross(port->arm, port->force);
    double later = vec_cross(port->d_arm, port->force) + vec_cross(port->arm, port->d_force);
    return fabs(moment) > solved_rounding * arm * force ||
           fabs(later) > solved_rounding * (d_arm * force + arm * d_force);
}

/* ---- kinds */

static void rod(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
                struct row *row)
{
    struct jet_vec A = point_of(view, &coupling->end[0]), B = point_of(view, &coupling->end[1]),
                   d = jet_vec_sub(A, B);
    struct jet length = jet_norm(d);
    struct jet_vec u = jet_vec_times(jet_inverse(length), d);
    start_row(row, jet_sub(length, jet_constant(state->zero)));
    add_port(view, row, coupling, 0, A, u);
    add_port(view, row, coupling, 1, B, negative(u));
}

static void gear(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
                 struct row *row)
{
    double r1 = coupling->end[0].radius, r2 = coupling->end[1].radius, sign = r1 + r2 < 0 ? -1 : 1;
    struct jet_vec C1 = point_of(view, &coupling->end[0]), C2 = point_of(view, &coupling->end[1]),
                   d = jet_vec_sub(C2, C1);
    if (sign < 0) d = negative(d);
    struct jet_vec u = jet_vec_times(jet_inverse(jet_norm(d)), d), t = jet_perp(u);
    struct jet phi = jet_angle(d);
    struct jet g = jet_add(jet_scale(r1, jet_sub(angle_of(view, coupling->end[0].link), phi)),
                           jet_scale(r2, jet_sub(angle_of(view, coupling->end[1].link), phi)));
    const double turn = 6.283185307179586;
    start_row(row, nearest(jet_sub(g, jet_constant(state->zero)), turn * (r1 + r2)));
    struct jet_vec Q1 = jet_vec_sub(C1, jet_vec_times(jet_constant(-r1), u));
    struct jet_vec Q2 = jet_vec_sub(C2, jet_vec_times(jet_constant(r2), u));
    add_port(view, row, coupling, 0, Q1, t);
    add_port(view, row, coupling, 1, Q2, negative(t));
}

/* The relative angle; the couple of a unit multiplier is two forces at the ends of a diameter. */
static void resistance(const struct view *view, const struct coupling *coupling,
                       const struct coupling_state *state, struct row *row)
{
    const double r = coupling->end[0].radius;
    struct jet g = jet_sub(angle_of(view, coupling->end[0].link), angle_of(view, coupling->end[1].link));
    start_row(row, jet_sub(g, jet_constant(state->zero)));
    add_couples(coupling, r, 1 / (2 * r), row);
}

static struct at_line at_line_of(const struct coupling *coupling, const struct coupling_state *state)
{
    return (struct at_line){0, coupling->end[0], coupling->end[1], coupling->e, state->side[0], 1};
}

static void roll(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
                 struct row *rows)
{
    struct at_line at = at_line_of(coupling, state);
    row_line(view, coupling, &at, state->zero, &rows[0], &rows[1]);
}

static void rack(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
                 struct row *row)
{
    struct at_line at = at_line_of(coupling, state);
    row_line(view, coupling, &at, state->zero, NULL, row);
}

/* Set the side of its line on which the circle is. */
static void side_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                       struct row *rows)
{
    struct jet_vec d = jet_vec_sub(point_of(view, &coupling->end[0]), point_of(view, &coupling->end[1]));
    struct jet_vec e = turning(view, coupling->end[1].link, coupling->e);
    if (vec_cross(jet_value(e), jet_value(d)) < 0) state->side[0] = -1;
    zero_start(view, coupling, state, rows);
}

/* ---- all kinds */

const struct constraint_form constraint_forms[constraint_kinds] = {
    [constraint_pin] = {.rows = pin_rows},
    [constraint_weld] = {.rows = weld_rows, .start = weld_start},
    [constraint_rod] = {.rows = rod, .start = zero_start},
    [constraint_gear] = {.rows = gear, .start = zero_start},
    [constraint_rack] = {.rows = rack, .start = side_start},
    [constraint_ratio] = {.rows = ratio_row, .start = zero_start},
    [constraint_roll] = {.rows = roll, .start = side_start},
    [constraint_resistance] = {.rows = resistance, .start = zero_start},
    [constraint_slot] = {.rows = slot_row, .start = slot_start, .follow = slot_follow, .left = slot_room},
    [constraint_groove] = {.rows = slot_row, .start = slot_start, .follow = slot_follow, .left = slot_room},
    [constraint_belt] = {.rows = belt_rows,
                         .start = belt_start,
                         .follow = way_follow,
                         .piece = belt_piece,
                         .tensions = belt_tensions,
                         .share = {0.5, -0.5}},
    [constraint_capstan] = {.rows = capstan_rows,
                            .start = capstan_start,
                            .follow = way_follow,
                            .piece = capstan_piece,
                            .wrap = capstan_wrap,
                            .tensions = capstan_tensions,
                            .share = {-0.5, -0.5}},
    [constraint_rope] = {.rows = rope_row,
                         .start = rope_start,
                         .follow = way_follow,
                         .left = rope_room,
                         .piece = rope_end_piece},
    [constraint_plane] = {.rows = plane_rows, .follow = plane_follow},
    [constraint_contact] = {.rows = contact_rows},
};

/* A coupling that has ended has rows without forces, wherever its ends are. */
static void clear(const struct coupling *coupling, struct row *rows)
{
    for (int k = 0; k < coupling->row_count; k++) {
        start_row(&rows[k], (struct jet){0});
        rows[k].lambda = 0;
    }
}

static void evaluate(const struct view *view, int i)
{
    const struct coupling *coupling = &view->tree->couplings[i];
    if (coupling_is_gone(view->work, coupling)) {
        clear(coupling, &view->work->rows[coupling->first_row]);
        return;
    }
    constraint_forms[coupling->kind].rows(view, coupling, &view->work->couplings[i],
                                          &view->work->rows[coupling->first_row]);
}

void constraints_evaluate(const struct fbd_model *model, const struct instant *at,
                          const struct direction *along)
{
    const struct view view = {model, model->tree, at->tree, along != NULL, at, along};
    for (int i = 0; i < model->tree->coupling_count; i++) evaluate(&view, i);
}

void constraints_select(const struct tree *tree, const struct instant *at)
{
    struct tree_work *work = at->tree;
    work->acting_count = 0;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        const bool open = coupling_is_gone(work, coupling) ||
                          (coupling->kind == constraint_contact && at->slip[coupling->surface] != stick);
        if (!open) work->acting[work->acting_count++] = i;
    }
}

void constraints_evaluate_acting(const struct fbd_model *model, const struct instant *at)
{
    const struct view view = {model, model->tree, at->tree, false, at, NULL};
    for (int k = 0; k < at->tree->acting_count; k++) evaluate(&view, at->tree->acting[k]);
}

struct room coupling_room(const struct fbd_model *model, const struct tree_work *work, int index, int end)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct constraint_form *form = &constraint_forms[coupling->kind];
    struct view view = view_of(model, work);
    if (!form->left) return (struct room){HUGE_VAL, 0, HUGE_VAL};
    /* By value, without pointers to this frame. */
    /* cppcheck-suppress returnDanglingLifetime */
    return form->left(&view, coupling, &work->couplings[index], end);
}

void zero_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                struct row *rows)
{
    constraint_forms[coupling->kind].rows(view, coupling, state, rows);
    state->zero = coupling->length_given ? coupling->length + state->laid[0] + state->laid[1]
                                         : rows[coupling->row_count - 1].g.x;
}

static void start(const struct view *view, int index)
{
    const struct coupling *coupling = &view->tree->couplings[index];
    const struct constraint_form *form = &constraint_forms[coupling->kind];
    struct coupling_state *state = &view->work->couplings[index];
    if (form->start) form->start(view, coupling, state, &view->work->rows[coupling->first_row]);
}

void constraints_start(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    struct view view = {model, tree, work, false, at, NULL};
    for (int i = 0; i < tree->coupling_count; i++) {
        work->couplings[i] = (struct coupling_state){.side = {1, 1}, .e = {1, 0}, .feature = no_feature};
        if (!coupling_is_gone(work, &tree->couplings[i])) start(&view, i);
    }
    for (int i = 0; i < tree->coupling_count; i++)
        if (!coupling_is_gone(work, &tree->couplings[i])) rope_start_wrap(tree, work, i);
}

void coupling_begin(const struct fbd_model *model, const struct instant *at, int index)
{
    struct view view = {model, model->tree, at->tree, false, at, NULL};
    at->tree->couplings[index] = (struct coupling_state){.side = {1, 1}, .e = {1, 0}, .feature = no_feature};
    start(&view, index);
    rope_start_wrap(model->tree, at->tree, index);
}

void constraints_follow(const struct fbd_model *model, struct tree_work *work)
{
    struct view view = view_of(model, work);
    for (int i = 0; i < model->tree->coupling_count; i++) {
        const struct coupling *coupling = &model->tree->couplings[i];
        const struct constraint_form *form = &constraint_forms[coupling->kind];
        if (form->follow && !coupling_is_gone(work, coupling))
            form->follow(&view, coupling, &work->couplings[i]);
    }
}

bool couplings_go_on(const struct tree *tree)
{
    for (int i = 0; i < tree->coupling_count; i++) {
        enum constraint_kind kind = tree->couplings[i].kind;
        if (kind != constraint_pin && kind != constraint_weld && kind != constraint_rod &&
            kind != constraint_gear && kind != constraint_ratio)
            return false;
    }
    return true;
}

/* ---- rolling and sliding bodies */

void coupling_set_feature(const struct fbd_model *model, const struct instant *at, int index, int feature)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    struct tree_work *work = at->tree;
    const struct view view = {model, model->tree, work, false, at, NULL};
    work->couplings[index].feature = feature;
    work->couplings[index].zero = 0;
    contact_rows(&view, coupling, &work->couplings[index], &work->rows[coupling->first_row]);
    work->couplings[index].zero = work->rows[coupling->first_row + 1].g.x;
}

static const struct row *row_along(const struct fbd_model *model, const struct tree_work *work, int coupling)
{
    return &work->rows[model->tree->couplings[coupling].along_row];
}

static double shortest_strand(const struct fbd_model *model, const struct instant *at, int index)
{
    double shortest = HUGE_VAL;
    for (int k = 0; k < 2; k++) shortest = fmin(shortest, rope_piece(model, at->tree, index, k).left);
    return shortest;
}

/* A speed whose rounding is that of positions. The velocity along a rope is in the direction of its strands,
 * with the relative accuracy of their ends' positions over their length. The position in a slot is a
 * difference of positions, which turns with the slot, and determines the direction of a curve. */
static double remoteness(const struct fbd_model *model, const struct instant *at, int index, double size)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct curve *curve = coupling->source->curve;
    const struct row *row = row_along(model, at->tree, index);
    double place = 0, turns = 0;
    for (int k = 0; k < row->port_count; k++) {
        const struct tree_state *s = &at->tree->links[row->ports[k].link];
        place = fmax(place, vec_norm(s->p));
        turns = fmax(turns, fabs(s->omega));
    }
    if (coupling->kind == constraint_capstan) return size * place / shortest_strand(model, at, index);
    if (coupling->kind != constraint_groove) return 0;
    double bend = curve ? curve_at(curve, NULL, at->tree->couplings[index].foot).bend : 0;
    return place * (turns + fabs(bend) * size);
}

/* The largest speed of a link, or of rotation at the distance `arm`; computed once for each evaluation. */
static double fastest(const struct tree *tree, struct tree_work *work, double arm)
{
    if (work->fastest < 0) {
        work->fastest = work->spin = 0;
        for (int i = 1; i < tree->count; i++) {
            work->fastest = fmax(work->fastest, vec_norm(work->links[i].v));
            work->spin = fmax(work->spin, fabs(work->links[i].omega));
        }
    }
    return fmax(work->fastest, work->spin * arm);
}

double coupling_slip_rounding(const struct fbd_model *model, const struct instant *at, int coupling)
{
    const struct row *row = row_along(model, at->tree, coupling);
    bool touches = model->tree->couplings[coupling].meeting >= 0;
    double size = 0, reach = 0;
    for (int k = 0; k < row->port_count; k++) {
        const struct tree_state *s = &at->tree->links[row->ports[k].link];
        double arm = vec_norm(row->ports[k].arm);
        reach = fmax(reach, arm);
        size = fmax(size, vec_norm(s->v) + fabs(s->omega) * arm);
        /* For a body at rest the only scale of speed is that of falling over. */
        if (touches) size = fmax(size, sqrt(vec_norm(model->scene->gravity) * arm));
    }
    size = fmax(size, fabs(row_along(model, at->tree, coupling)->surface));
    /* A body was brought to rest by a projection, with all moving ones; a contact by its impulses. */
    double moves = touches ? 0 : fastest(model->tree, at->tree, reach);
    if (model->tree->couplings[coupling].kind == constraint_resistance) { /* an angular velocity */
        size /= reach;
        moves /= reach;
    }
    return round_off(64, size + remoteness(model, at, coupling, size)) + round_off(4, moves);
}

double coupling_slip_velocity(const struct fbd_model *model, const struct instant *at, int coupling)
{
    double v = row_along(model, at->tree, coupling)->g.x1;
    return fabs(v) <= coupling_slip_rounding(model, at, coupling) ? 0 : v;
}

struct slip_rate coupling_slip(const struct fbd_model *model, const struct instant *at, int index,
                               const struct direction *along)
{
    const bool varied = along != NULL;
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct coupling_state *state = &at->tree->couplings[index];
    struct view view = {model, model->tree, at->tree, varied, at, along};
    struct at_line where = at_line_of(coupling, state);
    struct row tangent;
    if (coupling->kind == constraint_resistance)
        resistance(&view, coupling, state, &tangent);
    else
        row_line(&view, coupling, &where, state->zero, NULL, &tangent);
    return (struct slip_rate){tangent.g.x1, tangent.g.d1};
}

double coupling_slip_acceleration(const struct fbd_model *model, const struct instant *at, int coupling)
{
    return row_along(model, at->tree, coupling)->g.x2;
}

void coupling_rezero(const struct fbd_model *model, struct tree_work *work, int coupling)
{
    work->couplings[coupling].zero += row_along(model, work, coupling)->g.x;
}

/* ---- one-sided constraints */

bool slot_is_open(const struct coupling *coupling, const int *slip)
{
    const bool slot = coupling->kind == constraint_slot || coupling->kind == constraint_groove;
    return slot && coupling->surface >= 0 && slip[coupling->surface] != stick;
}

/* Beyond an end of its slot a free point can meet that end only, at the distance D with D^2 = left^2 + h^2:
 * the curve continues straight there, at the distance h from the point. On its side D = h at the end of the
 * slot, with the same rate. */
static void look_past_end(const struct fbd_model *model, const struct instant *at, const struct mode *hold,
                          struct one_sided *state)
{
    const struct coupling *coupling = &model->tree->couplings[hold->coupling];
    const double radius = coupling->end[0].radius, h = radius - state->excess;
    for (int end = 0; end < 2; end++) {
        const struct room room = coupling_room(model, at->tree, hold->coupling, end);
        if (!(room.left < -slot_rounding * room.size)) continue;
        const double D = hypot(room.left, h);
        state->rate = -(room.left * room.rate - h * state->rate) / D;
        state->excess = radius - D;
    }
}

struct one_sided one_sided_at(const struct fbd_model *model, const struct instant *at, int pair)
{
    const struct mode *hold = &model->plan.modes[pair];
    const struct coupling *coupling = &model->tree->couplings[hold->coupling];
    const struct row *row = &at->tree->rows[coupling->first_row];
    bool rope = hold->kind == mode_rope;
    double sign = rope ? 1 : -1, length = rope ? fabs(at->tree->couplings[hold->coupling].zero) : 0,
           reach = 0;
    double size = 0;
    for (int j = 0; j < coupling->row_count; j++) size = fmax(size, fabs(row[j].lambda));
    struct one_sided state = {.excess = sign * row->g.x,
                              .rate = sign * row->g.x1,
                              .acceleration = sign * row->g.x2,
                              .force = -sign * row->lambda};
    if (slot_is_open(coupling, at->slip)) look_past_end(model, at, hold, &state);
    for (int k = 0; k < coupling->end_count; k++) {
        const struct tree_state *s = &at->tree->links[coupling->end[k].link];
        double arm = coupling->end[k].radius + vec_norm(coupling->end[k].point);
        reach = fmax(reach, vec_norm(s->p) + coupling->end[k].radius);
        size = fmax(size, vec_norm(model->tree->links[coupling->end[k].link].force));
        state.turning = fmax(state.turning, fabs(s->omega));
        /* A point at rest by opposite motions of two joints has the rounding of both. */
        for (int l = coupling->end[k].link; l > 0; l = model->tree->links[l].parent) {
            const struct tree_state *below = &at->tree->links[l];
            state.speed = fmax(state.speed, vec_norm(below->v) + fabs(below->omega) * arm);
        }
    }
    length += reach;
    state.slack = negligible_sum * size;
    /* For a body at rest: the angular velocity of a pendulum of that length. */
    if (length > 0) state.turning = fmax(state.turning, sqrt(vec_norm(model->scene->gravity) / length));
    state.rounding = round_off(16, length);
    state.near = undecided_part * length;
    /* If all these links are at rest: the rounding of the fastest link of the scene, to which they may be
     * coupled, and the speed of a fall from that height. */
    double fast =
        fmax(sqrt(vec_norm(model->scene->gravity) * length), fastest(model->tree, at->tree, length));
    double slow = round_off(64, fast);
    state.touches =
        fabs(state.excess) <= state.near && fabs(state.rate) <= solved_rounding * state.speed + slow;
    state.parts = state.rate < -distinct_part * state.speed - slow;
    state.meets = state.rate > distinct_part * state.speed + slow;
    return state;
}
