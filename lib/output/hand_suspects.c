/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/hand_suspects.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "dynamics/mass.h"

static double cross(struct vec a, struct vec b)
{
    return vec_cross(a, b);
}

static double line_at(const struct suspects_look *look)
{
    const double t = look->state->t;
    return expr_eval(look->hand->left, t, look->y, NULL) - expr_eval(look->hand->right, t, look->y, NULL);
}

static const struct model_body *body_of(const struct suspects_look *look)
{
    return &look->model->bodies[look->check->body];
}

/* ---- points */

static void add_place(struct suspects_look *look, const char *name, bool own, struct vec where)
{
    if (look->place_count == most_places) return;
    look->places[look->place_count++] =
        (struct place_of){.name = name, .own = own, .frame = where, .p = where};
}

/* G, O, points of the body, and where reactions act. */
static void list_places(struct suspects_look *look)
{
    const struct model_body *body = body_of(look);
    const struct body *source = body->source;
    look->place_count = 0;
    look->about = look->hand->about[0] != NULL;
    if (look->about) add_place(look, look->hand->about_name, false, (struct vec){0, 0});
    add_place(look, "G", true, body->inertia.G);
    if (source->motion.kind == motion_pivot) add_place(look, "O", true, source->motion.point);
    for (size_t i = 0; i < source->point_count; i++)
        if (!strchr(source->points[i].name, '.'))
            add_place(look, source->points[i].name, true, source->points[i].where);
    for (size_t i = 0; i < look->arrow_count; i++)
        if (arrow_is_reaction(look->model, &look->arrows[i]))
            add_place(look, look->arrows[i].name, false, look->arrows[i].point);
}

static void find_places(struct suspects_look *look)
{
    const struct model_body *body = body_of(look);
    const struct pose pose = body_pose(body, &look->at);
    for (size_t k = 0; k < look->place_count; k++) {
        struct place_of *place = &look->places[k];
        if (place->own) place->p = point_motion(body, &pose, place->frame).p;
        for (size_t i = 0; !place->own && i < look->arrow_count; i++)
            if (strcmp(look->arrows[i].name, place->name) == 0) place->p = look->arrows[i].point;
    }
    if (!look->about) return;
    look->places[0].p.x = expr_eval(look->hand->about[0], look->state->t, look->y, NULL);
    look->places[0].p.y = expr_eval(look->hand->about[1], look->state->t, look->y, NULL);
}

/* ---- names in the line */

static void add_letter(struct suspects_look *look, int slot, enum letter_kind kind,
                       const struct absolute *absolute)
{
    if (look->letter_count < most_letters)
        look->letters[look->letter_count++] = (struct letter){slot, kind, absolute};
}

static void list_letters(struct suspects_look *look)
{
    const struct fbd_model *model = look->model;
    const int first = (int)plan_size(&model->plan);
    look->letter_count = 0;
    for (int k = 0; k < hand_mass; k++)
        add_letter(look, first + hand_acceleration + k, letter_acceleration, NULL);
    add_letter(look, first + hand_I_G, letter_inertia, NULL);
    add_letter(look, first + hand_I_O, letter_inertia, NULL);
    add_letter(look, first + hand_N, letter_force, NULL);
    for (size_t k = 0; k < model->absolute_count; k++) {
        const enum absolute_kind kind = model->absolutes[k].kind;
        if (!hand_writes(kind)) continue;
        add_letter(look, first + hand_slots + (int)k,
                   kind == absolute_force     ? letter_force
                   : kind == absolute_inertia ? letter_inertia
                                              : letter_acceleration,
                   &model->scene->absolutes[k]);
    }
}

static void list_names(struct suspects_look *look)
{
    list_places(look);
    list_letters(look);
}

static void take_slopes(struct suspects_look *look)
{
    const double t = look->state->t;
    for (size_t n = 0; n < look->letter_count; n++) {
        const struct letter *letter = &look->letters[n];
        double left, right;
        expr_eval_slot(look->hand->left, t, look->y, 1 + letter->slot, NULL, &left);
        expr_eval_slot(look->hand->right, t, look->y, 1 + letter->slot, NULL, &right);
        const double slope = left - right;
        look->slope[n] = fabs(slope) > 1e-9 * (fabs(left) + fabs(right)) ? slope : 0;
        look->size += fabs(look->slope[n] * look->y[letter->slot]);
    }
}

