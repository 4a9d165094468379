/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Notes on the texts of tests, whose moments on bodies that move on others do come from outside.
 */
#ifndef FBD_TESTS_NOTES_H
#define FBD_TESTS_NOTES_H

#include <string.h>

#include "fbd.h"

/* The number of notes beside `no-reaction`. */
static inline size_t count_other_notes(fbd_errors *errors)
{
    size_t count = 0;
    for (size_t i = 0; i < fbd_errors_count(errors); i++)
        count += strcmp(fbd_errors_get(errors, i).id, "no-reaction") != 0;
    return count;
}

#endif
