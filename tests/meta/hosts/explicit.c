/* SPDX-License-Identifier: MIT */
/* An explicit host of VFRIC, VFRICTION and VFRIC_COEF, by hand: three masses that slide over a
 * plane.
 *
 * Each mass has a velocity of its own, which friction slows and a steady push turns, so that the
 * local axes of every point turn in every increment. Stick forces are kinematic. Mass 2 is off the
 * plane in increments 4 to 6. Built with USUB_SINGLE it is in single precision.
 *
 * Healthy as well, with VFRICTION: "healthy-calls" (a call for each point), "healthy-threads" (the
 * same, in threads at once). */
#include "common.h"

#include <math.h>
#include <pthread.h>

#ifdef USUB_SINGLE
#define CALL(interface) usub_call_##interface##_f
#else
#define CALL(interface) usub_call_##interface##_d
#endif
typedef usub_real real;

enum { MASSES = 3, STATES = 2, FIELDS = 2, INCREMENTS = 12, STEPS = 2 };

static const real mass = (real)0.01, dt0 = (real)1e-3;

static real velocity[MASSES][3], before[MASSES][3], coord[MASSES][3], state[MASSES][STATES];
static real global[MASSES][3], slip_before[MASSES];
static int touched[MASSES];

/* Arguments of a call, for the points in contact. */
static struct {
  int count, node[MASSES], number[MASSES], main_node[MASSES][4], main_number[4];
  real force[MASSES][2], slip[MASSES][3], stick[MASSES], previous[MASSES][3], normal_force[MASSES];
  real t1[MASSES][3], n[MASSES][3], shape[MASSES][4], area[MASSES], state[MASSES][STATES];
  real coord[MASSES][3], velocity[MASSES][3], main_coord[MASSES][4][3], main_velocity[MASSES][4][3];
  real warm[MASSES], warm_main[MASSES], field[MASSES * FIELDS], field_main[MASSES * FIELDS];
  real rate[MASSES], pressure[MASSES], mu[MASSES], derivative[3 * MASSES];
} at;

static int one = 1, two = 2, three = 3, four = 4, zero, masses = MASSES, states = STATES;
static int fields = FIELDS, step, increment, flags[3];
static real props[1] = {(real)0.2}, times[4], dt, ones[MASSES] = {1, 1, 1};
static char interaction[80], secondary[80], main_surface[80];

static int is_in_contact(int i) {
  return !(i == 1 && increment >= 4 && increment <= 6);
}

/* Local axes of the slip of mass i. */
static void place_axes(int k, int i) {
  const real *v = is("t1-stale") ? before[i] : velocity[i];
  const real size = (real)hypot((double)v[0], (double)v[1]);
  const real sign = is("t1-reversed") ? -1 : 1;
  for (int d = 0; d < 3; ++d) {
    at.n[k][d] = d == 2;
    at.t1[k][d] = d == 2 ? 0 : sign * v[d] / size;
  }
  if (is("axes-length"))
    at.t1[k][0] *= (real)1.5;
  if (is("axes-skew")) {
    at.t1[k][2] = (real)0.6;
    at.t1[k][0] *= (real)0.8;
    at.t1[k][1] *= (real)0.8;
  }
  if (is("axes-exchanged"))
    for (int d = 0; d < 3; ++d) {
      const real kept = at.n[k][d];
      at.n[k][d] = at.t1[k][d];
      at.t1[k][d] = kept;
    }
}

static void place_previous(int k, int i) {
  const real t2[3] = {-at.t1[k][1], at.t1[k][0], 0};
  const real *f = global[i];
  real *to = at.previous[k];
  memset(to, 0, sizeof at.previous[k]);
  if (is("previous-global"))
    memcpy(to, f, sizeof at.previous[k]);
  else
    for (int d = 0; d < 3; ++d) {
      to[0] += f[d] * at.t1[k][d];
      to[1] += f[d] * t2[d];
    }
  const real size = (real)hypot((double)f[0], (double)f[1]);
  if (is("previous-local")) {
    to[0] = -size;
    to[1] = 0;
  }
  if (is("previous-sign")) {
    to[0] = -to[0];
    to[1] = -to[1];
  }
  if (!touched[i] && !is("previous-open"))
    to[0] = to[1] = 0;
}

