/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The forces and moments of a body as a model file lists them.
 */
#include "writer.h"

static void key_pair(struct writer *w, const char *key, int b, const struct formula *pair)
{
    say(w, ", %s: [", key);
    say_formula(w, b, &pair[0]);
    say(w, ", ");
    say_formula(w, b, &pair[1]);
    say(w, "]");
}

/* Its size, in powers of the distance: the formula stands between quotes, or is a number. */
static void say_toward(struct writer *w, int b, const struct load *load)
{
    if (load->power == 0) {
        key_formula(w, "value", b, &load->value);
    } else {
        say(w, ", value: \"(");
        say_summands(w, b, &load->value);
        say(w, ")*(");
        say_number(w, load->reach);
        say(w, "%s/distance)^%d\"", w->scene->us ? "[ft]" : "[m]", load->power);
    }
    say(w, ", toward: ");
    if (load->target < 0)
        say(w, "[%.17g, %.17g]", load->to.x, load->to.y);
    else if (load->end.point == at_G)
        say(w, "%s", w->scene->body[load->target].name);
    else
        say(w, "%s.P%d", w->scene->body[load->target].name, load->end.point);
}

static void say_applied(struct writer *w, int b, const struct load *load)
{
    if (load->form == toward_point) {
        say_toward(w, b, load);
        return;
    }
    if (load->form == components) {
        key_formula(w, "fx", b, &load->value);
        key_formula(w, "fy", b, &load->second);
    } else {
        key_formula(w, "value", b, &load->value);
        if (load->form == along_angle) key_formula(w, "angle", b, &load->second);
    }
    if (load->follows && load->form != along_slide) say(w, ", frame: body");
}

static void say_at(struct writer *w, int b, const struct load *load)
{
    if (load->at.point == at_G && !load->placed) return;
    say(w, ", at: ");
    if (load->placed) say(w, "{point: ");
    say_spot(w, b, &load->at);
    if (load->placed) key_pair(w, "offset", b, load->offset);
    if (load->placed) say(w, "}");
}

static void say_distributed(struct writer *w, int b, const struct load *load)
{
    bool us = w->scene->us;
    say(w, ", from: ");
    say_spot(w, b, &load->at);
    say(w, ", to: ");
    say_spot(w, b, &load->end);
    if (load->curved)
        say(w, ", value: \"%.17g[%s] + %.17g[%s]*s^2\"", load->per_length[0], us ? "lbf/ft" : "N/m",
            load->per_length[1], us ? "lbf/ft^3" : "N/m^3");
    else
        say(w, ", value: [%.17g, %.17g]", load->per_length[0], load->per_length[1]);
    key_formula(w, "factor", b, &load->value);
    if (load->form != along_slide) key_formula(w, "angle", b, &load->second);
    if (load->follows && load->form != along_slide) say(w, ", frame: body");
}

static void say_thrust(struct writer *w, int b, const struct load *load)
{
    if (!load->enters) {
        key_formula(w, "exhaust", b, &load->value);
        if (load->form == along_angle) key_formula(w, "angle", b, &load->second);
        if (load->follows && load->form == along_angle) say(w, ", frame: body");
    } else if (load->form == along_slide) {
        key_formula(w, "velocity", b, &load->value);
    } else {
        const struct formula pair[2] = {load->value, load->second};
        key_pair(w, "velocity", b, pair);
    }
    say_at(w, b, load);
}

static void say_friction(struct writer *w, int b, const struct load *load)
{
    key_formula(w, "static", b, &load->value);
    key_formula(w, "kinetic", b, &load->second);
    if (load->surface.count > 0) key_formula(w, "surface_speed", b, &load->surface);
}

static void say_link(struct writer *w, int b, const struct load *load)
{
    if (load->kind == spring) key_number(w, "stiffness", load->stiffness);
    if (load->kind == damper) key_number(w, "coefficient", load->coefficient);
    say_at(w, b, load);
    if (load->to_ground) {
        say(w, ", to: ");
        say_pair(w, load->to);
    }
    if (load->kind == spring) key_number(w, load->to_ground ? "free_length" : "neutral", load->neutral);
}

static void say_load(struct writer *w, int b, const struct load *load)
{
    static const char *const kinds[] = {"gravity", "normal", "friction",  "applied",     "spring",
                                        "damper",  "drag",   "potential", "distributed", "thrust",
                                        "applied", "spring", "damper",    "friction",    "potential"};
    say(w, "      - %s: {name: %s", kinds[load->kind], load->name);
    switch (load->kind) {
    case gravity: break;
    case normal:
        say(w, ", side: %s", load->side == left_side ? "left" : "right");
        if (load->two_sided) say(w, ", two_sided: true");
        break;
    case friction:
    case moment_friction: say_friction(w, b, load); break;
    case applied:
        say_applied(w, b, load);
        say_at(w, b, load);
        break;
    case spring:
    case damper: say_link(w, b, load); break;
    case drag:
        key_number(w, "linear", load->coefficient);
        key_number(w, "quadratic", load->quadratic);
        if (load->windy) key_pair(w, "wind", b, load->wind);
        say_at(w, b, load);
        break;
    case potential:
    case moment_potential: key_formula(w, "V", b, &load->value); break;
    case distributed: say_distributed(w, b, load); break;
    case thrust: say_thrust(w, b, load); break;
    case moment_applied: key_formula(w, "value", b, &load->value); break;
    case moment_spring:
        key_number(w, "stiffness", load->stiffness);
        key_number(w, "neutral", load->neutral);
        break;
    case moment_damper: key_number(w, "coefficient", load->coefficient); break;
    }
    say(w, "}\n");
}

void say_loads(struct writer *w, int b, bool moments)
{
    const struct body *body = &w->scene->body[b];
    bool any = false;
    for (int i = 0; i < body->load_count; i++) {
        if ((body->load[i].kind >= moment_applied) != moments) continue;
        if (!any) say(w, "    %s:\n", moments ? "moments" : "forces");
        any = true;
        say_load(w, b, &body->load[i]);
    }
}
