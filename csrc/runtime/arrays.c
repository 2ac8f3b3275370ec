/* SPDX-License-Identifier: MIT */
/* Allocatable arrays of routines: SMA[Local]{Int,Float,Struct}Array{Create,Access,Size,Delete}.
 *
 * An array is known by a number of the routine's choice, separately for each kind. Global arrays
 * are seen by all threads, local ones by the thread that made them. They live until they are
 * deleted, the job ends (usub_end_job) or, if local, their thread does. Creating an array that
 * exists changes its length: the common part keeps its values, the rest gets the initial value, and
 * the address stays unless it grows. Not confirmed by any source: a length that changes, the
 * initial value of real arrays (NaN) and of items of a structure (zero bytes) where none is given.
 */
#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "thread.h"
#include "usersub/usersub.h"

enum { INTS, FLOATS, STRUCTS, KINDS };

typedef struct array {
  int id;
  size_t count, capacity, item; /* items, items that fit, bytes of an item */
  char *data;
} array;

/** Arrays of one kind, in ascending order of their numbers. */
typedef struct table {
  array *rows;
  size_t count, capacity;
} table;

/** All arrays of one scope: the process, or a thread. */
typedef struct scope {
  table kinds[KINDS];
  int job; /* the job that they belong to */
} scope;

static scope global;
static pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;
static atomic_int jobs;
static pthread_key_t local_key;
static pthread_once_t once = PTHREAD_ONCE_INIT;

static void clear(scope *arrays) {
  for (int kind = 0; kind < KINDS; kind++) {
    table *rows = &arrays->kinds[kind];
    for (size_t i = 0; i < rows->count; i++)
      free(rows->rows[i].data);
    free(rows->rows);
    *rows = (table){0};
  }
}

static void free_local(void *local) {
  clear(local);
  free(local);
}

static void make_key(void) {
  pthread_key_create(&local_key, free_local);
}

/* NULL if memory is exhausted. */
static scope *local_scope(void) {
  pthread_once(&once, make_key);
  scope *local = pthread_getspecific(local_key);
  int job = atomic_load(&jobs);
  if (local == NULL) {
    local = calloc(1, sizeof *local);
    if (local == NULL || pthread_setspecific(local_key, local) != 0) {
      free(local);
      return NULL;
    }
  } else if (local->job != job) {
    clear(local);
  }
  local->job = job;
  return local;
}

