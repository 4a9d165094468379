/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random trains of one to four wheels on pivots of the ground: geared, belted or each for itself, with dry friction in their
 * bearings, stops, springs, dampers and moments that vary, and a rack that slides with friction; against a time stepping
 * that knows no events (moreau.h). FBD_WHEELS=1000 tries so many, FBD_WHEELS_SEED=17 begins there, FBD_WHEELS_UNTIL=0.5 ends
 * each at that time, FBD_WHEELS_SHOW=1 prints the models.
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
#include "written.h"

enum { most_wheels = 4, most_parts = most_wheels + 1 };

static const double g = 10;

/* A sin(w t + phase) + B, in N*m or N. */
struct push {
    double A, w, phase, B;
};

/* A wheel, or the rack that the last one drives: then it is a mass, and lengths stand for angles. */
struct part {
    double inertia, r, q, v;
    double rub;        /* the moment (force) that its friction is up to; 0: none is listed */
    double surface;    /* at which speed it rubs on nothing */
    double k, neutral; /* spring */
    double c;          /* damper */
    double min, max;   /* stops, infinite without */
    struct push push;
};

enum joint { joint_none, joint_gear, joint_belt, joint_crossed };

struct train {
    int wheels;
    bool rack;
    double until;
    struct part parts[most_parts];
    enum joint joint[most_wheels]; /* to the next wheel */
};

static int size_of(const struct train *train)
{
    return train->wheels + train->rack;
}

/* ---- draws */

/* Of moments of a size for which all of it matters. */
static struct part draw_part(struct random_numbers *numbers, double inertia, double r)
{
    double size = 5 * inertia;
    struct part part = {.inertia = inertia,
                        .r = r,
                        .q = random_perhaps(numbers, 0.7, -1, 1),
                        .v = random_perhaps(numbers, 0.8, -3, 3),
                        .rub = random_perhaps(numbers, 0.6, 0.02, 1) * size,
                        .surface = random_perhaps(numbers, 0.2, -1, 1),
                        .k = random_perhaps(numbers, 0.4, 0.1, 10) * size,
                        .neutral = random_between(numbers, -1, 1),
                        .c = random_perhaps(numbers, 0.3, 0, 0.5) * size};
    bool below = random_chance(numbers, 0.3), above = random_chance(numbers, 0.3);
    part.min = below ? part.q - random_between(numbers, 0.01, 0.5) : -HUGE_VAL;
    part.max = above ? part.q + random_between(numbers, 0.01, 0.5) : HUGE_VAL;
    part.push = (struct push){random_perhaps(numbers, 0.7, 0, 3) * size, random_between(numbers, 0.5, 15),
                              random_between(numbers, 0, 6), random_perhaps(numbers, 0.4, -2, 2) * size};
    return part;
}

/* v of part i + 1 for one of part i, where they are joined. */
static double ratio_of(const struct train *train, int i)
{
    const struct part *part = &train->parts[i];
    if (i + 1 == train->wheels) return -part->r; /* the rack lies above */
    double ratio = part->r / part[1].r;
    return train->joint[i] == joint_belt ? ratio : -ratio;
}

static bool joins(const struct train *train, int i)
{
    return i + 1 == train->wheels ? train->rack : train->joint[i] != joint_none;
}

static struct train draw_train(uint64_t seed)
{
    struct random_numbers numbers = {seed};
    struct train train = {.wheels = 1 + (int)(seed % most_wheels), .until = random_between(&numbers, 0.5, 2)};
    for (int i = 0; i < train.wheels; i++) {
        double mass = exp(random_between(&numbers, -1, 1)), r = random_between(&numbers, 0.1, 0.5);
        train.parts[i] = draw_part(&numbers, mass * r * r / 2, r);
        train.joint[i] = random_chance(&numbers, 0.7)
                             ? (enum joint)(joint_gear + (int)(random_bits(&numbers) % 3))
                             : joint_none;
    }
    train.rack = random_chance(&numbers, 0.4);
    if (train.rack) {
        train.parts[train.wheels] = draw_part(&numbers, exp(random_between(&numbers, -1, 1)), 1);
        train.parts[train.wheels].surface = 0;
    }
    for (int i = 0; i + 1 < size_of(&train); i++)
        if (joins(&train, i)) train.parts[i + 1].v = ratio_of(&train, i) * train.parts[i].v;
    return train;
}

