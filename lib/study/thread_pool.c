/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/thread_pool.h"

#include "base/api_check.h"
#include "batch/rows_simd.h"
#include "fbd_study.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

/* Approximate duration of a share, and the largest number of its runs; larger shares have no advantage. */
static const double share_seconds = 5e-3;
enum { most_share = 64 };

/* ---- the ring; the lock is held */

/* End the sweep; the first reason is kept. */
static void end_early(fbd_sweep_workers *crew, fbd_sweep_end why)
{
    if (crew->end == FBD_SWEEP_DONE) crew->end = why;
    atomic_store(&crew->over, true);
    pthread_cond_broadcast(&crew->changed);
}

static void write_place(fbd_sweep_workers *crew, const struct place *place)
{
    if (crew->end != FBD_SWEEP_DONE) return;
    if (place->rows.length &&
        crew->work.write(crew->work.write_context, place->rows.data, place->rows.length) != 0) {
        end_early(crew, FBD_SWEEP_REFUSED);
        return;
    }
    crew->counts.written += (size_t)place->made; /* no more than work.end, as `first` and `end` below */
    crew->counts.failed += place->failed;
    if (place->made < place->end - place->first)
        end_early(crew, place->rows.failed ? FBD_SWEEP_OUT_OF_MEMORY : FBD_SWEEP_STOPPED);
}

static void tell_progress(fbd_sweep_workers *crew)
{
    if (!crew->work.progress || crew->end != FBD_SWEEP_DONE) return;
    double all = (double)(crew->work.end - crew->work.first);
    const fbd_progress now = {.what = "sweep",
                              .share = (double)crew->counts.written / all,
                              .written = crew->counts.written,
                              .failed = crew->counts.failed};
    if (crew->work.progress(crew->work.progress_context, &now) != 0) end_early(crew, FBD_SWEEP_STOPPED);
}

/* Mark a share as done; write all completed shares at the head of the ring. */
static void put_in_order(fbd_sweep_workers *crew, struct place *place)
{
    bool first = place == &crew->ring[crew->head % crew->room];
    place->done = true;
    while (crew->head < crew->tail && crew->ring[crew->head % crew->room].done)
        write_place(crew, &crew->ring[crew->head++ % crew->room]);
    if (!first) return;
    tell_progress(crew);
    pthread_cond_broadcast(&crew->changed);
}

/* The number of runs of the next share: some milliseconds for each thread of the worker, and near the end a
 * fraction of the remaining runs; with SIMD batches at least enough to fill the lanes. */
static uint64_t share_size(const fbd_sweep_workers *crew, size_t jobs)
{
    double workers = (double)(crew->jobs + crew->helpers);
    double runs = crew->seconds > 0 ? fmin(share_seconds / crew->seconds, most_share) : 1;
    double left = (double)(crew->work.end - crew->next);
    double size = fmin(runs * (double)jobs, left / (2 * workers));
    if (crew->simd) size = fmax(size, fmin((double)(rows_simd_most * jobs), ceil(left / workers)));
    return size >= 1 ? (uint64_t)size : 1;
}

static bool is_used_up(const fbd_sweep_workers *crew)
{
    return atomic_load(&crew->over) || crew->next >= crew->work.end;
}

/* The next share for a worker of `jobs` threads; NULL when none is left or the ring is full. */
static struct place *hand_out(fbd_sweep_workers *crew, size_t jobs)
{
    if (is_used_up(crew) || crew->tail - crew->head == crew->room) return NULL;
    struct place *place = &crew->ring[crew->tail++ % crew->room];
    place->first = crew->next;
    crew->next += share_size(crew, jobs);
    place->end = crew->next;
    place->made = place->failed = place->rows.length = 0;
    place->done = false;
    return place;
}

/* ---- threads */

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int stops(void *context)
{
    fbd_sweep_workers *crew = context;
    if (atomic_load_explicit(&crew->over, memory_order_relaxed)) return 1;
    return crew->work.stop ? crew->work.stop(crew->work.stop_context) : 0;
}

