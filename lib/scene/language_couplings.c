/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/language.h"

#define COUPLING(member) offsetof(struct coupling_keys, member)

/* What every coupling has. */
static const struct field common_fields[] = {
    FIELD_NAME(COUPLING(name), "name", "its name in all output; default its kind"),
    FIELD_NODE(COUPLING(between), "between", field_list, required, NULL,
               "its two ends: body.point, ground.point or, for the centre of mass, a body"),
};
static const struct group common = {"a coupling", NULL, FIELDS(common_fields), NULL, 0, "between two ends"};

#define COUPLING_GROUP(title, table, doc)                                                                    \
    {                                                                                                        \
        title, NULL, FIELDS(table), &common, 0, doc                                                          \
    }

static const struct field spring_fields[] = {
    FIELD_NUMBER(COUPLING(stiffness), "stiffness", a_stiffness, required | not_negative, "force per length"),
    FIELD_NUMBER(COUPLING(free_length), "free_length", a_length, not_negative,
                 "length without force; default 0"),
};
static const struct group spring_group =
    COUPLING_GROUP("a spring", spring_fields, "a linear spring between two points");

static const struct field damper_fields[] = {
    FIELD_NUMBER(COUPLING(coefficient), "coefficient", a_damping, required | not_negative,
                 "force per velocity"),
};
static const struct group damper_group =
    COUPLING_GROUP("a damper", damper_fields, "a linear damper between two points");

static const struct kind kinds[] = {
    {"spring", load_spring, &spring_group, ~0u, NULL},
    {"damper", load_damper, &damper_group, ~0u, NULL},
};

const struct kinds coupling_kinds = {"coupling", FIELDS(kinds)};
