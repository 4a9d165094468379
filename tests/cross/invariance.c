/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "invariance.h"

#include <stdio.h>
#include <string.h>

enum { most_kept = 64 };

static const double run_length = 1, taken_up = 0.4;

/* What the library says of a scene: its forces at one time, where bodies are then and at the end. */
struct answers {
    struct absolute at, end;                       /* positions and velocities alone */
    double q[3 * most_bodies], v[3 * most_bodies]; /* the library's own at `at` */
    size_t count[most_bodies];
    fbd_arrow arrow[most_bodies][most_kept];
    char name[most_bodies][most_kept][64];
    double change, size;
    bool ended;
};

static void take_place(struct absolute *absolute, const struct scene *scene, fbd_state *state)
{
    double q[3 * most_bodies], v[3 * most_bodies], t = 0;
    absolute_start(absolute, scene);
    fbd_state_get(state, "t", &t);
    for (int i = 0; i < scene->state_count; i++) state_value(state, i, &absolute->z[i]);
    if (library_state(scene, state, q, v)) absolute_place(absolute, t, q, v);
}

static void take_forces(struct answers *answers, const struct scene *scene, fbd_state *state)
{
    take_place(&answers->at, scene, state);
    library_state(scene, state, answers->q, answers->v);
    for (int b = 0; b < scene->body_count; b++) {
        answers->count[b] = fbd_diagram(state, (size_t)b, answers->arrow[b], most_kept);
        if (answers->count[b] > most_kept) answers->count[b] = most_kept;
        for (size_t i = 0; i < answers->count[b]; i++) {
            const fbd_arrow *arrow = &answers->arrow[b][i];
            snprintf(answers->name[b][i], sizeof answers->name[b][i], "%s", arrow->name);
            answers->size = fmax(answers->size, hypot(arrow->fx, arrow->fy) + fabs(arrow->moment));
        }
    }
}

/* Forces at the start, or where `at` is above zero at that time of the run; the end at `until`. */
static void ask(const struct scene *scene, double at, double until, struct answers *answers,
                struct outcome *outcome)
{
    fbd_simulation *simulation = NULL;
    memset(answers, 0, sizeof *answers);
    fbd_model *model = library_model(scene, until, outcome);
    if (!model) return;
    fbd_state *state = fbd_state_new(model);
    if (at == 0) take_forces(answers, scene, state);
    fbd_state_free(state);
    for (int part = at > 0 ? 0 : 1; part < 2; part++) {
        fbd_result *result = library_run(model, part == 0 ? at : until, &simulation, outcome);
        answers->ended = result && fbd_result_outcome(result) == FBD_DONE;
        answers->change = simulation ? library_change(simulation) : INFINITY;
        if (answers->ended && part == 0) take_forces(answers, scene, fbd_result_state(result));
        if (answers->ended && part == 1) take_place(&answers->end, scene, fbd_result_state(result));
        fbd_result_free(result);
        fbd_simulation_free(simulation);
        if (!answers->ended || isfinite(answers->change)) break;
    }
    fbd_model_free(model);
}

/* ---- comparing */

static struct vec2 seen(const struct view *view, struct vec2 p)
{
    double c = cos(view->angle), s = sin(view->angle), y = view->mirror * p.y;
    return (struct vec2){c * p.x - s * y, s * p.x + c * y};
}

/* All arrows of that name: force, and moment about G. */
static void sum_of(const struct answers *answers, int b, const char *name, double w[3])
{
    const double *x = &answers->at.x[3 * b];
    memset(w, 0, 3 * sizeof *w);
    for (size_t i = 0; i < answers->count[b]; i++) {
        const fbd_arrow *arrow = &answers->arrow[b][i];
        if (strcmp(answers->name[b][i], name) != 0) continue;
        w[0] += arrow->fx;
        w[1] += arrow->fy;
        w[2] += arrow->couple + (arrow->x - x[0]) * arrow->fy - (arrow->y - x[1]) * arrow->fx;
    }
}

