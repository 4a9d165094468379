/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ranks by MPI. A follower requests two shares at once, so that the next is available when one is done; its
 * rows count as a request for another. The leader answers each request with a share or an empty order (no
 * more), and ends when every request has been answered so. Its own threads compute meanwhile.
 *
 *     ask    follower -> leader    the number of its threads
 *     rows   follower -> leader    struct report, then the rows
 *     share  leader -> follower    struct order
 *
 * Waiting is by polling with sleeps: a blocking MPI_Recv would keep a processor busy.
 */
#include "ranks.h"

#include <mpi.h>
#include <pthread.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "complain.h"
#include "fbd_study.h"
#include "fbd_workers.h"

enum tag { tag_ask = 1, tag_rows, tag_share };

enum { questions = 2 };

struct order {
    uint64_t first, end; /* end 0: no more */
};

struct report {
    uint64_t jobs, written, failed;
};

static void doze(void)
{
    const struct timespec moment = {0, 100000};
    nanosleep(&moment, NULL);
}

bool ranks_start(struct ranks *ranks)
{
    static const char *const signs[] = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
    bool under_mpirun = false;
    *ranks = (struct ranks){0, 1};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++) under_mpirun |= getenv(signs[i]) != NULL;
    if (!under_mpirun) return true;
    int level;
    MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &ranks->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks->count);
    if (level >= MPI_THREAD_FUNNELED) return true;
    complain("fbd-sweep: this MPI allows no threads");
    return false;
}

void ranks_end(const struct ranks *ranks)
{
    int started;
    (void)ranks;
    MPI_Initialized(&started);
    if (started) MPI_Finalize();
}

/* Abort all ranks, since the others wait for messages. */
static _Noreturn void give_up(void)
{
    MPI_Abort(MPI_COMM_WORLD, 1);
    abort();
}

enum { most_bytes = 1 << 24 }; /* of a message: counts of MPI are ints */

static bool all_agree(bool fine)
{
    int mine = fine, all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    return all != 0;
}

/* Collective: broadcast `size` bytes of the leader's `text` to that of all ranks. */
static void broadcast(char *text, int64_t size)
{
    for (int64_t at = 0; at < size; at += most_bytes)
        MPI_Bcast(text + at, (int)(size - at < most_bytes ? size - at : most_bytes), MPI_BYTE, 0,
                  MPI_COMM_WORLD);
}

