/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/plates.h"

#include <math.h>
#include <string.h>

/* Add a point unless it coincides with an earlier one to round-off. */
static void add_point(struct plate *plate, struct vec point)
{
    for (size_t i = 0; i < plate->count; i++)
        if (vec_norm(vec_sub(plate->points[i], point)) <= 1e-9 * (vec_norm(point) + 1e-3)) return;
    if (plate->count < most_plate_points) plate->points[plate->count++] = point;
}

/* Add the point where a slot presses on the body, from the world. */
static void add_place(struct plate *plate, const fbd_view *view, const fbd_body *body, int b,
                      struct vec place)
{
    const fbd_pose pose = fbd_view_pose(view, (size_t)b);
    const struct vec back = {pose.cosine, -pose.sine};
    add_point(plate,
              vec_add(vec_of(body->pin), vec_turn(back, vec_sub(place, (struct vec){pose.x, pose.y}))));
}

static bool is_cam(const fbd_model *model, size_t connection)
{
    const fbd_path path = fbd_model_path(model, connection);
    return path.closed && path.side != 0;
}

static void add_couplings(struct plate *plate, const fbd_model *model, const fbd_view *view,
                          const fbd_body *body, int b)
{
    for (size_t i = 0; i < fbd_view_coupling_count(view); i++)
        for (size_t k = 0; k < fbd_view_coupling(view, i).end_count; k++) {
            const fbd_coupling_end end = fbd_view_coupling_end(view, i, k);
            if (end.body != b) continue;
            const size_t entry = fbd_view_coupling(view, i).entry;
            if (k == 1 && is_cam(model, entry)) {
                plate->cam = (int)entry;
                continue;
            }
            if (strcmp(fbd_view_coupling(view, i).kind, "rod") == 0) plate->rods++;
            if (end.radius > plate->wheel) plate->wheel = end.radius, plate->hub = vec_of(end.point);
            if (!(end.radius > 0)) add_point(plate, vec_of(end.point));
            if (strcmp(fbd_view_coupling(view, i).kind, "slot") == 0 && end.place_count > 0)
                add_place(plate, view, body, b, vec_of(end.places[0]));
        }
}

static bool has_pin(const fbd_body *body)
{
    return body->motion == FBD_MOTION_PIVOT || body->motion == FBD_MOTION_WELD;
}

/* Add the pins of the body and of its children. */
static void add_joints(struct plate *plate, const fbd_model *model, const fbd_body *body, int b)
{
    if (has_pin(body)) add_point(plate, vec_of(body->pin));
    for (size_t c = 0; c < fbd_model_body_count(model); c++) {
        const fbd_body child = fbd_model_body(model, c);
        if (child.carrier != b) continue;
        if (has_pin(&child)) add_point(plate, vec_of(child.joint));
        if (child.motion == FBD_MOTION_SLIDE) plate->rider = (int)c;
    }
}

/* Add the ends of springs and dampers. */
static void add_springs(struct plate *plate, const fbd_view *view, int b)
{
    for (size_t i = 0; i < fbd_view_spring_count(view); i++) {
        const fbd_spring spring = fbd_view_spring(view, i);
        if (isnan(spring.anchor[0])) continue;
        if (spring.body == b) add_point(plate, vec_of(spring.point));
        if (spring.partner == b) add_point(plate, vec_of(spring.anchor));
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

struct plate plate_of(const fbd_model *model, const fbd_view *view, size_t body)
{
    struct plate plate = {.rider = -1, .cam = -1};
    const fbd_body b = fbd_model_body(model, body);
    struct vec low, high;
    if (shapes_size(model, body, &low, &high) || b.motion == FBD_MOTION_PARTICLE ||
        b.motion == FBD_MOTION_TRACK)
        return plate;
    add_couplings(&plate, model, view, &b, (int)body);
    add_joints(&plate, model, &b, (int)body);
    add_springs(&plate, view, (int)body);
    if (b.motion == FBD_MOTION_SLIDE)
        plate.count = 0; /* drawn as a block, or as a wedge */
    else
        plate.rider = -1;
    put_in_order(&plate);
    return plate;
}
