/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calls of sweeps, studies and grades that cannot be meant (test_bad_calls.c).
 */
#include "bad_calls.h"

#include "fbd_find.h"
#include "fbd_grade.h"
#include "fbd_section.h"
#include "fbd_study.h"
#include "fbd_workers.h"

/* ---- sweeps */

int bad_calls_count(void *context, const char *rows, size_t length)
{
    (void)rows;
    *(size_t *)context += length;
    return 0;
}

void sections(void **context)
{
    (void)context;
    double x = 0;
    REFUSES(fbd_section_new, !fbd_section_new(NULL, NULL, "rod", errors));
    REFUSES(fbd_section_place, !fbd_section_place(NULL, "1 m", &x, errors));
    ANSWERS(fbd_section_length, isnan(fbd_section_length(NULL)));
    ANSWERS(fbd_section_source_of, !fbd_section_source_of(NULL).model);
    ANSWERS(fbd_section_ends, fbd_section_ends(NULL, &x, 1) == 0);
    ANSWERS(fbd_section_at, isnan(fbd_section_at(NULL, 0, false).M));
    ANSWERS(fbd_section_load_count, fbd_section_load_count(NULL) == 0);
    ANSWERS(fbd_section_load_get, !fbd_section_load_get(NULL, 0).name);
    ANSWERS(fbd_section_extreme_of, isnan(fbd_section_extreme_of(NULL, 0, true).value));
    ANSWERS(fbd_section_text, !fbd_section_text(NULL, NULL));
    ANSWERS(fbd_section_json, !fbd_section_json(NULL, NULL));
    ENDURES(fbd_section_free, fbd_section_free(NULL));
}

void sweeps_that_cannot_be_made(void **context)
{
    (void)context;
    static const char *const vary[] = {"k=1,2"}, *const hole[] = {NULL};
    const fbd_sweep_plan plan = {.vary = vary, .vary_count = 1};
    fbd_sweep_plan holes[] = {plan, plan, plan, plan};
    holes[0].vary = hole;
    holes[1].vary = NULL;
    holes[2].outputs = hole;
    holes[2].output_count = 1;
    holes[3].setting_count = 1;
    for (size_t i = 0; i < sizeof holes / sizeof *holes; i++)
        REFUSES(fbd_sweep_parse,
                !fbd_sweep_parse(bad_calls_scene, strlen(bad_calls_scene), "scene", &holes[i], errors));
    REFUSES(fbd_sweep_parse,
            !fbd_sweep_parse(bad_calls_scene, strlen(bad_calls_scene), "scene", NULL, errors));
    REFUSES(fbd_sweep_parse, !fbd_sweep_parse(NULL, 0, "scene", &plan, errors));
    REFUSES(fbd_sweep_read, !fbd_sweep_read(NULL, &plan, errors));
    REFUSES(fbd_sweep_read, !fbd_sweep_read("-", NULL, errors));
}

/* ---- searches */

void searches(void **context)
{
    (void)context;
    const fbd_find_plan plan = {.size = sizeof plan}, hole = {.setting_count = 1}, few = {.runs = 2};
    const size_t length = strlen(bad_calls_scene);
    REFUSES(fbd_find_parse, !fbd_find_parse(NULL, 0, "scene", "k = 1..2", &plan, errors));
    REFUSES(fbd_find_parse, !fbd_find_parse(bad_calls_scene, length, "scene", NULL, &plan, errors));
    REFUSES(fbd_find_parse, !fbd_find_parse(bad_calls_scene, length, "scene", "k = 1..2", &hole, errors));
    REFUSES(fbd_find_parse, !fbd_find_parse(bad_calls_scene, length, "scene", "k = 1..2", &few, errors));
    fbd_find *find = fbd_find_parse(bad_calls_scene, length, NULL, "k = 1..2", NULL, errors);
    assert_non_null(find);
    ENDURES(fbd_find_free, fbd_find_free(NULL));
    ANSWERS(fbd_find_solution_count, fbd_find_solution_count(NULL) == 0);
    ANSWERS(fbd_find_solution, !fbd_find_solution(NULL, 0).below);
    ANSWERS(fbd_find_solution, !fbd_find_solution(find, fbd_find_solution_count(find)).below);
    ANSWERS(fbd_find_summary, !fbd_find_summary(NULL).parameter);
    ANSWERS(fbd_find_gap_count, fbd_find_gap_count(NULL) == 0);
    ANSWERS(fbd_find_gap_get, !fbd_find_gap_get(NULL, 0).reason);
    ANSWERS(fbd_find_gap_get, !fbd_find_gap_get(find, fbd_find_gap_count(find)).reason);
    ANSWERS(fbd_find_text, !fbd_find_text(NULL));
    ANSWERS(fbd_find_json, !fbd_find_json(NULL));
    fbd_find_free(find);
}

