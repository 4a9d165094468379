/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Actuators by the time stepping of moreau.h. Slots are bodies, then the time (whose rate is 1), then states: their rates
 * are forces on a unit mass, and their values its velocity.
 */
#include "actuators.h"

#include <stdio.h>

/* ---- tables */

static double between(const struct act_table *table, double x)
{
    const double *X = table->x, *y = table->y, *bend = table->bend;
    int k = 0;
    while (k + 2 < act_points && x >= X[k + 1]) k++;
    double h = X[k + 1] - X[k], u = (x - X[k]) / h, l = 1 - u;
    if (table->interpolation == act_step) return x >= X[act_points - 1] ? y[act_points - 1] : y[k];
    double straight = l * y[k] + u * y[k + 1];
    if (table->interpolation == act_linear) return straight;
    return straight + h * h / 6 * ((l * l * l - l) * bend[k] + (u * u * u - u) * bend[k + 1]);
}

static double table_at(const struct act_table *table, double x)
{
    double first = table->x[0], last = table->x[act_points - 1];
    if (table->beyond == act_repeat) x -= floor((x - first) / (last - first)) * (last - first);
    if (x >= first && x <= last) return between(table, x);
    return table->beyond == act_zero ? 0 : table->y[x < first ? 0 : act_points - 1];
}

/* ---- forces */

struct time_dd { /* what forces depend on */
    double t, x, v, other_x, other_v;
    const double *z; /* states */
};

static double sign(double u)
{
    return (u > 0) - (u < 0);
}

static double control(const struct act *act, const struct time_dd *at)
{
    const double *p = act->p;
    double e = p[0] * sin(p[1] * at->t) - at->x, u = p[2] * e + p[3] * at->z[act->state] - p[4] * at->v;
    return fmax(-p[5], fmin(p[5], u));
}

static double state_rate(const struct act *act, const struct time_dd *at)
{
    const double *p = act->p, z = at->z[act->state];
    if (act->kind == act_motor) {
        double u = at->t / p[0], U = u - floor(u) < 0.5 ? p[1] : -p[1];
        return (U - p[2] * z - p[3] * at->v) / p[4];
    }
    double e = p[0] * sin(p[1] * at->t) - at->x;
    return z >= p[6] ? fmin(e, 0) : z <= -p[6] ? fmax(e, 0) : e;
}

static void relay(struct act *act, double x)
{
    if (x >= act->p[2]) act->side = 1;
    if (x <= act->p[1]) act->side = -1;
}

/* Along the line of the slide and across it. */
static void add_force(struct act *act, const struct act_body *body, const struct time_dd *at, double *f)
{
    const double *p = act->p, c = cos(body->along), s = sin(body->along);
    double dx, dy, size;
    switch (act->kind) {
    case act_wave: f[0] += p[0] * sin(p[1] * at->t + p[2]); break;
    case act_motor: f[0] += p[3] * at->z[act->state]; break;
    case act_control: f[0] += control(act, at); break;
    case act_timed: f[0] += table_at(&act->table, at->t); break;
    case act_placed: f[0] += table_at(&act->table, at->x); break;
    case act_relay:
        relay(act, at->x);
        f[0] += p[0] * act->side;
        break;
    case act_bumper: f[0] += at->x > p[0] ? -p[1] * (at->x - p[0]) - p[2] * at->v : 0; break;
    case act_drag:
        dx = at->v * c - p[0] * sin(p[1] * at->t), dy = at->v * s - p[2];
        size = -(p[3] + p[4] * hypot(dx, dy));
        f[0] += size * (dx * c + dy * s), f[1] += size * (dy * c - dx * s);
        break;
    case act_load:
        size = (p[0] + p[1]) / 2 * p[2] * (1 + p[4] * sin(p[5] * at->t));
        f[0] += size * cos(p[3] - body->along), f[1] += size * sin(p[3] - body->along);
        break;
    case act_sliding: f[0] -= p[0] * sign(at->x - p[1] + p[2] * at->v); break;
    case act_joined: f[0] += p[0] * (at->other_x - at->x) + p[1] * (at->other_v - at->v); break;
    default: break;
    }
}

