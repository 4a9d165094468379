/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/fit.h"

#include "dynamics/constraint.h"
#include "dynamics/project.h"
#include "dynamics/tree_system.h"
#include "expr/unit.h"
#include "numeric/tolerances.h"

/* Changes of component i of a state below this are ignored, in a mechanism of that length: some digits of it,
 * or the rounding of the position. */
static double least_change(const struct fbd_state *state, int i, double length)
{
    const double rounding = round_off(64, 1);
    int n = state->model->plan.n;
    if (i >= n || state->model->scene->coordinates[i].angle) return nine_digits * fmax(1, fabs(state->y[i]));
    return nine_digits * length + rounding * fabs(state->y[i]);
}

/* "rod.theta = -0.7, ...": list the components that have to change; false when all change by rounding only. */
static bool list_changes(struct text *text, const struct fbd_state *from, const struct fbd_state *to,
                         double length)
{
    enum { most_listed = 6 };
    const struct fbd_model *model = from->model;
    int n = model->plan.n, listed = 0;
    for (int i = 0; i < 2 * n; i++) {
        double least = least_change(from, i, length);
        if (fabs(to->y[i] - from->y[i]) <= least) continue;
        if (listed++ >= most_listed) continue;
        const struct coordinate *c = &model->scene->coordinates[i % n]; /* an island has no labels */
        text_printf(text, "%s%s.%s = ", listed > 1 ? ", " : "", model->bodies[c->body].name,
                    i < n ? c->name : c->rate_name);
        text_number(text, fabs(to->y[i]) > least / 1000 ? to->y[i] : 0, 9);
    }
    if (listed > most_listed) text_add(text, ", ...");
    return listed > 0;
}

/* Position in the file of the coupling of a row. */
static struct pos place_of(const struct fbd_model *model, int row)
{
    return model->scene->constraints[model->tree->couplings[model->tree->coupling_of_row[row]].constraint].at;
}

/* A row whose residual exceeds its tolerance. */
struct miss {
    int row;
    double off, share; /* residual, and its ratio to the tolerance */
    double length;     /* scale of the coupling */
};

static void note_miss(struct miss *miss, int row, double off, double most, double length)
{
    double share = off / most;
    if (off <= most || share <= miss->share) return;
    *miss = (struct miss){row, off, isnan(share) ? HUGE_VAL : share, length};
}

/* Extent and speed of the trees connected by a coupling: measured from the first link, wherever it is in the
 * world. */
struct size {
    const struct coupling *coupling;
    double extent, place, speed;
};

static bool joins_the_same(const struct coupling *a, const struct coupling *b)
{
    if (!a || a->root_count != b->root_count) return false;
    for (int k = 0; k < a->root_count; k++)
        if (a->root[k] != b->root[k]) return false;
    return true;
}

/* Successive couplings often join the same trees. */
static void find_size(const struct fbd_state *state, const struct coupling *coupling, struct size *size)
{
    const struct tree *tree = state->model->tree;
    if (joins_the_same(size->coupling, coupling)) return;
    *size = (struct size){coupling, 0, 0, 0};
    for (int k = 0; k < coupling->root_count; k++)
        for (int i = coupling->root[k]; i < tree->links[coupling->root[k]].end; i++) {
            const struct tree_state *s = &state->tree->links[i];
            struct vec from = state->tree->links[coupling->root[0]].p;
            size->extent = fmax(size->extent, vec_norm(vec_sub(s->p, from)));
            size->place = fmax(size->place, vec_norm(s->p));
            size->speed = fmax(size->speed, fmax(vec_norm(s->v), fabs(s->omega)));
        }
}

/* The length scale of the position of row j: of the trees, the arms of its ports, the length of a rod or
 * rope. Coincident points without these have no size: the scale is their distance from the origin or from the
 * ends of the coupling, and for contacts also that of the contact. */
