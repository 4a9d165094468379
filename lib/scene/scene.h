/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Scene: the content of a model file, checked and typed, without anything derived from it.
 *
 * Every number is in the coherent units of the scene's unit system, angles in radians. Positions point into
 * the file, so that later stages can name the line of an error. The scene owns all its memory.
 *
 * Coordinates are numbered through all bodies in file order: coordinate i has position q[i] and rate v[i],
 * and user state k, whose equation of first order the file gives, has the value z[k]. The state vector is y =
 * [q, v, z] with scene_size entries. In expressions slot 0 is t, slot 1 + i is q[i], slot 1 + n + i is v[i],
 * and slot 1 + 2 n + k is z[k], with n coordinates in all.
 */
#ifndef FBD_SCENE_SCENE_H
#define FBD_SCENE_SCENE_H

#include "fbd_grade.h"
#include "scene/constraint.h"
#include "scene/joint.h"
#include "scene/law.h"
#include "scene/loads.h"

/* Equations with more summands are not split. */
enum { most_summands = 24 };

/* One summand of an equation with all summands moved to its right side. */
struct hand_summand {
    const char *text; /* without its sign */
    double sign;
    const struct expr *expr;
};

/* A spring, damper or actuator between a point of a body and a point of another one, or of the ground. */
struct force_coupling {
    struct load load; /* load_spring, load_damper, load_actuator or moment_applied: name, position, law */
    int body[2];      /* ground_body for the ground; not both */
    struct point point[2];
};

/* A derivation by the user: an equation to be checked. */
struct hand {
    const char *written; /* text of the file */
    const char *text; /* the expressions that it was read as; the same bytes if it is an expression already */
    struct pos at;
    enum hand_kind {
        hand_of_states,  /* at every state */
        hand_conserved,  /* `left` keeps its initial value during a run; `right` is NULL */
        hand_of_run,     /* at any time of a run: it names initial values, works or impulses */
        hand_of_impacts, /* at impacts of a run */
    } kind;
    const char *impact;              /* name of the contact or rope whose impacts count; NULL: all */
    const struct expr *left, *right; /* over the extended slots below */
    const struct expr *when;         /* truth value: where the equation is claimed to hold; NULL everywhere */
    const char *about_name;          /* point of reference of moments; NULL where not given */
    const struct expr *about[2];     /* its position in the world */
    size_t summand_count;
    struct hand_summand *summands;
};

/* A force or moment of the diagram of a body, as a derivation may name it: `cord`, `wrist.x`, `N_1`. */
struct force_name {
    int body;
    const char *name;
    bool letter; /* underscores in it are ignored: N1 is N_1 */
    struct dim dim;
};

/* The value of a symbol of the file's `symbols`: forces with signs. */
struct force_sum {
    size_t count;
    struct signed_force {
        int body;
        const char *name;
        double sign;
    } * forces;
};

/* Additional names of a hand equation: slot 1 + scene_size + k for k in this list. */
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

/* The time of a name in an equation of a run: the current time, or that of `initial(...)`, `before(...)`,
 * `after(...)`, whose slots are those of the current time plus a multiple of hand_sense_size. */
enum hand_sense { sense_now, sense_initial, sense_before, sense_after, hand_senses };

enum { most_absolutes = 1000 };

/* A number of a reaction. */
enum reaction_part {
    reaction_x, /* of the force on the first of its bodies in the file */
    reaction_y,
    reaction_force, /* its magnitude */
    reaction_tension, /* of a rope, rod, spring or damper: positive when it pulls; the largest one of a rope's pieces */
    reaction_normal,   /* of a contact the sum over its points */
    reaction_friction, /* to the left of an observer who stands on the surface */
    reaction_moment,   /* magnitude, of a weld and of a ratio whose first coordinate is an angle */
};

struct body {
    const char *name;
    struct pos at;
    bool assemble; /* its coordinates follow from its couplings at the start */
    bool complete; /* false when errors in it were reported; later checks skip it */
    struct motion motion;
    int first, count;          /* its coordinates */
    struct value mass;         /* if varying; else expr NULL. That of the part is then the initial mass */
    struct value inverse_mass; /* 1/m, for its accelerations */
    const char *mass_name; /* the parameter that is its mass, if its name is a symbol of a mass; or NULL */
    size_t part_count, point_count, load_count, hand_count;
    struct part *parts;
    struct named_point *points; /* given points and those of its shapes */
    struct load *loads;         /* in file order: forces, then moments */
    struct hand *hands;
    /* Exact solution of its coordinates and then its rates, over t alone; expr NULL when not given. */
    struct value exact[2 * most_coordinates_of_a_body];
};

