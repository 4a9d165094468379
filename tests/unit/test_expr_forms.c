/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The forms in which a program runs for plain values (parts, steps, the frame) give the same bits: each text
 * is evaluated in every form that it has.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after its prerequisites */
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "expr/program.h"
#include "random_numbers.h"

enum { text_size = 2000, most_switches = 64, trials = 4000 };

static const unsigned seed = 90125;

/* Only t, p and q exist, all pure numbers. */
static struct symbol lookup(void *context, const char *name, struct pos at)
{
    (void)context, (void)at;
    int slot = strcmp(name, "t") == 0 ? 0 : strcmp(name, "p") == 0 ? 1 : strcmp(name, "q") == 0 ? 2 : -1;
    if (slot < 0) return (struct symbol){.kind = symbol_unknown};
    return (struct symbol){.kind = symbol_variable, .dim = DIM_NONE, .slot = slot};
}

/* NULL for what has no finite value, as 1/0. */
static const struct expr *compile(struct arena *arena, const char *text)
{
    struct scope scope = {.lookup = lookup, .units = unit_si};
    struct expr_want want = {.any_dim = true, .what = "value"};
    fbd_errors *errors = fbd_errors_new();
    const struct expr *expr = expr_compile(arena, text, (struct pos){1, 1}, &scope, &want, errors);
    fbd_errors_free(errors);
    return expr;
}

static bool same_bits(double a, double b)
{
    uint64_t x, y;
    memcpy(&x, &a, sizeof x);
    memcpy(&y, &b, sizeof y);
    return x == y || (isnan(a) && isnan(b));
}

/* In every form that it has. */
static void check_forms(const struct expr *expr, const char *text, double t, const double *y,
                        const int *branch)
{
    struct expr on_frame = *expr, in_steps = *expr;
    on_frame.parts = in_steps.parts = NULL;
    on_frame.steps = NULL;
    double frame = expr_eval(&on_frame, t, y, branch), steps = expr_eval(&in_steps, t, y, branch),
           best = expr_eval(expr, t, y, branch);
    if (!same_bits(best, frame) || !same_bits(steps, frame))
        fail_msg(
            "seed %u: `%s` at t = %.17g, p = %.17g, q = %.17g: %.17g, in steps %.17g, on the frame %.17g",
            seed, text, t, y[0], y[1], best, steps, frame);
}

/* ---- which form a text has */

static void simple_sums_need_no_program(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int parts;
    } rows[] = {
        {"5*sin(3*t)", 1},
        {"3*cos(2*t + 0.5)", 1},
        {"cos(0.5 - 2*t)", 1},
        {"-2*p - 3*p^3", 2},
        {"p*p*p", 1},
        {"1 + 2*q - 3*q^2", 3},
        {"sin(2*t) + cos(3*t)", 2},
        {"-(2*p + 5*sin(p))", 2},
        {"t", 1},
        {"4*p*p", 0}, /* (4 p) p: another order than 4 p^2 */
        {"2*(p + 1)", 0},
        {"p + (q + t)", 0},
        {"p^4", 0},
        {"sin(t^2)", 0},
        {"p*q", 0},
        {"if(t < 1, 2*p, 3*p)", 0},
        {"1 + t + t^2 + t^3 + p + q + p^2", 0}, /* too many */
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct arena arena = {0};
        const struct expr *expr = compile(&arena, rows[i].text);
        assert_non_null(expr);
        if (expr->part_count != rows[i].parts)
            fail_msg("`%s` has %d parts instead of %d", rows[i].text, expr->part_count, rows[i].parts);
        arena_free(&arena);
    }
}

static void a_result_that_is_read_twice_is_kept(void **state)
{
    (void)state;
    static const char *const texts[] = {"pulse(mod(t, 3), 0, 0.3) - pulse(mod(t, 2), 0.47, 0.3)",
                                        "clamp(p + q, -1, 1)*clamp(p*q, 0, 2)",
                                        "(p + q)^2*(p + q)",
                                        "(p*q - t)/(p*q + t)",
                                        "p - q*t",
                                        "p*q - (q - t*p)"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct arena arena = {0};
        const struct expr *expr = compile(&arena, texts[i]);
        assert_non_null(expr);
        assert_non_null(expr->steps);
        for (int k = 0; k < 40; k++)
            check_forms(expr, texts[i], 0.1 * k, (double[]){0.7 - 0.13 * k, -1 + 0.09 * k}, NULL);
        arena_free(&arena);
    }
}

/* ---- at random */

static int pick(struct random_numbers *numbers, int count)
{
    return (int)(random_bits(numbers) % (unsigned)count);
}

static void write(char *text, const char *piece)
{
    size_t used = strlen(text);
    snprintf(text + used, text_size - used, "%s", piece);
}

static void write_random(struct random_numbers *numbers, char *text, int depth)
{
    static const char *const leaves[] = {"t", "p", "q", "2", "0.3", "(-1.7)"};
    static const char *const infix[] = {" + ", " - ", "*", "/", "*", " + "};
    static const char *const calls[] = {"sin(", "cos(", "exp(", "sqrt(", "abs(", "-(", "sign(", "floor("};
    static const char *const pairs[] = {"min(", "mod(", "hypot(", "atan2("};
    int choice = depth == 0 ? 0 : pick(numbers, 8);
    if (choice == 0) {
        write(text, leaves[pick(numbers, 6)]);
    } else if (choice <= 4) {
        write(text, "(");
        write_random(numbers, text, depth - 1);
        write(text, infix[pick(numbers, 6)]);
        write_random(numbers, text, depth - 1);
        write(text, ")");
    } else if (choice == 5) {
        write(text, "(");
        write_random(numbers, text, depth - 1);
        write(text, pick(numbers, 2) ? ")^2" : ")^3");
    } else if (choice == 6) {
        write(text, calls[pick(numbers, 8)]);
        write_random(numbers, text, depth - 1);
        write(text, ")");
    } else {
        write(text, pairs[pick(numbers, 4)]);
        write_random(numbers, text, depth - 1);
        write(text, ", ");
        write_random(numbers, text, depth - 1);
        write(text, ")");
    }
}

static void all_forms_give_the_same_bits(void **state)
{
    (void)state;
    struct random_numbers numbers = {seed};
    int in_parts = 0, in_steps = 0;
    for (int trial = 0; trial < trials; trial++) {
        char text[text_size] = "";
        write_random(&numbers, text, 1 + trial % 5);
        struct arena arena = {0};
        const struct expr *expr = compile(&arena, text);
        if (expr && expr_switches(expr) <= most_switches) {
            in_parts += expr->parts != NULL;
            in_steps += expr->steps != NULL;
            for (int k = 0; k < 8; k++) {
                double t = random_between(&numbers, -3, 3);
                double y[] = {random_between(&numbers, -3, 3), random_between(&numbers, -3, 3)};
                int branch[most_switches] = {0};
                check_forms(expr, text, t, y, NULL);
                expr_resolve(expr, time_dd_at(t), y, 1, (double[]){1, 1}, NULL, branch);
                y[0] += 0.1;
                check_forms(expr, text, t, y, branch);
            }
        }
        arena_free(&arena);
    }
    assert_in_range(in_parts, 100, trials); /* each form was there often enough to say something */
    assert_in_range(in_steps, 1000, trials);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(simple_sums_need_no_program),
        cmocka_unit_test(a_result_that_is_read_twice_is_kept),
        cmocka_unit_test(all_forms_give_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
