/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The forces and moments of an answer at states of the key.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/compare.h"
#include "grade/reactions.h"
#include "grade/verdict.h"

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
    size_t body_count; /* of the key */
    fbd_state *key_state, *state;
    struct twin *twins; /* of each body of the key */
    fbd_listed_force *forces;
    fbd_sampler *sampler;  /* of the key */
    double length, force;  /* units of the answer in those of the key */
    bool possible, starts; /* state of the key: it is admissible; it is the start, perhaps at another time */
};

/* ---- states */

static bool has_coordinate(const struct comparison *comparison, const char *name)
{
    return fbd_state_get(comparison->state, name, &(double){0});
}

/* Copy the user states by name, in the units of the answer. */
static void follow_states(const struct comparison *comparison)
{
    const fbd_model *key = comparison->key, *answer = comparison->answer;
    for (size_t i = 0; i < fbd_model_state_count(key); i++)
        for (size_t k = 0; k < fbd_model_state_count(answer); k++) {
            const fbd_own_state from = fbd_model_state(key, i), to = fbd_model_state(answer, k);
            char unit[64];
            double value, scale = 1;
            if (strcmp(from.name, to.name) != 0) continue;
            snprintf(unit, sizeof unit, "1[%s]", from.unit);
            fbd_state_get(comparison->key_state, from.name, &value);
            fbd_model_quantity(answer, to.name, unit, to.unit, &scale, NULL);
            fbd_state_set(comparison->state, to.name, scale * value);
        }
}

/* Put the answer into the state of the key. */
static void follow(const struct comparison *comparison)
{
    const fbd_model *key = comparison->key;
    double value = 0;
    fbd_state_get(comparison->key_state, "t", &value);
    fbd_state_set(comparison->state, "t", value);
    for (size_t i = 0; i < fbd_model_coordinate_count(key); i++) {
        const fbd_coordinate coordinate = fbd_model_coordinate(key, i);
        const struct twin *twin = &comparison->twins[coordinate.body];
        if (twin->other < 0) continue;
        double scale = strcmp(coordinate.unit, "rad") == 0 ? 1 : 1 / comparison->length;
        fbd_state_get(comparison->key_state, coordinate.name, &value);
        fbd_state_set(comparison->state, coordinate.name, twin->sign * scale * value + twin->offset);
        fbd_state_get(comparison->key_state, coordinate.rate_name, &value);
        fbd_state_set(comparison->state, coordinate.rate_name, twin->sign * scale * value);
    }
    follow_states(comparison);
    fbd_state_settle(comparison->state);
}

/* State `s`: the start, then alternately the start at other times, where sticking contacts still stick while
 * forces differ, and random states. If none of them is admissible, because bodies would overlap, take an
 * inadmissible one: independent forces are known there too. */
static void next_state(struct comparison *comparison, size_t s)
{
    enum { tries = 12 };
    fbd_state *state = comparison->key_state;
    bool start = s % 2 == 0 && fbd_sampler_start(comparison->sampler, state, s > 0);
    comparison->starts = start || s == 0;
    comparison->possible = comparison->starts || fbd_sampler_draw(comparison->sampler, state, tries);
}

/* ---- correspondence of bodies */

static int body_called(const fbd_model *model, const char *name)
{
    for (size_t b = 0; b < fbd_model_body_count(model); b++)
        if (strcmp(fbd_model_body_name(model, b), name) == 0) return (int)b;
    return -1;
}

static bool has_coordinates(const struct comparison *comparison, const fbd_body *body)
{
    for (size_t k = 0; k < body->coordinate_count; k++)
        if (!has_coordinate(comparison, fbd_model_coordinate(comparison->key, body->coordinate + k).name))
            return false;
    return true;
}

/* True if the body and its angle move. */
static bool turns(const fbd_body *body)
{
    return body->motion != FBD_MOTION_SLIDE && body->motion != FBD_MOTION_PARTICLE;
}

/* The size of the key's scene, the reference for rounding of positions. */
static double size_of_scene(const struct comparison *comparison)
{
    double size = 0;
    for (size_t b = 0; b < comparison->body_count; b++) {
        const fbd_body body = fbd_model_body(comparison->key, b);
        const fbd_inertia *inertia = &body.inertia;
        const fbd_pose pose = fbd_state_pose(comparison->key_state, b);
        double gyration = sqrt(fmax(inertia->I_G, 0) / inertia->mass);
        double arm = body.motion == FBD_MOTION_PIVOT ? inertia->L : hypot(inertia->G[0], inertia->G[1]);
        size = fmax(size, hypot(pose.x, pose.y) + arm + gyration);
    }
    return size;
}

