/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The entries of the text that list an effect. A load or coupling of the scene has the position of its entry,
 * by which its name is found.
 */
#include <stdlib.h>
#include <string.h>

#include "live/live.h"

struct listing {
    const struct spans *spans;
    const fbd_entry *entries; /* of the present body, or of the couplings and contacts */
    size_t entry_count;
    struct live_effect *effects;
    size_t count;
};

static const char *name_at(const struct listing *listing, int line, int column)
{
    for (size_t i = 0; i < listing->entry_count; i++)
        if (listing->entries[i].line == line && listing->entries[i].column == column)
            return listing->entries[i].name;
    return NULL;
}

/* Add the effects of a list of `body`, or of the file if it is NULL; a position outside the list is that of an
 * alias. */
static void list_effects(struct listing *listing, const char *body, int owner, const char *key)
{
    const struct spans *spans = listing->spans;
    int list = spans_find(spans, owner, key);
    struct span all = spans_of(spans, list);
    if (!spans_is_list(spans, list) || all.from < spans_key(spans, owner, key).to) return;
    for (size_t i = 0; i < spans_count(spans, list); i++) {
        int item = spans_item(spans, list, i), line, column;
        struct span span = spans_of(spans, item);
        spans_place(spans, item, &line, &column);
        const char *name = name_at(listing, line, column);
        if (!name || span.from < all.from || span.to > all.to) continue;
        listing->effects[listing->count++] = (struct live_effect){body, name, owner, key, i};
    }
}

/* Entries of the file list each effect once, so there are no more effects than entries. */
static void list_all(struct listing *listing, const fbd_model *model, size_t entry_count)
{
    const fbd_entry *end = listing->entries + entry_count;
    int root = spans_root(listing->spans), bodies = spans_find(listing->spans, root, "bodies");
    for (size_t b = 0; b < fbd_model_body_count(model); b++) {
        const char *body = fbd_model_body_name(model, b);
        int map = spans_find(listing->spans, bodies, body);
        const fbd_entry *next = listing->entries;
        while (next < end && strcmp(next->body, body) == 0) next++;
        listing->entry_count = (size_t)(next - listing->entries);
        list_effects(listing, body, map, "forces");
        list_effects(listing, body, map, "moments");
        listing->entries = next;
    }
    listing->entry_count = (size_t)(end - listing->entries);
    list_effects(listing, NULL, root, "couplings");
    list_effects(listing, NULL, root, "contacts");
}

struct live_effect *live_effects(const fbd_model *model, const struct spans *spans, size_t *count)
{
    size_t entry_count = fbd_model_entries(model, NULL, 0);
    fbd_entry *entries = calloc(entry_count + 1, sizeof *entries);
    struct live_effect *effects = calloc(entry_count + 1, sizeof *effects);
    struct listing listing = {.spans = spans, .entries = entries, .effects = effects};
    if (entries && effects) {
        fbd_model_entries(model, entries, entry_count);
        list_all(&listing, model, entry_count);
    } else {
        free(effects);
        listing.effects = NULL;
    }
    free(entries);
    *count = listing.count;
    return listing.effects;
}

bool live_effect_is(const struct live_effect *effect, const char *name)
{
    size_t length = effect->body ? strlen(effect->body) : 0;
    if (!effect->body) return strcmp(effect->name, name) == 0;
    return strncmp(effect->body, name, length) == 0 && name[length] == '.' &&
           strcmp(effect->name, name + length + 1) == 0;
}
