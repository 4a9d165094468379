/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/section_loads.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* ---- axes */

/* A direction of the world in the axes of the axis. */
static struct vec turned(const struct section_work *work, struct vec world)
{
    const fbd_pose pose = fbd_state_pose(work->state, work->body);
    const struct vec e = vec_turn((struct vec){pose.cosine, pose.sine}, work->section->e);
    return (struct vec){vec_dot(e, world), vec_cross(e, world)};
}

static struct vec placed(const struct section_work *work, struct vec point)
{
    const struct vec r = vec_sub(point, work->section->origin);
    return (struct vec){vec_dot(work->section->e, r), vec_cross(work->section->e, r)};
}

static struct vec placed_world(const struct section_work *work, struct vec world)
{
    const fbd_point_motion origin =
        fbd_state_point_motion(work->state, work->body,
                               (const double[]){work->section->origin.x, work->section->origin.y});
    return turned(work, vec_sub(world, vec_of(origin.position)));
}

static void set_motion(struct section_work *work)
{
    const fbd_point_motion origin =
        fbd_state_point_motion(work->state, work->body,
                               (const double[]){work->section->origin.x, work->section->origin.y});
    if (work->statics) return;
    work->acceleration = turned(work, vec_of(origin.acceleration));
    work->alpha = origin.alpha;
    work->omega = origin.omega;
}

/* Acceleration at a point, in the axes of the axis. */
static struct vec acceleration_at(const struct section_work *work, struct vec p)
{
    const double square = work->omega * work->omega;
    return (struct vec){work->acceleration.x - work->alpha * p.y - square * p.x,
                        work->acceleration.y + work->alpha * p.x - square * p.y};
}

/* ---- loads at one place */

static void add_place(struct section_work *work, double x)
{
    work->places[work->place_count++] = fmin(fmax(x, 0), work->section->length);
}

/* A load beyond an end acts on that end, by a part that is rigid. */
static void add_load(struct section_work *work, const char *name, struct vec p, struct vec f, double couple)
{
    fbd_section *section = work->section;
    const double x = fmin(fmax(p.x, 0), section->length), reach = fabs(p.x - x) + fabs(p.y);
    section->loads[section->load_count++] =
        (struct section_load){name, x, {-f.x, f.y, (x - p.x) * f.y + p.y * f.x - couple}};
    section->size[section_N] += fabs(f.x) + fabs(f.y);
    section->size[section_M] += (fabs(f.x) + fabs(f.y)) * (section->length + reach) + fabs(couple);
    add_place(work, x);
}

/* Where a couple without `at` acts: at the axis of a pivot; false where that is not known. */
static bool place_couple(const struct section_work *work, size_t i, struct vec *p)
{
    const fbd_listed_force *force = &work->forces[i];
    const fbd_model *model = work->section->model;
    const struct vec G = placed(work, vec_of(work->seen.inertia.G));
    if (force->placed) return true;
    for (size_t c = 0; c < fbd_model_body_count(model); c++) {
        const fbd_body other = fbd_model_body(model, c);
        const size_t length = strlen(other.name);
        if (other.carrier != (int)work->body || other.motion != FBD_MOTION_PIVOT) continue;
        if (strncmp(force->arrow.name, other.name, length) != 0 || force->arrow.name[length] != '.') continue;
        *p = placed(work, vec_of(other.joint));
        return true;
    }
    if (work->seen.motion == FBD_MOTION_PIVOT &&
        (i < work->seen.listed || strcmp(force->arrow.name, "drive") == 0)) {
        *p = placed(work, vec_of(work->seen.pin));
        return true;
    }
    return force->reaction || vec_norm(vec_sub(*p, G)) > 1e-9 * work->section->length;
}

static bool refuse_couple(struct section_work *work, const fbd_listed_force *force)
{
    diag_add(work->errors, FBD_ERROR, "no-section", (struct pos){force->line, force->column},
             "add `at: left` or another point to the moment, or to the body in `between`",
             "where the moment `%s` acts on `%s` is not stated, and M depends on it", force->arrow.name,
             work->section->body);
    return false;
}

