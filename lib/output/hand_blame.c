/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The likely mistake in a false line of a derivation.
 *
 * Each suspect (hand_suspects.h) is compared with the residual of the line at random states. The first one that explains
 * the residual at all of them is named: a wrong sign, a term that is missing, a reaction in the place of
 * another, moments about another point, a factor.
 */
#include <math.h>
#include <string.h>

#include "output/hand_suspects.h"

static const double tolerance = 1e-6; /* of the sum of the magnitudes of the terms */

struct inquiry {
    const struct hand_check *check;
    int slip;
    struct suspects_look look, other; /* at states of the model, and of variants with other parameters */
    struct arena arena;
    struct suspect *list;
    size_t count, states;
    bool *named; /* of each arrow: it is in the line */
};

static bool is(double a, double b)
{
    return fabs(a - b) <= tolerance * fabs(b);
}

/* ---- at all states */

/* True if the residual is k V at this state; k is that of the first state at which V is not small. */
static bool holds(const struct suspects_look *look, struct suspect *suspect)
{
    const double V = suspect_value(look, suspect), lack = look->lack, large = 1e-3 * look->size;
    if (!isfinite(V)) return fabs(lack) <= tolerance * look->size; /* a slack rope has no direction */
    if (isnan(suspect->k)) {
        if (fabs(V) <= large) return fabs(lack) <= 1e3 * large;
        suspect->k = lack / V;
    }
    if (fabs(V) > tolerance * look->size && suspect_shows(look, suspect)) {
        if (suspect_contradicted(look, suspect)) return false;
        suspect->seen++;
    }
    return fabs(lack - suspect->k * V) <= tolerance * (look->size + fabs(suspect->k * V));
}

static bool open_list(struct inquiry *inquiry)
{
    struct suspects_look *look = &inquiry->look;
    if (inquiry->list) return true;
    inquiry->list = suspects_list(look, &inquiry->arena, &inquiry->count);
    inquiry->named = ARENA_ARRAY(&inquiry->arena, look->arrow_count + 1, bool);
    return inquiry->list && inquiry->named;
}

static bool visit(void *context, struct fbd_state *state, const struct hand_named *named, double *y,
                  bool first)
{
    struct inquiry *inquiry = context;
    const bool own = state->model == inquiry->check->model;
    struct suspects_look *look = own ? &inquiry->look : &inquiry->other;
    const struct model_body *body = &state->model->bodies[inquiry->check->body];
    const struct hand *hand = &state->model->scene->bodies[inquiry->check->body].hands[inquiry->check->index];
    if (first) suspects_close(look);
    if ((body->friction >= 0 ? state->slip[body->friction] : 0) != inquiry->slip) return true;
    if (!suspects_look_at(look, state, named, y)) return false;
    if (hand->when && expr_eval(hand->when, state->t, y, NULL) == 0) return true;
    if (!isfinite(look->lack) || !isfinite(look->size)) return true;
    if (own && !open_list(inquiry)) return false;
    if (!inquiry->list) return true;
    for (size_t i = 0; i < look->arrow_count; i++)
        inquiry->named[i] = inquiry->named[i] || suspects_name(look, i);
    for (size_t i = 0; i < inquiry->count; i++) {
        struct suspect *suspect = &inquiry->list[i];
        if (!suspect->dead) suspect->dead = !holds(look, suspect);
    }
    inquiry->states++;
    return true;
}

/* ---- choice among the remaining ones */

static bool is_wrong_sign(const struct inquiry *inquiry, const struct suspect *s)
{
    (void)inquiry;
    return (s->kind == suspect_summand && is(s->k, -2)) || (s->kind == suspect_letter && is(s->k, 2));
}

static bool is_missing(const struct inquiry *inquiry, const struct suspect *s)
{
    return s->kind == suspect_term && is(s->k, -1) && !inquiry->named[s->which];
}

static bool is_part_missing(const struct inquiry *inquiry, const struct suspect *s)
{
    (void)inquiry;
    return (s->kind == suspect_part || s->kind == suspect_term) && is(s->k, -1);
}

static bool is_wrong_term(const struct inquiry *inquiry, const struct suspect *s)
{
    (void)inquiry;
    return (s->kind == suspect_part || s->kind == suspect_term) && is(s->k, -2);
}

static bool is_other_force(const struct inquiry *inquiry, const struct suspect *s)
{
    (void)inquiry;
    return s->kind == suspect_force && is(s->k, 1);
}

static bool is_letter(const struct hand_forces *forces, const char *name)
{
    for (size_t i = 0; i < forces->count; i++)
        if (forces->list[i].name.letter && strcmp(forces->list[i].name.name, name) == 0) return true;
    return *name == '='; /* declared */
}

