/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Find the term in which a hand derivation differs.
 *
 * If the hand equation has the factor s on term T and is otherwise right, its error is (1 - s) T at every
 * state. So for each named term the factor is estimated by least squares, 1 - s = sum(lack T) / sum(T T), and
 * accepted if it explains every sample. The same for the inertia, by the ratio of the accelerations, which
 * distinguishes I_G from I_O.
 */
#include "output/hand.h"

/* Values of a candidate over the samples of one direction of slip. */
typedef double candidate(const struct hand_sample *sample, int index);

static double named_term(const struct hand_sample *sample, int index)
{
    return sample->terms[index];
}

static double gravity_exchange(const struct hand_sample *sample, int index)
{
    return sample->terms[index] - sample->gravity_swapped;
}

static bool same(double a, double b)
{
    return isfinite(a) && isfinite(b) && fabs(a - b) <= 1e-6 * (fabs(a) + fabs(b));
}

/* The factor for which lack = factor * candidate at every sample, if there is one. */
static bool explains(const struct hand_check *check, int slip, candidate *value, int index, double *factor)
{
    double top = 0, bottom = 0;
    for (size_t i = 0; i < check->count; i++) {
        const struct hand_sample *sample = &check->samples[i];
        if (sample->slip != slip) continue;
        double T = value(sample, index);
        top += sample->lack * T;
        bottom += T * T;
    }
    if (!(bottom > 0) || !isfinite(bottom)) return false;
    *factor = top / bottom;
    if (!isfinite(*factor)) return false; /* the sums have overflowed */
    for (size_t i = 0; i < check->count; i++) {
        const struct hand_sample *sample = &check->samples[i];
        if (sample->slip == slip &&
            !(fabs(sample->lack - *factor * value(sample, index)) <= 1e-6 * sample->size))
            return false; /* also for NAN */
    }
    return true;
}

/* True if the factor s of a term is 1/L (or L) at every sample. */
static bool arm_power(const struct hand_check *check, int slip, int index, int power)
{
    size_t seen = 0;
    for (size_t i = 0; i < check->count; i++) {
        const struct hand_sample *sample = &check->samples[i];
        if (sample->slip != slip || fabs(sample->terms[index]) < 1e-9 * sample->size) continue;
        double s = 1 - sample->lack / sample->terms[index];
        if (!(sample->L > 0) || same(sample->L, 1) || !same(s, power < 0 ? 1 / sample->L : sample->L))
            return false;
        seen++;
    }
    return seen > 0;
}

static bool inertia_is(const struct hand_check *check, int slip, int which)
{
    size_t seen = 0;
    for (size_t i = 0; i < check->count; i++) {
        const struct hand_sample *sample = &check->samples[i];
        if (sample->slip != slip || fabs(sample->I * sample->a) < 1e-9 * sample->size) continue;
        double used = sample->I * sample->a / sample->a_hand;
        if (!same(used, which == 0 ? sample->I_G : sample->m_L2)) return false;
        seen++;
    }
    return seen > 0;
}

static void say_factor(struct text *text, const char *name, double s)
{
    if (same(s, -1))
        text_printf(text, "  the term `%s` has the wrong sign\n", name);
    else if (fabs(s) < 1e-6)
        text_printf(text, "  the term `%s` is missing\n", name);
    else if (same(s, 2) || same(s, 0.5))
        text_printf(text, "  the term `%s` is off by a factor 2: the equation has %s of it\n", name,
                    s > 1 ? "twice" : "half");
    else
        text_printf(text, "  the term `%s` has the factor %.6g instead of 1\n", name, s);
}

static bool blame_inertia(const struct hand_check *check, int slip, struct text *text)
{
    if (check->part < 0) return false;
    const struct model_body *body = &check->model->bodies[check->body];
    if (body->joint->has_axis && inertia_is(check, slip, 0)) {
        text_add(text,
                 "  wrong reference point: the moment of inertia is the one about G; about the axis it is\n"
                 "  I_O = I_G + m L^2\n");
        return true;
    }
    if (body->joint->has_axis && inertia_is(check, slip, 1)) {
        text_add(
            text,
            "  the moment of inertia is that of a point mass, m L^2; I_O = I_G + m L^2 has I_G as well\n");
        return true;
    }
    double first = 0;
    for (size_t i = 0; i < check->count; i++) {
        const struct hand_sample *sample = &check->samples[i];
        if (sample->slip != slip || fabs(sample->I * sample->a) < 1e-9 * sample->size) continue;
        double ratio = sample->a / sample->a_hand;
        if (first == 0) first = ratio;
        if (!isfinite(ratio) || !same(ratio, first)) return false;
    }
    if (first == 0 || same(first, 1)) return false;
    text_printf(text, "  the inertia is %.6g times the assembled one (all terms agree among each other)\n",
                first);
    return true;
}

static bool blame_term(const struct hand_check *check, int slip, struct text *text)
{
    const struct model_body *body = &check->model->bodies[check->body];
    for (int i = 0; i < body->load_count; i++) {
        const struct load *load = check->model->loads[body->first_load + i].source;
        double factor;
        if (body->joint->has_axis && arm_power(check, slip, i, -1)) {
            text_printf(text, "  the moment arm is missing: the term `%s` is a force, without L\n",
                        load->name);
            return true;
        }
        if (body->joint->has_axis && arm_power(check, slip, i, 1)) {
            text_printf(text, "  the term `%s` has the moment arm L once too often\n", load->name);
            return true;
        }
        if (load->kind == load_gravity && explains(check, slip, gravity_exchange, i, &factor) &&
            same(factor, 1)) {
            text_printf(text, "  sine and cosine are exchanged in the term `%s`\n", load->name);
            return true;
        }
        if (explains(check, slip, named_term, i, &factor)) {
            say_factor(text, load->name, 1 - factor);
            return true;
        }
    }
    return false;
}

