/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What holds and what gives at the start. Where something moves against what would hold it, its velocity says
 * it; the rest is tried: every choice, and the one that is consistent is right if it is the only one.
 */
#include "absolute.h"

/* Along the row of a grip: velocity and acceleration beyond what its surface does. */
static double slip_velocity(struct absolute *absolute, const struct grip *grip)
{
    const struct row *row = &absolute->row[grip->row];
    absolute_seed(absolute, seed_motion);
    double v = row_value(absolute, row).u1;
    if (row->drive) v -= formula_series(absolute, row->drive, row->owner, -1).u;
    return v;
}

static double slip_acceleration(const struct absolute *absolute, const struct grip *grip)
{
    double a = -absolute->gamma[grip->row];
    for (int i = 0; i < absolute->n; i++) a += absolute->J[grip->row][i] * absolute->a[i];
    return a;
}

static double normal_force(const struct absolute *absolute, const struct grip *grip)
{
    return grip->normal < 0 ? 1 : grip->press * absolute->lambda[grip->normal];
}

static bool is_two_sided(const struct absolute *absolute, const struct grip *grip)
{
    if (grip->normal >= 0 && absolute->row[grip->normal].kind == row_slot)
        return !absolute->scene->coupling[grip->owner].one_sided;
    if (grip->kind != grip_contact && grip->kind != grip_surface) return false;
    if (grip->load < 0) return false;
    const struct body *body = &absolute->scene->body[grip->owner];
    for (int i = 0; i < body->load_count; i++)
        if (body->load[i].kind == normal) return body->load[i].two_sided;
    return false;
}

/* By how much a grip is beyond its limit; negative when within. */
static double beyond(const struct absolute *absolute, const struct grip *grip)
{
    double N = normal_force(absolute, grip), sized = fmax(absolute->acceleration_size, 1e-300);
    if (grip->kind == grip_capstan && grip->mode == lets_go) return -1e-9; /* as its rope does */
    if (grip->kind == grip_contact) return is_two_sided(absolute, grip) ? -1e-9 : -N / absolute->force_size;
    double relative = slip_acceleration(absolute, grip) / sized;
    if (grip->kind == grip_rope)
        return grip->mode == holds ? absolute->lambda[grip->row] / absolute->force_size : relative;
    if (grip->mode != holds) return -grip->mode * relative;
    double limit = fmax(grip_coefficient(absolute, grip, false), grip_coefficient(absolute, grip, true)) * N;
    return (fabs(absolute->lambda[grip->row]) - limit) / absolute->force_size;
}

/* A slipping pair whose velocity is not zero may slow down as it likes. */
static bool is_open(struct absolute *absolute, const struct grip *grip)
{
    if (grip->kind == grip_contact) return false;
    return grip->kind == grip_rope || fabs(slip_velocity(absolute, grip)) < 1e-9;
}

double absolute_excess(const struct absolute *absolute)
{
    double most = -1;
    for (int i = 0; i < absolute->grip_count; i++) {
        const struct grip *grip = &absolute->grip[i];
        if (grip->kind == grip_contact || grip->mode == holds || grip->kind == grip_rope)
            most = fmax(most, beyond(absolute, grip));
    }
    return most;
}

/* A guide may push to either side: the normal force of its friction is the size of what it does. */
bool absolute_turn_guides(struct absolute *absolute)
{
    bool turned = false;
    for (int i = 0; i < absolute->grip_count; i++) {
        struct grip *grip = &absolute->grip[i];
        if (!is_two_sided(absolute, grip) || normal_force(absolute, grip) >= 0) continue;
        grip->press = -grip->press;
        turned = true;
    }
    return turned;
}

bool absolute_jams(struct absolute *absolute)
{
    absolute_solve(absolute, false);
    if (!absolute_turn_guides(absolute)) return false;
    absolute_solve(absolute, false);
    for (int i = 0; i < absolute->grip_count; i++) {
        const struct grip *grip = &absolute->grip[i];
        if (is_two_sided(absolute, grip) && normal_force(absolute, grip) < -1e-9 * absolute->force_size)
            return true;
    }
    return false;
}

static void solve_with_guides(struct absolute *absolute)
{
    absolute_solve(absolute, true);
    for (int round = 0; round < 4 && absolute_turn_guides(absolute); round++) absolute_solve(absolute, true);
}

bool belts_push(const struct absolute *absolute)
{
    for (int j = 0; j < absolute->row_count; j++) {
        if (absolute->row[j].kind != row_belt_turn) continue;
        double T = absolute->scene->coupling[absolute->row[j].owner].tension;
        double both = T > 0 ? -T : absolute->lambda[j + 1] / 2;
        if (!(both + fabs(absolute->lambda[j]) / 2 < 0)) return true;
    }
    return false;
}

static bool is_consistent(struct absolute *absolute, const bool *open)
{
    solve_with_guides(absolute);
    if (absolute->modes_in_doubt) return false;
    for (int i = 0; i < absolute->grip_count; i++) {
        const struct grip *grip = &absolute->grip[i];
        if (is_two_sided(absolute, grip) && normal_force(absolute, grip) < 0) return false; /* no solution */
        bool judged = open[i] || grip->kind == grip_contact;
        /* Nothing but rounding presses it on: to which side is a matter of that. */
        double presses = fabs(beyond(absolute, grip));
        if (grip->kind == grip_contact && presses > 0 && presses < 1e-12) absolute->modes_in_doubt = true;
        if (absolute->modes_in_doubt) return false;
        if (judged && beyond(absolute, grip) > 0) return false;
    }
    return true;
}

