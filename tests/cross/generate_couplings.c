/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random couplings that fit where the bodies are: points are put where they have to be, wheels onto their
 * lines, axes at the distance of their radii.
 */
#include <stdio.h>
#include <string.h>

#include "generate_parts.h"

static const double pi = 3.141592653589793;

struct coupling *add_coupling(struct scene *scene, enum coupling_kind kind)
{
    static const char *const names[] = {"spring", "damper", "pin",  "rod",  "rope",
                                        "gear",   "rack",   "roll", "belt", "slot"};
    struct coupling *coupling = &scene->coupling[scene->coupling_count];
    memset(coupling, 0, sizeof *coupling);
    coupling->kind = kind;
    coupling->count = 2;
    coupling->line = -1;
    snprintf(coupling->name, sizeof coupling->name, "%s%d", names[kind], scene->coupling_count++);
    return coupling;
}

struct vec2 world_of(const struct absolute *absolute, int b, struct vec2 point)
{
    struct place place = point_of(absolute, b, point);
    return (struct vec2){place.x.u, place.y.u};
}

struct vec2 local_of(const struct absolute *absolute, int b, struct vec2 world)
{
    if (b < 0) return world;
    double x = world.x - absolute->x[3 * b], y = world.y - absolute->x[3 * b + 1];
    double c = absolute->pose[b].c.u, s = absolute->pose[b].s.u;
    return (struct vec2){absolute->mass[b].G.x + c * x + s * y, absolute->mass[b].G.y - s * x + c * y};
}

void start(struct absolute *absolute, const struct scene *scene)
{
    struct scene *bare = (struct scene *)scene;
    int couplings = scene->coupling_count;
    bare->coupling_count = 0;
    absolute_start(absolute, scene);
    bare->coupling_count = couplings;
}

/* ---- ends */

struct end random_end(struct random *random, struct scene *scene, int b)
{
    struct end end = {.body = b, .at = {.point = at_G}};
    if (b < 0) {
        end.at = (struct spot){at_pair, {random_between(random, -3, 3), random_between(random, -3, 3)}};
    } else if (random_chance(random, 0.7)) {
        end.at.point = random_point(random, &scene->body[b]);
    }
    return end;
}

int other_than(struct random *random, const struct scene *scene, int b)
{
    int other = random_below(random, scene->body_count + 1) - 1;
    return other == b ? (b == 0 ? -1 : b - 1) : other;
}

struct vec2 end_world(const struct absolute *absolute, const struct end *end)
{
    if (end->body < 0) return end->at.where;
    return world_of(absolute, end->body, spot_of(&absolute->scene->body[end->body], &end->at));
}

static void add_between(struct random *random, struct scene *scene, enum coupling_kind kind)
{
    struct absolute absolute;
    int b = random_below(random, scene->body_count);
    struct end one = random_end(random, scene, b),
               two = random_end(random, scene, other_than(random, scene, b));
    if (kind == pin && two.body >= 0 && scene->body[two.body].point_count == most_points) return;
    start(&absolute, scene);
    struct vec2 p = end_world(&absolute, &one), q = end_world(&absolute, &two);
    if (kind != pin && hypot(p.x - q.x, p.y - q.y) < 0.3) return;
    struct coupling *coupling = add_coupling(scene, kind);
    if (kind == pin) {
        struct body *body = &scene->body[two.body < 0 ? 0 : two.body];
        two.at = (struct spot){at_pair, p};
        if (two.body >= 0) {
            two.at.point = body->point_count;
            body->points[body->point_count++] = local_of(&absolute, two.body, p);
        }
    }
    coupling->end[0] = one;
    coupling->end[1] = two;
    if (random_chance(random, 0.5)) {
        coupling->end[0] = two;
        coupling->end[1] = one;
    }
    if (kind == spring_of_two) coupling->stiffness = random_between(random, 1, 20);
    if (kind == spring_of_two) coupling->free_length = random_between(random, 0, 2);
    coupling->coefficient = kind == damper_of_two ? random_between(random, 0.2, 2) : 0;
    if (kind == rod && random_chance(random, 0.5)) coupling->length = hypot(p.x - q.x, p.y - q.y);
}

/* ---- gears and racks */

/* A frame for both axes: the ground, or a body with room on it. */
static int random_base(struct random *random, const struct scene *scene)
{
    return random_chance(random, 0.5) ? -1 : random_below(random, scene->body_count);
}

static struct body *add_wheel(struct random *random, struct scene *scene, int on, struct vec2 at,
                              double radius)
{
    struct body *body = random_body(random, scene, pivot, on);
    random_disc(random, body, radius);
    body->at = (struct spot){at_pair, at};
    body->point = (struct spot){.point = at_origin};
    return body;
}

