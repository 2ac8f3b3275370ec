/* SPDX-License-Identifier: MIT */
/* A heap for routines under check: every block ends at a page that nobody may touch, and freed
 * blocks stay closed. Code under check is compiled again with its malloc, free, ... renamed to
 * these. Memory of others that comes to usub_guarded_free goes to the real free. */
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "../runtime/guard.h"
#include "usersub/usersub.h"

enum { ALIGNMENT = 16, SLACK = 0xa5 };

typedef struct block {
  uintptr_t data; /* 0: the place in the table is free */
  size_t size, bytes;
  int freed;
} block;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static block *blocks; /* in the order of allocation */
static size_t count, room;
static int64_t live;

#pragma GCC visibility push(default)
void *usub_guarded_malloc(size_t size);
void *usub_guarded_calloc(size_t number, size_t size);
void *usub_guarded_realloc(void *data, size_t size);
void usub_guarded_free(void *data);
int64_t usub_guarded_live(void);
int32_t usub_guarded_explain(uint64_t address, char *text, size_t length);
#pragma GCC visibility pop

static size_t page_size(void) {
  return (size_t)sysconf(_SC_PAGESIZE);
}

static size_t slack(size_t size) {
  return (ALIGNMENT - size % ALIGNMENT) % ALIGNMENT;
}

/* The newest block that begins at an address: freed ones may have been there before. */
static block *find(uintptr_t data) {
  for (size_t i = count; i-- > 0;)
    if (blocks[i].data == data)
      return &blocks[i];
  return NULL;
}

static int record(const block *made) {
  if (count == room) {
    const size_t more = room ? 2 * room : 64;
    block *grown = realloc(blocks, more * sizeof *grown);
    if (!grown)
      return 0;
    blocks = grown;
    room = more;
  }
  blocks[count++] = *made;
  ++live;
  return 1;
}

void *usub_guarded_malloc(size_t size) {
  const size_t page = page_size(), whole = size + slack(size);
  const size_t bytes = (whole + page - 1) / page * page + page;
  if (whole < size || bytes < whole)
    return NULL;
  char *pages =
      mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (pages == MAP_FAILED)
    return NULL;
  mprotect(pages + bytes - page, page, PROT_NONE);
  char *data = pages + bytes - page - whole;
  memset(data + size, SLACK, slack(size));
  const block made = {(uintptr_t)data, size, bytes, 0};
  pthread_mutex_lock(&lock);
  const int kept = record(&made);
  pthread_mutex_unlock(&lock);
  if (kept)
    return data;
  munmap(pages, bytes);
  return NULL;
}

void *usub_guarded_calloc(size_t number, size_t size) {
  if (size && number > SIZE_MAX / size)
    return NULL;
  return usub_guarded_malloc(number * size); /* fresh pages are zero */
}

void *usub_guarded_realloc(void *data, size_t size) {
  if (!data)
    return usub_guarded_malloc(size);
  pthread_mutex_lock(&lock);
  const block *known = find((uintptr_t)data);
  const size_t before = known ? known->size : 0;
  pthread_mutex_unlock(&lock);
  if (!known)
    return realloc(data, size);
  void *made = usub_guarded_malloc(size);
  if (made) {
    memcpy(made, data, before < size ? before : size);
    usub_guarded_free(data);
  }
  return made;
}

/* Whether what lies between the end of a block and its page was written to. */
static int overrun(const block *known) {
  const unsigned char *rest = (const unsigned char *)known->data + known->size;
  for (size_t i = 0; i < slack(known->size); ++i)
    if (rest[i] != SLACK)
      return 1;
  return 0;
}

void usub_guarded_free(void *data) {
  if (!data)
    return;
  const size_t page = page_size();
  pthread_mutex_lock(&lock);
  block *known = find((uintptr_t)data);
  const int again = known && known->freed, damaged = known && !again && overrun(known);
  size_t size = 0;
  if (known && !again) {
    known->freed = 1;
    size = known->size;
    --live;
    const uintptr_t first = known->data / page * page;
    mprotect((void *)first, known->bytes - page, PROT_NONE);
    madvise((void *)first, known->bytes - page, MADV_DONTNEED);
  }
  pthread_mutex_unlock(&lock);
  if (!known) {
    free(data);
    return;
  }
  if (again)
    usub_guard_leave(USUB_ROUTINE_CRASHED, "memory that is freed twice");
  if (damaged)
    usub_guard_leave(USUB_ROUTINE_CRASHED,
                     "a block of %zu bytes of its own memory that was written beyond its end",
                     size);
}

/** Blocks that are allocated and not freed. */
int64_t usub_guarded_live(void) {
  pthread_mutex_lock(&lock);
  const int64_t found = live;
  pthread_mutex_unlock(&lock);
  return found;
}

/** Says which block an address belongs to, or lies behind.
 * @return 1 if it does, else 0 */
int32_t usub_guarded_explain(uint64_t address, char *text, size_t length) {
  const size_t page = page_size();
  int32_t found = 0;
  pthread_mutex_lock(&lock);
  for (size_t i = count; i-- > 0 && !found;) {
    const block *b = &blocks[i];
    const uintptr_t first = b->data / page * page, end = first + b->bytes;
    if (address < first || address >= end)
      continue;
    found = 1;
    if (b->freed)
      snprintf(text, length, "in a block of %zu bytes that was freed before", b->size);
    else
      snprintf(text, length, "%lld bytes from the start of a block of %zu bytes",
               (long long)(address - b->data), b->size);
  }
  /* A block that was written beyond its end, but not so far as its page. */
  for (size_t i = 0; !address && i < count && !found; ++i)
    if (!blocks[i].freed && overrun(&blocks[i])) {
      found = 1;
      snprintf(text, length, "beyond the end of a block of %zu bytes", blocks[i].size);
    }
  pthread_mutex_unlock(&lock);
  return found;
}
