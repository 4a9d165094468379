/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Mixed complementarity problems of contact and friction: solutions obey the laws of all rows, forces are the least that are
 * admissible, and neither the order of the rows nor the modes of the start change them.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "contact_rows.h"
#include "random_numbers.h"
#include "thorough.h"

/* Round-off of some hundred operations. */
static const double rounding = 1e-12;

static void set_open(struct pivoting_problem *problem)
{
    for (size_t i = 0; i < problem->count; i++) problem->rows[i].mode = at_low;
}

static struct pivoting_row half_line(double b)
{
    return (struct pivoting_row){.b = b, .high = HUGE_VAL, .of = -1, .mode = at_low};
}

static struct pivoting_row friction(double b, int of, double mu)
{
    return (struct pivoting_row){.b = b, .of = of, .low_share = -mu, .high_share = mu, .mode = at_low};
}

static void a_contact_carries_or_opens(void **unused)
{
    (void)unused;
    struct pivoting_row rows[] = {half_line(-9.81), half_line(3)};
    struct pivoting_problem problem = {.count = 2, .rows = rows, .A = (double[]){0.5, 0, 0, 2}};
    assert_int_equal(pivoting_solve(&problem), pivoting_solved);
    assert_true(fabs(rows[0].x - 19.62) < 20 * rounding && rows[0].w == 0 && rows[0].mode == between);
    assert_true(rows[1].x == 0 && rows[1].w == 3 && rows[1].mode == at_low);
}

static void limits_of_an_interval_are_forces_of_its_motion(void **unused)
{
    (void)unused;
    static const double load[] = {-5, -1, 4}, force[] = {2, 1, -3};
    for (int k = 0; k < 3; k++) {
        struct pivoting_row row = {.b = load[k], .low = -3, .high = 2, .of = -1};
        struct pivoting_problem problem = {.count = 1, .rows = &row, .A = (double[]){1}};
        assert_int_equal(pivoting_solve(&problem), pivoting_solved);
        assert_true(fabs(row.x - force[k]) < rounding && fabs(row.w - load[k] - force[k]) < 10 * rounding);
    }
}

/* A block on an incline sticks up to tan(alpha) = mu, and slides with g (sin(alpha) - mu cos(alpha)). */
static void a_block_on_an_incline_sticks_or_slides(void **unused)
{
    (void)unused;
    const double mu = 0.5;
    for (int k = 1; k < 17; k++) {
        const double alpha = 0.07 * k;
        struct pivoting_row rows[] = {half_line(-9.81 * cos(alpha)), friction(9.81 * sin(alpha), 0, mu)};
        struct pivoting_problem problem = {.count = 2,
                                           .rows = rows,
                                           .A = (double[]){0.5, 0, 0, 0.5},
                                           .examine = true};
        assert_int_equal(pivoting_solve(&problem), pivoting_solved);
        double slides = fmax(0, 9.81 * (sin(alpha) - mu * cos(alpha)));
        assert_true(fabs(rows[1].w - slides) < 10 * rounding);
        assert_true(fabs(rows[1].x + 2 * (9.81 * sin(alpha) - slides)) < 20 * rounding);
    }
}

/* Two rows of a joint that are one, beside a contact that it carries. */
static void equalities_may_depend_on_each_other(void **unused)
{
    (void)unused;
    struct pivoting_row joint = {.b = -6, .low = -HUGE_VAL, .high = HUGE_VAL, .of = -1};
    struct pivoting_row rows[] = {joint, joint, half_line(-1)};
    struct pivoting_problem problem = {.count = 3, .rows = rows, .A = (double[]){2, 2, 1, 2, 2, 1, 1, 1, 2}};
    assert_int_equal(pivoting_solve(&problem), pivoting_solved);
    assert_true(fabs(rows[0].x - 1.5) < 10 * rounding && rows[0].x == rows[1].x);
    assert_true(rows[0].w == 0 && rows[2].x == 0 && fabs(rows[2].w - 2) < 10 * rounding);
}

static void joints_that_contradict_each_other_have_no_solution(void **unused)
{
    (void)unused;
    struct pivoting_row joint = {.b = -6, .low = -HUGE_VAL, .high = HUGE_VAL, .of = -1}, other = joint;
    other.b = -5;
    struct pivoting_row rows[] = {joint, other};
    struct pivoting_problem problem = {.count = 2, .rows = rows, .A = (double[]){2, 2, 2, 2}};
    assert_int_equal(pivoting_solve(&problem), pivoting_none);
}

