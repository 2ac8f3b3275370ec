/* SPDX-License-Identifier: MIT */
/* Two coefficients from tables over slip rate, pressure, temperature and field variables: linear
 * inside, constant outside. props: see law_table.h. */
#define USUB_LAW "anisotropic_tabulated"
#define USUB_LAW_PROPS usub_table_props(props, count, 2)
#define USUB_LAW_ANISOTROPIC
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TEMPERATURE
#define USUB_LAW_READS_FIELDS
#include <usersub/law_table.h>

#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  for (int i = 0; i < 2; ++i)
    mu[i] = usub_table_value(props, rate, pressure, temperature, fields, i,
                             derivative ? derivative[i] : NULL);
}
