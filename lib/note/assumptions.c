/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The assumptions: those of all scenes, and the lists of effects that fbd_explain prints: lines with two blanks are
 * entries, those with six belong to the entry above.
 */
#include <math.h>
#include <string.h>

#include "note/note.h"

/* A line of the explanation. */
struct line {
    const char *start;
    size_t length, indent;
};

static bool next_line(const char **at, struct line *line)
{
    if (!*at || !**at) return false;
    const size_t length = strcspn(*at, "\n");
    line->indent = strspn(*at, " ");
    line->start = *at + line->indent;
    line->length = length - line->indent;
    *at += length + ((*at)[length] == '\n');
    return true;
}

/* The lines behind a heading that begins so; NULL without it. */
static const char *section(const char *explanation, const char *heading)
{
    const char *at = strstr(explanation, heading);
    if (!at) return NULL;
    at += 1 + strcspn(at + 1, "\n");
    return *at ? at + 1 : at;
}

static const char *part(struct making *making, const char *from, size_t length)
{
    while (length > 0 && from[length - 1] == ' ') length--;
    return arena_text(&making->document->arena, from, length);
}

/* `gravity (3)               conservative: V = m g h`: the effect, and behind two blanks the remark. */
static void simulated(struct making *making, struct block *table, const struct line *entry,
                      const struct line *on)
{
    const char *gap = entry->start;
    while (gap < entry->start + entry->length && strncmp(gap, "  ", 2) != 0) gap++;
    const size_t length = (size_t)(gap - entry->start);
    const size_t blanks = strspn(gap, " ");
    document_cell(making->document, table, part(making, entry->start, length));
    document_cell(making->document, table, part(making, on->start, on->length));
    document_cell(making->document, table,
                  length + blanks < entry->length
                      ? part(making, gap + blanks, entry->length - length - blanks)
                      : "");
}

static void list_simulated(struct making *making, const char *at)
{
    static const char *const heads[] = {"Effect", "On", "Remark"};
    struct block *table = NULL;
    struct line entry, on;
    while (next_line(&at, &entry) && entry.indent == 2) {
        const char *behind = at;
        if (!next_line(&behind, &on) || on.indent < 6) continue;
        if (!table) table = document_table(making->document, "effects that are simulated", "lww", heads);
        simulated(making, table, &entry, &on);
        at = behind;
        for (const char *more = at; next_line(&more, &on) && on.indent >= 6; at = more) {
            document_cell(making->document, table, "");
            document_cell(making->document, table, part(making, on.start, on.length));
            document_cell(making->document, table, "");
        }
    }
    if (!table) document_paragraph(making->document, "No force or moment acts on any body.");
}

/* `drag: list `drag: ...``, then `on block`: the effect, and the bodies without it. */
static void list_absent(struct making *making, const char *at)
{
    struct block *list = NULL;
    struct line entry, on;
    while (next_line(&at, &entry) && entry.indent == 2) {
        const char *end = memchr(entry.start, ':', entry.length);
        if (!next_line(&at, &on)) break;
        if (!list) {
            document_paragraph(making->document, "Not simulated, since the file does not list them:");
            list = document_list(making->document);
        }
        const size_t length = end ? (size_t)(end - entry.start) : entry.length;
        document_cell_format(making->document, list, "%.*s (%.*s)", (int)length, entry.start, (int)on.length,
                             on.start);
    }
}

static struct block *list_general(struct making *making)
{
    struct block *list = document_list(making->document);
    const fbd_scene scene = fbd_model_scene(making->model);
    const char *const acceleration = strcmp(scene.units, "US") == 0 ? "ft/s^2" : "m/s^2";
    static const char *const always[] = {
        "The bodies are rigid; their masses and moments of inertia are those of the data below.",
        "All motion is in one plane; forces are in that plane and moments normal to it.",
        "The frame of the ground is inertial. x points to the right, y up, angles are counter-clockwise.",
    };
    for (size_t i = 0; i < sizeof always / sizeof *always; i++)
        document_cell(making->document, list, always[i]);
    const double g = hypot(scene.gravity[0], scene.gravity[1]);
    if (scene.pressing > 0)
        document_cell_format(making->document, list,
                             "The plane is horizontal: gravity, %s, presses the bodies on it.",
                             making_value(making, scene.pressing, acceleration, note_digits));
    else
        document_cell_format(making->document, list, "Gravity is uniform: %s%s.",
                             making_value(making, g, acceleration, note_digits),
                             scene.gravity[0] == 0 && scene.gravity[1] < 0 ? ", downward" : "");
    return list;
}

/* Laws that a note should name where they apply. */
static void list_laws(struct making *making, struct block *list, const char *explanation)
{
    static const struct {
        const char *mark, *sentence;
    } laws[] = {
        {"dry friction",
         "Dry friction follows Coulomb's law: up to the static coefficient times the normal force at "
         "rest, the kinetic one times it in motion. Coefficients are constant, except where the file gives "
         "them by expressions."},
        {"mass that varies",
         "Masses that vary do so as the file gives them; the data have them at the start."},
        {"contact",
         "Impacts take no time; each changes velocities by impulses according to the restitution and the "
         "friction of the contact."},
        {"rope", "Ropes are massless and inextensible; they pull and do not push."},
    };
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++)
        if (strstr(explanation, laws[i].mark)) document_cell(making->document, list, laws[i].sentence);
}

void note_assumptions(struct making *making)
{
    char *explanation = fbd_explain(making->model, NULL);
    document_heading(making->document, 2, "Assumptions");
    if (!explanation) {
        making->document->arena.failed = true;
        return;
    }
    const char *present = section(explanation, "\nEffects simulated"),
               *absent = section(explanation, "\nEffects not simulated");
    struct block *list = list_general(making);
    const size_t length = absent ? (size_t)(absent - explanation) : strlen(explanation);
    const char *before = arena_text(&making->document->arena, explanation, length);
    if (before) list_laws(making, list, before);
    if (present) list_simulated(making, present);
    if (absent) list_absent(making, absent);
    fbd_free(explanation);
}
