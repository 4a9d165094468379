/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The impact of all touching contacts: its points, the response to impulses, and the change of the motion.
 */
#include <float.h>
#include <string.h>

#include "dynamics/energy.h"
#include "dynamics/friction.h"
#include "dynamics/impulse.h"
#include "dynamics/nonfinite.h"
#include "dynamics/project.h"
#include "dynamics/tree_driven.h"
#include "dynamics/tree_system.h"
#include "loop/contacts.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

double contacts_restitution(struct run *run, int meeting, double approach)
{
    const struct fbd_model *model = run->model;
    const struct constraint *source =
        &model->scene->constraints[run->model->tree->meetings[meeting].constraint];
    const struct expr *expr = source->contact.restitution.expr;
    if (!expr) return source->contact.e;
    size_t n = plan_size(&model->plan);
    double *y = run->contacts.y;
    memcpy(y, run->state->y, n * sizeof *y);
    y[n] = approach;
    double e = expr_is_constant(expr) ? expr_value(expr) : expr_eval(expr, run->state->t, y, NULL);
    if (e >= 0 && e <= 1) return e;
    run_fail(run, FBD_FAILED, "at t = %.9g the restitution of `%s` is %.6g: it must be between 0 and 1",
             run_time(run), source->name, e);
    return -1;
}

static bool set_point(struct run *run, int i)
{
    const double no_limit = 1e6; /* stops the slip of rolling without a limit */
    struct contacts_work *work = &run->contacts;
    const struct striker *striker = &work->strikers[i];
    const struct coupling *coupling = &run->model->tree->couplings[striker->coupling];
    struct instant at = state_instant(run->state);
    work->points[i] = (struct impacts_point){.law = impact_stronge};
    if (striker->rope) return true;
    if (coupling->pair >= 0)
        work->points[i].mu = formula_value(&run->model->plan.modes[coupling->pair].mu_k, &at);
    if (coupling->pair < 0 && !striker->contact && striker->rubs) work->points[i].mu = no_limit;
    if (work->plastic || !striker->contact) return true;
    work->points[i].law = (enum impact_law)run->model->scene->constraints[coupling->constraint].contact.law;
    work->points[i].e = contacts_restitution(run, coupling->meeting, fmax(0, -striker->v_n));
    return work->points[i].e >= 0;
}

/* ---- friction of slides, and in slots, by impulses on their guides */

/* Collect the frictional guides which may get a normal impulse. */
static void find_slides(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    struct contacts_work *work = &run->contacts;
    work->slide_count = 0;
    for (int pair = 0; pair < (int)plan->mode_count && !work->plastic; pair++) {
        if (friction_takes_impulses(run->model, &plan->modes[pair])) work->slides[work->slide_count++] = pair;
    }
}

/* Leave out slides whose guides no impulse loads. True when there were some. */
static bool leave_out_slides(struct contacts_work *work, int rows)
{
    const struct impulse_lines lines = {rows, work->slide_count, work->rows, work->slides};
    int *loaded = work->modes, kept = 0;
    const bool any = impulse_loaded_slides(&lines, work->W, work->B, loaded) < work->slide_count;
    for (int i = 0; i < work->slide_count; i++)
        if (loaded[i]) work->slides[kept++] = work->slides[i];
    work->slide_count = kept;
    return any;
}

static void set_slides(struct run *run, int rows)
{
    struct contacts_work *work = &run->contacts;
    struct instant at = state_instant(run->state);
    for (int i = 0; i < work->slide_count; i++) {
        int pair = work->slides[i];
        const struct mode *mode = &run->model->plan.modes[pair];
        double mu = friction_coefficient(run->model, pair, &mode->mu_k, &at, NULL, NULL);
        work->slide[i] = (struct impacts_slide){mu, mode->two_sided};
        double v = run->state->slip[pair] == stick ? 0 : slip_velocity(run->model, pair, &at);
        work->v[rows + i] = work->slide_before[i] = v;
    }
}

static void find_answers(struct run *run, int rows)
{
    struct contacts_work *work = &run->contacts;
    const struct impulse_lines lines = {rows, work->slide_count, work->rows, work->slides};
    impulse_answers(run->state, &lines, work->modes, work->W, work->B, work->answers);
}

/* Can point i move along its surface? Not where a body on a slide meets another on it, or a wall across it:
 * W_tt there is the square of a rounding of the direction, and impulses of friction would be arbitrary. */
static bool moves_along(const struct contacts_work *work, int all, int i)
{
    const double rounding = 1e-20; /* of W: a slope of 1e-10 */
    const double *own = &work->W[(ptrdiff_t)2 * i * (all + 1)];
    return work->strikers[i].rubs && own[all + 1] > rounding * own[0];
}

