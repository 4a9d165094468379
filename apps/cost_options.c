/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cost_options.h"

#include <string.h>

#include "fbd_study.h"
#include "place.h"

static const char help[] =
    "Usage: fbd-cost [options] MODEL.yaml\n"
    "Run every method at a ladder of tolerances on a scene and show the cost of accuracy: true error "
    "against\ntime, the cheapest method for each accuracy, and the uncertainty of the true motion.\n"
    "\n"
    "Measurement\n"
    "  --set NAME=VALUE     give a parameter of the file another value (may be repeated)\n"
    "  --until TIME         end of the run, in seconds\n"
    "  --methods A,B,...    these methods (default: all)\n"
    "  --fixed-steps        ladders of fixed steps in place of tolerances\n"
    "  --of A,B,...         errors of these coordinates and rates (default: all)\n"
    "  --budget SECONDS     approximate total time (default 6); longer where others use the processor\n"
    "  --effects            instead: leave out each effect of the scene in turn, and show the change of "
    "the\n                       answer and of the time\n"
    "\n"
    "Output (FILE may be - for standard output, which leaves the table out)\n"
    "  --csv FILE           a row for each method and setting, or each effect\n"
    "  --json FILE          the same with reference and answers, as one object\n"
    "  --svg FILE           the work-precision diagram\n"
    "  --quiet              no table\n"
    "  --completion SHELL   completion of these options for bash, zsh or fish\n"
    "  -h, --help, --version\n"
    "\n"
    "Exit codes: 0 done, 1 the run fails or its true motion cannot be computed to the end, 2 usage, 3 the "
    "model\n"
    "file is wrong, 4 the exact solution of the file is not that of the scene.\n";

enum {
    option_set = option_first,
    option_until,
    option_methods,
    option_fixed_steps,
    option_of,
    option_budget,
    option_effects,
    option_csv,
    option_json,
    option_svg,
    option_quiet,
};

static const struct option long_options[] = {
    {"set", required_argument, NULL, option_set},
    {"until", required_argument, NULL, option_until},
    {"methods", required_argument, NULL, option_methods},
    {"fixed-steps", no_argument, NULL, option_fixed_steps},
    {"of", required_argument, NULL, option_of},
    {"budget", required_argument, NULL, option_budget},
    {"effects", no_argument, NULL, option_effects},
    {"csv", required_argument, NULL, option_csv},
    {"json", required_argument, NULL, option_json},
    {"svg", required_argument, NULL, option_svg},
    {"quiet", no_argument, NULL, option_quiet},
    COMMAND_LINE_END,
};

static const struct command_line line = {"fbd-cost", {help}, long_options, NULL, false};

static bool usage(const char *message, const char *what)
{
    return command_line_usage(&line, message, what);
}

/* Read A,B,...; the argument is cut in pieces. */
static bool read_list(const char *option, char *text, const char **names, size_t *count)
{
    for (char *name = text; name;) {
        char *comma = strchr(name, ',');
        if (comma) *comma = '\0';
        if (!*name || *count == most_names) return usage("a list of names, as a,b,c, is wanted by ", option);
        names[(*count)++] = name;
        name = comma ? comma + 1 : NULL;
    }
    return true;
}

static bool take_positive(const char *name, double *value)
{
    return command_line_number(&line, name, optarg, 1e-300, value);
}

static bool take_option(const struct command_line *unused, int option, void *context)
{
    struct cost_options *options = context;
    fbd_cost_options *study = &options->study;
    (void)unused;
    switch (option) {
    case option_set: return command_line_setting(&line, optarg, options->settings, &options->setting_count);
    case option_until: return command_line_time(&line, "until", optarg, 1e-300, &study->until);
    case option_budget: return take_positive("budget", &study->budget);
    case option_methods:
        study->methods = options->methods;
        return read_list("--methods", optarg, options->methods, &study->method_count);
    case option_of:
        study->quantities = options->quantities;
        return read_list("--of", optarg, options->quantities, &study->quantity_count);
    case option_fixed_steps: study->fixed_steps = true; return true;
    case option_effects: options->effects = true; return true;
    case option_csv: options->csv = optarg; return true;
    case option_json: options->json = optarg; return true;
    case option_svg: options->svg = optarg; return true;
    case option_quiet: options->quiet = true; return true;
    default: return usage("unknown option, or an option without its value", "");
    }
}

enum { place_count = 4 };

static void list_places(const struct cost_options *options, struct output_place places[place_count])
{
    bool table = !options->quiet && !place_is_stdout(options->csv) && !place_is_stdout(options->json) &&
                 !place_is_stdout(options->svg);
    places[0] = (struct output_place){"--csv", options->csv};
    places[1] = (struct output_place){"--json", options->json};
    places[2] = (struct output_place){"--svg", options->svg};
    places[3] = (struct output_place){"the table", table ? "-" : NULL};
}

/* Refuse options that would have no effect. */
static bool options_agree(const struct cost_options *options)
{
    const fbd_cost_options *study = &options->study;
    if (options->effects && (options->svg || study->methods || study->fixed_steps))
        return usage("--effects has no --svg, --methods or --fixed-steps", "");
    struct output_place places[place_count];
    list_places(options, places);
    return places_differ(&line, options->model, places, place_count);
}

bool cost_options_spare(const struct cost_options *options, const fbd_errors *errors)
{
    struct output_place places[place_count];
    list_places(options, places);
    return places_spare(&line, errors, places, place_count);
}

bool cost_options_read(int argc, char **argv, struct cost_options *options, enum exit_code *code)
{
    *options = (struct cost_options){.study = FBD_COST_OPTIONS_DEFAULT};
    return command_line_read(&line, argc, argv, take_option, options, &options->model, code) &&
           options_agree(options);
}
