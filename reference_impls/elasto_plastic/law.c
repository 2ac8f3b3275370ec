/* SPDX-License-Identifier: MIT */
/* Elasto-plastic friction: LuGre with a bristle that is elastic up to its breakaway;
 * props: mus, muk, vs, delta, sigma0, sigma1, sigma2, breakaway.
 * While the bristle slips in part, its bend is told by `gap`, what it lacks to its limit, and
 * `angle`, from the motion to the bend; lengths are in units of the limit. */
#define USUB_LAW "elasto_plastic"
#define USUB_LAW_PROPS 8
#define USUB_LAW_VECTORS 1
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TIME
#include <usersub/bristle_law.h>
#include <usersub/law_functions.h>

#define PI ((usub_real)3.14159265358979323846)
/* Motion, in units of the limit, that ends in steady slip to rounding. */
#define STEADY 40
/* Least breakaway: below, the bend where slip begins is lost in rounding. */
#define LEAST (sizeof(usub_real) == sizeof(double) ? (usub_real)1e-12 : (usub_real)1e-5)

/* Gap and angle; their derivatives by the gap at the beginning; those by the direction of the
 * motion, of the angle in space, which are small where the motion is. */
enum { GAP, ANGLE, GAP_BY_GAP, ANGLE_BY_GAP, GAP_BY_TURN, ANGLE_BY_TURN, NUMBERS };

/* Parts of midpoint sums, and weights that remove their errors up to the order 12. */
static const int PARTS[6] = {2, 4, 6, 8, 10, 12};
static const double WEIGHTS[6] = {-1 / 302400.0,   8 / 945.0,           -2187 / 4480.0,
                                  65536 / 14175.0, -9765625 / 798336.0, 17496 / 1925.0};

/* One less alpha times the bend: how much of a motion along the bend bends it further. */
static usub_real slack_of(usub_real gap, usub_real width, usub_real *slope) {
  const usub_real share = PI / 2 * gap / width, s = sin(share), c = cos(share);
  *slope = PI / width * s * c * (1 - gap) + c * c;
  return s * s + c * c * gap;
}

/* Derivatives by the motion. */
static void flow(const usub_real *y, int numbers, usub_real width, usub_real *rate) {
  usub_real slope;
  const usub_real slack = slack_of(y[GAP], width, &slope), bend = 1 - y[GAP];
  const usub_real s = sin(y[ANGLE]), c = cos(y[ANGLE]);
  rate[GAP] = -c * slack;
  rate[ANGLE] = -s / bend;
  for (int j = GAP_BY_GAP; j < numbers; j += 2) {
    const usub_real angle = j == GAP_BY_TURN ? y[j + 1] - 1 : y[j + 1];
    rate[j] = -c * slope * y[j] + s * slack * angle;
    rate[j + 1] = -s / bend / bend * y[j] - c / bend * angle;
  }
}

/* Motion over which the bend changes little. */
static usub_real safe_step(const usub_real *y, usub_real width) {
  const usub_real turn = fabs(sin(y[ANGLE])), share = PI * fabs(y[GAP]) / width;
  const usub_real fall = PI / 2 / width * (share < 1 ? share : 1);
  const usub_real round_about = (1 + 2 * sqrt(turn)) / (1 - y[GAP]);
  return (usub_real)0.5 / (1 + fall * fabs(cos(y[ANGLE])) + sqrt(fall * turn) + round_about);
}

/* After a motion: extrapolated midpoint sums; a long motion ends in steady slip, exp(-40) away. */
static void approach(usub_real *y, int numbers, usub_real motion, usub_real width) {
  usub_real rate[NUMBERS], before[NUMBERS], here[NUMBERS], change[NUMBERS];
  if (motion > STEADY) {
    for (int i = 0; i < numbers; ++i)
      y[i] = i == ANGLE_BY_TURN;
    return;
  }
  for (usub_real left = motion; left > 0;) {
    const usub_real safe = safe_step(y, width), step = safe < left ? safe : left;
    for (int i = 0; i < numbers; ++i)
      change[i] = 0;
    for (int j = 0; j < 6; ++j) {
      const usub_real part = step / (usub_real)PARTS[j];
      flow(y, numbers, width, rate);
      for (int i = 0; i < numbers; ++i) {
        before[i] = y[i];
        here[i] = y[i] + part * rate[i];
      }
      for (int k = 1; k < PARTS[j]; ++k) {
        flow(here, numbers, width, rate);
        for (int i = 0; i < numbers; ++i) {
          const usub_real after = before[i] + 2 * part * rate[i];
          before[i] = here[i];
          here[i] = after;
        }
      }
      for (int i = 0; i < numbers; ++i)
        change[i] += (usub_real)WEIGHTS[j] * (here[i] - y[i]);
    }
    for (int i = 0; i < numbers; ++i)
      y[i] += change[i];
    left -= step;
  }
}

