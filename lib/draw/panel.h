/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Panel: the free-body diagram of one body on paper, during drawing.
 *
 * Lengths on paper are in millimetres with y down; the middle of the body is the origin. Drawn elements
 * extend `extent`, and add lines that labels avoid; the document then arranges the panels by their extents.
 */
#ifndef FBD_DRAW_PANEL_H
#define FBD_DRAW_PANEL_H

#include "draw/labelling.h"
#include "draw/plates.h"
#include "fbd_export.h"

/* Sizes on paper [mm]. */
static const double label_size = 3.4, note_size = 2.9, longest_arrow = 40, shortest_arrow = 5;

/* Of a pin, on paper [mm]. */
static const double pin_radius = 1.1;

/* Block for a slide without a size in the file: half width and half height on paper [mm]. */
static const struct vec conventional_block = {9, 6.5};

/* Costs of a label on a line [mm]: the line of a body or an arrow is worth a far place with a leader. */
static const double on_outline = 60, on_arrow = 60;

/* Scales of forces and moments: 10 mm correspond to `force`, a quarter turn of an arc to `moment`. */
struct arrow_scale {
    double force, moment;
};

/* One arrow of the panel: a force, a moment or a component of a force. */
struct panel_arrow {
    const fbd_force *source;
    const char *suffix;          /* of its id: "", "-moment", "-x", ... */
    bool component, small;       /* small: drawn longer than to scale */
    double value;                /* of the label */
    struct vec tail, head;       /* a force, on paper */
    bool ends_at_point;          /* its head is at the point where it acts, else its tail */
    double radius, start, sweep; /* a moment: arc around `tail`, angles as in the world */
    const char *text;
    size_t label;
};

struct panel {
    struct arena *arena;
    const fbd_model *model;
    const fbd_state *state;
    const fbd_view *view; /* of that state */
    size_t index;
    fbd_body body;
    fbd_pose pose;
    struct vec G;      /* centre of mass, in the frame of the body */
    fbd_force *forces; /* of the diagram */
    size_t force_count;
    fbd_units units;
    struct arrow_scale scale,
        largest; /* of all bodies of the scene; smaller values than its round-off level count as zero */
    const fbd_drawing *drawing;
    struct plate plate;
    const char *const *symbols; /* of the forces, with indices in braces; NULL without symbols */
    const char *const *moments; /* and of the couples, M(R) of a force R */

    struct vec middle;  /* of the body, in the world: the origin of the paper */
    double millimetres; /* on paper per unit of length of the scene */
    bool sized;         /* the body has a size, so that a scale of lengths exists */
    bool shaped;        /* by its shape in the file */
    bool joined;        /* part of the figure of the system, in which all bodies have one origin and scale */
    bool enlarged;      /* drawn to a larger scale than the other bodies of the sheet */
    struct vec block;   /* half width and half height on paper if it is drawn as a block without a size */
    struct vec lift;    /* in the figure: of the body from its place in the scene, in the world */
    const char *slope;  /* in the figure: the letter of the angle of the slide, or NULL */
    struct vec base;    /* slide: point of contact with its surface, in the world */
    struct vec seat;    /* wedge: middle of the surface of the body on it, on paper */

    struct panel_arrow *drawn;
    size_t drawn_count;
    struct labelling labels;
    struct text under; /* body and fixtures */
    struct box extent;
};

/* From the world to the paper. */
struct vec panel_point(const struct panel *panel, struct vec world);

/* A point of the body in the world. */
static inline struct vec panel_place(const struct panel *panel, struct vec point)
{
    return pose_point(&panel->pose, &panel->body, point);
}

/* A direction of the world on paper. */
static inline struct vec panel_direction(struct vec world)
{
    return (struct vec){world.x, -world.y};
}

/* Initialize the panel of a body: its pose and its forces in a state with this view. Returns false when
 * memory is out. */
bool panel_start(struct panel *panel, const fbd_state *state, const fbd_view *view, size_t body,
                 const fbd_drawing *drawing, struct arena *arena);

/* Draw the panel; on a worksheet without arrows, but with room for them. */
void panel_draw(struct panel *panel);

/* Set the middle of the body; returns its size, the diagonal of a rectangle around its outline and the points where
 * forces act, in lengths of the scene. */
double panel_measure(struct panel *panel);

/* Set the scale of lengths: that in which the largest body of the sheet fits its panel; a much smaller body of this size
 * is drawn larger. */
void panel_set_scale(struct panel *panel, double size, double largest);

/* Set the origin and the scale of the figure of the system, in which the bodies stay joined, and the share of the
 * conventional size that blocks without a size have. */