/* The direction in which point i continues to slip, where no impulse moves it along its surface: on a driven
 * body, for example. For a point at rest to rounding the friction impulse is indeterminate: 0. */
static int slips_on(const struct contacts_work *work, int count, int i)
{
    const double rounding = undecided_part; /* of the speeds */
    double most = 0, v_t = work->v[2 * i + 1];
    for (int row = 0; row < 2 * count; row++) most = fmax(most, fabs(work->v[row]));
    return !work->strikers[i].rubs || fabs(v_t) <= rounding * most ? 0 : v_t > 0 ? 1 : -1;
}

/* Rows 2 i and 2 i + 1; both are the same without friction. The normal of a rope has the opposite sign.
 * Slides follow. */
static void set_answers(struct run *run, int count)
{
    struct contacts_work *work = &run->contacts;
    int rows = 2 * count;
    for (int i = 0; i < count; i++) {
        int first = run->model->tree->couplings[work->strikers[i].coupling].first_row;
        int *row = work->rows + (ptrdiff_t)2 * i;
        row[0] = first;
        row[1] = work->strikers[i].rubs ? first + 1 : first;
    }
    find_slides(run);
    find_answers(run, rows);
    if (leave_out_slides(work, rows)) find_answers(run, rows);
    set_slides(run, rows);
    int all = rows + work->slide_count;
    for (int i = 0; i < count; i++) {
        const double sign = work->strikers[i].rope ? -1 : 1;
        if (moves_along(work, all, i)) continue;
        work->points[i].slips = slips_on(work, count, i);
        if (!work->points[i].slips) work->points[i].mu = 0;
        for (int k = 0; k < all; k++) {
            work->W[(2 * i) * all + k] *= sign;
            work->W[k * all + 2 * i] *= sign;
            work->W[(2 * i + 1) * all + k] = work->W[k * all + 2 * i + 1] = 0;
        }
        for (int k = 0; k < work->slide_count; k++) {
            work->B[k * all + 2 * i] *= sign;
            if (!work->points[i].slips) work->B[k * all + 2 * i + 1] = 0;
        }
    }
}

/* The impulse of row i of the impact constraints; that of a rope has the opposite sign, and a single row. */
static double impulse_of(const struct contacts_work *work, int i)
{
    const struct striker *striker = &work->strikers[i / 2];
    if (i % 2 == 1) return striker->rubs ? work->P[i] : 0;
    return striker->rope ? -work->P[i] : work->P[i];
}

/* ---- work of drives
 *
 * A prescribed motion does not change: its drive takes up the impulse, and does work by it. */

/* The work of a unit impulse of a row on the bodies carried by link `driven`, by its prescribed motion. */
static double carried_work(const struct run *run, const struct row *row, int driven)
{
    const struct tree *tree = run->model->tree;
    const struct tree_link *link = &tree->links[driven];
    const struct tree_state *links = run->state->tree->links, *own = &links[driven];
    double v = run->state->y[run->model->plan.n + link->coordinate], sum = 0;
    for (int i = 0; i < row->port_count; i++) {
        const struct port *port = &row->ports[i];
        int carrier = port->link;
        while (carrier > 0 && carrier != driven) carrier = tree->links[carrier].parent;
        if (carrier != driven) continue;
        struct vec arm = vec_sub(vec_add(links[port->link].p, port->arm), own->p);
        sum += v * joint_share(link, own, (struct wrench){vec_cross(arm, port->force), port->force});
    }
    return sum;
}

/* The work of a drive against the impulses on the bodies that it carries. */
static double drive_work(const struct run *run, const struct mode *mode, int count)
{
    const struct contacts_work *work = &run->contacts;
    int driven = run->model->bodies[mode->body].place.link;
    double sum = 0;
    for (int i = 0; i < 2 * count; i++) {
        double P = impulse_of(work, i);
        if (P != 0) sum -= P * carried_work(run, &run->state->tree->rows[work->rows[i]], driven);
    }
    return sum;
}

/* The energy that the impulses take from the bodies at contacts and ropes. */
static double taken_by(const struct contacts_work *work, int count)
{
    const double *P = work->P, *v = work->v;
    double taken = 0;
    for (int i = 0; i < count; i++, P += 2, v += 2) taken += striker_taken(&work->strikers[i], v, P);
    return taken;
}

/* A moving drive, and the number of moving drives. */
static const struct mode *run_only_drive(const struct run *run, int *moving)
{
    const struct plan *plan = &run->model->plan;
    const struct mode *only = NULL;
    *moving = 0;
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        if (mode->kind != mode_drive || run->state->y[plan->n + mode->coordinate] == 0) continue;
        ++*moving;
        only = mode;
    }
    return only;
}

