/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/explain_structure.h"

#include <string.h>

#include "dynamics/project.h"
#include "loop/islands.h"
#include "loop/structure.h"

enum { most_listed = 12 };

static const char *words_for(enum structure structure)
{
    switch (structure) {
    case structure_velocity_free:
        return "no force depends on a velocity: Nystrom pair of order 12(10), half the steps of the general "
               "method or less";
    case structure_linear:
        return "linear equations with constant coefficients between events: propagated exactly";
    case structure_constant: return "constant accelerations between events: exact parabolas, one step each";
    case structure_flights: return "exact parabolas while no contact is closed, else the general method";
    case structure_fixed: return "no degree of freedom: one step, for any loads";
    case structure_general:
    case structure_kinds: break;
    }
    return "no special structure: the general method";
}

/* structure_kinds when memory is out. */
static enum structure structure_as_it_lies(const struct fbd_model *model)
{
    enum structure structure = structure_of(model);
    if (structure != structure_general && structure != structure_flights) return structure;
    struct fbd_state *state = state_new(model);
    if (!state) return structure_kinds;
    if (state_is_fixed(state)) structure = structure_fixed;
    state_free(state);
    return structure;
}

/* The structure of group `index`; structure_kinds when memory is out. */
static enum structure structure_of_group(const struct fbd_model *model, const struct islands *division,
                                         size_t index)
{
    if (division->count <= 1) return structure_as_it_lies(model);
    struct arena memory = {0};
    struct fbd_model *group = model_group(model, &division->selections[index], &memory);
    enum structure structure = group ? structure_as_it_lies(group) : structure_kinds;
    model_free(group);
    arena_free(&memory);
    return structure;
}

static void write_names(struct text *text, const struct fbd_model *model, const struct selection *selection)
{
    text_add(text, "  ");
    for (size_t i = 0; i < selection->body_count && i < most_listed; i++)
        text_printf(text, "%s%s", i ? ", " : "", model->bodies[selection->bodies[i]].name);
    if (selection->body_count > most_listed)
        text_printf(text, " and %zu more", selection->body_count - most_listed);
}

static bool write_groups(struct text *text, const struct fbd_model *model, const struct islands *division,
                         bool automatic)
{
    size_t counts[structure_kinds] = {0};
    for (size_t g = 0; g < division->count; g++) {
        enum structure structure = automatic ? structure_of_group(model, division, g) : structure_general;
        if (structure == structure_kinds) return false;
        counts[structure]++;
        if (g >= most_listed) continue;
        write_names(text, model, &division->selections[g]);
        text_printf(text, ": %s\n", automatic ? words_for(structure) : "the selected method");
    }
    if (division->count <= most_listed) return true;
    text_printf(text, "  and %zu more; of all groups:\n", division->count - most_listed);
    for (int k = 0; k < structure_kinds; k++)
        if (counts[k] > 0) text_printf(text, "  %6zu  %s\n", counts[k], words_for((enum structure)k));
    return true;
}

bool explain_structure(struct text *text, const struct fbd_model *model, const fbd_options *options)
{
    const char *method = options->method ? options->method : model->scene->simulate.method;
    double step = options->step != 0        ? options->step
                  : options->automatic_step ? 0
                                            : model->scene->simulate.step;
    if (options->no_structure) {
        text_add(text, "  not used (--no-structure): all bodies together by one method\n");
        return true;
    }
    struct islands division;
    bool done = islands_make(&division, model);
    if (done) {
        if (division.count > 1)
            text_printf(
                text,
                "  %zu independent groups of bodies, each integrated independently with its own steps\n",
                division.count);
        bool automatic = (!method || strcmp(method, "auto") == 0) && step == 0;
        done = write_groups(text, model, &division, automatic);
    }
    islands_free(&division);
    return done;
}
