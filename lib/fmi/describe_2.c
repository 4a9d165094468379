/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * modelDescription.xml by FMI 2.0.5, sections 2.2 and 4.3. The model structure numbers variables from 1;
 * value references start at 0, as in FMI 3.0.
 */
#include "fmi/package.h"
#include "model/model.h"

static void begin(const struct package *package, struct text *xml)
{
    const char *title = package->model->scene->title;
    text_add(xml, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"2.0\"");
    xml_attribute(xml, "modelName", package->name);
    xml_attribute(xml, "guid", package->token);
    if (title[0]) xml_attribute(xml, "description", title);
    xml_attribute(xml, "license", "GPL-3.0-or-later");
    xml_attribute(xml, "generationTool", "fbd " FBD_VERSION);
    xml_attribute(xml, "variableNamingConvention", "structured");
    text_add(xml, ">\n  <CoSimulation");
    xml_attribute(xml, "modelIdentifier", package->name);
    text_add(xml, " canHandleVariableCommunicationStepSize=\"true\""
                  " canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\""
                  " canSerializeFMUstate=\"true\"");
    if (fmi_has_derivatives(package->model)) text_add(xml, " providesDirectionalDerivative=\"true\"");
    text_add(xml, "/>\n");
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

static void causality(const struct fmi_variable *variable, struct text *xml)
{
    switch (variable->kind) {
    case fmi_time: text_add(xml, " causality=\"independent\" variability=\"continuous\""); break;
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
    const struct fmi_variable *variable = &package->variables.list[index];
    struct text says = {0};
    package_says(package, variable, &says);
    text_add(xml, "    <ScalarVariable");
    xml_attribute(xml, "name", variable->name);
    text_printf(xml, " valueReference=\"%zu\"", index);
    if (!says.failed && says.data) xml_attribute(xml, "description", says.data);
    xml->failed |= says.failed;
    text_free(&says);
    causality(variable, xml);
    text_add(xml, "><Real");
    if (variable->unit[0]) xml_attribute(xml, "unit", variable->unit);
    if (variable->kind == fmi_parameter || variable->kind == fmi_input)
        xml_number(xml, "start", package->model->scene->parameters[variable->index].value);
    if (variable->integral > 0) text_printf(xml, " derivative=\"%u\"", variable->integral + 1);
    text_add(xml, "/></ScalarVariable>\n");
}

/* Coordinates and rates are states: they do not depend on inputs directly. */
static void unknown(const struct package *package, size_t index, struct text *xml)
{
    enum fmi_kind kind = package->variables.list[index].kind;
    text_printf(xml, "      <Unknown index=\"%zu\"", index + 1);
    if (kind == fmi_coordinate || kind == fmi_rate) {
        if (fmi_has_derivatives(package->model))
            text_printf(xml, " dependencies=\"%zu\" dependenciesKind=\"constant\"", index + 1);
        else
            text_add(xml, " dependencies=\"\"");
    }
    text_add(xml, "/>\n");
}

static bool is_derivative(const struct fmi_variable *variable)
{
    return variable->integral > 0;
}

static bool is_initial_unknown(const struct fmi_variable *variable)
{
    return fmi_is_output(variable) || variable->kind == fmi_calculated;
}

/* Append a list of the model structure, if it is not empty, with the dependencies of its variables. */
static void list(const struct package *package, const char *name, bool belongs(const struct fmi_variable *),
                 bool depends, struct text *xml)
{
    const struct fmi_variables *variables = &package->variables;
    bool any = false;
    for (size_t i = 0; i < variables->count; i++) {
        if (!belongs(&variables->list[i])) continue;
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
    list(package, "Outputs", fmi_is_output, true, xml);
    if (fmi_has_derivatives(package->model)) list(package, "Derivatives", is_derivative, true, xml);
    list(package, "InitialUnknowns", is_initial_unknown, false, xml);
    text_add(xml, "  </ModelStructure>\n");
}

void package_describe_2(const struct package *package, struct text *xml)
{
    begin(package, xml);
    package_units(package, xml);
    experiment(package, xml);
    text_add(xml, "  <ModelVariables>\n");
    for (size_t i = 0; i < package->variables.count; i++) variable_of(package, i, xml);
    text_add(xml, "  </ModelVariables>\n");
    structure(package, xml);
    text_add(xml, "</fmiModelDescription>\n");
}
