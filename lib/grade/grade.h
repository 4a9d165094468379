/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Grade: compare a student's model with the teacher's by mechanics.
 *
 * Both are compiled and put into the same states: that of the start and random ones. The forces and moments
 * that bodies list are compared there as wrenches about the centre of mass, whatever their names and
 * notation. Entries that are equal at every state are right; the remaining ones of both sides are paired with
 * the force that was probably meant, to report how they differ. Dependent forces (normal forces, friction)
 * are compared by kind, line of action and coefficients, since their magnitude is off as soon as any other
 * force is. Derivations are evaluated on the key's own mechanics (fbd_checker_compare).
 *
 * Unreadable parts of an answer are marked and left out, and the rest is graded.
 */
#ifndef FBD_GRADE_GRADE_H
#define FBD_GRADE_GRADE_H

#include "base/vec.h"
#include "document/node.h"
#include "fbd_grade.h"
#include "fbd_view.h"

enum { most_grade_samples = 32 };

struct fbd_key {
    struct arena arena;
    char *source; /* text of the file */
    size_t length;
    const char *file;
    const struct node *root;
    fbd_model *model; /* with the values of the file */
    fbd_grading grading;
    fbd_setting *set; /* values from outside */
    size_t set_count;
    double most;  /* points */
    size_t lines; /* derivations */
    /* Of each body, for each arrow after the listed ones: NAN, or it must be drawn, and the time of the first state
     * where it is not zero: 0, or that of the start at another time. */
    double **asked;
    size_t *asked_count;
};

/* An entry of an answer under `forces` or `moments` that has a name and a value, or has no value. */
struct drawn {
    struct pos at;
    const char *body, *name, *symbol; /* `symbol`: the name for its value, or NULL */
    const char *value;                /* as an expression; NULL where it is unknown */
    bool unknown, free;               /* its magnitude, and its direction */
    bool minus;                       /* unknown: drawn against its direction */
    double size;                      /* of a correct reaction: its value at the start; else NAN */
    const char *parameter, *unit;     /* of `size`, where it is varied (statics.c) */
    const char *reaction;             /* of the key, if this entry alone is it; else NULL, */
    struct vec along;                 /* its direction; (0, 0) of a moment, */
    const char *force;                /* and its name in derivations, with a sign: `-pin.x`; else NULL */
    struct drawn *next;
};

/* Position of a drawn entry (drawing.c): at the start, in the world, in units of the key. */
struct sketch {
    struct pos at; /* of the entry */
    const char *body, *name;
    bool couple, clockwise;
    struct vec tail, tip;
    double snap; /* tolerance of the distance of its line of action */
    const struct sketch *next;
};

struct finding {
    fbd_finding finding;
    bool reaction; /* the finding is about a reaction of the key */
    struct finding *next;
};

/* A coordinate that the answer measures otherwise: its own is sign times that of the sheet, plus offset. */
struct own_coordinate {
    const char *body;
    bool angle; /* of a pivot; else of a slide */
    double sign, offset;
    const char *unit; /* of the offset */
    const struct own_coordinate *next;
};

struct fbd_grade {
    struct arena arena;
    const struct fbd_key *key;
    const char *student, *file;
    struct finding *first, *last;
    size_t count;
    double points;
    bool submitted, readable;

    /* while the grade is computed */
    fbd_model *sheet; /* the key with these values */
    const struct own_coordinate *own;
    struct drawn *drawn;
    const struct sketch *sketches;
    fbd_finding lost; /* dummy for findings when memory is out */
};

/* The number of reactions of a body that have to be drawn. */
size_t key_asks(const struct fbd_key *key, size_t b);

/* A parameter's value for a student, set or drawn, as text with its unit; NULL for the value of the file, or
 * when memory is out. */
const char *value_for_student(struct arena *arena, const struct fbd_key *key, const char *name,
                              const char *student);

