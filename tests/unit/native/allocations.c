/* SPDX-License-Identifier: MIT */
/* A host of VFRIC_COEF that counts the allocations of its steps: default, kinematic, penalty. */
#include <stdio.h>
#include <string.h>

#include "usersub/usersub.h"

extern void *__libc_malloc(size_t size);
static long allocations;

/* Every malloc of the process comes by here. */
void *malloc(size_t size) {
  ++allocations;
  return __libc_malloc(size);
}

static void law(double *coefficient, double *derivative, const int32_t *points) {
  (void)derivative;
  for (int32_t k = 0; k < *points; ++k)
    coefficient[k] = 0.3;
}

enum { POINTS = 700, STEPS = 100 };

/* Steps of one enforcement; the first may allocate. */
static int run(const char *enforcement) {
  static double slip[3 * POINTS], normal[3 * POINTS], force[POINTS], other[POINTS];
  usub_routine *routine;
  usub_scene *scene;
  usub_driver *driver;
  if (usub_routine_create("vfric_coef", NULL, "double", 0, (usub_entry)law, &routine, NULL) ||
      usub_scene_create(&scene) || usub_scene_set_int(scene, "points", POINTS) ||
      usub_scene_set_int(scene, "dissipation", 1) ||
      usub_scene_set_text(scene, "enforcement", enforcement))
    return 1;
  const int penalty = strcmp(enforcement, "penalty") == 0;
  if (penalty && (usub_scene_set_real(scene, "stick_slope", 50.0) ||
                  usub_scene_set_real(scene, "damping", 0.1)))
    return 1;
  if (usub_driver_create("explicit", routine, scene, &driver, NULL))
    return 1;
  for (int i = 0; i < POINTS; ++i) {
    slip[3 * i] = 1e-3 * (i - 350);
    normal[3 * i + 2] = 1.0;
    force[i] = other[i] = 1.0;
  }
  usub_bind(driver, "slip_increment", slip, 3 * POINTS);
  usub_bind(driver, "normal", normal, 3 * POINTS);
  usub_bind(driver, "normal_force", force, POINTS);
  if (!penalty)
    usub_bind(driver, strcmp(enforcement, "default") ? "mass" : "stick_force", other, POINTS);
  for (int i = 0; i <= STEPS; ++i) {
    if (i == 1)
      allocations = 0;
    if (usub_set_time(driver, 1, i + 1, 0.1 * i, 0.1 * i, 0.1) || usub_step(driver)) {
      printf("%s\n", usub_message(driver));
      return 1;
    }
  }
  const long counted = allocations;
  usub_driver_free(driver);
  usub_scene_free(scene);
  usub_routine_free(routine);
  return (int)counted * 2;
}

int main(void) {
  const int found = run("default") | run("kinematic") | run("penalty");
  printf("%d allocations in %d steps\n", found, 3 * STEPS);
  return found != 0;
}