/* A single moving drive does the work that balances the change of kinetic energy, the energy taken by the
 * impulses and the work `rubbed` of friction. With several moving drives, each does the work against the
 * impulses on all bodies that it carries, as if it kept its motion alone. */
static void note_drives(struct run *run, int count, double change, double rubbed)
{
    const struct plan *plan = &run->model->plan;
    int moving;
    const struct mode *only = run_only_drive(run, &moving);
    if (moving == 1) run->impact_work[only->load] += change - taken_by(&run->contacts, count) - rubbed;
    for (int pair = 0; moving > 1 && pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        if (mode->kind == mode_drive) run->impact_work[mode->load] += drive_work(run, mode, count);
    }
}

/* The division of impulses around a drum (capstan) is not modelled. */
static void refuse_rubbing(struct run *run)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        bool closed = coupling->surface < 0 || run->state->slip[coupling->surface] == stick;
        if (coupling->kind != constraint_capstan || !closed) continue;
        run_fail(run, FBD_BROKEN,
                 "at t = %.9g an impact occurs while the rope `%s` is taut round its drum: the friction in "
                 "this impact cannot be computed. End the run earlier by an event",
                 run_time(run), coupling->name);
    }
}

/* The largest speed change of a free link by one of the impulses [m/s]. */
static double given_to(const struct run *run, int count, const struct tree_link *link)
{
    const struct contacts_work *work = &run->contacts;
    double most = 0;
    for (int i = 0; i < 2 * count && link_joint(link)->count == most_coordinates_of_a_body; i++) {
        const double *answer = work->answers + (size_t)i * (size_t)run->model->plan.n + link->coordinate;
        most = fmax(most, fabs(impulse_of(work, i)) * hypot(answer[0], answer[1]));
    }
    return most;
}

/* Set velocities at round-off level to zero for bodies stopped by contacts, as for their accelerations
 * (tree.c): the level is count^2 times epsilon times the largest speed change by a single impulse. Otherwise
 * they would drift. */
static void drop_rounding(struct run *run, int count)
{
    const struct tree *tree = run->model->tree;
    double given = 0, *rates = run->state->y + run->model->plan.n;
    for (int k = 1; k < tree->joined; k++) given = fmax(given, given_to(run, count, &tree->links[k]));
    double least = round_off((double)count * count, given);
    for (int k = 1; k < tree->joined; k++) {
        const struct tree_link *link = &tree->links[k];
        if (given_to(run, count, link) == 0) continue;
        double *own = rates + link->coordinate, radius = sqrt(link->I_O / link->mass);
        if (hypot(own[0], own[1]) <= least && radius * fabs(own[2]) <= least) own[0] = own[1] = own[2] = 0;
    }
}

/* The same for sliding or turning bodies that stop, or reach the speed of the surface of their friction:
 * within the rounding of the responses to impulses, which slopes of 1e-13 (impulse_answers) amplify from
 * coupling to coupling. */
static void stop_rounding(struct run *run, int count)
{
    const struct fbd_model *model = run->model;
    const struct tree *tree = run->model->tree;
    const struct instant at = state_instant(run->state);
    for (int k = 1; k < tree->joined; k++) {
        const struct tree_link *link = &tree->links[k];
        if (joint_freedom(link->kind) != 1) continue;
        const struct mode *mode = link->pair < 0 ? NULL : &model->plan.modes[link->pair];
        double *v = &run->state->y[model->plan.n + link->coordinate], given = 0, ignored;
        double surface = mode ? friction_surface_speed(mode, &at, &ignored) : 0;
        for (int i = 0; i < 2 * count; i++)
            given +=
                fabs(impulse_of(&run->contacts, i) *
                     run->contacts.answers[(size_t)i * (size_t)model->plan.n + (size_t)link->coordinate]);
        if (fabs(*v) <= solved_rounding * given) *v = 0;
        if (fabs(*v - surface) <= solved_rounding * given) *v = surface;
    }
}

/* Set the slips of the slides after the impact, and return the work of their friction. */
static double end_slips(struct run *run, int rows)
{
    double all = 0;
    struct contacts_work *work = &run->contacts;
    const struct plan *plan = &run->model->plan;
    struct instant at = state_instant(run->state);
    for (int i = 0; i < work->slide_count; i++) {
        int pair = work->slides[i];
        const struct mode *mode = &plan->modes[pair];
        double ignored, surface = mode->coupling < 0 ? friction_surface_speed(mode, &at, &ignored) : 0;
        double v = work->v[rows + i], P = work->P[rows + i];
        double done = P * ((work->slide_before[i] + v) / 2 + surface);
        run->impact_work[mode->load] += done;
        all += done;
        if (v == 0 && mode->coupling < 0) run->state->y[plan->n + mode->coordinate] = surface;
        if (v == 0 && mode->coupling >= 0 && run->state->slip[pair] != stick)
            coupling_rezero(run->model, run->state->tree, mode->coupling);
        run->state->slip[pair] = v > 0 ? slip_plus : v < 0 ? slip_minus : stick;
    }
    return all;
}

