/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "watch.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "complain.h"
#include "interrupt.h"

/* A changed file is read after it has stayed unchanged for one interval; a missing file is awaited for a
 * while, since an editor may be replacing it. In milliseconds. */
enum { between_looks = 100, most_settling = 2000, most_absence = 1000 };

/* ---- files */

struct look {
    bool found;
    dev_t device;
    ino_t inode;
    off_t size;
    time_t seconds;
    long nanoseconds;
};

/* Names reported by a run, each with its terminating zero; the model is always the first. */
struct files {
    char *names;
    size_t length, room;
};

struct watching {
    const struct watch *watch;
    struct interrupt interrupt;
    struct files files, told; /* of the last completed run, and of the current one */
    struct look *looks;       /* status of `files` before they were read */
    struct timespec begun;
    unsigned long runs;
};

static struct look look_at(const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0) return (struct look){.found = false};
#ifdef __APPLE__
    long nanoseconds = status.st_mtimespec.tv_nsec;
#else
    long nanoseconds = status.st_mtim.tv_nsec;
#endif
    return (struct look){true, status.st_dev, status.st_ino, status.st_size, status.st_mtime, nanoseconds};
}

static bool same_look(const struct look *a, const struct look *b)
{
    return a->found == b->found && a->device == b->device && a->inode == b->inode && a->size == b->size &&
           a->seconds == b->seconds && a->nanoseconds == b->nanoseconds;
}

static const char *next_name(const struct files *files, const char *name)
{
    const char *next = name ? name + strlen(name) + 1 : files->names;
    return next < files->names + files->length ? next : NULL;
}

static bool add_names(struct files *files, const char *text, size_t length)
{
    if (files->length + length > files->room) {
        size_t room = 2 * (files->length + length);
        char *names = realloc(files->names, room);
        if (!names) return false;
        files->names = names;
        files->room = room;
    }
    memcpy(files->names + files->length, text, length);
    files->length += length;
    return true;
}

/* The first file whose status has changed, or NULL. */
static const char *changed_file(const struct watching *w)
{
    size_t i = 0;
    for (const char *name = next_name(&w->files, NULL); name; name = next_name(&w->files, name), i++) {
        struct look now = look_at(name);
        if (!same_look(&now, &w->looks[i])) return name;
    }
    return NULL;
}

/* True if the file was watched before; *look is then its earlier status. */
static bool known_look(const struct watching *w, const char *path, struct look *look)
{
    size_t i = 0;
    for (const char *name = next_name(&w->files, NULL); name; name = next_name(&w->files, name), i++) {
        if (strcmp(name, path) != 0) continue;
        *look = w->looks[i];
        return true;
    }
    return false;
}

/* The status of a newly watched file. If it changed after the run began, it must be read again: return an
 * impossible size. */
static struct look first_look(const struct watching *w, const char *path)
{
    struct look look = look_at(path);
    bool later = look.seconds > w->begun.tv_sec ||
                 (look.seconds == w->begun.tv_sec && look.nanoseconds > w->begun.tv_nsec);
    if (look.found && later) look.size = -1;
    return look;
}

/* Watch the files reported by the last run. */
static bool take_told(struct watching *w)
{
    size_t count = 0, i = 0;
    for (const char *name = next_name(&w->told, NULL); name; name = next_name(&w->told, name)) count++;
    struct look *looks = calloc(count + 1, sizeof *looks);
    if (!looks) return false;
    for (const char *name = next_name(&w->told, NULL); name; name = next_name(&w->told, name), i++)
        if (!known_look(w, name, &looks[i])) looks[i] = first_look(w, name);
    free(w->files.names);
    free(w->looks);
    w->files = w->told;
    w->looks = looks;
    w->told = (struct files){0};
    return true;
}

/* ---- waiting */

static void sleep_a_look(void)
{
    struct timespec pause = {0, between_looks * 1000000L};
    nanosleep(&pause, NULL);
}

/* Update the status of all files; true when one has changed since the last update. */
static bool look_again(struct watching *w, bool *all_there)
{
    bool differs = false;
    size_t i = 0;
    *all_there = true;
    for (const char *name = next_name(&w->files, NULL); name; name = next_name(&w->files, name), i++) {
        struct look now = look_at(name);
        differs |= !same_look(&now, &w->looks[i]);
        *all_there &= now.found;
        w->looks[i] = now;
    }
    return differs;
}

static void wait_until_settled(struct watching *w)
{
    bool all_there = false;
    look_again(w, &all_there);
    for (int waited = 0; waited < most_settling && !interrupt_asked(&w->interrupt); waited += between_looks) {
        sleep_a_look();
        bool differs = look_again(w, &all_there);
        if (!differs && (all_there || waited >= most_absence)) return;
    }
}

