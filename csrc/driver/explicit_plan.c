/* SPDX-License-Identifier: MIT */
/* Plans of VFRIC, VFRICTION and VFRIC_COEF. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "explicit.h"
#include "fric_coef.h"
#include "internal.h"

static const void *time_of(const usub_driver *driver, int32_t index) {
  return driver->single ? (const void *)&driver->clock.time_f[index]
                        : (const void *)&driver->clock.time[index];
}

/* Ones for an array that the host does not bind, if the routine may read the argument made of it.
 */
static const void *ones_for(usub_driver *driver, int32_t position, const char *array,
                            int32_t count) {
  if (!usub_is_wanted(driver, position) || usub_data(driver, array) || driver->ones || !count)
    return driver->ones;
  const size_t n = (size_t)count;
  driver->ones = malloc(n * driver->size.real);
  driver->out_of_memory |= !driver->ones;
  for (size_t i = 0; driver->ones && i < n; ++i) {
    if (driver->single)
      ((float *)driver->ones)[i] = 1;
    else
      ((double *)driver->ones)[i] = 1;
  }
  return driver->ones;
}

/* The shape function of a node: one. */
static const void *one(const usub_driver *driver) {
  static const double of_double = 1;
  static const float of_float = 1;
  return driver->single ? (const void *)&of_float : (const void *)&of_double;
}

/* Numbers 1, 2, ... of the nodes, in place of global ones, likewise. */
static const void *numbers_for(usub_driver *driver, int32_t position, const char *array) {
  const usub_sizes *size = &driver->size;
  const int32_t most = size->X > size->Y ? size->X : size->Y;
  if (!usub_is_wanted(driver, position) || usub_data(driver, array) || driver->node_numbers)
    return driver->node_numbers;
  driver->node_numbers = malloc(((size_t)most + 1) * sizeof *driver->node_numbers);
  driver->out_of_memory |= !driver->node_numbers;
  for (int32_t i = 0; driver->node_numbers && i <= most; ++i)
    driver->node_numbers[i] = i + 1;
  return driver->node_numbers;
}

/* A temperature or field array, or zeros where the scene has none. */
static void put_optional(usub_driver *driver, int32_t position, const char *array, int32_t present,
                         const char *absent) {
  if (present)
    usub_put_array(driver, position, array, NULL);
  else
    usub_put_absent(driver, position, driver->size.real, absent);
}

