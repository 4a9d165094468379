/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies on slides with friction, stops and winches, which motors, controllers, relays, tables, winds, loads along lines and masses
 * that vary drive (actuators.h), against a time stepping that knows no events (moreau.h). FBD_ACTUATORS=1000 tries so many,
 * FBD_ACTUATORS_FIRST=100 begins there, FBD_ACTUATORS_SEED=17 tries one and prints its model, FBD_ACTUATORS_STEPS is how many steps, _UNTIL when to look.
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

#include "actuators.h"
#include "gallery.h"
#include "thorough.h"

struct answers {
    struct act_values rough, fine, ours;
};

struct census {
    int tried, unfit, skipped, agree, ended, differ;
};

static double apart(const struct act_values *a, const struct act_values *b)
{
    double most = 0;
    for (int i = 0; i < a->count; i++) {
        double off = a->scale[i] * fabs(a->value[i] - b->value[i]);
        if (!(off <= most)) most = off;
    }
    return most;
}

static double doubt(const struct answers *answers)
{
    return apart(&answers->rough, &answers->fine);
}

static bool agree(const struct answers *answers)
{
    return apart(&answers->ours, &answers->fine) <= fmax(10 * doubt(answers), 3e-4);
}

/* More than one motion agrees with the forces, or two impacts are within a few steps, which take them for one. */
static bool is_open(struct trial *trial, double step)
{
    double last = -1;
    for (size_t i = 0; i < fbd_simulation_event_count(trial->simulation); i++) {
        fbd_event event = fbd_simulation_event(trial->simulation, i);
        if (event.kind == FBD_EVENT_SEVERAL) return true;
        if (event.kind != FBD_EVENT_IMPACT) continue;
        if (event.t != last && event.t - last < 4 * step) return true;
        last = event.t;
    }
    return false;
}

static void tell(uint64_t seed, const struct answers *answers)
{
    print_message("# %llu: %.3g apart (half the steps: %.2g):", (unsigned long long)seed,
                  apart(&answers->ours, &answers->fine), doubt(answers));
    for (int i = 0; i < answers->ours.count; i++)
        print_message(" %s %.6g for %.6g", answers->ours.name[i], answers->ours.value[i],
                      answers->fine.value[i]);
    print_message("\n");
}

static void compare(struct checks *checks, uint64_t seed, bool show, int steps, struct census *census)
{
    const double sensitive = 2e-3;
    static struct act_scene scene;
    static struct written text;
    const char *until = getenv("FBD_ACTUATORS_UNTIL");
    act_draw(seed, &scene);
    if (until) scene.until = strtod(until, NULL);
    act_write(&scene, &text);
    if (show) puts(text.all), fflush(stdout);
    struct answers answers = {act_step_to(&scene, steps / 2), act_step_to(&scene, steps), {0}};
    census->tried++;
    struct trial trial = trial_parse(text.all);
    trial_run(&trial, NULL);
    answers.ours = answers.fine;
    if (trial.outcome == FBD_DONE)
        for (int i = 0; i < answers.ours.count; i++)
            answers.ours.value[i] = trial_get(&trial, answers.ours.name[i]);
    for (int finer = 8;
         trial.outcome == FBD_DONE && finer && !agree(&answers) && doubt(&answers) <= sensitive; finer = 0) {
        answers.rough = act_step_to(&scene, steps * finer / 2);
        answers.fine = act_step_to(&scene, steps * finer);
    }
    if (trial.outcome != FBD_DONE && strstr(fbd_simulation_reason(trial.simulation), "does not fit")) {
        census->unfit++;
    } else if (trial.outcome != FBD_DONE) {
        bool open = doubt(&answers) > sensitive;
        census->ended += !open;
        census->skipped += open;
        if (!open) check_that(checks, "the run comes to its end", false);
        print_message("# %llu%s: %s\n", (unsigned long long)seed, open ? " (sensitive)" : "",
                      fbd_simulation_reason(trial.simulation));
    } else if (doubt(&answers) > sensitive ||
               (!agree(&answers) && is_open(&trial, scene.until / (8 * steps)))) {
        census->skipped++;
    } else if (check_that(checks, "time stepping says the same", agree(&answers))) {
        census->agree++;
        if (show) tell(seed, &answers);
    } else {
        census->differ++;
        tell(seed, &answers);
    }
    trial_close(&trial);
}

static void time_stepping_says_the_same(void **unused)
{
    struct checks checks = {0};
    struct census census = {0};
    long count = number_of("FBD_ACTUATORS", thorough() ? 60 : 10), seed = number_of("FBD_ACTUATORS_SEED", -1);
    long first = seed < 0 ? number_of("FBD_ACTUATORS_FIRST", 0) : seed;
    int steps = number_of("FBD_ACTUATORS_STEPS", 8000);
    (void)unused;
    for (long i = first; i < first + (seed < 0 ? count : 1); i++)
        compare(&checks, (uint64_t)i, seed >= 0, steps, &census);
    print_message("# %d tried, %d agree, %d differ, %d end, %d too sensitive, %d do not fit\n", census.tried,
                  census.agree, census.differ, census.ended, census.skipped, census.unfit);
    checks_end(&checks);
}

/* Scenes that went wrong, and why. */
static void what_went_wrong_does_not(void **unused)
{
    static const unsigned seeds[] = {
        144, /* a block that slides on sign(x + T v) comes to the speed of its belt, which took it off the switch */
    };
    struct checks checks = {0};
    struct census census = {0};
    const int count = sizeof seeds / sizeof *seeds;
    (void)unused;
    for (int i = 0; i < count; i++) compare(&checks, seeds[i], false, 8000, &census);
    check_that(&checks, "all are compared", census.agree == count);
    checks_end(&checks);
}

/* An integral that stands at its limit leaves it as what drives it turns, when its rate is rounding of either sign. */
static void a_limit_on_an_integral_is_left_as_its_rate_turns(void **unused)
{
    struct random_numbers numbers = {5};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < 300; i++) {
        double A = random_between(&numbers, 0.1, 0.4), w = random_between(&numbers, 2, 12);
        double c = random_between(&numbers, -0.1, 0.1), most = random_between(&numbers, 0.005, 0.05);
        char text[1200], e[200];
        snprintf(e, sizeof e, "(%.17g*sin(%.17g[1/s]*t + %.17g) + %.17g)/1[s]", A, w, 30 * c, c);
        snprintf(text, sizeof text,
                 "fbd: 1\nstates:\n  z: {unit: 1, rate: \"if(states.z >= %.17g, min(%s, 0[1/s]), "
                 "if(states.z <= -%.17g, max(%s, 0[1/s]), %s))\"}\n"
                 "bodies:\n  b: {mass: 1, motion: slide, forces: [applied: \"1[N]*states.z\"]}\n"
                 "simulate: {until: 3}\n",
                 most, e, most, e, e);
        struct trial trial = trial_parse(text);
        trial_run(&trial, NULL);
        check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
        check_close(&checks, "within its limits", fmax(0, fabs(trial_get(&trial, "states.z")) - most), 0,
                    1e-12);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_limit_on_an_integral_is_left_as_its_rate_turns),
        cmocka_unit_test(what_went_wrong_does_not),
        cmocka_unit_test(time_stepping_says_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
