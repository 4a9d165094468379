/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies of several parts, as text and with their mass by hand. cmocka.h comes first.
 */
#ifndef FBD_TESTS_ASSEMBLIES_H
#define FBD_TESTS_ASSEMBLIES_H

#include "base/vec.h"
#include "random_numbers.h"
#include "written.h"

static inline int choose(struct random_numbers *numbers, int count)
{
    return (int)(random_bits(numbers) % (uint64_t)count);
}

enum { most_corners = 16 };

struct assembly {
    struct written parts;
    int part_count, corner_count;
    struct vec corner[most_corners], G;
    double m, I; /* about the origin until it is closed, then about G */
};

/* Two to four prisms in one place; a frame of rods; rods that part from a point; a prism with rods on its sides. */
void assembly_draw(struct random_numbers *numbers, struct assembly *body);

/* The block below, struck at its origin, where its parts join. */
void assembly_draw_block(struct random_numbers *numbers, struct assembly *body);

/* A box a by b of mass m and even density, as columns and rows of prisms. */
void assembly_box(struct assembly *body, double m, double a, double b, int columns, int rows);

#endif
