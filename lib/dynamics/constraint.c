/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/constraint_view.h"

#include <float.h>

/* ---- kinds */

static void pin(const struct view *view, const struct tie *tie, struct row *rows)
{
    struct jet_vec A = point_of(view, &tie->end[0]), B = point_of(view, &tie->end[1]), d = jet_vec_sub(A, B);
    struct jet_vec unit[2] = {{jet_constant(1), jet_constant(0)}, {jet_constant(0), jet_constant(1)}};
    for (int k = 0; k < 2; k++) {
        start_row(&rows[k], k == 0 ? d.x : d.y);
        add_port(view, &rows[k], tie, 0, A, unit[k]);
        add_port(view, &rows[k], tie, 1, B, negative(unit[k]));
    }
}

static void rod(const struct view *view, const struct tie *tie, const struct tie_state *state,
                struct row *row)
{
    struct jet_vec A = point_of(view, &tie->end[0]), B = point_of(view, &tie->end[1]), d = jet_vec_sub(A, B);
    struct jet length = jet_norm(d);
    struct jet_vec u = jet_vec_times(jet_inverse(length), d);
    start_row(row, jet_sub(length, jet_constant(state->zero)));
    add_port(view, row, tie, 0, A, u);
    add_port(view, row, tie, 1, B, negative(u));
}

static void gear(const struct view *view, const struct tie *tie, const struct tie_state *state,
                 struct row *row)
{
    double r1 = tie->end[0].radius, r2 = tie->end[1].radius, sign = r1 + r2 < 0 ? -1 : 1;
    struct jet_vec C1 = point_of(view, &tie->end[0]), C2 = point_of(view, &tie->end[1]),
                   d = jet_vec_sub(C2, C1);
    if (sign < 0) d = negative(d);
    struct jet_vec u = jet_vec_times(jet_inverse(jet_norm(d)), d), t = jet_perp(u);
    struct jet phi = jet_angle(d);
    struct jet g = jet_add(jet_scale(r1, jet_sub(angle_of(view, tie->end[0].link), phi)),
                           jet_scale(r2, jet_sub(angle_of(view, tie->end[1].link), phi)));
    const double turn = 6.283185307179586;
    start_row(row, nearest(jet_sub(g, jet_constant(state->zero)), turn * (r1 + r2)));
    struct jet_vec Q1 = jet_vec_sub(C1, jet_vec_times(jet_constant(-r1), u));
    struct jet_vec Q2 = jet_vec_sub(C2, jet_vec_times(jet_constant(r2), u));
    add_port(view, row, tie, 0, Q1, t);
    add_port(view, row, tie, 1, Q2, negative(t));
}

static struct at_line at_line_of(const struct tie *tie, const struct tie_state *state)
{
    return (struct at_line){0, tie->end[0], tie->end[1], tie->e, state->side[0]};
}

/* ---- ropes: a straight piece from a circle (or point) to the next, see the derivation
 *
 * Leaving a circle of radius R round which it runs with side s, a piece of direction u starts at C - s R k x
 * u. With d = C_2 - C_1 and rho = s_2 R_2 - s_1 R_1 this gives d = t u + rho k x u, so that its length is t =
 * sqrt(d^2 - rho^2), and u is d turned by -atan(rho / t). */

struct piece {
    struct jet t;
    struct jet_vec u, Q1, Q2;
    bool shrunk; /* to a point */
};

/* Both ends of a piece are at one point. |d| has a kink there, and what follows is on the side to which they
 * part: with d = v s + a s^2 / 2 it is |v| s + (v . a) s^2 / 2 |v|, along u = v / |v|; without v along a.
 * Ends that stay together have no direction. */
