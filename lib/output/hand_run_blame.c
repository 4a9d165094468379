/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The likely mistake in a false line of energy or momentum.
 *
 * If one summand has a wrong factor, the residual is the same multiple of that summand at every time; if a force is missing,
 * the residual is its work or impulse.
 */
#include <math.h>

#include "output/hand_run_judge.h"
#include "output/words.h"

/* ---- summands */

typedef double series(const struct judge *judge, const struct judged *judged, unsigned which);

static double summand(const struct judge *judge, const struct judged *judged, unsigned which)
{
    (void)judge;
    return judged->summands[which];
}

/* End of the shots that works may explain: up to the first impact, as forces act between impacts. */
static size_t end_of(const struct judge *judge)
{
    size_t end = 0;
    if (judge->hand->kind == hand_of_impacts) return judge->count;
    while (end < judge->count && !judge->list[end].shot->impact) end++;
    return end;
}

/* True if the residual is `factor` times the series everywhere, to twice the tolerance, as the series has an
 * error as well. */
static bool fits(const struct judge *judge, series *values, unsigned which, double factor)
{
    const size_t end = end_of(judge);
    for (size_t i = 0; i < end; i++) {
        const struct judged *judged = &judge->list[i];
        double off = lack_of(judged) - factor * values(judge, judged, which);
        if (!(fabs(off) <= 2 * judge->tolerance * fmax(1, fabs(factor)))) return false;
    }
    return end > 0;
}

static double best_factor(const struct judge *judge, series *values, unsigned which)
{
    double top = 0, bottom = 0;
    for (size_t i = 0, end = end_of(judge); i < end; i++) {
        double x = values(judge, &judge->list[i], which);
        top += lack_of(&judge->list[i]) * x;
        bottom += x * x;
    }
    return bottom > 0 ? top / bottom : NAN;
}

static bool is_plain(double factor)
{
    static const double plain[] = {-1, 0, 0.5, 2};
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        if (fabs(factor - plain[i]) < 1e-6) return true;
    return false;
}

static bool blame_one(const struct judge *judge, unsigned j, bool plain, struct text *text)
{
    const struct hand *hand = judge->hand;
    const bool constant = hand->kind == hand_conserved;
    const double factor = 1 - best_factor(judge, summand, j);
    if (!isfinite(factor) || is_plain(factor) != plain || !fits(judge, summand, j, 1 - factor)) return false;
    if (fabs(factor) < 1e-6 && hand->summand_count < 2) return false;
    text_add(text, constant ? "  with " : "  the summand `");
    if (constant) text_printf(text, "%.6g times `", factor);
    text_shown(text, hand->summands[j].text);
    if (constant)
        text_add(text, "` it would be constant\n");
    else if (fabs(factor + 1) < 1e-6)
        text_add(text, "` has the wrong sign\n");
    else if (fabs(factor) < 1e-6)
        text_add(text, "` is one too many\n");
    else
        text_printf(text, "` is right with the factor %.6g\n", factor);
    return true;
}

/* A line is right with the factor s on one summand if its residual is (1 - s) times that: try frequent
 * factors first, others only if there are enough times. */
static bool blame_summand(const struct judge *judge, bool plain, struct text *text)
{
    const bool few = end_of(judge) < 3 || judge->hand->kind == hand_of_impacts;
    for (unsigned j = 0; j < judge->hand->summand_count; j++)
        if (blame_one(judge, j, true, text)) return true;
    for (unsigned j = 0; !plain && !few && j < judge->hand->summand_count; j++)
        if (blame_one(judge, j, false, text)) return true;
    return false;
}

/* ---- forces */

static double done_by(const struct judge *judge, const struct judged *judged, unsigned which)
{
    double sum = 0;
    for (size_t i = 0; i < judge->agent_count; i++)
        if (which >> i & 1U) sum += judged->shot->done[judge->agents[i] * agent_parts + (size_t)judge->part];
    return sum;
}

