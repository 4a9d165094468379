/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "writer.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

void say(struct writer *w, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int n = vsnprintf(w->text + w->length, text_room - w->length, format, arguments);
    va_end(arguments);
    if (n > 0) w->length += (size_t)n;
    if (w->length >= text_room) w->length = text_room - 1;
}

const char *number_text(double value, char text[32])
{
    for (int digits = 3; digits <= 17; digits++) {
        double back = 0;
        snprintf(text, 32, "%.*g", digits, value);
        if (sscanf(text, "%lf", &back) == 1 && back == value) break;
    }
    return text;
}

void say_number(struct writer *w, double value)
{
    char text[32];
    say(w, "%s", number_text(value, text));
}

void say_pair(struct writer *w, struct vec2 p)
{
    char x[32], y[32];
    say(w, "[%s, %s]", number_text(p.x, x), number_text(p.y, y));
}

/* ---- formulas: each literal with its unit */

static const char *unit_of(const struct scene *scene, enum dimension dimension)
{
    static const char *const si[] = {"", "", "[m]", "[m/s]", "[rad/s]", "[N]", "[N*m]", "[J]", "[kg]"};
    static const char *const us[] = {"",      "",         "[ft]",     "[ft/s]", "[rad/s]",
                                     "[lbf]", "[lbf*ft]", "[lbf*ft]", "[slug]"};
    return (scene->us ? us : si)[dimension];
}

static enum dimension variable_dimension(const struct scene *scene, const struct variable *variable)
{
    const enum motion motion = scene->body[variable->body].motion;
    bool angle = motion == pivot || variable->index == 2;
    switch (variable->kind) {
    case var_time:
    case var_state: return dim_number;
    case var_coordinate: return angle ? dim_angle : dim_length;
    case var_rate: return angle ? dim_angular_speed : dim_speed;
    case var_place_x:
    case var_place_y: return dim_length;
    case var_place_vx:
    case var_place_vy: return dim_speed;
    case var_angle: return dim_angle;
    case var_angle_rate: return dim_angular_speed;
    }
    return dim_number;
}

static const char *coordinate_name(enum motion motion, int index, bool rate)
{
    static const char *const names[] = {"x", "y", "theta"}, *const rates[] = {"vx", "vy", "omega"};
    if (motion == slide || motion == track) return rate ? "v" : motion == slide ? "x" : "s";
    if (motion == pivot) index = 2;
    return (rate ? rates : names)[index];
}

static void say_variable(struct writer *w, int own, const struct variable *variable)
{
    const struct body *body = &w->scene->body[variable->body];
    static const char *const places[] = {"x", "y", "vx", "vy"};
    bool rate = variable->kind == var_rate;
    switch (variable->kind) {
    case var_time: say(w, "t"); return;
    case var_coordinate:
    case var_rate:
        if (variable->body != own) say(w, "%s.", body->name);
        say(w, "%s", coordinate_name(body->motion, variable->index, rate));
        return;
    case var_state: say(w, "states.z%d", variable->index); return;
    case var_angle: say(w, "%s.angle", body->name); return;
    case var_angle_rate: say(w, "%s.angle_dot", body->name); return;
    default: break;
    }
    say(w, "%s.", body->name);
    if (variable->index >= 0) say(w, "P%d.", variable->index);
    say(w, "%s", places[variable->kind - var_place_x]);
}

/* sum of coefficient * variable + shift: variables as numbers, by a unit of each. */
static void say_argument(struct writer *w, int own, const struct summand *summand)
{
    for (int i = 0; i < summand->count; i++) {
        const struct variable *variable = &summand->variable[i];
        enum dimension dimension = variable_dimension(w->scene, variable);
        if (i > 0) say(w, " + ");
        say(w, "(");
        say_number(w, variable->coefficient);
        say(w, ")*");
        say_variable(w, own, variable);
        if (variable->kind == var_time)
            say(w, "/1[s]");
        else if (*unit_of(w->scene, dimension))
            say(w, "/1%s", unit_of(w->scene, dimension));
    }
    if (summand->count > 0) say(w, " + ");
    say(w, "(");
    say_number(w, summand->shift);
    say(w, ")");
}

