/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Every model of the gallery runs as it stands: it opens without a note, says what it is, agrees with its
 * derivations by hand, and keeps its energy account.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_grade.h"
#include "gallery.h"

#include <stdlib.h>
#include <string.h>

enum { most_path = 512 };

static void check_words(struct checks *checks, const char *path)
{
    char file[2 * most_path], line[most_path] = "", what[2 * most_path];
    const char *root = getenv("FBD_SOURCE_ROOT");
    snprintf(file, sizeof file, "%s/models/%s", root ? root : ".", path);
    FILE *stream = fopen(file, "r");
    assert_non_null(stream);
    const char *first = fgets(line, sizeof line, stream);
    fclose(stream);
    snprintf(what, sizeof what, "%s starts with a comment: what the system is", path);
    check_that(checks, what, first && strncmp(line, "# ", 2) == 0);
    struct trial trial = trial_open(path, NULL);
    snprintf(what, sizeof what, "%s has a title", path);
    check_that(checks, what, fbd_model_title(trial.model)[0] != '\0');
    trial_close(&trial);
}

static void every_model_opens_and_says_what_it_is(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    size_t count = each_model(&checks, check_words);
    assert_in_range(count, 25, 1000);
    checks_end(&checks);
}

static bool is_static(const char *path)
{
    return strncmp(path, "statics/", 8) == 0;
}

/* Why some have no equation of motion to derive in one line:
 * statics/ does not move, and its reactions are derived in test_statics; the others are held against
 * published or independent numbers (test_reference_couplings, test_reference_trees). What bodies in contact
 * do goes by cases: test_contacts. */
static bool has_derivation(const char *path)
{
    if (strcmp(path, "contact/conveyor_belt.yaml") == 0) return true; /* of its slip, with `when` */
    if (strcmp(path, "statics/loaded_beam.yaml") == 0) return true;   /* of the force of its link */
    if (strcmp(path, "statics/beam.yaml") == 0) return true;          /* of its section forces */
    if (strcmp(path, "statics/cantilever.yaml") == 0) return true;
    return !is_static(path) && strncmp(path, "contact/", 8) != 0 &&
           strcmp(path, "couplings/andrews_squeezer.yaml") != 0 &&
           strcmp(path, "trees/chain_of_ten_rods.yaml") != 0;
}

static void check_derivations(struct checks *checks, const char *path)
{
    struct trial trial = trial_open(path, NULL);
    for (unsigned seed = 1; seed <= 3; seed++) {
        char what[2 * most_path];
        size_t wrong = 1;
        char *text = fbd_check_hand(trial.model, seed, &wrong);
        snprintf(what, sizeof what, "%s agrees with its derivation, seed %u:\n%s", path, seed,
                 text ? text : "");
        check_that(checks, what, wrong == 0);
        snprintf(what, sizeof what, "%s has a derivation, or none, as the test says", path);
        check_that(checks, what, text && (strstr(text, "agrees at") != NULL) == has_derivation(path));
        free(text);
    }
    trial_close(&trial);
}

static void every_model_agrees_with_its_derivation_by_hand(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    each_model_in_turn(&checks, 0, check_derivations);
    checks_end(&checks);
}

/* The size of what the account is about: the largest energy, or work of a force, at the end or the start. */
static double turned_over(struct trial *trial)
{
    fbd_energy energy = fbd_result_energy(trial->result);
    double size = fmax(fabs(energy.kinetic), fabs(energy.initial_kinetic));
    size = fmax(size, fmax(fabs(energy.potential), fabs(energy.initial_potential)));
    fbd_equations *all = fbd_assemble(trial->state);
    assert_non_null(all);
    for (size_t i = 0; i < fbd_equations_count(all); i++) {
        const fbd_equation equation = fbd_equations_get(all, i);
        for (size_t k = 0; k < equation.term_count; k++)
            size = fmax(size, fabs(fbd_result_work(trial->result, equation.body, equation.terms[k].name)));
    }
    fbd_equations_free(all);
    return size;
}

static void check_run(struct checks *checks, const char *path)
{
    char what[2 * most_path];
    struct trial trial = trial_open(path, NULL);
    trial_run(&trial, NULL);
    fbd_energy energy = fbd_result_energy(trial.result);
    snprintf(what, sizeof what, "%s runs to its end: %s", path, fbd_simulation_reason(trial.simulation));
    check_that(checks, what, trial.outcome == FBD_DONE || trial.outcome == FBD_STOPPED);
    snprintf(what, sizeof what, "%s: residual", path);
    /* Ten tolerances in each of up to some 500 steps; what does not move has roundings under a kilonewton. */
    double tolerance = fbd_simulation_stats(trial.simulation).tolerance;
    double rounding = is_static(path) ? 1e-10 : 0;
    check_close(checks, what, energy.residual, 0, 5e3 * tolerance * turned_over(&trial) + rounding);
    trial_close(&trial);
}

static void every_model_runs_to_its_end_and_keeps_its_energy_account(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    each_model(&checks, check_run);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_model_opens_and_says_what_it_is),
        cmocka_unit_test(every_model_agrees_with_its_derivation_by_hand),
        cmocka_unit_test(every_model_runs_to_its_end_and_keeps_its_energy_account),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