/* A rod that slides on its tip at the angle theta (Painleve): of unit mass, with the centre at (-c, s) from the tip. As it
 * slips forwards, c_n = b + N (1 + k c (c - mu s)), with k = 3 for a half length of one. */
static void painleve_rods_have_no_solution_or_several(void **unused)
{
    (void)unused;
    const double theta = 1, c = cos(theta), s = sin(theta), mu = 2.5;
    double A[] = {1 + 3 * c * c, -3 * c * s, -3 * c * s, 1 + 3 * s * s};
    assert_true(1 + 3 * c * (c - mu * s) < 0);
    for (int opens = 0; opens < 2; opens++) {
        struct pivoting_row slip = {.of = 0, .low_share = mu, .high_share = mu};
        struct pivoting_row rows[] = {half_line(opens ? 1 : -1), slip};
        struct pivoting_problem problem = {.count = 2, .rows = rows, .A = A, .examine = true};
        assert_int_equal(pivoting_solve(&problem), opens ? pivoting_several : pivoting_none);
    }
}

static void four_feet_in_one_place_share_their_load_equally(void **unused)
{
    (void)unused;
    static const size_t feet = 4;
    struct contact_rows of;
    contact_rows_new(&of, 1, 2 * feet);
    of.bodies[0] = (struct plane_body){.at = {0, 1}, .a = {2, -9.81}, .mass = 3, .inertia = 1, .alpha = 2};
    for (size_t k = 0; k < feet; k++)
        contact_rows_add(&of, 0, the_ground, (struct vec){0, 0}, (struct vec){0, 1}, 0.5);
    contact_rows_assemble(&of);
    assert_int_equal(pivoting_solve(&of.problem), pivoting_unexamined);
    for (size_t i = 2; i < 2 * feet; i++)
        assert_true(fabs(of.problem.rows[i].x - of.problem.rows[i - 2].x) < 10 * rounding);
    assert_true(fabs(of.problem.rows[0].x - 9.81 * 3 / (double)feet) < 10 * rounding);
    contact_rows_free(&of);
}

static void random_blocks_obey_the_laws(void **unused)
{
    (void)unused;
    const int trials = number_of("PIVOTING_BLOCKS", thorough() ? 20000 : 500);
    for (int seed = 1; seed <= trials; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct contact_rows of;
        contact_rows_block(&of, 1 + seed % 6, &numbers);
        if (pivoting_solve(&of.problem) >= pivoting_ray) fail_msg("seed %d: not solved", seed);
        double error = contact_rows_error(&of);
        if (!(error < 10 * rounding)) fail_msg("seed %d: laws are violated by %g", seed, error);
        contact_rows_free(&of);
    }
}

/* Enumeration finds the solution of Lemke's path, and no other one: the block has one normal direction. */
static void enumeration_agrees_with_the_path(void **unused)
{
    (void)unused;
    for (int seed = 1; seed <= 300; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct contact_rows of;
        contact_rows_block(&of, 1 + seed % 3, &numbers);
        of.problem.examine = true;
        enum pivoting found = pivoting_solve(&of.problem);
        if (found != pivoting_solved && found != pivoting_several)
            fail_msg("seed %d: outcome %d", seed, (int)found);
        assert_true(contact_rows_error(&of) < 10 * rounding);
        contact_rows_free(&of);
    }
}

/* Friction that slips: its force is on one side, whatever its acceleration. Such a block may jam or have several solutions;
 * enumeration proves which, and what it finds obeys the laws. */
static void slipping_blocks_are_solved_or_proved_to_have_no_solution(void **unused)
{
    (void)unused;
    int counts[pivoting_no_memory + 1] = {0};
    for (int seed = 1; seed <= number_of("PIVOTING_BLOCKS", 500); seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct contact_rows of;
        contact_rows_block(&of, 1 + seed % 4, &numbers);
        const double side = random_chance(&numbers, 0.5) ? 1 : -1, rough = 5; /* mu up to 4 */
        for (size_t i = 1; i < of.problem.count; i += 2)
            of.problem.rows[i].low_share = of.problem.rows[i].high_share =
                side * rough * of.problem.rows[i].high_share;
        of.problem.examine = true;
        enum pivoting found = pivoting_solve(&of.problem);
        counts[found]++;
        if (found == pivoting_ray || found == pivoting_no_memory) fail_msg("seed %d: not decided", seed);
        if (found != pivoting_none && !(contact_rows_error(&of) < 10 * rounding))
            fail_msg("seed %d: laws are violated", seed);
        contact_rows_free(&of);
    }
    assert_true(counts[pivoting_solved] > 0 && counts[pivoting_several] > 0 && counts[pivoting_none] > 0);
}

