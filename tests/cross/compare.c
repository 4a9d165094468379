/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "compare.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "fbd.h"
#include "write.h"

/* Of the largest term: rounding by the condition of the scenes that are let in. States: what two integrations
 * at tolerances of 1e-12 leave after a second. */
static const double force_tolerance = 1e-10, state_tolerance = 1e-7;

const char *verdict_name(enum verdict verdict)
{
    static const char *const names[] = {
        "agrees",     "refused by the library", "forces differ",  "accelerations differ", "terms differ",
        "run failed", "states differ",          "statics differ", "linearizations differ"};
    return names[verdict];
}

void outcome_fail(struct outcome *outcome, enum verdict verdict, const char *format, ...)
{
    if (outcome->verdict != agrees) return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(outcome->what, sizeof outcome->what, format, arguments);
    va_end(arguments);
    outcome->verdict = verdict;
}

static bool differ(double theirs, double ours, double size, double tolerance, double *worst)
{
    double error = fabs(theirs - ours) / size;
    if (!(error <= tolerance)) return true;
    *worst = fmax(*worst, error);
    return false;
}

/* ---- forces: all arrows of a name together, as force and moment about G */

/* Forces of a rope on a pulley carry what is on the other side behind a dot, and a body that it visits twice
 * has two, numbered: here they are one, and so are the strands of a belt. */
static bool is_called(const struct scene *scene, const char *arrow, const char *name)
{
    if (strcmp(arrow, name) == 0) return true;
    for (int c = 0; c < scene->coupling_count; c++) {
        const struct coupling *coupling = &scene->coupling[c];
        size_t length = strlen(coupling->name);
        if ((coupling->kind == rope || coupling->kind == belt) && strcmp(name, coupling->name) == 0 &&
            strncmp(arrow, name, length) == 0 && (arrow[length] == '.' || arrow[length] == '_'))
            return true;
    }
    return false;
}

static void sum_arrows(const struct absolute *absolute, int b, const fbd_arrow *arrows, size_t count,
                       const char *name, double sum[3], bool *used)
{
    const double *x = &absolute->x[3 * b];
    memset(sum, 0, 3 * sizeof *sum);
    for (size_t i = 0; i < count; i++) {
        const fbd_arrow *arrow = &arrows[i];
        if (!is_called(absolute->scene, arrow->name, name)) continue;
        used[i] = true;
        sum[0] += arrow->fx;
        sum[1] += arrow->fy;
        sum[2] += arrow->couple + (arrow->x - x[0]) * arrow->fy - (arrow->y - x[1]) * arrow->fx;
    }
}

/* A body alone on its slide, or a particle, does not turn: moments, and what keeps them off, are no part of
 * its diagram. */
static bool is_alone(const struct scene *scene, int b)
{
    enum motion motion = scene->body[b].motion;
    bool alone = scene->body[b].on < 0 && (motion == slide || motion == particle);
    for (int i = 0; i < scene->body_count; i++) alone &= scene->body[i].on != b;
    for (int c = 0; c < scene->coupling_count; c++)
        for (int k = 0; k < scene->coupling[c].count; k++) alone &= scene->coupling[c].end[k].body != b;
    return alone;
}

void compare_arrows(const struct absolute *absolute, int b, const fbd_arrow *arrows, size_t count,
                    struct outcome *outcome)
{
    static const char *const parts[] = {"fx", "fy", "moment about G"};
    bool used[most_arrows] = {false};
    const char *body = absolute->scene->body[b].name;
    double size = absolute->force_size, sum[3];
    for (int i = 0; i < absolute->wrench_count; i++) {
        const struct wrench *ours = &absolute->wrench[i];
        if (ours->body != b) continue;
        sum_arrows(absolute, b, arrows, count, ours->name, sum, used);
        if (is_alone(absolute->scene, b)) sum[2] = ours->w[2];
        for (int k = 0; k < 3 && ours->unique; k++)
            if (differ(sum[k], ours->w[k], size, force_tolerance, &outcome->worst_force))
                outcome_fail(outcome, forces_differ,
                             "%s.%s, %s: library %.15g, independent %.15g (largest term %.3g)", body,
                             ours->name, parts[k], sum[k], ours->w[k], size);
    }
    for (size_t i = 0; i < count; i++)
        if (!used[i] &&
            !(hypot(arrows[i].fx, arrows[i].fy) + fabs(arrows[i].couple) <= force_tolerance * size))
            outcome_fail(outcome, forces_differ, "%s.%s: the independent assembly has no such force", body,
                         arrows[i].name);
}

