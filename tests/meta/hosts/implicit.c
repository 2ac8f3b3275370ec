/* SPDX-License-Identifier: MIT */
/* An implicit host of FRIC, by hand: points that springs drag over a plane.
 *
 * Each of three points hangs on a spring whose other end is driven along a path that turns. In
 * every iteration the closed points call the routine; the slip increment g of a point follows from
 * k (u_driven - u - g) = A tau by Newton's method, from g = 0 and a multiplier where it sticks,
 * from no stress where it is frictionless. Point 3 is open in increments 4 and 5.
 *
 * Healthy as well: "healthy-open" (everything is open at the end of a step), "healthy-anew" (every
 * attempt is abandoned after two iterations and begun anew with the same times), "healthy-twice"
 * (the analysis is run twice), "healthy-reversed" (points in another order every other iteration).
 */
#include "common.h"

#include <math.h>

enum { POINTS = 3, STATES = 2, INCREMENTS = 9, STEPS = 2, MOST_ITERATIONS = 12 };
static const double spring = 50.0, area = 2.0;

/* What a point keeps of the accepted increment, and of the last iteration. */
typedef struct point {
  double u[2], tau[2], slip[2], sed, state[STATES], pressure;
  int condition;
  double g[2], new_tau[2], dslip[2], new_sed, new_state[STATES], now, multiplier[2];
  int lm, called;
} point;

static point points[POINTS];
static double props[2] = {0.25, 1.0}, temperature[2] = {20, 30}, field[2] = {1, 2};
static double coords[3], opposing[3], turn[4] = {1, 0, 0, 1}, length = 0.1, stiffness = 1e5;
static int step, increment, zero, directions = 2, dimension = 3, fields = 1, states = STATES;
static int prop_count = 2;
static char interaction[80], secondary[80], main_surface[80];
static usub_entry routine;

static double pressure_of(int i, double time) {
  if (is("healthy-open") && increment >= INCREMENTS - 1)
    return 0;
  return i == 2 && increment >= 4 && increment <= 5 ? 0.0 : 100.0 + 10.0 * i + 5.0 * time;
}

static void driven(double time, double to[2]) {
  to[0] = 2.0 * sin(0.7 * time);
  to[1] = 1.5 * (1 - cos(0.9 * time));
}

/* Arguments that are the same for all points. */
static void place_common(void **argv, double times[2], double *dt) {
  argv[USUB_FRIC_KSTEP] = is("step-exchanged") ? &increment : &step;
  argv[USUB_FRIC_KINC] = is("step-exchanged") ? &step : &increment;
  argv[USUB_FRIC_TIME] = times;
  argv[USUB_FRIC_DTIME] = dt;
  argv[USUB_FRIC_NOEL] = argv[USUB_FRIC_NPT] = argv[USUB_FRIC_NPATCH] = &zero;
  argv[USUB_FRIC_CINAME] = interaction;
  argv[USUB_FRIC_SECNAME] = secondary;
  argv[USUB_FRIC_MAINNAME] = main_surface;
  argv[USUB_FRIC_COORDS] = is("coords-null") ? NULL : coords;
  argv[USUB_FRIC_RCOORD] = is("coords-nowhere") ? (void *)(uintptr_t)0x10 : opposing;
  argv[USUB_FRIC_DROT] = turn;
  argv[USUB_FRIC_TEMP] = temperature;
  argv[USUB_FRIC_PREDEF] = field;
  argv[USUB_FRIC_NFDIR] = &directions;
  argv[USUB_FRIC_MCRD] = &dimension;
  argv[USUB_FRIC_NPRED] = &fields;
  argv[USUB_FRIC_NSTATV] = &states;
  argv[USUB_FRIC_CHRLNGTH] = &length;
  argv[USUB_FRIC_PROPS] = props;
  argv[USUB_FRIC_NPROPS] = &prop_count;
  argv[USUB_FRIC_DDPDDH] = &stiffness;
}