static struct piece piece_at_a_point(struct jet_vec C1, struct jet_vec d)
{
    struct vec v = {d.x.x1, d.y.x1}, a = {d.x.x2, d.y.x2}, along = vec_norm(v) > 0 ? v : a;
    double size = vec_norm(along);
    struct vec u = size > 0 ? vec_scale(1 / size, along) : (struct vec){0, 0};
    struct jet_vec direction = {jet_constant(u.x), jet_constant(u.y)};
    return (struct piece){jet_dot(d, direction), direction, C1, C1, true};
}

static struct piece piece_between(struct jet_vec C1, double sR1, struct jet_vec C2, double sR2)
{
    double rho = sR2 - sR1;
    struct jet_vec d = jet_vec_sub(C2, C1);
    struct jet d2 = jet_dot(d, d);
    if (rho == 0 && sR1 == 0 && d2.x == 0) return piece_at_a_point(C1, d);
    struct piece piece = {.t = jet_sqrt(jet_sub(d2, jet_constant(rho * rho)))};
    struct jet scale = jet_inverse(d2);
    piece.u.x = jet_mul(scale, jet_add(jet_mul(d.x, piece.t), jet_scale(rho, d.y)));
    piece.u.y = jet_mul(scale, jet_sub(jet_mul(d.y, piece.t), jet_scale(rho, d.x)));
    struct jet_vec across = jet_perp(piece.u);
    piece.Q1 = jet_vec_sub(C1, jet_vec_times(jet_constant(sR1), across));
    piece.Q2 = jet_vec_sub(C2, jet_vec_times(jet_constant(sR2), across));
    return piece;
}

/* How far u has turned at that end since the start, whole turns with it. */
static struct jet turned_at(const struct tie_state *state, int end, struct jet_vec u)
{
    const double turn = 6.283185307179586;
    double c = cos(state->psi[end]), s = sin(state->psi[end]);
    struct jet_vec relative = {jet_add(jet_scale(c, u.x), jet_scale(s, u.y)),
                               jet_sub(jet_scale(c, u.y), jet_scale(s, u.x))};
    struct jet angle = jet_angle(relative);
    double turns = round((state->turned[end] - angle.x) / turn);
    if (turns != 0) angle.x += turns * turn;
    return angle;
}

/* Side times radius of what piece k of a rope leaves (end 0) or reaches (1): 0 where that is a point. */
static double rim(const struct tie *tie, const struct tie_state *state, int k, int end)
{
    bool outer = end == 0 ? k == 0 : k + 2 == tie->end_count;
    return outer ? state->side[end] * tie->end[k + end].radius : 0;
}

static struct piece piece_of(const struct view *view, const struct tie *tie, const struct tie_state *state,
                             int k)
{
    return piece_between(point_of(view, &tie->end[k]), rim(tie, state, k, 0),
                         point_of(view, &tie->end[k + 1]), rim(tie, state, k, 1));
}

/* The first or the last. */
static struct piece piece_at(const struct view *view, const struct tie *tie, const struct tie_state *state,
                             int end)
{
    return piece_of(view, tie, state, end == 0 ? 0 : tie->end_count - 2);
}

/* A taut rope pulls along its pieces: where one of them is a point that has no direction, and no force. */
static void refuse_direction(struct row *row)
{
    for (int i = 0; i < row->port_count; i++) row->ports[i].force = (struct vec){NAN, NAN};
}

static void rope(const struct view *view, const struct tie *tie, const struct tie_state *state,
                 struct row *row)
{
    const double taut = 1e-9; /* of its length */
    int last = tie->end_count - 1;
    bool shrunk = false;
    struct jet length = jet_constant(-state->zero);
    start_row(row, length);
    for (int k = 0; k < last; k++) {
        const struct tie_end *from = &tie->end[k], *to = &tie->end[k + 1];
        double sR1 = rim(tie, state, k, 0), sR2 = rim(tie, state, k, 1);
        struct piece piece = piece_of(view, tie, state, k);
        length = jet_add(length, piece.t);
        shrunk |= piece.shrunk;
        if (sR1 != 0) {
            struct jet round = jet_sub(turned_at(state, 0, piece.u), angle_of(view, from->link));
            length = jet_add(length, jet_scale(sR1, round));
        }
        if (sR2 != 0) {
            struct jet round = jet_sub(angle_of(view, to->link), turned_at(state, 1, piece.u));
            length = jet_add(length, jet_scale(sR2, round));
        }
        add_port(view, row, tie, k, piece.Q1, negative(piece.u));
        add_port(view, row, tie, k + 1, piece.Q2, piece.u);
    }
    row->g = length;
    if (shrunk && !(length.x < -taut * state->zero)) refuse_direction(row);
}

