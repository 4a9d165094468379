/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Importer: an importer in C that loads the binary of an FMU, by FMI 2 or 3. The same source for all systems: LOAD and FIND are
 * their functions that load a library and find a symbol (tests/tools/check_windows_fmu).
 */
#ifndef FBD_TESTS_FMI_IMPORTER_H
#define FBD_TESTS_FMI_IMPORTER_H

#include "fmi/fmi2.h"
#include "fmi/fmi3.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_variables = 200 };

static void log_2(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                  fmi2String category, fmi2String message, ...)
{
    va_list arguments;
    (void)environment, (void)name;
    printf("%d %s ", (int)status, category);
    va_start(arguments, message);
    vprintf(message, arguments);
    va_end(arguments);
    printf("\n");
}

static void log_3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                  fmi3String message)
{
    (void)environment;
    printf("%d %s %s\n", (int)status, category, message);
}

/* The functions of both versions as those of this importer. */
struct importer {
    void *library, *instance;
    const char *resources, *token;
    double until;
};

static void *find(struct importer *importer, const char *name)
{
    void *function = (void *)FIND(importer->library, name);
    if (!function) printf("no function %s\n", name), exit(1);
    return function;
}

#define FUNCTION(name) (__extension__((__typeof__(name) *)find(importer, #name)))

static int set(struct importer *importer, int version, unsigned input, double value)
{
    return version == 2 ? (int)FUNCTION(fmi2SetReal)(importer->instance, &input, 1, &value)
                        : (int)FUNCTION(fmi3SetFloat64)(importer->instance, &input, 1, &value, 1);
}

static int show(struct importer *importer, int version, size_t count)
{
    unsigned references[most_variables];
    double values[most_variables];
    for (unsigned i = 0; i < count; i++) references[i] = i;
    const int status =
        version == 2 ? (int)FUNCTION(fmi2GetReal)(importer->instance, references, count, values)
                     : (int)FUNCTION(fmi3GetFloat64)(importer->instance, references, count, values, count);
    for (size_t i = 0; i < count; i++) printf("%.17g%c", values[i], i + 1 < count ? ' ' : '\n');
    return status;
}

#endif
