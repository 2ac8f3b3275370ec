C     SPDX-License-Identifier: MIT
      SUBROUTINE UMAT(STRESS)
      REAL*8 STRESS
      STRESS = 0
      END
      SUBROUTINE FRICTION(MU)
      REAL*8 MU
      MU = 0
      END
