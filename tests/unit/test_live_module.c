/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What pages ask the module for: derivations checked, values found, notes written and answers graded, as JSON.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../../lib/live/module/module.h"

static const char right[] = "fbd: 1\n"
                            "parameters: {m: 2 kg, F: 10 N}\n"
                            "bodies:\n"
                            "  block:\n"
                            "    mass: m\n"
                            "    motion: slide\n"
                            "    forces: [applied: {name: push, value: F}]\n"
                            "    hand: m*a = F\n"
                            "simulate: {until: 1 s}\n";

/* A text with one part of it replaced; to be freed. */
static char *with(const char *text, const char *part, const char *other)
{
    const char *at = strstr(text, part);
    assert_non_null(at);
    char *made = calloc(1, strlen(text) + strlen(other) + 1);
    assert_non_null(made);
    strncat(made, text, (size_t)(at - text));
    strcat(made, other);
    strcat(made, at + strlen(part));
    return made;
}

static void says(char *json, const char *part)
{
    assert_non_null(json);
    if (!strstr(json, part)) fail_msg("no %s in %s", part, json);
    free(json);
}

static void derivations_are_checked(void **unused)
{
    (void)unused;
    says(live_check_hand(right, "right.yaml"), "\"hand\":{\"differing\":0,\"text\":\"block: m*a = F");
    char *wrong = with(right, "m*a = F", "m*a = 2*F");
    says(live_check_hand(wrong, "wrong.yaml"), "\"hand\":{\"differing\":1,");
    says(live_check_hand(wrong, "wrong.yaml"), "\\u000a"); /* lines of the text */
    free(wrong);
    says(live_check_hand("fbd: 1\nbodies: 3\n", "none.yaml"), "\"hand\":null}");
    says(live_check_hand("fbd: 1\nbodies: 3\n", "none.yaml"), "\"id\":\"wrong-type\"");
}

static void a_pull_is_written_into_the_text(void **unused)
{
    (void)unused;
    says(live_pulled(right, "right.yaml", "block", "0 0 0 0.5 1 0", 0, 0, 100, 0, 1),
         "[[0 s, 0 m], [0.5 s, 1 m], [1 s, 1 m]]");
    says(live_pulled(right, "right.yaml", "blok", "0 0 0 0.5 1 0", 0, 0, 100, 0, 1),
         "\"id\":\"unknown-body\"");
    says(live_pulled(right, "right.yaml", "block", "", 0, 0, 100, 0, 1), "\"text\":null}");
}

static void values_are_found(void **unused)
{
    (void)unused;
    says(live_find(right, "right.yaml", "F = 1..30 N: block.x = 4 m", 0), "\"value\": 16"); /* F t^2/(2 m) */
    says(live_find(right, "right.yaml", "G = 1..30 N: block.x = 4 m", 0), "\"id\":\"unknown-parameter\"");
}

static void notes_are_written(void **unused)
{
    (void)unused;
    says(live_note(right, "right.yaml", ""), "\"note\":\"<!DOCTYPE html>");
    says(live_note("fbd: 1\nbodies: 3\n", "none.yaml", ""), "\"note\":null}");
}

static void answers_are_graded(void **unused)
{
    (void)unused;
    says(live_grade(right, "", right, "anna", 0), "\"passed\": true");
    char *wrong = with(right, "value: F", "value: -F");
    says(live_grade(right, "", wrong, "anna", 0), "\"kind\": \"sense\"");
    free(wrong);
    says(live_grade(right, "", "", "anna", 0), "\"gradable\": false");
    says(live_grade("fbd: 1\nbodies: 3\n", "", right, "anna", 0), "\"grade\":null}");
}

static void details_are_for_the_teacher(void **unused)
{
    (void)unused;
    char *other = with(right, "name: push, value: F", "name: shove, value: F/2");
    says(live_grade(right, "", other, "anna", 1), "push");
    char *json = live_grade(right, "", other, "anna", 0);
    assert_non_null(json);
    assert_null(strstr(json, "push"));
    free(json);
    free(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivations_are_checked), cmocka_unit_test(a_pull_is_written_into_the_text),
        cmocka_unit_test(values_are_found),        cmocka_unit_test(notes_are_written),
        cmocka_unit_test(answers_are_graded),      cmocka_unit_test(details_are_for_the_teacher),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
