/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: connections of bodies, as the file gives them.
 */
#include <math.h>

#include "expr/curve.h"
#include "fbd_geometry.h"
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

/* ---- their lines */

enum { curve_pieces = 240 };

static bool is_slot(const struct constraint *constraint)
{
    return constraint->kind == constraint_slot || constraint->kind == constraint_groove;
}

static const struct constraint *constraint_at(const fbd_model *model, size_t connection)
{
    return model && connection < model->scene->constraint_count ? &model->scene->constraints[connection]
                                                                : NULL;
}

fbd_path fbd_model_path(const fbd_model *model, size_t connection)
{
    const struct constraint *constraint = constraint_at(model, connection);
    if (!constraint) return (fbd_path){.point_count = 0};
    if (constraint->contact.polygon)
        return (fbd_path){.point_count = constraint->contact.polygon->count, .closed = true};
    if (!is_slot(constraint)) return (fbd_path){.point_count = 0};
    fbd_path path = {.side = constraint->presses};
    const struct curve *curve = constraint->curve;
    if (curve && curve->closed) {
        path.point_count = curve_pieces;
        path.closed = true;
    } else if (curve) {
        path.point_count = curve_pieces + 1;
    } else if (isfinite(constraint->from) && isfinite(constraint->to)) {
        path.point_count = 2;
    }
    return path;
}

/* A point of a slot, relative to that on which its line or curve is based. */
static struct vec slot_point(const struct constraint *constraint, size_t index)
{
    const struct curve *curve = constraint->curve;
    if (curve) return curve_at(curve, NULL, curve->start + curve->length * (double)index / curve_pieces).r;
    return vec_scale(index == 0 ? constraint->from : constraint->to, vec_unit(constraint->along));
}

bool fbd_model_path_point(const fbd_model *model, size_t connection, size_t index, double point[2])
{
    const struct constraint *constraint = constraint_at(model, connection);
    const bool there = point && index < fbd_model_path(model, connection).point_count;
    struct vec at = {NAN, NAN};
    if (there && constraint->contact.polygon) {
        at = constraint->contact.polygon->corners[index];
    } else if (there) {
        const int body = constraint->body[1];
        const bool at_G = body != ground_body && constraint->point[1].kind != point_fixed;
        const struct vec base = at_G ? model->bodies[body].inertia.G : constraint->point[1].where;
        at = vec_add(base, slot_point(constraint, index));
    }
    if (point) point[0] = at.x, point[1] = at.y;
    return there;
}
