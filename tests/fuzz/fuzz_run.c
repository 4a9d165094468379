/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Whole runs with all outputs, and all that may be asked instead of a run. Which of them an input goes
 * through is chosen by its fuzz_choices, so that each is short and all are taken often.
 */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/text.h"
#include "claims.h"
#include "fbd.h"
#include "fbd_export.h"
#include "fbd_grade.h"
#include "fbd_study.h"
#include "fuzz.h"
#include "scene/language.h"

enum {
    most_steps = 120,   /* of a run, then it is interrupted */
    most_waits = 20000, /* questions between two steps, then too: who presses Ctrl-C is obeyed */
    most_table = 60000, /* bytes of CSV, then the writer refuses */
    waits_a_look = 16,  /* questions between two looks at the clock, which asks the system */
    most_arrows = 64,
    most_seconds = 20, /* of the processor, for an input that is invented */
    keeps_plots = 1,   /* of sixteen */
    keeps_page = 2,
};

struct input {
    const fbd_model *model;
    fbd_errors *errors;
    bool names_nan;           /* it says `nan` itself, or a run failed for one: outputs may repeat that */
    uint64_t choices, rarity; /* the latter of bits that no choice takes */
};

/* What takes as long as ten other inputs is done for one in four of those that choose it, but in a replay always. */
static bool seldom(const struct input *input)
{
    return !fuzz_hurries || (input->rarity & 3) == 0;
}

/* ---- how many inputs came how far */

static struct {
    size_t inputs, models, runs, ended;
} tally;

static void tell_tally(void)
{
    if (tally.inputs < 100) return; /* a replay */
    fprintf(stderr, "stat::models: %zu\nstat::runs: %zu\nstat::runs_ended: %zu\n", tally.models, tally.runs,
            tally.ended);
}

/* ---- claims on texts; each takes the text and frees it, NULL is `memory is out` */

static void claim_text(const struct input *input, const char *what, char *text)
{
    if (!text) fuzz_fail("%s: none", what);
    claim_plain(what, text);
    if (!input->names_nan) claim_no_nan(what, text);
    free(text);
}

static void claim_object(const struct input *input, const char *what, char *text)
{
    if (!text) fuzz_fail("%s: none", what);
    claim_json(what, text);
    claim_text(input, what, text);
}

static void claim_drawing(const struct input *input, const char *what, char *text)
{
    if (!text) fuzz_fail("%s: none", what);
    claim_xml(what, text);
    claim_text(input, what, text);
}

static void claim_arrows(const fbd_arrow *arrows, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        claim_finite(arrows[i].name, arrows[i].fx);
        claim_finite(arrows[i].name, arrows[i].fy);
        claim_finite(arrows[i].name, arrows[i].x + arrows[i].y);
        claim_finite(arrows[i].name, arrows[i].couple);
        claim_finite(arrows[i].name, arrows[i].moment);
        claim_finite(arrows[i].name, arrows[i].power);
    }
}

static void claim_energy(fbd_energy energy)
{
    claim_finite("kinetic energy", energy.kinetic);
    claim_finite("potential energy", energy.potential);
    claim_finite("work", energy.work);
    claim_finite("residual", energy.residual);
    claim_finite("initial energy", energy.initial_kinetic + energy.initial_potential);
}

/* ---- runs */

struct patience {
    unsigned long steps, waits, asked;
    clock_t since, most;
};

/* Tells the run to end after so many steps, or so many questions without one: of a belt of 1e15 rad/s a
 * stretch without a step is any number of steps of its companion. It is asked between them too, and oftener
 * where groups wait for each other: counted in calls alone no run would come to its end. And after so much work:
 * what takes longer has to ask in it. */
static int watch(void *context, const fbd_progress *progress)
{
    struct patience *patience = context;
    claim_finite("time", progress->t);
    patience->waits = progress->steps == patience->steps ? patience->waits + 1 : 0;
    patience->steps = progress->steps;
    bool late = patience->asked++ % waits_a_look == 0 && clock() - patience->since > patience->most;
    return progress->steps > most_steps || patience->waits > most_waits || late;
}

/* Most faults show in the first steps of a run, and the more inputs, the more of them: a few are looked at for long,
 * and these few together for about half as long as the rest. */
static clock_t most_work(const struct input *input)
{
    if (input->rarity % 4096 == 0) return 2 * CLOCKS_PER_SEC;
    if (input->rarity % 64 == 0) return CLOCKS_PER_SEC / 20;
    return fuzz_hurries ? CLOCKS_PER_SEC / 250 : CLOCKS_PER_SEC / 50;
}

