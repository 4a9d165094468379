/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random blocks on springs, each on a belt of its own or on the ground: every event and the end against pieces of closed form.
 *
 *     sticks   x = x_1 + v_b t; what holds it is H = k (x - l) + c v_b + m g sin(phi), up to mu_s N, N = m g cos(phi)
 *     slips    m x'' = -k (x - l) - c x' - m g sin(phi) - side mu_k N, from x_1 with v_1: with X = x - x_m about its middle,
 *              X = e^(-d t) (X_1 cos(w t) + (v_1 + d X_1)/w sin(w t)), d = c/2m, w^2 = k/m - d^2
 *
 * A slip ends where x' = v_b first, which is looked for on a grid of w t = 1/100 and then halved; then it sticks where
 * |H| <= mu_s N, else it slips back. Draws in which a slip almost ends, or a force almost breaks what holds, are left out.
 * Several methods; with user events beside, which change nothing. FBD_DRAWS: times as many scenes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "random_numbers.h"
#include "scenes.h"
#include "thorough.h"

enum { text_size = 4000, most_blocks = 3, most_events = 200 };

static const double g = 9.81;

struct block {
    double m, k, c, l, phi, mu_s, mu_k, v_b, x, v;
};

struct event {
    double t;
    fbd_event_kind kind;
};

/* What a block does, by the formulas. */
struct history {
    size_t count;
    struct event events[most_events];
    double x, v;
    bool close; /* it could be told otherwise by little */
};

static double drawn(struct random_numbers *random, double from, double to)
{
    return round(random_between(random, from, to) * 1000) / 1000;
}

static struct block draw_block(struct random_numbers *random)
{
    struct block b = {.m = drawn(random, 0.5, 3), .k = drawn(random, 20, 200), .l = drawn(random, -0.1, 0.1)};
    b.c = random_chance(random, 0.3) ? drawn(random, 0, 0.2) * sqrt(b.k * b.m) : 0;
    b.phi = random_chance(random, 0.3) ? drawn(random, -0.3, 0.3) : 0;
    b.mu_k = drawn(random, 0.1, 0.4);
    b.mu_s = b.mu_k + (random_chance(random, 0.8) ? drawn(random, 0.02, 0.3) : 0);
    b.v_b = random_chance(random, 0.8) ? drawn(random, -0.6, 0.6) : 0;
    b.x = drawn(random, -0.3, 0.3);
    b.v = random_chance(random, 0.3) ? b.v_b : drawn(random, -1, 1);
    return b;
}

/* ---- by formulas */

/* A slip to a side from (x, v). */
struct slip {
    double d, w, middle, X, Y;
};

static struct slip slip_from(const struct block *b, int side, double x, double v)
{
    double d = b->c / (2 * b->m), w = sqrt(b->k / b->m - d * d);
    double middle = b->l - (b->m * g * sin(b->phi) + side * b->mu_k * b->m * g * cos(b->phi)) / b->k;
    return (struct slip){d, w, middle, x - middle, (v + d * (x - middle)) / w};
}

static double slip_at(const struct slip *s, double t, double *v)
{
    double e = exp(-s->d * t), C = cos(s->w * t), S = sin(s->w * t);
    *v = e * (-s->d * (s->X * C + s->Y * S) + s->w * (s->Y * C - s->X * S));
    return s->middle + e * (s->X * C + s->Y * S);
}

static double speed_to_side(const struct block *b, const struct slip *s, int side, double t)
{
    double v;
    slip_at(s, t, &v);
    return side * (v - b->v_b);
}

