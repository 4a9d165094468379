/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The lookup of the names of an expression, in the order of names.h.
 */
#include "scene/names.h"

#include "scene/reader.h"

#include <string.h>

static const struct symbol unknown = {.kind = symbol_unknown};
static const struct symbol failed_before = {.kind = symbol_failed};

/* `body.x` */
static struct symbol dotted_symbol(const struct names *names, const char *name, const char *dot,
                                   struct pos at)
{
    const struct reader *reader = names->reader;
    char body[node_longest_key + 1];
    size_t length = (size_t)(dot - name);
    if (length >= sizeof body) return unknown;
    memcpy(body, name, length);
    body[length] = '\0';
    const struct pair *pair = node_find(reader->bodies, body);
    if (!pair) return reaction_symbol(names, name, at);
    int index = (int)(pair - reader->bodies->pairs);
    if (names->place == place_constant) return slot_symbol(DIM_NONE, 0);
    if (names->place == place_exact) return unknown;
    if (!reader->drafts[index].motion_known) return failed_before;
    struct symbol own = coordinate_symbol(names, index, dot + 1);
    if (own.kind == symbol_unknown) own = mass_symbol(names, index, dot + 1);
    if (own.kind == symbol_unknown) own = joint_reaction_symbol(names, index, dot + 1, at);
    if (own.kind == symbol_unknown && (names->place == place_hand || names_is_driven(reader, index)))
        own = other_acceleration_symbol(names, index, dot + 1);
    if (own.kind == symbol_unknown && names->place == place_hand)
        own = hand_place_symbol(names, index, dot + 1);
    return own.kind != symbol_unknown ? own : absolute_symbol(names, index, dot + 1);
}

static struct symbol own_symbol(const struct names *names, const char *name)
{
    const struct reader *reader = names->reader;
    bool reserved = name_is_reserved(name);
    if (names->place == place_constant) return reserved ? slot_symbol(DIM_NONE, 0) : unknown;
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
        return (struct symbol){.kind = symbol_constant, .dim = names->slip_angular ? DIM_RATE : DIM_VELOCITY};
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
    if (names->distance_known) return slot_symbol(DIM_LENGTH, 0);
    diag_add(names->reader->errors, FBD_ERROR, "not-here", at,
             "elsewhere write it out, as `hypot(a.G.x - b.G.x, a.G.y - b.G.y)`",
             "`distance` is known in the `value` of a force with `toward` alone");
    return failed_before;
}

static struct symbol load_symbol(const struct names *names, const char *name)
{
    return mass_symbol(names, names->body, name);
}

static struct symbol other_symbol(const struct names *names, const char *name)
{
    if (names->place == place_load || names->place == place_exact) return load_symbol(names, name);
    if (names->place == place_hand) return hand_symbol(names, name);
    if (names->of || names->of_coupling || names->of_load) return own_reaction_symbol(names, name);
    if (names->place == place_contact && strcmp(name, "approach") == 0)
        return slot_symbol(DIM_VELOCITY, 1 + scene_size(names->reader->scene) + hand_acceleration);
    return unknown;
}

/* `v0`, `cart.x0`: a coordinate or rate at the start of the run, unless the name has another meaning. */
static struct symbol initial_symbol(const struct names *names, const char *name, struct pos at)
{
    const struct reader *reader = names->reader;
    const size_t length = strlen(name), end = length > 2 && name[length - 2] == '_' ? 2 : 1;
    if (names->sense != sense_now || length < 2 || name[length - 1] != '0') return unknown;
    const char *stem = arena_text(reader->arena, name, length - end), *dot = stem ? strchr(stem, '.') : NULL;
    if (!stem) return failed_before;
    struct symbol symbol = dot ? dotted_symbol(names, stem, dot, at) : own_symbol(names, stem);
    const size_t slots = 2 * reader->scene->coordinate_count;
    if (symbol.kind != symbol_variable || symbol.slot < 1 || (size_t)symbol.slot > slots) return unknown;
    symbol.slot += (int)hand_sense_size(reader->scene);
    return symbol;
}

/* In a derivation an unknown name may be a force of the diagram; and points and the angle of the current body
 * need no prefix. */
static struct symbol or_force(const struct names *names, const char *name, struct symbol symbol,
                              struct pos at)
{
    if (names->place != place_hand || symbol.kind != symbol_unknown) return symbol;
    if (!names->reader->drafts[names->body].motion_known) return failed_before;
    symbol = initial_symbol(names, name, at);
    if (symbol.kind != symbol_unknown) return symbol;
    symbol = force_symbol(names, name);
    if (symbol.kind == symbol_unknown) symbol = hand_place_symbol(names, names->body, name);
    if (symbol.kind == symbol_unknown) symbol = hand_numbered_symbol(names, name);
    bool of_points = strchr(name, '.') != NULL || strncmp(name, "angle", strlen("angle")) == 0;
    if (symbol.kind == symbol_unknown && of_points) symbol = absolute_symbol(names, names->body, name);
    return symbol;
}

static struct symbol time_symbol(void)
{
    struct symbol time = slot_symbol(DIM_TIME, 0);
    time.because = "is the time";
    return time;
}

