/* SPDX-License-Identifier: MIT */
/* Making drivers: refusing scenes that do not fit, sizes, blocks, constants. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"

/* Whether kind and interface go together. */
static int fits(usub_kind_of_driver kind, const usub_interface *face) {
  if (kind == USUB_KIND_OF_COEFFICIENT)
    return strstr(face->name, "_coef") != NULL;
  return (kind == USUB_KIND_OF_STANDARD) == (face->standard != 0);
}

static int32_t parse_kind(const char *text, usub_kind_of_driver *kind) {
  static const char *const names[] = {"standard", "explicit", "coefficient"};
  for (int i = 0; text && i < 3; ++i) {
    if (strcmp(text, names[i]) != 0)
      continue;
    *kind = (usub_kind_of_driver)i;
    return USUB_OK;
  }
  return USUB_BAD_ARGUMENT;
}

/* Refuses a setting outside of low ... high. */
static int32_t check_range(const usub_driver *driver, usub_error *error, const char *key,
                           int32_t value, int32_t low, int32_t high) {
  if (value >= low && value <= high)
    return USUB_OK;
  char range[64];
  snprintf(range, sizeof range,
           high == low         ? "%d"
           : high == low + 1   ? "%d or %d"
           : high == INT32_MAX ? "%d or more"
                               : "%d to %d",
           low, high);
  return usub_error_set(error, USUB_BAD_ARGUMENT, "%s: scene setting '%s' = %d; expected %s",
                        driver->title, key, value, range);
}

/* Refuses settings that no interface can serve. */
static int32_t check_ranges(const usub_driver *driver, usub_error *error) {
  const usub_settings *set = &driver->set;
  const int32_t directions = set->dimension - 1;
  int32_t status = check_range(driver, error, "points", set->points, 1, INT32_MAX);
  if (!status)
    status = check_range(driver, error, "dimension", set->dimension, 2, 3);
  if (!status)
    status = check_range(driver, error, "threads", set->threads, 1, 1024);
  if (!status)
    status = check_range(driver, error, "checked", set->checked, 0, 1);
  if (!status && set->friction_directions) {
    const int standard = driver->face->standard;
    status = check_range(driver, error, "friction_directions", set->friction_directions,
                         standard ? 1 : directions, standard ? 2 : directions);
  }
  return status;
}

/* Refuses a routine of another precision or generation than the scene's. */
static int32_t check_routine(const usub_driver *driver, usub_error *error) {
  const usub_settings *set = &driver->set;
  const int32_t key = usub_interface_key(driver->face);
  if (driver->single && driver->face->standard)
    return usub_error_set(
        error, USUB_NOT_SUPPORTED,
        "%s exists in double precision only; scene setting 'precision' = 'single'", driver->title);
  if (driver->single != driver->routine.single)
    return usub_error_set(error, USUB_ABI_MISMATCH,
                          "%s: the routine is in %s precision, the scene in %s", driver->title,
                          driver->routine.single ? "single" : "double", set->precision);
  if (key == USUB_INTERFACE_FRIC_COEF_2022 && driver->routine.generation_known &&
      strcmp(set->generation, "legacy") == 0)
    return usub_error_set(error, USUB_ABI_MISMATCH,
                          "FRIC_COEF: the routine is of generation 2022 and would write beyond the "
                          "arrays of a host of generation legacy; set the scene's 'generation' to "
                          "2022");
  return USUB_OK;
}

