/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the files that write a scene share.
 */
#ifndef CROSS_WRITER_H
#define CROSS_WRITER_H

#include "write.h"

struct writer {
    const struct scene *scene;
    char *text;
    size_t length;
    const char *between; /* two keys */
};

__attribute__((format(printf, 2, 3))) void say(struct writer *w, const char *format, ...);
void say_number(struct writer *w, double value);
void say_pair(struct writer *w, struct vec2 p);
/* A formula as a value, or its summands between what else there is. */
void say_formula(struct writer *w, int own, const struct formula *formula);
void say_summands(struct writer *w, int own, const struct formula *formula);
void key_formula(struct writer *w, const char *key, int own, const struct formula *formula);
void key_number(struct writer *w, const char *key, double value);

/* The shortest text that gives the number back. */
const char *number_text(double value, char text[32]);

/* A point of a body, or of the ground (-1). */
void say_spot(struct writer *w, int body, const struct spot *spot);

/* The curve of a track or slot; tables and states of the scene (write_functions.c). */
void say_path(struct writer *w, const struct path *path);
void say_tables(struct writer *w);
void say_states(struct writer *w);

/* write_couplings.c */
void say_coupling(struct writer *w, int c);

/* Its forces, or its moments (write_loads.c). */
void say_loads(struct writer *w, int b, bool moments);

#endif
