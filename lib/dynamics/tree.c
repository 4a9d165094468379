/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The recursion as a whole, with closed loops and friction that depends on the forces in the joints.
 */
#include "dynamics/tree.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "dynamics/closed_loops.h"
#include "dynamics/friction.h"
#include "dynamics/journals.h"
#include "dynamics/plane_friction.h"
#include "dynamics/tree_bare.h"
#include "dynamics/tree_system.h"
#include "numeric/tolerances.h"

/* ---- memory */

/* The number of doubles behind the structures. */
static size_t doubles_of(const struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    size_t borne = tree->meeting_count > 0 ? (size_t)tree->count : 0;
    return 4 * tree->envelope_size + 9 * (size_t)tree_unknowns(tree) + 5 * (size_t)model->plan.n + borne;
}

static size_t pushes_of(const struct tree *tree)
{
    size_t count = 0;
    for (int i = 0; i < tree->coupling_count; i++)
        count += (size_t)tree->couplings[i].row_count * (size_t)tree_path_size(tree, &tree->couplings[i]);
    return count;
}

/* Numbers of pieces that only jointed bodies need, only a system of unknowns, and only a loop. */
static size_t bare_count(const struct tree *tree)
{
    return tree_joins(tree) ? (size_t)tree->count : 0;
}

static size_t sum_count(const struct tree *tree)
{
    return tree_unknowns(tree) > 0 ? (size_t)tree->count : 0;
}

static size_t loop_count(const struct fbd_model *model)
{
    return tree_loop_may_be(model) ? 1 : 0;
}

static size_t loops_size(const struct fbd_model *model)
{
    size_t size = closed_loops_size(model);
    return size > 0 ? sizeof(struct closed_loops) + size : 0;
}

size_t tree_work_size(const struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    size_t links = (size_t)tree->count, unknowns = (size_t)tree_unknowns(tree);
    size_t chains = links + most_constraint_ends * unknowns;
    size_t lives = (size_t)model->scene->lifetime_count;
    size_t ints = (links + 5 * unknowns + (size_t)tree->coupling_count + chains + lives + 3) / 2 * 2;
    size_t link = sizeof(struct tree_state) + sizeof(struct tree_rhs) + sizeof(struct tree_variation);
    return links * link + sum_count(tree) * sizeof(struct tree_rhs) +
           bare_count(tree) * sizeof(struct tree_bare) + loop_count(model) * sizeof(struct tree_loop) +
           loops_size(model) + (size_t)tree->row_count * sizeof(struct row) +
           (size_t)tree->coupling_count * sizeof(struct coupling_state) +
           pushes_of(tree) * sizeof(struct tree_push) + doubles_of(model) * sizeof(double) +
           unknowns * sizeof(size_t) + ints * sizeof(int);
}

static void start_lives(const struct fbd_model *model, int *life)
{
    const struct scene *scene = model->scene;
    for (size_t i = 0; i < model->load_count; i++) {
        const struct lifetime *lifetime = &model->loads[i].source->lifetime;
        if (lifetime->begins) life[lifetime->number - 1] = life_waits;
    }
    for (size_t i = 0; i < scene->constraint_count; i++) {
        const struct lifetime *lifetime = &scene->constraints[i].lifetime;
        if (lifetime->begins) life[lifetime->number - 1] = life_waits;
    }
}

/* Set the numbers of links that are constant. */
static void start_links(const struct tree *tree, struct tree_state *links)
{
    links[0].turn = links[0].e = (struct vec){1, 0};
    for (int i = 1; i < tree->count; i++) {
        struct tree_state *s = &links[i];
        s->mass = tree->links[i].mass;
        s->I_O = tree->links[i].I_O;
        s->across = tree->links[i].across;
        if (link_is_alone(tree, i)) tree_begin_alone(&tree->links[i], s);
    }
}