static void wait_for_change(struct watching *w)
{
    const char *changed = changed_file(w);
    if (interrupt_asked(&w->interrupt)) return;
    if (!changed && !w->watch->quiet) complain("%s: waiting for changes; Ctrl-C ends", w->watch->program);
    while (!changed && !interrupt_asked(&w->interrupt)) {
        sleep_a_look();
        changed = changed_file(w);
    }
    if (!changed) return;
    if (!w->watch->quiet) complain("%s: %s has changed", w->watch->program, changed);
    wait_until_settled(w);
}

/* ---- a run */

/* Runs in the child process. */
_Noreturn static void be_run(const struct watching *w, int descriptor)
{
    char stamp[64];
    snprintf(stamp, sizeof stamp, "%lld-%lu", (long long)w->begun.tv_sec, w->runs);
    struct watched_run run = {descriptor, stamp};
    interrupt_release(&w->interrupt);
    exit((int)w->watch->run(w->watch->context, &run));
}

/* Read the names reported by the run until it ends; false when memory is out. End the run when a signal is
 * pending, or a watched file has changed. */
static bool listen(struct watching *w, int descriptor, pid_t child)
{
    bool ended = false, kept = true;
    for (;;) {
        struct pollfd asked = {.fd = descriptor, .events = POLLIN};
        char text[4096];
        int ready = poll(&asked, 1, between_looks);
        ssize_t length = ready > 0 ? read(descriptor, text, sizeof text) : 0;
        if (ready > 0 && length <= 0) return kept;
        if (length > 0) kept = add_names(&w->told, text, (size_t)length) && kept;
        if (ended || !(interrupt_asked(&w->interrupt) || changed_file(w))) continue;
        ended = true;
        kill(child, SIGTERM);
    }
}

/* After SIGPIPE of a run end the watch too: the reader of the report is gone. */
static void take_end(const struct watching *w, int status)
{
    if (!WIFSIGNALED(status)) return;
    int number = WTERMSIG(status);
    if (number == SIGPIPE)
        raise(SIGPIPE);
    else if (number != SIGTERM && number != SIGINT && number != SIGHUP)
        complain("%s: the run was ended by signal %d", w->watch->program, number);
}

static bool cannot_start(const struct watching *w)
{
    complain("%s: cannot start a run: %s", w->watch->program, strerror(errno));
    return false;
}

static bool make_run(struct watching *w)
{
    int ends[2], status = 0;
    fflush(stdout);
    clock_gettime(CLOCK_REALTIME, &w->begun);
    w->runs++;
    w->told.length = 0;
    if (pipe(ends) != 0) return cannot_start(w);
    (void)fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    (void)fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        be_run(w, ends[1]);
    }
    if (child < 0) cannot_start(w);
    close(ends[1]);
    bool kept = child > 0 && listen(w, ends[0], child);
    close(ends[0]);
    if (child < 0) return false;
    waitpid(child, &status, 0);
    take_end(w, status);
    /* The run may have ended before it reported any file. */
    if (kept && w->told.length == 0) kept = add_names(&w->told, w->watch->model, strlen(w->watch->model) + 1);
    if (kept) kept = take_told(w);
    if (!kept) complain("%s: out of memory", w->watch->program);
    return kept;
}

bool watch_is_possible(const struct command_line *line)
{
    (void)line;
    return true;
}

enum exit_code watch_files(const struct watch *watch)
{
    struct watching w = {.watch = watch};
    interrupt_hold(&w.interrupt);
    bool going = add_names(&w.told, watch->model, strlen(watch->model) + 1) && take_told(&w);
    if (!going) complain("%s: out of memory", watch->program);
    if (going) w.looks[0] = look_at(watch->model);
    while (going && !interrupt_asked(&w.interrupt)) {
        going = make_run(&w);
        if (going) wait_for_change(&w);
    }
    if (watch->end) watch->end(watch->context);
    free(w.files.names);
    free(w.told.names);
    free(w.looks);
    interrupt_release(&w.interrupt);
    return exit_failed;
}

void watch_tell(const struct watched_run *run, const fbd_errors *errors)
{
    const char *path;
    for (size_t i = 0; (path = fbd_errors_file(errors, i)) != NULL; i++)
        for (size_t sent = 0, size = strlen(path) + 1; sent < size;) {
            ssize_t length = write(run->descriptor, path + sent, size - sent);
            if (length < 0 && errno != EINTR) return;
            if (length > 0) sent += (size_t)length;
        }
}
