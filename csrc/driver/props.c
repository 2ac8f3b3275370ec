/* SPDX-License-Identifier: MIT */
/* The properties of a routine. They end where a page ends that nobody may touch, so that a routine
 * that reads one too many is caught instead of getting a number of somebody else. */
#include <float.h>
#include <math.h>
#include <sys/mman.h>
#include <unistd.h>

#include "internal.h"

static int32_t make_pages(usub_driver *driver, size_t bytes) {
  const size_t page = (size_t)sysconf(_SC_PAGESIZE), full = (bytes + page - 1) / page * page;
  void *pages = mmap(NULL, full + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED)
    return USUB_NO_MEMORY;
  driver->props_pages = pages;
  driver->props_bytes = full + page;
  driver->props = driver->props_pages + full - bytes;
  return mprotect(driver->props_pages + full, page, PROT_NONE) == 0 ? USUB_OK : USUB_NO_MEMORY;
}

int32_t usub_props_create(usub_driver *driver, const usub_scene *scene, usub_error *error) {
  const int32_t count = scene->prop_count;
  driver->prop_count = count;
  const size_t real = driver->single ? sizeof(float) : sizeof(double);
  if (make_pages(driver, (size_t)count * real))
    return usub_error_set(error, USUB_NO_MEMORY, "no memory for %d props", count);
  for (int32_t i = 0; i < count; ++i) {
    const double value = scene->props[i];
    if (!driver->single) {
      ((double *)driver->props)[i] = value;
      continue;
    }
    ((float *)driver->props)[i] = (float)value;
    if (isinf((float)value) && !isinf(value))
      return usub_error_set(error, USUB_BAD_ARGUMENT,
                            "%s: props[%d] = %g; single precision ends at %g", driver->title, i,
                            value, (double)FLT_MAX);
  }
  return USUB_OK;
}

void usub_props_free(usub_driver *driver) {
  if (driver->props_pages)
    munmap(driver->props_pages, driver->props_bytes);
}
