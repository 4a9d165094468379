/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ropes: their path over points and round discs, their winding, and their variable length.
 */
#include "dynamics/constraint_view.h"
#include "dynamics/friction.h"
#include "dynamics/state.h"
#include "numeric/tolerances.h"

/* ---- ropes: a straight piece from a circle (or point) to the next, see the derivation
 *
 * A piece of direction u that leaves a circle of radius R, round which it runs with side s, starts at C - s R
 * k x u. With d = C_2 - C_1 and rho = s_2 R_2 - s_1 R_1 this gives d = t u + rho k x u, so that its length is
 * t = sqrt(d^2 - rho^2), and u is d turned by -atan(rho / t). */

struct piece {
    struct jet t;
    struct jet_vec u, Q1, Q2;
    bool shrunk; /* of zero length */
};

/* Both ends of a piece are at one point. |d| has a kink there; the derivatives are those after the instant:
 * with d = v s + a s^2 / 2 it is |v| s + (v . a) s^2 / 2 |v|, along u = v / |v|; for v = 0 along a. Ends that
 * stay together have no direction. */
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

/* The rotation of u at that end since the start, including whole turns. */
static struct jet turned_at(const struct coupling_state *state, int end, struct jet_vec u)
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

/* The angle of the point of tangency on the disc at that end, relative to the disc. */
static struct jet laid(const struct view *view, const struct coupling *coupling,
                       const struct coupling_state *state, int end, struct jet_vec u)
{
    const struct coupling_end *disc = &coupling->end[end == 0 ? 0 : coupling->end_count - 1];
    return jet_sub(turned_at(state, end, u), angle_of(view, disc->link));
}

/* Side times radius of the disc at the start (end 0) or end (1) of piece k of a rope; 0 for a point. */
static double rim(const struct coupling *coupling, const struct coupling_state *state, int k, int end)
{
    bool outer = end == 0 ? k == 0 : k + 2 == coupling->end_count;
    return outer ? state->side[end] * coupling->end[k + end].radius : 0;
}

static struct piece piece_of(const struct view *view, const struct coupling *coupling,
                             const struct coupling_state *state, int k)
{
    return piece_between(point_of(view, &coupling->end[k]), rim(coupling, state, k, 0),
                         point_of(view, &coupling->end[k + 1]), rim(coupling, state, k, 1));
}

/* The first or the last piece. */
static struct piece piece_at(const struct view *view, const struct coupling *coupling,
                             const struct coupling_state *state, int end)
{
    return piece_of(view, coupling, state, end == 0 ? 0 : coupling->end_count - 2);
}

/* The change of the length of a rope since t = 0. */
static struct jet reeled(const struct view *view, const struct coupling *coupling)
{
    const struct instant *at = view->at;
    double rate, same, second;
    double length = expr_eval_second(coupling->reel.expr, at->t, at->y, 0, 0,
                                     formula_branches(&coupling->reel, at), &rate, &same, &second);
    double dt = view->along ? view->along->dt : 0;
    double jerk = dt != 0 ? formula_third(&coupling->reel, at) : 0;
    return (struct jet){length - coupling->length, rate, second, rate * dt, second * dt, jerk * dt};
}

/* Is a rope slack by more than rounding? */
static bool is_loose(double over, const struct coupling_state *state)
{
    const double taut = undecided_part; /* of its length */
    return over < -taut * state->zero;
}

/* A taut rope with a piece of zero length without direction has no definite force. */
static void refuse_direction(struct row *row)
{
    for (int i = 0; i < row->port_count; i++) row->ports[i].force = (struct vec){NAN, NAN};
}

