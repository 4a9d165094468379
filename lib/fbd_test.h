/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_test: unit tests of derivations by hand, on top of fbd.h. Each check returns whether model and
 * derivation agree, for use in `assert`, in cmocka's assert_true or in an exit code; if they differ, it
 * prints the quantity, the state and the difference to standard error.
 *
 *     static fbd_expected by_hand(const double x[])
 *     {
 *         return (fbd_expected){.coordinate = "theta", .acceleration = -9.81 / 0.5 * sin(x[0])};
 *     }
 *     assert(fbd_check_derivation("pendulum.yaml", (fbd_range[]){{"theta", -3, 3}, {0}}, by_hand));
 *
 * `assert` is empty where NDEBUG is defined (CMake's build type Release does): undefine it before assert.h is
 * included. A model is the path of a file, or the text of one; a string with a line break is a text. Units
 * are those of fbd.h.
 */
#ifndef FBD_TEST_H
#define FBD_TEST_H

#include "fbd.h"
#include "fbd_grade.h"

#include <string.h>

enum { fbd_test_room = 16 };

/* An equation derived by hand, at a state: inertia * acceleration = sum of terms. The comparison covers the
 * acceleration always; with an inertia the whole equation, that is inertia, sum, normal force and every term,
 * where terms of the model that are not listed must be zero; without an inertia only the listed terms. */
typedef struct fbd_expected {
    /* the state: names as in fbd_state_set, "theta" if there is one body; others keep their values */
    fbd_term at[fbd_test_room];
    /* "pendulum.theta"; "theta" if one body has it; "block.G.x": of the body cut free */
    const char *coordinate;
    double inertia;                /* 0: not derived */
    fbd_term terms[fbd_test_room]; /* by the names of the forces and moments */
    double acceleration;           /* by a separate formula, not as sum / inertia */
    double normal;                 /* on a slide */
    double tolerance;              /* relative to the largest term; 0 stands for 1e-12 */
} fbd_expected;

/* A coordinate, rate or time, and the range that it is drawn from. */
typedef struct fbd_range {
    const char *name;
    double low, high;
} fbd_range;

/* A derivation: its equation at the state x, whose values are in the order of the ranges. */
typedef fbd_expected fbd_by_hand(const double x[]);

/* |got - want| <= tolerance; false also for NaN. `where` is printed before `what`. */
static inline bool fbd_check_close(const char *where, const char *what, double got, double want,
                                   double tolerance)
{
    if (fabs(got - want) <= tolerance) return true;
    fprintf(stderr, "# %s: %s: fbd has %.17g, by hand %.17g, off by %.3g; tolerance %.3g\n", where, what, got,
            want, fabs(got - want), tolerance);
    return false;
}

/* Count the names of a list, which ends at the first NULL. */
static inline size_t fbd_test_count(const fbd_term list[fbd_test_room])
{
    size_t count = 0;
    while (count < fbd_test_room && list[count].name) count++;
    return count;
}

/* Set a state to `at` and make it admissible as the start of a run. */
static inline bool fbd_test_place(fbd_state *state, const fbd_term at[fbd_test_room])
{
    fbd_errors *errors = fbd_errors_new();
    bool placed = true;
    size_t count = fbd_test_count(at);
    for (size_t i = 0; placed && i < count; i++) {
        char value[40];
        snprintf(value, sizeof value, "%.17g", at[i].value);
        placed = fbd_state_set_text(state, at[i].name, value, errors);
    }
    if (placed && count > 0) placed = fbd_state_close(state, errors);
    fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    return placed;
}

/* The equation of "pendulum.theta", or of the only body with a coordinate "theta"; otherwise one with body
 * NULL. */
static inline fbd_equation fbd_test_find(const fbd_equations *all, const char *coordinate)
{
    fbd_equation found = fbd_equations_find(all, coordinate);
    size_t count = found.body ? 1 : 0;
    for (size_t i = 0; !found.body && i < fbd_equations_count(all); i++)
        count += strcmp(fbd_equations_get(all, i).coordinate, coordinate) == 0;
    for (size_t i = 0; count == 1 && !found.body; i++)
        if (strcmp(fbd_equations_get(all, i).coordinate, coordinate) == 0) found = fbd_equations_get(all, i);
    if (count > 1)
        fprintf(stderr, "# %s: %zu bodies have one; write body.%s\n", coordinate, count, coordinate);
    else if (count == 0)
        fprintf(stderr, "# %s: there is no equation of it\n", coordinate);
    return found;
}

static inline double fbd_test_value(const fbd_expected *want, const char *name)
{
    size_t count = fbd_test_count(want->terms);
    for (size_t i = 0; i < count; i++)
        if (strcmp(want->terms[i].name, name) == 0) return want->terms[i].value;
    return 0;
}

/* Each term by hand exists in the equation with the same value; for a whole equation also the converse. */
static inline bool fbd_test_terms(const fbd_equation *got, const fbd_expected *want, double tolerance)
{
    bool agree = true;
    size_t count = fbd_test_count(want->terms);
    for (size_t i = 0; i < count; i++) {
        double value = fbd_equation_term(got, want->terms[i].name);
        if (isnan(value)) {
            fprintf(stderr, "# %s: it has no term `%s`\n", want->coordinate, want->terms[i].name);
            agree = false;
        } else
            agree &= fbd_check_close(want->coordinate, want->terms[i].name, value, want->terms[i].value,
                                     tolerance);
    }
    for (size_t i = 0; want->inertia != 0 && i < got->term_count; i++)
        if (fbd_test_value(want, got->terms[i].name) == 0)
            agree &= fbd_check_close(want->coordinate, got->terms[i].name, got->terms[i].value, 0, tolerance);
    return agree;
}

static inline bool fbd_test_compare(const fbd_equation *got, const fbd_expected *want)
{
    const double relative = want->tolerance > 0 ? want->tolerance : 1e-12;
    double size = fabs(want->normal), sum = 0;
    for (size_t i = 0; i < got->term_count; i++) size = fmax(size, fabs(got->terms[i].value));
    size_t count = fbd_test_count(want->terms);
    for (size_t i = 0; i < count; i++) sum += want->terms[i].value;
    bool agree = fbd_test_terms(got, want, relative * size);
    if (want->inertia != 0) {
        agree &= fbd_check_close(want->coordinate, "inertia", got->inertia, want->inertia,
                                 relative * fabs(want->inertia));
        agree &= fbd_check_close(want->coordinate, "sum of terms", got->sum, sum, relative * size);
        agree &=
            fbd_check_close(want->coordinate, "normal force", got->normal, want->normal, relative * size);
    }
    agree &= fbd_check_close(want->coordinate, got->acceleration_name, got->acceleration, want->acceleration,
                             relative * fmax(size / got->inertia, fabs(want->acceleration)));
    return agree;
}

/* Compare one equation at the state, which is first set to `want->at`. */
static inline bool fbd_check_equation(fbd_state *state, const fbd_expected *want)
{
    size_t count = fbd_test_count(want->at);
    bool agree = false;
    fbd_equations *all = fbd_test_place(state, want->at) ? fbd_assemble_components(state) : NULL;
    if (all) {
        const fbd_equation got = fbd_test_find(all, want->coordinate);
        agree = got.body && fbd_test_compare(&got, want);
    }
    fbd_equations_free(all);
    if (agree) return true;
    fprintf(stderr, "# that was %s", count > 0 ? "at" : "at the state as it was");
    for (size_t i = 0; i < count; i++) fprintf(stderr, " %s = %.17g", want->at[i].name, want->at[i].value);
    fputs("\n", stderr);
    return false;
}

/* The model of a path or text; NULL when it is wrong, with the notes printed. */
static inline fbd_model *fbd_test_model(const char *model)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *read = strchr(model, '\n') ? fbd_model_parse(model, strlen(model), "model", NULL, 0, errors)
                                          : fbd_model_read(model, NULL, 0, errors);
    fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    return read;
}