static double length_of(const struct fbd_state *state, const struct coupling *coupling, int j,
                        const struct size *size)
{
    const struct row *row = &state->tree->rows[j];
    double length = size->extent;
    for (int k = 0; k < row->port_count; k++)
        if (row->ports[k].link > 0) length = fmax(length, vec_norm(row->ports[k].arm));
    if (coupling->law->length)
        length = fmax(length, fabs(state->tree->couplings[coupling - state->model->tree->couplings].zero));
    if (length > 0) return length;
    length = fmax(size->place, coupling_extent(coupling));
    return coupling->meeting >= 0 ? fmax(length, state->model->tree->meetings[coupling->meeting].reach)
                                  : length;
}

/* Find the rows with the largest residuals, in position and in velocity. A slack rope may be shorter, but not
 * longer. */
static void find_misses(struct fbd_state *state, struct miss *position, struct miss *velocity)
{
    const double digits = six_digits;
    const double rounding = round_off(64, 1);
    const struct tree *tree = state->model->tree;
    struct instant at = state_instant(state);
    struct size size = {NULL, 0, 0, 0};
    *position = *velocity = (struct miss){-1, 0, 0, 0};
    state_misfit(state); /* evaluates the rows */
    for (int j = 0; j < tree->row_count; j++) {
        const struct coupling *coupling = &tree->couplings[tree->coupling_of_row[j]];
        const struct jet g = state->tree->rows[j].g;
        bool held = tree_takes_part(tree, &at, j);
        bool rubs = coupling->kind == constraint_capstan && j == coupling->first_row; /* slack, or too long */
        bool on_line = coupling->kind == constraint_roll &&
                       j == coupling->first_row; /* at the start, whatever its mode */
        if (!held && coupling->kind != constraint_rope && !on_line && !rubs) continue;
        find_size(state, coupling, &size);
        double length = length_of(state, coupling, j, &size),
               most = digits * length + rounding * fmax(size.place, coupling_extent(coupling));
        note_miss(position, j, held || on_line ? fabs(g.x) : fmax(0, rubs ? -g.x : g.x), most, length);
        if (held) note_miss(velocity, j, fabs(g.x1), digits * size.speed, length);
    }
}

/* Close ropes that exceed their length, and rolling couplings. */
static void pull_taut(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    for (size_t i = 0; i < plan->mode_count; i++) {
        const struct mode *hold = &plan->modes[i];
        if (!mode_is_one_sided(hold)) continue;
        double g = state->tree->rows[state->model->tree->couplings[hold->coupling].first_row].g.x;
        if (hold->kind == mode_surface || g > 0) state->slip[i] = stick;
    }
}

static void add_miss(const struct fbd_model *model, const struct miss *miss, bool by_velocity,
                     struct text *text)
{
    const struct coupling *coupling = &model->tree->couplings[model->tree->coupling_of_row[miss->row]];
    char unit[24];
    unit_name(by_velocity ? DIM_VELOCITY : DIM_LENGTH, model->scene->units, unit, sizeof unit);
    const char *angle = by_velocity ? "rad/s" : "rad";
    text_printf(text, "`%s` is off by %.3g %s%s", coupling->name, miss->off,
                coupling->source->angular ? angle : unit, by_velocity ? " in velocity" : "");
}

/* Two pins of one point. The distance of their other ends is the difference of their rows, for any position
 * of the point. */
static bool pins_one_point(const struct fbd_state *state, const struct coupling *a, const struct coupling *b,
                           double *apart)
{
    const struct row *rows = state->tree->rows;
    if (a->kind != constraint_pin || b->kind != constraint_pin) return false;
    for (int k = 0; k < 2; k++)
        for (int l = 0; l < 2; l++) {
            const struct port *p = &rows[a->first_row].ports[k], *q = &rows[b->first_row].ports[l];
            if (p->link == 0 || p->link != q->link || vec_norm(vec_sub(p->arm, q->arm)) > 0) continue;
            const double sign = k == l ? 1 : -1;
            *apart = hypot(rows[a->first_row].g.x - sign * rows[b->first_row].g.x,
                           rows[a->first_row + 1].g.x - sign * rows[b->first_row + 1].g.x);
            return true;
        }
    return false;
}

/* List the couplings that are violated after the projection has minimized the violations: they exclude each
 * other. */
