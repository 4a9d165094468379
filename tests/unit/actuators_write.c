/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "actuators.h"

#include <math.h>

static void write_table(const struct act_table *table, int i, int k, struct written *text)
{
    static const char *const interpolations[] = {"linear", "step", "cubic"};
    static const char *const beyond[] = {"hold", "zero", "repeat"};
    add(text, "  T%d%d: {interpolation: %s, beyond: %s, points: [", i, k,
        interpolations[table->interpolation], beyond[table->beyond]);
    for (int j = 0; j < act_points; j++)
        add(text, "%s[%.17g, %.17g]", j ? ", " : "", table->x[j], table->y[j]);
    add(text, "]}\n");
}

static void write_state(const struct act *act, int i, struct written *text)
{
    const double *p = act->p;
    int z = act->state;
    if (act->kind == act_motor) {
        add(text,
            "  z%d: {unit: 1, rate: \"(%.17g[N]*square(t/%.17g[s]) - %.17g[N]*states.z%d - "
            "%.17g[N*s/m]*b%d.v)/%.17g[N*s]\"}\n",
            z, p[1], p[0], p[2], z, p[3], i, p[4]);
        return;
    }
    char e[200];
    snprintf(e, sizeof e, "%.17g[m]*sin(%.17g[1/s]*t) - b%d.x", p[0], p[1], i);
    /* The limits in three ways that people write; which, the last digits of the limit say. */
    const int way = (int)fmod(1e7 * p[6], 3);
    if (way == 2)
        add(text,
            "  z%d: {unit: m*s, rate: \"if((states.z%d >= %.17g[m*s] and %s > 0[m]) or (states.z%d <= "
            "-%.17g[m*s] and %s < 0[m]), 0[m], %s)\"}\n",
            z, z, p[6], e, z, p[6], e, e);
    else
        add(text,
            "  z%d: {unit: m*s, rate: \"if(states.z%d >%s %.17g[m*s], min(%s, 0), if(states.z%d <%s "
            "-%.17g[m*s], max(%s, 0), %s))\"}\n",
            z, z, way == 0 ? "=" : "", p[6], e, z, way == 0 ? "=" : "", p[6], e, e);
}

static void write_act(const struct act_scene *scene, int i, int k, struct written *text)
{
    const struct act *act = &scene->body[i].act[k];
    const double *p = act->p;
    int other = (i + 1) % scene->count;
    if (act->kind == act_drag) {
        add(text,
            "      - drag: {linear: %.17g, quadratic: %.17g, wind: [\"%.17g[m/s]*sin(%.17g[1/s]*t)\", "
            "%.17g]}\n",
            p[3], p[4], p[0], p[1], p[2]);
        return;
    }
    if (act->kind == act_load) {
        add(text,
            "      - distributed: {from: left, to: right, value: [%.17g, %.17g], angle: %.17g, factor: \"1 + "
            "%.17g*sin(%.17g[1/s]*t)\"}\n",
            p[0], p[1], p[3], p[4], p[5]);
        return;
    }
    add(text, "      - applied: {name: a%d, value: \"", k);
    switch (act->kind) {
    case act_motor: add(text, "%.17g[N]*states.z%d", p[3], act->state); break;
    case act_control:
        add(text,
            "clamp(%.17g[N/m]*(%.17g[m]*sin(%.17g[1/s]*t) - x) + %.17g[N/m/s]*states.z%d - %.17g[N*s/m]*v, "
            "-%.17g[N], %.17g[N])",
            p[2], p[0], p[1], p[3], act->state, p[4], p[5], p[5]);
        break;
    case act_timed: add(text, "T%d%d(t)", i, k); break;
    case act_placed: add(text, "T%d%d(x)", i, k); break;
    case act_relay: add(text, "%.17g[N]*hysteresis(x, %.17g[m], %.17g[m])", p[0], p[1], p[2]); break;
    case act_bumper:
        add(text, "if(x > %.17g[m], -%.17g[N/m]*(x - %.17g[m]) - %.17g[N*s/m]*v, 0)", p[0], p[1], p[0], p[2]);
        break;
    case act_sliding: add(text, "-%.17g[N]*sign(x - %.17g[m] + %.17g[s]*v)", p[0], p[1], p[2]); break;
    case act_joined:
        add(text, "%.17g[N/m]*(b%d.x - x) + %.17g[N*s/m]*(b%d.v - v)", p[0], other, p[1], other);
        break;
    default: add(text, "%.17g[N]*sin(%.17g[1/s]*t + %.17g)", p[0], p[1], p[2]); break;
    }
    add(text, "\"}\n");
}