/* Refuses what the interface cannot do. */
static int32_t check_interface(const usub_driver *driver, usub_error *error) {
  const usub_settings *set = &driver->set;
  const int32_t key = usub_interface_key(driver->face);
  if (key == USUB_INTERFACE_VFRICTION && set->dimension == 2)
    return usub_error_set(error, USUB_NOT_SUPPORTED,
                          "VFRICTION is three-dimensional; scene setting 'dimension' = 2: put a "
                          "two-dimensional model into the plane z = 0");
  if (key == USUB_INTERFACE_VFRIC && driver->edges)
    return usub_error_set(error, USUB_NOT_SUPPORTED,
                          "VFRIC knows nodes only; scene setting 'contact' = 'edge-to-edge': use "
                          "VFRICTION");
  if (set->skip_open && (driver->kind != USUB_KIND_OF_EXPLICIT || key == USUB_INTERFACE_VFRIC))
    return usub_error_set(error, USUB_NOT_SUPPORTED,
                          "scene setting 'skip_open' = %d is for VFRICTION and VFRIC_COEF in "
                          "explicit hosts; %s %s",
                          set->skip_open, driver->title,
                          key == USUB_INTERFACE_VFRIC ? "is told of all points in one list"
                                                      : "is not such a one");
  if (key == USUB_INTERFACE_VFRIC && set->states && !set->secondary_nodes)
    return usub_error_set(
        error, USUB_BAD_ARGUMENT,
        "VFRIC keeps state variables by secondary node; scene settings 'states' = "
        "%d, 'secondary_nodes' = 0",
        set->states);
  if (set->anisotropic && key != USUB_INTERFACE_FRIC_COEF_2022)
    return usub_error_set(error, USUB_NOT_SUPPORTED,
                          "%s returns one coefficient; scene setting 'anisotropic' = 1 needs "
                          "FRIC_COEF of generation 2022",
                          driver->title);
  return usub_check_enforcement(driver, error);
}

static void set_sizes(usub_driver *driver) {
  const usub_settings *set = &driver->set;
  usub_sizes *size = &driver->size;
  const int is_vfric = usub_interface_key(driver->face) == USUB_INTERFACE_VFRIC;
  size->real = driver->single ? sizeof(float) : sizeof(double);
  size->N = set->points;
  size->D = set->dimension;
  size->F = set->friction_directions ? set->friction_directions : set->dimension - 1;
  size->S = set->states;
  size->P = set->fields;
  size->A = driver->analytical ? 1 : size->N;
  size->B = driver->edges ? 2 : 1;
  const int32_t facet = driver->edges || size->D == 2 ? 2 : 4;
  size->M = driver->analytical ? (is_vfric ? 0 : 1) : facet;
  size->X = set->secondary_nodes;
  size->Y = set->main_nodes;
  size->Z = set->nodes;
  size->T = driver->edges ? 4 : 1;
  driver->counts = (usub_counts){.one = 1,
                                 .D = size->D,
                                 .F = size->F,
                                 .S = size->S,
                                 .P = size->P,
                                 .T = size->T,
                                 .B = size->B,
                                 .M = size->M,
                                 .X = size->X,
                                 .Y = size->Y,
                                 .props = driver->prop_count,
                                 .temperatures = set->temperatures != 0};
}

/* Points a call: what is gathered should stay in the nearest cache, zero-copy slices may be long.
 */
static void choose_blocks(usub_driver *driver) {
  const int32_t key = usub_interface_key(driver->face);
  int32_t block = USUB_LONGEST_BLOCK;
  if (driver->kind == USUB_KIND_OF_EXPLICIT)
    block = key == USUB_INTERFACE_VFRIC       ? driver->size.N
            : key == USUB_INTERFACE_VFRICTION ? 64
                                              : 256;
  if (driver->kind == USUB_KIND_OF_STANDARD)
    block = 256; /* points a guard, called one by one */
  if (driver->set.block)
    block = driver->set.block;
  if (driver->kind == USUB_KIND_OF_COEFFICIENT && driver->face->standard &&
      (!driver->routine.block_safe || driver->size.S))
    block = 1;
  driver->block = block < driver->size.N ? block : driver->size.N;
  driver->threads = driver->routine.thread_safe ? driver->set.threads : 1;
  /* Blocks of VFRIC share the state of all nodes, which a checked call copies. */
  if (driver->checked && key == USUB_INTERFACE_VFRIC && driver->size.S)
    driver->threads = 1;
}

static void set_name(char *to, const char *from) {
  memset(to, ' ', USUB_NAME_LENGTH);
  for (size_t i = 0; from[i] && i < USUB_NAME_LENGTH; ++i)
    to[i] = (char)toupper((unsigned char)from[i]);
}

/* Whether the routine may write to the state in place, so that a failed step has to be undone. */
static int writes_state(const usub_driver *driver) {
  const usub_slot *state = usub_slot_find((usub_driver *)(uintptr_t)driver, "state");
  if (!state || !state->count || driver->kind == USUB_KIND_OF_STANDARD)
    return 0;
  switch (usub_interface_key(driver->face)) {
  case USUB_INTERFACE_VFRIC:
    return usub_is_wanted(driver, USUB_VFRIC_STATEV);
  case USUB_INTERFACE_VFRICTION:
    return usub_is_wanted(driver, USUB_VFRICTION_STATE);
  default:
    return 1;
  }
}

