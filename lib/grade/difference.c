/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "grade/compare.h"

static const double noise = 1e-9;

/* ---- equality within the tolerance, at every relevant state */

static bool near_force(const struct sides *sides, struct vec key, struct vec other)
{
    return vec_norm(vec_sub(key, other)) <= sides->tolerance * vec_norm(key) + noise * sides->force;
}

static bool near_moment(const struct sides *sides, double key, double other, double force)
{
    double size = fabs(key) + force * sides->arm;
    return !sides->turns || fabs(key - other) <= sides->tolerance * size + noise * sides->moment;
}

static bool near_wrench(const struct sides *sides, const struct action *key, const struct action *other)
{
    return near_force(sides, key->force, other->force) &&
           near_moment(sides, key->moment, other->moment, vec_norm(key->force));
}

/* Dependent forces are known only where the motion is admissible; friction is compared with a formula where
 * it slips, or sticks, as at the start, for which it is drawn. */
static bool counts(const struct sides *sides, const struct item *key, const struct item *item, size_t s)
{
    if (!key->follows) return true;
    if (!sides->possible[s]) return false;
    return item->follows || strcmp(key->source->law, "normal") == 0 || sides->like_start[s];
}

static struct action reversed(struct action wrench)
{
    wrench.force = vec_scale(-1, wrench.force);
    wrench.moment = -wrench.moment;
    return wrench;
}

static bool agree(const struct sides *sides, const struct item *key, const struct item *item, bool reverse)
{
    for (size_t s = 0; s < sides->samples; s++) {
        struct action other = reverse ? reversed(item->at[s]) : item->at[s];
        if (counts(sides, key, item, s) && !near_wrench(sides, &key->at[s], &other)) return false;
    }
    return true;
}

static struct action sum_at(const struct item *const *items, size_t count, size_t s)
{
    struct action sum = {.moment = 0};
    for (size_t i = 0; i < count; i++) {
        sum.force = vec_add(sum.force, items[i]->at[s].force);
        sum.moment += items[i]->at[s].moment;
    }
    return sum;
}

/* True if two sums agree at every relevant state. Dependent forces are known where the motion is admissible
 * and the body slips as at the start. */
static bool sums_agree(const struct sides *sides, const struct item *const *key, size_t key_count,
                       const struct item *const *parts, size_t count)
{
    bool follows = false;
    for (size_t i = 0; i < key_count; i++) follows = follows || key[i]->follows;
    for (size_t i = 0; i < count; i++) follows = follows || parts[i]->follows;
    for (size_t s = 0; s < sides->samples; s++) {
        if (follows && !(sides->possible[s] && sides->like_start[s])) continue;
        struct action sum = sum_at(key, key_count, s), other = sum_at(parts, count, s);
        if (!near_wrench(sides, &sum, &other)) return false;
    }
    return true;
}

bool adds_up(const struct sides *sides, const struct item *const *parts, size_t count, const struct item *sum)
{
    return sums_agree(sides, &sum, 1, parts, count);
}

bool is_drawn_as_such(const struct sides *sides, const struct item *key)
{
    for (size_t i = 0; i < sides->count && key->follows; i++) {
        const struct item *item = &sides->items[i];
        if (is_left(item) && are_alike(item, key)) return true;
    }
    return false;
}

bool is_nothing(const struct sides *sides, const struct item *item)
{
    const struct action zero = {.moment = 0};
    for (size_t s = 0; s < sides->samples; s++)
        if (!near_wrench(sides, &zero, &item->at[s])) return false;
    return true;
}

/* ---- groups */

static size_t take_unused(struct item *items, size_t count, struct item *left[most_in_group])
{
    size_t found = 0;
    for (size_t i = 0; i < count && found < most_in_group; i++)
        if (is_left(&items[i])) left[found++] = &items[i];
    return found;
}

static size_t choose(struct item *const *from, size_t count, unsigned mask,
                     struct item *chosen[most_in_group])
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++)
        if (mask & (1U << i)) chosen[found++] = from[i];
    return found;
}

static bool any_as_such(const struct sides *sides, const struct group *group)
{
    for (size_t i = 0; i < group->key_count; i++)
        if (is_drawn_as_such(sides, group->key[i])) return true;
    return false;
}

static bool group_adds_up(const struct sides *sides, const struct group *group)
{
    if (any_as_such(sides, group)) return false;
    return sums_agree(sides, (const struct item *const *)group->key, group->key_count,
                      (const struct item *const *)group->items, group->count);
}

bool group_find(struct sides *sides, struct group *group)
{
    struct item *key[most_in_group], *items[most_in_group];
    size_t key_count = take_unused(sides->key, sides->key_count, key);
    size_t count = take_unused(sides->items, sides->count, items);
    for (size_t size = 3; size <= key_count + count; size++)
        for (unsigned some = 1; some < 1U << key_count; some++) {
            group->key_count = choose(key, key_count, some, group->key);
            for (unsigned own = 1; own < 1U << count && group->key_count < size; own++) {
                group->count = choose(items, count, own, group->items);
                if (group->key_count + group->count == size && group_adds_up(sides, group)) return true;
            }
        }
    return false;
}

/* ---- dependent forces */

