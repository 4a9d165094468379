/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reader: the declarations shared by the files that turn the tree of a model file into a scene.
 *
 * The order is: names of parameters and bodies; parameters and gravity, each at its first use (so they may
 * stand in any order); the ground; inertia and motion of each body; the numbering of all coordinates; initial
 * values and loads of each body; the run.
 *
 * The files have an order, in which none refers to a later one: names (names*.c); values and keys (values.c,
 * fields.c); groups of plain keys (language.c, language_body.c); parameters, tables and states; points and the
 * ground; each kind of force and coupling (read_laws.c, read_applied.c, read_wheels.c, read_ropes.c, ...); the
 * tables of these kinds (language_loads.c, language_couplings.c); their lists (read_loads.c, read_couplings.c);
 * the groups of all (language_scene.c); bodies (read_body.c); the file (scene.c). An exception by data: a name
 * evaluates the definition that it stands for (struct definition_readers).
 *
 * A function that reads something returns false after noting an error (or when memory is out), and its caller
 * goes on, so that one run reports all errors of a file.
 */
#ifndef FBD_SCENE_READER_H
#define FBD_SCENE_READER_H

#include "document/node.h"
#include "scene/data_file.h"
#include "scene/language.h"
#include "scene/names.h"
#include "scene/programs.h"
#include "scene/scene.h"

enum progress { untouched, in_progress, done, failed };

/* Reader's data of a parameter, beside its entry in the scene. */
struct definition {
    const struct node *node, *range; /* its value; range NULL when not given */
    const struct override *override; /* or NULL */
    enum progress progress;
    bool varies; /* its value depends on the reading, directly or by a varying name */
};

/* A definition that is being evaluated; the chain names a circular definition. */
struct open_definition {
    const char *name;
    const struct open_definition *outer;
};

/* Reader's data of a table, beside its entry in the scene. */
struct table_draft {
    const struct override *override; /* another file, or NULL */
    enum progress progress;
    bool varies, used; /* see struct definition */
};

/* Reader's data of a user state, beside its entry in the scene. */
struct own_draft {
    const struct node *rate, *initial, *unit;
    enum progress progress; /* of its dimension */
    double factor;          /* of its unit */
    const struct expr *start;
};

/* The symbols of definitions that are evaluated at their first use. Their readers compile expressions, whose
 * names lead to further definitions: names.c finds them here. */
struct definition_readers {
    struct symbol (*parameter)(struct reader *reader, size_t index, struct pos at);
    struct symbol (*gravity)(struct reader *reader, struct pos at);
    struct symbol (*state)(const struct names *names, const char *name, struct pos at);
    struct table_symbol (*table)(struct reader *reader, const char *name, struct pos at);
};

struct ground_line {
    struct vec through;
    double along;
    struct pos at;
    bool valid, used;
};

struct ground_point {
    struct vec where;
    bool valid;
};

/* Reader's data of a body, beside its entry in the scene. */
struct draft {
    const struct node *node; /* its mapping; NULL when it has none */
    struct body_keys keys;
    double mass; /* total */
    struct motion_keys motion_keys;
    bool mass_known, motion_known, motion_read;
    bool mass_varies;
    bool faulty_parts; /* with errors noted: points may be missing */
    bool has_normal, has_friction;
};

struct reader {
    struct scene *scene;
    struct arena *arena; /* of the scene */
    fbd_errors *errors;
    const struct definition_readers *definition_readers;

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
    struct data_text data; /* of the table read last */
    struct own_draft *own_drafts;
    const struct scene *tables_of; /* an earlier reading of the same text, whose tables are reused, or NULL */
    bool same_parameters;          /* that reading had the same values of all parameters */
    bool same_files;               /* the files of tables set from outside are unchanged */
    struct draft *drafts;
    struct ground_point *ground_points;
    struct ground_line *ground_lines;
    struct polygon *ground_polygons; /* without corners where wrong */

    const struct node *gravity;
    enum progress gravity_progress;
    bool gravity_varies;
    const struct open_definition *open;
    int open_depth;

    const struct programs *known;   /* of an earlier reading of the same file, or NULL */
    struct programs *keep;          /* receives programs that are valid for later readings, or NULL */
    struct record *record;          /* receives varying expressions, or NULL (patch.h) */
    struct arena *exprs;            /* memory of expressions: `arena`, unless they are recorded */
    struct arena *derived;          /* memory of expressions derived from others */
    const struct override *outside; /* override whose value is being read, or NULL */
    bool names_varying;    /* the expression depends on a varying value; `varies` includes slots, too */
    bool varies;           /* the expression being compiled is valid for this reading only */
    bool names_parameters; /* the table or definition being read names a parameter or gravity */
    bool names_input;      /* the expression that is compiled names an input */

