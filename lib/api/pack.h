/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pack: the columns of a record without redundancy. A column may be constant, or an affine function of an
 * earlier column of the same body (the frame of a body on a slide and its coordinate); the others are data.
 */
#ifndef FBD_API_PACK_H
#define FBD_API_PACK_H

#include "output/run_record.h"

struct packed_column {
    enum packed_kind {
        packed_constant, /* offset */
        packed_affine,   /* offset + factor * column `of` */
        packed_double,   /* data of positions: stored with absolute accuracy */
        packed_float,    /* other data: relative accuracy of a float */
    } kind;
    double offset, factor;
    int of;
    size_t slot; /* index among the columns of its kind of data */
};

struct pack {
    const struct record *record;
    struct packed_column *columns;
    size_t doubles, floats;
};

/* Pack a record, and thin it so that its data, in base 64, takes about `bytes`. Returns false when memory is
 * out. */
bool pack_begin(struct pack *pack, struct record *record, size_t bytes);
void pack_end(struct pack *pack);

/* Base 64 of: the times and all packed_double columns, one after the other; all packed_float columns; the
 * envelope of the former and the latter as floats: pieces x columns x (minimum, maximum). Little endian. */
void pack_write_doubles(const struct pack *pack, struct text *text);
void pack_write_floats(const struct pack *pack, struct text *text);
void pack_write_envelope(const struct pack *pack, struct text *text);

#endif
