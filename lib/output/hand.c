/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/hand.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "base/diag.h"
#include "dynamics/diagram.h"
#include "dynamics/mass.h"
#include "fbd_grade.h"
#include "output/hand_forces.h"
#include "output/random_state.h"

/* True if a sample agrees to rounding: 1e-9 of the sum of magnitudes. */
static bool agrees(const struct hand_sample *sample)
{
    return fabs(sample->lack) <= 1e-9 * sample->size && isfinite(sample->size);
}

/* ---- one equation at one state */

/* The slope of left - right with respect to each acceleration; the nonzero one determines the coordinate. */
static int accelerated_part(const struct hand *hand, int size, int count, double t, const double *y,
                            double *slope)
{
    int part = -1;
    for (int k = 0; k < count; k++) {
        double left, right;
        int slot = 1 + size + hand_acceleration + k;
        expr_eval_slot(hand->left, t, y, slot, NULL, &left);
        expr_eval_slot(hand->right, t, y, slot, NULL, &right);
        if (left - right == 0) continue;
        if (part >= 0) return -1; /* several accelerations: compare the two sides */
        part = k;
        *slope = left - right;
    }
    return part;
}

/* The term of gravity with sine and cosine exchanged. */
static double swapped_gravity(const struct model_body *body, const struct fbd_state *state)
{
    struct instant at = state_instant(state);
    double weight = body_mass(body, &at) * vec_norm(state->model->scene->gravity);
    if (body->joint->path == path_line) return -weight * body->e.x;
    return body->joint->has_axis ? -weight * body->L * cos(state->y[body->first]) : 0;
}

static void take_factors(const struct model_body *body, const struct fbd_state *state, double *factors)
{
    const struct scene *scene = state->model->scene;
    const bool line = body->joint->path == path_line;
    struct instant at = state_instant(state);
    const int k = body->joint->angle, angle = k < 0 ? k : body->first + k;
    double q = state->y[body->first], v = state->y[body->first_rate];
    factors[factor_cos_angle] = angle >= 0 ? cos(state->y[angle]) : NAN;
    factors[factor_sin_angle] = angle >= 0 ? sin(state->y[angle]) : NAN;
    factors[factor_cos_along] = line ? body->e.x : NAN;
    factors[factor_sin_along] = line ? body->e.y : NAN;
    factors[factor_L] = body->joint->has_axis ? body->L : NAN;
    factors[factor_m] = body_mass(body, &at);
    factors[factor_g] = vec_norm(scene->gravity);
    factors[factor_sign] = body->count == 1 ? copysign(1, v) : NAN;
    factors[factor_rate] = body->count == 1 ? v : NAN;
    factors[factor_coordinate] = body->count == 1 ? q : NAN;
}

/* The equation's summands as forces on the coordinate, with the scale of the whole equation. */
static void take_summands(struct hand_check *check, const struct hand *hand, double t, const double *y,
                          double scale, struct hand_sample *sample)
{
    int slot = 1 + (int)plan_size(&check->model->plan) + hand_acceleration + check->part;
    for (size_t j = 0; j < hand->summand_count; j++) {
        const struct hand_summand *summand = &hand->summands[j];
        double slope = 0;
        sample->summands[j] = scale * summand->sign * expr_eval(summand->expr, t, y, NULL);
        if (check->part >= 0) expr_eval_slot(summand->expr, t, y, slot, NULL, &slope);
        check->accelerates[j] = slope != 0;
    }
}

/* The names that the equation depends on: bit k for hand slot k, hand_others for accelerations of other
 * bodies. An identity depends on none. *size grows by their contributions to a side. */
static unsigned depends_on(const struct hand *hand, const struct fbd_state *state, int b,
                           const struct hand_named *named, const double *y, double *size)
{
    const struct fbd_model *model = state->model;
    const double t = state->t;
    int first = 1 + (int)plan_size(&model->plan);
    unsigned says = 0;
    for (int k = 0; k < hand_slots + (int)model->absolute_count; k++) {
        double left, right;
        enum absolute_kind kind =
            k < hand_slots ? absolute_acceleration : model->absolutes[k - hand_slots].kind;
        if (!hand_writes(kind) || kind == absolute_inertia) continue;
        expr_eval_slot(hand->left, t, y, first + k, NULL, &left);
        expr_eval_slot(hand->right, t, y, first + k, NULL, &right);
        *size += fabs((left - right) * y[first + k - 1]);
        if (left - right != 0)
            *size += fabs(left - right) *
                     (k >= hand_slots ? named->sizes[k - hand_slots] : hand_slot_size(state, b, k, named));
        if (fabs(left - right) > 1e-9 * (fabs(left) + fabs(right)))
            says |= k < hand_slots                                       ? 1U << k
                    : kind == absolute_force || kind == absolute_section ? (unsigned)hand_named_forces
                                                                         : (unsigned)hand_others;
    }
    return says;
}

