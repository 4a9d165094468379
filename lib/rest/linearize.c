/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/linearize.h"

#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "dynamics/friction.h"
#include "dynamics/modes.h"
#include "dynamics/nonfinite.h"
#include "dynamics/project.h"
#include "dynamics/tree_driven.h"
#include "fbd_study.h"
#include "numeric/tolerances.h"
#include "rest/eigenvalues.h"
#include "rest/equilibrium.h"
#include "rest/independent.h"
#include "rest/start.h"

/* ---- conditions */

/* Are there dependent coordinates, by couplings or prescribed? */
static bool is_reduced(const struct fbd_model *model)
{
    bool driven = false;
    for (size_t i = 0; i < (size_t)model->plan.n; i++) driven |= coordinate_is_driven(model, i);
    return driven || tree_has_couplings(model->tree);
}

/* With a prescribed motion there is no state of rest, unless it is constant in time. */
static bool refuse_driven(const struct fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    for (size_t b = 0; b < model->body_count; b++) {
        if (model->bodies[b].drive < 0) continue;
        if (!expr_uses_time(model->bodies[b].source->motion.prescribed.expr)) continue;
        diag_add(errors, FBD_ERROR, "not-independent", model->bodies[b].source->motion.at,
                 "simulate it, from a start near the equilibrium",
                 "the motion of `%s` is prescribed: it is never at rest", model->bodies[b].name);
        return true;
    }
    return equilibrium_refuse_reels(model, errors);
}

/* Refuse friction that sticks at rest on a surface at rest; on a moving surface it slips, and its friction is
 * a force like others. Rolling bodies, and bodies on contacts, are held at their contact point and may rotate
 * about it. */
static bool refuse_sticking(const struct fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    const struct plan *plan = &model->plan;
    struct instant at = state_instant(state);
    for (size_t i = 0; i < plan->mode_count; i++) {
        const struct mode *mode = &plan->modes[i];
        double acceleration;
        if (!mode_is_joint_friction(mode)) continue;
        if (friction_surface_speed(mode, &at, &acceleration) != 0) continue;
        diag_add(errors, FBD_ERROR, "sticks", model->loads[mode->load].source->at,
                 "leave the friction out to see the motion about the balance of the other forces",
                 "`%s` has dry friction: at rest it sticks, and a body that sticks has no linear motion",
                 model->bodies[mode->body].name);
        return true;
    }
    return false;
}

/* ---- unilateral constraints at the equilibrium */

/* The largest force of a coupling, or the weight of all jointed bodies. */
static double size_of_forces(const struct fbd_state *state)
{
    const struct tree *tree = state->model->tree;
    double most = 0;
    for (int i = 1; i < tree->joined; i++) most += tree->links[i].mass;
    most *= vec_norm(state->model->scene->gravity);
    for (int j = 0; j < tree->row_count; j++) most = fmax(most, fabs(state->tree->rows[j].lambda));
    return most;
}

/* Closed ropes and contacts must have positive forces; a constraint at its limit has no linear motion. */
static bool refuse_limits(struct fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    const struct plan *plan = &model->plan;
    if (!tree_has_couplings(model->tree) || plan->mode_count == 0) return false;
    int *before = calloc(plan->mode_count, sizeof *before), at_limit = -1;
    if (!before) {
        diag_out_of_memory(errors);
        return true;
    }
    memcpy(before, state->slip, plan->mode_count * sizeof *before);
    bool settled = modes_settle(state, NULL);
    double size = size_of_forces(state);
    for (int i = 0; i < (int)plan->mode_count; i++) {
        const struct mode *hold = &plan->modes[i];
        bool held = mode_is_one_sided(hold) && state->slip[i] == stick;
        bool presses = !held || fabs(hold_row(state, hold)->lambda) > undecided_part * size;
        if (before[i] != state->slip[i] || !presses || !settled) at_limit = i;
    }
    free(before);
    if (at_limit < 0) return false;
    const struct mode *hold = &plan->modes[at_limit];
    struct pos at = hold->coupling >= 0
                        ? model->scene->constraints[model->tree->couplings[hold->coupling].constraint].at
                        : model->bodies[hold->body].source->at;
    diag_add(
        errors, FBD_ERROR, "at-limit", at,
        "start nearer to the equilibrium, or change the loads so that contacts stay closed",
        "at the equilibrium `%s` is at the limit between holding and giving way: to one side the motion is "
        "another than to the other",
        hold->coupling >= 0 ? model->tree->couplings[hold->coupling].name : model->bodies[hold->body].name);
    return true;
}

