/* SPDX-License-Identifier: MIT */
/** @file guard.h
 * A place to come back to when a routine does not return: XIT, STOP, exit, abort, a fault.
 *
 *     usub_guard guard;
 *     usub_guard_push(&guard);
 *     guard.single = 1;                 (only for routines in single precision)
 *     if (sigsetjmp(guard.env, 0) == 0) {
 *       calls of the routine
 *     } else {
 *       guard.status, guard.reason say what happened
 *     }
 *     usub_guard_pop(&guard);
 *
 * Guards form a stack per thread; a routine leaves to the innermost one of its own thread. Locals
 * that the calls change and that are read afterwards have to be volatile, as always with setjmp.
 * Everything between the guard and the routine is left without clean-up: no frame there may hold a
 * lock or memory of its own. Mutexes of the utility routines that the thread still holds are
 * unlocked, and the floating-point control word is put back.
 */
#ifndef USERSUB_RUNTIME_GUARD_H
#define USERSUB_RUNTIME_GUARD_H

#include <setjmp.h>
#include <stdint.h>

typedef struct usub_guard {
  sigjmp_buf env;
  int32_t status;           /* USUB_ROUTINE_STOPPED, USUB_ROUTINE_CRASHED */
  int32_t single;           /* 1: the routine is in single precision (REALV of XPLB_ABQERR) */
  uintptr_t fault;          /* address of a memory fault, 0 if it was none */
  int32_t access;           /* of a memory fault: USUB_ACCESS_... */
  int32_t late;             /* the time limit ended the call */
  uintptr_t place;          /* instruction that left, 0 if it is not known */
  uintptr_t code[2];        /* first and last address of the code in which `place` is looked for */
  uint64_t float_control;   /* rounding and trap settings of the caller */
  struct usub_guard *outer; /* the guard below this one */
  char reason[256];         /* "XIT", "STOP 3", "integer division by zero"; no full stop */
} usub_guard;

/** Arms `guard` for this thread; status 0, reason "", single 0, fault 0, no code. */
void usub_guard_push(usub_guard *guard);
/** Disarms it, and whatever was armed above it. */
void usub_guard_pop(usub_guard *guard);
/** 1 if this thread has a guard. */
int usub_guard_armed(void);
/** Leaves to the innermost guard of this thread with a status and a reason. Without a guard the
 * reason goes to the message handler and the process exits with 1. */
_Noreturn void usub_guard_leave(int32_t status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/** The innermost guard of this thread, or NULL. */
usub_guard *usub_guard_top(void);
/** `instruction`, or if that is elsewhere than in `code` (a library that the routine calls), the
 * innermost call from there, if there is one. For signal handlers. */
uintptr_t usub_place_in(const uintptr_t code[2], uintptr_t instruction);
/** Notes where the routine was when it left. */
void usub_guard_note_place(usub_guard *guard, uintptr_t instruction);
/** Leaves to an armed guard whose status and reason are already set; safe in signal handlers. */
_Noreturn void usub_guard_jump(usub_guard *guard);

#endif
