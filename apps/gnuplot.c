/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gnuplot.h"

#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "complain.h"

extern char **environ;

bool gnuplot_is_there(void)
{
    const char *path = getenv("PATH");
    char place[4096];
    for (const char *folder = path ? path : ""; *folder;) {
        size_t length = strcspn(folder, ":");
        int size = snprintf(place, sizeof place, "%.*s/gnuplot", (int)length, folder);
        if (size > 0 && (size_t)size < sizeof place && access(place, X_OK) == 0) return true;
        folder += length + (folder[length] == ':');
    }
    return false;
}

/* The script as an unnamed file, at its start. */
static FILE *script_file(const char *script)
{
    FILE *file = tmpfile();
    if (!file) return NULL;
    bool written = fwrite(script, 1, strlen(script), file) == strlen(script) && fflush(file) == 0;
    if (written && fseek(file, 0, SEEK_SET) == 0) return file;
    fclose(file);
    return NULL;
}

/* Start gnuplot between two descriptors; what went wrong, as errno says it, or 0. */
static int start(int input, int output, pid_t *child)
{
    char name[] = "gnuplot", all[] = "-";
    char *const arguments[] = {name, all, NULL};
    posix_spawn_file_actions_t actions;
    int failed = posix_spawn_file_actions_init(&actions);
    if (failed) return failed;
    failed = posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    if (!failed) failed = posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    if (!failed) failed = posix_spawnp(child, name, &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

bool gnuplot_run(const char *script, int output)
{
    FILE *input = script_file(script);
    if (!input) {
        complain("fbd-run: cannot write the script of the plot: %s", strerror(errno));
        return false;
    }
    pid_t child;
    int status = 1, failed = start(fileno(input), output, &child);
    if (failed)
        complain("fbd-run: cannot start gnuplot: %s", strerror(failed));
    else
        while (waitpid(child, &status, 0) < 0 && errno == EINTR) errno = 0;
    fclose(input);
    bool done = !failed && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (!done && !failed) complain("fbd-run: gnuplot failed");
    return done;
}
