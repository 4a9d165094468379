/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Standard streams that may be closed at the start, and output that may fail to be written.
 */
#ifndef FBD_APPS_STANDARD_STREAMS_H
#define FBD_APPS_STANDARD_STREAMS_H

#include <stdbool.h>

/* Call first: reserve descriptors that are closed at the start (`>&-`), which otherwise the first opened file
 * would get, and with it the printed text. */
void standard_streams_begin(void);

/* True if all text printed to standard output was written. Otherwise prints the reason, except after a
 * blocked SIGPIPE. */
bool standard_output_arrives(const char *program);

#endif