static void place_point(int k, int i) {
  const real speed = (real)hypot((double)velocity[i][0], (double)velocity[i][1]);
  at.node[k] = (is("nodes-from-zero") ? 0 : is("nodes-global") ? 101 : 1) + i;
  place_axes(k, i);
  memset(at.slip[k], 0, sizeof at.slip[k]);
  at.slip[k][0] = is("slip-negative") ? -speed * dt : speed * dt;
  if (is("slip-vector"))
    for (int d = 0; d < 3; ++d)
      at.slip[k][d] = (real)fabs((double)velocity[i][d]) * dt;
  at.stick[k] = mass * speed / dt;
  if (is("stick-negative"))
    at.stick[k] = -at.stick[k];
  if (is("stick-zero"))
    at.stick[k] = 0;
  if (is("stick-stale"))
    at.stick[k] = slip_before[i] * mass / (dt * dt);
  slip_before[i] = speed * dt;
  place_previous(k, i);
  at.normal_force[k] = (real)(is("normal-negative") ? -1 : 1) * (2 + (real)i);
  for (int m = 0; m < 4; ++m) {
    at.main_node[k][m] = m + 1;
    at.shape[k][m] = (real)(m == 0 ? 0.4 : 0.2);
    at.main_number[m] = 501 + m;
    at.main_coord[k][m][0] = m == 1 || m == 2 ? 10 : -10;
    at.main_coord[k][m][1] = m >= 2 ? 10 : -10;
  }
  memcpy(at.velocity[k], velocity[i], sizeof at.velocity[k]);
  memcpy(at.state[k], state[is("state-mixed") ? (i + 1) % MASSES : i], sizeof at.state[k]);
  memcpy(at.coord[k], coord[i], sizeof at.coord[k]);
  at.area[k] = (real)0.5;
  at.warm[k] = 20;
  at.warm_main[k] = 30;
  at.rate[k] = is("rate-negative") ? -speed : speed;
  at.pressure[k] = at.normal_force[k] / at.area[k];
}

/* All components of a direction one after the other, as if the first index ran slowest. */
static void transpose(void) {
  real kept[MASSES][3];
  memcpy(kept, at.t1, sizeof kept);
  for (int k = 0; k < at.count; ++k)
    for (int d = 0; d < 3; ++d)
      (&at.t1[0][0])[d * at.count + k] = kept[k][d];
  real shape[MASSES][4];
  memcpy(shape, at.shape, sizeof shape);
}

static void place(void) {
  at.count = 0;
  for (int i = 0; i < MASSES; ++i) {
    at.number[i] = 101 + i;
    if (is_in_contact(i))
      place_point(at.count++, i);
  }
  if (is("layout"))
    transpose();
  if (is("shapes-transposed")) {
    real kept[MASSES][4];
    memcpy(kept, at.shape, sizeof kept);
    for (int k = 0; k < at.count; ++k)
      for (int m = 0; m < 4; ++m)
        (&at.shape[0][0])[m * at.count + k] = kept[k][m];
  }
  if (!is("output-kept"))
    memset(at.force, 0, sizeof at.force);
  flags[0] = is("flags-exchanged") ? increment : step;
  flags[1] = is("flags-exchanged") ? step : increment;
}

