/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_grade: derivations by hand compared with the assembly, and answers of students compared with a key; and the contents of
 * model files that other graders need. The rules of fbd.h apply.
 */
#ifndef FBD_GRADE_H
#define FBD_GRADE_H

#include "fbd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- models with entries of other files */

/* A model file as a tree of its YAML with the position of each value, so that a model with entries of another file has notes
 * at their positions there. */
typedef struct fbd_document fbd_document;

/* Parse a text, which is copied. `name` is its name in messages, or NULL. NULL with notes in `errors` when it is no YAML, or
 * memory is out. */
FBD_API fbd_document *fbd_document_parse(const char *text, size_t length, const char *name,
                                         fbd_errors *errors);
FBD_API void fbd_document_free(fbd_document *document);

/* Replace the value at a path of `count` keys, as {"bodies", "block", "hand"}, by that of another document, which must outlive
 * this one; it is removed where the other one has none. Returns false, and changes nothing, if the last key is in no mapping
 * here, or memory is out. */
FBD_API bool fbd_document_take(fbd_document *document, const fbd_document *from, const char *const *path,
                               size_t count);

/* Compile a document as fbd_model_parse does a text, without its derivations unless `derivations`. fbd_model_source of the
 * model is empty; for fbd_check_hand the document must live. */
FBD_API fbd_model *fbd_model_parse_document(const fbd_document *document, const fbd_setting *settings,
                                            size_t setting_count, bool derivations, fbd_errors *errors);

/* Receives the expressions that a text of a derivation is read as, with its position in the document. */
typedef void fbd_take_derivation(void *context, int line, int column, const char *text);

/* Read the derivations of a document in the notation of textbooks, without a model of it: they may name the forces of `model`,
 * and forces that it does not have by one of `names`. Texts that are expressions already, or cannot be read, are left out.
 * Returns false when memory is out. */
FBD_API bool fbd_document_derivations(const fbd_document *document, const fbd_setting *settings,
                                      size_t setting_count, const fbd_model *model, const char *const *names,
                                      size_t name_count, fbd_take_derivation *take, void *context);

/* True for a name that a file may give to a parameter or force: letters, digits and `_`, and not reserved as `t` or `x`. */
FBD_API bool fbd_is_name(const char *name);

/* ---------------------------------------------------------------- derivations by hand */

/* Compare every `hand:` derivation of the model with the assembly at many random admissible states (and
 * parameters; the seed is printed), and lines of energy and momentum with one run of the model. Returns a
 * text that confirms each one or shows the differing terms; *differing (may be NULL) is the number of
 * equations that differ. NULL when memory is out. */
FBD_API char *fbd_check_hand(const fbd_model *model, unsigned seed, size_t *differing);

/* A derivation of a body. Texts live as long as the model; NULL past the last one. */
typedef struct fbd_derivation {
    const char *written; /* as in the file */
    const char *text;    /* the expressions that it is read as */
    int line, column;
    /* it is compared with a run: it is a conserved quantity, or names initial values, works, impulses or an impact */
    bool of_run;
} fbd_derivation;

FBD_API size_t fbd_model_derivation_count(const fbd_model *model, size_t body);
FBD_API fbd_derivation fbd_model_derivation(const fbd_model *model, size_t body, size_t index);

/* A derivation at a state: left - right, the sum of the magnitudes of its terms, and the derivatives of left - right by its
 * unknowns: the accelerations of its body's coordinates, those of others together, each component and couple of a force of a
 * diagram. If there are too many of them several share a number. All are NAN past the last derivation, and when memory is
 * out. */
enum { FBD_UNKNOWNS = 32 };

typedef struct fbd_residual {
    double value, size, slopes[FBD_UNKNOWNS];
} fbd_residual;

FBD_API fbd_residual fbd_state_residual(fbd_state *state, size_t body, size_t index);

/* Compares derivations with the mechanics of their models. */
typedef struct fbd_checker fbd_checker;

/* With a sequence of random numbers that is always the same. NULL when memory is out. */
FBD_API fbd_checker *fbd_checker_new(void);
FBD_API void fbd_checker_free(fbd_checker *checker);

