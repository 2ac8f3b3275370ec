/* SPDX-License-Identifier: MIT */
/* Positions of the arguments that the explicit interfaces share in meaning but not in place. */
#ifndef USERSUB_EXPLICIT_H
#define USERSUB_EXPLICIT_H

#include "internal.h"

/** A loop that is compiled once for each set of constants that it is called with: one source, and a
 * machine loop of its own for two and three dimensions, with and without enforcement. */
#define USUB_SPECIALISED static inline __attribute__((always_inline))

typedef struct usub_explicit_map {
  int32_t force, slip, previous, direction, state;
} usub_explicit_map;

static inline usub_explicit_map usub_explicit_positions(const usub_driver *driver) {
  if (usub_interface_key(driver->face) == USUB_INTERFACE_VFRIC)
    return (usub_explicit_map){USUB_VFRIC_FTANGENTIAL, USUB_VFRIC_DSLIPFRIC, USUB_VFRIC_FTANGPREV,
                               USUB_VFRIC_DIRCOSSL, USUB_VFRIC_STATEV};
  return (usub_explicit_map){USUB_VFRICTION_FTANGENTIAL, USUB_VFRICTION_DSLIPFRIC,
                             USUB_VFRICTION_FTANGPREV, USUB_VFRICTION_DIRCOSSL,
                             USUB_VFRICTION_STATE};
}

static inline int usub_is_vfric(const usub_driver *driver) {
  return usub_interface_key(driver->face) == USUB_INTERFACE_VFRIC;
}

static inline int usub_is_coefficient(const usub_driver *driver) {
  return usub_interface_key(driver->face) == USUB_INTERFACE_VFRIC_COEF;
}

/** Column of the driver's own previous forces that belongs to a point: VFRIC's points come and go,
 * so that theirs stay with the secondary node. */
static inline size_t usub_force_column(const usub_driver *driver, int32_t point) {
  const int32_t *node = usub_is_vfric(driver) ? driver->memory.secondary_node : NULL;
  return node ? (size_t)node[point] - 1 : (size_t)point;
}

/** VFRIC_COEF by penalty: the driver keeps elastic slips. */
static inline int usub_is_elastic(const usub_driver *driver) {
  return driver->enforcement == USUB_ENFORCE_PENALTY && usub_is_coefficient(driver);
}

/** Whether something is divided by the time increment. */
static inline int usub_needs_time(const usub_driver *driver) {
  return driver->enforcement == USUB_ENFORCE_KINEMATIC || driver->set.damping > 0;
}

/* explicit_enforcement.c */
/** Keeps conditions, elastic slips and normals of an increment that has succeeded. */
void usub_explicit_keep(usub_driver *driver);

#endif