static bool add_concentrated(struct section_work *work, size_t i, const fbd_arrow *arrow)
{
    const struct vec f = turned(work, (struct vec){arrow->fx, arrow->fy});
    struct vec p = placed_world(work, (struct vec){arrow->x, arrow->y});
    const bool couple = arrow->fx == 0 && arrow->fy == 0;
    if (couple && arrow->couple == 0) return true;
    if (couple && !place_couple(work, i, &p)) return refuse_couple(work, &work->forces[i]);
    const char *name = arena_printf(&work->section->arena, "%s", arrow->name);
    add_load(work, name ? name : "", p, f, arrow->couple);
    return true;
}

/* ---- distributed loads */

/* False for a line across the axis, whose resultant acts at one place. */
static bool add_spread(struct section_work *work, size_t i, const fbd_arrow *arrow)
{
    enum { most_ends = 1001 };
    const fbd_model *model = work->section->model;
    const fbd_spread line = fbd_model_spread(model, work->body, i);
    if (!(line.length > 0)) return false;
    const struct vec a = placed(work, vec_of(line.from)), b = placed(work, vec_of(line.to));
    if (fabs(b.x - a.x) <= 1e-6 * line.length) return false;
    const struct vec f = turned(work, (struct vec){arrow->fx, arrow->fy});
    work->spreads[work->spread_count++] = (struct section_spread){i, line.length, a, b, f};
    double ends[most_ends];
    const size_t count = fbd_model_spread_ends(model, work->body, i, ends, most_ends);
    for (size_t k = 0; k < count && k < most_ends; k++)
        add_place(work, a.x + (b.x - a.x) * ends[k] / line.length);
    const double size = fabs(f.x) + fabs(f.y);
    work->section->size[section_N] += size;
    work->section->size[section_M] += size * (work->section->length + fabs(a.y) + fabs(b.y));
    return true;
}

/* A load along a line that leaves the body. */
static bool stays_within(struct section_work *work, size_t i)
{
    const fbd_spread line = fbd_model_spread(work->section->model, work->body, i);
    const double near = 1e-9 * work->section->length, last = work->section->length + near;
    const double a = placed(work, vec_of(line.from)).x, b = placed(work, vec_of(line.to)).x;
    if (!(line.length > 0) || (fmin(a, b) >= -near && fmax(a, b) <= last)) return true;
    diag_add(work->errors, FBD_ERROR, "no-section",
             (struct pos){work->forces[i].line, work->forces[i].column},
             "let it begin and end between the ends of the body",
             "the distributed load `%s` reaches beyond the ends of `%s`", work->forces[i].arrow.name,
             work->section->body);
    return false;
}

/* ---- mass */

static void add_size_of_mass(struct section_work *work, double mass, double inertia)
{
    fbd_section *section = work->section;
    const struct vec a = acceleration_at(work, (struct vec){0, 0}),
                     b = acceleration_at(work, (struct vec){section->length, 0});
    const double size = fabs(mass) * (vec_norm(work->gravity) + vec_norm(a) + vec_norm(b));
    section->size[section_N] += size;
    section->size[section_M] += size * section->length + fabs(inertia * work->alpha);
}

/* Parts that are not along the axis, as a bob, count as concentrated at their centres. */
static bool is_lump(const struct section_work *work, size_t index)
{
    const fbd_shape_kind kind = fbd_model_shape(work->section->model, work->body, index).kind;
    return kind != FBD_SHAPE_BAR && kind != FBD_SHAPE_POLYGON;
}

static void add_lump(struct section_work *work, size_t index)
{
    const fbd_inertia part = fbd_model_shape_inertia(work->section->model, work->body, index);
    const struct vec p = placed(work, vec_of(part.G)), a = acceleration_at(work, p);
    const struct vec f = vec_scale(part.mass, vec_sub(work->gravity, a));
    if (part.mass == 0) return;
    add_size_of_mass(work, part.mass, part.I_G);
    add_load(work, "mass of a part", p, f, -part.I_G * work->alpha);
    work->section->lump_count++;
}

static void add_masses(struct section_work *work)
{
    for (size_t i = 0; i < fbd_model_shape_count(work->section->model, work->body); i++)
        if (is_lump(work, i)) add_lump(work, i);
    for (size_t i = 0; i < work->bar_count; i++) {
        const struct section_bar *bar = &work->bars[i];
        add_place(work, bar->from);
        add_place(work, bar->to);
        add_size_of_mass(work, bar->mass * (bar->to - bar->from), bar->inertia * (bar->to - bar->from));
    }
}

