/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/formulas.h"

#include <math.h>
#include <string.h>

#include "output/laws.h"
#include "output/moments.h"

bool equations_cut_free(const struct fbd_model *model, bool components)
{
    enum { most_bodies = 100 };
    return model->body_count <= most_bodies && (components || model->tree);
}

/* Is the equation of its coordinate one of those of the body cut free, or the sum along a line between x and y? */
static bool has_own_direction(const struct model_body *body)
{
    const bool slopes = body->kind == motion_slide && body->e.x != 0 && body->e.y != 0;
    return body->parent == ground_body &&
           (body->kind == motion_pivot || body->kind == motion_track || slopes);
}

bool equation_is_written(const struct fbd_model *model, int b, bool cut_free, int part, bool components)
{
    const struct model_body *body = &model->bodies[b];
    const bool whole = components || body->count == 0 ||
                       (body->place.link > 0 && equations_cut_free(model, false));
    if (!whole) return !cut_free;
    if (!cut_free) return has_own_direction(body);
    return part < 2 || body->kind != motion_pivot || body->parent != ground_body;
}

bool equation_in_symbols(const struct fbd_model *model, const struct equation *equation, bool components)
{
    const fbd_equation *e = &equation->public;
    return (e->inertia != 0 || e->sum != 0) &&
           equation_is_written(model, equation->body, equation->cut_free, equation->part, components);
}

bool formulas_begin(struct formulas *formulas, struct fbd_state *state)
{
    *formulas = (struct formulas){.state = state};
    state_ready(state);
    formulas->symbols = symbols_of_forces(state, &formulas->arena);
    return formulas->symbols != NULL;
}

void formulas_end(struct formulas *formulas)
{
    arena_free(&formulas->arena);
}

/* ---- laws */

/* The slope of a slide: the parameter that has its value, else in degrees. */
static const char *slope_of(struct formulas *formulas, struct vec e)
{
    const struct scene *scene = formulas->state->model->scene;
    double slope = atan2(e.y, e.x);
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (dim_equal(scene->parameters[i].dim, DIM_NONE) && !scene->parameters[i].input &&
            fabs(scene->parameters[i].value - slope) < 1e-12)
            return scene->parameters[i].name;
    return arena_printf(&formulas->arena, "%.9g deg", slope * 180 / 3.141592653589793);
}

/* The law of a term of the equation where it says more than its symbol, or "". */
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
                              slope_of(formulas, model->bodies[equation->body].e)};
    struct text law = {0};
    if (names.mass && names.along) law_write(&law, model, equation, term, &names);
    const char *kept = law.data ? arena_text(&formulas->arena, law.data, law.length) : "";
    formulas->arena.failed |= law.failed;
    text_free(&law);
    return kept;
}

/* ---- terms */

/* The arrow of the body's diagram that a term is of, or -1. */
static int arrow_of(const struct arrow *arrows, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(arrows[i].name, name) == 0) return (int)i;
    return -1;
}

static bool is_of_moments(const struct equation *equation)
{
    return equation->public.inertia_name[0] == 'I';
}

/* Does the force act along the line of the slide at all times? Those that are functions of its coordinate, friction
 * among them. */
static bool stays_on_slide(const struct fbd_model *model, const struct equation *equation,
                           const struct arrow *arrow)
{
    if (model->bodies[equation->body].kind != motion_slide || arrow->load < 0) return false;
    const struct model_load *load = &model->loads[arrow->load];
    if (load->body != equation->body || load->linked) return false;
    switch (load->source->kind) {
    case load_friction:
    case load_drive:
    case load_spring:
    case load_damper:
    case load_potential: return true;
    case load_applied: return !load->source->angle.expr && !load->source->fx.expr && !load->source->fy.expr;
    default: return false;
    }
}

static bool stays_along(const struct formulas *formulas, const struct equation *equation,
                        const struct arrow *arrow)
{
    return !equation->cut_free && stays_on_slide(formulas->state->model, equation, arrow);
}

