/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Evaluation of event functions, at instants and over intervals of time, on the dense output of the last
 * step.
 */
#include <gsl/gsl_errno.h>
#include <string.h>

#include "dynamics/world_refs.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

static int sample_timed(void *context, double t, const bool *asked, double *values, double *rate)
{
    struct run *run = context;
    watchers_evaluate(&run->watchers, &run->watchers.timed, run->during, time_dd_at(t), run->state->y, asked,
                      values, rate);
    return 0;
}

/* Does the surface prescribe the velocity of a sticking pair? Such velocities, and drives, are imposed at
 * every sample as at the ends of steps (modes_hold): the dense output satisfies them only to the error of the
 * method, and the sign of the difference would be random. */
static bool leads(const struct run *run, size_t pair)
{
    const struct mode *mode = &run->model->plan.modes[pair];
    return mode->surface_speed.expr && mode->coupling < 0 && run->during->slip[pair] == stick;
}

static bool any_leads(const struct run *run)
{
    for (size_t i = 0; i < run->model->plan.mode_count; i++)
        if (leads(run, i)) return true;
    return false;
}

/* Does impose_drives change anything? */
static bool is_led(const struct run *run)
{
    bool led = false;
    for (size_t i = 0; run->search.leads && i < run->model->plan.mode_count; i++)
        led |= run->model->plan.modes[i].kind == mode_drive || leads(run, i);
    return led;
}

void impose_drives(const struct run *run, double t, double *y)
{
    const struct plan *plan = &run->model->plan;
    double acceleration;
    for (size_t i = 0; run->search.leads && i < plan->mode_count; i++) {
        const struct mode *mode = &plan->modes[i];
        bool drives = mode->kind == mode_drive; /* drives always stick */
        if (!drives && !leads(run, i)) continue;
        struct instant at = state_instant_at(run->during, t, y);
        if (drives) y[mode->coordinate] = formula_value(&mode->position, &at);
        if ((drives && run->search.leads_speeds) || leads(run, i))
            y[plan->n + mode->coordinate] = friction_surface_speed(mode, &at, &acceleration);
    }
}

/* The state along the last step. */
static int sample_state(struct run *run, double t, double *y)
{
    if (switcher_dense(run->stepper, time_dd_at(t), y) != GSL_SUCCESS) return -1;
    impose_drives(run, t, y);
    return 0;
}

static int sample_moving(void *context, double t, const bool *asked, double *values, double *rate)
{
    struct run *run = context;
    if (sample_state(run, t, run->work.sample)) return -1;
    watchers_evaluate(&run->watchers, &run->watchers.moving, run->during, time_dd_at(t), run->work.sample,
                      asked, values, rate);
    return 0;
}

/* Work of the dense output where it is made by further steps: a Jacobian counts as many right-hand sides as
 * it has columns. */
static unsigned long work_so_far(void *context)
{
    const struct counted_system *system = &((const struct run *)context)->system;
    return system->rhs + system->jacobians * (unsigned long)system->inner.dimension;
}

static void enclose_timed(void *context, size_t group, const struct stretch *stretch, struct enclosure *out)
{
    struct run *run = context;
    watchers_enclose(&run->watchers, &run->watchers.timed, group, run->during, stretch, NULL, out);
}

/* Functions that are affine in the modes of the step, by their polynomials. */
static bool enclose_affine(struct run *run, size_t group, const struct stretch *stretch,
                           struct enclosure *out)
{
    const struct root_group *those = &run->watchers.moving.groups[group];
    struct affine *f = run->watchers.affine + those->first;
    for (size_t i = 0; i < those->count; i++)
        if (!f[i].known || !affine_enclose(&f[i], &run->trajectory, stretch, &out[i])) return false;
    return true;
}

static double zero_of_affine(void *context, size_t i, double low, double high)
{
    struct run *run = context;
    return affine_zero(&run->watchers.affine[i], &run->trajectory, low, high);
}

