/* SPDX-License-Identifier: MIT */
/* What the hosts of this folder share. Each is a healthy host that breaks one rule on demand:
 *
 *     host LIBRARY INTERFACE FAULT
 *
 * FAULT is a name that the source asks for by `is("name")`; "none" is the healthy host. */
#ifndef USUB_META_COMMON_H
#define USUB_META_COMMON_H

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <usersub/usersub.h>

/* The hidden lengths of the calls below are a variable here, to be wrong on demand. */
static size_t name_length = USUB_NAME_LENGTH;
#undef USUB_NAME_LENGTH
#define USUB_NAME_LENGTH name_length
#include "call.inc"
#undef USUB_NAME_LENGTH
#define USUB_NAME_LENGTH 80

static const char *fault = "none";

static int is(const char *name) {
  return strcmp(fault, name) == 0;
}

static usub_entry entry_of(const char *library, const char *interface) {
  void *handle = dlopen(library, RTLD_NOW), *address;
  char symbol[40];
  usub_entry entry;
  snprintf(symbol, sizeof symbol, "%s_", interface);
  address = handle ? dlsym(handle, symbol) : NULL;
  if (!address) {
    fprintf(stderr, "cannot load %s of %s: %s\n", symbol, library, dlerror());
    exit(2);
  }
  memcpy(&entry, &address, sizeof entry);
  return entry;
}

static void name(char to[80], const char *from) {
  memset(to, is("name-nul") ? 0 : ' ', 80);
  memcpy(to + is("name-shifted"), from, strlen(from));
  if (is("name-lower"))
    for (int i = 0; i < 80; ++i)
      to[i] = (char)(to[i] >= 'A' && to[i] <= 'Z' ? to[i] + 32 : to[i]);
}

/* Memory that ends at a page which cannot be touched. */
static inline void *at_the_end(size_t bytes) {
  const size_t page = (size_t)sysconf(_SC_PAGESIZE);
  char *pages = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  mprotect(pages + page, page, PROT_NONE);
  return pages + page - bytes;
}

static void misbehave(void) {
  if (is("crash"))
    *(volatile int *)16 = 1;
  while (is("hang"))
    usleep(1000);
  if (is("exit"))
    exit(3);
}

#endif
