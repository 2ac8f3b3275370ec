/* SPDX-License-Identifier: MIT */
/* Plans of VFRIC, VFRICTION and VFRIC_COEF. */
#include <stdio.h>
#include <stdlib.h>

#include "explicit.h"
#include "internal.h"

static const void *time_of(const usub_driver *driver, int32_t index) {
  return driver->single ? (const void *)&driver->clock.time_f[index]
                        : (const void *)&driver->clock.time[index];
}

/* A temperature or field array, or zeros where the scene has none. */
static void put_optional(usub_driver *driver, int32_t position, const char *array, int32_t present,
                         const char *absent) {
  if (present)
    usub_put_array(driver, position, array, NULL);
  else
    usub_put_absent(driver, position, driver->size.real, absent);
}

/* Fields of one side, which VFRIC wants with the point first. */
static void put_fields(usub_driver *driver, int32_t position, const char *array, size_t bytes,
                       const char *absent) {
  usub_need_array(driver, position, array);
  if (bytes && usub_data(driver, array))
    usub_put_scratch(driver, position, bytes, 0, "gathered", "transposed");
  else
    usub_put_absent(driver, position, bytes, bytes ? "nothing is bound: zeros" : absent);
}

/* Mean of "<quantity>_secondary" and "<quantity>_main". */
static void put_average(usub_driver *driver, int32_t position, const char *quantity, size_t bytes) {
  char secondary[40], main[40];
  snprintf(secondary, sizeof secondary, "%s_secondary", quantity);
  snprintf(main, sizeof main, "%s_main", quantity);
  usub_need_array(driver, position, secondary);
  usub_need_array(driver, position, main);
  if (usub_data(driver, secondary) && usub_data(driver, main))
    usub_put_scratch(driver, position, bytes, 0, "computed", "mean of the two surfaces");
  else
    usub_put_absent(driver, position, bytes, "nothing is bound: zeros");
}

static const char no_temperatures[] = "the scene has no temperatures";
static const char no_fields[] = "the scene has no fields";
static const char no_state[] = "the scene has no state variables";

