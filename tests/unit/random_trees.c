/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "random_trees.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int pick(struct random_numbers *numbers, int count)
{
    return (int)(random_bits(numbers) % (unsigned)count);
}

static double some(struct random_numbers *numbers)
{
    return random_between(numbers, -1, 1);
}

static void write_motion(FILE *out, struct random_numbers *numbers, const struct random_tree *tree,
                         int parent, const char **kind)
{
    static const char *const roots[] = {"pivot", "slide", "planar", "pivot"};
    static const char *const joints[] = {"pivot", "slide", "weld", "pivot", "particle", "slide", "planar"};
    *kind = parent < 0 ? roots[pick(numbers, 4)] : joints[pick(numbers, 7)];
    if (tree->pivots) *kind = "pivot";
    fprintf(out, "    motion: {%s: {", *kind);
    if (parent >= 0) fprintf(out, "on: b%d, ", parent);
    double x = some(numbers), y = some(numbers);
    if ((*kind)[0] == 's') fprintf(out, "through: [%g, %g], along: %g rad", x, y, 3 * some(numbers));
    if ((*kind)[0] == 'w') fprintf(out, "at: [%g, %g], angle: %g rad, point: P", x, y, 3 * some(numbers));
    if ((*kind)[1] == 'i') fprintf(out, "at: [%g, %g], point: P", x, y);
    fprintf(out, "}}\n");
}

static void write_forces(FILE *out, struct random_numbers *numbers, const struct random_tree *tree,
                         const char *kind)
{
    bool slide = kind[0] == 's';
    fprintf(out, "    forces:\n      - gravity\n");
    if (pick(numbers, 2))
        fprintf(out, "      - spring: {stiffness: 30, free_length: 0.5, at: P, to: [%g, %g]}\n",
                some(numbers), some(numbers));
    if (slide) fprintf(out, "      - spring: {name: own, stiffness: 40, neutral: 0.1}\n");
    if (tree->conservative) return;
    fprintf(out, "      - applied: {name: jet, value: \"3[N]*sin(2[rad/s]*t)\", angle: \"t*1[rad/s]\", "
                 "frame: body, at: P}\n");
    if (pick(numbers, 2)) fprintf(out, "      - applied: {name: pull, value: [2 N, -3 N], frame: body}\n");
    if (pick(numbers, 2)) fprintf(out, "      - drag: {linear: 0.3, quadratic: 0.2, at: P}\n");
    if (slide) fprintf(out, "      - damper: 0.4\n      - applied: {name: push, value: 3*x}\n");
    if (slide && tree->friction)
        fprintf(out, "      - normal: {two_sided: true}\n      - friction: {static: 0.3, kinetic: %g}\n",
                0.1 + 0.1 * pick(numbers, 2));
}

static const char motor[] = "\"2[N*m]*cos(t*1[rad/s])\"";

static bool is_pivot(const char *kind)
{
    return kind[0] == 'p' && kind[1] == 'i';
}

static bool turns(const char *kind)
{
    return is_pivot(kind) || (kind[0] == 'p' && kind[1] == 'l');
}

static void write_moments(FILE *out, struct random_numbers *numbers, const struct random_tree *tree,
                          int parent, const char *kind)
{
    const bool pivot = is_pivot(kind);
    if (!turns(kind)) return;
    fprintf(out, "    moments:\n      - spring: {stiffness: 5, neutral: %g rad}\n", some(numbers));
    if (tree->conservative) return;
    fprintf(out, "      - damper: 0.2\n");
    if (parent < 0) fprintf(out, "      - applied: {name: motor, value: %s}\n", motor);
    if (pivot && tree->friction) fprintf(out, "      - friction: 0.3 N*m\n");
}

struct written {
    int parent;
    const char *kind;
};

/* A motor on the joint of a body that moves on another one. A particle takes no moment. */
static void write_motor(FILE *out, const struct written *bodies, int b)
{
    const int parent = bodies[b].parent;
    if (parent < 0 || !turns(bodies[b].kind)) return;
    fprintf(out, "  - actuator: {name: motor%d, between: [b%d, ", b, b);
    if (strcmp(bodies[parent].kind, "particle") == 0)
        fprintf(out, "ground");
    else
        fprintf(out, "b%d", parent);
    fprintf(out, "], moment: %s}\n", motor);
}

static struct written write_body(FILE *out, struct random_numbers *numbers, const struct random_tree *tree,
                                 int b)
{
    int parent = b > 0 && pick(numbers, 8) > 0 ? pick(numbers, b) : b > 0 ? -1 : -1;
    const char *kind;
    fprintf(out, "  b%d:\n    mass: %g\n    center: [%g, %g]\n    inertia: %g\n", b,
            random_between(numbers, 0.5, 2), some(numbers), some(numbers), random_between(numbers, 0.1, 1));
    fprintf(out, "    points: {P: [%g, %g]}\n", some(numbers), some(numbers));
    write_motion(out, numbers, tree, parent, &kind);
    write_forces(out, numbers, tree, kind);
    write_moments(out, numbers, tree, parent, kind);
    return (struct written){parent, kind};
}

char *random_tree_text(struct random_numbers *numbers, const struct random_tree *tree)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    fprintf(out, "fbd: 1\nbodies:\n");
    struct written *bodies = calloc((size_t)tree->bodies, sizeof *bodies);
    for (int b = 0; bodies && b < tree->bodies; b++) bodies[b] = write_body(out, numbers, tree, b);
    fprintf(out, "couplings:\n");
    for (int b = 0; bodies && !tree->conservative && b < tree->bodies; b++) write_motor(out, bodies, b);
    free(bodies);
    for (int b = 1; b < tree->bodies; b++)
        fprintf(out, "  - spring: {between: [b%d.P, b%d], stiffness: 20, free_length: 0.7}\n", b,
                pick(numbers, b));
    if (!tree->conservative && tree->bodies > 1)
        fprintf(out, "  - damper: {between: [b1.P, b0.P], coefficient: 0.5}\n");
    for (int k = 0; k < tree->loops; k++) {
        int b = 1 + pick(numbers, tree->bodies - 1);
        if (k % 3 == 0)
            fprintf(out, "  - rod: {between: [b%d.P, ground.A%d]}\n", b, k);
        else if (k % 3 == 1)
            fprintf(out, "  - rod: {between: [b%d.P, b%d]}\n", b, pick(numbers, b));
        else
            fprintf(out, "  - rope: {through: [b%d, ground.A%d, b%d.P]}\n", b, k, pick(numbers, b));
    }
    fprintf(out, "ground: {points: {A0: [3, 1], A1: [-2, 2.5], A2: [0.3, 4]}}\n");
    fprintf(out, "simulate: {until: 0.5 s, tolerance: 1e-11}\n");
    fclose(out);
    return text;
}
