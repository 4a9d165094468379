/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random scenes of one to three discs on one line, with stops, contacts, ropes, dry friction on surfaces at rest and moving,
 * springs, dampers and pushes, against a time stepping that knows no events (moreau.h). FBD_LINES=1000 tries so many,
 * FBD_LINES_SEED=17 begins there, FBD_LINES_UNTIL=0.5 ends each at that time, FBD_LINES_SHOW=1 prints the models.
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
#include "moreau.h"
#include "random_numbers.h"
#include "thorough.h"

enum { most_discs = 3 };

static const double g = 10, radius = 0.1;

/* A sin(w t + phase) + B, in N. */
struct push {
    double A, w, phase, B;
};

struct disc {
    double mass, x, v;
    double mu, surface, shaken; /* the surface goes at surface + shaken sin(3 t) */
    double pulse;               /* where not 0, mu is mu max(0, cos(pulse t)): for half of the time it is 0 */
    bool lists_zero;            /* friction is listed though mu = 0 */
    double rub, rub_speed;      /* -rub sign(v - rub_speed), in N */
    double k, c;                /* to x = 0 and the ground */
    double min, max, e;         /* stops, infinite without */
    double spring;              /* to the next disc, as long as at the start */
    double leash, rope;         /* lengths of ropes: from (0, 0), and to the next disc; infinite without */
    struct push push, press;    /* along the line, and onto it */
};

struct line {
    int count;
    double until, e; /* of contacts */
    bool moreau;     /* contacts say their law */
    struct disc discs[most_discs];
};

/* ---- draws */

static void draw_stops(struct random_numbers *numbers, struct disc *disc, double e)
{
    bool below = random_chance(numbers, 0.4), above = random_chance(numbers, 0.4);
    disc->min = below ? disc->x - random_perhaps(numbers, 0.8, 0.01, 0.4) : -HUGE_VAL;
    disc->max = above ? disc->x + random_between(numbers, 0.01, 0.4) : HUGE_VAL;
    disc->e = e;
    if (disc->min == disc->x) disc->v = fabs(disc->v);
}

static struct disc draw_disc(struct random_numbers *numbers)
{
    double mass = exp(random_between(numbers, -1.5, 1.5));
    struct disc disc = {.mass = mass,
                        .x = 2 * radius + random_perhaps(numbers, 0.7, 0.01, 0.5),
                        .v = random_perhaps(numbers, 0.8, -2, 2),
                        .mu = random_perhaps(numbers, 0.6, 0.02, 0.6),
                        .surface = random_perhaps(numbers, 0.3, -1, 1),
                        .shaken = random_perhaps(numbers, 0.2, -1, 1),
                        .k = random_perhaps(numbers, 0.3, 1, 100) * mass,
                        .c = random_perhaps(numbers, 0.2, 0, 2) * mass,
                        .spring = random_perhaps(numbers, 0.3, 1, 100),
                        .leash = HUGE_VAL,
                        .rope = HUGE_VAL};
    disc.push = (struct push){random_perhaps(numbers, 0.7, 0, 15) * mass, random_between(numbers, 0.5, 15),
                              random_between(numbers, 0, 6), random_perhaps(numbers, 0.4, -5, 5) * mass};
    return disc;
}

/* Of single discs: on the speed of the surface or another one. */
static void draw_rub(struct random_numbers *numbers, struct line *line)
{
    struct disc *disc = &line->discs[0];
    double rub = random_perhaps(numbers, 0.4, 0.1, 6) * disc->mass,
           other = random_perhaps(numbers, 0.5, -1, 1);
    if (line->count > 1) return;
    disc->rub = rub;
    disc->rub_speed = disc->shaken == 0 && random_chance(numbers, 0.5) ? disc->surface : other;
}

