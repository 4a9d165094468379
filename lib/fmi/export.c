/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: a model as an FMU.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/file.h"
#include "fbd_export.h"
#include "fbd_view.h"
#include "fmi/package.h"
#include "fmi/zip.h"

/* ---- the name */

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/* The name of the file without folder and ending, converted to a C identifier. */
static void name_package(struct package *package)
{
    const char *path = package->options->name ? package->options->name : fbd_model_file(package->model);
    const char *slash = path ? strrchr(path, '/') : NULL, *name = slash ? slash + 1 : path;
    size_t used = 0;
    if (!name || !is_letter(name[0])) package->name[used++] = 'm';
    for (; name && *name && *name != '.' && used < package_name_size - 1; name++) {
        bool fits = is_letter(*name) || (*name >= '0' && *name <= '9' && used > 0);
        package->name[used++] = fits ? *name : '_';
    }
    package->name[used] = '\0';
}

/* ---- settings */

static void put_number(struct text *text, const char *key, double value)
{
    text_printf(text, "%s ", key);
    text_exact(text, value);
    text_add(text, "\n");
}

static bool is_table(const fbd_model *model, const char *name)
{
    for (size_t i = 0; i < fbd_model_data_file_count(model); i++)
        if (strcmp(fbd_model_data_file(model, i).table, name) == 0) return true;
    return false;
}

/* `run` is complete. */
static void put_settings(struct package *package, const fbd_options *run)
{
    const fbd_fmu_options *options = package->options;
    const fbd_model *model = package->model;
    struct text *text = &package->settings;
    put_number(text, "until", package->until);
    put_number(text, "tolerance", package->tolerance);
    if (run->step > 0) put_number(text, "step", run->step);
    text_printf(text, "method %s\n", run->method);
    if (run->no_structure) text_add(text, "structure no\n");
    if (options->outputs) text_printf(text, "outputs %s\n", options->outputs);
    for (size_t i = 0; i < options->setting_count; i++) {
        const fbd_setting *setting = &options->settings[i];
        if (is_table(model, setting->name)) continue;
        text_printf(text, "set %s ", setting->name);
        for (const char *c = setting->value; *c; c++) text_add_bytes(text, *c == '\n' ? " " : c, 1);
        text_add(text, "\n");
    }
    for (size_t i = 0; i < fbd_model_data_file_count(model); i++)
        text_printf(text, "table %s\n", fbd_model_data_file(model, i).table);
}

/* ---- files */

static const char page[] =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>FMU made by "
    "fbd</title></head><body>\n"
    "<p>This Functional Mock-up Unit was made by fbd " FBD_VERSION
    ", free-body diagrams that run. The model is\n"
    "<code>resources/model.yaml</code>; <code>modelDescription.xml</code> lists parameters, inputs and "
    "outputs.\n"
    "An input is constant between communication points. The binary holds libfbd, the GNU Scientific Library "
    "and\n"
    "libyaml; see <a href=\"licenses/license.txt\">their licences</a>.</p>\n</body></html>\n";

static const char license[] =
    "SPDX-License-Identifier: GPL-3.0-or-later\n\n"
    "The binary of this FMU holds libfbd and the GNU Scientific Library, free software under the GNU General "
    "Public\n"
    "License, version 3 or (at your option) any later version, without any warranty: gpl-3.0.txt; and "
    "libyaml, under\n"
    "the MIT license: libyaml.txt. Who passes the FMU on passes on, or offers, the source of fbd " FBD_VERSION
    " and of the\n"
    "GNU Scientific Library as the first license says.\n"
    "The model in resources/ is its author's; it is read by the binary, and no part of it.\n";

static void add_licenses(struct zip *zip)
{
    zip_add(zip, "documentation/licenses/license.txt", license, strlen(license));
    zip_add(zip, "documentation/licenses/gpl-3.0.txt", (const char *)license_of_gpl, license_of_gpl_length);
    zip_add(zip, "documentation/licenses/libyaml.txt", (const char *)license_of_libyaml,
            license_of_libyaml_length);
    if (license_of_threads_length > 0)
        zip_add(zip, "documentation/licenses/winpthreads.txt", (const char *)license_of_threads,
                license_of_threads_length);
}