void rope_row(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
              struct row *row)
{
    int last = coupling->end_count - 1;
    bool shrunk = false;
    struct jet length = jet_constant(-state->zero);
    start_row(row, length);
    for (int k = 0; k < last; k++) {
        double sR1 = rim(coupling, state, k, 0), sR2 = rim(coupling, state, k, 1);
        struct piece piece = piece_of(view, coupling, state, k);
        length = jet_add(length, piece.t);
        shrunk |= piece.shrunk;
        if (sR1 != 0) length = jet_add(length, jet_scale(sR1, laid(view, coupling, state, 0, piece.u)));
        if (sR2 != 0) length = jet_add(length, jet_scale(-sR2, laid(view, coupling, state, 1, piece.u)));
        add_port(view, row, coupling, k, piece.Q1, negative(piece.u));
        add_port(view, row, coupling, k + 1, piece.Q2, piece.u);
    }
    row->g = coupling->reels ? jet_sub(length, reeled(view, coupling)) : length;
    if (shrunk && !is_loose(length.x, state)) refuse_direction(row);
}

int rope_blocked_at(const struct fbd_model *model, const struct tree_work *work, int index)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct coupling_state *state = &work->couplings[index];
    struct view view = view_of(model, work);
    int last = coupling->end_count - 1;
    bool rubs = coupling->kind == constraint_capstan;
    for (int k = 0; k < last; k++) {
        double sR1 = rubs ? k * coupling->end[1].radius : rim(coupling, state, k, 0);
        double sR2 = rubs ? (1 - k) * coupling->end[1].radius : rim(coupling, state, k, 1);
        struct vec from = jet_value(point_of(&view, &coupling->end[k]));
        struct vec to = jet_value(point_of(&view, &coupling->end[k + 1]));
        bool rims = sR1 != 0 || sR2 != 0;
        if (rims && !(vec_norm(vec_sub(to, from)) > fabs(sR2 - sR1))) return k;
    }
    return -1;
}

int rope_shrunk_at(const struct fbd_model *model, const struct tree_work *work, int index, struct vec *where)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct coupling_state *state = &work->couplings[index];
    const struct view view = view_of(model, work);
    if (coupling->kind != constraint_rope || is_loose(work->rows[coupling->first_row].g.x, state)) return -1;
    for (int k = 0; k + 1 < coupling->end_count; k++) {
        const struct piece piece = piece_of(&view, coupling, state, k);
        if (!piece.shrunk) continue;
        *where = jet_value(piece.Q1);
        return k;
    }
    return -1;
}

bool rope_goes_on(const struct tree *tree, int index)
{
    const struct coupling *coupling = &tree->couplings[index];
    if (coupling->kind != constraint_rope || index + 1 >= tree->coupling_count) return false;
    return coupling->end[coupling->end_count - 1].radius > 0 &&
           coupling[1].constraint == coupling->constraint;
}

static double turned_now(const struct view *view, const struct coupling *coupling,
                         const struct coupling_state *state, int end)
{
    return turned_at(state, end, constraint_forms[coupling->kind].piece(view, coupling, state, end)).x;
}

struct jet_vec rope_end_piece(const struct view *view, const struct coupling *coupling,
                              const struct coupling_state *state, int end)
{
    return piece_at(view, coupling, state, end).u;
}

/* The directions of its first and last piece. */
static void directions_start(const struct view *view, const struct coupling *coupling,
                             struct coupling_state *state)
{
    for (int end = 0; end < 2; end++) {
        struct jet_vec u = constraint_forms[coupling->kind].piece(view, coupling, state, end);
        state->psi[end] = atan2(u.y.x, u.x.x);
    }
}

double rope_wrap(const struct fbd_model *model, const struct tree_work *work, int index)
{
    struct view view = view_of(model, work);
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct coupling_state *before = &work->couplings[index], *after = before + 1;
    double in = before->psi[1] + turned_now(&view, coupling, before, 1);
    double out = after->psi[0] + turned_now(&view, coupling + 1, after, 0);
    return before->side[1] * (out - in);
}

void way_follow(const struct view *view, const struct coupling *coupling, struct coupling_state *state)
{
    for (int end = 0; end < 2; end++)
        if (state->side[end] != 0) state->turned[end] = turned_now(view, coupling, state, end);
}

