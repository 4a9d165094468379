/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plans of sweeps, and short sweeps. The input is a model file whose comments say what varies: `#vary
 * NAME=VALUES`, `#output LIST`, `#set NAME=VALUE`, `#zip`.
 */
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "claims.h"
#include "fbd.h"
#include "fbd_study.h"
#include "fuzz.h"

enum { most_texts = 8, most_rows = 3, most_steps = 150 };

struct plan {
    char *text; /* of the input, cut into lines */
    const char *vary[most_texts], *outputs[most_texts];
    fbd_setting settings[most_texts];
    fbd_sweep_plan plan;
};

/* What stands behind the word `#word ` at the start of a line, or NULL. */
static char *after(char *line, const char *word)
{
    size_t length = strlen(word);
    return strncmp(line, word, length) == 0 && line[length] == ' ' ? line + length + 1 : NULL;
}

static void take_line(struct plan *made, char *line)
{
    fbd_sweep_plan *plan = &made->plan;
    char *rest;
    if ((rest = after(line, "#vary")) && plan->vary_count < most_texts) made->vary[plan->vary_count++] = rest;
    if ((rest = after(line, "#output")) && plan->output_count < most_texts)
        made->outputs[plan->output_count++] = rest;
    char *equals = (rest = after(line, "#set")) ? strchr(rest, '=') : NULL;
    if (equals && plan->setting_count < most_texts) {
        *equals = '\0';
        made->settings[plan->setting_count++] = (fbd_setting){rest, equals + 1};
    }
    if (strcmp(line, "#zip") == 0) plan->zip = true;
}

static void read_plan(struct plan *plan, const char *text, size_t length)
{
    plan->plan =
        (fbd_sweep_plan){.vary = plan->vary, .outputs = plan->outputs, .settings = plan->settings, .seed = 1};
    plan->text = malloc(length + 1);
    memcpy(plan->text, text, length);
    plan->text[length] = '\0';
    for (char *line = plan->text, *end; line; line = end ? end + 1 : NULL) {
        end = strchr(line, '\n');
        if (end) *end = '\0';
        take_line(plan, line);
    }
}

static int write_rows(void *context, const char *rows, size_t length)
{
    text_add_bytes(context, rows, length);
    return 0;
}

static int stop(void *context)
{
    size_t *steps = context;
    return ++*steps > most_steps;
}

/* Fields of a line of CSV; commas between quotes do not count. */
static size_t fields(const char *line)
{
    size_t count = 1;
    bool quoted = false;
    for (; *line && (*line != '\n' || quoted); line++) {
        if (*line == '"') quoted = !quoted;
        count += *line == ',' && !quoted;
    }
    return count;
}

static void claim_rows(const fbd_sweep *sweep, const char *rows, size_t first, size_t count)
{
    const char *header = fbd_sweep_header(sweep);
    for (size_t i = 0; i < count; i++) {
        char *end;
        if (strtoul(rows, &end, 10) != first + i + 1 || *end != ',')
            fuzz_fail("row %zu is not that: %.200s", first + i + 1, rows);
        if (fields(rows) != fields(header)) fuzz_fail("other fields than %.300s: %.300s", header, rows);
        end = strchr(rows, '\n');
        if (!end) fuzz_fail("a row has no end: %.200s", rows);
        rows = end + 1;
    }
    if (*rows) fuzz_fail("more than %zu rows: %.200s", count, rows);
}

static void run(const fbd_sweep *sweep, bool nan_is_named)
{
    size_t steps = 0, runs = fbd_sweep_run_count(sweep), first = runs > most_rows ? runs / 2 : 0;
    struct text rows = {0};
    fbd_sweep_counts counts = {0};
    const fbd_sweep_work work = {.first = first,
                                 .end = runs - first > most_rows ? first + most_rows : runs,
                                 .jobs = 1,
                                 .write = write_rows,
                                 .write_context = &rows,
                                 .stop = stop,
                                 .stop_context = &steps};
    fbd_sweep_end end = fbd_sweep_run(sweep, &work, &counts);
    if (end == FBD_SWEEP_DONE && counts.written != work.end - work.first)
        fuzz_fail("%zu rows of %zu", counts.written, work.end - work.first);
    if (rows.data) {
        claim_plain("rows", rows.data);
        claim_rows(sweep, rows.data, first, counts.written);
        if (!nan_is_named && counts.failed == 0) claim_no_nan("rows", rows.data);
    }
    text_free(&rows);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *text = (const char *)data;
    struct plan plan = {0};
    fbd_errors *errors = fbd_errors_new();
    read_plan(&plan, text, size);
    fbd_sweep *sweep = NULL;
    if (plan.plan.vary_count > 0) sweep = fbd_sweep_parse(text, size, "fuzzed.yaml", &plan.plan, errors);
    claim_notes(errors);
    if (sweep) {
        claim_plain("the header", fbd_sweep_header(sweep));
        if (!fbd_sweep_key(sweep)[0]) fuzz_fail("a sweep without a key");
        run(sweep, names_nan(text, size));
    }
    fbd_sweep_free(sweep);
    fbd_errors_free(errors);
    free(plan.text);
    return 0;
}
