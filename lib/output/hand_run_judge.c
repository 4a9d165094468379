/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What is said of derivations that are held against a run, and which force a line lacks.
 *
 * All of a line stands on one side: lack = left - right, or of what is conserved its value less that at the start. Where
 * the line has the factor s on a summand and all else right, the lack is a multiple of that summand at every time; where a
 * force is missing it is the work of that, or its impulse.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "loop/energy_guard.h"
#include "output/hand.h"
#include "output/hand_run.h"
#include "output/words.h"

enum { most_agents = 12 };

/* A line at a shot. */
struct judged {
    const struct run_shot *shot;
    double left, right, size;
    double summands[most_summands]; /* what the lack grows by with the factor of each */
};

struct judge {
    struct hand_run *run;
    int body;
    const struct hand *hand;
    double *y; /* hand_senses times hand_sense_size */
    size_t block;
    size_t count, failed, first; /* judged, those that fail, the first of these */
    struct judged *list;
    double tolerance;
    bool *bodies; /* that it names */
    bool moves;   /* something that it names */
    bool known;   /* all works and impulses are */
    bool varies[most_summands];
    size_t agents[most_agents]; /* of those of the run: what may be lacking, */
    size_t agent_count;
    int part; /* and of what each does */
};

static double lack_of(const struct judged *judged)
{
    return judged->left - judged->right;
}

/* ---- evaluating */

static const double *numbers(const struct judge *judge, const double *y)
{
    return y + (size_t)judge->run->place[judge->body] * hand_room(judge->run->model);
}

static bool is_integral(const struct fbd_model *model, size_t k)
{
    return model->absolutes[k].kind == absolute_work || model->absolutes[k].kind == absolute_impulse;
}

static void set(const struct judge *judge, enum hand_sense sense, const double *y)
{
    memcpy(judge->y + sense * judge->block, numbers(judge, y), hand_room(judge->run->model) * sizeof *y);
}

/* Put a shot where the line reads it. In an equation of an impact works are those of the impact. */
static void put(const struct judge *judge, const struct run_shot *shot, bool before)
{
    const struct fbd_model *model = judge->run->model;
    const size_t first = plan_size(&model->plan) + hand_slots;
    set(judge, sense_now, before ? shot->before : shot->y);
    set(judge, sense_initial, judge->run->shots[0].y);
    if (judge->hand->kind != hand_of_impacts) return;
    set(judge, sense_before, shot->before);
    set(judge, sense_after, shot->y);
    for (size_t k = 0; k < model->absolute_count; k++)
        if (is_integral(model, k)) judge->y[first + k] -= numbers(judge, shot->before)[first + k];
}

static double value(const struct judge *judge, const struct expr *expr, double t)
{
    return expr ? expr_eval(expr, t, judge->y, NULL) : 0;
}

/* Evaluate at a shot, or just before its impact. */
static struct judged evaluate(const struct judge *judge, const struct run_shot *shot, bool before)
{
    const struct hand *hand = judge->hand;
    const struct run_shot *start = &judge->run->shots[0];
    const bool conserved = hand->kind == hand_conserved;
    struct judged judged = {.shot = shot};
    if (conserved) {
        put(judge, start, false);
        judged.right = value(judge, hand->left, start->t);
        for (size_t j = 0; j < hand->summand_count; j++)
            judged.summands[j] = -hand->summands[j].sign * value(judge, hand->summands[j].expr, start->t);
    }
    put(judge, shot, before);
    judged.left = value(judge, hand->left, shot->t);
    if (!conserved) judged.right = value(judge, hand->right, shot->t);
    judged.size = fabs(judged.left) + fabs(judged.right);
    for (size_t j = 0; j < hand->summand_count; j++) {
        double summand = hand->summands[j].sign * value(judge, hand->summands[j].expr, shot->t);
        judged.size += fabs(summand);
        judged.summands[j] += conserved ? summand : -summand;
    }
    return judged;
}

