// SPDX-License-Identifier: MIT
// An explicit host in C++: a rigid block slides on a rigid plane until friction stops it.
//
//     explicit_block_cpp LIBRARY INTERFACE [PROPERTY ...]
//
// LIBRARY is a shared library with the user's routine, INTERFACE is vfric, vfriction or vfric_coef.
// The block is 5 in x 1 in x 1 in, of density 7.3e-4 lb s^2/in^4, under a pressure of 2000 psi, and
// starts at 200 in/s. It rests on contact points of 1 in^2 each.
//
// Built with CMake (see ../CMakeLists.txt), or in one line:
//     c++ -std=c++17 explicit_block.cpp -o explicit_block_cpp $(pkg-config --cflags --libs usersub)
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <usersub/usersub.h>

// Negative statuses become exceptions, in the host: none may pass through the library.
static void check(int32_t status, const char *message) {
  if (status < 0)
    throw std::runtime_error(std::string(usub_status_name(status)) + ": " + message);
}

// Handles that free themselves; members of this type stand in the order routine, scene, driver.
struct Free {
  void operator()(usub_routine *routine) const { usub_routine_free(routine); }
  void operator()(usub_scene *scene) const { usub_scene_free(scene); }
  void operator()(usub_driver *driver) const { usub_driver_free(driver); }
};
template <class Handle> using Owned = std::unique_ptr<Handle, Free>;

// What the host keeps at its contact points; vectors have three components a point.
struct Points {
  explicit Points(int n)
      : slip_increment(3 * n), velocity(3 * n), normal(3 * n), coord(3 * n), force(3 * n),
        normal_force(n), stick_force(n), mass(n), area(n), node(n) {}
  int32_t count() const { return static_cast<int32_t>(node.size()); }
  std::vector<double> slip_increment, velocity, normal, coord, force, normal_force, stick_force;
  std::vector<double> mass, area;
  std::vector<int32_t> node;
};

// A routine in a scene, with the arrays of the host bound to it.
struct Contact {
  Contact(const char *library, std::string interface, std::vector<double> props, Points &points)
      : points_(points) {
    usub_error error;
    usub_routine *routine;
    check(usub_check_abi(USUB_ABI_HASH, &error), error.message); // header and library fit
    check(usub_routine_open(library, interface.c_str(), nullptr, "double", &routine, &error),
          error.message);
    routine_.reset(routine);
    // The scene says what this host has. Whatever it does not mention, it does not have.
    usub_scene *scene;
    check(usub_scene_create(&scene), "no scene");
    scene_.reset(scene);
    for (const char *key : {"points", "secondary_nodes", "nodes"})
      check(usub_scene_set_int(scene, key, points.count()), usub_scene_message(scene));
    check(usub_scene_set_text(scene, "contact", "analytical-rigid"), usub_scene_message(scene));
    check(usub_scene_set_props(scene, props.data(), int32_t(props.size())),
          usub_scene_message(scene));
    usub_driver *driver;
    check(usub_driver_create("explicit", routine, scene, &driver, &error), error.message);
    driver_.reset(driver);
    bind("slip_increment", points.slip_increment);
    bind("normal", points.normal);
    bind("normal_force", points.normal_force);
    bind("stick_force", points.stick_force);
    bind("area", points.area);
    bind("secondary_node", points.node);
    bind("force", points.force);
    if (interface == "vfric")
      bind("coord_secondary", points.coord);
    if (interface == "vfriction")
      bind("coord", points.coord), bind("velocity", points.velocity);
  }

  // Friction force of one increment, summed over the points.
  double force(int32_t increment, double dt) {
    Points &at = points_;
    check(usub_stick_force_kinematic(at.count(), 3, at.velocity.data(), at.normal.data(),
                                     at.mass.data(), dt, at.stick_force.data()),
          "stick force");
    check(usub_set_time(driver_.get(), 1, increment, increment * dt, increment * dt, dt),
          message());
    check(usub_step(driver_.get()), message());
    double sum = 0;
    for (int32_t i = 0; i < at.count(); ++i)
      sum += at.force[3 * i];
    return sum;
  }

private:
  // The vectors must not be resized while they are bound.
  template <class Number> void bind(const char *array, std::vector<Number> &data) {
    check(usub_bind(driver_.get(), array, data.data(), data.size()), message());
  }
  const char *message() const { return usub_message(driver_.get()); }
  Points &points_;
  Owned<usub_routine> routine_;
  Owned<usub_scene> scene_;
  Owned<usub_driver> driver_;
};

static void run(const char *library, const char *interface, const std::vector<double> &props) {
  Points points(5);
  const double mass = 7.3e-4 * points.count(), start_speed = 200, dt = 1e-6;
  for (int32_t i = 0; i < points.count(); ++i) {
    points.normal[3 * i + 2] = 1;
    points.area[i] = 1;
    points.normal_force[i] = 2000 * points.area[i];
    points.mass[i] = mass / points.count();
    points.node[i] = i + 1;
  }
  Contact contact(library, interface, props, points);
  double time = 0, distance = 0, speed = start_speed, deceleration = 0;
  for (int32_t increment = 1; increment <= 100000; ++increment) {
    for (int32_t i = 0; i < points.count(); ++i) {
      points.coord[3 * i] = 0.5 + i + distance;
      points.velocity[3 * i] = speed;
      points.slip_increment[3 * i] = speed * dt; // without friction
    }
    const double change = -contact.force(increment, dt) / mass * dt;
    if (speed - change <= 1e-9 * start_speed)
      break; // bounded by the stick force, it stops within this increment
    distance += (speed - change / 2) * dt;
    time += dt;
    speed -= change;
    deceleration = change / dt;
  }
  // The rest of the way, at the deceleration of the last full increment.
  std::printf("host=cpp interface=%s stop_time=%.16e stop_distance=%.16e\n", interface,
              time + speed / deceleration, distance + speed * speed / (2 * deceleration));
}

int main(int count, char **arguments) try {
  if (count < 3)
    throw std::runtime_error("usage: LIBRARY INTERFACE [PROPERTY ...]");
  std::vector<double> props(count > 3 ? count - 3 : 1, 0.15);
  for (int i = 3; i < count; ++i)
    props[i - 3] = std::strtod(arguments[i], nullptr);
  run(arguments[1], arguments[2], props);
  return EXIT_SUCCESS;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return EXIT_FAILURE;
}
