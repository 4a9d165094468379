/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A force toward a point of another body acts between the two: the reaction on that body is a separate load,
 * equal and opposite, named after body and force.
 */
#include "scene/reader.h"

static struct load reaction_of(struct reader *reader, const struct body *body, const struct load *load)
{
    return (struct load){.kind = load_applied,
                         .name = arena_printf(reader->arena, "%s.%s", body->name, load->name),
                         .at = load->at,
                         .value = load->value,
                         .angle = load->return_angle,
                         .point = load->end,
                         .toward = body->name,
                         .target = ground_body,
                         .lifetime = {.number = load->lifetime.number,
                                      .begins = load->lifetime.begins,
                                      .ends = load->lifetime.ends},
                         .reaction = true};
}

/* The body that a force is directed to, or ground_body. */
static int drawn_by(const struct load *load)
{
    return load->toward && !load->reaction ? load->target : ground_body;
}

/* Count the forces directed to each body in `drawn`; returns their total. */
static size_t count_drawn(const struct scene *scene, size_t *drawn)
{
    size_t count = 0;
    for (size_t b = 0; b < scene->body_count; b++)
        for (size_t i = 0; i < scene->bodies[b].load_count; i++) {
            int other = drawn_by(&scene->bodies[b].loads[i]);
            if (other == ground_body) continue;
            if (drawn) drawn[other]++;
            count++;
        }
    return count;
}

/* Extend the array of loads of a body by `more`. */
static bool make_room(struct reader *reader, struct body *body, size_t more)
{
    struct load *loads = ARENA_ARRAY(reader->arena, body->load_count + more, struct load);
    for (size_t i = 0; loads && i < body->load_count; i++) loads[i] = body->loads[i];
    if (loads) body->loads = loads;
    return loads != NULL;
}

bool reactions_add(struct reader *reader)
{
    struct scene *scene = reader->scene;
    if (count_drawn(scene, NULL) == 0) return true;
    size_t *drawn = ARENA_ARRAY(reader->arena, scene->body_count, size_t);
    if (!drawn) return false;
    count_drawn(scene, drawn);
    for (size_t b = 0; b < scene->body_count; b++)
        if (drawn[b] > 0 && !make_room(reader, &scene->bodies[b], drawn[b])) return false;
    for (size_t b = 0; b < scene->body_count; b++)
        for (size_t i = 0; i < scene->bodies[b].load_count; i++) {
            const struct body *body = &scene->bodies[b];
            int other = drawn_by(&body->loads[i]);
            if (other == ground_body) continue;
            struct body *feels = &scene->bodies[other];
            feels->loads[feels->load_count++] = reaction_of(reader, body, &body->loads[i]);
        }
    return !reader->arena->failed;
}
