/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/hand_look.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "dynamics/mass.h"

double look_line(const struct suspects_look *look)
{
    const double t = look->state->t;
    return expr_eval(look->hand->left, t, look->y, NULL) - expr_eval(look->hand->right, t, look->y, NULL);
}

const struct model_body *look_body(const struct suspects_look *look)
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

/* List G, O, points of the body, and points of application of reactions. */
static void list_places(struct suspects_look *look)
{
    const struct model_body *body = look_body(look);
    const struct body *source = body->source;
    look->place_count = 0;
    look->about = look->hand->about[0] != NULL;
    if (look->about) add_place(look, look->hand->about_name, false, (struct vec){0, 0});
    add_place(look, "G", true, body->inertia.G);
    if (body->joint->has_axis) add_place(look, "O", true, source->motion.point);
    for (size_t i = 0; i < source->point_count; i++)
        if (!strchr(source->points[i].name, '.'))
            add_place(look, source->points[i].name, true, source->points[i].where);
    for (size_t i = 0; i < look->arrow_count; i++)
        if (arrow_is_reaction(look->model, &look->arrows[i]))
            add_place(look, look->arrows[i].name, false, look->arrows[i].point);
}

static void find_places(struct suspects_look *look)
{
    const struct model_body *body = look_body(look);
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

/* The quantity of a slot of an expression; false for coordinates and rates. */
static bool letter_of(const struct fbd_model *model, int slot, struct letter *letter)
{
    const int own = slot - (int)plan_size(&model->plan), absolute = own - hand_slots;
    *letter = (struct letter){.slot = slot, .kind = letter_acceleration};
    if (absolute < 0) {
        if (own == hand_I_G || own == hand_I_O) letter->kind = letter_inertia;
        if (own == hand_N) letter->kind = letter_force;
        return own >= hand_acceleration && (own < hand_mass || letter->kind != letter_acceleration);
    }
    const enum absolute_kind kind = model->absolutes[absolute].kind;
    letter->absolute = &model->scene->absolutes[absolute];
    if (kind == absolute_section) return false;
    if (kind == absolute_force) letter->kind = letter_force;
    if (kind == absolute_inertia) letter->kind = letter_inertia;
    return hand_writes(kind);
}

static void add_letters_of(struct suspects_look *look, const struct expr *expr)
{
    const int *slots;
    const size_t count = expr_variables(expr, &slots);
    for (size_t i = 0; i < count && look->letter_count < most_letters; i++) {
        struct letter *letter = &look->letters[look->letter_count];
        bool is_new = letter_of(look->model, slots[i] - 1, letter);
        for (size_t n = 0; n < look->letter_count; n++)
            is_new = is_new && look->letters[n].slot != letter->slot;
        look->letter_count += is_new;
    }
}

static void list_letters(struct suspects_look *look)
{
    look->letter_count = 0;
    add_letters_of(look, look->hand->left);
    add_letters_of(look, look->hand->right);
}

static void list_names(struct suspects_look *look)
{
    list_places(look);
    list_letters(look);
}

static void take_slopes(struct suspects_look *look)
{
    const double t = look->state->t;
    const int first = (int)plan_size(&look->model->plan) + hand_slots;
    for (size_t n = 0; n < look->letter_count; n++) {
        const struct letter *letter = &look->letters[n];
        double left, right;
        expr_eval_slot(look->hand->left, t, look->y, 1 + letter->slot, NULL, &left);
        expr_eval_slot(look->hand->right, t, look->y, 1 + letter->slot, NULL, &right);
        const double slope = left - right;
        look->slope[n] = fabs(slope) > 1e-9 * (fabs(left) + fabs(right)) ? slope : 0;
        look->size += fabs(look->slope[n] * look->y[letter->slot]);
        if (letter->absolute) /* also where it is zero */
            look->size += fabs(look->slope[n]) * look->named->sizes[letter->slot - first];
    }
}

/* The force of this body that a letter denotes; NULL for a sum, or another body's. */
const struct hand_force *look_force(const struct suspects_look *look, const struct letter *letter,
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

double look_part(const struct suspects_look *look, struct vec F, struct vec point, double couple,
                 int equation)
{
    const struct vec e = body_direction(look_body(look), &look->at);
    switch (equation) {
    case equation_x: return F.x;
    case equation_y: return F.y;
    case equation_along: return vec_dot(F, e);
    case equation_across: return vec_cross(e, F);
    default: break;
    }
    return couple + vec_cross(vec_sub(point, look->places[equation - equation_moment].p), F);
}

double look_term(const struct suspects_look *look, const struct arrow *arrow, int equation)
{
    return look_part(look, arrow->force, arrow->point, arrow->couple, equation);
}

bool look_is_place(const struct hand_force *force)
{
    return force->part == hand_force_at_x || force->part == hand_force_at_y;
}

/* The coefficient of a letter in an equation. */
double look_coefficient(const struct suspects_look *look, const struct hand_force *force, double value,
                        int equation)
{
    const struct arrow *arrow = &look->arrows[force->arrow];
    const struct vec x = {force->sign, 0}, y = {0, force->sign}, none = {0, 0};
    switch (force->part) {
    case hand_force_x: return look_part(look, x, arrow->point, 0, equation);
    case hand_force_y: return look_part(look, y, arrow->point, 0, equation);
    case hand_force_couple: return look_part(look, none, arrow->point, force->sign, equation);
    case hand_force_size: return value != 0 ? look_term(look, arrow, equation) / value : 0;
    default: return 0;
    }
}

/* ---- the common factor of a line */

struct votes {
    double of[2 * most_letters];
    size_t by[2 * most_letters]; /* an arrow, or the inertia */
    size_t count;
};

static const size_t inertia_votes = SIZE_MAX;

/* Each arrow has one vote for a factor: a wrong one, written with both components, must not outvote the inertia. */
static void vote(struct votes *votes, size_t by, double slope, double coefficient)
{
    const double factor = slope / coefficient;
    if (slope == 0 || coefficient == 0 || !isfinite(factor)) return;
    for (size_t i = 0; i < votes->count; i++)
        if (votes->by[i] == by && fabs(votes->of[i] - factor) <= 1e-6 * fabs(factor)) return;
    votes->by[votes->count] = by;
    votes->of[votes->count++] = factor;
}

/* The most frequent factor, of equally frequent ones the first; 0 without any. */
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

/* Inertia times acceleration is on the right of an equation: minus its coefficient. */
static void vote_by_inertia(const struct suspects_look *look, const struct letter *letter, double slope,
                            int equation, struct votes *votes)
{
    const struct model_body *body = look_body(look);
    const int k = letter->slot - (int)plan_size(&look->model->plan) - hand_acceleration;
    const bool own = !letter->absolute && body->parent < 0;
    const bool alone = body->count == 1, moment = equation >= equation_moment;
    const enum absolute_kind kind = letter->absolute ? letter->absolute->kind : absolute_acceleration;
    if (letter->absolute && letter->absolute->body != look->check->body) return;
    const struct inertia inertia = body_inertia(body, &look->at);
    const bool turns = kind == absolute_alpha || (own && coordinate_is_angle(body, k));
    if (moment && turns) {
        const struct pose pose = body_pose(body, &look->at);
        const struct vec arm =
            vec_sub(point_motion(body, &pose, inertia.G).p, look->places[equation - equation_moment].p);
        vote(votes, inertia_votes, slope, -(inertia.I_G + inertia.mass * vec_dot(arm, arm)));
        if (vec_dot(arm, arm) > 0) vote(votes, inertia_votes, slope, -inertia.I_G);
    }
    const bool x = kind == absolute_ax || (own && !alone && k == 0);
    const bool y = kind == absolute_ay || (own && !alone && k == 1);
    const bool along = own && body->joint->path != path_none;
    if ((equation == equation_x && x) || (equation == equation_y && y) ||
        (equation == equation_along && along))
        vote(votes, inertia_votes, slope, -inertia.mass);
    const struct vec e = body_direction(body, &look->at);
    if (along && equation == equation_x && e.x != 0) vote(votes, inertia_votes, slope, -inertia.mass * e.x);
    if (along && equation == equation_y && e.y != 0) vote(votes, inertia_votes, slope, -inertia.mass * e.y);
}

static double find_factor(const struct suspects_look *look, int equation, bool arms)
{
    struct votes votes = {.count = 0};
    for (size_t n = 0; n < look->letter_count && !arms; n++)
        if (look->letters[n].kind == letter_acceleration && look->slope[n] != 0)
            vote_by_inertia(look, &look->letters[n], look->slope[n], equation, &votes);
    for (size_t n = 0; n < look->letter_count; n++) {
        double sign;
        const struct hand_force *force = look_force(look, &look->letters[n], &sign);
        if (!force || look->slope[n] == 0 || votes.count + 2 > sizeof votes.of / sizeof *votes.of) continue;
        const double value = sign * look->y[look->letters[n].slot];
        vote(&votes, force->arrow, look->slope[n], sign * look_coefficient(look, force, value, equation));
    }
    return most_votes(&votes);
}

bool look_inertia_fits(const struct suspects_look *look, int equation, double factor)
{
    struct votes votes = {.count = 0};
    for (size_t n = 0; n < look->letter_count && factor != 0; n++)
        if (look->letters[n].kind == letter_acceleration && look->slope[n] != 0)
            vote_by_inertia(look, &look->letters[n], look->slope[n], equation, &votes);
    for (size_t i = 0; i < votes.count; i++)
        if (fabs(votes.of[i] - factor) <= 1e-6 * fabs(factor)) return true;
    return votes.count == 0;
}

/* ---- evaluation */

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
    look->arrow_count = diagram_fill(model, b, &look->at, state->slots, look->arrows);
    if (first) list_names(look);
    find_places(look);
    const struct vec a = mass_center_acceleration(look_body(look), &look->at);
    look->m_a = vec_scale(body_mass(look_body(look), &look->at), a);
    look->lack = look_line(look);
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
