/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tree: all bodies, in the form that the recursion of dynamics/tree.h uses.
 *
 * A link is a body with all bodies welded to it: one frame, one mass, one moment of inertia. Links are numbered
 * from 1 so that each comes after the one that it moves on; link 0 is the ground. A body is jointed when it
 * moves on another body, carries one, is an end of a coupling, is driven, moves along a curve, has a mass that
 * varies, or a journal bearing. The others stand alone: their links come last,
 * each is a tree of its own, and no force on one depends on the accelerations of another.
 *
 * The reference point O of a link is the axis of its pivot or the origin of its body's frame. Points of a
 * link are measured from O, in the frame of the link's own body.
 */
#ifndef FBD_MODEL_TREE_H
#define FBD_MODEL_TREE_H

#include "model/contact.h"
#include "model/coupling.h"
#include "model/plan.h"
#include "scene/scene.h"

/* Position of the frame of a body in its link: a point p of the body is shift + R(turn) p. */
struct placement {
    int link;
    struct vec shift, turn;
    double angle;
};

/* The curve of a track. */
struct tree_track {
    const struct curve *curve;
    struct formula piece; /* switches at the start of each piece of the curve; expr NULL for a single piece */
    bool turns;           /* the body turns with the tangent */
};

struct tree_link {
    int body, parent; /* its body; the link that it moves on, less than its own number */
    enum motion_kind kind;
    int coordinate; /* the first of its coordinates */
    struct vec at;  /* pivot: the axis; slide: where x = 0; else the zero of x, y; from the parent's O */
    struct vec e;   /* slide, free: direction of +x; track: of the x axis of its curve */
    int side;       /* slide, track: its surface force is directed to the left (+1) or the right (-1) of +x */
    struct vec tilt;          /* cosine and sine of `along` */
    double along;             /* angle of the link's frame in its parent's at q = 0; track: of its curve */
    struct tree_track *track; /* or NULL */
    double mass, I_O;         /* with all bodies welded to it; I_O about O */
    double inverse_I_O;       /* 1 / I_O */
    double I_G;               /* about the centre of mass */
    double
        across; /* mass I_G / I_O: effective mass at O perpendicular to the arm to G, when it turns freely */
    struct vec moment; /* mass times the vector from O to its centre of mass */
    struct vec force;  /* constant forces in the world, all of them */
    double sine,
        cosine; /* their moment about O: sine sin(angle) + cosine cos(angle); about its centre of mass for a
                          * planar link that stands alone */
    int pair;   /* its dry friction: index into plan.modes, or -1 */
    int normal_slot; /* slot of minus its normal force, or -1 */
    bool journal;    /* pivot: its friction is that of a journal bearing, see dynamics/journals.h */
    int root;        /* the first link of its tree */
    int end;         /* links from its own number up to this one (not included) move with it */
    /* Inertia that may be added to its joint, see tree_massless.c: of its only coordinate, or mass and moment
     * of inertia of a free joint; 0 if it has its own. */
    double added[2];
};

/* A coordinate of a link without inertia of its own. */
struct tree_massless {
    int link, local; /* the number of the coordinate in its joint */
    double added;    /* mass or moment of inertia that may be added, as of the link */
};

/* A constant force that turns with its link, and its moment about O. */
struct tree_following {
    int link;
    struct vec force;
    double moment;
};

/* A force whose size or direction varies, or that begins or ends. */
struct tree_force {
    int link;
    struct vec point;
    double turn;     /* the angle of its body in the link when it turns with the body, else 0 */
    bool body_frame; /* it turns with the body */
    int lifetime;    /* its number (scene/loads.h), or 0; likewise below */
    struct formula value, angle;
    struct vec direction; /* for a constant angle: in the world, or in the link when it turns with it */
};

/* A moment that varies, begins or ends; the opposite acts on `partner`, 0 for none. */
struct tree_moment {
    int link, partner;
    int lifetime;
    struct formula value;
};

/* A spring, damper and actuator between two points; link 0 is the ground. The actuator pulls with `pull`; where it is
 * `guided`, it acts at the first point, in direction `along` of the second link. */
struct tree_spring {
    int link[2];
    int lifetime;
    struct vec point[2];
    double stiffness, free_length, damping;
    bool actuated, guided;
    struct formula pull;
    struct vec along;
};

struct tree_drag {
    int link;
    int lifetime;
    struct vec point;
    double linear, quadratic;
};

