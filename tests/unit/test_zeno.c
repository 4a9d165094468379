/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random rods, boxes, polygons and lollipops that bounce freely on a floor and between two slopes, with friction and all laws
 * of impact; against flights in closed form, of which the first touch is found by bounds of its second derivative, and
 * impacts by small steps (impact_by_steps.h). FBD_BOUNCES=1000 tries so many, FBD_BOUNCES_SEED=17 begins there,
 * FBD_BOUNCES_SHOW=1 prints the models and the impacts.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gallery.h"
#include "impact_by_steps.h"
#include "moreau.h"
#include "random_numbers.h"
#include "written.h"

enum { most_feet = 6, most_walls = 2, coordinates = 3, most_impacts = 12 };

static const double g = 10;

/* What touches: a point of the body, from its centre of mass, or a circle about it. */
struct foot {
    double at[2], r;
    double mu, e, fade; /* restitution: e/(1 + fade*approach) */
};

/* Of a slope through a place, with the normal to the side where the body is. */
struct wall {
    double through[2], along, normal[2];
};

/* q and v are those of the centre of mass, and of the angle. */
struct scene {
    double m, I, center[2], q[coordinates], v[coordinates], until;
    enum law_by_steps law;
    int feet, walls;
    struct foot foot[most_feet];
    struct wall wall[most_walls];
    struct written text;
};

/* ---- draws, with their models */

static void add_foot(struct scene *scene, double x, double y, double r)
{
    scene->foot[scene->feet++] = (struct foot){.at = {x, y}, .r = r};
}

static void draw_rod(struct random_numbers *numbers, struct scene *scene)
{
    double a = random_between(numbers, 0.2, 1);
    scene->I = scene->m * a * a / 12;
    add_foot(scene, a / 2, 0, 0);
    add_foot(scene, -a / 2, 0, 0);
    add(&scene->text, "    shape: rod\n    length: %.17g\n    mass: %.17g\n", a, scene->m);
}

static void draw_box(struct random_numbers *numbers, struct scene *scene)
{
    double a = random_between(numbers, 0.2, 1), b = random_between(numbers, 0.1, 1);
    scene->I = scene->m * (a * a + b * b) / 12;
    for (int k = 0; k < 4; k++) add_foot(scene, (k % 2 ? a : -a) / 2, (k / 2 ? b : -b) / 2, 0);
    add(&scene->text, "    shape: prism\n    a: %.17g\n    b: %.17g\n    mass: %.17g\n", a, b, scene->m);
}

/* Corners that have names; its centre of mass is beside the frame's origin. */
static void draw_polygon(struct random_numbers *numbers, struct scene *scene)
{
    int corners = 3 + (int)random_between(numbers, 0, 3.999);
    double r = random_between(numbers, 0.1, 0.5), x = random_between(numbers, -0.2, 0.2) * r;
    scene->I = scene->m * r * r * random_between(numbers, 0.2, 0.8);
    scene->center[0] = x;
    add(&scene->text, "    mass: %.17g\n    inertia: %.17g\n    center: [%.17g, 0]\n    points: {", scene->m,
        scene->I, x);
    for (int k = 0; k < corners; k++) {
        double angle = (k + random_between(numbers, -0.3, 0.3)) * 2 * acos(-1) / corners,
               far = r * random_between(numbers, 0.8, 1.2), c = far * cos(angle), s = far * sin(angle);
        add_foot(scene, c - x, s, 0);
        add(&scene->text, "%sP%d: [%.17g, %.17g]", k > 0 ? ", " : "", k, c, s);
    }
    add(&scene->text, "}\n");
}

/* A disc at one end of a rod. */
static void draw_lollipop(struct random_numbers *numbers, struct scene *scene)
{
    double a = random_between(numbers, 0.3, 0.8), r = random_between(numbers, 0.05, 0.2), m1 = scene->m,
           m2 = scene->m * random_between(numbers, 0.2, 2), x = (m1 / 2 + m2) * a / (m1 + m2);
    scene->m = m1 + m2;
    scene->center[0] = x;
    scene->I = m1 * (a * a / 12 + (a / 2 - x) * (a / 2 - x)) + m2 * (r * r / 2 + (a - x) * (a - x));
    add_foot(scene, -x, 0, 0);
    add_foot(scene, a - x, 0, 0);
    add_foot(scene, a - x, 0, r);
    add(&scene->text,
        "    parts:\n      stick: {shape: rod, from: [0, 0], to: [%.17g, 0], mass: %.17g}\n"
        "      head: {shape: disc, radius: %.17g, center: [%.17g, 0], mass: %.17g}\n",
        a, m1, r, a, m2);
}