static void make_rows(fbd_sweep_workers *crew, struct row_maker *maker, struct place *place)
{
    const struct fbd_sweep *sweep = crew->sweep;
    size_t whole = 0;
    for (uint64_t run = place->first; run < place->end; run++) {
        enum row_end end = sweep->question ? sweep_find_row(sweep, run, stops, crew, &place->rows)
                                           : row_make(maker, run, &place->rows);
        if (end == row_stopped || place->rows.failed) break;
        place->made++;
        place->failed += end == row_failed;
        whole = place->rows.length;
    }
    place->rows.length = whole;
}

/* make_rows by SIMD batches. */
static void make_rows_simd(struct rows_simd *simd, struct place *place)
{
    const struct rows_made rows = rows_simd_make(simd, place->first, place->end, &place->rows);
    place->made = rows.made;
    place->failed = rows.failed;
}

static struct place *wait_for_share(fbd_sweep_workers *crew)
{
    struct place *place;
    while (!(place = hand_out(crew, 1)) && !is_used_up(crew)) pthread_cond_wait(&crew->changed, &crew->lock);
    return place;
}

static void *work(void *context)
{
    fbd_sweep_workers *crew = context;
    struct row_maker *maker = row_maker_new(crew->sweep->rows, stops, crew);
    struct rows_simd *simd =
        crew->simd ? rows_simd_new(crew->sweep->rows, rows_simd_most, stops, crew) : NULL;
    pthread_mutex_lock(&crew->lock);
    if (!maker) end_early(crew, FBD_SWEEP_OUT_OF_MEMORY);
    for (struct place *place; (place = wait_for_share(crew)) != NULL;) {
        pthread_mutex_unlock(&crew->lock);
        double start = now();
        if (simd)
            make_rows_simd(simd, place);
        else
            make_rows(crew, maker, place);
        double seconds = (now() - start) / (double)(place->end - place->first);
        pthread_mutex_lock(&crew->lock);
        crew->seconds = crew->seconds > 0 ? 0.5 * (crew->seconds + seconds) : seconds;
        put_in_order(crew, place);
    }
    pthread_mutex_unlock(&crew->lock);
    rows_simd_free(simd);
    row_maker_free(maker);
    return NULL;
}

/* ---- the pool */

static size_t processors(void)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count > 0 ? (size_t)count : 1;
}

static void dismiss(fbd_sweep_workers *crew)
{
    for (size_t i = 0; crew->ring && i < crew->room; i++) text_free(&crew->ring[i].rows);
    free(crew->ring);
    free(crew->thread);
    pthread_mutex_destroy(&crew->lock);
    pthread_cond_destroy(&crew->changed);
    free(crew);
}

/* Start the threads. A single one is not started: fbd_sweep_finish does its work in the caller's thread. */
static void start_threads(fbd_sweep_workers *crew)
{
    if (crew->jobs == 1 && crew->helpers == 0) return;
    while (crew->threads < crew->jobs && pthread_create(&crew->thread[crew->threads], NULL, work, crew) == 0)
        crew->threads++;
}

