/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Law: a force or moment of the model language, as one row of a table (language_loads.c).
 *
 * A law has a form, its load_kind, which determines how its force is computed: from a formula of the file, as
 * a spring between points, as drag at a point, as the slope of a potential, ... Wrench, variation, potential
 * and degree are those of the form. The law adds its keys and names: a constant power is the form of an
 * applied force whose formula is P/v, with derivatives, potential, degree and divisions as any formula has
 * them.
 */
#ifndef FBD_SCENE_LAW_H
#define FBD_SCENE_LAW_H

#include "scene/loads.h"

struct entry;

/* Where it acts: on the body, from outside, or between the body and its parent. */
enum law_place { acts_on_body, acts_in_joint, acts_in_joint_without_end };

/* Dependence on the velocity. */
enum law_rate { rate_by_formulas, rate_always, rate_never };

struct law {
    const char *effect;  /* in words, for --explain */
    const char *drawing; /* the class of its arrow */
    const char *letter;  /* in symbols, as T; NULL: its name */
    enum law_place place;
    enum law_rate rate;
    bool follows;         /* a reaction: it follows from the other forces */
    bool written_as_c;    /* supported by --emit-c */
    bool of_constraint;   /* not listed under `forces`: it represents a coupling */
    const char *work;     /* reason why it has no potential, independent of its keys and formulas; or NULL */
    const char *singular; /* message where it is infinite, or NULL */

    /* Checks that involve several keys, and values derived from the keys; or NULL. */
    bool (*finish)(struct entry *entry);

    /* The component along its coordinate in a few symbols, `#` for the coordinate, `@` for its rate and `$`
     * for the letter of the axis; and the law where it acts `between` two points. NULL: none, or one that
     * depends on its keys. `centered`: the formula where `neutral` is zero. */
    const char *formula;
    const char *centered;
    const char *between;

    /* True if it can act across a slide in the direction `along`. NULL: never. */
    bool (*across)(const struct load *load, struct vec gravity, double along);
};

/* The law of a load that was not read from a list, as that of a coupling. */
const struct law *law_of_form(enum load_kind form);

static inline const struct law *load_law(const struct load *load)
{
    return load->law ? load->law : law_of_form(load->kind);
}

#endif
