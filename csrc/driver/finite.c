/* SPDX-License-Identifier: MIT */
/* Looking for NaN and infinity in long arrays. */
#include <string.h>

#include "internal.h"

#if defined(__x86_64__) && defined(__GNUC__) && defined(__ELF__)
#define USUB_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define USUB_WIDE
#endif

/* x - x is zero for finite x and NaN else; or-ing its bits vectorises, a branch would not. Four
 * chains, because one would wait for itself. */
USUB_WIDE static uint64_t or_of_doubles(const double *x, size_t n) {
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
  if (n >= 16 && !or_of_doubles(x, n))
    return -1;
  for (size_t i = 0; i < n; ++i)
    if (!(x[i] - x[i] == 0))
      return (ptrdiff_t)i;
  return -1;
}