static inline bool body_has_journal(const struct body *body)
{
    for (size_t i = 0; i < body->load_count; i++)
        if (body->loads[i].journal) return true;
    return false;
}

/* A quantity that an expression may name beside coordinates: position or velocity of a point of a body in the
 * world, orientation, slip speed and others. Number k has slot 1 + scene_size + hand_slots + k. */
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
        absolute_acceleration, /* in derivations: of coordinate `part` of the body */
        absolute_slip,         /* slip speed of a contact with dry friction */
        absolute_mass,         /* of a body with varying mass */
        absolute_mass_rate,    /* its rate of change */
        absolute_force,        /* in derivations: the force or moment of the diagram called `force` */
        absolute_ax,           /* acceleration of a point in the world */
        absolute_ay,
        absolute_alpha,    /* angular acceleration */
        absolute_inertia,  /* moment of inertia about a point of the body */
        absolute_section,  /* in derivations: N, V, M (`part`) at the distance point.where.x from the end */
        absolute_work,     /* of a force during a run */
        absolute_impulse,  /* of a force during a run */
        absolute_reaction, /* in events: of a constraint, a spring or damper, or the joint of the body */
        absolute_input,    /* an input that is no constant of the model */
    } kind;
    int part;          /* of absolute_reaction: enum reaction_part; of absolute_input: the parameter */
    const char *force; /* of absolute_reaction: name of the spring or damper; or NULL */
    const struct force_sum *sum; /* of a declared symbol, whose key is then `force` */
    int roll; /* absolute_slip of a rolling body, absolute_reaction: 1 + index of its constraint; else 0 */
    bool angular;  /* absolute_slip of a bearing */
    struct pos at; /* of absolute_section */
    bool moves;    /* named by an equation of motion or an event; else only by derivations */
};

/* The force of a pivot in an event. */
static inline bool absolute_is_of_pin(const struct absolute *absolute)
{
    return absolute->kind == absolute_reaction && absolute->roll == 0 && !absolute->force &&
           absolute->part <= reaction_force;
}

/* A user state: z' = rate. */
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

/* ---- parameters, events, output, grading */

/* The callback that computes an input from t and y = [q, v, z]: fbd_force_callback. */
typedef int input_function(void *context, double t, const double *y, double *value);

/* Where an input that is no constant of the model gets its value. */
struct input_call {
    input_function *function; /* NULL: no callback computes it */
    void *context;
    bool held; /* each state has a value of it (fbd_simulation_set_input), at first that of the file */
};

static inline bool input_varies(const struct input_call *call)
{
    return call->function || call->held;
}

struct parameter {
    const char *name, *description; /* description "" when not given */
    const char *unit;               /* coherent; "" for a pure number or an unknown unit */
    struct pos at;
    double value, low, high; /* low to high: of a slider; NAN when not given */
    struct dim dim;
    bool bare; /* given without a unit */
    bool used;
    bool derived;           /* defined by other parameters or gravity */
    bool input;             /* of `inputs`: constant between two changes from outside */
    struct input_call call; /* of an input that is no constant */
};

struct user_event {
    const char *name;
    struct pos at;
    const char *text;
    const struct expr *left, *right; /* crosses where left - right = 0; right may be NULL */
    int direction;                   /* +1 rising, -1 falling, 0 both */
    bool stop;
    int lifetime; /* the number of the lifetime (loads.h) that begins or ends there; 0 of other events */
    bool begins;  /* then: it begins */
};

/* A point whose position, velocity and acceleration in the world are output. */
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
    const char *method; /* NULL without `simulate` */
};

