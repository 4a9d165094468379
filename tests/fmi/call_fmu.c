/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Usage: call_fmu VERSION BINARY RESOURCES TOKEN UNTIL STEPS VARIABLES [INPUT]
 * Co-simulation in equal steps, with an input that varies, by its reference. Prints the values of the first variables at each
 * communication point, and what the FMU logs.
 */
#include "importer.h"

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
