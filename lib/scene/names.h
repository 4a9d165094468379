/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names: what an expression of a model file may speak of, depending on where it stands.
 *
 * A name is looked up in this order: coordinates of the body at hand, parameters, then what the place offers:
 * g everywhere, m in loads, the whole equation of motion in a derivation. So parameters shadow all but the
 * coordinates, whose names are reserved. `body.x` is a coordinate of any body.
 */
#ifndef FBD_SCENE_NAMES_H
#define FBD_SCENE_NAMES_H

#include "expr/expr.h"
#include "scene/scene.h"

struct reader;

/* The names of one coordinate. */
struct coordinate_names {
    const char *name, *rate, *rate_alias;
    const char *acceleration, *acceleration_alias[2];
    bool angle;
};

/* The coordinates of a motion; returns their number. */
int coordinates_of(enum motion_kind kind, const struct coordinate_names **names);

/* True for t, pi and the names of coordinates and rates, which nothing else may bear. */
bool name_is_reserved(const char *name);

/* Note `bad-name` when `name` is no identifier. `what` is what it names ("a body"), or NULL. */
bool name_check(fbd_errors *errors, const char *name, struct pos at, const char *what);

enum place {
    place_constant, /* parameters and g; t, coordinates and inputs are known, to be refused as varying */
    place_load,     /* also t, coordinates, m */
    place_event,    /* t, coordinates; those of the only body without its name */
    place_contact,  /* also the speed of approach, in the slot of the first acceleration */
    place_exact,    /* t and m, but no coordinates: it says what these are */
    place_hand,     /* also accelerations and what the assembly knows */
};

/* What `slip` is in the expression at hand. */
enum slip_name {
    slip_unknown,
    slip_moving,  /* the speed on the surface: coefficients of kinetic friction */
    slip_resting, /* 0, as at rest: coefficients of static friction */
};

struct names {
    struct reader *reader;
    enum place place;
    int body; /* whose coordinates need no prefix, or ground_body */
    enum slip_name slip;
    bool slip_angular;     /* it is an angular speed */
    bool slip_named;       /* it was looked up */
    bool tried;            /* a constant, unless it names what varies; `s` of a track may be that */
    bool along;            /* `s` is the place along a distributed load, in slot 1 */
    enum hand_sense sense; /* in a derivation: when, */
    enum absolute_kind
        of_force;      /* and what the name of a force stands for: absolute_force, or its work or impulse */
    const char *curve; /* the parameter of a curve, for hints; NULL elsewhere */
    bool distance_known, distance_named; /* of the size of a force toward a point; it was looked up */
    const char **known;
    size_t known_count;
};

/* Where a point of a body is in the world, as a variable. */
struct symbol name_of_place(struct reader *reader, int body, const struct point *point,
                            enum absolute_kind kind);

/* The variable of a place in the world, or of what else is evaluated with a state, the same one for every mention. */
struct symbol names_absolute(struct reader *reader, enum place place, const struct absolute *wanted);

/* The point of a body that is called so: G, O of a pivot, one with a name; false for none. */
bool names_point(const struct body *owner, const char *name, size_t length, struct point *point);

/* In a derivation: the acceleration `a_x` of the centre of mass of a body, `P.a_y` of a point of it, also `a_Py`, `angle_ddot`,
 * and the moment of inertia `I_P` about it (names_force.c). */
struct symbol hand_place_symbol(const struct names *names, int body, const char *name);

/* m_2, I_G2, L_2 of the second body of several, as the program's own equations have them (names_force.c). */
struct symbol hand_numbered_symbol(const struct names *names, const char *name);

/* The mass of a body, `m`, and its rate, `m_dot`. */
struct symbol mass_symbol(const struct names *names, int body, const char *name);

/* A force of the diagrams in a derivation: of the body at hand, or `body.name` (names_force.c). */
struct symbol force_symbol(const struct names *names, const char *name);

/* The senses of names in a derivation, for struct scope (names_force.c). */
bool names_sense(void *names, const char *word);

/* Does it stand in `work(...)` or `impulse(...)`, for that? */
bool names_take_force(const struct names *names);

/* Is it one of the `symbols` of the file, in a derivation? */
bool is_declared(const struct names *names, const char *name);

/* What the assembly knows for a derivation: see enum hand_slot. */
struct symbol hand_symbol(const struct names *names, const char *name);

/* All names and all tables that may be used, for hints (names_known.c). */
size_t names_list(void *context, const char *const **list);
size_t names_list_tables(void *context, const char *const **list);

/* Are these `symbols` names that nothing else has, each of a force or a list of them? */
bool symbols_check(struct reader *reader, const struct node *symbols);

/* A scope for expr_compile; `names` must live as long. */
struct scope names_scope(struct names *names);

#endif
