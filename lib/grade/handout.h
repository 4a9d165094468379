/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Handout: the sheet of a student, empty or filled in.
 */
#ifndef FBD_GRADE_HANDOUT_H
#define FBD_GRADE_HANDOUT_H

#include "base/text.h"
#include "fbd_grade.h"
#include "grade/grade.h"

struct handout {
    struct text *text;
    struct arena *arena;
    const struct fbd_key *key;
    const char *student;
    fbd_model *model; /* of a solution: the key with the values of the student; else NULL */
    bool open;        /* lines in the place of what is asked of a body, see below */
    bool scene;       /* with its inertia, even where that is asked: the scene by itself */
};

/* In an open sheet: what begins the line in the place of the lists, without and with derivations; both of them begin that
 * of the inertia. The name of the body follows. */
enum { sheet_lists = '\f', sheet_hand = '\v' };

/* Write the sheet. False when memory is out. */
bool handout_write(struct handout *handout);

/* Which reactions have to be drawn: a sentence. */
void handout_reactions(struct text *text, const struct grading *grading);

/* NULL with notes in `errors`. */
fbd_model *solution_model(const struct handout *handout, fbd_errors *errors);

/* The forces or moments of a body that the key does not list, and that have to be drawn. */
void solution_reactions(const struct handout *handout, const char *body_name, bool moments);

/* The equations of the start, as comments. */
void solution_equations(const struct handout *handout);

#endif
