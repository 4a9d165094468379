/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The binary of an FMU when memory runs out: whole lives of instances by the functions of the standard, each allocation
 * failing in turn. Under AddressSanitizer or valgrind the same lives show what they leak.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_export.h"
#include "fmi/fmi2.h"
#include "fmi/fmi3.h"
#include "fmi/package.h"
#include "memory_calls.h"

#include <stdio.h>
#include <unistd.h>

static const char text[] =
    "fbd: 1\n"
    "parameters: {m: 2 kg, k: 50 N/m}\n"
    "inputs: {push: 5 N}\n"
    "ground: {points: {P: [0, 2 m]}}\n"
    "bodies:\n"
    "  a:\n"
    "    mass: m\n"
    "    motion: slide\n"
    "    forces: [gravity, normal, friction: 0.2, spring: {stiffness: k}, applied: {value: push}]\n"
    "  b: {mass: 1 kg, motion: {slide: {along: 90 deg}}, initial: {x: 1 m}, forces: [gravity]}\n"
    "  c: {mass: 1 kg, motion: {slide: {along: 90 deg, through: [1 m, 0]}}, forces: [gravity]}\n"
    "couplings: [rope: {name: r, through: [b.G, ground.P, c.G]}]\n"
    "simulate: {until: 1 s}\n";
static const char settings[] = "until 1\ntolerance 1e-08\nmethod auto\nset m 2.5 kg\n";

/* The folder `resources` of an FMU. */
static char folder[] = "/tmp/fbd-fmu-XXXXXX";
static char token[package_token_size];

static void put(const char *name, const char *content)
{
    char path[100];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(content, file);
    assert_int_equal(fclose(file), 0);
}

static int unpack(void **state)
{
    (void)state;
    assert_non_null(mkdtemp(folder));
    put("model.yaml", text);
    put("settings", settings);
    package_token(text, strlen(text), settings, token);
    return 0;
}

static int clean_up(void **state)
{
    (void)state;
    char path[100];
    snprintf(path, sizeof path, "%s/model.yaml", folder);
    remove(path);
    snprintf(path, sizeof path, "%s/settings", folder);
    remove(path);
    return rmdir(folder);
}

/* References: time, m, k, push, then x, v and v_dot of a, b and c. */
enum { ref_m = 1, ref_push = 3, ref_a_v = 5, ref_a_v_dot = 6 };

/* ---- FMI 3.0 */

static unsigned messages;

static void count_message_3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                            fmi3String message)
{
    (void)environment, (void)status, (void)category, (void)message;
    messages++;
}

static bool save_and_restore_3(fmi3Instance instance)
{
    fmi3FMUState state = NULL, copy = NULL;
    fmi3Byte bytes[4000];
    size_t size;
    bool fine = fmi3GetFMUState(instance, &state) == fmi3OK &&
                fmi3SerializedFMUStateSize(instance, state, &size) == fmi3OK && size <= sizeof bytes &&
                fmi3SerializeFMUState(instance, state, bytes, size) == fmi3OK &&
                fmi3DeserializeFMUState(instance, bytes, size, &copy) == fmi3OK &&
                fmi3SetFMUState(instance, copy) == fmi3OK;
    fmi3FreeFMUState(instance, &state);
    fmi3FreeFMUState(instance, &copy);
    return fine;
}

static bool derive_3(fmi3Instance instance)
{
    const fmi3ValueReference unknown = ref_a_v_dot, knowns[] = {ref_push, ref_a_v};
    const fmi3Float64 seed[] = {1, 0}, one = 1;
    fmi3Float64 along = 0, back[2];
    return fmi3GetDirectionalDerivative(instance, &unknown, 1, knowns, 2, seed, 2, &along, 1) == fmi3OK &&
           fmi3GetAdjointDerivative(instance, &unknown, 1, knowns, 2, &one, 1, back, 2) == fmi3OK &&
           back[0] == along;
}

static bool step_3(fmi3Instance instance, double t, double h)
{
    bool event, terminate, early;
    double reached;
    return fmi3DoStep(instance, t, h, false, &event, &terminate, &early, &reached) == fmi3OK &&
           reached == t + h;
}

