/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random weights that hang in ropes over pulleys with dry friction in their bearings: rows of two or three over fixed
 * pulleys, a drum that winds one or two, a hoist whose lower pulley hangs in the rope; with stops, springs, dampers and
 * pushes, so that ropes get slack and taut on either side of a pulley; against a time stepping that knows no events
 * (moreau.h). FBD_HOISTS=1000 tries so many, FBD_HOISTS_SEED=17 begins there, FBD_HOISTS_SHOW=1 prints the models.
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

enum { most_coordinates = 5, most_gaps = 16 };

static const double g = 10, high = 20; /* where the pulleys are */

/* w . q >= off, a stop or one side of a rope. */
struct gap {
    double w[most_coordinates], off;
};

struct coordinate {
    char name[20], rate[20];
    double inertia, weight, q, v;
    double A, w, phase, B; /* of its push */
    double k, neutral, c;  /* spring and damper */
    double rub, rub_speed; /* of its bearing [N m, rad/s] */
};

struct hoist {
    int count, gaps;
    double until;
    struct coordinate at[most_coordinates];
    struct gap gap[most_gaps];
    struct written text;
};

/* ---- parts */

static struct coordinate *new_coordinate(struct random_numbers *numbers, struct hoist *hoist,
                                         const char *body, bool turns, double inertia, double size)
{
    struct coordinate *at = &hoist->at[hoist->count++];
    snprintf(at->name, sizeof at->name, "%s.%s", body, turns ? "theta" : "x");
    snprintf(at->rate, sizeof at->rate, "%s.%s", body, turns ? "omega" : "v");
    at->inertia = inertia;
    at->A = random_perhaps(numbers, 0.6, 0, size);
    at->w = random_between(numbers, 0.5, 12);
    at->phase = random_between(numbers, 0, 6);
    at->B = random_perhaps(numbers, 0.5, -size / 2, size / 2);
    return at;
}

/* w . q stays above what it is at the start. */
static struct gap *new_gap(struct hoist *hoist, int i, double w)
{
    struct gap *gap = &hoist->gap[hoist->gaps++];
    *gap = (struct gap){0};
    gap->w[i] = w;
    gap->off = w * hoist->at[i].q;
    return gap;
}

static void add_push(struct hoist *hoist, const struct coordinate *at)
{
    add(&hoist->text, "      - applied: {name: push, value: \"%.17g*sin(%.17g*t + %.17g) + %.17g\"}\n", at->A,
        at->w, at->phase, at->B);
}

/* A mass on a vertical slide, that carries `more` beside its own mass. */
static void add_weight(struct random_numbers *numbers, struct hoist *hoist, const char *body, double across,
                       double v, double more)
{
    double mass = exp(random_between(numbers, -1, 1)), size = (mass + more) * g;
    int i = hoist->count;
    struct coordinate *at = new_coordinate(numbers, hoist, body, false, mass + more, size);
    at->weight = size;
    at->q = random_between(numbers, -0.5, 0.5);
    at->v = v;
    at->k = random_perhaps(numbers, 0.25, 1, 40) * mass;
    at->neutral = random_between(numbers, -0.5, 0.5);
    at->c = random_perhaps(numbers, 0.2, 0, 2) * mass;
    bool stops[2] = {random_chance(numbers, 0.4), random_chance(numbers, 0.3)};
    add(&hoist->text, "  %s:\n    mass: %.17g\n    motion: {slide: {along: 90 deg, through: [%.17g, 0]", body,
        mass, across);
    for (int k = 0; k < 2; k++) {
        double far = random_between(numbers, 0.01, 0.5);
        if (!stops[k]) continue;
        new_gap(hoist, i, k ? -1 : 1)->off -= far;
        add(&hoist->text, ", %s: %.17g", k ? "max" : "min", k ? at->q + far : at->q - far);
    }
    add(&hoist->text, "}}\n    initial: {x: %.17g, v: %.17g}\n    forces:\n      - gravity\n", at->q, v);
    add_push(hoist, at);
    add(&hoist->text,
        "      - spring: {stiffness: %.17g, neutral: %.17g}\n      - damper: {coefficient: %.17g}\n", at->k,
        at->neutral, at->c);
}

