/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/contacts.h"

#include <stdlib.h>
#include <string.h>

#include "dynamics/contact.h"
#include "dynamics/impulse.h"
#include "dynamics/plane_friction.h"
#include "dynamics/project.h"
#include "dynamics/tree_system.h"
#include "loop/contacts_points.h"
#include "loop/run.h"
#include "numeric/tolerances.h"
#include "rest/start.h"

/* ---- memory */

static size_t most_strikers(const struct tree *tree)
{
    size_t count = 0;
    for (int i = 0; i < tree->coupling_count; i++)
        count += tree->couplings[i].kind == constraint_contact ||
                 tree->couplings[i].kind == constraint_rope || coupling_takes_impulses(&tree->couplings[i]);
    return count;
}

static bool meetings_init(struct contacts_work *work, const struct fbd_model *model, struct arena *memory)
{
    const struct tree *tree = model->tree;
    size_t couplings = (size_t)tree->coupling_count, meetings = (size_t)tree->meeting_count;
    if (!tree_has_contacts(model->tree)) return true;
    work->bounces = ARENA_ARRAY(memory, meetings, struct bounces);
    work->was_closed = ARENA_ARRAY(memory, 3 * couplings, bool);
    work->asleep = ARENA_ARRAY(memory, meetings, bool);
    work->deep = ARENA_ARRAY(memory, 2 * meetings, double);
    work->touched = ARENA_ARRAY(memory, meetings, int);
    work->trial = state_make(model, NULL, memory);
    if (memory->failed || !work->trial) return false;
    work->phase_rate = work->deep + meetings;
    work->touching = work->was_closed + couplings;
    work->moves = work->touching + couplings;
    for (size_t i = 0; i < meetings; i++)
        work->bounces[i] = (struct bounces){.feature = -1, .rests_from = HUGE_VAL};
    return true;
}

bool contacts_work_init(struct contacts_work *work, const struct fbd_model *model, struct arena *memory)
{
    *work = (struct contacts_work){0};
    size_t most = most_strikers(model->tree), n = (size_t)model->plan.n;
    size_t pairs = model->plan.mode_count, rows = 2 * most, all = rows + pairs;
    if (most == 0) return true;
    work->strikers = ARENA_ARRAY(memory, most, struct striker);
    work->twins = ARENA_ARRAY(memory, most, struct striker_twin);
    work->points = ARENA_ARRAY(memory, most, struct impacts_point);
    work->rows = ARENA_ARRAY(memory, rows + 2 * pairs, int);
    work->slide = ARENA_ARRAY(memory, pairs, struct impacts_slide);
    size_t extended = plan_size(&model->plan) + 1; /* with the speed of approach (place_contact) */
    work->W = ARENA_ARRAY(memory, all * (all + pairs + n + 4) + pairs + extended, double);
    work->of_couplings = ARENA_ARRAY(memory, (size_t)model->tree->coupling_count, struct impact_record);
    if (!meetings_init(work, model, memory) || memory->failed) return false;
    work->modes = work->rows + rows;
    work->slides = work->modes + pairs;
    work->B = work->W + all * all;
    work->answers = work->B + pairs * all;
    work->v = work->answers + all * n;
    work->P = work->v + all;
    work->later = work->P + all;
    work->slide_before = work->later + 2 * all;
    work->y = work->slide_before + pairs;
    return true;
}

/* ---- touching features */

static void set_feature(struct run *run, int coupling, int feature)
{
    struct fbd_state *state = run->state;
    const struct instant at = state_instant(state);
    coupling_set_feature(run->model, &at, coupling, feature);
    state->slip[run->model->tree->couplings[coupling].surface] = feature == no_feature ? slip_plus : stick;
}

/* A closed feature stays while it touches, within its side. */
static bool still_touches(const struct run *run, int meeting, int feature, double near)
{
    const struct fbd_model *model = run->model;
    const struct tree_work *work = run->state->tree;
    if (fabs(feature_gap(model, work, meeting, feature).x) > near) return false;
    for (int end = 0; end < 2; end++)
        if (feature_end(model, work, meeting, feature, end).x < -near) return false;
    return true;
}

/* Two features at one position are one contact. */
static bool same_place(const struct run *run, int meeting, int a, int b, double near)
{
    if (a == b) return true;
    struct vec p = feature_place(run->model, run->state->tree, meeting, a);
    struct vec q = feature_place(run->model, run->state->tree, meeting, b);
    return vec_norm(vec_sub(p, q)) <= contacts_same * near;
}

