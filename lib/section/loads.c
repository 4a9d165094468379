/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "section/loads.h"

#include <math.h>
#include <string.h>

#include "dynamics/mass.h"
#include "model/outline.h"
#include "numeric/tolerances.h"
#include "section/spread.h"

/* ---- axes */

/* A direction of the world in the axes of the axis. */
static struct vec turned(const struct section_work *work, struct vec world)
{
    const struct vec e = vec_turn(work->pose.rotation, work->section->e);
    return (struct vec){vec_dot(e, world), vec_cross(e, world)};
}

static struct vec placed(const struct section_work *work, struct vec point)
{
    const struct vec r = vec_sub(point, work->section->origin);
    return (struct vec){vec_dot(work->section->e, r), vec_cross(work->section->e, r)};
}

static struct vec placed_world(const struct section_work *work, struct vec world)
{
    return turned(work, vec_sub(world, point_motion(work->body, &work->pose, work->section->origin).p));
}

/* The bars have the mass of the start. */
static void set_mass(struct section_work *work)
{
    const double share = body_share(work->body, &work->at);
    for (size_t i = 0; i < work->bar_count; i++) {
        work->bars[i].mass *= share;
        work->bars[i].inertia *= share;
    }
}

static void set_motion(struct section_work *work)
{
    if (work->section->at_rest) return;
    work->acceleration = turned(work, point_acceleration(work->body, work->section->origin, &work->at));
    work->alpha = body_angular_acceleration(work->body, &work->at);
    work->omega = work->pose.omega;
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

/* The entry of the file under the body, or NULL: an opposite force, or a reaction that is not listed. */
static const struct load *entry_of(const struct section_work *work, size_t i)
{
    return i < work->body->source->load_count ? &work->body->source->loads[i] : NULL;
}

/* Where a couple without `at` acts: at the axis of a pivot; false where that is not known. */
static bool place_couple(const struct section_work *work, size_t i, struct vec *p)
{
    const struct arrow *arrow = &work->arrows[i];
    const struct load *entry = entry_of(work, i);
    const struct fbd_model *model = work->section->model;
    const struct vec G = placed(work, work->body->inertia.G);
    if (entry && entry->point.kind != point_absent) return true;
    for (size_t c = 0; c < model->body_count; c++) {
        const struct model_body *other = &model->bodies[c];
        const size_t length = strlen(other->name);
        if (other->parent != (int)(work->body - model->bodies) || !other->joint->has_axis) continue;
        if (strncmp(arrow->name, other->name, length) != 0 || arrow->name[length] != '.') continue;
        *p = placed(work, other->origin);
        return true;
    }
    if (work->body->joint->has_axis && (entry || strcmp(arrow->name, "drive") == 0)) {
        *p = placed(work, work->body->pin);
        return true;
    }
    return arrow_is_reaction(model, arrow) || vec_norm(vec_sub(*p, G)) > nine_digits * work->section->length;
}

/* The place in the file of a force, or of the body. */
static struct pos pos_of(const struct section_work *work, size_t i)
{
    const struct load *entry = entry_of(work, i);
    return entry ? entry->at : work->body->source->at;
}

static bool refuse_couple(struct section_work *work, size_t i)
{
    diag_add(work->errors, FBD_ERROR, "no-section", pos_of(work, i),
             "add `at: left` or another point to the moment, or to the body in `between`",
             "where the moment `%s` acts on `%s` is not stated, and M depends on it", work->arrows[i].name,
             work->body->name);
    return false;
}

static bool add_concentrated(struct section_work *work, size_t i)
{
    const struct arrow *arrow = &work->arrows[i];
    const struct vec f = turned(work, arrow->force);
    struct vec p = placed_world(work, arrow->point);
    const bool couple = vec_norm(arrow->force) == 0;
    if (couple && arrow->couple == 0) return true;
    if (couple && !place_couple(work, i, &p)) return refuse_couple(work, i);
    add_load(work, arrow->name, p, f, arrow->couple);
    return true;
}

/* ---- distributed loads */

/* The line of a distributed load; NULL for another force. */
static const struct spread *spread_of(const struct section_work *work, size_t i)
{
    const struct load *entry = entry_of(work, i);
    return entry && entry->spread.length > 0 ? &entry->spread : NULL;
}

/* False for a line across the axis, whose resultant acts at one place. */
static bool add_spread(struct section_work *work, size_t i)
{
    const struct spread *spread = spread_of(work, i);
    if (!spread) return false;
    const struct vec a = placed(work, spread->from), b = placed(work, spread->to);
    if (fabs(b.x - a.x) <= six_digits * spread->length) return false;
    const struct vec f = turned(work, work->arrows[i].force);
    double ends[spread_most_ends];
    const size_t count = spread_ends(spread, ends);
    work->spreads[work->spread_count++] = (struct section_spread){spread, a, b, f};
    for (size_t k = 0; k < count; k++) add_place(work, a.x + (b.x - a.x) * ends[k] / spread->length);
    const double size = fabs(f.x) + fabs(f.y);
    work->section->size[section_N] += size;
    work->section->size[section_M] += size * (work->section->length + fabs(a.y) + fabs(b.y));
    return true;
}

/* A load along a line that leaves the body. */
static bool stays_within(struct section_work *work, size_t i)
{
    const struct spread *spread = spread_of(work, i);
    if (!spread) return true;
    const double near = nine_digits * work->section->length, last = work->section->length + near;
    const double a = placed(work, spread->from).x, b = placed(work, spread->to).x;
    if (fmin(a, b) >= -near && fmax(a, b) <= last) return true;
    diag_add(work->errors, FBD_ERROR, "no-section", pos_of(work, i),
             "let it begin and end between the ends of the body",
             "the distributed load `%s` reaches beyond the ends of `%s`", work->arrows[i].name,
             work->body->name);
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
static bool is_lump(const struct part *part)
{
    const struct outline_part shape = outline_of_part(part);
    return !section_is_straight(&shape);
}

static void add_lump(struct section_work *work, const struct part *of)
{
    const struct inertia part = inertia_of_parts(of, 1, work->body->pin);
    const struct vec p = placed(work, part.G), a = acceleration_at(work, p);
    const struct vec f = vec_scale(part.mass, vec_sub(work->gravity, a));
    if (part.mass == 0) return;
    add_size_of_mass(work, part.mass, part.I_G);
    add_load(work, "mass of a part", p, f, -part.I_G * work->alpha);
    work->section->lump_count++;
}

static void add_masses(struct section_work *work)
{
    const struct body *source = work->body->source;
    for (size_t i = 0; i < source->part_count; i++)
        if (is_lump(&source->parts[i])) add_lump(work, &source->parts[i]);
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
        const double length = spread->line->length, s = length * fmin(fmax(share, 0), 1),
                     w = spread_density(spread->line, s) * length / fabs(run);
        density[0] += w * spread->resultant.x;
        density[1] += w * spread->resultant.y;
        density[2] += w * spread->resultant.x * (spread->start.y + share * (spread->end.y - spread->start.y));
    }
}

/* ---- all */

/* Room for all loads and places. */
static bool make_room(struct section_work *work)
{
    struct arena *arena = &work->section->arena;
    const size_t parts = work->body->source->part_count, loads = work->arrow_count + parts;
    size_t places = 2 + 2 * parts + work->arrow_count;
    for (size_t i = 0; i < work->arrow_count; i++)
        if (spread_of(work, i)) places += spread_most_ends;
    work->section->loads = ARENA_ARRAY(arena, loads + 1, struct section_load);
    work->spreads = ARENA_ARRAY(arena, work->arrow_count + 1, struct section_spread);
    work->places = ARENA_ARRAY(arena, places, double);
    return work->section->loads && work->spreads && work->places;
}

static bool take_diagram(struct section_work *work)
{
    const struct fbd_model *model = work->section->model;
    const int b = (int)(work->body - model->bodies);
    work->arrows = ARENA_ARRAY(&work->section->arena, diagram_arrows(model, b) + 1, struct arrow);
    if (!work->arrows) return false;
    work->arrow_count = diagram_list(model, b, &work->at, work->state->slots, work->arrows);
    return true;
}

static double mass_of(const struct section_work *work)
{
    const struct body *source = work->body->source;
    double sum = 0;
    for (size_t i = 0; i < work->bar_count; i++)
        sum += work->bars[i].mass * (work->bars[i].to - work->bars[i].from);
    for (size_t i = 0; i < source->part_count; i++)
        if (is_lump(&source->parts[i])) sum += inertia_of_parts(&source->parts[i], 1, work->body->pin).mass;
    return sum;
}

bool section_list_loads(struct section_work *work)
{
    if (!take_diagram(work) || !make_room(work)) {
        diag_out_of_memory(work->errors);
        return false;
    }
    set_mass(work);
    set_motion(work);
    const double total = mass_of(work);
    bool fine = true;
    for (size_t i = 0; i < work->arrow_count && fine; i++) {
        const struct load *entry = entry_of(work, i);
        if (entry && entry->kind == load_gravity)
            work->gravity = vec_scale(total == 0 ? 0 : 1 / total, turned(work, work->arrows[i].force));
        else
            fine = stays_within(work, i) && (add_spread(work, i) || add_concentrated(work, i));
    }
    if (fine) add_masses(work);
    add_place(work, 0);
    add_place(work, work->section->length);
    return fine;
}
