/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Decks that are driven, swing or are carried, with boxes, discs and particles that lie, lean, slide, roll and fall on them
 * and off them (decks.h), against a time stepping that knows no events (moreau.h). FBD_DECKS=1000 tries so many;
 * stepped.h has the other variables.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>

#include "decks.h"
#include "gallery.h"
#include "stepped.h"

static struct deck_scene scene;
static const struct stepped_kind kind = {
    .name = "FBD_DECKS",
    .scenes = 5,
    .scene = &scene,
    .until = &scene.until,
    .draw = deck_draw,
    .write = deck_write,
    .step = deck_step,
};

static void time_stepping_says_the_same(void **unused)
{
    (void)unused;
    stepped_try(&kind);
}

/* Scenes that went wrong, and why. */
static void what_went_wrong_does_not(void **unused)
{
    static const unsigned seeds[] = {
        343,        /* two corners, on a slide, strike what a drive turns below them */
        1338, 1707, /* what drives take along was held by friction as it turned */
        662,  1152, /* impulses that press on guides were left as they are to 1e-5 */
    };
    (void)unused;
    stepped_try_each(&kind, seeds, sizeof seeds / sizeof *seeds);
}

/* A body on an upright slide with friction falls on a deck that rises and sinks on a base, which is driven below it: nothing
 * moves it along the deck, on which it slips. The friction of that, mu P, presses it on its guide, where mu_g mu P helps
 * to stop it: M u = P, m (1 - u) = P (1 + mu_g mu) downwards from 1 m/s. */
static void what_slips_on_is_pressed_on_its_guide(void **unused)
{
    const double m = 3, M = 2, mu = 0.6, mu_g = 0.4, P = 1 / (1 / M + (1 + mu_g * mu) / m);
    struct checks checks = {0};
    char text[700];
    (void)unused;
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n  base: {mass: 1, motion: {slide: {x: 0.1*sin(10*t)}}, forces: []}\n"
             "  deck: {parts: {p: {shape: prism, mass: %g, a: 0.1, b: 1}}, motion: {slide: {on: base, along: "
             "90 deg}}, forces: []}\n"
             "  body: {parts: {p: {shape: disc, mass: %g, radius: 0.1}}, motion: {slide: {along: 90 deg, "
             "through: [0, 0.15]}},\n"
             "    initial: {x: 0.02, v: -1}, forces: [normal: {two_sided: true}, friction: %g]}\n"
             "contacts: [{between: [body, deck], static: %g}]\nsimulate: {until: 0.04}\n",
             M, m, mu_g, mu);
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
    check_close(&checks, "the deck", trial_get(&trial, "deck.v"), -P / M, 1e-12);
    check_close(&checks, "the body", trial_get(&trial, "body.v"), -P / M, 1e-12);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_went_wrong_does_not),
        cmocka_unit_test(what_slips_on_is_pressed_on_its_guide),
        cmocka_unit_test(time_stepping_says_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