static void take_sample(struct hand_check *check, const struct hand *hand, const struct hand_named *named,
                        struct fbd_state *state, double *y)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[check->body];
    struct arrow arrows[most_terms + 1];
    struct instant at = state_instant(state);
    diagram_fill(model, check->body, &at, state->slots, arrows);
    hand_extend(state, check->body, named, y);
    if (hand->when && expr_eval(hand->when, state->t, y, NULL) == 0) return;
    struct hand_sample sample = {.t = state->t,
                                 .slip = body->friction >= 0 ? state->slip[body->friction] : 0};
    sample.left = expr_eval(hand->left, state->t, y, NULL);
    sample.right = expr_eval(hand->right, state->t, y, NULL);
    if (!isfinite(sample.left) || !isfinite(sample.right)) return;
    double added = 0;
    const unsigned says = depends_on(hand, state, check->body, named, y, &added);
    check->says |= says;
    double form[hand_unknowns];
    hand_form_at(state, check->body, check->index, named, y, form);
    for (int k = 0; k < hand_unknowns; k++) check->unknowns |= form[k] != 0 ? 1ULL << k : 0;
    double slope = 0, scale = 1;
    /* Several unknowns in one equation: compare the two sides. */
    bool jointed = !body->alone || (says & ((unsigned)hand_named_forces | (unsigned)hand_others)) != 0;
    int part =
        jointed ? -1 : accelerated_part(hand, (int)plan_size(&model->plan), body->count, state->t, y, &slope);
    check->part = part;
    if (part >= 0) {
        sample.coefficient = slope;
        sample.I = coordinate_inertia_at(body, part, &at);
        sample.a = state->a[body->first + part];
        sample.a_hand = sample.a - (sample.left - sample.right) / slope;
        scale = sample.I / slope;
    }
    /* Almost no inertia: compare the two sides, since the scaled ones overflow. */
    if (!isfinite(scale * (fabs(sample.left) + fabs(sample.right)))) scale = 1;
    sample.lack = scale * (sample.left - sample.right);
    sample.size = fabs(scale) * (fabs(sample.left) + fabs(sample.right)) + DBL_MIN;
    for (size_t j = 0; jointed && j < hand->summand_count; j++)
        sample.size += fabs(expr_eval(hand->summands[j].expr, state->t, y, NULL));
    for (int i = 0; !jointed && i < body->load_count; i++) {
        sample.terms[i] = arrows[i].share[part < 0 ? 0 : part];
        sample.size += fabs(sample.terms[i]);
    }
    if (jointed) sample.size += added;
    sample.mechanics = part >= 0 ? fabs(sample.I * sample.a) : sample.size;
    for (int i = 0; part >= 0 && i < body->load_count; i++) sample.mechanics += fabs(sample.terms[i]);
    take_summands(check, hand, state->t, y, scale, &sample);
    take_factors(body, state, sample.factors);
    sample.I_G = body_inertia(body, &at).I_G;
    sample.L = body->L;
    sample.m_L2 = body_mass(body, &at) * body->L * body->L;
    sample.gravity_swapped = swapped_gravity(body, state);
    for (int k = 0; k < body->count; k++) {
        sample.q[k] = state->y[body->first + k];
        sample.v[k] = state->y[body->first_rate + k];
    }
    const unsigned of_forces = (unsigned)hand_named_forces | 1U << hand_N;
    sample.open =
        (check->says & of_forces) != 0 && hand_is_open(check, hand, named, state, sample.size / fabs(scale));
    check->samples[check->count++] = sample;
}

double hand_lack_at(const struct fbd_state *state, int b, int index, double *size, double *form)
{
    const struct fbd_model *model = state->model;
    const struct hand *hand = &model->scene->bodies[b].hands[index];
    double *y = calloc(hand_room(model), sizeof *y), lack = NAN;
    struct arena arena = {0};
    struct hand_named named;
    *size = 0;
    if (y && hand_named_find(model, &arena, &named)) {
        hand_extend(state, b, &named, y);
        if (form) hand_form_at(state, b, index, &named, y, form);
        lack = expr_eval(hand->left, state->t, y, NULL) - expr_eval(hand->right, state->t, y, NULL);
        for (size_t j = 0; j < hand->summand_count; j++)
            *size += fabs(expr_eval(hand->summands[j].expr, state->t, y, NULL));
    }
    free(y);
    arena_free(&arena);
    return lack;
}

