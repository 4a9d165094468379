/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/switch_event.h"

#include <string.h>

#include "dynamics/energy.h"
#include "dynamics/friction.h"
#include "dynamics/journals.h"
#include "dynamics/kinematics.h"
#include "dynamics/rest_system.h"
#include "expr/table.h"
#include "loop/zeno.h"
#include "numeric/tolerances.h"
#include "rest/start.h"

/* Switches between the pieces of a curve belong to its body, and to no load. */
static bool is_track(const struct run *run, const struct kink *kink)
{
    return kink->load < 0 && kink->body >= 0 && run->model->bodies[kink->body].joint->path == path_curve;
}

static void end_track(struct run *run, int b, int end)
{
    const struct model_body *body = &run->model->bodies[b];
    struct instant at = state_instant(run->state);
    struct pose pose = body_pose(body, &at);
    struct vec P = point_motion(body, &pose, body->pin).p;
    log_event(run, FBD_EVENT_TRACK_END, b, -1, -1);
    run_fail(run, FBD_BROKEN,
             "at t = %.9g `%s` reaches the %s of its track, at (%.6g, %.6g): extend the track (`from`, `to`, "
             "`closed: true`), or end the run earlier",
             run_time(run), body->name, end ? "end" : "beginning", P.x, P.y);
}

/* A table that ends with `beyond: error` ends the run, and the state stays on its last piece. */
static bool end_table(struct run *run, const struct kink *kink, const struct table *table, int end, int piece)
{
    if (!table || !table_has_ended(table, piece)) return false;
    if (is_track(run, kink)) {
        end_track(run, kink->body, end);
        return true;
    }
    run_fail(run, FBD_BROKEN,
             "at t = %.9g the table `%s` %s (`beyond: error`): it has no value %s. Give it more points, "
             "another `beyond` (`hold`, `zero`, `repeat`), or end the run earlier",
             run_time(run), table->name, end ? "ends" : "begins", end ? "from there on" : "before that");
    return true;
}

/* A knot of a table with a discontinuity of the second derivative or higher is no event, nor is a level. */
static bool is_smooth(const struct expr *expr, const struct watcher *watcher, int piece)
{
    const struct table *table = expr_switch_table(expr, (size_t)watcher->part);
    return expr_switch_is_silent(expr, (size_t)watcher->part) ||
           (table && table_smoothness(table, watcher->end ? piece : piece + 1) >= 1);
}

/* Do two values of a motion differ by more than rounding, relative to `size`? */
static bool jumps(double before, double after, double size)
{
    return fabs(after - before) > undecided_part * size;
}

/* Prescribed motions, and lengths of ropes, must have a continuous position and velocity: a jump requires an
 * infinite force. */
static void check_drive(struct run *run, const struct kink *kink, bool rope)
{
    const struct fbd_model *model = run->model;
    const struct expr *law = kink->formula.expr;
    const int *before = run->during->branch + kink->formula.branch,
              *after = run->state->branch + kink->formula.branch;
    if (memcmp(before, after, kink->count * sizeof *before) == 0) return;
    const double *y = run->state->y, *most = run->recent.anchor + plan_size(&model->plan);
    const struct model_body *body = &model->bodies[kink->body];
    double v[2], x[2] = {expr_eval_slot(law, run->state->t, y, 0, before, &v[0]),
                         expr_eval_slot(law, run->state->t, y, 0, after, &v[1])};
    double far = rope ? 0 : most[body->first], fast = rope ? 0 : most[body->first_rate];
    bool place = jumps(x[0], x[1], fmax(far, fabs(x[0]) + fabs(x[1])));
    if (!place && !jumps(v[0], v[1], fmax(fast, fabs(v[0]) + fabs(v[1])))) return;
    run_fail(
        run, FBD_BROKEN,
        "at t = %.9g the %s that is prescribed to `%s` jumps from %.6g to %.6g: this requires an unbounded "
        "force. Round the corner off (a table: `interpolation: cubic`), or end the run earlier",
        run_time(run),
        rope    ? place ? "length" : "rate of the length"
        : place ? "place"
                : "velocity",
        rope ? model->loads[kink->load].source->name : body->name, place ? x[0] : v[0], place ? x[1] : v[1]);
    memcpy(run->state->branch + kink->formula.branch, before, kink->count * sizeof *before);
    modes_hold(run->state); /* restore the state before the jump */
    state_evaluate(run->state);
}

/* Mass that drops off keeps the velocity of the body and takes its kinetic energy with it; mass that is added
 * at once would cause an impact. */
static void check_mass(struct run *run, const struct kink *kink)
{
    const struct fbd_model *model = run->model;
    const struct model_body *body = &model->bodies[kink->body];
    const struct expr *law = kink->formula.expr;
    struct instant at = state_instant(run->state);
    double before = expr_eval(law, run->state->t, run->state->y, run->during->branch + kink->formula.branch),
           after = expr_eval(law, run->state->t, run->state->y, run->state->branch + kink->formula.branch);
    if (!jumps(before, after, fabs(before) + fabs(after))) return;
    if (after > before || after <= 0) {
        run_fail(run, FBD_BROKEN, "at t = %.9g the mass of `%s` jumps from %.6g to %.6g: %s", run_time(run),
                 body->name, before, after,
                 after > 0 ? "mass that is added at once would cause an impact, which is not computed. Let "
                             "it grow continuously"
                           : "nothing is left of it");
        return;
    }
    run->impact_work[body->carried] += (after - before) / after * kinetic_energy(body, &at);
}

