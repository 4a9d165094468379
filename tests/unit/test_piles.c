/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random piles of boxes and discs on a floor or a slope: they fall on each other, bounce, rock, slide, jam and come to
 * rest. Each is to come to its end, with no energy made and, as an independent look at the corners shows, nothing below
 * the floor. FBD_PILES=1000 FBD_PILE_SEED=1 looks at that many of a seed, of FBD_PILE_FROM to FBD_PILE_TO bodies (2 to 4; 12 at most);
 * FBD_PILE_ONLY=7 prints the model of number 7 and looks at nothing else.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>

#include "gallery.h"
#include "random_numbers.h"

enum { most_bodies = 12, room = 20000 };

struct pile {
    int count;
    bool disc[most_bodies];
    double a[most_bodies], b[most_bodies]; /* sides; the diameter of a disc */
    double slope, mu, e;
};

/* One above the other, apart by up to 0.1 m, turned or not. */
static void draw_pile(struct random_numbers *numbers, int least, int most, struct pile *pile, char *text)
{
    double y = 0;
    *pile = (struct pile){.count = least + (int)(random_bits(numbers) % (unsigned)(most - least + 1))};
    pile->slope = random_bits(numbers) % 3 == 0 ? random_between(numbers, -0.17, 0.17) : 0;
    pile->mu = random_between(numbers, 0.2, 0.9);
    pile->e = random_bits(numbers) % 2 == 0 ? 0 : random_between(numbers, 0, 0.5);
    int length =
        snprintf(text, room, "fbd: 1\nground: {lines: {floor: {along: %.17g}}}\nbodies:\n", pile->slope);
    for (int i = 0; i < pile->count; i++) {
        pile->disc[i] = random_bits(numbers) % 10 < 3;
        pile->a[i] = random_between(numbers, 0.3, 1);
        pile->b[i] = random_between(numbers, 0.2, 0.8);
        double turn = random_bits(numbers) % 3 == 0 ? random_between(numbers, -0.35, 0.35) : 0;
        double x = random_between(numbers, -0.1, 0.1), mass = random_between(numbers, 0.5, 3);
        double high = pile->disc[i] ? pile->a[i] : fabs(pile->a[i] * sin(turn)) + pile->b[i] * cos(turn);
        y += random_between(numbers, 0, 0.1) + high / 2 + (i == 0 ? fabs(tan(pile->slope)) : 0);
        length += snprintf(text + length, (size_t)(room - length), "  b%d: {shape: %s, ", i,
                           pile->disc[i] ? "disc" : "prism");
        if (pile->disc[i])
            length += snprintf(text + length, (size_t)(room - length), "radius: %.17g, ", pile->a[i] / 2);
        else
            length += snprintf(text + length, (size_t)(room - length), "a: %.17g, b: %.17g, c: 1, ",
                               pile->a[i], pile->b[i]);
        length += snprintf(
            text + length, (size_t)(room - length),
            "mass: %.17g, motion: planar, initial: {x: %.17g, y: %.17g, theta: %.17g}, forces: [gravity]}\n",
            mass, x, y, turn);
        y += high / 2;
    }
    length += snprintf(text + length, (size_t)(room - length), "contacts:\n");
    for (int i = 0; i < pile->count; i++)
        for (int j = -1; j < i; j++) {
            char with[20] = "ground.floor";
            if (j >= 0) snprintf(with, sizeof with, "b%d", j);
            length += snprintf(text + length, (size_t)(room - length),
                               "  - {between: [b%d, %s], static: %.17g, restitution: %.17g}\n", i, with,
                               pile->mu, pile->e);
        }
    snprintf(text + length, (size_t)(room - length), "simulate: {until: 3 s}\n");
}

/* The least height of a body over the floor, along its normal. */
static double height_of(const struct trial *trial, const struct pile *pile, int i)
{
    char names[3][24];
    const char *const of[] = {"x", "y", "theta"};
    double q[3], s = sin(pile->slope), c = cos(pile->slope);
    for (int k = 0; k < 3; k++) {
        snprintf(names[k], sizeof names[k], "b%d.%s", i, of[k]);
        q[k] = trial_get(trial, names[k]);
    }
    double middle = -s * q[0] + c * q[1], turn = q[2] - pile->slope;
    if (pile->disc[i]) return middle - pile->a[i] / 2;
    return middle - (fabs(pile->a[i] * sin(turn)) + fabs(pile->b[i] * cos(turn))) / 2;
}

/* Of a body at rest all forces of its diagram add up to nothing, in moment about the origin too, and surfaces press. */
static void check_rest(struct checks *checks, struct trial *trial, const struct pile *pile)
{
    enum { most_arrows = 80 };
    for (int b = 0; b < pile->count; b++) {
        fbd_arrow arrows[most_arrows];
        size_t count = fbd_diagram(trial->state, (size_t)b, arrows, most_arrows);
        double fx = 0, fy = 0, moment = 0, size = 0;
        assert_true(count <= most_arrows);
        for (size_t i = 0; i < count; i++) {
            fx += arrows[i].fx;
            fy += arrows[i].fy;
            moment += arrows[i].x * arrows[i].fy - arrows[i].y * arrows[i].fx + arrows[i].couple;
            size = fmax(size, hypot(arrows[i].fx, arrows[i].fy));
        }
        check_close(checks, "sum of fx", fx, 0, 1e-9 * size);
        check_close(checks, "sum of fy", fy, 0, 1e-9 * size);
        check_close(checks, "sum of moments", moment, 0, 1e-8 * size);
    }
}

static int number_of(const char *name, int otherwise)
{
    const char *given = getenv(name);
    return given ? atoi(given) : otherwise;
}

static void piles_fall_down_and_come_to_rest(void **unused)
{
    int count = number_of("FBD_PILES", 40), only = number_of("FBD_PILE_ONLY", -1), tried = 0, done = 0,
        rest = 0;
    struct random_numbers numbers = {(uint64_t)number_of("FBD_PILE_SEED", 20261124)};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < count; i++) {
        struct pile pile;
        char text[room];
        draw_pile(&numbers, number_of("FBD_PILE_FROM", 2), number_of("FBD_PILE_TO", 4), &pile, text);
        if (only >= 0 && only != i) continue;
        if (only >= 0) puts(text);
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        tried++;
        if (trial.outcome == FBD_DONE) {
            fbd_energy energy = fbd_result_energy(trial.result);
            double start = energy.initial_kinetic + energy.initial_potential;
            done++;
            check_that(&checks, "no energy is made",
                       energy.kinetic + energy.potential <= start + 1e-9 * fabs(start));
            if (energy.kinetic < 1e-20) {
                rest++;
                check_rest(&checks, &trial, &pile);
            }
            for (int k = 0; k < pile.count; k++)
                check_that(&checks, "nothing is below the floor", height_of(&trial, &pile, k) >= -1e-8);
        } else {
            print_message("# pile %d: %s\n", i, fbd_simulation_reason(trial.simulation));
        }
        trial_close(&trial);
    }
    print_message("# %d of %d piles came to their ends, %d to rest\n", done, tried, rest);
    check_that(&checks, "many rest", only >= 0 || 4 * rest > tried);
    check_that(&checks, "all do", done == tried);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(piles_fall_down_and_come_to_rest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
