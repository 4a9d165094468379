/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "decks.h"

static const double pi = 3.14159265358979323846;

double wave_at(const struct wave *wave, double t)
{
    return wave->A * sin(wave->w * t + wave->phase) + wave->B;
}

double wave_rate(const struct wave *wave, double t)
{
    return wave->A * wave->w * cos(wave->w * t + wave->phase);
}

double wave_bend(const struct wave *wave, double t)
{
    return -wave->A * wave->w * wave->w * sin(wave->w * t + wave->phase);
}

static struct wave draw_push(struct random_numbers *numbers, double size)
{
    return (struct wave){random_perhaps(numbers, 0.4, 0, size), random_between(numbers, 0.5, 12),
                         random_between(numbers, 0, 6), random_perhaps(numbers, 0.3, -size / 2, size / 2)};
}

/* A deck that is driven so is shaken by a share or a multiple of g. */
static struct wave draw_drive(struct random_numbers *numbers, double arm)
{
    double w = random_between(numbers, 3, 25), a = deck_g * random_between(numbers, 0.1, 2.5);
    return (struct wave){fmin(a / (w * w), 0.25) / arm, w, random_between(numbers, 0, 6), 0};
}

static void turn(double angle, const double *p, double *to)
{
    double c = cos(angle), s = sin(angle), x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
    to[0] = x, to[1] = y;
}

static void place(const double *frame, const double *p, double *to)
{
    turn(frame[2], p, to);
    to[0] += frame[0], to[1] += frame[1];
}

/* Mass, centre of mass and moment of inertia from the pieces. */
static void weigh(struct deck_body *body)
{
    body->m = body->I = body->G[0] = body->G[1] = 0;
    for (int k = 0; k < body->pieces; k++) {
        const struct piece *piece = &body->piece[k];
        body->m += piece->m;
        for (int a = 0; a < 2; a++) body->G[a] += piece->m * piece->at[a];
    }
    for (int a = 0; a < 2; a++) body->G[a] /= body->m;
    for (int k = 0; k < body->pieces; k++) {
        const struct piece *piece = &body->piece[k];
        double x = piece->at[0] - body->G[0], y = piece->at[1] - body->G[1];
        double own = piece->shape == deck_disc
                         ? piece->r * piece->r / 2
                         : (piece->half[0] * piece->half[0] + piece->half[1] * piece->half[1]) / 3;
        body->I += piece->m * (own + x * x + y * y);
    }
}

void deck_twist(const struct deck_scene *scene, int i, const double *p, double *twist)
{
    if (i < 0) {
        twist[0] = twist[1] = twist[2] = 0;
        return;
    }
    const struct deck_body *body = &scene->body[i];
    if (body->motion == deck_planar) {
        twist[0] = body->speed[0] - body->speed[2] * (p[1] - body->start[1]);
        twist[1] = body->speed[1] + body->speed[2] * (p[0] - body->start[0]);
        twist[2] = body->speed[2];
        return;
    }
    deck_twist(scene, body->on, p, twist);
    double rate = body->speed[0];
    if (body->motion == deck_slide) {
        twist[0] += rate * cos(body->along), twist[1] += rate * sin(body->along);
    } else {
        twist[0] -= rate * (p[1] - body->axis[1]), twist[1] += rate * (p[0] - body->axis[0]);
        twist[2] += rate;
    }
}

/* ---- joints */

static void drive(struct random_numbers *numbers, struct deck_body *body, double arm)
{
    body->driven = true;
    body->drive = draw_drive(numbers, arm);
    body->x0 = wave_at(&body->drive, 0);
    body->speed[0] = wave_rate(&body->drive, 0);
}

