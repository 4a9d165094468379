/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Compatibility of the FMU binary with older systems. The linker takes the newest version of each function of
 * the C library, and would require glibc 2.35 only for `hypot` and 2.33 for `stat64`; the link option --wrap
 * redirects both to these functions, which call the first versions, available in every glibc for x86-64. The
 * other functions need 2.29 (lib/meson.build).
 */
#include <sys/stat.h>

double first_hypot(double x, double y);
__asm__(".symver first_hypot, hypot@GLIBC_2.2.5");

int first_stat(int version, const char *path, struct stat *status);
__asm__(".symver first_stat, __xstat64@GLIBC_2.2.5");

double wrapped_hypot(double x, double y) __asm__("__wrap_hypot");
int wrapped_stat(const char *path, struct stat *status) __asm__("__wrap_stat64");

double wrapped_hypot(double x, double y)
{
    return first_hypot(x, y);
}

int wrapped_stat(const char *path, struct stat *status)
{
    const int version_of_x86_64 = 1; /* of struct stat */
    return first_stat(version_of_x86_64, path, status);
}
