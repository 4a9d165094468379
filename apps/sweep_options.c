/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep_options.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: fbd-sweep --vary NAME=VALUES [options] MODEL.yaml\n"
    "Run a model under many values of its parameters and write one table, a row for each run.\n"
    "\n"
    "What varies\n"
    "  --vary NAME=VALUES   a parameter of the file, with units as there (may be repeated):\n"
    "                         mu=0.1:0.6:51             51 values from 0.1 to 0.6\n"
    "                         k='1:1000 N/m:4:log'      1, 10, 100, 1000 N/m\n"
    "                         v0='1,2,5 m/s'            a list\n"
    "                         m='uniform(1,2) kg:100'   random draws; also normal(mean,deviation) and\n"
    "                                                   loguniform(low,high)\n"
    "                         'a=1,2,3; b=4,5,6'        side by side\n"
    "  --zip                all side by side (default: each value with each, the last changing fastest)\n"
    "  --seed NUMBER        seed of the random draws (default 1)\n"
    "\n"
    "What is simulated\n"
    "  --set NAME=VALUE     give a parameter of the file another value (may be repeated)\n"
    "  --method NAME, --tolerance NUMBER, --step TIME, --until TIME\n"
    "                       as for fbd-run\n"
    "  --no-structure       integrate all bodies together by the general method\n"
    "  --jobs NUMBER        threads (default: one for each processor; under mpirun one for each rank)\n"
    "\n"
    "What is written\n"
    "  --output LIST        what is noted of each run (may be repeated; default final,times):\n"
    "                         t, block.x, block.v       at the end of the run\n"
    "                         min(block.x), max(block.v)   over the run\n"
    "                         time(land), count(land)   of an event of the file, a kind (stick) or one of a\n"
    "                                                   body (block.stick): when first, how often\n"
    "                         energy.kinetic .potential .work .residual, block.friction.work\n"
    "                         steps, rhs                what the run has cost\n"
    "                         final, times, energy      groups of these\n"
    "  --csv FILE           where the table goes (default: standard output); FILE.part until it is whole\n"
    "  --resume             go on with FILE.part\n"
    "  --quiet              no progress, no summary\n"
    "  --help, --version\n"
    "\n"
    "Exit codes: 0 all runs ended well, 1 some did not (their rows say why), 2 usage, 3 the model file is\n"
    "wrong; ended by a signal: 128 and its number, and what has been computed is kept.\n";

enum {
    option_vary = 256,
    option_zip,
    option_seed,
    option_set,
    option_method,
    option_tolerance,
    option_step,
    option_no_structure,
    option_until,
    option_jobs,
    option_output,
    option_csv,
    option_resume,
    option_quiet,
    option_help,
    option_version,
};

static const struct option long_options[] = {
    {"vary", required_argument, NULL, option_vary},
    {"zip", no_argument, NULL, option_zip},
    {"seed", required_argument, NULL, option_seed},
    {"set", required_argument, NULL, option_set},
    {"method", required_argument, NULL, option_method},
    {"tolerance", required_argument, NULL, option_tolerance},
    {"step", required_argument, NULL, option_step},
    {"no-structure", no_argument, NULL, option_no_structure},
    {"until", required_argument, NULL, option_until},
    {"jobs", required_argument, NULL, option_jobs},
    {"output", required_argument, NULL, option_output},
    {"csv", required_argument, NULL, option_csv},
    {"resume", no_argument, NULL, option_resume},
    {"quiet", no_argument, NULL, option_quiet},
    {"help", no_argument, NULL, option_help},
    {"version", no_argument, NULL, option_version},
    {NULL, 0, NULL, 0},
};

static bool usage(const struct sweep_options *options, const char *message, const char *what)
{
    if (!options->silent) fprintf(stderr, "fbd-sweep: %s%s\nTry `fbd-sweep --help`.\n", message, what);
    return false;
}

/* A number of the command line, as in C; the program runs in the C locale. */
static bool read_number(const struct sweep_options *options, const char *name, const char *text, double least,
                        double *value)
{
    char *end;
    errno = 0;
    *value = strtod(text, &end);
    if (end != text && !*end && errno != ERANGE && *value >= least && *value <= 1e300) return true;
    if (!options->silent)
        fprintf(stderr, "fbd-sweep: --%s wants a number%s, not `%s`\nTry `fbd-sweep --help`.\n", name,
                least > 0 ? " above 0" : "", text);
    return false;
}

