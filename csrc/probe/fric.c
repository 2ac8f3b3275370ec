/* SPDX-License-Identifier: MIT */
/* The probe's FRIC: Coulomb friction with elastic slip, from the stress on entry.
 *
 *     trial = TAU + k DGAM,  k = mu p / g,  g = .005 CHRLNGTH
 *     |trial| <= mu p: tau = trial;  else tau = mu p trial / |trial| */
#include <math.h>

#include "probe.h"

enum { MOST = 2 };

/* Allowable elastic slip where the host gives no length. */
#define PLAIN_ELASTIC_SLIP 1e-6

typedef struct law {
  int32_t directions;
  double strength, stiffness, mu, elastic_slip;
  double trial[MOST], slip[MOST], size; /* slip: the increment of the host */
} law;

static int is_usable(double x) {
  return x - x == 0;
}

static law law_of(const usub_probe_call *call) {
  const double length = usub_probe_real(call, USUB_FRIC_CHRLNGTH, 0);
  const double pressure = usub_probe_real(call, USUB_FRIC_PRESS, 0);
  const int32_t directions = usub_probe_int(call, USUB_FRIC_NFDIR, 0);
  law made = {.directions = directions < 1      ? 0
                            : directions > MOST ? MOST
                                                : directions,
              .mu = usub_probe_mu(call, USUB_FRIC_PROPS, USUB_FRIC_NPROPS),
              .elastic_slip =
                  length > 0 && is_usable(length) ? 0.005 * length : PLAIN_ELASTIC_SLIP};
  made.strength = pressure > 0 && is_usable(pressure) ? made.mu * pressure : 0;
  made.stiffness = made.strength / made.elastic_slip;
  for (int32_t a = 0; a < made.directions; ++a) {
    const double stress = usub_probe_real(call, USUB_FRIC_TAU, a);
    const double slip = usub_probe_real(call, USUB_FRIC_DGAM, a);
    made.slip[a] = is_usable(slip) ? slip : 0;
    made.trial[a] = (is_usable(stress) ? stress : 0) + made.stiffness * made.slip[a];
  }
  made.size = hypot(made.trial[0], made.trial[1]);
  return made;
}

/* Stress, tangents and slip of a point that sticks elastically or slips. */
static void answer(usub_probe_call *call, const law *p) {
  const int slips = p->size > p->strength;
  const double scale = slips ? p->strength / p->size : 1;
  double energy = 0, work = 0;
  for (int32_t a = 0; a < p->directions; ++a) {
    const double n = p->size > 0 ? p->trial[a] / p->size : 0;
    const double tau = scale * p->trial[a];
    const double gone = slips && p->stiffness > 0 ? (p->size - p->strength) / p->stiffness * n : 0;
    double by_pressure = 0, across = 0;
    for (int32_t b = 0; b < p->directions; ++b) {
      const double m = p->size > 0 ? p->trial[b] / p->size : 0;
      const double part = (a == b) - (slips ? n * m : 0);
      usub_probe_set(call, USUB_FRIC_DDTDDG, b * p->directions + a, scale * p->stiffness * part);
      across += part * p->slip[b];
    }
    by_pressure = scale * p->mu / p->elastic_slip * across + (slips ? p->mu * n : 0);
    usub_probe_set(call, USUB_FRIC_TAU, a, tau);
    usub_probe_set(call, USUB_FRIC_DDTDDP, a, by_pressure);
    usub_probe_set(call, USUB_FRIC_DSLIP, a, gone);
    usub_probe_set(call, USUB_FRIC_DDTDDT, a, 0);
    usub_probe_set(call, USUB_FRIC_DDTDDT, p->directions + a, 0);
    energy += p->stiffness > 0 ? 0.5 * tau * tau / p->stiffness : 0;
    work += tau * gone;
  }
  usub_probe_set(call, USUB_FRIC_SED, 0, energy);
  usub_probe_set(call, USUB_FRIC_SFD, 0, work);
}

void usub_probe_fric(usub_probe_call *call, const usub_probe_script *script) {
  const law p = law_of(call);
  const int32_t states = usub_probe_int(call, USUB_FRIC_NSTATV, 0);
  const int32_t point = usub_probe_int(call, USUB_FRIC_NODE, 0);
  usub_probe_set(call, USUB_FRIC_LM, 0, script->lm);
  /* With LM = 1 or 2 no other variable needs updating. */
  if (script->lm == 0)
    answer(call, &p);
  for (int32_t s = 0; s < states; ++s)
    usub_probe_set(call, USUB_FRIC_STATEV, s, usub_probe_mark(call, point, s));
  if (script->cut_back)
    usub_probe_set(call, USUB_FRIC_PNEWDT, 0, 0.5);
}
