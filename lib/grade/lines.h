/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lines: the derivations of an answer on the mechanics of the key.
 */
#ifndef FBD_GRADE_LINES_H
#define FBD_GRADE_LINES_H

#include "fbd_grade.h"
#include "grade/grade.h"

/* A scene with an additional force on every body. */
struct pushed {
    bool made;
    const struct node *root;
    fbd_model *model; /* NULL if it is impossible */
};

struct lines {
    struct fbd_grade *grade;
    const struct node *paper;  /* the original tree of the answer; NULL for the key, */
    const struct node *answer; /* and with its derivations as expressions (lines_notation.c) */
    const struct node *root;   /* the key with the answer's derivations */
    bool left_out;             /* all of them are left out */
    fbd_model *model;
    struct pushed pushed[2];   /* the same with other forces on all bodies */
    bool rest_made;            /* statics.c: the sums of forces and moments were computed, */
    struct rest *rest;         /* these, or NULL */
    const struct node *varied; /* the answer with a parameter for each reaction */
    const unsigned *slips;     /* of each body: the senses of slip of the motion of the sheet */
    int index;                 /* of the current equation, */
    fbd_model *alone;          /* and the scene with only that one */
    fbd_checker *checker;
};

enum { slips = 3 }; /* of a body's friction: back, none, forth */

/* The unknowns of one equation, and the cases in which it is true. */
struct line {
    fbd_comparison is;         /* the slopes of a line that is compared with a run are in the arena */
    unsigned counts;           /* bit k: slip k - 1 is one of the motion of the sheet, or all are */
    bool dynamic;              /* it is false under other forces, so it is not kinematic */
    double form[FBD_UNKNOWNS]; /* at the start, where it names forces */
    unsigned long long met;    /* the unknowns of the line of the key that it has matched, */
    const struct line *met_by; /* and the first of those lines */
    bool in_numbers;           /* true for the values of the sheet, not for others */
    const double *rest;        /* an equation of equilibrium (statics.c): its changes with the parameters */
    double share;              /* of a line of the key: fraction of its cases that are matched */
    fbd_finding *finding;      /* on a line of the key */
};

/* The lines of a body, in the order of the file: its own, and those of the key. */
struct body_lines {
    struct line *own, *key;
    size_t count, key_count;
};

/* ---- matching of lines (lines_meet.c) */

/* True at all states of a sense of slip; of one of the relevant senses. */
bool line_agrees_at(const struct line *line, int slip);
bool line_agrees(const struct line *line);

/* The senses of slip for which a line of the key has to be matched: those for which it is true. */
unsigned line_wanted_slips(const struct line *key);

/* Compute the matched fraction of each line of the key. False when memory is out. */
bool lines_meet(struct lines *lines, struct body_lines *found);

/* The value of a key of a mapping, or NULL. */
const struct node *lines_value(const struct node *map, const char *key);

/* Compile `root`; the first error, if any, is a finding when `tell`. */
fbd_model *lines_try(struct lines *lines, const struct node *root, bool hands, bool tell, fbd_errors *errors);

/* Put the derivations of an answer into the scene of the key and compile it, without unreadable ones, which
 * are noted. No model when memory is out. */
void lines_read(struct lines *lines, const struct node *answer);

/* An answer with its derivations as expressions, as read in the scene `root`, which contains them; rejected
 * ones are unchanged. NULL when memory is out. */
const struct node *lines_of_notation(struct fbd_grade *grade, const struct node *answer,
                                     const struct node *root);

/* ---- the scenes of a derivation (lines_scene.c) */

/* A scene with only one equation. NULL when memory is out. */
const struct node *lines_alone(struct lines *lines, const struct node *root, int body, int index);

/* Make the scene with push k. */
enum { lines_pushes = 2 };
void lines_push(struct lines *lines, int k);

/* For each body: the senses in which its friction slips in the run of the sheet, bit k for slip k - 1; all of
 * them if it does not slip. NULL when memory is out. */
unsigned *lines_slips(struct fbd_grade *grade);

/* True if the scene has one degree of freedom; requires its pushes (freedom.c). */
bool lines_one_freedom(struct lines *lines);

/* Compare equation lines->index of a body in that scene, which is compiled as lines->alone. False when memory is out. */
bool line_compare(struct lines *lines, const struct node *root, int body, double spread, double tolerance,
                  struct line *line);

/* ---- the answer's own values (lines_values.c) */

/* True if it has a number that may be rounded: of two digits or more, not part of a name. */
bool line_has_numbers(const char *text);

/* True if it names parameters that the sheet does not have; these are not varied with the others. *rounded:
 * one of them may be a rounded number. */
bool line_has_own_names(const struct lines *lines, const char *text, bool *rounded);

/* ---- lines of energy and momentum (lines_run.c) */

/* True if both are equivalent in the velocities, or neither is such a line. */
bool lines_of_run_agree(const fbd_comparison *a, const fbd_comparison *b);

/* ---- equations of equilibrium (statics.c) */

/* *changes: the changes of left - right with the parameters if the equation is a correct one of equilibrium;
 * else NULL. False when memory is out. */
bool line_is_of_rest(struct lines *lines, int body, const char *text, const double **changes);

/* True if a form of so many numbers is linearly independent of `count` others. `base` is their orthonormal
 * basis and is extended. */
bool form_is_new(const double *form, int numbers, double *base, size_t count);

/* True if changes are linearly independent of `count` others. `base` is their orthonormal basis (rest_room
 * numbers each) and is extended. */
enum { rest_room = 32 };
bool rest_is_new(const struct lines *lines, const double *changes, double *base, size_t count);

/* An equation with the parameters of reactions for the names of drawn forces. */
const struct node *line_over_parameters(struct fbd_grade *grade, const struct node *answer,
                                        const struct node *line, const char *body);

/* ---- the answer's own coordinates (coordinates.c) */

/* The derivations of a body in the coordinates of the sheet, with the values of the forces in them. NULL when
 * memory is out, or if `hand` is. */
const struct node *coordinates_of_sheet(struct fbd_grade *grade, const struct node *answer,
                                        const struct node *hand, const char *body);

/* Find the names in derivations of the correct unknown reactions; and these names as `symbols` of a body, or
 * NULL for none (drawn_forces.c). */
void drawn_find_forces(struct fbd_grade *grade);
const struct node *drawn_symbols(struct fbd_grade *grade, const struct node *answer, const char *body,
                                 struct pos at);

/* True for a name that an answer must not define. */
bool name_is_of_equations(const char *name);

/* The lines as read in the coordinates of the sheet without conversion: an answer may have copied its
 * derivations from there. NULL when memory is out. */
const struct node *lines_as_written(struct lines *lines);

/* A derivation as the student wrote it, and as it was read. */
const char *line_as_written(const struct lines *lines, const char *body, const fbd_derivation *hand);
const char *line_as_read(const struct lines *lines, const char *body, const fbd_derivation *hand);

/* Add a message on a derivation, with its translation if it was not written as an expression. */
void line_say(struct lines *lines, fbd_finding *finding, const fbd_derivation *hand, const char *message);

#endif
