/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Actuators between two bodies of random trees and loops, with dry friction and a user state, written twice: as
 * couplings, and as forces that each body lists, by expressions of places in the world. A moment is there two opposite
 * forces, a force on a line its components, a guided force one whose place moves through the second body. Both have the
 * same accelerations and exact derivatives, and now and then the same run and the same works. FBD_MOTORS=2000 tries so
 * many scenes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "dynamics/forward.h"
#include "dynamics/modes.h"
#include "gallery.h"
#include "model/model.h"
#include "output/equations.h"
#include "random_trees.h"
#include "rest/balance.h"
#include "scene_fixture.h"
#include "thorough.h"

enum { most_motors = 3, text_room = 3000 };

enum what { on_turning, on_line, on_guide, kinds };

/* An actuator as a coupling, and as entries of `forces` of the bodies at its ends. */
struct motor {
    enum what what;
    int body[2]; /* the second one -1 for the ground */
    char coupling[text_room], force[2][text_room];
};

struct drawn {
    char *tree; /* without motors */
    int bodies, count;
    struct motor motors[most_motors];
};

static int pick(struct random_numbers *numbers, int count)
{
    return (int)(random_bits(numbers) % (unsigned)count);
}

static double some(struct random_numbers *numbers)
{
    return random_between(numbers, -2, 2);
}

/* ---- drawing */

/* The text of body b in a tree. */
static const char *entry_of(const char *tree, int b)
{
    char key[20];
    snprintf(key, sizeof key, "\n  b%d:\n", b);
    return strstr(tree, key) + 1;
}

static bool is_particle(const char *tree, int b)
{
    const char *motion = strstr(entry_of(tree, b), "motion: {");
    return strncmp(motion, "motion: {particle", strlen("motion: {particle")) == 0;
}

/* A couple as two opposite forces a metre apart in the body. */
static void write_couple(char *out, int k, const char *sign, const char *value)
{
    snprintf(
        out, text_room,
        "      - applied: {name: p%d, value: \"%s(%s)/1[m]\", angle: 90 deg, frame: body, at: [1, 0]}\n"
        "      - applied: {name: q%d, value: \"-%s(%s)/1[m]\", angle: 90 deg, frame: body, at: [0, 0]}\n",
        k, sign, value, k, sign, value);
}

static void draw_moment(struct random_numbers *numbers, struct motor *motor, int k)
{
    const int a = motor->body[0], b = motor->body[1];
    char value[300], other[20] = "ground";
    if (b >= 0) snprintf(other, sizeof other, "b%d", b);
    if (pick(numbers, 3) == 0)
        snprintf(value, sizeof value, "%.17g[N*m]", some(numbers));
    else
        snprintf(value, sizeof value,
                 "%.17g[N*m]*cos(%.17g[rad/s]*t) - %.17g[N*m*s]*b%d.angle_dot + %.17g[N*m]*states.z",
                 some(numbers), some(numbers), random_between(numbers, 0, 1), a, some(numbers));
    snprintf(motor->coupling, text_room, "  - actuator: {name: m%d, between: [b%d, %s], moment: \"%s\"}\n", k,
             a, other, value);
    write_couple(motor->force[0], k, "", value);
    if (b >= 0) write_couple(motor->force[1], k, "-", value);
}

static void draw_pull(struct random_numbers *numbers, struct motor *motor, int k)
{
    const int a = motor->body[0], b = motor->body[1];
    char dx[80], dy[80], far[200], other[20] = "ground.A0";
    const double stiff = some(numbers), wave = some(numbers), damp = random_between(numbers, 0, 0.5);
    snprintf(dx, sizeof dx, b < 0 ? "(b%d.P.x - 3[m])" : "(b%d.P.x - b%d.G.x)", a, b);
    snprintf(dy, sizeof dy, b < 0 ? "(b%d.P.y - 1[m])" : "(b%d.P.y - b%d.G.y)", a, b);
    snprintf(far, sizeof far, "hypot(%s, %s)", dx, dy);
    if (b >= 0) snprintf(other, sizeof other, "b%d", b);
    static const char form[] = "%.17g[N/m]*%s + %.17g[N]*sin(t*2[rad/s]) - %.17g[N*s/m]*b%d.P.vx";
    char given[400], written[600];
    snprintf(given, sizeof given, form, stiff, "distance", wave, damp, a);
    snprintf(written, sizeof written, form, stiff, far, wave, damp, a);
    snprintf(motor->coupling, text_room, "  - actuator: {name: m%d, between: [b%d.P, %s], force: \"%s\"}\n",
             k, a, other, given);
    for (int end = 0; end < 2; end++)
        snprintf(motor->force[end], text_room,
                 "      - applied: {name: p%d, value: [\"%s(%s)*%s/%s\", \"%s(%s)*%s/%s\"], at: %s}\n", k,
                 end == 0 ? "-" : "", written, dx, far, end == 0 ? "-" : "", written, dy, far,
                 end == 0 ? "P" : "G");
}

