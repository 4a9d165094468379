/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Explain how a scene is simulated: the terms of its right-hand side, the variables they depend on, the
 * watched events, and the exploited structure.
 */
#include "output/explain.h"

#include "model/tree.h"

static void write_list(struct text *text, size_t count, const char *words)
{
    if (count > 0) text_printf(text, "  %3zu  %s\n", count, words);
}

/* ---- the right-hand side */

static void write_tree(struct text *text, const struct tree *tree)
{
    write_list(text, (size_t)tree->count - 1,
               "link of jointed bodies, by the articulated-body recursion (constant forces in it)");
    write_list(text, tree->following_count, "constant force or moment that turns with its link");
    write_list(text, tree->force_count, "force of a formula at a point of a link");
    write_list(text, tree->moment_count, "moment of a formula on a link");
    write_list(text, tree->spring_count, "spring or damper between two points of links or the ground");
    write_list(text, tree->drag_count, "drag at a point of a link");
    write_list(text, (size_t)tree->pair_count,
               "friction in proportion to the normal force between two links");
    write_list(text, (size_t)tree->row_count,
               "row of couplings: a multiplier each, projected after every step");
}

static void write_terms(struct text *text, const struct plan *plan, const struct tree *tree)
{
    text_add(text, "\nRight-hand side\n");
    size_t across = 0;
    for (size_t i = 0; i < plan->affine_count; i++) across += plan->affine[i].slot >= plan->n;
    write_list(text, plan->affine_count - across,
               "affine: c0 - k q - c v (constants, springs along the motion and viscous dampers in one)");
    write_list(text, across, "constant across a line: for the normal force");
    write_list(text, plan->sine_count, "sine: s sin q + c cos q (constant forces on a turning body)");
    write_list(text, plan->square_count, "quadratic drag: k |v| v");
    write_list(text, plan->formula_count, "formula in a fixed direction");
    write_list(text, plan->potential_count, "slope of a potential");
    write_list(text, plan->link_count, "spring or damper between two points");
    write_list(text, plan->drag_count, "drag in the plane");
    write_list(text, plan->force_count, "formula whose direction changes");
    write_list(text, (size_t)plan->own, "state with an equation of its own");
    write_list(text, plan->mode_count, "dry friction, as modes stick and slip");
    if (tree) write_tree(text, tree);
    write_list(text, plan->offset_count, "body whose frame is not at its centre of mass");
    if (!tree && plan->affine_count + plan->sine_count + plan->square_count + plan->formula_count +
                         plan->potential_count + plan->link_count + plan->drag_count + plan->force_count +
                         plan->mode_count + plan->offset_count + (size_t)plan->own ==
                     0)
        text_add(text, "  none\n");
}

static size_t bodies_that_depend(const struct fbd_model *model, unsigned on)
{
    size_t count = 0;
    for (size_t b = 0; b < model->body_count; b++) count += (model->plan.bodies[b].depends & on) != 0;
    return count;
}

static void write_rows(struct text *text, const struct fbd_model *model, struct rates_census rows)
{
    text_add(text, "  as it starts, its rows are\n");
    const struct {
        int count;
        const char *words;
    } kinds[] = {
        {rows.steady, "constant acceleration"},
        {rows.held, "held by friction: nothing to compute"},
        {rows.affine, "affine, with quadratic drag: one line"},
        {rows.sine, "sine of the angle: one line"},
        {rows.parts, "one power or harmonic of a formula: one line, no program"},
        {rows.formulas, "with formulas"},
        {rows.particles, "particle with springs, dampers or drag at its points"},
        {rows.own, "rates of the states of the file"},
        {rows.bare, "chains of pivots with constant forces, without their places in the world"},
        {rows.bodies, model->tree ? "jointed bodies, all together" : "body by the general path"},
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

static void write_structure(struct text *text, const struct plan *plan, const struct tree *tree)
{
    text_add(text, "\nStructure\n");
    if (tree)
        text_add(text, "  jointed bodies form a tree: accelerations by a recursion over it\n");
    else if (plan->offset_count == 0)
        text_add(text, "  diagonal mass matrix: each acceleration is a sum of forces over an inertia\n");
    else
        text_printf(text, "  the mass matrix has %zu block%s of three, else it is diagonal\n",
                    plan->offset_count, plan->offset_count == 1 ? "" : "s");
}

void explain_plan(struct text *text, const struct fbd_model *model, const struct rates *rates)
{
    write_terms(text, &model->plan, model->tree);
    write_dependence(text, model);
    write_rows(text, model, rates_census(rates));
    write_events(text, &model->plan);
    write_structure(text, &model->plan, model->tree);
}
