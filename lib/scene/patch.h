/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Patch: a scene that is read once, and then takes other values of its parameters without being read again.
 *
 * Reading is a function of the values of those expressions that name what varies, its sites. Where a field of the
 * language says `stored`, reading does nothing with such a value but to store it and to ask on which side of 0 and of 1
 * it lies. So as long as a value stays on its side, the same scene is read, but for the places where it is stored.
 * Which these are is not said anywhere, but found: the scene is read a second time with values that lie beside the
 * first, and each word of it that is not the same has to be the value of one site both times, or the pointer to its
 * expression. A word that is anything else (the end of a rod, computed from its length) means that this scene cannot
 * be patched, and so does a site that is not `stored`. What follows from the scene (inertias, the plan) is no matter
 * of this: it is compiled anew for every run, with all its decisions.
 *
 * A value that leaves its side, or an expression that becomes another kind of one (one that has no switch any more),
 * is refused, and the scene is to be read anew for it.
 */
#ifndef FBD_SCENE_PATCH_H
#define FBD_SCENE_PATCH_H

#include "scene/scene.h"

struct patch;

/* A scene under these values of the parameters that vary (struct override), and `beside`, others of their texts near
 * by, none the same. NULL where it cannot be patched or is wrong, or memory is out. The document must outlive it. */
struct patch *patch_new(const struct document *document, const struct override *overrides, size_t count,
                        const char *const *beside);
void patch_free(struct patch *patch);

/* The scene under other values, the same object each time; NULL where it has to be read. `overrides` are those of
 * patch_new in number, order and names. */
struct scene *patch_apply(struct patch *patch, const struct override *overrides);

#endif