static void add_gear(struct random *random, struct scene *scene)
{
    if (scene->body_count + 2 > most_bodies) return;
    int base = random_base(random, scene);
    bool inside = random_chance(random, 0.3);
    double r1 = random_between(random, 0.1, 0.4),
           r2 = random_between(random, inside ? 0.6 : 0.1, inside ? 1.2 : 0.5);
    double apart = inside ? r2 - r1 : r1 + r2, angle = random_between(random, -pi, pi);
    struct vec2 at = {random_between(random, -1, 1), random_between(random, -1, 1)};
    int first = scene->body_count;
    add_wheel(random, scene, base, at, r1);
    /* Beside each other on one base, or the second on an arm about the axis of the first. */
    int arm = base;
    struct vec2 there = {at.x + apart * cos(angle), at.y + apart * sin(angle)};
    if (random_chance(random, 0.4) && scene->body_count + 2 <= most_bodies) {
        struct body *body = random_body(random, scene, pivot, base);
        body->at = (struct spot){at_pair, at};
        body->point = (struct spot){.point = at_origin};
        arm = scene->body_count - 1;
        there = (struct vec2){apart * cos(angle), apart * sin(angle)};
    }
    add_wheel(random, scene, arm, there, r2);
    struct coupling *coupling = add_coupling(scene, gear);
    coupling->end[0] = (struct end){.body = first, .at = {.point = at_G}};
    coupling->end[1] = (struct end){.body = scene->body_count - 1, .at = {.point = at_G}};
    coupling->inside = inside;
    if (random_chance(random, 0.5)) {
        coupling->radius[0] = r1;
        coupling->radius[1] = r2;
    }
}

/* ---- belts */

/* A disc on an axis of its own, or welded to what is on it. */
static int add_belt_disc(struct random *random, struct scene *scene, int on, struct vec2 at, double radius)
{
    add_wheel(random, scene, on, at, radius);
    if (scene->body_count == most_bodies || random_chance(random, 0.7)) return scene->body_count - 1;
    struct body *body = random_body(random, scene, weld, scene->body_count - 1);
    random_disc(random, body, radius);
    body->at = (struct spot){at_pair, {0, 0}};
    body->point = (struct spot){.point = at_origin};
    return scene->body_count - 1;
}

/* What pulls the axes apart, whatever else acts. */
static void add_pull(struct random *random, struct body *carriage)
{
    struct load *load = &carriage->load[carriage->load_count++];
    *load = (struct load){.kind = applied, .form = along_slide, .name = "pull", .at = {.point = at_G}};
    load->value = constant_formula(dim_force, random_between(random, 200, 600));
}

/* Both discs on one base, at a distance that they keep, or the second on a carriage that is pulled away. */
static void add_belt(struct random *random, struct scene *scene)
{
    if (scene->body_count + 5 > most_bodies) return;
    int base = random_base(random, scene), on = base;
    bool crossed = random_chance(random, 0.4), carried = random_chance(random, 0.4);
    double r1 = random_between(random, 0.1, 0.4), r2 = random_between(random, 0.1, 0.4);
    double d = r1 + r2 + random_between(random, 0.2, 1.5), angle = random_between(random, -pi, pi);
    struct vec2 at = {random_between(random, -1, 1), random_between(random, -1, 1)};
    struct vec2 there = {at.x + d * cos(angle), at.y + d * sin(angle)};
    int first = add_belt_disc(random, scene, base, at, r1);
    if (carried) {
        struct body *carriage = random_body(random, scene, slide, base);
        on = scene->body_count - 1;
        carriage->at = (struct spot){at_pair, there};
        carriage->point = (struct spot){.point = at_origin};
        carriage->along = angle;
        carriage->q[0] = random_between(random, 0, 1);
        there = (struct vec2){0, 0};
        add_pull(random, carriage);
    }
    int second = add_belt_disc(random, scene, on, there, r2);
    struct coupling *coupling = add_coupling(scene, belt);
    coupling->end[0] = (struct end){.body = first, .at = {.point = at_G}};
    coupling->end[1] = (struct end){.body = second, .at = {.point = at_G}};
    coupling->crossed = crossed;
    if (!carried) coupling->tension = random_between(random, 100, 300);
    if (random_chance(random, 0.5)) {
        coupling->radius[0] = r1;
        coupling->radius[1] = r2;
    }
}

