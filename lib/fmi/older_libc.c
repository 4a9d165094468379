/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Compatibility of the FMU binary with older systems. The linker takes the newest version of each function of
 * the C library, and would require glibc 2.35 only for `hypot`, 2.33 for `stat64` and `fstat64`, 2.29 for `exp`,
 * `log`, `log2` and `pow`; the link option --wrap redirects them to these functions, which call the first versions,
 * available in every glibc for x86-64, and with the same results. The other functions need 2.17 (lib/meson.build).
 */
#include <sys/stat.h>

#define FIRST_OF_ONE(name)                                                                                   \
    double first_##name(double x);                                                                           \
    __asm__(".symver first_" #name ", " #name "@GLIBC_2.2.5");                                               \
    double wrapped_##name(double x) __asm__("__wrap_" #name);                                                \
    double wrapped_##name(double x)                                                                          \
    {                                                                                                        \
        return first_##name(x);                                                                              \
    }

FIRST_OF_ONE(exp)
FIRST_OF_ONE(log)
FIRST_OF_ONE(log2)

double first_pow(double x, double y);
__asm__(".symver first_pow, pow@GLIBC_2.2.5");

double first_hypot(double x, double y);
__asm__(".symver first_hypot, hypot@GLIBC_2.2.5");

int first_stat(int version, const char *path, struct stat *status);
__asm__(".symver first_stat, __xstat64@GLIBC_2.2.5");

int first_fstat(int version, int file, struct stat *status);
__asm__(".symver first_fstat, __fxstat64@GLIBC_2.2.5");

double wrapped_hypot(double x, double y) __asm__("__wrap_hypot");
double wrapped_pow(double x, double y) __asm__("__wrap_pow");
int wrapped_fstat(int file, struct stat *status) __asm__("__wrap_fstat64");
int wrapped_stat(const char *path, struct stat *status) __asm__("__wrap_stat64");

double wrapped_hypot(double x, double y)
{
    return first_hypot(x, y);
}

double wrapped_pow(double x, double y)
{
    return first_pow(x, y);
}

static const int version_of_x86_64 = 1; /* of struct stat */

int wrapped_stat(const char *path, struct stat *status)
{
    return first_stat(version_of_x86_64, path, status);
}

int wrapped_fstat(int file, struct stat *status)
{
    return first_fstat(version_of_x86_64, file, status);
}
