/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_grade: derivations by hand compared with the assembly, and answers of students compared with a key. The rules of
 * fbd.h apply.
 */
#ifndef FBD_GRADE_H
#define FBD_GRADE_H

#include "fbd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- derivations by hand */

/* Compare every `hand:` derivation of the model with the assembly at many random admissible states (and
 * parameters; the seed is printed), and lines of energy and momentum with one run of the model. Returns a
 * text that confirms each one or shows the differing terms; *differing (may be NULL) is the number of
 * equations that differ. NULL when memory is out. */
FBD_API char *fbd_check_hand(const fbd_model *model, unsigned seed, size_t *differing);

/* ---------------------------------------------------------------- grading */

/* A teacher's model with which answers are compared: its forces, moments and derivations are the correct
 * ones, its `grading` gives their marks. */
typedef struct fbd_key fbd_key;

/* Read a key. NULL with notes in `errors`: those of a wrong model file, and `nothing-to-grade`. */
FBD_API fbd_key *fbd_key_read(const char *path, fbd_errors *errors);

/* As fbd_key_read with parameter values from outside, for example of a learning platform that draws its own:
 * in sheets and answers they replace those of the file, and those drawn by `grading: {draw: ...}`. */
FBD_API fbd_key *fbd_key_read_set(const char *path, const fbd_setting *settings, size_t setting_count,
                                  fbd_errors *errors);

/* As fbd_key_read_set, from a text; `name` is its name in messages, or NULL. */
FBD_API fbd_key *fbd_key_parse(const char *text, size_t length, const char *name, const fbd_setting *settings,
                               size_t setting_count, fbd_errors *errors);
FBD_API void fbd_key_free(fbd_key *key);

/* If the file of a model has `grading`, check it as a key: the notes of fbd_key_read about marks
 * (`key-differs`, `nothing-to-grade`) go to `errors`. True for a key that can be graded, and for every model
 * without `grading`; false with a note. */
FBD_API bool fbd_model_check_key(const fbd_model *model, fbd_errors *errors);

/* The sheet for a student, as a model file: the scene without forces, moments, derivations and comments, with
 * the values that `grading: {draw: ...}` draws for the name of this student. To be freed with fbd_free; NULL
 * with a note in `errors` when memory is out. */
FBD_API char *fbd_key_handout(const fbd_key *key, const char *student, fbd_errors *errors);

/* The same sheet with the solution: the entries of the key, its derivations, the required reactions with
 * their values at the start, and the equations of all bodies in comments. As an answer it gets all points. */
FBD_API char *fbd_key_solution(const fbd_key *key, const char *student, fbd_errors *errors);

typedef enum fbd_finding_kind {
    FBD_FINDING_RIGHT,
    FBD_FINDING_MISSING,     /* a force or moment, or a derivation, is missing */
    FBD_FINDING_SUPERFLUOUS, /* a listed force or moment does not act on the body */
    FBD_FINDING_PLACE,       /* wrong line of action */
    FBD_FINDING_DIRECTION,
    FBD_FINDING_SENSE, /* it points the opposite way */
    FBD_FINDING_MAGNITUDE,
    FBD_FINDING_UNIT,            /* its magnitude is wrong by a factor between units */
    FBD_FINDING_COEFFICIENT,     /* of friction */
    FBD_FINDING_INERTIA,         /* mass, centre of mass or moment of inertia */
    FBD_FINDING_REFERENCE_POINT, /* a moment of inertia is about another point */
    FBD_FINDING_MOTION,          /* a body has another kind of motion */
    FBD_FINDING_BODY,            /* a body is missing, or superfluous */
    FBD_FINDING_UNREADABLE,      /* an entry cannot be read */
    FBD_FINDING_DERIVATION,      /* it contradicts mechanics, or holds for any forces */
    FBD_FINDING_NO_SUBMISSION,
} fbd_finding_kind;

/* "right", "missing", "superfluous", "place", "direction", "sense", "magnitude", "unit", "coefficient",
 * "inertia", "reference_point", "motion", "body", "unreadable", "derivation", "no_submission"; "" for other
 * values */
FBD_API const char *fbd_finding_kind_name(fbd_finding_kind kind);

/* One part of an answer. `message` names only things that the student wrote, and may be shown; `detail` names
 * the key's. */
typedef struct fbd_finding {
    fbd_finding_kind kind;
    const char *body, *name; /* "" where there is none */
    int line, column;        /* in the answer, 0 if there is no position */
    double points, most;     /* points given (negative: subtracted), and the maximum */
    const char *message, *detail;
} fbd_finding;

typedef struct fbd_grade fbd_grade;

/* Compare an answer with a key by mechanics. `student` determines the drawn values; NULL takes the name of
 * the file, without folders and `.yaml`. A missing answer, or one that is no model, has no points. NULL with
 * a note in `errors`: the file exists but cannot be read (`cannot-read`), or memory is out. The key must
 * outlive the grade. */
FBD_API fbd_grade *fbd_grade_new(const fbd_key *key, const char *path, const char *student,
                                 fbd_errors *errors);

/* As fbd_grade_new, for an answer given as text. `student` is its name in the output. */
FBD_API fbd_grade *fbd_grade_parse(const fbd_key *key, const char *text, size_t length, const char *student,
                                   fbd_errors *errors);
FBD_API void fbd_grade_free(fbd_grade *grade);

/* Points of the answer, at least 0, and the maximum. */
FBD_API double fbd_grade_points(const fbd_grade *grade);
FBD_API double fbd_grade_most(const fbd_grade *grade);

/* True if there is an answer and its points suffice. */
FBD_API bool fbd_grade_passed(const fbd_grade *grade);

FBD_API size_t fbd_grade_finding_count(const fbd_grade *grade);
FBD_API fbd_finding fbd_grade_finding(const fbd_grade *grade, size_t index);

/* As text, and as one JSON object (docs/grading.md); with `details` also the findings that name the key's
 * forces. To be freed with fbd_free; NULL when memory is out. */
FBD_API char *fbd_grade_text(const fbd_grade *grade, bool details);
FBD_API char *fbd_grade_json(const fbd_grade *grade, bool details);

/* The sheet of a student as one HTML file to draw on: the bodies cut free; forces and moments are drawn by
 * mouse, finger or keyboard, derivations are typed. The drawing is saved as the answer that fbd_grade_new
 * reads. With `exam` the page contains nothing of the key; without it, it contains the key and the library,
 * and grades. To be freed with fbd_free; NULL with a note in `errors`: `no-sheet` (the key without its
 * solution is no model), `not-finite`, `no-live` (without `exam`: not fbd_has_live()), `no-page` (built
 * without pages), or memory is out. */
FBD_API char *fbd_key_page(const fbd_key *key, const char *student, bool exam, fbd_errors *errors);

#ifdef __cplusplus
}
#endif

#endif
