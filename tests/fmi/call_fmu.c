/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Usage: call_fmu VERSION BINARY RESOURCES TOKEN UNTIL STEPS VARIABLES [INPUT]
 * An importer that loads the binary of an FMU: co-simulation by FMI 2 or 3, in equal steps, with an input that varies,
 * by its reference. Prints the values of the first variables at each communication point, and what the FMU logs. The
 * same source for all systems: LOAD and FIND are their functions that load a library and find a symbol
 * (tests/tools/check_windows_fmu).
 */
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

static int start_2(struct importer *importer)
{
    static const fmi2CallbackFunctions functions = {log_2, calloc, free, NULL, NULL};
    importer->instance = FUNCTION(fmi2Instantiate)("one", fmi2CoSimulation, importer->token,
                                                   importer->resources, &functions, fmi2False, fmi2True);
    return !importer->instance ||
           FUNCTION(fmi2SetupExperiment)(importer->instance, fmi2False, 0, 0, fmi2True, importer->until) ||
           FUNCTION(fmi2EnterInitializationMode)(importer->instance) ||
           FUNCTION(fmi2ExitInitializationMode)(importer->instance);
}

static int start_3(struct importer *importer)
{
    importer->instance =
        FUNCTION(fmi3InstantiateCoSimulation)("one", importer->token, importer->resources, false, true, false,
                                              false, NULL, 0, NULL, log_3, NULL);
    return !importer->instance ||
           FUNCTION(fmi3EnterInitializationMode)(importer->instance, false, 0, 0, true, importer->until) ||
           FUNCTION(fmi3ExitInitializationMode)(importer->instance);
}

static int step(struct importer *importer, int version, double t, double h)
{
    bool event, terminate, early;
    double reached;
    return version == 2 ? (int)FUNCTION(fmi2DoStep)(importer->instance, t, h, fmi2True)
                        : (int)FUNCTION(fmi3DoStep)(importer->instance, t, h, true, &event, &terminate,
                                                    &early, &reached);
}

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

int main(int count, char **words)
{
    if (count < 8) return 2;
    const int version = atoi(words[1]), steps = atoi(words[6]);
    const size_t variables = (size_t)atoi(words[7]);
    struct importer importer = {(void *)LOAD(words[2]), NULL, words[3], words[4], atof(words[5])};
    if (!importer.library || variables > most_variables) return 3;
    if (version == 2 ? start_2(&importer) : start_3(&importer)) return 4;
    for (int k = 0; k < steps; k++) {
        const double h = importer.until / steps;
        if (count > 8 && set(&importer, version, (unsigned)atoi(words[8]), 3 * (k % 5) - 4)) return 5;
        if (step(&importer, version, k * h, h) || show(&importer, version, variables)) return 6;
    }
    return 0;
}
