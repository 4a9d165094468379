/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names in derivations by hand: accelerations of bodies, and forces and moments of the diagrams. Only a
 * compiled model has the list of forces: without it a derivation with an otherwise unknown name is skipped,
 * and read again later (hand_forces.h).
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/names.h"
#include "scene/reader.h"

static const struct symbol unknown = {.kind = symbol_unknown};

/* True if the names are equal without underscores. */
static bool is_letter(const char *letter, const char *name)
{
    for (;; letter++, name++) {
        while (*letter == '_') letter++;
        while (*name == '_') name++;
        if (*letter != *name) return false;
        if (!*letter) return true;
    }
}

/* True for push_x as another form of push.x. */
static bool is_component(const char *component, const char *name)
{
    const size_t length = strlen(component);
    return length > 2 && component[length - 2] == '.' && strlen(name) == length && name[length - 2] == '_' &&
           memcmp(component, name, length - 2) == 0 && component[length - 1] == name[length - 1];
}

static const struct force_name *find_in(const struct reader *reader, int body, const char *name)
{
    for (size_t i = 0; i < reader->force_name_count; i++) {
        const struct force_name *one = &reader->force_names[i];
        if (one->body == body && strcmp(one->name, name) == 0) return one;
    }
    for (size_t i = 0; i < reader->force_name_count; i++) {
        const struct force_name *one = &reader->force_names[i];
        if (one->body == body && one->letter && is_letter(one->name, name)) return one;
    }
    for (size_t i = 0; i < reader->force_name_count; i++) {
        const struct force_name *one = &reader->force_names[i];
        if (one->body == body && is_component(one->name, name)) return one;
    }
    return NULL;
}

bool names_take_force(const struct names *names)
{
    return names->of_force == absolute_work || names->of_force == absolute_impulse;
}

bool names_sense(void *context, const char *word)
{
    static const struct {
        const char *word;
        enum hand_sense sense;
        enum absolute_kind of_force;
    } known[] = {{"initial", sense_initial, absolute_force},
                 {"before", sense_before, absolute_force},
                 {"after", sense_after, absolute_force},
                 {"work", sense_now, absolute_work},
                 {"impulse", sense_now, absolute_impulse}};
    struct names *names = context;
    const bool inside = names->place != place_hand || names->sense != sense_now || names_take_force(names);
    if (!word) {
        names->sense = sense_now;
        names->of_force = absolute_force;
    }
    for (size_t i = 0; word && !inside && i < sizeof known / sizeof *known; i++) {
        if (strcmp(known[i].word, word) != 0) continue;
        names->sense = known[i].sense;
        names->of_force = known[i].of_force;
        return true;
    }
    return false;
}

/* True for the name of a component, or of a coordinate of the point of application. Work is that of a whole
 * force. */
static bool is_part(const struct force_name *force)
{
    const char *dot = strrchr(force->name, '.'), last = force->name[strlen(force->name) - 1];
    return force->dim.mass == 0 || (force->letter && (last == 'x' || last == 'y')) ||
           (dot && (strcmp(dot, ".x") == 0 || strcmp(dot, ".y") == 0));
}

/* Find a force. For work also forces without a signed size are found, by the name of their x component. */
static const struct force_name *find(const struct names *names, int body, const char *name)
{
    const struct force_name *one = find_in(names->reader, body, name);
    if (names->of_force != absolute_work) return one;
    if (one) return is_part(one) ? NULL : one;
    const char *component = arena_printf(names->reader->arena, "%s.x", name);
    return component ? find_in(names->reader, body, component) : NULL;
}

/* The body of `body.name`, and the name behind the dot; the current body for any other name. */
static int split_name(const struct names *names, const char **name)
{
    const struct scene *scene = names->reader->scene;
    const char *dot = strchr(*name, '.');
    for (size_t b = 0; dot && b < scene->body_count; b++) {
        const char *body = scene->bodies[b].name;
        if (!body || strlen(body) != (size_t)(dot - *name) || strncmp(body, *name, strlen(body)) != 0)
            continue;
        *name = dot + 1;
        return (int)b;
    }
    return names->body;
}