void contacts_find_touching(struct run *run, int index, double near)
{
    const struct meeting *meeting = &run->model->tree->meetings[index];
    meeting_turn_sides(run->model, run->state->tree, index, near);
    int found[2], count = meeting_touching(run->model, run->state->tree, index, near, found);
    for (int k = 0; k < meeting->coupling_count; k++) {
        int coupling = meeting->first_coupling + k, feature = run->state->tree->couplings[coupling].feature;
        if (feature != no_feature && !still_touches(run, index, feature, near))
            set_feature(run, coupling, no_feature);
    }
    for (int i = 0; i < count; i++) {
        bool known = false;
        int free_coupling = -1;
        for (int k = meeting->coupling_count - 1; k >= 0; k--) {
            int feature = run->state->tree->couplings[meeting->first_coupling + k].feature;
            if (feature == no_feature)
                free_coupling = meeting->first_coupling + k;
            else
                known |= same_place(run, index, feature, found[i], near);
        }
        if (!known && free_coupling >= 0) set_feature(run, free_coupling, found[i]);
    }
}

/* ---- impact constraints */

static bool any_closes(const struct run *run, int count)
{
    for (int i = 0; i < count; i++)
        if (run->contacts.strikers[i].v_n < 0) return true;
    return false;
}

/* ---- after an impact */

bool contacts_part(const struct run *run, int i)
{
    const struct striker *striker = &run->contacts.strikers[i];
    const struct row *row = &run->state->tree->rows[run->model->tree->couplings[striker->coupling].first_row];
    return run->contacts.v[(ptrdiff_t)2 * i] > contacts_no_speed(run, row);
}

/* Add an impact of a rope, or of a landing, to its record of the current events: there may be several. */
static void add_to_coupling(struct contacts_work *work, const struct striker *striker, const double *v,
                            const double *P, double taken)
{
    struct impact_record *impact = &work->of_couplings[striker->coupling];
    if (impact->p == 0 && impact->work == 0)
        *impact = (struct impact_record){.v_n = {striker->v_n}, .v_t = {striker->v_t}};
    impact->p += P[0];
    impact->tau += striker->rubs ? P[1] : 0;
    impact->work += taken;
    impact->v_n[1] = v[0];
    impact->v_t[1] = striker->rubs ? v[1] : 0;
}

/* Does the impact at point i have an event? Ropes and landings have events of their own. */
static bool is_impact(const struct run *run, int i)
{
    const struct contacts_work *work = &run->contacts;
    const struct striker *striker = &work->strikers[i];
    bool struck = striker->v_n < 0 || (work->P[(ptrdiff_t)2 * i] > 0 && contacts_part(run, i));
    return striker->contact && struck;
}

/* Do points i and j of one contact have the same impact velocities, as the corners of a side that lands flat? */
static bool strike_alike(const struct run *run, int i, int j)
{
    const struct contacts_work *work = &run->contacts;
    const struct striker *a = &work->strikers[i], *b = &work->strikers[j];
    const struct coupling *coupling = &run->model->tree->couplings[a->coupling];
    const double *v = work->v + (ptrdiff_t)2 * i, *w = work->v + (ptrdiff_t)2 * j;
    double same = contacts_no_speed(run, &run->state->tree->rows[coupling->first_row]);
    return is_impact(run, j) && run->model->tree->couplings[b->coupling].load == coupling->load &&
           fabs(a->v_n - b->v_n) <= same && fabs(a->v_t - b->v_t) <= same && fabs(v[0] - w[0]) <= same &&
           fabs(v[1] - w[1]) <= same;
}