/* `where` has the keys of its pivot. */
static double add_pulley(struct random_numbers *numbers, struct hoist *hoist, const char *body, double r,
                         const char *where, double omega, double load)
{
    double mass = exp(random_between(numbers, -1.5, 0.5));
    struct coordinate *at = new_coordinate(numbers, hoist, body, true, mass * r * r / 2, load * r * 0.3);
    at->v = omega;
    at->rub = random_perhaps(numbers, 0.7, 0.01, 0.3) * load * r;
    at->rub_speed = random_perhaps(numbers, 0.2, -3, 3);
    add(&hoist->text,
        "  %s:\n    shape: disc\n    radius: %.17g\n    mass: %.17g\n    motion: {pivot: {%s}}\n    initial: "
        "{omega: "
        "%.17g}\n    forces: [gravity]\n    moments:\n",
        body, r, mass, where, omega);
    add_push(hoist, at);
    if (at->rub > 0)
        add(&hoist->text, "      - friction: {coefficient: %.17g, surface_speed: %.17g}\n", at->rub,
            at->rub_speed);
    return mass;
}

/* ---- scenes */

/* Weights 0 to n - 1, pulleys n to 2 n - 2; each rope goes from a weight to the next. */
static void draw_row(struct random_numbers *numbers, struct hoist *hoist)
{
    int weights = 2 + random_chance(numbers, 0.4);
    double r[2] = {random_between(numbers, 0.1, 0.3), random_between(numbers, 0.1, 0.3)}, across = 0,
           load = 0;
    double v = random_perhaps(numbers, 0.7, -2, 2);
    for (int i = 0; i < weights; i++) {
        char name[4] = {'w', (char)('0' + i)};
        add_weight(numbers, hoist, name, across, i % 2 ? -v : v, 0);
        load += hoist->at[i].weight;
        across += 2 * r[i % 2];
    }
    across = 0;
    for (int i = 0; i + 1 < weights; i++) {
        char name[4] = {'p', (char)('0' + i)}, where[60];
        snprintf(where, sizeof where, "at: [%.17g, %g]", across + r[i], high);
        add_pulley(numbers, hoist, name, r[i], where, (i % 2 ? v : -v) / r[i], load / 2);
        for (int side = 0; side < 2; side++)
            new_gap(hoist, i + side, 1)->w[weights + i] = side ? -r[i] : r[i];
        across += 2 * r[i];
    }
    add(&hoist->text, "couplings:\n");
    for (int i = 0; i + 1 < weights; i++)
        add(&hoist->text, "  - rope: {through: [w%d, p%d, w%d]}\n", i, i, i + 1);
}

static void draw_drum(struct random_numbers *numbers, struct hoist *hoist)
{
    int weights = 1 + random_chance(numbers, 0.6);
    double r[2], omega = random_perhaps(numbers, 0.7, -5, 5);
    bool right[2];
    char where[40];
    snprintf(where, sizeof where, "at: [0, %g]", high);
    add_pulley(numbers, hoist, "drum", 0.4, where, omega, 20);
    for (int i = 0; i < weights; i++) {
        char name[4] = {'w', (char)('0' + i)};
        right[i] = random_chance(numbers, 0.5);
        r[i] = random_between(numbers, 0.1, 0.4);
        double arm = right[i] ? r[i] : -r[i], faster = random_perhaps(numbers, 0.5, 0, 1);
        add_weight(numbers, hoist, name, arm, arm * omega + faster, 0);
        new_gap(hoist, 1 + i, 1)->w[0] = -arm;
    }
    add(&hoist->text, "couplings:\n");
    for (int i = 0; i < weights; i++)
        add(&hoist->text,
            "  - rope: {through: [drum, w%d], wound: {on: drum, side: %s, radius: %.17g, length: 20}}\n", i,
            right[i] ? "right" : "left", r[i]);
}

