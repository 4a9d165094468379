/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Place the arrows of a drawing on the lines of action that they were drawn for.
 *
 * Drawings are not exact, and the length of an arrow does not give its magnitude. Each arrow is matched,
 * nearest first, with a force of the key whose direction and line of action agree within the tolerances of
 * drawings, and is placed there exactly; if it has no value and the key lists the force, it gets that of the
 * key. Remaining arrows are matched with remaining forces from which they differ in one respect: sense, place
 * or direction. The rest of grading compares exactly (compare.h).
 */
#include <stdlib.h>

#include "fbd_grade.h"
#include "grade/reactions_work.h"

/* A force or moment of the key, or the sum of two at one point. */
struct line {
    const struct item *key, *other; /* `other`: the second of the sum, or NULL */
    size_t s;                       /* the state where it is compared */
    struct vec force, point;        /* at that state, the point as at the start */
    bool couple, given, taken;      /* `given`: the key lists it, and it does not depend on other forces */
};

struct stroke {
    struct item *item;
    const struct sketch *sketch;
    struct vec along;      /* a unit vector */
    const struct line *on; /* the matched line, or NULL */
    bool placed;
};

struct sheet {
    const struct fbd_grade *grade;
    struct sides *sides;
    size_t line_count, stroke_count;
    struct line *lines;
    struct stroke *strokes;
    double angle; /* tolerance */
};

static struct vec unit(struct vec v)
{
    double size = vec_norm(v);
    return size > 0 ? vec_scale(1 / size, v) : v;
}

/* ---- candidate lines */

static struct vec force_at(const struct line *line, size_t s)
{
    struct vec force = line->key->at[s].force;
    return line->other ? vec_add(force, line->other->at[s].force) : force;
}

/* The first state at which a given force is not zero. */
static size_t when_given(const struct sides *sides, const struct item *key)
{
    size_t s = 0;
    while (s + 1 < sides->samples && vec_norm(key->at[s].force) <= reaction_zero * sides->force &&
           fabs(key->at[s].moment) <= reaction_zero * sides->moment)
        s++;
    return s;
}

static struct line *add_line(struct sheet *sheet, const struct item *key, const struct item *other)
{
    const struct sides *sides = sheet->sides;
    struct line *line = &sheet->lines[sheet->line_count];
    *line = (struct line){.key = key, .other = other, .given = key->source && !key->follows};
    line->s = line->given ? when_given(sides, key) : reaction_when(sides, key);
    line->force = force_at(line, line->s);
    line->point = vec_add(vec_sub(key->at[line->s].point, key->about[line->s]), key->about[0]);
    line->couple = vec_norm(line->force) <= reaction_zero * sides->force;
    sheet->line_count++;
    return line;
}

static bool make_lines(struct sheet *sheet)
{
    struct sides *sides = sheet->sides;
    size_t all = sides->reaction_count + sides->key_count;
    sheet->lines = calloc(all * (all + 1) / 2 + 1, sizeof *sheet->lines);
    if (!sheet->lines) return false;
    for (size_t i = 0; i < sides->key_count; i++)
        if (!sides->key[i].follows) add_line(sheet, &sides->key[i], NULL);
    for (size_t k = 0; k < all; k++) {
        const struct item *key = reaction_candidate(sides, k);
        if (key) add_line(sheet, key, NULL);
        for (size_t j = k + 1; key && j < all; j++) {
            const struct item *other = reaction_candidate(sides, j);
            size_t s = reaction_when(sides, key);
            if (!other || reaction_is_couple(sides, key, s) || reaction_is_couple(sides, other, s)) continue;
            if (vec_norm(vec_sub(key->at[s].point, other->at[s].point)) <= 1e-9 * (sides->reach + 1))
                add_line(sheet, key, other);
        }
    }
    return true;
}

static bool make_strokes(struct sheet *sheet)
{
    struct sides *sides = sheet->sides;
    sheet->strokes = calloc(sides->count + 1, sizeof *sheet->strokes);
    for (size_t j = 0; sheet->strokes && j < sides->count; j++) {
        struct item *item = &sides->items[j];
        const struct sketch *sketch =
            item->source ? sketch_at(sheet->grade, position_of(item->source)) : NULL;
        if (!sketch) continue;
        struct vec along = unit(vec_sub(sketch->tip, sketch->tail));
        sheet->strokes[sheet->stroke_count++] =
            (struct stroke){.item = item, .sketch = sketch, .along = along};
    }
    return sheet->strokes != NULL;
}

/* ---- placing an arrow */

