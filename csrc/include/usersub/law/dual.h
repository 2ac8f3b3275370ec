/* SPDX-License-Identifier: MIT */
/** @file law/dual.h
 * A number with its derivatives by four variables, for C++: `usub_value` where a law's file is
 * compiled the second time (part of `laws.h`).
 *
 * The value is what the same source gives without derivatives, bit for bit: every operation does
 * the one operation of C on the values, in the same order. Comparisons decide by the value. At a
 * kink each derivative is the one from above by its variable: of `fabs` at zero the magnitude, of
 * `fmax` and `fmin` of equal numbers the larger and the smaller one, of `hypot(0, 0)` the length.
 * An infinite slope (`sqrt` at zero, `pow` with an exponent below one at zero) is infinite for the
 * variables that move the argument, and zero for the others. Steps (`floor`) have the slope zero.
 */
#ifndef USERSUB_LAW_DUAL_H
#define USERSUB_LAW_DUAL_H

#include <cmath>

struct usub_dual {
  double v;
  double d[4];

  usub_dual() = default;
  usub_dual(double value) : v(value), d{0, 0, 0, 0} {}
  /* Independent variable number `which`. */
  static usub_dual variable(double value, int which) {
    usub_dual x(value);
    x.d[which] = 1;
    return x;
  }

  usub_dual &operator+=(const usub_dual &b);
  usub_dual &operator-=(const usub_dual &b);
  usub_dual &operator*=(const usub_dual &b);
  usub_dual &operator/=(const usub_dual &b);

  /* Conditions, and indices of tables. A plain number would lose the derivatives without a word:
   * usub_plain() says that this is meant. */
  explicit operator bool() const { return v != 0; }
  explicit operator int() const { return (int)v; }
  explicit operator long() const { return (long)v; }
  explicit operator double() const = delete;
  explicit operator float() const = delete;
};

static inline double usub_plain(const usub_dual &x) {
  return x.v;
}

/* Slope times derivative; what does not move has none, even where the slope is infinite. */
static inline double usub_along(double slope, double derivative) {
  return derivative == 0 ? 0 : slope * derivative;
}

/* A function of one or two numbers: its value, its slopes. */
static inline usub_dual usub_chain(double value, const usub_dual &a, double slope) {
  usub_dual x(value);
  for (int i = 0; i < 4; ++i)
    x.d[i] = usub_along(slope, a.d[i]);
  return x;
}
static inline usub_dual usub_chain(double value, const usub_dual &a, double slope_a,
                                   const usub_dual &b, double slope_b) {
  usub_dual x(value);
  for (int i = 0; i < 4; ++i)
    x.d[i] = usub_along(slope_a, a.d[i]) + usub_along(slope_b, b.d[i]);
  return x;
}

static inline usub_dual operator+(const usub_dual &a) {
  return a;
}
static inline usub_dual operator-(const usub_dual &a) {
  return usub_chain(-a.v, a, -1);
}
static inline usub_dual operator+(const usub_dual &a, const usub_dual &b) {
  return usub_chain(a.v + b.v, a, 1, b, 1);
}
static inline usub_dual operator-(const usub_dual &a, const usub_dual &b) {
  return usub_chain(a.v - b.v, a, 1, b, -1);
}
static inline usub_dual operator*(const usub_dual &a, const usub_dual &b) {
  return usub_chain(a.v * b.v, a, b.v, b, a.v);
}
static inline usub_dual operator/(const usub_dual &a, const usub_dual &b) {
  const double quotient = a.v / b.v;
  usub_dual x(quotient);
  for (int i = 0; i < 4; ++i)
    x.d[i] = (a.d[i] - usub_along(quotient, b.d[i])) / b.v;
  return x;
}
inline usub_dual &usub_dual::operator+=(const usub_dual &b) {
  return *this = *this + b;
}
inline usub_dual &usub_dual::operator-=(const usub_dual &b) {
  return *this = *this - b;
}
inline usub_dual &usub_dual::operator*=(const usub_dual &b) {
  return *this = *this * b;
}
inline usub_dual &usub_dual::operator/=(const usub_dual &b) {
  return *this = *this / b;
}

