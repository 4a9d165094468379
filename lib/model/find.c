/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Look up parts of a model by their names.
 */
#include <string.h>

#include "model/model.h"

int model_find_component(const struct fbd_model *model, const char *name, bool plain)
{
    const int n = model->plan.n;
    plain = plain && model->body_count == 1;
    for (int i = 0; i < n; i++) {
        const struct label *label = &model->labels[i];
        const struct coordinate *c = &model->scene->coordinates[i];
        if (strcmp(label->name, name) == 0 || (plain && strcmp(c->name, name) == 0)) return i;
        if (strcmp(label->rate_name, name) == 0 || (plain && strcmp(c->rate_name, name) == 0)) return n + i;
    }
    for (int i = 0; i < model->plan.own; i++)
        if (strcmp(model->own_labels[i].name, name) == 0) return 2 * n + i;
    return -1;
}

int model_find_load(const struct fbd_model *model, const char *body, const char *load)
{
    for (size_t i = 0; i < model->load_count; i++)
        if (strcmp(model->loads[i].source->name, load) == 0 &&
            strcmp(model->bodies[model->loads[i].body].name, body) == 0)
            return (int)i;
    return -1;
}
