/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Numbers and names of an answer's own in its derivations.
 */
#include <math.h>
#include <string.h>

#include "grade/lines.h"

static bool is_of_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* A number that was rounded, perhaps: one of two digits or more, that is no part of a name. */
bool line_has_numbers(const char *text)
{
    size_t digits = 0;
    bool name = false;
    for (; *text; text++) {
        bool digit = *text >= '0' && *text <= '9';
        name = is_of_name(*text) && (name || !digit);
        digits = digit && !name ? digits + 1 : *text == '.' ? digits : 0;
        if (digits >= 2) return true;
    }
    return false;
}

static bool names_it(const char *text, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = strstr(text, name); at; at = strstr(at + 1, name))
        if ((at == text || !is_of_name(at[-1])) && !is_of_name(at[length])) return true;
    return false;
}

/* Has the sheet a parameter of that value? Then one of another name is that, and not a number that was rounded. */
static bool is_of_the_sheet(const struct lines *lines, double value)
{
    const struct scene *scene = lines->grade->sheet->scene;
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (fabs(scene->parameters[i].value - value) <= 1e-12 * fabs(value)) return true;
    return false;
}

/* Does it name parameters that the sheet does not have? Those follow from others, and are not varied with them.
 * *rounded: one of them may be a number that was rounded. */
bool line_has_own_names(const struct lines *lines, const char *text, bool *rounded)
{
    const struct scene *scene = lines->model->scene;
    const struct node *known = lines_value(lines->grade->key->document.root, "parameters");
    const struct node *own = lines_value(lines->root, "parameters");
    bool found = false;
    for (size_t i = 0; i < scene->parameter_count; i++) {
        const char *name = scene->parameters[i].name;
        if (node_find(known, name) || !names_it(text, name)) continue;
        const struct node *value = lines_value(own, name);
        found = true;
        *rounded = *rounded || (value && value->kind == node_scalar && line_has_numbers(value->text) &&
                                !is_of_the_sheet(lines, scene->parameters[i].value));
    }
    return found;
}
