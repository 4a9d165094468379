/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Compare a hand equation with the assembly summand by summand.
 *
 * Scaled to forces, the summands c_j of a right equation are the terms T_i of the assembly, each of them or
 * sums of a few. So those that are equal at every sample are paired, then a summand with two terms and a term
 * with two summands; the remaining ones on both sides are the error. If that is one summand for one term,
 * their ratio may show a missing or additional factor.
 */
#include "output/hand.h"

struct match {
    const struct hand_check *check;
    int slip;
    const struct hand *hand;
    size_t terms, summands;
    bool term_paired[most_terms], summand_paired[most_summands];
};

static double term(const struct hand_sample *sample, size_t i)
{
    return sample->terms[i];
}

static double summand(const struct hand_sample *sample, size_t j)
{
    return sample->summands[j];
}

typedef double part(const struct hand_sample *sample, size_t index);

enum { nothing = -1 };

/* True if one element of `a` equals one or two of `b` at every sample. */
static bool equal(const struct match *match, part *a, size_t i, part *b, size_t j, int k)
{
    for (size_t s = 0; s < match->check->count; s++) {
        const struct hand_sample *sample = &match->check->samples[s];
        if (sample->slip != match->slip) continue;
        double other = b(sample, j) + (k == nothing ? 0 : b(sample, (size_t)k));
        if (!(fabs(a(sample, i) - other) <= 1e-9 * sample->size)) return false;
    }
    return true;
}

/* True if it is zero at every sample, as a force across the motion, or an acceleration without influence. */
static bool vanishes(const struct match *match, part *a, size_t i)
{
    for (size_t s = 0; s < match->check->count; s++) {
        const struct hand_sample *sample = &match->check->samples[s];
        if (sample->slip == match->slip && fabs(a(sample, i)) > 1e-12 * sample->size) return false;
    }
    return true;
}

/* ---- pairing */

static void pair_single(struct match *match)
{
    for (size_t i = 0; i < match->terms; i++)
        for (size_t j = 0; j < match->summands && !match->term_paired[i]; j++) {
            if (match->summand_paired[j] || !equal(match, term, i, summand, j, nothing)) continue;
            match->term_paired[i] = match->summand_paired[j] = true;
        }
}

/* Pair one `a` with two `b` that are not paired yet. */
static void pair_two(struct match *match, part *a, bool *a_paired, size_t a_count, part *b, bool *b_paired,
                     size_t b_count)
{
    for (size_t i = 0; i < a_count; i++)
        for (size_t j = 0; j < b_count; j++)
            for (size_t k = j + 1; k < b_count; k++) {
                if (a_paired[i] || b_paired[j] || b_paired[k]) continue;
                if (!equal(match, a, i, b, j, (int)k)) continue;
                a_paired[i] = b_paired[j] = b_paired[k] = true;
            }
}

static void pair(struct match *match)
{
    for (size_t i = 0; i < match->terms; i++) match->term_paired[i] = vanishes(match, term, i);
    for (size_t j = 0; j < match->summands; j++)
        match->summand_paired[j] = match->check->accelerates[j] || vanishes(match, summand, j);
    pair_single(match);
    pair_two(match, summand, match->summand_paired, match->summands, term, match->term_paired, match->terms);
    pair_two(match, term, match->term_paired, match->terms, summand, match->summand_paired, match->summands);
}

static size_t left_over(const bool *paired, size_t count)
{
    size_t left = 0;
    for (size_t i = 0; i < count; i++) left += !paired[i];
    return left;
}

/* ---- one summand for one term */

static const char *const factor_names[hand_factors] = {
    [factor_cos_angle] = "cos(theta)",
    [factor_sin_angle] = "sin(theta)",
    [factor_cos_along] = "cos(along)",
    [factor_sin_along] = "sin(along)",
    [factor_L] = "L",
    [factor_m] = "m",
    [factor_g] = "g",
    [factor_sign] = "the sign of v",
    [factor_rate] = "v",
    [factor_coordinate] = "q",
};

/* The change of a summand c into a term T: T = k c missing / extra, with the factors' indices. */
struct relation {
    int missing, extra; /* enum hand_factor, or `nothing` */
    double k;           /* 0 when there is no such relation */
};

static double factor_at(const struct hand_sample *sample, int factor)
{
    return factor == nothing ? 1 : sample->factors[factor];
}

/* The constant of a relation, 0 if the ratio is not constant. */
static double constant_of(const struct match *match, size_t i, size_t j, int missing, int extra)
{
    double first = 0;
    for (size_t s = 0; s < match->check->count; s++) {
        const struct hand_sample *sample = &match->check->samples[s];
        if (sample->slip != match->slip) continue;
        double top = sample->terms[i] * factor_at(sample, extra);
        double bottom = sample->summands[j] * factor_at(sample, missing);
        if (fabs(bottom) < 1e-6 * sample->size && fabs(top) < 1e-6 * sample->size) continue;
        double k = top / bottom;
        if (first == 0) first = k;
        if (!isfinite(k) || k == 0 || fabs(k - first) > 1e-7 * fabs(first)) return 0;
    }
    return first;
}

/* The simplest relation: a constant, one factor missing or additional, one replaced by another; preferably
 * without a constant. */