/* Row of the first number that is not below `id`. */
static size_t place(const table *arrays, int id) {
  size_t low = 0, high = arrays->count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (arrays->rows[middle].id < id)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static array *find(const table *arrays, int id) {
  size_t row = place(arrays, id);
  return row < arrays->count && arrays->rows[row].id == id ? &arrays->rows[row] : NULL;
}

static array *insert(table *arrays, int id) {
  if (arrays->count == arrays->capacity) {
    size_t capacity = arrays->capacity ? 2 * arrays->capacity : 8;
    array *rows = realloc(arrays->rows, capacity * sizeof *rows);
    if (rows == NULL)
      return NULL;
    arrays->rows = rows;
    arrays->capacity = capacity;
  }
  size_t row = place(arrays, id);
  memmove(&arrays->rows[row + 1], &arrays->rows[row], (arrays->count - row) * sizeof(array));
  arrays->count++;
  arrays->rows[row] = (array){.id = id};
  return &arrays->rows[row];
}

static void drop(table *arrays, int id) {
  array *found = find(arrays, id);
  if (found == NULL)
    return;
  free(found->data);
  memmove(found, found + 1, (size_t)(arrays->rows + arrays->count - found - 1) * sizeof(array));
  arrays->count--;
}

/* Address of the array, NULL if memory is exhausted. */
static void *resize(table *arrays, int id, size_t count, size_t item, const void *value) {
  array *found = find(arrays, id);
  if (found == NULL)
    found = insert(arrays, id);
  if (found == NULL)
    return NULL;
  if (found->item != item) {
    free(found->data);
    *found = (array){.id = id, .item = item};
  }
  if (count > found->capacity) {
    char *data = count <= SIZE_MAX / item ? realloc(found->data, count * item) : NULL;
    if (data == NULL) {
      if (found->data == NULL)
        drop(arrays, id);
      return NULL;
    }
    found->data = data;
    found->capacity = count;
  }
  for (size_t i = found->count; i < count; i++) {
    if (value != NULL)
      memcpy(found->data + i * item, value, item);
    else
      memset(found->data + i * item, 0, item);
  }
  found->count = count;
  return found->data;
}

static void *create(const char *call, int local, int kind, int id, int64_t count, int64_t item,
                    const void *value) {
  if (count < 1 || item < 1)
    usub_guard_leave(USUB_ROUTINE_STOPPED, "%s: array %d of %lld items of %lld bytes", call, id,
                     (long long)count, (long long)item);
  void *data = NULL;
  if (local) {
    scope *arrays = local_scope();
    if (arrays != NULL)
      data = resize(&arrays->kinds[kind], id, (size_t)count, (size_t)item, value);
  } else {
    pthread_rwlock_wrlock(&lock);
    data = resize(&global.kinds[kind], id, (size_t)count, (size_t)item, value);
    pthread_rwlock_unlock(&lock);
  }
  if (data == NULL)
    usub_guard_leave(USUB_ROUTINE_STOPPED, "%s: no memory for array %d of %lld items of %lld bytes",
                     call, id, (long long)count, (long long)item);
  return data;
}

/* A copy; all zeros if there is no such array. */
static array look(int local, int kind, int id) {
  array answer = {0};
  scope *arrays = local ? local_scope() : &global;
  if (arrays == NULL)
    return answer;
  if (!local)
    pthread_rwlock_rdlock(&lock);
  const array *found = find(&arrays->kinds[kind], id);
  if (found != NULL)
    answer = *found;
  if (!local)
    pthread_rwlock_unlock(&lock);
  return answer;
}

static void delete (int local, int kind, int id) {
  scope *arrays = local ? local_scope() : &global;
  if (arrays == NULL)
    return;
  if (!local)
    pthread_rwlock_wrlock(&lock);
  drop(&arrays->kinds[kind], id);
  if (!local)
    pthread_rwlock_unlock(&lock);
}

void usub_end_job(void) {
  pthread_rwlock_wrlock(&lock);
  clear(&global);
  pthread_rwlock_unlock(&lock);
  atomic_fetch_add(&jobs, 1);
}

/* What routines call: C by value, Fortran by reference, addresses as 8-byte integers. */

#define ACCESS(Name, name, type, local, kind)                                                      \
  USUB_UTILITY type *Name##Access(int id) {                                                        \
    return (type *)(void *)look(local, kind, id).data;                                             \
  }                                                                                                \
  USUB_UTILITY size_t Name##Size(int id) {                                                         \
    return look(local, kind, id).count;                                                            \
  }                                                                                                \
  USUB_UTILITY void Name##Delete(int id) {                                                         \
    delete (local, kind, id);                                                                      \
  }                                                                                                \
  USUB_UTILITY int64_t name##access_(const int *id) {                                              \
    return (int64_t)(intptr_t)look(local, kind, *id).data;                                         \
  }                                                                                                \
  USUB_UTILITY int64_t name##size_(const int *id) {                                                \
    return (int64_t)look(local, kind, *id).count;                                                  \
  }                                                                                                \
  USUB_UTILITY void name##delete_(const int *id) {                                                 \
    delete (local, kind, *id);                                                                     \
  }

#define CREATE(Name, name, type, local, kind, standard)                                            \
  USUB_UTILITY type *Name(int id, int count, type value) {                                         \
    return create(#Name, local, kind, id, count, sizeof value, &value);                            \
  }                                                                                                \
  USUB_UTILITY int64_t name##_(const int *id, const int *count, const type *value) {               \
    static const type none = standard;                                                             \
    return (int64_t)(intptr_t)create(#Name, local, kind, *id, *count, sizeof none,                 \
                                     value ? value : &none);                                       \
  }

/* The size of an item may be a default integer or, as SIZEOF gives it, an 8-byte one. */
#define CREATE_STRUCT(Name, name, local)                                                           \
  USUB_UTILITY void *Name(int id, int count, size_t item, const void *value) {                     \
    return create(#Name, local, STRUCTS, id, count, (int64_t)item, value);                         \
  }                                                                                                \
  USUB_UTILITY int64_t name##_(const int *id, const int *count, const int *item,                   \
                               const void *value) {                                                \
    return (int64_t)(intptr_t)create(#Name, local, STRUCTS, *id, *count, *item, value);            \
  }

#define ARRAYS(Prefix, prefix, local)                                                              \
  ACCESS(Prefix##IntArray, prefix##intarray, int, local, INTS)                                     \
  ACCESS(Prefix##FloatArray, prefix##floatarray, double, local, FLOATS)                            \
  ACCESS(Prefix##StructArray, prefix##structarray, void, local, STRUCTS)                           \
  CREATE(Prefix##IntArrayCreate, prefix##intarraycreate, int, local, INTS, INT_MAX)                \
  CREATE(Prefix##FloatArrayCreate, prefix##floatarraycreate, double, local, FLOATS, NAN)           \
  CREATE(Prefix##FloatArrayCreateDP, prefix##floatarraycreatedp, double, local, FLOATS, NAN)       \
  CREATE(Prefix##FloatArrayCreateSP, prefix##floatarraycreatesp, float, local, FLOATS, NAN)        \
  CREATE_STRUCT(Prefix##StructArrayCreate, prefix##structarraycreate, local)

ARRAYS(SMA, sma, 0)
ARRAYS(SMALocal, smalocal, 1)