static void say_function(struct writer *w, int own, const struct summand *summand)
{
    static const struct {
        const char *before, *after;
    } forms[] = {
        [f_linear] = {"(", ")"},
        [f_sin] = {"sin(", ")"},
        [f_cos] = {"cos(", ")"},
        [f_tanh] = {"tanh(", ")"},
        [f_square] = {"(", ")^2"},
        [f_bell] = {"exp(-(", ")^2)"},
        [f_hyper] = {"sqrt(1 + (", ")^2)"},
        [f_atan] = {"atan(", ")"},
        [f_abs] = {"abs(", ")"},
        [f_step] = {"step(", ")"},
        [f_ramp] = {"max(0, ", ")"},
        [f_clamp] = {"clamp(", ", -1, 1)"},
    };
    if (summand->function == f_table) {
        say(w, "T%d(", summand->table);
        say_argument(w, own, summand);
        say(w, ")");
        return;
    }
    if (summand->function == f_branch) {
        say(w, "if(");
        say_argument(w, own, summand);
        say(w, " > 0, (");
        say_argument(w, own, summand);
        say(w, ")^2, 0)");
        return;
    }
    say(w, "%s", forms[summand->function].before);
    say_argument(w, own, summand);
    say(w, "%s", forms[summand->function].after);
}

void say_summands(struct writer *w, int own, const struct formula *formula)
{
    for (int k = 0; k < formula->count; k++) {
        const struct summand *summand = &formula->summand[k];
        if (k > 0) say(w, " + ");
        say_number(w, summand->factor);
        say(w, "%s", unit_of(w->scene, formula->dimension));
        if (summand->parameter >= 0) say(w, "*p%d", summand->parameter);
        if (summand->function != f_one) say(w, "*");
        if (summand->function != f_one) say_function(w, own, summand);
    }
    if (formula->count == 0) say(w, "0%s", unit_of(w->scene, formula->dimension));
}

void say_formula(struct writer *w, int own, const struct formula *formula)
{
    bool bare =
        formula->count == 1 && formula->summand[0].function == f_one && formula->summand[0].parameter < 0;
    if (bare) {
        say_number(w, formula->summand[0].factor);
        return;
    }
    say(w, "\"");
    say_summands(w, own, formula);
    say(w, "\"");
}

void key_formula(struct writer *w, const char *key, int own, const struct formula *formula)
{
    say(w, "%s%s: ", w->between, key);
    say_formula(w, own, formula);
}

void key_number(struct writer *w, const char *key, double value)
{
    say(w, "%s%s: ", w->between, key);
    say_number(w, value);
}

/* ---- bodies */

void say_spot(struct writer *w, int body, const struct spot *spot)
{
    if (spot->point == at_origin)
        say(w, "[0, 0]");
    else if (spot->point == at_G)
        say(w, "G");
    else if (spot->point >= 0)
        say(w, body < 0 ? "Q%d" : "P%d", spot->point);
    else
        say_pair(w, spot->where);
}

static void say_shape(struct writer *w, int b, const struct piece *piece)
{
    static const char *const names[] = {"point", "rod", "sphere", "disc", "hollow_cylinder", "prism", "ring"};
    const double *s = piece->size;
    say(w, "mass: ");
    if (w->scene->body[b].mass_varies)
        say_formula(w, b, &w->scene->body[b].mass);
    else
        say_number(w, piece->mass);
    if (piece->shape == given_inertia && (s[1] != 0 || s[2] != 0)) {
        say(w, "%sinertia: {value: ", w->between);
        say_number(w, s[0] + piece->mass * (s[1] * s[1] + s[2] * s[2]));
        say(w, ", about: ");
        say_pair(w, (struct vec2){piece->center.x + s[1], piece->center.y + s[2]});
        say(w, "}");
    } else if (piece->shape == given_inertia) {
        key_number(w, "inertia", s[0]);
    } else {
        say(w, "%sshape: %s", w->between, names[piece->shape]);
    }
    if (piece->shape == rod_shape) key_number(w, "length", s[0]);
    if (piece->shape == sphere_shape || piece->shape == disc_shape || piece->shape == ring_shape)
        key_number(w, "radius", s[0]);
    if (piece->shape == tube_shape) {
        key_number(w, "outer_radius", s[0]);
        key_number(w, "inner_radius", s[1]);
    }
    if (piece->lies) say(w, "%saxis: z", w->between);
    if (piece->lies && piece->shape == disc_shape) key_number(w, "length", s[2]);
    if (piece->shape == prism_shape) {
        key_number(w, "a", s[0]);
        key_number(w, "b", s[1]);
    }
    say(w, "%scenter: ", w->between);
    say_pair(w, piece->center);
    if (piece->angle != 0 && piece->shape != given_inertia) key_number(w, "angle", piece->angle);
}

