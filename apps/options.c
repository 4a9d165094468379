/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "options.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "cutting.h"
#include "examples.h"
#include "fbd_export.h"
#include "finding.h"
#include "fmu.h"
#include "gnuplot.h"
#include "grading.h"
#include "note.h"
#include "options_help.h"
#include "picture.h"
#include "place.h"

enum {
    option_set = option_first,
    option_method,
    option_tolerance,
    option_accuracy,
    option_step,
    option_no_structure,
    option_until,
    option_csv,
    option_every,
    option_ledger,
    option_origin,
    option_json,
    option_error_bars,
    option_quiet,
    option_equations,
    option_linearize,
    option_static,
    option_settle,
    option_at,
    option_explain,
    option_check_hand,
    option_seed,
    option_svg,
    option_html,
    option_note,
    option_plot,
    option_plot_of,
    option_gnuplot,
    option_body,
    option_components,
    option_supports,
    option_symbols,
    option_system,
    option_scale,
    option_worksheet,
    option_solution,
    option_latex,
    option_check,
    option_emit_c,
    option_grade,
    option_student,
    option_details,
    option_handout,
    option_page,
    option_exam,
    option_watch,
    option_without,
    option_live,
    option_fmu,
    option_fmu_version,
    option_fmu_outputs,
    option_full,
    option_degrees,
    option_cut,
    option_find,
    option_runs,
    option_fit,
    option_parameters,
    option_inputs,
    option_outputs,
    option_examples,
    option_example,
};

static const struct option long_options[] = {
    {"set", required_argument, NULL, option_set},
    {"method", required_argument, NULL, option_method},
    {"tolerance", required_argument, NULL, option_tolerance},
    {"accuracy", required_argument, NULL, option_accuracy},
    {"step", required_argument, NULL, option_step},
    {"no-structure", no_argument, NULL, option_no_structure},
    {"until", required_argument, NULL, option_until},
    {"csv", required_argument, NULL, option_csv},
    {"every", required_argument, NULL, option_every},
    {"ledger", no_argument, NULL, option_ledger},
    {"origin", no_argument, NULL, option_origin},
    {"json", required_argument, NULL, option_json},
    {"error-bars", no_argument, NULL, option_error_bars},
    {"quiet", no_argument, NULL, option_quiet},
    {"equations", no_argument, NULL, option_equations},
    {"linearize", no_argument, NULL, option_linearize},
    {"static", no_argument, NULL, option_static},
    {"settle", no_argument, NULL, option_settle},
    {"at", required_argument, NULL, option_at},
    {"explain", no_argument, NULL, option_explain},
    {"check-hand", no_argument, NULL, option_check_hand},
    {"seed", required_argument, NULL, option_seed},
    {"svg", required_argument, NULL, option_svg},
    {"html", required_argument, NULL, option_html},
    {"note", required_argument, NULL, option_note},
    {"plot", required_argument, NULL, option_plot},
    {"plot-of", required_argument, NULL, option_plot_of},
    {"gnuplot", required_argument, NULL, option_gnuplot},
    {"body", required_argument, NULL, option_body},
    {"components", no_argument, NULL, option_components},
    {"supports", no_argument, NULL, option_supports},
    {"symbols", no_argument, NULL, option_symbols},
    {"system", no_argument, NULL, option_system},
    {"scale", required_argument, NULL, option_scale},
    {"worksheet", no_argument, NULL, option_worksheet},
    {"solution", no_argument, NULL, option_solution},
    {"latex", no_argument, NULL, option_latex},
    {"check", no_argument, NULL, option_check},
    {"emit-c", required_argument, NULL, option_emit_c},
    {"grade", required_argument, NULL, option_grade},
    {"student", required_argument, NULL, option_student},
    {"details", no_argument, NULL, option_details},
    {"handout", no_argument, NULL, option_handout},
    {"page", required_argument, NULL, option_page},
    {"exam", no_argument, NULL, option_exam},
    {"watch", no_argument, NULL, option_watch},
    {"without", required_argument, NULL, option_without},
    {"live", no_argument, NULL, option_live},
    {"fmu", required_argument, NULL, option_fmu},
    {"fmu-version", required_argument, NULL, option_fmu_version},
    {"fmu-outputs", required_argument, NULL, option_fmu_outputs},
    {"full", no_argument, NULL, option_full},
    {"degrees", no_argument, NULL, option_degrees},
    {"cut", required_argument, NULL, option_cut},
    {"find", required_argument, NULL, option_find},
    {"runs", required_argument, NULL, option_runs},
    {"fit", required_argument, NULL, option_fit},
    {"parameters", required_argument, NULL, option_parameters},
    {"inputs", required_argument, NULL, option_inputs},
    {"outputs", required_argument, NULL, option_outputs},
    {"examples", no_argument, NULL, option_examples},
    {"example", required_argument, NULL, option_example},
    {"schema", no_argument, NULL, option_schema},
    COMMAND_LINE_END,
};

