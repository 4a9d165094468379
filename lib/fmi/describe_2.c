/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * modelDescription.xml by FMI 2.0.5, sections 2.2 and 4.3. The model structure numbers variables from 1;
 * value references start at 0, as in FMI 3.0.
 */
#include "fmi/package.h"

static void begin(const struct package *package, struct text *xml)
{
    xml_head(package, "2.0", "guid", xml);
    if (package->extras.exchanges)
        text_printf(xml, " numberOfEventIndicators=\"%zu\"", package->extras.indicators);
    text_add(xml, ">\n");
    if (package->extras.exchanges)
        xml_interface(package, "ModelExchange", " canNotUseMemoryManagementFunctions=\"true\"", "", xml);
    xml_interface(
        package, "CoSimulation",
        " canHandleVariableCommunicationStepSize=\"true\" canNotUseMemoryManagementFunctions=\"true\""
        " canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\"",
        package->has_derivatives ? " providesDirectionalDerivative=\"true\"" : "", xml);
}

static void causality(enum fmi_causality kind, struct text *xml)
{
    switch (kind) {
    case fmi_independent: text_add(xml, " causality=\"independent\" variability=\"continuous\""); break;
    case fmi_parameter:
        text_add(xml, " causality=\"parameter\" variability=\"fixed\" initial=\"exact\"");
        break;
    case fmi_calculated:
        text_add(xml, " causality=\"calculatedParameter\" variability=\"fixed\" initial=\"calculated\"");
        break;
    case fmi_input: text_add(xml, " causality=\"input\" variability=\"continuous\""); break;
    default: text_add(xml, " causality=\"output\" variability=\"continuous\" initial=\"calculated\""); break;
    }
}

static void variable_of(const struct package *package, size_t index, struct text *xml)
{
    const fbd_variable *variable = &package->variables[index];
    enum fmi_causality kind = package_causality(package->model, variable);
    size_t integral = package_integral(variable, index);
    text_add(xml, "    <ScalarVariable");
    xml_variable_name(xml, variable);
    text_printf(xml, " valueReference=\"%zu\"", index);
    xml_description(xml, package, index);
    causality(kind, xml);
    text_add(xml, "><Real");
    xml_units(xml, variable->unit);
    if (kind == fmi_parameter || kind == fmi_input) xml_number(xml, "start", variable->start);
    if (integral > 0) text_printf(xml, " derivative=\"%zu\"", integral + 1);
    if (package->extras.exchanges && package_is_state(package, index)) text_add(xml, " reinit=\"true\"");
    text_add(xml, "/></ScalarVariable>\n");
}

/* Event indicators are no variables here: they come last, and are left out. */
static void extra(const struct package *package, size_t index, struct text *xml)
{
    const struct extra *extra = &package->extras.list[index];
    if (extra->kind == extra_indicator) return;
    text_add(xml, "    <ScalarVariable");
    xml_attribute(xml, "name", extra->name);
    text_printf(xml, " valueReference=\"%zu\"", package->variable_count + index);
    xml_extra_description(xml, extra);
    xml_attribute(xml, "causality", extra->output ? "output" : "local");
    text_add(xml, " variability=\"continuous\" initial=\"calculated\"><Real");
    xml_units(xml, extra->unit);
    if (extra->kind == extra_rate) text_printf(xml, " derivative=\"%zu\"", extra->integral + 1);
    text_add(xml, "/></ScalarVariable>\n");
}

static bool is_motion(fbd_variable_kind kind)
{
    return kind == FBD_VARIABLE_COORDINATE || kind == FBD_VARIABLE_RATE;
}

/* Coordinates and rates are states: they do not depend on inputs directly. */
static void unknown(const struct package *package, size_t index, struct text *xml)
{
    text_printf(xml, "      <Unknown index=\"%zu\"", index + 1);
    if (index < package->variable_count && is_motion(package->variables[index].kind)) {
        if (package_has_states(package))
            text_printf(xml, " dependencies=\"%zu\" dependenciesKind=\"constant\"", index + 1);
        else
            text_add(xml, " dependencies=\"\"");
    }
    text_add(xml, "/>\n");
}

static bool is_extra(const struct package *package, size_t index, enum extra_kind kind)
{
    const size_t count = package->variable_count;
    if (index < count || package->extras.list[index - count].kind != kind) return false;
    return kind != extra_column || package->extras.list[index - count].output;
}

static bool is_output(const struct package *package, size_t index)
{
    if (index >= package->variable_count) return is_extra(package, index, extra_column);
    return package_causality(package->model, &package->variables[index]) == fmi_output;
}

static bool is_derivative(const struct package *package, size_t index)
{
    if (index >= package->variable_count) return is_extra(package, index, extra_rate);
    return package_integral(&package->variables[index], index) > 0;
}

static bool is_initial(const struct package *package, size_t index)
{
    if (index >= package->variable_count)
        return is_extra(package, index, extra_column) || is_extra(package, index, extra_rate);
    return package_is_initial_unknown(package, index);
}

/* Append a list of the model structure, if it is not empty, with the dependencies of its variables. */
static void list(const struct package *package, const char *name,
                 bool belongs(const struct package *, size_t), bool depends, struct text *xml)
{
    bool any = false;
    for (size_t i = 0; i < package->variable_count + package->extras.count; i++) {
        if (!belongs(package, i)) continue;
        if (!any) text_printf(xml, "    <%s>\n", name);
        any = true;
        if (depends)
            unknown(package, i, xml);
        else
            text_printf(xml, "      <Unknown index=\"%zu\"/>\n", i + 1);
    }
    if (any) text_printf(xml, "    </%s>\n", name);
}

static void structure(const struct package *package, struct text *xml)
{
    text_add(xml, "  <ModelStructure>\n");
    list(package, "Outputs", is_output, true, xml);
    if (package_has_states(package)) list(package, "Derivatives", is_derivative, true, xml);
    list(package, "InitialUnknowns", is_initial, false, xml);
    text_add(xml, "  </ModelStructure>\n");
}

void package_describe_2(const struct package *package, struct text *xml)
{
    begin(package, xml);
    package_variables(package, variable_of, extra, xml);
    structure(package, xml);
    text_add(xml, "</fmiModelDescription>\n");
}
