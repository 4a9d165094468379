/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Declarations shared by the files that compile a scene.
 */
#ifndef FBD_MODEL_BUILDER_H
#define FBD_MODEL_BUILDER_H

#include "model/model.h"

/* Affine terms are first summed per coordinate, then packed. */
struct builder {
    struct fbd_model *model;
    fbd_errors *errors;
    struct affine_term *affine;  /* n */
    size_t kink_room, pole_room; /* entries for which the plan has memory */
};

/* Compile a value of the scene; registers its switches. */
struct formula builder_formula(struct builder *builder, const struct value *value, int body, int load);

struct formula formula_constant(double value);

/* Add the modes of couplings and of prescribed motion (plan_couplings.c). */
void plan_couplings(struct builder *builder);

/* Collect the equations of bodies that stand alone, when all loads have been added (scalar_equations.c). False when
 * memory is out. */
bool scalar_equations_collect(struct builder *builder);

/* Is the sum of the forces along the coordinate constant? */
bool scalar_equation_is_constant(const struct scalar_equation *equation);

/* Find the switches on which a sliding mode is possible; the rest of the plan is complete (slides.c). */
void slides_find(struct fbd_model *model);

/* Find the friction modes whose slip velocity a law names; requires their list in the plan (slips.c). False
 * when memory is out. */
bool slips_find(struct fbd_model *model);

/* Resolve the reactions that events name, and flag these events (reactions.c). */
void reactions_find(struct fbd_model *model);

/* Reject gears on fixed axes whose pitch circles do not touch, wheels that do not touch their racks, and
 * belts whose tension is undetermined or given twice. Add the preload of belts between axes at a constant
 * distance (gear_check.c). */
void couplings_check(struct builder *builder);

/* Reject ratios that follow from others, or leave a coordinate no motion (ratio_check.c). False when memory is out. */
bool ratios_check(struct builder *builder);

/* Reject welds of particles, but at their first end, and welds between bodies that are one already (weld_check.c). */
void welds_check(struct builder *builder);

/* The part of the force of a body on a plane that is at a point of it, by equilibrium; notes an error if the body tips
 * (plane_check.c). */
double plane_share(struct builder *builder, const struct constraint *source);

/* Reject the weight as the force on the plane of a body that carries others, and more static than kinetic friction on planes
 * that are linked (plane_check.c). */
void planes_check(struct builder *builder);

/* Reject contacts between points that do not move on one line (contact_points.c). */
void contacts_check(struct builder *builder);

/* Give the arrows of each diagram distinct names (arrow_names.c). False when memory is out. */
bool arrows_name(struct fbd_model *model);

/* As model_compile; the caller makes the labels. The arrays of the model are in `memory`. */
struct fbd_model *model_compile_group(struct scene *scene, struct arena *memory, fbd_errors *errors);

/* Fill the plan from the bodies and loads of the model. False when memory is out. */
bool plan_build(struct builder *builder);

/* Decide for each load whether a potential energy exists, with the reason. */
bool classify_loads(struct builder *builder);

/* Set model->constant_slots. False when memory is out. */
bool slots_find_constant(struct fbd_model *model);

/* The data of tracks beyond their links (track.c): false when memory is out. */
bool tracks_set(struct builder *builder);
void track_set_body(const struct scene *scene, struct model_body *body);

#endif
