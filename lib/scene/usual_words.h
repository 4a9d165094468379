/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What textbooks and other programs call forces, moments, couplings and motions.
 */
#ifndef FBD_SCENE_USUAL_WORDS_H
#define FBD_SCENE_USUAL_WORDS_H

#include "scene/language.h"

/* A hint at what `word` is called here; NULL when it is not one of theirs. */
const char *kind_by_usual_word(const struct kinds *kinds, const char *word);

#endif
