/* SPDX-License-Identifier: MIT */
/* Coefficient from a table over slip rate, pressure and temperature: linear inside, constant
 * outside. props: numbers of rates, pressures, temperatures; these points, ascending; the
 * coefficients, the rate running fastest. */
#define USUB_LAW "coulomb_tabulated"
#define USUB_LAW_PROPS table_props(props, count)
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TEMPERATURE
#include <usersub/abi.h>

/* Properties that the table takes: the least table's, if the sizes make no sense. */
static int table_props(const usub_real *props, int count) {
  double points = 3, values = 1;
  for (int i = 0; i < 3; ++i) {
    if (count < 7 || !(props[i] >= 1 && props[i] <= count))
      return count < 7 ? 7 : count + 1;
    points += (int)props[i];
    values *= (int)props[i];
  }
  return points + values <= count ? (int)(points + values) : count + 1;
}

#include <usersub/coefficient_law.h>

/* Where x lies among ascending points: interval, share of its upper end, 1/width or 0 outside. */
typedef struct place {
  int low, high;
  usub_real share, slope;
} place;

static place find(const usub_real *points, int count, usub_real x) {
  place at = {0, 0, 0, 0};
  if (count < 2 || x < points[0])
    return at;
  at.low = at.high = count - 1;
  if (x >= points[count - 1])
    return at;
  at.low = 0;
  while (at.high - at.low > 1) {
    const int middle = (at.low + at.high) / 2;
    if (x < points[middle])
      at.high = middle;
    else
      at.low = middle;
  }
  at.slope = 1 / (points[at.high] - points[at.low]);
  at.share = (x - points[at.low]) / (points[at.high] - points[at.low]);
  return at;
}

static usub_real between(usub_real low, usub_real high, usub_real share) {
  return low + (high - low) * share;
}

USUB_LAW_FUNCTION {
  const int rates = (int)props[0], pressures = (int)props[1], temperatures = (int)props[2];
  const usub_real *table = props + 3 + rates + pressures + temperatures;
  const place r = find(props + 3, rates, rate);
  const place p = find(props + 3 + rates, pressures, pressure);
  const place t = find(props + 3 + rates + pressures, temperatures, temperature);
  const int p_ends[2] = {p.low, p.high}, t_ends[2] = {t.low, t.high};
  usub_real value[2][2], by_rate[2][2];
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const usub_real *row = table + (ptrdiff_t)rates * (p_ends[i] + pressures * t_ends[j]);
      value[j][i] = between(row[r.low], row[r.high], r.share);
      by_rate[j][i] = (row[r.high] - row[r.low]) * r.slope;
    }
  }
  const usub_real cold = between(value[0][0], value[0][1], p.share);
  const usub_real warm = between(value[1][0], value[1][1], p.share);
  if (derivative) {
    derivative[0] = between(between(by_rate[0][0], by_rate[0][1], p.share),
                            between(by_rate[1][0], by_rate[1][1], p.share), t.share);
    derivative[1] = between((value[0][1] - value[0][0]) * p.slope,
                            (value[1][1] - value[1][0]) * p.slope, t.share);
    derivative[2] = (warm - cold) * t.slope;
  }
  return between(cold, warm, t.share);
}
