/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/fields.h"

#include "scene/slip_law.h"
#include "scene/values.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

enum { most_fields = 40 };

static bool is_field(const struct field *field, const char *key)
{
    return strcmp(field->key, key) == 0 || (field->type == field_terms && strchr(key, '.'));
}

/* The field with this key and its offset in the structure of the group; the base of the group comes first. */
static const struct field *find_field(const struct group *group, const char *key, size_t *offset)
{
    if (group->base) {
        const struct field *field = find_field(group->base, key, offset);
        if (field) {
            *offset += group->base_offset;
            return field;
        }
    }
    for (size_t i = 0; i < group->count; i++) {
        if (!is_field(&group->fields[i], key)) continue;
        *offset = group->fields[i].offset;
        return &group->fields[i];
    }
    return NULL;
}

bool fields_has(const struct group *group, const char *key)
{
    size_t offset;
    return find_field(group, key, &offset) != NULL;
}

static size_t list_keys(const struct group *group, const char **keys)
{
    size_t count = group->base ? list_keys(group->base, keys) : 0;
    for (size_t i = 0; i < group->count && count < most_fields; i++)
        if (group->fields[i].type != field_later && group->fields[i].type != field_ignored)
            keys[count++] = group->fields[i].key;
    return count;
}

/* ---- hints for unknown keys */

static bool is_kind(const struct kinds *kinds, const char *name)
{
    for (size_t i = 0; i < kinds->count; i++)
        if (strcmp(kinds->kinds[i].name, name) == 0) return true;
    return false;
}

/* The first kind that has a key, or NULL. */
static const char *kind_with(const struct kinds *kinds, const char *key)
{
    for (size_t i = 0; i < kinds->count; i++)
        if (kinds->kinds[i].group && fields_has(kinds->kinds[i].group, key)) return kinds->kinds[i].name;
    return NULL;
}

/* The field with this key, or one without group and kinds. */
static const struct field *field_below(const struct group *group, const char *key)
{
    static const struct field none = {0};
    size_t offset;
    const struct field *field = find_field(group, key, &offset);
    return field ? field : &none;
}

/* True if the group below the key `outer` has the key `inner`. */
static bool is_below(const struct group *group, const char *outer, const char *inner)
{
    const struct group *below = field_below(group, outer)->group;
    return below && fields_has(below, inner);
}

/* A hint for a key one level too high, as by wrong indentation; else NULL. */
static const char *misplaced(fbd_errors *errors, const struct group *group, const char *key)
{
    const struct kinds *forces = field_below(group, "forces")->kinds,
                       *motions = field_below(group, "motion")->kinds;
    if (forces && is_kind(forces, key))
        return diag_hint(errors, "put it into the list of the body: `forces: [%s]`", key);
    if (motions && is_kind(motions, key))
        return diag_hint(errors, "write it under `motion`: `motion: {%s: ...}`", key);
    const char *motion = motions ? kind_with(motions, key) : NULL;
    if (motion)
        return diag_hint(errors, "it belongs to the motion, as in `motion: {%s: {%s: ...}}`", motion, key);
    if ((fields_has(group, "along") || fields_has(group, "at")) && fields_has(group, "on") &&
        (strcmp(key, "v") == 0 || strcmp(key, "omega") == 0))
        return diag_hint(errors,
                         "the rate at the start belongs to `initial: {%s: ...}`; prescribed is the "
                         "coordinate, as an expression of t",
                         key);
    if (is_below(group, "bodies", key))
        return "it belongs to a body: indent it below the name of the body, under `bodies`";
    if (is_below(group, "simulate", key)) return "it belongs under `simulate`";
    if (is_below(group, "ground", key)) return "it belongs under `ground`";
    return NULL;
}

