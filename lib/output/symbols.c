/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/symbols.h"

#include <stdio.h>
#include <string.h>

#include "dynamics/friction.h"
#include "expr/glyph.h"
#include "model/tree.h"

/* One force of the scene, whichever diagram it stands in. */
struct force_key {
    const char *letter;
    enum key_of { of_load, of_tie, of_joint } of;
    int index;
};

struct naming {
    const struct fbd_state *state;
    struct arena *arena;
    struct force_key *keys; /* in the order of their first appearance */
    size_t count;
};

/* ---- which force it is */

static bool key_of_tie(const struct fbd_model *model, int b, const char *name, struct force_key *key)
{
    for (int i = 0; model->tree && i < model->tree->tie_count; i++) {
        const struct tie *tie = &model->tree->ties[i];
        for (int k = 0; k < tie->end_count; k++)
            for (int part = 0; part < 2; part++) {
                const char *own = tie->end[k].name[part];
                if (tie->end[k].body != b || !own || strcmp(own, name) != 0) continue;
                /* a drum between two strands tells them by their parts, their far ends are one each */
                int strand = !tie->law->strands ? 0 : tie->end[k].name[1] ? part : k / 2;
                *key = (struct force_key){tie->law->letters[part], of_tie, 2 * i + strand};
                return true;
            }
    }
    return false;
}

static const char *letter_of_load(const struct model_load *load)
{
    const char *letter = load_law(load->source)->letter;
    return letter ? letter : load->source->name;
}

/* The reaction of the body's own joint, or the opposite of that of a body that it carries ("rod.pin"). */
static struct force_key key_of_joint(const struct fbd_model *model, int b, const char *name)
{
    int joint = b;
    for (size_t c = 0; c < model->body_count; c++) {
        size_t length = strlen(model->bodies[c].name);
        if (model->bodies[c].parent == b && strncmp(name, model->bodies[c].name, length) == 0 &&
            name[length] == '.')
            joint = (int)c;
    }
    bool slides = model->bodies[joint].kind == motion_slide || model->bodies[joint].kind == motion_track;
    return (struct force_key){slides ? "N" : "R", of_joint, joint};
}

