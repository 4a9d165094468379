/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/names.h"

#include "document/scalar.h"
#include "expr/glyph.h"
#include "scene/reader.h"

#include <string.h>

/* ---- coordinates */

static const struct coordinate_names slide_names[] = {{"x", "v", "x_dot", "v_dot", {"a", "x_ddot"}, false}};
static const struct coordinate_names track_names[] = {{"s", "v", "s_dot", "v_dot", {"a", "s_ddot"}, false}};
static const struct coordinate_names pivot_names[] = {
    {"theta", "omega", "theta_dot", "omega_dot", {"alpha", "theta_ddot"}, true}};
static const struct coordinate_names planar_names[] = {
    {"x", "vx", "x_dot", "vx_dot", {"ax", "x_ddot"}, false},
    {"y", "vy", "y_dot", "vy_dot", {"ay", "y_ddot"}, false},
    {"theta", "omega", "theta_dot", "omega_dot", {"alpha", "theta_ddot"}, true}};

int coordinates_of(enum motion_kind kind, const struct coordinate_names **names)
{
    *names = kind == motion_slide   ? slide_names
             : kind == motion_pivot ? pivot_names
             : kind == motion_track ? track_names
                                    : planar_names;
    return kind == motion_weld ? 0 : kind == motion_planar ? 3 : kind == motion_particle ? 2 : 1;
}

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

static struct symbol variable(struct dim dim, size_t slot)
{
    return (struct symbol){.kind = symbol_variable, .dim = dim, .slot = (int)slot};
}

static struct symbol coordinate(struct dim dim, size_t slot, bool angle)
{
    struct symbol symbol = variable(dim, slot);
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

/* A coordinate or rate of `body`. */
static struct symbol coordinate_symbol(const struct names *names, int body, const char *name)
{
    const struct scene *scene = names->reader->scene;
    const struct body *owner = &scene->bodies[body];
    const struct coordinate_names *list;
    int count = coordinates_of(owner->motion.kind, &list);
    size_t n = scene->coordinate_count, first = (size_t)owner->first;
    bool constant = names->place == place_constant; /* slots are not numbered yet, and not needed */
    for (int i = 0; i < count; i++) {
        const struct coordinate_names *c = &list[i];
        size_t k = (size_t)i;
        if (strcmp(name, c->name) == 0)
            return coordinate(coordinate_dim(c->angle, 0), constant ? 0 : 1 + first + k, c->angle);
        if (matches(name, c->rate, c->rate_alias))
            return variable(coordinate_dim(c->angle, 1), constant ? 0 : 1 + n + first + k);
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
    if (wanted->kind == absolute_inertia) dim = (struct dim)DIM_INIT(1, 2, 0);
    return coordinate(dim, 1 + scene_size(scene) + hand_slots + k, wanted->kind == absolute_angle);
}

/* The mass `m` of a body, and its rate `m_dot` if it varies. */
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
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (!matches(name, known[i].name, known[i].alias)) continue;
        *kind = known[i].kind;
        return !of_point || known[i].kind < absolute_angle;
    }
    return false;
}

