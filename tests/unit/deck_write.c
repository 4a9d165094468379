/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "decks.h"

double deck_turned(const struct deck_body *body)
{
    return body->motion == deck_slide ? body->along - body->start[2] : 0;
}

static void turn(double angle, const double *p, double *to)
{
    double c = cos(angle), s = sin(angle), x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
    to[0] = x, to[1] = y;
}

static void pair(struct written *text, const char *key, const double *p)
{
    add(text, "%s: [%.17g, %.17g]", key, p[0], p[1]);
}

static void wave(struct written *text, const struct wave *wave)
{
    add(text, "\"%.17g*sin(%.17g*t + %.17g) + %.17g\"", wave->A, wave->w, wave->phase, wave->B);
}

static void write_pieces(const struct deck_body *body, struct written *text)
{
    add(text, "    parts:\n");
    for (int k = 0; k < body->pieces; k++) {
        const struct piece *piece = &body->piece[k];
        double at[2];
        turn(-deck_turned(body), piece->at, at);
        add(text, "      p%d: {mass: %.17g, ", k, piece->m);
        pair(text, "center", at);
        if (piece->shape == deck_disc) add(text, ", shape: disc, radius: %.17g", piece->r);
        if (piece->shape == deck_box)
            add(text, ", shape: prism, a: %.17g, b: %.17g, angle: %.17g", 2 * piece->half[0],
                2 * piece->half[1], -deck_turned(body));
        add(text, "}\n");
    }
}

/* A place of the world at the start, in the frame of a body of the model. */
static void seen_from(const struct deck_scene *scene, int on, const double *p, double *to)
{
    to[0] = p[0], to[1] = p[1];
    if (on < 0) return;
    const struct deck_body *base = &scene->body[on];
    to[0] -= base->start[0], to[1] -= base->start[1];
    turn(-base->start[2] - deck_turned(base), to, to);
}

static void write_motion(const struct deck_scene *scene, const struct deck_body *body, struct written *text)
{
    double at[2];
    if (body->motion == deck_planar) {
        add(text, "    motion: %s\n    initial: {x: %.17g, y: %.17g, vx: %.17g, vy: %.17g",
            body->I > 0 ? "planar" : "particle", body->start[0], body->start[1], body->speed[0],
            body->speed[1]);
        if (body->I > 0) add(text, ", theta: %.17g, omega: %.17g", body->start[2], body->speed[2]);
        add(text, "}\n");
        return;
    }
    bool slides = body->motion == deck_slide;
    const struct deck_body *base = body->on < 0 ? NULL : &scene->body[body->on];
    add(text, "    motion:\n      %s: {", slides ? "slide" : "pivot");
    if (base) add(text, "on: b%d, ", body->on);
    if (slides) {
        double zero[2] = {body->start[0] - body->x0 * cos(body->along),
                          body->start[1] - body->x0 * sin(body->along)};
        seen_from(scene, body->on, zero, at);
        pair(text, "through", at);
        add(text, ", along: %.17g", body->along - (base ? base->start[2] + deck_turned(base) : 0));
    } else {
        seen_from(scene, body->on, body->axis, at);
        pair(text, "at", at);
        add(text, ", ");
        pair(text, "point", body->point);
    }
    /* theta of a pivot on a slide counts from its frame */
    double from = slides || !base ? 0 : deck_turned(base);
    if (body->driven) {
        add(text, ", %s: ", slides ? "x" : "theta");
        struct wave drive = body->drive;
        drive.B -= from;
        wave(text, &drive);
    }
    if (body->has_stops) add(text, ", min: %.17g, max: %.17g", body->stop[0] - from, body->stop[1] - from);
    add(text, "}\n");
    if (!body->driven)
        add(text, "    initial: {%s: %.17g, %s: %.17g}\n", slides ? "x" : "theta", body->x0 - from,
            slides ? "v" : "omega", body->speed[0]);
}

static void write_joint_loads(const struct deck_scene *scene, const struct deck_body *body,
                              struct written *text)
{
    const struct deck_body *base = body->on < 0 ? NULL : &scene->body[body->on];
    double from = body->motion == deck_slide || !base ? 0 : deck_turned(base);
    if (body->spring > 0)
        add(text, "      - spring: {stiffness: %.17g, neutral: %.17g}\n", body->spring, body->neutral - from);
    if (body->damper > 0) add(text, "      - damper: %.17g\n", body->damper);
    if (body->motion == deck_slide && body->rub > 0)
        add(text, "      - normal: {two_sided: true}\n      - friction: %.17g\n", body->rub);
    if (body->motion == deck_pivot && body->rub > 0) add(text, "      - friction: %.17g\n", body->rub);
}

static void write_body(const struct deck_scene *scene, int i, struct written *text)
{
    const struct deck_body *body = &scene->body[i];
    add(text, "  b%d:\n", i);
    if (body->I > 0)
        write_pieces(body, text);
    else
        add(text, "    mass: %.17g\n", body->m);
    write_motion(scene, body, text);
    add(text, "    forces:\n      - gravity\n      - applied: {name: push, value: [");
    wave(text, &body->push[0]);
    add(text, ", ");
    wave(text, &body->push[1]);
    add(text, "]}\n");
    if (body->motion == deck_slide) {
        write_joint_loads(scene, body, text);
        return;
    }
    if (!(body->I > 0)) return;
    add(text, "    moments:\n      - applied: {name: turn, value: ");
    wave(text, &body->push[2]);
    add(text, "}\n");
    if (body->motion == deck_pivot) write_joint_loads(scene, body, text);
}

void deck_write(const void *drawn, struct written *text)
{
    const struct deck_scene *scene = drawn;
    text->length = 0;
    add(text, "fbd: 1\ngravity: %g\nground:\n  lines:\n    floor: {through: [0, %.17g], along: %.17g}\n",
        deck_g, scene->floor, scene->tilt);
    if (scene->rods) add(text, "  points:\n");
    for (int j = 0; j < scene->rods; j++) {
        add(text, "    ");
        pair(text, j ? "P1" : "P0", scene->rod[j].end);
        add(text, "\n");
    }
    add(text, "bodies:\n");
    for (int i = 0; i < scene->count; i++) {
        write_body(scene, i, text);
        if (i || !scene->rods) continue;
        add(text, "    points: {");
        pair(text, "A0", scene->rod[0].point);
        add(text, ", ");
        pair(text, "A1", scene->rod[1].point);
        add(text, "}\n");
    }
    if (scene->rods) add(text, "couplings:\n");
    for (int j = 0; j < scene->rods; j++) add(text, "  - rod: {between: [b0.A%d, ground.P%d]}\n", j, j);
    add(text, "contacts:\n");
    for (int j = 0; j < scene->contacts; j++) {
        const struct deck_contact *contact = &scene->contact[j];
        add(text, "  - {between: [b%d, ", contact->body);
        if (contact->other < 0)
            add(text, "ground.floor]");
        else
            add(text, "b%d]", contact->other);
        add(text, ", restitution: %.17g, law: moreau", scene->e);
        if (contact->mu > 0) add(text, ", static: %.17g", contact->mu);
        add(text, "}\n");
    }
    add(text, "simulate: {until: %.17g}\n", scene->until);
}
