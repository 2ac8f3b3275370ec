! SPDX-License-Identifier: MIT
#define COHESION 2
#define MU_OF(p) p(1)
