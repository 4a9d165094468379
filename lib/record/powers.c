/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Integrals of powers over panels. A panel is a part of a step; the power is sampled on the dense output.
 *
 * On a panel the power is p(x) = sum of c_k P_k(x), x in [-1, 1]. Gauss's rule with five points gives c_0.
 * The same points give c_1 to c_4, and a sixth point gives c_5; their decay estimates the error of the rule,
 * which is of degree 10. Where the error is too large the panel is halved.
 *
 * Tested with oscillating forces on bodies that stick on a belt, are driven, or stand between cancelling
 * forces, against closed forms (tests/unit/test_works.c).
 */
#include "record/powers.h"

#include <math.h>

#include "dynamics/load_rounding.h"
#include "dynamics/mass.h"
#include "dynamics/tree.h"
#include "numeric/tolerances.h"

/* Add the powers of integrated loads from `first` on. */
static void add_powers_of_loads(struct ledger *ledger, const struct group *group,
                                const struct fbd_state *state, size_t first, size_t count, double *powers)
{
    const struct instant at = state_instant(state);
    for (size_t i = first; i < first + count; i++) {
        int load = group_load(group, (int)i);
        if (ledger->integrated[load]) powers[load] += load_power(group->model, (int)i, &at, state->slots);
    }
}

/* Of loads between two bodies the sum of their powers on both. */
static void add_powers_of_diagram(struct ledger *ledger, const struct group *group, size_t b,
                                  const struct fbd_state *state, double *powers)
{
    const struct instant at = state_instant(state);
    size_t count = diagram_fill(group->model, (int)b, &at, state->slots, ledger->arrows);
    for (size_t i = 0; i < count; i++) {
        int load = group_load(group, ledger->arrows[i].load);
        if (load >= 0 && ledger->integrated[load]) powers[load] += ledger->arrows[i].power;
    }
}

/* Add the power of every integrated load of a group in a state of it. Loads on jointed bodies that follow from the
 * forces of others are in the diagrams only; `forces`: there are such loads, and these forces are known. */
static void add_powers(struct ledger *ledger, const struct group *group, const struct fbd_state *state,
                       bool forces, double *powers)
{
    const struct fbd_model *model = group->model;
    const struct instant at = state_instant(state);
    if (!forces) tree_move(model, &at);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        if (body->carried >= 0)
            powers[group_load(group, body->carried)] += body_carried_power(model, body, &at);
        if (forces && !body->alone)
            add_powers_of_diagram(ledger, group, b, state, powers);
        else
            add_powers_of_loads(ledger, group, state, (size_t)body->first_load, (size_t)body->load_count,
                                powers);
    }
    if (!forces)
        add_powers_of_loads(ledger, group, state, model->listed_count,
                            model->coupled_count - model->listed_count, powers);
}

/* Gauss-Legendre with five points on [-1, 1]: x = 0, sqrt(5 -+ 2 sqrt(10/7)) / 3 (Abramowitz & Stegun, table
 * 25.4), and a sixth point where |P_5|, which is zero at the five, is largest between them. */
static const double point[power_points] = {-0.90617984593866396, -0.53846931010568311, 0,
                                           0.53846931010568311,  0.90617984593866396,  0.76505532392946474};
static const double gauss[power_points] = {0.23692688505618908, 0.47862867049936647, 0.56888888888888889,
                                           0.47862867049936647, 0.23692688505618908, 0};

/* The weights that give the Legendre coefficients c_1 to c_5; c_5 follows from the difference between the
 * sixth sample and the interpolant of the five. */