/* How long it slips, `most` at most. */
static double slip_time(const struct block *b, const struct slip *s, int side, double most, bool *close)
{
    const double near = 1e-5;
    double step = 0.01 / s->w, low = 0, high = step;
    while (high < most && speed_to_side(b, s, side, high) > 0) {
        double before = speed_to_side(b, s, side, low), now = speed_to_side(b, s, side, high);
        double after = speed_to_side(b, s, side, high + step);
        *close |= now < near && after > now && before > now;
        low = high;
        high += step;
    }
    high = fmin(high, most);
    if (speed_to_side(b, s, side, high) > 0) return most;
    for (int i = 0; i < 100; i++) {
        double half = low + (high - low) / 2;
        *(speed_to_side(b, s, side, half) > 0 ? &low : &high) = half;
    }
    return high;
}

/* The side to which it slips from rest on its belt; 0 while it sticks. */
static int side_at(const struct block *b, double x, double *hold, double *limit)
{
    *hold = b->k * (x - b->l) + b->c * b->v_b + b->m * g * sin(b->phi);
    *limit = b->mu_s * b->m * g * cos(b->phi);
    return fabs(*hold) <= *limit ? 0 : *hold > 0 ? -1 : 1;
}

static void note(struct history *h, double t, fbd_event_kind kind)
{
    if (h->count < most_events) h->events[h->count++] = (struct event){t, kind};
}

static double stick_time(const struct block *b, double hold, double limit, double most)
{
    if (b->v_b == 0) return most;
    double left = b->v_b > 0 ? limit - hold : limit + hold;
    return fmin(most, left / (b->k * fabs(b->v_b)));
}

static struct history follow(const struct block *b, double until)
{
    const double near = 1e-6;
    struct history h = {.x = b->x, .v = b->v};
    double t = 0, hold, limit;
    int rests = side_at(b, b->x, &hold, &limit), side = b->v > b->v_b ? 1 : b->v < b->v_b ? -1 : rests;
    if (b->v == b->v_b) h.close = fabs(fabs(hold) - limit) < near;
    while (t < until && h.count < most_events && !h.close) {
        if (side == 0) {
            side_at(b, h.x, &hold, &limit);
            double time = stick_time(b, hold, limit, until - t);
            t += time;
            h.x += b->v_b * time;
            h.v = b->v_b;
            if (t >= until) break;
            side = b->v_b > 0 ? -1 : 1;
            note(&h, t, FBD_EVENT_BREAKAWAY);
        }
        struct slip slip = slip_from(b, side, h.x, h.v);
        double time = slip_time(b, &slip, side, until - t, &h.close);
        h.x = slip_at(&slip, time, &h.v);
        t += time;
        if (t >= until) break;
        h.v = b->v_b;
        int next = side_at(b, h.x, &hold, &limit);
        h.close |= fabs(fabs(hold) - limit) < near || (next == side);
        note(&h, t, next == 0 ? FBD_EVENT_STICK : FBD_EVENT_REVERSAL);
        side = next;
        h.close |= until - t < near;
    }
    h.close |= h.count == most_events;
    return h;
}

/* ---- by a run */

static size_t write_block(const struct block *b, size_t i, char *text, size_t room)
{
    return (size_t)snprintf(text, room,
                            "  b%zu: {mass: %.17g, motion: {slide: {along: %.17g rad}}, initial: {x: %.17g, "
                            "v: %.17g}, forces: [gravity, "
                            "normal,\n"
                            "    friction: {static: %.17g, kinetic: %.17g, surface_speed: %.17g}, spring: "
                            "{stiffness: %.17g, free_length: "
                            "%.17g}, damper: {coefficient: %.17g}]}\n",
                            i, b->m, b->phi, b->x, b->v, b->mu_s, b->mu_k, b->v_b, b->k, b->l, b->c);
}

static void write_scene(const struct block *blocks, size_t count, double until, bool told, char *text)
{
    size_t length = (size_t)snprintf(text, text_size, "fbd: 1\nbodies:\n");
    for (size_t i = 0; i < count; i++)
        length += write_block(&blocks[i], i, text + length, text_size - length);
    snprintf(text + length, text_size - length, "simulate: {until: %.17g%s}\n", until,
             told ? ", events: [{name: e, when: \"b0.v - 0.01[m/s]\"}]" : "");
}

