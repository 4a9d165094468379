/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/numbers.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Grow an array of `count` elements of `size` bytes and capacity `*room` for one more. NULL when memory is
 * out; the array is unchanged then. */
static void *grown(void *array, size_t count, size_t size, size_t *room)
{
    if (count < *room) return array;
    size_t more = *room < 64 ? 64 : *room + *room / 2;
    if (more > SIZE_MAX / size) return NULL;
    void *larger = realloc(array, more * size);
    if (larger) *room = more;
    return larger;
}

/* Before numbers_begin each head has its unit, and all names are in one text. */
void numbers_head(struct numbers *numbers, const char *name, const char *unit)
{
    fbd_column *heads = grown(numbers->heads, numbers->columns, sizeof *heads, &numbers->head_room);
    text_add_bytes(&numbers->names, name, strlen(name) + 1);
    numbers->failed |= !heads || numbers->names.failed;
    if (!heads) return;
    numbers->heads = heads;
    numbers->heads[numbers->columns++].unit = unit;
}

bool numbers_begin(struct numbers *numbers)
{
    if (numbers->failed) return false;
    const char *name = numbers->names.data;
    for (size_t i = 0; i < numbers->columns; i++) {
        numbers->heads[i].name = name;
        name += strlen(name) + 1;
    }
    return true;
}

void numbers_add(struct numbers *numbers, double value)
{
    double *values = grown(numbers->values, numbers->filled, sizeof *values, &numbers->room);
    numbers->failed |= !values;
    if (!values) return;
    numbers->values = values;
    numbers->values[numbers->filled++] = value;
}

bool numbers_end_row(struct numbers *numbers)
{
    if (!numbers->failed) numbers->whole = numbers->filled;
    return !numbers->failed;
}

void numbers_drop_row(struct numbers *numbers)
{
    numbers->filled = numbers->whole;
}

void numbers_free(struct numbers *numbers)
{
    text_free(&numbers->names);
    free(numbers->heads);
    free(numbers->values);
}
