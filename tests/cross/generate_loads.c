/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random forces and moments, and the formulas in them.
 */
#include <stdio.h>
#include <string.h>

#include "generate.h"

/* ---- formulas */

static struct variable own_coordinate(struct random *random, const struct scene *scene, int b, bool rate)
{
    int n = coordinate_count(scene->body[b].motion);
    return (struct variable){.kind = rate ? var_rate : var_coordinate,
                             .body = b,
                             .index = random_below(random, n)};
}

/* Its angle is then known but for whole turns. */
static bool turns_on_a_curve(const struct scene *scene, int b)
{
    for (; b >= 0; b = scene->body[b].on)
        if (scene->body[b].motion == track) return true;
    return false;
}

/* Anything that a force may speak of. Places in the world of a point whose name is also a coordinate are left
 * to the coordinate. */
static struct variable any_variable(struct random *random, const struct scene *scene, int own)
{
    if (scene->state_count > 0 && random_chance(random, 0.25))
        return (struct variable){.kind = var_state, .index = random_below(random, scene->state_count)};
    int b = random_chance(random, 0.5) ? own : random_below(random, scene->body_count);
    const struct body *body = &scene->body[b];
    int n = coordinate_count(body->motion);
    struct variable variable = {.kind = var_time, .body = b};
    switch (random_below(random, 5)) {
    case 0: break;
    case 1:
    case 2:
        if (n > 0) variable = own_coordinate(random, scene, b, random_chance(random, 0.3));
        break;
    case 3:
        variable.kind =
            random_chance(random, 0.7) && !turns_on_a_curve(scene, b) ? var_angle : var_angle_rate;
        break;
    case 4:
        variable.kind = (enum variable_kind)(var_place_x + random_below(random, 4));
        variable.index = body->point_count > 0 ? random_below(random, body->point_count) : -1;
        if (variable.index < 0 && body->motion != pivot && body->motion != weld && body->motion != track)
            variable.kind = var_angle_rate;
        break;
    }
    return variable;
}

static enum function random_function(struct random *random, bool kinks)
{
    if (kinks && random_chance(random, 0.4))
        return (enum function)(f_abs + random_below(random, function_count - f_abs));
    return (enum function)(f_linear + random_below(random, f_abs - f_linear));
}

/* A force that grows with the square of a coordinate, or with a velocity, may run away within the second. */
static void tame(struct summand *summand)
{
    bool rate = false, coordinate = false;
    for (int i = 0; i < summand->count; i++) {
        enum variable_kind kind = summand->variable[i].kind;
        rate |= kind == var_rate || kind == var_place_vx || kind == var_place_vy || kind == var_angle_rate;
        coordinate |= kind != var_time;
    }
    enum function f = summand->function;
    if (rate &&
        (f == f_linear || f == f_square || f == f_hyper || f == f_abs || f == f_ramp || f == f_branch))
        summand->function = f_tanh;
    if (coordinate && (f == f_square || f == f_branch)) summand->function = f_sin;
}

static struct summand random_summand(struct random *random, const struct scene *scene, double size,
                                     bool kinks)
{
    struct summand summand = {.factor = random_between(random, -size, size), .parameter = -1};
    summand.function = random_function(random, kinks);
    summand.shift = random_between(random, -1, 1);
    if (summand.shift == 0)
        summand.shift = 0.5; /* the angle of a particle would be on the edge of a step for ever */
    if (scene->table_count > 0 && random_chance(random, 0.5)) {
        summand.function = f_table;
        summand.table = random_below(random, scene->table_count);
    }
    if (scene->parameter_count > 0 && random_chance(random, 0.4))
        summand.parameter = random_below(random, scene->parameter_count);
    return summand;
}

static void add_variable(struct random *random, struct summand *summand, struct variable variable)
{
    bool rate = variable.kind == var_rate || (variable.kind >= var_place_vx && variable.kind != var_state);
    variable.coefficient =
        random_between(random, 0.2, rate ? 0.5 : 1) * (random_chance(random, 0.5) ? 1 : -1);
    summand->variable[summand->count++] = variable;
}

