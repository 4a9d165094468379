/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Grade: a student's model held against the teacher's by mechanics.
 *
 * Both are compiled and put into the same states: that of the start and random ones. The forces and moments that
 * bodies list are compared there as wrenches about the centre of mass, whatever they are called and however they
 * are written: what is equal at every state is right, and what is left over on both sides is paired with what it
 * was meant to be, so that it can be told how it differs. What follows from the others (normal forces, friction)
 * is compared by its kind, line of action and coefficients, since its magnitude is off as soon as any other force
 * is. Derivations are evaluated on the key's own mechanics (output/hand.h).
 *
 * What cannot be read in an answer is marked and left out, and the rest is graded.
 */
#ifndef FBD_GRADE_GRADE_H
#define FBD_GRADE_GRADE_H

#include "dynamics/modes.h"
#include "fbd_grade.h"
#include "model/model.h"
#include "scene/names.h"
#include "scene/node.h"

enum { most_grade_samples = 32 };

struct fbd_key {
    struct arena arena;
    char *source; /* text of the file */
    size_t length;
    const char *file;
    struct document document;
    fbd_model *model;     /* with the values of the file */
    struct override *set; /* values from outside */
    size_t set_count;
    double most;  /* points */
    size_t lines; /* derivations */
    bool **asked; /* of each body, for each arrow behind those that it lists: has it to be drawn? */
    size_t *asked_count;
};

/* An entry of an answer under `forces` or `moments` that has a name and a value, or has no value. */
struct drawn {
    struct pos at;
    const char *body, *name, *symbol; /* `symbol`: the name for its value, or NULL */
    const char *value;                /* as an expression; NULL where it is unknown */
    bool unknown, free;               /* its magnitude, and its direction */
    bool minus;                       /* unknown: drawn against its direction */
    double size;                      /* of a reaction that is right: its value at the start; else NAN */
    const char *parameter, *unit;     /* of that, where it is varied (statics.c) */
    const char *reaction;             /* that of the key, where it is this one alone; else NULL, */
    struct vec along;                 /* its direction; (0, 0) of a moment, */
    const char *force;                /* and as derivations name it, with a sign: `-pin.x`; else NULL */
    struct drawn *next;
};

/* Where an entry was drawn (drawing.c): at the start, in the world, in units of the key. */
struct sketch {
    struct pos at; /* of the entry */
    const char *body, *name;
    bool couple, clockwise;
    struct vec tail, tip;
    double snap; /* how far its line of action may be off */
    const struct sketch *next;
};

struct finding {
    fbd_finding finding;
    bool reaction; /* it is about a reaction of the key */
    struct finding *next;
};

/* A coordinate that the answer counts otherwise: its own is sign times that of the sheet, and offset. */
struct own_coordinate {
    const char *body;
    const struct coordinate_names *names;
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

    /* while it is being made */
    fbd_model *sheet; /* the key with these values */
    const struct own_coordinate *own;
    struct drawn *drawn;
    const struct sketch *sketches;
    fbd_finding lost; /* what is noted when memory is out: nobody reads it */
};

/* How many reactions of a body have to be drawn. */
size_t key_asks(const struct fbd_key *key, size_t b);

/* A parameter's value for a student, from outside or drawn, as text with its unit; NULL where it is that of the file, or
 * memory is out. */
const char *value_for_student(struct arena *arena, const struct fbd_key *key, const char *name,
                              const char *student);

/* These values for the parameters that a file has. */
size_t drawn_overrides(struct arena *arena, const struct fbd_key *key, const char *student,
                       const struct node *root, struct override **overrides);

/* The key as an answer to itself; NULL when memory is out. */
fbd_grade *grade_itself(const struct fbd_key *key);

/* Compile a tree of an answer or of the key under the student's values. NULL with notes. */
fbd_model *grade_compile(struct fbd_grade *grade, const struct node *root, const char *file, bool hands,
                         fbd_errors *errors);

/* ---- findings (findings.c); the texts are copied */

/* Note one: where it stands in the answer, what it is worth and what was got. */
fbd_finding *finding_add(struct fbd_grade *grade, fbd_finding_kind kind, const char *body, const char *name,
                         struct pos at);
void finding_say(struct fbd_grade *grade, fbd_finding *finding, const char *message);
void finding_tell(struct fbd_grade *grade, fbd_finding *finding, const char *detail);

/* The first note that is no warning, and a finding that says what it says. */
const fbd_error *first_error(fbd_errors *errors);
void finding_of_error(struct fbd_grade *grade, fbd_finding_kind kind, const char *body, const char *name,
                      const fbd_error *error);

/* ---- reading (answer.c): the compiled answer, without what cannot be read of it, which is noted; NULL when
 * nothing is left. `root` is its tree. `errors` has what is no fault of the answer: a file that cannot be read. */
struct submission {
    const char *path; /* NULL: the text */
    const char *text;
    size_t length;
};

struct answer {
    struct document document;
    const struct node *root; /* without what was left out */
    fbd_model *model;
    char *text;
};

bool answer_read(struct fbd_grade *grade, const struct submission *submission, struct answer *answer,
                 fbd_errors *errors);
void answer_close(struct answer *answer);

/* Blank the entries for which YAML cannot read a text, each with a finding (mend.c). */
void answer_mend(struct fbd_grade *grade, char *text, size_t length);

/* An answer as a model: the drawings in it become entries, and one that says only what was added to the sheet gets the
 * rest of it; any other as it is. NULL when memory is out. `failures`: the key does not say where drawings lie. */
const struct node *answer_take_drawings(struct fbd_grade *grade, const struct node *root,
                                        fbd_errors *failures);

/* The sketch of the entry at this place, or NULL. */
const struct sketch *sketch_at(const struct fbd_grade *grade, struct pos at);

/* Note the drawn entries, and give unknown magnitudes 1 N or 1 N m (drawn.c). NULL when memory is out. */
const struct node *answer_take_drawn(struct fbd_grade *grade, const struct node *root);

/* The drawn entry at this place, or NULL. */
struct drawn *drawn_at(const struct fbd_grade *grade, struct pos at);

/* The answer's name of a force. */
const char *name_as_drawn(const struct fbd_grade *grade, const struct load *load);

/* ---- comparing */

/* Which reactions of the key have to be drawn: those that are not zero at the start. False when memory is out. */
bool compare_with_itself(struct fbd_key *key);

/* Forces and moments of all bodies (compare.c), derivations (lines.c). */
void grade_bodies(struct fbd_grade *grade, const fbd_model *answer);
void grade_lines(struct fbd_grade *grade, const struct node *root);

#endif
