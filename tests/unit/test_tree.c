/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random trees of jointed bodies held against other formulations of the same mechanics.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "dynamics/energy.h"
#include "dynamics/modes.h"
#include "dynamics/project.h"
#include "dynamics/tree_system.h"
#include "random_trees.h"
#include "scenes.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { trees = 60, most_coordinates = 40 };

struct subject {
    fbd_model *model;
    struct fbd_state *state;
    int n;
    struct random_numbers numbers;
    bool fits; /* velocities were found that its constraints allow, and modes that agree with them */
};

/* Tree number `seed` in a random state. */
static struct subject subject_with(uint64_t seed, bool conservative, bool friction, int loops)
{
    struct subject subject = {.numbers = {seed}};
    struct random_tree tree = {2 + (int)(seed % 8), conservative, friction, loops, false};
    char *text = random_tree_text(&subject.numbers, &tree);
    assert_non_null(text);
    subject.model = model_from(text);
    free(text);
    subject.state = state_new(subject.model);
    assert_non_null(subject.state);
    subject.n = subject.model->plan.n;
    assert_true(subject.n <= most_coordinates);
    for (int i = 0; i < 2 * subject.n; i++) subject.state->y[i] = random_between(&subject.numbers, -2, 2);
    subject.state->t = 0.3;
    state_start_constraints(subject.state);
    /* At velocities that are drawn there may be no friction that agrees (Painleve): such a state is left out. */
    subject.fits = modes_settle(subject.state, NULL) && state_project_velocity(subject.state, false) &&
                   modes_settle(subject.state, NULL);
    return subject;
}

static struct subject subject_of(uint64_t seed, bool conservative, bool friction)
{
    struct subject subject = subject_with(seed, conservative, friction, 0);
    assert_true(subject.fits);
    return subject;
}

static void release(struct subject *subject)
{
    state_free(subject->state);
    fbd_model_free(subject->model);
}

static void expect_near(const char *what, uint64_t seed, double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance))
        print_error("seed %d: %s: got %.17g, wanted %.17g, off by %.3g tolerances\n", (int)seed, what, got,
                    want, fabs(got - want) / tolerance);
    assert_true(fabs(got - want) <= tolerance);
}

/* ---- kinematics alone: velocities of G and of turning, for given coordinates and rates */

static void velocities(struct subject *subject, const double *y, struct vec *v_G, double *omega)
{
    struct instant at = state_instant(subject->state);
    at.y = y;
    tree_move(subject->model, &at);
    for (size_t b = 0; b < subject->model->body_count; b++) {
        const struct model_body *body = &subject->model->bodies[b];
        struct pose pose = body_pose(body, &at);
        v_G[b] = point_motion(body, &pose, body->inertia.G).v;
        omega[b] = pose.omega;
    }
}

/* The rate of change of the velocities along (q', v') = (v, a): fourth-order central differences. */
static void accelerations_by_differences(struct subject *subject, const double *a, struct vec *a_G,
                                         double *alpha)
{
    static const double weight[] = {1, -8, 8, -1}, place[] = {-2, -1, 1, 2};
    const double h = 1e-3;
    enum { most_bodies = 16 };
    double y[2 * most_coordinates], omega[most_bodies];
    struct vec v_G[most_bodies];
    int n = subject->n;
    memset(a_G, 0, subject->model->body_count * sizeof *a_G);
    memset(alpha, 0, subject->model->body_count * sizeof *alpha);
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < n; i++) {
            double v = subject->state->y[n + i], s = place[k] * h;
            y[i] = subject->state->y[i] + s * v + s * s * a[i] / 2;
            y[n + i] = v + s * a[i];
        }
        velocities(subject, y, v_G, omega);
        for (size_t b = 0; b < subject->model->body_count; b++) {
            a_G[b] = vec_add(a_G[b], vec_scale(weight[k] / (12 * h), v_G[b]));
            alpha[b] += weight[k] * omega[b] / (12 * h);
        }
    }
    state_evaluate(subject->state);
}

/* ---- Newton and Euler: the accelerations of the joints, carried over to the bodies by kinematics, are what
 * the diagrams, reactions included, ask for */

