/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A linearisation as text.
 */
#include <math.h>

#include "base/text.h"
#include "fbd_study.h"
#include "output/display_units.h"
#include "output/linear_text.h"
#include "rest/linearize.h"

enum { digits = 9 };

static const double two_pi = 6.283185307179586;

static void write_equilibrium(struct text *text, const struct fbd_linearization *linear)
{
    text_add(text, "Equilibrium\n");
    for (int i = 0; i < linear->model->plan.n; i++) {
        const struct display display = display_of_component(linear->model, (size_t)i, linear->degrees);
        text_printf(text, "  %s = ", display.name);
        text_number(text, linear->q[i] / display.size, digits);
        text_printf(text, " %s\n", display.unit);
    }
    for (int i = 0; i < linear->model->plan.own; i++) {
        const struct own_label *label = &linear->model->own_labels[i];
        text_printf(text, "  %s = ", label->name);
        text_number(text, linear->q[linear->model->plan.n + i], digits);
        text_printf(text, "%s%s\n", unit_word(label->unit)[0] ? " " : "", unit_word(label->unit));
    }
}

/* Write the dependent coordinates in terms of the independent ones. */
static void write_ways(struct text *text, const struct fbd_linearization *linear)
{
    const struct label *labels = linear->model->labels;
    const double rounding = 1e-12;
    size_t n = (size_t)linear->model->plan.n, count = linear->count;
    if (!linear->way || count == n) return;
    text_add(text, "\nBy the couplings the other coordinates follow, to the first order\n");
    for (size_t i = 0, k = 0; i < n; i++) {
        if (k < count && linear->which[k] == (int)i) {
            k++;
            continue;
        }
        bool any = false;
        text_printf(text, "  d %s =", labels[i].name);
        for (size_t j = 0; j < count; j++) {
            double way = linear->way[i * count + j];
            if (fabs(way) <= rounding) continue;
            text_add(text, way < 0 ? " - " : any ? " + " : " ");
            text_number(text, fabs(way), digits);
            text_printf(text, " d %s", labels[linear->which[j]].name);
            any = true;
        }
        text_add(text, any ? "\n" : " 0\n");
    }
}

void linear_write_rows(struct text *text, const double *values, size_t rows, size_t columns)
{
    enum { width = 17 };
    for (size_t i = 0; i < rows; i++) {
        for (size_t j = 0; j < columns; j++) {
            text_pad(text, 2 + width * j);
            text_add(text, values[i * columns + j] < 0 ? "" : " ");
            text_number(text, values[i * columns + j], digits);
        }
        text_add(text, "\n");
    }
}

static void write_matrix(struct text *text, const struct fbd_linearization *linear)
{
    size_t size = linear->size;
    enum { largest = 12 };
    if (size > largest) {
        text_printf(text, "\nA is %zu x %zu\n", size, size);
        return;
    }
    text_add(text, "\nx' = A x for the deviations x = (");
    for (size_t i = 0; i < size; i++) text_printf(text, "%s%s", i ? ", " : "", linearization_name(linear, i));
    text_add(text, "), A =\n");
    linear_write_rows(text, linear->A, size, size);
}

static const char *kind_of(const fbd_mode *mode, bool degenerate)
{
    double small = 1e-12 * mode->frequency;
    if (mode->frequency == 0) return degenerate ? "no linear frequency" : "free motion";
    if (mode->re > small) return "unstable: grows";
    if (mode->im == 0) return "decays without oscillation";
    return mode->re < -small ? "oscillates and decays" : "oscillates";
}

/* A complex number as text; parts at round-off level are 0. */
static void linear_write_complex(struct text *text, double re, double im)
{
    const double round_off = 1e-12;
    text_number(text, fabs(re) < round_off * fabs(im) ? 0 : re, digits);
    if (im == 0) return;
    text_add(text, im > 0 ? " + " : " - ");
    text_number(text, fabs(im), digits);
    text_add(text, " i");
}

static void write_mode(struct text *text, const fbd_mode *mode, bool degenerate)
{
    text_add(text, "  ");
    linear_write_complex(text, mode->re, mode->im);
    text_add(text, " 1/s  ");
    text_pad(text, 36);
    if (mode->im == 0 && mode->frequency > 0) {
        text_add(text, "time constant ");
        text_number(text, 1 / mode->frequency, digits);
        text_add(text, " s; ");
    } else if (mode->frequency > 0) {
        text_add(text, "w0 = ");
        text_number(text, mode->frequency, digits);
        text_add(text, " rad/s (");
        text_number(text, mode->frequency / two_pi, digits);
        text_add(text, " Hz, period ");
        text_number(text, two_pi / mode->frequency, digits);
        text_add(text, " s), zeta = ");
        text_number(text, fabs(mode->damping_ratio) < 1e-12 ? 0 : mode->damping_ratio, digits);
        text_add(text, "; ");
    }
    text_printf(text, "%s\n", kind_of(mode, degenerate));
}

void linear_write_text(struct text *text, const struct fbd_linearization *linear)
{
    write_equilibrium(text, linear);
    write_ways(text, linear);
    write_matrix(text, linear);
    text_add(text, "\nEigenvalues\n");
    for (size_t i = 0; i < linear->size; i++)
        if (linear->modes[i].im >= 0)
            write_mode(text, &linear->modes[i], linear->degenerate); /* the conjugate is redundant */
}

char *fbd_linearization_text(const fbd_linearization *linear)
{
    if (!linear) return NULL;
    struct text text = {0};
    linear_write_text(&text, linear);
    if (text.failed) text_free(&text);
    return text.data;
}
