/* SPDX-License-Identifier: MIT */
/* What FRIC_COEF and VFRIC_COEF share, with and without enforcement: their arguments have the same
 * positions in all generations. */
#ifndef USERSUB_FRIC_COEF_H
#define USERSUB_FRIC_COEF_H

#include "internal.h"

enum {
  USUB_COEF = USUB_FRIC_COEF_2022_FCOEF,
  USUB_DERIV = USUB_FRIC_COEF_2022_FCOEFDERIV,
  USUB_FLAGS = USUB_FRIC_COEF_2022_IDATA,
  USUB_RDATA = USUB_FRIC_COEF_2022_RDATA,
  USUB_SLIP = USUB_FRIC_COEF_2022_SLIPDATA,
  USUB_PRESSURE = USUB_FRIC_COEF_2022_PRESSURE,
  USUB_TEMP = USUB_FRIC_COEF_2022_TEMPAVG,
  USUB_FIELD = USUB_FRIC_COEF_2022_FIELDAVG
};

/** Numbers of the 2022 generation: derivatives with and without a published name, columns of
 * slipData, rData in front of the state variables; and derivatives of the legacy one. */
enum {
  USUB_DERIVATIVES = 20,
  USUB_NAMED_DERIVATIVES = 8,
  USUB_SLIP_COLUMNS = 6,
  USUB_RDATA_HEAD = 7,
  USUB_LEGACY_DERIVATIVES = 3
};

static inline int usub_is_2022(const usub_driver *driver) {
  return usub_interface_key(driver->face) == USUB_INTERFACE_FRIC_COEF_2022;
}

/** Plans counts, names, properties, flags and times. */
void usub_put_coefficient_common(usub_driver *driver);
/** Fills iData and rData for one point: its node number, the rotation of its directions (NULL:
 * none) and its state variables. */
void usub_fill_flags(const usub_driver *driver, const usub_call *call, int32_t node);
void usub_fill_rdata(const usub_driver *driver, const usub_call *call, const double *rotation,
                     const double *state);
/** Refuses a second coefficient that an isotropic routine set, or an anisotropic one did not.
 * @param second  what stands there after the call; NaN before it */
int32_t usub_check_second(usub_driver *driver, usub_call *call, int32_t index, int32_t p,
                          double second);

#endif
