/* SPDX-License-Identifier: MIT */
/* Pages of their own for the arguments of a routine. The same memory is mapped twice: as the
 * routine may see it, inputs read-only and nothing around, and open for the driver. So a call costs
 * no change of protection. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "checked.h"

/* Addresses on each side of an argument that belong to it: an index may be wrong by this much. */
#define GAP ((size_t)1 << 20)

/* What lies in a room besides the argument. */
#define SLACK 0xa5

static const uint64_t poison_d = 0x7ff8c5534245d200;
static const uint32_t poison_f = 0x7fc5d253;
static const int32_t poison_i = 0x5dc5d253;

int usub_is_left_out(const usub_driver *driver, int32_t argument) {
  return driver->sources[argument].from == USUB_LEFT_OUT;
}

int usub_is_absent(const usub_driver *driver, const usub_call *call, int32_t argument) {
  return driver->sources[argument].from == USUB_FIXED &&
         call->argv[argument] == usub_nothing(driver, argument);
}

static size_t page_size(void) {
  return (size_t)sysconf(_SC_PAGESIZE);
}

static size_t paged(size_t bytes) {
  const size_t page = page_size();
  return (bytes + page - 1) / page * page;
}

#ifndef P_tmpdir
#define P_tmpdir "/tmp"
#endif

/* A file without a name. */
static int anonymous_file(size_t bytes) {
#if defined(__linux__)
  int file = memfd_create("usersub", MFD_CLOEXEC);
#else
  char name[] = P_tmpdir "/usersub-XXXXXX";
  int file = mkstemp(name);
  if (file >= 0)
    unlink(name);
#endif
  if (file >= 0 && ftruncate(file, (off_t)bytes) != 0) {
    close(file);
    return -1;
  }
  return file;
}

static int protection_of(const usub_room *room) {
  return room->writes ? PROT_READ | PROT_WRITE : PROT_READ;
}

