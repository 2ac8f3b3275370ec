/* SPDX-License-Identifier: MIT */
/** @file law/anisotropic.h
 * FRIC of an anisotropic coefficient (part of `coefficient_law.h`): penalty enforcement with an
 * elastic slip on scaled quantities.
 *
 * Let g = elastic slip at the start + motion, m = (mu1 + mu2)/2, a_i = mu_i/m (both one if both
 * coefficients are zero, or with one direction, where mu1 alone counts), g~_i = a_i g_i, c =
 * allowable elastic slip, .005 of CHRLNGTH, T = m * pressure:
 *
 *   stick, |g~| <= c:  tau_i = (T/c) a_i^2 g_i          slip 0
 *   slip,  |g~| >  c:  tau_i = T a_i g~_i / |g~|        slip (1 - c/|g~|) g
 *
 * so that tau lies on the ellipse with the semi-axes mu_i * pressure and the slip along its normal.
 * The coefficients belong to the slip of the end of the increment and decide on it themselves: one
 * equation for the excess |g~| - c, bracketed from the start, solved by false position with
 * bisection. The derivatives are those of the solution. A direction whose coefficient is zero while
 * the other's is not is frictionless: all its motion is slip. State variables as in
 * `law/penalty.h`.
 */
#ifndef USERSUB_LAW_ANISOTROPIC_H
#define USERSUB_LAW_ANISOTROPIC_H

#include <float.h>

#include "point.h"

#include "begin.h"

/* More than bisection of exponent and fraction can take, three steps each. */
#define USUB_MOST_TRIALS 240

/* One point on its way to a solution. */
typedef struct usub_ellipse {
  /* Given: directions, elastic predictor, allowable elastic slip; inputs and state of the law. */
  int n, count, states;
  double g[2], allowable, pressure, time_increment, temperature;
  const double *fields, *props, *start;
  double *state;
  int frictionless[2];
  /* Of the last trial: excess over the allowable slip, plastic slip and its length, coefficients
   * with derivatives, a_i, the mean coefficient, |g~|. */
  double excess, plastic[2], length, mu[2], derivative[2][4], a[2], mean, size;
} usub_ellipse;

/* Asks for the coefficients at an excess and finds the |g~| that they make. */
static inline void usub_try(usub_ellipse *e, double excess) {
  e->excess = excess;
  for (int i = 0; i < 2; ++i)
    e->plastic[i] = e->frictionless[i] ? e->g[i] : excess / (e->allowable + excess) * e->g[i];
  e->length = hypot(e->plastic[0], e->plastic[1]);
  for (int i = 0; i < e->states; ++i)
    e->state[i] = e->start[i];
  for (int i = 0; i < 8; ++i)
    e->derivative[i / 4][i % 4] = 0;
  usub_ask(USUB_RATE(usub_ratio(e->length, e->time_increment)), USUB_PRESSURE(e->pressure),
           e->temperature, e->fields, USUB_SLIP(e->length), USUB_TIME(e->time_increment),
           USUB_STATE(e->state), e->props, e->count, e->mu, e->derivative);
  e->mean = e->n > 1 ? 0.5 * e->mu[0] + 0.5 * e->mu[1] : e->mu[0];
  for (int i = 0; i < 2; ++i)
    e->a[i] = e->n > 1 && e->mean > 0 ? e->mu[i] / e->mean : 1;
  e->size = hypot(e->a[0] * e->g[0], e->a[1] * e->g[1]);
}

/* Finds the excess x = max(0, |g~(x)| - c). As a_1 + a_2 = 2, |g~| is at most twice the larger
 * |g_i|, which brackets it; sticking is preferred where both are solutions. */
