/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * 100,000 independent bodies for 10 s in one fbd-run: its memory, and its processor time beside a program that only parses
 * the same file. Odd bodies are oscillators, even ones are thrown and have drag; no two are alike.
 *
 * Usage: bench_many FBD_RUN PARSE_ONLY
 */
#define _DEFAULT_SOURCE 1 /* wait4 */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "claim.h"

enum { bodies = 100000 };

static char name[] = "/tmp/bench_many_XXXXXX";

static void write_scene(FILE *file)
{
    fprintf(file, "fbd: 1\nbodies:\n");
    for (int i = 0; i < bodies; i++) {
        double part = (double)i / bodies;
        fprintf(file, "  b%d:\n    mass: 1 kg\n", i);
        if (i % 2 > 0)
            fprintf(file,
                    "    motion: {slide: {along: 0 deg}}\n    initial: {x: %.6f m}\n"
                    "    forces: [{spring: {stiffness: %.6f N/m}}]\n",
                    0.5 + part, 1 + 9 * part);
        else
            fprintf(file,
                    "    motion: particle\n    initial: {vx: %.6f m/s, vy: %.6f m/s}\n"
                    "    forces: [gravity, {drag: {linear: %.6f N*s/m}}]\n",
                    10 + part, 20 + part, 0.1 + part);
    }
    fprintf(file, "simulate: {until: 10 s}\n");
}

static void fail(const char *program)
{
    fprintf(stderr, "%s failed\n", program);
    unlink(name);
    exit(1);
}

/* The resources of a process whose output goes nowhere. */
static struct rusage run(const char *program, const char *option)
{
    struct rusage usage = {0};
    pid_t child = fork();
    if (child == 0) {
        int nowhere = open("/dev/null", O_WRONLY);
        if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
        if (option)
            execl(program, program, option, name, (char *)NULL);
        else
            execl(program, program, name, (char *)NULL);
        _exit(127);
    }
    int status;
    if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) fail(program);
    return usage;
}

static double seconds(const struct rusage *usage)
{
    return (double)(usage->ru_utime.tv_sec + usage->ru_stime.tv_sec) +
           1e-6 * (double)(usage->ru_utime.tv_usec + usage->ru_stime.tv_usec);
}

int main(int argc, char **argv)
{
    int descriptor = argc == 3 ? mkstemp(name) : -1;
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    if (!file) return 2;
    write_scene(file);
    if (fclose(file)) fail("writing the scene");
    struct rusage parsed = run(argv[2], NULL), ours = run(argv[1], "--quiet");
    double memory = (double)ours.ru_maxrss * 1024; /* Linux counts it in KiB */
    printf("%d independent bodies, 10 s: %.2f s of the processor, %.2f GB; parse only %.2f s\n", bodies,
           seconds(&ours), 1e-9 * memory, seconds(&parsed));
    claim_at_most("1e5 independent bodies, 10 s: processor time beside parsing the file alone",
                  seconds(&ours) / seconds(&parsed), 60);
    claim_at_most("1e5 independent bodies, 10 s: memory in GB", 1e-9 * memory, 1);
    unlink(name);
    return 0;
}