/* True if the line contains its work or impulse. */
static bool is_named(const struct judge *judge, const struct agent *agent)
{
    const struct hand_run *run = judge->run;
    const int first = 1 + (int)plan_size(&run->model->plan) + hand_slots;
    const struct expr *sides[] = {judge->hand->left, judge->hand->right};
    for (int side = 0; side < 2; side++) {
        const int *slots;
        const size_t count = sides[side] ? expr_variables(sides[side], &slots) : 0;
        for (size_t i = 0; i < count; i++) {
            const int k = slots[i] - first;
            if (k < 0 || k >= (int)run->model->absolute_count || !is_integral(run->model, (size_t)k))
                continue;
            const struct hand_sum *sum = &run->named.of[k];
            for (size_t f = 0; f < sum->count; f++)
                if (sum->forces[f]->name.body == agent->body && sum->forces[f]->arrow == agent->arrow)
                    return true;
        }
    }
    return false;
}

static void list_agents(struct judge *judge, int part)
{
    const struct hand_run *run = judge->run;
    judge->part = part;
    judge->agent_count = 0;
    for (size_t a = 0; a < run->agent_count && judge->agent_count < most_agents; a++) {
        double most = 0;
        for (size_t i = 0, end = end_of(judge); i < end; i++)
            most = fmax(most, fabs(judge->list[i].shot->done[a * agent_parts + (size_t)part]));
        if (most > judge->tolerance && !is_named(judge, &run->agents[a]))
            judge->agents[judge->agent_count++] = a;
    }
}

static unsigned count_bits(unsigned set)
{
    unsigned count = 0;
    for (; set; set &= set - 1) count++;
    return count;
}

/* The smallest set of forces that explains the residual; 0 for none. */
static unsigned find_agents(const struct judge *judge, double factor)
{
    for (unsigned bits = 1; bits <= judge->agent_count; bits++)
        for (unsigned which = 1; which < 1U << judge->agent_count; which++)
            if (count_bits(which) == bits && fits(judge, done_by, which, factor)) return which;
    return 0;
}

static void say_agents(const struct judge *judge, unsigned which, struct text *text)
{
    const struct hand_run *run = judge->run;
    const char *before = "";
    text_printf(text, "the %s of ", judge->part == by_work ? "work" : "impulse");
    for (size_t i = 0; i < judge->agent_count; i++) {
        const struct agent *agent = &run->agents[judge->agents[i]];
        if (!(which >> i & 1U)) continue;
        which &= ~(1U << i);
        text_printf(text, "%s`%s%s%s`", before,
                    agent->body == judge->body ? "" : run->model->bodies[agent->body].name,
                    agent->body == judge->body ? "" : ".", agent->name);
        before = count_bits(which) > 1 ? ", " : " and ";
    }
}

/* True if the work or impulse of a missing force has the dimension of the line. */
static bool counts(const struct judge *judge, int part)
{
    const struct hand *hand = judge->hand;
    const struct dim momentum = dim_times(DIM_FORCE, DIM_TIME), angular = dim_times(momentum, DIM_LENGTH);
    struct dim dim = expr_dim(hand->left);
    if (dim_equal(dim, DIM_NONE) && hand->right) dim = expr_dim(hand->right);
    return dim_equal(dim, DIM_MOMENT) ? part == by_work
           : dim_equal(dim, momentum) ? part != by_work
                                      : dim_equal(dim, angular) && part >= by_coordinate;
}

static bool blame_agents(struct judge *judge, double factor, struct text *text)
{
    for (int part = 0; part < agent_parts; part++) {
        if (!counts(judge, part)) continue;
        list_agents(judge, part);
        unsigned which = find_agents(judge, factor);
        if (!which) continue;
        if (judge->hand->kind == hand_conserved) {
            text_printf(text, "  it changes by %s", factor < 0 ? "minus " : "");
            say_agents(judge, which, text);
        } else {
            text_add(text, "  ");
            say_agents(judge, which, text);
            text_add(text, " is missing");
        }
        text_add(text, "\n");
        return true;
    }
    return false;
}

/* ---- impacts */

