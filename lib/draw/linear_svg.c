/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The eigenvalues of a linearisation in the complex plane: decay to the left, growth to the right, frequency
 * upward. The angle from the negative real axis is the arc cosine of the damping ratio.
 */
#include <string.h>

#include "base/format.h"
#include "draw/labelling.h"
#include "fbd_study.h"
#include "fbd_view.h"

static const double width = 130, height = 110, left = 16, right = 8, top = 24, bottom = 16;
static const double text_size = 3.4;

struct plane {
    struct arena arena;
    const fbd_linearization *linear;
    size_t count;               /* of eigenvalues */
    double unit;                /* in 1/s; 1 except near the limits of a double, where sums would overflow */
    struct vec low, high, step; /* of the axes, in units, and distance of ticks */
    struct labelling labels;
    struct text text;
};

/* The position on paper. */
static struct vec at(const struct plane *plane, double re, double im)
{
    double x = (re - plane->low.x) / (plane->high.x - plane->low.x),
           y = (im - plane->low.y) / (plane->high.y - plane->low.y);
    return (struct vec){left + x * (width - left - right), height - bottom - y * (height - top - bottom)};
}

static struct vec mode_at(const struct plane *plane, const fbd_mode *mode)
{
    return at(plane, mode->re / plane->unit, mode->im / plane->unit);
}

/* ---- axes */