/* ---- accelerations, by the equations */

/* The acceleration that an equation is about, or NAN. */
static double acceleration_of(const struct absolute *absolute, int b, const char *coordinate)
{
    const struct body *body = &absolute->scene->body[b];
    const double *a = &absolute->a[3 * b];
    struct place e = body->motion == track
                         ? tangent_of(absolute, b)
                         : direction_of(absolute, body->on, body->motion == slide ? body->along : 0);
    if (strcmp(coordinate, "G.x") == 0) return a[0];
    if (strcmp(coordinate, "G.y") == 0) return a[1];
    if (strcmp(coordinate, "G.angle") == 0 || strcmp(coordinate, "theta") == 0) return a[2];
    if (strcmp(coordinate, "x") == 0 || strcmp(coordinate, "s") == 0) return e.x.u * a[0] + e.y.u * a[1];
    if (strcmp(coordinate, "y") == 0) return e.x.u * a[1] - e.y.u * a[0];
    return NAN;
}

/* What brings the origin of a body's frame, whose coordinates a planar motion has, to its G: omega^2 |OG|, and the force
 * that goes with it. No row of a joint has it, and it may be the largest term by far: at 1e5 rad/s it is 5e9 m/s^2 beside
 * 1e5 of all others, and its own rounding, 5e9 * 2e-16, times the condition of the inertia matrix about O (some ten) and the
 * dozen of roundings on the way is 1e-10 of those. */
static double about_origin(const struct absolute *absolute, int b)
{
    double omega = absolute->v[3 * b + 2];
    return omega * omega * hypot(absolute->mass[b].G.x, absolute->mass[b].G.y);
}

static void compare_equations(const struct absolute *absolute, fbd_state *state, struct outcome *outcome)
{
    const struct scene *scene = absolute->scene;
    fbd_equations *equations = fbd_assemble_components(state);
    double size = absolute->acceleration_size, force_size = absolute->force_size;
    for (int b = 0; b < scene->body_count; b++) {
        double carried = scene->body[b].motion == planar ? about_origin(absolute, b) : 0;
        size = fmax(size, fmax(carried, absolute->force_size / absolute->mass[b].m));
        force_size = fmax(force_size, absolute->mass[b].m * carried);
    }
    for (size_t i = 0; i < fbd_equations_count(equations); i++) {
        const fbd_equation equation = fbd_equations_get(equations, i);
        int b = 0;
        while (strcmp(scene->body[b].name, equation.body) != 0) b++;
        double ours = acceleration_of(absolute, b, equation.coordinate);
        if (differ(equation.acceleration, ours, size, force_tolerance, &outcome->worst_acceleration))
            outcome_fail(outcome, accelerations_differ,
                         "%s.%s: library %.15g, independent %.15g (largest term %.3g)", equation.body,
                         equation.coordinate, equation.acceleration, ours, size);
        if (differ(equation.sum, equation.inertia * equation.acceleration, force_size, force_tolerance,
                   &outcome->worst_force))
            outcome_fail(outcome, terms_differ, "%s.%s: sum of terms %.15g, inertia times acceleration %.15g",
                         equation.body, equation.coordinate, equation.sum,
                         equation.inertia * equation.acceleration);
    }
    fbd_equations_free(equations);
}

static void compare_instant(const struct absolute *absolute, fbd_state *state, struct outcome *outcome)
{
    compare_equations(absolute, state, outcome);
    for (int b = 0; b < absolute->scene->body_count; b++) {
        fbd_arrow arrows[most_arrows];
        size_t count = fbd_diagram(state, (size_t)b, arrows, most_arrows);
        compare_arrows(absolute, b, arrows, count, outcome);
    }
}

