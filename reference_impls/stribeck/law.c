/* SPDX-License-Identifier: MIT */
/* Stribeck curve; props: static and kinetic coefficient, Stribeck rate, exponent, viscous part. */
#define USUB_LAW "stribeck"
#define USUB_LAW_PROPS 5
#define USUB_LAW_READS_RATE
#include <usersub/coefficient_law.h>
#include <usersub/law_functions.h>

USUB_LAW_FUNCTION {
  const usub_real kinetic = props[1], fall = props[0] - kinetic, viscous = props[4];
  usub_real slope;
  const usub_real decay = usub_decay_of_power(rate, 0, props[2], props[3], &slope);
  if (derivative)
    derivative[0] = fall * slope + viscous;
  return kinetic + fall * decay + viscous * rate;
}
