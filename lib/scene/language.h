/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Language: every key of a model file as data.
 *
 * A group is a mapping with known keys; a field is one of them: its key, type, physical dimension, and the
 * member of the plain structure of the group that receives its value. One reader (fields.h) serves all
 * groups, so that unknown, missing and mistyped keys give the same messages everywhere. Checks that involve
 * several keys (which keys exclude each other, dependence on the motion) are in the read_*.c files.
 */
#ifndef FBD_SCENE_LANGUAGE_H
#define FBD_SCENE_LANGUAGE_H

#include "document/node.h"
#include "scene/law.h"
#include "scene/quantity.h"
#include "scene/scene.h"

#include <stddef.h>

enum field_type {
    field_text,    /* const char * */
    field_name,    /* const char *, an identifier */
    field_flag,    /* bool */
    field_choice,  /* int, one of the field's choices */
    field_number,  /* double: a constant of the field's quantity */
    field_value,   /* struct value: may vary with the names of the scope */
    field_vector,  /* struct vec: a pair [x, y] of the field's quantity */
    field_any,     /* const struct node *, read by its own code */
    field_scalar,  /* const struct node *, one piece of text */
    field_list,    /* const struct node * */
    field_map,     /* const struct node * */
    field_terms,   /* all keys with a dot, read by their own code; its own key is for documents */
    field_ignored, /* read by other programs */
    field_later,   /* no meaning in this version (`not-supported`); `doc` is the hint */
};

enum field_flag_bits {
    required = 1,
    positive = 2,       /* above zero (`out-of-range`) */
    not_negative = 4,   /* zero or above */
    slips = 8,          /* may name `slip` */
    slips_not = 16,     /* may name `slip`, which is 0 */
    may_vary = 32,      /* a number; if varying it is infinite, and read again later */
    may_be_empty = 128, /* without a value it is ignored */
    stored = 64,        /* reading only stores the number and tests its side of 0 and 1 (patch.h) */
};

struct choice {
    const char *name;
    int value;
    const char *doc;
};

/* Type of the entries of a list or mapping; `one_value`: no collection, or one with entries of any kind. */
enum entries {
    one_value,    /* one mapping, of `group` */
    each_group,   /* mappings of `group` */
    each_kind,    /* one of `kinds` */
    each_number,  /* constants */
    each_word,    /* names */
    each_pair,    /* [x, y] */
    each_point,   /* [x, y], or names */
    each_polygon, /* [[x, y], ...] */
};

struct kinds;

struct field {
    const char *key;
    enum field_type type;
    enum quantity quantity;
    unsigned flags;
    size_t offset;
    const struct choice *choices;
    size_t choice_count;
    const struct group *group; /* of a mapping, or of the entries of a list or mapping */
    enum entries entries;
    const struct kinds *kinds; /* of the value, or of its entries */
    const char *doc;
};

struct group {
    const char *name;  /* in messages: "a body", "`simulate`" */
    const char *brief; /* key of a single value that replaces the mapping, or NULL */
    const struct field *fields;
    size_t count;
    const struct group *base; /* more fields, at `base_offset` of the structure; or NULL */
    size_t base_offset;
    const char *doc;
};

/* One of several groups, chosen by its key: `slide: {...}`, `spring: {...}`. */
struct kind {
    const char *name;
    int value;
    const struct group *group;
    unsigned motions;      /* bits 1 << motion_kind: motions that allow it */
    const char *elsewhere; /* hint for other motions */
    const struct law *law; /* of forces and moments */
};

/* A word of textbooks and other programs, with a hint at the corresponding kind. */
struct usual_word {
    const char *word, *hint;
};

struct kinds {
    const char *noun; /* in messages: "force" */
    const struct kind *kinds;
    size_t count;
    const struct usual_word *usual; /* up to an entry without a word (usual_words.h) */
    const char *one;                /* hint where two kinds are in one entry */
};

/* ---- the groups and the structures that they fill */

struct scene_keys {
    double version;
    const char *title, *description;
    int units;
    int plane; /* 1: horizontal */
    double datum;
    const struct node *gravity, *parameters, *inputs, *tables, *own, *ground, *bodies, *couplings, *contacts,
        *simulate, *output, *grading, *symbols;
};

struct grading_keys {
    double digits;
    const struct node *draw, *points, *canvas;
    const struct node *reactions;
    fbd_grading grading;
};

struct table_keys {
    const char *file, *x, *y;
    const struct node *points;
    int interpolation, beyond; /* enum table_interpolation, enum table_beyond */
};

/* Of a parameter or an input. */
struct constant_keys {
    const struct node *value, *range;
    const char *description;
};

struct own_state_keys {
    const struct node *rate, *initial, *unit;
};

struct output_keys {
    double every;
    const struct node *points;
};

struct ground_keys {
    const struct node *points, *lines, *polygons;
};

struct line_keys {
    const struct node *through;
    double along;
};

struct simulate_keys {
    struct value until;
    double tolerance, accuracy, step, every;
    int method; /* in method_choices */
    int impacts;
    const struct node *output, *events;
};

struct event_keys {
    const char *name;
    const struct node *when;
    int direction, then;
    bool stop;
};

enum { event_goes_on, event_stops };

enum { impacts_simultaneous, impacts_propagate };

