/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/couplings.h"

#include "dynamics/tree_system.h"
#include "fbd_study.h"
#include "output/equations.h"
#include "output/words.h"

/* ---- rows */

static int row_count(const struct fbd_model *model)
{
    return model->tree->row_count;
}

/* Rows that are active in the modes of an evaluated state: not those of a slack rope. */
static size_t rows_at_work(const struct fbd_state *state)
{
    struct instant at = state_instant(state);
    size_t count = 0;
    for (int j = 0; j < row_count(state->model); j++) count += tree_takes_part(state->model->tree, &at, j);
    return count;
}

size_t fbd_redundant(fbd_state *state, const char **names, size_t room)
{
    if (!state) return 0;
    if (!names) room = 0;
    const struct fbd_model *model = state->model;
    size_t count = 0;
    state_ready(state);
    struct instant at = state_instant(state);
    for (int j = 0; j < row_count(model); j++) {
        if (!tree_takes_part(model->tree, &at, j) || !state->tree->rows[j].redundant) continue;
        if (count < room) names[count] = coupling_row_name(model->tree, j);
        count++;
    }
    return count;
}

/* ---- the drift of a run */

/* For a nearly motionless coupling the reference speed is at least a thousandth of its size per run. */
static void add_drift(fbd_drift *all, const struct drift *drift, const struct run_options *options)
{
    if (!drift->worst) return;
    double tolerance = options->tolerance, reach = drift->reach > 0 ? drift->reach : 1;
    double speed = options->until > 0 ? fmax(drift->speed, 1e-3 * reach / options->until) : 1;
    if (drift->position >= all->position) all->worst = drift->worst;
    all->position = fmax(all->position, drift->position);
    all->velocity = fmax(all->velocity, drift->velocity);
    all->left_position = fmax(all->left_position, drift->left_position);
    all->left_velocity = fmax(all->left_velocity, drift->left_velocity);
    all->share = fmax(all->share, drift->position / (tolerance * reach));
    all->share = fmax(all->share, drift->velocity / (tolerance * speed));
    all->left_share = fmax(all->left_share, drift->left_position / (tolerance * reach));
    all->left_share = fmax(all->left_share, drift->left_velocity / (tolerance * speed));
}

fbd_drift fbd_simulation_drift(const fbd_simulation *simulation)
{
    if (!simulation) return (fbd_drift){.worst = ""};
    const struct ensemble *ensemble = simulation->ensemble;
    fbd_drift drift = {.worst = "", .rows = (size_t)row_count(ensemble->model)};
    for (size_t i = 0; i < ensemble->count; i++)
        if (ensemble->groups[i].run) add_drift(&drift, &ensemble->groups[i].run->drift, &ensemble->options);
    return drift;
}

/* ---- names after one another */

static void write_redundant(struct text *text, struct fbd_state *state)
{
    enum { most_named = 12 };
    const char *names[most_named];
    size_t count = fbd_redundant(state, names, most_named);
    for (size_t i = 0; i < count && i < most_named; i++) text_printf(text, "%s`%s`", i ? ", " : "", names[i]);
    if (count > most_named) text_printf(text, " and %zu more", count - most_named);
}

/* Write the ropes that are slack at the start. */
static void write_slack(struct text *text, fbd_state *state)
{
    enum { most_named = 12 };
    if (!state) return;
    const struct tree *tree = state->model->tree;
    state_ready(state);
    const struct instant at = state_instant(state);
    int count = 0;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling->kind != constraint_rope || tree_takes_part(tree, &at, coupling->first_row)) continue;
        if (count++ < most_named)
            text_printf(text, "%s`%s`", count > 1 ? ", " : "; slack at the start: ", coupling->name);
    }
    if (count > most_named) text_printf(text, " and %d more", count - most_named);
}

static void write_kind(struct text *text, const struct fbd_model *model, size_t kind)
{
    enum { most_named = 8 };
    const struct tree *tree = model->tree;
    size_t named = 0, rows = 0;
    int last = -1;
    for (int i = 0; i < tree->coupling_count; i++)
        if (tree->couplings[i].kind == kind) rows += (size_t)tree->couplings[i].row_count;
    if (rows == 0 || !constraint_laws[kind].words) return;
    text_printf(text, "  %s (%zu row%s)\n      ", constraint_laws[kind].words, rows, rows == 1 ? "" : "s");
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling->kind != kind || coupling->constraint == last) continue; /* the pieces of a rope */
        last = coupling->constraint;
        if (named++ < most_named) text_printf(text, "%s%s", named > 1 ? ", " : "", coupling->name);
    }
    if (named > most_named) text_printf(text, " and %zu more", named - most_named);
    text_add(text, "\n");
}