static bool is_all_at_rest(const struct pivoting_problem *problem)
{
    for (size_t i = 0; i < problem->count; i++)
        if (problem->rows[i].w != 0) return false;
    return true;
}

/* Half planes a . y >= least and planes a . y = least of the admissible forces y = sqrt(A_ii) x, as Dykstra's method takes
 * them one after the other; each remembers what it has added. */
struct half_plane {
    double a[12], least, added[12];
    bool both_sides;
};

static void project(struct half_plane *plane, size_t n, double *y)
{
    double product = 0, square = 0;
    for (size_t i = 0; i < n; i++) {
        y[i] -= plane->added[i];
        product += plane->a[i] * y[i];
        square += plane->a[i] * plane->a[i];
    }
    double share = (plane->least - product) / square;
    if (!plane->both_sides) share = fmax(0, share);
    for (size_t i = 0; i < n; i++) {
        plane->added[i] = share * plane->a[i];
        y[i] += plane->added[i];
    }
}

/* The same resultants as the solution, N >= 0, and |T| <= mu N. Returns their number. */
static size_t set_planes(const struct contact_rows *of, struct half_plane *planes)
{
    size_t n = of->problem.count, count = 0;
    for (size_t c = 0; c < 3; c++) {
        planes[count] = (struct half_plane){.both_sides = true};
        for (size_t i = 0; i < n; i++) {
            double own = sqrt(of->A[i * n + i]);
            planes[count].a[i] = of->J[i * 3 + c] / own;
            planes[count].least += of->J[i * 3 + c] * of->problem.rows[i].x;
        }
        count++;
    }
    for (size_t i = 0; i < n; i++) {
        const struct pivoting_row *row = &of->problem.rows[i];
        for (int side = -1; side <= 1; side += 2) {
            if (row->of < 0 && side < 0) continue;
            planes[count] = (struct half_plane){0};
            planes[count].a[i] = side / sqrt(of->A[i * n + i]);
            if (row->of >= 0)
                planes[count].a[row->of] =
                    row->high_share / sqrt(of->A[(size_t)row->of * n + (size_t)row->of]);
            count++;
        }
    }
    return count;
}

static void forces_are_the_least_admissible_ones(void **unused)
{
    (void)unused;
    enum { sweeps = 20000, wanted = 60 };
    int compared = 0;
    for (int seed = 1; compared < wanted; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct contact_rows of;
        contact_rows_block(&of, 3 + seed % 4, &numbers);
        bool solved = pivoting_solve(&of.problem) < pivoting_ray;
        size_t n = of.problem.count;
        if (solved && n == 2 * (size_t)(3 + seed % 4) && is_all_at_rest(&of.problem)) {
            struct half_plane planes[40];
            double y[12] = {0}, size = 0;
            size_t count = set_planes(&of, planes);
            for (int sweep = 0; sweep < sweeps; sweep++)
                for (size_t k = 0; k < count; k++) project(&planes[k], n, y);
            for (size_t i = 0; i < n; i++) size = fmax(size, fabs(y[i]));
            for (size_t i = 0; i < n; i++) /* the projections converge slowly where angles are small */
                if (!(fabs(y[i] - sqrt(of.A[i * n + i]) * of.problem.rows[i].x) <= 1e-5 * size))
                    fail_msg("seed %d, row %zu: %g, not %g", seed, i, of.problem.rows[i].x,
                             y[i] / sqrt(of.A[i * n + i]));
            compared++;
        }
        contact_rows_free(&of);
    }
}

/* The rows of a problem in another order, A, `of` and all. */
static void shuffle(const struct pivoting_problem *from, struct pivoting_problem *to, double *A,
                    const size_t *order)
{
    size_t n = from->count;
    to->count = n;
    to->A = A;
    for (size_t i = 0; i < n; i++) {
        to->rows[i] = from->rows[order[i]];
        for (size_t j = 0; j < n; j++) {
            A[i * n + j] = from->A[order[i] * n + order[j]];
            if (from->rows[order[i]].of == (int)order[j]) to->rows[i].of = (int)j;
        }
    }
}

