/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gnuplot.h"

#include <stddef.h>

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