int rope_blocked_at(const struct fbd_model *model, const struct tree_work *work, int index)
{
    const struct tie *tie = &model->tree->ties[index];
    const struct tie_state *state = &work->ties[index];
    struct view view = {model->tree, work, false};
    int last = tie->end_count - 1;
    for (int k = 0; k < last; k++) {
        double sR1 = rim(tie, state, k, 0), sR2 = rim(tie, state, k, 1);
        struct vec from = jet_value(point_of(&view, &tie->end[k]));
        struct vec to = jet_value(point_of(&view, &tie->end[k + 1]));
        bool rims = sR1 != 0 || sR2 != 0;
        if (rims && !(vec_norm(vec_sub(to, from)) > fabs(sR2 - sR1))) return k;
    }
    return -1;
}

bool rope_goes_on(const struct tree *tree, int index)
{
    const struct tie *tie = &tree->ties[index];
    if (tie->kind != constraint_rope || index + 1 >= tree->tie_count) return false;
    return tie->end[tie->end_count - 1].radius > 0 && tie[1].constraint == tie->constraint;
}

static double turned_now(const struct fbd_model *model, const struct tree_work *work, int index, int end)
{
    struct view view = {model->tree, work, false};
    const struct tie_state *state = &work->ties[index];
    return turned_at(state, end, piece_at(&view, &model->tree->ties[index], state, end).u).x;
}

double rope_wrap(const struct fbd_model *model, const struct tree_work *work, int index)
{
    const struct tie_state *before = &work->ties[index], *after = before + 1;
    double in = before->psi[1] + turned_now(model, work, index, 1);
    double out = after->psi[0] + turned_now(model, work, index + 1, 0);
    return before->side[1] * (out - in);
}

void constraints_follow(const struct fbd_model *model, struct tree_work *work)
{
    const struct tree *tree = model->tree;
    for (int i = 0; i < tree->tie_count; i++) {
        const struct tie *tie = &tree->ties[i];
        struct tie_state *state = &work->ties[i];
        if (tie->kind != constraint_rope) continue;
        for (int end = 0; end < 2; end++)
            if (state->side[end] != 0) state->turned[end] = turned_now(model, work, i, end);
    }
}

/* ---- all of them */

static void evaluate(const struct view *view, const struct tie *tie, const struct tie_state *state,
                     struct row *rows)
{
    switch (tie->kind) {
    case constraint_pin: pin(view, tie, rows); break;
    case constraint_rod: rod(view, tie, state, rows); break;
    case constraint_gear: gear(view, tie, state, rows); break;
    case constraint_rope: rope(view, tie, state, rows); break;
    case constraint_roll:
    case constraint_rack: {
        struct at_line at = at_line_of(tie, state);
        bool rolls = tie->kind == constraint_roll;
        row_line(view, tie, &at, state->zero, rolls ? &rows[0] : NULL, rolls ? &rows[1] : &rows[0]);
        break;
    }
    case constraint_contact: contact_rows(view, tie, state, rows); break;
    }
}

void constraints_evaluate(const struct fbd_model *model, struct tree_work *work, bool varied)
{
    const struct tree *tree = model->tree;
    struct view view = {tree, work, varied};
    for (int i = 0; i < tree->tie_count; i++)
        evaluate(&view, &tree->ties[i], &work->ties[i], &work->rows[tree->ties[i].first_row]);
}

