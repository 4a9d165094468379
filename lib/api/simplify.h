/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Simplifications: the same scene without one effect, or with a linear one in its place.
 *
 * The removable effects of a scene are listed by kind (simplify_list.c); each entry is an edit of the typed
 * scene, which model/variant.h compiles anew. Lists, modes and events of the effect are removed with it.
 */
#ifndef FBD_API_SIMPLIFY_H
#define FBD_API_SIMPLIFY_H

#include "base/arena.h"
#include "fbd_study.h"
#include "model/variant.h"

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
    edit_linear_scene,   /* the whole scene becomes its linearisation (simplify_linear.c) */
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

struct fbd_simplifications {
    struct arena arena;
    const fbd_model *model;
    fbd_simplification *items;
    struct edit *edits;
    size_t count, room;
    size_t size;       /* numbers of a row of the motion */
    double *start;     /* its first row */
    fbd_motion motion; /* of the caller, while the list is made */
};

/* List the removable effects. Returns false when memory is out. */
bool simplify_list(struct fbd_simplifications *list);

/* The linear scene of an edit_linear_scene. NULL with a note in `errors` when memory is out. */
fbd_model *simplify_linear_scene(const struct fbd_simplifications *list, const struct equilibrium *about,
                                 fbd_errors *errors);

/* Make the edit of `context`, a struct edit (a scene_edit). */
void simplify_edit(struct scene *scene, void *context, fbd_errors *errors);

#endif
