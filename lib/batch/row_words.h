/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Words for outcomes of a body in a run, its start included, which logs no event:
 *
 *     slips   friction breaks away, or it slips from the start
 *     lifts   a contact opens, or one that touches at rest at the start opens there
 *     tips    it lifts at one point of a contact pair and stays on another one of the same pair
 *
 * A body is the one that the log names for its contact: the first of the pair.
 */
#ifndef FBD_BATCH_ROW_WORDS_H
#define FBD_BATCH_ROW_WORDS_H

#include "loop/ensemble.h"

/* Beyond the values of fbd_event_kind, for the same columns. */
enum row_word { word_slips = 1000, word_lifts, word_tips };

/* The word of a name, or -1; and its name. */
int row_word_find(const char *name);
const char *row_word_name(enum row_word word);

struct word_note {
    double t;
    enum row_word word;
    int body;
};

struct word_log {
    struct word_note *notes; /* in the order of time */
    size_t count, room;
    size_t at_start; /* the first notes, which no event has */
    size_t seen;     /* events of the run that were looked at */
    bool started;
};

/* Look at the last step of a run. `probe` is a scratch state of the same model. False when memory is out or
 * the dense output is not available. */
bool word_log_step(struct word_log *log, struct ensemble *run, struct fbd_state *probe);

/* Begin a log anew, with the memory of the last one. */
void word_log_restart(struct word_log *log);
void word_log_free(struct word_log *log);

#endif
