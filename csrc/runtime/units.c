/* SPDX-License-Identifier: MIT */
/* Statements of Fortran input and output (gfortran). Its run-time library ends the program on an
 * error for which a routine has neither IOSTAT= nor ERR=; so such a statement gets an IOSTAT=, and
 * the routine is stopped when the statement is done and has failed. And a routine that stops within
 * a WRITE, in a function of its list for example, leaves the unit locked, so that the next use of
 * it would wait for ever; so each statement is noted until it is done, and ended for the routine.
 *
 * Routines reach the functions here as they reach those of stop.c. Statements of the host, or of
 * user code that no driver called, go to the library as they are. */
#include "units.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "thread.h"
#include "usersub/status.h"

/* Statements within statements; bytes of a parameter block that a statement needs to be ended. */
enum { DEPTH = 8, BYTES = 1024, LONGEST = 160 };
/* Flags of a parameter block: result (1 error, 2 end of file, 3 end of record), labels for each of
 * them from bit 2 on, what the statement has. */
enum { RESULT = 3, HAS_IOSTAT = 1 << 5, HAS_IOMSG = 1 << 6 };

/** How every parameter block begins. */
typedef struct common {
  int flags, unit;
  const char *file;
  int line;
  size_t message_length;
  char *message;
  int *iostat;
} common;

typedef void (*statement_fn)(void *block);

typedef struct outcome {
  int armed, iostat;
  char message[LONGEST + 1];
} outcome;

/** Statements of a thread that are not done. */
typedef struct statements {
  int count;
  struct {
    char *block;
    statement_fn done;
    outcome outcome;
    char copy[BYTES];
  } open[DEPTH];
} statements;

/* Allocated when a thread first needs it: thread-local memory of a library that is loaded late is
 * scarce. */
static _Thread_local statements *of_this_thread;
static pthread_key_t key;
static pthread_once_t once = PTHREAD_ONCE_INIT;

static void make_key(void) {
  pthread_key_create(&key, free);
}

static statements *my_statements(void) {
  if (of_this_thread == NULL) {
    pthread_once(&once, make_key);
    of_this_thread = calloc(1, sizeof *of_this_thread);
    pthread_setspecific(key, of_this_thread);
  }
  return of_this_thread;
}

enum {
  WRITE,
  WRITE_DONE,
  READ,
  READ_DONE,
  OPEN,
  CLOSE,
  INQUIRE,
  REWIND,
  BACKSPACE,
  ENDFILE,
  KINDS
};
static const char *const names[KINDS] = {"_gfortran_st_write",     "_gfortran_st_write_done",
                                         "_gfortran_st_read",      "_gfortran_st_read_done",
                                         "_gfortran_st_open",      "_gfortran_st_close",
                                         "_gfortran_st_inquire",   "_gfortran_st_rewind",
                                         "_gfortran_st_backspace", "_gfortran_st_endfile"};
static _Atomic(statement_fn) found[KINDS];

typedef union pointer {
  void *data;
  statement_fn function;
} pointer;

static void find(int kind, void *library) {
  const pointer place = {.data = dlsym(library, names[kind])};
  if (place.data != NULL)
    atomic_store(&found[kind], place.function);
}

void usub_units_find(void *library) {
  for (int kind = 0; kind < KINDS; kind++)
    if (atomic_load(&found[kind]) == NULL)
      find(kind, library);
}

static statement_fn real(int kind) {
  if (atomic_load(&found[kind]) == NULL)
    find(kind, RTLD_DEFAULT);
  const statement_fn function = atomic_load(&found[kind]);
  if (function == NULL)
    usub_guard_leave(USUB_ROUTINE_STOPPED, "%s is nowhere", names[kind]);
  return function;
}

static void arm(common *block, outcome *result) {
  result->armed = !(block->flags & HAS_IOSTAT);
  result->iostat = 0;
  if (!result->armed)
    return;
  memset(result->message, 0, sizeof result->message);
  block->flags |= HAS_IOSTAT;
  block->iostat = &result->iostat;
  if (block->flags & HAS_IOMSG)
    return;
  block->flags |= HAS_IOMSG;
  block->message = result->message;
  block->message_length = LONGEST;
}

/* Stops the routine if the statement has failed and has no label for that. */
static void judge(const common *block, const outcome *result) {
  const int how = block->flags & RESULT;
  if (!result->armed || result->iostat == 0 || (how && block->flags & 2 << how))
    return;
  char text[LONGEST + 1];
  int length = LONGEST;
  memcpy(text, result->message, sizeof text);
  while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\0'))
    text[--length] = '\0';
  for (char *at = text; *at; at++)
    if (*at == '\n')
      *at = ' ';
  usub_guard_leave(USUB_ROUTINE_STOPPED, "Fortran runtime error: %s (%s, line %d)", text,
                   block->file, block->line);
}

/* Ends statements in stack frames that are gone: all that lie beyond `here`. */
static void end_beyond(statements *mine, const char *here) {
  while (mine->count > 0 && mine->open[mine->count - 1].block < here) {
    mine->count--;
    mine->open[mine->count].done(mine->open[mine->count].copy);
  }
}

void usub_units_end_statements(void) {
  if (of_this_thread != NULL)
    end_beyond(of_this_thread, (const char *)UINTPTR_MAX);
}

static void begin(char *block, int kind) {
  const statement_fn start = real(kind);
  statements *mine = usub_guard_armed() ? my_statements() : NULL;
  char here;
  if (mine != NULL)
    end_beyond(mine, &here);
  if (mine == NULL || mine->count == DEPTH) {
    start(block);
    return;
  }
  const int level = mine->count++;
  mine->open[level].block = block;
  mine->open[level].done = real(kind + 1);
  arm((common *)block, &mine->open[level].outcome);
  start(block);
  memcpy(mine->open[level].copy, block, BYTES);
}

static void end(char *block, int kind) {
  statements *mine = of_this_thread;
  real(kind)(block);
  if (mine == NULL || mine->count == 0 || mine->open[mine->count - 1].block != block)
    return;
  mine->count--;
  judge((common *)block, &mine->open[mine->count].outcome);
}

static void alone(void *block, int kind) {
  const statement_fn statement = real(kind);
  outcome result;
  char here;
  if (!usub_guard_armed()) {
    statement(block);
    return;
  }
  if (of_this_thread != NULL)
    end_beyond(of_this_thread, &here);
  arm(block, &result);
  statement(block);
  judge(block, &result);
}

USUB_UTILITY void __wrap__gfortran_st_write(char *block) {
  begin(block, WRITE);
}
USUB_UTILITY void __wrap__gfortran_st_write_done(char *block) {
  end(block, WRITE_DONE);
}
USUB_UTILITY void __wrap__gfortran_st_read(char *block) {
  begin(block, READ);
}
USUB_UTILITY void __wrap__gfortran_st_read_done(char *block) {
  end(block, READ_DONE);
}
USUB_UTILITY void __wrap__gfortran_st_open(void *block) {
  alone(block, OPEN);
}
USUB_UTILITY void __wrap__gfortran_st_close(void *block) {
  alone(block, CLOSE);
}
USUB_UTILITY void __wrap__gfortran_st_inquire(void *block) {
  alone(block, INQUIRE);
}
USUB_UTILITY void __wrap__gfortran_st_rewind(void *block) {
  alone(block, REWIND);
}
USUB_UTILITY void __wrap__gfortran_st_backspace(void *block) {
  alone(block, BACKSPACE);
}
USUB_UTILITY void __wrap__gfortran_st_endfile(void *block) {
  alone(block, ENDFILE);
}