void panel_join(struct panel *panel, struct vec middle, double millimetres, double share);

/* Move the body in the figure, so that it stands on top of another one. */
void panel_lift(struct panel *panel, struct vec lift);

/* The largest extent of a slide from its centre of mass in a direction of the world, a unit vector: of its shape,
 * else of a block of conventional size. */
double panel_reach(const struct panel *panel, struct vec world);

/* True for the carrier of a body that slides along or across its own line: a block in the figure of the system,
 * not a wedge. */
bool panel_carries_level(const struct panel *panel);

/* Half width and half height of a block without a size, along and across its line, on paper; one that carries
 * another is wider along the line of that one. */
struct vec panel_block(const struct panel *panel);

/* The corners of a wedge of conventional size: its slope is that of the body sliding on it, its base is on
 * its own surface. Sets `seat`. */
void panel_wedge(struct panel *panel, struct vec corners[static 4]);

/* A line with hatching on the side `into`, a unit vector on paper. */
void panel_hatched_line(struct panel *panel, struct vec from, struct vec to, struct vec into);

/* A bearing: a triangle on hatched ground, below the axis (`down` is 1) or above it (-1). */
void panel_bearing(struct panel *panel, struct vec axis, double down);

/* Labels avoid a circle on paper. */
void panel_avoid_circle(struct panel *panel, struct vec center, double radius);

/* The bush of a bearing with friction; hatched ground at the joint of a body that is welded to it, seen from the centre of
 * mass; in a horizontal plane the weight into the paper and the normal force out of it. */
void panel_bush(struct panel *panel, struct vec axis);
void panel_clamp(struct panel *panel);
void panel_gravity(struct panel *panel);

/* Draw the body and its centre of mass. */
void panel_body(struct panel *panel);

/* Draw ground, slide or pivot, axes and angles: beneath the body, or in front of it. */
void panel_fixtures(struct panel *panel);
bool panel_fixtures_in_front(const struct panel *panel);

/* The symbol of an arrow or arc. */
const char *panel_symbol(const struct panel *panel, const struct panel_arrow *arrow);

/* Place the arrows; after labelling_solve write them with their labels. */
void panel_arrows(struct panel *panel);
void panel_write_arrows(const struct panel *panel, struct text *text);

/* The arc of a moment with its head. */
void panel_write_arc(struct text *text, const struct panel_arrow *arrow);

/* A thin arrow with a name at its tip: an axis, or the velocity of a surface. */
void panel_axis(struct panel *panel, struct vec from, struct vec to, const char *name);

/* An arc around `center` from angle a by `sweep`, both as in the world, with a head at its end. */
void panel_turn(struct panel *panel, struct vec center, double radius, double a, double sweep,
                const char *name);

/* "θ = 30°": an angle in degrees, or in radians if that overflows. */
const char *panel_degrees(struct panel *panel, const char *name, double angle);

/* The value of a coordinate of the model. */
double panel_coordinate(const struct panel *panel, size_t index);

/* The angle of a slope with the horizontal, at its low end on paper; `up` is a unit vector of the world. */
void panel_slope(struct panel *panel, struct vec foot, struct vec up);

/* Draw a line under the arrows, and extend the panel by it. */
void panel_line(struct panel *panel, const char *css, struct vec from, struct vec to, double cost);

/* Add a label of the fixtures ("theta = 60 deg"); panel_write_notes writes them after labelling_solve. */
void panel_note(struct panel *panel, const char *string, struct vec anchor, struct vec toward);
void panel_write_notes(const struct panel *panel, struct text *text);

/* The distance along the surface of a slide from the reference point of its force to the line of action, on
 * which the force replaces force and couple. */
double panel_line_of_action(const fbd_force *force, struct vec along);

/* True if it is the normal force of a slide with a size, drawn on its line of action without the
 * couple. */
bool panel_is_shifted(const struct panel *panel, const fbd_force *force);

/* The largest force and moment of the body, for the scales. */
struct arrow_scale panel_largest(const struct panel *panel);

/* The next round number, at least `value`: at most two digits times a power of ten. */
double round_up(double value);

/* A value to four digits with its unit: 10.15 kN. */
const char *panel_value(struct panel *panel, double value, const char *unit);

const char *panel_text(struct arena *arena, double value, const char *unit);
const char *panel_number(struct arena *arena, double value);

/* A scale, to six digits. */
const char *panel_scale_value(struct panel *panel, double value, const char *unit);

/* A symbol with its indices in braces, as svg_text takes them: "m_1" and "m1" are "m_{1}". */
const char *panel_indexed(struct arena *arena, const char *symbol);

#endif