static const double legendre[5][power_points] = {
    {-0.32204755229841747, -0.38659027500089127, 0, 0.38659027500089127, 0.32204755229841747, 0},
    {0.43342389699652306, -0.077868341440967534, -0.71111111111111114, -0.077868341440967534,
     0.43342389699652306, 0},
    {-0.41547714135083258, 0.69919864488923333, 0, -0.69919864488923333, 0.41547714135083258, 0},
    {0.2619960159204453, -0.74199601592044528, 0.95999999999999996, -0.74199601592044528, 0.2619960159204453,
     0},
    {-0.087093273766797458, 0.31623492037019446, -0.69711734125845348, 1.8192650194432558, 1.03138235726699,
     -2.3826716820551894},
};

/* A panel: a part of a group's last step. */
struct panel {
    size_t group;
    struct time_dd from;
    double length;
    bool forces; /* powers depend on more than coordinates and rates */
    int points;
    int halved;    /* number of halvings so far */
    double missed; /* error of the panel of which this is a half: of its mean power */
    double floor;  /* round-off level of its works; set only after an error was found */
};

/* Expressions of places and rates of masses are complete only after an evaluation, and the forces of some laws follow
 * from it. */
static bool reads_forces(const struct ledger *ledger, const struct group *group)
{
    const struct fbd_model *model = group->model;
    bool needs = model->names_places;
    for (size_t b = 0; b < model->body_count; b++) needs |= model->bodies[b].varies;
    for (size_t i = 0; i < model->load_count; i++)
        needs |= ledger->integrated[group_load(group, (int)i)] && !load_is_of_motion(model, (int)i);
    return needs;
}

/* Within a step, branches of switches are those of a state only after an evaluation. */
static bool needs_forces(const struct ledger *ledger, const struct group *group)
{
    return group->model->plan.kink_count > 0 || reads_forces(ledger, group);
}

static bool is_written(const struct model_load *load)
{
    return load->value.expr || load->angle.expr || load->fx.expr || load->fy.expr || load->potential.expr ||
           load->offset_x.expr || load->offset_y.expr || load->couple.expr;
}

/* Does the model have expressions, which may vary arbitrarily within a step? All other loads vary with the
 * motion. */
static bool has_expressions(const struct fbd_model *model)
{
    bool has = false;
    for (size_t i = 0; i < model->load_count; i++) has |= is_written(&model->loads[i]);
    for (size_t b = 0; b < model->body_count; b++)
        has |= model->bodies[b].varies || model->bodies[b].drive >= 0;
    for (int i = 0; i < model->tree->coupling_count; i++)
        has |= model->tree->couplings[i].reels || model->tree->couplings[i].surface_speed.expr;
    for (size_t i = 0; i < model->plan.mode_count; i++) {
        const struct mode *mode = &model->plan.modes[i];
        has |= mode_friction_varies(mode) || mode->surface_speed.expr;
    }
    return has;
}

static bool sample(struct ledger *ledger, struct ensemble *ensemble, const struct panel *panel)
{
    const struct group *group = &ensemble->groups[panel->group];
    for (int k = 0; k < panel->points; k++) {
        double *powers = ledger->powers + (size_t)k * ledger->model->load_count;
        for (size_t i = 0; i < group->model->load_count; i++) powers[group_load(group, (int)i)] = 0;
        struct time_dd t = time_dd_after(panel->from, panel->length / 2 * (1 + point[k]));
        struct fbd_state *state = ensemble_look_group(ensemble, panel->group, t, panel->forces);
        if (!state) return false;
        add_powers(ledger, group, state, panel->forces, powers);
    }
    return true;
}

static double sum_of(const struct ledger *ledger, const double weights[power_points], int load)
{
    double sum = 0;
    for (int k = 0; k < power_points; k++)
        sum += weights[k] * ledger->powers[(size_t)k * ledger->model->load_count + (size_t)load];
    return sum;
}

/* Twice the mean absolute power of a load. */
static double size_of(const struct ledger *ledger, int load)
{
    double sum = 0;
    for (int k = 0; k < gauss_points; k++)
        sum += gauss[k] * fabs(ledger->powers[(size_t)k * ledger->model->load_count + (size_t)load]);
    return sum;
}

