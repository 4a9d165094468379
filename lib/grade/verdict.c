/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Entries that are right are paired first, by numbers alone; then the remaining ones, by name, kind and
 * similarity.
 */

#include <string.h>

#include "base/text.h"
#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/verdict_work.h"

static const struct pos nowhere = {0, 0};

static const fbd_grading *grading_of(const struct fbd_grade *grade)
{
    return &grade->key->grading;
}

static bool near(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance * fmax(fabs(a), fabs(b));
}

/* ---- bodies */

/* A finding on all of a body of the key. */
static fbd_finding *add_on_body(struct fbd_grade *grade, fbd_finding_kind kind, size_t body, struct pos at)
{
    const fbd_marks *points = &grading_of(grade)->points;
    const fbd_body key = fbd_model_body(grade->sheet, body);
    fbd_finding *finding = finding_add(grade, kind, key.name, "", at);
    finding->most = points->force * (double)(key.listed + key_asks(grade->key, body)) + points->inertia;
    return finding;
}

void verdict_body(struct fbd_grade *grade, size_t body)
{
    finding_say(grade, add_on_body(grade, FBD_FINDING_BODY, body, nowhere), "the body is not in the answer");
}

void verdict_motion(struct fbd_grade *grade, size_t body, const fbd_body *other)
{
    const struct pos at = {other->motion_line, other->motion_column};
    finding_say(grade, add_on_body(grade, FBD_FINDING_MOTION, body, at),
                "the body moves in another way than on the sheet: its forces are not compared");
}

void verdict_gravity(struct fbd_grade *grade, size_t body)
{
    finding_say(grade, add_on_body(grade, FBD_FINDING_MOTION, body, nowhere),
                "`gravity` is not that of the sheet: its forces are not compared");
}

void verdict_superfluous(struct fbd_grade *grade, fbd_finding_kind kind, const char *body, const char *name,
                         struct pos at, const char *message)
{
    fbd_finding *finding = finding_add(grade, kind, body, name, at);
    finding->points = -grading_of(grade)->points.superfluous;
    finding_say(grade, finding, message);
}

/* ---- inertia */

static bool is_pivot(const fbd_body *body)
{
    return body->motion == FBD_MOTION_PIVOT;
}

/* G in the frame of the key; from the axis where there is one. */
static struct vec centre_of(const fbd_body *body, double length, double turned)
{
    struct vec turn = {cos(turned), sin(turned)}, G = {body->inertia.G[0], body->inertia.G[1]};
    if (is_pivot(body)) G = vec_sub(G, (struct vec){body->pin[0], body->pin[1]});
    return vec_scale(length, vec_turn(turn, G));
}

static const char *inertia_fault(const struct fbd_grade *grade, const fbd_body *body, const fbd_body *other,
                                 const struct sides *sides, double length, double force,
                                 fbd_finding_kind *kind)
{
    const fbd_inertia *key = &body->inertia, *own = &other->inertia;
    double tolerance = grading_of(grade)->tolerance, I = force * length; /* kg m^2 = N m s^2 */
    double I_G = I * own->I_G, I_O = I * own->I_O, mass = force / length * own->mass;
    struct vec apart = vec_sub(centre_of(other, length, sides->turned), centre_of(body, 1, 0));
    double gyration = sqrt(fmax(key->I_G, 0) / key->mass); /* G may be the origin, up to rounding */
    double from_origin = hypot(key->G[0], key->G[1]);
    bool pivot = is_pivot(body), turns = pivot || body->motion == FBD_MOTION_PLANAR;
    double size = tolerance * (from_origin + (pivot ? key->L : from_origin) + gyration);
    *kind = FBD_FINDING_INERTIA;
    if (!near(mass, key->mass, tolerance)) return "the mass is another one";
    if (turns && vec_norm(apart) > size) return "the centre of mass is at another place";
    if (!turns || near(pivot ? I_O : I_G, pivot ? key->I_O : key->I_G, tolerance)) return NULL;
    *kind = FBD_FINDING_REFERENCE_POINT;
    if (pivot && near(I_O, key->I_G, tolerance))
        return "the moment of inertia about O is that about G: m L^2 is missing";
    if (pivot && near(I_G, key->I_O, tolerance))
        return "the moment of inertia about G is that about O: m L^2 is counted twice";
    *kind = FBD_FINDING_INERTIA;
    return "the moment of inertia differs";
}

