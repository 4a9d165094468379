/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lines of energy and momentum, compared with a run of the key's model.
 *
 * Two lines are equivalent when the derivatives of left - right by the velocities are proportional at all times, with one
 * factor. That distinguishes energy from momentum, and a balance from an identity, independently of a common factor.
 */
#include <math.h>

#include "base/text.h"
#include "grade/lines.h"

const struct node *line_compile(struct lines *lines, const struct node *root, int body)
{
    fbd_errors *errors = fbd_errors_new();
    const struct node *alone = lines_alone(lines, root, body, lines->index);
    fbd_model_free(lines->alone);
    lines->alone = NULL;
    if (alone && errors) lines->alone = lines_try(lines, alone, true, false, errors);
    fbd_errors_free(errors);
    return alone;
}

bool line_judge_by_run(struct lines *lines, int body, struct line_of_run *line)
{
    struct arena *arena = &lines->grade->arena;
    struct hand_run run = {.model = NULL};
    struct text text = {0};
    double *slopes;
    if (!line_compile(lines, lines->root, body) || !lines->alone) return false;
    const fbd_model *model = lines->alone;
    const struct hand *hand = &model->scene->bodies[body].hands[0];
    fbd_errors *errors = fbd_errors_new();
    bool made = errors && hand_run_make(&run, model, errors);
    bool done = errors && !errors->out_of_memory;
    line->holds = made && hand_run_judge(&run, body, hand, &text);
    line->count = hand_run_slopes(&run, body, hand, arena, &slopes);
    line->slopes = slopes;
    line->empty = true;
    for (size_t i = 0; i < line->count; i++) line->empty = line->empty && slopes[i] == 0;
    if (made) line->verdict = arena_text(arena, text.data ? text.data : "", text.length);
    if (!made) line->verdict = "  there is no run of the model\n";
    done = done && !text.failed && line->verdict && !run.no_memory && !arena->failed;
    hand_run_free(&run);
    fbd_errors_free(errors);
    text_free(&text);
    return done;
}

bool lines_of_run_agree(const struct line_of_run *a, const struct line_of_run *b)
{
    double product = 0, first = 0, second = 0;
    if (!a->verdict || !b->verdict) return !a->verdict && !b->verdict;
    for (size_t i = 0; a->count == b->count && i < a->count; i++) {
        product += a->slopes[i] * b->slopes[i];
        first += a->slopes[i] * a->slopes[i];
        second += b->slopes[i] * b->slopes[i];
    }
    return first > 0 && second > 0 && fabs(product) >= (1 - 1e-8) * sqrt(first * second);
}
