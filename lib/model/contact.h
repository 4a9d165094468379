/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Contacts: which shapes can touch, and in which features.
 *
 * A contact of the file is one contact pair (`meeting`) or several, each of two shapes: a line of the ground,
 * a disc, or corners. Corners are those of a convex polygon, counter-clockwise, the two ends of a bar, or one
 * point. A feature of a pair is a corner or circle on a side (or line), or two circles, of which one may be a
 * corner. A pair has as many couplings as features can be closed simultaneously: two where corners are on a
 * line or on each other, else one. The present feature of each coupling is part of the state
 * (dynamics/contact.h).
 */
#ifndef FBD_MODEL_CONTACT_H
#define FBD_MODEL_CONTACT_H

#include "base/vec.h"
#include "numeric/tolerances.h"

#include <stdbool.h>

struct fbd_model;

struct contact_shape {
    enum contact_shape_kind {
        contact_line,
        contact_disc,
        contact_corners,
        contact_stop /* no shape: the joint of the link, or its support */
    } kind;
    int link;             /* 0: the ground */
    const void *source;   /* its part or polygon; NULL for others */
    int count;            /* corners */
    struct vec *corners;  /* in the frame of the link */
    unsigned char *inner; /* of each corner: sides covered by other shapes (enum contact_inner), or NULL */
    struct vec center, e; /* disc; line: a point of it and its direction; corners: their mean */
    double radius;        /* disc; corners: the farthest from `center` */
};

/* Bits of a corner: the side that begins, or ends, there runs along another shape, inside the union of both;
 * the corner is within a side of both. */
enum contact_inner { inner_begin = 1, inner_end = 2, inner_flat = 4 };

struct meeting {
    int constraint, first_coupling, coupling_count;
    int lifetime; /* its number (scene/loads.h), or 0 */
    struct contact_shape shape[2];
    double size,
        reach; /* of the shapes and the start positions of bodies: the reference length of distances */
    int stop;  /* of a coordinate: +1 at its lower, -1 at its upper limit; else 0 */
    double limit;
    int probes; /* functions whose zeros are new features (dynamics/contact.h) */
    bool thin;  /* two bars, or a point and a bar; a probe is a corner at the other's bar */
};

/* A feature: a point or circle of one shape at a side of the other, or two circles. */
struct touch {
    bool circles;
    int moving;       /* the shape that has the point or circle: 0 or 1 */
    struct vec point; /* in the frame of its link */
    double radius;
    struct vec base, e; /* of the other: start and direction of its side, or the centre of its circle */
    double length;      /* of the side; infinite for a line */
    double base_radius;
    double side; /* the normal is side k x e; 0 for a line of the ground: chosen at the start */
};

/* Feature number `feature` of a contact pair. */
struct touch meeting_touch(const struct meeting *meeting, int feature);

/* Corner `corner` of shape `moving` on side `side` of the other. */
int meeting_feature(const struct meeting *meeting, int moving, int corner, int side);

/* Thin pair: the shape and corner that belong to a probe. */
struct thin_corner {
    int moving, corner;
};
struct thin_corner thin_corner_of(const struct meeting *meeting, int probe);

/* Side of the bar: to the right of the bar's direction, to its left, its end faces, and the circle round the
 * bar, which is never touched. */
enum thin_side { thin_right, thin_left, thin_end, thin_begin, thin_round };
int thin_feature(struct thin_corner corner, enum thin_side side);

/* The number of sides: none of a point, two of a bar. */
int shape_sides(const struct contact_shape *shape);

/* Build the contact pairs of constraint `index` of the scene with their couplings. False when memory is out. */
bool meetings_add(struct fbd_model *model, int index);

/* Two points: replace the second by the line across the one line on which both move. False if there is no
 * such line. */
bool points_meet_on_line(const struct fbd_model *model, struct meeting *meeting);

/* True if the pair has two points and no line on which both move. */
bool meeting_is_of_points(const struct meeting *meeting);

/* Level the surfaces of all contact pairs (contact_level.c). False when memory is out. */
bool meetings_level(struct fbd_model *model);

/* Upper bound of the contact pairs and couplings of a contact. */
int meetings_most(const struct fbd_model *model, int index);

#endif