/* One event for all points with equal impact velocities, with the sums of their impulses. */
static void note_impact(struct run *run, int i, int count)
{
    struct contacts_work *work = &run->contacts;
    const struct striker *striker = &work->strikers[i];
    const struct coupling *coupling = &run->model->tree->couplings[striker->coupling];
    const double *v = work->v + (ptrdiff_t)2 * i, *own = work->P + (ptrdiff_t)2 * i;
    double p = 0, tau = 0, taken = 0;
    const double done = striker_taken(striker, v, own);
    run->impact_work[coupling->load] += done;
    if (!striker->contact) add_to_coupling(work, striker, v, own, done);
    if (!is_impact(run, i)) return;
    for (int k = 0; k < count; k++) {
        if (!strike_alike(run, i, k)) continue;
        if (k < i) return; /* included in the event of point k */
        const double *P = work->P + (ptrdiff_t)2 * k;
        p += P[0];
        tau += P[1];
        taken += striker_taken(&work->strikers[k], work->v + (ptrdiff_t)2 * k, P);
    }
    struct run_event *event = log_event(run, FBD_EVENT_IMPACT, coupling->end[0].body, coupling->load, -1);
    if (!event) return;
    event->impact = (struct impact_record){
        p,     tau,          taken, {striker->v_n, v[0]}, {striker->v_t, v[1]}, work->makes && taken > 0,
        false, work->in_turn};
}

/* Log that the impacts are not unique, by the name of the contact with the largest impulse. */
static void note_several(struct run *run, int count)
{
    const struct contacts_work *work = &run->contacts;
    int most = 0;
    for (int i = 1; i < count; i++)
        if (work->P[(ptrdiff_t)2 * i] > work->P[(ptrdiff_t)2 * most]) most = i;
    if (!work->several || count == 0) return;
    const struct coupling *coupling = &run->model->tree->couplings[work->strikers[most].coupling];
    struct run_event *event = log_event(run, FBD_EVENT_SEVERAL, coupling->end[0].body, coupling->load, -1);
    if (event) event->impact.several = true;
}

static void note_impacts(struct run *run, int count)
{
    for (int i = 0; i < count; i++) note_impact(run, i, count);
    note_several(run, count);
}

/* Open a rope, or another constraint, that an impact has opened, whatever its length or gap. */
static void let_slack(struct run *run, int pair)
{
    run->state->slip[pair] = slip_plus;
    run->decided.slips[pair] = true;
}

/* Update the contact of coupling `index` after an impact, by the velocities of impact constraint i. */
static void open_or_close_contact(struct run *run, int index, int i, bool leaves, double v_t)
{
    const struct coupling *coupling = &run->model->tree->couplings[index];
    if (leaves && run->contacts.strikers[i].contact) {
        set_feature(run, index, no_feature);
        return;
    }
    if (coupling->pair < 0) return;
    /* Sticking starts at this position. */
    if (v_t == 0 && run->state->slip[coupling->pair] != stick)
        coupling_rezero(run->model, run->state->tree, index);
    run->state->slip[coupling->pair] = v_t > 0 ? slip_plus : v_t < 0 ? slip_minus : stick;
}

void contacts_open_or_close(struct run *run, int count, bool struck)
{
    const struct contacts_work *work = &run->contacts;
    for (int i = 0; i < count; i++) {
        const struct striker *striker = &work->strikers[i];
        const struct coupling *coupling = &run->model->tree->couplings[striker->coupling];
        bool leaves = struck ? contacts_part(run, i) : striker->v_n > 0;
        double v_t = struck ? work->v[2 * i + 1] : striker->v_t;
        if (striker->rope || (leaves && !striker->contact)) {
            if (leaves && !striker->stays) let_slack(run, striker->rope ? coupling->pair : coupling->surface);
            continue;
        }
        if (fabs(v_t) <= contacts_no_speed(run, &run->state->tree->rows[coupling->first_row])) v_t = 0;
        open_or_close_contact(run, striker->coupling, i, leaves, v_t);
        for (int k = 0; k < work->twin_count; k++)
            if (work->twins[k].point == i)
                open_or_close_contact(run, work->twins[k].coupling, i, leaves, v_t);
    }
}

/* The scale of the speed across a sliding surface, from the largest speeds so far. */
static double size_of_speed(struct run *run, const struct slide *slide)
{
    const struct fbd_model *model = run->model;
    struct sliding *s = run->state->sliding;
    const struct instant at = state_instant(run->state);
    const double *most = run->recent.anchor + plan_size(&model->plan);
    size_t n = (size_t)model->plan.n;
    double size = 0;
    for (size_t i = 0; i < n; i++) {
        memset(s->flow, 0, plan_size(&model->plan) * sizeof *s->flow);
        s->flow[n + i] = 1;
        double slope =
            sliding_surface_rate(s, model, &at, &model->plan.kinks[slide->kink], slide->part, 0, s->flow);
        size += fabs(slope) * fmax(most[n + i], fabs(run->state->y[n + i]));
    }
    return size;
}

