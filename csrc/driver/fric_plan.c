/* SPDX-License-Identifier: MIT */
/* The plan of FRIC. */
#include "standard.h"

static const double identity[4] = {1, 0, 0, 1};

static void put_tangent(usub_driver *driver, int32_t position, const char *array, size_t bytes) {
  if (usub_data(driver, array))
    usub_put_array(driver, position, array, NULL);
  else
    usub_put_scratch(driver, position, bytes, 0, "output", "not wanted by the scene");
}

/* Numbers, counts and names. */
static void plan_numbers(usub_driver *driver) {
  const usub_counts *count = &driver->counts;
  usub_put_fixed(driver, USUB_FRIC_KSTEP, &driver->clock.flags[0]);
  usub_put_fixed(driver, USUB_FRIC_KINC, &driver->clock.flags[1]);
  usub_put_fixed(driver, USUB_FRIC_TIME, &driver->clock.time[0]);
  usub_put_fixed(driver, USUB_FRIC_DTIME, &driver->clock.time[2]);
  usub_put_fixed(driver, USUB_FRIC_CINAME, driver->names[0]);
  usub_put_fixed(driver, USUB_FRIC_SECNAME, driver->names[1]);
  usub_put_fixed(driver, USUB_FRIC_MAINNAME, driver->names[2]);
  usub_put_fixed(driver, USUB_FRIC_NPATCH, &count->zero);
  usub_put_fixed(driver, USUB_FRIC_NFDIR, &count->F);
  usub_put_fixed(driver, USUB_FRIC_MCRD, &count->D);
  usub_put_fixed(driver, USUB_FRIC_NPRED, &count->P);
  usub_put_fixed(driver, USUB_FRIC_NSTATV, &count->S);
  usub_put_fixed(driver, USUB_FRIC_CHRLNGTH, &driver->set.characteristic_length);
  usub_put_fixed(driver, USUB_FRIC_PROPS, driver->props);
  usub_put_fixed(driver, USUB_FRIC_NPROPS, &count->props);
}

/* What the routine returns, and what it continues from. */
static void plan_answers(usub_driver *driver) {
  const usub_sizes *size = &driver->size;
  const size_t vector = (size_t)size->F * sizeof(double);
  usub_put_array(driver, USUB_FRIC_LM, "lm", NULL);
  usub_put_array(driver, USUB_FRIC_TAU, "tau", NULL);
  put_tangent(driver, USUB_FRIC_DDTDDG, "ddtddg", (size_t)size->F * vector);
  put_tangent(driver, USUB_FRIC_DDTDDP, "ddtddp", vector);
  usub_put_array(driver, USUB_FRIC_DSLIP, "dslip", NULL);
  usub_put_array(driver, USUB_FRIC_SED, "sed", NULL);
  usub_put_array(driver, USUB_FRIC_SFD, "sfd", NULL);
  put_tangent(driver, USUB_FRIC_DDTDDT, "ddtddt", 2 * vector);
  usub_put_scratch(driver, USUB_FRIC_PNEWDT, sizeof(double), 0, "output", "smallest of all points");
  if (size->S)
    usub_put_memory(driver, USUB_FRIC_STATEV, driver->last.trial_state,
                    (size_t)size->S * sizeof(double));
  else
    usub_put_absent(driver, USUB_FRIC_STATEV, 0, "the scene has no state variables");
}

/* What the routine is told of its point. */
static void plan_point(usub_driver *driver) {
  const usub_sizes *size = &driver->size;
  const usub_counts *count = &driver->counts;
  const size_t vector = (size_t)size->F * sizeof(double);
  usub_put_array(driver, USUB_FRIC_DGAM, "slip_increment", NULL);
  usub_put_scratch(driver, USUB_FRIC_TAULM, vector, 0, "computed", "multiplier where LM is 1");
  usub_put_array(driver, USUB_FRIC_PRESS, "pressure", NULL);
  if (usub_data(driver, "pressure_increment"))
    usub_put_array(driver, USUB_FRIC_DPRESS, "pressure_increment", NULL);
  else
    usub_put_scratch(driver, USUB_FRIC_DPRESS, sizeof(double), 0, "computed",
                     "against the committed pressure");
  usub_put_array(driver, USUB_FRIC_DDPDDH, "contact_stiffness", NULL);
  usub_put_array(driver, USUB_FRIC_SLIP, "slip", NULL);
  usub_put_array(driver, USUB_FRIC_NOEL, "element", &count->zero);
  usub_put_array(driver, USUB_FRIC_NPT, "integration_point", &count->zero);
  if (usub_data(driver, "node"))
    usub_put_array(driver, USUB_FRIC_NODE, "node", NULL);
  else if (usub_data(driver, "element"))
    usub_put_fixed(driver, USUB_FRIC_NODE, &count->zero); /* contact elements have no node */
  else
    usub_put_scratch(driver, USUB_FRIC_NODE, sizeof(int32_t), 0, "computed", "number of the point");
  usub_put_array(driver, USUB_FRIC_COORDS, "coord", NULL);
  usub_put_array(driver, USUB_FRIC_RCOORD, "coord_main", NULL);
  usub_put_array(driver, USUB_FRIC_DROT, "rotation", identity);
  const char *const how = "both surfaces side by side";
  if (driver->set.temperatures)
    usub_put_pair(driver, USUB_FRIC_TEMP, "temperature", 2 * sizeof(double), 0, "gathered", how);
  else
    usub_put_absent(driver, USUB_FRIC_TEMP, 2 * sizeof(double), "the scene has no temperatures");
  if (size->P)
    usub_put_pair(driver, USUB_FRIC_PREDEF, "field", 2 * (size_t)size->P * sizeof(double), 0,
                  "gathered", how);
  else
    usub_put_absent(driver, USUB_FRIC_PREDEF, 0, "the scene has no fields");
}

void usub_fric_plan(usub_driver *driver) {
  plan_numbers(driver);
  plan_answers(driver);
  plan_point(driver);
}