/* Names of keys in textbooks and other programs, with a hint where the meaning differs. */
static const char *const usual_keys[][3] = {
    {"mu_s", "static"},
    {"mu_k", "kinetic"},
    {"mu_d", "kinetic"},
    {"dynamic", "kinetic"},
    {"mu", "coefficient"},
    {"mu", "kinetic"},
    {"coefficient", "kinetic"},
    {"friction", "kinetic"},
    {"friction_coefficient", "coefficient"},
    {"friction_coefficient", "kinetic"},
    {"e", "restitution"},
    {"bounce", "restitution"},
    {"c", "coefficient"},
    {"k", "stiffness"},
    {"l0", "free_length"},
    {"x0", "neutral"},
    {"rest_length", "free_length"},
    {"U", "V"},
    {"energy", "V"},
    {"c", "linear"},
    {"coefficient", "linear"},
    {"k", "quadratic"},
    {"magnitude", "value"},
    {"F", "value"},
    {"P", "value"},
    {"M", "value"},
    {"force", "value"},
    {"moment", "value"},
    {"x", "fx"},
    {"y", "fy"},
    {"Fx", "fx"},
    {"Fy", "fy"},
    {"direction", "angle"},
    {"direction", "along"},
    {"min", "from"},
    {"max", "to"},
    {"start", "from"},
    {"end", "to"},
    {"weight", "mass", "the key is `mass`, which is the weight divided by g: `mass: \"20[N]/g\"`"},
    {"m", "mass"},
    {"r", "radius"},
    {"R", "radius"},
    {"diameter", "radius", "the key is `radius`: half of the diameter"},
    {"I", "inertia"},
    {"radius_of_gyration", "inertia", "it is one of `inertia: {radius_of_gyration: 12 cm}`"},
    {"position", "initial", "where it starts is `initial: {x: ..., y: ...}`"},
    {"velocity", "initial", "how fast it starts is `initial: {v: ...}`, or `vx` and `vy`"},
    {"speed", "initial", "how fast it starts is `initial: {v: ...}`, or `vx` and `vy`"},
    {"between", "through"},
    {"through", "between"},
    {"position", "x"},
    {"v0", "v"},
    {"x0", "x"},
    {"velocity", "v"},
    {"vx", "v"},
    {"vy", "v"},
    {"speed", "v"},
    {"angle", "theta"},
    {"theta0", "theta"},
    {"omega0", "omega"},
    {"angle", "along"},
    {"duration", "until"},
    {"end", "until"},
    {"tol", "tolerance"},
    {"dt", "step"},
    {"solver", "method"},
    {"stepper", "method"},
    {"condition", "when"},
    {"action", "then"},
};

/* A hint if `word` is a common name of a key of this group; else NULL. */
static const char *translated(fbd_errors *errors, const struct group *group, const char *word)
{
    for (size_t i = 0; i < sizeof usual_keys / sizeof *usual_keys; i++) {
        size_t offset;
        const struct field *field =
            strcmp(word, usual_keys[i][0]) == 0 ? find_field(group, usual_keys[i][1], &offset) : NULL;
        if (field && usual_keys[i][2]) return usual_keys[i][2];
        if (field)
            return diag_replace(errors, word, field->key, "the key is `%s`: %s", field->key, field->doc);
    }
    return NULL;
}

/* A hint for keys given to `gravity`, which has none. */
static const char *not_given(const struct group *group)
{
    if (strcmp(group->name, "`gravity`") == 0)
        return "its value belongs to the top of the file, as `gravity: 9.81`; in the list it is `gravity` "
               "alone";
    return NULL;
}

/* Forces that are there all the time, with hints for them. */
static const char *const lasting[][2] = {
    {"`gravity`",
     "the weight acts all the time; a force in a part of the run is `applied`, as `applied: {value: 5 N, "
     "angle: -90 deg, from: t > 2 s}`"},
    {"`normal`",
     "the normal force acts as long as the body touches; a support that is removed is a contact, under "
     "`contacts`: `until: t > 2 s`"},
    {"`friction`", "friction acts as long as there is a normal force; coefficients may vary, as `kinetic: "
                   "0.3*step(t - 2[s])`"},
};

