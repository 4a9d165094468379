/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of the quantities of a body, and the symbols that they stand for: coordinates and rates, positions in
 * the world, accelerations, the mass.
 */
#include "scene/names.h"

#include "document/scalar.h"
#include "expr/glyph.h"
#include "scene/reader.h"

#include <stdlib.h>
#include <string.h>

bool name_is_reserved(const char *name)
{
    static const char *const reserved[] = {"t", "pi", "x", "y", "v", "vx", "vy", "theta", "omega"};
    for (size_t i = 0; i < sizeof reserved / sizeof *reserved; i++)
        if (strcmp(name, reserved[i]) == 0) return true;
    return false;
}

bool name_check(fbd_errors *errors, const char *name, struct pos at, const char *what)
{
    if (scalar_is_name(name)) return true;
    const char *hint = "use letters a-z, digits and `_`, and start with a letter";
    for (const char *c = name; *c; c++) {
        size_t size = glyph_size(c, strlen(c));
        const char *plain = size > 1 ? glyph_plain(c, size) : NULL;
        if (size == 2 && strncmp(c, "\xC2\xA0", 2) == 0)
            hint = "it contains a no-break space (U+00A0), as pasted text does: type a blank in its place";
        if (plain) hint = diag_hint(errors, "write `%s` for `%.*s`", plain, (int)size, c);
        if (plain) break;
    }
    diag_add(errors, FBD_ERROR, "bad-name", at, hint, "`%s` cannot be %s%s", name,
             what ? "the name of " : "a name", what ? what : "");
    return false;
}

/* ---- symbols */

static const struct symbol unknown = {.kind = symbol_unknown};
static const struct symbol failed_before = {.kind = symbol_failed};

static struct symbol coordinate(struct dim dim, size_t slot, bool angle)
{
    struct symbol symbol = slot_symbol(dim, slot);
    symbol.angle = angle;
    return symbol;
}

static struct dim coordinate_dim(bool angle, int derivative)
{
    struct dim dim = angle ? DIM_NONE : DIM_LENGTH;
    dim.time = (short)(-derivative * dim_unit);
    return dim;
}

static bool matches(const char *name, const char *a, const char *b)
{
    return strcmp(name, a) == 0 || strcmp(name, b) == 0;
}

struct symbol coordinate_symbol(const struct names *names, int body, const char *name)
{
    const struct scene *scene = names->reader->scene;
    const struct body *owner = &scene->bodies[body];
    const struct joint_type *joint = motion_joint(&owner->motion);
    size_t n = scene->coordinate_count, first = (size_t)owner->first;
    bool constant = names->place == place_constant; /* slots are not numbered yet, and not needed */
    for (int i = 0; i < joint->count; i++) {
        const struct joint_coordinate *c = &joint->coordinates[i];
        size_t k = (size_t)i;
        if (strcmp(name, c->name) == 0)
            return coordinate(coordinate_dim(c->angle, 0), constant ? 0 : 1 + first + k, c->angle);
        if (matches(name, c->rate, c->rate_alias))
            return slot_symbol(coordinate_dim(c->angle, 1), constant ? 0 : 1 + n + first + k);
    }
    return unknown;
}