/* ---- derivatives */

static fbd_linearization *linearization_new(const struct fbd_model *model)
{
    size_t n = (size_t)model->plan.n, size = plan_size(&model->plan);
    fbd_linearization *linear = calloc(1, sizeof *linear);
    if (!linear) return NULL;
    *linear = (struct fbd_linearization){
        .model = model,
        .count = n,
        .size = size,
        .which = calloc(n + 1, sizeof(int)),
        .A = calloc(size * size + size + 1, sizeof(double)), /* df/dt behind it */
        .modes = calloc(size + 1, sizeof(fbd_mode)),
        .q = calloc(plan_rates(&model->plan) + 1, sizeof(double)),
    };
    for (size_t i = 0; linear->which && i < n; i++) linear->which[i] = (int)i;
    if (linear->which && linear->A && linear->modes && linear->q) return linear;
    fbd_linearization_free(linear);
    return NULL;
}

/* Data for the derivatives, and those at three positions. */
struct looking {
    struct fbd_linearization *linear;
    struct fbd_state *state;
    struct independent independent; /* with couplings */
    double *full;                   /* with couplings: the Jacobian of all coordinates, df/dt behind it */
    double *origin, *before, *beside, *there;
};

static void looking_free(struct looking *looking)
{
    independent_free(&looking->independent);
    free(looking->full);
    free(looking->origin);
}

static bool looking_new(struct looking *looking, struct fbd_linearization *linear, struct fbd_state *state)
{
    size_t n = (size_t)state->model->plan.n, size = plan_size(&state->model->plan);
    *looking = (struct looking){.linear = linear, .state = state};
    looking->origin = calloc(plan_rates(&state->model->plan) + 3 * n + 1, sizeof *looking->origin);
    if (!looking->origin) return false;
    looking->before = looking->origin + plan_rates(&state->model->plan);
    looking->beside = looking->before + n;
    looking->there = looking->beside + n;
    if (!is_reduced(state->model)) return true;
    looking->full = calloc(size * size + size + 1, sizeof *looking->full);
    return looking->full && independent_new(&looking->independent, state);
}

/* One row of A from that of the full Jacobian. */
static void reduce_row(const struct independent *independent, size_t own, const double *full, double *row)
{
    size_t n = independent->n, f = independent->count;
    for (size_t l = 0; l < f; l++)
        for (size_t j = 0; j < n; j++) {
            row[l] += full[j] * independent->way[j * f + l];
            row[f + l] += full[n + j] * independent->way[j * f + l];
        }
    for (size_t i = 0; i < own; i++) row[2 * f + i] = full[2 * n + i];
}

/* A of the independent coordinates and the user states from the full Jacobian. */
static void reduce(const struct looking *looking)
{
    const struct independent *independent = &looking->independent;
    const struct plan *plan = &looking->state->model->plan;
    size_t n = independent->n, f = independent->count, own = (size_t)plan->own, size = 2 * f + own,
           wide = plan_size(plan);
    double *A = looking->linear->A;
    memset(A, 0, size * size * sizeof *A);
    for (size_t k = 0; k < f; k++) {
        A[k * size + f + k] = 1;
        reduce_row(independent, own, looking->full + (n + (size_t)independent->which[k]) * wide,
                   A + (f + k) * size);
    }
    for (size_t i = 0; i < own; i++)
        reduce_row(independent, own, looking->full + (2 * n + i) * wide, A + (2 * f + i) * size);
}

/* Compute the Jacobian at the state, and the largest derivative of each acceleration by a coordinate. False
 * where the chosen coordinates are not independent. */
