/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random rows of two to six discs and blocks on a line, between walls or stops, some of which touch, under constant
 * forces, with impacts one after the other or together; against flights in closed form and impacts by sets
 * (impacts_by_sets.h). FBD_ROWS=1000 tries so many, FBD_ROWS_SEED=17 begins there, FBD_ROWS_SHOW=1 prints the models and
 * the impacts.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gallery.h"
#include "impacts_by_sets.h"
#include "moreau.h"
#include "random_numbers.h"
#include "written.h"

enum { most_bodies = 6, most_contacts = most_bodies + 1, most_impacts = 20 };

static const double g = 10;

struct body {
    double m, half, x, v, force; /* along the line */
};

/* Between two bodies, or a body and a wall that is no body: -1. */
struct contact {
    int left, right;
    double wall, e, mu;
    enum law_by_steps law;
};

struct row {
    int bodies, contacts;
    bool in_turn, planar, stops;
    double along, until;
    struct body body[most_bodies];
    struct contact contact[most_contacts];
    double gap[most_contacts]; /* at the start */
    struct written text;
};

/* ---- draws, with their models */

static struct contact draw_contact(struct random_numbers *numbers, int left, int right, enum law_by_steps law)
{
    double e = random_between(numbers, 0.05, 0.95), kind = random_between(numbers, 0, 1);
    return (struct contact){.left = left,
                            .right = right,
                            .e = kind < 0.15   ? 0
                                 : kind > 0.85 ? 1
                                               : e,
                            .mu = random_perhaps(numbers, 0.5, 0, 1),
                            .law = law};
}

/* What touches moves together, or not. */
static void draw_bodies(struct random_numbers *numbers, struct row *row)
{
    bool touches = random_chance(numbers, 0.6), pushed = random_chance(numbers, 0.4);
    double x = 0, v = random_between(numbers, -2, 2);
    for (int i = 0; i < row->bodies; i++) {
        struct body *body = &row->body[i];
        double gap = touches && random_chance(numbers, 0.6) ? 0 : random_between(numbers, 0.05, 0.6);
        if (i > 0 && (gap > 0 || random_chance(numbers, 0.2))) v = random_perhaps(numbers, 0.7, -2, 2);
        *body = (struct body){.m = random_chance(numbers, 0.3) ? 1 : exp(random_between(numbers, -1.5, 1.5)),
                              .half = random_between(numbers, 0.05, 0.3),
                              .v = v};
        body->force = pushed ? random_perhaps(numbers, 0.5, -3, 3) : 0;
        x += i == 0 ? 0 : row->body[i - 1].half + gap + body->half;
        body->x = x;
        if (i > 0) row->gap[i - 1] = gap;
    }
}

/* Behind the bodies' own contacts: at one end, or both. */
static void draw_walls(struct random_numbers *numbers, struct row *row, bool same, enum law_by_steps law)
{
    const struct body *first = &row->body[0], *last = &row->body[row->bodies - 1];
    for (int end = 0; end < 2; end++) {
        double gap = random_perhaps(numbers, 0.8, 0.05, 0.8);
        if (!random_chance(numbers, 0.6)) continue;
        enum law_by_steps own = same ? law : (enum law_by_steps)(random_bits(numbers) % 4);
        struct contact wall =
            end == 0 ? draw_contact(numbers, -1, 0, own) : draw_contact(numbers, row->bodies - 1, -1, own);
        wall.wall = end == 0 ? first->x - first->half - gap : last->x + last->half + gap;
        if (row->stops) wall.law = steps_stronge;
        row->gap[row->contacts] = gap;
        row->contact[row->contacts++] = wall;
    }
}

static void write_ground(struct row *row)
{
    const double c = cos(row->along), s = sin(row->along);
    bool any = false;
    for (int k = 0; k < row->contacts && !row->stops; k++) {
        const struct contact *wall = &row->contact[k];
        if (wall->left >= 0 && wall->right >= 0) continue;
        add(&row->text, "%s    wall_%d: {through: [%.17g, %.17g], along: %.17g}\n",
            any ? "" : "ground:\n  lines:\n", k, wall->wall * c, wall->wall * s, row->along + acos(-1) / 2);
        any = true;
    }
}

