/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/symbols.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/printed.h"
#include "dynamics/friction.h"
#include "model/tree.h"

/* One force of the scene, in any diagram. */
struct force_key {
    const char *letter;
    enum key_of { of_load, of_coupling, of_corner, of_joint } of; /* of_corner: of one end of a coupling */
    int index;
    int owner;   /* the body on which it acts in the sense of its symbol; no_body: at each end */
    bool moment; /* at all times */
};

enum { no_body = -1 };

struct naming {
    const struct fbd_state *state;
    struct arena *arena;
    struct force_key *keys; /* in the order of their first appearance */
    size_t count;
};

/* ---- which force it is */

/* The strand of part `part` of end k: a drum between two strands has a part of each, their far ends have one. */
static int strand_of(const struct coupling *coupling, int k, int part)
{
    return !coupling->law->strands ? 0 : coupling->end[k].name[1] ? part : k / 2;
}

/* The pulls of a rope at its ends are not opposite where it passes over corners. */
static int owner_of_coupling(const struct coupling *coupling, int strand)
{
    int owner = no_body;
    if (coupling->law->way && !coupling->law->strands && coupling->end_count > 2) return no_body;
    for (int k = 0; k < coupling->end_count; k++)
        for (int part = 0; part < 2; part++) {
            const int body = coupling->end[k].body;
            if (body < 0 || !coupling->end[k].name[part] || strand_of(coupling, k, part) != strand) continue;
            if (owner == no_body || body < owner) owner = body;
        }
    return owner;
}

/* True where a rope passes over a point of the body: its force there is the sum of two pulls. */
static bool is_corner(const struct coupling *coupling, int k)
{
    return coupling->law->way && !coupling->law->strands && k > 0 && k + 1 < coupling->end_count;
}

/* The end of a ratio at the body that has the coordinate of end k. */
static int bearing_end(const struct coupling *coupling, int k)
{
    return coupling->source->terms[k].opposite ? k - 1 : k;
}

/* True for rolling resistance, for the ratio of an angle, and for the stop of a pivot. */
static bool is_couple(const struct fbd_model *model, const struct coupling *coupling, int k)
{
    if (coupling->kind == constraint_resistance) return true;
    if (coupling->kind == constraint_ratio)
        return coupling->source->terms[k].coordinate ==
               model->bodies[coupling->end[bearing_end(coupling, k)].body].joint->angle;
    return coupling->kind == constraint_contact && coupling->source->contact.stop != 0 &&
           model->bodies[coupling->end[0].body].joint->has_axis;
}

bool coupling_of_force(const struct fbd_model *model, int b, const char *name, struct coupling_place *place)
{
    for (int i = 0; i < model->tree->coupling_count; i++) {
        const struct coupling *coupling = &model->tree->couplings[i];
        for (int k = 0; k < coupling->end_count; k++)
            for (int part = 0; part < 2; part++) {
                const char *own = coupling->end[k].name[part];
                if (coupling->end[k].body != b || !own || strcmp(own, name) != 0) continue;
                *place = (struct coupling_place){i, k, part, strand_of(coupling, k, part)};
                return true;
            }
    }
    return false;
}

const char *drawing_of_force(const struct fbd_model *model, int b, const char *name, int load)
{
    struct coupling_place place;
    if (coupling_of_force(model, b, name, &place)) {
        const enum constraint_kind kind = model->tree->couplings[place.coupling].kind;
        if ((kind == constraint_contact || kind == constraint_roll) && place.part == 1) return "friction";
    }
    return load < 0 ? "reaction" : load_law(model->loads[load].source)->drawing;
}

static bool key_of_coupling(const struct fbd_model *model, int b, const char *name, struct force_key *key)
{
    struct coupling_place place;
    if (!coupling_of_force(model, b, name, &place)) return false;
    const struct coupling *coupling = &model->tree->couplings[place.coupling];
    const bool moment = is_couple(model, coupling, place.end), ratio = coupling->kind == constraint_ratio;
    const int end = ratio ? bearing_end(coupling, place.end) : place.end;
    if (ratio || is_corner(coupling, place.end))
        *key = (struct force_key){.letter = moment ? "M" : "F",
                                  .of = of_corner,
                                  .index = most_constraint_ends * place.coupling + end,
                                  .owner = ratio ? coupling->end[end].body : b,
                                  .moment = moment};
    else
        *key = (struct force_key){.letter = moment ? "M" : coupling->law->letters[place.part],
                                  .of = of_coupling,
                                  .index = 2 * place.coupling + place.strand,
                                  .owner = owner_of_coupling(coupling, place.strand),
                                  .moment = moment};
    return true;
}

