/* SPDX-License-Identifier: MIT */
/* What routines ask about part, job and machine, and what they say. Fortran calls these with the
 * lengths of its character arguments behind all others; C may leave those out, so a length is only
 * believed if it can be true. */
#include <stdio.h>
#include <string.h>

#include "thread.h"
#include "usersub/status.h"

/* `text` into a Fortran character variable of `stated` characters, `usual` if that cannot be. */
static void fill(char *variable, size_t stated, size_t usual, const char *text) {
  size_t length = stated >= 1 && stated <= usual ? stated : usual;
  size_t used = strnlen(text, length);
  memcpy(variable, text, used);
  memset(variable + used, ' ', length - used);
}

/* Part, job, machine */

/* No part instances: the name is blank and the local number is the given one. */
USUB_UTILITY void getpartinfo_(const int *number, const int *kind, char *name, int *local,
                               int *failed, size_t name_length) {
  (void)kind; /* 0 node, 1 element */
  fill(name, name_length, 80, "");
  *local = *number;
  *failed = *number < 1;
}

USUB_UTILITY void vgetpartinfo_(const int *number, const int *kind, char *name, int *local,
                                int *failed, size_t name_length) {
  getpartinfo_(number, kind, name, local, failed, name_length);
}

USUB_UTILITY void getjobname_(char *name, int *used, size_t name_length) {
  char text[257];
  usub_job_name(text, sizeof text);
  fill(name, name_length, 256, text);
  *used = (int)strlen(text);
}

USUB_UTILITY void getoutdir_(char *folder, int *used, size_t folder_length) {
  char text[257];
  usub_job_folder(text, sizeof text);
  fill(folder, folder_length, 256, text);
  *used = (int)strlen(text);
}

USUB_UTILITY void vgetjobname_(char *name, int *used, size_t name_length) {
  getjobname_(name, used, name_length);
}

USUB_UTILITY void vgetoutdir_(char *folder, int *used, size_t folder_length) {
  getoutdir_(folder, used, folder_length);
}

/* Processes of the job, not threads: every host process is a job of its own. */
USUB_UTILITY void getrank_(int *rank) {
  *rank = 0;
}
USUB_UTILITY void vgetrank_(int *rank) {
  *rank = 0;
}
USUB_UTILITY void getnumcpus_(int *processes) {
  *processes = 1;
}
USUB_UTILITY void vgetnumcpus_(int *processes) {
  *processes = 1;
}

USUB_UTILITY int get_thread_id_(void) {
  return usub_thread_index();
}
USUB_UTILITY int getnumthreads_(void) {
  return usub_thread_count();
}
USUB_UTILITY int get_thread_id(void) {
  return usub_thread_index();
}
USUB_UTILITY int getNumThreads(void) {
  return usub_thread_count();
}

/* Messages */

/** The values that %I, %R and %S take one after the other. */
typedef struct usub_values {
  const int *integers;
  const void *reals;
  int single;
  const char *names;
  size_t name_length;
} usub_values;

static void print_value(char **end, size_t room, char letter, usub_values *next) {
  char *text = *end;
  int length = 0;
  if (letter == 'I') {
    length = snprintf(text, room, "%d", *next->integers++);
  } else if (letter == 'R' && next->single) {
    float value;
    memcpy(&value, next->reals, sizeof value);
    next->reals = (const char *)next->reals + sizeof value;
    length = snprintf(text, room, "%.7g", (double)value);
  } else if (letter == 'R') {
    double value;
    memcpy(&value, next->reals, sizeof value);
    next->reals = (const char *)next->reals + sizeof value;
    length = snprintf(text, room, "%.12g", value);
  } else {
    int used = (int)next->name_length;
    while (used > 0 && next->names[used - 1] == ' ')
      used--;
    length = snprintf(text, room, "%.*s", used, next->names);
    next->names += next->name_length;
  }
  *end += length < (int)room ? length : (int)room - 1;
}

static void print(char *text, size_t size, const char *format, size_t length, usub_values *next) {
  char *end = text, *last = text + size - 1;
  for (size_t i = 0; i < length && end < last; i++) {
    char letter = i + 1 < length && format[i] == '%' ? format[i + 1] : ' ';
    if (letter == 'I' || letter == 'R' || letter == 'S') {
      print_value(&end, (size_t)(last - end) + 1, letter, next);
      i++;
    } else {
      *end++ = format[i];
    }
  }
  *end = '\0';
}

static void say(const char *call, const int *kind, const char *format, size_t length,
                usub_values *values) {
  enum { LONGEST = 4000 };
  char text[LONGEST + 1];
  if (length > LONGEST) /* C without lengths */
    length = strnlen(format, LONGEST);
  while (length > 0 && (format[length - 1] == ' ' || format[length - 1] == '\0'))
    length--;
  print(text, sizeof text, format, length, values);
  int level = *kind >= -3 && *kind <= -1 ? *kind : 1;
  if (level == -3 && !usub_guard_armed())
    usub_guard_leave(USUB_ROUTINE_STOPPED, "%s: %.200s", call, text);
  usub_say(level, "%s", text);
  if (level == -3)
    usub_guard_leave(USUB_ROUTINE_STOPPED, "%s: %.200s", call, text);
}

/* Names are CHARACTER*8; a shorter literal is taken at its own length. */
static size_t name_length(size_t stated) {
  return stated >= 1 && stated < 8 ? stated : 8;
}

USUB_UTILITY void stdb_abqerr_(const int *kind, const char *format, const int *integers,
                               const double *reals, const char *names, size_t format_length,
                               size_t names_length) {
  usub_values values = {integers, reals, 0, names, name_length(names_length)};
  say("STDB_ABQERR", kind, format, format_length, &values);
}

/* `reals` are in the precision of the routine, which only the driver knows: it tells the guard.
 * Outside of a driver they are double. */
USUB_UTILITY void xplb_abqerr_(const int *kind, const char *format, const int *integers,
                               const void *reals, const char *names, size_t format_length,
                               size_t names_length) {
  const usub_guard *guard = usub_guard_top();
  usub_values values = {integers, reals, guard != NULL && guard->single, names,
                        name_length(names_length)};
  say("XPLB_ABQERR", kind, format, format_length, &values);
}
