/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivations by hand of energy and momentum: what is conserved, works and impulses since the start, impacts.
 *
 * Scenes whose lines are known, with the words by which each fault is named; and random scenes: a line that is true is
 * accepted, one with a term less, of the other sign or with a factor is refused wherever that term does anything.
 * FBD_DRAWS: times as many.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_grade.h"
#include "hand_lines.h"
#include "scenes.h"
#include "thorough.h"

#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- scenes that are known */

static const char push[] =
    "fbd: 1\n"
    "parameters: {F: 20 N, mu: 0.2, w: 1 rad/s}\n"
    "bodies:\n"
    "  block:\n"
    "    mass: 2 kg\n"
    "    motion: slide\n"
    "    initial: {v: 1 m/s}\n"
    "    forces: [gravity, normal, {friction: mu}, {applied: {name: push, value: F*cos(w*t)}}]\n"
    "    hand: [%s]\n"
    "simulate: {until: 3 s}\n";

static const char thrown[] = "fbd: 1\n"
                             "parameters: {h: 1 m}\n"
                             "bodies:\n"
                             "  disk:\n"
                             "    shape: disk\n"
                             "    radius: 0.1 m\n"
                             "    mass: 1.5 kg\n"
                             "    motion: planar\n"
                             "    initial: {y: h, vx: 2 m/s, vy: 3 m/s, omega: 4 rad/s}\n"
                             "    forces: [gravity, {drag: {name: air, linear: 0.5 N*s/m}}]\n"
                             "    hand: [%s]\n"
                             "simulate: {until: 2 s}\n";

static const char bounce[] =
    "fbd: 1\n"
    "parameters: {e: 0.6, h: 2 m}\n"
    "ground: {lines: {floor: {along: 0 deg}}}\n"
    "bodies:\n"
    "  ball:\n"
    "    mass: 1 kg\n"
    "    shape: disk\n"
    "    radius: 0.1 m\n"
    "    motion: planar\n"
    "    initial: {y: h, vx: 1 m/s}\n"
    "    forces: [gravity]\n"
    "    hand: [%s]\n"
    "contacts: [{name: floor, between: [ball, ground.floor], restitution: e, kinetic: 0.1}]\n"
    "simulate: {until: 2 s}\n";

static const char blow[] =
    "fbd: 1\n"
    "parameters: {m1: 2 kg, m2: 3 kg, e: 0.6}\n"
    "ground: {lines: {wall: {through: [4, 0], along: 90 deg}}}\n"
    "bodies:\n"
    "  a: {shape: disk, radius: 0.1 m, mass: m1, motion: slide, initial: {v: 4 m/s},\n"
    "      hand: [%s]}\n"
    "  b: {shape: disk, radius: 0.1 m, mass: m2, motion: slide, initial: {x: 1 m, v: 1 m/s}}\n"
    "contacts:\n"
    "  - {name: blow, between: [a, b], restitution: e}\n"
    "  - {name: wall, between: [b, ground.wall], restitution: e}\n"
    "simulate: {until: 1.8 s}\n";

static const char hoist[] =
    "fbd: 1\n"
    "ground: {points: {top: [2, 0]}}\n"
    "bodies:\n"
    "  block: {mass: 3 kg, motion: slide, initial: {v: 1 m/s}, forces: [gravity, normal, {friction: 0.3}],\n"
    "          hand: [%s]}\n"
    "  weight:\n"
    "    mass: 2 kg\n"
    "    motion: {slide: {along: -90 deg, through: [2, -1]}}\n"
    "    initial: {v: 1 m/s}\n"
    "    forces: [gravity]\n"
    "couplings: [{rope: {name: cord, through: [block.G, ground.top, weight.G]}}]\n"
    "simulate: {until: 0.4 s}\n";

static const char joined[] =
    "fbd: 1\n"
    "parameters: {L: 1 m}\n"
    "bodies:\n"
    "  rod: {shape: rod, mass: 1 kg, length: L, motion: {pivot: {point: left}}, initial: {theta: 20 deg},\n"
    "        forces: [gravity]}\n"
    "  tip: {shape: rod, mass: 2 kg, length: L, motion: {pivot: {on: rod, at: right, point: left}},\n"
    "        initial: {theta: 50 deg, omega: 1 rad/s}, forces: [gravity],\n"
    "        hand: [%s]}\n"
    "simulate: {until: 2 s}\n";

