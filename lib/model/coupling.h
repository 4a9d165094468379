/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Couplings: the constraints of a scene as equations g(q) = 0 between links.
 *
 * A coupling has one to three rows. A pin has its two components, a weld those and an angle; a rope has a coupling
 * for each piece between its fixed points (its ends and the pulleys that move with it); a rolling body has one row
 * that keeps it on its line and one against slip. The force of a row is its multiplier times the gradient of g.
 */
#ifndef FBD_MODEL_COUPLING_H
#define FBD_MODEL_COUPLING_H

#include "expr/expr.h"
#include "model/plan.h"
#include "scene/scene.h"

struct coupling_end {
    int body, link; /* body: -1, and link: 0 for the ground */
    struct vec point;
    double radius;       /* of the circle there, else 0 */
    const char *name[2]; /* of its force in the diagram of the body; roll: across and along the line */
};

struct coupling {
    enum constraint_kind kind;
    const struct constraint_law *law;
    int constraint;                  /* index into scene.constraints, */
    const struct constraint *source; /* that entry */
    const char *name;
    const char *row_name[most_coupling_rows]; /* "knuckle in x", "tread.normal" */
    int first_row, row_count;
    int place; /* rope: index of the end where the piece starts */
    int end_count;
    struct coupling_end end[most_constraint_ends];
    struct vec e;      /* roll, rack: the line in the frame of the link of end 1 */
    bool length_given; /* rod, rope */
    double length;
    int wound[2]; /* rope: enum wound_side at the start and end of the piece, on a disc that it is wound on */
    double spare[2];              /* and its wound length at the start, or HUGE_VAL */
    struct formula normal;        /* plane friction: the force on the plane, */
    double share;                 /* the part of it at this point; */
    double soft;                  /* a speed per friction, see dynamics/plane_friction.h */
    bool reels;                   /* rope: its length is a function of time, `length` at t = 0 */
    struct formula reel;          /* that function */
    bool moves;                   /* roll, contact: its surface has a speed of its own, */
    struct formula surface_speed; /* which is this function of time */
    int strands;                  /* with tension >= 0: 2 of a belt, else 0 */
    int slack_slot[2];            /* slots of minus their tensions */
    int normal_slot;              /* roll, one-sided or rough slot: slot of minus its normal force */
    int normal_row, along_row;    /* with friction: the rows of its normal force and of the friction */
    int resistance;               /* roll, gear: the coupling of its rolling resistance or friction, or -1 */
    int load;                     /* roll, rope: its entry in the model's loads */
    int pair;    /* roll, contact: mode of its dry friction; rope: its mode; index into plan.modes, or -1 */
    int surface; /* roll, contact: the mode of its normal force, closed (`stick`) or open; index into
                        plan.modes, else -1 */
    int meeting; /* contact: index into tree.meetings, else -1 */
    int root[most_constraint_ends], root_count; /* first links of the connected trees */
};

struct fbd_model;
struct tree;

/* The name of row `row` of the tree. */
const char *coupling_row_name(const struct tree *tree, int row);

/* The name of the force of row `row`: its normal and tangential components are called as in the diagram of
 * its first body, where the names differ. */
const char *coupling_force_name(const struct tree *tree, int row);

/* Place `k` of constraint `index` of the scene. */
struct coupling_end coupling_end_of(const struct fbd_model *model, int index, int k);

/* The largest distance of its ends from the origins of their links, of the ground from that of the world [length]. */
double coupling_extent(const struct coupling *coupling);

/* True if a joint or the length of a rope is a given function of time. */
bool model_is_driven(const struct fbd_model *model);

/* As model_is_driven, and also true if a surface has a varying speed and there are couplings: a body that
 * sticks to it has a prescribed velocity, as with a drive. */
bool model_has_speeds_given(const struct fbd_model *model);

/* True if the first row is a normal force, of a surface or of a one-sided slot. */
static inline bool coupling_presses(const struct coupling *coupling)
{
    return coupling->law->surface || coupling->source->presses != 0;
}

/* True if its first row is the normal force of a friction, its own or that behind it. */
static inline bool coupling_has_normal(const struct coupling *coupling)
{
    return coupling_presses(coupling) || coupling->resistance >= 0;
}

/* True if it has friction along one of its rows. */
static inline bool coupling_rubs(const struct coupling *coupling)
{
    return coupling->pair >= 0 && coupling->kind != constraint_rope;
}

/* True for a surface whose impulses are computed with those of contacts and ropes: of a rolling body, or a
 * follower on its cam. */
static inline bool coupling_takes_impulses(const struct coupling *coupling)
{
    return coupling->surface >= 0 && coupling->meeting < 0 && coupling->kind != constraint_capstan &&
           coupling->kind != constraint_resistance;
}

/* True if the radii of its ends are those of circles; of ratios and welds they are arms of couples. */
static inline bool coupling_has_circles(const struct coupling *coupling)
{
    return coupling->kind != constraint_ratio && coupling->kind != constraint_weld;
}

/* True if its force is a force with a couple, that of its third row. */
static inline bool coupling_has_couple(const struct coupling *coupling)
{
    return coupling->kind == constraint_weld && coupling->row_count == 3;
}

/* A guide is a two-sided slot with friction. */
static inline bool coupling_is_guide(const struct coupling *coupling)
{
    return coupling->kind == constraint_groove && coupling->surface < 0;
}

/* Add a coupling of contact `index` of the scene for one feature of the contact pair. */
void coupling_of_contact(struct fbd_model *model, int index, int meeting);

/* Compile the constraints of the scene; requires the positions of the bodies. False when memory is out. */
bool couplings_build(struct fbd_model *model);

/* Set the elimination order of the system's unknowns and its envelope; requires the finished tree
 * (coupling_order.c). False when memory is out. */
bool couplings_order(struct fbd_model *model);

#endif
