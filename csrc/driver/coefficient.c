/* SPDX-License-Identifier: MIT */
/* The coefficient driver: FRIC_COEF and VFRIC_COEF evaluated without enforcement.
 *
 * A legacy routine (and VFRIC_COEF) gets whole blocks of the host's own arrays. A routine of the
 * 2022 generation, or of an unknown one, gets nBlock = 1 in the newer layout unless it promises to
 * be safe for blocks: with one point the older layout is a part of the newer one. */
#include <math.h>
#include <string.h>

#include "fric_coef.h"

void usub_coefficient_plan(usub_driver *driver) {
  const size_t real = driver->size.real, fields = (size_t)driver->size.P * real;
  usub_put_coefficient_common(driver);
  if (usub_is_2022(driver)) {
    usub_put_scratch(driver, USUB_COEF, 2 * real, 0, "output", "one or two coefficients");
    usub_put_scratch(driver, USUB_DERIV, 2 * USUB_DERIVATIVES * real, 0, "output", "derivatives");
    usub_put_scratch(driver, USUB_SLIP, USUB_SLIP_COLUMNS * real, 0, "computed",
                     "slip data of the points");
    if (!usub_data(driver, "slip_rate"))
      usub_need_array(driver, USUB_SLIP, "slip_data");
  } else {
    usub_put_array(driver, USUB_COEF, "coefficient", NULL);
    usub_put_scratch(driver, USUB_DERIV, USUB_LEGACY_DERIVATIVES * real, 0, "output",
                     driver->set.derivatives ? "derivatives" : "not wanted by the scene");
    usub_put_array(driver, USUB_SLIP, "slip_rate", NULL);
  }
  usub_put_array(driver, USUB_PRESSURE, "pressure", NULL);
  if (driver->set.temperatures)
    usub_put_array(driver, USUB_TEMP, "temperature", NULL);
  else
    usub_put_absent(driver, USUB_TEMP, real, "the scene has no temperatures");
  usub_need_array(driver, USUB_FIELD, "field");
  if (fields && usub_data(driver, "field"))
    usub_put_scratch(driver, USUB_FIELD, fields, 0, "gathered", "transposed");
  else
    usub_put_absent(driver, USUB_FIELD, fields,
                    fields ? "nothing is bound: zeros" : "the scene has no fields");
}

/* to[k + n j] = from[(first + k) columns + j], for elements of `real` bytes. */
static void transpose(const char *from, char *to, int32_t first, int32_t n, int32_t columns,
                      size_t real) {
  const size_t rows = (size_t)n, width = (size_t)columns;
  for (size_t k = 0; k < rows; ++k)
    for (size_t j = 0; j < width; ++j)
      memcpy(to + (k + rows * j) * real, from + (((size_t)first + k) * width + j) * real, real);
}

/* What a routine of the 2022 generation gets besides slices (double precision only). */
static void fill_2022(usub_driver *driver, usub_call *call, int32_t first) {
  const double *data = driver->memory.slip_data, *rate = driver->memory.slip_rate;
  const double *state = driver->memory.state;
  const size_t n = (size_t)call->n, S = (size_t)driver->size.S;
  if (usub_is_live(driver, USUB_SLIP)) {
    double *slip = call->argv[USUB_SLIP];
    memset(slip, 0, n * USUB_SLIP_COLUMNS * sizeof *slip);
    if (data)
      transpose((const char *)data, (char *)slip, first, call->n, USUB_SLIP_COLUMNS, sizeof *slip);
    else if (rate)
      memcpy(slip, rate + first, n * sizeof *slip);
  }
  usub_fill_flags(driver, call, first + 1);
  usub_fill_rdata(driver, call, NULL, state ? state + (size_t)first * S : NULL);
}

static double real_at(const void *data, size_t i, int32_t single) {
  return single ? (double)((const float *)data)[i] : ((const double *)data)[i];
}

/* Copies the answer of a 2022 routine to the host's arrays. */
static int32_t empty_2022(usub_driver *driver, usub_call *call, int32_t index, int32_t first) {
  const double *coef = call->argv[USUB_COEF];
  double *one = driver->memory.coefficient, *two = driver->memory.second_coefficient;
  for (int32_t k = 0; k < call->n; ++k) {
    one[first + k] = coef[k];
    const int32_t status = usub_check_second(driver, call, index, first + k, coef[call->n + k]);
    if (status)
      return status;
    if (two)
      two[first + k] = coef[call->n + k];
  }
  const int32_t S = driver->size.S;
  if (!S || !usub_is_live(driver, USUB_RDATA))
    return USUB_OK;
  const double *after = (const double *)call->argv[USUB_RDATA] + USUB_RDATA_HEAD;
  const int32_t bad = usub_first_bad_of_few(after, S);
  if (bad >= 0)
    return usub_block_fail(driver, call, index, first, USUB_NOT_FINITE,
                           "%s: the routine left state variable %d = %g at point %d", driver->title,
                           bad + 1, after[bad], first);
  memcpy((double *)driver->memory.state + (size_t)first * (size_t)S, after,
         (size_t)S * sizeof *after);
  return USUB_OK;
}