/* Does a moment have a share in the equation of forces, along a curve? */
static bool turns_along(const struct formulas *formulas, const struct equation *equation)
{
    const struct model_body *body = &formulas->state->model->bodies[equation->body];
    return !equation->cut_free && body->kind == motion_track && body->source->motion.turns;
}

/* The component or moment of a force that an equation has: R_1x, M_G(R_1); of a body that turns along a curve its generalized
 * force. */
static const char *part_by_symbol(struct formulas *formulas, const struct equation *equation,
                                  const char *symbol)
{
    const enum motion_kind kind = formulas->state->model->bodies[equation->body].kind;
    const bool track = !equation->cut_free && kind == motion_track;
    const char *axis = track                 ? "s"
                       : equation->part == 1 ? "y"
                                             : "x",
               *inertia = equation->public.inertia_name;
    if (is_of_moments(equation))
        return arena_printf(&formulas->arena, "M_%c(%s)", inertia[strlen(inertia) - 1], symbol);
    if (turns_along(formulas, equation)) return arena_printf(&formulas->arena, "Q_s(%s)", symbol);
    return component_by_symbol(&formulas->arena, symbol, axis);
}

/* A line of the ground along which or across which a force acts. */
struct slope {
    struct vec e, d; /* its direction; that of the force where the symbol is positive in general */
    bool along;
};

/* That of a slide: in general its symbols are components along +x, or away from the surface. */
static bool slope_of_slide(const struct fbd_model *model, const struct equation *equation,
                           const struct arrow *arrow, struct slope *slope)
{
    const struct model_body *body = &model->bodies[equation->body];
    if (body->kind != motion_slide || body->parent != ground_body) return false;
    slope->e = body->e;
    slope->along = stays_on_slide(model, equation, arrow);
    slope->d = slope->along ? body->e : body->n;
    return slope->along || arrow_is_of_joint(model, equation->body, arrow);
}

/* That of the line on which a body rolls, or which it touches. */
static bool slope_of_tie(const struct fbd_model *model, const struct equation *equation,
                         const struct arrow *arrow, struct slope *slope)
{
    struct vec e;
    if (!ground_line_of_force(model, equation->body, arrow->name, &e)) return false;
    const double size = vec_norm(arrow->force), along = fabs(vec_dot(e, arrow->force)),
                 across = fabs(vec_cross(e, arrow->force));
    *slope =
        (struct slope){.e = {fabs(e.x), fabs(e.y)}, .along = along > across}; /* signs are those of values */
    return fmin(along, across) <= 1e-9 * size;
}

/* Of a force along a slope, or across it, the component along x or y of the world: N cos(phi). At one state N is the length of
 * its arrow. */
static const char *part_on_slope(struct formulas *formulas, const struct equation *equation,
                                 const struct arrow *arrow, const char *symbol, double value, double sign)
{
    const struct fbd_model *model = formulas->state->model;
    const struct model_body *body = &model->bodies[equation->body];
    const bool world = equation->cut_free || (body->parent == ground_body &&
                                              (body->kind == motion_particle || body->kind == motion_planar));
    struct slope slope;
    if (!world || (!slope_of_slide(model, equation, arrow, &slope) &&
                   (formulas->general || !slope_of_tie(model, equation, arrow, &slope))))
        return "";
    if (slope.e.x == 0 || slope.e.y == 0) return "";
    const bool cosine = slope.along == (equation->part == 0);
    const double factor = equation->part == 0 ? slope.d.x : slope.d.y, trig = cosine ? slope.e.x : slope.e.y;
    const double all = (formulas->general ? sign * factor : value) / trig;
    const char *angle = slope_of(formulas, slope.e);
    return angle ? arena_printf(&formulas->arena, "%s%s %s(%s)", all < 0 ? "-" : "", symbol,
                                cosine ? "cos" : "sin", angle)
                 : NULL;
}

/* The moment or the component of a force in the form that says most; "" where there is none. */
static const char *part_in_full(struct formulas *formulas, const struct equation *equation,
                                const struct arrow *arrow, const char *symbol, double value, double sign)
{
    return is_of_moments(equation) ? moment_by_arm(formulas, equation, arrow, symbol, sign)
                                   : part_on_slope(formulas, equation, arrow, symbol, value, sign);
}

