/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Accelerations: the tree in its modes, bodies outside the tree, dry friction.
 */

#include "emit/bodies.h"
#include "emit/placed.h"

static void close_text(struct emitter *emitter, struct text *lines)
{
    emitter->arena.failed = emitter->arena.failed || lines->failed;
    text_free(lines);
}

/* ---- laws of pairs */

static const char *law_of(struct emitter *emitter, int pair, const char *key, const struct formula *formula,
                          struct dim dim)
{
    const struct mode *mode = mode_of(emitter, pair);
    const char *owner = emitter->load[mode->load];
    return emit_formula(emitter, formula, emit_join(emitter, owner, key),
                        (struct emit_origin){emitter->model->loads[mode->load].source->at, key, dim,
                                             mode->body});
}

static const char *speed_of(struct emitter *emitter, int pair, bool acceleration)
{
    const struct mode *mode = mode_of(emitter, pair);
    const char *owner = emitter->load[mode->load];
    const struct formula *speed = &mode->surface_speed;
    bool bearing = mode->normal_slot < 0;
    if (mode->kind == mode_drive) {
        if (!mode->position.expr) return "0";
        return emit_printf(emitter, acceleration ? "%s.dd" : "%s.d",
                           emit_slope(emitter, &mode->position, emit_join(emitter, owner, "motion"), 0,
                                      drive_origin(emitter, mode)));
    }
    if (!acceleration)
        return mode->moving ? law_of(emitter, pair, "surface_speed", speed, bearing ? DIM_RATE : DIM_VELOCITY)
                            : "0";
    if (formula_is_constant(speed)) return "0";
    return emit_printf(emitter, "%s.d",
                       emit_slope(emitter, speed, emit_join(emitter, owner, "surface_acceleration"), 0,
                                  (struct emit_origin){emitter->model->loads[mode->load].source->at,
                                                       "surface_speed", DIM_VELOCITY, mode->body}));
}

static const char *static_law(struct emitter *emitter, int pair)
{
    struct dim dim = mode_of(emitter, pair)->normal_slot < 0 ? DIM_MOMENT : DIM_NONE;
    if (mode_of(emitter, pair)->kind == mode_drive) return "HUGE_VAL";
    return law_of(emitter, pair, "static", &mode_of(emitter, pair)->mu_s, dim);
}

static const char *kinetic_law(struct emitter *emitter, int pair)
{
    struct dim dim = mode_of(emitter, pair)->normal_slot < 0 ? DIM_MOMENT : DIM_NONE;
    if (mode_of(emitter, pair)->kind == mode_drive) return "0";
    return law_of(emitter, pair, "kinetic", &mode_of(emitter, pair)->mu_k, dim);
}

static const char *surface_speed(struct emitter *emitter, int pair)
{
    return speed_of(emitter, pair, false);
}

static const char *surface_acceleration(struct emitter *emitter, int pair)
{
    return speed_of(emitter, pair, true);
}

static void write_law(struct emitter *emitter, const char *head, const char *value(struct emitter *, int))
{
    struct text lines = {0};
    text_add(&lines, "    switch (pair) {\n");
    for (int pair = 0; pair < (int)emitter->model->plan.mode_count; pair++)
        text_printf(&lines, "    case %s: return %s;\n", emitter->pair[pair], value(emitter, pair));
    text_add(&lines, "    default: return 0;\n    }\n");
    emit_function(&emitter->formulas, head, "const struct scene *s, double t, const double *y, int pair",
                  &lines);
    close_text(emitter, &lines);
}

static const char *inertia_of(struct emitter *emitter, int pair)
{
    const struct mode *mode = mode_of(emitter, pair);
    if (mode->kind != mode_single) return "0";
    return emit_printf(emitter, mode->normal_slot < 0 ? "c->%s.I_O" : "c->%s.mass",
                       emitter->body[mode->body]);
}

