/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A program that has fbd in it: how far does the block get under each push? It reads a model, shows the assembled
 * equation, runs step by step, and prints the motion at times of its own and the events where they come.
 *
 *     cc -o incline incline.c $(pkg-config --cflags --libs fbd gsl)
 *     ./incline /usr/share/fbd/models/kinetics/incline.yaml 5 50
 *
 * A fault of the model is printed as file:line:column, and the exit code is 3.
 */
#include <fbd.h>
#include <gsl/gsl_errno.h>
#include <stdlib.h>

static const double print_every = 0.5; /* [s] */

/* The state at the output times within the last step; looking changes nothing in the motion. */
static void print_motion(fbd_simulation *simulation, fbd_state *state, double *next)
{
    double from, to, x, v;
    fbd_simulation_interval(simulation, &from, &to);
    for (; *next <= to; *next += print_every)
        if (fbd_simulation_state(simulation, *next, state) && fbd_state_get(state, "block.x", &x) &&
            fbd_state_get(state, "block.v", &v))
            printf("  t = %-8g x = %-12.8g v = %.8g\n", *next, x, v);
}

static void print_events(fbd_simulation *simulation, size_t *seen)
{
    for (; *seen < fbd_simulation_event_count(simulation); (*seen)++) {
        fbd_event event = fbd_simulation_event(simulation, *seen);
        printf("  t = %-8g %s: %s\n", event.t, fbd_event_kind_name(event.kind), event.detail);
    }
}

/* m v_dot = sum of these terms */
static void print_equation(fbd_state *state)
{
    fbd_equations *equations = fbd_assemble(state);
    const fbd_equation x = fbd_equations_find(equations, "block.x");
    for (size_t i = 0; i < x.term_count; i++)
        printf("  %-10s %12.6g %s\n", x.terms[i].name, x.terms[i].value, x.unit);
    if (x.body) printf("  %s = %g %s\n", x.acceleration_name, x.acceleration, x.acceleration_unit);
    fbd_equations_free(equations);
}

static bool run(const fbd_model *model, fbd_errors *errors)
{
    fbd_state *state = fbd_state_new(model);
    fbd_simulation *simulation = fbd_simulation_new(model, NULL, errors);
    fbd_outcome outcome = FBD_FAILED;
    double next = 0;
    size_t events = 0;
    if (state) print_equation(state);
    if (state && simulation) do {
            outcome = fbd_simulation_advance(simulation);
            print_motion(simulation, state, &next);
            print_events(simulation, &events);
        } while (outcome == FBD_GOING);
    if (simulation && *fbd_simulation_reason(simulation))
        printf("  ended early: %s\n", fbd_simulation_reason(simulation));
    fbd_simulation_free(simulation);
    fbd_state_free(state);
    return outcome == FBD_DONE;
}

int main(int argc, char **argv)
{
    int code = EXIT_SUCCESS;
    if (argc < 3) {
        fprintf(stderr, "Usage: %s MODEL.yaml PUSH...   (of the parameter f1, as 5 or \"2 lbf\")\n", argv[0]);
        return 2;
    }
    gsl_set_error_handler_off(); /* its default would end the process; fbd looks at every status */
    for (int i = 2; i < argc && code == EXIT_SUCCESS; i++) {
        fbd_setting push = {"f1", argv[i]};
        fbd_errors *errors = fbd_errors_new();
        fbd_model *model = fbd_model_read(argv[1], &push, 1, errors);
        printf("%s, f1 = %s\n", fbd_model_title(model), argv[i]);
        if (!model)
            code = 3;
        else if (!run(model, errors))
            code = EXIT_FAILURE;
        fbd_errors_print(errors, stderr);
        fbd_model_free(model);
        fbd_errors_free(errors);
    }
    return code;
}