/* A hint for a condition at which a force begins or ends that is there all the time; else NULL. */
static const char *not_passing(const struct group *group, const char *key)
{
    if (strcmp(key, "from") != 0 && strcmp(key, "until") != 0) return NULL;
    for (size_t i = 0; i < sizeof lasting / sizeof *lasting; i++)
        if (strcmp(group->name, lasting[i][0]) == 0) return lasting[i][1];
    return NULL;
}

static const char in_quotes[] =
    "a comma separates entries inside braces: put the expression in quotes, as `\"min(1, 2)\"`";

/* True if an entry before this one opens a parenthesis that it does not close. */
static bool is_torn(const struct node *map, const struct pair *pair)
{
    int open = 0;
    for (const struct pair *p = map->pairs; p < pair; p++)
        for (const char *c = p->value->kind == node_scalar ? p->value->text : ""; *c; c++)
            open += (*c == '(') - (*c == ')');
    return open > 0;
}

/* A hint for a key without a value that follows a comma inside braces: the comma was meant as part of the
 * value. */
static const char *behind_a_comma(const struct node *map, const struct pair *pair)
{
    if (pair->value->kind != node_null) return NULL;
    if (is_torn(map, pair)) return in_quotes;
    size_t digits = strspn(pair->key, "0123456789");
    if (digits > 0 && (pair->key[digits] == '\0' || pair->key[digits] == ' '))
        return "a comma separates entries inside braces: write a decimal point, as `2.5`";
    if (strchr(pair->key, ')')) return in_quotes;
    return NULL;
}

static void note_unknown_key(struct reader *reader, const struct group *group, const struct node *map,
                             const struct pair *pair)
{
    const char *hint = NULL, *colon = strchr(pair->key, ':');
    if (colon && colon > pair->key && colon[1])
        hint = diag_hint(reader->errors, "put a blank after the colon: `%.*s: %s`", (int)(colon - pair->key),
                         pair->key, colon + 1);
    if (strstr(pair->key, "\xC2\xA0"))
        hint = "it contains a no-break space (U+00A0), as pasted text does: type a blank in its place";
    if (!hint) hint = behind_a_comma(map, pair);
    if (!hint) hint = not_passing(group, pair->key);
    if (!hint) hint = not_given(group);
    if (!hint) hint = misplaced(reader->errors, group, pair->key);
    if (!hint) hint = translated(reader->errors, group, pair->key);
    if (!hint) {
        const char *names[most_fields];
        hint = diag_nearest(reader->errors, pair->key, names, list_keys(group, names));
    }
    diag_add(reader->errors, FBD_ERROR, "unknown-key", pair->at, hint, "%s has no key `%s`", group->name,
             pair->key);
}

static void note_no_mapping(struct reader *reader, const struct group *group, const struct node *node)
{
    const char *names[most_fields];
    size_t count = list_keys(group, names), used = 0;
    char list[256] = "";
    for (size_t i = 0; i < count; i++) {
        int n = snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", names[i]);
        if (n < 0 || (size_t)n >= sizeof list - used) break;
        used += (size_t)n;
    }
    const char *hint = not_given(group);
    if (strcmp(group->name, "`normal`") == 0)
        hint = "it follows from the other forces and has no value: in the list it is `normal` alone";
    diag_add(reader->errors, FBD_ERROR, "wrong-type", node->at,
             hint ? hint : diag_hint(reader->errors, "its keys: %s", list),
             "%s must be a mapping of keys, not %s", group->name, value_found(reader, node));
}

static void note_missing_key(struct reader *reader, const struct group *group, const struct field *field,
                             struct pos owner)
{
    bool number = field->type == field_number || field->type == field_value;
    const char *hint = number ? diag_hint(reader->errors, "add for example `%s: %s` (%s)", field->key,
                                          quantity_example(field->quantity), field->doc)
                              : diag_hint(reader->errors, "add `%s`: %s", field->key, field->doc);
    diag_add(reader->errors, FBD_ERROR, "missing-key", owner, hint, "%s needs `%s`", group->name, field->key);
}