struct formula random_formula(struct random *random, const struct scene *scene, int b,
                              enum dimension dimension, double size, bool kinks)
{
    if (random_chance(random, 0.4)) return constant_formula(dimension, random_between(random, -size, size));
    struct formula formula = {.dimension = dimension, .count = 1 + random_below(random, 2)};
    for (int k = 0; k < formula.count; k++) {
        formula.summand[k] = random_summand(random, scene, size / 2, kinks);
        for (int i = random_below(random, 2); i >= 0; i--)
            add_variable(random, &formula.summand[k], any_variable(random, scene, b));
        tame(&formula.summand[k]);
    }
    return formula;
}

/* Of time alone. */
static struct formula time_formula(struct random *random, enum dimension dimension, double size)
{
    static const enum function functions[] = {f_linear, f_sin, f_cos, f_tanh, f_square};
    struct formula formula = {.dimension = dimension, .count = 1};
    formula.summand[0] = (struct summand){.factor = random_between(random, 0.3 * size, size),
                                          .parameter = -1,
                                          .function = functions[random_below(random, 5)],
                                          .count = 1,
                                          .shift = random_between(random, -1, 1)};
    formula.summand[0].variable[0].coefficient = random_between(random, 0.5, 2);
    return formula;
}

/* Where forces jump with them or have corners only with `kinks`. */
void random_tables(struct random *random, struct scene *scene, bool kinks)
{
    scene->table_count = random_below(random, most_tables + 1);
    for (int i = 0; i < scene->table_count; i++) {
        struct table *table = &scene->table[i];
        table->interpolation =
            (enum interpolation)(kinks ? random_below(random, 5) : 2 + random_below(random, 3));
        table->beyond = (enum beyond)random_below(random, 3);
        table->count = 5 + random_below(random, most_table_points - 4);
        double x = random_between(random, kinks ? -3 : -9, kinks ? -1 : -7);
        for (int k = 0; k < table->count; k++) {
            table->x[k] = x;
            table->y[k] = random_between(random, -1, 1);
            x += random_between(random, kinks ? 0.4 : 2, 4);
        }
        bool jumps = kinks && table->interpolation == by_lines;
        if (table->beyond == beyond_repeats && !jumps) table->y[table->count - 1] = table->y[0];
    }
}

/* After all bodies are there: they may speak of any of them, and of each other. */
void random_states(struct random *random, struct scene *scene)
{
    for (int i = 0; i < scene->state_count; i++) {
        struct state *state = &scene->state[i];
        state->initial = random_between(random, -1, 1);
        state->rate =
            random_formula(random, scene, random_below(random, scene->body_count), dim_number, 2, false);
        if (state->rate.count == most_summands) continue;
        struct summand *decay = &state->rate.summand[state->rate.count++];
        *decay = (struct summand){.factor = -1, .parameter = -1, .function = f_linear, .count = 1};
        decay->variable[0] =
            (struct variable){.kind = var_state, .index = i, .coefficient = random_between(random, 0.2, 3)};
    }
}

struct formula random_drive(struct random *random, enum dimension dimension)
{
    return time_formula(random, dimension, 0.8);
}

static struct formula potential_of(struct random *random, const struct scene *scene, int b, bool angle)
{
    struct formula formula = {.dimension = dim_energy, .count = 1 + random_below(random, 2)};
    for (int k = 0; k < formula.count; k++) {
        struct variable variable = own_coordinate(random, scene, b, false);
        if (angle) variable.index = coordinate_count(scene->body[b].motion) - 1;
        formula.summand[k] = random_summand(random, scene, 6, false);
        add_variable(random, &formula.summand[k], variable);
        if (!angle && random_chance(random, 0.4))
            add_variable(random, &formula.summand[k], own_coordinate(random, scene, b, false));
    }
    return formula;
}

