/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random couplings that fit where the bodies are: points are put where they have to be, wheels onto their
 * lines, axes at the distance of their radii.
 */
#include <stdio.h>
#include <string.h>

#include "generate.h"
#include "variants.h"

static const double pi = 3.141592653589793;

static struct coupling *add_coupling(struct scene *scene, enum coupling_kind kind)
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

static struct vec2 world_of(const struct absolute *absolute, int b, struct vec2 point)
{
    struct place place = point_of(absolute, b, point);
    return (struct vec2){place.x.u, place.y.u};
}

/* A point of body b that is at a place in the world. */
static struct vec2 local_of(const struct absolute *absolute, int b, struct vec2 world)
{
    if (b < 0) return world;
    double x = world.x - absolute->x[3 * b], y = world.y - absolute->x[3 * b + 1];
    double c = absolute->pose[b].c.u, s = absolute->pose[b].s.u;
    return (struct vec2){absolute->mass[b].G.x + c * x + s * y, absolute->mass[b].G.y - s * x + c * y};
}

static void start(struct absolute *absolute, const struct scene *scene)
{
    struct scene *bare = (struct scene *)scene;
    int couplings = scene->coupling_count;
    bare->coupling_count = 0;
    absolute_start(absolute, scene);
    bare->coupling_count = couplings;
}

/* ---- ends */

static struct end random_end(struct random *random, struct scene *scene, int b)
{
    struct end end = {.body = b, .at = {.point = at_G}};
    if (b < 0) {
        end.at = (struct spot){at_pair, {random_between(random, -3, 3), random_between(random, -3, 3)}};
    } else if (random_chance(random, 0.7)) {
        end.at.point = random_point(random, &scene->body[b]);
    }
    return end;
}

/* Another body than `b`, or the ground. */
static int other_than(struct random *random, const struct scene *scene, int b)
{
    int other = random_below(random, scene->body_count + 1) - 1;
    return other == b ? (b == 0 ? -1 : b - 1) : other;
}

static struct vec2 end_world(const struct absolute *absolute, const struct end *end)
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

/* ---- ropes */

/* A disc on an axis in the world, to be a pulley. */
static int add_pulley(struct random *random, struct scene *scene)
{
    struct body *body = random_body(random, scene, pivot, -1);
    double radius = random_between(random, 0.1, 0.4);
    random_disc(random, body, radius);
    body->point = (struct spot){.point = at_origin};
    return scene->body_count - 1;
}

static bool far_apart(const struct absolute *absolute, const struct coupling *rope_between)
{
    struct vec2 p[most_ends];
    for (int k = 0; k < rope_between->count; k++) {
        p[k] = end_world(absolute, &rope_between->end[k]);
        if (k > 0 && hypot(p[k].x - p[k - 1].x, p[k].y - p[k - 1].y) < 0.9) return false;
    }
    for (int k = 1; k + 1 < rope_between->count; k++) {
        if (!rope_between->end[k].pulley && !rope_between->rubs) continue;
        /* Nearly straight over a pulley: on which side it runs would be a matter of rounding. */
        double ax = p[k].x - p[k - 1].x, ay = p[k].y - p[k - 1].y;
        double bx = p[k + 1].x - p[k].x, by = p[k + 1].y - p[k].y;
        if (fabs(ax * by - ay * bx) < 0.2 * hypot(ax, ay) * hypot(bx, by)) return false;
    }
    return true;
}

/* Round a disc at that end, where it is clear on which side. */
static void wind(struct random *random, const struct absolute *absolute, struct coupling *coupling, int k)
{
    struct end *end = &coupling->end[k], before = *end;
    const struct piece *piece = end->body < 0 ? NULL : round_piece(&absolute->scene->body[end->body]);
    double margin;
    end->wound = end->pulley = true;
    end->radius = random_between(random, 0.05, 0.4);
    if (piece && piece->size[0] < 0.4 && random_chance(random, 0.5)) end->radius = 0;
    end->side = (enum wound_side)random_below(random, 4);
    wound_turn(absolute, coupling, k, &margin);
    /* In the file the first of two ends at one place is wound first. */
    const struct end *first = &coupling->end[0];
    bool same = k > 0 && first->body == end->body && first->at.point == end->at.point && !first->wound;
    if (!(margin > 0.2) || same) *end = before;
}

/* Its length goes with the time, from what it is at the start; of a rope in pieces only by how much matters. */
static void reel(struct random *random, const struct absolute *absolute, struct coupling *coupling)
{
    coupling->reel = random_drive(random, dim_length);
    double length = straight_way(absolute, coupling) - formula_value(absolute, &coupling->reel);
    coupling->reel.summand[coupling->reel.count] = constant_formula(dim_length, length).summand[0];
    coupling->reel.count++;
    coupling->reels = true;
}