/* The force for which a letter stands, of this body; NULL where it is a sum, or another body's. */
static const struct hand_force *force_of(const struct suspects_look *look, const struct letter *letter,
                                         double *sign)
{
    *sign = 1;
    if (letter->kind != letter_force || !letter->absolute) return NULL;
    const struct hand_sum *sum =
        &look->named->of[(size_t)letter->slot - plan_size(&look->model->plan) - hand_slots];
    if (sum->count != 1 || sum->forces[0]->name.body != look->check->body) return NULL;
    *sign = sum->signs[0];
    return sum->forces[0];
}

/* ---- terms */

static double part_along(const struct suspects_look *look, struct vec F, struct vec point, double couple,
                         int equation)
{
    const struct vec e = body_direction(body_of(look), &look->at);
    switch (equation) {
    case equation_x: return F.x;
    case equation_y: return F.y;
    case equation_along: return vec_dot(F, e);
    case equation_across: return cross(e, F);
    default: break;
    }
    return couple + cross(vec_sub(point, look->places[equation - equation_moment].p), F);
}

static double term_of(const struct suspects_look *look, const struct arrow *arrow, int equation)
{
    return part_along(look, arrow->force, arrow->point, arrow->couple, equation);
}

/* What the coefficient of a letter is in an equation. */
static double coefficient_of(const struct suspects_look *look, const struct hand_force *force, double value,
                             int equation)
{
    const struct arrow *arrow = &look->arrows[force->arrow];
    const struct vec x = {force->sign, 0}, y = {0, force->sign}, none = {0, 0};
    switch (force->part) {
    case hand_force_x: return part_along(look, x, arrow->point, 0, equation);
    case hand_force_y: return part_along(look, y, arrow->point, 0, equation);
    case hand_force_couple: return part_along(look, none, arrow->point, force->sign, equation);
    case hand_force_size: return value != 0 ? term_of(look, arrow, equation) / value : 0;
    default: return 0;
    }
}

/* ---- by what a line has been multiplied */

struct votes {
    double of[2 * most_letters];
    size_t count;
};

static void vote(struct votes *votes, double slope, double coefficient)
{
    const double factor = slope / coefficient;
    if (slope != 0 && coefficient != 0 && isfinite(factor)) votes->of[votes->count++] = factor;
}

/* The factor that most of them have, of equal ones the first; 0 without any. */
static double most_votes(const struct votes *votes)
{
    size_t best = 0;
    double factor = 0;
    for (size_t i = 0; i < votes->count; i++) {
        size_t same = 0;
        for (size_t j = 0; j < votes->count; j++)
            same += fabs(votes->of[j] - votes->of[i]) <= 1e-6 * fabs(votes->of[i]);
        if (same <= best) continue;
        factor = votes->of[i];
        best = same;
    }
    return factor;
}

/* Inertia times acceleration stands on the right of an equation: minus its coefficient. */
static void vote_by_inertia(const struct suspects_look *look, const struct letter *letter, double slope,
                            int equation, struct votes *votes)
{
    const struct model_body *body = body_of(look);
    const int k = letter->slot - (int)plan_size(&look->model->plan) - hand_acceleration;
    const bool own = !letter->absolute && body->place.link == 0;
    const bool alone = body->count == 1, moment = equation >= equation_moment;
    const enum absolute_kind kind = letter->absolute ? letter->absolute->kind : absolute_acceleration;
    if (letter->absolute && letter->absolute->body != look->check->body) return;
    const struct inertia inertia = body_inertia(body, &look->at);
    const bool turns = kind == absolute_alpha || (own && (body->kind == motion_pivot || k == 2));
    if (moment && turns) {
        const struct pose pose = body_pose(body, &look->at);
        const struct vec arm =
            vec_sub(point_motion(body, &pose, inertia.G).p, look->places[equation - equation_moment].p);
        vote(votes, slope, -(inertia.I_G + inertia.mass * vec_dot(arm, arm)));
        if (vec_dot(arm, arm) > 0) vote(votes, slope, -inertia.I_G);
    }
    const bool x = kind == absolute_ax || (own && !alone && k == 0);
    const bool y = kind == absolute_ay || (own && !alone && k == 1);
    const bool along = own && alone && (body->kind == motion_slide || body->kind == motion_track);
    if ((equation == equation_x && x) || (equation == equation_y && y) ||
        (equation == equation_along && along))
        vote(votes, slope, -inertia.mass);
    const struct vec e = body_direction(body, &look->at);
    if (along && equation == equation_x && e.x != 0) vote(votes, slope, -inertia.mass * e.x);
    if (along && equation == equation_y && e.y != 0) vote(votes, slope, -inertia.mass * e.y);
}

