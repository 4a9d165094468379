/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The motion along a step, followed piece by piece: pieces get short in a layer, and long again behind it, and
 * what a piece says of the motion is true.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "events/trajectory_poly.h"
#include "integrate/dense.h"
#include "random_numbers.h"

/* A slow wave, and beside it a layer of `width` in which something relaxes from the beginning on. */
struct layer {
    double from, width, size;
};

static double layer_value(const struct layer *layer, double t)
{
    return layer->size * exp(-(t - layer->from) / layer->width);
}

static int sample(void *context, double t, double *y)
{
    y[0] = sin(t);
    y[1] = layer_value(context, t);
    return 0;
}

static void check_piece(struct trajectory *trajectory, const struct layer *layer)
{
    for (int k = 0; k <= 16; k++) {
        double t = fmin(trajectory->from + (trajectory->to - trajectory->from) * k / 16.0, trajectory->to);
        trajectory_enclose(trajectory, &(struct stretch){t, t, t}, NULL);
        double error = fabs(trajectory->now[1].middle.high - layer_value(layer, t));
        if (!(error <= 1e-7 * layer->size + interval_width(trajectory->now[1].middle)))
            fail_msg("off by %g at %.17g of a piece from %.17g to %.17g", error, t, trajectory->from,
                     trajectory->to);
    }
}

/* How many pieces it takes from `from` to `to`; far too many are not counted to the end. */
static size_t follow(struct trajectory *trajectory, struct layer *layer, double from, double to)
{
    enum { far_too_many = 2000 };
    size_t pieces = 0;
    for (; from < to && pieces < far_too_many; pieces++, from = trajectory->to) {
        assert_int_equal(trajectory_set(trajectory, from, to, NULL, trajectory_most_degree, 1e-9, sample,
                                        layer),
                         0);
        assert_true(trajectory->to > from);
        check_piece(trajectory, layer);
    }
    return pieces;
}

/* A search that is cut short by an event it has found looks at the layer by itself first. */
static size_t pieces_along(struct layer *layer)
{
    struct arena memory = {0};
    struct trajectory trajectory;
    assert_true(trajectory_init(&trajectory, 2, (bool[]){true, true}, &memory));
    trajectory_start(&trajectory);
    double behind = layer->from + 20 * layer->width;
    size_t pieces = follow(&trajectory, layer, layer->from, behind) + follow(&trajectory, layer, behind, 1);
    arena_free(&memory);
    return pieces;
}

static void pieces_get_long_again_behind_a_layer(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < 200; i++) {
        struct random_numbers numbers = {i};
        bool at_zero = i % 2 == 0; /* where instants are closer to each other */
        struct layer layer = {.from = at_zero ? 0 : random_between(&numbers, 0, 0.9)};
        layer.width = pow(10, random_between(&numbers, at_zero ? -14 : -6, -2));
        layer.size = pow(10, random_between(&numbers, -3, 3));
        size_t pieces = pieces_along(&layer), octaves = (size_t)(-log2(layer.width));
        if (pieces > 40 + 4 * octaves)
            fail_msg("%zu pieces for a layer of %g at %g (case %zu)", pieces, layer.width, layer.from, i);
    }
}

static double end_of(struct interval interval, int side)
{
    return side == 0 ? interval.low : interval.high;
}

/* Nothing is said of what has not been followed, not what was true of an earlier piece either; and what is wanted is the
 * same whether others are or not. */
static void what_is_not_wanted_may_be_anything(void **unused)
{
    (void)unused;
    struct arena memory = {0};
    struct trajectory trajectory;
    struct layer layer = {.width = 1, .size = 1};
    const struct stretch half = {0, 0.5, 0.25};
    assert_true(trajectory_init(&trajectory, 2, (bool[]){true, true}, &memory));
    for (int coarse = 0; coarse < 2; coarse++) {
        struct enclosure all = {0};
        for (int wanted = 1; wanted >= 0; wanted--) {
            const bool flags[] = {true, wanted};
            trajectory_start(&trajectory);
            int status = coarse ? trajectory_set_coarse(&trajectory, 0, 1, flags, sample, &layer)
                                : trajectory_set(&trajectory, 0, 1, flags, 16, 0, sample, &layer);
            assert_int_equal(status, 0);
            trajectory_enclose(&trajectory, &half, NULL);
            if (wanted) all = trajectory.now[0];
            assert_memory_equal(&trajectory.now[0], &all, sizeof all);
            for (int side = 0; side < 2; side++)
                assert_int_equal(isfinite(end_of(trajectory.now[1].value, side)) != 0, wanted);
        }
    }
    arena_free(&memory);
}

