/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A coupling that does nothing changes nothing that is shown: every model of the gallery whose bodies move by
 * themselves gets a spring of no stiffness from each body to the ground, which makes them links of a tree. The
 * equations keep their names, terms, remarks and values, the columns of the ledger theirs, the accelerations all but the
 * last bits.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/modes.h"
#include "fbd_export.h"
#include "fbd_view.h"
#include "random_numbers.h"

static size_t compared, states_compared;

/* Of the numbers at the end of a run: both are integrated to their tolerance (1e-9 at most in the gallery) in
 * steps of their own, and what a pendulum or a hard spring makes of that in a hundred periods. */
static const double run_tolerance = 1e-5;

/* What files say by themselves: couplings, bodies on bodies, data beside the file. */
static bool is_single(const fbd_model *model)
{
    static const char *const others[] = {"\ncouplings:", "\ncontacts:", "\nground:", " on:",
                                         "track:",       "file:",       "toward:",   "prescribed"};
    size_t length;
    const char *source = fbd_model_source(model, &length); /* has no end of its own */
    char *text = calloc(length + 1, 1);
    assert_non_null(text);
    memcpy(text, source, length);
    bool single = true;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strstr(text, others[i])) single = false;
    free(text);
    return single;
}

static struct trial with_idle_springs(const struct trial *alone)
{
    size_t length, bodies = fbd_model_body_count(alone->model);
    const char *source = fbd_model_source(alone->model, &length);
    size_t room = length + 100 + 200 * bodies, used = length;
    char *text = malloc(room);
    assert_non_null(text);
    memcpy(text, source, length);
    used +=
        (size_t)snprintf(text + used, room - used, "\nground: {points: {nowhere: [17, 19]}}\ncouplings:\n");
    for (size_t b = 0; b < bodies; b++)
        used += (size_t)snprintf(
            text + used, room - used,
            "  - spring: {name: idle%zu, between: [%s.G, ground.nowhere], stiffness: 0, free_length: 0}\n", b,
            fbd_model_body_name(alone->model, b));
    struct trial trial = trial_parse(text);
    free(text);
    return trial;
}

static size_t line_length(const char *line)
{
    return strcspn(line, "\n");
}

/* Word by word; numbers to some digits of those that are shown, zero being what is small beside one. */
static bool same_line(const char *a, const char *b)
{
    for (;;) {
        a += strspn(a, " ");
        b += strspn(b, " ");
        size_t m = strcspn(a, " \n"), n = strcspn(b, " \n");
        if (m == 0 || n == 0) return m == n;
        char *end_a, *end_b;
        double x = strtod(a, &end_a), y = strtod(b, &end_b);
        if (end_a == a + m && end_b == b + n) {
            if (fabs(x - y) > 1e-8 * (fabs(x) + fabs(y)) + 1e-12) return false;
        } else if (m != n || strncmp(a, b, m) != 0) {
            return false;
        }
        a += m;
        b += n;
    }
}

static void compare_equations(struct checks *checks, const char *path, struct trial *alone,
                              struct trial *joined)
{
    char *ours = fbd_equations_write(alone->state, NULL, NULL),
         *theirs = fbd_equations_write(joined->state, NULL, NULL);
    assert_non_null(ours);
    assert_non_null(theirs);
    const char *b = theirs, *symbols = strstr(ours, "\nCut free");
    /* The springs have letters too, with which others are numbered: symbols are compared elsewhere. */
    for (const char *a = ours; *a && (!symbols || a <= symbols); a += line_length(a) + 1) {
        while (strncmp(b, "    idle", 8) == 0) b += line_length(b) + 1;
        if (!*b || !same_line(a, b)) {
            fprintf(stderr, "# %s: alone\n%.*s\n# and with a spring of no stiffness\n%.*s\n", path,
                    (int)line_length(a), a, (int)line_length(b), b);
            checks->failed++;
            break;
        }
        b += line_length(b) + 1;
    }
    free(ours);
    free(theirs);
}

static size_t find_column(const fbd_table *table, const fbd_column *head)
{
    for (size_t c = 0; c < table->columns; c++)
        if (strcmp(table->heads[c].name, head->name) == 0 && strcmp(table->heads[c].unit, head->unit) == 0)
            return c;
    return table->columns;
}

