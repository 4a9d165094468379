/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Verdicts on derivations that are compared with a run.
 */
#include "output/hand_run_judge.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "loop/energy_guard.h"
#include "output/hand.h"
#include "output/words.h"

/* ---- evaluating */

static const double *numbers(const struct judge *judge, const double *y)
{
    return y + (size_t)judge->run->place[judge->body] * hand_room(judge->run->model);
}

static void set(const struct judge *judge, enum hand_sense sense, const double *y)
{
    memcpy(judge->y + sense * judge->block, numbers(judge, y), hand_room(judge->run->model) * sizeof *y);
}

/* Write a shot to the variables of the line. In an equation of an impact works are those of the impact. */
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

struct judged judge_evaluate(const struct judge *judge, const struct run_shot *shot, bool before)
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

/* True if it names a quantity that has changed since the start, is changing, or jumps. */
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

/* True for the impact that the line names. */
static bool is_asked(const struct judge *judge, const struct run_shot *shot)
{
    const struct hand *hand = judge->hand;
    const struct ensemble *ensemble = judge->run->ensemble;
    if (hand->kind != hand_of_impacts || !hand->impact) return true;
    for (size_t i = shot->event; i < ensemble->event_count && ensemble->events[i].t == shot->t; i++)
        if (strcmp(event_name(judge->run->model, &ensemble->events[i]), hand->impact) == 0) return true;
    return false;
}

/* True for the last impact before a Zeno limit, after which the body is at rest: it represents infinitely
 * many more. */
static bool ends_series(const struct judge *judge, const struct run_shot *shot)
{
    const struct ensemble *ensemble = judge->run->ensemble;
    for (size_t i = shot->event; i < ensemble->event_count && ensemble->events[i].t == shot->t; i++) {
        const struct run_event *event = &ensemble->events[i];
        size_t next = i + 1;
        while (next < ensemble->event_count && (ensemble->events[next].load != event->load ||
                                                (ensemble->events[next].kind != FBD_EVENT_REST &&
                                                 ensemble->events[next].kind != event->kind)))
            next++;
        if (event->kind == FBD_EVENT_IMPACT && next < ensemble->event_count &&
            ensemble->events[next].kind == FBD_EVENT_REST)
            return true;
    }
    return false;
}

static void judge_shot(struct judge *judge, const struct run_shot *shot)
{
    const struct hand *hand = judge->hand;
    const bool impacts = hand->kind == hand_of_impacts;
    if (impacts && (!shot->impact || ends_series(judge, shot))) return;
    if (!is_asked(judge, shot)) return;
    put(judge, shot, false);
    if (hand->when && expr_eval(hand->when, shot->t, judge->y, NULL) == 0) return;
    bool moves = names_motion(judge, hand->left) || names_motion(judge, hand->right);
    if (impacts && !moves && !hand->impact) return;
    judge->moves |= moves || hand->impact;
    struct judged judged = judge_evaluate(judge, shot, false);
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
    for (size_t i = 0; i < judge->count; i++)
        for (size_t j = 0; j < judge->hand->summand_count; j++)
            judge->varies[j] |= fabs(judge->list[i].summands[j]) > 2 * judge->tolerance;
    for (size_t i = judge->count; i-- > 0;)
        if (!(fabs(lack_of(&judge->list[i])) <= judge->tolerance)) {
            judge->failed++;
            judge->first = i;
        }
}

/* ---- the verdict */

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
        judge_say_impact(judge, first->shot, text);
        text_add(text, " ");
    }
    text_printf(text, "at t = %.6g: ", first->shot->t);
    if (judge->hand->kind == hand_conserved)
        text_printf(text, "%.9g, at the start %.9g\n", first->left, first->right);
    else
        text_printf(text, "left %.9g, right %.9g\n", first->left, first->right);
    judge_diagnose(judge, text);
}

/* Report summands whose factor the run does not determine. */
static void say_constant(const struct judge *judge, struct text *text)
{
    const struct hand *hand = judge->hand;
    const char *before = "  the run does not verify the factor and the sign of `";
    size_t count = 0;
    for (size_t j = 0; hand->summand_count > 1 && j < hand->summand_count; j++) {
        if (judge->varies[j] || strcmp(hand->summands[j].text, "0") == 0) continue;
        text_add(text, before);
        text_shown(text, hand->summands[j].text);
        before = "`, `";
        count++;
    }
    if (count > 0)
        text_printf(text, "`: %s throughout\n", hand->kind == hand_conserved ? "constant" : "zero");
}