static void call_vfric(usub_entry entry) {
  void *argv[USUB_VFRIC_COUNT];
  real nodal_area[MASSES] = {(real)0.5, (real)0.5, (real)0.5};
  argv[USUB_VFRIC_FTANGENTIAL] = at.force;
  argv[USUB_VFRIC_STATEV] = state;
  argv[USUB_VFRIC_KSTEP] = &flags[0];
  argv[USUB_VFRIC_KINC] = &flags[1];
  argv[USUB_VFRIC_NCONTACT] = &at.count;
  argv[USUB_VFRIC_NFACNOD] = &four;
  argv[USUB_VFRIC_NSECNOD] = is("nodes-too-few") ? &one : &masses;
  argv[USUB_VFRIC_NMAINNOD] = &four;
  argv[USUB_VFRIC_NFRICDIR] = is("directions") ? &three : &two;
  argv[USUB_VFRIC_NDIR] = &three;
  argv[USUB_VFRIC_NSTATEVAR] = &states;
  argv[USUB_VFRIC_NPROPS] = argv[USUB_VFRIC_NTEMP] = &one;
  argv[USUB_VFRIC_NPRED] = &fields;
  argv[USUB_VFRIC_NUMDEFTFV] = &at.count;
  argv[USUB_VFRIC_JSECUID] = at.number;
  argv[USUB_VFRIC_JMAINUID] = at.main_number;
  argv[USUB_VFRIC_JCONSECID] = at.node;
  argv[USUB_VFRIC_JCONMAINID] = at.main_node;
  argv[USUB_VFRIC_TIMSTEP] = &times[0];
  argv[USUB_VFRIC_TIMGLB] = &times[1];
  argv[USUB_VFRIC_DTIMCUR] = &times[2];
  argv[USUB_VFRIC_SURFINT] = interaction;
  argv[USUB_VFRIC_SURFSEC] = secondary;
  argv[USUB_VFRIC_SURFMAIN] = main_surface;
  argv[USUB_VFRIC_LCONTTYPE] = &zero;
  argv[USUB_VFRIC_DSLIPFRIC] = at.slip;
  argv[USUB_VFRIC_FSTICKFORCE] = at.stick;
  argv[USUB_VFRIC_FTANGPREV] = at.previous;
  argv[USUB_VFRIC_FNORMAL] = at.normal_force;
  argv[USUB_VFRIC_FRICTIONWORK] = &times[3];
  argv[USUB_VFRIC_SHAPE] = at.shape;
  argv[USUB_VFRIC_COORDSEC] = coord;
  argv[USUB_VFRIC_COORDMAIN] = at.main_coord[0];
  argv[USUB_VFRIC_DIRCOSSL] = at.t1;
  argv[USUB_VFRIC_DIRCOSN] = at.n;
  argv[USUB_VFRIC_PROPS] = props;
  argv[USUB_VFRIC_AREASEC] = nodal_area;
  argv[USUB_VFRIC_TEMPSEC] = at.warm;
  argv[USUB_VFRIC_PREDEFSEC] = at.field;
  argv[USUB_VFRIC_TEMPMAIN] = at.warm_main;
  argv[USUB_VFRIC_PREDEFMAIN] = at.field_main;
  CALL(vfric)(entry, argv);
  if (is("state-lost"))
    memset(state, 0, sizeof state);
  if (is("state-mixed")) {
    real kept[STATES];
    memcpy(kept, state[0], sizeof kept);
    memcpy(state[0], state[2], sizeof kept);
    memcpy(state[2], kept, sizeof kept);
  }
}

