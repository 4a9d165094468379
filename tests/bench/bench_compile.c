/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Time and memory of reading and compiling scenes of 1 000, 10 000 and 100 000 bodies, each in a process of
 * its own: the processor time of fbd_model_parse, and the most memory that the process has had. The text of
 * the scene, which the caller made, is a part of that memory.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "fbd.h"

static const int sizes[] = {1000, 10000, 100000};

static const int judged = 10000;
static const double most_seconds = 1, most_megabytes = 100;

static const char head[] = "fbd: 1\nparameters:\n  k: 200 N/m\n  f0: 5 N\nbodies:\n";

/* Two kinds of bodies in turn: a block with friction and a driven spring, a pendulum with a damper. */
static const char block[] = "  block%d:\n"
                            "    mass: 2 kg\n"
                            "    motion: {slide: {along: 30 deg}}\n"
                            "    initial: {v: 1 m/s}\n"
                            "    forces:\n"
                            "      - gravity\n"
                            "      - normal\n"
                            "      - friction: {static: 0.5, kinetic: 0.4}\n"
                            "      - spring: {stiffness: k}\n"
                            "      - applied: {name: push, value: \"f0*sin(3*t)\"}\n";
static const char pendulum[] = "  pendulum%d:\n"
                               "    motion: {pivot: {at: [0, 0]}}\n"
                               "    parts:\n"
                               "      rod: {shape: rod, mass: 0.5 kg, from: [0, 0], to: [0, -1 m]}\n"
                               "      bob: {shape: point, mass: 2 kg, center: [0, -1 m]}\n"
                               "    initial: {theta: 60 deg}\n"
                               "    forces: [gravity]\n"
                               "    moments:\n"
                               "      - damper: {coefficient: 0.1 N*m*s/rad}\n";

static char *scene_of(int bodies, size_t *length)
{
    size_t room = sizeof head + (size_t)bodies * (sizeof block + sizeof pendulum) + 64, used;
    char *text = malloc(room);
    if (!text) exit(1);
    used = (size_t)snprintf(text, room, "%s", head);
    for (int i = 0; i < bodies; i++) {
        /* A format of its own in each branch, so that the compiler can check it. */
        int written = i % 2 == 0 ? snprintf(text + used, room - used, block, i)
                                 : snprintf(text + used, room - used, pendulum, i);
        used += (size_t)written;
    }
    used += (size_t)snprintf(text + used, room - used, "simulate: {until: 1 s}\n");
    *length = used;
    return text;
}

static double processor_seconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* In the child: compile, and tell the seconds. */
static int compile(int bodies, int out)
{
    size_t length;
    char *text = scene_of(bodies, &length);
    fbd_errors *errors = fbd_errors_new();
    double start = processor_seconds();
    fbd_model *model = fbd_model_parse(text, length, "bench", NULL, 0, errors);
    double seconds = processor_seconds() - start;
    fbd_errors_print(errors, stderr);
    bool told = write(out, &seconds, sizeof seconds) == (ssize_t)sizeof seconds;
    fbd_model_free(model);
    fbd_errors_free(errors);
    free(text);
    return model && told ? 0 : 1;
}

static void measure(int bodies, double *before)
{
    int ends[2], status;
    struct rusage usage;
    double seconds = 0;
    if (pipe(ends) != 0) exit(1);
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) _exit(compile(bodies, ends[1]));
    if (child < 0 || read(ends[0], &seconds, sizeof seconds) != (ssize_t)sizeof seconds ||
        waitpid(child, &status, 0) != child || status != 0)
        exit(1);
    getrusage(RUSAGE_CHILDREN, &usage); /* the largest child so far: sizes ascend */
    close(ends[0]);
    close(ends[1]);
    double megabytes = (double)usage.ru_maxrss / 1024;
    printf("%6d bodies: %7.3f s, %6.1f us each, %6.1f MB", bodies, seconds, 1e6 * seconds / bodies,
           megabytes);
    if (*before > 0) printf("; 10 times the bodies, %.1f times the time", seconds / *before);
    if (bodies == judged)
        printf("; bounds %g s, %g MB: %s", most_seconds, most_megabytes,
               seconds <= most_seconds && megabytes <= most_megabytes ? "met" : "NOT met");
    printf("\n");
    *before = seconds;
}

int main(void)
{
    double before = 0;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) measure(sizes[i], &before);
    return 0;
}