static void plan_vfric(usub_driver *driver) {
  const usub_sizes *size = &driver->size;
  const usub_counts *count = &driver->counts;
  const size_t real = size->real, vector = (size_t)size->D * real;
  const size_t fields = (size_t)size->P * real;
  usub_put_scratch(driver, USUB_VFRIC_FTANGENTIAL, (size_t)size->F * real, 0, "output", "rotated back");
  if (size->S)
    usub_put_array(driver, USUB_VFRIC_STATEV, "state", NULL);
  else
    usub_put_absent(driver, USUB_VFRIC_STATEV, 0, no_state);
  usub_put_fixed(driver, USUB_VFRIC_KSTEP, &driver->clock.flags[0]);
  usub_put_fixed(driver, USUB_VFRIC_KINC, &driver->clock.flags[1]);
  usub_put_points(driver, USUB_VFRIC_NCONTACT);
  usub_put_fixed(driver, USUB_VFRIC_NFACNOD, &count->M);
  usub_put_fixed(driver, USUB_VFRIC_NSECNOD, &count->X);
  usub_put_fixed(driver, USUB_VFRIC_NMAINNOD, &count->Y);
  usub_put_fixed(driver, USUB_VFRIC_NFRICDIR, &count->F);
  usub_put_fixed(driver, USUB_VFRIC_NDIR, &count->D);
  usub_put_fixed(driver, USUB_VFRIC_NSTATEVAR, &count->S);
  usub_put_fixed(driver, USUB_VFRIC_NPROPS, &count->props);
  usub_put_fixed(driver, USUB_VFRIC_NTEMP, &count->temperatures);
  usub_put_fixed(driver, USUB_VFRIC_NPRED, &count->P);
  if (driver->analytical)
    usub_put_fixed(driver, USUB_VFRIC_NUMDEFTFV, &count->one);
  else
    usub_put_points(driver, USUB_VFRIC_NUMDEFTFV);
  usub_put_array(driver, USUB_VFRIC_JSECUID, "secondary_number", driver->node_numbers);
  usub_put_array(driver, USUB_VFRIC_JMAINUID, "main_number", driver->node_numbers);
  usub_put_array(driver, USUB_VFRIC_JCONSECID, "secondary_node", NULL);
  if (size->M)
    usub_put_array(driver, USUB_VFRIC_JCONMAINID, "main_node", NULL);
  else
    usub_put_absent(driver, USUB_VFRIC_JCONMAINID, 0, "an analytical rigid surface has no facets");
  usub_put_fixed(driver, USUB_VFRIC_TIMSTEP, time_of(driver, 0));
  usub_put_fixed(driver, USUB_VFRIC_TIMGLB, time_of(driver, 1));
  usub_put_fixed(driver, USUB_VFRIC_DTIMCUR, time_of(driver, 2));
  usub_put_fixed(driver, USUB_VFRIC_SURFINT, driver->names[0]);
  usub_put_fixed(driver, USUB_VFRIC_SURFSEC, driver->names[1]);
  usub_put_fixed(driver, USUB_VFRIC_SURFMAIN, driver->names[2]);
  usub_put_fixed(driver, USUB_VFRIC_LCONTTYPE, &count->zero);
  usub_put_scratch(driver, USUB_VFRIC_DSLIPFRIC, vector, 0, "computed", "length of the slip");
  usub_put_array(driver, USUB_VFRIC_FSTICKFORCE, "stick_force", NULL);
  usub_put_scratch(driver, USUB_VFRIC_FTANGPREV, vector, 0, "computed", "rotated to the local axes");
  usub_put_array(driver, USUB_VFRIC_FNORMAL, "normal_force", NULL);
  usub_put_fixed(driver, USUB_VFRIC_FRICTIONWORK, time_of(driver, 3));
  if (size->M)
    usub_put_array(driver, USUB_VFRIC_SHAPE, "shape_main", NULL);
  else
    usub_put_absent(driver, USUB_VFRIC_SHAPE, 0, "an analytical rigid surface has no facets");
  usub_put_array(driver, USUB_VFRIC_COORDSEC, "coord_secondary", NULL);
  usub_put_array(driver, USUB_VFRIC_COORDMAIN, "coord_main", NULL);
  usub_put_scratch(driver, USUB_VFRIC_DIRCOSSL, vector, 0, "computed", "direction of the slip");
  usub_put_array(driver, USUB_VFRIC_DIRCOSN, "normal", NULL);
  usub_put_fixed(driver, USUB_VFRIC_PROPS, driver->props);
  usub_put_array(driver, USUB_VFRIC_AREASEC, "area", driver->ones);
  const int32_t warm = driver->set.temperatures;
  put_optional(driver, USUB_VFRIC_TEMPSEC, "temperature_secondary", warm, no_temperatures);
  put_optional(driver, USUB_VFRIC_TEMPMAIN, "temperature_main", warm, no_temperatures);
  put_fields(driver, USUB_VFRIC_PREDEFSEC, "field_secondary", fields, no_fields);
  if (driver->analytical && size->P)
    usub_put_array(driver, USUB_VFRIC_PREDEFMAIN, "field_main", NULL); /* (1, P) is (P, 1) */
  else
    put_fields(driver, USUB_VFRIC_PREDEFMAIN, "field_main", fields, no_fields);
}

/* Nodal vectors of a side, gathered by its node numbers. */
static void put_nodal(usub_driver *driver, int32_t position, const char *array, const char *nodes,
                      int32_t per_point) {
  usub_need_array(driver, position, array);
  usub_need_array(driver, position, nodes);
  const size_t bytes = (size_t)per_point * (size_t)driver->size.D * driver->size.real;
  if (usub_data(driver, array) && usub_data(driver, nodes))
    usub_put_scratch(driver, position, bytes, 0, "gathered", "by node number");
  else
    usub_put_absent(driver, position, bytes, "nothing is bound: zeros");
}