/* A call for `count` points from `k` on. */
static void call_some(usub_entry entry, int k, int count) {
  void *argv[USUB_VFRICTION_COUNT];
  int number[MASSES], i = 0;
  for (int m = 0; m < MASSES; ++m)
    if (is_in_contact(m))
      number[i++] = is("nodes-from-zero") ? m : 101 + m;
  argv[USUB_VFRICTION_FTANGENTIAL] = at.force + k;
  argv[USUB_VFRICTION_STATE] = at.state + k;
  argv[USUB_VFRICTION_NBLOCK] = argv[USUB_VFRICTION_NBLOCKANAL] = &count;
  argv[USUB_VFRICTION_NBLOCKEDGE] = is("edges") ? &count : &one;
  argv[USUB_VFRICTION_NNODSTATE] = argv[USUB_VFRICTION_NNODSEC] = &one;
  argv[USUB_VFRICTION_NNODMAIN] = &four;
  argv[USUB_VFRICTION_NFRICDIR] = &two;
  argv[USUB_VFRICTION_NDIR] = &three;
  argv[USUB_VFRICTION_NSTATES] = &states;
  argv[USUB_VFRICTION_NPROPS] = argv[USUB_VFRICTION_NTEMP] = &one;
  argv[USUB_VFRICTION_NFIELDS] = &fields;
  argv[USUB_VFRICTION_JFLAGS] = flags;
  argv[USUB_VFRICTION_RDATA] = times;
  argv[USUB_VFRICTION_SURFINT] = interaction;
  argv[USUB_VFRICTION_SURFSEC] = secondary;
  argv[USUB_VFRICTION_SURFMAIN] = main_surface;
  argv[USUB_VFRICTION_JCONSECUID] = number + k;
  argv[USUB_VFRICTION_JCONMAINUID] = at.main_node + k;
  argv[USUB_VFRICTION_PROPS] = props;
  argv[USUB_VFRICTION_DSLIPFRIC] = at.slip + k;
  argv[USUB_VFRICTION_FSTICKFORCE] = at.stick + k;
  argv[USUB_VFRICTION_FTANGPREV] = at.previous + k;
  argv[USUB_VFRICTION_FNORMAL] = at.normal_force + k;
  argv[USUB_VFRICTION_AREACONT] = at.area + k;
  argv[USUB_VFRICTION_DIRCOSN] = at.n + k;
  argv[USUB_VFRICTION_DIRCOSSL] = at.t1 + k;
  argv[USUB_VFRICTION_SHAPESEC] = ones;
  argv[USUB_VFRICTION_SHAPEMAIN] = at.shape + k;
  argv[USUB_VFRICTION_COORDSEC] = at.coord + k;
  argv[USUB_VFRICTION_COORDMAIN] = at.main_coord + k;
  argv[USUB_VFRICTION_VELSEC] = at.velocity + k;
  argv[USUB_VFRICTION_VELMAIN] = at.main_velocity + k;
  argv[USUB_VFRICTION_TEMPSEC] = at.warm + k;
  argv[USUB_VFRICTION_TEMPMAIN] = at.warm_main + k;
  argv[USUB_VFRICTION_FIELDSEC] = at.field + k * FIELDS;
  argv[USUB_VFRICTION_FIELDMAIN] = at.field_main + k * FIELDS;
  CALL(vfriction)(entry, argv);
}

typedef struct work {
  usub_entry entry;
  int point;
} work;

static void *call_one(void *context) {
  const work *w = context;
  call_some(w->entry, w->point, 1);
  return NULL;
}

static void call_vfriction(usub_entry entry) {
  pthread_t threads[MASSES];
  work works[MASSES];
  if (!is("healthy-calls") && !is("healthy-threads"))
    call_some(entry, 0, at.count);
  for (int k = 0; k < at.count; ++k) {
    works[k] = (work){entry, k};
    if (is("healthy-calls"))
      call_one(&works[k]);
    if (is("healthy-threads"))
      pthread_create(&threads[k], NULL, call_one, &works[k]);
  }
  for (int k = 0; k < at.count && is("healthy-threads"); ++k)
    pthread_join(threads[k], NULL);
  for (int m = 0, k = 0; m < MASSES; ++m)
    if (is_in_contact(m) && !is("state-lost"))
      memcpy(state[m], at.state[k++], sizeof state[m]);
}

