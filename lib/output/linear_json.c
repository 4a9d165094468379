/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A linearisation as one JSON object (docs/output.md).
 */
#include "base/text.h"
#include "fbd_study.h"
#include "output/display_units.h"
#include "output/linear_text.h"
#include "rest/linearize.h"

static void write_equilibrium(struct text *text, const struct fbd_linearization *linear)
{
    text_add(text, "  \"equilibrium\": {");
    const struct fbd_model *model = linear->model;
    const int n = model->plan.n, count = n + model->plan.own;
    for (int i = 0; i < count; i++)
        text_json_member(text, i < n ? model->labels[i].name : model->own_labels[i - n].name,
                         linear->q[i] /
                             (i < n ? display_of_component(model, (size_t)i, linear->degrees).size : 1),
                         i + 1 < count ? ", " : "");
    text_add(text, "},\n");
}

static void write_states(struct text *text, const struct fbd_linearization *linear)
{
    text_add(text, "  \"states\": [");
    for (size_t i = 0; i < linear->size; i++) {
        text_add(text, i ? ", " : "");
        text_json_string(text, linearization_name(linear, i));
    }
    text_add(text, "],\n");
}

void linear_write_json_matrix(struct text *text, const char *name, const double *values, size_t rows,
                              size_t columns)
{
    text_add(text, "  ");
    text_json_key(text, name);
    text_add(text, "[");
    for (size_t i = 0; i < rows; i++) {
        text_add(text, i ? ",\n        [" : "\n        [");
        for (size_t j = 0; j < columns; j++) {
            text_add(text, j ? ", " : "");
            text_json_number(text, values[i * columns + j]);
        }
        text_add(text, "]");
    }
    text_add(text, "],\n");
}

static void write_modes(struct text *text, const struct fbd_linearization *linear)
{
    text_add(text, "  \"eigenvalues\": [");
    for (size_t i = 0; i < linear->size; i++) {
        const fbd_mode *mode = &linear->modes[i];
        text_add(text, i ? ",\n    {" : "\n    {");
        text_json_member(text, "re", mode->re, ", ");
        text_json_member(text, "im", mode->im, ", ");
        text_json_member(text, "frequency", mode->frequency, ", ");
        text_json_member(text, "damping_ratio", mode->damping_ratio, "}");
    }
    text_add(text, "\n  ],\n");
}

void linear_write_json(struct text *text, const struct fbd_linearization *linear)
{
    text_add(text, "  ");
    text_json_key(text, "title");
    text_json_string(text, linear->model->scene->title);
    text_add(text, linear->degrees ? ",\n  \"angles\": \"deg\",\n" : ",\n");
    write_equilibrium(text, linear);
    write_states(text, linear);
    linear_write_json_matrix(text, "A", linear->A, linear->size, linear->size);
    if (linear->way)
        linear_write_json_matrix(text, "followers", linear->way, (size_t)linear->model->plan.n,
                                 linear->count);
    write_modes(text, linear);
    text_add(text, "  ");
    text_json_key(text, "degenerate");
    text_add(text, linear->degenerate ? "true" : "false");
}

char *fbd_linearization_json(const fbd_linearization *linear)
{
    if (!linear) return NULL;
    struct text text = {0};
    text_add(&text, "{\n");
    linear_write_json(&text, linear);
    text_add(&text, "\n}\n");
    if (text.failed) text_free(&text);
    return text.data;
}
