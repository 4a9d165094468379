/* SPDX-License-Identifier: GPL-3.0-or-later */
#define LANES_TABLE lanes_by_two
#define LANES       2
#include "batch/lanes_step.h"
