/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Continuous: the motion of an instance for model exchange, independent of the version of the standard. The importer
 * integrates (fbd_exchange.h); inputs may change at any time.
 *
 * The order of the states is that of their derivatives in the description: each coordinate, followed by its rate, then the
 * user states.
 */
#ifndef FBD_FMI_CONTINUOUS_H
#define FBD_FMI_CONTINUOUS_H

#include "fmi/plant.h"

struct continuous {
    struct plant *plant; /* its values are those of parameters and inputs */
    fbd_model *model;    /* with inputs that may change; NULL until continuous_ready */
    fbd_exchange *exchange;
    fbd_state *state;
    fbd_force_columns *forces;
    size_t count, coordinates;
    double t;
    double *numbers, *spare;            /* count each, in the order of fbd_exchange */
    double *shown, *pulls, *indicators; /* values of variables, forces, indicators */
    bool is_shown;
    const char *reason; /* of a failure */
    char own_reason[400];
};

struct continuous *continuous_new(struct plant *plant);
void continuous_free(struct continuous *continuous);

/* Back to the state after continuous_new: values of parameters are read again. */
void continuous_drop(struct continuous *continuous);

/* Make the motion at the start, if it has not been made. False with a reason. */
bool continuous_ready(struct continuous *continuous);

/* Set an input, by its index among the parameters, to a finite value. Before continuous_ready it is that of the plant. */
void continuous_set_input(struct continuous *continuous, size_t parameter, double value);

void continuous_set_time(struct continuous *continuous, double t);
void continuous_set(struct continuous *continuous, const double *states);
void continuous_get(struct continuous *continuous, double *states);
bool continuous_derivatives(struct continuous *continuous, double *derivatives);

/* As many as the description has. */
void continuous_indicators(struct continuous *continuous, double *indicators);

/* The value of a variable that is no parameter or input, after continuous_ready. */
double continuous_value(struct continuous *continuous, size_t index);

/* A step is complete; sets whether an event has to be handled. */
void continuous_complete(struct continuous *continuous, bool *event);

struct continuous_event {
    bool jumps;  /* states have changed */
    bool ends;   /* an event of the file ends the motion */
    double next; /* time of the next event of time alone, or NAN */
};

/* Handle the events at the present time. False with a reason. */
bool continuous_update(struct continuous *continuous, struct continuous_event *event);

#endif
