/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The laws of what touches, from Newton's and Euler's equations of each body, and all modes of a few touches.
 *
 * With n from body 1 to body 0, t = -k x n, w the velocity of point 0 against point 1, c'' of a gap and of a slip
 *
 *     c_n = n . (a_0 - a_1) + 2 omega_1 (k x n) . w     a corner or a middle over a side that turns
 *     c_n = n . (a_0 - a_1) + (t . w)^2 / length        points that turn about each other
 *     c_t = t . (a_0 - a_1)                             of a point that sticks, in both cases
 *
 * where a are accelerations of points of the bodies, with a disc's own spin R alpha along t.
 */
#include "piles.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const double weight = 9.81, at_rest = 1e-9, striking = 1e-7;

enum { most_points = 4, most_unknowns = 2 * most_points };

/* The row of a touch along its normal (0) or tangent (1): what it says of accelerations, J a + bias. */
struct line {
    double J[2][3]; /* of body 0 and 1 */
    double bias, speed;
};

struct touch_lines {
    struct line of[2];
};

static struct vec middle_of(const struct pile_motion *motion, int body)
{
    return body == floor_of_pile ? (struct vec){0, 0} : (struct vec){motion->q[body][0], motion->q[body][1]};
}

static struct vec velocity_of(const struct pile_motion *motion, int body, struct vec p)
{
    if (body == floor_of_pile) return (struct vec){0, 0};
    const double *v = motion->v[body];
    struct vec r = vec_sub(p, middle_of(motion, body));
    return vec_add((struct vec){v[0], v[1]}, vec_scale(v[2], vec_perp(r)));
}

static struct touch_lines lines_of(const struct pile_motion *motion, const struct pile_touch *touch)
{
    struct touch_lines lines = {0};
    struct vec n = touch->normal, t = vec_scale(-1, vec_perp(n)), way[2] = {n, t};
    struct vec w = vec_sub(velocity_of(motion, touch->body[0], touch->point[0]),
                           velocity_of(motion, touch->body[1], touch->point[1]));
    for (int k = 0; k < 2; k++) {
        struct line *line = &lines.of[k];
        for (int end = 0; end < 2; end++) {
            int body = touch->body[end];
            double sign = end == 0 ? 1 : -1;
            if (body == floor_of_pile) continue;
            struct vec G = middle_of(motion, body), arm = vec_sub(touch->at, G);
            double omega = motion->v[body][2];
            double *J = line->J[end];
            J[0] = sign * way[k].x;
            J[1] = sign * way[k].y;
            J[2] = sign * vec_cross(arm, way[k]);
            line->bias -= sign * omega * omega * vec_dot(way[k], vec_sub(touch->point[end], G));
            for (int i = 0; i < 3; i++) line->speed += J[i] * motion->v[body][i];
        }
    }
    double turning = touch->body[1] == floor_of_pile ? 0 : motion->v[touch->body[1]][2];
    if (touch->length > 0)
        lines.of[0].bias += vec_dot(t, w) * vec_dot(t, w) / touch->length;
    else
        lines.of[0].bias += 2 * turning * vec_dot(vec_perp(n), w);
    return lines;
}

static double inertia_of(const struct pile *pile, int body)
{
    double a = pile->a[body], b = pile->b[body];
    return pile->mass[body] * (pile->disc[body] ? a * a / 8 : (a * a + b * b) / 12);
}

/* a += M^-1 J^T f. */
static void push(const struct pile *pile, const struct pile_touch *touch, const struct line *line, double f,
                 double a[][3])
{
    for (int end = 0; end < 2; end++) {
        int body = touch->body[end];
        if (body == floor_of_pile) continue;
        for (int i = 0; i < 3; i++)
            a[body][i] += line->J[end][i] * f / (i < 2 ? pile->mass[body] : inertia_of(pile, body));
    }
}

static double acceleration_along(const struct pile_touch *touch, const struct line *line, const double a[][3])
{
    double c = line->bias;
    for (int end = 0; end < 2; end++)
        for (int i = 0; touch->body[end] != floor_of_pile && i < 3; i++)
            c += line->J[end][i] * a[touch->body[end]][i];
    return c;
}

static double difference(const struct pile *pile, int body, const double a[3], const double b[3])
{
    return fmax(hypot(a[0] - b[0], a[1] - b[1]), pile->a[body] * fabs(a[2] - b[2]));
}

/* ---- are these the forces? */

static double largest(double a, double b, double c)
{
    return fmax(a, fmax(b, c));
}

