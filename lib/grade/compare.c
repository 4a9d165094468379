/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The forces and moments of an answer at states of the key.
 */
#include <gsl/gsl_rng.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/diagram.h"
#include "dynamics/kinematics.h"
#include "fbd_grade.h"
#include "grade/compare.h"
#include "grade/reactions.h"
#include "grade/verdict.h"
#include "output/random_state.h"

/* A body of the key and the body of that name in the answer. */
struct twin {
    int other;     /* -1: there is none, or it moves in another way */
    double sign;   /* -1: its coordinate has the opposite sense */
    double offset; /* of its coordinate, of a slide or pivot, in the answer's units */
    int slip;      /* of the key's friction at the start */
    struct sides sides;
};

struct comparison {
    struct fbd_grade *grade;
    const fbd_model *key, *answer;
    fbd_state *fresh, *key_state, *state;
    struct twin *twins; /* of each body of the key */
    struct arrow *arrows;
    gsl_rng *rng;
    struct random_path path; /* from the start */
    double length, force;    /* units of the answer in those of the key */
    bool possible, starts; /* state of the key: it is admissible; it is the start, perhaps at another time */
};

/* ---- states */

static int coordinate_of(const fbd_model *model, const char *name)
{
    for (int i = 0; i < model->plan.n; i++)
        if (strcmp(model->labels[i].name, name) == 0) return i;
    return -1;
}

/* Copy the user states by name; `scale` of a unit follows from its dimension. */
static void follow_states(const struct comparison *comparison)
{
    const fbd_model *key = comparison->key, *answer = comparison->answer;
    for (int i = 0; i < key->plan.own; i++) {
        int to = model_find_component(answer, key->own_labels[i].name, false);
        struct dim dim = key->scene->own[i].dim;
        double mass = comparison->force / comparison->length;
        if (to < 0) continue;
        comparison->state->y[to] = comparison->key_state->y[2 * key->plan.n + i] *
                                   pow(comparison->length, -(double)dim.length / dim_unit) *
                                   pow(mass, -(double)dim.mass / dim_unit);
    }
}

/* Put the answer into the state of the key. */
static void follow(const struct comparison *comparison)
{
    const fbd_model *key = comparison->key, *answer = comparison->answer;
    const double *y = comparison->key_state->y;
    fbd_state *state = comparison->state;
    state->t = comparison->key_state->t;
    for (size_t b = 0; b < key->body_count; b++) {
        const struct twin *twin = &comparison->twins[b];
        for (int k = 0; twin->other >= 0 && k < key->bodies[b].count; k++) {
            int from = key->bodies[b].first + k, to = coordinate_of(answer, key->labels[from].name);
            double scale = key->scene->coordinates[from].angle ? 1 : 1 / comparison->length;
            state->y[to] = twin->sign * scale * y[from] + twin->offset;
            state->y[answer->plan.n + to] = twin->sign * scale * y[key->plan.n + from];
        }
    }
    follow_states(comparison);
    if (!random_admissible(state)) state_evaluate(state);
}

/* The start at another time: sticking contacts still stick, while forces differ. */
static bool start_at_another_time(struct comparison *comparison)
{
    const fbd_model *key = comparison->key;
    fbd_state *state = comparison->key_state;
    const struct value *until = &key->scene->simulate.until;
    if (model_is_driven(key)) return false;
    state_copy(state, comparison->fresh);
    state->t = gsl_rng_uniform(comparison->rng) * (until->expr ? expr_value(until->expr) : 1);
    return random_admissible(state);
}

/* State `s`: the start, then alternately the start at other times and random states. If none of them is
 * admissible, because bodies would overlap, take an inadmissible one: independent forces are known there too.
 */
static void next_state(struct comparison *comparison, size_t s)
{
    enum { tries = 12 };
    fbd_state *state = comparison->key_state;
    bool found = false;
    comparison->starts = s == 0;
    if (s == 0) {
        state_copy(state, comparison->fresh);
        comparison->path.known = 0;
        comparison->path.ends = false;
        found = random_admissible(state);
    } else if (s % 2 == 0) {
        found = comparison->starts = start_at_another_time(comparison);
    }
    for (int k = 0; s > 0 && !found && k < tries; k++)
        found = random_state(comparison->rng, state, &comparison->path) && random_admissible(state);
    if (!found) state_evaluate(state);
    comparison->possible = found || s == 0;
}

