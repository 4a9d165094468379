/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a run does where shapes meet: impacts, and what closes by them.
 *
 * At such an instant all features that touch are found anew. Where one of them closes, all that touches and
 * all taut ropes have an impact together (holds/impacts.h); what has no speed left stays closed, what has one
 * opens. Whether what is closed without an impact stays so is for the modes to settle.
 *
 * A body that bounces with e < 1 does so infinitely often in finite time. When its bounces are lower than the
 * tolerance sees, the rest of the series is summed up: the intervals form a geometric series, and with
 * constant acceleration exactly that. The body then rests on its surface, and the event has the time at which
 * the series ends, which is when an infinitely patient observer would see it come to rest. So does what
 * strikes a surface without bouncing and is thrown up again by a rope that gets taut, as in Atwood's machine on the
 * floor: in the end the surface and the rope hold it together.
 */
#ifndef FBD_LOOP_CONTACTS_H
#define FBD_LOOP_CONTACTS_H

#include "dynamics/state.h"
#include "holds/impacts.h"

struct lack;
struct run;

/* The impacts of a meeting so far. */
struct bounces {
    int count;         /* since it was last at rest */
    double t[5];       /* of the last ones, the latest first */
    int feature;       /* of the last one */
    int unseen;        /* how many of them have followed each other within bounces that nobody sees */
    double slow;       /* a speed that is lost within what counts as the same place */
    double rests_from; /* end of a series that is summed up; HUGE_VAL without one */
    /* What comes back from having been closed, as ropes throw it up: when, the latest first. */
    bool is_closed;
    int returns;
    double returned[12];
};

/* What takes part in an impact: a contact, a rope, what rolls or follows a cam. */
struct striker {
    int coupling;
    bool contact; /* it may bounce; all others are plastic */
    bool rope;
    bool rubs;       /* it has a row along its surface, too, in which there may be friction */
    double v_n, v_t; /* before */
    double reel;     /* of a rope: how fast it grows by itself */
    bool stays;      /* no contact; opened with a speed so small that it stays closed (zeno.c) */
};

/* A contact at the place of another one, of the same two links and with the same normal: a corner that several parts of a
 * body share, or a corner over a joint of tiles. Both are one point of an impact, which has the coefficients of the
 * first; velocities and modes after are those of that point. */
struct striker_twin {
    int coupling, point; /* the striker that it coincides with */
};

/* The work of its impulses P on the bodies, with the speeds v after. */
static inline double striker_taken(const struct striker *striker, const double v[2], const double P[2])
{
    double across = P[0] * ((striker->v_n + v[0]) / 2 - striker->reel);
    return striker->rubs ? across + P[1] * (striker->v_t + v[1]) / 2 : across;
}

/* A past impact: impulses along normal and tangent, their work, and the velocities of the
 * point before and after: of a rope the rate of its length, below zero while it lengthens. */
struct impact_record {
    double p, tau, work;
    double v_n[2], v_t[2];
    bool makes;   /* all impacts of the instant have gained energy, this one too */
    bool several; /* other velocities agree with the laws, too */
    bool in_turn; /* points one after the other, where simultaneous impacts were requested */
};

struct contacts_work {
    struct striker *strikers; /* room for all that may take part, each point once */
    struct striker_twin *twins;
    int twin_count; /* of the last look by contacts_find_strikers */
    int struck;     /* number of points of the last impact */
    struct impacts_point *points;
    int *rows, *modes;
    int *slides;     /* pairs whose friction takes part, behind the strikers; */
    int slide_count; /* and how many */
    struct impacts_slide *slide;
    double *slide_before; /* their slip before */
    double *W, *B, *answers, *v, *P, *y;
    double *later;           /* two velocities and impulses of each striker, beside v and P */
    struct bounces *bounces; /* of each meeting */
    struct bounces tugs;     /* of ropes that get taut, and what lands, in turn */
    bool *asleep;            /* of each meeting: too far apart for the step */
    int *touched;            /* of each meeting: how many features touched, at the last look */
    double *deep;            /* of each contact pair: overlap left open at a corner next to another side */
    bool *touching;          /* of each coupling: scratch */
    bool *moves;             /* and: for zeno_rest.c */
    bool *was_closed;        /* of each coupling, when it was looked at last */
    struct fbd_state *trial;
    double speed; /* the largest of the shapes that have touched so far */
    struct impact_record
        *of_couplings; /* of each coupling that is no contact: its impacts in the present events */
    bool due;          /* shapes have met, or what touches has come to the end of a side */
    bool makes;        /* the last impacts have made energy */
    bool several;      /* others agree with the laws, too, and give other velocities */
    bool in_turn;      /* and are of one point after the other, where all together were asked for */
    bool turned;       /* see run_note_sign */
    bool plastic;      /* the next ones are to be, whatever their e */
};

/* Made of `memory`, all but `trial`; false when that is out. */
bool contacts_work_init(struct contacts_work *work, const struct fbd_model *model, struct arena *memory);

/* Find what touches, let it have its impacts, and close what stays. To be called before the modes settle. */
void run_contacts(struct run *run);

/* Before events are applied: clear the impacts of ropes and landings (contacts_work.of_couplings). */
void contacts_begin_events(struct run *run);

