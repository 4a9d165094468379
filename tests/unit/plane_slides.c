/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points on slides: of the ground, joined by ropes, or one on the other. q are places in the world.
 */
#include "plane.h"

static void draw_slide(struct random_numbers *numbers, struct body *slide)
{
    slide->m = exp(random_between(numbers, -1, 1));
    slide->q[0] = random_between(numbers, -0.3, 0.3);
    slide->v[0] = chance(numbers, 0.2) ? 0 : random_between(numbers, -2, 2);
    draw_stops(numbers, slide, 0.5, true);
    slide->push[0] = draw_push(numbers, slide->m * 8);
    slide->spring = chance(numbers, 0.3) ? slide->m * random_between(numbers, 1, 50) : 0;
    slide->neutral = random_between(numbers, -0.3, 0.3);
    slide->damper = chance(numbers, 0.2) ? slide->m * random_between(numbers, 0, 2) : 0;
    slide->rub = chance(numbers, 0.7) ? random_between(numbers, 0.02, 0.5) : 0;
    slide->rub_speed = slide->rub > 0 && chance(numbers, 0.2) ? random_between(numbers, -1, 1) : 0;
}

static void draw_weights(struct random_numbers *numbers, struct scene *scene)
{
    scene->count = 2 + chance(numbers, 0.4);
    for (int i = 0; i < scene->count; i++) {
        struct body *slide = &scene->body[i];
        draw_slide(numbers, slide);
        slide->rub /= 2; /* ropes across rough slides lock themselves, and move as well */
        slide->on = -1;
        slide->along = chance(numbers, 0.4) ? acos(0) : random_between(numbers, -0.8, 0.8);
        slide->through[0] = 2.0 * i;
    }
    for (int i = 0; i + 1 < scene->count; i++) {
        struct rope *rope = &scene->rope[scene->ropes++];
        double now = 0;
        *rope = (struct rope){i,
                              i + 1,
                              {2 * i + 1 + random_between(numbers, -1, 1), random_between(numbers, 1, 2)},
                              0};
        for (int end = i; end < i + 2; end++) {
            const struct body *slide = &scene->body[end];
            now += hypot(slide->through[0] + slide->q[0] * cos(slide->along) - rope->at[0],
                         slide->q[0] * sin(slide->along) - rope->at[1]);
        }
        rope->length = now + random_between(numbers, 0.01, 0.3);
    }
}

static void draw_stack(struct random_numbers *numbers, struct scene *scene)
{
    scene->count = 2 + chance(numbers, 0.4);
    for (int i = 0; i < scene->count; i++) {
        struct body *slide = &scene->body[i];
        draw_slide(numbers, slide);
        slide->on = i == 2 && chance(numbers, 0.5) ? 0 : i - 1;
        slide->along = chance(numbers, 0.4) ? 0 : random_between(numbers, -0.6, 0.6);
    }
}

static double angle_of(const struct scene *scene, int i)
{
    const struct body *slide = &scene->body[i];
    return slide->along + (slide->on < 0 ? 0 : angle_of(scene, slide->on));
}

static void write_slides(const struct scene *scene, struct written *text)
{
    if (scene->ropes) add(text, "ground:\n  points:\n");
    for (int j = 0; j < scene->ropes; j++)
        add(text, "    P%d: [%.17g, %.17g]\n", j, scene->rope[j].at[0], scene->rope[j].at[1]);
    add(text, "bodies:\n");
    for (int i = 0; i < scene->count; i++) {
        const struct body *slide = &scene->body[i];
        add(text, "  b%d:\n    mass: %.17g\n    motion: {slide: {along: %.17g", i, slide->m, slide->along);
        if (slide->on >= 0) add(text, ", on: b%d", slide->on);
        if (slide->on < 0) add(text, ", through: [%.17g, 0]", slide->through[0]);
        add_stops(text, slide);
        add(text, "}}\n    initial: {x: %.17g, v: %.17g}\n    forces:\n      - gravity\n", slide->q[0],
            slide->v[0]);
        add(text, "      - normal: {two_sided: true}\n      - applied: {name: push, angle: %.17g, value: ",
            angle_of(scene, i));
        add_push(text, &slide->push[0]);
        add(text, "}\n");
        if (slide->spring > 0)
            add(text, "      - spring: {stiffness: %.17g, neutral: %.17g}\n", slide->spring, slide->neutral);
        if (slide->damper > 0) add(text, "      - damper: {coefficient: %.17g}\n", slide->damper);
        if (slide->rub > 0 || slide->lists_zero)
            add(text, "      - friction: {coefficient: %.17g, surface_speed: %.17g}\n", slide->rub,
                slide->rub_speed);
    }
    if (scene->ropes) add(text, "couplings:\n");
    for (int j = 0; j < scene->ropes; j++)
        add(text, "  - rope: {through: [b%d, ground.P%d, b%d], length: %.17g}\n", scene->rope[j].body, j,
            scene->rope[j].other, scene->rope[j].length);
}

