/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The functions of base/vec.h, dynamics/ and expr/ that the texts of a program call, and no others.
 */
#include <string.h>

#include "emit/emit.h"
#include "emit/helper.h"

/* True if `text` calls the function, or names the structure. */
static bool calls_it(const char *text, const char *name)
{
    size_t length = strlen(name);
    bool structure = strncmp(name, "struct ", 7) == 0;
    for (const char *at = text ? strstr(text, name) : NULL; at; at = strstr(at + 1, name)) {
        char before = at > text ? at[-1] : ' ', behind = at[length];
        bool inside = (before >= 'a' && before <= 'z') || (before >= '0' && before <= '9') || before == '_';
        bool longer = (behind >= 'a' && behind <= 'z') || (behind >= '0' && behind <= '9') || behind == '_';
        if (!inside && (structure ? !longer : behind == '(')) return true;
    }
    return false;
}

/* ---- conditional lines */

static bool has(const struct helper_features *features, const char *word, size_t length)
{
    static const char *const names[] = {"pairs", "branches", "surfaces", "events", "tree"};
    const bool values[] = {features->pairs, features->branches, features->surfaces, features->events,
                           features->tree};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strlen(names[i]) == length && strncmp(names[i], word, length) == 0) return values[i];
    return false;
}

/* Evaluate the condition of a line, in [from, to). */
static bool is_wanted(const struct helper_features *features, const char *from, const char *to)
{
    bool any = false, none = true;
    while (from < to) {
        bool negative = *from == '!';
        size_t length = strcspn(from + negative, " |");
        bool given = has(features, from + negative, length);
        if (negative)
            none = none && !given;
        else
            any = any || given;
        if (negative && from + negative + length >= to) return none;
        from += negative + length + 1;
    }
    return any;
}

static void filter(const char *text, const struct helper_features *features, struct text *out)
{
    for (const char *line = text; *line;) {
        const char *end = strchr(line, '\n');
        size_t length = end ? (size_t)(end - line) + 1 : strlen(line);
        const char *bar = *line == '@' ? strchr(line, '|') : NULL;
        if (!bar)
            text_add_bytes(out, line, length);
        else if (is_wanted(features, line + 1, bar))
            text_add_bytes(out, bar + 1, length - (size_t)(bar + 1 - line));
        line += length;
    }
}

static struct helper_features features_of(const struct fbd_model *model)
{
    const struct plan *plan = &model->plan;
    return (struct helper_features){plan->mode_count > 0, plan->branches > 0, plan->contact_count > 0,
                                    plan->watch_count > 0, tree_joins(model->tree)};
}

/* Goes backward, since later helpers call earlier ones. */
void emit_helpers(struct emitter *emitter, const struct helper *list, size_t count, const struct text *calls,
                  struct text *out)
{
    enum { most = 256 };
    bool needed[most] = {false};
    struct text filtered[most] = {{0}};
    const struct helper_features features = features_of(emitter->model);
    for (size_t i = count; i-- > 0;) {
        filter(list[i].text, &features, &filtered[i]);
        needed[i] = calls_it(calls->data, list[i].name);
        for (size_t k = i + 1; k < count && !needed[i]; k++)
            needed[i] = needed[k] && calls_it(filtered[k].data, list[i].name);
    }
    for (size_t i = 0; i < count; i++) {
        if (needed[i]) text_printf(out, "%s\n", filtered[i].data ? filtered[i].data : "");
        emitter->arena.failed = emitter->arena.failed || filtered[i].failed;
        text_free(&filtered[i]);
    }
}
