/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Loops, ropes, gears and rolling against the reference numbers B04, B09, B11, C01 and C02, and against
 * published solutions of two mechanisms.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "joined_checks.h"

/* ---- B04 */

static double of_slider_crank(struct trial *trial, const char *name)
{
    if (strcmp(name, "theta") == 0) return trial_get(trial, "crank.theta");
    if (strcmp(name, "omega") == 0) return trial_get(trial, "crank.omega");
    if (strcmp(name, "x_slider") == 0) return trial_get(trial, "piston.x");
    if (strcmp(name, "v_slider") == 0) return trial_get(trial, "piston.v");
    if (strcmp(name, "a_slider") == 0) return trial_acceleration(trial, "piston.x");
    if (strcmp(name, "N_guide") == 0) return arrow_on(trial, 2, "normal").fy;
    fbd_arrow pin = arrow_on(trial, 0, "pin");
    return name[1] == 'x' ? pin.fx : pin.fy;
}

static void the_slider_crank_turns_as_the_reference_says(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/slider_crank.yaml", NULL);
    trial_start(&trial, NULL);
    assert_int_equal(follow(&checks, &trial, "B04.", of_slider_crank), 32);
    trial_close(&trial);
    trial = trial_open("couplings/slider_crank.yaml", NULL);
    trial_start(&trial, NULL);
    check_named(&checks, "B04.t_dead_centre_180", trial_to_event(&trial, FBD_EVENT_USER, "dead_centre", 0));
    check_named(&checks, "B04.omega_at_180", trial_get(&trial, "crank.omega"));
    fbd_arrow on_rod = arrow_on(&trial, 1, "wrist"), on_piston = arrow_on(&trial, 2, "wrist");
    check_that(&checks, "the pin pulls both ways", on_rod.fx == -on_piston.fx && on_rod.fy == -on_piston.fy);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- B09 */

static void check_atwood(struct checks *checks, const char *prefix, const char *const *settings)
{
    char name[32];
    struct trial trial = trial_open("couplings/atwood.yaml", settings);
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    double at_1[] = {trial_acceleration(&trial, "m1.x"), arrow_on(&trial, 0, "cable").fy,
                     arrow_on(&trial, 1, "cable").fy, arrow_on(&trial, 2, "pin").fy};
    trial_to(&trial, 2);
    double at_2[] = {trial_get(&trial, "m1.x"), trial_get(&trial, "m1.v"), trial_get(&trial, "pulley.omega")};
    static const char *const names[] = {"a", "T1", "T2", "axle_force", "s", "v", "pulley_omega"};
    for (int i = 0; i < 7; i++) {
        snprintf(name, sizeof name, "B09.%s%s", prefix, names[i]);
        check_named(checks, name, i < 4 ? at_1[i] : at_2[i - 4]);
    }
    trial_close(&trial);
}

static void atwoods_machine_has_a_tension_on_each_side(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    check_atwood(&checks, "", NULL);
    check_atwood(&checks, "b_", SET("M_f=0.15 N*m"));
    checks_end(&checks);
}

/* (c): a massless pulley is a point that the rope slips over, here of a bracket without weight, whose pin
 * carries what the axle does. */
static void over_a_massless_pulley_both_tensions_are_one(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "bodies:\n"
        "  bracket: {mass: 1, inertia: 1, motion: pivot}\n"
        "  m1: {mass: 3, motion: {slide: {along: -90 deg, through: [0, -4]}}, forces: [gravity]}\n"
        "  m2: {mass: 2, motion: {slide: {along: -90 deg, through: [0, -4]}}, forces: [gravity]}\n"
        "couplings:\n"
        "  - rope: {name: cable, through: [m1, bracket, m2]}\n"
        "simulate: {until: 2}\n");
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    check_named(&checks, "B09.c_a", trial_acceleration(&trial, "m1.x"));
    check_named(&checks, "B09.c_T1", arrow_on(&trial, 1, "cable").fy);
    check_named(&checks, "B09.c_T2", arrow_on(&trial, 2, "cable").fy);
    check_named(&checks, "B09.c_axle_force", arrow_on(&trial, 0, "pin").fy);
    trial_to(&trial, 2);
    check_named(&checks, "B09.c_s", trial_get(&trial, "m1.x"));
    check_named(&checks, "B09.c_v", trial_get(&trial, "m1.v"));
    const double R = 0.1; /* a massless pulley turns as the rope tells it */
    check_named(&checks, "B09.c_pulley_omega", trial_get(&trial, "m1.v") / R);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- B11 */

static void gears_turn_in_their_ratio(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/gear_pair.yaml", NULL);
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    check_named(&checks, "B11.alpha1", trial_acceleration(&trial, "pinion.theta"));
    check_named(&checks, "B11.alpha2", trial_acceleration(&trial, "wheel.theta"));
    check_named(&checks, "B11.mesh_force", arrow_on(&trial, 1, "mesh").fy);
    trial_to(&trial, 2);
    check_named(&checks, "B11.omega1", trial_get(&trial, "pinion.omega"));
    check_named(&checks, "B11.theta2", trial_get(&trial, "wheel.theta"));
    trial_close(&trial);
    trial = trial_open("couplings/gear_pair.yaml", SET("c=0.09 N*m*s/rad"));
    trial_start(&trial, NULL);
    trial_to(&trial, 4);
    check_named(&checks, "B11.b_omega1", trial_get(&trial, "pinion.omega"));
    check_named(&checks, "B11.b_theta1", trial_get(&trial, "pinion.theta"));
    check_named(&checks, "B11.b_omega2", trial_get(&trial, "wheel.omega"));
    check_named(&checks, "B11.b_mesh_force", arrow_on(&trial, 1, "mesh").fy);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- C01 */

/* Distance down the slope of 30 degrees from where it starts, R (1/2, sqrt(3)/2). */
static double down(const struct trial *trial, const char *x, const char *y)
{
    const double c = sqrt(3) / 2;
    return trial_get(trial, x) * c - trial_get(trial, y) * 0.5;
}

static void check_rolling(struct checks *checks, const char *file, const char *body, bool slips)
{
    char name[40];
    struct trial trial = trial_open(file, slips ? SET("mu=0.1") : NULL);
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    fbd_arrow f = arrow_on(&trial, 0, "tread.friction");
    double a = trial_acceleration(&trial, "ball.G.x") / (sqrt(3) / 2);
    trial_to(&trial, 2);
    double s = down(&trial, "ball.x", "ball.y"), omega = -trial_get(&trial, "ball.omega");
    double speed = down(&trial, "ball.vx", "ball.vy") - 0.2 * omega;
    const struct {
        const char *name;
        double value;
        bool slips_only;
    } all[] = {{"a", a, false},
               {"friction", hypot(f.fx, f.fy), false},
               {"s", s, false},
               {"omega", omega, false},
               {"contact_speed", speed, true},
               {"power_loss", hypot(f.fx, f.fy) * speed, true}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (all[i].slips_only && !slips) continue;
        snprintf(name, sizeof name, "C01.%s_%s_%s", body, slips ? "slip" : "roll", all[i].name);
        check_named(checks, name, all[i].value);
    }
    trial_close(&trial);
}

static void round_bodies_roll_or_slip_down_an_incline(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int slips = 0; slips < 2; slips++) {
        check_rolling(&checks, "couplings/rolling_on_incline.yaml", "sphere", slips);
        check_rolling(&checks, "couplings/disc_on_incline.yaml", "disc", slips);
    }
    /* (c): just below and just above tan(phi)/3 */
    static const char *const mu[] = {"mu=0.19", "mu=0.195"};
    static const char *const names[] = {"C01.c_disc_0.19", "C01.c_disc_0.195"};
    for (int i = 0; i < 2; i++) {
        char name[48];
        struct trial trial = trial_open("couplings/disc_on_incline.yaml", SET(mu[i]));
        trial_start(&trial, NULL);
        trial_to(&trial, 2);
        snprintf(name, sizeof name, "%s_s", names[i]);
        check_named(&checks, name, down(&trial, "ball.x", "ball.y"));
        snprintf(name, sizeof name, "%s_contact_speed", names[i]);
        check_named(&checks, name,
                    down(&trial, "ball.vx", "ball.vy") + 0.2 * trial_get(&trial, "ball.omega"));
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- C02: the reference's spin is positive where ours is negative */

/* (b) is a disc. */
static struct trial open_ball(const char *prefix, const char *const *settings)
{
    if (strcmp(prefix, "b_") != 0) return trial_open("couplings/bowling_ball.yaml", settings);
    return trial_parse("fbd: 1\n"
                       "ground: {lines: {lane: {along: 0 deg}}}\n"
                       "bodies:\n"
                       "  ball: {mass: 6.8, shape: disc, radius: 0.108, motion: planar,\n"
                       "         initial: {y: 0.108, vx: 8}, forces: [gravity]}\n"
                       "couplings:\n"
                       "  - roll: {name: tread, body: ball, on: lane, static: 0.12, kinetic: 0.12}\n"
                       "simulate: {until: 6}\n");
}

static void check_ball(struct checks *checks, const char *prefix, const char *const *settings)
{
    char name[32];
    struct trial trial = open_ball(prefix, settings);
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    double omega_1 = -trial_get(&trial, "ball.omega");
    double t = trial_to_event(&trial, FBD_EVENT_STICK, NULL, 0);
    const struct {
        const char *name;
        double value;
    } at_roll[] = {{"omega_1s", omega_1},
                   {"t_roll", t},
                   {"v_roll", trial_get(&trial, "ball.vx")},
                   {"s_roll", trial_get(&trial, "ball.x")},
                   {"omega_roll", -trial_get(&trial, "ball.omega")}};
    for (size_t i = 0; i < sizeof at_roll / sizeof *at_roll; i++) {
        snprintf(name, sizeof name, "C02.%s%s", prefix, at_roll[i].name);
        check_named(checks, name, at_roll[i].value);
    }
    trial_to(&trial, 6);
    snprintf(name, sizeof name, "C02.%sx_6s", prefix);
    check_named(checks, name, trial_get(&trial, "ball.x"));
    snprintf(name, sizeof name, "C02.%sv_6s", prefix);
    check_named(checks, name, trial_get(&trial, "ball.vx"));
    trial_close(&trial);
    trial = open_ball(prefix, settings);
    trial_run(&trial, NULL);
    fbd_energy energy = fbd_result_energy(trial.result);
    snprintf(name, sizeof name, "C02.%senergy_lost", prefix);
    check_named(checks, name, energy.initial_kinetic - energy.kinetic);
    check_named(checks, name, -energy.work); /* and friction's ledger says the same */
    trial_close(&trial);
}

static void a_bowling_ball_slides_and_then_rolls(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    check_ball(&checks, "", NULL);
    check_ball(&checks, "b_", NULL);
    check_ball(&checks, "c_", SET("v_0=4 m/s", "omega_0=100 rad/s")); /* and comes back */
    checks_end(&checks);
}

/* ---- mechanisms */

/* Mazzia and Magherini, Test Set for Initial Value Problem Solvers, release 2.4 (2008), problem `andrews`:
 * the reference solution at t = 0.03, found there by PSIDE at a tolerance of 1e-14 on a Cray C90. Parameters,
 * start and solution have been held against the problem's Fortran text and against the copies of it in Cash's
 * driver of MEBDFI (andrewi.f, 2000) and in the package deTestSet of R. Its multipliers are forces between
 * the pins of K2 and K3, K2 and K4, K2 and K6.
 *
 * Our solutions by dop853 and rk8pd at tolerances from 1e-11 to 3e-14 agree with each other to 1e-13, and
 * with the published one to 3e-10 in the angles, 5e-8 in the rates and 1e-7 in the forces: in the formulation
 * with index 3 that it was found with, digits are lost from one to the next. */
static void the_squeezer_moves_as_published_to_eight_digits(void **unused)
{
    (void)unused;
    static const struct {
        const char *body;
        double theta, omega;
    } published[] = {
        {"K1", 0.1581077119629904e2, 0.1139920302151208e4},
        {"K2", -0.1575637105984298e2, -0.1424379294994111e4},
        {"K3", 0.4082224013073101e-1, 0.1103291221937134e2},
        {"K4", -0.5347301163226948, 0.1929337464421385e2},
        {"K5", 0.5244099658805304, 0.5735699284790808},
        {"K6", 0.5347301163226948, -0.1929337464421385e2},
        {"K7", 0.1048080741042263e1, 0.3231791658026955},
    };
    static const double multipliers[] = {0.1991753333731910e3, -0.2975531228015052e2, 0.2306654119098399e2,
                                         0.3145271365475927e2, 0.2264249232082739e2,  0.1161740700019673e2};
    const double *m = multipliers;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/andrews_squeezer.yaml", NULL);
    trial_start(&trial, NULL);
    trial_to(&trial, 0.03);
    const double force = 244.9; /* the largest */
    for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
        char name[16];
        double theta = published[i].theta, omega = published[i].omega;
        snprintf(name, sizeof name, "%s.theta", published[i].body);
        check_close(&checks, name, trial_get(&trial, name), theta, 1e-8 * fabs(theta));
        snprintf(name, sizeof name, "%s.omega", published[i].body);
        check_close(&checks, name, trial_get(&trial, name), omega, 1e-7 * fabs(omega));
    }
    const struct {
        size_t body;
        const char *pin;
        double fx, fy;
    } forces[] = {{1, "left", -(m[0] + m[2] + m[4]), -(m[1] + m[3] + m[5])},
                  {4, "middle", m[2], m[3]},
                  {6, "right", m[4], m[5]}};
    for (size_t i = 0; i < sizeof forces / sizeof *forces; i++) {
        fbd_arrow pin = arrow_on(&trial, forces[i].body, forces[i].pin);
        check_close(&checks, forces[i].pin, pin.fx, forces[i].fx, 2e-7 * force);
        check_close(&checks, forces[i].pin, pin.fy, forces[i].fy, 2e-7 * force);
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* Past its dead centre the piston stays on its side: x = cos(theta) + sqrt(l^2 - sin^2(theta)). */
static void a_nearly_singular_slider_crank_stays_on_its_branch(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/near_singular_slider_crank.yaml", NULL);
    trial_start(&trial, NULL);
    for (int i = 1; i <= 100; i++) {
        trial_to(&trial, 0.05 * i);
        double theta = trial_get(&trial, "crank.theta");
        double x = cos(theta) + sqrt(1.0001 * 1.0001 - sin(theta) * sin(theta));
        /* The tolerance is 1e-10; at the dead centre 1e-4 from the axis errors grow by the inverse square
         * root of that. */
        check_close(&checks, "x", trial_get(&trial, "piston.x"), x, 1e-7);
    }
    trial_close(&trial);
    checks_end(&checks);
}

static void a_linkage_keeps_its_energy_and_its_loop(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/four_bar.yaml", NULL);
    trial_run(&trial, &(fbd_options){.until = 10, .tolerance = 1e-10});
    fbd_energy energy = fbd_result_energy(trial.result);
    double turned_over = fabs(fbd_result_work(trial.result, "crank", "drive"));
    check_close(&checks, "residual", energy.residual, 0, 1e-8 * turned_over);
    trial_close(&trial);
    checks_end(&checks);
}

/* Taut as a pendulum until cos(theta) = -v0^2/(3 g L), then a free flight until |r| = L, where the velocity
 * along the rope is lost: m v_r^2 / 2. */
static void a_rope_goes_slack_and_snaps_taut(void **unused)
{
    (void)unused;
    const double g = 9.81, v0 = 4;
    struct checks checks = {0};
    double c = -v0 * v0 / (3 * g), s = sqrt(1 - c * c), v = sqrt(v0 * v0 + 2 * g * c);
    struct trial trial = trial_open("couplings/rope_pendulum.yaml", NULL);
    trial_start(&trial, NULL);
    double slack = trial_to_event(&trial, FBD_EVENT_ROPE_SLACK, "cord", 0);
    check_close(&checks, "x", trial_get(&trial, "bob.x"), s, 1e-9);
    check_close(&checks, "y", trial_get(&trial, "bob.y"), -c, 1e-9);
    double taut = trial_to_event(&trial, FBD_EVENT_ROPE_TAUT, "cord", 0), flight = taut - slack;
    double x = s + v * c * flight, y = -c + v * s * flight - g * flight * flight / 2;
    check_close(&checks, "x", trial_get(&trial, "bob.x"), x, 1e-9);
    check_close(&checks, "y", trial_get(&trial, "bob.y"), y, 1e-9);
    check_close(&checks, "|r|", hypot(x, y), 1, 1e-9);
    double vx = v * c, vy = v * s - g * flight, along = vx * x + vy * y;
    check_close(&checks, "vx", trial_get(&trial, "bob.vx"), vx - along * x, 1e-8);
    check_close(&checks, "vy", trial_get(&trial, "bob.vy"), vy - along * y, 1e-8);
    trial_close(&trial);
    trial = trial_open("couplings/rope_pendulum.yaml", NULL);
    trial_run(&trial, NULL);
    fbd_energy energy = fbd_result_energy(trial.result);
    check_close(&checks, "work", energy.work, -along * along, 1e-7); /* m = 2 */
    check_close(&checks, "residual", energy.residual, 0, 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- prescribed motion */

static void a_driven_slider_crank_is_where_geometry_says(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/driven_slider_crank.yaml", NULL);
    trial_start(&trial, NULL);
    for (int i = 0; i <= 20; i++) {
        if (i > 0) trial_to(&trial, 0.05 * i);
        double theta = 0.3 + 10 * 0.05 * i, s = 0.2 * sin(theta), c = 0.2 * cos(theta);
        double root = sqrt(0.25 - s * s);
        /* The default tolerance is 1e-10; positions are projected onto the loop. */
        check_close(&checks, "theta", trial_get(&trial, "crank.theta"), theta, 1e-12);
        check_close(&checks, "x", trial_get(&trial, "piston.x"), c + root, 1e-9);
        check_close(&checks, "v", trial_get(&trial, "piston.v"), 10 * (-s - s * c / root), 1e-8);
    }
    trial_close(&trial);
    trial = trial_open("couplings/driven_slider_crank.yaml", NULL);
    trial_run(&trial, NULL);
    fbd_energy energy = fbd_result_energy(trial.result);
    /* The work of the drive is what the energies have gained. */
    check_close(&checks, "residual", energy.residual, 0, 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

static void a_shaken_support_takes_the_force_by_hand(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const double m_c = 2, m = 0.5, l = 0.5;
    struct trial trial = trial_open("trees/shaken_pendulum.yaml", NULL);
    trial_start(&trial, NULL);
    for (int i = 1; i <= 6; i++) {
        double t = 0.5 * i;
        trial_to(&trial, t);
        double theta = trial_get(&trial, "pole.theta"), omega = trial_get(&trial, "pole.omega");
        double acceleration = -0.9 * sin(3 * t);
        double alpha = -3 * l * (9.81 * sin(theta) + cos(theta) * acceleration);
        double force = (m_c + m) * acceleration + m * l * (alpha * cos(theta) - omega * omega * sin(theta));
        check_close(&checks, "alpha", trial_acceleration(&trial, "pole.theta"), alpha, 1e-12);
        check_close(&checks, "drive", arrow_on(&trial, 0, "drive").fx, force, 1e-12);
    }
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_slider_crank_turns_as_the_reference_says),
        cmocka_unit_test(atwoods_machine_has_a_tension_on_each_side),
        cmocka_unit_test(over_a_massless_pulley_both_tensions_are_one),
        cmocka_unit_test(gears_turn_in_their_ratio),
        cmocka_unit_test(round_bodies_roll_or_slip_down_an_incline),
        cmocka_unit_test(a_bowling_ball_slides_and_then_rolls),
        cmocka_unit_test(the_squeezer_moves_as_published_to_eight_digits),
        cmocka_unit_test(a_nearly_singular_slider_crank_stays_on_its_branch),
        cmocka_unit_test(a_linkage_keeps_its_energy_and_its_loop),
        cmocka_unit_test(a_rope_goes_slack_and_snaps_taut),
        cmocka_unit_test(a_driven_slider_crank_is_where_geometry_says),
        cmocka_unit_test(a_shaken_support_takes_the_force_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
