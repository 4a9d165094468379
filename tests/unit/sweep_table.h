/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sweeps in a test: the table of one as text, and its fields. Include after <cmocka.h>.
 */
#ifndef FBD_TESTS_SWEEP_TABLE_H
#define FBD_TESTS_SWEEP_TABLE_H

#include "base/text.h"
#include "fbd.h"
#include "fbd_study.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Thrown from height h; it lands a metre below. */
static const char projectile[] =
    "fbd: 1\n"
    "parameters: {m: 2 kg, v0: 3 m/s, h: 0 m}\n"
    "bodies:\n"
    "  ball:\n"
    "    mass: m\n"
    "    motion: particle\n"
    "    initial: {y: h, vx: v0, vy: 4}\n"
    "    forces: [gravity]\n"
    "simulate:\n"
    "  until: 5 s\n"
    "  events: [{name: top, when: vy < 0}, {name: land, when: y < h - 1, then: stop}]\n";

struct sweep_table {
    fbd_sweep *sweep;
    fbd_errors *errors;
    struct text rows;
    fbd_sweep_counts counts;
    fbd_sweep_end end;
};

static inline int append(void *context, const char *rows, size_t length)
{
    text_add_bytes(context, rows, length);
    return 0;
}

#define TEXTS(...) ((const char *const[]){__VA_ARGS__, NULL})

static inline size_t count_texts(const char *const *texts)
{
    size_t count = 0;
    while (texts && texts[count]) count++;
    return count;
}

static inline fbd_sweep_plan plan_of(const char *const *vary, const char *const *outputs)
{
    return (fbd_sweep_plan){.vary = vary,
                            .vary_count = count_texts(vary),
                            .outputs = outputs,
                            .output_count = count_texts(outputs),
                            .seed = 1};
}

static inline struct sweep_table open_table(const char *text, const fbd_sweep_plan *plan)
{
    struct sweep_table table = {.errors = fbd_errors_new()};
    assert_non_null(table.errors);
    table.sweep = fbd_sweep_parse(text, strlen(text), "test.yaml", plan, table.errors);
    return table;
}

static inline struct sweep_table sweep_by(const char *text, const fbd_sweep_plan *plan, size_t first,
                                          size_t jobs)
{
    struct sweep_table table = open_table(text, plan);
    if (!table.sweep) fbd_errors_print(table.errors, stderr);
    assert_non_null(table.sweep);
    const fbd_sweep_work work = {.first = first,
                                 .end = fbd_sweep_run_count(table.sweep),
                                 .jobs = jobs,
                                 .write = append,
                                 .write_context = &table.rows};
    table.end = fbd_sweep_run(table.sweep, &work, &table.counts);
    return table;
}

static inline struct sweep_table sweep_of(const char *text, const char *const *vary,
                                          const char *const *outputs)
{
    const fbd_sweep_plan plan = plan_of(vary, outputs);
    return sweep_by(text, &plan, 0, 1);
}

static inline void close_table(struct sweep_table *table)
{
    text_free(&table->rows);
    fbd_sweep_free(table->sweep);
    fbd_errors_free(table->errors);
}

/* Field `column` (from 0) of row `row` (from 0), as text. */
static inline const char *field(const struct sweep_table *table, size_t row, size_t column, char *buffer,
                                size_t size)
{
    const char *at = table->rows.data;
    for (size_t i = 0; i < row; i++) at = strchr(at, '\n') + 1;
    for (size_t i = 0; i < column; i++) at = strchr(at, ',') + 1;
    snprintf(buffer, size, "%.*s", (int)strcspn(at, ",\n"), at);
    return buffer;
}

static inline double number(const struct sweep_table *table, size_t row, size_t column)
{
    char buffer[64];
    return strtod(field(table, row, column, buffer, sizeof buffer), NULL);
}

static inline void assert_field(const struct sweep_table *table, size_t row, size_t column, const char *want)
{
    char buffer[64];
    assert_string_equal(field(table, row, column, buffer, sizeof buffer), want);
}

#endif
