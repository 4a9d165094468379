/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Level surfaces, and corners inside them: for shapes that move together (the parts of a body, or all of the
 * ground), corners closer to each other than the level are merged, and corners closer to the line of a side
 * are moved onto it.
 */
#include "model/contact.h"

#include "model/model.h"
#include "numeric/tolerances.h"

/* Shapes that are already level, each once. */
struct levelled {
    const struct contact_shape **shapes;
    int count;
    double near; /* [m] */
};

static const struct contact_shape *find_same(const struct levelled *done, const struct contact_shape *shape)
{
    for (int i = 0; i < done->count && shape->source; i++)
        if (done->shapes[i]->source == shape->source && done->shapes[i]->link == shape->link)
            return done->shapes[i];
    return NULL;
}

static bool find_corner(const struct levelled *done, int link, struct vec *p)
{
    for (int i = 0; i < done->count; i++) {
        const struct contact_shape *shape = done->shapes[i];
        for (int k = 0; k < shape->count && shape->link == link; k++) {
            if (vec_norm(vec_sub(shape->corners[k], *p)) > done->near) continue;
            *p = shape->corners[k];
            return true;
        }
    }
    return false;
}

/* Side number k of a shape, or a line itself. */
static bool side_of(const struct contact_shape *shape, int k, struct vec *base, struct vec *e)
{
    *base = shape->kind == contact_line ? shape->center : shape->corners[k];
    *e = shape->kind == contact_line ? shape->e : vec_sub(shape->corners[(k + 1) % shape->count], *base);
    double length = vec_norm(*e);
    if (length > 0) *e = vec_scale(1 / length, *e);
    return length > 0;
}

/* Move a point onto a near line; for two crossing lines onto their intersection, if that is near as well. */
static void put_on_lines(const struct levelled *done, int link, struct vec *p)
{
    struct vec along = {0, 0}, base, e;
    bool on_line = false;
    for (int i = 0; i < done->count; i++) {
        const struct contact_shape *shape = done->shapes[i];
        int sides = shape->kind == contact_line ? 1 : shape_sides(shape);
        for (int k = 0; k < sides && shape->link == link; k++) {
            if (!side_of(shape, k, &base, &e)) continue;
            double off = vec_cross(e, vec_sub(*p, base));
            if (fabs(off) > done->near) continue;
            if (!on_line) {
                *p = vec_sub(*p, vec_scale(off, vec_perp(e)));
                along = e;
                on_line = true;
                continue;
            }
            double slope = vec_cross(e, along);
            if (fabs(off) > done->near * fabs(slope)) continue;
            if (off != 0) *p = vec_sub(*p, vec_scale(off / slope, along));
            if (slope != 0) return;
        }
    }
}

static void level_shape(struct levelled *done, struct contact_shape *shape)
{
    const struct contact_shape *same = find_same(done, shape);
    for (int i = 0; i < shape->count; i++) {
        if (same)
            shape->corners[i] = same->corners[i];
        else if (!find_corner(done, shape->link, &shape->corners[i]))
            put_on_lines(done, shape->link, &shape->corners[i]);
    }
    if (!same) done->shapes[done->count++] = shape;
}

/* ---- corners inside other shapes */

/* The direction from corner k of a shape to the next one or the one before. */
static struct vec ray(const struct contact_shape *shape, int k, int step)
{
    struct vec d = vec_sub(shape->corners[(k + step + shape->count) % shape->count], shape->corners[k]);
    return vec_scale(1 / vec_norm(d), d);
}

static bool is_along(struct vec a, struct vec b, double sense)
{
    return fabs(vec_cross(a, b)) <= nine_digits && sense * vec_dot(a, b) > 0;
}

/* The sides at corner k of a shape that `other` covers at a corner of its own. A bar covers none. */
static unsigned char inner_at(const struct contact_shape *shape, int k, const struct contact_shape *other)
{
    unsigned char inner = 0;
    if (other->count < 3 || other->link != shape->link) return 0;
    for (int j = 0; j < other->count; j++) {
        if (vec_norm(vec_sub(other->corners[j], shape->corners[k])) > 0) continue;
        struct vec begin = ray(shape, k, 1), end = ray(shape, k, -1), others_begin = ray(other, j, 1),
                   others_end = ray(other, j, -1);
        if (is_along(begin, others_end, 1))
            inner |= inner_begin | (is_along(end, others_begin, -1) ? inner_flat : 0);
        if (is_along(end, others_begin, 1))
            inner |= inner_end | (is_along(begin, others_end, -1) ? inner_flat : 0);
    }
    return inner;
}

static bool set_inner(struct fbd_model *model, const struct levelled *done, struct contact_shape *shape)
{
    if (shape->kind != contact_corners || shape->count < 2) return true;
    const struct contact_shape *same = find_same(done, shape);
    if (same && same->inner) {
        shape->inner = same->inner;
        return true;
    }
    shape->inner = ARENA_ARRAY(&model->arena, (size_t)shape->count, unsigned char);
    if (!shape->inner) return false;
    for (int k = 0; k < shape->count; k++) {
        shape->inner[k] = 0;
        for (int i = 0; i < done->count; i++)
            if (done->shapes[i] != shape) shape->inner[k] |= inner_at(shape, k, done->shapes[i]);
    }
    return true;
}

bool meetings_level(struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    struct levelled done = {0};
    if (tree->meeting_count == 0) return true;
    done.shapes = ARENA_ARRAY(&model->arena, 2 * (size_t)tree->meeting_count, const struct contact_shape *);
    if (!done.shapes) return false;
    for (int i = 0; i < tree->meeting_count; i++)
        done.near = fmax(done.near, contact_level * tree->meetings[i].reach);
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < tree->meeting_count; i++)
            for (int k = 0; k < 2; k++) {
                struct contact_shape *shape = &tree->meetings[i].shape[k];
                if (tree->meetings[i].stop == 0 &&
                    shape->kind == (pass == 0 ? contact_line : contact_corners))
                    level_shape(&done, shape);
            }
    for (int i = 0; i < tree->meeting_count; i++)
        for (int k = 0; k < 2; k++)
            if (!set_inner(model, &done, &tree->meetings[i].shape[k])) return false;
    return true;
}
