/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/labels.h"

#include <string.h>

enum { unit_size = 48 };

static const char *unit_or(struct arena *arena, struct dim dim, enum unit_system system, const char *none)
{
    char text[unit_size];
    unit_name(dim, system, text, sizeof text);
    return text[0] ? arena_text(arena, text, strlen(text)) : none;
}

/* A coordinate without a dimension is an angle. */
static const char *unit_of(struct arena *arena, struct dim dim, enum unit_system system)
{
    return unit_or(arena, dim, system, "rad");
}

const struct own_label *own_labels_make(struct arena *arena, const struct scene *scene)
{
    struct own_label *labels = ARENA_ARRAY(arena, scene->own_count, struct own_label);
    if (!labels) return NULL;
    for (size_t i = 0; i < scene->own_count; i++) {
        const struct own_state *state = &scene->own[i];
        labels[i] = (struct own_label){
            .name = arena_printf(arena, "states.%s", state->name),
            .unit = unit_or(arena, state->dim, scene->units, "1"),
            .rate_unit = dim_equal(state->dim, DIM_NONE)
                             ? "1/s"
                             : unit_or(arena, dim_over(state->dim, DIM_TIME), scene->units, "1"),
        };
    }
    return arena->failed ? NULL : labels;
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
            .unit = unit_of(arena, c->dim, scene->units),
            .rate_unit = unit_of(arena, c->rate_dim, scene->units),
            .acceleration_unit = unit_of(arena, per_time, scene->units),
            .force_unit = unit_of(arena, c->angle ? DIM_MOMENT : DIM_FORCE, scene->units),
            .inertia_unit = unit_of(arena, c->angle ? DIM_INERTIA : DIM_MASS, scene->units),
        };
    }
    return arena->failed ? NULL : labels;
}
