/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivations by hand of impacts: velocities before and after, impulses of contacts and ropes, their works.
 * FBD_DRAWS: times as many random scenes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hand_lines.h"
#include "thorough.h"

#include <gsl/gsl_rng.h>
#include <stdio.h>
#include <stdlib.h>

/* A disc that spins, on a rough floor; two that meet off centre; a block that lands on two corners; a rope that becomes taut. */
static const char spinning[] =
    "fbd: 1\n"
    "ground: {lines: {floor: {through: [0, 0], along: 0}}}\n"
    "bodies:\n"
    "  ball: {shape: sphere, mass: 2 kg, radius: 0.1 m, motion: planar, forces: [gravity],\n"
    "         initial: {y: 1 m, vx: 2 m/s, omega: 5 rad/s}, hand: [%s]}\n"
    "contacts: [{name: floor, between: [ball, ground.floor], restitution: 0.6, static: 0.3, kinetic: 0.3}]\n"
    "simulate: {until: 1.5 s}\n";
static const char oblique[] =
    "fbd: 1\n"
    "bodies:\n"
    "  a: {shape: disk, mass: 2 kg, radius: 0.1 m, motion: planar, initial: {vx: 3 m/s, omega: 4 rad/s},\n"
    "      hand: [%s]}\n"
    "  b: {shape: disk, mass: 3 kg, radius: 0.1 m, motion: planar, initial: {x: 1 m, y: 0.08 m}}\n"
    "contacts: [{name: blow, between: [a, b], restitution: 0.7, static: 0.2, kinetic: 0.2}]\n"
    "simulate: {until: 0.5 s}\n";
static const char landing[] =
    "fbd: 1\n"
    "ground: {lines: {floor: {through: [0, 0], along: 0}}}\n"
    "bodies:\n"
    "  crate: {shape: prism, a: 0.4 m, b: 0.2 m, mass: 2 kg, motion: planar, forces: [gravity],\n"
    "          initial: {y: 0.5 m}, hand: [%s]}\n"
    "contacts: [{name: floor, between: [crate, ground.floor]}]\n"
    "simulate: {until: 0.5 s}\n";
static const char tow[] = "fbd: 1\n"
                          "bodies:\n"
                          "  a: {mass: 2 kg, motion: slide, initial: {x: 0.5 m, v: 4 m/s}, hand: [%s]}\n"
                          "  b: {mass: 3 kg, motion: slide, initial: {v: 1 m/s}}\n"
                          "couplings: [{rope: {name: tow, through: [a.G, b.G], length: 1 m}}]\n"
                          "simulate: {until: 1 s}\n";

static const struct hand_line lines[] = {
    {spinning, "m*after(vy) - m*before(vy) = impulse(N)", true, "holds at 4 impacts"},
    {spinning, "m*after(vy) - m*before(vy) = -impulse(N)", false, "`impulse(N)` has the wrong sign"},
    {spinning, "m*after(vx) - m*before(vx) = -impulse(f)", true, NULL},
    {spinning, "I_G*(after(omega) - before(omega)) = -0.1[m]*impulse(f)", true, NULL},
    {spinning, "I_G*(after(omega) - before(omega)) = 0.1[m]*impulse(f)", false, NULL},
    {spinning, "m*vy - m*vy0 = impulse(N) - m*g*t", true, NULL},
    {oblique, "m*after(vy) - m*before(vy) = impulse(blow.normal.y) + impulse(blow.friction.y)", true, NULL},
    {oblique, "m*after(vy) - m*before(vy) = impulse(blow.normal.y) - impulse(blow.friction.y)", false,
     "`impulse(blow.friction.y)` has the wrong sign"},
    {oblique, "I_G*(after(omega) - before(omega)) = -0.1[m]*impulse(blow.friction)", true, NULL},
    {oblique,
     "m*(after(vx)^2 + after(vy)^2)/2 + I_G*after(omega)^2/2 = m*before(vx)^2/2 + I_G*before(omega)^2/2 + "
     "work(blow)",
     true, NULL},
    {landing, "m*after(vy) - m*before(vy) = impulse(floor.normal) + impulse(floor.normal_2)", true, NULL},
    {landing, "m*after(vy) - m*before(vy) = 2*impulse(floor.normal)", true, NULL},
    {landing, "m*after(vy) - m*before(vy) = impulse(floor.normal)", false, NULL},
    {tow, "m*after(v) - m*before(v) = -impulse(T)", true, NULL},
    {tow, "m*after(v) - m*before(v) = impulse(tow.x)", true, NULL},
    {tow, "m*after(v) - m*before(v) = impulse(T)", false, "wrong sign"},
    {tow, "m*v^2/2 + b.m*b.v^2/2 - m*v0^2/2 - b.m*b.v0^2/2 = work(tow) + work(b.tow)", true, NULL},
};