static struct force_key key_of(const struct fbd_model *model, int b, const struct arrow *arrow)
{
    struct force_key key;
    if (key_of_tie(model, b, arrow->name, &key)) return key;
    if (arrow->load < 0) return key_of_joint(model, b, arrow->name);
    const struct model_load *load = &model->loads[arrow->load];
    bool joint = load->source->kind == load_normal; /* what a slide without one calls its guide */
    return (struct force_key){letter_of_load(load), joint ? of_joint : of_load,
                              joint ? load->body : arrow->load};
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

/* ---- what it is called */

const char *symbol_of_mass(const struct fbd_model *model, int body, struct arena *arena)
{
    return model->body_count == 1 ? "m" : arena_printf(arena, "m_%d", body + 1);
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
    if (load->source->kind != load_friction || body->friction < 0 ||
        naming->state->slip[body->friction] == stick)
        return NULL;
    for (size_t i = 0; i < model->load_count; i++)
        if (model->loads[i].body == load->body && model->loads[i].source->kind == load_normal) {
            struct force_key normal = {"N", of_joint, load->body};
            return arena_printf(naming->arena, "mu_k %s", numbered(naming, &normal));
        }
    return NULL;
}

static const char *name_of(struct naming *naming, int b, const struct arrow *arrow)
{
    const struct fbd_model *model = naming->state->model;
    struct force_key key = key_of(model, b, arrow);
    if (strcmp(key.letter, "m g") == 0)
        return arena_printf(naming->arena, "%s g", symbol_of_mass(model, b, naming->arena));
    const char *law =
        arrow->load >= 0 && key.of != of_tie ? slipping(naming, &model->loads[arrow->load]) : NULL;
    if (law) return law;
    bool own = arrow->load >= 0 && (model->loads[arrow->load].source->kind == load_applied ||
                                    model->loads[arrow->load].source->kind == moment_applied);
    return own ? key.letter : numbered(naming, &key);
}

const char *const *const *symbols_of_forces(const struct fbd_state *state, struct arena *arena)
{
    const struct fbd_model *model = state->model;
    struct instant at = state_instant(state);
    struct naming naming = {state, arena, NULL, 0};
    size_t room = 1;
    for (size_t b = 0; b < model->body_count; b++) room += diagram_arrows(model, (int)b);
    naming.keys = ARENA_ARRAY(arena, room, struct force_key);
    struct arrow *arrows = ARENA_ARRAY(arena, diagram_most_arrows(model), struct arrow);
    const char ***symbols = ARENA_ARRAY(arena, model->body_count, const char **);
    if (!naming.keys || !arrows || !symbols) return NULL;
    for (int named = 0; named < 2; named++) /* all are known before any is numbered */
        for (size_t b = 0; b < model->body_count; b++) {
            size_t count = diagram_fill(model, (int)b, &at, state->a, state->slots, arrows);
            if (named) symbols[b] = ARENA_ARRAY(arena, count + 1, const char *);
            if (named && !symbols[b]) return NULL;
            for (size_t i = 0; i < count; i++) {
                struct force_key key = key_of(model, (int)b, &arrows[i]);
                if (!named)
                    take(&naming, &key);
                else if (!(symbols[b][i] = name_of(&naming, (int)b, &arrows[i])))
                    return NULL;
            }
        }
    return (const char *const *const *)symbols;
}

/* ---- as it is printed */

static const struct greek {
    const char *name, *letter;
} greek[] = {
    {"alpha", "α"}, {"beta", "β"}, {"gamma", "γ"}, {"delta", "δ"}, {"theta", "θ"}, {"lambda", "λ"},
    {"mu", "μ"},    {"phi", "φ"},  {"psi", "ψ"},   {"omega", "ω"}, {"rho", "ρ"},   {"tau", "τ"},
};

static const struct greek *greek_of(const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        if (strlen(greek[i].name) == length && memcmp(greek[i].name, name, length) == 0) return &greek[i];
    return NULL;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_word(char c)
{
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80);
}

/* Does an index consist of what Unicode has below the line? */
static size_t low_index(const char *index)
{
    size_t length = 0;
    while (is_digit(index[length])) length++;
    if (length == 0 && (*index == 'k' || *index == 's')) length = 1;
    return is_word(index[length]) || index[length] == '_' ? 0 : length;
}

static void add_low(struct text *text, char c)
{
    if (is_digit(c))
        text_printf(text, "\xE2\x82%c", 0x80 + (c - '0'));
    else
        text_add(text, c == 'k' ? "ₖ" : "ₛ");
}

const char *symbol_printed(const char *symbol, struct arena *arena)
{
    struct text text = {0};
    for (const char *c = symbol; *c;) {
        size_t length = 0;
        while (is_word(c[length])) length++;
        const struct greek *letter = greek_of(c, length);
        size_t low = *c == '_' ? low_index(c + 1) : 0;
        if (letter)
            text_add(&text, letter->letter);
        else if (length)
            text_add_bytes(&text, c, length);
        else if (low)
            for (size_t i = 0; i < low; i++) add_low(&text, c[1 + i]);
        else if (*c != ' ')
            text_add_bytes(&text, c, 1);
        c += letter || length ? length : 1 + low;
    }
    const char *printed = text.failed || !text.data ? NULL : arena_text(arena, text.data, text.length);
    text_free(&text);
    return printed;
}

/* The velocities vx and vy are v with an index. */
static bool is_velocity(const char *word, size_t length)
{
    return length == 2 && word[0] == 'v' && (word[1] == 'x' || word[1] == 'y');
}

/* One word: a Greek letter, a function, the sign of degrees; a letter stands as it is, more of them upright. */
static void write_word(struct text *text, const char *word, size_t length)
{
    bool function = length == 3 && (strncmp(word, "sin", 3) == 0 || strncmp(word, "cos", 3) == 0);
    if (greek_of(word, length) || function)
        text_printf(text, "\\%.*s ", (int)length, word);
    else if (length == 3 && strncmp(word, "deg", 3) == 0)
        text_add(text, "^\\circ");
    else if (length > 1 && !is_digit(*word))
        text_printf(text, "\\mathit{%.*s}", (int)length, word);
    else
        text_add_bytes(text, word, length);
}

void symbol_write_latex(struct text *text, const char *symbol)
{
    static const char dot[] = "_dot";
    bool below = false;
    for (const char *c = symbol; *c;) {
        size_t length = 0;
        while (is_word(c[length])) length++;
        bool dotted = length > 0 && strncmp(c + length, dot, strlen(dot)) == 0;
        bool velocity = is_velocity(c, length);
        if (dotted) text_add(text, "\\dot{");
        if (length) write_word(text, c, velocity ? 1 : length);
        if (dotted) text_add(text, "}");
        if (velocity) text_printf(text, "_{%c}", c[1]);
        c += length + (dotted ? strlen(dot) : 0);
        if (length && below && *c != '_') text_add(text, "}"), below = false;
        if (*c == '_') {
            text_add(text, below ? "\\_" : "_{");
            below = true;
            c++;
        } else if (*c == ' ') {
            bool degrees = strncmp(c + 1, "deg", 3) == 0;
            bool operand = is_word(c[1]) || c[1] == '|' || c[1] == '(';
            bool factor = operand && c > symbol && (is_word(c[-1]) || c[-1] == ')' || c[-1] == '|');
            text_add(text, degrees ? "" : factor ? "\\," : " ");
            c++;
        } else if (*c && !is_word(*c)) {
            text_add_bytes(text, c++, 1);
        }
    }
    if (below) text_add(text, "}");
}
