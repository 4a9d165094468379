/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The models of contacts against closed forms; and jams, where friction and normal forces grow on each other.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fbd_study.h"
#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

static const double g = 9.81, pi = 3.14159265358979323846;

static struct trial run_model(const char *path, const char *const *settings)
{
    struct trial trial = trial_open(path, settings);
    trial_run(&trial, NULL);
    return trial;
}

/* Ramps of the push: it slides at F = mu m g and then tips where that moves the floor's force to the edge; or it tips
 * first, at F = m g a/(2 h). */
static void a_block_slides_or_tips(void **unused)
{
    const double weight = 5 * g, a = 0.4, b = 0.6, h = 0.5, rate = 10;
    struct checks checks = {0};
    (void)unused;
    struct trial trial = run_model("contact/push_slide_or_tip.yaml", NULL);
    check_that(&checks, "done", trial.outcome == FBD_DONE);
    check_close(&checks, "slides", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), 0.3 * weight / rate,
                1e-9);
    check_close(&checks, "tips later", trial_event(&trial, FBD_EVENT_LIFT_OFF, NULL, 0),
                (a / 2 - 0.3 * b / 2) * weight / (h - b / 2) / rate, 1e-9);
    trial_close(&trial);
    trial = run_model("contact/push_slide_or_tip.yaml", SET("mu=0.6"));
    double tips = weight * a / (2 * h) / rate;
    check_close(&checks, "tips", trial_event(&trial, FBD_EVENT_LIFT_OFF, NULL, 0), tips, 1e-9);
    check_that(&checks, "before it slides", !(trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0) < tips));
    trial_close(&trial);
    trial = run_model("contact/push_slide_or_tip.yaml", SET("mu=0"));
    check_that(&checks, "done without friction", trial.outcome == FBD_DONE);
    check_close(&checks, "slides from the start", trial_get(&trial, "block.x"), rate * 27 / 6 / 5,
                1e-9); /* F t^2/6 m */
    trial_close(&trial);
    checks_end(&checks);
}

