/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What must hold for every scene: the plan and the free-body diagram are two views of one physics, the
 * Jacobian is the derivative of the rates, potential energies fall as fast as their forces work.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "dynamics/diagram.h"
#include "dynamics/energy.h"
#include "dynamics/mass.h"
#include "dynamics/modes.h"
#include "dynamics/tree.h"
#include "scenes.h"

enum { states = 20, most_arrows = 20 };

static double uniform(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u; /* Numerical Recipes' quick generator: enough to pick states */
    return (double)(*seed >> 8) / (1 << 24);
}

static void scatter(fbd_state *state, unsigned *seed)
{
    int n = state->model->plan.n;
    state->t = 2 * uniform(seed);
    for (int i = 0; i < 2 * n; i++) state->y[i] = 2 * uniform(seed) - 1;
    assert_true(modes_settle(state, NULL));
}

static void near(const char *what, const char *scene, double got, double want, double tolerance)
{
    if (fabs(got - want) <= tolerance) return;
    fail_msg("%s of scene \"%s\": got %.15g, expected %.15g, off by %.2e, allowed %.2e", what, scene, got,
             want, fabs(got - want), tolerance);
}

typedef void check(const struct named_scene *scene, fbd_state *state);

static void at_random_states(check *check_state)
{
    for (size_t s = 0; s < all_scenes_count; s++) {
        fbd_model *model = model_from(all_scenes[s].text);
        fbd_state *state = state_new(model);
        assert_non_null(state);
        unsigned seed = 7;
        for (int k = 0; k < states; k++) {
            scatter(state, &seed);
            check_state(&all_scenes[s], state);
        }
        state_free(state);
        fbd_model_free(model);
    }
}

/* ---- the diagram adds up */

static void check_newton(const struct named_scene *scene, fbd_state *state)
{
    const fbd_model *model = state->model;
    struct instant at = state_instant(state);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        struct arrow arrows[most_arrows];
        size_t count = diagram_fill(model, (int)b, &at, state->slots, arrows);
        struct pose pose = body_pose(body, &at);
        struct vec G = point_motion(body, &pose, body->inertia.G).p, sum = {0, 0};
        struct vec a = mass_center_acceleration(body, &at);
        double moment = 0, size = 0;
        for (size_t i = 0; i < count; i++) {
            sum = vec_add(sum, arrows[i].force);
            moment += arrow_moment(&arrows[i], G);
            size += vec_norm(arrows[i].force) + fabs(arrow_moment(&arrows[i], G));
        }
        /* Sums of some ten terms in another order than the plan's: a few roundings of their size. */
        double tolerance = 1e-13 * size, m = body_mass(body, &at);
        near("sum of forces along x", scene->name, sum.x, m * a.x, tolerance);
        near("sum of forces along y", scene->name, sum.y, m * a.y, tolerance);
        double I_alpha = body_inertia(body, &at).I_G * body_angular_acceleration(body, &at);
        if (body->joint->angle >= 0) near("sum of moments about G", scene->name, moment, I_alpha, tolerance);
    }
}

static void forces_of_the_diagram_give_the_acceleration_of_the_mass_centre_and_the_turning(void **unused)
{
    (void)unused;
    at_random_states(check_newton);
}

/* ---- the Jacobian is the derivative */

/* Fourth-order central difference of the rates with respect to y[j] (or t for j = size). */
static void difference(fbd_state *state, size_t j, double h, double *slope)
{
    static const double weights[] = {1, -8, 8, -1};
    static const double steps[] = {-2, -1, 1, 2};
    size_t size = 2 * (size_t)state->model->plan.n;
    double rates[12];
    memset(slope, 0, size * sizeof *slope);
    double *place = j < size ? &state->y[j] : &state->t, keep = *place;
    for (int k = 0; k < 4; k++) {
        *place = keep + steps[k] * h;
        struct instant at = state_instant(state);
        state_rates(state->model, &at, state->slots, rates);
        for (size_t i = 0; i < size; i++) slope[i] += weights[k] * rates[i] / (12 * h);
    }
    *place = keep;
}

