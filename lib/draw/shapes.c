/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/shapes.h"

static double reach_of(const fbd_shape *shape, struct vec center, struct vec along)
{
    double middle = vec_dot(vec_sub(vec_of(shape->center), center), along), most = middle;
    if (shape->kind == FBD_SHAPE_CIRCLE) return middle + shape->radius;
    for (size_t i = 0; i < shape->corner_count; i++)
        most = fmax(most, vec_dot(vec_sub(vec_of(shape->corners[i]), center), along));
    return most;
}

double shapes_reach(const fbd_model *model, size_t body, struct vec center, struct vec along)
{
    double most = 0;
    for (size_t i = 0; i < fbd_model_shape_count(model, body); i++) {
        const fbd_shape shape = fbd_model_shape(model, body, i);
        if (!shape.hole) most = fmax(most, reach_of(&shape, center, along));
    }
    return most;
}

bool shapes_size(const fbd_model *model, size_t body, struct vec *low, struct vec *high)
{
    const struct vec right = {1, 0}, up = {0, 1}, left = {-1, 0}, down = {0, -1}, zero = {0, 0};
    *low = (struct vec){HUGE_VAL, HUGE_VAL};
    *high = (struct vec){-HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < fbd_model_shape_count(model, body); i++) {
        const fbd_shape shape = fbd_model_shape(model, body, i);
        if (shape.hole) continue;
        *low = (struct vec){fmin(low->x, -reach_of(&shape, zero, left)),
                            fmin(low->y, -reach_of(&shape, zero, down))};
        *high = (struct vec){fmax(high->x, reach_of(&shape, zero, right)),
                             fmax(high->y, reach_of(&shape, zero, up))};
    }
    return high->x > low->x || high->y > low->y;
}
