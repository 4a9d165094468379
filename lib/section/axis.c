/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The axis of a straight body: that of its longest rod or plate. All others must lie on it.
 */
#include <math.h>

#include "model/outline.h"
#include "numeric/tolerances.h"
#include "section/loads.h"

static bool refuse(struct section_work *work, const char *hint, const char *format)
{
    diag_add(work->errors, FBD_ERROR, "no-section", work->body->source->at, hint, format, work->body->name);
    return false;
}

/* A rod or a plate by its middle line, in the frame of the body. */
struct middle {
    struct vec from, to;
};

bool section_is_straight(const struct outline_part *shape)
{
    const struct vec *corner = shape->corner;
    if (shape->kind != outline_polygon) return shape->kind == outline_bar;
    if (shape->count != 4) return false;
    const struct vec across = vec_sub(corner[2], corner[0]), other = vec_sub(corner[3], corner[1]),
                     apart = vec_sub(vec_add(corner[0], corner[2]), vec_add(corner[1], corner[3]));
    const double length = vec_norm(across), near = nine_digits * length;
    return vec_norm(apart) <= near && fabs(vec_norm(other) - length) <= near;
}

static bool find_middle(const struct outline_part *shape, struct middle *middle)
{
    const struct vec a = shape->corner[0], b = shape->corner[1], c = shape->corner[2], d = shape->corner[3];
    if (!section_is_straight(shape)) return false;
    if (shape->kind == outline_bar) {
        *middle = (struct middle){a, b};
        return true;
    }
    const bool first = vec_norm(vec_sub(b, a)) >= vec_norm(vec_sub(c, b));
    *middle = first ? (struct middle){vec_scale(0.5, vec_add(a, d)), vec_scale(0.5, vec_add(b, c))}
                    : (struct middle){vec_scale(0.5, vec_add(a, b)), vec_scale(0.5, vec_add(d, c))};
    const struct vec along = vec_sub(middle->to, middle->from);
    if (along.x < -nine_digits * vec_norm(along) ||
        (fabs(along.x) <= nine_digits * vec_norm(along) && along.y < 0))
        *middle = (struct middle){middle->to, middle->from}; /* with the x axis of the body */
    return true;
}

static bool choose_axis(struct section_work *work)
{
    fbd_section *section = work->section;
    const struct body *source = work->body->source;
    double longest = 0;
    struct middle axis = {{0, 0}, {0, 0}}, middle;
    for (size_t i = 0; i < source->part_count; i++) {
        const struct outline_part shape = outline_of_part(&source->parts[i]);
        if (shape.hole)
            return refuse(work, "leave the hole out, or give its section a body of its own",
                          "`%s` has a hole, whose sections are not those of a rod");
        if (shape.kind == outline_unknown)
            return refuse(work, "give it `shape: rod` or `shape: prism` in place of `inertia`",
                          "`%s` has a moment of inertia, but no distribution of its mass");
        if (!find_middle(&shape, &middle)) continue;
        const double length = vec_norm(vec_sub(middle.to, middle.from));
        if (!(length > longest * (1 + nine_digits))) continue;
        longest = length;
        axis = middle;
    }
    if (!(longest > 0))
        return refuse(work,
                      "sections are those of a body with `shape: rod` or `shape: prism`, or such a part",
                      "`%s` has no part that is long and straight");
    section->origin = axis.from;
    section->e = vec_scale(1 / longest, vec_sub(axis.to, axis.from));
    section->length = longest;
    return true;
}

/* From the frame of the body into the axes of the axis. */
static struct vec in_axis(const fbd_section *section, struct vec point)
{
    const struct vec r = vec_sub(point, section->origin);
    return (struct vec){vec_dot(r, section->e), vec_cross(section->e, r)};
}

/* Add the part to the bars, if it is one; false when it does not lie on the axis. */
static bool add_bar(struct section_work *work, const struct part *part)
{
    const fbd_section *section = work->section;
    const struct outline_part shape = outline_of_part(part);
    const struct inertia inertia = inertia_of_parts(part, 1, work->body->pin);
    struct middle middle;
    if (!find_middle(&shape, &middle)) return true;
    const struct vec a = in_axis(section, middle.from), b = in_axis(section, middle.to);
    const double length = vec_norm(vec_sub(b, a)), near = nine_digits * section->length;
    if (fabs(a.y) > near || fabs(b.y) > near) return false;
    const double slender = inertia.mass * length * length / 12;
    const double excess = shape.kind == outline_bar ? 0 : inertia.I_G - slender;
    work->bars[work->bar_count++] =
        (struct section_bar){fmin(a.x, b.x), fmax(a.x, b.x), inertia.mass / length, excess / length};
    return true;
}

/* The axis from the first to the last end of all bars. */
static void extend_axis(struct section_work *work)
{
    fbd_section *section = work->section;
    double low = 0, high = section->length;
    for (size_t i = 0; i < work->bar_count; i++) {
        low = fmin(low, work->bars[i].from);
        high = fmax(high, work->bars[i].to);
    }
    section->origin = vec_add(section->origin, vec_scale(low, section->e));
    section->length = high - low;
    section->near = negligible_part * (section->length + vec_norm(section->origin));
    for (size_t i = 0; i < work->bar_count; i++) {
        work->bars[i].from -= low;
        work->bars[i].to -= low;
    }
}

bool section_find_axis(struct section_work *work)
{
    const struct body *source = work->body->source;
    if (!choose_axis(work)) return false;
    work->bars = ARENA_ARRAY(&work->section->arena, source->part_count + 1, struct section_bar);
    if (!work->bars) return false;
    for (size_t i = 0; i < source->part_count; i++)
        if (!add_bar(work, &source->parts[i]))
            return refuse(work,
                          "make each straight part a body, and weld them: a weld shows N, V and M there",
                          "the parts of `%s` do not lie on one straight line");
    extend_axis(work);
    return true;
}