static void draw_walls(struct random_numbers *numbers, struct scene *scene)
{
    scene->walls = random_chance(numbers, 0.5) ? 2 : 1;
    add(&scene->text, "ground:\n  lines:\n");
    for (int k = 0; k < scene->walls; k++) {
        struct wall *wall = &scene->wall[k];
        double x = k == 0 ? 0 : random_chance(numbers, 0.5) ? 1.5 : -1.5;
        *wall = (struct wall){.through = {x, 0}};
        wall->along = k == 0 ? random_perhaps(numbers, 0.5, -0.4, 0.4)
                             : (x > 0 ? 1 : -1) * random_between(numbers, 0.8, 1.6);
        double side = k > 0 && cos(wall->along) * 1.3 + sin(wall->along) * x < 0 ? -1 : 1;
        wall->normal[0] = -side * sin(wall->along);
        wall->normal[1] = side * cos(wall->along);
        add(&scene->text, "    wall_%d: {through: [%.17g, 0], along: %.17g}\n", k, x, wall->along);
    }
}

/* Of feet from `foot` to before `last`, on all walls the same. */
static void add_laws(struct random_numbers *numbers, struct scene *scene, int foot, int last, int wall,
                     const char *point)
{
    static const char *const laws[] = {"stronge", "poisson", "newton", "moreau"};
    struct foot *feet = scene->foot;
    if (wall == 0)
        for (int k = foot; k < last; k++) {
            feet[k].e = k > foot ? feet[foot].e : random_between(numbers, 0.1, 0.95);
            feet[k].mu = k > foot ? feet[foot].mu : random_perhaps(numbers, 0.85, 0, 1);
            feet[k].fade = k > foot ? feet[foot].fade : random_perhaps(numbers, 0.2, 0, 0.2);
        }
    add(&scene->text,
        "  - {between: [b%s, ground.wall_%d], static: %.17g, kinetic: %.17g, law: %s, restitution: ", point,
        wall, feet[foot].mu * (foot % 2 ? 1 : 1.25), feet[foot].mu, laws[scene->law]);
    if (feet[foot].fade > 0)
        add(&scene->text, "\"%.17g/(1 + %.17g*approach/1[m/s])\"}\n", feet[foot].e, feet[foot].fade);
    else
        add(&scene->text, "%.17g}\n", feet[foot].e);
}

static void draw_scene(uint64_t seed, struct scene *scene)
{
    static void (*const draws[])(struct random_numbers *, struct scene *) = {draw_box, draw_polygon, draw_rod,
                                                                             draw_lollipop};
    struct random_numbers numbers = {seed};
    *scene = (struct scene){.m = exp(random_between(&numbers, -1, 1)), .until = 2.5};
    scene->law = (enum law_by_steps)(random_bits(&numbers) % 4);
    add(&scene->text, "fbd: 1\ngravity: %g\n", g);
    draw_walls(&numbers, scene);
    add(&scene->text, "bodies:\n  b:\n");
    draws[seed % 4](&numbers, scene);
    double place[3] = {0, random_between(&numbers, 1.15, 1.6), random_between(&numbers, -3, 3)},
           rate[3] = {random_between(&numbers, -3, 3), random_between(&numbers, -2, 2),
                      random_perhaps(&numbers, 0.8, -8, 8)};
    const double *center = scene->center, c = cos(place[2]), s = sin(place[2]),
                 G[2] = {c * center[0] - s * center[1], s * center[0] + c * center[1]};
    for (int k = 0; k < 3; k++) scene->q[k] = place[k] + (k < 2 ? G[k] : 0), scene->v[k] = rate[k];
    scene->v[0] -= rate[2] * G[1];
    scene->v[1] += rate[2] * G[0];
    add(&scene->text,
        "    motion: planar\n    initial: {x: %.17g, y: %.17g, theta: %.17g, vx: %.17g, vy: %.17g, omega: "
        "%.17g}\n    forces: [gravity]\ncontacts:\n",
        place[0], place[1], place[2], rate[0], rate[1], rate[2]);
    for (int wall = 0; wall < scene->walls; wall++) {
        if (draws[seed % 4] != draw_polygon) add_laws(&numbers, scene, 0, scene->feet, wall, "");
        for (int k = 0; k < scene->feet && draws[seed % 4] == draw_polygon; k++) {
            char point[16];
            snprintf(point, sizeof point, ".P%d", k);
            add_laws(&numbers, scene, k, k + 1, wall, point);
        }
    }
}

