/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: the data of a page about a run.
 */
#include "api/page_data.h"
#include "base/api_check.h"
#include "base/diag.h"
#include "fbd_export.h"

static char *make_data(fbd_result *result, size_t most_bytes, fbd_errors *errors)
{
    struct text json = {0};
    diag_in_file(errors, result->simulation->ensemble->model->scene->file);
    if (!result->record) {
        diag_add(errors, FBD_ERROR, "not-recorded", (struct pos){0, 0}, "set `keep` in fbd_recording",
                 "the run was not recorded");
        return NULL;
    }
    if (page_data_write(&json, result, result->record, most_bytes) && !json.failed) return json.data;
    text_free(&json);
    diag_out_of_memory(errors);
    return NULL;
}

char *fbd_result_page_data(fbd_result *result, size_t most_bytes, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    char *data = result ? make_data(result, most_bytes, errors) : api_refuse(errors, "there is no result");
    diag_end(&call);
    return data;
}