static void say_motion(struct writer *w, int b)
{
    static const char *const names[] = {"slide", "pivot", "particle", "planar", "weld", "track"};
    const struct scene *scene = w->scene;
    const struct body *body = &scene->body[b];
    say(w, "    motion: {%s: {", names[body->motion]);
    if (body->on >= 0) say(w, "on: %s", scene->body[body->on].name);
    const char *comma = body->on >= 0 ? ", " : "";
    if (body->motion == slide || body->motion == weld) {
        say(w, "%s%s: ", comma, body->motion == slide ? "along" : "angle");
        say_number(w, body->along);
        comma = ", ";
    }
    if (body->motion != particle && body->motion != planar) {
        say(w, "%s%s: ", comma, body->motion == slide ? "through" : "at");
        say_spot(w, body->on, &body->at);
    }
    if (body->motion == track) say_path(w, &body->path);
    if (body->motion == track && body->keeps_direction) say(w, ", turn: false");
    if ((body->motion == weld || body->motion == pivot || body->motion == track) &&
        body->point.point != at_origin) {
        say(w, ", point: ");
        say_spot(w, b, &body->point);
    }
    if (body->driven) key_formula(w, coordinate_name(body->motion, 0, false), b, &body->drive);
    say(w, "}}\n");
}

static void say_initial(struct writer *w, const struct body *body)
{
    int n = coordinate_count(body->motion);
    if (body->driven || n == 0) return;
    say(w, "    initial: {");
    for (int i = 0; i < n; i++) {
        say(w, "%s%s: ", i > 0 ? ", " : "", coordinate_name(body->motion, i, false));
        say_number(w, body->q[i]);
        key_number(w, coordinate_name(body->motion, i, true), body->v[i]);
    }
    say(w, "}\n");
}

static void say_body(struct writer *w, int b)
{
    const struct body *body = &w->scene->body[b];
    say(w, "  %s:\n", body->name);
    if (body->piece_count == 1) {
        w->between = "\n    ";
        say(w, "    ");
        say_shape(w, b, &body->piece[0]);
        say(w, "\n");
        w->between = ", ";
    } else {
        say(w, "    parts:\n");
    }
    for (int i = 0; i < body->piece_count && body->piece_count > 1; i++) {
        say(w, "      part%d: {", i);
        say_shape(w, b, &body->piece[i]);
        say(w, "}\n");
    }
    if (body->point_count > 0) say(w, "    points: {");
    for (int i = 0; i < body->point_count; i++) {
        say(w, "%sP%d: ", i > 0 ? ", " : "", i);
        say_pair(w, body->points[i]);
    }
    if (body->point_count > 0) say(w, "}\n");
    say_motion(w, b);
    say_initial(w, body);
    say_loads(w, b, false);
    say_loads(w, b, true);
}

static void say_ground(struct writer *w)
{
    const struct scene *scene = w->scene;
    bool any = false;
    for (int c = 0; c < scene->coupling_count; c++)
        for (int k = 0; k < scene->coupling[c].count; k++) {
            const struct end *end = &scene->coupling[c].end[k];
            if (end->body >= 0 || scene->coupling[c].kind == roll) continue;
            if (!any) say(w, "ground:\n  points:\n");
            any = true;
            say(w, "    Q%d_%d: ", c, k);
            say_pair(w, end->at.where);
            say(w, "\n");
        }
    if (scene->line_count > 0) say(w, any ? "  lines:\n" : "ground:\n  lines:\n");
    for (int i = 0; i < scene->line_count; i++) {
        say(w, "    L%d: {through: ", i);
        say_pair(w, scene->line[i].through);
        key_number(w, "along", scene->line[i].along);
        say(w, "}\n");
    }
}

size_t scene_write(const struct scene *scene, double until, char text[text_room])
{
    struct writer writer = {scene, text, 0, ", "}, *w = &writer;
    text[0] = '\0';
    say(w, "fbd: 1\ntitle: scene %llu\nunits: %s\ngravity: ", (unsigned long long)scene->seed,
        scene->us ? "US" : "SI");
    say_pair(w, scene->gravity);
    say(w, "\n");
    say_tables(w);
    say_states(w);
    if (scene->parameter_count > 0) say(w, "parameters:\n");
    for (int i = 0; i < scene->parameter_count; i++) {
        say(w, "  p%d: ", i);
        say_number(w, scene->parameter[i]);
        say(w, "\n");
    }
    say_ground(w);
    say(w, "bodies:\n");
    for (int b = 0; b < scene->body_count; b++) say_body(w, b);
    if (scene->coupling_count > 0) say(w, "couplings:\n");
    for (int c = 0; c < scene->coupling_count; c++) say_coupling(w, c);
    say(w, "simulate: {until: ");
    say_number(w, until);
    say(w, "}\n");
    return w->length;
}
