/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A place counts once, however many parts have a corner there.
 *
 *   - Corners that two to four parts of a body share strike a line, a polygon, the joint of two tiles, and a free body of
 *     several parts: one impact, that of Routh's diagram in small steps (impact_by_steps.h).
 *   - Boxes of parts move as the same boxes of one part.
 *   - Boxes of parts slide on boxes of parts, corners past corners, as Coulomb's law has it.
 *
 * FBD_DRAWS: times as many scenes; FBD_CORNERS_SEED begins elsewhere; FBD_CORNERS_SHOW prints the scenes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "assemblies.h"
#include "gallery.h"
#include "impact_by_steps.h"
#include "random_numbers.h"
#include "thorough.h"
#include "written.h"

static const double g = 9.81;

static uint64_t first_seed(void)
{
    return (uint64_t)number_of("FBD_CORNERS_SEED", 1897) * 1000003u;
}

static void show(const struct written *text)
{
    if (getenv("FBD_CORNERS_SHOW")) printf("%s\n", text->all);
}

/* ---- one impact */

enum ground { on_line, on_polygon, on_joint, on_joint_and_line, on_block, ground_count };

struct meeting_scene {
    struct assembly body, block;
    enum ground ground;
    int law;
    double e, mu, theta, omega, T; /* at the impact, which comes after T */
    struct vec v, u;               /* of G, and of the block */
    struct vec P;                  /* the corner, in the frame of the body */
};

static struct vec turned(double angle, struct vec p)
{
    double c = cos(angle), s = sin(angle);
    return (struct vec){c * p.x - s * p.y, s * p.x + c * p.y};
}

/* The position of a corner relative to the impact point at a time before the impact, without forces. */
static struct vec seen_before(const struct meeting_scene *scene, struct vec corner, double before)
{
    struct vec arm = turned(scene->theta, vec_sub(scene->body.G, scene->P));
    struct vec G = vec_sub(arm, vec_scale(before, vec_sub(scene->v, scene->u)));
    return vec_add(G, turned(scene->theta - scene->omega * before, vec_sub(corner, scene->body.G)));
}

/* Is P the only corner with an impact? */
static bool strikes_alone(const struct meeting_scene *scene)
{
    const double clear = 0.01;
    for (int k = 0; k <= 16; k++)
        for (int i = 0; i < scene->body.corner_count; i++) {
            struct vec d = vec_sub(scene->body.corner[i], scene->P);
            double y = seen_before(scene, scene->body.corner[i], scene->T * k / 16).y;
            if (vec_norm(d) > 0 ? y < clear : k > 0 && !(y > 0)) return false;
        }
    return true;
}

static bool draw_motion(struct random_numbers *numbers, struct meeting_scene *scene)
{
    const struct assembly *body = &scene->body;
    scene->theta = random_between(numbers, -3.14, 3.14);
    scene->omega = random_between(numbers, -5, 5);
    scene->v = (struct vec){random_between(numbers, -3, 3), random_between(numbers, -4, 1)};
    scene->u = scene->ground != on_block
                   ? (struct vec){0, 0}
                   : (struct vec){random_between(numbers, -1, 1), random_between(numbers, -1, 1)};
    scene->P = body->corner[0];
    for (int i = 1; i < body->corner_count; i++)
        if (turned(scene->theta, body->corner[i]).y < turned(scene->theta, scene->P).y)
            scene->P = body->corner[i];
    struct vec r = turned(scene->theta, vec_sub(scene->P, body->G));
    double approach = scene->u.y - scene->v.y - scene->omega * r.x;
    return approach > 0.1 && strikes_alone(scene); /* it does not graze */
}

static void draw_meeting(struct random_numbers *numbers, struct meeting_scene *scene)
{
    do {
        *scene = (struct meeting_scene){.ground = (enum ground)choose(numbers, ground_count)};
        assembly_draw(numbers, &scene->body);
        assembly_draw_block(numbers, &scene->block);
        scene->law = choose(numbers, 4);
        scene->e = random_perhaps(numbers, 0.7, 0, 1);
        scene->mu = random_perhaps(numbers, 0.85, 0, 0.9);
        scene->T = random_between(numbers, 0.01, 0.1);
    } while (!draw_motion(numbers, scene));
}

