/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * modelDescription.xml by FMI 3.0.2, sections 2.4 and 4.4.
 */
#include "fmi/package.h"

static void begin(const struct package *package, struct text *xml)
{
    xml_head(package, "3.0", "instantiationToken", xml);
    text_add(xml, ">\n");
    if (package->extras.exchanges)
        xml_interface(package, "ModelExchange", " needsCompletedIntegratorStep=\"true\"", "", xml);
    const char *derivatives =
        package->has_derivatives
            ? " providesDirectionalDerivatives=\"true\" providesAdjointDerivatives=\"true\""
            : "";
    xml_interface(package, "CoSimulation",
                  " canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\""
                  " canHandleVariableCommunicationStepSize=\"true\" mightReturnEarlyFromDoStep=\"true\""
                  " hasEventMode=\"true\"",
                  derivatives, xml);
}

static const char *causality(enum fmi_causality kind)
{
    switch (kind) {
    case fmi_independent: return "independent";
    case fmi_parameter: return "parameter";
    case fmi_calculated: return "calculatedParameter";
    case fmi_input: return "input";
    default: return "output";
    }
}

static void variable_of(const struct package *package, size_t index, struct text *xml)
{
    const fbd_variable *variable = &package->variables[index];
    enum fmi_causality kind = package_causality(package->model, variable);
    bool parameter = kind == fmi_parameter, calculated = kind == fmi_calculated;
    size_t integral = package_integral(variable, index);
    text_add(xml, "    <Float64");
    xml_variable_name(xml, variable);
    text_printf(xml, " valueReference=\"%zu\"", index);
    xml_description(xml, package, index);
    xml_attribute(xml, "causality", causality(kind));
    xml_attribute(xml, "variability", parameter || calculated ? "fixed" : "continuous");
    if (parameter) xml_attribute(xml, "initial", "exact");
    if (calculated || kind == fmi_output) xml_attribute(xml, "initial", "calculated");
    xml_units(xml, variable->unit);
    if (integral > 0) text_printf(xml, " derivative=\"%zu\"", integral);
    if (package->extras.exchanges && package_is_state(package, index)) text_add(xml, " reinit=\"true\"");
    if (parameter || kind == fmi_input) xml_number(xml, "start", variable->start);
    text_add(xml, "/>\n");
}

/* Indicators and rates of user states are of interest to solvers only. */
static void extra(const struct package *package, size_t index, struct text *xml)
{
    const struct extra *extra = &package->extras.list[index];
    text_add(xml, "    <Float64");
    xml_attribute(xml, "name", extra->name);
    text_printf(xml, " valueReference=\"%zu\"", package->variable_count + index);
    xml_extra_description(xml, extra);
    xml_attribute(xml, "causality", extra->output ? "output" : "local");
    text_add(xml, " variability=\"continuous\" initial=\"calculated\"");
    xml_units(xml, extra->unit);
    if (extra->kind == extra_rate) text_printf(xml, " derivative=\"%zu\"", extra->integral);
    text_add(xml, "/>\n");
}

static void extra_unknowns(const struct package *package, enum extra_kind kind, const char *element,
                           struct text *xml)
{
    for (size_t i = 0; i < package->extras.count; i++) {
        const struct extra *extra = &package->extras.list[i];
        if (extra->kind == kind && (extra->output || kind != extra_column))
            text_printf(xml, "    <%s valueReference=\"%zu\"/>\n", element, package->variable_count + i);
    }
}

/* Coordinates and rates are states: they do not depend on inputs directly. */
static void unknown(const struct package *package, const char *element, size_t index, struct text *xml)
{
    fbd_variable_kind kind = package->variables[index].kind;
    text_printf(xml, "    <%s valueReference=\"%zu\"", element, index);
    if (kind == FBD_VARIABLE_COORDINATE || kind == FBD_VARIABLE_RATE) {
        if (package_has_states(package))
            text_printf(xml, " dependencies=\"%zu\" dependenciesKind=\"constant\"", index);
        else
            text_add(xml, " dependencies=\"\"");
    }
    text_add(xml, "/>\n");
}

static void structure(const struct package *package, struct text *xml)
{
    const fbd_variable *variables = package->variables;
    size_t count = package->variable_count;
    text_add(xml, "  <ModelStructure>\n");
    for (size_t i = 0; i < count; i++)
        if (package_causality(package->model, &variables[i]) == fmi_output)
            unknown(package, "Output", i, xml);
    extra_unknowns(package, extra_column, "Output", xml);
    for (size_t i = 0; i < count; i++)
        if (package_integral(&variables[i], i) > 0 && package_has_states(package))
            unknown(package, "ContinuousStateDerivative", i, xml);
    extra_unknowns(package, extra_rate, "ContinuousStateDerivative", xml);
    for (size_t i = 0; i < count; i++)
        if (package_is_initial_unknown(package, i))
            text_printf(xml, "    <InitialUnknown valueReference=\"%zu\"/>\n", i);
    extra_unknowns(package, extra_column, "InitialUnknown", xml);
    extra_unknowns(package, extra_rate, "InitialUnknown", xml);
    extra_unknowns(package, extra_indicator, "EventIndicator", xml);
    text_add(xml, "  </ModelStructure>\n");
}

void package_describe(const struct package *package, struct text *xml)
{
    begin(package, xml);
    package_variables(package, variable_of, extra, xml);
    structure(package, xml);
    text_add(xml, "</fmiModelDescription>\n");
}