static void add_rope(struct random *random, struct scene *scene)
{
    int before = scene->body_count, count = 2 + random_below(random, 3);
    int pulley =
        count > 2 && before < most_bodies && random_chance(random, 0.6) ? add_pulley(random, scene) : -1;
    struct coupling *coupling = add_coupling(scene, rope);
    struct absolute absolute;
    coupling->count = count;
    int last = -2;
    bool moves = false;
    for (int k = 0; k < count; k++) {
        int b = random_below(random, before + 1) - 1;
        if (b == last || (k == 0 && b < 0)) b = b == 0 ? -1 : b < 0 ? 0 : b - 1;
        coupling->end[k] = random_end(random, scene, b);
        if (pulley >= 0 && k == count / 2)
            coupling->end[k] = (struct end){.body = pulley, .at = {.point = at_G}, .pulley = true};
        else if (k > 0 && k + 1 < count && b >= 0 && coupling->end[k].at.point == at_G)
            coupling->end[k].at.point = random_point(random, &scene->body[b]);
        last = coupling->end[k].body;
        moves |= last >= 0;
    }
    for (int k = 1; k < count; k++) moves &= coupling->end[k].body != coupling->end[k - 1].body;
    start(&absolute, scene);
    if (moves && far_apart(&absolute, coupling)) {
        for (int k = 0; k < count; k += count - 1)
            if (random_chance(random, 0.3)) wind(random, &absolute, coupling, k);
        if (random_chance(random, 0.2)) reel(random, &absolute, coupling);
        return;
    }
    scene->coupling_count--;
    scene->body_count = before;
}

/* Round a drum of the ground, or of a body, which may turn, far enough that it stays on it. */
static void add_capstan(struct random *random, struct scene *scene)
{
    struct coupling *coupling = add_coupling(scene, rope);
    struct absolute absolute;
    coupling->count = 3;
    for (int k = 0, last = -2; k < 3; k++) {
        int b = random_below(random, scene->body_count + 1) - 1;
        if (b == last || (k == 0 && b < 0)) b = b == 0 ? -1 : b < 0 ? 0 : b - 1;
        coupling->end[k] = random_end(random, scene, b);
        if (k == 1 && b >= 0) coupling->end[k].at.point = random_point(random, &scene->body[b]);
        last = b;
    }
    double kinetic = random_between(random, 0.05, 0.5);
    coupling->rubs = true;
    coupling->held = random_chance(random, 0.4);
    coupling->turns = random_chance(random, 0.3) ? 1 + random_below(random, 2) : 0;
    coupling->radius[0] = random_between(random, 0.05, 0.4);
    coupling->mu_k = constant_formula(dim_number, kinetic);
    coupling->mu_s = constant_formula(dim_number, kinetic + random_between(random, 0, 0.3));
    start(&absolute, scene);
    if (coupling->end[0].body == coupling->end[1].body || coupling->end[1].body == coupling->end[2].body ||
        !far_apart(&absolute, coupling))
        scene->coupling_count--;
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

static void add_friction(struct random *random, struct coupling *coupling, const struct taste *taste)
{
    if (!taste->frictions || random_chance(random, 0.4)) return;
    double kinetic = random_between(random, 0.1, 0.5);
    coupling->has_friction = true;
    coupling->mu_k = constant_formula(dim_number, kinetic);
    coupling->mu_s = constant_formula(dim_number, kinetic + random_between(random, 0, 0.2));
}

/* A free wheel beside a line of the ground, or the x axis of a body. */
static void add_roll(struct random *random, struct scene *scene, const struct taste *taste)
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

/* ---- slots: the point is put onto the curve, or its roller beside it */

static struct vec2 beside(const struct coupling *coupling, double p)
{
    struct place at = path_place(&coupling->path, ser(p), 0), d = path_place(&coupling->path, ser(p), 1);
    double off = coupling->side == left_side ? coupling->radius[0] : -coupling->radius[0];
    double speed = hypot(d.x.u, d.y.u);
    return (struct vec2){at.x.u - off * d.y.u / speed, at.y.u + off * d.x.u / speed};
}

static void add_slot(struct random *random, struct scene *scene)
{
    struct absolute absolute;
    int b = random_below(random, scene->body_count), base = other_than(random, scene, b);
    struct body *body = &scene->body[b];
    if (body->point_count == most_points) return;
    struct coupling *coupling = add_coupling(scene, slot);
    coupling->end[0] = (struct end){.body = b, .at = {.point = body->point_count}};
    coupling->end[1] = (struct end){.body = base, .at = {.point = at_origin}};
    if (base < 0)
        coupling->end[1].at =
            (struct spot){at_pair, {random_between(random, -1, 1), random_between(random, -1, 1)}};
    else if (random_chance(random, 0.5))
        coupling->end[1].at.point = random_point(random, &scene->body[base]);
    bool closed = random_chance(random, 0.5);
    coupling->path = random_path(random, closed);
    if (random_chance(random, 0.4))
        coupling->path =
            (struct path){.form = path_line, .along = random_between(random, -pi, pi), .from = -6, .to = 6};
    if (coupling->path.form == path_oval && !closed) coupling->path = random_path(random, true);
    coupling->one_sided = random_chance(random, 0.5);
    coupling->side = random_chance(random, 0.5) ? left_side : right_side;
    if (coupling->one_sided && random_chance(random, 0.5))
        coupling->radius[0] = random_between(random, 0.05, 0.25);
    start(&absolute, scene);
    double p =
        coupling->path.form == path_oval ? random_between(random, 0.3, 6) : random_between(random, -1, 1);
    struct vec2 r = beside(coupling, p);
    struct place e = direction_of(&absolute, base, 0);
    struct vec2 O = end_world(&absolute, &coupling->end[1]);
    struct vec2 P = {O.x + e.x.u * r.x - e.y.u * r.y, O.y + e.y.u * r.x + e.x.u * r.y};
    body->points[body->point_count++] = local_of(&absolute, b, P);
}

void random_coupling(struct random *random, struct scene *scene, const struct taste *taste)
{
    if (scene->coupling_count == most_couplings) return;
    switch (random_below(random, 15)) {
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
    case 12: add_slot(random, scene); break;
    case 13:
    case 14: add_capstan(random, scene); break;
    }
}