void fits(void **context)
{
    (void)context;
    static const char data[] = "t,slider.x\n1,2\n";
    const fbd_fit_plan plan = {.size = sizeof plan}, hole = {.setting_count = 1};
    const size_t length = strlen(bad_calls_scene);
    REFUSES(fbd_fit_parse, !fbd_fit_parse(NULL, 0, "scene", data, strlen(data), "data", &plan, errors));
    REFUSES(fbd_fit_parse, !fbd_fit_parse(bad_calls_scene, length, "scene", NULL, 0, "data", &plan, errors));
    REFUSES(fbd_fit_parse,
            !fbd_fit_parse(bad_calls_scene, length, "scene", data, strlen(data), NULL, &hole, errors));
    ENDURES(fbd_fit_free, fbd_fit_free(NULL));
    ANSWERS(fbd_fit_count, fbd_fit_count(NULL) == 0);
    ANSWERS(fbd_fit_get, !fbd_fit_get(NULL, 0).name);
    ANSWERS(fbd_fit_correlation, is_nan(fbd_fit_correlation(NULL, 0, 0)));
    ANSWERS(fbd_fit_summary, is_nan(fbd_fit_summary(NULL).squares));
    ANSWERS(fbd_fit_text, !fbd_fit_text(NULL));
    ANSWERS(fbd_fit_json, !fbd_fit_json(NULL));
    ANSWERS(fbd_fit_gnuplot, !fbd_fit_gnuplot(NULL, NULL));
}

void sweeps(void **context)
{
    (void)context;
    static const char *const vary[] = {"k=1,2"};
    const fbd_sweep_plan plan = {.vary = vary, .vary_count = 1};
    fbd_sweep *sweep = fbd_sweep_parse(bad_calls_scene, strlen(bad_calls_scene), "scene", &plan, errors);
    size_t length = 7, bytes = 0;
    fbd_sweep_counts counts = {.written = 7};
    const fbd_sweep_work idle = {.end = 2, .jobs = 1};
    const fbd_sweep_work work = {.end = 2, .jobs = 1, .write = bad_calls_count, .write_context = &bytes};
    assert_non_null(sweep);
    ENDURES(fbd_sweep_free, fbd_sweep_free(NULL));
    ANSWERS(fbd_sweep_run_count, fbd_sweep_run_count(NULL) == 0);
    ANSWERS(fbd_sweep_header, !fbd_sweep_header(NULL));
    ANSWERS(fbd_sweep_key, !fbd_sweep_key(NULL));
    ANSWERS(fbd_sweep_source, !fbd_sweep_source(NULL, &length) && length == 0);
    ANSWERS(fbd_sweep_source, fbd_sweep_source(sweep, NULL));
    ANSWERS(fbd_sweep_run, fbd_sweep_run(NULL, &work, &counts) == FBD_SWEEP_REFUSED && counts.written == 0);
    ANSWERS(fbd_sweep_run, fbd_sweep_run(sweep, NULL, NULL) == FBD_SWEEP_REFUSED);
    ANSWERS(fbd_sweep_run, fbd_sweep_run(sweep, &idle, NULL) == FBD_SWEEP_REFUSED);
    ANSWERS(fbd_sweep_start, !fbd_sweep_start(NULL, &work, 1));
    ANSWERS(fbd_sweep_start, !fbd_sweep_start(sweep, NULL, 1));
    ANSWERS(fbd_sweep_start, !fbd_sweep_start(sweep, &idle, 1));
    fbd_sweep_workers *crew = fbd_sweep_start(sweep, &work, 1);
    fbd_sweep_share share = {0, 2, &bytes}; /* a ticket of nobody */
    assert_non_null(crew);
    ANSWERS(fbd_sweep_claim, fbd_sweep_claim(NULL, 1, &share) == -1);
    ANSWERS(fbd_sweep_claim, fbd_sweep_claim(crew, 1, NULL) == -1);
    ENDURES(fbd_sweep_deliver, fbd_sweep_deliver(NULL, &share, "x", 1, &counts));
    ENDURES(fbd_sweep_deliver, fbd_sweep_deliver(crew, NULL, "x", 1, &counts));
    ENDURES(fbd_sweep_deliver, fbd_sweep_deliver(crew, &share, "x", 1, &counts));
    ENDURES(fbd_sweep_deliver, fbd_sweep_deliver(crew, &share, NULL, 1, &counts));
    ANSWERS(fbd_sweep_finish, fbd_sweep_finish(NULL, &counts) == FBD_SWEEP_REFUSED);
    ANSWERS(fbd_sweep_finish, fbd_sweep_finish(crew, NULL) == FBD_SWEEP_DONE); /* nothing was harmed */
    assert_true(bytes > 10);
    fbd_sweep_free(sweep);
}

