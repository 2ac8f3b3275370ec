/* SPDX-License-Identifier: MIT */
/* What FRIC_COEF and VFRIC_COEF share, with and without enforcement. */
#include "fric_coef.h"

#include <math.h>
#include <string.h>

void usub_put_coefficient_common(usub_driver *driver) {
  const usub_counts *count = &driver->counts;
  usub_put_points(driver, USUB_VFRIC_COEF_NBLOCK);
  usub_put_fixed(driver, USUB_VFRIC_COEF_NPROPS, &count->props);
  usub_put_fixed(driver, USUB_VFRIC_COEF_NTEMP, &count->temperatures);
  usub_put_fixed(driver, USUB_VFRIC_COEF_NFIELDS, &count->P);
  usub_put_fixed(driver, USUB_VFRIC_COEF_SURFINT, driver->names[0]);
  usub_put_fixed(driver, USUB_VFRIC_COEF_SURFSEC, driver->names[1]);
  usub_put_fixed(driver, USUB_VFRIC_COEF_SURFMAIN, driver->names[2]);
  usub_put_fixed(driver, USUB_VFRIC_COEF_PROPS, driver->props);
  if (usub_is_2022(driver)) {
    const size_t numbers = USUB_RDATA_HEAD + (size_t)driver->size.S;
    usub_put_scratch(driver, USUB_FLAGS, 0, 6 * sizeof(int32_t), "computed",
                     "step, increment, iteration, node");
    usub_put_scratch(driver, USUB_RDATA, 0, numbers * sizeof(double), "computed",
                     "times, rotation, state variables");
    return;
  }
  usub_put_fixed(driver, USUB_FLAGS, driver->clock.flags);
  usub_put_fixed(driver, USUB_RDATA,
                 driver->single ? (const void *)driver->clock.time_f
                                : (const void *)driver->clock.time);
}

void usub_fill_flags(const usub_driver *driver, const usub_call *call, int32_t node) {
  if (!usub_is_live(driver, USUB_FLAGS))
    return;
  const usub_clock *clock = &driver->clock;
  const int32_t iteration = clock->iteration ? clock->iteration : 1; /* evaluated only */
  const int32_t flags[6] = {clock->flags[0], clock->flags[1], iteration, node,
                            driver->size.S,  driver->size.F};
  memcpy(call->argv[USUB_FLAGS], flags, sizeof flags);
}

void usub_fill_rdata(const usub_driver *driver, const usub_call *call, const double *rotation,
                     const double *state) {
  if (!usub_is_live(driver, USUB_RDATA))
    return;
  static const double identity[4] = {1, 0, 0, 1};
  const size_t S = (size_t)driver->size.S;
  double *rdata = call->argv[USUB_RDATA];
  memcpy(rdata, driver->clock.time, 3 * sizeof *rdata);
  memcpy(rdata + 3, rotation ? rotation : identity, sizeof identity);
  if (S)
    memcpy(rdata + USUB_RDATA_HEAD, state, S * sizeof *rdata);
}

int32_t usub_check_second(usub_driver *driver, usub_call *call, int32_t index, int32_t p,
                          double second) {
  if (isnan(second)) {
    if (!driver->set.anisotropic)
      return USUB_OK;
    return usub_block_fail(
        driver, call, index, p, USUB_CONTRACT,
        "%s: the routine left fCoef(1,2) alone or NaN at point %d, but the scene "
        "is anisotropic",
        driver->title, p);
  }
  if (!driver->set.anisotropic)
    return usub_block_fail(driver, call, index, p, USUB_CONTRACT,
                           "%s: the routine set fCoef(1,2) = %g at point %d, but the scene is "
                           "isotropic; set the scene's 'anisotropic' to 1 or leave it alone",
                           driver->title, second, p);
  if (isfinite(second))
    return USUB_OK;
  return usub_block_fail(driver, call, index, p, USUB_NOT_FINITE,
                         "%s: the routine returned fCoef(1,2) = %g at point %d", driver->title,
                         second, p);
}
