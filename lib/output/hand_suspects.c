/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/hand_look.h"

#include <math.h>
#include <string.h>

#include "dynamics/mass.h"

/* ---- the list */

struct listing {
    struct suspect *list;
    size_t count, room;
};

static void add(struct listing *listing, enum suspect_kind kind, size_t which, size_t other, int equation,
                bool upright)
{
    if (listing->count < listing->room)
        listing->list[listing->count] = (struct suspect){
            .kind = kind, .which = which, .other = other, .equation = equation, .upright = upright, .k = NAN};
    listing->count += listing->count < listing->room;
}

static void add_letters(const struct suspects_look *look, struct listing *listing)
{
    for (size_t n = 0; n < look->letter_count; n++) {
        const struct letter *letter = &look->letters[n];
        double sign;
        if (letter->kind != letter_inertia) add(listing, suspect_letter, n, 0, 0, false);
        const struct hand_force *own = look_force(look, letter, &sign);
        const struct dim force = DIM_INIT(1, 1, -2);
        const struct dim *dim = own ? &own->name.dim : &force;
        for (size_t i = 0; letter->kind == letter_force && i < look->forces.count; i++) {
            const struct hand_force *one = &look->forces.list[i];
            if (one->name.body == look->check->body && one != own && dim_equal(*dim, one->name.dim))
                add(listing, suspect_force, n, i, 0, false);
        }
        const enum absolute_kind kind = letter->absolute ? letter->absolute->kind : absolute_inertia;
        for (size_t k = 0; k < look->place_count; k++) {
            if (!look->places[k].own) continue;
            if (letter->kind == letter_inertia) add(listing, suspect_inertia, n, k, 0, false);
            if (kind == absolute_ax || kind == absolute_ay)
                add(listing, suspect_acceleration, n, k, 0, false);
        }
    }
}

/* The equations that the dimension of a line allows: of forces, of moments, or both where it has another dimension. */
static void find_kinds(const struct suspects_look *look, bool *forces, bool *moments)
{
    const struct dim force = DIM_INIT(1, 1, -2), moment = DIM_INIT(1, 2, -2),
                     own = expr_dim(look->hand->left);
    *forces = !look->about && !dim_equal(own, moment);
    *moments = !dim_equal(own, force);
}

/* Add the terms of an arrow in an equation, and those of others in its place. */
static void add_term(const struct suspects_look *look, struct listing *listing, size_t i, int equation)
{
    add(listing, suspect_term, i, 0, equation, false);
    for (int upright = 0; upright < 2 && equation >= equation_moment; upright++)
        add(listing, suspect_part, i, 0, equation, upright != 0);
    for (size_t j = 0; j < look->arrow_count; j++)
        if (j != i) add(listing, suspect_exchange, i, j, equation, false);
}

static void add_terms(const struct suspects_look *look, struct listing *listing)
{
    bool forces, moments;
    find_kinds(look, &forces, &moments);
    for (size_t i = 0; i < look->arrow_count; i++) {
        for (int k = 0; k < equation_moment && forces; k++) add_term(look, listing, i, k);
        for (int k = 0; moments && k < (int)look->place_count && (k == 0 || !look->about); k++)
            add_term(look, listing, i, equation_moment + k);
    }
}

struct suspect *suspects_list(const struct suspects_look *look, struct arena *arena, size_t *count)
{
    struct listing listing = {.room = look->hand->summand_count};
    listing.room += look->letter_count * (1 + look->forces.count + 2 * look->place_count);
    listing.room += look->arrow_count * (equation_moment + look->place_count) * (3 + look->arrow_count);
    listing.room += look->place_count * look->place_count + 1;
    listing.list = ARENA_ARRAY(arena, listing.room, struct suspect);
    if (!listing.list) return NULL;
    for (size_t j = 0; j < look->hand->summand_count; j++) add(&listing, suspect_summand, j, 0, 0, false);
    add_letters(look, &listing);
    add_terms(look, &listing);
    bool forces, moments;
    find_kinds(look, &forces, &moments);
    for (size_t p = 0; moments && p < look->place_count; p++)
        for (size_t q = 0; q < look->place_count; q++)
            if (p != q && (p == 0 || q == 0 || !look->about)) add(&listing, suspect_place, p, q, 0, false);
    *count = listing.count;
    return listing.list;
}