static void compare_inertia(struct fbd_grade *grade, const fbd_body *key, const fbd_body *body,
                            const struct sides *sides, double length, double force)
{
    const fbd_marks *points = &grading_of(grade)->points;
    fbd_finding_kind kind;
    const char *fault = inertia_fault(grade, key, body, sides, length, force, &kind);
    if (!fault && points->inertia == 0) return;
    fbd_finding *finding = finding_add(grade, fault ? kind : FBD_FINDING_RIGHT, key->name, "",
                                       (struct pos){body->line, body->column});
    finding->most = points->inertia;
    finding->points = !fault ? points->inertia : points->inertia > 0 ? 0 : -points->superfluous;
    finding_say(grade, finding, fault ? fault : "mass and moment of inertia are right");
}

/* ---- pairs */

const char *verdict_noun(const fbd_listed_force *force)
{
    return force && force->moment ? "moment" : "force";
}

/* Entries that are optional in the key earn no points. */
double verdict_worth(const struct fbd_grade *grade, const struct item *key)
{
    return key->source || key->asked ? grading_of(grade)->points.force : 0;
}

void verdict_pair(struct fbd_grade *grade, const char *body, struct item *key, struct item *item,
                  fbd_finding_kind kind, const char *message, const char *detail)
{
    double share = kind == FBD_FINDING_RIGHT ? 1 : grading_of(grade)->partial;
    fbd_finding *finding =
        finding_add(grade, kind, body, name_as_drawn(grade, item->source), position_of(item->source));
    finding->most = verdict_worth(grade, key);
    finding->points = share * finding->most;
    finding_say(grade, finding, message);
    finding_tell(grade, finding, detail);
    key->used = item->used = true;
}

void verdict_right(struct fbd_grade *grade, const char *body, struct item *key, struct item *item,
                   const char *message)
{
    struct text text = {0};
    text_printf(&text, "it is `%s` of the key", key->name);
    if (text.failed) grade->arena.failed = true;
    verdict_pair(grade, body, key, item, FBD_FINDING_RIGHT, message, text.data ? text.data : "");
    text_free(&text);
}

/* A weight with the relative error of the mass is reported as an error of the mass. */
static bool follows_mass(const struct item *key, const struct item *item, const struct difference *difference,
                         double masses)
{
    return strcmp(key->source->law, "gravity") == 0 && are_alike(key, item) &&
           difference->relation == is_scaled && near(difference->ratio, masses, 1e-6);
}

static void pair_equal(struct fbd_grade *grade, const char *body, struct sides *sides, double masses)
{
    for (int same_kind = 1; same_kind >= 0; same_kind--)
        for (size_t i = 0; i < sides->key_count; i++)
            for (size_t j = 0; j < sides->count; j++) {
                struct item *key = &sides->key[i], *item = &sides->items[j];
                if (!is_left(key) || !is_left(item)) continue;
                if (same_kind && !are_alike(key, item)) continue;
                if (!are_alike(key, item) && is_drawn_as_such(sides, key)) continue;
                if (is_nothing(sides, item) && !is_nothing(sides, key))
                    continue; /* for friction that is zero */
                struct difference difference = difference_of(sides, key, item);
                if (difference.relation == is_same || follows_mass(key, item, &difference, masses))
                    verdict_right(grade, body, key, item, "right");
            }
}

/* If these are the parts of `whole`, mark them as used. */
static bool take_parts(const struct sides *sides, struct item **parts, size_t count, const struct item *whole)
{
    for (size_t i = 0; i < count; i++)
        if (!is_left(parts[i])) return false;
    if (!adds_up(sides, (const struct item *const *)parts, count, whole)) return false;
    for (size_t i = 0; i < count; i++) parts[i]->used = true;
    return true;
}

/* Find two of `items` that add up to `whole`, or else three; returns their number, 0 if there are none. */
static size_t find_parts(const struct sides *sides, struct item *items, size_t count,
                         const struct item *whole, struct item *parts[3])
{
    for (size_t wanted = 2; wanted <= 3; wanted++)
        for (size_t i = 0; i < count; i++)
            for (size_t j = i + 1; j < count; j++) {
                parts[0] = &items[i];
                parts[1] = &items[j];
                if (wanted == 2 && take_parts(sides, parts, 2, whole)) return 2;
                for (size_t k = j + 1; wanted == 3 && k < count; k++) {
                    parts[2] = &items[k];
                    if (take_parts(sides, parts, 3, whole)) return 3;
                }
            }
    return 0;
}

/* Pair components with one force, or one resultant with several. */
static void pair_sums(struct fbd_grade *grade, const char *body, struct sides *sides)
{
    struct item *parts[3];
    for (size_t k = 0; k < sides->key_count; k++) {
        struct item *key = &sides->key[k];
        bool asked = is_left(key) && !is_drawn_as_such(sides, key);
        if (asked && find_parts(sides, sides->items, sides->count, key, parts) > 0)
            verdict_right(grade, body, key, parts[0], "right, together with its other components");
    }
    for (size_t j = 0; j < sides->count; j++) {
        struct item *item = &sides->items[j];
        bool left = is_left(item);
        size_t found = left ? find_parts(sides, sides->key, sides->key_count, item, parts) : 0;
        for (size_t i = 0; i < found; i++)
            verdict_right(grade, body, parts[i], item, "right, as a resultant");
    }
}