/* Along the slide of body i, against what it is on: a place from where that one is, or a velocity. */
static double along_slide(const struct scene *scene, int i, const double *q)
{
    const struct body *slide = &scene->body[i];
    double c = cos(angle_of(scene, i)), s = sin(angle_of(scene, i)), on[2] = {0, 0};
    if (slide->on >= 0) memcpy(on, q + 3 * slide->on, sizeof on);
    return c * (q[3 * i] - on[0]) + s * (q[3 * i + 1] - on[1]);
}

/* The coordinate of the model. */
static double place_of(const struct scene *scene, int i, const double *q)
{
    const struct body *slide = &scene->body[i];
    return along_slide(scene, i, q) - (slide->on < 0 ? cos(angle_of(scene, i)) * slide->through[0] : 0);
}

static void forces_slides(const void *context, double t, const double *q, const double *v, double *f)
{
    const struct scene *scene = context;
    for (int i = 0; i < 3 * scene->count; i++) f[i] = 0;
    for (int i = 0; i < scene->count; i++) {
        const struct body *slide = &scene->body[i];
        double c = cos(angle_of(scene, i)), s = sin(angle_of(scene, i)), P = push_at(&slide->push[0], t),
               x = place_of(scene, i, q),
               pair = -slide->spring * (x - slide->neutral) - slide->damper * along_slide(scene, i, v);
        f[3 * i] += c * (pair + P);
        f[3 * i + 1] += s * (pair + P) - slide->m * plane_g;
        if (slide->on >= 0) f[3 * slide->on] -= c * pair, f[3 * slide->on + 1] -= s * pair;
    }
}

static void solve_slides(const void *context, const double *q, double *b)
{
    const struct scene *scene = context;
    (void)q;
    for (int i = 0; i < scene->count; i++)
        for (int k = 0; k < 3; k++) b[3 * i + k] = k < 2 ? b[3 * i + k] / scene->body[i].m : 0;
}

static void along_row(const struct scene *scene, int i, double c, double s, struct moreau_row *row)
{
    int on = scene->body[i].on;
    row->w[3 * i] = c;
    row->w[3 * i + 1] = s;
    if (on >= 0) row->w[3 * on] = -c, row->w[3 * on + 1] = -s;
}

static void rows_slides(const void *context, double t, const double *q, struct moreau_rows *rows)
{
    const struct scene *scene = context;
    (void)t;
    for (int i = 0; i < scene->count; i++) {
        const struct body *slide = &scene->body[i];
        double c = cos(angle_of(scene, i)), s = sin(angle_of(scene, i)), x = place_of(scene, i, q);
        along_row(scene, i, -s, c, row_of(rows, moreau_equal));
        for (int side = 0; side < 3; side++) {
            if (side == 0 && slide->rub == 0) continue;
            if (side == 1 && !(slide->has_min && x <= slide->min)) continue;
            if (side == 2 && !(slide->has_max && x >= slide->max)) continue;
            struct moreau_row *row = row_of(rows, side ? moreau_gap : moreau_rub);
            along_row(scene, i, side == 2 ? -c : c, side == 2 ? -s : s, row);
            row->e = slide->e;
            row->mu = slide->rub;
            row->aim = side ? 0 : slide->rub_speed;
            if (side == 0) row->normal = rows->count - 2;
        }
    }
    rope_rows(scene, q, rows);
}

static void start(const struct scene *scene, double *q, double *v)
{
    for (int i = 0; i < scene->count; i++) {
        const struct body *slide = &scene->body[i];
        double c = cos(angle_of(scene, i)), s = sin(angle_of(scene, i));
        int on = slide->on;
        q[3 * i] = c * slide->q[0] + (on < 0 ? slide->through[0] : q[3 * on]);
        q[3 * i + 1] = s * slide->q[0] + (on < 0 ? 0 : q[3 * on + 1]);
        v[3 * i] = c * slide->v[0] + (on < 0 ? 0 : v[3 * on]);
        v[3 * i + 1] = s * slide->v[0] + (on < 0 ? 0 : v[3 * on + 1]);
        q[3 * i + 2] = v[3 * i + 2] = 0;
    }
}

static void name_values(const struct scene *scene, const double *q, const double *v,
                        struct stepped_values *named)
{
    for (int i = 0; i < scene->count; i++) {
        stepped_name(named, "b", i, "x", place_of(scene, i, q), 1);
        stepped_name(named, "b", i, "v", along_slide(scene, i, v), 0.1);
    }
}

const struct kind plane_weights = {
    "weights", draw_weights, write_slides, forces_slides, solve_slides, rows_slides, 3, start, name_values};
const struct kind plane_stack = {"stack",     draw_stack, write_slides, forces_slides, solve_slides,
                                 rows_slides, 3,          start,        name_values};
