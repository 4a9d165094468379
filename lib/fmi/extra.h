/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Extra variables of an FMU, after those of fbd_model_variable: forces, moments, reactions and energies; works that are
 * chosen as outputs; and where model exchange can be had, the rates of user states and the event indicators. Exporter and
 * binary make the same list, of the model as the file and the settings give it.
 */
#ifndef FBD_FMI_EXTRA_H
#define FBD_FMI_EXTRA_H

#include "base/arena.h"
#include "fbd_exchange.h"

enum extra_kind { extra_column, extra_rate, extra_indicator };

struct extra {
    enum extra_kind kind;
    fbd_column_kind column; /* of a column */
    const char *name, *unit;
    size_t index;    /* among those of its kind */
    size_t integral; /* of a rate: the index of the variable that is the state */
    bool output;     /* of a column: it is chosen as an output; else it is local */
};

struct extras {
    struct arena arena;
    fbd_force_columns *columns;
    struct extra *list;
    size_t count, indicators;
    bool works;     /* a work is chosen as an output */
    bool exchanges; /* model exchange can be had ... */
    char why[300];  /* ... or why not */
};

/* Those of a model in which columns are outputs, by their names separated by commas; NULL: none. False with a note
 * `unknown-output` in `errors`, or when memory is out; free them also then. */
bool extras_make(struct extras *extras, const fbd_model *model, const char *outputs, fbd_errors *errors);
void extras_free(struct extras *extras);

/* The model with inputs that can be set (fbd_exchange_set_input), at first to their values in `model`. NULL with notes in
 * `errors`. */
fbd_model *extra_model(const fbd_model *model, fbd_errors *errors);

#endif
