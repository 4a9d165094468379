/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/plates.h"

#include <math.h>

#include "model/outline.h"
#include "model/tree.h"

static bool is_shapeless(const struct body *source)
{
    struct vec low, high;
    return !outline_size(source, &low, &high);
}

/* Add a point unless it coincides with an earlier one to round-off. */
static void add_point(struct plate *plate, struct vec point)
{
    for (size_t i = 0; i < plate->count; i++)
        if (vec_norm(vec_sub(plate->points[i], point)) <= 1e-9 * (vec_norm(point) + 1e-3)) return;
    if (plate->count < most_plate_points) plate->points[plate->count++] = point;
}

static struct vec place_on(const struct fbd_model *model, int b, const struct point *point)
{
    return point->kind == point_fixed ? point->where : model->bodies[b].inertia.G;
}

static void add_couplings(struct plate *plate, const struct fbd_model *model, int b)
{
    for (int i = 0; model->tree && i < model->tree->coupling_count; i++) {
        const struct coupling *coupling = &model->tree->couplings[i];
        const struct constraint *source = &model->scene->constraints[coupling->constraint];
        for (int k = 0; k < coupling->end_count; k++) {
            if (coupling->end[k].body != b) continue;
            struct vec place = place_on(model, b, &source->point[coupling->place + k]);
            bool circle = coupling->end[k].radius > 0;
            if (circle && coupling->end[k].radius > plate->wheel)
                plate->wheel = coupling->end[k].radius, plate->hub = place;
            if (!circle) add_point(plate, place);
        }
    }
}

/* Add the pins of the body and of its children, and ends of springs and dampers. */
static void add_joints(struct plate *plate, const struct fbd_model *model, int b)
{
    const struct model_body *body = &model->bodies[b];
    if (body->kind == motion_pivot || body->kind == motion_weld) add_point(plate, body->pin);
    for (size_t c = 0; c < model->body_count; c++) {
        const struct model_body *child = &model->bodies[c];
        if (child->parent == b && (child->kind == motion_pivot || child->kind == motion_weld))
            add_point(plate, child->origin);
        if (child->parent == b && child->kind == motion_slide) plate->rider = child;
    }
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (!load->linked) continue;
        if (load->body == b) add_point(plate, load->point);
        if (load->partner == b) add_point(plate, load->anchor);
    }
}

/* Sort by angle around their middle, so that the outline does not cross itself; insertion sort, since they
 * are few. */
static void put_in_order(struct plate *plate)
{
    struct vec middle = {0, 0};
    double angle[most_plate_points];
    for (size_t i = 0; i < plate->count; i++)
        middle = vec_add(middle, vec_scale(1.0 / (double)plate->count, plate->points[i]));
    for (size_t i = 0; i < plate->count; i++) {
        struct vec point = plate->points[i], arm = vec_sub(point, middle);
        double a = atan2(arm.y, arm.x);
        size_t k = i;
        for (; k > 0 && angle[k - 1] > a; k--) {
            angle[k] = angle[k - 1];
            plate->points[k] = plate->points[k - 1];
        }
        angle[k] = a;
        plate->points[k] = point;
    }
}

struct plate plate_of(const struct fbd_model *model, int body)
{
    struct plate plate = {0};
    const struct model_body *b = &model->bodies[body];
    if (!is_shapeless(b->source) || b->kind == motion_particle || b->kind == motion_track) return plate;
    add_couplings(&plate, model, body);
    add_joints(&plate, model, body);
    if (b->kind == motion_slide)
        plate.count = 0; /* drawn as a block, or as a wedge */
    else
        plate.rider = NULL;
    put_in_order(&plate);
    return plate;
}