static inline void usub_solve_excess(usub_ellipse *e) {
  const double c = e->allowable;
  double low = 0, high = fmax(2 * fmax(fabs(e->g[0]), fabs(e->g[1])) - c, 0), x = 0;
  double f_low = 0, f_high = 0;
  int side = 0;
  for (int trial = 0; trial < USUB_MOST_TRIALS; ++trial) {
    usub_try(e, x);
    const double f = fmax(e->size - c, 0) - x, rounding = 4 * DBL_EPSILON * (c + x);
    if (!(fabs(f) > rounding)) /* an elastic slip that was left at its limit is rounded */
      return;
    if (f > 0) {
      f_high *= side > 0 ? 0.5 : 1;
      low = x;
      f_low = f;
      side = 1;
    } else {
      f_low *= side < 0 ? 0.5 : 1;
      high = x;
      f_high = f;
      side = -1;
    }
    if (!(high - low > rounding))
      return;
    if (f_high == 0) /* the other end is not known yet */
      x = trial < 8 ? fmin(low + (1 << trial) * f_low, high) : high;
    else
      x = low + (high - low) * (f_low / (f_low - f_high));
    if (f_high != 0 && (trial % 3 == 2 || !(x > low && x < high)))
      x = c + high > 4 * (c + low) ? sqrt(c + low) * sqrt(c + high) - c : 0.5 * (low + high);
  }
}

/* Slip and coefficients of the end of the increment. */
static inline void usub_solve(usub_ellipse *e) {
  usub_solve_excess(e);
  const int i = e->mu[0] == 0 ? 0 : 1;
  if (e->n < 2 || e->mu[i] != 0 || e->mu[1 - i] == 0 || e->g[i] == 0)
    return;
  e->frictionless[i] = 1;
  usub_solve_excess(e);
  if (e->mu[i] == 0 && e->mu[1 - i] != 0)
    return;
  e->frictionless[i] = 0; /* zero only while this direction does not slide: then it does not */
  usub_solve_excess(e);
}

/* Length by which the scaled predictor is divided; a rounding above its limit it still sticks. */
static inline double usub_reach(const usub_ellipse *e) {
  const double c = e->allowable;
  return e->excess > 0 ? e->size : fmin(fmax(e->size, c), c * (1 + 4 * DBL_EPSILON));
}

/* Change of a_1, and of -a_2, when the coefficients change by d1 and d2. */
static inline double usub_ratio_change(const usub_ellipse *e, double d1, double d2) {
  return e->n > 1 && e->mean > 0 ? 0.5 * (e->a[1] * d1 - e->a[0] * d2) / e->mean : 0;
}

/* Change of the stress when the predictor changes by `dg`, the coefficients at the same slip by
 * `partial` and the pressure by `dp`. The excess depends on the coefficients, which depend on the
 * excess: one linear equation. */
static inline void usub_change(const usub_ellipse *e, const double dg[2], const double partial[2],
                               double dp, double change[2]) {
  const int slips = e->excess > 0;
  const double whole = e->allowable + e->excess, reach = usub_reach(e);
  const double n[2] = {e->a[0] * e->g[0] / reach, e->a[1] * e->g[1] / reach};
  double by_slip[2], d_mu[2], d_length = 0, length_by_excess = 0;
  for (int i = 0; i < 2; ++i) {
    const double unit = usub_ratio(e->plastic[i], e->length);
    by_slip[i] =
        USUB_RATE(usub_ratio(e->derivative[i][0], e->time_increment)) + e->derivative[i][3];
    d_length += unit * dg[i] * (e->frictionless[i] ? 1 : e->excess / whole);
    length_by_excess += e->frictionless[i] ? 0 : unit * e->g[i] / whole * (e->allowable / whole);
  }
  for (int i = 0; i < 2; ++i)
    d_mu[i] =
        partial[i] + (d_length != 0 ? by_slip[i] * d_length : 0); /* may be infinite at rest */
  const double by_a = n[0] * e->g[0] - n[1] * e->g[1];
  if (slips) {
    const double divisor =
        1 - by_a * usub_ratio_change(e, by_slip[0], by_slip[1]) * length_by_excess;
    double d_excess = n[0] * e->a[0] * dg[0] + n[1] * e->a[1] * dg[1] +
                      by_a * usub_ratio_change(e, d_mu[0], d_mu[1]);
    d_excess /= divisor > 0 ? divisor : 1;
    for (int i = 0; i < 2; ++i)
      d_mu[i] += by_slip[i] * length_by_excess * d_excess;
  }
  const double da[2] = {usub_ratio_change(e, d_mu[0], d_mu[1]),
                        -usub_ratio_change(e, d_mu[0], d_mu[1])};
  const double d_mean = e->n > 1 ? 0.5 * d_mu[0] + 0.5 * d_mu[1] : d_mu[0];
  double d_scaled[2];
  for (int i = 0; i < 2; ++i)
    d_scaled[i] = (da[i] * e->g[i] + e->a[i] * dg[i]) / reach;
  /* In slip only the part across n turns it; written as that part, nothing cancels. */
  const double across = n[0] * d_scaled[1] - n[1] * d_scaled[0];
  const double turns[2] = {slips ? -n[1] * across : d_scaled[0],
                           slips ? n[0] * across : d_scaled[1]};
  for (int i = 0; i < 2; ++i)
    change[i] = (d_mean * e->pressure + e->mean * dp) * e->a[i] * n[i] +
                e->mean * e->pressure * (da[i] * n[i] + e->a[i] * turns[i]);
}

