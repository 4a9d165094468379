/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random stacks of two or three blocks on slides, one on the other, at rest at the start: by hand, every combination of stick
 * and slip is solved from Newton's equations and compared with the law of friction. The motion of the run is one of those that
 * agree, and an event `several` stands at t = 0 where others with other accelerations agree as well. With mu_k < mu_s a
 * combination that slips where another one sticks, beside all that it sticks at, is none: friction that holds holds.
 * FBD_NONUNIQUE=1000 tries so many, FBD_NONUNIQUE_SEED=17 begins there, FBD_NONUNIQUE_SHOW=1 prints the models.
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

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { most = 3, most_unknown = 3 * most, most_combinations = 27, room = 2000 };

struct block {
    double mass, along, mu_s, mu_k, push; /* `along` in the world */
};

struct stack {
    int count;
    struct block block[most];
};

struct solution {
    int mode[most]; /* 0 sticks, else the side on which it slips */
    double a[most];
};

static struct stack draw(struct random_numbers *numbers)
{
    struct stack stack = {.count = 2 + (int)(random_bits(numbers) % (most - 1))};
    double along = 0;
    for (int i = 0; i < stack.count; i++) {
        struct block *block = &stack.block[i];
        block->mass = random_between(numbers, 0.5, 4);
        along += random_between(numbers, -0.35, 0.35);
        block->along = along;
        block->mu_s = random_between(numbers, 0.1, 0.6);
        block->mu_k = block->mu_s * (random_chance(numbers, 0.8) ? random_between(numbers, 0.6, 1) : 1);
        block->push = random_perhaps(numbers, 0.5, -8, 8);
    }
    return stack;
}

/* Gauss's elimination; false where it is singular. x is the right side before. */
static bool solve(int n, double A[most_unknown][most_unknown], double *x)
{
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(A[i][k]) > fabs(A[best][k])) best = i;
        if (fabs(A[best][k]) < 1e-9) return false;
        for (int j = 0; j < n; j++) {
            double held = A[k][j];
            A[k][j] = A[best][j];
            A[best][j] = held;
        }
        double held = x[k];
        x[k] = x[best];
        x[best] = held;
        for (int i = 0; i < n; i++) {
            double share = i == k ? 0 : A[i][k] / A[k][k];
            for (int j = k; j < n; j++) A[i][j] -= share * A[k][j];
            x[i] -= share * x[k];
        }
    }
    for (int k = 0; k < n; k++) x[k] /= A[k][k];
    return true;
}

/* Unknown: relative accelerations, friction and normal forces. Two equations for each block, one for each mode. */
static bool solve_modes(const struct stack *stack, const int *mode, double *x)
{
    int n = stack->count;
    double A[most_unknown][most_unknown] = {{0}};
    memset(x, 0, most_unknown * sizeof *x);
    for (int i = 0; i < n; i++) {
        const struct block *block = &stack->block[i];
        for (int k = 0; k < 2; k++) {
            double *row = A[2 * i + k];
            for (int j = 0; j <= i + 1 && j < n; j++) {
                double angle = stack->block[j].along, e = k == 0 ? cos(angle) : sin(angle);
                double across = k == 0 ? -sin(angle) : cos(angle), sign = j == i ? -1 : j == i + 1 ? 1 : 0;
                if (j <= i) row[j] = block->mass * e;
                row[n + j] = sign * e;
                row[2 * n + j] = sign * across;
            }
            x[2 * i + k] = block->push * (k == 0 ? cos(block->along) : sin(block->along)) -
                           (k == 1 ? 9.81 * block->mass : 0);
        }
        double *row = A[2 * n + i];
        row[mode[i] == 0 ? i : n + i] = 1;
        if (mode[i] != 0) row[2 * n + i] = mode[i] * block->mu_k;
    }
    return solve(3 * n, A, x);
}

/* The sides of all limits are clear by this. */
static const double clear_by = 1e-4;

/* 1 where the modes agree with the law, 0 where they do not, -1 where that is not clear. */
static int agrees(const struct stack *stack, const int *mode, const double *x)
{
    int n = stack->count, verdict = 1;
    for (int i = 0; i < n; i++) {
        double a = x[i], f = x[n + i], N = x[2 * n + i];
        double left = mode[i] == 0 ? stack->block[i].mu_s * N - fabs(f) : mode[i] * a;
        if (N < clear_by || fabs(left) < clear_by) return -1;
        if (left < 0) verdict = 0;
    }
    return verdict;
}