/* ---- loads */

static struct load *add_load(struct scene *scene, int b, enum load_kind kind)
{
    struct body *body = &scene->body[b];
    if (body->load_count == most_loads) return NULL;
    struct load *load = &body->load[body->load_count];
    memset(load, 0, sizeof *load);
    load->kind = kind;
    load->at.point = at_G;
    snprintf(load->name, sizeof load->name, "f%d", body->load_count++);
    return load;
}

static struct spot some_spot(struct random *random, struct body *body)
{
    if (random_chance(random, 0.4)) return (struct spot){.point = at_G};
    if (random_chance(random, 0.3))
        return (struct spot){at_pair, {random_between(random, -0.6, 0.6), random_between(random, -0.6, 0.6)}};
    return (struct spot){.point = random_point(random, body)};
}

/* To a place on the ground that is far, or to a point of another body: scene_fit sees whether that is apart. */
static void turn_toward(struct random *random, struct scene *scene, int b, struct load *load)
{
    int other = random_below(random, scene->body_count);
    load->form = toward_point;
    load->follows = false;
    load->target = other == b ? -1 : other;
    load->end.point = at_G;
    if (load->target >= 0 && random_chance(random, 0.5))
        load->end.point = random_point(random, &scene->body[other]);
    double far = random_chance(random, 0.5) ? 6 : -6;
    load->to = (struct vec2){far + random_between(random, -1, 1), random_between(random, -4, 4)};
    load->power = random_below(random, 3);
    load->reach = random_between(random, 0.3, 1);
}

/* Two components; with `time` of nothing else, as an offset that goes with a velocity would make power of
 * nothing. */
static void random_pair(struct random *random, const struct scene *scene, int b, enum dimension dimension,
                        double size, struct formula pair[2])
{
    for (int k = 0; k < 2; k++) pair[k] = random_formula(random, scene, b, dimension, size, false);
}

static void add_applied(struct random *random, struct scene *scene, int b, bool kinks)
{
    struct load *load = add_load(scene, b, applied);
    if (!load) return;
    bool along =
        scene->body[b].motion == slide || (scene->body[b].motion == track && !scene->body[b].keeps_direction);
    load->form =
        along ? (enum applied_form)random_below(random, 3) : (enum applied_form)(1 + random_below(random, 2));
    load->follows = random_chance(random, 0.4) && !scene->body[b].keeps_direction;
    load->at = some_spot(random, &scene->body[b]);
    load->value = random_formula(random, scene, b, dim_force, 10, kinks);
    load->second = load->form == components ? random_formula(random, scene, b, dim_force, 10, kinks)
                                            : random_formula(random, scene, b, dim_angle, 3, false);
    if (load->form != components && random_chance(random, 0.4)) turn_toward(random, scene, b, load);
    load->placed = random_chance(random, 0.4);
    if (load->placed) random_pair(random, scene, b, dim_length, 0.6, load->offset);
}

static void add_link(struct random *random, struct scene *scene, int b, enum load_kind kind)
{
    struct load *load = add_load(scene, b, kind);
    if (!load) return;
    load->at = some_spot(random, &scene->body[b]);
    load->to_ground = scene->body[b].motion != slide || random_chance(random, 0.5);
    /* Far enough that its length stays off zero, where its direction turns round at once. */
    double far = random_chance(random, 0.5) ? 6 : -6;
    load->to = (struct vec2){far + random_between(random, -1, 1), random_between(random, -4, 4)};
    if (kind == spring) load->stiffness = random_between(random, 1, 20);
    if (kind == spring) load->neutral = random_between(random, 0, load->to_ground ? 6 : 1);
    if (kind == damper) load->coefficient = random_between(random, 0.2, 3);
}