/* ---- belts
 *
 * Strand 0 leaves disc 0 on its right, round which the belt runs counter-clockwise; strand 1 returns. */

static struct piece strand_of(const struct view *view, const struct coupling *coupling, int strand)
{
    double sR[2] = {coupling->end[0].radius, (coupling->source->crossed ? -1 : 1) * coupling->end[1].radius};
    int from = strand, to = 1 - strand;
    return piece_between(point_of(view, &coupling->end[from]), sR[from], point_of(view, &coupling->end[to]),
                         sR[to]);
}

/* The length of belt in a strand, relative to the discs' surfaces. */
static struct jet strand_way(const struct view *view, const struct coupling *coupling,
                             const struct coupling_state *state, int strand, const struct piece *piece)
{
    double sR[2] = {coupling->end[0].radius, (coupling->source->crossed ? -1 : 1) * coupling->end[1].radius};
    int from = strand, to = 1 - strand;
    struct jet turned = turned_at(state, strand, piece->u);
    struct jet leaves = jet_sub(turned, angle_of(view, coupling->end[from].link));
    struct jet comes = jet_sub(angle_of(view, coupling->end[to].link), turned);
    return jet_add(piece->t, jet_add(jet_scale(sR[from], leaves), jet_scale(sR[to], comes)));
}

void belt_rows(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
               struct row *rows)
{
    struct piece piece[2] = {strand_of(view, coupling, 0), strand_of(view, coupling, 1)};
    struct jet way[2];
    for (int k = 0; k < 2; k++) way[k] = strand_way(view, coupling, state, k, &piece[k]);
    for (int j = 0; j < coupling->row_count; j++) {
        double share[2] = {j == 0 ? 0.5 : 1, j == 0 ? -0.5 : 1};
        start_row(&rows[j], jet_add(jet_scale(share[0], way[0]), jet_scale(share[1], way[1])));
        rows[j].g.x -= state->laid[j];
        for (int k = 0; k < 2; k++) {
            struct jet_vec along = jet_vec_times(jet_constant(share[k]), piece[k].u);
            add_port(view, &rows[j], coupling, k, piece[k].Q1, negative(along));
            add_port(view, &rows[j], coupling, 1 - k, piece[k].Q2, along);
        }
    }
}

struct jet_vec belt_piece(const struct view *view, const struct coupling *coupling,
                          const struct coupling_state *state, int strand)
{
    (void)state;
    return strand_of(view, coupling, strand).u;
}

void belt_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                struct row *rows)
{
    state->side[1] = coupling->source->crossed ? -1 : 1;
    directions_start(view, coupling, state);
    belt_rows(view, coupling, state, rows);
    for (int k = 0; k < coupling->row_count; k++) state->laid[k] = rows[k].g.x;
}

void belt_tensions(const struct fbd_model *model, const struct tree_work *work, int index, double tension[2])
{
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct row *rows = &work->rows[coupling->first_row];
    double both = coupling->source->tension - (coupling->row_count > 1 ? rows[1].lambda : 0);
    tension[0] = both - rows[0].lambda / 2;
    tension[1] = both + rows[0].lambda / 2;
}

/* ---- capstans: ropes with friction on a drum */

static int side_at(const struct view *view, const struct coupling *coupling, int k);

static struct piece reach_of(const struct view *view, const struct coupling *coupling,
                             const struct coupling_state *state, int strand)
{
    double sR[3] = {0, state->side[0] * coupling->end[1].radius, 0};
    return piece_between(point_of(view, &coupling->end[strand]), sR[strand],
                         point_of(view, &coupling->end[strand + 1]), sR[strand + 1]);
}