static void write_laws(struct emitter *emitter)
{
    if (emitter->model->plan.mode_count == 0) return;
    write_law(
        emitter,
        "/* How fast the surface of a pair moves, and its acceleration. */\nstatic double surface_speed",
        surface_speed);
    write_law(emitter, "static double surface_acceleration", surface_acceleration);
    write_law(emitter, "/* Coefficients of friction; of a bearing, its moments. */\nstatic double mu_static",
              static_law);
    write_law(emitter, "static double mu_kinetic", kinetic_law);
    struct text lines = {0};
    text_add(&lines, "    switch (pair) {\n");
    for (int pair = 0; pair < (int)emitter->model->plan.mode_count; pair++)
        text_printf(&lines, "    case %s: return %s;\n", emitter->pair[pair], inertia_of(emitter, pair));
    text_add(&lines, "    default: return 0;\n    }\n");
    emit_function(
        &emitter->formulas,
        "/* The inertia that a pair holds against its surface; 0 where the joint counts it already. */\n"
        "static double inertia_of",
        "const struct scene *s, int pair", &lines);
    close_text(emitter, &lines);
}

/* ---- the tree */

static const char *link_name(const struct emitter *emitter, int link)
{
    return link == 0 ? "ground" : emitter->body[emitter->model->tree->links[link].body];
}

/* Lock sticking joints. */
static void lock_joints(struct emitter *emitter, struct text *lines)
{
    const struct tree *tree = emitter->model->tree;
    for (int k = 0; k < tree->joined_watched; k++) {
        const struct tree_link *link = &tree->links[tree->watched[k]];
        if (link->pair < 0) continue;
        const char *name = link_name(emitter, tree->watched[k]), *pair = emitter->pair[link->pair];
        text_printf(
            lines,
            "    l.%s.locked = s->slip[%s] == 0;\n    l.%s.held = surface_acceleration(s, t, y, %s);\n", name,
            pair, name, pair);
    }
}

static void rub_bearings(struct emitter *emitter, struct text *lines)
{
    const struct tree *tree = emitter->model->tree;
    for (int k = 0; k < tree->joined_watched; k++) {
        const struct tree_link *link = &tree->links[tree->watched[k]];
        if (link->pair < 0 || !link_joint(link)->has_axis || mode_of(emitter, link->pair)->kind == mode_drive)
            continue;
        const char *pair = emitter->pair[link->pair];
        text_printf(lines, "    l.%s.g -= s->slip[%s]*mu_kinetic(s, t, y, %s);\n",
                    link_name(emitter, tree->watched[k]), pair, pair);
    }
}

static const char *normal_of(struct emitter *emitter, int i, const char *force)
{
    return emit_printf(emitter, "vec_dot(vec_turn(l.%s.turn, c->%s.link.n), %s)",
                       link_name(emitter, emitter->model->tree->links[i].parent), link_name(emitter, i),
                       force);
}

/* Solve for the friction of slides: it is proportional to normal forces, which depend on all frictions (a
 * linear system). */
static void close_frictions(struct emitter *emitter, struct text *lines)
{
    const struct tree *tree = emitter->model->tree;
    int m = tree->pair_count;
    text_printf(
        lines,
        "\n    /* friction that slips goes with the force across its slide, which depends on it again */\n"
        "    double share[%d], friction[%d], matrix[%d], answer[coordinates];\n",
        m, m, m * m);
    for (int k = 0; k < m; k++) {
        const struct tree_link *link = &tree->links[tree->pairs[k]];
        const char *name = link_name(emitter, tree->pairs[k]), *pair = emitter->pair[link->pair];
        text_printf(lines, "    share[%d] = s->slip[%s]*s->pull[%s]*mu_kinetic(s, t, y, %s);\n", k, pair,
                    pair, pair);
        text_printf(lines, "    friction[%d] = -share[%d]*%s;\n", k, k,
                    normal_of(emitter, tree->pairs[k], emit_printf(emitter, "l.%s.F.force", name)));
    }
    for (int k = 0; k < m; k++) {
        text_printf(lines,
                    "    clear_links(&l);\n    l.%s.g = 1;\n    pass_links_inward(&l);\n    "
                    "give_links_outward(&l, answer);\n",
                    link_name(emitter, tree->pairs[k]));
        for (int j = 0; j < m; j++)
            text_printf(lines, "    matrix[%d] = share[%d]*%s%s;\n", j * m + k, j,
                        normal_of(emitter, tree->pairs[j],
                                  emit_printf(emitter, "force_in(&l.%s)",
                                              link_name(emitter, tree->pairs[j]))),
                        j == k ? " + 1" : "");
    }
    text_printf(lines, "    solve_linear(%d, matrix, friction);\n    clear_links(&l);\n", m);
    for (int k = 0; k < m; k++)
        text_printf(lines, "    l.%s.g = friction[%d];\n", link_name(emitter, tree->pairs[k]), k);
    text_add(lines, "    pass_links_inward(&l);\n    give_links_outward(&l, answer);\n");
    for (int i = 1; i < tree->joined; i++)
        for (int k = 0; k < emitter->model->bodies[tree->links[i].body].count; k++)
            text_printf(lines, "    a[%s] += answer[%s];\n",
                        emitter->coordinate[tree->links[i].coordinate + k],
                        emitter->coordinate[tree->links[i].coordinate + k]);
    text_add(lines, "    transmit_links(&l);\n\n");
}

