/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Those parts of POSIX that the library and the programs use and mingw-w64 lacks. The build for Windows includes this
 * file before every other (meson.build), so that no other file depends on the system. Without a counterpart are links
 * as files of their own, owners and modes of files, and processes that are copies of their parent.
 */
#pragma GCC system_header
#ifndef FBD_BASE_WINDOWS_POSIX_H
#define FBD_BASE_WINDOWS_POSIX_H
#ifndef __ASSEMBLER__ /* assembly is preprocessed as well */

/* Functions of io.h that POSIX has in unistd.h alone or not at all; our files have others of these names. */
#define tell  io_tell
#define write io_write
#include <io.h>
#undef tell
#undef write

#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

/* ---- files: any program may rename or delete an open one; /dev/null is NUL */

typedef int uid_t, gid_t;

struct posix_stat {
    uint64_t st_ino;
    uint32_t st_dev, st_rdev;
    mode_t st_mode;
    uid_t st_uid;
    gid_t st_gid;
    int64_t st_size;
};

#undef stat
#undef fstat
#define stat  posix_stat
#define fstat posix_fstat
#define ino_t uint64_t
int posix_stat(const char *path, struct posix_stat *status);
int posix_fstat(int descriptor, struct posix_stat *status);

#define O_NONBLOCK 0
#define O_CLOEXEC  O_NOINHERIT
#define open       posix_open
#define fopen      posix_fopen
#define rename     posix_rename
#define tmpfile    posix_tmpfile
#define fsync      _commit
int posix_open(const char *path, int flags, ...);
FILE *posix_fopen(const char *path, const char *mode);
int posix_rename(const char *from, const char *to);
FILE *posix_tmpfile(void); /* deleted when it is closed */

#define AT_FDCWD   (-1)
#define AT_EACCESS 0
#define access     posix_access
int posix_access(const char *path, int mode); /* X_OK: also with .exe behind the path */
int faccessat(int folder, const char *path, int mode, int flags);

int fchown(int descriptor, uid_t owner, gid_t group);
int fchmod(int descriptor, mode_t mode);
uid_t geteuid(void);
ssize_t readlink(const char *path, char *target, size_t size); /* EINVAL: no path is a link */
char *mkdtemp(char *name);                                     /* ENOSYS */

#define F_GETFD 1
#define F_SETLK 6
#define F_WRLCK 1
struct flock {
    short l_type, l_whence;
};
/* F_GETFD, and F_SETLK of whole files. */
int fcntl(int descriptor, int command, ...);

/* ---- signals: those of Ctrl-C, of kill and of a closing console */

typedef uint32_t sigset_t;

struct sigaction {
    void (*sa_handler)(int);
    sigset_t sa_mask;
    int sa_flags;
};

#define SIGHUP       SIGBREAK
#define SIGPIPE      13 /* is never sent */
#define SA_RESETHAND 0  /* the C library of Windows always does so */
#undef SIG_BLOCK
#undef SIG_SETMASK
#define SIG_BLOCK   0
#define SIG_SETMASK 2
int sigemptyset(sigset_t *set);
int sigaddset(sigset_t *set, int number);
int sigismember(const sigset_t *set, int number);
int sigaction(int number, const struct sigaction *action, struct sigaction *before);
int sigprocmask(int how, const sigset_t *set, sigset_t *before);
int sigpending(sigset_t *set);

/* ---- child processes between descriptors; arguments have no blanks */

#define PATH_SEPARATOR         ";"
#define PATH_IS_ABSOLUTE(path) posix_is_absolute(path) /* from a drive, or from the root of the present one */
int posix_is_absolute(const char *path);
#define environ posix_environ
extern char **posix_environ; /* NULL: a child has the environment of its parent */

typedef struct {
    int descriptors[3];
} posix_spawn_file_actions_t;
int posix_spawn_file_actions_init(posix_spawn_file_actions_t *actions);
int posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t *actions, int from, int to);
int posix_spawn_file_actions_destroy(posix_spawn_file_actions_t *actions);
int posix_spawnp(pid_t *child, const char *file, const posix_spawn_file_actions_t *actions,
                 const void *attributes, char *const arguments[], char *const environment[]);
int waitpid(pid_t child, int *status, int options);
#define WIFEXITED(status)   1
#define WEXITSTATUS(status) (status)

/* ---- numbers as in C whatever the locale; processors; texts */

typedef int locale_t;
#define LC_ALL_MASK 0
locale_t newlocale(int mask, const char *name, locale_t base); /* 0 where numbers are so already */
locale_t uselocale(locale_t locale);
void freelocale(locale_t locale);

#define _SC_NPROCESSORS_ONLN 84
long sysconf(int name);

char *strndup(const char *text, size_t most);
ssize_t getline(char **line, size_t *room, FILE *stream);

/* ---- without the conversions of the macros of mingw-w64 */

#undef isfinite
#undef isnormal
#undef isinf
#undef isnan
#undef signbit
#define isfinite(value) __builtin_isfinite(value)
#define isinf(value)    __builtin_isinf(value)
#define isnan(value)    __builtin_isnan(value)
#define isnormal(value) __builtin_isnormal(value)
#define signbit(value)  __builtin_signbit(value)

#endif
#endif
