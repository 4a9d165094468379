/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "numeric/pivoting.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/pivoting_block.h"
#include "numeric/tolerances.h"

/* ---- the order of the rows: by a hash of their contents, of their neighbours, and of theirs */

struct place {
    uint64_t key;
    size_t index;
};

/* The finaliser of splitmix64 (Steele, Lea and Flood, OOPSLA 2014). */
static uint64_t mixed(uint64_t a, uint64_t b)
{
    uint64_t z = a * 0x9E3779B97F4A7C15u + b + 0x632BE59BD9B4E019u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

static uint64_t with_number(uint64_t key, double number)
{
    uint64_t bits;
    number += 0.0; /* no negative zero */
    memcpy(&bits, &number, sizeof bits);
    return mixed(key, bits);
}

static uint64_t key_of_contents(const struct pivoting_row *row)
{
    uint64_t key = with_number(with_number(0, row->b), row->low);
    key = with_number(with_number(key, row->high), row->low_share);
    key = with_number(with_number(key, row->high_share), row->loss);
    key = mixed(with_number(key, row->slips), row->load);
    return mixed(key, row->of >= 0);
}

/* Sums do not depend on the order of neighbours. */
static uint64_t key_of_neighbours(const struct pivoting_problem *problem, const struct place *places,
                                  size_t i)
{
    size_t n = problem->count;
    int of = problem->rows[i].of;
    uint64_t sum = of >= 0 ? mixed(1, places[of].key) : 0;
    for (size_t j = 0; j < n; j++) {
        if (problem->A[i * n + j] != 0 && j != i) sum += with_number(places[j].key, problem->A[i * n + j]);
        if (problem->rows[j].of == (int)i) sum += mixed(2, places[j].key);
    }
    return with_number(mixed(places[i].key, sum), problem->A[i * n + i]);
}

static int by_key(const void *left, const void *right)
{
    const struct place *a = left, *b = right;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return (a->index > b->index) - (a->index < b->index);
}

/* Sorted places of the rows; NULL when memory is out. */
static struct place *ordered(const struct pivoting_problem *problem)
{
    enum { rounds = 4 };
    size_t n = problem->count;
    struct place *places = calloc(2 * n + 1, sizeof *places);
    if (!places) return NULL;
    struct place *next = places + n;
    for (size_t i = 0; i < n; i++) places[i] = (struct place){key_of_contents(&problem->rows[i]), i};
    for (int round = 0; round < rounds; round++) {
        for (size_t i = 0; i < n; i++) next[i] = (struct place){key_of_neighbours(problem, places, i), i};
        memcpy(places, next, n * sizeof *places);
    }
    qsort(places, n, sizeof *places, by_key);
    return places;
}

/* ---- blocks */

static bool meet(const struct pivoting_problem *problem, size_t i, size_t j)
{
    size_t n = problem->count;
    return problem->A[i * n + j] != 0 || problem->A[j * n + i] != 0 || problem->rows[i].of == (int)j ||
           problem->rows[j].of == (int)i;
}

/* The order of the rows, and the block of each. */
struct parts {
    struct place *places;   /* the rows in their order */
    size_t *queue, *number; /* rows that were reached; the block of each row, counted from 1 */
    int *place;             /* of each row in its block */
    struct pivoting_row *kept;
    size_t count, largest;
};

/* Number the rows of the block of row `first`. */
static void flood(struct parts *parts, const struct pivoting_problem *problem, size_t first)
{
    size_t count = 1;
    parts->queue[0] = first;
    parts->number[first] = ++parts->count;
    for (size_t k = 0; k < count; k++)
        for (size_t j = 0; j < problem->count; j++) {
            if (parts->number[j] > 0 || !meet(problem, parts->queue[k], j)) continue;
            parts->number[j] = parts->count;
            parts->queue[count++] = j;
        }
    if (count > parts->largest) parts->largest = count;
}

static bool parts_new(struct parts *parts, const struct pivoting_problem *problem)
{
    size_t n = problem->count;
    *parts = (struct parts){.places = ordered(problem), .queue = calloc(2 * n + 1, sizeof *parts->queue)};
    parts->place = calloc(n + 1, sizeof *parts->place);
    parts->kept = calloc(n + 1, sizeof *parts->kept);
    if (!parts->places || !parts->queue || !parts->place || !parts->kept) return false;
    parts->number = parts->queue + n;
    for (size_t k = 0; k < n; k++)
        if (parts->number[parts->places[k].index] == 0) flood(parts, problem, parts->places[k].index);
    return true;
}

static void parts_free(struct parts *parts)
{
    free(parts->places);
    free(parts->queue);
    free(parts->place);
    free(parts->kept);
}

static double scale_of(const struct pivoting_problem *problem, size_t i)
{
    double own = problem->A[i * problem->count + i];
    return own > 0 ? 1 / sqrt(own) : 1;
}

static bool block_new(struct pivoting_block *block, const struct pivoting_problem *problem, size_t most)
{
    *block = (struct pivoting_block){.rows = calloc(most + 1, sizeof *block->rows),
                                     .size = problem->size,
                                     .basic = problem->basic,
                                     .coarse = problem->coarse};
    block->A = calloc(most * (most + 1) + 1, sizeof *block->A);
    block->scale = block->A ? block->A + most * most : NULL;
    block->from = calloc(most + 1, sizeof *block->from);
    block->fit = pivoting_fit_new(most);
    for (size_t i = 0; i < problem->count; i++)
        block->size = fmax(block->size, scale_of(problem, i) * fabs(problem->rows[i].b));
    return block->rows && block->A && block->from && block->fit;
}

static void block_free(struct pivoting_block *block)
{
    free(block->rows);
    free(block->A);
    free(block->from);
    pivoting_fit_free(block->fit);
}

/* The loss of a row that slips already reduces its limits. */
static void scale_row(struct pivoting_row *row, double own, double of)
{
    double part = row->slips != 0 ? 1 - row->loss : 1;
    if (row->slips != 0) row->loss = 0;
    row->b *= own;
    row->low *= part / own;
    row->high *= part / own;
    row->low_share *= part * of / own;
    row->high_share *= part * of / own;
}

/* Fill the block with the rows of block `number`. */
static void block_fill(struct pivoting_block *block, const struct pivoting_problem *problem,
                       struct parts *parts, size_t number)
{
    size_t n = block->n = 0;
    int *place = parts->place;
    for (size_t k = 0; k < problem->count; k++) {
        size_t i = parts->places[k].index;
        if (parts->number[i] != number) continue;
        place[i] = (int)n;
        block->scale[n] = scale_of(problem, i);
        block->from[n++] = i;
    }
    block->n = n;
    for (size_t i = 0; i < n; i++) {
        struct pivoting_row *row = &block->rows[i];
        *row = problem->rows[block->from[i]];
        if (row->of >= 0) row->of = place[row->of];
        scale_row(row, block->scale[i], row->of >= 0 ? block->scale[row->of] : 1);
        for (size_t j = 0; j < n; j++)
            block->A[i * n + j] = block->scale[i] *
                                  problem->A[block->from[i] * problem->count + block->from[j]] *
                                  block->scale[j];
    }
}

static void block_store(const struct pivoting_block *block, struct pivoting_problem *problem)
{
    for (size_t i = 0; i < block->n; i++) {
        struct pivoting_row *row = &problem->rows[block->from[i]];
        row->mode = block->rows[i].mode;
        row->x = block->rows[i].x * block->scale[i];
        row->w = block->rows[i].w / block->scale[i];
    }
}

/* ---- one block */

/* Put all rows whose w is zero between their limits, so that each can carry a part. Returns whether modes have changed. */
static bool let_all_carry(struct pivoting_block *block)
{
    bool changed = false;
    for (size_t i = 0; i < block->n; i++) {
        struct pivoting_row *row = &block->rows[i];
        if (row->load != load_is_force) continue;
        int mode = row->w > 0 ? at_low : row->w < 0 ? at_high : between;
        changed |= row->mode != mode;
        row->mode = mode;
    }
    return changed;
}

bool pivoting_fit_all(struct pivoting_block *block, struct pivoting_row *kept)
{
    if (!pivoting_fit(block)) return false;
    memcpy(kept, block->rows, block->n * sizeof *kept);
    if (!let_all_carry(block) || pivoting_fit(block)) return true;
    memcpy(block->rows, kept, block->n * sizeof *kept);
    (void)let_all_carry(block);
    return true;
}

static bool has_wrong_sign(const struct pivoting_row *row)
{
    if (row->load != load_is_force) return false;
    return row->mode == at_high ? row->w > 0 : row->mode == at_low && row->w < 0;
}

/* Move the row that cannot satisfy a limit to this limit; or else let all rows carry whose w has the wrong sign, and
 * those whose limits depend on them. */
static void repair(struct pivoting_block *block)
{
    if (block->beyond < block->n) {
        block->rows[block->beyond].mode = block->at;
        return;
    }
    for (size_t i = 0; i < block->n; i++) {
        struct pivoting_row *row = &block->rows[i];
        if (row->of >= 0 && (has_wrong_sign(row) || has_wrong_sign(&block->rows[row->of])))
            row->mode = between;
    }
    for (size_t i = 0; i < block->n; i++)
        if (block->rows[i].of < 0 && has_wrong_sign(&block->rows[i])) block->rows[i].mode = between;
}

/* Few modes are wrong as a rule: exchange them, with a limit, since this may cycle. */
static bool fit_nearby(struct pivoting_block *block, struct pivoting_row *kept)
{
    size_t most = 4 + block->n / 4;
    for (size_t round = 0; round < most; round++) {
        if (pivoting_fit_all(block, kept)) return true;
        repair(block);
    }
    return false;
}

static enum pivoting follow_path(struct pivoting_block *block, struct pivoting_row *kept)
{
    enum { covers = 4 };
    for (int cover = 0; cover < covers; cover++) {
        enum lcp found = pivoting_lemke(block, cover);
        if (found == lcp_no_memory) return pivoting_no_memory;
        if (found != lcp_solved) continue;
        if (block->basic && pivoting_fit(block)) return pivoting_unexamined;
        pivoting_guess(block);
        (void)let_all_carry(block);
        if (fit_nearby(block, kept)) return pivoting_unexamined;
    }
    return pivoting_ray;
}

/* Hold the rows that slip at their limits less the loss. Returns whether there are more of them. */
static bool hold_slipping(struct pivoting_block *block)
{
    bool any = false;
    for (size_t i = 0; i < block->n; i++) {
        struct pivoting_row *row = &block->rows[i];
        if (row->loss == 0 || row->slips != 0 || row->w == 0 || row->x == 0) continue;
        row->slips = row->w > 0 ? at_low : at_high;
        any = true;
    }
    return any;
}

/* Release them again. Do all of them slip in the direction of their force? */
static bool release_slipping(struct pivoting_block *block)
{
    bool agree = true;
    for (size_t i = 0; i < block->n; i++) {
        struct pivoting_row *row = &block->rows[i];
        if (row->loss == 0) continue;
        agree &= row->slips * row->w <= 0;
        row->slips = 0;
    }
    return agree;
}

static enum pivoting find(struct pivoting_block *block, struct pivoting_row *kept)
{
    enum pivoting found;
    do found = !block->basic && fit_nearby(block, kept) ? pivoting_unexamined : follow_path(block, kept);
    while (found == pivoting_unexamined && hold_slipping(block));
    bool agree = release_slipping(block);
    return found == pivoting_unexamined && !agree ? pivoting_ray : found;
}

/* Rows that are no loads; and may there be several solutions? */
static size_t count_forces(const struct pivoting_block *block, bool *several)
{
    size_t count = 0;
    *several = false;
    for (size_t i = 0; i < block->n; i++) {
        const struct pivoting_row *row = &block->rows[i];
        *several |= row->low_share != 0 || row->high_share != 0 || (row->loss > 0 && block->n > 1);
        count += row->load == load_is_force;
    }
    return count;
}

static enum pivoting block_solve(struct pivoting_block *block, bool examine, struct pivoting_row *kept)
{
    bool several;
    enum pivoting found = find(block, kept);
    bool few = count_forces(block, &several) <= pivoting_few;
    if (found == pivoting_no_memory) return found;
    if (found == pivoting_unexamined && !several) return pivoting_solved;
    return found == pivoting_ray || (examine && few) ? pivoting_enumerate(block, found, kept) : found;
}

enum pivoting pivoting_solve(struct pivoting_problem *problem)
{
    struct parts parts;
    struct pivoting_block block = {0};
    bool made = parts_new(&parts, problem) && block_new(&block, problem, parts.largest);
    enum pivoting found = made ? pivoting_solved : pivoting_no_memory;
    for (size_t number = 1; made && number <= parts.count; number++) {
        block_fill(&block, problem, &parts, number);
        enum pivoting one = block_solve(&block, problem->examine, parts.kept);
        if (one < pivoting_ray) block_store(&block, problem);
        if (one > found) found = one;
    }
    block_free(&block);
    parts_free(&parts);
    return found;
}
