/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Couplings: the constraints of a scene as rows of equations between links, g(q) = 0.
 *
 * A coupling has one or two rows. A pin has its two components; a rope has a coupling for each piece between places
 * that hold it (its ends and the pulleys that it takes along); a rolling body has one row that keeps it on
 * its line and one that keeps it from slipping. The force of a row is its multiplier times the gradient of g.
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
    int side;            /* rope: +1 when it runs counter-clockwise round the circle */
    const char *name[2]; /* of its force in the diagram of the body; roll: across and along the line */
};

struct coupling {
    enum constraint_kind kind;
    const struct constraint_law *law;
    int constraint;                  /* index into scene.constraints, */
    const struct constraint *source; /* and that */
    const char *name;
    const char *row_name[2]; /* "knuckle in x", "tread.normal" */
    int first_row, row_count;
    int place; /* rope: where the piece starts on its way */
    int end_count;
    struct coupling_end end[most_constraint_ends];
    struct vec e;      /* roll, rack: the line in the frame of the link of end 1 */
    double turn;       /* roll, rack: the angle of the line there */
    bool length_given; /* rod, rope */
    double length;
    int wound[2]; /* rope: enum wound_side where the piece begins, and ends, on a disc that it is wound on */
    double spare[2];     /* and how much there is of it at the start, or HUGE_VAL */
    bool reels;          /* rope: its length goes with the time, from `length` at t = 0 */
    struct formula reel; /* so */
    int strands;         /* that must not push: 2 of a belt, else 0 */
    int slack_slot[2];   /* where minus their tensions go */
    int normal_slot;     /* roll, slot that only presses or rubs: where minus its normal force goes */
    int load;            /* roll, rope: its entry in the model's loads */
    int pair;            /* roll, contact: its dry friction; rope: its mode; index into plan.modes, or -1 */
    int surface;         /* roll, contact: the mode of its normal force, closed (`stick`) or open; index into
                        plan.modes, else -1 */
    int meeting;         /* contact: index into tree.meetings, else -1 */
    int root[most_constraint_ends], root_count; /* first links of the trees that it joins */
};

struct fbd_model;
struct tree;

/* The name of row `row` of the tree. */
const char *coupling_row_name(const struct tree *tree, int row);

/* The name of its force: what is along a surface and across it is called as in the diagram of its first body, where
 * names differ. */
const char *coupling_force_name(const struct tree *tree, int row);

/* Place `k` of constraint `index` of the scene. */
struct coupling_end coupling_end_of(const struct fbd_model *model, int index, int k);

/* Does anything move by a law of the time: a joint, or the length of a rope? */
bool model_is_driven(const struct fbd_model *model);

/* The same, or is there a surface whose speed varies, under what couplings may hold? It turns round whatever the forces
 * are, as drives do. */
bool model_has_speeds_given(const struct fbd_model *model);

/* Is the force of its first row known by itself: of what presses, and cannot pull, or rubs? */
static inline bool coupling_presses(const struct coupling *coupling)
{
    return coupling->law->surface || coupling->source->presses != 0;
}

/* Is it a surface whose impulses are found with those of contacts and ropes? What rolls is, and a follower on its cam. */
static inline bool coupling_takes_impulses(const struct coupling *coupling)
{
    return coupling->surface >= 0 && coupling->meeting < 0 && coupling->kind != constraint_capstan;
}

/* A slot that rubs and holds on both sides is a guide. */
static inline bool coupling_is_guide(const struct coupling *coupling)
{
    return coupling->kind == constraint_groove && coupling->surface < 0;
}

/* Add a coupling of contact `index` of the scene for one feature of the meeting. */
void coupling_of_contact(struct fbd_model *model, int index, int meeting);

/* Compile the constraints of the scene; places of the bodies are known. False when memory is out. */
bool couplings_build(struct fbd_model *model);

/* The order in which the system's unknowns are eliminated, and which of them meet; the tree is finished by
 * then (coupling_order.c). False when memory is out. */
bool couplings_order(struct fbd_model *model);

#endif