static void write_meeting(const struct meeting_scene *scene, struct written *text)
{
    static const char *const grounds[] = {
        "lines: {a: {along: 0}}", "polygons: {a: [[-2, -1], [2, -1], [2, 0], [-2, 0]]}",
        "polygons: {a: [[-2, -1], [0, -1], [0, 0], [-2, 0]], b: [[0, -1], [2, -1], [2, 0], [0, 0]]}",
        ("polygons: {a: [[-2, -1], [0, -1], [0, 0], [-2, 0]], b: [[0, -1], [2, -1], [2, 0], [0, 0]]}, "
         "lines: {c: {along: 0}}"),
        "lines: {unused: {along: 0}}"};
    static const char *const laws[] = {"stronge", "poisson", "newton", "moreau"};
    static const char *const with[] = {"ground.a", "ground.b", "ground.c"};
    static const int contacts[] = {1, 1, 2, 3, 1};
    struct vec O = seen_before(scene, (struct vec){0, 0}, scene->T), at = vec_scale(-scene->T, scene->u);
    double theta = scene->theta - scene->omega * scene->T;
    struct vec arm = turned(theta, scene->body.G),
               v = vec_sub(scene->v, vec_scale(scene->omega, vec_perp(arm)));
    O = vec_add(O, at);
    add(text, "fbd: 1\nground: {%s}\nbodies:\n", grounds[scene->ground]);
    add(text,
        "  body: {parts: {%s}, motion: planar, initial: {x: %.17g, y: %.17g, theta: %.17g, vx: %.17g, vy: "
        "%.17g, omega: "
        "%.17g}}\n",
        scene->body.parts.all, O.x, O.y, theta, v.x, v.y, scene->omega);
    if (scene->ground == on_block)
        add(text,
            "  block: {parts: {%s}, motion: planar, initial: {x: %.17g, y: %.17g, vx: %.17g, vy: %.17g}}\n",
            scene->block.parts.all, at.x, at.y, scene->u.x, scene->u.y);
    add(text, "contacts:\n");
    for (int i = 0; i < contacts[scene->ground]; i++)
        add(text, "  - {between: [body, %s], static: %.17g, restitution: %.17g, law: %s}\n",
            scene->ground == on_block ? "block" : with[i], scene->mu, scene->e, laws[scene->law]);
    add(text, "simulate: {until: %.17g}\n", scene->T + 1e-9);
}

/* Velocities of O, whose arm from G is r. */
static void check_body(struct checks *checks, struct trial *trial, const char *name, struct vec v,
                       double omega, struct vec r)
{
    const double tolerance = 1e-6; /* steps of the impact, and 1e-9 s after it */
    char what[32];
    struct vec O = vec_add(v, vec_scale(omega, vec_perp(r)));
    snprintf(what, sizeof what, "%s.vx", name);
    check_close(checks, what, trial_get(trial, what), O.x, tolerance);
    snprintf(what, sizeof what, "%s.vy", name);
    check_close(checks, what, trial_get(trial, what), O.y, tolerance);
    snprintf(what, sizeof what, "%s.omega", name);
    check_close(checks, what, trial_get(trial, what), omega, tolerance * (1 + 20));
}

static size_t count_of(struct trial *trial, fbd_event_kind kind)
{
    size_t count = fbd_simulation_event_count(trial->simulation), found = 0;
    for (size_t i = 0; i < count; i++) found += fbd_simulation_event(trial->simulation, i).kind == kind;
    return found;
}

static void check_meeting(struct checks *checks, uint64_t seed)
{
    struct random_numbers numbers = {seed};
    static struct meeting_scene scene;
    static struct written text;
    text.length = 0;
    draw_meeting(&numbers, &scene);
    write_meeting(&scene, &text);
    show(&text);
    struct trial trial = trial_parse(text.all);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    size_t failed = checks->failed;
    check_that(checks, "it ends", trial.outcome == FBD_DONE);
    check_that(checks, "one impact", count_of(&trial, FBD_EVENT_IMPACT) == 1);

    struct vec r = turned(scene.theta, vec_sub(scene.P, scene.body.G)), s = vec_scale(-1, scene.block.G);
    bool block = scene.ground == on_block;
    double w = 1 / scene.body.m, k = 1 / scene.body.I, W = block ? 1 / scene.block.m : 0,
           K = block ? 1 / scene.block.I : 0;
    struct vec v = vec_sub(vec_add(scene.v, vec_scale(scene.omega, vec_perp(r))), scene.u);
    struct point_by_steps point = {{w + W + k * r.x * r.x + K * s.x * s.x, -k * r.x * r.y - K * s.x * s.y,
                                    w + W + k * r.y * r.y + K * s.y * s.y},
                                   scene.mu,
                                   scene.e,
                                   (enum law_by_steps)scene.law};
    double both[2] = {v.y, v.x}, P[2];
    impact_by_steps(&point, both, P);
    struct vec p = {P[1], P[0]};
    double angle = scene.theta;
    check_body(checks, &trial, "body", vec_add(scene.v, vec_scale(w, p)), scene.omega + k * vec_cross(r, p),
               turned(angle, vec_scale(-1, scene.body.G)));
    if (block)
        check_body(checks, &trial, "block", vec_sub(scene.u, vec_scale(W, p)), -K * vec_cross(s, p), s);
    if (checks->failed > failed) printf("# seed %llu\n%s\n", (unsigned long long)seed, text.all);
    trial_close(&trial);
}

