/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "program.h"

#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "complain.h"

extern char **environ;

/* Between the folders of PATH. */
#ifndef PATH_SEPARATOR
#define PATH_SEPARATOR ":"
#endif

bool program_is_there(const char *name)
{
    const char *path = getenv("PATH");
    char place[4096];
    for (const char *folder = path ? path : ""; *folder;) {
        size_t length = strcspn(folder, PATH_SEPARATOR);
        int size = snprintf(place, sizeof place, "%.*s/%s", (int)length, folder, name);
        if (size > 0 && (size_t)size < sizeof place && access(place, X_OK) == 0) return true;
        folder += length + (folder[length] != '\0');
    }
    return false;
}

/* Write the text to an unnamed file, positioned at its start. */
static FILE *text_file(const char *text)
{
    FILE *file = tmpfile();
    if (!file) return NULL;
    bool written = fwrite(text, 1, strlen(text), file) == strlen(text) && fflush(file) == 0;
    if (written && fseek(file, 0, SEEK_SET) == 0) return file;
    fclose(file);
    return NULL;
}

/* Start the program between two descriptors. Returns 0 or an errno. */
static int start(const char *const *arguments, int input, int output, pid_t *child)
{
    posix_spawn_file_actions_t actions;
    int failed = posix_spawn_file_actions_init(&actions);
    if (failed) return failed;
    failed = posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    if (!failed) failed = posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    if (!failed)
        failed = posix_spawnp(child, arguments[0], &actions, NULL, (char *const *)arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

bool program_run(const char *const *arguments, const char *text, int output)
{
    FILE *input = text_file(text);
    if (!input) {
        complain("fbd-run: cannot write the input of %s: %s", arguments[0], strerror(errno));
        return false;
    }
    pid_t child;
    int status = 1, failed = start(arguments, fileno(input), output, &child);
    if (failed)
        complain("fbd-run: cannot start %s: %s", arguments[0], strerror(failed));
    else
        while (waitpid(child, &status, 0) < 0 && errno == EINTR) errno = 0;
    fclose(input);
    bool done = !failed && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (!done && !failed) complain("fbd-run: %s failed", arguments[0]);
    return done;
}

bool program_run_in(const char *const *arguments, const char *folder)
{
    enum { most_arguments = 24 };
    static const char script[] =
        "cd \"$1\" && shift && { \"$@\" >log 2>&1 </dev/null || { tail -n 4 log >&2; exit 1; }; }";
    const char *all[most_arguments] = {"sh", "-c", script, arguments[0], folder};
    size_t count = 5;
    for (size_t i = 0; arguments[i] && count + 1 < most_arguments; i++) all[count++] = arguments[i];
    return program_run(all, "", STDERR_FILENO);
}
