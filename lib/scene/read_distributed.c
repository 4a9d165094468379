/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Distributed loads: a force per length w(s) along a line of the body, replaced by its resultant:
 *
 *   F = integral of w ds,   s_F = integral of s w ds / F,   from `from` towards `to`.
 *
 * On a rigid body the two are equivalent, including all reactions. The integrals are computed once, by
 * adaptive quadrature over the pieces of w between its kinks and jumps.
 */
#include <math.h>

#include "expr/pieces.h"
#include "numeric/quadrature.h"
#include "scene/load_entry.h"
#include "scene/values.h"

/* ---- the integrals */

enum moment_of { of_force, of_arm, of_size };

struct integrand {
    const struct expr *w;
    enum moment_of moment;
};

static double integrand_at(double s, void *context)
{
    const struct integrand *integrand = context;
    double w = expr_eval(integrand->w, 0, &s, NULL);
    return integrand->moment == of_size ? fabs(w) : integrand->moment == of_arm ? s * w : w;
}

/* Integrate w, s w or |w|. The result is NAN if w has no value somewhere. */
static void integrate(const struct expr *w, enum moment_of moment, double length, double *integral,
                      double *error)
{
    enum { most_halves = 20000, most_pieces = 1000 };
    struct integrand integrand = {w, moment};
    gsl_function function = {integrand_at, &integrand};
    double ends[most_pieces + 1];
    int pieces = pieces_cut(&w, 1, 1, 0, length, most_pieces, ends);
    struct quadrature sum = quadrature_over(&function, ends, pieces, most_halves);
    *integral = sum.integral;
    *error = pieces > 0 ? sum.error : HUGE_VAL; /* more pieces than most_pieces */
}

/* ---- reading */

/* Read an end of the line, a point of the body; G follows from its parts. */
static bool read_end(struct entry *entry, const struct node *node, const char *what, struct vec *where)
{
    struct point point;
    if (!body_point_read(entry->reader, entry->body, node, what, &point)) return false;
    *where =
        point.kind == point_G ? body_centre_of_mass(&entry->reader->scene->bodies[entry->body]) : point.where;
    return true;
}

/* Compile `value`: w(s), or one end value of a trapezoid. */
static const struct expr *read_density(struct entry *entry, const struct node *node)
{
    struct reader *reader = entry->reader;
    struct names names = {.reader = reader, .place = place_constant, .body = ground_body, .along = true};
    struct scope scope = names_scope(&names);
    const struct expr_want want = {.any_dim = true, .what = "value"};
    if (node->kind != node_scalar || node->length == 0) {
        value_refuse(reader, node, "value", "a force per length, or a pair of them",
                     "write for example `value: 20 N/m`, `value: 5[N/m^2]*s` or `value: [0, 20 N/m]`");
        return NULL;
    }
    const struct expr *w = value_compile(reader, node, &want, &scope);
    if (!w) return NULL;
    if (expr_uses_time(w)) {
        entry_note(entry, "not-constant", node->at,
                   "write the dependence on time as `factor`: `factor: cos(w*t)`",
                   "`value` of a distributed load may depend on the place `s` along it alone");
        return NULL;
    }
    if (expr_is_bare(w) || dim_equal(expr_dim(w), DIM_STIFFNESS)) return w;
    entry_note(entry, "wrong-dimension", node->at, "write for example `value: 20 N/m`",
               "`value` of a distributed load is a force per length");
    return NULL;
}

/* A trapezoidal load, given by its values at both ends. */
static bool take_ends(struct entry *entry, const struct node *pair, double length, double *force, double *arm,
                      double *size)
{
    double *w = entry->keys.load.spread.ends;
    for (int k = 0; k < 2; k++) {
        const struct expr *end = pair->count == 2 ? read_density(entry, pair->items[k]) : NULL;
        if (pair->count != 2)
            value_refuse(entry->reader, pair, "value", "a force per length, or a pair of them",
                         "write for example `value: [0, 20 N/m]`");
        if (!end) return false;
        if (!expr_is_constant(end)) {
            entry_note(entry, "not-constant", pair->items[k]->at,
                       "leave out the brackets: `value: 5[N/m^2]*s`",
                       "a pair is of the values at both ends, which are constants");
            return false;
        }
        w[k] = expr_value(end);
    }
    *force = length * (w[0] + w[1]) / 2;
    *arm = length * length * (w[0] + 2 * w[1]) / 6;
    *size = length * (fabs(w[0]) + fabs(w[1])) / 2;
    return true;
}

