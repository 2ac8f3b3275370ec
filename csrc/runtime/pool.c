/* SPDX-License-Identifier: MIT */
#include "pool.h"

#include <fenv.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

#include "thread.h"

/* Local arrays of field routines may need 16 MB of stack; only what is touched costs memory. */
enum { STACK_BYTES = 64 << 20 };

typedef struct usub_worker {
  usub_pool *pool;
  pthread_t id;
  pthread_cond_t wake;
  int32_t index;
  int32_t assigned; /* has a share of the present run */
} usub_worker;

struct usub_pool {
  pthread_mutex_t queue; /* one run at a time */
  pthread_mutex_t lock;  /* of everything below */
  pthread_cond_t done;
  usub_worker *workers; /* number 0 is the caller and has no thread */
  int32_t threads, started, busy, stop;
  int forks; /* forks of the process when the threads were made */
  usub_pool_task task;
  void *context;
  int32_t count, sharing; /* workers that take part */
  fenv_t environment;
};

/* Threads do not survive a fork: a child makes its own when it first needs them. */
static atomic_int forks;
static pthread_once_t once = PTHREAD_ONCE_INIT;

static void forked(void) {
  atomic_fetch_add(&forks, 1);
}
static void watch_forks(void) {
  pthread_atfork(NULL, NULL, forked);
}

static int32_t first_index(const usub_pool *pool, int32_t worker) {
  int64_t sharing = pool->sharing;
  return (int32_t)(((int64_t)worker * pool->count + sharing - 1) / sharing);
}

static void work(const usub_pool *pool, int32_t worker) {
  int32_t end = first_index(pool, worker + 1);
  for (int32_t index = first_index(pool, worker); index < end; index++)
    pool->task(pool->context, worker, index);
}

static void *live(void *argument) {
  usub_worker *worker = argument;
  usub_pool *pool = worker->pool;
  usub_this_thread.pool = pool;
  usub_this_thread.index = worker->index;
  usub_this_thread.count = pool->threads;
  pthread_mutex_lock(&pool->lock);
  for (;;) {
    while (!worker->assigned && !pool->stop)
      pthread_cond_wait(&worker->wake, &pool->lock);
    if (pool->stop)
      break;
    pthread_mutex_unlock(&pool->lock);
    fesetenv(&pool->environment);
    work(pool, worker->index);
    pthread_mutex_lock(&pool->lock);
    worker->assigned = 0;
    if (--pool->busy == 0)
      pthread_cond_signal(&pool->done);
  }
  pthread_mutex_unlock(&pool->lock);
  return NULL;
}

static int start_thread(usub_worker *worker) {
  static const size_t sizes[] = {STACK_BYTES, 0}; /* 0: the system's default */
  int failed = 1;
  for (size_t i = 0; failed && i < sizeof sizes / sizeof *sizes; i++) {
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    if (sizes[i] != 0)
      pthread_attr_setstacksize(&attributes, sizes[i]);
    failed = pthread_create(&worker->id, &attributes, live, worker);
    pthread_attr_destroy(&attributes);
  }
  return failed;
}

static int start_threads(usub_pool *pool) {
  /* Interrupts are for the host's threads; a fault is always for the thread that makes it. */
  static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS};
  sigset_t blocked, before;
  sigfillset(&blocked);
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
    sigdelset(&blocked, faults[i]);
  pthread_sigmask(SIG_SETMASK, &blocked, &before);

  pthread_mutex_init(&pool->queue, NULL);
  pthread_mutex_init(&pool->lock, NULL);
  pthread_cond_init(&pool->done, NULL);
  pool->forks = atomic_load(&forks);
  pool->stop = pool->busy = 0;
  int failed = 0;
  for (pool->started = 1; pool->started < pool->threads; pool->started++) {
    usub_worker *worker = &pool->workers[pool->started];
    worker->pool = pool;
    worker->index = pool->started;
    worker->assigned = 0;
    pthread_cond_init(&worker->wake, NULL);
    failed = start_thread(worker);
    if (failed)
      break;
#if defined(__linux__)
    char name[16];
    snprintf(name, sizeof name, "usersub-%d", (int)worker->index % 1000);
    pthread_setname_np(worker->id, name);
#endif
  }
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  return failed;
}

static void stop_threads(usub_pool *pool) {
  pthread_mutex_lock(&pool->lock);
  pool->stop = 1;
  for (int32_t i = 1; i < pool->started; i++)
    pthread_cond_signal(&pool->workers[i].wake);
  pthread_mutex_unlock(&pool->lock);
  for (int32_t i = 1; i < pool->started; i++) {
    pthread_join(pool->workers[i].id, NULL);
    pthread_cond_destroy(&pool->workers[i].wake);
  }
  pthread_cond_destroy(&pool->done);
  pthread_mutex_destroy(&pool->lock);
  pthread_mutex_destroy(&pool->queue);
}

usub_pool *usub_pool_create(int32_t threads) {
  if (threads < 1)
    return NULL;
  pthread_once(&once, watch_forks);
  usub_pool *pool = calloc(1, sizeof *pool);
  if (pool == NULL)
    return NULL;
  pool->threads = threads;
  pool->workers = calloc((size_t)threads, sizeof *pool->workers);
  if (pool->workers == NULL || start_threads(pool) != 0) {
    usub_pool_free(pool);
    return NULL;
  }
  return pool;
}

void usub_pool_free(usub_pool *pool) {
  if (pool == NULL)
    return;
  if (pool->started > 0 && pool->forks == atomic_load(&forks))
    stop_threads(pool);
  free(pool->workers);
  free(pool);
}

int32_t usub_pool_threads(const usub_pool *pool) {
  return pool->threads;
}

/* Wakes the workers that have a share, takes the first one, waits for the others. */
static void run_shared(usub_pool *pool) {
  fegetenv(&pool->environment);
  pthread_mutex_lock(&pool->lock);
  pool->busy = pool->sharing - 1;
  for (int32_t i = 1; i < pool->sharing; i++) {
    pool->workers[i].assigned = 1;
    pthread_cond_signal(&pool->workers[i].wake);
  }
  pthread_mutex_unlock(&pool->lock);
  work(pool, 0);
  pthread_mutex_lock(&pool->lock);
  while (pool->busy > 0)
    pthread_cond_wait(&pool->done, &pool->lock);
  pthread_mutex_unlock(&pool->lock);
}

void usub_pool_run(usub_pool *pool, usub_pool_task task, void *context, int32_t count) {
  usub_thread *thread = &usub_this_thread;
  if (count < 1)
    return;
  if (thread->pool == pool) {
    for (int32_t index = 0; index < count; index++)
      task(context, thread->index, index);
    return;
  }
  if (pool->threads > 1 && pool->forks != atomic_load(&forks) && start_threads(pool) != 0)
    pool->threads = pool->started;

  pthread_mutex_lock(&pool->queue);
  usub_thread before = *thread;
  thread->pool = pool;
  thread->index = 0;
  thread->count = pool->threads;
  pool->task = task;
  pool->context = context;
  pool->count = count;
  pool->sharing = count < pool->threads ? count : pool->threads;
  if (pool->sharing == 1)
    work(pool, 0);
  else
    run_shared(pool);
  thread->pool = before.pool;
  thread->index = before.index;
  thread->count = before.count;
  pthread_mutex_unlock(&pool->queue);
}

int32_t usub_thread_index(void) {
  return usub_this_thread.index;
}
int32_t usub_thread_count(void) {
  return usub_this_thread.count > 0 ? usub_this_thread.count : 1;
}