/* Report that no impact is of the contact or rope in the line, and list the actual ones. */
static void say_no_impact(const struct judge *judge, struct text *text)
{
    const struct ensemble *ensemble = judge->run->ensemble;
    const char *said[8];
    size_t count = 0;
    text_printf(text, "  not checked: no impact of the run is called `%s`", judge->hand->impact);
    for (size_t i = 0; i < ensemble->event_count && count < sizeof said / sizeof *said; i++) {
        if (!run_event_is_impact(&ensemble->events[i])) continue;
        const char *name = event_name(judge->run->model, &ensemble->events[i]);
        size_t k = 0;
        while (k < count && strcmp(said[k], name) != 0) k++;
        if (k < count) continue;
        text_printf(text, "%s `%s`", count ? "," : "; there is", name);
        said[count++] = name;
    }
    text_add(text, "\n");
}

static bool say_verdict(struct judge *judge, struct text *text)
{
    const struct ensemble *ensemble = judge->run->ensemble;
    double worst = 0;
    if (ensemble->outcome == FBD_FAILED) {
        text_printf(text, "  not checked: the run ends at t = %.6g: %s\n", ensemble->t, ensemble->reason);
        return false;
    }
    if (judge->count == 0 && judge->hand->impact) {
        say_no_impact(judge, text);
        return false;
    }
    if (judge->count == 0 || !judge->moves) {
        text_printf(text, "  not checked: %s\n",
                    judge->hand->kind == hand_of_impacts ? "no impact of the run changes a quantity in it"
                    : judge->count == 0                  ? "its condition holds at no time of the run"
                                                         : "no quantity in it changes in the run");
        return false;
    }
    if (!judge->known) {
        text_add(text, "  not checked: the impulse or work of one force of several that act in an impact is "
                       "not known, or a number is not finite\n");
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
    if (judge->run->impacts > most_run_impacts)
        text_printf(text, "  of %zu impacts the first %d are looked at\n", judge->run->impacts,
                    most_run_impacts);
    say_constant(judge, text);
    return true;
}

/* Make room for the judgement of a line; false when memory is out. */
static bool begin(struct judge *judge, struct hand_run *run, int body, const struct hand *hand)
{
    *judge = (struct judge){.run = run, .body = body, .hand = hand, .known = true};
    judge->block = hand_sense_size(run->model->scene);
    judge->y = ARENA_ARRAY(&run->arena, hand_senses * judge->block, double);
    judge->list = ARENA_ARRAY(&run->arena, run->count + 1, struct judged);
    judge->bodies = ARENA_ARRAY(&run->arena, run->model->body_count, bool);
    run->no_memory = run->no_memory || run->arena.failed;
    if (run->no_memory) return false;
    hand_run_mark(run->model, hand->left, judge->bodies);
    hand_run_mark(run->model, hand->right, judge->bodies);
    return true;
}

bool hand_run_judge(struct hand_run *run, int body, const struct hand *hand, struct text *text)
{
    struct judge judge;
    if (!begin(&judge, run, body, hand)) return false;
    judge_all(&judge);
    return say_verdict(&judge, text);
}

size_t hand_run_slopes(struct hand_run *run, int body, const struct hand *hand, struct arena *arena,
                       double **slopes)
{
    enum { most_times = 16 };
    static const enum hand_sense senses[] = {sense_now, sense_before, sense_after};
    const size_t n = run->model ? run->model->scene->coordinate_count : 0;
    const size_t count = (size_t)most_times * 3 * n;
    struct judge judge;
    *slopes = ARENA_ARRAY(arena, count + 1, double);
    if (n == 0 || !*slopes || !begin(&judge, run, body, hand)) return 0;
    for (size_t i = 0, seen = 0; i < run->count && seen < most_times; i++) {
        const struct run_shot *shot = &run->shots[i];
        if (hand->kind == hand_of_impacts && !shot->impact) continue;
        put(&judge, shot, false);
        for (size_t k = 0; k < 3 * n; k++) {
            double left, right = 0;
            const int slot = (int)(1 + senses[k / n] * judge.block + n + k % n);
            expr_eval_slot(hand->left, shot->t, judge.y, slot, NULL, &left);
            if (hand->right) expr_eval_slot(hand->right, shot->t, judge.y, slot, NULL, &right);
            (*slopes)[seen * 3 * n + k] = left - right;
        }
        seen++;
    }
    return count;
}