#define USUB_DUAL_COMPARISON(symbol)                                                               \
  static inline bool operator symbol(const usub_dual &a, const usub_dual &b) {                     \
    return a.v symbol b.v;                                                                         \
  }
USUB_DUAL_COMPARISON(<)
USUB_DUAL_COMPARISON(<=)
USUB_DUAL_COMPARISON(>)
USUB_DUAL_COMPARISON(>=)
USUB_DUAL_COMPARISON(==)
USUB_DUAL_COMPARISON(!=)
#undef USUB_DUAL_COMPARISON

/* Functions of one number; `x` and `y` are the number and the value. */
#define USUB_DUAL_FUNCTION(name, slope)                                                            \
  static inline usub_dual name(const usub_dual &a) {                                               \
    const double x = a.v, y = std::name(x);                                                        \
    (void)x;                                                                                       \
    return usub_chain(y, a, slope);                                                                \
  }
USUB_DUAL_FUNCTION(exp, y)
USUB_DUAL_FUNCTION(exp2, y * 0.69314718055994530942)
USUB_DUAL_FUNCTION(expm1, std::exp(x))
USUB_DUAL_FUNCTION(log, 1 / x)
USUB_DUAL_FUNCTION(log2, 1.4426950408889634074 / x)
USUB_DUAL_FUNCTION(log10, 0.43429448190325182765 / x)
USUB_DUAL_FUNCTION(log1p, 1 / (1 + x))
USUB_DUAL_FUNCTION(sqrt, 0.5 / y)
USUB_DUAL_FUNCTION(cbrt, 1 / (3 * y * y))
USUB_DUAL_FUNCTION(sin, std::cos(x))
USUB_DUAL_FUNCTION(cos, -std::sin(x))
USUB_DUAL_FUNCTION(tan, 1 + y * y)
USUB_DUAL_FUNCTION(asin, 1 / std::sqrt((1 - x) * (1 + x)))
USUB_DUAL_FUNCTION(acos, -1 / std::sqrt((1 - x) * (1 + x)))
USUB_DUAL_FUNCTION(atan, 1 / std::hypot(1, x) / std::hypot(1, x))
USUB_DUAL_FUNCTION(sinh, std::cosh(x))
USUB_DUAL_FUNCTION(cosh, std::sinh(x))
USUB_DUAL_FUNCTION(tanh, 1 / std::cosh(x) / std::cosh(x))
USUB_DUAL_FUNCTION(asinh, 1 / std::hypot(1, x))
USUB_DUAL_FUNCTION(acosh, 1 / std::sqrt((x - 1) * (x + 1)))
USUB_DUAL_FUNCTION(atanh, 1 / ((1 - x) * (1 + x)))
USUB_DUAL_FUNCTION(erf, 1.1283791670955125739 * std::exp(-x * x))
USUB_DUAL_FUNCTION(erfc, -1.1283791670955125739 * std::exp(-x * x))
USUB_DUAL_FUNCTION(floor, 0)
USUB_DUAL_FUNCTION(ceil, 0)
USUB_DUAL_FUNCTION(trunc, 0)
USUB_DUAL_FUNCTION(round, 0)
#undef USUB_DUAL_FUNCTION

#define USUB_DUAL_QUESTION(name)                                                                   \
  static inline bool name(const usub_dual &a) {                                                    \
    return std::name(a.v);                                                                         \
  }
USUB_DUAL_QUESTION(isnan)
USUB_DUAL_QUESTION(isinf)
USUB_DUAL_QUESTION(isfinite)
USUB_DUAL_QUESTION(signbit)
#undef USUB_DUAL_QUESTION

