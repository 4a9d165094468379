/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/gnuplot.h"

#include <string.h>

#include "base/utf8.h"

enum { digits = 10, plot_width = 900, plot_height = 300 };

/* A quote at the start, or the second of two in a row, would end the string; such a quote becomes a typographic one.
 * Gnuplot's SVG output does not escape the end of a CDATA section, which XML forbids in a text. */
void gnuplot_quote(struct text *text, const char *string)
{
    char before = '\'';
    text_add(text, "'");
    while (*string) {
        struct utf8_shown next = utf8_show(string);
        if (*string == '\'')
            text_add(text, before == '\'' ? "\u2019" : "''");
        else
            text_add_bytes(text, next.text, next.length);
        if (strncmp(string, "]>", 2) == 0) text_add(text, " ");
        before = *string;
        string += next.taken;
    }
    text_add(text, "'");
}

void gnuplot_unit(struct text *text, const char *unit)
{
    for (; *unit; unit++) {
        if (*unit == '*')
            text_add(text, "·");
        else if (unit[0] == '^' && (unit[1] == '2' || unit[1] == '3'))
            text_add(text, *++unit == '2' ? "²" : "³");
        else
            text_add_bytes(text, unit, 1);
    }
}

static bool ends_with(const char *string, const char *end)
{
    size_t length = strlen(string), tail = strlen(end);
    return length >= tail && strcmp(string + length - tail, end) == 0;
}

static void write_terminal(struct text *text, const char *file, size_t plots)
{
    size_t height = plots * plot_height + 40;
    if (ends_with(file, ".svg"))
        text_printf(text, "set terminal svg size %d,%zu dynamic font 'Arial,13' background 'white'\n",
                    plot_width, height);
    else if (ends_with(file, ".pdf"))
        text_printf(text, "set terminal pdfcairo size 18cm,%gcm font 'Arial,9'\n",
                    18.0 * (double)height / plot_width);
    else if (ends_with(file, ".png"))
        text_printf(text, "set terminal pngcairo size %d,%zu font 'Arial,11'\n", plot_width, height);
}

void gnuplot_begin(struct text *text, const char *file, size_t plots)
{
    text_add(text, "# A script for gnuplot, written by fbd\n");
    if (file) write_terminal(text, file, plots);
}

void gnuplot_layout(struct text *text, const char *title, size_t plots, double from, double to)
{
    text_printf(text, "set multiplot layout %zu,1 title ", plots);
    gnuplot_quote(text, title);
    text_add(text, " noenhanced\nset grid\nset key inside left top horizontal maxcols 3 samplen 2\nset "
                   "xlabel 'time t [s]'\n");
    text_add(text, "set lmargin 12\nset rmargin 4\nset xrange [");
    text_number(text, from, digits);
    text_add(text, ":");
    text_number(text, to, digits);
    text_add(text, "]\n");
}
