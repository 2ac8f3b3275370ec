/* SPDX-License-Identifier: MIT */
/* The argument tables, with the dimensions as positions of the arguments that they are. */
#include <ctype.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "probe.h"

/* The lists of the drivers, read with macros of our own. */
#define USUB_KIND_REAL USUB_PROBE_REAL
#define USUB_KIND_INT USUB_PROBE_INT
#define USUB_KIND_CHAR USUB_PROBE_CHAR
#define USUB_INTENT_READ USUB_PROBE_READ
#define USUB_INTENT_WRITE USUB_PROBE_WRITE
#define USUB_INTENT_READWRITE (USUB_PROBE_READ | USUB_PROBE_WRITE)

typedef struct row {
  const char *name, *newer, *shape;
  int32_t kind, intent;
} row;

#define INTERFACE_BEGIN(key, name, generation, solver, driver, count)                              \
  static const row key##_rows[] = {
#define ARG(older, newer, kind, shape, intent) {older, newer, shape, kind, intent},
#define INTERFACE_END(key)                                                                         \
  }                                                                                                \
  ;
#include "../driver/interfaces.inc"
#undef INTERFACE_BEGIN
#undef ARG
#undef INTERFACE_END

static const struct {
  const char *name, *solver;
  const row *rows;
  int32_t count;
} lists[] = {
#define INTERFACE_BEGIN(key, name, generation, solver, driver, count)                              \
  {name, solver, key##_rows, count},
#define ARG(older, newer, kind, shape, intent)
#define INTERFACE_END(key)
#include "../driver/interfaces.inc"
};

static usub_probe_interface faces[USUB_INTERFACE_COUNT];
static pthread_once_t once = PTHREAD_ONCE_INIT;

static int32_t position_of(const row *rows, int32_t count, const char *name, size_t length) {
  for (int32_t i = 0; i < count; ++i)
    if (strlen(rows[i].name) == length && strncasecmp(rows[i].name, name, length) == 0)
      return i;
  return -1;
}

/* One dimension: a number, the name of a count, or number + name(element). */
static void read_dimension(usub_probe_argument *made, const row *rows, int32_t count,
                           const char *text, size_t length) {
  int32_t *dimension = &made->dimension[made->rank++];
  const char *plus = memchr(text, '+', length);
  if (plus) {
    made->plus = (int32_t)strtol(text, NULL, 10);
    const char *name = plus + 1, *open = memchr(name, '(', length - (size_t)(name - text));
    made->element = (int32_t)strtol(open + 1, NULL, 10) - 1;
    *dimension = -1 - position_of(rows, count, name, (size_t)(open - name));
  } else if (isdigit((unsigned char)*text)) {
    *dimension = (int32_t)strtol(text, NULL, 10);
  } else {
    *dimension = -1 - position_of(rows, count, text, length);
  }
}

static void make(void) {
  for (int32_t key = 0; key < USUB_INTERFACE_COUNT; ++key) {
    usub_probe_interface *face = &faces[key];
    face->name = lists[key].name;
    face->count = lists[key].count;
    face->standard = strcmp(lists[key].solver, "standard") == 0;
    for (int32_t i = 0; i < face->count; ++i) {
      const row *from = &lists[key].rows[i];
      usub_probe_argument *to = &face->argument[i];
      to->name = from->newer;
      to->kind = from->kind;
      to->intent = from->intent;
      for (const char *at = from->shape; *at;) {
        const size_t length = strcspn(at, ",");
        read_dimension(to, lists[key].rows, face->count, at, length);
        at += length + (at[length] == ',');
      }
    }
  }
}

const usub_probe_interface *usub_probe_interface_of(int32_t key) {
  pthread_once(&once, make);
  return &faces[key];
}

size_t usub_probe_element(const usub_probe_call *call, int32_t position) {
  const int32_t kind = call->face->argument[position].kind;
  if (kind == USUB_PROBE_REAL)
    return call->single ? sizeof(float) : sizeof(double);
  return kind == USUB_PROBE_INT ? sizeof(int32_t) : USUB_NAME_LENGTH;
}
