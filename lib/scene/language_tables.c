/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/table.h"
#include "scene/language.h"

static const struct choice interpolations[] = {
    {"linear", table_linear, "straight lines between the points; the default"},
    {"step", table_step, "each value holds until the next"},
    {"cubic", table_cubic, "the natural cubic spline: smooth up to the curvature"},
    {"akima", table_akima, "Akima's spline: smooth, without overshoot beside steps"},
    {"steffen", table_steffen, "Steffen's spline: smooth, and monotonic between points"},
};

static const struct choice beyonds[] = {
    {"hold", table_hold, "the first and the last value continue; the default"},
    {"zero", table_zero, "nothing"},
    {"repeat", table_repeat, "periodic: the last point is the first of the next period"},
    {"error", table_error, "the run ends there with a message"},
};

static const struct field table_fields[] = {
    FIELD_TEXT(offsetof(struct table_keys, file), "file",
               "a text file with columns of numbers; its path is relative to the model file"),
    FIELD_ENTRIES(offsetof(struct table_keys, points), "points", field_list, 0, each_pair, NULL,
                  "[[x, y], ...] in place of a file"),
    FIELD_TEXT(offsetof(struct table_keys, x), "x",
               "heading of the column of arguments, as `t [s]`, or its number"),
    FIELD_TEXT(offsetof(struct table_keys, y), "y",
               "heading of the column of values, as `force [N]`, or its number"),
    FIELD_CHOICE(offsetof(struct table_keys, interpolation), "interpolation", interpolations,
                 "between the points"),
    FIELD_CHOICE(offsetof(struct table_keys, beyond), "beyond", beyonds,
                 "before the first point and behind the last"),
};

const struct group table_group = {"a table", "file", FIELDS(table_fields),
                                  NULL,      0,      "a function given by points"};
