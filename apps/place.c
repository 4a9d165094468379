/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "place.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- links */

enum { most_links = 40 }; /* the limit of Linux */

/* The length of the folder of a path with its last slash; 0 for the working directory. */
static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

static bool too_long(void)
{
    errno = ENAMETOOLONG;
    return false;
}

/* Replace the link `path` by its target, which is relative to its folder. False with errno set, EINVAL if it
 * is not a link. */
static bool follow(char path[place_size])
{
    char link[place_size];
    ssize_t length = readlink(path, link, sizeof link);
    if (length < 0) return false;
    size_t folder = length > 0 && link[0] == '/' ? 0 : folder_length(path);
    if (folder + (size_t)length >= place_size) return too_long();
    memcpy(path + folder, link, (size_t)length);
    path[folder + (size_t)length] = '\0';
    return true;
}

/* 3 for "/dev/fd/3". */
static int descriptor_named(const char *path)
{
    static const char *const folders[] = {"/dev/fd/", "/proc/self/fd/", "/proc/thread-self/fd/"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        size_t length = strlen(folders[i]);
        const char *digits = path + length;
        if (strncmp(path, folders[i], length) != 0) continue;
        if (*digits && !digits[strspn(digits, "0123456789")] && strlen(digits) < 10)
            return (int)strtol(digits, NULL, 10);
    }
    return -1;
}

/* Follow the links at the end of a path, and stop at one that denotes an open file: its target may be a
 * deleted file, or the file may be open at another position. */
static bool resolve(const char *path, char target[place_size], int *descriptor)
{
    size_t length = strlen(path);
    if (length >= place_size) return too_long();
    memcpy(target, path, length + 1);
    for (int links = 0; links < most_links; links++) {
        *descriptor = descriptor_named(target);
        if (*descriptor >= 0) return true;
        if (!follow(target)) return errno != ENAMETOOLONG;
    }
    errno = ELOOP;
    return false;
}

int place_descriptor(const char *path)
{
    char target[place_size];
    int descriptor = -1;
    if (strcmp(path, "-") == 0) return STDOUT_FILENO;
    return resolve(path, target, &descriptor) ? descriptor : -1;
}

bool place_is_stdout(const char *path)
{
    return path && place_descriptor(path) == STDOUT_FILENO;
}

bool place_target(const char *path, char target[place_size])
{
    int descriptor;
    return resolve(path, target, &descriptor);
}

/* ---- identity */

/* Identification of a file. A file that does not exist yet is identified by its folder and its name in it. */
struct identity {
    bool found, regular, nothing; /* `nothing`: /dev/null */
    dev_t device;
    ino_t inode;
    char name[place_size]; /* "" for existing files */
};

static bool is_null_device(const struct stat *status)
{
    struct stat null;
    return S_ISCHR(status->st_mode) && stat("/dev/null", &null) == 0 && null.st_rdev == status->st_rdev;
}

static void set_identity(struct identity *identity, const struct stat *status)
{
    identity->found = true;
    identity->regular = S_ISREG(status->st_mode);
    identity->nothing = is_null_device(status);
    identity->device = status->st_dev;
    identity->inode = status->st_ino;
}

/* `standard` is the descriptor of "-": standard input for a model, standard output for an output. */
static void identify(const char *path, int standard, struct identity *identity)
{
    struct stat status;
    int descriptor = strcmp(path, "-") == 0 ? standard : place_descriptor(path);
    *identity = (struct identity){0};
    if ((descriptor >= 0 ? fstat(descriptor, &status) : stat(path, &status)) == 0) {
        set_identity(identity, &status);
        return;
    }
    char folder[place_size];
    if (descriptor >= 0 || !place_target(path, folder)) return;
    size_t length = folder_length(folder);
    memcpy(identity->name, folder + length, strlen(folder + length) + 1);
    if (length + 1 == place_size) return;
    memcpy(folder + length, ".", 2);
    if (stat(folder, &status) != 0) return;
    set_identity(identity, &status);
    identity->regular = true; /* a new output becomes a regular file */
}

static bool same_identity(const struct identity *a, const struct identity *b)
{
    return a->found && b->found && a->device == b->device && a->inode == b->inode &&
           strcmp(a->name, b->name) == 0;
}

/* True if writing `b` would overwrite `a`. A terminal may be read and written, and /dev/null written several
 * times. */
static bool same_place(const char *a, int standard, const char *b)
{
    struct identity one, other;
    if (standard == STDOUT_FILENO && place_is_stdout(a) && place_is_stdout(b)) return true;
    identify(a, standard, &one);
    identify(b, STDOUT_FILENO, &other);
    if (one.nothing || (standard == STDIN_FILENO && !one.regular)) return false;
    return same_identity(&one, &other);
}

static bool refuse(const struct command_line *line, const struct output_place *output, const char *what)
{
    char message[200];
    snprintf(message, sizeof message, "%s would %s: ", output->option, what);
    return command_line_usage(line, message, output->path);
}

bool places_spare(const struct command_line *line, const fbd_errors *errors,
                  const struct output_place *outputs, size_t count)
{
    const char *file;
    for (size_t k = 0; (file = fbd_errors_file(errors, k)) != NULL; k++)
        for (size_t i = 0; i < count; i++)
            if (outputs[i].path && same_place(file, STDIN_FILENO, outputs[i].path))
                return refuse(line, &outputs[i], "overwrite a file that the model reads");
    return true;
}

bool places_differ(const struct command_line *line, const char *model, const struct output_place *outputs,
                   size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!outputs[i].path) continue;
        if (same_place(model, STDIN_FILENO, outputs[i].path))
            return refuse(line, &outputs[i], "be written over the model file");
        for (size_t k = 0; k < i; k++) {
            if (!outputs[k].path || !same_place(outputs[k].path, STDOUT_FILENO, outputs[i].path)) continue;
            return command_line_usage(line, "two outputs cannot go to the same place: ", outputs[i].path);
        }
    }
    return true;
}
