/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "study/fit.h"

/* ---- text */

static void write_number(struct text *text, double value, int digits)
{
    if (isfinite(value))
        text_number(text, value, digits);
    else
        text_add(text, "unknown");
}

static void write_fitted(struct text *text, const fbd_fitted *fitted)
{
    text_printf(text, "  %s", fitted->name);
    text_pad(text, 16);
    text_add(text, "= ");
    text_number(text, fitted->value, 9);
    text_printf(text, fitted->unit[0] ? " %s" : "%s", fitted->unit);
    text_pad(text, 42);
    text_add(text, "+- ");
    write_number(text, fitted->error, 3);
    text_pad(text, 60);
    text_add(text, "95 %: ");
    write_number(text, fitted->low, 6);
    text_add(text, " to ");
    write_number(text, fitted->high, 6);
    text_add(text, "\n");
}

static void write_correlations(struct text *text, const fbd_fit *fit)
{
    if (fit->count < 2) return;
    text_add(text, "\nCorrelations\n");
    for (size_t a = 1; a < fit->count; a++) {
        text_printf(text, "  %s", fit->fitted[a].name);
        for (size_t b = 0; b < a; b++) {
            text_pad(text, 16 + 14 * b);
            text_printf(text, "%s ", fit->fitted[b].name);
            write_number(text, fbd_fit_correlation(fit, a, b), 3);
        }
        text_add(text, "\n");
    }
}

static void write_quality(struct text *text, const fbd_fit *fit)
{
    const fbd_fit_quality quality = fbd_fit_summary(fit);
    text_add(text, quality.weighted ? "\nSum of squares of the weighted residuals "
                                    : "\nSum of squares of the residuals ");
    text_number(text, quality.squares, 6);
    text_printf(text, ", %zu degrees of freedom", quality.freedom);
    text_add(text,
             quality.weighted ? "; its root per degree of freedom " : "; standard deviation of a value ");
    write_number(text, quality.deviation, 4);
    text_printf(text, quality.unit[0] ? " %s\n" : "%s\n", quality.unit);
    text_printf(text, "%zu iterations, %zu runs\n", quality.iterations, quality.runs);
}

char *fbd_fit_text(const fbd_fit *fit)
{
    if (!fit) return NULL;
    struct text text = {0};
    text_printf(&text, "Fit to %zu values of ", fit->data.count);
    for (size_t i = 0; i < fit->data.column_count; i++)
        text_printf(&text, i ? ", %s" : "%s", fit->data.columns[i]);
    text_add(&text, "\n");
    for (size_t k = 0; k < fit->count; k++) write_fitted(&text, &fit->fitted[k]);
    write_correlations(&text, fit);
    write_quality(&text, fit);
    if (text.failed) text_free(&text);
    return text.data;
}

/* ---- JSON */

static void json_fitted(struct text *text, const fbd_fitted *fitted)
{
    text_add(text, "{");
    text_json_words(text, "name", fitted->name, ", ");
    text_json_words(text, "unit", fitted->unit, ", ");
    text_json_member(text, "value", fitted->value, ", ");
    text_json_member(text, "error", fitted->error, ", ");
    text_json_member(text, "low", fitted->low, ", ");
    text_json_member(text, "high", fitted->high, "}");
}

static void json_correlations(struct text *text, const fbd_fit *fit)
{
    for (size_t a = 0; a < fit->count; a++) {
        text_add(text, a ? ",\n    [" : "\n    [");
        for (size_t b = 0; b < fit->count; b++) {
            text_add(text, b ? ", " : "");
            text_json_number(text, fbd_fit_correlation(fit, a, b));
        }
        text_add(text, "]");
    }
}

char *fbd_fit_json(const fbd_fit *fit)
{
    if (!fit) return NULL;
    struct text text = {0};
    const fbd_fit_quality quality = fbd_fit_summary(fit);
    text_add(&text, "{\n  \"parameters\": [");
    for (size_t k = 0; k < fit->count; k++) {
        text_add(&text, k ? ",\n    " : "\n    ");
        json_fitted(&text, &fit->fitted[k]);
    }
    text_add(&text, "],\n  \"correlations\": [");
    json_correlations(&text, fit);
    text_printf(&text, "],\n  \"values\": %zu, \"freedom\": %zu, ", quality.values, quality.freedom);
    text_json_flag(&text, "weighted", quality.weighted, ",\n  ");
    text_json_member(&text, "squares", quality.squares, ", ");
    text_json_member(&text, "deviation", quality.deviation, ", ");
    text_json_words(&text, "unit", quality.unit, ",\n");
    text_printf(&text, "  \"iterations\": %zu, \"runs\": %zu\n}\n", quality.iterations, quality.runs);
    if (text.failed) text_free(&text);
    return text.data;
}
