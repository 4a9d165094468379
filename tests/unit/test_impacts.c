/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Several impacts at one instant: balls in a row, a cue ball, rocking blocks, and random bodies that strike
 * at one to three points (FBD_IMPACTS=1000000, FBD_IMPACTS_SEED=7).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "impacts_by_sets.h"
#include "random_numbers.h"
#include "struck.h"
#include "thorough.h"

static const double pi = 3.14159265358979323846;

static void three_balls_in_a_row(void **state)
{
    const double after[2][3] = {{-1.0 / 3, 2.0 / 3, 2.0 / 3}, {0, 0, 1}};
    (void)state;
    for (int sequence = 0; sequence < 2; sequence++) {
        double v[most_unknowns], P[most_unknowns], work;
        struct scene scene = {.coordinates = 3, .points = 2, .w = {1, 1, 1}, .v = {1, 0, 0}};
        scene.J[0][0] = scene.J[2][1] = -1;
        scene.J[0][1] = scene.J[2][2] = 1;
        scene.laws[0].e = scene.laws[1].e = 1;
        assert_int_equal(strike(&scene, impact_stronge, sequence == 1, v, P, &work), impacts_done);
        for (int k = 0; k < 3; k++) struck_check(scene.v[k], after[sequence][k], 1e-15);
        struck_check(work, 0, 1e-15);
    }
}

/* A ball that strikes two that touch, at 30 degrees to each line of centres. */
static void a_cue_ball_comes_back(void **state)
{
    const double c = cos(pi / 6), s = 0.5;
    double v[most_unknowns], P[most_unknowns], work;
    (void)state;
    struct scene scene = {.coordinates = 6, .points = 2, .w = {1, 1, 1, 1, 1, 1}, .v = {3.8}};
    const double J[2][6] = {{-c, -s, c, s, 0, 0}, {-c, s, 0, 0, c, -s}};
    for (int i = 0; i < 2; i++) memcpy(scene.J[2 * i], J[i], sizeof J[i]);
    scene.laws[0].e = scene.laws[1].e = 1;
    assert_int_equal(strike(&scene, impact_stronge, false, v, P, &work), impacts_done);
    struck_check(scene.v[0], -0.76, 1e-14);
    struck_check(hypot(scene.v[2], scene.v[3]), 2 * 3.8 * c / 2.5, 1e-14);
    struck_check(scene.v[3] / scene.v[2], tan(pi / 6), 1e-14);
}

/* Bodies side by side that fill the room between two walls, and all move to one of them: nothing can give way, whatever is
 * given back, and impulses stay those that it takes to stop them and e times as much. */
static void a_jammed_row_comes_to_rest(void **state)
{
    (void)state;
    for (int law = impact_stronge; law <= impact_poisson; law++) {
        double v[most_unknowns], P[most_unknowns], work;
        struct scene scene = {.coordinates = 3, .points = 4, .w = {0.5, 1, 3}, .v = {-1, -1, -1}};
        for (int i = 0; i < 4; i++) {
            if (i < 3) scene.J[2 * i][i] = 1;
            if (i > 0) scene.J[2 * i][i - 1] = -1;
            scene.laws[i].e = 0.3 + 0.2 * i;
        }
        assert_int_equal(strike(&scene, (enum impact_law)law, false, v, P, &work), impacts_done);
        struck_check((double)struck_in_turn, 0, 0);
        struck_check(work, -(2 + 1 + 1.0 / 3) / 2, 1e-12);
        for (int k = 0; k < 3; k++) struck_check(scene.v[k], 0, 1e-12);
        for (int i = 0; i < 4; i++) assert_true(P[2 * i] >= 0 && P[2 * i] < 20);
    }
}

/* A ball that falls into a wedge of half an angle a, and is thrown back by e: it takes impulses 1/(2 sin a), of which speeds sin a
 * along the normals and their rounding are left. */
