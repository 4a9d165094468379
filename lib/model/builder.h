/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the files that compile a scene share.
 */
#ifndef FBD_MODEL_BUILDER_H
#define FBD_MODEL_BUILDER_H

#include "model/model.h"

/* Affine and sine terms are first summed per slot, then packed. */
struct builder {
    struct fbd_model *model;
    fbd_errors *errors;
    struct affine_term *affine; /* slots */
    struct sine_term *sine;     /* slots */
};

/* The formula of a value of the scene; registers its switches. */
struct formula builder_formula(struct builder *builder, const struct value *value, int body, int load);

/* The same of the rate of a state. */
struct formula builder_rate(struct builder *builder, const struct value *value, int own);

struct formula formula_constant(double value);
static inline bool formula_given(const struct formula *formula)
{
    return formula->expr != NULL || formula->constant != 0;
}

/* What a formula changes with, seen from one body: a set of depends_... bits. */
unsigned formula_depends(const struct model_body *body, const struct formula *formula);

/* Put one load of a body into the plan's lists. */
void plan_load(struct builder *builder, struct model_body *body, int index);

/* Add the modes of couplings and of prescribed motion (plan_couplings.c). */
void plan_couplings(struct builder *builder);

/* Put all loads of a body into the lists and note which part of them is its own; when all bodies are in and
 * the terms by slot are packed, finish. */
void body_terms_add(struct builder *builder, int b);
void body_terms_finish(struct builder *builder);

/* Find the switches that a motion may slide on, when the plan has all else (slides.c). */
void slides_find(struct fbd_model *model);

/* Find the pairs of friction whose slip is named, when the plan has them (slips.c). False when memory is out.
 */
bool slips_find(struct fbd_model *model);

/* Refuse gears on fixed axes whose pitch circles do not touch, wheels that do not touch their racks, and belts whose
 * tension nothing tells or two things do; put the tension of those between axes that keep their distance
 * (gear_check.c). */
void couplings_check(struct builder *builder);

/* Refuse contacts of points with points that do not move on one line (contact_points.c). */
void contacts_check(struct builder *builder);

/* Give the arrows of each diagram names that differ (arrow_names.c). False when memory is out. */
bool arrows_name(struct fbd_model *model);

/* As model_compile, with the labels left to the caller. */
struct fbd_model *model_compile_group(struct scene *scene, fbd_errors *errors);

/* Fill the plan from the bodies and loads of the model. False when memory is out. */
bool plan_build(struct builder *builder);

/* Decide for each load whether a potential energy exists, and say why. */
bool classify_loads(struct builder *builder);

/* What a track needs beyond its link (track.c): false when memory is out. */
bool tracks_set(struct builder *builder);
void track_set_body(const struct scene *scene, struct model_body *body);

#endif
