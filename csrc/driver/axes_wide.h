/* SPDX-License-Identifier: MIT */
/** @file axes_wide.h
 * Local axes of many contact points at once, where nothing unusual is among them.
 *
 * The arithmetic is that of axes.h, operation by operation, so that the bits are the same. Points
 * that need scaling or the rule for a slip of zero are left to it, and so are points that will be
 * refused.
 */
#ifndef USERSUB_AXES_WIDE_H
#define USERSUB_AXES_WIDE_H

#include <stdint.h>

/** For the squared length of normals: far above rounding in both precisions, far below a mistake.
 */
#define USUB_UNIT_TOLERANCE 1e-3
/** Points that are looked at together. */
#define USUB_WIDE_POINTS 8

#if defined(__x86_64__) && defined(__GNUC__) && defined(__ELF__)
#define USUB_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define USUB_WIDE
#endif

/** Writes t1 and the length of the tangential slip of the first points, a multiple of
 * USUB_WIDE_POINTS, and returns how many: it ends before a group in which not all are usual.
 * @param force  normal forces, not negative and finite in a usual point
 * @param stick  stick forces, not negative in a usual point */
int32_t usub_wide_axes3_d(const double *slip, const double *normal, const double *force,
                          const double *stick, double *t1, double *length, int32_t count);
int32_t usub_wide_axes3_f(const float *slip, const float *normal, const float *force,
                          const float *stick, float *t1, float *length, int32_t count);
/** The same in two dimensions. */
int32_t usub_wide_axes2_d(const double *slip, const double *normal, const double *force,
                          const double *stick, double *t1, double *length, int32_t count);
int32_t usub_wide_axes2_f(const float *slip, const float *normal, const float *force,
                          const float *stick, float *t1, float *length, int32_t count);

#endif
