/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Match the lines of an answer with the lines of the key.
 *
 * A line of the key is matched by a true line about the same unknowns: the same acceleration, or if it names
 * forces, the same accelerations and reactions. Lines about exactly the same ones come first, then those that
 * have some of them in common. A line that names forces, or matches one that does, matches only one line of
 * the key; and it must be linearly independent of those before it, as a form of its unknowns.
 */
#include "grade/lines.h"

bool line_agrees_at(const struct line *line, int slip)
{
    return line->is.states[slip] > 0 && line->is.agree[slip] == line->is.states[slip];
}

bool line_agrees(const struct line *line)
{
    for (int slip = 0; slip < slips; slip++)
        if ((line->counts >> slip & 1U) && line_agrees_at(line, slip)) return true;
    return false;
}

/* The senses of slip for which a line of the key has to be matched: those for which it is true. */
unsigned line_wanted_slips(const struct line *key)
{
    unsigned wanted = 0;
    for (unsigned slip = 0; slip < slips; slip++)
        if ((key->counts >> slip & 1U) && line_agrees_at(key, (int)slip)) wanted |= 1U << slip;
    return wanted ? wanted : key->counts;
}

/* Lines that have matched one of the key, as forms. */
struct forms {
    double *base;
    size_t count;
};

static bool names_forces(const struct line *line)
{
    return (line->is.names & (unsigned)FBD_NAMES_FORCES) != 0;
}

/* One line of the answer matches one line of the key, or several about the same acceleration (for each sense
 * of slip). */
static bool meets(const struct line *own, const struct line *key, int slip)
{
    const unsigned long long asked = key->is.unknowns;
    const bool single = names_forces(own) || names_forces(key);
    if (own->met != 0 && (single ? own->met_by != key : own->met != asked)) return false;
    return line_agrees_at(own, slip) && (own->is.unknowns & asked) && (own->dynamic || !key->dynamic) &&
           lines_of_run_agree(&own->is, &key->is);
}

/* True if a line is linearly independent of the others. */
static bool take_form(const struct line *own, struct forms *forms)
{
    if (own->met != 0 || !names_forces(own)) return true;
    if (!form_is_new(own->form, FBD_UNKNOWNS, forms->base, forms->count)) return false;
    forms->count++;
    return true;
}

/* Find a line that matches this one; `same`: one about the same unknowns. */
static bool find_line(struct line *own, size_t count, const struct line *key, int slip, bool same,
                      struct forms *forms)
{
    for (size_t i = 0; i < count; i++) {
        if (!meets(&own[i], key, slip) || (same && own[i].is.unknowns != key->is.unknowns)) continue;
        if (!take_form(&own[i], forms)) continue;
        if (own[i].met == 0) own[i].met_by = key;
        own[i].met = key->is.unknowns;
        return true;
    }
    return false;
}

/* The fraction of its cases for which a line of the key is matched. */
static double share_met(const struct line *key, struct line *own, size_t count, bool others,
                        struct forms *forms)
{
    unsigned wanted = line_wanted_slips(key);
    int cases = 0, met = 0;
    for (int slip = 0; slip < slips; slip++) {
        if (!(wanted >> slip & 1U)) continue;
        cases++;
        met += find_line(own, count, key, slip, true, forms) ||
               (others && find_line(own, count, key, slip, false, forms));
    }
    return cases ? (double)met / cases : 0;
}

/* Find the next equation of equilibrium that is linearly independent of those that have matched one of the
 * key, whose basis is `base`. */
static bool find_line_of_rest(const struct lines *lines, struct line *own, size_t count, double *base,
                              size_t *met)
{
    for (size_t i = 0; i < count; i++) {
        if (!own[i].rest || own[i].met != 0) continue;
        own[i].met = 1;
        if (!rest_is_new(lines, own[i].rest, base, *met)) continue;
        ++*met;
        return true;
    }
    return false;
}

bool lines_meet(struct lines *lines, struct body_lines *found)
{
    struct arena *arena = &lines->grade->arena;
    double *base = ARENA_ARRAY(arena, (found->key_count + 1) * rest_room, double);
    struct forms forms = {.base = ARENA_ARRAY(arena, (found->count + 1) * FBD_UNKNOWNS, double)};
    size_t met = 0;
    if (!base || !forms.base) return false;
    for (int others = 0; others < 2; others++)
        for (size_t k = 0; k < found->key_count; k++) {
            struct line *key = &found->key[k];
            if (!key->rest)
                key->share = share_met(key, found->own, found->count, others != 0, &forms);
            else if (others == 0)
                key->share = find_line_of_rest(lines, found->own, found->count, base, &met) ? 1 : 0;
        }
    return true;
}