/* ---- correspondence of bodies */

static int body_called(const fbd_model *model, const char *name)
{
    for (size_t b = 0; b < model->body_count; b++)
        if (strcmp(model->bodies[b].name, name) == 0) return (int)b;
    return -1;
}

static bool has_coordinates(const struct comparison *comparison, const struct model_body *body)
{
    for (int k = 0; k < body->count; k++)
        if (coordinate_of(comparison->answer, comparison->key->labels[body->first + k].name) < 0)
            return false;
    return true;
}

/* The size of the key's scene, the reference for rounding of positions. */
static double size_of_scene(const struct comparison *comparison)
{
    struct instant at = state_instant(comparison->key_state);
    double size = 0;
    for (size_t b = 0; b < comparison->key->body_count; b++) {
        const struct model_body *body = &comparison->key->bodies[b];
        double gyration = sqrt(fmax(body->inertia.I_G, 0) / body->inertia.mass);
        size = fmax(size, vec_norm(body_pose(body, &at).origin) + body->L + gyration);
    }
    return size;
}

/* True if the frame of the body coincides with that of the key's. That of a slide may point the opposite way,
 * that of a pivot be turned in the body by a constant angle. */
static bool is_there(const struct comparison *comparison, size_t b)
{
    const struct twin *twin = &comparison->twins[b];
    struct instant at = state_instant(comparison->key_state), other_at = state_instant(comparison->state);
    const struct model_body *body = &comparison->key->bodies[b];
    const struct model_body *other = &comparison->answer->bodies[twin->other];
    struct pose pose = body_pose(body, &at), there = body_pose(other, &other_at);
    struct vec apart = vec_sub(pose.origin, vec_scale(comparison->length, there.origin));
    const double digits = 1e-9; /* of files */
    struct vec turn = {cos(twin->offset), sin(twin->offset)};
    struct vec rotation = body->kind == motion_pivot ? vec_turn(turn, pose.rotation) : pose.rotation;
    bool turned = body->kind != motion_slide && body->kind != motion_particle &&
                  vec_norm(vec_sub(rotation, there.rotation)) > digits;
    return vec_norm(apart) <= digits * size_of_scene(comparison) && !turned;
}

/* True if its centre of mass coincides with that of the key's. */
static bool balances_there(const struct comparison *comparison, size_t b)
{
    struct instant at = state_instant(comparison->key_state), other_at = state_instant(comparison->state);
    const struct model_body *body = &comparison->key->bodies[b];
    const struct model_body *other = &comparison->answer->bodies[comparison->twins[b].other];
    struct pose pose = body_pose(body, &at), there = body_pose(other, &other_at);
    struct vec G = point_motion(body, &pose, body->inertia.G).p;
    struct vec other_G = vec_scale(comparison->length, point_motion(other, &there, other->inertia.G).p);
    const double digits = 1e-6; /* of lengths computed by hand */
    return vec_norm(vec_sub(G, other_G)) <= digits * size_of_scene(comparison);
}

static void find_twin(struct comparison *comparison, size_t b)
{
    const struct model_body *body = &comparison->key->bodies[b];
    struct twin *twin = &comparison->twins[b];
    *twin = (struct twin){.other = body_called(comparison->answer, body->name), .sign = 1};
    if (twin->other < 0) {
        verdict_body(comparison->grade, body);
        return;
    }
    const struct model_body *other = &comparison->answer->bodies[twin->other];
    if (body->kind == other->kind && has_coordinates(comparison, body)) return;
    verdict_motion(comparison->grade, body, other);
    twin->other = -1;
}

/* x' = s x + c of a slide: s from its direction, c from the position of the answer's body at c = 0. */
static bool find_slide(struct comparison *comparison, size_t b)
{
    struct twin *twin = &comparison->twins[b];
    if (is_there(comparison, b)) return true;
    struct instant at = state_instant(comparison->key_state), own = state_instant(comparison->state);
    struct pose pose = body_pose(&comparison->key->bodies[b], &at);
    struct pose there = body_pose(&comparison->answer->bodies[twin->other], &own);
    twin->sign = vec_dot(pose.rotation, there.rotation) < 0 ? -1 : 1;
    follow(comparison);
    if (is_there(comparison, b)) return true;
    own = state_instant(comparison->state);
    there = body_pose(&comparison->answer->bodies[twin->other], &own);
    twin->offset =
        vec_dot(vec_sub(vec_scale(1 / comparison->length, pose.origin), there.origin), there.rotation);
    follow(comparison);
    return is_there(comparison, b);
}