static double find_factor(const struct suspects_look *look, int equation, bool arms)
{
    struct votes votes = {.count = 0};
    for (size_t n = 0; n < look->letter_count && !arms; n++)
        if (look->letters[n].kind == letter_acceleration && look->slope[n] != 0)
            vote_by_inertia(look, &look->letters[n], look->slope[n], equation, &votes);
    for (size_t n = 0; n < look->letter_count; n++) {
        double sign;
        const struct hand_force *force = force_of(look, &look->letters[n], &sign);
        if (!force || look->slope[n] == 0 || votes.count + 2 > sizeof votes.of / sizeof *votes.of) continue;
        const double value = sign * look->y[look->letters[n].slot];
        vote(&votes, look->slope[n], sign * coefficient_of(look, force, value, equation));
    }
    return most_votes(&votes);
}

/* ---- looking */

static bool open_model(struct suspects_look *look, const struct fbd_model *model)
{
    look->model = model;
    look->hand = &model->scene->bodies[look->check->body].hands[look->check->index];
    look->arrows = ARENA_ARRAY(&look->arena, diagram_most_arrows(model) + 1, struct arrow);
    return look->arrows && hand_forces_make(model, &look->arena, &look->forces);
}

void suspects_close(struct suspects_look *look)
{
    arena_free(&look->arena);
    look->arena = (struct arena){0};
    look->model = NULL;
}

bool suspects_look_at(struct suspects_look *look, const struct fbd_state *state,
                      const struct hand_named *named, double *y)
{
    const struct fbd_model *model = state->model;
    const int b = look->check->body;
    const bool first = !look->model;
    look->state = state;
    look->named = named;
    look->at = state_instant(state);
    look->y = y;
    if (first && !open_model(look, model)) return false;
    hand_extend(state, b, named, y);
    look->arrow_count = diagram_fill(model, b, &look->at, state->a, state->slots, look->arrows);
    if (first) list_names(look);
    find_places(look);
    const struct vec a = mass_center_acceleration(body_of(look), &look->at, state->a);
    look->m_a = vec_scale(body_mass(body_of(look), &look->at), a);
    look->lack = line_at(look);
    look->size = DBL_MIN;
    for (size_t j = 0; j < look->hand->summand_count; j++)
        look->size += fabs(expr_eval(look->hand->summands[j].expr, state->t, y, NULL));
    if (look->hand->summand_count == 0) look->size += fabs(expr_eval(look->hand->left, state->t, y, NULL));
    take_slopes(look);
    for (int k = 0; k < equation_moment + (int)look->place_count; k++)
        look->factor[k] = find_factor(look, k, false);
    for (size_t k = 0; k < look->place_count; k++)
        look->factor_of_arms[k] = find_factor(look, equation_moment + (int)k, true);
    return true;
}

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
    listing->count += listing->list != NULL && listing->count < listing->room;
}