static void write_body(struct random_numbers *numbers, struct row *row, int i, double high)
{
    const double c = cos(row->along), s = sin(row->along);
    const struct body *body = &row->body[i];
    add(&row->text, "  b%d:\n    mass: %.17g\n", i, body->m);
    if (!row->planar && random_chance(numbers, 0.5))
        add(&row->text, "    shape: prism\n    a: %.17g\n    b: %.17g\n", 2 * body->half,
            high > 0 ? high : random_between(numbers, 0.1, 0.5));
    else
        add(&row->text, "    shape: disc\n    radius: %.17g\n", body->half);
    if (row->planar) {
        add(&row->text,
            "    motion: planar\n    initial: {x: %.17g, y: %.17g, vx: %.17g, vy: %.17g}\n    forces: "
            "[applied: "
            "{value: %.17g, angle: %.17g}]\n",
            body->x * c, body->x * s, body->v * c, body->v * s, body->force, row->along);
        return;
    }
    add(&row->text, "    motion: {slide: {along: %.17g", row->along);
    for (int k = 0; k < row->contacts && row->stops; k++) {
        const struct contact *wall = &row->contact[k];
        bool low = wall->left < 0 && wall->right == i, up = wall->right < 0 && wall->left == i;
        if (low || up)
            add(&row->text, ", %s: %.17g", low ? "min" : "max",
                wall->wall + (low ? body->half : -body->half));
        if ((low || up) && (row->bodies > 1 || k + 1 == row->contacts))
            add(&row->text, ", restitution: %.17g", wall->e);
    }
    add(&row->text, "}}\n    initial: {x: %.17g, v: %.17g}\n    forces: [gravity, applied: {value: %.17g}]\n",
        body->x, body->v, body->force);
}

static void write_contacts(struct row *row)
{
    static const char *const laws[] = {"stronge", "poisson", "newton", "moreau"};
    add(&row->text, "contacts:\n");
    for (int k = 0; k < row->contacts; k++) {
        const struct contact *contact = &row->contact[k];
        bool wall = contact->left < 0 || contact->right < 0;
        if (wall && row->stops) continue;
        if (wall)
            add(&row->text, "  - {between: [b%d, ground.wall_%d]", contact->left < 0 ? 0 : contact->left, k);
        else
            add(&row->text, "  - {between: [b%d, b%d]", contact->left, contact->right);
        add(&row->text, ", restitution: %.17g, static: %.17g, law: %s}\n", contact->e, contact->mu,
            laws[contact->law]);
    }
}

static void draw_row(uint64_t seed, struct row *row)
{
    struct random_numbers numbers = {seed};
    *row = (struct row){.bodies = 2 + (int)(random_bits(&numbers) % (most_bodies - 1)), .until = 2};
    row->in_turn = random_chance(&numbers, 0.5);
    row->planar = random_chance(&numbers, 0.4);
    row->stops = !row->planar && random_chance(&numbers, 0.5);
    row->along = random_perhaps(&numbers, 0.5, -1.5, 1.5);
    bool same = random_chance(&numbers, 0.5);
    enum law_by_steps law = (enum law_by_steps)(random_bits(&numbers) % 4);
    draw_bodies(&numbers, row);
    for (int i = 0; i + 1 < row->bodies; i++) {
        enum law_by_steps own = same ? law : (enum law_by_steps)(random_bits(&numbers) % 4);
        row->contact[row->contacts++] = draw_contact(&numbers, i, i + 1, own);
    }
    draw_walls(&numbers, row, same, law);
    add(&row->text, "fbd: 1\ngravity: %g\n", g);
    write_ground(row);
    add(&row->text, "bodies:\n");
    double high = random_perhaps(&numbers, 0.5, 0.1, 0.5);
    for (int i = 0; i < row->bodies; i++) {
        write_body(&numbers, row, i, high);
        if (!row->planar) row->body[i].force -= row->body[i].m * g * sin(row->along);
    }
    write_contacts(row);
}

/* ---- the same by flights and impacts */

struct flight {
    double t, x[most_bodies], v[most_bodies], a[most_bodies];
    bool closed[most_contacts];
    int impacts;
};