static const struct command_line line = {
    "fbd-run", {options_help, options_help_without_run}, long_options, examples_write_names, false};

static bool usage(const char *message, const char *what)
{
    return command_line_usage(&line, message, what);
}

static bool choose_action(struct options *options, enum action action)
{
    if (options->action != action_run && options->action != action)
        return usage("only one of --equations, --linearize, --static, --explain, --check-hand, --check, "
                     "--emit-c, --fmu, --grade, "
                     "--handout, --examples and --example at a time",
                     "");
    options->action = action;
    return true;
}

static bool take_seed(unsigned *seed)
{
    unsigned long value;
    if (!command_line_whole(&line, "--seed wants a whole number, not ", optarg, 0, 0xFFFFFFFFUL, &value))
        return false;
    *seed = (unsigned)value;
    return true;
}

static bool take_number(const char *name, double least, double *value)
{
    return command_line_number(&line, name, optarg, least, value);
}

static bool take_time(const char *name, double least, double *value)
{
    return command_line_time(&line, name, optarg, least, value);
}

static bool take_runs(size_t *runs)
{
    unsigned long value;
    if (!command_line_whole(&line, "--runs wants a number of runs from 3 to 1000000, not ", optarg, 3,
                            1000000, &value))
        return false;
    *runs = value;
    return true;
}

static bool live_can_be_made(void)
{
    if (fbd_has_live()) return true;
    return usage(
        "this fbd was built without --live: `make live` in its source compiles the library for browsers "
        "and builds it anew",
        "");
}

static const double tiny = 1e-300; /* excludes 0 */

/* Options of drawings, sheets and grades. */
static bool take_drawing(struct options *options, int option)
{
    switch (option) {
    case option_body: options->drawing.body = optarg; return true;
    case option_components: options->drawing.components = true; return true;
    case option_supports: options->drawing.supports = true; return true;
    case option_symbols: options->drawing.symbols = true; return true;
    case option_system: options->drawing.system = true; return true;
    case option_scale: options->scale = optarg; return true;
    case option_worksheet: options->drawing.worksheet = true; return true;
    case option_solution: options->drawing.solution = true; return true;
    case option_student: options->student = optarg; return true;
    case option_details: options->details = true; return true;
    case option_page: options->page = optarg; return true;
    case option_exam: options->exam = true; return true;
    case option_plot: options->plot = optarg; return true;
    case option_plot_of: options->plot_of = optarg; return true;
    case option_gnuplot: options->gnuplot = optarg; return true;
    case option_cut: options->cut = optarg; return true;
    case option_find: options->find = optarg; return true;
    case option_fit: options->fit = optarg; return true;
    case option_parameters: options->parameters = optarg; return true;
    case option_inputs: options->inputs = optarg; return true;
    case option_outputs: options->outputs = optarg; return true;
    case option_runs: return take_runs(&options->find_runs);
    default: return usage("unknown option, or an option without its value", "");
    }
}