static int body_called(const struct scene *scene, const char *name)
{
    for (int b = 0; b < scene->body_count; b++)
        if (strcmp(scene->body[b].name, name) == 0) return b;
    return -1;
}

/* Is it the same however redundant conditions share? Names of forces on a pulley begin with that of the rope.
 */
static bool is_unique(const struct absolute *absolute, int b, const char *name)
{
    for (int i = 0; absolute->redundant && i < absolute->wrench_count; i++) {
        const struct wrench *wrench = &absolute->wrench[i];
        size_t length = strlen(wrench->name);
        if (wrench->body != b || wrench->unique || strncmp(name, wrench->name, length) != 0) continue;
        if (name[length] == '\0' || name[length] == '.' || name[length] == '_') return false;
    }
    return true;
}

/* A rope that is slack would be taut, at another length. */
static bool is_slack(const struct absolute *absolute)
{
    for (int i = 0; i < absolute->grip_count; i++)
        if (absolute->grip[i].mode == lets_go) return true;
    return false;
}

/* What a force is called in the view: in a mirror the strands of a belt change places. */
static const char *name_there(const struct scene *scene, const char *name, const struct view *view,
                              char room[64])
{
    for (int c = 0; view->mirror < 0 && c < scene->coupling_count; c++) {
        const char *belt_name = scene->coupling[c].name;
        size_t length = strlen(belt_name);
        if (scene->coupling[c].kind != belt || strncmp(name, belt_name, length) != 0 || name[length] != '.')
            continue;
        snprintf(room, 64, "%s.%s", belt_name, strcmp(name + length, ".left") == 0 ? "right" : "left");
        return room;
    }
    return name;
}

static void compare_forces(const struct absolute *absolute, const struct scene *scene,
                           const struct answers *one, const struct scene *other_scene,
                           const struct answers *other, const struct view *view, double tolerance,
                           struct outcome *outcome)
{
    for (int b = 0; b < scene->body_count; b++) {
        int there = body_called(other_scene, scene->body[b].name);
        if (b == view->changed) continue;
        for (size_t i = 0; i < one->count[b]; i++) {
            const char *name = one->name[b][i];
            char room[64];
            double w[3], got[3];
            if (!is_unique(absolute, b, name)) continue;
            sum_of(one, b, name, w);
            sum_of(other, there, name_there(scene, name, view, room), got);
            struct vec2 f = seen(view, (struct vec2){w[0], w[1]});
            double want[3] = {view->force * f.x, view->force * f.y,
                              view->force * view->length * view->mirror * w[2]};
            for (int k = 0; k < 3; k++) {
                double error = fabs(want[k] - got[k]) / other->size;
                if (!(error <= tolerance))
                    outcome_fail(outcome, forces_differ,
                                 "%s.%s, part %d: %.15g there, but %.15g (largest %.3g)", scene->body[b].name,
                                 name, k, got[k], want[k], other->size);
                else
                    outcome->worst_force = fmax(outcome->worst_force, error);
            }
        }
    }
}

/* The origin of a body's frame, how far it has turned since, and their rates. */
static void motion_of(const struct answers *answers, int b, struct vec2 *p, struct vec2 *v, double *turned,
                      double *rate)
{
    struct absolute end = answers->end;
    absolute_seed(&end, seed_motion);
    struct place O = point_of(&end, b, (struct vec2){0, 0});
    *p = (struct vec2){O.x.u, O.y.u};
    *v = (struct vec2){O.x.u1, O.y.u1};
    *turned = answers->end.x[3 * b + 2] - answers->at.x[3 * b + 2];
    *rate = answers->end.v[3 * b + 2];
}

