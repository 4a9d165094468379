/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The answer's own numbers and names in its derivations.
 */
#include <math.h>
#include <string.h>

#include "fbd_view.h"
#include "grade/lines.h"

static bool is_of_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/* True if the text has a number that may be rounded: of two digits or more, not part of a name. */
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

/* True if the sheet has a parameter of that value; another name with this value is then that parameter, and
 * not a rounded number. */
static bool is_of_the_sheet(const struct lines *lines, double value)
{
    const fbd_model *sheet = lines->grade->sheet;
    for (size_t i = 0; i < fbd_model_parameter_count(sheet); i++)
        if (fabs(fbd_model_parameter(sheet, i).value - value) <= 1e-12 * fabs(value)) return true;
    return false;
}

/* True if it names parameters that the sheet does not have; these are not varied with the others. *rounded:
 * one of them may be a rounded number. */
bool line_has_own_names(const struct lines *lines, const char *text, bool *rounded)
{
    const struct node *known = lines_value(lines->grade->key->root, "parameters");
    const struct node *own = lines_value(lines->root, "parameters");
    bool found = false;
    for (size_t i = 0; i < fbd_model_parameter_count(lines->model); i++) {
        const fbd_parameter parameter = fbd_model_parameter(lines->model, i);
        const char *name = parameter.name;
        if (node_find(known, name) || !names_it(text, name)) continue;
        const struct node *value = lines_value(own, name);
        found = true;
        *rounded = *rounded || (value && value->kind == node_scalar && line_has_numbers(value->text) &&
                                !is_of_the_sheet(lines, parameter.value));
    }
    return found;
}
