/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "moreau.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "random_numbers.h"
#include "thorough.h"

enum { most_sweeps = 5000 };
static const double settled = 1e-13; /* change of a velocity in a sweep, in units of the scene */

struct prepared {
    double mw[moreau_most_rows][moreau_most]; /* M^-1 w */
    double d[moreau_most_rows];               /* w . M^-1 w */
    double want[moreau_most_rows];            /* the velocity after, of equal and gap at least */
};

static double dot(int size, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < size; i++) sum += a[i] * b[i];
    return sum;
}

static void prepare(const struct moreau_system *system, const double *q, const double *v,
                    const struct moreau_rows *rows, struct prepared *prepared)
{
    for (int a = 0; a < rows->count; a++) {
        const struct moreau_row *row = &rows->row[a];
        memcpy(prepared->mw[a], row->w, sizeof row->w);
        system->solve(system->scene, q, prepared->mw[a]);
        prepared->d[a] = dot(system->size, row->w, prepared->mw[a]);
        double before = dot(system->size, row->w, v) - row->aim;
        prepared->want[a] = row->aim - (row->kind == moreau_gap ? row->e * fmin(before, 0) : 0);
    }
}

/* The impulse that the law of a row gives, where `free` would bring the velocity that it wants. */
static double allowed(const struct moreau_rows *rows, const struct moreau_row *row, double h, double free)
{
    if (row->kind == moreau_equal) return free;
    if (row->kind == moreau_gap) return fmax(0, free);
    double most = row->normal < 0 ? h * row->most : row->mu * fabs(rows->row[row->normal].p);
    return fmax(-most, fmin(most, free));
}

/* From the impulses of the step before, of as many rows. */
static void begin_from(int size, struct moreau_rows *rows, const struct prepared *prepared, double *u,
                       int before, const double *p)
{
    for (int a = 0; a < rows->count; a++) {
        rows->row[a].p = before == rows->count ? p[a] : 0;
        for (int i = 0; i < size; i++) u[i] += rows->row[a].p * prepared->mw[a][i];
    }
}

static void impulses(int size, double h, struct moreau_rows *rows, const struct prepared *prepared, double *u)
{
    double changed = 1;
    for (int sweep = 0; sweep < most_sweeps && changed > settled; sweep++) {
        changed = 0;
        for (int a = 0; a < rows->count; a++) {
            struct moreau_row *row = &rows->row[a];
            double off = prepared->want[a] - dot(size, row->w, u);
            double p = allowed(rows, row, h, row->p + off / prepared->d[a]), change = p - row->p;
            row->p = p;
            for (int i = 0; i < size; i++) u[i] += change * prepared->mw[a][i];
            changed = fmax(changed, fabs(change) * sqrt(prepared->d[a]));
        }
    }
}

void moreau_run(const struct moreau_system *system, double until, int steps, double *q, double *v)
{
    static struct moreau_rows rows;
    static struct prepared prepared;
    const int size = system->size;
    const double h = until / steps;
    double p[moreau_most_rows];
    int before = -1;
    for (int step = 0; step < steps; step++) {
        double t = (step + 0.5) * h, middle[moreau_most], u[moreau_most];
        for (int i = 0; i < size; i++) middle[i] = q[i] + h / 2 * v[i];
        system->forces(system->scene, t, middle, v, u);
        system->solve(system->scene, middle, u);
        for (int i = 0; i < size; i++) u[i] = v[i] + h * u[i];
        rows.count = 0;
        system->rows(system->scene, t, middle, &rows);
        prepare(system, middle, v, &rows, &prepared);
        begin_from(size, &rows, &prepared, u, before, p);
        impulses(size, h, &rows, &prepared, u);
        before = rows.count;
        for (int a = 0; a < before; a++) p[a] = rows.row[a].p;
        for (int i = 0; i < size; i++) {
            q[i] += h / 2 * (v[i] + u[i]);
            v[i] = u[i];
        }
        if (system->lift) system->lift(system->scene, q);
    }
}

void moreau_compare(const char *name, int usual, int most, bool (*agrees)(uint64_t seed, bool *sensitive))
{
    char seeds[40];
    snprintf(seeds, sizeof seeds, "%s_SEED", name);
    int count = number_of(name, draws_of(usual)), first = number_of(seeds, 1), differ = 0, left_out = 0;
    for (int i = 0; i < count; i++) {
        bool sensitive;
        differ += !agrees((uint64_t)first + (uint64_t)i, &sensitive);
        left_out += sensitive;
    }
    printf("# %d scenes, %d too sensitive\n", count, left_out);
    assert_int_equal(differ, 0);
    assert_true(most * left_out <= count);
}
