/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/slip_law.h"

#include "scene/values.h"

bool slip_law_read(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                   unsigned flags, enum slip_name slip, const struct scope *scope, struct value *value)
{
    struct names *names = scope->context;
    names->slip = slip;
    names->slip_angular = quantity == a_moment;
    bool fine = value_formula(reader, node, what, quantity, flags, scope, value);
    names->slip = slip_unknown;
    return fine;
}

bool slip_law_share(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                    enum slip_name slip, const struct scope *scope, const struct value *given,
                    struct value *value)
{
    const struct names *names = scope->context;
    *value = *given;
    if (!given->expr || !names->slip_named) return given->expr != NULL;
    return slip_law_read(reader, node, what, quantity, not_negative, slip, scope, value);
}
