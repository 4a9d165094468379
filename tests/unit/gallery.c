/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"
#include "notes.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "limits_kept.h"
#include "thorough.h"

/* ---- checks */

bool check_close(struct checks *checks, const char *what, double got, double want, double tolerance)
{
    double error = fabs(got - want);
    if (error <= tolerance) return true;
    fprintf(stderr, "# %s: got %.17g, want %.17g, off by %.3g, %.3g times the tolerance %.3g\n", what, got,
            want, error, error / tolerance, tolerance);
    checks->failed++;
    return false;
}

bool check_that(struct checks *checks, const char *what, bool fact)
{
    if (fact) return true;
    fprintf(stderr, "# not so: %s\n", what);
    checks->failed++;
    return false;
}

static int find_reference(const char *name)
{
    int index = reference_find(name);
    if (index < 0) fail_msg("there is no reference number %s", name);
    return index;
}

bool check_reference(struct checks *checks, const char *name, double got)
{
    const struct reference *want = &references[find_reference(name)];
    return check_reference_within(checks, name, got,
                                  fmax(want->relative * fabs(want->value), want->absolute));
}

bool check_reference_within(struct checks *checks, const char *name, double got, double tolerance)
{
    int index = find_reference(name);
    checks->held[index] = true;
    return check_close(checks, name, got, references[index].value, tolerance);
}

void check_covered(struct checks *checks, const char *prefix)
{
    for (int i = 0; i < reference_count; i++) {
        if (strncmp(references[i].name, prefix, strlen(prefix)) != 0 || checks->held[i]) continue;
        fprintf(stderr, "# %s was not looked at\n", references[i].name);
        checks->failed++;
    }
}

void checks_end(const struct checks *checks)
{
    if (checks->failed > 0) fail_msg("%zu checks failed", checks->failed);
}

int checks_begin(void **state)
{
    *state = calloc(1, sizeof(struct checks));
    return *state ? 0 : -1;
}

struct checks *checks_of(void **state)
{
    struct checks *checks = *state;
    checks->failed = 0;
    return checks;
}

int checks_free(void **state)
{
    free(*state);
    return 0;
}

/* ---- models */

enum { most_path = 512 };

static int is_topic(const struct dirent *entry)
{
    return entry->d_name[0] != '.' && !strchr(entry->d_name, '.') && strcmp(entry->d_name, "hard") != 0;
}

static int is_model(const struct dirent *entry)
{
    const char *dot = strrchr(entry->d_name, '.');
    return dot && strcmp(dot, ".yaml") == 0;
}

/* The names in models/`topic` that `wanted` picks; their number. */
static int names_in(const char *topic, int (*wanted)(const struct dirent *entry), struct dirent ***names)
{
    char path[most_path];
    const char *root = getenv("FBD_SOURCE_ROOT");
    snprintf(path, sizeof path, "%s/models/%s", root ? root : ".", topic);
    int count = scandir(path, names, wanted, alphasort);
    if (count < 0) fail_msg("cannot list %s", path);
    return count;
}

static size_t go_through(struct checks *checks, bool all, size_t turn, model_test *test)
{
    struct dirent **topics, **models;
    size_t total = 0;
    int topic_count = names_in("", is_topic, &topics);
    for (int i = 0; i < topic_count; i++) {
        int count = names_in(topics[i]->d_name, is_model, &models);
        for (int k = 0; k < count; k++) {
            char path[2 * most_path];
            snprintf(path, sizeof path, "%s/%s", topics[i]->d_name, models[k]->d_name);
            if (all || is_in_turn(total + (size_t)k, turn)) test(checks, path);
            free(models[k]);
        }
        free(models);
        free(topics[i]);
        total += (size_t)count;
    }
    free(topics);
    return total;
}

size_t each_model(struct checks *checks, model_test *test)
{
    return go_through(checks, true, 0, test);
}

size_t each_model_in_turn(struct checks *checks, size_t turn, model_test *test)
{
    return go_through(checks, false, turn, test);
}

/* ---- opening */