static const char crate[] =
    "fbd: 1\n"
    "ground: {lines: {floor: {along: 0 deg}}}\n"
    "bodies:\n"
    "  crate: {shape: prism, a: 0.4 m, b: 0.6 m, c: 0.3 m, mass: 5 kg, motion: planar, initial: {y: 0.3 m},\n"
    "          forces: [gravity, {applied: {name: push, fx: \"10[N/s]*t\", at: [-0.2 m, 0.2 m]}}],\n"
    "          hand: [%s]}\n"
    "contacts: [{name: floor, between: [crate, ground.floor], static: 0.3, kinetic: 0.3}]\n"
    "simulate: {until: 3 s}\n";

/* A run of the file is far less accurate than the lines are judged. */
static const char coarse[] = "fbd: 1\n"
                             "parameters: {k: 20 N/m}\n"
                             "bodies:\n"
                             "  mass: {mass: 2 kg, motion: slide, initial: {x: 1 m}, forces: [{applied: "
                             "{name: spring, value: -k*x}},\n"
                             "         {drag: {name: air, linear: 0.5 N*s/m}}],\n"
                             "         hand: [%s]}\n"
                             "simulate: {until: 2 s, tolerance: 1e-3, method: rkf45}\n";

/* The file numbers its masses in another order than its bodies. */
static const char swapped[] =
    "fbd: 1\n"
    "parameters: {m1: 2 kg, m2: 3 kg}\n"
    "bodies:\n"
    "  a: {shape: disk, radius: 0.1 m, mass: m2, motion: slide, initial: {v: 4 m/s},\n"
    "      hand: [%s]}\n"
    "  b: {shape: disk, radius: 0.1 m, mass: m1, motion: slide, initial: {x: 1 m, v: 1 m/s}}\n"
    "contacts: [{name: blow, between: [a, b], restitution: 0.5}]\n"
    "simulate: {until: 1 s}\n";

#define KINETIC "m*(G.vx^2 + G.vy^2)/2 + I_G*angle_dot^2/2"

