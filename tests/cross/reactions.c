/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The multipliers as forces by name: lambda times what its row does to each body, force and moment about G.
 */
#include <stdio.h>
#include <string.h>

#include "absolute.h"

static void put(struct absolute *absolute, int b, const char *name, const double *D, double lambda,
                bool doubt)
{
    struct wrench *wrench = wrench_of(absolute, b, name);
    for (int i = 0; i < 3; i++) (doubt ? wrench->doubt : wrench->w)[i] += lambda * D[3 * b + i];
}

static const char *joint_name(const struct body *body)
{
    for (int i = 0; (body->motion == slide || body->motion == track) && i < body->load_count; i++)
        if (body->load[i].kind == normal) return body->load[i].name;
    return body->motion == pivot ? "pin" : body->motion == weld ? "weld" : "guide";
}

/* Of a joint or a load in it: on the body, and with its name before that on the one that it moves on. */
static void put_joint(struct absolute *absolute, const struct row *row, const double *D, double lambda,
                      bool doubt)
{
    const struct scene *scene = absolute->scene;
    const struct body *body = &scene->body[row->owner];
    char other[wrench_name_room];
    const char *name = joint_name(body);
    if (row->drive && row->grip < 0) name = "drive";
    if (row->grip >= 0) name = body->load[absolute->grip[row->grip].load].name;
    put(absolute, row->owner, name, D, lambda, doubt);
    if (body->on < 0) return;
    snprintf(other, sizeof other, "%s.%s", body->name, name);
    put(absolute, body->on, other, D, lambda, doubt);
}

static void put_coupling(struct absolute *absolute, const struct row *row, const double *D, double lambda,
                         bool doubt)
{
    const struct coupling *coupling = &absolute->scene->coupling[row->owner];
    char name[wrench_name_room];
    int bodies[most_ends + 2];
    size_t count = row_bodies(absolute, row, bodies);
    snprintf(name, sizeof name, "%s%s", coupling->name,
             row->kind == row_roll_normal || (row->kind == row_slot && coupling->has_friction) ? ".normal"
             : row->kind == row_roll_along || row->kind == row_slot_along                      ? ".friction"
                                                                                               : "");
    for (size_t i = 0; i < count; i++) put(absolute, bodies[i], name, D, lambda, doubt);
}

static void put_row(struct absolute *absolute, int j, const double *D, double lambda, bool doubt)
{
    const struct row *row = &absolute->row[j];
    if (row->kind < row_link_pin_x)
        put_joint(absolute, row, D, lambda, doubt);
    else
        put_coupling(absolute, row, D, lambda, doubt);
}

void absolute_list(struct absolute *absolute, const double *lambda, bool doubt)
{
    for (int j = 0; j < absolute->row_count; j++)
        if (absolute->active[j]) put_row(absolute, j, absolute->D[j], lambda[j], doubt);
    for (int i = 0; i < absolute->grip_count; i++) {
        const struct grip *grip = &absolute->grip[i];
        if (grip->mode != slips_plus && grip->mode != slips_minus) continue;
        if (doubt && grip->normal < 0) continue;
        double N = grip->normal < 0 ? 1 : grip->press * lambda[grip->normal];
        double force = -grip->mode * grip_coefficient(absolute, grip, true) * N;
        put_row(absolute, grip->row, absolute->D[grip->row], force, doubt);
    }
    if (!doubt) return;
    for (int i = 0; i < absolute->wrench_count; i++) {
        struct wrench *wrench = &absolute->wrench[i];
        for (int k = 0; k < 3; k++) {
            if (fabs(wrench->doubt[k]) > 1e-6) wrench->unique = false;
            wrench->doubt[k] = 0;
        }
    }
}