/* ---- studies */

void studies(void **context)
{
    (void)context;
    static const char *const hole[] = {NULL}, *const methods[] = {"rkf45"};
    fbd_cost_options options = FBD_COST_OPTIONS_DEFAULT, holes = FBD_COST_OPTIONS_DEFAULT;
    options.budget = 0.05;
    options.methods = methods;
    options.method_count = 1;
    holes.quantities = hole;
    holes.quantity_count = 1;
    fbd_cost *cost = fbd_cost_new(model, &options, errors);
    fbd_effects *effects = fbd_effects_new(model, &options, errors);
    assert_true(cost && effects);
    REFUSES(fbd_cost_new, !fbd_cost_new(NULL, NULL, errors));
    REFUSES(fbd_cost_new, !fbd_cost_new(model, &holes, errors));
    ENDURES(fbd_cost_free, fbd_cost_free(NULL));
    ANSWERS(fbd_cost_reference, is_nan(fbd_cost_reference(NULL).floor));
    ANSWERS(fbd_cost_series_count, fbd_cost_series_count(NULL) == 0);
    ANSWERS(fbd_cost_series, fbd_cost_series(NULL, 0).count == 0);
    ANSWERS(fbd_cost_series, fbd_cost_series(cost, past).count == 0);
    ANSWERS(fbd_cost_point_count, fbd_cost_point_count(NULL) == 0);
    ANSWERS(fbd_cost_point, !fbd_cost_point(NULL, 0).method);
    ANSWERS(fbd_cost_point, is_nan(fbd_cost_point(cost, past).error));
    ANSWERS(fbd_cost_cheapest, !fbd_cost_cheapest(NULL, 1).method);
    ANSWERS(fbd_cost_cheapest, !fbd_cost_cheapest(cost, NAN).method);
    ANSWERS(fbd_cost_text, !fbd_cost_text(NULL));
    ANSWERS(fbd_cost_csv, !fbd_cost_csv(NULL));
    ANSWERS(fbd_cost_json, !fbd_cost_json(NULL));
    ANSWERS(fbd_cost_svg, !fbd_cost_svg(NULL));
    REFUSES(fbd_effects_new, !fbd_effects_new(NULL, &options, errors));
    ENDURES(fbd_effects_free, fbd_effects_free(NULL));
    ANSWERS(fbd_effects_count, fbd_effects_count(NULL) == 0);
    ANSWERS(fbd_effects_get, !fbd_effects_get(NULL, 0).name);
    ANSWERS(fbd_effects_get, is_nan(fbd_effects_get(effects, past).change_end));
    ANSWERS(fbd_effects_text, !fbd_effects_text(NULL));
    ANSWERS(fbd_effects_csv, !fbd_effects_csv(NULL));
    ANSWERS(fbd_effects_json, !fbd_effects_json(NULL));
    fbd_cost_free(cost);
    fbd_effects_free(effects);
}

static void simplifications(void)
{
    const double times[] = {0}, rows[40] = {0};
    const fbd_motion none = {.count = 0}, hole = {.count = 1, .t = times}, still = {1, times, rows};
    fbd_simplifications *list = fbd_simplify(model, &still, errors);
    assert_true(list && fbd_model_coordinate_count(model) <= 20);
    REFUSES(fbd_simplify, !fbd_simplify(NULL, &none, errors));
    REFUSES(fbd_simplify, !fbd_simplify(model, NULL, errors));
    REFUSES(fbd_simplify, !fbd_simplify(model, &hole, errors));
    ENDURES(fbd_simplifications_free, fbd_simplifications_free(NULL));
    ANSWERS(fbd_simplifications_count, fbd_simplifications_count(NULL) == 0);
    ANSWERS(fbd_simplifications_get, !fbd_simplifications_get(NULL, 0).name);
    ANSWERS(fbd_simplifications_get, !fbd_simplifications_get(list, past).name);
    REFUSES(fbd_simplifications_model, !fbd_simplifications_model(NULL, 0, errors));
    REFUSES(fbd_simplifications_model, !fbd_simplifications_model(list, past, errors));
    fbd_simplifications_free(list);
}

void methods_and_simplifications(void **context)
{
    (void)context;
    double value = 7, derivative = 7;
    ANSWERS(fbd_method_count, fbd_method_count() > 2);
    ANSWERS(fbd_method_get, !fbd_method_get(past).name);
    ANSWERS(fbd_method_find, !fbd_method_find(NULL).name);
    ANSWERS(fbd_method_find, !fbd_method_find("auto").name);
    ANSWERS(fbd_model_exact, !fbd_model_exact(NULL, 0, 0, &value, &derivative));
    ANSWERS(fbd_model_exact, !fbd_model_exact(model, past, 0, &value, &derivative));
    ANSWERS(fbd_model_exact, !fbd_model_exact(model, 0, 0, NULL, &derivative));
    ANSWERS(fbd_model_exact, !fbd_model_exact(model, 0, 0, &value, NULL));
    assert_true(value == 7 && derivative == 7);
    simplifications();
}

