/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/fit.h"

#include "dynamics/project.h"
#include "dynamics/tree.h"

/* "rod.theta = -0.7, ...": what has to change; false when that is nothing but rounding. */
static bool list_changes(struct text *text, const struct fbd_state *from, const struct fbd_state *to)
{
    enum { most_listed = 6 };
    const struct fbd_model *model = from->model;
    int n = model->plan.n, listed = 0;
    for (int i = 0; i < 2 * n; i++) {
        double size = fmax(1, fabs(from->y[i]));
        if (fabs(to->y[i] - from->y[i]) <= 1e-9 * size) continue;
        if (listed++ >= most_listed) continue;
        const struct label *label = &model->labels[i % n];
        text_printf(text, "%s%s = ", listed > 1 ? ", " : "", i < n ? label->name : label->rate_name);
        text_number(text, fabs(to->y[i]) > 1e-12 * size ? to->y[i] : 0, 9);
    }
    if (listed > most_listed) text_add(text, ", ...");
    return listed > 0;
}

/* What is wrong and what is next to it; false when that differs by rounding only, as where everything is at
 * rest but for rounding and speeds have no size to go by. */
static bool tell(const struct fbd_state *state, struct fbd_state *other, const char *name, double off,
                 bool by_velocity, struct text *lack)
{
    struct text changes = {0};
    state_copy(other, state);
    bool closed = state_project(other, false), differs = !closed || list_changes(&changes, state, other);
    if (differs) {
        text_printf(lack, "`%s` is off by %.3g%s. ", name, off, by_velocity ? " in velocity" : "");
        if (closed)
            text_printf(lack, "Nearest is %s; or let bodies find their place, `initial: {assemble: true}`",
                        changes.failed ? "" : changes.data);
        else
            text_add(lack, "No state near it fits");
    }
    text_free(&changes);
    return differs;
}

/* Of the coupling that a row is of. */
static struct pos place_of(const struct fbd_model *model, int row)
{
    return model->scene->constraints[model->tree->ties[model->tree->tie_of_row[row]].constraint].at;
}

bool fit_lack(struct fbd_state *state, struct fbd_state *other, struct pos *at, struct text *lack)
{
    const double digits = 2e-6; /* six digits in a file are meant to fit */
    const struct tree *tree = state->model->tree;
    if (!tree || tree->tie_count == 0) return false;
    struct misfit misfit = state_misfit(state);
    double reach = 0, speed = 0;
    for (int i = 1; i < tree->count; i++) {
        const struct tree_state *s = &state->tree->links[i];
        reach = fmax(reach, fmax(vec_norm(s->p), vec_norm(s->d)));
        speed = fmax(speed, fmax(vec_norm(s->v), fabs(s->omega)));
    }
    bool position = !(misfit.position <= digits * reach), velocity = !(misfit.velocity <= digits * speed);
    if (!position && !velocity) return false;
    int row = position ? misfit.row : misfit.velocity_row;
    double off = position ? misfit.position : misfit.velocity;
    if (at) *at = place_of(state->model, row);
    return tell(state, other, tree->ties[tree->tie_of_row[row]].name, off, !position, lack);
}

bool fit_check(struct fbd_state *state, const char *what, fbd_errors *errors)
{
    struct text lack = {0};
    struct pos at = {0, 0};
    struct fbd_state *other = state_new(state->model);
    bool fits = other && !fit_lack(state, other, &at, &lack);
    diag_in_file(errors, state->model->scene->file);
    if (!other || lack.failed)
        diag_out_of_memory(errors);
    else if (!fits)
        diag_add(errors, FBD_ERROR, "does-not-fit", at, NULL, "%s does not fit: %s", what, lack.data);
    text_free(&lack);
    state_free(other);
    return fits;
}

bool fit_unsolved(struct fbd_state *state, struct pos *at, struct text *lack)
{
    const double digits = 1e-6;
    int row;
    if (!state->model->tree || state->model->tree->tie_count == 0) return false;
    state_evaluate(state);
    double miss = state_acceleration_misfit(state, &row);
    if (miss <= digits) return false;
    if (at) *at = place_of(state->model, row);
    text_printf(
        lack,
        "the force of `%s` cannot be told: accelerations miss it by %.2g of their size, as the masses that "
        "it joins are too far apart. Give the lightest body more mass, or let a coupling do without it",
        tie_row_name(state->model->tree, row), miss);
    return true;
}
