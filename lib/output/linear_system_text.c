/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A linear system with inputs and outputs as text and as one JSON object (docs/output.md).
 */
#include <math.h>
#include <string.h>

#include "output/linear_text.h"

enum { digits = 9 };

/* ---- text */

void linear_write_unit(struct text *text, const char *output, const char *input)
{
    const bool pure = strcmp(input, "1") == 0 || !input[0];
    const char *above = output[0] ? output : "1";
    const char *form = pure ? "%s" : strchr(above, '/') ? "(%s)/" : "%s/";
    text_printf(text, form, above);
    if (!pure) text_printf(text, strpbrk(input, "*/") ? "(%s)" : "%s", input);
}

static void write_signals(struct text *text, const char *symbol, const fbd_signal *signals, size_t count)
{
    text_printf(text, "%s = (", symbol);
    for (size_t i = 0; i < count; i++) text_printf(text, "%s%s", i ? ", " : "", signals[i].name);
    text_add(text, ")");
}

static void write_matrices(struct text *text, const struct fbd_linear_system *system)
{
    enum { largest = 12 };
    const size_t size = system->linear->size, m = system->input_count, p = system->output_count;
    text_add(text, "\nx' = A x + B u, y = C x + D u for the deviations ");
    write_signals(text, "u", system->inputs, m);
    text_add(text, ", ");
    write_signals(text, "y", system->outputs, p);
    if (size > largest || m > largest || p > largest) {
        text_printf(text, "\nB is %zu x %zu, C %zu x %zu\n", size, m, p, size);
        return;
    }
    text_add(text, ", B =\n");
    linear_write_rows(text, system->B, size, m);
    text_add(text, "C =\n");
    linear_write_rows(text, system->C, p, size);
    text_add(text, "D =\n");
    linear_write_rows(text, system->D, p, m);
}

static void write_roots(struct text *text, const char *name, const fbd_complex *roots, size_t count)
{
    text_printf(text, "    %s ", name);
    for (size_t i = 0; i < count; i++) {
        if (roots[i].im < 0) continue; /* the conjugate is redundant */
        text_add(text, i ? ", " : "");
        double re = fabs(roots[i].re) < 1e-12 * fabs(roots[i].im) ? 0 : roots[i].re;
        if (roots[i].im == 0) {
            text_number(text, re, digits);
            continue;
        }
        if (re != 0) {
            text_number(text, re, digits);
            text_add(text, " ");
        }
        text_add(text, "+- ");
        text_number(text, roots[i].im, digits);
        text_add(text, " i");
    }
    text_add(text, count > 0 ? " 1/s\n" : "none\n");
}

static void write_transfer(struct text *text, const struct fbd_linear_system *system,
                           const fbd_transfer *transfer, size_t input, size_t output)
{
    const fbd_signal *from = &system->inputs[input], *to = &system->outputs[output];
    text_printf(text, "  %s by %s: ", to->name, from->name);
    if (transfer->gain == 0) {
        text_add(text, "0\n");
        return;
    }
    text_add(text, "gain ");
    text_number(text, transfer->gain, digits);
    text_add(text, ", static gain ");
    if (isfinite(transfer->static_gain)) {
        text_number(text, transfer->static_gain, digits);
        text_add(text, " ");
        linear_write_unit(text, to->unit, from->unit);
        text_add(text, "\n");
    } else {
        text_add(text, isnan(transfer->static_gain) ? "not determined: a pole and a zero at 0\n"
                                                    : "infinite: a pole at 0\n");
    }
    write_roots(text, "zeros", transfer->zeros, transfer->zero_count);
    write_roots(text, "poles", transfer->poles, transfer->pole_count);
}

/* Write each transfer function by `write`. False where one is not found. */
typedef void write_one(struct text *text, const struct fbd_linear_system *system,
                       const fbd_transfer *transfer, size_t input, size_t output);

static void write_transfers(struct text *text, const struct fbd_linear_system *system, write_one *write)
{
    for (size_t output = 0; output < system->output_count; output++)
        for (size_t input = 0; input < system->input_count; input++) {
            fbd_transfer *transfer = fbd_transfer_new(system, input, output, NULL);
            if (transfer)
                write(text, system, transfer, input, output);
            else
                text->failed = true;
            fbd_transfer_free(transfer);
        }
}

char *fbd_linear_system_text(const fbd_linear_system *system)
{
    if (!system) return NULL;
    struct text text = {0};
    linear_write_text(&text, system->linear);
    write_matrices(&text, system);
    text_add(&text, "\nTransfer functions gain prod(s - zeros) / prod(s - poles)\n");
    write_transfers(&text, system, write_transfer);
    if (text.failed) text_free(&text);
    return text.data;
}

/* ---- JSON */

static void write_names(struct text *text, const char *name, const fbd_signal *signals, size_t count)
{
    text_add(text, "  ");
    text_json_key(text, name);
    text_add(text, "[");
    for (size_t i = 0; i < count; i++) {
        text_add(text, i ? ", {" : "{");
        text_json_words(text, "name", signals[i].name, ", ");
        text_json_words(text, "unit", signals[i].unit, "}");
    }
    text_add(text, "],\n");
}

static void write_json_roots(struct text *text, const char *name, const fbd_complex *roots, size_t count)
{
    text_json_key(text, name);
    text_add(text, "[");
    for (size_t i = 0; i < count; i++) {
        text_add(text, i ? ", {" : "{");
        text_json_member(text, "re", roots[i].re, ", ");
        text_json_member(text, "im", roots[i].im, "}");
    }
    text_add(text, "]");
}

static void write_json_transfer(struct text *text, const struct fbd_linear_system *system,
                                const fbd_transfer *transfer, size_t input, size_t output)
{
    text_add(text, input + output > 0 ? ",\n    {" : "\n    {");
    text_json_words(text, "input", system->inputs[input].name, ", ");
    text_json_words(text, "output", system->outputs[output].name, ", ");
    text_json_member(text, "gain", transfer->gain, ", ");
    text_json_member(text, "static_gain", transfer->static_gain, ",\n     ");
    write_json_roots(text, "zeros", transfer->zeros, transfer->zero_count);
    text_add(text, ",\n     ");
    write_json_roots(text, "poles", transfer->poles, transfer->pole_count);
    text_add(text, "}");
}

char *fbd_linear_system_json(const fbd_linear_system *system)
{
    if (!system) return NULL;
    const size_t size = system->linear->size, m = system->input_count, p = system->output_count;
    struct text text = {0};
    text_add(&text, "{\n");
    linear_write_json(&text, system->linear);
    text_add(&text, ",\n");
    write_names(&text, "inputs", system->inputs, m);
    write_names(&text, "outputs", system->outputs, p);
    linear_write_json_matrix(&text, "B", system->B, size, m);
    linear_write_json_matrix(&text, "C", system->C, p, size);
    linear_write_json_matrix(&text, "D", system->D, p, m);
    text_add(&text, "  \"transfer_functions\": [");
    write_transfers(&text, system, write_json_transfer);
    text_add(&text, "]\n}\n");
    if (text.failed) text_free(&text);
    return text.data;
}