static void write_slots(struct emitter *emitter, struct text *lines)
{
    const struct tree *tree = emitter->model->tree;
    for (int k = 0; k < tree->joined_watched; k++) {
        int i = tree->watched[k];
        const struct tree_link *link = &tree->links[i];
        const char *name = link_name(emitter, i), *slot = emitter->coordinate[link->coordinate];
        if (link->pair >= 0)
            text_printf(lines, "    if (l.%s.locked) a[%s] = l.%s.held;\n", name, slot, name);
        if (link->normal_slot >= 0)
            text_printf(lines, "    f[%s] = -%s;\n", emitter->slot[link->normal_slot],
                        normal_of(emitter, i, emit_printf(emitter, "l.%s.F.force", name)));
        if (link->pair < 0) continue;
        const char *own = link_joint(link)->has_axis
                              ? emit_printf(emitter, "l.%s.F.moment", name)
                              : emit_printf(emitter, "vec_dot(l.%s.e, l.%s.F.force)", name, name);
        text_printf(lines, "    f[%s] = f[%s] - %s;\n",
                    emitter->slot[mode_of(emitter, link->pair)->hold_slot], slot, own);
    }
}

static void write_tree(struct emitter *emitter)
{
    const struct tree *tree = emitter->model->tree;
    struct text lines = {0};
    text_add(&lines, emit_new_links);
    lock_joints(emitter, &lines);
    text_add(&lines, "    move_links(s, y, &l);\n    bias_links(s, y, &l);\n");
    if (emitter->walks) text_add(&lines, "    load_links(s, t, y, &l);\n");
    text_add(&lines, "    push_joints(f, &l);\n");
    rub_bearings(emitter, &lines);
    text_add(&lines, "    start_links(s, &l);\n    factor_links(&l);\n");
    text_add(&lines, "    pass_links_inward(&l);\n    give_links_outward(&l, a);\n");
    if (tree->joined_watched > 0) {
        text_add(&lines, "    transmit_links(&l);\n");
        if (tree->pair_count > 0) close_frictions(emitter, &lines);
        write_slots(emitter, &lines);
    }
    emit_function(&emitter->links,
                  "/* The accelerations of the bodies that move on each other. */\nstatic void solve_tree",
                  "const struct scene *s, double t, const double *y, double *f, double *a", &lines);
    close_text(emitter, &lines);
}

/* ---- all of it */

static void write_balance(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    struct text lines = {0};
    text_add(&lines, "    for (int i = 0; i < slots; i++) f[i] = 0;\n");
    for (size_t b = 0; b < model->body_count; b++)
        if (emitter->forces_on[b]) text_printf(&lines, "    %s(s, t, y, f);\n", emitter->forces_on[b]);
    text_add(&lines, tree_joins(model->tree) ? "    solve_tree(s, t, y, f, a);\n" : "    (void)a;\n");
    emit_function(
        &emitter->links,
        "/* The sums of forces and moments, and the bodies that move on each other. */\nstatic void balance",
        "const struct scene *s, double t, const double *y, double *f, double *a", &lines);
    close_text(emitter, &lines);
}

