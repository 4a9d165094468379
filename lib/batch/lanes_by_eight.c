/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/sine.h"
#include "batch/lanes.h"

#if defined(__x86_64__)
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f"))), apply_to = function)
#else
#pragma GCC target("avx512f")
#endif

#define LANES_TABLE lanes_by_eight
#define LANES       8
#include "batch/lanes_step.h"

#if defined(__clang__)
#pragma clang attribute pop
#endif

#endif