struct scene {
    struct arena arena;
    const char *file, *title; /* title "" when not given */
    enum unit_system units;
    struct vec gravity; /* acceleration in the plane, straight down by default */
    double pressing;    /* acceleration of gravity normal to the plane; 0 where that is vertical */
    double datum;       /* height y at which the potential energy of gravity is zero */
    size_t parameter_count, table_count, body_count, event_count, force_coupling_count, constraint_count;
    struct parameter *parameters; /* of `parameters`, then of `inputs` */
    struct scene_table *tables;
    struct body *bodies;
    struct user_event *events;
    struct force_coupling *force_couplings;
    struct constraint *constraints;
    struct simulate simulate;
    fbd_grading grading; /* how answers are graded with this file as the key */
    size_t output_point_count;
    struct output_point *output_points;
    bool hands_left; /* derivations were skipped that name forces of the model (struct document) */
    size_t coordinate_count, absolute_count;
    struct coordinate *coordinates;
    struct absolute *absolutes;
    int lifetime_count; /* forces and constraints that begin or end */
    size_t own_count;   /* of `states` */
    struct own_state *own;
};

/* The length of y. */
static inline size_t scene_size(const struct scene *scene)
{
    return 2 * scene->coordinate_count + scene->own_count;
}

/* Distance between the slots of two subsequent values of hand_sense. */
static inline size_t hand_sense_size(const struct scene *scene)
{
    return scene_size(scene) + hand_slots + most_absolutes;
}

/* True if a callback computes an input. */
static inline bool scene_has_calls(const struct scene *scene)
{
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (scene->parameters[i].call.function) return true;
    return false;
}

/* True if states have values of inputs. */
static inline bool scene_holds_inputs(const struct scene *scene)
{
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (scene->parameters[i].call.held) return true;
    return false;
}

/* A parameter set from outside, as text: `--set f1=50 N`; of a table the file: `--set road=b.csv`. */
struct override {
    const char *name;
    const char *value;      /* NULL: value of the file, which may differ in other readings */
    bool varies;            /* its value will change in the next reading (patch.h) */
    struct input_call call; /* where an input gets its value instead */
};

/* A model file as a tree of its YAML: constant once it is open, shareable by threads. Scenes with other
 * parameters are made from it without parsing the text again. */
struct programs;
struct scene;

/* Callbacks of a caller that puts derivations of others into a scene; these may use names that the scene does
 * not have. */
struct hand_reader {
    void *context;
    bool (*is_known)(void *context, const char *body, const char *name); /* is it a force? */
    void (*take)(void *context, const struct node *node,
                 const char *text); /* receives a text as it was read */
};

struct document {
    struct arena arena;
    const char *file; /* names the text in messages; may be NULL */
    const struct node *root;
    bool without_hands;                    /* do not read derivations: the motion does not depend on them */
    bool split_hands;                      /* split derivations into their summands, for --check-hand */
    const struct hand_reader *hand_reader; /* or NULL */
    size_t force_name_count;
    const struct force_name *
        force_names; /* forces of the diagrams; NULL: not known yet, derivations with unknown names are skipped */
    struct programs *programs; /* expressions compiled once for all readings (programs.h), or NULL */
    struct scene *first;       /* the scene whose memory holds them */
    const struct scene *like;  /* an earlier scene of the same text, whose tables are reused, or NULL */
    bool same_parameters;      /* `like` has the same parameters */
};

/* Parse the file `text`, which must live as long as the document. False with notes in `errors` if it is no
 * YAML; document_close must be called even then. */
bool document_open(struct document *document, const char *text, size_t length, const char *file,
                   fbd_errors *errors);
void document_close(struct document *document);

/* Read the document once to compile the expressions that are valid for all readings under these overrides,
 * whatever the values of overrides without a value. False with notes in `errors` when the file is wrong. */
bool document_prepare(struct document *document, const struct override *overrides, size_t override_count,
                      fbd_errors *errors);

/* Make the scene of a document. All errors are noted in `errors` in one go; the result then is NULL or a
 * scene whose faulty bodies are not `complete`. The scene may use the programs of a document that was
 * prepared: then the document must outlive it. */
struct scene *scene_make(const struct document *document, const struct override *overrides,
                         size_t override_count, fbd_errors *errors);

/* Parse and make the scene of a model file in memory. `like` is a scene of the same text and parameters whose
 * tables are reused, or NULL. */
struct scene *scene_read(const char *text, size_t length, const char *file, const struct override *overrides,
                         size_t override_count, const struct scene *like, fbd_errors *errors);

/* The parameter m2 or m_2, for number 2, which a file may use for the mass of any of its bodies; or NULL. */
const struct parameter *scene_mass_parameter(const struct scene *scene, int number);

void scene_free(struct scene *scene);

#endif
