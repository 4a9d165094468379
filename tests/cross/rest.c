/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest.h"
#include "fbd_study.h"

#include <stdio.h>
#include <string.h>

/* ---- at rest */

static bool stays(const struct scene *scene)
{
    for (int b = 0; b < scene->body_count; b++) {
        const struct body *body = &scene->body[b];
        if (body->driven || body->mass_varies) return false;
        for (int i = 0; i < body->load_count; i++)
            if (body->load[i].surface.count > 0) return false;
    }
    for (int c = 0; c < scene->coupling_count; c++)
        if (scene->coupling[c].reels) return false;
    return true;
}

/* With all that can hold holding. */
static bool solve_at_rest(const struct scene *scene, struct absolute *absolute)
{
    absolute_start(absolute, scene);
    for (int i = 0; i < absolute->grip_count; i++) absolute->grip[i].mode = holds;
    absolute_solve(absolute, true);
    if (absolute_turn_guides(absolute)) absolute_solve(absolute, true);
    return absolute->consistent && absolute->accelerations_unique && absolute->condition < 1e4;
}

static struct load *add_applied(struct body *body, int number)
{
    struct load *load = &body->load[body->load_count++];
    *load = (struct load){.kind = applied, .form = components, .at = {.point = at_G}};
    snprintf(load->name, sizeof load->name, "x%d", number);
    return load;
}

static void set_components(struct load *load, double x, double y)
{
    load->value = constant_formula(dim_force, x);
    load->second = constant_formula(dim_force, y);
}

/* -m a at G, and -I alpha as two forces at a distance of 2. */
static bool take_up(struct scene *scene, const struct absolute *absolute, int b)
{
    struct body *body = &scene->body[b];
    const struct mass *mass = &absolute->mass[b];
    const double *a = &absolute->a[3 * b], couple = -mass->I_G * a[2], angle = absolute->x[3 * b + 2];
    if (body->load_count + 3 > most_loads) return false;
    set_components(add_applied(body, 0), -mass->m * a[0], -mass->m * a[1]);
    for (int side = -1; side <= 1 && couple != 0; side += 2) {
        struct load *load = add_applied(body, side < 0 ? 1 : 2);
        load->at = (struct spot){at_pair, {mass->G.x, mass->G.y + side}};
        set_components(load, -side * couple / 2 * cos(angle), -side * couple / 2 * sin(angle));
    }
    return true;
}

bool scene_balance(const struct scene *scene, struct scene *balanced, struct absolute *absolute)
{
    if (!stays(scene)) return false;
    *balanced = *scene;
    for (int i = 0; i < balanced->state_count; i++) balanced->state[i].rate = constant_formula(dim_number, 0);
    for (int b = 0; b < balanced->body_count; b++) memset(balanced->body[b].v, 0, sizeof balanced->body[b].v);
    if (!solve_at_rest(balanced, absolute)) return false;
    for (int b = 0; b < balanced->body_count; b++)
        if (!take_up(balanced, absolute, b)) return false;
    return solve_at_rest(balanced, absolute) && absolute->acceleration_size < 1e-9;
}

static const char *last_word(fbd_errors *errors)
{
    size_t count = fbd_errors_count(errors);
    return count > 0 ? fbd_errors_get(errors, count - 1).message : "without a word";
}

/* ---- statics */

