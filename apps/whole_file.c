/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "whole_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "interrupt.h"

/* mkstemp makes files that only their owner can read; the result should be as open as any new file. */
static void set_usual_mode(int descriptor)
{
    mode_t mask = umask(0);
    umask(mask);
    (void)fchmod(descriptor, 0666 & ~mask);
}

/* A pipe or a terminal cannot be put in place whole: it is written as it is. */
static bool is_special(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && !S_ISREG(status.st_mode);
}

bool whole_file_open(struct whole_file *file, const char *path)
{
    *file = (struct whole_file){.path = path};
    if (strcmp(path, "-") == 0) {
        file->stream = stdout;
        return true;
    }
    if (is_special(path)) {
        file->stream = fopen(path, "w");
        return file->stream != NULL;
    }
    size_t size = strlen(path) + sizeof ".XXXXXX";
    file->temporary = malloc(size);
    if (!file->temporary) return false;
    snprintf(file->temporary, size, "%s.XXXXXX", path);
    int descriptor = mkstemp(file->temporary);
    if (descriptor >= 0) {
        set_usual_mode(descriptor);
        file->stream = fdopen(descriptor, "w");
        if (file->stream) return true;
        close(descriptor);
        unlink(file->temporary);
    }
    free(file->temporary);
    file->temporary = NULL;
    return false;
}

int whole_file_write(void *context, const char *text, size_t length)
{
    struct whole_file *file = context;
    return fwrite(text, 1, length, file->stream) == length ? 0 : 1;
}

bool whole_file_close(struct whole_file *file, bool keep)
{
    if (!file->stream) return true;
    bool written = fflush(file->stream) == 0 && !ferror(file->stream);
    int reason = errno;
    if (file->stream != stdout && fclose(file->stream) != 0) {
        if (written) reason = errno;
        written = false;
    }
    file->stream = NULL;
    if (!file->temporary) {
        errno = reason;
        return written;
    }
    if (written && keep) {
        written = rename(file->temporary, file->path) == 0;
        reason = errno;
    }
    if (!written || !keep) unlink(file->temporary);
    free(file->temporary);
    file->temporary = NULL;
    errno = reason;
    return written;
}

bool whole_file_put(const char *path, const char *text)
{
    struct whole_file file;
    struct interrupt interrupt;
    bool beside = strcmp(path, "-") != 0 && !is_special(path); /* a pipe may keep us waiting for ever */
    if (beside) interrupt_hold(&interrupt);
    bool written = whole_file_open(&file, path);
    if (written) {
        whole_file_write(&file, text, strlen(text)); /* an error shows when the file is closed */
        written = whole_file_close(&file, true);
    }
    int reason = errno;
    if (beside) interrupt_release(&interrupt);
    errno = reason;
    return written;
}