static void newton_and_euler_hold_for_every_body(uint64_t seed, bool friction, int loops)
{
    struct subject subject = subject_with(seed, false, friction, loops);
    struct vec a_G[16];
    double alpha[16];
    accelerations_by_differences(&subject, subject.state->a, a_G, alpha);
    struct instant at = state_instant(subject.state);
    struct arrow *arrows = calloc(diagram_most_arrows(subject.model), sizeof *arrows);
    assert_non_null(arrows);
    for (size_t b = 0; b < subject.model->body_count; b++) {
        const struct model_body *body = &subject.model->bodies[b];
        if (body->place.link == 0) continue;
        size_t count = diagram_fill(subject.model, (int)b, &at, subject.state->slots, arrows);
        assert_true(count <= diagram_arrows(subject.model, (int)b));
        struct balance balance = balance_of(body, &at, arrows, count);
        /* Rounding: forces of 10 to 1000 N pass through at most ten joints. */
        expect_near("residual", seed, balance.residual, 0, 1e-12);
        /* Differences with h = 1e-3: h^4 times fifth derivatives of motions with rates up to 20 rad/s. */
        double scale = 1e-5 * body->inertia.mass * (1 + vec_norm(a_G[b]) + fabs(alpha[b]));
        expect_near("m a_x", seed, body->inertia.mass * a_G[b].x, balance.force.x, scale);
        expect_near("m a_y", seed, body->inertia.mass * a_G[b].y, balance.force.y, scale);
        expect_near("I alpha", seed, body->inertia.I_G * alpha[b], balance.moment, scale);
    }
    free(arrows);
    release(&subject);
}

static void newton_and_euler_hold_in_random_trees(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= trees; seed++) newton_and_euler_hold_for_every_body(seed, false, 0);
}

static void newton_and_euler_hold_with_dry_friction(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= trees; seed++) newton_and_euler_hold_for_every_body(seed, true, 0);
}

/* ---- Lagrange: M a + bias = Q with the mass matrix and the generalized forces from unit rates */

static void kane(struct subject *subject, double *M, double *lack, double *size)
{
    const struct fbd_model *model = subject->model;
    int n = subject->n;
    size_t bodies = model->body_count;
    struct vec *unit_v = calloc((size_t)n * bodies + 1, sizeof *unit_v), a_G[16], arm;
    double *unit_omega = calloc((size_t)n * bodies + 1, sizeof *unit_omega), alpha[16];
    double y[2 * most_coordinates];
    struct arrow *arrows = calloc(diagram_most_arrows(model), sizeof *arrows);
    assert_true(unit_v && unit_omega && arrows);
    memcpy(y, subject->state->y, 2 * (size_t)n * sizeof *y);
    for (int k = 0; k < n; k++) {
        for (int i = 0; i < n; i++) y[n + i] = i == k;
        velocities(subject, y, unit_v + (size_t)k * bodies, unit_omega + (size_t)k * bodies);
    }
    accelerations_by_differences(subject, subject->state->a, a_G, alpha);
    struct instant at = state_instant(subject->state);
    for (size_t b = 0; b < bodies; b++) {
        const struct model_body *body = &model->bodies[b];
        size_t count = diagram_fill(model, (int)b, &at, subject->state->slots, arrows);
        struct pose pose = body_pose(body, &at);
        struct vec G = point_motion(body, &pose, body->inertia.G).p;
        double m = body->inertia.mass, I = body->inertia.I_G;
        for (int k = 0; k < n; k++) {
            struct vec v = unit_v[(size_t)k * bodies + b];
            double omega = unit_omega[(size_t)k * bodies + b];
            double needs = m * vec_dot(v, a_G[b]) + I * omega * alpha[b];
            lack[k] += needs;
            size[k] += fabs(needs);
            for (int j = 0; j < n; j++)
                M[k * n + j] += m * vec_dot(v, unit_v[(size_t)j * bodies + b]) +
                                I * omega * unit_omega[(size_t)j * bodies + b];
            for (size_t i = 0; i < count; i++) {
                arm = vec_sub(arrows[i].point, G);
                double power = vec_dot(arrows[i].force, vec_add(v, vec_scale(omega, vec_perp(arm)))) +
                               arrows[i].couple * omega;
                lack[k] -= power; /* reactions drop out by themselves, or the test fails */
                size[k] += fabs(power);
            }
        }
    }
    free(unit_v);
    free(unit_omega);
    free(arrows);
}

static void the_accelerations_solve_kanes_equations(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= trees; seed++) {
        struct subject subject = subject_of(seed, false, false);
        int n = subject.n;
        double M[most_coordinates * most_coordinates] = {0}, lack[most_coordinates] = {0},
                                    size[most_coordinates] = {0}, kinetic = 0, by_matrix = 0;
        kane(&subject, M, lack, size);
        struct instant at = state_instant(subject.state);
        for (size_t b = 0; b < subject.model->body_count; b++)
            kinetic += kinetic_energy(&subject.model->bodies[b], &at);
        for (int i = 0; i < n; i++) {
            expect_near("Kane", seed, lack[i], 0, 1e-5 * (1 + size[i])); /* of the differences */
            for (int j = 0; j < n; j++)
                by_matrix += M[i * n + j] * subject.state->y[n + i] * subject.state->y[n + j] / 2;
        }
        expect_near("v M v / 2", seed, by_matrix, kinetic, 1e-12 * kinetic + 1e-12);
        release(&subject);
    }
}

/* ---- the exact Jacobian against differences */