double pile_law_error(const struct pile *pile, const struct pile_motion *motion, const double a[][3],
                      const struct pile_touch *touches, int count, const struct pile_force *forces)
{
    double made[most_bodies][3] = {{0}}, worst = 0;
    for (int b = 0; b < pile->count; b++) made[b][1] = -weight;
    for (int i = 0; i < count; i++) {
        const struct touch_lines lines = lines_of(motion, &touches[i]);
        double N = forces[i].N, T = forces[i].T, v_t = lines.of[1].speed, slack = pile->mu * fmax(N, 0);
        double c_n = acceleration_along(&touches[i], &lines.of[0], a);
        double c_t = acceleration_along(&touches[i], &lines.of[1], a);
        push(pile, &touches[i], &lines.of[0], N, made);
        push(pile, &touches[i], &lines.of[1], T, made);
        bool leaves = lines.of[0].speed > striking, slips = fabs(v_t) > at_rest;
        worst = largest(worst, -N, fabs(T) - slack);
        if (leaves) worst = fmax(worst, fabs(N));
        if (!leaves) worst = largest(worst, -c_n, fmin(N, c_n));
        if (slips) worst = fmax(worst, fabs(T + copysign(slack, v_t)));
        if (!slips) worst = fmax(worst, fmin(fabs(c_t), fabs(T + copysign(slack, c_t))));
    }
    for (int b = 0; b < pile->count; b++) worst = fmax(worst, difference(pile, b, made[b], a[b]));
    return worst;
}

/* ---- all modes */

enum mode { opens, sticks, slips_on, slips_back, modes };

struct part {
    const struct pile *pile;
    int count; /* of touches */
    const struct pile_touch *touches[most_points];
    struct touch_lines lines[most_points];
    enum mode mode[most_points];
    bool bodies[most_bodies];
    double f[most_unknowns], a[most_bodies][3];
    bool open; /* the forces of the modes are not determined */
};

/* Elimination with pivots of whole rows, of A + damping; A is n x n in rows of most_unknowns. */
static void eliminate(int n, double A[][most_unknowns], double *x)
{
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(A[i][k]) > fabs(A[best][k])) best = i;
        for (int j = 0; j < n; j++) {
            double spare = A[k][j];
            A[k][j] = A[best][j];
            A[best][j] = spare;
        }
        double spare = x[k];
        x[k] = x[best];
        x[best] = spare;
        for (int i = k + 1; i < n; i++) {
            double share = A[i][k] / A[k][k];
            for (int j = k; j < n; j++) A[i][j] -= share * A[k][j];
            x[i] -= share * x[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++) x[k] -= A[k][j] * x[j];
        x[k] /= A[k][k];
    }
}

/* What the unit force k does along row i, both counted over the touches. */
static double answer(const struct part *part, int i, int k)
{
    double a[most_bodies][3] = {{0}};
    struct line line = part->lines[i / 2].of[i % 2];
    line.bias = 0;
    push(part->pile, part->touches[k / 2], &part->lines[k / 2].of[k % 2], 1, a);
    return acceleration_along(part->touches[i / 2], &line, (const double(*)[3])a);
}

/* The equations of the modes: A f = b. */
static void set_equations(const struct part *part, double A[][most_unknowns], double *b)
{
    double fall[most_bodies][3] = {{0}};
    for (int body = 0; body < most_bodies; body++) fall[body][1] = -weight;
    for (int i = 0; i < 2 * part->count; i++) {
        enum mode mode = part->mode[i / 2];
        bool along = i % 2 == 1, held = mode != opens && (!along || mode == sticks);
        for (int k = 0; k < 2 * part->count; k++) A[i][k] = held ? answer(part, i, k) : i == k;
        b[i] = held ? -acceleration_along(part->touches[i / 2], &part->lines[i / 2].of[i % 2],
                                          (const double(*)[3])fall)
                    : 0;
        if (along && mode >= slips_on) A[i][i - 1] = (mode == slips_on ? 1 : -1) * part->pile->mu;
    }
}

/* Forces and accelerations; false where the modes contradict themselves. */
static bool solve_modes(struct part *part)
{
    enum { corrections = 6 };
    const double damping = 1e-7, rounding = 1e-8, far = 1e3;
    double A[most_unknowns][most_unknowns] = {{0}}, b[most_unknowns], rest[most_unknowns], first = 0,
           last = 0;
    int n = 2 * part->count;
    set_equations(part, A, b);
    memset(part->f, 0, sizeof part->f);
    for (int pass = 0; pass < corrections; pass++) {
        double damped[most_unknowns][most_unknowns] = {{0}};
        for (int i = 0; i < n; i++) {
            rest[i] = b[i];
            for (int k = 0; k < n; k++) rest[i] -= A[i][k] * part->f[k];
            for (int k = 0; k < n; k++) damped[i][k] = A[i][k] + (i == k ? damping : 0);
        }
        eliminate(n, damped, rest);
        last = 0;
        for (int i = 0; i < n; i++) {
            part->f[i] += rest[i];
            last = fmax(last, fabs(rest[i]));
        }
        if (pass == 0) first = last;
    }
    memset(part->a, 0, sizeof part->a);
    for (int body = 0; body < most_bodies; body++) part->a[body][1] = -weight;
    for (int i = 0; i < n; i++)
        push(part->pile, part->touches[i / 2], &part->lines[i / 2].of[i % 2], part->f[i], part->a);
    return isfinite(first) && last <= rounding * fmax(1, first) && first < far * far;
}

