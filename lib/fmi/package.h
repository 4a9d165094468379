/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The contents of an FMU other than its binary, and their access by the binary.
 *
 * modelDescription.xml binaries/x86_64-linux/NAME.so         (FMI 2.0: binaries/linux64) resources/model.yaml
 * the unchanged model file resources/settings                    settings at the export, as lines: KEY VALUE
 * resources/tables/NAME                 data files of its tables documentation/
 * description and licence
 */
#ifndef FBD_FMI_PACKAGE_H
#define FBD_FMI_PACKAGE_H

#include <stdint.h>

#include "base/arena.h"
#include "base/text.h"
#include "fbd.h"
#include "fbd_export.h"
#include "fbd_view.h"
#include "fmi/extra.h"

enum { package_name_size = 64, package_token_size = 40 };

/* The value reference of a variable is its index in fbd_model_variable. */
enum fmi_causality {
    fmi_independent, /* the time */
    fmi_parameter,
    fmi_calculated, /* a parameter defined in the file by others */
    fmi_input,
    fmi_output,
};

struct package {
    const fbd_model *model;
    const fbd_fmu_options *options;
    fbd_variable *variables;
    size_t variable_count;
    bool has_derivatives;
    struct extras extras; /* variables after those */
    struct text settings;
    char name[package_name_size];   /* an identifier */
    char token[package_token_size]; /* identifies the model and settings */
    double until, tolerance;        /* of a run with these settings */
};

/* The contents of resources/settings as options. */
struct package_settings {
    struct arena arena;
    fbd_options run;
    fbd_setting *list; /* of parameters and tables */
    size_t count;
    const char *outputs; /* columns that are outputs, separated by commas; or NULL */
};

/* Read them from `text`, which is cut into pieces; tables are in the folder `resources`. Returns false when
 * they are invalid, or memory is out; free them also then. */
bool package_settings_read(struct package_settings *settings, char *text, const char *resources);
void package_settings_free(struct package_settings *settings);

/* The token of a model's text with these settings. */
void package_token(const char *text, size_t length, const char *settings, char token[package_token_size]);

/* Continue a hash, starting with package_hash_start; no protection against deliberate collisions. */
extern const uint64_t package_hash_start;
uint64_t package_hash(uint64_t before, const void *bytes, size_t length);

/* modelDescription.xml of FMI 3.0 and of 2.0. */
void package_describe(const struct package *package, struct text *xml);
void package_describe_2(const struct package *package, struct text *xml);

/* Texts of licences (licenses.c, made by lib/embed). */
extern const unsigned char license_of_gpl[], license_of_libyaml[], license_of_threads[];
extern const size_t license_of_gpl_length, license_of_libyaml_length,
    license_of_threads_length; /* 0: a part of the system, and not of the binary */

/* ---- common to both versions */

/* Append an attribute; the value is escaped. */
void xml_attribute(struct text *xml, const char *name, const char *value);
void xml_number(struct text *xml, const char *name, double value);

enum fmi_causality package_causality(const fbd_model *model, const fbd_variable *variable);

/* True if directional derivatives of all outputs are available: not with points. `state` is any state of the
 * model. */
bool package_has_derivatives(fbd_state *state);

/* An output, or a parameter defined by others. */
bool package_is_initial_unknown(const struct package *package, size_t index);

/* The variable whose derivative by time is variable `index`, or 0. */
size_t package_integral(const fbd_variable *variable, size_t index);

/* Append the name of a variable: as it is, and escaped, as an attribute. */
void package_variable_name(const fbd_variable *variable, struct text *text);
void xml_variable_name(struct text *xml, const fbd_variable *variable);

/* Are states and their derivatives declared: for directional derivatives, or for model exchange? Is the variable such a
 * state? */
bool package_has_states(const struct package *package);
bool package_is_state(const struct package *package, size_t index);

/* The unit in which a quantity of this unit is displayed, an angle in degrees; NULL if it is the same. */
const char *package_display_unit(const char *unit);

/* Append the name, unit and display unit of an extra variable, and of any variable its unit; escaped, as attributes. */
void xml_units(struct text *xml, const char *unit);
void xml_extra_description(struct text *xml, const struct extra *extra);

/* Append the beginning of the first element, up to the attributes of one version; `token` is the name of the token's
 * attribute. */
void xml_head(const struct package *package, const char *version, const char *token, struct text *xml);

/* Append an interface, ModelExchange or CoSimulation, with its capabilities as attributes. */
void xml_interface(const struct package *package, const char *name, const char *capabilities,
                   const char *others, struct text *xml);

/* Append units, log categories, default experiment and all variables: `variable` and `extra` append one. */
typedef void xml_variable(const struct package *package, size_t index, struct text *xml);
void package_variables(const struct package *package, xml_variable *variable, xml_variable *extra,
                       struct text *xml);

/* Append a short description of variable `index`: "rate of change of block.x", as an attribute. */
void xml_description(struct text *xml, const struct package *package, size_t index);

#endif