/* True if both forces are denoted by letters, or both by names. */
static bool is_alike(const struct inquiry *inquiry, const struct suspect *s)
{
    if (!is_other_force(inquiry, s)) return false;
    const struct absolute *own = inquiry->look.letters[s->which].absolute;
    const struct hand_forces *forces = &inquiry->look.forces;
    return forces->list[s->other].name.letter == (!own || is_letter(forces, own->force));
}

static bool is_other_term(const struct inquiry *inquiry, const struct suspect *s)
{
    (void)inquiry;
    return s->kind == suspect_exchange && is(s->k, 1);
}

static bool is_other_point(const struct inquiry *inquiry, const struct suspect *s)
{
    (void)inquiry;
    return (s->kind == suspect_place || s->kind == suspect_inertia || s->kind == suspect_acceleration) &&
           is(s->k, 1);
}

static bool is_superfluous(const struct inquiry *inquiry, const struct suspect *s)
{
    (void)inquiry;
    return (s->kind == suspect_summand && is(s->k, -1)) || (s->kind == suspect_letter && is(s->k, 1));
}

static bool is_factor(const struct inquiry *inquiry, const struct suspect *s)
{
    (void)inquiry;
    return s->kind == suspect_summand || s->kind == suspect_letter;
}

static bool is_factor_of_term(const struct inquiry *inquiry, const struct suspect *s)
{
    (void)inquiry;
    return s->kind == suspect_part || s->kind == suspect_term;
}

typedef bool suspect_test(const struct inquiry *inquiry, const struct suspect *suspect);

static suspect_test *const order[] = {
    is_wrong_sign, is_missing,     is_alike,       is_other_force, is_part_missing,   is_other_term,
    is_wrong_term, is_other_point, is_superfluous, is_factor,      is_factor_of_term,
};

static const struct suspect *first_suspect(const struct inquiry *inquiry)
{
    enum { least = 3 };
    for (size_t k = 0; k < sizeof order / sizeof *order; k++)
        for (size_t i = 0; i < inquiry->count; i++) {
            const struct suspect *suspect = &inquiry->list[i];
            if (suspect->dead || suspect->seen < least || isnan(suspect->k) || is(suspect->k, 0)) continue;
            if (order[k](inquiry, suspect)) return suspect;
        }
    return NULL;
}

/* ---- the message */

static const char *point_name(const struct body *body, const struct point *point)
{
    if (point->kind == point_G) return "G";
    for (size_t i = 0; i < body->point_count; i++)
        if (body->points[i].where.x == point->where.x && body->points[i].where.y == point->where.y)
            return body->points[i].name;
    return "O";
}

/* Print R_2_x as R_2x, and a declared symbol, =T, as T. */
static void write_force(const char *name, bool letter, struct text *text)
{
    const char *first = strchr(name, '_'), *last = strrchr(name, '_');
    if (*name == '=' || !letter || first == last) {
        text_add(text, name + (*name == '='));
    } else {
        text_add_bytes(text, name, (size_t)(last - name));
        text_add(text, last + 1);
    }
}

static void add_absolute(const struct suspects_look *look, const struct absolute *absolute, struct text *text)
{
    const struct fbd_model *model = look->model;
    const struct body *body = &model->scene->bodies[absolute->body];
    const char *point = point_name(body, &absolute->point);
    switch (absolute->kind) {
    case absolute_force: write_force(absolute->force, is_letter(&look->forces, absolute->force), text); break;
    case absolute_inertia: text_printf(text, "I_%s", point); break;
    case absolute_ax: text_printf(text, "%s.a_x", point); break;
    case absolute_ay: text_printf(text, "%s.a_y", point); break;
    case absolute_acceleration:
        text_add(text, model->scene->coordinates[body->first + absolute->part].acceleration_name);
        break;
    default: text_add(text, "angle_ddot"); break;
    }
}

static void add_letter(const struct inquiry *inquiry, size_t n, struct text *text)
{
    static const char *const slots[hand_slots] = {[hand_I_G] = "I_G", [hand_I_O] = "I_O", [hand_N] = "N"};
    const struct suspects_look *look = &inquiry->look;
    const struct letter *letter = &look->letters[n];
    const struct absolute *absolute = letter->absolute;
    const struct fbd_model *model = look->model;
    const int slot = letter->slot - (int)plan_size(&model->plan);
    const struct model_body *body = &model->bodies[inquiry->check->body];
    if (!absolute && slot < hand_mass) {
        text_add(text, model->scene->coordinates[body->first + slot].acceleration_name);
    } else if (!absolute) {
        text_add(text, slots[slot]);
    } else {
        if (absolute->body != inquiry->check->body)
            text_printf(text, "%s.", model->bodies[absolute->body].name);
        add_absolute(look, absolute, text);
    }
}

static void say_factor(double s, struct text *text)
{
    if (is(s, 2) || is(s, 0.5))
        text_printf(text, " is off by a factor 2: the equation has %s of it\n", s > 1 ? "twice" : "half");
    else
        text_printf(text, " has the factor %.6g instead of 1\n", s);
}

