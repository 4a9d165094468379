/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmi/package.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "fbd_view.h"

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

static void exponent(struct text *xml, const char *base, double exponent)
{
    if (exponent != 0) text_printf(xml, " %s=\"%d\"", base, (int)exponent);
}

static bool is_whole(const fbd_unit *unit)
{
    return unit->mass == trunc(unit->mass) && unit->length == trunc(unit->length) &&
           unit->time == trunc(unit->time);
}

/* The number of radians in the name of a unit, which its dimension does not contain. */
static int radians(const char *name)
{
    return strncmp(name, "rad", 3) == 0 ? 1 : strstr(name, "/rad") ? -1 : 0;
}

/* Angles, their rates and accelerations: the unit, and that in degrees. */
static const char *const displays[][2] = {{"rad", "deg"}, {"rad/s", "deg/s"}, {"rad/s^2", "deg/s^2"}};

const char *package_display_unit(const char *unit)
{
    for (size_t i = 0; i < sizeof displays / sizeof displays[0]; i++)
        if (strcmp(displays[i][0], unit) == 0) return displays[i][1];
    return NULL;
}

void xml_units(struct text *xml, const char *unit)
{
    const char *display = package_display_unit(unit);
    if (unit[0]) xml_attribute(xml, "unit", unit);
    if (display) xml_attribute(xml, "displayUnit", display);
}

static void write_display(struct text *xml, const char *unit)
{
    const double degrees = 57.29577951308232; /* in a radian */
    const char *display = package_display_unit(unit);
    if (!display) return;
    text_add(xml, "<DisplayUnit");
    xml_attribute(xml, "name", display);
    xml_number(xml, "factor", degrees);
    text_add(xml, "/>");
}

static void write_unit(struct text *xml, const char *name)
{
    fbd_unit unit;
    text_add(xml, "    <Unit");
    xml_attribute(xml, "name", name);
    if (!fbd_unit_read(NULL, name, strlen(name), &unit) || !is_whole(&unit)) {
        text_add(xml, "/>\n");
        return;
    }
    text_add(xml, "><BaseUnit");
    exponent(xml, "kg", unit.mass);
    exponent(xml, "m", unit.length);
    exponent(xml, "s", unit.time);
    exponent(xml, "rad", radians(name));
    if (unit.factor != 1) xml_number(xml, "factor", unit.factor);
    text_add(xml, "/>");
    write_display(xml, name);
    text_add(xml, "</Unit>\n");
}

static const char *unit_of(const struct package *package, size_t index)
{
    const size_t count = package->variable_count;
    return index < count ? package->variables[index].unit : package->extras.list[index - count].unit;
}

static bool is_first(const struct package *package, size_t index)
{
    for (size_t i = 0; i < index; i++)
        if (strcmp(unit_of(package, i), unit_of(package, index)) == 0) return false;
    return true;
}

static void write_units(const struct package *package, struct text *xml)
{
    text_add(xml, "  <UnitDefinitions>\n");
    for (size_t i = 0; i < package->variable_count + package->extras.count; i++)
        if (unit_of(package, i)[0] && is_first(package, i)) write_unit(xml, unit_of(package, i));
    text_add(xml, "  </UnitDefinitions>\n");
}

/* ---- the description */

