/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Limits of expressions: how long and how deep a text may be, and that what goes beyond is refused quickly.
 */
#include "expr_value.h"

#include <stdio.h>
#include <stdlib.h>

static bool is_wrong(const char *text)
{
    struct expr_want want = {.any_dim = true, .what = "value"};
    struct trial trial = try_text(text, &want, unit_si);
    bool wrong = !trial.expr;
    end_trial(&trial);
    return wrong;
}

/* `start`, then `count` times `piece`, then `end`; the caller frees it. */
static char *repeat(const char *start, const char *piece, size_t count, const char *end)
{
    size_t size = strlen(start) + count * strlen(piece) + strlen(end) + 1;
    char *text = malloc(size);
    assert_non_null(text);
    size_t used = (size_t)snprintf(text, size, "%s", start);
    for (size_t i = 0; i < count; i++) used += (size_t)snprintf(text + used, size - used, "%s", piece);
    snprintf(text + used, size - used, "%s", end);
    return text;
}

static void check_limit(const char *start, const char *piece, const char *end, size_t most, double value)
{
    char *fits = repeat(start, piece, most, end), *too_long = repeat(start, piece, most + 1, end);
    assert_true(value_of(fits) == value);
    assert_true(is_wrong(too_long));
    free(fits);
    free(too_long);
}

static void long_sums_are_compiled_up_to_4096_operations(void **state)
{
    (void)state;
    check_limit("0*t", "+t", "", 4095, 4095 * now);
}

static void parentheses_nest_up_to_100_deep(void **state)
{
    (void)state;
    char *close = repeat("t", ")", 100, ""), *open = repeat("", "(", 100, close);
    assert_true(value_of(open) == now);
    char *one_more = repeat("(", open, 1, ")");
    assert_true(is_wrong(one_more));
    free(close);
    free(open);
    free(one_more);
    check_limit("", "-", "t", 100, now);
}

static void absurd_texts_are_refused_quickly(void **state)
{
    (void)state;
    const struct {
        const char *start, *piece, *end;
        size_t count;
    } rows[] = {
        {"", "(", "", 16000},     {"", "2^", "t", 8000}, {"", "min(", "", 4000},  {"", "not ", "", 4000},
        {"", "x", "", 16384},     {"t", "+t", "", 9000}, {"1[", "(", "]", 16000}, {"5 ", "m*", "x", 8000},
        {"1[", "m*", "m]", 8000}, {"", "if(", "", 5000}, {"t", "+1", "e9", 8000},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char *text = repeat(rows[i].start, rows[i].piece, rows[i].count, rows[i].end);
        assert_true(is_wrong(text));
        free(text);
    }
}

static void more_different_numbers_than_registers_are_refused(void **state)
{
    (void)state;
    char text[16384] = "t", *tail = text + 1;
    int count = 0;
    while (count < 1022) tail += sprintf(tail, "+%d", ++count);
    assert_true(value_of(text) == now + 1022.0 * 1023 / 2);
    while (count < 1030) tail += sprintf(tail, "+%d", ++count);
    assert_true(is_wrong(text));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_sums_are_compiled_up_to_4096_operations),
        cmocka_unit_test(parentheses_nest_up_to_100_deep),
        cmocka_unit_test(absurd_texts_are_refused_quickly),
        cmocka_unit_test(more_different_numbers_than_registers_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