/* ---- runs */

/* Coordinates and rates in the order of the independent assembly; false where the library has no such name.
 */
bool library_state(const struct scene *scene, const fbd_state *state, double *q, double *v)
{
    static const char *const names[] = {"x", "y", "theta"}, *const rates[] = {"vx", "vy", "omega"};
    int k = 0;
    for (int b = 0; b < scene->body_count; b++)
        for (int i = 0; i < coordinate_count(scene->body[b].motion); i++, k++) {
            enum motion motion = scene->body[b].motion;
            char name[40], rate[40];
            int index = motion == pivot ? 2 : i;
            bool along = motion == slide || motion == track;
            snprintf(name, sizeof name, "%s.%s", scene->body[b].name, motion == track ? "s" : names[index]);
            snprintf(rate, sizeof rate, "%s.%s", scene->body[b].name, along ? "v" : rates[index]);
            if (!fbd_state_get(state, name, &q[k]) || !fbd_state_get(state, rate, &v[k])) return false;
        }
    return true;
}

bool state_value(const fbd_state *state, int i, double *z)
{
    char name[24];
    snprintf(name, sizeof name, "states.z%d", i);
    return fbd_state_get(state, name, z);
}

/* The first event after which the modes of the start are no longer those of the run, or INFINITY. */
double library_change(fbd_simulation *simulation)
{
    for (size_t i = 0; i < fbd_simulation_event_count(simulation); i++) {
        fbd_event event = fbd_simulation_event(simulation, i);
        if (event.kind != FBD_EVENT_SWITCH && event.kind != FBD_EVENT_USER) return event.t;
    }
    return INFINITY;
}

static double motion_size(const double *q, const double *v, int count)
{
    double size = 1;
    for (int k = 0; k < count; k++) size = fmax(size, fmax(fabs(q[k]), fabs(v[k])));
    return size;
}

static double distance(const struct absolute *one, const struct absolute *other)
{
    double most = 0;
    for (int i = 0; i < one->n; i++)
        most = fmax(most, fabs(other->x[i] - one->x[i]) + fabs(other->v[i] - one->v[i]));
    return most;
}

/* What a difference of 1e-9 at the start becomes, and what the errors of the steps up to `end` have become:
 * of scenes where the one grows a thousandfold, or the other to 1e-8, nothing is asked. */
bool scene_is_sensitive(const struct absolute *start, const struct absolute *end, double until)
{
    struct absolute other = *start, closer = *start;
    for (int i = 0; i < other.n; i++) other.v[i] *= 1 + 1e-9 * (i % 2 ? 1 : -1);
    absolute_project(&other, false);
    if (!absolute_integrate(&other, until, 1e-11) || distance(&other, end) > 1e-6) return true;
    return !absolute_integrate(&closer, until, 1e-13) || distance(&closer, end) > 1e-8;
}

static void compare_coordinates(const struct absolute *absolute, const struct scene *scene,
                                const fbd_state *state, struct outcome *outcome)
{
    double q[3 * most_bodies], v[3 * most_bodies], our_q[3 * most_bodies], our_v[3 * most_bodies];
    int k = 0;
    if (!library_state(scene, state, q, v)) return;
    absolute_coordinates(absolute, our_q, our_v);
    for (int b = 0; b < scene->body_count; b++) k += coordinate_count(scene->body[b].motion);
    double size = motion_size(our_q, our_v, k), none = 0;
    for (int i = 0; i < scene->state_count; i++) {
        double z = NAN, most = fmax(1, fabs(absolute->z[i]));
        if (!state_value(state, i, &z) || differ(z, absolute->z[i], most, state_tolerance, &none))
            outcome_fail(outcome, states_differ, "states.z%d at t = %g: library %.15g; independent %.15g", i,
                         outcome->until, z, absolute->z[i]);
    }
    for (int i = 0; i < k; i++) {
        if (!differ(q[i], our_q[i], size, state_tolerance, &none) &&
            !differ(v[i], our_v[i], size, state_tolerance, &none))
            continue;
        outcome_fail(outcome, states_differ,
                     "coordinate %d at t = %g: library %.15g, rate %.15g; independent %.15g, rate %.15g", i,
                     outcome->until, q[i], v[i], our_q[i], our_v[i]);
        return;
    }
    outcome->worst_state = fmax(outcome->worst_state, none);
}

