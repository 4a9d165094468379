/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The common part of the command lines of the programs: options that all of them have, and messages about
 * wrong ones.
 */
#ifndef FBD_APPS_COMMAND_LINE_H
#define FBD_APPS_COMMAND_LINE_H

#include <getopt.h>

#include "fbd.h"

/* Exit codes, on which scripts rely. A program ended by a signal returns 128 plus its number. */
enum exit_code {
    exit_done = 0,
    exit_failed = 1,       /* a failed run, a violated assumption, no memory, a full disk */
    exit_usage = 2,        /* the command line is wrong */
    exit_bad_model = 3,    /* the model file is wrong */
    exit_hand_differs = 4, /* a hand derivation, or an exact solution, differs */
    exit_inaccurate = 5,   /* the requested accuracy was not reached */
};

/* Return `code`, or exit_failed when memory was out: then the file or option may be right. */
enum exit_code exit_code_for(enum exit_code code, fbd_errors *errors);

struct command_line {
    /* help: C guarantees string literals only up to 4095 characters; the second part may be NULL */
    const char *program, *help[2];
    /* long options, including those of COMMAND_LINE_END; values of the others start at option_first */
    const struct option *options;
    void (*write_examples)(void); /* prints the names of the examples for the completion; may be NULL */
    bool silent;                  /* another process prints the messages */
};

enum { option_help = 256, option_version, option_completion, option_schema, option_first };

#define COMMAND_LINE_END                                                                                     \
    {"completion", required_argument, NULL, option_completion}, {"help", no_argument, NULL, option_help},    \
        {"version", no_argument, NULL, option_version},                                                      \
    {                                                                                                        \
        NULL, 0, NULL, 0                                                                                     \
    }

/* Takes one option with its value in `optarg`; false, with a message, when the value is wrong. */
typedef bool command_line_take(const struct command_line *line, int option, void *options);

/* Read the options and the one model file. Returns true to go on; false with *code set when the program
 * should exit (help, version, schema, completion, a mistake). */
bool command_line_read(const struct command_line *line, int argc, char **argv, command_line_take *take,
                       void *options, const char **model, enum exit_code *code);

/* The same in two steps: the options, after which `optind` is the first word after them, and the one file. */
bool command_line_options(const struct command_line *line, int argc, char **argv, command_line_take *take,
                          void *options, enum exit_code *code);
bool command_line_model(const struct command_line *line, int argc, char **argv, const char **model);

/* Print `message`, and the wrong text or "". Returns false. */
bool command_line_usage(const struct command_line *line, const char *message, const char *what);

/* A number as in C (the programs run in the C locale), at least `least`. */
bool command_line_number(const struct command_line *line, const char *option, const char *text, double least,
                         double *value);

/* A time [s]: a number, or one followed by a unit: `5 s`, `200ms`, `2 min`. */
bool command_line_seconds(const char *text, double *value);

/* A time in the form of command_line_seconds, at least `least`. */
bool command_line_time(const struct command_line *line, const char *option, const char *text, double least,
                       double *value);

/* A whole number; `wanted` is the message: "--seed wants a whole number, not ". */
bool command_line_whole(const struct command_line *line, const char *wanted, const char *text,
                        unsigned long least, unsigned long most, unsigned long *value);

enum { most_settings = 200 };

/* Append NAME=VALUE to the `*count` settings; `text` is cut in two. */
bool command_line_setting(const struct command_line *line, char *text, fbd_setting *settings, size_t *count);

#endif