/* ---- values */

/* The change of the line when a letter gets another value. */
static double change_by(const struct suspects_look *look, size_t n, double value)
{
    double *slot = &look->y[look->letters[n].slot];
    const double before = *slot;
    *slot = value;
    const double after = look_line(look);
    *slot = before;
    return look->lack - after;
}

static double I_about(const struct suspects_look *look, struct vec point)
{
    const struct model_body *body = look_body(look);
    const struct inertia inertia = body_inertia(body, &look->at);
    const struct vec arm = vec_sub(inertia.G, point);
    return inertia.I_G + inertia.mass * vec_dot(arm, arm);
}

/* Change of the line with the accelerations of one point along x and y in place of those of another. */
static double change_of_point(const struct suspects_look *look, const struct suspect *suspect)
{
    const struct absolute *own = look->letters[suspect->which].absolute;
    const struct vec a = point_acceleration(look_body(look), look->places[suspect->other].frame, &look->at);
    double change = 0;
    if (own->body != look->check->body) return NAN;
    for (size_t n = 0; n < look->letter_count; n++) {
        const struct absolute *one = look->letters[n].absolute;
        if (!one || one->body != own->body || one->point.kind != own->point.kind ||
            one->point.where.x != own->point.where.x || one->point.where.y != own->point.where.y)
            continue;
        if (one->kind == absolute_ax) change += change_by(look, n, a.x);
        if (one->kind == absolute_ay) change += change_by(look, n, a.y);
    }
    return change;
}

/* The common factor of the line as an equation of this kind: 1 if the names determine none of any kind, NAN
 * if they determine none of this one. */
static double factor_as(const struct suspects_look *look, double factor)
{
    bool any = false;
    for (size_t k = 0; k < equation_moment + look->place_count; k++) any = any || look->factor[k] != 0;
    return factor != 0 ? factor : any ? NAN : 1;
}

static double term_value(const struct suspects_look *look, const struct suspect *suspect)
{
    const struct arrow *arrow = &look->arrows[suspect->which];
    const double factor = factor_as(look, look->factor[suspect->equation]);
    const struct vec F = arrow->force, part = suspect->upright ? (struct vec){0, F.y} : (struct vec){F.x, 0};
    const double term = look_term(look, arrow, suspect->equation);
    if (suspect->kind == suspect_exchange)
        return factor * (term - look_term(look, &look->arrows[suspect->other], suspect->equation));
    if (suspect->kind == suspect_term) return factor * term;
    return factor * look_part(look, part, arrow->point, 0, suspect->equation);
}

double suspect_value(const struct suspects_look *look, const struct suspect *suspect)
{
    const size_t n = suspect->which;
    switch (suspect->kind) {
    case suspect_summand: {
        const struct hand_summand *summand = &look->hand->summands[n];
        return summand->sign * expr_eval(summand->expr, look->state->t, look->y, NULL);
    }
    case suspect_letter: return look->slope[n] * look->y[look->letters[n].slot];
    case suspect_force: {
        const double value =
            hand_force_value(look->model, &look->forces.list[suspect->other], &look->at, look->arrows);
        const bool none = fabs(value) <= 1e-12 * fabs(look->y[look->letters[n].slot]);
        return none ? NAN : change_by(look, n, value); /* without it: it is superfluous */
    }
    case suspect_inertia: return change_by(look, n, I_about(look, look->places[suspect->other].frame));
    case suspect_acceleration: return change_of_point(look, suspect);
    case suspect_term:
    case suspect_exchange:
    case suspect_part: return term_value(look, suspect);
    case suspect_place: break;
    }
    const struct vec arm = vec_sub(look->places[suspect->other].p, look->places[n].p);
    return factor_as(look, look->factor_of_arms[n]) * vec_cross(arm, look->m_a);
}

