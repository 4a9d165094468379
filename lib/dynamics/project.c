/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/project.h"

#include <float.h>
#include <string.h>

#include "dynamics/closed_loops.h"
#include "dynamics/contact.h"
#include "dynamics/tree_system.h"
#include "numeric/tolerances.h"

/* A projection; y is that of the instant. */
struct place {
    const struct fbd_model *model;
    struct instant at;
    double *y;
    bool assemble;  /* only bodies that the scene marks for assembly */
    bool returning; /* within a step: sticking joints do not move */
};

/* Is the joint of a link fixed in the projection? */
static bool stays(const struct place *place, int link)
{
    const struct tree_link *joint = &place->model->tree->links[link];
    const struct body *body = place->model->bodies[joint->body].source;
    bool sticks = place->returning && joint->pair >= 0 && place->at.slip[joint->pair] == stick;
    return sticks || body->motion.prescribed.expr || (place->assemble && !body->assemble);
}

static struct place place_of(struct fbd_state *state, bool assemble)
{
    return (
        struct place){.model = state->model, .at = state_instant(state), .y = state->y, .assemble = assemble};
}

/* Are there rows to be satisfied? */
static bool is_constrained(const struct fbd_model *model, const struct instant *at)
{
    return tree_has_couplings(model->tree) && !tree_rows_are_idle(model->tree, at);
}

/* Evaluate links and rows. */
static void look(const struct place *place)
{
    tree_move(place->model, &place->at);
    constraints_evaluate(place->model, &place->at, NULL);
}

/* Evaluate the rows at the state, and factor the tree without loads and bias. */
static void prepare(const struct place *place)
{
    const struct fbd_model *model = place->model;
    const struct tree *tree = model->tree;
    struct tree_work *work = place->at.tree;
    for (int i = 1; i < tree->count; i++) {
        work->links[i].locked = stays(place, i);
        work->links[i].held = 0;
    }
    tree_move(model, &place->at);
    memset(work->x, 0, (size_t)tree->count * sizeof *work->x);
    tree_factor(tree, work);
    constraints_evaluate(model, &place->at, NULL);
}

static void release(const struct place *place)
{
    for (int i = 1; i < place->model->tree->count; i++) place->at.tree->links[i].locked = false;
}

static struct misfit misfit_of(const struct place *place)
{
    struct misfit misfit = {.row = -1};
    for (int j = 0; j < place->model->tree->row_count; j++) {
        const struct row *row = &place->at.tree->rows[j];
        if (!tree_takes_part(place->model->tree, &place->at, j)) continue;
        if (!(fabs(row->g.x) <= misfit.position)) {
            misfit.position = fabs(row->g.x);
            misfit.row = j;
        }
        if (!(fabs(row->g.x1) <= misfit.velocity)) misfit.velocity = fabs(row->g.x1);
    }
    return misfit;
}

double state_acceleration_misfit(const struct fbd_state *state, int *row)
{
    const struct fbd_model *model = state->model;
    const struct tree_work *work = state->tree;
    const struct instant at = state_instant(state);
    double worst = 0, mass = 0, force = 0, size = vec_norm(model->scene->gravity);
    *row = -1;
    if (!tree_has_couplings(model->tree)) return 0;
    for (int i = 1; i < model->tree->count; i++) {
        mass += model->tree->links[i].mass;
        force = fmax(force, vec_norm(work->links[i].F.force));
        size = fmax(size, vec_norm(work->links[i].A.a));
    }
    for (int j = 0; j < model->tree->row_count; j++) {
        double miss = fabs(work->rows[j].g.x2);
        if (!tree_takes_part(model->tree, &at, j)) continue;
        for (int i = 0; i < work->rows[j].port_count; i++)
            force = fmax(force, fabs(work->rows[j].lambda) * vec_norm(work->rows[j].ports[i].force));
        if (miss <= worst || isnan(worst)) continue;
        worst = miss;
        *row = j;
    }
    return worst == 0 ? 0 : worst / fmax(size, force / mass);
}

