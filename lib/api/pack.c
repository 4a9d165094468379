/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "api/pack.h"

#include <float.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- redundancy */

static double cell(const struct record *record, size_t row, size_t column)
{
    return record->rows[row * record->column_count + column];
}

static double size_of(const struct record_column *column)
{
    return fmax(fabs(column->least), fabs(column->greatest));
}

/* True if a column changes by no more than round-off, also if all its values are NaN. */
static bool is_constant(const struct record_column *column)
{
    const double rounding = 1e-14;
    return !(column->greatest - column->least > rounding * size_of(column));
}

/* True if column c, in every row, is offset + factor * column d, to round-off. */
static bool is_affine(const struct record *record, size_t c, size_t d, struct packed_column *packed)
{
    const double rounding = 1e-13;
    const struct record_column *of = &record->columns[d], *column = &record->columns[c];
    size_t low = 0, high = 0;
    for (size_t i = 1; i < record->count; i++) {
        if (cell(record, i, d) < cell(record, low, d)) low = i;
        if (cell(record, i, d) > cell(record, high, d)) high = i;
    }
    double range = cell(record, high, d) - cell(record, low, d);
    double size = size_of(column);
    const double least_change = 1e-6; /* the rounding errors of a nearly constant column would be magnified */
    if (!(range > least_change * size_of(of)) || !isfinite(range) || !isfinite(size)) return false;
    packed->factor = (cell(record, high, c) - cell(record, low, c)) / range;
    packed->offset = cell(record, low, c) - packed->factor * cell(record, low, d);
    packed->of = (int)d;
    double error = rounding * fmax(size, fabs(packed->factor) * size_of(of));
    for (size_t i = 0; i < record->count; i++)
        if (!(fabs(packed->offset + packed->factor * cell(record, i, d) - cell(record, i, c)) <= error))
            return false;
    return true;
}

/* A quick test by a few rows, which excludes most pairs: the ratio of the changes must be constant. */
static bool may_be_affine(const struct record *record, size_t c, size_t d)
{
    enum { probes = 5 };
    double factor = NAN;
    for (size_t i = 1; i < probes; i++) {
        size_t row = i * (record->count - 1) / (probes - 1);
        double step = cell(record, row, d) - cell(record, 0, d),
               own = cell(record, row, c) - cell(record, 0, c);
        if (step == 0) continue;
        double ratio = own / step;
        if (!isnan(factor) && fabs(ratio - factor) > 1e-6 * (fabs(factor) + 1e-300)) return false;
        factor = ratio;
    }
    return true;
}

static bool find_base(const struct pack *pack, size_t c, size_t first, struct packed_column *packed)
{
    const struct record *record = pack->record;
    for (size_t d = first; d < c; d++) {
        enum packed_kind kind = pack->columns[d].kind;
        bool data = kind == packed_double || kind == packed_float;
        /* positions are not derived from columns of float accuracy */
        bool precise = record->columns[c].kind <= quantity_pose && record->columns[c].kind != quantity_rate;
        if (!data || (precise && kind == packed_float)) continue;
        if (may_be_affine(record, c, d) && is_affine(record, c, d, packed)) {
            packed->kind = packed_affine;
            return true;
        }
    }
    return false;
}

static void pack_columns(struct pack *pack)
{
    const struct record *record = pack->record;
    size_t first = 0;
    for (size_t c = 0; c < record->column_count; c++) {
        const struct record_column *column = &record->columns[c];
        struct packed_column *packed = &pack->columns[c];
        if (c > 0 && column->body != record->columns[c - 1].body) first = c;
        if (is_constant(column)) {
            packed->kind = packed_constant;
            packed->offset = cell(record, 0, c);
        } else if (!find_base(pack, c, first, packed)) {
            bool place = column->kind == quantity_coordinate || column->kind == quantity_pose;
            bool wide = place || column->least < -FLT_MAX || column->greatest > FLT_MAX;
            packed->kind = wide ? packed_double : packed_float;
            packed->slot = wide ? pack->doubles++ : pack->floats++;
        }
    }
}

bool pack_begin(struct pack *pack, struct record *record, size_t bytes)
{
    *pack = (struct pack){.record = record};
    pack->columns = calloc(record->column_count, sizeof *pack->columns);
    if (!pack->columns) return false;
    pack_columns(pack);
    /* base 64 makes four bytes of three; 4/5 for the rows, the rest for the envelope */
    size_t row = sizeof(double) * (pack->doubles + 1) + sizeof(float) * pack->floats,
           bucket = 2 * sizeof(float) * (pack->doubles + pack->floats) + 1;
    record_thin(record, bytes * 3 / 4 * 4 / 5 / row, bytes * 3 / 4 / 5 / bucket);
    return true;
}

void pack_end(struct pack *pack)
{
    free(pack->columns);
}

/* ---- base 64 (RFC 4648) */

struct encoder {
    struct text *text;
    unsigned char waiting[3];
    size_t count;
};

static void flush(struct encoder *encoder)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *in = encoder->waiting;
    char out[4] = {digits[in[0] >> 2], digits[(in[0] & 3) << 4 | in[1] >> 4],
                   digits[(in[1] & 15) << 2 | in[2] >> 6], digits[in[2] & 63]};
    for (size_t i = encoder->count + 1; encoder->count > 0 && i < 4; i++) out[i] = '=';
    if (encoder->count > 0) text_add_bytes(encoder->text, out, sizeof out);
    memset(encoder->waiting, 0, sizeof encoder->waiting);
    encoder->count = 0;
}

static void put_byte(struct encoder *encoder, unsigned char byte)
{
    encoder->waiting[encoder->count++] = byte;
    if (encoder->count == 3) flush(encoder);
}

static void put_double(struct encoder *encoder, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; i++) put_byte(encoder, (unsigned char)(bits >> (8 * i)));
}

/* Encode as float; values of an envelope beyond its range become infinite, and are not drawn. */
static void put_float(struct encoder *encoder, double value)
{
    float narrow = (float)value;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    for (int i = 0; i < 4; i++) put_byte(encoder, (unsigned char)(bits >> (8 * i)));
}

void pack_write_doubles(const struct pack *pack, struct text *text)
{
    const struct record *record = pack->record;
    struct encoder encoder = {.text = text};
    for (size_t i = 0; i < record->count; i++) put_double(&encoder, record->times[i]);
    for (size_t c = 0; c < record->column_count; c++)
        if (pack->columns[c].kind == packed_double)
            for (size_t i = 0; i < record->count; i++) put_double(&encoder, cell(record, i, c));
    flush(&encoder);
}

void pack_write_floats(const struct pack *pack, struct text *text)
{
    const struct record *record = pack->record;
    struct encoder encoder = {.text = text};
    for (size_t c = 0; c < record->column_count; c++)
        if (pack->columns[c].kind == packed_float)
            for (size_t i = 0; i < record->count; i++) put_float(&encoder, cell(record, i, c));
    flush(&encoder);
}

void pack_write_envelope(const struct pack *pack, struct text *text)
{
    const struct record *record = pack->record;
    struct encoder encoder = {.text = text};
    if (!record_is_thinned(record)) return;
    for (size_t k = 0; k < record->bucket_count; k++)
        for (int kind = packed_double; kind <= packed_float; kind++)
            for (size_t c = 0; c < record->column_count; c++) {
                if ((int)pack->columns[c].kind != kind) continue;
                const float *ends = record->envelope + 2 * (k * record->column_count + c);
                put_float(&encoder, ends[0]);
                put_float(&encoder, ends[1]);
            }
    flush(&encoder);
}
