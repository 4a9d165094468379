/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Numbers with units, and symbols, as texts of a panel.
 */
#include <string.h>

#include "base/engineering.h"
#include "base/printed.h"
#include "draw/panel.h"

double round_up(double value)
{
    if (!(value > 0)) return 1;
    double power = pow(10, floor(log10(value)));
    static const double steps[] = {1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
    for (int i = 0; i < 10; i++)
        if (steps[i] * power >= value * (1 - 1e-9)) return steps[i] * power;
    return 10 * power;
}

static const int value_digits = 4, scale_digits = 6;

/* A finished text as one of the arena; "" when memory is out, which the arena records. */
static const char *keep(struct arena *arena, struct text *text)
{
    const char *kept = text->failed ? NULL : arena_printf(arena, "%s", text->data ? text->data : "");
    arena->failed |= !kept;
    text_free(text);
    return kept ? kept : "";
}

static const char *write_value(struct arena *arena, double value, const char *unit, int digits)
{
    struct text text = {0};
    const struct scaled_unit scaled = unit_for(unit, fabs(value), false);
    number_write(&text, value / scaled.size, digits);
    text_printf(&text, " %s", scaled.name);
    return keep(arena, &text);
}

const char *panel_number(struct arena *arena, double value)
{
    struct text text = {0};
    number_write(&text, value, value_digits);
    return keep(arena, &text);
}

const char *panel_text(struct arena *arena, double value, const char *unit)
{
    return write_value(arena, value, unit, value_digits);
}

const char *panel_value(struct panel *panel, double value, const char *unit)
{
    return panel_text(panel->arena, value, unit);
}

const char *panel_scale_value(struct panel *panel, double value, const char *unit)
{
    return write_value(panel->arena, value, unit, scale_digits);
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/* True for the first of the digits at the end of a word of letters: the index of "m1". */
static bool is_index(const char *symbol, const char *at)
{
    const size_t digits = strspn(at, "0123456789");
    const char *word = at, behind = at[digits];
    while (word > symbol && is_letter(word[-1])) word--;
    return digits > 0 && word < at && (word == symbol || word[-1] == ' ') &&
           (behind == '\0' || behind == ' ');
}

const char *panel_indexed(struct arena *arena, const char *symbol)
{
    struct text spaced = {0}, text = {0};
    for (const char *c = symbol; *c; c++) {
        if (is_index(symbol, c)) text_add(&spaced, "_");
        text_add_bytes(&spaced, c, 1);
    }
    text_symbol_indexed(&text, spaced.data ? spaced.data : "");
    text.failed |= spaced.failed;
    text_free(&spaced);
    return keep(arena, &text);
}
