/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The threads of POSIX where there are none (WASI has no pthread.h): a lock is always free, and a second thread is
 * refused, so that a sweep runs on one.
 */
#ifndef FBD_WASI_PTHREAD_H
#define FBD_WASI_PTHREAD_H

#include <errno.h>
#include <stddef.h>

typedef int pthread_t, pthread_mutex_t, pthread_cond_t;

static inline int pthread_mutex_init(pthread_mutex_t *lock, const void *unused)
{
    (void)unused;
    return *lock = 0;
}

static inline int pthread_mutex_lock(pthread_mutex_t *lock)
{
    return *lock = 0;
}

static inline int pthread_mutex_unlock(pthread_mutex_t *lock)
{
    return *lock = 0;
}

static inline int pthread_mutex_destroy(pthread_mutex_t *lock)
{
    return *lock = 0;
}

static inline int pthread_cond_init(pthread_cond_t *change, const void *unused)
{
    (void)unused;
    return *change = 0;
}

static inline int pthread_cond_wait(pthread_cond_t *change, pthread_mutex_t *lock)
{
    return *change = *lock = 0;
}

static inline int pthread_cond_broadcast(pthread_cond_t *change)
{
    return *change = 0;
}

static inline int pthread_cond_destroy(pthread_cond_t *change)
{
    return *change = 0;
}

static inline int pthread_create(pthread_t *thread, const void *unused, void *(*work)(void *), void *context)
{
    (void)unused;
    (void)work;
    (void)context;
    *thread = 0;
    return EAGAIN;
}

static inline int pthread_join(pthread_t thread, void **result)
{
    (void)thread;
    (void)result;
    return 0;
}

#endif
