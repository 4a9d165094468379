/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Trees of joined bodies against the reference numbers B02, B03, B13, C12 and C13. Every row of a case is
 * looked at, in the order of the table.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "joined_checks.h"

/* ---- B02 */

static double of_double_pendulum(struct trial *trial, const char *name)
{
    double th1 = trial_get(trial, "rod1.theta"), w1 = trial_get(trial, "rod1.omega");
    if (starts(name, "theta1")) return th1;
    if (starts(name, "omega1")) return w1;
    if (starts(name, "theta2")) return th1 + trial_get(trial, "rod2.theta");
    if (starts(name, "omega2")) return w1 + trial_get(trial, "rod2.omega");
    fbd_arrow pin = arrow_on(trial, name[1] == '0' ? 0 : 1, "pin");
    return name[2] == 'x' ? pin.fx : pin.fy;
}

static void the_double_pendulum_moves_and_pulls_as_the_reference_says(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("trees/double_pendulum.yaml", NULL);
    trial_start(&trial, &(fbd_options){.until = 5});
    assert_int_equal(follow(&checks, &trial, "B02.", of_double_pendulum), 32);
    trial_close(&trial);
    trial = trial_open("trees/double_pendulum.yaml", SET("theta_1=10 deg", "theta_2=-5 deg"));
    trial_start(&trial, &(fbd_options){.until = 10});
    assert_int_equal(follow(&checks, &trial, "B02.b_", of_double_pendulum), 24);
    trial_close(&trial);
    trial = trial_open("trees/double_pendulum.yaml", NULL);
    trial_run(&trial, &(fbd_options){.until = 5});
    fbd_energy energy = fbd_result_energy(trial.result);
    check_named(&checks, "B02.energy", energy.kinetic + energy.potential);
    trial_close(&trial);
    trial = trial_open("trees/double_pendulum.yaml", SET("theta_1=10 deg", "theta_2=-5 deg"));
    trial_run(&trial, &(fbd_options){.until = 10});
    energy = fbd_result_energy(trial.result);
    check_named(&checks, "B02.b_energy", energy.kinetic + energy.potential);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- B03: the reference counts theta clockwise */

static double of_cart_and_pole(struct trial *trial, const char *name)
{
    if (strcmp(name, "x") == 0) return trial_get(trial, "cart.x");
    if (strcmp(name, "vx") == 0) return trial_get(trial, "cart.v");
    if (strcmp(name, "theta") == 0) return -trial_get(trial, "pole.theta");
    if (strcmp(name, "omega") == 0) return -trial_get(trial, "pole.omega");
    if (strcmp(name, "N") == 0) return arrow_on(trial, 0, "normal").fy;
    fbd_arrow pin = arrow_on(trial, 1, "pin"), other = arrow_on(trial, 0, "pole.pin");
    assert_true(pin.fx == -other.fx && pin.fy == -other.fy); /* on both bodies that share it */
    return name[1] == 'x' ? pin.fx : pin.fy;
}

static void the_cart_and_its_pole_follow_the_reference(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("trees/cart_and_pendulum.yaml", NULL);
    trial_start(&trial, NULL);
    assert_int_equal(follow(&checks, &trial, "B03.a_", of_cart_and_pole), 28);
    trial_close(&trial);
    trial = trial_open("trees/cart_and_pendulum.yaml", SET("F_0=4 N"));
    trial_start(&trial, NULL);
    assert_int_equal(follow(&checks, &trial, "B03.b_", of_cart_and_pole), 28);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- B13 */

enum { rods = 10 };

static double of_chain(struct trial *trial, const char *name)
{
    const double l = 0.2;
    double angle = 0, rate = 0, tip_x = 0, tip_y = 0;
    int wanted = starts(name, "theta") || starts(name, "omega") ? atoi(name + 5) : rods;
    for (int i = 1; i <= wanted; i++) {
        char theta[24], omega[24];
        snprintf(theta, sizeof theta, "rod%d.theta", i);
        snprintf(omega, sizeof omega, "rod%d.omega", i);
        angle += trial_get(trial, theta);
        rate += trial_get(trial, omega);
        tip_x += l * sin(angle);
        tip_y -= l * cos(angle);
    }
    if (starts(name, "theta")) return angle;
    if (starts(name, "omega")) return rate;
    if (starts(name, "tip")) return name[4] == 'x' ? tip_x : tip_y;
    fbd_arrow pin = arrow_on(trial, 0, "pin");
    return name[2] == 'x' ? pin.fx : pin.fy;
}

static void ten_rods_fall_as_the_reference_says(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("trees/chain_of_ten_rods.yaml", NULL);
    check_named(&checks, "B13.alpha1_0", trial_acceleration(&trial, "rod1.theta"));
    check_named(&checks, "B13.alpha10_0", trial_acceleration(&trial, "rod10.theta"));
    check_named(&checks, "B13.R_y_0", arrow_on(&trial, 0, "pin").fy);
    trial_start(&trial, NULL);
    assert_int_equal(follow(&checks, &trial, "B13.", of_chain), 96);
    trial_close(&trial);
    trial = trial_open("trees/chain_of_ten_rods.yaml", NULL);
    trial_run(&trial, NULL);
    fbd_energy energy = fbd_result_energy(trial.result);
    check_named(&checks, "B13.energy", energy.kinetic + energy.potential);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- C12 */

static void check_wedge(struct checks *checks, const char *prefix, const char *file)
{
    char name[32];
    const double down = -0.52359877559829887, t = 0.5; /* -30 deg */
    struct trial trial = trial_open(file, NULL);
    trial_start(&trial, NULL);
    trial_to(&trial, t);
    double X = trial_get(&trial, "wedge.x"), s = trial_get(&trial, "block.x");
    fbd_arrow N = arrow_on(&trial, 1, "normal");
    double X_acc = trial_acceleration(&trial, "wedge.x");
    const struct {
        const char *name;
        double value;
    } all[] = {
        {"X_acc", X_acc},
        {"s_acc", trial_acceleration(&trial, "block.x") - X_acc * cos(down)}, /* a_x is that in the world */
        {"N", hypot(N.fx, N.fy)},
        {"floor", arrow_on(&trial, 0, "normal").fy},
        {"X", X},
        {"s", s},
        {"block_x", X + s * cos(down)},
        {"block_y", s * sin(down)},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        snprintf(name, sizeof name, "C12.%s%s", prefix, all[i].name);
        check_named(checks, name, all[i].value);
    }
    trial_close(&trial);
}

static void the_wedge_gives_way_under_its_block(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    check_wedge(&checks, "a_", "trees/smooth_wedge.yaml");
    check_wedge(&checks, "b_", "trees/block_on_wedge.yaml");
    struct trial trial = trial_open("trees/block_on_wedge.yaml", SET("mu_s=0.7", "mu_k=0.7"));
    trial_start(&trial, &(fbd_options){.until = 1});
    trial_to(&trial, 1);
    fbd_arrow N = arrow_on(&trial, 1, "normal"), f = arrow_on(&trial, 1, "friction");
    check_named(&checks, "C12.c_X", trial_get(&trial, "wedge.x"));
    check_named(&checks, "C12.c_s", trial_get(&trial, "block.x"));
    check_named(&checks, "C12.c_N", hypot(N.fx, N.fy));
    check_named(&checks, "C12.c_friction_up_slope", hypot(f.fx, f.fy));
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- C13 */

static struct trial stack(const char *const *settings, double until)
{
    struct trial trial = trial_open("trees/stacked_blocks.yaml", settings);
    trial_start(&trial, &(fbd_options){.until = until});
    return trial;
}

static void stacked_blocks_slip_and_stick(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = stack(SET("F_0=25 N", "t_end=10 s"), 1);
    trial_to(&trial, 1);
    check_named(&checks, "C13.a_a1", trial_acceleration(&trial, "lower.x"));
    check_named(&checks, "C13.a_friction", arrow_on(&trial, 1, "friction").fx);
    trial_close(&trial);

    trial = stack(SET("t_end=10 s"), 1);
    trial_to(&trial, 1);
    check_named(&checks, "C13.b_a1", trial_acceleration(&trial, "lower.x"));
    check_named(&checks, "C13.b_a2", trial_acceleration(&trial, "upper.x"));
    check_named(&checks, "C13.b_relative", -trial_get(&trial, "upper.x"));
    trial_close(&trial);

    trial = stack(SET("F_0=0 N", "rate=5 N/s", "t_end=10 s"), 8);
    double slips = trial_to_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0);
    check_named(&checks, "C13.c_t_slip", slips);
    check_named(&checks, "C13.F_threshold", 5 * slips);
    check_named(&checks, "C13.c_v_slip", trial_get(&trial, "lower.v"));
    trial_to(&trial, 8);
    check_named(&checks, "C13.c_v1_8", trial_get(&trial, "lower.v"));
    check_named(&checks, "C13.c_v2_8", trial_get(&trial, "lower.v") + trial_get(&trial, "upper.v"));
    trial_close(&trial);

    trial = stack(NULL, 2);
    check_named(&checks, "C13.d_t_together", trial_to_event(&trial, FBD_EVENT_STICK, NULL, 0));
    check_named(&checks, "C13.d_v_together", trial_get(&trial, "lower.v"));
    check_named(&checks, "C13.d_slip_total", -trial_get(&trial, "upper.x"));
    trial_close(&trial);
    checks_end(&checks);
}

/* (e): the upper block is pulled. */
static void the_upper_block_breaks_away_from_a_floating_one(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse("fbd: 1\n"
                                     "bodies:\n"
                                     "  lower: {mass: 4, motion: slide, forces: [gravity, normal]}\n"
                                     "  upper:\n"
                                     "    mass: 2\n"
                                     "    motion: {slide: {on: lower}}\n"
                                     "    forces: [gravity, normal, friction: {static: 0.5, kinetic: 0.4},\n"
                                     "             applied: {name: pull, value: '1[N/s]*t'}]\n"
                                     "simulate: {until: 20}\n");
    trial_start(&trial, NULL);
    check_named(&checks, "C13.e_F_threshold", trial_to_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0));
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_double_pendulum_moves_and_pulls_as_the_reference_says),
        cmocka_unit_test(the_cart_and_its_pole_follow_the_reference),
        cmocka_unit_test(ten_rods_fall_as_the_reference_says),
        cmocka_unit_test(the_wedge_gives_way_under_its_block),
        cmocka_unit_test(stacked_blocks_slip_and_stick),
        cmocka_unit_test(the_upper_block_breaks_away_from_a_floating_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