static bool live_3(fmi3Instance instance)
{
    const fmi3ValueReference m = ref_m, push = ref_push, x = 4;
    const fmi3Float64 mass = 3, force = 9;
    fmi3Float64 value;
    return fmi3SetFloat64(instance, &m, 1, &mass, 1) == fmi3OK &&
           fmi3EnterInitializationMode(instance, false, 0, 0, false, 0) == fmi3OK &&
           fmi3ExitInitializationMode(instance) == fmi3OK && step_3(instance, 0, 0.125) &&
           fmi3SetFloat64(instance, &push, 1, &force, 1) == fmi3OK && derive_3(instance) &&
           save_and_restore_3(instance) && step_3(instance, 0.125, 0.25) && step_3(instance, 0.375, 1) &&
           fmi3GetFloat64(instance, &x, 1, &value, 1) == fmi3OK && fmi3Terminate(instance) == fmi3OK &&
           fmi3Reset(instance) == fmi3OK;
}

static bool whole_life_3(void)
{
    messages = 0;
    fmi3Instance instance = fmi3InstantiateCoSimulation("one", token, folder, false, true, false, false, NULL,
                                                        0, NULL, count_message_3, NULL);
    bool fine = instance && live_3(instance);
    assert_true(fine || messages > 0);
    fmi3FreeInstance(instance);
    return fine;
}

/* ---- FMI 2.0 */

static void count_message_2(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                            fmi2String category, fmi2String message, ...)
{
    (void)environment, (void)name, (void)status, (void)category, (void)message;
    messages++;
}

static bool live_2(fmi2Component component)
{
    const fmi2ValueReference push = ref_push, v_dot = ref_a_v_dot;
    const fmi2Real force = 9, seed = 1;
    fmi2Real slope;
    fmi2FMUstate state = NULL;
    bool fine =
        fmi2SetupExperiment(component, fmi2False, 0, 0, fmi2False, 0) == fmi2OK &&
        fmi2EnterInitializationMode(component) == fmi2OK && fmi2ExitInitializationMode(component) == fmi2OK &&
        fmi2DoStep(component, 0, 0.25, fmi2True) == fmi2OK && fmi2GetFMUstate(component, &state) == fmi2OK &&
        fmi2SetReal(component, &push, 1, &force) == fmi2OK &&
        fmi2GetDirectionalDerivative(component, &v_dot, 1, &push, 1, &seed, &slope) == fmi2OK &&
        fmi2DoStep(component, 0.25, 0.25, fmi2True) == fmi2OK &&
        fmi2SetFMUstate(component, state) == fmi2OK && fmi2DoStep(component, 0.25, 0.25, fmi2True) == fmi2OK;
    fmi2FreeFMUstate(component, &state);
    return fine;
}

static bool whole_life_2(void)
{
    char uri[100];
    const fmi2CallbackFunctions functions = {.logger = count_message_2};
    messages = 0;
    snprintf(uri, sizeof uri, "file://%s", folder);
    fmi2Component component =
        fmi2Instantiate("one", fmi2CoSimulation, token, uri, &functions, fmi2False, fmi2True);
    bool fine = component && live_2(component);
    assert_true(fine || messages > 0);
    fmi2FreeInstance(component);
    return fine;
}

/* ---- making one */

static bool make_both(void)
{
    const fbd_setting heavier = {"m", "3 kg"};
    bool made = true;
    for (int version = 2; version <= 3; version++) {
        fbd_errors *errors;
        fbd_model *model = load(text, &errors);
        if (!model) return false;
        const fbd_fmu_options options = {.version = version,
                                         .library = "binary",
                                         .library_length = 6,
                                         .settings = &heavier,
                                         .setting_count = 1};
        size_t length;
        char *bytes = fbd_fmu(model, &options, &length, errors);
        assert_true(bytes || fbd_errors_failed_count(errors) > 0);
        made = some(bytes) && made;
        fbd_model_free(model);
        fbd_errors_free(errors);
    }
    return made;
}

static void a_life_by_FMI_3(void **state)
{
    (void)state;
    assert_true(whole_life_3());
    fail_each(whole_life_3, 120);
}

static void a_life_by_FMI_2(void **state)
{
    (void)state;
    assert_true(whole_life_2());
    fail_each(whole_life_2, 120);
}

static void an_FMU_is_made_or_not(void **state)
{
    (void)state;
    fail_each(make_both, 120);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_life_by_FMI_3),
        cmocka_unit_test(a_life_by_FMI_2),
        cmocka_unit_test(an_FMU_is_made_or_not),
    };
    return cmocka_run_group_tests(tests, unpack, clean_up);
}
