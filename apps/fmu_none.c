/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmu.h"

const char *fmu_binary(size_t *length)
{
    *length = 0;
    return NULL;
}