void capstan_rows(const struct view *view, const struct coupling *coupling,
                  const struct coupling_state *state, struct row *rows)
{
    double sR = state->side[0] * coupling->end[1].radius;
    struct piece piece[2];
    struct jet way[2];
    for (int k = 0; k < 2; k++) {
        piece[k] = reach_of(view, coupling, state, k);
        struct jet round = jet_sub(turned_at(state, k, piece[k].u), angle_of(view, coupling->end[1].link));
        way[k] = jet_add(piece[k].t, jet_scale(k == 0 ? -sR : sR, round));
    }
    for (int j = 0; j < 2; j++) {
        double share[2] = {j == 0 ? -0.5 : 0.5, -0.5};
        start_row(&rows[j], jet_add(jet_scale(share[0], way[0]), jet_scale(share[1], way[1])));
        rows[j].g.x -= j == 0 ? state->laid[0] : state->zero;
        for (int k = 0; k < 2; k++) {
            struct jet_vec along = jet_vec_times(jet_constant(share[k]), piece[k].u);
            add_port(view, &rows[j], coupling, k, piece[k].Q1, negative(along));
            add_port(view, &rows[j], coupling, k + 1, piece[k].Q2, along);
        }
    }
}

struct jet_vec capstan_piece(const struct view *view, const struct coupling *coupling,
                             const struct coupling_state *state, int strand)
{
    return reach_of(view, coupling, state, strand).u;
}

void capstan_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                   struct row *rows)
{
    const double turn = 6.283185307179586;
    state->side[0] = state->side[1] = side_at(view, coupling, 1);
    directions_start(view, coupling, state);
    double wrap = state->side[0] * (state->psi[1] - state->psi[0]);
    state->psi[1] -= state->side[0] * turn * floor(wrap / turn + 0.25);
    capstan_rows(view, coupling, state, rows);
    double round = state->side[0] * (state->psi[0] - state->psi[1]);
    state->laid[0] =
        coupling->length_given ? -(coupling->length + coupling->end[1].radius * round) / 2 : rows[0].g.x;
    state->zero = rows[1].g.x;
}

double capstan_wrap(const struct fbd_model *model, const struct instant *at, int index, bool varied,
                    double *variation)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct coupling_state *state = &at->tree->couplings[index];
    struct view view = {model, model->tree, at->tree, varied, at, NULL};
    struct jet in = turned_at(state, 0, reach_of(&view, coupling, state, 0).u);
    struct jet out = turned_at(state, 1, reach_of(&view, coupling, state, 1).u);
    const double turn = 6.283185307179586;
    if (variation) *variation = state->side[0] * (out.d - in.d);
    return turn * coupling->source->turns + state->side[0] * (state->psi[1] + out.x - state->psi[0] - in.x);
}

void capstan_tensions(const struct fbd_model *model, const struct tree_work *work, int index,
                      double tension[2])
{
    const struct row *rows = &work->rows[model->tree->couplings[index].first_row];
    tension[0] = (rows[0].lambda - rows[1].lambda) / 2;
    tension[1] = (rows[0].lambda + rows[1].lambda) / 2;
}

/* ---- length wound on a disc */

struct room rope_room(const struct view *view, const struct coupling *coupling,
                      const struct coupling_state *state, int end)
{
    double spare = coupling->wound[end] != 0 ? coupling->spare[end] : HUGE_VAL;
    if (!isfinite(spare)) return (struct room){HUGE_VAL, 0, HUGE_VAL};
    double share = state->side[end] * coupling->end[end == 0 ? 0 : coupling->end_count - 1].radius;
    struct jet angle = laid(view, coupling, state, end, piece_at(view, coupling, state, end).u);
    struct jet way = jet_scale(end == 0 ? share : -share, angle);
    return (struct room){spare + way.x - state->laid[end], way.x1, spare};
}