/* A rope from the ground under a pulley that hangs in it, over another one, to a weight. */
static void draw_tackle(struct random_numbers *numbers, struct hoist *hoist)
{
    double r = random_between(numbers, 0.1, 0.3), s = random_between(numbers, 0.1, 0.3), load = 20,
           v = random_perhaps(numbers, 0.7, -1, 1);
    char where[60];
    add_weight(numbers, hoist, "carriage", 0, v, 0);
    double mass = add_pulley(numbers, hoist, "sheave", r, "on: carriage", v / r, load);
    hoist->at[0].inertia += mass;
    hoist->at[0].weight += mass * g;
    snprintf(where, sizeof where, "at: [%.17g, %g]", r + s, high);
    add_pulley(numbers, hoist, "top", s, where, -2 * v / s, load);
    add_weight(numbers, hoist, "weight", r + 2 * s, -2 * v, 0);
    new_gap(hoist, 0, 1)->w[1] = -r;
    struct gap *between = new_gap(hoist, 0, 1);
    between->w[1] = r;
    between->w[2] = s;
    new_gap(hoist, 3, 1)->w[2] = -s;
    add(&hoist->text, "couplings:\n  - rope: {through: [ground.nail, sheave, top, weight]}\n");
    add(&hoist->text, "ground: {points: {nail: [%.17g, %g]}}\n", -r, high);
}

static void draw_hoist(uint64_t seed, struct hoist *hoist)
{
    static void (*const draws[])(struct random_numbers *, struct hoist *) = {draw_row, draw_drum,
                                                                             draw_tackle};
    struct random_numbers numbers = {seed};
    *hoist = (struct hoist){.until = random_between(&numbers, 0.4, 1.5)};
    add(&hoist->text, "fbd: 1\ngravity: %g\nbodies:\n", g);
    draws[seed % (sizeof draws / sizeof *draws)](&numbers, hoist);
    add(&hoist->text, "simulate: {until: %.17g}\n", hoist->until);
}

/* ---- the same for the time stepping */

static void forces(const void *scene, double t, const double *q, const double *v, double *f)
{
    const struct hoist *hoist = scene;
    for (int i = 0; i < hoist->count; i++) {
        const struct coordinate *at = &hoist->at[i];
        f[i] = at->A * sin(at->w * t + at->phase) + at->B - at->weight - at->k * (q[i] - at->neutral) -
               at->c * v[i];
    }
}

static void solve(const void *scene, const double *q, double *b)
{
    const struct hoist *hoist = scene;
    (void)q;
    for (int i = 0; i < hoist->count; i++) b[i] /= hoist->at[i].inertia;
}

static void find_rows(const void *scene, double t, const double *q, struct moreau_rows *rows)
{
    const struct hoist *hoist = scene;
    (void)t;
    for (int i = 0; i < hoist->count; i++) {
        const struct coordinate *at = &hoist->at[i];
        struct moreau_row row = {.kind = moreau_rub, .aim = at->rub_speed, .most = at->rub, .normal = -1};
        row.w[i] = 1;
        if (at->rub > 0) rows->row[rows->count++] = row;
    }
    for (int k = 0; k < hoist->gaps; k++) {
        const struct gap *gap = &hoist->gap[k];
        struct moreau_row row = {.kind = moreau_gap, .normal = -1};
        double left = -gap->off;
        for (int i = 0; i < hoist->count; i++) left += (row.w[i] = gap->w[i]) * q[i];
        if (left <= 0) rows->row[rows->count++] = row;
    }
}

/* Places, and a tenth of the velocities. */
static void step_through(const struct hoist *hoist, int steps, double *end)
{
    const struct moreau_system system = {hoist->count, hoist, forces, solve, find_rows, NULL};
    double q[moreau_most] = {0}, v[moreau_most] = {0};
    for (int i = 0; i < hoist->count; i++) q[i] = hoist->at[i].q, v[i] = hoist->at[i].v;
    moreau_run(&system, hoist->until, steps, q, v);
    for (int i = 0; i < hoist->count; i++) end[2 * i] = q[i], end[2 * i + 1] = v[i] / 10;
}

