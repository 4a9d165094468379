/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The data of a line that is compared with a run, shared by the verdict and the search for the mistake.
 *
 * All of it is on one side: lack = left - right; for a conserved quantity its value less that at the start.
 */
#ifndef FBD_OUTPUT_HAND_RUN_JUDGE_H
#define FBD_OUTPUT_HAND_RUN_JUDGE_H

#include "output/hand_run.h"

enum { most_agents = 12 };

/* The evaluation of a line at a shot. */
struct judged {
    const struct run_shot *shot;
    double left, right, size;
    double summands[most_summands]; /* the derivative of the lack by the factor of each */
};

struct judge {
    struct hand_run *run;
    int body;
    const struct hand *hand;
    double *y; /* hand_senses times hand_sense_size */
    size_t block;
    size_t count, failed, first; /* judged shots, those that fail, the first of these */
    struct judged *list;
    double tolerance;
    bool *bodies; /* named in the line */
    bool moves;   /* a named quantity changes */
    bool known;   /* all works and impulses are known */
    bool varies[most_summands];
    size_t agents[most_agents]; /* indices into those of the run: forces that may be missing, */
    size_t agent_count;
    int part; /* and the work or impulse of each */
};

static inline double lack_of(const struct judged *judged)
{
    return judged->left - judged->right;
}

/* True for an integral over the run: a work or an impulse. */
static inline bool is_integral(const struct fbd_model *model, size_t k)
{
    return model->absolutes[k].kind == absolute_work || model->absolutes[k].kind == absolute_impulse;
}

/* True for a single impact. A Zeno limit is none: the impact laws do not apply to it. */
static inline bool run_event_is_impact(const struct run_event *event)
{
    return event->kind == FBD_EVENT_IMPACT || event->kind == FBD_EVENT_ROPE_TAUT ||
           event->kind == FBD_EVENT_LANDING || event->kind == FBD_EVENT_JAM;
}

/* Evaluate a line at a shot, or just before its impact. */
struct judged judge_evaluate(const struct judge *judge, const struct run_shot *shot, bool before);

/* Name the likely mistake (hand_run_blame.c). */
void judge_diagnose(struct judge *judge, struct text *text);

/* The names of the impacts at a shot. */
void judge_say_impact(const struct judge *judge, const struct run_shot *shot, struct text *text);

#endif
