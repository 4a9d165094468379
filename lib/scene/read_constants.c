/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Entries of `parameters` and `inputs`: description and range.
 *
 * Inputs come from outside during a run. Between two changes an input is constant, so it is read like a
 * parameter (read_parameters.c). But geometry, inertia and initial values cannot name it, nor can a
 * prescribed motion, which would jump with it.
 */
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

const struct node *constant_read(struct reader *reader, const struct pair *pair, struct parameter *parameter,
                                 const struct node **range)
{
    const struct group *group = parameter->input ? &input_group : &parameter_group;
    struct constant_keys keys = {0};
    if (!fields_read(reader, group, pair->value, pair->at, &reader->constants, &keys)) return NULL;
    if (keys.description) parameter->description = keys.description;
    *range = keys.range;
    return keys.value;
}

static bool refuse(struct reader *reader, struct pos at, const char *name, const char *hint)
{
    diag_add(reader->errors, FBD_ERROR, "bad-range", at, hint, "this is no range for `%.80s`", name);
    return false;
}

static bool read_end(struct reader *reader, const struct node *node, const struct parameter *parameter,
                     double *end)
{
    struct value value;
    if (!value_formula(reader, node, "range", a_parameter, 0, &reader->constants, &value)) return false;
    *end = expr_value(value.expr);
    bool bare = parameter->bare || expr_is_bare(value.expr);
    return bare || dim_equal(expr_dim(value.expr), parameter->dim) ||
           refuse(reader, node->at, parameter->name, "give it the unit of the value");
}

bool constant_range(struct reader *reader, const struct node *range, bool value_of_file,
                    struct parameter *parameter)
{
    if (range->count != 2)
        return refuse(reader, range->at, parameter->name, "write [low, high], as [0 deg, 60 deg]");
    double low, high;
    bool fine = read_end(reader, range->items[0], parameter, &low);
    fine = read_end(reader, range->items[1], parameter, &high) && fine;
    if (!fine) return false;
    if (!(low < high))
        return refuse(reader, range->at, parameter->name, "write the lower end first, then a higher one");
    if (value_of_file && (parameter->value < low || parameter->value > high))
        return refuse(reader, range->at, parameter->name, "its value is not within it");
    parameter->low = low;
    parameter->high = high;
    return true;
}