/* A normal force replaces the force `guide` of a slide without one. */
static struct force_key key_of_load(const struct fbd_model *model, int index)
{
    const struct model_load *load = &model->loads[index];
    const struct law *law = load_law(load->source);
    struct force_key key = {law->letter ? law->letter : load->source->name, of_load, index, load->body,
                            false};
    switch (load->source->kind) {
    case load_normal:
        key.of = of_joint;
        key.index = load->body;
        break;
    case load_drive: key.moment = coordinate_is_angle(&model->bodies[load->body], 0); break;
    case moment_applied:
    case moment_spring:
    case moment_damper:
    case moment_friction:
    case moment_potential: key.moment = true; break;
    default: break;
    }
    if (load->source->kind == load_drive && key.moment) key.letter = "M";
    if (index >= (int)model->listed_count && load->linked && load->partner >= 0 && load->partner < key.owner)
        key.owner = load->partner;
    return key;
}

/* The reaction of the body's own joint, or the opposite of that of a body that it carries ("rod.pin"). */
static struct force_key key_of_joint(const struct fbd_model *model, int b, const char *name)
{
    int joint = b;
    for (size_t c = 0; c < model->body_count; c++) {
        const struct model_body *child = &model->bodies[c];
        if (child->parent == b && child->reaction_on_parent && strcmp(name, child->reaction_on_parent) == 0)
            joint = (int)c;
    }
    const struct joint_type *type = model->bodies[joint].joint;
    return (struct force_key){type->letter, of_joint, joint, joint, type->prevents_turning};
}

static struct force_key key_of(const struct fbd_model *model, int b, const struct arrow *arrow)
{
    struct force_key key;
    if (key_of_coupling(model, b, arrow->name, &key)) return key;
    return arrow->load < 0 ? key_of_joint(model, b, arrow->name) : key_of_load(model, arrow->load);
}

static bool is_same(const struct force_key *a, const struct force_key *b)
{
    return a->of == b->of && a->index == b->index && strcmp(a->letter, b->letter) == 0;
}

static bool take(struct naming *naming, const struct force_key *key)
{
    for (size_t i = 0; i < naming->count; i++)
        if (is_same(&naming->keys[i], key)) return true;
    naming->keys[naming->count++] = *key;
    return true;
}

/* ---- names */

const char *symbol_of_mass(const struct fbd_model *model, int body, struct arena *arena)
{
    const char *name = model->scene->bodies[body].mass_name;
    if (name) return name;
    const struct parameter *given = scene_mass_parameter(model->scene, body + 1);
    const double mass = model->bodies[body].inertia.mass;
    const bool of_another = given && fabs(given->value - mass) > 1e-12 * fabs(mass);
    return model->body_count == 1 || of_another ? "m" : arena_printf(arena, "m_%d", body + 1);
}

static const char *numbered(struct naming *naming, const struct force_key *key)
{
    size_t rank = 0, all = 0;
    for (size_t i = 0; i < naming->count; i++) {
        if (strcmp(naming->keys[i].letter, key->letter) != 0) continue;
        all++;
        if (is_same(&naming->keys[i], key)) rank = all;
    }
    return all > 1 ? arena_printf(naming->arena, "%s_%zu", key->letter, rank) : key->letter;
}

/* Friction that slips is mu_k N of its own surface. */
static const char *slipping(struct naming *naming, const struct model_load *load)
{
    const struct fbd_model *model = naming->state->model;
    const struct model_body *body = &model->bodies[load->body];
    const bool turns = body->source->motion.turns; /* N is not all of the force across it */
    if (load->source->kind != load_friction || body->friction < 0 || turns ||
        naming->state->slip[body->friction] == stick)
        return NULL;
    for (size_t i = 0; i < model->load_count; i++)
        if (model->loads[i].body == load->body && model->loads[i].source->kind == load_normal) {
            struct force_key normal = key_of_load(model, (int)i);
            return arena_printf(naming->arena, "mu_k %s", numbered(naming, &normal));
        }
    return NULL;
}

/* A force with a name in the file keeps it, unless two bodies have that name. */
static bool is_named_once(const struct naming *naming, const struct force_key *key,
                          const struct model_load *load)
{
    const struct model_load *loads = naming->state->model->loads;
    if (key->of != of_load || load_law(load->source)->letter) return false;
    for (size_t i = 0; i < naming->count; i++) {
        const struct force_key *other = &naming->keys[i];
        if (other->of == of_load && other->index != key->index &&
            !load_law(loads[other->index].source)->letter && strcmp(other->letter, key->letter) == 0)
            return false;
    }
    return true;
}

static struct force_symbol symbol_of(struct naming *naming, int b, const struct arrow *arrow)
{
    const struct fbd_model *model = naming->state->model;
    const struct model_load *load = arrow->load >= 0 ? &model->loads[arrow->load] : NULL;
    const struct force_key key = key_of(model, b, arrow);
    struct force_symbol symbol = {.moment = key.moment,
                                  .opposite = key.owner >= 0 && key.owner != b,
                                  .letter = key.letter,
                                  .joint = key.of == of_joint ? key.index : -1};
    if (load && key.of == of_load && load->source->kind == load_gravity)
        symbol.text = arena_printf(naming->arena, "%s g", symbol_of_mass(model, b, naming->arena));
    else if (load && is_named_once(naming, &key, load))
        symbol.text = key.letter;
    else
        symbol.text = numbered(naming, &key);
    if (load && key.of == of_load) symbol.slipping = slipping(naming, load);
    return symbol;
}

