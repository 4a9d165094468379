/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The model language as JSON Schema (draft 07), made of the tables of language.h: what editors complete, explain and
 * check while a model is typed. It knows keys, kinds, words and types, which kinds and coordinates go with which
 * motion, and signs of plain numbers. Units, expressions and names of points it leaves to fbd-run --check.
 */
#ifndef FBD_SCENE_SCHEMA_H
#define FBD_SCENE_SCHEMA_H

#include "base/text.h"

void schema_write(struct text *text);

#endif
