/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmu.h"

#include <stdint.h>

extern const char fbd_embedded[]; /* lib/embed */
extern const uint64_t fbd_embedded_length;

const char *fmu_binary(size_t *length)
{
    *length = (size_t)fbd_embedded_length;
    return fbd_embedded;
}