/* One motion: bend at the beginning, along the motion and across it; motion that bends it
 * elastically before it slips, and how much of the bend it leads to; the end. */
typedef struct path {
  usub_real along, across, motion, width, reach, stick;
  int slips, clipped;
  usub_real y[NUMBERS], slack, slope;
} path;

static void follow(path *p, int numbers) {
  const usub_real breakaway = 1 - p->width;
  p->reach = fabs(p->across) < breakaway ? sqrt((breakaway - p->across) * (breakaway + p->across))
                                         : (usub_real)0;
  p->stick = p->along < p->reach ? p->reach - p->along : 0;
  p->slips = !(p->motion < p->stick);
  if (!p->slips)
    return;
  const usub_real begin = p->stick > 0 ? p->reach : p->along;
  p->y[GAP] = 1 - hypot(begin, p->across);
  p->y[ANGLE] = atan2(p->across, begin);
  p->y[GAP_BY_GAP] = 1;
  p->y[ANGLE_BY_GAP] = p->y[GAP_BY_TURN] = p->y[ANGLE_BY_TURN] = 0;
  approach(p->y, numbers, p->motion - p->stick, p->width);
  p->slack = slack_of(p->y[GAP], p->width, &p->slope);
}

/* Bend at the end, and how it changes with further motion. */
static void end_of(const path *p, usub_real bend[2], usub_real speed[2]) {
  const usub_real c = cos(p->y[ANGLE]), s = sin(p->y[ANGLE]);
  bend[0] = (1 - p->y[GAP]) * c;
  bend[1] = (1 - p->y[GAP]) * s;
  speed[0] = s * s + p->slack * c * c;
  speed[1] = -(1 - p->slack) * s * c;
}

/* What one variable changes: bend at the beginning, motion and its direction, limit. */
typedef struct change {
  usub_real along, across, motion, angle, limit;
} change;

/* Changes of gap and of angle in space at the beginning of the slip, and of the motion before. */
static void begin_change(const path *p, const change *d, usub_real *gap, usub_real *angle,
                         usub_real *stick) {
  *gap = *stick = 0;
  if (p->stick > 0 && p->reach > 0) {
    *angle = (d->across + p->stick * d->angle) / p->reach;
    *stick = -p->across * *angle - d->along;
  } else if (p->stick > 0) { /* the bend is beyond the breakaway and has turned to the side */
    *gap = (p->across > 0 ? -1 : 1) * (d->across + p->stick * d->angle);
    *angle = d->angle;
    *stick = -d->along - p->across * d->angle;
  } else {
    const usub_real square = p->along * p->along + p->across * p->across;
    if (!p->clipped)
      *gap = -(p->along * d->along + p->across * d->across) / sqrt(square);
    *angle = (p->along * d->across - p->across * d->along) / square;
  }
}

/* Changes of bend (times the limit) and speed at the end. */
static void end_change(const path *p, const change *d, usub_real limit, usub_real d_bend[2],
                       usub_real d_speed[2]) {
  const usub_real c = cos(p->y[ANGLE]), s = sin(p->y[ANGLE]), bent = 1 - p->y[GAP];
  usub_real gap, angle, stick, bend[2], speed[2];
  end_of(p, bend, speed);
  begin_change(p, d, &gap, &angle, &stick);
  /* In steady slip a longer motion changes nothing; by a tiny pressure it changes without bound. */
  const int steady = p->motion - p->stick > STEADY;
  const usub_real left = steady ? 0 : d->motion - stick, turn = d->angle - angle;
  const usub_real d_gap = p->y[GAP_BY_GAP] * gap + p->y[GAP_BY_TURN] * turn - c * p->slack * left;
  const usub_real d_angle =
      p->y[ANGLE_BY_GAP] * gap + angle + p->y[ANGLE_BY_TURN] * turn - s / bent * left;
  const usub_real relative = d_angle - d->angle;
  d_bend[0] = limit * (-d_gap * c - bent * s * d_angle) + d->limit * bend[0];
  d_bend[1] = limit * (-d_gap * s + bent * c * d_angle) + d->limit * bend[1];
  d_speed[0] =
      2 * s * c * (1 - p->slack) * relative + c * c * p->slope * d_gap - speed[1] * d->angle;
  d_speed[1] =
      s * c * p->slope * d_gap - (1 - p->slack) * (c * c - s * s) * relative + speed[0] * d->angle;
}

