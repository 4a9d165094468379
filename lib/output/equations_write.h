/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The writer of equations walks over the bodies and their equations; a format is a list of such passes, and a
 * pass gives the equations that it includes and the way in which their parts are written.
 */
#ifndef FBD_OUTPUT_EQUATIONS_WRITE_H
#define FBD_OUTPUT_EQUATIONS_WRITE_H

#include "fbd_export.h"
#include "output/formulas.h"
#include "output/idle_lines.h"

struct writer {
    struct text *text;
    struct fbd_state *state;
    fbd_equations *all;       /* at least those of the coordinates, and those of welded bodies cut free */
    bool components;          /* all bodies are cut free */
    bool symbolic;            /* with formulas; also the equations of all bodies cut free */
    struct formulas formulas; /* if `symbolic` */
    size_t written;           /* equations or groups of kinematic lines of this pass so far */
};

/* Functions may be NULL. */
struct equations_pass {
    bool symbolic; /* omitted by a writer without formulas */
    void (*begin)(struct writer *w);
    void (*body)(struct writer *w, int b); /* before its equations */
    bool (*includes)(const struct writer *w, const struct equation *equation);
    void (*equation)(struct writer *w, const struct equation *equation);
    /* after the equations of a body cut free: which of their terms are zero now */
    void (*idle)(struct writer *w, const struct idle_line *line);
    /* and then the acceleration of its G, if it has such lines */
    void (*kinematics)(struct writer *w, int b, const char *const *lines, int count);
    void (*end)(struct writer *w);
};

extern const struct equations_pass text_numbers, text_symbols, latex_equations, mathml_equations,
    json_equations, json_kinematics, json_forces;

/* Write the equations of a state, with the passes of a format; text->failed when memory is out. */
void equations_put(struct text *text, struct fbd_state *state, fbd_format format, bool components);

#endif
