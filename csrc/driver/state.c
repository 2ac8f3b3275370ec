/* SPDX-License-Identifier: MIT */
/* Saving and loading committed state.
 *
 * Layout: a header, then every array of role "state" in the order of the port table, then the force
 * of the last step where the driver keeps it. Numbers are in the byte order of the machine; the
 * header says which, and another order is refused, not converted. */
#include <stdlib.h>
#include <string.h>

#include "internal.h"

#define STATE_FORMAT 2u
#define BYTE_ORDER_MARK 0x01020304u

/* No padding: the header is written and summed as it lies in memory. */
typedef struct state_header {
  char magic[8]; /* "USUBSTAT" */
  uint32_t byte_order, format;
  int32_t abi_version, kind, interface, single;
  int32_t sizes[12];
  int32_t has_force, step, increment, timed;
  int32_t enforcement, changing; /* settings that decide what is kept */
  double time[3], work, dissipation;
  uint64_t payload; /* bytes behind the header */
  uint64_t check;   /* FNV-1a of header (with check = 0) and payload */
} state_header;

_Static_assert(sizeof(state_header) == 160, "the header of a saved state has no padding");

void usub_state_keep(usub_driver *driver) {
  if (driver->state_bytes)
    memcpy(driver->state_backup, driver->memory.state, driver->state_bytes);
}

void usub_state_restore(usub_driver *driver) {
  if (driver->state_bytes)
    memcpy(driver->memory.state, driver->state_backup, driver->state_bytes);
}

static uint64_t fnv1a(uint64_t hash, const void *data, size_t size) {
  const unsigned char *bytes = data;
  for (size_t i = 0; i < size; ++i)
    hash = (hash ^ bytes[i]) * 1099511628211u;
  return hash;
}

static uint64_t check_sum(state_header header, const void *payload) {
  header.check = 0;
  return fnv1a(fnv1a(14695981039346656037u, &header, sizeof header), payload, header.payload);
}

static size_t payload_bytes(const usub_driver *driver, int with_force) {
  size_t total = with_force ? usub_force_bytes(driver) : 0;
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
      /* A standard driver keeps the same arrays whatever its settings: the next step of a host may
       * enforce or change friction in another way. */
      .enforcement = driver->kind == USUB_KIND_OF_EXPLICIT ? (int32_t)driver->enforcement : 0,
      .changing = driver->kind == USUB_KIND_OF_EXPLICIT ? driver->set.changing : 0,
      .step = driver->accepted.flags[0],
      .increment = driver->accepted.flags[1],
      .timed = driver->accepted.timed,
      .work = driver->accepted.time[3],
      .dissipation = driver->dissipation,
  };
  memcpy(header.magic, "USUBSTAT", sizeof header.magic);
  memcpy(header.time, driver->accepted.time, sizeof header.time);
  header.payload = payload_bytes(driver, header.has_force);
  return header;
}

size_t usub_state_size(const usub_driver *driver) {
  if (!driver)
    return 0;
  return sizeof(state_header) + payload_bytes(driver, driver->last_force != NULL);
}

int32_t usub_state_save(const usub_driver *driver, void *buffer, size_t size) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  usub_driver *speaker = (usub_driver *)(uintptr_t)driver; /* only its message may change */
  usub_start_call(speaker);
  const size_t needed = usub_state_size(driver);
  if (!buffer || size < needed)
    return usub_fail(speaker, USUB_BAD_ARGUMENT,
                     "%s: the saved state takes %zu bytes; there are %zu%s", driver->title, needed,
                     size, buffer ? "" : ", at NULL");
  state_header header = header_of(driver);
  char *at = (char *)buffer + sizeof header;
  for (int32_t i = 0; i < driver->slot_count; ++i) {
    const usub_slot *slot = &driver->slots[i];
    const size_t bytes = slot->count * slot->element;
    if (slot->port->role != USUB_ROLE_STATE || !bytes)
      continue;
    memcpy(at, slot->data, bytes);
    at += bytes;
  }
  if (header.has_force)
    memcpy(at, driver->last_force, usub_force_bytes(driver));
  header.check = check_sum(header, (char *)buffer + sizeof header);
  memcpy(buffer, &header, sizeof header);
  return USUB_OK;
}

/* Whether the numbers of a header can be those of a driver. */
static int is_sound(const usub_driver *driver, const state_header *saved) {
  const int may_have_force = driver->kind == USUB_KIND_OF_EXPLICIT;
  const double numbers[4] = {saved->time[0], saved->time[1], saved->time[2], saved->work};
  return (saved->has_force == 0 || (saved->has_force == 1 && may_have_force)) &&
         (saved->timed == 0 || saved->timed == 1) && usub_first_bad_of_few(numbers, 4) < 0 &&
         saved->time[2] >= 0;
}

