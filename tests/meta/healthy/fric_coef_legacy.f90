! SPDX-License-Identifier: MIT
! FRIC_COEF, legacy: decay by slip rate; props: coefficient at rest, at high rate, decay (time/length).
! props: 0.3, 0.2, 5
subroutine fric_coef( &
#include "usersub/arguments/fric_coef_names.fi"
  implicit none
#include "usersub/arguments/fric_coef_types.fi"
  double precision :: rest, moving, decay, rate, change
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  do k = 1, nBlock
    rate = slipRate(k)
    change = (rest - moving)*exp(-decay*rate)
    fCoef(k) = moving + change
    fCoefDeriv(k, 1) = -decay*change  ! by rate, pressure, temperature
    fCoefDeriv(k, 2:3) = 0
  end do
end subroutine