/* theta' = theta + c of a pivot whose frame is turned in the body: c from the starts, which are the same. If
 * the centres of mass still differ, it is another body. */
static bool find_pivot(struct comparison *comparison, size_t b)
{
    struct twin *twin = &comparison->twins[b];
    const struct model_body *body = &comparison->key->bodies[b];
    const struct model_body *other = &comparison->answer->bodies[twin->other];
    bool there = is_there(comparison, b);
    if (there && balances_there(comparison, b)) return true;
    twin->offset = comparison->answer->scene->coordinates[other->source->first].initial -
                   comparison->key->scene->coordinates[body->source->first].initial;
    follow(comparison);
    if (is_there(comparison, b) && balances_there(comparison, b)) return true;
    twin->offset = 0;
    follow(comparison);
    return there;
}

static void keep_own(const struct comparison *comparison, size_t b)
{
    const struct twin *twin = &comparison->twins[b];
    const struct model_body *body = &comparison->key->bodies[b];
    struct fbd_grade *grade = comparison->grade;
    if (twin->sign > 0 && twin->offset == 0) return;
    struct own_coordinate *own = ARENA_NEW(&grade->arena, struct own_coordinate);
    if (!own) return;
    bool us = comparison->answer->scene->units == unit_us;
    *own = (struct own_coordinate){.body = body->name,
                                   .sign = twin->sign,
                                   .offset = twin->offset,
                                   .next = grade->own};
    own->unit = body->kind == motion_pivot ? "rad" : us ? "ft" : "m";
    coordinates_of(body->kind, &own->names);
    grade->own = own;
}

/* At a state away from the origin, where positions determine the sense of each coordinate. */
static void find_coordinates(struct comparison *comparison)
{
    for (size_t b = 0; b < comparison->key->body_count; b++) {
        struct twin *twin = &comparison->twins[b];
        enum motion_kind kind = comparison->key->bodies[b].kind;
        if (twin->other < 0) continue;
        bool found = kind == motion_slide   ? find_slide(comparison, b)
                     : kind == motion_pivot ? find_pivot(comparison, b)
                                            : is_there(comparison, b);
        if (found) {
            keep_own(comparison, b);
            continue;
        }
        verdict_motion(comparison->grade, &comparison->key->bodies[b],
                       &comparison->answer->bodies[twin->other]);
        twin->other = -1;
    }
}

/* ---- the two sides of a body */

static double coefficient(const struct value *value, const fbd_state *state)
{
    if (!value->expr) return 0;
    return expr_is_constant(value->expr) ? expr_value(value->expr)
                                         : expr_eval(value->expr, state->t, state->y, NULL);
}

static void take_item(struct item *item, size_t s, const struct arrow *arrow, struct vec G,
                      const fbd_state *state, double force, double length)
{
    struct action *at = &item->at[s];
    at->force = vec_scale(force, arrow->force);
    at->point = vec_scale(length, arrow->point);
    item->about[s] = G;
    struct vec lever = vec_sub(at->point, G);
    double size = vec_norm(at->force);
    at->arm = size > 0 ? fabs(vec_cross(lever, at->force)) / size : 0;
    at->moment = force * length * arrow->couple + vec_cross(lever, at->force);
    if (!item->source) return;
    at->mu_s = coefficient(&item->source->mu_s, state);
    at->mu_k = coefficient(&item->source->mu_k, state);
    at->surface = coefficient(&item->source->surface_speed, state);
}

/* An entry of the answer without a magnitude. */
static void note_unknown(const struct comparison *comparison, struct item *item)
{
    const struct drawn *drawn = drawn_at(comparison->grade, item->source->at);
    item->unknown = drawn && drawn->unknown;
    item->free = item->unknown && drawn->free;
}

