/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The model language as JSON Schema (draft 07), made from the tables of language.h: editors use it to
 * complete, explain and check while a model is typed. It covers keys, kinds, words and types, the kinds and
 * coordinates of each motion, and signs of plain numbers. Units, expressions and names of points are checked
 * by fbd-run --check only.
 */
#ifndef FBD_SCENE_SCHEMA_H
#define FBD_SCENE_SCHEMA_H

#include "base/text.h"

void schema_write(struct text *text);

#endif