static double end_difference(const struct scene *scene, const struct answers *one,
                             const struct scene *other_scene, const struct answers *other,
                             const struct view *view)
{
    double most = 0, size = 1;
    for (int b = 0; b < scene->body_count; b++) {
        int there = body_called(other_scene, scene->body[b].name);
        struct vec2 p, v, other_p, other_v;
        double turned, rate, other_turned, other_rate, L = view->length;
        motion_of(one, b, &p, &v, &turned, &rate);
        motion_of(other, there, &other_p, &other_v, &other_turned, &other_rate);
        struct vec2 P = seen(view, p), V = seen(view, v);
        size = fmax(size, L * fmax(hypot(p.x, p.y), hypot(v.x, v.y)));
        size = fmax(size, fmax(fabs(turned), fabs(rate)));
        most = fmax(most, hypot(L * P.x + view->shift.x - other_p.x, L * P.y + view->shift.y - other_p.y));
        most = fmax(most, hypot(L * V.x - other_v.x, L * V.y - other_v.y));
        /* On a curve the direction is taken from where the body is, without whole turns. */
        most = fmax(most, fabs(remainder(view->mirror * turned - other_turned, 2 * acos(-1))));
        most = fmax(most, fabs(view->mirror * rate - other_rate));
    }
    for (int i = 0; i < scene->state_count; i++) {
        size = fmax(size, fabs(one->end.z[i]));
        most = fmax(most, fabs(one->end.z[i] - other->end.z[i]));
    }
    return most / size;
}

/* What the rounding of 1e6 m, some 1e-10 m, leaves of stiffnesses up to 20 N/m, and of that after a second.
 */
static double tolerance_of(enum variant variant, bool state)
{
    if (variant == variant_moved) return state ? 1e-6 : 1e-7;
    return state ? 1e-7 : variant == variant_later ? 1e-9 : 1e-10;
}

/* The scene taken up: where it is then is its start. By the library's own numbers: on the way through the places of the
 * bodies what stands still on a curve gets a speed of roundings, and would slip. */
static void start_there(struct scene *scene, const struct answers *one)
{
    int k = 0;
    for (int i = 0; i < scene->state_count; i++) scene->state[i].initial = one->at.z[i];
    for (int b = 0; b < scene->body_count; b++)
        for (int i = 0; i < coordinate_count(scene->body[b].motion); i++, k++) {
            scene->body[b].q[i] = one->q[k];
            scene->body[b].v[i] = one->v[k];
        }
}

/* Seen from there a rope may turn on the other side of its pulley: that is another scene. And one that is held on its
 * drum has speeds that cancel to rounding. */
static bool fits_there(const struct scene *scene)
{
    static struct absolute start;
    bool rubs = false;
    for (int c = 0; c < scene->coupling_count; c++)
        rubs |= scene->coupling[c].rubs || scene->coupling[c].kind == slot;
    absolute_start(&start, scene);
    return absolute_gap(&start, false) <= 1e-9 && (!rubs || absolute_settle(&start));
}

bool scene_compare_variant(const struct scene *scene, const struct absolute *absolute, enum variant variant,
                           struct outcome *outcome)
{
    static struct answers one, two;
    static struct scene other;
    struct random random = {scene->seed + 77};
    struct view view;
    bool later = variant == variant_later;
    memset(outcome, 0, sizeof *outcome);
    if (later && is_slack(absolute)) return false;
    if (!scene_vary(scene, variant, &random, taken_up, &other, &view)) return false;
    ask(scene, later ? taken_up : 0, run_length, &one, outcome);
    if (later && (!one.ended || isfinite(one.change))) return false;
    if (later) start_there(&other, &one);
    if (later && !fits_there(&other)) return false;
    ask(&other, 0, later ? run_length - taken_up : run_length, &two, outcome);
    if (outcome->verdict != agrees) return true;
    compare_forces(absolute, scene, &one, &other, &two, &view, tolerance_of(variant, false), outcome);
    if (!one.ended || !two.ended || isfinite(one.change) || isfinite(two.change)) return true;
    outcome->ran = true;
    outcome->until = run_length;
    double difference = end_difference(scene, &one, &other, &two, &view);
    if (difference <= tolerance_of(variant, true)) {
        outcome->worst_state = difference;
        return true;
    }
    struct absolute end = *absolute;
    outcome->sensitive =
        !absolute_integrate(&end, run_length, 1e-11) || scene_is_sensitive(absolute, &end, run_length);
    if (!outcome->sensitive)
        outcome_fail(outcome, states_differ, "ends differ by %.3g of their size", difference);
    return true;
}