bool names_point(const struct body *owner, const char *name, size_t length, struct point *point)
{
    if (length == 1 && name[0] == 'G') {
        point->kind = point_G;
        return true;
    }
    if (length == 1 && name[0] == 'O' && owner->motion.kind == motion_pivot) {
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

/* A name behind `body.` that is no coordinate: `angle`, `x` (of the frame's origin), `G.x`, `right.vy`. */
static struct symbol absolute_symbol(const struct names *names, int body, const char *name)
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
    if (!names_point(owner, name, (size_t)(dot - name), &absolute.point)) return unknown;
    return names_absolute(reader, names->place, &absolute);
}

static struct symbol acceleration_symbol(const struct names *names, const char *name)
{
    const struct scene *scene = names->reader->scene;
    const struct coordinate_names *list;
    int count = coordinates_of(scene->bodies[names->body].motion.kind, &list);
    for (int i = 0; i < count; i++)
        if (matches(name, list[i].acceleration, list[i].acceleration) ||
            matches(name, list[i].acceleration_alias[0], list[i].acceleration_alias[1]))
            return variable(coordinate_dim(list[i].angle, 2),
                            1 + scene_size(scene) + (size_t)(hand_acceleration + i));
    return unknown;
}

/* The acceleration of a coordinate of another body, in a derivation. */
static struct symbol other_acceleration(const struct names *names, int body, const char *name)
{
    const struct coordinate_names *list;
    int count = coordinates_of(names->reader->scene->bodies[body].motion.kind, &list);
    for (int i = 0; i < count; i++) {
        struct absolute absolute = {.body = body, .kind = absolute_acceleration, .part = i};
        if (matches(name, list[i].acceleration, list[i].acceleration) ||
            matches(name, list[i].acceleration_alias[0], list[i].acceleration_alias[1]))
            return names_absolute(names->reader, names->place, &absolute);
    }
    return unknown;
}

/* `body.x` */
static struct symbol dotted_symbol(const struct names *names, const char *name, const char *dot)
{
    const struct reader *reader = names->reader;
    char body[node_longest_key + 1];
    size_t length = (size_t)(dot - name);
    if (length >= sizeof body) return unknown;
    memcpy(body, name, length);
    body[length] = '\0';
    const struct pair *pair = node_find(reader->bodies, body);
    if (!pair) return unknown;
    int index = (int)(pair - reader->bodies->pairs);
    if (names->place == place_constant) return variable(DIM_NONE, 0);
    if (names->place == place_exact) return unknown;
    if (!reader->drafts[index].motion_known) return failed_before;
    struct symbol own = coordinate_symbol(names, index, dot + 1);
    if (own.kind == symbol_unknown) own = mass_symbol(names, index, dot + 1);
    if (own.kind == symbol_unknown && names->place == place_hand)
        own = other_acceleration(names, index, dot + 1);
    if (own.kind == symbol_unknown && names->place == place_hand)
        own = hand_place_symbol(names, index, dot + 1);
    return own.kind != symbol_unknown ? own : absolute_symbol(names, index, dot + 1);
}

static struct symbol own_symbol(const struct names *names, const char *name)
{
    const struct reader *reader = names->reader;
    bool reserved = name_is_reserved(name);
    if (names->place == place_constant) return reserved ? variable(DIM_NONE, 0) : unknown;
    if (names->body == ground_body || names->place == place_exact) return unknown;
    if (!reader->drafts[names->body].motion_known) return reserved ? failed_before : unknown;
    return coordinate_symbol(names, names->body, name);
}

/* The slip speed. Coefficients of a rolling body are read before the body is known (read_couplings.c): the
 * constraint identifies it. */
static struct symbol slip_symbol(struct names *names)
{
    struct reader *reader = names->reader;
    bool roll = names->body == ground_body;
    names->slip_named = true;
    reader->varies = true; /* the same text has another meaning at rest */
    if (names->slip == slip_resting)
        return (struct symbol){.kind = symbol_constant, .dim = coordinate_dim(names->slip_angular, 1)};
    struct absolute slip = {.body = names->body,
                            .point = {.kind = point_fixed},
                            .kind = absolute_slip,
                            .roll = roll ? 1 + (int)reader->scene->constraint_count : 0,
                            .angular = names->slip_angular};
    return names_absolute(reader, names->place, &slip);
}

/* `slip` outside of coefficients of friction. */
static struct symbol misplaced_slip(const struct names *names, struct pos at)
{
    diag_add(names->reader->errors, FBD_ERROR, "not-here", at,
             "elsewhere name the rates, as `abs(v)` or `abs(v - belt.v)`",
             "`slip` is known in the coefficients of dry friction alone");
    return failed_before;
}

/* The distance to the point that a force is directed to. Its expression is derived when the force is known
 * (derived.c); until then any varying length represents it. */
static struct symbol distance_symbol(struct names *names, struct pos at)
{
    names->distance_named = true;
    names->reader->varies = true; /* must be noticed in every reading */
    if (names->distance_known) return variable(DIM_LENGTH, 0);
    diag_add(names->reader->errors, FBD_ERROR, "not-here", at,
             "elsewhere write it out, as `hypot(a.G.x - b.G.x, a.G.y - b.G.y)`",
             "`distance` is known in the `value` of a force with `toward` alone");
    return failed_before;
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
    bool pivot = reader->scene->bodies[names->body].motion.kind == motion_pivot;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        int slot = known[i].slot;
        if (strcmp(name, known[i].name) != 0) continue;
        if ((slot == hand_I_O || slot == hand_L) && !pivot) return unknown;
        if (slot == hand_N && !draft->has_normal) return unknown;
        if ((slot == hand_mu_s || slot == hand_mu_k) && !draft->has_friction) return unknown;
        return variable(known[i].dim, 1 + scene_size(reader->scene) + (size_t)slot);
    }
    const struct symbol rate = strcmp(name, "m_dot") == 0 ? mass_symbol(names, names->body, name) : unknown;
    return rate.kind != symbol_unknown ? rate : acceleration_symbol(names, name);
}

static struct symbol load_symbol(const struct names *names, const char *name)
{
    return mass_symbol(names, names->body, name);
}

static struct symbol other_symbol(const struct names *names, const char *name)
{
    if (names->place == place_load || names->place == place_exact) return load_symbol(names, name);
    if (names->place == place_hand) return hand_symbol(names, name);
    if (names->place == place_contact && strcmp(name, "approach") == 0)
        return variable(DIM_VELOCITY, 1 + scene_size(names->reader->scene) + hand_acceleration);
    return unknown;
}

