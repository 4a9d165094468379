/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep_options.h"

#include <string.h>

#include "fbd_study.h"
#include "place.h"

static const char help[] =
    "Usage: fbd-sweep --vary NAME=VALUES [options] MODEL.yaml\n"
    "Run a model for many values of its parameters and write one table, a row for each run.\n"
    "\n"
    "Parameters\n"
    "  --vary NAME=VALUES   a parameter of the file, with units as there (may be repeated):\n"
    "                         mu=0.1:0.6:51             51 values from 0.1 to 0.6\n"
    "                         k='1:1000 N/m:4:log'      1, 10, 100, 1000 N/m\n"
    "                         v0='1,2,5 m/s'            a list\n"
    "                         road=dry.csv,wet.csv      files of a table\n"
    "                         m='uniform(1,2) kg:100'   random draws; also normal(mean,deviation) and\n"
    "                                                   loguniform(low,high)\n"
    "                         'a=1,2,3; b=4,5,6'        side by side\n"
    "  --zip                all side by side (default: each value with each, the last changing fastest)\n"
    "  --seed NUMBER        seed of the random draws (default 1)\n"
    "\n"
    "Simulation\n"
    "  --set NAME=VALUE     give a parameter of the file another value (may be repeated)\n"
    "  --method NAME, --tolerance NUMBER, --step TIME, --until TIME\n"
    "                       as for fbd-run\n"
    "  --no-structure       integrate all bodies together by the general method\n"
    "  --jobs NUMBER        threads (default: one for each processor; under mpirun one for each rank)\n"
    "\n"
    "Output\n"
    "  --output LIST        outputs of each run (may be repeated; default final,times):\n"
    "                         t, block.x, block.v       at the end of the run\n"
    "                         rod.right.x, rod.G.ay     of a point in the world: .x .y .vx .vy .ax .ay, of "
    "an accelerometer .proper_ax .proper_ay\n"
    "                         M(beam, 0.4 m), V(beam, L/2), N(beam, right)   of a section of a straight "
    "body\n"
    "                         min(block.x), max(rod.right.y)   over the run\n"
    "                         time(land), count(land)   of an event of the file, a kind (stick) or one of a\n"
    "                                                   body (block.stick): first time, number\n"
    "                         energy.kinetic .potential .work .residual, block.friction.work\n"
    "                         steps, rhs                the cost of the run\n"
    "                         final, times, energy      groups of these\n"
    "  --find QUESTION      instead of outputs, the value of one more parameter at which a run changes or\n"
    "                       has a result, as `fbd-run --find`: 'P = 0..40 N: crate tips'\n"
    "  --static             with --find: of the scene at rest at its start\n"
    "  --runs NUMBER        with --find: runs of the first scan of its range (default 33)\n"
    "  --degrees            angles and their rates in degrees; varied parameters stay as given\n"
    "  --csv FILE           file of the table (default: standard output); FILE.part until it is complete\n"
    "  --resume             continue FILE.part\n"
    "  --quiet              no progress, no summary\n"
    "  --completion SHELL   completion of these options for bash, zsh or fish\n"
    "  -h, --help, --version\n"
    "\n"
    "Exit codes: 0 all runs succeeded, 1 some did not (their rows have the reasons), 2 usage, 3 the model "
    "file\nis wrong; ended by a signal: 128 and its number, and the rows so far are kept.\n";

enum {
    option_vary = option_first,
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
    option_degrees,
    option_find,
    option_static,
    option_runs,
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
    {"degrees", no_argument, NULL, option_degrees},
    {"find", required_argument, NULL, option_find},
    {"static", no_argument, NULL, option_static},
    {"runs", required_argument, NULL, option_runs},
    COMMAND_LINE_END,
};

static bool take_text(const struct command_line *line, const char **texts, size_t *count, const char *name)
{
    if (*count == most_texts) return command_line_usage(line, "too many --", name);
    texts[(*count)++] = optarg;
    return true;
}

static bool take_jobs(const struct command_line *line, size_t *jobs)
{
    enum { most_jobs = 1024 };
    unsigned long value;
    if (!command_line_whole(line, "--jobs wants a number of threads from 1 to 1024, not ", optarg, 1,
                            most_jobs, &value))
        return false;
    *jobs = value;
    return true;
}

