! SPDX-License-Identifier: MIT
! The coefficients at rest and at high rate are exchanged.
! planted: limits.rate: (?i)rest|rate|limit
! props: 0.3, 0.2, 5
subroutine fric_coef( &
#include "usersub/arguments/fric_coef_2022_names.fi"
  implicit none
#include "usersub/arguments/fric_coef_2022_types.fi"
  double precision :: rest, moving, decay, rate, change
  integer :: k
  rest = props(2)
  moving = props(1)
  decay = props(3)
  do k = 1, nBlock
    rate = slipData(k, 1)
    change = (rest - moving)*exp(-decay*rate)
    fCoef(k, 1) = moving + change
    fCoefDeriv(k, 1, 1) = -decay*change  ! by rate, pressure, temperature
    fCoefDeriv(k, 2:3, 1) = 0
  end do
end subroutine