static struct relation relate(const struct match *match, size_t i, size_t j)
{
    struct relation best = {nothing, nothing, constant_of(match, i, j, nothing, nothing)};
    for (int factors = 1; factors <= 2 && best.k == 0; factors++)
        for (int missing = nothing; missing < hand_factors; missing++)
            for (int extra = nothing; extra < hand_factors; extra++) {
                if ((missing != nothing) + (extra != nothing) != factors || missing == extra) continue;
                double k = constant_of(match, i, j, missing, extra);
                bool better = best.k == 0 || fabs(fabs(k) - 1) < fabs(fabs(best.k) - 1);
                if (k != 0 && better) best = (struct relation){missing, extra, k};
            }
    return best;
}

static const char *factor_name(const struct match *match, int factor)
{
    const struct fbd_model *model = match->check->model;
    const struct model_body *body = &model->bodies[match->check->body];
    const struct coordinate *c = &model->scene->coordinates[body->first];
    if (factor == factor_rate) return c->rate_name;
    return factor == factor_coordinate ? c->name : factor_names[factor];
}

static const char *sign_of(const struct match *match, size_t j)
{
    return match->hand->summands[j].sign < 0 ? "-" : "";
}

static void say_relation(const struct match *match, const struct relation *relation, struct text *text)
{
    double k = relation->k;
    if (k == 0) return;
    const char *missing = relation->missing == nothing ? NULL : factor_name(match, relation->missing);
    const char *extra = relation->extra == nothing ? NULL : factor_name(match, relation->extra);
    bool unit = fabs(fabs(k) - 1) < 1e-6, wrong_sign = k < 0;
    text_add(text, "    ");
    if (missing && extra)
        text_printf(text, "it has %s where %s belongs", extra, missing);
    else if (missing || extra)
        text_printf(text, "the factor %s is %s", missing ? missing : extra, missing ? "missing" : "too many");
    if ((missing || extra) && (!unit || wrong_sign)) text_add(text, ", and ");
    if (!unit)
        text_printf(text, "the term is %.6g times that", k);
    else if (wrong_sign)
        text_add(text, "its sign is wrong");
    text_add(text, "\n");
}

static const char *term_name(const struct match *match, size_t i)
{
    const struct fbd_model *model = match->check->model;
    const struct model_body *body = &model->bodies[match->check->body];
    return model->loads[(size_t)body->first_load + i].source->name;
}

/* ---- unpaired terms */

static void say_pair(const struct match *match, size_t i, size_t j, struct text *text)
{
    text_printf(text, "  the term `%s` differs from that of the equation, `%s%s`\n", term_name(match, i),
                sign_of(match, j), match->hand->summands[j].text);
}

static double opposite(const struct hand_sample *sample, size_t i)
{
    return -sample->terms[i];
}

/* Classify a summand that matches no unpaired term: a duplicate of a term, the opposite of one, or a foreign
 * one. */
static const char *oddity(const struct match *match, size_t j, bool terms_left)
{
    for (size_t i = 0; i < match->terms; i++) {
        if (vanishes(match, term, i)) continue;
        if (equal(match, summand, j, term, i, nothing)) return "is counted twice";
        if (equal(match, summand, j, opposite, i, nothing)) return "cancels a term of the equation";
    }
    return terms_left ? "is no term of the assembly" : "is no force that the body lists";
}

/* Write which terms the unpaired summands were meant for, as far as a relation exists, and pair them. */
static void say_meant(struct match *match, struct text *text)
{
    for (size_t i = 0; i < match->terms; i++)
        for (size_t j = 0; j < match->summands; j++) {
            if (match->term_paired[i] || match->summand_paired[j]) continue;
            struct relation relation = relate(match, i, j);
            if (relation.k == 0) continue;
            match->term_paired[i] = match->summand_paired[j] = true;
            say_pair(match, i, j, text);
            say_relation(match, &relation, text);
        }
}

/* Write the terms and summands that are still unpaired. */
static void say_rest(const struct match *match, struct text *text)
{
    size_t terms = left_over(match->term_paired, match->terms);
    size_t summands = left_over(match->summand_paired, match->summands);
    for (size_t j = 0; j < match->summands; j++)
        if (!match->summand_paired[j])
            text_printf(text, "  `%s%s` %s\n", sign_of(match, j), match->hand->summands[j].text,
                        oddity(match, j, terms > 0));
    for (size_t i = 0; i < match->terms; i++)
        if (!match->term_paired[i])
            text_printf(text, "  the term `%s` is missing%s\n", term_name(match, i),
                        summands > 0 ? " or not as it should be" : "");
}

bool hand_match(const struct hand_check *check, int slip, struct text *text)
{
    const struct model_body *body = &check->model->bodies[check->body];
    const struct hand *hand = &check->model->scene->bodies[check->body].hands[check->index];
    if (hand->summand_count == 0) return false;
    struct match match = {.check = check,
                          .slip = slip,
                          .hand = hand,
                          .terms = (size_t)body->load_count,
                          .summands = hand->summand_count};
    pair(&match);
    if (left_over(match.term_paired, match.terms) + left_over(match.summand_paired, match.summands) == 0)
        return false;
    say_meant(&match, text);
    say_rest(&match, text);
    return true;
}