const char *symbol_now(const struct force_symbol *symbol)
{
    return symbol->slipping ? symbol->slipping : symbol->text;
}

const struct force_symbol *const *symbols_of_forces(const struct fbd_state *state, struct arena *arena)
{
    const struct fbd_model *model = state->model;
    struct instant at = state_instant(state);
    struct naming naming = {state, arena, NULL, 0};
    size_t room = 1;
    for (size_t b = 0; b < model->body_count; b++) room += diagram_arrows(model, (int)b);
    naming.keys = ARENA_ARRAY(arena, room, struct force_key);
    struct arrow *arrows = ARENA_ARRAY(arena, diagram_most_arrows(model), struct arrow);
    struct force_symbol **symbols = ARENA_ARRAY(arena, model->body_count, struct force_symbol *);
    if (!naming.keys || !arrows || !symbols) return NULL;
    for (int named = 0; named < 2; named++) /* collect all before numbering */
        for (size_t b = 0; b < model->body_count; b++) {
            size_t count = diagram_fill(model, (int)b, &at, state->slots, arrows);
            if (named) symbols[b] = ARENA_ARRAY(arena, count + 1, struct force_symbol);
            if (named && !symbols[b]) return NULL;
            for (size_t i = 0; i < count; i++) {
                struct force_key key = key_of(model, (int)b, &arrows[i]);
                if (!named)
                    take(&naming, &key);
                else
                    symbols[b][i] = symbol_of(&naming, (int)b, &arrows[i]);
            }
        }
    return arena->failed ? NULL : (const struct force_symbol *const *)symbols;
}

/* ---- printing */

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_word(char c)
{
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80);
}

const char *symbol_printed(const char *symbol, struct arena *arena)
{
    struct text text = {0};
    text_symbol(&text, symbol);
    const char *printed = text.failed || !text.data ? NULL : arena_text(arena, text.data, text.length);
    text_free(&text);
    return printed;
}

/* The velocities vx and vy are v with an index. */
static bool is_velocity(const char *word, size_t length)
{
    return length == 2 && word[0] == 'v' && (word[1] == 'x' || word[1] == 'y');
}

/* Write one word: a Greek letter, a function; a single letter in italics, longer words upright. */
static void write_word(struct text *text, const char *word, size_t length)
{
    bool function = length == 3 && (strncmp(word, "sin", 3) == 0 || strncmp(word, "cos", 3) == 0);
    if (greek_letter(word, length) || function)
        text_printf(text, "\\%.*s ", (int)length, word);
    else if (length > 1 && !is_digit(*word))
        text_printf(text, "\\mathit{%.*s}", (int)length, word);
    else
        text_add_bytes(text, word, length);
}

/* Write a unit, "[deg]" or "[m]"; returns its length. */
static size_t write_unit(struct text *text, const char *unit)
{
    const size_t length = strcspn(unit, "]") + 1;
    if (strncmp(unit, "[deg]", length) == 0)
        text_add(text, "^\\circ");
    else
        text_printf(text, "\\,\\mathrm{%.*s}", (int)length - 2, unit + 1);
    return length;
}

/* The length of "_dot" or "_ddot" at the end of a name, 0 for neither. */
static size_t dots_behind(const char *text)
{
    static const char *const ends[] = {"_dot", "_ddot"};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
        if (strncmp(text, ends[i], strlen(ends[i])) == 0) return strlen(ends[i]);
    return 0;
}

void symbol_write_latex(struct text *text, const char *symbol)
{
    bool below = false;
    for (const char *c = symbol; *c;) {
        size_t length = 0;
        while (is_word(c[length])) length++;
        const size_t dots = length > 0 ? dots_behind(c + length) : 0;
        bool velocity = is_velocity(c, length);
        if (dots) text_add(text, dots == strlen("_dot") ? "\\dot{" : "\\ddot{");
        if (length) write_word(text, c, velocity ? 1 : length);
        if (dots) text_add(text, "}");
        if (velocity) text_printf(text, "_{%c}", c[1]);
        c += length + dots;
        if (length && below && *c != '_') text_add(text, "}"), below = false;
        if (*c == '_') {
            text_add(text, below ? "\\_" : "_{");
            below = true;
            c++;
        } else if (*c == ' ') {
            bool operand = is_word(c[1]) || c[1] == '|' || c[1] == '(';
            bool factor = operand && c > symbol && (is_word(c[-1]) || strchr(")|]", c[-1]));
            text_add(text, factor ? "\\," : " ");
            c++;
        } else if (*c == '[') {
            c += write_unit(text, c);
        } else if (*c && !is_word(*c)) {
            text_add_bytes(text, c++, 1);
        }
    }
    if (below) text_add(text, "}");
}
