/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Impacts of shapes in a run, and the contacts that close by them.
 *
 * At an impact all touching features are determined anew. If one closes, all touching contacts and all taut
 * ropes have an impact together (holds/impacts.h); those with no separation speed stay closed, the others
 * open. Contacts closed without an impact are left to the settling of the modes.
 * Infinitely many impacts in finite time: loop/zeno.h.
 */
#ifndef FBD_LOOP_CONTACTS_H
#define FBD_LOOP_CONTACTS_H

#include "dynamics/state.h"
#include "holds/impacts.h"
#include "loop/zeno.h"

struct lack;
struct run;

/* An impact constraint: a contact, a rope, a rolling or cam coupling. */
struct striker {
    int coupling;
    bool contact; /* it may bounce; all others are plastic */
    bool rope;
    bool rubs;       /* it has a tangential row, in which there may be friction */
    double v_n, v_t; /* before */
    double reel;     /* of a rope: the prescribed rate of its length */
    double surface;  /* the speed of its surface, relative to which v_t is */
    bool stays;      /* it stays closed, whatever its speed (zeno.h) */
};

/* A contact that coincides with another one, of the same two links and with the same normal: a corner shared
 * by several parts of a body, or a corner over a joint of tiles. Both are one point of an impact, with the
 * coefficients of the first; both receive its velocities and modes. */
struct striker_twin {
    int coupling, point; /* the impact constraint with which it coincides */
};

/* The energy that its impulses P take from the bodies, with the speeds v after. */
static inline double striker_taken(const struct striker *point, const double v[2], const double P[2])
{
    double across = P[0] * ((point->v_n + v[0]) / 2 - point->reel);
    return point->rubs ? across + P[1] * ((point->v_t + v[1]) / 2 + point->surface) : across;
}

/* A past impact: impulses along normal and tangent, their work, and the velocities of the point before and
 * after; of a rope the rate of its slack, below zero while it lengthens. */
struct impact_record {
    double p, tau, work;
    double v_n[2], v_t[2];
    bool makes;   /* the impacts of the instant, together, have gained energy */
    bool several; /* other velocities satisfy the laws, too */
    bool in_turn; /* points one after the other, although simultaneous impacts were requested */
};

struct contacts_work {
    struct striker *strikers; /* room for all couplings, each point once */
    struct striker_twin *twins;
    int twin_count; /* of the last look by contacts_find_strikers */
    int struck;     /* of the last call of contacts_find_strikers */
    struct impacts_point *points;
    int *rows, *modes;
    int *slides;     /* friction pairs that take part, numbered behind the impact constraints */
    int slide_count; /* their number */
    struct impacts_slide *slide;
    double *slide_before; /* their slip velocities before */
    double *W, *B, *answers, *v, *P, *y;
    double *later;           /* two velocities and impulses of each impact constraint, besides v and P */
    struct bounces *bounces; /* of each contact pair */
    struct bounces tugs;     /* of ropes that become taut and contacts that land, alternately */
    bool *asleep;            /* of each contact pair: too far apart for the step */
    double *phase_rate;      /* of each contact pair: of its gap in the step [rad/s] (run_contact_radians) */
    int *touched;            /* of each contact pair: touching features at the last check */
    double *deep;            /* of each contact pair: overlap left open at a corner next to another side */
    bool *touching;          /* of each coupling: scratch */
    bool *moves;             /* of each coupling: for zeno_rest.c */
    bool *was_closed;        /* of each coupling, at the last check */
    struct fbd_state *trial;
    double speed; /* the largest of the touching shapes so far */
    struct impact_record
        *of_couplings; /* of each coupling that is no contact: its impacts in the current events */
    bool due;          /* an impact is pending: shapes have met, or a contact has reached the end of a side */
    bool makes;        /* the last impacts have gained energy */
    bool several;      /* the last impacts are not unique: other velocities satisfy the laws */
    bool in_turn;      /* the last impacts were solved one after the other, not simultaneously as requested */
    bool turned;       /* see run_note_sign */
    bool plastic;      /* the next impacts are plastic, whatever their e */
};

/* Allocated from `memory`, except `trial`; false when memory is out. */
bool contacts_work_init(struct contacts_work *work, const struct fbd_model *model, struct arena *memory);