/* ---- reading */

static bool read_node(struct reader *reader, const struct field *field, const struct node *node,
                      const struct node **place)
{
    const char *key = field->key;
    if (node->kind == node_null && (field->flags & may_be_empty)) return true;
    if (field->type == field_list && node->kind != node_list)
        return value_refuse(reader, node, key, "a list", "write each entry on a line of its own: `- ...`");
    if (field->type == field_map && node->kind != node_map)
        return value_refuse(reader, node, key, "a mapping",
                            "write `name: value` pairs below it, indented, or in braces");
    if (field->type == field_scalar && node->kind != node_scalar)
        return value_refuse(reader, node, key, "text",
                            node->kind == node_null ? NULL : "put an expression that has brackets in quotes");
    if (node->kind == node_null) {
        diag_add(reader->errors, FBD_ERROR, "missing-value", node->at, field->doc,
                 "`%s` has no value: give one, or leave the key out", key);
        return false;
    }
    *place = node;
    return true;
}

static bool read_formula(struct reader *reader, const struct field *field, const struct node *node,
                         const struct scope *scope, void *place)
{
    if (!(field->flags & (slips | slips_not)))
        return value_formula(reader, node, field->key, field->quantity, field->flags, scope, place);
    enum slip_name slip = field->flags & slips ? slip_moving : slip_resting;
    return slip_law_read(reader, node, field->key, field->quantity, field->flags, slip, scope, place);
}

static bool read_field(struct reader *reader, const struct field *field, const struct pair *pair,
                       const struct scope *scope, void *place)
{
    const struct node *node = pair->value;
    const char *key = field->key;
    switch (field->type) {
    case field_text: return value_text(reader, node, key, place);
    case field_name: return value_name(reader, node, key, place);
    case field_flag: return value_flag(reader, node, key, place);
    case field_choice: return value_choice(reader, node, key, field->choices, field->choice_count, place);
    case field_number: return value_number(reader, node, key, field->quantity, field->flags, place);
    case field_value: return read_formula(reader, field, node, scope, place);
    case field_vector: return value_vector(reader, node, key, field->quantity, place);
    case field_any:
    case field_scalar:
    case field_list:
    case field_map: return read_node(reader, field, node, place);
    case field_ignored:
    case field_terms: return true;
    case field_later:
        diag_add(reader->errors, FBD_ERROR, "not-supported", pair->at, field->doc,
                 "`%s` is not in this version", key);
        return false;
    }
    return false;
}

static bool check_required(struct reader *reader, const struct group *group, const struct node *map,
                           struct pos owner)
{
    bool fine = !group->base || check_required(reader, group->base, map, owner);
    for (size_t i = 0; i < group->count; i++) {
        const struct field *field = &group->fields[i];
        if (!(field->flags & required) || node_find(map, field->key)) continue;
        note_missing_key(reader, group, field, owner);
        fine = false;
    }
    return fine;
}

bool fields_read(struct reader *reader, const struct group *group, const struct node *node, struct pos owner,
                 const struct scope *scope, void *keys)
{
    char *start = keys;
    size_t offset = 0;
    const struct field *brief = group->brief ? find_field(group, group->brief, &offset) : NULL;
    bool single = node && (node->kind == node_scalar || node->kind == node_list);
    if (brief && single && (node->kind == node_scalar || brief->type == field_any)) {
        const struct pair pair = {group->brief, node->at, node};
        return read_field(reader, brief, &pair, scope, start + offset);
    }
    if (node && node->kind == node_null) node = NULL;
    if (node && node->kind != node_map) {
        note_no_mapping(reader, group, node);
        return false;
    }
    bool fine = true;
    for (size_t i = 0; node && i < node->count; i++) {
        const struct pair *pair = &node->pairs[i];
        const struct field *field = find_field(group, pair->key, &offset);
        if (!field) note_unknown_key(reader, group, node, pair);
        if (!field || !read_field(reader, field, pair, scope, start + offset)) fine = false;
    }
    return check_required(reader, group, node, owner) && fine;
}

