/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What is in an FMU beside its binary, and how the binary finds it again.
 *
 *   modelDescription.xml
 *   binaries/x86_64-linux/NAME.so         (FMI 2.0: binaries/linux64)
 *   resources/model.yaml                  the model file as it is
 *   resources/settings                    lines of what was set when it was made: KEY VALUE
 *   resources/tables/NAME                 data files of its tables
 *   documentation/                        what it is, and its licence
 */
#ifndef FBD_FMI_PACKAGE_H
#define FBD_FMI_PACKAGE_H

#include <stdint.h>

#include "base/text.h"
#include "fbd.h"
#include "fmi/variables.h"

enum { package_name_size = 64, package_token_size = 40 };

struct package {
    const struct fbd_model *model;
    const fbd_fmu_options *options;
    struct fmi_variables variables;
    struct text settings;
    char name[package_name_size];   /* an identifier */
    char token[package_token_size]; /* tells what was made of one model from what was made of another */
    double until, tolerance;        /* as a run would have them */
};

/* What resources/settings says, in the words of options. */
struct package_settings {
    struct arena arena;
    fbd_options run;
    fbd_setting *list; /* of parameters and tables */
    size_t count;
};

/* Read them from `text`, which is cut into pieces; tables stand in the folder `resources`. False when they are not
 * understood, or memory is out; free them all the same. */
bool package_settings_read(struct package_settings *settings, char *text, const char *resources);
void package_settings_free(struct package_settings *settings);

/* The token of a model's text under such settings. */
void package_token(const char *text, size_t length, const char *settings, char token[package_token_size]);

/* A number that tells bytes from others, from that of what stands before them: against accidents, not against malice. */
extern const uint64_t package_hash_start;
uint64_t package_hash(uint64_t before, const void *bytes, size_t length);

/* modelDescription.xml of FMI 3.0 and of 2.0. */
void package_describe(const struct package *package, struct text *xml);
void package_describe_2(const struct package *package, struct text *xml);

/* Texts of licences (licenses.c, made by embed). */
extern const unsigned char license_of_gpl[], license_of_libyaml[];
extern const size_t license_of_gpl_length, license_of_libyaml_length;

/* ---- what both have in common */

/* A text between the quotes of an attribute. */
void xml_attribute(struct text *xml, const char *name, const char *value);
void xml_number(struct text *xml, const char *name, double value);

/* Units of all variables, each once. */
void package_units(const struct package *package, struct text *xml);

/* What a variable is, in a few words: "rate of change of block.x". */
void package_says(const struct package *package, const struct fmi_variable *variable, struct text *text);

#endif