static void shared_corners_strike_once(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws_of(150); i++) check_meeting(&checks, first_seed() + (uint64_t)i);
    checks_end(&checks);
}

/* ---- boxes of parts, and of one */

struct thrown {
    double m, a, b, mu, e, slope, start[6];
    int columns, rows, law;
    double until;
};

static void draw_thrown(struct random_numbers *numbers, struct thrown *box)
{
    static const int grids[][2] = {{2, 1}, {1, 2}, {2, 2}, {3, 1}, {1, 3}, {4, 1}};
    int grid = choose(numbers, 6);
    *box = (struct thrown){.columns = grids[grid][0], .rows = grids[grid][1], .law = choose(numbers, 4)};
    box->m = random_between(numbers, 0.5, 4);
    box->a = random_between(numbers, 0.2, 0.8);
    box->b = random_between(numbers, 0.1, 0.6);
    box->mu = random_perhaps(numbers, 0.8, 0.05, 0.8);
    box->e = random_perhaps(numbers, 0.5, 0, 0.7);
    box->slope = random_perhaps(numbers, 0.4, -0.3, 0.3);
    box->until = random_between(numbers, 0.3, 0.8);
    bool flat = random_chance(numbers, 0.2); /* lands with a side on the floor */
    box->start[1] = 0.6;
    box->start[2] = flat ? box->slope : random_between(numbers, -3, 3);
    box->start[3] = random_between(numbers, -1, 1);
    box->start[4] = random_between(numbers, -1, 1);
    box->start[5] = flat ? 0 : random_between(numbers, -4, 4);
}

static void throw(const struct thrown *box, int columns, int rows, struct trial *trial)
{
    static const char *const laws[] = {"stronge", "poisson", "newton", "moreau"};
    static struct assembly body;
    static struct written text;
    text.length = 0;
    assembly_box(&body, box->m, box->a, box->b, columns, rows);
    add(&text, "fbd: 1\nground: {lines: {floor: {along: %.17g}}}\nbodies:\n", box->slope);
    add(&text,
        "  box: {parts: {%s}, motion: planar, initial: {x: %.17g, y: %.17g, theta: %.17g, vx: %.17g, vy: "
        "%.17g, omega: "
        "%.17g}, forces: [gravity]}\n",
        body.parts.all, box->start[0], box->start[1], box->start[2], box->start[3], box->start[4],
        box->start[5]);
    add(&text, "contacts: [{between: [box, ground.floor], static: %.17g, restitution: %.17g, law: %s}]\n",
        box->mu, box->e, laws[box->law]);
    add(&text, "simulate: {until: %.17g}\n", box->until);
    show(&text);
    *trial = trial_parse(text.all);
    trial_start(trial, NULL);
    trial_finish(trial);
}

static void boxes_of_parts_move_as_one(void **unused)
{
    const double amplified = 1e-4; /* each bounce makes roundings larger, and series of them end at 1e-9 */
    static const char *const names[] = {"box.x", "box.y", "box.theta", "box.vx", "box.vy", "box.omega"};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws_of(40); i++) {
        struct random_numbers numbers = {first_seed() + (uint64_t)i};
        struct thrown box;
        struct trial parts, one;
        draw_thrown(&numbers, &box);
        throw(&box, box.columns, box.rows, &parts);
        throw(&box, 1, 1, &one);
        size_t failed = checks.failed;
        check_that(&checks, "both end", parts.outcome == FBD_DONE && one.outcome == FBD_DONE);
        for (int k = 0; k < 6; k++)
            check_close(&checks, names[k], trial_get(&parts, names[k]), trial_get(&one, names[k]), amplified);
        if (checks.failed > failed) printf("# seed %llu\n", (unsigned long long)(first_seed() + (uint64_t)i));
        trial_close(&parts);
        trial_close(&one);
    }
    checks_end(&checks);
}

