/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch/rows_simd.h"

#include <stdlib.h>

#include "base/block_alloc.h"
#include "batch/batch.h"
#include "batch/row.h"

_Static_assert((int)rows_simd_most == (int)batch_most_lanes, "a row for each lane");

/* Rows kept at a time: a full share. */
enum { most_rows = 64 };

/* A row of `rows_simd_make`. */
struct kept_row {
    size_t start, length; /* in `pile` */
    enum row_end end;     /* row_stopped: not made */
    bool out_of_memory;
};

/* Each lane has its own maker, since a patched scene holds the values of one run at a time. */
struct lane {
    struct row_maker maker;
    struct open_row row; /* without a run if the lane is empty */
    struct text text;
    size_t index; /* index of the row in `rows` */
};

struct rows_simd {
    fbd_stop *stop;
    void *stop_context;
    struct batch *batch;
    struct lane lanes[rows_simd_most];
    struct text pile; /* rows, in the order of their completion */
    struct kept_row rows[most_rows];
    uint64_t first; /* run of rows[0] */
    size_t begun, count;
};

bool rows_simd_suits(const struct rows *rows)
{
    const struct columns *columns = &rows->columns;
    return !columns->ledger && !columns->words && columns->at_count == 0 && columns->extreme_count == 0 &&
           batch_suits(rows->base);
}

struct rows_simd *rows_simd_new(const struct rows *rows, unsigned lanes, fbd_stop *stop, void *stop_context)
{
    struct rows_simd *simd = block_alloc(sizeof *simd);
    if (!simd) return NULL;
    simd->stop = stop;
    simd->stop_context = stop_context;
    simd->batch = batch_new(lanes);
    bool made = simd->batch != NULL;
    for (unsigned i = 0; made && i < batch_lanes(simd->batch); i++)
        made = row_maker_init(&simd->lanes[i].maker, rows);
    if (made) return simd;
    rows_simd_free(simd);
    return NULL;
}

unsigned rows_simd_lanes(const struct rows_simd *simd)
{
    return batch_lanes(simd->batch);
}

void rows_simd_free(struct rows_simd *simd)
{
    if (!simd) return;
    for (int i = 0; i < rows_simd_most; i++) {
        struct lane *lane = &simd->lanes[i];
        row_close(&lane->row);
        row_maker_end(&lane->maker);
        text_free(&lane->text);
    }
    batch_free(simd->batch);
    text_free(&simd->pile);
    free(simd);
}

/* Keep the completed row of a lane. */
static void keep(struct rows_simd *simd, struct lane *lane, enum row_end end)
{
    struct kept_row *row = &simd->rows[lane->index];
    *row = (struct kept_row){.start = simd->pile.length, .length = lane->text.length, .end = end};
    if (!lane->text.failed) text_add_bytes(&simd->pile, lane->text.data, lane->text.length);
    row->out_of_memory = lane->text.failed || simd->pile.failed;
    row_close(&lane->row);
}

/* Advance a run without the batch until it fits into its lane. Returns false if it ends before; its row is
 * then kept. */
static bool carry(struct rows_simd *simd, unsigned i)
{
    struct lane *lane = &simd->lanes[i];
    struct ensemble *run = lane->row.run;
    while (run->outcome == FBD_GOING) {
        ensemble_advance(run);
        if (run->count == 1 && batch_put(simd->batch, i, run->groups[0].run)) return true;
    }
    keep(simd, lane, row_put(&lane->maker, &lane->row, &lane->text));
    return false;
}

/* Start rows until one is in the lane. */
static void fill(struct rows_simd *simd, unsigned i)
{
    struct lane *lane = &simd->lanes[i];
    for (bool empty = true; empty && simd->begun < simd->count;) {
        lane->index = simd->begun++;
        lane->text.length = 0;
        lane->text.failed = false;
        if (row_open(&lane->maker, simd->first + lane->index, &lane->row, &lane->text))
            empty = !carry(simd, i);
        else
            keep(simd, lane, row_failed);
    }
}

static bool is_stopped(const struct rows_simd *simd)
{
    return simd->stop && simd->stop(simd->stop_context) != 0;
}

/* Abandon the runs in the lanes. */
static void empty_lanes(struct rows_simd *simd)
{
    for (unsigned i = 0; i < batch_lanes(simd->batch); i++) {
        if (!simd->lanes[i].row.run) continue;
        batch_take(simd->batch, i);
        row_close(&simd->lanes[i].row);
    }
}

static void make_rows(struct rows_simd *simd)
{
    for (size_t k = 0; k < simd->count; k++) simd->rows[k] = (struct kept_row){.end = row_stopped};
    simd->begun = simd->pile.length = 0;
    simd->pile.failed = false;
    for (unsigned i = 0; i < batch_lanes(simd->batch) && !is_stopped(simd); i++) fill(simd, i);
    for (unsigned stops = 1; stops != 0 && !is_stopped(simd);) {
        stops = batch_go(simd->batch);
        for (unsigned i = 0; i < batch_lanes(simd->batch); i++)
            if (stops >> i & 1 && !carry(simd, i)) fill(simd, i);
    }
    empty_lanes(simd);
}

/* Append the rows in order, up to the first missing one. */
static struct rows_made deliver(const struct rows_simd *simd, struct text *text)
{
    struct rows_made rows = {0};
    for (size_t k = 0; k < simd->count && !text->failed; k++) {
        const struct kept_row *row = &simd->rows[k];
        if (row->out_of_memory) text->failed = true;
        if (row->end == row_stopped || text->failed) break;
        const size_t before = text->length;
        text_add_bytes(text, simd->pile.data + row->start, row->length);
        if (text->failed) text->length = before;
        rows.made += !text->failed;
        rows.failed += !text->failed && row->end == row_failed;
    }
    return rows;
}

struct rows_made rows_simd_make(struct rows_simd *simd, uint64_t first, uint64_t end, struct text *text)
{
    struct rows_made all = {0};
    while (first + all.made < end && !text->failed) {
        const uint64_t left = end - first - all.made;
        simd->first = first + all.made;
        simd->count = left < most_rows ? (size_t)left : most_rows;
        make_rows(simd);
        const struct rows_made rows = deliver(simd, text);
        all.made += rows.made;
        all.failed += rows.failed;
        if (rows.made < simd->count) break;
    }
    return all;
}
