/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Panel: the free-body diagram of one body on paper, while it is drawn.
 *
 * Lengths on paper are millimetres with y down; the body's middle is at the paper's origin. What is drawn
 * grows `extent`, and leaves lines that the labels keep away from; the document then lays the panels out by
 * their extents.
 */
#ifndef FBD_DRAW_PANEL_H
#define FBD_DRAW_PANEL_H

#include "draw/labelling.h"
#include "draw/plates.h"
#include "dynamics/diagram.h"
#include "dynamics/state.h"
#include "model/outline.h"

/* Sizes on paper [mm]. */
static const double label_size = 3.4, note_size = 2.9, longest_arrow = 40, shortest_arrow = 5;

/* How forces and moments become lengths and arcs: 10 mm stand for `force`, a quarter turn for `moment`. */
struct arrow_scale {
    double force, moment;
};

/* One arrow of the panel: a force, a moment or a component of a force. */
struct panel_arrow {
    const struct arrow *source;
    const char *kind;            /* its class: gravity, reaction, friction, applied, ... */
    const char *suffix;          /* of its id: "", "-moment", "-x", ... */
    bool component, small;       /* small: drawn longer than its scale says */
    double value;                /* of the label */
    struct vec tail, head;       /* a force, on paper */
    double radius, start, sweep; /* a moment: arc around `tail`, angles as in the world */
    size_t label;
};

struct panel {
    struct arena *arena;
    const struct fbd_model *model;
    const struct model_body *body;
    struct instant at;
    struct pose pose;
    struct arrow *arrows; /* of the diagram */
    size_t arrow_count;
    struct arrow_scale scale,
        largest; /* largest: of all bodies of the scene, beside which rounding is nothing */
    const fbd_drawing *drawing;
    struct plate plate;
    const char *const *symbols; /* of the arrows, when they are asked for, */
    const char *const *moments; /* and of the couples that go with them: M(R) of a force R */

    struct vec middle;  /* of the body, in the world: the origin of the paper */
    double millimetres; /* on paper per unit of length of the scene */
    bool sized;         /* the body has a size, so that there is a scale of lengths */
    struct vec base;    /* slide: where it touches its surface, in the world */
    struct vec seat;    /* wedge: the middle of what another body slides on, on paper */

    struct panel_arrow *drawn;
    size_t drawn_count;
    struct labelling labels;
    struct text under; /* body and fixtures */
    struct box extent;
};

/* From the world to the paper. */
struct vec panel_point(const struct panel *panel, struct vec world);

/* A direction of the world on paper. */
static inline struct vec panel_direction(struct vec world)
{
    return (struct vec){world.x, -world.y};
}

/* Begin the panel of a body: its pose and its forces in an evaluated state. False when memory is out. */
bool panel_start(struct panel *panel, const struct fbd_state *state, size_t body, const fbd_drawing *drawing,
                 struct arena *arena);

/* Draw it all: on a worksheet without arrows, with room for them. */
void panel_draw(struct panel *panel);

/* The body itself, its centre of mass; sets middle and scale first. */
void panel_set_scale(struct panel *panel);
void panel_body(struct panel *panel);

/* Ground, slide or pivot, axes and angles: beneath the body. */
void panel_fixtures(struct panel *panel);
bool panel_fixtures_in_front(const struct panel *panel);

/* The symbol of an arrow or arc. */
const char *panel_symbol(const struct panel *panel, const struct panel_arrow *arrow);

/* Lay the arrows out, then write them with their labels, after labelling_solve. */
void panel_arrows(struct panel *panel);
void panel_write_arrows(const struct panel *panel, struct text *text);

/* A line that is drawn under the arrows and grows the panel. */
void panel_line(struct panel *panel, const char *css, struct vec from, struct vec to, double cost);

/* A label of the fixtures ("theta = 60 deg"); panel_write_notes writes them where they have come to lie. */
void panel_note(struct panel *panel, const char *string, struct vec anchor, struct vec toward);
void panel_write_notes(const struct panel *panel, struct text *text);

/* How far along its surface, from the point that the force is told at, the line of action of what a slide's surface
 * gives goes: the force there does what force and couple do. */
double panel_line_of_action(const struct arrow *arrow, struct vec along);

/* Is the arrow a normal force of a slide with a size, drawn at its line of action, couple and all? */
bool panel_is_shifted(const struct panel *panel, const struct arrow *arrow);

/* The largest force and moment of the body, for the scales. */
struct arrow_scale panel_largest(const struct panel *panel);

/* A round number, at least `value`: at most two digits, times a power of ten. */
double round_up(double value);

/* A unit as it is printed: N·m for N*m. */
const char *printed_unit(const char *unit);

#endif