void contacts_apply_impulses(struct run *run, int count)
{
    refuse_rubbing(run);
    struct contacts_work *work = &run->contacts;
    size_t n = (size_t)run->model->plan.n;
    bool drives = model_is_driven(run->model);
    double before = drives ? total_kinetic_energy(run->state) : 0;
    for (int i = 0; i < 2 * count; i++) {
        double P = impulse_of(work, i);
        for (size_t k = 0; P != 0 && k < n; k++) run->state->y[n + k] += P * work->answers[(size_t)i * n + k];
    }
    for (int i = 0; i < work->slide_count; i++) {
        size_t line = 2 * (size_t)count + (size_t)i;
        for (size_t k = 0; k < n; k++) run->state->y[n + k] += work->P[line] * work->answers[line * n + k];
    }
    double rubbed = end_slips(run, 2 * count);
    drop_rounding(run, count);
    stop_rounding(run, count);
    if (drives) note_drives(run, count, total_kinetic_energy(run->state) - before, rubbed);
}

static void fail_impact(struct run *run, enum impacts_end end, enum impact_law law)
{
    static const char lost[] = "are so nearly along one line that the effect of their impulses is below the "
                               "round-off level: turn one of the surfaces, or move one of the points";
    static const char *const what[] = {
        [impacts_endless] = "follow each other without end: try `simulate: {impacts: simultaneous}`",
        [impacts_unsolvable] = "have no solution by their law: with `law: stronge` they may have one",
        [impacts_lost] = lost,
    };
    struct unresisted motion;
    if (end == impacts_no_memory)
        run_fail(run, FBD_OUT_OF_MEMORY, "out of memory");
    else if (state_is_unresisted(run->state, &motion))
        run_fail(
            run, FBD_FAILED,
            "at t = %.9g %s in an impact, in which ropes may become slack: give that body a small mass, or "
            "end the run earlier by an event",
            run_time(run), motion.text);
    else if (end == impacts_unsolvable && !impact_by_velocity(law))
        run_fail(run, FBD_FAILED,
                 "at t = %.9g the impulses of an impact have no solution: friction on a guide or in a slot "
                 "increases its own normal impulse, as in Painleve's paradox. Reduce the friction, or end "
                 "the run earlier by an event",
                 run_time(run));
    else if (end == impacts_jammed)
        run_fail(run, FBD_FAILED,
                 "at t = %.9g an impact jams: friction locks the bodies, and the other body cannot yield (it "
                 "is driven, for example). Reduce the friction, or end the run earlier by an event",
                 run_time(run));
    else
        run_fail(run, FBD_FAILED, "at t = %.9g impacts at several points %s", run_time(run), what[end]);
}

bool contacts_find_responses(struct run *run, int count)
{
    struct contacts_work *work = &run->contacts;
    for (int i = 0; i < count; i++) {
        if (!set_point(run, i)) return false;
        double *v = work->v + (ptrdiff_t)2 * i;
        v[0] = work->strikers[i].v_n;
        v[1] = work->strikers[i].v_t;
    }
    set_answers(run, count);
    return true;
}

bool contacts_solve_impact(struct run *run, int count)
{
    struct contacts_work *work = &run->contacts;
    if (!contacts_find_responses(run, count)) return false;
    struct impacts impacts = {.count = count,
                              .propagate = run->model->scene->simulate.propagate && !work->plastic,
                              .points = work->points,
                              .slides = work->slide_count,
                              .slide = work->slide,
                              .W = work->W,
                              .B = work->B,
                              .v = work->v,
                              .P = work->P};
    enum impacts_end end = impacts_solve(&impacts);
    if (end != impacts_done) {
        if (!work->plastic || end == impacts_no_memory)
            fail_impact(run, end, impacts.law); /* in a plastic one the caller reports a jam */
        return false;
    }
    double size = 0;
    for (int i = 0; i < impacts_size(&impacts); i++) size += fabs(work->P[i] * work->v[i]);
    work->makes = impacts.work > negligible_sum * size;
    work->in_turn = impacts.in_turn;
    work->several = impacts.several;
    return true;
}

void contacts_hold_speeds(struct run *run, int count)
{
    const struct instant at = state_instant(run->state);
    if (tree_rows_are_idle(run->model->tree, &at)) return;
    state_project_velocity(run->state, false);
    drop_rounding(run, count);
    stop_rounding(run, count);
    impulse_look(run->state);
}

bool contacts_strike(struct run *run, int count)
{
    bool solved = contacts_solve_impact(run, count);
    if (solved) contacts_apply_impulses(run, count);
    return solved;
}