/* ---- the start */

/* Which way a rope runs round the pulley at place k of its way: as it turns there. */
static int side_at(const struct fbd_model *model, const struct view *view, const struct tie *tie, int k)
{
    const struct constraint *source = &model->scene->constraints[tie->constraint];
    struct vec place[3];
    for (int i = 0; i < 3; i++) {
        struct tie_end end = tie_end_of(model, tie->constraint, k - 1 + i);
        place[i] = jet_value(point_of(view, &end));
    }
    if (source->radius[k] == 0) return 0;
    return vec_cross(vec_sub(place[1], place[0]), vec_sub(place[2], place[1])) > 0 ? 1 : -1;
}

static void start_rope(const struct fbd_model *model, const struct view *view, const struct tie *tie,
                       struct tie_state *state)
{
    int last = tie->end_count - 1;
    state->side[0] = tie->end[0].radius > 0 ? side_at(model, view, tie, tie->place) : 0;
    state->side[1] = tie->end[last].radius > 0 ? side_at(model, view, tie, tie->place + last) : 0;
    for (int end = 0; end < 2; end++) {
        struct jet_vec u = piece_at(view, tie, state, end).u;
        state->psi[end] = atan2(u.y.x, u.x.x);
    }
}

/* At the start a rope goes round its pulley by three quarters of a turn at most, and may be off it by less
 * than the fourth: the directions before and behind are told apart by so much. */
static void start_wrap(const struct tree *tree, struct tree_work *work, int index)
{
    const double turn = 6.283185307179586;
    if (!rope_goes_on(tree, index)) return;
    struct tie_state *before = &work->ties[index], *after = before + 1;
    double wrap = before->side[1] * (after->psi[0] - before->psi[1]);
    after->psi[0] -= before->side[1] * turn * floor(wrap / turn + 0.25);
}

void constraints_start(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    struct view view = {model->tree, work, false};
    for (int i = 0; i < tree->tie_count; i++) {
        const struct tie *tie = &tree->ties[i];
        struct tie_state *state = &work->ties[i];
        struct row *rows = &work->rows[tie->first_row];
        *state = (struct tie_state){.side = {1, 1}, .feature = no_feature};
        if (tie->kind == constraint_roll || tie->kind == constraint_rack) {
            struct jet_vec d = jet_vec_sub(point_of(&view, &tie->end[0]), point_of(&view, &tie->end[1]));
            struct jet_vec e = turning(&view, tie->end[1].link, tie->e);
            if (vec_cross(jet_value(e), jet_value(d)) < 0) state->side[0] = -1;
        }
        if (tie->kind == constraint_rope) start_rope(model, &view, tie, state);
        if (tie->kind == constraint_pin || tie->kind == constraint_contact) continue;
        evaluate(&view, tie, state, rows);
        state->zero = tie->length_given ? tie->length : rows[tie->row_count - 1].g.x;
    }
    for (int i = 0; i < tree->tie_count; i++) start_wrap(tree, work, i);
}

/* ---- bodies that roll or rub */

void tie_set_feature(const struct fbd_model *model, struct tree_work *work, int index, int feature)
{
    const struct tie *tie = &model->tree->ties[index];
    struct view view = {model->tree, work, false};
    work->ties[index].feature = feature;
    work->ties[index].zero = 0;
    contact_rows(&view, tie, &work->ties[index], &work->rows[tie->first_row]);
    work->ties[index].zero = work->rows[tie->first_row + 1].g.x;
}

static const struct row *row_along(const struct fbd_model *model, const struct tree_work *work, int tie)
{
    return &work->rows[model->tree->ties[tie].first_row + 1];
}

