/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pack: the columns of a record with what is said twice left out. A column may be constant, or an earlier one
 * of its body but for a factor and a constant (the frame of a body on a slide is its coordinate); the others
 * are data.
 */
#ifndef FBD_DRAW_PACK_H
#define FBD_DRAW_PACK_H

#include "draw/record.h"

struct packed_column {
    enum packed_kind {
        packed_constant, /* offset */
        packed_affine,   /* offset + factor * column `of` */
        packed_double,   /* data that says where something is: absolutely accurate */
        packed_float,    /* data to be read: relatively accurate */
    } kind;
    double offset, factor;
    int of;
    size_t slot; /* among the columns of its kind of data */
};

struct pack {
    const struct record *record;
    struct packed_column *columns;
    size_t doubles, floats;
};

/* Pack a record, and thin it so that its data, in base 64, takes about `bytes`. False when memory is out. */
bool pack_begin(struct pack *pack, struct record *record, size_t bytes);
void pack_end(struct pack *pack);

/* Base 64 of: the times and all packed_double columns, one after the other; all packed_float columns; the
 * envelope of the latter and the former as floats: pieces x columns x (least, greatest). Little endian. */
void pack_write_doubles(const struct pack *pack, struct text *text);
void pack_write_floats(const struct pack *pack, struct text *text);
void pack_write_envelope(const struct pack *pack, struct text *text);

#endif
