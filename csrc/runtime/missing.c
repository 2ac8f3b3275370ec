/* SPDX-License-Identifier: MIT */
/* Calls of functions that exist nowhere. Sources get a stand-in by name when they are linked;
 * libraries that were built without us get one of the slots below in place of what the loader would
 * not find (and would end the process for). */
#include "missing.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "thread.h"
#include "usersub/status.h"
#include "usersub/usersub.h"

void usub_missing_routine(const char *name) {
  usub_guard_leave(USUB_ROUTINE_STOPPED, "%s was called, which usersub does not provide", name);
}

enum { SLOTS = 64, LONGEST = 63 };
static char names[SLOTS][LONGEST + 1];
static int used;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

#define SLOT(n)                                                                                    \
  static void slot_##n(void) {                                                                     \
    usub_missing_routine(names[0##n]);                                                             \
  }
#define EIGHT(f, n) f(n##0) f(n##1) f(n##2) f(n##3) f(n##4) f(n##5) f(n##6) f(n##7)
#define ALL(f)                                                                                     \
  EIGHT(f, 0) EIGHT(f, 1) EIGHT(f, 2) EIGHT(f, 3) EIGHT(f, 4) EIGHT(f, 5) EIGHT(f, 6) EIGHT(f, 7)
ALL(SLOT)
#define ADDRESS(n) slot_##n,
static void (*const slots[SLOTS])(void) = {ALL(ADDRESS)};

void *usub_missing_slot(const char *symbol) {
  char name[LONGEST + 1];
  size_t length = strnlen(symbol, LONGEST);
  if (length > 1 && symbol[length - 1] == '_')
    length--; /* Fortran */
  for (size_t i = 0; i < length; i++)
    name[i] = symbol[i] >= 'a' && symbol[i] <= 'z' ? (char)(symbol[i] - 'a' + 'A') : symbol[i];
  name[length] = '\0';
  pthread_mutex_lock(&lock);
  int at = 0;
  while (at < used && strcmp(names[at], name) != 0)
    at++;
  if (at < SLOTS && at == used)
    memcpy(names[used++], name, sizeof name);
  pthread_mutex_unlock(&lock);
  if (at == SLOTS)
    return NULL;
  union {
    void (*function)(void);
    void *pointer;
  } place = {slots[at]};
  return place.pointer;
}
