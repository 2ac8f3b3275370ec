/* SPDX-License-Identifier: MIT */
/* The plan: for every argument of the routine, where its memory comes from.
 *
 * What the routine does not use costs nothing: no gather, no scratch, no copy. Its pointer leads to
 * a page of zeros that nobody can write, so that a wrong declaration is caught by a fault and not
 * paid with somebody else's memory. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "internal.h"

/* Room for what a wrongly declared routine might read; untouched pages cost nothing. */
#define LEAST_NOTHING ((size_t)1 << 20)
#define MOST_NOTHING ((size_t)1 << 28)
#define ALIGNMENT 64

int32_t usub_used(const usub_driver *driver, int32_t position) {
  if (!driver->routine.uses_known)
    return -1;
  return driver->routine.uses[position] != 0;
}

/* The first argument is what an interface is for: the driver reads it whatever the routine does. */
int usub_is_wanted(const usub_driver *driver, int32_t position) {
  return position == 0 || driver->set.pass_everything || usub_used(driver, position) != 0;
}

static usub_source *put(usub_driver *driver, int32_t position, usub_from from, size_t bytes) {
  usub_source *source = &driver->sources[position];
  memset(source, 0, sizeof *source);
  source->used = usub_used(driver, position);
  source->bytes_full = (int32_t)bytes;
  if (usub_is_wanted(driver, position)) {
    source->from = from;
    source->bytes = (int32_t)bytes;
  } else {
    source->from = USUB_LEFT_OUT;
    source->what = "left out";
    source->why = "the routine does not use it";
  }
  return source;
}

void usub_put_fixed(usub_driver *driver, int32_t position, const void *data) {
  usub_source *source = put(driver, position, USUB_FIXED, 0);
  source->from = USUB_FIXED; /* costs nothing, so that it is always there */
  source->data = data;
  source->what = "constant";
  source->why = "the same for all points";
}

void usub_put_points(usub_driver *driver, int32_t position) {
  usub_source *source = put(driver, position, USUB_POINTS, 0);
  source->from = USUB_POINTS;
  source->what = "constant";
  source->why = "number of contact points of the call";
}

void usub_need_array(usub_driver *driver, int32_t position, const char *array) {
  const usub_slot *slot = usub_slot_find(driver, array);
  const char *empty = slot->count ? NULL : usub_empty_setting(slot);
  if (driver->missing[0] || slot->data || slot->port->unbound[0])
    return;
  if (usub_used(driver, position) != 1 || (slot->count == 0 && !empty))
    return;
  const char *argument = driver->face->args[position].modern;
  if (empty)
    snprintf(driver->missing, sizeof driver->missing,
             "%s: scene setting '%s' = 0, but the routine reads %s", driver->title, empty,
             argument);
  else
    snprintf(driver->missing, sizeof driver->missing,
             "%s: array '%s' is not bound, but the routine reads %s", driver->title, array,
             argument);
}

void usub_put_array(usub_driver *driver, int32_t position, const char *array,
                    const void *fallback) {
  const usub_slot *slot = usub_slot_find(driver, array);
  const size_t bytes = slot->per_point * slot->element;
  usub_source *source = put(driver, position, bytes ? USUB_SLICE : USUB_FIXED, bytes);
  if (source->from == USUB_LEFT_OUT)
    return;
  source->slot = slot;
  source->per_point = bytes;
  if (slot->data) {
    source->what = "zero-copy";
    source->why = slot->bound ? "memory of the host" : "memory of the driver";
    return;
  }
  if (!fallback)
    usub_need_array(driver, position, array);
  source->from = USUB_FIXED;
  source->slot = NULL;
  source->data = fallback ? fallback : usub_nothing(driver, position);
  source->bytes = 0;
  source->what = "constant";
  source->why = slot->port->unbound[0] ? slot->port->unbound : "nothing is bound: zeros";
}

void usub_put_memory(usub_driver *driver, int32_t position, const void *data, size_t bytes) {
  usub_source *source = put(driver, position, USUB_SLICE, bytes);
  if (source->from == USUB_LEFT_OUT)
    return;
  source->data = data;
  source->per_point = bytes;
  source->what = "zero-copy";
  source->why = "memory of the driver";
}

void usub_put_scratch(usub_driver *driver, int32_t position, size_t per_point, size_t extra,
                      const char *what, const char *why) {
  usub_source *source = put(driver, position, USUB_SCRATCH, per_point ? per_point : extra);
  if (source->from == USUB_LEFT_OUT)
    return;
  source->per_point = per_point;
  source->extra = extra;
  source->what = what;
  source->why = why;
}

void usub_put_absent(usub_driver *driver, int32_t position, size_t per_point, const char *why) {
  usub_source *source = put(driver, position, USUB_FIXED, per_point);
  if (source->from == USUB_LEFT_OUT)
    return;
  source->data = usub_nothing(driver, position);
  source->bytes = 0;
  source->what = "left out";
  source->why = why;
}

