/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The linear system: accelerations and multipliers at an instant; and the same system for the nearest state
 * that fits.
 */
#include <string.h>

#include "absolute.h"
#include "dense.h"

/* Coordinates and rows are counted by sizes that make all entries of the order of one: a body's own mass and
 * radius of gyration (a point: a tenth of a length). */
struct scaling {
    double coordinate[3 * most_bodies], row[most_rows];
    int unknown[most_rows], row_of[most_rows], count; /* active rows among the unknowns */
};

static void set_scaling(const struct absolute *absolute, bool spare, struct scaling *scaling)
{
    scaling->count = 0;
    for (int b = 0; b < absolute->scene->body_count; b++) {
        double m = absolute->mass[b].m, I = fmax(absolute->mass[b].I_G, 0.01 * m);
        scaling->coordinate[3 * b] = scaling->coordinate[3 * b + 1] = 1 / sqrt(m);
        scaling->coordinate[3 * b + 2] = 1 / sqrt(I);
    }
    for (int j = 0; j < absolute->row_count; j++) {
        double sum = 0;
        for (int i = 0; i < absolute->n; i++)
            sum += absolute->J[j][i] * absolute->J[j][i] * scaling->coordinate[i] * scaling->coordinate[i];
        scaling->row[j] = 1 / sqrt(sum);
        scaling->unknown[j] = -1;
        if (!absolute->active[j] || (absolute->spare[j] && !spare)) continue;
        scaling->row_of[scaling->count] = j;
        scaling->unknown[j] = absolute->n + scaling->count++;
    }
}

/* K = [M -D; J 0], columns and rows scaled alike. */
static void fill(const struct absolute *absolute, const struct scaling *scaling, bool symmetric,
                 struct dense *dense)
{
    int n = absolute->n;
    dense->n = n + scaling->count;
    for (int j = 0; j < dense->n; j++) memset(dense->a[j], 0, (size_t)dense->n * sizeof(double));
    for (int i = 0; i < n; i++) {
        const struct mass *mass = &absolute->mass[i / 3];
        dense->a[i][i] = (i % 3 == 2 ? mass->I_G : mass->m) * scaling->coordinate[i] * scaling->coordinate[i];
    }
    for (int k = 0; k < scaling->count; k++) {
        int j = scaling->row_of[k];
        for (int i = 0; i < n; i++) {
            double s = scaling->row[j] * scaling->coordinate[i];
            dense->a[n + k][i] = -s * (symmetric ? absolute->J : absolute->D)[j][i];
            dense->a[i][n + k] = s * absolute->J[j][i];
        }
    }
}

double grip_coefficient(const struct absolute *absolute, const struct grip *grip, bool kinetic)
{
    const struct scene *scene = absolute->scene;
    if (grip->kind == grip_tread || grip->kind == grip_capstan) {
        const struct coupling *coupling = &scene->coupling[grip->owner];
        double mu = formula_value(absolute, kinetic ? &coupling->mu_k : &coupling->mu_s);
        return grip->kind == grip_tread ? mu : tanh(mu * wrap_of(absolute, &absolute->row[grip->row]) / 2);
    }
    const struct load *load = &scene->body[grip->owner].load[grip->load];
    return formula_value(absolute, kinetic ? &load->second : &load->value);
}

/* Friction that slips is -mode mu_k N along its row: it goes with N. */
static void add_slips(const struct absolute *absolute, const struct scaling *scaling, struct dense *dense)
{
    for (int i = 0; i < absolute->grip_count; i++) {
        const struct grip *grip = &absolute->grip[i];
        if (grip->mode != slips_plus && grip->mode != slips_minus) continue;
        double force = -grip->mode * grip_coefficient(absolute, grip, true);
        const double *D = absolute->D[grip->row];
        for (int k = 0; k < absolute->n; k++)
            if (grip->normal < 0)
                dense->b[k] += force * D[k] * scaling->coordinate[k];
            else
                dense->a[scaling->unknown[grip->normal]][k] -=
                    force * grip->press * D[k] * scaling->coordinate[k] * scaling->row[grip->normal];
    }
}

