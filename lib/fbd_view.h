/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_view: a scene and its states as drawing programs, graders and formats need them. The rules of fbd.h
 * apply.
 */
#ifndef FBD_VIEW_H
#define FBD_VIEW_H

#include "fbd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---------------------------------------------------------------- bodies and forces, for comparison of scenes */

typedef struct fbd_scene {
    const char *units; /* "SI" or "US"; "" without a model */
    double gravity[2]; /* acceleration, in the world */
} fbd_scene;

FBD_API fbd_scene fbd_model_scene(const fbd_model *model);

/* A body of a scene. Texts live as long as the model. Past the last body the name is NULL, and numbers are
 * NAN or 0. */
typedef struct fbd_listed_body {
    const char *name;
    const char *motion; /* its key in the file: "slide", "pivot", "particle", "planar", "weld", "track" */
    size_t coordinate, coordinate_count; /* the first one, as index of fbd_model_coordinate */
    size_t listed;      /* forces and moments that the file lists: the first of its diagram */
    size_t most_forces; /* the most that its diagram can have */
    bool friction;      /* `friction` with a surface, or of a bearing, acts on it */
    fbd_inertia inertia;
    double pin[2];                  /* pivot: the point on the axis, in the body frame */
    int line, column;               /* of the body in the file, */
    int motion_line, motion_column; /* and of its `motion` */
} fbd_listed_body;

FBD_API fbd_listed_body fbd_model_listed_body(const fbd_model *model, size_t body);

/* The position of a body: of the origin of its frame and of its centre of mass G, in the world, and the x axis
 * of its frame, which for a slide is its line. */
typedef struct fbd_placement {
    double x, y, G[2];
    double cosine, sine;
} fbd_placement;

/* The pose at a state; NAN past the last body. */
FBD_API fbd_placement fbd_state_placement(const fbd_state *state, size_t body);

/* The sense in which the friction of a body slips: 1 along +x of its motion, -1 against it; 0 while it sticks,
 * and without friction. */
FBD_API int fbd_state_slip(const fbd_state *state, size_t body);

/* A force or moment of a diagram with its origin. Texts live as long as the model. */
typedef struct fbd_listed_force {
    fbd_arrow arrow; /* as of fbd_diagram; its name is NULL where there is no force */
    /* of an entry of the file, from here on: the key of its law, "gravity", "spring"; of a law that is
     * computed as an applied force or moment "applied". "" for other forces, as those of couplings */
    const char *law;
    int line, column;
    bool moment;                      /* it is listed under `moments` */
    const char *side;                 /* of a normal force: "up", "left", "right"; else "" */
    double size;                      /* value of an applied force or moment that is constant, else NAN */
    double mu_s, mu_k, surface_speed; /* of friction, at the state; else 0 */
    /* of any force */
    bool reaction; /* it follows from the other forces: of a surface, friction, a joint, a coupling */
    /* of a reaction that the file does not list */
    bool one_sided;  /* it only pulls, as a rope, or only presses, as a contact */
    bool couples;    /* it may be a force with a moment, as of a weld or guide */
    bool free;       /* its direction is not given by the scene, as of a pin */
    int contact;     /* the contact that it is part of, numbered from 0, or -1 */
    double along[2]; /* vector along its line where that is given, outward for a normal force; else 0 */
} fbd_listed_force;

/* Fill at most `room` forces of a body at a state, in the order of fbd_diagram; returns their number, 0 past
 * the last body. `forces` may be NULL to count only. */
FBD_API size_t fbd_state_forces(fbd_state *state, size_t body, fbd_listed_force *forces, size_t room);

/* A force by the name that derivations (`hand`) use for it. */
typedef struct fbd_named_force {
    size_t force; /* index in the diagram; SIZE_MAX when memory is out */
    bool moment;  /* it is a pure moment */
    double value; /* of the name at the state, with its sign, in the unit of the force or moment */
} fbd_named_force;

/* Find a force on a body by the name or letter by which derivations of the body refer to its magnitude, to a
 * component or to its couple: `cord`, `T_1`, `wrist.x`, `clamp.moment`. Returns false if there is no such name. */
FBD_API bool fbd_state_named_force(fbd_state *state, size_t body, const char *name, fbd_named_force *found);

/* ---------------------------------------------------------------- states at which scenes are compared */

/* Determine the modes at the present time, coordinates and rates, and evaluate the forces. Returns true if the
 * motion is admissible there: all accelerations are finite, no normal force is tensile, rolling bodies roll,
 * and closed contacts are closed. Forces that do not depend on the modes are known in any case. */
FBD_API bool fbd_state_settle(fbd_state *state);

/* The accelerations at a state, in its modes: of each coordinate, in the order of fbd_model_coordinate and in the
 * unit of its rate per second. Fills at most `room` of them; returns their number. */
FBD_API size_t fbd_state_accelerations(fbd_state *state, double *accelerations, size_t room);

/* A state at the start of the motion: as fbd_state_new, where bodies with `assemble` are moved to satisfy their
 * couplings, and settled as by fbd_state_settle. Also for a start that a run would refuse. NULL when memory is
 * out. */
FBD_API fbd_state *fbd_state_new_start(const fbd_model *model);

/* Random states of a model, always the same sequence. The model must outlive it. */
typedef struct fbd_sampler fbd_sampler;

/* NULL when memory is out. */
FBD_API fbd_sampler *fbd_sampler_new(const fbd_model *model);
FBD_API void fbd_sampler_free(fbd_sampler *sampler);

/* Put a state of the model to the initial values of the file, at t = 0 or, with `any_time`, at a random time of
 * the run, and settle it. Returns false if it is not admissible, or with `any_time` for prescribed motions. */
FBD_API bool fbd_sampler_start(fbd_sampler *sampler, fbd_state *state, bool any_time);

/* Put a state of the model to a random time, with coordinates and rates of the size of the initial ones and
 * angles in the full circle, and settle it; with couplings and contacts it is near the start: loops stay
 * assembled, closed contacts closed and open ones open. Returns false if none of so many tries is admissible. */
FBD_API bool fbd_sampler_draw(fbd_sampler *sampler, fbd_state *state, unsigned tries);

#ifdef __cplusplus
}
#endif

#endif
