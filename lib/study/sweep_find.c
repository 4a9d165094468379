/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows of a sweep that are answers of searches: at which value of one parameter, for each run of others.
 */
#include <math.h>
#include <string.h>

#include "study/sweep.h"

/* The settings of a run: those of the plan, then the varying parameters. NULL when memory is out. */
static const fbd_setting *settings_of(const struct fbd_sweep *sweep, uint64_t run, struct arena *arena)
{
    const size_t fixed = sweep->find.setting_count, varying = sweep->axes.member_count;
    fbd_setting *settings = ARENA_ARRAY(arena, fixed + varying, fbd_setting);
    struct text text = {0};
    if (!settings) return NULL;
    if (fixed) memcpy(settings, sweep->find.settings, fixed * sizeof *settings);
    for (size_t i = 0; i < varying; i++) {
        const struct member *member = &sweep->axes.members[i];
        text.length = 0;
        axes_value(&sweep->axes, member, run, &text);
        if (member->unit[0]) text_printf(&text, " %s", member->unit);
        const char *value = text.failed ? NULL : arena_text(arena, text.data, text.length);
        settings[fixed + i] = (fbd_setting){member->name, value};
    }
    const bool failed = text.failed || arena->failed;
    text_free(&text);
    return failed ? NULL : settings;
}

struct watched {
    fbd_stop *stop;
    void *context;
};

static int watch(void *context, const fbd_progress *progress)
{
    const struct watched *watched = context;
    (void)progress;
    return watched->stop ? watched->stop(watched->context) : 0;
}

static fbd_find *search(const struct fbd_sweep *sweep, uint64_t run, struct watched *watched,
                        fbd_errors *errors)
{
    struct arena arena = {0};
    fbd_find_plan plan = sweep->find;
    plan.settings = settings_of(sweep, run, &arena);
    plan.setting_count += sweep->axes.member_count;
    plan.progress = watch;
    plan.progress_context = watched;
    fbd_find *find = plan.settings ? fbd_find_parse(sweep->source, sweep->source_length, sweep->name,
                                                    sweep->question, &plan, errors)
                                   : NULL;
    arena_free(&arena);
    return find;
}

/* ---- the header */

static bool copy_question(struct fbd_sweep *sweep, const fbd_sweep_plan *plan)
{
    struct arena *arena = &sweep->arena;
    fbd_setting *settings = ARENA_ARRAY(arena, plan->setting_count + 1, fbd_setting);
    if (!settings) return false;
    for (size_t i = 0; i < plan->setting_count; i++)
        settings[i] =
            (fbd_setting){arena_text(arena, plan->settings[i].name, strlen(plan->settings[i].name)),
                          arena_text(arena, plan->settings[i].value, strlen(plan->settings[i].value))};
    sweep->run = *plan->run;
    if (sweep->run.method)
        sweep->run.method = arena_text(arena, sweep->run.method, strlen(sweep->run.method));
    sweep->find = (fbd_find_plan){.settings = settings,
                                  .setting_count = plan->setting_count,
                                  .run = &sweep->run,
                                  .statics = plan->statics,
                                  .runs = plan->find_runs};
    sweep->question = arena_text(arena, plan->find, strlen(plan->find));
    return !arena->failed;
}

bool sweep_find_prepare(struct fbd_sweep *sweep, const fbd_sweep_plan *plan, fbd_errors *errors)
{
    enum { coarse = 3 }; /* runs are enough to refuse a wrong question */
    struct watched watched = {0};
    if (!copy_question(sweep, plan)) return false;
    const size_t runs = sweep->find.runs;
    if (runs == 0) sweep->find.runs = coarse;
    fbd_find *find = search(sweep, 0, &watched, NULL); /* the warnings are those of the rows */
    if (!find) find = search(sweep, 0, &watched, errors);
    sweep->find.runs = runs;
    if (!find) return false;
    const fbd_found found = fbd_find_summary(find);
    const char *form = found.unit[0] ? " [%s]" : "%s";
    rows_header_start(sweep->rows, &sweep->header);
    text_printf(&sweep->header, ",%s", found.parameter);
    text_printf(&sweep->header, form, found.unit);
    text_add(&sweep->header, ",error");
    text_printf(&sweep->header, form, found.unit);
    text_add(&sweep->header, ",solutions,runs,status,reason\n");
    fbd_find_free(find);
    return true;
}

/* ---- rows */

static void put_start(const struct fbd_sweep *sweep, uint64_t run, struct text *text)
{
    text_exact(text, (double)(run + 1));
    for (size_t i = 0; i < sweep->axes.member_count; i++) {
        text_add(text, ",");
        axes_value(&sweep->axes, &sweep->axes.members[i], run, text);
    }
}

static enum row_end put_found(const fbd_find *find, struct text *text)
{
    const fbd_found found = fbd_find_summary(find);
    fbd_solution first = {.value = NAN};
    size_t solutions = 0;
    for (size_t i = 0; i < fbd_find_solution_count(find); i++) {
        const fbd_solution solution = fbd_find_solution(find, i);
        if (solution.kind != FBD_SOLUTION_JUMP && solutions++ == 0) first = solution;
    }
    text_add(text, ",");
    if (solutions) text_exact(text, first.value);
    text_add(text, ",");
    if (solutions) text_exact(text, first.error);
    text_printf(text, ",%zu,%zu", solutions, found.runs);
    if (found.failed == 0) {
        rows_put_end(text, "done", "");
        return row_well;
    }
    for (size_t i = 0; i < fbd_find_gap_count(find); i++) {
        const fbd_find_gap gap = fbd_find_gap_get(find, i);
        if (!gap.failed) continue;
        rows_put_end(text, "failed", gap.reason);
        break;
    }
    return row_failed;
}

/* The row of a search that was refused, by its first error. */
static enum row_end put_refused(fbd_errors *errors, struct text *text)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        const fbd_error note = fbd_errors_get(errors, i);
        if (note.severity != FBD_ERROR) continue;
        if (strcmp(note.id, "stopped") == 0) return row_stopped;
        text_add(text, ",,,,");
        rows_put_end(text, "wrong", note.message);
        return row_failed;
    }
    text->failed = true; /* memory is out */
    return row_failed;
}

enum row_end sweep_find_row(const struct fbd_sweep *sweep, uint64_t run, fbd_stop *stop, void *stop_context,
                            struct text *text)
{
    const size_t start = text->length;
    struct watched watched = {stop, stop_context};
    fbd_errors *errors = fbd_errors_new();
    fbd_find *find = errors ? search(sweep, run, &watched, errors) : NULL;
    put_start(sweep, run, text);
    const enum row_end end = find ? put_found(find, text) : put_refused(errors, text);
    if (end == row_stopped) text->length = start;
    fbd_find_free(find);
    fbd_errors_free(errors);
    return end;
}