/* What the routine continues from, by the protocol. */
static void prepare(point *p, int iteration, int *lm, double tau[2], double dslip[2],
                    double taulm[2], double state[STATES]) {
  const int first = !p->called;
  *lm = first ? p->condition : p->lm;
  if (is("lm-lost") && !first)
    *lm = p->condition;
  if (is("lm-start") && first && p->condition != 2)
    *lm = 2;
  if (is("lm-open") && first && p->condition == 2 && increment > 1)
    *lm = 0;
  if (is("lm-range"))
    *lm = 3;
  const int updates = is("tau-updated") && iteration > 1;
  for (int a = 0; a < 2; ++a) {
    tau[a] = updates ? p->new_tau[a] : is("tau-lost") ? 0 : p->tau[a];
    dslip[a] = (!first && p->lm == 0 && !is("dslip-lost")) || (is("dslip-kept") && increment > 1)
                   ? p->dslip[a]
                   : 0;
    taulm[a] = *lm == 1 || is("taulm-always") ? p->multiplier[a] : 0;
  }
  if (is("dslip-after-lm") && !first && p->lm != 0)
    dslip[0] = 1e-3;
  for (int s = 0; s < STATES; ++s)
    state[s] = is("state-updated") && !first ? p->new_state[s] : p->state[s];
}

/* Newton's step for the slip of the increment from the answer of the routine. Returns the size of
 * what is left. */
static double advance(point *p, double driven_by[2], const double *tangent) {
  double r[2], a[4], worst = 0;
  for (int i = 0; i < 2; ++i)
    r[i] = spring * (driven_by[i] - p->u[i] - p->g[i]) - area * p->new_tau[i];
  if (p->lm == 1) {
    for (int i = 0; i < 2; ++i) {
      p->multiplier[i] = spring * (driven_by[i] - p->u[i]) / area;
      worst = fmax(worst, fabs(p->g[i]));
      p->g[i] = is("moves") ? driven_by[i] - p->u[i] : 0;
    }
    return is("moves") ? 0 : worst * spring;
  }
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      a[2 * i + j] = (i == j) * spring + area * tangent[2 * j + i];
  const double det = a[0] * a[3] - a[1] * a[2];
  p->g[0] += (a[3] * r[0] - a[1] * r[1]) / det;
  p->g[1] += (a[0] * r[1] - a[2] * r[0]) / det;
  return fmax(fabs(r[0]), fabs(r[1]));
}

/* One call; returns what is left of the balance of the point. */
static double call_point(point *p, int i, int iteration, double times[2], double dt,
                         double driven_by[2], double *pnewdt) {
  void *argv[USUB_FRIC_COUNT];
  int lm, node = is("node-zero") ? 0 : 101 + i;
  double tau[2], dslip[2], taulm[2], state[STATES], tangent[4] = {0}, by_pressure[2] = {0};
  double by_temperature[4] = {0}, sed = is("sed-lost") ? 0 : p->sed, sfd = 0, shorter = 1e36;
  double change = p->now - (is("dpress-total") || p->condition == 2 ? 0 : p->pressure);
  prepare(p, iteration, &lm, tau, dslip, taulm, state);
  if (is("pnewdt-preset") && dt > 0.1)
    shorter = 0.5;
  place_common(argv, times, &dt);
  argv[USUB_FRIC_LM] = &lm;
  argv[USUB_FRIC_TAU] = tau;
  argv[USUB_FRIC_DDTDDG] = tangent;
  argv[USUB_FRIC_DDTDDP] = by_pressure;
  argv[USUB_FRIC_DSLIP] = dslip;
  argv[USUB_FRIC_SED] = &sed;
  argv[USUB_FRIC_SFD] = &sfd;
  argv[USUB_FRIC_DDTDDT] = by_temperature;
  argv[USUB_FRIC_PNEWDT] = &shorter;
  argv[USUB_FRIC_STATEV] = state;
  argv[USUB_FRIC_DGAM] = p->g;
  argv[USUB_FRIC_TAULM] = taulm;
  argv[USUB_FRIC_PRESS] = &p->now;
  argv[USUB_FRIC_DPRESS] = &change;
  argv[USUB_FRIC_SLIP] = p->slip;
  argv[USUB_FRIC_NODE] = &node;
  if (is("tau-short")) { /* room for one of two components */
    double *end = at_the_end(sizeof *end);
    *end = tau[0];
    argv[USUB_FRIC_TAU] = end;
  }
  if (is("energy-read-only")) {
    static const double fixed = 0;
    argv[USUB_FRIC_SFD] = (void *)(uintptr_t)&fixed;
  }
  if (is("shared"))
    argv[USUB_FRIC_DDTDDT] = tangent;
  if (is("unaligned"))
    argv[USUB_FRIC_COORDS] = (char *)coords + 4;
  usub_call_fric_d(routine, argv);
  p->lm = lm;
  p->called = 1;
  p->new_sed = sed;
  *pnewdt = fmin(*pnewdt, shorter);
  memcpy(p->new_tau, tau, sizeof tau);
  memcpy(p->dslip, dslip, sizeof dslip);
  memcpy(p->new_state, state, sizeof state);
  if (lm == 2)
    p->new_tau[0] = p->new_tau[1] = 0;
  return advance(p, driven_by, tangent);
}

