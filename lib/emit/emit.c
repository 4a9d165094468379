/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "emit/emit.h"
#include "base/api_check.h"
#include "fbd_export.h"
#include "loop/options.h"

char *fbd_emit_c(const fbd_model *model, const fbd_options *options, fbd_errors *list)
{
    fbd_options own = FBD_OPTIONS_DEFAULT;
    struct diag_call call;
    struct run_options chosen;
    if (!model) return api_refuse(list, "there is no model");
    fbd_errors *errors = diag_begin(&call, list);
    char *program = NULL;
    if (api_take_options(&own, sizeof own, options, errors) && options_choose(model, &own, &chosen, errors))
        program = emit_program(model, chosen.until, chosen.tolerance, errors);
    diag_end(&call);
    return program;
}