/* The first look: what a file's digits have put into each other is moved out before. False, with what is lacking,
 * when couplings do not fit. */
bool run_start_contacts(struct run *run, struct lack *lack);

/* No accelerations agree with what touches and slips: let it jam. Without an approach, an impact of all that touches
 * ends the slip that asks for infinite forces. False where it does not. */
bool run_jam(struct run *run);

/* Note, for run->during in the modes of the steps that follow, and compare at the end of a step, before its events,
 * the sign by which normal forces answer to each other and to their friction. Where a step has turned it the forces were
 * infinite on the way, and the run ends. `evaluated`: run->state is. */
void run_note_sign(struct run *run);
void run_check_jam(struct run *run, bool evaluated);

/* A rope has just got taut, or what rolls or follows a cam is back on its surface: it, all other taut ropes and all that
 * touches have an impact together, in which they are plastic. What it makes slack or lifts off is decided. */
void run_strike_closed(struct run *run);

/* A drive that moves, and how many do. */
const struct mode *run_only_drive(const struct run *run, int *moving);

/* What has been put on its surface by zeno_rest may have got into others that are next to it, the deeper the
 * farther they are from where it turned: they are moved out. Whether there were any, which may now touch. */
bool zeno_lift_others(struct run *run);

/* Note how deep in each other shapes are that do not touch: within what counts as touching, where a corner goes
 * over the end of a side. */
void contacts_note_depths(struct run *run);

/* Note which shapes touch, closed or left open. */
void contacts_note_touching(struct run *run);

/* Which meetings the step from run->step.from to the state run->work.y at `end` has to look at: those whose shapes
 * could come near in it. In panels of how many radians the shapes turn. */
void run_wake_contacts(struct run *run, double end);
double run_contact_radians(const struct run *run, double span);

/* The end of the first stretch of (from, to] of the step in which no gap bends, as where a corner goes past another, but
 * for those that stay far apart. */
double run_contact_bend(struct run *run, double from, double to);

/* No shapes are in each other at the end of a step; else the run ends, for it has missed an impact. */
void run_check_overlap(struct run *run);

/* ---- for the files of contacts */

/* What counts as touching when it is seen late, in `near` of dynamics/contact.h. */
static const double contacts_late = 1e3;

/* Places that count as the same one, likewise: each is known to that. */
static const double contacts_same = 4;

/* Bounces that nobody sees, likewise: 1e-9 of the scene. */
enum { contacts_low = 1000 };

/* The impact of the first `count` strikers; their velocities after are in work->v, its impulses in work->P. False
 * after failing the run. (contacts_strike.c) */
bool contacts_strike(struct run *run, int count);

/* Its two halves. */
bool contacts_solve_impact(struct run *run, int count);
void contacts_apply_impulses(struct run *run, int count);

/* After an impact and its closings: set the velocities of closed contacts to exactly zero; impulses have an
 * accuracy of 1e-13. */
void contacts_hold_speeds(struct run *run, int count);

/* Does impact constraint i separate after the impact, by more than rounding? */
bool contacts_part(const struct run *run, int i);

/* What leaves by the velocities in work->v after an impact, or as it is without one, is open; what stays slips or
 * sticks. */
void contacts_open_or_close(struct run *run, int count, bool struck);

/* A rope has got taut or something has landed, and by that lets others go, which do the same to it in turn: once by no
 * more than nobody sees all stay. */
void zeno_end_rope_impacts(struct run *run, int count);

/* The interval between the last two of many of them in a row that nobody sees; 0 elsewhere. */
double zeno_rope_limit(const struct run *run);

/* What counts as touching [m, or radians of a stop]; shapes that are in each other by a little more, which was seen late,
 * touch as well. */
double contacts_reach(const struct run *run, int index);

/* Give the couplings of meeting `index` the features that touch within `near`. */
void contacts_find_touching(struct run *run, int index, double near);

/* All points that touch, ropes that are taut, and what presses on its surface; returns their number. */
int contacts_find_strikers(struct run *run);

/* e of a meeting at a speed of approach; below zero after failing the run. */
double contacts_restitution(struct run *run, int meeting, double approach);

/* After an impact of `count` strikers: does a series of bounces end that nobody sees any more? (zeno.c) */
bool zeno_end_bounces(struct run *run, int count);

/* The speeds at which surfaces are left, and ropes let go, are taken away by impulses that rub as the weight would have
 * done that took them away: at rest from now on, surfaces press m a T in the time T of the series, and so they do in it
 * but for m v. */
void zeno_remove_separation(struct run *run, int count);

/* Put what bounces on its surface (zeno_rest.c); the strikers are then those that touch. Returns their number. */
int zeno_rest(struct run *run, int strikers);

/* Would that change the speed of any body by no more than bounces that nobody sees do? */
bool zeno_rest_is_harmless(struct run *run, int count);

/* ---- the loop */

/* After the modes have settled: what they have opened touches no more. Notes what has closed and opened. */
void run_release_contacts(struct run *run);

/* The next end of a series of bounces; HUGE_VAL without one. And noting those that end by now. */
double zeno_next_rest(const struct run *run);
void log_rests(struct run *run);

#endif