static void write_rubbing(struct emitter *emitter, int pair, struct text *lines)
{
    const struct mode *mode = mode_of(emitter, pair);
    const char *name = emitter->pair[pair], *slot = emitter->coordinate[mode->coordinate];
    const char *press = mode->normal_slot < 0 ? ""
                                              : emit_printf(emitter, "*fmax(0, -s->pull[%s]*f[%s])", name,
                                                            emitter->slot[mode->normal_slot]);
    text_printf(lines, "    if (s->slip[%s] != 0) f[%s] -= s->slip[%s]*mu_kinetic(s, t, y, %s)%s;\n", name,
                slot, name, name, press);
}

static void write_body(struct emitter *emitter, size_t b, struct text *lines)
{
    const struct fbd_model *model = emitter->model;
    const struct model_body *body = &model->bodies[b];
    const char *name = emitter->body[b];
    int pair = body->friction;
    if (!body->alone) return;
    if (pair >= 0) write_rubbing(emitter, pair, lines);
    if (body_is_off_center(body)) {
        text_printf(lines, "    accelerate_offset(&c->%s, y[%s], y[%s], &f[%s], &a[%s]);\n", name,
                    emitter->coordinate[body->first + 2], emitter->rate[body->first + 2],
                    emitter->coordinate[body->first], emitter->coordinate[body->first]);
        return;
    }
    for (int k = 0; k < body->count; k++) {
        const char *inertia = coordinate_is_angle(body, k) ? body->joint->coordinates[k].inertia : "mass";
        const char *slot = emitter->coordinate[body->first + k];
        text_printf(lines, "    a[%s] = 1/c->%s.%s*f[%s];\n", slot, name, inertia, slot);
    }
    if (pair >= 0)
        text_printf(lines, "    if (s->slip[%s] == 0) a[%s] = surface_acceleration(s, t, y, %s);\n",
                    emitter->pair[pair], emitter->coordinate[body->first], emitter->pair[pair]);
}

static void write_accelerations(struct emitter *emitter)
{
    struct text lines = {0};
    text_add(&lines, "    balance(s, t, y, f, a);\n");
    for (size_t b = 0; b < emitter->model->body_count; b++) write_body(emitter, b, &lines);
    emit_function(&emitter->links,
                  "/* Accelerations in the present modes; f has room for the sums of forces. */\nstatic void "
                  "accelerations",
                  "const struct scene *s, double t, const double *y, double *f, double *a", &lines);
    close_text(emitter, &lines);
}

/* Write the right-hand side; the rate of a sticking coordinate is that of its surface. */
static void write_rates(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    struct text lines = {0};
    text_add(&lines, "    const struct scene *s = given;\n    double f[slots];\n");
    if (emit_has_places(emitter))
        text_add(&lines, "    double y[size];\n    for (int i = 0; i < 2*coordinates; i++) y[i] = at[i];\n"
                         "    write_places(s, t, y);\n");
    else
        text_add(&lines, "    const double *y = at;\n");
    text_add(&lines, "    for (int i = 0; i < coordinates; i++) rate[i] = y[coordinates + i];\n"
                     "    accelerations(s, t, y, f, rate + coordinates);\n");
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++)
        text_printf(&lines, "    if (s->slip[%s] == 0) rate[%s] = surface_speed(s, t, y, %s);\n",
                    emitter->pair[pair], emitter->coordinate[mode_of(emitter, pair)->coordinate],
                    emitter->pair[pair]);
    text_add(&lines, "    for (int i = 0; i < 2*coordinates; i++)\n"
                     "        if (!isfinite(rate[i])) return GSL_EDOM; /* GSL would take it for a number */\n"
                     "    return GSL_SUCCESS;\n");
    emit_function(&emitter->links, "/* The right-hand side for GSL. */\nstatic int rates",
                  "double t, const double *at, double *rate, void *given", &lines);
    close_text(emitter, &lines);
}

void emit_solution(struct emitter *emitter)
{
    write_laws(emitter);
    if (tree_joins(emitter->model->tree)) write_tree(emitter);
    emit_places(emitter);
    write_balance(emitter);
    write_accelerations(emitter);
    write_rates(emitter);
}