/* Find the touching features, apply their impacts, and close those that stay. Called before the modes settle. */
void run_contacts(struct run *run);

/* Before events are applied: clear the impacts of ropes and landings (contacts_work.of_couplings). */
void contacts_begin_events(struct run *run);

/* The first search: moves apart shapes that overlap by the digits of the file. Returns false, with the
 * reason, when the couplings are inconsistent. */
bool run_start_contacts(struct run *run, struct lack *lack);

/* No accelerations are consistent with the closed and slipping contacts: let them jam. An impact of all
 * touching contacts, without approach, ends the slip that would require infinite forces. Returns false where
 * it does not. */
bool run_jam(struct run *run);

/* Record the sign of the response of normal forces to each other and to their friction, for run->during in
 * the modes of the following steps; compare it at the end of a step, before its events. Where it has changed
 * within a step the forces were infinite, and the run ends. `evaluated`: run->state is evaluated. */
void run_note_sign(struct run *run);
void run_check_jam(struct run *run, bool evaluated);

/* A rope has just become taut, or a rolling or cam coupling has closed again: it has a plastic impact
 * together with all other taut ropes and touching contacts. Decides which of them open. */
void run_strike_closed(struct run *run);

/* Record the overlap of shapes with open contacts: within the touching tolerance, where a corner passes the
 * end of a side. */
void contacts_note_depths(struct run *run);

/* Record which shapes touch, closed or left open. */
void contacts_note_touching(struct run *run);

/* Select the contact pairs to search in the step from run->step.from to the state run->work.y at `end`: those
 * whose shapes could come near in it. run_contact_radians bounds the rotation of shapes per panel. */
void run_wake_contacts(struct run *run, double end);
double run_contact_radians(const struct run *run, double span);

/* The end of the first part of (from, to] of the step in which no gap has a kink, as where one corner passes
 * another; gaps that stay large are ignored. */
double run_contact_bend(struct run *run, double from, double to);

/* Do shapes overlap at the end of the step in run->work.y? */
bool run_overlaps(struct run *run, double end);

/* Check that no shapes overlap at the end of a step; else the run ends, since an impact was missed. */
void run_check_overlap(struct run *run);

/* ---- internal to contacts */

/* Touching tolerance when detection is late, in units of `near` of dynamics/contact.h. */
static const double contacts_late = 1e3;

/* Distance of positions that coincide, likewise: each has that accuracy. */
static const double contacts_same = 4;

/* Apply the impact of the first `count` impact constraints; work->v receives their velocities after it,
 * work->P its impulses. Returns false after failing the run. (contacts_strike.c) */
bool contacts_strike(struct run *run, int count);

/* The two halves of contacts_strike. */
bool contacts_solve_impact(struct run *run, int count);
void contacts_apply_impulses(struct run *run, int count);

/* After an impact and its closings: set the velocities of closed contacts to exactly zero; impulses have an
 * accuracy of 1e-13. */
void contacts_hold_speeds(struct run *run, int count);

/* Does impact constraint i separate after the impact, by more than rounding? */
bool contacts_part(const struct run *run, int i);

/* Open the impact constraints that separate by the velocities in work->v after an impact (or by the present
 * ones, without an impact); let the others slip or stick. */
void contacts_open_or_close(struct run *run, int count, bool struck);

/* The touching tolerance [m, or radians of a stop]; shapes that overlap by a little more, detected late,
 * touch as well. */
double contacts_reach(const struct run *run, int index);

/* Assign the features that touch within `near` to the couplings of contact pair `index`. */
void contacts_find_touching(struct run *run, int index, double near);

/* Collect all touching points, taut ropes, and closed rolling or cam couplings; returns their number. */
int contacts_find_strikers(struct run *run);

/* Coefficient of restitution of a contact pair at a speed of approach; below zero after failing the run. */
double contacts_restitution(struct run *run, int meeting, double approach);

/* Find the responses of the impact constraints, with their velocities before. False after failing the run. */
bool contacts_find_responses(struct run *run, int count);

/* ---- called by the loop */

/* After the modes have settled: contacts that they opened touch no longer. Records which have closed and
 * opened. */
void run_release_contacts(struct run *run);

#endif