static void put(struct item *item, size_t s, struct vec force, struct vec point)
{
    struct action *at = &item->at[s];
    struct vec lever = vec_sub(point, item->about[s]);
    double size = vec_norm(force);
    at->force = force;
    at->point = point;
    at->moment = vec_cross(lever, force);
    at->arm = size > 0 ? fabs(at->moment) / size : 0;
}

/* Place an arrow as drawn, with its magnitude: entries of drawings point to the right. */
static void put_as_drawn(const struct sheet *sheet, const struct stroke *stroke, struct vec along)
{
    struct item *item = stroke->item;
    for (size_t s = 0; s < sheet->sides->samples; s++) {
        struct vec apart = vec_sub(stroke->sketch->tail, item->about[0]);
        if (stroke->sketch->couple)
            item->at[s].moment *= stroke->sketch->clockwise ? -1 : 1;
        else
            put(item, s, vec_scale(item->at[s].force.x, along), vec_add(item->about[s], apart));
    }
}

/* Place an arrow on a line, with its own magnitude; `there`: at the point of the line, too. */
static void put_on_line(const struct sheet *sheet, struct stroke *stroke, const struct line *line,
                        double sense, bool there)
{
    struct item *item = stroke->item;
    for (size_t s = 0; s < sheet->sides->samples; s++) {
        struct vec force = force_at(line, s), along = unit(vec_norm(force) > 0 ? force : line->force);
        double size = vec_norm(item->at[s].force) * (vec_dot(item->at[s].force, stroke->along) < 0 ? -1 : 1);
        put(item, s, vec_scale(sense * size, along), there ? line->key->at[s].point : item->at[s].point);
    }
    stroke->placed = true;
}

/* Set an arrow to the key's force times `factor`, turned by `angle`; at its point, or where it is drawn. */
static void put_as_given(const struct sheet *sheet, struct stroke *stroke, const struct line *line,
                         double factor, double angle, bool there)
{
    struct item *item = stroke->item;
    struct vec turn = {factor * cos(angle), factor * sin(angle)};
    for (size_t s = 0; s < sheet->sides->samples; s++) {
        const struct action *key = &line->key->at[s];
        struct vec force = key->force, point = there ? key->point : item->at[s].point;
        if (there && angle == 0) {
            item->at[s] = *key;
            item->at[s].force = vec_scale(factor, force);
            item->at[s].moment *= factor;
        } else {
            put(item, s,
                (struct vec){turn.x * force.x - turn.y * force.y, turn.x * force.y + turn.y * force.x},
                point);
        }
    }
    struct drawn *drawn = drawn_at(sheet->grade, position_of(item->source));
    if (drawn) drawn->size = line->couple ? fabs(line->key->at[0].moment) : vec_norm(line->key->at[0].force);
    item->unknown = false;
    stroke->placed = true;
}

/* ---- distance of an arrow from a line */

struct nearness {
    double turn;  /* from the line, to the left */
    double angle; /* between the lines, 0 to pi/2 */
    double off;   /* distance of the line of action over its tolerance */
    bool forward;
};

static double distance_from(const struct line *line, struct vec point)
{
    return fabs(vec_cross(unit(line->force), vec_sub(point, line->point)));
}

static struct nearness nearness_of(const struct sheet *sheet, const struct stroke *stroke,
                                   const struct line *line)
{
    const struct sketch *sketch = stroke->sketch;
    struct nearness near = {.forward = true};
    if (line->couple) {
        near.forward = (line->key->at[line->s].moment < 0) == sketch->clockwise;
    } else {
        near.turn = atan2(vec_cross(line->force, stroke->along), vec_dot(line->force, stroke->along));
        near.forward = fabs(near.turn) < 1.5707963267948966;
        near.angle = near.forward ? fabs(near.turn) : 3.141592653589793 - fabs(near.turn);
        if (sheet->sides->turns)
            near.off =
                fmin(distance_from(line, sketch->tail), distance_from(line, sketch->tip)) / sketch->snap;
    }
    if (line->given && line->s > 0) near.forward = true; /* it is zero at the start */
    return near;
}

static bool touches(const struct sheet *sheet, const struct stroke *stroke, const struct line *line)
{
    const struct sketch *sketch = stroke->sketch;
    double tail = vec_norm(vec_sub(sketch->tail, line->point)),
           tip = vec_norm(vec_sub(sketch->tip, line->point));
    return !sheet->sides->turns || fmin(tail, tip) <= sketch->snap;
}

/* ---- matching */

enum respect { all_right, as_sum, by_sense, by_place, by_direction };