/* ---- kinds */

static const struct kind *find_kind(struct reader *reader, const struct kinds *kinds, const char *name,
                                    struct pos at)
{
    enum { most_kinds = 16 };
    const char *names[most_kinds];
    assert(kinds->count <= most_kinds); /* built-in tables */
    for (size_t i = 0; i < kinds->count; i++) {
        names[i] = kinds->kinds[i].name;
        if (strcmp(names[i], name) == 0) return &kinds->kinds[i];
    }
    const char *hint = NULL;
    for (const struct usual_word *usual = kinds->usual; usual->word && !hint; usual++)
        if (strcmp(name, usual->word) == 0) hint = usual->hint;
    if (!hint && strchr(name, ')')) hint = in_quotes;
    if (!hint) hint = diag_nearest(reader->errors, name, names, kinds->count);
    diag_add(reader->errors, FBD_ERROR, "unknown-kind", at, hint, "no %s is called `%.40s`", kinds->noun,
             name);
    return NULL;
}

/* Note an error for a mapping with several keys: two kinds at once, or a key of a kind beside it instead of
 * inside. */
static void note_several_keys(struct reader *reader, const struct kinds *kinds, const struct node *map)
{
    const struct pair *kind = NULL, *other = NULL;
    for (size_t i = 0; i < map->count; i++) {
        const struct pair *pair = &map->pairs[i];
        if (!is_kind(kinds, pair->key)) {
            if (!other) other = pair;
        } else if (!kind) {
            kind = pair;
        } else {
            diag_add(reader->errors, FBD_ERROR, "conflicting-keys", pair->at, kinds->one,
                     "`%s` and `%s` stand in one entry", kind->key, pair->key);
            return;
        }
    }
    if (!kind) {
        find_kind(reader, kinds, map->pairs[0].key, map->pairs[0].at);
        return;
    }
    const char *hint = diag_hint(reader->errors, "indent it deeper than `%s`, or write `%s: {%s: ...}`",
                                 kind->key, kind->key, other->key);
    diag_add(reader->errors, FBD_ERROR, "unknown-key", other->at, hint, "`%s` belongs in `%s`, not beside it",
             other->key, kind->key);
}

bool kind_read(struct reader *reader, const struct kinds *kinds, const struct node *node, const char *what,
               struct chosen *chosen)
{
    if (node->kind == node_scalar) {
        *chosen = (struct chosen){find_kind(reader, kinds, node->text, node->at), NULL, node->at};
        return chosen->kind != NULL;
    }
    if (node->kind != node_map || node->count == 0) {
        const char *hint =
            diag_hint(reader->errors, "write its kind, as `%s`, or `kind: {...}`", kinds->kinds[0].name);
        char wanted[24];
        snprintf(wanted, sizeof wanted, "a %s", kinds->noun);
        return value_refuse(reader, node, what, wanted, hint);
    }
    if (node->count > 1) {
        note_several_keys(reader, kinds, node);
        return false;
    }
    const struct pair *pair = &node->pairs[0];
    *chosen = (struct chosen){find_kind(reader, kinds, pair->key, pair->at),
                              pair->value->kind == node_null ? NULL : pair->value, pair->at};
    return chosen->kind != NULL;
}

bool fields_exclude(struct reader *reader, const struct node *map, const char *key, const char *other,
                    const char *hint)
{
    const struct pair *first = node_find(map, key), *second = node_find(map, other);
    if (!first || !second) return true;
    if (first > second) {
        const struct pair *later = first;
        first = second;
        second = later;
    }
    diag_add(reader->errors, FBD_ERROR, "conflicting-keys", second->at, hint, "`%s` excludes `%s`",
             first->key, second->key);
    return false;
}
