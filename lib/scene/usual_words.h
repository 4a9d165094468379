/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of forces, moments, couplings and motions in textbooks and other programs.
 */
#ifndef FBD_SCENE_USUAL_WORDS_H
#define FBD_SCENE_USUAL_WORDS_H

#include "scene/language.h"

/* A hint at the corresponding name here; NULL if `word` is not in the lists. */
const char *kind_by_usual_word(const struct kinds *kinds, const char *word);

#endif