/* Of the right one against the left one. */
static double across(const struct contact *contact, const double *values)
{
    return (contact->right < 0 ? 0 : values[contact->right]) -
           (contact->left < 0 ? 0 : values[contact->left]);
}

static double gap_of(const struct row *row, const struct contact *contact, const double *x)
{
    double right = contact->right < 0 ? contact->wall : x[contact->right] - row->body[contact->right].half,
           left = contact->left < 0 ? contact->wall : x[contact->left] + row->body[contact->left].half;
    return right - left;
}

/* Impulses of `members`, with the velocities - or accelerations - that they change. */
static bool change(const struct row *row, int count, const int *member, bool plastic, double *v)
{
    struct points_by_sets points = {.count = count, .in_turn = row->in_turn && !plastic};
    const double none = 1e-12;
    double u[sets_rows] = {0}, P[sets_rows], size = 0;
    for (int i = 0; i < row->bodies; i++) size = fmax(size, fabs(v[i]));
    for (ptrdiff_t i = 0; i < count; i++) {
        const struct contact *a = &row->contact[member[i]];
        u[2 * i] = across(a, v);
        if (fabs(u[2 * i]) <= none * size) u[2 * i] = 0; /* the law is that of what closes fastest */
        points.e[i] = plastic ? 0 : a->e;
        points.law[i] = plastic ? steps_stronge : a->law;
        points.W[2 * i + 1][2 * i + 1] = 1;
        for (ptrdiff_t j = 0; j < count; j++) {
            const struct contact *b = &row->contact[member[j]];
            double *W = &points.W[2 * i][2 * j];
            if (a->right >= 0 && a->right == b->right) *W += 1 / row->body[a->right].m;
            if (a->left >= 0 && a->left == b->left) *W += 1 / row->body[a->left].m;
            if (a->left >= 0 && a->left == b->right) *W -= 1 / row->body[a->left].m;
            if (a->right >= 0 && a->right == b->left) *W -= 1 / row->body[a->right].m;
        }
    }
    if (!impacts_by_sets(&points, u, P)) return false;
    for (ptrdiff_t i = 0; i < count; i++) {
        const struct contact *a = &row->contact[member[i]];
        if (a->right >= 0) v[a->right] += P[2 * i] / row->body[a->right].m;
        if (a->left >= 0) v[a->left] -= P[2 * i] / row->body[a->left].m;
    }
    return true;
}

/* What is closed stays so where it is pressed. */
static bool set_accelerations(const struct row *row, struct flight *flight)
{
    int member[most_contacts], count = 0;
    for (int i = 0; i < row->bodies; i++) flight->a[i] = row->body[i].force / row->body[i].m;
    for (int k = 0; k < row->contacts; k++)
        if (flight->closed[k]) member[count++] = k;
    if (!change(row, count, member, true, flight->a)) return false;
    for (int k = 0; k < row->contacts; k++)
        if (fabs(across(&row->contact[k], flight->a)) > 1e-9) flight->closed[k] = false;
    return true;
}

static void fly(const struct row *row, struct flight *flight, double time)
{
    for (int i = 0; i < row->bodies; i++) {
        flight->x[i] += time * (flight->v[i] + flight->a[i] * time / 2);
        flight->v[i] += flight->a[i] * time;
    }
    flight->t += time;
}

/* Until the first gap closes. */
static double time_to_impact(const struct row *row, const struct flight *flight)
{
    double first = HUGE_VAL;
    for (int k = 0; k < row->contacts; k++) {
        const struct contact *contact = &row->contact[k];
        double gap = fmax(gap_of(row, contact, flight->x), 0), v = across(contact, flight->v),
               a = across(contact, flight->a), root = v * v - 2 * a * gap;
        if (flight->closed[k] || root < 0 || (v >= 0 && a >= 0)) continue;
        double time = v < 0 ? 2 * gap / (sqrt(root) - v) : (v + sqrt(root)) / -a;
        first = fmin(first, time);
    }
    return first;
}

/* All that touches, with the lowest speed at which what comes back leaves. False where it is not known what that is, or
 * what comes out. */