/* Forces in pulses that are much shorter than its steps are gone over by an error control that never meets them
 * (docs/reliability.md): is the difference gone where the library takes ten thousand steps? */
static bool goes_over_pulses(const struct absolute *absolute, const struct scene *scene,
                             const fbd_model *model, double until)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = until;
    options.step = until / 10000;
    const fbd_recording recording = {.motion_only = true};
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    fbd_result *result = simulation ? fbd_simulation_run(simulation, &recording) : NULL;
    struct outcome again = {.verdict = agrees};
    if (result) compare_coordinates(absolute, scene, fbd_result_state(result), &again);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    return result && again.verdict == agrees;
}

static void compare_ends(const struct absolute *start, const struct absolute *absolute,
                         const struct scene *scene, const fbd_model *model, const fbd_state *state,
                         struct outcome *outcome)
{
    struct outcome ends = {.verdict = agrees, .until = outcome->until};
    compare_coordinates(absolute, scene, state, &ends);
    outcome->worst_state = fmax(outcome->worst_state, ends.worst_state);
    if (ends.verdict == agrees) return;
    outcome->sensitive = scene_is_sensitive(start, absolute, outcome->until);
    outcome->pulsed = !outcome->sensitive && goes_over_pulses(absolute, scene, model, outcome->until);
    if (!outcome->sensitive && !outcome->pulsed) outcome_fail(outcome, ends.verdict, "%s", ends.what);
}

/* Once more at the end of the run, from the library's own state: other angles, closed loops. */
static void compare_last_instant(const struct absolute *absolute, const struct scene *scene, fbd_state *state,
                                 struct outcome *outcome)
{
    struct absolute last = *absolute;
    double q[3 * most_bodies], v[3 * most_bodies];
    if (!library_state(scene, state, q, v)) return;
    for (int i = 0; i < scene->state_count; i++) state_value(state, i, &last.z[i]);
    absolute_place(&last, outcome->until, q, v);
    absolute_solve(&last, true);
    bool good = last.consistent && last.accelerations_unique && last.condition < 1e4;
    if (good && absolute_excess(&last) < -1e-6) compare_instant(&last, state, outcome);
}

/* A scene of a second takes some hundred steps. */
static int is_too_long(void *context, const fbd_progress *progress)
{
    const clock_t *since = context;
    return progress->steps > 20000 || clock() - *since > 3 * CLOCKS_PER_SEC;
}

fbd_result *library_run(const fbd_model *model, double until, fbd_simulation **simulation,
                        struct outcome *outcome)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = until;
    options.tolerance = 1e-12;
    *simulation = fbd_simulation_new(model, &options, NULL);
    if (!*simulation) {
        outcome_fail(outcome, run_failed, "no simulation");
        return NULL;
    }
    clock_t since = clock();
    const fbd_recording recording = {.motion_only = true,
                                     .progress = is_too_long,
                                     .progress_context = &since};
    fbd_result *result = fbd_simulation_run(*simulation, &recording);
    if (!result) outcome_fail(outcome, run_failed, "no result");
    /* Known: on some tracks the search for events takes for ever; counted with those that are not compared. */
    if (result && clock() - since > 3 * CLOCKS_PER_SEC) outcome->sensitive = true;
    return result;
}

/* A motion that a potential without a bottom drives to a thousand radians within a second. */
static bool runs_away(const struct absolute *absolute)
{
    for (int i = 0; i < absolute->n; i++)
        if (fabs(absolute->x[i]) > 1e3 || fabs(absolute->v[i]) > 1e4) return true;
    return false;
}