/* 1, 2 or 5 times a power of ten, so that `range` has about five ticks. */
static double tick_step(double range)
{
    double power = pow(10, floor(log10(range / 5))), share = range / 5 / power;
    return power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

/* Extend an axis to contain all eigenvalues and zero, and to end on ticks. */
static void set_range(double *low, double *high, double *step, double other)
{
    double range = *high - *low;
    if (!(range > 0)) range = other > 0 ? other : 2;
    double middle = (*low + *high) / 2;
    *step = tick_step(1.3 * range);
    *low = *step * floor((middle - 0.6 * range) / *step);
    *high = *step * ceil((middle + 0.6 * range) / *step);
}

static void set_axes(struct plane *plane)
{
    const double largest = 1e300;
    struct vec low = {0, 0}, high = {0, 0};
    plane->unit = 1;
    for (size_t i = 0; i < plane->count; i++)
        if (fbd_linearization_mode(plane->linear, i).frequency > largest) plane->unit = 1e10;
    for (size_t i = 0; i < plane->count; i++) {
        fbd_mode mode = fbd_linearization_mode(plane->linear, i);
        double re = mode.re / plane->unit, im = mode.im / plane->unit;
        low = (struct vec){fmin(low.x, re), fmin(low.y, im)};
        high = (struct vec){fmax(high.x, re), fmax(high.y, im)};
    }
    double wide = high.x - low.x, tall = high.y - low.y;
    /* real parts of an undamped pair are at round-off level */
    if (wide < 1e-9 * tall) low.x = high.x = 0;
    set_range(&low.x, &high.x, &plane->step.x, tall / 2);
    set_range(&low.y, &high.y, &plane->step.y, wide / 2);
    plane->low = low;
    plane->high = high;
}

static void tick(struct plane *plane, double place, bool real)
{
    struct text *text = &plane->text;
    double value = place * plane->unit;
    if (!isfinite(value)) return;
    struct vec from = real ? at(plane, place, plane->low.y) : at(plane, plane->low.x, place),
               to = real ? at(plane, place, plane->high.y) : at(plane, plane->high.x, place);
    char number[40];
    format_into(number, sizeof number, "%.6g", value);
    svg_line(text, value == 0 ? "ground" : "hatch", from, to);
    if (real)
        svg_text(text, "note", (struct vec){from.x, from.y + 4}, 2.9, number);
    else
        svg_text_at(text, "note", (struct vec){from.x - 1.5 - svg_text_width(number, 2.6), from.y + 1},
                    number);
}

static void draw_axes(struct plane *plane)
{
    long first = lround(plane->low.x / plane->step.x), last = lround(plane->high.x / plane->step.x);
    for (long i = first; i <= last; i++) tick(plane, (double)i * plane->step.x, true);
    first = lround(plane->low.y / plane->step.y);
    last = lround(plane->high.y / plane->step.y);
    for (long i = first; i <= last; i++) tick(plane, (double)i * plane->step.y, false);
    svg_text(&plane->text, "axis-label", (struct vec){(left + width - right) / 2, height - 4}, text_size,
             "real part [1/s]: decay to the left, growth to the right");
    svg_text_at(&plane->text, "axis-label", (struct vec){5, top - 4}, "imaginary part [rad/s]");
}

/* ---- eigenvalues */

static const char *class_of(const fbd_mode *mode)
{
    double small = 1e-12 * mode->frequency;
    return mode->re > small ? "unstable" : mode->re < -small ? "stable" : "neutral";
}

static const char *name_of(struct plane *plane, const fbd_mode *mode)
{
    double re = fabs(mode->re) < 1e-12 * mode->frequency ? 0 : mode->re;
    const char *minus = re < 0 ? "−" : "";
    if (mode->im == 0) return arena_printf(&plane->arena, "%s%.4g", minus, fabs(re));
    const char *sign = mode->im > 0 ? "+" : "−";
    if (re == 0) return arena_printf(&plane->arena, "%s%.4g i", mode->im > 0 ? "" : "−", fabs(mode->im));
    return arena_printf(&plane->arena, "%s%.4g %s %.4g i", minus, fabs(re), sign, fabs(mode->im));
}

static void draw_modes(struct plane *plane)
{
    for (size_t i = 0; i < plane->count; i++) {
        fbd_mode mode = fbd_linearization_mode(plane->linear, i);
        struct vec center = mode_at(plane, &mode);
        const struct vec anywhere = {1, -0.4};
        labelling_add(&plane->labels, name_of(plane, &mode), text_size, center,
                      vec_scale(1 / vec_norm(anywhere), anywhere), 1.8);
        labelling_avoid(&plane->labels, (struct vec){center.x - 1, center.y},
                        (struct vec){center.x + 1, center.y}, 30);
    }
    labelling_avoid(&plane->labels, at(plane, plane->low.x, 0), at(plane, plane->high.x, 0), 3);
    labelling_avoid(&plane->labels, at(plane, 0, plane->low.y), at(plane, 0, plane->high.y), 3);
    if (!labelling_solve(&plane->labels)) return;
    for (size_t i = 0; i < plane->labels.label_count; i++) {
        fbd_mode mode = fbd_linearization_mode(plane->linear, i);
        const struct label_place *label = &plane->labels.labels[i];
        text_printf(&plane->text, "<g class=\"eigenvalue\" id=\"eigenvalue-%zu\">\n<title>", i + 1);
        text_printf(&plane->text, "%.9g %+.9g i 1/s", mode.re, mode.im);
        if (mode.frequency > 0)
            text_printf(&plane->text, ": frequency %.9g rad/s, damping ratio %.6g", mode.frequency,
                        mode.damping_ratio);
        text_add(&plane->text, "</title>\n");
        if (label->leader) svg_line(&plane->text, "leader", label->anchor, labelling_leader(label));
        svg_circle(&plane->text, class_of(&mode), mode_at(plane, &mode), 1.1);
        svg_text(&plane->text, "label", label->center, text_size, label->text);
        text_add(&plane->text, "</g>\n");
    }
}

char *fbd_linearization_svg(const fbd_linearization *linearization)
{
    if (!linearization) return NULL;
    struct plane plane = {.linear = linearization, .count = fbd_linearization_size(linearization)};
    plane.labels.arena = &plane.arena;
    const char *title = fbd_model_title(fbd_linearization_model(linearization));
    svg_begin(&plane.text, (struct vec){width, height}, 1, title[0] ? title : "Eigenvalues",
              "Eigenvalues of the linear system about the equilibrium, in the complex plane");
    svg_text_at(&plane.text, "heading", (struct vec){5, 9}, title[0] ? title : "Eigenvalues");
    svg_text_at(&plane.text, "note", (struct vec){5, 14}, "Eigenvalues about the equilibrium");
    set_axes(&plane);
    draw_axes(&plane);
    draw_modes(&plane);
    text_add(&plane.text, "</svg>\n");
    if (plane.arena.failed) plane.text.failed = true;
    arena_free(&plane.arena);
    if (plane.text.failed) text_free(&plane.text);
    return plane.text.data;
}