/* Distance of an arrow from a line from which it differs in at most one respect; HUGE_VAL if in more. */
static double off_in(enum respect respect, const struct sheet *sheet, const struct stroke *stroke,
                     const struct line *line)
{
    struct nearness near = nearness_of(sheet, stroke, line);
    double angle = near.angle / sheet->angle;
    bool there = near.off <= 1, along = angle <= 1;
    if ((respect == as_sum) != (line->other != NULL)) return HUGE_VAL;
    switch (respect) {
    case all_right:
    case as_sum: return there && along && near.forward ? near.off + angle : HUGE_VAL;
    case by_sense: return there && along && !near.forward ? near.off + angle : HUGE_VAL;
    case by_place: return along && near.forward ? near.off + angle : HUGE_VAL;
    case by_direction:
        return line->given && !line->couple && touches(sheet, stroke, line) ? fabs(near.turn) : HUGE_VAL;
    }
    return HUGE_VAL;
}

static void match_one(const struct sheet *sheet, struct stroke *stroke, struct line *line,
                      enum respect respect)
{
    double turn = nearness_of(sheet, stroke, line).turn, sense = respect == by_sense ? -1 : 1;
    line->taken = true;
    stroke->on = line;
    if (line->given)
        put_as_given(sheet, stroke, line, sense, respect == by_direction ? turn : 0,
                     respect != by_place && respect != by_direction);
    else if (!line->couple)
        put_on_line(sheet, stroke, line, sense, respect != by_place);
    stroke->placed = true;
}

/* Match the arrows without a value with the unmatched lines, nearest first. */
static void match_all(const struct sheet *sheet, enum respect respect)
{
    for (;;) {
        double least = HUGE_VAL;
        struct stroke *stroke = NULL;
        struct line *line = NULL;
        for (size_t i = 0; i < sheet->stroke_count; i++)
            for (size_t k = 0; k < sheet->line_count; k++) {
                struct stroke *one = &sheet->strokes[i];
                struct line *other = &sheet->lines[k];
                if (one->placed || !one->item->unknown || other->taken) continue;
                if (one->sketch->couple != other->couple) continue;
                double off = off_in(respect, sheet, one, other);
                if (!(off < least)) continue;
                least = off;
                stroke = one;
                line = other;
            }
        if (!stroke) return;
        match_one(sheet, stroke, line, respect);
    }
}

/* True if an arrow has the magnitude of the force. */
static bool is_as_large(const struct sides *sides, const struct item *item, const struct line *line)
{
    double size = line->couple ? fabs(line->key->at[line->s].moment) : vec_norm(line->force);
    double own = line->couple ? fabs(item->at[line->s].moment) : vec_norm(item->at[line->s].force);
    return fabs(size - own) <= sides->tolerance * size;
}

/* Place an arrow with a value on the nearest line, preferably one of that magnitude and sense. */
static void match_value(const struct sheet *sheet, struct stroke *stroke)
{
    double least = HUGE_VAL;
    struct line *found = NULL;
    for (size_t k = 0; k < sheet->line_count; k++) {
        struct line *line = &sheet->lines[k];
        struct nearness near = nearness_of(sheet, stroke, line);
        if (line->couple || stroke->sketch->couple || near.off > 1 || near.angle > sheet->angle) continue;
        double off = near.off + near.angle / sheet->angle;
        bool other = line->taken || line->other || !is_as_large(sheet->sides, stroke->item, line);
        off += (near.forward ? 0 : 4) + (other ? 2 : 0);
        if (off >= least) continue;
        least = off;
        found = line;
    }
    if (!found) return;
    if (least <= 2) found->taken = true;
    put_on_line(sheet, stroke, found, nearness_of(sheet, stroke, found).forward ? 1 : -1, true);
}

/* ---- components, and the rest */

/* The nearest direction along x or y, along a force of the key, or perpendicular to one; NULL beyond the
 * tolerance. */
static struct vec straight(const struct sheet *sheet, struct vec along)
{
    struct vec best = along;
    double least = sheet->angle;
    for (size_t k = 0; k <= sheet->line_count; k++) {
        struct vec axis = k < sheet->line_count ? unit(sheet->lines[k].force) : (struct vec){1, 0};
        for (int quarter = 0; quarter < 4; quarter++, axis = vec_perp(axis)) {
            double off = fabs(atan2(vec_cross(axis, along), vec_dot(axis, along)));
            if (vec_norm(axis) == 0 || off > least) continue;
            least = off;
            best = axis;
        }
    }
    return best;
}

