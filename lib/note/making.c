/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdint.h>

#include "base/diag.h"
#include "base/printed.h"
#include "note/note.h"

/* ---- texts */

struct text *making_begin(struct making *making)
{
    making->text.length = 0;
    text_add(&making->text, "");
    if (making->text.data) making->text.data[0] = '\0';
    return &making->text;
}

const char *making_take(struct making *making)
{
    if (making->text.failed) making->document->arena.failed = true;
    const char *data = making->text.data ? making->text.data : "";
    return arena_text(&making->document->arena, data, making->text.length);
}

const char *making_value(struct making *making, double value, const char *unit, int digits)
{
    value_write(making_begin(making), value, unit, digits, making->options->degrees);
    return making_take(making);
}

const char *making_number(struct making *making, double value, int digits)
{
    number_write(making_begin(making), value, digits);
    return making_take(making);
}

const char *making_symbol(struct making *making, const char *name)
{
    text_symbol(making_begin(making), name);
    return making_take(making);
}

size_t making_arrows(struct making *making, fbd_state *state, size_t body, fbd_arrow **arrows)
{
    struct arena *arena = &making->document->arena;
    const size_t room = fbd_state_forces(state, body, NULL, 0);
    fbd_listed_force *forces = room < SIZE_MAX ? ARENA_ARRAY(arena, room + 1, fbd_listed_force) : NULL;
    *arrows = forces ? ARENA_ARRAY(arena, room + 1, fbd_arrow) : NULL;
    const size_t count = *arrows ? fbd_state_forces(state, body, forces, room) : SIZE_MAX;
    if (count == SIZE_MAX) {
        arena->failed = true;
        return 0;
    }
    for (size_t i = 0; i < count; i++) (*arrows)[i] = forces[i].arrow;
    return count;
}

/* ---- errors of other calls */

void making_end_list(struct making *making, fbd_errors *others)
{
    making->document->arena.failed |= !others || others->out_of_memory;
    fbd_errors_free(others);
}
