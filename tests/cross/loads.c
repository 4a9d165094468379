/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces that are no unknowns, each as the language defines it: a force at a point, or a couple, on a body;
 * and what acts within a joint once more, opposite, on the body that it moves on.
 */
#include <stdio.h>
#include <string.h>

#include "absolute.h"

struct target {
    struct absolute *absolute;
    double *f;
    bool list;
};

/* The wrench of that name on a body; where there is none yet, of zero. */
struct wrench *wrench_of(struct absolute *absolute, int body, const char *name)
{
    for (int i = 0; i < absolute->wrench_count; i++)
        if (absolute->wrench[i].body == body && strcmp(absolute->wrench[i].name, name) == 0)
            return &absolute->wrench[i];
    struct wrench *wrench = &absolute->wrench[absolute->wrench_count];
    if (absolute->wrench_count + 1 < most_wrenches) absolute->wrench_count++;
    *wrench = (struct wrench){.body = body, .unique = true};
    snprintf(wrench->name, sizeof wrench->name, "%s", name);
    return wrench;
}

/* A force at a place in the world, and a couple. */
static void put(const struct target *target, int b, const char *name, struct vec2 force, struct vec2 at,
                double couple)
{
    const double *x = &target->absolute->x[3 * b];
    double w[3] = {force.x, force.y, couple + (at.x - x[0]) * force.y - (at.y - x[1]) * force.x};
    for (int i = 0; i < 3; i++) target->f[3 * b + i] += w[i];
    double size = fmax(hypot(w[0], w[1]), fabs(w[2]));
    target->absolute->force_size = fmax(target->absolute->force_size, size);
    if (!target->list) return;
    struct wrench *wrench = wrench_of(target->absolute, b, name);
    for (int i = 0; i < 3; i++) wrench->w[i] += w[i];
}

/* The same within the joint of b: the opposite, at the same place, on the body that it moves on. */
static void put_in_joint(const struct target *target, int b, const char *name, struct vec2 force,
                         struct vec2 at, double couple)
{
    const struct scene *scene = target->absolute->scene;
    char other[wrench_name_room];
    put(target, b, name, force, at, couple);
    if (scene->body[b].on < 0) return;
    snprintf(other, sizeof other, "%s.%s", scene->body[b].name, name);
    put(target, scene->body[b].on, other, (struct vec2){-force.x, -force.y}, at, -couple);
}

static struct vec2 here(struct place place)
{
    return (struct vec2){place.x.u, place.y.u};
}

static struct vec2 times(double k, struct vec2 a)
{
    return (struct vec2){k * a.x, k * a.y};
}

static struct vec2 sum(struct vec2 a, struct vec2 b)
{
    return (struct vec2){a.x + b.x, a.y + b.y};
}

/* Spring and damper between two places: -(k (length - free) + c d(length)/dt) along the line. */
static struct vec2 link_force(struct place one, struct place two, double k, double free, double c)
{
    struct series length = place_length(place_sub(one, two));
    double pull = k * (length.u - free) + c * length.u1;
    return times(-pull / length.u, here(place_sub(one, two)));
}

/* Where an applied force acts: a point of its body, or beside that. */
static struct vec2 place_of_load(const struct absolute *absolute, int b, const struct load *load)
{
    struct vec2 P = here(point_of(absolute, b, spot_of(&absolute->scene->body[b], &load->at)));
    if (!load->placed) return P;
    return sum(P, (struct vec2){formula_value(absolute, &load->offset[0]),
                                formula_value(absolute, &load->offset[1])});
}

static struct vec2 pull_of_load(const struct absolute *absolute, int b, const struct load *load)
{
    struct vec2 end = load->target < 0 ? load->to : spot_of(&absolute->scene->body[load->target], &load->end);
    return sum(here(point_of(absolute, load->target, end)), times(-1, place_of_load(absolute, b, load)));
}

double shortest_pull(const struct absolute *absolute)
{
    double shortest = INFINITY;
    const struct scene *scene = absolute->scene;
    for (int b = 0; b < scene->body_count; b++)
        for (int i = 0; i < scene->body[b].load_count; i++) {
            const struct load *load = &scene->body[b].load[i];
            if (load->kind != applied || load->form != toward_point) continue;
            struct vec2 way = pull_of_load(absolute, b, load);
            shortest = fmin(shortest, hypot(way.x, way.y));
        }
    return shortest;
}

/* And what the body that it points to feels. */
static void put_pull(const struct target *target, int b, const struct load *load)
{
    const struct absolute *absolute = target->absolute;
    const struct scene *scene = absolute->scene;
    struct vec2 way = pull_of_load(absolute, b, load);
    double distance = hypot(way.x, way.y), size = formula_value(absolute, &load->value);
    for (int i = 0; i < load->power; i++) size *= load->reach / distance;
    struct vec2 f = times(size / distance, way);
    put(target, b, load->name, f, place_of_load(absolute, b, load), 0);
    if (load->target < 0) return;
    char other[wrench_name_room];
    snprintf(other, sizeof other, "%s.%s", scene->body[b].name, load->name);
    struct vec2 end = here(point_of(absolute, load->target, spot_of(&scene->body[load->target], &load->end)));
    put(target, load->target, other, times(-1, f), end, 0);
}

