/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reader: what the files that turn the tree of a model file into a scene share.
 *
 * The order is: names of parameters and bodies; parameters and gravity, each when it is first asked for (so
 * they may stand in any order); the ground; of each body what it is and how it moves; the numbering of all
 * coordinates; of each body where it starts and what acts on it; the run.
 *
 * A function that reads something returns false after it has noted what is wrong (or memory ran out), and its
 * caller goes on, so that one run reports all errors of a file.
 */
#ifndef FBD_SCENE_READER_H
#define FBD_SCENE_READER_H

#include "scene/data_file.h"
#include "scene/language.h"
#include "scene/names.h"
#include "scene/node.h"
#include "scene/programs.h"
#include "scene/scene.h"

enum progress { untouched, in_progress, done, failed };

/* What is known of a parameter beside its place in the scene. */
struct definition {
    const struct node *node, *range; /* its value; range NULL when not given */
    const struct override *override; /* or NULL */
    enum progress progress;
    bool varies; /* from reading to reading: it does itself, or names what does */
};

/* A definition that is being evaluated, for naming a circle. */
struct open_definition {
    const char *name;
    const struct open_definition *outer;
};

/* What is known of a table beside its place in the scene. */
struct table_draft {
    const struct override *override; /* another file, or NULL */
    enum progress progress;
    bool varies, used; /* see struct definition */
};

/* What is known of a state beside its place in the scene. */
struct own_draft {
    const struct node *node, *rate, *initial, *unit;
    enum progress progress; /* of its dimension */
    double factor;          /* of its unit */
    const struct expr *start;
};

struct ground_line {
    struct vec through;
    double along;
    bool valid;
};

struct ground_point {
    struct vec where;
    bool valid;
};

/* What is known of a body beside its place in the scene. */
struct draft {
    const struct node *node; /* its mapping; NULL when it has none */
    struct body_keys keys;
    double mass; /* total */
    struct motion_keys motion_keys;
    bool mass_known, motion_known, motion_read;
    bool mass_varies;
    bool faulty_parts; /* noted: points may be missing */
    bool has_normal, has_friction;
};

struct reader {
    struct scene *scene;
    struct arena *arena; /* of the scene */
    fbd_errors *errors;

    /* Mappings of the file, or NULL. Entry i of a mapping is parameter, body, point or line i; inputs
     * are numbered behind the parameters. */
    const struct node *root, *parameters, *inputs, *tables, *own, *bodies, *points, *lines, *polygons,
        *symbols;
    bool without_hands, split_hands; /* see struct document */
    const struct hand_reader *hand_reader;
    size_t force_name_count;
    const struct force_name *force_names;
    struct definition *definitions;
    struct table_draft *table_drafts;
    struct data_text data; /* of the table that was read last */
    struct own_draft *own_drafts;
    const struct scene *tables_of; /* an earlier reading of the same text, whose tables serve here, or NULL */
    bool same_parameters;          /* it had the same values of all parameters, */
    bool same_files;               /* and the files of tables that were set from outside hold on */
    struct draft *drafts;
    struct ground_point *ground_points;
    struct ground_line *ground_lines;
    struct polygon *ground_polygons; /* without corners where they are wrong */

    const struct node *gravity;
    enum progress gravity_progress;
    bool gravity_varies;
    const struct open_definition *open;
    int open_depth;

    const struct programs *known;   /* of an earlier reading of the same file, or NULL */
    struct programs *keep;          /* where those go that hold for later readings, or NULL */
    struct record *record;          /* where what varies is noted, or NULL (patch.h) */
    struct arena *exprs;            /* where expressions are compiled to: `arena`, unless they are noted */
    struct arena *derived;          /* and those that follow from others */
    const struct override *outside; /* whose value is being read, or NULL */
    bool names_varying;    /* the expression names what varies, by its value; `varies` also by its slot */
    bool varies;           /* the expression that is being compiled holds for this reading only */
    bool names_parameters; /* the table or definition that is being read names some, or gravity */
    bool names_inputs;     /* what has been compiled names some */
    const struct override *time; /* of the input that stands in its place, or NULL */

