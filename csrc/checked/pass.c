/* SPDX-License-Identifier: MIT */
/* One pass: arguments into their rooms, garbage onto the stack, the call, what became of it. */
#include <fenv.h>
#include <stdio.h>
#include <string.h>

#include "../runtime/thread.h"
#include "../runtime/watch.h"
#include "checked.h"

/* Part of the stack that gets garbage. Local arrays of some routines are larger; an overflow of the
 * stack by the garbage itself would be worse than what it does not find. */
enum { GARBAGE_BYTES = 64 << 10 };

/* Zero, which is what fresh memory holds, and a number that no routine means: 1.5e9 as two words,
 * 27 as one, true as a logical, far outside of any array as an index. */
static const uint32_t garbage[2] = {0, 0x41d5a5a5};

/* The place on the stack where the routine will have its variables, and registers. */
__attribute__((noinline)) static void paint(int which) {
  uint32_t stack[GARBAGE_BYTES / sizeof(uint32_t)];
  const uint32_t word = garbage[which];
  for (size_t i = 0; i < sizeof stack / sizeof stack[0]; ++i)
    stack[i] = word;
  __asm__ volatile("" : : "r"(stack) : "memory"); /* or nobody would write it */
#if defined(__SSE2__) && defined(__x86_64__)
  __asm__ volatile("movd %0, %%xmm0\n\tpshufd $0, %%xmm0, %%xmm0\n\t"
                   "movdqa %%xmm0, %%xmm8\n\tmovdqa %%xmm0, %%xmm9\n\t"
                   "movdqa %%xmm0, %%xmm10\n\tmovdqa %%xmm0, %%xmm11\n\t"
                   "movdqa %%xmm0, %%xmm12\n\tmovdqa %%xmm0, %%xmm13\n\t"
                   "movdqa %%xmm0, %%xmm14\n\tmovdqa %%xmm0, %%xmm15"
                   :
                   : "r"(word)
                   : "xmm0", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15");
#endif
}

/* Whether the stack has room for the garbage and for the routine. */
static int has_room(void) {
  const uintptr_t low = usub_this_thread.stack_low, here = (uintptr_t)__builtin_frame_address(0);
  return !low || here < low || here - low > 4 * (uintptr_t)GARBAGE_BYTES;
}

static int32_t flags_now(void) {
  const int found = fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW);
  return (found & FE_INVALID ? USUB_FLAG_INVALID : 0) |
         (found & FE_DIVBYZERO ? USUB_FLAG_DIVISION : 0) |
         (found & FE_OVERFLOW ? USUB_FLAG_OVERFLOW : 0) |
         (found & FE_UNDERFLOW ? USUB_FLAG_UNDERFLOW : 0);
}

/* A fault at an address of an argument. */
static void blame(const usub_driver *driver, const usub_checker *checker, const usub_guard *guard,
                  usub_outcome *outcome) {
  const int32_t i = guard->fault ? usub_room_at(checker, guard->fault) : -1;
  outcome->what = USUB_SAW_CRASH;
  if (i < 0)
    return;
  const usub_room *room = &checker->rooms[i];
  const usub_extent *extent = &checker->extents[i];
  const int64_t bytes = (int64_t)guard->fault - (int64_t)(uintptr_t)(room->shown + room->offset);
  const int64_t size = (int64_t)extent->element;
  outcome->argument = i;
  outcome->access = guard->access;
  outcome->element = bytes / size - (bytes % size < 0);
  if (usub_is_left_out(driver, i))
    outcome->what = USUB_SAW_LEFT_OUT;
  else if (bytes >= 0 && (size_t)bytes < room->filled)
    outcome->what = USUB_SAW_INPUT_WRITTEN;
  else
    outcome->what = USUB_SAW_OUTSIDE;
  outcome->status = USUB_CONTRACT;
}

/* The routine left to the guard. */
static void take_guard(const usub_driver *driver, const usub_checker *checker,
                       const usub_guard *guard, usub_outcome *outcome) {
  outcome->status = guard->status;
  outcome->place = guard->place;
  memcpy(outcome->reason, guard->reason, sizeof guard->reason);
  if (guard->late)
    outcome->what = USUB_SAW_TIME;
  else if (guard->status == USUB_ROUTINE_STOPPED)
    outcome->what = USUB_SAW_STOP;
  else if (guard->status == USUB_ROUTINE_CRASHED)
    blame(driver, checker, guard, outcome);
}

__attribute__((noinline)) static void call_guarded(const usub_driver *driver, usub_call *call,
                                                   const usub_checker *checker,
                                                   const usub_pass *pass, usub_outcome *outcome) {
  USUB_ENDS_EXCEPTIONS;
  usub_guard guard;
  usub_guard_push(&guard);
  guard.single = driver->single;
  guard.code[0] = checker->code[0];
  guard.code[1] = checker->code[1];
  if (sigsetjmp(guard.env, 0) == 0) {
    usub_watch_start(driver->time_limit);
    if (has_room())
      paint(pass->garbage);
    outcome->status = usub_call_entry(driver, call, (void **)(uintptr_t)checker->argv);
    if (outcome->status < 0)
      strcpy(outcome->reason,
             outcome->status == USUB_ROUTINE_RAISED ? "an exception" : "its status");
  } else {
    take_guard(driver, checker, &guard, outcome);
  }
  usub_watch_stop();
  usub_guard_pop(&guard);
}

void usub_pass_run(const usub_driver *driver, usub_call *call, usub_checker *checker,
                   const usub_pass *pass, usub_outcome *outcome) {
  usub_thread *thread = &usub_this_thread;
  *outcome = (usub_outcome){.argument = -1, .element = -1};
  usub_rooms_fill(driver, call, checker, pass);
  if (pass->closed) {
    checker->traced = pass->closed;
    checker->tracing = outcome;
    usub_rooms_close(checker, pass->closed, 1);
    thread->mend_context = checker;
    thread->mend = usub_room_open;
  }
  fenv_t environment;
  fegetenv(&environment);
  feclearexcept(FE_ALL_EXCEPT);
  thread->muted = !pass->speaks;
  call_guarded(driver, call, checker, pass, outcome);
  thread->muted = 0;
  outcome->flags = flags_now();
  fesetenv(&environment);
  if (pass->closed) {
    thread->mend = NULL;
    checker->traced = 0;
    usub_rooms_close(checker, pass->closed, 0);
  }
  int64_t bytes;
  const int32_t damaged = usub_rooms_damaged(checker, &bytes);
  if (damaged < 0 || (outcome->what != USUB_SAW_NOTHING && outcome->what != USUB_SAW_CRASH))
    return;
  const int64_t size = (int64_t)checker->extents[damaged].element;
  outcome->what = USUB_SAW_RED_ZONE;
  outcome->status = USUB_CONTRACT;
  outcome->argument = damaged;
  outcome->element = bytes / size - (bytes % size < 0);
  outcome->access = USUB_ACCESS_WRITE;
  outcome->place = 0;
}