bool scene_compare_statics(const struct scene *balanced, struct absolute *absolute, struct outcome *outcome)
{
    const double clear = 1e-6;
    double excess = absolute_excess(absolute);
    memset(outcome, 0, sizeof *outcome);
    if (!(fabs(excess) >= clear) || absolute->force_size == 0 || (excess > 0 && absolute->redundant))
        return false;
    fbd_model *model = library_model(balanced, 0, outcome);
    if (!model) return true;
    fbd_state *state = fbd_state_new(model);
    fbd_errors *errors = fbd_errors_new();
    fbd_statics *statics = fbd_statics_new(state, errors);
    /* Of what does not hold the library may also say that no branches agree with the forces. */
    if (!statics && excess < 0)
        outcome_fail(outcome, statics_differ, "refused: %s (beyond the limits by %.3g of the largest force)",
                     last_word(errors), excess);
    else if (statics && fbd_statics_holds(statics) != (excess < 0))
        outcome_fail(outcome, statics_differ,
                     "library: %s; independent: beyond the limits by %.3g of the largest force",
                     excess < 0 ? "does not hold" : "holds", excess);
    for (int b = 0; statics && excess < 0 && b < balanced->body_count; b++) {
        fbd_arrow arrows[most_arrows];
        size_t count = fbd_statics_diagram(statics, (size_t)b, arrows, most_arrows);
        compare_arrows(absolute, b, arrows, count, outcome);
    }
    fbd_statics_free(statics);
    fbd_errors_free(errors);
    fbd_state_free(state);
    fbd_model_free(model);
    return true;
}

/* ---- free to move */

static void forget_time(struct formula *formula)
{
    for (int k = 0; k < formula->count; k++) {
        struct summand *summand = &formula->summand[k];
        int kept = 0;
        for (int i = 0; i < summand->count; i++)
            if (summand->variable[i].kind != var_time) summand->variable[kept++] = summand->variable[i];
        summand->count = kept;
    }
}

static bool lets_move(const struct load *load)
{
    return load->kind != normal && load->kind != friction && load->kind != moment_friction &&
           load->kind != thrust;
}

/* Air at rest: quadratic drag has no slope there, to the first order alone. */
static void loosen_body(struct body *body)
{
    int kept = 0;
    body->driven = body->mass_varies = false;
    for (int i = 0; i < body->load_count; i++) {
        struct load *load = &body->load[i];
        if (!lets_move(load)) continue;
        forget_time(&load->value);
        forget_time(&load->second);
        for (int k = 0; k < 2; k++) {
            forget_time(&load->offset[k]);
            forget_time(&load->wind[k]);
        }
        if (!load->windy) load->quadratic = 0;
        body->load[kept++] = *load;
    }
    body->load_count = kept;
}

bool scene_balance_freely(const struct scene *scene, struct scene *balanced, struct absolute *absolute)
{
    static struct scene loose;
    int kept = 0;
    if (scene->state_count > 0) return false;
    loose = *scene;
    for (int b = 0; b < loose.body_count; b++) loosen_body(&loose.body[b]);
    for (int c = 0; c < loose.coupling_count; c++)
        if (loose.coupling[c].kind == spring_of_two || loose.coupling[c].kind == damper_of_two)
            loose.coupling[kept++] = loose.coupling[c];
    loose.coupling_count = kept;
    return scene_balance(&loose, balanced, absolute);
}

/* ---- linearisation: slopes of the accelerations by differences of the sixth order */

enum { most_joint = 3 * most_bodies };

static int joint_count(const struct scene *scene)
{
    int n = 0;
    for (int b = 0; b < scene->body_count; b++) n += coordinate_count(scene->body[b].motion);
    return n;
}

static void joint_accelerations(struct absolute *absolute, const double *q, const double *v, double *a)
{
    const struct scene *scene = absolute->scene;
    absolute_place(absolute, 0, q, v);
    absolute_solve(absolute, false);
    absolute_seed(absolute, seed_path);
    for (int b = 0; b < scene->body_count; b++)
        for (int i = 0; i < coordinate_count(scene->body[b].motion); i++)
            *a++ = coordinate_of(absolute, b, i).u2;
}

/* d a / d x[j], x = (q, v). */
static void slope(struct absolute *absolute, const double *x, int n, int j, double h, double *out)
{
    static const double weights[] = {45.0 / 60, -9.0 / 60, 1.0 / 60};
    double there[2 * most_joint], a[most_joint];
    memset(out, 0, (size_t)n * sizeof *out);
    for (int k = 1; k <= 3; k++)
        for (int side = -1; side <= 1; side += 2) {
            memcpy(there, x, 2 * (size_t)n * sizeof *x);
            there[j] += side * k * h;
            joint_accelerations(absolute, there, there + n, a);
            for (int i = 0; i < n; i++) out[i] += side * weights[k - 1] * a[i] / h;
        }
}