static bool slopes_at(struct looking *looking, double *most)
{
    struct fbd_state *state = looking->state;
    struct fbd_linearization *linear = looking->linear;
    size_t all = plan_size(&state->model->plan), f = linear->count;
    if (looking->full) {
        state_project(state, false);
        if (!independent_follow(&looking->independent, state)) return false;
    }
    struct instant at = state_instant(state);
    double *work = looking->full ? looking->full : linear->A;
    state_jacobian(state->model, &at, state->scratch, work, work + all * all);
    if (looking->full) reduce(looking);
    for (size_t i = 0; i < f; i++) {
        most[i] = 0;
        for (size_t j = 0; j < f; j++) most[i] = fmax(most[i], fabs(linear->A[(f + i) * linear->size + j]));
    }
    return true;
}

/* Where the derivative of a force vanishes at the equilibrium (f = -k x^3), Newton's method never reaches it
 * exactly, and the remaining derivative is no frequency: the limit is zero. Criterion: the derivative is much
 * smaller than at the start, and smaller than at a thousandth of the distance to it. */
static void drop_dying_slopes(const struct looking *looking, fbd_errors *errors)
{
    const double of_beside = 0.1;
    struct fbd_linearization *linear = looking->linear;
    size_t n = linear->count;
    for (size_t i = 0; i < n; i++) {
        double there = looking->there[i];
        if (!(there < vanishing_slope * looking->before[i] && there < of_beside * looking->beside[i]))
            continue;
        for (size_t j = 0; j < n; j++) linear->A[(n + i) * linear->size + j] = 0;
        linear->degenerate = true;
        diag_add(errors, FBD_WARNING, "degenerate-equilibrium", (struct pos){0, 0},
                 "the motion about it is not linear, however small: simulate it",
                 "the forces along `%s` have no slope at the equilibrium: it has no linear frequency",
                 linear->model->labels[linear->which[i]].name);
    }
}

static void refuse_singular(const struct fbd_model *model, fbd_errors *errors)
{
    if (!tree_has_couplings(model->tree)) return; /* prescribed coordinates alone are never singular */
    const struct coupling *coupling = &model->tree->couplings[0];
    diag_add(
        errors, FBD_ERROR, "not-independent", model->scene->constraints[coupling->constraint].at,
        "simulate it, from a start near the equilibrium",
        "at the equilibrium the couplings, `%s` among them, are in a singular position: they leave no clear "
        "number of degrees of freedom",
        coupling->name);
}

/* Choose the independent coordinates at the equilibrium, which is the state. */
static bool choose_coordinates(struct looking *looking, fbd_errors *errors)
{
    struct fbd_linearization *linear = looking->linear;
    struct independent *independent = &looking->independent;
    const struct tree *tree = linear->model->tree;
    if (!looking->full) return true;
    if (!independent_choose(independent, looking->state)) {
        refuse_singular(linear->model, errors);
        return false;
    }
    if (independent->count == 0) {
        const bool coupled = tree_has_couplings(linear->model->tree);
        struct pos at = coupled ? linear->model->scene->constraints[tree->couplings[0].constraint].at
                                : linear->model->bodies[0].source->motion.at;
        diag_add(errors, FBD_ERROR, "sticks", at, "leave out the friction or contact that holds it",
                 "nothing can move: %s`%s` among them, leave no freedom",
                 coupled ? "the couplings, " : "prescribed motions, that of ",
                 coupled ? tree->couplings[0].name : linear->model->bodies[0].name);
        return false;
    }
    linear->count = independent->count;
    linear->size = 2 * independent->count + (size_t)linear->model->plan.own;
    memcpy(linear->which, independent->which, independent->count * sizeof *linear->which);
    return true;
}

/* Copy [q, z] of the state to `place`, or back. */
static void move_place(struct fbd_state *state, double *place, bool back)
{
    size_t n = (size_t)state->model->plan.n, own = (size_t)state->model->plan.own;
    double *const ours[] = {state->y, state->y + 2 * n}, *const theirs[] = {place, place + n};
    const size_t counts[] = {n, own};
    for (int k = 0; k < 2; k++)
        memcpy(back ? ours[k] : theirs[k], back ? theirs[k] : ours[k], counts[k] * sizeof *place);
}

