/* SPDX-License-Identifier: MIT */
/* NaN and infinity in what a routine is about to read. */
#include <string.h>
#include <strings.h>

#include "internal.h"

/* Arrays that the drivers themselves look at, with a sentence of their own. */
static int is_looked_at_elsewhere(const char *name) {
  static const char *const names[] = {"slip_increment", "normal", "normal_force", "stick_force",
                                      "pressure"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
    if (strcmp(names[i], name) == 0)
      return 1;
  return 0;
}

/* Arguments that the drivers make of such arrays. */
static int is_made_of_these(const usub_driver *driver, const char *argument) {
  if (driver->kind == USUB_KIND_OF_COEFFICIENT)
    return 0;
  if (driver->kind == USUB_KIND_OF_STANDARD)
    return strncmp(argument, "slip", 4) == 0;
  return strcmp(argument, "dSlipFric") == 0 || strncasecmp(argument, "dirCosSl", 8) == 0;
}

static int is_listed(const usub_driver *driver, const usub_slot *slot) {
  for (int32_t m = 0; m < driver->looked_at_count; ++m)
    if (driver->sources[driver->looked_at[m]].slot == slot)
      return 1;
  return 0;
}

static void list_argument(usub_driver *driver, int32_t position) {
  const usub_arg *arg = &driver->face->args[position];
  const usub_source *source = &driver->sources[position];
  if (arg->kind != USUB_KIND_REAL || arg->intent != USUB_INTENT_READ)
    return;
  if (source->slot) {
    const usub_port *port = source->slot->port;
    if (port->role == USUB_ROLE_STATE)
      return;
    if (driver->kind != USUB_KIND_OF_COEFFICIENT && is_looked_at_elsewhere(port->name))
      return;
    if (source->from == USUB_FIXED)
      driver->whole[driver->whole_count++] = source->slot;
  }
  if (source->from != USUB_SCRATCH && source->from != USUB_SLICE)
    return;
  if (!is_made_of_these(driver, arg->name))
    driver->looked_at[driver->looked_at_count++] = position;
}

void usub_list_inputs(usub_driver *driver) {
  driver->looked_at_count = driver->whole_count = 0;
  for (int32_t i = 0; i < driver->face->count; ++i)
    list_argument(driver, i);
  if (!driver->scatters)
    return;
  /* Shape functions spread forces over the host's nodes whether the routine reads them or not. */
  const char *const shapes[] = {"shape_main", "shape_secondary"};
  for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; ++i) {
    const usub_slot *slot = usub_slot_find(driver, shapes[i]);
    if (slot && slot->data && !is_listed(driver, slot))
      driver->whole[driver->whole_count++] = slot;
  }
}

static double value_at(const void *data, size_t i, int32_t single) {
  return single ? (double)((const float *)data)[i] : ((const double *)data)[i];
}

int32_t usub_check_whole_inputs(usub_driver *driver) {
  for (int32_t i = 0; i < driver->whole_count; ++i) {
    const usub_slot *slot = driver->whole[i];
    const size_t per_point = slot->per_point;
    const size_t count = per_point ? per_point * (size_t)driver->points : slot->count;
    const ptrdiff_t bad = usub_first_bad(slot->data, count, driver->single);
    if (bad < 0)
      continue;
    usub_fail(driver, USUB_BAD_INPUT,
              "%s: element %td of array '%s' is %g; expected a finite value", driver->title, bad,
              slot->port->name, value_at(slot->data, (size_t)bad, driver->single));
    if (per_point)
      driver->failed_point = (int32_t)((size_t)bad / per_point);
    return USUB_BAD_INPUT;
  }
  return USUB_OK;
}

/* Point of element `bad`: most arguments have the point last, field variables may have it first. */
static int32_t point_of(const usub_call *call, const usub_arg *arg, size_t bad, size_t elements) {
  const size_t n = (size_t)call->n;
  const int point_first = strchr(arg->shape, ',') && (strncmp(arg->shape, "nBlock,", 7) == 0 ||
                                                      strncmp(arg->shape, "nContact,", 9) == 0 ||
                                                      strncmp(arg->shape, "numDefTfv,", 10) == 0);
  return (int32_t)(point_first ? bad % n : bad / (elements / n ? elements / n : 1));
}

/* The array of the host that a computed argument of point `p` became NaN by. */
static const usub_slot *culprit(const usub_driver *driver, int32_t p) {
  for (int32_t i = 0; i < driver->slot_count; ++i) {
    const usub_slot *slot = &driver->slots[i];
    if (!slot->bound || slot->port->role != USUB_ROLE_IN || slot->port->kind != USUB_KIND_REAL)
      continue;
    const size_t first = slot->per_point * (size_t)p * slot->element;
    const size_t count = slot->per_point ? slot->per_point : slot->count;
    if (usub_first_bad((const char *)slot->data + first, count, driver->single) >= 0)
      return slot;
  }
  return NULL;
}

static int32_t refuse_input(usub_driver *driver, usub_call *call, int32_t index, int32_t position,
                            int32_t point, double value) {
  const usub_source *source = &driver->sources[position];
  const char *argument = driver->face->args[position].modern;
  const usub_slot *slot = source->slot ? source->slot : culprit(driver, point);
  if (!slot)
    return usub_block_fail(driver, call, index, point, USUB_BAD_INPUT,
                           "%s: %s of point %d = %g in a time increment of %g; expected a finite "
                           "value",
                           driver->title, argument, point, value, driver->clock.time[2]);
  return usub_block_fail(driver, call, index, point, USUB_BAD_INPUT,
                         "%s: %s of point %d is not finite (argument %s = %g)", driver->title,
                         slot->port->name, point, argument, value);
}

/* Elements of an argument that a call passes. */
static size_t elements_of(const usub_driver *driver, const usub_call *call, int32_t position) {
  const usub_source *source = &driver->sources[position];
  const size_t bytes = source->per_point ? (size_t)call->n * source->per_point : source->extra;
  return bytes / driver->size.real;
}

/* The first argument with NaN or infinity, and where in it; -1 if there is none. */
static int32_t first_bad_input(const usub_driver *driver, const usub_call *call, ptrdiff_t *bad) {
  for (int32_t m = 0; m < driver->looked_at_count; ++m) {
    const int32_t position = driver->looked_at[m];
    const size_t elements = elements_of(driver, call, position);
    *bad = usub_first_bad(call->argv[position], elements, driver->single);
    if (*bad >= 0)
      return position;
  }
  return -1;
}

int usub_inputs_are_finite(const usub_driver *driver, const usub_call *call) {
  ptrdiff_t bad = 0;
  return first_bad_input(driver, call, &bad) < 0;
}

int32_t usub_check_inputs(usub_driver *driver, usub_call *call, int32_t index, int32_t first) {
  ptrdiff_t bad = 0;
  const int32_t position = first_bad_input(driver, call, &bad);
  if (position < 0)
    return USUB_OK;
  const usub_arg *arg = &driver->face->args[position];
  const size_t elements = elements_of(driver, call, position);
  return refuse_input(driver, call, index, position,
                      first + point_of(call, arg, (size_t)bad, elements),
                      value_at(call->argv[position], (size_t)bad, driver->single));
}
