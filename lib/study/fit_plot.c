/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The data of a fit and the fitted run, as a script for gnuplot.
 */
#include <math.h>
#include <string.h>

#include "base/gnuplot.h"
#include "study/fit.h"

enum { digits = 10 };

/* ---- the fitted run */

/* Data of zero at equal intervals, whose residuals are the values of the run; column after column in each row. */
static bool make_zeros(struct fbd_fit *fit, struct fit_data *zeros)
{
    const size_t columns = fit->data.column_count;
    const double last = fit->data.values[fit->data.count - 1].t;
    *zeros = fit->data;
    zeros->count = fit_curve_rows * columns;
    zeros->values = ARENA_ARRAY(&fit->arena, zeros->count, struct fit_value);
    for (size_t i = 0; zeros->values && i < zeros->count; i++) {
        const double share = (double)(i / columns) / (fit_curve_rows - 1);
        zeros->values[i] = (struct fit_value){.t = share * last, .deviation = 1, .column = i % columns};
    }
    return zeros->values != NULL;
}

bool fit_make_curve(struct fbd_fit *fit)
{
    const size_t columns = fit->data.column_count;
    struct fit_data zeros;
    double *p = ARENA_ARRAY(&fit->arena, fit->count, double);
    if (!p || !make_zeros(fit, &zeros)) return false;
    double *r = ARENA_ARRAY(&fit->arena, zeros.count, double);
    fit->curve = ARENA_ARRAY(&fit->arena, fit_curve_rows * (columns + 1), double);
    if (!r || !fit->curve) return false;
    for (size_t k = 0; k < fit->count; k++) p[k] = fit->fitted[k].value;
    if (!fit_residuals(fit, &zeros, p, r)) return false;
    for (size_t row = 0; row < fit_curve_rows; row++) {
        fit->curve[row * (columns + 1)] = zeros.values[row * columns].t;
        memcpy(fit->curve + row * (columns + 1) + 1, r + row * columns, columns * sizeof *r);
    }
    return true;
}

/* ---- the script */

static void write_numbers(struct text *text, const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        text_add(text, i ? " " : "");
        text_number(text, numbers[i], digits);
    }
    text_add(text, "\n");
}

/* Measured values of a column; of many data a part. */
static void write_measured(struct text *text, const struct fbd_fit *fit, size_t column)
{
    const struct fit_data *data = &fit->data;
    const size_t step = 1 + data->count / gnuplot_most_rows;
    size_t seen = 0;
    text_printf(text, "$measured%zu << END\n", column + 1);
    for (size_t i = 0; i < data->count; i++) {
        const struct fit_value *value = &data->values[i];
        if (value->column != column || seen++ % step != 0) continue;
        write_numbers(text, (const double[]){value->t, value->value, value->deviation},
                      data->weighted ? 3 : 2);
    }
    text_add(text, "END\n");
}

static void write_curve(struct text *text, const struct fbd_fit *fit)
{
    const size_t numbers = fit->data.column_count + 1;
    text_add(text, "$fit << END\n");
    for (size_t row = 0; row < fit_curve_rows; row++)
        write_numbers(text, fit->curve + row * numbers, numbers);
    text_add(text, "END\n");
}

static void write_plot(struct text *text, const struct fbd_fit *fit, size_t column)
{
    struct text title = {0};
    text_printf(&title, "%s [", fit->data.columns[column]);
    gnuplot_unit(&title, fit->data.units[column]);
    text_add(&title, "]");
    text->failed |= title.failed;
    text_add(text, "set ylabel ");
    gnuplot_quote(text, title.data ? title.data : "");
    text_free(&title);
    text_printf(text,
                " noenhanced\nplot $fit using 1:%zu with lines linecolor 2 linewidth 2 title 'fit', \\\n"
                "     $measured%zu with %s linecolor 1 pointtype 7 pointsize 0.5 title 'measured'\n",
                column + 2, column + 1, fit->data.weighted ? "yerrorbars" : "points");
}

/* "Fit: c = 0.5021 N*m*s, L = 1 m" */
static void write_title(struct text *text, const struct fbd_fit *fit)
{
    enum { title_digits = 6 };
    text_add(text, "Fit: ");
    for (size_t k = 0; k < fit->count; k++) {
        text_printf(text, "%s%s = ", k ? ", " : "", fit->fitted[k].name);
        text_number(text, fit->fitted[k].value, title_digits);
        text_add(text, fit->fitted[k].unit[0] ? " " : "");
        gnuplot_unit(text, fit->fitted[k].unit);
    }
}

char *fbd_fit_gnuplot(const fbd_fit *fit, const char *file)
{
    if (!fit) return NULL;
    const size_t plots = fit->data.column_count;
    struct text text = {0}, title = {0};
    gnuplot_begin(&text, file, plots);
    for (size_t column = 0; column < plots; column++) write_measured(&text, fit, column);
    write_curve(&text, fit);
    write_title(&title, fit);
    text.failed |= title.failed;
    gnuplot_layout(&text, title.data ? title.data : "", plots, 0, fit->data.values[fit->data.count - 1].t);
    text_free(&title);
    text_add(&text, "set offsets 0, 0, graph 0.15, graph 0.04\n");
    for (size_t column = 0; column < plots; column++) write_plot(&text, fit, column);
    text_add(&text, "unset multiplot\n");
    if (text.failed) text_free(&text);
    return text.data;
}
