/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: models from files and texts, and their contents.
 */
#include <stdlib.h>

#include "base/api_check.h"
#include "base/file.h"
#include "dynamics/contact.h"
#include "dynamics/state.h"
#include "fbd_export.h"
#include "fbd_view.h"
#include "model/model.h"
#include "output/hand_forces.h"
#include "scene/schema.h"

static bool has_thin_contact(const fbd_model *model)
{
    for (int i = 0; i < model->tree->meeting_count; i++)
        if (model->tree->meetings[i].thin) return true;
    return false;
}

/* Warn of points that start exactly on a rod and leave it against their force; returns false when memory is
 * out. */
static bool warn_of_sides(const fbd_model *model, fbd_errors *errors)
{
    if (!has_thin_contact(model)) return true;
    fbd_state *state = state_new(model);
    fbd_errors *others = fbd_errors_new(); /* errors of the start are reported by the run */
    int doubtful = state && others && fbd_state_close(state, others) ? contacts_side_in_doubt(state) : -1;
    bool done = state && others && !others->out_of_memory;
    fbd_state_free(state);
    fbd_errors_free(others);
    if (doubtful < 0) return done;
    const struct constraint *source = &model->scene->constraints[model->tree->meetings[doubtful].constraint];
    diag_add(errors, FBD_WARNING, "side-by-motion", source->at,
             "start it a little off the rod, on the side where it is to be",
             "of `%s` one starts exactly on the rod and moves against its forces: it is taken to leave the "
             "rod to the side "
             "to which it moves",
             source->name);
    return done;
}

/* Compile a document without derivations, if there is nothing to say about it: a parameter that seems to be unused may be
 * that of a derivation. */
static fbd_model *compile_motion(struct document *document, const struct override *overrides, size_t count,
                                 fbd_errors *errors)
{
    const struct diag_mark mark = diag_mark(errors);
    document->without_hands = true;
    fbd_model *model = hands_compile(document, overrides, count, errors);
    document->without_hands = false;
    if (diag_mark(errors).count == mark.count) return model;
    model_free(model);
    diag_take_back(errors, mark);
    return NULL;
}

/* Takes ownership of `text`. */
static fbd_model *compile(char *text, size_t length, const char *name, const fbd_setting *settings,
                          size_t count, bool motion_only, fbd_errors *errors)
{
    struct override *overrides = calloc(count + 1, sizeof *overrides);
    fbd_model *model = NULL;
    if (overrides) {
        for (size_t i = 0; i < count; i++)
            overrides[i] = (struct override){.name = settings[i].name, .value = settings[i].value};
        struct document document;
        bool open = document_open(&document, text, length, name, errors);
        if (open && motion_only) model = compile_motion(&document, overrides, count, errors);
        if (open && !model) model = hands_compile(&document, overrides, count, errors);
        document_close(&document);
        diag_place_fixes(errors, name, text, length);
    } else {
        diag_out_of_memory(errors);
    }
    free(overrides);
    if (model && !warn_of_sides(model, errors)) {
        diag_out_of_memory(errors);
        model_free(model);
        model = NULL;
    }
    if (!model) {
        free(text);
        return NULL;
    }
    model->source = text;
    model->source_length = length;
    return model;
}

/* Check that there is a text or path, and valid settings. */
static bool is_asked(const char *text, const fbd_setting *settings, size_t count, fbd_errors *errors)
{
    if (text && api_has_settings(settings, count)) return true;
    api_refuse(errors, text ? "a setting has no name or no value" : "there is no text or path");
    return false;
}

fbd_model *fbd_model_parse(const char *text, size_t length, const char *name, const fbd_setting *settings,
                           size_t setting_count, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    bool asked = is_asked(text, settings, setting_count, errors);
    char *copy = asked ? file_copy(text, length, errors) : NULL;
    fbd_model *model = copy ? compile(copy, length, name, settings, setting_count, false, errors) : NULL;
    diag_end(&call);
    return model;
}

