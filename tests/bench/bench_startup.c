/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Whole-process time of `fbd-run models/kinetics/incline.yaml`, report only, against a program that links the
 * same two libraries and only parses the same file. Both are started in turn; the median of the ratios of
 * pairs, of the processor time of both from fork to exit, is what counts on a noisy machine; the wall time is told.
 *
 * Usage: bench_startup FBD_RUN PARSE_ONLY MODEL
 */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "claim.h"
#include "timing.h"

enum { pairs = 200, warm_up = 10 };

static double children_seconds(void)
{
    struct rusage usage;
    getrusage(RUSAGE_CHILDREN, &usage);
    return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/* Processor time from start to end of a process whose output goes nowhere, and its wall time; ends the benchmark when
 * it fails. */
static double run(char *program, char *model, double *wall)
{
    double start = wall_seconds(), before = children_seconds();
    pid_t child = fork();
    if (child == 0) {
        int nowhere = open("/dev/null", O_WRONLY);
        if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
        execl(program, program, model, (char *)NULL);
        _exit(127);
    }
    int status;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
        fprintf(stderr, "%s failed\n", program);
        exit(1);
    }
    *wall = wall_seconds() - start;
    return children_seconds() - before;
}

int main(int argc, char **argv)
{
    static double ours[pairs], theirs[pairs], ratios[pairs], walls[pairs];
    if (argc != 4) return 2;
    for (int i = -warm_up; i < pairs; i++) {
        double wall, other, a = run(argv[1], argv[3], &wall), b = run(argv[2], argv[3], &other);
        if (i < 0) continue;
        ours[i] = a;
        theirs[i] = b;
        ratios[i] = a / b;
        walls[i] = wall / other;
    }
    double ratio = median(ratios, pairs);
    printf("fbd-run %.3f ms, parse only %.3f ms, of the processor, median ratio of %d pairs %.2f (quartiles "
           "%.2f to "
           "%.2f), of wall time %.2f\n",
           1e3 * median(ours, pairs), 1e3 * median(theirs, pairs), pairs, ratio, ratios[pairs / 4],
           ratios[3 * pairs / 4], median(walls, pairs));
    claim_at_most("start of fbd-run, beside a program that links the same libraries and parses the same file",
                  ratio, 1.2);
    return 0;
}
