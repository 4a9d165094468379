/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "grade/reactions_work.h"

/* Share of a length or force below which it is round-off of the file's numbers. */
static const double off_by_rounding = 1e-9;

/* ---- lines of action */

static double reach_of(const struct sides *sides)
{
    return sides->tolerance * sides->reach + off_by_rounding * (sides->reach + 1);
}

/* Distance of `point` from the line of action of `item`, positive to its left. */
static double distance_to(const struct action *item, struct vec point)
{
    double size = vec_norm(item->force);
    return size > 0 ? vec_cross(item->force, vec_sub(point, item->point)) / size : 0;
}

bool reaction_passes(const struct sides *sides, const struct action *item, struct vec point)
{
    return !sides->turns || fabs(distance_to(item, point)) <= reach_of(sides);
}

/* True if a component passes the point where the reactions act, or between their points. */
static bool meets_support(const struct sides *sides, const struct support *support, const struct action *item,
                          size_t s)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < support->key_count; i++) {
        double distance = distance_to(item, support->key[i]->at[s].point);
        low = fmin(low, distance);
        high = fmax(high, distance);
    }
    return !sides->turns || (low <= reach_of(sides) && high >= -reach_of(sides));
}

bool reaction_is_parallel(const struct sides *sides, struct vec a, struct vec b)
{
    double size = vec_norm(a) * vec_norm(b);
    return size > 0 && fabs(vec_cross(a, b)) <= sides->tolerance * size;
}

/* ---- magnitudes of unknowns */

enum { most_columns = 3 };

struct column {
    double row[3]; /* force, and moment over a length */
    size_t part;
    bool any; /* one of two components of a force of unknown direction */
};

