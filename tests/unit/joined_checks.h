/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Holding trials against the reference numbers of joined bodies. Include after <cmocka.h>.
 */
#ifndef FBD_TESTS_JOINED_CHECKS_H
#define FBD_TESTS_JOINED_CHECKS_H

#include "gallery.h"
#include "joined_reference.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static inline bool starts(const char *text, const char *start)
{
    return strncmp(text, start, strlen(start)) == 0;
}

static inline void check_row(struct checks *checks, const struct joined_reference *row, double got)
{
    double tolerance = fmax(row->relative * fabs(row->value), row->absolute);
    check_close(checks, row->name, got, row->value, tolerance);
}

static inline const struct joined_reference *row_of(const char *name)
{
    for (int i = 0; i < joined_reference_count; i++)
        if (strcmp(joined_references[i].name, name) == 0) return &joined_references[i];
    fail_msg("no reference number %s", name);
    return NULL;
}

static inline void check_named(struct checks *checks, const char *name, double got)
{
    check_row(checks, row_of(name), got);
}

/* Run through the rows that start with `prefix` and have a time, and give each the value of `quantity`, whose
 * name is what stands between the prefix and the last underscore. Returns their number. */
static inline int follow(struct checks *checks, struct trial *trial, const char *prefix,
                         double (*quantity)(struct trial *trial, const char *name))
{
    int count = 0;
    for (int i = 0; i < joined_reference_count; i++) {
        const struct joined_reference *row = &joined_references[i];
        if (!starts(row->name, prefix) || starts(row->name + strlen(prefix), "b_")) continue;
        char name[32];
        snprintf(name, sizeof name, "%s", row->name + strlen(prefix));
        char *end = strrchr(name, '_');
        if (!end || isnan(row->t) || strtod(end + 1, NULL) != row->t) continue;
        *end = '\0';
        double now = trial_get(trial, "t");
        if (row->t < now) continue; /* of the start, held by the test itself */
        if (row->t > now) trial_to(trial, row->t);
        check_row(checks, row, quantity(trial, name));
        count++;
    }
    return count;
}

/* A component of the arrow `name` on body `index`. */
static inline fbd_arrow arrow_on(struct trial *trial, size_t index, const char *name)
{
    fbd_arrow arrows[16];
    size_t count = fbd_diagram(trial->state, index, arrows, 16);
    for (size_t i = 0; i < count && i < 16; i++)
        if (strcmp(arrows[i].name, name) == 0) return arrows[i];
    fail_msg("no arrow %s", name);
    return (fbd_arrow){0};
}

/* Run on to where it ends, and take the state there. */
static inline double to_its_end(struct trial *trial)
{
    double from, to;
    while ((trial->outcome = fbd_simulation_advance(trial->simulation)) == FBD_GOING) {
    }
    fbd_simulation_interval(trial->simulation, &from, &to);
    assert_true(fbd_simulation_state(trial->simulation, to, trial->state));
    return to;
}

#endif