void run_check_friction(struct run *run)
{
    const struct fbd_model *model = run->model;
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++) {
        const struct mode *mode = &model->plan.modes[pair];
        if (!mode_friction_varies(mode)) continue;
        const struct instant at = state_instant(run->state);
        struct text why = {0};
        double mu = friction_below_zero(model, pair, &at);
        if (mu == 0 || run->end.outcome != FBD_GOING) continue;
        negative_friction_words(model, pair, mu, run_time(run), &why);
        run_fail(run, FBD_FAILED, "%s", why.data);
        text_free(&why);
    }
}

void run_check_counts(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    for (size_t i = 0; i < plan->kink_count; i++) {
        const struct kink *kink = &plan->kinks[i];
        for (size_t part = 0; part < kink->count; part++) {
            int branch = run->state->branch[(size_t)kink->formula.branch + part];
            if (branch < table_most_pieces && branch > -table_most_pieces) continue;
            run_fail(run, FBD_BROKEN,
                     "at t = %.9g %s%s%s is past its 2^31st step, where steps cannot be distinguished: "
                     "subtract whole periods from its argument",
                     run_time(run), run_kink_name(run, kink) ? "`" : "",
                     run_kink_name(run, kink) ? run_kink_name(run, kink) : "an expression",
                     run_kink_name(run, kink) ? "`" : "");
        }
    }
}

void run_check_drives(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    for (size_t i = 0; i < plan->kink_count; i++) {
        int load = plan->kinks[i].load;
        enum load_kind kind = load >= 0 ? run->model->loads[load].source->kind : load_applied;
        if (kind == load_carried) check_mass(run, &plan->kinks[i]);
        if (kind == load_drive || kind == load_rope) check_drive(run, &plan->kinks[i], kind == load_rope);
    }
}

/* Has a switch been crossed in this event on which this one depends? Then the rates beyond decide: |x| has
 * changed its sign, and f(|x|) returns to the piece that it was about to leave. */
static bool follows_crossed(const struct run *run, const struct kink *kink, int part)
{
    const bool *crossed = run->decided.branches + kink->formula.branch;
    for (int other = 0; other < part; other++)
        if (crossed[other] && expr_switch_depends(kink->formula.expr, (size_t)part, (size_t)other))
            return true;
    return false;
}

void switch_cross(struct run *run, const struct watcher *watcher)
{
    const struct kink *kink = &run->model->plan.kinks[watcher->index];
    int index = kink->formula.branch + watcher->part, before = run->state->branch[index];
    int next = expr_branch_beyond(kink->formula.expr, (size_t)watcher->part, watcher->end, before);
    const struct table *table = expr_switch_table(kink->formula.expr, (size_t)watcher->part);
    if (follows_crossed(run, kink, watcher->part)) return;
    run->decided.branches[index] = true;
    if (end_table(run, kink, table, watcher->end, next)) return;
    run->state->branch[index] = next;
    if (is_track(run, kink)) return;
    if (is_smooth(kink->formula.expr, watcher, next)) return;
    zeno_switch_remember(run, watcher);
    struct run_event *event = log_event(run, FBD_EVENT_SWITCH, kink->body, kink->load, -1);
    if (event) event->branch = index;
    if (event) event->own = kink->own;
}

void run_turn_normal(struct run *run, int pair)
{
    enum { most_turns = 8 };
    run->state->pull[pair] = -run->state->pull[pair];
    run->decided.pulls[pair] = true;
    if (++run->recent.turns <= most_turns || run->end.outcome != FBD_GOING) return;
    const struct mode *mode = &run->model->plan.modes[pair];
    run_fail(run, FBD_FAILED,
             "at t = %.9g no force agrees with the motion of `%s`: on either side of its guide friction by "
             "`%s` gives "
             "the normal force the other sign, as in Painleve's paradox. Rigid bodies do not determine the "
             "motion: reduce the friction, or end the run earlier by an event",
             run_time(run), run->model->bodies[mode->body].name, run->model->loads[mode->load].source->name);
}

void run_check_sides(struct run *run)
{
    const double slacks = 1e3;
    const struct fbd_model *model = run->model;
    if (!journals_determined(run->state)) {
        run_fail_unsettled(run);
        return;
    }
    for (size_t pair = 0; pair < model->plan.mode_count; pair++) {
        const struct mode *mode = &model->plan.modes[pair];
        bool rubs = mode->two_sided && mode->normal_slot >= 0 && friction_rubs(mode);
        if (!rubs || run->state->slip[pair] == stick) continue;
        double N = -run->state->slots[mode->normal_slot] * run->state->pull[pair];
        if (N >= -slacks * press_slack(model, run->state->tree, mode->body)) continue;
        const struct instant at = state_instant(run->state);
        if (rest_is_open(model, &at)) continue; /* indeterminate forces keep their side */
        run_fail(run, FBD_FAILED,
                 "before t = %.9g `%s` jams: friction by `%s` increases its own normal force, which grows "
                 "without bound. Reduce the friction, or end the run earlier by an event",
                 run_time(run), model->bodies[mode->body].name, model->loads[mode->load].source->name);
        return;
    }
}