/* For a start that is the equilibrium: displace each independent coordinate by a small multiple of its size,
 * each by another one. */
static void step_aside(const struct independent *independent, double little, double *q)
{
    for (size_t k = 0; k < independent->count; k++) {
        size_t i = (size_t)independent->which[k];
        q[i] += little * independent->size[i] * (double)(k + 1) / (double)independent->count;
    }
}

/* The derivatives at the start, near the equilibrium, and at it, where the state stays. */
static bool look_around(struct looking *looking)
{
    struct fbd_state *state = looking->state;
    double *q = looking->linear->q, *from = looking->origin;
    move_place(state, from, true);
    slopes_at(looking, looking->before);
    bool away = false;
    for (size_t i = 0; i < plan_rates(&state->model->plan); i++) {
        away |= from[i] != q[i];
        from[i] = q[i] + near_equilibrium * (from[i] - q[i]);
    }
    if (!away) step_aside(&looking->independent, near_equilibrium, from);
    move_place(state, from, true);
    bool regular = slopes_at(looking, looking->beside); /* else the rank differs nearby */
    move_place(state, q, true);
    state_evaluate(state);
    return slopes_at(looking, looking->there) && regular; /* leaves the Jacobian in A */
}

/* Result as of find_matrix: 1, -1 out of memory, -2 the branches of expressions differ at the equilibrium. */
static int check_branches(const struct fbd_linearization *linear, const struct fbd_state *state,
                          fbd_errors *errors)
{
    size_t n = (size_t)state->model->plan.n;
    struct fbd_state *there = state_new(state->model);
    if (!there) return -1;
    state_copy(there, state);
    move_place(there, linear->q, true);
    memset(there->y + n, 0, n * sizeof *there->y);
    bool holds = equilibrium_holds(there), memory = there->holds.found != holds_no_memory;
    state_free(there);
    if (!memory) return -1;
    if (!holds) equilibrium_refuse(errors);
    return holds ? 1 : -2;
}

/* Find the equilibrium and A there; 1 found, 0 none near, -1 out of memory, -2 refused, with a message. */
static int find_matrix(struct fbd_linearization *linear, struct fbd_state *state, fbd_errors *errors)
{
    struct looking looking;
    bool made = looking_new(&looking, linear, state);
    if (made) move_place(state, looking.origin, false);
    int found = made ? equilibrium_search(state) : -1;
    if (found > 0) {
        move_place(state, linear->q, false);
        if (refuse_limits(state, errors) || !choose_coordinates(&looking, errors))
            found = -2;
        else if (!look_around(&looking)) {
            refuse_singular(state->model, errors);
            found = -2;
        } else
            drop_dying_slopes(&looking, errors);
    }
    if (found > 0) found = check_branches(linear, state, errors);
    if (found > 0 && looking.full) { /* ownership moves */
        linear->way = looking.independent.way;
        looking.independent.way = NULL;
    }
    looking_free(&looking);
    return found;
}

const char *linearization_name(const struct fbd_linearization *linear, size_t i)
{
    const struct fbd_model *model = linear->model;
    size_t f = linear->count;
    if (i >= 2 * f) return model->own_labels[i - 2 * f].name;
    const struct label *label = &model->labels[linear->which[i % f]];
    return i < f ? label->name : label->rate_name;
}

/* Are the equilibrium, and all entries of A, finite? */
static bool is_finite(const struct fbd_linearization *linear, struct fbd_state *state, fbd_errors *errors)
{
    size_t size = linear->size;
    if (!start_question(state, true, place_found, errors)) return false;
    for (size_t i = 0; i < size * size; i++) {
        if (isfinite(linear->A[i])) continue;
        size_t row = i / size, f = linear->count;
        diag_add(errors, FBD_ERROR, "not-finite", (struct pos){0, 0}, NULL,
                 "at the equilibrium the slope of %s `%s` with `%s` is not finite: %s",
                 row < 2 * f ? "the acceleration along" : "the rate of",
                 linearization_name(linear, row < 2 * f ? row % f : row),
                 linearization_name(linear, i % size), nonfinite_reason(linear->A[i]));
        return false;
    }
    return true;
}

