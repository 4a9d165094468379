/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of forces, moments, couplings and motions in textbooks and other programs.
 */
#ifndef FBD_SCENE_USUAL_WORDS_H
#define FBD_SCENE_USUAL_WORDS_H

#include "scene/language.h"

extern const struct usual_word usual_forces[], usual_moments[], usual_couplings[], usual_motions[];

/* The hint where an entry of a list has two kinds. */
extern const char kinds_in_list[];

#endif
