/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Scene: what a model file says, checked and typed, and nothing that follows from it.
 *
 * Every number is in the coherent units of the scene's own system, angles in radians. Positions point into
 * the file, so that later stages can name the line of what they refuse. The scene owns all its memory.
 *
 * Coordinates are numbered through all bodies in file order: coordinate i has position q[i] and rate v[i], and
 * further state k, whose equation of first order the file gives, has the value z[k]. The vector of all is y = [q, v, z]
 * with scene_size entries. In expressions slot 0 is t, slot 1 + i is q[i], slot 1 + n + i is v[i], and slot
 * 1 + 2 n + k is z[k], with n coordinates in all.
 */
#ifndef FBD_SCENE_SCENE_H
#define FBD_SCENE_SCENE_H

#include "scene/constraint.h"
#include "scene/law.h"
#include "scene/loads.h"

/* The most summands that are told apart. */
enum { most_summands = 24 };

/* One summand of an equation, as if all stood on its right side. */
struct hand_summand {
    const char *text; /* without its sign */
    double sign;
    const struct expr *expr;
};

/* A spring or damper between a point of a body and a point of another one, or of the ground. */
struct coupling {
    struct load load; /* load_spring or load_damper: name, position, law */
    int body[2];      /* ground_body for the ground; not both */
    struct point point[2];
};

/* A derivation by the user: an equation that must hold. */
struct hand {
    const char *written; /* as it stands in the file, */
    const char
        *text; /* and as the expressions that it was read as: the same bytes where it is some already */
    struct pos at;
    enum hand_kind {
        hand_of_states,  /* at every state */
        hand_conserved,  /* `left` has at any time of a run the value of its start; `right` is NULL */
        hand_of_run,     /* at any time of a run: it names its start, works or impulses */
        hand_of_impacts, /* at impacts of a run */
    } kind;
    const char *impact;              /* the only one that counts; NULL: all */
    const struct expr *left, *right; /* over the extended slots below */
    const struct expr *when;         /* truth value: where it claims to hold; NULL everywhere */
    const char *about_name;          /* the point about which it has moments; NULL where it does not say, */
    const struct expr *about[2];     /* and where that is in the world */
    size_t summand_count;
    struct hand_summand *summands;
};

/* A force or moment of the diagram of a body, as a derivation may name it: `cord`, `wrist.x`, `N_1`. */
struct force_name {
    int body;
    const char *name;
    bool letter; /* underscores in it do not matter: N1 is N_1 */
    struct dim dim;
};

/* What a symbol of the file's `symbols` stands for: forces with signs. */
struct force_sum {
    size_t count;
    struct signed_force {
        int body;
        const char *name;
        double sign;
    } * forces;
};

/* A hand equation may use more names than a force: slot 1 + scene_size + k for k in this list. */
enum hand_slot {
    hand_acceleration, /* v_dot, or the body's coordinates in order */
    hand_mass = hand_acceleration + most_coordinates_of_a_body, /* m */
    hand_I_G,                                                   /* about the centre of mass */
    hand_I_O,                                                   /* about the pivot */
    hand_L,                                                     /* distance from O to G */
    hand_N,                                                     /* normal force */
    hand_mu_s,
    hand_mu_k, /* also `mu` */
    hand_slots,
};

/* What a name means in an equation of a run: at the time itself, or in `initial(...)`, `before(...)`, `after(...)`, whose
 * slots are these of the time itself, moved by hand_sense_size each. */
enum hand_sense { sense_now, sense_initial, sense_before, sense_after, hand_senses };

enum { most_absolutes = 1000 };

struct body {
    const char *name;
    struct pos at;
    bool assemble; /* its coordinates follow from its couplings at the start */
    bool complete; /* false when errors in it were reported: later checks leave it alone */
    struct motion motion;
    int first, count; /* its coordinates */
    struct value
        mass; /* where it varies: with the time, coordinates, states; else expr NULL. The mass of the part
                          is that at the start then */
    struct value inverse_mass; /* and 1/m, by which its accelerations divide */
    size_t part_count, point_count, load_count, hand_count;
    struct part *parts;
    struct named_point *points; /* all names: given ones and those of its shape */
    struct load *loads;         /* in file order: forces, then moments */
    struct hand *hands;
    /* What its coordinates and then its rates are known to be, over t alone; expr NULL when not given. */
    struct value exact[2 * most_coordinates_of_a_body];
};

