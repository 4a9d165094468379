/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The reader and the compiler: any bytes are a model, or are refused by notes that can be printed.
 */
#include "claims.h"
#include "fbd_view.h"
#include "fuzz.h"

enum { most_seconds = 10 }; /* of the processor, for an input that is invented */

/* What can be asked of a model without a state. */
static void look_at(const fbd_model *model)
{
    for (size_t i = 0; i < fbd_model_body_count(model); i++) {
        fbd_inertia inertia = fbd_model_inertia(model, i);
        if (!fbd_model_body_name(model, i)[0]) fuzz_fail("body %zu has no name", i);
        claim_finite("mass", inertia.mass);
        claim_finite("I_G", inertia.I_G);
        claim_finite("I_O", inertia.I_O);
        claim_finite("G", inertia.G[0] + inertia.G[1]);
    }
    for (size_t i = 0; i < fbd_model_coordinate_count(model); i++)
        if (fbd_model_coordinate(model, i).body >= fbd_model_body_count(model))
            fuzz_fail("coordinate %zu is of no body", i);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    clock_t since = clock();
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse((const char *)data, size, "fuzzed.yaml", NULL, 0, errors);
    claim_notes(errors);
    if ((fbd_errors_failed_count(errors) == 0) != (model != NULL))
        fuzz_fail("%zu errors, and %s model", fbd_errors_failed_count(errors), model ? "a" : "no");
    if (model) look_at(model);
    fbd_model_free(model);
    fbd_errors_free(errors);
    claim_in_time(since, most_seconds);
    return 0;
}
