/* SPDX-License-Identifier: MIT */
/* Drives every kind of driver with arrays of exactly their size and routines that read and write
 * every element, for a build with the address and undefined-behaviour sanitizers (and valgrind).
 * Ends with 0 and "ok" if every call answered as expected. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "usersub/usersub.h"

#define CHECK(what)                                                                                \
  do {                                                                                             \
    if (!(what)) {                                                                                 \
      fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #what);                                   \
      exit(1);                                                                                     \
    }                                                                                              \
  } while (0)

enum { POINTS = 11, SECONDARY = 13, MAIN = 17, NODES = 19, FIELDS = 2, STATES = 3 };

static _Thread_local volatile double sum; /* so that no read is optimised away */
static int32_t broken; /* what the routines do wrong: 1 NaN, 2 exception, 3 XIT, 4 exit */

static int32_t single;
static int32_t checked; /* the routines are called in guarded memory */
static int32_t skips;   /* every seventh point is open, and left out of the blocks */

static void read_all(const void *data, int32_t count) {
  double total = 0;
  for (int32_t i = 0; i < count; ++i)
    total += single ? (double)((const float *)data)[i] : ((const double *)data)[i];
  sum = total;
}

static void read_ints(const void *data, int32_t count) {
  int64_t total = 0;
  for (int32_t i = 0; i < count; ++i)
    total += ((const int32_t *)data)[i];
  sum = (double)total;
}

static void write_all(void *data, int32_t count, double value) {
  for (int32_t i = 0; i < count; ++i) {
    if (single)
      ((float *)data)[i] = (float)value;
    else
      ((double *)data)[i] = value;
  }
}

static int32_t at(void *const *argv, int32_t position) {
  return *(const int32_t *)argv[position];
}

void xit_(void);

static int32_t end(void *output, int32_t count) {
  if (broken == 1)
    write_all(output, count, NAN);
  if (broken == 3)
    xit_();
  return broken == 2 ? USUB_ROUTINE_RAISED : 0;
}

static int32_t fric(void **a) {
  const int32_t f = at(a, 32), d = at(a, 33), p = at(a, 34), s = at(a, 35), props = at(a, 38);
  const int32_t reals[][2] = {{1, f},  {4, f},  {5, 1},  {8, 1},      {9, s},  {10, f},    {11, f},
                              {12, 1}, {13, 1}, {14, 1}, {15, f},     {18, 2}, {19, 1},    {27, d},
                              {28, d}, {29, 4}, {30, 2}, {31, 2 * p}, {36, 1}, {37, props}};
  for (size_t i = 0; i < sizeof reals / sizeof reals[0]; ++i)
    read_all(a[reals[i][0]], reals[i][1]);
  *(int32_t *)a[0] = (int32_t)(at(a, 25) % 3);
  write_all(a[1], f, 1);
  write_all(a[2], f * f, 2);
  write_all(a[3], f, 3);
  write_all(a[4], f, 4);
  write_all(a[7], 2 * f, 5);
  write_all(a[9], s, 6);
  return end(a[1], f);
}

/* The 2022 layout and, where `columns` is 1, the legacy one. */
static int32_t coefficient(void **a, int32_t columns, int32_t slots, int32_t numbers) {
  const int32_t n = at(a, 2), props = at(a, 3), fields = at(a, 5);
  read_ints(a[6], columns == 1 ? 2 : 6);
  read_all(a[7], numbers);
  read_all(a[11], props);
  read_all(a[12], n * (columns == 1 ? 1 : 6));
  read_all(a[13], n);
  read_all(a[14], n);
  read_all(a[15], n * fields);
  write_all(a[0], n, 0.25);
  write_all(a[1], n * slots, 0.125);
  return end(a[0], n);
}

static int32_t legacy(void **a) {
  return coefficient(a, 1, 3, 3);
}
static int32_t modern(void **a) {
  const int32_t states = ((const int32_t *)a[6])[4];
  write_all((char *)a[7] + 7 * sizeof(double), states, 1.5);
  return coefficient(a, 2, 40, 7 + states);
}