/* Where nothing pushes a guide to either side there is no motion to compare: the library has to have said so, and nobody else
 * may. True when that is settled. */
static bool compare_jams(const struct absolute *absolute, fbd_outcome end, struct outcome *outcome)
{
    const double rounding = 1e-9;
    if (isinf(absolute->unpushed_to)) return false;
    if (outcome->until >= absolute->unpushed_to && (end == FBD_DONE || end == FBD_BROKEN))
        outcome_fail(outcome, run_failed,
                     "it goes on at t = %.9g, where no normal force goes with its friction",
                     absolute->unpushed_to);
    bool there = outcome->until >= absolute->unpushed_from - rounding;
    outcome->jammed = there && end == FBD_FAILED;
    return outcome->jammed;
}

static void compare_run(const struct scene *scene, const struct absolute *start, const fbd_model *model,
                        double until, struct outcome *outcome)
{
    fbd_simulation *simulation = NULL;
    struct absolute ahead = *start;
    /* Towards a singular position there is nothing to compare, and much to search for events. */
    if (!absolute_integrate(&ahead, until, 1e-6)) return;
    fbd_result *result = library_run(model, until, &simulation, outcome);
    double change = result ? library_change(simulation) : INFINITY;
    if (result && isfinite(change)) {
        outcome->broke_off = true;
        until = change * (1 - 1e-9); /* an impact changes velocities */
        fbd_result_free(result);
        fbd_simulation_free(simulation);
        result = NULL;
        if (until < 0.01) return;
        result = library_run(model, until, &simulation, outcome);
    }
    /* Contact may be lost a little before that. */
    if (result) fbd_state_get(fbd_result_state(result), "t", &until);
    outcome->until = until;
    if (result) {
        struct absolute absolute = *start;
        fbd_outcome end = fbd_result_outcome(result);
        outcome->ran = absolute_integrate(&absolute, until, 1e-11);
        if (compare_jams(&ahead, end, outcome)) outcome->ran = false;
        bool given_up = end == FBD_INTERRUPTED && outcome->sensitive;
        if (outcome->ran && end != FBD_DONE && end != FBD_BROKEN && (given_up || runs_away(&absolute)))
            outcome->sensitive = true;
        else if (outcome->ran && end != FBD_DONE && end != FBD_BROKEN)
            outcome_fail(outcome, run_failed, "%s",
                         end == FBD_INTERRUPTED ? "takes more than 20000 steps"
                                                : fbd_simulation_reason(simulation));
        else if (outcome->ran)
            compare_ends(start, &absolute, scene, model, fbd_result_state(result), outcome);
        if (outcome->ran && !outcome->broke_off)
            compare_last_instant(&absolute, scene, fbd_result_state(result), outcome);
    }
    fbd_result_free(result);
    fbd_simulation_free(simulation);
}

/* ---- the whole */

fbd_model *library_model(const struct scene *scene, double until, struct outcome *outcome)
{
    static _Thread_local char text[text_room];
    size_t length = scene_write(scene, until > 0 ? until : 1, text);
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, length, "scene.yaml", NULL, 0, errors);
    for (size_t i = 0; !model && i < fbd_errors_count(errors); i++) {
        const fbd_error error = fbd_errors_get(errors, i);
        if (error.severity == FBD_ERROR)
            outcome_fail(outcome, refused, "%d:%d: %s [%s]", error.line, error.column, error.message,
                         error.id);
    }
    fbd_errors_free(errors);
    return model;
}

void scene_compare(const struct scene *scene, struct absolute *absolute, double until,
                   struct outcome *outcome)
{
    memset(outcome, 0, sizeof *outcome);
    fbd_model *model = library_model(scene, until, outcome);
    if (!model) {
        outcome_fail(outcome, refused, "no model");
        return;
    }
    fbd_state *state = fbd_state_new(model);
    compare_instant(absolute, state, outcome);
    fbd_state_free(state);
    if (outcome->verdict == agrees && until > 0) compare_run(scene, absolute, model, until, outcome);
    fbd_model_free(model);
}