/* End Filippov sliding modes whose surface is left with a speed after the impact. */
static void leave_switches(struct run *run)
{
    struct sliding *s = run->state->sliding;
    const struct instant at = state_instant(run->state);
    for (int j = 0; s && j < s->count; j++) {
        const struct slide *slide = &s->slides[j];
        double u = sliding_surface(s, run->model, &at, &run->model->plan.kinks[slide->kink], slide->part);
        if (fabs(u) > negligible_sum * size_of_speed(run, slide)) s->slide_at[slide->branch] = 0;
    }
    if (s) sliding_drop(s);
}

/* Has its friction no impulse of its own in an impact, or one of a guide? */
static bool is_hit_indirectly(const struct coupling *coupling)
{
    return coupling_is_guide(coupling) || coupling->kind == constraint_resistance;
}

/* Sticking friction that has got a speed slips. In a series of impacts below the tolerance, `interval` apart,
 * it sticks if its slip until the next one would be negligible: friction at its limit for that time might
 * cause the next impact. */
static void unstick(struct run *run, double interval)
{
    leave_switches(run);
    const struct fbd_model *model = run->model;
    struct instant at = state_instant(run->state);
    const double *fastest = run->recent.anchor + plan_size(&model->plan) + model->plan.n;
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++) {
        const struct mode *mode = &model->plan.modes[pair];
        if (mode->kind == mode_plane) plane_unstick(run->state, pair);
        bool row =
            mode->kind == mode_tangent && is_hit_indirectly(&run->model->tree->couplings[mode->coupling]);
        if (!(row || mode_is_joint_friction(mode)) || run->state->slip[pair] != stick) continue;
        double v = slip_velocity(model, pair, &at), before = row ? 0 : fastest[mode->coordinate];
        if (fabs(v) <= evaluation_rounding * before || (interval > 0 && fabs(v) * interval <= undecided_part))
            continue;
        run->state->slip[pair] = v > 0 ? slip_plus : slip_minus;
    }
}

/* ---- complete impact */

/* Find the touching features of all pairs, and evaluate their rows. */
static void find_touching(struct run *run)
{
    const struct instant at = state_instant(run->state);
    tree_move(run->model, &at);
    for (int i = 0; i < run->model->tree->meeting_count; i++)
        contacts_find_touching(run, i, contacts_reach(run, i));
    constraints_evaluate(run->model, &at, NULL);
}

/* Fail at an impact on a step lower than contact_level: surfaces of one body, and of the ground, are made
 * level within it, but not those of bodies that move relative to each other. */
static bool refuse_low_step(struct run *run, int count)
{
    for (int i = 0; i < count; i++) {
        const struct striker *striker = &run->contacts.strikers[i];
        const struct coupling *coupling = &run->model->tree->couplings[striker->coupling];
        const struct vec n = run->state->tree->rows[coupling->first_row].ports[0].force;
        if (!striker->contact || !(striker->v_n < 0)) continue;
        double height = meeting_low_step(run->model, run->state->tree, coupling->meeting, -striker->v_n, n);
        if (height == 0) continue;
        run_fail(run, FBD_FAILED,
                 "at t = %.9g the contact `%s` strikes a step of %.3g, which is below the accuracy of the "
                 "numbers in a file but would stop a sliding body. Give both surfaces the same height",
                 run_time(run), run->model->scene->constraints[coupling->constraint].name, height);
        return true;
    }
    return false;
}

/* Process all touching contacts once. True when shapes were moved, so that others have to be checked. */
static bool look_at_contacts(struct run *run)
{
    bool moved = false;
    find_touching(run);
    int count = contacts_find_strikers(run);
    bool struck = any_closes(run, count);
    if (struck && close_taut_ropes(run)) count = contacts_find_strikers(run);
    if (struck) {
        if (refuse_low_step(run, count) || !contacts_strike(run, count)) return false;
        note_impacts(run, count);
        impulse_look(run->state);
        unstick(run, 0);
    }
    bool rests = struck && zeno_end_bounces(run, count);
    contacts_open_or_close(run, count, struck);
    if (struck) contacts_hold_speeds(run, count);
    if (rests) {
        count = zeno_rest(run);
        contacts_open_or_close(run, count, true);
        moved = zeno_lift_others(run);
    }
    return moved;
}

