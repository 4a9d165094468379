/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: connections of bodies, as the file gives them.
 */
#include <math.h>

#include "fbd_view.h"
#include "model/model.h"

static fbd_connection_end end_at(int body, const struct point *point)
{
    return (fbd_connection_end){.body = body < 0 ? FBD_GROUND : body,
                                .whole = point->kind == point_absent,
                                .center = point->kind == point_G,
                                .point = {point->where.x, point->where.y}};
}

static fbd_connection of_constraint(const struct constraint *constraint)
{
    _Static_assert((int)FBD_CONNECTION_ENDS == (int)most_constraint_ends, "the ends of a coupling");
    fbd_connection connection = {.kind = constraint_laws[constraint->kind].drawing,
                                 .name = constraint->name,
                                 .line = constraint->at.line,
                                 .column = constraint->at.column,
                                 .friction = constraint->kind == constraint_groove ||
                                             constraint->kind == constraint_capstan,
                                 .length = constraint->length_given ? constraint->length : NAN,
                                 .end_count = (size_t)constraint->end_count};
    for (int i = 0; i < constraint->end_count; i++) {
        connection.ends[i] = end_at(constraint->body[i], &constraint->point[i]);
        connection.ends[i].radius = constraint->radius[i];
    }
    for (int k = 0; k < 2 && constraint->end_count > k; k++) {
        fbd_connection_end *end = &connection.ends[k == 0 ? 0 : constraint->end_count - 1];
        end->wound = constraint->wound[k];
        end->spare = constraint->spare[k];
    }
    return connection;
}

static const char *kind_of(const struct load *load)
{
    if (load->kind == load_spring) return "spring";
    return load->kind == load_damper ? "damper" : "actuator";
}

static fbd_connection of_force(const struct force_coupling *coupling)
{
    const struct load *load = &coupling->load;
    return (fbd_connection){.kind = kind_of(load),
                            .name = load->name,
                            .line = load->at.line,
                            .column = load->at.column,
                            .length = NAN,
                            .stiffness = load->stiffness,
                            .coefficient = load->coefficient,
                            .free_length = load->free_length,
                            .end_count = 2,
                            .ends = {end_at(coupling->body[0], &coupling->point[0]),
                                     end_at(coupling->body[1], &coupling->point[1])}};
}

size_t fbd_model_connection_count(const fbd_model *model)
{
    return model ? model->scene->constraint_count + model->scene->force_coupling_count : 0;
}

fbd_connection fbd_model_connection(const fbd_model *model, size_t index)
{
    if (index >= fbd_model_connection_count(model)) return (fbd_connection){.length = NAN};
    const struct scene *scene = model->scene;
    return index < scene->constraint_count
               ? of_constraint(&scene->constraints[index])
               : of_force(&scene->force_couplings[index - scene->constraint_count]);
}