static void add_letters(const struct suspects_look *look, struct listing *listing)
{
    for (size_t n = 0; n < look->letter_count; n++) {
        const struct letter *letter = &look->letters[n];
        double sign;
        if (look->slope[n] == 0) continue;
        if (letter->kind != letter_inertia) add(listing, suspect_letter, n, 0, 0, false);
        const struct hand_force *own = force_of(look, letter, &sign);
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

/* What the dimension of a line leaves: sums of forces, of moments, or both where it was multiplied by something. */
static void find_kinds(const struct suspects_look *look, bool *forces, bool *moments)
{
    const struct dim force = DIM_INIT(1, 1, -2), moment = DIM_INIT(1, 2, -2),
                     own = expr_dim(look->hand->left);
    *forces = !look->about && !dim_equal(own, moment);
    *moments = !dim_equal(own, force);
}

/* The terms of an arrow in an equation, and those of others that may stand in its place. */
static void add_term(const struct suspects_look *look, struct listing *listing, size_t i, int equation)
{
    add(listing, suspect_term, i, 0, equation, false);
    if (equation >= equation_moment) add(listing, suspect_part, i, 0, equation, true);
    if (equation >= equation_moment) add(listing, suspect_part, i, 0, equation, false);
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
    for (size_t j = 0; j < look->hand->summand_count; j++) add(&listing, suspect_summand, j, 0, 0, false);
    add_letters(look, &listing);
    add_terms(look, &listing);
    for (size_t p = 0; p < look->place_count; p++)
        for (size_t q = 0; q < look->place_count; q++)
            if (p != q && (p == 0 || q == 0 || !look->about)) add(&listing, suspect_place, p, q, 0, false);
    *count = listing.count;
    return listing.list;
}

/* ---- values */

/* What the line changes by with another value in the place of a letter. */
static double change_by(const struct suspects_look *look, size_t n, double value)
{
    double *slot = &look->y[look->letters[n].slot];
    const double before = *slot;
    *slot = value;
    const double after = line_at(look);
    *slot = before;
    return look->lack - after;
}

static double I_about(const struct suspects_look *look, struct vec point)
{
    const struct model_body *body = body_of(look);
    const struct inertia inertia = body_inertia(body, &look->at);
    const struct vec arm = vec_sub(inertia.G, point);
    return inertia.I_G + inertia.mass * vec_dot(arm, arm);
}

/* The accelerations of one point along x and y, in the place of those of another one. */
static double change_of_point(const struct suspects_look *look, const struct suspect *suspect)
{
    const struct absolute *own = look->letters[suspect->which].absolute;
    const struct vec a =
        point_acceleration(body_of(look), look->places[suspect->other].frame, &look->at, look->state->a);
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

/* By what the line was multiplied as an equation of this kind: 1 where no name tells anything of any kind, NAN where none
 * does of this one. */
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
    const double term = term_of(look, arrow, suspect->equation);
    if (suspect->kind == suspect_exchange) {
        const double other = term_of(look, &look->arrows[suspect->other], suspect->equation);
        return fmin(fabs(term), fabs(other)) <= 1e-9 * fmax(fabs(term), fabs(other))
                   ? NAN
                   : factor * (term - other);
    }
    if (suspect->kind == suspect_term) return factor * term;
    return factor * part_along(look, part, arrow->point, 0, suspect->equation);
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
        return none ? NAN : change_by(look, n, value); /* without it: one too many */
    }
    case suspect_inertia: return change_by(look, n, I_about(look, look->places[suspect->other].frame));
    case suspect_acceleration: return change_of_point(look, suspect);
    case suspect_term:
    case suspect_exchange:
    case suspect_part: return term_value(look, suspect);
    case suspect_place: break;
    }
    const struct vec arm = vec_sub(look->places[suspect->other].p, look->places[n].p);
    return factor_as(look, look->factor_of_arms[n]) * cross(arm, look->m_a);
}

bool suspects_is_about(const struct suspects_look *look, size_t place)
{
    const int equation = equation_moment + (int)place;
    const double factor = look->factor_of_arms[place], rounding = 1e-9;
    double arm = 0, force = 0;
    for (size_t i = 0; i < look->arrow_count; i++) {
        force = fmax(force, vec_norm(look->arrows[i].force));
        arm = fmax(arm, vec_norm(vec_sub(look->arrows[i].point, look->places[place].p)));
    }
    for (size_t n = 0; n < look->letter_count; n++) {
        double sign;
        const struct hand_force *one = force_of(look, &look->letters[n], &sign);
        if (!one || one->part == hand_force_at_x || one->part == hand_force_at_y) continue;
        const double coefficient =
            sign * factor * coefficient_of(look, one, sign * look->y[look->letters[n].slot], equation);
        if (!(fabs(look->slope[n] - coefficient) <= 1e-6 * fabs(look->slope[n]))) return false;
    }
    for (size_t i = 0; i < look->arrow_count; i++)
        if (arrow_is_reaction(look->model, &look->arrows[i]) && !suspects_name(look, i) &&
            fabs(term_of(look, &look->arrows[i], equation)) > rounding * force * arm)
            return false;
    return true;
}

bool suspects_name(const struct suspects_look *look, size_t arrow)
{
    for (size_t n = 0; n < look->letter_count; n++) {
        double sign;
        const struct hand_force *force = force_of(look, &look->letters[n], &sign);
        if (force && force->arrow == arrow && look->slope[n] != 0) return true;
    }
    return false;
}
