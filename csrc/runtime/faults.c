/* SPDX-License-Identifier: MIT */
/* Faults inside routines (usub_catch_faults): the routine is left to the guard of its thread.
 * Signals without a guard, or sent by others, go to whatever handled them before. */
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#if defined(__linux__)
#include <ucontext.h>
#endif

#include "thread.h"
#include "usersub/usersub.h"

enum { SIGNAL_COUNT = 5, STACK_BYTES = 128 << 10 };

/* SIGABRT: aborts of libraries that routines use, such as an exception that nobody catches. */
static const int signals[SIGNAL_COUNT] = {SIGFPE, SIGSEGV, SIGBUS, SIGILL, SIGABRT};
static struct sigaction earlier[SIGNAL_COUNT];
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_once_t once = PTHREAD_ONCE_INIT;
static pthread_key_t stack_key;

atomic_int usub_faults_caught;

/* Alternate stacks */

static void free_stack(void *memory) {
  stack_t none = {.ss_flags = SS_DISABLE};
  sigaltstack(&none, NULL);
  munmap(memory, STACK_BYTES);
}

static void make_key(void) {
  pthread_key_create(&stack_key, free_stack);
}

static void find_stack(usub_thread *thread) {
#if defined(__linux__)
  pthread_attr_t attributes;
  void *low;
  size_t size, guard = 0;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0)
    return;
  if (pthread_attr_getstack(&attributes, &low, &size) == 0) {
    pthread_attr_getguardsize(&attributes, &guard);
    thread->stack_low = (uintptr_t)low;
    thread->stack_guard = guard;
  }
  pthread_attr_destroy(&attributes);
#else
  (void)thread;
#endif
}

