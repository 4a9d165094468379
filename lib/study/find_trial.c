/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One value of the parameter: a row of a sweep (of an equation with --static a row at rest), or the statics of the scene
 * at its start.
 */
#include <math.h>
#include <string.h>

#include "fbd_view.h"
#include "study/find.h"

/* ---- rows */

static void put_value(const void *context, size_t parameter, uint64_t run, struct text *text)
{
    const struct fbd_find *find = context;
    (void)parameter;
    (void)run;
    text_exact(text, find->value);
}

/* The outputs that the question needs. */
static const char *const *outputs_of(struct fbd_find *find, size_t *count)
{
    if (find->formula) return row_formula_outputs(find->formula, count);
    const char **one = ARENA_ARRAY(&find->arena, 1, const char *);
    if (!one) return NULL;
    *one = find->event ? arena_printf(&find->arena, "count(%s)", find->event) : "t";
    *count = 1;
    return *one ? one : NULL;
}

static bool prepare_rows(struct fbd_find *find, struct find_rows *of, const struct rows_parameter *parameter,
                         fbd_errors *errors)
{
    const fbd_find_plan *plan = find->plan;
    fbd_sweep_plan sweep = {.settings = plan->settings,
                            .setting_count = plan->setting_count,
                            .run = &of->options};
    sweep.outputs = outputs_of(find, &sweep.output_count);
    if (!sweep.outputs) return false;
    const struct rows_source source = {parameter, 1, put_value, find, "--find", "--find"};
    of->rows = rows_open(find->source, find->source_length, find->name, errors);
    if (!of->rows || !rows_prepare(of->rows, &source, &sweep, errors)) return false;
    of->maker = row_maker_new(of->rows, NULL, NULL);
    return of->maker != NULL;
}

/* The options of the runs for the errors: a hundredth of the tolerance, or half the step. */
static fbd_options tight_options(const struct fbd_find *find)
{
    const double share = 0.01, least = 1e-14;
    fbd_options options = find->normal.options;
    fbd_model *model = fbd_model_parse(find->source, find->source_length, find->name, find->plan->settings,
                                       find->plan->setting_count, NULL);
    fbd_options file;
    fbd_model_options(model, &file, sizeof file);
    fbd_model_free(model);
    const double step = options.step > 0 ? options.step : options.tolerance > 0 ? 0 : file.step;
    const double given = options.tolerance > 0 ? options.tolerance : file.tolerance;
    if (step > 0)
        options.step = step / 2;
    else
        options.tolerance = fmax(least, share * (given > 0 ? given : 1e-10));
    return options;
}

static bool prepare_runs(struct fbd_find *find)
{
    struct rows_parameter *parameter = ARENA_ARRAY(&find->arena, 1, struct rows_parameter);
    if (!parameter) return false;
    *parameter = (struct rows_parameter){.name = find->parameter, .unit = find->unit};
    find->normal.options = find->plan->run ? *find->plan->run : (fbd_options)FBD_OPTIONS_DEFAULT;
    find->value = find->from;
    if (!prepare_rows(find, &find->normal, parameter, find->errors)) return false;
    if (find->formula && !row_formula_compile(find->formula, find->normal.rows, find->errors)) return false;
    if (find->plan->statics && !rows_rest(find->normal.rows, find->errors)) return false;
    if (!rows_try(find->normal.rows, 0, find->errors)) return false;
    size_t count = 0;
    outputs_of(find, &count);
    find->look.values = ARENA_ARRAY(&find->arena, count, double);
    find->tight.options = tight_options(find);
    fbd_errors *again = fbd_errors_new(); /* the notes were given before */
    const bool prepared = again && prepare_rows(find, &find->tight, parameter, again);
    fbd_errors_free(again);
    return find->look.values && prepared;
}

static bool keep_texts(struct fbd_find *find, struct trial *trial, const char *story)
{
    trial->story = arena_text(&find->arena, story, strlen(story));
    trial->status = arena_text(&find->arena, trial->status, strlen(trial->status));
    trial->reason = arena_text(&find->arena, trial->reason, strlen(trial->reason));
    return trial->story && trial->status && trial->reason;
}

static bool try_run(struct fbd_find *find, bool tight, struct trial *trial)
{
    struct row_look *look = &find->look;
    enum row_end end = find->plan->statics
                           ? row_look_at_rest(find->normal.maker, find->runs, look)
                           : row_look(tight ? find->tight.maker : find->normal.maker, find->runs, look);
    if (look->row.failed || look->story.failed || end == row_stopped) return false;
    trial->status = look->status;
    trial->reason = look->reason;
    if (!keep_texts(find, trial, look->story.data)) return false;
    const bool broken = strcmp(trial->status, "broken") == 0;
    trial->failed = end == row_failed && !broken;
    trial->known = !trial->failed;
    if (find->kind == find_equation) {
        trial->f = row_formula_value(find->formula, look->values);
        trial->known =
            trial->known && isfinite(trial->f) && (!broken || row_formula_of_events(find->formula));
    }
    trial->outcome = find->kind == find_happenings ? trial->story
                     : look->values[0] > 0         ? "it happens"
                                                   : "it does not happen";
    return true;
}

/* ---- statics */