/* A force `body.name` of another body. */
static const struct force_name *find_dotted(const struct names *names, const char *name)
{
    const char *own = name;
    const int body = split_name(names, &own);
    return own != name ? find(names, body, own) : NULL;
}

/* `a_Gx` is `G.a_x`. */
static bool is_acceleration_of(const struct body *owner, const char *name, struct absolute *place)
{
    const size_t length = strlen(name);
    if (length < 4 || strncmp(name, "a_", 2) != 0) return false;
    const char axis = name[length - 1];
    place->kind = axis == 'x' ? absolute_ax : absolute_ay;
    return (axis == 'x' || axis == 'y') && names_point(owner, name + 2, length - 3, &place->point);
}

struct symbol hand_place_symbol(const struct names *names, int body, const char *name)
{
    const struct body *owner = &names->reader->scene->bodies[body];
    struct absolute place = {.body = body, .point = {.kind = point_fixed}};
    const char *dot = strrchr(name, '.'), *last = dot ? dot + 1 : name;
    const bool x = strcmp(last, "a_x") == 0, y = strcmp(last, "a_y") == 0;
    if (!dot && strcmp(name, "angle_ddot") == 0) {
        place.kind = absolute_alpha;
    } else if (!dot && strncmp(name, "I_", 2) == 0) {
        place.kind = absolute_inertia;
        if (!names_point(owner, name + 2, strlen(name + 2), &place.point)) return unknown;
    } else if (x || y) {
        place.kind = x ? absolute_ax : absolute_ay;
        if (!names_point(owner, dot ? name : "G", dot ? (size_t)(dot - name) : 1, &place.point))
            return unknown;
    } else if (dot || !is_acceleration_of(owner, name, &place)) {
        return unknown;
    }
    return names_absolute(names->reader, place_hand, &place);
}

static struct symbol slot_of(const struct names *names, const struct absolute *force, struct dim dim)
{
    struct absolute wanted = *force;
    if (names_take_force(names)) wanted.kind = names->of_force;
    struct symbol symbol = names_absolute(names->reader, place_hand, &wanted);
    symbol.dim = dim;
    if (wanted.kind == absolute_work) symbol.dim = DIM_MOMENT;
    if (wanted.kind == absolute_impulse) symbol.dim = dim_times(dim, DIM_TIME);
    return symbol;
}

/* ---- section forces */

struct symbol section_symbol(const struct names *names, const char *name, double x, struct pos at)
{
    static const char symbols[] = "NVM";
    const char *own = name;
    const int body = split_name(names, &own);
    const char *one = own[0] && !own[1] ? strchr(symbols, own[0]) : NULL;
    if (!one || names->place != place_hand || names->sense != sense_now || names_take_force(names))
        return unknown;
    const struct absolute section = {.body = body,
                                     .point = {.kind = point_fixed, .where = {x, 0}},
                                     .kind = absolute_section,
                                     .part = (int)(one - symbols),
                                     .at = at};
    if (isnan(x)) return (struct symbol){.kind = symbol_variable};
    return slot_of(names, &section, *one == 'M' ? DIM_MOMENT : DIM_FORCE);
}

/* ---- symbols declared in the file */

/* The force of that name on the first body that has it: a size is the same on all bodies. */
static const struct force_name *find_anywhere(const struct names *names, const char *name)
{
    const struct reader *reader = names->reader;
    const size_t length = strlen(name);
    if (length > 2 && name[length - 2] == '.') return NULL; /* components depend on the body */
    for (size_t b = 0; b < reader->scene->body_count; b++) {
        const struct force_name *one = find(names, (int)b, name);
        if (one) return one;
    }
    return NULL;
}

