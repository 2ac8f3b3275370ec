/* SPDX-License-Identifier: MIT */
/** @file pool.h
 * Persistent threads that share out the blocks of a call. They sleep between calls; nobody spins.
 *
 * Worker w of T always gets the indices [w count / T, (w + 1) count / T), in ascending order, so
 * that a block meets the same thread (and its thread-local arrays) in every call. Tasks have to
 * return: a guard is armed and disarmed inside a task, never around usub_pool_run.
 */
#ifndef USERSUB_RUNTIME_POOL_H
#define USERSUB_RUNTIME_POOL_H

#include <stdint.h>

typedef struct usub_pool usub_pool;
typedef void (*usub_pool_task)(void *context, int32_t worker, int32_t index);

/** Makes a pool of `threads` workers (at least 1), the caller of usub_pool_run being worker 0.
 * @return NULL if memory or threads are short. */
usub_pool *usub_pool_create(int32_t threads);
/** Ends the threads and frees the pool; NULL is allowed. */
void usub_pool_free(usub_pool *pool);
/** Workers of the pool, the caller included. */
int32_t usub_pool_threads(const usub_pool *pool);
/** Runs task(context, worker, index) for index 0 ... count - 1 and returns when all are done.
 * Workers take over the caller's floating-point environment. Calls from several threads queue up;
 * a call from inside a task runs on its own worker alone. */
void usub_pool_run(usub_pool *pool, usub_pool_task task, void *context, int32_t count);

/** What get_thread_id and getNumThreads answer: 0 and 1 outside of a pool. */
int32_t usub_thread_index(void);
int32_t usub_thread_count(void);

#endif