/* A body of varying mass in a link. Its contribution to the constants of the link is that at the start. */
struct tree_bulk {
    int link, body;
    struct vec G;  /* its centre of mass, from O */
    double start;  /* its mass at the start */
    double square; /* of its radius of gyration about G */
    struct formula mass;
    struct vec g; /* gravity if it acts on the body; else 0 */
    bool last;    /* the last of its link */
};

/* The lists of loads of a tree, and those of plan.h of the terms in joints. */
enum load_list {
    list_following,
    list_forces,
    list_moments,
    list_springs,
    list_drags,
    list_affine,
    list_potentials,
    load_lists
};

/* Their parts that act on a link, or on several: on jointed links together, where lists of the plan, in the order of
 * the file, have a count only. */
struct link_loads {
    bool any; /* there is an entry in a list of the tree, not only in the joint */
    struct range of[load_lists];
};

struct tree {
    int count;  /* links, the ground included; links[0] is the ground */
    int joined; /* the number of the first link that stands alone */
    struct tree_link *links;
    size_t following_count, force_count, moment_count, spring_count, drag_count, bulk_count;
    struct tree_following *following;
    struct tree_force *forces;
    struct tree_moment *moments;
    struct tree_spring *springs;
    struct tree_drag *drags;
    struct tree_bulk *bulks;
    struct link_loads loads;        /* the lists above as a whole */
    struct link_loads joined_loads; /* those that act on jointed links, which come first */
    struct link_loads *alone_loads; /* of each link that stands alone, from `joined` on */
    bool loaded;                    /* a load of the lists above acts on jointed links */
    bool general;                   /* there are tracks, or massless coordinates */
    double mass_ratio;              /* heaviest over lightest link */
    int pair_count;                 /* jointed links whose dry friction depends on a normal force */
    int *pairs;                     /* their numbers */
    int journal_count;              /* those of them that are journal bearings */
    int watched_count;              /* links whose joint has a normal force or dry friction */
    int *watched;                   /* their numbers, in order */
    int joined_watched;             /* those of them that are jointed: they come first */
    int coupling_count, row_count;  /* see coupling.h */
    struct coupling *couplings;
    int plane_count;   /* those of them that are friction on a plane */
    bool ends;         /* a coupling or load begins or ends during a run */
    bool reacts;       /* events name the forces of pivots */
    int meeting_count; /* see contact.h */
    struct meeting *meetings;
    int massless_count; /* coordinates without inertia of their own */
    struct tree_massless *massless;
    /* of the unknowns of dynamics/tree_system.h, first the rows, then the friction modes, then massless
     * coordinates: */
    int *coupling_of_row; /* rows only */
    int *unknown_at;      /* the unknown at each elimination position */
    int *first;           /* of a position: the first coupled one */
    size_t *envelope;     /* start of the entries from first[p] to p */
    size_t envelope_size;
    int *bodies;      /* all, each after the one that it moves on */
    int joined_count; /* those that are jointed come first: their number */
};

static inline const struct joint_type *link_joint(const struct tree_link *link)
{
    return &joint_types[link->kind];
}

/* Are there jointed bodies? */
static inline bool tree_joins(const struct tree *tree)
{
    return tree->joined > 1;
}

/* Are there couplings, contacts among them? */
static inline bool tree_has_couplings(const struct tree *tree)
{
    return tree->coupling_count > 0;
}

static inline bool tree_has_contacts(const struct tree *tree)
{
    return tree->meeting_count > 0;
}

static inline bool link_is_alone(const struct tree *tree, int link)
{
    return link >= tree->joined;
}

/* Of a link that stands alone. */
static inline const struct link_loads *tree_alone_loads(const struct tree *tree, int link)
{
    return &tree->alone_loads[link - tree->joined];
}

struct builder;
struct fbd_model;

/* Find the jointed bodies, number the links and set the placement of each body. False when memory is out. */
bool tree_number(struct fbd_model *model);

/* Name the forces in the joints and count the arrows of all diagrams. False when memory is out. */
bool tree_name_reactions(struct fbd_model *model);

/* Add a load to the lists of the tree and to those of the plan that act in joints. */
void tree_add_load(struct builder *builder, int index);

/* The least and the greatest mass of the jointed links, without massless ones; HUGE_VAL and 0 if all are. */
struct mass_range {
    double least, most;
};
struct mass_range tree_masses(const struct tree *tree);

/* Find the massless coordinates (tree_massless.c). False when memory is out. */
bool tree_find_massless(struct fbd_model *model);

/* Compute the constants of the links after all loads are added. False when memory is out. */
bool tree_finish(struct fbd_model *model);

static inline struct vec placement_point(const struct placement *place, struct vec point)
{
    return vec_add(place->shift, vec_turn(place->turn, point));
}

#endif
