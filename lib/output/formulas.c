/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/formulas.h"

#include <math.h>
#include <string.h>

#include "output/laws.h"
#include "output/moments.h"

bool equations_cut_free(const struct fbd_model *model, bool components)
{
    enum { most_bodies = 100 };
    return model->body_count <= most_bodies && (components || tree_joins(model->tree));
}

/* True if the equations of its coordinates contain the accelerations of G in the world. */
static bool is_on_ground(const struct model_body *body)
{
    return body->parent == ground_body && body->count > 0 && !body_is_off_center(body);
}

/* True if the sum in that direction is one of its coordinates' equations. */
static bool has_coordinate_along(const struct model_body *body, int part)
{
    if (body->joint->has_axis) return part == 2;
    if (body->joint->path == path_line) return part < 2 && (part == 0 ? body->e.y : body->e.x) == 0;
    return body->count > 1;
}

bool body_is_cut_free(const struct fbd_model *model, int b, bool components)
{
    const struct model_body *body = &model->bodies[b];
    return components || body->count == 0 || (!body->alone && equations_cut_free(model, false));
}

bool equation_is_written(const struct fbd_model *model, int b, bool cut_free, int part, bool components)
{
    const struct model_body *body = &model->bodies[b];
    const bool ground = is_on_ground(body);
    if (!body_is_cut_free(model, b, components)) return !cut_free;
    if (cut_free && part == 2 && body_never_turns(body)) return false;
    return cut_free ? !ground || !has_coordinate_along(body, part) : ground;
}

/* Of such a body the equations are those of statics, 0 = sum of forces. */
static bool is_massless(const struct fbd_model *model, int b)
{
    return model->bodies[b].inertia.mass == 0;
}

bool equation_in_symbols(const struct fbd_model *model, const struct equation *equation, bool components)
{
    const fbd_equation *e = &equation->public;
    bool acts = e->inertia != 0 || e->sum != 0;
    for (size_t i = 0; is_massless(model, equation->body) && i < e->term_count; i++)
        acts |= e->terms[i].value != 0;
    return acts && equation_is_written(model, equation->body, equation->cut_free, equation->part, components);
}

bool newton_in_symbols(const struct fbd_model *model, const fbd_equations *all, int b, int part,
                       bool components)
{
    for (size_t i = 0; all && i < all->count; i++) {
        const struct equation *equation = &all->equations[i];
        if (equation->body == b && equation->cut_free && equation->part == part)
            return equation_in_symbols(model, equation, components);
    }
    return equation_is_written(model, b, true, part, components);
}

bool formulas_begin(struct formulas *formulas, struct fbd_state *state)
{
    *formulas = (struct formulas){.state = state, .slipping = true};
    state_ready(state);
    formulas->symbols = symbols_of_forces(state, &formulas->arena);
    return samples_begin(&formulas->samples, state, &formulas->arena) && formulas->symbols;
}

void formulas_end(struct formulas *formulas)
{
    samples_end(&formulas->samples);
    arena_free(&formulas->arena);
}

const char *symbol_of_body(struct formulas *formulas, const char *name, int body)
{
    if (formulas->state->model->body_count == 1) return name;
    return arena_printf(&formulas->arena, strchr(name, '_') ? "%s%d" : "%s_%d", name, body + 1);
}

/* ---- laws */

/* The parameter that has the value of a slope, or NULL. */
static const char *slope_parameter(const struct scene *scene, struct vec e)
{
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (dim_equal(scene->parameters[i].dim, DIM_NONE) && !scene->parameters[i].input &&
            fabs(scene->parameters[i].value - atan2(e.y, e.x)) < 1e-12)
            return scene->parameters[i].name;
    return NULL;
}

const char *slope_of(struct formulas *formulas, struct vec e)
{
    const char *name = slope_parameter(formulas->state->model->scene, e);
    return name ? name
                : arena_printf(&formulas->arena, "%.9g[deg]", atan2(e.y, e.x) * 180 / 3.141592653589793);
}

/* The law of a term of the equation where it is more specific than its symbol, or "". */
static const char *law_of(struct formulas *formulas, const struct equation *equation, size_t term)
{
    const int load = equation->loads[term];
    const struct fbd_model *model = formulas->state->model;
    switch (load < 0 ? load_gravity : model->loads[load].source->kind) {
    case load_gravity: /* and terms without a load */
    case load_spring:
    case load_damper:
    case load_drag:
    case moment_spring:
    case moment_damper: break;
    default: return "";
    }
    struct law_names names = {symbol_of_mass(model, equation->body, &formulas->arena),
                              slope_of(formulas, model->bodies[equation->body].e),
                              symbol_of_body(formulas, "L", equation->body)};
    struct text law = {0};
    if (names.mass && names.along && names.L) law_write(&law, model, equation, term, &names);
    const char *kept = law.data ? arena_text(&formulas->arena, law.data, law.length) : "";
    formulas->arena.failed |= law.failed;
    text_free(&law);
    return kept;
}

