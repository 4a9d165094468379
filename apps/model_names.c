/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model_names.h"

#include <stdio.h>
#include <string.h>

#include "fbd_exchange.h"
#include "fbd_export.h"
#include "fbd_study.h"
#include "fbd_view.h"

static void write_methods(const fbd_model *model)
{
    (void)model;
    puts("auto");
    for (size_t i = 0; i < fbd_method_count(); i++) puts(fbd_method_get(i).name);
}

static void write_parameters(const fbd_model *model)
{
    for (size_t i = 0; i < fbd_model_parameter_count(model); i++) puts(fbd_model_parameter(model, i).name);
}

static void write_bodies(const fbd_model *model)
{
    for (size_t i = 0; i < fbd_model_body_count(model); i++) puts(fbd_model_body_name(model, i));
}

/* The text behind `key`, up to the next quote; NULL at the end. */
static const char *behind(const char *at, const char *key)
{
    const char *found = at ? strstr(at, key) : NULL;
    return found ? found + strlen(key) : NULL;
}

/* The list of effects of fbd_model_controls, which is the last one; names are words, without escapes. */
static void write_effects(const fbd_model *model)
{
    char *controls = fbd_model_controls(model, NULL);
    const char *at = behind(controls, "\"effects\":[");
    while ((at = behind(at, "\"body\":\"")) != NULL) {
        const int length = (int)strcspn(at, "\"");
        const char *name = behind(at, "\"name\":\"");
        if (name) printf("%.*s%s%.*s\n", length, at, length > 0 ? "." : "", (int)strcspn(name, "\""), name);
    }
    fbd_free(controls);
}

static void write_forces(const fbd_model *model)
{
    fbd_force_columns *columns = fbd_force_columns_new(model);
    for (size_t i = 0; i < fbd_force_columns_count(columns); i++) puts(fbd_force_columns_name(columns, i));
    fbd_force_columns_free(columns);
}

bool model_names_write(const char *kind, const char *path)
{
    static const struct {
        const char *kind;
        void (*write)(const fbd_model *model);
        bool of_model;
    } kinds[] = {
        {"methods", write_methods, false}, {"parameters", write_parameters, true},
        {"bodies", write_bodies, true},    {"effects", write_effects, true},
        {"forces", write_forces, true},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (strcmp(kind, kinds[i].kind) != 0) continue;
        fbd_model *model = kinds[i].of_model && path ? fbd_model_read(path, NULL, 0, NULL) : NULL;
        if (model || !kinds[i].of_model) kinds[i].write(model);
        fbd_model_free(model);
        return true;
    }
    return false;
}