static void enclose_moving(void *context, size_t group, const struct stretch *stretch, struct enclosure *out)
{
    struct run *run = context;
    bool affine = run->trajectory.exact && run->watchers.any_affine;
    if (affine && enclose_affine(run, group, stretch, out)) return;
    /* In a Filippov sliding mode forces are coupled to components that other groups read. */
    const bool *wanted =
        state_sliding(run->during) ? NULL : run->search.reads + group * run->trajectory.count;
    trajectory_enclose(&run->trajectory, stretch, wanted);
    watchers_enclose(&run->watchers, &run->watchers.moving, group, run->during, stretch, run->trajectory.now,
                     out);
}

/* A component behind the state that does not vary within a run: an input that is set between steps. */
static bool is_input(const struct run *run, size_t component)
{
    return slot_is_constant(run->model, (int)component + 1);
}

static double input_of(const struct run *run, size_t component)
{
    const size_t index = component - plan_size(&run->model->plan) - hand_slots;
    return run->during->held[run->model->absolutes[index].coordinate];
}

/* The state along the last step with the inputs and world positions used by expressions. */
static int sample_course(void *context, double t, double *y)
{
    struct run *run = context;
    const struct fbd_state *during = run->during;
    if (sample_state(run, t, y)) return -1;
    for (size_t k = 0; k < run->trajectory.count; k++) {
        const size_t component = (size_t)run->trajectory.component[k];
        if (is_input(run, component)) y[component] = input_of(run, component);
    }
    if (!run->search.follows_places) return 0;
    struct instant at = state_instant_at(during, t, y);
    at = instant_extend(run->model, &at);
    memcpy(y, at.y, extended_size(run->model) * sizeof *y);
    return 0;
}

/* The largest distance of the jointed bodies from the origin, and their largest speed over the last step. */
static double measure(const struct run *run, double *speed)
{
    const struct tree *tree = run->model->tree;
    double reach = 0;
    *speed = 0;
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_state *link = &run->state->tree->links[i];
        double arm = vec_norm(link->mr) / tree->links[i].mass;
        reach = fmax(reach, vec_norm(link->p) + arm);
        *speed = fmax(*speed, vec_norm(link->v) + fabs(link->omega) * arm);
    }
    double fastest = 0;
    size_t n = (size_t)run->model->plan.n;
    for (size_t i = 0; i < n; i++)
        fastest =
            fmax(fastest, fabs(run->work.f[n + i]) * (run->model->scene->coordinates[i].angle ? reach : 1));
    *speed += fastest * run->step.h;
    return reach;
}

/* Couplings keep coordinates at zero, or at rest, to the rounding of the positions and speeds of the bodies
 * that they join. Components that start as a high power of time are negligible at first (roundoff.c). The
 * sign of such a number is arbitrary, like that of an error. */
static void set_noise(struct run *run)
{
    const double roundings = round_off(64, 1), error = 0.1 * run->options.tolerance;
    const struct scene *scene = run->model->scene;
    size_t n = (size_t)run->model->plan.n, own = plan_size(&run->model->plan);
    for (size_t k = 0; k < run->trajectory.count; k++) {
        size_t i = (size_t)run->trajectory.component[k];
        if (i < own) run->trajectory.noise[k] = fmax(error, round_off(1, 1)) * run->roundoff.nothing[i];
    }
    if (run->model->tree->coupling_count == 0) return;
    double speed, reach = measure(run, &speed);
    for (size_t k = 0; k < run->trajectory.count && reach > 0; k++) {
        size_t i = (size_t)run->trajectory.component[k];
        if (i >= 2 * n) continue;
        double size = i < n ? reach : speed;
        double noise = roundings * (scene->coordinates[i % n].angle ? size / reach : size);
        run->trajectory.noise[k] = fmax(run->trajectory.noise[k], noise);
    }
}

static int powers_of(void *context, double from, double to, int component, double *c)
{
    const struct run *run = context;
    if (is_input(run, (size_t)component)) {
        c[0] = input_of(run, (size_t)component);
        return 0;
    }
    return switcher_powers(run->stepper, time_dd_at(from), time_dd_at(to), (size_t)component, c);
}

static int powers_of_ends(void *context, double from, double to, int component, double *c)
{
    const struct run *run = context;
    if (is_input(run, (size_t)component)) return powers_of(context, from, to, component, c);
    return switcher_powers_of_ends(run->stepper, time_dd_at(from), time_dd_at(to), (size_t)component, c);
}