/* Does it name what has moved since the start, is moving, or jumps? */
static bool names_motion(const struct judge *judge, const struct expr *expr)
{
    const struct fbd_model *model = judge->run->model;
    const size_t n = model->scene->coordinate_count, size = scene_size(model->scene);
    const int *slots;
    const size_t count = expr ? expr_variables(expr, &slots) : 0;
    const bool impact = judge->hand->kind == hand_of_impacts;
    for (size_t i = 0; i < count; i++) {
        const size_t k = (size_t)(slots[i] - 1) % judge->block;
        const bool rate = k >= n && k < size;
        const double now = judge->y[k + (impact ? sense_after : sense_now) * judge->block];
        const double other = judge->y[k + (impact ? sense_before : sense_initial) * judge->block];
        const bool integral = k >= size + hand_slots && is_integral(model, k - size - hand_slots);
        if (impact && integral ? judge->y[k] != 0 : now != other || (!impact && rate && now != 0))
            return true;
    }
    return false;
}

/* Is it the impact that the line names? */
static bool is_asked(const struct judge *judge, const struct run_shot *shot)
{
    const struct hand *hand = judge->hand;
    const struct ensemble *ensemble = judge->run->ensemble;
    if (hand->kind != hand_of_impacts || !hand->impact) return true;
    for (size_t i = shot->event; i < ensemble->event_count && ensemble->events[i].t == shot->t; i++)
        if (strcmp(event_name(judge->run->model, &ensemble->events[i]), hand->impact) == 0) return true;
    return false;
}

static void judge_shot(struct judge *judge, const struct run_shot *shot)
{
    const struct hand *hand = judge->hand;
    const bool impacts = hand->kind == hand_of_impacts;
    if ((impacts && !shot->impact) || !is_asked(judge, shot)) return;
    put(judge, shot, false);
    if (hand->when && expr_eval(hand->when, shot->t, judge->y, NULL) == 0) return;
    bool moves = names_motion(judge, hand->left) || names_motion(judge, hand->right);
    if (impacts && !moves) return;
    judge->moves |= moves;
    struct judged judged = evaluate(judge, shot, false);
    for (size_t j = 0; j < hand->summand_count; j++)
        judge->varies[j] |= fabs(judged.summands[j]) > 1e-9 * judged.size;
    judge->known &= isfinite(judged.size);
    judge->list[judge->count++] = judged;
}

static void judge_all(struct judge *judge)
{
    const struct hand_run *run = judge->run;
    const double steps = judge->hand->kind == hand_of_impacts ? 0 : (double)run->steps;
    double size = 0;
    for (size_t i = 0; i < run->count; i++) judge_shot(judge, &run->shots[i]);
    for (size_t i = 0; i < judge->count; i++) size = fmax(size, judge->list[i].size);
    judge->tolerance = energy_explained(run->ensemble->options.tolerance, steps, size, size);
    for (size_t i = judge->count; i-- > 0;)
        if (!(fabs(lack_of(&judge->list[i])) <= judge->tolerance)) {
            judge->failed++;
            judge->first = i;
        }
}

/* ---- which summand, which force */

typedef double series(const struct judge *judge, const struct judged *judged, unsigned which);

static double summand(const struct judge *judge, const struct judged *judged, unsigned which)
{
    (void)judge;
    return judged->summands[which];
}

/* The first of the list that is not to be explained by works: forces act between impacts. */
static size_t end_of(const struct judge *judge)
{
    size_t end = 0;
    if (judge->hand->kind == hand_of_impacts) return judge->count;
    while (end < judge->count && !judge->list[end].shot->impact) end++;
    return end;
}

/* Is the lack `factor` times the series everywhere? Twice the tolerance: the series is off as well. */
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

