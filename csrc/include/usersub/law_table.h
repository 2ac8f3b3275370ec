/* SPDX-License-Identifier: MIT */
/** @file law_table.h
 * Coefficients from tables over slip rate, pressure, temperature and any number of field variables:
 * linear between the points of each variable, constant outside them. Calculated in pairs, since a
 * coefficient may be small next to those that it lies between.
 *
 * props: numbers of slip rates, pressures, temperatures, field variables; number of points of each
 * field variable; the points of each variable, ascending; one table after the other, in which the
 * slip rate runs fastest, then the pressure, the temperature, the field variables.
 * Include it before the header of the kind of law: USUB_LAW_PROPS is usub_table_props().
 */
#ifndef USERSUB_LAW_TABLE_H
#define USERSUB_LAW_TABLE_H

#include "abi.h"
#include "law/pair.h"

/* Room for field variables, as in laws.h. */
#ifndef USUB_LAW_MOST
#define USUB_LAW_MOST 256
#endif

/* Numbers before the points: four, and one a field variable. */
static inline int usub_table_head(const usub_real *props) {
  return 4 + (int)props[3];
}

/* Number of points of a variable; the first three are slip rate, pressure, temperature. */
static inline int usub_table_points(const usub_real *props, int variable) {
  return (int)props[variable < 3 ? variable : variable + 1];
}

/* Properties that `tables` tables take; those of the least one, or one more than there are, if
 * the numbers of points make no sense. */
static inline int usub_table_props(const usub_real *props, int count, int tables) {
  const int least = 4 + 3 + tables;
  double points = 0, values = tables;
  if (count < least)
    return least;
  if (!(props[3] >= 0 && props[3] <= USUB_LAW_MOST && usub_table_head(props) < count))
    return count + 1;
  for (int i = 0; i < usub_table_head(props) - 1; ++i) {
    const usub_real size = props[i < 3 ? i : i + 1];
    if (!(size >= 1 && size <= (usub_real)count))
      return count + 1;
    points += (int)size;
    values *= (int)size;
  }
  const double needed = usub_table_head(props) + points + values;
  return needed <= count ? (int)needed : count + 1;
}

/* Where a number lies among ascending points: the interval; the share of its upper end and that of
 * its lower one; its width. Outside, low is the point that counts and high is 0. */
typedef struct usub_table_place {
  int low, high;
  usub_pair share;
  double rest, width;
} usub_table_place;

static inline usub_table_place usub_table_find(const usub_real *points, int n, double x) {
  usub_table_place at = {0, 0, {0, 0}, 1, 1};
  if (n < 2 || x < points[0])
    return at;
  if (x >= points[n - 1]) {
    at.low = n - 1;
    return at;
  }
  at.high = n - 1;
  while (at.high - at.low > 1) {
    const int middle = (at.low + at.high) / 2;
    if (x < points[middle])
      at.high = middle;
    else
      at.low = middle;
  }
  const double start = points[at.low], end = points[at.high];
  const usub_pair width = usub_sum(end, -start);
  at.share = usub_pair_over(usub_sum(x, -start), width);
  at.rest = (end - x) / width.high;
  at.width = width.high;
  return at;
}

/* What is fixed while a table is read. */
typedef struct usub_table {
  const usub_real *props, *fields;
  usub_table_place main[3]; /* slip rate, pressure, temperature */
} usub_table;

/* first + (second - first) share. */
static inline usub_pair usub_table_between(usub_pair first, usub_pair second, usub_pair share) {
  const usub_pair rise = usub_sum(second.high, -first.high);
  const usub_pair part = usub_product(rise.high, share.high);
  const usub_pair sum = usub_sum(first.high, part.high);
  const double lost = rise.low + (second.low - first.low);
  const usub_pair value = {
      sum.high, sum.low + (first.low + part.low + rise.high * share.low + lost * share.high)};
  return value;
}

/* Interpolates over `variable` and all before it: `end` is where the points of the variable end,
 * `values` where the part of the table begins that is left, of `size` numbers. Unless it is NULL,
 * `derivative` receives derivatives by the first three variables. */
static inline usub_pair usub_table_over(const usub_table *table, int variable, const usub_real *end,
                                        const usub_real *values, ptrdiff_t size,
                                        double *derivative) {
  const int n = usub_table_points(table->props, variable);
  const usub_real *points = end - n;
  const usub_table_place at = variable < 3
                                  ? table->main[variable]
                                  : usub_table_find(points, n, table->fields[variable - 3]);
  usub_pair first = {values[at.low], 0}, second = {values[at.high], 0};
  double other[3] = {0, 0, 0};
  if (variable > 0) {
    const ptrdiff_t part = size / n;
    first = usub_table_over(table, variable - 1, points, values + part * at.low, part, derivative);
    if (at.high)
      second = usub_table_over(table, variable - 1, points, values + part * at.high, part,
                               derivative ? other : NULL);
  }
  if (!at.high)
    return first;
  for (int i = 0; derivative && i < 3; ++i)
    derivative[i] = derivative[i] * at.rest + other[i] * at.share.high;
  if (derivative && variable < 3)
    derivative[variable] = (second.high - first.high) / at.width;
  return usub_table_between(first, second, at.share);
}

/* Value of table number `number`, from 0; `derivative` is NULL or filled. */
static inline usub_real usub_table_value(const usub_real *props, usub_real rate, usub_real pressure,
                                         usub_real temperature, const usub_real *fields, int number,
                                         usub_real *derivative) {
  const double x[3] = {rate, pressure, temperature};
  const int head = usub_table_head(props), variables = head - 1;
  const usub_real *points = props + head;
  usub_table table = {props, fields, {{0, 0, {0, 0}, 1, 1}}};
  ptrdiff_t size = 1;
  double by[3] = {0, 0, 0};
  for (int i = 0; i < variables; ++i) {
    const int n = usub_table_points(props, i);
    if (i < 3)
      table.main[i] = usub_table_find(points, n, x[i]);
    points += n;
    size *= n;
  }
  const usub_pair value = usub_table_over(&table, variables - 1, points, points + size * number,
                                          size, derivative ? by : NULL);
  for (int i = 0; derivative && i < 3; ++i)
    derivative[i] = (usub_real)by[i];
  return (usub_real)(value.high + value.low);
}

#endif
