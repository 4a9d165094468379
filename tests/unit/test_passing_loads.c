/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Loads of all kinds on bodies of all kinds, one of which begins or ends: a run beside two runs in turn, with and without
 * it.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "random_numbers.h"
#include "run_checks.h"

struct body {
    const char
        *text; /* with the mass, the numbers of its start, then the forces and moments beside its own */
    const char *names[6]; /* of the numbers of its start */
    bool turns, slides;
};

/* Numbers of the start are in the order of `names`, at most six. */
static const struct body bodies[] = {
    {"  b: {mass: 1.3, motion: {slide: {along: 20 deg}}, initial: {x: %.17g, v: %.17g}, forces: [gravity, "
     "normal: {two_sided: true}, "
     "friction: 0.2%s]}\n",
     {"b.x", "b.v"},
     false,
     true},
    {"  b: {shape: rod, length: 1, mass: 1.3, motion: {pivot: {point: [-0.3, 0]}}, initial: {theta: %.17g "
     "rad, omega: "
     "%.17g}, forces: [gravity%s], moments: [damper: 0.1%s]}\n",
     {"b.theta", "b.omega"},
     true,
     false},
    {"  b: {shape: rod, length: 1, mass: 1.3, motion: planar, initial: {x: %.17g, y: %.17g, theta: %.17g "
     "rad, vx: "
     "%.17g, vy: %.17g, omega: %.17g}, forces: [gravity%s], moments: [damper: 0.1%s]}\n",
     {"b.x", "b.y", "b.theta", "b.vx", "b.vy", "b.omega"},
     true,
     false},
    {"  cart: {mass: 2, motion: slide, initial: {x: %.17g, v: %.17g}, forces: [gravity, normal]}\n"
     "  b: {shape: rod, length: 1, mass: 1.3, motion: {pivot: {on: cart, point: [-0.3, 0]}}, initial: "
     "{theta: %.17g rad, omega: "
     "%.17g}, forces: [gravity%s], moments: [damper: 0.1%s]}\n",
     {"cart.x", "cart.v", "b.theta", "b.omega"},
     true,
     false},
    {"  arm: {mass: 2, motion: pivot, inertia: 0.7, initial: {theta: %.17g rad, omega: %.17g}}\n"
     "  b: {mass: 1.3, motion: {slide: {on: arm, along: 50 deg}}, initial: {x: %.17g, v: %.17g}, forces: "
     "[gravity%s]}\n",
     {"arm.theta", "arm.omega", "b.x", "b.v"},
     false,
     true},
};

enum { as_force, as_moment, as_coupling };

static const struct {
    int list;
    bool turning, sliding; /* needs a body that turns, one on a slide */
    const char *text;      /* without its last brace */
} loads[] = {
    {as_force, false, false, "applied: {name: l, value: 4, angle: 70 deg"},
    {as_force, true, false, "applied: {name: l, value: 4, angle: 70 deg, frame: body, at: right"},
    {as_force, true, false, "applied: {name: l, fx: -2, fy: 3, at: {point: left, offset: [0.2, -0.1]}"},
    {as_force, false, false, "applied: {name: l, value: 3, toward: [1, 4]"},
    {as_force, false, true, "applied: {name: l, value: 5"},
    {as_force, false, true, "spring: {name: l, stiffness: 30, neutral: 0.3"},
    {as_force, false, true, "damper: {name: l, coefficient: 3"},
    {as_force, false, false, "spring: {name: l, stiffness: 12, to: [1, 2], free_length: 0.5"},
    {as_force, false, false, "damper: {name: l, coefficient: 2, to: [1, 2]"},
    {as_force, false, false, "drag: {name: l, linear: 0.5, quadratic: 0.4"},
    {as_force, false, false, "drag: {name: l, linear: 0.5, wind: [2, -1]"},
    {as_force, true, false, "drag: {name: l, linear: 0.2, quadratic: 0.4, wind: [2, -1], at: right"},
    {as_moment, true, false, "applied: {name: l, value: 2.5"},
    {as_moment, true, false, "spring: {name: l, stiffness: 6, neutral: 0.2"},
    {as_moment, true, false, "damper: {name: l, coefficient: 0.6"},
    {as_coupling, false, false, "spring: {name: l, between: [b, ground.A], stiffness: 9, free_length: 0.4"},
    {as_coupling, false, false, "damper: {name: l, between: [ground.A, b], coefficient: 1.4"},
    {as_coupling, true, false, "actuator: {name: l, between: [b, ground], moment: 1.7"},
    {as_coupling, false, false, "actuator: {name: l, between: [b, ground.A], force: \"3[N/m]*distance\""},
};