void section_density(const struct section_work *work, double x, double piece, double density[3])
{
    density[0] = density[1] = density[2] = 0;
    for (size_t i = 0; i < work->bar_count; i++) {
        const struct section_bar *bar = &work->bars[i];
        if (piece < bar->from || piece > bar->to) continue;
        const struct vec a = acceleration_at(work, (struct vec){x, 0});
        density[0] += bar->mass * (work->gravity.x - a.x);
        density[1] += bar->mass * (work->gravity.y - a.y);
        density[2] += bar->inertia * work->alpha;
    }
    for (size_t i = 0; i < work->spread_count; i++) {
        const struct section_spread *spread = &work->spreads[i];
        const double run = spread->end.x - spread->start.x, share = (x - spread->start.x) / run;
        if ((piece - spread->start.x) / run < 0 || (piece - spread->start.x) / run > 1) continue;
        const double s = spread->length * fmin(fmax(share, 0), 1),
                     w = fbd_model_spread_density(work->section->model, work->body, spread->force, s) *
                         spread->length / fabs(run);
        density[0] += w * spread->resultant.x;
        density[1] += w * spread->resultant.y;
        density[2] += w * spread->resultant.x * (spread->start.y + share * (spread->end.y - spread->start.y));
    }
}

/* ---- all */

/* The forces of the diagram, at the state or at rest; their places in the file are those of the state. */
static bool take_forces(struct section_work *work)
{
    struct arena *arena = &work->section->arena;
    const size_t count = fbd_state_forces(work->state, work->body, NULL, 0);
    if (count == SIZE_MAX) return false;
    work->force_count = count;
    work->forces = ARENA_ARRAY(arena, count + 1, fbd_listed_force);
    fbd_arrow *arrows = ARENA_ARRAY(arena, count + 1, fbd_arrow);
    if (!work->forces || !arrows) return false;
    fbd_state_forces(work->state, work->body, work->forces, count);
    if (!work->statics) return true;
    if (fbd_statics_diagram(work->statics, work->body, arrows, count) != count) return false;
    for (size_t i = 0; i < count; i++) work->forces[i].arrow = arrows[i];
    return true;
}

/* Room for all loads and places. */
static bool make_room(struct section_work *work)
{
    struct arena *arena = &work->section->arena;
    const fbd_model *model = work->section->model;
    const size_t parts = fbd_model_shape_count(model, work->body);
    size_t places = 2 + 2 * parts + work->force_count;
    for (size_t i = 0; i < work->force_count; i++)
        places += fbd_model_spread_ends(model, work->body, i, NULL, 0);
    work->section->loads = ARENA_ARRAY(arena, work->force_count + parts + 1, struct section_load);
    work->spreads = ARENA_ARRAY(arena, work->force_count + 1, struct section_spread);
    work->places = ARENA_ARRAY(arena, places, double);
    return work->section->loads && work->spreads && work->places;
}

static double mass_of(const struct section_work *work)
{
    double sum = 0;
    for (size_t i = 0; i < work->bar_count; i++)
        sum += work->bars[i].mass * (work->bars[i].to - work->bars[i].from);
    for (size_t i = 0; i < fbd_model_shape_count(work->section->model, work->body); i++)
        if (is_lump(work, i)) sum += fbd_model_shape_inertia(work->section->model, work->body, i).mass;
    return sum;
}

bool section_list_loads(struct section_work *work)
{
    if (!take_forces(work) || !make_room(work)) {
        diag_out_of_memory(work->errors);
        return false;
    }
    set_motion(work);
    const double total = mass_of(work);
    bool fine = true;
    for (size_t i = 0; i < work->force_count && fine; i++) {
        const fbd_arrow *arrow = &work->forces[i].arrow;
        if (strcmp(work->forces[i].law, "gravity") == 0)
            work->gravity =
                vec_scale(total == 0 ? 0 : 1 / total, turned(work, (struct vec){arrow->fx, arrow->fy}));
        else if (!stays_within(work, i))
            fine = false;
        else if (!add_spread(work, i, arrow))
            fine = add_concentrated(work, i, arrow);
    }
    if (fine) add_masses(work);
    add_place(work, 0);
    add_place(work, work->section->length);
    return fine;
}