static void compare_jacobian(uint64_t seed, bool friction, int loops)
{
    struct subject subject = subject_with(seed, false, friction, loops);
    size_t n = (size_t)subject.n, size = 2 * n;
    double *dfdy = calloc(size * size + 5 * size + 1, sizeof *dfdy), *dfdt = dfdy + size * size,
           *y = dfdt + size, *f = y + size;
    assert_non_null(dfdy);
    struct instant at = state_instant(subject.state);
    state_jacobian(subject.model, &at, subject.state->scratch, dfdy, dfdt);
    const double h = 1e-3;
    static const double weight[] = {1, -8, 8, -1}, place[] = {-2, -1, 1, 2};
    at.y = y;
    for (size_t j = 0; j <= size; j++) {
        double difference[2 * most_coordinates] = {0};
        if (j >= n && j < size && fabs(subject.state->y[j]) < 1e-15) continue; /* v |v| has a kink there */
        for (int k = 0; k < 4; k++) {
            memcpy(y, subject.state->y, size * sizeof *y);
            at.t = subject.state->t + (j == size ? place[k] * h : 0);
            if (j < size) y[j] += place[k] * h;
            state_rates(subject.model, &at, subject.state->slots, f);
            for (size_t i = 0; i < size; i++) difference[i] += weight[k] * f[i] / (12 * h);
        }
        double largest = 1;
        for (size_t i = 0; i < size; i++) largest = fmax(largest, fabs(difference[i]));
        for (size_t i = 0; i < size; i++) /* h^4 = 1e-12 of fifth derivatives, and 1e-13 of rounding over h */
            expect_near("Jacobian", seed, j < size ? dfdy[i * size + j] : dfdt[i], difference[i],
                        (loops ? 2e-5 : 2e-6) * largest);
    }
    free(dfdy);
    release(&subject);
}

static void the_jacobian_is_exact_in_random_trees(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= trees; seed++) compare_jacobian(seed, false, 0);
}

static void the_jacobian_is_exact_while_joints_slip(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= trees; seed++) compare_jacobian(seed, true, 0);
}

/* ---- loops: rods and ropes between random points */

static bool is_well_conditioned(uint64_t seed, bool friction, int loops)
{
    struct subject subject = subject_with(seed, false, friction, loops);
    bool well = subject.fits; /* a rod on a point that cannot move says nothing */
    for (int j = 0; j < subject.model->tree->row_count; j++) {
        const struct row *row = &subject.state->tree->rows[j];
        well = well && !row->redundant && fabs(row->lambda) < 1e3;
    }
    release(&subject);
    return well;
}

static void newton_and_euler_hold_in_loops(void **unused)
{
    (void)unused;
    int looked = 0;
    for (uint64_t seed = 1; seed <= trees; seed++)
        for (int friction = 0; friction < 2; friction++) {
            int loops = 1 + (int)(seed % 3);
            if (!is_well_conditioned(seed, friction, loops)) continue;
            newton_and_euler_hold_for_every_body(seed, friction, loops);
            looked++;
        }
    assert_true(looked > trees);
}

static void the_jacobian_is_exact_in_loops(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= trees; seed++)
        for (int friction = 0; friction < 2; friction++)
            if (is_well_conditioned(seed, friction, 1 + (int)(seed % 3)))
                compare_jacobian(seed, friction, 1 + (int)(seed % 3));
}

/* ---- energy */

static void conservative_trees_keep_their_energy(void **unused)
{
    (void)unused;
    fbd_errors *errors = fbd_errors_new();
    for (uint64_t seed = 1; seed <= 20; seed++) {
        struct random_numbers numbers = {seed};
        struct random_tree tree = {2 + (int)(seed % 6), true, false, 0, false};
        char *text = random_tree_text(&numbers, &tree);
        assert_non_null(text);
        fbd_model *model = model_from(text);
        free(text);
        static const fbd_options defaults = {0};
        fbd_simulation *simulation = fbd_simulation_new(model, &defaults, errors);
        fbd_result *result = simulation ? fbd_simulation_run(simulation, NULL) : NULL;
        assert_non_null(result);
        fbd_energy energy = fbd_result_energy(result);
        double turned_over = fabs(energy.potential - energy.initial_potential) + energy.kinetic;
        /* Tolerance 1e-11 a step, some hundred steps. */
        expect_near("residual", seed, energy.residual, 0, 1e-8 * (1 + turned_over));
        fbd_result_free(result);
        fbd_simulation_free(simulation);
        fbd_model_free(model);
    }
    fbd_errors_free(errors);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(newton_and_euler_hold_in_random_trees),
        cmocka_unit_test(newton_and_euler_hold_with_dry_friction),
        cmocka_unit_test(the_accelerations_solve_kanes_equations),
        cmocka_unit_test(the_jacobian_is_exact_in_random_trees),
        cmocka_unit_test(the_jacobian_is_exact_while_joints_slip),
        cmocka_unit_test(newton_and_euler_hold_in_loops),
        cmocka_unit_test(the_jacobian_is_exact_in_loops),
        cmocka_unit_test(conservative_trees_keep_their_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
