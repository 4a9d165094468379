/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows of contact and friction between bodies in the plane at rest, assembled without the library, for the pivoting kernel.
 */
#ifndef FBD_TESTS_CONTACT_ROWS_H
#define FBD_TESTS_CONTACT_ROWS_H

#include <stddef.h>

#include "base/vec.h"
#include "numeric/pivoting.h"

struct plane_body {
    struct vec at, a; /* centre of mass, and its acceleration without contacts */
    double mass, inertia, alpha;
};

struct contact_rows {
    size_t body_count;
    struct plane_body *bodies;
    struct pivoting_problem problem;
    double *A, *J; /* J: 3 velocities of each body for each row */
    size_t most;
};

enum { the_ground = -1 };

/* Memory for `bodies` bodies and `most` rows; the program ends where there is none. */
void contact_rows_new(struct contact_rows *of, size_t bodies, size_t most);
void contact_rows_free(struct contact_rows *of);

/* Body `upper` on body `lower` or the ground at a point, with the normal towards `upper`: a half-line, and with mu > 0 a row
 * of friction after it. */
void contact_rows_add(struct contact_rows *of, int upper, int lower, struct vec point, struct vec normal,
                      double mu);

/* Compute A and b. All modes become those of open contacts. */
void contact_rows_assemble(struct contact_rows *of);

/* A wall of bricks 2 by 1 on the ground, each course offset by half a brick, `wide` bricks in a course. */
void contact_rows_wall(struct contact_rows *of, int courses, int wide, double mu);

/* `count` discs of radius 1, three in a row, in a bin whose rows lie in the hollows of those below. */
void contact_rows_bin(struct contact_rows *of, int count, double mu);

struct random_numbers;

/* A block with contacts at `points` points of its lower side and friction, under a random load within its reach. */
void contact_rows_block(struct contact_rows *of, int points, struct random_numbers *numbers);

/* How much the laws of all rows are violated by x and w at most, relative to the largest |b| of unit diagonal; w is computed
 * anew. */
double contact_rows_error(const struct contact_rows *of);

#endif
