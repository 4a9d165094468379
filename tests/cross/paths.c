/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plane curves r(p) of tracks and slots: the foot of a place on them, and their lengths.
 */
#include "absolute.h"

/* r and its first three derivatives. */
static void path_at(const struct path *path, double p, struct vec2 r[4])
{
    double c = cos(path->along), s = sin(path->along), x[4] = {p, 1, 0, 0}, y[4] = {0};
    if (path->form == path_wave) {
        double k = path->wave, sine = path->a * sin(k * p + path->b), cosine = path->a * cos(k * p + path->b);
        const double wave[4] = {sine, k * cosine, -k * k * sine, -k * k * k * cosine};
        for (int i = 0; i < 4; i++) y[i] = wave[i];
    }
    if (path->form == path_oval) {
        const double cosines[4] = {cos(p), -sin(p), -cos(p), sin(p)};
        for (int i = 0; i < 4; i++) {
            x[i] = path->a * cosines[i];
            y[i] = -path->b * cosines[(i + 1) % 4];
        }
    }
    for (int i = 0; i < 4; i++) r[i] = (struct vec2){c * x[i] - s * y[i], s * x[i] + c * y[i]};
}

/* r at p, or its derivative number `first`. */
struct place path_place(const struct path *path, struct series p, int first)
{
    struct vec2 r[4], none = {0, 0};
    path_at(path, p.u, r);
    struct vec2 third = first + 2 < 4 ? r[first + 2] : none;
    return (struct place){ser_chain(r[first].x, r[first + 1].x, third.x, p),
                          ser_chain(r[first].y, r[first + 1].y, third.y, p)};
}

static double slant(const struct path *path, struct vec2 C, double p, double *slope)
{
    struct vec2 r[4];
    path_at(path, p, r);
    double x = C.x - r[0].x, y = C.y - r[0].y;
    *slope = x * r[2].x + y * r[2].y - r[1].x * r[1].x - r[1].y * r[1].y;
    return x * r[1].x + y * r[1].y;
}

/* Of a place that is near to the curve. */
static double nearest(const struct path *path, struct vec2 C)
{
    double c = cos(path->along), s = sin(path->along), x = c * C.x + s * C.y, y = c * C.y - s * C.x, slope;
    double p = path->form == path_oval ? atan2(y / path->b, x / path->a) : x;
    for (int i = 0; i < 8; i++) {
        double off = slant(path, C, p, &slope);
        p -= off / slope;
        if (fabs(off / slope) < 1e-15) break;
    }
    return p;
}

/* (C - r(p)) . r'(p) = 0 by Newton's steps in series, each of which makes one more order right. */
struct series path_foot(const struct path *path, struct place C)
{
    struct vec2 where = {C.x.u, C.y.u};
    struct series p = ser(nearest(path, where));
    double slope;
    slant(path, where, p.u, &slope);
    for (int i = 0; i < 3; i++) {
        struct series off = place_dot(place_sub(C, path_place(path, p, 0)), path_place(path, p, 1));
        p = ser_sub(p, ser_scale(1 / slope, off));
    }
    return p;
}

struct series path_distance(const struct path *path, struct place C)
{
    struct series p = path_foot(path, C);
    struct place d = path_place(path, p, 1);
    return ser_mul(place_dot(place_left(d), place_sub(C, path_place(path, p, 0))),
                   ser_inverse(place_length(d)));
}

static double speed_at(const struct path *path, double p)
{
    struct vec2 r[4];
    path_at(path, p, r);
    return hypot(r[1].x, r[1].y);
}

/* From p = 0, by Gauss's rule of five places in 30 pieces. */
static double arc(const struct path *path, double p)
{
    enum { pieces = 30 };
    static const double places[] = {0.53846931010568309104, 0.90617984593866399280};
    static const double weights[] = {0.47862867049936646804, 0.23692688505618908751};
    double sum = 0, h = p / pieces;
    for (int i = 0; i < pieces; i++) {
        double middle = (i + 0.5) * h;
        sum += 128.0 / 225 * speed_at(path, middle);
        for (int k = 0; k < 2; k++)
            sum += weights[k] *
                   (speed_at(path, middle - places[k] * h / 2) + speed_at(path, middle + places[k] * h / 2));
    }
    return sum * h / 2;
}

struct series path_length(const struct path *path, struct series p)
{
    struct vec2 r[4];
    path_at(path, p.u, r);
    double speed = hypot(r[1].x, r[1].y);
    return ser_chain(arc(path, p.u), speed, (r[1].x * r[2].x + r[1].y * r[2].y) / speed, p);
}

struct series path_parameter(const struct path *path, struct series s)
{
    double p = 0;
    for (int i = 0; i < 12; i++) p -= (arc(path, p) - s.u) / speed_at(path, p);
    struct series at = ser(p);
    for (int i = 0; i < 3; i++)
        at = ser_sub(at, ser_scale(1 / speed_at(path, p), ser_sub(path_length(path, at), s)));
    return at;
}
