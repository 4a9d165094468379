/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "command_line.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "completion.h"
#include "fbd_export.h"
#include "model_names.h"
#include "standard_streams.h"

enum exit_code exit_code_for(enum exit_code code, fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++)
        if (strcmp(fbd_errors_get(errors, i).id, "out-of-memory") == 0) return exit_failed;
    return code;
}

static void point_to_help(const struct command_line *line)
{
    complain("Try `%s --help`.", line->program);
}

bool command_line_usage(const struct command_line *line, const char *message, const char *what)
{
    if (line->silent) return false;
    complain("%s: %s%s", line->program, message, what);
    point_to_help(line);
    return false;
}

static void print_schema(enum exit_code *code)
{
    char *schema = fbd_schema();
    if (schema)
        fputs(schema, stdout);
    else
        *code = exit_failed;
    if (!schema) complain("out of memory");
    fbd_free(schema);
}

static bool no_completion(const struct command_line *line, enum exit_code *code)
{
    *code = exit_usage;
    return command_line_usage(line, "--completion is for bash, zsh or fish, not ", optarg);
}

/* Report a word that is similar to an option, or an option without its value. */
static bool refuse_option(const struct command_line *line, const char *text)
{
    const char *nearest = completion_nearest(line, text);
    if (line->silent || !nearest)
        return command_line_usage(line, "unknown option, or one without its value: ", text);
    bool exact = strcmp(text + strspn(text, "-"), nearest) == 0;
    if (exact)
        complain("%s: --%s wants a value behind it", line->program, nearest);
    else
        complain("%s: unknown option %s: did you mean --%s?", line->program, text, nearest);
    point_to_help(line);
    return false;
}

static bool says_itself(int option)
{
    return option == option_help || option == 'h' || option == option_version || option == option_schema ||
           option == option_completion;
}

static bool write_examples(const struct command_line *line, const char *kind)
{
    const bool asked = line->write_examples && strcmp(kind, "examples") == 0;
    if (asked) line->write_examples();
    return asked;
}

/* `next`: the word after the option and its value, or NULL. */
static bool say(const struct command_line *line, int option, const char *next, enum exit_code *code)
{
    *code = exit_done;
    if (line->silent) return false;
    if (option == option_help || option == 'h')
        for (int i = 0; i < 2 && line->help[i]; i++) fputs(line->help[i], stdout);
    else if (option == option_schema)
        print_schema(code);
    else if (option == option_completion && !completion_write(line, optarg) &&
             !model_names_write(optarg, next) && !write_examples(line, optarg))
        return no_completion(line, code);
    else if (option == option_version)
        printf("%s %s\n", line->program, fbd_version());
    if (!standard_output_arrives(line->program)) *code = exit_failed;
    return false;
}

bool command_line_options(const struct command_line *line, int argc, char **argv, command_line_take *take,
                          void *options, enum exit_code *code)
{
    *code = exit_usage;
    opterr = 0;
    for (int option; (option = getopt_long(argc, argv, "h", line->options, NULL)) != -1;) {
        if (says_itself(option)) return say(line, option, argv[optind], code);
        if (option == '?') return refuse_option(line, argv[optind - 1]);
        if (!take(line, option, options)) return false;
    }
    return true;
}

bool command_line_model(const struct command_line *line, int argc, char **argv, const char **model)
{
    if (optind + 1 != argc)
        return command_line_usage(line,
                                  optind == argc ? "no model file given" : "more than one model file given",
                                  "");
    *model = argv[optind];
    return true;
}

bool command_line_read(const struct command_line *line, int argc, char **argv, command_line_take *take,
                       void *options, const char **model, enum exit_code *code)
{
    return command_line_options(line, argc, argv, take, options, code) &&
           command_line_model(line, argc, argv, model);
}

bool command_line_number(const struct command_line *line, const char *option, const char *text, double least,
                         double *value)
{
    const double most = 1e300;
    char *end;
    errno = 0;
    *value = strtod(text, &end);
    if (end != text && !*end && errno != ERANGE && *value >= least && *value <= most) return true;
    if (line->silent) return false;
    complain("%s: --%s wants a number%s, not `%s`", line->program, option, least > 0 ? " above 0" : "", text);
    point_to_help(line);
    return false;
}

bool command_line_seconds(const char *text, double *value)
{
    static const struct {
        const char *name;
        double seconds;
    } units[] = {{"", 1}, {"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"min", 60}, {"h", 3600}};
    char *end;
    errno = 0;
    double number = strtod(text, &end);
    if (end == text || errno == ERANGE) return false;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcmp(end + strspn(end, " "), units[i].name) != 0) continue;
        *value = number * units[i].seconds;
        return true;
    }
    return false;
}

bool command_line_time(const struct command_line *line, const char *option, const char *text, double least,
                       double *value)
{
    const double most = 1e300;
    if (command_line_seconds(text, value) && *value >= least && *value <= most) return true;
    if (line->silent) return false;
    complain("%s: --%s wants a time%s, as `2`, `2 s` or `200ms`, not `%s`", line->program, option,
             least > 0 ? " above 0" : "", text);
    point_to_help(line);
    return false;
}

bool command_line_whole(const struct command_line *line, const char *wanted, const char *text,
                        unsigned long least, unsigned long most, unsigned long *value)
{
    char *end;
    errno = 0;
    *value = strtoul(text, &end, 10);
    bool digits = text[0] >= '0' && text[0] <= '9';
    if (digits && !*end && !errno && *value >= least && *value <= most) return true;
    return command_line_usage(line, wanted, text);
}

bool command_line_setting(const struct command_line *line, char *text, fbd_setting *settings, size_t *count)
{
    char *equals = strchr(text, '=');
    if (!equals || equals == text || !equals[1])
        return command_line_usage(line, "--set wants NAME=VALUE, not ", text);
    if (*count == most_settings) return command_line_usage(line, "too many --set", "");
    *equals = '\0';
    settings[(*count)++] = (fbd_setting){text, equals + 1};
    return true;
}