static void draw_guided(struct random_numbers *numbers, struct motor *motor, int k)
{
    const int a = motor->body[0], b = motor->body[1];
    const double along = some(numbers);
    char value[300], other[20] = "ground.A0", angle[80];
    snprintf(value, sizeof value, "%.17g[N]*cos(%.17g[rad/s]*t) - %.17g[N*s/m]*b%d.P.vy", some(numbers),
             some(numbers), random_between(numbers, 0, 1), a);
    if (b >= 0) snprintf(other, sizeof other, "b%d.P", b);
    snprintf(angle, sizeof angle, b < 0 ? "%.17g" : "%.17g + b%d.angle", along, b);
    snprintf(motor->coupling, text_room,
             "  - actuator: {name: m%d, between: [b%d.P, %s], force: \"%s\", along: %.17g rad}\n", k, a,
             other, value, along);
    snprintf(motor->force[0], text_room,
             "      - applied: {name: p%d, value: \"%s\", angle: \"%s\", at: P}\n", k, value, angle);
    snprintf(motor->force[1], text_room,
             "      - applied: {name: p%d, value: \"-(%s)\", angle: %.17g rad, frame: body, at: {point: P, "
             "offset: [b%d.P.x - b%d.P.x, b%d.P.y - b%d.P.y]}}\n",
             k, value, along, a, b, a, b);
}

/* The ends of a moment are no particles, and one end turns: b0 does, unless it is a slide. */
static bool is_possible(const struct drawn *drawn, const struct motor *motor)
{
    bool turns = false;
    for (int end = 0; end < 2; end++) {
        const int b = motor->body[end];
        if (b < 0) continue;
        if (motor->what != on_line && is_particle(drawn->tree, b)) return false;
        const char *motion = strstr(entry_of(drawn->tree, b), "motion: {");
        turns |= strncmp(motion, "motion: {p", strlen("motion: {p")) == 0;
    }
    return motor->what != on_turning || turns;
}

static void draw_motor(struct random_numbers *numbers, struct drawn *drawn)
{
    struct motor *motor = &drawn->motors[drawn->count];
    *motor = (struct motor){.what = (enum what)pick(numbers, kinds)};
    motor->body[0] = pick(numbers, drawn->bodies);
    motor->body[1] = pick(numbers, drawn->bodies + 1) - 1;
    if (motor->body[0] == motor->body[1] || !is_possible(drawn, motor)) return;
    if (motor->what == on_turning) draw_moment(numbers, motor, drawn->count);
    if (motor->what == on_line) draw_pull(numbers, motor, drawn->count);
    if (motor->what == on_guide) draw_guided(numbers, motor, drawn->count);
    drawn->count++;
}

static struct drawn draw(struct random_numbers *numbers)
{
    struct random_tree tree = {.bodies = 2 + pick(numbers, 5),
                               .friction = pick(numbers, 2) == 0,
                               .loops = pick(numbers, 3),
                               .pivots = pick(numbers, 4) == 0};
    struct drawn drawn = {.bodies = tree.bodies};
    drawn.tree = random_tree_text(numbers, &tree);
    while (drawn.count == 0)
        for (int k = 0; k < most_motors; k++) draw_motor(numbers, &drawn);
    return drawn;
}

/* ---- writing */

static void write_listed(FILE *out, const struct drawn *drawn, int b)
{
    for (int k = 0; k < drawn->count; k++)
        for (int end = 0; end < 2; end++)
            if (drawn->motors[k].body[end] == b) fputs(drawn->motors[k].force[end], out);
}