static const struct hand_line lines[] = {
    {push, "m*v^2/2 - m*v0^2/2 = work(push) + work(friction)", true, "holds at"},
    {push, "m*v^2/2 - m*v_0^2/2 = work(push) + work(f)", true, NULL},
    {push, "½ m v² - ½ m v_0² = work(push) + work(friction)", true, "read as: 0.5*m*v^2 - 0.5*m*v_0^2"},
    {push, "m*v^2/2 - m*initial(v)^2/2 = work(push + friction)", true, NULL},
    {push, "{conserved: m*v^2/2 - work(push) - work(friction)}", true, NULL},
    {push, "m*v - m*v0 = impulse(push) - impulse(f)", true, NULL},
    {push, "m*(x - x0) - m*v0*t = 0", false, NULL},
    {push, "m*v^2/2 - m*v0^2/2 = work(push)", false, "the work of `friction` is missing"},
    {push, "m*v^2/2 - m*v0^2/2 = 0", false, "the work of `friction` and `push` is missing"},
    {push, "m*v^2/2 - m*v0^2/2 = work(push) - work(friction)", false, "`work(friction)` has the wrong sign"},
    {push, "m*v^2 - m*v0^2/2 = work(push) + work(friction)", false, "`m*v^2` is right with the factor 0.5"},
    {push, "m*v^2/2 = work(push) + work(friction)", false, NULL},
    {push, "m*v^2/2 - m*v0^2/2 = work(push) + 3*work(friction)", false, "with the factor 0.333333"},
    {push, "m*v^2/2 - m*v0^2/2 = work(push) + work(friction) + work(push)", false,
     "`work(push)` is one too many"},
    {push, "m*v - m*v0 = impulse(push) + impulse(f)", false, "`impulse(f)` has the wrong sign"},
    {push, "m*v - m*v0 = impulse(push)", false, "the impulse of `friction` is missing"},
    {push, "{conserved: m*v^2/2}", false, "it changes by the work of `friction` and `push`"},
    {push, "{conserved: m*v}", false, "it changes by the impulse of `friction` and `push`"},
    {thrown, "{conserved: I_G*omega}", true, NULL},
    {thrown, "{conserved: m*vx^2/2 + m*vy^2/2 + I_G*omega^2/2 + m*g*y - work(air)}", true,
     "`I_G*omega^2/2`: constant"},
    {thrown, "{conserved: m*(vx^2 + vy^2)/2 + m*g*y}", false, "it changes by the work of `air`"},
    {thrown, "{conserved: m*vx^2/2 + m*vy^2/2 - m*g*y - work(air)}", false,
     "with -1 times `m*g*y` it would be"},
    {thrown, "{conserved: m*vx^2/2 + m*vy^2/2 + 2*m*g*y - work(air)}", false, "with 0.5 times `2*m*g*y`"},
    {thrown, "{conserved: m*vx}", false, "it changes by the impulse of `air`"},
    {thrown, "m*(vx^2 + vy^2)/2 - m*(vx0^2 + vy0^2)/2 = work(gravity) + work(air)", true, NULL},
    {thrown, "m*vy = m*initial(vy) + impulse(gravity.y) + impulse(air.y)", true, NULL},
    {thrown, "m*vy = m*vy0 + impulse(gravity.y)", false, "the impulse of `air` is missing"},
    {bounce, "after(vy) = -e*before(vy)", true, "holds at 3 impacts"},
    {bounce, "{equation: after(vy) = -e*before(vy), impact: floor}", true, NULL},
    {bounce, "{equation: after(vy) = -e*before(vy), impact: wall}", false, "not checked: no impact"},
    {bounce, "after(vy) = e*before(vy)", false, "has the wrong sign"},
    {bounce, "after(vy) = -before(vy)", false, NULL},
    {bounce, "m*(vx^2 + vy^2)/2 + I_G*omega^2/2 + m*g*y = m*vx0^2/2 + m*g*h + work(floor)", true, NULL},
    {bounce, "{conserved: m*(vx^2 + vy^2)/2 + I_G*omega^2/2 + m*g*y}", false,
     "it changes by the impact `floor`"},
    {bounce, "m*after(vy) = m*before(vy)", false, "an impulse from outside acts there: `floor`"},
    {blow, "{equation: m1*after(v) + m2*after(b.v) = m1*before(v) + m2*before(b.v), impact: blow}", true,
     "holds at"},
    {blow, "m1*after(v) + m2*after(b.v) = m1*before(v) + m2*before(b.v)", false,
     "from outside acts there: `wall`"},
    {blow, "{equation: m1*after(v) - m2*after(b.v) = m1*before(v) + m2*before(b.v), impact: blow}", false,
     "`m2*after(b.v)` has the wrong sign"},
    {blow, "{equation: m1*after(v) + m2*after(b.v) = m1*before(v), impact: blow}", false, NULL},
    {blow, "{equation: after(b.v) - after(v) = e*(before(v) - before(b.v)), impact: blow}", true, NULL},
    {blow, "{equation: m1*after(v)^2 + m2*after(b.v)^2 = m1*before(v)^2 + m2*before(b.v)^2, impact: blow}",
     false, "the impact takes"},
    {blow, "{conserved: m1*v + m2*b.v}", false, "from outside acts there: `wall`"},
    {blow, "{conserved: m1*v^2/2 + m2*b.v^2/2}", false, "it changes by the impact `blow`"},
    {joined, KINETIC " - initial(" KINETIC ") = work(gravity) + work(pin)", true, NULL},
    {joined, KINETIC " - initial(" KINETIC ") = work(gravity)", false, "the work of `pin` is missing"},
    {joined, "rod.I_O*rod.omega^2/2 = work(rod.gravity) + work(rod.tip.pin)", true, NULL},
    {joined, "{conserved: rod.I_O*rod.omega^2/2 + " KINETIC " + rod.m*g*rod.G.y + m*g*G.y}", true, NULL},
    {joined, "{conserved: rod.I_O*rod.omega^2/2 + " KINETIC " + rod.m*g*rod.G.y}", false,
     "the work of `gravity`"},
    {joined, "m*G.vx = m*initial(G.vx) + impulse(pin.x)", true, NULL},
    {joined, "m*G.vx = m*initial(G.vx) - impulse(pin.x)", false, "`impulse(pin.x)` has the wrong sign"},
    {crate, KINETIC " = work(gravity) + work(push) + work(floor)", true, NULL},
    {crate, KINETIC " = work(gravity) + work(push) + work(floor.friction) + work(floor.friction_2)", true,
     NULL},
    {crate, KINETIC " = work(gravity) + work(push) + work(floor.friction)", false,
     "`floor.friction_2` is missing"},
    {hoist, "m*v^2/2 - m*v0^2/2 = work(cord) + work(friction)", true, NULL},
    {hoist, "m*v^2/2 - m*v0^2/2 = work(friction)", false, "the work of `cord` is missing"},
    {hoist, "m*v - m*v0 = impulse(T) - impulse(f)", true, NULL},
    {hoist, "2.5[kg]*v^2 - 2.5[kg]*v0^2 = weight.m*g*(weight.x - weight.x0) + work(friction)", true, NULL},
    {hoist, "{conserved: (m + weight.m)*v^2/2 - weight.m*g*weight.x}", false,
     "it changes by the work of `friction`"},
    {push, "m*a = F*cos(w*t) - mu*m*g", true, "slip toward +x"},
    {push, "m*a = F*cos(w*t) + mu*m*g", false, "`friction` has the wrong sign"},
    {push, "{equation: m*a = F*cos(w*t) - mu*m*g, when: x > 0}", false, "`friction` has the wrong sign"},
    {push, "{equation: m*a = F*cos(w*t) - mu*m*g, when: v > 0}", true, NULL},
    {hoist, "m*a = -f", false, "of `cord` is missing"},
    {hoist, "m*a + f = 0", false, "of `cord` is missing"},
    {coarse, "m*v^2/2 - m*v0^2/2 = work(spring) + work(air)", true, NULL},
    {coarse, "m*v^2/2 - m*v0^2/2 = work(spring) + 1.001*work(air)", false, "with the factor 0.999001"},
    {coarse, "{conserved: m*v^2/2 + k*x^2/2}", false, "by the work of `air`"},
    {swapped, "m_2*after(v) + m_1*after(b.v) = m_2*before(v) + m_1*before(b.v)", true, NULL},
    {swapped, "m_1*after(v) + m_2*after(b.v) = m_1*before(v) + m_2*before(b.v)", false, NULL},
    {swapped, "m_2*a + m_1*b.a = 0", true, "tell nothing of the factors and signs of `m2*a`, `m1*b.a`"},
    {bounce, "{equation: after(vx) = before(vx), impact: flor}", false,
     "no impact of the run is called `flor`; there is `floor`"},
    {blow, "{equation: after(v) = before(v), impact: wall}", true, "holds at 1 impact"},
    {blow, "{equation: after(v) = e*before(v), impact: wall}", false, NULL},
};