static void add_text(struct zip *zip, const char *name, struct text *text)
{
    if (text->failed || !text->data)
        zip->failed = true;
    else
        zip_add(zip, name, text->data, text->length);
    text_free(text);
}

/* The name that FMI 2.0 has for this platform; NULL if it has none. */
static const char *platform_2(void)
{
    static const char *const names[][2] = {{"x86_64-linux", "linux64"}, {"x86_64-windows", "win64"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i][0], FBD_FMI_PLATFORM) == 0) return names[i][1];
    return NULL;
}

static void add_binary(struct zip *zip, const struct package *package)
{
    struct text name = {0};
    const char *place = package->options->version == 2 ? platform_2() : FBD_FMI_PLATFORM;
    text_printf(&name, "binaries/%s/%s%s", place, package->name, FBD_FMI_SUFFIX);
    if (!name.failed)
        zip_add_gzip(zip, name.data, package->options->library, package->options->library_length);
    zip->failed |= name.failed;
    text_free(&name);
}

static bool add_tables(struct zip *zip, const fbd_model *model, fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_model_data_file_count(model); i++) {
        const fbd_data_file file = fbd_model_data_file(model, i);
        size_t length;
        char *bytes = file_text(file.path, &length, errors);
        struct text name = {0};
        text_printf(&name, "resources/tables/%s", file.table);
        if (bytes && !name.failed) zip_add(zip, name.data, bytes, length);
        zip->failed |= name.failed;
        text_free(&name);
        free(bytes);
        if (!bytes) return false;
    }
    return true;
}

static char *pack(const struct package *package, size_t *length, fbd_errors *errors)
{
    struct zip zip = {0};
    struct text xml = {0};
    size_t source_length;
    const char *source = fbd_model_source(package->model, &source_length);
    if (package->options->version == 2)
        package_describe_2(package, &xml);
    else
        package_describe(package, &xml);
    add_text(&zip, "modelDescription.xml", &xml);
    add_binary(&zip, package);
    zip_add(&zip, "resources/model.yaml", source, source_length);
    zip_add(&zip, "resources/settings", package->settings.data, package->settings.length);
    bool whole = add_tables(&zip, package->model, errors);
    zip_add(&zip, "documentation/index.html", page, strlen(page));
    add_licenses(&zip);
    char *bytes = zip_finish(&zip, length);
    if (whole && bytes) return bytes;
    if (whole) diag_out_of_memory(errors);
    free(bytes);
    return NULL;
}

/* ---- checks before the export */

static bool refuse(fbd_errors *errors, const char *hint, const char *message)
{
    diag_add(errors, FBD_ERROR, "bad-option", (struct pos){0, 0}, hint, "%s", message);
    return false;
}

static bool options_fit(const fbd_fmu_options *options, fbd_errors *errors)
{
    if (options->version != 2 && options->version != 3)
        return refuse(errors, "3, or 2 for tools without support of 3.0",
                      "there is no such version of FMI here");
    if (options->version == 2 && !platform_2())
        return refuse(errors, "FMI 3.0 does", "FMI 2.0 has no name for this platform");
    if (options->run->error_bars || options->run->accuracy != 0)
        return refuse(errors, "ask for a tolerance",
                      "an FMU has no error bars, and no accuracy that is made sure of");
    return true;
}

/* An FMU has no callbacks: inputs by them have no value. */
static bool has_values(const fbd_model *model, fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_model_parameter_count(model); i++) {
        if (!isnan(fbd_model_parameter(model, i).value)) continue;
        diag_add(errors, FBD_ERROR, "bad-option", (struct pos){0, 0},
                 "export the model without callbacks: the input is one of the FMU then",
                 "the input `%s` is computed by a callback, which an FMU cannot call",
                 fbd_model_parameter(model, i).name);
        return false;
    }
    return true;
}

/* Complete the options as a run from the start does, which also checks the start. Returns false with the notes of
 * that run. */
