/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Compare the forces of a body at the same states of the key and of an answer.
 */
#ifndef FBD_GRADE_COMPARE_H
#define FBD_GRADE_COMPARE_H

#include <string.h>

#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/grade.h"

/* A force and a moment at one state: in the world, in the units of the key, about the key's centre of mass. */
struct action {
    struct vec force, point;
    double moment;
    double arm;                 /* of its line of action from there */
    double mu_s, mu_k, surface; /* of friction */
};

/* One force or moment of a body at every state: one that it lists, or a reaction of the key. */
struct item {
    fbd_listed_force force;         /* at the last state */
    const fbd_listed_force *source; /* that, of a listed one; NULL for a reaction */
    const char *name;
    bool follows; /* depends on the other forces */
    bool used;    /* already paired */
    bool unknown; /* of an answer: no magnitude; `at` has one of 1 N or 1 N m, */
    bool free;    /* and no direction */

    /* of a reaction */
    bool asked;     /* it has to be drawn */
    bool one_sided; /* tension or compression only */
    bool couples;   /* it may be a force with a moment: of a weld or a guide */
    int contact;    /* the contact that it is part of, or -1 */

    bool any;          /* any direction, as of a pin; */
    bool single;       /* a single force is right for it, without its zero component */
    struct vec across; /* else its line, at the start; of a normal force: its direction */
    struct action at[most_grade_samples];
    struct vec about[most_grade_samples]; /* the centre of mass of the key's body */
};

/* Both sides of a body. */
struct sides {
    size_t samples;
    bool like_start[most_grade_samples]; /* the body slips as it does at the start */
    bool possible
        [most_grade_samples]; /* the key has an admissible motion there, so its reactions are defined */
    bool starts[most_grade_samples];      /* it is the start, perhaps at another time, */
    double times[most_grade_samples];     /* which is this */
    bool turns;                           /* moments about G matter */
    double turned;                        /* angle of the answer's frame in the body, relative to the key's */
    double tolerance, force, arm, moment; /* reference magnitudes */
    double reach; /* distance of reactions from G: the tolerance of directions is relative to it */
    size_t key_count, count, reaction_count;
    struct item *key, *items, *reactions;
};

/* Place the arrows of a drawing on the forces of the key that they were drawn for, within the tolerances of a
 * drawing (sketch.c). False when memory is out. */
bool sketches_place(const struct fbd_grade *grade, struct sides *sides);

/* True if an item is still to be paired by its value. */
static inline bool is_left(const struct item *item)
{
    return !item->used && item->source && !item->unknown;
}

/* True if both are of the same law: entries of the file. */
static inline bool are_alike(const struct item *a, const struct item *b)
{
    return strcmp(a->source->law, b->source->law) == 0;
}

static inline struct pos position_of(const fbd_listed_force *force)
{
    return (struct pos){force->line, force->column};
}

/* Difference of a force of the answer from one of the key. */
enum relation { is_same, is_opposite, is_elsewhere, is_turned, is_scaled, is_rougher, is_other };

struct difference {
    enum relation relation;
    double ratio;   /* is_scaled: of the magnitudes, constant; NAN when it varies */
    double angle;   /* is_turned: by this much [rad], constant; NAN when it varies */
    bool exchanged; /* is_turned: its components are exchanged */
};

struct difference difference_of(const struct sides *sides, const struct item *key, const struct item *item);

/* True if the sum of some items equals another one at every state. */
bool adds_up(const struct sides *sides, const struct item *const *parts, size_t count,
             const struct item *sum);

/* True if the answer has a normal force or friction for that of the key, which is then compared with it
 * instead of with a formula. */
bool is_drawn_as_such(const struct sides *sides, const struct item *key);

/* True if it is zero at every state. */
bool is_nothing(const struct sides *sides, const struct item *item);

/* Find unused items of the key and of the answer that are equivalent together; false when there are none. The
 * sizes of groups are bounded, since all combinations are tried. */
enum { most_in_group = 8 };

struct group {
    size_t key_count, count;
    struct item *key[most_in_group], *items[most_in_group];
};

bool group_find(struct sides *sides, struct group *group);

#endif
