/* SPDX-License-Identifier: MIT */
/* Arrays between host and driver: sizes from the port table, binding, ownership. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

static const usub_port ports[] = {
#define PORT(name, drivers, kind, role, shape, unbound, unit, meaning)                             \
  {name, drivers, kind, role, shape, unbound},
#include "ports.inc"
#undef PORT
};

static size_t symbol_value(const usub_sizes *size, char symbol) {
  switch (symbol) {
  case 'N':
    return (size_t)size->N;
  case 'D':
    return (size_t)size->D;
  case 'F':
    return (size_t)size->F;
  case 'S':
    return (size_t)size->S;
  case 'P':
    return (size_t)size->P;
  case 'A':
    return (size_t)size->A;
  case 'B':
    return (size_t)size->B;
  case 'M':
    return (size_t)size->M;
  case 'X':
    return (size_t)size->X;
  case 'Y':
    return (size_t)size->Y;
  case 'Z':
    return (size_t)size->Z;
  case 'T':
    return (size_t)size->T;
  default:
    return (size_t)(symbol - '0');
  }
}

/* Elements of the array and of one contact point. */
static void measure(const usub_driver *driver, usub_slot *slot) {
  size_t count = 1, leading = 1;
  char last = 0;
  for (const char *at = slot->port->shape; *at; ++at) {
    if (*at == ',')
      continue;
    leading = count;
    count *= symbol_value(&driver->size, *at);
    last = *at;
  }
  slot->count = count;
  slot->per_point = last == 'N' || (last == 'A' && !driver->analytical) ? leading : 0;
}

/* Whether the driver itself needs memory for the slot although the host binds nothing. */
static int is_owned(const usub_driver *driver, const usub_port *port) {
  const int owns =
      driver->kind == USUB_KIND_OF_EXPLICIT ? usub_explicit_owns(driver, port->name) : -1;
  if (owns >= 0)
    return owns;
  if (port->role == USUB_ROLE_STATE)
    return 1;
  if (port->role != USUB_ROLE_OUT)
    return 0;
  if (strcmp(port->name, "ddtddt") == 0)
    return driver->set.temperature_tangent;
  if (strcmp(port->name, "ddtddg") == 0 || strcmp(port->name, "ddtddp") == 0)
    return driver->set.tangent;
  if (strcmp(port->name, "derivative") == 0)
    return driver->set.derivatives;
  if (strcmp(port->name, "second_coefficient") == 0)
    return driver->set.anisotropic;
  return 1;
}