static fbd_model *model_with(struct fbd_find *find, double p, fbd_errors *errors)
{
    const fbd_find_plan *plan = find->plan;
    fbd_setting *settings = ARENA_ARRAY(&find->arena, plan->setting_count + 1, fbd_setting);
    struct text value = {0};
    text_exact(&value, p);
    if (find->unit[0]) text_printf(&value, " %s", find->unit);
    fbd_model *model = NULL;
    if (settings && !value.failed) {
        if (plan->setting_count) memcpy(settings, plan->settings, plan->setting_count * sizeof *settings);
        settings[plan->setting_count] = (fbd_setting){find->parameter, value.data};
        model = fbd_model_parse(find->source, find->source_length, find->name, settings,
                                plan->setting_count + 1, errors);
    }
    text_free(&value);
    return model;
}

/* How far a limit is from being exceeded: positive within it. */
static double margin_of(const fbd_limit *limit)
{
    return limit->kind == FBD_LIMIT_FRICTION ? limit->limit - fabs(limit->needed) : limit->needed;
}

static const char *broken_story(struct fbd_find *find, const fbd_limit *limit)
{
    static const char *const verbs[] = {"would have to pull", "slips", "would have to push"};
    return arena_printf(&find->arena, "NOT in equilibrium: `%s` %s", limit->name, verbs[limit->kind]);
}

static void judge(struct fbd_find *find, const fbd_statics *statics, struct trial *trial)
{
    const bool holds = fbd_statics_holds(statics);
    trial->outcome = trial->story = holds ? "in equilibrium" : "NOT in equilibrium";
    for (size_t i = 0; i < fbd_statics_limit_count(statics); i++) {
        const fbd_limit limit = fbd_statics_limit(statics, i);
        if (find->limit && strcmp(find->limit, limit.name) == 0) trial->f = margin_of(&limit);
        if (holds || limit.holds || trial->broken || fbd_statics_unbalanced_count(statics) > 0) continue;
        trial->broken = arena_text(&find->arena, limit.name, strlen(limit.name));
        trial->story = broken_story(find, &limit);
    }
    trial->determinate = fbd_statics_indeterminacy(statics) == 0;
    trial->known = find->kind != find_limit || isfinite(trial->f);
}

/* At the end of a range in which no trial has that limit: friction of zero has none. */
static void note_unknown_limit(struct fbd_find *find, const fbd_statics *statics)
{
    if (!find->limit) return;
    const char *names[100];
    size_t count = 0;
    for (; count < fbd_statics_limit_count(statics) && count < sizeof names / sizeof *names; count++)
        names[count] = fbd_statics_limit(statics, count).name;
    diag_in_file(find->errors, "--find");
    diag_add(find->errors, FBD_ERROR, "bad-find", (struct pos){0, 0},
             count ? diag_nearest(find->errors, find->limit, names, count) : NULL,
             "--static has no limit `%.80s`", find->limit);
}

static bool try_statics(struct fbd_find *find, struct trial *trial)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = errors ? model_with(find, trial->p, errors) : NULL;
    fbd_state *state = model ? fbd_state_new(model) : NULL;
    fbd_statics *statics = state ? fbd_statics_new(state, errors) : NULL;
    trial->status = "done";
    if (statics) {
        judge(find, statics, trial);
        find->limit_seen |= isfinite(trial->f);
        if (!find->limit_seen && trial->p == find->to) note_unknown_limit(find, statics);
    } else if (errors) {
        const fbd_error first = fbd_errors_get(errors, 0);
        trial->failed = true;
        trial->status = model ? "failed" : "wrong";
        trial->reason = first.message ? first.message : "out of memory";
    }
    bool kept = errors && keep_texts(find, trial, trial->story);
    fbd_statics_free(statics);
    fbd_state_free(state);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return kept;
}

/* ---- a trial */

bool find_prepare_trials(struct fbd_find *find)
{
    return !find_runs(find) || prepare_runs(find);
}

static void free_rows(struct find_rows *of)
{
    row_maker_free(of->maker);
    rows_free(of->rows);
    *of = (struct find_rows){0};
}

void find_free_trials(struct fbd_find *find)
{
    free_rows(&find->normal);
    free_rows(&find->tight);
    row_look_free(&find->look);
}

static bool goes_on(struct fbd_find *find)
{
    const fbd_find_plan *plan = find->plan;
    const fbd_progress progress = {"find", .share = fmin(1, (double)find->runs / (double)find->scan),
                                   .written = find->runs, .failed = find->failed};
    if (!plan->progress || plan->progress(plan->progress_context, &progress) == 0) return true;
    find->stopped = true;
    return false;
}

bool find_try(struct fbd_find *find, double p, bool tight, struct trial *trial)
{
    *trial = (struct trial){.p = p, .f = NAN, .outcome = "", .story = "", .status = "", .reason = ""};
    find->value = p;
    find->runs++;
    bool made = find_runs(find) ? try_run(find, tight, trial) : try_statics(find, trial);
    if (made && trial->failed && !tight) find->failed++;
    return made && !find->arena.failed && goes_on(find);
}

bool find_differs(const struct fbd_find *find, const struct trial *a, const struct trial *b)
{
    if (find_is_equation(find)) return (a->f < 0) != (b->f < 0) && a->f != 0 && b->f != 0;
    return strcmp(a->outcome, b->outcome) != 0;
}