/* The scene with the load, that has `keys`; NULL: without it. */
static void write_body(const struct body *body, int load, const char *keys, const double *start, double until,
                       char *text, size_t size)
{
    const double *y = start;
    const int list = loads[load].list;
    char entry[200] = "", lists[2][202] = {"", ""};
    if (keys) snprintf(entry, sizeof entry, "%s%s}", loads[load].text, keys);
    if (keys && list != as_coupling) snprintf(lists[list], sizeof lists[list], ", %s", entry);
    size_t used = (size_t)snprintf(text, size, "fbd: 1\nground: {points: {A: [2, 1.5]}}\nbodies:\n");
    int numbers = 0;
    while (numbers < 6 && body->names[numbers]) numbers++;
    if (numbers == 2)
        used += (size_t)snprintf(text + used, size - used, body->text, y[0], y[1], lists[0], lists[1]);
    else if (numbers == 4)
        used += (size_t)snprintf(text + used, size - used, body->text, y[0], y[1], y[2], y[3], lists[0],
                                 lists[1]);
    else
        used += (size_t)snprintf(text + used, size - used, body->text, y[0], y[1], y[2], y[3], y[4], y[5],
                                 lists[0], lists[1]);
    if (keys && list == as_coupling)
        used += (size_t)snprintf(text + used, size - used, "couplings: [%s]\n", entry);
    snprintf(text + used, size - used, "simulate: {until: %.17g, tolerance: 1e-12}\n", until);
}

static void run_body(const struct body *body, int load, const char *keys, const double *start, double until,
                     double *end, struct checks *checks)
{
    char text[text_room];
    write_body(body, load, keys, start, until, text, sizeof text);
    struct trial trial = run_of(text);
    for (int i = 0; i < 6 && body->names[i]; i++) end[i] = get(&trial, body->names[i]);
    check_energy(checks, &trial);
    trial_close(&trial);
}

static void loads_pass_on_bodies(void **unused)
{
    const double change = 0.4, end = 0.9;
    struct random_numbers numbers = {(uint64_t)number_of("FBD_SEED", 1)};
    struct checks checks = {0};
    (void)unused;
    for (size_t b = 0; b < sizeof bodies / sizeof *bodies; b++)
        for (int load = 0; load < (int)(sizeof loads / sizeof *loads); load++)
            for (int begins = 0; begins < 2; begins++) {
                double start[6], middle[6], apart[6], whole[6];
                char keys[60];
                if ((loads[load].turning && !bodies[b].turns) || (loads[load].sliding && !bodies[b].slides))
                    continue;
                for (int i = 0; i < 6; i++) start[i] = random_between(&numbers, -1, 1);
                snprintf(keys, sizeof keys, ", %s: t > %.17g s", begins ? "from" : "until", change);
                const size_t failed = checks.failed;
                run_body(&bodies[b], load, begins ? NULL : "", start, change, middle, &checks);
                run_body(&bodies[b], load, begins ? "" : NULL, middle, end - change, apart, &checks);
                run_body(&bodies[b], load, keys, start, end, whole, &checks);
                for (int i = 0; i < 6 && bodies[b].names[i]; i++)
                    check_close(&checks, bodies[b].names[i], whole[i], apart[i], same * (1 + fabs(apart[i])));
                if (checks.failed > failed) printf("body %zu, %s%s}\n", b, loads[load].text, keys);
            }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loads_pass_on_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
