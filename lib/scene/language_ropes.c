/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/language.h"

static const struct choice wound_sides[] = {
    {"left", wound_left, "it leaves the disc at its left"},
    {"right", wound_right, "at its right"},
    {"top", wound_top, "at its top"},
    {"bottom", wound_bottom, "at its bottom"},
};

#define WOUND(member) offsetof(struct wound_keys, member)

static const struct field wound_fields[] = {
    FIELD_NODE(WOUND(on), "on", field_scalar, required, NULL, "the first or the last place of `through`"),
    {"side", field_choice, a_number, required, WOUND(side), FIELDS(wound_sides), NULL, one_value, NULL,
     "where the rope leaves the disc at the start"},
    FIELD_NUMBER(WOUND(radius), "radius", a_length, positive, "of the disc; default that of its shape"),
    FIELD_NUMBER(WOUND(length), "length", a_length, positive,
                 "the length wound on it at the start; the run ends when it is unwound; default: enough"),
};
const struct group wound_group = {"`wound`", NULL, FIELDS(wound_fields),
                                  NULL,      0,    "a rope that is wound on a disc"};

#define AROUND(member) offsetof(struct around_keys, member)

static const struct field around_fields[] = {
    FIELD_NODE(AROUND(on), "on", field_scalar, required, NULL, "the second of three places of `through`"),
    FIELD_NUMBER(AROUND(radius), "radius", a_length, positive, "of the drum; default that of its shape"),
    FIELD_NUMBER(AROUND(turns), "turns", a_number, not_negative, "additional whole turns; default 0"),
    FIELD_VALUE(AROUND(mu_s), "static", a_number, not_negative,
                "coefficient of static friction; default that of kinetic friction"),
    FIELD_VALUE(AROUND(mu_k), "kinetic", a_number, not_negative,
                "coefficient of kinetic friction; default that of static friction"),
};
const struct group around_group = {"`around`", NULL, FIELDS(around_fields),
                                   NULL,       0,    "a rope with friction round a drum"};