/* Maps file and addresses; sizes are in `capacity` of the rooms. */
static int map_rooms(usub_checker *checker) {
  size_t pages = 0, reserve = 0;
  for (int32_t i = 0; i < checker->count; ++i) {
    pages += checker->rooms[i].capacity;
    reserve += checker->rooms[i].capacity + 2 * GAP;
  }
  if (pages == 0)
    pages = page_size();
  const int file = anonymous_file(pages);
  if (file < 0)
    return 0;
  char *open = mmap(NULL, pages, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  char *shown = mmap(NULL, reserve, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  int mapped = open != MAP_FAILED && shown != MAP_FAILED;
  if (open != MAP_FAILED) {
    checker->pages = open;
    checker->pages_bytes = pages;
    memset(open, SLACK, pages);
  }
  if (shown != MAP_FAILED) {
    checker->reserve = shown;
    checker->reserve_bytes = reserve;
  }
  size_t at = 0;
  for (int32_t i = 0; mapped && i < checker->count; ++i) {
    usub_room *room = &checker->rooms[i];
    room->low = shown;
    room->shown = shown + GAP;
    room->open = open + at;
    if (room->capacity && mmap(room->shown, room->capacity, PROT_NONE, MAP_SHARED | MAP_FIXED, file,
                               (off_t)at) == MAP_FAILED)
      mapped = 0;
    at += room->capacity;
    shown += room->capacity + 2 * GAP;
    room->high = shown;
  }
  close(file);
  return mapped;
}

usub_checker *usub_checker_create(const usub_driver *driver, const usub_call *call) {
  usub_checker *checker = calloc(1, sizeof *checker);
  if (!checker)
    return NULL;
  const int32_t most = usub_points_a_call(driver);
  size_t kept = 0;
  checker->process = getpid();
  checker->count = driver->face->count;
  checker->n = -1;
  checker->seen.argument = checker->seen.point = -1;
  usub_terms_read(driver, checker);
  for (int32_t i = 0; i < checker->count; ++i) {
    usub_room *room = &checker->rooms[i];
    const int32_t intent = driver->face->args[i].intent;
    if (!usub_is_left_out(driver, i))
      room->capacity = paged(usub_extent_of(driver, call, checker, i, most).bytes);
    room->writes = (intent & USUB_INTENT_WRITE) != 0;
    room->kept = kept;
    if (room->writes) {
      kept += room->capacity;
      checker->writable |= usub_bit(i);
      if (intent == USUB_INTENT_WRITE)
        checker->outputs |= usub_bit(i);
    }
  }
  if (!driver->face->standard && !strstr(driver->face->name, "_coef"))
    checker->zeroed = usub_bit(0); /* fTangential */
  checker->kept = malloc(kept + 1);
  if (!checker->kept || !map_rooms(checker)) {
    usub_checker_free(checker);
    return NULL;
  }
  return checker;
}

void usub_checker_free(usub_checker *checker) {
  if (!checker)
    return;
  if (checker->reserve)
    munmap(checker->reserve, checker->reserve_bytes);
  if (checker->pages)
    munmap(checker->pages, checker->pages_bytes);
  free(checker->kept);
  free(checker);
}

void usub_rooms_lay(const usub_driver *driver, const usub_call *call, usub_checker *checker) {
  if (checker->n == call->n)
    return;
  checker->n = call->n;
  for (int32_t i = 0; i < checker->count; ++i) {
    usub_room *room = &checker->rooms[i];
    checker->extents[i] = usub_extent_of(driver, call, checker, i, call->n);
    const size_t needed = usub_is_left_out(driver, i) ? 0 : paged(checker->extents[i].bytes);
    if (needed == room->accessible)
      continue;
    memset(room->open, SLACK, room->capacity);
    room->filled = 0;
    if (needed)
      mprotect(room->shown, needed, protection_of(room));
    if (needed < room->capacity)
      mprotect(room->shown + needed, room->capacity - needed, PROT_NONE);
    room->accessible = needed;
  }
}

static void poison(const usub_extent *extent, char *to) {
  const void *pattern = extent->element == 8   ? (const void *)&poison_d
                        : extent->element == 4 ? (const void *)&poison_f
                                               : (const void *)&poison_i;
  for (size_t at = 0; at < extent->bytes; at += extent->element)
    memcpy(to + at, pattern, extent->element);
}

int usub_is_poison(const usub_extent *extent, const char *element) {
  return extent->element == 8 ? memcmp(element, &poison_d, 8) == 0
                              : memcmp(element, &poison_f, 4) == 0;
}

void usub_rooms_fill(const usub_driver *driver, const usub_call *call, usub_checker *checker,
                     const usub_pass *pass) {
  for (int32_t i = 0; i < checker->count; ++i) {
    usub_room *room = &checker->rooms[i];
    const usub_extent *extent = &checker->extents[i];
    const size_t bytes = room->accessible ? extent->bytes : 0;
    memset(room->open + room->offset, SLACK, room->filled);
    room->offset = pass->at_start ? 0 : room->accessible - bytes;
    room->filled = bytes;
    char *to = room->open + room->offset;
    checker->argv[i] = room->shown + room->offset;
    if (bytes == 0)
      continue;
    if (pass->poison & usub_bit(i))
      poison(extent, to);
    else if (usub_is_absent(driver, call, i))
      memset(to, 0, bytes);
    else
      memcpy(to, call->argv[i], bytes);
  }
  if (pass->lm >= 0)
    memcpy(checker->rooms[USUB_FRIC_LM].open + checker->rooms[USUB_FRIC_LM].offset, &pass->lm,
           sizeof pass->lm);
}

int32_t usub_room_at(const usub_checker *checker, uintptr_t address) {
  for (int32_t i = 0; i < checker->count; ++i)
    if (address >= (uintptr_t)checker->rooms[i].low && address < (uintptr_t)checker->rooms[i].high)
      return i;
  return -1;
}

void usub_rooms_close(usub_checker *checker, uint64_t arguments, int closed) {
  for (int32_t i = 0; i < checker->count; ++i) {
    const usub_room *room = &checker->rooms[i];
    if ((arguments & usub_bit(i)) && room->accessible)
      mprotect(room->shown, room->accessible, closed ? PROT_NONE : protection_of(room));
  }
}

int usub_room_open(void *context, uintptr_t address, int32_t access, void *machine) {
  (void)machine;
  usub_checker *checker = context;
  const int32_t i = usub_room_at(checker, address);
  if (i < 0 || !(checker->traced & usub_bit(i)))
    return 0;
  const usub_room *room = &checker->rooms[i];
  const uintptr_t first = (uintptr_t)room->shown;
  if (address < first || address >= first + room->accessible)
    return 0;
  /* Where the machine does not say which it was, the second fault is that of a write. */
  if (access == USUB_ACCESS_READ ||
      (access == USUB_ACCESS_UNKNOWN && !(checker->tracing->read & usub_bit(i)))) {
    checker->tracing->read |= usub_bit(i);
    return mprotect(room->shown, room->accessible, PROT_READ) == 0;
  }
  if (!room->writes)
    return 0;
  checker->tracing->written |= usub_bit(i);
  return mprotect(room->shown, room->accessible, PROT_READ | PROT_WRITE) == 0;
}

/* First byte of `count` that is not slack. */
static size_t first_changed(const char *from, size_t count) {
  const unsigned char *at = (const unsigned char *)from;
  size_t i = 0;
  if (count && at[0] == SLACK && memcmp(at, at + 1, count - 1) == 0)
    return count;
  while (i < count && at[i] == SLACK)
    ++i;
  return i;
}

int32_t usub_rooms_damaged(usub_checker *checker, int64_t *bytes) {
  for (int32_t i = 0; i < checker->count; ++i) {
    usub_room *room = &checker->rooms[i];
    if (!room->writes || !room->accessible)
      continue;
    const size_t end = room->offset + room->filled, behind = room->accessible - end;
    const size_t before = first_changed(room->open, room->offset);
    const size_t after = first_changed(room->open + end, behind);
    if (before == room->offset && after == behind)
      continue;
    *bytes = before < room->offset ? (int64_t)before - (int64_t)room->offset
                                   : (int64_t)(room->filled + after);
    memset(room->open, SLACK, room->capacity);
    room->filled = 0;
    return i;
  }
  return -1;
}