static bool take_integrals(struct entry *entry, const struct node *node, double length, double *force,
                           double *arm, double *size)
{
    const double enough = 1e-9;
    const struct expr *w = entry->keys.load.spread.w = read_density(entry, node);
    double errors[3];
    if (!w) return false;
    integrate(w, of_force, length, force, &errors[0]);
    integrate(w, of_arm, length, arm, &errors[1]);
    integrate(w, of_size, length, size, &errors[2]);
    if (!isfinite(*force) || !isfinite(*arm) || !isfinite(*size)) {
        entry_note(entry, "not-finite", node->at, "it needs a value everywhere from `from` to `to`",
                   "the integral of `value` along the line is not finite");
        return false;
    }
    if (errors[0] <= enough * *size && errors[1] <= enough * length * *size) return true;
    entry_note(entry, "no-integral", node->at, "divide the load where `value` changes its form",
               "the integral of `value` along the line is not known to nine digits: it varies too wildly");
    return false;
}

/* Set the point of application of the resultant, or note that there is none. */
static bool place(struct entry *entry, struct vec from, struct vec to, double force, double arm, double size)
{
    const double nothing = 1e-12;
    struct load *load = &entry->keys.load;
    double length = vec_norm(vec_sub(to, from));
    if (fabs(force) <= nothing * size && fabs(arm) > nothing * length * size) {
        entry_note(entry, "no-resultant", entry->chosen.at, "divide it into two loads, of one sign each",
                   "the parts of this load cancel and leave a moment: it has no resultant force");
        return false;
    }
    struct spread *spread = &load->spread;
    spread->length = length;
    spread->center = size > 0 ? arm / force : length / 2;
    spread->force = force;
    spread->from = from;
    spread->to = to;
    struct vec e = vec_scale(1 / length, vec_sub(to, from));
    load->point = (struct point){.kind = point_fixed,
                                 .where = vec_add(from, vec_scale(spread->center, e)),
                                 .at = entry->chosen.at};
    return true;
}

static bool check_direction(struct entry *entry)
{
    if (entry_has(entry, "angle") || !entry->motion || entry_is_slide(entry)) return true;
    entry_note(entry, "missing-key", entry->chosen.at,
               "add its direction, `angle: -90 deg` for one straight down",
               "a distributed load needs `angle`, unless it acts on a slide");
    return false;
}

bool distributed_finish(struct entry *entry)
{
    struct load *load = &entry->keys.load;
    const struct node *value = entry->keys.value;
    struct vec from = {0, 0}, to;
    load->body_frame = entry->keys.frame == frame_body;
    if (!entry->keys.from || !entry->keys.to || !value) return false; /* noted as missing */
    bool ends = read_end(entry, entry->keys.from, "from", &from);
    if (!read_end(entry, entry->keys.to, "to", &to) || !ends) return false;
    double length = vec_norm(vec_sub(to, from)), force, arm, size;
    if (length == 0) {
        entry_note(entry, "out-of-range", entry->keys.to->at, "name two points",
                   "`from` and `to` are one point: the load has no length");
        return false;
    }
    bool taken = value->kind == node_list ? take_ends(entry, value, length, &force, &arm, &size)
                                          : take_integrals(entry, value, length, &force, &arm, &size);
    if (!taken || !check_direction(entry) || !place(entry, from, to, force, arm, size)) return false;
    if (entry_has(entry, "factor")) return derive_scaled(entry, force);
    load->value =
        (struct value){.expr = expr_constant(entry->reader->arena, force, DIM_FORCE), .at = value->at};
    return load->value.expr != NULL;
}