void contacts_begin_events(struct run *run)
{
    struct impact_record *of_couplings = run->contacts.of_couplings;
    if (of_couplings)
        memset(of_couplings, 0, (size_t)run->model->tree->coupling_count * sizeof *of_couplings);
}

void run_contacts(struct run *run)
{
    enum { most_rounds = 8 };
    if (!tree_has_contacts(run->model->tree)) return;
    for (int round = 0; round < most_rounds && run->end.outcome == FBD_GOING; round++)
        if (!look_at_contacts(run)) break;
}

bool run_start_contacts(struct run *run, struct lack *lack)
{
    struct fbd_state *state = run->state;
    if (!tree_has_contacts(run->model->tree)) return true;
    bool settled = modes_settle(state, NULL);
    if (contacts_are_deep(state)) {
        if (!start_fits(state, run->during, settled, "the start", lack)) return false;
        contacts_lift_out(state);
        modes_settle(state, NULL);
    }
    run_contacts(run);
    /* Energies are counted from after the impacts of the start. */
    memset(run->impact_work, 0, run->model->load_count * sizeof *run->impact_work);
    return true;
}

void run_strike_closed(struct run *run)
{
    if (tree_has_contacts(run->model->tree))
        find_touching(run);
    else
        impulse_look(run->state);
    close_taut_ropes(run);
    int count = contacts_find_strikers(run);
    if (!any_closes(run, count) || !contacts_strike(run, count)) return;
    note_impacts(run, count);
    zeno_end_rope_impacts(run, count);
    impulse_look(run->state);
    contacts_open_or_close(run, count, true);
    unstick(run, zeno_rope_limit(run));
}

static bool is_closed(const struct run *run, const struct fbd_state *state, int coupling)
{
    return state->slip[run->model->tree->couplings[coupling].surface] == stick;
}

/* Set separation speeds at round-off level to zero, for contacts that the modes opened after an impact
 * stopped them there. An approach would cause impacts at once, again and again; a separation would place the
 * body elsewhere at the next impact. */
static void stop_what_opens(struct run *run)
{
    const struct tree *tree = run->model->tree;
    struct fbd_state *state = run->state;
    bool *stops = run->contacts.moves, any = false;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        const struct row *row = &state->tree->rows[coupling->first_row];
        stops[i] = coupling->kind == constraint_contact && state->tree->couplings[i].feature != no_feature &&
                   !is_closed(run, state, i) && row->g.x1 != 0 &&
                   fabs(row->g.x1) <= contacts_no_speed(run, row);
        if (stops[i]) state->slip[coupling->surface] = stick;
        any |= stops[i];
    }
    if (!any) return;
    state_project_velocity(state, false);
    for (int i = 0; i < tree->coupling_count; i++)
        if (stops[i]) state->slip[tree->couplings[i].surface] = slip_plus;
    state_evaluate(state);
}

/* Log that a contact has closed or opened: once, for any number of corners. */
static void note_change(struct run *run, int index)
{
    const struct coupling *couplings = run->model->tree->couplings, *coupling = &couplings[index];
    const bool *changed = run->contacts.moves;
    bool now = is_closed(run, run->state, index);
    for (int k = 0; k < index; k++)
        if (changed[k] && couplings[k].load == coupling->load && is_closed(run, run->state, k) == now) return;
    log_event(run, now ? FBD_EVENT_CONTACT : FBD_EVENT_LIFT_OFF, coupling->end[0].body, coupling->load, -1);
}

void run_release_contacts(struct run *run)
{
    if (!tree_has_contacts(run->model->tree)) return;
    const struct coupling *couplings = run->model->tree->couplings;
    bool *changed = run->contacts.moves;
    stop_what_opens(run);
    for (int i = 0; i < run->model->tree->coupling_count; i++) {
        changed[i] = false;
        if (couplings[i].kind != constraint_contact) continue;
        bool now = is_closed(run, run->state, i);
        changed[i] = now != run->contacts.was_closed[i] && !coupling_is_gone(run->state->tree, &couplings[i]);
        run->contacts.was_closed[i] = now;
        if (!now) run->state->tree->couplings[i].feature = no_feature;
        if (changed[i]) note_change(run, i);
    }
    contacts_note_depths(run);
    contacts_note_touching(run);
}
