/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Inputs: what comes from outside while a motion goes on. Between two moments at which it may change an input is
 * a constant, so it is read as a parameter is (read_parameters.c); but what a body is and where it starts cannot
 * name it, and no more can a prescribed motion, which would jump with it.
 */
#include "scene/fields.h"
#include "scene/reader.h"

const struct node *input_read(struct reader *reader, const struct pair *pair, struct parameter *input)
{
    struct input_keys keys = {0};
    if (!fields_read(reader, &input_group, pair->value, pair->at, &reader->constants, &keys)) return NULL;
    if (keys.description) input->description = keys.description;
    return keys.value;
}