/* A rack that slides on the base, and a pinion on the base beside its line, on either side. */
static void add_rack(struct random *random, struct scene *scene)
{
    if (scene->body_count + 2 > most_bodies) return;
    int base = random_base(random, scene);
    double radius = random_between(random, 0.1, 0.5), side = random_chance(random, 0.5) ? 1 : -1;
    struct body *bar = random_body(random, scene, slide, base);
    int rack_body = scene->body_count - 1;
    bar->at = (struct spot){at_pair, {random_between(random, -1, 1), random_between(random, -1, 1)}};
    double c = cos(bar->along), s = sin(bar->along), far = random_between(random, -1, 1);
    struct vec2 at = {bar->at.where.x + far * c - side * radius * s,
                      bar->at.where.y + far * s + side * radius * c};
    add_wheel(random, scene, base, at, radius);
    struct coupling *coupling = add_coupling(scene, rack);
    coupling->end[0] = (struct end){.body = scene->body_count - 1, .at = {.point = at_G}};
    coupling->end[1] = (struct end){.body = rack_body, .at = {.point = at_G}};
    if (random_chance(random, 0.5)) coupling->radius[0] = radius;
}

/* ---- rolling */

void add_friction(struct random *random, struct coupling *coupling, const struct taste *taste)
{
    if (!taste->frictions || random_chance(random, 0.4)) return;
    double kinetic = random_between(random, 0.1, 0.5);
    coupling->has_friction = true;
    coupling->mu_k = constant_formula(dim_number, kinetic);
    coupling->mu_s = constant_formula(dim_number, kinetic + random_between(random, 0, 0.2));
}

/* A free wheel beside a line of the ground, or the x axis of a body. */
void add_roll(struct random *random, struct scene *scene, const struct taste *taste)
{
    if (scene->body_count + 1 > most_bodies || scene->line_count == most_lines) return;
    int base = random_chance(random, 0.5) ? -1 : random_below(random, scene->body_count);
    double radius = random_between(random, 0.1, 0.5);
    struct body *body = random_body(random, scene, planar, -1);
    int wheel = scene->body_count - 1;
    random_disc(random, body, radius);
    struct coupling *coupling = add_coupling(scene, roll);
    coupling->end[0] = (struct end){.body = wheel, .at = {.point = at_G}};
    coupling->end[1] = (struct end){.body = base, .at = {.point = at_origin}};
    if (random_chance(random, 0.5)) coupling->radius[0] = radius;
    add_friction(random, coupling, taste);
    struct absolute absolute;
    double along = 0, far = random_between(random, -1, 1), side = random_chance(random, 0.7) ? 1 : -1;
    struct vec2 through = {0, 0};
    if (base < 0) {
        struct line *line = &scene->line[scene->line_count];
        line->along = along = random_between(random, -0.6, 0.6);
        line->through = through = (struct vec2){random_between(random, -1, 1), random_between(random, -1, 1)};
        coupling->line = scene->line_count++;
    }
    start(&absolute, scene);
    struct place e = direction_of(&absolute, base, along), O = point_of(&absolute, base, through);
    struct vec2 centre = {0, 0};
    if (random_chance(random, 0.5) && body->point_count < most_points) {
        /* The circle about another point: the wheel is eccentric, but not so much that friction jams it. */
        double off = random_between(random, 0, 0.5 * radius), angle = random_between(random, -pi, pi);
        coupling->centered = true;
        coupling->radius[0] = radius;
        coupling->end[0].at.point = body->point_count;
        body->points[body->point_count++] = (struct vec2){off * cos(angle), off * sin(angle)};
        centre = turned(spot_of(body, &coupling->end[0].at), body->q[2]);
    }
    body->q[0] = O.x.u + far * e.x.u - side * radius * e.y.u - centre.x;
    body->q[1] = O.y.u + far * e.y.u + side * radius * e.x.u - centre.y;
}

/* What the scene is about, four times out of five. */
static int kind_of(struct random *random, enum focus focus)
{
    static const int kinds[focus_count][2] = {
        [of_slots] = {11, 12}, [of_windings] = {5, 16}, [of_rolls] = {9, 9}, [of_spools] = {15, 15}};
    int any = random_below(random, 17);
    bool about = kinds[focus][0] > 0 && random_chance(random, 0.8);
    return about ? kinds[focus][random_below(random, 2)] : any;
}

void random_coupling(struct random *random, struct scene *scene, const struct taste *taste)
{
    if (scene->coupling_count == most_couplings) return;
    switch (kind_of(random, taste->focus)) {
    case 0: add_between(random, scene, spring_of_two); break;
    case 1: add_between(random, scene, damper_of_two); break;
    case 2:
    case 3: add_between(random, scene, pin); break;
    case 4: add_between(random, scene, rod); break;
    case 5:
    case 6: add_rope(random, scene); break;
    case 7: add_gear(random, scene); break;
    case 8: add_rack(random, scene); break;
    case 9: add_roll(random, scene, taste); break;
    case 10: add_belt(random, scene); break;
    case 11:
    case 12: add_slot(random, scene, taste); break;
    case 13:
    case 14: add_capstan(random, scene); break;
    case 15: add_spool(random, scene, taste); break;
    case 16: add_steps(random, scene); break;
    }
}