static int32_t vfric(void **a) {
  const int32_t n = at(a, 4), m = at(a, 5), x = at(a, 6), y = at(a, 7), f = at(a, 8), d = at(a, 9);
  const int32_t s = at(a, 10), props = at(a, 11), p = at(a, 13), t = at(a, 14);
  const int32_t ints[][2] = {{15, x}, {16, y}, {17, n}, {18, m * n}};
  const int32_t reals[][2] = {{19, 1},     {20, 1},     {21, 1},     {26, d * n}, {27, n},
                              {28, d * n}, {29, n},     {30, 1},     {31, m * n}, {32, d * x},
                              {33, d * y}, {34, d * n}, {35, d * n}, {36, props}, {37, x},
                              {38, n},     {39, n * p}, {40, t},     {41, t * p}};
  for (size_t i = 0; i < sizeof ints / sizeof ints[0]; ++i)
    read_ints(a[ints[i][0]], ints[i][1]);
  for (size_t i = 0; i < sizeof reals / sizeof reals[0]; ++i)
    read_all(a[reals[i][0]], reals[i][1]);
  write_all(a[0], f * n, -0.5);
  const size_t real = single ? sizeof(float) : sizeof(double);
  for (int32_t k = 0; k < n; ++k) { /* other blocks have the states of other nodes */
    char *state = (char *)a[1] + (size_t)s * (size_t)(((int32_t *)a[17])[k] - 1) * real;
    read_all(state, s);
    write_all(state, s, 2);
  }
  return end(a[0], f * n);
}

static int32_t vfriction(void **a) {
  const int32_t n = at(a, 2), rigid = at(a, 3), edge = at(a, 4), t = at(a, 5), b = at(a, 6);
  const int32_t m = at(a, 7), f = at(a, 8), d = at(a, 9), s = at(a, 10), props = at(a, 11);
  const int32_t p = at(a, 13);
  const int32_t ints[][2] = {{14, 3}, {19, b * n}, {20, m * rigid}};
  const int32_t reals[][2] = {
      {1, s * t * n},      {15, 4},         {21, props},     {22, d * n},         {23, n},
      {24, d * n},         {25, n},         {26, n},         {27, d * n},         {28, d * n},
      {29, b * edge},      {30, m * rigid}, {31, d * b * n}, {32, d * m * rigid}, {33, d * b * n},
      {34, d * m * rigid}, {35, n},         {36, rigid},     {37, p * n},         {38, p * rigid}};
  for (size_t i = 0; i < sizeof ints / sizeof ints[0]; ++i)
    read_ints(a[ints[i][0]], ints[i][1]);
  for (size_t i = 0; i < sizeof reals / sizeof reals[0]; ++i)
    read_all(a[reals[i][0]], reals[i][1]);
  write_all(a[0], f * n, -0.5);
  write_all(a[1], s * t * n, 2);
  return end(a[0], f * n);
}

/* Memory of the host: every array as long as the driver says, and not a byte longer. */
typedef struct host {
  usub_driver *driver;
  void *data[64];
  int32_t count;
} host;

static void bind(host *h, const char *name, size_t count, double low, double step) {
  const size_t real = single ? sizeof(float) : sizeof(double);
  void *data = malloc(count * real + (count == 0));
  for (size_t i = 0; i < count; ++i) {
    const double value = low + step * (double)(i % 7);
    if (single)
      ((float *)data)[i] = (float)value;
    else
      ((double *)data)[i] = value;
  }
  CHECK(usub_bind(h->driver, name, data, count) == USUB_OK);
  h->data[h->count++] = data;
}

static void bind_ints(host *h, const char *name, size_t count, int32_t limit) {
  int32_t *data = malloc(count * sizeof *data + (count == 0));
  for (size_t i = 0; i < count; ++i)
    data[i] = (int32_t)(i % (size_t)limit) + 1;
  CHECK(usub_bind(h->driver, name, data, count) == USUB_OK);
  h->data[h->count++] = data;
}

static void bind_normals(host *h, size_t d) {
  bind(h, "normal", d * POINTS, 0, 0);
  for (size_t i = 0; i < POINTS; ++i) {
    const size_t k = i * d + i % d;
    if (single)
      ((float *)h->data[h->count - 1])[k] = 1;
    else
      ((double *)h->data[h->count - 1])[k] = 1;
  }
}

