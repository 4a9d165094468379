/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a scene simulates and what it does not: the plan in words.
 */
#include <stdlib.h>

#include "base/text.h"
#include "model/model.h"
#include "solve/method.h"

static const char *motion_words(enum motion_kind kind)
{
    switch (kind) {
    case motion_slide: return "slides on a line";
    case motion_pivot: return "turns about an axis";
    case motion_particle: return "moves in the plane as a particle";
    case motion_planar: return "moves in the plane";
    case motion_weld: return "is fixed on";
    }
    return "";
}

static void write_coordinates(struct text *text, const struct fbd_model *model)
{
    text_printf(text, "Coordinates (%d)\n", model->plan.n);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        text_printf(text, "  %s %s", body->name, motion_words(body->kind));
        if (body->parent >= 0 && body->kind != motion_weld)
            text_printf(text, " of `%s`", model->bodies[body->parent].name);
        if (body->kind == motion_weld) text_printf(text, " `%s`", model->bodies[body->parent].name);
        text_add(text, body->count > 0 ? ":" : "");
        for (int k = 0; k < body->count; k++)
            text_printf(text, " %s [%s]", model->scene->coordinates[body->first + k].name,
                        model->labels[body->first + k].unit);
        text_add(text, "\n");
    }
}

static void write_loads(struct text *text, const struct fbd_model *model)
{
    text_add(text, "\nForces and moments simulated\n");
    if (model->load_count == 0) text_add(text, "  none: every body keeps its velocity\n");
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        text_printf(text, "  %s.%s", model->bodies[load->body].name, load->source->name);
        text_pad(text, 28);
        text_printf(text, "%s\n", load->why);
    }
}

/* ---- what is not simulated, and what would have to be listed */

struct absent {
    enum load_kind kind;
    bool on[motion_kinds_count]; /* by enum motion_kind: where it could act */
    const char *words;
};

static void write_absent(struct text *text, const struct fbd_model *model)
{
    static const struct absent kinds[] = {
        {load_gravity, {true, true, true, true}, "weight: list `gravity`"},
        {load_normal, {true, false, false, false}, "the normal force and loss of contact: list `normal`"},
        {load_friction,
         {true, false, false, false},
         "dry friction: list `friction: {static: ..., kinetic: ...}`"},
        {moment_friction, {false, true, false, false}, "friction in the bearing: list it under `moments`"},
        {load_drag, {true, true, true, true}, "drag: list `drag: {linear: ..., quadratic: ...}`"},
    };
    text_add(text, "\nNot simulated, because not listed\n");
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
            bool listed = !kinds[k].on[body->kind];
            for (int i = 0; i < body->load_count; i++)
                listed |= model->loads[body->first_load + i].source->kind == kinds[k].kind;
            if (!listed) text_printf(text, "  %s: %s\n", body->name, kinds[k].words);
        }
    }
}

static void write_list(struct text *text, size_t count, const char *words)
{
    if (count > 0) text_printf(text, "  %3zu  %s\n", count, words);
}

/* A normal force that is constant is looked at once, at the start. */
static size_t watched_contacts(const struct plan *plan)
{
    size_t count = 0;
    for (size_t i = 0; i < plan->contact_count; i++) count += !plan->slot_constant[plan->contacts[i].slot];
    return count;
}

static void write_tree(struct text *text, const struct tree *tree)
{
    write_list(text, (size_t)tree->count - 1,
               "link of jointed bodies, by the articulated-body recursion (constant forces in it)");
    write_list(text, tree->following_count, "constant force or moment that turns with its link");
    write_list(text, tree->force_count, "force of a formula at a point of a link");
    write_list(text, tree->moment_count, "moment of a formula on a link");
    write_list(text, tree->spring_count, "spring or damper between two points of links or the ground");
    write_list(text, tree->drag_count, "drag at a point of a link");
    write_list(text, (size_t)tree->pair_count, "friction that goes with the normal force between two links");
}

static void write_plan(struct text *text, const struct fbd_model *model)
{
    const struct plan *plan = &model->plan;
    text_add(text, "\nTerms of the right-hand side\n");
    write_list(text, plan->affine_count,
               "affine: c0 - k q - c v (constants, springs along the motion and viscous dampers in one)");
    write_list(text, plan->sine_count, "sine: s sin q + c cos q (constant forces on a turning body)");
    write_list(text, plan->square_count, "quadratic drag: k |v| v");
    write_list(text, plan->formula_count, "formula in a fixed direction");
    write_list(text, plan->potential_count, "slope of a potential");
    write_list(text, plan->link_count, "spring or damper between two points");
    write_list(text, plan->drag_count, "drag in the plane");
    write_list(text, plan->force_count, "formula whose direction changes");
    write_list(text, plan->friction_count, "dry friction, as modes stick and slip");
    if (model->tree) write_tree(text, model->tree);
    write_list(text, plan->offset_count, "body whose frame is not at its centre of mass");
    text_add(text, "\nEvents watched\n");
    size_t switches = 0;
    for (size_t i = 0; i < plan->kink_count; i++) switches += plan->kinks[i].count;
    if (plan->friction_count + watched_contacts(plan) + switches + plan->watch_count == 0)
        text_add(text, "  none\n");
    write_list(text, plan->friction_count, "friction: stopping, sticking, breaking away");
    write_list(text, watched_contacts(plan), "normal force that must not become a pull");
    write_list(text, switches, "switch in an expression (abs, step, if, ...)");
    write_list(text, plan->watch_count, "event of the file");
}

char *fbd_explain(const fbd_model *model, const fbd_options *options)
{
    struct text text = {0};
    write_coordinates(&text, model);
    write_loads(&text, model);
    write_absent(&text, model);
    write_plan(&text, model);
    const char *name = options->method ? options->method : model->scene->simulate.method;
    const struct method *method = name ? method_find(name) : NULL;
    if (method)
        text_printf(&text, "\nMethod: %s (%s), as asked for\n", method->name, method->description);
    else
        text_printf(
            &text,
            "\nMethod: auto, the default: %s (%s);\n  where the motion turns out stiff, %s (%s), and back\n",
            method_at(0)->name, method_at(0)->description, method_find("rodas5p")->name,
            method_find("rodas5p")->description);
    if (text.failed) text_free(&text);
    return text.data;
}
