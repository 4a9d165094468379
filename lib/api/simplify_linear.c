/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The linearisation of a scene of jointed bodies about an equilibrium (q_0, 0),
 *
 *     q'' = K (q - q_0) + C q',   (K C) the lower half of the system matrix,
 *
 * as a scene itself: a mass of 1 kg on a line of its own for each coordinate.
 */
#include <string.h>

#include "api/simplify.h"
#include "base/text.h"

static void coefficient(struct text *text, double value)
{
    text_add(text, value < 0 ? " - " : " + ");
    text_number(text, fabs(value), 17);
}

/* Write force i as an expression of all coordinates and rates; the names are those of the bodies below. */
static void write_force(struct text *text, size_t n, size_t i, const struct equilibrium *about)
{
    const double *row = about->matrix + (n + i) * 2 * n;
    text_add(text, "0[N]");
    for (size_t k = 0; k < n; k++) {
        if (row[k] != 0) {
            coefficient(text, row[k]);
            text_printf(text, "[N/m]*(q%zu.x - (", k);
            text_number(text, about->at[k], 17);
            text_add(text, "[m]))");
        }
        if (row[n + k] != 0) {
            coefficient(text, row[n + k]);
            text_printf(text, "[N*s/m]*q%zu.v", k);
        }
    }
}

fbd_model *simplify_linear_scene(const struct fbd_simplifications *list, const struct equilibrium *about,
                                 fbd_errors *errors)
{
    struct text text = {0};
    size_t n = list->model->scene->coordinate_count;
    const double *start = list->start;
    text_add(&text, "fbd: 1\nbodies:\n");
    for (size_t i = 0; i < n; i++) {
        text_printf(&text, "  q%zu:\n    mass: 1 kg\n    motion: slide\n    initial: {x: ", i);
        text_number(&text, start[i], 17);
        text_add(&text, " m, v: ");
        text_number(&text, start[n + i], 17);
        text_add(&text, " m/s}\n    forces:\n      - applied: {value: \"");
        write_force(&text, n, i, about);
        text_add(&text, "\"}\n");
    }
    fbd_model *model = NULL;
    if (text.failed)
        diag_out_of_memory(errors);
    else
        model = fbd_model_parse(text.data, text.length, "linear", NULL, 0, errors);
    text_free(&text);
    return model;
}
