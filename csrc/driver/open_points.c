/* SPDX-License-Identifier: MIT */
/* Blocks without their open points (scene setting `skip_open`).
 *
 * The arguments of a block are made as ever. Where a point of it is open, the columns of the closed
 * ones are moved together: in place in memory of the worker, into memory of the worker where they
 * are slices of the host's arrays. After the call the answers go back to their points. A block
 * whose points are all closed is called as it is. */
#include <string.h>

#include "explicit.h"
#include "fric_coef.h"

/* Lists the closed points of a block. */
static int32_t find_closed(const usub_driver *driver, usub_call *call, int32_t first) {
  int32_t count = 0;
  for (int32_t k = 0; k < call->n; ++k) {
    const size_t p = (size_t)(first + k);
    const double force = driver->single ? (double)((const float *)driver->memory.normal_force)[p]
                                        : ((const double *)driver->memory.normal_force)[p];
    call->closed[count] = k;
    count += force > 0;
  }
  return count;
}

/* Closed points of the list from the k-th that lie side by side. */
static int32_t run_from(const usub_call *call, int32_t k, int32_t count) {
  int32_t length = 1;
  while (k + length < count && call->closed[k + length] == call->closed[k] + length)
    ++length;
  return length;
}

/* Moves the columns of the closed points to the front; `to` may be `from`. */
static void pack(const usub_call *call, const char *from, char *to, size_t column, int32_t count) {
  for (int32_t k = 0, run; k < count; k += run) {
    run = run_from(call, k, count);
    memmove(to + (size_t)k * column, from + (size_t)call->closed[k] * column, (size_t)run * column);
  }
}

/* The other way round, from the last to the first; what belongs to no closed point becomes zero. */
static void spread(const usub_call *call, char *data, size_t column, int32_t count, int32_t all) {
  int32_t end = all;
  for (int32_t k = count, run; k > 0; k -= run) {
    for (run = 1; run < k && call->closed[k - run - 1] == call->closed[k - 1] - run;)
      ++run;
    const size_t first = (size_t)call->closed[k - run], behind = first + (size_t)run;
    memset(data + behind * column, 0, ((size_t)end - behind) * column);
    memmove(data + first * column, data + (size_t)(k - run) * column, (size_t)run * column);
    end = (int32_t)first;
  }
  memset(data, 0, (size_t)end * column);
}

/* Fields of VFRIC_COEF have the point first: each of them is a row of its own. */
static void pack_rows(const usub_call *call, char *data, size_t column, size_t real, int32_t all,
                      int32_t count) {
  for (size_t row = 0; row < column / real; ++row)
    pack(call, data + row * (size_t)all * real, data + row * (size_t)count * real, real, count);
}

int32_t usub_leave_open_out(const usub_driver *driver, usub_call *call, int32_t first) {
  const int32_t all = call->n, count = find_closed(driver, call, first);
  if (count == all)
    return all;
  const int coefficient = usub_is_coefficient(driver);
  call->all = all;
  call->n = count;
  for (int32_t i = 0; i < driver->face->count; ++i) {
    const usub_source *source = &driver->sources[i];
    const int moves = source->from == USUB_SCRATCH || source->from == USUB_SLICE;
    const usub_arg *arg = &driver->face->args[i];
    if (!moves || !source->per_point || arg->intent == USUB_INTENT_WRITE)
      continue;
    if (driver->analytical && strstr(arg->shape, "nBlockAnal"))
      continue; /* one column, which is all points' */
    if (coefficient && i == USUB_VFRIC_COEF_FIELDAVG)
      pack_rows(call, call->argv[i], source->per_point, driver->size.real, all, count);
    else
      pack(call, call->argv[i], call->packed[i], source->per_point, count);
    call->argv[i] = call->packed[i];
  }
  /* The answer that is a slice: coefficients of VFRIC_COEF. */
  if (driver->sources[0].from == USUB_SLICE)
    call->argv[0] = call->packed[0];
  return count;
}

void usub_take_open_back(const usub_driver *driver, usub_call *call, int32_t first) {
  if (!call->all)
    return;
  const int32_t count = call->n, all = call->all;
  for (int32_t i = 0; i < driver->face->count; ++i) {
    const usub_source *source = &driver->sources[i];
    if (driver->face->args[i].intent == USUB_INTENT_READ || !source->per_point)
      continue;
    if (i == 0)
      spread(call, call->argv[0], source->per_point, count, all);
    if (source->from != USUB_SLICE)
      continue;
    const void *base = source->slot ? source->slot->data : source->data;
    char *to = (char *)(uintptr_t)base + (size_t)first * source->per_point;
    if (i == 0)
      memcpy(to, call->argv[0], (size_t)all * source->per_point);
    for (int32_t k = 0, run; i != 0 && k < count; k += run) {
      run = run_from(call, k, count);
      memcpy(to + (size_t)call->closed[k] * source->per_point,
             (char *)call->argv[i] + (size_t)k * source->per_point,
             (size_t)run * source->per_point);
    }
  }
  usub_aim(driver, call, first, all);
}