struct symbol names_absolute(struct reader *reader, enum place place, const struct absolute *wanted)
{
    struct scene *scene = reader->scene;
    size_t k = 0;
    reader->varies = true; /* the slot number is valid for this reading only */
    for (; k < scene->absolute_count; k++) {
        const struct absolute *known = &scene->absolutes[k];
        if (known->body == wanted->body && known->kind == wanted->kind && known->part == wanted->part &&
            known->point.kind == wanted->point.kind && known->point.where.x == wanted->point.where.x &&
            known->point.where.y == wanted->point.where.y && known->roll == wanted->roll &&
            (known->force == wanted->force ||
             (known->force && wanted->force && strcmp(known->force, wanted->force) == 0)))
            break;
    }
    if (k == most_absolutes) return unknown;
    if (k == scene->absolute_count) {
        if (!scene->absolutes) scene->absolutes = ARENA_ARRAY(reader->arena, most_absolutes, struct absolute);
        if (!scene->absolutes) return failed_before;
        scene->absolutes[scene->absolute_count++] = *wanted;
    }
    scene->absolutes[k].moves |= place != place_hand;
    bool accelerates = wanted->kind == absolute_acceleration || wanted->kind == absolute_ax ||
                       wanted->kind == absolute_ay || wanted->kind == absolute_alpha;
    int derivative = accelerates ? 2
                                 : wanted->kind == absolute_vx || wanted->kind == absolute_vy ||
                                       wanted->kind == absolute_angle_dot || wanted->kind == absolute_slip;
    bool angle = wanted->kind == absolute_angle || wanted->kind == absolute_angle_dot ||
                 wanted->kind == absolute_alpha || wanted->angular;
    if (wanted->kind == absolute_acceleration)
        angle = scene->coordinates[scene->bodies[wanted->body].first + wanted->part].angle;
    struct dim dim = coordinate_dim(angle, derivative);
    if (wanted->kind == absolute_mass) dim = DIM_MASS;
    if (wanted->kind == absolute_mass_rate) dim = dim_over(DIM_MASS, DIM_TIME);
    if (wanted->kind == absolute_force) dim = DIM_NONE; /* force_symbol sets it */
    if (wanted->kind == absolute_reaction) dim = wanted->part == reaction_moment ? DIM_MOMENT : DIM_FORCE;
    if (wanted->kind == absolute_inertia) dim = (struct dim)DIM_INIT(1, 2, 0);
    return coordinate(dim, 1 + scene_size(scene) + hand_slots + k, wanted->kind == absolute_angle);
}

struct symbol mass_symbol(const struct names *names, int body, const char *name)
{
    const struct draft *draft = &names->reader->drafts[body];
    const bool rate = strcmp(name, "m_dot") == 0;
    const struct absolute mass = {.body = body,
                                  .point = {.kind = point_fixed},
                                  .kind = rate ? absolute_mass_rate : absolute_mass};
    if (!rate && strcmp(name, "m") != 0) return unknown;
    if (draft->mass_varies && names->place != place_exact)
        return names_absolute(names->reader, names->place, &mass);
    if (draft->mass_varies || rate) return unknown;
    if (!draft->mass_known) return failed_before;
    return (struct symbol){.kind = symbol_constant, .dim = DIM_MASS, .value = draft->mass};
}

struct symbol name_of_place(struct reader *reader, int body, const struct point *point,
                            enum absolute_kind kind)
{
    const struct absolute absolute = {.body = body, .point = *point, .kind = kind};
    return names_absolute(reader, place_load, &absolute);
}

bool names_is_driven(const struct reader *reader, int body)
{
    return reader->drafts[body].motion_keys.prescribed != NULL;
}

/* Accelerations of points in the world are known where the body is driven on the ground along a line or about an axis. */
static bool accelerates_as_known(const struct reader *reader, int body)
{
    const struct motion *motion = &reader->scene->bodies[body].motion;
    return names_is_driven(reader, body) && motion->parent == ground_body &&
           motion_joint(motion)->path != path_curve;
}

/* `angle`, `x`, `y` and their rates in the world; with `of_point` without `angle`. */
static bool absolute_kind_of(const char *name, bool of_point, enum absolute_kind *kind)
{
    static const struct {
        const char *name, *alias;
        enum absolute_kind kind;
    } known[] = {
        {"x", "x", absolute_x},
        {"y", "y", absolute_y},
        {"vx", "x_dot", absolute_vx},
        {"vy", "y_dot", absolute_vy},
        {"angle", "angle", absolute_angle},
        {"angle_dot", "angle_dot", absolute_angle_dot},
        {"ax", "a_x", absolute_ax},
        {"ay", "a_y", absolute_ay},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (!matches(name, known[i].name, known[i].alias)) continue;
        *kind = known[i].kind;
        return of_point == (known[i].kind == absolute_ax || known[i].kind == absolute_ay) ||
               known[i].kind < absolute_angle;
    }
    return false;
}

bool names_point(const struct body *owner, const char *name, size_t length, struct point *point)
{
    if (length == 1 && name[0] == 'G') {
        point->kind = point_G;
        return true;
    }
    if (length == 1 && name[0] == 'O' && motion_joint(&owner->motion)->has_axis) {
        point->where = owner->motion.point;
        return true;
    }
    for (size_t i = 0; i < owner->point_count; i++) {
        if (strncmp(owner->points[i].name, name, length) != 0 || owner->points[i].name[length]) continue;
        point->where = owner->points[i].where;
        return true;
    }
    return false;
}