static void lines_of_a_run_are_judged(void **unused)
{
    (void)unused;
    assert_int_equal(hand_lines_wrong(lines, sizeof lines / sizeof *lines), 0);
}

/* ---- lines that cannot be read */

static void lines_that_mix_times_are_refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *line, *id;
        int column;
    } bad[] = {
        {"\"m*after(v) = m*v\"", "not-here", 12},
        {"\"after(v) = v0\"", "not-here", 12},
        {"{conserved: after(v)}", "not-here", 24},
        {"{equation: v = v0, impact: wall}", "not-here", 39},
        {"{conserved: m*v = 1}", "no-equation", 24},
        {"{conserved: m*v, equation: m*v = 1}", "conflicting-keys", 12},
        {"{when: v > 0}", "missing-key", 12},
        {"\"m*v = work(pusher)\"", "unknown-name", 24},
        {"\"m*v = work(push, friction)\"", "argument-count", 19},
        {"\"m*v = after(before(v))\"", "unknown-function", 25},
        {"\"m*v = m*v0 + work(push)\"", "wrong-dimension", 0},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[1200];
        fbd_errors *errors = fbd_errors_new();
        snprintf(text, sizeof text, push, bad[i].line);
        fbd_model *model = fbd_model_parse(text, strlen(text), "model.yaml", NULL, 0, errors);
        if (model) print_error("%s was read\n", bad[i].line);
        assert_null(model);
        fbd_error error = fbd_errors_get(errors, 0);
        if (strcmp(error.id, bad[i].id) != 0 || (bad[i].column > 0 && error.column != bad[i].column))
            print_error("%s: %s at column %d: %s\n", bad[i].line, error.id, error.column, error.message);
        assert_string_equal(error.id, bad[i].id);
        assert_int_equal(error.line, 9);
        if (bad[i].column > 0) assert_int_equal(error.column, bad[i].column);
        fbd_errors_free(errors);
    }
}

