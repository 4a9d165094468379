/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Standard input and output as a program finds them: they may be closed, and what is printed may not arrive.
 */
#ifndef FBD_APPS_STANDARD_STREAMS_H
#define FBD_APPS_STANDARD_STREAMS_H

#include <stdbool.h>

/* To be called first: a descriptor that is closed at the start (`>&-`) is kept from being given to the first
 * file that is opened, which would then get what is printed. */
void standard_streams_begin(void);

/* Has all that was printed to standard output arrived? If not, it is said why, but where nobody reads any
 * more (SIGPIPE is held back). */
bool standard_output_arrives(const char *program);

#endif