static int32_t empty_derivatives(usub_driver *driver, usub_call *call, int32_t index,
                                 int32_t first) {
  char *out = driver->memory.derivative;
  const char *in = call->argv[USUB_DERIV];
  const size_t real = driver->size.real, n = (size_t)call->n, named = USUB_LEGACY_DERIVATIVES;
  if (!out || !usub_is_live(driver, USUB_DERIV))
    return USUB_OK;
  const ptrdiff_t bad = usub_first_bad(in, n * named, driver->single);
  if (bad >= 0) {
    const int32_t point = first + (int32_t)((size_t)bad % n);
    return usub_block_fail(driver, call, index, point, USUB_NOT_FINITE,
                           "%s: the routine returned fCoefDeriv(%d) = %g at point %d",
                           driver->title, (int)((size_t)bad / n) + 1,
                           real_at(in, (size_t)bad, driver->single), point);
  }
  for (size_t k = 0; k < n; ++k)
    for (size_t j = 0; j < named; ++j)
      memcpy(out + (((size_t)first + k) * named + j) * real, in + (k + n * j) * real, real);
  return USUB_OK;
}

/* Outputs start from zero; NaN tells whether a second coefficient was left alone. */
static void clear_outputs(const usub_driver *driver, const usub_call *call) {
  const size_t real = driver->size.real, n = (size_t)call->n;
  const int modern = usub_is_2022(driver);
  memset(call->argv[USUB_COEF], 0, n * real);
  for (size_t k = 0; modern && k < n; ++k)
    ((double *)call->argv[USUB_COEF])[n + k] = NAN;
  if (usub_is_live(driver, USUB_DERIV))
    memset(call->argv[USUB_DERIV], 0,
           n * real * (modern ? 2 * USUB_DERIVATIVES : USUB_LEGACY_DERIVATIVES));
}

int32_t usub_coefficient_block(usub_driver *driver, usub_call *call, int32_t index) {
  const int32_t first = index * driver->block, rest = driver->points - first;
  const int modern = usub_is_2022(driver);
  usub_aim(driver, call, first, rest < driver->block ? rest : driver->block);
  if (modern)
    fill_2022(driver, call, first);
  if (usub_is_live(driver, USUB_FIELD))
    transpose(driver->memory.field, call->argv[USUB_FIELD], first, call->n, driver->size.P,
              driver->size.real);
  /* A routine without memory of its own may see bad input, since its answer is thrown away: looking
   * at the input after the call finds it in the nearest cache (a fifth of the whole time at a
   * million points, see the benchmarks). */
  const int look_later = driver->routine.thread_safe && !driver->checked;
  int32_t status = look_later ? USUB_OK : usub_check_inputs(driver, call, index, first);
  if (status)
    return status;
  clear_outputs(driver, call);
  char reason[256];
  reason[0] = 0; /* clearing all of it would cost as much as a small call */
  status = usub_call_guarded(driver, call, reason);
  const int32_t seen = look_later ? usub_check_inputs(driver, call, index, first) : USUB_OK;
  if (seen)
    return seen;
  if (status < 0)
    return usub_ended(driver, call, index, first, status, reason);
  const ptrdiff_t bad = usub_first_bad(call->argv[USUB_COEF], (size_t)call->n, driver->single);
  if (bad >= 0)
    return usub_block_fail(driver, call, index, first + (int32_t)bad, USUB_NOT_FINITE,
                           "%s: the routine returned fCoef = %g at point %d", driver->title,
                           real_at(call->argv[USUB_COEF], (size_t)bad, driver->single),
                           first + (int32_t)bad);
  if (modern)
    status = empty_2022(driver, call, index, first);
  return status < 0 ? status : empty_derivatives(driver, call, index, first);
}

int32_t usub_evaluate(usub_driver *driver) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  usub_start_call(driver);
  if (driver->kind != USUB_KIND_OF_COEFFICIENT)
    return usub_fail(driver, USUB_WRONG_ORDER, "usub_evaluate: %s is not in a coefficient driver",
                     driver->title);
  int32_t status = usub_prepare(driver);
  if (status)
    return status;
  usub_state_keep(driver);
  status = usub_run_blocks(driver);
  if (status < 0)
    usub_state_restore(driver);
  else
    driver->accepted = driver->clock;
  return status;
}
