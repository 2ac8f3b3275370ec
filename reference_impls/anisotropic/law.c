/* SPDX-License-Identifier: MIT */
/* A constant coefficient in each of both local directions; props: the two. */
#define USUB_LAW "anisotropic"
#define USUB_LAW_PROPS 2
#define USUB_LAW_ANISOTROPIC
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  mu[0] = props[0];
  mu[1] = props[1];
}