void tree_work_init(struct tree_work *work, const struct fbd_model *model, void *memory)
{
    const struct tree *tree = model->tree;
    size_t links = (size_t)tree->count, unknowns = (size_t)tree_unknowns(tree), n = (size_t)model->plan.n;
    work->links = memory;
    work->x = (struct tree_rhs *)(work->links + links);
    work->sum = work->x + links;
    work->variation = (struct tree_variation *)(work->sum + sum_count(tree));
    work->bare = (struct tree_bare *)(work->variation + links);
    struct tree_loop *loop = (struct tree_loop *)(work->bare + bare_count(tree));
    struct closed_loops *loops = (struct closed_loops *)(loop + loop_count(model));
    work->rows = (struct row *)((char *)loops + loops_size(model));
    work->couplings = (struct coupling_state *)(work->rows + tree->row_count);
    work->pushes = (struct tree_push *)(work->couplings + tree->coupling_count);
    work->lower = (double *)(work->pushes + pushes_of(tree));
    work->upper = work->lower + tree->envelope_size;
    work->diagonal = work->upper + tree->envelope_size;
    work->inverse = work->diagonal + unknowns;
    work->z = work->inverse + unknowns;
    work->whole = work->z + unknowns;
    work->right = work->whole + 2 * tree->envelope_size;
    work->rest = work->right + unknowns;
    work->unit = work->rest + unknowns;
    work->a = work->unit + n;
    work->a_along = work->a + n;
    work->taken = work->a_along + n;
    work->scale = work->taken + n;
    work->ordered = work->scale + unknowns;
    work->wanted = work->ordered + unknowns;
    work->left = work->wanted + unknowns;
    work->sum_unit = work->left + unknowns;
    work->borne = work->sum_unit + n;
    void *behind = work->borne + (tree->meeting_count > 0 ? links : 0);
    work->envelope = behind;
    behind = work->envelope + unknowns;
    work->mark = behind;
    work->unknown_at = work->mark + links;
    work->first = work->unknown_at + unknowns;
    work->place = work->first + unknowns;
    work->rank = work->place + unknowns;
    work->push_end = work->rank + unknowns;
    work->acting = work->push_end + tree->row_count + 1;
    work->newest = work->acting + tree->coupling_count;
    work->older = work->newest + links;
    work->life = work->older + most_constraint_ends * unknowns;
    start_lives(model, work->life);
    if (loop_count(model) > 0 && tree_loop_find(model, loop)) work->loop = loop;
    if (loops_size(model) > 0 && !work->loop) {
        work->loops = loops;
        closed_loops_init(loops, model, loops + 1);
    }
    work->damping = projection_damping;
    work->accuracy = solved_rounding;
    start_links(tree, work->links);
}

/* ---- results */

/* Add the accelerations of jointed links and the wrenches of their joints to the present ones. */
static void add_result(const struct tree *tree, struct tree_work *work)
{
    for (int i = 1; i < tree->joined; i++) {
        struct tree_state *s = &work->links[i];
        const struct tree_rhs *x = &work->x[i];
        struct wrench F = inertia_wrench(&s->I, x->A, x->p);
        s->A.alpha += x->A.alpha;
        s->A.a = vec_add(s->A.a, x->A.a);
        s->F.moment += F.moment;
        s->F.force = vec_add(s->F.force, F.force);
    }
}

void tree_complete(const struct fbd_model *model, struct tree_work *work)
{
    if (work->complete) return;
    for (int i = 0; i < model->tree->joined; i++) work->links[i].F = (struct wrench){0, {0, 0}};
    add_result(model->tree, work);
    work->complete = true;
}

static void set_strands(const struct fbd_model *model, const struct tree_work *work, int index, double *slots)
{
    double tension[2];
    belt_tensions(model, work, index, tension);
    for (int k = 0; k < 2; k++) slots[model->tree->couplings[index].slack_slot[k]] = -tension[k];
}

void tree_link_slots(const struct fbd_model *model, const struct instant *at, int i, double *slots)
{
    const struct tree_link *link = &model->tree->links[i];
    const struct tree_state *s = &at->tree->links[i];
    if (link->normal_slot >= 0)
        slots[link->normal_slot] = -vec_dot(tree_normal(model->tree, at->tree, i), s->F.force);
    if (link->pair >= 0)
        slots[model->plan.modes[link->pair].hold_slot] = slots[link->coordinate] - joint_share(link, s, s->F);
}

void tree_coupling_slots(const struct fbd_model *model, const struct instant *at, int index, double *slots)
{
    const struct coupling *coupling = &model->tree->couplings[index];
    const struct row *rows = at->tree->rows;
    if (coupling->strands > 0) set_strands(model, at->tree, index, slots);
    if (coupling_has_normal(coupling)) slots[coupling->normal_slot] = -rows[coupling->first_row].lambda;
    if (coupling->kind == constraint_plane)
        slots[model->plan.modes[coupling->pair].hold_slot] =
            -hypot(rows[coupling->first_row].lambda, rows[coupling->first_row + 1].lambda);
    else if (coupling_rubs(coupling))
        slots[model->plan.modes[coupling->pair].hold_slot] = -rows[coupling->along_row].lambda;
}

