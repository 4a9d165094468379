/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reactions that an answer has drawn wrongly.
 */
#include <string.h>

#include "grade/reactions_work.h"

static struct action times(double factor, struct action wrench)
{
    wrench.force = vec_scale(factor, wrench.force);
    wrench.moment *= factor;
    return wrench;
}

static enum relation relation_of_couples(const struct sides *sides, const struct action *key,
                                         const struct item *item, const struct action *at)
{
    const struct action other = times(-1, *at);
    if (item->unknown ? at->moment * key->moment < 0 : reaction_is_near(sides, key, &other))
        return is_opposite;
    return at->moment * key->moment > 0 ? is_scaled : is_other;
}

/* Relation of an item to `key`, a reaction or the component of one. */
static enum relation relation_of(const struct sides *sides, const struct action *key, const struct item *item,
                                 size_t s)
{
    const struct action *at = &item->at[s];
    double size = vec_norm(key->force), own = vec_norm(at->force);
    bool couple = size <= reaction_zero * sides->force;
    if (couple != reaction_is_couple(sides, item, s)) return is_other;
    if (couple) return relation_of_couples(sides, key, item, at);
    bool same = item->unknown || fabs(own - size) <= sides->tolerance * size;
    bool there = reaction_passes(sides, at, key->point),
         parallel = reaction_is_parallel(sides, key->force, at->force);
    double sense = vec_dot(key->force, at->force);
    if (item->free) return is_elsewhere;
    if (parallel && same && there && sense < 0) return is_opposite;
    if (parallel && same && !there && sense > 0) return is_elsewhere;
    if (parallel && there && sense > 0) return is_scaled;
    return same && there ? is_turned : is_other;
}

/* True if an item, with a suitable magnitude if that is unknown, is a component of this wrench perpendicular
 * to the remainder *rest. */
static bool is_component(const struct sides *sides, const struct action *key, const struct item *item,
                         size_t s, struct action *rest)
{
    struct action at = item->at[s];
    double size = vec_norm(at.force), along = size > 0 ? vec_dot(key->force, at.force) / size : 0;
    if (item->free || reaction_is_couple(sides, item, s) || !reaction_passes(sides, &at, key->point))
        return false;
    double factor = item->unknown ? along / size : 1;
    if (!item->unknown && fabs(along - size) > sides->tolerance * vec_norm(key->force)) return false;
    *rest = *key;
    rest->force = vec_sub(key->force, vec_scale(factor, at.force));
    rest->moment = key->moment - factor * at.moment;
    return vec_norm(rest->force) > sides->tolerance * vec_norm(key->force);
}

static int rank_of(const struct item *key, const struct item *item, enum relation relation)
{
    static const int ranks[] = {[is_same] = 9,   [is_opposite] = 0, [is_elsewhere] = 1, [is_rougher] = 9,
                                [is_turned] = 2, [is_scaled] = 3,   [is_other] = 9};
    return ranks[relation] + (strcmp(key->name, item->name) == 0 ? 0 : 4);
}

static void consider(struct misdrawn *best, struct item *key, struct item *item, struct item *other,
                     enum relation relation)
{
    int rank = rank_of(key, item, relation) + (other ? -4 : 0);
    if (rank >= best->rank) return;
    *best = (struct misdrawn){key, item, other, relation, rank};
}

/* Consider an item alone, or beside a component that is right. */
static void consider_item(struct sides *sides, struct item *key, struct item *item, struct misdrawn *best)
{
    size_t s = reaction_when(sides, key);
    const struct action *wanted = &key->at[s];
    struct action rest;
    if (reaction_is_zero(sides, item, s)) return;
    enum relation relation = relation_of(sides, wanted, item, s);
    if (relation == is_other && is_component(sides, wanted, item, s, &rest)) relation = is_turned;
    consider(best, key, item, NULL, relation);
    for (size_t j = 0; j < sides->count; j++) {
        struct item *other = &sides->items[j];
        if (other == item || other->used || !other->source) continue;
        if (!is_component(sides, wanted, other, s, &rest)) continue;
        relation = relation_of(sides, &rest, item, s);
        if (relation != is_other && relation != is_turned) consider(best, key, item, other, relation);
    }
}

bool reactions_closest(struct sides *sides, int below, struct misdrawn *found)
{
    found->rank = below;
    for (size_t k = 0; k < sides->reaction_count + sides->key_count; k++) {
        struct item *key = reaction_candidate(sides, k);
        for (size_t j = 0; key && j < sides->count; j++) {
            struct item *item = &sides->items[j];
            if (item->used || !item->source || (key->source ? !item->unknown : !key->asked)) continue;
            consider_item(sides, key, item, found);
        }
    }
    return found->rank < below;
}

bool reaction_is_reversed(struct sides *sides, const struct item *item)
{
    for (size_t k = 0; k < sides->reaction_count; k++) {
        const struct item *key = reaction_candidate(sides, k);
        if (!key || !key->asked) continue;
        size_t s = reaction_when(sides, key);
        if (relation_of(sides, &key->at[s], item, s) == is_opposite) return true;
    }
    return false;
}
