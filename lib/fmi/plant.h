/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plant: the motion behind an instance of an FMU, whatever the version of the standard.
 *
 * Between communication points inputs are constant, so they are constants of the model. When one changes, the file is
 * read again with its new value, and a new simulation goes on from the state that the last one has come to. All that
 * follows from the change (lists of terms, switches, methods) so follows by itself.
 *
 * A simulation steps as it does in fbd-run, beyond the communication point, and is looked at there. So it does not depend
 * on where the communication points are. What is saved of a plant is where its simulation began, and how far it has come:
 * a plant that is put back makes the same steps again, and comes to the same bits.
 */
#ifndef FBD_FMI_PLANT_H
#define FBD_FMI_PLANT_H

#include "fmi/package.h"

enum plant_step {
    plant_arrived, /* at the target */
    plant_event,   /* at an event, before or at the target */
    plant_stopped, /* at an event of the file that ends the run */
    plant_failed,  /* plant->reason says why */
};

/* Where a simulation began. Values are those of all parameters and inputs. */
struct plant_base {
    bool of_file;    /* at the start of the file, at t = 0 */
    double until;    /* the end that its steps know of */
    double *values;  /* parameter_count */
    double *numbers; /* number_count: the state (fbd_state_pack), unless of_file */
    size_t number_count;
};

struct plant {
    char *text, *path, *settings_text;
    size_t length;
    struct package_settings settings;
    struct fmi_variables variables;
    struct fbd_model *first; /* of the file and its settings alone: what the variables are named by */
    size_t parameter_count;  /* and inputs */
    double *values;          /* as they are asked for */
    char token[package_token_size];

    bool running;       /* it has been initialized */
    double start, stop; /* stop is NAN where there is none */
    double t;
    double tolerance; /* asked for; 0 when none is */
    struct plant_base base;
    struct fbd_model *model; /* with the values of the base; NULL until it is made */
    fbd_simulation *simulation;
    fbd_state *state;   /* at t */
    const char *reason; /* why something failed */
    char own_reason[400];
};

/* What is in the folder `resources` of an unpacked FMU, before its start. NULL with notes in `errors`. */
struct plant *plant_open(const char *resources, fbd_errors *errors);
void plant_close(struct plant *plant);

/* Back to where plant_open left it. */
void plant_reset(struct plant *plant);

/* Give a parameter or input another value, which holds from the next call that needs it. */
void plant_set(struct plant *plant, size_t parameter, double value);

/* Begin at time `start`. */
void plant_begin(struct plant *plant, double start, double stop, double tolerance);

/* Make everything what it is at t with the values as they are now. False with a reason. */
bool plant_update(struct plant *plant);

/* The value of a variable after plant_update. */
double plant_get(const struct plant *plant, const struct fmi_variable *variable);

/* Go on to `target`; with `pause` to the first event after t at most. */
enum plant_step plant_step(struct plant *plant, double target, bool pause);

/* All of this as numbers, and back. `numbers` may be NULL when only their count is asked for. False when they are not of
 * such a plant, or memory is out. */
size_t plant_save(const struct plant *plant, double *numbers);
bool plant_restore(struct plant *plant, const double *numbers, size_t count);

#endif
