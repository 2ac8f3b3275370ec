/* SPDX-License-Identifier: MIT */
/* Routines that do not come back, as users write them. */
#include <assert.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

extern void xit_(void);
extern void xplb_exit_(void);
extern void stdb_abqerr_(int *, const char *, int *, double *, const char *, size_t, size_t);
extern void MutexInit(int);
extern void MutexLock(int);

static volatile int zero;
static int *volatile nowhere;

void fine(void) {}
void call_xit(void) {
  xit_();
}
void call_xplb_exit(void) {
  xplb_exit_();
}
void call_exit(void) {
  exit(7);
}
void call_underscore_exit(void) {
  _exit(8);
}
void call_quick_exit(void) {
  quick_exit(9);
}
void call_abort(void) {
  abort();
}
void call_assert(void) {
  assert(zero == 1);
}

void call_fatal(void) {
  int kind = -3, integers[] = {17};
  double reals[] = {0.25};
  stdb_abqerr_(&kind, "point %I has p = %R on %S", integers, reals, "UPPER   ", 25, 8);
}

/* The next call would wait for ever if the mutex stayed locked. */
void stop_with_mutex(void) {
  MutexInit(3);
  MutexLock(3);
  exit(1);
}

void lock_twice(void) {
  MutexInit(4);
  MutexLock(4);
  MutexLock(4);
}

void lock_wrong_number(void) {
  MutexLock(101);
}

void divide(void) {
  zero = 17 / zero;
}
void read_zero(void) {
  zero = *nowhere;
}

void write_constant(void) {
  static const char text[] = "constant";
  *(volatile char *)(size_t)text = 'C';
}

void trap(void) {
  __builtin_trap();
}

static int deep(volatile char *below) {
  volatile char here[4096];
  memset((char *)here, below[0], sizeof here);
  return deep(here) + here[17];
}

void overflow_stack(void) {
  volatile char start[1] = {0};
  zero = deep(start) * 0;
}

/* One frame that leaps over the guard page. */
void huge_frame(void) {
  volatile char frame[512 << 20];
  frame[0] = 1;
  zero = frame[0] - 1;
}