/* ---- terms */

/* The symbol of the body's arrow of this name; NULL for none. */
static const struct force_symbol *symbol_of_arrow(struct formulas *formulas, int body, const char *name)
{
    const struct fbd_state *state = formulas->state;
    const struct instant at = state_instant(state);
    struct arrow *arrows = formulas->samples.arrows;
    const size_t count = diagram_list(state->model, body, &at, state->slots, arrows);
    for (size_t i = 0; i < count; i++)
        if (strcmp(arrows[i].name, name) == 0) return &formulas->symbols[body][i];
    return NULL;
}

static bool is_of_moments(const struct equation *equation)
{
    return equation->public.inertia_name[0] == 'I';
}

/* True if a moment contributes to the equation of forces, along a curve. */
static bool turns_along(const struct formulas *formulas, const struct equation *equation)
{
    const struct model_body *body = &formulas->state->model->bodies[equation->body];
    return !equation->cut_free && body->source->motion.turns;
}

/* The direction of an equation of forces in the world, or (0, 0) where it varies with the motion. */
static struct vec direction_of(const struct formulas *formulas, const struct equation *equation)
{
    const struct model_body *body = &formulas->state->model->bodies[equation->body];
    if (!equation->cut_free && (body->parent != ground_body || body->joint->path == path_curve))
        return (struct vec){0, 0};
    if (!equation->cut_free && body->joint->path == path_line) return body->e;
    return equation->part == 0 ? (struct vec){1, 0} : (struct vec){0, 1};
}

/* The line of the ground along or across which a force acts: of a slide, a rolling body or a contact. */
static struct vec line_of(const struct formulas *formulas, const struct equation *equation, const char *name,
                          struct vec d)
{
    const struct fbd_model *model = formulas->state->model;
    const struct model_body *body = &model->bodies[equation->body];
    struct vec e = d;
    if (body->joint->path == path_line && body->parent == ground_body)
        e = body->e;
    else
        ground_line_of_force(model, equation->body, name, &e);
    const double along = fabs(vec_dot(e, d)), across = fabs(vec_cross(e, d));
    return fmin(along, across) <= 1e-9 * fmax(along, across) ? vec_scale(1 / vec_norm(e), e) : d;
}

/* The component in direction u of a force of that size along d: N cos(phi). */
static const char *share_of_size(struct formulas *formulas, const struct equation *equation, const char *name,
                                 struct vec d, struct vec u, const char *symbol)
{
    const double share = vec_dot(d, u);
    const char *minus = share < 0 ? "-" : "";
    if (fabs(share) <= 1e-9) return "";
    if (fabs(share) >= 1 - 1e-9) return arena_printf(&formulas->arena, "%s%s", minus, symbol);
    struct vec e = line_of(formulas, equation, name, d);
    if (!slope_parameter(formulas->state->model->scene, e)) e = (struct vec){fabs(e.x), fabs(e.y)};
    const char *angle = slope_of(formulas, e);
    const bool cosine = fabs(fabs(share) - fabs(e.x)) <= 1e-9;
    if (share * (cosine ? e.x : e.y) > 0)
        minus = "";
    else
        minus = "-";
    return angle ? arena_printf(&formulas->arena, "%s%s %s(%s)", minus, symbol, cosine ? "cos" : "sin", angle)
                 : NULL;
}

/* The component of a force whose direction varies with the motion, by its components in the world. */
static const char *share_of_vector(struct formulas *formulas, const struct acts *acts, struct vec u,
                                   const char *symbol, const char *minus)
{
    static const struct vec axes[] = {{1, 0}, {0, 1}};
    struct arena *arena = &formulas->arena;
    const char *x = component_by_symbol(arena, symbol, "x"), *y = component_by_symbol(arena, symbol, "y");
    if (!x || !y) return NULL;
    const bool no_x = u.x == 0 || acts_never_along(acts, axes[0]),
               no_y = u.y == 0 || acts_never_along(acts, axes[1]);
    if (no_x && no_y) return "";
    if (fabs(u.x) == 1 || fabs(u.y) == 1) {
        const bool back = (u.x + u.y < 0) != (minus[0] != 0);
        return arena_printf(arena, "%s%s", back ? "-" : "", u.x != 0 ? x : y);
    }
    const char *angle = slope_of(formulas, u);
    if (!angle) return NULL;
    if (no_y) return arena_printf(arena, "%s%s cos(%s)", minus, x, angle);
    if (no_x) return arena_printf(arena, "%s%s sin(%s)", minus, y, angle);
    return arena_printf(arena, "%s(%s cos(%s) + %s sin(%s))", minus, x, angle, y, angle);
}