static void list_excluded(struct fbd_state *state, double length, struct text *lack)
{
    enum { most_listed = 4 };
    const double digits = six_digits;
    const struct tree *tree = state->model->tree;
    const struct coupling *off[most_listed];
    int count = 0;
    double apart;
    state_misfit(state); /* evaluates the rows */
    const struct instant at = state_instant(state);
    for (int i = 0; i < tree->coupling_count && count < most_listed; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        bool misses = false;
        for (int j = coupling->first_row; j < coupling->first_row + coupling->row_count; j++)
            misses |= tree_takes_part(tree, &at, j) && fabs(state->tree->rows[j].g.x) > digits * length;
        if (misses) off[count++] = coupling;
    }
    if (count < 2) return;
    text_add(lack, ": ");
    for (int i = 0; i < count; i++)
        text_printf(lack, "%s`%s`", i == 0 ? "" : i + 1 < count ? ", " : " and ", off[i]->name);
    if (count == 2 && pins_one_point(state, off[0], off[1], &apart)) {
        char unit[24];
        unit_name(DIM_LENGTH, state->model->scene->units, unit, sizeof unit);
        text_printf(lack, " pin one point to two places, %.6g %s apart", apart, unit);
    } else {
        text_add(lack, " cannot hold together");
    }
}

/* Describe the violation and the nearest consistent state; false when that differs by rounding only, as at
 * rest, where speeds have no scale. */
static bool tell(const struct fbd_state *state, struct fbd_state *other, const struct miss *miss,
                 bool by_velocity, struct text *lack)
{
    struct text changes = {0};
    state_copy(other, state);
    state_misfit(other);
    pull_taut(other);
    bool closed = state_project(other, false),
         differs = !closed || list_changes(&changes, state, other, miss->length);
    if (differs) {
        add_miss(state->model, miss, by_velocity, lack);
        text_add(lack, ". ");
        if (closed)
            text_printf(lack, "Nearest is %s; or let bodies find their place, `initial: {assemble: true}`",
                        changes.failed ? "" : changes.data);
        else {
            text_add(lack, "No state near it fits");
            list_excluded(other, miss->length, lack);
        }
    }
    text_free(&changes);
    return differs;
}

/* Name of point k of a rope's path. */
static const char *name_at(const struct fbd_model *model, const struct coupling *coupling, int k)
{
    return coupling->end[k].body < 0 ? "the ground" : model->bodies[coupling->end[k].body].name;
}

/* Both paths around a disc are equally far on the side that the file names. */
static bool unclear_side(const struct fbd_state *state, int index, struct pos *at, struct text *lack)
{
    const struct fbd_model *model = state->model;
    const struct coupling *coupling = &model->tree->couplings[index];
    for (int end = 0; end < 2; end++) {
        if (coupling->wound[end] == 0 || state->tree->couplings[index].side[end] != 0) continue;
        bool upright = coupling->wound[end] == wound_top || coupling->wound[end] == wound_bottom;
        if (at) *at = model->scene->constraints[coupling->constraint].at;
        text_printf(lack, "both ways of `%s` round `%s` leave it equally far to that `side`. Say %s",
                    coupling->name, name_at(model, coupling, end == 0 ? 0 : coupling->end_count - 1),
                    upright ? "`left` or `right`" : "`top` or `bottom`");
        return true;
    }
    return false;
}

/* The point of a slot is beyond an end of it. */
static bool beyond_end(const struct fbd_state *state, int index, struct pos *at, struct text *lack)
{
    const double digits = six_digits;
    const struct coupling *coupling = &state->model->tree->couplings[index];
    for (int end = 0; end < 2 && !slot_is_open(coupling, state->slip); end++) {
        struct room room = coupling_room(state->model, state->tree, index, end);
        if (room.left >= -digits * room.size) continue;
        if (at) *at = coupling->source->at;
        text_printf(lack, "the point of `%s` is beyond the end of its slot, by %.6g", coupling->name,
                    -room.left);
        return true;
    }
    return false;
}