/* The poses of a body of the key and of its twin, in the units of the key. */
static fbd_pose pose_of_twin(const struct comparison *comparison, size_t b)
{
    fbd_pose pose = fbd_state_pose(comparison->state, (size_t)comparison->twins[b].other);
    pose.x *= comparison->length;
    pose.y *= comparison->length;
    for (int k = 0; k < 2; k++) pose.G[k] *= comparison->length;
    return pose;
}

/* True if the frame of the body coincides with that of the key's. That of a slide may point the opposite way,
 * that of a pivot be turned in the body by a constant angle. */
static bool is_there(const struct comparison *comparison, size_t b)
{
    const struct twin *twin = &comparison->twins[b];
    const fbd_body body = fbd_model_body(comparison->key, b);
    const fbd_pose pose = fbd_state_pose(comparison->key_state, b), there = pose_of_twin(comparison, b);
    const double digits = 1e-9; /* of files */
    struct vec turn = {cos(twin->offset), sin(twin->offset)}, rotation = {pose.cosine, pose.sine};
    if (body.motion == FBD_MOTION_PIVOT) rotation = vec_turn(turn, rotation);
    bool turned = turns(&body) && hypot(rotation.x - there.cosine, rotation.y - there.sine) > digits;
    return hypot(pose.x - there.x, pose.y - there.y) <= digits * size_of_scene(comparison) && !turned;
}

/* True if its centre of mass coincides with that of the key's. */
static bool balances_there(const struct comparison *comparison, size_t b)
{
    const fbd_pose pose = fbd_state_pose(comparison->key_state, b), there = pose_of_twin(comparison, b);
    const double digits = 1e-6; /* of lengths computed by hand */
    return hypot(pose.G[0] - there.G[0], pose.G[1] - there.G[1]) <= digits * size_of_scene(comparison);
}

static void find_twin(struct comparison *comparison, size_t b)
{
    const fbd_body body = fbd_model_body(comparison->key, b);
    struct twin *twin = &comparison->twins[b];
    *twin = (struct twin){.other = body_called(comparison->answer, body.name), .sign = 1};
    if (twin->other < 0) {
        verdict_body(comparison->grade, b);
        return;
    }
    const fbd_body other = fbd_model_body(comparison->answer, (size_t)twin->other);
    if (body.motion == other.motion && has_coordinates(comparison, &body)) return;
    verdict_motion(comparison->grade, b, &other);
    twin->other = -1;
}

/* x' = s x + c of a slide: s from its direction, c from the position of the answer's body at c = 0. */
static bool find_slide(struct comparison *comparison, size_t b)
{
    struct twin *twin = &comparison->twins[b];
    if (is_there(comparison, b)) return true;
    const fbd_pose pose = fbd_state_pose(comparison->key_state, b);
    fbd_pose there = pose_of_twin(comparison, b);
    twin->sign = pose.cosine * there.cosine + pose.sine * there.sine < 0 ? -1 : 1;
    follow(comparison);
    if (is_there(comparison, b)) return true;
    there = fbd_state_pose(comparison->state, (size_t)twin->other);
    twin->offset = (pose.x / comparison->length - there.x) * there.cosine +
                   (pose.y / comparison->length - there.y) * there.sine;
    follow(comparison);
    return is_there(comparison, b);
}

/* The initial value of the coordinate of a pivot. */
static double initial_angle(struct fbd_grade *grade, const fbd_model *model, size_t b)
{
    double angle = 0;
    fbd_state *state = fbd_state_new(model);
    const fbd_body body = fbd_model_body(model, b);
    if (!fbd_state_get(state, fbd_model_coordinate(model, body.coordinate).name, &angle))
        grade->arena.failed = true;
    fbd_state_free(state);
    return angle;
}

/* theta' = theta + c of a pivot whose frame is turned in the body: c from the starts, which are the same. If
 * the centres of mass still differ, it is another body. */
static bool find_pivot(struct comparison *comparison, size_t b)
{
    struct twin *twin = &comparison->twins[b];
    bool there = is_there(comparison, b);
    if (there && balances_there(comparison, b)) return true;
    twin->offset = initial_angle(comparison->grade, comparison->answer, (size_t)twin->other) -
                   initial_angle(comparison->grade, comparison->key, b);
    follow(comparison);
    if (is_there(comparison, b) && balances_there(comparison, b)) return true;
    twin->offset = 0;
    follow(comparison);
    return there;
}

static void keep_own(const struct comparison *comparison, const fbd_body *body, const struct twin *twin)
{
    struct fbd_grade *grade = comparison->grade;
    if (twin->sign > 0 && twin->offset == 0) return;
    struct own_coordinate *own = ARENA_NEW(&grade->arena, struct own_coordinate);
    if (!own) return;
    const fbd_body other = fbd_model_body(comparison->answer, (size_t)twin->other);
    *own = (struct own_coordinate){.body = body->name,
                                   .angle = body->motion == FBD_MOTION_PIVOT,
                                   .sign = twin->sign,
                                   .offset = twin->offset,
                                   .unit = fbd_model_coordinate(comparison->answer, other.coordinate).unit,
                                   .next = grade->own};
    grade->own = own;
}