/* Where a point of a body is in the world, how its frame is turned, or how fast it slips: an expression may
 * name it though it is no coordinate. Number k has slot 1 + scene_size + hand_slots + k. */
struct absolute {
    int body;
    struct point point;
    enum absolute_kind {
        absolute_x,
        absolute_y,
        absolute_vx,
        absolute_vy,
        absolute_angle,
        absolute_angle_dot,
        absolute_acceleration, /* derivations by hand: of coordinate `part` of the body */
        absolute_slip,         /* the speed of a pair of dry friction on its surface */
        absolute_mass,         /* of a body whose mass varies, */
        absolute_mass_rate,    /* and its rate of change */
        absolute_force,        /* derivations by hand: the force or moment of the diagram called `force`, */
        absolute_ax,           /* the acceleration of a point in the world, */
        absolute_ay,
        absolute_alpha,   /* of its angle, */
        absolute_inertia, /* and the moment of inertia about a point of the body; */
        absolute_work,    /* of a force during a run, */
        absolute_impulse, /* and that */
    } kind;
    int part;
    const char *force;
    const struct force_sum *sum; /* of a declared symbol; `force` is that then */
    int roll; /* absolute_slip of a rolling body: 1 + index of its constraint; 0: of the body's own pair */
    bool angular; /* absolute_slip of a bearing */
    bool moves;   /* what moves names it, or an event; else derivations by hand alone do */
};

/* A state of the file's own: z' = rate. */
struct own_state {
    const char *name;
    struct pos at;
    struct dim dim;
    double initial;
    struct value rate;
};

struct coordinate {
    int body;
    const char *name, *rate_name, *acceleration_name; /* "x", "v", "v_dot" */
    struct dim dim, rate_dim;
    bool angle;
    double initial, initial_rate;
};

/* ---- the rest */

struct parameter {
    const char *name, *description; /* description "" when not given */
    const char *unit;               /* coherent; "" for a pure number, or when nothing says which */
    struct pos at;
    double value, low, high; /* low to high: of a slider; NAN when not given */
    struct dim dim;
    bool bare; /* given without a unit */
    bool used;
    bool derived; /* the file defines it by other parameters, or gravity */
    bool input;   /* of `inputs`: no constant, though it is one for a whole run of a program */
};

struct user_event {
    const char *name;
    struct pos at;
    const char *text;
    const struct expr *left, *right; /* crosses where left - right = 0; right may be NULL */
    int direction;                   /* +1 rising, -1 falling, 0 both */
    bool stop;
};

/* A point whose place, velocity and acceleration in the world are written. */
struct output_point {
    const char *name; /* `rod.right` */
    int body;
    struct point point;
};

struct simulate {
    struct value until; /* expr NULL when the file has no `simulate` */
    double tolerance;   /* 0 when not given */
    double accuracy;    /* global, 0 when not given; excludes tolerance and step */
    double step;        /* fixed step, 0 for automatic */
    double every;       /* output interval, 0 for the default */
    bool propagate;     /* impacts at one instant are taken one after the other */
    const char *method; /* NULL where the file does not say how to run */
};

/* A parameter that each student has a value of: a number in [low, high] with the text `unit` behind it. */
struct drawn_parameter {
    const char *name;
    struct pos at;
    double low, high;
    const char *unit;
};

struct grading_points {
    double force, inertia, derivation, superfluous;
};

/* Where drawings of answers lie in the scene. */
struct grading_canvas {
    struct vec origin; /* of the scene, in units of the drawing */
    double unit;       /* the length that such a unit stands for; 0: the file does not say */
    double angle;      /* how far a direction may be off, in radians, */
    double snap; /* and a line of action, in units of the drawing; 0: as is usual for the kind of drawing */
};

/* How answers are graded that are held against this file as a key (lib/grade). */
struct grading {
    bool given; /* the file says so; else all is as by default */
    size_t draw_count;
    struct drawn_parameter *draws;
    int digits;                      /* decimal ones of values that are drawn */
    double tolerance, partial, pass; /* shares */
    struct grading_points points;
    struct grading_canvas canvas;
    enum { reactions_all, reactions_none, reactions_named } reactions; /* which are to be drawn */
    size_t reaction_count;
    const char *const *reaction_names; /* of couplings, or of their forces in a diagram */
    bool reactions_given;
};