/* Changes by motion 1, motion 2, pressure (where `above` zero) and temperature. */
static inline void usub_all_changes(const usub_ellipse *e, int above, double change[4][2]) {
  static const double along[4][2] = {{1, 0}, {0, 1}, {0, 0}, {0, 0}};
  for (int x = 0; x < 4; ++x) {
    double partial[2] = {0, 0};
    for (int i = 0; i < 2 && x > 1; ++i)
      partial[i] = x == 2 && !above ? 0 : e->derivative[i][x - 1];
    usub_change(e, along[x], partial, x == 2 && above, change[x]);
  }
}

void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  USUB_FIELDS_ROOM;
  double start[USUB_STATES_ROOM];
  if (*LM == 2) {
    usub_clear(STATEV, *NSTATV);
    return;
  }
  if (!USUB_STANDARD_PROPS("FRIC", PROPS, *NPROPS) ||
      !USUB_ELASTIC_NEEDS(n, PROPS, *NPROPS, *NSTATV, 0.005 * *CHRLNGTH))
    return;
  *LM = 0;
  usub_ellipse e;
  e.n = n;
  e.frictionless[0] = e.frictionless[1] = 0;
  e.count = *NPROPS;
  e.props = PROPS;
  e.allowable = 0.005 * *CHRLNGTH;
  e.pressure = *PRESS > 0 ? *PRESS : 0;
  e.time_increment = USUB_TIME_OR_RATE(*DTIME);
  e.temperature = USUB_TEMPERATURE(0.5 * (TEMP[0] + TEMP[1]));
  e.fields = USUB_FIELDS(usub_mean_fields(usub_fields_room, *NPRED, PREDEF, 2, PREDEF + 1, 2));
  e.states = usub_scalars(PROPS, *NPROPS);
  e.start = start;
  e.state = USUB_STATE(STATEV + n);
  for (int i = 0; i < e.states; ++i)
    start[i] = e.state[i];
  usub_rotate(n, DROT, STATEV, e.g);
  for (int a = 0; a < n; ++a)
    e.g[a] += DGAM[a];
  usub_solve(&e);
  if (!USUB_STANDARD_NEEDS(e.mu[0] >= 0 && (n < 2 || e.mu[1] >= 0), USUB_NEGATIVE_TEXT, 0, 0))
    return;

  double change[4][2];
  usub_all_changes(&e, *PRESS >= 0, change);
  const double reach = usub_reach(&e);
  *SED = *SFD = 0;
  for (int a = 0; a < n; ++a) {
    TAU[a] = e.mean * e.pressure * e.a[a] * (e.a[a] * e.g[a] / reach);
    DSLIP[a] = e.plastic[a];
    STATEV[a] = e.frictionless[a] ? 0 : e.allowable / (e.allowable + e.excess) * e.g[a];
    DDTDDP[a] = change[2][a];
    DDTDDT[a] = DDTDDT[a + n] = 0.5 * change[3][a];
    for (int b = 0; b < n; ++b)
      DDTDDG[a + n * b] = change[b][a];
    *SED += 0.5 * TAU[a] * STATEV[a];
    *SFD += TAU[a] * DSLIP[a];
  }
}

#include "end.h"

#endif