/* At a state away from the origin, where positions determine the sense of each coordinate. */
static void find_coordinates(struct comparison *comparison)
{
    for (size_t b = 0; b < comparison->body_count; b++) {
        struct twin *twin = &comparison->twins[b];
        if (twin->other < 0) continue;
        const fbd_body body = fbd_model_body(comparison->key, b);
        const fbd_body other = fbd_model_body(comparison->answer, (size_t)twin->other);
        bool found = body.motion == FBD_MOTION_SLIDE   ? find_slide(comparison, b)
                     : body.motion == FBD_MOTION_PIVOT ? find_pivot(comparison, b)
                                                       : is_there(comparison, b);
        if (found) {
            keep_own(comparison, &body, twin);
            continue;
        }
        verdict_motion(comparison->grade, b, &other);
        twin->other = -1;
    }
}

/* ---- the two sides of a body */

static void take_item(struct item *item, size_t s, struct vec G, double force, double length)
{
    const fbd_arrow *arrow = &item->force.arrow;
    struct action *at = &item->at[s];
    at->force = vec_scale(force, (struct vec){arrow->fx, arrow->fy});
    at->point = vec_scale(length, (struct vec){arrow->x, arrow->y});
    item->about[s] = G;
    struct vec lever = vec_sub(at->point, G);
    double size = vec_norm(at->force);
    at->arm = size > 0 ? fabs(vec_cross(lever, at->force)) / size : 0;
    at->moment = force * length * arrow->couple + vec_cross(lever, at->force);
    at->mu_s = item->force.mu_s;
    at->mu_k = item->force.mu_k;
    at->surface = item->force.surface_speed;
}

/* An entry of the answer without a magnitude. */
static void note_unknown(const struct comparison *comparison, struct item *item)
{
    const struct drawn *drawn = drawn_at(comparison->grade, position_of(item->source));
    item->unknown = drawn && drawn->unknown;
    item->free = item->unknown && drawn->free;
}

/* The properties of a force at the start. */
static void describe(struct item *item)
{
    const fbd_listed_force *force = &item->force;
    item->across = (struct vec){force->along[0], force->along[1]};
    item->one_sided = force->one_sided;
    item->couples = force->couples;
    item->any = force->free;
    item->contact = force->contact;
}

/* The loads that the body lists, and if `reactions` is given, all other forces on it. */
static void take_items(const struct comparison *comparison, fbd_state *state, size_t b,
                       const struct sides *sides, bool own, size_t s, struct vec G)
{
    const fbd_model *model = own ? comparison->key : comparison->answer;
    const fbd_body body = fbd_model_body(model, b);
    double force = own ? 1 : comparison->force, length = own ? 1 : comparison->length;
    size_t count = fbd_state_forces(state, b, comparison->forces, body.most_forces);
    if (count == SIZE_MAX) comparison->grade->arena.failed = true;
    for (size_t i = 0; count != SIZE_MAX && i < count; i++) {
        bool listed = i < body.listed;
        if (!listed && !own) break;
        struct item *items = own ? sides->key : sides->items;
        struct item *item = listed ? &items[i] : &sides->reactions[i - body.listed];
        item->force = comparison->forces[i];
        item->source = listed ? &item->force : NULL;
        item->name = item->force.arrow.name;
        item->follows = item->force.reaction;
        take_item(item, s, G, force, length);
        if (s == 0) describe(item);
        if (listed && !own) note_unknown(comparison, item);
    }
}

static void take_state(struct comparison *comparison, size_t s)
{
    for (size_t b = 0; b < comparison->body_count; b++) {
        struct twin *twin = &comparison->twins[b];
        if (twin->other < 0) continue;
        const fbd_pose pose = fbd_state_pose(comparison->key_state, b);
        const struct vec G = {pose.G[0], pose.G[1]};
        struct sides *sides = &twin->sides;
        take_items(comparison, comparison->key_state, b, sides, true, s, G);
        take_items(comparison, comparison->state, (size_t)twin->other, sides, false, s, G);
        int slip = fbd_state_slip(comparison->key_state, b);
        if (s == 0) twin->slip = slip;
        sides->like_start[s] = twin->slip == slip;
        sides->possible[s] = comparison->possible;
        sides->starts[s] = comparison->starts;
        fbd_state_get(comparison->key_state, "t", &sides->times[s]);
        sides->samples = s + 1;
    }
}

