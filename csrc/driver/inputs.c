/* SPDX-License-Identifier: MIT */
/* NaN and infinity in what a routine is about to read. */
#include <string.h>

#include "internal.h"

/* Arrays that the drivers themselves look at, with a sentence of their own. */
static int is_looked_at_elsewhere(const char *name) {
  static const char *const names[] = {"dSlipFric", "fNormal", "fStickForce", "dircosN",
                                      "dircosSl",  "dirCosSl", "DGAM",       "PRESS"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
    if (strcmp(names[i], name) == 0) return 1;
  return 0;
}

void usub_list_inputs(usub_driver *driver) {
  driver->looked_at_count = 0;
  for (int32_t i = 0; i < driver->face->count; ++i) {
    const usub_arg *arg = &driver->face->args[i];
    const usub_source *source = &driver->sources[i];
    if (arg->kind != USUB_KIND_REAL || arg->intent != USUB_INTENT_READ) continue;
    if (source->from != USUB_SCRATCH && source->from != USUB_SLICE) continue;
    if (source->slot && source->slot->port->role == USUB_ROLE_STATE) continue;
    if (is_looked_at_elsewhere(arg->name)) continue;
    /* Slip data of FRIC_COEF are made while the penalty method asks, after this look. */
    if (driver->kind == USUB_KIND_OF_STANDARD && strncmp(arg->name, "slip", 4) == 0) continue;
    driver->looked_at[driver->looked_at_count++] = i;
  }
}

/* Point of element `bad`: most arguments have the point last, field variables have it first. */
static int32_t point_of(const usub_call *call, const usub_arg *arg, size_t bad, size_t elements) {
  const size_t n = (size_t)call->n;
  const int point_first = strchr(arg->shape, ',') && (strncmp(arg->shape, "nBlock,", 7) == 0 ||
                                                      strncmp(arg->shape, "nContact,", 9) == 0 ||
                                                      strncmp(arg->shape, "numDefTfv,", 10) == 0);
  return (int32_t)(point_first ? bad % n : bad / (elements / n ? elements / n : 1));
}

int32_t usub_check_inputs(usub_driver *driver, usub_call *call, int32_t index, int32_t first) {
  for (int32_t m = 0; m < driver->looked_at_count; ++m) {
    const int32_t position = driver->looked_at[m];
    const usub_source *source = &driver->sources[position];
    const size_t bytes = source->per_point ? (size_t)call->n * source->per_point : source->extra;
    const size_t elements = bytes / driver->size.real;
    const ptrdiff_t bad = usub_first_bad(call->argv[position], elements, driver->single);
    if (bad < 0) continue;
    const usub_arg *arg = &driver->face->args[position];
    const int32_t point = first + point_of(call, arg, (size_t)bad, elements);
    const double value = driver->single ? (double)((const float *)call->argv[position])[bad]
                                        : ((const double *)call->argv[position])[bad];
    return usub_block_fail(driver, call, index, point, USUB_BAD_INPUT,
                           "%s: %s of point %d = %g; expected a finite value", driver->title,
                           source->slot ? source->slot->port->name : arg->modern, point, value);
  }
  return USUB_OK;
}