/* Error of the rule for a mean power: the term of degree 10 of the series, extrapolated from the decay from
 * degrees 1 and 2 to degrees 3, 4 and 5 (a nonlinear estimate by null rules: Berntsen and Espelid, ACM TOMS
 * 17, 1991). A wave far shorter than the panel may look smooth at five points by chance, hardly at the sixth,
 * too. */
static double missed(const struct ledger *ledger, int load, int points)
{
    const double rounding = negligible_sum;
    double c[5] = {0};
    for (int k = 0; k < points - 1; k++) c[k] = fabs(sum_of(ledger, legendre[k], load));
    double low = fmax(c[0], c[1]), high = fmax(fmax(c[2], c[3]), c[4]);
    double decay = high < low ? high / low : 1;
    return high > rounding * size_of(ledger, load) ? high * decay * decay * decay : 0;
}

/* Errors of the rule in a panel. */
struct look {
    double missed, turnover; /* largest error of a load; integral of the absolute powers of all loads */
    bool waves;              /* the error is above the round-off level of its load's power */
};

static struct look look_at(const struct ledger *ledger, const struct group *group, const struct panel *panel)
{
    const double rounding = singular_force_rounding;
    struct look look = {0};
    for (size_t i = 0; i < group->model->load_count; i++) {
        int load = group_load(group, (int)i);
        if (!ledger->integrated[load]) continue;
        double by = missed(ledger, load, panel->points), size = size_of(ledger, load);
        look.turnover += panel->length / 2 * size;
        look.waves |= by > rounding * size;
        look.missed = fmax(look.missed, by);
    }
    return look;
}

/* Round-off level of the powers of a group at an instant, from rounding within formulas. */
static bool take_roundoff(struct ensemble *ensemble, const struct panel *panel, struct time_dd t,
                          double *roundoff)
{
    struct fbd_state *state = ensemble_look_group(ensemble, panel->group, t, true);
    if (!state) return false;
    struct instant at = state_instant(state);
    double sum = 0;
    for (size_t i = 0; i < state->model->load_count; i++) sum += load_power_rounding(state->model, i, &at);
    *roundoff = fmax(*roundoff, sum);
    return true;
}

/* Set the round-off level of the works of a panel. */
static bool set_floor(struct ensemble *ensemble, struct panel *panel)
{
    const double rounding = evaluation_rounding;
    double roundoff = 0;
    for (int k = 0; k < gauss_points; k++) {
        struct time_dd t = time_dd_after(panel->from, panel->length / 2 * (1 + point[k]));
        if (!take_roundoff(ensemble, panel, t, &roundoff)) return false;
    }
    struct fbd_state *state = ensemble_look_group(ensemble, panel->group, panel->from, true);
    if (!state) return false;
    struct rounded rounded = rounded_at(state); /* bodies at rest included */
    panel->floor = rounding * rounded.places + round_off(1, rounded.ways) * panel->length * panel->length +
                   panel->length * roundoff;
    return true;
}

/* Add the integral of power over a panel. Halve it where the powers vary faster than the motion: the step
 * size does not depend on the forces on bodies that stick on a belt, are driven, or stand between cancelling
 * forces. */