static void call_vfric_coef(usub_entry entry) {
  void *argv[USUB_VFRIC_COEF_COUNT];
  argv[USUB_VFRIC_COEF_FCOEF] = at.mu;
  argv[USUB_VFRIC_COEF_FCOEFDERIV] = is("derivative-null") ? NULL : at.derivative;
  argv[USUB_VFRIC_COEF_NBLOCK] = &at.count;
  argv[USUB_VFRIC_COEF_NPROPS] = argv[USUB_VFRIC_COEF_NTEMP] = &one;
  argv[USUB_VFRIC_COEF_NFIELDS] = &fields;
  argv[USUB_VFRIC_COEF_JFLAGS] = flags;
  argv[USUB_VFRIC_COEF_RDATA] = times;
  argv[USUB_VFRIC_COEF_SURFINT] = interaction;
  argv[USUB_VFRIC_COEF_SURFSEC] = secondary;
  argv[USUB_VFRIC_COEF_SURFMAIN] = main_surface;
  argv[USUB_VFRIC_COEF_PROPS] = props;
  argv[USUB_VFRIC_COEF_SLIPRATE] = at.rate;
  argv[USUB_VFRIC_COEF_PRESSURE] = at.pressure;
  argv[USUB_VFRIC_COEF_TEMPAVG] = at.warm;
  argv[USUB_VFRIC_COEF_FIELDAVG] = at.field;
  CALL(vfric_coef)(entry, argv);
  for (int k = 0; k < at.count; ++k) {
    const real most = at.mu[k] * at.normal_force[k];
    at.force[k][0] = -(most < at.stick[k] ? most : at.stick[k]);
  }
}

/* Friction slows, a steady push across turns; kept are the forces in global components. */
static void move(void) {
  memcpy(before, velocity, sizeof before);
  for (int i = 0, k = 0; i < MASSES; ++i) {
    touched[i] = is_in_contact(i);
    memset(global[i], 0, sizeof global[i]);
    if (is_in_contact(i)) {
      const real *t1 = at.t1[k], t2[3] = {-t1[1], t1[0], 0};
      for (int d = 0; d < 3; ++d)
        global[i][d] = at.force[k][0] * t1[d] + at.force[k][1] * t2[d];
      ++k;
    } else if (is("previous-open")) {
      global[i][0] = -1;
    }
    const real turn = (real)(0.1 + 0.03 * i + 0.01 * increment);
    const real x = velocity[i][0] + global[i][0] / mass * dt;
    const real y = velocity[i][1] + global[i][1] / mass * dt;
    velocity[i][0] = x * (real)cos(turn) - y * (real)sin(turn);
    velocity[i][1] = x * (real)sin(turn) + y * (real)cos(turn);
    for (int d = 0; d < 3; ++d)
      coord[i][d] += before[i][d] * dt;
  }
}

int main(int count, char **arguments) {
  if (count < 4)
    return 2;
  fault = arguments[3];
  usub_entry entry = entry_of(arguments[1], arguments[2]);
  name(interaction, "RUBBER ON STEEL");
  name(secondary, "TREAD");
  name(main_surface, "ROAD");
  if (is("lengths"))
    name_length = 0;
  for (int i = 0; i < MASSES; ++i) {
    velocity[i][0] = (real)(5 + i);
    velocity[i][1] = (real)(1 - i);
    coord[i][0] = (real)i;
    at.field[i] = (real)(i + 1);
    before[i][0] = 1;
    slip_before[i] = (real)1e-3;
  }
  double time = 0;
  for (step = 1; step <= STEPS; ++step) {
    double start = time;
    for (increment = 1; increment <= INCREMENTS; ++increment) {
      dt = dt0 * (real)(1 + 0.05 * increment);
      time += (double)dt;
      times[0] = (real)(is("time-start") ? time - start - (double)dt : time - start);
      times[1] = (real)(is("time-start") ? time - (double)dt : time);
      times[2] = is("dt-zero") ? 0 : is("dt-before") ? dt0 : dt;
      place();
      if (strcmp(arguments[2], "vfric") == 0)
        call_vfric(entry);
      else if (strcmp(arguments[2], "vfriction") == 0)
        call_vfriction(entry);
      else
        call_vfric_coef(entry);
      move();
    }
  }
  misbehave();
  return 0;
}
