/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The implicit methods beside GSL's own step types of the same names, under the same error control, over all
 * models given: the error at the end of the run by each, in units of the largest size of each coordinate and
 * rate, against `auto` at a tolerance of 1e-13.
 *
 * Usage: bench_implicit [-v] MODEL...
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fbd.h"
#include "loop/ensemble.h"
#include "model/model.h"
#include "timing.h"

static const struct {
    const char *name;
    const gsl_odeiv2_step_type *const *type;
} methods[] = {{"bsimp", &gsl_odeiv2_step_bsimp},
               {"rk1imp", &gsl_odeiv2_step_rk1imp},
               {"rk2imp", &gsl_odeiv2_step_rk2imp},
               {"rk4imp", &gsl_odeiv2_step_rk4imp},
               {"msbdf", &gsl_odeiv2_step_msbdf}};
enum { method_count = sizeof methods / sizeof *methods, tolerances = 4 };
static const double tolerance[tolerances] = {1e-3, 1e-4, 1e-6, 1e-8};

struct outcome {
    bool ended;
    double *y, *most; /* at the end, and the largest sizes */
    unsigned long rhs;
};

static double run_until(const struct fbd_model *model)
{
    const struct value *until = &model->scene->simulate.until;
    return until->expr ? expr_value(until->expr) : 0;
}

/* The state at the end of a run, if it comes there within some seconds. */
static struct outcome run(const struct fbd_model *model, const struct method *method, double tol)
{
    const double most_seconds = 3;
    size_t size = 2 * (size_t)model->plan.n;
    struct run_options options = {.until = run_until(model),
                                  .tolerance = tol,
                                  .method = method ? method : method_at(0),
                                  .automatic = !method,
                                  .structure = !method};
    struct outcome outcome = {.y = calloc(2 * size + 1, sizeof(double))};
    struct ensemble *ensemble = ensemble_new(model, &options);
    double start = processor_seconds();
    if (!ensemble || !outcome.y) exit(2);
    outcome.most = outcome.y + size;
    while (ensemble->outcome == FBD_GOING && processor_seconds() - start < most_seconds) {
        ensemble_advance(ensemble);
        const double *y = ensemble_state(ensemble)->y;
        for (size_t i = 0; i < size; i++) outcome.most[i] = fmax(outcome.most[i], fabs(y[i]));
    }
    memcpy(outcome.y, ensemble_state(ensemble)->y, size * sizeof(double));
    outcome.ended = ensemble->outcome == FBD_DONE;
    for (size_t p = 0; p < ensemble->count; p++) outcome.rhs += ensemble->groups[p].run->system.rhs;
    ensemble_free(ensemble);
    return outcome;
}

static double error_of(const struct fbd_model *model, const struct outcome *got, const struct outcome *truth)
{
    double worst = 0;
    for (size_t i = 0; i < 2 * (size_t)model->plan.n; i++)
        if (truth->most[i] > 0) worst = fmax(worst, fabs(got->y[i] - truth->y[i]) / truth->most[i]);
    return worst;
}

int main(int argc, char **argv)
{
    bool verbose = argc > 1 && strcmp(argv[1], "-v") == 0;
    size_t cases[method_count][tolerances] = {{0}}, worse[method_count][tolerances] = {{0}};
    gsl_set_error_handler_off();
    for (int i = verbose ? 2 : 1; i < argc; i++) {
        fbd_errors *errors = fbd_errors_new();
        fbd_model *model = fbd_model_read(argv[i], NULL, 0, errors);
        struct outcome truth = {0};
        if (model) truth = run(model, NULL, 1e-13);
        for (size_t m = 0; truth.ended && m < method_count; m++) {
            struct method own = *method_find(methods[m].name), gsl = own;
            gsl.type = methods[m].type;
            for (int k = 0; k < tolerances; k++) {
                struct outcome a = run(model, &own, tolerance[k]), b = run(model, &gsl, tolerance[k]);
                double mine = error_of(model, &a, &truth), theirs = error_of(model, &b, &truth);
                bool both = a.ended && b.ended;
                /* What is a tenth of the tolerance is no matter. */
                bool is_worse = both && mine > 3 * fmax(theirs, 0.1 * tolerance[k]);
                cases[m][k] += both;
                worse[m][k] += is_worse;
                if (is_worse || verbose)
                    printf("%-7s %.0e %-50s %s%.1e %s%.1e %8lu %8lu\n", methods[m].name, tolerance[k],
                           strstr(argv[i], "models/") ? strstr(argv[i], "models/") : argv[i],
                           a.ended ? " " : "!", mine, b.ended ? " " : "!", theirs, a.rhs, b.rhs);
                fflush(stdout);
                free(a.y);
                free(b.y);
            }
        }
        free(truth.y);
        fbd_model_free(model);
        fbd_errors_free(errors);
    }
    printf("worse than GSL's by more than a factor of 3, of all:\n%-8s", "");
    for (int k = 0; k < tolerances; k++) printf(" %10.0e", tolerance[k]);
    for (size_t m = 0; m < method_count; m++) {
        printf("\n%-8s", methods[m].name);
        for (int k = 0; k < tolerances; k++) printf("  %4zu/%4zu", worse[m][k], cases[m][k]);
    }
    printf("\n");
    return 0;
}