static bool read_whole(const struct sweep_options *options, const char *message, const char *text,
                       unsigned long least, unsigned long most, unsigned long *value)
{
    char *end;
    errno = 0;
    *value = strtoul(text, &end, 10);
    bool digits = text[0] >= '0' && text[0] <= '9';
    if (digits && !*end && !errno && *value >= least && *value <= most) return true;
    return usage(options, message, text);
}

/* NAME=VALUE; the argument is cut in two. */
static bool read_setting(struct sweep_options *options, char *text)
{
    char *equals = strchr(text, '=');
    if (!equals || equals == text || !equals[1]) return usage(options, "--set wants NAME=VALUE, not ", text);
    if (options->plan.setting_count == most_texts) return usage(options, "too many --set", "");
    *equals = '\0';
    options->settings[options->plan.setting_count++] = (fbd_setting){text, equals + 1};
    return true;
}

static bool take_text(const struct sweep_options *options, const char **texts, size_t *count,
                      const char *name)
{
    if (*count == most_texts) return usage(options, "too many --", name);
    texts[(*count)++] = optarg;
    return true;
}

static bool take_jobs(struct sweep_options *options)
{
    enum { most_jobs = 1024 };
    unsigned long jobs;
    if (!read_whole(options, "--jobs wants a number of threads from 1 to 1024, not ", optarg, 1, most_jobs,
                    &jobs))
        return false;
    options->jobs = jobs;
    return true;
}

static bool take_option(int code, struct sweep_options *options)
{
    const double tiny = 1e-300; /* above 0 */
    fbd_sweep_plan *plan = &options->plan;
    switch (code) {
    case option_vary: return take_text(options, options->vary, &plan->vary_count, "vary");
    case option_output: return take_text(options, options->outputs, &plan->output_count, "output");
    case option_zip: plan->zip = true; return true;
    case option_seed:
        return read_whole(options, "--seed wants a whole number, not ", optarg, 0, ~0UL, &plan->seed);
    case option_set: return read_setting(options, optarg);
    case option_method: plan->run.method = optarg; return true;
    case option_tolerance: return read_number(options, "tolerance", optarg, tiny, &plan->run.tolerance);
    case option_step: return read_number(options, "step", optarg, tiny, &plan->run.step);
    case option_no_structure: plan->run.no_structure = true; return true;
    case option_until: return read_number(options, "until", optarg, -1e300, &plan->run.until);
    case option_jobs: return take_jobs(options);
    case option_csv: options->csv = optarg; return true;
    case option_resume: options->resume = true; return true;
    case option_quiet: options->quiet = true; return true;
    default: return usage(options, "unknown option, or an option without its value", "");
    }
}

static bool options_agree(struct sweep_options *options)
{
    if (options->csv && strcmp(options->csv, "-") == 0) options->csv = NULL;
    if (options->plan.vary_count == 0)
        return usage(options, "nothing varies: give --vary NAME=VALUES (or use fbd-run for one run)", "");
    if (options->resume && !options->csv)
        return usage(options, "--resume goes with --csv FILE: it goes on with FILE.part", "");
    return true;
}

static bool say(const struct sweep_options *options, enum sweep_exit *code, int option)
{
    *code = sweep_done;
    if (options->silent) return false;
    if (option == option_help)
        fputs(help, stdout);
    else
        printf("fbd-sweep %s\n", fbd_version());
    return false;
}

bool sweep_options_read(int argc, char **argv, struct sweep_options *options, enum sweep_exit *code)
{
    *options =
        (struct sweep_options){.silent = options->silent, .plan = {.run = FBD_OPTIONS_DEFAULT, .seed = 1}};
    options->plan.settings = options->settings;
    options->plan.vary = options->vary;
    options->plan.outputs = options->outputs;
    *code = sweep_usage;
    opterr = 0;
    for (int option; (option = getopt_long(argc, argv, "", long_options, NULL)) != -1;) {
        if (option == option_help || option == option_version) return say(options, code, option);
        if (option == '?' && optind > 0)
            return usage(options, "unknown option, or one without its value: ", argv[optind - 1]);
        if (!take_option(option, options)) return false;
    }
    if (optind + 1 != argc)
        return usage(options, optind == argc ? "no model file given" : "more than one model file given", "");
    options->model = argv[optind];
    return options_agree(options);
}
