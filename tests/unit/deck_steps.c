/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Decks by the time stepping of moreau.h. A body has three coordinates: the place of its centre of mass and its angle,
 * where it is planar or moves on another body (then its joint is two rows); on a slide or pivot of the ground its
 * coordinate, with two that nothing moves.
 */
#include "decks.h"

#include <stdio.h>

static const double heavy = 1e15;

/* The coordinates of body i. */
static ptrdiff_t first_of(int i)
{
    return (ptrdiff_t)3 * i;
}

static void turn(double angle, const double *p, double *to)
{
    double c = cos(angle), s = sin(angle), x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
    to[0] = x, to[1] = y;
}

static bool is_reduced(const struct deck_body *body)
{
    return body->motion != deck_planar && body->on < 0 && !(body->motion == deck_slide && body->rub > 0);
}

/* Of the frame: place of its origin, and its angle. */
static void frame_at(const struct deck_scene *scene, int i, const double *q, double *frame)
{
    const struct deck_body *body = &scene->body[i];
    double arm[2];
    q += first_of(i);
    if (!is_reduced(body)) {
        turn(q[2], body->G, arm);
        frame[0] = q[0] - arm[0], frame[1] = q[1] - arm[1], frame[2] = q[2];
    } else if (body->motion == deck_slide) {
        frame[0] = body->start[0] + (q[0] - body->x0) * cos(body->along);
        frame[1] = body->start[1] + (q[0] - body->x0) * sin(body->along);
        frame[2] = body->start[2];
    } else {
        frame[2] = body->start[2] + q[0] - body->x0;
        turn(frame[2], body->point, arm);
        frame[0] = body->axis[0] - arm[0], frame[1] = body->axis[1] - arm[1];
    }
}

static void point_at(const double *frame, const double *point, double *p)
{
    turn(frame[2], point, p);
    p[0] += frame[0], p[1] += frame[1];
}

/* w of a velocity along n at the place p of a body, times `sign`. */
static void add_along(const struct deck_scene *scene, int i, const double *q, const double *p,
                      const double *n, double sign, double *w)
{
    if (i < 0) return;
    const struct deck_body *body = &scene->body[i];
    w += first_of(i);
    if (!is_reduced(body)) {
        const double *G = q + first_of(i);
        w[0] += sign * n[0], w[1] += sign * n[1];
        w[2] += sign * ((p[0] - G[0]) * n[1] - (p[1] - G[1]) * n[0]);
    } else if (body->motion == deck_slide) {
        w[0] += sign * (n[0] * cos(body->along) + n[1] * sin(body->along));
    } else {
        w[0] += sign * ((p[0] - body->axis[0]) * n[1] - (p[1] - body->axis[1]) * n[0]);
    }
}

static void add_turning(const struct deck_scene *scene, int i, double sign, double *w)
{
    if (i < 0 || (is_reduced(&scene->body[i]) && scene->body[i].motion == deck_slide)) return;
    w[first_of(i) + (is_reduced(&scene->body[i]) ? 0 : 2)] += sign;
}

static double joint_angle(const struct deck_scene *scene, const struct deck_body *body, const double *q)
{
    double frame[3];
    if (body->on < 0) return body->along;
    frame_at(scene, body->on, q, frame);
    return body->along + frame[2] - scene->body[body->on].start[2];
}