/* Use the power series of the method; for a first search with functions that are costly, that of the ends of
 * the step alone. False where it has none, or the motion includes prescribed motions or world positions. */
static bool follow_powers(struct run *run, double from, double to, bool coarse, const bool *wanted)
{
    struct trajectory *trajectory = &run->trajectory;
    if (run->search.follows_places || is_led(run)) return false;
    if (coarse && trajectory_set_powers(trajectory, from, to, wanted, true, powers_of_ends, run)) return true;
    return trajectory_set_powers(trajectory, from, to, wanted, false, powers_of, run);
}

/* Compute polynomials of the wanted components; returns the end of the interval, NAN where the motion is not
 * available. */
static double follow(struct run *run, double from, double to, bool coarse, const bool *wanted)
{
    enum { simple = 6 };
    double negligible;
    int degree = switcher_degree(run->stepper, &negligible);
    if (run->search.follows_places || any_leads(run)) { /* functions of the motion, not polynomials */
        negligible = fmax(negligible, negligible_part);
        degree = trajectory_most_degree;
    }
    set_noise(run);
    coarse = coarse && degree > simple && run->options.step == 0 && !run_is_exact(run);
    if (follow_powers(run, from, to, coarse, wanted)) return to;
    int status =
        coarse ? trajectory_set_coarse(&run->trajectory, from, to, wanted, sample_course, run)
               : trajectory_set(&run->trajectory, from, to, wanted, degree, negligible, sample_course, run);
    return status ? NAN : run->trajectory.to;
}

/* The components of the groups that are still searched; NULL (all) in a Filippov sliding mode: see
 * enclose_moving. */
static const bool *find_wanted(struct run *run)
{
    const struct watcher_set *set = &run->watchers.moving;
    const bool *reads = run->search.reads;
    bool *wanted = run->search.wanted;
    size_t count = run->trajectory.count;
    if (state_sliding(run->during)) return NULL;
    memset(wanted, 0, count * sizeof *wanted);
    for (size_t g = 0; g < set->group_count; g++, reads += count)
        for (size_t k = 0; set->groups[g].open && k < count; k++) wanted[k] |= reads[k];
    return wanted;
}

static double follow_course(void *context, double from, double to, bool coarse)
{
    struct run *run = context;
    return follow(run, from, to, coarse, find_wanted(run));
}

/* ---- panels for sampled functions */

/* Formula `index` of forces and frictions; NULL after the last. */
static const struct formula *paced_formula(const struct fbd_model *model, size_t index)
{
    size_t loads = model->load_count, frictions = model->plan.mode_count;
    enum { each = 6 };
    if (index < each * loads) {
        const struct model_load *load = &model->loads[index / each];
        const struct formula *all[] = {&load->value, &load->angle,     &load->fx,
                                       &load->fy,    &load->potential, &load->couple};
        return all[index % each];
    }
    index -= each * loads;
    if (index >= 4 * frictions) return NULL;
    const struct mode *mode = &model->plan.modes[index / 4];
    const struct formula *all[] = {&mode->mu_s, &mode->mu_k, &mode->surface_speed, &mode->position};
    return all[index % 4];
}

/* An upper bound of the phase in radians of a formula: its fastest rate over half of its range; for a narrow
 * peak that of its flanks. Near an extremum C - b u^2 it is four at any distance: so the range is at least a
 * small multiple of C, or panels would get shorter towards each extremum without limit. */
static double radians_of(const struct run *run, const struct formula *formula, const struct stretch *stretch)
{
    const double nothing = 1e-7;
    const int *branch = formula->branch < 0 ? NULL : run->during->branch + formula->branch;
    struct enclosure f = expr_enclose(formula->expr, stretch, run->trajectory.now, branch);
    double range = interval_width(f.value), turn = interval_size(f.rate) * (stretch->to - stretch->from);
    if (!(range < HUGE_VAL && turn < HUGE_VAL)) return HUGE_VAL;
    range = fmax(range, nothing * interval_size(f.value));
    return range > 0 ? 2 * turn / range : 0;
}

