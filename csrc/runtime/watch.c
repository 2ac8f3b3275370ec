/* SPDX-License-Identifier: MIT */
#include "watch.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "thread.h"
#include "usersub/status.h"

#if defined(__linux__)
#include <sys/syscall.h>
#include <ucontext.h>

#ifndef sigev_notify_thread_id
#define sigev_notify_thread_id _sigev_un._tid
#endif

/* A routine that uses no processor time waits, or has none because others do. */
enum { PATIENCE = 5, TIMERS = 2 };

typedef struct usub_watch {
  timer_t timers[TIMERS];        /* by the time of the processor, and by that of the wall */
  pid_t process;                 /* that made them; a forked child has none */
  int32_t ready;                 /* 1 made, -1 impossible */
  volatile sig_atomic_t running; /* a limit is on */
} usub_watch;

static const clockid_t clocks[TIMERS] = {CLOCK_THREAD_CPUTIME_ID, CLOCK_MONOTONIC};
static _Thread_local usub_watch mine __attribute__((tls_model("initial-exec")));
static pthread_once_t once = PTHREAD_ONCE_INIT;
static pthread_key_t key;
static int alarm_signal; /* 0: none is free */

static void handle(int number, siginfo_t *info, void *context) {
  (void)number;
  usub_guard *guard = usub_this_thread.guard;
  usub_watch *watch = &mine;
  if (!watch->running || !guard || info->si_code != SI_TIMER)
    return;
  watch->running = 0;
  guard->status = USUB_ROUTINE_CRASHED;
  guard->late = 1;
  memcpy(guard->reason, "no return", sizeof "no return");
#if defined(__x86_64__)
  const ucontext_t *machine = context;
  usub_guard_note_place(guard, (uintptr_t)machine->uc_mcontext.gregs[REG_RIP]);
#else
  (void)context;
  usub_guard_note_place(guard, 0);
#endif
  usub_guard_jump(guard);
}

static void drop(void *value) {
  const usub_watch *watch = value;
  for (int i = 0; i < TIMERS && watch->ready == 1 && watch->process == getpid(); ++i)
    timer_delete(watch->timers[i]);
}

/* Takes a real-time signal that nobody uses. */
static void prepare(void) {
  for (int number = SIGRTMIN + 3; !alarm_signal && number < SIGRTMAX; ++number) {
    struct sigaction present;
    if (sigaction(number, NULL, &present) != 0 || (present.sa_flags & SA_SIGINFO) ||
        present.sa_handler != SIG_DFL)
      continue;
    /* Not deferred: the handler is left by longjmp, which does not restore the signal mask. */
    struct sigaction action = {.sa_sigaction = handle,
                               .sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER | SA_RESTART};
    if (sigaction(number, &action, NULL) == 0)
      alarm_signal = number;
  }
  if (pthread_key_create(&key, drop) != 0)
    alarm_signal = 0;
}

static int make_timers(usub_watch *watch) {
  pthread_once(&once, prepare);
  watch->process = getpid();
  watch->ready = -1;
  if (!alarm_signal)
    return 0;
  struct sigevent event;
  memset(&event, 0, sizeof event);
  event.sigev_notify = SIGEV_THREAD_ID;
  event.sigev_signo = alarm_signal;
  event.sigev_notify_thread_id = (pid_t)syscall(SYS_gettid);
  for (int i = 0; i < TIMERS; ++i)
    if (timer_create(clocks[i], &event, &watch->timers[i]) != 0)
      return 0;
  sigset_t set; /* threads of a pool block what is not a fault */
  sigemptyset(&set);
  sigaddset(&set, alarm_signal);
  pthread_sigmask(SIG_UNBLOCK, &set, NULL);
  pthread_setspecific(key, watch);
  watch->ready = 1;
  return 1;
}

static void set_timers(const usub_watch *watch, double seconds) {
  for (int i = 0; i < TIMERS; ++i) {
    struct itimerspec spec = {{0, 0}, {0, 0}};
    spec.it_value.tv_sec = (time_t)floor(seconds);
    spec.it_value.tv_nsec = (long)(1e9 * (seconds - floor(seconds)));
    timer_settime(watch->timers[i], 0, &spec, NULL);
    seconds *= PATIENCE;
  }
}

void usub_watch_start(double seconds) {
  usub_watch *watch = &mine;
  if (!(seconds > 0))
    return;
  if (watch->ready == 0 || watch->process != getpid())
    make_timers(watch);
  if (watch->ready != 1)
    return;
  watch->running = 1;
  /* Below a microsecond it would be none; above three years it may be too much for a timer. */
  set_timers(watch, seconds < 1e-6 ? 1e-6 : seconds < 1e8 ? seconds : 1e8);
}

void usub_watch_stop(void) {
  usub_watch *watch = &mine;
  if (!watch->running && watch->ready != 1)
    return;
  watch->running = 0;
  set_timers(watch, 0);
}

#else

void usub_watch_start(double seconds) {
  (void)seconds;
}
void usub_watch_stop(void) {}

#endif
