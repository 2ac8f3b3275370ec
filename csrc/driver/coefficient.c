/* SPDX-License-Identifier: MIT */
/* The coefficient driver: FRIC_COEF and VFRIC_COEF evaluated without enforcement.
 *
 * A legacy routine (and VFRIC_COEF) gets whole blocks of the host's own arrays. A routine of the
 * 2022 generation, or of an unknown one, gets nBlock = 1 in the newer layout unless it promises to
 * be safe for blocks: with one point the older layout is a part of the newer one. */
#include <math.h>
#include <string.h>

#include "internal.h"

enum { COEF = USUB_VFRIC_COEF_FCOEF, DERIV = USUB_VFRIC_COEF_FCOEFDERIV };
enum { FLAGS = USUB_VFRIC_COEF_JFLAGS, RDATA = USUB_VFRIC_COEF_RDATA, SLIP = USUB_VFRIC_COEF_SLIPRATE };
enum { FIELD = USUB_VFRIC_COEF_FIELDAVG };
enum { SLOTS_2022 = 20, SLIP_COLUMNS = 6, RDATA_HEAD = 7 };

static int is_2022(const usub_driver *driver) {
  return usub_interface_key(driver->face) == USUB_INTERFACE_FRIC_COEF_2022;
}

void usub_put_coefficient_common(usub_driver *driver) {
  const usub_counts *count = &driver->counts;
  usub_put_points(driver, USUB_VFRIC_COEF_NBLOCK);
  usub_put_fixed(driver, USUB_VFRIC_COEF_NPROPS, &count->props);
  usub_put_fixed(driver, USUB_VFRIC_COEF_NTEMP, &count->temperatures);
  usub_put_fixed(driver, USUB_VFRIC_COEF_NFIELDS, &count->P);
  usub_put_fixed(driver, FLAGS, driver->clock.flags);
  usub_put_fixed(driver, RDATA, driver->single ? (const void *)driver->clock.time_f
                                               : (const void *)driver->clock.time);
  usub_put_fixed(driver, USUB_VFRIC_COEF_SURFINT, driver->names[0]);
  usub_put_fixed(driver, USUB_VFRIC_COEF_SURFSEC, driver->names[1]);
  usub_put_fixed(driver, USUB_VFRIC_COEF_SURFMAIN, driver->names[2]);
  usub_put_fixed(driver, USUB_VFRIC_COEF_PROPS, driver->props);
}

void usub_coefficient_plan(usub_driver *driver) {
  const size_t real = driver->size.real, fields = (size_t)driver->size.P * real;
  const int modern = is_2022(driver);
  usub_put_coefficient_common(driver);
  if (modern) {
    usub_put_scratch(driver, COEF, 2 * real, 0, "output", "one or two coefficients");
    usub_put_scratch(driver, DERIV, 2 * SLOTS_2022 * real, 0, "output", "derivatives");
    usub_put_scratch(driver, RDATA, 0, (RDATA_HEAD + (size_t)driver->size.S) * real, "computed",
                     "times, rotation, state variables");
    usub_put_scratch(driver, SLIP, SLIP_COLUMNS * real, 0, "computed", "slip data of the points");
    usub_put_scratch(driver, FLAGS, 0, 6 * sizeof(int32_t), "computed", "step, increment, node");
    usub_need_array(driver, SLIP, usub_data(driver, "slip_rate") ? "slip_rate" : "slip_data");
  } else {
    usub_put_array(driver, COEF, "coefficient", NULL);
    usub_put_scratch(driver, DERIV, 3 * real, 0, "output",
                     driver->set.derivatives ? "derivatives" : "not wanted by the scene");
    usub_put_array(driver, SLIP, "slip_rate", NULL);
  }
  usub_put_array(driver, USUB_VFRIC_COEF_PRESSURE, "pressure", NULL);
  if (driver->set.temperatures)
    usub_put_array(driver, USUB_VFRIC_COEF_TEMPAVG, "temperature", NULL);
  else
    usub_put_absent(driver, USUB_VFRIC_COEF_TEMPAVG, real, "the scene has no temperatures");
  usub_need_array(driver, FIELD, "field");
  if (fields && usub_data(driver, "field"))
    usub_put_scratch(driver, FIELD, fields, 0, "gathered", "transposed");
  else
    usub_put_absent(driver, FIELD, fields, "the scene has no fields");
}

/* to[k + n j] = from[(first + k) columns + j], for elements of `real` bytes. */
static void transpose(const char *from, char *to, int32_t first, int32_t n, int32_t columns,
                      size_t real) {
  for (int32_t k = 0; k < n; ++k)
    for (int32_t j = 0; j < columns; ++j)
      memcpy(to + (size_t)(k + n * j) * real,
             from + ((size_t)(first + k) * (size_t)columns + (size_t)j) * real, real);
}

/* What a routine of the 2022 generation gets besides slices (double precision only). */
static void fill_2022(usub_driver *driver, usub_call *call, int32_t first) {
  const double *data = driver->memory.slip_data, *rate = driver->memory.slip_rate;
  double *slip = call->argv[SLIP];
  if (usub_is_live(driver, SLIP)) {
    if (data)
      transpose((const char *)data, (char *)slip, first, call->n, SLIP_COLUMNS, sizeof *slip);
    else
      for (int32_t k = 0; k < call->n * SLIP_COLUMNS; ++k)
        slip[k] = rate && k < call->n ? rate[first + k] : 0.0;
  }
  if (usub_is_live(driver, FLAGS)) {
    int32_t *flags = call->argv[FLAGS];
    const int32_t all[6] = {driver->clock.flags[0], driver->clock.flags[1], driver->clock.iteration,
                            first + 1, driver->size.S, driver->size.F};
    memcpy(flags, all, sizeof all);
  }
  if (usub_is_live(driver, RDATA)) {
    const double head[RDATA_HEAD] = {driver->clock.time[0], driver->clock.time[1],
                                     driver->clock.time[2], 1, 0, 0, 1};
    double *rdata = call->argv[RDATA];
    memcpy(rdata, head, sizeof head);
    if (driver->size.S)
      memcpy(rdata + RDATA_HEAD,
             (double *)driver->memory.state + (size_t)first * (size_t)driver->size.S,
             (size_t)driver->size.S * sizeof *rdata);
  }
}

