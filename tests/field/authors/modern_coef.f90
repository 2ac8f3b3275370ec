! SPDX-License-Identifier: MIT
! FRIC_COEF of 2022 in free form: rData(7+i), TRIM and SELECT CASE on names, fCoefDeriv, array sections, MODULE with a table
module stribeck
  implicit none
  real(8), parameter :: rates(4) = [0d0, 1d0, 5d0, 20d0], mus(4) = [0.6d0, 0.4d0, 0.25d0, 0.3d0]
contains
  subroutine lookup(v, mu, slope)
    real(8), intent(in) :: v
    real(8), intent(out) :: mu, slope
    integer :: i
    i = count(rates(2:3) <= v) + 1
    slope = (mus(i+1) - mus(i))/(rates(i+1) - rates(i))
    mu = mus(i) + slope*(min(v, rates(4)) - rates(i))
  end subroutine
end module stribeck
Subroutine Fric_Coef(fCoef, fCoefDeriv, nBlock, nProps, nTemp, nFields, iData, rData, surfInt, surfSec, surfMain, props, &
                     slipData, pressure, tempAvg, fieldAvg)
  Use Stribeck
  Include 'aba_param.inc'
  Character(80) :: surfInt, surfSec, surfMain
  Dimension :: fCoef(nBlock,2), fCoefDeriv(nBlock,20,2), props(nProps), slipData(nBlock,6), pressure(nBlock), &
               tempAvg(nBlock), fieldAvg(nBlock,nFields), iData(*), rData(*)
  Call lookup(slipData(1,1), fCoef(1,1), fCoefDeriv(1,1,1))
  factor = 1
  Select Case (Trim(surfInt))
  Case ('OILED', 'GREASED')
    factor = props(1)
  End Select
  fCoef(1,1) = factor*fCoef(1,1)*(1 + fieldAvg(1,nFields))
  fCoefDeriv(1,1,1) = factor*fCoefDeriv(1,1,1)*(1 + fieldAvg(1,nFields))
  fCoefDeriv(1,2:3,1) = 0
End Subroutine
