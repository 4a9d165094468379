/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Whole-process time of `fbd-run models/kinetics/incline.yaml`, report only, against a program that links the
 * same two libraries and only parses the same file. Both are started in turn; the median of the ratios of
 * pairs is what counts on a noisy machine.
 *
 * Usage: bench_startup FBD_RUN PARSE_ONLY MODEL
 */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "timing.h"

enum { pairs = 200, warm_up = 10 };

/* Seconds from start to end of a process whose output goes nowhere; ends the benchmark when it fails. */
static double run(char *program, char *model)
{
    double start = wall_seconds();
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
    return wall_seconds() - start;
}

int main(int argc, char **argv)
{
    static double ours[pairs], theirs[pairs], ratios[pairs];
    if (argc != 4) return 2;
    for (int i = -warm_up; i < pairs; i++) {
        double a = run(argv[1], argv[3]), b = run(argv[2], argv[3]);
        if (i < 0) continue;
        ours[i] = a;
        theirs[i] = b;
        ratios[i] = a / b;
    }
    double ratio = median(ratios, pairs);
    printf("fbd-run %.3f ms, parse only %.3f ms, median ratio of %d pairs %.2f (quartiles %.2f to %.2f)\n",
           1e3 * median(ours, pairs), 1e3 * median(theirs, pairs), pairs, ratio, ratios[pairs / 4],
           ratios[3 * pairs / 4]);
    return 0;
}