    int inside; /* the body whose block is being read, or ground_body */
    struct names constant_names;
    struct scope constants; /* parameters, g, pi */
};

/* Make a scene, as scene_make does, and leave the reader's data in `reader`; `record` and `keep` may be NULL
 * (scene.c). */
struct scene *scene_read_by(struct reader *reader, const struct document *document,
                            const struct override *overrides, size_t override_count, struct programs *keep,
                            struct record *record, fbd_errors *errors);

/* ---- searches in the file (reader.c) */

/* Index of the parameter or input `name`; false if there is none. */
bool parameters_find(const struct reader *reader, const char *name, size_t *index);

/* Has the body a coordinate or rate of that name, by the `motion` in the file? */
bool body_has_coordinate(const struct reader *reader, int body, const char *name);

/* True if the name begins with `states.` and the file has states. */
bool own_states_name(const struct reader *reader, const char *name);

/* ---- parameters (read_parameters.c) */

/* Compile the value of an override; its text has no position in the file. */
const struct expr *override_compile(struct reader *reader, const struct override *override);

/* Set up names and overrides. Returns false only when memory is out. */
bool parameters_start(struct reader *reader, const struct override *overrides, size_t count);

/* Refuse parameters that have the name of a coordinate of the only body; warn of those with that of others. */
void parameters_check_coordinates(struct reader *reader);

/* Evaluate all. */
void parameters_finish(struct reader *reader);
/* Call when the whole file was read without errors. */
void parameters_note_unused(struct reader *reader);

/* The symbol of parameter or input `index`, named at `at`. */
struct symbol parameter_symbol(struct reader *reader, size_t index, struct pos at);

/* Is the plane of motion horizontal? Needed before gravity is read; fields_read reports an invalid value. */
bool scene_is_horizontal(const struct node *root);

/* The magnitude of gravity, named at `at`. */
struct symbol gravity_symbol(struct reader *reader, struct pos at);

/* Mark a definition as open while it is evaluated; `open` belongs to the caller. False with a note when too
 * many are open. */
bool definition_open(struct reader *reader, struct open_definition *open, const char *name, struct pos at);
void definition_close(struct reader *reader, const struct open_definition *open);
void definition_note_circle(struct reader *reader, const char *name, struct pos at);

/* ---- entries of `parameters` and `inputs` (read_constants.c) */

/* The value of an entry; NULL with a note if the entry cannot be read. *range: of its slider, or NULL. */
const struct node *constant_read(struct reader *reader, const struct pair *pair, struct parameter *parameter,
                                 const struct node **range);

/* Read the range of a parameter whose value is known. `value_of_file`: the value was not set from outside, so
 * it must lie in the range. */
bool constant_range(struct reader *reader, const struct node *range, bool value_of_file,
                    struct parameter *parameter);

/* ---- tables (read_tables.c), read like parameters */

bool tables_start(struct reader *reader);
void tables_finish(struct reader *reader);
void tables_note_unused(struct reader *reader);

/* The table that is called as `name(...)` at `at`. */
struct table_symbol table_symbol(struct reader *reader, const char *name, struct pos at);

/* ---- user states (read_states.c) */

bool own_states_start(struct reader *reader);

/* Call when all coordinates are numbered. */
bool own_states_read(struct reader *reader);

/* The state called `name`; symbol_unknown if there is none or states are not allowed here. */
struct symbol own_state_symbol(const struct names *names, const char *name, struct pos at);

/* ---- the ground (read_ground.c) */

bool ground_read(struct reader *reader, const struct node *node, struct pos owner);

/* [x, y], or the name of a point of the ground. */
bool ground_point_read(struct reader *reader, const struct node *node, const char *what, struct vec *where);

const struct ground_line *ground_line_find(struct reader *reader, const struct node *name);

/* Refuse `ground` alone and the bare name of a point of the ground as an end on the ground; with `surfaces`
 * also that of a line or polygon. Returns true after noting the correct form. */
bool ground_end_refuse(struct reader *reader, const struct node *node, const char *what, bool surfaces);

/* ---- bodies and their points as other entries name them (read_points.c) */

