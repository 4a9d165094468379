/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: forces, energies and works as columns (output/run_columns.h).
 */
#include <math.h>
#include <stdlib.h>

#include "dynamics/diagram.h"
#include "fbd_exchange.h"
#include "output/equations.h"
#include "output/run_columns.h"
#include "record/ledger.h"
#include "record/result.h"

struct fbd_force_columns {
    struct run_columns columns;
    struct arrow *arrows; /* of the views */
    size_t *listed;       /* the columns of these kinds */
    size_t count;
    struct ledger ledger;
    struct ensemble *followed; /* of the works; NULL: none are integrated */
    double *work;              /* of the loads, up to the state */
};

static bool is_listed(const struct run_column *column)
{
    return (column->kind == column_force && !column->extra) || column->kind == column_work ||
           column->kind == column_carried_work || column->kind == column_energy;
}

static bool make(fbd_force_columns *forces, const fbd_model *model)
{
    struct run_columns *columns = &forces->columns;
    struct fbd_state *start = fbd_state_new(model);
    columns->model = model;
    const size_t room = diagram_most_arrows(model);
    columns->arrows = calloc(2 * room + 1, sizeof *columns->arrows);
    forces->arrows = columns->arrows ? columns->arrows + room : NULL;
    const bool made = start && columns->arrows && run_columns_make(columns, column_in_ledger, start) &&
                      ledger_init(&forces->ledger, model, start, false);
    state_free(start);
    if (!made) return false;
    forces->listed = calloc(columns->count + 1, sizeof *forces->listed);
    forces->work = calloc(model->load_count + 1, sizeof *forces->work);
    for (size_t i = 0; forces->listed && i < columns->count; i++)
        if (is_listed(&columns->list[i])) forces->listed[forces->count++] = i;
    return forces->listed && forces->work;
}

fbd_force_columns *fbd_force_columns_new(const fbd_model *model)
{
    fbd_force_columns *forces = model ? calloc(1, sizeof *forces) : NULL;
    if (!forces || make(forces, model)) return forces;
    fbd_force_columns_free(forces);
    return NULL;
}

void fbd_force_columns_free(fbd_force_columns *forces)
{
    if (!forces) return;
    if (forces->followed) forces->followed->observer = (struct observer){0};
    ledger_free(&forces->ledger);
    free(forces->work);
    free(forces->columns.arrows);
    free(forces->listed);
    run_columns_free(&forces->columns);
    free(forces);
}

size_t fbd_force_columns_count(const fbd_force_columns *forces)
{
    return forces ? forces->count : 0;
}

static const struct run_column *column_at(const fbd_force_columns *forces, size_t index)
{
    return forces && index < forces->count ? &forces->columns.list[forces->listed[index]] : NULL;
}

const char *fbd_force_columns_name(const fbd_force_columns *forces, size_t index)
{
    const struct run_column *column = column_at(forces, index);
    return column ? column->name : NULL;
}

const char *fbd_force_columns_unit(const fbd_force_columns *forces, size_t index)
{
    const struct run_column *column = column_at(forces, index);
    return column ? column->unit : NULL;
}

fbd_column_kind fbd_force_columns_kind(const fbd_force_columns *forces, size_t index)
{
    enum { kinetic_and_potential = 2 };
    const struct run_column *column = column_at(forces, index);
    if (!column || column->kind == column_force) return FBD_COLUMN_FORCE;
    const bool of_state = column->kind == column_energy && column->part < kinetic_and_potential;
    return of_state ? FBD_COLUMN_ENERGY : FBD_COLUMN_WORK;
}

/* ---- works along a simulation */

static bool observe(void *context, struct ensemble *ensemble, size_t group)
{
    fbd_force_columns *forces = context;
    struct ledger *ledger = &forces->ledger;
    if (!ledger->any || !ledger_counts(ledger, &ensemble->groups[group])) return true;
    ledger_note(ledger, &ensemble->groups[group]);
    return ledger_step(ledger, ensemble, group);
}

static void observe_again(void *context, struct ensemble *ensemble, size_t group)
{
    fbd_force_columns *forces = context;
    if (forces->ledger.any) ledger_restart(&forces->ledger, ensemble, group);
}

bool fbd_force_columns_follow(fbd_force_columns *forces, fbd_simulation *simulation)
{
    struct ensemble *ensemble = simulation ? simulation->ensemble : NULL;
    if (!forces || !ensemble || forces->followed || ensemble->model != forces->columns.model ||
        ensemble->started)
        return false;
    ledger_free(&forces->ledger);
    if (!ledger_init(&forces->ledger, ensemble->model, ensemble_state(ensemble), true)) return false;
    ensemble->observer = (struct observer){forces, observe, observe_again};
    forces->followed = ensemble;
    return true;
}

static bool has_works(const fbd_force_columns *forces, double t)
{
    const struct ensemble *ensemble = forces->followed;
    return ensemble && t >= ensemble->from && t <= ensemble->t;
}

bool fbd_force_columns_values(fbd_force_columns *forces, fbd_state *state, double *values)
{
    if (!forces || !state || !values || state->model != forces->columns.model) return false;
    const bool works = has_works(forces, state->t);
    if (works && !ledger_within(&forces->ledger, forces->followed, state->t, forces->work)) return false;
    state_ready(state);
    struct column_view view;
    column_view_begin(&view, state, &forces->ledger, forces->work, forces->arrows);
    for (size_t i = 0; i < forces->count; i++) {
        const bool known = works || fbd_force_columns_kind(forces, i) != FBD_COLUMN_WORK;
        values[i] = known ? run_column_value(column_at(forces, i), &view) : NAN;
    }
    return true;
}
