/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/abreast.h"

#include <stdlib.h>

#include "base/block_alloc.h"
#include "batch/batch.h"

/* Rows that are waited for at a time: a full share. */
enum { most_rows = 64 };

/* A row of `abreast_make`. */
struct kept_row {
    size_t start, length; /* in `pile` */
    enum row_end end;     /* row_stopped: it is not there */
    bool out_of_memory;
};

/* Each lane has a maker of its own: the scene of one takes the values of one run at a time. */
struct lane {
    struct row_maker maker;
    struct open_row row; /* without a run where the lane is empty */
    struct text text;
    size_t index; /* of the row among those that are made */
};

struct abreast {
    fbd_stop *stop;
    void *stop_context;
    struct batch *batch;
    struct lane lanes[batch_most_lanes];
    struct text pile; /* rows, as they came to their ends */
    struct kept_row rows[most_rows];
    uint64_t first; /* run of rows[0] */
    size_t begun, count;
};

bool abreast_suits(const struct fbd_sweep *sweep)
{
    const struct columns *columns = &sweep->columns;
    return !columns->ledger && columns->extreme_count == 0 && batch_suits(sweep->base);
}

struct abreast *abreast_new(const struct fbd_sweep *sweep, unsigned lanes, fbd_stop *stop, void *stop_context)
{
    struct abreast *abreast = block_alloc(sizeof *abreast);
    if (!abreast) return NULL;
    abreast->stop = stop;
    abreast->stop_context = stop_context;
    abreast->batch = batch_new(lanes);
    bool made = abreast->batch != NULL;
    for (unsigned i = 0; made && i < batch_lanes(abreast->batch); i++)
        made = row_maker_init(&abreast->lanes[i].maker, sweep);
    if (made) return abreast;
    abreast_free(abreast);
    return NULL;
}

unsigned abreast_lanes(const struct abreast *abreast)
{
    return batch_lanes(abreast->batch);
}

void abreast_free(struct abreast *abreast)
{
    if (!abreast) return;
    for (int i = 0; i < batch_most_lanes; i++) {
        struct lane *lane = &abreast->lanes[i];
        row_close(&lane->row);
        row_maker_free(&lane->maker);
        text_free(&lane->text);
    }
    batch_free(abreast->batch);
    text_free(&abreast->pile);
    free(abreast);
}

/* The row of a lane is whole. */
static void keep(struct abreast *abreast, struct lane *lane, enum row_end end)
{
    struct kept_row *row = &abreast->rows[lane->index];
    *row = (struct kept_row){.start = abreast->pile.length, .length = lane->text.length, .end = end};
    if (!lane->text.failed) text_add_bytes(&abreast->pile, lane->text.data, lane->text.length);
    row->out_of_memory = lane->text.failed || abreast->pile.failed;
    row_close(&lane->row);
}

/* Make what steps a run has to make by itself, until it can be put into its lane. False where it comes to its end before:
 * its row is kept. */
static bool carry(struct abreast *abreast, unsigned i)
{
    struct lane *lane = &abreast->lanes[i];
    struct ensemble *run = lane->row.run;
    while (run->outcome == FBD_GOING) {
        ensemble_advance(run);
        if (run->count == 1 && batch_put(abreast->batch, i, run->groups[0].run)) return true;
    }
    keep(abreast, lane, row_put(&lane->maker, &lane->row, &lane->text));
    return false;
}

/* Begin rows until one is in the lane. */
static void fill(struct abreast *abreast, unsigned i)
{
    struct lane *lane = &abreast->lanes[i];
    for (bool empty = true; empty && abreast->begun < abreast->count;) {
        lane->index = abreast->begun++;
        lane->text.length = 0;
        lane->text.failed = false;
        if (row_open(&lane->maker, abreast->first + lane->index, &lane->row, &lane->text))
            empty = !carry(abreast, i);
        else
            keep(abreast, lane, row_failed);
    }
}

static bool is_stopped(const struct abreast *abreast)
{
    return abreast->stop && abreast->stop(abreast->stop_context) != 0;
}

/* Runs that are under way come to nothing. */
static void empty_lanes(struct abreast *abreast)
{
    for (unsigned i = 0; i < batch_lanes(abreast->batch); i++) {
        if (!abreast->lanes[i].row.run) continue;
        batch_take(abreast->batch, i);
        row_close(&abreast->lanes[i].row);
    }
}

static void make_rows(struct abreast *abreast)
{
    for (size_t k = 0; k < abreast->count; k++) abreast->rows[k] = (struct kept_row){.end = row_stopped};
    abreast->begun = abreast->pile.length = 0;
    abreast->pile.failed = false;
    for (unsigned i = 0; i < batch_lanes(abreast->batch) && !is_stopped(abreast); i++) fill(abreast, i);
    for (unsigned stops = 1; stops != 0 && !is_stopped(abreast);) {
        stops = batch_go(abreast->batch);
        for (unsigned i = 0; i < batch_lanes(abreast->batch); i++)
            if (stops >> i & 1 && !carry(abreast, i)) fill(abreast, i);
    }
    empty_lanes(abreast);
}

/* In order, up to the first one that is not there. */
static struct rows_made deliver(const struct abreast *abreast, struct text *text)
{
    struct rows_made rows = {0};
    for (size_t k = 0; k < abreast->count && !text->failed; k++) {
        const struct kept_row *row = &abreast->rows[k];
        if (row->out_of_memory) text->failed = true;
        if (row->end == row_stopped || text->failed) break;
        const size_t before = text->length;
        text_add_bytes(text, abreast->pile.data + row->start, row->length);
        if (text->failed) text->length = before;
        rows.made += !text->failed;
        rows.failed += !text->failed && row->end == row_failed;
    }
    return rows;
}

struct rows_made abreast_make(struct abreast *abreast, uint64_t first, uint64_t end, struct text *text)
{
    struct rows_made all = {0};
    while (first + all.made < end && !text->failed) {
        const uint64_t left = end - first - all.made;
        abreast->first = first + all.made;
        abreast->count = left < most_rows ? (size_t)left : most_rows;
        make_rows(abreast);
        const struct rows_made rows = deliver(abreast, text);
        all.made += rows.made;
        all.failed += rows.failed;
        if (rows.made < abreast->count) break;
    }
    return all;
}