static struct column column_of(const struct sides *sides, struct vec force, double moment)
{
    double length = sides->reach > 0 ? sides->reach : 1;
    return (struct column){.row = {force.x, force.y, sides->turns ? moment / length : 0}};
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Least squares by Gram-Schmidt; false if columns are linearly dependent. */
static bool solve(struct column *columns, size_t count, const double *right, double *values)
{
    double base[most_columns][3], factor[most_columns][most_columns] = {{0}}, along[most_columns] = {0};
    for (size_t k = 0; k < count; k++) {
        memcpy(base[k], columns[k].row, sizeof base[k]);
        double before = sqrt(dot(base[k], base[k]));
        for (size_t j = 0; j < k; j++) {
            factor[j][k] = dot(base[j], base[k]);
            for (int i = 0; i < 3; i++) base[k][i] -= factor[j][k] * base[j][i];
        }
        double size = sqrt(dot(base[k], base[k]));
        if (!(size > 1e-3 * before)) return false;
        for (int i = 0; i < 3; i++) base[k][i] /= size;
        factor[k][k] = size;
        along[k] = dot(base[k], right);
    }
    for (size_t k = count; k-- > 0;) {
        values[k] = along[k];
        for (size_t j = k + 1; j < count; j++) values[k] -= factor[k][j] * values[j];
        values[k] /= factor[k][k];
    }
    return true;
}

struct fitting {
    size_t count;
    struct column columns[most_columns];
    double values[most_columns];
    struct action wanted, known; /* sums */
};

static bool add_column(struct fitting *fitting, struct column column, size_t part, bool any)
{
    if (fitting->count == most_columns) return false;
    column.part = part;
    column.any = any;
    fitting->columns[fitting->count++] = column;
    return true;
}

static bool collect(const struct sides *sides, const struct support *support, size_t s,
                    struct fitting *fitting)
{
    bool fine = true;
    for (size_t i = 0; i < support->key_count; i++) {
        fitting->wanted.force = vec_add(fitting->wanted.force, support->key[i]->at[s].force);
        fitting->wanted.moment += support->key[i]->at[s].moment;
    }
    for (size_t j = 0; fine && j < support->count; j++) {
        const struct item *part = support->parts[j];
        const struct action *at = &part->at[s];
        if (part->free) {
            struct vec to = vec_sub(at->point, part->about[s]);
            fine = add_column(fitting, column_of(sides, (struct vec){1, 0}, -to.y), j, true) &&
                   add_column(fitting, column_of(sides, (struct vec){0, 1}, to.x), j, true);
        } else if (part->unknown) {
            fine = add_column(fitting, column_of(sides, at->force, at->moment), j, false);
        } else {
            fitting->known.force = vec_add(fitting->known.force, at->force);
            fitting->known.moment += at->moment;
        }
    }
    return fine;
}

/* The sum of the parts with these values of the unknowns. */
static struct action sum_of(const struct sides *sides, const struct fitting *fitting)
{
    struct action sum = fitting->known;
    double length = sides->reach > 0 ? sides->reach : 1;
    for (size_t k = 0; k < fitting->count; k++) {
        const double *row = fitting->columns[k].row;
        sum.force = vec_add(sum.force, vec_scale(fitting->values[k], (struct vec){row[0], row[1]}));
        sum.moment += fitting->values[k] * row[2] * length;
    }
    return sum;
}

/* True if the parts identify each of several reactions: they are nearer to all of them than to those without
 * one. */
static bool tells_each(const struct support *support, size_t s, struct vec off)
{
    for (size_t i = 0; i < support->key_count && support->key_count > 1; i++) {
        double size = vec_norm(support->key[i]->at[s].force);
        if (size > 0 && vec_norm(off) > 0.5 * size) return false;
    }
    return true;
}

static bool fit(const struct sides *sides, const struct support *support, size_t s, struct fitting *fitting)
{
    *fitting = (struct fitting){.count = 0};
    if (!collect(sides, support, s, fitting)) return false;
    struct vec force = vec_sub(fitting->wanted.force, fitting->known.force);
    struct column right = column_of(sides, force, fitting->wanted.moment - fitting->known.moment);
    if (fitting->count > 0 && !solve(fitting->columns, fitting->count, right.row, fitting->values))
        return false;
    struct action sum = sum_of(sides, fitting);
    return reaction_is_near(sides, &fitting->wanted, &sum) &&
           tells_each(support, s, vec_sub(sum.force, fitting->wanted.force));
}

/* True if an unknown is drawn along the line of one of the reactions, with the opposite sense. */
static bool is_against_line(const struct sides *sides, const struct support *support, struct vec drawn)
{
    for (size_t i = 0; i < support->key_count; i++) {
        const struct item *key = support->key[i];
        struct vec force = key->at[reaction_when(sides, key)].force;
        if (!key->any && reaction_is_parallel(sides, drawn, force) && vec_dot(drawn, force) < 0) return true;
    }
    return false;
}

/* The sense must be that of the reaction, for a single force and for one-sided reactions. Two components of a
 * force of unknown direction may have any sense, as their signs follow from the equations, and may be zero. */
static bool senses_agree(const struct sides *sides, const struct support *support,
                         const struct fitting *fitting)
{
    bool one_sided = true, any = true;
    for (size_t i = 0; i < support->key_count; i++) {
        one_sided = one_sided && support->key[i]->one_sided;
        any = any && support->key[i]->any;
    }
    for (size_t k = 0; k < fitting->count; k++) {
        struct vec drawn = {fitting->columns[k].row[0], fitting->columns[k].row[1]};
        bool moment = vec_norm(drawn) == 0;
        if (fitting->columns[k].any) continue;
        double size = reaction_zero * (moment ? sides->moment : sides->force);
        if (support->count == 1 && !(fitting->values[k] > size)) return false;
        if (one_sided && !(fitting->values[k] > -size)) return false;
        if (moment) continue;
        double least = sides->tolerance * vec_norm(fitting->wanted.force);
        if (!any && fabs(fitting->values[k]) * vec_norm(drawn) <= least) return false;
        if (is_against_line(sides, support, drawn)) return false;
    }
    return true;
}

/* ---- supports */

bool reaction_is_couple(const struct sides *sides, const struct item *item, size_t s)
{
    return vec_norm(item->at[s].force) <= (item->unknown ? 0 : off_by_rounding * sides->force);
}

/* Components of a force of unknown direction are drawn at its point, others across their support. */
static bool is_drawn_there(const struct sides *sides, const struct support *support, const struct item *part,
                           size_t s)
{
    const struct item *key = support->key[0];
    if (!key->any) return !part->unknown || meets_support(sides, support, &part->at[s], s);
    return !sides->turns || vec_norm(vec_sub(part->at[s].point, key->at[s].point)) <= reach_of(sides);
}

static bool is_right_angle(const struct sides *sides, struct vec a, struct vec b)
{
    return fabs(vec_dot(a, b)) <= sides->tolerance * vec_norm(a) * vec_norm(b);
}

/* Components must be perpendicular: with two free magnitudes, any two forces would fit. */
static bool are_components(const struct sides *sides, const struct support *support, size_t s)
{
    for (size_t i = 0; i < support->count; i++)
        for (size_t j = i + 1; j < support->count; j++) {
            const struct item *one = support->parts[i], *other = support->parts[j];
            bool couple = reaction_is_couple(sides, one, s) || reaction_is_couple(sides, other, s);
            if (!couple && !is_right_angle(sides, one->at[s].force, other->at[s].force)) return false;
        }
    return true;
}

static bool may_be_drawn_so(const struct sides *sides, const struct support *support, size_t s,
                            size_t unknowns)
{
    bool follows = false, couples = false;
    for (size_t i = 0; i < support->key_count; i++) {
        follows = follows || support->key[i]->source;
        couples = couples || support->key[i]->couples || reaction_is_couple(sides, support->key[i], s);
    }
    if (follows && unknowns == 0) return false; /* compared by value at all states (verdict.c) */
    if (unknowns > 0 && !are_components(sides, support, s)) return false;
    for (size_t j = 0; j < support->count; j++) {
        const struct item *part = support->parts[j];
        bool couple = reaction_is_couple(sides, part, s);
        if (part->free && support->count > 1) return false;
        if (couple && part->unknown && !couples) return false;
        if (!couple && support->count > 1 && !is_drawn_there(sides, support, part, s)) return false;
    }
    return true;
}

static bool is_right(const struct sides *sides, const struct support *support)
{
    struct fitting fitting;
    size_t s = reaction_when(sides, support->key[0]), unknowns = 0;
    for (size_t j = 0; j < support->count; j++) unknowns += support->parts[j]->unknown;
    return may_be_drawn_so(sides, support, s, unknowns) && fit(sides, support, s, &fitting) &&
           senses_agree(sides, support, &fitting);
}

void support_solve(const struct sides *sides, const struct support *support, double values[most_components])
{
    struct fitting fitting;
    for (size_t j = 0; j < most_components; j++) values[j] = NAN;
    if (!fit(sides, support, reaction_when(sides, support->key[0]), &fitting)) return;
    for (size_t k = 0; k < fitting.count; k++)
        if (!fitting.columns[k].any) values[fitting.columns[k].part] = fitting.values[k];
}

/* Candidate number k for a reaction: those of couplings and joints, then normal forces and friction that the
 * key lists. NULL for used or zero ones. */
struct item *reaction_candidate(const struct sides *sides, size_t k)
{
    bool reaction = k < sides->reaction_count;
    struct item *item = reaction ? &sides->reactions[k] : &sides->key[k - sides->reaction_count];
    if (item->used || !item->name || (!reaction && !item->follows)) return NULL;
    return reaction_is_nothing(sides, item) ? NULL : item;
}

/* True if two act at one point, or in one contact. */
static bool share_support(const struct sides *sides, const struct item *a, const struct item *b)
{
    size_t s = reaction_when(sides, a);
    if ((a->source != NULL) != (b->source != NULL)) return false;
    if (a->source || (a->contact >= 0 && a->contact == b->contact)) return true;
    return vec_norm(vec_sub(a->at[s].point, b->at[s].point)) <= reach_of(sides);
}

static bool holds(struct item *const *some, size_t count, const struct item *one)
{
    for (size_t i = 0; i < count; i++)
        if (some[i] == one) return true;
    return false;
}

bool supports_meet(const struct support *a, const struct support *b)
{
    for (size_t i = 0; i < a->key_count; i++)
        if (holds(b->key, b->key_count, a->key[i])) return true;
    for (size_t j = 0; j < a->count; j++)
        if (holds(b->parts, b->count, a->parts[j])) return true;
    return false;
}

/* True if one of those found is a part of this. A force that is right alone belongs to no resultant. */
static bool has_another(const struct supports *found, const struct support *support)
{
    for (size_t i = 0; i < found->count; i++) {
        const struct support *one = &found->all[i];
        bool within = one->count < support->count;
        for (size_t k = 0; within && k < one->key_count; k++)
            within = holds(support->key, support->key_count, one->key[k]);
        for (size_t j = 0; within && j < one->count; j++)
            within = holds(support->parts, support->count, one->parts[j]);
        if (within) return true;
    }
    return false;
}

/* Choose parts from item `from` on, and record those that are right. */
static void choose_parts(const struct sides *sides, const struct search *search, struct support *support,
                         size_t from, size_t *noted, struct supports *found)
{
    enum { most_left = 24, most_noted = 6 }; /* limits of the search: components; matches of one support */
    if (*noted == most_noted || found->count == most_supports) return;
    if (support->count == search->parts) {
        if (!is_right(sides, support) || has_another(found, support)) return;
        found->all[found->count++] = *support;
        ++*noted;
        return;
    }
    size_t left = 0;
    for (size_t j = from; j < sides->count && (search->parts == 1 || left < most_left); j++) {
        struct item *item = &sides->items[j];
        if (item->used || !item->source || reaction_is_zero(sides, item, 0) || item->free != search->free)
            continue;
        left++;
        support->parts[support->count++] = item;
        choose_parts(sides, search, support, j + 1, noted, found);
        support->count--;
    }
}

static void try_support(const struct sides *sides, const struct search *search, struct support *support,
                        size_t key_count, struct supports *found)
{
    size_t noted = 0;
    support->key_count = key_count;
    support->count = 0;
    choose_parts(sides, search, support, 0, &noted, found);
}

/* Combine reaction k with one other, or with all at its support. */
static void find_groups(const struct sides *sides, size_t k, const struct search *search,
                        struct support *support, struct supports *found)
{
    size_t all = sides->reaction_count + sides->key_count, shared = 1;
    struct item *first = reaction_candidate(sides, k), *others[most_support];
    others[0] = support->key[0] = first;
    for (size_t j = k + 1; j < all && shared < most_support; j++) {
        struct item *other = reaction_candidate(sides, j);
        if (!other || !share_support(sides, first, other)) continue;
        support->key[1] = others[shared++] = other;
        try_support(sides, search, support, 2, found);
    }
    if (shared < 3) return;
    memcpy(support->key, others, sizeof others);
    try_support(sides, search, support, shared, found);
}

void supports_find(const struct sides *sides, const struct search *search, struct supports *found)
{
    for (size_t k = 0; k < sides->reaction_count + sides->key_count; k++) {
        struct support support = {.key[0] = reaction_candidate(sides, k)};
        if (!support.key[0]) continue;
        if (search->together)
            find_groups(sides, k, search, &support, found);
        else
            try_support(sides, search, &support, 1, found);
    }
}

/* True for the component of a reaction of unknown direction perpendicular to one that is right alone. */
static bool is_beside(const struct sides *sides, const struct item *item, struct item *key)
{
    size_t s = reaction_when(sides, key);
    bool small = vec_norm(item->at[s].force) <= sides->tolerance * vec_norm(key->at[s].force);
    if (!key->any || !key->single || !(item->unknown || small)) return false;
    if (reaction_is_couple(sides, item, s) || !is_right_angle(sides, item->at[s].force, key->at[s].force) ||
        (sides->turns && vec_norm(vec_sub(item->at[s].point, key->at[s].point)) > reach_of(sides)))
        return false;
    key->single = false;
    return true;
}

bool is_of_nothing(struct sides *sides, const struct item *item)
{
    for (size_t i = 0; i < sides->reaction_count; i++) {
        struct item *key = &sides->reactions[i];
        if (!key->name) continue;
        if (!reaction_is_nothing(sides, key)) {
            if (is_beside(sides, item, key)) return true;
            continue;
        }
        if (!item->unknown) continue;
        if (reaction_is_couple(sides, item, 0)
                ? key->couples
                : reaction_passes(sides, &item->at[0], key->at[0].point) &&
                      (key->any || reaction_is_parallel(sides, key->across, item->at[0].force)))
            return true;
    }
    return false;
}