static struct vec2 applied_force(const struct target *target, int b, const struct load *load)
{
    const struct absolute *absolute = target->absolute;
    double first = formula_value(absolute, &load->value), second = 0;
    if (load->form != along_slide) second = formula_value(absolute, &load->second);
    int frame = load->follows || load->form == along_slide ? b : -1;
    if (load->form == along_slide && absolute->scene->body[b].motion == track)
        return times(first, here(tangent_of(absolute, b)));
    if (load->form == components) {
        struct place e = direction_of(absolute, frame, 0);
        return sum(times(first, here(e)), times(second, here(place_left(e))));
    }
    return times(first, here(direction_of(absolute, frame, second)));
}

/* -dV/dq along each coordinate of the joint. */
static void put_potential(const struct target *target, int b, const struct load *load)
{
    const struct absolute *absolute = target->absolute;
    const struct body *body = &absolute->scene->body[b];
    struct vec2 G = here(point_of(absolute, b, absolute->mass[b].G));
    struct vec2 O = here(point_of(absolute, b, (struct vec2){0, 0}));
    double slope[3] = {0};
    for (int i = 0; i < coordinate_count(body->motion); i++)
        slope[i] = -formula_series(absolute, &load->value, b, i).u1;
    if (body->motion == slide) {
        struct place e = direction_of(absolute, body->on, body->along);
        put_in_joint(target, b, load->name, times(slope[0], here(e)), G, 0);
    } else if (body->motion == track) {
        struct vec2 P = here(point_of(absolute, b, spot_of(body, &body->point)));
        put_in_joint(target, b, load->name, times(slope[0], here(tangent_of(absolute, b))), P, 0);
    } else if (body->motion == pivot) {
        put_in_joint(target, b, load->name, (struct vec2){0, 0}, O, slope[0]);
    } else {
        struct place e = direction_of(absolute, body->on, 0);
        struct vec2 force = sum(times(slope[0], here(e)), times(slope[1], here(place_left(e))));
        put_in_joint(target, b, load->name, force, O, slope[2]);
    }
}

static void put_spring(const struct target *target, int b, const struct load *load)
{
    const struct absolute *absolute = target->absolute;
    const struct body *body = &absolute->scene->body[b];
    struct place P = point_of(absolute, b, spot_of(body, &load->at));
    if (load->to_ground) {
        struct vec2 f = link_force(P, point_of(absolute, -1, load->to), load->stiffness, load->neutral,
                                   load->coefficient);
        put(target, b, load->name, f, here(P), 0);
        return;
    }
    struct series x = coordinate_of(absolute, b, 0);
    double f = -load->stiffness * (x.u - load->neutral) - load->coefficient * x.u1;
    struct place e = direction_of(absolute, body->on, body->along);
    put_in_joint(target, b, load->name, times(f, here(e)), here(P), 0);
}

static void put_drag(const struct target *target, int b, const struct load *load)
{
    const struct absolute *absolute = target->absolute;
    struct place P = point_of(absolute, b, spot_of(&absolute->scene->body[b], &load->at));
    struct vec2 u = {P.x.u1, P.y.u1}; /* through the air */
    if (load->windy) u.x -= formula_value(absolute, &load->wind[0]);
    if (load->windy) u.y -= formula_value(absolute, &load->wind[1]);
    put(target, b, load->name, times(-(load->coefficient + load->quadratic * hypot(u.x, u.y)), u), here(P),
        0);
}