static void a_narrow_wedge_throws_a_ball_back(void **state)
{
    const double angles[] = {0.3, 0.01, 0.0016, 0.0007};
    (void)state;
    for (int i = 0; i < 4; i++)
        for (int law = impact_stronge; law <= impact_moreau; law++) {
            double v[most_unknowns], P[most_unknowns], work, c = cos(angles[i]), s = sin(angles[i]), e = 0.7;
            struct scene scene = {.coordinates = 2, .points = 2, .w = {1, 1}, .v = {0, -1}};
            const double J[4][2] = {{c, s}, {-s, c}, {-c, s}, {-s, -c}};
            for (int k = 0; k < 4; k++) memcpy(scene.J[k], J[k], sizeof J[k]);
            scene.laws[0].e = scene.laws[1].e = e;
            assert_int_equal(strike(&scene, (enum impact_law)law, false, v, P, &work), impacts_done);
            struck_check((double)struck_in_turn, 0, 0);
            struck_check(scene.v[0], 0, 1e-9);
            struck_check(scene.v[1], e, 1e-9);
            struck_check(work, (e * e - 1) / 2, 1e-9);
        }
}

/* A point falls onto a floor and two slopes at once, all without friction. P_1 = P_2, and of P_3 + 2 * 0.8 P_1 = 1 each share is
 * as good: by poisson it leaves with e 1.6 P_1 + e_3 P_3, which is e where all have that, and open where they differ. By
 * newton's law, plastic, and with one slope alone there is one velocity. */
static void velocities_that_impulses_leave_open_are_told(void **state)
{
    static const struct {
        enum impact_law law;
        double e, e_floor, v;
        bool several;
    } cases[] = {
        {impact_poisson, 0.5, 0, -1, true},     {impact_stronge, 0.5, 0, -1, true},
        {impact_poisson, 0.5, 0.5, 0.5, false}, {impact_stronge, 0.5, 0.5, 0.5, false},
        {impact_newton, 0.5, 0, 0.5, false},    {impact_stronge, 0, 0, 0, false},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double v[most_unknowns], P[most_unknowns], work;
        struct scene scene = {.coordinates = 2, .points = 3, .w = {1, 1}, .v = {0, -1}};
        const double J[6][2] = {{0.6, 0.8}, {-0.8, 0.6}, {-0.6, 0.8}, {-0.8, -0.6}, {0, 1}, {-1, 0}};
        for (int k = 0; k < 6; k++) memcpy(scene.J[k], J[k], sizeof J[k]);
        scene.laws[0].e = scene.laws[1].e = cases[i].e;
        scene.laws[2].e = cases[i].e_floor;
        assert_int_equal(strike(&scene, cases[i].law, false, v, P, &work), impacts_done);
        if (struck_several != cases[i].several) fail_msg("case %zu: %d", i, struck_several);
        if (!struck_several) struck_check(scene.v[1], cases[i].v, 1e-12);
        if (struck_several) assert_true(scene.v[1] >= 0 && scene.v[1] <= 0.5);
    }
}

/* Between two walls that are opposite to each other a body moves into one of them and along both. What presses it against
 * both at once is open, and so is what friction leaves of its speed: from 1 - mu down to none. Without friction, or where
 * friction of the one wall stops it, there is one velocity. */
static void what_is_gripped_may_slide_on_or_not(void **state)
{
    const double mu[] = {0.3, 0, 1.5};
    (void)state;
    for (int i = 0; i < 3; i++) {
        double v[most_unknowns], P[most_unknowns], work;
        struct scene scene = {.coordinates = 2, .points = 2, .w = {1, 1}, .v = {1, -1}};
        const double J[4][2] = {{0, 1}, {1, 0}, {0, -1}, {1, 0}};
        for (int k = 0; k < 4; k++) memcpy(scene.J[k], J[k], sizeof J[k]);
        scene.laws[0].mu = scene.laws[1].mu = mu[i];
        assert_int_equal(strike(&scene, impact_stronge, false, v, P, &work), impacts_done);
        assert_int_equal(struck_several, i == 0);
        if (i == 0) assert_true(scene.v[0] >= 0 && scene.v[0] <= 1 - mu[i] + 1e-12);
        if (i > 0) struck_check(scene.v[0], i == 1 ? 1 : 0, 1e-12);
    }
}

/* A block b x h that rocks from one corner to the other, plastic and without slip: with the angular momentum
 * about the new corner kept, the rate falls to (2 h^2 - b^2) / (2 (b^2 + h^2)) (Housner 1963). */