void usub_faults_prepare(void) {
  usub_thread *thread = &usub_this_thread;
  thread->prepared = 1;
  find_stack(thread);
  stack_t present;
  if (sigaltstack(NULL, &present) != 0 || !(present.ss_flags & SS_DISABLE))
    return; /* the host has its own */
  pthread_once(&once, make_key);
  void *memory =
      mmap(NULL, STACK_BYTES, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    return; /* everything but an overflow of the stack is still caught */
  stack_t stack = {.ss_sp = memory, .ss_size = STACK_BYTES};
  if (sigaltstack(&stack, NULL) == 0)
    pthread_setspecific(stack_key, memory);
  else
    munmap(memory, STACK_BYTES);
}

/* What happened. Only plain memory work: this runs in a signal handler. */

static void append(char *reason, size_t size, const char *text) {
  size_t used = strlen(reason);
  for (; *text != '\0' && used + 1 < size; text++)
    reason[used++] = *text;
  reason[used] = '\0';
}

static void append_address(char *reason, size_t size, uintptr_t address) {
  char text[2 * sizeof address + 3];
  char *digit = text + sizeof text - 1;
  *digit = '\0';
  do {
    *--digit = "0123456789abcdef"[address % 16];
    address /= 16;
  } while (address != 0);
  *--digit = 'x';
  *--digit = '0';
  append(reason, size, digit);
}

static uintptr_t stack_pointer(const void *context) {
#if defined(__linux__) && defined(__x86_64__)
  return (uintptr_t)((const ucontext_t *)context)->uc_mcontext.gregs[REG_RSP];
#elif defined(__linux__) && defined(__aarch64__)
  return (uintptr_t)((const ucontext_t *)context)->uc_mcontext.sp;
#else
  (void)context;
  return 0;
#endif
}

static uintptr_t instruction(const void *context) {
#if defined(__linux__) && defined(__x86_64__)
  return (uintptr_t)((const ucontext_t *)context)->uc_mcontext.gregs[REG_RIP];
#elif defined(__linux__) && defined(__aarch64__)
  return (uintptr_t)((const ucontext_t *)context)->uc_mcontext.pc;
#else
  (void)context;
  return 0;
#endif
}

/* Whether a memory fault came from reading or from writing. */
static int32_t access_of(const void *context) {
#if defined(__linux__) && defined(__x86_64__)
  const greg_t error = ((const ucontext_t *)context)->uc_mcontext.gregs[REG_ERR];
  return error & 2 ? USUB_ACCESS_WRITE : USUB_ACCESS_READ;
#else
  (void)context;
  return USUB_ACCESS_UNKNOWN;
#endif
}

/* The stack pointer, or what it was about to touch, has passed the end of this thread's stack. */
static int stack_overflow(const siginfo_t *info, const void *context) {
  const usub_thread *thread = &usub_this_thread;
  uintptr_t low = thread->stack_low, address = (uintptr_t)info->si_addr;
  uintptr_t pointer = stack_pointer(context), page = 4096;
  if (low == 0 || pointer == 0)
    return 0;
  int pointer_out = pointer < low + page && pointer + ((uintptr_t)1 << 32) > low;
  int address_out = address < low + page && address + thread->stack_guard + page >= low;
  return pointer_out || address_out;
}

/* Compilers put the undefined instruction where they see that a fault is certain. */
static int is_compiler_trap(const void *context) {
#if defined(__linux__) && defined(__x86_64__)
  const unsigned char *code = (const unsigned char *)instruction(context);
  return code[0] == 0x0f && code[1] == 0x0b;
#else
  (void)context;
  return 0;
#endif
}

static const char *arithmetic(int code) {
  switch (code) {
  case FPE_INTDIV:
    return "integer division by zero"; /* or of the lowest integer by -1 */
  case FPE_INTOVF:
    return "integer overflow";
  case FPE_FLTDIV:
    return "floating-point division by zero";
  case FPE_FLTOVF:
    return "floating-point overflow";
  case FPE_FLTUND:
    return "floating-point underflow";
  case FPE_FLTINV:
    return "invalid floating-point operation";
  default:
    return "arithmetic fault";
  }
}

static void describe(char *reason, size_t size, int signal, const siginfo_t *info,
                     const void *context) {
  reason[0] = '\0';
  if (signal == SIGFPE) {
    append(reason, size, arithmetic(info->si_code));
  } else if (signal == SIGILL) {
    append(reason, size,
           is_compiler_trap(context)
               ? "a fault that the compiler saw coming, such as a division by "
                 "zero or a null pointer"
               : "illegal instruction");
  } else if (signal == SIGABRT) {
    append(reason, size, "abort");
  } else if (stack_overflow(info, context)) {
    append(reason, size, "stack overflow");
  } else if (info->si_addr == NULL && info->si_code != SEGV_MAPERR && signal == SIGSEGV) {
    append(reason, size, "memory fault at an address that cannot exist");
  } else {
    append(reason, size, signal == SIGBUS ? "bus error at address " : "memory fault at address ");
    append_address(reason, size, (uintptr_t)info->si_addr);
  }
}

/* Handling */

/* Faults of this thread itself, not signals that somebody sends. */
static int own_fault(int signal, const siginfo_t *info) {
  if (signal == SIGABRT)
    return info->si_pid == getpid();
  return info->si_code > 0;
}

static void die(int signal, const siginfo_t *info) {
  struct sigaction standard = {.sa_handler = SIG_DFL};
  sigaction(signal, &standard, NULL);
  /* A fault comes again when its instruction does; anything else is sent again. */
  if (info->si_code <= 0)
    raise(signal);
}

static void chain(int signal, siginfo_t *info, void *context) {
  usub_thread *thread = &usub_this_thread;
  int slot = 0;
  while (signals[slot] != signal)
    slot++;
  const struct sigaction *before = &earlier[slot];
  if (thread->chaining) { /* an earlier handler sent the signal on: two that chain to each other */
    die(signal, info);
    return;
  }
  thread->chaining = 1;
  if (before->sa_flags & SA_SIGINFO)
    before->sa_sigaction(signal, info, context);
  else if (before->sa_handler == SIG_DFL || (before->sa_handler == SIG_IGN && info->si_code > 0))
    die(signal, info);
  else if (before->sa_handler != SIG_IGN)
    before->sa_handler(signal);
  thread->chaining = 0;
}

static void handle(int signal, siginfo_t *info, void *context) {
  usub_guard *guard = usub_guard_top();
  if (guard == NULL || !atomic_load(&usub_faults_caught) || !own_fault(signal, info)) {
    chain(signal, info, context);
    return;
  }
  const usub_thread *thread = &usub_this_thread;
  const int32_t access = signal == SIGSEGV ? access_of(context) : USUB_ACCESS_UNKNOWN;
  if (signal == SIGSEGV && thread->mend &&
      thread->mend(thread->mend_context, (uintptr_t)info->si_addr, access, context))
    return;
  if (thread->placing) { /* nothing new: the search for the place of the first fault fell */
    usub_guard_jump(guard);
  }
  guard->status = USUB_ROUTINE_CRASHED;
  guard->access = access;
  describe(guard->reason, sizeof guard->reason, signal, info, context);
  if (signal == SIGSEGV)
    guard->fault = (uintptr_t)info->si_addr;
  usub_guard_note_place(guard, instruction(context));
  usub_guard_jump(guard);
}

int32_t usub_catch_faults(int32_t on) {
  pthread_mutex_lock(&lock);
  for (int i = 0; i < SIGNAL_COUNT && (on != 0) != atomic_load(&usub_faults_caught); i++) {
    struct sigaction present;
    sigaction(signals[i], NULL, &present);
    int ours = (present.sa_flags & SA_SIGINFO) && present.sa_sigaction == handle;
    if (on && !ours) {
      /* Not deferred: the handler is left by longjmp, which does not restore the signal mask. */
      struct sigaction action = {.sa_sigaction = handle,
                                 .sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER};
      earlier[i] = present;
      sigaction(signals[i], &action, NULL);
    } else if (!on && ours) {
      sigaction(signals[i], &earlier[i], NULL);
    }
  }
  atomic_store(&usub_faults_caught, on != 0);
  pthread_mutex_unlock(&lock);
  return USUB_OK;
}
