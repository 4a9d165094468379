/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "options.h"

#include "gnuplot.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: fbd-run [options] MODEL.yaml\n"
    "Assemble the equations of motion of a free-body diagram, simulate it, and report.\n"
    "\n"
    "What is simulated\n"
    "  --set NAME=VALUE     give a parameter of the file another value (may be repeated)\n"
    "  --method NAME        integrate with this method (auto, dop853, rodas5p, rk8pd, msbdf, ...)\n"
    "  --tolerance NUMBER   relative error per step (default: the file's, else 1e-10)\n"
    "  --accuracy NUMBER    global error allowed, relative to the size of the motion, instead of a "
    "tolerance\n"
    "  --step TIME          steps of this fixed size, in seconds\n"
    "  --no-structure       integrate all bodies together by the general method\n"
    "  --until TIME         end of the run, in seconds\n"
    "\n"
    "What is written (FILE may be - for standard output, which leaves the report out)\n"
    "  --csv FILE           the motion, one row for each output time and event\n"
    "  --every TIME         output interval of the rows, in seconds (default: 1/500 of the run)\n"
    "  --ledger             add columns for every force, its work, and the energies\n"
    "  --json FILE          final state, events, forces, energy and cost as one object\n"
    "  --error-bars         estimate the error of everything that is written, by a second run that goes "
    "along\n"
    "  --html FILE          one page that plays the motion, with plots, equations and events\n"
    "  --plot FILE          plots of coordinates and energies by gnuplot; FILE ends in .svg, .png or .pdf\n"
    "  --plot-of NAME,...   of these columns of the CSV (block.v,block.friction)\n"
    "  --gnuplot FILE       the script of the plots, with its data\n"
    "  --svg FILE           the free-body diagram of every body, at the start or at the time of --at;\n"
    "                       with --linearize the eigenvalues\n"
    "  --body NAME          of this body alone\n"
    "  --components         with the components of each force\n"
    "  --quiet              no report\n"
    "\n"
    "Instead of a run\n"
    "  --equations          the assembled equations, term by term\n"
    "  --linearize          equilibrium, A matrix, eigenvalues, frequencies, damping ratios\n"
    "  --at TIME|NAME=VALUE for these two and for --svg: at this time of the run, or with these coordinates\n"
    "                       (may be repeated)\n"
    "  --explain            what is simulated and what is not, what is conservative and why\n"
    "  --check-hand         hold the file's hand derivations against the assembly\n"
    "  --seed NUMBER        seed of the random states for that (default 1)\n"
    "  --check              read the file and say what is wrong with it\n"
    "  --help, --version\n"
    "\n"
    "Exit codes: 0 done, 1 the run failed or ended early, 2 usage, 3 the model file is wrong,\n"
    "4 a hand derivation differs, 5 the accuracy asked for was not reached,\n"
    "128 + signal: interrupted, with what was computed written.\n";

enum {
    option_set = 256,
    option_method,
    option_tolerance,
    option_accuracy,
    option_step,
    option_no_structure,
    option_until,
    option_csv,
    option_every,
    option_ledger,
    option_json,
    option_error_bars,
    option_quiet,
    option_equations,
    option_linearize,
    option_at,
    option_explain,
    option_check_hand,
    option_seed,
    option_svg,
    option_html,
    option_plot,
    option_plot_of,
    option_gnuplot,
    option_body,
    option_components,
    option_check,
    option_help,
    option_version,
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
    {"json", required_argument, NULL, option_json},
    {"error-bars", no_argument, NULL, option_error_bars},
    {"quiet", no_argument, NULL, option_quiet},
    {"equations", no_argument, NULL, option_equations},
    {"linearize", no_argument, NULL, option_linearize},
    {"at", required_argument, NULL, option_at},
    {"explain", no_argument, NULL, option_explain},
    {"check-hand", no_argument, NULL, option_check_hand},
    {"seed", required_argument, NULL, option_seed},
    {"svg", required_argument, NULL, option_svg},
    {"html", required_argument, NULL, option_html},
    {"plot", required_argument, NULL, option_plot},
    {"plot-of", required_argument, NULL, option_plot_of},
    {"gnuplot", required_argument, NULL, option_gnuplot},
    {"body", required_argument, NULL, option_body},
    {"components", no_argument, NULL, option_components},
    {"check", no_argument, NULL, option_check},
    {"help", no_argument, NULL, option_help},
    {"version", no_argument, NULL, option_version},
    {NULL, 0, NULL, 0},
};

static bool usage(const char *message, const char *what)
{
    fprintf(stderr, "fbd-run: %s%s\nTry `fbd-run --help`.\n", message, what);
    return false;
}

/* A number of the command line, as in C; the program runs in the C locale. */
static bool read_number(const char *name, const char *text, double least, double *value)
{
    char *end;
    errno = 0;
    *value = strtod(text, &end);
    if (end == text || *end || errno == ERANGE || !(*value >= least) || *value > 1e300) {
        fprintf(stderr, "fbd-run: --%s wants a number%s, not `%s`\nTry `fbd-run --help`.\n", name,
                least > 0 ? " above 0" : "", text);
        return false;
    }
    return true;
}

static bool read_seed(const char *text, unsigned *seed)
{
    char *end;
    errno = 0;
    unsigned long value = strtoul(text, &end, 10);
    if (end == text || *end || errno || text[0] == '-' || value > 0xFFFFFFFFUL)
        return usage("--seed wants a whole number, not ", text);
    *seed = (unsigned)value;
    return true;
}