static int write_table(void *context, const char *rows, size_t length)
{
    struct text *table = context;
    text_add_bytes(table, rows, length);
    return table->length > most_table;
}

static fbd_options choose_options(uint64_t *choices)
{
    static const double untils[] = {NAN, 1e-3, 0.1, 10};
    static const double tolerances[] = {0, 1e-3, 1e-6, 1e-12};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = untils[fuzz_take(choices, 2)];
    unsigned method = fuzz_take(choices, 5); /* 0 is auto, and so are half of all */
    if (method < 14) options.method = method_choices[method].name;
    unsigned accuracy = fuzz_take(choices, 5);
    options.no_structure = fuzz_take(choices, 2) == 0;
    options.error_bars = fuzz_take(choices, 3) == 0;
    if (accuracy == 0) { /* its rows are kept until the accuracy is reached: of a long run too many */
        options.accuracy = 1e-6;
        if (isnan(options.until)) options.until = 1;
    } else if (accuracy <= 2)
        options.step = 0.01;
    else
        options.tolerance = tolerances[fuzz_take(choices, 2)];
    return options;
}

static void look_at_end(const struct input *input, fbd_simulation *simulation, fbd_result *result)
{
    fbd_arrow arrows[most_arrows];
    fbd_state *state = fbd_result_state(result);
    claim_energy(fbd_result_energy(result));
    for (size_t i = 0; i < fbd_model_coordinate_count(input->model); i++) {
        fbd_coordinate coordinate = fbd_model_coordinate(input->model, i);
        double q = NAN, v = NAN;
        fbd_state_get(state, coordinate.name, &q);
        fbd_state_get(state, coordinate.rate_name, &v);
        claim_finite(coordinate.name, q);
        claim_finite(coordinate.rate_name, v);
    }
    for (size_t i = 0; i < fbd_model_body_count(input->model); i++) {
        size_t count = fbd_diagram(state, i, arrows, most_arrows);
        claim_arrows(arrows, count < most_arrows ? count : most_arrows);
    }
    for (size_t i = 0; i < fbd_simulation_event_count(simulation); i++)
        claim_finite("time of an event", fbd_simulation_event(simulation, i).t);
}

/* What is written of a run that came to an end of any kind. */
static void write_outputs(const struct input *input, fbd_result *result, unsigned which, bool keeps)
{
    if (which & 1) claim_text(input, "report", fbd_result_report(result, false));
    if (which & 2) claim_object(input, "JSON", fbd_result_json(result));
    if (keeps && which >> 2 == keeps_plots)
        claim_text(input, "plots", fbd_result_gnuplot(result, "plots.svg", NULL, input->errors));
    if (keeps && which >> 2 == keeps_page) free(fbd_result_html(result, input->errors));
}

static void claim_csv(const struct text *table)
{
    if (table->length > 0 && table->length <= most_table) claim_table("CSV", table->data);
}

static void run(struct input *input)
{
    struct patience patience = {.since = clock(), .most = most_work(input)};
    struct text table = {0};
    uint64_t *choices = &input->choices;
    fbd_options options = choose_options(choices);
    unsigned which = fuzz_take(choices, 6);
    bool keeps = (which >> 2 == keeps_plots || which >> 2 == keeps_page) && seldom(input);
    fbd_recording recording = {.ledger = fuzz_take(choices, 1),
                               .csv = write_table,
                               .csv_context = &table,
                               .motion_only = fuzz_take(choices, 3) == 0,
                               .keep = keeps,
                               .progress = watch,
                               .progress_context = &patience};
    fbd_simulation *simulation = fbd_simulation_new(input->model, &options, input->errors);
    bool few = fuzz_take(choices, 3) != 0 || options.accuracy > 0;
    if (few && isfinite(options.until)) recording.every = options.until / 4;
    fbd_result *result = simulation ? fbd_simulation_run(simulation, &recording) : NULL;
    fbd_outcome outcome = result ? fbd_result_outcome(result) : FBD_FAILED;
    bool ended = outcome == FBD_DONE || outcome == FBD_STOPPED || outcome == FBD_BROKEN;
    bool whole = ended || outcome == FBD_INTERRUPTED; /* what is shown is vouched for */
    tally.runs += patience.steps > 0;
    tally.ended += ended;
    input->names_nan = input->names_nan || !whole;
    if (result) write_outputs(input, result, recording.motion_only ? 0 : which, keeps);
    if (whole && !recording.motion_only) {
        look_at_end(input, simulation, result);
        claim_csv(&table);
    }
    if (simulation) claim_plain("the reason", fbd_simulation_reason(simulation));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    text_free(&table);
}

