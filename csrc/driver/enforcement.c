/* SPDX-License-Identifier: MIT */
/* Settings of enforcement that an interface or a kind of driver cannot serve are refused. */
#include <stdio.h>
#include <string.h>

#include "internal.h"

static int32_t refuse(const usub_driver *driver, usub_error *error, const char *setting,
                      const char *why) {
  return usub_error_set(error, USUB_NOT_SUPPORTED, "%s: scene setting %s: %s", driver->title,
                        setting, why);
}

/* A setting that is a positive number; `why` it cannot be. */
static int32_t refuse_number(const usub_driver *driver, usub_error *error, const char *key,
                             double value, const char *why) {
  char setting[80];
  snprintf(setting, sizeof setting, "'%s' = %g", key, value);
  return value > 0 ? refuse(driver, error, setting, why) : USUB_OK;
}

static int32_t refuse_all(const usub_driver *driver, usub_error *error, const char *why) {
  const usub_settings *set = &driver->set;
  int32_t status = refuse_number(driver, error, "stick_slope", set->stick_slope, why);
  if (!status)
    status = refuse_number(driver, error, "damping", set->damping, why);
  if (!status)
    status = refuse_number(driver, error, "shear_limit", set->shear_limit, why);
  if (!status)
    status = refuse_number(driver, error, "changing", set->changing, why);
  return status;
}

static int32_t refuse_method(const usub_driver *driver, usub_error *error, const char *why) {
  char setting[USUB_TEXT_LENGTH + 32];
  snprintf(setting, sizeof setting, "'enforcement' = '%s'", driver->set.enforcement);
  return refuse(driver, error, setting, why);
}

static int32_t check_fric_coef(const usub_driver *driver, usub_error *error) {
  const usub_settings *set = &driver->set;
  if (driver->enforcement == USUB_ENFORCE_KINEMATIC)
    return refuse_method(driver, error, "expected penalty or lagrange in the implicit driver");
  if (driver->enforcement == USUB_ENFORCE_LAGRANGE)
    return refuse_number(driver, error, "stick_slope", set->stick_slope,
                         "Lagrange multipliers allow no elastic slip");
  if (!(set->stick_slope > 0) && !(usub_critical_elastic_slip(set) > 0))
    return usub_error_set(error, USUB_BAD_ARGUMENT,
                          "FRIC_COEF: penalty enforcement needs the scene setting 'elastic_slip', "
                          "or 'characteristic_length' (times 'slip_tolerance' = %g), or "
                          "'stick_slope'",
                          set->slip_tolerance);
  return USUB_OK;
}

static int32_t check_explicit(const usub_driver *driver, usub_error *error) {
  const usub_settings *set = &driver->set;
  static const char itself[] = "the routine gives the force itself: let it do that";
  const int32_t key = usub_interface_key(driver->face);
  const int coefficient = key == USUB_INTERFACE_VFRIC_COEF;
  const int penalty = driver->enforcement == USUB_ENFORCE_PENALTY;
  if (driver->enforcement == USUB_ENFORCE_LAGRANGE)
    return refuse_method(driver, error, "Lagrange multipliers are of the implicit driver");
  if (penalty && !(set->stick_slope > 0))
    return usub_error_set(error, USUB_BAD_ARGUMENT,
                          "%s: penalty enforcement needs the scene setting 'stick_slope', its "
                          "stiffness by area",
                          driver->title);
  if (penalty && key == USUB_INTERFACE_VFRIC && !set->secondary_nodes)
    return usub_error_set(error, USUB_BAD_ARGUMENT,
                          "VFRIC keeps forces by secondary node; penalty enforcement needs the "
                          "scene setting 'secondary_nodes'");
  int32_t status = refuse_number(driver, error, "changing", set->changing,
                                 "changing friction is of the implicit driver");
  if (!status && !penalty)
    status = refuse_number(driver, error, "stick_slope", set->stick_slope,
                           coefficient ? "kinematic enforcement allows no elastic slip" : itself);
  if (!status && !(penalty && coefficient))
    status = refuse_number(driver, error, "damping", set->damping,
                           coefficient ? "only penalty enforcement has an elastic slip" : itself);
  if (!status && !coefficient)
    status = refuse_number(driver, error, "shear_limit", set->shear_limit, itself);
  return status;
}

usub_enforcement usub_enforcement_of(const usub_settings *set) {
  static const char *const names[] = {"default", "penalty", "lagrange", "kinematic"};
  int32_t i = 3;
  while (i > 0 && strcmp(set->enforcement, names[i]) != 0)
    --i;
  return (usub_enforcement)i;
}

int32_t usub_check_enforcement(const usub_driver *driver, usub_error *error) {
  if (driver->set.changing > 2)
    return usub_error_set(error, USUB_BAD_ARGUMENT,
                          "%s: scene setting 'changing' = %d; expected 0, 1 or 2", driver->title,
                          driver->set.changing);
  if (driver->kind == USUB_KIND_OF_EXPLICIT)
    return check_explicit(driver, error);
  if (driver->kind == USUB_KIND_OF_COEFFICIENT) {
    static const char alone[] = "the coefficient driver enforces nothing";
    if (driver->enforcement != USUB_ENFORCE_DEFAULT)
      return refuse_method(driver, error, alone);
    return refuse_all(driver, error, alone);
  }
  if (usub_interface_key(driver->face) != USUB_INTERFACE_FRIC)
    return check_fric_coef(driver, error);
  static const char itself[] = "the routine gives the stress itself: let it do that";
  if (driver->enforcement != USUB_ENFORCE_DEFAULT)
    return refuse_method(driver, error,
                         "the routine chooses by LM how it sticks: expected 'default'");
  return refuse_all(driver, error, itself);
}