/* How many agree, into `found`; -1 where that is not clear. */
static int enumerate(const struct stack *stack, struct solution *found)
{
    int count = 0, all = stack->count == 2 ? 9 : 27;
    for (int number = 0; number < all; number++) {
        struct solution one = {{0}, {0}};
        double x[most_unknown];
        for (int i = 0, rest = number; i < stack->count; i++, rest /= 3) one.mode[i] = rest % 3 - 1;
        if (!solve_modes(stack, one.mode, x)) return -1;
        int verdict = agrees(stack, one.mode, x);
        if (verdict < 0) return -1;
        memcpy(one.a, x, (size_t)stack->count * sizeof *x);
        if (verdict > 0) found[count++] = one;
    }
    return count;
}

static bool holds_more(const struct stack *stack, const struct solution *more, const struct solution *less)
{
    bool any = false;
    for (int i = 0; i < stack->count; i++) {
        if (more->mode[i] != 0 && less->mode[i] == 0) return false;
        any |= more->mode[i] == 0 && less->mode[i] != 0 && stack->block[i].mu_k < stack->block[i].mu_s;
    }
    return any;
}

static bool same(const struct stack *stack, const struct solution *one, const double *a)
{
    double most_off = 0;
    for (int i = 0; i < stack->count; i++) most_off = fmax(most_off, fabs(one->a[i] - a[i]));
    return most_off < 1e-6;
}

/* Does another motion than that of the accelerations a agree? */
static bool others_agree(const struct stack *stack, const struct solution *found, int count, const double *a)
{
    for (int k = 0; k < count; k++) {
        bool counts = !same(stack, &found[k], a);
        for (int l = 0; l < count; l++) counts &= !holds_more(stack, &found[l], &found[k]);
        if (counts) return true;
    }
    return false;
}

static void write(const struct stack *stack, char *text)
{
    int length = snprintf(text, room, "fbd: 1\nbodies:\n");
    for (int i = 0; i < stack->count; i++) {
        const struct block *block = &stack->block[i];
        char on[20] = "";
        if (i > 0) snprintf(on, sizeof on, "on: b%d, ", i - 1);
        length += snprintf(
            text + length, (size_t)(room - length),
            "  b%d: {mass: %.17g, motion: {slide: {%salong: %.17g}}, forces: [gravity, normal, friction: "
            "{static: %.17g, kinetic: %.17g}, applied: {name: push, value: %.17g}]}\n",
            i, block->mass, on, block->along - (i > 0 ? stack->block[i - 1].along : 0), block->mu_s,
            block->mu_k, block->push);
    }
    snprintf(text + length, (size_t)(room - length), "simulate: {until: 1e-3}\n");
}

struct tally {
    int clear, several;
};

static void compare(struct checks *checks, const struct stack *stack, int number, struct tally *tally)
{
    struct solution found[most_combinations];
    char text[room], label[80], name[8];
    int count = enumerate(stack, found);
    if (count < 0) return;
    write(stack, text);
    if (getenv("FBD_NONUNIQUE_SHOW")) puts(text);
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    double a[most], until = 1e-3;
    for (int i = 0; i < stack->count; i++) {
        snprintf(name, sizeof name, "b%d.v", i);
        a[i] = trial_get(&trial, name) / until;
    }
    bool known = false;
    for (int k = 0; k < count; k++) known |= same(stack, &found[k], a);
    snprintf(label, sizeof label, "stack %d: its motion is one of %d that agree", number, count);
    check_that(checks, label, trial.outcome == FBD_DONE && known);
    bool told = trial_event(&trial, FBD_EVENT_SEVERAL, NULL, 0) == 0,
         want = others_agree(stack, found, count, a);
    snprintf(label, sizeof label, "stack %d: an event `several` at the start, %s", number,
             want ? "yes" : "no");
    check_that(checks, label, told == want);
    tally->clear++;
    tally->several += want;
    trial_close(&trial);
}

static void motions_that_agree_are_told(void **unused)
{
    const int draws = number_of("FBD_NONUNIQUE", draws_of(400)), first = number_of("FBD_NONUNIQUE_SEED", 1);
    struct checks checks = {0};
    struct tally tally = {0, 0};
    (void)unused;
    for (int i = first; i < first + draws; i++) {
        struct random_numbers numbers = {(uint64_t)i};
        struct stack stack = draw(&numbers);
        compare(&checks, &stack, i, &tally);
    }
    print_message("# of %d stacks that are clear %d have several motions\n", tally.clear, tally.several);
    check_that(&checks, "most are clear", tally.clear > draws / 2);
    if (draws >= 400) check_that(&checks, "some have several motions", tally.several > 0);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(motions_that_agree_are_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
