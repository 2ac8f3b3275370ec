/* SPDX-License-Identifier: MIT */
/* Every way in which a routine can ask for the end of the program. With a guard armed the routine
 * is left and the host lives; without one the program ends as asked. User code reaches the
 * `__wrap_` functions because it is linked with --wrap for the names of wrap.txt, or because
 * `usub_redirect_stops` has pointed a library that was linked without it here. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "thread.h"
#include "usersub/status.h"

#define STOP(...) usub_guard_leave(USUB_ROUTINE_STOPPED, __VA_ARGS__)

/* Fortran strings have no NUL and may end in blanks. */
static int trimmed(const char *text, size_t length) {
  while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\0'))
    length--;
  return length < 200 ? (int)length : 200;
}

/* The two utility routines */

USUB_UTILITY _Noreturn void xit_(void) {
  STOP("XIT");
}
USUB_UTILITY _Noreturn void xplb_exit_(void) {
  STOP("XPLB_EXIT");
}

/* C and C++ */

USUB_UTILITY _Noreturn void __wrap_exit(int code) {
  if (usub_guard_armed())
    STOP("exit(%d)", code);
  exit(code);
}

USUB_UTILITY _Noreturn void __wrap__exit(int code) {
  if (usub_guard_armed())
    STOP("_exit(%d)", code);
  _exit(code);
}

USUB_UTILITY _Noreturn void __wrap__Exit(int code) {
  if (usub_guard_armed())
    STOP("_Exit(%d)", code);
  _Exit(code);
}

USUB_UTILITY _Noreturn void __wrap_quick_exit(int code) {
  if (usub_guard_armed())
    STOP("quick_exit(%d)", code);
  quick_exit(code);
}

USUB_UTILITY _Noreturn void __wrap_abort(void) {
  if (usub_guard_armed())
    STOP("abort");
  abort();
}

/* std::terminate, which C++ calls itself where an exception meets noexcept */
USUB_UTILITY _Noreturn void __wrap__ZSt9terminatev(void) {
  if (usub_guard_armed())
    STOP("std::terminate");
  abort();
}

USUB_UTILITY _Noreturn void __wrap___assert_fail(const char *expression, const char *file,
                                                 unsigned int line, const char *function) {
  STOP("assertion failed: %s, %s:%u%s%s", expression, file, line, function ? " in " : "",
       function ? function : "");
}

USUB_UTILITY _Noreturn void __wrap___stack_chk_fail(void) {
  usub_guard_leave(USUB_ROUTINE_CRASHED, "a local array was overrun");
}

/* gfortran: STOP, ERROR STOP, PAUSE, CALL EXIT, CALL ABORT; `quiet` is the specifier of STOP */

USUB_UTILITY _Noreturn void __wrap__gfortran_stop_numeric(int code, _Bool quiet) {
  (void)quiet;
  STOP("STOP %d", code);
}

USUB_UTILITY _Noreturn void __wrap__gfortran_stop_string(const char *text, size_t length,
                                                         _Bool quiet) {
  (void)quiet;
  int shown = trimmed(text, length);
  STOP("STOP%s%.*s", shown ? " " : "", shown, text ? text : "");
}

USUB_UTILITY _Noreturn void __wrap__gfortran_error_stop_numeric(int code, _Bool quiet) {
  (void)quiet;
  STOP("ERROR STOP %d", code);
}

USUB_UTILITY _Noreturn void __wrap__gfortran_error_stop_string(const char *text, size_t length,
                                                               _Bool quiet) {
  (void)quiet;
  int shown = trimmed(text, length);
  STOP("ERROR STOP%s%.*s", shown ? " " : "", shown, text ? text : "");
}

/* Nobody is there to type "go": PAUSE is a message. */
USUB_UTILITY void __wrap__gfortran_pause_numeric(int code) {
  usub_say(1, "PAUSE %d", code);
}

USUB_UTILITY void __wrap__gfortran_pause_string(const char *text, size_t length) {
  int shown = trimmed(text, length);
  usub_say(1, "PAUSE%s%.*s", shown ? " " : "", shown, text ? text : "");
}

USUB_UTILITY _Noreturn void __wrap__gfortran_exit_i4(const int32_t *code) {
  __wrap_exit(code ? *code : 0);
}

USUB_UTILITY _Noreturn void __wrap__gfortran_exit_i8(const int64_t *code) {
  __wrap_exit(code ? (int)*code : 0);
}

USUB_UTILITY _Noreturn void __wrap__gfortran_abort(void) {
  __wrap_abort();
}

/* gfortran: what compiled code finds wrong itself (bounds, allocation) */

static _Noreturn void runtime_error(const char *where, const char *message, va_list args) {
  char text[200];
  vsnprintf(text, sizeof text, message, args);
  STOP("Fortran runtime error: %s%s%s", where, *where ? ": " : "", text);
}

USUB_UTILITY _Noreturn void __wrap__gfortran_runtime_error(const char *message, ...) {
  va_list args;
  va_start(args, message);
  runtime_error("", message, args);
}

USUB_UTILITY _Noreturn void __wrap__gfortran_runtime_error_at(const char *where,
                                                              const char *message, ...) {
  va_list args;
  va_start(args, message);
  runtime_error(where, message, args);
}

USUB_UTILITY _Noreturn void __wrap__gfortran_os_error_at(const char *where, const char *message,
                                                         ...) {
  va_list args;
  va_start(args, message);
  runtime_error(where, message, args);
}

USUB_UTILITY _Noreturn void __wrap__gfortran_os_error(const char *message) {
  STOP("Fortran runtime error: %s", message);
}

USUB_UTILITY void __wrap__gfortran_runtime_warning_at(const char *where, const char *message, ...) {
  char text[200];
  va_list args;
  va_start(args, message);
  vsnprintf(text, sizeof text, message, args);
  va_end(args);
  usub_say(-1, "Fortran runtime warning: %s: %s", where, text);
}