    struct names constant_names;
    struct scope constants; /* parameters, g, pi */
};

/* Make a scene, as scene_make does, in a reader that holds what it knew; `record` and `keep` may be NULL (scene.c). */
struct scene *scene_read_by(struct reader *reader, const struct document *document,
                            const struct override *overrides, size_t override_count, struct programs *keep,
                            struct record *record, fbd_errors *errors);

/* ---- parameters (read_parameters.c) */

/* The value of an override, whose text has no place in the file. */
const struct expr *override_compile(struct reader *reader, const struct override *override);

/* Set up names and overrides. False only when memory is out. */
bool parameters_start(struct reader *reader, const struct override *overrides, size_t count);

/* Evaluate all. */
void parameters_finish(struct reader *reader);
/* To be called when the whole file was read and is right. */
void parameters_note_unused(struct reader *reader);

/* Which parameter or input `name` is; false when it is none. */
bool parameters_find(const struct reader *reader, const char *name, size_t *index);

/* What parameter or input `index`, named at `at`, means. */
struct symbol parameter_symbol(struct reader *reader, size_t index, struct pos at);

/* The magnitude of gravity, named at `at`. */
struct symbol gravity_symbol(struct reader *reader, struct pos at);

/* While a definition is evaluated it is open: `open` is the caller's. False with a note when too many are. */
bool definition_open(struct reader *reader, struct open_definition *open, const char *name, struct pos at);
void definition_close(struct reader *reader, const struct open_definition *open);
void definition_note_circle(struct reader *reader, const char *name, struct pos at);

/* ---- what entries of `parameters` and `inputs` say (read_constants.c) */

/* The value of one; NULL with a note when nothing that can be read says it. *range: of its slider, or NULL. */
const struct node *constant_read(struct reader *reader, const struct pair *pair, struct parameter *parameter,
                                 const struct node **range);

/* Read the range of a parameter whose value is known; `value_of_file`: not set from outside, where it may lie
 * beyond. */
bool constant_range(struct reader *reader, const struct node *range, bool value_of_file,
                    struct parameter *parameter);

/* ---- tables (read_tables.c), as parameters */

bool tables_start(struct reader *reader);
void tables_finish(struct reader *reader);
void tables_note_unused(struct reader *reader);

/* The table that is called as `name(...)` at `at`. */
struct table_symbol table_symbol(struct reader *reader, const char *name, struct pos at);

/* ---- states with equations of their own (read_states.c) */

bool own_states_start(struct reader *reader);

/* When all coordinates are numbered. */
bool own_states_read(struct reader *reader);

/* Does a name begin with `states.`, in a file that has some? */
bool own_states_name(const struct reader *reader, const char *name);

/* The state called `name`; symbol_unknown when there is none, or none here. */
struct symbol own_state_symbol(const struct names *names, const char *name, struct pos at);

/* ---- the ground (read_ground.c) */

bool ground_read(struct reader *reader, const struct node *node, struct pos owner);

/* [x, y], or the name of a point of the ground. */
bool ground_point_read(struct reader *reader, const struct node *node, const char *what, struct vec *where);

const struct ground_line *ground_line_find(struct reader *reader, const struct node *name);

/* Where an end may lie on the ground: true, and noted with what to write, for `ground` alone and for the bare name of a
 * point of the ground; of a line or polygon too where `surfaces`. */
bool ground_end_refuse(struct reader *reader, const struct node *node, const char *what, bool surfaces);

/* ---- bodies */

/* What it is and how it moves (read_body.c, read_part.c, read_motion.c). */
bool bodies_start(struct reader *reader);
bool body_read(struct reader *reader, int body);
void body_parts_start(struct body_keys *keys);
bool body_parts_read(struct reader *reader, int body);
bool body_motion_read(struct reader *reader, int body);