bool ranks_give(const struct ranks *ranks, const char *text, size_t length)
{
    int64_t size = text ? (int64_t)length : -1;
    if (ranks->count == 1) return true;
    char *copy = malloc(length + 1); /* MPI takes no const */
    if (copy && text) memcpy(copy, text, length);
    MPI_Bcast(&size, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
    bool fine = all_agree(copy != NULL);
    if (fine) broadcast(copy, size);
    free(copy);
    return fine;
}

bool ranks_take(char **text, size_t *length)
{
    int64_t size = -1;
    MPI_Bcast(&size, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
    *text = size >= 0 ? malloc((size_t)size + 1) : NULL;
    *length = size >= 0 ? (size_t)size : 0;
    if (!all_agree(size < 0 || *text)) {
        free(*text);
        return false;
    }
    if (*text) broadcast(*text, size);
    return true;
}

/* ---- the leader */

/* The leader's record of a follower. */
struct follower {
    size_t jobs;
    int asked;                        /* unanswered requests */
    fbd_sweep_share share[questions]; /* assigned, the oldest first */
    int shares;
    int dismissed; /* requests answered with an empty order */
};

struct leader {
    fbd_sweep_workers *crew;
    struct follower *followers;
    int count; /* of ranks */
    char *buffer;
    int room;
};

/* Deliver rows to the oldest share: a follower returns shares in order. */
static void take_rows(struct leader *leader, struct follower *follower, const char *message, int size)
{
    struct report report;
    memcpy(&report, message, sizeof report);
    const fbd_sweep_counts counts = {(size_t)report.written, (size_t)report.failed};
    fbd_sweep_deliver(leader->crew, &follower->share[0], message + sizeof report,
                      (size_t)size - sizeof report, &counts);
    follower->share[0] = follower->share[1];
    follower->shares--;
}

/* Receive one message; false when there was none. */
static bool take_message(struct leader *leader)
{
    int there, size;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
    if (!there) return false;
    MPI_Get_count(&status, MPI_BYTE, &size);
    if (size < (int)sizeof(struct report)) give_up(); /* not a message of this program */
    if (size > leader->room) {
        char *larger = realloc(leader->buffer, (size_t)size);
        if (!larger) give_up(); /* it cannot be received */
        leader->buffer = larger;
        leader->room = size;
    }
    MPI_Recv(leader->buffer, size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, &status);
    struct follower *follower = &leader->followers[status.MPI_SOURCE];
    struct report report;
    memcpy(&report, leader->buffer, sizeof report);
    follower->jobs = (size_t)report.jobs;
    follower->asked++;
    if (status.MPI_TAG == tag_rows) take_rows(leader, follower, leader->buffer, size);
    return true;
}

/* Answer one request of a rank; false when it has none, or no share is available now. */
static bool answer(struct leader *leader, int rank)
{
    struct follower *follower = &leader->followers[rank];
    struct order order = {0};
    fbd_sweep_share share;
    if (follower->asked == 0) return false;
    int claimed = fbd_sweep_claim(leader->crew, follower->jobs, &share);
    if (claimed == 0) return false;
    follower->asked--;
    if (claimed > 0) {
        follower->share[follower->shares++] = share;
        order = (struct order){share.first, share.end};
    } else {
        follower->dismissed++;
    }
    MPI_Send(&order, sizeof order, MPI_BYTE, rank, tag_share, MPI_COMM_WORLD);
    return true;
}

static void lead(struct leader *leader)
{
    for (int left = (leader->count - 1) * questions; left > 0;) {
        bool busy = take_message(leader);
        left = 0;
        for (int rank = 1; rank < leader->count; rank++) {
            busy |= answer(leader, rank);
            left += questions - leader->followers[rank].dismissed;
        }
        if (!busy) doze();
    }
}

fbd_sweep_end ranks_lead(const struct ranks *ranks, const fbd_sweep *sweep, const fbd_sweep_work *work,
                         fbd_sweep_counts *counts)
{
    if (ranks->count == 1) return fbd_sweep_run(sweep, work, counts);
    struct leader leader = {.count = ranks->count,
                            .crew = fbd_sweep_start(sweep, work, (size_t)ranks->count - 1),
                            .followers = calloc((size_t)ranks->count, sizeof *leader.followers)};
    if (!leader.crew || !leader.followers) give_up();
    lead(&leader);
    fbd_sweep_end end = fbd_sweep_finish(leader.crew, counts);
    free(leader.followers);
    free(leader.buffer);
    return end;
}

/* ---- the followers */

struct parcel {
    char *data; /* struct report, then the rows */
    size_t length, room;
};

static int add_rows(void *context, const char *rows, size_t length)
{
    struct parcel *parcel = context;
    if (parcel->length + length > parcel->room) {
        size_t room = 2 * (parcel->length + length);
        char *larger = realloc(parcel->data, room);
        if (!larger) return 1;
        parcel->data = larger;
        parcel->room = room;
    }
    memcpy(parcel->data + parcel->length, rows, length);
    parcel->length += length;
    return 0;
}

static void make_share(const fbd_sweep *sweep, const fbd_sweep_work *work, const struct order *order,
                       struct parcel *parcel)
{
    fbd_sweep_work mine = {.first = order->first,
                           .end = order->end,
                           .jobs = work->jobs,
                           .write = add_rows,
                           .write_context = parcel,
                           .stop = work->stop,
                           .stop_context = work->stop_context};
    fbd_sweep_counts counts;
    parcel->length = sizeof(struct report);
    fbd_sweep_run(sweep, &mine, &counts); /* missing rows tell the leader that it was stopped */
    const struct report report = {work->jobs, counts.written, counts.failed};
    memcpy(parcel->data, &report, sizeof report);
    MPI_Send(parcel->data, (int)parcel->length, MPI_BYTE, 0, tag_rows, MPI_COMM_WORLD);
}

static struct order next_order(void)
{
    struct order order;
    for (int there = 0; !there;) {
        MPI_Iprobe(0, tag_share, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
        if (!there) doze();
    }
    MPI_Recv(&order, sizeof order, MPI_BYTE, 0, tag_share, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return order;
}

void ranks_follow(const fbd_sweep *sweep, const fbd_sweep_work *work)
{
    enum { usual_room = 65536 };
    const struct report question = {.jobs = work->jobs};
    struct parcel parcel = {.data = malloc(usual_room), .room = usual_room};
    if (!sweep || !parcel.data) give_up();
    for (int i = 0; i < questions; i++)
        MPI_Send(&question, sizeof question, MPI_BYTE, 0, tag_ask, MPI_COMM_WORLD);
    for (int dismissed = 0; dismissed < questions;) {
        struct order order = next_order();
        if (order.end == 0)
            dismissed++;
        else
            make_share(sweep, work, &order, &parcel);
    }
    free(parcel.data);
}
