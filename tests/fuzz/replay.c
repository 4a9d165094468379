/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A target without libFuzzer: TARGET TIMES FOLDER...
 *
 * Gives the target every file below the folders, some to a process, and where one of them fails each in a process of its
 * own, so that one that crashes does not hide the others; and TIMES more, each with other choices (fuzz.h). One claim in
 * TAP for each folder.
 */
#include <ftw.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fuzz.h"
#include "random_numbers.h"

enum {
    most_files = 10000,
    together =
        16, /* files to a process: its end takes longer than a file under a sanitizer, which looks for leaks */
    most_seconds = 120 /* of processor time for a process, under any sanitizer */
};

struct files {
    char **paths;
    size_t count;
};

static struct files found; /* nftw has no context */

static int note_file(const char *path, const struct stat *status, int type, struct FTW *at)
{
    (void)status, (void)at;
    if (type == FTW_F && found.count < most_files) found.paths[found.count++] = strdup(path);
    return 0;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Give the target a file, behind `line`. */
static void give(const char *path, const char *line)
{
    struct stat status;
    FILE *stream = fopen(path, "r");
    if (!stream || fstat(fileno(stream), &status) != 0) exit(EXIT_FAILURE);
    size_t start = strlen(line), room = start + (size_t)status.st_size;
    char *text = malloc(room);
    memcpy(text, line, start);
    size_t length = start + fread(text + start, 1, room - start, stream);
    fclose(stream);
    LLVMFuzzerTestOneInput((const uint8_t *)text, length);
    free(text);
}

/* Choices that are the same in every run of the test, and others for every file. */
static void give_all(const char *path, size_t file, unsigned long times)
{
    struct random_numbers random = {file};
    give(path, "");
    for (unsigned long i = 0; i < times; i++) {
        char line[24];
        snprintf(line, sizeof line, "#?%016" PRIx64 "\n", random_bits(&random));
        give(path, line);
    }
}

/* Are so many files, from `first` on, given to one process without a fault? */
static bool survive(size_t first, size_t count, unsigned long times)
{
    int status = 0;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        setrlimit(RLIMIT_CPU, &(struct rlimit){most_seconds, most_seconds + 1});
        for (size_t i = first; i < first + count; i++) give_all(found.paths[i], i, times);
        exit(EXIT_SUCCESS);
    }
    return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

/* The claim about a folder. */
static bool replay(const char *folder, int number, unsigned long times)
{
    size_t failed = 0;
    found.paths = calloc(most_files, sizeof *found.paths);
    found.count = 0;
    if (nftw(folder, note_file, 16, FTW_PHYS) != 0) failed = 1;
    qsort(found.paths, found.count, sizeof *found.paths, by_name);
    for (size_t i = 0; i < found.count; i += together) {
        size_t count = found.count - i < together ? found.count - i : together, before = failed;
        if (survive(i, count, times)) continue;
        for (size_t k = i; k < i + count; k++) {
            if (survive(k, 1, times)) continue;
            printf("# fails: %s\n", found.paths[k]);
            failed++;
        }
        if (failed == before) { /* none alone */
            printf("# fail together: %s and %zu more\n", found.paths[i], count - 1);
            failed++;
        }
    }
    for (size_t i = 0; i < found.count; i++) free(found.paths[i]);
    free(found.paths);
    const char *name = strrchr(folder, '/');
    printf("%s %d - nothing is found in the %zu files of %s\n", failed || !found.count ? "not ok" : "ok",
           number, found.count, name ? name + 1 : folder);
    return failed == 0 && found.count > 0;
}

int main(int argc, char **argv)
{
    bool fine = true;
    LLVMFuzzerInitialize(NULL, NULL);
    for (int i = 2; i < argc; i++) fine = replay(argv[i], i - 1, strtoul(argv[1], NULL, 10)) && fine;
    printf("1..%d\n", argc > 2 ? argc - 2 : 0);
    return fine ? EXIT_SUCCESS : EXIT_FAILURE;
}