/* Is a unit of forces left open by the modes? Then a little more compliance of one row changes the others. */
static bool is_singular(const struct part *part)
{
    const double nothing = 1e-9;
    double A[most_unknowns][most_unknowns], b[most_unknowns];
    int n = 2 * part->count;
    set_equations(part, A, b);
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(A[i][k]) > fabs(A[best][k])) best = i;
        if (fabs(A[best][k]) <= nothing) return true;
        for (int j = 0; j < n; j++) {
            double spare = A[k][j];
            A[k][j] = A[best][j];
            A[best][j] = spare;
        }
        for (int i = k + 1; i < n; i++)
            for (int j = n - 1; j >= k; j--) A[i][j] -= A[i][k] / A[k][k] * A[k][j];
    }
    return false;
}

/* Do accelerations, and forces where `forces`, keep to the laws of the modes? */
static bool is_lawful(const struct part *part, bool forces)
{
    const double little = 1e-7;
    for (int i = 0; i < part->count; i++) {
        const double *f = part->f + (ptrdiff_t)2 * i;
        double N = f[0], T = f[1];
        const double(*a)[3] = (const double(*)[3])part->a;
        double c_n = acceleration_along(part->touches[i], &part->lines[i].of[0], a);
        double c_t = acceleration_along(part->touches[i], &part->lines[i].of[1], a);
        bool moves = fabs(part->lines[i].of[1].speed) > at_rest;
        int way = part->mode[i] == slips_on ? 1 : -1;
        if (part->mode[i] == opens && c_n < -little) return false;
        if (part->mode[i] == opens) continue;
        if (fabs(c_n) > little || (forces && N < -little)) return false;
        if (part->mode[i] == sticks && (moves || fabs(c_t) > little)) return false;
        if (part->mode[i] == sticks && forces && fabs(T) > part->pile->mu * N + little) return false;
        if (part->mode[i] >= slips_on && (moves ? way * part->lines[i].of[1].speed < 0 : way * c_t < -little))
            return false;
    }
    return true;
}

static bool is_in(const struct part *part, int body)
{
    return body != floor_of_pile && part->bodies[body];
}

/* What hangs together with body `first`; false where that is too much, or strikes. */
static bool find_part(struct part *part, const struct pile_motion *motion, const struct pile_touch *touches,
                      int count, int first)
{
    part->bodies[first] = true;
    for (int round = 0; round < most_bodies; round++)
        for (int i = 0; i < count; i++)
            for (int end = 0; end < 2; end++)
                if (is_in(part, touches[i].body[end]) && touches[i].body[1 - end] != floor_of_pile)
                    part->bodies[touches[i].body[1 - end]] = true;
    for (int i = 0; i < count; i++) {
        if (!is_in(part, touches[i].body[0]) && !is_in(part, touches[i].body[1])) continue;
        struct touch_lines lines = lines_of(motion, &touches[i]);
        if (lines.of[0].speed < -striking) return false;
        if (lines.of[0].speed > striking) continue;
        if (part->count == most_points) return false;
        part->touches[part->count] = &touches[i];
        part->lines[part->count++] = lines;
    }
    return true;
}

static double apart_from(const struct part *part, const double a[][3])
{
    double most = 0;
    for (int b = 0; b < part->pile->count; b++)
        if (part->bodies[b]) most = fmax(most, difference(part->pile, b, part->a[b], a[b]));
    return most;
}

enum pile_verdict pile_try_modes(const struct pile *pile, const struct pile_motion *motion,
                                 const double a[][3], const struct pile_touch *touches, int count, int first,
                                 int *solutions)
{
    const double near = 1e-6;
    struct part part = {.pile = pile};
    double found[most_bodies][3];
    bool agrees = false, undecided = false;
    *solutions = 0;
    if (!find_part(&part, motion, touches, count, first) || part.count == 0) return pile_not_looked;
    int all = 1;
    for (int i = 0; i < part.count; i++) all *= modes;
    for (int number = 0; number < all; number++) {
        for (int i = 0, rest = number; i < part.count; i++, rest /= modes)
            part.mode[i] = (enum mode)(rest % modes);
        if (!solve_modes(&part) || !is_lawful(&part, false)) continue;
        bool close = apart_from(&part, a) <= near * weight;
        if (!is_lawful(&part, true)) {
            undecided |= close && is_singular(&part);
            continue;
        }
        agrees |= close;
        if (*solutions > 0 && apart_from(&part, (const double(*)[3])found) <= near * weight) continue;
        if ((*solutions)++ == 0) memcpy(found, part.a, sizeof found);
    }
    return agrees ? pile_agrees : undecided ? pile_undecided : pile_differs;
}
