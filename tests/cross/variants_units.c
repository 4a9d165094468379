/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The same scene in other units: lengths by l, forces by f, so masses by f / l.
 */
#include "variants.h"

void scale_formula(struct formula *formula, double factor)
{
    for (int k = 0; k < formula->count; k++) formula->summand[k].factor *= factor;
}

static void scale_pair(struct vec2 *p, double k)
{
    p->x *= k;
    p->y *= k;
}

static void scale_by_dimension(struct formula *formula, double l, double f)
{
    const double factor[dimension_count] = {1, 1, l, l, 1, f, f * l, f * l, f / l};
    scale_formula(formula, factor[formula->dimension]);
}

static void convert_path(struct path *path, double l)
{
    path->a *= l;
    if (path->form == path_oval) {
        path->b *= l;
        return;
    }
    path->wave /= l;
    path->from *= l;
    path->to *= l;
}

static void convert_load(struct load *load, double l, double f)
{
    bool moment = load->kind >= moment_applied;
    scale_pair(&load->to, l);
    scale_pair(&load->at.where, l);
    scale_pair(&load->end.where, l);
    load->per_length[0] *= f / l;
    load->per_length[1] *= f / l / (load->curved ? l * l : 1);
    load->stiffness *= moment ? f * l : f / l;
    load->coefficient *= moment ? f * l : f / l;
    load->quadratic *= f / (l * l);
    if (!moment) load->neutral *= l;
    scale_by_dimension(&load->value, l, f);
    scale_by_dimension(&load->second, l, f);
    scale_by_dimension(&load->surface, l, f);
    load->reach *= l;
    for (int k = 0; k < 2; k++) {
        scale_by_dimension(&load->offset[k], l, f);
        scale_by_dimension(&load->wind[k], l, f);
    }
}

static void convert_body(struct body *body, double l, double f)
{
    scale_pair(&body->at.where, l);
    scale_pair(&body->point.where, l);
    convert_path(&body->path, l);
    for (int i = 0; i < body->piece_count; i++) {
        struct piece *piece = &body->piece[i];
        piece->mass *= f / l;
        scale_pair(&piece->center, l);
        for (int k = 0; k < 3; k++) piece->size[k] *= piece->shape == given_inertia && k == 0 ? f * l : l;
    }
    for (int i = 0; i < body->point_count; i++) scale_pair(&body->points[i], l);
    for (int i = 0; i < 3; i++) {
        bool angle = body->motion == pivot || i == 2;
        body->q[i] *= angle ? 1 : l;
        body->v[i] *= angle ? 1 : l;
    }
    scale_by_dimension(&body->drive, l, f);
    scale_by_dimension(&body->mass, l, f);
    for (int i = 0; i < body->load_count; i++) convert_load(&body->load[i], l, f);
}

void vary_units(struct scene *scene, double l, double f)
{
    scene->us = !scene->us;
    scale_pair(&scene->gravity, l);
    for (int i = 0; i < scene->line_count; i++) scale_pair(&scene->line[i].through, l);
    for (int b = 0; b < scene->body_count; b++) convert_body(&scene->body[b], l, f);
    for (int c = 0; c < scene->coupling_count; c++) {
        struct coupling *coupling = &scene->coupling[c];
        coupling->stiffness *= f / l;
        coupling->coefficient *= f / l;
        coupling->free_length *= l;
        coupling->length *= l;
        coupling->radius[0] *= l;
        coupling->radius[1] *= l;
        coupling->tension *= f;
        convert_path(&coupling->path, l);
        scale_by_dimension(&coupling->reel, l, f);
        for (int k = 0; k < coupling->count; k++) {
            scale_pair(&coupling->end[k].at.where, l);
            coupling->end[k].radius *= l;
        }
    }
}
