/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lines: the derivations of an answer on the mechanics of the key.
 */
#ifndef FBD_GRADE_LINES_H
#define FBD_GRADE_LINES_H

#include "fbd_grade.h"
#include "grade/grade.h"
#include "output/hand.h"

/* A scene with a push on every body. */
struct pushed {
    bool made;
    struct document probes;
    const struct node *root;
    fbd_model *model; /* NULL where it cannot be */
};

struct lines {
    struct fbd_grade *grade;
    const struct node *paper;  /* the tree of the answer, as it is; NULL for the key, */
    const struct node *answer; /* and with its derivations as they were read (lines_notation.c) */
    const struct node *root;   /* the key with the answer's derivations */
    bool left_out;             /* all of these */
    fbd_model *model;
    struct pushed pushed[2];   /* the same with other forces on all bodies */
    bool rest_made;            /* statics.c: the sums of forces and moments have been looked for, */
    struct rest *rest;         /* these, or NULL */
    const struct node *varied; /* the answer with a parameter for each reaction */
    const unsigned *slips;     /* of each body: the senses of slip of the motion of the sheet */
    int index;                 /* of the equation at hand, */
    fbd_model *alone;          /* and the scene with it alone */
    struct hand_check check;
    gsl_rng *rng;
};

enum { slips = 3 }; /* of a body's friction: back, none, forth */

/* A line of energy or momentum, which is compared with a run. */
struct line_of_run {
    bool holds, empty;   /* it is true whatever the velocities are */
    const char *verdict; /* NULL: it is no such line, */
    size_t count;
    const double *slopes; /* how left less right changes with velocities, at some times */
};

/* Beside the bits of hand_check.says. */
enum { line_says_run = 4 << hand_slots };

/* What one equation says, and where it is true. */
struct line {
    unsigned says;
    size_t seen[slips], agreed[slips];
    unsigned counts; /* bit k: slip k - 1 is one of the motion of the sheet, or all are */
    bool checked;
    bool dynamic;                /* it fails when other forces act: it is not of the motion alone */
    unsigned long long unknowns; /* of hand_form_at: bit k */
    double form[hand_unknowns];  /* at the start, where it names forces */
    unsigned long long met;      /* the unknowns of the line of the key that it has met, */
    const struct line *met_by;   /* and the first of these */
    bool in_numbers;             /* for the values of the sheet, not for others */
    const double *rest;          /* an equation of rest (statics.c): how it changes with the parameters */
    double share;                /* of a line of the key: in how many of its cases it is met */
    fbd_finding *finding;        /* what is said of a line of the key */
    struct line_of_run run;      /* of one that is compared with a run */
};

/* The lines of a body, in the order of the file: its own, and those of the key. */
struct body_lines {
    struct line *own, *key;
    size_t count, key_count;
};

/* ---- which meets which (lines_meet.c) */

/* Is it true at all states of a sense of slip; of one of those that count? */
bool line_agrees_at(const struct line *line, int slip);
bool line_agrees(const struct line *line);

/* The senses of slip for which a line of the key has to be matched: those for which it holds itself. */
unsigned line_wanted_slips(const struct line *key);

/* What a line is about, as a set: accelerations, and reactions where it names forces or nothing else. */
unsigned long long line_unknowns(const struct line *line);

/* The share of each line of the key that is met. False when memory is out. */
bool lines_meet(struct lines *lines, struct body_lines *found);

/* The value of a key of a mapping, or NULL. */
const struct node *lines_value(const struct node *map, const char *key);

/* Compile `root`; the first error, if any, is a finding when `tell`. */
fbd_model *lines_try(struct lines *lines, const struct node *root, bool hands, bool tell, fbd_errors *errors);

/* Put the derivations of an answer into the scene of the key and compile it, without those that cannot be read, which
 * are noted. No model when memory is out. */
void lines_read(struct lines *lines, const struct node *answer);

/* An answer with its derivations in the language of expressions, as they are read in the scene `root`, which has them;
 * those that are refused as they are. NULL when memory is out. */