static void a_rocking_block_changes_corners(void **state)
{
    const double b[] = {0.4, 0.2}, ratio[] = {0.793103448276, 0.942307692308};
    (void)state;
    for (int i = 0; i < 2; i++) {
        double v[most_unknowns], P[most_unknowns], work, h = 1, x = b[i] / 2, y = h / 2;
        /* about the left corner (-x, -y), omega < 0: v_G = omega k x (x, y) */
        struct scene scene = {.coordinates = 3, .points = 2, .w = {1, 1, 12 / (b[i] * b[i] + h * h)}};
        scene.v[0] = y;
        scene.v[1] = -x;
        scene.v[2] = -1;
        const double J[4][3] = {{0, 1, -x}, {1, 0, y}, {0, 1, x}, {1, 0, y}};
        for (int k = 0; k < 4; k++) memcpy(scene.J[k], J[k], sizeof J[k]);
        scene.laws[0].mu = scene.laws[1].mu = 100;
        assert_int_equal(strike(&scene, impact_stronge, false, v, P, &work), impacts_done);
        struck_check(scene.v[2], -ratio[i], 1e-12); /* the table has twelve digits */
        assert_true(v[0] > 0);
        struck_check(v[2], 0, 0);
    }
}

/* Where a point is and how its normal turns, on which bodies; the ground is no body. */
struct place {
    double x, y, angle;
    int bodies[2];
};

static void set_rows(struct scene *scene, int i, const struct place *place)
{
    double c = cos(place->angle), s = sin(place->angle), x = place->x, y = place->y;
    const double rows[2][3] = {{c, s, x * s - y * c}, {-s, c, x * c + y * s}};
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < 3 && place->bodies[side] >= 0; k++)
            for (int way = 0; way < 2; way++)
                scene->J[2 * i + way][3 * place->bodies[side] + k] += (side == 0 ? 1 : -1) * rows[way][k];
}

static struct place random_place(struct random_numbers *numbers, const struct scene *scene)
{
    struct place place = {.angle = random_between(numbers, 0, 2 * pi)};
    unsigned bodies = (unsigned)scene->coordinates / 3;
    for (int side = 0; side < 2; side++) place.bodies[side] = (int)(random_bits(numbers) % bodies);
    if (place.bodies[1] == place.bodies[0]) place.bodies[1] = -1;
    place.x = random_between(numbers, -1, 1);
    place.y = random_between(numbers, -1, 1);
    return place;
}

/* Points anywhere; or, with `apart`, up to that far from the first, and turned by as much against it. */
static void random_scene(struct random_numbers *numbers, double apart, struct scene *scene)
{
    struct place first = {0};
    memset(scene, 0, sizeof *scene);
    scene->points = 1 + (int)(random_bits(numbers) % 3);
    scene->coordinates = 3 * (1 + (int)(random_bits(numbers) % 3));
    for (int k = 0; k < scene->coordinates; k++) {
        scene->w[k] = pow(10, random_between(numbers, -1, 1));
        scene->v[k] = random_between(numbers, -1, 1);
    }
    for (int i = 0; i < scene->points; i++) {
        struct place place = i == 0 || apart == 0 ? random_place(numbers, scene) : first;
        if (i == 0) first = place;
        if (i > 0 && apart > 0) {
            place.x += random_between(numbers, -apart, apart);
            place.y += random_between(numbers, -apart, apart);
            place.angle += random_between(numbers, -apart, apart) + (random_bits(numbers) % 2 ? pi : 0);
        }
        set_rows(scene, i, &place);
        scene->laws[i].mu = random_bits(numbers) % 3 == 0 ? 0 : random_between(numbers, 0, 1);
        scene->laws[i].e = random_bits(numbers) % 3 == 0 ? 0 : random_between(numbers, 0, 1);
    }
}

static uint64_t seed_of(uint64_t otherwise)
{
    const char *seed = getenv("FBD_IMPACTS_SEED");
    return seed ? strtoull(seed, NULL, 10) : otherwise;
}

