/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The source of a reaction, the state at which it is compared, and the reactions that have to be drawn.
 */
#include "grade/reactions_work.h"

#include <stdlib.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/tree.h"
#include "fbd_grade.h"

/* Forces below this share of the largest one are zero: reactions are solutions of systems of equations. */
const double reaction_zero = 1e-7;

/* ---- the coupling, contact or guide that exerts it */

/* The direction of the force of row `row` of a coupling at its end k; zero if it has no fixed direction. */
static struct vec direction_of(const struct coupling *coupling, int k, int row, const struct instant *at)
{
    struct vec sum = {0, 0};
    if (coupling->row_count > 1 && !coupling->law->end_names[1]) return sum; /* a pin */
    const struct row *one = &at->tree->rows[coupling->first_row + (row < coupling->row_count ? row : 0)];
    for (int i = 0; i < one->port_count; i++)
        if (one->ports[i].end == k) sum = vec_add(sum, one->ports[i].force);
    return sum;
}

void reaction_describe(const fbd_model *model, int b, const struct arrow *arrow, const struct instant *at,
                       struct item *item)
{
    const struct model_body *body = &model->bodies[b];
    for (size_t c = 0; c < model->body_count;
         c++) /* on a body that carries another one: of that one's joint */
        if (arrow->name && model->bodies[c].reaction_on_parent == arrow->name) body = &model->bodies[c];
    bool joint = arrow->name && (arrow->name == body->reaction || arrow->name == body->reaction_on_parent);
    bool guided = body->kind == motion_slide || body->kind == motion_track;
    item->contact = -1;
    item->couples = joint && body->kind != motion_pivot;
    if (!joint && body->place.link == 0) joint = true; /* on the ground: `pin` or `guide` */
    if (joint && guided) item->across = vec_perp(body_direction(body, at));
    item->any = joint && !guided;
    for (int i = 0; model->tree && i < model->tree->coupling_count; i++) {
        const struct coupling *coupling = &model->tree->couplings[i];
        for (int k = 0; k < coupling->end_count; k++)
            for (int row = 0; row < 2; row++) {
                if (coupling->end[k].body != b || coupling->end[k].name[row] != arrow->name) continue;
                bool rope = coupling->kind == constraint_rope || coupling->law->strands;
                item->one_sided = rope || (coupling_presses(coupling) && row == 0);
                if (coupling->kind == constraint_contact) item->contact = coupling->constraint;
                item->across = direction_of(coupling, k, row, at);
                item->any = coupling->row_count > 1 && !coupling->law->end_names[1];
                return;
            }
    }
}

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

static bool has_to_be_drawn(const struct grading *grading, const struct sides *sides, const struct item *key)
{
    bool named = grading->reactions == reactions_all;
    if (!key->name) return false;
    for (size_t i = 0; i < grading->reaction_count; i++)
        named = named || is_named(key, grading->reaction_names[i]);
    size_t s = named ? reaction_when(sides, key) : sides->samples;
    return s < sides->samples && sides->starts[s];
}

bool reactions_note_asked(struct fbd_key *key, size_t b, const struct sides *sides)
{
    bool *asked = ARENA_ARRAY(&key->arena, sides->reaction_count + 1, bool);
    for (size_t i = 0; asked && i < sides->reaction_count; i++)
        asked[i] = has_to_be_drawn(&key->model->scene->grading, sides, &sides->reactions[i]);
    key->asked[b] = asked;
    key->asked_count[b] = asked ? sides->reaction_count : 0;
    return asked != NULL;
}

void reactions_take_asked(const struct fbd_key *key, size_t b, struct sides *sides)
{
    for (size_t i = 0; i < sides->reaction_count; i++)
        sides->reactions[i].asked = i < key->asked_count[b] && key->asked[b][i];
}
