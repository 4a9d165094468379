/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The text of a model without some of its effects. Entries on lines of their own become comments, so that
 * line numbers are kept and the missing effects remain visible; entries in brackets are cut out. A body that
 * lacks an effect also loses its derivations by hand, which are those of the complete scene.
 */
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "fbd_export.h"
#include "fbd_view.h"
#include "live/edits.h"
#include "live/live.h"

/* ---- entries in brackets: cut with the following comma, at the end of the list with the preceding one */

static void cut_entry(struct edits *edits, const struct span *entries, const bool *off, size_t count,
                      size_t index)
{
    size_t kept = count;
    for (size_t i = 0; i < count; i++)
        if (!off[i]) kept = i;
    bool trailing = kept < index || kept == count;
    if (!trailing)
        edits_replace(edits, entries[index].from, entries[index + 1].from, "");
    else if (kept == count && index == 0)
        edits_replace(edits, entries[0].from, entries[count - 1].to, "");
    else if (kept + 1 == index)
        edits_replace(edits, entries[kept].to, entries[count - 1].to, "");
}

/* ---- lists and bodies */

struct leaving {
    const struct spans *spans;
    const struct live_effect *effects;
    const bool *off;
    size_t count;
    struct edits edits;
};

/* Remove entries of the list of effect `first`, its first one; returns the index after its last effect. */
static size_t leave_out_of_list(struct leaving *leaving, size_t first)
{
    const struct live_effect *effect = &leaving->effects[first];
    const struct spans *spans = leaving->spans;
    struct edits *edits = &leaving->edits;
    int list = spans_find(spans, effect->owner, effect->key);
    size_t count = spans_count(spans, list), end = first, left = 0;
    struct span *entries = calloc(count + 1, sizeof *entries);
    bool *off = calloc(count + 1, sizeof *off);
    edits->failed |= !entries || !off;
    for (; end < leaving->count && leaving->effects[end].owner == effect->owner &&
           strcmp(leaving->effects[end].key, effect->key) == 0;
         end++)
        if (off && leaving->off[end]) off[leaving->effects[end].index] = true;
    for (size_t i = 0; i < count && entries && off; i++) {
        entries[i] = spans_of(spans, spans_item(spans, list, i));
        left += !off[i];
    }
    for (size_t i = 0; i < count && entries && off; i++) {
        if (!off[i]) continue;
        if (spans_is_flow(spans, list))
            cut_entry(edits, entries, off, count, i);
        else
            edits_comment_out(edits, edits_dash(edits, entries[i].from), entries[i].to);
    }
    if (!edits->failed && left == 0 && !spans_is_flow(spans, list)) {
        size_t colon = spans_key(spans, effect->owner, effect->key).to;
        const char *found = memchr(edits->text + colon, ':', edits->length - colon);
        if (found)
            edits_replace(edits, (size_t)(found - edits->text) + 1, (size_t)(found - edits->text) + 1, " []");
    }
    free(entries);
    free(off);
    return end;
}

static void leave_out(struct leaving *leaving)
{
    for (size_t i = 0; i < leaving->count;) i = leave_out_of_list(leaving, i);
    int done = 0; /* effects of one body are contiguous */
    for (size_t i = 0; i < leaving->count; i++) {
        if (!leaving->off[i] || !leaving->effects[i].body || leaving->effects[i].owner == done) continue;
        done = leaving->effects[i].owner;
        edits_remove_pair(&leaving->edits, leaving->spans, done, "hand");
    }
}

/* ---- the names */

static const char *effect_name(const struct live_effect *effect, fbd_errors *errors)
{
    return effect->body ? diag_hint(errors, "%s.%s", effect->body, effect->name) : effect->name;
}

static void note_unknown(const struct leaving *leaving, const char *name, fbd_errors *errors)
{
    const char **names = calloc(leaving->count + 1, sizeof *names);
    for (size_t i = 0; names && i < leaving->count; i++) names[i] = effect_name(&leaving->effects[i], errors);
    diag_add(errors, FBD_ERROR, "unknown-effect", (struct pos){0, 0},
             names && leaving->count > 0 ? diag_nearest(errors, name, names, leaving->count)
                                         : "no list of the file has entries that could be left out",
             "the file lists no effect `%.80s`", name);
    free(names);
}

static bool choose(const struct leaving *leaving, bool *off, const char *const *names, size_t count,
                   fbd_errors *errors)
{
    bool all = true;
    for (size_t k = 0; k < count; k++) {
        bool found = false;
        for (size_t i = 0; i < leaving->count; i++) {
            if (!live_effect_is(&leaving->effects[i], names[k])) continue;
            off[i] = found = true;
        }
        if (!found) note_unknown(leaving, names[k], errors);
        all = all && found;
    }
    return all;
}

static char *write_without(const fbd_model *model, const char *const *names, size_t count, fbd_errors *errors)
{
    struct text text = {0};
    size_t length, room = 0;
    const char *source = fbd_model_source(model, &length);
    struct spans *spans = spans_open(source, length);
    struct live_effect *effects = spans ? live_effects(model, spans, &room) : NULL;
    bool *off = calloc(room + 1, sizeof *off), fine = spans && effects && off;
    if (fine) {
        struct leaving leaving = {spans, effects, off, room, {.text = source, .length = length}};
        fine = choose(&leaving, off, names, count, errors);
        if (fine) {
            leave_out(&leaving);
            edits_apply(&text, &leaving.edits);
        }
        edits_free(&leaving.edits);
    } else {
        diag_out_of_memory(errors);
    }
    if (fine && text.failed) diag_out_of_memory(errors);
    if (text.failed) text_free(&text);
    spans_close(spans);
    free(effects);
    free(off);
    return fine && !text.failed ? text.data : NULL;
}

char *fbd_model_without(const fbd_model *model, const char *const *effects, size_t count, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    char *text = NULL;
    if (model && api_has_texts(effects, count)) {
        diag_in_file(errors, fbd_model_file(model));
        text = write_without(model, effects, count, errors);
    } else {
        api_refuse(errors, "there is no model, or no name of an effect");
    }
    diag_end(&call);
    return text;
}