/* ---- the model */

static void add_part(struct written *text, const struct train *train, int i, double x)
{
    const struct part *part = &train->parts[i];
    bool rack = i == train->wheels;
    if (rack)
        add(text, "  p%d:\n    mass: %.17g\n    motion: {slide: {along: 0 deg, through: [0, %.17g]", i,
            part->inertia, train->parts[i - 1].r);
    else
        add(text,
            "  p%d:\n    shape: disc\n    radius: %.17g\n    mass: %.17g\n    motion: {pivot: {at: [%.17g, "
            "0]",
            i, part->r, 2 * part->inertia / (part->r * part->r), x);
    if (part->min > -HUGE_VAL) add(text, ", min: %.17g", part->min);
    if (part->max < HUGE_VAL) add(text, ", max: %.17g", part->max);
    bool stops = part->min > -HUGE_VAL || part->max < HUGE_VAL;
    add(text, "%s}}\n    initial: {%s: %.17g, %s: %.17g}\n", stops ? ", restitution: 0" : "",
        rack ? "x" : "theta", part->q, rack ? "v" : "omega", part->v);
    add(text,
        rack ? "    forces:\n      - gravity\n      - normal\n" : "    forces: [gravity]\n    moments:\n");
    add(text, "      - applied: {name: push, value: \"%.17g*sin(%.17g*t + %.17g) + %.17g\"}\n", part->push.A,
        part->push.w, part->push.phase, part->push.B);
    if (part->rub > 0)
        add(text, "      - friction: {coefficient: %.17g, surface_speed: %.17g}\n",
            rack ? part->rub / (part->inertia * g) : part->rub, part->surface);
    if (part->k > 0)
        add(text, "      - spring: {stiffness: %.17g, %s: %.17g}\n", part->k,
            rack ? "free_length" : "neutral", part->neutral);
    if (part->c > 0) add(text, "      - damper: {coefficient: %.17g}\n", part->c);
}

static void write_train(const struct train *train, struct written *text)
{
    static const char *const kinds[] = {"", "gear", "belt", "belt"};
    bool couplings = train->rack;
    double x = 0;
    add(text, "fbd: 1\ngravity: %.17g\nbodies:\n", g);
    for (int i = 0; i < size_of(train); i++) {
        add_part(text, train, i, x);
        if (i + 1 >= train->wheels) continue;
        x += (train->parts[i].r + train->parts[i + 1].r) * (train->joint[i] == joint_gear ? 1 : 1.5);
        couplings |= train->joint[i] != joint_none;
    }
    if (couplings) add(text, "couplings:\n");
    for (int i = 0; i + 1 < train->wheels; i++)
        if (train->joint[i] != joint_none)
            add(text, "  - %s: {between: [p%d, p%d]%s}\n", kinds[train->joint[i]], i, i + 1,
                train->joint[i] == joint_gear   ? ""
                : train->joint[i] == joint_belt ? ", tension: 1e6 N"
                                                : ", tension: 1e6 N, crossed: true");
    if (train->rack)
        add(text, "  - rack: {between: [p%d, p%d], radius: %.17g}\n", train->wheels - 1, train->wheels,
            train->parts[train->wheels - 1].r);
    add(text, "simulate: {until: %.17g}\n", train->until);
}

/* ---- the same for the time stepping */

static void forces(const void *scene, double t, const double *q, const double *v, double *f)
{
    const struct train *train = scene;
    for (int i = 0; i < size_of(train); i++) {
        const struct part *part = &train->parts[i];
        f[i] = part->push.A * sin(part->push.w * t + part->push.phase) + part->push.B -
               part->k * (q[i] - part->neutral) - part->c * v[i];
    }
}

static void solve(const void *scene, const double *q, double *b)
{
    const struct train *train = scene;
    (void)q;
    for (int i = 0; i < size_of(train); i++) b[i] /= train->parts[i].inertia;
}

static void add_row(struct moreau_rows *rows, struct moreau_row row, int i, double w)
{
    row.normal = -1;
    row.w[i] = w;
    rows->row[rows->count++] = row;
}

