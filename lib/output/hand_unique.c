/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Indeterminate reactions in derivations by hand: a beam on three supports, a door on two hinges.
 *
 * The displayed values are one choice of many and cannot be used to judge a line. The others differ from it
 * by the null vectors of the constraints (rest_system.h). A line that changes along one of these depends on
 * the load distribution, and is neither right nor wrong; one that changes along none is judged as any other,
 * since its sums are unique.
 */
#include <string.h>

#include "base/format.h"
#include "dynamics/rest_system.h"
#include "output/hand.h"
#include "output/hand_forces.h"
#include "section/name.h"

struct question {
    struct hand_check *check;
    const struct hand *hand;
    const struct hand_named *named;
    struct rest_system system;
    double *before, *after; /* hand_room each: as extended */
    double size;            /* sum of the magnitudes of the terms of the line */
};

static double lack_of(const struct question *question, const double *y)
{
    const struct hand *hand = question->hand;
    double t = question->system.state->t;
    return expr_eval(hand->left, t, y, NULL) - expr_eval(hand->right, t, y, NULL);
}

/* A force, or a section force. */
static bool is_of_forces(const struct fbd_model *model, size_t k)
{
    return model->absolutes[k].kind == absolute_force || model->absolutes[k].kind == absolute_section;
}

/* Change of the line if each force in it changed by the force scale of the scene. */
static double reach_of(const struct question *question)
{
    const struct fbd_model *model = question->system.state->model;
    const size_t first = plan_size(&model->plan);
    const double t = question->system.state->t, force = question->system.force;
    double reach = 0;
    for (size_t k = first + hand_N; k < hand_room(model); k++) {
        double left, right;
        if (k != first + hand_N && (k < first + hand_slots || !is_of_forces(model, k - first - hand_slots)))
            continue;
        expr_eval_slot(question->hand->left, t, question->before, (int)(1 + k), NULL, &left);
        expr_eval_slot(question->hand->right, t, question->before, (int)(1 + k), NULL, &right);
        reach += fabs(left - right) * force * fmax(1, question->system.length);
    }
    return reach;
}

/* Record the first name in the line that has changed. */
static void note_name(const struct question *question)
{
    const struct fbd_model *model = question->system.state->model;
    const size_t first = plan_size(&model->plan) + hand_slots;
    const double t = question->system.state->t;
    for (size_t k = 0; k < model->absolute_count; k++) {
        double left, right, change = question->after[first + k] - question->before[first + k];
        if (!is_of_forces(model, k) || change == 0) continue;
        expr_eval_slot(question->hand->left, t, question->before, (int)(1 + first + k), NULL, &left);
        expr_eval_slot(question->hand->right, t, question->before, (int)(1 + first + k), NULL, &right);
        if (fabs((left - right) * change) <= 1e-6 * question->size) continue;
        const struct absolute *absolute = &model->scene->absolutes[k];
        question->check->open_body = absolute->body;
        format_into(question->check->open_force, sizeof question->check->open_force, "%s",
                    absolute->force ? absolute->force : section_symbols[absolute->part]);
        return;
    }
}

/* True if the line changes along null vector k. */
static bool changes_along(struct question *question, size_t k)
{
    struct fbd_state *state = question->system.state;
    double *slots = state->slots;
    if (!rest_vary(&question->system, k, question->system.force)) return false;
    state->slots = question->system.forces;
    hand_extend(state, question->check->body, question->named, question->after);
    state->slots = slots;
    rest_restore(&question->system);
    double change = lack_of(question, question->after) - lack_of(question, question->before);
    return fabs(change) > 1e-6 * question->size;
}

bool hand_is_open(struct hand_check *check, const struct hand *hand, const struct hand_named *named,
                  struct fbd_state *state, double size)
{
    const struct fbd_model *model = state->model;
    const size_t room = hand_room(model);
    struct arena arena = {0};
    struct instant at = state_instant(state);
    if (!rest_is_open(model, &at)) return false;
    struct question question = {.check = check, .hand = hand, .named = named, .size = size};
    bool open = false;
    question.before = ARENA_ARRAY(&arena, room, double);
    question.after = ARENA_ARRAY(&arena, room, double);
    if (question.before && question.after && rest_open(&question.system, state, &at, state->slots, &arena)) {
        rest_restore(&question.system);
        hand_extend(state, check->body, named, question.before);
        question.size = fmax(question.size, reach_of(&question));
        for (size_t k = 0; !open && k < question.system.basis_count; k++) open = changes_along(&question, k);
        if (open) note_name(&question);
    }
    if (question.system.base.F) rest_restore(&question.system);
    rest_free(&question.system);
    check->no_memory = check->no_memory || arena.failed;
    arena_free(&arena);
    return open;
}
