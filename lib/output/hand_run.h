/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivations by hand of energy and momentum, compared with a run.
 *
 * Such a line relates two times of a motion: conserved quantities, works and impulses since the start, velocities before
 * and after an impact. The model is therefore run once, by `auto` at a tolerance of at most 1e-10, and the lines are
 * evaluated at the ends of steps and at impacts. The allowed residual is that of the energy balance for the terms of the
 * line (energy_explained).
 *
 * The work of a force that acts on one body alone is taken from the ledger, impacts included. Impulses, and the work of a
 * coupling or joint on one of its bodies, are integrated here; in an impact those of contacts and ropes follow from the jump
 * of the velocities (hand_run_impacts.c), those of joints and pins are not known.
 */
#ifndef FBD_OUTPUT_HAND_RUN_H
#define FBD_OUTPUT_HAND_RUN_H

#include "output/hand_forces.h"
#include "record/ledger.h"

/* Contributions of diagram forces to a line: their work, and their impulses in x and y and along the
 * coordinates. */
enum { by_work, by_x, by_y, by_coordinate, agent_parts = by_coordinate + most_coordinates_of_a_body };

/* Maximum number of impacts that are evaluated. */
enum { most_run_impacts = 100 };

/* A force on a body that lines of a run refer to. */
struct agent {
    int body;
    size_t arrow;
    const char *name;
};

/* The run at one time. */
struct run_shot {
    double t;
    double *y, *before; /* hand_room of each body with lines, one after the other; `before` an impact */
    double *done;       /* agent_parts of each agent since the start, without those of impacts */
    bool impact;        /* velocities jump, */
    size_t event;       /* by this event of the ensemble and the next ones of the same time */
};

struct hand_run {
    const struct fbd_model *model;
    struct arena arena;
    struct hand_named named;
    struct ensemble *ensemble;
    struct ledger ledger;
    struct fbd_state *state;
    bool *named_bodies; /* in lines of a run */
    int *place;         /* index of a body's numbers in run_shot.y; -1 for none */
    size_t bodies, width;
    size_t agent_count;
    struct agent *agents;
    size_t count, every, skipped; /* shots; every so many steps one is kept; steps since the last one */
    size_t steps, impacts;        /* of the run */
    struct run_shot *shots;
    double *integrals; /* of each absolute that is not a work of the ledger, then agent_parts of each agent */
    bool *by_ledger;   /* of each absolute: its works are those of the ledger */
    double *works, *struck; /* of each load: works at a shot; those of impacts up to the start of its step */
    double *before;         /* the velocities before an impact */
    struct hand_impact *impact; /* room for hand_run_add_impact; NULL before the first */
    bool no_memory;
};

/* Run a model and keep its shots. False when memory is out, or with a note, for example if the run has no
 * end. */
bool hand_run_make(struct hand_run *run, const struct fbd_model *model, fbd_errors *errors);
void hand_run_free(struct hand_run *run);

/* The arrow of a force at run->state. */
const struct arrow *hand_run_arrow(struct hand_run *run, const struct hand_force *force);

/* May a load, or with -1 a reaction, have an impulse in an impact? */
bool hand_run_is_impulsive(const struct fbd_model *model, int load);

/* Add the impulses and works of an impact at the place of run->state to run->integrals that are not of the ledger, given the
 * velocities of all coordinates; NAN where they are not known. run->state is used up. False when memory is out
 * (hand_run_impacts.c). */
bool hand_run_add_impact(struct hand_run *run, const double *before, const double *after);

/* Mark the bodies in an expression, with names of any kind. */
void hand_run_mark(const struct fbd_model *model, const struct expr *expr, bool *bodies);

/* Derivatives of left - right of a line by the velocities, at some times of the run or at impacts; returns
 * their number. They are in the arena; 0 when memory is out (hand_run_judge.c). */
size_t hand_run_slopes(struct hand_run *run, int body, const struct hand *hand, struct arena *arena,
                       double **slopes);

/* Judge a line; false when it is false (hand_run_judge.c). */
bool hand_run_judge(struct hand_run *run, int body, const struct hand *hand, struct text *text);

#endif