void tree_slots(const struct fbd_model *model, const struct instant *at, double *slots)
{
    const struct tree *tree = model->tree;
    for (int k = 0; k < tree->joined_watched; k++) tree_link_slots(model, at, tree->watched[k], slots);
    for (int i = 0; i < tree->coupling_count; i++) tree_coupling_slots(model, at, i, slots);
}

void tree_add_unit(const struct tree *tree, const struct tree_work *work, double *a)
{
    for (int i = 1; i < tree->count; i++) {
        int first = tree->links[i].coordinate, count = joint_freedom(tree->links[i].kind);
        for (int k = first; k < first + count; k++) a[k] += work->unit[k];
    }
}

/* ---- modes */

/* Set which joints stick, and the accelerations of their surfaces. */
static void lock(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    for (int k = 0; k < tree->joined_watched; k++) {
        const struct tree_link *link = &tree->links[tree->watched[k]];
        struct tree_state *s = &at->tree->links[tree->watched[k]];
        s->locked = link->pair >= 0 && at->slip[link->pair] == stick;
        if (s->locked) friction_surface_speed(&model->plan.modes[link->pair], at, &s->held);
    }
}

/* Set the generalized forces in the joints, including dry friction in bearings. */
static void set_joint_forces(const struct fbd_model *model, const struct instant *at, const double *slots)
{
    const struct tree *tree = model->tree;
    const struct tree_state *links = at->tree->links;
    struct tree_rhs *x = at->tree->x;
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_link *link = &tree->links[i];
        const double *own = slots + link->coordinate;
        if (joint_freedom(link->kind) == 1) {
            x[i].g = own[0];
        } else {
            x[i].gf = vec_turn(links[i].e, (struct vec){own[0], own[1]});
            x[i].g = link->kind == motion_planar ? own[2] : 0;
        }
    }
    for (int k = 0; k < tree->joined_watched; k++) {
        const struct tree_link *link = &tree->links[tree->watched[k]];
        if (link->pair >= 0 && link->kind == motion_pivot && !link->journal && at->slip[link->pair] != stick)
            x[tree->watched[k]].g -=
                slip_side(at->slip[link->pair]) * formula_value(&model->plan.modes[link->pair].mu_k, at);
    }
}

/* Set the values of all links of a coupling to the largest one, or to its own. */
static void spread_borne(const struct tree *tree, struct tree_work *work, const struct coupling *coupling)
{
    double most = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int j = coupling->first_row; j < coupling->first_row + coupling->row_count; j++) {
            const struct row *row = &work->rows[j];
            for (int k = 0; row->lambda != 0 && k < row->port_count; k++) {
                const struct port *port = &row->ports[k];
                double *borne = &work->borne[port->link];
                if (port->link == 0) continue;
                double own = fabs(row->lambda) * vec_norm(port->force) / tree->links[port->link].mass;
                most = fmax(most, fmax(own, *borne));
                *borne = fmax(*borne, most);
            }
        }
}

/* The lowest body of a pile has forces from all above it, which cancel up to rounding. Two passes reach all
 * bodies of a pile, if contacts are numbered along it, as is usual; otherwise some value is too small. */
static void set_borne(const struct tree *tree, struct tree_work *work)
{
    for (int i = 0; i < tree->count; i++) work->borne[i] = 0;
    for (int k = 0; k < work->acting_count; k++) spread_borne(tree, work, &tree->couplings[work->acting[k]]);
    for (int k = work->acting_count; k-- > 0;) spread_borne(tree, work, &tree->couplings[work->acting[k]]);
}

/* Set accelerations of bodies at rest on others to zero if they are within rounding. No step would be short
 * enough for them, as there is no motion as a scale of errors. Their rounding grows with the number of
 * contact forces, and once more along a pile, where each body rotates slightly relative to the one below:
 * with the square of the number, times the acceleration by one force. */
static void drop_rounding(const struct tree *tree, struct tree_work *work, double *a)
{
    const double count = tree->count, rounding = round_off(64, count), sums = round_off(count, count);
    set_borne(tree, work);
    for (int i = 1; i < tree->count; i++) {
        const struct tree_link *link = &tree->links[i];
        if (link->kind != motion_planar) continue;
        const double *unit = work->unit + link->coordinate;
        double *own = a + link->coordinate, radius = sqrt(link->I_O / link->mass);
        double net = fmax(hypot(unit[0], unit[1]), radius * fabs(unit[2]));
        double least = rounding * net + sums * work->borne[i];
        if (hypot(own[0], own[1]) <= least && radius * fabs(own[2]) <= least) own[0] = own[1] = own[2] = 0;
    }
}

