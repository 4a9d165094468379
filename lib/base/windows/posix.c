/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "posix.h"

#include <ctype.h>
#include <errno.h>
#include <locale.h>
#include <process.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>
#include <windows.h>

/* ---- files */

/* The errno of the last error of Windows; returns -1. */
static int failed(void)
{
    switch (GetLastError()) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_DRIVE:
    case ERROR_INVALID_NAME:
    case ERROR_BAD_PATHNAME:
    case ERROR_DIRECTORY: errno = ENOENT; break;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_WRITE_PROTECT:
    case ERROR_LOCK_VIOLATION:
    case ERROR_IO_PENDING: errno = EACCES; break;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS: errno = EEXIST; break;
    case ERROR_DISK_FULL: errno = ENOSPC; break;
    case ERROR_NOT_ENOUGH_MEMORY:
    case ERROR_OUTOFMEMORY: errno = ENOMEM; break;
    case ERROR_INVALID_HANDLE: errno = EBADF; break;
    case ERROR_TOO_MANY_OPEN_FILES: errno = EMFILE; break;
    case ERROR_FILENAME_EXCED_RANGE: errno = ENAMETOOLONG; break;
    default: errno = EIO;
    }
    return -1;
}

static bool has_drive(const char *path)
{
    return isalpha((unsigned char)path[0]) && path[1] == ':';
}

int posix_is_absolute(const char *path)
{
    return path[0] == '/' || path[0] == '\\' || has_drive(path);
}

/* `/C:/folder` is the path of a URI. */
static const char *native(const char *path)
{
    return strcmp(path, "/dev/null") == 0 ? "NUL" : path + (path[0] == '/' && has_drive(path + 1));
}

/* A path in UTF-8 whatever the code page of the process, which may be the importer of an FMU. */
static HANDLE handle_of(const char *path, DWORD rights, DWORD creation, DWORD flags)
{
    enum { longest = 2048 };
    wchar_t name[longest];
    SECURITY_ATTRIBUTES kept = {.nLength = sizeof kept, .bInheritHandle = FALSE};
    if (!MultiByteToWideChar(CP_UTF8, 0, native(path), -1, name, longest)) {
        SetLastError(ERROR_FILENAME_EXCED_RANGE);
        return INVALID_HANDLE_VALUE;
    }
    return CreateFileW(name, rights, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, &kept, creation,
                       flags | FILE_FLAG_BACKUP_SEMANTICS, NULL); /* folders can be opened too */
}

static mode_t mode_of(HANDLE file, const BY_HANDLE_FILE_INFORMATION *information)
{
    switch (GetFileType(file)) {
    case FILE_TYPE_CHAR: return S_IFCHR;
    case FILE_TYPE_PIPE: return S_IFIFO;
    default: return (information->dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0 ? S_IFDIR : S_IFREG;
    }
}

/* Of devices, NUL and the console are told apart. */
static int status_of(HANDLE file, struct posix_stat *status)
{
    BY_HANDLE_FILE_INFORMATION information = {0};
    DWORD mode;
    if (GetFileType(file) == FILE_TYPE_UNKNOWN && GetLastError() != NO_ERROR) return failed();
    if (GetFileType(file) == FILE_TYPE_DISK && !GetFileInformationByHandle(file, &information))
        return failed();
    *status =
        (struct posix_stat){.st_ino = (uint64_t)information.nFileIndexHigh << 32 | information.nFileIndexLow,
                            .st_dev = information.dwVolumeSerialNumber,
                            .st_mode = mode_of(file, &information),
                            .st_size = (int64_t)information.nFileSizeHigh << 32 | information.nFileSizeLow};
    if (S_ISCHR(status->st_mode)) status->st_rdev = GetConsoleMode(file, &mode) ? 1 : 2;
    return 0;
}

int posix_fstat(int descriptor, struct posix_stat *status)
{
    HANDLE file = (HANDLE)_get_osfhandle(descriptor);
    SetLastError(NO_ERROR);
    return status_of(file, status);
}

int posix_stat(const char *path, struct posix_stat *status)
{
    HANDLE file = handle_of(path, FILE_READ_ATTRIBUTES, OPEN_EXISTING, 0);
    if (file == INVALID_HANDLE_VALUE) return failed();
    SetLastError(NO_ERROR);
    int result = status_of(file, status);
    CloseHandle(file);
    return result;
}

static DWORD rights_of(int flags)
{
    if (flags & O_RDWR) return GENERIC_READ | GENERIC_WRITE;
    return (flags & O_WRONLY) != 0 ? GENERIC_WRITE : GENERIC_READ;
}

static DWORD creation_of(int flags)
{
    if (!(flags & O_CREAT)) return OPEN_EXISTING;
    if (flags & O_EXCL) return CREATE_NEW;
    return (flags & O_TRUNC) != 0 ? CREATE_ALWAYS : OPEN_ALWAYS;
}

int posix_open(const char *path, int flags, ...)
{
    HANDLE file = handle_of(path, rights_of(flags), creation_of(flags), FILE_ATTRIBUTE_NORMAL);
    if (file == INVALID_HANDLE_VALUE) return failed();
    int descriptor = _open_osfhandle((intptr_t)file, (flags & O_APPEND) | O_BINARY | O_NOINHERIT);
    if (descriptor < 0) CloseHandle(file);
    return descriptor;
}

FILE *posix_fopen(const char *path, const char *mode)
{
    const bool both = strchr(mode, '+') != NULL;
    const int flags =
        mode[0] == 'r' ? (both ? O_RDWR : O_RDONLY) : O_CREAT | O_TRUNC | (both ? O_RDWR : O_WRONLY);
    int descriptor = posix_open(path, flags);
    FILE *stream = descriptor < 0 ? NULL : fdopen(descriptor, mode);
    if (!stream && descriptor >= 0) close(descriptor);
    return stream;
}

int posix_rename(const char *from, const char *to)
{
    return MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING) ? 0 : failed();
}

