/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The names of emscripten that lib/live/module/module.c uses, for a build without it.
 */
#ifndef FBD_TESTS_EMSCRIPTEN_H
#define FBD_TESTS_EMSCRIPTEN_H

#define EM_JS(type, name, parameters, script)                                                                \
    static type name parameters                                                                              \
    {                                                                                                        \
        (void)done;                                                                                          \
        (void)all;                                                                                           \
    }

static inline double emscripten_get_now(void)
{
    return 0;
}

#endif
