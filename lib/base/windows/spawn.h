/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * In posix.h, which every file includes.
 */
#ifndef FBD_BASE_WINDOWS_SPAWN_H
#define FBD_BASE_WINDOWS_SPAWN_H
#endif