/* Boxes on each other rock as one from one corner of the lowest to the other. Each lies on two corners that stick to the
 * one below, and these are known to 1e-12: the corner of one is not where the other is touched. So the four rows of the
 * two points, where three would do, contradict each other by that. */
static void a_stack_of_boxes_rocks(void **state)
{
    struct random_numbers numbers = {seed_of(20261125)};
    double v[most_unknowns], P[most_unknowns], work;
    (void)state;
    for (int trial = 0; trial < 50; trial++) {
        struct scene scene = {.coordinates = 3 * most_bodies, .points = most_points};
        for (int i = 0; i < most_points; i++) {
            double right = i < 2 ? 0.3 : random_between(&numbers, 0.4, 0.5);
            struct place corner = {i % 2 == 0 ? -0.5 : right, i / 2 * 0.6, pi / 2, {i / 2, i / 2 - 1}};
            set_rows(&scene, i, &corner);
            if (i >= 2) scene.J[2 * i + 1][3 * (i / 2 - 1) + 2] += random_between(&numbers, -1e-12, 1e-12);
            scene.laws[i].mu = 0.5;
        }
        for (int k = 0; k < scene.coordinates; k++) {
            scene.w[k] = k % 3 == 2 ? 0.25 : 1;
            scene.v[k] = k % 3 == 2 ? -1 : k % 3 == 1 ? -0.5 : 0;
        }
        double x = scene.J[2][2], rate = -(4 - 0.5 * x) / (4 + x * x); /* about the other corner */
        assert_int_equal(strike(&scene, impact_stronge, false, v, P, &work), impacts_done);
        for (int k = 2; k < scene.coordinates; k += 3) struck_check(scene.v[k], rate, 1e-9);
    }
}

/* How the impacts ended. */
struct census {
    long done, endless, unsolvable, lost, made;
};

/* Of the speeds before, the largest that a law is about, in the metric of kinetic energy: v/sqrt(W_ii). */
static double speed_before(const struct scene *scene, const double *before)
{
    double most = 0;
    for (int i = 0, n = 2 * scene->points; i < n; i++) {
        double own = scene->W[i * n + i], e = i % 2 == 0 ? scene->laws[i / 2].e : 0;
        if (own > 0) most = fmax(most, (1 + e) * fabs(before[i]) / sqrt(own));
    }
    return most;
}

/* By how much velocities may miss what laws and impulses ask of row i. By so much the velocity before would have to be another
 * for both to be exact: it is the backward error, and what share.c promises of it is 1e-10 of the largest speed, in compression
 * and in restitution, and the rounding of the sum W P. (Of the velocities there is no such promise: two surfaces 1e-10 rad
 * apart that hold a body between them let it go when turned by as much.) */
static double may_miss(const struct scene *scene, const double *before, const double *P, int i)
{
    const double rounding = 2e-10, of_products = 8 * DBL_EPSILON;
    const int n = 2 * scene->points;
    const double *W = &scene->W[i * n];
    double missed = rounding * sqrt(W[i]) * speed_before(scene, before);
    for (int j = 0; j < n; j++) missed += of_products * fabs(W[j] * P[j]);
    return missed;
}

/* v_n + e v_n before >= 0, and zero where an impulse is: of each point that has closed. */
static void check_law_of_newton(const struct scene *scene, const double *before, const double *v,
                                const double *P, double size)
{
    const double rounding = 1e-10;
    for (int i = 0; i < scene->points; i++) {
        double approach = fmax(0, -before[2 * i]), beyond = v[2 * i] - scene->laws[i].e * approach;
        assert_true(beyond >= -may_miss(scene, before, P, 2 * i));
        if (approach > 0) struck_check(P[2 * i] * beyond, 0, rounding * size * (1 + P[2 * i]));
    }
}