static void hold(struct random_numbers *numbers, const struct deck_scene *scene, struct deck_body *body,
                 double arm, bool hangs)
{
    double k = body->m * exp(random_between(numbers, hangs ? 3 : 1, 6));
    body->spring = hangs || random_chance(numbers, 0.7) ? k * arm * arm : 0;
    body->neutral = body->x0 + random_perhaps(numbers, 0.5, -0.1, 0.1);
    body->damper = random_perhaps(numbers, 0.6, 0, 3) * body->m * arm * arm;
    body->speed[0] = random_perhaps(numbers, 0.6, -1, 1);
    body->has_stops = scene->e == 0 && random_chance(numbers, 0.25);
    body->stop[0] = body->x0 - random_between(numbers, 0.005, 0.2);
    body->stop[1] = body->x0 + random_between(numbers, 0.005, 0.2);
}

static void on_slide(struct random_numbers *numbers, struct deck_scene *scene, int i, int on, bool driven)
{
    struct deck_body *body = &scene->body[i];
    bool level = random_chance(numbers, 0.4);
    body->motion = deck_slide;
    body->on = on;
    body->along = level ? 0 : random_chance(numbers, 0.4) ? pi / 2 : random_between(numbers, -pi, pi);
    if (level) body->start[2] = random_perhaps(numbers, 0.3, -0.2, 0.2);
    if (driven)
        drive(numbers, body, 1);
    else
        hold(numbers, scene, body, 1, !level);
    body->rub = driven ? 0 : random_perhaps(numbers, 0.3, 0.02, 0.4);
    memset(&body->push[2], 0, sizeof body->push[2]);
}

static void on_pivot(struct random_numbers *numbers, struct deck_scene *scene, int i, int on, bool driven)
{
    struct deck_body *body = &scene->body[i];
    body->motion = deck_pivot;
    body->on = on;
    body->point[0] = random_between(numbers, -0.4, 0.4);
    body->point[1] = random_between(numbers, -0.2, 0.1);
    place(body->start, body->point, body->axis);
    if (driven) {
        drive(numbers, body, 0.4);
        if (on < 0) body->start[2] = body->x0;
        place(body->start, body->point, body->axis);
        if (on >= 0) body->drive.B = body->start[2] - scene->body[on].start[2] - body->x0;
        if (on >= 0) body->x0 = wave_at(&body->drive, 0);
        return;
    }
    body->x0 = body->start[2] - (on < 0 ? 0 : scene->body[on].start[2]);
    hold(numbers, scene, body, 0.4, random_chance(numbers, 0.8));
    body->rub = random_perhaps(numbers, 0.3, 0, 2) * body->m;
}

static void on_rods(struct random_numbers *numbers, struct deck_scene *scene)
{
    double length = random_between(numbers, 0.3, 0.8), angle = random_between(numbers, -0.5, 0.5);
    double sign = random_chance(numbers, 0.7) ? 1 : -1, rate = random_perhaps(numbers, 0.6, -2, 2);
    struct deck_body *deck = &scene->body[0];
    scene->rods = 2;
    deck->motion = deck_planar;
    deck->speed[0] = rate * length * sign * cos(angle), deck->speed[1] = rate * length * sign * sin(angle);
    for (int j = 0; j < 2; j++) {
        struct deck_rod *rod = &scene->rod[j];
        rod->body = 0;
        rod->length = length;
        rod->point[0] = (j ? 1 : -1) * deck->piece[0].half[0] * 0.9;
        place(deck->start, rod->point, rod->end);
        rod->end[0] -= sign * length * sin(angle), rod->end[1] += sign * length * cos(angle);
    }
}