/* The curve of a track, when its keys are read; where the body starts on it (read_track.c). */
/* A curve as a file gives it. */
struct curve_keys {
    const struct node *x, *y, *from, *to; /* x may be NULL: y is a function of x */
    bool closed;
    int body;                        /* whose names its formulas know, or ground_body */
    const char *what, *name, *label; /* "a track", "the track of `bead`", and what its ends are called */
};

/* The curve, in the room of the scene; NULL after noting what is wrong. */
const struct curve *curve_read(struct reader *reader, const struct curve_keys *keys);

bool track_read(struct reader *reader, int body);
bool track_initial_read(struct reader *reader, int body, struct initial_keys *keys);

/* What it moves on: the motions of all bodies are read by then (read_parent.c). */
bool body_parent_read(struct reader *reader, int body);

/* Note `motion-in-a-circle` for bodies that move on each other in a circle, and for welds on nothing. */
bool parents_check(struct reader *reader);

/* The body called `node`, -1 for `ground`; false after noting `unknown-body`. */
bool body_name_read(struct reader *reader, const struct node *node, const char *what, int *body);

/* The centre of mass of the parts of a body: the sum of m r over the sum of m. */
struct vec body_centre_of_mass(const struct body *body);
bool body_initial_read(struct reader *reader, int body);
bool body_prescribed_read(struct reader *reader, int body);

/* Warn of a motion that is prescribed by tables whose second derivative jumps, or the first one (smooth.c). */
void smoothness_note(struct reader *reader, struct pos at, const char *what, const struct expr *expr);

/* [x, y], G, O or the name of a point of the body. */
bool body_point_read(struct reader *reader, int body, const struct node *node, const char *what,
                     struct point *point);

/* Its mass where that varies, when coordinates are numbered, and what it is at the start (read_mass.c). */
bool body_mass_read(struct reader *reader, int body);
bool masses_start(struct reader *reader);

/* What acts on it (read_loads.c, load_names.c), and what the user derived (read_hand.c). */
bool body_loads_read(struct reader *reader, int body);
bool body_loads_name(struct reader *reader, int body, const char *const *names, const struct pos *places);
/* When all is read and right: warn of surfaces that nothing presses on (lint_friction.c). False when memory is out. */
bool lint_friction_note(struct reader *reader);

/* When all loads are read: what bodies feel that forces of others point to (read_reactions.c). */
bool reactions_add(struct reader *reader);
bool body_hand_read(struct reader *reader, int body);

/* The solution that the user knows (read_exact.c). */
bool body_exact_read(struct reader *reader, int body);

/* The convex polygon of the ground called `name`, or NULL; its faults are noted. */
const struct polygon *ground_polygon_find(struct reader *reader, const struct node *name);

/* ---- couplings and contacts (read_couplings.c, read_contacts.c) */

bool couplings_read(struct reader *reader, const struct node *couplings, const struct node *contacts);

/* An end of a coupling: `body.point`, `ground.point`, or a body for its centre of mass. */
bool coupling_end_read(struct reader *reader, const struct node *node, const char *what, int *body,
                       struct point *point);

/* From place `from` on, `length` characters of a text, in its own place; NULL when memory is out. */
const struct node *text_part(struct reader *reader, const struct node *whole, size_t from, size_t length);

struct coupling_keys;
bool contact_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);

/* Stops of coordinates are contacts of their own, behind those of the lists. */
struct coupling_name;
size_t stops_count(const struct reader *reader);
bool stops_read(struct reader *reader, struct coupling_name *names);

/* ---- the run (read_simulate.c) */

bool simulate_read(struct reader *reader, const struct scene_keys *keys);

/* ---- how answers are graded (read_grading.c) */

bool grading_read(struct reader *reader, const struct node *node);

#endif