/* The stick force: the host's, or what the driver makes of the scene. */
static void put_stick_force(usub_driver *driver, int32_t position) {
  usub_put_array(driver, position, "stick_force", NULL);
  usub_source *source = &driver->sources[position];
  if (driver->enforcement == USUB_ENFORCE_DEFAULT || source->from == USUB_LEFT_OUT)
    return;
  source->what = "computed";
  source->why = driver->enforcement == USUB_ENFORCE_KINEMATIC
                    ? "kinematic: mass times predicted velocity by time increment"
                    : "penalty: length of the elastic trial force";
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

static const char no_temperatures[] = "the scene has no temperatures";
static const char no_fields[] = "the scene has no fields";
static const char no_state[] = "the scene has no state variables";
static const char no_facets[] = "an analytical rigid surface has no facets";
static const char mean[] = "mean of the two surfaces";

/* Numbers, counts and names of VFRIC. */
static void plan_vfric_numbers(usub_driver *driver) {
  const usub_counts *count = &driver->counts;
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
  usub_put_fixed(driver, USUB_VFRIC_TIMSTEP, time_of(driver, 0));
  usub_put_fixed(driver, USUB_VFRIC_TIMGLB, time_of(driver, 1));
  usub_put_fixed(driver, USUB_VFRIC_DTIMCUR, time_of(driver, 2));
  usub_put_fixed(driver, USUB_VFRIC_SURFINT, driver->names[0]);
  usub_put_fixed(driver, USUB_VFRIC_SURFSEC, driver->names[1]);
  usub_put_fixed(driver, USUB_VFRIC_SURFMAIN, driver->names[2]);
  usub_put_fixed(driver, USUB_VFRIC_LCONTTYPE, &driver->clock.flags[2]);
  usub_put_fixed(driver, USUB_VFRIC_FRICTIONWORK, time_of(driver, 3));
  usub_put_fixed(driver, USUB_VFRIC_PROPS, driver->props);
}

static void plan_vfric(usub_driver *driver) {
  const usub_sizes *size = &driver->size;
  const size_t real = size->real, vector = (size_t)size->D * real;
  const size_t fields = (size_t)size->P * real;
  plan_vfric_numbers(driver);
  usub_put_scratch(driver, USUB_VFRIC_FTANGENTIAL, (size_t)size->F * real, 0, "output",
                   "rotated back");
  if (size->S)
    usub_put_array(driver, USUB_VFRIC_STATEV, "state", NULL);
  else
    usub_put_absent(driver, USUB_VFRIC_STATEV, 0, no_state);
  usub_put_array(driver, USUB_VFRIC_JSECUID, "secondary_number",
                 numbers_for(driver, USUB_VFRIC_JSECUID, "secondary_number"));
  usub_put_array(driver, USUB_VFRIC_JMAINUID, "main_number",
                 numbers_for(driver, USUB_VFRIC_JMAINUID, "main_number"));
  usub_put_array(driver, USUB_VFRIC_JCONSECID, "secondary_node", NULL);
  if (size->M) {
    usub_put_array(driver, USUB_VFRIC_JCONMAINID, "main_node", NULL);
    usub_put_array(driver, USUB_VFRIC_SHAPE, "shape_main", NULL);
  } else {
    usub_put_absent(driver, USUB_VFRIC_JCONMAINID, 0, no_facets);
    usub_put_absent(driver, USUB_VFRIC_SHAPE, 0, no_facets);
  }
  usub_put_scratch(driver, USUB_VFRIC_DSLIPFRIC, vector, 0, "computed", "length of the slip");
  put_stick_force(driver, USUB_VFRIC_FSTICKFORCE);
  usub_put_scratch(driver, USUB_VFRIC_FTANGPREV, vector, 0, "computed",
                   "rotated to the local axes");
  usub_put_array(driver, USUB_VFRIC_FNORMAL, "normal_force", NULL);
  usub_put_array(driver, USUB_VFRIC_COORDSEC, "coord_secondary", NULL);
  usub_put_array(driver, USUB_VFRIC_COORDMAIN, "coord_main", NULL);
  usub_put_scratch(driver, USUB_VFRIC_DIRCOSSL, vector, 0, "computed", "direction of the slip");
  usub_put_array(driver, USUB_VFRIC_DIRCOSN, "normal", NULL);
  usub_put_array(driver, USUB_VFRIC_AREASEC, "area",
                 ones_for(driver, USUB_VFRIC_AREASEC, "area", size->X));
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

/* Numbers, counts and names of VFRICTION. */
static void plan_vfriction_numbers(usub_driver *driver) {
  const usub_counts *count = &driver->counts;
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
  usub_put_fixed(driver, USUB_VFRICTION_PROPS, driver->props);
}

static void plan_vfriction(usub_driver *driver) {
  const usub_sizes *size = &driver->size;
  const size_t vector = (size_t)size->D * size->real;
  plan_vfriction_numbers(driver);
  usub_put_scratch(driver, USUB_VFRICTION_FTANGENTIAL, (size_t)size->F * size->real, 0, "output",
                   "rotated back");
  if (size->S)
    usub_put_array(driver, USUB_VFRICTION_STATE, "state", NULL);
  else
    usub_put_absent(driver, USUB_VFRICTION_STATE, 0, no_state);
  usub_put_array(driver, USUB_VFRICTION_JCONSECUID, "secondary_node", NULL);
  usub_put_array(driver, USUB_VFRICTION_JCONMAINUID, "main_node", NULL);
  usub_put_scratch(driver, USUB_VFRICTION_DSLIPFRIC, vector, 0, "computed", "length of the slip");
  put_stick_force(driver, USUB_VFRICTION_FSTICKFORCE);
  usub_put_scratch(driver, USUB_VFRICTION_FTANGPREV, vector, 0, "computed",
                   "rotated to the local axes");
  usub_put_array(driver, USUB_VFRICTION_FNORMAL, "normal_force", NULL);
  usub_put_array(driver, USUB_VFRICTION_AREACONT, "area",
                 ones_for(driver, USUB_VFRICTION_AREACONT, "area", driver->block));
  usub_put_array(driver, USUB_VFRICTION_DIRCOSN, "normal", NULL);
  usub_put_scratch(driver, USUB_VFRICTION_DIRCOSSL, vector, 0, "computed", "direction of the slip");
  if (driver->edges)
    usub_put_array(driver, USUB_VFRICTION_SHAPESEC, "shape_secondary", NULL);
  else
    usub_put_fixed(driver, USUB_VFRICTION_SHAPESEC, one(driver));
  usub_put_array(driver, USUB_VFRICTION_SHAPEMAIN, "shape_main",
                 driver->analytical ? one(driver) : NULL);
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
  usub_put_scratch(driver, USUB_VFRIC_COEF_SLIPRATE, real, 0, "computed",
                   usub_is_elastic(driver) ? "slip by time increment, 0 while a point sticks"
                                           : "slip by time increment");
  if (usub_data(driver, "area"))
    usub_put_scratch(driver, USUB_VFRIC_COEF_PRESSURE, real, 0, "computed", "normal force by area");
  else
    usub_put_array(driver, USUB_VFRIC_COEF_PRESSURE, "normal_force", NULL);
  if (driver->set.temperatures)
    usub_put_pair(driver, USUB_VFRIC_COEF_TEMPAVG, "temperature", real, 0, "computed", mean);
  else
    usub_put_absent(driver, USUB_VFRIC_COEF_TEMPAVG, real, no_temperatures);
  if (driver->size.P)
    usub_put_pair(driver, USUB_VFRIC_COEF_FIELDAVG, "field", real * (size_t)driver->size.P, 0,
                  "computed", mean);
  else
    usub_put_absent(driver, USUB_VFRIC_COEF_FIELDAVG, real, no_fields);
}

/* Arrays that the driver itself needs, whatever the routine reads. */
static void check_own_needs(usub_driver *driver) {
  const int is_vfric = usub_is_vfric(driver);
  const char *lacking = NULL;
  const int secondary = usub_data(driver, is_vfric ? "secondary_force" : "nodal_force") != NULL;
  const int main = usub_data(driver, is_vfric ? "main_force" : "nodal_force") != NULL;
  const int rigid = is_vfric && driver->analytical; /* its only node needs no number */
  driver->scatters = secondary || main;
  if (secondary && !usub_data(driver, "secondary_node"))
    lacking = "secondary_node";
  if (secondary && driver->edges && !usub_data(driver, "shape_secondary"))
    lacking = "shape_secondary";
  if (main && !rigid && !usub_data(driver, "main_node"))
    lacking = "main_node";
  if (main && !driver->analytical && !usub_data(driver, "shape_main"))
    lacking = "shape_main";
  const char *why = "add forces to the nodes";
  const int coefficient = usub_is_coefficient(driver), elastic = usub_is_elastic(driver);
  if (coefficient && !elastic && !usub_data(driver, "stick_force")) {
    lacking = "stick_force";
    why = "bound the friction force";
  }
  if (driver->enforcement == USUB_ENFORCE_KINEMATIC && !usub_data(driver, "mass")) {
    lacking = "mass";
    why = "compute the stick force";
  }
  if (driver->enforcement == USUB_ENFORCE_PENALTY && is_vfric &&
      !usub_data(driver, "secondary_node")) {
    lacking = "secondary_node";
    why = "keep forces by node";
  }
  /* Node number 0 would lead the routine to memory in front of the state variables. */
  if (is_vfric && driver->size.S && usub_used(driver, USUB_VFRIC_STATEV) != 0 &&
      !usub_data(driver, "secondary_node")) {
    lacking = "secondary_node";
    why = "keep state variables by node";
  }
  if (lacking && !driver->missing[0])
    snprintf(driver->missing, sizeof driver->missing,
             "%s: array '%s' is not bound; the driver needs it to %s", driver->title, lacking, why);
}

/* Whether an argument is made of the host's arrays and not left out. */
static int is_passed(const usub_driver *driver, int32_t position) {
  const usub_source *source = &driver->sources[position];
  return source->from == USUB_SCRATCH || (source->from != USUB_LEFT_OUT && source->slot);
}

/* Node numbers that nobody uses are not looked at: those that lead to memory of the driver or the
 * host, and those that the routine is told, have to be right. */
static void find_nodes_that_matter(usub_driver *driver) {
  if (usub_is_vfric(driver)) {
    driver->secondary_matters = 1; /* of forces and state variables */
    driver->main_matters = driver->scatters || is_passed(driver, USUB_VFRIC_JCONMAINID);
    return;
  }
  driver->secondary_matters = driver->main_matters = driver->scatters;
  if (usub_is_coefficient(driver))
    return;
  driver->secondary_matters |= is_passed(driver, USUB_VFRICTION_JCONSECUID) ||
                               is_passed(driver, USUB_VFRICTION_COORDSEC) ||
                               is_passed(driver, USUB_VFRICTION_VELSEC);
  driver->main_matters |= is_passed(driver, USUB_VFRICTION_JCONMAINUID) ||
                          is_passed(driver, USUB_VFRICTION_COORDMAIN) ||
                          is_passed(driver, USUB_VFRICTION_VELMAIN);
}

void usub_explicit_plan(usub_driver *driver) {
  if (usub_is_coefficient(driver))
    plan_vfric_coef(driver);
  else if (usub_is_vfric(driver))
    plan_vfric(driver);
  else
    plan_vfriction(driver);
  check_own_needs(driver);
  find_nodes_that_matter(driver);
  const int wanted = driver->enforcement == USUB_ENFORCE_PENALTY ||
                     usub_is_live(driver, usub_explicit_positions(driver).previous);
  driver->keeps_force =
      !usub_is_coefficient(driver) && wanted && !usub_data(driver, "previous_force");
}

size_t usub_axes_bytes(const usub_driver *driver, size_t points) {
  if (driver->kind != USUB_KIND_OF_EXPLICIT)
    return 0;
  /* Where the routine reads the directions, its argument holds them; packing would take them. */
  if (!usub_is_coefficient(driver) && !driver->set.skip_open &&
      usub_is_live(driver, usub_explicit_positions(driver).direction))
    return 0;
  return points * (size_t)driver->size.D * driver->size.real;
}

size_t usub_force_bytes(const usub_driver *driver) {
  const usub_sizes *size = &driver->size;
  const int32_t columns = usub_is_vfric(driver) && size->X > size->N ? size->X : size->N;
  return (size_t)columns * (size_t)size->D * size->real;
}

int32_t usub_explicit_memory(usub_driver *driver) {
  if (!driver->keeps_force || driver->last_force)
    return USUB_OK;
  driver->last_force = calloc(1, usub_force_bytes(driver));
  return driver->last_force ? USUB_OK
                            : usub_fail(driver, USUB_NO_MEMORY,
                                        "%s: no memory for the previous force", driver->title);
}
