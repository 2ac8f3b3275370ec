/* SPDX-License-Identifier: MIT */
/* Enforcement by the explicit driver: which scenes it serves, its memory, what an increment leaves.
 * The arithmetic stands in explicit_enforce.inc. */
#include <stdlib.h>
#include <string.h>

#include "explicit.h"

/* A scene with a stick slope and nothing else said means penalty enforcement. */
usub_enforcement usub_explicit_enforcement(const usub_driver *driver) {
  const int softened = usub_is_coefficient(driver) && driver->set.stick_slope > 0;
  return driver->enforcement == USUB_ENFORCE_DEFAULT && softened ? USUB_ENFORCE_PENALTY
                                                                 : driver->enforcement;
}

int usub_explicit_owns(const usub_driver *driver, const char *port) {
  const int penalty = driver->enforcement == USUB_ENFORCE_PENALTY;
  if (strcmp(port, "condition") == 0)
    return driver->enforcement != USUB_ENFORCE_DEFAULT;
  if (strcmp(port, "stick_force") == 0)
    return driver->enforcement != USUB_ENFORCE_DEFAULT && !usub_is_elastic(driver);
  if (strcmp(port, "elastic_slip") == 0)
    return usub_is_elastic(driver);
  if (strcmp(port, "last_normal") == 0)
    return penalty;
  return -1;
}

int32_t usub_explicit_create(usub_driver *driver) {
  if (driver->enforcement == USUB_ENFORCE_DEFAULT)
    return USUB_OK;
  const size_t n = (size_t)driver->size.N;
  driver->trial_condition = malloc(n * sizeof *driver->trial_condition);
  if (!driver->trial_condition)
    return USUB_NO_MEMORY;
  int32_t *condition = driver->memory.condition;
  for (size_t i = 0; i < n; ++i)
    condition[i] = 2; /* open, as before the first increment */
  if (!usub_is_elastic(driver))
    return USUB_OK;
  driver->trial_elastic = calloc(n * (size_t)driver->size.D, driver->size.real);
  if (driver->set.dissipation)
    driver->point_dissipation = calloc(n, sizeof *driver->point_dissipation);
  return driver->trial_elastic && (driver->point_dissipation || !driver->set.dissipation)
             ? USUB_OK
             : USUB_NO_MEMORY;
}

void usub_explicit_free(usub_driver *driver) {
  free(driver->trial_condition);
  free(driver->trial_elastic);
  free(driver->point_dissipation);
}

void usub_explicit_keep(usub_driver *driver) {
  const size_t n = (size_t)driver->points, all = (size_t)driver->size.N;
  const size_t vector = (size_t)driver->size.D * driver->size.real;
  int32_t *condition = driver->memory.condition;
  memcpy(condition, driver->trial_condition, n * sizeof *condition);
  for (size_t i = n; i < all; ++i)
    condition[i] = 2;
  if (usub_is_elastic(driver)) {
    memcpy(driver->memory.elastic_slip, driver->trial_elastic, n * vector);
    memset((char *)driver->memory.elastic_slip + n * vector, 0, (all - n) * vector);
  }
  if (driver->enforcement != USUB_ENFORCE_PENALTY)
    return;
  char *kept = driver->memory.last_normal;
  const char *normal = driver->memory.normal;
  for (size_t i = 0; i < n; ++i)
    memcpy(kept + usub_force_column(driver, (int32_t)i) * vector, normal + i * vector, vector);
}