/* The coordinate of a slide or pivot, and its w. */
static double coordinate_of(const struct deck_scene *scene, int i, const double *q, double *w)
{
    const struct deck_body *body = &scene->body[i];
    double frame[3], base[3] = {0}, origin[2] = {body->start[0], body->start[1]};
    if (is_reduced(body)) {
        w[first_of(i)] = 1;
        return q[first_of(i)];
    }
    frame_at(scene, i, q, frame);
    if (body->on >= 0) frame_at(scene, body->on, q, base);
    if (body->motion == deck_pivot) {
        double from = body->on < 0 ? 0 : scene->body[body->on].start[2];
        add_turning(scene, i, 1, w);
        add_turning(scene, body->on, -1, w);
        return body->x0 + frame[2] - base[2] - (body->start[2] - from);
    }
    double angle = joint_angle(scene, body, q), n[2] = {cos(angle), sin(angle)};
    if (body->on >= 0) {
        const double *start = scene->body[body->on].start;
        double arm[2] = {body->start[0] - start[0], body->start[1] - start[1]};
        turn(-start[2], arm, arm);
        point_at(base, arm, origin);
    }
    add_along(scene, i, q, frame, n, 1, w);
    add_along(scene, body->on, q, frame, n, -1, w);
    return body->x0 + n[0] * (frame[0] - origin[0]) + n[1] * (frame[1] - origin[1]);
}

static double dot(const double *a, const double *b)
{
    double sum = 0;
    for (int k = 0; k < moreau_most; k++) sum += a[k] * b[k];
    return sum;
}

static void forces(const void *context, double t, const double *q, const double *v, double *f)
{
    const struct deck_scene *scene = context;
    const double x[2] = {1, 0}, y[2] = {0, 1};
    memset(f, 0, moreau_most * sizeof *f);
    for (int i = 0; i < scene->count; i++) {
        const struct deck_body *body = &scene->body[i];
        double w[moreau_most] = {0}, rate[moreau_most] = {0}, frame[3], G[2];
        frame_at(scene, i, q, frame);
        point_at(frame, body->G, G);
        add_along(scene, i, q, G, x, wave_at(&body->push[0], t), f);
        add_along(scene, i, q, G, y, wave_at(&body->push[1], t) - body->m * deck_g, f);
        if (!(body->pieces == 1 && body->piece[0].shape == deck_point))
            add_turning(scene, i, wave_at(&body->push[2], t), f);
        if (body->motion == deck_planar) continue;
        memcpy(rate, v, 3 * (size_t)scene->count * sizeof *v);
        double s = coordinate_of(scene, i, q, w);
        double pull = -body->spring * (s - body->neutral) - body->damper * dot(w, rate);
        for (int k = 0; k < 3 * scene->count; k++) f[k] += pull * w[k];
        if (body->driven && is_reduced(body)) f[first_of(i)] = heavy * wave_bend(&body->drive, t);
    }
}

static void solve(const void *context, const double *q, double *b)
{
    const struct deck_scene *scene = context;
    (void)q;
    for (int i = 0; i < scene->count; i++) {
        const struct deck_body *body = &scene->body[i];
        double arm = hypot(body->G[0] - body->point[0], body->G[1] - body->point[1]);
        double *at = b + first_of(i);
        if (!is_reduced(body)) {
            at[0] /= body->m, at[1] /= body->m;
            at[2] = body->I > 0 ? at[2] / body->I : 0;
            continue;
        }
        at[0] /= body->driven ? heavy : body->motion == deck_slide ? body->m : body->I + body->m * arm * arm;
        at[1] = at[2] = 0;
    }
}

static struct moreau_row *row_of(struct moreau_rows *rows, enum moreau_kind kind)
{
    struct moreau_row *row = &rows->row[rows->count++];
    *row = (struct moreau_row){.kind = kind, .normal = -1};
    return row;
}

/* What one body touches another with: the contact's point, the normal towards `i`, and how far it is. */
struct touch {
    double p[2], n[2], gap;
};

struct placed {
    const struct piece *piece;
    double at[2], angle;
};

static void to_local(const struct placed *box, const double *p, double *local)
{
    double d[2] = {p[0] - box->at[0], p[1] - box->at[1]};
    turn(-box->angle, d, local);
}

