/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Compare: what a body lists, at the same states of the key and of an answer.
 */
#ifndef FBD_GRADE_COMPARE_H
#define FBD_GRADE_COMPARE_H

#include "grade/grade.h"

/* A force and a moment at one state: in the world, in the units of the key, about the key's centre of mass. */
struct wrench {
    struct vec force, point;
    double moment;
    double arm;                 /* of its line of action from there */
    double mu_s, mu_k, surface; /* of friction */
};

/* One force or moment that a body lists, at every state. */
struct item {
    const struct load *source;
    bool follows; /* from the other forces */
    bool used;    /* paired */
    struct wrench at[most_grade_samples];
};

/* Both sides of a body. */
struct sides {
    size_t samples;
    bool like_start[most_grade_samples];  /* the body slips as it does at the start */
    bool possible[most_grade_samples];    /* the key can move on from there: its reactions mean something */
    bool turns;                           /* moments about G matter */
    double turned;                        /* the answer's frame lies so in the body, against the key's */
    double tolerance, force, arm, moment; /* sizes of what is compared */
    size_t key_count, count;
    struct item *key, *items;
};

/* How a force of the answer differs from one of the key. */
enum relation { is_same, is_opposite, is_elsewhere, is_turned, is_scaled, is_rougher, is_other };

struct difference {
    enum relation relation;
    double ratio;   /* is_scaled: of the magnitudes, constant; NAN when it varies */
    double angle;   /* is_turned: by this much [rad], constant; NAN when it varies */
    bool exchanged; /* is_turned: its components are exchanged */
};

struct difference difference_of(const struct sides *sides, const struct item *key, const struct item *item);

/* Is the sum of some items another one, at every state? */
bool adds_up(const struct sides *sides, const struct item *const *parts, size_t count,
             const struct item *sum);

/* Does the answer have a normal force or friction for that of the key? Then it is held against it, and no formula is. */
bool is_drawn_as_such(const struct sides *sides, const struct item *key);

/* Is it zero at every state? */
bool is_nothing(const struct sides *sides, const struct item *item);

/* Some of those of the key that are not used yet, and some of the answer, that do the same together; false when there
 * are none. The sizes: more is not looked for, since every choice of them is. */
enum { most_in_group = 8 };

struct group {
    size_t key_count, count;
    struct item *key[most_in_group], *items[most_in_group];
};

bool group_find(struct sides *sides, struct group *group);

#endif