static double real_at(const void *data, size_t i, int32_t single) {
  return single ? (double)((const float *)data)[i] : ((const double *)data)[i];
}

/* Copies the answer of a 2022 routine to the host's arrays. */
static int32_t empty_2022(usub_driver *driver, usub_call *call, int32_t index, int32_t first) {
  const double *coef = call->argv[COEF];
  double *one = driver->memory.coefficient, *two = driver->memory.second_coefficient;
  for (int32_t k = 0; k < call->n; ++k) {
    one[first + k] = coef[k];
    const int touched = !isnan(coef[call->n + k]);
    if (touched != driver->set.anisotropic)
      return usub_block_fail(driver, call, index, first + k, USUB_CONTRACT,
                             touched ? "%s: the routine set fCoef(%d,2), but the scene is isotropic; "
                                       "set the scene's 'anisotropic' to 1 or leave it alone"
                                     : "%s: the routine left fCoef(%d,2) alone, but the scene is "
                                       "anisotropic",
                             driver->title, k + 1);
    if (two) two[first + k] = coef[call->n + k];
  }
  if (driver->size.S)
    memcpy((double *)driver->memory.state + (size_t)first * (size_t)driver->size.S,
           (double *)call->argv[RDATA] + RDATA_HEAD, (size_t)driver->size.S * sizeof(double));
  return USUB_OK;
}

static void empty_derivatives(usub_driver *driver, const usub_call *call, int32_t first) {
  char *out = driver->memory.derivative;
  const char *in = call->argv[DERIV];
  const size_t real = driver->size.real;
  if (!out) return;
  for (int32_t k = 0; k < call->n; ++k)
    for (int32_t j = 0; j < 3; ++j)
      memcpy(out + (size_t)((first + k) * 3 + j) * real, in + (size_t)(k + call->n * j) * real, real);
}

int32_t usub_coefficient_block(usub_driver *driver, usub_call *call, int32_t index) {
  const int32_t first = index * driver->block, rest = driver->points - first;
  const size_t real = driver->size.real;
  const int modern = is_2022(driver);
  usub_aim(driver, call, first, rest < driver->block ? rest : driver->block);
  const size_t n = (size_t)call->n;
  if (modern) fill_2022(driver, call, first);
  if (usub_is_live(driver, FIELD))
    transpose(driver->memory.field, call->argv[FIELD], first, call->n, driver->size.P, real);
  /* A routine without memory of its own may see bad input, since its answer is thrown away: looking
   * at the input after the call finds it in the nearest cache. */
  const int look_later = driver->routine.thread_safe;
  int32_t status = look_later ? USUB_OK : usub_check_inputs(driver, call, index, first);
  if (status) return status;
  memset(call->argv[COEF], 0, n * real);
  if (modern) /* NaN tells whether an isotropic routine left the second coefficient alone */
    for (size_t k = 0; k < n; ++k) ((double *)call->argv[COEF])[n + k] = NAN;
  if (usub_is_live(driver, DERIV))
    memset(call->argv[DERIV], 0, n * real * (modern ? 2 * SLOTS_2022 : 3));
  char reason[256];
  reason[0] = 0; /* clearing all of it would cost as much as a small call */
  status = usub_call_guarded(driver, call, reason);
  const int32_t seen = look_later ? usub_check_inputs(driver, call, index, first) : USUB_OK;
  if (seen) return seen;
  if (status < 0)
    return usub_block_fail(driver, call, index, call->n == 1 ? first : -1, status,
                           "%s: the routine ended with %s in points %d to %d", driver->title, reason,
                           first, first + call->n - 1);
  ptrdiff_t bad = usub_first_bad(call->argv[COEF], n, driver->single);
  if (bad >= 0)
    return usub_block_fail(driver, call, index, first + (int32_t)bad, USUB_NOT_FINITE,
                           "%s: the routine returned fCoef = %g at point %d", driver->title,
                           real_at(call->argv[COEF], (size_t)bad, driver->single),
                           first + (int32_t)bad);
  if (modern) status = empty_2022(driver, call, index, first);
  if (!status && driver->set.derivatives && usub_is_live(driver, DERIV))
    empty_derivatives(driver, call, first);
  return status;
}

int32_t usub_evaluate(usub_driver *driver) {
  if (!driver) return USUB_BAD_ARGUMENT;
  if (driver->kind != USUB_KIND_OF_COEFFICIENT)
    return usub_fail(driver, USUB_WRONG_ORDER, "usub_evaluate: %s is not in a coefficient driver",
                     driver->title);
  int32_t status = driver->prepared && driver->aimed ? USUB_OK : usub_prepare(driver);
  if (status) return status;
  const size_t bytes = (size_t)driver->size.S * (size_t)driver->size.N * driver->size.real;
  if (bytes) memcpy(driver->state_backup, driver->memory.state, bytes);
  status = usub_run_blocks(driver, usub_coefficient_block);
  if (status < 0 && bytes) memcpy(driver->memory.state, driver->state_backup, bytes);
  if (status >= 0) driver->accepted = driver->clock;
  return status;
}