static usub_entry entry_of(const char *interface, const char *generation) {
  static const struct {
    const char *name;
    int32_t (*function)(void **);
  } all[] = {{"fric", fric}, {"vfric", vfric}, {"vfriction", vfriction}, {"vfric_coef", legacy}};
  for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
    if (strcmp(all[i].name, interface) == 0)
      return (usub_entry)all[i].function;
  return (usub_entry)(generation[0] == '2' ? modern : legacy);
}

static usub_routine *routine_of(const char *interface, const char *generation) {
  usub_routine *routine = NULL;
  usub_error error;
  CHECK(usub_routine_create(interface, generation, single ? "single" : "double", USUB_STYLE_BLOCK,
                            entry_of(interface, generation), &routine, &error) == USUB_OK);
  CHECK(usub_routine_set_flag(routine, "thread_safe", 1) == USUB_OK);
  return routine;
}

/* How FRIC_COEF is enforced. */
static const struct method {
  const char *enforcement;
  double stick_slope, damping;
  int32_t changing;
} methods[] = {{"default", 0, 0, 0}, {"penalty", 8, 0.5, 0}, {"lagrange", 0, 0.5, 1}};
static const struct method *method = methods;

static void set_method(usub_scene *scene) {
  CHECK(usub_scene_set_text(scene, "enforcement", method->enforcement) == USUB_OK);
  CHECK(usub_scene_set_real(scene, "stick_slope", method->stick_slope) == USUB_OK);
  CHECK(usub_scene_set_real(scene, "damping", method->damping) == USUB_OK);
  CHECK(usub_scene_set_int(scene, "changing", method->changing) == USUB_OK);
}

static usub_scene *scene_of(int32_t d, const char *contact, int32_t block, int32_t threads) {
  static const struct {
    const char *key;
    int32_t value;
  } rows[] = {{"points", POINTS},   {"secondary_nodes", SECONDARY},
              {"main_nodes", MAIN}, {"nodes", NODES},
              {"states", STATES},   {"fields", FIELDS},
              {"temperatures", 1},  {"dissipation", 1},
              {"derivatives", 1},   {"temperature_tangent", 1}};
  const double props[3] = {0.5, 0.25, 3};
  usub_scene *scene = NULL;
  CHECK(usub_scene_create(&scene) == USUB_OK);
  for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
    CHECK(usub_scene_set_int(scene, rows[i].key, rows[i].value) == USUB_OK);
  CHECK(usub_scene_set_int(scene, "dimension", d) == USUB_OK);
  CHECK(usub_scene_set_int(scene, "block", block) == USUB_OK);
  CHECK(usub_scene_set_int(scene, "threads", threads) == USUB_OK);
  CHECK(usub_scene_set_int(scene, "checked", checked) == USUB_OK);
  CHECK(usub_scene_set_int(scene, "skip_open", skips) == USUB_OK);
  CHECK(usub_scene_set_text(scene, "contact", contact) == USUB_OK);
  CHECK(usub_scene_set_text(scene, "precision", single ? "single" : "double") == USUB_OK);
  CHECK(usub_scene_set_real(scene, "elastic_slip", 0.125) == USUB_OK);
  CHECK(usub_scene_set_props(scene, props, 3) == USUB_OK);
  set_method(scene);
  return scene;
}

static void bind_explicit(host *h, const char *interface, int32_t d, const char *contact) {
  const int edges = contact[0] == 'e', rigid = contact[0] == 'a';
  const int is_vfric = strcmp(interface, "vfric") == 0;
  const size_t n = POINTS, dd = (size_t)d, b = edges ? 2 : 1, mains = rigid ? 1 : n;
  const size_t m = rigid ? (is_vfric ? 0 : 1) : edges || d == 2 ? 2 : 4;
  bind(h, "slip_increment", dd * n, -0.5, 0.25);
  bind_normals(h, dd);
  bind(h, "normal_force", n, skips ? 0 : 1, 0.5);
  bind(h, "stick_force", n, 0, 0.5);
  if (m)
    bind_ints(h, "main_node", m * mains, is_vfric ? MAIN : NODES);
  if (m)
    bind(h, "shape_main", m * mains, 0.25, 0.125);
  bind(h, "temperature_secondary", n, 300, 1);
  bind(h, "temperature_main", mains, 400, 1);
  bind(h, "field_secondary", FIELDS * n, 1, 1);
  bind(h, "field_main", FIELDS * mains, 2, 1);
  bind_ints(h, "secondary_node", b * n, is_vfric ? SECONDARY : NODES);
  if (is_vfric) {
    bind(h, "area", SECONDARY, 1, 1);
    bind(h, "coord_secondary", dd * SECONDARY, 1, 1);
    bind(h, "coord_main", dd * MAIN, 1, 1);
    bind(h, "secondary_force", dd * SECONDARY, 0, 0);
    bind(h, "main_force", dd * MAIN, 0, 0);
    return;
  }
  bind(h, "shape_secondary", b * n, 0.5, 0);
  bind(h, "area", n, 1, 1);
  bind(h, "nodal_force", dd * NODES, 0, 0);
  if (strcmp(interface, "vfriction") != 0)
    return;
  bind(h, "coord", dd * NODES, 1, 1);
  bind(h, "velocity", dd * NODES, 1, 1);
}