/* A parameter of that name comes first. */
static void a_parameter_is_no_initial_value(void **unused)
{
    (void)unused;
    static const char scene[] = "fbd: 1\n"
                                "parameters: {v0: 3 m/s}\n"
                                "bodies:\n"
                                "  block: {mass: 2 kg, motion: slide, initial: {v: 1 m/s}, forces: [{drag: "
                                "{linear: 1 N*s/m}}], hand: [%s]}\n"
                                "simulate: {until: 1 s}\n";
    size_t differing = 0;
    char *verdict = hand_verdict(scene, "m*initial(v) = m*v0/3", &differing);
    assert_int_equal(differing, 0);
    free(verdict);
}

/* ---- grades */

/* A line of the key is met by one that says the same in another form, and by no other. */
static void lines_of_a_run_are_graded(void **unused)
{
    (void)unused;
    static const struct {
        const char *line;
        double points;
    } answers[] = {
        {"m*v^2/2 - m*v0^2/2 = work(push) + work(friction)", 1},
        {"v^2 = v0^2 + 2*work(push)/m + 2*work(friction)/m", 1},
        {"{conserved: m*v^2/2 - work(push) - work(f)}", 1},
        {"m*v^2/2 - m*v0^2/2 = work(push) - work(friction)", 0},
        {"m*v^2/2 - m*v0^2/2 = work(push)", 0},
        {"{conserved: m*v^2/2}", 0},
        {"m*v - m*v0 = impulse(push) - impulse(f)", 0}, /* is right, and something else */
        {"m*v^2/2 + v0 - v0 = m*v^2/2", 0},             /* says nothing */
        {"m*a = push - f", 0},
    };
    char text[1600];
    const char *key_line = "\"m*v^2/2 - m*v0^2/2 = work(push) + work(friction)\"";
    fbd_errors *errors = fbd_errors_new();
    size_t length = (size_t)snprintf(text, sizeof text, push, key_line);
    snprintf(text + length, sizeof text - length, "grading: {points: {force: 0, derivation: 1}}\n");
    fbd_key *key = fbd_key_parse(text, strlen(text), "key.yaml", NULL, 0, errors);
    assert_non_null(key);
    for (size_t i = 0; i < sizeof answers / sizeof *answers; i++) {
        const char *quote = answers[i].line[0] == '{' ? "" : "\"";
        snprintf(text, sizeof text,
                 "bodies: {block: {forces: [gravity, normal, {friction: mu}, {applied: {name: push, value: "
                 "F*cos(w*t)}}], hand: [%s%s%s]}}\n",
                 quote, answers[i].line, quote);
        fbd_grade *grade = fbd_grade_parse(key, text, strlen(text), "anna", errors);
        assert_non_null(grade);
        if (fbd_grade_points(grade) != answers[i].points)
            print_error("%s: %g points\n", answers[i].line, fbd_grade_points(grade));
        assert_true(fbd_grade_points(grade) == answers[i].points);
        fbd_grade_free(grade);
    }
    fbd_key_free(key);
    fbd_errors_free(errors);
}

/* ---- random scenes */

enum { most_forces = 6 };

static double between(gsl_rng *rng, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(rng);
}