static fbd_model *read_file(const char *path, const fbd_setting *settings, size_t setting_count,
                            bool motion_only, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    size_t length;
    bool asked = is_asked(path, settings, setting_count, errors);
    char *text = asked ? file_text(path, &length, errors) : NULL;
    fbd_model *model =
        text ? compile(text, length, file_name(path), settings, setting_count, motion_only, errors) : NULL;
    diag_end(&call);
    return model;
}

fbd_model *fbd_model_read(const char *path, const fbd_setting *settings, size_t setting_count,
                          fbd_errors *errors)
{
    return read_file(path, settings, setting_count, false, errors);
}

fbd_model *fbd_model_read_motion(const char *path, const fbd_setting *settings, size_t setting_count,
                                 fbd_errors *errors)
{
    return read_file(path, settings, setting_count, true, errors);
}

void fbd_model_free(fbd_model *model)
{
    model_free(model);
}

const char *fbd_model_title(const fbd_model *model)
{
    if (!model) return "";
    return model->scene->title;
}

const char *fbd_model_source(const fbd_model *model, size_t *length)
{
    if (length) *length = model ? model->source_length : 0;
    return model ? model->source : NULL;
}

size_t fbd_model_body_count(const fbd_model *model)
{
    if (!model) return 0;
    return model->body_count;
}

const char *fbd_model_body_name(const fbd_model *model, size_t body)
{
    return model && body < model->body_count ? model->bodies[body].name : NULL;
}

fbd_inertia fbd_model_inertia(const fbd_model *model, size_t body)
{
    if (!model || body >= model->body_count) return (fbd_inertia){NAN, NAN, NAN, NAN, {NAN, NAN}};
    const struct model_body *b = &model->bodies[body];
    return (fbd_inertia){.mass = b->inertia.mass,
                         .I_G = b->inertia.I_G,
                         .I_O = b->I_O,
                         .L = b->joint->has_axis ? b->L : 0,
                         .G = {b->inertia.G.x, b->inertia.G.y}};
}

size_t fbd_model_coordinate_count(const fbd_model *model)
{
    if (!model) return 0;
    return model->scene->coordinate_count;
}

fbd_coordinate fbd_model_coordinate(const fbd_model *model, size_t index)
{
    if (!model) return (fbd_coordinate){.body = 0};
    if (index >= model->scene->coordinate_count) return (fbd_coordinate){.body = model->body_count};
    const struct label *label = &model->labels[index];
    return (fbd_coordinate){.name = label->name,
                            .unit = label->unit,
                            .rate_name = label->rate_name,
                            .rate_unit = label->rate_unit,
                            .body = (size_t)model->scene->coordinates[index].body};
}

size_t fbd_model_parameter_count(const fbd_model *model)
{
    return model ? model->scene->parameter_count : 0;
}

fbd_parameter fbd_model_parameter(const fbd_model *model, size_t index)
{
    if (index >= fbd_model_parameter_count(model))
        return (fbd_parameter){.value = NAN, .low = NAN, .high = NAN};
    const struct parameter *parameter = &model->scene->parameters[index];
    return (fbd_parameter){.name = parameter->name,
                           .unit = parameter->unit,
                           .description = parameter->description,
                           .value = parameter->call.function ? (double)NAN : parameter->value,
                           .input = parameter->input,
                           .derived = parameter->derived,
                           .low = parameter->low,
                           .high = parameter->high};
}

size_t fbd_model_state_count(const fbd_model *model)
{
    if (!model) return 0;
    return model->scene->own_count;
}

fbd_own_state fbd_model_state(const fbd_model *model, size_t index)
{
    if (!model || index >= model->scene->own_count) return (fbd_own_state){.name = NULL};
    const struct own_label *label = &model->own_labels[index];
    return (fbd_own_state){.name = label->name, .unit = label->unit, .rate_unit = label->rate_unit};
}

char *fbd_schema(void)
{
    struct text text = {0};
    schema_write(&text);
    if (text.failed) text_free(&text);
    return text.data;
}

const char *fbd_version(void)
{
    return FBD_VERSION;
}
