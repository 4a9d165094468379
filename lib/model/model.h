/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Model: the compiled scene; constant after compilation, so that threads can share it.
 *
 * A model holds two views of the same scene. The bodies and their loads, by name, serve equations, ledgers
 * and drawings. The plan (plan.h) serves the right-hand side: dense lists of the effects in the scene.
 */
#ifndef FBD_MODEL_MODEL_H
#define FBD_MODEL_MODEL_H

#include "model/inertia.h"
#include "model/labels.h"
#include "model/plan.h"
#include "model/tree.h"
#include "scene/scene.h"

struct model_body {
    const struct body *source;
    const char *name;
    enum motion_kind kind;
    const struct joint_type *joint;
    int first, count;       /* its coordinates */
    int first_rate;         /* index of its first rate in y */
    struct inertia inertia; /* mass, G in the body frame, I_G */
    double I_O;             /* pivot: about the axis */
    double L;               /* pivot: distance from O to G */
    bool varies;            /* its mass varies; then the inertia is that at the start, */
    struct formula mass;    /* and this is its mass; the inertia is proportional to it (dynamics/mass.h) */
    int carried;            /* entry in the loads of the energy carried by the mass; else -1 */
    struct vec origin;      /* slide: where x = 0; pivot: the axis O */
    struct vec arm;  /* pivot: from the axis to G; planar: from the frame's origin to G; in the body frame */
    struct vec pin;  /* pivot: the point of the body that sits on the axis, in the body frame */
    struct vec e, n; /* slide: direction of +x; direction that the surface pushes to */
    int normal_slot; /* slide whose normal force is needed: slot of the forces along n, else -1 */
    int friction;    /* index into plan.modes, or -1 */
    struct placement place;      /* in the tree */
    bool alone;                  /* not jointed, see tree.h */
    int parent;                  /* jointed: the body that it moves on, or -1 for the ground */
    int child, sibling;          /* jointed: the first body that moves on it, the next one beside it; or -1 */
    int drive, drive_pair;       /* prescribed: its entry in the loads, and in plan.modes; else -1 */
    const char *drive_on_parent; /* name of the drive on the body that it moves on */
    int arrow_count;             /* the most arrows that its diagram can have */
    const char *reaction; /* name of the force of its joint: "pin", "guide", "weld"; NULL without one */
    const char *reaction_on_parent; /* and on the body that it moves on: "rod.pin" */
    int first_load, load_count;
};

/* Is coordinate k of a body the angle of its frame? */
static inline bool coordinate_is_angle(const struct model_body *body, int k)
{
    return k == body->joint->angle;
}

/* The inertia in the equation of motion of coordinate k: I_O, I_G or the mass (at the start, if it varies). */
static inline double coordinate_inertia(const struct model_body *body, int k)
{
    if (!coordinate_is_angle(body, k)) return body->inertia.mass;
    return body->joint->has_axis ? body->I_O : body->inertia.I_G;
}

/* Is the origin of its frame neither its centre of mass nor fixed? Then a term omega^2 r is in its equations. */
static inline bool body_is_off_center(const struct model_body *body)
{
    return body->joint->angle >= 0 && !body->joint->has_axis && (body->arm.x != 0 || body->arm.y != 0);
}

/* Does it stand alone and keep its angle? The couple that prevents its rotation is not computed. */
static inline bool body_never_turns(const struct model_body *body)
{
    return body->alone && body->joint->angle < 0;
}

/* Where a load's potential energy comes from. */
enum potential_kind {
    potential_none,       /* not conservative; its work is integrated */
    potential_workless,   /* acts across the motion */
    potential_gravity,    /* V = m g h */
    potential_spring,     /* V = k (q - q0)^2 / 2 */
    potential_link,       /* V = k (l - l0)^2 / 2 */
    potential_constant,   /* constant force in the world: V = -f . p */
    potential_linear,     /* constant generalized force: V = -Q q */
    potential_given,      /* V stated in the file */
    potential_quadrature, /* V = -integral of Q(q) dq from `reference` */
};