/* The friction of a rope on its drum goes with the rope. False: a choice that another one is as well. */
static bool choose_capstan(struct absolute *absolute, struct grip *grip, bool open)
{
    bool slack = grip[-1].mode == lets_go;
    if (open && slack && grip->mode != holds) return false;
    if (slack)
        grip->mode = lets_go;
    else if (!open)
        grip->mode = slip_velocity(absolute, grip) > 0 ? slips_plus : slips_minus;
    return true;
}

/* The choice number `choice`: three modes for each open grip, of a rope two. */
static bool choose(struct absolute *absolute, const bool *open, int choice)
{
    for (int i = 0; i < absolute->grip_count; i++) {
        struct grip *grip = &absolute->grip[i];
        if (!open[i] && grip->kind == grip_capstan && !choose_capstan(absolute, grip, false)) return false;
        if (!open[i]) continue;
        int mode = choice % 3;
        choice /= 3;
        if (grip->kind == grip_rope && mode == 2) return false;
        static const enum grip_mode modes[] = {holds, slips_plus, slips_minus};
        grip->mode = grip->kind == grip_rope && mode == 1 ? lets_go : modes[mode];
        if (grip->kind == grip_capstan && !choose_capstan(absolute, grip, true)) return false;
    }
    return true;
}

/* A rope that is to be held on its drum, or a pin in its slot, but whose speeds cancel only to the roundings of a solution: on which side it
 * begins to slip is a matter of these. */
static bool creeps(struct absolute *absolute, const struct grip *grip)
{
    double v = fabs(slip_velocity(absolute, grip)), size = 0;
    for (int i = 0; i < absolute->n; i++) size += fabs(absolute->J[grip->row][i] * absolute->v[i]);
    bool aimed = grip->kind == grip_capstan || absolute->row[grip->row].kind == row_slot_along;
    return aimed && v > 4e-15 * size && v < 1e-9;
}

static void set_modes(struct absolute *absolute, const enum grip_mode *modes)
{
    for (int i = 0; i < absolute->grip_count; i++) absolute->grip[i].mode = modes[i];
    solve_with_guides(absolute);
}

/* What rubs may press its own normal force (Painleve): would the same slip do with the force on the other side of a
 * guide, too? */
static bool turns_twice(struct absolute *absolute, int contact)
{
    struct grip *grip = &absolute->grip[contact];
    if (!is_two_sided(absolute, grip)) return false;
    for (int k = 0; k < 2; k++) grip[k].press = -grip[k].press;
    absolute_solve(absolute, true);
    bool twice = normal_force(absolute, grip) >= 0;
    for (int k = 0; k < 2; k++) grip[k].press = -grip[k].press;
    return twice;
}

/* Or, where it may let go, does it part if it does? */
static bool parts_too(struct absolute *absolute, int contact)
{
    struct grip *grip = &absolute->grip[contact];
    if (grip->load >= 0 || is_two_sided(absolute, grip)) return false;
    enum grip_mode rubs = grip[1].mode;
    grip[0].mode = grip[1].mode = lets_go;
    absolute_solve(absolute, true);
    bool parts = grip->press * slip_acceleration(absolute, grip) > 0;
    grip[0].mode = holds;
    grip[1].mode = rubs;
    return parts;
}

/* Is there another answer where friction goes with a normal force? Those are a matter of their own. */
static bool has_another(struct absolute *absolute)
{
    enum grip_mode modes[most_grips];
    bool another = false;
    for (int i = 0; i < absolute->grip_count; i++) modes[i] = absolute->grip[i].mode;
    for (int i = 0; i + 1 < absolute->grip_count; i++) {
        const struct grip *grip = &absolute->grip[i], *rubs = &grip[1];
        if (grip->kind != grip_contact || rubs->kind == grip_contact || rubs->normal != grip->normal)
            continue;
        another |= (rubs->mode != holds && turns_twice(absolute, i)) || parts_too(absolute, i);
    }
    set_modes(absolute, modes);
    return another;
}

bool absolute_settle(struct absolute *absolute)
{
    bool open[most_grips] = {false};
    int choices = 1, several = 0, found = -1;
    absolute_rows(absolute);
    for (int i = 0; i < absolute->grip_count; i++) {
        struct grip *grip = &absolute->grip[i];
        open[i] = is_open(absolute, grip);
        if (creeps(absolute, grip)) return false;
        grip->mode = holds;
        if (open[i]) {
            choices *= 3;
            several += grip->kind != grip_capstan; /* which goes with its rope */
        } else if (grip->kind != grip_contact)
            grip->mode = slip_velocity(absolute, grip) > 0 ? slips_plus : slips_minus;
    }
    if (choices > 81) return false;
    for (int choice = 0; choice < choices; choice++) {
        if (!choose(absolute, open, choice)) continue;
        bool consistent = is_consistent(absolute, open);
        if (absolute->modes_in_doubt) return false;
        if (!consistent) continue;
        if (found >= 0) return false;
        found = choice;
    }
    /* Several that depend on each other are a matter of their own, unless all of them hold. */
    if (found < 0 || (several > 1 && found > 0)) return false;
    choose(absolute, open, found);
    solve_with_guides(absolute);
    return !has_another(absolute) && !belts_push(absolute);
}
