/* SPDX-License-Identifier: MIT */
/** @file lagrange.h
 * Friction coefficient at one contact point, with sticking enforced by the host's Lagrange
 * multipliers: no elastic slip. Symbols as in penalty.h; the increment starts without elastic
 * slip, so g is the slip increment; l~_i = l_i / a_i is the scaled form of a stress l.
 *
 * A point that sticks is given its constraint stress l:
 *   |l~| <= T (at no slip):  it sticks on, and l is its stress;
 *   otherwise it is released, and its stress is l scaled back to strength, l T / |l~|.
 * A point that slips is given the stress l of its last iteration:
 *   g . l >= 0:  tau_i = T a_i g~_i / |g~|, all of g is plastic slip (no slip at all: l T / |l~|);
 *   g . l <  0:  the slip opposes the friction stress: the point sticks.
 * Where there is no strength (T = 0) nothing sticks and the stress is zero. A constraint holds both
 * directions or none: a point with one frictionless direction is released as soon as its constraint
 * stress has a part there (more than 1e-9 T), also where the other direction could hold.
 */
#ifndef USUB_LAGRANGE_H
#define USUB_LAGRANGE_H

#include "penalty.h"

/** As usub_penalty_update; of the input, elastic_slip has to be zero, stick_slope is not read, and
 * critical_elastic_slip is a reference for derivatives only (0: none).
 * @param stuck   whether the host constrained the point in this iteration
 * @param stress  constraint stress if it did, else the stress of the last iteration
 * @param output  `sticks` tells whether the host has to constrain the point from now on; then tau
 *                is `stress`, and slip, energies and derivatives are zero. Where a point has no
 * slip yet, derivatives are those of a slip that has just begun where the stress drives it: by
 * pressure and temperature with the direction of the stress kept, by the motion with the
 * coefficients of no slip and, across the slip, with the stiffness of a slip of the reference size.
 * Without one that part is zero, and the first slip may go astray where two coefficients differ.
 */
int32_t usub_lagrange_update(const usub_penalty_input *input, int32_t stuck, const double *stress,
                             usub_friction_fn friction, void *context, int32_t want_tangent,
                             usub_penalty_output *output);

#endif
