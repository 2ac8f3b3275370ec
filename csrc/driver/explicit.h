/* SPDX-License-Identifier: MIT */
/* Positions of the arguments that the explicit interfaces share in meaning but not in place. */
#ifndef USERSUB_EXPLICIT_H
#define USERSUB_EXPLICIT_H

#include "internal.h"

typedef struct usub_explicit_map {
  int32_t force, slip, previous, direction; /* fTangential, dSlipFric, fTangPrev, dirCosSl */
} usub_explicit_map;

static inline usub_explicit_map usub_explicit_positions(const usub_driver *driver) {
  if (usub_interface_key(driver->face) == USUB_INTERFACE_VFRIC)
    return (usub_explicit_map){USUB_VFRIC_FTANGENTIAL, USUB_VFRIC_DSLIPFRIC, USUB_VFRIC_FTANGPREV,
                               USUB_VFRIC_DIRCOSSL};
  return (usub_explicit_map){USUB_VFRICTION_FTANGENTIAL, USUB_VFRICTION_DSLIPFRIC,
                             USUB_VFRICTION_FTANGPREV, USUB_VFRICTION_DIRCOSSL};
}

static inline int usub_is_coefficient(const usub_driver *driver) {
  return usub_interface_key(driver->face) == USUB_INTERFACE_VFRIC_COEF;
}

#endif
