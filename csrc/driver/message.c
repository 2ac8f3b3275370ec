/* SPDX-License-Identifier: MIT */
/* What the drivers say when something is wrong. */
#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "internal.h"

/* Formats; the sign that some NaN have is of no use to a reader. */
static void say(char *to, size_t size, const char *format, va_list list) {
  vsnprintf(to, size, format, list);
  for (char *at = strstr(to, " -nan"); at; at = strstr(at + 1, " -nan"))
    if (!isalnum((unsigned char)at[5]))
      memmove(at + 1, at + 2, strlen(at + 1));
}

int32_t usub_fail(usub_driver *driver, int32_t status, const char *format, ...) {
  va_list list;
  va_start(list, format);
  say(driver->message, sizeof driver->message, format, list);
  va_end(list);
  driver->failed_point = -1; /* a caller who knows the point says so afterwards */
  return status;
}

void usub_start_call(usub_driver *driver) {
  driver->message[0] = 0;
  driver->failed_point = driver->failed_block = -1;
}

int32_t usub_error_set(usub_error *error, int32_t status, const char *format, ...) {
  if (error) {
    va_list list;
    va_start(list, format);
    say(error->message, sizeof error->message, format, list);
    va_end(list);
    error->status = status;
  }
  return status;
}

int32_t usub_block_fail(usub_driver *driver, usub_call *call, int32_t block, int32_t point,
                        int32_t status, const char *format, ...) {
  int lowest = atomic_load(&driver->first_failed);
  while (block < lowest && !atomic_compare_exchange_weak(&driver->first_failed, &lowest, block)) {
  }
  if (call->status && call->failed_block <= block)
    return status;
  va_list list;
  va_start(list, format);
  say(call->message, sizeof call->message, format, list);
  va_end(list);
  call->failed_block = block;
  call->failed_point = point;
  call->status = status;
  return status;
}

const char *usub_status_name(int32_t status) {
  switch (status) {
#define X(name, value, text)                                                                       \
  case value:                                                                                      \
    return #name;
    USUB_STATUSES(X)
#undef X
  default:
    return "UNKNOWN";
  }
}

const char *usub_status_text(int32_t status) {
  switch (status) {
#define X(name, value, text)                                                                       \
  case value:                                                                                      \
    return text;
    USUB_STATUSES(X)
#undef X
  default:
    return "not a status of usersub";
  }
}

const char *usub_message(const usub_driver *driver) {
  return driver ? driver->message : "";
}

int32_t usub_failed_point(const usub_driver *driver) {
  return driver ? driver->failed_point : -1;
}
