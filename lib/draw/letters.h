/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Letters: the texts of given quantities in a figure. A quantity that the file gives as a parameter
 * (`length: l`) has its letter, and the figure a list of these parameters with their values; one that the file
 * gives as a number has its value.
 */
#ifndef FBD_DRAW_LETTERS_H
#define FBD_DRAW_LETTERS_H

#include "base/arena.h"
#include "document/node.h"
#include "fbd_view.h"

struct letters {
    struct arena *arena;
    const fbd_model *model;
    const struct node *root; /* of the file; NULL if it cannot be read */
    const char *
        *units; /* of each parameter with a letter in the figure, in which its value is listed; else NULL */
};

/* Read the file of the model. Returns false when memory is out. */
bool letters_open(struct letters *letters, const fbd_model *model, struct arena *arena);

/* The mapping of the file with the keys of a part of a body, or NULL; the values of its keys are found by letters_text. */
const struct node *letters_part(const struct letters *letters, const char *body, size_t part);

/* The mapping of a force, a coupling or a contact, of the body or of `couplings`; or NULL. */
const struct node *letters_entry(const struct letters *letters, const char *body, const char *name);

/* The mapping of the keys of a slide, pivot or other motion of the body; NULL where it has none. */
const struct node *letters_motion(const struct letters *letters, const char *body);

/* The letter of the angle `along` of a slide; NULL if it is a number or an expression. */
const char *letters_slope(const struct letters *letters, const char *body);

/* The text of a quantity: the letter of its parameter, as svg_text takes it, else `value`, or if that is NAN the
 * number of the file. `unit` is its coherent unit. NULL if the file does not give it, or by an expression without
 * `value`. */
const char *letters_text(struct letters *letters, const struct node *map, const char *key, double value,
                         const char *unit);

/* The letter of a parameter that both has this value and occurs in the expressions of one of two keys that are there; else
 * the value. */
const char *letters_same(struct letters *letters, const struct node *map, const char *const keys[2],
                         double value, const char *unit);

/* The list of the letters with their values: "m = 2 kg", "l = 1.5 m". `index` counts from 0; NULL past the last one. */
const char *letters_listed(struct letters *letters, size_t index);

#endif