static void plan_vfriction(usub_driver *driver) {
  const usub_sizes *size = &driver->size;
  const usub_counts *count = &driver->counts;
  const size_t vector = (size_t)size->D * size->real;
  usub_put_scratch(driver, USUB_VFRICTION_FTANGENTIAL, (size_t)size->F * size->real, 0, "output",
                   "rotated back");
  if (size->S)
    usub_put_array(driver, USUB_VFRICTION_STATE, "state", NULL);
  else
    usub_put_absent(driver, USUB_VFRICTION_STATE, 0, no_state);
  usub_put_points(driver, USUB_VFRICTION_NBLOCK);
  if (driver->analytical)
    usub_put_fixed(driver, USUB_VFRICTION_NBLOCKANAL, &count->one);
  else
    usub_put_points(driver, USUB_VFRICTION_NBLOCKANAL);
  if (driver->edges)
    usub_put_points(driver, USUB_VFRICTION_NBLOCKEDGE);
  else
    usub_put_fixed(driver, USUB_VFRICTION_NBLOCKEDGE, &count->one);
  usub_put_fixed(driver, USUB_VFRICTION_NNODSTATE, &count->T);
  usub_put_fixed(driver, USUB_VFRICTION_NNODSEC, &count->B);
  usub_put_fixed(driver, USUB_VFRICTION_NNODMAIN, &count->M);
  usub_put_fixed(driver, USUB_VFRICTION_NFRICDIR, &count->F);
  usub_put_fixed(driver, USUB_VFRICTION_NDIR, &count->D);
  usub_put_fixed(driver, USUB_VFRICTION_NSTATES, &count->S);
  usub_put_fixed(driver, USUB_VFRICTION_NPROPS, &count->props);
  usub_put_fixed(driver, USUB_VFRICTION_NTEMP, &count->temperatures);
  usub_put_fixed(driver, USUB_VFRICTION_NFIELDS, &count->P);
  usub_put_fixed(driver, USUB_VFRICTION_JFLAGS, driver->clock.flags);
  usub_put_fixed(driver, USUB_VFRICTION_RDATA, time_of(driver, 0));
  usub_put_fixed(driver, USUB_VFRICTION_SURFINT, driver->names[0]);
  usub_put_fixed(driver, USUB_VFRICTION_SURFSEC, driver->names[1]);
  usub_put_fixed(driver, USUB_VFRICTION_SURFMAIN, driver->names[2]);
  usub_put_array(driver, USUB_VFRICTION_JCONSECUID, "secondary_node", NULL);
  usub_put_array(driver, USUB_VFRICTION_JCONMAINUID, "main_node", NULL);
  usub_put_fixed(driver, USUB_VFRICTION_PROPS, driver->props);
  usub_put_scratch(driver, USUB_VFRICTION_DSLIPFRIC, vector, 0, "computed", "length of the slip");
  usub_put_array(driver, USUB_VFRICTION_FSTICKFORCE, "stick_force", NULL);
  usub_put_scratch(driver, USUB_VFRICTION_FTANGPREV, vector, 0, "computed",
                   "rotated to the local axes");
  usub_put_array(driver, USUB_VFRICTION_FNORMAL, "normal_force", NULL);
  usub_put_array(driver, USUB_VFRICTION_AREACONT, "area", driver->ones);
  usub_put_array(driver, USUB_VFRICTION_DIRCOSN, "normal", NULL);
  usub_put_scratch(driver, USUB_VFRICTION_DIRCOSSL, vector, 0, "computed", "direction of the slip");
  if (driver->edges)
    usub_put_array(driver, USUB_VFRICTION_SHAPESEC, "shape_secondary", NULL);
  else
    usub_put_fixed(driver, USUB_VFRICTION_SHAPESEC, driver->ones);
  usub_put_array(driver, USUB_VFRICTION_SHAPEMAIN, "shape_main",
                 driver->analytical ? driver->ones : NULL);
  put_nodal(driver, USUB_VFRICTION_COORDSEC, "coord", "secondary_node", size->B);
  put_nodal(driver, USUB_VFRICTION_COORDMAIN, "coord", "main_node", size->M);
  put_nodal(driver, USUB_VFRICTION_VELSEC, "velocity", "secondary_node", size->B);
  put_nodal(driver, USUB_VFRICTION_VELMAIN, "velocity", "main_node", size->M);
  const int32_t warm = driver->set.temperatures;
  put_optional(driver, USUB_VFRICTION_TEMPSEC, "temperature_secondary", warm, no_temperatures);
  put_optional(driver, USUB_VFRICTION_TEMPMAIN, "temperature_main", warm, no_temperatures);
  put_optional(driver, USUB_VFRICTION_FIELDSEC, "field_secondary", size->P, no_fields);
  put_optional(driver, USUB_VFRICTION_FIELDMAIN, "field_main", size->P, no_fields);
}

