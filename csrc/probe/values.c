/* SPDX-License-Identifier: MIT */
/* Arguments of a call: how large they are, what they hold, what they are set to. */
#include <stdlib.h>
#include <string.h>

#include "probe.h"

/* A count above this is taken for garbage. */
#define LARGEST_COUNT 100000000

static int64_t dimension_of(const usub_probe_call *call, const usub_probe_argument *argument,
                            int32_t d) {
  const int32_t given = argument->dimension[d];
  if (given >= 0)
    return given;
  const usub_probe_value *count = &call->value[-1 - given];
  const size_t at = (size_t)argument->element * sizeof(int32_t);
  if (!count->data || count->readable < at + sizeof(int32_t))
    return -1;
  int32_t number;
  memcpy(&number, count->data + at, sizeof number);
  return number < 0 || number > LARGEST_COUNT ? -1 : (int64_t)number + argument->plus;
}

/* Elements of the documented size; -1 if a count makes no sense. */
static int64_t count_of(const usub_probe_call *call, int32_t position) {
  const usub_probe_argument *argument = &call->face->argument[position];
  int64_t count = 1;
  for (int32_t d = 0; d < argument->rank; ++d) {
    const int64_t extent = dimension_of(call, argument, d);
    if (extent < 0)
      return -1;
    count *= extent;
    if (count > LARGEST_COUNT)
      return -1;
  }
  return count;
}

/* Measures an argument and makes room for its copy; 1 if there is something to read. */
static int measure(usub_probe_call *call, int32_t position) {
  usub_probe_value *value = &call->value[position];
  value->address = call->argv[position];
  value->count = count_of(call, position);
  if (value->count < 0) {
    value->found = USUB_PROBE_UNMEASURED;
    return 0;
  }
  value->bytes = (size_t)value->count * usub_probe_element(call, position);
  if (value->bytes == 0)
    return 0;
  if (!value->address) {
    value->found = USUB_PROBE_NULL;
    return 0;
  }
  value->readable = value->bytes < USUB_PROBE_LOOKED_AT ? value->bytes : USUB_PROBE_LOOKED_AT;
  value->data = calloc(1, value->readable);
  return value->data != NULL;
}

/* Reads arguments: all at once, or one by one to find those that are not there. */
static void read_them(usub_probe_call *call, const int32_t *positions, int32_t count) {
  usub_probe_piece pieces[USUB_PROBE_ARGUMENTS];
  for (int32_t i = 0; i < count; ++i) {
    const usub_probe_value *value = &call->value[positions[i]];
    pieces[i] = (usub_probe_piece){value->address, value->data, value->readable};
  }
  if (usub_probe_read_all(pieces, count))
    return;
  for (int32_t i = 0; i < count; ++i) {
    usub_probe_value *value = &call->value[positions[i]];
    const size_t most = value->readable;
    value->readable = usub_probe_read(value->address, value->data, most);
    if (value->readable < most)
      value->found = value->readable ? USUB_PROBE_SHORT : USUB_PROBE_NOWHERE;
  }
}

void usub_probe_look(usub_probe_call *call) {
  const usub_probe_interface *face = call->face;
  for (int pass = 0; pass < 2; ++pass) { /* integers hold the sizes of the rest */
    int32_t positions[USUB_PROBE_ARGUMENTS], count = 0;
    for (int32_t i = 0; i < face->count; ++i) {
      const usub_probe_argument *argument = &face->argument[i];
      const int sizes =
          argument->kind == USUB_PROBE_INT &&
          (argument->rank == 0 || (argument->rank == 1 && argument->dimension[0] > 0));
      if (sizes == (pass == 0) && measure(call, i))
        positions[count++] = i;
    }
    read_them(call, positions, count);
  }
}

void usub_probe_forget(usub_probe_call *call) {
  for (int32_t i = 0; i < USUB_PROBE_ARGUMENTS; ++i) {
    free(call->value[i].data);
    free(call->value[i].answer);
    memset(&call->value[i], 0, sizeof call->value[i]);
  }
}

int32_t usub_probe_int(const usub_probe_call *call, int32_t position, int64_t index) {
  const usub_probe_value *value = &call->value[position];
  int32_t number = 0;
  if (value->data && index >= 0 && ((size_t)index + 1) * sizeof number <= value->readable)
    memcpy(&number, value->data + (size_t)index * sizeof number, sizeof number);
  return number;
}

double usub_probe_real(const usub_probe_call *call, int32_t position, int64_t index) {
  const usub_probe_value *value = &call->value[position];
  const size_t element = usub_probe_element(call, position);
  if (!value->data || index < 0 || ((size_t)index + 1) * element > value->readable)
    return 0;
  const unsigned char *at = value->data + (size_t)index * element;
  if (call->single) {
    float number;
    memcpy(&number, at, sizeof number);
    return (double)number;
  }
  double number;
  memcpy(&number, at, sizeof number);
  return number;
}

void usub_probe_set(usub_probe_call *call, int32_t position, int64_t index, double number) {
  usub_probe_value *value = &call->value[position];
  const size_t element = usub_probe_element(call, position);
  if (!value->data || index < 0 || ((size_t)index + 1) * element > value->readable)
    return;
  if (!value->answer) {
    value->answer = malloc(value->readable);
    if (!value->answer)
      return;
    memcpy(value->answer, value->data, value->readable);
  }
  unsigned char *at = value->answer + (size_t)index * element;
  if (call->face->argument[position].kind == USUB_PROBE_INT) {
    const int32_t whole = (int32_t)number;
    memcpy(at, &whole, sizeof whole);
  } else if (call->single) {
    const float rounded = (float)number;
    memcpy(at, &rounded, sizeof rounded);
  } else {
    memcpy(at, &number, sizeof number);
  }
}

/* Runs of elements that differ, so that what was left alone is not written to. */
static void hand_over(usub_probe_value *value, size_t element) {
  const size_t count = value->readable / element;
  for (size_t i = 0; i < count;) {
    size_t end = i;
    while (end < count &&
           memcmp(value->answer + end * element, value->data + end * element, element) != 0)
      ++end;
    const size_t bytes = (end - i) * element;
    char *to = (char *)value->address + i * element;
    if (bytes && usub_probe_write(to, value->answer + i * element, bytes) < bytes)
      value->refused = 1;
    i = end + 1;
  }
}

void usub_probe_hand_over(usub_probe_call *call) {
  for (int32_t i = 0; i < call->face->count; ++i) {
    usub_probe_value *value = &call->value[i];
    if (!(call->face->argument[i].intent & USUB_PROBE_WRITE) || !value->data)
      continue;
    /* Writing what is there already tells whether a routine could write at all. */
    if (value->readable && usub_probe_write(value->address, value->data, 1) < 1)
      value->refused = 1;
    if (value->answer)
      hand_over(value, usub_probe_element(call, i));
  }
}
