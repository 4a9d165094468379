/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Wrong calls of fbd_view.h (test_bad_calls.c).
 */
#include "bad_calls.h"
#include "fbd_view.h"

void bodies_and_forces(void **context)
{
    (void)context;
    fbd_state *state = fbd_state_new(model);
    fbd_listed_force force;
    fbd_named_force named;
    assert_non_null(state);
    ANSWERS(fbd_model_scene, strcmp(fbd_model_scene(NULL).units, "") == 0);
    ANSWERS(fbd_model_body, !fbd_model_body(NULL, 0).name);
    ANSWERS(fbd_model_body, is_nan(fbd_model_body(model, past).inertia.mass));
    ANSWERS(fbd_model_shape_inertia, is_nan(fbd_model_shape_inertia(NULL, 0, 0).mass));
    ANSWERS(fbd_state_point_motion, is_nan(fbd_state_point_motion(NULL, 0, NULL).omega));
    ANSWERS(fbd_state_point_motion, is_nan(fbd_state_point_motion(state, 0, NULL).alpha));
    ANSWERS(fbd_state_pose, is_nan(fbd_state_pose(NULL, 0).x));
    ANSWERS(fbd_state_pose, is_nan(fbd_state_pose(state, past).G[1]));
    ANSWERS(fbd_state_slip, fbd_state_slip(NULL, 0) == 0);
    ANSWERS(fbd_state_slip, fbd_state_slip(state, past) == 0);
    ANSWERS(fbd_state_forces, fbd_state_forces(NULL, 0, &force, 1) == 0);
    ANSWERS(fbd_state_forces, fbd_state_forces(state, past, &force, 1) == 0);
    ANSWERS(fbd_state_forces, fbd_state_forces(state, 0, NULL, 7) > 0);
    ANSWERS(fbd_state_named_force, !fbd_state_named_force(NULL, 0, "spring", &named));
    ANSWERS(fbd_state_named_force, !fbd_state_named_force(state, past, "spring", &named));
    ANSWERS(fbd_state_named_force, !fbd_state_named_force(state, 0, NULL, &named));
    ANSWERS(fbd_state_named_force, !fbd_state_named_force(state, 0, "spring", NULL));
    ANSWERS(fbd_state_named_force, !fbd_state_named_force(state, 0, "rope", &named));
    fbd_state_free(state);
}

void states_for_comparison(void **context)
{
    (void)context;
    fbd_state *state = fbd_state_new(model), *foreign = fbd_state_new(other);
    fbd_sampler *sampler = fbd_sampler_new(model);
    assert_true(state && foreign && sampler);
    ANSWERS(fbd_state_settle, !fbd_state_settle(NULL));
    ENDURES(fbd_state_let_forces_act, fbd_state_let_forces_act(NULL));
    ANSWERS(fbd_state_accelerations, fbd_state_accelerations(NULL, NULL, 0) == 0);
    ANSWERS(fbd_state_accelerations, fbd_state_accelerations(state, NULL, 7) == 1);
    ANSWERS(fbd_state_new_start, !fbd_state_new_start(NULL));
    ANSWERS(fbd_sampler_new, !fbd_sampler_new(NULL));
    ANSWERS(fbd_sampler_start, !fbd_sampler_start(NULL, state, false));
    ANSWERS(fbd_sampler_start, !fbd_sampler_start(sampler, NULL, false));
    ANSWERS(fbd_sampler_start, !fbd_sampler_start(sampler, foreign, true));
    ANSWERS(fbd_sampler_draw, !fbd_sampler_draw(NULL, state, 1));
    ANSWERS(fbd_sampler_draw, !fbd_sampler_draw(sampler, foreign, 1));
    ANSWERS(fbd_sampler_draw, !fbd_sampler_draw(sampler, state, 0));
    ENDURES(fbd_sampler_free, fbd_sampler_free(NULL));
    fbd_sampler_free(sampler);
    fbd_state_free(state);
    fbd_state_free(foreign);
}
