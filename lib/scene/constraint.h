/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Constraints: the couplings that hold points or angles of bodies together, and what is known of each kind.
 *
 * A kind is a row of `constraint_laws` (language_couplings.c): how it is read, what it is called, which rows it has
 * and which forces they are. The rows g(q) = 0 themselves are by the same kinds in dynamics/constraint.c, what opens
 * and closes them in model/plan_couplings.c. Springs and dampers between bodies are no constraints: they are loads.
 */
#ifndef FBD_SCENE_CONSTRAINT_H
#define FBD_SCENE_CONSTRAINT_H

#include "scene/loads.h"

struct node;
struct reader;

/* The keys of all couplings, springs and dampers among them. */
struct coupling_keys {
    const char *name;
    const struct node *between, *through, *radii, *body, *on, *center, *wound, *around;
    const struct node *x, *y, *from, *to; /* slot */
    double stiffness, free_length, coefficient, length, radius, tension, along;
    bool inside, crossed, closed;
    struct value mu_s, mu_k, restitution, reel;
    int law, side; /* enum impact_law, enum contact_side */
};

/* What holds points or angles of bodies together: its force is whatever that takes. */
enum constraint_kind {
    /* in the order in which --explain has them */
    constraint_pin,     /* two points are one */
    constraint_rod,     /* two points keep their distance */
    constraint_gear,    /* two circles roll on each other without slip: radii, below zero for a ring inside */
    constraint_rack,    /* a circle and a line move along together */
    constraint_roll,    /* a circle on a line of the ground or of a body */
    constraint_slot,    /* a point on a line or curve of a body */
    constraint_groove,  /* the same, and it rubs there */
    constraint_belt,    /* a belt round two discs */
    constraint_capstan, /* a rope that rubs on a disc which it goes round */
    constraint_rope,    /* the way through all points, over discs and ground points, has one length */
    constraint_contact, /* two bodies, or a body and the ground, that meet and part */
    constraint_kinds
};

/* A convex polygon of the ground, corners counter-clockwise. */
struct polygon {
    size_t count;
    struct vec *corners;
};

/* How a contact meets its surface. */
struct contact_law {
    struct value restitution;      /* of the approach speed; expr NULL for 0 */
    int law;                       /* enum impact_law (holds/impact.h) */
    const struct polygon *polygon; /* its surface where that is a polygon of the ground, else NULL */
    bool line;                     /* its surface is a line of the ground */
    int side; /* of that line where the body stays: +1 to the left of its direction, -1 to the right, 0 as at
                 the start */
    double e; /* of a stop, which has no expression */
    int stop; /* no shapes: +1, body 0 cannot move on body 1 to below `limit`, -1 to beyond; else 0 */
    double limit;
};

enum { most_constraint_ends = 8 };

/* Of the two ways round a disc the one on which the point of tangency is farther to that side. */
enum wound_side { wound_left = 1, wound_right, wound_top, wound_bottom };

struct constraint {
    enum constraint_kind kind;
    const char *name;
    struct pos at;
    int end_count;
    int body[most_constraint_ends]; /* ground_body for the ground */
    struct point point[most_constraint_ends];
    double radius[most_constraint_ends]; /* gear, roll, rack; rope: of the disc at this place, else 0 */
    int side[most_constraint_ends];      /* rope: +1 when it goes counter-clockwise round the disc */
    int wound[2];    /* rope: where it leaves the disc at its first and last place that it is wound on, enum
                          wound_side; 0 without one */
    double spare[2]; /* and how much of it is wound there at the start; HUGE_VAL: enough */
    bool crossed;    /* belt */
    double turns;    /* capstan: whole turns round the disc, beside what is seen */
    const struct curve *curve; /* slot: in the frame of end 1 at its point; NULL for the line along `along` */
    double from, to;           /* slot: where that line ends, by its length; infinite where it does not */
    int presses; /* slot: the side to which it only presses, +1 to the left of growing length; 0: it holds both */
    double tension;    /* belt: of both strands while it drives nothing; 0: as its length says */
    struct value reel; /* rope: its length where it varies with the time; else expr NULL */
    bool length_given;
    double length;              /* rod, rope */
    double along;               /* roll, rack: direction of the line in the frame of end 1 */
    struct value mu_s, mu_k;    /* roll: expr NULL for rolling without slip, whatever it takes; contact: expr
                                   NULL for none; groove */
    struct contact_law contact; /* point_absent: the whole body */
};

/* What is known of a kind. */
struct constraint_law {
    /* What is more than one key at a time. */
    bool (*read)(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);
    const char *drawing;    /* the class of its drawing */
    const char *words;      /* for --explain; NULL: it is told of elsewhere */
    const char *not_as_c;   /* why --emit-c refuses it */
    const char *letters[2]; /* of the forces of its rows, in symbols */

    int rows; /* a `tension` that is given stands for the last */
    struct {
        const char *before, *behind; /* its name; NULL both for the name alone */
    } row_names[2];
    const char
        *end_names[2]; /* what stands behind its name in those of its two forces at an end; NULL both: one
                                 force, that has its name */

    bool surface; /* its rows are one across a surface and one along it, which may rub */
    bool strands; /* it has two, with a tension each */
    bool way;     /* round discs, on which it may be laid any number of times */
    bool length;  /* its row keeps one, and has minus its tension for its multiplier */
    bool line;    /* end 1 is one, on which it acts anywhere */

    /* Is its force known by name, as a load of the model, for events and its work? `normal` is friction where it has
     * coefficients. */
    enum { no_load, always_load, load_if_it_presses } load;
    enum load_kind load_kind;
    const char *load_name; /* what stands behind its name in that of the load, or NULL */
};

extern const struct constraint_law constraint_laws[constraint_kinds];

static inline bool constraint_has_load(const struct constraint *constraint)
{
    const struct constraint_law *law = &constraint_laws[constraint->kind];
    return law->load == always_load || (law->load == load_if_it_presses && constraint->presses != 0);
}

/* The first of its bodies that is not the ground: a rope may begin with points of the ground, one of its
 * places moves. */
static inline int constraint_first_body(const struct constraint *constraint)
{
    int end = 0;
    while (constraint->body[end] < 0) end++;
    return constraint->body[end];
}

#endif
