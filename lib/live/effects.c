/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The entries of the text that list an effect. A load or coupling of the scene has the position of its entry,
 * by which its name is found.
 */
#include <string.h>

#include "live/live.h"

struct listing {
    const struct fbd_model *model;
    const struct spans *spans;
    struct live_effect *effects;
    size_t count, room;
};

static bool is_at(struct pos at, int line, int column)
{
    return at.line == line && at.column == column;
}

static const char *load_at(const struct body *body, int line, int column)
{
    for (size_t i = 0; i < body->load_count; i++)
        if (!body->loads[i].reaction && is_at(body->loads[i].at, line, column)) return body->loads[i].name;
    return NULL;
}

static const char *coupling_at(const struct scene *scene, int line, int column)
{
    for (size_t i = 0; i < scene->force_coupling_count; i++)
        if (is_at(scene->force_couplings[i].load.at, line, column))
            return scene->force_couplings[i].load.name;
    for (size_t i = 0; i < scene->constraint_count; i++)
        if (is_at(scene->constraints[i].at, line, column)) return scene->constraints[i].name;
    return NULL;
}

/* Add the entries of `body`, or of the file if it is NULL; a position outside the list is that of an alias. */
static void list_entries(struct listing *listing, const struct body *body, int owner, const char *key)
{
    const struct spans *spans = listing->spans;
    int list = spans_find(spans, owner, key);
    struct span all = spans_of(spans, list);
    if (!spans_is_list(spans, list) || all.from < spans_key(spans, owner, key).to) return;
    for (size_t i = 0; i < spans_count(spans, list); i++) {
        int item = spans_item(spans, list, i), line, column;
        struct span span = spans_of(spans, item);
        spans_place(spans, item, &line, &column);
        const char *name =
            body ? load_at(body, line, column) : coupling_at(listing->model->scene, line, column);
        if (!name || span.from < all.from || span.to > all.to) continue;
        if (listing->count < listing->room)
            listing->effects[listing->count] =
                (struct live_effect){body ? body->name : NULL, name, owner, key, i};
        listing->count++;
    }
}

size_t live_effects(const struct fbd_model *model, const struct spans *spans, struct live_effect *effects,
                    size_t room)
{
    struct listing listing = {model, spans, effects, 0, room};
    int root = spans_root(spans), bodies = spans_find(spans, root, "bodies");
    for (size_t i = 0; i < model->scene->body_count; i++) {
        const struct body *body = &model->scene->bodies[i];
        int map = spans_find(spans, bodies, body->name);
        list_entries(&listing, body, map, "forces");
        list_entries(&listing, body, map, "moments");
    }
    list_entries(&listing, NULL, root, "couplings");
    list_entries(&listing, NULL, root, "contacts");
    return listing.count;
}

bool live_effect_is(const struct live_effect *effect, const char *name)
{
    size_t length = effect->body ? strlen(effect->body) : 0;
    if (!effect->body) return strcmp(effect->name, name) == 0;
    return strncmp(effect->body, name, length) == 0 && name[length] == '.' &&
           strcmp(effect->name, name + length + 1) == 0;
}