/* Unknowns of a derivation beside coordinates 0, 1, 2 of its body, as bits of fbd_comparison.names. */
enum {
    FBD_NAMES_NORMAL = 1 << 7,  /* N */
    FBD_NAMES_OTHERS = 1 << 10, /* accelerations of other bodies or of points */
    FBD_NAMES_FORCES = 1 << 11, /* forces of diagrams by their names */
    FBD_NAMES_RUN = 1 << 12,    /* it is compared with a run, and not true for all velocities */
    FBD_NAMES_ACCELERATIONS = 7 | FBD_NAMES_OTHERS,
};

typedef struct fbd_comparison {
    bool compared; /* false for a body with too many forces (40) */
    /* states at which it was evaluated, and those at which it is true, by the sense in which friction of the body slips:
     * [0] against +x, [1] not, or without friction, [2] along +x. The whole run counts as one */
    size_t states[3], agree[3];
    unsigned names; /* bits: the quantities that it depends on; 0 for an identity */
    /* its unknowns as a set: two derivations are about the same ones if these are equal, and have some in common if they
     * share a bit */
    unsigned long long unknowns;
    /* of a derivation that is compared with a run: derivatives of left - right by the velocities at times of the run, which
     * are proportional for equivalent ones. They live until the next comparison */
    bool of_run;
    size_t slope_count;
    const double *slopes;
} fbd_comparison;

/* Compare a derivation with its model, which was compiled with derivations from a document that still exists: at random
 * admissible states of it and of eleven models whose parameters differ by up to the fraction `spread`, or with a run. It is
 * true at a state if left - right is at most `tolerance` times the sum of the magnitudes of its terms; for tolerances above
 * 1e-6 those are the terms of the assembly. The model must exist until the next comparison. Returns false when memory is
 * out. */
FBD_API bool fbd_checker_compare(fbd_checker *checker, const fbd_model *model, size_t body, size_t index,
                                 double spread, double tolerance, fbd_comparison *comparison);

/* Where the derivation of the last comparison differs, at states with this sense of slip (-1, 0, 1), and by which mistake, if
 * one explains all of them. NULL when memory is out. */
FBD_API char *fbd_checker_mistake(const fbd_checker *checker, int slip);

/* ---------------------------------------------------------------- the marks of a file */

/* A parameter with an individual value for each student: a number in [low, high] with this unit. */
typedef struct fbd_drawn_parameter {
    const char *name;
    double low, high;
    const char *unit;
    int line, column;
} fbd_drawn_parameter;

typedef struct fbd_marks {
    double force, inertia, derivation, superfluous; /* of each; the last one is subtracted */
} fbd_marks;

/* Position and scale of drawings of answers in the scene. */
typedef struct fbd_canvas {
    double origin[2]; /* origin of the scene, in units of the drawing */
    double unit;      /* length of a unit of the drawing; 0: not given */
    double angle;     /* tolerance of a direction [rad] */
    /* largest distance between lines of action that counts as none, in units of the drawing; 0: 10 pixels, 0.2 in Meclib */
    double snap;
} fbd_canvas;

typedef enum fbd_required {
    FBD_REACTIONS_ALL,
    FBD_REACTIONS_NONE,
    FBD_REACTIONS_NAMED,
} fbd_required;

/* How answers are graded with a file as the key: `grading`, or its defaults. Texts and lists live as long as the model. */
typedef struct fbd_grading {
    bool given;
    size_t draw_count;
    const fbd_drawn_parameter *draws;
    int digits;                      /* decimal digits of drawn values */
    double tolerance, partial, pass; /* fractions */
    fbd_marks points;
    fbd_canvas canvas;
    fbd_required reactions; /* the reactions that have to be drawn, */
    bool reactions_given;   /* by the file, */
    size_t reaction_count;  /* and their names: of couplings, or of their forces in a diagram */
    const char *const *reaction_names;
} fbd_grading;

/* All zero without a model. */
FBD_API fbd_grading fbd_model_grading(const fbd_model *model);

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
