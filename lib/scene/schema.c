/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/schema.h"

#include <assert.h>
#include <string.h>

#include "base/format.h"
#include "scene/language.h"
#include "scene/schema_rules.h"

/* ---- pieces of JSON */

/* Add a comma before every member or entry but the first. */
static void next(struct text *text, bool *first)
{
    if (!*first) text_add(text, ",\n");
    *first = false;
}

static void add_key(struct text *text, bool *first, const char *key)
{
    next(text, first);
    text_json_string(text, key);
    text_add(text, ": ");
}

static void add_doc(struct text *text, const char *doc)
{
    text_add(text, "\"description\": ");
    text_json_string(text, doc);
}

static const char word_schema[] = "{\"type\": \"string\"}";
static const char scalar_schema[] = "{\"type\": [\"string\", \"number\"]}";
static const char pair_schema[] = "{\"type\": \"array\", \"items\": {\"$ref\": \"#/definitions/number\"}, "
                                  "\"minItems\": 2, \"maxItems\": 2}";
static const char polygon_schema[] =
    "{\"type\": \"array\", \"items\": {\"$ref\": \"#/definitions/pair\"}, \"minItems\": 3}";

/* ---- values */

/* Add the default given at the end of the doc string, if it is a value. */
static void add_default(struct text *text, const struct field *field)
{
    const char *said = strstr(field->doc, "default ");
    if (!said) return;
    said += strlen("default ");
    size_t length = strcspn(said, " ,;:)");
    bool number = length > 0 && strspn(said, "0123456789.") >= length && said[length] != ' ';
    bool word = false;
    for (size_t i = 0; i < field->choice_count; i++)
        word = word || (strlen(field->choices[i].name) == length &&
                        memcmp(field->choices[i].name, said, length) == 0);
    if (number) text_printf(text, "\"default\": %.*s, ", (int)length, said);
    if (word) text_printf(text, "\"default\": \"%.*s\", ", (int)length, said);
}

/* A plain number is checked by its sign; a text may be a quantity or an expression. */
static void add_quantity(struct text *text, const struct field *field)
{
    const char *sign = field->flags & positive       ? ", \"exclusiveMinimum\": 0"
                       : field->flags & not_negative ? ", \"minimum\": 0"
                                                     : "";
    text_printf(text, "{\"type\": [\"number\", \"string\"]%s, \"examples\": [", sign);
    text_json_string(text, quantity_example(field->quantity));
    struct text doc = {0};
    text_printf(&doc, "%s; %s", field->doc, quantity_name(field->quantity));
    text_add(text, "], ");
    add_default(text, field);
    if (!doc.failed) add_doc(text, doc.data);
    text->failed |= doc.failed;
    text_free(&doc);
    text_add(text, "}");
}

static void add_words(struct text *text, const struct field *field)
{
    bool first = true;
    text_add(text, "{\"enum\": [");
    for (size_t i = 0; i < field->choice_count; i++) {
        if (!first) text_add(text, ", ");
        first = false;
        text_json_string(text, field->choices[i].name);
    }
    text_add(text, "], ");
    add_default(text, field);
    add_doc(text, field->doc);
    text_add(text, "}");
}

/* The name of a mapping in schema_rules.c, or NULL. */
static const char *name_of(const struct group *group)
{
    return group == &part_group       ? "part"
           : group == &simulate_group ? "simulate"
           : group == &event_group    ? "event"
           : group == &hand_group     ? "hand"
           : group == &inertia_group  ? "inertia"
           : group == &contact_group  ? "contact"
                                      : NULL;
}

/* `name`: of its definition, if that has rules, or NULL. */
static void add_group(struct text *text, const struct group *group, const char *name);

/* The schema of one entry of a collection; NULL kinds and group: any. */
static void add_entry(struct text *text, const struct field *field, enum entries entries)
{
    switch (entries) {
    case each_group: add_group(text, field->group, name_of(field->group)); break;
    case each_kind:
        assert(field->kinds); /* each_kind goes with FIELD_KINDS */
        text_printf(text, "{\"$ref\": \"#/definitions/%ss\"}", field->kinds->noun);
        break;
    case each_number: text_add(text, "{\"$ref\": \"#/definitions/number\"}"); break;
    case each_word: text_add(text, word_schema); break;
    case each_pair: text_add(text, "{\"$ref\": \"#/definitions/pair\"}"); break;
    case each_point:
        text_printf(text, "{\"anyOf\": [%s, {\"$ref\": \"#/definitions/pair\"}]}", word_schema);
        break;
    case each_polygon: text_add(text, polygon_schema); break;
    case one_value: text_add(text, "true"); break;
    }
}