static bool take_option(const struct command_line *unused, int option, void *context)
{
    struct options *options = context;
    (void)unused;
    switch (option) {
    case option_set: return command_line_setting(&line, optarg, options->settings, &options->setting_count);
    case option_method: options->run.method = optarg; return true;
    case option_tolerance: return take_number("tolerance", tiny, &options->run.tolerance);
    case option_accuracy: return take_number("accuracy", tiny, &options->run.accuracy);
    case option_step: return take_time("step", tiny, &options->run.step);
    case option_no_structure: options->run.no_structure = true; return true;
    case option_until: return take_time("until", -1e300, &options->run.until);
    case option_every: return take_time("every", tiny, &options->every);
    case option_csv: options->csv = optarg; return true;
    case option_json: options->json = optarg; return true;
    case option_ledger: options->ledger = true; return true;
    case option_origin: options->origin = true; return true;
    case option_error_bars: options->run.error_bars = true; return true;
    case option_quiet: options->quiet = true; return true;
    case option_full: options->full = true; return true;
    case option_degrees: options->degrees = true; return true;
    case option_watch: options->watch = true; return watch_is_possible(&line);
    case option_settle: options->settle = true; return true;
    case option_at:
        if (options->at_count == most_settings) return usage("too many --at", "");
        options->at[options->at_count++] = optarg;
        return true;
    case option_without:
        if (options->without_count == most_settings) return usage("too many --without", "");
        options->without[options->without_count++] = optarg;
        return true;
    case option_live: options->live = true; return live_can_be_made();
    case option_svg: options->svg = optarg; return true;
    case option_html:
        if (!fbd_has_html())
            return usage(
                "this fbd was built without --html: it needs dygraphs (Debian: libjs-dygraphs) at build time",
                "");
        options->html = optarg;
        return true;
    case option_note: options->note = optarg; return note_can_be_written(&line, optarg);
    case option_latex: options->latex = true; return true;
    case option_seed: return take_seed(&options->seed);
    case option_equations: return choose_action(options, action_equations);
    case option_linearize: return choose_action(options, action_linearize);
    case option_static: return choose_action(options, action_static);
    case option_explain: return choose_action(options, action_explain);
    case option_check_hand: return choose_action(options, action_check_hand);
    case option_check: return choose_action(options, action_check);
    case option_emit_c: options->emit_c = optarg; return choose_action(options, action_emit_c);
    case option_grade: options->model = optarg; return choose_action(options, action_grade);
    case option_examples: return choose_action(options, action_examples);
    case option_example: options->example = optarg; return choose_action(options, action_example);
    case option_handout: return choose_action(options, action_handout);
    case option_fmu:
        options->fmu = optarg;
        return fmu_can_be_made(&line) && choose_action(options, action_fmu);
    case option_fmu_outputs: options->fmu_outputs = optarg; return true;
    case option_fmu_version: return fmu_take_version(&line, optarg, &options->fmu_version);
    default: return take_drawing(options, option);
    }
}

enum { place_count = 10 };

/* List the destinations of outputs. The report comes last; it goes to standard output unless data goes there. */
static void list_places(const struct options *options, struct output_place places[place_count])
{
    const struct output_place all[place_count] = {
        {"--csv", options->csv},   {"--json", options->json},     {"--svg", options->svg},
        {"--html", options->html}, {"--plot", options->plot},     {"--gnuplot", options->gnuplot},
        {"--fmu", options->fmu},   {"--emit-c", options->emit_c}, {"--note", options->note},
        {"the report", "-"},
    };
    memcpy(places, all, sizeof all);
    if (options->quiet || options_use_stdout(options)) places[place_count - 1].path = NULL;
}

bool options_use_stdout(const struct options *options)
{
    return place_is_stdout(options->csv) || place_is_stdout(options->json) || place_is_stdout(options->svg) ||
           place_is_stdout(options->html) || place_is_stdout(options->plot) ||
           place_is_stdout(options->gnuplot) || place_is_stdout(options->fmu) ||
           place_is_stdout(options->emit_c);
}

/* `components`, `symbols`: another output shows these. */
static bool shapes_drawing(const struct options *options, bool components, bool symbols)
{
    const fbd_drawing *drawing = &options->drawing;
    return drawing->body || (drawing->components && !components) || drawing->supports ||
           (drawing->symbols && !symbols) || options->scale || drawing->worksheet || drawing->system;
}