/* After one period of one pendulum all is as it was; the last one has been as high as the first. */
static void a_cradle_exchanges_its_ends(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_open("contact/cradle.yaml", SET("phi=-0.001"));
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double first = trial_event(&trial, FBD_EVENT_IMPACT, NULL, 0),
           second = trial_event(&trial, FBD_EVENT_IMPACT, NULL, 2);
    double omega = sqrt(g * 0.2 / (0.2 * 0.2 + 0.4 * 0.02 * 0.02)), quarter = pi / 2 / omega;
    check_close(&checks, "a quarter", first, quarter * (1 + 1e-6 / 16), 1e-9);
    check_close(&checks, "half a period", second - first, 2 * quarter * (1 + 1e-6 / 16), 2e-9);
    trial_start(&trial, NULL);
    trial_to(&trial, first + quarter);
    check_close(&checks, "as high", trial_get(&trial, "b5.theta"), 0.001, 1e-9);
    for (int i = 1; i <= 4; i++) {
        char name[12];
        snprintf(name, sizeof name, "b%d.theta", i);
        check_close(&checks, name, trial_get(&trial, name), 0, 1e-12);
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* A projectile between impacts: which step is below decides how far it falls. */
static void a_ball_hops_down_the_stairs(void **unused)
{
    const double ends[] = {0, 0.3, 0.6, 100}, v0 = 0.75, e = 0.6, rise = 0.15;
    struct checks checks = {0};
    (void)unused;
    struct trial trial = run_model("contact/stairs.yaml", NULL);
    check_that(&checks, "done", trial.outcome == FBD_DONE);
    double t = 0.1 / v0, x = 0, up = 0, height = 0;
    check_close(&checks, "leaves", trial_event(&trial, FBD_EVENT_LIFT_OFF, NULL, 0), t, 1e-9);
    for (int impact = 0; impact < 6; impact++) {
        /* the first step that it comes down on before it has passed it */
        for (int step = 1; step < 4; step++) {
            double fall = height + rise * step, flight = (up + sqrt(up * up + 2 * g * fall)) / g;
            if (fall < -1e-9 || x + v0 * flight > ends[step]) continue;
            t += flight;
            x += v0 * flight;
            height = -rise * step;
            up = e * (g * flight - up);
            break;
        }
        check_close(&checks, "impact", trial_event(&trial, FBD_EVENT_IMPACT, NULL, impact), t, 1e-9);
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* The first one strikes with the rate that its fall about its corner gives; all of them fall, and lose energy. */
static void dominoes_fall_one_after_the_other(void **unused)
{
    const double w = 0.01, h = 0.05, d = 0.02, push = 5, I = (w * w + h * h) / 3;
    struct checks checks = {0};
    (void)unused;
    struct trial trial = run_model("contact/dominoes.yaml", NULL);
    check_that(&checks, "done", trial.outcome == FBD_DONE);
    double s = d / h, c = sqrt(1 - s * s), rise = (w * s + h * c - h) / 2, v = NAN;
    double rate = sqrt(push * push - 2 * g * rise / I), last = 0;
    static const char *const names[] = {"first", "second", "third", "fourth"};
    size_t next = 0;
    for (size_t i = 0; i < fbd_simulation_event_count(trial.simulation); i++) {
        fbd_event event = fbd_simulation_event(trial.simulation, i);
        if (event.kind != FBD_EVENT_IMPACT || next == 4 || strcmp(event.name, names[next]) != 0) continue;
        if (next++ == 0) assert_int_equal(sscanf(strstr(event.detail, "v_n "), "v_n %lf", &v), 1);
        check_that(&checks, "in turn", event.t > last);
        last = event.t;
    }
    check_close(&checks, "the first impact", v, -rate * h * c, 1e-6);
    check_that(&checks, "four are struck", next == 4);
    for (int i = 1; i <= 5; i++) {
        char name[12];
        snprintf(name, sizeof name, "d%d.theta", i);
        check_that(&checks, name, trial_get(&trial, name) < -0.5);
    }
    fbd_energy energy = fbd_result_energy(trial.result);
    check_that(&checks, "energy is lost",
               energy.kinetic + energy.potential < energy.initial_kinetic + energy.initial_potential);
    trial_close(&trial);
    checks_end(&checks);
}

/* The height of the table over the flying box, with A = 20 mm and w = 30/s. */
static double over(double t, double from)
{
    double flight = t - from, A = 0.02, w = 30;
    return A * sin(w * t) - A * sin(w * from) - A * w * cos(w * from) * flight + g * flight * flight / 2;
}

static void a_box_on_a_shaken_table_flies_once_a_period(void **unused)
{
    const double A = 0.02, w = 30, leaves = asin(g / (A * w * w)) / w, period = 2 * pi / w;
    struct checks checks = {0};
    (void)unused;
    double low = leaves + 0.01, high = leaves + 0.2;
    for (int i = 0; i < 80; i++) {
        double middle = (low + high) / 2;
        *(over(middle, leaves) < 0 ? &low : &high) = middle;
    }
    struct trial trial = run_model("contact/shaken_table.yaml", NULL);
    check_that(&checks, "done", trial.outcome == FBD_DONE);
    for (int k = 0; k < 4; k++) {
        double from = leaves + k * period;
        check_close(&checks, "leaves", trial_event(&trial, FBD_EVENT_LIFT_OFF, NULL, k), from, 1e-9);
        check_close(&checks, "lands", trial_event(&trial, FBD_EVENT_IMPACT, NULL, k), low + k * period, 1e-9);
    }
    check_that(&checks, "lies flat", fabs(trial_get(&trial, "box.theta")) < 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* A box that falls flat bounces on both corners at once: at rest from sqrt(2 h/g) (1 + e)/(1 - e) on, as a ball. */
static void flat_boxes_rest_when_their_series_ends(void **unused)
{
    struct random_numbers numbers = {20261125};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws_of(20); i++) {
        char text[600];
        double a = random_between(&numbers, 0.1, 1), b = random_between(&numbers, 0.02, 1);
        double e = random_between(&numbers, 0.2, 0.8), h = random_between(&numbers, 0.1, 2);
        double mu = i % 2 == 0 ? 0 : 0.5, rest = sqrt(2 * h / g) * (1 + e) / (1 - e);
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {lines: {floor: {along: 0}}}\nbodies:\n  box: {shape: prism, a: %.17g, b: "
                 "%.17g, c: 1, "
                 "mass: 1, motion: planar, initial: {y: %.17g}, forces: [gravity]}\ncontacts:\n  - {between: "
                 "[box, "
                 "ground.floor], static: %.17g, restitution: %.17g}\nsimulate: {until: %.17g}\n",
                 a, b, b / 2 + h, mu, e, rest + 0.1);
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        check_that(&checks, "done", trial.outcome == FBD_DONE);
        check_close(&checks, "rest", trial_event(&trial, FBD_EVENT_REST, NULL, 0), rest, 1e-8 * rest);
        check_close(&checks, "flat", trial_get(&trial, "box.theta"), 0, 1e-12);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A uniform rod slides with its end on a floor that becomes rough at t = 0.01 s. Where 1 + 3 c^2 - 3 mu s c < 0, with c
 * and s of its angle to the floor, no normal force goes with the slip (Painleve): it jams, and turns on about its end
 * with the moment of momentum that it has about it. What slides fast beside it, and hangs on it by a thread
 * (else it would be run apart), is nothing to it. */
static bool jam_agrees(struct random_numbers *numbers, bool beside)
{
    char text[1400];
    const char *body =
                   "  fast: {shape: prism, a: 1, b: 0.2, c: 1, mass: 1, motion: planar, forces: [gravity], "
                   "initial: {x: 100, y: 0.1, vx: 1e5}}\ncouplings:\n  - spring: {name: thread, between: "
                   "[rod.right, fast.G], stiffness: 1e-12, free_length: 1}\n",
               *contact = "  - {name: slippery, between: [fast, ground.floor], static: 1e-3}\n";
    double L = random_between(numbers, 0.5, 2), phi = random_between(numbers, 0.7, 1.1);
    double V = random_between(numbers, -3, -1), m = random_between(numbers, 0.2, 5),
           mu = random_between(numbers, 1.9, 3);
    double omega = random_between(numbers, -0.2, 0.2), c = cos(phi), s = sin(phi);
    if (1 + 3 * c * c - 3 * mu * s * c > -0.05) return true;
    /* the centre is to the right of the end, which slides to the left: friction drives it in */
    double x = L / 2 * c, y = L / 2 * s;
    snprintf(
        text, sizeof text,
        "fbd: 1\nground: {lines: {floor: {along: 0}}}\nbodies:\n  rod: {shape: rod, length: %.17g, "
        "mass: %.17g, "
        "motion: planar, initial: {x: %.17g, y: %.17g, theta: %.17g, vx: %.17g, vy: %.17g, omega: "
        "%.17g}, forces: "
        "[gravity]}\n%scontacts:\n%s  - {name: floor, between: [rod.left, ground.floor], static: 'if(t < "
        "0.01[s], 0.1, "
        "%.17g)'}\nsimulate: {until: 0.0100001}\n",
        L, m, x, y, phi, V - omega * y, omega * x, omega, beside ? body : "", beside ? contact : "", mu);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_to(&trial, 0.01 - 1e-9);
    double theta = trial_get(&trial, "rod.theta"), r[2] = {L / 2 * cos(theta), L / 2 * sin(theta)};
    double vx = trial_get(&trial, "rod.vx"), vy = trial_get(&trial, "rod.vy"),
           w = trial_get(&trial, "rod.omega");
    double after = (w * L * L / 12 + r[0] * vy - r[1] * vx) / (L * L / 3);
    trial_finish(&trial);
    double jam = trial_event(&trial, FBD_EVENT_JAM, NULL, 0);
    double got = trial_get(&trial, "rod.omega");
    bool agrees =
        trial.outcome == FBD_DONE && fabs(jam - 0.01) < 1e-12 && fabs(got - after) < 2e-5 * fabs(after);
    if (!agrees)
        print_error("outcome %d, jam at %.17g, omega %.12g, %.12g wanted\n%s%s\n", (int)trial.outcome, jam,
                    got, after, text, fbd_simulation_reason(trial.simulation));
    trial_close(&trial);
    return agrees;
}

static void a_rod_jams_with_its_moment_of_momentum(void **unused)
{
    struct random_numbers numbers = {20261123};
    size_t wrong = 0;
    (void)unused;
    for (int i = 0; i < draws_of(100); i++) wrong += !jam_agrees(&numbers, i % 4 == 0);
    assert_int_equal(wrong, 0);
}

/* Lifted harder than by its weight while it slips on a rough floor, the rod may leave or stay: both agree. */
static void several_motions_are_an_event(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse(
        "fbd: 1\nparameters: {th: 0.73}\nground: {lines: {floor: {along: 0}}}\nbodies:\n  rod: {shape: rod, "
        "length: 1.3, "
        "mass: 3.7, motion: planar, initial: {x: 0.65*cos(th), y: 0.65*sin(th), theta: th, vx: -1.7}, "
        "forces: [gravity, "
        "{applied: {name: lift, value: 'if(t < 0.01[s], 0[N], 1.2*m*g)', angle: 90 deg}}]}\ncontacts:\n  - "
        "{name: floor, "
        "between: [rod.left, ground.floor], static: 'if(t < 0.01[s], 0.1, 2.5)'}\nsimulate: {until: 0.02}\n");
    trial_run(&trial, NULL);
    check_that(&checks, "done", trial.outcome == FBD_DONE);
    check_close(&checks, "several", trial_event(&trial, FBD_EVENT_SEVERAL, NULL, 0), 0.01, 1e-12);
    check_close(&checks, "it leaves", trial_event(&trial, FBD_EVENT_LIFT_OFF, NULL, 0), 0.01, 1e-12);
    trial_close(&trial);
    checks_end(&checks);
}

/* A disc that slides between a floor and a ceiling, and strikes the floor: what presses it against both at once is open, and
 * friction leaves as much of its speed as that says. Where it is smooth only the impulses are many. */
static void an_impact_of_a_gripped_disc_says_that_it_is_one_of_several(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int rough = 0; rough < 2; rough++) {
        char text[600];
        snprintf(
            text, sizeof text,
            "fbd: 1\ngravity: 0\nground: {lines: {floor: {along: 0}, top: {through: [0, 0.2], along: 0}}}\n"
            "bodies:\n  b: {mass: 1, shape: disc, radius: 0.1, motion: planar, initial: {y: 0.1, vx: 1, vy: "
            "-0.5}, forces: [applied: {value: 0, angle: 0}]}\ncontacts:\n"
            "  - {between: [b, ground.floor], static: %g, side: left}\n"
            "  - {between: [b, ground.top], static: %g, side: right}\nsimulate: {until: 0.1}\n",
            0.3 * rough, 0.3 * rough);
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        check_that(&checks, "done", trial.outcome == FBD_DONE);
        double several = trial_event(&trial, FBD_EVENT_SEVERAL, NULL, 0);
        check_that(&checks, "told where it is so", rough ? several == 0 : isnan(several));
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Pushed beyond where it tips, statics names the corner that it tips over. */
static void statics_says_where_a_block_tips(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int side = -1; side <= 1; side += 2) {
        char text[600];
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {lines: {floor: {along: 0}}}\nbodies:\n  block: {shape: prism, a: 0.4, b: "
                 "0.6, c: 0.3, "
                 "mass: 5, motion: planar, initial: {y: 0.3}, forces: [gravity, {applied: {value: %d, angle: "
                 "0, at: [0, "
                 "0.2]}}]}\ncontacts:\n  - {name: floor, between: [block, ground.floor], static: 0.9}\n",
                 25 * side);
        struct trial trial = trial_parse(text);
        fbd_errors *errors = fbd_errors_new();
        fbd_statics *statics = fbd_statics_new(trial.state, errors);
        assert_non_null(statics);
        char *words = fbd_statics_text(statics);
        const char *over = side > 0 ? "tips over `floor.normal_2`" : "tips over `floor.normal`";
        check_that(&checks, over, strstr(words, over) != NULL);
        free(words);
        fbd_statics_free(statics);
        fbd_errors_free(errors);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Atwood's machine, 2 kg beside 1 kg: the heavy one strikes the floor with v, the light one flies on and comes back after
 * 2 v/g, the rope snaps taut and throws both up with v/3, and after 2 (v/3)/(g/3) the floor is struck with v/3. So it
 * goes on, without end in a finite time; with e < 1/2 the heavy one bounces to rest before the rope is taut. */
static void a_rope_and_a_floor_strike_in_turn_until_both_hold(void **unused)
{
    const double h = 1, v = sqrt(2 * h * g / 3), end = 3 * v / g + (2 * v / g + 2 * v / g) * 3 / 2;
    struct checks checks = {0};
    (void)unused;
    for (int bounces = 0; bounces < 2; bounces++) {
        char text[900];
        snprintf(
            text, sizeof text,
            "fbd: 1\n"
            "ground: {points: {P: [0, 2]}, lines: {floor: {along: 0 deg}}}\n"
            "bodies:\n"
            "  heavy: {mass: 2, motion: {slide: {along: 90 deg}}, initial: {x: 1}, forces: [gravity]}\n"
            "  light: {mass: 1, motion: {slide: {along: 90 deg}}, initial: {x: 0.2}, forces: [gravity]}\n"
            "couplings: [{rope: {name: cable, through: [heavy.G, ground.P, light.G]}}]\n"
            "contacts: [{name: floor, between: [heavy.G, ground.floor], restitution: %s}]\n"
            "simulate: {until: 4 s}\n",
            bounces ? "0.3" : "0");
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        fbd_energy energy = fbd_result_energy(trial.result);
        double last = 0;
        for (int k = 0; trial_event(&trial, FBD_EVENT_REST, NULL, k) < HUGE_VAL; k++)
            last = trial_event(&trial, FBD_EVENT_REST, NULL, k);
        check_that(&checks, "done", trial.outcome == FBD_DONE);
        check_close(&checks, "both hold", last, end, 1e-9);
        check_close(&checks, "what is left", energy.kinetic + energy.potential, g * 1.2, 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_block_slides_or_tips),
        cmocka_unit_test(a_cradle_exchanges_its_ends),
        cmocka_unit_test(a_ball_hops_down_the_stairs),
        cmocka_unit_test(dominoes_fall_one_after_the_other),
        cmocka_unit_test(a_box_on_a_shaken_table_flies_once_a_period),
        cmocka_unit_test(flat_boxes_rest_when_their_series_ends),
        cmocka_unit_test(several_motions_are_an_event),
        cmocka_unit_test(an_impact_of_a_gripped_disc_says_that_it_is_one_of_several),
        cmocka_unit_test(statics_says_where_a_block_tips),
        cmocka_unit_test(a_rope_and_a_floor_strike_in_turn_until_both_hold),
        cmocka_unit_test(a_rod_jams_with_its_moment_of_momentum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
