/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The module of the live pages, whose main is not that of the test.
 */
#define main module_main
int module_main(void);
#include "../../lib/live/module/module.c"
