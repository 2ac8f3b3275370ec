/* SPDX-License-Identifier: MIT */
/* An explicit host in C: a rigid block slides on a rigid plane until friction stops it.
 *
 *     explicit_block LIBRARY INTERFACE [PROPERTY ...]
 *
 * LIBRARY is a shared library with the user's routine, INTERFACE is vfric, vfriction or vfric_coef.
 * The block is 5 in x 1 in x 1 in, of density 7.3e-4 lb s^2/in^4, under a pressure of 2000 psi, and
 * starts at 200 in/s. It rests on five contact points of 1 in^2 each.
 *
 * Built against an installed usersub with CMake (see ../CMakeLists.txt), or in one line:
 *     cc explicit_block.c -o explicit_block $(pkg-config --cflags --libs usersub)
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <usersub/usersub.h>

enum { POINTS = 5, MOST_PROPS = 20, MOST_INCREMENTS = 100000 };
static const double density = 7.3e-4, volume = 5.0, contact_pressure = 2000.0, start_speed = 200.0;
static const double time_increment = 1.0e-6;

/* All that a host has to do about errors: stop at the first negative status and show the message.
 */
static void check(int32_t status, const char *message) {
  if (status >= 0)
    return;
  fprintf(stderr, "%s: %s\n", usub_status_name(status), message);
  exit(EXIT_FAILURE);
}

/* 1. A routine: user code behind one interface. */
static usub_routine *open_routine(const char *library, const char *interface) {
  usub_error error;
  usub_routine *routine;
  check(usub_check_abi(USUB_ABI_HASH, &error), error.message); /* header and library fit */
  check(usub_routine_open(library, interface, NULL, "double", &routine, &error), error.message);
  return routine;
}

/* 2. A scene: what this host has. Whatever it does not mention, it does not have. */
static usub_scene *make_scene(const double *props, int32_t count) {
  usub_scene *scene;
  check(usub_scene_create(&scene), "no scene");
  check(usub_scene_set_int(scene, "points", POINTS), usub_scene_message(scene));
  check(usub_scene_set_text(scene, "contact", "analytical-rigid"), usub_scene_message(scene));
  check(usub_scene_set_int(scene, "secondary_nodes", POINTS), usub_scene_message(scene));
  check(usub_scene_set_int(scene, "nodes", POINTS), usub_scene_message(scene));
  check(usub_scene_set_props(scene, props, count), usub_scene_message(scene));
  return scene;
}

/* What the host keeps at its contact points; vectors have three components a point. */
static struct {
  double slip_increment[POINTS][3], velocity[POINTS][3], normal[POINTS][3], coord[POINTS][3];
  double normal_force[POINTS], stick_force[POINTS], mass[POINTS], area[POINTS];
  double force[POINTS][3];
  int32_t node[POINTS];
} at;

static void place_points(void) {
  for (int i = 0; i < POINTS; i++) {
    at.normal[i][2] = 1.0;
    at.area[i] = volume / POINTS; /* the block is 1 in high */
    at.normal_force[i] = contact_pressure * at.area[i];
    at.mass[i] = density * volume / POINTS;
    at.node[i] = i + 1;
  }
}

/* 3. A driver: the routine in the scene. Arrays are bound once and read in every step. */
static usub_driver *make_driver(const usub_routine *routine, const usub_scene *scene,
                                const char *interface) {
  usub_error error;
  usub_driver *driver;
  check(usub_driver_create("explicit", routine, scene, &driver, &error), error.message);
  const struct {
    const char *name;
    void *data;
    size_t count;
  } arrays[] = {{"slip_increment", at.slip_increment, 3 * POINTS},
                {"normal", at.normal, 3 * POINTS},
                {"normal_force", at.normal_force, POINTS},
                {"stick_force", at.stick_force, POINTS},
                {"area", at.area, POINTS},
                {"secondary_node", at.node, POINTS},
                {"force", at.force, 3 * POINTS}};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
    check(usub_bind(driver, arrays[i].name, arrays[i].data, arrays[i].count), usub_message(driver));
  if (strcmp(interface, "vfric") == 0)
    check(usub_bind(driver, "coord_secondary", at.coord, 3 * POINTS), usub_message(driver));
  if (strcmp(interface, "vfriction") == 0) {
    check(usub_bind(driver, "coord", at.coord, 3 * POINTS), usub_message(driver));
    check(usub_bind(driver, "velocity", at.velocity, 3 * POINTS), usub_message(driver));
  }
  return driver;
}

/* 4. Increments: predict the slip, ask for the forces. Returns the force on the block. */
static double step(usub_driver *driver, int32_t increment, double speed, double distance) {
  const double time = increment * time_increment; /* at the end of the increment */
  for (int i = 0; i < POINTS; i++) {
    at.coord[i][0] = 0.5 + i + distance;
    at.velocity[i][0] = speed;
    at.slip_increment[i][0] = speed * time_increment; /* without friction */
  }
  check(usub_stick_force_kinematic(POINTS, 3, at.velocity[0], at.normal[0], at.mass, time_increment,
                                   at.stick_force),
        "stick force");
  check(usub_set_time(driver, 1, increment, time, time, time_increment), usub_message(driver));
  check(usub_step(driver), usub_message(driver));
  double force = 0;
  for (int i = 0; i < POINTS; i++)
    force += at.force[i][0];
  return force;
}

int main(int count, char **arguments) {
  double props[MOST_PROPS] = {0.15};
  if (count < 3 || count > 3 + MOST_PROPS)
    check(USUB_BAD_ARGUMENT, "usage: explicit_block LIBRARY INTERFACE [PROPERTY ...]");
  for (int i = 3; i < count; i++)
    props[i - 3] = strtod(arguments[i], NULL);

  place_points();
  usub_routine *routine = open_routine(arguments[1], arguments[2]);
  usub_scene *scene = make_scene(props, count > 3 ? count - 3 : 1);
  usub_driver *driver = make_driver(routine, scene, arguments[2]);

  double time = 0, distance = 0, speed = start_speed, deceleration = 0;
  for (int32_t increment = 1; increment <= MOST_INCREMENTS; increment++) {
    const double force = step(driver, increment, speed, distance);
    const double change = -force / (density * volume) * time_increment;
    /* The stick force bounds the friction: it stops the block within this increment. */
    if (speed - change <= 1e-9 * start_speed)
      break;
    distance += (speed - 0.5 * change) * time_increment;
    time += time_increment;
    speed -= change;
    deceleration = change / time_increment;
  }
  /* The rest of the way, at the deceleration of the last full increment. */
  printf("host=c interface=%s stop_time=%.16e stop_distance=%.16e\n", arguments[2],
         time + speed / deceleration, distance + 0.5 * speed * speed / deceleration);

  usub_driver_free(driver);
  usub_scene_free(scene);
  usub_routine_free(routine);
  return EXIT_SUCCESS;
}
