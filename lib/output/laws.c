/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/laws.h"

#include <math.h>

#include "dynamics/tree.h"

static const char *minus_of(double factor)
{
    return factor < 0 ? "-" : "";
}

bool body_lists(const struct fbd_model *model, int body, int load)
{
    const struct model_body *b = &model->bodies[body];
    return load >= b->first_load && load < b->first_load + b->load_count;
}

/* ---- gravity */

/* Write its component along d, a fixed direction of the world at the angle named `angle`. */
static void write_weight_along(struct text *text, struct vec g, struct vec d, const struct law_names *names)
{
    const char *m = names->mass, *angle = names->along;
    const bool tilted = g.x != 0 && g.y != 0, along_y = g.x * d.x == 0;
    const double by = along_y ? d.y : d.x, size = along_y ? g.y : g.x;
    if (by * size == 0) return;
    if (tilted && d.x != 0 && d.y != 0)
        text_printf(text, "%s (g_x cos(%s) + g_y sin(%s))", m, angle, angle);
    else if (tilted)
        text_printf(text, "%s%s g_%c", minus_of(by), m, along_y ? 'y' : 'x');
    else if (fabs(by) == 1)
        text_printf(text, "%s%s g", minus_of(by * size), m);
    else
        text_printf(text, "%s%s g %s(%s)", minus_of(size), m, along_y ? "sin" : "cos", angle);
}

/* Write its moment about the axis, m (r_x g_y - r_y g_x). On the ground OG follows from theta if G is on an
 * axis of the body's frame: (L cos, L sin) for an arm along +x, (-L sin, L cos) for one along +y. */
static void write_weight_about(struct text *text, struct vec g, const struct model_body *body,
                               const struct law_names *names)
{
    const struct vec arm = body->arm;
    const bool vertical = g.x == 0;
    double size = vertical ? g.y : -g.x;
    if (body->L == 0 || (g.x == 0 && g.y == 0)) return;
    if (g.x != 0 && g.y != 0) {
        text_printf(text, "%s (r_x g_y - r_y g_x)", names->mass);
    } else if (body->parent != ground_body || (arm.x != 0 && arm.y != 0)) {
        text_printf(text, "%s%s g r_%c", minus_of(size), names->mass, vertical ? 'x' : 'y');
    } else {
        const bool along_x = arm.y == 0;
        size *= along_x ? arm.x : vertical ? -arm.y : arm.y;
        text_printf(text, "%s%s g %s %s(theta)", minus_of(size), names->mass, names->L,
                    along_x == vertical ? "cos" : "sin");
    }
}

static void write_weight(struct text *text, const struct fbd_model *model, const struct equation *equation,
                         const struct law_names *names)
{
    static const struct vec axes[] = {{1, 0}, {0, 1}};
    const struct model_body *body = &model->bodies[equation->body];
    const struct vec g = model->scene->gravity;
    const bool in_world = equation->cut_free || body->parent == ground_body;
    if (!equation->cut_free && body->joint->has_axis)
        write_weight_about(text, g, body, names);
    else if (!equation->cut_free && body->joint->path == path_line && in_world)
        write_weight_along(text, g, body->e, names);
    else if (equation->part < 2 && in_world && (equation->cut_free || body->joint->path != path_curve))
        write_weight_along(text, g, axes[equation->part], names);
}

/* ---- the others */

/* Write drag at G of a body that does not turn; in a wind w by vectors. */
static void write_drag(struct text *text, const struct load *load, const struct model_body *body, int part,
                       const char *rate)
{
    const bool wind = load_has_wind(load), turns = body->joint->angle >= 0 || body->source->motion.turns;
    if (body->parent != ground_body || turns || (wind && body->joint->path == path_curve)) return;
    const char *speed = wind ? "|v - w|" : "|v|";
    if (load->quadratic == 0)
        text_add(text, "-c ");
    else if (load->linear == 0)
        text_printf(text, "-k %s ", speed);
    else
        text_printf(text, "-(c + k %s) ", speed);
    if (wind)
        text_printf(text, "(v - w)_%c", part == 1 ? 'y' : 'x');
    else
        text_add(text, rate);
}

static const char *formula_of(const struct load *load)
{
    const struct law *law = load_law(load);
    return law->centered && load->free_length == 0 ? law->centered : law->formula;
}

/* Write the formula of a row of the language (scene/law.h). */
static void write_formula(struct text *text, const char *formula, const struct coordinate *q, int part)
{
    for (const char *c = formula; *c; c++) {
        if (*c == '#')
            text_add(text, q->name);
        else if (*c == '@')
            text_add(text, q->rate_name);
        else if (*c == '$')
            text_add(text, part == 1 ? "y" : "x");
        else
            text_add_bytes(text, c, 1);
    }
}

/* True if the law acts along coordinate `part` of the body, so that its formula is the term. */
static bool acts_along(const struct load *load, const struct model_body *body, int part)
{
    const bool moment = coordinate_is_angle(body, part);
    switch (load->kind) {
    case load_potential: /* its moment about G differs from that about the origin of the frame */
        return part < 2 || (body->arm.x == 0 && body->arm.y == 0);
    case moment_applied:
    case moment_spring:
    case moment_damper:
    case moment_potential: return moment;
    case load_applied: return !moment && !body->source->motion.turns;
    default: return !moment;
    }
}

void law_write(struct text *text, const struct fbd_model *model, const struct equation *equation, size_t term,
               const struct law_names *names)
{
    const int index = equation->loads[term], part = equation->part;
    const struct model_body *body = &model->bodies[equation->body];
    const bool last = term + 1 == equation->public.term_count;
    if (last && !equation->cut_free && body->joint->has_axis && tree_has_more(body)) /* of its axis */
        text_printf(text, "-%s (r_x a_Oy - r_y a_Ox)", names->mass);
    if (index < 0 || !body_lists(model, equation->body, index)) return;
    const struct load *load = model->loads[index].source;
    if (load->kind == load_gravity) {
        write_weight(text, model, equation, names);
        return;
    }
    if (equation->cut_free || model->loads[index].linked) return;
    const struct coordinate *q = &model->scene->coordinates[body->first + part];
    if (load->kind == load_drag)
        write_drag(text, load, body, part, q->rate_name);
    else if (load_law(load)->formula && acts_along(load, body, part))
        write_formula(text, formula_of(load), q, part);
}
