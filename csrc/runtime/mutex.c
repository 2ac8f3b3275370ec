/* SPDX-License-Identifier: MIT */
/* MutexInit, MutexLock, MutexUnlock: one hundred mutexes, numbered from one, for routines. C calls
 * them by value, Fortran by reference. They exist from the start; using one before MutexInit works
 * and draws a warning. A mutex that a routine still holds when it stops or crashes is unlocked. */
#include <errno.h>
#include <pthread.h>

#include "thread.h"
#include "usersub/status.h"

enum { MUTEX_COUNT = 100 };

static pthread_mutex_t mutexes[MUTEX_COUNT + 1];
static atomic_int announced[MUTEX_COUNT + 1]; /* MutexInit was called, or the warning given */
static pthread_once_t once = PTHREAD_ONCE_INIT;

static void make_all(void) {
  pthread_mutexattr_t kind;
  pthread_mutexattr_init(&kind);
  pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_ERRORCHECK);
  for (int i = 1; i <= MUTEX_COUNT; i++)
    pthread_mutex_init(&mutexes[i], &kind);
  pthread_mutexattr_destroy(&kind);
}

static void check(const char *call, int id) {
  if (id < 1 || id > MUTEX_COUNT)
    usub_guard_leave(USUB_ROUTINE_STOPPED, "%s(%d): mutexes are numbered 1 to %d", call, id,
                     MUTEX_COUNT);
  pthread_once(&once, make_all);
}

static void hold(int id, int held) {
  uint64_t bit = UINT64_C(1) << (id % 64);
  if (held)
    usub_this_thread.held[id / 64] |= bit;
  else
    usub_this_thread.held[id / 64] &= ~bit;
}

USUB_UTILITY void MutexInit(int id) {
  check("MutexInit", id);
  atomic_store(&announced[id], 1);
}

USUB_UTILITY void MutexLock(int id) {
  check("MutexLock", id);
  if (!atomic_exchange(&announced[id], 1))
    usub_say(-1, "MutexLock(%d): MutexInit(%d) was not called before", id, id);
  if (pthread_mutex_lock(&mutexes[id]) == EDEADLK)
    usub_guard_leave(USUB_ROUTINE_STOPPED, "MutexLock(%d): this thread has already locked it", id);
  hold(id, 1);
}

USUB_UTILITY void MutexUnlock(int id) {
  check("MutexUnlock", id);
  if (pthread_mutex_unlock(&mutexes[id]) != 0)
    usub_say(-1, "MutexUnlock(%d): this thread has not locked it", id);
  hold(id, 0);
}

USUB_UTILITY void mutexinit_(const int *id) {
  MutexInit(*id);
}
USUB_UTILITY void mutexlock_(const int *id) {
  MutexLock(*id);
}
USUB_UTILITY void mutexunlock_(const int *id) {
  MutexUnlock(*id);
}

void usub_mutex_release(void) {
  usub_thread *thread = &usub_this_thread;
  if ((thread->held[0] | thread->held[1]) == 0)
    return;
  for (int id = 1; id <= MUTEX_COUNT; id++) {
    if (thread->held[id / 64] >> (id % 64) & 1)
      pthread_mutex_unlock(&mutexes[id]);
  }
  thread->held[0] = thread->held[1] = 0;
}