/* ---- questions without time */

static void ask_equations(struct input *input, fbd_state *state)
{
    fbd_drawing drawing = {.components = fuzz_take(&input->choices, 1)};
    drawing.supports = drawing.symbols = drawing.components;
    if (!fbd_state_close(state, input->errors)) return;
    claim_text(input, "equations", fbd_equations_write(state, NULL, NULL));
    claim_text(input, "LaTeX",
               fbd_equations_write(state, &(fbd_equations_options){.format = FBD_LATEX}, NULL));
    char *svg = fbd_diagram_svg(state, &drawing, input->errors);
    if (svg || fbd_errors_failed_count(input->errors) == 0) claim_drawing(input, "diagram", svg);
    fbd_equations *equations = fbd_assemble(state);
    for (size_t i = 0; equations && i < fbd_equations_count(equations); i++) {
        const fbd_equation equation = fbd_equations_get(equations, i);
        claim_finite("inertia", equation.inertia);
        claim_finite("sum", equation.sum);
        claim_finite(equation.acceleration_name, equation.acceleration);
        for (size_t k = 0; k < equation.term_count; k++)
            claim_finite(equation.terms[k].name, equation.terms[k].value);
    }
    fbd_equations_free(equations);
}

static void ask_statics(struct input *input, fbd_state *state)
{
    if (fuzz_take(&input->choices, 1) && !fbd_find_equilibrium(state, input->errors)) return;
    fbd_statics *statics = fbd_statics_new(state, input->errors);
    if (!statics) return;
    claim_text(input, "statics", fbd_statics_text(statics));
    claim_object(input, "JSON of statics", fbd_statics_json(statics));
    for (size_t i = 0; i < fbd_statics_limit_count(statics); i++)
        claim_finite("a limit", fbd_statics_limit(statics, i).needed);
    for (size_t i = 0; i < fbd_model_body_count(input->model); i++) {
        fbd_arrow arrows[most_arrows];
        size_t count = fbd_statics_diagram(statics, i, arrows, most_arrows);
        claim_arrows(arrows, count < most_arrows ? count : most_arrows);
    }
    fbd_statics_free(statics);
}

static void ask_linearization(struct input *input, fbd_state *state)
{
    fbd_linearization *linear = fbd_linearize(state, input->errors);
    if (!linear) return;
    size_t size = fbd_linearization_size(linear);
    for (size_t i = 0; i < size * size; i++) claim_finite("A", fbd_linearization_matrix(linear)[i]);
    for (size_t i = 0; i < size; i++) {
        fbd_mode mode = fbd_linearization_mode(linear, i);
        claim_finite("an eigenvalue", mode.re + mode.im);
    }
    claim_text(input, "linearization", fbd_linearization_text(linear));
    claim_drawing(input, "eigenvalues", fbd_linearization_svg(linear));
    fbd_linearization_free(linear);
}

static void ask_hand(const struct input *input)
{
    claim_text(input, "hand derivations", fbd_check_hand(input->model, 1, NULL));
}

static void ask(struct input *input)
{
    unsigned what = fuzz_take(&input->choices, 4);
    const fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_state *state = fbd_state_new(input->model);
    if (what <= 3) ask_equations(input, state);
    if (what == 4 || (what == 5 && seldom(input))) ask_statics(input, state);
    if (what == 6 || what == 7) ask_linearization(input, state);
    if (what == 8 && seldom(input)) ask_hand(input);
    if (what == 9) claim_text(input, "explanation", fbd_explain(input->model, &options));
    fbd_state_free(state);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    clock_t since = clock();
    const char *text = (const char *)data;
    struct input input = {.errors = fbd_errors_new(),
                          .names_nan = names_nan(text, size),
                          .choices = fuzz_choices(text, size)};
    fbd_model *model = fbd_model_parse(text, size, "fuzzed.yaml", NULL, 0, input.errors);
    input.model = model;
    input.rarity = input.choices >> 48;
    if (tally.inputs++ == 0) atexit(tell_tally);
    if (model) {
        tally.models++;
        ask(&input);
        run(&input);
    }
    fbd_model_free(model);
    fbd_errors_free(input.errors);
    claim_in_time(since, most_seconds);
    return 0;
}