static void the_order_of_rows_changes_no_bit(void **unused)
{
    (void)unused;
    struct contact_rows of;
    struct random_numbers numbers = {7};
    contact_rows_wall(&of, 3, 3, 0.4);
    for (size_t i = 0; i < of.body_count; i++) of.bodies[i].a.x = random_between(&numbers, 0, 2);
    contact_rows_assemble(&of);
    size_t n = of.problem.count, *order = calloc(n, sizeof *order);
    double *A = calloc(n * n, sizeof *A);
    struct pivoting_problem other = {.rows = calloc(n, sizeof *other.rows)};
    assert_true(order && A && other.rows);
    for (size_t i = 0; i < n; i++) order[i] = i;
    for (size_t i = n; i-- > 1;) {
        size_t j = (size_t)random_between(&numbers, 0, (double)i + 1), kept = order[i];
        order[i] = order[j];
        order[j] = kept;
    }
    shuffle(&of.problem, &other, A, order);
    assert_int_equal(pivoting_solve(&of.problem), pivoting_unexamined);
    assert_int_equal(pivoting_solve(&other), pivoting_unexamined);
    for (size_t i = 0; i < n; i++) {
        assert_true(other.rows[i].x == of.problem.rows[order[i]].x);
        assert_true(other.rows[i].w == of.problem.rows[order[i]].w);
    }
    contact_rows_free(&of);
    free(order);
    free(A);
    free(other.rows);
}

/* The second solution starts from the modes of the first. */
static void modes_of_the_start_change_no_force(void **unused)
{
    (void)unused;
    struct contact_rows of;
    contact_rows_bin(&of, 20, 0.3);
    size_t n = of.problem.count;
    double *x = calloc(n, sizeof *x);
    assert_non_null(x);
    assert_int_equal(pivoting_solve(&of.problem), pivoting_unexamined);
    assert_true(contact_rows_error(&of) < 10 * rounding);
    for (size_t i = 0; i < n; i++) x[i] = of.problem.rows[i].x;
    for (int start = 0; start < 2; start++) {
        if (start == 1) set_open(&of.problem);
        assert_int_equal(pivoting_solve(&of.problem), pivoting_unexamined);
        for (size_t i = 0; i < n; i++) assert_true(of.problem.rows[i].x == x[i]);
    }
    free(x);
    contact_rows_free(&of);
}

/* Each brick carries half of what lies on it on either side; the courses below the ends carry less. */
static void a_wall_at_rest_carries_its_weight(void **unused)
{
    (void)unused;
    struct contact_rows of;
    double sum = 0;
    contact_rows_wall(&of, 9, 5, 0.5);
    assert_int_equal(pivoting_solve(&of.problem), pivoting_unexamined);
    assert_true(contact_rows_error(&of) < 10 * rounding);
    for (size_t i = 0; i < 20; i += 2) sum += of.problem.rows[i].x; /* the lowest course on the ground */
    assert_true(fabs(sum - 45 * 2 * 9.81) < 45 * 20 * rounding);
    contact_rows_free(&of);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_contact_carries_or_opens),
        cmocka_unit_test(limits_of_an_interval_are_forces_of_its_motion),
        cmocka_unit_test(a_block_on_an_incline_sticks_or_slides),
        cmocka_unit_test(equalities_may_depend_on_each_other),
        cmocka_unit_test(joints_that_contradict_each_other_have_no_solution),
        cmocka_unit_test(painleve_rods_have_no_solution_or_several),
        cmocka_unit_test(four_feet_in_one_place_share_their_load_equally),
        cmocka_unit_test(random_blocks_obey_the_laws),
        cmocka_unit_test(enumeration_agrees_with_the_path),
        cmocka_unit_test(slipping_blocks_are_solved_or_proved_to_have_no_solution),
        cmocka_unit_test(forces_are_the_least_admissible_ones),
        cmocka_unit_test(the_order_of_rows_changes_no_bit),
        cmocka_unit_test(modes_of_the_start_change_no_force),
        cmocka_unit_test(a_wall_at_rest_carries_its_weight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