/* Pair several of the key with several of the answer that are equivalent together, as forces at G with one
 * moment of all their offsets: the smallest such group first. */
static void pair_groups(struct fbd_grade *grade, const char *body, struct sides *sides)
{
    struct group group;
    while (group_find(sides, &group)) {
        for (size_t j = 0; j < group.count; j++) group.items[j]->used = true;
        for (size_t i = 0; i < group.key_count; i++)
            verdict_right(grade, body, group.key[i], group.items[0], "right, together with others");
    }
}

/* ---- pairing of the remaining entries */

/* Factors between units, and that of weight written for mass. */
static const char *unit_of_ratio(double ratio, double g)
{
    static const struct {
        double factor;
        const char *says;
    } factors[] = {
        {1e3, "its unit may be wrong: it is 1000 times too large"},
        {1e-3, "its unit may be wrong: it is 1000 times too small"},
        {1e2, "its unit may be wrong: it is 100 times too large"},
        {1e-2, "its unit may be wrong: it is 100 times too small"},
        {1e6, "its unit may be wrong: it is a million times too large"},
        {1e-6, "its unit may be wrong: it is a million times too small"},
        {4.4482216152605, "its unit may be wrong: pounds where newtons are meant"},
        {1 / 4.4482216152605, "its unit may be wrong: newtons where pounds are meant"},
        {57.29577951308232, "its unit may be wrong: degrees where radians are meant"},
        {1 / 57.29577951308232, "its unit may be wrong: radians where degrees are meant"},
        {1.3558179483314004, "its unit may be wrong: pound-feet where newton-metres are meant"},
        {1 / 1.3558179483314004, "its unit may be wrong: newton-metres where pound-feet are meant"},
        {0.3048, "its unit may be wrong: feet where metres are meant, or the other way"},
        {1 / 0.3048, "its unit may be wrong: feet where metres are meant, or the other way"},
    };
    if (g > 0 && near(ratio, 1 / g, 1e-3)) return "it is a mass where a weight belongs: g is missing";
    if (g > 0 && near(ratio, g, 1e-3)) return "g is in it once too often";
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++)
        if (near(ratio, factors[i].factor, 1e-3)) return factors[i].says;
    return NULL;
}

static fbd_finding_kind kind_of(const struct difference *difference, double g)
{
    switch (difference->relation) {
    case is_same: return FBD_FINDING_RIGHT;
    case is_opposite: return FBD_FINDING_SENSE;
    case is_elsewhere: return FBD_FINDING_PLACE;
    case is_turned: return FBD_FINDING_DIRECTION;
    case is_rougher: return FBD_FINDING_COEFFICIENT;
    case is_scaled: return unit_of_ratio(difference->ratio, g) ? FBD_FINDING_UNIT : FBD_FINDING_MAGNITUDE;
    case is_other: break;
    }
    return FBD_FINDING_DIRECTION;
}

/* How unlikely it is that one was meant to be the other; at no_pair and above they are not paired. */
enum { no_pair = 9 };

static int unlikeness(const struct item *key, const struct item *item, const struct difference *difference)
{
    static const int ranks[] = {[is_same] = 0,   [is_opposite] = 0, [is_elsewhere] = 1, [is_rougher] = 0,
                                [is_turned] = 2, [is_scaled] = 3,   [is_other] = 7};
    bool same_name = strcmp(key->name, item->name) == 0;
    bool same_kind = are_alike(key, item);
    bool same_noun = strcmp(verdict_noun(key->source), verdict_noun(item->source)) == 0;
    if (!same_noun) return no_pair + 1;
    /* With another magnitude and the opposite sense, a pair needs the same name or kind. */
    if (difference->relation == is_scaled && !(difference->ratio > 0) && !same_name && !same_kind)
        return no_pair;
    /* Any two moments are parallel: only a constant ratio makes them similar. */
    bool alike = difference->relation != is_scaled || isfinite(difference->ratio);
    bool nothing = difference->relation == is_scaled && fabs(difference->ratio) < 1e-9;
    if ((!alike && !same_name) || nothing) return no_pair;
    return (same_name ? !same_kind : same_kind ? 2 : 5) + ranks[difference->relation];
}

