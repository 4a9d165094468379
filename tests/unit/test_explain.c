/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What --explain says of small scenes: effects with their number and reason, what is not simulated, events,
 * structure, method.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd.h"
#include "fbd_export.h"
#include "scenes.h"

#include <stdlib.h>
#include <string.h>

static char *explain(const char *scene, const char *method)
{
    fbd_model *model = model_from(scene);
    const fbd_options options = {.until = NAN, .method = method};
    char *text = fbd_explain(model, &options);
    assert_non_null(text);
    fbd_model_free(model);
    return text;
}

static void expect(const char *text, const char *piece)
{
    if (!strstr(text, piece)) fail_msg("no `%s` in:\n%s", piece, text);
}

static void expect_none(const char *text, const char *piece)
{
    if (strstr(text, piece)) fail_msg("`%s` in:\n%s", piece, text);
}

static const char two_bodies[] = "fbd: 1\n"
                                 "bodies:\n"
                                 "  block:\n"
                                 "    mass: 2\n"
                                 "    motion: {slide: {along: 0 deg}}\n"
                                 "    forces:\n"
                                 "      - gravity\n"
                                 "      - normal\n"
                                 "      - friction: 0.3\n"
                                 "      - applied: {name: push, value: \"3*sin(2*t)\"}\n"
                                 "      - applied: {name: pull, value: \"4*abs(v)\"}\n"
                                 "  bob:\n"
                                 "    shape: point\n"
                                 "    mass: 1\n"
                                 "    center: [0, -1]\n"
                                 "    motion: {pivot: {at: [0, 0]}}\n"
                                 "    forces: [gravity]\n"
                                 "simulate: {until: 1}\n";

static void effects_are_counted_with_their_reasons(void **unused)
{
    (void)unused;
    char *text = explain(two_bodies, NULL);
    expect(text, "Coordinates (2)");
    expect(text, "Effects simulated (6)");
    expect(text, "gravity (2)               conservative: V = m g h\n      block.gravity, bob.gravity\n");
    expect(text, "applied force (1)         not conservative: it depends on time\n      block.push\n");
    expect(text, "applied force (1)         not conservative: it depends on velocity\n      block.pull\n");
    free(text);
}

static void what_is_not_listed_is_named_with_what_it_would_need(void **unused)
{
    (void)unused;
    char *text = explain(two_bodies, NULL);
    expect(text, "drag: list `drag: {linear: ..., quadratic: ...}`\n      on block, bob\n");
    expect(text, "under `moments`\n      on bob\n");
    expect_none(text, "weight: list");
    expect_none(text, "forces of your own"); /* one body has some */
    free(text);
    text = explain("fbd: 1\nbodies:\n  b: {mass: 1, motion: {particle: {}}}\nsimulate: {until: 1}\n", NULL);
    expect(text, "Effects simulated (0)\n  none: every body keeps its velocity");
    expect(text, "weight: list `gravity`\n      on b\n");
    expect_none(text, "dry friction: list"); /* which a particle cannot have */
    expect(text, "none: nothing interrupts the steps");
    free(text);
}

static void events_and_structure_are_those_of_the_plan(void **unused)
{
    (void)unused;
    char *text = explain(two_bodies, NULL);
    expect(text, "1  friction: stopping, sticking, breaking away");
    expect(text, "1  switch in an expression");
    expect(text, "not watched: 1 normal force is constant");
    expect(text, "2  coordinate with an equation of its own");
    expect(text, "2 bodies are on the ground alone");
    expect(text, "forces change with time on 1 of 2 bodies");
    expect(text, "forces change with the place on 1 of 2 bodies");
    expect(text, "1  held by friction: nothing to compute");
    expect(text, "1  a scalar equation: one line");
    free(text);
}

static void the_method_is_given_with_the_reason_for_it(void **unused)
{
    (void)unused;
    char *text = explain(two_bodies, NULL);
    expect(text, "Method: auto, the default");
    free(text);
    text = explain(two_bodies, "rkf45");
    expect(text, "Method: rkf45 (");
    expect(text, "selected by --method");
    free(text);
}

/* 60 bodies in the plane have 360 states. */
static void a_large_scene_is_told_in_few_lines(void **unused)
{
    (void)unused;
    enum { bodies = 60 };
    char scene[bodies * 64 + 100] = "fbd: 1\nbodies:\n";
    size_t used = strlen(scene);
    for (int i = 0; i < bodies; i++) {
        used += (size_t)snprintf(scene + used, sizeof scene - used,
                                 "  b%d: {shape: sphere, radius: 1, mass: 1, motion: planar}\n", i);
    }
    snprintf(scene + used, sizeof scene - used, "simulate: {until: 1}\n");
    char *text = explain(scene, NULL);
    expect(text, "and those of 40 more bodies");
    expect(text, "on b0, b1, b2, b3 and 56 more\n");
    expect(text, "always: beyond 200 states");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(effects_are_counted_with_their_reasons),
        cmocka_unit_test(what_is_not_listed_is_named_with_what_it_would_need),
        cmocka_unit_test(events_and_structure_are_those_of_the_plan),
        cmocka_unit_test(the_method_is_given_with_the_reason_for_it),
        cmocka_unit_test(a_large_scene_is_told_in_few_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
