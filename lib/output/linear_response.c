/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The frequency response of a linear system as a table (CSV) and as a Bode plot by gnuplot: magnitude in the unit of the
 * output by that of the input, and phase in degrees.
 *
 * The phase is that of the solved response, on the branch of transfer_phase, which is continuous.
 */
#include <math.h>
#include <stdlib.h>

#include "base/gnuplot.h"
#include "output/linear_text.h"

enum { digits = 10 };

static const double degree = 57.295779513082321;

/* The responses, [pair * count + i]; pair = output * inputs + input. */
struct responses {
    struct arena arena;
    const struct fbd_linear_system *system;
    double *omega, *magnitude, *phase; /* phase in degrees */
    size_t count, pairs;
};

static double phase_on_branch(const struct transfer *transfer, double omega, fbd_complex response)
{
    const double turn = 360, near = degree * transfer_phase(transfer, omega);
    if (!isfinite(response.re) || transfer->gain == 0) return near;
    double phase = degree * atan2(response.im, response.re);
    return phase + turn * round((near - phase) / turn);
}

static bool respond(struct responses *responses, size_t pair)
{
    const struct fbd_linear_system *system = responses->system;
    struct arena *arena = &responses->arena;
    struct siso siso;
    struct transfer transfer;
    if (!linear_system_siso(system, pair % system->input_count, pair / system->input_count, arena, &siso) ||
        transfer_find(&siso, arena, &transfer) <= 0)
        return false;
    for (size_t i = 0; i < responses->count; i++) {
        struct arena scratch = {0};
        fbd_complex H;
        bool fine = siso_response(&siso, &scratch, responses->omega[i], &H);
        arena_free(&scratch);
        if (!fine) return false;
        responses->magnitude[pair * responses->count + i] = hypot(H.re, H.im);
        responses->phase[pair * responses->count + i] = phase_on_branch(&transfer, responses->omega[i], H);
    }
    return true;
}

static bool find_responses(struct responses *responses, const struct fbd_linear_system *system)
{
    *responses = (struct responses){.system = system, .pairs = system->input_count * system->output_count};
    responses->omega = linear_system_frequencies(system, &responses->arena, &responses->count);
    if (!responses->omega) return false;
    size_t numbers = responses->count * responses->pairs;
    responses->magnitude = ARENA_ARRAY(&responses->arena, numbers + 1, double);
    responses->phase = ARENA_ARRAY(&responses->arena, numbers + 1, double);
    bool fine = responses->magnitude && responses->phase;
    for (size_t pair = 0; fine && pair < responses->pairs; pair++) fine = respond(responses, pair);
    return fine;
}

static const fbd_signal *input_of(const struct responses *responses, size_t pair)
{
    return &responses->system->inputs[pair % responses->system->input_count];
}

static const fbd_signal *output_of(const struct responses *responses, size_t pair)
{
    return &responses->system->outputs[pair / responses->system->input_count];
}

/* ---- CSV */

static void write_head(struct text *text, const struct responses *responses)
{
    text_add(text, "omega [rad/s]");
    for (size_t pair = 0; pair < responses->pairs; pair++) {
        const fbd_signal *from = input_of(responses, pair), *to = output_of(responses, pair);
        text_printf(text, ",%s/%s [", to->name, from->name);
        linear_write_unit(text, to->unit, from->unit);
        text_printf(text, "],%s/%s phase [deg]", to->name, from->name);
    }
    text_add(text, "\n");
}

static void write_values(struct text *text, const struct responses *responses, size_t row,
                         const char *between)
{
    text_exact(text, responses->omega[row]);
    for (size_t pair = 0; pair < responses->pairs; pair++) {
        size_t at = pair * responses->count + row;
        text_add(text, between);
        text_exact(text, responses->magnitude[at]);
        text_add(text, between);
        text_exact(text, responses->phase[at]);
    }
    text_add(text, "\n");
}

char *fbd_linear_system_csv(const fbd_linear_system *system)
{
    if (!system) return NULL;
    struct responses responses;
    struct text text = {0};
    text.failed = !find_responses(&responses, system);
    if (!text.failed) write_head(&text, &responses);
    for (size_t row = 0; !text.failed && row < responses.count; row++)
        write_values(&text, &responses, row, ",");
    arena_free(&responses.arena);
    if (text.failed) text_free(&text);
    return text.data;
}

/* ---- plot */

static void write_curves(struct text *text, const struct responses *responses, size_t offset, bool titled)
{
    for (size_t pair = 0; pair < responses->pairs; pair++) {
        text_printf(text, "%s$data using 1:%zu with lines linecolor %zu ", pair ? ", \\\n     " : "plot ",
                    2 * pair + 2 + offset, pair + 1);
        if (!titled) {
            text_add(text, "notitle");
            continue;
        }
        struct text title = {0}, unit = {0};
        linear_write_unit(&unit, output_of(responses, pair)->unit, input_of(responses, pair)->unit);
        text_printf(&title, "%s by %s [", output_of(responses, pair)->name, input_of(responses, pair)->name);
        gnuplot_unit(&title, unit.data ? unit.data : "");
        text_add(&title, "]");
        text->failed |= title.failed || unit.failed;
        text_add(text, "title ");
        gnuplot_quote(text, title.data ? title.data : "");
        text_add(text, " noenhanced");
        text_free(&title);
        text_free(&unit);
    }
    text_add(text, "\n");
}

static void write_script(struct text *text, const struct responses *responses, const char *file)
{
    gnuplot_begin(text, file, 2);
    text_add(text, "$data << END\n");
    for (size_t row = 0; row < responses->count; row++) write_values(text, responses, row, " ");
    text_add(text, "END\nset multiplot layout 2,1 title ");
    gnuplot_quote(text, responses->system->linear->model->scene->title);
    text_add(text, " noenhanced\nset grid\nset lmargin 12\nset rmargin 4\nset logscale x\nset format x "
                   "'10^{%L}'\nset xrange [");
    text_number(text, responses->omega[0], digits);
    text_add(text, ":");
    text_number(text, responses->omega[responses->count - 1], digits);
    text_add(text,
             "]\nset key inside right top\nset logscale y\nset format y '10^{%L}'\nset ylabel 'magnitude'\n");
    write_curves(text, responses, 0, true);
    text_add(text, "unset logscale y\nset format y '%g'\nset ytics 90\nset ylabel 'phase [deg]'\n"
                   "set xlabel 'frequency [rad/s]'\n");
    write_curves(text, responses, 1, false);
    text_add(text, "unset multiplot\n");
}

char *fbd_linear_system_gnuplot(const fbd_linear_system *system, const char *file)
{
    if (!system) return NULL;
    struct responses responses;
    struct text text = {0};
    text.failed = !find_responses(&responses, system);
    if (!text.failed) write_script(&text, &responses, file);
    arena_free(&responses.arena);
    if (text.failed) text_free(&text);
    return text.data;
}