struct misfit state_misfit(struct fbd_state *state)
{
    if (!tree_has_couplings(state->model->tree)) return (struct misfit){0, 0, -1};
    struct place place = place_of(state, false);
    look(&place);
    return misfit_of(&place);
}

void state_start_constraints(struct fbd_state *state)
{
    if (!tree_has_couplings(state->model->tree)) return;
    struct instant at = state_instant(state);
    tree_move(state->model, &at);
    constraints_start(state->model, &at);
}

/* Rounding of the positions that a row is made of. */
static double rounding(const struct place *place)
{
    double reach = 0;
    for (int i = 1; i < place->model->tree->count; i++) {
        const struct tree_state *s = &place->at.tree->links[i];
        reach = fmax(reach, fmax(vec_norm(s->p), vec_norm(s->d)));
    }
    return round_off(16, reach);
}

static struct vec port_point(const struct place *place, const struct port *port)
{
    return vec_add(place->at.tree->links[port->link].p, port->arm);
}

/* The size of the joined parts: arms of rows, or the distance of their points if there are no arms. */
static double arm_length(const struct place *place)
{
    double length = 0, apart = 0;
    for (int j = 0; j < place->model->tree->row_count; j++) {
        const struct row *row = &place->at.tree->rows[j];
        for (int k = 0; k < row->port_count; k++) {
            if (row->ports[k].link > 0) length = fmax(length, vec_norm(row->ports[k].arm));
            struct vec from = port_point(place, &row->ports[0]), to = port_point(place, &row->ports[k]);
            apart = fmax(apart, vec_norm(vec_sub(to, from)));
        }
    }
    return length > 0 ? length : apart;
}

/* Add share times the response to -value of each row to positions or velocities. */
static void move(const struct place *place, bool velocity, double share)
{
    const struct tree *tree = place->model->tree;
    struct tree_work *work = place->at.tree;
    double *target = place->y + (velocity ? place->model->plan.n : 0);
    for (int j = 0; j < tree_unknowns(tree); j++)
        work->z[j] = j >= tree->row_count ? 0 : velocity ? -work->rows[j].g.x1 : -work->rows[j].g.x;
    work->projecting = true;
    tree_system_solve(place->model, &place->at, work->z);
    work->projecting = false;
    for (int i = 1; i < tree->count; i++) {
        int first = tree->links[i].coordinate, count = joint_freedom(tree->links[i].kind);
        for (int k = first; k < first + count && !work->links[i].locked; k++)
            target[k] += share * work->unit[k];
    }
}

static void factor(const struct place *place, double damping)
{
    place->at.tree->projecting = place->at.tree->placing = true;
    place->at.tree->damping = damping;
    tree_system_factor(place->model, &place->at);
    place->at.tree->projecting = place->at.tree->placing = false;
}

static void refactor(const struct place *place, double damping)
{
    place->at.tree->projecting = true;
    place->at.tree->damping = damping;
    tree_system_refactor(place->model->tree, place->at.tree);
    place->at.tree->projecting = false;
}

/* ---- from anywhere: the start */

enum { most_steps = 60 };

/* Decreasing with the misfit: a light coupler between heavy bodies has slopes that differ by their masses. */
static double start_damping(const struct place *place, double misfit)
{
    return fmin(projection_damping, fmax(negligible_part, projection_damping * misfit / arm_length(place)));
}

/* The largest speed of the links, including rotation at the ends of the arms of rows. */
static double speed_of(const struct place *place)
{
    double length = arm_length(place), speed = 0;
    for (int i = 1; i < place->model->tree->count; i++) {
        const struct tree_state *s = &place->at.tree->links[i];
        speed = fmax(speed, vec_norm(s->v) + fabs(s->omega) * length);
    }
    return speed;
}