/* Laws of several impacts at one instant differ, so that only single discs bounce. */
static struct line draw_line(uint64_t seed)
{
    struct random_numbers numbers = {seed};
    struct line line = {.count = 1 + (int)(seed % most_discs), .until = random_between(&numbers, 0.5, 2)};
    double e = line.count == 1 ? random_perhaps(&numbers, 0.5, 0, 0.9) : 0, end = 0;
    for (int i = 0; i < line.count; i++) {
        struct disc *disc = &line.discs[i];
        *disc = draw_disc(&numbers);
        bool touches = i > 0 && disc->x == 2 * radius;
        disc->x += end;
        end = disc->x;
        if (touches) disc->v = fmax(disc->v, line.discs[i - 1].v);
        draw_stops(&numbers, disc, e);
        if (touches && disc->v < line.discs[i - 1].v) disc->v = line.discs[i - 1].v;
    }
    for (int i = 0; i < line.count; i++) {
        line.discs[i].lists_zero = random_chance(&numbers, 0.5);
        line.discs[i].pulse = random_perhaps(&numbers, 0.2, 2, 10);
    }
    draw_rub(&numbers, &line);
    return line;
}

/* Friction that all comes and goes, beside pushes of which half are constant: what rests as it comes may be held by others. */
static struct line draw_pulsed_line(uint64_t seed)
{
    struct line line = draw_line(seed);
    struct random_numbers numbers = {seed + 2000000011};
    for (int i = 0; i < line.count; i++) {
        struct disc *disc = &line.discs[i];
        disc->pulse = random_between(&numbers, 2, 10);
        if (disc->mu == 0) disc->mu = random_between(&numbers, 0.02, 0.6);
        if (random_chance(&numbers, 0.5)) disc->push.A = 0;
    }
    return line;
}

/* What is taut or touches at the start does not go beyond that; again for each disc until all is so. */
static void keep_taut(struct line *line, int i)
{
    struct disc *disc = &line->discs[i];
    if (disc->leash == disc->x || disc->max == disc->x) disc->v = fmin(disc->v, 0);
    if (disc->min == disc->x) disc->v = fmax(disc->v, 0);
    if (i + 1 == line->count) return;
    if (disc->rope == disc[1].x - disc->x && disc[1].v > disc->v) disc->v = disc[1].v = 0;
    if (disc[1].x - disc->x < 2.001 * radius && disc[1].v < disc->v) disc->v = disc[1].v = 0;
}

/* Ropes, some taut from the start on, what presses on the guides, and contacts that bounce as the time stepping has it, with the law of Moreau. */
static struct line draw_roped_line(uint64_t seed)
{
    struct line line = draw_line(seed);
    struct random_numbers numbers = {seed + 1000000007};
    line.e = random_perhaps(&numbers, 0.5, 0, 0.9);
    line.moreau = true;
    for (int i = 0; i < line.count; i++) {
        struct disc *disc = &line.discs[i];
        disc->press = (struct push){random_perhaps(&numbers, 0.5, 0, 0.9) * disc->mass * g,
                                    random_between(&numbers, 0.5, 15), random_between(&numbers, 0, 6), 0};
        if (random_chance(&numbers, 0.3)) disc->leash = disc->x + random_perhaps(&numbers, 0.8, 0.01, 0.3);
        if (disc->leash == disc->min) disc->leash += 0.01; /* no way to move at all */
        double slack = random_perhaps(&numbers, 0.8, 0.01, 0.3);
        if (i + 1 == line.count || !random_chance(&numbers, 0.5)) continue;
        bool touches =
            disc[1].x - disc->x < 2.001 * radius; /* no rope that is as long as the contact allows */
        disc->rope = disc[1].x - disc->x + (touches ? fmax(slack, 0.01) : slack);
    }
    for (int pass = 0; pass < most_discs; pass++)
        for (int i = 0; i < line.count; i++) keep_taut(&line, i);
    return line;
}

/* ---- the model */

