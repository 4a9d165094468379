/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/formulas.h"

#include <math.h>
#include <string.h>

#include "output/terms.h"

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
static const char *slope_of(struct formulas *formulas, const struct model_body *body)
{
    const struct scene *scene = formulas->state->model->scene;
    double slope = atan2(body->e.y, body->e.x);
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (fabs(scene->parameters[i].value - slope) < 1e-12) return scene->parameters[i].name;
    return arena_printf(&formulas->arena, "%.4g deg", slope * 180 / 3.141592653589793);
}

/* `text` with each word `word` replaced. */
static const char *replaced(struct arena *arena, const char *text, const char *word, const char *by)
{
    const char *at = text ? strstr(text, word) : NULL;
    if (!at) return text;
    if (!by) return NULL;
    return arena_printf(arena, "%.*s%s%s", (int)(at - text), text, by, at + strlen(word));
}

/* Is the remark beside a term a formula, and not words about it? */
static bool is_formula(const char *remark)
{
    static const char *const words[] = {"across", "along the", "toward", "drag",
                                        "r_OG",   "holds",     "slips",  "through"};
    if (!remark[0]) return false;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strstr(remark, words[i])) return false;
    return true;
}

/* The law of a term of the equation, with its sign, or NULL. */
static const char *law_of(struct formulas *formulas, const struct equation *equation, size_t term)
{
    const int load = equation->loads[term];
    if (load < 0) return NULL;
    const struct fbd_model *model = formulas->state->model;
    const struct model_body *body = &model->bodies[equation->body];
    const struct load *source = model->loads[load].source;
    char remark[term_remark_size];
    bool plain = source->kind == load_gravity || source->kind == load_spring || source->kind == load_damper ||
                 source->kind == load_drag || source->kind == moment_spring || source->kind == moment_damper;
    if (!plain || body->parent != ground_body || model->loads[load].linked) return NULL;
    equation_remark(formulas->state, equation, term, remark);
    if (!is_formula(remark)) return NULL;
    const char *law = arena_text(&formulas->arena, remark, strlen(remark));
    if (!law || source->kind != load_gravity) return law;
    const char *slope = slope_of(formulas, body),
               *mass = symbol_of_mass(model, equation->body, &formulas->arena);
    law = slope ? replaced(&formulas->arena, law, "along", slope) : NULL;
    return law && mass ? replaced(&formulas->arena, law, "m g", arena_printf(&formulas->arena, "%s g", mass))
                       : law;
}

/* ---- terms */

/* The arrow of the body's diagram that a term is of, or -1. */
static int arrow_of(const struct arrow *arrows, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(arrows[i].name, name) == 0) return (int)i;
    return -1;
}

/* Does the force stand in the diagram of an earlier body already, opposite? What a joint passes on belongs to the body
 * that moves in it ("rod.pin" is the opposite of the rod's `pin`). A rope may turn a corner: its ends are not opposite. */
static bool is_opposite(const struct formulas *formulas, int body, const struct arrow *arrow,
                        const char *symbol, struct arrow *room)
{
    if (symbol[0] == 'T') return false;
    if (symbol[0] == 'R' || symbol[0] == 'N') {
        const char *own = formulas->state->model->bodies[body].reaction;
        if (strchr(arrow->name, '.')) return true;
        if ((own && strcmp(arrow->name, own) == 0) || arrow->load >= 0) return false;
    }
    const struct fbd_state *state = formulas->state;
    struct instant at = state_instant(state);
    for (int b = 0; b < body; b++) {
        size_t count = diagram_fill(state->model, b, &at, state->a, state->slots, room);
        for (size_t i = 0; i < count; i++)
            if (strcmp(formulas->symbols[b][i], symbol) == 0) return true;
    }
    return false;
}

static bool is_of_moments(const struct equation *equation)
{
    return equation->public.inertia_name[0] == 'I';
}

/* The equation of a slide's own coordinate: a force along it is whole there at all times. */
static bool is_along_a_line(const struct formulas *formulas, const struct equation *equation)
{
    return !equation->cut_free && formulas->state->model->bodies[equation->body].kind == motion_slide;
}

/* A force by its symbol: whole where the equation has the whole of it, else its component or its moment. */
static const char *term_by_symbol(struct formulas *formulas, const struct equation *equation,
                                  const struct arrow *arrow, const char *symbol, double value)
{
    double size = vec_norm(arrow->force);
    const char *sign = value < 0 ? "-" : "";
    if (is_of_moments(equation)) {
        const char *point =
            equation->public.inertia_name[strlen(equation->public.inertia_name) - 1] == 'O' ? "O" : "G";
        if (size == 0) return arena_printf(&formulas->arena, "%s%s", sign, symbol);
        return arena_printf(&formulas->arena, "M_%s(%s)", point, symbol);
    }
    /* a reaction of a pin has components by itself; what is whole now need not be so at another time */
    const struct model_load *load = arrow->load >= 0 ? &formulas->state->model->loads[arrow->load] : NULL;
    bool weight = load && load->source->kind == load_gravity;
    if (formulas->general && load && load->source->kind == load_applied)
        sign = ""; /* its value has the sign */
    if (fabs(fabs(value) - size) <= 1e-9 * size && symbol[0] != 'R' &&
        (!formulas->general || weight || is_along_a_line(formulas, equation)))
        return arena_printf(&formulas->arena, "%s%s", sign, symbol);
    const char *axis = equation->part == 1 ? "y" : "x";
    if (strchr(symbol, ' ')) return arena_printf(&formulas->arena, "(%s)_%s", symbol, axis);
    return arena_printf(&formulas->arena, strchr(symbol, '_') ? "%s%s" : "%s_%s", symbol, axis);
}

/* Friction in general: its symbol where it holds, numbered as its surface's normal force is. */
static const char *friction_symbol(struct formulas *formulas, const char *symbol)
{
    const char *N = strncmp(symbol, "mu_k N", strlen("mu_k N")) == 0 ? symbol + strlen("mu_k N") : NULL;
    return N ? arena_printf(&formulas->arena, "f%s", N) : symbol;
}

static const char *term_of(struct formulas *formulas, const struct equation *equation, size_t index,
                           struct arrow *arrows, size_t count)
{
    const fbd_term *term = &equation->public.terms[index];
    int k = arrow_of(arrows, count, term->name);
    if (k < 0) return arena_printf(&formulas->arena, "(%s)", term->name);
    const char *law = law_of(formulas, equation, index);
    if (law) return law;
    const char *symbol = formulas->symbols[equation->body][k];
    bool rubs = formulas->general && arrows[k].load >= 0 &&
                formulas->state->model->loads[arrows[k].load].source->kind == load_friction;
    if (rubs && is_along_a_line(formulas, equation)) return friction_symbol(formulas, symbol);
    if (rubs) symbol = friction_symbol(formulas, symbol);
    const char *text = !symbol ? NULL : term_by_symbol(formulas, equation, &arrows[k], symbol, term->value);
    struct arrow *room =
        ARENA_ARRAY(&formulas->arena, diagram_most_arrows(formulas->state->model), struct arrow);
    if (!text || !room) return NULL;
    bool signed_already = text[0] == '-' || text == symbol || strcmp(text, symbol) == 0;
    if (!signed_already && is_opposite(formulas, equation->body, &arrows[k], symbol, room))
        return arena_printf(&formulas->arena, "-%s", text);
    return text;
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
        if (strcmp(equation->public.terms[i].name, name) == 0 && arrow_of(arrows, count, name) >= 0)
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