/* NAME=VALUE; the argument is cut in two. */
static bool read_setting(struct options *options, char *text)
{
    char *equals = strchr(text, '=');
    if (!equals || equals == text || !equals[1]) return usage("--set wants NAME=VALUE, not ", text);
    if (options->setting_count == most_settings) return usage("too many --set", "");
    *equals = '\0';
    options->settings[options->setting_count++] = (fbd_setting){text, equals + 1};
    return true;
}

static bool choose_action(struct options *options, enum action action)
{
    if (options->action != action_run && options->action != action)
        return usage("only one of --equations, --linearize, --explain, --check-hand and --check at a time",
                     "");
    options->action = action;
    return true;
}

static bool take_option(int code, struct options *options)
{
    const double tiny = 1e-300; /* above 0 */
    switch (code) {
    case option_set: return read_setting(options, optarg);
    case option_method: options->run.method = optarg; return true;
    case option_tolerance: return read_number("tolerance", optarg, tiny, &options->run.tolerance);
    case option_accuracy: return read_number("accuracy", optarg, tiny, &options->run.accuracy);
    case option_step: return read_number("step", optarg, tiny, &options->run.step);
    case option_no_structure: options->run.no_structure = true; return true;
    case option_until: return read_number("until", optarg, -1e300, &options->run.until);
    case option_every: return read_number("every", optarg, tiny, &options->every);
    case option_csv: options->csv = optarg; return true;
    case option_json: options->json = optarg; return true;
    case option_ledger: options->ledger = true; return true;
    case option_error_bars: options->run.error_bars = true; return true;
    case option_quiet: options->quiet = true; return true;
    case option_at:
        if (options->at_count == most_settings) return usage("too many --at", "");
        options->at[options->at_count++] = optarg;
        return true;
    case option_svg: options->svg = optarg; return true;
    case option_html:
        if (!fbd_has_html())
            return usage(
                "this fbd was built without --html: it needs dygraphs (Debian: libjs-dygraphs) at build time",
                "");
        options->html = optarg;
        return true;
    case option_plot: options->plot = optarg; return true;
    case option_plot_of: options->plot_of = optarg; return true;
    case option_gnuplot: options->gnuplot = optarg; return true;
    case option_body: options->drawing.body = optarg; return true;
    case option_components: options->drawing.components = true; return true;
    case option_seed: return read_seed(optarg, &options->seed);
    case option_equations: return choose_action(options, action_equations);
    case option_linearize: return choose_action(options, action_linearize);
    case option_explain: return choose_action(options, action_explain);
    case option_check_hand: return choose_action(options, action_check_hand);
    case option_check: return choose_action(options, action_check);
    default: return usage("unknown option, or an option without its value", "");
    }
}

static bool plot_can_be_written(const char *file)
{
    const char *end = strrchr(file, '.');
    if (!end || (strcmp(end, ".svg") != 0 && strcmp(end, ".png") != 0 && strcmp(end, ".pdf") != 0))
        return usage("--plot wants a file whose name ends in .svg, .png or .pdf, not ", file);
    if (!gnuplot_is_there())
        return usage(
            "--plot needs gnuplot, which is not installed (Debian: gnuplot-nox); --gnuplot FILE writes the "
            "script for it",
            "");
    return true;
}

static bool places_differ(const struct options *options)
{
    const char *places[] = {options->csv,  options->json, options->svg,
                            options->html, options->plot, options->gnuplot};
    const size_t count = sizeof places / sizeof *places;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < i; k++)
            if (places[i] && places[k] && strcmp(places[i], places[k]) == 0)
                return usage("two outputs cannot go to the same place: ", places[i]);
    return true;
}

/* Options that would be passed over in silence are mistakes. */
static bool options_agree(const struct options *options)
{
    bool stands_still = options->action != action_run;
    bool looks = options->action == action_equations || options->action == action_linearize;
    if (options->at_count && !looks && !options->svg)
        return usage("--at goes with --svg, --equations or --linearize", "");
    if (options->svg && stands_still && !looks)
        return usage("--svg belongs to a run, --equations or --linearize", "");
    if ((options->drawing.body || options->drawing.components) && !options->svg)
        return usage("--body and --components go with --svg", "");
    if (stands_still && (options->csv || options->json || options->html || options->plot ||
                         options->gnuplot || options->ledger || options->every > 0))
        return usage("--csv, --json, --html, --plot, --gnuplot, --ledger and --every belong to a run", "");
    if (!places_differ(options)) return false;
    if (options->plot_of && !options->plot && !options->gnuplot)
        return usage("--plot-of goes with --plot or --gnuplot", "");
    if (options->plot && !plot_can_be_written(options->plot)) return false;
    if (!options->csv && options->ledger) return usage("--ledger goes with --csv", "");
    if (!options->csv && !options->html && options->every > 0)
        return usage("--every goes with --csv or --html", "");
    if (stands_still && options->run.error_bars) return usage("--error-bars belongs to a run", "");
    return true;
}

bool options_read(int argc, char **argv, struct options *options, enum exit_code *code)
{
    *options = (struct options){.run = FBD_OPTIONS_DEFAULT, .seed = 1};
    *code = exit_usage;
    opterr = 0;
    for (int option; (option = getopt_long(argc, argv, "", long_options, NULL)) != -1;) {
        if (option == option_help || option == option_version) {
            *code = exit_done;
            if (option == option_help)
                fputs(help, stdout);
            else
                printf("fbd-run %s\n", fbd_version());
            return false;
        }
        if (option == '?' && optind > 0)
            return usage("unknown option, or one without its value: ", argv[optind - 1]);
        if (!take_option(option, options)) return false;
    }
    if (optind + 1 != argc)
        return usage(optind == argc ? "no model file given" : "more than one model file given", "");
    options->model = argv[optind];
    return options_agree(options);
}