/* Dry friction: on a slide with its surface, in a bearing. */
static void add_dry(struct random *random, struct scene *scene, int b, bool surface)
{
    struct load *load = add_load(scene, b, surface ? friction : moment_friction);
    if (!load) return;
    double kinetic = surface ? random_between(random, 0.05, 0.4) : random_between(random, 0.2, 1.5);
    enum dimension dimension = surface ? dim_number : dim_moment;
    load->second = constant_formula(dimension, kinetic);
    load->value = constant_formula(dimension, round(kinetic * random_between(random, 1, 1.4) * 1000) / 1000);
    if (random_chance(random, 0.3))
        load->surface = time_formula(random, surface ? dim_speed : dim_angular_speed, 1);
    if (!surface && random_chance(random, 0.3)) scene->body[b].v[0] = 0;
}

static void add_surface(struct random *random, struct scene *scene, int b, const struct taste *taste)
{
    struct load *load = add_load(scene, b, normal);
    if (!load) return;
    load->side = random_chance(random, 0.5) ? left_side : right_side;
    load->two_sided = random_chance(random, 0.4);
    if (!taste->frictions || scene->body[b].driven) return;
    add_dry(random, scene, b, true);
    if (random_chance(random, 0.3)) scene->body[b].v[0] = 0;
}

static void add_drag(struct random *random, struct scene *scene, int b)
{
    struct load *load = add_load(scene, b, drag);
    if (!load) return;
    load->at = some_spot(random, &scene->body[b]);
    load->coefficient = random_between(random, 0, 1);
    load->quadratic = random_chance(random, 0.6) ? random_between(random, 0, 0.3) : 0;
    load->windy = random_chance(random, 0.5);
    if (load->windy) random_pair(random, scene, b, dim_speed, 4, load->wind);
}

static struct spot end_of_line(struct random *random, struct body *body)
{
    if (random_chance(random, 0.5)) return (struct spot){.point = random_point(random, body)};
    return (struct spot){at_pair, {random_between(random, -0.6, 0.6), random_between(random, -0.6, 0.6)}};
}

static void add_distributed(struct random *random, struct scene *scene, int b)
{
    struct body *body = &scene->body[b];
    struct load *load = add_load(scene, b, distributed);
    if (!load) return;
    load->at = end_of_line(random, body);
    load->end = end_of_line(random, body);
    struct vec2 p = spot_of(body, &load->at), q = spot_of(body, &load->end);
    if (hypot(p.x - q.x, p.y - q.y) < 0.1) {
        body->load_count--;
        return;
    }
    load->curved = random_chance(random, 0.5);
    for (int k = 0; k < 2; k++) load->per_length[k] = random_between(random, 0.5, 6);
    load->form = body->motion == slide && random_chance(random, 0.4) ? along_slide : along_angle;
    load->follows = random_chance(random, 0.4) && !scene->body[b].keeps_direction;
    load->value = random_formula(random, scene, b, dim_number, 1, false);
    if (load->form != along_slide) load->second = random_formula(random, scene, b, dim_angle, 3, false);
}

static void add_potential(struct random *random, struct scene *scene, int b, bool moment)
{
    struct load *load = add_load(scene, b, moment ? moment_potential : potential);
    if (load) load->value = potential_of(random, scene, b, moment);
}

static void add_moment(struct random *random, struct scene *scene, int b, const struct taste *taste)
{
    enum motion motion = scene->body[b].motion;
    struct load *load;
    switch (random_below(random, motion == weld || motion == track ? 1 : 5)) {
    case 0:
        load = add_load(scene, b, moment_applied);
        if (load) load->value = random_formula(random, scene, b, dim_moment, 4, taste->kinks);
        break;
    case 1:
        load = add_load(scene, b, moment_spring);
        if (!load) break;
        load->stiffness = random_between(random, 0.5, 10);
        load->neutral = random_between(random, -1, 1);
        break;
    case 2:
        load = add_load(scene, b, moment_damper);
        if (load) load->coefficient = random_between(random, 0.1, 1);
        break;
    case 3: add_potential(random, scene, b, true); break;
    case 4:
        if (motion == pivot && taste->frictions && !scene->body[b].driven) add_dry(random, scene, b, false);
        break;
    }
}

