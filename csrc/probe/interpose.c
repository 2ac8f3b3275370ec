/* SPDX-License-Identifier: MIT */
/* For hosts that open a library by its path: dlopen of USERSUB_PROBE_REPLACE gives the probe.
 *
 * It is in effect only if the probe was loaded before the C library, by LD_PRELOAD. */
#include <dlfcn.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "probe.h"

typedef void *(*open_fn)(const char *, int);

static const char *last_part(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

/* The same file; a name without folders stands for any file of that name. */
static int is_meant(const char *path, const char *replaced) {
  if (!strchr(replaced, '/'))
    return strcmp(last_part(path), replaced) == 0;
  char one[PATH_MAX], two[PATH_MAX];
  if (realpath(path, one) && realpath(replaced, two))
    return strcmp(one, two) == 0;
  return strcmp(path, replaced) == 0;
}

/* Looked up at the first call: a constructor of another library may be earlier than ours. */
static void *cannot(const char *path, int mode) {
  (void)path;
  (void)mode;
  return NULL;
}

static open_fn real_open(void) {
  static open_fn found;
  if (!found) {
    void *address = dlsym(RTLD_NEXT, "dlopen");
    memcpy(&found, &address, sizeof found);
    if (!found)
      found = cannot;
  }
  return found;
}

static const char *path_to_open(const char *path) {
  const char *replaced = getenv("USERSUB_PROBE_REPLACE"), *probe = getenv("USERSUB_PROBE");
  return path && replaced && replaced[0] && probe && is_meant(path, replaced) ? probe : path;
}

/* The C library looks for bare names where the caller's run path says. The last call has to be a
 * jump, so that it sees the host as the caller and not this library. */
#if defined(__GNUC__) && !defined(__clang__)
__attribute__((optimize("O2")))
#endif
__attribute__((visibility("default"))) void *
dlopen(const char *path, int mode) {
  const char *opened = path_to_open(path);
  return real_open()(opened, mode);
}