/* The size of component i of the trajectory, for a scene of size `reach` and speed `speed`. */
static double size_of(const struct run *run, size_t i, double reach, double speed)
{
    const struct fbd_model *model = run->model;
    size_t n = (size_t)model->plan.n, all = plan_size(&model->plan);
    if (i < 2 * n) {
        double size = i < n ? reach : speed;
        return model->scene->coordinates[i % n].angle ? size / reach : size;
    }
    if (i < all) return 0; /* a user state, of unknown size */
    switch (model->absolutes[i - all - hand_slots].kind) {
    case absolute_x:
    case absolute_y: return reach;
    case absolute_angle: return 1;
    case absolute_angle_dot: return speed / reach;
    case absolute_input: return 0;
    default: return speed;
    }
}

/* Replace components that vary at round-off level, or only by rounding in joints and couplings, by points:
 * the bounds of their rates are meaningless. */
static void hold_noise(struct run *run)
{
    const double negligible = solved_rounding, roundings = 4;
    double speed = 0, reach = tree_joins(run->model->tree) ? measure(run, &speed) : 0;
    for (size_t k = 0; k < run->trajectory.count; k++) {
        int i = run->trajectory.component[k];
        struct enclosure *now = &run->trajectory.now[i];
        double width = interval_width(now->value), middle = now->middle.low + interval_width(now->middle) / 2;
        double noise = roundings * run->trajectory.doubt[k];
        if (reach > 0) noise = fmax(noise, negligible * size_of(run, (size_t)i, reach, speed));
        if (width <= noise) *now = enclosure_point(middle);
    }
}

/* The end of an interval in which the phase of a formula is at most three radians; `to` at most. If halving
 * the interval twice does not reduce the phase the formula is monotonic there, or nearly constant, with
 * bounds dominated by cancellation. */
static double end_of_turn(struct run *run, const struct formula *formula, double from, double to)
{
    enum { most_halvings = 20, most_in_vain = 2 };
    const double most = 3, least_fall = 0.75;
    double before = HUGE_VAL, last = to;
    int in_vain = 0;
    for (int halving = 0; halving < most_halvings; halving++) {
        struct stretch stretch = stretch_between(from, to);
        if (run->search.paced_by_motion) {
            trajectory_enclose(&run->trajectory, &stretch, NULL);
            hold_noise(run);
            run->trajectory.enclosed.from = NAN;
        }
        double radians = radians_of(run, formula, &stretch);
        if (!(radians > most) || !(stretch.middle > from)) return to;
        bool falls = !(before < HUGE_VAL) || radians <= least_fall * before;
        if (falls) last = to;
        in_vain = falls ? 0 : in_vain + 1;
        if (in_vain == most_in_vain) return last;
        before = radians;
        to = stretch.middle;
    }
    return to;
}

static bool varies(const struct formula *formula)
{
    const int *slots;
    return formula->expr && (expr_uses_time(formula->expr) || expr_variables(formula->expr, &slots) > 0);
}

/* The end of the first panel in which no force or friction, and no body of a contact pair, turns by more than
 * three radians, no gap has a kink, and no rope becomes taut and no point returns to its slot from afar.
 * Joints do not make combined functions change faster, except near singular positions, where steps are short.
 */
static double end_of_panel(void *context, double from, double to)
{
    const double most = 3;
    struct run *run = context;
    double turned = run_contact_radians(run, to - from);
    if (turned > most) to = from + (to - from) * (most / turned);
    to = run_flights(run, from, run_contact_bend(run, from, to));
    if (!run->search.paced) return to;
    double followed = run->search.paced_by_motion ? follow(run, from, to, false, NULL) : to;
    if (followed < to) to = followed; /* false for NAN: no motion available */
    const struct formula *formula;
    for (size_t k = 0; (formula = paced_formula(run->model, k)); k++)
        if (varies(formula)) to = end_of_turn(run, formula, from, to);
    return to;
}

/* For functions that may be sampled, mark the components that forces depend on. */
static void mark_paced(struct run *run, bool *used)
{
    const struct watcher_set *set = &run->watchers.moving;
    bool samples = false;
    for (size_t g = 0; g < set->group_count; g++)
        samples |= !set->groups[g].proved || set->watchers[set->groups[g].first].kind == watch_share;
    const struct formula *formula;
    for (size_t k = 0; samples && (formula = paced_formula(run->model, k)); k++) {
        if (!varies(formula)) continue;
        const int *slots;
        size_t count = expr_variables(formula->expr, &slots);
        for (size_t i = 0; i < count; i++) used[slots[i] - 1] = true;
        run->search.paced = true;
        run->search.paced_by_motion |= count > 0;
    }
}

