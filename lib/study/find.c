/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/file.h"

enum { usual_scan = 33, least_scan = 3, most_scan = 1000000 };

bool find_add_gap(struct fbd_find *find, const struct trial *trial)
{
    if (find->gap_count == find->gap_room) {
        const size_t room = find->gap_room ? 2 * find->gap_room : 16;
        fbd_find_gap *larger = ARENA_ARRAY(&find->arena, room, fbd_find_gap);
        if (!larger) return false;
        if (find->gap_count) memcpy(larger, find->gaps, find->gap_count * sizeof *larger);
        find->gaps = larger;
        find->gap_room = room;
    }
    find->gaps[find->gap_count++] = (fbd_find_gap){trial->p, trial->status, trial->reason, trial->failed};
    return true;
}

/* ---- the search */

static double scan_point(const struct fbd_find *find, size_t i)
{
    const double last = (double)(find->scan - 1);
    return i + 1 == find->scan ? find->to : find->from + (find->to - find->from) * ((double)i / last);
}

static void note_scan(struct fbd_find *find, size_t i, const struct trial *last, const struct trial *trial)
{
    const double rounding = 1e-9;
    if (i == 0) find->throughout = trial->story;
    find->least = i == 0 ? trial->f : fmin(find->least, trial->f);
    find->most = i == 0 ? trial->f : fmax(find->most, trial->f);
    if (i == 1) find->slope = (trial->f - last->f) / (trial->p - last->p);
    const double change = i > 0 ? trial->f - last->f - find->slope * (trial->p - last->p) : 0;
    const bool equal = i > 0 && trial->f == 0 && last->f == 0;
    find->linear = (i == 0 || find->linear) && trial->known && !equal &&
                   fabs(change) <= rounding * fmax(fabs(find->least), fabs(find->most));
}

static bool scan(struct fbd_find *find)
{
    struct trial before = {0}, last = {0}, trial;
    for (size_t i = 0; i < find->scan; i++) {
        if (!find_try(find, scan_point(find, i), false, &trial)) return false;
        if (fbd_errors_failed_count(find->errors) > 0) return false;
        note_scan(find, i, &last, &trial);
        if (!trial.known && !find_add_gap(find, &trial)) return false;
        if (i == 1 && !find_solve_end(find, &last, &trial)) return false;
        if (i > 1 && !find_solve_pair(find, &before, &last, &trial)) return false;
        if (i > 0 && !find_solve(find, &last, &trial)) return false;
        if (i > 0 && !find_take_zero(find, i > 1 ? &before : NULL, &last, &trial)) return false;
        before = last;
        last = trial;
    }
    return find_take_zero(find, &before, &last, NULL) && find_solve_end(find, &last, &before);
}

static bool search(struct fbd_find *find, const char *question)
{
    if (!find_read_question(find, question) || !find_complete_question(find)) return false;
    find->scan = find->plan->runs ? find->plan->runs : usual_scan;
    return find_prepare_trials(find) && scan(find);
}

/* ---- public functions */

static bool is_asked(fbd_find_plan *plan, fbd_options *run, const char *text, const char *question,
                     const fbd_find_plan *given, fbd_errors *errors)
{
    *plan = (fbd_find_plan){0};
    *run = (fbd_options)FBD_OPTIONS_DEFAULT;
    if (!api_take_options(plan, sizeof *plan, given, errors) ||
        !api_take_options(run, sizeof *run, plan->run, errors))
        return false;
    plan->run = run;
    if (!text || !question)
        api_refuse(errors, text ? "there is no question" : "there is no text");
    else if (!api_has_settings(plan->settings, plan->setting_count))
        api_refuse(errors, "a text of the plan is missing");
    else if (plan->runs != 0 && (plan->runs < least_scan || plan->runs > most_scan))
        api_refuse(errors, "a scan has 3 to 1000000 runs");
    else
        return true;
    return false;
}

/* A search that has ended; NULL with a note if it could not be made. */
static struct fbd_find *find_make(const char *text, size_t length, const char *name, const char *question,
                                  const fbd_find_plan *plan, fbd_errors *errors)
{
    struct fbd_find *find = calloc(1, sizeof *find);
    bool made = find != NULL;
    if (made) {
        find->source = arena_text(&find->arena, text, length);
        find->name = name ? arena_text(&find->arena, name, strlen(name)) : NULL;
        find->source_length = length;
        find->plan = plan;
        find->errors = errors;
        made = find->source && search(find, question);
        find_free_trials(find);
        find->plan = NULL;
        find->errors = NULL;
    }
    if (made) return find;
    if (find && find->stopped)
        diag_add(errors, FBD_ERROR, "stopped", (struct pos){0, 0}, NULL, "the search was stopped");
    if (fbd_errors_failed_count(errors) == 0) diag_out_of_memory(errors);
    fbd_find_free(find);
    return NULL;
}

fbd_find *fbd_find_parse(const char *text, size_t length, const char *name, const char *question,
                         const fbd_find_plan *given, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_find_plan plan;
    fbd_options run;
    fbd_find *find = NULL;
    if (is_asked(&plan, &run, text, question, given, errors))
        find = find_make(text, length, name, question, &plan, errors);
    diag_end(&call);
    return find;
}

void fbd_find_free(fbd_find *find)
{
    if (!find) return;
    arena_free(&find->arena);
    free(find);
}

size_t fbd_find_solution_count(const fbd_find *find)
{
    return find ? find->solution_count : 0;
}

fbd_solution fbd_find_solution(const fbd_find *find, size_t index)
{
    if (find && index < find->solution_count) return find->solutions[index];
    return (fbd_solution){.value = NAN, .error = NAN};
}

fbd_found fbd_find_summary(const fbd_find *find)
{
    if (!find) return (fbd_found){.from = NAN, .to = NAN, .step = NAN};
    return (fbd_found){.parameter = find->parameter,
                       .unit = find->shown_unit,
                       .condition = find->condition,
                       .from = find->from,
                       .to = find->to,
                       .step = (find->to - find->from) / (double)(find->scan - 1),
                       .linear = find->linear && find_is_equation(find),
                       .scan = find->scan,
                       .runs = find->runs,
                       .failed = find->failed};
}

size_t fbd_find_gap_count(const fbd_find *find)
{
    return find ? find->gap_count : 0;
}

fbd_find_gap fbd_find_gap_get(const fbd_find *find, size_t index)
{
    if (find && index < find->gap_count) return find->gaps[index];
    return (fbd_find_gap){.value = NAN};
}