static bool visit_sample(void *context, struct fbd_state *state, const struct hand_named *named, double *y,
                         bool first)
{
    (void)first;
    struct hand_check *check = context;
    const struct hand *hand = &state->model->scene->bodies[check->body].hands[check->index];
    if (check->count < most_samples) take_sample(check, hand, named, state, y);
    return true;
}

/* ---- the verdict */

struct tally {
    size_t states, agree;
    double worst;
};

static struct tally tally_of(const struct hand_check *check, int slip)
{
    struct tally tally = {0};
    for (size_t i = 0; i < check->count; i++) {
        const struct hand_sample *sample = &check->samples[i];
        if (sample->slip != slip) continue;
        tally.states++;
        tally.agree += agrees(sample);
        tally.worst = fmax(tally.worst, fabs(sample->lack) / sample->size);
    }
    return tally;
}

/* A line about forces that the equations do not determine. */
static bool write_open(const struct hand_check *check, struct text *text)
{
    size_t open = 0;
    for (size_t i = 0; i < check->count; i++) open += check->samples[i].open;
    if (open == 0) return false;
    const char *force = check->open_force[0] ? check->open_force : "N";
    const bool other = check->open_force[0] && check->open_body != check->body;
    text_printf(
        text,
        "  not unique at %zu of %zu random states: the equations do not determine `%s%s%s`, only sums "
        "of it with others\n",
        open, check->count, other ? check->model->bodies[check->open_body].name : "", other ? "." : "",
        force + (*force == '='));
    return true;
}

/* The sense in which the friction of the body slips at the start. */
static int slip_at_start(const struct hand_check *check)
{
    const int friction = check->model->bodies[check->body].friction;
    struct fbd_state *start = friction >= 0 ? state_new(check->model) : NULL;
    const int slip = start && modes_settle(start, NULL) ? start->slip[friction] : 0;
    state_free(start);
    return slip;
}

static bool write_verdict(const struct hand_check *check, struct text *text)
{
    struct tally none = tally_of(check, 0), plus = tally_of(check, 1), minus = tally_of(check, -1);
    size_t states = none.states + plus.states + minus.states, agree = none.agree + plus.agree + minus.agree;
    double worst = fmax(none.worst, fmax(plus.worst, minus.worst));
    if (states == 0) {
        text_add(text, "  not checked: no admissible state was found for its condition\n");
        return false;
    }
    if (write_open(check, text)) return false;
    if (check->elsewhere[0]) {
        hand_diagnose(check, 0, text);
        return false;
    }
    if (agree == states) {
        text_printf(text, "  agrees at %zu random states (worst difference %.1e of the terms)\n", states,
                    worst);
        hand_say_zeros(check, text);
        return true;
    }
    /* With friction an equation without `when` may hold for one direction of motion, that of the start if it
     * slips there. */
    const bool any = !check->model->scene->bodies[check->body].hands[check->index].when;
    const int start = any ? slip_at_start(check) : 0;
    for (int slip = 1; slip >= -1 && any; slip -= 2) {
        struct tally one = slip > 0 ? plus : minus;
        if (slip == -start || one.states == 0 || one.agree != one.states || none.states > 0) continue;
        text_printf(
            text,
            "  agrees at %zu random states that slip toward %cx (worst difference %.1e of the terms);\n"
            "  toward %cx friction has the other sign: write sign(v) for both, or say `when: v %c 0`\n",
            one.states, slip > 0 ? '+' : '-', one.worst, slip > 0 ? '-' : '+', slip > 0 ? '>' : '<');
        return true;
    }
    text_printf(text, "  differs at %zu of %zu random states\n", states - agree, states);
    hand_diagnose(check, none.agree < none.states ? 0 : plus.agree < plus.states ? 1 : -1, text);
    return false;
}

bool hand_take_samples(struct hand_check *check, const struct document *document, gsl_rng *rng, double spread)
{
    check->count = 0;
    check->part = -1;
    check->says = 0;
    check->unknowns = 0;
    check->open_force[0] = '\0';
    check->no_memory = false;
    check->document = *document;
    check->spread = spread;
    check->rng = rng;
    check->elsewhere[0] = '\0';
    if (!hand_each_state(check, rng, visit_sample, check) || check->no_memory) return false;
    bool any = false;
    for (size_t i = 0; i < check->count; i++) any = any || agrees(&check->samples[i]);
    return !any || hand_find_point(check);
}