/* Outside of a box: where on it is nearest to p, with the normal towards p. Inside: the nearest side. */
static struct touch box_and_point(const struct placed *box, const double *p)
{
    const double *half = box->piece->half;
    double local[2], near[2], n[2];
    struct touch touch;
    to_local(box, p, local);
    for (int k = 0; k < 2; k++) near[k] = fmax(-half[k], fmin(half[k], local[k]));
    double out = hypot(local[0] - near[0], local[1] - near[1]);
    if (out > 0) {
        touch.gap = out;
        n[0] = (local[0] - near[0]) / out, n[1] = (local[1] - near[1]) / out;
    } else {
        int k = half[0] - fabs(local[0]) < half[1] - fabs(local[1]) ? 0 : 1;
        touch.gap = fabs(local[k]) - half[k];
        n[k] = copysign(1, local[k]), n[1 - k] = 0;
        near[k] = copysign(half[k], local[k]);
    }
    turn(box->angle, n, touch.n);
    turn(box->angle, near, touch.p);
    for (int k = 0; k < 2; k++) touch.p[k] += box->at[k];
    return touch;
}

struct pair {
    const struct deck_scene *scene;
    const struct deck_contact *contact;
    const double *q;
    struct moreau_rows *rows;
};

static void close(const struct pair *pair, const struct touch *touch, double sign)
{
    const struct deck_scene *scene = pair->scene;
    const double n[2] = {sign * touch->n[0], sign * touch->n[1]}, across[2] = {-n[1], n[0]};
    struct moreau_row *gap, *rub;
    if (touch->gap > 0) return;
    gap = row_of(pair->rows, moreau_gap);
    gap->e = scene->e;
    add_along(scene, pair->contact->body, pair->q, touch->p, n, 1, gap->w);
    add_along(scene, pair->contact->other, pair->q, touch->p, n, -1, gap->w);
    if (pair->contact->mu == 0) return;
    rub = row_of(pair->rows, moreau_rub);
    rub->mu = pair->contact->mu;
    rub->normal = pair->rows->count - 2;
    add_along(scene, pair->contact->body, pair->q, touch->p, across, 1, rub->w);
    add_along(scene, pair->contact->other, pair->q, touch->p, across, -1, rub->w);
}

static void corner(const struct placed *box, int c, double *p)
{
    const double local[2] = {(c & 1 ? 1 : -1) * box->piece->half[0], (c & 2 ? 1 : -1) * box->piece->half[1]};
    turn(box->angle, local, p);
    p[0] += box->at[0], p[1] += box->at[1];
}

/* Corners of `a` in the box b, with one normal for all that touches: two that cross would be in the way of corners that pass
 * each other. */
static void corners_in_box(const struct pair *pair, const struct placed *a, const struct placed *b,
                           const double *n)
{
    for (int c = 0; c < 4; c++) {
        double local[2];
        struct touch touch = {.n = {n[0], n[1]}, .gap = 0};
        corner(a, c, touch.p);
        to_local(b, touch.p, local);
        if (fabs(local[0]) <= b->piece->half[0] && fabs(local[1]) <= b->piece->half[1])
            close(pair, &touch, 1);
    }
}

/* How far `a` is beyond the side of the box b that it is farthest beyond, with the normal of that side. */
static double beyond(const struct placed *a, const struct placed *b, double *n)
{
    double most = -INFINITY;
    for (int side = 0; side < 4; side++) {
        double normal[2] = {0}, least = INFINITY;
        normal[side / 2] = side % 2 ? -1 : 1;
        for (int c = 0; c < 4; c++) {
            double p[2], local[2];
            corner(a, c, p);
            to_local(b, p, local);
            least = fmin(least, normal[side / 2] * local[side / 2] - b->piece->half[side / 2]);
        }
        if (least <= most) continue;
        most = least;
        turn(b->angle, normal, n);
    }
    return most;
}

static void boxes(const struct pair *pair, const struct placed *a, const struct placed *b)
{
    double n[2], m[2], out = beyond(a, b, n), in = beyond(b, a, m);
    if (out > 0 || in > 0) return;
    if (in > out) n[0] = -m[0], n[1] = -m[1];
    corners_in_box(pair, a, b, n);
    corners_in_box(pair, b, a, n);
}