/* The event of a block that is told next, user events left out. */
static bool next_of(fbd_simulation *simulation, size_t block, size_t *next, fbd_event *event)
{
    while (*next < fbd_simulation_event_count(simulation)) {
        *event = fbd_simulation_event(simulation, (*next)++);
        if (event->kind != FBD_EVENT_USER && strtoul(event->body + 1, NULL, 10) == block) return true;
    }
    *event = (fbd_event){.t = (double)NAN};
    return false;
}

static bool agrees(fbd_simulation *simulation, const fbd_state *state, size_t i, const struct history *h,
                   double tolerance)
{
    size_t next = 0;
    fbd_event event;
    for (size_t k = 0; k < h->count; k++) {
        bool told = next_of(simulation, i, &next, &event);
        if (told && event.kind == h->events[k].kind && fabs(event.t - h->events[k].t) <= tolerance) continue;
        print_error("event %zu of b%zu: kind %d at %.17g, should be %d at %.17g\n", k, i, (int)event.kind,
                    event.t, (int)h->events[k].kind, h->events[k].t);
        return false;
    }
    char name[20];
    double x, v;
    snprintf(name, sizeof name, "b%zu.x", i);
    fbd_state_get(state, name, &x);
    snprintf(name, sizeof name, "b%zu.v", i);
    fbd_state_get(state, name, &v);
    bool same = !next_of(simulation, i, &next, &event) && fabs(x - h->x) <= tolerance &&
                fabs(v - h->v) <= 20 * tolerance;
    if (!same)
        print_error("b%zu ends at %.17g with %.17g, should be %.17g with %.17g\n", i, x, v, h->x, h->v);
    return same;
}

/* By default the motion of a piece is exact, and the clock of thirty events is off by roundings over falls of forces and speeds; by
 * another method by what its tolerance of 1e-11 makes of them. */
static bool runs_as_it_should(const struct block *blocks, size_t count, const struct history *h, double until,
                              const char *method, bool told)
{
    char text[text_size];
    write_scene(blocks, count, until, told, text);
    fbd_model *model = model_from(text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = method;
    if (method) options.tolerance = 1e-11;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    fbd_outcome outcome = FBD_GOING;
    while (outcome == FBD_GOING) outcome = fbd_simulation_advance(simulation);
    fbd_state *state = fbd_state_new(model);
    fbd_simulation_state(simulation, until, state);
    bool right = outcome == FBD_DONE;
    for (size_t i = 0; right && i < count; i++)
        right = agrees(simulation, state, i, &h[i], method ? 1e-6 : 1e-9);
    if (!right) print_error("by %s: outcome %d\n%s", method ? method : "default", (int)outcome, text);
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return right;
}

static void every_stick_and_slip_is_that_of_the_formulas(void **unused)
{
    (void)unused;
    static const char *const methods[] = {"dop853", "rk8pd", "rodas5p", "msadams"};
    const double until = 6;
    int count = draws_of(300), wrong = 0, tried = 0;
    struct random_numbers random = {20261127};
    for (int i = 0; i < count; i++) {
        struct block blocks[most_blocks];
        struct history histories[most_blocks];
        size_t blocks_count = 1 + random_bits(&random) % most_blocks;
        bool close = false;
        for (size_t k = 0; k < blocks_count; k++) {
            blocks[k] = draw_block(&random);
            histories[k] = follow(&blocks[k], until);
            close |= histories[k].close;
        }
        bool told = random_chance(&random, 0.3);
        if (close) continue;
        tried++;
        wrong += !runs_as_it_should(blocks, blocks_count, histories, until, NULL, told);
        if (i % 4 == 0)
            wrong += !runs_as_it_should(blocks, blocks_count, histories, until, methods[i / 4 % 4], told);
    }
    assert_int_equal(wrong, 0);
    assert_true(2 * tried > count); /* most of them are no close calls */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_stick_and_slip_is_that_of_the_formulas)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
