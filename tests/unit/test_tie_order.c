/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Chains of loops cost time and memory in proportion to their length, in whatever order a file lists them. A
 * row of four-bars, with a block that slips on each coupler: its friction is an unknown beside the rows.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/modes.h"
#include "dynamics/state.h"
#include "random_numbers.h"
#include "scenes.h"

enum { most = 320 };

/* 0 .. count - 1, shuffled when there is a seed. */
static void list(int *places, int count, uint64_t seed)
{
    struct random_numbers numbers = {seed};
    for (int i = 0; i < count; i++) places[i] = i;
    for (int i = count - 1; i > 0 && seed > 0; i--) {
        int k = (int)random_between(&numbers, 0, i + 0.999), kept = places[i];
        places[i] = places[k];
        places[k] = kept;
    }
}

static fbd_model *row_of(int windows, bool blocks, uint64_t seed)
{
    int bodies[most + 1], pins[most];
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    list(bodies, windows + 1, seed);
    list(pins, windows, seed);
    fprintf(out, "fbd: 1\nbodies:\n");
    for (int k = 0; k <= windows; k++) {
        int i = bodies[k];
        fprintf(out, "  v%d: {shape: rod, mass: %d, length: 1, motion: {pivot: {at: [%d, 0], point: left}}, ",
                i, 1 + i % 3, i);
        fprintf(out, "initial: {theta: 1 rad, omega: -1}, forces: [gravity]}\n");
        if (i == windows) continue;
        fprintf(out, "  h%d: {shape: rod, mass: 2, length: 1, motion: {pivot: {on: v%d, at: right, ", i, i);
        fprintf(out, "point: left}}, initial: {theta: -1 rad, omega: 1}, forces: [gravity]}\n");
        if (!blocks) continue;
        fprintf(out, "  b%d: {mass: 0.5, motion: {slide: {on: h%d, through: [0.5, 0], along: 0 deg}}, ", i,
                i);
        fprintf(out, "initial: {v: 0.5}, forces: [gravity, {normal: {two_sided: true}}, ");
        fprintf(out, "{friction: {static: 0.3, kinetic: 0.2}}]}\n");
    }
    fprintf(out, "couplings:\n");
    for (int k = 0; k < windows; k++)
        fprintf(out, "  - pin: {name: p%d, between: [h%d.right, v%d.right]}\n", pins[k], pins[k],
                pins[k] + 1);
    fclose(out);
    fbd_model *model = model_from(text);
    free(text);
    return model;
}

static size_t kept_by(int windows, bool blocks, uint64_t seed)
{
    fbd_model *model = row_of(windows, blocks, seed);
    size_t size = model->tree->envelope_size;
    fbd_model_free(model);
    return size;
}

static void what_is_kept_grows_with_the_length_in_any_order(void **unused)
{
    (void)unused;
    for (int blocks = 0; blocks < 2; blocks++) {
        /* A pin has two rows and meets those of the pin before it, and two frictions. */
        size_t most_of_a_loop = blocks ? 16 : 5;
        for (int windows = 5; windows <= most; windows *= 4) {
            for (uint64_t seed = 0; seed < 4; seed++) {
                size_t kept = kept_by(windows, blocks, seed);
                if (kept > most_of_a_loop * (size_t)windows)
                    print_error("%d windows, order %d: %zu\n", windows, (int)seed, kept);
                assert_true(kept <= most_of_a_loop * (size_t)windows);
            }
        }
    }
}

/* The acceleration of a body's coordinate by its name. */
static double acceleration(const struct fbd_state *state, const char *name)
{
    for (size_t b = 0; b < state->model->body_count; b++)
        if (strcmp(state->model->bodies[b].name, name) == 0) return state->a[state->model->bodies[b].first];
    fail_msg("no body %s", name);
    return 0;
}

static struct fbd_state *evaluated(fbd_model *model)
{
    struct fbd_state *state = state_new(model);
    assert_non_null(state);
    assert_true(modes_settle(state, NULL));
    state_evaluate(state);
    return state;
}

static void accelerations_do_not_depend_on_the_order(void **unused)
{
    (void)unused;
    enum { windows = 12 };
    fbd_model *model = row_of(windows, true, 0);
    struct fbd_state *state = evaluated(model);
    assert_true(model->tree->pair_count == windows);
    for (uint64_t seed = 1; seed < 6; seed++) {
        fbd_model *shuffled = row_of(windows, true, seed);
        struct fbd_state *other = evaluated(shuffled);
        for (int i = 0; i < windows; i++) {
            static const char *const kinds = "vhb";
            for (int k = 0; k < 3; k++) {
                char name[16];
                snprintf(name, sizeof name, "%c%d", kinds[k], i);
                double a = acceleration(state, name), b = acceleration(other, name);
                /* The condition of the system is some hundreds. */
                assert_true(fabs(a - b) <= 1e4 * DBL_EPSILON * (1 + fabs(a)));
            }
        }
        state_free(other);
        fbd_model_free(shuffled);
    }
    state_free(state);
    fbd_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_kept_grows_with_the_length_in_any_order),
        cmocka_unit_test(accelerations_do_not_depend_on_the_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
