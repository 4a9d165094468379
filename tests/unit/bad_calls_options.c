/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Options of programs that know an earlier or a later fbd.h, and callbacks that end what is under way
 * (test_bad_calls.c).
 */
#include "bad_calls.h"
#include "fbd_study.h"

/* ---- options of other versions */

/* A program of a later version: members that this library does not know. */
struct later_options {
    fbd_options known;
    double unknown;
};

void options_have_a_size(void **context)
{
    (void)context;
    struct later_options later = {.known = FBD_OPTIONS_DEFAULT};
    const fbd_recording unsized = {.size = 3};
    later.known.size = sizeof later;
    fbd_simulation *simulation = fbd_simulation_new(model, &later.known, errors);
    assert_non_null(simulation); /* it asks for nothing that is not known here */
    ANSWERS(fbd_simulation_run, !fbd_simulation_run(simulation, &unsized));
    fbd_simulation_free(simulation);
    later.unknown = 1;
    REFUSES(fbd_simulation_new, !fbd_simulation_new(model, &later.known, errors));
    later.known.size = SIZE_MAX; /* never set */
    REFUSES(fbd_simulation_new, !fbd_simulation_new(model, &later.known, errors));
    /* One of an earlier version, which ends before `method`: what stands there is none of it. */
    fbd_options earlier = FBD_OPTIONS_DEFAULT;
    earlier.size = offsetof(fbd_options, method);
    earlier.method = "no such method";
    simulation = fbd_simulation_new(model, &earlier, errors);
    assert_non_null(simulation);
    fbd_simulation_free(simulation);
    earlier.size = 0; /* all of version 0.1 */
    ANSWERS(fbd_simulation_new, !fbd_simulation_new(model, &earlier, NULL));
}

void options_are_filled_with_defaults(void **context)
{
    (void)context;
    const fbd_options plain = FBD_OPTIONS_DEFAULT;
    const fbd_cost_options study = FBD_COST_OPTIONS_DEFAULT;
    struct later_options later = {.unknown = 7};
    fbd_cost_options own;
    ENDURES(fbd_options_init, fbd_options_init(NULL, sizeof plain));
    fbd_options_init(&later.known, sizeof later);
    assert_int_equal(later.known.size, sizeof later);
    assert_true(is_nan(later.known.until) && !later.known.method && later.unknown == 0);
    later.unknown = 7;
    fbd_options_init(&later.known, offsetof(fbd_options, method)); /* writes no further than it may */
    assert_true(later.unknown == 7);
    ENDURES(fbd_cost_options_init, fbd_cost_options_init(NULL, sizeof own));
    fbd_cost_options_init(&own, sizeof own);
    assert_memory_equal(&own, &study, offsetof(fbd_cost_options, fixed_steps));
}

/* ---- callbacks */

static int end_at_once(void *context, const fbd_progress *progress)
{
    *(fbd_progress *)context = *progress;
    return 1;
}

void progress_ends_what_is_under_way(void **context)
{
    (void)context;
    static const char *const vary[] = {"k=1,2,3"};
    size_t bytes = 0;
    fbd_progress told = {0};
    const fbd_recording recording = {.progress = end_at_once, .progress_context = &told};
    const fbd_options by_steps = {.until = NAN, .step = 0.01, .method = "rk4"};
    fbd_simulation *simulation = fbd_simulation_new(model, &by_steps, errors);
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    assert_int_equal(fbd_result_outcome(result), FBD_INTERRUPTED);
    assert_string_equal(told.what, "run");
    assert_true(told.steps == 1 && told.share > 0 && told.share < 1);
    assert_true(told.share == told.t / told.until);
    fbd_result_free(result);
    fbd_simulation_free(simulation);

    const fbd_sweep_plan plan = {.size = sizeof plan, .vary = vary, .vary_count = 1};
    fbd_sweep *sweep = fbd_sweep_parse(bad_calls_scene, strlen(bad_calls_scene), "scene", &plan, errors);
    const fbd_sweep_work work = {.end = 3,
                                 .jobs = 1,
                                 .write = bad_calls_count,
                                 .write_context = &bytes,
                                 .progress = end_at_once,
                                 .progress_context = &told};
    fbd_sweep_counts counts;
    assert_int_equal(fbd_sweep_run(sweep, &work, &counts), FBD_SWEEP_STOPPED);
    assert_int_equal(counts.written, 1);
    assert_string_equal(told.what, "sweep");
    assert_true(told.written == 1 && told.share == 1.0 / 3);
    fbd_sweep_free(sweep);

    fbd_cost_options study = FBD_COST_OPTIONS_DEFAULT;
    study.progress = end_at_once;
    study.progress_context = &told;
    fbd_errors *own = fbd_errors_new();
    assert_null(fbd_cost_new(model, &study, own));
    assert_string_equal(fbd_errors_get(own, 0).id, "stopped");
    assert_string_equal(told.what, "reference");
    assert_null(fbd_effects_new(model, &study, own));
    assert_string_equal(fbd_errors_get(own, 1).id, "stopped");
    fbd_errors_free(own);
}
