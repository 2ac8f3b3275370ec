/* SPDX-License-Identifier: MIT */
/** @file thread.h
 * What the runtime keeps for each thread, in one place, and marks for exported symbols.
 */
#ifndef USERSUB_RUNTIME_THREAD_H
#define USERSUB_RUNTIME_THREAD_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "guard.h"
#include "pool.h"

/** Marks what user code may call; everything else is hidden. */
#define USUB_UTILITY __attribute__((visibility("default")))

typedef struct usub_thread {
  usub_guard *guard;                /* innermost guard */
  const usub_pool *pool;            /* pool whose task runs on this thread */
  int32_t index, count;             /* thread number and number of threads; count 0 means 1 */
  uint64_t held[2];                 /* utility mutexes that this thread has locked, one bit each */
  int32_t prepared;                 /* an alternate signal stack is there */
  int32_t chaining;                 /* inside an earlier fault handler */
  int32_t muted;                    /* messages of routines go nowhere: they have been said */
  int32_t placing;                  /* looking for the place of a fault */
  uintptr_t stack_low, stack_guard; /* lowest address of the stack, bytes of its guard area */
  /* Asked first about memory faults (address, USUB_ACCESS_..., registers): 1 if the access can be
   * tried again
   */
  int (*mend)(void *context, uintptr_t address, int32_t access, void *machine);
  void *mend_context;
} usub_thread;

/* Initial-exec: one instruction to reach, and safe in signal handlers. */
extern _Thread_local usub_thread usub_this_thread __attribute__((tls_model("initial-exec")));

/* faults.c */
/** 1 while faults are caught. */
extern atomic_int usub_faults_caught;
/** Gives this thread an alternate signal stack, so that an overflow of the stack can be caught. */
void usub_faults_prepare(void);

/* mutex.c */
/** Unlocks the utility mutexes that this thread still holds. */
void usub_mutex_release(void);

/* messages.c */
/** Hands text to the message handler; 0 if there is none. */
int usub_say(int32_t level, const char *format, ...) __attribute__((format(printf, 2, 3)));
/** Copies job name or output folder, NUL-terminated. */
void usub_job_name(char *text, size_t size);
void usub_job_folder(char *text, size_t size);

#endif
