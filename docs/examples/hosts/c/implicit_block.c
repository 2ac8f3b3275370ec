/* SPDX-License-Identifier: MIT */
/* An implicit host in C: the block of explicit_block.c in two dimensions, by backward Euler and
 * Newton's method with the consistent tangent.
 *
 *     implicit_block LIBRARY INTERFACE [PROPERTY ...]
 *
 * INTERFACE is fric (the routine gives stress and tangent) or fric_coef (it gives a coefficient,
 * and the driver enforces it). Both stick elastically, over an allowable elastic slip of .005 times
 * the characteristic length; it is tiny here, for a block that stops nearly at once.
 *
 *     cc implicit_block.c -o implicit_block $(pkg-config --cflags --libs usersub) -lm
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <usersub/usersub.h>

enum { POINTS = 5, MOST_PROPS = 20, MOST_INCREMENTS = 100000, MOST_ITERATIONS = 20 };

static const double mass = 7.3e-4 * POINTS, contact_pressure = 2000.0, start_speed = 200.0;
static const double area = 1.0; /* of a point */

/* What the host keeps at its contact points; there is one friction direction in two dimensions. */
static double slip_increment[POINTS], pressure[POINTS], tau[POINTS], ddtddg[POINTS];
static int32_t lm[POINTS];

/* All that a host has to do about errors: stop at the first negative status and show the message.
 */
static int32_t check(int32_t status, const char *message) {
  if (status < 0) {
    fprintf(stderr, "%s: %s\n", usub_status_name(status), message);
    exit(EXIT_FAILURE);
  }
  return status;
}

static usub_scene *make_scene(const double *props, int32_t count) {
  usub_scene *scene;
  check(usub_scene_create(&scene), "no scene");
  check(usub_scene_set_int(scene, "points", POINTS), usub_scene_message(scene));
  check(usub_scene_set_int(scene, "dimension", 2), usub_scene_message(scene));
  /* The routine behind fric keeps its elastic slip; one that keeps more says so in its manual. */
  check(usub_scene_set_int(scene, "states", 1), usub_scene_message(scene));
  check(usub_scene_set_real(scene, "characteristic_length", 1e-8), usub_scene_message(scene));
  check(usub_scene_set_props(scene, props, count), usub_scene_message(scene));
  return scene;
}

static usub_driver *make_driver(const usub_routine *routine, const usub_scene *scene) {
  usub_error error;
  usub_driver *driver;
  check(usub_driver_create("standard", routine, scene, &driver, &error), error.message);
  check(usub_bind(driver, "slip_increment", slip_increment, POINTS), usub_message(driver));
  check(usub_bind(driver, "pressure", pressure, POINTS), usub_message(driver));
  check(usub_bind(driver, "tau", tau, POINTS), usub_message(driver));
  check(usub_bind(driver, "ddtddg", ddtddg, POINTS), usub_message(driver));
  check(usub_bind(driver, "lm", lm, POINTS), usub_message(driver));
  return driver;
}

/* Newton's method for the speed at the end of an increment that begins with `before`:
 * mass (speed - before) / dt + area tau(speed dt) = 0, summed over the points.
 * Returns 1 if the increment is too long, for the routine or for Newton's method. */
static int solve(usub_driver *driver, double before, double dt, double *speed) {
  *speed = before;
  for (int iteration = 0; iteration < MOST_ITERATIONS; iteration++) {
    for (int i = 0; i < POINTS; i++)
      slip_increment[i] = *speed * dt;
    if (check(usub_iterate(driver), usub_message(driver)) == USUB_CUT_BACK)
      return 1;
    double residual = mass * (*speed - before) / dt, tangent = mass / dt;
    for (int i = 0; i < POINTS; i++) {
      if (lm[i] == 1)
        check(USUB_NOT_SUPPORTED, "LM = 1, but this host has no Lagrange multipliers");
      residual += area * tau[i];
      tangent += area * ddtddg[i] * dt;
    }
    if (fabs(residual) <= 1e-12 * mass * start_speed / dt)
      return 0;
    *speed -= residual / tangent;
  }
  return 1;
}

int main(int count, char **arguments) {
  double props[MOST_PROPS] = {0.15};
  if (count < 3 || count > 3 + MOST_PROPS)
    check(USUB_BAD_ARGUMENT, "usage: implicit_block LIBRARY INTERFACE [PROPERTY ...]");
  for (int i = 3; i < count; i++)
    props[i - 3] = strtod(arguments[i], NULL);

  usub_error error;
  usub_routine *routine;
  check(usub_routine_open(arguments[1], arguments[2], NULL, "double", &routine, &error),
        error.message);
  usub_scene *scene = make_scene(props, count > 3 ? count - 3 : 1);
  usub_driver *driver = make_driver(routine, scene);
  for (int i = 0; i < POINTS; i++)
    pressure[i] = contact_pressure;

  const double closing = 1e-6;
  double time = closing, distance = 0, speed = start_speed, after, deceleration = 0, dt = 1e-6;
  /* The first increment closes the contact, at rest: a point that was open has no friction yet. */
  check(usub_set_time(driver, 1, 1, closing, closing, closing), usub_message(driver));
  check(usub_begin_increment(driver), usub_message(driver));
  check(usub_iterate(driver), usub_message(driver));
  check(usub_commit(driver), usub_message(driver));

  for (int32_t increment = 2; increment <= MOST_INCREMENTS; increment++) {
    check(usub_set_time(driver, 1, increment, time + dt, time + dt, dt), usub_message(driver));
    check(usub_begin_increment(driver), usub_message(driver));
    if (solve(driver, speed, dt, &after)) { /* as if this increment had never been tried */
      check(usub_cut_back(driver), usub_message(driver));
      dt *= fmin(usub_pnewdt(driver), 0.5);
      if (dt < 1e-12)
        check(USUB_BAD_INPUT, "the time increment has become too small");
      increment--;
      continue;
    }
    if (after <= 1e-6 * start_speed)
      break; /* sticks: it stops within this increment */
    check(usub_commit(driver), usub_message(driver));
    deceleration = (speed - after) / dt;
    distance += 0.5 * (speed + after) * dt;
    time += dt;
    speed = after;
  }
  /* The rest of the way, at the deceleration of the last full increment. */
  printf("host=c interface=%s stop_time=%.16e stop_distance=%.16e\n", arguments[2],
         time - closing + speed / deceleration, distance + 0.5 * speed * speed / deceleration);

  usub_driver_free(driver);
  usub_scene_free(scene);
  usub_routine_free(routine);
  return EXIT_SUCCESS;
}
