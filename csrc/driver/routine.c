/* SPDX-License-Identifier: MIT */
/* Routines: from a library or a function pointer to something that a driver takes. */
#include <ctype.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#include "../runtime/redirect.h"
#include "internal.h"

/* Checks names and makes an empty routine. */
static int32_t routine_new(const char *interface, const char *generation, const char *precision,
                           usub_routine **routine, usub_error *error) {
  const usub_interface *face = interface ? usub_interface_find(interface, generation) : NULL;
  if (!face && interface && usub_interface_find(interface, NULL))
    return usub_error_set(error, USUB_BAD_ARGUMENT,
                          "%s has no generation '%s'; FRIC_COEF has 'legacy' and '2022', the other "
                          "interfaces 'legacy'",
                          interface, generation);
  if (!face)
    return usub_error_set(error, USUB_BAD_ARGUMENT,
                          "unknown interface '%s'; expected fric, fric_coef, vfric, vfriction or "
                          "vfric_coef",
                          interface ? interface : "(null)");
  const int single = precision && strcmp(precision, "single") == 0;
  if (!single && !(precision && strcmp(precision, "double") == 0))
    return usub_error_set(error, USUB_BAD_ARGUMENT, "precision '%s'; expected 'double' or 'single'",
                          precision ? precision : "(null)");
  if (single && face->standard)
    return usub_error_set(error, USUB_NOT_SUPPORTED,
                          "%s exists in double precision only; precision 'single' was asked for",
                          interface);
  usub_routine *made = calloc(1, sizeof *made);
  if (!made)
    return usub_error_set(error, USUB_NO_MEMORY, "no memory for a routine");
  made->face = face;
  made->generation_known = generation && generation[0];
  made->single = single;
  *routine = made;
  return USUB_OK;
}

int32_t usub_routine_open(const char *library, const char *interface, const char *generation,
                          const char *precision, usub_routine **routine, usub_error *error) {
  if (!routine)
    return usub_error_set(error, USUB_BAD_ARGUMENT,
                          "routine: expected a place for the handle, got NULL");
  *routine = NULL;
  usub_routine *made = NULL;
  const int32_t status = routine_new(interface, generation, precision, &made, error);
  if (status)
    return status;
  usub_publish_utilities();
  /* Lazily: other routines of the file may call what only the commercial solver has. */
  void *handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (!handle) {
    const char *why = dlerror();
    free(made);
    return usub_error_set(error, USUB_LOAD_FAILED, "library '%s' cannot be loaded: %s",
                          library ? library : "(this program)", why ? why : "no reason given");
  }
  char symbol[32];
  size_t length = strlen(made->face->name);
  memcpy(symbol, made->face->name, length);
  memcpy(symbol + length, "_", 2);
  void *address = dlsym(handle, symbol);
  if (!address) {
    dlclose(handle);
    free(made);
    return usub_error_set(error, USUB_LOAD_FAILED,
                          "library '%s' has no symbol '%s', so no routine behind %s",
                          library ? library : "(this program)", symbol, interface);
  }
  const char *hash = library ? dlsym(handle, "usub_routine_abi_hash") : NULL;
  if (hash && usub_check_abi(hash, error)) { /* only code that was built with abi.h has one */
    dlclose(handle);
    free(made);
    return USUB_ABI_MISMATCH;
  }
  if (library)
    usub_redirect_stops(handle);
  made->library = handle;
  made->style = USUB_STYLE_FULL;
  memcpy(&made->entry, &address, sizeof address); /* ISO C has no cast from object to function */
  *routine = made;
  return usub_error_set(error, USUB_OK, "%s", "");
}

int32_t usub_routine_create(const char *interface, const char *generation, const char *precision,
                            int32_t style, usub_entry entry, usub_routine **routine,
                            usub_error *error) {
  if (!routine || !entry)
    return usub_error_set(error, USUB_BAD_ARGUMENT, "%s: expected a pointer, got NULL",
                          routine ? "entry" : "routine");
  *routine = NULL;
  if (style != USUB_STYLE_FULL && style != USUB_STYLE_BLOCK && style != USUB_STYLE_POINTS)
    return usub_error_set(error, USUB_BAD_ARGUMENT,
                          "style %d; expected USUB_STYLE_FULL (0), USUB_STYLE_BLOCK (1) or "
                          "USUB_STYLE_POINTS (2)",
                          style);
  usub_routine *made = NULL;
  const int32_t status = routine_new(interface, generation, precision, &made, error);
  if (status)
    return status;
  if (style == USUB_STYLE_POINTS && usub_interface_key(made->face) != USUB_INTERFACE_FRIC) {
    free(made);
    return usub_error_set(error, USUB_BAD_ARGUMENT,
                          "style %d of %s; expected USUB_STYLE_FULL (0) or USUB_STYLE_BLOCK (1), "
                          "since USUB_STYLE_POINTS is for FRIC",
                          style, interface);
  }
  made->style = style;
  made->entry = entry;
  *routine = made;
  return usub_error_set(error, USUB_OK, "%s", "");
}

int32_t usub_routine_set_uses(usub_routine *routine, const unsigned char *uses, int32_t count) {
  if (!routine || !uses || count != routine->face->count)
    return USUB_BAD_ARGUMENT;
  for (int32_t i = 0; i < count; ++i)
    if (uses[i] > 3)
      return USUB_BAD_ARGUMENT;
  memcpy(routine->uses, uses, (size_t)count);
  routine->uses_known = 1;
  return USUB_OK;
}

int32_t usub_routine_set_flag(usub_routine *routine, const char *flag, int32_t value) {
  if (!routine || !flag || (value != 0 && value != 1))
    return USUB_BAD_ARGUMENT;
  if (strcmp(flag, "block_safe") == 0)
    routine->block_safe = value;
  else if (strcmp(flag, "thread_safe") == 0)
    routine->thread_safe = value;
  else
    return USUB_BAD_ARGUMENT;
  return USUB_OK;
}

void usub_routine_free(usub_routine *routine) {
  if (!routine)
    return;
  if (routine->library)
    dlclose(routine->library);
  free(routine);
}