/* The value of `name` under `symbols`, of the body or at the top level. */
static const struct node *declared(const struct names *names, const char *name)
{
    const struct node *own = names->reader->drafts[names->body].keys.symbols;
    const struct pair *pair = own && own->kind == node_map ? node_find(own, name) : NULL;
    if (!pair && names->reader->symbols) pair = node_find(names->reader->symbols, name);
    return pair ? pair->value : NULL;
}

bool is_declared(const struct names *names, const char *name)
{
    return names->place == place_hand && declared(names, name) != NULL;
}

static size_t count_of(const struct node *value)
{
    return value->kind == node_list ? value->count : 1;
}

static bool add_force(const struct names *names, const struct node *item, struct force_sum *sum,
                      struct dim *dim)
{
    struct reader *reader = names->reader;
    const char *name = item->text;
    const bool minus = *name == '-';
    while (*name == '-' || *name == '+' || *name == ' ') name++;
    const struct force_name *one = find(names, names->body, name);
    if (!one) one = find_dotted(names, name);
    if (!one) one = find_anywhere(names, name);
    if (!one) {
        const char *const *known;
        size_t count = names_list((void *)names, &known);
        diag_add(reader->errors, FBD_ERROR, "unknown-name", item->at,
                 diag_nearest(reader->errors, name, known, count), "no force of a diagram is called `%s`",
                 name);
        return false;
    }
    if (sum->count > 0 && !dim_equal(*dim, one->dim)) {
        diag_add(reader->errors, FBD_ERROR, "wrong-dimension", item->at, NULL,
                 "a symbol cannot be the sum of a force and a moment");
        return false;
    }
    *dim = one->dim;
    const char *own = arena_text(reader->arena, one->name, strlen(one->name));
    sum->forces[sum->count++] = (struct signed_force){one->body, own, minus ? -1 : 1};
    return own != NULL;
}

static struct symbol sum_symbol(const struct names *names, const char *name, const struct force_sum *sum,
                                struct dim dim)
{
    const char *key = arena_printf(names->reader->arena, "=%s", name); /* distinct from names of diagrams */
    const struct absolute force = {.body = names->body,
                                   .point = {.kind = point_fixed},
                                   .kind = absolute_force,
                                   .force = key,
                                   .sum = sum};
    return key ? slot_of(names, &force, dim) : (struct symbol){.kind = symbol_failed};
}

static struct symbol declared_symbol(const struct names *names, const char *name, const struct node *value)
{
    static const struct symbol noted = {.kind = symbol_failed};
    struct reader *reader = names->reader;
    struct force_sum *sum = ARENA_NEW(reader->arena, struct force_sum);
    struct dim dim = DIM_NONE;
    if (sum) sum->forces = ARENA_ARRAY(reader->arena, count_of(value), struct signed_force);
    if (!sum || !sum->forces) return noted;
    for (size_t i = 0; i < count_of(value); i++)
        if (!add_force(names, value->kind == node_list ? value->items[i] : value, sum, &dim)) return noted;
    return sum_symbol(names, name, sum, dim);
}

bool symbols_check(struct reader *reader, const struct node *symbols)
{
    bool fine = true;
    for (size_t i = 0; symbols && symbols->kind == node_map && i < symbols->count; i++) {
        const struct pair *pair = &symbols->pairs[i];
        size_t parameter;
        fine = name_check(reader->errors, pair->key, pair->at, "a symbol") && fine;
        if (parameters_find(reader, pair->key, &parameter) || name_is_reserved(pair->key)) {
            diag_add(reader->errors, FBD_ERROR, "duplicate-name", pair->at, "choose another letter",
                     "`%s` is %s already", pair->key,
                     name_is_reserved(pair->key) ? "reserved" : "a parameter");
            fine = false;
        }
        for (size_t k = 0; k < count_of(pair->value); k++) {
            const struct node *item = pair->value->kind == node_list ? pair->value->items[k] : pair->value;
            if (item->kind == node_scalar && item->length > 0) continue;
            diag_add(reader->errors, FBD_ERROR, "wrong-type", item->at,
                     "write the name of a force, as `T: cord`, or a list of them",
                     "a symbol is a force of a diagram");
            fine = false;
        }
    }
    return fine;
}