static void draw_deck(struct random_numbers *numbers, struct deck_scene *scene)
{
    struct deck_body *deck = &scene->body[0], *base = &scene->body[1];
    struct piece *plate = &deck->piece[0], *wall = &deck->piece[1];
    deck->on = -1;
    deck->pieces = random_chance(numbers, 0.35) ? 2 : 1;
    *plate = (struct piece){deck_box,
                            .half = {random_between(numbers, 0.4, 0.9), random_between(numbers, 0.02, 0.1)}};
    plate->m = exp(random_between(numbers, 0, 2));
    wall->shape = deck_box;
    wall->half[0] = random_between(numbers, 0.02, 0.05), wall->half[1] = random_between(numbers, 0.03, 0.15);
    wall->at[0] = random_chance(numbers, 0.5) ? plate->half[0] - wall->half[0] : 0;
    wall->at[1] = wall->half[1]; /* it goes down into the plate: a step would find a way below it else */
    wall->m = plate->m / 4;
    weigh(deck);
    for (int k = 0; k < 3; k++) deck->push[k] = draw_push(numbers, deck->m * (k == 2 ? 1 : 5));
    *base = (struct deck_body){.pieces = 1, .on = -1, .m = 1, .start = {0.1, -0.5}};
    base->piece[0] = (struct piece){deck_box, .half = {0.2, 0.1}, .m = exp(random_between(numbers, 0, 2))};
    weigh(base);
    deck->start[2] = random_perhaps(numbers, 0.3, -0.2, 0.2);
    scene->count = 1;
    switch ((int)random_between(numbers, 0, 8)) {
    case 0: on_slide(numbers, scene, 0, -1, true); break;
    case 1: on_pivot(numbers, scene, 0, -1, true); break;
    case 2: on_slide(numbers, scene, 0, -1, false); break;
    case 3: on_pivot(numbers, scene, 0, -1, false); break;
    case 4: on_rods(numbers, scene); break;
    case 5:
        scene->count = 2;
        on_slide(numbers, scene, 1, -1, random_chance(numbers, 0.5));
        on_slide(numbers, scene, 0, 1, random_chance(numbers, 0.3));
        break;
    case 6:
        scene->count = 2;
        on_slide(numbers, scene, 1, -1, random_chance(numbers, 0.5));
        on_pivot(numbers, scene, 0, 1, random_chance(numbers, 0.3));
        break;
    default:
        scene->count = 2;
        on_pivot(numbers, scene, 1, -1, random_chance(numbers, 0.5));
        on_pivot(numbers, scene, 0, 1, random_chance(numbers, 0.3));
        break;
    }
}

/* ---- what is on it */

static double height(const struct piece *piece)
{
    return piece->shape == deck_box ? piece->half[1] : piece->r;
}

/* How a load moves, where it lies. Where its joint rubbed as well forces at rest were not determined. One that is guided and touches would strike at once where the deck moves. */
static void guide(struct random_numbers *numbers, struct deck_scene *scene, struct deck_body *load, bool lies)
{
    double p[2] = {load->start[0], load->start[1]}, twist[3];
    int i = (int)(load - scene->body);
    double kind = random_between(numbers, 0, 1);
    if (kind < 0.7 || lies) {
        const double angle = scene->body[0].start[2], tangent[2] = {cos(angle), sin(angle)};
        double slip = random_perhaps(numbers, 0.5, -1.5, 1.5);
        deck_twist(scene, 0, p, twist);
        for (int k = 0; k < 2; k++) load->speed[k] = lies ? twist[k] + slip * tangent[k] : twist[k] / 2;
        load->speed[2] = lies ? twist[2] : random_perhaps(numbers, 0.5, -5, 5);
    } else if (kind < 0.85) {
        load->motion = deck_slide;
        load->along = random_chance(numbers, 0.5) ? pi / 2 : random_between(numbers, 0.6, 2.4);
        load->damper = random_perhaps(numbers, 0.5, 0, 3) * load->m;
        memset(&load->push[2], 0, sizeof load->push[2]);
    } else if (load->piece[0].shape != deck_point) {
        double angle = random_between(numbers, -0.6, pi + 0.6), arm = random_between(numbers, 0.1, 0.5);
        load->motion = deck_pivot;
        load->axis[0] = p[0] + arm * cos(angle), load->axis[1] = p[1] + arm * sin(angle);
        load->point[0] = load->axis[0] - p[0], load->point[1] = load->axis[1] - p[1];
        turn(-load->start[2], load->point, load->point);
        load->x0 = load->start[2];
    }
    (void)i;
}

