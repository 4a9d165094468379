/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shrink.h"

#include <math.h>
#include <string.h>

struct shrinking {
    struct scene *scene, trial;
    still_fails *fails;
    void *context;
    bool progress;
};

/* The scene as it is, to be changed. */
static struct scene *begin(struct shrinking *s)
{
    s->trial = *s->scene;
    return &s->trial;
}

static bool keep(struct shrinking *s)
{
    if (!s->fails(s->context, &s->trial)) return false;
    *s->scene = s->trial;
    s->progress = true;
    return true;
}

/* ---- formulas of a scene */

typedef void visit_formula(void *context, struct formula *formula);

static void each_formula(struct scene *scene, visit_formula *visit, void *context)
{
    for (int i = 0; i < scene->state_count; i++) visit(context, &scene->state[i].rate);
    for (int b = 0; b < scene->body_count; b++) {
        struct body *body = &scene->body[b];
        visit(context, &body->drive);
        visit(context, &body->mass);
        for (int i = 0; i < body->load_count; i++) {
            visit(context, &body->load[i].value);
            visit(context, &body->load[i].second);
            visit(context, &body->load[i].surface);
            for (int k = 0; k < 2; k++) visit(context, &body->load[i].offset[k]);
            for (int k = 0; k < 2; k++) visit(context, &body->load[i].wind[k]);
        }
    }
    for (int c = 0; c < scene->coupling_count; c++) {
        visit(context, &scene->coupling[c].mu_s);
        visit(context, &scene->coupling[c].mu_k);
    }
}

static void drop_variable(struct summand *summand, int i)
{
    summand->count--;
    memmove(&summand->variable[i], &summand->variable[i + 1],
            (size_t)(summand->count - i) * sizeof summand->variable[0]);
}

/* Body `*context` is no more. */
static void forget_body(void *context, struct formula *formula)
{
    int gone = *(int *)context;
    for (int k = 0; k < formula->count; k++)
        for (int i = formula->summand[k].count - 1; i >= 0; i--) {
            struct variable *variable = &formula->summand[k].variable[i];
            bool of_body = variable->kind != var_time && variable->kind != var_state;
            if (of_body && variable->body == gone)
                drop_variable(&formula->summand[k], i);
            else if (variable->body > gone)
                variable->body--;
        }
}

/* ---- what can be left out */

static bool points_to(const struct load *load, int b)
{
    return load->kind == applied && load->form == toward_point && load->target == b;
}

static bool is_needed(const struct scene *scene, int b)
{
    for (int i = 0; i < scene->body_count; i++) {
        if (scene->body[i].on == b) return true;
        for (int k = 0; k < scene->body[i].load_count; k++)
            if (points_to(&scene->body[i].load[k], b)) return true;
    }
    for (int c = 0; c < scene->coupling_count; c++)
        for (int k = 0; k < scene->coupling[c].count; k++)
            if (scene->coupling[c].end[k].body == b) return true;
    return false;
}

static void remove_body(struct scene *scene, int b)
{
    scene->body_count--;
    memmove(&scene->body[b], &scene->body[b + 1], (size_t)(scene->body_count - b) * sizeof scene->body[0]);
    for (int i = 0; i < scene->body_count; i++)
        if (scene->body[i].on > b) scene->body[i].on--;
    for (int i = 0; i < scene->body_count; i++)
        for (int k = 0; k < scene->body[i].load_count; k++)
            if (scene->body[i].load[k].target > b) scene->body[i].load[k].target--;
    for (int c = 0; c < scene->coupling_count; c++)
        for (int k = 0; k < scene->coupling[c].count; k++)
            if (scene->coupling[c].end[k].body > b) scene->coupling[c].end[k].body--;
    each_formula(scene, forget_body, &b);
}

static void drop_couplings(struct shrinking *s)
{
    for (int c = s->scene->coupling_count - 1; c >= 0; c--) {
        struct scene *trial = begin(s);
        trial->coupling_count--;
        memmove(&trial->coupling[c], &trial->coupling[c + 1],
                (size_t)(trial->coupling_count - c) * sizeof trial->coupling[0]);
        keep(s);
    }
}

static void drop_bodies(struct shrinking *s)
{
    for (int b = s->scene->body_count - 1; b >= 0; b--) {
        if (is_needed(s->scene, b) || s->scene->body_count == 1) continue;
        remove_body(begin(s), b);
        keep(s);
    }
}

static void drop_loads(struct shrinking *s)
{
    for (int b = 0; b < s->scene->body_count; b++)
        for (int i = s->scene->body[b].load_count - 1; i >= 0; i--) {
            struct body *body = &begin(s)->body[b];
            body->load_count--;
            memmove(&body->load[i], &body->load[i + 1],
                    (size_t)(body->load_count - i) * sizeof body->load[0]);
            keep(s);
        }
}

static void simplify_bodies(struct shrinking *s)
{
    for (int b = 0; b < s->scene->body_count; b++) {
        if (s->scene->body[b].driven) {
            begin(s)->body[b].driven = false;
            keep(s);
        }
        if (s->scene->body[b].mass_varies) {
            begin(s)->body[b].mass_varies = false;
            keep(s);
        }
        while (s->scene->body[b].piece_count > 1) {
            begin(s)->body[b].piece_count--;
            if (!keep(s)) break;
        }
        if (s->scene->body[b].at.point != at_origin) {
            begin(s)->body[b].at = (struct spot){.point = at_origin};
            keep(s);
        }
        if (s->scene->body[b].point.point != at_origin) {
            begin(s)->body[b].point = (struct spot){.point = at_origin};
            keep(s);
        }
    }
}

