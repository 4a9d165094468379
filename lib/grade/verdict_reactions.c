/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reactions that are drawn correctly: one force may be read as several reactions, alone or as a component.
 * The reading with the most points counts.
 */
#include <string.h>

#include "base/text.h"
#include "fbd_grade.h"
#include "grade/reactions_work.h"
#include "grade/verdict_work.h"

/* Keep the value of a reaction for derivations that name it: for an unknown the value that makes it right. */
static void keep_values(struct fbd_grade *grade, const fbd_model *answer, const struct sides *sides,
                        const struct support *support)
{
    double values[most_components];
    support_solve(sides, support, values);
    for (size_t j = 0; j < support->count; j++) {
        const fbd_listed_force *source = support->parts[j]->source;
        struct drawn *drawn = drawn_at(grade, position_of(source));
        bool moment = strcmp(verdict_noun(source), "moment") == 0;
        if (!drawn) continue;
        bool us = strcmp(fbd_model_scene(drawn->unknown ? grade->sheet : answer).units, "US") == 0;
        drawn->unit = moment ? (us ? "lb*ft" : "N*m") : us ? "lb" : "N";
        drawn->size = drawn->unknown ? values[j] : source->size;
        drawn->reaction =
            drawn->unknown && !drawn->free && support->key_count == 1 ? support->key[0]->name : NULL;
        drawn->along = support->parts[j]->at[reaction_when(sides, support->key[0])].force;
        if (drawn->unknown && isfinite(values[j]))
            drawn->value = arena_printf(&grade->arena, "(%.17g[%s])", values[j], drawn->unit);
    }
}

static void take_support(struct fbd_grade *grade, const fbd_model *answer, const char *body,
                         const struct sides *sides, const struct support *support)
{
    const char *message = support->count > 1       ? "right, together with its other components"
                          : support->key_count > 1 ? "right, as a resultant"
                                                   : "right";
    keep_values(grade, answer, sides, support);
    for (size_t i = 0; i < support->key_count; i++)
        verdict_right(grade, body, support->key[i], support->parts[0], message);
}

/* Treat a `normal` of the answer for a guide of the key as a force across the body's line. */
static void take_normals(struct sides *sides)
{
    for (size_t j = 0; j < sides->count; j++) {
        struct item *item = &sides->items[j];
        if (!is_left(item) || strcmp(item->source->law, "normal") != 0) continue;
        for (size_t i = 0; i < sides->reaction_count; i++) {
            const struct item *key = &sides->reactions[i];
            if (!key->name || !key->couples || key->used) continue;
            item->unknown = true;
            for (size_t s = 0; s < sides->samples; s++) item->at[s].force = item->across;
        }
    }
}

void verdict_misdrawn(struct fbd_grade *grade, const char *body, const struct misdrawn *misdrawn)
{
    const char *message = "its direction is wrong, or a component of it is missing";
    fbd_finding_kind kind = FBD_FINDING_DIRECTION;
    struct text detail = {0};
    if (misdrawn->relation == is_opposite) {
        kind = FBD_FINDING_SENSE;
        message = "it points the opposite way";
    } else if (misdrawn->relation == is_elsewhere) {
        kind = FBD_FINDING_PLACE;
        message = "it acts at the wrong place: its line of action is another one";
    } else if (misdrawn->relation == is_scaled) {
        kind = FBD_FINDING_MAGNITUDE;
        message = "its magnitude is wrong";
    }
    text_printf(&detail, "compared with `%s` of the key", misdrawn->key->name);
    if (detail.failed) grade->arena.failed = true;
    verdict_pair(grade, body, misdrawn->key, misdrawn->item, kind, message, detail.data ? detail.data : "");
    if (misdrawn->other) misdrawn->other->used = true;
    text_free(&detail);
}

/* Entries drawn for a reaction, or a component of one, that is zero. */
void verdict_zeros(struct fbd_grade *grade, const char *body, struct sides *sides)
{
    for (size_t j = 0; j < sides->count; j++) {
        struct item *item = &sides->items[j];
        if (item->used || !item->source || !is_of_nothing(sides, item)) continue;
        if (reaction_is_reversed(sides, item)) continue;
        item->used = true;
        fbd_finding *finding = finding_add(grade, FBD_FINDING_RIGHT, body, name_as_drawn(grade, item->source),
                                           position_of(item->source));
        finding_say(grade, finding, "right: it is zero");
    }
}

/* ---- the reading with the most points */

/* The items before a reading was graded. */
struct state {
    bool used, single;
};

struct reading {
    struct fbd_grade *grade;
    size_t body;
    struct sides *sides;
    struct supports supports;
    bool taken[most_supports], best[most_supports];
    struct state *states;
    double most, points; /* available; of the best one */
    size_t steps;
};

/* The work for one body is bounded: steps, of which computing points takes many. */
enum { most_steps = 8192, steps_to_weigh = 64 };

static void use_support(struct support *support, bool used)
{
    for (size_t i = 0; i < support->key_count; i++) {
        support->key[i]->used = used;
        support->key[i]->single = used && support->count == 1 && !support->parts[0]->free;
    }
    for (size_t j = 0; j < support->count; j++) support->parts[j]->used = used;
}

static bool is_possible(const struct support *support)
{
    for (size_t i = 0; i < support->key_count; i++)
        if (support->key[i]->used) return false;
    for (size_t j = 0; j < support->count; j++)
        if (support->parts[j]->used) return false;
    return true;
}