/* Match two perpendicular arrows without values with the components of a force that the key lists. */
static void match_components(const struct sheet *sheet, struct line *line)
{
    for (size_t i = 0; i < sheet->stroke_count; i++)
        for (size_t j = i + 1; j < sheet->stroke_count && !line->taken; j++) {
            struct stroke *one = &sheet->strokes[i], *other = &sheet->strokes[j];
            bool free = !one->placed && !other->placed && one->item->unknown && other->item->unknown;
            if (!free || one->sketch->couple || other->sketch->couple) continue;
            if (!touches(sheet, one, line) || !touches(sheet, other, line)) continue;
            struct vec first = straight(sheet, one->along), second = straight(sheet, other->along),
                       force = unit(line->force);
            double a = vec_dot(first, force), b = vec_dot(second, force);
            if (fabs(vec_dot(first, second)) > 1e-6 || a < sheet->angle || b < sheet->angle) continue;
            put_as_given(sheet, one, line, a, atan2(vec_cross(force, first), a), true);
            put_as_given(sheet, other, line, b, atan2(vec_cross(force, second), b), true);
            line->taken = true;
        }
}

/* The nearest point of the key that is on the line of an arrow, or that the arrow touches; NULL if there is
 * none. `any`: of reactions of unknown direction. */
static const struct line *point_near(const struct sheet *sheet, const struct stroke *stroke, bool any)
{
    const struct line *found = NULL;
    double least = HUGE_VAL;
    for (size_t k = 0; k < sheet->line_count; k++) {
        const struct line *line = &sheet->lines[k];
        struct line through = {.key = line->key, .force = stroke->along, .point = line->point};
        if (line->couple || (any && (line->given || !line->key->any))) continue;
        double off = nearness_of(sheet, stroke, &through).off + (touches(sheet, stroke, line) ? 0 : 1);
        if (off > 2 || off >= least) continue;
        least = off;
        found = line;
    }
    return found;
}

/* Turn an arrow to this direction, through the point of a line, or its own point. */
static void put_along(const struct sheet *sheet, struct stroke *stroke, struct vec along,
                      const struct line *line)
{
    struct item *item = stroke->item;
    for (size_t s = 0; s < sheet->sides->samples; s++) {
        double size = vec_norm(item->at[s].force) *
                      (item->unknown || vec_dot(item->at[s].force, stroke->along) > 0 ? 1 : -1);
        put(item, s, vec_scale(size, along), line ? line->key->at[s].point : item->at[s].point);
    }
    stroke->placed = true;
}

/* Place a remaining arrow at a reaction of unknown direction as a component of it, together with a
 * perpendicular arrow at that point, if there is one. */
static void put_components(const struct sheet *sheet, struct stroke *stroke, const struct line *line)
{
    struct vec along = straight(sheet, stroke->along), across = vec_perp(along);
    put_along(sheet, stroke, along, line);
    for (size_t j = 0; j < sheet->stroke_count; j++) {
        struct stroke *other = &sheet->strokes[j];
        double way = vec_dot(across, other->along);
        if (other == stroke || !other->item->unknown || other->sketch->couple || !touches(sheet, other, line))
            continue;
        if (fabs(way) < cos(2 * sheet->angle) || (other->on && other->on != line)) continue;
        put_along(sheet, other, vec_scale(way < 0 ? -1 : 1, across), line);
        return;
    }
}

static void match_rest(const struct sheet *sheet)
{
    for (size_t k = 0; k < sheet->line_count; k++)
        if (sheet->lines[k].given && !sheet->lines[k].couple && !sheet->lines[k].taken)
            match_components(sheet, &sheet->lines[k]);
    for (size_t i = 0; i < sheet->stroke_count; i++) {
        struct stroke *stroke = &sheet->strokes[i];
        if (stroke->placed || stroke->sketch->couple) continue;
        const struct line *line = point_near(sheet, stroke, true);
        if (line) put_components(sheet, stroke, line);
    }
    match_all(sheet, as_sum);
    match_all(sheet, by_sense);
    match_all(sheet, by_place);
    match_all(sheet, by_direction);
    for (size_t i = 0; i < sheet->stroke_count; i++) {
        struct stroke *stroke = &sheet->strokes[i];
        if (!stroke->placed && !stroke->sketch->couple)
            put_along(sheet, stroke, straight(sheet, stroke->along), point_near(sheet, stroke, false));
    }
}

bool sketches_place(const struct fbd_grade *grade, struct sides *sides)
{
    struct sheet sheet = {.grade = grade, .sides = sides};
    sheet.angle = grade->key->grading.canvas.angle;
    bool made = make_lines(&sheet) && make_strokes(&sheet);
    if (made && sheet.stroke_count > 0) {
        for (size_t i = 0; i < sheet.stroke_count; i++)
            put_as_drawn(&sheet, &sheet.strokes[i], sheet.strokes[i].along);
        for (size_t i = 0; i < sheet.stroke_count; i++)
            if (!sheet.strokes[i].item->unknown) match_value(&sheet, &sheet.strokes[i]);
        match_all(&sheet, all_right);
        match_rest(&sheet);
    }
    free(sheet.lines);
    free(sheet.strokes);
    return made;
}