static void touches(struct random_numbers *numbers, struct deck_scene *scene, int i, int j, double mu)
{
    scene->contact[scene->contacts++] = (struct deck_contact){i, j, random_chance(numbers, 0.85) ? mu : 0};
}

static void draw_load(struct random_numbers *numbers, struct deck_scene *scene, int which)
{
    struct deck_body *load = &scene->body[scene->count], *deck = &scene->body[0];
    const struct deck_body *under = which ? load - 1 : NULL;
    struct piece *piece = &load->piece[0];
    double shape = random_between(numbers, 0, 1), on = random_between(numbers, 0, 1);
    bool stacked = under && under->motion == deck_planar && under->piece[0].shape == deck_box && on < 0.4;
    *load = (struct deck_body){.pieces = 1, .on = -1};
    piece->shape = shape < 0.5 ? deck_box : shape < 0.85 ? deck_disc : deck_point;
    piece->m = exp(random_between(numbers, -1, 1.5));
    if (piece->shape == deck_disc) piece->r = random_between(numbers, 0.03, 0.12);
    if (piece->shape == deck_box)
        for (int k = 0; k < 2; k++) piece->half[k] = random_between(numbers, 0.03, 0.12);
    weigh(load);
    if (piece->shape == deck_point) load->I = 0;
    for (int k = 0; k < 3; k++) load->push[k] = draw_push(numbers, load->m * (k == 2 ? 0.1 : 3));
    if (piece->shape == deck_point) memset(&load->push[2], 0, sizeof load->push[2]);
    bool lies = random_chance(numbers, 0.6) && (!stacked || under->start[2] == deck->start[2]);
    double u = deck->piece[0].half[0], gap = lies ? 0 : random_between(numbers, 0.002, 0.15);
    if (!lies && piece->shape == deck_box) gap += 0.1;
    double at[2] = {which ? random_between(numbers, 0.25 * u, 0.9 * u)
                          : random_between(numbers, -0.9 * u, -0.25 * u),
                    deck->piece[0].half[1] + height(piece) + gap};
    if (stacked) {
        double from[2] = {under->start[0] - deck->start[0], under->start[1] - deck->start[1]};
        turn(-deck->start[2], from, from);
        at[0] = from[0] + random_between(numbers, -0.5, 0.5) * under->piece[0].half[0];
        at[1] = from[1] + height(&under->piece[0]) + height(piece) + gap;
        if (!lies) at[1] += 0.05;
    }
    place(deck->start, at, load->start);
    load->start[2] = piece->shape == deck_point ? 0
                     : lies                     ? deck->start[2]
                                                : random_perhaps(numbers, 0.6, -0.5, 0.5);
    guide(numbers, scene, load, lies);
    scene->count++;
}

void deck_draw(uint64_t seed, void *drawn)
{
    struct deck_scene *scene = drawn;
    struct random_numbers numbers = {1000003u * seed};
    *scene = (struct deck_scene){.until = random_between(&numbers, 0.3, 1.2),
                                 .floor = random_between(&numbers, -0.9, -0.4),
                                 .tilt = random_perhaps(&numbers, 0.3, -0.3, 0.3),
                                 .e = random_perhaps(&numbers, 0.5, 0, 0.8)};
    double mu = random_between(&numbers, 0.02, 0.8);
    bool floor = random_chance(&numbers, 0.3);
    draw_deck(&numbers, scene);
    int first = scene->count, loads = random_chance(&numbers, 0.5) ? 2 : 1;
    for (int which = 0; which < loads; which++) {
        draw_load(&numbers, scene, which);
        touches(&numbers, scene, scene->count - 1, 0, mu);
        if (floor && scene->body[scene->count - 1].motion == deck_planar)
            touches(&numbers, scene, scene->count - 1, -1, mu);
    }
    if (loads == 2) touches(&numbers, scene, first + 1, first, mu);
}