/* ---- the same by flights and impacts */

struct flight {
    double t, q[coordinates], v[coordinates];
    int impacts;
};

static void fly(struct flight *flight, double time)
{
    double *q = flight->q, *v = flight->v;
    q[0] += v[0] * time;
    q[1] += v[1] * time - g * time * time / 2;
    q[2] += v[2] * time;
    v[1] -= g * time;
    flight->t += time;
}

/* From the centre of mass to where a foot would touch a wall. */
static void arm_of(const struct foot *foot, const struct wall *wall, double angle, double *arm)
{
    double c = cos(angle), s = sin(angle);
    arm[0] = c * foot->at[0] - s * foot->at[1] - foot->r * wall->normal[0];
    arm[1] = s * foot->at[0] + c * foot->at[1] - foot->r * wall->normal[1];
}

static double gap_of(const struct foot *foot, const struct wall *wall, const struct flight *flight,
                     double *rate)
{
    double arm[2];
    const double *n = wall->normal, *q = flight->q, *v = flight->v;
    arm_of(foot, wall, q[2], arm);
    double turn_x = arm[0] + foot->r * n[0], turn_y = arm[1] + foot->r * n[1]; /* what turns */
    *rate = n[0] * (v[0] - v[2] * turn_y) + n[1] * (v[1] + v[2] * turn_x);
    return n[0] * (q[0] + arm[0] - wall->through[0]) + n[1] * (q[1] + arm[1] - wall->through[1]);
}

/* How long no foot can touch: gap + rate t - bend t^2/2 > 0. Who is there, when it is none. */
static double safe_time(const struct scene *scene, const struct flight *flight, int *foot, int *wall)
{
    const double nothing = 1e-14;
    double least = 1;
    *foot = -1;
    for (int w = 0; w < scene->walls; w++)
        for (int k = 0; k < scene->feet; k++) {
            double rate, gap = gap_of(&scene->foot[k], &scene->wall[w], flight, &rate);
            double far = hypot(scene->foot[k].at[0], scene->foot[k].at[1]);
            double bend = g + flight->v[2] * flight->v[2] * far;
            if (gap <= nothing && rate <= 0) {
                *foot = k;
                *wall = w;
                return 0;
            }
            double root = sqrt(rate * rate + 2 * bend * fmax(gap, 0));
            double safe = rate > 0 ? (rate + root) / bend : 2 * fmax(gap, 0) / (root - rate);
            least = fmin(least, safe);
        }
    return least;
}

/* Its velocity along the normal before and after. */
static void strike(const struct scene *scene, struct flight *flight, int k, int w, double *before,
                   double *after)
{
    const struct foot *foot = &scene->foot[k];
    const struct wall *wall = &scene->wall[w];
    const double *n = wall->normal, t[2] = {n[1], -n[0]};
    double arm[2], *v = flight->v, P[2];
    arm_of(foot, wall, flight->q[2], arm);
    double x = arm[0] * n[1] - arm[1] * n[0], y = arm[0] * t[1] - arm[1] * t[0];
    struct point_by_steps point = {.W = {1 / scene->m + x * x / scene->I, x * y / scene->I,
                                         1 / scene->m + y * y / scene->I},
                                   .mu = foot->mu,
                                   .law = scene->law};
    double u[2] = {n[0] * v[0] + n[1] * v[1] + x * v[2], t[0] * v[0] + t[1] * v[1] + y * v[2]};
    point.e = foot->e / (1 - foot->fade * u[0]);
    *before = u[0];
    impact_by_steps(&point, u, P);
    *after = u[0];
    for (int i = 0; i < 2; i++) v[i] += (n[i] * P[0] + t[i] * P[1]) / scene->m;
    v[2] += (x * P[0] + y * P[1]) / scene->I;
    flight->impacts++;
    if (getenv("FBD_BOUNCES_SHOW"))
        printf("# t = %.12g: foot %d on %d, v_n = %.9g -> %.9g, P = %.9g, %.9g\n", flight->t, k, w, *before,
               *after, P[0], P[1]);
}

/* On to the next impact, or until then. */
static bool fly_to_impact(const struct scene *scene, struct flight *flight, double until, int *foot,
                          int *wall)
{
    *foot = -1;
    while (flight->t < until) {
        double safe = safe_time(scene, flight, foot, wall);
        if (*foot >= 0) return true;
        fly(flight, fmin(safe, until - flight->t));
    }
    return false;
}