/* ---- boxes of parts on boxes of parts */

/* A tower of two or three boxes of columns, of which a force slides the uppermost, the others at rest. */
static void slide_on_tower(struct checks *checks, uint64_t seed)
{
    struct random_numbers numbers = {seed};
    static struct assembly body;
    static struct written text;
    int count = 2 + choose(&numbers, 2);
    double y = 0, below = 0, m = 0, b = 0, start = 0, mu = random_perhaps(&numbers, 0.7, 0.05, 0.4),
           e = random_perhaps(&numbers, 0.5, 0, 0.8), way = random_chance(&numbers, 0.5) ? 1 : -1, until = 0;
    text.length = 0;
    add(&text, "fbd: 1\nground: {lines: {floor: {along: 0}}}\nbodies:\n");
    double acceleration = 0;
    for (int i = 0; i < count; i++) {
        bool top = i == count - 1;
        double a = top ? random_between(&numbers, 0.25, 0.5) : random_between(&numbers, 0.9, 1.2);
        b = top ? random_between(&numbers, 0.05, 0.15) : random_between(&numbers, 0.2, 0.5);
        m = top ? random_between(&numbers, 0.5, 2) : random_between(&numbers, 2, 4);
        /* A corner starts on one side of a joint of the box below and ends on the other one. */
        start = top ? -way * random_between(&numbers, 0.02, 0.1) + (choose(&numbers, 2) ? a / 2 : -a / 2) : 0;
        assembly_box(&body, m, a, b, 2 + choose(&numbers, 2), 1);
        acceleration = random_between(&numbers, 1, 3);
        add(&text, "  b%d: {parts: {%s}, motion: planar, initial: {x: %.17g, y: %.17g}, forces: [gravity", i,
            body.parts.all, start, y + b / 2);
        if (top)
            add(&text, ", applied: {value: %.17g, angle: %s, at: [0, %.17g]}", m * (mu * g + acceleration),
                way > 0 ? "0" : "180 deg", -b / 2);
        add(&text, "]}\n");
        y += b;
        below = m;
    }
    (void)below;
    until = random_between(&numbers, 0.2, 0.35);
    add(&text, "contacts:\n  - {between: [b0, ground.floor], static: 0.9, restitution: %.17g}\n", e);
    for (int i = 1; i < count; i++)
        add(&text, "  - {between: [b%d, b%d], static: %.17g, restitution: %.17g}\n", i - 1, i,
            i == count - 1 ? mu : 0.9, e);
    add(&text, "simulate: {until: %.17g}\n", until);
    show(&text);
    struct trial trial = trial_parse(text.all);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    size_t failed = checks->failed;
    char x[16], vx[16], theta[16];
    snprintf(x, sizeof x, "b%d.x", count - 1);
    snprintf(vx, sizeof vx, "b%d.vx", count - 1);
    snprintf(theta, sizeof theta, "b%d.theta", count - 1);
    check_that(checks, "it ends", trial.outcome == FBD_DONE);
    check_that(checks, "no impact", count_of(&trial, FBD_EVENT_IMPACT) == 0);
    check_close(checks, vx, trial_get(&trial, vx), way * acceleration * until, 1e-10);
    check_close(checks, x, trial_get(&trial, x), start + way * acceleration * until * until / 2, 1e-10);
    check_close(checks, theta, trial_get(&trial, theta), 0, 1e-10);
    check_close(checks, "b0.vx", trial_get(&trial, "b0.vx"), 0, 1e-10);
    if (checks->failed > failed) printf("# seed %llu\n%s\n", (unsigned long long)seed, text.all);
    trial_close(&trial);
}

static void corners_pass_corners(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws_of(40); i++) slide_on_tower(&checks, first_seed() + (uint64_t)i);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shared_corners_strike_once),
        cmocka_unit_test(boxes_of_parts_move_as_one),
        cmocka_unit_test(corners_pass_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