/* D = J^T; but the drive and the friction of a slide act at G, along the line. */
static void set_directions(struct absolute *absolute)
{
    memcpy(absolute->D, absolute->J, sizeof absolute->D);
    for (int j = 0; j < absolute->row_count; j++) {
        const struct row *row = &absolute->row[j];
        if (row->kind != row_along) continue;
        const struct body *body = &absolute->scene->body[row->owner];
        if (body->motion == track) continue; /* at its point, along the curve: as J says */
        struct place e = direction_of(absolute, body->on, body->along);
        double *D = absolute->D[j], *own = &D[3 * row->owner];
        own[2] = 0;
        if (body->on < 0) continue;
        double rx = absolute->x[3 * row->owner] - absolute->x[3 * body->on];
        double ry = absolute->x[3 * row->owner + 1] - absolute->x[3 * body->on + 1];
        D[3 * body->on + 2] = -(rx * e.y.u - ry * e.x.u);
    }
}

static void set_active(struct absolute *absolute)
{
    for (int j = 0; j < absolute->row_count; j++) absolute->active[j] = true;
    for (int i = 0; i < absolute->grip_count; i++)
        absolute->active[absolute->grip[i].row] = absolute->grip[i].mode == holds;
}

/* What the null space of the system leaves open. */
static void doubt(struct absolute *absolute, const struct scaling *scaling, const struct dense *dense)
{
    double x[dense_room], lambda[most_rows];
    absolute->redundant = dense->rank < dense->n;
    absolute->accelerations_unique = true;
    absolute->modes_in_doubt = false;
    for (int k = 0; k < dense->n - dense->rank; k++) {
        memset(lambda, 0, sizeof lambda);
        dense_null(dense, k, x);
        for (int i = 0; i < absolute->n; i++)
            if (fabs(x[i]) > 1e-8) absolute->accelerations_unique = false;
        for (int i = 0; i < scaling->count; i++)
            lambda[scaling->row_of[i]] = x[absolute->n + i] * scaling->row[scaling->row_of[i]];
        int free = dense->order[dense->rank + k];
        if (free >= absolute->n) absolute->spare[scaling->row_of[free - absolute->n]] = true;
        for (int i = 0; i < absolute->grip_count; i++)
            if (fabs(lambda[absolute->grip[i].row]) > 1e-6) absolute->modes_in_doubt = true;
        absolute_list(absolute, lambda, true);
    }
}

static void take(struct absolute *absolute, const struct scaling *scaling, const double *x)
{
    for (int i = 0; i < absolute->n; i++) {
        absolute->a[i] = x[i] * scaling->coordinate[i];
        absolute->acceleration_size = fmax(absolute->acceleration_size, fabs(absolute->a[i]));
    }
    /* A bearing that slips is no unknown and in no list of forces. */
    for (int i = 0; i < absolute->grip_count; i++)
        if (absolute->grip[i].kind == grip_bearing && absolute->grip[i].mode != holds)
            absolute->force_size =
                fmax(absolute->force_size, fabs(grip_coefficient(absolute, &absolute->grip[i], true)));
    memset(absolute->lambda, 0, sizeof absolute->lambda);
    for (int k = 0; k < scaling->count; k++) {
        int j = scaling->row_of[k];
        absolute->lambda[j] = x[absolute->n + k] * scaling->row[j];
        for (int i = 0; i < absolute->n; i++)
            absolute->force_size = fmax(absolute->force_size, fabs(absolute->lambda[j] * absolute->D[j][i]));
    }
}