/* The loads that the body lists, from its arrows, and if `reactions` is given, all other forces on it. */
static void take_items(const struct comparison *comparison, fbd_state *state, int b, struct item *items,
                       struct item *reactions, size_t s, struct vec G)
{
    const fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    struct instant at = state_instant(state);
    bool own = reactions != NULL;
    double force = own ? 1 : comparison->force, length = own ? 1 : comparison->length;
    size_t count = diagram_fill(model, b, &at, state->a, state->slots, comparison->arrows);
    for (size_t i = 0; i < count; i++) {
        const struct arrow *arrow = &comparison->arrows[i];
        bool listed = i < body->source->load_count;
        if (!listed && !own) break;
        struct item *item = listed ? &items[i] : &reactions[i - body->source->load_count];
        item->source = listed ? model->loads[arrow->load].source : NULL;
        item->name = arrow->name;
        item->follows = arrow_is_reaction(model, arrow);
        take_item(item, s, arrow, G, state, force, length);
        if (!listed && s == 0) reaction_describe(model, b, arrow, &at, item);
        if (listed && !own) note_unknown(comparison, item);
        if (listed && s == 0 && item->source->kind == load_normal)
            item->across = surface_normal(model, body, &at);
    }
}

static void take_state(struct comparison *comparison, size_t s)
{
    const fbd_model *key = comparison->key;
    for (size_t b = 0; b < key->body_count; b++) {
        struct twin *twin = &comparison->twins[b];
        const struct model_body *body = &key->bodies[b];
        if (twin->other < 0) continue;
        struct instant at = state_instant(comparison->key_state);
        struct pose pose = body_pose(body, &at);
        struct vec G = point_motion(body, &pose, body->inertia.G).p;
        struct sides *sides = &twin->sides;
        take_items(comparison, comparison->key_state, (int)b, sides->key, sides->reactions, s, G);
        take_items(comparison, comparison->state, twin->other, sides->items, NULL, s, G);
        int slip = body->friction >= 0 ? comparison->key_state->slip[body->friction] : 0;
        if (s == 0) twin->slip = slip;
        sides->like_start[s] = twin->slip == slip;
        sides->possible[s] = comparison->possible;
        sides->starts[s] = comparison->starts;
        sides->samples = s + 1;
    }
}

static bool make_sides(struct comparison *comparison)
{
    for (size_t b = 0; b < comparison->key->body_count; b++) {
        struct twin *twin = &comparison->twins[b];
        struct sides *sides = &twin->sides;
        if (twin->other < 0) continue;
        const struct model_body *body = &comparison->key->bodies[b];
        sides->key_count = body->source->load_count;
        sides->count = comparison->answer->bodies[twin->other].source->load_count;
        sides->tolerance = comparison->key->scene->grading.tolerance;
        sides->turns = body->kind != motion_slide && body->kind != motion_particle;
        sides->reaction_count = diagram_arrows(comparison->key, (int)b) - sides->key_count;
        sides->key = calloc(sides->key_count + sides->count + sides->reaction_count + 1, sizeof *sides->key);
        if (!sides->key) return false;
        sides->items = sides->key + sides->key_count;
        sides->reactions = sides->items + sides->count;
    }
    return true;
}

static void measure_item(struct sides *sides, const struct item *item)
{
    for (size_t s = 0; s < sides->samples; s++) {
        if (item->follows && !sides->possible[s]) continue;
        const struct action *at = &item->at[s];
        sides->force = fmax(sides->force, vec_norm(at->force));
        sides->moment = fmax(sides->moment, fabs(at->moment));
        sides->arm = fmax(sides->arm, at->arm);
        sides->reach =
            fmax(sides->reach, item->source ? at->arm : vec_norm(vec_sub(at->point, item->about[s])));
    }
}

/* Reference magnitudes of the comparison over all states, from the key, since an answer may have forces of
 * any size. */
static void measure(struct sides *sides)
{
    for (size_t i = 0; i < sides->key_count; i++) measure_item(sides, &sides->key[i]);
    for (size_t i = 0; i < sides->reaction_count; i++) measure_item(sides, &sides->reactions[i]);
    sides->moment = fmax(sides->moment, sides->force * sides->arm);
    if (sides->force == 0) sides->force = sides->moment; /* of moments only: of forces with unit arm */
}

/* ---- all of it */