static double apart(int count, const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < 2 * count; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* ---- both */

static bool run_hoist(const struct hoist *hoist, double *end)
{
    struct trial trial = trial_parse(hoist->text.all);
    trial_run(&trial, NULL);
    bool done = trial.outcome == FBD_DONE;
    if (!done) printf("# %s\n", fbd_simulation_reason(trial.simulation));
    for (int i = 0; i < hoist->count; i++) {
        end[2 * i] = trial_get(&trial, hoist->at[i].name);
        end[2 * i + 1] = trial_get(&trial, hoist->at[i].rate) / 10;
    }
    trial_close(&trial);
    return done;
}

/* Does the run end where small steps do? Steps and half steps may agree by chance: then smaller ones are asked. */
static bool agrees(uint64_t seed, bool *sensitive)
{
    enum { first_steps = 8000, most_steps = 256000, values = 2 * most_coordinates };
    const double most = 3e-3, least = 3e-4;
    static struct hoist hoist;
    double end[values], fine[values], coarse[values], off = 0, difference = 0;
    draw_hoist(seed, &hoist);
    if (getenv("FBD_HOISTS_SHOW")) puts(hoist.text.all);
    step_through(&hoist, first_steps / 2, coarse);
    bool done = run_hoist(&hoist, end);
    for (int steps = first_steps; steps <= most_steps; steps *= 2) {
        step_through(&hoist, steps, fine);
        off = apart(hoist.count, fine, coarse);
        difference = apart(hoist.count, end, fine);
        *sensitive = off > most;
        if (*sensitive || (done && difference <= fmax(10 * off, least))) return true;
        memcpy(coarse, fine, sizeof fine);
    }
    printf("# seed %llu: %g apart, where the steps are off by %g\n%s\n", (unsigned long long)seed, difference,
           off, hoist.text.all);
    for (int i = 0; i < hoist.count; i++)
        printf("# %s: %.10g, by steps %.10g; %.10g, %.10g\n", hoist.at[i].name, end[2 * i], fine[2 * i],
               10 * end[2 * i + 1], 10 * fine[2 * i + 1]);
    return false;
}

static void time_stepping_says_the_same(void **unused)
{
    (void)unused;
    moreau_compare("FBD_HOISTS", 18, 10, agrees);
}

/* A pulley comes to rest while its rope is slack by 1e-9 of its length: that is taut, and what gives way to it is the pulley.
 * (It was the weight, which went so far into its stop, and the run ended there when the stop opened.) */
static void what_is_next_to_taut_is_put_there(void **unused)
{
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "gravity: 10\n"
        "ground: {points: {nail: [-0.22727359132228858, 8]}}\n"
        "bodies:\n"
        "  carriage:\n"
        "    mass: 1.0550889471457847\n"
        "    motion: {slide: {along: 90 deg, max: 0.64673513430228136}}\n"
        "    initial: {x: 0.49573068063353398, v: 0}\n"
        "    forces:\n"
        "      - gravity\n"
        "      - applied: {name: push, value: \"4.1099213177780571*sin(7.8072829619801949*t + "
        "0.57489337644459115) + 6.8486957684596472\"}\n"
        "  sheave:\n"
        "    shape: disc\n"
        "    radius: 0.22727359132228858\n"
        "    mass: 0.33822938921016216\n"
        "    motion: {pivot: {on: carriage}}\n"
        "    initial: {omega: 0}\n"
        "    forces: [gravity]\n"
        "    moments:\n"
        "      - applied: {name: turn, value: \"0.039538660543646652*sin(2.3720703674162258*t + "
        "4.3981788990236792) + 0.57436600060516363\"}\n"
        "      - friction: 1.5431486979348055\n"
        "  top:\n"
        "    shape: disc\n"
        "    radius: 0.21173621039704399\n"
        "    mass: 0.34767477220935361\n"
        "    motion: {pivot: {at: [0.43900980171933257, 8]}}\n"
        "    initial: {omega: -0}\n"
        "    moments:\n"
        "      - applied: {name: turn, value: \"0.8317781671374106*sin(1.9681983932543377*t + "
        "1.6003197553671178) + 0.07601104214292298\"}\n"
        "      - friction: 0.55973485298877235\n"
        "  weight:\n"
        "    mass: 1.9647696606341256\n"
        "    motion: {slide: {along: 90 deg, through: [0.65074601211637662, 0], min: 0.37558440401533305}}\n"
        "    initial: {x: 0.44849193829706102, v: -0}\n"
        "    forces:\n"
        "      - gravity\n"
        "      - applied: {name: push, value: \"8.9732522151484133*sin(2.4965117720062451*t + "
        "5.5070593842979321) + -3.796103858459297\"}\n"
        "couplings:\n"
        "  - rope: {name: fall, through: [ground.nail, sheave, top, weight]}\n"
        "simulate: {until: 0.80458457932525129}\n");
    (void)unused;
    trial_start(&trial, NULL);
    trial_to(&trial, 0.3);
    check_close(&checks, "the weight on its stop", trial_get(&trial, "weight.x"), 0.37558440401533305, 1e-12);
    trial_finish(&trial);
    check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_next_to_taut_is_put_there),
        cmocka_unit_test(time_stepping_says_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
