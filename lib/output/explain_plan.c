/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Explain how a scene is simulated: the terms of its right-hand side, the variables they depend on, the
 * watched events, and the exploited structure.
 */
#include "output/explain.h"

#include "model/model.h"

static void write_list(struct text *text, size_t count, const char *words)
{
    if (count > 0) text_printf(text, "  %3zu  %s\n", count, words);
}

/* ---- the right-hand side */

static size_t known_equations(const struct fbd_model *model)
{
    size_t count = 0;
    for (int i = 0; i < model->plan.n; i++) count += model->plan.equations[i].known;
    return count;
}

static void write_terms(struct text *text, const struct fbd_model *model)
{
    const struct plan *plan = &model->plan;
    const struct tree *tree = model->tree;
    text_add(text, "\nRight-hand side\n");
    write_list(text, known_equations(model),
               "coordinate with an equation of its own: a sum of terms along it");
    write_list(text, (size_t)(tree->count - tree->joined),
               "body that no joint or coupling connects with others");
    write_list(text, (size_t)tree->joined - 1,
               "link of jointed bodies, by the articulated-body recursion (constant forces in it)");
    write_list(text, plan->affine_count, "spring, damper or constant force in a joint");
    write_list(text, plan->potential_count, "slope of a potential");
    write_list(text, tree->following_count, "constant force or moment that turns with its body");
    write_list(text, tree->force_count, "force of a formula at a point of a body");
    write_list(text, tree->moment_count, "moment of a formula on a body");
    write_list(text, tree->spring_count,
               "spring, damper or actuator between two points of bodies or the ground");
    write_list(text, tree->drag_count, "drag at a point of a body");
    write_list(text, (size_t)plan->own, "state with an equation of its own");
    write_list(text, plan->mode_count, "dry friction, as modes stick and slip");
    write_list(text, (size_t)tree->pair_count,
               "friction in proportion to the normal force between two links");
    write_list(text, (size_t)tree->row_count,
               "row of couplings: a multiplier each, projected after every step");
}

/* ---- the variables on which forces depend */

/* Is a slot the slip velocity of the body on its surface? */
static bool is_own_slip(const struct fbd_model *model, const struct model_body *body, int slot)
{
    int first = 1 + (int)plan_size(&model->plan) + hand_slots;
    const struct absolute *absolute = slot < first ? NULL : &model->scene->absolutes[slot - first];
    return absolute && absolute->kind == absolute_slip && absolute->roll == 0 &&
           &model->bodies[absolute->body] == body;
}

/* Variables of kinetic friction; if its law depends on the slip, also those of the surface speed. */
static unsigned friction_depends(const struct fbd_model *model, const struct model_body *body,
                                 const struct mode *mode)
{
    if (mode->moment && mode->normal_slot >= 0) return depends_place | depends_rate; /* its reaction */
    if (formula_is_constant(&mode->mu_k)) return 0;
    const int *slots;
    size_t count = expr_variables(mode->mu_k.expr, &slots);
    unsigned on = expr_uses_time(mode->mu_k.expr) ? depends_time : 0;
    for (size_t i = 0; i < count; i++)
        on |= is_own_slip(model, body, slots[i]) ? depends_rate | formula_depends(body, &mode->surface_speed)
                                                 : formula_slot_depends(body, slots[i]);
    return on;
}

static unsigned load_depends(const struct fbd_model *model, const struct model_body *body,
                             const struct model_load *load)
{
    const bool turns = body->joint->angle >= 0;
    const struct formula *formulas[] = {&load->value, &load->angle, &load->fx, &load->fy, &load->potential};
    unsigned on = 0;
    for (size_t i = 0; i < sizeof formulas / sizeof *formulas; i++) on |= formula_depends(body, formulas[i]);
    switch (load->source->kind) {
    case load_gravity: return body->joint->has_axis && body->L > 0 ? depends_place : 0;
    case load_applied: return turns && !load->source->body_frame ? on | depends_place : on;
    case load_spring:
    case moment_spring: return load->source->coefficient != 0 ? depends_place | depends_rate : depends_place;
    case load_actuator: return on | depends_place;
    case load_damper: return load->linked ? depends_place | depends_rate : depends_rate;
    case moment_damper: return depends_rate;
    case load_drag: return turns ? on | depends_place | depends_rate : on | depends_rate;
    case load_friction:
    case moment_friction: return friction_depends(model, body, &model->plan.modes[body->friction]);
    default: return on;
    }
}

