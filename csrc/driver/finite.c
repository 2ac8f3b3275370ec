/* SPDX-License-Identifier: MIT */
/* Looking for NaN and infinity in long arrays. */
#include <string.h>

#include "axes_wide.h"
#include "internal.h"

/* x - x is zero for finite x and NaN else; or-ing its bits needs no branch. Two chains, because one
 * would wait for itself. Vectors of the compiler, which keeps these in registers from array to
 * array; they have to be as wide as the processor's. */
#define OR_OF_DOUBLES(TARGET, NAME, BYTES)                                                         \
  TARGET static uint64_t NAME(const usub_span *spans, size_t count) {                              \
    typedef double reals __attribute__((vector_size(BYTES)));                                      \
    typedef uint64_t words __attribute__((vector_size(BYTES)));                                    \
    enum { LANES = (BYTES) / 8 };                                                                  \
    words one = {0}, two = {0};                                                                    \
    uint64_t rest = 0;                                                                             \
    for (size_t s = 0; s < count; ++s) {                                                           \
      const double *x = spans[s].data;                                                             \
      const size_t n = x ? spans[s].count : 0;                                                     \
      size_t i = 0;                                                                                \
      for (; i + 2 * LANES <= n; i += 2 * LANES) {                                                 \
        reals a, b;                                                                                \
        memcpy(&a, x + i, sizeof a);                                                               \
        memcpy(&b, x + i + LANES, sizeof b);                                                       \
        one |= (words)(a - a);                                                                     \
        two |= (words)(b - b);                                                                     \
      }                                                                                            \
      for (; i < n; ++i)                                                                           \
        rest |= x[i] - x[i] == 0 ? 0 : UINT64_MAX;                                                 \
    }                                                                                              \
    one |= two;                                                                                    \
    for (size_t j = 0; j < LANES; ++j)                                                             \
      rest |= one[j];                                                                              \
    return rest & 0x7ff0000000000000u;                                                             \
  }                                                                                                \
  static uint64_t NAME(const usub_span *spans, size_t count)

OR_OF_DOUBLES(, or_of_doubles, 16);
#if defined(__x86_64__) && defined(__GNUC__)
OR_OF_DOUBLES(__attribute__((target("avx2"))), or_of_wide, 32);
OR_OF_DOUBLES(__attribute__((target("avx512f"))), or_of_widest, 64);
#define SUPPORTS __builtin_cpu_supports
#else
#define or_of_wide or_of_doubles
#define or_of_widest or_of_doubles
#define SUPPORTS(instructions) 0
#endif

int usub_all_finite(const usub_span *spans, size_t count) {
  return !(SUPPORTS("avx512f") ? or_of_widest(spans, count)
           : SUPPORTS("avx2")  ? or_of_wide(spans, count)
                               : or_of_doubles(spans, count));
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
  if (n >= 16 && usub_all_finite(&(usub_span){x, n}, 1))
    return -1;
  for (size_t i = 0; i < n; ++i)
    if (!(x[i] - x[i] == 0))
      return (ptrdiff_t)i;
  return -1;
}