/* The body called `node`, -1 for `ground`; false after noting `unknown-body`. */
bool body_name_read(struct reader *reader, const struct node *node, const char *what, int *body);

/* [x, y], G, O or the name of a point of the body. */
bool body_point_read(struct reader *reader, int body, const struct node *node, const char *what,
                     struct point *point);

/* An end of a coupling: `body.point`, `ground.point`, or a body for its centre of mass. */
bool coupling_end_read(struct reader *reader, const struct node *node, const char *what, int *body,
                       struct point *point);

/* The `length` characters of a text from `from` on, with their position in the file; NULL when memory is out. */
const struct node *text_part(struct reader *reader, const struct node *whole, size_t from, size_t length);

/* The centre of mass of the parts of a body: the sum of m r over the sum of m. */
struct vec body_centre_of_mass(const struct body *body);

/* ---- bodies */

/* Inertia and motion of a body (read_body.c, read_part.c, read_motion.c). */
bool bodies_start(struct reader *reader);
bool body_read(struct reader *reader, int body);
void body_parts_start(struct body_keys *keys);
bool body_parts_read(struct reader *reader, int body);
bool body_motion_read(struct reader *reader, int body);

/* The curve of a track, and the initial position of the body on it (read_track.c). */
/* A curve as a file gives it. */
struct curve_keys {
    const struct node *x, *y, *from, *to; /* x may be NULL: y is a function of x */
    bool closed;
    int body;                        /* the body in whose scope its formulas are, or ground_body */
    const char *what, *name, *label; /* "a track", "the track of `bead`", and the name of its ends */
};

/* The curve, in the memory of the scene; NULL after noting an error. */
const struct curve *curve_read(struct reader *reader, const struct curve_keys *keys);

bool track_read(struct reader *reader, int body);
bool track_initial_read(struct reader *reader, int body, struct initial_keys *keys);

/* The parent of the body, when the motions of all bodies have been read (read_parent.c). */
bool body_parent_read(struct reader *reader, int body);

/* Note `motion-in-a-circle` for bodies that move on each other in a circle. */
bool parents_check(struct reader *reader);

bool body_initial_read(struct reader *reader, int body);
bool body_prescribed_read(struct reader *reader, int body);

/* Warn of a motion prescribed by tables whose first or second derivative jumps (smooth.c). */
void smoothness_note(struct reader *reader, struct pos at, const char *what, const struct expr *expr);

/* A varying mass, when coordinates are numbered, and its initial value (read_mass.c). */
bool body_mass_read(struct reader *reader, int body);
bool masses_start(struct reader *reader);

/* Loads of a body (read_loads.c, load_names.c), and the user's derivations (read_hand.c). */
bool body_loads_read(struct reader *reader, int body);
bool body_loads_name(struct reader *reader, int body, const char *const *names, const struct pos *places);
/* When the file was read without errors: warn of surfaces without a normal force (lint_friction.c). False
 * when memory is out. */
bool lint_friction_note(struct reader *reader);

/* When the file was read without errors: warn of loads and lines without effect (lint_effects.c). */
void lint_effects_note(struct reader *reader);

/* When all loads are read: add the reactions to forces that point to other bodies (read_reactions.c). */
bool reactions_add(struct reader *reader);
bool body_hand_read(struct reader *reader, int body);

/* The exact solution given by the user (read_exact.c). */
bool body_exact_read(struct reader *reader, int body);

/* Read the corners of a convex polygon into *polygon, counter-clockwise; `key` is named in notes. False with one if they are none. */
bool polygon_read(struct reader *reader, const struct node *list, const char *key, struct polygon *polygon);

/* The convex polygon of the ground called `name`, or NULL. It has no corners if it was refused. */
const struct polygon *ground_polygon_find(struct reader *reader, const struct node *name);

/* ---- couplings and contacts (read_couplings.c) */

bool couplings_read(struct reader *reader, const struct node *couplings, const struct node *contacts);

/* Stops of coordinates are contacts, numbered behind those of the lists (read_stops.c). */
struct coupling_name;
size_t stops_count(const struct reader *reader);
bool stops_read(struct reader *reader, struct coupling_name *names);

/* ---- the run (read_simulate.c) */

bool simulate_read(struct reader *reader, const struct scene_keys *keys);

/* The lifetime with these conditions, which may be NULL: numbered in the scene. */
struct lifetime lifetime_of(struct reader *reader, const struct node *since, const struct node *until);

/* ---- grading (read_grading.c) */

bool grading_read(struct reader *reader, const struct node *node);

#endif
