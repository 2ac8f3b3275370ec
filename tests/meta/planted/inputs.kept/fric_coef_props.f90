! SPDX-License-Identifier: MIT
! The properties are scaled in place.
! planted: inputs.kept: props
! props: 0.3, 0.2, 5, 70
subroutine fric_coef( &
#include "usersub/arguments/fric_coef_names.fi"
  implicit none
#include "usersub/arguments/fric_coef_types.fi"
  double precision :: rest, moving, decay, rate, change
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  props(4) = props(4)/1000  ! given in thousandths
  do k = 1, nBlock
    rate = slipRate(k)
    change = (rest - moving)*exp(-decay*rate)
    fCoef(k) = moving + change
    fCoefDeriv(k, 1) = -decay*change  ! by rate, pressure, temperature
    fCoefDeriv(k, 2:3) = 0
  end do
end subroutine