static bool strike(const struct row *row, struct flight *flight, double *lowest)
{
    const double near = 1e-12, far = 1e-8;
    int member[most_contacts], count = 0;
    double speed = 0;
    for (int k = 0; k < row->contacts; k++) {
        double gap = gap_of(row, &row->contact[k], flight->x);
        if (flight->closed[k] || gap <= near)
            member[count++] = k;
        else if (gap < far)
            return false;
        speed = fmax(speed, fabs(across(&row->contact[k], flight->v)));
    }
    if (getenv("FBD_ROWS_SHOW")) {
        printf("# t = %.12g:", flight->t);
        for (int i = 0; i < count; i++)
            printf(" %d at %.9g", member[i], across(&row->contact[member[i]], flight->v));
    }
    if (!change(row, count, member, false, flight->v)) return false;
    for (int i = 0; i < count; i++)
        flight->closed[member[i]] = fabs(across(&row->contact[member[i]], flight->v)) <= 1e-9 * speed;
    if (getenv("FBD_ROWS_SHOW")) {
        for (int i = 0; i < count; i++) printf(", after %.9g", across(&row->contact[member[i]], flight->v));
        puts("");
    }
    if (!set_accelerations(row, flight)) return false;
    flight->impacts++;
    *lowest = HUGE_VAL;
    for (int i = 0; i < count; i++) {
        const struct contact *contact = &row->contact[member[i]];
        bool returns = !flight->closed[member[i]] && across(contact, flight->a) < 0;
        if (returns) *lowest = fmin(*lowest, across(contact, flight->v));
    }
    return true;
}

/* At rest or in flight at the start, with the impact of what touches and closes. */
static bool begin(const struct row *row, struct flight *flight, double *lowest)
{
    bool closes = false;
    *flight = (struct flight){.t = 0};
    *lowest = HUGE_VAL;
    for (int i = 0; i < row->bodies; i++) flight->x[i] = row->body[i].x, flight->v[i] = row->body[i].v;
    for (int k = 0; k < row->contacts; k++) {
        double v = across(&row->contact[k], flight->v);
        flight->closed[k] = row->gap[k] == 0 && v == 0;
        closes |= row->gap[k] == 0 && v < 0;
    }
    return set_accelerations(row, flight) && (!closes || strike(row, flight, lowest));
}

/* Until then, or to where bounces get too low to be told from rest: half the way to the next one, or from the one
 * before. */
static bool fly_through(const struct row *row, struct flight *flight)
{
    const double soon = 1e-6, low = 1e-2, none = 1e-3;
    struct flight before = {0}; /* the impact before the last one, and the time between them */
    double lowest, last = 0;
    if (!begin(row, flight, &lowest)) return false;
    for (;;) {
        double time = time_to_impact(row, flight);
        if (time < soon && flight->impacts > 0 && last > 0) break;
        bool ends = lowest < low || time < soon || flight->impacts >= most_impacts;
        if (ends || flight->t + time >= row->until) {
            fly(row, flight, fmin(ends ? time / 2 : HUGE_VAL, row->until - flight->t));
            return lowest >= none;
        }
        before = *flight;
        last = time;
        fly(row, flight, time);
        if (!strike(row, flight, &lowest)) return false;
        if (lowest < none) break;
    }
    *flight = before;
    fly(row, flight, last / 2);
    return true;
}

static double apart(int count, const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < count; i++)
        if (!(fabs(a[i] - b[i]) <= most)) most = fabs(a[i] - b[i]);
    return most;
}

/* ---- both */

/* Along the line and, of a planar body, across it. */
static void read_body(const struct row *row, const struct trial *trial, int i, double *x, double *v)
{
    static const char *const names[2][4] = {{"x", "v", "x", "v"}, {"x", "vx", "y", "vy"}};
    double value[4], c = cos(row->along), s = sin(row->along);
    for (int k = 0; k < 4; k++) {
        char name[20];
        snprintf(name, sizeof name, "b%d.%s", i, names[row->planar][k]);
        value[k] = trial_get(trial, name);
    }
    *x = row->planar ? c * value[0] + s * value[2] : value[0];
    *v = row->planar ? c * value[1] + s * value[3] : value[1];
}

