/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The keys of the file and of a body, which hold all other groups.
 */
#include "scene/language.h"

static const struct choice unit_systems[] = {
    {"SI", unit_si, "kg, m, s, N, rad"},
    {"US", unit_us, "slug, ft, s, lbf, rad"},
};

static const struct choice planes[] = {
    {"vertical", 0, "y is up, and gravity acts in it"},
    {"horizontal", 1, "seen from above: gravity presses bodies on it, and has no component in it"},
};

static const struct field scene_fields[] = {
    FIELD_NUMBER(offsetof(struct scene_keys, version), "fbd", a_number, 0,
                 "version of the model language: 1"),
    FIELD_IGNORED("$schema", "where an editor finds the schema; ignored"),
    FIELD_TEXT(offsetof(struct scene_keys, title), "title", "one line that names the model in reports"),
    FIELD_TEXT(offsetof(struct scene_keys, description), "description",
               "a description of the model; ignored"),
    FIELD_CHOICE(offsetof(struct scene_keys, units), "units", unit_systems,
                 "units of bare numbers and of all output"),
    FIELD_NODE(offsetof(struct scene_keys, gravity), "gravity", field_any, 0, NULL,
               "acceleration of gravity: a magnitude, straight down, or a pair [gx, gy]"),
    FIELD_CHOICE(offsetof(struct scene_keys, plane), "plane", planes,
                 "the plane of motion; default `vertical`"),
    FIELD_NUMBER(offsetof(struct scene_keys, datum), "datum", a_length, 0,
                 "height y at which the potential energy of gravity is zero"),
    FIELD_ENTRIES(offsetof(struct scene_keys, parameters), "parameters", field_map, 0, each_group,
                  &parameter_group, "named constants: name: quantity or expression of other parameters"),
    FIELD_ENTRIES(offsetof(struct scene_keys, inputs), "inputs", field_map, 0, each_group, &input_group,
                  "quantities that are set from outside during the motion, with their values at the start"),
    FIELD_ENTRIES(offsetof(struct scene_keys, tables), "tables", field_map, 0, each_group, &table_group,
                  "functions given by points or files of data, called as `name(t)` in expressions"),
    FIELD_ENTRIES(offsetof(struct scene_keys, own), "states", field_map, 0, each_group, &own_state_group,
                  "quantities with differential equations of first order; in expressions `states.name`"),
    FIELD_NODE(offsetof(struct scene_keys, ground), "ground", field_map, 0, &ground_group,
               "named points and lines that do not move"),
    FIELD_ENTRIES(offsetof(struct scene_keys, bodies), "bodies", field_map, required, each_group, &body_group,
                  "each body by its name: its shape and mass, its motion, the forces and moments on it"),
    FIELD_NODE(offsetof(struct scene_keys, simulate), "simulate", field_map, 0, &simulate_group,
               "duration and accuracy of the run, and its events"),
    FIELD_NODE(offsetof(struct scene_keys, output), "output", field_map, 0, &output_group,
               "what a run writes"),
    FIELD_KINDS(offsetof(struct scene_keys, couplings), "couplings", field_list, 0, each_kind,
                &coupling_kinds, "connections of two bodies, besides joints"),
    FIELD_ENTRIES(offsetof(struct scene_keys, contacts), "contacts", field_any, 0, each_group, &contact_group,
                  "contacts of bodies with each other or with the ground; `contacts: all` for all pairs"),
    FIELD_NODE(offsetof(struct scene_keys, grading), "grading", field_map, 0, &grading_group,
               "grading of answers by this file as the key"),
    FIELD_NODE(
        offsetof(struct scene_keys, symbols), "symbols", field_map, 0, NULL,
        "letters of forces in derivations: a name in a diagram, or a list of them, which is their sum"),
};

const struct group scene_group = {"the file", NULL, FIELDS(scene_fields), NULL, 0, "a model"};

/* ---- bodies */

static const struct field body_fields[] = {
    FIELD_TEXT(offsetof(struct body_keys, description), "description", "a description; ignored"),
    FIELD_ENTRIES(offsetof(struct body_keys, parts), "parts", field_map, 0, each_group, &part_group,
                  "name: a piece of the body"),
    FIELD_ENTRIES(offsetof(struct body_keys, points), "points", field_map, 0, each_pair, NULL,
                  "name: [x, y] in the body frame"),
    FIELD_KINDS(offsetof(struct body_keys, motion), "motion", field_any, required, one_value, &motion_kinds,
                "slide, pivot, track, particle, planar or weld"),
    FIELD_NODE(offsetof(struct body_keys, initial), "initial", field_map, 0, NULL,
               "coordinates and rates at t = 0; default 0"),
    FIELD_KINDS(offsetof(struct body_keys, forces), "forces", field_any, may_be_empty, each_kind,
                &force_kinds, "list of the forces that act on it"),
    FIELD_KINDS(offsetof(struct body_keys, moments), "moments", field_any, may_be_empty, each_kind,
                &moment_kinds, "list of the moments that act on it"),
    FIELD_ENTRIES(offsetof(struct body_keys, hand), "hand", field_any, may_be_empty, each_group, &hand_group,
                  "equations derived by hand, to be checked"),
    FIELD_NODE(offsetof(struct body_keys, symbols), "symbols", field_map, 0, NULL,
               "letters of forces in these, as at the top level"),
    FIELD_NODE(offsetof(struct body_keys, exact), "exact", field_map, 0, NULL,
               "the solution, where it is known: coordinates as expressions of t"),
};

const struct group body_group = {
    "a body",
    NULL,
    FIELDS(body_fields),
    &part_group,
    offsetof(struct body_keys, part),
    "a rigid body: its shape and mass, its motion, the forces and moments on it"};
