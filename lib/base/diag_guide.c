/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The sections of docs/guide/ten-things.md, "Ten things that go wrong", by the ids of the messages that they explain.
 */
#include "fbd.h"

#include <stddef.h>
#include <string.h>

#define TEN_THINGS "guide/ten-things.md, "

static const struct {
    const char *id, *section;
} sections[] = {
    {"unquoted-unit", TEN_THINGS "1. A unit in brackets inside braces"},
    {"unit-needs-brackets", TEN_THINGS "2. Degrees in an expression"},
    {"time-as-unit", TEN_THINGS "3. The time, or the tonne"},
    {"bare-angle", TEN_THINGS "4. Thirty radians"},
    {"needs-normal", TEN_THINGS "5. Friction without a normal force"},
    {"across-slide", TEN_THINGS "6. The frame of a slide"},
    {"unused-line", TEN_THINGS "7. What no listed force holds"},
    {"through-axis", TEN_THINGS "8. A pivot at the centre"},
    {"no-reaction", TEN_THINGS "9. A motor without reaction"},
    {"unknown-key", TEN_THINGS "10. A key of another name"},
};

const char *fbd_errors_guide(const char *id)
{
    for (size_t i = 0; id && i < sizeof sections / sizeof *sections; i++)
        if (strcmp(sections[i].id, id) == 0) return sections[i].section;
    return NULL;
}
