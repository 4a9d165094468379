/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The state at which a reaction is compared, and the reactions that have to be drawn.
 */
#include "grade/reactions_work.h"

#include <math.h>
#include <string.h>

#include "fbd_grade.h"

/* Forces below this share of the largest one are zero: reactions are solutions of systems of equations. */
const double reaction_zero = 1e-7;

/* ---- state of comparison */

bool reaction_is_zero(const struct sides *sides, const struct item *item, size_t s)
{
    const struct action *at = &item->at[s];
    if (item->unknown) return false;
    bool moment = sides->turns && fabs(at->moment) > reaction_zero * sides->moment;
    return vec_norm(at->force) <= reaction_zero * sides->force && !moment;
}

/* The first state where it is not zero, at the start if possible; `samples` when there is none. */
size_t reaction_when(const struct sides *sides, const struct item *key)
{
    for (int start = 1; start >= 0; start--)
        for (size_t s = 0; s < sides->samples; s++)
            if (sides->possible[s] && (!start || sides->starts[s]) && !reaction_is_zero(sides, key, s))
                return s;
    return sides->samples;
}

bool reaction_is_nothing(const struct sides *sides, const struct item *key)
{
    return reaction_when(sides, key) == sides->samples;
}

/* True if the second wrench equals the first within the tolerance. */
bool reaction_is_near(const struct sides *sides, const struct action *key, const struct action *other)
{
    double size = vec_norm(key->force), off = vec_norm(vec_sub(key->force, other->force));
    double moments = fabs(key->moment) + size * sides->reach;
    return off <= sides->tolerance * size + reaction_zero * sides->force &&
           (!sides->turns ||
            fabs(key->moment - other->moment) <= sides->tolerance * moments + reaction_zero * sides->moment);
}

/* ---- reactions to be drawn */

/* True if this is the name of the reaction, or of its coupling. */
static bool is_named(const struct item *key, const char *name)
{
    size_t length = strlen(name);
    return strncmp(key->name, name, length) == 0 && (key->name[length] == '\0' || key->name[length] == '.');
}

/* The time of its state of comparison; NAN where it need not be drawn. */
static double drawn_at_time(const fbd_grading *grading, const struct sides *sides, const struct item *key)
{
    bool named = grading->reactions == FBD_REACTIONS_ALL;
    if (!key->name) return NAN;
    for (size_t i = 0; i < grading->reaction_count; i++)
        named = named || is_named(key, grading->reaction_names[i]);
    size_t s = named ? reaction_when(sides, key) : sides->samples;
    return s < sides->samples && sides->starts[s] ? sides->times[s] : NAN;
}

bool reactions_note_asked(struct fbd_key *key, size_t b, const struct sides *sides)
{
    double *asked = ARENA_ARRAY(&key->arena, sides->reaction_count + 1, double);
    for (size_t i = 0; asked && i < sides->reaction_count; i++)
        asked[i] = drawn_at_time(&key->grading, sides, &sides->reactions[i]);
    key->asked[b] = asked;
    key->asked_count[b] = asked ? sides->reaction_count : 0;
    return asked != NULL;
}

void reactions_take_asked(const struct fbd_key *key, size_t b, struct sides *sides)
{
    for (size_t i = 0; i < sides->reaction_count; i++)
        sides->reactions[i].asked = i < key->asked_count[b] && !isnan(key->asked[b][i]);
}
