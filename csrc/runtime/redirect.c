/* SPDX-License-Identifier: MIT */
/* Libraries that were built without us (no --wrap, not linked with the utility routines): their
 * calls of exit, STOP and the like, and of utility routines that nothing else defines, are pointed
 * to ours after loading, in the table of addresses through which a shared library calls others.
 * Calls of what exists nowhere go to a function that says so.
 * Only that library's own calls change: those of its dependencies, as of the Fortran input and
 * output library, do not. ELF on x86-64 and aarch64; elsewhere nothing is redirected. */
#include "redirect.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "missing.h"
#include "units.h"

/* NULL if it cannot be found. Never closed: it is this library. */
static void *own_handle(Dl_info *own) {
  if (dladdr((void *)(uintptr_t)&usub_redirect_stops, own) == 0)
    return NULL;
  return dlopen(own->dli_fname, RTLD_NOW | RTLD_NOLOAD);
}

int32_t usub_publish_utilities(void) {
  Dl_info own;
  if (own_handle(&own) == NULL ||
      dlopen(own.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_GLOBAL) == NULL)
    return USUB_LOAD_FAILED;
  return USUB_OK;
}

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))

#include <elf.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#if defined(__x86_64__)
enum { CALL_SLOT = R_X86_64_JUMP_SLOT, DATA_SLOT = R_X86_64_GLOB_DAT };
#else
enum { CALL_SLOT = R_AARCH64_JUMP_SLOT, DATA_SLOT = R_AARCH64_GLOB_DAT };
#endif

/** A loaded library: its tables, and the part of it that the loader has closed for writing. */
typedef struct image {
  void *handle;
  uintptr_t base;
  const ElfW(Sym) * symbols;
  const char *names;
  const ElfW(Rela) * relocations[2];
  size_t count[2];
  uintptr_t closed_low, closed_high;
} image;

static const void *address(const image *library, ElfW(Addr) pointer) {
  /* The C library of GNU has added the base already, others have not. */
  uintptr_t place = pointer < library->base ? library->base + pointer : pointer;
  return (const void *)place;
}

static void read_dynamic(image *library, const ElfW(Dyn) * entry) {
  for (; entry->d_tag != DT_NULL; entry++) {
    ElfW(Addr) pointer = entry->d_un.d_ptr;
    switch (entry->d_tag) {
    case DT_SYMTAB:
      library->symbols = address(library, pointer);
      break;
    case DT_STRTAB:
      library->names = address(library, pointer);
      break;
    case DT_JMPREL:
      library->relocations[0] = address(library, pointer);
      break;
    case DT_PLTRELSZ:
      library->count[0] = entry->d_un.d_val / sizeof(ElfW(Rela));
      break;
    case DT_RELA:
      library->relocations[1] = address(library, pointer);
      break;
    case DT_RELASZ:
      library->count[1] = entry->d_un.d_val / sizeof(ElfW(Rela));
      break;
    default:
      break;
    }
  }
}

static int find_closed(struct dl_phdr_info *info, size_t size, void *context) {
  image *library = context;
  (void)size;
  if (info->dlpi_addr != library->base)
    return 0;
  uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
  for (int i = 0; i < info->dlpi_phnum; i++) {
    const ElfW(Phdr) *part = &info->dlpi_phdr[i];
    if (part->p_type == PT_GNU_RELRO) {
      library->closed_low = (library->base + part->p_vaddr) & ~(page - 1);
      library->closed_high = (library->base + part->p_vaddr + part->p_memsz) & ~(page - 1);
    }
  }
  return 1;
}

static int protect(const image *library, int access) {
  size_t size = library->closed_high - library->closed_low;
  return size == 0 || mprotect((void *)library->closed_low, size, access) == 0;
}

/* RTLD_DEFAULT would also look into libraries that are linked with this one. */
static int is_nowhere(const image *library, const char *name) {
  void *program = dlopen(NULL, RTLD_LAZY);
  if (program == NULL)
    return 0;
  int nowhere = dlsym(library->handle, name) == NULL && dlsym(program, name) == NULL;
  dlclose(program);
  return nowhere;
}

/* Our function for a symbol that the library does not define itself; NULL to leave it alone. */
static void *replacement(const image *library, void *own, const void *own_base, const char *name,
                         int call) {
  char wrapped[256];
  Dl_info found;
  snprintf(wrapped, sizeof wrapped, "__wrap_%s", name);
  void *ours = dlsym(own, wrapped);
  if (ours == NULL && dlsym(library->handle, name) == NULL)
    ours = dlsym(own, name);
  if (ours == NULL && call && is_nowhere(library, name))
    return usub_missing_slot(name);
  if (ours == NULL || dladdr(ours, &found) == 0 || found.dli_fbase != own_base)
    return NULL;
  return ours;
}

static int32_t redirect(const image *library, void *own, const void *own_base) {
  int32_t changed = 0;
  for (int t = 0; t < 2; t++) {
    for (size_t i = 0; i < library->count[t]; i++) {
      const ElfW(Rela) *entry = &library->relocations[t][i];
      unsigned long kind = ELF64_R_TYPE(entry->r_info);
      const ElfW(Sym) *symbol = &library->symbols[ELF64_R_SYM(entry->r_info)];
      if ((kind != CALL_SLOT && kind != DATA_SLOT) || symbol->st_shndx != SHN_UNDEF)
        continue;
      const char *name = library->names + symbol->st_name;
      int call = kind == CALL_SLOT && ELF64_ST_BIND(symbol->st_info) != STB_WEAK;
      void *ours = replacement(library, own, own_base, name, call);
      if (ours == NULL)
        continue;
      *(void *volatile *)(library->base + entry->r_offset) = ours;
      changed++;
    }
  }
  return changed;
}

int32_t usub_redirect_stops(void *library) {
  Dl_info own;
  void *self = own_handle(&own);
  struct link_map *map = NULL;
  if (library == NULL || self == NULL || dlinfo(library, RTLD_DI_LINKMAP, &map) != 0)
    return USUB_BAD_ARGUMENT;
  usub_units_find(library);
  image loaded = {.handle = library, .base = map->l_addr};
  if (loaded.base == 0) /* the program itself */
    return 0;
  read_dynamic(&loaded, map->l_ld);
  dl_iterate_phdr(find_closed, &loaded);
  if (loaded.symbols == NULL || loaded.names == NULL)
    return 0;
  if (!protect(&loaded, PROT_READ | PROT_WRITE))
    return USUB_NOT_SUPPORTED;
  int32_t changed = redirect(&loaded, self, own.dli_fbase);
  protect(&loaded, PROT_READ);
  return changed;
}

#else

int32_t usub_redirect_stops(void *library) {
  return library == NULL ? USUB_BAD_ARGUMENT : 0;
}

#endif
