/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What runs between the library and Python without asking Python each time: callbacks of the library that are
 * called in every step, and rows of sweeps, which come from any thread.
 */
#include <fbd.h>
#include <fbd_exchange.h>
#include <fbd_export.h>
#include <fbd_find.h>
#include <fbd_grade.h>
#include <fbd_linear.h>
#include <fbd_section.h>
#include <fbd_study.h>
#include <fbd_view.h>

#include <gsl/gsl_errno.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- runs: signals and progress are looked at twenty times a second */

static int fbd_ask(void *handle, const fbd_progress *progress); /* in Python; non-zero ends the run */

static int fbd_input(void *context, double t, const double *y, double *value); /* in Python */

/* An fbd_force_callback. */
static int glue_input(void *context, double t, const double *y, double *value)
{
    return fbd_input(context, t, y, value);
}

typedef struct glue_watch {
    void *handle; /* of the object in Python that is asked */
    bool stopped;
    double due; /* when it is asked next, by the clock [s] */
} glue_watch;

static const double between = 0.05;

static double seconds_now(void)
{
    struct timespec now;
    return clock_gettime(CLOCK_MONOTONIC, &now) == 0 ? (double)now.tv_sec + 1e-9 * (double)now.tv_nsec : 0;
}

/* An fbd_watch. What has been stopped stays so, also where a search for an accuracy goes on asking. */
static int glue_watch_run(void *context, const fbd_progress *progress)
{
    glue_watch *watch = context;
    double now = seconds_now();
    if (watch->stopped || now < watch->due) return watch->stopped;
    if (watch->due > 0) watch->stopped = fbd_ask(watch->handle, progress) != 0;
    watch->due = seconds_now() + between;
    return watch->stopped;
}

/* Advance until t lies in the last step. */
static fbd_outcome glue_seek(fbd_simulation *simulation, double t, glue_watch *watch)
{
    fbd_progress progress = {.until = t};
    fbd_outcome outcome = FBD_GOING;
    double from;
    fbd_simulation_interval(simulation, &from, &progress.t);
    while (progress.t < t && outcome == FBD_GOING && glue_watch_run(watch, &progress) == 0) {
        outcome = fbd_simulation_advance(simulation);
        fbd_simulation_interval(simulation, &from, &progress.t);
        progress.steps++;
    }
    return outcome;
}

/* ---- sweeps */

typedef struct glue_sheet {
    char *data; /* rows as they come */
    size_t length, room;
    bool lost; /* memory ran out */
    atomic_bool stopped;
    atomic_size_t written, failed; /* read while others write */
} glue_sheet;

/* An fbd_write. */
static int glue_keep(void *context, const char *text, size_t length)
{
    glue_sheet *sheet = context;
    if (sheet->length + length > sheet->room) {
        size_t room = 2 * (sheet->length + length);
        char *data = realloc(sheet->data, room);
        sheet->lost = !data;
        if (!data) return -1;
        sheet->data = data;
        sheet->room = room;
    }
    memcpy(sheet->data + sheet->length, text, length);
    sheet->length += length;
    return 0;
}

/* An fbd_watch. */
static int glue_count(void *context, const fbd_progress *progress)
{
    glue_sheet *sheet = context;
    sheet->written = progress->written;
    sheet->failed = progress->failed;
    return 0;
}

/* An fbd_stop. */
static int glue_is_stopped(void *context)
{
    glue_sheet *sheet = context;
    return atomic_load_explicit(&sheet->stopped, memory_order_relaxed);
}

static void glue_stop(glue_sheet *sheet)
{
    atomic_store(&sheet->stopped, true);
}

static void glue_free(glue_sheet *sheet)
{
    free(sheet->data);
    sheet->data = NULL;
}

/* ---- once */

/* GSL's handler would end the interpreter; the library looks at every status itself. */
static void glue_quiet(void)
{
    gsl_set_error_handler_off();
}
