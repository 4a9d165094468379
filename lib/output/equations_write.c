/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/equations_write.h"

#include "base/api_check.h"
#include "output/kinematic_lines.h"

static const struct equations_pass *const formats[][4] = {
    [FBD_TEXT] = {&text_numbers, &text_symbols},
    [FBD_SYMBOLS] = {&text_symbols},
    [FBD_LATEX] = {&latex_equations},
    [FBD_MATHML] = {&mathml_equations},
    [FBD_JSON] = {&json_equations, &json_kinematics, &json_forces},
};

static void walk_kinematics(struct writer *w, const struct equations_pass *pass, int b)
{
    const char *lines[most_kinematic_lines];
    const int count = kinematic_lines(&w->formulas, b, lines);
    for (int i = 0; i < count; i++) w->text->failed |= !lines[i];
    if (count == 0 || w->text->failed) return;
    pass->kinematics(w, b, lines, count);
    w->written++;
}

static void walk_idle(struct writer *w, const struct equations_pass *pass, int b)
{
    struct idle_line lines[idle_kinds];
    const int count = idle_lines(&w->formulas, b, lines);
    for (int i = 0; i < count; i++) {
        w->text->failed |= !lines[i].symbols;
        if (lines[i].symbols) pass->idle(w, &lines[i]);
    }
}

static void walk(struct writer *w, const struct equations_pass *pass)
{
    const struct fbd_model *model = w->state->model;
    const fbd_equations *all = w->all;
    w->written = 0;
    if (pass->begin) pass->begin(w);
    for (size_t b = 0, i = 0; b < model->body_count && !w->text->failed; b++) {
        if (pass->body) pass->body(w, (int)b);
        for (; i < all->count && all->equations[i].body == (int)b; i++) {
            if (!pass->equation || !pass->includes(w, &all->equations[i])) continue;
            pass->equation(w, &all->equations[i]);
            w->written++;
        }
        if (pass->idle && body_is_cut_free(model, (int)b, w->components)) walk_idle(w, pass, (int)b);
        if (pass->kinematics && body_is_cut_free(model, (int)b, w->components))
            walk_kinematics(w, pass, (int)b);
    }
    if (pass->end) pass->end(w);
}

/* Symbols are optional in text and JSON, since numbering takes the square of the number of bodies. */
static bool is_symbolic(const struct fbd_model *model, fbd_format format, bool components)
{
    if (format == FBD_TEXT) return equations_cut_free(model, components);
    return format != FBD_JSON || equations_cut_free(model, true);
}

void equations_put(struct text *text, struct fbd_state *state, fbd_format format, bool components)
{
    struct writer w = {.text = text, .state = state, .components = components || format == FBD_SYMBOLS};
    w.symbolic = is_symbolic(state->model, format, components);
    w.all = assemble(state, components || w.symbolic || format == FBD_JSON);
    if (!w.all || (w.symbolic && !formulas_begin(&w.formulas, state))) text->failed = true;
    const struct equations_pass *const *passes = formats[format];
    for (size_t i = 0; passes[i] && !text->failed; i++)
        if (w.symbolic || !passes[i]->symbolic) walk(&w, passes[i]);
    text->failed |= w.formulas.arena.failed;
    formulas_end(&w.formulas);
    fbd_equations_free(w.all);
}

static char *write_equations(fbd_state *state, const fbd_equations_options *options, fbd_errors *errors)
{
    struct text text = {0};
    if ((size_t)options->format >= sizeof formats / sizeof *formats)
        return api_refuse(errors, "there is no such format");
    equations_put(&text, state, options->format, options->components);
    if (!text.failed) return text.data;
    diag_out_of_memory(errors);
    text_free(&text);
    return NULL;
}

char *fbd_equations_write(fbd_state *state, const fbd_equations_options *options, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_equations_options own = {.format = FBD_TEXT};
    char *text = NULL;
    if (!state)
        api_refuse(errors, "there is no state");
    else if (api_take_options(&own, sizeof own, options, errors))
        text = write_equations(state, &own, errors);
    diag_end(&call);
    return text;
}