/* True if the names of an arrow in the line have the coefficients of this equation. *named: there are some. */
static bool is_as_it_should(const struct suspects_look *look, size_t arrow, const struct suspect *suspect,
                            bool *named)
{
    bool fits = true;
    *named = false;
    for (size_t n = 0; n < look->letter_count; n++) {
        double sign;
        const struct hand_force *force = look_force(look, &look->letters[n], &sign);
        const enum hand_force_part other = suspect->upright ? hand_force_x : hand_force_y;
        if (!force || force->arrow != arrow || look_is_place(force)) continue;
        if (suspect->kind == suspect_part && force->part == other) continue;
        const double value = sign * look->y[look->letters[n].slot];
        const double wanted =
            sign * look->factor[suspect->equation] * look_coefficient(look, force, value, suspect->equation);
        if (look->slope[n] == 0 && wanted == 0) continue;
        *named = true;
        fits = fits && fabs(look->slope[n] - wanted) <= 1e-6 * fabs(wanted);
    }
    return fits;
}

/* True if one of them is negligible compared with the other. */
static bool is_little(double a, double b)
{
    return fmin(fabs(a), fabs(b)) <= 1e-9 * fmax(fabs(a), fabs(b));
}

bool suspect_shows(const struct suspects_look *look, const struct suspect *suspect)
{
    const size_t n = suspect->which, other = suspect->other;
    double rest = 0;
    for (size_t j = 0; suspect->kind == suspect_summand && j < look->hand->summand_count; j++)
        if (j != n) rest += fabs(expr_eval(look->hand->summands[j].expr, look->state->t, look->y, NULL));
    if (suspect->kind == suspect_summand) return rest > 1e-6 * fabs(suspect_value(look, suspect));
    if (suspect->kind == suspect_force)
        return !is_little(look->y[look->letters[n].slot],
                          hand_force_value(look->model, &look->forces.list[other], &look->at, look->arrows));
    return suspect->kind != suspect_exchange ||
           !is_little(look_term(look, &look->arrows[n], suspect->equation),
                      look_term(look, &look->arrows[other], suspect->equation));
}

bool suspect_contradicted(const struct suspects_look *look, const struct suspect *suspect)
{
    const bool exchange = suspect->kind == suspect_exchange;
    bool named, other = false;
    if (!exchange && suspect->kind != suspect_term && suspect->kind != suspect_part) return false;
    bool fits = is_as_it_should(look, suspect->which, suspect, &named);
    if (!exchange) return named && fits;
    const bool other_fits = is_as_it_should(look, suspect->other, suspect, &other);
    return !named || fits || (other && other_fits);
}

bool suspects_is_about(const struct suspects_look *look, size_t place)
{
    const int equation = equation_moment + (int)place;
    const double factor = look->factor_of_arms[place], rounding = 1e-9;
    double arm = 0, force = 0;
    if (!look_inertia_fits(look, equation, factor)) return false;
    for (size_t i = 0; i < look->arrow_count; i++) {
        force = fmax(force, vec_norm(look->arrows[i].force));
        arm = fmax(arm, vec_norm(vec_sub(look->arrows[i].point, look->places[place].p)));
    }
    for (size_t n = 0; n < look->letter_count; n++) {
        double sign;
        const struct hand_force *one = look_force(look, &look->letters[n], &sign);
        if (!one || look_is_place(one)) continue;
        const double coefficient =
            sign * factor * look_coefficient(look, one, sign * look->y[look->letters[n].slot], equation);
        if (!(fabs(look->slope[n] - coefficient) <= 1e-6 * fabs(look->slope[n]))) return false;
    }
    for (size_t i = 0; i < look->arrow_count; i++)
        if (arrow_is_reaction(look->model, &look->arrows[i]) && !suspects_name(look, i) &&
            fabs(look_term(look, &look->arrows[i], equation)) > rounding * force * arm)
            return false;
    return true;
}

bool suspects_name(const struct suspects_look *look, size_t arrow)
{
    for (size_t n = 0; n < look->letter_count; n++) {
        double sign;
        const struct hand_force *force = look_force(look, &look->letters[n], &sign);
        if (force && force->arrow == arrow && look->slope[n] != 0) return true;
    }
    return false;
}