/* Functions with a kink. */
static inline usub_dual usub_magnitude(double value, const usub_dual &a) {
  usub_dual x(value);
  for (int i = 0; i < 4; ++i)
    x.d[i] = a.v < 0 || (a.v == 0 && a.d[i] < 0) ? -a.d[i] : a.d[i];
  return x;
}
static inline usub_dual usub_of_two(double value, const usub_dual &chosen, const usub_dual &other,
                                    int larger) {
  usub_dual x = chosen;
  x.v = value;
  if (chosen.v == other.v)
    for (int i = 0; i < 4; ++i)
      x.d[i] = (other.d[i] > x.d[i]) == larger ? other.d[i] : x.d[i];
  return x;
}
static inline usub_dual fabs(const usub_dual &a) {
  return usub_magnitude(std::fabs(a.v), a);
}
static inline usub_dual usub_abs(const usub_dual &a) {
  return usub_magnitude(a.v < 0 ? -a.v : a.v, a);
}
static inline usub_dual fmin(const usub_dual &a, const usub_dual &b) {
  const int second = b.v < a.v || std::isnan(a.v);
  return usub_of_two(std::fmin(a.v, b.v), second ? b : a, second ? a : b, 0);
}
static inline usub_dual fmax(const usub_dual &a, const usub_dual &b) {
  const int second = b.v > a.v || std::isnan(a.v);
  return usub_of_two(std::fmax(a.v, b.v), second ? b : a, second ? a : b, 1);
}
static inline usub_dual usub_smaller(const usub_dual &a, const usub_dual &b) {
  return usub_of_two(b.v < a.v ? b.v : a.v, b.v < a.v ? b : a, b.v < a.v ? a : b, 0);
}
static inline usub_dual fdim(const usub_dual &a, const usub_dual &b) {
  const double value = std::fdim(a.v, b.v);
  return usub_of_two(value, value > 0 ? a - b : usub_dual(0.0), a.v == b.v ? a - b : 0.0, 1);
}
static inline usub_dual copysign(const usub_dual &a, const usub_dual &b) {
  const usub_dual size = fabs(a);
  return usub_chain(std::copysign(a.v, b.v), size, std::signbit(b.v) ? -1 : 1);
}
static inline usub_dual hypot(const usub_dual &a, const usub_dual &b) {
  const double length = std::hypot(a.v, b.v);
  usub_dual x = usub_chain(length, a, a.v / length, b, b.v / length);
  for (int i = 0; i < 4 && length == 0; ++i)
    x.d[i] = std::hypot(a.d[i], b.d[i]);
  return x;
}
static inline usub_dual fma(const usub_dual &a, const usub_dual &b, const usub_dual &c) {
  const usub_dual product = a * b;
  return usub_chain(std::fma(a.v, b.v, c.v), product, 1, c, 1);
}
static inline usub_dual fmod(const usub_dual &a, const usub_dual &b) {
  return usub_chain(std::fmod(a.v, b.v), a, 1, b, -std::trunc(a.v / b.v));
}
static inline usub_dual atan2(const usub_dual &a, const usub_dual &b) {
  const double length = std::hypot(a.v, b.v);
  return usub_chain(std::atan2(a.v, b.v), a, b.v / length / length, b, -a.v / length / length);
}

/* Inlined, so that the compiler makes of a constant exponent what it makes of it in C. */
__attribute__((always_inline)) static inline usub_dual pow(const usub_dual &a, double exponent) {
  const double slope = exponent == 0 ? 0 : exponent * std::pow(a.v, exponent - 1);
  return usub_chain(std::pow(a.v, exponent), a, slope);
}
static inline usub_dual pow(const usub_dual &a, const usub_dual &b) {
  const usub_dual x = pow(a, b.v);
  const double slope = a.v > 0 ? x.v * std::log(a.v) : a.v == 0 && b.v > 0 ? 0 : NAN;
  return usub_chain(x.v, x, 1, b, slope);
}
static inline usub_dual pow(double base, const usub_dual &exponent) {
  return pow(usub_dual(base), exponent);
}

/* Overloads above are better than those of the library for one usub_dual and one number; these are
 * the functions of two numbers for which C++ would find both equally good. */
#define USUB_DUAL_MIXED(name)                                                                      \
  static inline usub_dual name(const usub_dual &a, double b) {                                     \
    return name(a, usub_dual(b));                                                                  \
  }                                                                                                \
  static inline usub_dual name(double a, const usub_dual &b) {                                     \
    return name(usub_dual(a), b);                                                                  \
  }
USUB_DUAL_MIXED(fmin)
USUB_DUAL_MIXED(fmax)
USUB_DUAL_MIXED(fdim)
USUB_DUAL_MIXED(fmod)
USUB_DUAL_MIXED(copysign)
USUB_DUAL_MIXED(hypot)
USUB_DUAL_MIXED(atan2)
#undef USUB_DUAL_MIXED

#endif