/* `found` is 0 where there is no equilibrium, or with `balanced` no eigenvalues; else memory is out. */
static void note_failure(const struct fbd_model *model, bool settled, int found, bool balanced,
                         fbd_errors *errors)
{
    struct pos nowhere = {0, 0};
    if (!settled)
        diag_add(errors, FBD_ERROR, "unsettled", nowhere, "look from another state, with --at",
                 "at the start no choice of branches agrees with the forces");
    else if (found != 0)
        diag_out_of_memory(errors);
    else if (balanced)
        diag_add(errors, FBD_ERROR, "not-finite", nowhere, NULL,
                 "the eigenvalues of the motion about the equilibrium (`%s`, ...) are not found, or not "
                 "finite: its slopes are too far apart",
                 model->labels[0].name);
    else
        diag_add(errors, FBD_ERROR, "no-equilibrium", nowhere,
                 "start nearer to it: set the initial values, or give --at",
                 "no equilibrium was found near the start");
}

/* Keep the equilibrium for derivatives by inputs. */
static bool keep_state(struct fbd_linearization *linear, const struct fbd_state *state)
{
    const size_t n = (size_t)linear->model->plan.n;
    linear->state = state_new(linear->model);
    if (!linear->state) return false;
    state_copy(linear->state, state);
    move_place(linear->state, linear->q, true);
    memset(linear->state->y + n, 0, n * sizeof *linear->state->y);
    return true;
}

static fbd_linearization *linearize(fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    diag_in_file(errors, model->scene->file);
    size_t n = (size_t)model->plan.n;
    if (model->plan.mode_count > 0 || tree_has_couplings(model->tree)) /* the modes are those at rest */
        memset(state->y + n, 0, n * sizeof *state->y);
    bool settled = modes_settle(state, NULL);
    if (!start_question(state, settled, "the start", errors) || refuse_driven(state, errors) ||
        refuse_sticking(state, errors) || equilibrium_refuse_states(state, errors))
        return NULL;
    fbd_linearization *linear = linearization_new(model);
    if (linear) linear->degrees = state->degrees;
    int found = linear && settled ? find_matrix(linear, state, errors) : -1;
    bool said = found == -2 || (found > 0 && !is_finite(linear, state, errors));
    int modes = found > 0 && !said ? eigenvalues_find(linear->size, linear->A, linear->modes) : -1;
    if (modes > 0 && !keep_state(linear, state)) modes = -1;
    if (modes > 0) return linear;
    if (!said) note_failure(model, settled, found > 0 ? modes : found, found > 0, errors);
    fbd_linearization_free(linear);
    return NULL;
}

fbd_linearization *fbd_linearize(fbd_state *state, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_linearization *linear = state ? linearize(state, errors) : api_refuse(errors, "there is no state");
    diag_end(&call);
    return linear;
}

void fbd_linearization_free(fbd_linearization *linearization)
{
    if (!linearization) return;
    free(linearization->which);
    free(linearization->way);
    free(linearization->A);
    free(linearization->modes);
    free(linearization->q);
    state_free(linearization->state);
    free(linearization);
}

const fbd_model *fbd_linearization_model(const fbd_linearization *linearization)
{
    return linearization ? linearization->model : NULL;
}

size_t fbd_linearization_size(const fbd_linearization *linearization)
{
    if (!linearization) return 0;
    return linearization->size;
}

const double *fbd_linearization_matrix(const fbd_linearization *linearization)
{
    if (!linearization) return NULL;
    return linearization->A;
}

size_t fbd_linearization_coordinate(const fbd_linearization *linearization, size_t index)
{
    bool there = linearization && index < linearization->count;
    return there ? (size_t)linearization->which[index] : (size_t)-1;
}

fbd_mode fbd_linearization_mode(const fbd_linearization *linearization, size_t index)
{
    return linearization && index < linearization->size ? linearization->modes[index]
                                                        : (fbd_mode){NAN, NAN, NAN, NAN};
}
