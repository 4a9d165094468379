/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: derivations of a model, compared with its mechanics one by one.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/state.h"
#include "fbd_grade.h"
#include "output/equations.h"
#include "output/hand.h"

struct fbd_checker {
    struct hand_check check;
    gsl_rng *rng;
    const struct hand *hand;
    struct text verdict; /* on a line that is compared with a run */
    struct arena slopes;
    bool sampled; /* the check has samples of the last derivation */
};

/* ---- the contents of a model */

size_t fbd_model_derivation_count(const fbd_model *model, size_t body)
{
    return model && body < model->body_count ? model->scene->bodies[body].hand_count : 0;
}

fbd_derivation fbd_model_derivation(const fbd_model *model, size_t body, size_t index)
{
    if (index >= fbd_model_derivation_count(model, body)) return (fbd_derivation){.written = NULL};
    const struct hand *hand = &model->scene->bodies[body].hands[index];
    return (fbd_derivation){.written = hand->written,
                            .text = hand->text,
                            .line = hand->at.line,
                            .column = hand->at.column,
                            .of_run = hand->kind != hand_of_states};
}

fbd_residual fbd_state_residual(fbd_state *state, size_t body, size_t index)
{
    _Static_assert((int)FBD_UNKNOWNS == (int)hand_unknowns, "the unknowns of an equation");
    fbd_residual residual = {.value = NAN, .size = NAN};
    for (size_t k = 0; k < FBD_UNKNOWNS; k++) residual.slopes[k] = NAN;
    const fbd_derivation derivation = fbd_model_derivation(state ? state->model : NULL, body, index);
    if (!derivation.written || derivation.of_run) return residual;
    state_ready(state);
    residual.value = hand_lack_at(state, (int)body, (int)index, &residual.size, residual.slopes);
    return residual;
}

/* ---- comparison */

fbd_checker *fbd_checker_new(void)
{
    fbd_checker *checker = calloc(1, sizeof *checker);
    if (!checker) return NULL;
    checker->rng = gsl_rng_alloc(gsl_rng_mt19937);
    checker->check.samples = calloc(most_samples, sizeof *checker->check.samples);
    if (checker->rng && checker->check.samples) return checker;
    fbd_checker_free(checker);
    return NULL;
}

void fbd_checker_free(fbd_checker *checker)
{
    if (!checker) return;
    free(checker->check.samples);
    if (checker->rng) gsl_rng_free(checker->rng);
    text_free(&checker->verdict);
    arena_free(&checker->slopes);
    free(checker);
}

static void count_samples(const struct hand_check *check, double tolerance, fbd_comparison *comparison)
{
    for (size_t i = 0; i < check->count; i++) {
        const struct hand_sample *sample = &check->samples[i];
        int slip = sample->slip + 1;
        comparison->states[slip]++;
        double size = tolerance > 1e-6 ? sample->mechanics : sample->size; /* rounding, or rounded numbers */
        comparison->agree[slip] +=
            !check->elsewhere[0] && isfinite(size) && fabs(sample->lack) <= tolerance * size;
    }
}

/* The unknowns of a line as a set: accelerations, and forces if it names some or has no accelerations. */
static unsigned long long set_of(const struct hand_check *check)
{
    enum { behind_names = 16 };
    const unsigned names = check->says, accelerations = names & (unsigned)FBD_NAMES_ACCELERATIONS;
    const unsigned long long forces = check->unknowns >> hand_unknown_force;
    if (accelerations && !(names & (unsigned)FBD_NAMES_FORCES)) return accelerations;
    if (forces) return accelerations | forces << behind_names;
    return accelerations ? accelerations : names; /* inertia and arms */
}

static bool compare_at_states(fbd_checker *checker, double spread, double tolerance,
                              fbd_comparison *comparison)
{
    _Static_assert((int)FBD_NAMES_OTHERS == (int)hand_others &&
                       (int)FBD_NAMES_FORCES == (int)hand_named_forces &&
                       (int)FBD_NAMES_NORMAL == 1 << hand_N &&
                       (int)hand_mass == (int)most_coordinates_of_a_body,
                   "the names of a derivation");
    struct hand_check *check = &checker->check;
    const struct fbd_model *model = check->model;
    const struct document document = {.file = model->scene->file, .root = model->root, .split_hands = true};
    comparison->compared = diagram_arrows(model, check->body) < most_terms;
    if (!comparison->compared) return true;
    if (!hand_take_samples(check, &document, checker->rng, spread)) return false;
    checker->sampled = true;
    comparison->names = check->says;
    comparison->unknowns = set_of(check);
    count_samples(check, tolerance, comparison);
    return true;
}

static bool compare_with_run(fbd_checker *checker, fbd_comparison *comparison)
{
    const struct hand_check *check = &checker->check;
    struct hand_run run = {.model = NULL};
    double *slopes;
    fbd_errors *errors = fbd_errors_new();
    bool made = errors && hand_run_make(&run, check->model, errors);
    bool done = errors && !errors->out_of_memory;
    comparison->compared = comparison->of_run = true;
    comparison->states[1] = 1;
    comparison->agree[1] = made && hand_run_judge(&run, check->body, checker->hand, &checker->verdict);
    if (!made) text_add(&checker->verdict, "  there is no run of the model\n");
    comparison->slope_count = hand_run_slopes(&run, check->body, checker->hand, &checker->slopes, &slopes);
    comparison->slopes = slopes;
    for (size_t i = 0; i < comparison->slope_count; i++)
        if (slopes[i] != 0) comparison->names = FBD_NAMES_RUN;
    comparison->unknowns = comparison->names;
    done = done && !checker->verdict.failed && !run.no_memory && !checker->slopes.failed;
    hand_run_free(&run);
    fbd_errors_free(errors);
    return done;
}

bool fbd_checker_compare(fbd_checker *checker, const fbd_model *model, size_t body, size_t index,
                         double spread, double tolerance, fbd_comparison *comparison)
{
    if (comparison) memset(comparison, 0, sizeof *comparison);
    const bool here = index < fbd_model_derivation_count(model, body);
    if (!checker || !comparison || !here || !model->root || !(spread >= 0 && spread < 1) || !(tolerance >= 0))
        return false;
    checker->check.model = model;
    checker->check.body = (int)body;
    checker->check.index = (int)index;
    checker->hand = &model->scene->bodies[body].hands[index];
    text_free(&checker->verdict);
    arena_free(&checker->slopes);
    checker->sampled = false;
    return checker->hand->kind == hand_of_states ? compare_at_states(checker, spread, tolerance, comparison)
                                                 : compare_with_run(checker, comparison);
}

char *fbd_checker_mistake(const fbd_checker *checker, int slip)
{
    struct text text = {0};
    if (!checker || !checker->hand) return NULL;
    text_add(&text, checker->verdict.data ? checker->verdict.data : "");
    if (checker->sampled) hand_diagnose(&checker->check, slip, &text);
    if (text.failed) text_free(&text);
    return text.data;
}
