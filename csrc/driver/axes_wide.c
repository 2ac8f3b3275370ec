/* SPDX-License-Identifier: MIT */
/* Local axes of many contact points at once. */
#include "axes_wide.h"

#include <stddef.h>
#include <string.h>

#include "axes.h"

#define R double
#define I int64_t
#define SUFFIX(name) name##_d
#define SQRT sqrt
#include "axes_wide.inc"
#undef R
#undef I
#undef SUFFIX
#undef SQRT
#define R float
#define I int32_t
#define SUFFIX(name) name##_f
#define SQRT sqrtf
#include "axes_wide.inc"
