/* SPDX-License-Identifier: MIT */
/* The interfaces, from the generated table. */
#include <string.h>
#include <strings.h>

#include "internal.h"

#define INTERFACE_BEGIN(key, name, generation, solver, bit, count)                                 \
  static const usub_arg args_##key[] = {
#define ARG(name, modern, kind, shape, intent) {name, modern, kind, shape, intent},
#define INTERFACE_END(key)                                                                         \
  }                                                                                                \
  ;
#include "interfaces.inc"
#undef INTERFACE_BEGIN
#undef ARG
#undef INTERFACE_END

/* A second pass makes the rows; their index is USUB_INTERFACE_... */
static const usub_interface interfaces[] = {
#define INTERFACE_BEGIN(key, name, generation, solver, bit, count)                                 \
  {name, generation, solver[0] == 's', bit, args_##key, count},
#define ARG(name, modern, kind, shape, intent)
#define INTERFACE_END(key)
#include "interfaces.inc"
};

const usub_interface *usub_interface_find(const char *name, const char *generation) {
  const usub_interface *found = NULL;
  for (int32_t i = 0; i < USUB_INTERFACE_COUNT; ++i) {
    const usub_interface *face = &interfaces[i];
    if (strcasecmp(face->name, name) != 0)
      continue;
    if (!generation || !generation[0] || strcmp(face->generation, generation) == 0)
      found = face;
  }
  return found;
}

int32_t usub_interface_key(const usub_interface *face) {
  return (int32_t)(face - interfaces);
}

int32_t usub_abi_version(void) {
  return USUB_ABI_VERSION;
}
const char *usub_abi_hash(void) {
  return USUB_ABI_HASH;
}

int32_t usub_check_abi(const char *hash, usub_error *error) {
  if (hash && strcmp(hash, USUB_ABI_HASH) == 0)
    return usub_error_set(error, USUB_OK, "%s", "");
  return usub_error_set(error, USUB_ABI_MISMATCH,
                        "built with argument tables of hash %s, but this library has %s; build it "
                        "again",
                        hash ? hash : "(null)", USUB_ABI_HASH);
}