static void add_list(struct text *text, const struct field *field)
{
    text_add(text, "{\"type\": \"array\", \"items\": ");
    add_entry(text, field, field->entries);
    text_add(text, "}");
}

/* A mapping from names of the file to entries. */
static void add_map(struct text *text, const struct field *field)
{
    bool some = field->group == &body_group || field->group == &part_group;
    text_printf(text, "{\"type\": \"object\", \"minProperties\": %d, ", some ? 1 : 0);
    text_add(text, "\"propertyNames\": {\"$ref\": \"#/definitions/name\"}, "
                   "\"additionalProperties\": ");
    if (field->group == &table_group)
        text_add(text, "{\"$ref\": \"#/definitions/table\"}");
    else
        add_entry(text, field, field->entries);
    text_add(text, "}");
}

/* A mapping, list or scalar that is read by code of its own. */
static void add_any(struct text *text, const struct field *field)
{
    if (field->kinds && field->entries == one_value) {
        text_printf(text, "{\"$ref\": \"#/definitions/%ss\"}", field->kinds->noun);
    } else if (field->entries != one_value) {
        text_add(text, "{\"anyOf\": [");
        add_entry(text, field, field->entries);
        text_add(text, ", ");
        add_list(text, field);
        text_add(text, "]}");
    } else if (field->group) {
        add_group(text, field->group, name_of(field->group));
    } else {
        text_add(text, "{\"$ref\": \"#/definitions/place\"}");
    }
}

static void add_plain(struct text *text, const struct field *field)
{
    switch (field->type) {
    case field_name: text_add(text, "{\"$ref\": \"#/definitions/name\"}"); break;
    case field_text:
    case field_scalar: text_add(text, scalar_schema); break;
    case field_flag: text_add(text, "{\"type\": \"boolean\"}"); break;
    case field_vector: text_add(text, "{\"$ref\": \"#/definitions/pair\"}"); break;
    case field_any: add_any(text, field); break;
    case field_list: add_list(text, field); break;
    case field_map:
        if (field->entries != one_value)
            add_map(text, field);
        else if (field->group)
            add_group(text, field->group, name_of(field->group));
        else
            text_add(text, "{\"type\": \"object\"}"); /* `initial` and `exact`: depend on the motion */
        break;
    default: text_add(text, "true"); break;
    }
}

static void add_field(struct text *text, const struct field *field)
{
    if (field->type == field_number || field->type == field_value) {
        add_quantity(text, field);
    } else if (field->type == field_choice) {
        add_words(text, field);
    } else {
        text_add(text, "{");
        add_doc(text, field->doc);
        bool empty = (field->flags & may_be_empty) != 0;
        text_add(text, empty ? ", \"anyOf\": [{\"type\": \"null\"}, " : ", \"allOf\": [");
        add_plain(text, field);
        text_add(text, "]}");
    }
}

/* ---- groups */

static void add_fields(struct text *text, const struct group *group, bool *first)
{
    if (group->base) add_fields(text, group->base, first);
    for (size_t i = 0; i < group->count; i++) {
        const struct field *field = &group->fields[i];
        if (field->type == field_later || field->type == field_terms) continue;
        add_key(text, first, field->key);
        add_field(text, field);
    }
}

static bool list_required(struct text *text, const struct group *group, bool any)
{
    if (group->base) any = list_required(text, group->base, any);
    for (size_t i = 0; i < group->count; i++) {
        if (!(group->fields[i].flags & required)) continue;
        text_add(text, any ? ", " : ", \"required\": [");
        text_json_string(text, group->fields[i].key);
        any = true;
    }
    return any;
}

static bool has_required(const struct group *group)
{
    if (!group) return false;
    for (size_t i = 0; i < group->count; i++)
        if (group->fields[i].flags & required) return true;
    return has_required(group->base);
}