struct room rope_piece(const struct fbd_model *model, const struct tree_work *work, int index, int k)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct coupling_state *state = &work->couplings[index];
    struct view view = view_of(model, work);
    bool rubs = coupling->kind == constraint_capstan;
    double R = rubs ? coupling->end[1].radius
                    : fmax(fabs(rim(coupling, state, k, 0)), fabs(rim(coupling, state, k, 1)));
    struct jet t = (rubs ? reach_of(&view, coupling, state, k) : piece_of(&view, coupling, state, k)).t;
    return (struct room){t.x, t.x1, R > 0 ? R : coupling->length};
}

double rope_reel_rate(const struct fbd_state *state, int index)
{
    const struct instant at = state_instant(state);
    struct view view = {state->model, state->model->tree, state->tree, false, &at, NULL};
    return reeled(&view, &state->model->tree->couplings[index]).x1;
}

/* ---- the start */

/* Of the two senses round a disc the one whose point of tangency is farther to the given side; 0 if both are
 * the same. */
static int side_of_wound(const struct view *view, const struct coupling *coupling, int end)
{
    int k = end == 0 ? 0 : coupling->end_count - 1, other = end == 0 ? 1 : k - 1;
    double R = coupling->end[k].radius;
    struct jet_vec C = point_of(view, &coupling->end[k]), P = point_of(view, &coupling->end[other]);
    double along[2];
    for (int i = 0; i < 2; i++) {
        struct vec at = jet_value(piece_between(C, i == 0 ? R : -R, P, 0).Q1), c = jet_value(C);
        bool upright = coupling->wound[end] == wound_top || coupling->wound[end] == wound_bottom;
        bool low = coupling->wound[end] == wound_left || coupling->wound[end] == wound_bottom;
        along[i] = (upright ? at.y - c.y : at.x - c.x) * (low ? -1 : 1);
    }
    if (!(fabs(along[0] - along[1]) > undecided_part * R)) return 0;
    /* As seen from the disc; a rope that ends there has the opposite sense. */
    int side = along[0] > along[1] ? 1 : -1;
    return end == 0 ? side : -side;
}

/* The sense of a rope round the pulley at place k of its path: that of its change of direction. */
static int side_at(const struct view *view, const struct coupling *coupling, int k)
{
    struct vec place[3];
    for (int i = 0; i < 3; i++) {
        struct coupling_end end = coupling_end_of(view->model, coupling->constraint, k - 1 + i);
        place[i] = jet_value(point_of(view, &end));
    }
    if (coupling->source->radius[k] == 0) return 0;
    return vec_cross(vec_sub(place[1], place[0]), vec_sub(place[2], place[1])) > 0 ? 1 : -1;
}

void rope_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                struct row *row)
{
    for (int end = 0; end < 2; end++) {
        int k = end == 0 ? 0 : coupling->end_count - 1;
        bool pulley = coupling->end[k].radius > 0;
        state->side[end] = coupling->wound[end] != 0 ? side_of_wound(view, coupling, end)
                           : pulley                  ? side_at(view, coupling, coupling->place + k)
                                                     : 0;
    }
    directions_start(view, coupling, state);
    for (int end = 0; end < 2; end++) {
        if (coupling->wound[end] == 0) continue;
        double share = state->side[end] * coupling->end[end == 0 ? 0 : coupling->end_count - 1].radius;
        struct jet_vec u = rope_end_piece(view, coupling, state, end);
        state->laid[end] = (end == 0 ? share : -share) * laid(view, coupling, state, end, u).x;
    }
    zero_start(view, coupling, state, row);
}

/* At the start a rope is wrapped round its pulley by three quarters of a turn at most, and may be off it by
 * less than a quarter: this range determines the angle between the directions before and behind. */
void rope_start_wrap(const struct tree *tree, struct tree_work *work, int index)
{
    const double turn = 6.283185307179586;
    if (!rope_goes_on(tree, index)) return;
    struct coupling_state *before = &work->couplings[index], *after = before + 1;
    double wrap = before->side[1] * (after->psi[0] - before->psi[1]);
    after->psi[0] -= before->side[1] * turn * floor(wrap / turn + 0.25);
}