static bool open_comparison(struct comparison *comparison)
{
    const fbd_model *key = comparison->key, *answer = comparison->answer;
    const double foot = 0.3048, pound = 4.4482216152605; /* exact by definition */
    size_t most = diagram_most_arrows(key), other = diagram_most_arrows(answer);
    bool us = answer->scene->units == unit_us, key_us = key->scene->units == unit_us;
    comparison->length = us == key_us ? 1 : us ? foot : 1 / foot;
    comparison->force = us == key_us ? 1 : us ? pound : 1 / pound;
    comparison->fresh = state_new(key);
    comparison->key_state = state_new(key);
    comparison->state = state_new(answer);
    comparison->twins = calloc(key->body_count + 1, sizeof *comparison->twins);
    comparison->arrows = calloc((most > other ? most : other) + 1, sizeof *comparison->arrows);
    comparison->path.start = comparison->fresh;
    comparison->path.y = calloc(random_path_room(key), sizeof *comparison->path.y);
    comparison->rng = gsl_rng_alloc(gsl_rng_mt19937);
    return comparison->fresh && comparison->key_state && comparison->state && comparison->twins &&
           comparison->arrows && comparison->path.y && comparison->rng;
}

static void close_comparison(struct comparison *comparison)
{
    for (size_t b = 0; comparison->twins && b < comparison->key->body_count; b++)
        free(comparison->twins[b].sides.key);
    if (comparison->rng) gsl_rng_free(comparison->rng);
    state_free(comparison->fresh);
    state_free(comparison->key_state);
    state_free(comparison->state);
    free(comparison->twins);
    free(comparison->arrows);
    free(comparison->path.y);
}

static void look_at_states(struct comparison *comparison)
{
    next_state(comparison, 0);
    next_state(comparison, 1);
    follow(comparison);
    find_coordinates(comparison);
    for (size_t s = 0; s < most_grade_samples; s++) {
        next_state(comparison, s);
        follow(comparison);
        take_state(comparison, s);
    }
}

bool compare_with_itself(struct fbd_key *key)
{
    struct fbd_grade grade = {.key = key, .sheet = key->model};
    struct comparison comparison = {.grade = &grade, .key = key->model, .answer = key->model};
    bool open = open_comparison(&comparison);
    for (size_t b = 0; open && b < key->model->body_count; b++) find_twin(&comparison, b);
    open = open && make_sides(&comparison);
    if (open) look_at_states(&comparison);
    for (size_t b = 0; open && b < key->model->body_count; b++) {
        struct sides *sides = &comparison.twins[b].sides;
        if (comparison.twins[b].other < 0) continue;
        measure(sides);
        open = reactions_note_asked(key, b, sides);
    }
    close_comparison(&comparison);
    bool done = open && !grade.arena.failed;
    arena_free(&grade.arena);
    return done;
}

/* Gravity must be that of the sheet. */
static bool same_gravity(const struct comparison *comparison)
{
    struct vec key = comparison->key->scene->gravity, own = comparison->answer->scene->gravity;
    struct vec apart = vec_sub(vec_scale(comparison->length, own), key);
    return vec_norm(apart) <= comparison->key->scene->grading.tolerance * vec_norm(key);
}

void grade_bodies(struct fbd_grade *grade, const fbd_model *answer)
{
    struct comparison comparison = {.grade = grade, .key = grade->sheet, .answer = answer};
    bool open = open_comparison(&comparison);
    bool same = open && same_gravity(&comparison);
    for (size_t b = 0; open && !same && b < comparison.key->body_count; b++)
        verdict_gravity(grade, &comparison.key->bodies[b]);
    for (size_t b = 0; same && b < comparison.key->body_count; b++) find_twin(&comparison, b);
    if (open && !same) {
        verdict_on_others(grade, answer);
    } else if (open && make_sides(&comparison)) {
        look_at_states(&comparison);
        for (size_t b = 0; b < comparison.key->body_count; b++) {
            struct twin *twin = &comparison.twins[b];
            const struct model_body *body = &comparison.key->bodies[b];
            if (twin->other < 0) continue;
            measure(&twin->sides);
            reactions_take_asked(grade->key, b, &twin->sides);
            if (body->kind == motion_pivot) twin->sides.turned = twin->offset;
            if (!sketches_place(grade, &twin->sides)) grade->arena.failed = true;
            verdict_on(grade, answer, body, &answer->bodies[twin->other], &twin->sides, comparison.length,
                       comparison.force);
        }
        verdict_on_others(grade, answer);
    } else {
        grade->arena.failed = true;
    }
    close_comparison(&comparison);
}