void absolute_solve(struct absolute *absolute, bool list)
{
    struct dense dense;
    struct scaling scaling;
    double f[3 * most_bodies], x[dense_room];
    set_active(absolute);
    absolute_rows(absolute);
    absolute_masses(absolute);
    set_directions(absolute);
    if (list) {
        absolute->wrench_count = 0;
        memset(absolute->spare, 0, sizeof absolute->spare);
    }
    set_scaling(absolute, list, &scaling);
    absolute_loads(absolute, f, list);
    fill(absolute, &scaling, false, &dense);
    for (int i = 0; i < absolute->n; i++) dense.b[i] = f[i] * scaling.coordinate[i];
    add_slips(absolute, &scaling, &dense);
    absolute->acceleration_size = 0;
    for (int k = 0; k < scaling.count; k++) {
        int j = scaling.row_of[k];
        dense.b[absolute->n + k] = absolute->gamma[j] * scaling.row[j];
        absolute->acceleration_size = fmax(absolute->acceleration_size, fabs(absolute->gamma[j]));
    }
    if (list)
        dense_solve(&dense, x);
    else
        dense_solve_regular(&dense, x);
    take(absolute, &scaling, x);
    if (!list) return;
    absolute->condition = dense.condition;
    absolute->consistent = dense.leftover < 1e-9 && dense.gap < 1e-12;
    absolute_list(absolute, absolute->lambda, false);
    doubt(absolute, &scaling, &dense);
}

/* ---- the nearest state that fits: M dx - J^T mu = 0, J dx = what is missing */

static double row_gap(const struct absolute *absolute, int j, bool position)
{
    const struct row *row = &absolute->row[j];
    struct series g = row_value(absolute, row), f = ser(0);
    if (row->drive) f = formula_series(absolute, row->drive, row->owner, -1);
    return position ? f.u - g.u : f.u1 - g.u1;
}

/* Friction is no condition on positions, and its speed comes by itself; but a rope that is held on its drum stays, and
 * so does a pin in its slot. */
static bool is_condition(const struct absolute *absolute, int j)
{
    int grip = absolute->row[j].grip;
    enum grip_kind kind = grip < 0 ? grip_rope : absolute->grip[grip].kind;
    if (absolute->row[j].kind == row_slot_along) return absolute->active[j];
    return absolute->active[j] && (kind == grip_rope || kind == grip_capstan);
}

double absolute_gap(struct absolute *absolute, bool position)
{
    double most = 0;
    absolute_seed(absolute, seed_motion);
    set_active(absolute);
    for (int j = 0; j < absolute->row_count; j++)
        if (is_condition(absolute, j)) most = fmax(most, fabs(row_gap(absolute, j, position)));
    return most;
}

static double correct(struct absolute *absolute, bool position)
{
    struct dense dense;
    struct scaling scaling;
    double x[dense_room], most = 0;
    absolute_rows(absolute);
    absolute_seed(absolute, seed_motion);
    absolute_masses(absolute);
    set_active(absolute);
    for (int j = 0; j < absolute->row_count; j++) absolute->active[j] = is_condition(absolute, j);
    bool known = absolute->condition > 0; /* which rows are spare */
    set_scaling(absolute, !known, &scaling);
    fill(absolute, &scaling, true, &dense);
    memset(dense.b, 0, sizeof dense.b);
    for (int k = 0; k < scaling.count; k++) {
        int j = scaling.row_of[k];
        double gap = row_gap(absolute, j, position);
        most = fmax(most, fabs(gap));
        dense.b[absolute->n + k] = gap * scaling.row[j];
    }
    if (known)
        dense_solve_regular(&dense, x);
    else
        dense_solve(&dense, x);
    for (int i = 0; i < absolute->n; i++)
        (position ? absolute->x : absolute->v)[i] += x[i] * scaling.coordinate[i];
    return most;
}

bool absolute_project(struct absolute *absolute, bool positions)
{
    double gap = 0;
    for (int round = 0; positions && round < 4; round++) {
        gap = correct(absolute, true);
        if (gap < 1e-13) break;
    }
    correct(absolute, false);
    absolute_seed(absolute, seed_motion);
    return gap < 1e-8;
}