FILE *posix_tmpfile(void)
{
    char folder[MAX_PATH], path[MAX_PATH];
    if (!GetTempPathA(sizeof folder, folder) || !GetTempFileNameA(folder, "fbd", 0, path))
        return failed(), NULL;
    HANDLE file =
        handle_of(path, GENERIC_READ | GENERIC_WRITE | DELETE, CREATE_ALWAYS, FILE_FLAG_DELETE_ON_CLOSE);
    int descriptor = file == INVALID_HANDLE_VALUE ? failed() : _open_osfhandle((intptr_t)file, O_BINARY);
    return descriptor < 0 ? NULL : fdopen(descriptor, "w+b");
}

int posix_access(const char *path, int mode)
{
    char program[MAX_PATH];
    const int length = snprintf(program, sizeof program, "%s.exe", path);
    if (_access(path, mode & ~X_OK) == 0) return 0;
    return mode & X_OK && length > 0 && length < MAX_PATH ? _access(program, 0) : -1;
}

int faccessat(int folder, const char *path, int mode, int flags)
{
    (void)folder, (void)flags;
    return posix_access(path, mode);
}

int fchown(int descriptor, uid_t owner, gid_t group)
{
    (void)descriptor, (void)owner, (void)group;
    return 0;
}

int fchmod(int descriptor, mode_t mode)
{
    (void)descriptor, (void)mode;
    return 0;
}

uid_t geteuid(void)
{
    return 1;
}

ssize_t readlink(const char *path, char *target, size_t size)
{
    (void)path, (void)target, (void)size;
    errno = EINVAL;
    return -1;
}

char *mkdtemp(char *name)
{
    (void)name;
    errno = ENOSYS;
    return NULL;
}

/* Lock a byte far behind every content: other programs may read and write the content. */
static int lock_file(HANDLE file)
{
    OVERLAPPED far_behind = {.OffsetHigh = 1u << 30};
    return LockFileEx(file, LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &far_behind)
               ? 0
               : failed();
}

int fcntl(int descriptor, int command, ...)
{
    const intptr_t file = _get_osfhandle(descriptor);
    if (file == -1) return -1;
    return command == F_SETLK ? lock_file((HANDLE)file) : 0;
}

/* ---- signals: a blocked one is caught and kept */

static const int signals[] = {SIGINT, SIGTERM, SIGBREAK};
enum { signal_count = sizeof signals / sizeof *signals };

static void (*handlers[signal_count])(int); /* of the blocked signals, from before */
static sigset_t blocked;
static atomic_uint pending;

int sigemptyset(sigset_t *set)
{
    return (int)(*set = 0);
}

int sigaddset(sigset_t *set, int number)
{
    *set |= 1u << number;
    return 0;
}

int sigismember(const sigset_t *set, int number)
{
    return (int)(*set >> number & 1);
}