static int write_disc(const struct disc *disc, int i, char *text, size_t size)
{
    char stops[120] = "", pulse[60] = "", friction[240] = "", rub[120] = "", press[200] = "";
    if (disc->min > -HUGE_VAL) snprintf(stops, sizeof stops, ", min: %.17g", disc->min);
    size_t length = strlen(stops);
    if (disc->max < HUGE_VAL) snprintf(stops + length, sizeof stops - length, ", max: %.17g", disc->max);
    length = strlen(stops);
    if (length > 0) snprintf(stops + length, sizeof stops - length, ", restitution: %.17g", disc->e);
    if (disc->rub > 0)
        snprintf(rub, sizeof rub, "      - applied: {name: rub, value: \"-%.17g*sign(v - %.17g)\"}\n",
                 disc->rub, disc->rub_speed);
    if (disc->press.A > 0)
        snprintf(press, sizeof press,
                 "      - applied: {name: press, angle: -90 deg, value: \"%.17g*sin(%.17g*t + %.17g)\"}\n",
                 disc->press.A, disc->press.w, disc->press.phase);
    if (disc->pulse > 0) snprintf(pulse, sizeof pulse, "*max(0, cos(%.17g*t))", disc->pulse);
    if (disc->mu > 0 || disc->lists_zero)
        snprintf(friction, sizeof friction,
                 "      - friction: {coefficient: \"%.17g%s\", surface_speed: \"%.17g + %.17g*sin(3*t)\"}\n",
                 disc->mu, pulse, disc->surface, disc->shaken);
    return snprintf(text, size,
                    "  d%d:\n    shape: sphere\n    radius: %.17g\n    mass: %.17g\n"
                    "    motion: {slide: {along: 0 deg%s}}\n    initial: {x: %.17g, v: %.17g}\n    forces:\n"
                    "      - gravity\n      - normal\n%s"
                    "      - applied: {name: push, value: \"%.17g*sin(%.17g*t + %.17g) + %.17g\"}\n%s"
                    "      - spring: {stiffness: %.17g}\n      - damper: {coefficient: %.17g}\n%s",
                    i, radius, disc->mass, stops, disc->x, disc->v, friction, disc->push.A, disc->push.w,
                    disc->push.phase, disc->push.B, rub, disc->k, disc->c, press);
}

static void write_line(const struct line *line, char *text, size_t size)
{
    int length =
        snprintf(text, size, "fbd: 1\ngravity: %.17g\nground: {points: {nail: [0, 0]}}\nbodies:\n", g);
    for (int i = 0; i < line->count; i++)
        length += write_disc(&line->discs[i], i, text + length, size - (size_t)length);
    bool couplings = line->count > 1;
    for (int i = 0; i < line->count; i++) couplings |= line->discs[i].leash < HUGE_VAL;
    if (couplings) length += snprintf(text + length, size - (size_t)length, "couplings:\n");
    for (int i = 0; i + 1 < line->count; i++)
        length += snprintf(text + length, size - (size_t)length,
                           "  - spring: {between: [d%d, d%d], stiffness: %.17g, free_length: %.17g}\n", i,
                           i + 1, line->discs[i].spring, line->discs[i + 1].x - line->discs[i].x);
    for (int i = 0; i < line->count; i++) {
        const struct disc *disc = &line->discs[i];
        if (disc->leash < HUGE_VAL)
            length += snprintf(text + length, size - (size_t)length,
                               "  - rope: {name: leash%d, through: [ground.nail, d%d], length: %.17g}\n", i,
                               i, disc->leash);
        if (disc->rope < HUGE_VAL)
            length += snprintf(text + length, size - (size_t)length,
                               "  - rope: {name: rope%d, through: [d%d, d%d], length: %.17g}\n", i, i, i + 1,
                               disc->rope);
    }
    if (line->count > 1) length += snprintf(text + length, size - (size_t)length, "contacts:\n");
    for (int i = 0; i + 1 < line->count; i++)
        length += snprintf(text + length, size - (size_t)length,
                           "  - {between: [d%d, d%d], restitution: %.17g%s}\n", i, i + 1, line->e,
                           line->moreau ? ", law: moreau" : "");
    length += snprintf(text + length, size - (size_t)length, "simulate: {until: %.17g}\n", line->until);
    assert_true((size_t)length < size);
}

/* ---- the same for the time stepping */

static void forces(const void *scene, double t, const double *q, const double *v, double *f)
{
    const struct line *line = scene;
    for (int i = 0; i < line->count; i++) {
        const struct disc *disc = &line->discs[i];
        f[i] = disc->push.A * sin(disc->push.w * t + disc->push.phase) + disc->push.B - disc->k * q[i] -
               disc->c * v[i];
    }
    for (int i = 0; i + 1 < line->count; i++) {
        const struct disc *disc = &line->discs[i];
        double pull = disc->spring * (q[i + 1] - q[i] - (disc[1].x - disc->x));
        f[i] += pull;
        f[i + 1] -= pull;
    }
}