/* ---- grading */

void grades(void **state)
{
    (void)state;
    REFUSES(fbd_key_read, !fbd_key_read(NULL, errors));
    ANSWERS(fbd_key_read, !fbd_key_read("nowhere/at/all.yaml", NULL));
    const fbd_setting nameless = {NULL, "1"};
    REFUSES(fbd_key_read_set, !fbd_key_read_set(NULL, NULL, 0, errors));
    REFUSES(fbd_key_read_set, !fbd_key_read_set("nowhere/at/all.yaml", &nameless, 1, errors));
    ANSWERS(fbd_key_read_set, !fbd_key_read_set("nowhere/at/all.yaml", NULL, 0, NULL));
    REFUSES(fbd_key_parse, !fbd_key_parse(NULL, 0, NULL, NULL, 0, errors));
    REFUSES(fbd_key_parse, !fbd_key_parse("fbd: 1\n", 7, NULL, &nameless, 1, errors));
    ANSWERS(fbd_key_parse, !fbd_key_parse("fbd: 1\n", 7, NULL, NULL, 0, NULL));
    ENDURES(fbd_key_free, fbd_key_free(NULL));
    REFUSES(fbd_model_check_key, !fbd_model_check_key(NULL, errors));
    REFUSES(fbd_key_handout, !fbd_key_handout(NULL, "anna", errors));
    REFUSES(fbd_key_page, !fbd_key_page(NULL, "anna", true, errors));
    REFUSES(fbd_key_solution, !fbd_key_solution(NULL, "anna", errors));
    ANSWERS(fbd_finding_kind_name, strcmp(fbd_finding_kind_name((fbd_finding_kind)99), "") == 0);
    ANSWERS(fbd_finding_kind_name, strcmp(fbd_finding_kind_name((fbd_finding_kind)-1), "") == 0);
    REFUSES(fbd_grade_new, !fbd_grade_new(NULL, "answer.yaml", NULL, errors));
    REFUSES(fbd_grade_parse, !fbd_grade_parse(NULL, "fbd: 1\n", 7, "anna", errors));
    ENDURES(fbd_grade_free, fbd_grade_free(NULL));
    ANSWERS(fbd_grade_points, fbd_grade_points(NULL) == 0);
    ANSWERS(fbd_grade_most, fbd_grade_most(NULL) == 0);
    ANSWERS(fbd_grade_passed, !fbd_grade_passed(NULL));
    ANSWERS(fbd_grade_finding_count, fbd_grade_finding_count(NULL) == 0);
    ANSWERS(fbd_grade_finding, !fbd_grade_finding(NULL, 0).message);
    ANSWERS(fbd_grade_text, !fbd_grade_text(NULL, true));
    ANSWERS(fbd_grade_json, !fbd_grade_json(NULL, true));
}

void a_key_without_an_answer(void **state)
{
    (void)state;
    char path[1000];
    const char *root = getenv("FBD_SOURCE_ROOT");
    snprintf(path, sizeof path, "%s/models/kinetics/incline.yaml", root ? root : ".");
    fbd_key *key = fbd_key_read(path, errors);
    assert_non_null(key);
    REFUSES(fbd_key_handout, !fbd_key_handout(key, NULL, errors));
    REFUSES(fbd_key_page, !fbd_key_page(key, NULL, false, errors));
    REFUSES(fbd_grade_new, !fbd_grade_new(key, NULL, NULL, errors));
    ANSWERS(fbd_grade_new, !fbd_grade_new(key, NULL, NULL, NULL));
    REFUSES(fbd_grade_parse, !fbd_grade_parse(key, NULL, 0, "anna", errors));
    REFUSES(fbd_grade_parse, !fbd_grade_parse(key, "fbd: 1\n", 7, NULL, errors));
    ANSWERS(fbd_grade_parse, !fbd_grade_parse(key, NULL, 0, "anna", NULL));
    fbd_grade *grade = fbd_grade_new(key, "nowhere/at/all.yaml", "", errors);
    assert_non_null(grade);
    assert_false(fbd_grade_passed(grade));
    assert_true(fbd_grade_points(grade) == 0 && fbd_grade_most(grade) > 0);
    assert_int_equal(fbd_grade_finding(grade, 0).kind, FBD_FINDING_NO_SUBMISSION);
    ANSWERS(fbd_grade_finding, is_nan(fbd_grade_finding(grade, past).points));
    fbd_grade_free(grade);
    fbd_key_free(key);
}
