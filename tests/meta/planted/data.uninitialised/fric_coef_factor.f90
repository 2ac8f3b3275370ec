! SPDX-License-Identifier: MIT
! The coefficient starts from a variable that is set for temperatures only.
! planted: data.uninitialised: (?i)uninitiali|not set|local
! props: 0.3, 0.2, 5
subroutine fric_coef( &
#include "usersub/arguments/fric_coef_2022_names.fi"
  implicit none
#include "usersub/arguments/fric_coef_2022_types.fi"
  double precision :: rest, moving, decay, rate, change
  double precision, volatile :: factor
  integer :: k
  rest = props(1)
  moving = props(2)
  decay = props(3)
  do k = 1, nBlock
    if (nTemp == 2) factor = 1  ! nTemp is 1
    rate = slipData(k, 1)
    change = (rest - moving)*exp(-decay*rate)
    fCoef(k, 1) = moving + change*factor
    fCoefDeriv(k, 1, 1) = -decay*change  ! by rate, pressure, temperature
    fCoefDeriv(k, 2:3, 1) = 0
  end do
end subroutine