/* An input that is no constant of the model. */
static struct symbol call_symbol(const struct names *names, size_t index, struct symbol value)
{
    const struct absolute input = {.point = {.kind = point_fixed},
                                   .kind = absolute_input,
                                   .part = (int)index};
    struct symbol symbol = names_absolute(names->reader, names->place, &input);
    symbol.dim = value.dim;
    symbol.free = value.free;
    return symbol;
}

struct symbol two_meanings(struct reader *reader, const char *name, const char *other, struct pos at)
{
    diag_add(reader->errors, FBD_ERROR, "ambiguous-name", at,
             diag_hint(reader->errors, "call the parameter otherwise, such as `%s0`", name),
             "`%s` could mean the parameter or %s", name, other);
    return failed_before;
}

/* A parameter in the block of a body that has a coordinate or rate of that name: neither may hide the other. */
static bool means_coordinate(const struct names *names, const char *name, struct pos at)
{
    struct reader *reader = names->reader;
    const int block = reader->open ? ground_body : reader->inside; /* definitions stand in no block */
    const int body = names->body != ground_body ? names->body : block;
    if (body == ground_body || !body_has_coordinate(reader, body, name)) return false;
    two_meanings(reader, name, diag_hint(reader->errors, "`%s.%s`", reader->scene->bodies[body].name, name),
                 at);
    return true;
}

/* A parameter; or an input, which is not constant: it may change during a run. */
static struct symbol constant_symbol(struct names *names, size_t index, struct pos at)
{
    struct reader *reader = names->reader;
    struct symbol symbol = reader->definition_readers->parameter(reader, index, at);
    bool input = reader->scene->parameters[index].input;
    if (input) reader->names_input = true;
    bool varies = input && names->place == place_constant;
    bool outside =
        input_varies(&reader->scene->parameters[index].call) && names->place != place_exact && !varies;
    if (outside && symbol.kind == symbol_constant) return call_symbol(names, index, symbol);
    if (!varies || symbol.kind != symbol_constant) return symbol;
    symbol = slot_symbol(symbol.dim, 0);
    symbol.because = "is an input, which may change during a run";
    return symbol;
}

/* The position along a distributed load. */
static struct symbol along_symbol(const struct names *names, struct pos at)
{
    size_t parameter;
    const bool given = parameters_find(names->reader, "s", &parameter);
    return given ? two_meanings(names->reader, "s", "the length along the load", at)
                 : slot_symbol(DIM_LENGTH, 1);
}

static struct symbol name_now(struct names *names, const char *name, struct pos at)
{
    struct reader *reader = names->reader;
    const char *dot = strchr(name, '.');
    if (names->along && strcmp(name, "s") == 0) return along_symbol(names, at);
    if (own_states_name(reader, name))
        return reader->definition_readers->state(names, name + strlen("states."), at);
    if (dot) return or_force(names, name, dotted_symbol(names, name, dot, at), at);
    if (strcmp(name, "t") == 0) return time_symbol();
    size_t parameter;
    if (parameters_find(reader, name, &parameter))
        return means_coordinate(names, name, at) ? failed_before : constant_symbol(names, parameter, at);
    struct symbol own = own_symbol(names, name);
    if (own.kind != symbol_unknown) return own;
    if (names->tried && strcmp(name, "s") == 0) return slot_symbol(DIM_NONE, 0);
    struct symbol state = reader->definition_readers->state(names, name, at);
    if (state.kind != symbol_unknown) return state;
    if (strcmp(name, "g") == 0) return reader->definition_readers->gravity(reader, at);
    if (strcmp(name, "slip") == 0) return names->slip ? slip_symbol(names) : misplaced_slip(names, at);
    const bool of_force = names->place == place_load || names->distance_known;
    if (of_force && strcmp(name, "distance") == 0) return distance_symbol(names, at);
    struct symbol other = is_declared(names, name) ? force_symbol(names, name)
                                                   : or_force(names, name, other_symbol(names, name), at);
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
    return names->reader->definition_readers->table(names->reader, name, at);
}

/* Has the name another meaning, as the letter of a force? */
static bool means_else(struct names *names, const char *name, struct pos at)
{
    struct reader *reader = names->reader;
    const size_t absolutes = reader->scene->absolute_count;
    const char *const *tables;
    const size_t count = names_list_tables(names, &tables);
    const bool known = look_up(names, name, at).kind != symbol_unknown;
    reader->scene->absolute_count = absolutes;
    for (size_t i = 0; i < count; i++)
        if (strcmp(tables[i], name) == 0) return true;
    return known;
}

static struct symbol names_section(void *context, const char *name, double x, struct pos at)
{
    struct names *names = context;
    struct symbol symbol = section_symbol(names, name, x, at);
    const bool hidden = symbol.kind != symbol_unknown && means_else(names, name, at);
    symbol.free = !hidden;
    names->section_hidden |= hidden;
    return hidden && !names->sections ? unknown : symbol;
}

struct scope names_scope(struct names *names)
{
    return (struct scope){.lookup = look_up,
                          .table = look_up_table,
                          .tables = names_list_tables,
                          .sense = names_sense,
                          .at_length = names_section,
                          .names = names_list,
                          .context = names,
                          .units = names->reader->scene->units};
}
