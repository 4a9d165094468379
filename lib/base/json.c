/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/json.h"

#include <math.h>

void json_key(struct text *text, const char *name)
{
    text_json_string(text, name);
    text_add(text, ":");
}

void json_number(struct text *text, double value)
{
    if (isfinite(value))
        text_exact(text, value);
    else
        text_add(text, "null");
}

void json_vector(struct text *text, struct vec v)
{
    text_add(text, "[");
    json_number(text, v.x);
    text_add(text, ",");
    json_number(text, v.y);
    text_add(text, "]");
}

void json_text_member(struct text *text, const char *name, const char *value)
{
    json_key(text, name);
    text_json_string(text, value);
    text_add(text, ",");
}

void json_number_member(struct text *text, const char *name, double value)
{
    json_key(text, name);
    json_number(text, value);
    text_add(text, ",");
}

void json_vector_member(struct text *text, const char *name, struct vec v)
{
    json_key(text, name);
    json_vector(text, v);
    text_add(text, ",");
}

void json_comma(struct text *text, size_t index)
{
    if (index) text_add(text, ",");
}

void json_columns_member(struct text *text, const char *name, int first, int count)
{
    json_key(text, name);
    text_add(text, "[");
    for (int i = 0; i < count; i++) text_printf(text, i ? ",%d" : "%d", first + i);
    text_add(text, "],");
}