static void solve(const void *scene, const double *q, double *b)
{
    const struct line *line = scene;
    (void)q;
    for (int i = 0; i < line->count; i++) b[i] /= line->discs[i].mass;
}

static void add_gap(struct moreau_rows *rows, int i, double side, double e)
{
    struct moreau_row row = {.kind = moreau_gap, .e = e, .normal = -1};
    row.w[i] = side;
    rows->row[rows->count++] = row;
}

/* What touches to rounding takes part in an impact beside it. */
static void find_rows(const void *scene, double t, const double *q, struct moreau_rows *rows)
{
    const double closed = 1e-12;
    const struct line *line = scene;
    for (int i = 0; i < line->count; i++) {
        const struct disc *disc = &line->discs[i];
        double N = disc->mass * g + disc->press.A * sin(disc->press.w * t + disc->press.phase);
        struct moreau_row rub = {.kind = moreau_rub,
                                 .aim = disc->surface + disc->shaken * sin(3 * t),
                                 .most = disc->mu * fmax(0, cos(disc->pulse * t)) * N,
                                 .normal = -1};
        rub.w[i] = 1;
        if (disc->mu > 0) rows->row[rows->count++] = rub;
        rub.aim = disc->rub_speed;
        rub.most = disc->rub;
        if (disc->rub > 0) rows->row[rows->count++] = rub;
        if (q[i] <= disc->min + closed) add_gap(rows, i, 1, disc->e);
        if (q[i] >= disc->max - closed) add_gap(rows, i, -1, disc->e);
        if (q[i] >= disc->leash - closed) add_gap(rows, i, -1, 0);
        if (q[i] <= closed - disc->leash) add_gap(rows, i, 1, 0);
        if (i + 1 < line->count && q[i + 1] - q[i] >= disc->rope - closed) {
            add_gap(rows, i, 1, 0);
            rows->row[rows->count - 1].w[i + 1] = -1;
        }
        if (i + 1 == line->count || q[i + 1] - q[i] > 2 * radius + closed) continue;
        add_gap(rows, i, -1, line->e);
        rows->row[rows->count - 1].w[i + 1] = 1;
    }
}

static void part(const struct line *line, double *q, int i, double way)
{
    double share = line->discs[i + 1].mass / (line->discs[i].mass + line->discs[i + 1].mass);
    q[i] -= share * way;
    q[i + 1] += (1 - share) * way;
}

static void lift(const void *scene, double *q)
{
    const struct line *line = scene;
    for (int i = 0; i + 1 < line->count; i++) {
        double far = q[i + 1] - q[i];
        if (far < 2 * radius) part(line, q, i, 2 * radius - far);
        if (far > line->discs[i].rope) part(line, q, i, line->discs[i].rope - far);
    }
    for (int i = 0; i < line->count; i++) {
        const struct disc *disc = &line->discs[i];
        q[i] = fmin(fmax(q[i], fmax(disc->min, -disc->leash)), fmin(disc->max, disc->leash));
    }
}

/* The end by so many steps; places, and a tenth of the velocities. */
static void step_through(const struct line *line, int steps, bool lifted, double *end)
{
    const struct moreau_system system = {line->count, line, forces, solve, find_rows, lifted ? lift : NULL};
    double q[moreau_most] = {0}, v[moreau_most] = {0};
    for (int i = 0; i < line->count; i++) q[i] = line->discs[i].x, v[i] = line->discs[i].v;
    moreau_run(&system, line->until, steps, q, v);
    for (int i = 0; i < line->count; i++) end[2 * i] = q[i], end[2 * i + 1] = v[i] / 10;
}

