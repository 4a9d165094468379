/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "absolute.h"

struct formula_function {
    double f, f1, f2;
};

static struct formula_function by_table(const struct table *table, double u)
{
    double f[3];
    value_by_table(table, u, f);
    return (struct formula_function){f[0], f[1], f[2]};
}

static struct formula_function apply(enum function function, double u)
{
    double e = exp(-u * u), h = sqrt(1 + u * u), th = tanh(u);
    switch (function) {
    case f_one: return (struct formula_function){1, 0, 0};
    case f_linear: return (struct formula_function){u, 1, 0};
    case f_sin: return (struct formula_function){sin(u), cos(u), -sin(u)};
    case f_cos: return (struct formula_function){cos(u), -sin(u), -cos(u)};
    case f_tanh: return (struct formula_function){th, 1 - th * th, -2 * th * (1 - th * th)};
    case f_square: return (struct formula_function){u * u, 2 * u, 2};
    case f_bell: return (struct formula_function){e, -2 * u * e, (4 * u * u - 2) * e};
    case f_hyper: return (struct formula_function){h, u / h, 1 / (h * h * h)};
    case f_atan: return (struct formula_function){atan(u), 1 / (h * h), -2 * u / (h * h * h * h)};
    case f_abs: return (struct formula_function){fabs(u), u < 0 ? -1 : 1, 0};
    case f_step: return (struct formula_function){u > 0, 0, 0};
    case f_ramp: return (struct formula_function){fmax(0, u), u > 0, 0};
    case f_clamp: return (struct formula_function){fmax(-1, fmin(1, u)), fabs(u) < 1, 0};
    case f_branch: return (struct formula_function){u > 0 ? u * u : 0, u > 0 ? 2 * u : 0, u > 0 ? 2 : 0};
    case f_table: break;
    }
    return (struct formula_function){NAN, NAN, NAN};
}

/* A variable as a number: of coordinates, rates and places the value, whatever flows. */
static double variable_value(const struct absolute *absolute, const struct variable *variable)
{
    const struct scene *scene = absolute->scene;
    int b = variable->body, i = variable->index;
    struct vec2 point = {0, 0};
    if (variable->kind == var_time) return absolute->t;
    if (variable->kind == var_state) return absolute->z[i];
    if (i >= 0 && variable->kind >= var_place_x && variable->kind <= var_place_vy)
        point = scene->body[b].points[i];
    struct place place = point_of(absolute, b, point);
    switch (variable->kind) {
    case var_coordinate: return coordinate_of(absolute, b, i).u;
    case var_rate: return coordinate_of(absolute, b, i).u1;
    case var_place_x: return place.x.u;
    case var_place_y: return place.y.u;
    case var_place_vx: return place.x.u1;
    case var_place_vy: return place.y.u1;
    case var_angle: return angle_of(absolute, b).u;
    case var_angle_rate: return angle_of(absolute, b).u1;
    case var_time:
    case var_state: break;
    }
    return NAN;
}

static struct series summand_value(const struct absolute *absolute, const struct summand *s, struct series u)
{
    struct formula_function f =
        s->function == f_table ? by_table(&absolute->scene->table[s->table], u.u) : apply(s->function, u.u);
    double factor = s->factor * (s->parameter < 0 ? 1 : absolute->scene->parameter[s->parameter]);
    return ser_scale(factor, ser_chain(f.f, f.f1, f.f2, u));
}

struct series formula_series(const struct absolute *absolute, const struct formula *formula, int own,
                             int seed)
{
    struct series sum = ser(0);
    for (int k = 0; k < formula->count; k++) {
        const struct summand *s = &formula->summand[k];
        struct series u = ser(s->shift);
        for (int i = 0; i < s->count; i++) {
            const struct variable *v = &s->variable[i];
            bool flows = seed < 0 ? v->kind == var_time
                                  : v->kind == var_coordinate && v->body == own && v->index == seed;
            struct series value = {variable_value(absolute, v), flows, 0};
            u = ser_add(u, ser_scale(v->coefficient, value));
        }
        sum = ser_add(sum, summand_value(absolute, s, u));
    }
    return sum;
}

double formula_rate(const struct absolute *absolute, const struct formula *formula)
{
    double sum = 0;
    for (int k = 0; k < formula->count; k++) {
        const struct summand *s = &formula->summand[k];
        struct series u = ser(s->shift);
        for (int i = 0; i < s->count; i++) {
            const struct variable *v = &s->variable[i];
            double rate = v->kind == var_time ? 1 : 0;
            if (v->kind == var_state) rate = formula_value(absolute, &absolute->scene->state[v->index].rate);
            if (v->kind == var_coordinate) rate = coordinate_of(absolute, v->body, v->index).u1;
            struct series value = {variable_value(absolute, v), rate, 0};
            u = ser_add(u, ser_scale(v->coefficient, value));
        }
        sum += summand_value(absolute, s, u).u1;
    }
    return sum;
}

double formula_value(const struct absolute *absolute, const struct formula *formula)
{
    return formula_series(absolute, formula, -1, -1).u;
}