/* Keys of a part, and of a body without parts. */
struct part_keys {
    double mass;
    int shape, axis;
    double length, radius, outer_radius, inner_radius, a, b, c, angle;
    struct vec from, to, center;
    const struct node *inertia, *corners;
};

struct body_keys {
    const char *description;
    struct part_keys part;
    const struct node *parts, *points, *motion, *initial, *forces, *moments, *hand, *symbols, *exact;
};

struct inertia_keys {
    double value, gyration;
    const struct node *about;
};

/* Keys of the position of a joint; each kind of motion has some of them. */
struct motion_keys {
    double along, angle;
    const struct node *on, *through, *line, *at, *point, *prescribed, *low, *high;
    double restitution;                   /* of the stops */
    const struct node *x, *y, *from, *to; /* of a track */
    bool closed, turn;
};

/* In the order of the body's coordinates. */
struct initial_keys {
    double q[most_coordinates_of_a_body], v[most_coordinates_of_a_body];
    bool assemble;
    const struct node *p, *x; /* on a track: the position by its parameter */
};

/* In the same order. */
struct exact_keys {
    struct value q[most_coordinates_of_a_body], v[most_coordinates_of_a_body];
};

struct load_keys {
    struct load load;
    const char *name;
    const struct node *value, *at, *from, *to, *toward, *wind, *velocity;
    const struct node *since, *until; /* conditions at which it begins and ends */
    double neutral, radius;
    struct value coefficient, factor, exhaust, bearing;
    int side, frame;
};

/* `at` of an applied force as a mapping. */
struct place_keys {
    const struct node *point, *offset;
};

enum { frame_world, frame_body };

/* Keys of `around`. */
struct around_keys {
    const struct node *on;
    double radius, turns;
    struct value mu_s, mu_k;
};

/* Keys of an entry of `wound`. */
struct wound_keys {
    const struct node *on;
    int side; /* enum wound_side */
    double radius, length;
};

/* The side of a line on which a contact keeps its body. */
enum contact_side { contact_side_start, contact_side_up, contact_side_left, contact_side_right };

/* Kinds of couplings: those of loads; from here on those of constraints. */
enum { coupling_constraint = 100 };

struct hand_keys {
    const struct node *equation, *conserved, *when, *about, *impact;
};

/* The value is the index in the table; 0 is `auto`. */
extern const struct choice method_choices[];

extern const struct group scene_group, ground_group, line_group, simulate_group, output_group, event_group;
extern const struct group around_group, wound_group, contact_group, parameter_group, input_group, table_group,
    own_state_group;
extern const struct group grading_group;
extern const struct group *const grading_points_group, *const grading_canvas_group;
extern const struct group body_group, part_group, inertia_group, hand_group, place_group;
extern const struct group initial_groups[], exact_groups[]; /* by enum motion_kind */
extern const struct kinds motion_kinds, force_kinds, moment_kinds, coupling_kinds;
extern const struct kind *const contact_kind; /* among the couplings, or in the list `contacts` */

/* The keys of shapes by index, NULL behind the last; *taken: this shape (enum shape_kind) has the key. */
const char *shape_dimension(size_t index, int shape, bool *taken);

/* ---- macros for the rows of a table, one row for each key; `at` is the offset in the structure */

#define FIELD_PLAIN(key, type, quantity, flags, at, doc)                                                     \
    {                                                                                                        \
        key, type, quantity, flags, at, NULL, 0, NULL, one_value, NULL, doc                                  \
    }

#define FIELD_TEXT(at, key, doc)                    FIELD_PLAIN(key, field_text, a_number, 0, at, doc)
#define FIELD_NAME(at, key, doc)                    FIELD_PLAIN(key, field_name, a_number, 0, at, doc)
#define FIELD_FLAG(at, key, doc)                    FIELD_PLAIN(key, field_flag, a_number, 0, at, doc)
#define FIELD_NUMBER(at, key, quantity, flags, doc) FIELD_PLAIN(key, field_number, quantity, flags, at, doc)
#define FIELD_VALUE(at, key, quantity, flags, doc)  FIELD_PLAIN(key, field_value, quantity, flags, at, doc)
#define FIELD_VECTOR(at, key, quantity, doc)        FIELD_PLAIN(key, field_vector, quantity, 0, at, doc)
#define FIELD_IGNORED(key, doc)                     FIELD_PLAIN(key, field_ignored, a_number, 0, 0, doc)
#define FIELD_LATER(key, doc)                       FIELD_PLAIN(key, field_later, a_number, 0, 0, doc)
#define FIELD_CHOICE(at, key, table, doc)                                                                    \
    {                                                                                                        \
        key, field_choice, a_number, 0, at, FIELDS(table), NULL, one_value, NULL, doc                        \
    }
#define FIELD_NODE(at, key, type, flags, group, doc)                                                         \
    {                                                                                                        \
        key, type, a_number, flags, at, NULL, 0, group, one_value, NULL, doc                                 \
    }
#define FIELD_ENTRIES(at, key, type, flags, entries, group, doc)                                             \
    {                                                                                                        \
        key, type, a_number, flags, at, NULL, 0, group, entries, NULL, doc                                   \
    }
#define FIELD_KINDS(at, key, type, flags, entries, kinds, doc)                                               \
    {                                                                                                        \
        key, type, a_number, flags, at, NULL, 0, NULL, entries, kinds, doc                                   \
    }

#define FIELDS(table) (table), sizeof(table) / sizeof *(table)

#endif
