/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmi/package.h"

#include <stdio.h>
#include <string.h>

#include "expr/expr.h"

/* ---- XML */

void xml_attribute(struct text *xml, const char *name, const char *value)
{
    text_printf(xml, " %s=\"", name);
    for (const char *c = value; *c; c++) {
        const char *entity = *c == '&'   ? "&amp;"
                             : *c == '<' ? "&lt;"
                             : *c == '>' ? "&gt;"
                             : *c == '"' ? "&quot;"
                                         : NULL;
        bool control = (unsigned char)*c < ' ';
        if (entity)
            text_add(xml, entity);
        else
            text_add_bytes(xml, control ? " " : c, 1);
    }
    text_add(xml, "\"");
}

void xml_number(struct text *xml, const char *name, double value)
{
    text_printf(xml, " %s=\"", name);
    text_exact(xml, value);
    text_add(xml, "\"");
}

/* ---- units */

static void exponent(struct text *xml, const char *base, int twelfths)
{
    if (twelfths != 0) text_printf(xml, " %s=\"%d\"", base, twelfths / dim_unit);
}

static bool is_whole(struct dim dim)
{
    return dim.mass % dim_unit == 0 && dim.length % dim_unit == 0 && dim.time % dim_unit == 0;
}

/* The number of radians in the name of a unit, which its dimension does not contain. */
static int radians(const char *name)
{
    return strncmp(name, "rad", 3) == 0 ? dim_unit : strstr(name, "/rad") ? -dim_unit : 0;
}

static void write_unit(struct text *xml, const char *name)
{
    struct unit unit;
    text_add(xml, "    <Unit");
    xml_attribute(xml, "name", name);
    bool known =
        unit_parse(name, strlen(name), unit_si, NULL, (struct pos){0, 0}, &unit) && is_whole(unit.dim);
    if (!known) {
        text_add(xml, "/>\n");
        return;
    }
    text_add(xml, "><BaseUnit");
    exponent(xml, "kg", unit.dim.mass);
    exponent(xml, "m", unit.dim.length);
    exponent(xml, "s", unit.dim.time);
    exponent(xml, "rad", radians(name));
    if (unit.factor != 1) xml_number(xml, "factor", unit.factor);
    text_add(xml, "/></Unit>\n");
}

static bool is_first(const struct fmi_variables *variables, size_t index)
{
    for (size_t i = 0; i < index; i++)
        if (strcmp(variables->list[i].unit, variables->list[index].unit) == 0) return false;
    return true;
}

void package_units(const struct package *package, struct text *xml)
{
    const struct fmi_variables *variables = &package->variables;
    text_add(xml, "  <UnitDefinitions>\n");
    for (size_t i = 0; i < variables->count; i++)
        if (variables->list[i].unit[0] && is_first(variables, i)) write_unit(xml, variables->list[i].unit);
    text_add(xml, "  </UnitDefinitions>\n");
}

void package_says(const struct package *package, const struct fmi_variable *variable, struct text *text)
{
    const struct fmi_variable *list = package->variables.list;
    switch (variable->kind) {
    case fmi_time: text_add(text, "simulated time"); break;
    case fmi_parameter: text_add(text, "parameter of the model file"); break;
    case fmi_calculated: text_add(text, "parameter that the model file defines by others"); break;
    case fmi_input:
        text_add(text, variable->description[0] ? variable->description
                                                : "input: constant between communication points");
        break;
    case fmi_coordinate: text_add(text, "coordinate"); break;
    case fmi_rate:
    case fmi_acceleration: text_printf(text, "rate of change of %s", list[variable->integral].name); break;
    case fmi_state: text_add(text, "state of the model file"); break;
    case fmi_point: text_add(text, "of a point, in the world"); break;
    }
}

/* ---- the token */

const uint64_t package_hash_start = UINT64_C(0xCBF29CE484222325);

/* FNV-1a of 64 bits (RFC 9923). */
uint64_t package_hash(uint64_t before, const void *bytes, size_t length)
{
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < length; i++) before = (before ^ byte[i]) * UINT64_C(0x100000001B3);
    return before;
}

void package_token(const char *text, size_t length, const char *settings, char token[package_token_size])
{
    uint64_t a = package_hash(package_hash_start, text, length);
    uint64_t b = package_hash(a, FBD_VERSION "\n", strlen(FBD_VERSION) + 1);
    b = package_hash(b, settings, strlen(settings));
    snprintf(token, package_token_size, "{%08X-%04X-%04X-%04X-%012llX}", (unsigned)(a >> 32),
             (unsigned)(a >> 16 & 0xFFFFu), (unsigned)(a & 0xFFFFu), (unsigned)(b >> 48),
             (unsigned long long)(b & UINT64_C(0xFFFFFFFFFFFF)));
}

/* ---- settings */

static bool take_number(const char *text, double *number)
{
    return expr_number(text, strlen(text), number);
}

static bool take_set(struct package_settings *settings, char *text)
{
    char *blank = strchr(text, ' ');
    if (!blank) return false;
    *blank = '\0';
    settings->list[settings->count++] = (fbd_setting){text, blank + 1};
    return true;
}

static bool take_table(struct package_settings *settings, const char *name, const char *resources)
{
    const char *path = arena_printf(&settings->arena, "%s/tables/%s", resources, name);
    settings->list[settings->count++] = (fbd_setting){name, path};
    return path != NULL;
}

static bool take_line(struct package_settings *settings, char *line, const char *resources)
{
    char *value = strchr(line, ' ');
    if (!value) return false;
    *value++ = '\0';
    if (strcmp(line, "set") == 0) return take_set(settings, value);
    if (strcmp(line, "table") == 0) return take_table(settings, value, resources);
    if (strcmp(line, "until") == 0) return take_number(value, &settings->run.until);
    if (strcmp(line, "tolerance") == 0) return take_number(value, &settings->run.tolerance);
    if (strcmp(line, "step") == 0) return take_number(value, &settings->run.step);
    if (strcmp(line, "method") == 0) settings->run.method = value;
    if (strcmp(line, "structure") == 0) settings->run.no_structure = true;
    return strcmp(line, "method") == 0 || strcmp(line, "structure") == 0;
}

bool package_settings_read(struct package_settings *settings, char *text, const char *resources)
{
    size_t lines = 1;
    for (const char *c = text; *c; c++) lines += *c == '\n';
    *settings = (struct package_settings){.run = FBD_OPTIONS_DEFAULT};
    settings->list = ARENA_ARRAY(&settings->arena, lines, fbd_setting);
    if (!settings->list) return false;
    for (char *line = text, *end; (end = strchr(line, '\n')) != NULL; line = end + 1) {
        *end = '\0';
        if (!take_line(settings, line, resources)) return false;
    }
    return true;
}

void package_settings_free(struct package_settings *settings)
{
    arena_free(&settings->arena);
    *settings = (struct package_settings){0};
}