void xml_head(const struct package *package, const char *version, const char *token, struct text *xml)
{
    const char *title = fbd_model_title(package->model);
    text_add(xml, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription");
    xml_attribute(xml, "fmiVersion", version);
    xml_attribute(xml, "modelName", package->name);
    xml_attribute(xml, token, package->token);
    if (title[0]) xml_attribute(xml, "description", title);
    xml_attribute(xml, "license", "GPL-3.0-or-later");
    xml_attribute(xml, "generationTool", "fbd " FBD_VERSION);
    xml_attribute(xml, "variableNamingConvention", "structured");
}

void xml_interface(const struct package *package, const char *name, const char *capabilities,
                   const char *others, struct text *xml)
{
    text_printf(xml, "  <%s", name);
    xml_attribute(xml, "modelIdentifier", package->name);
    text_printf(xml, "%s%s/>\n", capabilities, others);
}

static void experiment(const struct package *package, struct text *xml)
{
    text_add(xml, "  <LogCategories>\n"
                  "    <Category name=\"logStatusError\" description=\"errors\"/>\n"
                  "    <Category name=\"logStatusWarning\" description=\"warnings\"/>\n"
                  "    <Category name=\"logEvents\" description=\"events of the motion\"/>\n"
                  "  </LogCategories>\n  <DefaultExperiment startTime=\"0\"");
    xml_number(xml, "stopTime", package->until);
    xml_number(xml, "tolerance", package->tolerance);
    text_add(xml, "/>\n");
}

void package_variables(const struct package *package, xml_variable *variable, xml_variable *extra,
                       struct text *xml)
{
    write_units(package, xml);
    experiment(package, xml);
    text_add(xml, "  <ModelVariables>\n");
    for (size_t i = 0; i < package->variable_count; i++) variable(package, i, xml);
    for (size_t i = 0; i < package->extras.count; i++) extra(package, i, xml);
    text_add(xml, "  </ModelVariables>\n");
}

/* ---- variables */

enum fmi_causality package_causality(const fbd_model *model, const fbd_variable *variable)
{
    switch (variable->kind) {
    case FBD_VARIABLE_TIME: return fmi_independent;
    case FBD_VARIABLE_PARAMETER:
        return fbd_model_parameter(model, variable->index).derived ? fmi_calculated : fmi_parameter;
    case FBD_VARIABLE_INPUT: return fmi_input;
    default: return fmi_output;
    }
}

bool package_is_initial_unknown(const struct package *package, size_t index)
{
    enum fmi_causality kind = package_causality(package->model, &package->variables[index]);
    return kind == fmi_output || kind == fmi_calculated;
}

bool package_has_derivatives(fbd_state *state)
{
    const fbd_model *model = fbd_state_model(state);
    size_t count = fbd_model_variable_count(model);
    bool has_points = fbd_model_variable(model, count - 1).kind == FBD_VARIABLE_POINT;
    return !has_points && fbd_state_derivatives(state, NULL, 0, NULL, NULL);
}

bool package_has_states(const struct package *package)
{
    return package->has_derivatives || package->extras.exchanges;
}

bool package_is_state(const struct package *package, size_t index)
{
    const fbd_variable_kind kind = package->variables[index].kind;
    return kind == FBD_VARIABLE_COORDINATE || kind == FBD_VARIABLE_RATE || kind == FBD_VARIABLE_STATE;
}

size_t package_integral(const fbd_variable *variable, size_t index)
{
    bool derivative = variable->kind == FBD_VARIABLE_RATE || variable->kind == FBD_VARIABLE_ACCELERATION;
    return derivative ? index - 1 : 0;
}

void package_variable_name(const fbd_variable *variable, struct text *text)
{
    if (variable->kind == FBD_VARIABLE_TIME)
        text_add(text, "time");
    else
        text_printf(text, "%s%s%s", variable->owner, variable->owner[0] ? "." : "", variable->name);
}

/* Append an attribute whose value is `text`, which is freed. */
static void take_attribute(struct text *xml, const char *name, struct text *text)
{
    if (!text->failed && text->data) xml_attribute(xml, name, text->data);
    xml->failed |= text->failed;
    text_free(text);
}

void xml_variable_name(struct text *xml, const fbd_variable *variable)
{
    struct text name = {0};
    package_variable_name(variable, &name);
    take_attribute(xml, "name", &name);
}

void xml_description(struct text *xml, const struct package *package, size_t index)
{
    const fbd_variable *variable = &package->variables[index];
    struct text text = {0};
    switch (variable->kind) {
    case FBD_VARIABLE_TIME: text_add(&text, "simulated time"); break;
    case FBD_VARIABLE_PARAMETER:
        text_add(&text, package_causality(package->model, variable) == fmi_calculated
                            ? "parameter that the model file defines by others"
                            : "parameter of the model file");
        break;
    case FBD_VARIABLE_INPUT: {
        const char *description = fbd_model_parameter(package->model, variable->index).description;
        text_add(&text, description[0] ? description : "input: constant between communication points");
        break;
    }
    case FBD_VARIABLE_COORDINATE: text_add(&text, "coordinate"); break;
    case FBD_VARIABLE_RATE:
    case FBD_VARIABLE_ACCELERATION:
        text_add(&text, "rate of change of ");
        package_variable_name(variable - 1, &text);
        break;
    case FBD_VARIABLE_STATE: text_add(&text, "state of the model file"); break;
    case FBD_VARIABLE_POINT: text_add(&text, "of a point"); break;
    }
    take_attribute(xml, "description", &text);
}

void xml_extra_description(struct text *xml, const struct extra *extra)
{
    static const char *const of_columns[] = {[FBD_COLUMN_FORCE] = "force, moment or reaction",
                                             [FBD_COLUMN_ENERGY] = "energy",
                                             [FBD_COLUMN_WORK] = "work since the start"};
    static const char *const others[] = {[extra_rate] = "rate of change of a state of the model file",
                                         [extra_indicator] = "event indicator: negative past an event"};
    xml_attribute(xml, "description",
                  extra->kind == extra_column ? of_columns[extra->column] : others[extra->kind]);
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
    return number_read(text, strlen(text), number);
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
    if (strcmp(line, "outputs") == 0) settings->outputs = value;
    if (strcmp(line, "structure") == 0) settings->run.no_structure = true;
    return strcmp(line, "method") == 0 || strcmp(line, "outputs") == 0 || strcmp(line, "structure") == 0;
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