struct slopes {
    double a[most_joint][2 * most_joint], size;
};

/* False where two distances differ: a kink is near, or a function is too steep for them. */
static bool find_slopes(const struct scene *scene, struct absolute *absolute, int n, struct slopes *slopes)
{
    const double near = 0.01, known = 1e-8;
    double x[2 * most_joint] = {0}, far[most_joint], close[most_joint], error = 0;
    int k = 0;
    for (int b = 0; b < scene->body_count; b++)
        for (int i = 0; i < coordinate_count(scene->body[b].motion); i++) x[k++] = scene->body[b].q[i];
    slopes->size = 1;
    for (int j = 0; j < 2 * n; j++) {
        slope(absolute, x, n, j, near, far);
        slope(absolute, x, n, j, near / 2, close);
        for (int i = 0; i < n; i++) {
            slopes->a[i][j] = close[i];
            slopes->size = fmax(slopes->size, fabs(close[i]));
            error = fmax(error, fabs(close[i] - far[i]));
        }
    }
    return error <= known * slopes->size;
}

/* Number of the coordinate called so in the order of the scene. */
static int number_of(const struct scene *scene, const char *name)
{
    static const char *const names[] = {"x", "y", "theta"};
    int k = 0;
    for (int b = 0; b < scene->body_count; b++)
        for (int i = 0; i < coordinate_count(scene->body[b].motion); i++, k++) {
            enum motion motion = scene->body[b].motion;
            char ours[40];
            snprintf(ours, sizeof ours, "%s.%s", scene->body[b].name,
                     motion == track ? "s" : names[motion == pivot ? 2 : i]);
            if (strcmp(ours, name) == 0) return k;
        }
    return -1;
}

static void compare_matrix(const struct scene *scene, const fbd_model *model, const fbd_linearization *linear,
                           const struct slopes *slopes, int n, struct outcome *outcome)
{
    const double tolerance = 1e-7; /* what the differences leave, ten times */
    const double *A = fbd_linearization_matrix(linear);
    int order[most_joint];
    if (fbd_linearization_size(linear) != 2 * (size_t)n) {
        outcome_fail(outcome, linearizations_differ, "%zu rows, of %d", fbd_linearization_size(linear),
                     2 * n);
        return;
    }
    for (int i = 0; i < n; i++) {
        size_t coordinate = fbd_linearization_coordinate(linear, (size_t)i);
        order[i] = number_of(scene, fbd_model_coordinate(model, coordinate).name);
    }
    for (int i = 0; i < 2 * n; i++)
        for (int j = 0; j < 2 * n; j++) {
            double got = A[2 * n * i + j], want = j == n + i;
            if (i >= n) want = slopes->a[order[i - n]][j < n ? order[j] : n + order[j - n]];
            double error = fabs(got - want) / slopes->size;
            if (!(error <= tolerance))
                outcome_fail(outcome, linearizations_differ,
                             "A[%d][%d]: library %.12g, independent %.12g (largest %.3g)", i, j, got, want,
                             slopes->size);
            else
                outcome->worst_state = fmax(outcome->worst_state, error);
        }
}

bool scene_compare_linear(const struct scene *balanced, struct absolute *absolute, struct outcome *outcome)
{
    static struct slopes slopes;
    int n = joint_count(balanced);
    memset(outcome, 0, sizeof *outcome);
    if (n == 0 || !find_slopes(balanced, absolute, n, &slopes)) return false;
    fbd_model *model = library_model(balanced, 0, outcome);
    if (!model) return true;
    fbd_state *state = fbd_state_new(model);
    fbd_errors *errors = fbd_errors_new();
    fbd_linearization *linear = fbd_linearize(state, errors);
    if (linear)
        compare_matrix(balanced, model, linear, &slopes, n, outcome);
    else
        outcome_fail(outcome, linearizations_differ, "refused: %s", last_word(errors));
    fbd_linearization_free(linear);
    fbd_errors_free(errors);
    fbd_state_free(state);
    fbd_model_free(model);
    return true;
}