fbd_sweep_workers *fbd_sweep_start(const fbd_sweep *sweep, const fbd_sweep_work *given, size_t helpers)
{
    fbd_sweep_work own = {0};
    const fbd_sweep_work *work = &own;
    if (!sweep || !api_take_options(&own, sizeof own, given, NULL) || !own.write) return NULL;
    enum { places_of_a_thread = 4, places_of_a_helper = 4, most_jobs = 1024 };
    const size_t usual_rows = 16000; /* bytes of a full share: sufficient in most sweeps */
    fbd_sweep_workers *crew = calloc(1, sizeof *crew);
    if (!crew) return NULL;
    crew->sweep = sweep;
    crew->work = own;
    crew->helpers = helpers;
    crew->simd = !sweep->question && rows_simd_suits(sweep->rows);
    if (crew->work.end > sweep->axes.runs) crew->work.end = (size_t)sweep->axes.runs;
    crew->next = work->first;
    crew->jobs = work->jobs ? work->jobs : processors();
    if (crew->jobs > most_jobs) crew->jobs = most_jobs;
    pthread_mutex_init(&crew->lock, NULL);
    pthread_cond_init(&crew->changed, NULL);
    atomic_init(&crew->over, false);
    crew->room = places_of_a_thread * crew->jobs + places_of_a_helper * helpers;
    crew->ring = calloc(crew->room, sizeof *crew->ring);
    crew->thread = calloc(crew->jobs, sizeof *crew->thread);
    bool reserved = crew->ring != NULL;
    for (size_t i = 0; reserved && i < crew->room; i++)
        reserved = text_reserve(&crew->ring[i].rows, usual_rows);
    if (!reserved || !crew->thread) {
        dismiss(crew);
        return NULL;
    }
    start_threads(crew);
    return crew;
}

int fbd_sweep_claim(fbd_sweep_workers *crew, size_t jobs, fbd_sweep_share *share)
{
    if (!crew || !share) return -1;
    pthread_mutex_lock(&crew->lock);
    if (crew->work.stop && crew->work.stop(crew->work.stop_context) != 0) end_early(crew, FBD_SWEEP_STOPPED);
    bool none = is_used_up(crew);
    struct place *place = hand_out(crew, jobs);
    if (place) *share = (fbd_sweep_share){(size_t)place->first, (size_t)place->end, place};
    pthread_mutex_unlock(&crew->lock);
    return place ? 1 : none ? -1 : 0;
}

/* True if this share was claimed from this pool, and not delivered yet. */
static bool is_handed_out(fbd_sweep_workers *crew, const fbd_sweep_share *share)
{
    bool found = false;
    pthread_mutex_lock(&crew->lock);
    for (size_t i = crew->head; i < crew->tail && !found; i++) {
        const struct place *place = &crew->ring[i % crew->room];
        found = place == share->ticket && !place->done && place->first == share->first;
    }
    pthread_mutex_unlock(&crew->lock);
    return found;
}

void fbd_sweep_deliver(fbd_sweep_workers *crew, const fbd_sweep_share *share, const char *rows, size_t length,
                       const fbd_sweep_counts *counts)
{
    if (!crew || !share || !is_handed_out(crew, share) || !counts || (length > 0 && !rows)) return;
    struct place *place = share->ticket;
    text_add_bytes(&place->rows, rows, length);
    place->made = place->rows.failed ? 0 : counts->written;
    place->failed = counts->failed;
    pthread_mutex_lock(&crew->lock);
    put_in_order(crew, place);
    pthread_mutex_unlock(&crew->lock);
}

fbd_sweep_end fbd_sweep_finish(fbd_sweep_workers *crew, fbd_sweep_counts *counts)
{
    if (counts) *counts = (fbd_sweep_counts){0};
    if (!crew) return FBD_SWEEP_REFUSED;
    if (crew->threads == 0) work(crew); /* also if none could be started */
    for (size_t i = 0; i < crew->threads; i++) pthread_join(crew->thread[i], NULL);
    fbd_sweep_end end = crew->end;
    if (counts) *counts = crew->counts;
    dismiss(crew);
    return end;
}

fbd_sweep_end fbd_sweep_run(const fbd_sweep *sweep, const fbd_sweep_work *work, fbd_sweep_counts *counts)
{
    if (counts) *counts = (fbd_sweep_counts){0};
    fbd_sweep_work own = {0};
    if (!sweep || !api_take_options(&own, sizeof own, work, NULL) || !own.write) return FBD_SWEEP_REFUSED;
    fbd_sweep_workers *crew = fbd_sweep_start(sweep, &own, 0);
    if (crew) return fbd_sweep_finish(crew, counts);
    return FBD_SWEEP_OUT_OF_MEMORY;
}
