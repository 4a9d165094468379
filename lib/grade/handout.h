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
    fbd_model *model; /* for a solution: the key with the values of the student; else NULL */
    bool open;        /* blank lines for the answers of each body, see below */
    bool scene;       /* with its inertia, even if that is asked: the scene alone */
};

/* In an open sheet: first characters of the line in place of the lists, without and with derivations; the
 * line for the inertia begins with both. The name of the body follows. */
enum { sheet_lists = '\f', sheet_hand = '\v' };

/* Write the sheet. False when memory is out. */
bool handout_write(struct handout *handout);

/* Write a sentence on the reactions that have to be drawn. */
void handout_reactions(struct text *text, const fbd_grading *grading);

/* NULL with notes in `errors`. */
fbd_model *solution_model(const struct handout *handout, fbd_errors *errors);

/* Write the forces or moments of a body that the key does not list and that have to be drawn. */
void solution_reactions(const struct handout *handout, const char *body_name, bool moments);

/* Write the equations of the start as comments. */
void solution_equations(const struct handout *handout);

#endif