static void find_rows(const void *scene, double t, const double *q, struct moreau_rows *rows)
{
    const struct train *train = scene;
    (void)t;
    for (int i = 0; i < size_of(train); i++) {
        const struct part *part = &train->parts[i];
        if (part->rub > 0)
            add_row(rows, (struct moreau_row){.kind = moreau_rub, .aim = part->surface, .most = part->rub}, i,
                    1);
        if (q[i] <= part->min) add_row(rows, (struct moreau_row){.kind = moreau_gap}, i, 1);
        if (q[i] >= part->max) add_row(rows, (struct moreau_row){.kind = moreau_gap}, i, -1);
        if (i + 1 >= size_of(train) || !joins(train, i)) continue;
        add_row(rows, (struct moreau_row){.kind = moreau_equal}, i, -ratio_of(train, i));
        rows->row[rows->count - 1].w[i + 1] = 1;
    }
}

/* Places, and a tenth of the velocities. */
static void step_through(const struct train *train, int steps, double *end)
{
    const struct moreau_system system = {size_of(train), train, forces, solve, find_rows, NULL};
    double q[moreau_most] = {0}, v[moreau_most] = {0};
    for (int i = 0; i < size_of(train); i++) q[i] = train->parts[i].q, v[i] = train->parts[i].v;
    moreau_run(&system, train->until, steps, q, v);
    for (int i = 0; i < size_of(train); i++) end[2 * i] = q[i], end[2 * i + 1] = v[i] / 10;
}

static double apart(int count, const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < 2 * count; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* ---- both */

/* Of several that hold together each is told with its share, within its limit. */
static bool tells_shares(const struct trial *trial)
{
    for (size_t i = 0; i < fbd_simulation_event_count(trial->simulation); i++) {
        fbd_event event = fbd_simulation_event(trial->simulation, i);
        if (event.kind != FBD_EVENT_STICK || !strstr(event.detail, "would take")) continue;
        printf("# at %.9g %s\n", event.t, event.detail);
        return false;
    }
    return true;
}

static bool run_train(const struct train *train, const char *text, double *end)
{
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    bool done = trial.outcome == FBD_DONE;
    if (!done) printf("# %s\n", fbd_simulation_reason(trial.simulation));
    for (int i = 0; i < size_of(train); i++) {
        char name[24];
        bool rack = i == train->wheels;
        snprintf(name, sizeof name, "p%d.%s", i, rack ? "x" : "theta");
        end[2 * i] = trial_get(&trial, name);
        snprintf(name, sizeof name, "p%d.%s", i, rack ? "v" : "omega");
        end[2 * i + 1] = trial_get(&trial, name) / 10;
    }
    done = done && tells_shares(&trial);
    trial_close(&trial);
    return done;
}

/* Does the run end where small steps do? Steps and half steps may agree by chance: then smaller ones are asked. */
static bool agrees(uint64_t seed, bool *sensitive)
{
    enum { first_steps = 20000, most_steps = 640000 };
    const double most = 3e-3, least = 2e-4;
    double end[2 * most_parts], fine[2 * most_parts], coarse[2 * most_parts], off = 0, difference = 0;
    const char *until = getenv("FBD_WHEELS_UNTIL");
    struct train train = draw_train(seed);
    struct written text = {0};
    if (until) train.until = strtod(until, NULL);
    write_train(&train, &text);
    if (getenv("FBD_WHEELS_SHOW")) puts(text.all);
    step_through(&train, first_steps / 2, coarse);
    bool done = run_train(&train, text.all, end);
    for (int steps = first_steps; steps <= most_steps; steps *= 2) {
        step_through(&train, steps, fine);
        off = apart(size_of(&train), fine, coarse);
        difference = apart(size_of(&train), end, fine);
        *sensitive = off > most;
        if (*sensitive || (done && difference <= fmax(10 * off, least))) return true;
        memcpy(coarse, fine, sizeof fine);
    }
    printf("# seed %llu: %g apart, where the steps are off by %g\n%s\n", (unsigned long long)seed, difference,
           off, text.all);
    for (int i = 0; i < size_of(&train); i++)
        printf("# p%d: %.10g, by steps %.10g; v = %.10g, %.10g\n", i, end[2 * i], fine[2 * i],
               10 * end[2 * i + 1], 10 * fine[2 * i + 1]);
    return false;
}

static void time_stepping_says_the_same(void **unused)
{
    (void)unused;
    moreau_compare("FBD_WHEELS", 16, 10, agrees);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(time_stepping_says_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