/* The tree with its motors as couplings, or as forces of the bodies. */
static char *text_of(const struct drawn *drawn, bool coupled)
{
    static const char forces[] = "    forces:\n", couplings[] = "couplings:\n";
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    const char *at = drawn->tree;
    assert_non_null(out);
    for (int b = 0; !coupled && b < drawn->bodies; b++) {
        const char *list = strstr(entry_of(drawn->tree, b), forces) + strlen(forces);
        fwrite(at, 1, (size_t)(list - at), out);
        write_listed(out, drawn, b);
        at = list;
    }
    const char *list = strstr(at, couplings) + strlen(couplings);
    fwrite(at, 1, (size_t)(list - at), out);
    for (int k = 0; coupled && k < drawn->count; k++) fputs(drawn->motors[k].coupling, out);
    fputs(list, out);
    fputs("states:\n  z: {rate: \"(0.3 - states.z + b0.G.vx*1[s/m])/1[s]\", unit: 1, initial: 0.1}\n", out);
    fclose(out);
    return text;
}

/* ---- accelerations and their derivatives */

/* Of chains with loops, of which some are nearly singular: derivatives have the square of that condition. */
static const double rounding = 1e-10, rounding_of_derivatives = 1e-8;

struct assembled {
    fbd_model *model;
    struct fbd_state *state;
    double *a, *dfdy, *dfdt;
    size_t n, size;
};

static struct assembled assembly_of(const char *text, uint64_t seed)
{
    struct random_numbers numbers = {seed};
    struct reading reading = read_right(text);
    struct assembled of = {.model = model_compile(reading.scene, reading.errors)};
    reading.scene = NULL;
    assert_non_null(of.model);
    of.state = state_new(of.model);
    of.n = (size_t)of.model->plan.n;
    of.size = plan_size(&of.model->plan);
    for (size_t i = 0; i < 2 * of.n; i++) of.state->y[i] += random_between(&numbers, -1e-3, 1e-3);
    of.a = calloc(of.n + 1, sizeof *of.a);
    of.dfdy = calloc(of.size * of.size, sizeof *of.dfdy);
    of.dfdt = calloc(of.size, sizeof *of.dfdt);
    assert_true(of.state && of.a && of.dfdy && of.dfdt);
    of.state->t = 0.3;
    modes_settle(of.state, NULL);
    state_ready(of.state);
    struct instant at = state_instant(of.state);
    accelerations(of.model, &at, of.state->slots, of.a);
    state_jacobian(of.model, &at, of.state->scratch, of.dfdy, of.dfdt);
    end_reading(&reading);
    return of;
}

static void release(struct assembled *of)
{
    free(of->a);
    free(of->dfdy);
    free(of->dfdt);
    state_free(of->state);
    fbd_model_free(of->model);
}

static double largest(const double *values, size_t count)
{
    double most = 1;
    for (size_t i = 0; i < count; i++) most = fmax(most, fabs(values[i]));
    return most;
}

static void compare(struct checks *checks, const char *what, const double *a, const double *b, size_t count,
                    double tolerance)
{
    const double size = largest(b, count);
    for (size_t i = 0; i < count; i++) check_close(checks, what, a[i] / size, b[i] / size, tolerance);
}

static bool is_balanced(struct assembled *of)
{
    struct text lack = {0};
    const bool balanced = !balance_lack(of->state, &lack);
    text_free(&lack);
    return balanced;
}

/* ---- runs */

static double works_of(const struct drawn *drawn, struct trial *listed, int k)
{
    double sum = 0;
    for (int end = 0; end < 2; end++) {
        char body[20], load[20];
        if (drawn->motors[k].body[end] < 0) continue;
        snprintf(body, sizeof body, "b%d", drawn->motors[k].body[end]);
        snprintf(load, sizeof load, "p%d", k);
        sum += fbd_result_work(listed->result, body, load);
        load[0] = 'q';
        if (drawn->motors[k].what == on_turning) sum += fbd_result_work(listed->result, body, load);
    }
    return sum;
}