/* The circle, or the point, in the box b; sign -1: the normal is to be towards b. */
static void in_box(const struct pair *pair, const struct placed *a, const struct placed *b, double sign)
{
    struct touch touch = box_and_point(b, a->at);
    touch.gap -= a->piece->r;
    close(pair, &touch, sign);
}

static void discs(const struct pair *pair, const struct placed *a, const struct placed *b)
{
    double d[2] = {a->at[0] - b->at[0], a->at[1] - b->at[1]}, far = hypot(d[0], d[1]);
    struct touch touch = {.n = {d[0] / far, d[1] / far}, .gap = far - a->piece->r - b->piece->r};
    for (int k = 0; k < 2; k++) touch.p[k] = b->at[k] + b->piece->r * touch.n[k];
    close(pair, &touch, 1);
}

static void on_floor(const struct pair *pair, const struct placed *a)
{
    const double n[2] = {-sin(pair->scene->tilt), cos(pair->scene->tilt)};
    for (int c = 0; c < (a->piece->shape == deck_box ? 4 : 1); c++) {
        struct touch touch = {.p = {a->at[0], a->at[1]}, .n = {n[0], n[1]}};
        if (a->piece->shape == deck_box) corner(a, c, touch.p);
        for (int k = 0; k < 2; k++) touch.p[k] -= a->piece->r * n[k];
        touch.gap = n[0] * touch.p[0] + n[1] * (touch.p[1] - pair->scene->floor);
        close(pair, &touch, 1);
    }
}

static struct placed place(const struct deck_scene *scene, int i, int k, const double *q)
{
    struct placed placed = {.piece = &scene->body[i].piece[k]};
    double frame[3];
    frame_at(scene, i, q, frame);
    point_at(frame, placed.piece->at, placed.at);
    placed.angle = frame[2];
    return placed;
}

static void contact_rows(const struct pair *pair)
{
    const struct deck_scene *scene = pair->scene;
    int i = pair->contact->body, j = pair->contact->other;
    for (int k = 0; k < scene->body[i].pieces; k++) {
        struct placed a = place(scene, i, k, pair->q);
        if (j < 0) on_floor(pair, &a);
        for (int l = 0; j >= 0 && l < scene->body[j].pieces; l++) {
            struct placed b = place(scene, j, l, pair->q);
            bool box = a.piece->shape == deck_box, on_box = b.piece->shape == deck_box;
            if (box && on_box) boxes(pair, &a, &b);
            if (!box && on_box) in_box(pair, &a, &b, 1);
            if (box && !on_box) in_box(pair, &b, &a, -1);
            if (!box && !on_box) discs(pair, &a, &b);
        }
    }
}

static void joint_rows(const struct deck_scene *scene, int i, double t, const double *q,
                       struct moreau_rows *rows)
{
    const struct deck_body *body = &scene->body[i];
    struct moreau_row *row;
    double frame[3], p[2];
    int normal = -1;
    if (body->motion == deck_planar) return;
    frame_at(scene, i, q, frame);
    point_at(frame, body->point, p);
    if (!is_reduced(body)) {
        double angle = body->motion == deck_pivot ? 0 : joint_angle(scene, body, q);
        const double along[2] = {cos(angle), sin(angle)}, across[2] = {-sin(angle), cos(angle)};
        row = row_of(rows, moreau_equal);
        normal = rows->count - 1;
        add_along(scene, i, q, p, across, 1, row->w);
        add_along(scene, body->on, q, p, across, -1, row->w);
        row = row_of(rows, moreau_equal);
        if (body->motion == deck_pivot) {
            add_along(scene, i, q, p, along, 1, row->w);
            add_along(scene, body->on, q, p, along, -1, row->w);
        } else {
            add_turning(scene, i, 1, row->w);
            add_turning(scene, body->on, -1, row->w);
        }
    }
    if (body->rub > 0) {
        row = row_of(rows, moreau_rub);
        coordinate_of(scene, i, q, row->w);
        row->most = row->mu = body->rub;
        row->normal = body->motion == deck_slide ? normal : -1;
    }
    if (body->driven && !is_reduced(body)) {
        row = row_of(rows, moreau_equal);
        coordinate_of(scene, i, q, row->w);
        row->aim = wave_rate(&body->drive, t + scene->h / 2);
    }
    for (int side = 0; side < 2 && body->has_stops; side++) {
        double w[moreau_most] = {0}, sign = side ? -1 : 1, s = coordinate_of(scene, i, q, w);
        if (sign * (s - body->stop[side]) > 0) continue;
        row = row_of(rows, moreau_gap);
        for (int k = 0; k < moreau_most; k++) row->w[k] = sign * w[k];
    }
}