int sigpending(sigset_t *set)
{
    *set = atomic_load(&pending) & blocked;
    return 0;
}

int sigaction(int number, const struct sigaction *action, struct sigaction *before)
{
    void (*handler)(int) = signal(number, action ? action->sa_handler : SIG_GET);
    if (handler == SIG_ERR) return -1;
    if (before) *before = (struct sigaction){.sa_handler = handler};
    return 0;
}

static void keep(int number)
{
    signal(number, keep);
    atomic_fetch_or(&pending, 1u << number);
}

/* A signal that was kept reaches the handler from before; without one it ends the process as a shell shows it. */
static void release(int number, void (*handler)(int))
{
    signal(number, handler);
    if (!(atomic_fetch_and(&pending, ~(1u << number)) >> number & 1)) return;
    if (handler == SIG_DFL) _exit(128 + number);
    raise(number);
}

int sigprocmask(int how, const sigset_t *set, sigset_t *before)
{
    const sigset_t was = blocked, now = how == SIG_BLOCK ? was | *set : *set;
    if (before) *before = was;
    blocked = now;
    for (int i = 0; i < signal_count; i++) {
        const bool is = sigismember(&now, signals[i]) == 1;
        if (is == (sigismember(&was, signals[i]) == 1)) continue;
        if (is)
            handlers[i] = signal(signals[i], keep);
        else
            release(signals[i], handlers[i]);
    }
    return 0;
}

/* ---- child processes */

char **posix_environ;

int posix_spawn_file_actions_init(posix_spawn_file_actions_t *actions)
{
    *actions = (posix_spawn_file_actions_t){{0, 1, 2}};
    return 0;
}

int posix_spawn_file_actions_adddup2(posix_spawn_file_actions_t *actions, int from, int to)
{
    actions->descriptors[to] = from;
    return 0;
}

int posix_spawn_file_actions_destroy(posix_spawn_file_actions_t *actions)
{
    (void)actions;
    return 0;
}

/* A child inherits the standard streams alone: they are exchanged while it starts. */
int posix_spawnp(pid_t *child, const char *file, const posix_spawn_file_actions_t *actions,
                 const void *attributes, char *const arguments[], char *const environment[])
{
    int before[3];
    (void)attributes, (void)environment;
    for (int i = 0; i < 3; i++) {
        before[i] = _dup(i);
        if (actions->descriptors[i] != i) _dup2(actions->descriptors[i], i);
    }
    *child = _spawnvp(_P_NOWAIT, file, (const char *const *)arguments);
    const int reason = *child == -1 ? errno : 0;
    for (int i = 0; i < 3; i++) {
        _dup2(before[i], i);
        _close(before[i]);
    }
    return reason;
}

int waitpid(pid_t child, int *status, int options)
{
    (void)options;
    return _cwait(status, child, 0) == -1 ? -1 : 0;
}

/* ---- locale, processors, texts */

locale_t newlocale(int mask, const char *name, locale_t base)
{
    (void)mask, (void)name, (void)base;
    return strcmp(localeconv()->decimal_point, ".") != 0;
}

/* 1: numbers as in C, in this thread; 2: as in all others. */
locale_t uselocale(locale_t locale)
{
    _configthreadlocale(locale == 1 ? _ENABLE_PER_THREAD_LOCALE : _DISABLE_PER_THREAD_LOCALE);
    if (locale == 1) setlocale(LC_NUMERIC, "C");
    return 2;
}

void freelocale(locale_t locale)
{
    (void)locale;
}

long sysconf(int name)
{
    SYSTEM_INFO system;
    (void)name;
    GetSystemInfo(&system);
    return (long)system.dwNumberOfProcessors;
}

char *strndup(const char *text, size_t most)
{
    const size_t length = strnlen(text, most);
    char *copy = malloc(length + 1);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

ssize_t getline(char **line, size_t *room, FILE *stream)
{
    size_t length = 0;
    int read = 0;
    while (read != '\n' && (read = getc(stream)) != EOF) {
        if (length + 2 > *room) {
            char *more = realloc(*line, 2 * length + 128);
            if (!more) return -1;
            *line = more;
            *room = 2 * length + 128;
        }
        (*line)[length++] = (char)read;
        (*line)[length] = '\0';
    }
    return length > 0 && !ferror(stream) ? (ssize_t)length : -1;
}
