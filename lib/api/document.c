/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: models of documents, which may have entries of other files.
 */
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "document/document.h"
#include "document/node_edit.h"
#include "document/scalar.h"
#include "model/model.h"
#include "output/hand_forces.h"
#include "scene/names.h"

fbd_document *fbd_document_parse(const char *text, size_t length, const char *name, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_document *document = text ? calloc(1, sizeof *document) : NULL;
    if (!text)
        api_refuse(errors, "there is no text");
    else if (!document)
        diag_out_of_memory(errors);
    if (document) {
        const char *copy = arena_text(&document->arena, text, length);
        if (name) document->file = arena_text(&document->arena, name, strlen(name));
        diag_in_file(errors, name);
        if (document->arena.failed)
            diag_out_of_memory(errors);
        else
            document->root = node_open(&document->arena, copy, length, errors);
        if (!document->root || fbd_errors_failed_count(errors) > 0) {
            fbd_document_free(document);
            document = NULL;
        }
    }
    diag_end(&call);
    return document;
}

void fbd_document_free(fbd_document *document)
{
    if (!document) return;
    arena_free(&document->arena);
    free(document);
}

/* A mapping with the value at a path replaced; NULL if there is no mapping at it, or memory is out. */
static const struct node *with_value(struct arena *arena, const struct node *map, const char *const *path,
                                     size_t count, const struct node *value)
{
    if (!map || map->kind != node_map) return NULL;
    if (count == 1) return node_with(arena, map, path[0], value);
    const struct pair *pair = node_find(map, path[0]);
    const struct node *inner = pair ? with_value(arena, pair->value, path + 1, count - 1, value) : NULL;
    return inner ? node_with(arena, map, path[0], inner) : NULL;
}

bool fbd_document_take(fbd_document *document, const fbd_document *from, const char *const *path,
                       size_t count)
{
    if (!document || !from || !path || count == 0 || !api_has_texts(path, count)) return false;
    const struct node *value = from->root;
    for (size_t i = 0; value && i < count; i++) {
        const struct pair *pair = node_find(value, path[i]);
        value = pair ? pair->value : NULL;
    }
    const struct node *root = with_value(&document->arena, document->root, path, count, value);
    if (root) document->root = root;
    return root != NULL;
}

/* ---- models */

static struct override *overrides_of(const fbd_setting *settings, size_t count)
{
    struct override *overrides = calloc(count + 1, sizeof *overrides);
    for (size_t i = 0; overrides && i < count; i++)
        overrides[i] = (struct override){.name = settings[i].name, .value = settings[i].value};
    return overrides;
}

fbd_model *fbd_model_parse_document(const fbd_document *document, const fbd_setting *settings,
                                    size_t setting_count, bool derivations, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    const bool asked = document && api_has_settings(settings, setting_count);
    struct override *overrides = asked ? overrides_of(settings, setting_count) : NULL;
    char *source = overrides ? calloc(1, 1) : NULL;
    fbd_model *model = NULL;
    if (!asked)
        api_refuse(errors, "there is no document, or a setting has no name or no value");
    else if (!source)
        diag_out_of_memory(errors);
    if (source) {
        const struct document read = {.file = document->file,
                                      .root = document->root,
                                      .without_hands = !derivations,
                                      .split_hands = derivations};
        diag_in_file(errors, document->file);
        model = hands_compile(&read, overrides, setting_count, errors);
    }
    if (model) {
        model->source = source;
        model->root = document->root;
    } else {
        free(source);
    }
    free(overrides);
    diag_end(&call);
    return model;
}

/* ---- derivations without a model */

struct reading {
    const char *const *names;
    size_t name_count;
    fbd_take_derivation *take;
    void *context;
};

static bool is_known(void *context, const char *body, const char *name)
{
    const struct reading *reading = context;
    (void)body; /* forces on other bodies may be named as well */
    for (size_t i = 0; i < reading->name_count; i++)
        if (strcmp(reading->names[i], name) == 0) return true;
    return false;
}

static void take_read(void *context, const struct node *node, const char *text)
{
    const struct reading *reading = context;
    if (strcmp(node->text, text) != 0) reading->take(reading->context, node->at.line, node->at.column, text);
}

bool fbd_document_derivations(const fbd_document *document, const fbd_setting *settings, size_t setting_count,
                              const fbd_model *model, const char *const *names, size_t name_count,
                              fbd_take_derivation *take, void *context)
{
    if (!document || !model || !take || !api_has_settings(settings, setting_count) ||
        !api_has_texts(names, name_count))
        return false;
    struct reading reading = {names, name_count, take, context};
    const struct hand_reader reader = {&reading, is_known, take_read};
    struct document read = {.file = document->file, .root = document->root, .hand_reader = &reader};
    struct arena arena = {0};
    struct override *overrides = overrides_of(settings, setting_count);
    fbd_errors *errors =
        fbd_errors_new(); /* on errors, which are found again when the document is compiled */
    bool done = errors && overrides && hand_forces_list(model, &arena, &read);
    if (done) {
        scene_free(scene_make(&read, overrides, setting_count, errors));
        done = !errors->out_of_memory;
    }
    fbd_errors_free(errors);
    free(overrides);
    arena_free(&arena);
    return done;
}

bool fbd_is_name(const char *name)
{
    return name && scalar_is_name(name) && !name_is_reserved(name);
}