/* Is the state at rest, with accelerations beyond the rounding of its forces, at an arm? */
static bool sets_out(const struct fbd_state *state, double arm)
{
    const struct tree *tree = state->model->tree;
    double a = 0, force = 0, lightest = DBL_MAX;
    for (int i = 0; i < state->model->plan.n; i++)
        if (state->y[state->model->plan.n + i] != 0) return false;
    for (int i = 1; i < tree->count; i++) {
        const struct tree_state *s = &state->tree->links[i];
        a = fmax(a, vec_norm(s->A.a) + fabs(s->A.alpha) * arm);
        force = fmax(force, fmax(vec_norm(tree->links[i].force), vec_norm(s->F.force)));
        force = fmax(force, fabs(s->F.moment) / arm);
        if (tree->links[i].mass > 0) lightest = fmin(lightest, tree->links[i].mass);
    }
    for (int j = 0; j < tree->row_count; j++) {
        const struct row *row = &state->tree->rows[j];
        for (int k = 0; k < row->port_count; k++)
            force = fmax(force, fabs(row->lambda) * vec_norm(row->ports[k].force));
    }
    return a * lightest > distinct_part * force;
}

static bool has_redundant_row(const struct fbd_state *state)
{
    const struct instant at = state_instant(state);
    const struct tree *tree = state->model->tree;
    for (int j = 0; j < tree->row_count; j++)
        if (tree_takes_part(tree, &at, j) && state->tree->rows[j].redundant) return true;
    return false;
}

/* g = J q' + q'.H q' / 2 along q' = a T: with J a = 0, and J of less than full rank, J q'' = -q'.H q' may
 * have no solution. The residual is compared with the curvature of the motion, speed^2 / arm. Contacts are
 * excluded, since they open or slip then: a box that tips beside another has the normal force of that one and
 * the friction under its corner along one line, and leaves it. */
int state_locked_row(const struct fbd_state *state, struct fbd_state *other)
{
    const double T = 1e3;
    if (!tree_has_couplings(state->model->tree) || !has_redundant_row(state)) return -1;
    const struct tree *tree = state->model->tree;
    const struct instant at = state_instant(state);
    int n = state->model->plan.n, worst = -1;
    state_copy(other, state);
    state_evaluate_unshared(other);
    struct place place = place_of(other, false);
    double arm = arm_length(&place);
    if (!(arm > 0) || !sets_out(state, arm)) return -1;
    for (int i = 0; i < n; i++) other->y[n + i] = T * state->a[i];
    state_evaluate_unshared(other);
    double speed = speed_of(&place), most = distinct_part * speed * speed / arm;
    for (int j = 0; j < tree->row_count; j++) {
        double miss = fabs(other->tree->rows[j].g.x2);
        bool touches = tree->couplings[tree->coupling_of_row[j]].meeting >= 0;
        if (touches || !tree_takes_part(tree, &at, j) || miss <= most) continue;
        most = miss;
        worst = j;
    }
    return worst;
}

bool state_is_fixed(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    const struct tree *tree = state->model->tree;
    if (!tree_has_couplings(state->model->tree) || tree->ends || tree->row_count < plan->n) return false;
    if (plan->mode_count + (size_t)plan->own > 0) return false;
    int independent = 0;
    state_evaluate_unshared(state);
    for (int j = 0; j < tree->row_count; j++) independent += !state->tree->rows[j].weak;
    return independent == plan->n;
}

static void project_velocity(const struct place *place)
{
    /* Linear: the second step corrects rounding of the first. */
    for (int pass = 0; pass < 2; pass++) {
        prepare(place);
        if (misfit_of(place).velocity == 0) break;
        factor(place, negligible_part);
        move(place, true, 1);
    }
    prepare(place);
}

/* A projection that changes the state by more than this times its misfit is rejected: its rows nearly
 * contradict each other. (Boxes that lean on each other, with 1e4, lost up to half of their angular velocity,
 * which no energy check shows: tests/unit/test_shelf.c.) */
static const double far = 1e2;

