/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Explain which effects of a scene are simulated and which are not.
 */
#include "output/explain.h"

#include <string.h>

#include "base/api_check.h"
#include "dynamics/modes.h"
#include "fbd_export.h"
#include "integrate/method.h"
#include "output/couplings.h"
#include "output/explain_structure.h"
#include "output/words.h"

enum { most_names = 4, most_bodies = 20 };

/* Write names after one another, and count those beyond the limit: begin with *display = 0. `load` may be
 * NULL. */
static void write_name(struct text *text, size_t *display, const char *body, const char *load)
{
    if ((*display)++ >= most_names) return;
    text_printf(text, "%s%s%s%s", *display > 1 ? ", " : "", body, load ? "." : "", load ? load : "");
}

static void end_names(struct text *text, size_t display)
{
    if (display > most_names) text_printf(text, " and %zu more", display - most_names);
    text_add(text, "\n");
}

/* ---- coordinates */

static void write_coordinates(struct text *text, const struct fbd_model *model)
{
    text_printf(text, "Coordinates (%d)\n", model->plan.n);
    for (size_t b = 0; b < model->body_count && b < most_bodies; b++) {
        const struct model_body *body = &model->bodies[b];
        text_printf(text, "  %s %s", body->name, body->joint->motion);
        if (body->parent >= 0)
            text_printf(text, body->count > 0 ? " of `%s`" : " `%s`", model->bodies[body->parent].name);
        text_add(text, body->count > 0 ? ":" : "");
        for (int k = 0; k < body->count; k++)
            text_printf(text, " %s [%s]", model->scene->coordinates[body->first + k].name,
                        model->labels[body->first + k].unit);
        text_add(text, "\n");
    }
    if (model->body_count > most_bodies)
        text_printf(text, "  and those of %zu more bodies\n", model->body_count - most_bodies);
    if (model->plan.own == 0) return;
    text_printf(text, "States by equations of their own (%d):", model->plan.own);
    for (int i = 0; i < model->plan.own && i < (int)most_bodies; i++)
        text_printf(text, " %s [%s]", model->scene->own[i].name, model->own_labels[i].unit);
    text_add(text, model->plan.own > (int)most_bodies ? " ...\n" : "\n");
}

/* ---- effects that are simulated: loads of one kind and one reason together */

static bool same_effect(const struct model_load *a, const struct model_load *b)
{
    return strcmp(load_law(a->source)->effect, load_law(b->source)->effect) == 0 &&
           strcmp(a->why, b->why) == 0;
}

static void write_effect(struct text *text, const struct fbd_model *model, const struct model_load *first)
{
    size_t count = 0, display = 0;
    for (size_t i = 0; i < model->load_count; i++) count += same_effect(first, &model->loads[i]);
    text_printf(text, "  %s (%zu)", load_law(first->source)->effect, count);
    text_pad(text, 28);
    text_printf(text, "%s\n      ", first->why);
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (same_effect(first, load))
            write_name(text, &display, model->bodies[load->body].name, load->source->name);
    }
    end_names(text, display);
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        const struct spread *spread = &load->source->spread;
        if (!same_effect(first, load) || spread->length == 0) continue;
        text_printf(text, "      %s.%s is the resultant of a load over ", model->bodies[load->body].name,
                    load->source->name);
        text_number(text, spread->length, 9);
        text_add(text, " ");
        text_add(text, length_unit(model));
        text_add(text, ", ");
        text_number(text, spread->center, 9);
        text_printf(text, " %s from its start\n", length_unit(model));
    }
}

static void write_effects(struct text *text, const struct fbd_model *model)
{
    enum { most_effects = 64 }; /* upper bound of kinds times reasons */
    const struct model_load *seen[most_effects];
    size_t count = 0;
    text_printf(text, "\nEffects simulated (%zu)\n", model->load_count);
    if (model->load_count == 0) text_add(text, "  none: every body keeps its velocity\n");
    for (size_t i = 0; i < model->load_count; i++) {
        size_t k = 0;
        while (k < count && !same_effect(seen[k], &model->loads[i])) k++;
        if (k < count || count == most_effects) continue;
        seen[count++] = &model->loads[i];
        write_effect(text, model, seen[k]);
    }
}

/* ---- effects that are not simulated, and how to add them */

struct absent {
    enum load_kind kind;
    bool on[motion_kinds_count]; /* by enum motion_kind: motions to which it applies */
    bool anybody;                /* reported only when no body lists it: no body needs it */
    const char *words;
};

