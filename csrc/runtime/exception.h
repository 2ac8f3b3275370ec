/* SPDX-License-Identifier: MIT */
/** @file exception.h
 * Exceptions that leave a routine end at the guard, like a stop.
 */
#ifndef USERSUB_RUNTIME_EXCEPTION_H
#define USERSUB_RUNTIME_EXCEPTION_H

/** At the beginning of a function that arms a guard (and that must not be inlined): an exception
 * that reaches it leaves to the innermost guard of the thread, with USUB_ROUTINE_RAISED. Elsewhere
 * than in ELF on x86-64 and aarch64 it goes its way. */
#if defined(__ELF__) && defined(__GNUC__) && (defined(__x86_64__) || defined(__aarch64__))
#define USUB_HAS_PERSONALITY 1
/* 0x1b: the address of the personality relative to the place, in four bytes. */
#define USUB_ENDS_EXCEPTIONS __asm__ volatile(".cfi_personality 0x1b, usub_personality")
#else
#define USUB_HAS_PERSONALITY 0
#define USUB_ENDS_EXCEPTIONS ((void)0)
#endif

#endif
