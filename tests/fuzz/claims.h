/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What every output keeps to, whatever the input was. Each claim ends the process by fuzz_fail when it does
 * not hold. `what` names the output.
 */
#ifndef TESTS_FUZZ_CLAIMS_H
#define TESTS_FUZZ_CLAIMS_H

#include <stdbool.h>
#include <stddef.h>
#include <time.h>

#include "fbd.h"

/* An input that is invented takes no longer than so many seconds of the processor since clock() was `since`. libFuzzer's
 * own clock is that of the wall: beside other work it tells what is endless, not what is slow. */
void claim_in_time(clock_t since, double most);

/* A number is finite. */
void claim_finite(const char *what, double value);

/* A text holds neither `nan` nor `inf` as a word. */
void claim_no_nan(const char *what, const char *text);

/* True when a text of the input has such a word: then outputs may repeat it. */
bool names_nan(const char *text, size_t length);

/* UTF-8 without control characters other than the end of a line and the tabulator, and without what turns the
 * direction of writing: nothing that a terminal acts on. */
void claim_plain(const char *what, const char *text);

/* The notes as they are printed are plain, each message one line. */
void claim_notes(fbd_errors *errors);

/* A header with different names, and rows with as many finite numbers as it has names; only an error may be
 * missing, which says that it is not known. */
void claim_table(const char *what, const char *text);

/* One value of JSON (RFC 8259), no key twice in an object. */
void claim_json(const char *what, const char *text);

/* Well-formed XML, as far as it is used here: elements nest, attributes are quoted and named once, references
 * are known ones, no control characters, and no id twice. */
void claim_xml(const char *what, const char *text);

#endif