static bool run_row(const struct row *row, double *x, double *v)
{
    struct trial trial = trial_parse(row->text.all);
    trial_run(&trial, NULL);
    bool done = trial.outcome == FBD_DONE;
    if (!done) printf("# %s\n", fbd_simulation_reason(trial.simulation));
    for (int i = 0; i < row->bodies; i++) read_body(row, &trial, i, &x[i], &v[i]);
    for (size_t k = 0; getenv("FBD_ROWS_SHOW") && k < fbd_simulation_event_count(trial.simulation); k++) {
        fbd_event event = fbd_simulation_event(trial.simulation, k);
        printf("# run: t = %.12g: %s\n", event.t, event.detail);
    }
    trial_close(&trial);
    return done;
}

/* What was apart is so by 1e-9 more or less. */
static double sensitivity(const struct row *row, const struct flight *flight)
{
    const double moved = 1e-9;
    static struct row other;
    double worst = 0;
    for (int way = -1; way <= 1; way += 2) {
        struct flight beside;
        double by = 0;
        other = *row;
        other.until = flight->t;
        for (int i = 0; i < row->bodies; i++) {
            if (i > 0 && row->gap[i - 1] > 0) by += way * moved * (i % 2 ? 1 : 0.4);
            other.body[i].x += by;
        }
        for (int k = row->bodies - 1; k < row->contacts; k++) {
            const struct contact *wall = &row->contact[k];
            int i = wall->left < 0 ? wall->right : wall->left;
            other.contact[k].wall += other.body[i].x - row->body[i].x;
        }
        if (!fly_through(&other, &beside)) return HUGE_VAL;
        fly(&other, &beside, flight->t - beside.t);
        worst = fmax(worst,
                     fmax(apart(row->bodies, flight->x, beside.x), apart(row->bodies, flight->v, beside.v)));
    }
    return worst;
}

static bool agrees(uint64_t seed, bool *sensitive)
{
    const double most = 1e-5, least = 1e-7;
    static struct row row;
    struct flight flight = {0};
    double x[most_bodies] = {0}, v[most_bodies] = {0};
    draw_row(seed, &row);
    bool known = fly_through(&row, &flight) && flight.t > 0;
    add(&row.text, "simulate: {until: %.17g, tolerance: 1e-11, impacts: %s}\n", flight.t,
        row.in_turn ? "propagate" : "simultaneous");
    if (getenv("FBD_ROWS_SHOW")) puts(row.text.all);
    double error = known ? sensitivity(&row, &flight) : HUGE_VAL;
    *sensitive = !(error <= most);
    if (*sensitive) return true;
    bool done = run_row(&row, x, v);
    double difference = fmax(apart(row.bodies, x, flight.x), apart(row.bodies, v, flight.v));
    if (done && difference <= fmax(least, 3 * error)) return true;
    printf("# seed %llu: %g apart after %d impacts, where a start beside is off by %g\n%s\n",
           (unsigned long long)seed, difference, flight.impacts, error, row.text.all);
    for (int i = 0; i < row.bodies; i++)
        printf("# b%d: %.10g at %.10g, by flights %.10g at %.10g\n", i, x[i], v[i], flight.x[i], flight.v[i]);
    return false;
}

static void flights_and_impacts_say_the_same(void **unused)
{
    (void)unused;
    moreau_compare("FBD_ROWS", 37, 10, agrees);
}

/* Rows that once went wrong. What an impact brings to rest on others does not press there in 1084, 1468 and 5139: it closed
 * or parted by what rounding had left of its speed. In 21148 all comes to rest with that. In 8958 and 7080 a slow bounce that
 * does not come back soon was taken for the end of a series; in 13194 a row is jammed between two walls, by impacts one after
 * the other. */
static void rows_that_rest_or_hardly_part(void **unused)
{
    static const uint64_t seeds[] = {1084, 1468, 5139, 7080, 8958, 13194, 21148};
    (void)unused;
    for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
        bool sensitive;
        assert_true(agrees(seeds[i], &sensitive));
        assert_false(sensitive);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flights_and_impacts_say_the_same),
        cmocka_unit_test(rows_that_rest_or_hardly_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