static bool same_coefficients(const struct sides *sides, const struct item *key, const struct item *item)
{
    for (size_t s = 0; s < sides->samples; s++) {
        const struct action *a = &key->at[s], *b = &item->at[s];
        double tolerance = sides->tolerance;
        if (!(fabs(a->mu_s - b->mu_s) <= tolerance * fabs(a->mu_s) &&
              fabs(a->mu_k - b->mu_k) <= tolerance * fabs(a->mu_k) &&
              fabs(a->surface - b->surface) <= tolerance * fabs(a->surface)))
            return false;
    }
    return true;
}

static bool same_line(const struct sides *sides, const struct item *key, const struct item *item)
{
    for (size_t s = 0; s < sides->samples && sides->turns; s++) {
        struct vec apart = vec_sub(item->at[s].point, key->at[s].point), f = key->at[s].force;
        double size = vec_norm(f);
        if (sides->possible[s] && size > noise * sides->force &&
            !(fabs(vec_cross(apart, f)) <= (sides->tolerance * sides->arm + noise) * size))
            return false;
    }
    return true;
}

static struct difference of_reactions(const struct sides *sides, const struct item *key,
                                      const struct item *item)
{
    struct difference difference = {.relation = is_same};
    if (!are_alike(key, item))
        difference.relation = is_other;
    else if (!same_coefficients(sides, key, item))
        difference.relation = is_rougher;
    else if (!same_line(sides, key, item))
        difference.relation = is_elsewhere;
    else if (strcmp(key->source->side, item->source->side) != 0)
        difference.relation = is_opposite;
    return difference;
}

/* ---- forces that differ */

/* The magnitude of a force, or of a couple. */
static double magnitude(const struct sides *sides, const struct action *wrench)
{
    double force = vec_norm(wrench->force);
    return force > noise * sides->force ? force : fabs(wrench->moment);
}

static bool is_couple(const struct sides *sides, const struct item *item)
{
    for (size_t s = 0; s < sides->samples; s++)
        if (!(vec_norm(item->at[s].force) <= noise * sides->force)) return false;
    return true;
}

static bool forces_agree(const struct sides *sides, const struct item *key, const struct item *item)
{
    for (size_t s = 0; s < sides->samples; s++)
        if (counts(sides, key, item, s) && !near_force(sides, key->at[s].force, item->at[s].force))
            return false;
    return true;
}

/* True if both are along the same line at every state; *ratio is the ratio of the magnitudes, NAN when it
 * varies. */
static bool parallel(const struct sides *sides, const struct item *key, const struct item *item,
                     double *ratio)
{
    double first = NAN;
    bool couple = is_couple(sides, key), varies = false;
    if (couple != is_couple(sides, item)) return false;
    for (size_t s = 0; s < sides->samples; s++) {
        const struct action *a = &key->at[s], *b = &item->at[s];
        double size = magnitude(sides, a);
        if (!counts(sides, key, item, s) || size <= noise * (couple ? sides->moment : sides->force)) continue;
        double across = couple ? 0 : vec_cross(a->force, b->force) / size;
        double along = couple ? b->moment * copysign(1, a->moment) : vec_dot(a->force, b->force) / size;
        if (!(fabs(across) <= sides->tolerance * fabs(along))) return false;
        double now = along / size;
        if (isnan(first)) first = now;
        varies = varies || fabs(now - first) > sides->tolerance * fabs(first);
    }
    *ratio = varies ? NAN : first;
    return true;
}

/* True if both have the same magnitude at every state; *angle is the angle between them, NAN when it varies. */
static bool turned(const struct sides *sides, const struct item *key, const struct item *item, double *angle,
                   bool *exchanged)
{
    double first = NAN;
    bool varies = false;
    *exchanged = true;
    for (size_t s = 0; s < sides->samples; s++) {
        struct vec a = key->at[s].force, b = item->at[s].force;
        double size = vec_norm(a);
        if (!counts(sides, key, item, s) || size <= noise * sides->force) continue;
        if (!(fabs(vec_norm(b) - size) <= sides->tolerance * size)) return false;
        struct vec cross = {a.y, a.x};
        *exchanged =
            *exchanged && (near_force(sides, cross, b) || near_force(sides, vec_scale(-1, cross), b));
        double now = atan2(vec_cross(a, b), vec_dot(a, b));
        if (isnan(first)) first = now;
        varies = varies || fabs(remainder(now - first, 6.283185307179586)) > sides->tolerance;
    }
    *angle = varies ? NAN : first;
    return !isnan(first);
}

struct difference difference_of(const struct sides *sides, const struct item *key, const struct item *item)
{
    struct difference difference = {.relation = is_same, .ratio = NAN, .angle = NAN};
    if (key->follows && item->follows) return of_reactions(sides, key, item);
    if (agree(sides, key, item, false)) return difference;
    difference.relation = is_other;
    if (agree(sides, key, item, true))
        difference.relation = is_opposite;
    else if (!is_couple(sides, key) && forces_agree(sides, key, item))
        difference.relation = is_elsewhere;
    else if (parallel(sides, key, item, &difference.ratio))
        difference.relation = is_scaled;
    else if (turned(sides, key, item, &difference.angle, &difference.exchanged))
        difference.relation = is_turned;
    return difference;
}