static void exchange(struct state *states, struct item *items, size_t count, bool back)
{
    for (size_t i = 0; i < count; i++) {
        if (!back) {
            states[i] = (struct state){items[i].used, items[i].single};
            continue;
        }
        items[i].used = states[i].used;
        items[i].single = states[i].single;
    }
}

static void exchange_all(struct reading *reading, bool back)
{
    struct sides *sides = reading->sides;
    struct state *states = reading->states;
    exchange(states, sides->key, sides->key_count, back);
    exchange(states + sides->key_count, sides->items, sides->count, back);
    exchange(states + sides->key_count + sides->count, sides->reactions, sides->reaction_count, back);
}

static double points_from(const struct finding *finding)
{
    double points = 0;
    for (; finding; finding = finding->next) points += finding->finding.points;
    return points;
}

/* The points of a reading with all remaining items. */
static void weigh(struct reading *reading)
{
    struct fbd_grade *grade = reading->grade;
    struct finding *last = grade->last;
    size_t count = grade->count;
    double points = 0;
    for (size_t i = 0; i < reading->supports.count; i++)
        for (size_t k = 0; reading->taken[i] && k < reading->supports.all[i].key_count; k++)
            points += verdict_worth(grade, reading->supports.all[i].key[k]);
    exchange_all(reading, false);
    verdict_rest(grade, reading->body, reading->sides);
    exchange_all(reading, true);
    points += points_from(last ? last->next : grade->first);
    if (last)
        last->next = NULL;
    else
        grade->first = NULL;
    grade->last = last;
    grade->count = count;
    reading->steps += steps_to_weigh;
    if (points <= reading->points + 1e-9) return;
    reading->points = points;
    memcpy(reading->best, reading->taken, sizeof reading->best);
}

/* True if a reaction can still be right, with one of the supports from `from` on. */
static bool is_within_reach(const struct reading *reading, const struct item *key, size_t from)
{
    for (size_t i = from; i < reading->supports.count; i++) {
        const struct support *support = &reading->supports.all[i];
        for (size_t k = 0; k < support->key_count; k++)
            if (support->key[k] == key && is_possible(support)) return true;
    }
    return false;
}

/* Upper bound of the points from the supports from `from` on. */
static double most_from(const struct reading *reading, size_t from)
{
    const struct sides *sides = reading->sides;
    const fbd_grading *grading = &reading->grade->key->grading;
    double most = reading->most;
    for (size_t k = 0; k < sides->reaction_count; k++) {
        const struct item *key = reaction_candidate(sides, k);
        if (key && !is_within_reach(reading, key, from))
            most -= (1 - grading->partial) * verdict_worth(reading->grade, key);
    }
    return most;
}

/* True if a support certainly earns more points than any other reading of its forces. */
static bool stands_alone(const struct reading *reading, size_t index)
{
    const struct support *support = &reading->supports.all[index];
    for (size_t i = index + 1; i < reading->supports.count; i++)
        if (is_possible(&reading->supports.all[i]) && supports_meet(support, &reading->supports.all[i]))
            return false;
    for (size_t k = 0; k < reading->sides->key_count; k++)
        if (is_left(&reading->sides->key[k])) return false;
    return true;
}

static void read_on(struct reading *reading, size_t from)
{
    struct supports *supports = &reading->supports;
    if (++reading->steps > most_steps || most_from(reading, from) <= reading->points + 1e-9) return;
    while (from < supports->count && !is_possible(&supports->all[from])) from++;
    if (from == supports->count) {
        weigh(reading);
        return;
    }
    bool certain = stands_alone(reading, from);
    use_support(&supports->all[from], true);
    reading->taken[from] = true;
    read_on(reading, from + 1);
    use_support(&supports->all[from], false);
    reading->taken[from] = false;
    if (!certain) read_on(reading, from + 1);
}

void verdict_reactions(struct fbd_grade *grade, const fbd_model *answer, size_t body, struct sides *sides)
{
    static const struct search searches[] = {
        {false, 1, false}, {false, 2, false}, {false, 3, false}, {true, 1, false},
        {true, 1, true},   {true, 2, false},  {true, 3, false},  {false, 1, true},
    };
    size_t count = sides->key_count + sides->count + sides->reaction_count + 1;
    struct reading reading = {.grade = grade, .body = body, .sides = sides, .points = -HUGE_VAL};
    reading.states = ARENA_ARRAY(&grade->arena, count, struct state);
    if (!reading.states) return;
    take_normals(sides);
    for (size_t k = 0; k < sizeof searches / sizeof *searches; k++)
        supports_find(sides, &searches[k], &reading.supports);
    for (size_t i = 0; i < sides->key_count; i++)
        if (!sides->key[i].used) reading.most += verdict_worth(grade, &sides->key[i]);
    for (size_t i = 0; i < sides->reaction_count; i++)
        reading.most += verdict_worth(grade, &sides->reactions[i]);
    read_on(&reading, 0);
    for (size_t i = 0; i < reading.supports.count; i++) {
        if (!reading.best[i]) continue;
        take_support(grade, answer, fbd_model_body_name(grade->sheet, body), sides, &reading.supports.all[i]);
        use_support(&reading.supports.all[i], true);
    }
    verdict_rest(grade, body, sides);
}
