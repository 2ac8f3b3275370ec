/* SPDX-License-Identifier: MIT */
/* The entries of the probe, and what happens in a call. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "probe.h"

static int64_t now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

/* Whether the first normal of a call has unit length in one precision. */
static int is_unit(const usub_probe_call *call, int32_t normal, int32_t directions, int single) {
  const size_t element = single ? sizeof(float) : sizeof(double);
  double square = 0;
  for (int32_t d = 0; d < directions; ++d) {
    unsigned char bytes[sizeof(double)];
    const char *at = (const char *)call->argv[normal] + (size_t)d * element;
    if (!call->argv[normal] || usub_probe_read(at, bytes, element) < element)
      return 0;
    float narrow;
    double wide;
    memcpy(&narrow, bytes, sizeof narrow);
    memcpy(&wide, bytes, sizeof wide);
    square += single ? (double)narrow * (double)narrow : wide * wide;
  }
  return fabs(square - 1) < 1e-3;
}

static int32_t count_at(const usub_probe_call *call, int32_t position) {
  int32_t number = 0;
  if (usub_probe_read(call->argv[position], &number, sizeof number) < sizeof number)
    return 0;
  return number;
}

/* Numbers that nobody would pass: reals read in the other precision mostly are. */
static int is_odd(double x) {
  return x != 0 && !(fabs(x) > 1e-15 && fabs(x) < 1e15);
}

static int32_t count_odd(const void *array, int32_t count, int single) {
  const size_t size = single ? sizeof(float) : sizeof(double);
  int32_t odd = 0;
  for (int32_t i = 0; i < count; ++i) {
    float narrow;
    double wide;
    const char *at = (const char *)array + (size_t)i * size;
    if (!array || usub_probe_read(at, single ? (void *)&narrow : (void *)&wide, size) < size)
      return odd + 1;
    odd += is_odd(single ? (double)narrow : wide);
  }
  return odd;
}

/* VFRIC_COEF has no normals: the precision in which fewer numbers are odd. */
static int is_narrow_by_size(const usub_probe_call *call, int *known) {
  const int32_t points = count_at(call, USUB_VFRIC_COEF_NBLOCK);
  const int32_t props = count_at(call, USUB_VFRIC_COEF_NPROPS);
  const struct {
    int32_t position, count;
  } arrays[] = {{USUB_VFRIC_COEF_RDATA, 3},
                {USUB_VFRIC_COEF_PROPS, props},
                {USUB_VFRIC_COEF_SLIPRATE, points},
                {USUB_VFRIC_COEF_PRESSURE, points},
                {USUB_VFRIC_COEF_TEMPAVG, points}};
  int32_t odd[2] = {0, 0};
  for (int single = 0; single < 2; ++single)
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) {
      const int32_t most = arrays[i].count < 16 ? arrays[i].count : 16;
      odd[single] += count_odd(call->argv[arrays[i].position], most, single);
    }
  *known = odd[0] != odd[1];
  return odd[1] < odd[0];
}

static int is_narrow_by_normal(const usub_probe_call *call, int *known) {
  const int is_vfric = call->key == USUB_INTERFACE_VFRIC;
  const int32_t normal = is_vfric ? USUB_VFRIC_DIRCOSN : USUB_VFRICTION_DIRCOSN;
  const int32_t directions = count_at(call, is_vfric ? USUB_VFRIC_NDIR : USUB_VFRICTION_NDIR);
  if (directions != 2 && directions != 3)
    return 0;
  const int wide = is_unit(call, normal, directions, 0);
  const int narrow = is_unit(call, normal, directions, 1);
  *known = wide != narrow;
  return *known && narrow;
}

/* Nothing in the argument list tells the precision; the length of a normal does, or numbers that
 * make sense in one precision only. What was seen once holds for the process. */
static void find_precision(usub_probe_call *call) {
  static _Atomic int seen[USUB_INTERFACE_COUNT]; /* 1 double, 2 single */
  const char *told = getenv("USERSUB_PROBE_PRECISION");
  if (call->face->standard || (told && strcmp(told, "auto") != 0)) {
    call->single = !call->face->standard && told && strcmp(told, "single") == 0;
    return;
  }
  if (!seen[call->key]) {
    int known = 0;
    const int narrow = call->key == USUB_INTERFACE_VFRIC_COEF ? is_narrow_by_size(call, &known)
                                                              : is_narrow_by_normal(call, &known);
    if (known)
      seen[call->key] = 1 + narrow;
  }
  call->single = seen[call->key] == 2;
  call->precision_basis = seen[call->key] ? USUB_PROBE_SEEN : USUB_PROBE_ASSUMED;
}

/* A rotation by accident is not to be expected behind the three times of the older form. */
static int looks_modern(const usub_probe_call *call) {
  int32_t flags[6];
  double numbers[7];
  const void *idata = call->argv[USUB_FRIC_COEF_2022_IDATA];
  const void *rdata = call->argv[USUB_FRIC_COEF_2022_RDATA];
  if (usub_probe_read(idata, flags, sizeof flags) < sizeof flags ||
      usub_probe_read(rdata, numbers, sizeof numbers) < sizeof numbers)
    return 0;
  const double *r = numbers + 3;
  const double off = fabs(r[0] * r[0] + r[1] * r[1] - 1) + fabs(r[2] * r[2] + r[3] * r[3] - 1) +
                     fabs(r[0] * r[2] + r[1] * r[3]);
  return flags[4] >= 0 && flags[4] < 100000 && (flags[5] == 1 || flags[5] == 2) && off < 1e-6;
}

static void find_generation(usub_probe_call *call) {
  if (call->key != USUB_INTERFACE_FRIC_COEF)
    return;
  const char *told = getenv("USERSUB_PROBE_GENERATION");
  int modern = told && strcmp(told, "2022") == 0;
  if (!told || strcmp(told, "auto") == 0) {
    modern = looks_modern(call);
    call->generation_basis = modern ? USUB_PROBE_SEEN : USUB_PROBE_ASSUMED;
  }
  if (modern) {
    call->key = USUB_INTERFACE_FRIC_COEF_2022;
    call->face = usub_probe_interface_of(call->key);
  }
}

void usub_probe_enter(int32_t key, void *const *argv, const size_t *lengths) {
  usub_probe_call call;
  memset(&call, 0, sizeof call);
  call.key = key;
  call.argv = argv;
  call.begin = now();
  call.face = usub_probe_interface_of(key);
  call.sequence = usub_probe_next_call();
  for (int i = 0; i < 3; ++i)
    call.lengths[i] = lengths[i];
  find_precision(&call);
  find_generation(&call);
  usub_probe_look(&call);
  const int chosen = usub_probe_is_recording() && usub_probe_is_chosen(&call);
  const usub_probe_script script = usub_probe_script_of(&call);
  usub_probe_respond(&call, &script);
  usub_probe_hand_over(&call);
  call.end = now();
  usub_probe_record(&call, chosen);
  usub_probe_forget(&call);
}

#define USUB_PROBE_EXPORT __attribute__((visibility("default")))
#include "entries.inc"