/* The field of usub_memory that holds the memory of array `name`. */
static void **place_of(usub_driver *driver, const char *name) {
#define PORT_NAME(field)                                                                           \
  if (strcmp(name, #field) == 0)                                                                   \
    return &driver->memory.field;
#include "port_names.inc"
#undef PORT_NAME
  return NULL;
}

static void set_data(usub_slot *slot, void *data) {
  slot->data = data;
  *slot->place = data;
}

int32_t usub_slots_create(usub_driver *driver, usub_error *error) {
  const int32_t mine =
      driver->kind == USUB_KIND_OF_COEFFICIENT ? USUB_FOR_COEFFICIENT : driver->face->for_driver;
  for (size_t i = 0; i < sizeof ports / sizeof ports[0]; ++i) {
    if (!(ports[i].drivers & mine))
      continue;
    if (driver->slot_count == USUB_MAX_SLOTS)
      return usub_error_set(error, USUB_ABI_MISMATCH, "more than %d arrays", USUB_MAX_SLOTS);
    usub_slot *slot = &driver->slots[driver->slot_count++];
    slot->port = &ports[i];
    slot->place = place_of(driver, ports[i].name);
    slot->element = ports[i].kind == USUB_KIND_INT ? sizeof(int32_t) : driver->size.real;
    measure(driver, slot);
    const int owned = is_owned(driver, &ports[i]);
    if (!owned && ports[i].role == USUB_ROLE_STATE)
      slot->count = 0; /* nothing to keep, nothing to save */
    if (!owned || slot->count == 0)
      continue;
    if (slot->count > SIZE_MAX / slot->element || !(slot->own = calloc(slot->count, slot->element)))
      return usub_error_set(error, USUB_NO_MEMORY, "no memory for array '%s': %zu elements",
                            ports[i].name, slot->count);
    set_data(slot, slot->own);
  }
  return USUB_OK;
}

void usub_slots_free(usub_driver *driver) {
  for (int32_t i = 0; i < driver->slot_count; ++i)
    free(driver->slots[i].own);
}

usub_slot *usub_slot_find(usub_driver *driver, const char *name) {
  for (int32_t i = 0; i < driver->slot_count; ++i)
    if (strcmp(driver->slots[i].port->name, name) == 0)
      return &driver->slots[i];
  return NULL;
}

void *usub_data(const usub_driver *driver, const char *name) {
  for (int32_t i = 0; i < driver->slot_count; ++i)
    if (strcmp(driver->slots[i].port->name, name) == 0)
      return driver->slots[i].data;
  return NULL;
}

static int32_t unknown_array(usub_driver *driver, const char *name) {
  int used =
      snprintf(driver->message, sizeof driver->message,
               "%s: no array is called '%s'; arrays:", driver->title, name ? name : "(null)");
  size_t at = (size_t)used;
  for (int32_t i = 0; i < driver->slot_count && at < sizeof driver->message; ++i)
    at += (size_t)snprintf(driver->message + at, sizeof driver->message - at, "%s %s", i ? "," : "",
                           driver->slots[i].port->name);
  return USUB_BAD_ARGUMENT;
}

const char *usub_empty_setting(const usub_slot *slot) {
  const char *shape = slot->port->shape;
  if (strchr(shape, 'X'))
    return "secondary_nodes";
  if (strchr(shape, 'Y'))
    return "main_nodes";
  return strchr(shape, 'Z') ? "nodes" : NULL;
}

/* Refuses what cannot be bound to the slot. */
static int32_t check_binding(usub_driver *driver, const usub_slot *slot, const void *data,
                             size_t count) {
  const char *name = slot->port->name;
  if (slot->port->role == USUB_ROLE_STATE)
    return usub_fail(driver, USUB_BAD_ARGUMENT,
                     "%s: array '%s' is kept by the driver and cannot be bound; read it with "
                     "usub_array",
                     driver->title, name);
  if (slot->own && slot->port->role == USUB_ROLE_IN)
    return usub_fail(driver, USUB_BAD_ARGUMENT,
                     "%s: array '%s' is computed by the driver, since scene setting 'enforcement' "
                     "is '%s'; it cannot be bound",
                     driver->title, name, driver->set.enforcement);
  if (!data)
    return USUB_OK;
  if (count != slot->count)
    return usub_fail(driver, USUB_BAD_ARGUMENT,
                     "%s: array '%s' has %zu elements; expected %zu, shape (%s)", driver->title,
                     name, count, slot->count, slot->port->shape);
  if ((uintptr_t)data % slot->element)
    return usub_fail(driver, USUB_BAD_ARGUMENT,
                     "%s: array '%s' is not aligned to its elements of %zu bytes", driver->title,
                     name, slot->element);
  if (count == 0 && slot->port->role == USUB_ROLE_ADD)
    return usub_fail(driver, USUB_BAD_ARGUMENT,
                     "%s: array '%s' has no nodes to add forces to; scene setting '%s' = 0",
                     driver->title, name, usub_empty_setting(slot));
  return USUB_OK;
}

int32_t usub_bind(usub_driver *driver, const char *array, void *data, size_t count) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  usub_slot *slot = array ? usub_slot_find(driver, array) : NULL;
  if (!slot)
    return unknown_array(driver, array);
  const int32_t status = check_binding(driver, slot, data, count);
  if (status)
    return status;
  if (count == 0)
    data = NULL; /* an array without elements is as good as none */
  void *target = data ? data : slot->own;
  if (!target != !slot->data || !data != !slot->bound)
    driver->prepared = 0;
  if (target != slot->data)
    driver->aimed = 0;
  set_data(slot, target);
  slot->bound = data != NULL;
  driver->message[0] = 0;
  return USUB_OK;
}

int32_t usub_array(usub_driver *driver, const char *array, void **data, size_t *count) {
  if (!driver || !data || !count)
    return USUB_BAD_ARGUMENT;
  const usub_slot *slot = array ? usub_slot_find(driver, array) : NULL;
  if (!slot)
    return unknown_array(driver, array);
  *data = slot->data;
  *count = slot->data ? slot->count : 0;
  driver->message[0] = 0;
  return USUB_OK;
}