/* The field of all keys with a dot, or NULL. */
static const struct field *terms_of(const struct group *group)
{
    for (size_t i = 0; i < group->count; i++)
        if (group->fields[i].type == field_terms) return &group->fields[i];
    return NULL;
}

static void add_terms(struct text *text, const struct field *terms)
{
    text_add(text,
             "\"minProperties\": 2,\n\"patternProperties\": {\"[.]\": {\"type\": [\"number\", \"string\"], ");
    add_doc(text, terms->doc);
    text_add(text, "}},\n");
}

/* The members of the schema of a mapping. */
static void add_members(struct text *text, const struct group *group, const char *name)
{
    bool first = true;
    text_add(text, "\"type\": \"object\", ");
    add_doc(text, group->doc);
    text_add(text, ",\n\"properties\": {\n");
    add_fields(text, group, &first);
    text_add(text, "},\n");
    if (terms_of(group)) add_terms(text, terms_of(group));
    text_add(text, "\"additionalProperties\": false");
    if (list_required(text, group, false)) text_add(text, "]");
    const char *keys = schema_needs(name);
    if (keys) {
        text_add(text, ",\n");
        schema_add_needs(text, keys);
    }
    schema_add_exclusions(text, name);
    if (group != &part_group) return;
    text_add(text, ",\n\"allOf\": [\n");
    schema_add_shapes(text);
    text_add(text, "]");
}

static void add_mapping(struct text *text, const struct group *group, const char *name)
{
    text_add(text, "{");
    add_members(text, group, name);
    text_add(text, "}");
}

static const struct field *brief_of(const struct group *group)
{
    for (const struct group *part = group; part && group->brief; part = part->base)
        for (size_t i = 0; i < part->count; i++)
            if (strcmp(part->fields[i].key, group->brief) == 0) return &part->fields[i];
    return NULL;
}

/* Start the alternatives of a group; editors show the description beside its name. */
static void start_choice(struct text *text, const struct group *group)
{
    text_add(text, "{");
    add_doc(text, group->doc);
    text_add(text, ", \"anyOf\": [");
}

/* A mapping, or a single value for its main key. */
static void add_group(struct text *text, const struct group *group, const char *name)
{
    const struct field *brief = brief_of(group);
    if (group == &body_group) {
        text_add(text, "{\"$ref\": \"#/definitions/body\"}");
        return;
    }
    if (brief) start_choice(text, group);
    add_mapping(text, group, name);
    if (!brief) return;
    text_add(text, ", ");
    text_add(text, brief->type == field_any ? "{\"$ref\": \"#/definitions/place\"}" : scalar_schema);
    text_add(text, "]}");
}

/* ---- kinds */

/* True if a kind is allowed without keys. */
static bool may_be_bare(const struct kinds *kinds, const struct kind *kind)
{
    char name[64];
    format_into(name, sizeof name, "%s_%s", kinds->noun, kind->name);
    return !schema_needs(name) && !has_required(kind->group);
}

/* The names of kinds that are allowed without keys; an empty `enum` is no valid schema. */
static void add_bare_kinds(struct text *text, const struct kinds *kinds, unsigned motion)
{
    bool any = false;
    for (size_t i = 0; i < kinds->count; i++) {
        const struct kind *kind = &kinds->kinds[i];
        if (!(kind->motions & motion) || !may_be_bare(kinds, kind)) continue;
        text_add(text, any ? ", " : "{\"enum\": [");
        any = true;
        text_json_string(text, kind->name);
    }
    if (any) text_add(text, "]},\n");
}

/* One of the kinds that `motion` allows, a bit or all of them. */
static void add_kinds(struct text *text, const struct kinds *kinds, unsigned motion)
{
    bool first = true;
    text_add(text, "{\"anyOf\": [");
    add_bare_kinds(text, kinds, motion);
    text_add(text, "{\"type\": \"object\", \"minProperties\": 1, \"maxProperties\": 1, "
                   "\"additionalProperties\": false, \"properties\": {\n");
    for (size_t i = 0; i < kinds->count; i++) {
        const struct kind *kind = &kinds->kinds[i];
        if (!(kind->motions & motion)) continue;
        add_key(text, &first, kind->name);
        text_printf(text, "{\"$ref\": \"#/definitions/%s_%s\"}", kinds->noun, kind->name);
    }
    text_add(text, "}}]}");
}