static void plan_vfric_coef(usub_driver *driver) {
  const size_t real = driver->size.real;
  usub_put_coefficient_common(driver);
  usub_put_array(driver, USUB_VFRIC_COEF_FCOEF, "coefficient", NULL);
  usub_put_scratch(driver, USUB_VFRIC_COEF_FCOEFDERIV, 3 * real, 0, "output",
                   "not used by explicit hosts");
  usub_put_scratch(driver, USUB_VFRIC_COEF_SLIPRATE, real, 0, "computed", "slip by time increment");
  if (usub_data(driver, "area"))
    usub_put_scratch(driver, USUB_VFRIC_COEF_PRESSURE, real, 0, "computed", "normal force by area");
  else
    usub_put_array(driver, USUB_VFRIC_COEF_PRESSURE, "normal_force", NULL);
  if (driver->set.temperatures)
    put_average(driver, USUB_VFRIC_COEF_TEMPAVG, "temperature", real);
  else
    usub_put_absent(driver, USUB_VFRIC_COEF_TEMPAVG, real, no_temperatures);
  if (driver->size.P)
    put_average(driver, USUB_VFRIC_COEF_FIELDAVG, "field", real * (size_t)driver->size.P);
  else
    usub_put_absent(driver, USUB_VFRIC_COEF_FIELDAVG, real, no_fields);
}

/* Arrays that the driver itself needs, whatever the routine reads. */
static void check_own_needs(usub_driver *driver, int is_vfric) {
  const char *lacking = NULL;
  const int secondary = usub_data(driver, is_vfric ? "secondary_force" : "nodal_force") != NULL;
  const int main = usub_data(driver, is_vfric ? "main_force" : "nodal_force") != NULL;
  driver->scatters = secondary || main;
  if (usub_is_coefficient(driver) && !usub_data(driver, "stick_force")) lacking = "stick_force";
  if (secondary && !usub_data(driver, "secondary_node")) lacking = "secondary_node";
  if (secondary && driver->edges && !usub_data(driver, "shape_secondary")) lacking = "shape_secondary";
  if (main && !driver->analytical && !usub_data(driver, "main_node")) lacking = "main_node";
  if (main && !driver->analytical && !usub_data(driver, "shape_main")) lacking = "shape_main";
  if (main && (is_vfric ? driver->size.Y : driver->size.Z) < 1) lacking = "main_force";
  if (lacking && !driver->missing[0])
    snprintf(driver->missing, sizeof driver->missing,
             "%s: array '%s' is not bound; the driver needs it to %s", driver->title, lacking,
             driver->scatters ? "add forces to the nodes" : "bound the friction force");
}

void usub_explicit_plan(usub_driver *driver) {
  const int32_t key = usub_interface_key(driver->face);
  if (key == USUB_INTERFACE_VFRIC)
    plan_vfric(driver);
  else if (key == USUB_INTERFACE_VFRICTION)
    plan_vfriction(driver);
  else
    plan_vfric_coef(driver);
  check_own_needs(driver, key == USUB_INTERFACE_VFRIC);
  const int reads_previous =
      !usub_is_coefficient(driver) && usub_is_live(driver, usub_explicit_positions(driver).previous);
  if (reads_previous && !driver->last_force && !usub_data(driver, "previous_force")) {
    driver->last_force = calloc((size_t)driver->size.N * (size_t)driver->size.D, driver->size.real);
    if (!driver->last_force)
      snprintf(driver->missing, sizeof driver->missing, "%s: no memory for the previous force",
               driver->title);
  }
}
