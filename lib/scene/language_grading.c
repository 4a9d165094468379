/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/language.h"

static const struct field points_fields[] = {
    FIELD_NUMBER(offsetof(fbd_grading, points.force), "force", a_number, not_negative,
                 "of each force and moment of the sheet; default 1"),
    FIELD_NUMBER(
        offsetof(fbd_grading, points.inertia), "inertia", a_number, not_negative,
        "of mass, centre of mass and moment of inertia of a body, where they are required; default 0"),
    FIELD_NUMBER(offsetof(fbd_grading, points.derivation), "derivation", a_number, not_negative,
                 "of each line of `hand`; default 2"),
    FIELD_NUMBER(offsetof(fbd_grading, points.superfluous), "superfluous", a_number, not_negative,
                 "deducted for each force that does not exist, and for a wrong inertia; default 1"),
};

static const struct group points_group = {"`points`", NULL, FIELDS(points_fields),
                                          NULL,       0,    "what the parts of an answer are worth"};

static const struct field canvas_fields[] = {
    FIELD_VECTOR(
        offsetof(fbd_canvas, origin), "origin", a_number,
        "where the origin of the scene lies, in units of the drawing (pixels, from the upper left corner)"),
    FIELD_NUMBER(offsetof(fbd_canvas, unit), "unit", a_length, required | positive,
                 "the length that one unit (pixel) of the drawing stands for"),
    FIELD_NUMBER(offsetof(fbd_canvas, angle), "angle", an_angle, positive,
                 "tolerance of a drawn direction; default 5 deg"),
    FIELD_NUMBER(offsetof(fbd_canvas, snap), "snap", a_number, positive,
                 "tolerance of a drawn line of action, in units of the drawing; default 10 pixels of "
                 "`pl-drawing`, and 0.2 of Meclib"),
};

static const struct group canvas_group = {
    "`canvas`", NULL, FIELDS(canvas_fields), NULL, 0, "where drawings (JSON) of answers lie in the scene"};

static const struct field grading_fields[] = {
    FIELD_ENTRIES(
        offsetof(struct grading_keys, draw), "draw", field_map, 0, each_pair, NULL,
        "parameters with an individual value for each student: name: [low, high], both with the same unit"),
    FIELD_NUMBER(offsetof(struct grading_keys, digits), "digits", a_number, positive,
                 "decimal digits of the individual values; default 2"),
    FIELD_NUMBER(offsetof(struct grading_keys, grading.tolerance), "tolerance", a_number, positive,
                 "relative tolerance of numbers; default 0.01"),
    FIELD_NUMBER(offsetof(struct grading_keys, grading.partial), "partial", a_number, not_negative,
                 "the share of the points for a force that is drawn but not right; default 0.5"),
    FIELD_NUMBER(offsetof(struct grading_keys, grading.pass), "pass", a_number, not_negative,
                 "the share of all points that is needed to pass; default 1"),
    FIELD_NODE(offsetof(struct grading_keys, points), "points", field_map, 0, &points_group,
               "what the parts of an answer are worth"),
    FIELD_NODE(offsetof(struct grading_keys, canvas), "canvas", field_map, 0, &canvas_group,
               "where drawings (JSON) of answers lie in the scene"),
    FIELD_ENTRIES(offsetof(struct grading_keys, reactions), "reactions", field_any, 0, each_word, NULL,
                  "which reactions an answer has to draw: `all`, `none`, or a list of names; default all"),
};

const struct group grading_group = {"`grading`", NULL, FIELDS(grading_fields),
                                    NULL,        0,    "grading of answers to this sheet"};

const struct group *const grading_points_group = &points_group, *const grading_canvas_group = &canvas_group;