static void write_springs(struct text *text, const struct fbd_model *model)
{
    enum { most_named = 8 };
    size_t first = model->listed_count, count = model->coupled_count - first;
    if (count == 0) return;
    text_add(text, "  spring, damper or actuator between bodies (no row)\n      ");
    for (size_t i = 0; i < count && i < most_named; i++)
        text_printf(text, "%s%s", i ? ", " : "", model->loads[first + i].source->name);
    if (count > most_named) text_printf(text, " and %zu more", count - most_named);
    text_add(text, "\n");
}

void couplings_explain(struct text *text, struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    size_t couplings = model->scene->constraint_count + (model->coupled_count - model->listed_count);
    if (couplings == 0) return;
    text_printf(text, "\nCouplings (%zu)\n", couplings);
    write_springs(text, model);
    if (row_count(model) == 0) return;
    for (size_t k = 0; k < constraint_kinds; k++) write_kind(text, model, k);
    size_t redundant = fbd_redundant(state, NULL, 0), rows = rows_at_work(state);
    text_printf(text, "  as it starts: %d coordinates less %zu independent rows leave %td to move\n",
                model->plan.n, rows - redundant, model->plan.n - (ptrdiff_t)(rows - redundant));
    if (redundant == 0) {
        text_add(text, "  no row is redundant: each is independent of those before it\n");
        return;
    }
    text_add(text, "  redundant, dependent on the rows before them: ");
    write_redundant(text, state);
    text_add(text, "\n    (this does not affect the motion; of the possible forces those of the least sum of "
                   "squares are taken)\n");
}

/* ---- of a run */

static const char *length_rate_unit(const struct fbd_model *model)
{
    return model->scene->units == unit_si ? "m/s" : "ft/s";
}

void couplings_report(struct text *text, const fbd_result *result)
{
    fbd_drift drift = fbd_simulation_drift(result->simulation);
    const struct fbd_model *model = result->simulation->ensemble->model;
    const char *m = length_unit(model), *v = length_rate_unit(model);
    if (drift.rows == 0) return;
    size_t redundant = fbd_redundant(result->start, NULL, 0);
    text_printf(text, "\nCouplings: %zu row%s", drift.rows, drift.rows == 1 ? "" : "s");
    if (redundant > 0) {
        text_printf(text, ", %zu redundant at the start: ", redundant);
        write_redundant(text, result->start);
    }
    write_slack(text, result->start);
    text_add(text, "\n");
    if (!drift.worst[0]) return;
    text_printf(
        text, "  off by at most %.1e %s and %.1e %s at the end of a step (%.2g tolerances), `%s` the most\n",
        drift.position, m, drift.velocity, v, drift.share, drift.worst);
    text_printf(text, "  brought back to %.1e %s and %.1e %s (%.2g tolerances)\n", drift.left_position, m,
                drift.left_velocity, v, drift.left_share);
}

static void number(struct text *text, const char *name, double value)
{
    text_add(text, ", ");
    text_json_key(text, name);
    text_json_number(text, value);
}

void couplings_json(struct text *text, const fbd_result *result)
{
    enum { most_named = 64 };
    const char *names[most_named];
    fbd_drift drift = fbd_simulation_drift(result->simulation);
    if (drift.rows == 0) return;
    size_t redundant = fbd_redundant(result->start, names, most_named);
    text_printf(text, "  \"couplings\": {\"rows\": %zu, \"redundant\": [", drift.rows);
    for (size_t i = 0; i < redundant && i < most_named; i++) {
        text_add(text, i ? ", " : "");
        text_json_string(text, names[i]);
    }
    text_add(text, "], \"drift\": {\"worst\": ");
    text_json_string(text, drift.worst);
    number(text, "position", drift.position);
    number(text, "velocity", drift.velocity);
    number(text, "tolerances", drift.share);
    number(text, "left_position", drift.left_position);
    number(text, "left_velocity", drift.left_velocity);
    number(text, "left_tolerances", drift.left_share);
    text_add(text, "}},\n");
}
