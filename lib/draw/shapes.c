/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/shapes.h"

static double extent(const fbd_model *model, size_t body, struct vec from, struct vec along)
{
    return fbd_model_extent(model, body, (double[]){from.x, from.y}, (double[]){along.x, along.y});
}

double shapes_reach(const fbd_model *model, size_t body, struct vec center, struct vec along)
{
    return fmax(0, extent(model, body, center, along));
}

bool shapes_size(const fbd_model *model, size_t body, struct vec *low, struct vec *high)
{
    const struct vec right = {1, 0}, up = {0, 1}, left = {-1, 0}, down = {0, -1}, zero = {0, 0};
    *low = (struct vec){-extent(model, body, zero, left), -extent(model, body, zero, down)};
    *high = (struct vec){extent(model, body, zero, right), extent(model, body, zero, up)};
    return high->x > low->x || high->y > low->y;
}