/* Mark the components of the trajectory that each group of functions reads; `used` has room for all. */
static bool mark_reads(struct run *run, bool *used, size_t size)
{
    const struct watcher_set *set = &run->watchers.moving;
    const struct trajectory *trajectory = &run->trajectory;
    bool *reads = run->search.reads =
        ARENA_ARRAY(run->memory, (set->group_count + 1) * trajectory->count, bool);
    run->search.wanted = reads ? reads + set->group_count * trajectory->count : NULL;
    for (size_t g = 0; reads && g < set->group_count; g++) {
        const struct root_group *group = &set->groups[g];
        const struct watcher_set own = {.watchers = set->watchers + group->first, .count = group->count};
        memset(used, 0, size * sizeof *used);
        watchers_mark_used(run->model, &own, used);
        for (size_t k = 0; k < trajectory->count; k++) *reads++ = used[trajectory->component[k]];
    }
    return run->search.reads != NULL;
}

static bool make_course(struct run *run)
{
    if (run->watchers.moving.count == 0) return true; /* without functions that read it */
    size_t size = extended_size(run->model);
    bool *used = ARENA_ARRAY(run->memory, size, bool);
    if (!used) return false;
    watchers_mark_used(run->model, &run->watchers.moving, used);
    mark_paced(run, used);
    for (size_t i = plan_size(&run->model->plan); i < size; i++)
        run->search.follows_places |= used[i] && !is_input(run, i);
    return trajectory_init(&run->trajectory, size, used, run->memory) && mark_reads(run, used, size);
}

static bool use_enclosures(struct run *run)
{
    const struct watcher_set *timed = &run->watchers.timed, *moving = &run->watchers.moving;
    run->search.timed.horizon = run->options.until;
    run->search.moving.panel = end_of_panel;
    run->search.moving.work = work_so_far;
    run->search.moving.zero = zero_of_affine;
    scan_use_enclosures(&run->search.timed, timed->groups, timed->group_count, enclose_timed, NULL);
    scan_use_enclosures(&run->search.moving, moving->groups, moving->group_count, enclose_moving,
                        follow_course);
    return make_course(run);
}

/* Is there a silent switch (a level) that depends on the motion? */
static bool any_wakes(const struct run *run)
{
    const struct watcher_set *set = &run->watchers.moving;
    for (size_t i = 0; i < set->count; i++) {
        const struct watcher *watcher = &set->watchers[i];
        const struct expr *expr =
            watcher->kind == watch_kink ? run->model->plan.kinks[watcher->index].formula.expr : NULL;
        if (expr && expr_switch_is_silent(expr, (size_t)watcher->part)) return true;
    }
    return false;
}

/* Is there a frictional guide whose normal force may change its sign with the speeds of driven bodies? A sign
 * change on one side of zero could be missed on the other. Gaps depend on positions only. */
static bool any_turns(const struct run *run)
{
    const struct watcher_set *set = &run->watchers.moving;
    for (size_t i = 0; i < set->count; i++)
        if (set->watchers[i].kind == watch_normal_turns) return true;
    return false;
}

bool run_make_scans(struct run *run)
{
    double tolerance = run->options.tolerance;
    bool multistep = run->options.method->multistep;
    if (!watchers_init(&run->watchers, run->model, tolerance, multistep, run->memory)) return false;
    const struct watcher_set *timed = &run->watchers.timed, *moving = &run->watchers.moving;
    if (!scan_init(&run->search.timed, timed->count, sample_timed, run, run->memory)) return false;
    if (!scan_init(&run->search.moving, moving->count, sample_moving, run, run->memory)) return false;
    run->search.wakes = any_wakes(run);
    run->search.leads_speeds = any_turns(run);
    for (size_t i = 0; i < run->model->plan.mode_count; i++) {
        const struct mode *mode = &run->model->plan.modes[i];
        run->search.leads |= mode->kind == mode_drive || mode->surface_speed.expr;
    }
    return use_enclosures(run);
}