/* Two points of a taut rope's path coincide: its force has no direction there. */
static bool shrunk_rope(const struct fbd_state *state, int index, struct pos *at, struct text *lack)
{
    const struct fbd_model *model = state->model;
    const struct coupling *coupling = &model->tree->couplings[index];
    struct vec where;
    int k = rope_shrunk_at(model, state->tree, index, &where);
    if (k < 0) return false;
    if (at) *at = model->scene->constraints[coupling->constraint].at;
    text_printf(lack, "`%s` has no length between `%s` and `%s`: both are at (", coupling->name,
                name_at(model, coupling, k), name_at(model, coupling, k + 1));
    text_number(lack, where.x, 6);
    text_add(lack, ", ");
    text_number(lack, where.y, 6);
    text_add(lack, "), so that it has no direction there. Move them apart");
    return true;
}

bool fit_blocked(struct fbd_state *state, struct pos *at, struct text *lack)
{
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    if (tree->coupling_count == 0) return false;
    state_misfit(state); /* updates the positions of the links */
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (beyond_end(state, i, at, lack)) return true;
        if (!coupling->law->way) continue;
        if (unclear_side(state, i, at, lack) || shrunk_rope(state, i, at, lack)) return true;
        int k = rope_blocked_at(model, state->tree, i);
        if (k < 0) continue;
        if (at) *at = model->scene->constraints[coupling->constraint].at;
        text_printf(lack,
                    "`%s` has no way from `%s` to `%s`: they are nearer to each other than the rim of the "
                    "pulley. Move them apart",
                    coupling->name, name_at(model, coupling, k), name_at(model, coupling, k + 1));
        return true;
    }
    return false;
}

bool fit_lack(struct fbd_state *state, struct fbd_state *other, struct pos *at, struct text *lack)
{
    const struct tree *tree = state->model->tree;
    if (tree->coupling_count == 0) return false;
    struct miss position, velocity;
    find_misses(state, &position, &velocity);
    const struct miss *miss = position.row >= 0 ? &position : &velocity;
    if (miss->row < 0) return false;
    const char *name = tree->couplings[tree->coupling_of_row[miss->row]].name;
    if (at) *at = place_of(state->model, miss->row);
    if (isfinite(miss->off)) return tell(state, other, miss, miss == &velocity, lack);
    text_printf(lack, "`%s` joins points that are at one place: it has no direction. Move them apart", name);
    return true;
}

bool fit_unsolved(struct fbd_state *state, bool *masses, struct pos *at, struct text *lack)
{
    const double digits = six_digits;
    int row;
    if (state->model->tree->coupling_count == 0) return false;
    state_evaluate(state);
    const double miss = state_acceleration_misfit(state, &row), ratio = state->model->tree->mass_ratio;
    if (miss <= digits || row < 0) return false;
    *masses = ratio > masses_far_apart;
    if (at) *at = place_of(state->model, row);
    const char *name = coupling_row_name(state->model->tree, row);
    if (*masses)
        text_printf(
            lack,
            "the force of `%s` cannot be computed: accelerations violate it by %.2g of their size, as the "
            "masses of "
            "jointed bodies are too far apart: the heaviest has %.2g times the mass of the lightest, and up "
            "to about 1e12 can be solved. Give the lightest body more mass, or couple the bodies without it",
            name, miss, ratio);
    else
        text_printf(lack,
                    "no finite force of `%s` holds the mechanism: accelerations violate it by %.2g of their "
                    "size. Its couplings are in a singular position, in which they cannot carry the loads: "
                    "add a support, or start at another position",
                    name, miss);
    return true;
}

bool fit_locked(const struct fbd_state *state, struct fbd_state *other, struct pos *at, struct text *lack)
{
    int row = state_locked_row(state, other);
    if (row < 0) return false;
    if (at) *at = place_of(state->model, row);
    text_printf(lack,
                "it is at rest in a singular position: the bodies joined by `%s` are in line, so that the "
                "coupling resists the motion only to second order. No finite forces hold it there, or two "
                "motions are possible. Start at a neighbouring position, or with a speed",
                coupling_row_name(state->model->tree, row));
    return true;
}