static void check_jacobian(const struct named_scene *scene, fbd_state *state)
{
    size_t size = 2 * (size_t)state->model->plan.n;
    double dfdy[144], dfdt[12], slope[12];
    struct instant at = state_instant(state);
    assert_true(size <= 12);
    state_jacobian(state->model, &at, state->scratch, dfdy, dfdt);
    const double h =
        1e-3; /* truncation h^4 f(5)/30, rounding eps f/h: both near 1e-12 of terms of size 1..100 */
    for (size_t j = 0; j <= size; j++) {
        difference(state, j, h, slope);
        for (size_t i = 0; i < size; i++)
            near("Jacobian", scene->name, j < size ? dfdy[i * size + j] : dfdt[i], slope[i],
                 1e-7 * (1 + fabs(slope[i])));
    }
}

static void the_jacobian_is_the_derivative_of_the_rates(void **unused)
{
    (void)unused;
    at_random_states(check_jacobian);
}

/* ---- power and potential */

static double potential_after(fbd_state *state, const struct model_load *load, double h, double *scratch)
{
    size_t n = (size_t)state->model->plan.n;
    double y[12];
    for (size_t i = 0; i < n; i++) {
        y[i] = state->y[i] + h * state->y[n + i];
        y[n + i] = state->y[n + i];
    }
    struct instant at = state_instant(state);
    at.y = y;
    tree_move(state->model, &at);
    double V = potential_energy(state->model, load, &at, scratch);
    at = state_instant(state);
    tree_move(state->model, &at);
    return V;
}

static void check_power(const struct named_scene *scene, fbd_state *state)
{
    const fbd_model *model = state->model;
    double scratch[12];
    const double h = 1e-5; /* central difference: error h^2 V''' / 6 */
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        struct arrow arrows[most_arrows];
        struct instant at = state_instant(state);
        diagram_fill(model, (int)b, &at, state->slots, arrows);
        for (int i = 0; i < body->load_count; i++) {
            const struct model_load *load = &model->loads[body->first_load + i];
            if (load->potential_kind == potential_none || load->potential_kind == potential_workless)
                continue;
            double rate =
                (potential_after(state, load, h, scratch) - potential_after(state, load, -h, scratch)) /
                (2 * h);
            near(load->source->name, scene->name, arrows[i].power, -rate, 1e-6 * (1 + fabs(rate)));
        }
    }
}

static void a_potential_falls_as_fast_as_its_force_works(void **unused)
{
    (void)unused;
    at_random_states(check_power);
}

/* ---- power and point: two ways to the same number */

static void check_point_power(const struct named_scene *scene, fbd_state *state)
{
    const fbd_model *model = state->model;
    struct instant at = state_instant(state);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        struct pose pose = body_pose(body, &at);
        struct arrow arrows[most_arrows];
        diagram_fill(model, (int)b, &at, state->slots, arrows);
        for (int i = 0; i < body->load_count; i++) {
            struct motion_of_point G = point_motion(body, &pose, body->inertia.G);
            struct vec v = vec_add(G.v, vec_scale(pose.omega, vec_perp(vec_sub(arrows[i].point, G.p))));
            double power = vec_dot(arrows[i].force, v) + arrows[i].couple * pose.omega;
            near(arrows[i].name, scene->name, arrows[i].power, power, 1e-13 * (1 + 10 * fabs(power)) * 10);
        }
    }
}

static void the_power_of_a_force_is_that_at_its_point(void **unused)
{
    (void)unused;
    at_random_states(check_point_power);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_of_the_diagram_give_the_acceleration_of_the_mass_centre_and_the_turning),
        cmocka_unit_test(the_jacobian_is_the_derivative_of_the_rates),
        cmocka_unit_test(a_potential_falls_as_fast_as_its_force_works),
        cmocka_unit_test(the_power_of_a_force_is_that_at_its_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