/* The works of some forces of a block on a slope; returns their number. */
static int draw_block(gsl_rng *rng, char *scene, size_t size, const char **names)
{
    char forces[900] = "gravity, normal";
    int count = 0;
    names[count++] = "gravity";
    const struct {
        const char *name, *format;
        double low, high;
    } known[] = {{"friction", ", {friction: %.6g}", 0.05, 0.5},
                 {"push", ", {applied: {name: push, value: \"%.6g[N]*cos(2[rad/s]*t)\"}}", 3, 30},
                 {"air", ", {drag: {name: air, quadratic: %.6g N*s^2/m^2}}", 0.05, 0.5},
                 {"spring", ", {spring: {name: spring, stiffness: %.6g N/m}}", 5, 50}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (gsl_rng_uniform(rng) < 0.4) continue;
        size_t length = strlen(forces);
        snprintf(forces + length, sizeof forces - length, known[i].format,
                 between(rng, known[i].low, known[i].high));
        names[count++] = known[i].name;
    }
    snprintf(scene, size,
             "fbd: 1\nbodies:\n  block:\n    mass: %.6g kg\n    motion: {slide: {along: %.6g deg}}\n"
             "    initial: {v: %.6g m/s}\n    forces: [%s]\n    hand: [%%s]\nsimulate: {until: %.6g s}\n",
             between(rng, 0.5, 5), between(rng, 5, 40), between(rng, 1, 6), forces, between(rng, 0.5, 4));
    return count;
}

/* The balance of works, `factors` times each. */
static void write_balance(char *line, size_t size, double kinetic, const char *const *names,
                          const double *factors, int count, bool conserved)
{
    size_t length =
        (size_t)snprintf(line, size, conserved ? "{conserved: %.6g*m*v^2/2" : "%.6g*m*v^2/2 - m*v0^2/2 = 0",
                         kinetic);
    for (int i = 0; i < count; i++)
        if (factors[i] != 0)
            length += (size_t)snprintf(line + length, size - length, " %c %.6g*work(%s)",
                                       (factors[i] < 0) != conserved ? '-' : '+', fabs(factors[i]), names[i]);
    if (conserved) snprintf(line + length, size - length, "}");
}

static bool is_told(const char *verdict, const char *summand)
{
    const char *note = strstr(verdict, "does not verify");
    return !note || !strstr(note, summand);
}

static int judge_block(gsl_rng *rng)
{
    const char *names[most_forces];
    char scene[1600], line[600], summand[80];
    const double wrong[] = {-1, 0, 2, 0.7};
    double factors[most_forces];
    int failed = 0, count = draw_block(rng, scene, sizeof scene, names);
    bool conserved = gsl_rng_uniform(rng) < 0.5;
    size_t differing = 0;
    for (int i = 0; i < count; i++) factors[i] = 1;
    write_balance(line, sizeof line, 1, names, factors, count, conserved);
    char *verdict = hand_verdict(scene, line, &differing);
    if (differing > 0) print_error("%s\n%s should be right: %s\n", scene, line, verdict);
    failed += differing > 0;
    for (int i = 0; i < count; i++) {
        snprintf(summand, sizeof summand, "`1*work(%s)`", names[i]);
        if (!is_told(verdict, summand)) continue;
        factors[i] = wrong[gsl_rng_uniform_int(rng, 4)];
        write_balance(line, sizeof line, 1, names, factors, count, conserved);
        char *other = hand_verdict(scene, line, &differing);
        if (differing == 0) print_error("%s\n%s should be wrong: %s\n", scene, line, other);
        failed += differing == 0;
        free(other);
        factors[i] = 1;
    }
    write_balance(line, sizeof line, 2, names, factors, count, conserved);
    free(verdict);
    verdict = hand_verdict(scene, line, &differing);
    failed += differing == 0;
    free(verdict);
    return failed;
}

static void random_lines_are_judged(void **unused)
{
    (void)unused;
    int failed = 0;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int i = 0; i < draws_of(20); i++) failed += judge_block(rng);
    gsl_rng_free(rng);
    assert_int_equal(failed, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_of_a_run_are_judged),       cmocka_unit_test(lines_that_mix_times_are_refused),
        cmocka_unit_test(a_parameter_is_no_initial_value), cmocka_unit_test(lines_of_a_run_are_graded),
        cmocka_unit_test(random_lines_are_judged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