/* ---- numbered bodies */

/* With several bodies in the order of the file: m_2, L_2, I_O2, I_G2 in the derivations of the second, and
 * the mass in all derivations. */
struct symbol hand_numbered_symbol(const struct names *names, const char *name)
{
    static const char *const bases[] = {"m_", "L_", "I_O", "I_G"};
    const size_t count = names->reader->scene->body_count;
    for (size_t i = 0; count > 1 && i < sizeof bases / sizeof *bases; i++) {
        const size_t length = strlen(bases[i]);
        if (strncmp(name, bases[i], length) != 0 || name[length] < '1' || name[length] > '9') continue;
        char *end;
        const unsigned long number = strtoul(name + length, &end, 10);
        if (*end || number > count) continue;
        if (i == 0 && scene_mass_parameter(names->reader->scene, (int)number)) return unknown;
        if (i == 0) return mass_symbol(names, (int)number - 1, "m");
        return (int)number != names->body + 1 ? unknown
                                              : hand_symbol(names, i == 1   ? "L"
                                                                   : i == 2 ? "I_O"
                                                                            : "I_G");
    }
    return unknown;
}

/* ---- forces and declared symbols */

/* True for a normal force or friction of the contact or roll `name`: `floor.normal`, `floor.friction_2`. */
static bool is_of_contact(const struct force_name *force, const char *name)
{
    const size_t length = strlen(name);
    const char *part = force->name + length + 1;
    if (strncmp(force->name, name, length) != 0 || force->name[length] != '.' || is_part(force)) return false;
    const size_t word = strncmp(part, "normal", 6) == 0 ? 6 : strncmp(part, "friction", 8) == 0 ? 8 : 0;
    return word > 0 && (part[word] == '\0' || (part[word] == '_' && !strchr(part, '.')));
}

/* The work of a contact or roll: the sum over all its normal forces and friction on the body. */
static struct symbol contact_symbol(const struct names *names, const char *name)
{
    const struct reader *reader = names->reader;
    const char *contact = name;
    const int body = split_name(names, &contact);
    struct force_sum *sum = ARENA_NEW(reader->arena, struct force_sum);
    if (names->of_force != absolute_work || !sum) return unknown;
    sum->forces = ARENA_ARRAY(reader->arena, reader->force_name_count, struct signed_force);
    for (size_t i = 0; sum->forces && i < reader->force_name_count; i++) {
        const struct force_name *one = &reader->force_names[i];
        if (one->body != body || !is_of_contact(one, contact)) continue;
        const char *own = arena_text(reader->arena, one->name, strlen(one->name));
        if (!own) return (struct symbol){.kind = symbol_failed};
        sum->forces[sum->count++] = (struct signed_force){body, own, 1};
    }
    return sum->count > 0 ? sum_symbol(names, name, sum, DIM_FORCE) : unknown;
}

struct symbol force_symbol(const struct names *names, const char *name)
{
    struct reader *reader = names->reader;
    const struct node *value = declared(names, name);
    if (!reader->force_names) {
        reader->scene->hands_left = true;
        return (struct symbol){.kind = symbol_failed};
    }
    if (value) return declared_symbol(names, name, value);
    const struct force_name *one = find(names, names->body, name);
    if (!one) one = find_dotted(names, name);
    if (!one) return contact_symbol(names, name);
    const char *own = arena_text(reader->arena, one->name, strlen(one->name));
    if (!own) return (struct symbol){.kind = symbol_failed};
    const struct absolute force = {.body = one->body,
                                   .point = {.kind = point_fixed},
                                   .kind = absolute_force,
                                   .force = own};
    return slot_of(names, &force, one->dim);
}