/* The first thing that does not fit, or NULL. */
static const char *misfit(const usub_driver *driver, const state_header *saved, size_t size,
                          const char *payload) {
  const state_header mine = header_of(driver);
  if (memcmp(saved->magic, mine.magic, sizeof mine.magic) != 0)
    return "it is not a state saved by usersub";
  if (saved->byte_order != mine.byte_order)
    return "it was saved in another byte order";
  if (saved->format != mine.format)
    return "its format version is another one";
  if (saved->abi_version != mine.abi_version)
    return "it was saved with another ABI version";
  if (saved->kind != mine.kind || saved->interface != mine.interface)
    return "it belongs to another interface or kind of driver";
  if (saved->single != mine.single)
    return "it was saved in another precision";
  if (memcmp(saved->sizes, mine.sizes, sizeof mine.sizes) != 0)
    return "its scene has other sizes (points, dimension, states, fields, nodes)";
  if (saved->enforcement != mine.enforcement || saved->changing != mine.changing)
    return "its scene enforces sticking or changes friction in another way";
  if (!is_sound(driver, saved))
    return "its header is damaged";
  if (saved->payload != payload_bytes(driver, saved->has_force) ||
      size != sizeof *saved + saved->payload)
    return "it is cut short or too long";
  return saved->check == check_sum(*saved, payload) ? NULL : "its check sum is wrong";
}

/* Whether the saved conditions are such that a routine may be given as LM. */
static int conditions_fit(const usub_driver *driver, const char *payload) {
  for (int32_t i = 0; i < driver->slot_count; ++i) {
    const usub_slot *slot = &driver->slots[i];
    if (slot->port->role != USUB_ROLE_STATE)
      continue;
    for (size_t j = 0; slot->port->kind == USUB_KIND_INT && j < slot->count; ++j) {
      int32_t condition;
      memcpy(&condition, payload + j * sizeof condition, sizeof condition);
      if (condition < 0 || condition > 2)
        return 0;
    }
    payload += slot->count * slot->element;
  }
  return 1;
}

/* Copies a payload that was found to fit. */
static void take_payload(usub_driver *driver, const char *payload, int has_force) {
  for (int32_t i = 0; i < driver->slot_count; ++i) {
    const usub_slot *slot = &driver->slots[i];
    const size_t bytes = slot->count * slot->element;
    if (slot->port->role != USUB_ROLE_STATE || !bytes)
      continue;
    memcpy(slot->data, payload, bytes);
    payload += bytes;
  }
  if (has_force)
    memcpy(driver->last_force, payload, usub_force_bytes(driver));
  else if (driver->last_force)
    memset(driver->last_force, 0, usub_force_bytes(driver));
}

static int32_t refuse(usub_driver *driver, const char *why) {
  return usub_fail(driver, USUB_BAD_STATE, "%s: the saved state does not fit: %s", driver->title,
                   why);
}

int32_t usub_state_load(usub_driver *driver, const void *buffer, size_t size) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  usub_start_call(driver);
  if (!buffer)
    return usub_fail(driver, USUB_BAD_ARGUMENT, "%s: the saved state is NULL", driver->title);
  if (driver->last.open)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: a state cannot be loaded while an increment is open", driver->title);
  state_header saved;
  if (size < sizeof saved)
    return refuse(driver, "it is not a state saved by usersub");
  memcpy(&saved, buffer, sizeof saved);
  const char *payload = (const char *)buffer + sizeof saved;
  const char *why = misfit(driver, &saved, size, payload);
  if (!why && !conditions_fit(driver, payload))
    why = "a condition is not 0, 1 or 2";
  if (why)
    return refuse(driver, why);
  if (saved.has_force && !driver->last_force &&
      !(driver->last_force = malloc(usub_force_bytes(driver))))
    return usub_fail(driver, USUB_NO_MEMORY, "%s: no memory for the previous force", driver->title);
  /* The clock is the only part that may still be refused: times beyond single precision. */
  const usub_clock before = driver->clock;
  int32_t status = usub_set_friction_work(driver, saved.work);
  if (!status)
    status = usub_set_time(driver, saved.step, saved.increment, saved.time[0], saved.time[1],
                           saved.time[2]);
  if (status) {
    driver->clock = before;
    return refuse(driver, "its header is damaged");
  }
  take_payload(driver, payload, saved.has_force);
  driver->dissipation = saved.dissipation;
  driver->clock.timed = saved.timed;
  driver->accepted = driver->clock;
  return USUB_OK;
}
