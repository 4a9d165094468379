/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gnuplot.h"

#include <stddef.h>
#include <string.h>

#include "program.h"

bool gnuplot_is_there(void)
{
    return program_is_there("gnuplot");
}

bool gnuplot_run(const char *script, int output)
{
    static const char *const arguments[] = {"gnuplot", "-", NULL};
    return program_run(arguments, script, output);
}

bool plot_can_be_written(const struct command_line *line, const char *file)
{
    const char *end = strrchr(file, '.');
    if (!end || (strcmp(end, ".svg") != 0 && strcmp(end, ".png") != 0 && strcmp(end, ".pdf") != 0))
        return command_line_usage(line, "--plot wants a file whose name ends in .svg, .png or .pdf, not ",
                                  file);
    if (!gnuplot_is_there())
        return command_line_usage(
            line,
            "--plot needs gnuplot, which is not installed (Debian: gnuplot-nox); --gnuplot FILE writes the "
            "script for it",
            "");
    return true;
}