/* Until then, or to where bounces get too low to be told from rest: half the way to the next one. */
static struct flight fly_through(const struct scene *scene, double until)
{
    const double low = 0.03;
    struct flight flight = {0};
    int foot, wall;
    bool ends = false;
    memcpy(flight.q, scene->q, sizeof flight.q);
    memcpy(flight.v, scene->v, sizeof flight.v);
    while (!ends && fly_to_impact(scene, &flight, until, &foot, &wall)) {
        double before, after;
        strike(scene, &flight, foot, wall, &before, &after);
        ends = after < low || before > -low || flight.impacts >= most_impacts;
    }
    if (!ends) return flight;
    struct flight next = flight;
    fly_to_impact(scene, &next, until, &foot, &wall);
    fly(&flight, (next.t - flight.t) / 2);
    return flight;
}

static double apart(const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < 2 * coordinates; i++)
        if (!(fabs(a[i] - b[i]) <= most)) most = fabs(a[i] - b[i]);
    return most;
}

/* ---- both */

static void state_of(const struct scene *scene, const struct flight *flight, double *to)
{
    const double *center = scene->center, *q = flight->q, *v = flight->v, c = cos(q[2]), s = sin(q[2]),
                 G[2] = {c * center[0] - s * center[1], s * center[0] + c * center[1]};
    for (int k = 0; k < coordinates; k++) to[k] = q[k], to[coordinates + k] = v[k];
    to[0] -= G[0];
    to[1] -= G[1];
    to[3] += v[2] * G[1];
    to[4] -= v[2] * G[0];
}

static bool run_scene(const struct scene *scene, double *to)
{
    static const char *const names[] = {"b.x", "b.y", "b.theta", "b.vx", "b.vy", "b.omega"};
    struct trial trial = trial_parse(scene->text.all);
    trial_run(&trial, NULL);
    bool done = trial.outcome == FBD_DONE;
    if (!done) printf("# %s\n", fbd_simulation_reason(trial.simulation));
    for (int i = 0; i < 2 * coordinates; i++) to[i] = trial_get(&trial, names[i]);
    if (getenv("FBD_BOUNCES_SHOW"))
        for (size_t k = 0; k < fbd_simulation_event_count(trial.simulation); k++) {
            fbd_event event = fbd_simulation_event(trial.simulation, k);
            printf("# run: t = %.12g: %s\n", event.t, event.detail);
        }
    trial_close(&trial);
    return done;
}

/* From a start that is moved by 1e-9 it is to end nearly there, too. */
static bool agrees(uint64_t seed, bool *sensitive)
{
    const double moved = 1e-9, most = 1e-4, least = 1e-7;
    static struct scene scene, other;
    double end[2 * coordinates], own[2 * coordinates], off[2 * coordinates];
    draw_scene(seed, &scene);
    struct flight flight = fly_through(&scene, scene.until);
    add(&scene.text, "simulate: {until: %.17g, tolerance: 1e-11}\n", flight.t);
    if (getenv("FBD_BOUNCES_SHOW")) puts(scene.text.all);
    state_of(&scene, &flight, own);
    double error = 0;
    for (int k = 0; k < 4; k++) {
        other = scene;
        for (int i = 0; i < 3; i++)
            other.q[i] += k / 2 == 0 ? (k % 2 ? moved : -moved) : (k % 2 == (i == 1) ? moved : -moved);
        struct flight beside = fly_through(&other, flight.t);
        fly(&beside, flight.t - beside.t);
        state_of(&other, &beside, off);
        error = fmax(error, apart(own, off));
    }
    *sensitive = !(error <= most);
    if (*sensitive) return true;
    bool done = run_scene(&scene, end);
    double difference = apart(own, end);
    if (done && difference <= fmax(least, error)) return true;
    printf("# seed %llu: %g apart after %d impacts, where a start beside is off by %g\n%s\n",
           (unsigned long long)seed, difference, flight.impacts, error, scene.text.all);
    for (int i = 0; i < 2 * coordinates; i++) printf("# %.12g, by flights %.12g\n", end[i], own[i]);
    return false;
}

static void flights_and_impacts_say_the_same(void **unused)
{
    (void)unused;
    moreau_compare("FBD_BOUNCES", 300, 10, agrees);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flights_and_impacts_say_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
