! SPDX-License-Identifier: MIT
! Free form, new names, continuation lines, a helper in a module; several points a call.
module pressure_law
  implicit none
contains
  elemental function falling(p, top, scale) result(mu)
    double precision, intent(in) :: p, top, scale
    double precision :: mu
    mu = top / (1.0d0 + p / scale)   ! isn't it nice
  end function falling
end module pressure_law

subroutine VFRIC_COEF(fCoef, fCoefDeriv, nBlock, nProps, nTemp, nFields, jFlags, rData, &
    surfInt, surfSec, surfMain, &
    & props, slipRate, pressure, tempAvg, fieldAvg)
  use pressure_law, only: falling
  include 'vaba_param.inc'
  dimension fCoef(nBlock), fCoefDeriv(nBlock,3), jFlags(2), rData(3), props(nProps), &
    slipRate(nBlock), pressure(nBlock), tempAvg(nBlock), fieldAvg(nBlock,nFields)
  character(len=80) :: surfInt, surfSec, surfMain
  do k = 1, nBlock
    fCoef(k) = falling(dble(pressure(k)), dble(props(1)), dble(props(2))); if (nTemp > 0) fCoef(k) = &
      fCoef(k) * (1 + props(3) * tempAvg(k))
  end do
end subroutine VFRIC_COEF
