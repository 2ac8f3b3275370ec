/* SPDX-License-Identifier: MIT */
/* What the probe answers: Coulomb friction, and marks in the state variables. */
#include <math.h>

#include "probe.h"

double usub_probe_mu(const usub_probe_call *call, int32_t props, int32_t count) {
  const double first = usub_probe_int(call, count, 0) > 0 ? usub_probe_real(call, props, 0) : 0;
  return first > 0 && first < 2 ? first : 0.3;
}

static uint64_t mixed(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

double usub_probe_mark(const usub_probe_call *call, int64_t point, int64_t index) {
  const uint64_t hash =
      mixed(mixed(mixed((uint64_t)call->sequence) + (uint64_t)point) + (uint64_t)index);
  return call->single ? 1 + (double)(hash >> 41) * 0x1p-23 : 1 + (double)(hash >> 12) * 0x1p-52;
}

/* Force of VFRIC and VFRICTION: against the slip, bounded by the stick force. */
static double force_of(const usub_probe_call *call, int32_t normal, int32_t stick, double mu,
                       int64_t k) {
  const double pressed = usub_probe_real(call, normal, k), most = usub_probe_real(call, stick, k);
  const double bound = pressed > 0 ? mu * pressed : 0;
  const double size = most < bound ? most : bound;
  return size > 0 && size - size == 0 ? -size : 0;
}

static void vfric(usub_probe_call *call) {
  const double mu = usub_probe_mu(call, USUB_VFRIC_PROPS, USUB_VFRIC_NPROPS);
  const int64_t count = usub_probe_int(call, USUB_VFRIC_NCONTACT, 0);
  const int64_t directions = usub_probe_int(call, USUB_VFRIC_NFRICDIR, 0);
  const int64_t states = usub_probe_int(call, USUB_VFRIC_NSTATEVAR, 0);
  for (int64_t k = 0; k < count; ++k) {
    for (int64_t d = 0; d < directions; ++d)
      usub_probe_set(call, USUB_VFRIC_FTANGENTIAL, k * directions + d,
                     d ? 0 : force_of(call, USUB_VFRIC_FNORMAL, USUB_VFRIC_FSTICKFORCE, mu, k));
    const int64_t node = usub_probe_int(call, USUB_VFRIC_JCONSECID, k);
    for (int64_t s = 0; s < states && node > 0; ++s)
      usub_probe_set(call, USUB_VFRIC_STATEV, (node - 1) * states + s,
                     usub_probe_mark(call, node, s));
  }
}

static void vfriction(usub_probe_call *call) {
  const double mu = usub_probe_mu(call, USUB_VFRICTION_PROPS, USUB_VFRICTION_NPROPS);
  const int64_t count = usub_probe_int(call, USUB_VFRICTION_NBLOCK, 0);
  const int64_t directions = usub_probe_int(call, USUB_VFRICTION_NFRICDIR, 0);
  const int64_t states = (int64_t)usub_probe_int(call, USUB_VFRICTION_NSTATES, 0) *
                         usub_probe_int(call, USUB_VFRICTION_NNODSTATE, 0);
  for (int64_t k = 0; k < count; ++k) {
    for (int64_t d = 0; d < directions; ++d)
      usub_probe_set(call, USUB_VFRICTION_FTANGENTIAL, k * directions + d,
                     d ? 0
                       : force_of(call, USUB_VFRICTION_FNORMAL, USUB_VFRICTION_FSTICKFORCE, mu, k));
    for (int64_t s = 0; s < states; ++s)
      usub_probe_set(call, USUB_VFRICTION_STATE, k * states + s, usub_probe_mark(call, k, s));
  }
}

/* FRIC_COEF and VFRIC_COEF: the first coefficient, and derivatives that are zero. */
static void coefficient(usub_probe_call *call) {
  const double mu = usub_probe_mu(call, USUB_VFRIC_COEF_PROPS, USUB_VFRIC_COEF_NPROPS);
  const int64_t count = usub_probe_int(call, USUB_VFRIC_COEF_NBLOCK, 0);
  const int modern = call->key == USUB_INTERFACE_FRIC_COEF_2022;
  for (int64_t k = 0; k < count; ++k) {
    usub_probe_set(call, USUB_VFRIC_COEF_FCOEF, k, mu);
    for (int64_t j = 0; j < (modern ? 8 : 3); ++j)
      usub_probe_set(call, USUB_VFRIC_COEF_FCOEFDERIV, j * count + k, 0);
  }
  const int64_t states = modern ? usub_probe_int(call, USUB_FRIC_COEF_2022_IDATA, 4) : 0;
  const int64_t node = modern ? usub_probe_int(call, USUB_FRIC_COEF_2022_IDATA, 3) : 0;
  for (int64_t s = 0; s < states; ++s)
    usub_probe_set(call, USUB_FRIC_COEF_2022_RDATA, 7 + s, usub_probe_mark(call, node, s));
}

void usub_probe_respond(usub_probe_call *call, const usub_probe_script *script) {
  switch (call->key) {
  case USUB_INTERFACE_FRIC:
    usub_probe_fric(call, script);
    break;
  case USUB_INTERFACE_VFRIC:
    vfric(call);
    break;
  case USUB_INTERFACE_VFRICTION:
    vfriction(call);
    break;
  default:
    coefficient(call);
  }
}
