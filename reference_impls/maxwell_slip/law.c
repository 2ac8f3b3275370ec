/* SPDX-License-Identifier: MIT */
/* Generalised Maxwell slip: elements that stick as springs and, slipping, are attracted by a
 * Stribeck curve; props: mus, muk, vs, delta, attraction, viscosity, number of elements, their
 * stiffnesses, their shares of the strength. */
#define USUB_LAW "maxwell_slip"
#define USUB_LAW_PROPS maxwell_props(props, count)
#define USUB_LAW_VECTORS (int)props[6]
#define USUB_LAW_STATES (int)props[6]
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TIME
#include <usersub/abi.h>

/* Properties that the elements take; one more than there are, if the number makes no sense. */
static int maxwell_props(const usub_real *props, int count) {
  if (count < 9)
    return 9;
  return props[6] >= 1 && props[6] <= count ? 7 + 2 * (int)props[6] : count + 1;
}

#include <usersub/bristle_law.h>
#include <usersub/law_functions.h>

/* What all elements share; derivatives of the strength. */
typedef struct sliding {
  usub_real length, along[2], across[2], time, attraction, strength, by_length, by_pressure;
} sliding;

/* One that slips: traction along the motion at which slip begins, after the motion `stick`. */
typedef struct element {
  usub_real stiffness, share, along, across, begin, stick;
} element;

/* How much of the distance to the Stribeck curve is left after a time; its derivatives. */
static usub_real decay(const sliding *s, usub_real time, usub_real *by_time,
                       usub_real *by_strength) {
  const usub_real left = s->strength > 0 ? exp(-s->attraction * time / s->strength) : 0;
  *by_time = left > 0 ? -left * s->attraction / s->strength : 0;
  *by_strength = left > 0 ? left * s->attraction * time / s->strength / s->strength : 0;
  return left;
}

/* Derivative of the traction of an element that slips, by one variable: given are those of the
 * length of the motion, of its angle and of the strength. */
static void slip_derivative(const sliding *s, const element *e, usub_real d_length,
                            usub_real d_angle, usub_real d_strength, usub_real derivative[2]) {
  usub_real by_time, by_strength, d_begin = e->across * d_angle, d_stick = 0;
  const usub_real limit = e->share * s->strength, d_limit = e->share * d_strength;
  const usub_real d_across = -e->along * d_angle;
  if (e->stick > 0) {
    d_begin = e->begin > 0 ? (limit * d_limit - e->across * d_across) / e->begin : 0;
    d_stick = (d_begin - e->across * d_angle) / e->stiffness;
  }
  const usub_real left = decay(s, s->time * (1 - e->stick / s->length), &by_time, &by_strength);
  const usub_real d_time = s->time * (e->stick * d_length / s->length - d_stick) / s->length;
  const usub_real d_left = by_time * d_time + by_strength * d_strength;
  const usub_real along = limit + (e->begin - limit) * left, across = e->across * left;
  const usub_real d1 = d_limit + (d_begin - d_limit) * left + (e->begin - limit) * d_left;
  const usub_real d2 = d_across * left + e->across * d_left;
  for (int a = 0; a < 2; ++a)
    derivative[a] = (d1 - across * d_angle) * s->along[a] + (d2 + along * d_angle) * s->across[a];
}

/* An element under motion: returns whether it slips in the end. */
static int move(const sliding *s, element *e, int slips, const usub_real *motion,
                usub_real *vector) {
  const usub_real limit = e->share * s->strength;
  usub_real unused[2];
  e->along = vector[0] * s->along[0] + vector[1] * s->along[1];
  e->across = vector[0] * s->across[0] + vector[1] * s->across[1];
  e->begin = e->along;
  e->stick = 0;
  if (!(slips && e->along > 0)) {
    const usub_real reach = usub_abs(e->across) < limit
                                ? sqrt((limit - e->across) * (limit + e->across))
                                : (usub_real)0;
    if (e->along < reach) {
      e->begin = reach;
      e->stick = (reach - e->along) / e->stiffness;
    }
  }
  if (s->length < e->stick) {
    for (int a = 0; a < 2; ++a)
      vector[a] += e->stiffness * motion[a];
    return 0;
  }
  const usub_real left = decay(s, s->time * (1 - e->stick / s->length), &unused[0], &unused[1]);
  const usub_real along = limit + (e->begin - limit) * left, across = e->across * left;
  for (int a = 0; a < 2; ++a)
    vector[a] = along * s->along[a] + across * s->across[a];
  return 1;
}

/* An element above its limit, where nothing moves: it relaxes along its traction. */
static void rest(const sliding *s, const element *e, usub_real *vector, usub_real derivative[2]) {
  const usub_real limit = e->share * s->strength, size = hypot(vector[0], vector[1]);
  usub_real by_time, by_strength;
  derivative[0] = derivative[1] = 0;
  if (!(size > limit))
    return;
  const usub_real left = decay(s, s->time, &by_time, &by_strength);
  const usub_real by_pressure =
      s->by_pressure * (e->share * (1 - left) + (size - limit) * by_strength) / size;
  for (int a = 0; a < 2; ++a) {
    derivative[a] = by_pressure * vector[a];
    vector[a] *= (limit + (size - limit) * left) / size;
  }
}

USUB_BRISTLE_FUNCTION {
  const int n = (int)props[6];
  const usub_real per_time = time_increment > 0 ? 1 / time_increment : 0;
  const usub_real length = hypot(motion[0], motion[1]);
  const usub_real x = length > 0 ? motion[0] / length : 0, y = length > 0 ? motion[1] / length : 0;
  usub_real mu_by_rate;
  const usub_real mu =
      usub_stribeck(length * per_time, props[0], props[1], props[2], props[3], &mu_by_rate);
  const sliding s = {length,
                     {x, y},
                     {-y, x},
                     time_increment,
                     props[4],
                     mu * pressure,
                     pressure * mu_by_rate * per_time,
                     mu};
  for (int a = 0; a < 2; ++a) {
    traction[a] = props[5] * per_time * motion[a];
    if (tangent)
      tangent[a][a] = props[5] * per_time;
  }
  for (int i = 0; i < n; ++i) {
    element e = {props[7 + i], props[7 + n + i], 0, 0, 0, 0};
    usub_real by_length[2], by_angle[2], by_pressure[2] = {0, 0};
    const int moves = length > 0, slips = moves && move(&s, &e, state[i] > 0, motion, vectors[i]);
    if (!moves) {
      rest(&s, &e, vectors[i], by_pressure);
    } else if (slips && tangent) {
      slip_derivative(&s, &e, 1, 0, s.by_length, by_length);
      slip_derivative(&s, &e, 0, 1 / length, 0, by_angle);
      slip_derivative(&s, &e, 0, 0, s.by_pressure, by_pressure);
    }
    state[i] = slips;
    for (int a = 0; a < 2; ++a) {
      traction[a] += vectors[i][a];
      for (int b = 0; b < 2 && tangent; ++b)
        tangent[a][b] +=
            slips ? by_length[a] * s.along[b] + by_angle[a] * s.across[b] : e.stiffness * (a == b);
      if (tangent)
        tangent[a][2] += by_pressure[a];
    }
  }
}