static bool take_runs(const struct command_line *line, size_t *runs)
{
    unsigned long value;
    if (!command_line_whole(line, "--runs wants a number of runs from 3 to 1000000, not ", optarg, 3, 1000000,
                            &value))
        return false;
    *runs = value;
    return true;
}

static bool take_option(const struct command_line *line, int option, void *context)
{
    const double tiny = 1e-300; /* excludes 0 */
    struct sweep_options *options = context;
    fbd_sweep_plan *plan = &options->plan;
    switch (option) {
    case option_vary: return take_text(line, options->vary, &plan->vary_count, "vary");
    case option_output: return take_text(line, options->outputs, &plan->output_count, "output");
    case option_zip: plan->zip = true; return true;
    case option_seed:
        return command_line_whole(line, "--seed wants a whole number, not ", optarg, 0, ~0UL, &plan->seed);
    case option_set: return command_line_setting(line, optarg, options->settings, &plan->setting_count);
    case option_method: options->run.method = optarg; return true;
    case option_tolerance:
        return command_line_number(line, "tolerance", optarg, tiny, &options->run.tolerance);
    case option_step: return command_line_number(line, "step", optarg, tiny, &options->run.step);
    case option_no_structure: options->run.no_structure = true; return true;
    case option_until: return command_line_time(line, "until", optarg, -1e300, &options->run.until);
    case option_jobs: return take_jobs(line, &options->jobs);
    case option_csv: options->csv = optarg; return true;
    case option_resume: options->resume = true; return true;
    case option_quiet: options->quiet = true; return true;
    case option_degrees: plan->degrees = true; return true;
    case option_find: plan->find = optarg; return true;
    case option_static: plan->statics = true; return true;
    case option_runs: return take_runs(line, &plan->find_runs);
    default: return command_line_usage(line, "unknown option, or an option without its value", "");
    }
}

static bool options_agree(const struct command_line *line, struct sweep_options *options)
{
    if (place_is_stdout(options->csv)) options->csv = NULL;
    if (options->plan.vary_count == 0)
        return command_line_usage(line,
                                  "nothing varies: give --vary NAME=VALUES (or use fbd-run for one run)", "");
    const fbd_sweep_plan *plan = &options->plan;
    if (plan->find && (plan->output_count > 0 || plan->degrees))
        return command_line_usage(line, "--find takes the place of --output and --degrees", "");
    if (!plan->find && (plan->statics || plan->find_runs))
        return command_line_usage(line, "--static and --runs go with --find", "");
    if (options->resume && !options->csv)
        return command_line_usage(line, "--resume goes with --csv FILE: it goes on with FILE.part", "");
    return true;
}

/* The temporary names of the table must not be the model file either. */
bool sweep_outputs_differ(const struct sweep_options *options, const fbd_errors *errors)
{
    const struct command_line line = {"fbd-sweep", {help}, long_options, NULL, false};
    char target[place_size], part[place_size + 16] = "", key[place_size + 16] = "";
    if (options->csv && place_descriptor(options->csv) < 0 && place_target(options->csv, target)) {
        snprintf(part, sizeof part, "%s.part", target);
        snprintf(key, sizeof key, "%s.part.key", target);
    }
    const struct output_place places[] = {{"--csv", options->csv ? options->csv : "-"},
                                          {"--csv", part[0] ? part : NULL},
                                          {"--csv", key[0] ? key : NULL}};
    size_t count = sizeof places / sizeof *places;
    return places_differ(&line, options->model, places, count) && places_spare(&line, errors, places, count);
}

bool sweep_options_read(int argc, char **argv, bool silent, struct sweep_options *options,
                        enum exit_code *code)
{
    const struct command_line line = {"fbd-sweep", {help}, long_options, NULL, silent};
    *options = (struct sweep_options){.run = FBD_OPTIONS_DEFAULT, .plan = {.run = &options->run, .seed = 1}};
    options->plan.settings = options->settings;
    options->plan.vary = options->vary;
    options->plan.outputs = options->outputs;
    return command_line_read(&line, argc, argv, take_option, options, &options->model, code) &&
           options_agree(&line, options);
}
