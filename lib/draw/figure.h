/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The figure of the system during drawing: the panels of the bodies, with one origin, one scale and one
 * labelling, and a pen for the lines between them.
 */
#ifndef FBD_DRAW_FIGURE_H
#define FBD_DRAW_FIGURE_H

#include "draw/letters.h"
#include "draw/panel.h"

/* Length of a spring or damper to a wall without a position in the file, on paper [mm]. */
static const double wall_distance = 26;

/* Distance of the block of a follower from its point on the cam, on paper [mm]. */
static const double follower_stem = 8;

struct figure {
    struct arena arena;
    const fbd_model *model;
    fbd_view *view;
    struct panel *panels;
    size_t count;
    struct panel *pen; /* of the lines between the bodies */
    struct box scene;  /* around the bodies and their connections, in the world */
    struct letters letters;
};

/* A point of a body, or of the ground, in the world. */
static inline struct vec figure_place(const struct figure *figure, int body, const double point[2])
{
    return body < 0 ? vec_of(point) : panel_place(&figure->panels[body], vec_of(point));
}

static inline struct vec figure_point(const struct figure *figure, int body, const double point[2])
{
    return panel_point(figure->pen, figure_place(figure, body, point));
}

/* A place of the scene where something acts on a body. */
static inline struct vec figure_place_of(const struct figure *figure, int body, const double world[2])
{
    const struct vec lift = body < 0 ? (struct vec){0, 0} : figure->panels[body].lift;
    return panel_point(figure->pen, vec_add(vec_of(world), lift));
}

/* A circle of the drawing, on paper or in the world. */
static inline void box_take_circle(struct box *box, struct vec center, double radius)
{
    box_take(box, vec_sub(center, (struct vec){radius, radius}));
    box_take(box, vec_add(center, (struct vec){radius, radius}));
}

/* Hatched ground across the unit vector `into`. */
static inline void figure_wall(struct panel *pen, struct vec at, struct vec into)
{
    const struct vec side = vec_scale(5, vec_perp(into));
    panel_hatched_line(pen, vec_sub(at, side), vec_add(at, side), into);
}

/* The ground, by the number of a coupling: the line under it, the point of a contact, the polygons of contacts, the groove of a slot, the patch
 * of a plane on which a body rubs; hatching in a circle. Extend a box by those places of lines and polygons that are next
 * to the bodies. */
void figure_line(struct figure *figure, size_t index);
void figure_peg(struct figure *figure, size_t index);
void figure_polygons(struct figure *figure);
void figure_groove(struct figure *figure, size_t index);
void figure_plane(struct figure *figure, size_t index);
void figure_hatched_disc(struct panel *pen, struct vec center, double radius);
void figure_take_lines(const struct figure *figure, struct box *box);
void figure_take_polygons(const struct figure *figure, struct box *box);

/* A rope or rod beneath the bodies; its anchors on the ground and arcs over discs, and belts, in front of them. */
void figure_rope(struct figure *figure, size_t index);
void figure_rope_over(struct figure *figure, size_t index);
void figure_belt(struct figure *figure, size_t index);

/* Arrows of surfaces that run, springs about an axis, stops: in front of the bodies. Extend a box by the places of bodies at
 * their stops. */
void figure_surfaces(struct figure *figure);
void figure_take_stops(const struct figure *figure, struct box *box);

/* The marks that have a name or a letter: ratios, friction of bearings, gravity into a horizontal plane. */
void figure_marks(struct figure *figure);

/* The entries of the list below the figure: the letters with their values, and the ratios; NULL past the last one. */
const char *figure_listed(struct figure *figure, size_t index);

/* Draw springs, dampers, ropes, rods, and the ground under contacts: beneath the bodies. */
void figure_links(struct figure *figure);

/* Draw pins, welds, belts, teeth, racks, grooves and actuators: in front of the bodies. */
void figure_links_over(struct figure *figure);

/* True if an actuator of this name is drawn between its points, in place of its two forces. */
bool figure_has_ram(const struct figure *figure, const char *name);

/* Draw the applied forces and moments of all bodies. */
void figure_forces(struct figure *figure);

/* Draw the dimensions of the parts of all bodies, and write their masses: over all else. */
void figure_dimensions(struct figure *figure);

#endif
