/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Usage: exchange_fmu VERSION BINARY RESOURCES TOKEN UNTIL STEPS VARIABLES STATES INDICATORS [INPUT]
 * Model exchange: the classical Runge-Kutta method of a fixed step, with events by bisection of its steps (exchange.py). An
 * input, given by its reference, jumps at each of the equal communication points. Prints the values of the first variables
 * there, and what the FMU logs.
 */
#include "importer.h"

#include <math.h>
#include <stdbool.h>

enum { most_numbers = 100, steps_between = 40 };

struct motion {
    struct importer *importer;
    int version;
    size_t states, indicators;
    double t, next; /* next: of the next event of time alone */
    double y[most_numbers];
    bool ended;
};

/* The function of the version with these arguments. */
#define CALL(motion, name_2, name_3, ...)                                                                    \
    require((motion)->version == 2 ? (int)FUNCTION(name_2)(importer->instance, __VA_ARGS__)                  \
                                   : (int)FUNCTION(name_3)(importer->instance, __VA_ARGS__),                 \
            #name_3)

static void require(int status, const char *function)
{
    if (status) printf("%s returns %d\n", function, status), exit(7);
}

static void put(struct motion *motion, double t, const double *y)
{
    struct importer *importer = motion->importer;
    CALL(motion, fmi2SetTime, fmi3SetTime, t);
    CALL(motion, fmi2SetContinuousStates, fmi3SetContinuousStates, y, motion->states);
}

static void rates(struct motion *motion, double t, const double *y, double *rates)
{
    struct importer *importer = motion->importer;
    put(motion, t, y);
    CALL(motion, fmi2GetDerivatives, fmi3GetContinuousStateDerivatives, rates, motion->states);
}

/* Is the sign of an indicator at (t, y) another than in `before`? Without `before` the signs are written to `now`. */
static bool signs_differ(struct motion *motion, double t, const double *y, const bool *before, bool *now)
{
    struct importer *importer = motion->importer;
    double values[most_numbers];
    bool differ = false;
    put(motion, t, y);
    CALL(motion, fmi2GetEventIndicators, fmi3GetEventIndicators, values, motion->indicators);
    for (size_t i = 0; i < motion->indicators; i++) {
        if (before)
            differ |= before[i] != (values[i] > 0);
        else
            now[i] = values[i] > 0;
    }
    return differ;
}

/* ---- events */

static bool new_states(struct motion *motion)
{
    struct importer *importer = motion->importer;
    bool again, nominals, jumps, has_next;
    fmi2EventInfo info = {0};
    if (motion->version == 3) {
        require((int)FUNCTION(fmi3UpdateDiscreteStates)(importer->instance, &again, &motion->ended, &nominals,
                                                        &jumps, &has_next, &motion->next),
                "fmi3UpdateDiscreteStates");
    } else {
        require((int)FUNCTION(fmi2NewDiscreteStates)(importer->instance, &info), "fmi2NewDiscreteStates");
        motion->ended = info.terminateSimulation;
        jumps = info.valuesOfContinuousStatesChanged;
        has_next = info.nextEventTimeDefined;
        motion->next = info.nextEventTime;
    }
    if (!has_next) motion->next = HUGE_VAL;
    return jumps;
}

/* From Event Mode to Continuous-Time Mode. */
static void leave_event_mode(struct motion *motion, bool first)
{
    struct importer *importer = motion->importer;
    const bool jumps = new_states(motion);
    require(motion->version == 2 ? (int)FUNCTION(fmi2EnterContinuousTimeMode)(importer->instance)
                                 : (int)FUNCTION(fmi3EnterContinuousTimeMode)(importer->instance),
            "EnterContinuousTimeMode");
    if (jumps || first)
        CALL(motion, fmi2GetContinuousStates, fmi3GetContinuousStates, motion->y, motion->states);
}

static void enter_event_mode(struct motion *motion)
{
    struct importer *importer = motion->importer;
    put(motion, motion->t, motion->y);
    require(motion->version == 2 ? (int)FUNCTION(fmi2EnterEventMode)(importer->instance)
                                 : (int)FUNCTION(fmi3EnterEventMode)(importer->instance),
            "EnterEventMode");
}

static bool complete(struct motion *motion)
{
    struct importer *importer = motion->importer;
    fmi2Boolean event_2 = 0, end_2 = 0;
    fmi3Boolean event_3 = false, end_3 = false;
    if (motion->version == 2)
        require(FUNCTION(fmi2CompletedIntegratorStep)(importer->instance, fmi2True, &event_2, &end_2),
                "fmi2CompletedIntegratorStep");
    else
        require(FUNCTION(fmi3CompletedIntegratorStep)(importer->instance, true, &event_3, &end_3),
                "fmi3CompletedIntegratorStep");
    return event_2 || event_3;
}

/* ---- steps */

static void runge_kutta(struct motion *motion, double h, double *end)
{
    static const double shares[] = {0, 0.5, 0.5, 1}, weights[] = {1, 2, 2, 1};
    double k[most_numbers] = {0}, y[most_numbers];
    const size_t size = motion->states;
    memcpy(end, motion->y, size * sizeof *end);
    for (int stage = 0; stage < 4; stage++) {
        for (size_t i = 0; i < size; i++) y[i] = motion->y[i] + shares[stage] * h * k[i];
        rates(motion, motion->t + shares[stage] * h, y, k);
        for (size_t i = 0; i < size; i++) end[i] += h / 6 * weights[stage] * k[i];
    }
}

/* The length of a step to the first sign that differs; `length` if none does. `end` is the state there. */
static double bisect(struct motion *motion, double length, double *end, bool *crossed)
{
    const double resolution = 1e-13;
    double low = 0, there[most_numbers];
    bool signs[most_numbers];
    signs_differ(motion, motion->t, motion->y, NULL, signs);
    runge_kutta(motion, length, end);
    *crossed = signs_differ(motion, motion->t + length, end, signs, NULL);
    while (*crossed && length - low > resolution * fmax(1, motion->t)) {
        const double middle = low + (length - low) / 2;
        runge_kutta(motion, middle, there);
        if (!signs_differ(motion, motion->t + middle, there, signs, NULL)) {
            low = middle;
        } else {
            length = middle;
            memcpy(end, there, sizeof there);
        }
    }
    return length;
}

static void go_to(struct motion *motion, double target, double h)
{
    while (motion->t < target && !motion->ended) {
        bool crossed;
        double end[most_numbers];
        const double most = fmin(h, fmin(target, motion->next) - motion->t);
        const double length = bisect(motion, most, end, &crossed);
        const bool timed = motion->t + length >= motion->next;
        motion->t = timed ? motion->next : motion->t + length;
        memcpy(motion->y, end, sizeof end);
        put(motion, motion->t, motion->y);
        if (complete(motion) || crossed || timed) {
            enter_event_mode(motion);
            leave_event_mode(motion, false);
        }
    }
    put(motion, motion->t, motion->y);
}

/* ---- the program */

static int start(struct importer *importer, int version)
{
    static const fmi2CallbackFunctions functions = {log_2, calloc, free, NULL, NULL};
    importer->instance =
        version == 2 ? FUNCTION(fmi2Instantiate)("one", fmi2ModelExchange, importer->token,
                                                 importer->resources, &functions, fmi2False, fmi2True)
                     : FUNCTION(fmi3InstantiateModelExchange)("one", importer->token, importer->resources,
                                                              false, true, NULL, log_3);
    if (!importer->instance) return 1;
    if (version == 3)
        return FUNCTION(fmi3EnterInitializationMode)(importer->instance, false, 0, 0, true,
                                                     importer->until) ||
               FUNCTION(fmi3ExitInitializationMode)(importer->instance);
    return FUNCTION(fmi2SetupExperiment)(importer->instance, fmi2False, 0, 0, fmi2True, importer->until) ||
           FUNCTION(fmi2EnterInitializationMode)(importer->instance) ||
           FUNCTION(fmi2ExitInitializationMode)(importer->instance);
}

int main(int count, char **words)
{
    if (count < 10) return 2;
    const int version = atoi(words[1]), steps = atoi(words[6]);
    const size_t variables = (size_t)atoi(words[7]);
    struct importer importer = {(void *)LOAD(words[2]), NULL, words[3], words[4], atof(words[5])};
    struct motion motion = {.importer = &importer,
                            .version = version,
                            .states = (size_t)atoi(words[8]),
                            .indicators = (size_t)atoi(words[9])};
    if (!importer.library || variables > most_variables || motion.states > most_numbers ||
        motion.indicators > most_numbers)
        return 3;
    if (start(&importer, version)) return 4;
    const double h = importer.until / steps;
    leave_event_mode(&motion, true);
    for (int k = 0; k < steps; k++) {
        if (count > 10) {
            enter_event_mode(&motion);
            if (set(&importer, version, (unsigned)atoi(words[10]), 3 * (k % 5) - 4)) return 5;
            leave_event_mode(&motion, false);
        }
        go_to(&motion, (k + 1) * h, h / steps_between);
        if (show(&importer, version, variables)) return 6;
    }
    return 0;
}