/* Compare a table of `count` equations, each at its state (`at`); all rows are compared. An empty table
 * fails. */
static inline bool fbd_check_table(const char *model, const fbd_expected *rows, size_t count)
{
    fbd_model *read = fbd_test_model(model);
    bool agree = read && count > 0;
    for (size_t i = 0; read && i < count; i++) {
        fbd_state *state = fbd_state_new(read); /* values that a row does not set are those of the file */
        agree &= state && fbd_check_equation(state, &rows[i]);
        fbd_state_free(state);
    }
    fbd_model_free(read);
    return agree;
}

/* Compare a derivation at 100 states drawn from `ranges`, a list that ends with an entry without a name;
 * stops at the first state at which it differs. The states are the same in every run. */
static inline bool fbd_check_derivation(const char *model, const fbd_range *ranges, fbd_by_hand *by_hand)
{
    unsigned long long draw = 1;
    size_t count = 0;
    while (count < fbd_test_room && ranges[count].name) count++;
    fbd_model *read = fbd_test_model(model);
    fbd_state *state = read ? fbd_state_new(read) : NULL;
    bool agree = state && count > 0;
    for (int i = 0; agree && i < 100; i++) {
        double x[fbd_test_room] = {0};
        for (size_t k = 0; k < count; k++) {
            draw = draw * 6364136223846793005ULL + 1442695040888963407ULL;
            x[k] = ranges[k].low +
                   (ranges[k].high - ranges[k].low) * ((double)(draw >> 11) / 9007199254740992.0);
        }
        fbd_expected want = by_hand(x);
        for (size_t k = 0; k < count; k++) {
            want.at[k].name = ranges[k].name;
            want.at[k].value = x[k];
        }
        agree = fbd_check_equation(state, &want);
    }
    fbd_state_free(state);
    fbd_model_free(read);
    return agree;
}

/* Compare the lines that the model lists under `hand`, at many states (see fbd_check_hand). A model without
 * any fails. */
static inline bool fbd_check_lines(const char *model)
{
    fbd_model *read = fbd_test_model(model);
    size_t differing = 1;
    char *text = read ? fbd_check_hand(read, 1, &differing) : NULL;
    bool agree = text && differing == 0 && strncmp(text, "no body carries", 15) != 0;
    if (text && !agree) fprintf(stderr, "%s", text);
    fbd_free(text);
    fbd_model_free(read);
    return agree;
}

#endif