/* Judge a line about a run; the run is made for the first of them. */
static int judge_by_run(struct hand_check *check, const struct hand *hand, struct text *text)
{
    if (!check->run.model) {
        fbd_errors *errors = fbd_errors_new();
        bool made = errors && hand_run_make(&check->run, check->model, errors);
        const fbd_error *error = errors ? diag_get(errors, 0) : NULL;
        if (error) text_printf(text, "  not checked: %s\n", error->message);
        bool out = !errors || errors->out_of_memory;
        fbd_errors_free(errors);
        if (!made) {
            hand_run_free(&check->run);
            return out ? -1 : 1;
        }
    }
    bool holds = hand_run_judge(&check->run, check->body, hand, text);
    return check->run.no_memory ? -1 : !holds;
}

/* Check one equation; 1 differs, 0 agrees, -1 out of memory. */
static int check_one(struct hand_check *check, const struct document *document, gsl_rng *rng,
                     struct text *text)
{
    const struct fbd_model *model = check->model;
    const struct body *body = &model->scene->bodies[check->body];
    const struct hand *hand = &body->hands[check->index];
    text_printf(text, "%s: %s", body->name, hand->kind == hand_conserved ? "conserved: " : "");
    text_shown(text, hand->written);
    text_add(text, "\n");
    if (strcmp(hand->text, hand->written) != 0) text_printf(text, "  read as: %s\n", hand->text);
    if (hand->kind != hand_of_states) return judge_by_run(check, hand, text);
    if (diagram_arrows(model, check->body) > most_terms) {
        text_printf(text, "  not checked: more than %d forces\n", most_terms);
        return 1;
    }
    if (!hand_take_samples(check, document, rng, 0.3)) return -1;
    return write_verdict(check, text) ? 0 : 1;
}

/* Check all equations of check->model; returns the number that differ, -1 out of memory. */
static int check_all(struct hand_check *check, const struct document *document, gsl_rng *rng,
                     struct text *text)
{
    int differ = 0, checked = 0;
    for (size_t b = 0; b < check->model->body_count; b++)
        for (size_t i = 0; differ >= 0 && i < check->model->scene->bodies[b].hand_count; i++, checked++) {
            check->body = (int)b;
            check->index = (int)i;
            int one = check_one(check, document, rng, text);
            differ = one < 0 ? -1 : differ + one;
        }
    if (checked == 0) text_add(text, "no body carries a `hand:` derivation\n");
    return differ;
}

bool hand_check_document(const struct fbd_model *model, struct document *document, unsigned seed,
                         struct text *text, size_t *differing)
{
    struct arena arena = {0};
    struct hand_check check = {.samples = calloc(most_samples, sizeof *check.samples)};
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    fbd_model *split = NULL;
    int differ = -1;
    document->split_hands = true;
    if (check.samples && rng && hand_forces_list(model, &arena, document)) {
        gsl_rng_set(rng, seed);
        if (random_model(document, model, rng, 0, &split)) {
            check.model = split ? split : model;
            differ = check_all(&check, document, rng, text);
        }
        text_printf(text, "seed %u\n", seed);
    }
    hand_run_free(&check.run);
    model_free(split);
    free(check.samples);
    if (rng) gsl_rng_free(rng);
    arena_free(&arena);
    document->force_names = NULL;
    if (differ >= 0) *differing = (size_t)differ;
    return differ >= 0 && !text->failed;
}

/* The file of a model, or the document that it was made of. */
static bool open_model(struct document *document, const fbd_model *model, fbd_errors *errors)
{
    if (!model->root)
        return document_open(document, model->source, model->source_length, model->scene->file, errors);
    *document = (struct document){.file = model->scene->file, .root = model->root};
    return true;
}

char *fbd_check_hand(const fbd_model *model, unsigned seed, size_t *differing)
{
    size_t differ = 0;
    if (differing) *differing = 0;
    if (!model) return NULL;
    struct text text = {0};
    struct document document;
    fbd_errors *errors = fbd_errors_new();
    bool done = false;
    if (errors) {
        done = open_model(&document, model, errors);
        document.like = model->scene;
        done = done && !errors->out_of_memory && hand_check_document(model, &document, seed, &text, &differ);
        document_close(&document);
    }
    fbd_errors_free(errors);
    if (!done) text_free(&text);
    if (differing && done) *differing = differ;
    return text.data;
}