static void impulses_of_an_impact_are_known(void **unused)
{
    (void)unused;
    assert_int_equal(hand_lines_wrong(lines, sizeof lines / sizeof *lines), 0);
}

static double between(gsl_rng *rng, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(rng);
}

/* Two bodies strike each other: three true lines, and each with a fault. */
static int judge_blow(gsl_rng *rng)
{
    static const struct {
        const char *line;
        bool right;
    } known[] = {
        {"a.m*after(v) + b.m*after(b.v) = a.m*before(v) + b.m*before(b.v)", true},
        {"a.m*after(v) + b.m*after(b.v) = a.m*before(v) - b.m*before(b.v)", false},
        {"b.m*after(v) + a.m*after(b.v) = b.m*before(v) + a.m*before(b.v)", false},
        {"a.m*after(v) + b.m*after(b.v) = a.m*before(v)", false},
        {"after(b.v) - after(v) = e*(before(v) - before(b.v))", true},
        {"after(b.v) - after(v) = before(v) - before(b.v)", false},
        {"after(b.v) + after(v) = e*(before(v) - before(b.v))", false},
        {"a.m*after(v)^2/2 + b.m*after(b.v)^2/2 = a.m*before(v)^2/2 + b.m*before(b.v)^2/2", false},
        {"m*after(v) - m*before(v) = -impulse(blow.normal)", true},
        {"m*after(v) - m*before(v) = impulse(blow.normal)", false},
        {"b.m*after(b.v) - b.m*before(b.v) = impulse(b.blow.normal)", true},
        {"m*after(v)^2/2 - m*before(v)^2/2 = work(blow.normal)", true},
        {"m*after(v)^2/2 - m*before(v)^2/2 = work(b.blow.normal)", false},
        {"b.m*b.v^2/2 - b.m*b.v0^2/2 = work(b.blow.normal)", true},
        {"{conserved: a.m*v + b.m*b.v}", true},
        {"{conserved: a.m*v - b.m*b.v}", false},
        {"{conserved: a.m*v^2 + b.m*b.v^2}", false},
    };
    char scene[1200];
    int failed = 0;
    double first = between(rng, 0.5, 5);
    snprintf(
        scene, sizeof scene,
        "fbd: 1\nparameters: {e: %.6g}\nbodies:\n"
        "  a: {shape: disk, radius: 0.1 m, mass: %.6g kg, motion: slide, initial: {v: %.6g m/s}, hand: "
        "[%%s]}\n"
        "  b: {shape: disk, radius: 0.1 m, mass: %.6g kg, motion: slide, initial: {x: 1 m, v: %.6g m/s}}\n"
        "contacts: [{name: blow, between: [a, b], restitution: e}]\nsimulate: {until: 2 s}\n",
        between(rng, 0.1, 0.9), first, between(rng, 2, 5), first + between(rng, 0.2, 3),
        between(rng, 0.2, 1));
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        size_t differing = 0;
        char *verdict = hand_verdict(scene, known[i].line, &differing);
        bool fine = (differing == 0) == known[i].right;
        if (!fine)
            print_error("%s\n%s should be %s: %s\n", scene, known[i].line, known[i].right ? "right" : "wrong",
                        verdict);
        failed += !fine;
        free(verdict);
    }
    return failed;
}

static void random_impacts_are_judged(void **unused)
{
    (void)unused;
    int failed = 0;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int i = 0; i < draws_of(20); i++) failed += judge_blow(rng);
    gsl_rng_free(rng);
    assert_int_equal(failed, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(impulses_of_an_impact_are_known),
        cmocka_unit_test(random_impacts_are_judged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