/* The largest number of a column, or of its unit: a work that comes to nothing has the size of the others. */
static double size_of(const fbd_table *table, size_t column)
{
    double size = 0;
    for (size_t c = 0; c < table->columns; c++)
        for (size_t r = 0; r < table->rows && strcmp(table->heads[c].unit, table->heads[column].unit) == 0;
             r++)
            size = fmax(size, fabs(table->values[r * table->columns + c]));
    return size;
}

static void compare_columns(struct checks *checks, const char *path, const fbd_table *ours,
                            const fbd_table *theirs)
{
    char what[400];
    for (size_t c = 0; c < ours->columns; c++) {
        size_t d = find_column(theirs, &ours->heads[c]);
        snprintf(what, sizeof what, "%s has %s", path, ours->heads[c].name);
        if (!check_that(checks, what, d < theirs->columns)) continue;
        size_t end = ours->columns * (ours->rows - 1), other_end = theirs->columns * (theirs->rows - 1);
        double size = size_of(ours, c);
        snprintf(what, sizeof what, "%s: %s at the start", path, ours->heads[c].name);
        check_close(checks, what, theirs->values[d], ours->values[c], 1e-9 * size);
        snprintf(what, sizeof what, "%s: %s at the end", path, ours->heads[c].name);
        check_close(checks, what, theirs->values[other_end + d], ours->values[end + c], run_tolerance * size);
    }
    for (size_t d = 0; d < theirs->columns; d++) {
        snprintf(what, sizeof what, "%s: %s comes with the spring", path, theirs->heads[d].name);
        check_that(checks, what,
                   strstr(theirs->heads[d].name, "idle") ||
                       find_column(ours, &theirs->heads[d]) < ours->columns);
    }
}

static fbd_result *recorded(struct trial *trial)
{
    const fbd_recording recording = {.ledger = true, .table = true, .every = 1e30};
    trial_start(trial, NULL);
    fbd_result *result = fbd_simulation_run(trial->simulation, &recording);
    assert_non_null(result);
    return result;
}

/* The equations of a body by itself and of a link are sums of the same terms in another order: at random states they
 * give the same accelerations but for the roundings of the largest. */
static void compare_accelerations(struct checks *checks, const char *path, const fbd_model *ours,
                                  const fbd_model *theirs)
{
    enum { states = 20 };
    const double roundings = 32 * DBL_EPSILON;
    struct random_numbers numbers = {11};
    struct fbd_state *one = state_new(ours), *other = state_new(theirs);
    assert_true(one && other);
    size_t n = (size_t)ours->plan.n;
    for (int k = 0; k < states; k++) {
        double size = 0;
        one->t = other->t = random_between(&numbers, 0, 3);
        for (size_t i = 0; i < 2 * n; i++) other->y[i] = one->y[i] = random_between(&numbers, 0.2, 1.5);
        if (!modes_settle(one, NULL) || !modes_settle(other, NULL)) continue;
        for (size_t i = 0; i < n; i++) size = fmax(size, fabs(one->a[i]));
        for (size_t i = 0; i < n; i++) check_close(checks, path, other->a[i], one->a[i], roundings * size);
        states_compared++;
    }
    state_free(one);
    state_free(other);
}

static void compare(struct checks *checks, const char *path)
{
    struct trial alone = trial_open(path, NULL);
    if (is_single(alone.model)) {
        struct trial joined = with_idle_springs(&alone);
        compare_equations(checks, path, &alone, &joined);
        compare_accelerations(checks, path, alone.model, joined.model);
        alone.result = recorded(&alone);
        joined.result = recorded(&joined);
        fbd_table ours = fbd_result_table(alone.result), theirs = fbd_result_table(joined.result);
        compare_columns(checks, path, &ours, &theirs);
        trial_close(&joined);
        compared++;
    }
    trial_close(&alone);
}

static void a_spring_of_no_stiffness_changes_nothing_that_is_shown(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    each_model(&checks, compare);
    fprintf(stderr, "# %zu models, %zu states\n", compared, states_compared);
    check_that(&checks, "there are some", compared > 30 && states_compared > 15 * compared);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_spring_of_no_stiffness_changes_nothing_that_is_shown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