static const struct absent absents[] = {
    {load_gravity, {true, true, true, true}, false, "weight: list `gravity`"},
    {load_normal, {true, false, false, false}, false, "normal force and loss of contact: list `normal`"},
    {load_friction,
     {true, false, false, false},
     false,
     "dry friction: list `friction: {static: ..., kinetic: ...}` beside `normal`"},
    {moment_friction,
     {false, true, false, false},
     false,
     "friction in the bearing: list `friction: {static: ..., kinetic: ...}` under `moments`"},
    {load_drag, {true, true, true, true}, false, "drag: list `drag: {linear: ..., quadratic: ...}`"},
    {moment_damper,
     {false, true, false, true},
     true,
     "damping of the rotation: list `damper: {coefficient: ...}` under `moments`"},
    {load_spring, {true, true, true, true}, true, "springs: list `spring: {stiffness: ...}`"},
    {load_damper, {true, true, true, true}, true, "dampers: list `damper: {coefficient: ...}`"},
    {load_applied,
     {true, true, true, true},
     true,
     "forces of your own: list `applied: {name: ..., value: ...}`"},
};

static bool lists(const struct fbd_model *model, const struct model_body *body, enum load_kind kind)
{
    for (int i = 0; i < body->load_count; i++)
        if (model->loads[body->first_load + i].source->kind == kind) return true;
    return false;
}

static void write_absent(struct text *text, const struct fbd_model *model)
{
    text_add(text, "\nEffects not simulated, because they are not listed\n");
    for (size_t k = 0; k < sizeof absents / sizeof *absents; k++) {
        const struct absent *absent = &absents[k];
        size_t could = 0, without = 0, display = 0;
        for (size_t b = 0; b < model->body_count; b++) {
            if (!absent->on[model->bodies[b].kind]) continue;
            could++;
            without += !lists(model, &model->bodies[b], absent->kind);
        }
        if (without == 0 || (absent->anybody && without < could)) continue;
        text_printf(text, "  %s\n      on ", absent->words);
        for (size_t b = 0; b < model->body_count; b++)
            if (absent->on[model->bodies[b].kind] && !lists(model, &model->bodies[b], absent->kind))
                write_name(text, &display, model->bodies[b].name, NULL);
        end_names(text, display);
    }
}

/* ---- the method */

static void write_method(struct text *text, const struct fbd_model *model, const fbd_options *options)
{
    const char *name = options->method ? options->method : model->scene->simulate.method;
    const struct method *method = name ? method_find(name) : NULL;
    if (method) {
        text_printf(text, "\nMethod: %s (%s)\n  selected by %s\n", method->name, method->description,
                    options->method ? "--method" : "the file");
        return;
    }
    if (name && strcmp(name, "auto") != 0) {
        text_printf(text, "\nMethod: there is no `%s`; a run will be refused\n", name);
        return;
    }
    const struct method *stiff = method_find("rodas5p"), *other = structure_method(model, structure_general);
    bool structure = !options->no_structure && options->step == 0 &&
                     (options->automatic_step || model->scene->simulate.step == 0);
    text_printf(text, "\nMethod: auto, the default\n  %s%s (%s)\n",
                structure ? "the method for the structure above; without a special structure " : "",
                other->name, other->description);
    if (plan_size(&model->plan) <= method_most_stiff_states)
        text_printf(text, "  %s (%s)\n    where a trial step shows that its steps could be much longer\n",
                    stiff->name, stiff->description);
    else
        text_printf(text, "  always: beyond %d states the algebra of %s costs more than it could save\n",
                    method_most_stiff_states, stiff->name);
}

char *fbd_explain(const fbd_model *model, const fbd_options *options)
{
    fbd_options own = FBD_OPTIONS_DEFAULT;
    if (!model || !api_take_options(&own, sizeof own, options, NULL)) return NULL;
    struct text text = {0};
    struct fbd_state *state = state_new(model);
    if (!state) return NULL;
    modes_settle(state, NULL); /* a failure is reported by the run */
    struct rates *rates = rates_new(state, rates_by_rows);
    if (rates) {
        write_coordinates(&text, model);
        couplings_explain(&text, state);
        write_effects(&text, model);
        write_absent(&text, model);
        explain_plan(&text, model, rates);
        if (!explain_structure(&text, model, &own)) text.failed = true;
        write_method(&text, model, &own);
    }
    rates_free(rates);
    state_free(state);
    if (text.failed) text_free(&text);
    return text.data;
}