static int32_t make_memory(usub_driver *driver) {
  if (writes_state(driver)) {
    const usub_slot *state = usub_slot_find(driver, "state");
    driver->state_bytes = state->count * state->element;
    driver->state_backup = malloc(driver->state_bytes);
    if (!driver->state_backup)
      return USUB_NO_MEMORY;
  }
  if (driver->threads > 1 && !(driver->pool = usub_pool_create(driver->threads)))
    return USUB_NO_MEMORY;
  if (driver->kind == USUB_KIND_OF_EXPLICIT)
    return usub_explicit_create(driver);
  return driver->kind == USUB_KIND_OF_STANDARD ? usub_standard_create(driver) : USUB_OK;
}

static int32_t fill_driver(usub_driver *driver, const usub_scene *scene, usub_error *error) {
  driver->set = scene->settings;
  driver->enforcement = usub_enforcement_of(&driver->set);
  if (driver->kind == USUB_KIND_OF_EXPLICIT)
    driver->enforcement = usub_explicit_enforcement(driver);
  driver->single = strcmp(scene->settings.precision, "single") == 0;
  if (driver->kind == USUB_KIND_OF_EXPLICIT) {
    driver->analytical = strcmp(scene->settings.contact, "analytical-rigid") == 0;
    driver->edges = strcmp(scene->settings.contact, "edge-to-edge") == 0;
  }
  for (size_t i = 0; driver->face->name[i] && i + 1 < sizeof driver->title; ++i)
    driver->title[i] = (char)toupper((unsigned char)driver->face->name[i]);
  int32_t status = check_ranges(driver, error);
  if (!status)
    status = check_routine(driver, error);
  if (!status)
    status = check_interface(driver, error);
  if (!status)
    status = usub_props_create(driver, scene, error);
  if (status)
    return status;
  driver->checked = driver->set.checked;
  driver->time_limit = USUB_TIME_LIMIT;
  if (driver->checked)
    usub_catch_faults(1);
  set_sizes(driver);
  choose_blocks(driver);
  driver->points = driver->size.N;
  usub_start_call(driver);
  set_name(driver->names[0], scene->settings.interaction);
  set_name(driver->names[1], scene->settings.secondary);
  set_name(driver->names[2], scene->settings.main);
  status = usub_slots_create(driver, error);
  if (status)
    return status;
  if (make_memory(driver))
    return usub_error_set(error, USUB_NO_MEMORY, "no memory for a driver of %d points",
                          driver->size.N);
  return USUB_OK;
}

int32_t usub_driver_create(const char *kind, const usub_routine *routine, const usub_scene *scene,
                           usub_driver **driver, usub_error *error) {
  usub_kind_of_driver of = USUB_KIND_OF_STANDARD;
  if (!driver || !routine || !scene)
    return usub_error_set(error, USUB_BAD_ARGUMENT, "%s: expected a pointer, got NULL",
                          !driver    ? "driver"
                          : !routine ? "routine"
                                     : "scene");
  *driver = NULL;
  if (parse_kind(kind, &of))
    return usub_error_set(error, USUB_BAD_ARGUMENT,
                          "driver kind '%s'; expected 'standard', 'explicit' or 'coefficient'",
                          kind ? kind : "(null)");
  if (!fits(of, routine->face))
    return usub_error_set(error, USUB_NOT_SUPPORTED, "a driver of kind '%s' cannot call %s", kind,
                          routine->face->name);
  usub_driver *made = calloc(1, sizeof *made);
  if (!made)
    return usub_error_set(error, USUB_NO_MEMORY, "no memory for a driver");
  made->kind = of;
  made->routine = *routine;
  made->face = routine->face;
  int32_t status = fill_driver(made, scene, error);
  if (status) {
    usub_driver_free(made);
    return status;
  }
  *driver = made;
  return usub_error_set(error, USUB_OK, "%s", "");
}

void usub_driver_free(usub_driver *driver) {
  if (!driver)
    return;
  usub_pool_free(driver->pool);
  usub_calls_free(driver);
  usub_slots_free(driver);
  usub_standard_free(driver);
  usub_explicit_free(driver);
  usub_nothing_free(driver);
  usub_props_free(driver);
  free(driver->ones);
  free(driver->node_numbers);
  free(driver->state_backup);
  free(driver->last_force);
  free(driver);
}
