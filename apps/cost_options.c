/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cost_options.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: fbd-cost [options] MODEL.yaml\n"
    "Run every method at a ladder of tolerances on a scene and show what accuracy costs: true error against\n"
    "time, the cheapest way to each accuracy, and how well the true motion is known.\n"
    "\n"
    "What is measured\n"
    "  --set NAME=VALUE     give a parameter of the file another value (may be repeated)\n"
    "  --until TIME         end of the run, in seconds\n"
    "  --methods A,B,...    these methods (default: all)\n"
    "  --fixed-steps        ladders of fixed steps in place of tolerances\n"
    "  --of A,B,...         errors of these coordinates and rates (default: all)\n"
    "  --budget SECONDS     about how long all may take (default 6)\n"
    "  --effects            instead: leave out each effect of the scene in turn, and show how much the "
    "answer\n"
    "                       changes and how much time it saves\n"
    "\n"
    "What is written (FILE may be - for standard output, which leaves the table out)\n"
    "  --csv FILE           a row for each method and setting, or each effect\n"
    "  --json FILE          the same with reference and answers, as one object\n"
    "  --svg FILE           the work-precision diagram\n"
    "  --quiet              no table\n"
    "  --help, --version\n"
    "\n"
    "Exit codes: 0 done, 1 the run fails or its true motion cannot be known to the end, 2 usage, 3 the "
    "model\n"
    "file is wrong, 4 the exact solution that the file gives is not that of the scene.\n";

enum {
    option_set = 256,
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
    option_help,
    option_version,
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
    {"help", no_argument, NULL, option_help},
    {"version", no_argument, NULL, option_version},
    {NULL, 0, NULL, 0},
};

static bool usage(const char *message, const char *what)
{
    fprintf(stderr, "fbd-cost: %s%s\nTry `fbd-cost --help`.\n", message, what);
    return false;
}

static bool read_positive(const char *name, const char *text, double *value)
{
    char *end;
    errno = 0;
    *value = strtod(text, &end);
    if (end != text && !*end && errno != ERANGE && *value > 0 && *value <= 1e300) return true;
    fprintf(stderr, "fbd-cost: --%s wants a number above 0, not `%s`\nTry `fbd-cost --help`.\n", name, text);
    return false;
}

/* NAME=VALUE; the argument is cut in two. */
static bool read_setting(struct cost_options *options, char *text)
{
    char *equals = strchr(text, '=');
    if (!equals || equals == text || !equals[1]) return usage("--set wants NAME=VALUE, not ", text);
    if (options->setting_count == most_settings) return usage("too many --set", "");
    *equals = '\0';
    options->settings[options->setting_count++] = (fbd_setting){text, equals + 1};
    return true;
}

/* A,B,...; the argument is cut in pieces. */
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

static bool take_option(int code, struct cost_options *options)
{
    fbd_cost_options *study = &options->study;
    switch (code) {
    case option_set: return read_setting(options, optarg);
    case option_until: return read_positive("until", optarg, &study->until);
    case option_budget: return read_positive("budget", optarg, &study->budget);
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

static bool same_place(const char *one, const char *other)
{
    return one && other && strcmp(one, other) == 0;
}

/* Options that would be passed over in silence are mistakes. */
static bool options_agree(const struct cost_options *options)
{
    const fbd_cost_options *study = &options->study;
    if (options->effects && (options->svg || study->methods || study->fixed_steps))
        return usage("--effects has no --svg, --methods or --fixed-steps", "");
    if (same_place(options->csv, options->json) || same_place(options->csv, options->svg) ||
        same_place(options->json, options->svg))
        return usage("two of --csv, --json and --svg cannot go to the same place", "");
    return true;
}

bool cost_options_read(int argc, char **argv, struct cost_options *options, enum exit_code *code)
{
    *options = (struct cost_options){.study = FBD_COST_OPTIONS_DEFAULT};
    *code = exit_usage;
    opterr = 0;
    for (int option; (option = getopt_long(argc, argv, "", long_options, NULL)) != -1;) {
        if (option == option_help || option == option_version) {
            *code = exit_done;
            if (option == option_help)
                fputs(help, stdout);
            else
                printf("fbd-cost %s\n", fbd_version());
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
