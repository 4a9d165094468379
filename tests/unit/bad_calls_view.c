/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calls that cannot be meant of the functions of fbd_view.h for drawings.
 */
#include "bad_calls.h"
#include "fbd_view.h"

static void bodies(void)
{
    ANSWERS(fbd_model_file, !fbd_model_file(NULL));
    ANSWERS(fbd_model_units, !fbd_model_units(NULL).length);
    ANSWERS(fbd_model_body, !fbd_model_body(NULL, 0).name);
    ANSWERS(fbd_model_body, !fbd_model_body(model, past).name && is_nan(fbd_model_body(model, past).pin[0]));
    ANSWERS(fbd_model_shape_count, fbd_model_shape_count(NULL, 0) == 0);
    ANSWERS(fbd_model_extent, fbd_model_extent(NULL, 0, (double[]){0, 0}, (double[]){1, 0}) < -1e300);
    ANSWERS(fbd_model_extent, fbd_model_extent(model, 0, NULL, (double[]){1, 0}) < -1e300);
    ANSWERS(fbd_model_extent, fbd_model_extent(model, past, (double[]){0, 0}, NULL) < -1e300);
    ANSWERS(fbd_model_shape_count, fbd_model_shape_count(model, past) == 0);
    ANSWERS(fbd_model_shape, is_nan(fbd_model_shape(NULL, 0, 0).radius));
    ANSWERS(fbd_model_shape, is_nan(fbd_model_shape(model, 0, past).center[1]));
    ANSWERS(fbd_model_point_count, fbd_model_point_count(NULL, 0) == 0);
    ANSWERS(fbd_model_point_count, fbd_model_point_count(model, past) == 0);
    ANSWERS(fbd_model_point, !fbd_model_point(NULL, 0, 0).name);
    ANSWERS(fbd_model_point, !fbd_model_point(model, 0, past).name);
    ANSWERS(fbd_model_track, is_nan(fbd_model_track(NULL, 0).length));
    ANSWERS(fbd_model_track, is_nan(fbd_model_track(model, past).length));
    double point[2] = {0, 0};
    ANSWERS(fbd_model_path, fbd_model_path(NULL, 0).point_count == 0);
    ANSWERS(fbd_model_path, fbd_model_path(model, past).point_count == 0);
    ANSWERS(fbd_model_path_point, !fbd_model_path_point(NULL, 0, 0, point) && is_nan(point[0]));
    ANSWERS(fbd_model_path_point, !fbd_model_path_point(model, past, 0, NULL));
    ANSWERS(fbd_model_track_place, is_nan(fbd_model_track_place(NULL, 0, 0).x));
    ANSWERS(fbd_model_track_place, is_nan(fbd_model_track_place(model, past, 0).curvature));
}

void views(void **context)
{
    (void)context;
    fbd_state *state = fbd_state_new(model);
    bodies();
    ANSWERS(fbd_state_model, !fbd_state_model(NULL));
    ANSWERS(fbd_state_model, fbd_state_model(state) == model);
    REFUSES(fbd_view_new, !fbd_view_new(NULL, errors));
    fbd_view *view = fbd_view_new(state, errors);
    assert_non_null(view);
    ANSWERS(fbd_view_pose, is_nan(fbd_view_pose(NULL, 0).x));
    ANSWERS(fbd_view_pose, is_nan(fbd_view_pose(view, past).angle));
    ANSWERS(fbd_view_mass, !fbd_view_mass(NULL, 0).symbol);
    ANSWERS(fbd_view_mass, is_nan(fbd_view_mass(view, past).mass));
    ANSWERS(fbd_view_force_count, fbd_view_force_count(NULL, 0) == 0);
    ANSWERS(fbd_view_force_count, fbd_view_force_count(view, past) == 0);
    ANSWERS(fbd_view_force, !fbd_view_force(NULL, 0, 0).kind);
    ANSWERS(fbd_view_force, is_nan(fbd_view_force(view, 0, past).arrow.fx));
    ANSWERS(fbd_view_spring_count, fbd_view_spring_count(NULL) == 0);
    ANSWERS(fbd_view_spring, !fbd_view_spring(NULL, 0).name);
    ANSWERS(fbd_view_spring, is_nan(fbd_view_spring(view, past).point[0]));
    ANSWERS(fbd_view_coupling_count, fbd_view_coupling_count(NULL) == 0);
    ANSWERS(fbd_view_coupling, !fbd_view_coupling(NULL, 0).kind);
    ANSWERS(fbd_view_coupling, fbd_view_coupling(view, past).end_count == 0);
    ANSWERS(fbd_view_coupling_end, is_nan(fbd_view_coupling_end(NULL, 0, 0).radius));
    ANSWERS(fbd_view_coupling_end, fbd_view_coupling_end(view, past, 0).body == FBD_GROUND);
    ENDURES(fbd_view_free, fbd_view_free(NULL));
    fbd_view_free(view);
    fbd_state_free(state);
}