static double apart(int count, const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < 2 * count; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* ---- both */

/* The end of the run, in the same form; false when it does not come to it. */
static bool run_line(const char *text, int count, double *end)
{
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    bool done = trial.outcome == FBD_DONE;
    if (!done) printf("# %s\n", fbd_simulation_reason(trial.simulation));
    for (int i = 0; i < count; i++) {
        char name[16];
        snprintf(name, sizeof name, "d%d.x", i);
        end[2 * i] = trial_get(&trial, name);
        snprintf(name, sizeof name, "d%d.v", i);
        end[2 * i + 1] = trial_get(&trial, name) / 10;
    }
    trial_close(&trial);
    return done;
}

/* Does the run end where small steps do? Steps and half steps may agree by chance: then smaller ones are asked. Where
 * they do not agree nothing is. */
static bool agrees(uint64_t seed, struct line line, bool *sensitive)
{
    enum { first_steps = 20000, most_steps = 1280000 };
    const double most = 3e-3, least = 2e-4;
    double end[2 * most_discs], fine[2 * most_discs], coarse[2 * most_discs], off = 0, difference = 0;
    char text[6000];
    write_line(&line, text, sizeof text);
    if (getenv("FBD_LINES_SHOW")) puts(text);
    step_through(&line, first_steps / 2, false, coarse);
    bool done = run_line(text, line.count, end);
    for (int steps = first_steps; steps <= most_steps; steps *= 2) {
        step_through(&line, steps, false, fine);
        off = apart(line.count, fine, coarse);
        difference = apart(line.count, end, fine);
        *sensitive = off > most;
        if (*sensitive || (done && difference <= fmax(10 * off, least))) return true;
        memcpy(coarse, fine, sizeof fine);
    }
    /* What has closed within a step stays so for a while: impacts that soon follow each other may be one or several. */
    step_through(&line, most_steps, true, coarse);
    off = fmax(off, apart(line.count, fine, coarse));
    *sensitive = off > most;
    if (*sensitive || (done && difference <= 10 * off)) return true;
    printf("# seed %llu: %g apart, where the steps are off by %g\n%s\n", (unsigned long long)seed, difference,
           off, text);
    for (int i = 0; i < line.count; i++)
        printf("# d%d.x = %.10g, by steps %.10g; v = %.10g, %.10g\n", i, end[2 * i], fine[2 * i],
               10 * end[2 * i + 1], 10 * fine[2 * i + 1]);
    return false;
}

static void try_lines(struct line (*draw)(uint64_t seed), int count)
{
    const char *given = getenv("FBD_LINES"), *first = getenv("FBD_LINES_SEED"),
               *until = getenv("FBD_LINES_UNTIL");
    uint64_t seed = first ? strtoull(first, NULL, 10) : 1;
    int differ = 0, left_out = 0;
    if (given) count = atoi(given);
    for (int i = 0; i < count; i++) {
        bool sensitive;
        struct line line = draw(seed + (uint64_t)i);
        if (until) line.until = strtod(until, NULL);
        differ += !agrees(seed + (uint64_t)i, line, &sensitive);
        left_out += sensitive;
    }
    printf("# %d lines, %d too sensitive\n", count, left_out);
    assert_int_equal(differ, 0);
    assert_true(10 * left_out <= count);
}

static void time_stepping_says_the_same(void **unused)
{
    (void)unused;
    try_lines(draw_line, draws_of(18));
}

static void of_ropes_and_bounces_as_well(void **unused)
{
    (void)unused;
    try_lines(draw_roped_line, draws_of(18));
}

static void of_friction_that_comes_and_goes(void **unused)
{
    (void)unused;
    try_lines(draw_pulsed_line, draws_of(6));
}

/* Plastic impacts far apart that were taken for the end of a series (771329), friction that is zero for now and
 * changed its side again and again at rest, friction that comes while its body rests, and the sign
 * of a speed that a stop holds at zero; of one that a rope holds there (the last one). */
static void seeds_that_once_failed(void **unused)
{
    static const uint64_t seeds[] = {771329, 771829, 881063, 881081, 2881211, 97134, 98516, 98673};
    (void)unused;
    int differ = 0;
    bool sensitive;
    for (size_t i = 0; i < sizeof seeds / sizeof seeds[0]; i++)
        differ += !agrees(seeds[i], draw_line(seeds[i]), &sensitive);
    differ += !agrees(140016, draw_roped_line(140016), &sensitive);
    assert_int_equal(differ, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(time_stepping_says_the_same),
        cmocka_unit_test(of_ropes_and_bounces_as_well),
        cmocka_unit_test(of_friction_that_comes_and_goes),
        cmocka_unit_test(seeds_that_once_failed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
