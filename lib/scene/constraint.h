/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Constraints: the couplings that restrict points or angles of bodies, and the properties of each kind.
 *
 * A kind is a row of `constraint_laws` (language_couplings.c): how it is read, its words, its rows and their
 * forces. The rows g(q) = 0 themselves are by the same kinds in dynamics/constraint.c, their opening and
 * closing in model/plan_couplings.c. Springs and dampers between bodies are no constraints: they are loads.
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
    const struct node *at, *points;       /* plane friction */
    const struct node *since, *until;     /* conditions at which it begins and ends */
    const struct node *force;             /* actuator */
    const struct node *among;             /* contact */
    const struct node *terms;             /* ratio: the mapping itself */
    double stiffness, free_length, coefficient, length, radius, tension, along, efficiency;
    bool inside, crossed, closed;
    struct value mu_s, mu_k, restitution, reel, moment, surface_speed, resistance, normal;
    int law, side; /* enum impact_law, enum contact_side */
};

/* Kinds of constraints between points or angles of bodies. */
enum constraint_kind {
    /* in the order of --explain */
    constraint_pin,   /* two points coincide */
    constraint_weld,  /* a body stays as it is relative to another one */
    constraint_rod,   /* constant distance of two points */
    constraint_gear,  /* two circles roll on each other without slip; radius below zero: internal teeth */
    constraint_rack,  /* a circle rolls on a line of a body without slip */
    constraint_ratio, /* a linear relation of coordinates */
    constraint_roll,  /* a circle on a line of the ground or of a body */
    constraint_resistance, /* the rolling resistance of the roll before it: a moment between both bodies; or the
                            * friction of the gear before it: between its first wheel and the body that carries it */
    constraint_slot,       /* a point on a line or curve of a body */
    constraint_groove,     /* the same with friction */
    constraint_belt,       /* a belt round two discs */
    constraint_capstan,    /* a rope with friction on a disc */
    constraint_rope,    /* the path through all points, over discs and ground points, has constant length */
    constraint_plane,   /* friction of a point on a horizontal plane, of the ground or of a body */
    constraint_contact, /* unilateral: two bodies, or a body and the ground */
    constraint_kinds
};

/* A convex polygon of the ground, corners counter-clockwise. */
struct polygon {
    size_t count;
    struct vec *corners;
};

/* The law of a contact. */
struct contact_law {
    struct value restitution;      /* of the approach speed; expr NULL for 0 */
    int law;                       /* enum impact_law (holds/impact.h) */
    const struct polygon *polygon; /* its surface, if that is a polygon of the ground; else NULL */
    bool line;                     /* its surface is a line of the ground */
    int side; /* side of the line where the body stays: +1 left of its direction, -1 right, 0 as at the start */
    double e; /* of a stop: restitution as a number */
    int stop; /* a stop: +1: the coordinate of body 0 is at least `limit`; -1: at most; else 0 */
    double limit;
};

enum { most_constraint_ends = 8, most_coupling_rows = 3 };

/* An end of a ratio: the body that has a coordinate, or the one that it moves on, which has the opposite force. */
struct ratio_term {
    int coordinate; /* its number in the joint of the body */
    double factor;  /* of the coordinate: of a length a number, of an angle a length */
    bool opposite;  /* at the body on which that of the end before moves */
};

/* The rope leaves the disc at one of two tangency points: the one that is farther to this side. */
enum wound_side { wound_left = 1, wound_right, wound_top, wound_bottom };

struct constraint {
    enum constraint_kind kind;
    const char *name;
    struct pos at;
    int end_count;
    int body[most_constraint_ends]; /* ground_body for the ground */
    struct point point[most_constraint_ends];
    double radius[most_constraint_ends]; /* gear, roll, rack; rope: of the disc at this point, else 0 */
    int side[most_constraint_ends];      /* rope: +1 when it goes counter-clockwise round the disc */
    int wound[2];                        /* rope: enum wound_side at its first and last point; 0: not wound */
    double spare[2];                     /* wound length at the start; HUGE_VAL: unlimited */
    const struct ratio_term *terms;      /* ratio: of its ends; else NULL */
    bool angular;                        /* ratio: the sum is an angle, times a unit of length */
    bool crossed;                        /* belt */
    double turns;              /* capstan: whole turns round the disc, in addition to the visible angle */
    const struct curve *curve; /* slot: in the frame of end 1 at its point; NULL for the line along `along` */
    double from, to;           /* slot: ends of that line, by its length; infinite if unlimited */
    int presses;       /* slot: unilateral, on the side +1 to the left of growing length; 0: bilateral */
    double tension;    /* belt: of both strands without load; 0: given by its length */
    struct value reel; /* rope: its length if it varies with time; else expr NULL */
    bool length_given;
    double length; /* rod, rope */
    double along;  /* roll, rack: direction of the line in the frame of end 1 */
    struct value mu_s,
        mu_k; /* roll: expr NULL for rolling without slip; contact: expr NULL for no friction; groove */
    struct value normal; /* plane friction: the force of all points on the plane; expr NULL for the weight */
    int points, place;   /* plane friction: number of the points of its entry, and its number among them */
    struct value surface_speed; /* roll, contact: of the skin of end 1, over t alone; expr NULL at rest */
    struct contact_law contact; /* point_absent: the whole body */
    struct lifetime lifetime;
};

/* The properties of a kind. */
struct constraint_law {
    /* Checks that involve several keys. */
    bool (*read)(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);
    const char *drawing;    /* the class of its drawing */
    const char *words;      /* for --explain; NULL: described elsewhere */
    const char *not_as_c;   /* reason why --emit-c refuses it */
    const char *letters[2]; /* of the forces of its rows, in symbols */

    int rows; /* a given `tension` replaces the last one */
    struct {
        const char *before, *behind; /* text before and behind its name; both NULL: the name alone */
    } row_names[most_coupling_rows];
    const char *end_names
        [2]; /* suffixes of its name for its two forces at an end; both NULL: one force, with its name */

    bool surface; /* its rows are one normal and one tangential to a surface, the latter with friction */
    bool strands; /* two strands with a tension each */
    bool way;     /* a path round discs, possibly with several turns */
    bool length;  /* its row keeps a length; its multiplier is minus the tension */
    bool line;    /* end 1 is a line, on which it acts anywhere */

    /* Whether its force is a named load of the model, for events and its work. `normal` means friction if it
     * has coefficients. */
    enum { no_load, always_load, load_if_it_presses } load;
    enum load_kind load_kind;
    const char *load_name; /* suffix of its name in that of the load, or NULL */
};

extern const struct constraint_law constraint_laws[constraint_kinds];

static inline bool constraint_has_load(const struct constraint *constraint)
{
    const struct constraint_law *law = &constraint_laws[constraint->kind];
    if (constraint->lifetime.begins) return true; /* for the work of its impact */
    return law->load == always_load || (law->load == load_if_it_presses && constraint->presses != 0);
}

/* The first of its bodies that is not the ground: a rope may begin with points of the ground, but at least
 * one point moves. */
static inline int constraint_first_body(const struct constraint *constraint)
{
    int end = 0;
    while (constraint->body[end] < 0) end++;
    return constraint->body[end];
}

#endif
