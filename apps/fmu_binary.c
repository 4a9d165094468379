/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmu.h"

extern const char fbd_embedded[], fbd_embedded_end[]; /* apps/embed */

const char *fmu_binary(size_t *length)
{
    *length = (size_t)(fbd_embedded_end - fbd_embedded);
    return fbd_embedded;
}
