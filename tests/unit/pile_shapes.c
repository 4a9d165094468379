/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "piles.h"

#include <math.h>

static const double touching = 1e-9, same_place = 1e-7;

static struct pile_shape rectangle(struct vec center, struct vec e, double a, double b)
{
    struct pile_shape shape = {.center = center};
    const int sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int k = 0; k < 4; k++)
        shape.corner[k] = vec_add(center, vec_add(vec_scale(sign[k][0] * a / 2, e),
                                                  vec_scale(sign[k][1] * b / 2, vec_perp(e))));
    return shape;
}

struct pile_shape pile_shape_of(const struct pile *pile, int body, const struct pile_motion *motion)
{
    const double far = 400, thick = 1;
    if (body == floor_of_pile) {
        struct vec e = {cos(pile->slope), sin(pile->slope)};
        return rectangle(vec_scale(-thick / 2, vec_perp(e)), e, far, thick);
    }
    const double *q = motion->q[body];
    struct vec center = {q[0], q[1]}, e = {cos(q[2]), sin(q[2])};
    if (!pile->disc[body]) return rectangle(center, e, pile->a[body], pile->b[body]);
    return (struct pile_shape){.disc = true, .center = center, .radius = pile->a[body] / 2};
}

/* ---- how far apart */

struct side {
    struct vec from, e, n; /* n outwards */
    double length;
};

static struct side side_of(const struct pile_shape *shape, int k)
{
    struct vec d = vec_sub(shape->corner[(k + 1) % 4], shape->corner[k]);
    double length = vec_norm(d);
    struct vec e = vec_scale(1 / length, d);
    return (struct side){shape->corner[k], e, vec_scale(-1, vec_perp(e)), length};
}

static double over(const struct side *side, struct vec p)
{
    return vec_dot(side->n, vec_sub(p, side->from));
}

/* The widest gap that a side of A has to all of B. */
static double apart_by_sides(const struct pile_shape *A, const struct pile_shape *B)
{
    double most = -HUGE_VAL;
    for (int k = 0; k < 4; k++) {
        struct side side = side_of(A, k);
        double least = HUGE_VAL;
        for (int i = 0; i < 4; i++) least = fmin(least, over(&side, B->corner[i]));
        most = fmax(most, least);
    }
    return most;
}

/* The point of a rectangle's rim that is nearest to p; whether p is within. */
static struct vec nearest_of(const struct pile_shape *shape, struct vec p, bool *within, bool *at_corner)
{
    double least = HUGE_VAL;
    struct vec nearest = p;
    *within = true;
    for (int k = 0; k < 4; k++) {
        struct side side = side_of(shape, k);
        double along = vec_dot(side.e, vec_sub(p, side.from));
        double inside = fmin(fmax(along, 0), side.length);
        struct vec at = vec_add(side.from, vec_scale(inside, side.e));
        double distance = vec_norm(vec_sub(p, at));
        *within &= over(&side, p) <= 0;
        if (distance >= least) continue;
        least = distance;
        nearest = at;
        *at_corner = inside != along;
    }
    return nearest;
}

double pile_apart(const struct pile_shape *A, const struct pile_shape *B)
{
    if (A->disc && B->disc) return vec_norm(vec_sub(A->center, B->center)) - A->radius - B->radius;
    if (!A->disc && !B->disc) return fmax(apart_by_sides(A, B), apart_by_sides(B, A));
    const struct pile_shape *disc = A->disc ? A : B, *box = A->disc ? B : A;
    bool within, at_corner;
    struct vec at = nearest_of(box, disc->center, &within, &at_corner);
    double distance = vec_norm(vec_sub(disc->center, at));
    return (within ? -distance : distance) - disc->radius;
}

/* ---- where they touch */

struct list {
    struct pile_touch *touches;
    int count;
    bool unclear;
};

static void add(struct list *list, struct pile_touch touch)
{
    for (int i = 0; i < list->count; i++) {
        const struct pile_touch *other = &list->touches[i];
        bool same = (other->body[0] == touch.body[0] && other->body[1] == touch.body[1]) ||
                    (other->body[0] == touch.body[1] && other->body[1] == touch.body[0]);
        if (same && vec_norm(vec_sub(other->at, touch.at)) <= same_place) return;
    }
    if (list->count == most_touches)
        list->unclear = true;
    else
        list->touches[list->count++] = touch;
}

/* Corners of A on sides of B. */
static void corners_on_sides(struct list *list, int a, const struct pile_shape *A, int b,
                             const struct pile_shape *B)
{
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) {
            struct side side = side_of(B, k);
            struct vec p = A->corner[i];
            double along = vec_dot(side.e, vec_sub(p, side.from));
            if (fabs(over(&side, p)) > touching || along < -same_place || along > side.length + same_place)
                continue;
            list->unclear |= along < same_place || along > side.length - same_place;
            add(list, (struct pile_touch){{a, b}, p, side.n, {p, p}, 0});
        }
}

static void disc_on_box(struct list *list, int a, const struct pile_shape *disc, int b,
                        const struct pile_shape *box)
{
    bool within, at_corner;
    struct vec at = nearest_of(box, disc->center, &within, &at_corner), d = vec_sub(disc->center, at);
    if (fabs(vec_norm(d) - disc->radius) > touching) return;
    struct vec n = vec_scale(1 / vec_norm(d), d), foot = at_corner ? at : disc->center;
    add(list, (struct pile_touch){{a, b}, at, n, {disc->center, foot}, at_corner ? disc->radius : 0});
}

static void find_between(struct list *list, int a, const struct pile_shape *A, int b,
                         const struct pile_shape *B)
{
    if (pile_apart(A, B) > touching) return;
    if (!A->disc && !B->disc) {
        corners_on_sides(list, a, A, b, B);
        corners_on_sides(list, b, B, a, A);
    } else if (A->disc && B->disc) {
        struct vec d = vec_sub(A->center, B->center), n = vec_scale(1 / vec_norm(d), d);
        struct vec at = vec_sub(A->center, vec_scale(A->radius, n));
        add(list, (struct pile_touch){{a, b}, at, n, {A->center, B->center}, A->radius + B->radius});
    } else if (A->disc) {
        disc_on_box(list, a, A, b, B);
    } else {
        disc_on_box(list, b, B, a, A);
    }
}

int pile_find_touches(const struct pile *pile, const struct pile_motion *motion, struct pile_touch *touches)
{
    struct list list = {.touches = touches};
    for (int i = 0; i < pile->count; i++)
        for (int j = floor_of_pile; j < i; j++) {
            struct pile_shape A = pile_shape_of(pile, i, motion), B = pile_shape_of(pile, j, motion);
            find_between(&list, i, &A, j, &B);
        }
    return list.unclear ? -1 : list.count;
}