/* `v0`, `cart.x0`: a coordinate or rate at the start of the run, unless the name has another meaning. */
static struct symbol initial_symbol(const struct names *names, const char *name)
{
    const struct reader *reader = names->reader;
    const size_t length = strlen(name), end = length > 2 && name[length - 2] == '_' ? 2 : 1;
    if (names->sense != sense_now || length < 2 || name[length - 1] != '0') return unknown;
    const char *stem = arena_text(reader->arena, name, length - end), *dot = stem ? strchr(stem, '.') : NULL;
    if (!stem) return failed_before;
    struct symbol symbol = dot ? dotted_symbol(names, stem, dot) : own_symbol(names, stem);
    const size_t slots = 2 * reader->scene->coordinate_count;
    if (symbol.kind != symbol_variable || symbol.slot < 1 || (size_t)symbol.slot > slots) return unknown;
    symbol.slot += (int)hand_sense_size(reader->scene);
    return symbol;
}

/* In a derivation an unknown name may be a force of the diagram; and points and the angle of the current body
 * need no prefix. */
static struct symbol or_force(const struct names *names, const char *name, struct symbol symbol)
{
    if (names->place != place_hand || symbol.kind != symbol_unknown) return symbol;
    if (!names->reader->drafts[names->body].motion_known) return failed_before;
    symbol = initial_symbol(names, name);
    if (symbol.kind != symbol_unknown) return symbol;
    symbol = force_symbol(names, name);
    if (symbol.kind == symbol_unknown) symbol = hand_place_symbol(names, names->body, name);
    if (symbol.kind == symbol_unknown) symbol = hand_numbered_symbol(names, name);
    bool of_points = strchr(name, '.') != NULL || strncmp(name, "angle", strlen("angle")) == 0;
    if (symbol.kind == symbol_unknown && of_points) symbol = absolute_symbol(names, names->body, name);
    return symbol;
}

static struct symbol time_symbol(const struct names *names)
{
    const struct override *input = names->reader->time;
    struct symbol time = variable(DIM_TIME, 0);
    time.because = "is the time";
    if (input && names->place != place_constant)
        time = (struct symbol){.kind = symbol_constant, .dim = DIM_TIME, .value = input->now};
    return time;
}

/* A parameter; or an input, which is not constant: it may change during a run. */
static struct symbol constant_symbol(struct names *names, size_t index, struct pos at)
{
    struct reader *reader = names->reader;
    struct symbol symbol = parameter_symbol(reader, index, at);
    bool input = reader->scene->parameters[index].input;
    if (input) reader->names_inputs = true;
    bool is_time = reader->time && strcmp(reader->time->name, reader->scene->parameters[index].name) == 0;
    bool varies = input && (names->place == place_constant || is_time);
    if (!varies || symbol.kind != symbol_constant) return symbol;
    symbol = variable(symbol.dim, 0);
    symbol.because = "is an input, which may change during a run";
    return symbol;
}

static struct symbol name_now(struct names *names, const char *name, struct pos at)
{
    struct reader *reader = names->reader;
    const char *dot = strchr(name, '.');
    if (names->along && strcmp(name, "s") == 0) return variable(DIM_LENGTH, 1);
    if (own_states_name(reader, name)) return own_state_symbol(names, name + strlen("states."), at);
    if (dot) return or_force(names, name, dotted_symbol(names, name, dot));
    if (strcmp(name, "t") == 0) return time_symbol(names);
    struct symbol own = own_symbol(names, name);
    size_t parameter;
    if (own.kind != symbol_unknown) return own;
    if (parameters_find(reader, name, &parameter)) return constant_symbol(names, parameter, at);
    if (names->tried && strcmp(name, "s") == 0) return variable(DIM_NONE, 0);
    struct symbol state = own_state_symbol(names, name, at);
    if (state.kind != symbol_unknown) return state;
    if (strcmp(name, "g") == 0) return gravity_symbol(reader, at);
    if (strcmp(name, "slip") == 0) return names->slip ? slip_symbol(names) : misplaced_slip(names, at);
    if (names->place == place_load && strcmp(name, "distance") == 0) return distance_symbol(names, at);
    struct symbol other = is_declared(names, name) ? force_symbol(names, name)
                                                   : or_force(names, name, other_symbol(names, name));
    if (other.kind == symbol_constant)
        reader->varies = reader->names_varying = true; /* its origin is not tracked */
    return other;
}

/* Look up a name. Inside `initial(...)`, `before(...)` and `after(...)` it is shifted to the slot of that
 * time. */
static struct symbol look_up(void *context, const char *name, struct pos at)
{
    struct names *names = context;
    struct symbol symbol = names_take_force(names) ? force_symbol(names, name) : name_now(names, name, at);
    if (names->sense == sense_now || symbol.kind != symbol_variable) return symbol;
    if (symbol.slot > 0) symbol.slot += (int)(names->sense * hand_sense_size(names->reader->scene));
    if (symbol.slot == 0 && names->sense == sense_initial)
        return (struct symbol){.kind = symbol_constant, .dim = DIM_TIME};
    return symbol;
}

static struct table_symbol look_up_table(void *context, const char *name, struct pos at)
{
    const struct names *names = context;
    return table_symbol(names->reader, name, at);
}

struct scope names_scope(struct names *names)
{
    return (struct scope){.lookup = look_up,
                          .table = look_up_table,
                          .tables = names_list_tables,
                          .sense = names_sense,
                          .names = names_list,
                          .context = names,
                          .units = names->reader->scene->units};
}
