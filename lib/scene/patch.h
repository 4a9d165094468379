/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Patch: a scene that is read once, and then receives other values of its parameters without being read
 * again.
 *
 * Reading is a function of the values of those expressions that depend on varying names, its sites. Where a
 * field of the language is `stored`, reading only stores such a value and tests on which side of 0 and of 1
 * it lies. So as long as a value stays on its side, reading gives the same scene except for the words where
 * it is stored. These words are found by comparison: the scene is read a second time with slightly different
 * values, and each word that differs has to be the value of one site both times, or the pointer to its
 * expression. If any other word differs (such as the end of a rod, computed from its length), the scene
 * cannot be patched; neither if a site is not `stored`. Quantities derived from the scene (inertias, the
 * plan) are not affected: they are compiled anew for every run, with all decisions.
 *
 * A value that leaves its side, or an expression whose properties change (for instance one that loses its
 * switch), is refused, and the scene has to be read anew for it.
 */
#ifndef FBD_SCENE_PATCH_H
#define FBD_SCENE_PATCH_H

#include "scene/scene.h"

struct patch;

/* A scene with these values of the varying parameters (struct override); `beside` are slightly different
 * texts of all of them. NULL if it cannot be patched or is wrong, or memory is out. The document must outlive
 * it. */
struct patch *patch_new(const struct document *document, const struct override *overrides, size_t count,
                        const char *const *beside);
void patch_free(struct patch *patch);

/* The scene with other values, the same object each time; NULL if it has to be read anew. `overrides` are
 * those of patch_new in number, order and names. */
struct scene *patch_apply(struct patch *patch, const struct override *overrides);

#endif