static void rows(const void *context, double t, const double *q, struct moreau_rows *rows)
{
    const struct deck_scene *scene = context;
    for (int i = 0; i < scene->count; i++) joint_rows(scene, i, t, q, rows);
    for (int j = 0; j < scene->rods; j++) {
        const struct deck_rod *rod = &scene->rod[j];
        double frame[3], p[2], n[2];
        frame_at(scene, rod->body, q, frame);
        point_at(frame, rod->point, p);
        for (int k = 0; k < 2; k++) n[k] = (p[k] - rod->end[k]) / rod->length;
        add_along(scene, rod->body, q, p, n, 1, row_of(rows, moreau_equal)->w);
    }
    for (int j = 0; j < scene->contacts; j++)
        contact_rows(&(struct pair){scene, &scene->contact[j], q, rows});
}

static void start(const struct deck_scene *scene, double *q, double *v)
{
    for (int i = 0; i < scene->count; i++) {
        const struct deck_body *body = &scene->body[i];
        double p[2];
        point_at(body->start, body->G, p);
        q[first_of(i)] = is_reduced(body) ? body->x0 : p[0];
        if (is_reduced(body)) {
            v[first_of(i)] = body->driven ? wave_rate(&body->drive, 0) : body->speed[0];
            continue;
        }
        q[first_of(i) + 1] = p[1], q[first_of(i) + 2] = body->start[2];
        deck_twist(scene, i, p, v + first_of(i));
    }
}

struct stepped_values deck_step(void *drawn, int steps)
{
    struct deck_scene *scene = drawn;
    static const char *const names[] = {"x", "y", "theta", "vx", "vy", "omega"};
    const struct moreau_system system = {3 * scene->count, scene, forces, solve, rows, NULL};
    double q[moreau_most] = {0}, v[moreau_most] = {0};
    struct stepped_values named = {0};
    scene->h = scene->until / steps;
    start(scene, q, v);
    moreau_run(&system, scene->until, steps, q, v);
    for (int i = 0; i < scene->count; i++) {
        const struct deck_body *body = &scene->body[i];
        double frame[3], w[moreau_most] = {0};
        frame_at(scene, i, q, frame);
        if (body->motion == deck_planar) {
            double arm[2] = {frame[0] - q[first_of(i)], frame[1] - q[first_of(i) + 1]},
                   omega = v[first_of(i) + 2];
            double rate[3] = {v[first_of(i)] - omega * arm[1], v[first_of(i) + 1] + omega * arm[0], omega};
            for (int k = 0; k < (body->I > 0 ? 3 : 2); k++) {
                stepped_name(&named, "b", i, names[k], frame[k], 1);
                stepped_name(&named, "b", i, names[3 + k], rate[k], 0.1);
            }
        } else {
            bool slides = body->motion == deck_slide;
            double from = slides || body->on < 0 ? 0 : deck_turned(&scene->body[body->on]);
            stepped_name(&named, "b", i, slides ? "x" : "theta", coordinate_of(scene, i, q, w) - from, 1);
            stepped_name(&named, "b", i, slides ? "v" : "omega", dot(w, v), 0.1);
        }
    }
    return named;
}