/* q = sin(w t + a) + share sin(w' t + b), and its derivatives, as a step of a method ends. */
struct swing {
    double w[2], phase[2], share;
};

static double swing_at(const struct swing *swing, double t, int derivative)
{
    const double quarter = 1.57079632679489661923;
    double sum = 0;
    for (int k = 0; k < 2; k++)
        sum += (k == 0 ? 1 : swing->share) * pow(swing->w[k], derivative) *
               sin(swing->w[k] * t + swing->phase[k] + derivative * quarter);
    return sum;
}

static int powers_of_ends(void *context, double from, double to, int component, double *c)
{
    return dense_powers_of_ends(context, time_dd_at(from), time_dd_at(to), (size_t)component, c);
}

/* What the ends of a step say rules nothing out that is there: whole oscillations of up to four radians a step, which no
 * method follows, lie within it with their rates. */
static void the_first_look_by_the_ends_has_the_motion_in_it(void **unused)
{
    (void)unused;
    const struct layout layout = {.pairs = 1};
    struct arena memory = {0};
    struct trajectory trajectory;
    struct dense *dense = dense_alloc(&layout);
    assert_true(dense && trajectory_init(&trajectory, 2, (bool[]){true, true}, &memory));
    double widest = 0;
    for (size_t i = 0; i < 20000; i++) {
        struct random_numbers numbers = {i};
        double h = 1, fastest = i % 2 == 0 ? 4 : pow(10, random_between(&numbers, -2, 0.6));
        struct swing swing = {.share = random_between(&numbers, -1, 1)};
        for (int k = 0; k < 2; k++) {
            swing.w[k] = random_between(&numbers, 0, fastest);
            swing.phase[k] = random_between(&numbers, 0, 6.3);
        }
        double y0[2] = {swing_at(&swing, 0, 0), swing_at(&swing, 0, 1)},
               f0[2] = {y0[1], swing_at(&swing, 0, 2)};
        double y1[2] = {swing_at(&swing, h, 0), swing_at(&swing, h, 1)},
               f1[2] = {y1[1], swing_at(&swing, h, 2)};
        dense_set(dense, 8, time_dd_at(0), y0, f0, time_dd_at(h), y1, f1, NULL, NULL);
        trajectory_start(&trajectory);
        assert_true(trajectory_set_powers(&trajectory, 0, h, NULL, true, powers_of_ends, dense));
        for (int k = 0; k < 32; k++) {
            double from = h * k / 32, to = random_between(&numbers, from, h),
                   t = random_between(&numbers, from, to);
            trajectory_enclose(&trajectory, &(struct stretch){from, to, from + (to - from) / 2}, NULL);
            for (int j = 0; j < 2; j++) {
                struct interval value = trajectory.now[j].value, rate = trajectory.now[j].rate;
                double is = swing_at(&swing, t, j), goes = swing_at(&swing, t, j + 1);
                if (!(value.low <= is && is <= value.high && rate.low <= goes && goes <= rate.high))
                    fail_msg("case %zu: %g in [%g, %g], rate %g in [%g, %g]", i, is, value.low, value.high,
                             goes, rate.low, rate.high);
            }
        }
        if (fastest < 0.3) widest = fmax(widest, trajectory.doubt[0]);
    }
    assert_true(widest < 0.02); /* of 2: it is of use */
    dense_free(dense);
    arena_free(&memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_wanted_may_be_anything),
        cmocka_unit_test(the_first_look_by_the_ends_has_the_motion_in_it),
        cmocka_unit_test(pieces_get_long_again_behind_a_layer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