static const struct hand_sample *worst_sample(const struct hand_check *check, int slip)
{
    const struct hand_sample *worst = NULL;
    for (size_t i = 0; i < check->count; i++) {
        const struct hand_sample *sample = &check->samples[i];
        if (sample->slip != slip) continue;
        if (!worst || fabs(sample->lack) > fabs(worst->lack)) worst = sample;
    }
    return worst;
}

/* Write the terms of the assembly along the coordinate of an eliminated line. */
static void show_terms(const struct hand_check *check, const struct hand_sample *sample, struct text *text)
{
    const struct model_body *body = &check->model->bodies[check->body];
    text_add(text, "  assembled there:");
    for (int i = 0; i < body->load_count; i++)
        text_printf(text, "%s %s %.9g", i > 0 ? "," : "",
                    check->model->loads[body->first_load + i].source->name, sample->terms[i]);
    text_add(text, "\n");
}

/* Write the values of the summands of any other line. */
static void show_summands(const struct hand_check *check, const struct hand_sample *sample, struct text *text)
{
    const struct hand *hand = &check->model->scene->bodies[check->body].hands[check->index];
    if (hand->summand_count == 0) return;
    text_add(text, "  its summands there:");
    for (size_t j = 0; j < hand->summand_count; j++) {
        text_add(text, j > 0 ? ", `" : " `");
        text_shown(text, hand->summands[j].text);
        text_printf(text, "` %.9g", hand->summands[j].sign * sample->summands[j]);
    }
    text_add(text, "\n");
}

/* Write the state of the largest error, with all terms: enough to find the error by hand. */
static void show_worst(const struct hand_check *check, int slip, struct text *text)
{
    const struct hand_sample *worst = worst_sample(check, slip);
    if (!worst) return;
    const struct fbd_model *model = check->model;
    const struct model_body *body = &model->bodies[check->body];
    text_printf(text, "  at t = %.6g", worst->t);
    for (int k = 0; k < body->count; k++) {
        const struct coordinate *c = &model->scene->coordinates[body->first + k];
        text_printf(text, ", %s = %.6g, %s = %.6g", c->name, worst->q[k], c->rate_name, worst->v[k]);
    }
    text_printf(text, ": left %.9g, right %.9g\n", worst->left, worst->right);
    if (check->part >= 0)
        show_terms(check, worst, text);
    else
        show_summands(check, worst, text);
}

/* With one term on the right, a wrong factor there and a wrong inertia are indistinguishable. An equation
 * whose left side has exactly the inertia of the assembly has its error elsewhere. */
static bool inertia_is_right(const struct hand_check *check, int slip)
{
    for (size_t i = 0; i < check->count; i++) {
        const struct hand_sample *sample = &check->samples[i];
        if (sample->slip == slip && !same(sample->coefficient, sample->I)) return false;
    }
    return true;
}

static bool is_zero_throughout(const struct hand_check *check, size_t summand)
{
    const double rounding = 1e-12;
    for (size_t i = 0; i < check->count; i++)
        if (fabs(check->samples[i].summands[summand]) > rounding * check->samples[i].size) return false;
    return true;
}

void hand_say_zeros(const struct hand_check *check, struct text *text)
{
    const struct hand *hand = &check->model->scene->bodies[check->body].hands[check->index];
    size_t list[most_summands], count = 0;
    for (size_t j = 0; j < hand->summand_count; j++)
        if (!expr_is_constant(hand->summands[j].expr) && is_zero_throughout(check, j)) list[count++] = j;
    if (count < 2) return;
    text_add(text, "  the states tell nothing of the factors and signs of `");
    for (size_t j = 0; j < count; j++) {
        if (j > 0) text_add(text, "`, `");
        text_shown(text, hand->summands[list[j]].text);
    }
    text_add(text, "`: zero throughout\n");
}

void hand_diagnose(const struct hand_check *check, int slip, struct text *text)
{
    const struct hand *hand = &check->model->scene->bodies[check->body].hands[check->index];
    if (check->elsewhere[0]) {
        text_printf(text,
                    "  wrong point: it is true, but the equation of moments about `%s`, not about `%s`\n",
                    check->elsewhere, hand->about_name);
        return;
    }
    /* An equation for N is across the line: the terms, which are along it, are not in it. */
    bool across = check->part < 0 && check->says & 1U << hand_N;
    bool found = !across && !(check->says & (unsigned)hand_named_forces) && !inertia_is_right(check, slip) &&
                 blame_inertia(check, slip, text);
    /* Terms are those along the coordinate of an unconnected body. */
    const bool named = (check->says & ((unsigned)hand_named_forces | (unsigned)hand_others)) != 0 ||
                       !check->model->bodies[check->body].alone;
    if (!found && !across && !named) found = blame_term(check, slip, text) || hand_match(check, slip, text);
    if (!found) found = hand_blame(check, slip, text);
    if (!found) text_add(text, "  no single term explains the difference\n");
    show_worst(check, slip, text);
}
