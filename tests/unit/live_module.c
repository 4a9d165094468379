/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The module of the live pages, with a page that shows no progress.
 */
#include "../../lib/live/module/module.c"

void page_progress(double done, double all)
{
    (void)done;
    (void)all;
}