static void bind_standard(host *h, const char *interface, int32_t d) {
  const size_t n = POINTS, f = (size_t)d - 1;
  bind(h, "slip_increment", f * n, -0.5, 0.25);
  bind(h, "pressure", n, -0.5, 0.5);
  bind(h, "rotation", 4 * n, 1, 0);
  bind(h, "temperature_secondary", n, 300, 1);
  bind(h, "temperature_main", n, 400, 1);
  bind(h, "field_secondary", FIELDS * n, 1, 1);
  bind(h, "field_main", FIELDS * n, 2, 1);
  bind_ints(h, "node", n, 3);
  bind(h, "multiplier", f * n, 1, 1);
  if (strcmp(interface, "fric") != 0)
    return;
  bind(h, "coord", (size_t)d * n, 1, 1);
  bind(h, "coord_main", (size_t)d * n, 1, 1);
}

static void bind_coefficient(host *h, const char *generation) {
  const size_t n = POINTS;
  if (generation && generation[0] == '2')
    bind(h, "slip_data", 6 * n, 0, 1);
  else
    bind(h, "slip_rate", n, 0, 1);
  bind(h, "pressure", n, 1, 1);
  bind(h, "temperature", n, 300, 1);
  bind(h, "field", FIELDS * n, 1, 1);
  bind(h, "coefficient", n, 0, 0);
}

static void free_host(host *h) {
  usub_driver_free(h->driver);
  for (int32_t i = 0; i < h->count; ++i)
    free(h->data[i]);
}

/* Saves, loads, and loads every shorter and many a changed buffer. */
static void check_state(usub_driver *driver) {
  const size_t size = usub_state_size(driver);
  unsigned char *saved = malloc(size), *changed = malloc(size);
  CHECK(usub_state_save(driver, saved, size) == USUB_OK);
  CHECK(usub_state_save(driver, saved, size - 1) == USUB_BAD_ARGUMENT);
  for (size_t length = 0; length < size; length += 13) {
    unsigned char *cut = malloc(length ? length : 1);
    memcpy(cut, saved, length);
    CHECK(usub_state_load(driver, cut, length) == USUB_BAD_STATE);
    free(cut);
  }
  for (size_t i = 0; i < size; i += 7) {
    memcpy(changed, saved, size);
    changed[i] ^= 0x55;
    CHECK(usub_state_load(driver, changed, size) == USUB_BAD_STATE);
  }
  CHECK(usub_state_load(driver, saved, size) == USUB_OK);
  free(saved);
  free(changed);
}

static void look_at_symmetry(usub_driver *driver) {
  double *parts = malloc(2 * POINTS * sizeof *parts);
  usub_symmetry found;
  CHECK(usub_find_symmetry(driver, parts, parts + POINTS, &found) == USUB_OK);
  CHECK(usub_find_symmetry(driver, NULL, NULL, NULL) == USUB_OK);
  CHECK(found.sentence[0]);
  free(parts);
}

static int32_t one_call(usub_driver *driver, const char *kind, int32_t increment) {
  CHECK(usub_set_time(driver, 1, increment, increment, increment, 0.5) == USUB_OK);
  if (kind[0] == 'c')
    return usub_evaluate(driver);
  if (kind[0] == 'e')
    return usub_step(driver);
  CHECK(usub_set_amplitude(driver, 0.25) == (method->changing ? USUB_OK : USUB_WRONG_ORDER));
  CHECK(usub_begin_increment(driver) == USUB_OK);
  int32_t status = usub_iterate(driver);
  if (status >= 0)
    status = usub_iterate(driver);
  CHECK((usub_message(driver)[0] == 0) == (status >= 0));
  if (status >= 0)
    look_at_symmetry(driver);
  CHECK((status < 0 ? usub_cut_back(driver) : usub_commit(driver)) == USUB_OK);
  return status;
}