static void write_body(const struct act_scene *scene, int i, struct written *text)
{
    const struct act_body *body = &scene->body[i];
    add(text, "  b%d:\n    shape: rod\n    length: 0.5\n    mass: ", i);
    if (body->flow != 0)
        add(text, "\"%.17g[kg] + %.17g[kg/s]*t\"\n", body->m, body->flow);
    else
        add(text, "%.17g\n", body->m);
    add(text, "    motion: {slide: {along: %.17g, through: [0, %d]", body->along, 3 * i);
    if (body->has_stop[0]) add(text, ", min: %.17g", body->stop[0]);
    if (body->has_stop[1]) add(text, ", max: %.17g", body->stop[1]);
    if (body->has_stop[0] || body->has_stop[1]) add(text, ", restitution: %.17g", body->e);
    add(text,
        "}}\n    initial: {x: %.17g, v: %.17g}\n    forces:\n      - gravity\n      - normal: {two_sided: "
        "true}\n",
        body->x, body->v);
    add(text,
        "      - friction: {coefficient: \"(%.17g + %.17g*exp(-slip/%.17g[m/s]))*(1 + "
        "%.17g*sin(%.17g[1/s]*t))\", ",
        body->mu, body->stribeck, body->scale, body->pulse, body->pulse_w);
    add(text, "surface_speed: \"%.17g[m/s] + %.17g[m/s]*sin(%.17g[1/s]*t)\"}\n", body->belt,
        body->belt_shaken, body->belt_w);
    if (body->flow != 0 && body->comes) add(text, "      - thrust: {velocity: %.17g}\n", body->jet);
    if (body->flow != 0 && !body->comes) add(text, "      - thrust: {exhaust: %.17g}\n", body->jet);
    for (int k = 0; k < body->acts; k++) write_act(scene, i, k, text);
}

void act_write(const void *drawn, struct written *text)
{
    const struct act_scene *scene = drawn;
    bool ropes = false, tables = false;
    text->length = 0;
    add(text, "fbd: 1\ngravity: %g\n", act_g);
    for (int i = 0; i < scene->count; i++) {
        ropes |= scene->body[i].has_rope;
        for (int k = 0; k < scene->body[i].acts; k++) {
            const struct act *act = &scene->body[i].act[k];
            if (act->kind != act_timed && act->kind != act_placed) continue;
            if (!tables) add(text, "tables:\n");
            tables = true;
            write_table(&act->table, i, k, text);
        }
    }
    if (scene->states > 0) add(text, "states:\n");
    for (int i = 0; i < scene->count; i++)
        for (int k = 0; k < scene->body[i].acts; k++)
            if (scene->body[i].act[k].state >= 0) write_state(&scene->body[i].act[k], i, text);
    if (ropes) add(text, "ground:\n  points:\n");
    for (int i = 0; i < scene->count; i++) {
        const struct act_body *body = &scene->body[i];
        if (body->has_rope)
            add(text, "    P%d: [%.17g, %.17g]\n", i, body->anchor * cos(body->along),
                3 * i + body->anchor * sin(body->along));
    }
    add(text, "bodies:\n");
    for (int i = 0; i < scene->count; i++) write_body(scene, i, text);
    if (ropes) add(text, "couplings:\n");
    for (int i = 0; i < scene->count; i++) {
        const struct act_body *body = &scene->body[i];
        if (!body->has_rope) continue;
        add(text,
            "  - rope: {name: r%d, through: [ground.P%d, b%d.G], length: \"%.17g[m] + "
            "%.17g[m]*sin(%.17g[1/s]*t)\"}\n",
            i, i, i, body->length, body->haul, body->haul_w);
    }
    add(text, "simulate: {until: %.17g}\n", scene->until);
}