/* Of the time, of a coordinate, of a state: never less than a fifth of what it is on the average. */
static struct formula mass_formula(struct random *random, const struct scene *scene, int b)
{
    static const enum function functions[] = {f_sin, f_cos, f_tanh, f_bell};
    double m = scene->body[b].piece[0].mass;
    struct formula formula = constant_formula(dim_mass, m);
    for (int i = random_below(random, 2); i >= 0; i--) {
        struct summand *summand = &formula.summand[formula.count++];
        *summand = (struct summand){.factor = random_between(random, -0.4 * m, 0.4 * m),
                                    .parameter = -1,
                                    .function = functions[random_below(random, 4)],
                                    .shift = random_between(random, -1, 1)};
        int other = random_below(random, scene->body_count);
        struct variable variable = {.kind = var_time, .body = b};
        if (scene->state_count > 0 && random_chance(random, 0.4))
            variable =
                (struct variable){.kind = var_state, .index = random_below(random, scene->state_count)};
        else if (coordinate_count(scene->body[other].motion) > 0 && random_chance(random, 0.5))
            variable = own_coordinate(random, scene, other, false);
        add_variable(random, summand, variable);
    }
    return formula;
}

void random_mass(struct random *random, struct scene *scene, int b, const struct taste *taste)
{
    struct body *body = &scene->body[b];
    if (body->piece_count > 1 || body->piece[0].shape == given_inertia) return;
    if (!random_chance(random, taste->focus == of_masses ? 0.9 : 0.1)) return;
    body->mass_varies = true;
    body->mass = mass_formula(random, scene, b);
}

static void add_thrust(struct random *random, struct scene *scene, int b)
{
    const struct body *body = &scene->body[b];
    struct load *load = add_load(scene, b, thrust);
    if (!load) return;
    bool along = body->motion == slide || (body->motion == track && !body->keeps_direction);
    load->at = some_spot(random, &scene->body[b]);
    load->enters = random_chance(random, 0.5);
    load->form = load->enters ? components : along_angle;
    if (along && (!load->enters || body->on < 0) && random_chance(random, 0.5)) load->form = along_slide;
    load->follows = !load->enters && random_chance(random, 0.4) && !body->keeps_direction;
    load->value = random_formula(random, scene, b, dim_speed, 3, false);
    if (load->form == components) load->second = random_formula(random, scene, b, dim_speed, 3, false);
    if (load->form == along_angle) load->second = random_formula(random, scene, b, dim_angle, 3, false);
}

void random_loads(struct random *random, struct scene *scene, int b, const struct taste *taste)
{
    enum motion motion = scene->body[b].motion;
    bool turns = motion == pivot || motion == planar || motion == weld || motion == track;
    bool along = motion == slide || motion == track;
    if (random_chance(random, 0.8)) add_load(scene, b, gravity);
    if (along && random_chance(random, taste->focus == of_tracks ? 0.9 : 0.4))
        add_surface(random, scene, b, taste);
    if (random_chance(random, 0.4)) add_applied(random, scene, b, taste->kinks);
    if (random_chance(random, 0.3)) add_link(random, scene, b, spring);
    if (random_chance(random, 0.2)) add_link(random, scene, b, damper);
    if (random_chance(random, 0.2)) add_drag(random, scene, b);
    if (random_chance(random, 0.2)) add_distributed(random, scene, b);
    if (scene->body[b].mass_varies && random_chance(random, 0.6)) add_thrust(random, scene, b);
    if (motion != weld && random_chance(random, 0.2)) add_potential(random, scene, b, false);
    if (turns && random_chance(random, 0.4)) add_moment(random, scene, b, taste);
}