static void check_scene(struct scene *scene, enum impact_law law, bool sequence, struct census *census)
{
    /* What holds is told within 1e-9 of the forces (holds.c). */
    const double rounding = 1e-10, limit = 1e-9, held = 1e-8;
    double v[most_unknowns], P[most_unknowns], first[most_unknowns], work, before = struck_energy(scene);
    for (int i = 0; i < 2 * scene->points; i++) first[i] = struck_speed(scene, i);
    enum impacts_end end = strike(scene, law, sequence, v, P, &work);
    census->done += end == impacts_done;
    census->endless += end == impacts_endless;
    census->unsolvable += end == impacts_unsolvable;
    census->lost += end == impacts_lost;
    if (end != impacts_done) return;
    double size = before;
    for (int i = 0; i < 2 * scene->points; i++) size += fabs(P[i]);
    struck_check(struck_energy(scene) - before, work, rounding * size);
    census->made += work > rounding * size;
    if (!impact_by_velocity(law)) assert_true(work <= rounding * size);
    if (impact_by_velocity(law) && !sequence) check_law_of_newton(scene, first, v, P, size);
    for (int i = 0; i < scene->points; i++) {
        double v_n = struck_speed(scene, 2 * i), v_t = struck_speed(scene, 2 * i + 1);
        /* What holds is 0 to the digit; where points are redundant, impulses that do so leave a rounding. */
        struck_check(v_n, v[2 * i], v[2 * i] == 0 ? held * size : may_miss(scene, first, P, 2 * i));
        struck_check(v_t, v[2 * i + 1],
                     v[2 * i + 1] == 0 ? held * size : may_miss(scene, first, P, 2 * i + 1));
        assert_true(v_n >= -held * size && P[2 * i] >= -rounding * size);
        assert_true(fabs(P[2 * i + 1]) <= scene->laws[i].mu * P[2 * i] + limit * size);
    }
}

static struct census try_scenes(struct random_numbers *numbers, long count, bool near)
{
    struct census census = {0};
    for (long i = 0; i < count; i++) {
        struct scene scene;
        random_scene(numbers, near ? pow(10, random_between(numbers, -12, -1)) : 0, &scene);
        check_scene(&scene, (enum impact_law)(i % 4), i / 4 % 2 == 1, &census);
    }
    print_message("# %ld impacts: %ld done, %ld endless, %ld without solution, %ld lost; %ld make energy\n",
                  count, census.done, census.endless, census.unsolvable, census.lost, census.made);
    return census;
}

static long count_of(int otherwise)
{
    const char *many = getenv("FBD_IMPACTS");
    return many ? atol(many) : draws_of(otherwise);
}

static void random_impacts_keep_momentum_and_make_no_energy(void **state)
{
    struct random_numbers numbers = {seed_of(20260102)};
    long count = count_of(6000);
    (void)state;
    struct census census = try_scenes(&numbers, count, false);
    assert_true(census.done >= count - count / 100);
}

/* Points of the same bodies 1e-12 to 0.1 m apart, whose normals are as near to each other or to opposite ones: what holds
 * them may take impulses without bound, and laws that want v_n of each contradict each other. */
static void nearly_redundant_points_do_so_or_are_told(void **state)
{
    struct random_numbers numbers = {seed_of(20261124)};
    long count = count_of(6000) / 2;
    (void)state;
    long before = struck_in_turn;
    struct census census = try_scenes(&numbers, count, true);
    print_message("# %ld of them one point after the other instead of all together\n",
                  struck_in_turn - before);
    assert_true(struck_in_turn > before); /* what is told is met here */
    assert_true(census.done >= count / 10 * 7);
}

/* ---- by sets */

/* The same points for impacts_by_sets, with laws of their own or all the same. */
static struct points_by_sets draw_points(struct random_numbers *numbers, struct scene *scene)
{
    struct points_by_sets points = {.count = scene->points, .in_turn = random_chance(numbers, 0.5)};
    int law = (int)(random_bits(numbers) % 4), n = 2 * scene->points;
    bool same = random_chance(numbers, 0.5);
    for (int i = 0; i < scene->points; i++) {
        int own = same ? law : (int)(random_bits(numbers) % 4); /* both enumerations have one order */
        scene->laws[i].law = (enum impact_law)own;
        points.law[i] = (enum law_by_steps)own;
        points.mu[i] = scene->laws[i].mu;
        points.e[i] = scene->laws[i].e;
    }
    struck_set_answers(scene);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) points.W[i][j] = scene->W[i * n + j];
    return points;
}

