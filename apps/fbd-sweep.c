/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd-sweep: run a model with many values of its parameters and write one table.
 */
#include <errno.h>
#include <gsl/gsl_errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "fbd_study.h"
#include "partial_file.h"
#include "ranks.h"
#include "standard_streams.h"
#include "sweep_options.h"
#include "sweep_progress.h"

/* ---- signals: running computations are abandoned, finished rows are kept */

static atomic_int caught; /* the only object that the handler writes */

static void catch_signal(int number)
{
    atomic_store(&caught, number);
}

static void watch_signals(void)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    /* A second signal ends the process at once. */
    struct sigaction action = {.sa_handler = catch_signal, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) {
        struct sigaction before;
        bool ignored = sigaction(signals[i], NULL, &before) == 0 && before.sa_handler == SIG_IGN;
        if (!ignored) sigaction(signals[i], &action, NULL); /* signals ignored by nohup stay ignored */
    }
}

static int stops(void *context)
{
    (void)context;
    return atomic_load_explicit(&caught, memory_order_relaxed) != 0;
}

/* ---- the table */

static int no_memory(void)
{
    complain("fbd-sweep: out of memory");
    return exit_failed;
}

static void summarise(const struct sweep_options *options, size_t runs, size_t rows, size_t failed)
{
    if (rows < runs)
        complain("fbd-sweep: ended by a signal after %zu of %zu runs%s", rows, runs,
                 options->csv ? "; go on with --resume" : "");
    if (failed && !options->quiet)
        complain("fbd-sweep: %zu of %zu runs did not succeed; `status` and `reason` have the cause", failed,
                 rows);
}

/* Compute the missing rows. */
static int fill(const struct ranks *ranks, const fbd_sweep *sweep, const struct sweep_options *options,
                struct partial_file *file)
{
    struct sweep_progress progress;
    fbd_sweep_counts counts = {0};
    size_t runs = fbd_sweep_run_count(sweep);
    const fbd_sweep_work work = {.first = file->rows,
                                 .end = runs,
                                 .jobs = options->jobs,
                                 .write = partial_file_write,
                                 .write_context = file,
                                 .progress = sweep_progress_show,
                                 .progress_context = &progress,
                                 .stop = stops};
    sweep_progress_begin(&progress, file->rows, runs, !options->quiet);
    fbd_sweep_end end = ranks_lead(ranks, sweep, &work, &counts);
    sweep_progress_end(&progress);
    size_t rows = file->rows + counts.written, failed = file->failed + counts.failed;
    if (!partial_file_close(file, rows == runs)) {
        complain("fbd-sweep: cannot write `%s`: %s", options->csv ? options->csv : "-", strerror(errno));
        return exit_failed;
    }
    if (end == FBD_SWEEP_OUT_OF_MEMORY) return no_memory();
    summarise(options, runs, rows, failed);
    if (rows < runs) return 128 + atomic_load(&caught);
    return failed ? exit_failed : exit_done;
}

/* ---- ranks */

/* Choose the exit code: an error with a position is one of the file, others are of the command line. */
static enum exit_code blame(fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        const fbd_error note = fbd_errors_get(errors, i);
        if (note.severity == FBD_ERROR && (note.line > 0 || strcmp(note.id, "cannot-read") == 0))
            return exit_bad_model;
    }
    return exit_usage;
}

static int follow(const struct sweep_options *options)
{
    char *text = NULL;
    size_t length = 0;
    const fbd_sweep_work work = {.jobs = options->jobs, .stop = stops};
    if (!ranks_take(&text, &length)) return exit_failed;
    if (!text) return exit_done; /* the leader has printed the reason, and its exit code counts */
    fbd_errors *errors = fbd_errors_new();
    fbd_sweep *sweep = errors ? fbd_sweep_parse(text, length, options->model, &options->plan, errors) : NULL;
    ranks_follow(sweep, &work);
    fbd_sweep_free(sweep);
    fbd_errors_free(errors);
    free(text);
    return exit_done;
}

static int sweep_and_write(const struct ranks *ranks, const fbd_sweep *sweep,
                           const struct sweep_options *options)
{
    struct partial_file file;
    char *why;
    size_t length = 0;
    enum partial_opening opening = partial_file_open(&file, options->csv, fbd_sweep_header(sweep),
                                                     fbd_sweep_key(sweep), options->resume, &why);
    const char *text = opening == partial_opened ? fbd_sweep_source(sweep, &length) : NULL;
    if (!ranks_give(ranks, text, length)) return no_memory();
    if (opening == partial_opened) return fill(ranks, sweep, options, &file);
    if (!why) return no_memory();
    complain("fbd-sweep: %s", why);
    free(why);
    return opening == partial_refused ? exit_usage : exit_failed;
}

static int lead(const struct ranks *ranks, const struct sweep_options *options)
{
    if (!sweep_outputs_differ(options, NULL)) {
        ranks_give(ranks, NULL, 0);
        return exit_usage;
    }
    fbd_errors *errors = fbd_errors_new();
    if (!errors) return no_memory();
    fbd_sweep *sweep = fbd_sweep_read(options->model, &options->plan, errors);
    int code = sweep ? exit_done : (int)exit_code_for(blame(errors), errors);
    bool spared = !sweep || sweep_outputs_differ(options, errors);
    if (!spared) code = exit_usage;
    fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    if (sweep && spared)
        code = sweep_and_write(ranks, sweep, options);
    else
        ranks_give(ranks, NULL, 0);
    fbd_sweep_free(sweep);
    return code;
}

int main(int argc, char **argv)
{
    struct ranks ranks;
    struct sweep_options options;
    enum exit_code said;
    standard_streams_begin();
    gsl_set_error_handler_off(); /* every status is checked instead */
    if (!ranks_start(&ranks)) return exit_failed;
    int code = exit_done;
    if (sweep_options_read(argc, argv, ranks.rank > 0, &options, &said)) {
        if (ranks.count > 1 && options.jobs == 0) options.jobs = 1; /* mpirun starts one rank per processor */
        watch_signals();
        code = ranks.rank == 0 ? lead(&ranks, &options) : follow(&options);
    } else {
        code = ranks.rank == 0 ? (int)said : exit_done;
    }
    ranks_end(&ranks);
    return code;
}
