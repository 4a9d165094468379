/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/record.h"

#include <string.h>

void record_compiled(const struct reader *reader, const struct node *node, const struct expr *expr)
{
    struct record *record = reader->record;
    if (record->count == record->room) {
        size_t room = record->room ? 2 * record->room : 32;
        struct site *sites = ARENA_ARRAY(&record->exprs, room, struct site);
        if (!sites) return; /* the arena records the failure */
        if (record->count) memcpy(sites, record->sites, record->count * sizeof *sites);
        record->sites = sites;
        record->room = room;
    }
    bool from_outside = reader->outside && node->at.line == 0;
    record->sites[record->count++] =
        (struct site){.node = from_outside ? NULL : node,
                      .outside = from_outside ? reader->outside : NULL,
                      .expr = expr,
                      .varies = reader->names_varying || (from_outside && reader->outside->varies)};
}

void record_site(const struct reader *reader, const struct expr *expr, const struct expr_want *want,
                 const struct names *names)
{
    struct record *record = reader->record;
    struct site *site = record->count ? &record->sites[record->count - 1] : NULL;
    if (!site || site->expr != expr) return; /* compiled in an earlier reading, so it does not vary */
    site->patched = !names->slip_named && !names->distance_named && !names->along;
    site->constants = names == &reader->constant_names;
    site->want = *want;
    site->names = *names;
    site->names.known = NULL;
    site->names.known_count = 0;
}