static void say_pair(struct fbd_grade *grade, const char *body, struct item *key, struct item *item,
                     const struct difference *difference)
{
    const fbd_scene sheet = fbd_model_scene(grade->sheet);
    const double g = hypot(sheet.gravity[0], sheet.gravity[1]), degree = 57.29577951308232;
    const char *unit = unit_of_ratio(difference->ratio, g), *message = "it differs in size and direction";
    struct text detail = {0};
    text_printf(&detail, "compared with `%s` of the key", key->name);
    switch (difference->relation) {
    case is_opposite: message = "it points the opposite way"; break;
    case is_elsewhere: message = "it acts at the wrong place: its line of action is another one"; break;
    case is_rougher: message = "a coefficient of friction, or the speed of the surface, is wrong"; break;
    case is_turned:
        message = difference->exchanged ? "its direction is wrong: are sine and cosine exchanged?"
                                        : "its direction is wrong";
        if (isfinite(difference->angle))
            text_printf(&detail, ": turned by %.4g deg", degree * difference->angle);
        break;
    case is_scaled:
        message = unit ? unit : "its magnitude is wrong";
        if (isfinite(difference->ratio)) text_printf(&detail, ": %.6g times as large", difference->ratio);
        break;
    case is_same: message = "right"; break; /* it is zero, since a force that it depends on is missing */
    case is_other: break;
    }
    if (detail.failed) grade->arena.failed = true;
    verdict_pair(grade, body, key, item, kind_of(difference, g), message, detail.data ? detail.data : "");
    text_free(&detail);
}

/* ---- the rest */

/* The closest pair of a remaining force of the key and one of the answer. */
struct closest {
    struct item *key, *item;
    struct difference difference;
    int rank;
};

static struct closest closest_pair(struct sides *sides)
{
    struct closest best = {.difference = {.relation = is_other}, .rank = no_pair};
    for (size_t i = 0; i < sides->key_count; i++)
        for (size_t j = 0; j < sides->count; j++) {
            struct item *key = &sides->key[i], *item = &sides->items[j];
            if (!is_left(key) || !is_left(item)) continue;
            struct difference difference = difference_of(sides, key, item);
            int rank = unlikeness(key, item, &difference);
            if (rank < best.rank) best = (struct closest){key, item, difference, rank};
        }
    return best;
}

static bool pair_closest(struct fbd_grade *grade, const char *body, struct sides *sides)
{
    struct closest best = closest_pair(sides);
    struct misdrawn misdrawn;
    if (reactions_closest(sides, best.rank, &misdrawn))
        verdict_misdrawn(grade, body, &misdrawn);
    else if (best.rank < no_pair)
        say_pair(grade, body, best.key, best.item, &best.difference);
    else
        return false;
    return true;
}

static void add_missing(struct fbd_grade *grade, const char *body, const struct item *key)
{
    struct text text = {0};
    fbd_finding *finding = finding_add(grade, FBD_FINDING_MISSING, body, "", nowhere);
    finding->most = grading_of(grade)->points.force;
    if (!key->source && grade->last) grade->last->reaction = true;
    text_printf(&text, "a %s is missing", key->source ? verdict_noun(key->source) : "reaction");
    finding_say(grade, finding, text.data ? text.data : "");
    text.length = 0;
    text_printf(&text, "it is `%s` of the key", key->name);
    finding_tell(grade, finding, text.data ? text.data : "");
    if (text.failed) grade->arena.failed = true;
    text_free(&text);
}

void verdict_rest(struct fbd_grade *grade, size_t body, struct sides *sides)
{
    const char *name = fbd_model_body_name(grade->sheet, body);
    pair_sums(grade, name, sides);
    pair_groups(grade, name, sides);
    verdict_zeros(grade, name, sides);
    bool paired = true;
    while (paired) paired = pair_closest(grade, name, sides);
    for (size_t i = 0; i < sides->key_count; i++)
        if (!sides->key[i].used) add_missing(grade, name, &sides->key[i]);
    for (size_t i = 0; i < sides->reaction_count; i++)
        if (!sides->reactions[i].used && sides->reactions[i].asked)
            add_missing(grade, name, &sides->reactions[i]);
    for (size_t j = 0; j < sides->count; j++) {
        const struct item *item = &sides->items[j];
        if (!item->used && !is_nothing(sides, item))
            verdict_superfluous(grade, FBD_FINDING_SUPERFLUOUS, name, name_as_drawn(grade, item->source),
                                position_of(item->source), "nothing exerts this on the body");
    }
}

void verdict_on(struct fbd_grade *grade, const fbd_model *answer, size_t body, const fbd_body *other,
                struct sides *sides, double length, double force)
{
    const fbd_body key = fbd_model_body(grade->sheet, body);
    double masses = force / length * other->inertia.mass / key.inertia.mass;
    compare_inertia(grade, &key, other, sides, length, force);
    pair_equal(grade, key.name, sides, masses);
    verdict_reactions(grade, answer, body, sides);
}