enum by_sets { unknown_by_sets, same_by_sets, refused_by_sets, other_by_sets };

/* Velocities after by both, where there is one answer. */
static enum by_sets compare_with_sets(struct scene *scene, const struct points_by_sets *points)
{
    const double near = 1e-7; /* what counts as no velocity is 1e-9 of the largest in both */
    double before[most_unknowns], v[most_unknowns], P[most_unknowns], after[sets_rows] = {0},
                                                                      impulses[sets_rows] = {0}, size = 0;
    bool same = true;
    const int n = 2 * points->count;
    for (int i = 0; i < n; i++) {
        after[i] = before[i] = v[i] = struck_speed(scene, i);
        size = fmax(size, fabs(v[i]));
    }
    struct impacts impacts = {.count = points->count,
                              .propagate = points->in_turn,
                              .points = scene->laws,
                              .W = scene->W,
                              .v = v,
                              .P = P};
    if (!impacts_by_sets(points, after, impulses)) return unknown_by_sets;
    if (impacts_solve(&impacts) != impacts_done || impacts.in_turn) return refused_by_sets;
    if (impacts.several) return other_by_sets; /* there are no others */
    for (int i = 0; i < n; i++) size = fmax(size, fabs(after[i]));
    for (int i = 0; i < n; i++) same &= fabs(v[i] - after[i]) <= near * size;
    for (int i = 0; i < n && !same; i++)
        print_message("# row %d: from %.9g to %.9g, by sets %.9g; mu %.9g, e %.9g, law %d\n", i, before[i],
                      v[i], after[i], points->mu[i / 2], points->e[i / 2], (int)points->law[i / 2]);
    return same ? same_by_sets : other_by_sets;
}

static void impacts_by_sets_say_the_same(void **state)
{
    struct random_numbers numbers = {seed_of(20261126)};
    long count = count_of(6000) / 3, ways[4] = {0};
    (void)state;
    for (long i = 0; i < count; i++) {
        struct scene scene;
        random_scene(&numbers, 0, &scene);
        struct points_by_sets points = draw_points(&numbers, &scene);
        enum by_sets way = compare_with_sets(&scene, &points);
        if (way == other_by_sets) print_message("# impact %ld, in turn: %d\n", i, points.in_turn);
        ways[way]++;
    }
    print_message("# %ld impacts, %ld without one answer by sets, %ld refused\n", count,
                  ways[unknown_by_sets], ways[refused_by_sets]);
    assert_int_equal(ways[other_by_sets], 0);
    /* Impulses hundreds of times as large as what stops each point, where rounding takes what they do. */
    assert_true(2000 * ways[refused_by_sets] <= count);
    assert_true(10 * ways[unknown_by_sets] <= count);
}

/* A point that others hold does not open by twice what its restitution gives, nor any other, so that no work is given back
 * by either; by three times that it opens. What is held for ever is another thing: a_jammed_row_comes_to_rest. */
static void a_point_that_is_held_at_first_opens(void **state)
{
    struct random_numbers numbers = {20261126};
    struct scene scene;
    struct points_by_sets points;
    (void)state;
    for (int i = 0; i <= 74735; i++) {
        random_scene(&numbers, 0, &scene);
        points = draw_points(&numbers, &scene);
    }
    assert_int_equal(compare_with_sets(&scene, &points), same_by_sets);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(three_balls_in_a_row),
        cmocka_unit_test(a_cue_ball_comes_back),
        cmocka_unit_test(a_jammed_row_comes_to_rest),
        cmocka_unit_test(a_narrow_wedge_throws_a_ball_back),
        cmocka_unit_test(velocities_that_impulses_leave_open_are_told),
        cmocka_unit_test(what_is_gripped_may_slide_on_or_not),
        cmocka_unit_test(a_rocking_block_changes_corners),
        cmocka_unit_test(a_stack_of_boxes_rocks),
        cmocka_unit_test(random_impacts_keep_momentum_and_make_no_energy),
        cmocka_unit_test(nearly_redundant_points_do_so_or_are_told),
        cmocka_unit_test(impacts_by_sets_say_the_same),
        cmocka_unit_test(a_point_that_is_held_at_first_opens),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
