/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names: the names that an expression of a model file may use, depending on its place.
 *
 * A name is looked up in this order: parameters, coordinates of the current body, then the names of the
 * place: g everywhere, m in loads, the whole equation of motion in a derivation. A parameter may have the name of
 * a coordinate, but an expression in the block of a body that has such a coordinate cannot use it: there the name
 * has two meanings and is refused. `body.x` is a coordinate of any body.
 */
#ifndef FBD_SCENE_NAMES_H
#define FBD_SCENE_NAMES_H

#include "expr/expr.h"
#include "scene/scene.h"

struct reader;

/* The variable in a slot of the values of an expression. */
static inline struct symbol slot_symbol(struct dim dim, size_t slot)
{
    return (struct symbol){.kind = symbol_variable, .dim = dim, .slot = (int)slot};
}

/* True for t, pi and the names of coordinates and rates, which are reserved. */
bool name_is_reserved(const char *name);

/* Note that `name` is a parameter and `other`, and refuse it. */
struct symbol two_meanings(struct reader *reader, const char *name, const char *other, struct pos at);

/* Note `bad-name` when `name` is no identifier. `what` is the named thing ("a body"), or NULL. */
bool name_check(fbd_errors *errors, const char *name, struct pos at, const char *what);

enum place {
    place_constant, /* parameters and g; t, coordinates and inputs are recognized, and refused as varying */
    place_load,     /* also t, coordinates, m */
    place_event,    /* t, coordinates; of a single body also without its name */
    place_contact,  /* also the speed of approach, in the slot of the first acceleration */
    place_exact,    /* t and m, but no coordinates */
    place_hand,     /* also accelerations and the names of enum hand_slot */
};

/* The meaning of `slip` in the current expression. */
enum slip_name {
    slip_unknown,
    slip_moving,  /* slip speed: coefficients of kinetic friction */
    slip_resting, /* 0: coefficients of static friction */
};

struct names {
    struct reader *reader;
    enum place place;
    int body; /* its coordinates need no prefix; or ground_body */
    enum slip_name slip;
    bool slip_angular;           /* it is an angular speed */
    bool slip_named;             /* it was looked up */
    bool tried;                  /* to find out whether a constant varies: `s` of a track is a name, too */
    bool along;                  /* `s` is the position along a distributed load, in slot 1 */
    enum hand_sense sense;       /* in a derivation: the time of its names */
    enum absolute_kind of_force; /* meaning of the name of a force: absolute_force, or its work or impulse */
    bool sections; /* in a derivation `M(L/2)` is a section force, also where `M` has another meaning; */
    bool section_hidden; /* such a name was read in its other meaning */
    const char *curve;   /* the parameter of a curve, for hints; NULL elsewhere */
    /* In the `until` of one of these its reactions need no prefix; or NULL. */
    const struct constraint *of;
    const struct force_coupling *of_coupling;
    const struct load *of_load; /* of the body */
    bool distance_known,
        distance_named; /* `distance` is allowed (in the size of a force toward a point); it was looked up */
    const char **known;
    size_t known_count;
};

/* ---- quantities of a body (names_body.c); symbol_unknown where it has none of that name */

/* A coordinate or rate. */
struct symbol coordinate_symbol(const struct names *names, int body, const char *name);

/* The acceleration of a coordinate of another body, in a derivation. */
struct symbol other_acceleration_symbol(const struct names *names, int body, const char *name);

/* A name behind `body.` that is no coordinate: `angle`, `x` (of the frame's origin), `G.x`, `right.vy`. */
struct symbol absolute_symbol(const struct names *names, int body, const char *name);

/* The mass of a body, `m`, and its rate, `m_dot` if it varies. */
struct symbol mass_symbol(const struct names *names, int body, const char *name);

/* A name of enum hand_slot in a derivation. */
struct symbol hand_symbol(const struct names *names, const char *name);

/* The position of a point of a body in the world, as a variable. */
struct symbol name_of_place(struct reader *reader, int body, const struct point *point,
                            enum absolute_kind kind);

/* Is its motion prescribed, so that its acceleration is known without the forces? */
bool names_is_driven(const struct reader *reader, int body);

/* The variable of a quantity of struct absolute, the same one at every use. */
struct symbol names_absolute(struct reader *reader, enum place place, const struct absolute *wanted);

/* Find a point of the body by its name: G, O of a pivot, or a named one; false if there is none. */
bool names_point(const struct body *owner, const char *name, size_t length, struct point *point);

/* ---- reactions in events (names_reaction.c) */

/* `cord.tension`, `hinge.x`, `floor.normal` of a coupling or contact. symbol_unknown if no coupling has that name,
 * symbol_failed after noting its reactions. */
struct symbol reaction_symbol(const struct names *names, const char *name, struct pos at);

/* `arm.pin.x`, `block.normal` of the joint of a body, given the name behind the body. */
struct symbol joint_reaction_symbol(const struct names *names, int body, const char *name, struct pos at);

/* `tension` in the `until` of a coupling or force. */
struct symbol own_reaction_symbol(const struct names *names, const char *name);

/* ---- names of derivations (names_force.c) */

/* In a derivation: the acceleration `a_x` of the centre of mass of a body, `P.a_y` of a point of it, also `a_Py`, `angle_ddot`,
 * and the moment of inertia `I_P` about it (names_force.c). */
struct symbol hand_place_symbol(const struct names *names, int body, const char *name);

/* m_2, I_G2, L_2 of the second body of several, as in the program's own equations (names_force.c). */
struct symbol hand_numbered_symbol(const struct names *names, const char *name);

/* A force of the diagrams in a derivation: of the current body, or `body.name` (names_force.c). */
struct symbol force_symbol(const struct names *names, const char *name);

/* A section force N, V or M of the current body, or `beam.M`, at the distance x from its first end (names_force.c). */
struct symbol section_symbol(const struct names *names, const char *name, double x, struct pos at);

/* Enter `initial`, `before`, `after`, `work` or `impulse` in a derivation, for struct scope (names_force.c). */
bool names_sense(void *names, const char *word);

/* True inside `work(...)` or `impulse(...)`. */
bool names_take_force(const struct names *names);

/* True for one of the `symbols` of the file, in a derivation. */
bool is_declared(const struct names *names, const char *name);

/* All names and all tables that are allowed, for hints (names_known.c). */
size_t names_list(void *context, const char *const **list);
size_t names_list_tables(void *context, const char *const **list);

/* Check that each of these `symbols` has an unused name and is a force or a list of forces. */
bool symbols_check(struct reader *reader, const struct node *symbols);

/* A scope for expr_compile; `names` must live as long. */
struct scope names_scope(struct names *names);

#endif