/* What acts at each place, by Gauss's rule of three places: exact for what is cubic in s with its moments. */
static void put_distributed(const struct target *target, int b, const struct load *load)
{
    static const double places[] = {-0.77459666924148337704, 0, 0.77459666924148337704};
    static const double weights[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    const struct absolute *absolute = target->absolute;
    const struct body *body = &absolute->scene->body[b];
    struct vec2 from = spot_of(body, &load->at), to = spot_of(body, &load->end), f = {0, 0};
    double length = hypot(to.x - from.x, to.y - from.y), factor = formula_value(absolute, &load->value);
    double angle = load->form == along_slide ? 0 : formula_value(absolute, &load->second);
    int frame = load->follows || load->form == along_slide ? b : -1;
    struct vec2 e = here(direction_of(absolute, frame, angle));
    for (int i = 0; i < 3; i++) {
        double share = (1 + places[i]) / 2, s = share * length, *w = (double *)load->per_length;
        double size = load->curved ? w[0] + w[1] * s * s : w[0] + (w[1] - w[0]) * share;
        f = times(weights[i] * length / 2 * size * factor, e);
        struct vec2 p = {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
        put(target, b, load->name, f, here(point_of(absolute, b, p)), 0);
    }
}

/* Of mass that leaves against its direction, or that has a velocity of its own in the world: dm/dt u. */
static void put_thrust(const struct target *target, int b, const struct load *load)
{
    const struct absolute *absolute = target->absolute;
    const struct body *body = &absolute->scene->body[b];
    double gained = formula_rate(absolute, &body->mass), first = formula_value(absolute, &load->value);
    struct place P = point_of(absolute, b, spot_of(body, &load->at));
    struct vec2 u;
    if (load->enters && load->form == along_slide) {
        struct place e =
            body->motion == track ? tangent_of(absolute, b) : direction_of(absolute, body->on, body->along);
        u = times(first - coordinate_of(absolute, b, 0).u1, here(e));
    } else if (load->enters) {
        u = (struct vec2){first - P.x.u1, formula_value(absolute, &load->second) - P.y.u1};
    } else {
        u = times(-1, applied_force(target, b, load));
    }
    put(target, b, load->name, times(gained, u), here(P), 0);
}

static void put_load(const struct target *target, int b, const struct load *load)
{
    const struct absolute *absolute = target->absolute;
    const struct scene *scene = absolute->scene;
    const struct body *body = &scene->body[b];
    struct vec2 none = {0, 0}, G = here(point_of(absolute, b, absolute->mass[b].G));
    struct series angle = coordinate_of(absolute, b, body->motion == pivot ? 0 : 2);
    switch (load->kind) {
    case gravity: put(target, b, load->name, times(absolute->mass[b].m, scene->gravity), G, 0); break;
    case applied: {
        if (load->form == toward_point)
            put_pull(target, b, load);
        else
            put(target, b, load->name, applied_force(target, b, load), place_of_load(absolute, b, load), 0);
        break;
    }
    case spring:
    case damper: put_spring(target, b, load); break;
    case drag: put_drag(target, b, load); break;
    case distributed: put_distributed(target, b, load); break;
    case thrust: put_thrust(target, b, load); break;
    case potential:
    case moment_potential: put_potential(target, b, load); break;
    case moment_applied: put(target, b, load->name, none, G, formula_value(absolute, &load->value)); break;
    case moment_spring:
        put_in_joint(target, b, load->name, none, G, -load->stiffness * (angle.u - load->neutral));
        break;
    case moment_damper: put_in_joint(target, b, load->name, none, G, -load->coefficient * angle.u1); break;
    case normal:
    case friction:
    case moment_friction: break; /* unknowns: solve.c */
    }
}

/* A belt pulls its axes together with 2 T cos(gamma), sin(gamma) = (R_1 -+ R_2) / d; the moments of its strands are
 * equal and opposite. */
static void put_tension(const struct target *target, const struct coupling *coupling)
{
    const struct absolute *absolute = target->absolute;
    struct vec2 p[2];
    double R[2];
    for (int k = 0; k < 2; k++) {
        struct vec2 centre;
        R[k] = circle_of(absolute->scene, coupling, k, &centre);
        p[k] = here(point_of(absolute, coupling->end[k].body, centre));
    }
    double dx = p[1].x - p[0].x, dy = p[1].y - p[0].y, d = hypot(dx, dy);
    double sine = (coupling->crossed ? R[0] + R[1] : R[0] - R[1]) / d;
    double pull = 2 * coupling->tension * sqrt(1 - sine * sine);
    for (int k = 0; k < 2; k++)
        put(target, coupling->end[k].body, coupling->name,
            times((k == 0 ? pull : -pull) / d, (struct vec2){dx, dy}), p[k], 0);
}

static void put_coupling(const struct target *target, const struct coupling *coupling)
{
    const struct absolute *absolute = target->absolute;
    struct place P[2];
    if (coupling->tension > 0) put_tension(target, coupling);
    if (coupling->kind != spring_of_two && coupling->kind != damper_of_two) return;
    for (int k = 0; k < 2; k++) {
        const struct end *end = &coupling->end[k];
        struct vec2 p = end->body < 0 ? end->at.where : spot_of(&absolute->scene->body[end->body], &end->at);
        P[k] = point_of(absolute, end->body, p);
    }
    struct vec2 f = link_force(P[0], P[1], coupling->stiffness, coupling->free_length, coupling->coefficient);
    for (int k = 0; k < 2; k++)
        if (coupling->end[k].body >= 0)
            put(target, coupling->end[k].body, coupling->name, times(k == 0 ? 1 : -1, f), here(P[k]), 0);
}

void absolute_loads(struct absolute *absolute, double *f, bool list)
{
    const struct scene *scene = absolute->scene;
    struct target target = {absolute, f, list};
    absolute->force_size = 0;
    for (int i = 0; i < 3 * scene->body_count; i++) f[i] = 0;
    for (int b = 0; b < scene->body_count; b++)
        for (int i = 0; i < scene->body[b].load_count; i++) put_load(&target, b, &scene->body[b].load[i]);
    for (int c = 0; c < scene->coupling_count; c++) put_coupling(&target, &scene->coupling[c]);
}