/* All iterations of an attempt, or the first few; returns the smallest PNEWDT. */
static double solve(double times[2], double dt, int most) {
  double driven_by[2], pnewdt = 1e36;
  driven(times[1], driven_by);
  for (int i = 0; i < POINTS; ++i) {
    points[i].called = 0;
    points[i].g[0] = points[i].g[1] = 0;
    points[i].now = pressure_of(i, times[1]);
  }
  for (int iteration = 1; iteration <= most; ++iteration) {
    double left = 0;
    for (int k = 0; k < POINTS; ++k) {
      const int i = is("healthy-reversed") && iteration % 2 ? POINTS - 1 - k : k;
      if (points[i].now > 0) {
        const double point_left =
            call_point(&points[i], i, iteration, times, dt, driven_by, &pnewdt);
        left = fmax(left, point_left);
      }
    }
    if (pnewdt < 1 && !is("pnewdt-ignored"))
      return pnewdt;
    if (is("increment-iterates"))
      ++increment;
    if (left < 1e-8 && iteration > 3)
      break;
  }
  return is("pnewdt-ignored") ? 1e36 : pnewdt;
}

static void accept(void) {
  for (int i = 0; i < POINTS; ++i) {
    point *p = &points[i];
    const int open = !(p->now > 0);
    p->condition = open ? 2 : p->lm == 1 ? 1 : 0;
    p->pressure = p->now;
    for (int a = 0; a < 2; ++a) {
      p->u[a] += open ? 0 : p->g[a];
      p->tau[a] = open ? 0 : p->lm == 1 ? p->multiplier[a] : p->new_tau[a];
      if (!open && p->lm == 0 && !is("slip-lost"))
        p->slip[a] += p->dslip[a];
    }
    p->sed = open || p->lm ? 0 : p->new_sed;
    if (!open && !is("state-lost"))
      memcpy(p->state, points[is("state-mixed") ? (i + 1) % 2 : i].new_state, sizeof p->state);
  }
}

static void set_up(void) {
  name(interaction, "RUBBER ON STEEL");
  name(secondary, "TREAD");
  name(main_surface, "ROAD");
  if (is("lengths"))
    name_length = 8;
  if (is("directions-zero"))
    directions = 0;
  if (is("rotation-zero"))
    turn[0] = turn[3] = 0;
  if (is("nan-temperature"))
    temperature[1] = NAN;
}

/* An increment, tried until it is not cut back. Returns its length. */
static double run_increment(double start, double step_start, double dt) {
  for (;;) {
    double times[2] = {start + dt - step_start, start + dt};
    if (is("time-start"))
      times[0] -= dt, times[1] -= dt;
    if (is("time-exchanged")) {
      const double total = times[1];
      times[1] = times[0];
      times[0] = total;
    }
    if (is("healthy-anew"))
      solve(times, dt, 2);
    const double pnewdt = solve(times, dt, MOST_ITERATIONS);
    if (pnewdt >= 1)
      return dt;
    if (is("cut-counted"))
      ++increment;
    if (is("state-after-cut"))
      for (int i = 0; i < POINTS; ++i)
        memcpy(points[i].state, points[i].new_state, sizeof points[i].state);
    dt *= is("cut-too-little") ? 0.9 : pnewdt;
  }
}

static void run(void) {
  double time = 0;
  memset(points, 0, sizeof points);
  for (int i = 0; i < POINTS; ++i)
    points[i].condition = 2;
  for (step = 1; step <= STEPS; ++step) {
    const double step_start = time;
    for (increment = 1; increment <= INCREMENTS; ++increment) {
      const int number = increment;
      time += run_increment(time, step_start, 0.1 + 0.01 * increment);
      accept();
      if (is("increment-stays"))
        increment = 1;
      if (!is("increment-iterates") && !is("cut-counted") && !is("increment-stays"))
        increment = number;
      if (time > 4)
        break;
      if (is("props-change"))
        props[1] += 1;
    }
  }
}

int main(int count, char **arguments) {
  if (count < 4)
    return 2;
  fault = arguments[3];
  if (is("never-calls"))
    return 0;
  routine = entry_of(arguments[1], "fric");
  set_up();
  run();
  if (is("healthy-twice"))
    run();
  misbehave();
  return 0;
}