/* Resolved struct absolute of the scene. */
struct model_absolute {
    int body;
    struct vec point;
    enum absolute_kind kind;
    int coordinate;          /* absolute_acceleration; absolute_input: the parameter of the scene */
    int pair;                /* absolute_slip: index into plan.modes, or -1 when that mode was removed */
    bool even;               /* absolute_slip: remains a magnitude beyond the end of a mode, see slips.c */
    enum reaction_part part; /* absolute_reaction: */
    struct range couplings;  /* those of its constraint; none for others */
    int load;                /* the spring or damper, or -1 */
};

/* A load with everything that it refers to resolved. */
struct model_load {
    const struct load *source;
    int body;
    struct vec point;  /* where it acts, body frame */
    struct vec anchor; /* spring, damper, actuator: the other end, on the ground or on `partner` */
    bool linked;       /* spring, damper or actuator that has another end */
    int partner;       /* coupling: the body at the other end, where `anchor` is in its frame; else -1 */
    struct formula value, angle, fx, fy, potential;
    struct formula offset_x, offset_y, couple; /* see struct load; zero at `point` itself */
    enum potential_kind potential_kind;
    double reference; /* potential_quadrature: the coordinate where V = 0 */
    const char *why;  /* conservative or not, and the reason */
    bool in_joint; /* acts between a jointed body and the body that it moves on, which feels the opposite */
    const char *name_on_parent; /* then its name there: "block.friction" */
};

struct fbd_model {
    struct arena arena;
    struct scene *scene;
    bool scene_lent; /* the scene is borrowed */
    char *source;    /* the file's text, owned: hand derivations are checked under changed parameters */
    size_t source_length;
    const struct node *root; /* the tree that it was made of by fbd_model_parse_document; else NULL */
    size_t body_count;
    size_t load_count;    /* the loads that bodies list, then the couplings that are springs and dampers */
    size_t listed_count;  /* the former */
    size_t coupled_count; /* with the latter; after them one per rolling body: its friction */
    struct model_body *bodies;
    struct model_load *loads;
    const struct label *labels;         /* of the coordinates */
    const struct own_label *own_labels; /* of the user states */
    size_t absolute_count;
    struct model_absolute *absolutes;
    bool *constant_slots;      /* by slot: an input that is set between steps; NULL without those */
    bool names_places;         /* world positions are used, not only in hand derivations; */
    bool names_poses;          /* others than the speeds at which bodies slip, and reactions */
    bool names_reactions;      /* events name reactions */
    struct vec *output_points; /* scene->output_points, in the frames of their bodies */
    struct plan plan;
    struct tree *tree;
    bool assembles; /* some start positions follow from couplings */
};

static inline bool slot_is_constant(const struct fbd_model *model, int slot)
{
    return model->constant_slots && model->constant_slots[slot];
}

/* Warn of forces that the file declares `conservative` and that have no potential energy (`no-potential`). */
void model_note_potentials(const struct fbd_model *model, fbd_errors *errors);

/* Compile a scene; the model takes ownership of the scene, also on failure. NULL with notes in `errors`, for
 * example for impossible masses and inertias (`bad-inertia`). */
struct fbd_model *model_compile(struct scene *scene, fbd_errors *errors);

/* The same for a scene that the caller keeps, with the bodies, parameters and units of `like`, whose labels
 * are used and which must outlive the model. */
struct fbd_model *model_compile_again(struct scene *scene, const struct fbd_model *like, fbd_errors *errors);

void model_free(struct fbd_model *model);

/* The variables of a formula, and that of one slot of expressions, relative to one body: a set of depends_... bits. */
unsigned formula_depends(const struct model_body *body, const struct formula *formula);
unsigned formula_slot_depends(const struct model_body *body, int slot);

/* ---- by name (find.c); -1 when there is none */

/* The component of a state (n coordinates, n rates, then the user states) that is called "block.x",
 * "block.v", "states.charge", ...; with `plain` also "x" where the scene has one body. */
int model_find_component(const struct fbd_model *model, const char *name, bool plain);

/* The force or moment `load` of a body. */
int model_find_load(const struct fbd_model *model, const char *body, const char *load);

#endif