/* A line is right with the factor s on one summand if it lacks (1 - s) times that. At one impact any factor makes it right. */
static bool blame_summand(const struct judge *judge, bool constant, struct text *text)
{
    const struct hand *hand = judge->hand;
    for (unsigned j = 0; j < hand->summand_count; j++) {
        double factor = 1 - best_factor(judge, summand, j);
        if (!isfinite(factor) || !fits(judge, summand, j, 1 - factor)) continue;
        if (fabs(factor) < 1e-6 && hand->summand_count < 2) continue;
        if ((end_of(judge) < 3 || hand->kind == hand_of_impacts) && !is_plain(factor)) continue;
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

/* Has the line the work or the impulse of it? */
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

/* The smallest set of forces that explains the lack; 0 for none. */
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

/* What each force does that a line of this dimension may lack. */
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

static bool is_impact(const struct run_event *event)
{
    return event->kind == FBD_EVENT_IMPACT || event->kind == FBD_EVENT_ROPE_TAUT ||
           event->kind == FBD_EVENT_LANDING || event->kind == FBD_EVENT_REST || event->kind == FBD_EVENT_JAM;
}

/* The names of what strikes at a shot. */
static void say_impact(const struct judge *judge, const struct run_shot *shot, struct text *text)
{
    const struct ensemble *ensemble = judge->run->ensemble;
    const char *before = "";
    for (size_t i = shot->event; i < ensemble->event_count && ensemble->events[i].t == shot->t; i++) {
        if (!is_impact(&ensemble->events[i])) continue;
        text_printf(text, "%s`%s`", before, event_name(judge->run->model, &ensemble->events[i]));
        before = ", ";
    }
}

/* Does what strikes at a shot act on something that the line does not name, or on the ground? */
static bool comes_from_outside(const struct judge *judge, const struct run_shot *shot)
{
    const struct fbd_model *model = judge->run->model;
    const struct ensemble *ensemble = judge->run->ensemble;
    for (size_t i = shot->event; i < ensemble->event_count && ensemble->events[i].t == shot->t; i++)
        for (int k = 0; model->tree && k < model->tree->tie_count; k++) {
            const struct tie *tie = &model->tree->ties[k];
            if (!is_impact(&ensemble->events[i]) || tie->load != ensemble->events[i].load) continue;
            for (int end = 0; end < tie->end_count; end++)
                if (tie->end[end].body == ground_body || !judge->bodies[tie->end[end].body]) return true;
        }
    return false;
}

static void blame_impact(const struct judge *judge, const struct run_shot *shot, struct text *text)
{
    if (counts(judge, by_x) && comes_from_outside(judge, shot)) {
        text_add(text, "  an impulse from outside acts there: ");
        say_impact(judge, shot, text);
        text_add(text, "\n");
    } else if (counts(judge, by_work)) {
        double work = 0;
        for (size_t k = 0; k < judge->run->ensemble->event_count; k++) {
            const struct run_event *event = &judge->run->ensemble->events[k];
            if (event->t == shot->t && is_impact(event)) work -= event->impact.work;
        }
        text_printf(text, "  the impact takes %.6g %s\n", work, energy_unit(judge->run->model));
    } else if (judge->hand->kind == hand_of_impacts) {
        text_add(text, "  no single term explains the difference\n");
    }
}

/* ---- the verdict */

/* Is the first failure an impact, before which the line holds? */
static bool fails_by_impact(const struct judge *judge)
{
    const struct run_shot *shot = judge->list[judge->first].shot;
    if (!shot->impact || judge->hand->kind == hand_of_impacts) return false;
    struct judged before = evaluate(judge, shot, true);
    return fabs(lack_of(&before)) <= judge->tolerance;
}

static void diagnose(struct judge *judge, struct text *text)
{
    const enum hand_kind kind = judge->hand->kind;
    const struct run_shot *shot = judge->list[judge->first].shot;
    if (fails_by_impact(judge)) {
        text_add(text, "  up to there it holds: it changes by the impact ");
        say_impact(judge, shot, text);
        text_add(text, "\n");
        blame_impact(judge, shot, text);
    } else if (kind == hand_of_impacts) {
        bool outside = counts(judge, by_x) && comes_from_outside(judge, shot);
        if (outside || !blame_summand(judge, false, text)) blame_impact(judge, shot, text);
    } else if (kind == hand_conserved) {
        bool found = blame_agents(judge, 1, text);
        found = blame_summand(judge, true, text) || found;
        if (!found && !blame_agents(judge, -1, text))
            text_add(text, "  no single term explains the difference\n");
    } else if (!blame_agents(judge, 1, text) && !blame_agents(judge, -1, text) &&
               !blame_summand(judge, false, text)) {
        text_add(text, "  no single term explains the difference\n");
    }
}

static const char *places(const struct judge *judge)
{
    if (judge->hand->kind != hand_of_impacts) return "times";
    return judge->count == 1 ? "impact" : "impacts";
}

static void say_failure(struct judge *judge, struct text *text)
{
    const struct judged *first = &judge->list[judge->first];
    text_printf(text, "  differs at %zu of %zu %s of the run, first ", judge->failed, judge->count,
                places(judge));
    if (judge->hand->kind == hand_of_impacts) {
        say_impact(judge, first->shot, text);
        text_add(text, " ");
    }
    text_printf(text, "at t = %.6g: ", first->shot->t);
    if (judge->hand->kind == hand_conserved)
        text_printf(text, "%.9g, at the start %.9g\n", first->left, first->right);
    else
        text_printf(text, "left %.9g, right %.9g\n", first->left, first->right);
    diagnose(judge, text);
}

/* What is not told from any other constant. */
static void say_constant(const struct judge *judge, struct text *text)
{
    const struct hand *hand = judge->hand;
    for (size_t j = 0; hand->summand_count > 1 && j < hand->summand_count; j++) {
        if (judge->varies[j] || strcmp(hand->summands[j].text, "0") == 0) continue;
        text_add(text, "  `");
        text_shown(text, hand->summands[j].text);
        text_printf(text, "` %s in this run: nothing is told of its factor and sign\n",
                    hand->kind == hand_conserved ? "does not change" : "is zero");
    }
}

static bool say_verdict(struct judge *judge, struct text *text)
{
    const struct ensemble *ensemble = judge->run->ensemble;
    double worst = 0;
    if (ensemble->outcome == FBD_FAILED) {
        text_printf(text, "  not checked: the run ends at t = %.6g: %s\n", ensemble->t, ensemble->reason);
        return false;
    }
    if (judge->count == 0 || !judge->moves) {
        text_printf(text, "  not checked: %s\n",
                    judge->hand->kind == hand_of_impacts ? "no impact of the run changes what it names"
                    : judge->count == 0                  ? "it claims to hold at no time of the run"
                                                         : "nothing that it names moves in the run");
        return false;
    }
    if (!judge->known) {
        text_add(text, "  not checked: what a force in it does alone in an impact is not known, or a number "
                       "is not finite\n");
        return false;
    }
    if (judge->failed > 0) {
        say_failure(judge, text);
        return false;
    }
    for (size_t i = 0; i < judge->count; i++)
        worst = fmax(worst, fabs(lack_of(&judge->list[i])) / (judge->list[i].size + DBL_MIN));
    text_printf(text, "  holds at %zu %s of the run", judge->count, places(judge));
    if (judge->hand->kind != hand_of_impacts) text_printf(text, " up to t = %.6g", ensemble->t);
    text_printf(text, " (worst difference %.1e of the terms)\n", worst);
    say_constant(judge, text);
    return true;
}

bool hand_run_judge(struct hand_run *run, int body, const struct hand *hand, struct text *text)
{
    struct judge judge = {.run = run, .body = body, .hand = hand, .known = true};
    judge.block = hand_sense_size(run->model->scene);
    judge.y = ARENA_ARRAY(&run->arena, hand_senses * judge.block, double);
    judge.list = ARENA_ARRAY(&run->arena, run->count + 1, struct judged);
    judge.bodies = ARENA_ARRAY(&run->arena, run->model->body_count, bool);
    run->no_memory = run->no_memory || run->arena.failed;
    if (run->no_memory) return false;
    hand_run_mark(run->model, hand->left, judge.bodies);
    hand_run_mark(run->model, hand->right, judge.bodies);
    judge_all(&judge);
    return say_verdict(&judge, text);
}