double tie_slip_velocity(const struct fbd_model *model, const struct instant *at, int tie)
{
    const struct row *row = row_along(model, at->tree, tie);
    bool touches = model->tree->ties[tie].meeting >= 0;
    double v = row->g.x1, size = 0;
    for (int k = 0; k < row->port_count; k++) {
        const struct tree_state *s = &at->tree->links[row->ports[k].link];
        double arm = vec_norm(row->ports[k].arm);
        size = fmax(size, vec_norm(s->v) + fabs(s->omega) * arm);
        /* What has come down and rests has no speed to measure rounding against but that of falling over. */
        if (touches) size = fmax(size, sqrt(vec_norm(model->scene->gravity) * arm));
    }
    return fabs(v) <= 64 * DBL_EPSILON * size ? 0 : v;
}

struct slip_rate tie_slip(const struct fbd_model *model, const struct instant *at, int index, bool varied)
{
    const struct tie *tie = &model->tree->ties[index];
    const struct tie_state *state = &at->tree->ties[index];
    struct view view = {model->tree, at->tree, varied};
    struct at_line where = at_line_of(tie, state);
    struct row along;
    row_line(&view, tie, &where, state->zero, NULL, &along);
    return (struct slip_rate){along.g.x1, along.g.d1};
}

double tie_slip_acceleration(const struct fbd_model *model, const struct instant *at, int tie)
{
    return row_along(model, at->tree, tie)->g.x2;
}

void tie_rezero(const struct fbd_model *model, struct tree_work *work, int tie)
{
    work->ties[tie].zero += row_along(model, work, tie)->g.x;
}

/* ---- what is one-sided */

/* The largest speed of a link, and of what turns with one at the distance `arm`; found once for each
 * evaluation. */
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

struct one_sided one_sided_at(const struct fbd_model *model, const struct instant *at, int pair)
{
    const struct friction *hold = &model->plan.frictions[pair];
    const struct tie *tie = &model->tree->ties[hold->tie];
    const struct row *row = &at->tree->rows[tie->first_row];
    bool rope = hold->kind == mode_rope;
    double sign = rope ? 1 : -1, length = rope ? fabs(at->tree->ties[hold->tie].zero) : 0, reach = 0;
    double size = 0;
    for (int j = 0; j < tie->row_count; j++) size = fmax(size, fabs(row[j].lambda));
    struct one_sided state = {.excess = sign * row->g.x,
                              .rate = sign * row->g.x1,
                              .acceleration = sign * row->g.x2,
                              .force = -sign * row->lambda};
    for (int k = 0; k < tie->end_count; k++) {
        const struct tree_state *s = &at->tree->links[tie->end[k].link];
        double arm = tie->end[k].radius + vec_norm(tie->end[k].point);
        reach = fmax(reach, vec_norm(s->p) + tie->end[k].radius);
        size = fmax(size, vec_norm(model->tree->links[tie->end[k].link].force));
        state.turning = fmax(state.turning, fabs(s->omega));
        /* What stands still as one joint takes back what another does has the rounding of both. */
        for (int l = tie->end[k].link; l > 0; l = model->tree->links[l].parent) {
            const struct tree_state *below = &at->tree->links[l];
            state.speed = fmax(state.speed, vec_norm(below->v) + fabs(below->omega) * arm);
        }
    }
    length += reach;
    state.slack = 1e-12 * size;
    state.rounding = 16 * DBL_EPSILON * length;
    state.near = 1e-9 * length;
    /* Where all of it stands still there is the rounding of what it is joined to, by whatever way, and the
     * speed of what has fallen as far as it reaches. */
    double fast =
        fmax(sqrt(vec_norm(model->scene->gravity) * length), fastest(model->tree, at->tree, length));
    double slow = 64 * DBL_EPSILON * fast;
    state.touches = fabs(state.excess) <= state.near && fabs(state.rate) <= 1e-10 * state.speed + slow;
    state.parts = state.rate < -1e-6 * state.speed - slow;
    state.meets = state.rate > 1e-6 * state.speed + slow;
    return state;
}