const struct node *lines_of_notation(struct fbd_grade *grade, const struct node *answer,
                                     const struct node *root);

/* ---- the scenes of a derivation (lines_scene.c) */

/* A scene with one equation alone. NULL when memory is out. */
const struct node *lines_alone(struct lines *lines, const struct node *root, int body, int index);

/* Make the scene with push k. */
enum { lines_pushes = 2 };
void lines_push(struct lines *lines, int k);

/* Of each body: in which senses its friction slips in the run of the sheet, bit k for slip k - 1; all of them where it
 * does not. NULL when memory is out. */
unsigned *lines_slips(struct fbd_grade *grade);

/* Has the scene one degree of freedom? Its pushes are made (freedom.c). */
bool lines_one_freedom(struct lines *lines);

/* The tree of that scene; it is compiled as lines->alone, which is NULL where memory is out (lines_run.c). */
const struct node *line_compile(struct lines *lines, const struct node *root, int body);

/* ---- values of the answer's own (lines_values.c) */

/* Has it a number that was rounded, perhaps: one of two digits or more, that is no part of a name? */
bool line_has_numbers(const char *text);

/* Does it name parameters that the sheet does not have? Those follow from others, and are not varied with them.
 * *rounded: one of them may be a number that was rounded. */
bool line_has_own_names(const struct lines *lines, const char *text, bool *rounded);

/* ---- lines of energy and momentum (lines_run.c) */

/* Judge the equation lines->index of a body. False when memory is out. */
bool line_judge_by_run(struct lines *lines, int body, struct line_of_run *line);

/* Do they say the same of the velocities, or are both no such lines? */
bool lines_of_run_agree(const struct line_of_run *a, const struct line_of_run *b);

/* ---- equations of rest (statics.c) */

/* *changes: how left less right changes with the parameters, where the equation is one of rest that is right; else NULL.
 * False when memory is out. */
bool line_is_of_rest(struct lines *lines, int body, const char *text, const double **changes);

/* The start, settled; NULL where there is none. */
fbd_state *lines_start_of(const fbd_model *model);

/* Does a form of so many numbers not follow from `count` others? `base` has these, orthonormal, and gets one more. */
bool form_is_new(const double *form, int numbers, double *base, size_t count);

/* Do changes not follow from `count` others? `base` has these (orthonormal, rest_room numbers each), and gets one more. */
enum { rest_room = 32 };
bool rest_is_new(const struct lines *lines, const double *changes, double *base, size_t count);

/* An equation with the parameters of reactions for the names of drawn forces. */
const struct node *line_over_parameters(struct fbd_grade *grade, const struct node *answer,
                                        const struct node *line, const char *body);

/* ---- coordinates of the answer's own (coordinates.c) */

/* The derivations of a body in the coordinates of the sheet, with the values of the forces that they name. NULL when
 * memory is out, or `hand` is. */
const struct node *coordinates_of_sheet(struct fbd_grade *grade, const struct node *answer,
                                        const struct node *hand, const char *body);

/* Find how derivations name the reactions that are drawn rightly and unknown; and these names as `symbols` of a body, or NULL for
 * none (drawn_forces.c). */
void drawn_find_forces(struct fbd_grade *grade);
const struct node *drawn_symbols(struct fbd_grade *grade, const struct node *answer, const char *body,
                                 struct pos at);

/* Is this a name that an answer must not define? */
bool name_is_of_equations(const char *name);

/* The lines that were read, in the coordinates of the sheet after all: an answer may have taken its derivations from
 * there. NULL when memory is out. */
const struct node *lines_as_written(struct lines *lines);

/* A derivation as the student wrote it, and as it was read. */
const char *line_as_written(const struct lines *lines, const char *body, const struct hand *hand);
const char *line_as_read(const struct lines *lines, const char *body, const struct hand *hand);

/* Say this of a derivation, and how it was read where it is not written as an expression. */
void line_say(struct lines *lines, fbd_finding *finding, const struct hand *hand, const char *message);

#endif