static void define_kinds(struct text *text, const struct kinds *kinds, bool *first)
{
    char name[64];
    for (size_t i = 0; i < kinds->count; i++) {
        const struct kind *kind = &kinds->kinds[i];
        format_into(name, sizeof name, "%s_%s", kinds->noun, kind->name);
        add_key(text, first, name);
        bool empty = may_be_bare(kinds, kind);
        if (empty) {
            start_choice(text, kind->group);
            text_add(text, "{\"type\": \"null\"}, ");
        }
        add_group(text, kind->group, name);
        if (empty) text_add(text, "]}");
    }
    format_into(name, sizeof name, "%ss", kinds->noun);
    add_key(text, first, name);
    add_kinds(text, kinds, ~0u);
}

/* ---- a body: rules that depend on its motion */

static void add_of_motion(struct text *text, const char *key, const struct kinds *kinds, unsigned motion)
{
    text_printf(text, ",\n\"%s\": {\"anyOf\": [", key);
    add_kinds(text, kinds, motion);
    text_add(text, ", {\"type\": \"array\", \"items\": ");
    add_kinds(text, kinds, motion);
    text_add(text, "}]}");
}

static void add_motion_rules(struct text *text)
{
    text_add(text, ",\n\"allOf\": [\n");
    schema_add_shapes(text);
    for (size_t i = 0; i < motion_kinds.count; i++) {
        const struct kind *kind = &motion_kinds.kinds[i];
        text_printf(text,
                    ",\n{\"if\": {\"required\": [\"motion\"], \"properties\": {\"motion\": {\"anyOf\": "
                    "[{\"const\": \"%s\"}, "
                    "{\"type\": \"object\", \"required\": [\"%s\"]}]}}},\n\"then\": {\"properties\": "
                    "{\n\"initial\": ",
                    kind->name, kind->name);
        add_group(text, &initial_groups[kind->value], NULL);
        text_add(text, ",\n\"exact\": ");
        add_group(text, &exact_groups[kind->value], NULL);
        add_of_motion(text, "forces", &force_kinds, 1u << kind->value);
        add_of_motion(text, "moments", &moment_kinds, 1u << kind->value);
        text_add(text, "}}}");
    }
    text_add(text, "]");
}

/* ---- the whole schema */

static void define(struct text *text, bool *first, const char *name, const char *schema)
{
    add_key(text, first, name);
    text_add(text, schema);
}

static void define_table(struct text *text, bool *first)
{
    add_key(text, first, "table");
    text_add(text, "{\"anyOf\": [");
    add_mapping(text, &table_group, "table");
    text_add(
        text,
        ", {\"type\": \"string\"}, {\"type\": \"array\", \"items\": {\"$ref\": \"#/definitions/pair\"}}]}");
}

static void define_body(struct text *text, bool *first)
{
    add_key(text, first, "body");
    text_add(text, "{");
    add_members(text, &body_group, "body");
    add_motion_rules(text);
    text_add(text, "}");
}

void schema_write(struct text *text)
{
    bool first = true;
    text_add(text, "{\n\"$schema\": \"http://json-schema.org/draft-07/schema#\",\n"
                   "\"title\": \"fbd: free-body diagrams that run\",\n\"definitions\": {\n");
    define(text, &first, "number",
           "{\"type\": [\"number\", \"string\"], \"description\": \"a number, a quantity (30 deg) or an "
           "expression\"}");
    define(text, &first, "name", "{\"type\": \"string\", \"pattern\": \"^[A-Za-z_][A-Za-z0-9_]*$\"}");
    define(text, &first, "pair", pair_schema);
    define(text, &first, "place",
           "{\"anyOf\": [{\"type\": [\"string\", \"number\"]}, {\"$ref\": \"#/definitions/pair\"}]}");
    const struct kinds *const kinds[] = {&motion_kinds, &force_kinds, &moment_kinds, &coupling_kinds};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) define_kinds(text, kinds[i], &first);
    define_table(text, &first);
    define_body(text, &first);
    text_add(text, "},\n");
    add_members(text, &scene_group, NULL);
    text_add(text, "\n}\n");
}