/* The accelerations of the links without multipliers. */
static void add_accelerations(const struct tree *tree, struct tree_work *work)
{
    for (int i = 1; i < tree->joined; i++) {
        struct tree_state *s = &work->links[i];
        s->A.alpha += work->x[i].A.alpha;
        s->A.a = vec_add(s->A.a, work->x[i].A.a);
    }
}

/* Solve for the multipliers, given the accelerations without them, for fixed directions of journals. */
static void solve_directed(const struct fbd_model *model, const struct instant *at, const double *a)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++) work->z[j] = -work->rows[j].g.x2;
    for (int k = 0; k < tree->pair_count; k++) {
        int i = tree->pairs[k];
        double N = vec_dot(tree_normal(tree, work, i), work->links[i].F.force);
        work->z[tree->row_count + k] = -tree_slip_share(model, at, i) * N;
    }
    tree_want_massless(tree, work, a, work->z);
    tree_system_factor(model, at);
    tree_system_solve(model, at, work->z);
}

/* The same, with the directions of the resulting reactions. Where there are none the result is no number. */
static void solve_system(const struct fbd_model *model, const struct instant *at, const double *a)
{
    enum { most_passes = 60 };
    const struct tree *tree = model->tree;
    bool turns = tree->journal_count > 0;
    if (turns) journals_aim(tree, at->tree);
    solve_directed(model, at, a);
    for (int pass = 0; turns && (turns = journals_turn(tree, at)) && pass < most_passes; pass++)
        solve_directed(model, at, a);
    if (turns) at->tree->unit[tree->links[tree->pairs[0]].coordinate] = (double)NAN;
}

/* Add the forces of constraints and of slipping slides. */
static void close_system(const struct fbd_model *model, const struct instant *at, double *a)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    const bool free = tree->watched_count + tree->pair_count == 0 && tree_rows_are_idle(tree, at) &&
                      !tree_lacks_inertia(tree, work);
    constraints_select(tree, at);
    if (free) {
        tree_system_empty(model, work);
    } else {
        if (work->rates_only)
            constraints_evaluate_acting(model, at);
        else
            constraints_evaluate(model, at, NULL);
        solve_system(model, at, a);
    }
    tree_take_multipliers(model, at);
    tree_add_unit(tree, work, a); /* where it is zero: no negative zeros */
    if (!free && tree->meeting_count > 0) drop_rounding(tree, work, a);
    if (work->rates_only) return;
    if (!free) add_result(tree, work);
    constraints_evaluate(model, at, NULL); /* with the resulting accelerations */
}

/* Those of jointed links. */
static void accelerate_joined(const struct fbd_model *model, const struct instant *at, const double *slots,
                              double *a)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    lock(model, at);
    if (!at->moved) tree_move_joined(model, at);
    tree_bias(tree, at, model->plan.n);
    tree_load(tree, at, &tree->joined_loads);
    if (tree->plane_count > 0) planes_load(model, at);
    if (tree->bulk_count > 0) tree_weights(tree, at);
    set_joint_forces(model, at, slots);
    tree_factor(tree, work);
    tree_outward(tree, work, 1, tree->joined, a);
}

/* Constraints, friction that depends on forces in the joints, and joints that stick. */
static void constrain(const struct fbd_model *model, const struct instant *at, double *slots, double *a)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    if (work->rates_only && tree->joined_watched == 0)
        add_accelerations(tree, work);
    else
        tree_complete(model, work);
    if (tree->coupling_count > 0 || tree_slips(tree, at) || tree_lacks_inertia(tree, work))
        close_system(model, at, a);
    bool holds = tree->plane_count > 0 && planes_stick(tree, at);
    for (int k = 0; k < tree->joined_watched; k++) {
        const struct tree_state *s = &work->links[tree->watched[k]];
        if (!s->locked) continue;
        a[tree->links[tree->watched[k]].coordinate] = s->held;
        holds = true;
    }
    if (holds) tree_rest(model, at, false, a);
    if (work->rates_only) return;
    if (tree->journal_count > 0) journals_aim(tree, work);
    tree_slots(model, at, slots);
}

void tree_accelerations(const struct fbd_model *model, const struct instant *at, double *slots, double *a)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    if (tree_joins(tree)) accelerate_joined(model, at, slots, a);
    for (int i = tree->joined; i < tree->count; i++) tree_accelerate_alone(model, at, i, slots, a);
    work->complete = work->shared = false;
    work->fastest = -1;
    if (tree->joined_watched + tree->coupling_count + tree->massless_count > 0)
        constrain(model, at, slots, a);
}