static bool complete(const fbd_model *model, fbd_options *run, fbd_errors *errors)
{
    fbd_options file = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, run, errors);
    bool fine = simulation && !fbd_simulation_blame(simulation, errors);
    if (fine && fbd_simulation_outcome(simulation) == FBD_OUT_OF_MEMORY) {
        diag_out_of_memory(errors);
        fine = false;
    }
    fbd_model_options(model, &file, sizeof file);
    if (isnan(run->until)) run->until = file.until;
    if (run->step == 0) run->step = file.step;
    if (!run->method) run->method = file.method ? file.method : "auto";
    if (fine) run->tolerance = fbd_simulation_stats(simulation).tolerance;
    fbd_simulation_free(simulation);
    return fine;
}

static bool list_variables(struct package *package, fbd_errors *errors)
{
    size_t count = package->variable_count = fbd_model_variable_count(package->model);
    fbd_state *state = fbd_state_new(package->model);
    package->variables = calloc(count, sizeof *package->variables);
    bool made = state && package->variables;
    for (size_t i = 0; made && i < count; i++) package->variables[i] = fbd_model_variable(package->model, i);
    package->has_derivatives = made && package_has_derivatives(state);
    fbd_state_free(state);
    if (!made) diag_out_of_memory(errors);
    const char *outputs = package->options->outputs;
    if (outputs) package->has_derivatives = false; /* there are none of forces */
    return made && extras_make(&package->extras, package->model, outputs, errors);
}

static const char *name_of(struct package *package, size_t index)
{
    const size_t count = package->variable_count;
    if (index >= count) return package->extras.list[index - count].name;
    struct text name = {0};
    package_variable_name(&package->variables[index], &name);
    const char *copy = name.failed ? NULL : arena_text(&package->extras.arena, name.data, name.length);
    text_free(&name);
    return copy;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* An importer finds variables by their names. */
static bool names_differ(struct package *package, fbd_errors *errors)
{
    const size_t count = package->variable_count + package->extras.count;
    const char **names = ARENA_ARRAY(&package->extras.arena, count + 1, const char *);
    for (size_t i = 0; names && i < count; i++)
        if (!(names[i] = name_of(package, i))) names = NULL;
    if (!names) {
        diag_out_of_memory(errors);
        return false;
    }
    qsort(names, count, sizeof *names, by_name);
    for (size_t i = 1; i < count; i++) {
        if (strcmp(names[i - 1], names[i]) != 0) continue;
        diag_add(errors, FBD_ERROR, "duplicate-name", (struct pos){0, 0},
                 "call the parameter, the body or the force of this name otherwise",
                 "two variables of the FMU would be called `%s`", names[i]);
        return false;
    }
    return true;
}

static char *make(struct package *package, size_t *length, fbd_errors *errors)
{
    fbd_options run = *package->options->run;
    if (!options_fit(package->options, errors) || !has_values(package->model, errors) ||
        !complete(package->model, &run, errors))
        return NULL;
    size_t source_length;
    const char *source = fbd_model_source(package->model, &source_length);
    package->until = run.until;
    package->tolerance = run.tolerance;
    name_package(package);
    put_settings(package, &run);
    if (package->settings.failed) diag_out_of_memory(errors);
    bool made = !package->settings.failed && list_variables(package, errors) && names_differ(package, errors);
    if (made) package_token(source, source_length, package->settings.data, package->token);
    char *bytes = made ? pack(package, length, errors) : NULL;
    free(package->variables);
    extras_free(&package->extras);
    text_free(&package->settings);
    return bytes;
}

char *fbd_fmu(const fbd_model *model, const fbd_fmu_options *options, size_t *length, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_fmu_options own = {0};
    fbd_options run = FBD_OPTIONS_DEFAULT;
    bool sized = api_take_options(&own, sizeof own, options, errors) &&
                 api_take_options(&run, sizeof run, own.run, errors);
    bool meant = sized && model && options && own.library && length &&
                 api_has_settings(own.settings, own.setting_count);
    if (length) *length = 0;
    if (sized && !meant)
        api_refuse(errors, "there is no model, binary or place for the length, or a setting has no value");
    char *bytes = NULL;
    if (meant) {
        if (own.version == 0) own.version = 3;
        own.run = &run;
        struct package package = {.model = model, .options = &own};
        bytes = make(&package, length, errors);
    }
    diag_end(&call);
    return bytes;
}
