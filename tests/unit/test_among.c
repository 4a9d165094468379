/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * `among` of contacts: a file has the same motion, to the last bit, as one that lists the pairs by hand.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>

#include "gallery.h"

/* A disc on a slide along the floor, with a box on it that a weld fixes to a rod; a pendulum, and two particles. */
static const char scene[] =
    "fbd: 1\n"
    "ground: {lines: {floor: {along: 0 deg}, wall: {along: 90 deg, through: [2, 0]}}}\n"
    "bodies:\n"
    "  disc: {shape: disc, radius: 0.1 m, mass: 1 kg, motion: planar, initial: {x: 0.7 m, y: 0.5 m, vx: 1}, "
    "forces: [gravity]}\n"
    "  box: {shape: prism, a: 0.2 m, b: 0.2 m, axis: z, mass: 2 kg, motion: planar, initial: {x: 1.3 m, y: "
    "0.4 m, omega: 1}, forces: [gravity]}\n"
    "  slider: {shape: prism, a: 0.2 m, b: 0.1 m, axis: z, mass: 1 kg, motion: {slide: {line: floor}}, "
    "initial: {x: -1 m, v: 1 m/s}}\n"
    "  rod: {shape: rod, length: 0.3 m, mass: 1 kg, motion: {pivot: {on: slider, at: [0, 0.05], point: "
    "[-0.15, 0]}}, initial: {theta: 80 deg}, forces: [gravity]}\n"
    "  p: {mass: 0.1 kg, motion: particle, initial: {x: 0.3 m, y: 0.3 m}, forces: [gravity]}\n"
    "  q: {mass: 0.1 kg, motion: particle, initial: {x: 0.4 m, y: 0.2 m}, forces: [gravity]}\n"
    "contacts:\n"
    "%s"
    "simulate: {until: 0.8 s}\n";

static struct trial open_with(const char *contacts)
{
    char text[6000];
    snprintf(text, sizeof text, scene, contacts);
    return trial_parse(text);
}

/* The motions by both lists, and the names of their contacts, agree. */
static void compare(const char *by_among, const char *by_hand)
{
    static const char *const names[] = {"disc.x", "disc.y", "disc.theta", "box.x",    "box.y",    "box.theta",
                                        "p.x",    "p.y",    "q.x",        "slider.x", "rod.theta"};
    struct checks checks = {0};
    const fbd_options options = FBD_OPTIONS_DEFAULT;
    struct trial among = open_with(by_among), hand = open_with(by_hand);
    trial_start(&among, &options);
    trial_start(&hand, &options);
    trial_finish(&among);
    trial_finish(&hand);
    check_that(&checks, "there are events", fbd_simulation_event_count(hand.simulation) > 5);
    check_that(&checks, "as many events",
               fbd_simulation_event_count(among.simulation) == fbd_simulation_event_count(hand.simulation));
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        check_close(&checks, names[i], trial_get(&among, names[i]), trial_get(&hand, names[i]), 0);
    trial_close(&among);
    trial_close(&hand);
    checks_end(&checks);
}

/* Joined pairs (the slider and its floor, the rod and its slider) and the two particles are left out. */
static void all_pairs_are_those_that_are_not_joined(void **unused)
{
    (void)unused;
    compare("  - {among: all, static: 0.3}\n",
            "  - {name: contact_disc_box, between: [disc, box], static: 0.3}\n"
            "  - {name: contact_disc_slider, between: [disc, slider], static: 0.3}\n"
            "  - {name: contact_disc_rod, between: [disc, rod], static: 0.3}\n"
            "  - {name: contact_disc_p, between: [disc, p], static: 0.3}\n"
            "  - {name: contact_disc_q, between: [disc, q], static: 0.3}\n"
            "  - {name: contact_disc_floor, between: [disc, ground.floor], static: 0.3}\n"
            "  - {name: contact_disc_wall, between: [disc, ground.wall], static: 0.3}\n"
            "  - {name: contact_box_slider, between: [box, slider], static: 0.3}\n"
            "  - {name: contact_box_rod, between: [box, rod], static: 0.3}\n"
            "  - {name: contact_box_p, between: [box, p], static: 0.3}\n"
            "  - {name: contact_box_q, between: [box, q], static: 0.3}\n"
            "  - {name: contact_box_floor, between: [box, ground.floor], static: 0.3}\n"
            "  - {name: contact_box_wall, between: [box, ground.wall], static: 0.3}\n"
            "  - {name: contact_slider_p, between: [slider, p], static: 0.3}\n"
            "  - {name: contact_slider_q, between: [slider, q], static: 0.3}\n"
            "  - {name: contact_slider_wall, between: [slider, ground.wall], static: 0.3}\n"
            "  - {name: contact_rod_p, between: [rod, p], static: 0.3}\n"
            "  - {name: contact_rod_q, between: [rod, q], static: 0.3}\n"
            "  - {name: contact_rod_floor, between: [rod, ground.floor], static: 0.3}\n"
            "  - {name: contact_rod_wall, between: [rod, ground.wall], static: 0.3}\n"
            "  - {name: contact_p_floor, between: [p, ground.floor], static: 0.3}\n"
            "  - {name: contact_p_wall, between: [p, ground.wall], static: 0.3}\n"
            "  - {name: contact_q_floor, between: [q, ground.floor], static: 0.3}\n"
            "  - {name: contact_q_wall, between: [q, ground.wall], static: 0.3}\n");
}

static void an_entry_of_its_own_and_the_first_list_come_before(void **unused)
{
    (void)unused;
    compare("  - {among: [disc, box, ground.floor], restitution: 0.3}\n"
            "  - {name: side, among: [disc, p, ground.floor], restitution: 0.6}\n"
            "  - {name: own, between: [ground.floor, box], restitution: 0.1}\n",
            "  - {name: contact_disc_box, between: [disc, box], restitution: 0.3}\n"
            "  - {name: contact_disc_floor, between: [disc, ground.floor], restitution: 0.3}\n"
            "  - {name: side_disc_p, between: [disc, p], restitution: 0.6}\n"
            "  - {name: side_p_floor, between: [p, ground.floor], restitution: 0.6}\n"
            "  - {name: own, between: [ground.floor, box], restitution: 0.1}\n");
}

/* Names of contacts in events are those of the pairs. */
static void events_name_the_contacts_of_pairs(void **unused)
{
    (void)unused;
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "ground: {lines: {floor: {along: 0 deg}}}\n"
        "bodies:\n"
        "  a: {shape: disc, radius: 0.1 m, mass: 1 kg, motion: planar, initial: {y: 0.1 m}, forces: "
        "[gravity, applied: "
        "{name: F, value: \"10[N/s]*t\", angle: -90 deg}]}\n"
        "contacts: all\n"
        "simulate: {until: 2 s, events: [{name: pressed, when: contact_a_floor.normal > 15 N, stop: "
        "true}]}\n");
    const fbd_options options = FBD_OPTIONS_DEFAULT;
    struct checks checks = {0};
    trial_start(&trial, &options);
    check_close(&checks, "N = m g + 10 t", trial_to_event(&trial, FBD_EVENT_USER, "pressed", 0),
                (15 - 9.81) / 10, 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_pairs_are_those_that_are_not_joined),
        cmocka_unit_test(an_entry_of_its_own_and_the_first_list_come_before),
        cmocka_unit_test(events_name_the_contacts_of_pairs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
