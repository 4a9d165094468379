/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The layer's beginning and end: it waits before main, forks a run for each that is asked for, and counts.
 */
#include "layer.h"

#include <dlfcn.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static struct layer_page *page;
static bool counting; /* between the begin of main and the end of the process */
static atomic_long calls;
static const void *refused_to; /* who has made the first call that failed */

bool layer_refuses(enum layer_kind kind, const char *what, const void *caller)
{
    if (!counting) return false;
    long call = atomic_fetch_add(&calls, kind == page->kind) + 1;
    page->calls[kind]++; /* two threads may count as one here: nobody relies on it */
    if (kind != page->kind || page->at == 0) return false;
    bool refused = page->stay ? call >= page->at : call == page->at;
    if (refused && page->refused++ == 0) {
        strncpy(page->what, what, sizeof page->what - 1);
        refused_to = caller;
    }
    return refused;
}

/* ---- the clock: what a run prints must not depend on how long it takes */

static struct timespec tick(void)
{
    static atomic_long now; /* in milliseconds */
    long t = atomic_fetch_add(&now, 1);
    return (struct timespec){1000000 + t / 1000, t % 1000 * 1000000};
}

int clock_gettime(clockid_t clock, struct timespec *now)
{
    (void)clock;
    *now = tick();
    return 0;
}

clock_t clock(void)
{
    struct timespec now = tick();
    return now.tv_sec % 1000 * CLOCKS_PER_SEC + now.tv_nsec / 1000;
}

/* ---- before main */

static int number(const char *name)
{
    const char *text = getenv(name);
    return text ? atoi(text) : -1;
}

/* Returns in each run; the process that was started ends here. */
static void serve(int ask, int answer)
{
    char byte;
    int status;
    while (read(ask, &byte, 1) == 1) {
        pid_t run = fork();
        if (run == 0) {
            close(ask);
            close(answer);
            setrlimit(RLIMIT_CPU, &(struct rlimit){layer_seconds, layer_seconds + 1});
            return;
        }
        if (run < 0 || waitpid(run, &status, 0) != run) _exit(70);
        if (write(answer, &status, sizeof status) != sizeof status) _exit(70);
    }
    _exit(0);
}

static int (*program)(int, char **, char **);

static int layered_main(int argc, char **argv, char **environment)
{
    int shared = number(LAYER_PAGE);
    if (shared >= 0) page = mmap(NULL, sizeof *page, PROT_READ | PROT_WRITE, MAP_SHARED, shared, 0);
    if (shared < 0 || page == MAP_FAILED) return program(argc, argv, environment);
    close(shared);
    unsetenv("LD_PRELOAD"); /* what the program starts, gnuplot, is left in peace */
    serve(number(LAYER_ASK), number(LAYER_ANSWER));
    layer_files_begin();
    layer_memory_begin();
    counting = true;
    return program(argc, argv, environment);
}

typedef int libc_start(int (*)(int, char **, char **), int, char **, void (*)(void), void (*)(void),
                       void (*)(void), void *);

libc_start __libc_start_main;

int __libc_start_main(int (*main)(int, char **, char **), int argc, char **argv, void (*init)(void),
                      void (*fini)(void), void (*rtld_fini)(void), void *stack_end)
{
    libc_start *start;
    *(void **)&start = dlsym(RTLD_NEXT, "__libc_start_main");
    program = main;
    return start(layered_main, argc, argv, init, fini, rtld_fini, stack_end);
}

/* ---- after main */

/* What is lost by others than the programs. The loader keeps the storage of a thread that has ended for the
 * next one. GSL 2.7.1 loses what it has when there is no memory for the rest of it (gsl_matrix_alloc, the
 * state of msadams). */
static bool is_excused(const Dl_info *where)
{
    Dl_info refused;
    if (strstr(where->dli_fname, "/ld-linux")) return true;
    return strstr(where->dli_fname, "/libgsl.") && refused_to && dladdr(refused_to, &refused) &&
           strcmp(refused.dli_fname, where->dli_fname) == 0;
}

static void note_lost(const void *caller)
{
    Dl_info where;
    bool known = dladdr(caller, &where) != 0;
    if (known && is_excused(&where)) return;
    page->lost++;
    if (known)
        snprintf(page->lost_by, sizeof page->lost_by, "%s+%#lx (%s)", where.dli_fname,
                 (unsigned long)((const char *)caller - (const char *)where.dli_fbase),
                 where.dli_sname ? where.dli_sname : "");
}

static void __attribute__((destructor)) finish(void)
{
    if (!counting) return;
    counting = false;
    const void *caller;
    page->lost = 0;
    for (long i = 0; (caller = layer_memory_left(&i)) != NULL;) note_lost(caller);
}