/* ---- formulas and numbers */

struct counted {
    int wanted, count;
    struct formula *found;
};

static void count_formula(void *context, struct formula *formula)
{
    struct counted *counted = context;
    if (formula->count == 0) return;
    if (counted->count++ == counted->wanted) counted->found = formula;
}

static struct formula *formula_number(struct scene *scene, int index)
{
    struct counted counted = {.wanted = index};
    each_formula(scene, count_formula, &counted);
    return counted.found;
}

static void simplify_formulas(struct shrinking *s)
{
    struct formula *formula;
    for (int f = 0; (formula = formula_number(begin(s), f)) != NULL; f++) {
        if (!formula_is_constant(formula)) {
            *formula = constant_formula(formula->dimension, 1);
            if (keep(s)) continue;
        }
        for (int k = formula_number(begin(s), f)->count - 1; k >= 0; k--) {
            formula = formula_number(begin(s), f);
            if (formula->count == 1) break;
            formula->count--;
            memmove(&formula->summand[k], &formula->summand[k + 1],
                    (size_t)(formula->count - k) * sizeof formula->summand[0]);
            keep(s);
        }
        for (int k = 0; k < formula_number(begin(s), f)->count; k++)
            for (int i = formula_number(begin(s), f)->summand[k].count - 1; i >= 0; i--) {
                drop_variable(&formula_number(begin(s), f)->summand[k], i);
                keep(s);
            }
    }
}

typedef bool visit_number(void *context, double *number);

static bool each_in_formula(struct formula *formula, visit_number *visit, void *context)
{
    for (int k = 0; k < formula->count; k++) {
        struct summand *summand = &formula->summand[k];
        if (visit(context, &summand->factor) || visit(context, &summand->shift)) return true;
        for (int i = 0; i < summand->count; i++)
            if (visit(context, &summand->variable[i].coefficient)) return true;
    }
    return false;
}

static bool each_in_body(struct body *body, visit_number *visit, void *context)
{
    double *own[] = {&body->along,         &body->at.where.x, &body->at.where.y, &body->point.where.x,
                     &body->point.where.y, &body->q[0],       &body->q[1],       &body->q[2],
                     &body->v[0],          &body->v[1],       &body->v[2]};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (visit(context, own[i])) return true;
    for (int i = 0; i < body->piece_count; i++) {
        struct piece *p = &body->piece[i];
        double *of[] = {&p->mass,     &p->size[0],  &p->size[1], &p->size[2],
                        &p->center.x, &p->center.y, &p->angle};
        for (size_t k = 0; k < sizeof of / sizeof *of; k++)
            if (visit(context, of[k])) return true;
    }
    for (int i = 0; i < body->point_count; i++)
        if (visit(context, &body->points[i].x) || visit(context, &body->points[i].y)) return true;
    for (int i = 0; i < body->load_count; i++) {
        struct load *l = &body->load[i];
        double *of[] = {&l->to.x,      &l->to.y,    &l->at.where.x,  &l->at.where.y,
                        &l->stiffness, &l->neutral, &l->coefficient, &l->quadratic};
        for (size_t k = 0; k < sizeof of / sizeof *of; k++)
            if (visit(context, of[k])) return true;
        if (each_in_formula(&l->value, visit, context) || each_in_formula(&l->second, visit, context) ||
            each_in_formula(&l->surface, visit, context))
            return true;
    }
    return each_in_formula(&body->drive, visit, context);
}

static bool each_number(struct scene *scene, visit_number *visit, void *context)
{
    if (visit(context, &scene->gravity.x) || visit(context, &scene->gravity.y)) return true;
    for (int b = 0; b < scene->body_count; b++)
        if (each_in_body(&scene->body[b], visit, context)) return true;
    for (int c = 0; c < scene->coupling_count; c++) {
        struct coupling *coupling = &scene->coupling[c];
        double *of[] = {&coupling->stiffness, &coupling->free_length, &coupling->coefficient};
        for (size_t k = 0; k < sizeof of / sizeof *of; k++)
            if (visit(context, of[k])) return true;
        for (int k = 0; k < coupling->count; k++)
            if (visit(context, &coupling->end[k].at.where.x) || visit(context, &coupling->end[k].at.where.y))
                return true;
    }
    return false;
}

struct chosen_number {
    int left;
    double *number;
};

static bool choose_number(void *context, double *number)
{
    struct chosen_number *chosen = context;
    chosen->number = number;
    return chosen->left-- == 0;
}

static double *number_at(struct scene *scene, int index)
{
    struct chosen_number chosen = {index, NULL};
    return each_number(scene, choose_number, &chosen) ? chosen.number : NULL;
}

static void simplify_numbers(struct shrinking *s)
{
    double *number;
    for (int i = 0; (number = number_at(begin(s), i)) != NULL; i++) {
        double value = *number;
        const double simpler[] = {0, 1, round(value), round(10 * value) / 10};
        for (size_t k = 0; k < 4; k++) {
            if (value == 0 || value == 1 || simpler[k] == value) continue;
            *number_at(begin(s), i) = simpler[k];
            if (keep(s)) break;
        }
    }
}

void scene_shrink(struct scene *scene, still_fails *fails, void *context)
{
    struct shrinking s = {.scene = scene, .fails = fails, .context = context};
    if (scene->us) {
        begin(&s)->us = false;
        keep(&s);
    }
    do {
        s.progress = false;
        drop_couplings(&s);
        drop_bodies(&s);
        drop_loads(&s);
        simplify_bodies(&s);
        simplify_formulas(&s);
    } while (s.progress);
    simplify_numbers(&s);
}
