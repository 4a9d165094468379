/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The columns of the rows of a run: name, unit, value at a state and error. CSV, page, plots and sweeps take
 * theirs from one table (run_columns.c); a new kind of column is one enumerator here and one row there.
 *
 * The columns of an arrow depend on the motion of its body, not on its connections:
 *
 *     slide, track   the component along +x, of `normal` the normal force
 *     pivot          the moment about the axis
 *     particle       x and y
 *     planar, weld   x, y, and the moment about the centre of mass
 *
 * The reaction of the body's own joint has no such component: of a pivot x and y are written, of a guide no
 * column. With `components` every arrow has x, y and the moment about the centre of mass as well.
 */
#ifndef FBD_OUTPUT_RUN_COLUMNS_H
#define FBD_OUTPUT_RUN_COLUMNS_H

#include "output/world.h"
#include "record/bars.h"
#include "section/name.h"

enum column_kind {
    column_time,
    column_coordinate,
    column_rate,
    column_acceleration, /* of a coordinate */
    column_in_equation,  /* the acceleration in the equation of a coordinate, if that is another one */
    column_newton,       /* acceleration of G along x and y, angular acceleration */
    column_moving_axis,  /* the inertial term of tree_has_more */
    column_mass,         /* if variable */
    column_frame,        /* of the body: x, y, angle */
    column_velocity,     /* of G */
    column_state,        /* of the user */
    column_point,        /* position, velocity and acceleration of an output point */
    column_section,      /* a section force, by its name alone */
    column_force,        /* parts of an arrow */
    column_arrow,        /* fx, fy; point in the body frame; couple */
    column_term,         /* of an arrow in the equations of the coordinates */
    column_work,         /* of an arrow */
    column_carried_work, /* of the mass that comes or goes */
    column_energy,       /* kinetic, potential, work, residual */
    column_kinds
};

/* Parts of an arrow: column_force. */
enum force_part { force_share, force_x, force_y, force_moment, force_parts };

/* The quantity of a column, for titles, angles in degrees, and the choice of columns in plots. */
enum column_quantity {
    quantity_coordinate,
    quantity_rate,
    quantity_acceleration,
    quantity_pose,
    quantity_force,
    quantity_term,
    quantity_arrow,
    quantity_work,
    quantity_energy,
    quantity_own, /* user states, and the time */
};

/* The outputs that have a column. */
enum column_use {
    column_in_csv = 1,
    column_in_ledger = 2, /* CSV with ledger */
    column_in_page = 4,   /* page and plots */
    column_in_sweep = 8,  /* a sweep may have it, by its name */
};

struct run_column {
    const char *name, *unit;
    enum column_kind kind;
    int body;    /* or -1 */
    int index;   /* of the arrow in the diagram of the body, of the user state, of the output point */
    int part;    /* of the kind, from 0 */
    int entry;   /* of y or a; the load of a work */
    int group;   /* of the first of columns that are evaluated together: their number */
    bool extra;  /* a component of a force that the CSV has with `components` only */
    double size; /* of the displayed unit: the number in y is divided by it */
    int point;   /* of a body: world_point */
    const struct section_name *section;
};

struct run_columns {
    const struct fbd_model *model;
    bool components, degrees;
    struct arrow *arrows; /* room for those of any body, for forces */
    struct arena arena;
    struct run_column *list;
    size_t count, room;
};

/* List the columns of some outputs, in their order, for a run from `start`, which may be NULL without ledger
 * and page. Set the first members before. False when memory is out; free the list also then. */
bool run_columns_make(struct run_columns *columns, unsigned uses, const struct fbd_state *start);
void run_columns_free(struct run_columns *columns);

enum column_quantity column_quantity(const struct run_column *column);

/* Is it a coordinate, a rate or a user state: column->entry of y? */
bool column_is_entry(const struct run_column *column);

/* Does it belong to an arrow: column->index of the diagram of column->body? */
bool column_is_of_arrow(const struct run_column *column);

/* Find a column by its name: one of the list, a component of y also without its body where the scene has one,
 * any point of a body (`rod.right.vx`), the work of any load. False if there is none. */
bool run_columns_find(struct run_columns *columns, const char *name, struct run_column *column);

/* The column of a section force, as `M(beam, 0.4 m)`, in the arena; false with a note (section/name.h). */
bool run_column_of_section(const struct fbd_model *model, struct arena *arena, const char *name,
                           struct run_column *column, fbd_errors *errors);

/* A state at which the columns of a row are evaluated, with results that several of them share. */
struct column_view {
    const struct fbd_state *state; /* evaluated */
    struct instant at;
    bool at_rest;          /* the state is that of statics: section forces are without inertia */
    fbd_errors *errors;    /* receives why a section force has no value; NULL after column_view_begin */
    struct ledger *ledger; /* NULL: works and energies are NAN */
    const double *work;    /* integrals up to the state */
    struct arrow *arrows;  /* room for those of any body */
    int with_arrows;       /* the body whose arrows these are, or -1 */
    int with_pose;         /* the body of the following, or -1 */
    struct pose pose;
    struct motion_of_point G;
};

void column_view_begin(struct column_view *view, const struct fbd_state *state, struct ledger *works,
                       const double *work, struct arrow *arrows);

/* Fill the values of all columns, columns->count of them. */
void run_columns_values(const struct run_columns *columns, struct column_view *view, double *values);
double run_column_value(const struct run_column *column, struct column_view *view);

/* Does the column have an error? And the error of its value, `other` being that of the companion. */
bool column_has_error(const struct run_column *column);
double column_error(const struct run_column *column, const struct column_view *view, const struct bars *bars,
                    double value, double other);

#endif