/* True for options that contradict a sheet or a grade. A sheet permits the drawing option --solution. */
static bool runs_or_draws(const struct options *options)
{
    return options->watch || options->at_count || options->run.method || options->run.tolerance > 0 ||
           options->run.accuracy > 0 || options->run.step > 0 || options->run.no_structure ||
           isfinite(options->run.until) || options->run.error_bars || options->settle ||
           options->fmu_version || options->svg || options->html || options->note || options->plot ||
           options->plot_of || options->gnuplot || options->ledger || options->origin || options->every > 0 ||
           options->latex || shapes_drawing(options, false, false) || options->without_count ||
           options->full || options->degrees;
}

/* Watched outputs and inputs must be files. */
static bool can_be_watched(const struct options *options)
{
    struct output_place places[place_count];
    struct stat status;
    list_places(options, places);
    if (strcmp(options->model, "-") == 0 || (stat(options->model, &status) == 0 && !S_ISREG(status.st_mode)))
        return usage("--watch wants a model that is a file, not ", options->model);
    for (size_t i = 0; i + 1 < place_count; i++) {
        const char *path = places[i].path;
        if (!path) continue;
        if (place_descriptor(path) >= 0 || (stat(path, &status) == 0 && !S_ISREG(status.st_mode)))
            return usage(
                "--watch writes its outputs again after each change, which is possible for files only, not ",
                path);
    }
    return true;
}

static bool drawing_agrees(const struct options *options)
{
    const fbd_drawing *drawing = &options->drawing;
    bool eigenvalues = options->action == action_linearize;
    const bool equations = options->action == action_equations,
               components = options->html || options->ledger || equations;
    if ((shapes_drawing(options, components, equations) || drawing->solution) &&
        (!options->svg || eigenvalues))
        return usage(
            "--body, --components, --supports, --symbols, --system, --scale, --worksheet and --solution go "
            "with the diagrams of --svg",
            options->drawing.components ? ", --components also with --html, --ledger and --equations" : "");
    if (drawing->worksheet && (drawing->solution || drawing->symbols || drawing->components))
        return usage(
            "--worksheet has no arrows: --solution, --symbols and --components are for another sheet", "");
    if (drawing->system && (drawing->body || drawing->worksheet || drawing->solution || drawing->symbols ||
                            drawing->components || options->scale))
        return usage(
            "--system draws the bodies joined: --body, --components, --symbols, --scale, --worksheet "
            "and --solution are for bodies cut free",
            "");
    return !options->svg || picture_can_be_written(&line, options->svg);
}

/* The outputs of a run. */
static bool outputs_agree(const struct options *options)
{
    const bool stands_still = options->action != action_run;
    const bool responds = options->action == action_linearize; /* frequency responses */
    if ((stands_still &&
         (options->html || options->note || options->ledger || options->origin || options->every > 0)) ||
        (stands_still && !responds && (options->csv || options->plot || options->gnuplot)))
        return usage("--csv, --html, --note, --plot, --gnuplot, --ledger, --origin and --every belong to a "
                     "run; --csv, --plot and --gnuplot also go with --linearize",
                     "");
    if ((options->inputs || options->outputs) && !responds)
        return usage("--inputs and --outputs go with --linearize", "");
    if (responds && options->plot_of)
        return usage("--outputs, not --plot-of, chooses the responses of --linearize", "");
    if (options->note && options->without_count > 0)
        return usage("--note describes the file as it is: comment its entries out, instead of --without", "");
    if (options->plot_of && !options->plot && !options->gnuplot)
        return usage("--plot-of goes with --plot or --gnuplot", "");
    if (options->plot && !plot_can_be_written(&line, options->plot)) return false;
    if (!options->csv && options->ledger) return usage("--ledger goes with --csv", "");
    if (!options->csv && options->origin) return usage("--origin goes with --csv", "");
    if (!options->csv && !options->html && !options->note && options->every > 0)
        return usage("--every goes with --csv, --html or --note", "");
    return true;
}

