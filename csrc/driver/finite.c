/* SPDX-License-Identifier: MIT */
/* Looking for NaN and infinity in long arrays. */
#include <string.h>

#include "axes_wide.h"
#include "internal.h"

/* x - x is zero for finite x and NaN else; or-ing its bits vectorises, a branch would not. Four
 * chains, because one would wait for itself. */
static inline __attribute__((always_inline)) uint64_t or_of(const double *x, size_t n) {
  uint64_t bits[16] = {0};
  size_t i = 0;
  for (; i + 16 <= n; i += 16)
    for (size_t j = 0; j < 16; ++j) {
      const double zero = x[i + j] - x[i + j];
      uint64_t u;
      memcpy(&u, &zero, sizeof u);
      bits[j] |= u;
    }
  for (; i < n; ++i)
    bits[0] |= x[i] - x[i] == 0 ? 0 : UINT64_MAX;
  for (size_t j = 1; j < 16; ++j)
    bits[0] |= bits[j];
  return bits[0] & 0x7ff0000000000000u;
}

USUB_WIDE static uint64_t or_of_doubles(const double *x, size_t n) {
  return or_of(x, n);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
/* Nearly half the time; gcc takes half vectors for a clone with these instructions. */
__attribute__((target("avx512f,prefer-vector-width=512"))) static uint64_t
or_of_wide(const double *x, size_t n) {
  return or_of(x, n);
}
#define HAS_WIDEST __builtin_cpu_supports("avx512f")
#else
#define or_of_wide or_of_doubles
#define HAS_WIDEST 0
#endif

USUB_WIDE static uint32_t or_of_floats(const float *x, size_t n) {
  uint32_t bits[32] = {0};
  size_t i = 0;
  for (; i + 32 <= n; i += 32)
    for (size_t j = 0; j < 32; ++j) {
      const float zero = x[i + j] - x[i + j];
      uint32_t u;
      memcpy(&u, &zero, sizeof u);
      bits[j] |= u;
    }
  for (; i < n; ++i)
    bits[0] |= x[i] - x[i] == 0 ? 0 : UINT32_MAX;
  for (size_t j = 1; j < 32; ++j)
    bits[0] |= bits[j];
  return bits[0] & 0x7f800000u;
}

ptrdiff_t usub_first_bad(const void *data, size_t n, int32_t single) {
  if (single) {
    const float *x = data;
    if (n >= 32 && !or_of_floats(x, n))
      return -1;
    for (size_t i = 0; i < n; ++i)
      if (!(x[i] - x[i] == 0))
        return (ptrdiff_t)i;
    return -1;
  }
  const double *x = data;
  if (n >= 16 && !(HAS_WIDEST ? or_of_wide(x, n) : or_of_doubles(x, n)))
    return -1;
  for (size_t i = 0; i < n; ++i)
    if (!(x[i] - x[i] == 0))
      return (ptrdiff_t)i;
  return -1;
}
