/* SPDX-License-Identifier: MIT */
/* Pool, guards, mutexes, arrays and messages from many threads at once; ends with 0 if all is well.
 * Also run under the address, undefined-behaviour and thread sanitizers. */
#include <fenv.h>
#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "guard.h"
#include "pool.h"
#include "usersub/usersub.h"

enum { MOST = 1000, THREADS = 5 };
static const int32_t threads[] = {1, 2, 3, 7}, counts[] = {0, 1, 2, 3, 5, 7, 64, 999};

extern void xit_(void);
extern int get_thread_id_(void);
extern int getnumthreads_(void);
extern void MutexInit(int);
extern void MutexLock(int);
extern void MutexUnlock(int);
extern int *SMAIntArrayCreate(int, int, int);
extern int *SMAIntArrayAccess(int);
extern double *SMALocalFloatArrayCreate(int, int, double);
extern double *SMALocalFloatArrayAccess(int);
extern void *SMAStructArrayCreate(int, int, size_t, const void *);

#define CHECK(condition)                                                                           \
  do {                                                                                             \
    if (!(condition)) {                                                                            \
      printf("line %d: %s\n", __LINE__, #condition);                                               \
      exit(1);                                                                                     \
    }                                                                                              \
  } while (0)

static int worker_of[MOST], times[MOST], rounding[MOST];

static void note(void *context, int32_t worker, int32_t index) {
  CHECK(context == worker_of);
  CHECK(worker == usub_thread_index() && worker == get_thread_id_());
  CHECK(usub_thread_count() == getnumthreads_());
  worker_of[index] = worker;
  times[index]++;
  rounding[index] = fegetround();
}

/* Every index once, in contiguous shares that do not depend on chance, worker 0 always busy. */
static void shares(int32_t threads, int32_t count) {
  usub_pool *pool = usub_pool_create(threads);
  CHECK(pool != NULL && usub_pool_threads(pool) == threads);
  for (int round = 0; round < 3; round++) {
    memset(times, 0, sizeof times);
    fesetround(round == 1 ? FE_UPWARD : FE_TONEAREST);
    usub_pool_run(pool, note, worker_of, count);
    int32_t sharing = count < threads ? count : threads;
    for (int32_t i = 0; i < count; i++) {
      CHECK(times[i] == 1);
      CHECK(worker_of[i] == (int32_t)((int64_t)i * sharing / count));
      CHECK(rounding[i] == fegetround());
    }
    CHECK(usub_thread_index() == 0 && usub_thread_count() == 1);
  }
  fesetround(FE_TONEAREST);
  usub_pool_free(pool);
}

static usub_pool *shared_pool;

static void count_one(void *context, int32_t worker, int32_t index) {
  (void)worker;
  (void)index;
  atomic_fetch_add((atomic_int *)context, 1);
}

/* A call from a task runs on the worker of that task. */
static void nest(void *context, int32_t worker, int32_t index) {
  (void)worker;
  (void)index;
  usub_pool_run(shared_pool, count_one, context, 3);
}

static void *use_shared(void *context) {
  for (int i = 0; i < 50; i++)
    usub_pool_run(shared_pool, i % 2 ? count_one : nest, context, 7);
  return NULL;
}

static void several_callers(void) {
  atomic_int sum = 0;
  pthread_t callers[3];
  shared_pool = usub_pool_create(3);
  for (int i = 0; i < 3; i++)
    pthread_create(&callers[i], NULL, use_shared, &sum);
  for (int i = 0; i < 3; i++)
    pthread_join(callers[i], NULL);
  CHECK(sum == 3 * (25 * 7 + 25 * 7 * 3));
  usub_pool_free(shared_pool);
}

static int total, stops[MOST];

static void stop_some(void *context, int32_t worker, int32_t index) {
  usub_guard outer, inner;
  volatile int left = 0;
  (void)context;
  usub_guard_push(&outer);
  usub_guard_push(&inner);
  if (sigsetjmp(inner.env, 0) == 0) {
    int *global = SMAIntArrayAccess(5);
    if (global == NULL)
      global = SMAIntArrayCreate(5, 10, 3);
    double *local = SMALocalFloatArrayAccess(5);
    if (local == NULL)
      local = SMALocalFloatArrayCreate(5, 2, 0.0);
    local[0] += 1;
    local[1] = worker;
    CHECK(global[9] == 3 && SMALocalFloatArrayAccess(5) == local);
    MutexLock(2);
    total++;
    if (index % 3 == 0)
      xit_(); /* unlocks */
    MutexUnlock(2);
  } else {
    left = 1;
    CHECK(inner.status == USUB_ROUTINE_STOPPED && strcmp(inner.reason, "XIT") == 0);
  }
  usub_guard_pop(&inner);
  CHECK(usub_guard_top() == &outer);
  usub_guard_pop(&outer);
  CHECK(SMALocalFloatArrayAccess(5)[1] == worker);
  stops[index] = left;
}

static void hear(void *context, int32_t level, const char *text) {
  CHECK(level == -1 && strncmp(text, "MutexLock(", 10) == 0);
  atomic_fetch_add((atomic_int *)context, 1);
}

static void guards_and_arrays(void) {
  atomic_int heard = 0;
  usub_set_message_handler(hear, &heard);
  usub_pool *pool = usub_pool_create(THREADS);
  for (int round = 1; round <= 4; round++) {
    usub_pool_run(pool, stop_some, NULL, MOST);
    CHECK(total == round * MOST);
    for (int i = 0; i < MOST; i++)
      CHECK(stops[i] == (i % 3 == 0));
  }
  CHECK(heard == 1); /* MutexInit was never called: said once */
  CHECK(SMALocalFloatArrayAccess(5)[0] == 4.0 * MOST / THREADS);
  usub_end_job();
  CHECK(SMAIntArrayAccess(5) == NULL && SMALocalFloatArrayAccess(5) == NULL);
  usub_pool_free(pool);
  usub_set_message_handler(NULL, NULL);
}

static void structures(void) {
  struct item {
    double a;
    int b[3];
  } first = {2.5, {1, 2, 3}}, *items;
  for (int id = 40; id > 0; id--) {
    items = SMAStructArrayCreate(id, 3, sizeof first, &first);
    items[1].b[2] = id;
  }
  items = SMAStructArrayCreate(11, 5, sizeof first, NULL);
  CHECK(items[1].b[2] == 11 && items[2].a == 2.5 && items[4].a == 0 && items[4].b[0] == 0);
  items = SMAStructArrayCreate(11, 2, sizeof first, NULL);
  items = SMAStructArrayCreate(11, 3, sizeof first, NULL);
  CHECK(items[1].b[2] == 11 && items[2].a == 0);
  usub_end_job();
}

/* A child process has the pool but not its threads. */
static void fork_and_run(void) {
  atomic_int sum = 0;
  usub_pool *pool = usub_pool_create(3);
  usub_pool_run(pool, count_one, &sum, 9);
  pid_t child = fork();
  if (child == 0) {
    usub_pool_run(pool, count_one, &sum, 9);
    usub_pool_free(pool);
    _exit(sum == 18 ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  CHECK(status == 0 && sum == 9);
  usub_pool_free(pool);
}

int main(int count, char **arguments) {
  for (size_t t = 0; t < sizeof threads / sizeof *threads; t++) {
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
      shares(threads[t], counts[c]);
  }
  CHECK(usub_pool_create(0) == NULL);
  usub_pool_free(NULL);
  several_callers();
  guards_and_arrays();
  structures();
  if (count > 1 && strcmp(arguments[1], "fork") == 0)
    fork_and_run();
  puts("all is well");
  return 0;
}