static bool add_panel(struct ledger *ledger, struct ensemble *ensemble, struct panel panel, struct sums *sums)
{
    enum { most_halved = 12, at_once = 3 };
    const double share = 0.1, progress = 0.25;
    const struct group *group = &ensemble->groups[panel.group];
    if (!sample(ledger, ensemble, &panel)) return false;
    struct look look = look_at(ledger, group, &panel);
    double tolerance = fmin(fmax(group->run->options.tolerance, least_part_tolerance), most_work_tolerance);
    double size = sums->lively + sums->turnover + look.turnover;
    double energy = panel.length * look.missed;
    bool more = energy > share * tolerance * size;
    if (more && panel.halved == 0 && !set_floor(ensemble, &panel)) return false;
    more = more && energy > panel.floor &&
           (look.waves || panel.halved < at_once || look.missed < progress * panel.missed);
    if (more && panel.halved < most_halved) {
        panel.length /= 2;
        panel.halved++;
        panel.missed = look.missed;
        struct panel second = panel;
        second.from = time_dd_after(panel.from, panel.length);
        return add_panel(ledger, ensemble, panel, sums) && add_panel(ledger, ensemble, second, sums);
    }
    if (more) sums->lost += panel.length;
    sums->turnover += look.turnover;
    for (size_t i = 0; i < group->model->load_count; i++) {
        int load = group_load(group, (int)i);
        if (ledger->integrated[load]) sums->work[load] += panel.length / 2 * sum_of(ledger, gauss, load);
    }
    return true;
}

/* Thousands of waves within a step: set the works to NAN. */
static void give_up(struct ledger *ledger, const struct group *group, const struct sums *sums)
{
    ledger->unresolved = true;
    for (size_t i = 0; i < group->model->load_count; i++) {
        int load = group_load(group, (int)i);
        if (ledger->integrated[load]) sums->work[load] = NAN;
    }
}

/* Has an integrated load of a group power in the last step? In flight contacts have none. */
static bool any_power(const struct ledger *ledger, const struct group *group)
{
    const struct fbd_model *model = group->model;
    for (size_t i = 0; i < model->load_count; i++) {
        bool acts = !group->run->flies || model->loads[i].source->kind != load_contact;
        if (acts && ledger->integrated[group_load(group, (int)i)]) return true;
    }
    return false;
}

/* Is the mean power of all integrated loads over the last step that in its mean state? */
static bool keeps_forces(const struct ledger *ledger, const struct group *group)
{
    for (size_t i = 0; i < group->model->load_count; i++)
        if (ledger->integrated[group_load(group, (int)i)] && !run_keeps_force(group->run, i)) return false;
    return true;
}

/* The works by the mean state, in closed form. */
static bool add_constant(struct ledger *ledger, struct ensemble *ensemble, size_t index, struct time_dd from,
                         struct time_dd to, struct sums *sums)
{
    struct group *group = &ensemble->groups[index];
    struct fbd_state *probe = ensemble_probe(ensemble, group);
    const double length = time_dd_since(to, from);
    const bool forces = reads_forces(ledger, group);
    for (size_t i = 0; i < group->model->load_count; i++) ledger->powers[group_load(group, (int)i)] = 0;
    if (!probe || !run_look_mean(group->run, from, to, forces, probe)) return false;
    add_powers(ledger, group, probe, forces, ledger->powers);
    for (size_t i = 0; i < group->model->load_count; i++) {
        int load = group_load(group, (int)i);
        if (!ledger->integrated[load]) continue;
        double work = length * ledger->powers[load];
        sums->work[load] += work;
        sums->turnover += fabs(work);
    }
    return true;
}

bool powers_integrate(struct ledger *ledger, struct ensemble *ensemble, size_t group, struct time_dd from,
                      struct time_dd to, struct sums *sums)
{
    const struct group *of = &ensemble->groups[group];
    double length = time_dd_since(to, from);
    if (!(length > 0) || !any_power(ledger, of)) return true;
    if (keeps_forces(ledger, of)) return add_constant(ledger, ensemble, group, from, to, sums);
    int panels = run_panels(of->run);
    bool done = true;
    struct panel panel = {.group = group,
                          .length = length / panels,
                          .forces = needs_forces(ledger, of),
                          .points = has_expressions(of->model) ? power_points : gauss_points};
    for (int i = 0; done && i < panels; i++) {
        panel.from = time_dd_after(from, i * length / panels);
        done = add_panel(ledger, ensemble, panel, sums);
    }
    if (sums->lost > length / 10) give_up(ledger, of, sums); /* more than the panels around a corner */
    return done;
}