static struct trial opened(fbd_model *model, fbd_errors *errors, const char *name)
{
    const size_t notes = count_other_notes(errors);
    if (notes > 0) fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    if (!model || notes > 0) fail_msg("%s does not open without notes", name);
    struct trial trial = {.model = model, .state = fbd_state_new(model)};
    assert_non_null(trial.state);
    return trial;
}

struct trial trial_open(const char *path, const char *const *settings)
{
    enum { most_settings = 8, most_text = 64 };
    char names[most_settings][most_text], file[4096];
    fbd_setting pairs[most_settings];
    size_t count = 0;
    for (; settings && settings[count]; count++) {
        const char *equals = strchr(settings[count], '=');
        assert_true(count < most_settings && equals && equals - settings[count] < most_text);
        snprintf(names[count], most_text, "%.*s", (int)(equals - settings[count]), settings[count]);
        pairs[count] = (fbd_setting){names[count], equals + 1};
    }
    const char *root = getenv("FBD_SOURCE_ROOT");
    snprintf(file, sizeof file, "%s/models/%s", root ? root : ".", path);
    fbd_errors *errors = fbd_errors_new();
    assert_non_null(errors);
    return opened(fbd_model_read(file, pairs, count, errors), errors, path);
}

struct trial trial_parse(const char *text)
{
    fbd_errors *errors = fbd_errors_new();
    assert_non_null(errors);
    return opened(fbd_model_parse(text, strlen(text), "test", NULL, 0, errors), errors, "the text");
}

void trial_close(struct trial *trial)
{
    fbd_result_free(trial->result);
    fbd_simulation_free(trial->simulation);
    fbd_state_free(trial->state);
    fbd_model_free(trial->model);
    *trial = (struct trial){0};
}

/* ---- states */

enum { most_name = 128 };

/* "v" as "block.v"; names with a dot, and t, as they are. */
static const char *qualified(const struct trial *trial, const char *name, char buffer[static most_name])
{
    if (strcmp(name, "t") == 0 || strchr(name, '.')) return name;
    snprintf(buffer, most_name, "%s.%s", fbd_model_body_name(trial->model, 0), name);
    return buffer;
}

void trial_set(struct trial *trial, const char *name, double value)
{
    char buffer[most_name];
    if (!fbd_state_set(trial->state, qualified(trial, name, buffer), value))
        fail_msg("`%s` cannot be set to %g", name, value);
}

double trial_get(const struct trial *trial, const char *name)
{
    char buffer[most_name];
    double value = NAN;
    if (!fbd_state_get(trial->state, qualified(trial, name, buffer), &value)) fail_msg("no `%s`", name);
    return value;
}

/* ---- assembled equations */

static fbd_equation find_equation(const struct trial *trial, const fbd_equations *all, const char *coordinate)
{
    char buffer[most_name];
    const fbd_equation equation = fbd_equations_find(all, qualified(trial, coordinate, buffer));
    if (!equation.body) fail_msg("there is no equation of %s", coordinate);
    return equation;
}

static fbd_equations *assemble(struct trial *trial)
{
    fbd_equations *all = fbd_assemble_components(trial->state);
    assert_non_null(all);
    return all;
}

double trial_acceleration(struct trial *trial, const char *coordinate)
{
    fbd_equations *all = assemble(trial);
    double value = find_equation(trial, all, coordinate).acceleration;
    fbd_equations_free(all);
    return value;
}

double trial_term(struct trial *trial, const char *coordinate, const char *term)
{
    fbd_equations *all = assemble(trial);
    const fbd_equation equation = find_equation(trial, all, coordinate);
    double value = fbd_equation_term(&equation, term);
    fbd_equations_free(all);
    return value;
}

double trial_normal(struct trial *trial, const char *coordinate)
{
    fbd_equations *all = assemble(trial);
    double value = find_equation(trial, all, coordinate).normal;
    fbd_equations_free(all);
    return value;
}

fbd_arrow trial_arrow(struct trial *trial, const char *name)
{
    enum { most_arrows = 16 };
    fbd_arrow arrows[most_arrows];
    size_t count = fbd_diagram(trial->state, 0, arrows, most_arrows);
    for (size_t i = 0; i < count && i < most_arrows; i++)
        if (strcmp(arrows[i].name, name) == 0) return arrows[i];
    fail_msg("there is no arrow `%s`", name);
    return arrows[0];
}

