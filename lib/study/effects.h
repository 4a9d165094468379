/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Effects: comparison of the scene with the same scene without one effect.
 *
 * The removable effects of a scene are listed by kind (effects_list.c); each entry is an edit of the typed
 * scene, which model/variant.h compiles anew. Lists, modes and events of the effect are removed with it.
 */
#ifndef FBD_STUDY_EFFECTS_H
#define FBD_STUDY_EFFECTS_H

#include "fbd_study.h"
#include "model/variant.h"
#include "study/reference.h"
#include "study/timing.h"

enum edit_kind {
    edit_leave_out,      /* a force or moment */
    edit_uncouple,       /* a coupling */
    edit_static,         /* static friction: mu_s becomes mu_k */
    edit_surface,        /* the surface at rest */
    edit_wind,           /* the air at rest */
    edit_part,           /* the mass of a part */
    edit_rotary,         /* the moment of inertia about the centre of mass */
    edit_linear_gravity, /* sin(theta) becomes theta about the equilibrium */
    edit_linear_drag,    /* quadratic drag becomes linear */
    edit_linear_formula, /* an expression becomes its Taylor polynomial about an equilibrium */
    edit_linear_scene,   /* the whole scene becomes its linearisation (effects_linear.c) */
};

/* An equilibrium, or NULLs when there is none. */
struct equilibrium {
    const double *at;     /* 2 n */
    const double *matrix; /* 2 n x 2 n: see fbd_linearization_matrix */
};

struct edit {
    enum edit_kind kind;
    int body, index;        /* load, part or coupling */
    double value, value2;   /* by kind: stiffness and neutral angle; speed */
    const fbd_model *model; /* the complete scene */
    struct equilibrium about;
    const char *refusal; /* why the edit is impossible; NULL otherwise */
};

struct fbd_effects {
    struct arena arena;
    const fbd_model *model;
    fbd_effect *effects;
    struct edit *edits;
    size_t count, room;
    struct grid grid;
    struct track track, tight; /* of the complete scene */
    double *scale;
    double floor; /* difference between these two */
    double until, budget, seconds;
    struct progress progress;
    fbd_errors *errors; /* of the caller, during the study */
};

/* List the removable effects; `track` is the motion of the scene. Returns false when memory is out. */
bool effects_list(struct fbd_effects *effects);

/* The linear scene of an edit_linear_scene. NULL with a note in `errors` when memory is out. */
fbd_model *effects_linear_scene(const struct fbd_effects *effects, const struct equilibrium *about,
                                fbd_errors *errors);

/* Make the edit of `context`, a struct edit (a scene_edit). */
void effect_edit(struct scene *scene, void *context, fbd_errors *errors);

#endif
