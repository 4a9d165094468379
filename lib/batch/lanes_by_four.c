/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/sine.h"
#include "batch/lanes.h"

#if defined(__x86_64__)
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif

#define LANES_TABLE lanes_by_four
#define LANES       4
#include "batch/lanes_step.h"

#if defined(__clang__)
#pragma clang attribute pop
#endif

#endif
