/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/labels.h"

#include <string.h>

enum { unit_size = 48 };

static const char *unit_of(struct arena *arena, struct dim dim, bool angle, enum unit_system system)
{
    char text[unit_size], full[unit_size + 4];
    unit_name(dim, system, text, sizeof text);
    if (!angle) return arena_text(arena, text, strlen(text));
    /* Angles have no dimension: "1/s" is rad/s here. */
    const char *rest = strncmp(text, "1/", 2) == 0 ? text + 1 : "";
    snprintf(full, sizeof full, "rad%s", rest);
    return arena_text(arena, full, strlen(full));
}

const struct label *labels_make(struct arena *arena, const struct scene *scene)
{
    struct label *labels = ARENA_ARRAY(arena, scene->coordinate_count, struct label);
    if (!labels) return NULL;
    for (size_t i = 0; i < scene->coordinate_count; i++) {
        const struct coordinate *c = &scene->coordinates[i];
        const char *body = scene->bodies[c->body].name;
        struct dim per_time = dim_over(c->rate_dim, DIM_TIME);
        labels[i] = (struct label){
            .name = arena_printf(arena, "%s.%s", body, c->name),
            .rate_name = arena_printf(arena, "%s.%s", body, c->rate_name),
            .acceleration_name = c->acceleration_name,
            .unit = unit_of(arena, c->dim, c->angle, scene->units),
            .rate_unit = unit_of(arena, c->rate_dim, c->angle, scene->units),
            .acceleration_unit = unit_of(arena, per_time, c->angle, scene->units),
            .force_unit = unit_of(arena, c->angle ? DIM_MOMENT : DIM_FORCE, false, scene->units),
            .inertia_unit = unit_of(arena, c->angle ? DIM_INERTIA : DIM_MASS, false, scene->units),
        };
    }
    return arena->failed ? NULL : labels;
}
