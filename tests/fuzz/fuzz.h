/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the fuzz targets share. A target is a program with libFuzzer's entry LLVMFuzzerTestOneInput: under
 * `make fuzz` libFuzzer calls it with what it invents (mutate.h), in the tests replay.c calls it with the
 * files that are there.
 *
 * Not to crash is the least that is asked: whatever a target learns from the program is held against claims
 * (claims.h), and what does not hold ends the process by fuzz_fail, which libFuzzer takes for a finding.
 */
#ifndef TESTS_FUZZ_FUZZ_H
#define TESTS_FUZZ_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* libFuzzer's names. */
int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size,
                                 uint8_t *out, size_t max_size, unsigned seed);

/* Inputs are no longer than this: what is long is slow, and seldom new. */
enum { fuzz_longest = 4096 };

/* While inputs are invented: then a target does what takes long seldom. A replay, which calls LLVMFuzzerInitialize
 * without arguments, does all of it. */
extern bool fuzz_hurries;

/* Print what was found, and abort. */
_Noreturn void fuzz_fail(const char *what, ...) __attribute__((format(printf, 1, 2)));

/* What else is to be done with an input, as random bits that belong to it: those of a first line
 * `#?` and sixteen hexadecimal digits, else a hash of all of it. To YAML the line is a comment. */
uint64_t fuzz_choices(const char *text, size_t length);

/* Take `bits` bits off the choices. */
unsigned fuzz_take(uint64_t *choices, unsigned bits);

#endif