/* The largest change of a coordinate, or a rate; of angles at an arm. */
static double change_since(const struct place *place, const double *y, const double *before, double arm)
{
    const struct scene *scene = place->model->scene;
    double most = 0;
    for (int i = 0; i < place->model->plan.n; i++)
        most = fmax(most, (scene->coordinates[i].angle ? arm : 1) * fabs(y[i] - before[i]));
    return most;
}

/* Project the velocities. False, with the velocities as they were, where that changes them by more than `most`. */
static bool project_near(const struct place *place, const double *before, double most)
{
    const size_t n = (size_t)place->model->plan.n;
    project_velocity(place);
    if (change_since(place, place->y + n, before, arm_length(place)) <= most) return true;
    memcpy(place->y + n, before, n * sizeof *before);
    prepare(place);
    return false;
}

/* Velocities that satisfy rows which nearly contradict each other may be far from velocities with a tiny residual: of contacts
 * that stick on both sides of a jammed body, or of a body that slides into a narrow gap. Friction slips by that residual, and
 * without friction the velocities remain. */
bool state_project_velocity(struct fbd_state *state, bool assemble)
{
    struct place place = place_of(state, assemble);
    if (!is_constrained(state->model, &place.at)) return true;
    size_t n = (size_t)state->model->plan.n, bytes = n * sizeof *state->y;
    double *before = state_scratch(state).dy;
    prepare(&place);
    double speed = speed_of(&place), off = misfit_of(&place).velocity;
    memcpy(before, state->y + n, bytes);
    const double most =
        state->model->tree->meeting_count > 0 ? far * fmax(off, round_off(1, speed)) : HUGE_VAL;
    if (!project_near(&place, before, most)) {
        place.at.tree->settling_down = true;
        project_near(&place, before, most);
        place.at.tree->settling_down = false;
        prepare(&place);
    }
    bool there = misfit_of(&place).velocity <= undecided_part * fmax(speed, speed_of(&place));
    release(&place);
    return there;
}

/* Project the velocities `way`. */
static void find_way(struct fbd_state *state, double *way)
{
    const struct place place = place_of(state, false);
    size_t n = (size_t)state->model->plan.n, bytes = n * sizeof *way;
    memcpy(state->y + n, way, bytes);
    project_velocity(&place);
    release(&place);
    memcpy(way, state->y + n, bytes);
}

void state_find_ways(struct fbd_state *state, double *ways)
{
    size_t n = (size_t)state->model->plan.n, bytes = n * sizeof *ways;
    double *before = state_scratch(state).dy, *still = before + n;
    memcpy(before, state->y + n, bytes);
    memset(still, 0, bytes);
    find_way(state, still); /* motion by drives, as the length of a rope */
    memset(ways, 0, n * bytes);
    for (size_t k = 0; k < n; k++) {
        ways[k * n + k] = 1;
        find_way(state, ways + k * n);
        for (size_t i = 0; i < n; i++) ways[k * n + i] -= still[i];
    }
    memcpy(state->y + n, before, bytes);
    state_evaluate(state);
}

/* Is the misfit within rounding: of positions, or at least of the arms, or of the size of a contact? */
static bool is_home(const struct place *place, const struct misfit *left)
{
    const struct tree *tree = place->model->tree;
    int meeting = left->row < 0 ? -1 : tree->couplings[tree->coupling_of_row[left->row]].meeting;
    double touching = meeting < 0 ? 0 : meeting_rounding(place->model, place->at.tree, meeting);
    touching = fmax(touching, round_off(16, arm_length(place)));
    return left->position <= 1e3 * fmax(rounding(place), touching);
}