/* A force by its symbol. At one state a symbol that stands by itself is the size of its arrow, and has the sign of the
 * term; in general it is the component along the line of the slide, or a moment counter-clockwise. */
static const char *term_by_symbol(struct formulas *formulas, const struct equation *equation,
                                  const struct arrow *arrow, const struct force_symbol *symbol, double value)
{
    const bool general = formulas->general, moments = is_of_moments(equation);
    const char *text = general ? symbol->text : symbol_now(symbol), *minus = symbol->opposite ? "-" : "";
    const double size = vec_norm(arrow->force), whole = moments ? fabs(arrow->couple) : size;
    const bool bare = moments   ? symbol->moment
                      : general ? stays_along(formulas, equation, arrow)
                                : fabs(fabs(value) - whole) <= 1e-9 * whole;
    const char *full = "";
    if (!bare && text) full = part_in_full(formulas, equation, arrow, text, value, symbol->opposite ? -1 : 1);
    if (!full || full[0]) return full;
    if (!bare)
        text = text ? part_by_symbol(formulas, equation, text) : NULL;
    else if (!general)
        minus = value < 0 ? "-" : "";
    return text ? arena_printf(&formulas->arena, "%s%s", minus, text) : NULL;
}

static const char *term_of(struct formulas *formulas, const struct equation *equation, size_t index,
                           const struct arrow *arrows, size_t count)
{
    const fbd_term *term = &equation->public.terms[index];
    const char *law = law_of(formulas, equation, index);
    if (!law || law[0]) return law;
    int k = arrow_of(arrows, count, term->name);
    if (k < 0) return arena_printf(&formulas->arena, "(%s)", term->name);
    const struct force_symbol *symbol = &formulas->symbols[equation->body][k];
    if (symbol->moment && !is_of_moments(equation) && !turns_along(formulas, equation)) return "";
    return term_by_symbol(formulas, equation, &arrows[k], symbol, term->value);
}

const char *formula_right(struct formulas *formulas, const struct equation *equation)
{
    const struct fbd_state *state = formulas->state;
    struct instant at = state_instant(state);
    struct arrow *arrows = ARENA_ARRAY(&formulas->arena, diagram_most_arrows(state->model), struct arrow);
    if (!arrows) return NULL;
    size_t count = diagram_fill(state->model, equation->body, &at, state->a, state->slots, arrows);
    const char *right = "";
    for (size_t i = 0; right && i < equation->public.term_count; i++) {
        if (equation->public.terms[i].value == 0) continue;
        const char *term = term_of(formulas, equation, i, arrows, count);
        bool minus = term && term[0] == '-';
        right = !term ? NULL
                : !right[0]
                    ? term
                    : arena_printf(&formulas->arena, "%s %s %s", right, minus ? "-" : "+", term + minus);
    }
    return right && !right[0] ? "0" : right;
}

const char *formula_term(struct formulas *formulas, const struct equation *equation, const char *name)
{
    const struct fbd_state *state = formulas->state;
    struct instant at = state_instant(state);
    struct arrow *arrows = ARENA_ARRAY(&formulas->arena, diagram_most_arrows(state->model), struct arrow);
    if (!arrows) return NULL;
    size_t count = diagram_fill(state->model, equation->body, &at, state->a, state->slots, arrows);
    for (size_t i = 0; i < equation->public.term_count; i++)
        if (strcmp(equation->public.terms[i].name, name) == 0)
            return term_of(formulas, equation, i, arrows, count);
    return "";
}

const char *formula_left(struct formulas *formulas, const struct equation *equation)
{
    const fbd_equation *e = &equation->public;
    const char *inertia = strcmp(e->inertia_name, "m") == 0
                              ? symbol_of_mass(formulas->state->model, equation->body, &formulas->arena)
                              : e->inertia_name;
    return inertia ? arena_printf(&formulas->arena, "%s %s", inertia, e->acceleration_name) : NULL;
}
