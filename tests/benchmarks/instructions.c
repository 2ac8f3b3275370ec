/* SPDX-License-Identifier: MIT */
/* Calls drivers a fixed number of times; `measured` is what instructions are counted in. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <usersub/abi.h>
#include <usersub/usersub.h>

enum { MOST = 4096 };

static double slip[3 * MOST], normal[3 * MOST], force[MOST], stick[MOST], rate[MOST];

static void must(int status, const char *what) {
  if (status < 0) {
    fprintf(stderr, "%s: status %d\n", what, status);
    exit(1);
  }
}

/* Laws without functions of the C library, whose code differs from machine to machine. */
static int coefficient(void **argv) {
  double *mu = argv[0];
  const double *slip_rate = argv[USUB_VFRIC_COEF_SLIPRATE];
  const int n = *(const int *)argv[USUB_VFRIC_COEF_NBLOCK];
  for (int k = 0; k < n; ++k)
    mu[k] = 0.3 / (1 + slip_rate[k]);
  return 0;
}

static int friction(void **argv) {
  double *tangential = argv[0];
  const double *fn = argv[USUB_VFRICTION_FNORMAL], *most = argv[USUB_VFRICTION_FSTICKFORCE];
  const int n = *(const int *)argv[USUB_VFRICTION_NBLOCK];
  const int directions = *(const int *)argv[USUB_VFRICTION_NFRICDIR];
  for (int k = 0; k < n; ++k)
    tangential[directions * k] = -(0.3 * fn[k] < most[k] ? 0.3 * fn[k] : most[k]);
  return 0;
}

static int fric(void **argv) {
  double *tau = argv[USUB_FRIC_TAU], *by_slip = argv[USUB_FRIC_DDTDDG];
  const double *dgam = argv[USUB_FRIC_DGAM], p = *(const double *)argv[USUB_FRIC_PRESS];
  *(int *)argv[USUB_FRIC_LM] = 0;
  tau[0] = p * dgam[0], tau[1] = p * dgam[1];
  by_slip[0] = by_slip[3] = p;
  return 0;
}

static usub_driver *make(const char *interface, const char *kind, void *entry, int points,
                         const int *used, int count) {
  usub_error error;
  usub_routine *routine;
  usub_scene *scene;
  usub_driver *driver;
  unsigned char uses[64] = {0};
  for (int i = 0; i < count; ++i)
    uses[used[i]] = 3;
  usub_entry address;
  memcpy(&address, &entry, sizeof address);
  must(usub_routine_create(interface, NULL, "double", USUB_STYLE_BLOCK, address, &routine, &error),
       "routine");
  const int arguments = strcmp(interface, "fric") == 0        ? USUB_FRIC_COUNT
                        : strcmp(interface, "vfriction") == 0 ? USUB_VFRICTION_COUNT
                                                              : USUB_VFRIC_COEF_COUNT;
  must(usub_routine_set_uses(routine, uses, arguments), "uses");
  must(usub_routine_set_flag(routine, "thread_safe", 1), "flag");
  must(usub_scene_create(&scene), "scene");
  must(usub_scene_set_int(scene, "points", points), "points");
  must(usub_scene_set_int(scene, "dimension", 3), "dimension");
  must(usub_driver_create(kind, routine, scene, &driver, &error), "driver");
  must(usub_set_time(driver, 1, 1, 1e-3, 1e-3, 1e-3), "time");
  return driver;
}

static void bind(usub_driver *driver, const char *name, double *data, int count) {
  must(usub_bind(driver, name, data, (size_t)count), usub_message(driver));
}

typedef int (*call)(usub_driver *);

__attribute__((noinline)) void measured(call function, usub_driver *driver, int times) {
  for (int i = 0; i < times; ++i)
    must(function(driver), "call");
}

int main(int argc, char **argv) {
  const char *name = argc > 1 ? argv[1] : "";
  const int points = strstr(name, "one point") ? 1 : MOST, times = points == 1 ? 1000 : 4;
  for (int i = 0; i < MOST; ++i) {
    slip[3 * i] = 1e-3 * (i % 7 + 1), slip[3 * i + 1] = 2e-3 * (i % 5 - 2);
    normal[3 * i + 2] = 1;
    force[i] = 1 + i % 3, stick[i] = 0.5, rate[i] = i % 11;
  }
  usub_driver *driver;
  call function;
  if (strncmp(name, "VFRIC_COEF", 10) == 0) {
    const int used[] = {0, USUB_VFRIC_COEF_SLIPRATE, USUB_VFRIC_COEF_NBLOCK};
    driver = make("vfric_coef", "coefficient", (void *)coefficient, points, used, 3);
    bind(driver, "slip_rate", rate, points);
    bind(driver, "pressure", force, points);
    function = usub_evaluate;
  } else if (strncmp(name, "VFRICTION", 9) == 0) {
    const int used[] = {0, USUB_VFRICTION_FNORMAL, USUB_VFRICTION_FSTICKFORCE,
                        USUB_VFRICTION_NBLOCK, USUB_VFRICTION_NFRICDIR};
    driver = make("vfriction", "explicit", (void *)friction, points, used, 5);
    bind(driver, "slip_increment", slip, 3 * points);
    bind(driver, "normal", normal, 3 * points);
    bind(driver, "normal_force", force, points);
    bind(driver, "stick_force", stick, points);
    function = usub_step;
  } else {
    const int used[] = {USUB_FRIC_LM, USUB_FRIC_TAU, USUB_FRIC_DDTDDG, USUB_FRIC_DGAM,
                        USUB_FRIC_PRESS};
    driver = make("fric", "standard", (void *)fric, points, used, 5);
    bind(driver, "slip_increment", slip, 2 * points);
    bind(driver, "pressure", force, points);
    must(usub_begin_increment(driver), "begin");
    function = usub_iterate;
  }
  must(function(driver), usub_message(driver));
  measured(function, driver, times);
  return 0;
}