static bool bring_home(struct fbd_state *state, const struct place *place, double *before)
{
    size_t bytes = (size_t)state->model->plan.n * sizeof *state->y;
    double share = 1;
    prepare(place);
    slots_follow(place->model, place->at.tree); /* global search here, not in every evaluation */
    struct misfit misfit = misfit_of(place);
    for (int k = 0; k < most_steps && misfit.position > rounding(place); k++) {
        memcpy(before, state->y, bytes);
        factor(place, start_damping(place, misfit.position));
        move(place, false, share);
        prepare(place);
        struct misfit after = misfit_of(place);
        if (after.position < misfit.position) {
            slots_follow(place->model, place->at.tree);
            misfit = after;
            share = fmin(1, 2 * share);
            continue;
        }
        memcpy(state->y, before, bytes); /* too far: a shorter step, until there is none */
        prepare(place);
        if (misfit.position <= 64 * rounding(place) || share < 1e-4) break;
        share /= 4;
    }
    return is_home(place, &misfit);
}

/* Without sticking friction, which has no definite position: with it a body that penetrates its neighbour by
 * 1e-11 m would have to turn by the square root of that to get out. */
static bool settle_down(struct fbd_state *state, const struct place *place, double *before)
{
    place->at.tree->settling_down = true;
    bool there = bring_home(state, place, before);
    place->at.tree->settling_down = false;
    return there;
}

bool state_project_position(struct fbd_state *state)
{
    if (!tree_has_couplings(state->model->tree)) return true;
    struct place place = place_of(state, false);
    size_t n = (size_t)state->model->plan.n, bytes = n * sizeof *state->y;
    double *before = state_scratch(state).dy, *start = before + n;
    memcpy(start, state->y, bytes);
    look(&place);
    double off = fmax(misfit_of(&place).position, rounding(&place));
    bool there = bring_home(state, &place, before);
    if (change_since(&place, state->y, start, arm_length(&place)) <= far * off) return there;
    memcpy(state->y, start, bytes);
    return settle_down(state, &place, before);
}

bool state_project(struct fbd_state *state, bool assemble)
{
    if (!tree_has_couplings(state->model->tree)) return true;
    struct place place = place_of(state, assemble);
    bool there = settle_down(state, &place, state_scratch(state).dy);
    return state_project_velocity(state, assemble) && there;
}

/* ---- local: after a step or a stage of it
 *
 * Near a singular position a row has hardly any slope, and its residual does not show the error of the state:
 * rounding e of g is an error e / s, with s the slope relative to that elsewhere, and e / s^2 of velocities,
 * which depend on positions. Where that exceeds the accuracy of the state, or the error exceeds s, so that
 * the state may be on another branch, the state is not changed (Levenberg and Marquardt's damping of s^2;
 * Yamashita and Fukushima, Computing [Suppl] 15 (2001) 239, for damping in proportion to the residual). */

static double square(double x)
{
    return x * x;
}

static double position_damping(const struct place *place, double misfit, double length)
{
    double accuracy = place->at.tree->accuracy;
    double rounds = square(round_off(4, 1) / accuracy), other_branch = square(10 * accuracy);
    return fmin(1, fmax(fmax(rounds, other_branch), 4 * misfit / length));
}

static void bring_back(const struct place *place)
{
    enum { most_corrections = 12 };
    struct tree_work *work = place->at.tree;
    prepare(place);
    double length = arm_length(place), least = rounding(place), misfit = misfit_of(place).position;
    bool moved = false;
    for (int k = 0; k < most_corrections && misfit > least; k++) {
        double damping = position_damping(place, misfit, length);
        if (k == 0)
            factor(place, damping);
        else
            refactor(place, damping);
        move(place, false, 1);
        look(place);
        moved = true;
        double before = misfit;
        misfit = misfit_of(place).position;
        if (misfit > 0.9 * before) break;
    }
    if (moved) prepare(place);
    factor(place, fmin(1, round_off(4, 1) / work->accuracy));
    move(place, true, 1);
    release(place);
}

void return_to_constraints(const struct fbd_model *model, const struct instant *at, double *y)
{
    if (!is_constrained(model, at) || (at->tree->loop && tree_loop_return(at->tree->loop, y))) return;
    if (at->tree->loops && closed_loops_close(at->tree->loops, at->tree, model->plan.n, y)) return;
    struct instant here = *at;
    here.y = y;
    bring_back(&(struct place){model, here, y, .returning = true});
}