/* For a summand the factor that corrects the line is the inverse. */
static void say_summand(const struct inquiry *inquiry, const struct suspect *s, struct text *text)
{
    text_add(text, "  the summand `");
    text_shown(text, inquiry->look.hand->summands[s->which].text);
    if (is(s->k, -2))
        text_add(text, "` has the wrong sign\n");
    else if (is(s->k, -1))
        text_add(text, "` is one too many\n");
    else
        text_printf(text, "` is right with the factor %.6g\n", 1 + s->k);
}

static void say_letter(const struct inquiry *inquiry, const struct suspect *s, struct text *text)
{
    text_add(text, "  `");
    add_letter(inquiry, s->which, text);
    text_add(text, "`");
    if (is(s->k, 2))
        text_add(text, " has the wrong sign\n");
    else if (is(s->k, 1))
        text_add(text, " is one too many\n");
    else
        say_factor(1 / (1 - s->k), text);
}

static void say_force(const struct inquiry *inquiry, const struct suspect *s, struct text *text)
{
    const struct force_name *other = &inquiry->look.forces.list[s->other].name;
    text_add(text, "  wrong reaction: `");
    add_letter(inquiry, s->which, text);
    text_add(text, "` stands where `");
    write_force(other->name, other->letter, text);
    text_add(text, "` belongs\n");
}

static void say_point(const struct inquiry *inquiry, const struct suspect *s, struct text *text)
{
    const struct place_of *places = inquiry->look.places;
    if (s->kind == suspect_place && inquiry->look.about && s->which == 0) {
        text_printf(text, "  wrong point: the inertia is that about `%s`, not about `%s`\n",
                    places[s->other].name, places[0].name);
    } else if (s->kind == suspect_place && inquiry->look.about) {
        text_printf(text, "  wrong point: the arms are those about `%s`, not about `%s`\n",
                    places[s->which].name, places[0].name);
    } else if (s->kind == suspect_place) {
        text_printf(text, "  wrong point: the arms are those about `%s`, the inertia is that about `%s`\n",
                    places[s->which].name, places[s->other].name);
    } else {
        text_add(text, "  wrong point: `");
        add_letter(inquiry, s->which, text);
        text_printf(text,
                    s->kind == suspect_inertia ? "` stands where `I_%s` belongs\n"
                                               : "` stands where that of `%s` belongs\n",
                    places[s->other].name);
    }
}

static void say_term(const struct inquiry *inquiry, const struct suspect *s, struct text *text)
{
    static const char *const along[] = {"component along x", "component along y",
                                        "component along the motion", "component across the motion"};
    const struct suspects_look *look = &inquiry->look;
    const bool moment = s->equation >= equation_moment;
    text_printf(text,
                s->kind == suspect_exchange ? "  wrong reaction: the %s of `%s%s`" : "  the %s of `%s%s`",
                moment ? "moment" : along[s->equation], look->arrows[s->which].name,
                s->kind == suspect_part ? (s->upright ? ".y" : ".x") : "");
    if (moment) text_printf(text, " about `%s`", look->places[s->equation - equation_moment].name);
    if (s->kind == suspect_exchange) {
        text_printf(text, " stands where that of `%s` belongs\n", look->arrows[s->other].name);
        return;
    }
    if (is(s->k, -1))
        text_add(text, " is missing\n");
    else if (is(s->k, -2))
        text_add(text, " has the wrong sign\n");
    else
        say_factor(1 + s->k, text);
}

static void say(const struct inquiry *inquiry, const struct suspect *s, struct text *text)
{
    switch (s->kind) {
    case suspect_summand: say_summand(inquiry, s, text); break;
    case suspect_letter: say_letter(inquiry, s, text); break;
    case suspect_force: say_force(inquiry, s, text); break;
    case suspect_inertia:
    case suspect_acceleration:
    case suspect_place: say_point(inquiry, s, text); break;
    case suspect_term:
    case suspect_exchange:
    case suspect_part: say_term(inquiry, s, text); break;
    }
}

bool hand_blame(const struct hand_check *check, int slip, struct text *text)
{
    struct inquiry inquiry = {.check = check,
                              .slip = slip,
                              .look = {.check = check},
                              .other = {.check = check}};
    gsl_rng *rng = gsl_rng_clone(check->rng); /* later draws stay the same */
    bool done = rng && hand_each_state(check, rng, visit, &inquiry);
    const struct suspect *found = done && inquiry.list ? first_suspect(&inquiry) : NULL;
    if (found) say(&inquiry, found, text);
    if (!done) text->failed = true;
    gsl_rng_free(rng);
    arena_free(&inquiry.arena);
    suspects_close(&inquiry.look);
    suspects_close(&inquiry.other);
    return found != NULL;
}