/* Good calls, failing ones, fewer points and none, plan and state. */
static void check_driver(usub_driver *driver, const char *kind, usub_entry twin) {
  const int32_t statuses[] = {USUB_OK, USUB_NOT_FINITE, USUB_ROUTINE_RAISED, USUB_ROUTINE_STOPPED};
  int32_t increment = 0;
  for (broken = 0; broken < 4; ++broken) {
    CHECK(one_call(driver, kind, ++increment) == statuses[broken]);
  }
  broken = 1;
  CHECK(one_call(driver, kind, ++increment) < 0);
  if (kind[0] != 's')
    CHECK(usub_replay(driver, twin) < 0);
  broken = 0;
  for (int32_t points = POINTS; points >= 0; points -= 5) {
    CHECK(usub_set_points(driver, points) == USUB_OK);
    CHECK(one_call(driver, kind, ++increment) == USUB_OK);
  }
  CHECK(usub_set_points(driver, POINTS) == USUB_OK);
  for (int32_t i = 0; i < usub_plan_count(driver); ++i) {
    usub_plan_row row;
    CHECK(usub_plan_get(driver, i, &row) == USUB_OK && row.argument && row.what && row.why);
  }
  check_state(driver);
  CHECK(one_call(driver, kind, ++increment) == USUB_OK);
}

static void run(const char *kind, const char *interface, const char *generation, int32_t d,
                const char *contact, int32_t block, int32_t threads) {
  usub_routine *routine = routine_of(interface, generation);
  usub_scene *scene = scene_of(d, contact, block, threads);
  host h = {0};
  usub_error error;
  if (usub_driver_create(kind, routine, scene, &h.driver, &error) != USUB_OK) {
    fprintf(stderr, "%s\n", error.message);
    exit(1);
  }
  if (kind[0] == 'e')
    bind_explicit(&h, interface, d, contact);
  else if (kind[0] == 's')
    bind_standard(&h, interface, d);
  else
    bind_coefficient(&h, generation);
  check_driver(h.driver, kind, entry_of(interface, generation));
  usub_scene_free(scene);
  free_host(&h);
  usub_routine_free(routine);
}

static void run_all(void) {
  const char *const contacts[] = {"node-to-facet", "edge-to-edge", "analytical-rigid"};
  const int32_t ways[][2] = {{0, 1}, {1, 1}, {4, 3}};
  for (size_t w = 0; w < 3; ++w) {
    const int32_t block = ways[w][0], threads = ways[w][1];
    for (single = 0; single < 2; ++single) {
      for (int32_t c = 0; c < 3; ++c) {
        for (skips = 0; skips < 2; ++skips) {
          run("explicit", "vfriction", NULL, 3, contacts[c], block, threads);
          for (int32_t d = 2; d < 4; ++d)
            run("explicit", "vfric_coef", NULL, d, contacts[c], block, threads);
        }
        skips = 0;
        for (int32_t d = 2; d < 4; ++d) {
          if (c != 1)
            run("explicit", "vfric", NULL, d, contacts[c], block, threads);
        }
      }
      run("coefficient", "vfric_coef", NULL, 3, contacts[0], block, threads);
    }
    single = 0;
    for (int32_t d = 2; d < 4; ++d) {
      run("standard", "fric", NULL, d, contacts[0], block, threads);
      for (method = methods; method < methods + 3; ++method) {
        run("standard", "fric_coef", "legacy", d, contacts[0], block, threads);
        run("standard", "fric_coef", "2022", d, contacts[0], block, threads);
      }
      method = methods;
    }
    run("coefficient", "fric_coef", "legacy", 3, contacts[0], block, threads);
    run("coefficient", "fric_coef", "2022", 3, contacts[0], block, threads);
  }
}

int main(void) {
  for (checked = 0; checked < 2; ++checked)
    run_all();
  puts("ok");
  return 0;
}