/* These values for the parameters in a file. */
size_t student_settings(struct arena *arena, const struct fbd_key *key, const char *student,
                        const struct node *root, fbd_setting **settings);

/* Grade the key as an answer; NULL when memory is out. */
fbd_grade *grade_itself(const struct fbd_key *key);

/* ---- compiling trees (compile.c) */

/* Compile a tree under these values of its parameters, with its derivations or without. NULL with notes. */
fbd_model *tree_compile(const struct node *root, const char *file, const fbd_setting *settings, size_t count,
                        bool hands, fbd_errors *errors);

/* Compile a tree of an answer or of the key under the student's values. NULL with notes. */
fbd_model *grade_compile(struct fbd_grade *grade, const struct node *root, const char *file, bool hands,
                         fbd_errors *errors);

/* The start of a model at which diagrams are compared, with all its forces; NULL when memory is out. */
fbd_state *grade_start(const fbd_model *model);

/* Read a tree with derivations that may name forces of the sheet and these others; `take` receives each as an expression. The
 * notes on errors are dropped: they are found again when it is compiled. */
void grade_read_hands(struct fbd_grade *grade, const struct node *root, const char *const *names,
                      size_t name_count, fbd_take_derivation *take, void *context);

/* ---- findings (findings.c); the texts are copied */

/* Add a finding: its position in the answer, its worth and the points earned. */
fbd_finding *finding_add(struct fbd_grade *grade, fbd_finding_kind kind, const char *body, const char *name,
                         struct pos at);
void finding_say(struct fbd_grade *grade, fbd_finding *finding, const char *message);
void finding_tell(struct fbd_grade *grade, fbd_finding *finding, const char *detail);

/* The first error that is not a warning, and a finding with its text. */
const fbd_error *first_error(fbd_errors *errors);
void finding_of_error(struct fbd_grade *grade, fbd_finding_kind kind, const char *body, const char *name,
                      const fbd_error *error);

/* ---- reading (answer.c): the compiled answer without its unreadable parts, which are noted; NULL when no
 * part is left. `root` is its tree. `errors` receives errors that are not the student's: an unreadable file.
 */
struct submission {
    const char *path; /* NULL: the text */
    const char *text;
    size_t length;
};

struct answer {
    const struct node *root; /* without the removed entries */
    fbd_model *model;
    char *text;
};

bool answer_read(struct fbd_grade *grade, const struct submission *submission, struct answer *answer,
                 fbd_errors *errors);
void answer_close(struct answer *answer);

/* Blank the entries that are not valid YAML, each with a finding (mend.c). */
void answer_mend(struct fbd_grade *grade, char *text, size_t length);

/* Convert an answer to a model: its drawings become entries, and an answer with only the additions to the
 * sheet is completed by the sheet; any other is unchanged. NULL when memory is out. `failures`: the key does
 * not give the position of drawings. */
const struct node *answer_take_drawings(struct fbd_grade *grade, const struct node *root,
                                        fbd_errors *failures);

/* The sketch of the entry at this position, or NULL. */
const struct sketch *sketch_at(const struct fbd_grade *grade, struct pos at);

/* Record the drawn entries, and set unknown magnitudes to 1 N or 1 N m (drawn.c). NULL when memory is out. */
const struct node *answer_take_drawn(struct fbd_grade *grade, const struct node *root);

/* The drawn entry at this position, or NULL. */
struct drawn *drawn_at(const struct fbd_grade *grade, struct pos at);

/* The answer's name of a force. */
const char *name_as_drawn(const struct fbd_grade *grade, const fbd_listed_force *force);

/* ---- comparing */

/* Find the reactions of the key that have to be drawn: those that are not zero at the start. False when
 * memory is out. */
bool compare_with_itself(struct fbd_key *key);

/* Forces and moments of all bodies (compare.c), derivations (lines.c). */
void grade_bodies(struct fbd_grade *grade, const fbd_model *answer);
void grade_lines(struct fbd_grade *grade, const struct node *root);

#endif