/* Where nothing moves: what a motion would change, by each component from above. */
static void at_rest(const usub_real bend[2], usub_real width, usub_real by_motion[2][2]) {
  usub_real unused;
  const usub_real size = hypot(bend[0], bend[1]), gap = 1 - size;
  const usub_real held =
      size > 0 && gap <= width ? (1 - slack_of(gap, width, &unused)) / size / size : 0;
  for (int b = 0; b < 2; ++b)
    for (int a = 0; a < 2; ++a)
      by_motion[a][b] = (a == b) - held * bend[a] * (bend[b] > 0 ? bend[b] : 0);
}

USUB_BRISTLE_FUNCTION {
  const usub_real stiffness = props[4], damping = props[5],
                  width = 1 - (props[7] > LEAST ? props[7] : LEAST);
  const usub_real per_time = time_increment > 0 ? 1 / time_increment : 0;
  const usub_real length = hypot(motion[0], motion[1]), rate = length * per_time;
  usub_real mu_by_rate, *z = vectors[0];
  const usub_real mu = usub_stribeck(rate, props[0], props[1], props[2], props[3], &mu_by_rate);
  const usub_real limit = pressure * mu / stiffness, size = hypot(z[0], z[1]);
  for (int a = 0; a < 2; ++a) {
    traction[a] = props[6] * per_time * motion[a];
    if (tangent)
      tangent[a][a] = props[6] * per_time;
  }
  const usub_real n[2] = {length > 0 ? motion[0] / length : 0, length > 0 ? motion[1] / length : 0};
  if (!(limit > USUB_TINY)) { /* the bristle carries nothing, but it will with the pressure */
    for (int a = 0; a < 2; ++a) {
      z[a] = 0;
      if (tangent)
        tangent[a][2] = mu * n[a];
    }
    return;
  }
  /* A bend beyond a limit that has fallen goes back to it. */
  const int clipped = size > limit;
  const usub_real unit = clipped ? size : limit, first[2] = {z[0] / unit, z[1] / unit};
  const usub_real by_length = limit * mu_by_rate * per_time / mu; /* of the limit */
  if (!(length > 0)) {
    usub_real by_motion[2][2];
    at_rest(first, width, by_motion);
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2 && tangent; ++b)
        tangent[a][b] += (stiffness + damping * per_time) * by_motion[a][b] +
                         (clipped ? stiffness * by_length * first[a] : 0);
      if (tangent && clipped)
        tangent[a][2] = mu * first[a];
      z[a] = limit * first[a];
      traction[a] += stiffness * z[a];
    }
    return;
  }

  const usub_real t[2] = {-n[1], n[0]};
  path p = {.along = first[0] * n[0] + first[1] * n[1],
            .across = first[0] * t[0] + first[1] * t[1],
            .motion = length / limit,
            .width = width,
            .clipped = clipped};
  follow(&p, tangent ? NUMBERS : GAP_BY_GAP);
  if (!p.slips) {
    for (int a = 0; a < 2; ++a) {
      z[a] = (clipped ? limit * first[a] : z[a]) + motion[a];
      traction[a] += stiffness * z[a] + damping * per_time * motion[a];
      if (tangent)
        tangent[a][a] += stiffness + damping * per_time;
      for (int b = 0; b < 2 && tangent && clipped; ++b)
        tangent[a][b] += stiffness * by_length * first[a] * n[b];
      if (tangent && clipped)
        tangent[a][2] = mu * first[a];
    }
    return;
  }
  usub_real bend[2], speed[2];
  end_of(&p, bend, speed);
  for (int a = 0; a < 2; ++a) {
    z[a] = limit * (bend[0] * n[a] + bend[1] * t[a]);
    traction[a] += stiffness * z[a] + damping * rate * (speed[0] * n[a] + speed[1] * t[a]);
  }
  if (!tangent)
    return;
  /* by the length of the motion, by its angle and by the pressure */
  const usub_real share = clipped ? 0 : 1 / limit;
  const change changes[3] = {{-share * p.along * by_length, -share * p.across * by_length,
                              (1 - p.motion * by_length) / limit, 0, by_length},
                             {0, 0, 0, 1 / length, 0},
                             {-share * p.along * limit / pressure,
                              -share * p.across * limit / pressure, -p.motion / pressure, 0,
                              limit / pressure}};
  for (int k = 0; k < 3; ++k) {
    usub_real d_bend[2], d_speed[2];
    end_change(&p, &changes[k], limit, d_bend, d_speed);
    for (int a = 0; a < 2; ++a) {
      const usub_real d_rate = k == 0 ? per_time * (speed[0] * n[a] + speed[1] * t[a]) : 0;
      const usub_real change = stiffness * (d_bend[0] * n[a] + d_bend[1] * t[a]) +
                               damping * (d_rate + rate * (d_speed[0] * n[a] + d_speed[1] * t[a]));
      if (k == 2)
        tangent[a][2] += change;
      for (int b = 0; b < 2 && k < 2; ++b)
        tangent[a][b] += change * (k == 0 ? n[b] : t[b]);
    }
  }
}