static bool make_sides(struct comparison *comparison)
{
    size_t most = 0;
    for (size_t b = 0; b < comparison->body_count; b++) {
        struct twin *twin = &comparison->twins[b];
        struct sides *sides = &twin->sides;
        if (twin->other < 0) continue;
        const fbd_body body = fbd_model_body(comparison->key, b);
        const fbd_body other = fbd_model_body(comparison->answer, (size_t)twin->other);
        if (body.most_forces > most) most = body.most_forces;
        if (other.most_forces > most) most = other.most_forces;
        sides->key_count = body.listed;
        sides->count = other.listed;
        sides->tolerance = fbd_model_grading(comparison->key).tolerance;
        sides->turns = turns(&body);
        sides->reaction_count = body.most_forces - body.listed;
        sides->key = calloc(sides->key_count + sides->count + sides->reaction_count + 1, sizeof *sides->key);
        if (!sides->key) return false;
        sides->items = sides->key + sides->key_count;
        sides->reactions = sides->items + sides->count;
    }
    comparison->forces = calloc(most + 1, sizeof *comparison->forces);
    return comparison->forces != NULL;
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

static bool is_us(const fbd_model *model)
{
    return strcmp(fbd_model_scene(model).units, "US") == 0;
}

static bool open_comparison(struct comparison *comparison)
{
    const fbd_model *key = comparison->key, *answer = comparison->answer;
    const double foot = 0.3048, pound = 4.4482216152605; /* exact by definition */
    bool us = is_us(answer), key_us = is_us(key);
    comparison->length = us == key_us ? 1 : us ? foot : 1 / foot;
    comparison->force = us == key_us ? 1 : us ? pound : 1 / pound;
    comparison->body_count = fbd_model_body_count(key);
    comparison->key_state = fbd_state_new(key);
    comparison->state = fbd_state_new(answer);
    fbd_state_let_forces_act(comparison->state);
    comparison->sampler = fbd_sampler_new(key);
    comparison->twins = calloc(comparison->body_count + 1, sizeof *comparison->twins);
    return comparison->key_state && comparison->state && comparison->sampler && comparison->twins;
}

static void close_comparison(struct comparison *comparison)
{
    for (size_t b = 0; comparison->twins && b < comparison->body_count; b++)
        free(comparison->twins[b].sides.key);
    fbd_sampler_free(comparison->sampler);
    fbd_state_free(comparison->key_state);
    fbd_state_free(comparison->state);
    free(comparison->twins);
    free(comparison->forces);
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
    for (size_t b = 0; open && b < comparison.body_count; b++) find_twin(&comparison, b);
    open = open && make_sides(&comparison);
    if (open) look_at_states(&comparison);
    for (size_t b = 0; open && b < comparison.body_count; b++) {
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
    const fbd_scene key = fbd_model_scene(comparison->key), own = fbd_model_scene(comparison->answer);
    const double length = comparison->length;
    double apart = hypot(length * own.gravity[0] - key.gravity[0], length * own.gravity[1] - key.gravity[1]);
    return apart <= fbd_model_grading(comparison->key).tolerance * hypot(key.gravity[0], key.gravity[1]);
}

static void judge_body(struct comparison *comparison, size_t b)
{
    struct fbd_grade *grade = comparison->grade;
    struct twin *twin = &comparison->twins[b];
    if (twin->other < 0) return;
    const fbd_body body = fbd_model_body(comparison->key, b);
    const fbd_body other = fbd_model_body(comparison->answer, (size_t)twin->other);
    measure(&twin->sides);
    reactions_take_asked(grade->key, b, &twin->sides);
    if (body.motion == FBD_MOTION_PIVOT) twin->sides.turned = twin->offset;
    if (!sketches_place(grade, &twin->sides)) grade->arena.failed = true;
    verdict_on(grade, comparison->answer, b, &other, &twin->sides, comparison->length, comparison->force);
}

void grade_bodies(struct fbd_grade *grade, const fbd_model *answer)
{
    struct comparison comparison = {.grade = grade, .key = grade->sheet, .answer = answer};
    bool open = open_comparison(&comparison);
    bool same = open && same_gravity(&comparison);
    for (size_t b = 0; open && !same && b < comparison.body_count; b++) verdict_gravity(grade, b);
    for (size_t b = 0; same && b < comparison.body_count; b++) find_twin(&comparison, b);
    if (open && !same) {
        verdict_on_others(grade, answer);
    } else if (open && make_sides(&comparison)) {
        look_at_states(&comparison);
        for (size_t b = 0; b < comparison.body_count; b++) judge_body(&comparison, b);
        verdict_on_others(grade, answer);
    } else {
        grade->arena.failed = true;
    }
    close_comparison(&comparison);
}