/* Refuse options that would have no effect. */
static bool options_agree(const struct options *options)
{
    if (options->action == action_grade || options->action == action_handout)
        return grading_agrees(options, &line, runs_or_draws(options));
    if (options->student || options->details)
        return usage("--student and --details go with --grade and --handout", "");
    if (options->page || options->exam) return usage("--page and --exam go with --handout", "");
    bool stands_still = options->action != action_run;
    bool draws = options->action == action_equations || options->action == action_linearize;
    bool rests = options->action == action_static;
    if (options->cut && !cutting_agrees(options, &line, shapes_drawing(options, false, false))) return false;
    if (options->at_count && !draws && !rests && !options->svg && !options->cut)
        return usage("--at goes with --svg, --cut, --equations, --linearize or --static", "");
    if (options->svg && stands_still && !draws && !rests)
        return usage("--svg belongs to a run, --equations, --static or --linearize", "");
    if ((options->find || options->fit) && !finding_agrees(options, &line)) return false;
    if (options->parameters && !options->fit) return usage("--parameters goes with --fit", "");
    if (options->find_runs && !options->find) return usage("--runs goes with --find", "");
    if (!drawing_agrees(options)) return false;
    if (options->latex && options->action != action_equations)
        return usage("--latex goes with --equations", "");
    if (options->fmu_version && !options->fmu) return usage("--fmu-version goes with --fmu", "");
    if (options->fmu_outputs && !options->fmu) return usage("--fmu-outputs goes with --fmu", "");
    if (options->live && !options->html) return usage("--live goes with --html", "");
    if (options->settle && !rests) return usage("--settle goes with --static", "");
    if (stands_still && !rests && !draws && options->action != action_check && options->json)
        return usage("--json belongs to a run, --check, --equations, --linearize, --static or --grade", "");
    if (!outputs_agree(options)) return false;
    if (options->full && (stands_still || options->quiet || options_use_stdout(options)))
        return usage("--full applies to the report, which --quiet, data on standard output and options "
                     "without a run leave out",
                     "");
    if (options->degrees && stands_still && !draws && !rests)
        return usage("--degrees goes with a run, --equations, --linearize or --static", "");
    if (stands_still && options->run.error_bars) return usage("--error-bars belongs to a run", "");
    if (options->emit_c && (options->run.method || options->run.accuracy > 0 || options->run.step > 0 ||
                            options->run.no_structure || options->quiet))
        return usage("--emit-c goes with --set, --until and --tolerance only", "");
    if (options->watch && !can_be_watched(options)) return false;
    struct output_place places[place_count];
    list_places(options, places);
    return places_differ(&line, options->model, places, place_count);
}

bool options_spare(const struct options *options, const fbd_errors *errors)
{
    struct output_place places[place_count];
    list_places(options, places);
    return places_spare(&line, errors, places, place_count);
}

/* `--symbols` without an output of arrows selects the equations in symbols. */
static void choose_symbols(struct options *options)
{
    const bool runs =
        options->svg || options->csv || options->html || options->note || options->plot || options->gnuplot;
    if (options->action == action_run && options->drawing.symbols && !runs)
        options->action = action_equations;
}

/* The examples need no model, and no other option. */
static bool options_take_examples(int argc, char **argv, const struct options *options)
{
    const int words = options->action == action_example && !strchr(argv[1], '=') ? 3 : 2;
    return argc == words || usage("--examples and --example NAME stand alone", "");
}

bool options_read(int argc, char **argv, struct options *options, enum exit_code *code)
{
    *options = (struct options){.run = FBD_OPTIONS_DEFAULT, .seed = 1};
    if (!command_line_options(&line, argc, argv, take_option, options, code)) return false;
    if (options->action == action_examples || options->action == action_example)
        return options_take_examples(argc, argv, options);
    choose_symbols(options);
    options->run.error_bars |= options->note != NULL;
    if (options->action != action_grade)
        return command_line_model(&line, argc, argv, &options->model) && options_agree(options);
    options->answers = argv + optind;
    options->answer_count = (size_t)(argc - optind);
    return options->answer_count == 0 ? usage("no answer to compare with the key", "")
                                      : options_agree(options);
}
