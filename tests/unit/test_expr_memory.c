/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Expressions when memory runs out: no crash, no leak, and always a reason.
 */
#include "expr_scope.h"

#include "fail_alloc.h"
#include "notation_scope.h"

static const char *const texts[] = {
    "k*x + c*v - if(x > 0, F*sin(theta), 3*x^2) + clamp(F, -2, 7)*pulse(t, 3, 4)",
    "1+2*t-3+4-5+6-7+8-9+10-11+12-13+14-15+16-17+18-19+20-t*21+22-23+24*t-25+26-27+28-29+30-31+32-33+34",
    "30 deg",
    "F + x + foo*sin(t) - bar(2) + min(2)",
    "5 N + F",
    "10 mph",
    "4 N*t",
    "9.81 ms-2",
    "F*(θ + 1)",
    "2 F",
    "F/zero",
};

static void a_failed_allocation_ends_a_compilation_with_a_reason(void **state)
{
    (void)state;
    const struct expr_want want = {.dim = DIM_FORCE, .what = "value"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        for (size_t n = 0;; n++) {
            fbd_errors *errors = fbd_errors_new();
            struct arena arena = {0};
            struct scope scope = {.lookup = scope_lookup, .names = scope_list, .units = unit_si};
            fail_alloc_at(n);
            const struct expr *expr =
                expr_compile(&arena, texts[i], (struct pos){1, 1}, &scope, &want, errors);
            bool refused = fail_alloc_end();
            if (!expr) assert_true(fbd_errors_failed_count(errors) > 0);
            arena_free(&arena);
            fbd_errors_free(errors);
            if (!refused) break;
        }
    }
}

static void a_failed_allocation_ends_a_notation_with_a_reason(void **state)
{
    (void)state;
    static const char *const written[] = {"I_O\\ddot{\\theta} = -\\tfrac{1}{2} mgL\\sin^2\\theta",
                                          "ma = F/m g",
                                          "F_N = 2mg",
                                          "F = abc",
                                          "x = \\foo",
                                          "θ̈ = d²x/dt² e^{-ct} |v| 30°"};
    for (size_t i = 0; i < sizeof written / sizeof *written; i++)
        for (size_t n = 0;; n++) {
            fbd_errors *errors = fbd_errors_new();
            struct arena arena = {0};
            struct notation notation;
            const struct scope scope = notation_scope(derivation());
            fail_alloc_at(n);
            bool fine =
                notation_read(&arena, written[i], (struct pos){1, 1}, &scope, true, errors, &notation);
            bool refused = fail_alloc_end();
            if (!fine) assert_true(fbd_errors_failed_count(errors) > 0 || arena.failed);
            if (refused && fine) assert_true(arena.failed);
            arena_free(&arena);
            fbd_errors_free(errors);
            if (!refused) break;
        }
}

static void a_constant_without_memory_is_null(void **state)
{
    (void)state;
    struct arena arena = {0};
    fail_alloc_at(0);
    const struct expr *expr = expr_constant(&arena, 1, DIM_NONE);
    assert_true(fail_alloc_end());
    assert_null(expr);
    arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_failed_allocation_ends_a_compilation_with_a_reason),
        cmocka_unit_test(a_failed_allocation_ends_a_notation_with_a_reason),
        cmocka_unit_test(a_constant_without_memory_is_null),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