static size_t bodies_that_depend(const struct fbd_model *model, unsigned on)
{
    size_t count = 0;
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        unsigned all = 0;
        for (int i = body->first_load; i < body->first_load + body->load_count; i++)
            all |= load_depends(model, body, &model->loads[i]);
        count += (all & on) != 0;
    }
    return count;
}

static void write_rows(struct text *text, struct rates_census rows)
{
    text_add(text, "  as it starts, its rows are\n");
    const struct {
        int count;
        const char *words;
    } kinds[] = {
        {rows.scalar, "a scalar equation: one line"},
        {rows.held, "held by friction: nothing to compute"},
        {rows.own, "rates of the states of the file"},
        {rows.bare, "chains of pivots with constant forces, without their places in the world"},
        {rows.loops, "loops closed by pins, in independent coordinates"},
        {rows.whole, "all bodies together, by the recursion"},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].count > 0) text_printf(text, "    %3d  %s\n", kinds[i].count, kinds[i].words);
}

static void write_dependence(struct text *text, const struct fbd_model *model)
{
    const struct {
        unsigned on;
        const char *words;
    } kinds[] = {{depends_time, "time"},
                 {depends_place, "the place"},
                 {depends_rate, "the velocity"},
                 {depends_other, model->plan.own > 0 ? "other bodies, states, or places in the world"
                                                     : "other bodies, or places in the world"}};
    bool any = false;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        size_t count = bodies_that_depend(model, kinds[i].on);
        if (count > 0)
            text_printf(text, "  forces change with %s on %zu of %zu bodies\n", kinds[i].words, count,
                        model->body_count);
        any |= count > 0;
    }
    if (!any) text_add(text, "  all forces are constant (but for the sign of friction)\n");
}

/* ---- events: a function is watched only where an effect could make it zero */

/* A constant normal force is checked once, at the start. */
static size_t watched_contacts(const struct plan *plan)
{
    size_t count = 0;
    for (size_t i = 0; i < plan->contact_count; i++)
        count += plan->contacts[i].pair >= 0 || !plan->slot_constant[plan->contacts[i].slot];
    return count;
}

static void write_events(struct text *text, const struct plan *plan)
{
    size_t switches = 0, contacts = watched_contacts(plan);
    for (size_t i = 0; i < plan->kink_count; i++) switches += plan->kinks[i].count;
    text_add(text, "\nEvent functions\n");
    if (plan->mode_count + contacts + switches + plan->watch_count == 0)
        text_add(text, "  none: nothing interrupts the steps\n");
    write_list(text, plan->mode_count, "friction: stopping, sticking, breaking away");
    write_list(text, contacts, "normal force that must not become a pull");
    write_list(text, switches, "switch in an expression (abs, step, if, ...)");
    write_list(text, plan->watch_count, "event of the file");
    if (plan->contact_count > contacts)
        text_printf(text, "  not watched: %zu normal force%s constant, and checked once\n",
                    plan->contact_count - contacts, plan->contact_count - contacts == 1 ? " is" : "s are");
}

/* ---- structure */

static void write_structure(struct text *text, const struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    const size_t alone = (size_t)(tree->count - tree->joined);
    text_add(text, "\nStructure\n");
    if (tree_joins(tree))
        text_add(text, "  jointed bodies form a tree: accelerations by a recursion over it\n");
    if (alone > 0)
        text_printf(text, "  %zu bod%s on the ground alone: no acceleration depends on another one\n", alone,
                    alone == 1 ? "y is" : "ies are");
}

void explain_plan(struct text *text, const struct fbd_model *model, const struct rates *rates)
{
    write_terms(text, model);
    write_dependence(text, model);
    write_rows(text, rates_census(rates));
    write_events(text, &model->plan);
    write_structure(text, model);
}