void check_equation(struct checks *checks, struct trial *trial, const fbd_expected *want)
{
    char buffer[most_name];
    fbd_expected here = *want;
    here.coordinate = qualified(trial, want->coordinate, buffer);
    here.tolerance = 1e-14; /* a few products, each rounded: 2^-53 times their number */
    if (!fbd_check_equation(trial->state, &here)) checks->failed++;
}

/* ---- runs */

void trial_start(struct trial *trial, const fbd_options *options)
{
    const fbd_options defaults = FBD_OPTIONS_DEFAULT;
    fbd_errors *errors = fbd_errors_new();
    fbd_simulation_free(trial->simulation); /* of a start before */
    trial->simulation = fbd_simulation_new(trial->model, options ? options : &defaults, errors);
    if (!trial->simulation) fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    assert_non_null(trial->simulation);
    trial->outcome = FBD_GOING;
    if (!fbd_simulation_state(trial->simulation, 0, trial->state)) fail_msg("no state at the start");
}

static void advance(struct trial *trial)
{
    trial->outcome = fbd_simulation_advance(trial->simulation);
    if (trial->outcome == FBD_FAILED || trial->outcome == FBD_OUT_OF_MEMORY)
        fail_msg("the run failed: %s", fbd_simulation_reason(trial->simulation));
}

void trial_to(struct trial *trial, double t)
{
    double from, to;
    fbd_simulation_interval(trial->simulation, &from, &to);
    while (to < t && trial->outcome == FBD_GOING) {
        advance(trial);
        fbd_simulation_interval(trial->simulation, &from, &to);
    }
    if (!fbd_simulation_state(trial->simulation, t, trial->state))
        fail_msg("no state at %g: the last step goes from %g to %g", t, from, to);
}

void trial_finish(struct trial *trial)
{
    double from, to;
    while (trial->outcome == FBD_GOING) advance(trial);
    fbd_simulation_interval(trial->simulation, &from, &to);
    assert_true(fbd_simulation_state(trial->simulation, to, trial->state));
}

void trial_run(struct trial *trial, const fbd_options *options)
{
    trial_record(trial, options, NULL);
}

void trial_record(struct trial *trial, const fbd_options *options, const fbd_recording *recording)
{
    trial_start(trial, options);
    trial->result = fbd_simulation_run(trial->simulation, recording);
    assert_non_null(trial->result);
    trial->outcome = fbd_result_outcome(trial->result);
    double from, to;
    fbd_simulation_interval(trial->simulation, &from, &to);
    fbd_simulation_state(trial->simulation, to, trial->state);
    const char *beyond = trial->outcome == FBD_DONE ? beyond_limits(trial->state) : NULL;
    if (beyond) fail_msg("the run ends beyond a limit: %s", beyond);
}

double trial_event(const struct trial *trial, fbd_event_kind kind, const char *name, int index)
{
    for (size_t i = 0; i < fbd_simulation_event_count(trial->simulation); i++) {
        fbd_event event = fbd_simulation_event(trial->simulation, i);
        if (event.kind != kind || (name && strcmp(event.name, name) != 0)) continue;
        if (index-- == 0) return event.t;
    }
    return NAN;
}

double trial_to_event(struct trial *trial, fbd_event_kind kind, const char *name, int index)
{
    double t = trial_event(trial, kind, name, index);
    while (isnan(t) && trial->outcome == FBD_GOING) {
        advance(trial);
        t = trial_event(trial, kind, name, index);
    }
    if (!isnan(t)) trial_to(trial, t);
    return t;
}

void hold_value(struct checks *checks, struct trial *trial, const char *reference, const char *name)
{
    trial_to(trial, references[find_reference(reference)].t);
    check_reference(checks, reference, trial_get(trial, name));
}

void hold_term(struct checks *checks, struct trial *trial, const char *reference, const char *coordinate,
               const char *term)
{
    trial_to(trial, references[find_reference(reference)].t);
    check_reference(checks, reference, trial_term(trial, coordinate, term));
}
