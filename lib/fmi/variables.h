/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The variables of an FMU: time, the parameters and inputs of the file, then the results of a run. The value
 * reference of a variable is its index in the list, which description and binary construct in the same way.
 */
#ifndef FBD_FMI_VARIABLES_H
#define FBD_FMI_VARIABLES_H

#include "base/arena.h"
#include "dynamics/state.h"

enum fmi_kind {
    fmi_time,
    fmi_parameter,
    fmi_calculated, /* a parameter defined in the file by others */
    fmi_input,
    fmi_coordinate,
    fmi_rate,
    fmi_acceleration,
    fmi_state, /* of `states` */
    fmi_point, /* position, velocity or acceleration of `output: {points: ...}` */
};

struct fmi_variable {
    enum fmi_kind kind;
    const char *name, *unit, *description;
    size_t index;      /* of the parameter, of the component of y or a, of the output point */
    int part;          /* enum world_part */
    unsigned integral; /* of a rate or acceleration: the variable whose derivative it is; else 0 */
};

struct fmi_variables {
    struct arena arena;
    struct fmi_variable *list;
    size_t count;
};

/* Returns false when memory is out; free it also then. The model must outlive the list. */
bool fmi_variables_init(struct fmi_variables *variables, const struct fbd_model *model);
void fmi_variables_free(struct fmi_variables *variables);

bool fmi_is_output(const struct fmi_variable *variable);

/* True if directional derivatives of all outputs are available: not with points, prescribed motions or
 * expressions with a memory. */
bool fmi_has_derivatives(const struct fbd_model *model);

/* The value of a variable that is no parameter or input, in an evaluated state. */
double fmi_value(const struct fmi_variable *variable, const struct fbd_state *state);

#endif
