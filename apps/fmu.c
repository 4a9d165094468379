/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmu.h"

#include <errno.h>
#include <string.h>

#include "complain.h"
#include "fbd_export.h"
#include "whole_file.h"

bool fmu_can_be_made(const struct command_line *line)
{
    size_t length;
    if (fmu_binary(&length)) return true;
    return command_line_usage(line,
                              "this fbd was built without --fmu: on Linux it needs the archives of GSL and "
                              "libyaml at build time (Debian: libgsl-dev, libyaml-dev)",
                              "");
}

bool fmu_take_version(const struct command_line *line, const char *text, int *version)
{
    unsigned long value;
    if (!command_line_whole(line, "--fmu-version wants 2 or 3, not ", text, 2, 3, &value)) return false;
    *version = (int)value;
    return true;
}

/* Choose the exit code: an error with a position is one of the file, others are of the command line. */
static enum exit_code blame(fbd_errors *errors)
{
    const fbd_error first = fbd_errors_get(errors, 0);
    bool asked =
        first.id && (strcmp(first.id, "bad-option") == 0 || strcmp(first.id, "no-end-time") == 0 ||
                     strcmp(first.id, "unknown-method") == 0 || strcmp(first.id, "unknown-output") == 0);
    return asked && first.line == 0 ? exit_usage : exit_failed;
}

enum exit_code write_fmu(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    fbd_fmu_options chosen = {.version = options->fmu_version,
                              .settings = options->settings,
                              .setting_count = options->setting_count,
                              .run = &options->run,
                              .outputs = options->fmu_outputs};
    size_t length;
    chosen.library = fmu_binary(&chosen.library_length);
    char *bytes = fbd_fmu(model, &chosen, &length, errors);
    if (!bytes) return blame(errors);
    bool written = whole_file_put_bytes(options->fmu, bytes, length);
    if (!written) complain("fbd-run: cannot write `%s`: %s", options->fmu, strerror(errno));
    fbd_free(bytes);
    return written ? exit_done : exit_failed;
}