/* The component of a force in an equation of forces. */
static const char *share_by_symbol(struct formulas *formulas, const struct equation *equation,
                                   const char *name, const struct acts *acts, const struct letter *letter)
{
    const struct vec u = direction_of(formulas, equation);
    struct vec d;
    if (turns_along(formulas, equation))
        return arena_printf(&formulas->arena, "%sQ_s(%s)", letter->minus, letter->vector);
    if (u.x == 0 && u.y == 0) { /* s of a track; x and y of a body on a body */
        const struct model_body *body = &formulas->state->model->bodies[equation->body];
        const char *axis = body->joint->coordinates[equation->part].name;
        const char *part = component_by_symbol(&formulas->arena, letter->vector, axis);
        return part ? arena_printf(&formulas->arena, "%s%s", letter->minus, part) : NULL;
    }
    if (acts_never_along(acts, u)) return "";
    const bool lies = acts_along_line(acts, &d), whole = lies && fabs(vec_dot(d, u)) >= 1 - 1e-9;
    if (!whole && (!lies || (u.x != 0 && u.y != 0)))
        return share_of_vector(formulas, acts, u, letter->vector, letter->minus);
    return share_of_size(formulas, equation, name, vec_scale(letter->sign, d), u, letter->size);
}

/* The letters of a force: slipping friction is mu_k N, in its present sense. */
static struct letter letter_of(const struct formulas *formulas, const struct force_symbol *symbol,
                               const struct acts *acts)
{
    struct letter letter = {symbol->text, symbol->text, symbol->opposite ? "-" : "", 1};
    if (formulas->slipping && symbol->slipping && acts->list[0].size != 0) {
        letter.size = symbol->slipping;
        letter.sign = acts->list[0].size < 0 ? -1 : 1;
    }
    return letter;
}

/* One term; "" if it is zero at all times. */
static const char *term_of(struct formulas *formulas, const struct equation *equation, size_t index)
{
    const fbd_term *term = &equation->public.terms[index];
    const char *law = law_of(formulas, equation, index);
    if (!law || law[0]) return law;
    const struct force_symbol *symbol = symbol_of_arrow(formulas, equation->body, term->name);
    if (!symbol) return arena_printf(&formulas->arena, "(%s)", term->name);
    if (symbol->moment && !is_of_moments(equation) && !turns_along(formulas, equation)) return "";
    const struct acts acts = acts_of(&formulas->samples, equation->body, term->name,
                                     strncmp(equation->public.inertia_name, "I_O", 3) == 0);
    if (acts.count == 0) return "";
    const struct letter letter = letter_of(formulas, symbol, &acts);
    return is_of_moments(equation) ? moment_by_arm(formulas, equation, &acts, symbol->moment, &letter)
                                   : share_by_symbol(formulas, equation, term->name, &acts, &letter);
}

const char *formula_add(struct formulas *formulas, const char *sum, const char *term)
{
    if (!sum || !term) return NULL;
    if (!term[0] || !sum[0]) return term[0] ? term : sum;
    const bool minus = term[0] == '-';
    return arena_printf(&formulas->arena, "%s %s %s", sum, minus ? "-" : "+", term + minus);
}

const char *formula_right(struct formulas *formulas, const struct equation *equation)
{
    const char *right = "";
    for (size_t i = 0; right && i < equation->public.term_count; i++)
        right = formula_add(formulas, right, term_of(formulas, equation, i));
    return right && !right[0] ? "0" : right;
}

const char *formula_term(struct formulas *formulas, const struct equation *equation, const char *name)
{
    for (size_t i = 0; i < equation->public.term_count; i++)
        if (strcmp(equation->public.terms[i].name, name) == 0) return term_of(formulas, equation, i);
    return "";
}

const char *formula_left(struct formulas *formulas, const struct equation *equation)
{
    const fbd_equation *e = &equation->public;
    if (e->inertia == 0 && is_massless(formulas->state->model, equation->body)) return "0";
    const char *inertia = strcmp(e->inertia_name, "m") == 0
                              ? symbol_of_mass(formulas->state->model, equation->body, &formulas->arena)
                              : symbol_of_body(formulas, e->inertia_name, equation->body);
    const bool turns = strcmp(e->acceleration_name, "alpha") == 0;
    const char *acceleration = !turns ? e->acceleration_name
                               : strcmp(angle_name(formulas, equation->body), "angle") == 0 ? "angle_ddot"
                                                                                            : "omega_dot";
    return inertia ? arena_printf(&formulas->arena, "%s %s", inertia, acceleration) : NULL;
}

const char *formula_line(struct formulas *formulas, const struct equation *equation)
{
    const char *left = formula_left(formulas, equation), *right = formula_right(formulas, equation);
    return left && right ? arena_printf(&formulas->arena, "%s = %s", left, right) : NULL;
}
