/* SPDX-License-Identifier: MIT */
/* Coefficient from a table over slip rate, pressure, temperature and field variables: linear
 * inside, constant outside. props: see law_table.h. */
#define USUB_LAW "coulomb_tabulated"
#define USUB_LAW_PROPS usub_table_props(props, count, 1)
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TEMPERATURE
#define USUB_LAW_READS_FIELDS
#include <usersub/law_table.h>

#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  return usub_table_value(props, rate, pressure, temperature, fields, 0, derivative);
}
