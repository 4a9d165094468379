/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/schema_rules.h"

#include <string.h>

#include "scene/language.h"

/* Keys of which a mapping needs at least one alternative; keys joined by `+` are needed together. */
static const struct {
    const char *name, *keys;
} needs[] = {
    {"body", "mass parts"},
    {"part", "mass"},
    {"inertia", "value radius_of_gyration"},
    {"table", "file points"},
    {"hand", "equation conserved"},
    {"force_applied", "value fx fy"},
    {"force_drag", "linear quadratic"},
    {"force_thrust", "exhaust velocity"},
    {"force_friction", "coefficient static kinetic"},
    {"moment_friction", "coefficient static kinetic bearing+radius"},
    {"coupling_actuator", "moment force"},
    {"coupling_plane_friction", "static kinetic"},
    {"contact", "between among"},
    {"rod", "length from+to"},
    {"sphere", "radius"},
    {"cylinder", "radius"},
    {"disc", "radius"},
    {"disk", "radius"},
    {"solid_cylinder", "radius"},
    {"hollow_cylinder", "outer_radius+inner_radius"},
    {"prism", "a+b b+c a+c"},
    {"rectangular_prism", "a+b b+c a+c"},
    {"ring", "radius"},
    {"polygon", "corners"},
    {"thin_ring", "radius"},
};

const char *schema_needs(const char *name)
{
    for (size_t i = 0; name && i < sizeof needs / sizeof *needs; i++)
        if (strcmp(needs[i].name, name) == 0) return needs[i].keys;
    return NULL;
}

void schema_add_needs(struct text *text, const char *keys)
{
    text_add(text, "\"anyOf\": [{\"required\": [\"");
    for (const char *c = keys; *c; c++) {
        if (*c == ' ')
            text_add(text, "\"]}, {\"required\": [\"");
        else if (*c == '+')
            text_add(text, "\", \"");
        else
            text_add_bytes(text, c, 1);
    }
    text_add(text, "\"]}]");
}

/* ---- exclusions: pairs of keys joined by `+` */

static const struct {
    const char *name, *pairs;
} exclusions[] = {
    {"simulate", "accuracy+tolerance accuracy+step"},
    {"event", "then+stop"},
    {"hand", "equation+conserved conserved+impact"},
    {"table", "file+points"},
    {"part", "shape+inertia"},
    {"inertia", "value+radius_of_gyration"},
    {"body",
     "shape+inertia parts+mass parts+shape parts+inertia parts+length parts+radius parts+outer_radius "
     "parts+inner_radius parts+a parts+b parts+c parts+from parts+to parts+center parts+angle parts+axis"},
    {"rod", "from+length from+center from+angle to+length to+center to+angle"},
    {"motion_slide", "line+along line+through line+on"},
    {"force_applied", "value+fx value+fy toward+fx toward+fy toward+angle toward+frame"},
    {"coupling_actuator", "moment+force moment+along"},
    {"coupling_gear", "efficiency+from"},
    {"coupling_plane_friction", "at+points"},
    {"contact", "among+between among+side among+surface_speed"},
    {"force_thrust", "exhaust+velocity velocity+angle velocity+frame"},
    {"force_friction", "coefficient+static coefficient+kinetic"},
    {"moment_friction", "coefficient+static coefficient+kinetic bearing+static bearing+kinetic "
                        "bearing+coefficient bearing+surface_speed"},
    {"force_spring", "free_length+neutral to+neutral"},
};

static const char *find_exclusions(const char *name)
{
    for (size_t i = 0; name && i < sizeof exclusions / sizeof *exclusions; i++)
        if (strcmp(exclusions[i].name, name) == 0) return exclusions[i].pairs;
    return NULL;
}

void schema_add_exclusions(struct text *text, const char *name)
{
    const char *pairs = find_exclusions(name);
    if (!pairs) return;
    text_add(text, ",\n\"not\": {");
    schema_add_needs(text, pairs);
    text_add(text, "}");
}

/* ---- shapes */

/* Exclude the dimensions that a shape does not have, and pairs of its keys that exclude each other. */
static void refuse_others(struct text *text, int shape, const char *name)
{
    struct text others = {0};
    const char *key, *pairs = find_exclusions(name);
    bool taken;
    for (size_t i = 0; (key = shape_dimension(i, shape, &taken)) != NULL; i++)
        if (!taken) text_printf(&others, "%s%s", others.length ? " " : "", key);
    if (pairs) text_printf(&others, " %s", pairs);
    text_add(text, "\"not\": {");
    if (others.data && !others.failed) schema_add_needs(text, others.data);
    text->failed |= others.failed;
    text_free(&others);
    text_add(text, "}");
}

/* Require the dimensions of a shape, unless its moment of inertia is given, and exclude those that it does
 * not have. */
void schema_add_shapes(struct text *text)
{
    const struct field *shape = &part_group.fields[0];
    while (strcmp(shape->key, "shape") != 0) shape++;
    for (size_t i = 0; i < shape->choice_count; i++) {
        const char *name = shape->choices[i].name, *keys = schema_needs(name);
        if (!name) continue;
        text_printf(
            text,
            "%s{\"if\": {\"required\": [\"shape\"], \"properties\": {\"shape\": {\"const\": \"%s\"}}, "
            "\"not\": {\"required\": [\"inertia\"]}},\n\"then\": {",
            i > 0 ? ",\n" : "", name);
        if (keys) schema_add_needs(text, keys);
        if (keys) text_add(text, ", ");
        refuse_others(text, shape->choices[i].value, name);
        text_add(text, "}}");
    }
    text_add(text, ",\n{\"if\": {\"not\": {\"required\": [\"shape\"]}},\n\"then\": {");
    refuse_others(text, shape_point, NULL);
    text_add(text, "}}");
}