struct symbol absolute_symbol(const struct names *names, int body, const char *name)
{
    struct reader *reader = names->reader;
    const struct body *owner = &reader->scene->bodies[body];
    struct absolute absolute = {.body = body, .point = {.kind = point_fixed}};
    const char *dot = strrchr(name, '.'); /* points of parts contain dots, too */
    if (!dot) {
        if (!absolute_kind_of(name, false, &absolute.kind)) return unknown;
        return names_absolute(reader, names->place, &absolute);
    }
    if (!absolute_kind_of(dot + 1, true, &absolute.kind)) return unknown;
    const bool accelerates = absolute.kind == absolute_ax || absolute.kind == absolute_ay;
    if (accelerates && !accelerates_as_known(reader, body)) return unknown;
    if (!names_point(owner, name, (size_t)(dot - name), &absolute.point)) return unknown;
    return names_absolute(reader, names->place, &absolute);
}

/* The coordinate of a body whose acceleration has that name; or -1. */
static int acceleration_called(const struct body *body, const char *name)
{
    const struct joint_type *joint = motion_joint(&body->motion);
    for (int k = 0; k < joint->count; k++) {
        const struct joint_coordinate *c = &joint->coordinates[k];
        if (matches(name, c->acceleration, c->acceleration) ||
            matches(name, c->acceleration_alias[0], c->acceleration_alias[1]))
            return k;
    }
    return -1;
}

static struct symbol acceleration_symbol(const struct names *names, const char *name)
{
    const struct scene *scene = names->reader->scene;
    const int k = acceleration_called(&scene->bodies[names->body], name);
    if (k < 0) return unknown;
    return slot_symbol(coordinate_dim(k == motion_joint(&scene->bodies[names->body].motion)->angle, 2),
                       1 + scene_size(scene) + (size_t)(hand_acceleration + k));
}

struct symbol other_acceleration_symbol(const struct names *names, int body, const char *name)
{
    const int k = acceleration_called(&names->reader->scene->bodies[body], name);
    const struct absolute absolute = {.body = body, .kind = absolute_acceleration, .part = k};
    return k < 0 ? unknown : names_absolute(names->reader, names->place, &absolute);
}

struct symbol hand_symbol(const struct names *names, const char *name)
{
    static const struct {
        const char *name;
        int slot;
        struct dim dim;
    } known[] = {
        {"m", hand_mass, DIM_INIT(1, 0, 0)},    {"I_G", hand_I_G, DIM_INIT(1, 2, 0)},
        {"I_O", hand_I_O, DIM_INIT(1, 2, 0)},   {"L", hand_L, DIM_INIT(0, 1, 0)},
        {"N", hand_N, DIM_INIT(1, 1, -2)},      {"mu_s", hand_mu_s, DIM_INIT(0, 0, 0)},
        {"mu_k", hand_mu_k, DIM_INIT(0, 0, 0)}, {"mu", hand_mu_k, DIM_INIT(0, 0, 0)},
    };
    const struct reader *reader = names->reader;
    const struct draft *draft = &reader->drafts[names->body];
    if (!draft->motion_known) return failed_before;
    bool has_axis = motion_joint(&reader->scene->bodies[names->body].motion)->has_axis;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        int slot = known[i].slot;
        if (strcmp(name, known[i].name) != 0) continue;
        if ((slot == hand_I_O || slot == hand_L) && !has_axis) return unknown;
        if (slot == hand_N && !draft->has_normal) return unknown;
        if ((slot == hand_mu_s || slot == hand_mu_k) && !draft->has_friction) return unknown;
        return slot_symbol(known[i].dim, 1 + scene_size(reader->scene) + (size_t)slot);
    }
    const struct symbol rate = strcmp(name, "m_dot") == 0 ? mass_symbol(names, names->body, name) : unknown;
    return rate.kind != symbol_unknown ? rate : acceleration_symbol(names, name);
}

const struct parameter *scene_mass_parameter(const struct scene *scene, int number)
{
    for (size_t i = 0; i < scene->parameter_count; i++) {
        const char *name = scene->parameters[i].name, *digits = name && *name == 'm' ? name + 1 : "";
        digits += *digits == '_';
        char *end = NULL;
        if (*digits >= '1' && *digits <= '9' && strtol(digits, &end, 10) == number && !*end)
            return &scene->parameters[i];
    }
    return NULL;
}
