/* SPDX-License-Identifier: MIT */
/** @file watch.h
 * A time limit on the calls of a thread.
 */
#ifndef USERSUB_RUNTIME_WATCH_H
#define USERSUB_RUNTIME_WATCH_H

/** From now on the thread has this long before it leaves to its innermost guard, with `late` 1. The
 * time is that of its processor; a routine that waits for something has five times as long.
 * Nothing happens where the system has no timers for threads, or with seconds of 0 or less. */
void usub_watch_start(double seconds);
/** Ends the limit. */
void usub_watch_stop(void);

#endif
