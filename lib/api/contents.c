/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: the contents of a model file beside its bodies.
 */
#include <stdlib.h>

#include "base/api_check.h"
#include "fbd_grade.h"
#include "fbd_view.h"
#include "model/model.h"

const char *fbd_model_file(const fbd_model *model)
{
    return model ? model->scene->file : NULL;
}

size_t fbd_model_data_file_count(const fbd_model *model)
{
    size_t count = 0;
    for (size_t i = 0; model && i < model->scene->table_count; i++)
        count += model->scene->tables[i].path != NULL;
    return count;
}

fbd_data_file fbd_model_data_file(const fbd_model *model, size_t index)
{
    for (size_t i = 0; model && i < model->scene->table_count; i++) {
        const struct scene_table *table = &model->scene->tables[i];
        if (table->path && index-- == 0) return (fbd_data_file){table->name, table->path};
    }
    return (fbd_data_file){NULL, NULL};
}

const char *fbd_model_data_hash(const fbd_model *model, size_t index)
{
    for (size_t i = 0; model && i < model->scene->table_count; i++) {
        const struct scene_table *table = &model->scene->tables[i];
        if (table->path && index-- == 0) return table->shared ? table->shared->sha256 : NULL;
    }
    return NULL;
}

char *fbd_model_hash(const fbd_model *model)
{
    char *digits = model ? malloc(sha256_size) : NULL;
    if (digits) sha256_text(model->source, model->source_length, digits);
    return digits;
}

void fbd_model_options(const fbd_model *model, fbd_options *options, size_t size)
{
    fbd_options file = FBD_OPTIONS_DEFAULT;
    if (!options) return;
    if (model) {
        const struct simulate *simulate = &model->scene->simulate;
        if (simulate->until.expr) file.until = expr_value(simulate->until.expr);
        file.tolerance = simulate->tolerance;
        file.step = simulate->step;
        file.method = simulate->method;
        file.accuracy = simulate->accuracy;
    }
    api_fill_options(options, size, &file, sizeof file);
}

bool fbd_unit_read(const fbd_model *model, const char *text, size_t length, fbd_unit *unit)
{
    struct unit read;
    if (!text || !unit) return false;
    if (!unit_parse(text, length, model ? model->scene->units : unit_si, NULL, (struct pos){0, 0}, &read))
        return false;
    *unit = (fbd_unit){.mass = (double)read.dim.mass / dim_unit,
                       .length = (double)read.dim.length / dim_unit,
                       .time = (double)read.dim.time / dim_unit,
                       .current = (double)read.dim.current / dim_unit,
                       .temperature = (double)read.dim.temperature / dim_unit,
                       .factor = read.factor};
    return true;
}

fbd_grading fbd_model_grading(const fbd_model *model)
{
    return model ? model->scene->grading : (fbd_grading){.given = false};
}

/* ---- entries */

struct entries {
    fbd_entry *list;
    size_t count, room;
};

static void add(struct entries *entries, const char *body, const char *name, struct pos at)
{
    if (entries->count < entries->room)
        entries->list[entries->count] = (fbd_entry){body, name, at.line, at.column};
    entries->count++;
}

size_t fbd_model_entries(const fbd_model *model, fbd_entry *list, size_t room)
{
    struct entries entries = {list, 0, list ? room : 0};
    if (!model) return 0;
    const struct scene *scene = model->scene;
    for (size_t b = 0; b < scene->body_count; b++)
        for (size_t i = 0; i < scene->bodies[b].load_count; i++) {
            const struct load *load = &scene->bodies[b].loads[i];
            if (!load->reaction) add(&entries, scene->bodies[b].name, load->name, load->at);
        }
    for (size_t i = 0; i < scene->force_coupling_count; i++)
        add(&entries, "", scene->force_couplings[i].load.name, scene->force_couplings[i].load.at);
    for (size_t i = 0; i < scene->constraint_count; i++)
        add(&entries, "", scene->constraints[i].name, scene->constraints[i].at);
    return entries.count;
}
