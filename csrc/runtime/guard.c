/* SPDX-License-Identifier: MIT */
#include "guard.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "thread.h"
#include "units.h"

#if defined(__GNUC__)
#include <unwind.h>
#endif

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

_Thread_local usub_thread usub_this_thread;

/* longjmp keeps rounding, flush-to-zero and trap settings as the routine left them. */
static uint64_t control_get(void) {
#if defined(__SSE__)
  return _mm_getcsr();
#elif defined(__aarch64__)
  uint64_t control;
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  return control;
#else
  return 0;
#endif
}

static void control_set(uint64_t control) {
#if defined(__SSE__)
  _mm_setcsr((unsigned int)control);
#elif defined(__aarch64__)
  __asm__ volatile("msr fpcr, %0" : : "r"(control));
#else
  (void)control;
#endif
}

void usub_guard_push(usub_guard *guard) {
  usub_thread *thread = &usub_this_thread;
  guard->status = 0;
  guard->single = 0;
  guard->fault = 0;
  guard->access = guard->late = 0;
  guard->place = guard->code[0] = guard->code[1] = 0;
  guard->float_control = control_get();
  guard->outer = thread->guard;
  guard->reason[0] = '\0';
  if (atomic_load_explicit(&usub_faults_caught, memory_order_relaxed) && !thread->prepared)
    usub_faults_prepare();
  thread->chaining = thread->placing = 0;
  thread->guard = guard;
}

void usub_guard_pop(usub_guard *guard) {
  usub_this_thread.guard = guard->outer;
  if (guard->status)
    usub_units_end_statements();
}

int usub_guard_armed(void) {
  return usub_this_thread.guard != NULL;
}

usub_guard *usub_guard_top(void) {
  return usub_this_thread.guard;
}

#if defined(__GNUC__)
typedef struct place_search {
  const uintptr_t *code;
  uintptr_t found;
  int frames;
} place_search;

static _Unwind_Reason_Code look(struct _Unwind_Context *context, void *data) {
  place_search *search = data;
  const uintptr_t at = _Unwind_GetIP(context);
  if (at > search->code[0] && at <= search->code[1]) {
    search->found = at - 1; /* inside of the call instruction */
    return _URC_END_OF_STACK;
  }
  return ++search->frames < 64 ? _URC_NO_REASON : _URC_END_OF_STACK;
}
#endif

uintptr_t usub_place_in(const uintptr_t code[2], uintptr_t instruction) {
  if (!code[1] || (instruction >= code[0] && instruction < code[1]))
    return instruction;
#if defined(__GNUC__)
  /* A damaged stack faults here: then the handler comes again, and the place stays as it is. */
  if (usub_this_thread.placing)
    return instruction;
  usub_this_thread.placing = 1;
  place_search search = {code, 0, 0};
  _Unwind_Backtrace(look, &search);
  usub_this_thread.placing = 0;
  if (search.found)
    return search.found;
#endif
  return instruction;
}

void usub_guard_note_place(usub_guard *guard, uintptr_t instruction) {
  guard->place = instruction; /* in case that the search falls */
  guard->place = usub_place_in(guard->code, instruction);
}

_Noreturn void usub_guard_jump(usub_guard *guard) {
  usub_this_thread.placing = 0;
  usub_mutex_release();
  control_set(guard->float_control);
  /* Whoever lands has left this guard: leaving again from there goes one further out. */
  usub_this_thread.guard = guard->outer;
  siglongjmp(guard->env, 1);
}

_Noreturn void usub_guard_leave(int32_t status, const char *format, ...) {
  usub_guard *guard = usub_this_thread.guard;
  char reason[sizeof guard->reason];
  va_list args;
  va_start(args, format);
  vsnprintf(reason, sizeof reason, format, args);
  va_end(args);
  if (guard != NULL) {
    guard->status = status;
    memcpy(guard->reason, reason, sizeof reason);
    if (guard->code[1])
      usub_guard_note_place(guard, 0);
    usub_guard_jump(guard);
  }
  /* User code that no driver called: the program ends, as the routine asked. */
  if (!usub_say(-3, "%s", reason))
    fprintf(stderr, "%s\n", reason);
  exit(EXIT_FAILURE);
}
