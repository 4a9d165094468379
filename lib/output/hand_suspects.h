/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Possible mistakes in a line of a derivation, as numbers at a state.
 *
 * The residual (lack) of a line is left - right. Each suspect has a value V at a state such that the residual
 * is k V with the same k at every state when the line has that mistake and no other:
 *
 *     a summand of the line            its value: k = -2 with the wrong sign, -1 if it is superfluous
 *     a name in the line               the total contribution of the name to the line: k = 2 with the wrong sign
 *     a name in the place of another   the change of the line with the other one in its place: k = 1
 *     a term of the body's equation    the component or moment of an arrow of its diagram, times the common factor
 *                                      of the line: k = -1 where it is missing, -2 with the wrong sign
 *     a term in the place of another   the difference of the two: k = 1
 *     moments about another point      (P - Q) x m a_G: k = 1 when the arms are from P, and the inertia is about Q
 *
 * The common factor of a line follows from the coefficients of its names; the most frequent value is used.
 */
#ifndef FBD_OUTPUT_HAND_SUSPECTS_H
#define FBD_OUTPUT_HAND_SUSPECTS_H

#include "output/hand.h"
#include "output/hand_forces.h"

enum { most_places = 12, most_letters = 48 };

/* The equations of a body: sums of forces along an axis, of moments about a point. */
enum equation_kind {
    equation_x,
    equation_y,
    equation_along, /* +x of a slide or track */
    equation_across,
    equation_moment, /* about place 0; about place k: equation_moment + k */
};

/* A point about which moments may be taken. */
struct place_of {
    const char *name;
    bool own;         /* a point of the body, */
    struct vec frame; /* there */
    struct vec p;     /* in the world */
};

/* A name in the line: its slot in y, and the names that may stand in its place. */
struct letter {
    int slot;
    enum letter_kind { letter_force, letter_acceleration, letter_inertia } kind;
    const struct absolute *absolute; /* NULL for a name with a slot of its own (enum hand_slot) */
};

struct suspect {
    enum suspect_kind {
        suspect_summand,
        suspect_letter,
        suspect_force,        /* another force in the place of a letter */
        suspect_inertia,      /* the moment of inertia about another point */
        suspect_acceleration, /* of another point */
        suspect_term,
        suspect_part,     /* of a term that is a moment: that of one component */
        suspect_exchange, /* the term of another arrow in the place of one */
        suspect_place,
    } kind;
    size_t which; /* summand, letter, arrow, or place of the arms */
    size_t other; /* the one in its place; the place of the inertia */
    int equation; /* of a term */
    bool upright; /* of a part: the moment of the component along y */
    bool dead;
    size_t seen;
    double k; /* NAN before it is known */
};

/* Values at a state. */
struct suspects_look {
    const struct hand_check *check;
    struct arena arena;            /* of one model */
    const struct fbd_model *model; /* the model of these forces */
    const struct hand *hand;
    struct hand_forces forces;
    struct arrow *arrows;
    size_t arrow_count;
    size_t place_count, letter_count;
    bool about; /* the first place is the point that the line states */
    struct place_of places[most_places];
    struct letter letters[most_letters];
    const struct fbd_state *state;
    const struct hand_named *named;
    struct instant at;
    double *y;
    double lack, size;
    double slope[most_letters]; /* d(left - right) / d(letter) */
    double factor[equation_moment +
                  most_places];         /* the common factor of the line, as an equation of that kind; */
    double factor_of_arms[most_places]; /* by the forces alone. 0: undetermined */
    struct vec m_a;
};

/* Release the data of the model. */
void suspects_close(struct suspects_look *look);

/* Evaluate at a state; false when memory is out. */
bool suspects_look_at(struct suspects_look *look, const struct fbd_state *state,
                      const struct hand_named *named, double *y);

/* All suspects of a line, in the arena; NULL when memory is out. */
struct suspect *suspects_list(const struct suspects_look *look, struct arena *arena, size_t *count);

/* V, NAN if undefined. */
double suspect_value(const struct suspects_look *look, const struct suspect *suspect);

/* True if the state is informative: not where one of two exchanged forces is zero, or a summand is the whole
 * line. */
bool suspect_shows(const struct suspects_look *look, const struct suspect *suspect);

/* True if names in the line have the right coefficients that would be wrong under this mistake. */
bool suspect_contradicted(const struct suspects_look *look, const struct suspect *suspect);

/* True if the line is a multiple of the equation of moments about place k: its names of forces have those
 * coefficients, and no reaction with a moment about that place is left out. */
bool suspects_is_about(const struct suspects_look *look, size_t place);

/* True if the force of arrow i is named in the line, or written out as a summand. */
bool suspects_name(const struct suspects_look *look, size_t arrow);

#endif
