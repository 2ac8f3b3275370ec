/* SPDX-License-Identifier: MIT */
/* Saving and loading committed state.
 *
 * Layout: a header, then every array of role "state" in the order of the port table, then the force
 * of the last step where the driver keeps it. Numbers are in the byte order of the machine; the
 * header says which, and another order is refused, not converted. */
#include <stdlib.h>
#include <string.h>

#include "internal.h"

#define STATE_FORMAT 1u
#define BYTE_ORDER_MARK 0x01020304u

typedef struct state_header {
  char magic[8]; /* "USUBSTAT" */
  uint32_t byte_order, format;
  int32_t abi_version, kind, interface, single;
  int32_t sizes[12];
  int32_t has_force, step, increment, reserved;
  double time[3], work, dissipation;
  uint64_t payload; /* bytes behind the header */
  uint64_t check;   /* FNV-1a of header (with check = 0) and payload */
} state_header;

static uint64_t fnv1a(uint64_t hash, const void *data, size_t size) {
  const unsigned char *bytes = data;
  for (size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  return hash;
}

static uint64_t check_sum(state_header header, const void *payload) {
  header.check = 0;
  return fnv1a(fnv1a(14695981039346656037u, &header, sizeof header), payload, header.payload);
}

static size_t force_bytes(const usub_driver *driver) {
  return (size_t)driver->size.N * (size_t)driver->size.D * driver->size.real;
}

static size_t payload_bytes(const usub_driver *driver, int with_force) {
  size_t total = with_force ? force_bytes(driver) : 0;
  for (int32_t i = 0; i < driver->slot_count; ++i)
    if (driver->slots[i].port->role == USUB_ROLE_STATE)
      total += driver->slots[i].count * driver->slots[i].element;
  return total;
}

static state_header header_of(const usub_driver *driver) {
  const usub_sizes *size = &driver->size;
  state_header header = {
      .byte_order = BYTE_ORDER_MARK,
      .format = STATE_FORMAT,
      .abi_version = USUB_ABI_VERSION,
      .kind = (int32_t)driver->kind,
      .interface = usub_interface_key(driver->face),
      .single = driver->single,
      .sizes = {size->N, size->D, size->F, size->S, size->P, size->A, size->B, size->M, size->X,
                size->Y, size->Z, size->T},
      .has_force = driver->last_force != NULL,
      .step = driver->accepted.flags[0],
      .increment = driver->accepted.flags[1],
      .work = driver->accepted.time[3],
      .dissipation = driver->dissipation,
  };
  memcpy(header.magic, "USUBSTAT", sizeof header.magic);
  memcpy(header.time, driver->accepted.time, sizeof header.time);
  header.payload = payload_bytes(driver, header.has_force);
  return header;
}

size_t usub_state_size(const usub_driver *driver) {
  if (!driver) return 0;
  return sizeof(state_header) + payload_bytes(driver, driver->last_force != NULL);
}

int32_t usub_state_save(const usub_driver *driver, void *buffer, size_t size) {
  if (!driver || !buffer || size < usub_state_size(driver)) return USUB_BAD_ARGUMENT;
  state_header header = header_of(driver);
  char *at = (char *)buffer + sizeof header;
  for (int32_t i = 0; i < driver->slot_count; ++i) {
    const usub_slot *slot = &driver->slots[i];
    const size_t bytes = slot->count * slot->element;
    if (slot->port->role != USUB_ROLE_STATE || !bytes) continue;
    memcpy(at, slot->data, bytes);
    at += bytes;
  }
  if (header.has_force) memcpy(at, driver->last_force, force_bytes(driver));
  header.check = check_sum(header, (char *)buffer + sizeof header);
  memcpy(buffer, &header, sizeof header);
  return USUB_OK;
}

/* The first thing that does not fit, or NULL. */
static const char *misfit(const usub_driver *driver, const state_header *saved, size_t size) {
  const state_header mine = header_of(driver);
  if (size < sizeof *saved || memcmp(saved->magic, mine.magic, sizeof mine.magic) != 0)
    return "it is not a state saved by usersub";
  if (saved->byte_order != mine.byte_order) return "it was saved in another byte order";
  if (saved->format != mine.format) return "its format version is another one";
  if (saved->abi_version != mine.abi_version) return "it was saved with another ABI version";
  if (saved->kind != mine.kind || saved->interface != mine.interface)
    return "it belongs to another interface or kind of driver";
  if (saved->single != mine.single) return "it was saved in another precision";
  if (memcmp(saved->sizes, mine.sizes, sizeof mine.sizes) != 0)
    return "its scene has other sizes (points, dimension, states, fields, nodes)";
  if (saved->has_force != 0 && saved->has_force != 1) return "its header is damaged";
  if (saved->payload != payload_bytes(driver, saved->has_force) ||
      size != sizeof *saved + saved->payload)
    return "it is cut short or too long";
  return NULL;
}

int32_t usub_state_load(usub_driver *driver, const void *buffer, size_t size) {
  if (!driver || !buffer) return USUB_BAD_ARGUMENT;
  driver->message[0] = 0;
  if (driver->increment_open)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: a state cannot be loaded while an increment is open", driver->title);
  state_header saved = {0};
  memcpy(&saved, buffer, size < sizeof saved ? size : sizeof saved);
  const char *why = misfit(driver, &saved, size);
  const char *at = (const char *)buffer + sizeof saved;
  if (!why && saved.check != check_sum(saved, at)) why = "its check sum is wrong";
  if (why) return usub_fail(driver, USUB_BAD_STATE, "%s: the saved state does not fit: %s", driver->title, why);
  if (saved.has_force && !driver->last_force && !(driver->last_force = malloc(force_bytes(driver))))
    return usub_fail(driver, USUB_NO_MEMORY, "%s: no memory for the previous force", driver->title);
  for (int32_t i = 0; i < driver->slot_count; ++i) {
    const usub_slot *slot = &driver->slots[i];
    const size_t bytes = slot->count * slot->element;
    if (slot->port->role != USUB_ROLE_STATE || !bytes) continue;
    memcpy(slot->data, at, bytes);
    at += bytes;
  }
  if (saved.has_force) memcpy(driver->last_force, at, force_bytes(driver));
  driver->dissipation = saved.dissipation;
  usub_set_friction_work(driver, saved.work);
  driver->iterated = 0;
  const int32_t status = usub_set_time(driver, saved.step, saved.increment, saved.time[0],
                                       saved.time[1], saved.time[2]);
  driver->accepted = driver->clock;
  return status;
}
