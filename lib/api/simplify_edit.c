/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Edits of a scene that remove an effect.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/simplify.h"
#include "base/diag.h"
#include "base/text.h"

/* ---- Taylor polynomials */

/* The polynomial is written as text over the names s1, s2, ... of the slots, without dimensions. */
static struct symbol slot_symbol(void *context, const char *name, struct pos at)
{
    (void)context, (void)at;
    return (struct symbol){.kind = symbol_variable, .slot = (int)strtol(name + 1, NULL, 10)};
}

static void term(struct text *text, double factor, int slot, double from)
{
    text_add(text, " + (");
    text_number(text, factor, 17);
    text_printf(text, ")*(s%d - (", slot);
    text_number(text, from, 17);
    text_add(text, "))");
}

static bool write_taylor(struct text *text, const struct expr *expr, const double *at, int degree)
{
    const int *slots;
    size_t count = expr_variables(expr, &slots);
    double value = expr_eval(expr, 0, at, NULL);
    bool finite = isfinite(value);
    text_number(text, value, 17);
    for (size_t a = 0; a < count; a++) {
        double slope;
        expr_eval_slot(expr, 0, at, slots[a], NULL, &slope);
        finite = finite && isfinite(slope);
        term(text, slope, slots[a], at[slots[a] - 1]);
        for (size_t c = a; degree > 1 && c < count; c++) {
            double by_a, by_c, both;
            expr_eval_second(expr, 0, at, slots[a], slots[c], NULL, &by_a, &by_c, &both);
            finite = finite && isfinite(both);
            term(text, a == c ? both / 2 : both, slots[a], at[slots[a] - 1]);
            text_printf(text, "*(s%d - (", slots[c]);
            text_number(text, at[slots[c] - 1], 17);
            text_add(text, "))");
        }
    }
    return finite && !text->failed;
}

/* The Taylor polynomial of degree 1 or 2 of a formula of the scene about t = 0 and the state `at`, compiled
 * into `arena`. NULL when a coefficient is not finite or memory is out. */
static const struct expr *taylor_expr(const struct expr *expr, const double *at, int degree,
                                      struct arena *arena, fbd_errors *errors)
{
    struct text text = {0};
    const struct scope scope = {.lookup = slot_symbol, .units = unit_si};
    const struct expr_want want = {.any_dim = true, .what = "polynomial"};
    const struct expr *result = NULL;
    if (write_taylor(&text, expr, at, degree))
        result = expr_compile(arena, text.data, (struct pos){0, 0}, &scope, &want, errors);
    text_free(&text);
    return result;
}

static void replace(struct value *value, const struct edit *edit, int degree, struct scene *scene,
                    fbd_errors *errors)
{
    if (!value->expr || expr_is_constant(value->expr)) return;
    value->expr = taylor_expr(value->expr, edit->about.at, degree, &scene->arena, errors);
    if (value->expr || fbd_errors_failed_count(errors) > 0) return;
    diag_add(errors, FBD_ERROR, "not-finite", value->at, NULL, "it has no tangent at the equilibrium");
}

/* ---- edits */

static void leave_out_load(struct body *body, int index)
{
    body->load_count--;
    for (size_t i = (size_t)index; i < body->load_count; i++) body->loads[i] = body->loads[i + 1];
}

/* Remove a load and its reaction on another body. */
static void leave_out(struct scene *scene, int b, int index)
{
    const struct load *load = &scene->bodies[b].loads[index];
    bool draws = load->toward && !load->reaction && load->target != ground_body;
    struct body *other = draws ? &scene->bodies[load->target] : NULL;
    size_t length = strlen(scene->bodies[b].name);
    for (size_t i = 0; other && i < other->load_count; i++) {
        const struct load *reaction = &other->loads[i];
        if (!reaction->reaction || strncmp(reaction->name, scene->bodies[b].name, length) != 0 ||
            reaction->name[length] != '.' || strcmp(reaction->name + length + 1, load->name) != 0)
            continue;
        leave_out_load(other, (int)i);
        break;
    }
    leave_out_load(&scene->bodies[b], index);
}

static void uncouple(struct scene *scene, int index)
{
    scene->force_coupling_count--;
    for (size_t i = (size_t)index; i < scene->force_coupling_count; i++)
        scene->force_couplings[i] = scene->force_couplings[i + 1];
}

static void leave_out_part(struct body *body, int index)
{
    body->part_count--;
    for (size_t i = (size_t)index; i < body->part_count; i++) body->parts[i] = body->parts[i + 1];
}

static void gather_mass(struct body *body, const struct model_body *known)
{
    body->part_count = 1;
    body->parts[0] = (struct part){.at = body->at,
                                   .shape = shape_point,
                                   .axis = 'z',
                                   .mass = known->inertia.mass,
                                   .center = known->inertia.G};
}

/* Replace m g L sin(theta - theta_0) by its tangent at theta_0: a torsional spring. */
static void linear_gravity(struct load *load, const struct edit *edit)
{
    *load = (struct load){.kind = moment_spring,
                          .name = load->name,
                          .at = load->at,
                          .stiffness = edit->value,
                          .free_length = edit->value2};
}

void simplify_edit(struct scene *scene, void *context, fbd_errors *errors)
{
    const struct edit *edit = context;
    struct body *body = &scene->bodies[edit->body];
    bool of_load = edit->kind != edit_part && edit->kind != edit_rotary && edit->kind != edit_uncouple &&
                   edit->kind != edit_linear_scene;
    struct load *load = of_load ? &body->loads[edit->index] : NULL;
    for (size_t b = 0; b < scene->body_count; b++) scene->bodies[b].hand_count = 0; /* now invalid */
    switch (edit->kind) {
    case edit_leave_out: leave_out(scene, edit->body, edit->index); break;
    case edit_uncouple: uncouple(scene, edit->index); break;
    case edit_static: load->mu_s = load->mu_k; break;
    case edit_surface: load->surface_speed = (struct value){0}; break;
    case edit_wind: load->wind_x = load->wind_y = load->fx = load->fy = (struct value){0}; break;
    case edit_part: leave_out_part(body, edit->index); break;
    case edit_rotary: gather_mass(body, &edit->model->bodies[edit->body]); break;
    case edit_linear_gravity: linear_gravity(load, edit); break;
    case edit_linear_drag:
        load->linear += load->quadratic * edit->value;
        load->quadratic = 0;
        break;
    case edit_linear_formula:
        replace(&load->value, edit, 1, scene, errors);
        replace(&load->fx, edit, 1, scene, errors);
        replace(&load->fy, edit, 1, scene, errors);
        replace(&load->potential, edit, 2, scene, errors);
        break;
    case edit_linear_scene: break; /* made by simplify_linear_scene */
    }
}