void usub_put_pair(usub_driver *driver, int32_t position, const char *quantity, size_t per_point,
                   size_t extra, const char *what, const char *why) {
  char secondary[40], main[40];
  snprintf(secondary, sizeof secondary, "%s_secondary", quantity);
  snprintf(main, sizeof main, "%s_main", quantity);
  usub_need_array(driver, position, secondary);
  usub_need_array(driver, position, main);
  if (usub_data(driver, secondary) && usub_data(driver, main))
    usub_put_scratch(driver, position, per_point, extra, what, why);
  else
    usub_put_absent(driver, position, per_point + extra, "nothing is bound: zeros");
}

int32_t usub_points_a_call(const usub_driver *driver) {
  if (driver->kind != USUB_KIND_OF_STANDARD)
    return driver->block;
  if (usub_interface_key(driver->face) != USUB_INTERFACE_FRIC || driver->checked)
    return 1;
  return driver->block < USUB_LONGEST_RUN ? driver->block : USUB_LONGEST_RUN;
}

int usub_is_live(const usub_driver *driver, int32_t position) {
  return driver->sources[position].from == USUB_SCRATCH;
}

static size_t rounded(size_t bytes) {
  return (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

void usub_calls_free(usub_driver *driver) {
  if (driver->calls)
    for (int32_t w = 0; w < driver->threads; ++w) {
      free(driver->calls[w].scratch);
      usub_checker_free(driver->calls[w].checker);
    }
  free(driver->calls);
  driver->calls = NULL;
}

/* Bytes of an argument that a block without its open points needs besides. */
static size_t packed_bytes(const usub_driver *driver, const usub_source *source, size_t block) {
  const int is_packed = driver->set.skip_open && source->from == USUB_SLICE;
  return is_packed ? rounded(block * source->per_point) : 0;
}

static size_t scratch_bytes(const usub_driver *driver, size_t block) {
  size_t total = ALIGNMENT + rounded(usub_axes_bytes(driver, block));
  if (driver->set.skip_open)
    total += rounded(block * sizeof(int32_t));
  for (int32_t i = 0; i < driver->face->count; ++i) {
    const usub_source *source = &driver->sources[i];
    if (source->from == USUB_SCRATCH)
      total += rounded(block * source->per_point + source->extra);
    total += packed_bytes(driver, source, block);
  }
  return rounded(total);
}

/* Takes `bytes` of a worker's scratch, NULL for none. */
static void *take(char **at, size_t bytes) {
  char *taken = *at;
  *at += rounded(bytes);
  return bytes ? taken : NULL;
}

/* One allocation of scratch for each worker, shared out to the arguments. */
static int32_t make_calls(usub_driver *driver) {
  usub_calls_free(driver);
  const size_t block = (size_t)usub_points_a_call(driver);
  const size_t total = scratch_bytes(driver, block);
  driver->calls = calloc((size_t)driver->threads, sizeof *driver->calls);
  if (!driver->calls)
    return usub_fail(driver, USUB_NO_MEMORY, "no memory for the workers");
  for (int32_t w = 0; w < driver->threads; ++w) {
    usub_call *call = &driver->calls[w];
    char *at = call->scratch = aligned_alloc(ALIGNMENT, total);
    if (!at)
      return usub_fail(driver, USUB_NO_MEMORY, "no memory for scratch of %zu bytes", total);
    memset(at, 0, total);
    call->axes = take(&at, usub_axes_bytes(driver, block));
    call->closed = take(&at, driver->set.skip_open ? block * sizeof(int32_t) : 0);
    for (int32_t i = 0; i < driver->face->count; ++i) {
      const usub_source *source = &driver->sources[i];
      if (source->from == USUB_SCRATCH)
        call->packed[i] = call->argv[i] = take(&at, block * source->per_point + source->extra);
      else
        call->packed[i] = take(&at, packed_bytes(driver, source, block));
    }
  }
  return USUB_OK;
}

/* Sets the pointers that do not move from block to block. */
static void aim_fixed(usub_driver *driver) {
  driver->moving_count = 0;
  for (int32_t i = 0; i < driver->face->count; ++i) {
    const usub_source *source = &driver->sources[i];
    if (source->from == USUB_SLICE)
      driver->moving[driver->moving_count++] = i;
    const int moves = source->from == USUB_SLICE || source->from == USUB_SCRATCH;
    driver->stride[i] = moves ? (int64_t)source->per_point : 0;
    for (int32_t w = 0; w < driver->threads; ++w) {
      usub_call *call = &driver->calls[w];
      if (source->from == USUB_LEFT_OUT)
        call->argv[i] = usub_nothing(driver, i);
      if (source->from == USUB_POINTS)
        call->argv[i] = &call->n;
      if (source->from == USUB_FIXED)
        call->argv[i] = source->slot ? source->slot->data : (void *)(uintptr_t)source->data;
    }
  }
  usub_list_inputs(driver);
  driver->aimed = 1;
}

void usub_aim(const usub_driver *driver, usub_call *call, int32_t first, int32_t n) {
  call->n = n;
  call->done = 0;
  call->all = 0;
  for (int32_t m = 0; m < driver->moving_count; ++m) {
    const usub_source *source = &driver->sources[driver->moving[m]];
    const void *base = source->slot ? source->slot->data : source->data;
    call->argv[driver->moving[m]] = (char *)(uintptr_t)base + (size_t)first * source->per_point;
  }
}

/* Refuses if an array is missing that must be bound, or that the routine is known to read. */
static int32_t check_bound(usub_driver *driver) {
  for (int32_t i = 0; i < driver->slot_count; ++i) {
    const usub_slot *slot = &driver->slots[i];
    if (slot->data || slot->port->role != USUB_ROLE_IN || slot->count == 0)
      continue;
    if (strcmp(slot->port->unbound, "required") == 0)
      return usub_fail(driver, USUB_MISSING_ARRAY, "%s: array '%s' is not bound; it is required",
                       driver->title, slot->port->name);
  }
  return USUB_OK;
}

/* Every argument has a place of its own, so that the address of a fault tells which one it was. */
static void make_nothing(usub_driver *driver) {
  const size_t page = (size_t)sysconf(_SC_PAGESIZE);
  size_t size = LEAST_NOTHING;
  for (int32_t i = 0; i < driver->slot_count; ++i) {
    const size_t bytes = driver->slots[i].count * driver->slots[i].element;
    if (bytes > size)
      size = bytes < MOST_NOTHING ? bytes : MOST_NOTHING;
  }
  driver->nothing_place = (size + page - 1) / page * page + page;
  void *pages = mmap(NULL, driver->nothing_place * (size_t)driver->face->count, PROT_READ,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  driver->nothing = pages == MAP_FAILED ? NULL : pages;
}

void *usub_nothing(const usub_driver *driver, int32_t position) {
  /* Half a page in: an index that is too small is still in the place of its argument. */
  const size_t into = 2048;
  return driver->nothing ? driver->nothing + driver->nothing_place * (size_t)position + into : NULL;
}

void usub_nothing_free(usub_driver *driver) {
  if (driver->nothing)
    munmap(driver->nothing, driver->nothing_place * (size_t)driver->face->count);
}

static void make_plan(usub_driver *driver) {
  if (!driver->nothing)
    make_nothing(driver);
  driver->missing[0] = 0;
  driver->out_of_memory = 0;
  if (driver->kind == USUB_KIND_OF_STANDARD)
    usub_standard_plan(driver);
  else if (driver->kind == USUB_KIND_OF_EXPLICIT)
    usub_explicit_plan(driver);
  else
    usub_coefficient_plan(driver);
}

int32_t usub_prepare(usub_driver *driver) {
  if (!driver->prepared) {
    int32_t status = check_bound(driver);
    if (status)
      return status;
    make_plan(driver);
    if (!driver->nothing)
      return usub_fail(driver, USUB_NO_MEMORY, "no memory for left-out arguments");
    if (driver->out_of_memory)
      return usub_fail(driver, USUB_NO_MEMORY, "no memory for what the host does not bind");
    if (driver->missing[0])
      return usub_fail(driver, USUB_MISSING_ARRAY, "%s", driver->missing);
    status = make_calls(driver);
    if (!status && driver->kind == USUB_KIND_OF_EXPLICIT)
      status = usub_explicit_memory(driver);
    if (status)
      return status;
    driver->prepared = 1;
    driver->aimed = 0;
  }
  if (!driver->aimed)
    aim_fixed(driver);
  return USUB_OK;
}

int32_t usub_plan_count(const usub_driver *driver) {
  return driver ? driver->face->count : 0;
}
int32_t usub_plan_block(const usub_driver *driver) {
  return driver ? driver->block : 0;
}
int32_t usub_plan_threads(const usub_driver *driver) {
  return driver ? driver->threads : 0;
}

int32_t usub_plan_get(const usub_driver *driver, int32_t index, usub_plan_row *row) {
  if (!driver || !row || index < 0 || index >= driver->face->count)
    return USUB_BAD_ARGUMENT;
  if (!driver->prepared)
    make_plan((usub_driver *)(uintptr_t)driver);
  const usub_source *source = &driver->sources[index];
  *row = (usub_plan_row){driver->face->args[index].modern,
                         source->what,
                         source->why,
                         source->used,
                         source->bytes,
                         source->bytes_full};
  return USUB_OK;
}