static void compare_runs(struct checks *checks, const struct drawn *drawn, const char *const *texts)
{
    const double same = 1e-6; /* runs of half a second at 1e-11, whose steps differ */
    struct trial coupled = trial_parse(texts[0]), listed = trial_parse(texts[1]);
    trial_run(&coupled, NULL);
    trial_run(&listed, NULL);
    check_that(checks, "both end alike", coupled.outcome == listed.outcome);
    for (size_t i = 0; coupled.outcome == FBD_DONE && i < fbd_model_coordinate_count(coupled.model); i++) {
        const char *name = fbd_model_coordinate(coupled.model, i).name;
        const double want = trial_get(&listed, name);
        check_close(checks, name, trial_get(&coupled, name), want, same * (1 + fabs(want)));
    }
    for (int k = 0; coupled.outcome == FBD_DONE && k < drawn->count; k++) {
        char body[20], load[20];
        snprintf(body, sizeof body, "b%d", drawn->motors[k].body[0]);
        snprintf(load, sizeof load, "m%d", k);
        const double want = works_of(drawn, &listed, k);
        check_close(checks, "work", fbd_result_work(coupled.result, body, load), want,
                    same * (1 + fabs(want)));
    }
    trial_close(&coupled);
    trial_close(&listed);
}

/* ---- the tests */

static size_t seeds(void)
{
    const char *given = getenv("FBD_MOTORS");
    return given ? (size_t)strtoul(given, NULL, 10) : (size_t)draws_of(200);
}

static void motors_are_two_opposite_loads(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (uint64_t seed = 1; seed <= seeds(); seed++) {
        const size_t before = checks.failed;
        struct random_numbers numbers = {seed};
        struct drawn drawn = draw(&numbers);
        char *texts[2] = {text_of(&drawn, true), text_of(&drawn, false)};
        struct assembled coupled = assembly_of(texts[0], seed), listed = assembly_of(texts[1], seed);
        compare(&checks, "acceleration", coupled.a, listed.a, coupled.n, rounding);
        compare(&checks, "derivative", coupled.dfdy, listed.dfdy, coupled.size * coupled.size,
                rounding_of_derivatives);
        compare(&checks, "derivative by time", coupled.dfdt, listed.dfdt, coupled.size,
                rounding_of_derivatives);
        /* two slides that slip may have no modes that agree with their forces (test_balance.c) */
        check_that(&checks, "diagrams are in balance", is_balanced(&coupled) || !is_balanced(&listed));
        if (seed % 5 == 0) compare_runs(&checks, &drawn, (const char *const *)texts);
        if (checks.failed > before) print_error("seed %d:\n%s\n", (int)seed, texts[0]);
        release(&coupled);
        release(&listed);
        for (int k = 0; k < 2; k++) free(texts[k]);
        free(drawn.tree);
    }
    checks_end(&checks);
}

/* Two weights on one line pull each other until they meet at t = sqrt(2 d m / (2 F)): on the line of the points the
 * force has no direction there, along a direction they pass each other with v = F t/m. */
static void points_that_meet_leave_no_direction(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char *const forces[] = {"force: 0.5 N", "force: -0.5 N, along: 0 deg"};
    for (int k = 0; k < 2; k++) {
        char text[500];
        snprintf(
            text, sizeof text,
            "fbd: 1\nbodies:\n  a: {mass: 1, motion: slide, initial: {x: 1}}\n  b: {mass: 1, motion: slide}\n"
            "couplings:\n  - actuator: {name: ram, between: [a, b], %s}\nsimulate: {until: 2}\n",
            forces[k]);
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        check_that(&checks, "its end", trial.outcome == (k == 0 ? FBD_FAILED : FBD_DONE));
        const double t = k == 0 ? sqrt(2) : 2;
        check_close(&checks, "a.v", trial_get(&trial, "a.v"), -0.5 * t, 1e-7);
        check_close(&checks, "b.x", trial_get(&trial, "b.x"), 0.25 * t * t, 1e-7);
        /* the power is F times the rate at which they approach, on both bodies together */
        check_close(&checks, "work", fbd_result_work(trial.result, "a", "ram"), 0.25 * t * t, 1e-7);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motors_are_two_opposite_loads),
        cmocka_unit_test(points_that_meet_leave_no_direction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
