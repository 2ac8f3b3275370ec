/* SPDX-License-Identifier: MIT */
/** @file strength_law.h
 * The shear stress up to which a point sticks and at which it slips, behind FRIC, VFRIC and
 * VFRICTION; see `laws.h` for the form of a law's file.
 *
 * It is for strengths that no coefficient can carry, since they do not vanish with the pressure
 * (cohesion, a constant shear strength); a strength that a multiple of the pressure bounds is a
 * coefficient, strength over pressure. Behind FRIC the law does its own enforcement, see
 * `law/penalty.h`.
 */
#ifndef USERSUB_STRENGTH_LAW_H
#define USERSUB_STRENGTH_LAW_H

#define USUB_LAW_GIVES_STRESS
#include "law/point.h"

#ifndef USUB_DUAL_PASS
#include "law/explicit.h"
#ifndef USUB_SINGLE
#include "law/penalty.h"
#endif
#endif

#endif
