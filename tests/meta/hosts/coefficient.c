/* SPDX-License-Identifier: MIT */
/* An implicit host of FRIC_COEF, by hand: points that are moved to and fro.
 *
 * In every iteration the slip of a point comes nearer to what the path asks for, as a Newton
 * method's would; FRIC_COEF is asked once each time. The interface "legacy" is the older form. */
#include "common.h"

#include <math.h>

enum { POINTS = 2, STATES = 2, INCREMENTS = 6, ITERATIONS = 3 };

typedef struct point {
  double slip[2], equivalent, state[STATES], new_state[STATES];
} point;

static point points[POINTS];
static double props[1] = {0.3};
static int one = 1, zero, is_legacy;
static void *flags_end, *times_end;
static char interaction[80], secondary[80], main_surface[80];

static void call_point(usub_entry entry, int i, int iteration, int increment, double time,
                       double dt, const double move[2]) {
  point *p = &points[i];
  void *argv[USUB_FRIC_COEF_2022_COUNT];
  double mu[2] = {0, 0}, derivative[40] = {0}, pressure = 100 + 5 * i, warm = 25;
  double rdata[7 + STATES] = {time, time, dt, 1, 0, 0, 1}, data[6], rate;
  int idata[6] = {1, increment, iteration, 101 + i, STATES, 2};
  const double size = hypot(move[0], move[1]);
  rate = is("rate-negative") ? -size / dt : size / dt;
  data[0] = is("rate-component") ? move[0] / dt : rate;
  data[1] = move[0] / dt;
  data[2] = move[1] / dt;
  data[3] = is("equivalent-signed") ? p->slip[0] + move[0] : p->equivalent + size;
  data[4] = p->slip[0] + move[0];
  data[5] = p->slip[1] + move[1];
  if (is("iteration-zero"))
    idata[2] = iteration - 1;
  if (is("iteration-total"))
    idata[2] = iteration + ITERATIONS * (increment - 1);
  if (is("directions"))
    idata[5] = 3;
  if (is("rotation-zero"))
    rdata[3] = rdata[6] = 0;
  memcpy(rdata + 7, is("state-updated") ? p->new_state : p->state, sizeof p->state);
  argv[USUB_FRIC_COEF_2022_FCOEF] = mu;
  argv[USUB_FRIC_COEF_2022_FCOEFDERIV] = derivative;
  argv[USUB_FRIC_COEF_2022_NBLOCK] = argv[USUB_FRIC_COEF_2022_NPROPS] = &one;
  argv[USUB_FRIC_COEF_2022_NTEMP] = &one;
  argv[USUB_FRIC_COEF_2022_NFIELDS] = &zero;
  argv[USUB_FRIC_COEF_2022_IDATA] = idata;
  argv[USUB_FRIC_COEF_2022_RDATA] = rdata;
  argv[USUB_FRIC_COEF_2022_SURFINT] = interaction;
  argv[USUB_FRIC_COEF_2022_SURFSEC] = secondary;
  argv[USUB_FRIC_COEF_2022_SURFMAIN] = main_surface;
  argv[USUB_FRIC_COEF_2022_PROPS] = props;
  argv[USUB_FRIC_COEF_2022_SLIPDATA] = data;
  argv[USUB_FRIC_COEF_2022_PRESSURE] = &pressure;
  argv[USUB_FRIC_COEF_2022_TEMPAVG] = &warm;
  argv[USUB_FRIC_COEF_2022_FIELDAVG] = &warm;
  if (is_legacy) { /* where the longer arrays end, nothing can be read */
    argv[USUB_FRIC_COEF_2022_IDATA] = memcpy(flags_end, idata, 2 * sizeof *idata);
    argv[USUB_FRIC_COEF_2022_RDATA] = memcpy(times_end, rdata, 3 * sizeof *rdata);
    argv[USUB_FRIC_COEF_2022_SLIPDATA] = &rate;
  }
  usub_call_fric_coef_2022_d(entry, argv);
  memcpy(p->new_state, rdata + 7, sizeof p->new_state);
}

int main(int count, char **arguments) {
  if (count < 4)
    return 2;
  fault = arguments[3];
  is_legacy = strcmp(arguments[2], "legacy") == 0;
  flags_end = at_the_end(2 * sizeof(int));
  times_end = at_the_end(3 * sizeof(double));
  usub_entry entry = entry_of(arguments[1], "fric_coef");
  name(interaction, "RUBBER ON STEEL");
  name(secondary, "TREAD");
  name(main_surface, "ROAD");
  double time = 0, move[POINTS][2];
  for (int increment = 1; increment <= INCREMENTS; ++increment) {
    const double dt = 0.1 * increment, way = increment % 3 == 0 ? -1 : 1;
    time += dt;
    for (int iteration = 1; iteration <= ITERATIONS; ++iteration)
      for (int i = 0; i < POINTS; ++i) {
        const double share = iteration / (double)ITERATIONS;
        move[i][0] = way * share * (1 + i);
        move[i][1] = share * 0.5;
        call_point(entry, i, iteration, increment, time, dt, move[i]);
      }
    for (int i = 0; i < POINTS; ++i) {
      point *p = &points[i];
      p->equivalent += hypot(move[i][0], move[i][1]);
      for (int a = 0; a < 2; ++a)
        p->slip[a] += move[i][a];
      if (!is("state-lost"))
        memcpy(p->state, points[is("state-mixed") ? 1 - i : i].new_state, sizeof p->state);
    }
  }
  misbehave();
  return 0;
}