struct scene {
    struct arena arena;
    const char *file, *title; /* title "" when not given */
    enum unit_system units;
    struct vec gravity; /* acceleration, straight down by default */
    double datum;       /* height y at which the potential energy of gravity is zero */
    size_t parameter_count, table_count, body_count, event_count, coupling_count, constraint_count;
    struct parameter *parameters; /* of `parameters`, then of `inputs` */
    struct scene_table *tables;
    struct body *bodies;
    struct user_event *events;
    struct coupling *couplings;
    struct constraint *constraints;
    struct simulate simulate;
    struct grading grading;
    size_t output_point_count;
    struct output_point *output_points;
    bool hands_left; /* derivations were left out that name what only a model has (struct document) */
    size_t coordinate_count, absolute_count;
    struct coordinate *coordinates;
    struct absolute *absolutes;
    size_t own_count; /* of `states` */
    struct own_state *own;
};

/* The length of y. */
static inline size_t scene_size(const struct scene *scene)
{
    return 2 * scene->coordinate_count + scene->own_count;
}

/* From the slots of one hand_sense to those of the next. */
static inline size_t hand_sense_size(const struct scene *scene)
{
    return scene_size(scene) + hand_slots + most_absolutes;
}

/* Parameters set from outside, as text: `--set f1=50 N`; of a table the file: `--set road=b.csv`. */
struct override {
    const char *name;
    const char *value; /* NULL: that of the file, but other readings of the document may have another */
    bool
        as_time; /* an input stands in the place of the time, and the time is the constant `now`: derivatives by
                          time are by it */
    double now;
    bool varies; /* its value will be another one in the next reading (patch.h) */
};

/* A model file as a tree of its YAML: constant once it is open, shareable by threads. Scenes under other
 * parameters are made of it without reading the text again. */
struct programs;
struct scene;

/* Who puts derivations of others into a scene, which may name more than the scene knows. */
struct hand_reader {
    void *context;
    bool (*is_known)(void *context, const char *body, const char *name);    /* is this the name of a force? */
    void (*take)(void *context, const struct node *node, const char *text); /* a text as it was read */
};

struct document {
    struct arena arena;
    const char *file; /* names the text in messages; may be NULL */
    const struct node *root;
    bool without_hands; /* leave the derivations by hand unread: nothing that moves depends on them */
    bool split_hands;   /* and those that are read, into their summands: what --check-hand compares */
    const struct hand_reader *hand_reader; /* told of them; or NULL */
    size_t force_name_count;
    const struct force_name
        *force_names;          /* what derivations may name of the diagrams; NULL: not known yet, and
                                             derivations with unknown names are left out */
    struct programs *programs; /* expressions compiled once for all readings (programs.h), or NULL */
    struct scene *first;       /* the scene that holds them */
    const struct scene
        *like; /* an earlier scene of the same text, whose tables and their files serve again, or */
    bool same_parameters; /* NULL; does it have the same parameters? */
};

/* Open the file `text`, which must live as long as the document. False with notes in `errors` when it is no
 * YAML; close it all the same. */
bool document_open(struct document *document, const char *text, size_t length, const char *file,
                   fbd_errors *errors);
void document_close(struct document *document);

/* Read it once to compile what holds for all readings under these overrides, whatever the value of those that
 * have none here. False with notes in `errors` when the file is wrong. */
bool document_prepare(struct document *document, const struct override *overrides, size_t override_count,
                      fbd_errors *errors);

/* What a document means. Everything wrong with it is noted in `errors` in one go; the result then is NULL or
 * a scene whose faulty bodies are not `complete`. The scene may use
 * the programs of a document that was prepared: then the document must outlive it. */
struct scene *scene_make(const struct document *document, const struct override *overrides,
                         size_t override_count, fbd_errors *errors);

/* Both at once: the scene of a model file in memory. `like` is a scene of the same text and parameters whose tables
 * serve again, or NULL. */
struct scene *scene_read(const char *text, size_t length, const char *file, const struct override *overrides,
                         size_t override_count, const struct scene *like, fbd_errors *errors);

/* The parameter m2 or m_2, for number 2, which a file may have for the mass of any of its bodies; NULL. */
const struct parameter *scene_mass_parameter(const struct scene *scene, int number);

void scene_free(struct scene *scene);

#endif