static double mass_at(const struct act_body *body, double t)
{
    return body->m + body->flow * t;
}

static void forces(const void *context, double t, const double *q, const double *v, double *f)
{
    const struct act_scene *scene = context;
    const int n = scene->count;
    f[n] = 0;
    for (int i = 0; i < n; i++) {
        struct act_body *body = &scene->live[i];
        double m = mass_at(body, t), c = cos(body->along), s = sin(body->along);
        double sum[2] = {-m * act_g * s, -m * act_g * c};
        int other = (i + 1) % n;
        const struct time_dd at = {t, q[i], v[i], q[other], v[other], v + n + 1};
        sum[0] += body->flow * (body->comes ? body->jet - v[i] : -body->jet);
        for (int k = 0; k < body->acts; k++) {
            add_force(&body->act[k], body, &at, sum);
            if (body->act[k].state >= 0) f[n + 1 + body->act[k].state] = state_rate(&body->act[k], &at);
        }
        double slip = fabs(v[i] - body->belt - body->belt_shaken * sin(body->belt_w * t));
        body->press = fabs(sum[1]);
        body->slip_mu = (body->mu + body->stribeck * exp(-slip / body->scale)) *
                        (1 + body->pulse * sin(body->pulse_w * t));
        f[i] = sum[0];
    }
}

static void solve(const void *context, const double *q, double *b)
{
    const struct act_scene *scene = context;
    for (int i = 0; i < scene->count; i++) b[i] /= mass_at(&scene->body[i], q[scene->count]);
}

static struct moreau_row *row_of(struct moreau_rows *rows, enum moreau_kind kind, int i, double w)
{
    struct moreau_row *row = &rows->row[rows->count++];
    *row = (struct moreau_row){.kind = kind, .normal = -1};
    row->w[i] = w;
    return row;
}

static void rows(const void *context, double t, const double *q, struct moreau_rows *rows)
{
    const struct act_scene *scene = context;
    for (int i = 0; i < scene->count; i++) {
        const struct act_body *body = &scene->body[i];
        struct moreau_row *rub = row_of(rows, moreau_rub, i, 1);
        rub->aim = body->belt + body->belt_shaken * sin(body->belt_w * t);
        rub->most = body->slip_mu * body->press;
        for (int side = 0; side < 2; side++) {
            double way = side ? -1 : 1;
            if (body->has_stop[side] && way * (q[i] - body->stop[side]) <= 0)
                row_of(rows, moreau_gap, i, way)->e = body->e;
        }
        double length = body->length + body->haul * sin(body->haul_w * t);
        if (body->has_rope && fabs(body->anchor - q[i]) >= length)
            row_of(rows, moreau_gap, i, q[i] < body->anchor ? 1 : -1)->aim =
                -body->haul * body->haul_w * cos(body->haul_w * t);
    }
}

struct stepped_values act_step_to(void *drawn, int steps)
{
    struct act_scene *scene = drawn;
    const int n = scene->count;
    const struct moreau_system system = {n + 1 + scene->states, scene, forces, solve, rows, NULL};
    double q[moreau_most] = {0}, v[moreau_most] = {0};
    struct stepped_values values = {0};
    for (int i = 0; i < n; i++) {
        q[i] = scene->body[i].x, v[i] = scene->body[i].v;
        for (int k = 0; k < scene->body[i].acts; k++) scene->body[i].act[k].side = -1;
    }
    v[n] = 1;
    scene->live = scene->body;
    moreau_run(&system, scene->until, steps, q, v);
    for (int i = 0; i < n; i++) {
        stepped_name(&values, "b", i, "x", q[i], 1);
        stepped_name(&values, "b", i, "v", v[i], 0.1);
    }
    for (int k = 0; k < scene->states; k++) stepped_name(&values, "states.z", k, "", v[n + 1 + k], 0.1);
    return values;
}
