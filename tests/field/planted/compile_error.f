C     SPDX-License-Identifier: MIT
      SUBROUTINE FRIC(LM,TAU)
      IMPLICIT NONE
      INTEGER LM
      TAU = LM*UNKNOWN
      END