void judge_say_impact(const struct judge *judge, const struct run_shot *shot, struct text *text)
{
    const struct ensemble *ensemble = judge->run->ensemble;
    const char *before = "";
    for (size_t i = shot->event; i < ensemble->event_count && ensemble->events[i].t == shot->t; i++) {
        if (!run_event_is_impact(&ensemble->events[i])) continue;
        text_printf(text, "%s`%s`", before, event_name(judge->run->model, &ensemble->events[i]));
        before = ", ";
    }
}

/* True if impacts at a shot act on a body that the line does not name, or on the ground. */
static bool comes_from_outside(const struct judge *judge, const struct run_shot *shot)
{
    const struct fbd_model *model = judge->run->model;
    const struct ensemble *ensemble = judge->run->ensemble;
    for (size_t i = shot->event; i < ensemble->event_count && ensemble->events[i].t == shot->t; i++)
        for (int k = 0; k < model->tree->coupling_count; k++) {
            const struct coupling *coupling = &model->tree->couplings[k];
            if (!run_event_is_impact(&ensemble->events[i]) || coupling->load != ensemble->events[i].load)
                continue;
            for (int end = 0; end < coupling->end_count; end++)
                if (coupling->end[end].body == ground_body || !judge->bodies[coupling->end[end].body])
                    return true;
        }
    return false;
}

static bool names_impulse(const struct judge *judge)
{
    const struct fbd_model *model = judge->run->model;
    const int first = 1 + (int)plan_size(&model->plan) + hand_slots; /* in the present sense */
    const struct expr *sides[] = {judge->hand->left, judge->hand->right};
    for (int side = 0; side < 2; side++) {
        const int *slots;
        const size_t count = sides[side] ? expr_variables(sides[side], &slots) : 0;
        for (size_t i = 0; i < count; i++) {
            const int k = slots[i] - first;
            if (k < 0 || k >= (int)model->absolute_count) continue;
            if (model->absolutes[k].kind == absolute_impulse) return true;
        }
    }
    return false;
}

static void blame_impact(const struct judge *judge, const struct run_shot *shot, struct text *text)
{
    if (counts(judge, by_x) && comes_from_outside(judge, shot) && !names_impulse(judge)) {
        text_add(text, "  an impulse from outside acts there: ");
        judge_say_impact(judge, shot, text);
        text_add(text, "\n");
    } else if (counts(judge, by_work)) {
        double work = 0;
        for (size_t k = 0; k < judge->run->ensemble->event_count; k++) {
            const struct run_event *event = &judge->run->ensemble->events[k];
            if (event->t == shot->t && run_event_is_impact(event)) work -= event->impact.work;
        }
        text_printf(text, "  the impact takes %.6g %s\n", work, energy_unit(judge->run->model));
    } else if (judge->hand->kind == hand_of_impacts) {
        text_add(text, "  no single term explains the difference\n");
    }
}

/* True if the line is first violated at an impact. */
static bool fails_by_impact(const struct judge *judge)
{
    const struct run_shot *shot = judge->list[judge->first].shot;
    if (!shot->impact || judge->hand->kind == hand_of_impacts) return false;
    struct judged before = judge_evaluate(judge, shot, true);
    return fabs(lack_of(&before)) <= judge->tolerance;
}

void judge_diagnose(struct judge *judge, struct text *text)
{
    const enum hand_kind kind = judge->hand->kind;
    const struct run_shot *shot = judge->list[judge->first].shot;
    if (fails_by_impact(judge)) {
        text_add(text, "  up to there it holds: it changes by the impact ");
        judge_say_impact(judge, shot, text);
        text_add(text, "\n");
        blame_impact(judge, shot, text);
    } else if (kind == hand_of_impacts) {
        const bool outside = counts(judge, by_x) && comes_from_outside(judge, shot) && !names_impulse(judge);
        if (outside || !blame_summand(judge, false, text)) blame_impact(judge, shot, text);
    } else if (kind == hand_conserved) {
        bool found = blame_agents(judge, 1, text);
        found = blame_summand(judge, found, text) || found;
        if (!found && !blame_agents(judge, -1, text))
            text_add(text, "  no single term explains the difference\n");
    } else if (!blame_agents(judge, 1, text) && !blame_agents(judge, -1, text) &&
               !blame_summand(judge, false, text)) {
        text_add(text, "  no single term explains the difference\n");
    }
}
